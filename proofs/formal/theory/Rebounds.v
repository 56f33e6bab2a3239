(* The model with restitution and the two-sided shift: to be trusted, beside Impact.v, for N1 to N3. *)
From Coq Require Import Reals ZArith.
From Oscillator Require Import Impact.
Open Scope R_scope.

Section Model.
Variables side eta nu eps : R.  (* as in Impact.v; eps is the coefficient of restitution *)

(* A state before an impact is (phi, gamma): its phase, and gamma = -X' / eta for the position X of the
   mass. X' / eta after it. *)
Definition kick (phi gamma : R) : R := eps * gamma + nu / eta * (1 + eps) * cos phi.

(* (14): distance of mass and table at time t after that impact; (15): gamma then. *)
Definition height (phi gamma t : R) : R :=
  side * ((1 + nu * sin phi) * cos (eta * t) + kick phi gamma * sin (eta * t) - 1 - nu * sin (phi + t)).
Definition arrival (phi gamma t : R) : R :=
  (1 + nu * sin phi) * sin (eta * t) - kick phi gamma * cos (eta * t).

(* F(z) = z' for states z = (phi, gamma) before an impact, phi in [0, 2 pi). *)
Definition rebound (z z' : R * R) : Prop := exists (t : R) (k : Z),
  (0 < t /\ height (fst z) (snd z) t = 0 /\ forall s, 0 < s < t -> 0 < height (fst z) (snd z) s) /\
  z' = (fst z + t - 2 * PI * IZR k, arrival (fst z) (snd z) t) /\ 0 <= fst z' < 2 * PI.
End Model.

Definition history := Z -> bool.                    (* two-sided sequences *)
Definition from (n : Z) (w : history) : history := fun k => w (n + k)%Z.

Section Rectangles.
Variable N : R * R -> R * R -> Prop.
Variables A b0 a1 B g0 g1 : R.   (* V1 = [A, b0] x [g0, g1], V2 = [a1, B] x [g0, g1] *)

Definition rectangle (i : bool) (z : R * R) : Prop := In_ A b0 a1 B i (fst z) /\ g0 <= snd z <= g1.

(* u is a full orbit that visits the rectangles in the order of w. *)
Definition orbit (w : history) (u : Z -> R * R) : Prop :=
  forall n, rectangle (w n) (u n) /\ N (u n) (u (n + 1)%Z).

Definition near (c e : R) (z z' : R * R) : Prop :=
  Rabs (fst z - fst z') <= e /\ Rabs (snd z - snd z') <= c * e.

(* X: histories -> states: each history is that of one full orbit, which begins at X w; X is
   one-to-one and continuous, and conjugates the shift of histories to the map. *)
Definition two_sided_shift (c k e : R) : Prop := exists X : history -> R * R,
  (forall w u, orbit w u <-> forall n, u n = X (from n w)) /\
  (forall w, N (X w) (X (from 1 w))) /\
  (forall w w', X w = X w' <-> forall n, w n = w' n) /\
  (forall (n : nat) w w', (forall j, (Z.abs j <= Z.of_nat n)%Z -> w j = w' j) ->
     near c (k ^ n * e) (X w) (X w')).
End Rectangles.

(* The model with restitution and the two-sided shift: to be trusted, beside Impact.v, for N1 to N3. *)
From Coq Require Import Reals ZArith.
From Oscillator Require Import Impact Histories.
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

Section Rectangles.
Variable N : R * R -> R * R -> Prop.
Variables A b0 a1 B g0 g1 : R.   (* V1 = [A, b0] x [g0, g1], V2 = [a1, B] x [g0, g1] *)

Definition rectangle (i : bool) (z : R * R) : Prop := In_ A b0 a1 B i (fst z) /\ g0 <= snd z <= g1.

(* Every two-sided sequence of the letters is the history of exactly one full orbit. *)
Definition two_sided_shift (k : R) : Prop :=
  followed_once bool (fun _ _ => True) rectangle N k /\ one_to_one bool rectangle N.
End Rectangles.

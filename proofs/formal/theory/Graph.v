(* What is said of a map f and of arrows between closed sets, intervals of the line among them: to be
   trusted. *)
From Coq Require Import Reals ZArith List.
Open Scope R_scope.

Fixpoint iter {T : Type} (f : T -> T) (n : nat) (x : T) : T := match n with O => x | S n => f (iter f n x) end.

Definition on_line (x y : R) : R := Rabs (x - y).
Definition in_plane (x y : R * R) : R := Rmax (Rabs (fst x - fst y)) (Rabs (snd x - snd y)).

Section Sets.
Context {T : Type}.
Variable distance : T -> T -> R.
Variable f : T -> T.
Variable cell : nat -> T -> Prop.       (* closed sets by numbers *)
Variable arrows : list (nat * nat).     (* from the one number to the other *)

(* An infinite path of arrows; the orbit of x visits the sets in the order of w; K: all points that
   follow an infinite path. *)
Definition path (w : nat -> nat) : Prop := forall n, In (w n, w (S n)) arrows.
Definition follows (w : nat -> nat) (x : T) : Prop := forall n, cell (w n) (iter f n x).
Definition K (x : T) : Prop := exists w, path w /\ follows w x.

(* Topological entropy at least log g / p, as Bowen defines it: for some c, eps > 0 and every q, at
   least c g^q points of K of which any two are eps apart within the first p q steps. *)
Definition entropy_at_least (p : nat) (g : Z) : Prop := exists c eps, 0 < c /\ 0 < eps /\
  forall q, exists l, NoDup l /\ (forall x, In x l -> K x) /\ c * IZR g ^ q <= INR (length l) /\
    forall x y, In x l -> In y l -> x <> y ->
      exists k, (k <= p * q)%nat /\ eps <= distance (iter f k x) (iter f k y).
End Sets.

Definition interval (cells : list (R * R)) (i : nat) (x : R) : Prop :=
  fst (nth i cells (0, 0)) <= x <= snd (nth i cells (0, 0)).

Section Line.
Variable f : R -> R.
Variable cells : list (R * R).          (* closed intervals by their ends, numbered from 0 *)
Variable arrows : list (nat * nat).
Notation path := (path arrows).
Notation follows := (follows f (interval cells)).

(* Every path is followed by a point, every periodic one by a periodic point; no point follows two
   paths, and points near a point of K follow its path for long. *)
Definition itinerary_map : Prop :=
  (forall w, path w -> exists x, follows w x) /\
  (forall w p, path w -> (0 < p)%nat -> (forall n, w (p + n)%nat = w n) ->
     exists x, follows w x /\ iter f p x = x) /\
  (forall w v x, path w -> path v -> follows w x -> follows v x -> forall n, w n = v n) /\
  (forall w x n, path w -> follows w x -> exists eps, 0 < eps /\
     forall v y, path v -> follows v y -> Rabs (y - x) < eps -> forall k, (k <= n)%nat -> v k = w k).
Definition semiconjugate : Prop := itinerary_map /\ compact (K f (interval cells) arrows).

(* Paths that agree in n steps are followed by points at most width / m^n apart: no two points
   follow the same path, and the inverse of the itinerary is continuous. *)
Definition conjugate (m : R) : Prop := semiconjugate /\ 1 < m /\ exists width, forall n w v x y,
  path w -> path v -> follows w x -> follows v y -> (forall k, (k <= n)%nat -> w k = v k) ->
  Rabs (x - y) <= width / m ^ n.
End Line.

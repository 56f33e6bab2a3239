(* What is said of a map f of the line and of arrows between closed intervals: to be trusted. *)
From Coq Require Import Reals ZArith List.
Open Scope R_scope.

Section Graph.
Variable f : R -> R.
Variable cells : list (R * R).          (* closed intervals by their ends, numbered from 0 *)
Variable arrows : list (nat * nat).     (* from the one number to the other *)

Fixpoint iter (n : nat) (x : R) : R := match n with O => x | S n => f (iter n x) end.
Definition cell (i : nat) (x : R) : Prop := fst (nth i cells (0, 0)) <= x <= snd (nth i cells (0, 0)).

(* An infinite path of arrows; the orbit of x visits the intervals in the order of w; K: all
   points that follow an infinite path. *)
Definition path (w : nat -> nat) : Prop := forall n, In (w n, w (S n)) arrows.
Definition follows (w : nat -> nat) (x : R) : Prop := forall n, cell (w n) (iter n x).
Definition K (x : R) : Prop := exists w, path w /\ follows w x.

(* Every path is followed by a point, every periodic one by a periodic point; no point follows two
   paths, and points near a point of K follow its path for long. *)
Definition itinerary_map : Prop :=
  (forall w, path w -> exists x, follows w x) /\
  (forall w p, path w -> (0 < p)%nat -> (forall n, w (p + n)%nat = w n) ->
     exists x, follows w x /\ iter p x = x) /\
  (forall w v x, path w -> path v -> follows w x -> follows v x -> forall n, w n = v n) /\
  (forall w x n, path w -> follows w x -> exists eps, 0 < eps /\
     forall v y, path v -> follows v y -> Rabs (y - x) < eps -> forall k, (k <= n)%nat -> v k = w k).
Definition semiconjugate : Prop := itinerary_map /\ compact K.

(* Paths that agree in n steps are followed by points at most width / m^n apart: no two points
   follow the same path, and the inverse of the itinerary is continuous. *)
Definition conjugate (m : R) : Prop := semiconjugate /\ 1 < m /\ exists width, forall n w v x y,
  path w -> path v -> follows w x -> follows v y -> (forall k, (k <= n)%nat -> w k = v k) ->
  Rabs (x - y) <= width / m ^ n.

(* Topological entropy at least log g / p, as Bowen defines it: for some c, eps > 0 and every q, at
   least c g^q points of K of which any two are eps apart within the first p q steps. *)
Definition entropy_at_least (p : nat) (g : Z) : Prop := exists c eps, 0 < c /\ 0 < eps /\
  forall q, exists l, NoDup l /\ (forall x, In x l -> K x) /\ c * IZR g ^ q <= INR (length l) /\
    forall x y, In x l -> In y l -> x <> y ->
      exists k, (k <= p * q)%nat /\ eps <= Rabs (iter k x - iter k y).
End Graph.

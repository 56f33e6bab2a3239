(* Two-sided sequences of letters, and that each which is allowed is the itinerary of exactly one full
   orbit in the plane: to be trusted. *)
From Coq Require Import Reals ZArith List.
Open Scope R_scope.

Section Histories.
Variable letter : Type.
Variable arrow : letter -> letter -> Prop.
Variable V : letter -> R * R -> Prop.       (* the sets that the letters name *)
Variable N : R * R -> R * R -> Prop.        (* N z z': z' is the image of z *)

Definition history := Z -> letter.
Definition from (n : Z) (w : history) : history := fun k => w (n + k)%Z.
Definition allowed (w : history) : Prop := forall n, arrow (w n) (w (n + 1)%Z).

(* u is a full orbit that visits the sets in the order of w. *)
Definition orbit (w : history) (u : Z -> R * R) : Prop := forall n, V (w n) (u n) /\ N (u n) (u (n + 1)%Z).

(* X: each allowed history is that of exactly one full orbit, which begins at X w; a periodic one of
   a periodic orbit; no orbit has two; histories that agree from -n to n have points k^n size apart. *)
Definition followed_once (k : R) : Prop := 0 <= k < 1 /\ exists (X : history -> R * R) (size : R),
  (forall w u, allowed w -> (orbit w u <-> forall n, u n = X (from n w))) /\
  (forall w u p, allowed w -> orbit w u -> (forall n, w (p + n)%Z = w n) -> forall n, u (p + n)%Z = u n) /\
  (forall w v u, allowed w -> allowed v -> orbit w u -> orbit v u -> forall n, w n = v n) /\
  (forall (n : nat) w v, allowed w -> allowed v -> (forall j, (Z.abs j <= Z.of_nat n)%Z -> w j = v j) ->
     Rabs (fst (X w) - fst (X v)) <= k ^ n * size /\ Rabs (snd (X w) - snd (X v)) <= k ^ n * size).

(* Each point of an orbit knows all of it. *)
Definition one_to_one : Prop := forall w v u t, orbit w u -> orbit v t -> u 0%Z = t 0%Z -> forall n, u n = t n.
End Histories.

(* The points c + q1 u + q2 v, q1 and q2 in [-1, 1], for the number i of a list of (c, u, v). *)
Definition parallelogram (sets : list (R * R * (R * R) * (R * R))) (i : nat) (z : R * R) : Prop :=
  let '(c, u, v) := nth i sets (0, 0, (1, 0), (0, 1)) in exists q1 q2, -1 <= q1 <= 1 /\ -1 <= q2 <= 1 /\
    z = (fst c + q1 * fst u + q2 * fst v, snd c + q1 * snd u + q2 * snd v).

(* What "chaos" and "Cantor set" mean here: to be trusted, beside Impact.v, for Theorems 3 and 4. *)
From Coq Require Import Reals List.
From Oscillator Require Import Impact.
Import ListNotations.
Open Scope R_scope.

Section Chaos.
Variable N : R -> R -> Prop.     (* N x y: y is the image of x *)
Variable L : R -> Prop.          (* the invariant set Lambda *)

(* y = f^n(x) *)
Fixpoint iterate (n : nat) (x y : R) : Prop :=
  match n with O => x = y | S n => exists z, N x z /\ iterate n z y end.

(* Exactly k points of the set satisfy P. *)
Definition count (P : R -> Prop) (k : nat) : Prop :=
  exists l, NoDup l /\ length l = k /\ forall x, In x l <-> L x /\ P x.

(* n is the least period of x. *)
Definition period (n : nat) (x : R) : Prop :=
  (0 < n)%nat /\ iterate n x x /\ forall k, (0 < k < n)%nat -> ~ iterate k x x.

(* The orbit of x is neither periodic nor eventually periodic. *)
Definition nonperiodic (x : R) : Prop :=
  ~ exists i n y, (0 < n)%nat /\ iterate i x y /\ iterate n y y.

Definition same_orbit (x y : R) : Prop := exists i j z, iterate i x z /\ iterate j y z.

(* Theorem 3: every least period, uncountably many nonperiodic orbits (no sequence e meets them all),
   a dense orbit; and 2^n points fixed by f^n. *)
Definition rich : Prop :=
  (forall n, (0 < n)%nat -> exists x, L x /\ period n x) /\
  (forall e : nat -> R, exists x, L x /\ nonperiodic x /\ forall k, ~ same_orbit x (e k)) /\
  (exists x, L x /\ forall y eps, L y -> 0 < eps ->
     exists n z, iterate n x z /\ L z /\ Rabs (z - y) < eps).
Definition chaos : Prop := (forall n, (0 < n)%nat -> count (fun x => iterate n x x) (2 ^ n)) /\ rich.

(* Theorem 4: not empty, compact (every open cover has a finite one), without isolated points, and
   without an interval: between any two points there is one outside. *)
Definition cantor_set : Prop :=
  (exists x, L x) /\ compact L /\
  (forall x eps, L x -> 0 < eps -> exists y, L y /\ y <> x /\ Rabs (y - x) < eps) /\
  (forall x y, L x -> L y -> x < y -> exists z, x < z < y /\ ~ L z).

(* Lebesgue measure zero: covered by finitely many intervals of total length below any eps. *)
Definition null : Prop := forall eps, 0 < eps -> exists l : list (R * R),
  (forall i, In i l -> fst i <= snd i) /\
  (forall x, L x -> exists i, In i l /\ fst i <= x <= snd i) /\
  fold_right Rplus 0 (map (fun i => snd i - fst i) l) < eps.
End Chaos.

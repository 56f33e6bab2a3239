(* What python -m proofs.formal --arithmetic has Coq prove; Arithmetic.v says what the operations are. *)
From Coq Require Import Reals ZArith.
From Oscillator Require Import Arithmetic Operations Series Sincos.
Open Scope R_scope.

(* an integer and an interval with rational ends are held *)
Theorem numbers bits : (0 <= bits)%Z -> (forall n, holds bits (integer bits n) (IZR n)) /\
  forall a b c d x, (0 < b)%Z -> (0 < d)%Z -> IZR a / IZR b <= x <= IZR c / IZR d ->
    holds bits (fractions bits a b c d) x.
Proof. intros B. split; intros; [apply integer_holds | apply fractions_hold]; auto. Qed.

(* sums, differences, products by an integer *)
Theorem linear bits X Y x y n : (0 <= bits)%Z -> holds bits X x -> holds bits Y y ->
  holds bits (add X Y) (x + y) /\ holds bits (sub X Y) (x - y) /\ holds bits (neg X) (- x) /\
  holds bits (scale X n) (x * IZR n).
Proof.
  intros B H G. split; [apply add_holds; auto|]. split; [apply sub_holds; auto|].
  split; [apply neg_holds; auto | apply scale_holds; auto].
Qed.

(* products, powers, quotients; where there is a quotient, 0 is not in the divisor *)
Theorem products bits X Y x y : (0 <= bits)%Z -> holds bits X x -> holds bits Y y ->
  holds bits (mul bits X Y) (x * y) /\ (forall n, (0 < n)%nat -> holds bits (pow bits X n) (x ^ n)) /\
  forall Q, div bits X Y = Some Q -> y <> 0 /\ holds bits Q (x / y).
Proof.
  intros B H G. split; [apply mul_holds; auto|]. split; [intros; apply pow_holds; auto|].
  intros Q E. apply (div_holds bits B X Y); auto.
Qed.

(* the union and the intersection of two intervals *)
Theorem sets bits X Y x : (holds bits X x \/ holds bits Y x -> holds bits (hull X Y) x) /\
  forall Z, holds bits X x -> holds bits Y x -> meet X Y = Some Z -> holds bits Z x.
Proof. split; [apply hull_holds | intros Z H G E; apply (meet_holds bits X Y); auto]. Qed.

(* pi *)
Theorem circle fuel bits P : (0 <= bits)%Z -> pi fuel bits = Some P -> holds bits P PI.
Proof. intros B E. apply (pi_holds fuel bits P B E). Qed.

(* sines and cosines, of numbers of less than 2^17 bits *)
Theorem sines fuel bits X S C x : (0 <= bits)%Z ->
  (bits + guard_bits (lo X) bits <= 2 ^ 17)%Z -> (bits + guard_bits (hi X) bits <= 2 ^ 17)%Z ->
  sincos fuel bits X = Some (S, C) -> holds bits X x -> holds bits S (sin x) /\ holds bits C (cos x).
Proof. apply sincos_holds. Qed.

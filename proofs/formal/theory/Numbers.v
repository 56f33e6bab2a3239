(* Enclosures by the intervals of coq-interval, in Coq's own integers: of sums and products, and of
   numbers n / unit. *)
From Coq Require Import Reals ZArith Psatz Bool.
From Interval Require Import Specific_stdz Specific_ops Float_full Interval Xreal.
Open Scope R_scope.

Module F := SpecificFloat StdZRadix2.
Module I := FloatIntervalFull F.

(* X, as an interval, contains x. *)
Definition holds (B : I.type) (x : R) : Prop := contains (I.convert B) (Xreal x).

Section Numbers.
Variable bits : positive.
Notation prec := (F.PtoP bits).
Notation "a [+] b" := (I.add prec a b) (at level 50, left associativity).
Notation "a [-] b" := (I.sub prec a b) (at level 50, left associativity).
Notation "a [*] b" := (I.mul prec a b) (at level 40, left associativity).

Lemma add_holds A B a b : holds A a -> holds B b -> holds (A [+] B) (a + b).
Proof. apply (I.add_correct prec A B (Xreal a) (Xreal b)). Qed.
Lemma sub_holds A B a b : holds A a -> holds B b -> holds (A [-] B) (a - b).
Proof. apply (I.sub_correct prec A B (Xreal a) (Xreal b)). Qed.
Lemma mul_holds A B a b : holds A a -> holds B b -> holds (A [*] B) (a * b).
Proof. apply (I.mul_correct prec A B (Xreal a) (Xreal b)). Qed.
Lemma neg_holds A a : holds A a -> holds (I.neg A) (- a).
Proof. apply (I.neg_correct A (Xreal a)). Qed.
Lemma one_holds : holds (I.fromZ prec 1) 1.
Proof. apply I.fromZ_correct. Qed.
Lemma div_holds A B a b : holds A a -> holds B b -> b <> 0 -> holds (I.div prec A B) (a / b).
Proof.
  intros H G N. pose proof (I.div_correct prec _ _ _ _ H G) as D. simpl in D. unfold Xdiv' in D.
  destruct (is_zero_spec b); [contradiction|exact D].
Qed.
Lemma join_holds A B a b x : holds A a -> holds B b -> a <= x <= b -> holds (I.join A B) x.
Proof.
  intros H G X. apply (contains_connected _ a b); auto; apply I.join_correct; [left|right]; auto.
Qed.

Definition above_zero (A : I.type) : bool := match I.sign_strict A with Xgt => true | _ => false end.
Definition not_negative (A : I.type) : bool := match I.sign_large A with Xgt | Xeq => true | _ => false end.
Lemma above_zero_holds A a : holds A a -> above_zero A = true -> 0 < a.
Proof.
  unfold above_zero. intros H P. pose proof (I.sign_strict_correct A) as S.
  destruct (I.sign_strict A); try discriminate. apply (S _ H).
Qed.
Lemma not_negative_holds A a : holds A a -> not_negative A = true -> 0 <= a.
Proof.
  unfold not_negative. intros H P. pose proof (I.sign_large_correct A) as S.
  destruct (I.sign_large A); try discriminate; specialize (S _ H); [injection S; lra|apply S].
Qed.

(* Numbers n / unit. *)
Variable unit : positive.
Definition ratio (n : Z) : R := IZR n / IZR (Zpos unit).
Definition number (n : Z) : I.type := I.div prec (I.fromZ prec n) (I.fromZ prec (Zpos unit)).

Lemma unit_pos : 0 < IZR (Zpos unit).
Proof. apply IZR_lt. lia. Qed.
Lemma number_holds n : holds (number n) (ratio n).
Proof. apply div_holds; [apply I.fromZ_correct|apply I.fromZ_correct|pose proof unit_pos; lra]. Qed.
Lemma ratio_add m n : ratio (m + n) = ratio m + ratio n.
Proof. unfold ratio. rewrite plus_IZR. field. pose proof unit_pos. lra. Qed.
Lemma ratio_le m n : (m <= n)%Z -> ratio m <= ratio n.
Proof. intros H. apply IZR_le in H. apply Rmult_le_compat_r; auto. apply Rlt_le, Rinv_0_lt_compat, unit_pos. Qed.
Lemma ratio_lt m n : (m < n)%Z -> ratio m < ratio n.
Proof. intros H. apply IZR_lt in H. apply Rmult_lt_compat_r; auto. apply Rinv_0_lt_compat, unit_pos. Qed.
Lemma ratio_0 : ratio 0 = 0.
Proof. unfold ratio, Rdiv. ring. Qed.
Definition range (m n : Z) : I.type := I.join (number m) (number n).
Lemma range_holds m n x : ratio m <= x <= ratio n -> holds (range m n) x.
Proof. apply join_holds; apply number_holds. Qed.

Definition at_most (V : I.type) (n : Z) : bool := not_negative (number n [-] V).
Definition at_least (V : I.type) (n : Z) : bool := not_negative (V [-] number n).
Lemma at_most_holds V v n : holds V v -> at_most V n = true -> v <= ratio n.
Proof. intros H U. pose proof (not_negative_holds _ _ (sub_holds _ _ _ _ (number_holds n) H) U). lra. Qed.
Lemma at_least_holds V v n : holds V v -> at_least V n = true -> ratio n <= v.
Proof. intros H U. pose proof (not_negative_holds _ _ (sub_holds _ _ _ _ H (number_holds n)) U). lra. Qed.
Definition small (V : I.type) (n : Z) : bool := at_most V n && at_least V (- n).
Lemma small_holds V v n : holds V v -> small V n = true -> Rabs v <= ratio n.
Proof.
  unfold small. rewrite andb_true_iff. intros H [U L]. apply (at_most_holds _ _ _ H) in U. apply (at_least_holds _ _ _ H) in L.
  apply Rabs_le. unfold ratio in *. rewrite opp_IZR in L. split; [|exact U].
  replace (- (IZR n / IZR (Zpos unit))) with (- IZR n / IZR (Zpos unit)) by (field; pose proof unit_pos; lra). exact L.
Qed.
End Numbers.

Arguments add_holds {bits}. Arguments sub_holds {bits}. Arguments mul_holds {bits}. Arguments div_holds {bits}.

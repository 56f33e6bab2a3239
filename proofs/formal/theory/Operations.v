(* Containment: every operation of the checker's arithmetic holds the result for all numbers held. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Rcomplements.
From Oscillator Require Import Arithmetic.
Open Scope R_scope.

Lemma floor_bound a b : b <> 0%Z -> IZR (a / b) <= IZR a / IZR b < IZR (a / b) + 1.
Proof.
  intros b0. assert (B : IZR b <> 0) by (apply not_0_IZR; auto).
  replace (IZR a / IZR b) with (IZR (a / b) + IZR (a mod b) / IZR b).
  - destruct (Z_lt_le_dec 0 b) as [P|P].
    + assert (M := Z.mod_pos_bound a b P). apply IZR_lt in P.
      assert (0 <= IZR (a mod b) < IZR b) by (split; [apply IZR_le|apply IZR_lt]; lia).
      assert (0 <= IZR (a mod b) / IZR b < 1); [|lra].
      split; [apply Rdiv_le_0_compat; lra|]. apply Rlt_div_l; lra.
    + assert (N : (b < 0)%Z) by lia. assert (M := Z.mod_neg_bound a b N). apply IZR_lt in N.
      assert (0 <= - IZR (a mod b) < - IZR b) by (rewrite <- !opp_IZR; split; [apply IZR_le|apply IZR_lt]; lia).
      replace (IZR (a mod b) / IZR b) with (- IZR (a mod b) / - IZR b) by (field; auto).
      assert (0 <= - IZR (a mod b) / - IZR b < 1); [|lra].
      split; [apply Rdiv_le_0_compat; lra|]. apply Rlt_div_l; lra.
  - rewrite (Z.div_mod a b b0) at 3. rewrite plus_IZR, mult_IZR. field. auto.
Qed.

Lemma ceil_bound a b : b <> 0%Z -> IZR a / IZR b <= IZR (ceil a b) < IZR a / IZR b + 1.
Proof.
  intros b0. unfold ceil. rewrite opp_IZR. pose proof (floor_bound (- a) b b0) as H.
  rewrite opp_IZR in H. unfold Rdiv in *. lra.
Qed.

Section Bits.
Variable bits : Z.
Hypothesis bits_pos : (0 <= bits)%Z.
Notation unit := (IZR (2 ^ bits)).
Notation holds := (holds bits).

Lemma unit_pos n : (0 <= n)%Z -> 0 < IZR (2 ^ n).
Proof. intros N. apply IZR_lt, Z.pow_pos_nonneg; lia. Qed.

Lemma down_bound a n : (0 <= n)%Z -> IZR (Z.shiftr a n) <= IZR a / IZR (2 ^ n) < IZR (Z.shiftr a n) + 1.
Proof. intros N. rewrite Z.shiftr_div_pow2 by auto. apply floor_bound. pose proof (Z.pow_pos_nonneg 2 n). lia. Qed.

Lemma up_bound a n : (0 <= n)%Z -> IZR a / IZR (2 ^ n) <= IZR (up a n) < IZR a / IZR (2 ^ n) + 1.
Proof.
  intros N. unfold up. rewrite Z.shiftr_div_pow2 by auto.
  apply ceil_bound. pose proof (Z.pow_pos_nonneg 2 n). lia.
Qed.

Lemma shiftl_unit a : IZR (Z.shiftl a bits) = IZR a * unit.
Proof. rewrite Z.shiftl_mul_pow2, mult_IZR; auto. Qed.

Lemma min_IZR a b : IZR (Z.min a b) = Rmin (IZR a) (IZR b).
Proof.
  unfold Rmin. destruct Rle_dec as [H|H]; f_equal; [apply le_IZR in H; lia|].
  assert (~ (a <= b)%Z) by (intros G; apply H, IZR_le, G). lia.
Qed.

Lemma max_IZR a b : IZR (Z.max a b) = Rmax (IZR a) (IZR b).
Proof.
  unfold Rmax. destruct Rle_dec as [H|H]; f_equal; [apply le_IZR in H; lia|].
  assert (~ (a <= b)%Z) by (intros G; apply H, IZR_le, G). lia.
Qed.

Theorem integer_holds n : holds (integer bits n) (IZR n).
Proof. unfold Arithmetic.holds, integer. simpl. rewrite shiftl_unit. lra. Qed.

Theorem fractions_hold a b c d x : (0 < b)%Z -> (0 < d)%Z ->
  IZR a / IZR b <= x <= IZR c / IZR d -> holds (fractions bits a b c d) x.
Proof.
  intros B D X. pose proof (unit_pos bits bits_pos) as U. unfold Arithmetic.holds, fractions; simpl.
  pose proof (floor_bound (Z.shiftl a bits) b ltac:(lia)) as F.
  pose proof (floor_bound (Z.shiftl (- c) bits) d ltac:(lia)) as C.
  rewrite shiftl_unit in F, C. rewrite opp_IZR in *. unfold Rdiv in *.
  split; [eapply Rle_trans; [apply F|]|eapply Rle_trans with (IZR c * / IZR d * unit)]; nra.
Qed.

Theorem neg_holds X x : holds X x -> holds (neg X) (- x).
Proof. unfold Arithmetic.holds, neg; simpl. rewrite !opp_IZR. lra. Qed.

Theorem add_holds X Y x y : holds X x -> holds Y y -> holds (add X Y) (x + y).
Proof. unfold Arithmetic.holds, add; simpl. rewrite !plus_IZR. lra. Qed.

Theorem sub_holds X Y x y : holds X x -> holds Y y -> holds (sub X Y) (x - y).
Proof. unfold Arithmetic.holds, sub; simpl. rewrite !minus_IZR. lra. Qed.

Lemma min_mono a b c d : a <= c -> b <= d -> Rmin a b <= Rmin c d.
Proof. intros. unfold Rmin. repeat destruct Rle_dec; lra. Qed.

Lemma max_mono a b c d : a <= c -> b <= d -> Rmax a b <= Rmax c d.
Proof. intros. unfold Rmax. repeat destruct Rle_dec; lra. Qed.

Lemma multiple a b x z : a <= x <= b -> Rmin (a * z) (b * z) <= x * z <= Rmax (a * z) (b * z).
Proof.
  intros X. assert (a * z <= x * z <= b * z \/ b * z <= x * z <= a * z).
  { destruct (Rle_dec 0 z); [left|right]; split; nra. }
  unfold Rmin, Rmax. repeat destruct Rle_dec; lra.
Qed.

Lemma product a b c d x y : a <= x <= b -> c <= y <= d ->
  Rmin (Rmin (a * c) (a * d)) (Rmin (b * c) (b * d)) <= x * y <=
  Rmax (Rmax (a * c) (a * d)) (Rmax (b * c) (b * d)).
Proof.
  intros X Y. pose proof (multiple a b x y X) as L.
  assert (M : forall z, Rmin (z * c) (z * d) <= z * y <= Rmax (z * c) (z * d)).
  { intros z. rewrite !(Rmult_comm z). apply multiple, Y. }
  destruct (M a) as [M1 M2]. destruct (M b) as [M3 M4]. pose proof (min_mono _ _ _ _ M1 M3).
  pose proof (max_mono _ _ _ _ M2 M4). lra.
Qed.

Theorem mul_holds X Y x y : holds X x -> holds Y y -> holds (mul bits X Y) (x * y).
Proof.
  destruct X as [a b], Y as [c d]. unfold Arithmetic.holds, mul. simpl lo. simpl hi. intros HX HY.
  pose proof (product _ _ _ _ _ _ HX HY) as P. pose proof (unit_pos bits bits_pos) as U.
  pose proof (down_bound (min4 (a * c) (a * d) (b * c) (b * d)) bits bits_pos) as L.
  pose proof (up_bound (max4 (a * c) (a * d) (b * c) (b * d)) bits bits_pos) as H.
  unfold min4 in L at 2. unfold max4 in H at 1. rewrite !min_IZR, !mult_IZR in L.
  rewrite !max_IZR, !mult_IZR in H.
  replace (x * y * unit) with (x * unit * (y * unit) / unit) by (field; lra).
  split; [eapply Rle_trans; [apply L|]|eapply Rle_trans; [|apply H]];
    apply Rmult_le_compat_r; try lra; apply Rlt_le, Rinv_0_lt_compat, U.
Qed.

Theorem scale_holds X n x : holds X x -> holds (scale X n) (x * IZR n).
Proof.
  unfold Arithmetic.holds, scale; simpl. rewrite min_IZR, max_IZR, !mult_IZR.
  intros H.
  replace (x * IZR n * unit) with (x * unit * IZR n) by ring. apply multiple, H.
Qed.

(* The reciprocals of the numbers between c and d, where 0 is not. *)
Lemma reciprocal c d y : 0 < c \/ d < 0 -> c <= y <= d -> / d <= / y <= / c.
Proof.
  intros [S|S] Y; [split; apply Rinv_le_contravar; lra|].
  rewrite <- (Ropp_involutive d), <- (Ropp_involutive y), <- (Ropp_involutive c).
  rewrite !(Rinv_opp (- _)).
  split; apply Ropp_le_contravar, Rinv_le_contravar; lra.
Qed.

Theorem div_holds X Y Q x y : holds X x -> holds Y y -> div bits X Y = Some Q ->
  y <> 0 /\ holds Q (x / y).
Proof.
  destruct X as [a b], Y as [c d]. unfold Arithmetic.holds, div. simpl lo. simpl hi. intros HX HY E.
  pose proof (unit_pos bits bits_pos) as U.
  assert (S : 0 < IZR c \/ IZR d < 0).
  { destruct (Z.leb_spec c 0); [|left; apply IZR_lt; auto].
    destruct (Z.leb_spec 0 d); [discriminate|right; apply IZR_lt; auto]. }
  destruct (_ && _)%bool; [discriminate|]. injection E as <-. simpl lo. simpl hi.
  assert (c0 : c <> 0%Z) by (intros ->; lra). assert (d0 : d <> 0%Z) by (intros ->; lra).
  assert (y0 : y <> 0) by (intros ->; lra). split; auto.
  pose proof (product _ _ _ _ (x * unit * unit) _
    (conj (Rmult_le_compat_r unit _ _ ltac:(lra) (proj1 HX)) (Rmult_le_compat_r unit _ _ ltac:(lra) (proj2 HX)))
    (reciprocal _ _ _ S HY)) as P.
  replace (x * unit * unit * / (y * unit)) with (x / y * unit) in P by (field; lra).
  assert (F : forall e z, z <> 0%Z -> IZR (Z.shiftl e bits / z) <= IZR e * unit * / IZR z <=
    IZR (ceil (Z.shiftl e bits) z)).
  { intros e z Z. rewrite <- shiftl_unit. split; [apply floor_bound|apply ceil_bound]; auto. }
  pose proof (F a c c0). pose proof (F a d d0). pose proof (F b c c0). pose proof (F b d d0).
  unfold min4, max4. rewrite !min_IZR, !max_IZR.
  rewrite !(Rmin_comm (_ * / IZR d)), !(Rmax_comm (_ * / IZR d)) in P.
  split; [eapply Rle_trans; [|apply P]|eapply Rle_trans; [apply P|]];
    repeat apply min_mono; repeat apply max_mono; apply F; auto.
Qed.

Theorem pow_holds X n x : (0 < n)%nat -> holds X x -> holds (pow bits X n) (x ^ n).
Proof.
  intros N H. unfold pow. replace n with (S (n - 1)) at 2 by lia.
  induction (n - 1)%nat as [|k IH]; simpl; [rewrite Rmult_1_r; auto|].
  rewrite Rmult_comm. apply mul_holds; auto.
Qed.

Theorem hull_holds X Y x : holds X x \/ holds Y x -> holds (hull X Y) x.
Proof.
  unfold Arithmetic.holds, hull; simpl. rewrite min_IZR, max_IZR. unfold Rmin, Rmax.
  repeat destruct Rle_dec; lra.
Qed.

Theorem meet_holds X Y Z x : holds X x -> holds Y x -> meet X Y = Some Z -> holds Z x.
Proof.
  unfold Arithmetic.holds, meet. intros P Q. destruct (_ <? _)%Z; [discriminate|].
  intros E; injection E as <-; simpl. rewrite max_IZR, min_IZR. unfold Rmin, Rmax.
  repeat destruct Rle_dec; lra.
Qed.
End Bits.

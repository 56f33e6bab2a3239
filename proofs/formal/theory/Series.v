(* The error of the series of sine, cosine and atan; the checker's pi holds pi. *)
From Coq Require Import Reals ZArith Psatz Lia List Machin.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Arithmetic Operations Calculus.
Open Scope R_scope.

Ltac real := match goal with |- @eq _ ?a ?b => change (@eq R a b) end.

Lemma power_derive n c x : is_derive (fun x => c * x ^ S n / INR (S n)) x (c * x ^ n).
Proof.
  assert (INR (S n) <> 0) by (apply not_0_INR; lia).
  apply (is_derive_ext (fun x => c / INR (S n) * x ^ S n)). { intros; real; unfold Rdiv; ring. }
  replace (c * x ^ n) with (c / INR (S n) * (INR (S n) * 1 * x ^ pred (S n))) by (real; simpl pred; field; auto).
  apply is_derive_scal, is_derive_pow. apply (is_derive_id x).
Qed.

(* A function with E(0) = 0 and |E'(t)| <= c |t|^n is at most c |x|^(n + 1) / (n + 1). *)
Lemma compare (E dE : R -> R) c n x : E 0 = 0 -> (forall t, is_derive E t (dE t)) ->
  (forall t, Rabs (dE t) <= c * Rabs t ^ n) -> Rabs (E x) <= c * Rabs x ^ S n / INR (S n).
Proof.
  intros E0 D B. destruct (Req_dec x 0) as [->|x0].
  { rewrite E0, !Rabs_R0. simpl. unfold Rdiv. rewrite Rmult_0_l, Rmult_0_r, Rmult_0_l. lra. }
  assert (Sign : forall z, exists u, Rabs u = 1 /\ Rabs z = u * z /\ z = u * Rabs z).
  { intros z. destruct (Rle_dec 0 z); [exists 1|exists (-1)];
      [rewrite Rabs_R1, Rabs_pos_eq by lra|rewrite Rabs_m1, Rabs_left by lra]; lra. }
  destruct (Sign (E x)) as (u & U & -> & _), (Sign x) as (s & S1 & _ & X). apply Rabs_pos_lt in x0.
  destruct (mvt (fun t => minus (c * t ^ S n / INR (S n)) (u * E (s * t)))
    (fun t => minus (c * t ^ n) (u * (s * dE (s * t)))) 0 (Rabs x)) as [t [T H]]; auto.
  - intros t _. apply (is_derive_minus (V := R_NormedModule)); [apply power_derive|].
    apply is_derive_scal. apply (is_derive_comp (V := R_NormedModule) E); [apply D|].
    auto_derive; auto. ring.
  - change (c * Rabs x ^ S n / INR (S n) - u * E (s * Rabs x) - (c * 0 ^ S n / INR (S n) - u * E (s * 0))
      = (c * t ^ n - u * (s * dE (s * t))) * (Rabs x - 0)) in H.
    rewrite <- X, Rmult_0_r, E0, (pow_ne_zero (S n)) in H by discriminate.
    specialize (B (s * t)). rewrite Rabs_mult, S1, Rmult_1_l, (Rabs_pos_eq t) in B by lra.
    pose proof (Rle_abs (u * (s * dE (s * t)))) as A. rewrite !Rabs_mult, U, S1 in A.
    unfold Rdiv in *. rewrite !Rmult_0_r, Rmult_0_l in H. nra.
Qed.

(* -- sine and cosine -- *)

(* The Taylor polynomial of sin(a + x), of degree n. *)
Fixpoint taylor (a : R) (n : nat) (x : R) : R :=
  match n with
  | O => sin a
  | S m => taylor a m x + sin (a + INR n * (PI / 2)) * x ^ n / INR (fact n)
  end.

Lemma taylor_derive n : forall a x, is_derive (taylor a (S n)) x (taylor (a + PI / 2) n x).
Proof.
  assert (T : forall n a x, is_derive (fun x => sin (a + INR (S n) * (PI / 2)) * x ^ S n / INR (fact (S n))) x
    (sin (a + PI / 2 + INR n * (PI / 2)) * x ^ n / INR (fact n))).
  { intros k a x. pose proof (INR_fact_neq_0 k). assert (INR (S k) <> 0) by (apply not_0_INR; lia).
    apply (is_derive_ext (fun x => sin (a + INR (S k) * (PI / 2)) / INR (fact k) * x ^ S k / INR (S k))).
    { intros t. real. rewrite fact_simpl, mult_INR. field. auto. }
    replace (a + PI / 2 + INR k * (PI / 2)) with (a + INR (S k) * (PI / 2)) by (rewrite S_INR; ring).
    replace (sin (a + INR (S k) * (PI / 2)) * x ^ k / INR (fact k)) with
      (sin (a + INR (S k) * (PI / 2)) / INR (fact k) * x ^ k) by (real; field; auto).
    apply power_derive. }
  induction n as [|n IH]; intros a x.
  - apply (is_derive_ext (fun x => plus (sin a) (sin (a + INR 1 * (PI / 2)) * x ^ 1 / INR (fact 1)))).
    { reflexivity. }
    replace (taylor _ _ _) with (plus 0 (sin (a + PI / 2 + INR 0 * (PI / 2)) * x ^ 0 / INR (fact 0))).
    + apply (is_derive_plus (V := R_NormedModule)); [|apply T].
      apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
    + unfold plus; simpl. rewrite Rmult_0_l, !Rplus_0_r, Rplus_0_l. field.
  - apply (is_derive_plus (V := R_NormedModule) (taylor a (S n))); [apply IH|apply T].
Qed.

Lemma taylor_error n : forall a x, Rabs (sin (a + x) - taylor a n x) <= Rabs x ^ S n / INR (fact (S n)).
Proof.
  assert (D : forall a x, is_derive (fun x => sin (a + x)) x (sin (a + PI / 2 + x))).
  { intros a x. replace (a + PI / 2 + x) with (PI / 2 + (a + x)) by ring. rewrite <- cos_sin.
    auto_derive; auto. ring. }
  assert (E0 : forall n a, sin (a + 0) - taylor a n 0 = 0).
  { intros k a. rewrite Rplus_0_r. induction k as [|k IH]; [simpl; ring|].
    change (taylor a (S k) 0) with (taylor a k 0 + sin (a + INR (S k) * (PI / 2)) * 0 ^ S k / INR (fact (S k))).
    rewrite (pow_ne_zero (S k)) by discriminate. unfold Rdiv. lra. }
  induction n as [|n IH]; intros a x.
  - replace (Rabs x ^ 1 / INR (fact 1)) with (1 * Rabs x ^ 1 / INR 1) by (simpl; field).
    apply (compare (fun x => minus (sin (a + x)) (sin a)) (fun t => minus (sin (a + PI / 2 + t)) 0) 1 0 x).
    + apply (E0 O).
    + intros t. apply (is_derive_minus (V := R_NormedModule)); [apply D|].
      apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
    + intros t. unfold minus, plus, opp; simpl. rewrite Ropp_0, Rplus_0_r, Rmult_1_r.
      apply Rabs_le, SIN_bound.
  - pose proof (INR_fact_neq_0 (S n)). assert (INR (S (S n)) <> 0) by (apply not_0_INR; lia).
    replace (Rabs x ^ S (S n) / INR (fact (S (S n)))) with (/ INR (fact (S n)) * Rabs x ^ S (S n) / INR (S (S n))).
    + apply (compare (fun x => minus (sin (a + x)) (taylor a (S n) x))
        (fun t => minus (sin (a + PI / 2 + t)) (taylor (a + PI / 2) n t)) _ (S n) x).
      * apply E0.
      * intros t. apply (is_derive_minus (V := R_NormedModule)); [apply D|apply taylor_derive].
      * intros t. rewrite Rmult_comm. apply IH.
    + rewrite (fact_simpl (S n)), mult_INR. field. auto.
Qed.

(* -- pi -- *)

(* The sum of the first k terms of the series of atan. *)
Fixpoint atan_sum (k : nat) (x : R) : R :=
  match k with O => 0 | S k => atan_sum k x + (-1) ^ k * x ^ S (2 * k) / INR (S (2 * k)) end.

Lemma atan_error k x : Rabs (atan x - atan_sum k x) <= Rabs x ^ S (2 * k) / INR (S (2 * k)).
Proof.
  assert (D : forall x, is_derive (atan_sum k) x ((1 - (-1) ^ k * x ^ (2 * k)) / (1 + x ^ 2))).
  { clear x. intros x. assert (P : 0 < 1 + x ^ 2) by nra. induction k as [|j IH].
    - replace (_ / _) with 0 by (real; simpl; field; lra).
      apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
    - replace (_ / _) with ((1 - (-1) ^ j * x ^ (2 * j)) / (1 + x ^ 2) + (-1) ^ j * x ^ (2 * j)).
      + apply (is_derive_plus (V := R_NormedModule) (atan_sum j)); [auto|apply power_derive].
      + replace (2 * S j)%nat with (2 + 2 * j)%nat by lia. real.
        rewrite (pow_add x 2), <- (tech_pow_Rmult (-1)). generalize (x ^ (2 * j)) ((-1) ^ j).
        intros. field. lra. }
  replace (Rabs x ^ S (2 * k)) with (1 * Rabs x ^ S (2 * k)) by ring.
  apply (compare (fun x => minus (atan x) (atan_sum k x)) (fun t => minus (/ (1 + Rsqr t))
    ((1 - (-1) ^ k * t ^ (2 * k)) / (1 + t ^ 2)))).
  - assert (Z : atan_sum k 0 = 0).
    { clear D. induction k as [|j IH]; auto.
      change (atan_sum j 0 + (-1) ^ j * 0 ^ S (2 * j) / INR (S (2 * j)) = 0). rewrite IH, (pow_ne_zero (S _)) by discriminate.
      unfold Rdiv. ring. }
    rewrite atan_0, Z. apply Rminus_eq_0.
  - intros t. apply (is_derive_minus (V := R_NormedModule)); [apply is_derive_atan|apply D].
  - intros t. assert (0 < 1 + t ^ 2) by nra. rewrite Rmult_1_l, RPow_abs.
    replace (minus _ _) with ((-1) ^ k * t ^ (2 * k) * / (1 + t ^ 2)).
    + rewrite !Rabs_mult, pow_1_abs, Rmult_1_l, (Rabs_pos_eq (/ _)) by (apply Rlt_le, Rinv_0_lt_compat; lra).
      rewrite <- (Rmult_1_r (Rabs (t ^ (2 * k)))) at 2. apply Rmult_le_compat_l; [apply Rabs_pos|].
      rewrite <- Rinv_1. apply Rinv_le_contravar; nra.
    + replace (1 + Rsqr t) with (1 + t ^ 2) by (unfold Rsqr; ring).
      change (minus ?a ?b) with (a - b). real. generalize (t ^ (2 * k)) ((-1) ^ k). intros. field. lra.
Qed.

(* Gauss: the angle of (18 + i)^12 (57 + i)^8 (239 - i)^5 is a quarter of pi. *)
Lemma atan_add u v w : -1 < u < 1 -> -1 < v < 1 -> -1 <= w <= 1 -> w * (1 - u * v) = u + v ->
  atan u + atan v = atan w.
Proof.
  intros U V W E. assert (P : -1 < w * u).
  { destruct (Rle_dec 0 u); nra. } assert (N : 1 + w * u <> 0) by lra.
  rewrite (atan_sub_correct w u N).
  - unfold atan_sub. replace ((w - u) / (1 + w * u)) with v; auto.
    apply Rmult_eq_reg_r with (1 + w * u); auto. unfold Rdiv.
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by auto. lra.
  - apply tech; lra.
  - apply atan_bound.
Qed.

Lemma gauss : PI = 48 * atan (/ 18) + 32 * atan (/ 57) - 20 * atan (/ 239).
Proof.
  assert (Double : forall u w, -1 < u < 1 -> -1 < w < 1 -> w * (1 - u * u) = u + u -> 2 * atan u = atan w).
  { intros u w U W E. rewrite <- (atan_add u u w); lra. }
  pose proof (Double (/ 18) (36 / 323) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (36 / 323) (23256 / 103033) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (23256 / 103033) (4792270896 / 10074957553) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (atan_add (4792270896 / 10074957553) (23256 / 103033) (728065260080136 / 926604049600873)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (/ 57) (57 / 1624) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (57 / 1624) (185136 / 2634127) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (185136 / 2634127) (975343472544 / 6904349713633) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (- / 239) (- 239 / 28560) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (Double (- 239 / 28560) (- 13651680 / 815616479) ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (atan_add (- 13651680 / 815616479) (- / 239) (- 4078367999 / 194918686801)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
  set (w := 5929006241089 / 7879693186177).
  pose proof (atan_add (728065260080136 / 926604049600873) (- 4078367999 / 194918686801) w
    ltac:(lra) ltac:(lra) ltac:(unfold w; lra) ltac:(unfold w; lra)).
  pose proof (atan_add w (975343472544 / 6904349713633) 1
    ltac:(unfold w; lra) ltac:(lra) ltac:(lra) ltac:(unfold w; lra)).
  rewrite atan_opp in *. rewrite atan_1 in *. lra.
Qed.

Lemma atan_loop fuel n bits : (2 <= n)%Z -> (0 <= bits)%Z -> forall j total v e,
  Rabs (IZR total - atan_sum j (/ IZR n) * IZR (2 ^ bits)) <= INR j -> (Z.of_nat j <= bits + 1)%Z ->
  atan_inverse fuel n bits total (Z.of_nat j) = Some (v, e) ->
  Rabs (IZR v - atan (/ IZR n) * IZR (2 ^ bits)) <= IZR e /\ (e <= bits + 2)%Z.
Proof.
  intros N Bp. pose proof (unit_pos bits Bp) as U. assert (n2 : 2 <= IZR n) by (apply IZR_le; auto).
  induction fuel as [|fuel IH]; intros j total v e I J; cbn [atan_inverse]; [discriminate|cbv zeta].
  set (x := / IZR n) in *. set (d := ((2 * Z.of_nat j + 1) * n ^ (2 * Z.of_nat j + 1))%Z).
  assert (X : 0 < x) by (apply Rinv_0_lt_compat; lra).
  set (t := x ^ S (2 * j) / INR (S (2 * j)) * IZR (2 ^ bits)).
  assert (d1 : (1 <= n ^ (2 * Z.of_nat j + 1))%Z) by (apply (Z.pow_le_mono_r n 0); lia).
  assert (d0 : (0 < d)%Z) by (unfold d; nia).
  assert (T : t = IZR (Z.shiftl 1 bits) / IZR d).
  { unfold t, d, x. rewrite shiftl_unit by auto. rewrite mult_IZR.
    replace (2 * Z.of_nat j + 1)%Z with (Z.of_nat (S (2 * j))) by lia.
    rewrite <- pow_IZR, <- INR_IZR_INZ, pow_inv. field.
    repeat split; (apply pow_nonzero; lra) || (apply not_0_INR; discriminate). }
  pose proof (floor_bound (Z.shiftl 1 bits) d ltac:(lia)) as F. rewrite <- T in F.
  destruct (Z.eqb_spec (Z.shiftl 1 bits / d) 0) as [Z0|Z0].
  - intros E; injection E as <- <-. split; [|lia]. rewrite Z0 in F.
    pose proof (atan_error j x) as A. rewrite (Rabs_pos_eq x) in A by lra.
    apply Rmult_le_compat_r with (r := IZR (2 ^ bits)) in A; [|lra]. fold t in A.
    replace (_ * IZR (2 ^ bits)) with (Rabs ((atan x - atan_sum j x) * IZR (2 ^ bits))) in A
      by (rewrite Rabs_mult, (Rabs_pos_eq (IZR _)); lra).
    rewrite plus_IZR, <- INR_IZR_INZ.
    replace (IZR total - atan x * IZR (2 ^ bits)) with
      ((IZR total - atan_sum j x * IZR (2 ^ bits)) - (atan x - atan_sum j x) * IZR (2 ^ bits)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra.
  - intros E. replace (Z.of_nat j + 1)%Z with (Z.of_nat (S j)) in E by lia.
    apply IH in E; auto.
    + change (atan_sum (S j) x) with (atan_sum j x + (-1) ^ j * x ^ S (2 * j) / INR (S (2 * j))).
      assert (S1 : exists s, Rabs s = 1 /\ (-1) ^ j = s /\
        IZR (if Z.odd (Z.of_nat j) then - (Z.shiftl 1 bits / d) else Z.shiftl 1 bits / d) = s * IZR (Z.shiftl 1 bits / d)).
      { exists ((-1) ^ j). split; [apply pow_1_abs|split; auto].
        destruct (Nat.Even_or_Odd j) as [[i ->]|[i ->]].
        - replace (Z.odd _) with false by (rewrite Nat2Z.inj_mul, Z.odd_mul; reflexivity).
          rewrite pow_1_even. ring.
        - replace (Z.odd _) with true by (rewrite Nat2Z.inj_add, Nat2Z.inj_mul, Z.odd_add, Z.odd_mul; reflexivity).
          rewrite Nat.add_1_r, pow_1_odd, opp_IZR. ring. }
      destruct S1 as (s & S1 & S3 & S2). rewrite plus_IZR, S2, S3, (S_INR j).
      match goal with |- Rabs ?e <= _ => replace e with ((IZR total - atan_sum j x * IZR (2 ^ bits)) + s * (IZR (Z.shiftl 1 bits / d) - t))
        by (unfold t, Rdiv; ring) end.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult, S1, Rmult_1_l.
      apply Rplus_le_compat; auto. apply Rabs_le. lra.
    + assert (P : (2 ^ (2 * Z.of_nat j + 1) <= 2 ^ bits)%Z).
      { assert (d <= 2 ^ bits)%Z.
        { apply Znot_gt_le. intros G. apply Z0. rewrite Z.shiftl_1_l. apply Z.div_small. lia. }
        assert (2 ^ (2 * Z.of_nat j + 1) <= n ^ (2 * Z.of_nat j + 1))%Z by (apply Z.pow_le_mono_l; lia).
        unfold d in *. nia. }
      apply Z.pow_le_mono_r_iff in P; lia.
Qed.

Lemma Some_injective (T : Type) (a b : T) : Some a = Some b -> a = b.
Proof. congruence. Qed.

Theorem pi_holds fuel bits P : (0 <= bits)%Z -> pi fuel bits = Some P ->
  holds bits P PI /\ IZR (hi P) - IZR (lo P) <= 2 + 200 * (IZR bits + 18) / 65536.
Proof.
  intros Bp. unfold pi. cbv zeta.
  assert (A : forall n v e, (2 <= n)%Z -> atan_inverse fuel n (bits + 16) 0 0 = Some (v, e) ->
    Rabs (IZR v - atan (/ IZR n) * IZR (2 ^ (bits + 16))) <= IZR e /\ (e <= bits + 18)%Z).
  { intros n v e N E. apply (atan_loop fuel n (bits + 16) N ltac:(lia) O) in E; try lia.
    - destruct E. split; [auto|lia].
    - simpl. rewrite Rmult_0_l, Rminus_0_r, Rabs_R0. lra. }
  destruct (atan_inverse fuel 18 (bits + 16) 0 0) as [[u d]|] eqn:E18; [|discriminate].
  destruct (atan_inverse fuel 57 (bits + 16) 0 0) as [[v e]|] eqn:E57; [|discriminate].
  destruct (atan_inverse fuel 239 (bits + 16) 0 0) as [[w f]|] eqn:E239; [|discriminate].
  destruct (A 18%Z _ _ ltac:(lia) E18) as [A1 L1]. destruct (A 57%Z _ _ ltac:(lia) E57) as [A2 L2].
  destruct (A 239%Z _ _ ltac:(lia) E239) as [A3 L3]. intros E. apply Some_injective in E. subst P.
  apply Rabs_le_between in A1, A2, A3. apply IZR_le in L1, L2, L3. rewrite plus_IZR in L1, L2, L3.
  set (total := (48 * u + 32 * v + -20 * w)%Z). set (lost := (48 * d + 32 * e + 20 * f)%Z).
  assert (G : IZR total - IZR lost <= PI * IZR (2 ^ (bits + 16)) <= IZR total + IZR lost).
  { unfold total, lost. rewrite gauss, !plus_IZR, !mult_IZR. lra. }
  assert (L : IZR lost <= 100 * (IZR bits + 18)). { unfold lost. rewrite !plus_IZR, !mult_IZR. lra. }
  pose proof (down_bound (total - lost) 16 ltac:(lia)) as D.
  pose proof (up_bound (total + lost) 16 ltac:(lia)) as Up.
  unfold up in Up. replace (- (total + lost))%Z with (- total - lost)%Z in Up by ring.
  unfold holds. cbn [lo hi]. rewrite Z.pow_add_r, mult_IZR in G by lia.
  rewrite minus_IZR in D. rewrite plus_IZR in Up. change (2 ^ 16)%Z with 65536%Z in *.
  repeat split; lra.
Qed.

(* Containment: the checker's sine and cosine. *)
From Coq Require Import Reals ZArith Psatz Lia List.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Arithmetic Operations Flight Series.
Open Scope R_scope.

(* The quarters of the circle: sin(n pi/2) and cos(n pi/2) by the last two bits of n. *)
Lemma quarters n :
  sin (INR n * (PI / 2)) = (if Z.odd (Z.of_nat n) then if Z.testbit (Z.of_nat n) 1 then -1 else 1 else 0) /\
  sin (PI / 2 + INR n * (PI / 2)) =
    (if Z.odd (Z.of_nat n) then 0 else if Z.testbit (Z.of_nat n) 1 then -1 else 1).
Proof.
  induction n as [n IH] using lt_wf_ind.
  destruct n as [|[|[|[|n]]]].
  - simpl. rewrite Rmult_0_l, Rplus_0_r, sin_0, sin_PI2. auto.
  - simpl. rewrite Rmult_1_l, sin_PI2. replace (PI / 2 + PI / 2) with PI by field. rewrite sin_PI. auto.
  - simpl. replace ((1 + 1) * (PI / 2)) with PI by field. rewrite sin_PI, sin_plus, sin_PI, cos_PI, sin_PI2, cos_PI2.
    lra.
  - simpl. replace ((1 + 1 + 1) * (PI / 2)) with (3 * (PI / 2)) by ring. rewrite sin_3PI2.
    replace (PI / 2 + 3 * (PI / 2)) with (2 * PI) by field. rewrite sin_2PI. auto.
  - specialize (IH n ltac:(lia)). replace (Z.of_nat (S (S (S (S n))))) with (Z.of_nat n + 2 * 2)%Z by lia.
    replace (Z.odd (Z.of_nat n + 2 * 2)) with (Z.odd (Z.of_nat n)) by (rewrite Z.odd_add_mul_2; auto).
    replace (Z.testbit (Z.of_nat n + 2 * 2) 1) with (Z.testbit (Z.of_nat n) 1).
    + replace (INR (S (S (S (S n)))) * (PI / 2)) with (INR n * (PI / 2) + 2 * INR 1 * PI)
        by (rewrite !S_INR; simpl; field).
      rewrite <- Rplus_assoc, !sin_period. exact IH.
    + rewrite !Z.testbit_odd, !Z.shiftr_div_pow2 by lia. change (2 ^ 1)%Z with 2%Z.
      rewrite Z.div_add by lia. change 2%Z with (2 * 1)%Z at 3. rewrite Z.odd_add_mul_2. auto.
Qed.

Section Series.
Variables r work : Z.
Hypothesis work_pos : (0 <= work)%Z.
Notation U := (IZR (2 ^ work)).
Notation rho := (IZR r / U).
Hypothesis small : Rabs rho <= 1.

Definition exact (n : nat) : R := rho ^ n / INR (fact n) * U.
Definition slack (n : nat) : R := match n with O => 0 | _ => 2 end.

Lemma exact_S n : exact (S n) = exact n * rho / INR (S n).
Proof.
  unfold exact. pose proof (unit_pos work work_pos). rewrite fact_simpl, mult_INR.
  pose proof (INR_fact_neq_0 n). assert (INR (S n) <> 0) by (apply not_0_INR; discriminate).
  rewrite <- tech_pow_Rmult. generalize dependent (INR (S n)). intros. field. repeat split; lra.
Qed.

Lemma next_term n term : Rabs (IZR term - exact n) <= slack n ->
  Rabs (IZR (Z.shiftr (term * r) work / Z.of_nat (S n)) - exact (S n)) <= 2.
Proof.
  intros H. pose proof (unit_pos work work_pos) as Up.
  rewrite Z.shiftr_div_pow2, Zdiv.Zdiv_Zdiv by (try apply Z.pow_nonneg; lia).
  set (q := (2 ^ work * Z.of_nat (S n))%Z). assert (q0 : q <> 0%Z).
  { unfold q. pose proof (Z.pow_pos_nonneg 2 work). nia. }
  pose proof (floor_bound (term * r) q q0) as F.
  assert (N : 1 <= INR (S n)) by (apply (le_INR 1); lia).
  replace (IZR (term * r) / IZR q) with (IZR term * rho / INR (S n)) in F.
  - rewrite exact_S. remember (IZR term - exact n) as e eqn:He.
    set (p := rho) in *. clearbody p. assert (G : Rabs (e * p / INR (S n)) <= 1).
    { unfold Rdiv. rewrite !Rabs_mult, (Rabs_pos_eq (/ INR (S n))) by (apply Rlt_le, Rinv_0_lt_compat; lra).
      apply Rmult_le_reg_r with (INR (S n)); [lra|]. rewrite Rmult_assoc, Rinv_l by lra.
      assert (Rabs e <= INR (S n)).
      { destruct n; simpl slack in H; [simpl; lra|]. assert (2 <= INR (S (S n))) by (apply (le_INR 2); lia). lra. }
      pose proof (Rabs_pos e). pose proof (Rabs_pos p). nra. }
    replace (IZR term * p / INR (S n)) with (e * p / INR (S n) + exact n * p / INR (S n)) in F
      by (rewrite He; unfold Rdiv; ring).
    apply Rabs_le_between in G. apply Rabs_le. lra.
  - unfold q. rewrite !mult_IZR, <- INR_IZR_INZ. field. split; lra.
Qed.

Lemma series_holds fuel : forall m sin_ cos_ term s c n,
  Rabs (IZR term - exact m) <= slack m ->
  Rabs (IZR sin_ - taylor 0 m rho * U) <= 2 * INR m ->
  Rabs (IZR cos_ - taylor (PI / 2) m rho * U) <= 2 * INR m ->
  series fuel r work sin_ cos_ term (Z.of_nat m) = Some (s, c, n) ->
  Rabs (IZR s - sin rho * U) <= 3 * IZR n + 2 /\ Rabs (IZR c - cos rho * U) <= 3 * IZR n + 2.
Proof.
  pose proof (unit_pos work work_pos) as Up. assert (one : 1 <= U) by (apply (IZR_le 1), (Z.pow_le_mono_r 2 0); lia).
  induction fuel as [|fuel IH]; intros m sin_ cos_ term s c n T S C E; [discriminate|].
  cbn [series] in E. destruct ((term =? 0)%Z || (term =? -1)%Z)%bool eqn:Stop.
  - assert (Z : -1 <= IZR term <= 0).
    { apply Bool.orb_true_iff in Stop. rewrite !Z.eqb_eq in Stop. destruct Stop as [-> | ->]; lra. }
    apply Some_injective in E. injection E as <- <- <-. rewrite <- INR_IZR_INZ.
    destruct m as [|m].
    { exfalso. unfold exact in T. simpl in T. rewrite Rabs_minus_sym, Rabs_pos_eq in T by lra. lra. }
    assert (M : 1 <= INR (Datatypes.S m)) by (apply (le_INR 1); lia).
    assert (G : Rabs rho ^ Datatypes.S (Datatypes.S m) / INR (fact (Datatypes.S (Datatypes.S m))) * U <= 3 / 2).
    { rewrite RPow_abs. rewrite <- (Rabs_pos_eq (INR (fact _))) by apply pos_INR.
      rewrite <- (Rabs_pos_eq U) at 2 by lra.
      rewrite <- Rabs_div by apply INR_fact_neq_0. rewrite <- Rabs_mult. fold (exact (Datatypes.S (Datatypes.S m))).
      rewrite exact_S. simpl slack in T. assert (A : Rabs (exact (Datatypes.S m)) <= 3).
      { apply Rabs_le_between in T. apply Rabs_le. lra. }
      assert (Q : 2 <= INR (Datatypes.S (Datatypes.S m))) by (apply (le_INR 2); lia).
      set (p := rho) in *. clearbody p. unfold Rdiv.
      rewrite !Rabs_mult, (Rabs_pos_eq (/ INR _)) by (apply Rlt_le, Rinv_0_lt_compat; lra). assert (I : / INR (Datatypes.S (Datatypes.S m)) <= / 2) by (apply Rinv_le_contravar; lra).
      assert (J : 0 < / INR (Datatypes.S (Datatypes.S m))) by (apply Rinv_0_lt_compat; lra).
      pose proof (Rabs_pos (exact (Datatypes.S m))). pose proof (Rabs_pos p).
      assert (Rabs (exact (Datatypes.S m)) * Rabs p <= 3) by nra.
      assert (0 <= Rabs (exact (Datatypes.S m)) * Rabs p) by nra. nra. }
    assert (Fin : forall a v, Rabs (IZR v - taylor a (Datatypes.S m) rho * U) <= 2 * INR (Datatypes.S m) ->
      Rabs (IZR v - sin (a + rho) * U) <= 3 * INR (Datatypes.S m) + 2).
    { intros a v V. pose proof (taylor_error (Datatypes.S m) a rho) as D.
      apply Rmult_le_compat_r with (r := U) in D; [|lra].
      rewrite <- (Rabs_pos_eq U) in D at 3 by lra. rewrite <- Rabs_mult in D.
      apply Rabs_le_between in V. apply Rabs_le.
      assert (D' : Rabs ((sin (a + rho) - taylor a (Datatypes.S m) rho) * U) <= 3 / 2) by lra.
      apply Rabs_le_between in D'. lra. }
    split; [rewrite <- (Rplus_0_l rho); apply Fin, S|].
    rewrite cos_sin. apply Fin, C.
  - cbv zeta in E. replace (Z.of_nat m + 1)%Z with (Z.of_nat (Datatypes.S m)) in E by lia.
    set (t := (Z.shiftr (term * r) work / Z.of_nat (Datatypes.S m))%Z) in *.
    assert (Nt : Rabs (IZR t - exact (Datatypes.S m)) <= 2) by (apply next_term, T).
    destruct (quarters (Datatypes.S m)) as [Q1 Q2].
    assert (step : forall a v x, Rabs (IZR v - taylor a m rho * U) <= 2 * INR m ->
      (exists z, Rabs z <= 1 /\ IZR x = z * IZR t /\ sin (a + INR (Datatypes.S m) * (PI / 2)) = z) ->
      Rabs (IZR (v + x) - taylor a (Datatypes.S m) rho * U) <= 2 * INR (Datatypes.S m)).
    { intros a v x V (z & Z1 & X & Zs). cbn [taylor]. rewrite Zs, plus_IZR, X, (S_INR m).
      replace (_ - _) with ((IZR v - taylor a m rho * U) + z * (IZR t - exact (Datatypes.S m)))
        by (unfold exact, Rdiv; ring).
      eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult.
      pose proof (Rabs_pos z). pose proof (Rabs_pos (IZR t - exact (Datatypes.S m))). nra. }
    assert (B : forall b : bool, exists z, Rabs z <= 1 /\ IZR (if b then - t else t)%Z = z * IZR t /\
      (if b then -1 else 1) = z).
    { intros [|]; [exists (-1); rewrite opp_IZR, Rabs_m1|exists 1; rewrite Rabs_R1]; repeat split; ring || lra. }
    assert (O : exists z, Rabs z <= 1 /\ IZR 0 = z * IZR t /\ 0 = z).
    { exists 0. rewrite Rabs_R0. repeat split; ring || lra. }
    destruct (Z.odd (Z.of_nat (Datatypes.S m))); (apply IH in E; [exact E|exact Nt| |]).
    + apply step; auto. rewrite Rplus_0_l, Q1. apply B.
    + rewrite <- (Z.add_0_r cos_). apply step; auto. rewrite Q2. apply O.
    + rewrite <- (Z.add_0_r sin_). apply step; auto. rewrite Rplus_0_l, Q1. apply O.
    + apply step; auto. rewrite Q2. apply B.
Qed.
End Series.

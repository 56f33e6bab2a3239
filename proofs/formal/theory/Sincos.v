(* Containment: the checker's sine and cosine. *)
From Coq Require Import Reals ZArith Psatz Lia List.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Arithmetic Operations Calculus Series.
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

Lemma clipped_holds bits guard v error h : (0 <= bits)%Z -> (0 <= guard)%Z -> Rabs h <= 1 ->
  Rabs (IZR v - h * IZR (2 ^ (bits + guard))) <= IZR error -> holds bits (clipped bits guard v error) h.
Proof.
  intros B G H1 H. pose proof (unit_pos bits B) as Ub. pose proof (unit_pos guard G) as Ug.
  apply Rabs_le_between in H1, H. rewrite Z.pow_add_r, mult_IZR in H by auto.
  pose proof (down_bound (v - error) guard G) as D. pose proof (up_bound (v + error) guard G) as Up.
  unfold up in Up. replace (- (v + error))%Z with (- v - error)%Z in Up by ring.
  rewrite minus_IZR in D. rewrite plus_IZR in Up.
  assert (L : (IZR v - IZR error) / IZR (2 ^ guard) <= h * IZR (2 ^ bits)) by (apply <- Rle_div_l; lra).
  assert (M : h * IZR (2 ^ bits) <= (IZR v + IZR error) / IZR (2 ^ guard)) by (apply -> Rle_div_r; lra).
  assert (N : - (1 * IZR (2 ^ bits)) <= h * IZR (2 ^ bits) <= 1 * IZR (2 ^ bits)) by (split; nra).
  unfold holds, clipped; simpl lo; simpl hi. rewrite opp_IZR in Up.
  rewrite max_IZR, min_IZR, !opp_IZR, !shiftl_unit by auto.
  split; [apply Rmax_lub|apply Rmin_glb]; lra.
Qed.

Lemma pi_near : 3.141 < PI < 3.148.
Proof.
  pose proof (atan_error 1 (/ 18)) as A. pose proof (atan_error 1 (/ 57)) as B.
  pose proof (atan_error 1 (/ 239)) as C. pose proof gauss.
  rewrite (Rabs_pos_eq (/ 18)) in A by lra. rewrite (Rabs_pos_eq (/ 57)) in B by lra.
  rewrite (Rabs_pos_eq (/ 239)) in C by lra. simpl in A, B, C.
  apply Rabs_le_between in A, B, C. lra.
Qed.

(* sin and cos of x + k pi / 2 *)
Lemma turned x k :
  sin (x + IZR k * (PI / 2)) = match (k mod 4)%Z with 0%Z => sin x | 1%Z => cos x | 2%Z => - sin x | _ => - cos x end /\
  cos (x + IZR k * (PI / 2)) = match (k mod 4)%Z with 0%Z => cos x | 1%Z => - sin x | 2%Z => - cos x | _ => sin x end.
Proof.
  pose proof (Z.mod_pos_bound k 4 ltac:(lia)) as B. pose proof (Z.div_mod k 4 ltac:(lia)) as E.
  assert (P : forall a, sin (a + IZR k * (PI / 2)) = sin (a + IZR (k mod 4) * (PI / 2))).
  { intros a. rewrite <- (sin_turns (a + IZR (k mod 4) * (PI / 2)) (k / 4)). f_equal.
    apply (f_equal IZR) in E. rewrite plus_IZR, mult_IZR in E. rewrite E. field. }
  rewrite (cos_sin (x + _)), <- Rplus_assoc, !P.
  assert (C : (k mod 4 = 0 \/ k mod 4 = 1 \/ k mod 4 = 2 \/ k mod 4 = 3)%Z) by lia.
  destruct C as [-> | [-> | [-> | ->]]]; rewrite ?Rmult_0_l, ?Rplus_0_r, ?Rmult_1_l, ?sin_plus, ?cos_plus;
    replace (2 * (PI / 2)) with PI by field; rewrite ?sin_PI2, ?cos_PI2, ?sin_PI, ?cos_PI, ?sin_3PI2, ?cos_3PI2; lra.
Qed.

Lemma lipschitz a b c : Rabs (sin (c + a) - sin (c + b)) <= Rabs (a - b).
Proof.
  replace (Rabs (a - b)) with (1 * Rabs (a - b) ^ 1 / INR 1) by (simpl; field).
  replace (sin (c + a)) with (sin (c + b + (a - b))) by (f_equal; ring).
  apply (compare (fun t => minus (sin (c + b + t)) (sin (c + b))) (fun t => minus (cos (c + b + t)) 0)).
  - rewrite Rplus_0_r. apply Rminus_eq_0.
  - intros t. apply (is_derive_minus (V := R_NormedModule)).
    + auto_derive; auto. ring.
    + apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
  - intros t. change (Rabs (cos (c + b + t) - 0) <= 1 * Rabs t ^ 0). rewrite Rminus_0_r, pow_O, Rmult_1_r. apply Rabs_le, COS_bound.
Qed.

(* The reduced argument: what is left of x after k quarters is within [r, r_hi]. *)
Lemma reduction bits x p q : (0 <= bits)%Z ->
  let guard := guard_bits x bits in let U := IZR (2 ^ (bits + guard)) in
  (bits + guard <= 2 ^ 17)%Z ->
  IZR p <= PI * U <= IZR q -> IZR q - IZR p <= 2 + 200 * (IZR (bits + guard) + 18) / 65536 ->
  let y := Z.shiftl x guard in let k := ((4 * y + p) / (2 * p))%Z in
  let r := Z.shiftr (Z.min (2 * y - k * p) (2 * y - k * q)) 1 in
  let r_hi := up (Z.max (2 * y - k * p) (2 * y - k * q)) 1 in
  let R := IZR x / IZR (2 ^ bits) - IZR k * (PI / 2) in
  0 < U /\ - U <= IZR r <= U /\ IZR r_hi <= U /\ IZR r <= R * U <= IZR r_hi.
Proof.
  intros B guard U W P D y k r r_hi R.
  assert (G0 : (12 <= guard)%Z) by (unfold guard, guard_bits; lia).
  set (G := IZR (2 ^ guard)). pose proof (unit_pos bits B) as Ub.
  assert (EU : U = IZR (2 ^ bits) * G) by (unfold U, G; rewrite Z.pow_add_r, mult_IZR by lia; auto).
  assert (G1 : 4096 <= G) by (apply (IZR_le (2 ^ 12)), Z.pow_le_mono_r; lia).
  assert (U1 : G <= U). { assert (1 <= IZR (2 ^ bits)) by (apply (IZR_le 1), (Z.pow_le_mono_r 2 0); lia). nra. }
  assert (Y : Rabs (IZR y) * 4096 <= U * G).
  { assert (Lx : (Z.abs x < 2 ^ bit_length x)%Z).
    { unfold bit_length. destruct (Z.eqb_spec x 0) as [->|N]; [simpl; lia|].
      replace (Z.log2 (Z.abs x) + 1)%Z with (Z.succ (Z.log2 (Z.abs x))) by lia. apply Z.log2_spec. lia. }
    assert (L : (Z.abs x * 2 ^ 12 <= 2 ^ bits * 2 ^ guard)%Z).
    { rewrite <- Z.pow_add_r by lia. apply Z.le_trans with (2 ^ bit_length x * 2 ^ 12)%Z; [lia|].
      rewrite <- Z.pow_add_r by (unfold bit_length; destruct (x =? 0)%Z; pose proof (Z.log2_nonneg (Z.abs x)); lia).
      apply Z.pow_le_mono_r; unfold guard, guard_bits; lia. }
    apply IZR_le in L. rewrite !mult_IZR, abs_IZR in L. fold G in L. unfold y.
    rewrite shiftl_unit, Rabs_mult, (Rabs_pos_eq (IZR (2 ^ guard))) by (fold G; lra || lia). fold G. nra. }
  assert (DD : IZR q - IZR p <= 403). { apply IZR_le in W. change (2 ^ 17)%Z with 131072%Z in W. lra. }
  pose proof pi_near as [Pi1 Pi2].
  assert (p1 : 3 * U <= IZR p) by nra. assert (p2 : IZR p <= 3.148 * U) by nra.
  assert (p0 : (2 * p <> 0)%Z) by (intros E; assert (Ep : p = 0%Z) by lia; rewrite Ep in p1; lra).
  pose proof (floor_bound (4 * y + p) (2 * p) p0) as F. fold k in F.
  rewrite plus_IZR, !mult_IZR in F. set (X := IZR y) in *. set (K := IZR k) in *. set (Q := IZR q) in *.
  assert (F1 : 2 * IZR p * K <= 4 * X + IZR p < 2 * IZR p * K + 2 * IZR p).
  { destruct F as [Fa Fb]. apply <- Rle_div_r in Fa; [|lra]. apply -> Rlt_div_l in Fb; [|lra]. lra. }
  assert (Yb : - (U * G) <= 4096 * X <= U * G) by (apply Rabs_le_between; rewrite Rabs_mult, (Rabs_pos_eq 4096) by lra; lra).
  assert (K1 : Rabs K <= G / 6144 + 3 / 2).
  { apply Rabs_le. split; apply Rmult_le_reg_l with (2 * IZR p); nra. }
  assert (KD : Rabs (K * (Q - IZR p)) <= (G / 6144 + 3 / 2) * 403).
  { rewrite Rabs_mult, (Rabs_pos_eq (Q - _)) by lra. pose proof (Rabs_pos K). nra. }
  apply Rabs_le_between in KD.
  assert (ER : R * U = (2 * X - K * (PI * U)) / 2).
  { unfold R, X, y. rewrite shiftl_unit, EU by lia. fold G. fold K. field. lra. }
  pose proof (down_bound (Z.min (2 * y - k * p) (2 * y - k * q)) 1 ltac:(lia)) as Dn. fold r in Dn.
  pose proof (up_bound (Z.max (2 * y - k * p) (2 * y - k * q)) 1 ltac:(lia)) as Up. fold r_hi in Up.
  change (2 ^ 1)%Z with 2%Z in *. rewrite min_IZR, !minus_IZR, !mult_IZR in Dn. rewrite max_IZR, !minus_IZR, !mult_IZR in Up.
  fold X K Q in Dn, Up.
  assert (KP : K * IZR p <= K * (PI * U) <= K * Q \/ K * Q <= K * (PI * U) <= K * IZR p).
  { destruct (Rle_dec 0 K); [left|right]; split; nra. }
  unfold Rmin in Dn. unfold Rmax in Up. rewrite ER.
  destruct (Rle_dec (2 * X - K * IZR p) (2 * X - K * Q)); repeat split; lra.
Qed.

Theorem sincos_at_holds fuel x bits S C first last : (0 <= bits)%Z -> (bits + guard_bits x bits <= 2 ^ 17)%Z ->
  sincos_at fuel x bits = Some (S, C, first, last) ->
  let t := IZR x / IZR (2 ^ bits) in
  holds bits S (sin t) /\ holds bits C (cos t) /\ IZR first * (PI / 2) <= t < (IZR last + 1) * (PI / 2).
Proof.
  intros B W E t. unfold sincos_at in E. cbv zeta in E.
  set (guard := guard_bits x bits) in *. assert (G0 : (12 <= guard)%Z) by (unfold guard, guard_bits; lia).
  destruct (pi fuel (bits + guard)) as [[p q]|] eqn:EP; [|discriminate].
  apply pi_holds in EP; [|lia]. destruct EP as [Hp Wp]. unfold holds in Hp. simpl in Hp, Wp.
  destruct (reduction bits x p q B W Hp Wp) as (U0 & r1 & rh & Rr). fold guard in U0, r1, rh, Rr.
  set (y := Z.shiftl x guard) in *. set (k := ((4 * y + p) / (2 * p))%Z) in *.
  set (r := Z.shiftr _ 1) in *. set (r_hi := up _ 1) in *. set (U := IZR (2 ^ (bits + guard))) in *.
  set (R := IZR x / IZR (2 ^ bits) - IZR k * (PI / 2)) in *.
  destruct (series _ _ _ _ _ _ _) as [[[s c] n]|] eqn:ES; [|discriminate].
  assert (One : IZR (Z.shiftl 1 (bits + guard)) = U) by (rewrite shiftl_unit by lia; fold U; ring).
  apply (series_holds r (bits + guard) ltac:(lia) ltac:(apply Rabs_le; fold U; split;
    [apply -> Rle_div_r; lra|apply <- Rle_div_l; lra]) fuel O) in ES.
  2: { unfold exact. simpl. rewrite One. fold U. apply Rabs_le. lra. }
  2: { simpl. rewrite sin_0. apply Rabs_le. lra. }
  2: { simpl. rewrite sin_PI2, One. fold U. apply Rabs_le. lra. }
  fold U in ES. destruct ES as [Es Ec].
  assert (rR : Rabs (IZR r / U - R) * U <= IZR r_hi - IZR r).
  { rewrite <- (Rabs_pos_eq U) at 2 by lra. rewrite <- Rabs_mult.
    replace ((IZR r / U - R) * U) with (IZR r - R * U) by (field; lra). apply Rabs_le. lra. }
  set (error := (3 * n + 2 + (r_hi - r))%Z) in *.
  assert (Val : forall a v, Rabs (IZR v - sin (a + IZR r / U) * U) <= 3 * IZR n + 2 ->
    holds bits (clipped bits guard v error) (sin (a + R))).
  { intros a v V. apply clipped_holds; try lia. { apply Rabs_le, SIN_bound. } fold U.
    unfold error. rewrite !plus_IZR, minus_IZR, mult_IZR.
    pose proof (lipschitz (IZR r / U) R a) as L. apply Rmult_le_compat_r with (r := U) in L; [|lra].
    replace (IZR v - sin (a + R) * U) with ((IZR v - sin (a + IZR r / U) * U) +
      (sin (a + IZR r / U) - sin (a + R)) * U) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_mult _ U), (Rabs_pos_eq U) by lra. lra. }
  assert (HS : holds bits (clipped bits guard s error) (sin R)).
  { rewrite <- (Rplus_0_l R). apply Val. rewrite Rplus_0_l. exact Es. }
  assert (HC : holds bits (clipped bits guard c error) (cos R)).
  { rewrite cos_sin. apply Val. rewrite <- cos_sin. exact Ec. }
  assert (Et : t = R + IZR k * (PI / 2)) by (unfold t, R; ring).
  destruct (turned R k) as [T1 T2]. rewrite <- Et in T1, T2. pose proof pi_near.
  assert (Bound : IZR (k - (if (r <=? 0)%Z then 1 else 0)) * (PI / 2) <= t <
    (IZR (k - (if (r_hi <? 0)%Z then 1 else 0)) + 1) * (PI / 2)).
  { rewrite Et, !minus_IZR. assert (-1 <= R <= 1) by (split; nra).
    split.
    - destruct (Z.leb_spec r 0); [lra|]. assert (0 < IZR r) by (apply IZR_lt; auto). assert (0 < R) by nra. lra.
    - destruct (Z.ltb_spec r_hi 0) as [L|L]; [|lra]. apply IZR_lt in L. assert (R < 0) by nra. lra. }
  apply Some_injective in E. rewrite T1, T2.
  destruct (k mod 4)%Z as [|[m|[m|m|]|]|m]; injection E as <- <- <- <-;
    (split; [|split; [|exact Bound]]); auto using neg_holds.
Qed.

(* -- intervals: between the ends lie at most the extrema that are put in -- *)

(* sin(j pi/2 + t) = 1 at the quarters t = m pi/2 with m + j = 1 mod 4. *)
Lemma peak j t : sin (IZR j * (PI / 2) + t) = 1 -> exists m, t = IZR m * (PI / 2) /\ ((m + j) mod 4 = 1)%Z.
Proof.
  intros H. assert (C : cos (IZR j * (PI / 2) + t) = 0).
  { pose proof (sin2_cos2 (IZR j * (PI / 2) + t)) as E. rewrite H in E. unfold Rsqr in E. nra. }
  destruct (cos_eq_0_0 _ C) as [k K]. destruct (turned 0 (2 * k + 1)) as [T _].
  replace (0 + IZR (2 * k + 1) * (PI / 2)) with (IZR j * (PI / 2) + t) in T
    by (rewrite K, plus_IZR, mult_IZR; field).
  rewrite H, sin_0, cos_0 in T. exists (2 * k + 1 - j)%Z. split.
  - rewrite minus_IZR, plus_IZR, mult_IZR. lra.
  - replace (2 * k + 1 - j + j)%Z with (2 * k + 1)%Z by ring.
    pose proof (Z.mod_pos_bound (2 * k + 1) 4 ltac:(lia)) as B.
    assert (D : ((2 * k + 1) mod 4 = 0 \/ (2 * k + 1) mod 4 = 1 \/ (2 * k + 1) mod 4 = 2 \/ (2 * k + 1) mod 4 = 3)%Z) by lia.
    destruct D as [D|[D|[D|D]]]; rewrite D in T; lra || exact D.
Qed.

Lemma between c a b x : a <= x <= b -> sin (c + x) <= Rmax (sin (c + a)) (sin (c + b)) \/
  exists t, a < t < b /\ sin (c + t) = 1.
Proof.
  intros X. set (f := fun t => sin (c + t)).
  assert (D : forall t, derivable_pt_lim f t (cos (c + t))).
  { intros t. apply is_derive_Reals. unfold f. auto_derive; auto. ring. }
  destruct (continuity_ab_maj f a b) as [t [M T]]; [lra| |].
  { intros t _. apply derivable_continuous_pt. exists (cos (c + t)). apply D. }
  pose proof (M x X) as Mx. unfold f in Mx.
  destruct (Req_dec t a) as [->|Na]; [left; eapply Rle_trans; [apply Mx|apply Rmax_l]|].
  destruct (Req_dec t b) as [->|Nb]; [left; eapply Rle_trans; [apply Mx|apply Rmax_r]|].
  assert (Z : cos (c + t) = 0).
  { set (pr := exist _ (cos (c + t)) (D t) : derivable_pt f t).
    rewrite <- (derive_pt_eq_0 f t _ pr (D t)). apply (deriv_maximum f a b t pr); try lra.
    intros s Sa Sb. apply M. lra. }
  pose proof (sin2_cos2 (c + t)) as E. rewrite Z in E. unfold Rsqr in E.
  destruct (Rlt_dec 0 (sin (c + t))) as [P|P].
  - right. exists t. split; [lra|nra].
  - left. assert (sin (c + t) = -1) by nra. pose proof (SIN_bound (c + a)).
    eapply Rle_trans; [|apply Rmax_l]. lra.
Qed.

(* Which bound the extremum at a turn sets: 0, 1 above cos and sin, 2, 3 below. *)
Definition bounds (bits : Z) (x : R) (V : enclosure * enclosure) (i : Z) : Prop :=
  let U := IZR (2 ^ bits) in
  match i with
  | 0%Z => cos x * U <= IZR (hi (snd V)) | 1%Z => sin x * U <= IZR (hi (fst V))
  | 2%Z => IZR (lo (snd V)) <= cos x * U | _ => IZR (lo (fst V)) <= sin x * U
  end.

Lemma extremum_bounds bits x V m i : (0 <= bits)%Z -> (0 <= i < 4)%Z ->
  bounds bits x V i \/ (m mod 4 = i)%Z -> bounds bits x (extremum bits V m) i.
Proof.
  intros B I H. destruct V as [S C]. pose proof (unit_pos bits B) as Ub.
  pose proof (SIN_bound x) as Sx. pose proof (COS_bound x) as Cx.
  assert (One : IZR (Z.shiftl 1 bits) = IZR (2 ^ bits)) by (rewrite shiftl_unit by auto; ring).
  pose proof (Z.mod_pos_bound m 4 ltac:(lia)) as M. unfold extremum.
  assert (Di : (i = 0 \/ i = 1 \/ i = 2 \/ i = 3)%Z) by lia.
  assert (Dm : (m mod 4 = 0 \/ m mod 4 = 1 \/ m mod 4 = 2 \/ m mod 4 = 3)%Z) by lia.
  destruct Dm as [Dm|[Dm|[Dm|Dm]]]; rewrite Dm in *; destruct Di as [->|[->|[->| ->]]];
    unfold bounds in *; simpl in *; rewrite ?opp_IZR, ?One; (destruct H as [H|H]; [|try discriminate]); nra.
Qed.

Lemma fold_bounds bits x i l : (0 <= bits)%Z -> (0 <= i < 4)%Z -> forall V,
  bounds bits x V i \/ (exists m, In m l /\ (m mod 4 = i)%Z) -> bounds bits x (fold_left (extremum bits) l V) i.
Proof.
  intros B I. induction l as [|m l IH]; intros V H; simpl.
  - destruct H as [H|(m & [] & _)]. exact H.
  - apply IH. destruct H as [H|(n & [->|N] & E)]; [left|left|right; eauto]; apply extremum_bounds; auto.
Qed.

Lemma in_turns first last m : (first < m <= last)%Z -> exists n, In n (turns first last) /\ (n mod 4 = m mod 4)%Z.
Proof.
  intros H. exists (first + 1 + (m - first - 1) mod 4)%Z.
  pose proof (Z.mod_pos_bound (m - first - 1) 4 ltac:(lia)).
  pose proof (Z.mod_le (m - first - 1) 4 ltac:(lia) ltac:(lia)). split.
  - apply in_map_iff. exists (Z.to_nat ((m - first - 1) mod 4)). split; [lia|]. apply in_seq. lia.
  - rewrite Z.add_mod_idemp_r by lia. f_equal. ring.
Qed.

Lemma ends u s p q P P' Q Q' : 0 < u -> P <= p * u <= P' -> Q <= q * u <= Q' ->
  (s <= Rmax p q -> s * u <= Rmax P' Q') /\ (- s <= Rmax (- p) (- q) -> Rmin P Q <= s * u).
Proof.
  intros U Hp Hq. split; intros H.
  - assert (s <= p \/ s <= q) as [G|G] by (unfold Rmax in H; destruct Rle_dec; auto);
      [eapply Rle_trans; [|apply Rmax_l]|eapply Rle_trans; [|apply Rmax_r]]; nra.
  - assert (p <= s \/ q <= s) as [G|G] by (unfold Rmax in H; destruct Rle_dec; lra);
      [eapply Rle_trans; [apply Rmin_l|]|eapply Rle_trans; [apply Rmin_r|]]; nra.
Qed.

Theorem sincos_holds fuel bits X S C x : (0 <= bits)%Z ->
  (bits + guard_bits (lo X) bits <= 2 ^ 17)%Z -> (bits + guard_bits (hi X) bits <= 2 ^ 17)%Z ->
  sincos fuel bits X = Some (S, C) -> holds bits X x -> holds bits S (sin x) /\ holds bits C (cos x).
Proof.
  intros B Wl Wh E Hx. unfold sincos in E. pose proof (unit_pos bits B) as Ub.
  destruct (sincos_at fuel (lo X) bits) as [[[[S0 C0] first] ?]|] eqn:El; [|discriminate].
  destruct (sincos_at_holds _ _ _ _ _ _ _ B Wl El) as (HS0 & HC0 & F & _).
  set (a := IZR (lo X) / IZR (2 ^ bits)) in *. unfold holds in Hx.
  assert (Ha : a <= x) by (unfold a; apply <- Rle_div_l; lra).
  destruct (Z.eqb_spec (lo X) (hi X)) as [Eq|_].
  { apply Some_injective in E. injection E as <- <-. rewrite <- Eq in Hx.
    replace x with a; auto. unfold a. apply Rmult_eq_reg_r with (IZR (2 ^ bits)); [|lra].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  destruct (sincos_at fuel (hi X) bits) as [[[[S1 C1] ?] last]|] eqn:Eh; [|discriminate].
  destruct (sincos_at_holds _ _ _ _ _ _ _ B Wh Eh) as (HS1 & HC1 & _ & L).
  set (b := IZR (hi X) / IZR (2 ^ bits)) in *.
  assert (Hb : x <= b) by (unfold b; apply -> Rle_div_r; lra).
  apply Some_injective in E. set (V := (hull S0 S1, hull C0 C1)) in *.
  pose proof pi_near.
  assert (Turn : forall j i, (i = (1 - j) mod 4)%Z -> (0 <= i < 4)%Z ->
    (sin (IZR j * (PI / 2) + x) <= Rmax (sin (IZR j * (PI / 2) + a)) (sin (IZR j * (PI / 2) + b)) -> bounds bits x V i) ->
    bounds bits x (fold_left (extremum bits) (turns first last) V) i).
  { intros j i Ei I W. apply fold_bounds; auto.
    destruct (between (IZR j * (PI / 2)) a b x ltac:(lra)) as [G|(t & T & G)]; [left; auto|right].
    destruct (peak j t G) as (m & -> & Em). destruct (in_turns first last m) as (n & N & En).
    - split; apply lt_IZR || (apply Zlt_succ_le, lt_IZR; rewrite succ_IZR); nra.
    - exists n. split; auto. rewrite En, Ei, <- Em. rewrite Zminus_mod_idemp_l. f_equal. ring. }
  assert (Q : forall y, sin (IZR 0 * (PI / 2) + y) = sin y /\ sin (IZR 1 * (PI / 2) + y) = cos y /\
    sin (IZR 2 * (PI / 2) + y) = - sin y /\ sin (IZR 3 * (PI / 2) + y) = - cos y).
  { intros y. rewrite !(Rplus_comm _ y). repeat split; apply turned. }
  destruct (Q x) as (X0 & X1 & X2 & X3), (Q a) as (A0 & A1 & A2 & A3), (Q b) as (B0 & B1 & B2 & B3).
  unfold holds in HS0, HS1, HC0, HC1.
  pose proof (Turn 0%Z 1%Z eq_refl ltac:(lia)) as T1. rewrite X0, A0, B0 in T1.
  pose proof (Turn 1%Z 0%Z eq_refl ltac:(lia)) as T0. rewrite X1, A1, B1 in T0.
  pose proof (Turn 2%Z 3%Z eq_refl ltac:(lia)) as T3. rewrite X2, A2, B2 in T3.
  pose proof (Turn 3%Z 2%Z eq_refl ltac:(lia)) as T2. rewrite X3, A3, B3 in T2.
  rewrite E in *. unfold bounds, V, hull in T0, T1, T2, T3. simpl in T0, T1, T2, T3.
  rewrite ?max_IZR, ?min_IZR in *. unfold holds.
  destruct (ends _ (sin x) (sin a) (sin b) _ _ _ _ Ub HS0 HS1), (ends _ (cos x) (cos a) (cos b) _ _ _ _ Ub HC0 HC1).
  auto.
Qed.

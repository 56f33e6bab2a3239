(* Calculus for flights: mean values, first zeros, implicit derivatives. No numbers, no impacts. *)
From Coq Require Import Reals Ranalysis5 ZArith Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Lemma mvt (f df : R -> R) (a b : R) :
  a < b -> (forall x, a <= x <= b -> is_derive f x (df x)) ->
  exists c, a <= c <= b /\ f b - f a = df c * (b - a).
Proof.
  intros ab D.
  destruct (MVT_gen f a b df) as [c [C E]].
  - rewrite Rmin_left, Rmax_right by lra. intros x X; apply D; lra.
  - rewrite Rmin_left, Rmax_right by lra. intros x X.
    apply continuity_pt_filterlim, (ex_derive_continuous f).
    exists (df x); apply D; lra.
  - rewrite Rmin_left, Rmax_right in C by lra. exists c; auto.
Qed.

Lemma ivt (f df : R -> R) (a b : R) :
  a < b -> (forall x, a <= x <= b -> is_derive f x (df x)) -> f b < 0 < f a ->
  exists c, a < c < b /\ f c = 0.
Proof.
  intros ab D [B A].
  destruct (IVT_interv (fun x => - f x) a b) as [c [C E]].
  - intros x X. apply continuity_pt_opp, continuity_pt_filterlim, (ex_derive_continuous f).
    exists (df x); auto.
  - auto.
  - lra.
  - lra.
  - exists c. assert (f c = 0) by lra. split; auto.
    destruct (Req_dec c a) as [->|]; [lra|]. destruct (Req_dec c b) as [->|]; [lra|]. lra.
Qed.

Lemma sin_turns x k : sin (x + 2 * IZR k * PI) = sin x.
Proof.
  assert (P : forall x n, sin (x + 2 * IZR (Z.of_nat n) * PI) = sin x).
  { intros y n. rewrite <- INR_IZR_INZ. apply sin_period. }
  destruct (Z_le_gt_dec 0 k).
  - rewrite <- (Z2Nat.id k) by auto. apply P.
  - rewrite <- (P _ (Z.to_nat (- k))). f_equal. rewrite Z2Nat.id, opp_IZR by lia. ring.
Qed.

Lemma positive_near (f : R -> R) x l : is_derive f x l -> 0 < f x -> locally x (fun y => 0 < f y).
Proof.
  intros D P. assert (C : continuous f x)
    by (apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule) f x); exists l; auto).
  apply (C (fun z => 0 < z)). exists (mkposreal _ P). intros z Z.
  unfold ball in Z; simpl in Z; unfold AbsRing_ball, abs, minus, plus, opp in Z; simpl in Z.
  apply Rabs_def2 in Z. lra.
Qed.

Lemma between_near (a b x : R) : a < x < b -> locally x (fun y => a <= y <= b).
Proof.
  intros H. assert (P : 0 < Rmin (x - a) (b - x)) by (apply Rmin_pos; lra).
  exists (mkposreal _ P). intros z Z.
  unfold ball in Z; simpl in Z; unfold AbsRing_ball, abs, minus, plus, opp in Z; simpl in Z.
  pose proof (Rmin_l (x - a) (b - x)). pose proof (Rmin_r (x - a) (b - x)).
  apply Rabs_def2 in Z. lra.
Qed.

(* The implicit derivative, in one variable. *)
Lemma implicit (G : R -> R -> R) (tau : R -> R) (x lx ly : R) :
  differentiable_pt_lim G x (tau x) lx ly -> ly <> 0 ->
  locally x (fun p => G p (tau p) = 0) ->
  (forall eps : posreal, locally x (fun p => Rabs (tau p - tau x) < eps)) ->
  is_derive tau x (- lx / ly).
Proof.
  intros D N Z C. apply is_derive_Reals. intros eps E.
  assert (Ny : 0 < Rabs ly) by (apply Rabs_pos_lt; auto).
  set (K := 1 + 2 * (Rabs lx + Rabs ly) / Rabs ly).
  assert (PK : 1 <= K).
  { unfold K. pose proof (Rabs_pos lx).
    assert (0 <= 2 * (Rabs lx + Rabs ly) / Rabs ly) by (apply Rdiv_le_0_compat; lra). lra. }
  set (e := Rmin (Rabs ly / 2) (eps * Rabs ly / (2 * K))).
  assert (Pe : 0 < e).
  { unfold e. apply Rmin_pos; [lra|]. apply Rdiv_lt_0_compat; nra. }
  assert (e1 : e <= Rabs ly / 2) by apply Rmin_l.
  assert (e2 : e <= eps * Rabs ly / (2 * K)) by apply Rmin_r.
  destruct (D (mkposreal e Pe)) as [d Hd]. simpl in Hd.
  assert (L : locally x (fun p => Rabs (p - x) < d)).
  { exists d. intros z Hz. exact Hz. }
  destruct (filter_and _ _ (filter_and _ _ Z (C d)) L) as [r Hr].
  exists r. intros h h0 hr.
  destruct (Hr (x + h)) as [[Z1 C1] L1].
  { unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl.
    replace (x + h + - x) with h by ring. auto. }
  assert (Z0 : G x (tau x) = 0).
  { destruct (Hr x) as [[? ?] ?]; auto. apply ball_center. }
  specialize (Hd (x + h) (tau (x + h)) L1 C1). rewrite Z1, Z0 in Hd.
  replace (x + h - x) with h in Hd by ring.
  set (k := tau (x + h) - tau x) in *.
  assert (H1 : Rabs (lx * h + ly * k) <= e * Rmax (Rabs h) (Rabs k)).
  { rewrite <- (Rabs_Ropp (lx * h + ly * k)).
    replace (- (lx * h + ly * k)) with (0 - 0 - (lx * h + ly * k)) by ring. auto. }
  assert (Ph : 0 < Rabs h) by (apply Rabs_pos_lt; auto).
  pose proof (Rabs_pos k) as Pk. pose proof (Rabs_pos lx) as Pl.
  assert (H2 : Rabs ly * Rabs k <= Rabs lx * Rabs h + Rabs (lx * h + ly * k)).
  { rewrite <- !Rabs_mult. replace (ly * k) with (- (lx * h) + (lx * h + ly * k)) at 1 by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (M : Rmax (Rabs h) (Rabs k) <= Rabs h + Rabs k) by (apply Rmax_lub; lra).
  assert (H3 : Rabs k <= (K - 1) * Rabs h).
  { apply Rmult_le_reg_l with (Rabs ly / 2); [lra|].
    replace (Rabs ly / 2 * ((K - 1) * Rabs h)) with ((Rabs lx + Rabs ly) * Rabs h)
      by (unfold K; field; lra).
    assert (e * Rmax (Rabs h) (Rabs k) <= Rabs ly / 2 * (Rabs h + Rabs k)).
    { apply Rmult_le_compat; try lra. eapply Rle_trans; [|apply Rmax_l]. lra. }
    nra. }
  assert (H4 : Rmax (Rabs h) (Rabs k) <= K * Rabs h).
  { apply Rmax_lub; nra. }
  assert (H5 : Rabs (lx * h + ly * k) < eps * Rabs ly * Rabs h).
  { eapply Rle_lt_trans; [apply H1|].
    apply Rle_lt_trans with (eps * Rabs ly / (2 * K) * (K * Rabs h)).
    - apply Rmult_le_compat; try lra. eapply Rle_trans; [|apply Rmax_l]. lra.
    - replace (eps * Rabs ly / (2 * K) * (K * Rabs h)) with (eps * Rabs ly * Rabs h / 2)
        by (field; lra).
      assert (0 < eps * Rabs ly * Rabs h) by (repeat apply Rmult_lt_0_compat; auto). lra. }
  replace (k / h - - lx / ly) with ((lx * h + ly * k) / (ly * h)) by (field; auto).
  rewrite Rabs_div, Rabs_mult by (apply Rmult_integral_contrapositive; auto).
  apply Rmult_lt_reg_r with (Rabs ly * Rabs h); [apply Rmult_lt_0_compat; auto|].
  replace (Rabs (lx * h + ly * k) / (Rabs ly * Rabs h) * (Rabs ly * Rabs h))
    with (Rabs (lx * h + ly * k)) by (field; lra). lra.
Qed.

(* A launch that does not fall at first, and accelerates upward. *)
Lemma rises (h h1 h2 : R -> R) T :
  (forall t, is_derive h t (h1 t)) -> (forall t, is_derive h1 t (h2 t)) ->
  h 0 = 0 -> 0 <= h1 0 -> (forall t, 0 <= t <= T -> 0 < h2 t) -> forall s, 0 < s <= T -> 0 < h s.
Proof.
  intros D1 D2 Z0 Z1 L.
  assert (Up : forall s, 0 < s <= T -> 0 < h1 s).
  { intros s S. destruct (mvt h1 h2 0 s) as [c [C Q]]; [lra|auto|].
    assert (0 < h2 c) by (apply L; lra). nra. }
  intros s S. destruct (mvt h h1 0 (s / 2)) as [c [C Q]]; [lra|auto|].
    destruct (mvt h h1 (s / 2) s) as [c' [C' Q']]; [lra|auto|].
    assert (0 < h1 c') by (apply Up; lra).
    assert (0 <= h1 c) by (destruct (Req_dec c 0) as [->|]; [auto|apply Rlt_le, Up; lra]). nra.
Qed.

(* One flight: a launch that does not fall at first, then positive, then falling through 0. *)
Lemma one_flight (h h1 h2 : R -> R) T u v :
  (forall t, is_derive h t (h1 t)) -> (forall t, is_derive h1 t (h2 t)) ->
  h 0 = 0 -> 0 <= h1 0 -> 0 < T /\ T <= u /\ u < v ->
  (forall t, 0 <= t <= T -> 0 < h2 t) -> (forall t, T <= t <= u -> 0 < h t) ->
  (forall t, u <= t <= v -> h1 t < 0) -> h v < 0 ->
  exists t, u < t < v /\ h t = 0 /\ forall s, 0 < s < t -> 0 < h s.
Proof.
  intros D1 D2 Z0 Z1 O L F D E.
  pose proof (rises h h1 h2 T D1 D2 Z0 Z1 L) as Launch.
  destruct (ivt h h1 u v) as [c [C Z]]; [lra|auto|split; [auto|apply F; lra]|].
  exists c. split; [auto|split; [auto|]]. intros s S.
  destruct (Rle_dec s T); [apply Launch; lra|]. destruct (Rle_dec s u); [apply F; lra|].
  destruct (mvt h h1 s c) as [d [? G]]; [lra|auto|]. assert (h1 d < 0) by (apply D; lra). nra.
Qed.

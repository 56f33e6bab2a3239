(* Generic lemmas on the flight: launch, first impact, implicit derivative. No numbers. *)
From Coq Require Import Reals Ranalysis5 ZArith Psatz.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact.
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

Section Model.
Variables side eta nu : R.
Hypothesis eta_pos : 0 < eta.

Notation gap := (gap side eta nu).
Notation first_impact := (first_impact side eta nu).
Notation next := (next side eta nu).

Definition gap_t (phi t : R) : R :=
  side * (- (1 + nu * sin phi) * (eta * sin (eta * t)) + nu * cos phi * cos (eta * t)
          - nu * cos (phi + t)).
Definition gap_tt (phi t : R) : R :=
  side * (- (1 + nu * sin phi) * (eta ^ 2 * cos (eta * t)) - nu * cos phi * (eta * sin (eta * t))
          + nu * sin (phi + t)).
Definition gap_p (phi t : R) : R :=
  side * (nu * cos phi * cos (eta * t) - nu * sin phi * sin (eta * t) / eta - nu * cos (phi + t)).
Definition slope (phi t : R) : R :=
  sin (eta * t) / eta * (side * (nu * sin phi * (1 - eta ^ 2) - eta ^ 2)) / gap_t phi t.

Lemma d_gap_t phi t : is_derive (gap phi) t (gap_t phi t).
Proof. unfold Impact.gap, gap_t. auto_derive; auto. field. lra. Qed.

Lemma d_gap_tt phi t : is_derive (gap_t phi) t (gap_tt phi t).
Proof. unfold gap_t, gap_tt. auto_derive; auto. ring. Qed.

Lemma d_gap_p phi t : is_derive (fun p => gap p t) phi (gap_p phi t).
Proof. unfold Impact.gap, gap_p. auto_derive; auto. field. lra. Qed.

Lemma gap_0 phi : gap phi 0 = 0.
Proof. unfold Impact.gap. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. field. lra. Qed.

Lemma gap_t_0 phi : gap_t phi 0 = 0.
Proof. unfold gap_t. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. ring. Qed.

(* Any motion X of the mass, a free oscillator that starts with the table, has this gap. *)
Lemma motion (X V : R -> R) phi :
  (forall t, is_derive X t (V t)) -> (forall t, is_derive V t (- eta ^ 2 * X t)) ->
  X 0 = 1 + nu * sin phi -> V 0 = nu * cos phi ->
  forall t, side * (X t - (1 + nu * sin (phi + t))) = gap phi t.
Proof.
  intros DX DV X0 V0 t.
  set (Y := fun t => (1 + nu * sin phi) * cos (eta * t) + nu * cos phi * sin (eta * t) / eta).
  set (W := fun t => - (1 + nu * sin phi) * (eta * sin (eta * t)) + nu * cos phi * cos (eta * t)).
  set (E := fun t => eta ^ 2 * (X t - Y t) ^ 2 + (V t - W t) ^ 2).
  assert (DY : forall t, is_derive Y t (W t)).
  { intros s. unfold Y, W. auto_derive; auto. field. lra. }
  assert (DW : forall t, is_derive W t (- eta ^ 2 * Y t)).
  { intros s. unfold Y, W. auto_derive; auto. field. lra. }
  assert (DE : forall t, is_derive E t 0).
  { intros s. unfold E. auto_derive.
    - repeat split; auto; eexists; [apply DX|apply DY|apply DV|apply DW].
    - replace (Derive (fun x => X x) s) with (V s) by (symmetry; apply is_derive_unique, DX).
      replace (Derive (fun x => Y x) s) with (W s) by (symmetry; apply is_derive_unique, DY).
      replace (Derive (fun x => V x) s) with (- eta ^ 2 * X s)
        by (symmetry; apply is_derive_unique, DV).
      replace (Derive (fun x => W x) s) with (- eta ^ 2 * Y s)
        by (symmetry; apply is_derive_unique, DW). ring. }
  assert (E0 : E 0 = 0).
  { unfold E, Y, W. rewrite X0, V0, Rmult_0_r, sin_0, cos_0. field. lra. }
  assert (Et : E t = 0).
  { destruct (Rtotal_order t 0) as [L|[->|L]]; auto.
    - destruct (mvt E (fun _ => 0) t 0) as [c [_ H]]; auto. lra.
    - destruct (mvt E (fun _ => 0) 0 t) as [c [_ H]]; auto. lra. }
  assert (X t = Y t).
  { unfold E in Et. assert (0 < eta ^ 2) by (apply pow_lt; auto).
    pose proof (pow2_ge_0 (X t - Y t)). pose proof (pow2_ge_0 (V t - W t)).
    assert ((X t - Y t) ^ 2 = 0) by nra.
    destruct (Req_dec (X t - Y t) 0) as [|N]; [lra|]. apply (pow_nonzero _ 2) in N. lra. }
  unfold Impact.gap. rewrite H. unfold Y. ring.
Qed.

(* The slope identity of proofs/model/equations.py. *)
Lemma slope_identity phi t : gap_t phi t <> 0 -> 1 + - gap_p phi t / gap_t phi t = slope phi t.
Proof.
  intros H. unfold slope.
  replace (sin (eta * t) / eta * (side * (nu * sin phi * (1 - eta ^ 2) - eta ^ 2)))
    with (gap_t phi t - gap_p phi t) by (unfold gap_t, gap_p; field; lra).
  field. auto.
Qed.

(* Launch: a double zero of positive second derivative. *)
Lemma launch phi T :
  (forall t, 0 <= t <= T -> 0 < gap_tt phi t) -> forall t, 0 < t <= T -> 0 < gap phi t.
Proof.
  intros A t Ht.
  assert (V : forall s, 0 < s <= T -> 0 < gap_t phi s).
  { intros s Hs. destruct (mvt (gap_t phi) (gap_tt phi) 0 s) as [c [C E]].
    - lra.
    - intros; apply d_gap_tt.
    - rewrite gap_t_0 in E. assert (0 < gap_tt phi c) by (apply A; lra).
      assert (0 < gap_tt phi c * (s - 0)) by (apply Rmult_lt_0_compat; lra). lra. }
  destruct (mvt (gap phi) (gap_t phi) (t / 2) t) as [c [C E]]; [lra|intros; apply d_gap_t|].
  assert (0 < gap_t phi c * (t - t / 2)) by (apply Rmult_lt_0_compat; [apply V|]; lra).
  destruct (mvt (gap phi) (gap_t phi) 0 (t / 2)) as [c' [C' E']]; [lra|intros; apply d_gap_t|].
  rewrite gap_0 in E'.
  destruct (Req_dec c' 0) as [->|N].
  - rewrite gap_t_0 in E'. lra.
  - assert (0 < gap_t phi c' * (t / 2 - 0)) by (apply Rmult_lt_0_compat; [apply V|]; lra). lra.
Qed.

Lemma first_impact_unique phi s t : first_impact phi s -> first_impact phi t -> s = t.
Proof.
  intros (S0 & S1 & S2) (T0 & T1 & T2).
  destruct (Rtotal_order s t) as [L|[E|L]]; auto.
  - specialize (T2 s ltac:(lra)). lra.
  - specialize (S2 t ltac:(lra)). lra.
Qed.

Lemma next_unique phi x y : next phi x -> next phi y -> x = y.
Proof.
  intros (s & j & S & X & X') (t & k & T & Y & Y').
  assert (s = t) by (eapply first_impact_unique; eauto). subst s.
  assert (j = k); [|subst; auto].
  assert (E : x - y = 2 * PI * IZR (k - j)) by (rewrite minus_IZR; lra).
  pose proof PI_RGT_0.
  assert (-1 < IZR (k - j) < 1) by nra.
  assert (-1 < k - j < 1)%Z by (split; apply lt_IZR; lra). lia.
Qed.

(* A branch of the impact time: what the numbers have to show for phi in [a, b]. *)
Record branch (a b T u v : R) : Prop := {
  br_order : 0 < T /\ T <= u /\ u < v;
  br_launch : forall phi t, a <= phi <= b -> 0 <= t <= T -> 0 < gap_tt phi t;
  br_flight : forall phi t, a <= phi <= b -> T <= t <= u -> 0 < gap phi t;
  br_fall : forall phi t, a <= phi <= b -> u <= t <= v -> gap_t phi t < 0;
  br_end : forall phi, a <= phi <= b -> gap phi v < 0
}.

Lemma branch_impact a b T u v : branch a b T u v ->
  forall phi, a <= phi <= b -> exists t, first_impact phi t /\ u < t < v.
Proof.
  intros [O L F D E] phi P.
  destruct (ivt (gap phi) (gap_t phi) u v) as [c [C Z]].
  - lra.
  - intros; apply d_gap_t.
  - split; [apply E; auto|apply F; auto; lra].
  - exists c. split; auto. split; [lra|]. split; auto. intros s S.
    destruct (Rle_dec s T). { apply (launch phi T); auto. lra. }
    destruct (Rle_dec s u). { apply F; auto. lra. }
    destruct (mvt (gap phi) (gap_t phi) s c) as [d [? G]]; [lra|intros; apply d_gap_t|].
    assert (gap_t phi d < 0) by (apply D; auto; lra).
    nra.
Qed.

(* A sharper bracket of the impact time, for a piece of the branch. *)
Lemma branch_bracket a b T u v : branch a b T u v ->
  forall phi t x y, a <= phi <= b -> first_impact phi t ->
  u <= x <= v -> u <= y <= v -> 0 < gap phi x -> gap phi y < 0 -> x < t < y.
Proof.
  intros B phi t x y P I X Y GX GY.
  destruct (branch_impact _ _ _ _ _ B phi P) as [s [I' S]].
  assert (s = t) by (eapply first_impact_unique; eauto). subst s.
  destruct B as [O L F D E]. destruct I as (I0 & I1 & I2).
  split.
  - destruct (Rlt_dec x t) as [|N]; auto. exfalso.
    destruct (Req_dec x t) as [->|]; [lra|].
    destruct (mvt (gap phi) (gap_t phi) t x) as [d [? G]]; [lra|intros; apply d_gap_t|].
    assert (gap_t phi d < 0) by (apply D; auto; lra). nra.
  - destruct (Rlt_dec t y) as [|N]; auto. exfalso.
    destruct (Req_dec t y) as [->|]; [lra|].
    specialize (I2 y). lra.
Qed.

(* The impact time as a function, and its derivative. *)
Definition impact_time (phi : R) : R := iota (first_impact phi).

Lemma impact_time_spec phi t : first_impact phi t -> impact_time phi = t.
Proof.
  intros I. apply (first_impact_unique phi); auto.
  apply (iota_correct (V := R_CompleteNormedModule) (first_impact phi)). exists t. split; auto.
  intros s S. apply (first_impact_unique phi); auto.
Qed.

Lemma branch_time a b T u v : branch a b T u v ->
  forall phi, a <= phi <= b -> first_impact phi (impact_time phi) /\ u < impact_time phi < v.
Proof.
  intros B phi P. destruct (branch_impact _ _ _ _ _ B phi P) as [t [I L]].
  rewrite (impact_time_spec _ _ I). auto.
Qed.

Lemma cont_2 (x y : R) : continuous (fun z : R * R => gap_p (fst z) (snd z)) (x, y).
Proof.
  unfold gap_p.
  assert (F : continuous (fun z : R * R => fst z) (x, y)) by apply continuous_fst.
  assert (S : continuous (fun z : R * R => snd z) (x, y)) by apply continuous_snd.
  assert (C : forall c : R, continuous (fun _ : R * R => c) (x, y))
    by (intros; apply continuous_const).
  assert (cc : forall h : R * R -> R, continuous h (x, y) ->
    continuous (fun z => cos (h z)) (x, y)).
  { intros h H. apply (continuous_comp h cos); auto.
    apply (ex_derive_continuous cos). exists (- sin (h (x, y))). apply is_derive_cos. }
  assert (ss : forall h : R * R -> R, continuous h (x, y) ->
    continuous (fun z => sin (h z)) (x, y)).
  { intros h H. apply (continuous_comp h sin); auto.
    apply (ex_derive_continuous sin). exists (cos (h (x, y))). apply is_derive_sin. }
  assert (M : forall h k : R * R -> R, continuous h (x, y) -> continuous k (x, y) ->
    continuous (fun z => h z * k z) (x, y)) by (intros; apply (continuous_mult h k); auto).
  assert (A : forall h k : R * R -> R, continuous h (x, y) -> continuous k (x, y) ->
    continuous (fun z => h z + k z) (x, y)) by (intros; apply (continuous_plus h k); auto).
  assert (D : forall h k : R * R -> R, continuous h (x, y) -> continuous k (x, y) ->
    continuous (fun z => h z - k z) (x, y)) by (intros; apply (continuous_minus h k); auto).
  unfold Rdiv.
  repeat lazymatch goal with
  | |- continuous (fun z => @?h z * @?k z) _ => apply (M h k)
  | |- continuous (fun z => @?h z + @?k z) _ => apply (A h k)
  | |- continuous (fun z => @?h z - @?k z) _ => apply (D h k)
  | |- continuous (fun z => cos (@?h z)) _ => apply (cc h)
  | |- continuous (fun z => sin (@?h z)) _ => apply (ss h)
  | |- continuous (fun z => fst z) _ => exact F
  | |- continuous (fun z => snd z) _ => exact S
  | |- continuous (fun _ => ?c) _ => exact (C c)
  end.
Qed.

Lemma gap_differentiable x y :
  differentiable_pt_lim gap x y (gap_p x y) (gap_t x y).
Proof.
  apply filterdiff_differentiable_pt_lim.
  apply (is_derive_filterdiff gap x y gap_p (gap_t x y)).
  - apply filter_forall. intros z. apply d_gap_p.
  - apply d_gap_t.
  - apply cont_2.
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

Lemma impact_time_continuous a b T u v : branch a b T u v ->
  forall phi, a < phi < b -> forall eps : posreal,
  locally phi (fun p => Rabs (impact_time p - impact_time phi) < eps).
Proof.
  intros B phi P eps.
  destruct (branch_time _ _ _ _ _ B phi ltac:(lra)) as [I L].
  set (t := impact_time phi) in *.
  assert (BB := branch_bracket a b T u v B). pose proof (cond_pos eps) as E.
  set (y := (t + Rmin v (t + eps)) / 2). set (x := (t + Rmax u (t - eps)) / 2).
  assert (Y : t < y < t + eps /\ u <= y <= v).
  { unfold y. pose proof (Rmin_l v (t + eps)). pose proof (Rmin_r v (t + eps)).
    assert (t < Rmin v (t + eps)) by (apply Rmin_glb_lt; lra). lra. }
  assert (X : t - eps < x < t /\ u <= x <= v).
  { unfold x. pose proof (Rmax_l u (t - eps)). pose proof (Rmax_r u (t - eps)).
    assert (Rmax u (t - eps) < t) by (apply Rmax_lub_lt; lra). lra. }
  assert (GX : 0 < gap phi x).
  { apply I. destruct B as [O _ _ _ _]. lra. }
  assert (GY : gap phi y < 0).
  { destruct I as (I0 & I1 & I2). destruct B as [O _ _ D _].
    destruct (mvt (gap phi) (gap_t phi) t y) as [d [? G]]; [lra|intros; apply d_gap_t|].
    assert (gap_t phi d < 0) by (apply D; lra). nra. }
  assert (NX : locally phi (fun p => 0 < gap p x))
    by (apply (positive_near (fun p => gap p x) phi (gap_p phi x)); auto; apply d_gap_p).
  assert (NY : locally phi (fun p => 0 < - gap p y)).
  { apply (positive_near (fun p => - gap p y) phi (- gap_p phi y)); [|lra].
    apply (is_derive_opp (fun p => gap p y) phi (gap_p phi y)). apply d_gap_p. }
  assert (NP : locally phi (fun p => a <= p <= b)) by (apply between_near; auto).
  generalize (filter_and _ _ (filter_and _ _ NX NY) NP). apply filter_imp.
  intros p [[QX QY] QP].
  destruct (branch_time _ _ _ _ _ B p QP) as [Ip Lp].
  assert (x < impact_time p < y) by (apply (BB p); auto; lra).
  apply Rabs_def1; lra.
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

Lemma branch_derivative a b T u v : branch a b T u v ->
  forall phi, a < phi < b ->
  is_derive (fun p => p + impact_time p) phi (slope phi (impact_time phi)).
Proof.
  intros B phi P.
  destruct (branch_time _ _ _ _ _ B phi ltac:(lra)) as [I L].
  assert (N : gap_t phi (impact_time phi) <> 0).
  { destruct B as [_ _ _ D _]. specialize (D phi (impact_time phi)). lra. }
  rewrite <- slope_identity by auto.
  apply (is_derive_plus (fun p => p) impact_time); [apply (is_derive_id phi)|].
  apply (implicit gap); auto.
  - apply gap_differentiable.
  - generalize (between_near a b phi P). apply filter_imp. intros p Q.
    apply (branch_time _ _ _ _ _ B p Q).
  - apply (impact_time_continuous _ _ _ _ _ B); auto.
Qed.

End Model.

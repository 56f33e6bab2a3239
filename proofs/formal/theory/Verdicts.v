(* The paper's claims on sets and slopes as printed, where they hold and where they fail. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Calculus Flight Shift Corrected Paths.
Open Scope R_scope.

Lemma shorter m lo z w : 0 < lo < m -> 0 <= z -> 0 < w -> m * z <= w -> z < w / lo.
Proof.
  intros L Z W H. apply Rmult_lt_reg_r with lo; [lra|].
  replace (w / lo * lo) with w by (field; lra). nra.
Qed.

Section Claims.
Variables side eta nu : R.
Hypothesis eta_pos : 0 < eta.
Notation gap := (gap side eta nu).
Notation slope := (slope side eta nu).
Notation first_impact := (first_impact side eta nu).
Notation next := (next side eta nu).
Notation slope_at := (slope_at side eta nu).
Notation impact_time := (impact_time side eta nu).
Notation branch := (branch side eta nu).
Notation lift := (lift side eta nu).

(* Every first impact has a phase in [0, 2 pi). *)
Lemma next_exists phi t : first_impact phi t -> exists psi, next phi psi.
Proof.
  intros I. pose proof PI_RGT_0. set (q := (phi + t) / (2 * PI)).
  exists (phi + t - 2 * PI * IZR (Int_part q)), t, (Int_part q). split; [auto|split; auto].
  destruct (base_Int_part q) as [L G].
  replace (phi + t) with (2 * PI * q) by (unfold q; field; lra). nra.
Qed.

(* A launch that is above the table at first and below it at a time v meets it before v. *)
Lemma impact_exists phi T v : 0 < T ->
  (forall t, 0 <= t <= T -> 0 < gap_tt side eta nu phi t) -> 0 < v -> gap phi v < 0 ->
  exists t, first_impact phi t.
Proof.
  intros T0 La v0 En.
  pose proof (launch side eta nu eta_pos phi T La) as Up.
  assert (Tv : T < v) by (apply Rnot_le_lt; intros G; specialize (Up v); lra).
  destruct (first_hit (fun t => - gap phi t) T v 0) as (t & It & Z & F); [lra| |specialize (Up T); lra|].
  { intros s _. apply continuity_pt_opp, continuity_pt_filterlim,
      (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)).
    eexists. apply (d_gap_t side eta nu eta_pos). }
  exists t. split; [lra|split; [lra|]]. intros s S. destruct (Rle_dec s T); [apply Up; lra|].
  specialize (F s ltac:(lra)). lra.
Qed.

Section Branch.
Variables a b T u v : R.
Hypothesis Br : branch a b T u v.
Let Re := branch_regular side eta nu eta_pos a b T u v Br.

(* The slope at one phase, by which H1, H2 and H3 are refuted. *)
Lemma slope_of_point p s t m M : a < p < b -> u <= s <= v /\ u <= t <= v ->
  0 < gap p s -> gap p t < 0 -> (forall r, s <= r <= t -> m <= slope p r <= M) ->
  exists d, slope_at p d /\ m <= d <= M.
Proof.
  intros P W G H S. exists (rate side eta nu p).
  split; [apply (slope_at_rate side eta nu a b Re p P)|].
  apply S. pose proof (branch_bracket side eta nu eta_pos a b T u v Br p s t ltac:(lra) (proj1 W) (proj2 W) G H). lra.
Qed.

(* The image of one phase, by which H4 is refuted. *)
Lemma image_of_point p s t k l r : a <= p <= b -> u <= s <= v /\ u <= t <= v ->
  0 < gap p s -> gap p t < 0 -> 0 <= l -> r < 2 * PI ->
  l <= p + s - 2 * PI * IZR k -> p + t - 2 * PI * IZR k <= r ->
  exists psi, next p psi /\ l <= psi <= r.
Proof.
  intros P W G H L R Ls Rt.
  pose proof (branch_bracket side eta nu eta_pos a b T u v Br p s t ltac:(lra) (proj1 W) (proj2 W) G H).
  exists (p + impact_time p - 2 * PI * IZR k). split; [|lra].
  exists (impact_time p), k. split; [|split; auto; lra].
  apply (re_impact _ _ _ _ _ Re p P).
Qed.

(* Two phases whose images are close, by which H6 is refuted. *)
Lemma long_preimage p s t k m M lo c0 d0 y : a < p < b -> u <= s <= v /\ u <= t <= v ->
  0 < gap p s -> gap p t < 0 -> (forall r, s <= r <= t -> m <= slope p r <= M) ->
  0 < m -> M < lo -> p < y -> 0 <= c0 -> d0 < 2 * PI ->
  c0 < p + s - 2 * PI * IZR k -> p + t - 2 * PI * IZR k < d0 ->
  exists c d q, (c0 <= c /\ c < d /\ d <= d0) /\ p < q <= y /\ next p c /\ next q d /\
    (d - c) / lo <= q - p.
Proof.
  intros P W G H S m0 Ml py C0 D0 Lc Ld.
  pose proof (branch_bracket side eta nu eta_pos a b T u v Br p s t ltac:(lra) (proj1 W) (proj2 W) G H) as I.
  specialize (S (impact_time p) ltac:(lra)). fold (rate side eta nu p) in S.
  assert (N : locally p (fun q => (0 <= q - p + (rate side eta nu p) / 2 /\ a < q < b /\ q < y) /\
    (c0 <= lift q - 2 * PI * IZR k <= d0) /\ m / 2 <= rate side eta nu q <= (M + lo) / 2)).
  { assert (Cr := rate_continuous side eta nu a b Re p P).
    assert (Cl : continuous lift p).
    { apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)).
      eexists. apply (lift_derive side eta nu a b Re p P). }
    assert (Nr : locally p (fun q => m / 2 <= rate side eta nu q <= (M + lo) / 2))
      by apply (Cr _ (between_near (m / 2) ((M + lo) / 2) (rate side eta nu p) ltac:(lra))).
    assert (Nl : locally p (fun q => c0 + 2 * PI * IZR k <= lift q <= d0 + 2 * PI * IZR k))
      by apply (Cl _ (between_near (c0 + 2 * PI * IZR k) (d0 + 2 * PI * IZR k) (lift p)
      ltac:(unfold lift; lra))).
    assert (Np := between_near (Rmax ((a + p) / 2) (p - rate side eta nu p / 2))
      (Rmin ((p + b) / 2) ((p + y) / 2)) p
      ltac:(split; [apply Rmax_lub_lt | apply Rmin_glb_lt]; lra)).
    generalize (filter_and _ _ (filter_and _ _ Nr Nl) Np). apply filter_imp.
    intros q [[Q1 Q2] Q3].
    pose proof (Rmax_l ((a + p) / 2) (p - rate side eta nu p / 2)).
    pose proof (Rmax_r ((a + p) / 2) (p - rate side eta nu p / 2)).
    pose proof (Rmin_l ((p + b) / 2) ((p + y) / 2)). pose proof (Rmin_r ((p + b) / 2) ((p + y) / 2)).
    repeat split; lra. }
  destruct N as [e He]. pose proof (cond_pos e).
  assert (Nz : forall z, p <= z <= p + e / 2 -> a < z < b /\ z < y /\
    (c0 <= lift z - 2 * PI * IZR k <= d0) /\ m / 2 <= rate side eta nu z <= (M + lo) / 2).
  { intros z Z. destruct (He z) as ((_ & Q1 & Q2) & Q3 & Q4); [|auto].
    unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl. apply Rabs_def1; lra. }
  set (q := p + e / 2) in *.
  destruct (mvt lift (rate side eta nu) p q) as [z [Z D]]; [unfold q; lra | |].
  { intros z Z. apply (lift_derive side eta nu a b Re), Nz. auto. }
  assert (pq : p < q) by (unfold q; lra).
  destruct (Nz p ltac:(lra)) as (_ & _ & Ip & _). destruct (Nz q ltac:(lra)) as (Aq & Yq & Iq & _).
  destruct (Nz z Z) as (_ & _ & _ & Rz).
  assert (Nx : forall w, a < w < b -> c0 <= lift w - 2 * PI * IZR k <= d0 ->
    next w (lift w - 2 * PI * IZR k)).
  { intros w Aw Iw. exists (impact_time w), k. split; [|split; [auto | lra]].
    apply (re_impact _ _ _ _ _ Re w). lra. }
  exists (lift p - 2 * PI * IZR k), (lift q - 2 * PI * IZR k), q.
  split; [nra|]. split; [lra|]. split; [auto|]. split; [auto|].
  apply Rmult_le_reg_r with lo; [lra|].
  replace ((lift q - 2 * PI * IZR k - (lift p - 2 * PI * IZR k)) / lo * lo) with (lift q - lift p)
    by (field; lra). rewrite D. nra.
Qed.

End Branch.

(* What the image of [x, y] misses, by which H5 is refuted. *)
Lemma missed a b x y s m M k : regular side eta nu a b -> monotone side eta nu a b x y s m M ->
  in_lap side eta nu a b k -> forall c d,
  (forall z, c <= z <= d -> s * (z + 2 * PI * IZR k) < s * lift x \/
                            s * lift y < s * (z + 2 * PI * IZR k)) ->
  forall p z, x <= p <= y -> next p z -> ~ c <= z <= d.
Proof.
  intros Re Mo L c d Mi p z P N Z. destruct (Mi z Z) as [G|G];
    pose proof (growth side eta nu a b Re x y s m M Mo) as Gr;
    destruct Mo as [O _ m0 _];
    apply (f_lift side eta nu a b Re k L p ltac:(lra)) in N;
    rewrite (proj1 (f_lift side eta nu a b Re k L p ltac:(lra))) in N;
    replace (z + 2 * PI * IZR k) with (lift p) in G by lra.
  - specialize (Gr x p ltac:(lra) ltac:(lra) ltac:(lra)). nra.
  - specialize (Gr p y ltac:(lra) ltac:(lra) ltac:(lra)). nra.
Qed.
End Claims.

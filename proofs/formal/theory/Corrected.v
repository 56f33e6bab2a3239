(* From numeric facts on two branches and on the gap between them to the horseshoe. No numbers. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Flight Shift.
Open Scope R_scope.

Section Corrected.
Variables side eta nu : R.
Hypothesis eta_pos : 0 < eta.
Notation gap := (gap side eta nu).
Notation gap_tt := (gap_tt side eta nu).
Notation slope := (slope side eta nu).
Notation first_impact := (first_impact side eta nu).
Notation next := (next side eta nu).
Notation impact_time := (impact_time side eta nu).
Notation branch := (branch side eta nu).

Definition f (phi : R) : R := iota (next phi).

(* All that is shown by numbers for one interval [x, y], inside (a, b), with images in lap k. *)
Record facts (a x y b T u v m M A B : R) (k : Z) : Prop := {
  fa_order : a < x /\ x < y /\ y < b;
  fa_branch : branch a b T u v;
  fa_lap : 0 <= a + u - 2 * PI * IZR k /\ b + v - 2 * PI * IZR k < 2 * PI;
  fa_slope : forall phi, x <= phi <= y -> m <= slope phi (impact_time phi) <= M;
  fa_low : x + impact_time x - 2 * PI * IZR k <= A;
  fa_high : B <= y + impact_time y - 2 * PI * IZR k
}.

Lemma f_spec phi psi : next phi psi -> f phi = psi.
Proof.
  intros H. apply (next_unique side eta nu phi); auto.
  apply (iota_correct (V := R_CompleteNormedModule) (next phi)). exists psi. split; auto.
  intros q Q. apply (next_unique side eta nu phi); auto.
Qed.

Lemma f_lift a b T u v k : branch a b T u v ->
  0 <= a + u - 2 * PI * IZR k /\ b + v - 2 * PI * IZR k < 2 * PI ->
  forall phi, a <= phi <= b -> f phi = phi + impact_time phi - 2 * PI * IZR k /\
    forall psi, next phi psi <-> psi = f phi.
Proof.
  intros Br L phi P. destruct (branch_time side eta nu eta_pos a b T u v Br phi P) as [I Q].
  assert (H : next phi (phi + impact_time phi - 2 * PI * IZR k)).
  { exists (impact_time phi), k. split; auto. split; auto. lra. }
  split. { apply f_spec, H. }
  intros psi. split.
  - intros G. symmetry. apply f_spec; auto.
  - intros ->. rewrite (f_spec _ _ H). auto.
Qed.

Lemma f_derive a b T u v k : branch a b T u v ->
  0 <= a + u - 2 * PI * IZR k /\ b + v - 2 * PI * IZR k < 2 * PI ->
  forall phi, a < phi < b -> is_derive f phi (slope phi (impact_time phi)).
Proof.
  intros Br L phi P.
  apply (is_derive_ext_loc (fun p => minus (p + impact_time p) (2 * PI * IZR k))).
  - generalize (between_near a b phi P). apply filter_imp. intros p Q.
    rewrite (proj1 (f_lift _ _ _ _ _ _ Br L p Q)). reflexivity.
  - replace (slope phi (impact_time phi)) with (minus (slope phi (impact_time phi)) zero)
      by (unfold minus, plus, opp, zero; simpl; ring).
    apply (is_derive_minus (fun p => p + impact_time p) (fun _ => 2 * PI * IZR k)).
    + apply (branch_derivative side eta nu eta_pos a b T u v); auto.
    + apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
Qed.

Lemma slope_continuous a b T u v : branch a b T u v ->
  forall phi, a < phi < b -> continuous (fun p => slope p (impact_time p)) phi.
Proof.
  intros Br phi P.
  apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)).
  pose proof (branch_derivative side eta nu eta_pos _ _ _ _ _ Br phi P) as D.
  assert (E : ex_derive impact_time phi).
  { apply (ex_derive_ext (fun p => (p + impact_time p) - p)). intros; simpl; ring.
    apply (ex_derive_minus (fun p => p + impact_time p) (fun p => p)).
    eexists; apply D. apply ex_derive_id. }
  destruct (branch_time side eta nu eta_pos _ _ _ _ _ Br phi ltac:(lra)) as [I Q].
  assert (Z : gap_t side eta nu phi (impact_time phi) <> 0).
  { destruct Br as [_ _ _ F _]. specialize (F phi (impact_time phi)). lra. }
  unfold Flight.slope, gap_t in *. auto_derive. repeat split; auto.
Qed.

(* The facts give all of f on one interval. *)
Lemma facts_interval a x y b T u v m M A B k : facts a x y b T u v m M A B k ->
  0 < m -> A <= B ->
  (forall p, x <= p <= y -> locally p (fun q => forall z, next q z <-> z = f q)) /\
  (forall p, x <= p <= y -> ex_derive f p /\ continuous (Derive f) p /\ m <= Derive f p <= M) /\
  (forall p q, x <= p <= y -> x <= q <= y -> p <= q -> m * (q - p) <= f q - f p <= M * (q - p)) /\
  (forall z, A <= z <= B -> exists p, x <= p <= y /\ f p = z).
Proof.
  intros [O Br L S Lo Hi] m0 AB.
  assert (D : forall p, a < p < b -> is_derive f p (slope p (impact_time p)))
    by (apply (f_derive _ _ _ _ _ _ Br L)).
  split; [|split; [|split]].
  - intros p P. generalize (between_near a b p ltac:(lra)). apply filter_imp.
    intros q Q. apply (f_lift _ _ _ _ _ _ Br L q Q).
  - intros p P. assert (Dp := D p ltac:(lra)). split; [eexists; apply Dp|].
    rewrite (is_derive_unique _ _ _ Dp). split; [|auto].
    apply (continuous_ext_loc _ (fun q => slope q (impact_time q))).
    + assert (P' : a < p < b) by lra.
      destruct (between_near a b p P') as [e He].
      assert (E2 : locally p (fun q => a < q < b)).
      { destruct (between_near ((a + p) / 2) ((p + b) / 2) p ltac:(lra)) as [d Hd].
        exists d. intros q Hq. specialize (Hd q Hq). lra. }
      generalize E2. apply filter_imp. intros q Q. symmetry. apply is_derive_unique, D, Q.
    + apply (slope_continuous a b T u v Br). lra.
  - intros p q P Q PQ. destruct (Req_dec p q) as [->|N]; [lra|].
    destruct (mvt f (fun p => slope p (impact_time p)) p q) as [c [C E]].
    + lra.
    + intros c C. apply D. lra.
    + rewrite E. specialize (S c ltac:(lra)). nra.
  - intros z Z.
    assert (fx : f x <= A) by (rewrite (proj1 (f_lift _ _ _ _ _ _ Br L x ltac:(lra))); lra).
    assert (fy : B <= f y) by (rewrite (proj1 (f_lift _ _ _ _ _ _ Br L y ltac:(lra))); lra).
    destruct (Req_dec (f x) z) as [E|N1]. { exists x. split; auto. lra. }
    destruct (Req_dec (f y) z) as [E|N2]. { exists y. split; auto. lra. }
    destruct (ivt (fun p => z - f p) (fun p => - slope p (impact_time p)) x y) as [c [C E]].
    + lra.
    + intros c C. replace (- slope c (impact_time c)) with (minus zero (slope c (impact_time c)))
        by (unfold minus, plus, opp, zero; simpl; ring).
      apply (is_derive_minus (fun _ => z) f).
      apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)). apply D. lra.
    + lra.
    + exists c. split; lra.
Qed.

(* No first impact of a phase in [x, y] has its phase in [A, B]. *)
Lemma escape x y T A B K v :
  0 <= x -> 0 <= A -> B - x <= T -> 0 < v -> T < 2 * PI -> y + v < A + 2 * PI * IZR K ->
  (forall phi t, x <= phi <= y -> 0 <= t <= T -> 0 < gap_tt phi t) ->
  (forall k phi psi, (1 <= k < K)%Z -> x <= phi <= y -> A <= psi <= B ->
     0 < gap phi (psi - phi + 2 * PI * IZR k)) ->
  (forall phi, x <= phi <= y -> gap phi v < 0) ->
  forall phi psi, x <= phi <= y -> next phi psi -> ~ A <= psi <= B.
Proof.
  intros x0 A0 BT v0 T2 yA La Fl En phi psi P (t & k & (I0 & I1 & I2) & E & R) S.
  pose proof PI_RGT_0 as Pi.
  destruct (Z_lt_le_dec k 1) as [k1|k1].
  - destruct (Z_lt_le_dec k 0) as [k0|k0].
    + assert (IZR k <= -1) by (apply (IZR_le k (-1)); lia). nra.
    + assert (k = 0%Z) by lia. subst k.
      assert (0 < gap phi t); [|lra]. apply (launch side eta nu eta_pos phi T); [|lra].
      intros s Hs. apply La; lra.
  - destruct (Z_lt_le_dec k K) as [kK|kK].
    + assert (H : 0 < gap phi (psi - phi + 2 * PI * IZR k)) by (apply Fl; auto; lra).
      replace (psi - phi + 2 * PI * IZR k) with t in H by lra. lra.
    + apply IZR_le in kK. assert (G := En phi P).
      assert (0 < gap phi v); [|lra]. apply I2. nra.
Qed.

(* The derivative of the map, whatever function it is called, at one phase. *)
Lemma slope_at a x y b T u v m M A B k : facts a x y b T u v m M A B k ->
  forall h p, x <= p <= y -> locally p (fun q => forall z, next q z <-> z = h q) ->
  Derive h p = slope p (impact_time p).
Proof.
  intros [O Br L _ _ _] h p P H.
  apply is_derive_unique, (is_derive_ext_loc f).
  - generalize (filter_and _ _ H (between_near a b p ltac:(lra))). apply filter_imp.
    intros q [Hq Q]. apply Hq. apply (f_lift _ _ _ _ _ _ Br L q Q). auto.
  - apply (f_derive _ _ _ _ _ _ Br L). lra.
Qed.

(* All images to the right of a phase lie above a number. *)
Lemma images_above a x y b T u v m M A B k : facts a x y b T u v m M A B k -> 0 < m -> A <= B ->
  forall c p, x <= p <= y -> c < p + impact_time p - 2 * PI * IZR k ->
  forall q z, p <= q <= y -> next q z -> c < z.
Proof.
  intros F m0 AB c p P H q z Q N.
  destruct (facts_interval _ _ _ _ _ _ _ _ _ _ _ _ F m0 AB) as (_ & _ & R & _).
  destruct F as [O Br L _ _ _].
  assert (E : z = f q) by (apply (f_lift _ _ _ _ _ _ Br L q ltac:(lra)); auto).
  specialize (R p q ltac:(lra) ltac:(lra) ltac:(lra)).
  rewrite (proj1 (f_lift _ _ _ _ _ _ Br L p ltac:(lra))) in R. nra.
Qed.

(* Slopes on a piece, and images of the ends, from brackets of the impact time. *)
Section Pieces.
Variables a b T u v : R.
Hypothesis Br : branch a b T u v.

Lemma piece p q s t m M : (a <= p /\ q <= b) -> (u <= s <= v /\ u <= t <= v) ->
  (forall phi, p <= phi <= q -> 0 < gap phi s) ->
  (forall phi, p <= phi <= q -> gap phi t < 0) ->
  (forall phi r, p <= phi <= q -> s <= r <= t -> m <= slope phi r <= M) ->
  forall phi, p <= phi <= q -> m <= slope phi (impact_time phi) <= M.
Proof.
  intros O W Lo Hi S phi P.
  destruct (branch_time side eta nu eta_pos _ _ _ _ _ Br phi ltac:(lra)) as [I _].
  assert (s < impact_time phi < t); [|apply S; auto; lra].
  apply (branch_bracket side eta nu eta_pos _ _ _ _ _ Br phi); auto; lra.
Qed.

Lemma bracket x s t : a <= x <= b -> (u <= s <= v /\ u <= t <= v) ->
  0 < gap x s -> gap x t < 0 -> first_impact x (impact_time x) /\ s < impact_time x < t.
Proof.
  intros X W G H. destruct (branch_time side eta nu eta_pos _ _ _ _ _ Br x X) as [I J].
  split; auto. apply (branch_bracket side eta nu eta_pos _ _ _ _ _ Br x); auto; lra.
Qed.

Lemma low x t A k : a <= x <= b -> u <= t <= v -> gap x t < 0 ->
  x + t - 2 * PI * IZR k <= A -> x + impact_time x - 2 * PI * IZR k <= A.
Proof.
  intros X W G L. destruct (branch_time side eta nu eta_pos _ _ _ _ _ Br x X) as [I J].
  assert (u < impact_time x < t); [|lra].
  apply (branch_bracket side eta nu eta_pos _ _ _ _ _ Br x); auto; try lra.
  destruct Br as [? _ F _ _]. apply F; lra.
Qed.

Lemma high x s B k : a <= x <= b -> u <= s <= v -> 0 < gap x s ->
  B <= x + s - 2 * PI * IZR k -> B <= x + impact_time x - 2 * PI * IZR k.
Proof.
  intros X W G L. destruct (branch_time side eta nu eta_pos _ _ _ _ _ Br x X) as [I J].
  assert (s < impact_time x < v); [|lra].
  apply (branch_bracket side eta nu eta_pos _ _ _ _ _ Br x); auto; try lra.
  destruct Br as [? _ _ _ E]. apply E; lra.
Qed.
End Pieces.

Theorem corrected a0 A b0 b0' T0 u0 v0 k0 a1' a1 B b1 T1 u1 v1 k1 m M :
  1 < m -> A < b0 < a1 /\ a1 < B ->
  facts a0 A b0 b0' T0 u0 v0 m M A B k0 ->
  facts a1' a1 B b1 T1 u1 v1 m M A B k1 ->
  (forall phi psi, b0 < phi < a1 -> next phi psi -> ~ A <= psi <= B) ->
  horseshoe next A b0 a1 B m M.
Proof.
  intros m1 O F0 F1 E.
  destruct (facts_interval _ _ _ _ _ _ _ _ _ _ _ _ F0 ltac:(lra) ltac:(lra)) as (P0 & Q0 & R0 & S0).
  destruct (facts_interval _ _ _ _ _ _ _ _ _ _ _ _ F1 ltac:(lra) ltac:(lra)) as (P1 & Q1 & R1 & S1).
  assert (M0 : 0 < M).
  { destruct (Q0 A ltac:(lra)) as (_ & _ & ?). lra. }
  split.
  - exists f. split; [|split; [|split]].
    + intros [|] x X; unfold In_ in X; auto.
    + intros [|] x X; unfold In_ in X; auto.
    + intros [|] x X; unfold In_; auto.
    + intros x y X Nx. apply (E x y); auto.
  - assert (Nf : forall i x y, In_ A b0 a1 B i x -> (next x y <-> y = f x)).
    { intros [|] x y X; unfold In_ in X.
      - apply (locally_singleton _ _ (P1 x X)).
      - apply (locally_singleton _ _ (P0 x X)). }
    assert (Ex : forall i x y, In_ A b0 a1 B i x -> In_ A b0 a1 B i y -> x <= y ->
      m * (y - x) <= f y - f x <= M * (y - x)).
    { intros [|] x y X Y; unfold In_ in X, Y; auto. }
    assert (Co : forall i y, A <= y <= B -> exists x, In_ A b0 a1 B i x /\ f x = y).
    { intros [|] y Y; unfold In_; auto. }
    split.
    + apply (cylinder_theorem next A b0 a1 B f m M); auto.
    + apply (shift_theorem next A b0 a1 B f m M); auto.
Qed.

End Corrected.

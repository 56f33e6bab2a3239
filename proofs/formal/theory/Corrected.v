(* From numeric facts on two branches and on the gap between them to the horseshoe. No numbers. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Rebounds Restitution Calculus Flight Shift.
Open Scope R_scope.

Section Corrected.
Variables side eta nu : R.
Hypothesis eta_pos : 0 < eta.
Notation gap := (gap side eta nu).
Notation gap_tt := (gap_tt side eta nu).
Notation slope := (slope side eta nu).
Notation first_impact := (first_impact side eta nu).
Notation next := (next side eta nu).
Notation slope_at := (slope_at side eta nu).
Notation impact_time := (impact_time side eta nu).
Notation branch := (branch side eta nu).

(* f, lifted to a continuous function; its derivative; f itself. *)
Definition lift (phi : R) : R := phi + impact_time phi.
Definition rate (phi : R) : R := slope phi (impact_time phi).
Definition f (phi : R) : R := iota (next phi).

Lemma f_spec phi psi : next phi psi -> f phi = psi.
Proof.
  intros H. apply (next_unique side eta nu phi); auto.
  apply (iota_correct (V := R_CompleteNormedModule) (next phi)). exists psi. split; auto.
  intros q Q. apply (next_unique side eta nu phi); auto.
Qed.

Lemma slope_at_unique phi d e : slope_at phi d -> slope_at phi e -> d = e.
Proof.
  intros (F & P & D) (G & Q & E). rewrite <- (is_derive_unique _ _ _ E).
  symmetry. apply is_derive_unique, (is_derive_ext_loc F); auto.
  generalize (filter_and _ _ P Q). apply filter_imp. intros p [I J].
  pose proof (first_impact_unique _ _ _ _ _ _ I J). lra.
Qed.

(* f near [a, b]: first impacts, transversal, with the slope formula for a derivative. *)
Record regular (a b : R) : Prop := {
  re_impact : forall phi, a <= phi <= b -> first_impact phi (impact_time phi);
  re_fall : forall phi, a <= phi <= b -> gap_t side eta nu phi (impact_time phi) < 0;
  re_derive : forall phi, a < phi < b -> is_derive lift phi (rate phi)
}.

Lemma glue a b c d : regular a b -> regular c d -> a <= c -> c < b -> b <= d -> regular a d.
Proof.
  intros [I F D] [I' F' D'] ac cb bd. split; intros phi P; destruct (Rlt_dec phi b).
  - apply I; lra.
  - apply I'; lra.
  - apply F; lra.
  - apply F'; lra.
  - apply D; lra.
  - apply D'; lra.
Qed.

Section Branch.
Variables a b T u v : R.
Hypothesis Br : branch a b T u v.

Lemma branch_regular : regular a b.
Proof.
  split; intros phi P.
  - apply (branch_time side eta nu eta_pos _ _ _ _ _ Br phi P).
  - apply (branch_falls side eta nu _ _ _ _ _ Br phi _ P). destruct (branch_time side eta nu eta_pos _ _ _ _ _ Br phi P). lra.
  - apply (branch_derivative side eta nu eta_pos a b T u v Br phi P).
Qed.

(* Bounds on f' on a piece [p, q], where the impact is at z + r (phi - p) up to d. *)
Lemma piece p q z r d m M : a <= p /\ q <= b ->
  (forall phi, p <= phi <= q -> u <= z + r * (phi - p) - d /\ z + r * (phi - p) + d <= v) ->
  0 < d ->
  (forall phi, p <= phi <= q -> 0 < gap phi (z + r * (phi - p) - d)) ->
  (forall phi, p <= phi <= q -> gap phi (z + r * (phi - p) + d) < 0) ->
  (forall phi e, p <= phi <= q -> - d <= e <= d -> m <= slope phi (z + r * (phi - p) + e) <= M) ->
  forall phi, p <= phi <= q -> m <= rate phi <= M.
Proof.
  intros O W D G H S phi P.
  assert (B : z + r * (phi - p) - d < impact_time phi < z + r * (phi - p) + d).
  { specialize (W phi P). apply (branch_bracket side eta nu eta_pos _ _ _ _ _ Br); auto; lra. }
  unfold rate. replace (impact_time phi)
    with (z + r * (phi - p) + (impact_time phi - (z + r * (phi - p)))) by ring.
  apply S; auto. lra.
Qed.

End Branch.

Section Regular.
Variables a b : R.
Hypothesis Re : regular a b.

Lemma lift_impact phi : a <= phi <= b -> first_impact phi (lift phi - phi).
Proof.
  intros P. unfold lift. replace (phi + impact_time phi - phi) with (impact_time phi) by ring.
  apply (re_impact _ _ Re phi P).
Qed.

Lemma lift_derive phi : a < phi < b -> is_derive lift phi (rate phi).
Proof. apply Re. Qed.

Lemma slope_at_rate phi : a < phi < b -> slope_at phi (rate phi).
Proof.
  intros P. exists lift. split; [|apply lift_derive; auto].
  generalize (between_near a b phi P). apply filter_imp. apply lift_impact.
Qed.

Lemma rate_continuous phi : a < phi < b -> continuous rate phi.
Proof.
  intros P. apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)).
  assert (E : ex_derive impact_time phi).
  { apply (ex_derive_ext (fun p => lift p - p)). { intros; unfold lift; simpl; ring. }
    apply (ex_derive_minus lift (fun p => p)); [eexists; apply lift_derive; auto | apply ex_derive_id]. }
  assert (Z : gap_t side eta nu phi (impact_time phi) <> 0).
  { pose proof (re_fall _ _ Re phi ltac:(lra)). lra. }
  unfold rate, Flight.slope, gap_t, height_t, kick in *. auto_derive. repeat split; auto.
Qed.

(* In lap k of the circle: f is the lift less k turns. *)
Definition in_lap (k : Z) : Prop := forall p, a <= p <= b -> 0 <= lift p - 2 * PI * IZR k < 2 * PI.

Lemma f_lift k : in_lap k -> forall phi, a <= phi <= b ->
  f phi = lift phi - 2 * PI * IZR k /\ forall psi, next phi psi <-> psi = f phi.
Proof.
  intros L phi P.
  assert (H : next phi (lift phi - 2 * PI * IZR k)).
  { exists (impact_time phi), k. split; [|split; auto]. apply (re_impact _ _ Re phi P). }
  split. { apply f_spec, H. }
  intros psi. split; [intros G; symmetry; apply f_spec; auto|].
  intros ->. rewrite (f_spec _ _ H). auto.
Qed.

Lemma f_derive k : in_lap k -> forall phi, a < phi < b -> is_derive f phi (rate phi).
Proof.
  intros L phi P.
  apply (is_derive_ext_loc (fun p => minus (lift p) (2 * PI * IZR k))).
  - generalize (between_near a b phi P). apply filter_imp. intros p Q.
    rewrite (proj1 (f_lift k L p Q)). reflexivity.
  - replace (rate phi) with (minus (rate phi) zero) by (unfold minus, plus, opp, zero; simpl; ring).
    apply (is_derive_minus lift (fun _ => 2 * PI * IZR k)); [apply lift_derive; auto|].
    apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
Qed.

Section Monotone.
(* s = 1: f increases on [x, y], s = -1: it decreases; there m <= |f'| <= M. *)
Variables x y s m M : R.
Record monotone : Prop := {
  mo_order : a < x /\ x < y /\ y < b;
  mo_sign : s = 1 \/ s = -1;
  mo_pos : 0 < m;
  mo_bounds : forall phi, x <= phi <= y -> m <= s * rate phi <= M
}.
Hypothesis Mo : monotone.

Lemma growth p q : x <= p -> p <= q -> q <= y ->
  m * (q - p) <= s * (lift q - lift p) <= M * (q - p).
Proof.
  destruct Mo as [O _ _ Bo]. intros P PQ Q. destruct (Req_dec p q) as [->|N]; [lra|].
  destruct (mvt lift rate p q) as [c [C E]]; [lra | intros c C; apply lift_derive; lra |].
  rewrite E. specialize (Bo c ltac:(lra)). nra.
Qed.

(* The paper's claim H3. *)
Lemma monotone_lift : exists F,
  (forall p, x <= p <= y -> continuous F p /\ first_impact p (F p - p)) /\
  forall p q, x <= p -> p < q -> q <= y -> 0 < s * (F q - F p).
Proof.
  exists lift. split.
  2: { intros p q P PQ Q. pose proof (growth p q P ltac:(lra) Q). destruct Mo as [_ _ m0 _]. nra. }
  destruct Mo as [O _ _ _]. intros p P. split.
  - apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)).
    exists (rate p). apply lift_derive. lra.
  - apply lift_impact. lra.
Qed.

(* The paper's claim H6: of an interval in I, the preimage is shorter by the factor m. *)
Lemma short_preimage A B : M * (y - x) + (B - A) < 2 * PI ->
  forall c d p q i j, A <= c -> d <= B -> x <= p -> p <= q -> q <= y ->
  next p i -> next q j -> c <= i <= d -> c <= j <= d -> m * (q - p) <= d - c.
Proof.
  intros W c d p q i j C D P PQ Q (t & k & Ft & Ei & _) (t' & k' & Ft' & Ej & _) I J.
  pose proof (growth p q P PQ Q) as G. destruct Mo as [O Si m0 _].
  assert (E : forall z w, x <= z <= y -> first_impact z w -> lift z = z + w).
  { intros z w Z F. unfold lift. f_equal. apply impact_time_spec; auto. }
  rewrite (E p t), (E q t') in G by (auto; lra).
  replace (q + t' - (p + t)) with (j - i + 2 * PI * IZR (k' - k)) in G by (rewrite minus_IZR; lra).
  assert (0 < M) by (specialize (E p t); destruct Mo as [_ _ _ H]; specialize (H x); lra).
  assert (M * (q - p) <= M * (y - x)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= m * (q - p)) by (apply Rmult_le_pos; lra).
  pose proof PI_RGT_0.
  assert (K : -1 < IZR (k' - k) < 1) by (destruct Si as [-> | ->]; nra).
  assert (Kz : (k' - k = 0)%Z) by (destruct K as [K K']; apply lt_IZR in K, K'; lia).
  rewrite Kz in G. destruct Si as [-> | ->]; lra.
Qed.

(* Off [x, y], rough bounds on the lift are enough. *)
Lemma lap k l r : (forall p, a <= p <= x \/ y <= p <= b -> l <= lift p <= r) ->
  0 <= l - 2 * PI * IZR k -> r - 2 * PI * IZR k < 2 * PI -> in_lap k.
Proof.
  intros H L R p P. destruct Mo as [O Si m0 _].
  assert (l <= lift p <= r); [|lra].
  destruct (Rle_dec p x); [apply H; lra|]. destruct (Rle_dec y p); [apply H; lra|].
  pose proof (H x ltac:(lra)). pose proof (H y ltac:(lra)).
  pose proof (growth x p ltac:(lra) ltac:(lra) ltac:(lra)).
  pose proof (growth p y ltac:(lra) ltac:(lra) ltac:(lra)).
  destruct Si as [S1 | S1]; rewrite S1 in *; nra.
Qed.

(* f maps [x, y] over [A, B], in lap k. *)
Record covers (A B : R) (k : Z) : Prop := {
  co_lap : in_lap k;
  co_low : s * lift x <= s * ((if Rlt_dec 0 s then A else B) + 2 * PI * IZR k);
  co_high : s * ((if Rlt_dec 0 s then B else A) + 2 * PI * IZR k) <= s * lift y
}.

Lemma covers_between A B k : covers A B k -> A <= B -> forall z, A <= z <= B ->
  s * f x <= s * z <= s * f y.
Proof.
  intros [L Lo Hi] AB z Z. destruct Mo as [O Si _ _].
  rewrite (proj1 (f_lift k L x ltac:(lra))), (proj1 (f_lift k L y ltac:(lra))).
  destruct (Rlt_dec 0 s), Si as [S1 | S1]; rewrite S1 in Lo, Hi |- *; lra.
Qed.

(* All of f on one interval. *)
Lemma covers_interval A B k : covers A B k -> A <= B ->
  (forall p, x <= p <= y -> locally p (fun q => forall z, next q z <-> z = f q)) /\
  (forall p, x <= p <= y -> ex_derive f p /\ continuous (Derive f) p /\ m <= s * Derive f p <= M) /\
  (forall p q, x <= p <= y -> x <= q <= y -> p <= q -> m * (q - p) <= s * (f q - f p) <= M * (q - p)) /\
  (forall z, A <= z <= B -> exists p, x <= p <= y /\ f p = z).
Proof.
  intros Co AB. pose proof (covers_between A B k Co AB) as Be. destruct Co as [L _ _].
  pose proof Mo as [O Si _ Bo]. assert (D := f_derive k L).
  split; [|split; [|split]].
  - intros p P. generalize (between_near a b p ltac:(lra)). apply filter_imp.
    intros q Q. apply (f_lift k L q Q).
  - intros p P. assert (Dp := D p ltac:(lra)). split; [eexists; apply Dp|].
    rewrite (is_derive_unique _ _ _ Dp). split; [|auto].
    apply (continuous_ext_loc _ rate); [|apply rate_continuous; lra].
    generalize (between_near ((a + p) / 2) ((p + b) / 2) p ltac:(lra)). apply filter_imp.
    intros q Q. symmetry. apply is_derive_unique, D. lra.
  - intros p q P Q PQ. pose proof (growth p q ltac:(lra) PQ ltac:(lra)) as G.
    rewrite (proj1 (f_lift k L p ltac:(lra))), (proj1 (f_lift k L q ltac:(lra))).
    replace (lift q - _ - _) with (lift q - lift p) by ring. auto.
  - intros z Z. specialize (Be z Z).
    destruct (Req_dec (f x) z) as [E|N1]. { exists x. split; auto. lra. }
    destruct (Req_dec (f y) z) as [E|N2]. { exists y. split; auto. lra. }
    destruct (ivt (fun p => s * (z - f p)) (fun p => s * (0 - rate p)) x y) as [c [C E]].
    + lra.
    + intros c C. apply (is_derive_scal (fun p => z - f p)), (is_derive_minus (fun _ => z) f).
      * apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
      * apply D. lra.
    + destruct Si as [S1 | S1]; rewrite S1 in Be |- *; lra.
    + exists c. split; [lra|]. destruct Si as [S1 | S1]; rewrite S1 in E; lra.
Qed.

End Monotone.
End Regular.

(* No first impact of a phase in [x, y] has its phase in [A, B]: the gap is positive up to time T,
   and whenever the table is in [A, B] in laps 1 to K - 1; at time v, before lap K, it is negative. *)
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

Section Two.
Variables a0 A b0 b0' a1' a1 B b1 : R.
Variables k0 k1 : Z.
Variables s0 s1 m M : R.
Hypothesis order : A < b0 < a1 /\ a1 < B.
Hypothesis m_pos : 0 < m.
Hypothesis Re0 : regular a0 b0'.
Hypothesis Re1 : regular a1' b1.
Hypothesis Mo0 : monotone a0 b0' A b0 s0 m M.
Hypothesis Mo1 : monotone a1' b1 a1 B s1 m M.
Hypothesis Co0 : covers a0 b0' A b0 s0 A B k0.
Hypothesis Co1 : covers a1' b1 a1 B s1 A B k1.
Hypothesis E : forall phi psi, b0 < phi < a1 -> next phi psi -> ~ A <= psi <= B.

Definition s (i : bool) : R := if i then s1 else s0.

(* What Shift.v needs of f. *)
Lemma shift_hypotheses : 0 < M /\ (forall i, s i = 1 \/ s i = -1) /\
  (forall i x y, In_ A b0 a1 B i x -> (next x y <-> y = f x)) /\
  (forall i x y, In_ A b0 a1 B i x -> In_ A b0 a1 B i y -> x <= y ->
    m * (y - x) <= s i * (f y - f x) <= M * (y - x)) /\
  (forall i x, In_ A b0 a1 B i x -> continuity_pt f x) /\
  (forall i y, A <= y <= B -> exists x, In_ A b0 a1 B i x /\ f x = y).
Proof.
  destruct (covers_interval _ _ Re0 _ _ _ _ _ Mo0 _ _ _ Co0 ltac:(lra)) as (P0 & Q0 & R0 & S0).
  destruct (covers_interval _ _ Re1 _ _ _ _ _ Mo1 _ _ _ Co1 ltac:(lra)) as (P1 & Q1 & R1 & S1).
  split. { destruct Mo0 as [O _ _ Bo]. specialize (Bo A ltac:(lra)). lra. }
  split. { intros [|]; [apply Mo1 | apply Mo0]. }
  split. { intros [|] x y X; [apply (locally_singleton _ _ (P1 x X)) | apply (locally_singleton _ _ (P0 x X))]. }
  split; [intros [|]; auto|split; [|intros [|]; auto]].
  intros i x X. apply continuity_pt_filterlim, (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)).
  destruct i; [apply (Q1 x X)|apply (Q0 x X)].
Qed.

Theorem two_preimages c d : A <= c -> c < d -> d <= B ->
  exists l0 r0 l1 r1, A <= l0 < r0 /\ r0 <= b0 /\ a1 <= l1 < r1 /\ r1 <= B /\
    forall x, A <= x <= B ->
    ((exists y, next x y /\ c <= y <= d) <-> l0 <= x <= r0 \/ l1 <= x <= r1).
Proof.
  destruct shift_hypotheses as (M0 & Si & Nf & Ex & Sm & Co).
  apply (preimages next A b0 a1 B f s m M); auto.
Qed.

Theorem corrected : 1 < m -> (forall phi, b0 < phi < a1 -> exists psi, next phi psi) ->
  horseshoe next A b0 a1 B s0 s1 m M.
Proof.
  intros m1 Meets. destruct shift_hypotheses as (M0 & Si & Nf & Ex & Sm & Co).
  split; [|split; [apply (cylinder_theorem next A b0 a1 B f s m M) |
    apply (shift_theorem next A b0 a1 B f s m M)]; auto].
  destruct (covers_interval _ _ Re0 _ _ _ _ _ Mo0 _ _ _ Co0 ltac:(lra)) as (P0 & Q0 & _).
  destruct (covers_interval _ _ Re1 _ _ _ _ _ Mo1 _ _ _ Co1 ltac:(lra)) as (P1 & Q1 & _).
  exists f. split; [|split; [|split]].
  - intros [|] x X; unfold In_ in X; auto.
  - intros [|] x X; unfold In_ in X; auto.
  - apply Co.
  - intros x X. split; [apply Meets, X | intros y Nx; apply (E x y); auto].
Qed.
End Two.
End Corrected.

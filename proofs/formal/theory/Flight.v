(* Flights after plastic impacts, those with restitution 0: first impacts, and f' in closed form. *)
From Coq Require Import Reals ZArith Psatz.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Rebounds Calculus Restitution.
Open Scope R_scope.

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
Definition slope (phi t : R) : R :=
  sin (eta * t) / eta * (side * (nu * sin phi * (1 - eta ^ 2) - eta ^ 2)) / gap_t phi t.

(* With restitution 0 the velocity before the impact does not matter. *)
Lemma plastic phi g t : height side eta nu 0 phi g t = gap phi t /\
  height_t side eta nu 0 phi g t = gap_t phi t /\ height_tt side eta nu 0 phi g t = gap_tt phi t.
Proof.
  unfold height, height_t, height_tt, kick, Impact.gap, gap_t, gap_tt. repeat split; field; lra.
Qed.

Lemma plastic_first phi g t : first side eta nu 0 phi g t <-> first_impact phi t.
Proof.
  unfold first, Impact.first_impact. rewrite (proj1 (plastic phi g t)).
  split; intros (A & B & C); split; auto; split; auto; intros s S; specialize (C s S);
    rewrite (proj1 (plastic phi g s)) in *; auto.
Qed.

Lemma d_gap_t phi t : is_derive (gap phi) t (gap_t phi t).
Proof. unfold Impact.gap, gap_t. auto_derive; auto. field. lra. Qed.

(* Any motion X of the mass, a free oscillator that starts with the table, has this gap. *)
Lemma motion (X V : R -> R) phi :
  (forall t, is_derive X t (V t)) -> (forall t, is_derive V t (- eta ^ 2 * X t)) ->
  X 0 = 1 + nu * sin phi -> V 0 = nu * cos phi ->
  forall t, side * (X t - (1 + nu * sin (phi + t))) = gap phi t.
Proof.
  intros DX DV X0 V0 t. rewrite <- (proj1 (plastic phi (- 0 / eta) t)).
  apply (motion_rebound side eta nu 0 eta_pos X V phi 0); auto. rewrite V0. ring.
Qed.

(* Launch: a double zero of positive second derivative. *)
Lemma launch phi T :
  (forall t, 0 <= t <= T -> 0 < gap_tt phi t) -> forall t, 0 < t <= T -> 0 < gap phi t.
Proof.
  apply (rises (gap phi) (gap_t phi)).
  - apply d_gap_t.
  - intros t. unfold gap_t, gap_tt. auto_derive; auto. ring.
  - unfold Impact.gap. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. field. lra.
  - right. unfold gap_t. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. ring.
Qed.

Lemma first_impact_unique phi s t : first_impact phi s -> first_impact phi t -> s = t.
Proof.
  intros (S0 & S1 & S2) (T0 & T1 & T2).
  destruct (Rtotal_order s t) as [L|[E|L]]; auto; [specialize (T2 s)|specialize (S2 t)]; lra.
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

Lemma branch_flights a b T u v : branch a b T u v -> flights side eta nu 0 a b (-1) 1 T u v.
Proof.
  intros [O L F D E]. split; auto; intros phi g; intros; rewrite ?(proj1 (plastic _ _ _)),
    ?(proj1 (proj2 (plastic _ _ _))), ?(proj2 (proj2 (plastic _ _ _))); auto. right. ring.
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
  intros B phi P.
  destruct (time_first _ _ _ _ eta_pos _ _ _ _ _ _ _ (branch_flights _ _ _ _ _ B) phi 0 P ltac:(lra)) as [I L].
  apply plastic_first in I. rewrite (impact_time_spec _ _ I). auto.
Qed.

(* A sharper bracket of the impact time, for a piece of the branch. *)
Lemma branch_bracket a b T u v : branch a b T u v ->
  forall phi t x y, a <= phi <= b -> first_impact phi t ->
  u <= x <= v -> u <= y <= v -> 0 < gap phi x -> gap phi y < 0 -> x < t < y.
Proof.
  intros B phi t x y P I X Y GX GY. apply (plastic_first phi 0) in I. rewrite <- (time_spec _ _ _ _ _ _ _ I).
  apply (time_bracket _ _ _ _ eta_pos _ _ _ _ _ _ _ (branch_flights _ _ _ _ _ B)); try lra;
    rewrite (proj1 (plastic _ _ _)); auto.
Qed.

Lemma branch_derivative a b T u v : branch a b T u v ->
  forall phi, a < phi < b ->
  is_derive (fun p => p + impact_time p) phi (slope phi (impact_time phi)).
Proof.
  intros B phi P. assert (Fl := branch_flights _ _ _ _ _ B).
  assert (E : forall p, a <= p <= b -> ph 0 1 p + tau side eta nu 0 0 1 0 0 p = p + impact_time p).
  { intros p Q. unfold tau, ph, ve. replace (0 + p * 1) with p by ring. replace (0 + p * 0) with 0 by ring.
    f_equal. apply time_spec, plastic_first, (branch_time _ _ _ _ _ B p Q). }
  apply (is_derive_ext_loc (fun p => ph 0 1 p + tau side eta nu 0 0 1 0 0 p)).
  { generalize (between_near a b phi P). apply filter_imp. exact E. }
  assert (D := phase_derive _ _ _ _ eta_pos _ _ _ _ _ _ _ Fl 0 1 0 0 phi ltac:(unfold inside, ph, ve; lra)).
  specialize (E phi ltac:(lra)). unfold tau, ph, ve in D, E.
  replace (0 + phi * 1) with phi in D, E by ring. replace (0 + phi * 0) with 0 in D, E by ring.
  destruct (branch_time _ _ _ _ _ B phi ltac:(lra)) as [I L].
  replace (time side eta nu 0 phi 0) with (impact_time phi) in D by lra.
  assert (N : gap_t phi (impact_time phi) < 0) by (destruct B as [_ _ _ F _]; apply F; lra).
  replace (slope phi (impact_time phi)) with (DP_p side eta nu 0 phi 0 (impact_time phi) * 1 +
    DP_g side eta nu 0 phi 0 (impact_time phi) * 0); [exact D|].
  unfold DP_p. rewrite (proj1 (proj2 (plastic phi 0 (impact_time phi)))).
  unfold slope. replace (sin (eta * impact_time phi) / eta * (side * (nu * sin phi * (1 - eta ^ 2) - eta ^ 2)))
    with (gap_t phi (impact_time phi) - height_p side eta nu 0 phi (impact_time phi))
    by (unfold gap_t, height_p, kick_p; field; lra).
  field. lra.
Qed.
End Model.

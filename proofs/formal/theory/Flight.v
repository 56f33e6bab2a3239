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

(* With restitution 0 the velocity before the impact does not matter. *)
Notation still := (fun h : R -> R -> R -> R => fun phi t => h phi 0 t).
Definition gap_t : R -> R -> R := still (height_t side eta nu 0).
Definition gap_tt : R -> R -> R := still (height_tt side eta nu 0).
Definition impact_time (phi : R) : R := time side eta nu 0 phi 0.
Definition slope (phi t : R) : R :=
  sin (eta * t) / eta * (side * (nu * sin phi * (1 - eta ^ 2) - eta ^ 2)) / gap_t phi t.

Lemma plastic phi t : height side eta nu 0 phi 0 t = gap phi t.
Proof. unfold height, kick, Impact.gap. field. lra. Qed.

Lemma plastic_first phi t : first side eta nu 0 phi 0 t <-> first_impact phi t.
Proof.
  unfold first, Impact.first_impact. rewrite plastic.
  split; intros (A & B & C); split; auto; split; auto; intros s S; specialize (C s S); rewrite plastic in *; auto.
Qed.

Lemma d_gap_t phi t : is_derive (gap phi) t (gap_t phi t).
Proof. apply (is_derive_ext (height side eta nu 0 phi 0)); [apply plastic|apply d_height_t]. Qed.

(* Any motion X of the mass, a free oscillator that starts with the table, has this gap. *)
Lemma motion (X V : R -> R) phi :
  (forall t, is_derive X t (V t)) -> (forall t, is_derive V t (- eta ^ 2 * X t)) ->
  X 0 = 1 + nu * sin phi -> V 0 = nu * cos phi ->
  forall t, side * (X t - (1 + nu * sin (phi + t))) = gap phi t.
Proof.
  intros DX DV X0 V0 t. rewrite <- plastic. replace 0 with (- 0 / eta) at 2 by (field; lra).
  apply (motion_rebound side eta nu 0 eta_pos X V phi 0); auto. rewrite V0. ring.
Qed.

(* Launch: a double zero of positive second derivative. *)
Lemma launch phi T :
  (forall t, 0 <= t <= T -> 0 < gap_tt phi t) -> forall t, 0 < t <= T -> 0 < gap phi t.
Proof.
  apply (rises (gap phi) (gap_t phi)); [apply d_gap_t|intros t; apply d_height_tt| |right];
    unfold Impact.gap, gap_t, height_t, kick; rewrite !Rmult_0_r, sin_0, cos_0, !Rplus_0_r; field; lra.
Qed.

Lemma first_impact_unique phi s t : first_impact phi s -> first_impact phi t -> s = t.
Proof.
  intros (S0 & S1 & S2) (T0 & T1 & T2).
  destruct (Rtotal_order s t) as [L|[E|L]]; auto; [specialize (T2 s)|specialize (S2 t)]; lra.
Qed.

Lemma impact_time_spec phi t : first_impact phi t -> impact_time phi = t.
Proof. intros I. apply time_spec, plastic_first, I. Qed.

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
Definition branch (a b T u v : R) : Prop := flights side eta nu 0 a b (-1) 1 T u v.

Section Branch.
Variables a b T u v : R.
Hypothesis Br : branch a b T u v.

Lemma branch_time phi : a <= phi <= b -> first_impact phi (impact_time phi) /\ u < impact_time phi < v.
Proof.
  intros P. destruct (time_first _ _ _ _ eta_pos _ _ _ _ _ _ _ Br phi 0 P ltac:(lra)) as [I L].
  apply plastic_first in I. auto.
Qed.

Lemma branch_falls phi t : a <= phi <= b -> u <= t <= v -> gap_t phi t < 0.
Proof. intros P. apply (fl_fall _ _ _ _ _ _ _ _ _ _ _ Br phi 0 t P). lra. Qed.

(* A sharper bracket of the impact time. *)
Lemma branch_bracket phi x y : a <= phi <= b -> u <= x <= v -> u <= y <= v ->
  0 < gap phi x -> gap phi y < 0 -> x < impact_time phi < y.
Proof.
  intros P X Y. rewrite <- !plastic. intros GX GY.
  apply (time_bracket _ _ _ _ eta_pos _ _ _ _ _ _ _ Br); lra.
Qed.

Lemma branch_derivative phi : a < phi < b -> is_derive (fun p => p + impact_time p) phi (slope phi (impact_time phi)).
Proof.
  intros P. destruct (branch_time phi ltac:(lra)) as [_ L]. pose proof (branch_falls phi (impact_time phi) ltac:(lra) ltac:(lra)) as N.
  assert (Is : forall p, ph 0 1 p = p /\ ve 0 0 p = 0) by (intros p; unfold ph, ve; split; ring).
  pose proof (phase_derive _ _ _ _ eta_pos _ _ _ _ _ _ _ Br 0 1 0 0 phi) as D. unfold inside, tau in D.
  rewrite (proj1 (Is phi)), (proj2 (Is phi)) in D. specialize (D ltac:(lra)).
  apply (is_derive_ext (fun p => ph 0 1 p + time side eta nu 0 (ph 0 1 p) (ve 0 0 p)));
    [intros p; rewrite (proj1 (Is p)), (proj2 (Is p)); reflexivity|].
  fold (impact_time phi) in D. set (t := impact_time phi) in *.
  replace (slope phi t) with (DP_p side eta nu 0 phi 0 t * 1 + DP_g side eta nu 0 phi 0 t * 0); [exact D|].
  unfold DP_p, slope. change (height_t side eta nu 0 phi 0 t) with (gap_t phi t).
  replace (sin (eta * t) / eta * (side * (nu * sin phi * (1 - eta ^ 2) - eta ^ 2)))
    with (gap_t phi t - height_p side eta nu 0 phi t) by (unfold gap_t, height_t, kick, height_p, kick_p; field; lra).
  field. lra.
Qed.
End Branch.
End Model.

(* From numeric facts on two rectangles to the two-sided shift of the rebounds. No numbers. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Histories Rebounds Calculus Crossed.
Open Scope R_scope.

Section Model.
Variables side eta nu eps : R.
Hypothesis eta_pos : 0 < eta.
Notation kick := (kick eta nu eps).
Notation height := (height side eta nu eps).
Notation arrival := (arrival eta nu eps).
Notation rebound := (rebound side eta nu eps).

(* Any motion X, V = X' of the mass, a free oscillator after the impact law v+ = -eps v- + (1 + eps) w
   with the table's velocity w, has this height; the second coordinate of a state is -X' / eta. *)
Theorem motion_rebound (X V : R -> R) phi before :
  (forall t, is_derive X t (V t)) -> (forall t, is_derive V t (- eta ^ 2 * X t)) ->
  X 0 = 1 + nu * sin phi -> V 0 = - eps * before + (1 + eps) * (nu * cos phi) ->
  forall t, side * (X t - (1 + nu * sin (phi + t))) = height phi (- before / eta) t /\
    arrival phi (- before / eta) t = - V t / eta.
Proof.
  intros DX DV X0 V0 t. set (g := - before / eta).
  set (Y := fun t => (1 + nu * sin phi) * cos (eta * t) + kick phi g * sin (eta * t)).
  set (W := fun t => - (1 + nu * sin phi) * (eta * sin (eta * t)) + kick phi g * (eta * cos (eta * t))).
  set (Z := fun t => eta ^ 2 * (X t - Y t) ^ 2 + (V t - W t) ^ 2).
  assert (DY : forall t, is_derive Y t (W t)) by (intros s; unfold Y, W; auto_derive; auto; ring).
  assert (DW : forall t, is_derive W t (- eta ^ 2 * Y t)) by (intros s; unfold Y, W; auto_derive; auto; ring).
  assert (DZ : forall t, is_derive Z t 0).
  { intros s. unfold Z. auto_derive.
    - repeat split; auto; eexists; [apply DX|apply DY|apply DV|apply DW].
    - replace (Derive (fun x => X x) s) with (V s) by (symmetry; apply is_derive_unique, DX).
      replace (Derive (fun x => Y x) s) with (W s) by (symmetry; apply is_derive_unique, DY).
      replace (Derive (fun x => V x) s) with (- eta ^ 2 * X s) by (symmetry; apply is_derive_unique, DV).
      replace (Derive (fun x => W x) s) with (- eta ^ 2 * Y s) by (symmetry; apply is_derive_unique, DW). ring. }
  assert (Z0 : Z 0 = 0).
  { unfold Z, Y, W. rewrite X0, V0, Rmult_0_r, sin_0, cos_0. unfold Rebounds.kick, g. field. lra. }
  assert (Zt : Z t = 0).
  { destruct (Rtotal_order t 0) as [L|[->|L]]; auto.
    - destruct (mvt Z (fun _ => 0) t 0) as [c [_ H]]; auto. lra.
    - destruct (mvt Z (fun _ => 0) 0 t) as [c [_ H]]; auto. lra. }
  unfold Z in Zt. assert (0 < eta ^ 2) by (apply pow_lt; auto).
  pose proof (pow2_ge_0 (X t - Y t)). pose proof (pow2_ge_0 (V t - W t)).
  assert (XY : X t = Y t). { assert (Q : (X t - Y t) ^ 2 = 0) by nra. destruct (Req_dec (X t - Y t) 0) as [|N]; [lra|]. apply (pow_nonzero _ 2) in N. lra. }
  assert (VW : V t = W t). { assert (Q : (V t - W t) ^ 2 = 0) by nra. destruct (Req_dec (V t - W t) 0) as [|N]; [lra|]. apply (pow_nonzero _ 2) in N. lra. }
  rewrite XY, VW. unfold Y, W, Rebounds.height, Rebounds.arrival. split; [ring|field; lra].
Qed.

Definition height_t (phi g t : R) : R :=
  side * (- (1 + nu * sin phi) * (eta * sin (eta * t)) + kick phi g * (eta * cos (eta * t)) - nu * cos (phi + t)).
Definition height_tt (phi g t : R) : R :=
  side * (- (1 + nu * sin phi) * (eta ^ 2 * cos (eta * t)) - kick phi g * (eta ^ 2 * sin (eta * t)) + nu * sin (phi + t)).
Definition kick_p (phi : R) : R := - (nu / eta * (1 + eps) * sin phi).
Definition height_p (phi t : R) : R :=
  side * (nu * cos phi * cos (eta * t) + kick_p phi * sin (eta * t) - nu * cos (phi + t)).
Definition height_g (t : R) : R := side * (eps * sin (eta * t)).
Definition arrival_t (phi g t : R) : R :=
  (1 + nu * sin phi) * (eta * cos (eta * t)) + kick phi g * (eta * sin (eta * t)).
Definition arrival_p (phi t : R) : R := nu * cos phi * sin (eta * t) - kick_p phi * cos (eta * t).
Definition arrival_g (t : R) : R := - (eps * cos (eta * t)).

(* The entries of DF at an impact. *)
Definition DP_p (phi g t : R) : R := 1 - height_p phi t / height_t phi g t.
Definition DP_g (phi g t : R) : R := - (height_g t / height_t phi g t).
Definition DQ_p (phi g t : R) : R := arrival_p phi t - arrival_t phi g t * (height_p phi t / height_t phi g t).
Definition DQ_g (phi g t : R) : R := arrival_g t - arrival_t phi g t * (height_g t / height_t phi g t).

Lemma d_height_t phi g t : is_derive (height phi g) t (height_t phi g t).
Proof. unfold Rebounds.height, height_t. auto_derive; auto. ring. Qed.

Lemma d_height_tt phi g t : is_derive (height_t phi g) t (height_tt phi g t).
Proof. unfold height_t, height_tt. auto_derive; auto. ring. Qed.

Definition first (phi g t : R) : Prop :=
  0 < t /\ height phi g t = 0 /\ forall s, 0 < s < t -> 0 < height phi g s.

Lemma first_unique phi g s t : first phi g s -> first phi g t -> s = t.
Proof.
  intros (S0 & S1 & S2) (T0 & T1 & T2).
  destruct (Rtotal_order s t) as [L|[E|L]]; auto; [specialize (T2 s)|specialize (S2 t)]; lra.
Qed.

Definition time (phi g : R) : R := iota (first phi g).

Lemma time_spec phi g t : first phi g t -> time phi g = t.
Proof.
  intros I. apply (first_unique phi g); auto.
  apply (iota_correct (V := R_CompleteNormedModule) (first phi g)). exists t. split; auto.
  intros s S. apply (first_unique phi g); auto.
Qed.

(* What the numbers have to show for phases in [a, b] and velocities in [d, e]. *)
Record flights (a b d e T u v : R) : Prop := {
  fl_order : 0 < T /\ T <= u /\ u < v;
  fl_possible : forall phi g, a <= phi <= b -> d <= g <= e -> 0 <= side * (eps * (eta * g + nu * cos phi));
  fl_launch : forall phi g t, a <= phi <= b -> d <= g <= e -> 0 <= t <= T -> 0 < height_tt phi g t;
  fl_flight : forall phi g t, a <= phi <= b -> d <= g <= e -> T <= t <= u -> 0 < height phi g t;
  fl_fall : forall phi g t, a <= phi <= b -> d <= g <= e -> u <= t <= v -> height_t phi g t < 0;
  fl_end : forall phi g, a <= phi <= b -> d <= g <= e -> height phi g v < 0
}.

Section Flights.
Variables a b d e T u v : R.
Hypothesis Fl : flights a b d e T u v.

Lemma time_first phi g : a <= phi <= b -> d <= g <= e -> first phi g (time phi g) /\ u < time phi g < v.
Proof.
  intros P G. destruct Fl as [O Po L F D E].
  destruct (one_flight (height phi g) (height_t phi g) (height_tt phi g) T u v) as (t & U & Z & S); auto.
  - apply d_height_t.
  - apply d_height_tt.
  - unfold Rebounds.height. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. ring.
  - replace (height_t phi g 0) with (side * (eps * (eta * g + nu * cos phi))); auto.
    unfold height_t, Rebounds.kick. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. field. lra.
  - assert (I : first phi g t) by (split; [lra|auto]). rewrite (time_spec _ _ _ I). auto.
Qed.

Lemma time_bracket phi g x y : a <= phi <= b -> d <= g <= e -> u <= x -> y <= v ->
  0 < height phi g x -> x <= v -> u <= y -> height phi g y < 0 -> x < time phi g < y.
Proof.
  intros P G X Y Hx Xv Yu Hy. destruct (time_first phi g P G) as [(I0 & I1 & I2) [L M]].
  destruct Fl as [O Po La F D E]. split.
  - destruct (Rlt_dec x (time phi g)) as [|N]; auto. exfalso.
    destruct (Req_dec x (time phi g)) as [E1|]; [rewrite E1 in Hx; lra|].
    destruct (mvt (height phi g) (height_t phi g) (time phi g) x) as [c [C Q]]; [lra|intros; apply d_height_t|].
    assert (height_t phi g c < 0) by (apply D; auto; lra). nra.
  - destruct (Rlt_dec (time phi g) y) as [|N]; auto. exfalso.
    destruct (Req_dec y (time phi g)) as [E1|]; [rewrite E1 in Hy; lra|]. specialize (I2 y). lra.
Qed.

(* Along a line of states. *)
Section Line.
Variables f0 df c0 dc : R.
Definition ph (s : R) : R := f0 + s * df.
Definition ve (s : R) : R := c0 + s * dc.
Definition inside (s : R) : Prop := a < ph s < b /\ d < ve s < e.
Definition H (s t : R) : R := height (ph s) (ve s) t.
Definition H_s (s t : R) : R := height_p (ph s) t * df + height_g t * dc.

Lemma d_H_s s t : is_derive (fun s => H s t) s (H_s s t).
Proof.
  unfold H, H_s, Rebounds.height, Rebounds.kick, height_p, height_g, kick_p, ph, ve.
  auto_derive; auto. field. lra.
Qed.

Lemma inside_near s : inside s -> locally s (fun r => a <= ph r <= b /\ d <= ve r <= e).
Proof.
  intros [P G]. apply filter_and.
  - assert (C : continuous ph s) by (apply (ex_derive_continuous ph); unfold ph; auto_derive; auto).
    apply (C (fun p => a <= p <= b)), between_near, P.
  - assert (C : continuous ve s) by (apply (ex_derive_continuous ve); unfold ve; auto_derive; auto).
    apply (C (fun p => d <= p <= e)), between_near, G.
Qed.

Definition tau (s : R) : R := time (ph s) (ve s).

Lemma tau_continuous s : inside s -> forall ep : posreal, locally s (fun r => Rabs (tau r - tau s) < ep).
Proof.
  intros Is ep. destruct Is as [P G]. destruct (time_first (ph s) (ve s) ltac:(lra) ltac:(lra)) as [I L].
  fold (tau s) in I, L. set (t := tau s) in *. pose proof (cond_pos ep) as E.
  set (y := (t + Rmin v (t + ep)) / 2). set (x := (t + Rmax u (t - ep)) / 2).
  assert (Y : t < y < t + ep /\ u <= y <= v).
  { unfold y. pose proof (Rmin_l v (t + ep)). pose proof (Rmin_r v (t + ep)).
    assert (t < Rmin v (t + ep)) by (apply Rmin_glb_lt; lra). lra. }
  assert (X : t - ep < x < t /\ u <= x <= v).
  { unfold x. pose proof (Rmax_l u (t - ep)). pose proof (Rmax_r u (t - ep)).
    assert (Rmax u (t - ep) < t) by (apply Rmax_lub_lt; lra). lra. }
  assert (GX : 0 < H s x). { apply I. destruct Fl as [O _ _ _ _ _]. lra. }
  assert (GY : H s y < 0).
  { destruct I as (I0 & I1 & I2). destruct Fl as [O _ _ _ D _].
    destruct (mvt (H s) (height_t (ph s) (ve s)) t y) as [c [C Q]]; [lra|intros; apply d_height_t|].
    assert (height_t (ph s) (ve s) c < 0) by (apply D; lra). unfold H in Q. unfold H. nra. }
  assert (NX : locally s (fun r => 0 < H r x))
    by (apply (positive_near (fun r => H r x) s (H_s s x)); auto; apply d_H_s).
  assert (NY : locally s (fun r => 0 < - H r y)).
  { apply (positive_near (fun r => - H r y) s (- H_s s y)); [|lra].
    apply (is_derive_opp (fun r => H r y) s (H_s s y)). apply d_H_s. }
  generalize (filter_and _ _ (filter_and _ _ NX NY) (inside_near s (conj P G))). apply filter_imp.
  intros r [[QX QY] [Rp Rg]]. assert (x < tau r < y) by (apply time_bracket; auto; unfold H in *; lra).
  apply Rabs_def1; lra.
Qed.

Ltac continuous_2 F S :=
  repeat lazymatch goal with
  | |- continuous (fun z => @?h z * @?k z) _ => apply (continuous_mult h k)
  | |- continuous (fun z => @?h z + @?k z) _ => apply (continuous_plus h k)
  | |- continuous (fun z => @?h z - @?k z) _ => apply (continuous_minus h k)
  | |- continuous (fun z => - @?h z) _ => apply (continuous_opp h)
  | |- continuous (fun z => cos (@?h z)) _ => apply (continuous_comp h cos); [|apply continuous_cos]
  | |- continuous (fun z => sin (@?h z)) _ => apply (continuous_comp h sin); [|apply continuous_sin]
  | |- continuous (fun z => fst z) _ => exact F
  | |- continuous (fun z => snd z) _ => exact S
  | |- continuous (fun _ => ?c) _ => apply continuous_const
  end.

Lemma tau_derive s : inside s ->
  is_derive tau s (- H_s s (tau s) / height_t (ph s) (ve s) (tau s)).
Proof.
  intros Is. pose proof Is as [P G]. destruct (time_first (ph s) (ve s) ltac:(lra) ltac:(lra)) as [_ L].
  apply (implicit H tau s (H_s s (tau s))).
  - apply filterdiff_differentiable_pt_lim.
    apply (is_derive_filterdiff H s (tau s) H_s (height_t (ph s) (ve s) (tau s))).
    + apply filter_forall. intros z. apply d_H_s.
    + apply d_height_t.
    + assert (F : continuous (fun z : R * R => fst z) (s, tau s)) by apply continuous_fst.
      assert (S : continuous (fun z : R * R => snd z) (s, tau s)) by apply continuous_snd.
      unfold H_s, height_p, height_g, kick_p, ph. continuous_2 F S.
  - destruct Fl as [_ _ _ _ D _]. assert (height_t (ph s) (ve s) (tau s) < 0) by (apply D; unfold tau; lra). lra.
  - generalize (inside_near s Is). apply filter_imp. intros r [Rp Rg]. apply (time_first (ph r) (ve r) Rp Rg).
  - apply tau_continuous, Is.
Qed.

Lemma phase_derive s : inside s -> is_derive (fun s => ph s + tau s) s
  (DP_p (ph s) (ve s) (tau s) * df + DP_g (ph s) (ve s) (tau s) * dc).
Proof.
  intros Is. pose proof (tau_derive s Is) as D. destruct Is as [P G].
  destruct (time_first (ph s) (ve s) ltac:(lra) ltac:(lra)) as [_ L].
  assert (N : height_t (ph s) (ve s) (tau s) < 0).
  { destruct Fl as [_ _ _ _ F _]. apply F; unfold tau; lra. }
  replace (DP_p _ _ _ * df + _) with (df + - H_s s (tau s) / height_t (ph s) (ve s) (tau s))
    by (unfold DP_p, DP_g, H_s; field; lra).
  apply (is_derive_plus ph tau); [unfold ph; auto_derive; auto; ring|exact D].
Qed.

Lemma arrival_derive s : inside s -> is_derive (fun s => arrival (ph s) (ve s) (tau s)) s
  (DQ_p (ph s) (ve s) (tau s) * df + DQ_g (ph s) (ve s) (tau s) * dc).
Proof.
  intros Is. pose proof (tau_derive s Is) as D. destruct Is as [P G].
  destruct (time_first (ph s) (ve s) ltac:(lra) ltac:(lra)) as [_ L].
  assert (N : height_t (ph s) (ve s) (tau s) < 0).
  { destruct Fl as [_ _ _ _ F _]. apply F; unfold tau; lra. }
  assert (Et : ex_derive (fun x => tau x) s) by (eexists; exact D).
  assert (Ep : ex_derive (fun x => ph x) s) by (unfold ph; auto_derive; auto).
  assert (Ev : ex_derive (fun x => ve x) s) by (unfold ve; auto_derive; auto).
  unfold Rebounds.arrival, Rebounds.kick. auto_derive.
  - repeat match goal with |- _ /\ _ => split end; assumption || exact Logic.I.
  - replace (Derive (fun x => tau x) s) with (- H_s s (tau s) / height_t (ph s) (ve s) (tau s))
      by (symmetry; apply is_derive_unique, D).
    replace (Derive (fun x => ph x) s) with df by (symmetry; apply is_derive_unique; unfold ph; auto_derive; auto; ring).
    replace (Derive (fun x => ve x) s) with dc by (symmetry; apply is_derive_unique; unfold ve; auto_derive; auto; ring).
    unfold DQ_p, DQ_g, H_s, arrival_t, arrival_p, arrival_g, Rebounds.kick.
    set (w := height_t (ph s) (ve s) (tau s)) in *. unfold kick_p. field. split; lra.
Qed.
End Line.

(* Bounds on DF at the impacts of a rectangle give those on differences. *)
Section Bounds.
Variables x y g0 g1 p q r s : R.
Hypothesis within : a < x /\ x < y /\ y < b /\ d < g0 /\ g1 < e.
Hypothesis derivatives : forall phi g, x <= phi <= y -> g0 <= g <= g1 ->
  p <= DP_p phi g (time phi g) /\ Rabs (DP_g phi g (time phi g)) <= q /\
  Rabs (DQ_p phi g (time phi g)) <= r /\ Rabs (DQ_g phi g (time phi g)) <= s.
Hypothesis p_pos : 0 < p.

Lemma on_line f0 c0 f1 c1 t : x <= f0 <= y -> x <= f1 <= y -> g0 <= c0 <= g1 -> g0 <= c1 <= g1 -> 0 <= t <= 1 ->
  x <= ph f0 (f1 - f0) t <= y /\ g0 <= ve c0 (c1 - c0) t <= g1.
Proof. intros. unfold ph, ve. split; split; nra. Qed.

Lemma differences f0 c0 f1 c1 : x <= f0 <= y -> x <= f1 <= y -> g0 <= c0 <= g1 -> g0 <= c1 <= g1 ->
  (p * Rabs (f1 - f0) <= Rabs (f1 + time f1 c1 - (f0 + time f0 c0)) + q * Rabs (c1 - c0) /\
    (f1 = f0 -> Rabs (f1 + time f1 c1 - (f0 + time f0 c0)) <= q * Rabs (c1 - c0))) /\
  Rabs (arrival f1 c1 (time f1 c1) - arrival f0 c0 (time f0 c0)) <= r * Rabs (f1 - f0) + s * Rabs (c1 - c0).
Proof.
  intros F0 F1 C0 C1. pose proof (fun t => on_line f0 c0 f1 c1 t F0 F1 C0 C1) as On.
  assert (Is : forall t, 0 <= t <= 1 -> inside f0 (f1 - f0) c0 (c1 - c0) t).
  { intros t Ht. destruct (On t Ht). unfold inside. lra. }
  assert (E0 : ph f0 (f1 - f0) 0 = f0 /\ ve c0 (c1 - c0) 0 = c0) by (unfold ph, ve; lra).
  assert (E1 : ph f0 (f1 - f0) 1 = f1 /\ ve c0 (c1 - c0) 1 = c1) by (unfold ph, ve; lra).
  destruct E0 as [Ep Ev], E1 as [Fp Fv]. split.
  - destruct (mvt (fun t => ph f0 (f1 - f0) t + tau f0 (f1 - f0) c0 (c1 - c0) t) (fun t =>
      DP_p (ph f0 (f1 - f0) t) (ve c0 (c1 - c0) t) (tau f0 (f1 - f0) c0 (c1 - c0) t) * (f1 - f0) +
      DP_g (ph f0 (f1 - f0) t) (ve c0 (c1 - c0) t) (tau f0 (f1 - f0) c0 (c1 - c0) t) * (c1 - c0)) 0 1) as [t [Ht Q]].
    + lra.
    + intros t Ht. apply phase_derive, Is, Ht.
    + unfold tau in Q. rewrite Ep, Ev, Fp, Fv in Q. destruct (On t Ht) as [Op Og].
      destruct (derivatives _ _ Op Og) as (D1 & D2 & _). rewrite Q.
      set (Dp := DP_p _ _ _) in *. set (Dg := DP_g _ _ _) in *.
      pose proof (Rabs_triang (Dp * (f1 - f0) + Dg * (c1 - c0)) (- (Dg * (c1 - c0)))) as Tr.
      replace (Dp * (f1 - f0) + Dg * (c1 - c0) + - (Dg * (c1 - c0))) with (Dp * (f1 - f0)) in Tr by ring.
      rewrite Rabs_Ropp in Tr. rewrite (Rabs_mult Dp), (Rabs_mult Dg), (Rabs_pos_eq Dp) in Tr by lra.
      pose proof (Rabs_pos (f1 - f0)). pose proof (Rabs_pos (c1 - c0)).
      assert (p * Rabs (f1 - f0) <= Dp * Rabs (f1 - f0)) by (apply Rmult_le_compat_r; lra).
      assert (Rabs Dg * Rabs (c1 - c0) <= q * Rabs (c1 - c0)) by (apply Rmult_le_compat_r; lra).
      replace ((Dp * (f1 - f0) + Dg * (c1 - c0)) * (1 - 0)) with (Dp * (f1 - f0) + Dg * (c1 - c0)) by ring.
      split; [lra|]. intros ->. rewrite Rminus_eq_0, Rmult_0_r, Rplus_0_l, Rabs_mult. lra.
  - destruct (mvt (fun t => arrival (ph f0 (f1 - f0) t) (ve c0 (c1 - c0) t) (tau f0 (f1 - f0) c0 (c1 - c0) t)) (fun t =>
      DQ_p (ph f0 (f1 - f0) t) (ve c0 (c1 - c0) t) (tau f0 (f1 - f0) c0 (c1 - c0) t) * (f1 - f0) +
      DQ_g (ph f0 (f1 - f0) t) (ve c0 (c1 - c0) t) (tau f0 (f1 - f0) c0 (c1 - c0) t) * (c1 - c0)) 0 1) as [t [Ht Q]].
    + lra.
    + intros t Ht. apply arrival_derive, Is, Ht.
    + unfold tau in Q. rewrite Ep, Ev, Fp, Fv in Q. destruct (On t Ht) as [Op Og].
      destruct (derivatives _ _ Op Og) as (_ & _ & D3 & D4). rewrite Q.
      set (Dp := DQ_p _ _ _) in *. set (Dg := DQ_g _ _ _) in *.
      replace ((Dp * (f1 - f0) + Dg * (c1 - c0)) * (1 - 0)) with (Dp * (f1 - f0) + Dg * (c1 - c0)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
      pose proof (Rabs_pos (f1 - f0)). pose proof (Rabs_pos (c1 - c0)).
      apply Rplus_le_compat; apply Rmult_le_compat_r; lra.
Qed.

Lemma line_covers g Y : g0 <= g <= g1 -> x + time x g <= Y <= y + time y g ->
  exists phi, x <= phi <= y /\ phi + time phi g = Y.
Proof.
  intros G [Lo Hi]. destruct (Req_dec (x + time x g) Y) as [E|N1]; [exists x; split; [lra|auto]|].
  destruct (Req_dec (y + time y g) Y) as [E|N2]; [exists y; split; [lra|auto]|].
  set (z := fun t => ph 0 1 t + tau 0 1 g 0 t).
  assert (Z : forall t, z t = t + time t g).
  { intros t. unfold z, tau, ph, ve. replace (0 + t * 1) with t by ring. replace (g + t * 0) with g by ring. auto. }
  destruct (ivt (fun t => minus Y (z t)) (fun t => minus 0 (DP_p (ph 0 1 t) (ve g 0 t) (tau 0 1 g 0 t) * 1 +
    DP_g (ph 0 1 t) (ve g 0 t) (tau 0 1 g 0 t) * 0)) x y) as [c [C E]].
  - lra.
  - intros t Ht. apply (is_derive_minus (fun _ => Y) z).
    + apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
    + apply phase_derive. unfold inside, ph, ve. lra.
  - change (Y - z y < 0 < Y - z x). rewrite !Z. lra.
  - change (Y - z c = 0) in E. rewrite Z in E. exists c. lra.
Qed.
End Bounds.
End Flights.

(* -- F is one-to-one: from an impact the flight runs back to its launch -- *)

Hypothesis side_not_0 : side <> 0.

Lemma run_back phi g t s : height phi g t = 0 ->
  height phi g (t - s) = side * ((1 + nu * sin (phi + t)) * cos (eta * s) + arrival phi g t * sin (eta * s)
    - 1 - nu * sin (phi + t - s)).
Proof.
  unfold Rebounds.height, Rebounds.arrival. intros Z.
  assert (W : (1 + nu * sin phi) * cos (eta * t) + kick phi g * sin (eta * t) = 1 + nu * sin (phi + t)).
  { apply Rmult_integral in Z. destruct Z; [contradiction|lra]. }
  rewrite <- W. replace (eta * (t - s)) with (eta * t - eta * s) by ring.
  replace (phi + (t - s)) with (phi + t - s) by ring. rewrite cos_minus, (sin_minus (eta * t)). ring.
Qed.

Lemma height_0 phi g : height phi g 0 = 0.
Proof. unfold Rebounds.height. rewrite Rmult_0_r, sin_0, cos_0, Rplus_0_r. ring. Qed.

Lemma not_later f g t k f' g' t' k' : first f g t -> first f' g' t' ->
  f + t - 2 * PI * IZR k = f' + t' - 2 * PI * IZR k' -> arrival f g t = arrival f' g' t' -> ~ t < t'.
Proof.
  intros (t0 & Z & _) (_ & Z' & Pos) E A L.
  assert (H' : 0 < height f' g' (t' - t)) by (apply Pos; lra).
  assert (H0 : height f g (t - t) = 0) by (rewrite Rminus_eq_0; apply height_0).
  rewrite run_back in H', H0 by auto. rewrite A in H0.
  assert (T : f' + t' = f + t + 2 * IZR (k' - k) * PI) by (rewrite minus_IZR; lra).
  replace (f' + t' - t) with (f + t - t + 2 * IZR (k' - k) * PI) in H' by lra.
  rewrite T, !sin_turns in H'. lra.
Qed.

Theorem rebound_injective z z' y : eps <> 0 -> Rabs (fst z - fst z') < 2 * PI ->
  rebound z y -> rebound z' y -> z = z'.
Proof.
  destruct z as [f g], z' as [f' g']. intros e0 Near (t & k & F & -> & _) (t' & k' & F' & E & _). simpl in *.
  injection E as E A. pose proof (not_later _ _ _ _ _ _ _ _ F F' E A) as N1.
  pose proof (not_later _ _ _ _ _ _ _ _ F' F (eq_sym E) (eq_sym A)) as N2.
  assert (t' = t) by lra. subst t'. pose proof PI_RGT_0.
  assert (D : f - f' = 2 * PI * IZR (k - k')) by (rewrite minus_IZR; lra).
  assert (Ek : (k - k' = 0)%Z).
  { rewrite D, Rabs_mult, (Rabs_pos_eq (2 * PI)), <- abs_IZR in Near by lra.
    assert (Ak : IZR (Z.abs (k - k')) < 1) by nra. apply lt_IZR in Ak. lia. }
  rewrite Ek in D. assert (f = f') by lra. subst f'. f_equal.
  destruct F as (_ & Z & _), F' as (_ & Z' & _). unfold Rebounds.height in Z, Z'. unfold Rebounds.arrival in A.
  apply Rmult_integral in Z, Z'. destruct Z as [|Z]; [contradiction|]. destruct Z' as [|Z']; [contradiction|].
  set (dk := kick f g - kick f g').
  assert (S : dk * sin (eta * t) = 0) by (unfold dk; lra). assert (C : dk * cos (eta * t) = 0) by (unfold dk; lra).
  assert (K : dk = 0).
  { pose proof (sin2_cos2 (eta * t)) as SC. unfold Rsqr in SC.
    replace dk with (dk * (sin (eta * t) * sin (eta * t) + cos (eta * t) * cos (eta * t))) by (rewrite SC; ring).
    replace (dk * (sin (eta * t) * sin (eta * t) + cos (eta * t) * cos (eta * t))) with
      (dk * sin (eta * t) * sin (eta * t) + dk * cos (eta * t) * cos (eta * t)) by ring. rewrite S, C. ring. }
  unfold dk, Rebounds.kick in K. apply Rmult_eq_reg_l with eps; auto. lra.
Qed.

(* -- the theorem -- *)

Section Two.
Variables A b0 a1 B g0 g1 p q r s c rate : R.

(* All that numbers show for the rectangle [x, y] x [g0, g1]: flights in a larger one, the lap k,
   bounds on DF, image velocities, and that the edges go beyond both rectangles. *)
Record rectangle_facts (a x y b d e T u v : R) (k : Z) : Prop := {
  rf_within : a < x /\ x < y /\ y < b /\ d < g0 /\ g1 < e;
  rf_flights : flights a b d e T u v;
  rf_rates : forall phi g, x <= phi <= y -> g0 <= g <= g1 ->
    p <= DP_p phi g (time phi g) /\ Rabs (DP_g phi g (time phi g)) <= q /\
    Rabs (DQ_p phi g (time phi g)) <= r /\ Rabs (DQ_g phi g (time phi g)) <= s;
  rf_velocity : forall phi g, x <= phi <= y -> g0 <= g <= g1 -> g0 <= arrival phi g (time phi g) <= g1;
  rf_lap : forall phi g, x <= phi <= y -> g0 <= g <= g1 -> 0 <= phi + time phi g - 2 * PI * IZR k < 2 * PI;
  rf_left : forall g, g0 <= g <= g1 -> x + time x g - 2 * PI * IZR k <= A;
  rf_right : forall g, g0 <= g <= g1 -> B <= y + time y g - 2 * PI * IZR k
}.

Theorem rebounds a d e T u v k b a' T' u' v' k' b' : eps <> 0 ->
  A < b0 < a1 /\ a1 < B -> B - A < 2 * PI -> g0 < g1 ->
  0 < p /\ 0 <= q /\ 0 <= r /\ 0 <= s /\ 0 < c /\ 0 <= rate < 1 ->
  1 + q * c <= rate * p -> r * rate + s * c <= rate * c ->
  rectangle_facts a A b0 b d e T u v k -> rectangle_facts a' a1 B b' d e T' u' v' k' ->
  two_sided_shift rebound A b0 a1 B g0 g1 rate.
Proof.
  intros E0 O W G S R1 R2 F0 F1.
  set (x0 (i : bool) := if i then a1 else A). set (x1 (i : bool) := if i then B else b0). set (n (i : bool) := if i then k' else k).
  assert (F : forall i, exists l r T u v, rectangle_facts l (x0 i) (x1 i) r d e T u v (n i)) by (intros [|]; eauto 6).
  clear F0 F1. set (lap (z : R * R) := if Rle_dec (fst z) b0 then k else k').
  set (P (z : R * R) := fst z + time (fst z) (snd z) - 2 * PI * IZR (lap z)).
  set (Q (z : R * R) := arrival (fst z) (snd z) (time (fst z) (snd z))).
  assert (Lap : forall i z, x0 i <= fst z <= x1 i -> lap z = n i).
  { intros [|] z; unfold x0, x1, n, lap; destruct Rle_dec; auto; lra. }
  assert (In : forall i x, x0 i <= x <= x1 i -> A <= x <= B) by (intros [|] x; unfold x0, x1; lra).
  assert (R' : forall i z, rectangle A b0 a1 B g0 g1 i z <-> box bool x0 x1 (fun _ => g0) (fun _ => g1) i z).
  { intros [|] z; unfold rectangle, In_, box, x0, x1; tauto. }
  assert (Is : forall i z, rectangle A b0 a1 B g0 g1 i z -> forall z', rebound z z' <-> z' = (P z, Q z)).
  { intros i z Vz z'. apply R' in Vz. destruct Vz as [Z1 Z2]. destruct (F i) as (l & r' & T0 & u0 & v0 & [Wi Fl _ _ Lz _ _]).
    specialize (Lz _ _ Z1 Z2). rewrite <- (Lap i z Z1) in Lz.
    assert (Fz : first (fst z) (snd z) (time (fst z) (snd z))) by (apply (time_first _ _ _ _ _ _ _ Fl); lra). split.
    + intros (t & j & Ft & -> & Y). simpl in Y. rewrite <- (time_spec _ _ _ Ft) in *. unfold Q. f_equal. unfold P.
      pose proof PI_RGT_0. assert (j = lap z); [|subst; auto].
      assert (D : 2 * PI * (IZR j - IZR (lap z)) < 2 * PI /\ - (2 * PI) < 2 * PI * (IZR j - IZR (lap z))) by lra.
      assert (Hj : -1 < IZR j - IZR (lap z) < 1) by (split; apply Rmult_lt_reg_l with (2 * PI); lra). rewrite <- minus_IZR in Hj.
      assert (-1 < j - lap z < 1)%Z by (split; apply lt_IZR; apply Hj). lia.
    + intros ->. exists (time (fst z) (snd z)), (lap z). auto. }
  assert (Df : forall i z z', box bool x0 x1 (fun _ => g0) (fun _ => g1) i z -> box bool x0 x1 (fun _ => g0) (fun _ => g1) i z' ->
    p * Rabs (fst z - fst z') <= Rabs (P z - P z') + q * Rabs (snd z - snd z') /\
    Rabs (Q z - Q z') <= r * Rabs (fst z - fst z') + s * Rabs (snd z - snd z')).
  { intros i z z' [Z1 Z2] [Z1' Z2']. destruct (F i) as (l & r' & T0 & u0 & v0 & [Wi Fl Ra _ _ _ _]).
    destruct (differences _ _ _ _ _ _ _ Fl (x0 i) (x1 i) g0 g1 p q r s Wi Ra ltac:(lra) (fst z') (snd z') (fst z) (snd z) Z1' Z1 Z2' Z2)
      as [[D _] D']. split; [|exact D']. unfold P. rewrite !(Lap i) by assumption. match goal with |- _ <= Rabs ?f + _ =>
      replace f with (fst z + time (fst z) (snd z) - (fst z' + time (fst z') (snd z'))) by ring end. exact D. }
  split.
  2: { apply known_past.
    - intros i j z z' y Z1 Z2. apply rebound_injective; auto. apply R' in Z1, Z2. destruct Z1 as [Z1 _], Z2 as [Z2 _].
      apply In in Z1, Z2. apply Rabs_def1; lra.
    - intros i z y y' Vz Y Y'. apply (Is i z Vz) in Y, Y'. congruence. }
  assert (Wd : 0 < (g1 - g0) / c) by (apply Rdiv_lt_0_compat; lra).
  apply (crossed_theorem bool (fun _ _ => True) x0 x1 (fun _ => g0) (fun _ => g1) (fun _ z => z) (fun _ z => z)) with
    (P := fun _ _ => P) (Q := fun _ _ => Q) (p := p) (q := q) (r := r) (s := s) (c := c)
    (e0 := B - A + (g1 - g0) / c) (largest := 1 + c); auto; try lra.
  - intros i z. rewrite R'. split; [eauto|intros (q' & Hq & ->); auto].
  - intros [|]; unfold x0, x1; lra.
  - intros i j z z' _ Z _. apply (Is i z), R', Z.
  - intros i j y g _ Y Hg. apply In in Y. destruct (F i) as (l & r' & T0 & u0 & v0 & [Wi Fl _ _ _ Le Ri]).
    specialize (Le g Hg). specialize (Ri g Hg).
    destruct (line_covers _ _ _ _ _ _ _ Fl (x0 i) (x1 i) g0 g1 Wi g (y + 2 * PI * IZR (n i)) Hg ltac:(lra)) as (x & X & E).
    exists x. split; [exact X|]. unfold P. rewrite (Lap i) by exact X. simpl. lra.
  - intros i j z _ [Z1 Z2] _. destruct (F i) as (l & r' & T0 & u0 & v0 & Fi). apply (rf_velocity _ _ _ _ _ _ _ _ _ _ Fi); auto.
  - intros i _ j _ z _ _ [Z1 _] [Z2 _]. unfold In_ in Z1, Z2. destruct i, j; auto; lra.
  - intros i j z z' _ Vz Vz'. apply (Df i z z' Vz Vz').
  - intros i j z z' _ Vz Vz'. apply (Df i z z' Vz Vz').
  - intros i. assert (c * (B - A + (g1 - g0) / c) = c * (B - A) + (g1 - g0)) as -> by (field; lra).
    assert (0 < c * (B - A)) by (apply Rmult_lt_0_compat; lra). unfold x0, x1. destruct i; lra.
  - intros i e1 z z' [N1 N2]. assert (0 <= e1) by (eapply Rle_trans; [apply Rabs_pos|exact N1]).
    assert (0 <= c * e1) by (apply Rmult_le_pos; lra). lra.
Qed.

(* Claim N2: two states of a rectangle, their phases lifted: F stretches horizontal distances p
   times at least, shrinks vertical ones to q and s times in phase and velocity, and keeps cones. *)
Theorem hyperbolic a x y b d e T u v k : 0 < p /\ 0 <= q /\ 0 <= r /\ 0 <= s /\ 0 < c ->
  r + s * c <= c * (p - q * c) -> rectangle_facts a x y b d e T u v k ->
  forall f g f' g', x <= f <= y -> x <= f' <= y -> g0 <= g <= g1 -> g0 <= g' <= g1 ->
  let dx := Rabs (f' - f) in let dg := Rabs (g' - g) in
  let dx' := Rabs (f' + time f' g' - (f + time f g)) in
  let dg' := Rabs (arrival f' g' (time f' g') - arrival f g (time f g)) in
  (g = g' -> p * dx <= dx') /\ (f = f' -> dx' <= q * dg /\ dg' <= s * dg) /\
  (dg <= c * dx -> (p - q * c) * dx <= dx' /\ dg' <= c * dx') /\
  (c * dx' <= dg' -> (c * p - r) * dg' <= c * (r * q + s * p) * dg).
Proof.
  intros S C F f g f' g' Hf Hf' Hg Hg' dx dg dx' dg'.
  destruct (differences _ _ _ _ _ _ _ (rf_flights _ _ _ _ _ _ _ _ _ _ F) x y g0 g1 p q r s
    (rf_within _ _ _ _ _ _ _ _ _ _ F) (rf_rates _ _ _ _ _ _ _ _ _ _ F) ltac:(lra) f g f' g' Hf Hf' Hg Hg') as [[D1 D2] D3].
  fold dx dg dx' dg' in D1, D2, D3. assert (x0 : 0 <= dx) by apply Rabs_pos. assert (d0 : 0 <= dg) by apply Rabs_pos.
  split; [|split; [|apply cones; lra]].
  - intros E. unfold dg in D1. rewrite E, Rminus_eq_0, Rabs_R0 in D1. lra.
  - intros E. split; [apply D2; auto|]. unfold dx in D3. rewrite E, Rminus_eq_0, Rabs_R0 in D3. lra.
Qed.
End Two.
End Model.

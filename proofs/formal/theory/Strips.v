(* A checker of two rectangles of states that F maps across both: where it computes true, the facts
   of Restitution.v hold of them. *)
From Coq Require Import Reals ZArith Psatz Lia List Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Float_full Interval Xreal.
From Oscillator Require Import Impact Rebounds Restitution Numbers March Flights.
Import ListNotations.
Open Scope R_scope.

(* Flights of some phases and of all velocities, and a bracket of the times of their impact. *)
Record piece := Piece { flight : cut; early : Z; late : Z }.
(* A rectangle by its edges: the whole turns until its impacts; T, u and v of all flights; pieces that
   cover it, and more; times after the impacts from the left edge, and before those from the right. *)
Record strip := Strip { left_edge : Z; right_edge : Z; laps_of_strip : Z; lifted : Z; above : Z; below : Z;
  pieces : list piece; at_left : Z; at_right : Z }.
(* P >= p, |Q| <= q, |R| <= r and |S| <= s for the entries of DF; velocities [g0, g1], of flights [d, e]. *)
Record bounds := Bounds { b_p : Z; b_q : Z; b_r : Z; b_s : Z; b_low : Z; b_high : Z; b_d : Z; b_e : Z }.

Section Strips.
Variable bits unit : positive.
Notation prec := (F.PtoP bits).
Notation "a [+] b" := (I.add prec a b) (at level 50, left associativity).
Notation "a [-] b" := (I.sub prec a b) (at level 50, left associativity).
Notation "a [*] b" := (I.mul prec a b) (at level 40, left associativity).
Notation ratio := (ratio unit).
Notation number := (number bits unit).
Notation range := (range bits unit).
Notation turned := (turned bits).
Variables side eta nu eps : Z.
Notation S' := (IZR side).
Notation E' := (ratio eta).
Notation N' := (ratio nu).
Notation P' := (ratio eps).
Hypothesis eta_pos : (0 < eta)%Z.
Notation height := (Rebounds.height S' E' N' P').
Notation arrival := (Rebounds.arrival E' N' P').
Notation rebound := (Rebounds.rebound S' E' N' P').
Notation time := (Restitution.time S' E' N' P').
Notation flights := (Restitution.flights S' E' N' P').
Notation E0 := (eta_real unit eta eta_pos).

Variable bound : bounds.
Notation d := (b_d bound).
Notation e := (b_e bound).

(* The height at a time, for launches of phases [a, b] and velocities [c, h]. *)
Definition level_at (a b c h t : Z) : I.type :=
  level bits side (launched bits unit side eta nu eps (range a b) (range c h)) (between bits unit eta a b t 0).

Lemma level_at_holds a b c h t phi g : ratio a <= phi <= ratio b -> ratio c <= g <= ratio h ->
  holds (level_at a b c h t) (height phi g (ratio t)).
Proof.
  intros P G. pose proof (range_holds bits unit _ _ _ P) as HP. pose proof (range_holds bits unit _ _ _ G) as HG.
  apply (level_holds bits unit side eta nu eps _ _ _ (launched_from bits unit side eta nu eps eta_pos _ _ _ _ HP HG)).
  apply between_at; [exact P|]. rewrite (ratio_0 unit). lra.
Qed.

(* -- a piece: the entries of DF, and the image -- *)

Section Values.
Variable c : piece.
Definition PHI : I.type := range (first_phase (flight c)) (last_phase (flight c)).
Definition GAMMA : I.type := range d e.
Definition TIME : I.type := range (early c) (late c).
Definition there : place := between bits unit eta (first_phase (flight c)) (last_phase (flight c)) (early c) (late c - early c).
Definition plain : launch := launched bits unit 1 eta nu eps PHI GAMMA.
(* eps (eta gamma + nu cos phi), eta (1 + nu sin phi) + kick_p *)
Definition bounce : I.type := number eps [*] (number eta [*] GAMMA [+] number nu [*] I.cos prec PHI).
Definition swing : I.type :=
  rise1 plain [-] I.div prec (number nu) (number eta) [*] (I.fromZ prec 1 [+] number eps) [*] I.sin prec PHI.
Definition fall : I.type := March.rate bits (launched bits unit side eta nu eps PHI GAMMA) there.
Definition sinking : I.type := rise1 plain [*] tc there [+] push1 plain [*] ts there.
Definition over_fall (X : I.type) : I.type := I.div prec (I.fromZ prec side [*] X) fall.
Definition pp : I.type := over_fall (bounce [*] tc there [-] swing [*] ts there).
Definition pg : I.type := I.neg (over_fall (number eps [*] ts there)).
Definition qp : I.type := sinking [*] pp [-] (swing [*] tc there [+] bounce [*] ts there).
Definition qg : I.type := sinking [*] pg [-] number eps [*] tc there.
Definition gamma_there : I.type := rise plain [*] ts there [-] push plain [*] tc there.
Definition phase_there (k : Z) : I.type := PHI [+] TIME [-] turned k.

Variables phi g t : R.
Hypothesis phase : ratio (first_phase (flight c)) <= phi <= ratio (last_phase (flight c)).
Hypothesis velocity : ratio d <= g <= ratio e.
Hypothesis bracket : ratio (early c) <= t <= ratio (late c).
Hypothesis falls_there : Restitution.height_t S' E' N' P' phi g t <> 0.

Lemma values_hold : (holds pp (DP_p S' E' N' P' phi g t) /\ holds pg (DP_g S' E' N' P' phi g t) /\
    holds qp (DQ_p S' E' N' P' phi g t) /\ holds qg (DQ_g S' E' N' P' phi g t)) /\
  holds gamma_there (arrival phi g t) /\ forall k, holds (phase_there k) (phi + t - 2 * PI * IZR k).
Proof.
  pose proof E0 as E0. pose proof (number_holds bits unit eta) as HE. pose proof (number_holds bits unit nu) as HN.
  pose proof (number_holds bits unit eps) as HP. pose proof (I.fromZ_correct prec side : holds _ S') as HS.
  pose proof (range_holds bits unit _ _ _ phase : holds PHI phi) as Hphi.
  pose proof (range_holds bits unit _ _ _ velocity : holds GAMMA g) as Hg.
  pose proof (range_holds bits unit _ _ _ bracket : holds TIME t) as Ht.
  pose proof (I.sin_correct prec PHI (Xreal phi) Hphi : holds _ (sin phi)) as Si.
  pose proof (I.cos_correct prec PHI (Xreal phi) Hphi : holds _ (cos phi)) as Co.
  pose proof (one_holds bits) as H1.
  assert (At0 : is_at there (E' * t) (phi + t)).
  { apply between_at; [exact phase|]. rewrite <- ratio_add. replace (early c + (late c - early c))%Z with (late c) by lia. exact bracket. }
  pose proof At0 as (C & S & _ & _).
  assert (F : holds fall (Restitution.height_t S' E' N' P' phi g t)).
  { apply (rate_holds bits unit side eta nu eps _ _ _ (launched_from bits unit side eta nu eps eta_pos _ _ _ _ Hphi Hg) _ _ At0). }
  destruct (launched_from bits unit 1 eta nu eps eta_pos _ _ _ _ Hphi Hg) as ([A K] & [A1 K1] & _).
  fold plain in A, K, A1, K1. rewrite !Rmult_1_l in A, K, A1, K1.
  assert (Bo : holds bounce (P' * (E' * g + N' * cos phi))) by (unfold bounce; auto using mul_holds, add_holds).
  assert (Sw : holds swing (E' * (1 + N' * sin phi) - N' / E' * (1 + P') * sin phi)).
  { apply sub_holds; auto. apply mul_holds; auto. apply mul_holds; [apply div_holds; auto; lra|auto using add_holds]. }
  assert (Ov : forall X x, holds X x -> holds (over_fall X) (S' * x / Restitution.height_t S' E' N' P' phi g t))
    by (intros; apply div_holds; auto using mul_holds).
  assert (Si' : holds sinking (Restitution.arrival_t E' N' P' phi g t)).
  { unfold Restitution.arrival_t.
    replace ((1 + N' * sin phi) * (E' * cos (E' * t)) + kick E' N' P' phi g * (E' * sin (E' * t)))
      with (E' * (1 + N' * sin phi) * cos (E' * t) + E' * kick E' N' P' phi g * sin (E' * t)) by ring.
    unfold sinking. auto using add_holds, mul_holds. }
  assert (Pp : holds pp (DP_p S' E' N' P' phi g t)).
  { replace (DP_p S' E' N' P' phi g t) with (S' * (P' * (E' * g + N' * cos phi) * cos (E' * t) -
      (E' * (1 + N' * sin phi) - N' / E' * (1 + P') * sin phi) * sin (E' * t)) / Restitution.height_t S' E' N' P' phi g t).
    - apply Ov. auto using sub_holds, mul_holds.
    - unfold DP_p. set (D := _ / _).
      replace D with ((Restitution.height_t S' E' N' P' phi g t - height_p S' E' N' P' phi t) / Restitution.height_t S' E' N' P' phi g t);
        [field; auto|].
      unfold D. f_equal. unfold Restitution.height_t, height_p, kick_p, kick. field. lra. }
  assert (Pg : holds pg (DP_g S' E' N' P' phi g t)).
  { apply neg_holds. unfold height_g. apply Ov. auto using mul_holds. }
  split; [split; [exact Pp|split; [exact Pg|split]]|split].
  - replace (DQ_p S' E' N' P' phi g t) with (Restitution.arrival_t E' N' P' phi g t * DP_p S' E' N' P' phi g t -
      ((E' * (1 + N' * sin phi) - N' / E' * (1 + P') * sin phi) * cos (E' * t) + P' * (E' * g + N' * cos phi) * sin (E' * t))).
    + unfold qp. auto using sub_holds, add_holds, mul_holds.
    + unfold DQ_p, DP_p, arrival_p, Restitution.arrival_t, kick_p, kick. field. split; [auto|lra].
  - replace (DQ_g S' E' N' P' phi g t) with (Restitution.arrival_t E' N' P' phi g t * DP_g S' E' N' P' phi g t - P' * cos (E' * t)).
    + unfold qg. auto using sub_holds, mul_holds.
    + unfold DQ_g, DP_g, arrival_g. field. auto.
  - unfold gamma_there, Rebounds.arrival. auto using sub_holds, mul_holds.
  - intros k. apply sub_holds; [auto using add_holds|apply turned_holds].
Qed.
End Values.

Section Strip.
Variable s : strip.
Notation T := (lifted s).
Notation u := (above s).
Notation v := (below s).
Notation k := (laps_of_strip s).

Definition good_part (c : piece) : bool :=
  let f := flight c in let (a, b) := (first_phase f, last_phase f) in
  match March.impact bits unit side eta nu eps a b d e (lifts f) (Flights.flights f) (falls f) with
  | Some (T', u', v') => (T' =? T)%Z && (u' =? u)%Z && (v' =? v)%Z &&
      ((u <=? early c)%Z && (early c <? late c)%Z && (late c <=? v)%Z &&
       (above_zero (level_at a b d e (early c)) && above_zero (I.neg (level_at a b d e (late c))))) &&
      one_turn bits (phase_there c k) &&
      (at_most bits unit (gamma_there c) (b_high bound) && at_least bits unit (gamma_there c) (b_low bound)) &&
      (at_least bits unit (pp c) (b_p bound) && small bits unit (pg c) (b_q bound) && small bits unit (qp c) (b_r bound) && small bits unit (qg c) (b_s bound))
  | None => false
  end.

(* What is shown of each phase. *)
Definition shown (phi : R) : Prop := (exists a b, a <= phi <= b /\ flights a b (ratio d) (ratio e) (ratio T) (ratio u) (ratio v)) /\
  forall g, ratio d <= g <= ratio e -> let t := time phi g in
    (ratio (b_p bound) <= DP_p S' E' N' P' phi g t /\ Rabs (DP_g S' E' N' P' phi g t) <= ratio (b_q bound) /\
     Rabs (DQ_p S' E' N' P' phi g t) <= ratio (b_r bound) /\ Rabs (DQ_g S' E' N' P' phi g t) <= ratio (b_s bound)) /\
    ratio (b_low bound) <= arrival phi g t <= ratio (b_high bound) /\ 0 <= phi + t - 2 * PI * IZR k < 2 * PI.

Lemma good_part_shows c phi : good_part c = true ->
  ratio (first_phase (flight c)) < phi < ratio (last_phase (flight c)) -> shown phi.
Proof.
  unfold good_part. intros H P. destruct (March.impact _ _ _ _ _ _ _ _ _ _ _ _ _) as [[[T' u'] v']|] eqn:Q; [|discriminate].
  rewrite !andb_true_iff, !Z.eqb_eq, !Z.leb_le, Z.ltb_lt in H.
  destruct H as [[[[[[ET Eu] Ev] [[[uE EL] Lv] [Lo Hi]]] It] [G1 G0]] [[[Rp Rq] Rr] Rs]].
  subst T' u' v'. apply (impact_flights bits unit side eta nu eps eta_pos) in Q. split.
  { exists (ratio (first_phase (flight c))), (ratio (last_phase (flight c))). split; [lra|exact Q]. }
  intros g G t.
  pose proof (ratio_le unit _ _ uE) as uE'. pose proof (ratio_lt unit _ _ EL) as EL'. pose proof (ratio_le unit _ _ Lv) as Lv'.
  assert (Ph : ratio (first_phase (flight c)) <= phi <= ratio (last_phase (flight c))) by lra.
  apply (above_zero_holds _ _ (level_at_holds _ _ _ _ _ phi g Ph G)) in Lo.
  apply (above_zero_holds _ _ (neg_holds _ _ (level_at_holds _ _ _ _ _ phi g Ph G))) in Hi.
  assert (Br : ratio (early c) < t < ratio (late c)) by (apply (time_bracket _ _ _ _ E0 _ _ _ _ _ _ _ Q phi g); lra).
  assert (Fall : Restitution.height_t S' E' N' P' phi g t <> 0).
  { pose proof (fl_fall _ _ _ _ _ _ _ _ _ _ _ Q phi g t Ph G ltac:(lra)). lra. }
  destruct (values_hold c phi g t Ph G ltac:(lra) Fall) as ((Vp & Vq & Vr & Vs) & Vg & Vk). specialize (Vk k).
  apply (one_turn_holds bits _ _ Vk) in It.
  split; [split; [|split; [|split]]|split; [split|lra]]; eauto using small_holds, at_most_holds, at_least_holds.
Qed.

(* Impacts from the left edge come before a time that is short of [A, B], those from the right after
   one that is beyond. *)
Variables A B : Z.
Definition good_strip : bool :=
  chain (fun c => first_phase (flight c)) (fun c => last_phase (flight c)) good_part (left_edge s - 1) (right_edge s + 1) (pieces s) &&
  ((left_edge s <? right_edge s)%Z && (d <? b_low bound)%Z && (b_high bound <? e)%Z) &&
  ((u <=? at_left s)%Z && (at_left s <=? v)%Z && (u <=? at_right s)%Z && (at_right s <=? v)%Z) &&
  (above_zero (I.neg (level_at (left_edge s) (left_edge s) d e (at_left s))) &&
   at_most bits unit (number (left_edge s + at_left s) [-] turned k) A) &&
  (above_zero (level_at (right_edge s) (right_edge s) d e (at_right s)) &&
   at_least bits unit (number (right_edge s + at_right s) [-] turned k) B).

Hypothesis good : good_strip = true.

Lemma all_shown phi : ratio (left_edge s - 1) <= phi <= ratio (right_edge s + 1) -> shown phi.
Proof.
  unfold good_strip in good. rewrite !andb_true_iff in good. destruct good as [[[[Ch _] _] _] _].
  apply (chain_holds unit (fun c => first_phase (flight c)) (fun c => last_phase (flight c)) shown good_part good_part_shows _ _ _ Ch).
Qed.

Theorem strip_facts : rectangle_facts S' E' N' P' (ratio A) (ratio B) (ratio (b_low bound)) (ratio (b_high bound))
  (ratio (b_p bound)) (ratio (b_q bound)) (ratio (b_r bound)) (ratio (b_s bound))
  (ratio (left_edge s - 1)) (ratio (left_edge s)) (ratio (right_edge s)) (ratio (right_edge s + 1))
  (ratio d) (ratio e) (ratio T) (ratio u) (ratio v) k.
Proof.
  pose proof all_shown as All. unfold good_strip in good.
  rewrite !andb_true_iff, !Z.leb_le, !Z.ltb_lt in good.
  destruct good as [[[[_ [[LR dl] he]] [[[uL Lv] uR] Rv]] [Le La]] [Re Ra]].
  apply (ratio_lt unit) in LR, dl, he. apply (ratio_le unit) in uL, Lv, uR, Rv.
  assert (Lx : ratio (left_edge s - 1) < ratio (left_edge s)) by (apply ratio_lt; lia).
  assert (Rx : ratio (right_edge s) < ratio (right_edge s + 1)) by (apply ratio_lt; lia).
  assert (Fl : flights (ratio (left_edge s - 1)) (ratio (right_edge s + 1)) (ratio d) (ratio e) (ratio T) (ratio u) (ratio v)).
  { split; [destruct (All (ratio (left_edge s)) ltac:(lra)) as [(a & b & _ & []) _]; auto|..];
      intros phi; intros; destruct (All phi ltac:(assumption)) as [(a & b & W & []) _]; auto. }
  split; auto.
  - intros phi g X G. apply (All phi); lra.
  - intros phi g X G. apply (All phi); lra.
  - intros phi g X G. apply (All phi); lra.
  - intros g G. pose proof (above_zero_holds _ _ (neg_holds _ _ (level_at_holds (left_edge s) (left_edge s) d e (at_left s)
      (ratio (left_edge s)) g ltac:(lra) ltac:(lra))) Le) as Neg.
    assert (Bt : ratio u < time (ratio (left_edge s)) g < ratio (at_left s)).
    { pose proof (fl_order _ _ _ _ _ _ _ _ _ _ _ Fl).
      apply (time_bracket _ _ _ _ E0 _ _ _ _ _ _ _ Fl); try lra.
      apply (fl_flight _ _ _ _ _ _ _ _ _ _ _ Fl); lra. }
    apply (at_most_holds bits unit _ _ _ (sub_holds _ _ _ _ (number_holds bits unit _) (turned_holds bits _))) in La.
    rewrite ratio_add in La. lra.
  - intros g G. pose proof (above_zero_holds _ _ (level_at_holds (right_edge s) (right_edge s) d e (at_right s)
      (ratio (right_edge s)) g ltac:(lra) ltac:(lra)) Re) as Po.
    assert (Bt : ratio (at_right s) < time (ratio (right_edge s)) g < ratio v).
    { pose proof (fl_order _ _ _ _ _ _ _ _ _ _ _ Fl).
      apply (time_bracket _ _ _ _ E0 _ _ _ _ _ _ _ Fl); try lra.
      apply (fl_end _ _ _ _ _ _ _ _ _ _ _ Fl); lra. }
    apply (at_least_holds bits unit _ _ _ (sub_holds _ _ _ _ (number_holds bits unit _) (turned_holds bits _))) in Ra.
    rewrite ratio_add in Ra. lra.
Qed.

(* A state of the rectangle that falls short: its image is at a phase below its own, after l. *)
Definition short (l x g t0 t : Z) : bool :=
  ((left_edge s <=? x)%Z && (x <=? right_edge s)%Z && (b_low bound <=? g)%Z && (g <=? b_high bound)%Z &&
   (u <=? t0)%Z && (t0 <=? v)%Z && (u <=? t)%Z && (t <=? v)%Z) &&
  (above_zero (level_at x x g g t0) && above_zero (number (x + t0 - l) [-] turned k)) &&
  (above_zero (I.neg (level_at x x g g t)) && above_zero (turned k [-] number t)).

Theorem falls_short l x g t0 t : short l x g t0 t = true ->
  (forall phi gamma, ratio (left_edge s) <= phi <= ratio (right_edge s) -> ratio (b_low bound) <= gamma <= ratio (b_high bound) ->
     0 <= phi + time phi gamma - 2 * PI * IZR k < 2 * PI) /\
  exists z, rebound (ratio x, ratio g) z /\ ratio l < fst z < ratio x.
Proof.
  unfold short. rewrite !andb_true_iff, !Z.leb_le.
  intros [[[[[[[[[Lx Rx] Lg] Rg] ut0] t0v] ut] tv] [Po Be]] [Neg Sh]].
  apply (ratio_le unit) in Lx, Rx, Lg, Rg, ut0, t0v, ut, tv. destruct strip_facts as [W Fl _ _ Lap _ _].
  apply (above_zero_holds _ _ (level_at_holds x x g g t0 (ratio x) (ratio g) ltac:(lra) ltac:(lra))) in Po.
  apply (above_zero_holds _ _ (neg_holds _ _ (level_at_holds x x g g t (ratio x) (ratio g) ltac:(lra) ltac:(lra)))) in Neg.
  apply (above_zero_holds _ _ (sub_holds _ _ _ _ (number_holds bits unit _) (turned_holds bits _))) in Be.
  apply (above_zero_holds _ _ (sub_holds _ _ _ _ (turned_holds bits _) (number_holds bits unit t))) in Sh.
  pose proof (fl_order _ _ _ _ _ _ _ _ _ _ _ Fl) as Or.
  assert (Bt : ratio t0 < time (ratio x) (ratio g) < ratio t)
    by (apply (time_bracket _ _ _ _ E0 _ _ _ _ _ _ _ Fl); lra).
  split; [exact Lap|]. specialize (Lap (ratio x) (ratio g) ltac:(lra) ltac:(lra)).
  destruct (time_first _ _ _ _ E0 _ _ _ _ _ _ _ Fl (ratio x) (ratio g)) as [F0 _]; [lra|lra|].
  exists (ratio x + time (ratio x) (ratio g) - 2 * PI * IZR k, arrival (ratio x) (ratio g) (time (ratio x) (ratio g))).
  split; [exists (time (ratio x) (ratio g)), k; split; [exact F0|split; [reflexivity|exact Lap]]|]. cbn [fst].
  assert (Sm : ratio (x + t0 - l) = ratio x + ratio t0 - ratio l)
    by (unfold Numbers.ratio; rewrite minus_IZR, plus_IZR; field; pose proof (unit_pos unit); lra). lra.
Qed.
End Strip.
End Strips.

(* -- two of them, with numbers that are written otherwise -- *)

Definition check_strips bits unit side eta nu eps bound s0 s1 : bool :=
  good_strip bits unit side eta nu eps bound s0 (left_edge s0) (right_edge s1) &&
  good_strip bits unit side eta nu eps bound s1 (left_edge s0) (right_edge s1) &&
  (right_edge s0 <? left_edge s1)%Z.

Section Two.
Variables bits unit : positive.
Variables side eta nu eps : Z.
Variable bound : bounds.
Variables s0 s1 : strip.
Hypothesis checked : check_strips bits unit side eta nu eps bound s0 s1 = true.
Hypothesis eta_pos : (0 < eta)%Z.
Notation ratio := (ratio unit).
Variables S' E' N' P' A b0 a1 B g0 g1 p q r s c : R.
Hypothesis parameters : IZR side = S' /\ ratio eta = E' /\ ratio nu = N' /\ ratio eps = P'.
Hypothesis edges : ratio (left_edge s0) = A /\ ratio (right_edge s0) = b0 /\ ratio (left_edge s1) = a1 /\ ratio (right_edge s1) = B.
Hypothesis velocities : ratio (b_low bound) = g0 /\ ratio (b_high bound) = g1.
Hypothesis rates : ratio (b_p bound) = p /\ ratio (b_q bound) = q /\ ratio (b_r bound) = r /\ ratio (b_s bound) = s.
Notation time := (Restitution.time S' E' N' P').
Notation arrival := (Rebounds.arrival E' N' P').

Lemma two_facts : b0 < a1 /\ exists d e,
  (exists a b T u v k, rectangle_facts S' E' N' P' A B g0 g1 p q r s a A b0 b d e T u v k) /\
  exists a b T u v k, rectangle_facts S' E' N' P' A B g0 g1 p q r s a a1 B b d e T u v k.
Proof.
  pose proof checked as Ch. unfold check_strips in Ch. rewrite !andb_true_iff, Z.ltb_lt in Ch. destruct Ch as [[G0 G1] Lt].
  destruct parameters as (<- & <- & <- & <-), edges as (<- & <- & <- & <-), velocities as (<- & <-), rates as (<- & <- & <- & <-).
  split; [apply ratio_lt, Lt|do 2 eexists; split; do 6 eexists].
  - apply (strip_facts bits unit side eta nu eps eta_pos bound s0 _ _ G0).
  - apply (strip_facts bits unit side eta nu eps eta_pos bound s1 _ _ G1).
Qed.

Theorem strips_horseshoe rate : S' <> 0 -> P' <> 0 -> A < b0 -> a1 < B -> B - A <= 6 -> g0 < g1 ->
  0 < p /\ 0 <= q /\ 0 <= r /\ 0 <= s /\ 0 < c /\ 0 <= rate < 1 ->
  1 + q * c <= rate * p -> r * rate + s * c <= rate * c ->
  two_sided_shift (Rebounds.rebound S' E' N' P') A b0 a1 B g0 g1 rate.
Proof.
  intros S0 P0 O0 O1 W G Po R1 R2. destruct two_facts as (Lt & d & e & (a & b & T & u & v & k & F0) & (a' & b' & T' & u' & v' & k' & F1)).
  assert (E0 : 0 < E') by (destruct parameters as (_ & <- & _); apply eta_real, eta_pos).
  pose proof PI2_3_2. eapply rebounds with (p := p) (q := q) (r := r) (s := s) (c := c);
    first [exact F0 | exact F1 | assumption | lra].
Qed.

Theorem strips_hyperbolic expansion contraction : 0 < p /\ 0 <= q /\ 0 <= r /\ 0 <= s /\ 0 < c ->
  r + s * c <= c * (p - q * c) -> expansion <= p - q * c -> r < c * p -> c * (r * q + s * p) <= contraction * (c * p - r) ->
  forall f g f' g', A <= f <= b0 /\ A <= f' <= b0 \/ a1 <= f <= B /\ a1 <= f' <= B ->
  g0 <= g <= g1 -> g0 <= g' <= g1 ->
  let dx := Rabs (f' - f) in let dg := Rabs (g' - g) in
  let dx' := Rabs (f' + time f' g' - (f + time f g)) in
  let dg' := Rabs (arrival f' g' (time f' g') - arrival f g (time f g)) in
  (g = g' -> p * dx <= dx') /\ (f = f' -> dx' <= q * dg /\ dg' <= s * dg) /\
  (dg <= c * dx -> expansion * dx <= dx' /\ dg' <= c * dx') /\
  (c * dx' <= dg' -> dg' <= contraction * dg).
Proof.
  intros Po Co Ex Cp Ct f g f' g' Hf Hg Hg' dx dg dx' dg'.
  destruct two_facts as (Lt & d & e & (a & b & T & u & v & k & F0) & (a' & b' & T' & u' & v' & k' & F1)).
  assert (E0 : 0 < E') by (destruct parameters as (_ & <- & _); apply eta_real, eta_pos).
  assert (H : (g = g' -> p * dx <= dx') /\ (f = f' -> dx' <= q * dg /\ dg' <= s * dg) /\
    (dg <= c * dx -> (p - q * c) * dx <= dx' /\ dg' <= c * dx') /\
    (c * dx' <= dg' -> (c * p - r) * dg' <= c * (r * q + s * p) * dg)).
  { destruct Hf as [[Hf Hf']|[Hf Hf']].
    - apply (Restitution.hyperbolic S' E' N' P' E0 _ _ _ _ p q r s c _ _ _ _ _ _ _ _ _ _ Po Co F0 f g f' g' Hf Hf' Hg Hg').
    - apply (Restitution.hyperbolic S' E' N' P' E0 _ _ _ _ p q r s c _ _ _ _ _ _ _ _ _ _ Po Co F1 f g f' g' Hf Hf' Hg Hg'). }
  destruct H as (H1 & H2 & H3 & H4). assert (X : 0 <= dx) by apply Rabs_pos. assert (Y : 0 <= dg) by apply Rabs_pos.
  split; [exact H1|split; [exact H2|split]].
  - intros D. destruct (H3 D) as [G K]. split; auto. apply (Rmult_le_compat_r dx) in Ex; lra.
  - intros D. specialize (H4 D). apply (Rmult_le_compat_r dg) in Ct; [|exact Y].
    apply Rmult_le_reg_l with (c * p - r); lra.
Qed.

(* A state of V2 that F takes to a phase below its own, after l; all images of V2 are within one turn. *)
Theorem strip_falls_short l x g t0 t L X G : short bits unit side eta nu eps bound s1 l x g t0 t = true ->
  ratio l = L -> ratio x = X -> ratio g = G ->
  (exists k : Z, forall f g, a1 <= f <= B -> g0 <= g <= g1 -> 0 <= f + time f g - 2 * PI * IZR k < 2 * PI) /\
  exists z, Rebounds.rebound S' E' N' P' (X, G) z /\ L < fst z < X.
Proof.
  intros Sh <- <- <-. pose proof checked as Ch. unfold check_strips in Ch. rewrite !andb_true_iff in Ch. destruct Ch as [[_ G1] _].
  destruct parameters as (<- & <- & <- & <-), edges as (_ & _ & <- & <-), velocities as (<- & <-).
  destruct (falls_short bits unit side eta nu eps eta_pos bound s1 _ _ G1 l x g t0 t Sh) as [La Ex].
  split; [eexists; exact La|exact Ex].
Qed.
End Two.

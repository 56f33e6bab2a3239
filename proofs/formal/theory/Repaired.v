(* Claims N1 to N3 at the paper's (eta, nu, eps) = (0.2121, -0.2, 0.01): as printed an edge falls
   short; V1 = [1.11, 1.16] x [-0.45, 0] and V2 = [1.27, 1.33] x [-0.45, 0] carry the full shift. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Specific_stdz Specific_ops.
From Interval Require Tactic.
Module Integers := SpecificFloat StdZRadix2.
Module Exact := Tactic.IntervalTactic Integers.
Import Tactic Exact.
From Oscillator Require Import Impact Rebounds Flight Crossed Restitution.
Open Scope R_scope.

Notation side := (-1).
Notation eta := (2121 / 10000).
Notation nu := (-1 / 5).
Notation eps := (1 / 100).
Notation g0 := (-9 / 20).
Notation g1 := 0.
Notation height := (height side eta nu eps).
Notation time := (time side eta nu eps).
Ltac num := unfold Rebounds.height, Rebounds.arrival, height_tt, DP_p, DP_g, DQ_p, DQ_g,
  height_p, height_g, arrival_t, arrival_p, arrival_g, height_t, kick_p, Rebounds.kick.
Ltac boxes p t := num; interval with (i_bisect t, i_bisect p, i_depth 40, i_prec 40).
Ltac line p := num; interval with (i_bisect p, i_depth 40, i_prec 40).
Ltac flight t := num; interval with (i_bisect t, i_autodiff t, i_depth 60, i_prec 40).

Lemma eta_pos : 0 < eta. Proof. lra. Qed.
Lemma pi_near : 31415926 / 10000000 < PI < 31415927 / 10000000.
Proof. split; interval with (i_depth 10, i_prec 40). Qed.

Lemma launch0 phi g t : 1105/1000 <= phi <= 1165/1000 -> -46 / 100 <= g <= 1 / 100 -> 0 <= t <= 1 -> 0 < height_tt side eta nu eps phi g t.
Proof. intros P G S. boxes phi t. Qed.
Lemma possible0 phi g : 1105/1000 <= phi <= 1165/1000 -> -46 / 100 <= g <= 1 / 100 -> 0 <= side * (eps * (eta * g + nu * cos phi)).
Proof. intros P G. line phi. Qed.
Lemma flight0 phi g t : 1105/1000 <= phi <= 1165/1000 -> -46 / 100 <= g <= 1 / 100 -> 1 <= t <= 25 -> 0 < height phi g t.
Proof. intros P G S. flight t. Qed.
Lemma fall0 phi g t : 1105/1000 <= phi <= 1165/1000 -> -46 / 100 <= g <= 1 / 100 -> 25 <= t <= 51/2 -> height_t side eta nu eps phi g t < 0.
Proof. intros P G S. boxes phi t. Qed.
Lemma end0 phi g : 1105/1000 <= phi <= 1165/1000 -> -46 / 100 <= g <= 1 / 100 -> height phi g (51/2) < 0.
Proof. intros P G. line phi. Qed.
Lemma flights0 : flights side eta nu eps (1105/1000) (1165/1000) (-46 / 100) (1 / 100) (1) (25) (51/2).
Proof.
  split; [lra|apply possible0|apply launch0|apply flight0|apply fall0|apply end0].
Qed.
Lemma rates0 phi g t : 111/100 <= phi <= 116/100 -> g0 <= g <= g1 -> 25 < t < 51/2 ->
  3 <= DP_p side eta nu eps phi g t /\ Rabs (DP_g side eta nu eps phi g t) <= 3 / 20 /\
  Rabs (DQ_p side eta nu eps phi g t) <= 29 / 20 /\ Rabs (DQ_g side eta nu eps phi g t) <= 1 / 20.
Proof.
  intros P G S. split; [boxes phi t|split; [|split]]; apply Rabs_le; split; boxes phi t.
Qed.
Lemma velocity0_0 phi g : 111/100 <= phi <= 112/100 -> g0 <= g <= g1 -> g0 <= arrival eta nu eps phi g (time phi g) <= g1.
Proof.
  intros P G. assert (H : 2508/100 < time phi g < 51/2).
  { apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights0); try lra; line phi. }
  generalize dependent (time phi g). intros t S. split; boxes phi t.
Qed.
Lemma velocity0_1 phi g : 112/100 <= phi <= 114/100 -> g0 <= g <= g1 -> g0 <= arrival eta nu eps phi g (time phi g) <= g1.
Proof.
  intros P G. assert (H : 2513/100 < time phi g < 51/2).
  { apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights0); try lra; line phi. }
  generalize dependent (time phi g). intros t S. split; boxes phi t.
Qed.
Lemma velocity0_2 phi g : 114/100 <= phi <= 116/100 -> g0 <= g <= g1 -> g0 <= arrival eta nu eps phi g (time phi g) <= g1.
Proof.
  intros P G. assert (H : 2519/100 < time phi g < 51/2).
  { apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights0); try lra; line phi. }
  generalize dependent (time phi g). intros t S. split; boxes phi t.
Qed.
Lemma left0 g : g0 <= g <= g1 -> 111/100 + time (111/100) g - 2 * PI * IZR 4 <= 111/100.
Proof.
  intros G. assert (H : 25 < time (111/100) g < 111/100 + 2 * PI * IZR 4 - 111/100); [|lra]. pose proof pi_near.
  apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights0); try lra; num; interval with (i_depth 10, i_prec 40).
Qed.
Lemma right0 g : g0 <= g <= g1 -> 133/100 <= 116/100 + time (116/100) g - 2 * PI * IZR 4.
Proof.
  intros G. assert (H : 133/100 + 2 * PI * IZR 4 - 116/100 < time (116/100) g < 51/2); [|lra]. pose proof pi_near.
  apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights0); try lra; num; interval with (i_depth 10, i_prec 40).
Qed.
Lemma facts0 : rectangle_facts side eta nu eps (111/100) (133/100) g0 g1 3 (3 / 20) (29 / 20) (1 / 20)
  (1105/1000) (111/100) (116/100) (1165/1000) (-46 / 100) (1 / 100) (1) (25) (51/2) 4.
Proof.
  assert (Time : forall phi g, 111/100 <= phi <= 116/100 -> g0 <= g <= g1 -> 25 < time phi g < 51/2).
  { intros phi g P G. apply (time_first side eta nu eps eta_pos _ _ _ _ _ _ _ flights0); lra. }
  split; [lra|apply flights0| | | |apply left0|apply right0].
  - intros phi g P G. apply rates0; auto.
  - intros phi g P G. destruct (Rle_dec phi (112/100)); [apply velocity0_0; lra|]. destruct (Rle_dec phi (114/100)); [apply velocity0_1; lra|]. apply velocity0_2; lra.
  - intros phi g P G. specialize (Time phi g P G). pose proof pi_near. lra.
Qed.

Lemma launch1 phi g t : 1265/1000 <= phi <= 1335/1000 -> -46 / 100 <= g <= 1 / 100 -> 0 <= t <= 1 -> 0 < height_tt side eta nu eps phi g t.
Proof. intros P G S. boxes phi t. Qed.
Lemma possible1 phi g : 1265/1000 <= phi <= 1335/1000 -> -46 / 100 <= g <= 1 / 100 -> 0 <= side * (eps * (eta * g + nu * cos phi)).
Proof. intros P G. line phi. Qed.
Lemma flight1 phi g t : 1265/1000 <= phi <= 1335/1000 -> -46 / 100 <= g <= 1 / 100 -> 1 <= t <= 281/5 -> 0 < height phi g t.
Proof. intros P G S. flight t. Qed.
Lemma fall1 phi g t : 1265/1000 <= phi <= 1335/1000 -> -46 / 100 <= g <= 1 / 100 -> 281/5 <= t <= 284/5 -> height_t side eta nu eps phi g t < 0.
Proof. intros P G S. boxes phi t. Qed.
Lemma end1 phi g : 1265/1000 <= phi <= 1335/1000 -> -46 / 100 <= g <= 1 / 100 -> height phi g (284/5) < 0.
Proof. intros P G. line phi. Qed.
Lemma flights1 : flights side eta nu eps (1265/1000) (1335/1000) (-46 / 100) (1 / 100) (1) (281/5) (284/5).
Proof.
  split; [lra|apply possible1|apply launch1|apply flight1|apply fall1|apply end1].
Qed.
Lemma rates1 phi g t : 127/100 <= phi <= 133/100 -> g0 <= g <= g1 -> 281/5 < t < 284/5 ->
  3 <= DP_p side eta nu eps phi g t /\ Rabs (DP_g side eta nu eps phi g t) <= 3 / 20 /\
  Rabs (DQ_p side eta nu eps phi g t) <= 29 / 20 /\ Rabs (DQ_g side eta nu eps phi g t) <= 1 / 20.
Proof.
  intros P G S. split; [boxes phi t|split; [|split]]; apply Rabs_le; split; boxes phi t.
Qed.
Lemma velocity1_0 phi g : 127/100 <= phi <= 133/100 -> g0 <= g <= g1 -> g0 <= arrival eta nu eps phi g (time phi g) <= g1.
Proof.
  intros P G. assert (H : 281/5 < time phi g < 284/5).
  { apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights1); try lra; line phi. }
  generalize dependent (time phi g). intros t S. split; boxes phi t.
Qed.
Lemma left1 g : g0 <= g <= g1 -> 127/100 + time (127/100) g - 2 * PI * IZR 9 <= 111/100.
Proof.
  intros G. assert (H : 281/5 < time (127/100) g < 111/100 + 2 * PI * IZR 9 - 127/100); [|lra]. pose proof pi_near.
  apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights1); try lra; num; interval with (i_depth 10, i_prec 40).
Qed.
Lemma right1 g : g0 <= g <= g1 -> 133/100 <= 133/100 + time (133/100) g - 2 * PI * IZR 9.
Proof.
  intros G. assert (H : 133/100 + 2 * PI * IZR 9 - 133/100 < time (133/100) g < 284/5); [|lra]. pose proof pi_near.
  apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights1); try lra; num; interval with (i_depth 10, i_prec 40).
Qed.
Lemma facts1 : rectangle_facts side eta nu eps (111/100) (133/100) g0 g1 3 (3 / 20) (29 / 20) (1 / 20)
  (1265/1000) (127/100) (133/100) (1335/1000) (-46 / 100) (1 / 100) (1) (281/5) (284/5) 9.
Proof.
  assert (Time : forall phi g, 127/100 <= phi <= 133/100 -> g0 <= g <= g1 -> 281/5 < time phi g < 284/5).
  { intros phi g P G. apply (time_first side eta nu eps eta_pos _ _ _ _ _ _ _ flights1); lra. }
  split; [lra|apply flights1| | | |apply left1|apply right1].
  - intros phi g P G. apply rates1; auto.
  - intros phi g P G. apply velocity1_0; lra.
  - intros phi g P G. specialize (Time phi g P G). pose proof pi_near. lra.
Qed.

(* N1 as printed: the corner (1.32, -0.45) of V2 is not mapped beyond the right edge. *)
Theorem printed_edge_falls_short z : rebound side eta nu eps (132 / 100, g0) z -> fst z < 132 / 100.
Proof.
  intros (t & k & F & -> & L). simpl in *. rewrite <- (time_spec _ _ _ _ _ _ _ F) in *. pose proof pi_near.
  assert (H' : 281 / 5 < time (132 / 100) g0 < 2 * PI * 9 - 1 / 100).
  { apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights1); try lra; num; interval with (i_depth 10, i_prec 40). }
  assert (K : (8 < k)%Z) by (apply lt_IZR; apply Rmult_lt_reg_l with (2 * PI); lra).
  assert (K' : 9 <= IZR k) by (apply IZR_le; lia).
  assert (2 * PI * 9 <= 2 * PI * IZR k) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* N1 and N3, repaired: each two-sided sequence is the history of one full orbit. *)
Theorem repaired_horseshoe : exists size, two_sided_shift (rebound side eta nu eps)
  (111 / 100) (116 / 100) (127 / 100) (133 / 100) g0 g1 2 (4 / 5) size.
Proof.
  eexists. pose proof pi_near.
  eapply rebounds with (p := 3) (q := 3 / 20) (r := 29 / 20) (s := 1 / 20);
    first [exact facts0 | exact facts1 | lra].
Qed.

(* N2, repaired: on both rectangles horizontal distances grow at least 3 times, vertical ones
   shrink to at most 3/20, and the cones |dg| <= 2 |dphi| are kept and stretched 27/10 times. *)
Theorem repaired_hyperbolic : forall f g f' g', 111 / 100 <= f <= 116 / 100 /\ 111 / 100 <= f' <= 116 / 100 \/
    127 / 100 <= f <= 133 / 100 /\ 127 / 100 <= f' <= 133 / 100 -> g0 <= g <= g1 -> g0 <= g' <= g1 ->
  let dx := Rabs (f' - f) in let dg := Rabs (g' - g) in
  let dx' := Rabs (f' + time f' g' - (f + time f g)) in
  let dg' := Rabs (arrival eta nu eps f' g' (time f' g') - arrival eta nu eps f g (time f g)) in
  (g = g' -> 3 * dx <= dx') /\ (f = f' -> dx' <= 3 / 20 * dg /\ dg' <= 1 / 20 * dg) /\
  (dg <= 2 * dx -> 27 / 10 * dx <= dx' /\ dg' <= 2 * dx') /\ (2 * dx' <= dg' -> dg' <= 1 / 5 * dg).
Proof.
  intros f g f' g' [[Hf Hf']|[Hf Hf']] Hg Hg' dx dg dx' dg'; assert (0 <= dg) by apply Rabs_pos.
  - destruct (hyperbolic side eta nu eps eta_pos _ _ _ _ 3 (3 / 20) (29 / 20) (1 / 20) 2 _ _ _ _ _ _ _ _ _ _
      ltac:(lra) ltac:(lra) facts0 f g f' g' Hf Hf' Hg Hg') as (H1 & H2 & H3 & H4).
    fold dx dg dx' dg' in H1, H2, H3, H4. repeat split; intros; try apply H2; try lra.
  - destruct (hyperbolic side eta nu eps eta_pos _ _ _ _ 3 (3 / 20) (29 / 20) (1 / 20) 2 _ _ _ _ _ _ _ _ _ _
      ltac:(lra) ltac:(lra) facts1 f g f' g' Hf Hf' Hg Hg') as (H1 & H2 & H3 & H4).
    fold dx dg dx' dg' in H1, H2, H3, H4. repeat split; intros; try apply H2; try lra.
Qed.

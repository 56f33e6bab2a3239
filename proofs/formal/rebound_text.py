"""The Coq text on two rectangles of states with restitution, that `rebounds` fills in."""

HEAD = """(* Written by python -m proofs formal from the certificate with the SHA-256
   {digest}.
   Not trusted: coqc proves every line. To be read: Impact.v, Rebounds.v, and the theorems here. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
{arithmetic}
From Oscillator Require Import Impact Rebounds Flight Crossed Restitution.
Open Scope R_scope.

Definition side := {side}.
Definition eta := {eta}.
Definition nu := {nu}.
Definition eps := {eps}.
Notation height := (Rebounds.height side eta nu eps).
Notation arrival := (Rebounds.arrival eta nu eps).
Notation rebound := (Rebounds.rebound side eta nu eps).
Notation time := (Restitution.time side eta nu eps).
Ltac num := unfold Rebounds.height, Rebounds.arrival, height_tt, DP_p, DP_g, DQ_p, DQ_g, height_p,
  height_g, arrival_t, arrival_p, arrival_g, height_t, kick_p, Rebounds.kick, side, eta, nu, eps.
Ltac boxes p t := num; interval with (i_bisect t, i_bisect p, i_depth 40{bits}).
Ltac flight p t := num; interval with (i_bisect t, i_bisect p, i_autodiff t, i_depth 60{bits}).
Ltac line p := num; interval with (i_bisect p, i_depth 40{bits}).
Ltac at_once := num; interval with (i_depth 10{bits}).
Lemma eta_pos : 0 < eta. Proof. unfold eta; lra. Qed.
Lemma eps_pos : 0 < eps. Proof. unfold eps; lra. Qed.
Lemma PI_near : 3141592653589793 / 1000000000000000 < PI < 3141592653589794 / 1000000000000000.
Proof. split; interval with (i_prec 80). Qed.
"""

MODEL = """
(* {says} *)
Theorem model : (side = 1 /\\ 0 < nu \\/ side = -1 /\\ nu < 0) /\\
  forall (X V : R -> R) phi before,
  (forall t, is_derive X t (V t)) -> (forall t, is_derive V t (- eta ^ 2 * X t)) ->
  X 0 = 1 + nu * sin phi -> V 0 = - eps * before + (1 + eps) * (nu * cos phi) ->
  forall t, side * (X t - (1 + nu * sin (phi + t))) = height phi (- before / eta) t /\\
    arrival phi (- before / eta) t = - V t / eta.
Proof.
  split; [unfold side, nu; lra|].
  intros X V phi before. exact (motion_rebound side eta nu eps eta_pos X V phi before).
Qed.
"""
MODEL_IN_WORDS = (
    "the height is the distance from the table of any mass that leaves an impact at phase phi by the "
    "law v+ = -eps v- + (1 + eps) w and moves by X'' = -eta^2 X; the second coordinate of a state is "
    "-X'/eta"
)

# what is shown of a rectangle, with its number i
RECTANGLE = """
Lemma launch{i} phi g t : {a} <= phi <= {b} -> {d} <= g <= {e} -> 0 <= t <= {T} ->
  0 < height_tt side eta nu eps phi g t.
Proof. intros P G S. boxes phi t. Qed.
Lemma possible{i} phi g : {a} <= phi <= {b} -> {d} <= g <= {e} ->
  0 <= side * (eps * (eta * g + nu * cos phi)).
Proof. intros P G. line phi. Qed.
Lemma flight{i} phi g t : {a} <= phi <= {b} -> {d} <= g <= {e} -> {T} <= t <= {u} -> 0 < height phi g t.
Proof. intros P G S. flight phi t. Qed.
Lemma fall{i} phi g t : {a} <= phi <= {b} -> {d} <= g <= {e} -> {u} <= t <= {v} ->
  height_t side eta nu eps phi g t < 0.
Proof. intros P G S. boxes phi t. Qed.
Lemma end{i} phi g : {a} <= phi <= {b} -> {d} <= g <= {e} -> height phi g {v} < 0.
Proof. intros P G. line phi. Qed.
Lemma flights{i} : flights side eta nu eps {a} {b} {d} {e} {T} {u} {v}.
Proof. split; [lra|apply possible{i}|apply launch{i}|apply flight{i}|apply fall{i}|apply end{i}]. Qed.
Lemma rates{i} phi g t : {x} <= phi <= {y} -> {g0} <= g <= {g1} -> {u} < t < {v} ->
  {p} <= DP_p side eta nu eps phi g t /\\ Rabs (DP_g side eta nu eps phi g t) <= {q} /\\
  Rabs (DQ_p side eta nu eps phi g t) <= {r} /\\ Rabs (DQ_g side eta nu eps phi g t) <= {s}.
Proof. intros P G S. split; [boxes phi t|repeat split; apply Rabs_le; split; boxes phi t]. Qed.
"""
VELOCITY = """
Lemma velocity{i}_{j} phi g : {l} <= phi <= {h} -> {g0} <= g <= {g1} ->
  {g0} <= arrival phi g (time phi g) <= {g1}.
Proof.
  intros P G. assert (H : {first} < time phi g < {last}).
  {{ apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights{i}); try lra; line phi. }}
  generalize dependent (time phi g). intros t S. split; boxes phi t.
Qed.
"""
FACTS = """
Lemma left{i} g : {g0} <= g <= {g1} -> {x} + time {x} g - 2 * PI * IZR {k} <= {A}.
Proof.
  intros G. pose proof PI_near as Pi.
  assert (H : {u} < time {x} g < {A} + 2 * PI * IZR {k} - {x}); [|lra].
  apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights{i}); try lra; line g.
Qed.
Lemma right{i} g : {g0} <= g <= {g1} -> {B} <= {y} + time {y} g - 2 * PI * IZR {k}.
Proof.
  intros G. pose proof PI_near as Pi.
  assert (H : {B} + 2 * PI * IZR {k} - {y} < time {y} g < {v}); [|lra].
  apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights{i}); try lra; line g.
Qed.
Lemma facts{i} : rectangle_facts side eta nu eps {A} {B} {g0} {g1} {p} {q} {r} {s}
  {a} {x} {y} {b} {d} {e} {T} {u} {v} {k}.
Proof.
  assert (Time : forall phi g, {x} <= phi <= {y} -> {g0} <= g <= {g1} -> {u} < time phi g < {v}).
  {{ intros phi g P G. apply (time_first side eta nu eps eta_pos _ _ _ _ _ _ _ flights{i}); lra. }}
  split; [lra|apply flights{i}| | | |apply left{i}|apply right{i}].
  - intros phi g P G. apply rates{i}; auto.
  - intros phi g P G.{velocities}
  - intros phi g P G. specialize (Time phi g P G). pose proof PI_near as Pi. lra.
Qed.
"""

HORSESHOE = """
(* {says} *)
Theorem rectangles_horseshoe : exists size,
  two_sided_shift rebound {A} {b0} {a1} {B} {g0} {g1} {c} {rate} size.
Proof.
  eexists. pose proof PI_near as Pi. pose proof eps_pos as Ep.
  eapply rebounds with (p := {p}) (q := {q}) (r := {r}) (s := {s});
    first [exact facts0 | exact facts1 | exact eta_pos | unfold side; lra | lra].
Qed.
"""

HYPERBOLIC = """
(* {says} *)
Theorem hyperbolic : forall f g f' g', {A} <= f <= {b0} /\\ {A} <= f' <= {b0} \\/
    {a1} <= f <= {B} /\\ {a1} <= f' <= {B} -> {g0} <= g <= {g1} -> {g0} <= g' <= {g1} ->
  let dx := Rabs (f' - f) in let dg := Rabs (g' - g) in
  let dx' := Rabs (f' + time f' g' - (f + time f g)) in
  let dg' := Rabs (arrival f' g' (time f' g') - arrival f g (time f g)) in
  (g = g' -> {p} * dx <= dx') /\\ (f = f' -> dx' <= {q} * dg /\\ dg' <= {s} * dg) /\\
  (dg <= {c} * dx -> {expansion} * dx <= dx' /\\ dg' <= {c} * dx') /\\
  ({c} * dx' <= dg' -> dg' <= {contraction} * dg).
Proof.
  intros f g f' g' Hf Hg Hg' dx dg dx' dg'. assert (D : 0 <= dg) by apply Rabs_pos.
  assert (H : (g = g' -> {p} * dx <= dx') /\\ (f = f' -> dx' <= {q} * dg /\\ dg' <= {s} * dg) /\\
    (dg <= {c} * dx -> ({p} - {q} * {c}) * dx <= dx' /\\ dg' <= {c} * dx') /\\
    ({c} * dx' <= dg' -> ({c} * {p} - {r}) * dg' <= {c} * ({r} * {q} + {s} * {p}) * dg)).
  {{ destruct Hf as [[Hf Hf']|[Hf Hf']].
    - apply (Restitution.hyperbolic side eta nu eps eta_pos _ _ _ _ {p} {q} {r} {s} {c} _ _ _ _ _ _ _ _ _ _
        ltac:(lra) ltac:(lra) facts0 f g f' g' Hf Hf' Hg Hg').
    - apply (Restitution.hyperbolic side eta nu eps eta_pos _ _ _ _ {p} {q} {r} {s} {c} _ _ _ _ _ _ _ _ _ _
        ltac:(lra) ltac:(lra) facts1 f g f' g' Hf Hf' Hg Hg'). }}
  destruct H as (H1 & H2 & H3 & H4). assert (X : 0 <= dx) by apply Rabs_pos.
  repeat split; intros; try apply H2; try (apply H3; assumption); try (specialize (H3 H); lra);
    try (specialize (H4 H); lra); auto.
Qed.
"""

EDGE = """
(* {says} *)
Theorem printed_edge_falls_short : (exists z, rebound ({x}, {g}) z) /\\
  forall z, rebound ({x}, {g}) z -> fst z < {x}.
Proof.
  pose proof PI_near as Pi. assert (H : {u} < time {x} {g} < 2 * PI * {k}).
  {{ apply (time_bracket side eta nu eps eta_pos _ _ _ _ _ _ _ flights{i}); try lra; at_once. }}
  destruct (time_first side eta nu eps eta_pos _ _ _ _ _ _ _ flights{i} {x} {g}) as [F0 _]; [lra|lra|].
  split.
  - eexists. exists (time {x} {g}), {k}%Z. split; [exact F0|split; [reflexivity|]]. simpl. lra.
  - intros z (t & n & F & -> & L). simpl in *. rewrite <- (time_spec _ _ _ _ _ _ _ F) in *.
    assert (K : ({k} - 1 < n)%Z) by (apply lt_IZR; apply Rmult_lt_reg_l with (2 * PI); rewrite ?minus_IZR; lra).
    assert (K' : {k} <= IZR n) by (apply IZR_le; lia).
    assert (2 * PI * {k} <= 2 * PI * IZR n) by (apply Rmult_le_compat_l; lra). lra.
Qed.
"""

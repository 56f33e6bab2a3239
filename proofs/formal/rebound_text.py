"""The Coq text on two rectangles of states with restitution, that `rebounds` fills in."""

HEAD = """(* Written by python -m proofs formal from the certificate with the digest
   {digest}.
   Not trusted: Coq computes and proves. To be read: Rebounds.v, and the theorems stated here. *)
From Coq Require Import Reals ZArith Psatz List.
From Coquelicot Require Import Coquelicot.
From Oscillator Require Import Impact Rebounds Restitution Numbers Flights Strips.
Import ListNotations.
Open Scope R_scope.

Definition side := {side}.
Definition eta := {eta}.
Definition nu := {nu}.
Definition eps := {eps}.
Notation height := (Rebounds.height side eta nu eps).
Notation arrival := (Rebounds.arrival eta nu eps).
Notation rebound := (Rebounds.rebound side eta nu eps).
Notation time := (Restitution.time side eta nu eps).
Lemma eta_pos : 0 < eta. Proof. unfold eta; lra. Qed.
Ltac equal := unfold ratio, side, eta, nu, eps; simpl; repeat split; field.
Ltac less := unfold side, eps; try split; lra.
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

STRIPS = """
Definition bounds := Bounds {bounds}.
Definition left := {left}.
Definition right := {right}.
Lemma checked : check_strips {bits} {unit} ({side}) {eta_} ({nu_}) {eps_} bounds left right = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
"""

HORSESHOE = """
(* {says} *)
Theorem rectangles_horseshoe : two_sided_shift rebound {A} {b0} {a1} {B} {g0} {g1} {rate}.
Proof.
  apply (strips_horseshoe _ _ _ _ _ _ _ _ _ checked eq_refl) with (p := {p}) (q := {q}) (r := {r}) (s := {s}) (c := {c});
    first [less | equal].
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
  apply (strips_hyperbolic _ _ _ _ _ _ _ _ _ checked eq_refl) with (r := {r}); first [less | equal].
Qed.
"""

EDGE = """
(* {says} *)
Theorem printed_edge_falls_short :
  (exists k : Z, forall f g, {a1} <= f <= {B} -> {g0} <= g <= {g1} ->
    0 <= f + time f g - 2 * PI * IZR k < 2 * PI) /\\
  exists z, rebound ({x}, {g}) z /\\ {l} < fst z < {x}.
Proof.
  apply (strip_falls_short _ _ _ _ _ _ _ _ _ checked eq_refl) with (A := {A}) (b0 := {b0}) (l := ({l_})%Z)
    (x := ({x_})%Z) (g := ({g_})%Z) (t0 := ({t0})%Z) (t := ({t})%Z);
    first [vm_compute; reflexivity | equal].
Qed.
"""

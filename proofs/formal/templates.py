"""The Coq text that `cases` fills in."""

from __future__ import annotations

from fractions import Fraction

from proofs.formal.plan import Headline
from proofs.trusted.numbers import show, show_range

FLOATS = "From Interval Require Import Tactic."
INTEGERS = """From Interval Require Import Specific_stdz Specific_ops.
From Interval Require Tactic.
Module Integers := SpecificFloat StdZRadix2.
Module Exact := Tactic.IntervalTactic Integers.
Import Tactic Exact."""

HEAD = """(* Written by python -m proofs.formal from {source}.
   Not trusted: coqc proves every line. To be read: Impact.v, and the theorems stated here. *)
From Coq Require Import Reals ZArith Psatz Lia.
From Coquelicot Require Import Coquelicot.
{arithmetic}
From Oscillator Require Import Impact Chaos Flight Shift Corrected Verdicts Consequences Claims.
Open Scope R_scope.

Definition side := {side}.
Definition eta := {eta}.
Definition nu := {nu}.

Lemma eta_pos : 0 < eta. Proof. unfold eta; lra. Qed.
Notation gap := (Impact.gap side eta nu).
Notation gap_t := (Flight.gap_t side eta nu).
Notation gap_tt := (Flight.gap_tt side eta nu).
Notation slope := (Flight.slope side eta nu).
Notation impact_time := (Flight.impact_time side eta nu).
Notation rate := (Corrected.rate side eta nu).
Notation first_impact := (Impact.first_impact side eta nu).
Notation next := (Impact.next side eta nu).
Notation slope_at := (Impact.slope_at side eta nu).
Lemma PI_near : 3141592653589793238462643383279 / 1000000000000000000000000000000 < PI
  < 3141592653589793238462643383280 / 1000000000000000000000000000000.
Proof. split; interval with (i_prec 120). Qed.
Ltac over E x := generalize (E x ltac:(lra)) PI_near; unfold lift; lra.
Ltac slopes r0 r1 b0 b1 := intros [|] x X; unfold In_ in X; exists (rate x);
  [split; [apply (slope_at_rate side eta nu _ _ b1); lra | generalize (r1 x X); lra] |
   split; [apply (slope_at_rate side eta nu _ _ b0); lra | generalize (r0 x X); lra]].
Ltac num := intros; unfold Impact.gap, Flight.gap_t, Flight.gap_tt, Flight.slope, side, eta, nu.
Ltac at_once := num; interval{plain}.
Ltac one p := num; interval with (i_bisect p, i_autodiff p, i_depth 60{bits}).
Ltac two p t := num; interval with (i_bisect t, i_bisect p, i_depth 60{bits}).
Ltac flight p t := num; first [ interval with (i_bisect t, i_autodiff t, i_depth 60{bits}) |
  interval with (i_bisect t, i_bisect p, i_depth 60{bits}) ].
Ltac sloping p e := num; split; interval with (i_bisect p, i_bisect e, i_autodiff p, i_depth 60{bits}).
"""

BRANCH = """
Lemma launch{i} : forall phi t, {a} <= phi <= {b} -> 0 <= t <= {T} -> 0 < gap_tt phi t.
Proof. two phi t. Qed.
Lemma flight{i} : forall phi t, {a} <= phi <= {b} -> {T} <= t <= {u} -> 0 < gap phi t.
Proof. flight phi t. Qed.
Lemma fall{i} : forall phi t, {a} <= phi <= {b} -> {u} <= t <= {v} -> gap_t phi t < 0.
Proof. two phi t. Qed.
Lemma end{i} : forall phi, {a} <= phi <= {b} -> gap phi {v} < 0.
Proof. one phi. Qed.
Lemma branch{i} : branch side eta nu {a} {b} {T} {u} {v}.
Proof. split; [lra | apply launch{i} | apply flight{i} | apply fall{i} | apply end{i}]. Qed.
"""

REGULAR = """
Lemma regular{i} : regular side eta nu {a} {b}.
Proof.{parts}
Qed.
"""
GLUED = "\n  apply (glue _ _ _ _ {b} {c}); [apply (branch_regular _ _ _ eta_pos _ _ _ _ _ branch{branch}) | | lra | lra | lra]."
LAST = "\n  apply (branch_regular _ _ _ eta_pos _ _ _ _ _ branch{branch})."

PIECE = """
Lemma {name} : forall phi, {p} <= phi <= {q} -> {lo} <= rate phi <= {hi}.
Proof.
  apply (piece side eta nu eta_pos _ _ _ _ _ branch{branch} _ _ {z} {r} {d}); [lra | intros; lra | lra | | | ].
  - one phi.
  - one phi.
  - sloping phi e.
Qed.
"""

RATE = """
Lemma rate_{set}{i} : forall phi, {x} <= phi <= {y} -> {lo} <= rate phi <= {hi}.
Proof.
  intros phi P.{cuts}
Qed.
"""

MONOTONE = """
Lemma monotone_{set}{i} : monotone side eta nu {a} {b} {x} {y} {s} {m} {M}.
Proof. split; [lra | first [left; lra | right; lra] | lra | intros phi P; generalize (rate_{set}{i} phi P); lra]. Qed.
"""

IMPACT = """
Lemma {name} : forall phi, {p} <= phi <= {q} -> {s} < impact_time phi < {t}.
Proof.
  apply (bracket side eta nu eta_pos _ _ _ _ _ branch{branch} _ _ (fun _ => {s}) (fun _ => {t}));
    [lra | intros; lra | one phi | one phi].
Qed.
"""

LAP = """
Lemma lap{i} : in_lap side eta nu {a} {b} {k}.
Proof.
  apply (lap side eta nu _ _ regular{i} _ _ _ _ _ monotone_whole{i} _ {l} {r}).
  - intros p [P | P]; [generalize (before{i} p ltac:(lra)) | generalize (after{i} p ltac:(lra))];
      unfold lift; lra.
  - generalize PI_near; lra.
  - generalize PI_near; lra.
Qed.
"""

COVERS = """
Lemma covers_{set}{i} : covers side eta nu {a} {b} {x} {y} {s} {A} {B} {k}.
Proof.
  split; [apply lap{i} | destruct (Rlt_dec 0 {s}); try lra | destruct (Rlt_dec 0 {s}); try lra].
  - over end_{set}{i}_0 {x}.
  - over end_{set}{i}_1 {y}.
Qed.
"""

ESCAPE = """
(* No launch from [{p}, {q}] has its impact in [{A}, {B}]; each has one. *)
Lemma {name}{j}_launch : forall phi t, {p} <= phi <= {q} -> 0 <= t <= {T} -> 0 < gap_tt phi t.
Proof. two phi t. Qed.
Lemma {name}{j}_below : forall phi, {p} <= phi <= {q} -> gap phi {v} < 0.
Proof. one phi. Qed.
Lemma {name}{j} : forall phi psi, {p} <= phi <= {q} -> next phi psi -> ~ {A} <= psi <= {B}.
Proof.
  apply (escape side eta nu eta_pos {p} {q} {T} {A} {B} {K} {v});
    [lra | lra | lra | lra | generalize PI_near; lra | generalize PI_near; lra |
     apply {name}{j}_launch | | apply {name}{j}_below].
  intros k phi psi H P S.
  assert (C : {cases}) by lia.
  clear H; repeat destruct C as [-> | C]; try (subst k || destruct C); two phi psi.
Qed.
Lemma {name}{j}_meets : forall phi, {p} <= phi <= {q} -> exists psi, next phi psi.
Proof.
  intros phi P. destruct (impact_exists side eta nu eta_pos phi {T} {v}) as [t I];
    [lra | intros; apply {name}{j}_launch; lra | lra | apply {name}{j}_below; lra |].
  apply (next_exists _ _ _ phi t I).
Qed.
"""

AVOIDS = """
Lemma {name} : forall phi psi, {p} <= phi <= {q} -> next phi psi -> ~ {A} <= psi <= {B}.
Proof.
  intros phi psi P N.{cuts}
Qed.
Lemma {name}_meets : forall phi, {p} <= phi <= {q} -> exists psi, next phi psi.
Proof.
  intros phi P.{met}
Qed.
"""

ALL = """
(* What all theorems together rest on. *)
Definition all := ({names}).
Print Assumptions all.
"""

# -- theorems --------------------------------------------------------------------------------------

SAYS = """
(* {says} *)
"""

HORSESHOE = SAYS + """Theorem {name} : horseshoe next {A} {b0} {a1} {B} {s0} {s1} {m} {M}.
Proof.
  eapply corrected with (3 := regular0) (4 := regular1) (5 := monotone_horseshoe0)
    (6 := monotone_horseshoe1) (7 := covers_horseshoe0) (8 := covers_horseshoe1);
    [lra | lra | | lra].
  intros phi psi P N H. apply ({avoid} phi psi); auto; lra.
Qed.
"""

H4_VERIFIED = SAYS + r"""Theorem {name} : forall phi, {y0} < phi < {x1} ->
  (exists psi, next phi psi) /\ forall psi, next phi psi -> ~ {A} <= psi <= {B}.
Proof.
  intros phi P. split; [apply {avoid}_meets; lra |].
  intros psi N H. apply ({avoid} phi psi); auto; lra.
Qed.
"""

H4_REFUTED = SAYS + r"""Theorem {name} : {y0} < {p} < {x1} /\ exists psi, next {p} psi /\ {A} <= psi <= {B}.
Proof.
  split; [lra |].
  apply (image_of_point side eta nu eta_pos _ _ _ _ _ branch_{c} {p} {s} {t} {k});
    try (generalize PI_near; lra); at_once.
Qed.
"""

_IN = "In_ {x0} {y0} {x1} {y1} i"

H1_VERIFIED = SAYS + """Theorem {name} : forall i x, """ + _IN + r""" x ->
  exists d, slope_at x d /\ {lo} <= d.
Proof. slopes rate_printed0 rate_printed1 regular0 regular1. Qed.
"""

H2_VERIFIED = SAYS + """Theorem {name} : forall i x, """ + _IN + r""" x ->
  exists d, slope_at x d /\ d <= {hi}.
Proof. slopes rate_printed0 rate_printed1 regular0 regular1. Qed.
"""

H3_VERIFIED = SAYS + """Theorem {name} : forall i, exists F,
  (forall x, """ + _IN + r""" x -> continuous F x /\ first_impact x (F x - x)) /\
  forall x y, """ + _IN + " x -> " + _IN + """ y -> x < y -> F x < F y.
Proof.
  intros [|];
    [destruct (monotone_lift side eta nu _ _ regular1 _ _ _ _ _ monotone_printed1) as (F & C & G) |
     destruct (monotone_lift side eta nu _ _ regular0 _ _ _ _ _ monotone_printed0) as (F & C & G)];
    exists F; (split; [exact C |]); intros x y X Y L; unfold In_ in X, Y;
    generalize (G x y ltac:(lra) ltac:(lra) ltac:(lra)); lra.
Qed.
"""

H6_VERIFIED = SAYS + r"""Theorem {name} : forall c d, c < d -> {x0} <= c /\ d <= {y0} \/ {x1} <= c /\ d <= {y1} ->
  forall i x y u v, """ + _IN + " x -> " + _IN + """ y -> x <= y -> next x u -> next y v ->
  c <= u <= d -> c <= v <= d -> y - x < (d - c) / {lo}.
Proof.
  intros c d L J [|] x y u v X Y O N N' U V; unfold In_ in X, Y.
  - apply (shorter {m1}); [lra | lra | lra |].
    apply (short_preimage side eta nu _ _ regular1 _ _ _ _ _ monotone_printed1 {x0} {y1}) with u v;
      auto; try lra. generalize PI_near; lra.
  - apply (shorter {m0}); [lra | lra | lra |].
    apply (short_preimage side eta nu _ _ regular0 _ _ _ _ _ monotone_printed0 {x0} {y1}) with u v;
      auto; try lra. generalize PI_near; lra.
Qed.
"""

VERIFIED = {"H1": H1_VERIFIED, "H2": H2_VERIFIED, "H3": H3_VERIFIED, "H6": H6_VERIFIED}

_POINT = """
Proof.
  split; [lra |]. destruct (slope_of_point side eta nu eta_pos _ _ _ _ _ branch_{c} {p} {s} {t} {m} {M})
    as (d & D & R); [lra | lra | at_once | at_once | split; one r | exists d; split; [exact D | lra]].
Qed.
"""
_INSIDE = SAYS + r"Theorem {name} : ({x0} < {p} < {y0} \/ {x1} < {p} < {y1}) /\ "

REFUTED = {
    "H1": _INSIDE + r"exists d, slope_at {p} d /\ d < {lo}." + _POINT,
    "H2": _INSIDE + r"exists d, slope_at {p} d /\ {hi} < d." + _POINT,
    "H3": _INSIDE + r"exists d, slope_at {p} d /\ d < 0." + _POINT,
}

H6_REFUTED = SAYS + r"""Theorem {name} : exists c d q, ({x0} <= c /\ d <= {y0} \/ {x1} <= c /\ d <= {y1}) /\ c < d /\
  ({x0} <= {p} /\ q <= {y0} \/ {x1} <= {p} /\ q <= {y1}) /\ {p} < q /\
  next {p} c /\ next q d /\ (d - c) / {lo} <= q - {p}.
Proof.
  destruct (long_preimage side eta nu eta_pos _ _ _ _ _ branch_{c} {p} {s} {t} {k} {m} {M} {lo} {A} {B} {y})
    as (c & d & q & J & Q & Np & Nq & L);
    [lra | lra | at_once | at_once | split; one r | lra | lra | lra | lra |
     generalize PI_near; lra | generalize PI_near; lra | generalize PI_near; lra |].
  exists c, d, q. repeat split; auto; lra.
Qed.
"""

H5_VERIFIED = SAYS + r"""Theorem {name} : forall c d, c < d -> {x0} <= c /\ d <= {y0} \/ {x1} <= c /\ d <= {y1} ->
  exists l0 r0 l1 r1, {x0} <= l0 < r0 /\ r0 <= {y0} /\ {x1} <= l1 < r1 /\ r1 <= {y1} /\
    forall x, {x0} <= x <= {y1} ->
    ((exists y, next x y /\ c <= y <= d) <-> l0 <= x <= r0 \/ l1 <= x <= r1).
Proof.
  intros c d L J.
  eapply two_preimages with (3 := regular0) (4 := regular1) (5 := monotone_printed0)
    (6 := monotone_printed1) (7 := covers_printed0) (8 := covers_printed1);
    [lra | lra | | lra | lra | lra].
  intros phi psi P N H. apply ({avoid} phi psi); auto; lra.
Qed.
"""

H5_REFUTED = SAYS + r"""Theorem {name} : ({x0} <= {c} /\ {c} < {d} /\ {d} <= {y0} \/ {x1} <= {c} /\ {c} < {d} /\ {d} <= {y1}) /\
  forall x y, {x} <= x <= {y} -> next x y -> ~ {c} <= y <= {d}.
Proof.
  split; [lra |].
  apply (missed side eta nu _ _ _ _ _ _ _ {k} regular{i} monotone_printed{i} lap{i}).
  intros z Z. generalize (missed{i}_0 {x} ltac:(lra)) (missed{i}_1 {y} ltac:(lra)) PI_near.
  unfold lift. lra.
Qed.
"""


FOLLOWS = {
    "theorem_3": SAYS + """Theorem {name} : chaos next (stays next {A} {B}).
Proof.
  apply (chaos_theorem next {A} {b0} {a1} {B} {m} {M});
    [lra | lra | apply next_unique | exact (proj2 (proj2 {of}))].
Qed.
""",
    "theorem_4": SAYS + """Theorem {name} : cantor_set (stays next {A} {B}).
Proof.
  apply (cantor_theorem next {A} {b0} {a1} {B} {m} {M});
    [lra | lra | lra | exact (proj2 (proj2 {of}))].
Qed.
""",
    "measure_zero": SAYS + """Theorem {name} : null (stays next {A} {B}).
Proof.
  apply (null_theorem next {A} {b0} {a1} {B} {m} {M});
    [lra | lra | exact (proj2 (proj2 {of})) | lra].
Qed.
""",
}
FOLLOWS_IN_WORDS = {
    "theorem_3": "among the phases that stay in I, 2^n are fixed by f^n for every n > 0, there are "
    "orbits of every least period, uncountably many nonperiodic orbits, and a dense one",
    "theorem_4": "the phases that stay in I are a Cantor set: compact, without isolated points, and "
    "without an interval",
    "measure_zero": "the phases that stay in I have Lebesgue measure zero",
}

NO_WORD = SAYS + """Theorem {name} :
  ~ exists x, itinerary next {x0} {y0} {x1} {y1} x (fun _ => false).
Proof.
  destruct {of} as [[g G] _].
  apply (no_point next {A} {b0} {a1} {B} 1 {s1} {m} {M} g); unfold In_; [exact G | lra | lra | lra | lra |].
  exists (lift side eta nu {x0} - 2 * PI * {k}).
  split; [|generalize (missed0_0 {x0} ltac:(lra)) PI_near; unfold lift; lra].
  destruct (f_lift side eta nu _ _ regular0 {k} lap0 {x0} ltac:(lra)) as [E U].
  apply U. symmetry. exact E.
Qed.
"""

H11 = SAYS + r"""Theorem {name} : exists s,
  {l} < s < {r} /\ forall t, moran {r0} {r1} t = 1 <-> t = s.
Proof.
  apply moran_root; [lra | lra | lra |]. unfold moran, Rpower.
  split; interval with (i_prec 53).
Qed.
"""

H16 = SAYS + r"""Theorem {name} : forall s, moran {r0} {r1} s = 1 ->
  let q x := Rpower ((1 - {r1}) / {r0} + x) s - 1 - Rpower x s in
  (forall x y, 0 < x < y -> q y < q x) /\ q ({r1} / {r0}) = 0.
Proof. intros s. apply gap_function; lra. Qed.
"""


def horseshoe_in_words(headline: Headline) -> str:
    """Return the theorem on the horseshoe in a line."""
    low, high = map(show, headline.slopes)
    ways = {1: f"{low} <= f' <= {high}", -1: f"{low} <= -f' <= {high}"}
    slopes = " and ".join(
        dict.fromkeys(
            f"{ways[sign]} on {name}" if headline.signs[0] != headline.signs[1] else ways[sign]
            for sign, name in zip(headline.signs, ("I0", "I1"), strict=True)
        )
    )
    return (
        f"a horseshoe on I0 = {show_range(headline.left)}, I1 = {show_range(headline.right)}: "
        f"f is C^1 there with {slopes}, f(I0) and f(I1) contain I = {show_range(headline.interval)}, "
        "the rest of I leaves it; every word has its interval of phases, and the phases that stay "
        "in I are conjugate to the full shift on two symbols, by a homeomorphism"
    )

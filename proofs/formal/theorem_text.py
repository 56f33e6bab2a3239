"""The Coq text of theorems, that `cases` fills in."""

from __future__ import annotations

from proofs.formal.plan import Headline
from proofs.trusted.numbers import show, show_range

SAYS = """
(* {says} *)
"""

MODEL = (
    SAYS
    + r"""Theorem model : (side = 1 /\ 0 < nu \/ side = -1 /\ nu < 0) /\ forall (X V : R -> R) phi,
  (forall t, is_derive X t (V t)) -> (forall t, is_derive V t (- eta ^ 2 * X t)) ->
  X 0 = 1 + nu * sin phi -> V 0 = nu * cos phi ->
  forall t, side * (X t - (1 + nu * sin (phi + t))) = gap phi t.
Proof. split; [unfold side, nu; lra | exact (motion side eta nu eta_pos)]. Qed.
"""
)
MODEL_IN_WORDS = (
    "the gap is the distance from the table of any mass that leaves it at phase phi with its "
    "velocity and moves by X'' = -eta^2 X, in units of the sign of nu"
)

HORSESHOE = (
    SAYS
    + """Theorem {name} : horseshoe next {A} {b0} {a1} {B} {s0} {s1} {m} {M}.
Proof.
  eapply corrected with (3 := regular0) (4 := regular1) (5 := monotone_horseshoe0)
    (6 := monotone_horseshoe1) (7 := covers_horseshoe0) (8 := covers_horseshoe1);
    [lra | lra | | lra | intros phi P; apply {avoid}; lra].
  intros phi psi P N H. apply (proj2 ({avoid} phi ltac:(lra)) psi N). lra.
Qed.
"""
)

H4_VERIFIED = (
    SAYS
    + r"""Theorem {name} : forall phi, {y0} < phi < {x1} ->
  (exists psi, next phi psi) /\ forall psi, next phi psi -> ~ {A} <= psi <= {B}.
Proof.
  intros phi P. destruct ({avoid} phi ltac:(lra)) as [E L]. split; [exact E |].
  intros psi N H. apply (L psi N). lra.
Qed.
"""
)

H4_REFUTED = (
    SAYS
    + r"""Theorem {name} : {y0} < {p} < {x1} /\ exists psi, next {p} psi /\ {A} <= psi <= {B}.
Proof.
  split; [lra |].
  apply (image_of_point side eta nu eta_pos _ _ _ _ _ branch_{c} {p} {s} {t} {k});
    try (generalize PI_near; lra); at_once.
Qed.
"""
)

_IN = "In_ {x0} {y0} {x1} {y1} i"

H1_VERIFIED = (
    SAYS
    + """Theorem {name} : forall i x, """
    + _IN
    + r""" x ->
  exists d, slope_at x d /\ {lo} <= d.
Proof. slopes rate_printed0 rate_printed1 regular0 regular1. Qed.
"""
)

H2_VERIFIED = (
    SAYS
    + """Theorem {name} : forall i x, """
    + _IN
    + r""" x ->
  exists d, slope_at x d /\ d <= {hi}.
Proof. slopes rate_printed0 rate_printed1 regular0 regular1. Qed.
"""
)

H3_VERIFIED = (
    SAYS
    + """Theorem {name} : forall i, exists F,
  (forall x, """
    + _IN
    + r""" x -> continuous F x /\ first_impact x (F x - x)) /\
  forall x y, """
    + _IN
    + " x -> "
    + _IN
    + """ y -> x < y -> F x < F y.
Proof.
  intros [|];
    [destruct (monotone_lift side eta nu _ _ regular1 _ _ _ _ _ monotone_printed1) as (F & C & G) |
     destruct (monotone_lift side eta nu _ _ regular0 _ _ _ _ _ monotone_printed0) as (F & C & G)];
    exists F; (split; [exact C |]); intros x y X Y L; unfold In_ in X, Y;
    generalize (G x y ltac:(lra) ltac:(lra) ltac:(lra)); lra.
Qed.
"""
)

H6_VERIFIED = (
    SAYS
    + r"""Theorem {name} : forall c d, c < d -> {x0} <= c /\ d <= {y0} \/ {x1} <= c /\ d <= {y1} ->
  forall i x y u v, """
    + _IN
    + " x -> "
    + _IN
    + """ y -> x <= y -> next x u -> next y v ->
  c <= u <= d -> c <= v <= d -> y - x < (d - c) / {lo}.
Proof.
  intros c d L J [|] x y u v X Y O N N' U V; unfold In_ in X, Y.
  - apply (shorter {m1}); [lra | lra | lra |].
    apply (short_preimage side eta nu eta_pos _ _ regular1 _ _ _ _ _ monotone_printed1 {x0} {y1}) with u v;
      auto; try lra. generalize PI_near; lra.
  - apply (shorter {m0}); [lra | lra | lra |].
    apply (short_preimage side eta nu eta_pos _ _ regular0 _ _ _ _ _ monotone_printed0 {x0} {y1}) with u v;
      auto; try lra. generalize PI_near; lra.
Qed.
"""
)

VERIFIED = {"H1": H1_VERIFIED, "H2": H2_VERIFIED, "H3": H3_VERIFIED, "H6": H6_VERIFIED}

_POINT = """
Proof.
  split; [lra |]. destruct (slope_of_point side eta nu eta_pos _ _ _ _ _ branch_{c} {p} {s} {t} {m} {M})
    as (d & D & R); [lra | lra | at_once | at_once | split; one r | exists d; split; [exact D | lra]].
Qed.
"""
_INSIDE = SAYS + r"Theorem {name} : ({x0} < {p} < {y0} \/ {x1} < {p} < {y1}) /\ "

H6_REFUTED = (
    SAYS
    + r"""Theorem {name} : exists c d q, ({x0} <= c /\ d <= {y0} \/ {x1} <= c /\ d <= {y1}) /\ c < d /\
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
)

REFUTED = {
    "H4": H4_REFUTED,
    "H6": H6_REFUTED,
    "H1": _INSIDE + r"exists d, slope_at {p} d /\ d < {lo}." + _POINT,
    "H2": _INSIDE + r"exists d, slope_at {p} d /\ {hi} < d." + _POINT,
    "H3": _INSIDE + r"exists d, slope_at {p} d /\ d < 0." + _POINT,
}

H5_VERIFIED = (
    SAYS
    + r"""Theorem {name} : forall c d, c < d -> {x0} <= c /\ d <= {y0} \/ {x1} <= c /\ d <= {y1} ->
  exists l0 r0 l1 r1, {x0} <= l0 < r0 /\ r0 <= {y0} /\ {x1} <= l1 < r1 /\ r1 <= {y1} /\
    forall x, {x0} <= x <= {y1} ->
    ((exists y, next x y /\ c <= y <= d) <-> l0 <= x <= r0 \/ l1 <= x <= r1).
Proof.
  intros c d L J.
  eapply two_preimages with (3 := regular0) (4 := regular1) (5 := monotone_printed0)
    (6 := monotone_printed1) (7 := covers_printed0) (8 := covers_printed1);
    [lra | lra | | lra | lra | lra].
  intros phi psi P N H. apply (proj2 ({avoid} phi ltac:(lra)) psi N). lra.
Qed.
"""
)

H5_REFUTED = (
    SAYS
    + r"""Theorem {name} : ({x0} <= {c} /\ {c} < {d} /\ {d} <= {y0} \/ {x1} <= {c} /\ {c} < {d} /\ {d} <= {y1}) /\
  forall x y, {x} <= x <= {y} -> next x y -> ~ {c} <= y <= {d}.
Proof.
  split; [lra |].
  apply (missed side eta nu _ _ _ _ _ _ _ {k} regular{i} monotone_printed{i} lap{i}).
  intros z Z. generalize (missed{i}_0 {x} ltac:(lra)) (missed{i}_1 {y} ltac:(lra)) PI_near.
  unfold lift. lra.
Qed.
"""
)


FOLLOWS = (
    SAYS
    + """Theorem {name} : {what} (stays next {A} {B}).
Proof.
  apply ({by} next {A} {b0} {a1} {B} {m} {M});
    first [lra | apply next_unique | exact (proj2 (proj2 {of}))].
Qed.
"""
)
CONSEQUENCES = {  # of the horseshoe: what is stated, by which theorem of Consequences.v, in words
    "theorem_3": (
        "chaos next",
        "chaos_theorem",
        "among the phases that stay in I, 2^n are fixed by f^n for every n > 0, there are orbits of "
        "every least period, uncountably many nonperiodic orbits, and a dense one",
    ),
    "theorem_4": (
        "cantor_set",
        "cantor_theorem",
        "the phases that stay in I are a Cantor set: compact, without isolated points, and without "
        "an interval",
    ),
    "measure_zero": (
        "null",
        "null_theorem",
        "the phases that stay in I have Lebesgue measure zero",
    ),
}

FOLLOWED = """
Lemma landed : lands_twice {bits} {unit} ({side}) {eta} ({nu})
  {first}
  {second} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Lemma followed : exists y z, next {P} y /\\ {A} <= y <= {b0} /\\ next y z /\\ {b0} < z < {a1}.
Proof.
  destruct (computed_orbit _ _ _ _ _ _ _ _ _ _ _ _ _ side eta nu {P} landed eq_refl) as (y & z & Y & L & Z & M);
    try (unfold ratio, side, eta, nu; cbn [first_phase last_phase]; field).
  exists y, z. unfold ratio in L, M. repeat split; auto; lra.
Qed.
"""
_ON_LAMBDA = """
  destruct {of} as [(f & I) (_ & F)], followed as (y & z & N & Y & N' & Z).
  apply (lambda_{way} next {A} {b0} {a1} {B} {m} {M}) with (f := f) (y := y) (z := z); auto; try lra.
  apply next_unique.
Qed.
"""
LAMBDA = {
    "H8": SAYS
    + r"""Theorem {name} : rich next (stays next {P} {B}) /\
  forall n, (0 < n)%nat -> exists l, forall x, stays next {P} {B} x -> iterate next n x x -> In x l.
Proof.
  split; [|intros n n0; destruct (proj1 theorem_3 n n0) as (l & _ & _ & E); exists l; intros x S It;
    apply E; split; auto; apply stays_part with (2 := S); lra]."""
    + _ON_LAMBDA.replace("{way}", "rich"),
    "H9": SAYS
    + "Theorem {name} : cantor_set (stays next {P} {B}).\nProof."
    + _ON_LAMBDA.replace("{way}", "cantor"),
    "H10": SAYS
    + """Theorem {name} : null (stays next {P} {B}).
Proof. apply (null_part _ (stays next {A} {B})); [intros x; apply stays_part; lra | exact measure_zero]. Qed.
""",
}

NO_WORD = (
    SAYS
    + """Theorem {name} :
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
)

H11 = (
    SAYS
    + r"""Theorem {name} : exists s,
  {l} < s < {r} /\ forall t, moran {r0} {r1} t = 1 <-> t = s.
Proof.
  apply moran_root; [lra | lra | lra |]. unfold moran, Rpower.
  split; interval with (i_prec 53).
Qed.
"""
)

H16 = (
    SAYS
    + r"""Theorem {name} : forall s, moran {r0} {r1} s = 1 ->
  let q x := Rpower ((1 - {r1}) / {r0} + x) s - 1 - Rpower x s in
  (forall x y, 0 < x < y -> q y < q x) /\ q ({r1} / {r0}) = 0.
Proof. intros s. apply gap_function; lra. Qed.
"""
)


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
        "each other phase of I has its image outside; every word has its interval of phases, and the phases that stay "
        "in I are conjugate to the full shift on two symbols, by a homeomorphism"
    )

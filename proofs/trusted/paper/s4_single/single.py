"""Section 4: single-impact periodic orbits, as printed and as they are. Trusted, and shared."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.numbers import Range, ceil_text, floor_text, show
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.formulas import Equal, Value, at
from proofs.trusted.paper.s4_single import displayed as eq
from proofs.trusted.paper.s4_single.derivation import Derivation
from proofs.trusted.paper.s4_single.single_facts import (
    EtaWindows,
    NuWindows,
    Orbit,
    Solution,
    Window,
)
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict

FIGURE_NU, FIGURE_ETAS = Fraction("0.2"), (Fraction("0.01"), Fraction(14))
FIGURE_ETA, FIGURE_NUS = Fraction("0.237"), (Fraction("-0.9"), Fraction("0.9"))

_FINE = Fraction(1, 10**9)
_STIFF = Fraction("2.3")
_STIFFNESS = (
    at("cos(x) - nu", 1, x="1.369", nu="1/5"),
    at("eta*x - pi", 1, eta="23/10", x="1.369"),
)

_SOLVED = (
    "Let |nu| < 1, n >= 1, n eta no integer and theta in (-pi/2, pi/2), tan(theta) = cot(pi n eta)"
    "/eta. If cos(theta) > |nu| no phase solves (16), else phi_1 = theta - asin(cos(theta)/nu) and "
    "phi_2 = theta + pi + asin(cos(theta)/nu) do (mod 2 pi), and no others; they coincide if "
    "cos(theta) = |nu|. If n eta is an integer, all phases do."
)
_TRUE_SLOPE = "cos^2(pi n eta) (1 - nu sin(phi)/(eta^2 (1 + nu sin(phi))))"
_ORBITS = (
    "Let beta > 0, so nu > 0 if p < 0 (for beta < 0 replace nu, phi by -nu, phi + pi). An orbit "
    "that leaves the table at phi, its relative acceleration being > 0, with its first impact, a "
    "transversal one, 2 pi n later, exists exactly if phi solves (16), n eta is no integer, "
    "side (nu (1 - eta^2) sin(phi) - eta^2) > 0, side the sign of nu, and nothing is hit before. "
    "The last is so for nu > 0 if n eta < 1/2, and only then; for nu < 0 if 1/2 < n eta < 1, and "
    "only if {n eta} > 1/2 and 0 < {l eta} < {n eta} for 0 < l < n, {} being fractional parts. "
    "The slope is M = "
    f"{_TRUE_SLOPE}, < 0 for nu > 0 and > 0 for nu < 0; the orbit is stable if |M| < 1, unstable "
    "if |M| > 1, and only phi = theta - asin(cos(theta)/nu) can be stable: with e = (eta tan(pi n "
    "eta))^2, A(p) = (p^2 + e)/(1 - p)^2 and q = eta^2 (1 + 1/cos^2(pi n eta)), if n eta < 1/2, nu "
    "> 0, it is exactly if A(eta^2) < nu^2 and nu^2 (1 - q)^2 < q^2 + e; if 1/2 < n eta < 1, nu < "
    "0, exactly if e/(1 + e) < nu^2 < A(eta^2)."
)


def _undecided(missing: str) -> Decision:
    return undecided(f"not proved: {missing}")


def _missing(found: Sequence[object], lemmas: Sequence[Equal] = eq.LEMMAS) -> Decision | None:
    count = sum(lemma not in found for lemma in lemmas)
    return _undecided(f"{count} of {len(lemmas)} identities") if count else None


def _within(values: Range, places: int = 6) -> str:
    return f"[{floor_text(values[0], places)}, {ceil_text(values[1], places)}]"


def _place(one: Solution) -> str:
    return f"(eta, nu, n) = ({show(one.eta)}, {show(one.nu)}, {one.n})"


def _necessary() -> Decision:
    return Decision(
        Verdict.VERIFIED,
        "(10) with psi_(k+1) - psi_k = 2 pi n is (16), which is (2/eta) sin(pi n eta) K(phi)",
        corrected="The impact equation (10) with psi_(k+1) = psi_k + 2 pi n is (16): it is "
        "necessary for an orbit with an impact every n table periods. With x = pi n eta it is "
        "(2/eta) sin(x) (nu cos(phi) cos(x) - eta (1 + nu sin(phi)) sin(x)) = 0, so all phases "
        "satisfy it if n eta is an integer, and it is not sufficient (claim P4).",
    )


def _explicit() -> Decision:
    return Decision(
        Verdict.CONDITIONAL,
        "(16) is -(nu/eta) sqrt(alpha^2 + beta^2) (sin(phi - theta) + cos(theta)/nu), theta in "
        "(-pi/2, pi/2); it says nothing where n eta is an integer: alpha = beta = 0",
        witness="If n eta is not an integer, alpha > 0, and with theta in (-pi/2, pi/2) (17) is "
        "equivalent to (16). At eta = n = 1, any nu, alpha = beta = 0: theta is not defined, "
        "while every phase satisfies (16).",
        corrected=_SOLVED,
    )


def _slope() -> Decision:
    return Decision(
        Verdict.VERIFIED,
        "(18) is the implicit derivative of (10); where (16) holds its denominator is -2 nu cos("
        f"phi) and it is {_TRUE_SLOPE}",
        corrected="Where the first impact after phi is 2 pi n later and transversal, f'(phi) is "
        "(18). If (16) holds and n eta is no integer, the denominator of (18) is -2 nu cos(phi), "
        f"and where that is not 0, (18) equals {_TRUE_SLOPE}.",
    )


def _stability(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide P4: two solutions with |slope| < 1 that are no orbits, two orbits that are."""
    hits = [x for x in found if isinstance(x, Solution) and x.contracts and x.early is not None]
    hits = [x for x in hits if x.acceleration[0] > 0]
    stuck = [x for x in found if isinstance(x, Solution) and x.contracts and x.acceleration[1] < 0]
    lacking = _missing(found)
    if lacking is not None or not hits or not stuck:
        return lacking or _undecided("a solution with an earlier impact, and one that sticks")
    hit, one = hits[0], stuck[0]
    why = (
        f"at {_place(hit)} the slope is in {_within(hit.multiplier)}, but an impact is earlier; at "
        f"{_place(one)} it is in {_within(one.multiplier)}, but the mass sticks"
    )
    orbits = [x.solution for x in found if isinstance(x, Orbit)]
    examples = "".join(
        f" At {_place(x)} the phase in {_within(x.phase, 20)} is one, with slope in "
        f"{_within(x.multiplier, 12)}."
        for x in orbits
    )
    return Decision(
        Verdict.CONDITIONAL,
        why,
        witness="It decides where the mass leaves the table and the impact after n periods is the "
        f"first. At {_place(hit)} the phase in {_within(hit.phase, 20)} solves (16), the "
        f"slope is in {_within(hit.multiplier)}, the launch acceleration in "
        f"{_within(hit.acceleration)}, but the mass would be inside the table at time "
        f"{show(hit.early or Fraction(0))} < 2 pi n. At {_place(one)}, phase in "
        f"{_within(one.phase, 20)}, the slope is in {_within(one.multiplier)} and the launch "
        f"acceleration in {_within(one.acceleration)} < 0: the mass sticks.",
        corrected=f"{_SOLVED} {_ORBITS}{examples}",
        quantities={"slope_no_orbit": hit.multiplier, "slope_sticking": one.multiplier},
    )


# -- the figures ---------------------------------------------------------------------------------


def _counterexamples(found: Sequence[object]) -> tuple[Solution, Solution] | None:
    """Return solutions for p < 0 that stick and for p > 0 that impact earlier, eta >= 2.3."""
    last = FIGURE_ETAS[1]
    all_of = [x for x in found if isinstance(x, Solution) and x.contracts]
    all_of = [x for x in all_of if _STIFF <= x.eta < last and abs(x.nu) == FIGURE_NU]
    stuck = [x for x in all_of if x.nu > 0 and x.acceleration[1] < 0]
    early = [x for x in all_of if x.nu < 0 < x.acceleration[0] and x.early is not None]
    return (stuck[0], early[0]) if stuck and early else None


def _stiffness(found: Sequence[object]) -> bool:
    values = [x for x in found if isinstance(x, Value)]
    return all(any(wanted.met_by(x) for x in values) for wanted in _STIFFNESS)


def _figure_a(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide P5."""
    windows = [
        x
        for x in found
        if isinstance(x, EtaWindows) and x.nu == FIGURE_NU and x.low == FIGURE_ETAS[0]
    ]
    counter, lacking = _counterexamples(found), _missing(found)
    if lacking is not None or not windows or counter is None or not _stiffness(found):
        return lacking or _undecided("the windows, or solutions that are no orbits")
    ends, (stuck, early) = windows[0].ends, counter
    if not all(later[1][1] < flip[0] for (flip, _), later in pairwise(ends)):
        return _undecided("that the windows are disjoint")
    if any(high - low > _FINE for pair in ends for low, high in pair):
        return _undecided("the ends of the windows to nine places")
    inside = [(max(flip[1], FIGURE_ETAS[0]), stick[0]) for flip, stick in ends]
    listed = ", ".join(
        f"{n}: ({ceil_text(a, 8)}, {floor_text(b, 8)})" for n, (a, b) in enumerate(inside, start=1)
    )
    latest = ends[0][1]
    quantities = {
        f"eta_{name}_{n}": bounds
        for n, pair in enumerate(ends, start=1)
        for name, bounds in zip(("flip", "stick"), pair, strict=True)
    }
    return Decision(
        Verdict.REFUTED,
        f"for p < 0 there are {len(ends)} windows of stable orbits in (0.01, 14), all below "
        f"{ceil_text(latest[1])}; for p > 0 there are none above {show(_STIFF)}",
        witness=f"At {_place(stuck)} the phase in {_within(stuck.phase, 20)} solves (16) with a "
        f"slope in {_within(stuck.multiplier)}, but the launch acceleration is in "
        f"{_within(stuck.acceleration)} < 0: the mass sticks, and at no phase it separates. For p "
        f"> 0 and beta < 0, that is {_place(early)} and the phase shifted by pi, the slope is in "
        f"{_within(early.multiplier)}, but the mass would be inside the table at time "
        f"{show(early.early or Fraction(0))} < 2 pi n.",
        corrected=f"Plastic impacts, |nu| = {show(FIGURE_NU)}. {_ORBITS} So for p < 0 and eta in "
        "(0.01, 14), such an orbit with |M| < 1 exists exactly if eta is "
        f"in one of {len(ends)} disjoint open intervals, one for each n = 1, ..., {len(ends)}. "
        "They lie in (0, 1/(2 n)) between the root of A(q) = nu^2 with q < 1, where the slope is "
        "-1 (flip), and that of A(eta^2) = nu^2, where it is 0 (sticking), but for eta > 0.01. "
        "They contain these, with ends off by less "
        f"than 2e-8: {listed}. For eta > sqrt(|nu|/(1 + |nu|)) the mass never leaves the table. "
        "For p > 0 no such orbit is stable if eta >= pi/acos |nu|, which is below "
        f"{show(_STIFF)}.",
        quantities=quantities,
    )


def _listed(windows: Sequence[Window]) -> str:
    if not windows:
        return "none"
    return ", ".join(
        f"n = {n} from {_within(first, 15)} to {_within(last, 15)}" for n, first, last in windows
    )


def _figure_b(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide P6."""
    windows = [x for x in found if isinstance(x, NuWindows) and x.eta == FIGURE_ETA]
    no_orbits = [
        x
        for x in found
        if isinstance(x, Solution)
        and x.contracts
        and x.eta == FIGURE_ETA
        and FIGURE_NUS[0] < x.nu < FIGURE_NUS[1]
        and x.acceleration[0] > 0
        and x.early is not None
    ]
    lacking = _missing(found)
    if lacking is not None or not windows or not no_orbits:
        return lacking or _undecided("the windows, or a solution that is no orbit")
    step, one = windows[0], no_orbits[0]
    sides = (("below", step.below, ("saddle", "stick")), ("above", step.above, ("stick", "flip")))
    if any(last[1] >= FIGURE_NUS[1] for _, side, _ in sides for _, _, last in side):
        return _undecided("that the windows end before |nu| = 0.9")
    quantities = {
        f"nu_{name}_{n}": bounds
        for _, side, names in sides
        for n, *both in side
        for name, bounds in zip(names, both, strict=True)
    }
    return Decision(
        Verdict.CONDITIONAL,
        f"stable orbits: for p > 0 |nu| {_brief(step.below)}; for p < 0 |nu| {_brief(step.above)}; "
        f"at {_place(one)} a solution with |slope| < 1 is none",
        witness="A stable n-periodic orbit exists exactly for p > 0 with |nu| in the intervals "
        f"{_listed(step.below)}; for p < 0 with |nu| in {_listed(step.above)}. At {_place(one)} "
        f"the phase in {_within(one.phase, 20)} solves (16), with slope in "
        f"{_within(one.multiplier)} and launch acceleration in {_within(one.acceleration)}, but "
        f"the mass would be inside the table at time {show(one.early or Fraction(0))} < 2 pi n.",
        corrected=f"Plastic impacts, eta = {show(FIGURE_ETA)}, 0 < |nu| < 1. {_ORBITS} Such an "
        "orbit with |M| < 1 exists exactly, for p > 0, with |nu| in the open intervals "
        f"{_listed(step.below)}, from a saddle-node (slope 1) to sticking (slope 0); for p < 0: "
        f"{_listed(step.above)}, from sticking (slope 0) to a flip (slope -1): where nu^2 is "
        "e/(1 + e), A(eta^2), A(q). For p > 0 n = "
        f"{', '.join(map(str, step.early))} pass the condition on fractional parts, but all their "
        "solutions with |slope| < 1 have an earlier impact.",
        quantities=quantities,
    )


def _brief(windows: Sequence[Window]) -> str:
    each = (
        f"in ({ceil_text(first[1])}, {floor_text(last[0])}) (n = {n})" for n, first, last in windows
    )
    return " or ".join(each) or "nowhere"


FORMULAS = (
    Derivation(
        "P1",
        "The fixed points with n table periods between impacts satisfy (16), which is (10) with "
        "psi_(k+1) - psi_k = 2 pi n.",
        eq.NECESSARY,
        _necessary,
    ),
    Derivation(
        "P2",
        "(16) can be rewritten as (17), sin(phi - theta) + cos(theta)/nu = 0, with theta = "
        "atan(beta/alpha), alpha = eta (1 - cos(2 pi n eta)), beta = sin(2 pi n eta).",
        (*eq.NECESSARY, *eq.ANGLE),
        _explicit,
    ),
    Derivation("P3", "At these fixed points the slope of f is (18).", eq.SLOPE, _slope),
)
LEMMAS, VALUES = eq.LEMMAS, _STIFFNESS
CLAIMS = (
    *(formula.claim for formula in FORMULAS),
    Claim(
        "P4",
        "A fixed point given by (17), with a launch that does not stick, is stable if |slope| < 1.",
        _stability,
    ),
    Claim(
        "P5",
        "Figure 7a: for nu = 0.2 the solutions of (16) with |slope| < 1 are stable n-periodic "
        "fixed points over eta in (0.01, 14).",
        _figure_a,
    ),
    Claim(
        "P6",
        "Figure 7b: for eta = 0.237 the solutions of (16) with |slope| < 1 are stable n-periodic "
        "fixed points over nu in (-0.9, 0.9).",
        _figure_b,
    ),
)

"""The plastic map on the whole circle (sections 2 and 3.4): sticking, and the orbit that attracts.

Impacts can be counted in two ways after sticking. In section 2 f takes a sticking phase to the
next impact phase; in section 3.4, where (4.64, 6.05) has period 2, to the separation phase.
Trusted, and shared by prover and checker.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from proofs.trusted.numbers import TURN, Range, ceil_text, floor_text, show, show_range
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.s34_circle.landing import (
    Absorption,
    NeverImpacts,
    Separation,
    fixed_point,
    repelling,
)
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict

CONSTANT = (Fraction("3.38"), Fraction("6.04"))  # where f' = 0, as printed
ORBIT = (Fraction("4.64"), Fraction("6.05"))  # the orbit of period 2, as printed
LONG = (Fraction("1.1"), Fraction("1.5"))  # where transients are long, as printed
_TURN_MORE = TURN + Fraction(1, 10**9)  # a little more than 2 pi
_LENGTH_NAMED = Fraction(1, 20)
_HALF = Fraction(1, 200)  # half a unit of the last place printed


# -- what the conclusions decide -----------------------------------------------------------------


_NO_ARC = "no proof where the mass sticks, and where it lands then"


def _separation(found: Sequence[object]) -> Separation | None:
    return next((step for step in found if isinstance(step, Separation)), None)


def _absorption(found: Sequence[object]) -> Absorption | None:
    return next((step for step in found if isinstance(step, Absorption)), None)


def _never(found: Sequence[object]) -> NeverImpacts | None:
    """Return the longest interval of phases that never impact."""
    steps = [step for step in found if isinstance(step, NeverImpacts)]
    return max(steps, key=lambda step: step.phases[1] - step.phases[0], default=None)


def _between(values: Range, places: int) -> str:
    return f"[{floor_text(values[0], places)}, {ceil_text(values[1], places)}]"


def _arc(of: Parameters, step: Separation) -> str:
    return (
        f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) the mass sticks after a plastic impact "
        f"exactly at the phases of the arc (3 pi - phi_s, phi_s), 3 pi - phi_s in "
        f"{_between(step.start, 20)}, phi_s in {_between(step.phase, 20)}"
    )


def _constant(of: Parameters, found: Sequence[object]) -> Decision:
    step = _separation(found)
    if step is None:
        return undecided(_NO_ARC)
    low, high = CONSTANT
    ends = {"arc_start": step.start, "separation_phase": step.phase}
    if not (step.start[1] <= low and high <= step.phase[0]):
        return Decision(
            Verdict.UNDECIDED,
            f"the sticking arc is ({ceil_text(step.start[1])}, {floor_text(step.phase[0])})",
            quantities=ends,
        )
    return Decision(
        Verdict.VERIFIED,
        f"f is constant on the sticking arc, which reaches from {ceil_text(step.start[1])} or "
        f"less to {floor_text(step.phase[0])} or more",
        corrected=f"{_arc(of, step)}; f is constant there, whether it maps to the separation phase "
        "or on to the next impact.",
        quantities=ends,
    )


def _periodic(of: Parameters, found: Sequence[object]) -> Decision:
    step = _separation(found)
    if step is None:
        return undecided(_NO_ARC)
    quantities = {"impact_phase": step.arrival, "separation_phase": step.phase}
    printed = zip(ORBIT, (step.arrival, step.phase), strict=True)
    rounded = all(x - _HALF < low and high < x + _HALF for x, (low, high) in printed)
    if not (step.returns and rounded):
        return Decision(
            Verdict.UNDECIDED,
            f"the flight from phi_s ends in {_between(step.arrival, 6)}",
            quantities=quantities,
        )
    impact, leave = _between(step.arrival, 20), _between(step.phase, 20)
    return Decision(
        Verdict.CONDITIONAL,
        f"impact at {_between(step.arrival, 6)}, separation at {_between(step.phase, 6)}: period "
        "2 if separation counts as a step of f, else the impact phase is a fixed point",
        witness=f"Let phi_1 in {impact} be the phase of the impact, phi_s in {leave} that of the "
        "separation. If f maps a sticking phase to phi_s, then f(phi_1) = phi_s and f(phi_s) = "
        "phi_1: period 2. If f maps it to the next impact phase, as section 2 defines f, then "
        f"f(phi_1) = phi_1 is a fixed point, f(phi_s) = phi_1 too, and phi_s is on no periodic "
        "orbit. 4.64 and 6.05 are the two phases rounded to two places.",
        corrected=f"{_arc(of, step)}; the flight from phi_s ends at the phase phi_1 in {impact}, "
        "mod 2 pi, inside that arc, so that the motion is periodic, with one impact and one "
        "separation a period. With sticking phases mapped to phi_s, (phi_1, phi_s) is an orbit of "
        "period 2; with sticking phases mapped to the next impact, phi_1 is a fixed point.",
        quantities=quantities,
    )


def _right_of(step: Separation, known: Absorption) -> Fraction | None:
    """Return c such that all phases from phi_s to c + 2 pi stick at the next impact."""
    for (low, high), steps in known.within:
        if steps == 1 and low + _TURN_MORE <= step.phase[0] and high >= 0:
            return high
    return None


def _stable(of: Parameters, found: Sequence[object]) -> Decision:
    step, known = _separation(found), _absorption(found)
    if step is None or known is None or not step.returns:
        return undecided(_NO_ARC)
    beyond = _right_of(step, known)
    if beyond is None:
        return undecided("no neighbourhood of the separation phase is proved to stick next")
    whole = f"Every phase from {ceil_text(step.start[1])} to 2 pi + {floor_text(beyond)}"
    return Decision(
        Verdict.VERIFIED,
        f"superstable: {whole[0].lower()}{whole[1:]} sticks at this or at the next impact",
        corrected=f"{_arc(of, step)}. {whole} sticks at this impact or at the next one, and so "
        "joins the periodic motion exactly, in finite time: a neighbourhood of the whole "
        "orbit, both where separation counts as a step of f and where it does not. The phases "
        "below phi_s join it a step ahead of those above.",
    )


def _attracts(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide G4: an interval of phases that never impact again refutes "almost every"."""
    step, known, never = _separation(found), _absorption(found), _never(found)
    if step is None or known is None or not step.returns:
        return undecided("no proof which phases reach the sticking arc")
    least = 1 - known.rest[-1] / TURN
    lost = Fraction(0) if never is None else never.phases[1] - never.phases[0]
    quantities = {"basin_fraction": (least, 1 - lost / _TURN_MORE)}
    share = f"at least {floor_text(100 * least, 3)} percent of the circle"
    most = f"at most {ceil_text(100 * quantities['basin_fraction'][1], 5)} percent"
    table = ", ".join(
        f"{n}: {floor_text(100 * (1 - rest / TURN), 2)}"
        for n, rest in enumerate(known.rest)
        if n in (0, 1, 2, 3, 4, 6, 8, 10, 15, 20, 30, 40, 60)
    )
    if never is None:
        return Decision(
            Verdict.UNDECIDED,
            f"{share} is attracted, of the rest nothing is known",
            quantities=quantities,
        )
    return Decision(
        Verdict.REFUTED,
        f"{share}, but no phase of {show_range(never.phases)}",
        witness=f"no phase of {show_range(never.phases)}, an interval of length {show(lost)}, is "
        f"attracted. {_flies(of)}",
        corrected=f"{_arc(of, step)}. The periodic motion that sticks there attracts {share}: so "
        f"many phases reach the arc within {len(known.rest) - 1} impacts; percentages by number of "
        f"impacts, at least: {table}. {_intervals(known)}It does not attract the phases of "
        f"{show_range(never.phases)}, so {most} of the circle. {_flies(of)}{_nor_fixed(found)}",
        quantities=quantities,
    )


def _joined(known: Absorption) -> list[tuple[Range, int]]:
    """Join adjoining intervals of phases that reach the arc; with the larger number of impacts."""
    joined: list[tuple[Range, int]] = []
    for (low, high), steps in sorted(known.within):
        if joined and joined[-1][0][1] == low:
            (first, _), before = joined.pop()
            joined.append(((first, high), max(steps, before)))
        else:
            joined.append(((low, high), steps))
    return joined


def _intervals(known: Absorption) -> str:
    """Name the longest intervals of phases that reach the arc, rounded inward."""
    return "".join(
        f"Every phase of [{ceil_text(low)}, {floor_text(high)}] mod 2 pi reaches the arc within "
        f"{steps} impact{'s' if steps > 1 else ''}. "
        for (low, high), steps in _joined(known)
        if high - low > _LENGTH_NAMED
    )


def _nor_fixed(found: Sequence[object]) -> str:
    """Name a fixed point elsewhere, which is not attracted either."""
    fixed = repelling(found, LONG)
    if not fixed:
        return ""
    return f" Nor does it attract the repelling fixed point in {_between(fixed_point(fixed), 20)}."


def _flies(of: Parameters) -> str:
    """Say what the flights of `NeverImpacts` do."""
    turns = of.eta.denominator
    return (
        f"After a launch there the mass stays off the table for {turns} turns of it and then "
        "touches it at the phase of the launch with relative velocity 0, and so on forever: the "
        f"motion has the period {2 * turns} pi, and there is no impact, or f(phi) = phi if a touch "
        "counts as one."
    )


def _transient(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide G6 by a fixed point in [1.1, 1.5] and what surrounds it."""
    step, known = _separation(found), _absorption(found)
    if step is None or known is None:
        return undecided("no proof which phases reach the sticking arc")
    fixed = repelling(found, LONG)
    if not fixed:
        return undecided("no repelling fixed point in [1.1, 1.5]")
    (low, high), image = (fixed[0].points[0], fixed[0].points[-1]), fixed[0].images[0][0]
    least = min(bottom for bottom, _ in fixed[0].pieces)
    if not any(a <= image and low <= b for (a, b), _ in _joined(known)):
        return undecided("the phases beside the fixed point are not proved to reach the arc")
    point = fixed_point(fixed)
    never = _never(found)
    outside = never is not None and not LONG[0] <= never.phases[0] <= LONG[1]
    return Decision(
        Verdict.VERIFIED,
        f"unbounded at the repelling fixed point in {_between(point, 9)}"
        + (f"; infinite on {show_range(never.phases)}" if never is not None and outside else ""),
        corrected=f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) f is continuously "
        f"differentiable on {show_range((low, high))} with f' >= {floor_text(least)}, and has a "
        f"fixed point p in {_between(point, 20)}. For every n, all phases near enough to p need "
        f"more than n impacts to reach the sticking arc; those from {show(low)} up to p do reach "
        f"it. {_intervals(known)}"
        + (
            f"Transients are not long in [1.1, 1.5] only: no phase of {show_range(never.phases)} "
            "ever reaches the arc."
            if never is not None and outside
            else "Nothing is said about the phases between."
        ),
        quantities={"fixed_point": point},
    )


def _determined(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide M6: does every phase have a next impact?"""
    step, never = _separation(found), _never(found)
    if step is None or never is None:
        return undecided("no phase is proved to have no next impact, and none to have one")
    where, turns = show_range(never.phases), of.eta.denominator
    first = (
        f"For every phase the gap returns to 0 by the time {2 * turns} pi, at which mass and table "
        "are where they were, since eta is rational; so its first zero after the launch (after "
        "phi_s, where the mass sticks) is determined"
    )
    return Decision(
        Verdict.CONDITIONAL,
        "true if a touch without relative velocity counts as an impact; else the phases of "
        f"{where} have no next impact",
        witness=f"{first}: f is defined on the whole circle if a touch counts as an impact. If it "
        "does not, as in the algorithm of the appendix, which looks for a change of sign, then f "
        f"is not defined on {where}. {_flies(of)}",
        corrected=f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}): {first[0].lower()}{first[1:]}, "
        f"and with touches counted f maps [0, 2 pi) into itself. On {where} f is then the "
        f"identity, and without touches it is not defined. {_flies(of)}",
    )


_AT = "At (eta, nu) = ({eta}, {nu}): "

CLAIMS = (
    Claim(
        "M6",
        _AT + "for every impact phase the next impact phase is uniquely determined, so that f maps "
        "[0, 2 pi) into itself.",
        _determined,
    ),
    Claim("G1", _AT + "f' = 0 on (3.38, 6.04).", _constant),
    Claim(
        "G2",
        _AT + "(4.64, 6.05), to the places printed, is an orbit of period 2 of f.",
        _periodic,
    ),
    Claim(
        "G3", _AT + "the periodic orbit that sticks, (4.64, 6.05) as printed, is stable.", _stable
    ),
    Claim(
        "G4",
        _AT + "the periodic orbit that sticks, (4.64, 6.05) as printed, attracts almost every "
        "phase.",
        _attracts,
    ),
    Claim(
        "G6",
        _AT + "the number of impacts before the periodic orbit that sticks is reached is high, "
        "without bound, near the invariant sets, in [1.1, 1.5].",
        _transient,
    ),
)

"""What the claims of the paper are, and when numbers decide them. Trusted, and shared.

The prover and the checker each find `Facts` by an arithmetic of their own; `decide` turns facts
into a verdict, for both. Nothing else in the project says what claim H5 means.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from proofs.trusted.facts import (
    TURN,
    Facts,
    Parameters,
    PointFact,
    Range,
    ceil_text,
    floor_text,
    parameters_text,
    show,
    show_range,
)


class Verdict(Enum):
    """The outcome of a claim.

    Proved as printed; proved false; proved under conditions that the paper leaves out; neither;
    or no mathematics but an observation, reproduced by simulation.
    """

    VERIFIED = "VERIFIED"
    REFUTED = "REFUTED"
    CONDITIONAL = "CONDITIONAL"
    UNDECIDED = "UNDECIDED"
    SIMULATED = "SIMULATED"


Outcome = tuple[Verdict, str]


def _undecided(missing: str) -> Outcome:
    return Verdict.UNDECIDED, missing


_NO_SLOPES = "no proof that f is differentiable on I0 and I1 with bounded slope"


def _inside(point: PointFact, of: Parameters) -> bool:
    """Whether a witness lies in the interior of I0 or of I1."""
    return any(low < point.phase < high for low, high in (of.left, of.right))


def _lower_slope(of: Parameters, facts: Facts) -> Outcome:
    bound = of.slopes[0]
    for point in facts.points:
        if _inside(point, of) and point.slope[1] < bound:
            return Verdict.REFUTED, f"f'({show(point.phase)}) <= {ceil_text(point.slope[1])}"
    if not facts.slopes_known:
        return _undecided(_NO_SLOPES)
    least = min(low for low, _ in facts.slope_min.values())
    if least >= bound:
        return (
            Verdict.VERIFIED,
            f"min f' >= {floor_text(least)}, margin {floor_text(least - bound)}",
        )
    return _undecided(f"min f' >= {floor_text(least)} only, {ceil_text(bound - least)} short")


def _upper_slope(of: Parameters, facts: Facts) -> Outcome:
    bound = of.slopes[1]
    for point in facts.points:
        if _inside(point, of) and point.slope[0] > bound:
            return Verdict.REFUTED, f"f'({show(point.phase)}) >= {floor_text(point.slope[0])}"
    if not facts.slopes_known:
        return _undecided(_NO_SLOPES)
    greatest = max(high for _, high in facts.slope_max.values())
    if greatest <= bound:
        return (
            Verdict.VERIFIED,
            f"max f' <= {ceil_text(greatest)}, margin {floor_text(bound - greatest)}",
        )
    return _undecided(f"max f' <= {ceil_text(greatest)} only, {ceil_text(greatest - bound)} over")


def _increasing(of: Parameters, facts: Facts) -> Outcome:
    for point in facts.points:
        if _inside(point, of) and point.slope[1] < 0:
            return Verdict.REFUTED, f"f'({show(point.phase)}) <= {ceil_text(point.slope[1])}"
    if not facts.slopes_known:
        return _undecided(_NO_SLOPES)
    least = min(low for low, _ in facts.slope_min.values())
    if least > 0:
        return Verdict.VERIFIED, f"f' >= {floor_text(least)} > 0"
    return _undecided(f"f' >= {floor_text(least)} only")


def _gap_escapes(of: Parameters, facts: Facts) -> Outcome:
    low, high = of.interval
    for point in facts.points:
        inside = of.gap[0] < point.phase < of.gap[1]
        if inside and low <= point.image[0] and point.image[1] <= high:
            return Verdict.REFUTED, f"f({show(point.phase)}) is in I"
    if facts.avoided:
        return Verdict.VERIFIED, "no phase of the gap has its first impact in I"
    return _undecided("no proof that the first impacts of the gap avoid I, and no witness")


def _short(index: int, of: Parameters, facts: Facts) -> bool:
    """Whether f(I_i) is proved shorter than the circle, by the bounds on f'."""
    low, high = (of.left, of.right)[index]
    steepest = max(-facts.slope_min[index][0], facts.slope_max[index][1])
    return steepest * (high - low) < TURN


def image_arcs(of: Parameters, facts: Facts) -> list[tuple[Range, Range] | None]:
    """Return for I0 and I1 the ends (lower, upper) of the arc f(I_i), None where not proved.

    Where f' has one sign on I_i and f(I_i) is shorter than the circle, f(I_i) is the arc
    between the images of the ends, in the order of that sign. The enclosures of these must lie
    in [0, 2 pi): only there does their order tell whether the arc passes phase 0.
    """
    arcs: list[tuple[Range, Range] | None] = []
    for index in (0, 1):
        arcs.append(None)
        if index not in facts.images or not _short(index, of, facts):
            continue
        ends = facts.images[index]
        if max(top for _, top in ends) >= TURN:
            continue
        if facts.slope_min[index][0] > 0:
            arcs[-1] = ends
        elif facts.slope_max[index][1] < 0:
            arcs[-1] = ends[1], ends[0]
    return arcs


def _disjoint(arc: tuple[Range, Range], interval: Range) -> bool:
    """Whether an arc of `image_arcs` misses an interval of [0, 2 pi).

    From phase u up to phase v, where u < v, such an arc is [u, v].
    """
    (bottom, lowest), (highest, top) = arc
    return lowest < highest and (interval[1] < bottom or top < interval[0])


def _two_preimages(of: Parameters, facts: Facts) -> Outcome:
    arcs = image_arcs(of, facts)
    witness = facts.missed
    if witness is not None and witness[0] < witness[1]:
        inside = any(low <= witness[0] and witness[1] <= high for low, high in (of.left, of.right))
        for name, arc in zip(("I0", "I1"), arcs, strict=True):
            if inside and arc is not None and _disjoint(arc, witness):
                return Verdict.REFUTED, f"{show_range(witness)} has no preimage in {name}"
    low, high = of.interval
    margins = []
    for arc in arcs:
        if arc is None:
            return _undecided("no proof that f is monotone on I0 and on I1")
        margins.append(min(low - arc[0][1], arc[1][0] - high))
    if min(margins) < 0:
        return _undecided(f"an image falls short of I by up to {ceil_text(-min(margins))}")
    if of.interval != (of.left[0], of.right[1]):
        return _undecided("I reaches beyond I0 and I1: nothing is proved about the rest")
    if not facts.avoided:
        return _undecided("f(I0) and f(I1) cover I; the gap is not proved to escape")
    return Verdict.VERIFIED, f"f(I0) and f(I1) cover I, margin {floor_text(min(margins))}"


def _short_preimages(of: Parameters, facts: Facts) -> Outcome:
    bound = of.slopes[0]
    for point in facts.points:
        lands = any(
            low < point.image[0] and point.image[1] < high for low, high in (of.left, of.right)
        )
        if _inside(point, of) and lands and point.slope[0] > 0 and point.slope[1] < bound:
            return Verdict.REFUTED, f"f'({show(point.phase)}) <= {ceil_text(point.slope[1])}"
    if not facts.slopes_known:
        return _undecided(_NO_SLOPES)
    least = min(low for low, _ in facts.slope_min.values())
    if least > bound and not all(_short(index, of, facts) for index in (0, 1)):
        return _undecided("an image may be longer than the circle, a preimage in several pieces")
    if least > bound:
        return Verdict.VERIFIED, f"each is at most |J| / {floor_text(least)} long"
    return _undecided(f"f' >= {floor_text(least)} only")


def _last_place(printed: str) -> Fraction:
    """Return the unit of the last place of a decimal; 0 for a fraction, which is exact."""
    return Fraction("/" not in printed, 10 ** len(printed.partition(".")[2]))


def _rounds_to(value: Fraction, printed: str) -> bool:
    return 2 * abs(value - Fraction(printed)) < _last_place(printed)


def readings(root: Range, printed: str) -> tuple[bool | None, bool | None]:
    """Return whether the printed digits are the root's, (rounded, truncated); None: undecided.

    Rounded they stand for the numbers within half a unit of the last place, truncated for those
    from the printed one on, up to a unit more: decided where the bracket is inside or outside.
    """
    (low, high), value, unit = root, Fraction(printed), _last_place(printed)
    nearest: bool | None = (value - unit / 2 < low and high < value + unit / 2) or None
    if high <= value - unit / 2 or low >= value + unit / 2:
        nearest = False
    first: bool | None = (value <= low and high < value + unit) or None
    if high < value or low >= value + unit:
        first = False
    return nearest, first


def _moran_root(of: Parameters, facts: Facts) -> Outcome:
    if max(of.moran_ratios) >= 1:
        return Verdict.REFUTED, "a ratio is at least 1, so the sum exceeds 1 for every s > 0"
    for ratio, given in zip(of.reciprocals, of.moran_ratios, strict=True):
        if ratio != given and not _rounds_to(ratio, show(given)):
            return Verdict.REFUTED, f"1 / slope does not round to {show(given)}"
    if facts.s0 is None or facts.s0_reciprocal is None:
        return _undecided("no bracket of s_0")
    bounds = f"{floor_text(facts.s0[0])} <= s_0 <= {ceil_text(facts.s0[1])}"
    if of.printed_s0 is None:
        return Verdict.VERIFIED, bounds
    return _digits_read(of.printed_s0, facts.s0, facts.s0_reciprocal, bounds)


def _digits_read(printed: str, root: Range, other: Range, bounds: str) -> Outcome:
    """Decide whether printed digits are those of s_0, for given and for exact ratios."""
    both = [readings(root, printed), readings(other, printed)]
    if all(rounded for rounded, _ in both):
        cut = "also" if all(truncated for _, truncated in both) else "not"
        return Verdict.VERIFIED, f"{bounds}: {printed} if rounded, {cut} if truncated"
    if all(reading == (False, False) for reading in both):
        return Verdict.REFUTED, f"{bounds}: not {printed} in any reading"
    return _undecided(f"{bounds}: the readings of {printed} differ between the ratios")


def _gap_function(of: Parameters, facts: Facts) -> Outcome:
    del facts  # exact arithmetic on the ratios decides
    if max(of.moran_ratios) >= 1:
        return Verdict.REFUTED, "there is no s_0 > 0"
    total = of.moran_ratios[0] + of.moran_ratios[1]
    if total >= 1:
        return Verdict.REFUTED, "eta0 + eta1 >= 1, so s_0 >= 1 and q does not decrease"
    return Verdict.VERIFIED, f"0 < s_0 < 1, because eta0 + eta1 = {show(total)} < 1"


def _base(ratio: Fraction) -> str:
    """Write a number that is raised to a power."""
    written = show(ratio)
    return f"({written})" if "/" in written else written


def fill(text: str, of: Parameters) -> str:
    """Put the numbers of `of` into the text of a statement."""
    return text.format(
        eta=show(of.eta),
        nu=show(of.nu),
        i=show_range(of.interval),
        i0=show_range(of.left),
        i1=show_range(of.right),
        gap=f"({show(of.gap[0])}, {show(of.gap[1])})",
        lo=show(of.slopes[0]),
        hi=show(of.slopes[1]),
        r0=_base(of.moran_ratios[0]),
        r1=_base(of.moran_ratios[1]),
        s0=f", s_0 = {of.printed_s0} to the places printed" if of.printed_s0 else "",
        epsilon="no epsilon" if of.epsilon is None else show(of.epsilon),
        gamma="no velocities" if of.velocities is None else show_range(of.velocities),
        box="no epsilon" if of.box is None else parameters_text(of.box),
    )


@dataclass(frozen=True)
class Statement:
    """A claim: its id in the catalogue, its text, the rule that decides it from facts."""

    id: str
    text: str
    decide: Callable[[Parameters, Facts], Outcome]

    def says(self, of: Parameters) -> str:
        """Return the claim in words at the given numbers."""
        return fill(self.text, of)


_AT = "At (eta, nu) = ({eta}, {nu}): "

STATEMENTS = {
    statement.id: statement
    for statement in (
        Statement(
            "H1", _AT + "f' >= {lo} on the interiors of I0 = {i0} and I1 = {i1}.", _lower_slope
        ),
        Statement(
            "H2", _AT + "f' <= {hi} on the interiors of I0 = {i0} and I1 = {i1}.", _upper_slope
        ),
        Statement(
            "H3",
            _AT + "f, lifted to a continuous function, increases on I0 = {i0} and on I1 = {i1}.",
            _increasing,
        ),
        Statement("H4", _AT + "f(phi) is outside I = {i} for every phi in {gap}.", _gap_escapes),
        Statement(
            "H5",
            _AT + "the points of I = {i} that f maps into a closed interval J of positive length "
            "in I0 = {i0} or I1 = {i1} form two closed intervals, one in I0 and one in I1.",
            _two_preimages,
        ),
        Statement(
            "H6",
            _AT + "for each closed interval J of positive length in I0 = {i0} or I1 = {i1}, the "
            "preimages of J in I0 and in I1 are shorter than |J| / {lo}.",
            _short_preimages,
        ),
        Statement(
            "H11",
            "{r0}^s + {r1}^s = 1 has exactly one root s_0 > 0{s0}; the ratios are 1/{hi} and "
            "1/{lo}, to the places given.",
            _moran_root,
        ),
        Statement(
            "H16",
            "With eta0 = {r0}, eta1 = {r1} and eta0^s_0 + eta1^s_0 = 1, the function q(x) = "
            "((1 - eta1)/eta0 + x)^s_0 - 1 - x^s_0 decreases on x > 0 and q(eta1/eta0) = 0.",
            _gap_function,
        ),
    )
}

HORSESHOE = ("H1", "H2", "H3", "H4", "H5", "H6")


def decide(claim: str, of: Parameters, facts: Facts) -> Outcome:
    """Return the verdict that the facts prove for a claim, and why."""
    return STATEMENTS[claim].decide(of, facts)


def quantities(claim: str, facts: Facts) -> dict[str, Range]:
    """Return the enclosures that a claim reports, by the names of the machine form."""
    result: dict[str, Range] = {}
    for index, name in enumerate(("I0", "I1")):
        if claim in ("H1", "H3", "H6") and index in facts.slope_min:
            result[f"slope_min_{name}"] = facts.slope_min[index]
        if claim == "H2" and index in facts.slope_max:
            result[f"slope_max_{name}"] = facts.slope_max[index]
        if claim == "H5" and index in facts.images:
            result[f"image_left_{name}"], result[f"image_right_{name}"] = facts.images[index]
    if claim == "H11" and facts.s0 is not None and facts.s0_reciprocal is not None:
        result["s0"], result["s0_reciprocal_slopes"] = facts.s0, facts.s0_reciprocal
    return result


def theorem(of: Parameters) -> str:
    """State what follows where H1-H6 hold; the proof is the paper's own for Theorem 2.

    f is C^1 and increasing on I0 and I1, f' >= lo > 1, each image contains I, and the rest of I
    leaves it. So the points of I with itinerary w_1 ... w_n form a closed interval, that f maps
    onto the one of w_2 ... w_n, which is at least lo times longer; nested intervals shrink to
    one point for every infinite word, and itineraries conjugate f to the shift.
    """
    low, high = of.slopes
    return (
        f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) let I = {show_range(of.interval)}, "
        f"I0 = {show_range(of.left)}, I1 = {show_range(of.right)}. The impact map f is "
        f"continuously differentiable and increasing on I0 and on I1, with {show(low)} <= f' <= "
        f"{show(high)}; f(I0) and f(I1) both contain I, and f maps every phase of "
        f"({show(of.gap[0])}, {show(of.gap[1])}) outside I. Hence, for every n, each of the 2^n "
        "words w_1 ... w_n over {0, 1} has its own closed interval of phases phi with "
        "f^(k-1)(phi) in I_(w_k) for k = 1, ..., n, disjoint from those of the other words and at "
        f"most |I| / {show(low)}^(n-1) long; the set of phases whose orbit stays in I is a Cantor "
        "set, and on it f is topologically conjugate to the full one-sided shift on two symbols: "
        "2^n points are fixed by f^n, there are periodic orbits of every period, uncountably many "
        "nonperiodic ones, and a dense one."
    )

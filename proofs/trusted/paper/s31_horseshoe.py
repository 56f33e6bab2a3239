"""Section 3.1: is the plastic impact map a horseshoe on I0 and I1? Claims H1 to H6."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Phases, Range, ceil_text, show, show_range, within
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.slopes import Avoids, ImageArc, Impact, SlopeRange, image_arc, signed
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_MONOTONE = {1: "increasing", -1: "decreasing"}


@dataclass(frozen=True)
class Horseshoe(Conclusion):
    """f is a horseshoe on I0 = left and I1 = right, with `slopes` that bound |f'|, all above 1.

    signs: those of f' on I0 and on I1.
    """

    at: Place
    left: Phases
    right: Phases
    slopes: Range
    signs: tuple[int, int] = (1, 1)

    def __post_init__(self) -> None:
        """Raise Unproved unless I0 lies before I1, and f expands."""
        if self.left[1] >= self.right[0]:
            raise Unproved("I0 does not lie before I1")
        if not 1 < self.slopes[0] <= self.slopes[1]:
            raise Unproved("the slopes do not expand")
        if not set(self.signs) <= {1, -1}:
            raise Unproved("f is not monotone")

    @property
    def interval(self) -> Phases:
        """I, from the left end of I0 to the right end of I1."""
        return Phases(self.left[0], self.right[1])

    @property
    def gap(self) -> Range:
        """The phases between I0 and I1 (open)."""
        return self.left[1], self.right[0]

    @property
    def sets(self) -> str:
        """I0 and I1, in words."""
        return f"I0 = {show_range(self.left)}, I1 = {show_range(self.right)}"

    @property
    def size(self) -> str:
        """What `slopes` bound."""
        return "f'" if self.signs == (1, 1) else "|f'|"

    @property
    def is_null(self) -> bool:
        """Whether the set has measure zero: 2^n intervals of |I| / g^(n-1) cover it, g > 2."""
        return self.slopes[0] > 2

    @property
    def sentence(self) -> str:
        low, high = map(show, self.slopes)
        null = " of Lebesgue measure zero" if self.is_null else ""
        first, second = (_MONOTONE[sign] for sign in self.signs)
        return (
            f"let I = {show_range(self.interval)}, {self.sets}. The impact map f is continuously "
            f"differentiable and {first} on I0 and {f'{second} ' * (first != second)}on I1, "
            f"with {low} <= {self.size} <= {high}; f(I0) and "
            f"f(I1) both contain I, and f maps every phase of ({show(self.gap[0])}, "
            f"{show(self.gap[1])}) outside I. Hence, for every n, each of the 2^n words w_1 ... w_n"
            " over {0, 1} has its own closed interval of phases phi with f^(k-1)(phi) in I_(w_k) "
            "for k = 1, ..., n, disjoint from those of the other words and at most "
            f"|I| / {low}^(n-1) long; the set of phases whose orbit stays in I is a Cantor set"
            f"{null}; on it f is topologically conjugate to the full one-sided shift on two "
            "symbols: 2^n points are fixed by f^n, there are periodic orbits of every period, "
            "uncountably many nonperiodic ones, and a dense one."
        )

    @property
    def brief(self) -> str:
        return f"a horseshoe on {self.sets}, {self.size} >= {show(self.slopes[0])}"

    @property
    def latex(self) -> str:
        low, high = map(show, self.slopes)
        bounds = rf"{low} \le {self.size} \le {high} \text{{ on }} I_0 \cup I_1"
        return rf"f(I_0) \supseteq I,\quad f(I_1) \supseteq I,\quad {bounds}"


def horseshoe(left: SlopeRange, right: SlopeRange, gap: Avoids, slopes: Range) -> Horseshoe:
    """Theorem. Let |f'| lie in `slopes`, from above 1, on I0 and on I1, I0 before I1, let f(I0) and
    f(I1) contain I, from the left end of I0 to the right end of I1, and let f map the closed gap
    between them outside I. Then what `Horseshoe.sentence` says.

    Proof, the paper's own for Theorem 2. f is C^1 and monotone on I0 and I1, each image contains
    I, and the rest of I leaves it. So the points of I with itinerary w_1 ... w_n form a closed
    interval, that f maps onto the one of w_2 ... w_n, which is at least slopes[0] times longer;
    nested intervals shrink to one point for every infinite word, and itineraries conjugate f to
    the shift. Raises Unproved where a hypothesis is not proved.
    """
    found = Horseshoe(left.at, left.domain, right.domain, slopes, (left.sign, right.sign))
    for part in (left, right):
        if not within(part.bounds(part.sign), slopes):
            raise Unproved(f"{part.brief}, not within {show_range(slopes)}")
        arc = image_arc(part)
        if not (arc.is_interval and arc.covers(found.interval)):
            raise Unproved(f"{arc.brief}: I is not covered")
    if not escapes(gap, found.gap, found.interval):
        raise Unproved("the gap is not proved to leave I")
    if not left.at == right.at == gap.at:
        raise Unproved("the hypotheses are about different oscillators")
    return found


def escapes(avoided: Avoids, gap: Range, interval: Range) -> bool:
    """Whether f is proved to map all phases of a gap outside an interval."""
    return within(gap, avoided.phases) and within(interval, avoided.target)


def prove_horseshoe(context: Context, reader: Reader) -> Horseshoe:
    """Rule `horseshoe`: {left, right: `read_part` of I0 and of I1, gap: an avoids step, slopes}.

    Conclusion: `horseshoe`.
    """
    left, right, gap, slopes = reader.fields("left", "right", "gap", "slopes")
    parts = read_part(context, left), read_part(context, right)
    return horseshoe(*parts, context.step(gap, Avoids), slopes.range())


def read_part(context: Context, reader: Reader) -> SlopeRange:
    """Read {slopes: a slope-range step, domain: two of its points}: what it says in between."""
    name, domain = reader.fields("slopes", "domain")
    whole = context.step(name, SlopeRange)
    METER.get().spend(8 * len(whole.points))
    part = whole.over(domain.range())
    if part is None:
        raise domain.fail("not two points of the step")
    return part


def _signed_at(of: Parameters, point: Impact) -> Range | None:
    """Return f' at a point inside I0 or I1, times the statement's sign there."""
    for (low, high), sign in zip((of.left, of.right), of.signs, strict=True):
        if low < point.phase < high:
            return signed(point.slope, sign)
    return None


def _slopes_on(of: Parameters, found: Found) -> list[SlopeRange]:
    """Return what is proved about f' on I0 and on I1, as far as it is known."""
    parts = []
    for domain in (of.left, of.right):
        parts += [part for each in found.all(SlopeRange) if (part := each.over(domain))][:1]
    return parts


def _arcs_on(of: Parameters, found: Found) -> list[ImageArc]:
    """Return f(I0) and f(I1), as far as they are proved to be arcs."""
    arcs = []
    for part in _slopes_on(of, found):
        with suppress(Unproved):
            arcs.append(image_arc(part))
    return arcs


def _bounded(
    of: Parameters,
    found: Found,
    margin: Callable[[Range], Fraction],
    strict: bool = False,
    asked: Callable[[Impact], bool] = lambda point: True,
) -> Decision:
    """Decide that f' is bounded on I0 and I1, by bounds on both or by a point in their interior.

    On each it is f' times the sign of the statement.
    margin: how far bounds (low, high) on it are inside; of (high, low) it is how far at most.
    asked: whether a point of I0 or I1 is one of those that the claim is about.
    """
    for point in found.all(Impact):
        slope = _signed_at(of, point)
        if slope and asked(point) and margin(slope[::-1]) < 0:
            return decided(Verdict.REFUTED, point, corrected=found.all(Horseshoe)[:1])
    parts = _slopes_on(of, found)
    if len(parts) < 2:
        return undecided("no proof that f is differentiable on I0 and I1 with bounded slope")
    both = zip(parts, of.signs, strict=True)
    least = min(margin(part.bounds(sign)) for part, sign in both)
    known: dict[str, Range] = {}
    for index, part in enumerate(parts):
        known |= {f"slope_min_I{index}": part.minimum, f"slope_max_I{index}": part.maximum}
    if least < 0 or (strict and least == 0):
        briefs = "; ".join(part.brief for part in parts)
        return undecided(f"{briefs}: {ceil_text(-least)} short", known)
    return decided(Verdict.VERIFIED, *parts, margin=least, known=known)


def _gap_escapes(of: Parameters, found: Found) -> Decision:
    """H4: the closed gap avoids I, or a phase of the open gap is mapped into I."""
    for point in found.all(Impact):
        if of.gap[0] < point.phase < of.gap[1] and within(point.image, of.interval):
            return decided(Verdict.REFUTED, point, corrected=found.all(Horseshoe)[:1])
    for avoided in found.all(Avoids):
        if escapes(avoided, of.gap, of.interval):
            return decided(Verdict.VERIFIED, avoided)
    return undecided("no proof that the first impacts of the gap avoid I, and no witness")


def _two_preimages(of: Parameters, found: Found) -> Decision:
    """H5: both images cover I and the gap leaves it; or one misses an end of I0 or of I1."""
    arcs, known = _arcs_on(of, found), dict[str, Range]()
    for arc in arcs:
        index = 0 if arc.domain == of.left else 1
        known |= {f"image_low_I{index}": arc.low, f"image_high_I{index}": arc.high}
    low, high = of.left[0], of.right[1]
    for arc in arcs:
        if arc.is_interval and (low < arc.low[0] or arc.high[1] < high):
            return decided(Verdict.REFUTED, arc, corrected=found.all(Horseshoe)[:1], known=known)
    if len(arcs) < 2:
        return undecided("no proof that f is monotone on I0 and on I1")
    margin = min(min(low - arc.low[1], arc.high[0] - high) for arc in arcs)
    if margin < 0:
        return undecided(f"an image falls short of I by up to {ceil_text(-margin)}", known)
    if of.interval != (low, high):
        return undecided("I reaches beyond I0 and I1, where nothing is proved", known)
    for avoided in found.all(Avoids):
        if escapes(avoided, of.gap, of.interval):
            return decided(Verdict.VERIFIED, *arcs, avoided, margin=margin, known=known)
    return undecided("f(I0) and f(I1) cover I; the gap is not proved to escape", known)


def _short_preimages(of: Parameters, found: Found) -> Decision:
    """H6: by the mean value theorem, an arc of f(I_i) being covered once."""

    def lands(point: Impact) -> bool:
        low, high = point.image
        slope = _signed_at(of, point)
        return bool(slope and slope[0] > 0) and any(
            a < low and high < b for a, b in (of.left, of.right)
        )

    decision = _bounded(of, found, lambda bounds: bounds[0] - of.slopes[0], True, lands)
    if decision.verdict is Verdict.VERIFIED and len(_arcs_on(of, found)) < 2:
        return undecided("an image may be longer than the circle, a preimage in several pieces")
    return decision


_AT = "At (eta, nu) = ({eta}, {nu}): "
ROWS = (
    Row(
        "H1",
        "3.1, Figure 2",
        "df/dphi >= gamma_2 := 4.2",
        _AT + "{slope} >= {lo} on the interiors of I0 = {i0} and I1 = {i1}{signed}.",
        lambda of, found: _bounded(of, found, lambda bounds: bounds[0] - of.slopes[0]),
    ),
    Row(
        "H2",
        "3.1, Figure 2",
        "gamma_1 := 5.25 >= df/dphi",
        _AT + "{slope} <= {hi} on the interiors of I0 = {i0} and I1 = {i1}{signed}.",
        lambda of, found: _bounded(of, found, lambda bounds: of.slopes[1] - bounds[1]),
    ),
    Row(
        "H3",
        "3.1",
        "monotonically increasing on I_0 and I_1",
        _AT + "f, lifted to a continuous function, {moves} on I0 = {i0} and {again}on I1 = {i1}.",
        lambda of, found: _bounded(of, found, lambda bounds: bounds[0], strict=True),
    ),
    Row(
        "H4",
        "3.1, Figure 2",
        "for phi in [1.15, 1.27] is not in [1.11, 1.32]",
        _AT + "f(phi) is outside I = {i} for every phi in {gap}.",
        _gap_escapes,
    ),
    Row(
        "H5",
        "3.1",
        "f^(-1)(J) consists of two closed intervals",
        _AT + "the points of I = {i} that f maps into a closed interval J of positive length in "
        "I0 = {i0} or I1 = {i1} form two closed intervals, one in I0 and one in I1.",
        _two_preimages,
    ),
    Row(
        "H6",
        "3.1",
        "the length of each of these intervals is less than (1/gamma_2)|J|",
        _AT + "for each closed interval J of positive length in I0 = {i0} or I1 = {i1}, the "
        "preimages of J in I0 and in I1 are shorter than |J| / {lo}.",
        _short_preimages,
    ),
)

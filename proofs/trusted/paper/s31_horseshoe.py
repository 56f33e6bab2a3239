"""Section 3.1: is the plastic impact map a horseshoe on I0 and I1? Claims H1 to H6."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.images import ImageArc, image_arc
from proofs.trusted.kernel.laps import SlopeRange, signed
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, ceil_text, within
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import Impact, impacts
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


def horseshoes(found: Found) -> list[StayingSet]:
    """Return the horseshoes that are proved."""
    return [each for each in found.all(StayingSet) if each.is_horseshoe]


def _escape(of: Parameters, found: Found) -> Avoids | None:
    """Return what proves that f maps all phases of the gap outside I, if that is known."""
    known = (x for x in found.all(Avoids) if within(of.gap, x.source))
    return next((x for x in known if within(of.interval, x.target)), None)


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
    for point in impacts(found.here):
        slope = _signed_at(of, point)
        if slope and asked(point) and margin(slope[::-1]) < 0:
            return decided(Verdict.REFUTED, point, corrected=horseshoes(found)[:1])
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
    for point in impacts(found.here):
        if of.gap[0] < point.phase < of.gap[1] and within(point.image, of.interval):
            return decided(Verdict.REFUTED, point, corrected=horseshoes(found)[:1])
    if avoided := _escape(of, found):
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
            return decided(Verdict.REFUTED, arc, corrected=horseshoes(found)[:1], known=known)
    if len(arcs) < 2:
        return undecided("no proof that f is monotone on I0 and on I1")
    margin = min(min(low - arc.low[1], arc.high[0] - high) for arc in arcs)
    if margin < 0:
        return undecided(f"an image falls short of I by up to {ceil_text(-margin)}", known)
    if of.interval != (low, high):
        return undecided("I reaches beyond I0 and I1, where nothing is proved", known)
    if avoided := _escape(of, found):
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

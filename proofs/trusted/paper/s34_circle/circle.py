"""The plastic map on the whole circle: M6 of section 2, G1 to G4, G6, G10, G13 of section 3.4.

Impacts can be counted in two ways after sticking: in section 2 f takes a sticking phase to the
next impact phase; in section 3.4, where (4.64, 6.05) has period 2, to the separation phase.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import hull, within
from proofs.trusted.paper.s2_foundations import unending
from proofs.trusted.paper.s34_circle.absorption import Absorption, Sink
from proofs.trusted.paper.s34_circle.landing import NeverImpacts, Separation
from proofs.trusted.paper.s34_circle.other_sets import PRINTED
from proofs.trusted.paper.s34_circle.transients import long_transients
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Decide, Decision, Found, Row, Verdict, decided, undecided

CONSTANT = (Fraction("3.38"), Fraction("6.04"))  # where f' = 0, as printed
ORBIT = (Fraction("4.64"), Fraction("6.05"))  # the orbit of period 2, as printed
LONG = (Fraction("1.1"), Fraction("1.5"))  # where transients are long, as printed
_HALF = Fraction(1, 200)  # half a unit of the last place printed
MAJORITY = Fraction(1, 2)  # more than it is most of the circle
_OPEN_SHARE = Fraction(1, 10**6)  # of the circle, of which G13 says nothing
_END = Fraction(1, 10**9)  # how narrowly G13 brackets the ends of an interval
_OPEN = Verdict.UNDECIDED
_NOT_FOLLOWED = "no proof which phases reach the sticking arc"


# -- the rows --------------------------------------------------------------------------------------


def _determined(of: Parameters, found: Found) -> Decision:
    """M6: eta being rational, the gap has a first zero after every phase; after some but a touch.

    Numbers are exact, so that no statement has an irrational eta: `unending` is beside it.
    """
    del of
    never, irrational = found.first(NeverImpacts), unending.prove(found)
    if never is None:
        return undecided("no phase is proved to have no next impact, and none to have one")
    return decided(Verdict.CONDITIONAL, never, corrected=filter(None, (never, irrational)))


def _by_the_arc(verdict: Verdict, holds: Callable[[Separation], bool]) -> Decide:
    """Decide by the arc where the mass sticks, if it has a property."""

    def decide(of: Parameters, found: Found) -> Decision:
        del of
        arc = found.first(Separation)
        if arc is None:
            return undecided("no proof where the mass sticks, and where it lands then")
        if not holds(arc):
            return Decision(_OPEN, (), (arc,), missing=arc.brief, quantities=arc.quantities)
        return decided(verdict, arc, corrected=[arc])

    return decide


def _is_the_printed_orbit(arc: Separation) -> bool:
    """Whether impact and separation are at the phases printed; its period depends on f."""
    printed = zip(ORBIT, (arc.arrival, arc.phase), strict=True)
    return arc.returns and all(within(phase, (x - _HALF, x + _HALF)) for x, phase in printed)


def basin(
    decide: Callable[[Absorption, Sequence[Conclusion]], Verdict], *, printed: bool
) -> Decide:
    """Decide by how much of the circle is proved to come to the orbit, and what not to.

    printed: whether the orbit is to be the one printed.
    """

    def decision(of: Parameters, found: Found) -> Decision:
        del of
        known = found.first(Absorption)
        if known is None or not known.arc.returns:
            return undecided(_NOT_FOLLOWED)
        rest: list[Sink | NeverImpacts] = [known.sink] if known.sink else []
        rest += found.all(NeverImpacts)[:1]
        lost = max((each.share for each in rest), default=Fraction(0))
        basin = {"basin_fraction": (known.share, 1 - lost)}
        nearby = (known.arc, known, *rest)
        is_meant = not printed or _is_the_printed_orbit(known.arc)
        verdict = decide(known, rest) if is_meant else _OPEN
        if verdict is _OPEN:
            missing = f"{known.brief}; of the rest not enough is known"
            return Decision(_OPEN, (), nearby, missing=missing, quantities=basin)
        return decided(verdict, known, *rest, corrected=nearby, known=basin)

    return decision


def most(known: Absorption, rest: Sequence[Conclusion]) -> Verdict:
    """G4: "all the initial conditions chosen", "most of the initial conditions": the latter says
    what of the circle; which ones were chosen the paper does not say.
    """
    del rest
    return Verdict.VERIFIED if known.share > MAJORITY else _OPEN


def _almost_every(known: Absorption, rest: Sequence[Conclusion]) -> Verdict:
    """G10: an interval of phases that never impact again refutes it."""
    del known
    return Verdict.REFUTED if rest else _OPEN


def _two_basins(known: Absorption, rest: Sequence[Conclusion]) -> Verdict:
    """G13: by both basins, and the ends of the interval that ends one of them."""
    del rest
    if known.sink is None or known.open_share > _OPEN_SHARE:
        return _OPEN
    widest = max(high - low for low, high in known.sink.ends)
    return Verdict.VERIFIED if widest <= _END else _OPEN


def _transient(of: Parameters, found: Found) -> Decision:
    """G6: near all phases whose orbits stay in an interval, around the sets of H7 and of G5."""
    known, never = found.first(Absorption), found.all(NeverImpacts)[:1]
    if known is None:
        return undecided(_NOT_FOLLOWED)
    for shift in (each for each in found.all(StayingSet) if each.whole):
        sets = hull([of.interval, PRINTED])
        if within(shift.interval, LONG) and within(sets, shift.interval):
            near = long_transients(shift, known)
            return decided(Verdict.VERIFIED, near, *never, corrected=[near, shift, known, *never])
    return undecided("no full shift in [1.1, 1.5] around the invariant sets")


_AT = "At (eta, nu) = ({eta}, {nu}): "
ROWS = (
    Row(
        "M6",
        "2, after (10)",
        "given an impact phase, the next phase at which impact occurs is uniquely determined",
        _AT + "for every impact phase the next impact phase is uniquely determined, so that f maps "
        "[0, 2 pi) into itself.",
        _determined,
    ),
    Row(
        "G1",
        "3.4, Figure 5",
        "= 0 for all phi in (3.38, 6.04)",
        _AT + "f' = 0 on (3.38, 6.04).",
        _by_the_arc(Verdict.VERIFIED, lambda arc: within(CONSTANT, (arc.start[1], arc.phase[0]))),
        PAPER.place,
    ),
    Row(
        "G2",
        "3.4, Figure 5",
        "(phi_1, phi_2) = (4.64, 6.05) are on 2-periodic orbit",
        _AT + "(4.64, 6.05), to the places printed, is an orbit of period 2 of f.",
        _by_the_arc(Verdict.CONDITIONAL, _is_the_printed_orbit),
        PAPER.place,
    ),
    Row(
        "G3",
        "3.4, Figure 6",
        "stable 2-periodic orbit",
        _AT + "the periodic orbit that sticks, (4.64, 6.05) to the places printed, is stable.",
        _by_the_arc(Verdict.VERIFIED, _is_the_printed_orbit),
        PAPER.place,
    ),
    Row(
        "G4",
        "3.4",
        "most of the initial conditions are attracted to the stable 2-periodic orbit",
        _AT + "the periodic orbit that sticks, (4.64, 6.05) to the places printed, attracts most "
        "initial phases: more than half of the circle.",
        basin(most, printed=True),
        PAPER.place,
    ),
    Row(
        "G6",
        "3.4, Figure 6",
        "very high near the invariant sets (in [1.1, 1.5])",
        _AT + "the number of impacts before the periodic orbit that sticks is reached is high, "
        "without bound, near every phase of the invariant sets, in [1.1, 1.5].",
        _transient,
        PAPER.place,
    ),
    Row(
        "G10",
        "3.4",
        "",
        _AT + "the periodic orbit that sticks, (4.64, 6.05) to the places printed, attracts almost "
        "every phase.",
        basin(_almost_every, printed=True),
        PAPER.place,
    ),
    Row(
        "G13",
        "3.4",
        "",
        _AT + "all of the circle but for at most a millionth part of it comes either to the "
        "periodic orbit that sticks, (4.64, 6.05) to the places printed, or to an interval of "
        "phases, known to 10^(-9) at both ends, after which there is no impact.",
        basin(_two_basins, printed=True),
        PAPER.place,
    ),
)

"""Section 3.4: is there another invariant set in [1.32, 1.48]? Claims G5, and G11, our own."""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.numbers import Phases, Range, show_range
from proofs.trusted.paper.staying import StayingSet
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Decide, Decision, Found, Row, Verdict, decided, undecided

PRINTED = Phases(Fraction("1.32"), Fraction("1.48"))


def _another_set(one_orbit: Verdict) -> Decide:
    """Decide by what stays in the printed interval: a full shift, or one periodic orbit.

    The latter is not in Lambda, in [1.11, 1.32], if a point of it is beyond. It is an invariant
    set, which is all that the paper's words say (G5), but not one like Lambda (G11).
    """

    def decide(of: Parameters, found: Found) -> Decision:
        sets = found.all(StayingSet)
        inside = [each for each in sets if each.region == (PRINTED,)]
        for each in inside:
            if each.full:
                return decided(Verdict.VERIFIED, each, corrected=[each])
        beyond = [x for x in inside if any(cell[0] > of.interval[1] for cell in x.orbit)]
        if not beyond:
            return undecided(f"no proof which orbits stay in {show_range(PRINTED)}")
        beside = [each for each in sets if each.bracketed and each.orbit]
        known: dict[str, Range] = {}
        for period in sorted({len(each.cells) for each in beside}):
            points = {x for each in beside if len(each.cells) == period for x in each.cells}
            known |= {f"period_{period}_point_{i}": x for i, x in enumerate(sorted(points), 1)}
        shifts = [each for each in sets if not each.orbit]
        corrected = (beyond[0], *shifts, *beside)
        return decided(one_orbit, beyond[0], corrected=corrected, known=known)

    return decide


ROWS = (
    Row(
        "G5",
        "3.4",
        "This suggests the existence of another invariant set",
        "At (eta, nu) = ({eta}, {nu}): [1.32, 1.48] holds another invariant set of f.",
        _another_set(Verdict.VERIFIED),
        printed_at=PAPER.place,
    ),
    Row(
        "G11",
        "3.4",
        "",
        "At (eta, nu) = ({eta}, {nu}): [1.32, 1.48] holds another invariant set of the same kind, "
        "on which f is conjugate to the full shift on two symbols.",
        _another_set(Verdict.REFUTED),
        printed_at=PAPER.place,
    ),
)

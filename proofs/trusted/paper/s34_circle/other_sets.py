"""Section 3.4: is there another invariant set in [1.32, 1.48], with a graph as in I?

Claims G5 and G20, and G11, our own.
"""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Phases, Range, show_range
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.slopes import impacts
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


def _same_graph(of: Parameters, found: Found) -> Decision:
    """G20: by f at both ends, and by what stays. An interval that f increases on and maps over one
    that contains it has a fixed point: where all that stays is one orbit of a longer period, there
    is no such interval.
    """
    del of
    sets = found.all(StayingSet)
    ends = [each for each in impacts(found.here) if each.phase in PRINTED]
    for each in sets:
        if each.region == (PRINTED,) and len(each.orbit) > 1:
            around = [x for x in sets if not x.orbit]
            return decided(Verdict.REFUTED, *ends, each, corrected=around)
    return undecided(f"not proved that no phase of {show_range(PRINTED)} is fixed")


ROWS = (
    Row(
        "G5",
        "3.4",
        "This suggests the existence of another invariant set",
        "At (eta, nu) = ({eta}, {nu}): [1.32, 1.48] holds another invariant set of f, a set that f "
        "maps onto itself and that is not in {i}; a periodic orbit is one.",
        _another_set(Verdict.VERIFIED),
        printed_at=PAPER.place,
    ),
    Row(
        "G20",
        "3.4",
        "the graph has the same properties in the set [1.32, 1.48]",
        "At (eta, nu) = ({eta}, {nu}): in [1.32, 1.48] the graph of f has the properties that the "
        "proof for I = {i} uses: there are two disjoint closed intervals, on each of which f is "
        "continuous and increases, with f' > 1, and each of which f maps over [1.32, 1.48].",
        _same_graph,
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

"""What horseshoes with restitution say in words, complete enough to be quoted."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from proofs.trusted.numbers import Range, ceil_text, floor_text, hull, show, show_range
from proofs.trusted.paper.s33_restitution.rebounds import Box, Horseshoe, Rebound
from proofs.trusted.parameters import Parameters, parameters_text


def word_text(word: Sequence[int]) -> str:
    """Write an itinerary."""
    return " ".join(f"V{symbol + 1}" for symbol in word)


def _sets(one: Horseshoe) -> str:
    left, right = one.rectangles
    gamma = show_range(left.velocities)
    return f"{show_range(left.phases)} x {gamma} and {show_range(right.phases)} x {gamma}"


def _rates(found: Sequence[Horseshoe]) -> str:
    expansion = floor_text(min(one.expansion for one in found), 2)
    contraction = ceil_text(max(one.contraction for one in found), 3)
    return (
        f"it is uniformly hyperbolic: each step stretches unstable vectors at least {expansion} "
        f"times in phase and shrinks stable ones to at most {contraction} times in velocity"
    )


def restricted_text(one: Horseshoe) -> str:
    """State the theorem about the full orbits in the printed rectangles, if V2 never repeats."""
    return (
        f"At {parameters_text(one.rectangles[0].box)}, all states of the closed rectangles V1 and "
        "V2 are physically possible before an impact (gap' <= 0), F is smooth and one-to-one on V1 "
        "and V2, and F on Lambda_2, the set of all states whose full orbits stay in V1 and V2, is "
        "conjugate to the shift on all two-sided sequences of 1 and 2 without 22 (golden mean "
        f"shift), by the itinerary; {_rates([one])}. Lambda_2 has topological entropy "
        "log((1 + sqrt 5)/2), periodic orbits of every period, uncountably many nonperiodic "
        "orbits and a dense orbit."
    )


def full_text(found: Sequence[Horseshoe], boxes: Sequence[Box]) -> str:
    """State the theorem about rectangles that are mapped across both, for all these parameters."""
    if all(box[2][1] == 0 for box in boxes):
        return _plastic_text(found, boxes)
    where = "; or ".join(map(parameters_text, boxes))
    plastic = any(box[2][0] == 0 for box in boxes)
    return (
        f"For {where}: on N1, N2 = {_sets(found[0])} all states are physically possible before an "
        "impact, and the set of all states whose full orbits stay in N1 and N2 has exactly one "
        "full orbit for each two-sided sequence of 1 and 2, its itinerary; "
        f"{_rates(found)}. F is one-to-one there"
        + (" if epsilon > 0" if plastic else "")
        + " and conjugate to the two-sided full shift on two symbols, of entropy log 2"
        + (
            "; for epsilon = 0, the plastic map f on the phases that stay in these intervals is "
            "conjugate to the one-sided full shift"
            if plastic
            else ""
        )
        + f". Edges overshoot both rectangles by at least "
        f"{floor_text(min(one.margin for one in found))}."
    )


def _plastic_text(found: Sequence[Horseshoe], boxes: Sequence[Box]) -> str:
    """State it for epsilon = 0 alone: p = f', and no state depends on the velocity before."""
    first, second = (show_range(one.phases) for one in found[0].rectangles)
    return (
        f"For {'; or '.join(map(parameters_text, boxes))}: the plastic map f is continuously "
        f"differentiable on the intervals {first} and {second}, with f' >= "
        f"{floor_text(min(one.expansion for one in found), 2)}, and maps each across both, beyond "
        f"them by at least {floor_text(min(one.margin for one in found))}. Each one-sided sequence "
        "of 1 and 2 is the itinerary of exactly one phase whose orbit stays in them, and f on "
        "these phases is conjugate to the one-sided full shift on two symbols, of entropy log 2."
    )


def merged(boxes: Sequence[Box]) -> list[Box]:
    """Join boxes that agree in two sides and meet in the third, until none do."""
    rest = sorted(boxes)
    for one, two in combinations(rest, 2):
        apart = [index for index in range(3) if one[index] != two[index]]
        if not apart or (len(apart) == 1 and _meet(one[apart[0]], two[apart[0]])):
            joined = [hull(sides) for sides in zip(one, two, strict=True)]
            rest.remove(one)
            rest.remove(two)
            return merged([*rest, (joined[0], joined[1], joined[2])])
    return rest


def _meet(one: Range, two: Range) -> bool:
    return one[0] <= two[1] and two[0] <= one[1]


def edge_text(of: Parameters, number: int, side: str, one: Rebound) -> str:
    """Write the extreme image of an edge, and by how much it is beyond V1 and V2, or short."""
    end = of.left[0] if side == "left" else of.right[1]
    short = one.phase[0] - end if side == "left" else end - one.phase[1]
    beyond = end - one.phase[1] if side == "left" else one.phase[0] - end
    verdict = f"beyond {show(end)} by at least {floor_text(beyond)}"
    if beyond <= 0:
        verdict = f"short of {show(end)} by at least {floor_text(short)}" if short > 0 else "near"
    return (
        f"the {side} edge of V{number + 1} reaches phase [{floor_text(one.phase[0])}, "
        f"{ceil_text(one.phase[1])}] from (phi, gamma) = ({show(one.phases[0])}, "
        f"{show(one.velocities[0])}), {verdict}"
    )

"""Claims N1-N4: the impact map with restitution on the rectangles of section 3.3."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from proofs.trusted.numbers import Range, ceil_text, floor_text, hull, show
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.s33_restitution.rebound_boxes import on_box
from proofs.trusted.paper.s33_restitution.rebound_facts import (
    FULL,
    Pair,
    barred_words,
    corner_of,
    horseshoes,
    is_state,
    oscillator,
    printed_pair,
    restricted,
)
from proofs.trusted.paper.s33_restitution.rebound_texts import (
    edge_text,
    full_text,
    merged,
    restricted_text,
    word_text,
)
from proofs.trusted.paper.s33_restitution.rebounds import (
    CONE,
    Rebound,
    Unjoined,
    horseshoe,
    rates,
    size,
    stable_slope,
)
from proofs.trusted.parameters import Parameters, parameters_text
from proofs.trusted.verdicts import Verdict

# -- N1 --------------------------------------------------------------------------------------------

_NOTHING = "no proof about F on V1 and V2"
_PLASTIC = "without restitution F forgets velocities and is not one-to-one: see H7-H9"


def _horseshoe(of: Parameters, found: Sequence[object]) -> Decision:
    pair, words = printed_pair(of, found), barred_words(of, found)
    edges = [edge_text(of, *each) for each in _corners(of, found) if _is_inside(of, each[2])]
    if pair is None:
        if edges:
            return Decision(Verdict.REFUTED, edges[0], witness="; ".join(edges))
        corners = [edge_text(of, *each) for each in _corners(of, found)]
        return undecided("; ".join([_NOTHING, *corners]))
    extremes = list(_extremes(of, found, pair))
    images = {
        f"{'greatest' if side == 'left' else 'least'}_image_{side}_V{number + 1}": one.phase
        for number, side, one in extremes
    }
    try:
        whole = horseshoe(pair, FULL)
    except Unjoined as failure:
        if not words and not edges:
            return Decision(Verdict.UNDECIDED, str(failure), quantities=images)
    else:
        why = f"edges overshoot both rectangles by at least {floor_text(whole.margin)}"
        return Decision(Verdict.VERIFIED, why, quantities=images)
    edges = list(dict.fromkeys([*edges, *(edge_text(of, *each) for each in extremes)]))
    if words:
        word = words[min(words, key=lambda word: (len(set(word)), len(word), word))]
        edges = [
            f"no orbit of F follows {word_text(word.word)} in the closed rectangles: the last "
            f"impact misses V{word.word[-1] + 1} by at least {floor_text(word.short)}",
            *edges,
        ]
    return Decision(
        Verdict.REFUTED,
        edges[0],
        witness="; ".join(edges),
        corrected=_corrections(of, found),
        quantities=images,
    )


def _corners(of: Parameters, found: Sequence[object]) -> Iterator[tuple[int, str, Rebound]]:
    """Yield what is known about corners of V1 and V2: the rectangle, the edge, the state."""
    for one in found:
        if isinstance(one, Rebound) and one.box == oscillator(of):
            for number, side in corner_of(one, (of.left, of.right), of.velocities):
                yield number, side, one


def _is_inside(of: Parameters, one: Rebound) -> bool:
    """Whether an image is between the outer edges, so that the edge it is from is not beyond."""
    return of.left[0] < one.phase[0] and one.phase[1] < of.right[1]


def _extremes(
    of: Parameters, found: Sequence[object], pair: Pair
) -> Iterator[tuple[int, str, Rebound]]:
    """Yield for each edge the state whose image decides whether all of it goes beyond V1 and V2.

    Where the next phase increases with the velocity, the greatest image phase of an edge is that
    of its highest velocity, the least that of its lowest.
    """
    for (number, one), side in product(enumerate(pair), ("left", "right")):
        state = (one.phases[0], one.velocities[1])
        if side == "right":
            state = (one.phases[1], one.velocities[0])
        for known in found:
            if (
                isinstance(known, Rebound)
                and (known.box, known.phases[0], known.velocities[0]) == (one.box, *state)
                and is_state(known)
                and one.derivative[0][1][0] > 0
            ):
                yield number, side, known
                break


def _corrections(of: Parameters, found: Sequence[object]) -> str | None:
    """Write what is true about the printed rectangles, and about the nearest that do."""
    texts = []
    golden = restricted(of, found)
    if golden is not None:
        texts.append(restricted_text(golden))
    exact = [one for one in horseshoes(of, found, FULL) if one.rectangles[0].box == oscillator(of)]
    if exact:
        texts.append(full_text(exact[:1], [exact[0].rectangles[0].box]))
    return " ".join(texts) or None


# -- N2 --------------------------------------------------------------------------------------------


def _hyperbolic(of: Parameters, found: Sequence[object]) -> Decision:
    pair = printed_pair(of, found)
    if pair is None or not of.epsilon:
        return undecided(_NOTHING if of.epsilon else _PLASTIC)
    (p, q), (r, s) = (
        [hull([one.derivative[row][column] for one in pair]) for column in (0, 1)] for row in (0, 1)
    )
    try:
        expansion, contraction = rates(pair)
    except Unjoined as failure:
        return undecided(str(failure))
    if p[0] <= 1 or size(q) + size(s) >= 1:
        return undecided("distances are not proved to grow and to shrink")
    grow, shrink = floor_text(p[0], 2), ceil_text(size(q) + size(s), 3)
    slope = max(stable_slope(one.derivative) for one in pair) / CONE
    corrected = (
        f"At {parameters_text(pair[0].box)}, on the closed rectangles V1 and V2: DF has the rows "
        f"(p, q), (r, s) with p in {_rounded(p)}, q in {_rounded(q)}, r in {_rounded(r)}, s in "
        f"{_rounded(s)}. The images of two states on one horizontal line of a rectangle are at "
        f"least {grow} times as far apart, of two states on one vertical line at most {shrink} "
        "times. Vertical vectors (0, 1) are not mapped to vertical ones, but for every compact set "
        "K in V1 and V2 with F(K) = K, F is uniformly hyperbolic: its unstable directions have "
        f"|dgamma| <= {show(CONE)} |dphi| and grow in phase at least {floor_text(expansion, 2)} "
        f"times a step, its stable ones have |dphi| <= {ceil_text(slope, 3)} |dgamma| and shrink "
        f"in velocity to at most {ceil_text(contraction, 3)} times."
    )
    why = f"horizontal distances grow at least {grow} times, vertical ones shrink to {shrink}"
    return Decision(Verdict.VERIFIED, why, corrected=corrected)


def _rounded(values: Range) -> str:
    return f"[{floor_text(values[0], 4)}, {ceil_text(values[1], 4)}]"


# -- N3 --------------------------------------------------------------------------------------------


def _orbits(of: Parameters, found: Sequence[object]) -> Decision:
    if not of.epsilon:
        return undecided(_PLASTIC)
    golden, corrected = restricted(of, found), _boxes_text(of, found)
    if golden is not None:
        why = "F on Lambda_2 is conjugate to the two-sided shift on sequences without 22"
        text = " ".join(filter(None, (restricted_text(golden), corrected)))
        return Decision(Verdict.VERIFIED, why, corrected=text)
    for one in horseshoes(of, found, FULL):
        if one.rectangles == printed_pair(of, found):
            why = "F on Lambda_2 is conjugate to the two-sided full shift"
            return Decision(Verdict.VERIFIED, why, corrected=corrected)
    return undecided("no proof of which words orbits in V1 and V2 follow")


def _boxes_text(of: Parameters, found: Sequence[object]) -> str | None:
    """Write the theorem for ranges of parameters, and a state at which it stops to hold."""
    wide = [
        one
        for one in horseshoes(of, found, FULL)
        if any(low < high for low, high in one.rectangles[0].box)
    ]
    if not wide:
        return None
    sets = tuple(one.phases for one in wide[0].rectangles)
    same = [one for one in wide if tuple(each.phases for each in one.rectangles) == sets]
    text = full_text(same, merged([one.rectangles[0].box for one in same]))
    beyond = [
        f"at {parameters_text(one.box)} the state (phi, gamma) = ({show(one.phases[0])}, "
        f"{show(one.velocities[0])}) of the {side} edge of N{number + 1} has its next impact "
        f"at a phase in [{floor_text(one.phase[0])}, {ceil_text(one.phase[1])}]"
        for one in found
        if isinstance(one, Rebound) and one.box != oscillator(of)
        for number, side in corner_of(one, (sets[0], sets[1]), of.velocities)
        if sets[0][0] < one.phase[0] and one.phase[1] < sets[1][1]
    ]
    if beyond:
        text += f" Beyond, edges of these sets fall short: {'; '.join(beyond)}."
    return text


_AT = "At (eta, nu, epsilon) = ({eta}, {nu}, {epsilon}), with V1 = {i0} x {gamma}, V2 = {i1} x "
_AT += "{gamma} (phases x velocities before an impact): "

CLAIMS = (
    Claim(
        "N1",
        _AT + "F maps V1 and V2 across both of them, a topological horseshoe: every sequence of 1 "
        "and 2 is followed by an orbit of F.",
        _horseshoe,
    ),
    Claim(
        "N2",
        _AT + "F shrinks vertical distances in V1 and in V2 and expands horizontal ones, each by a "
        "uniform factor, and is uniformly hyperbolic on the states whose full orbits stay there.",
        _hyperbolic,
    ),
    Claim(
        "N3",
        _AT + "the set Lambda_2 of the states whose full orbits stay in V1 and V2 contains "
        "periodic orbits of arbitrarily high periods, uncountably many nonperiodic orbits, and an "
        "orbit that is dense in it.",
        _orbits,
    ),
    Claim(
        "N4",
        "For all {box}, with V1 = {i0} x {gamma}, V2 = {i1} x {gamma}: every two-sided sequence of "
        "1 and 2 is the itinerary of exactly one full orbit of F in V1 and V2, and F on the states "
        "of these is uniformly hyperbolic, and conjugate to the full shift on two symbols "
        "(where epsilon = 0: f, on the phases whose orbits stay there, to the one-sided one).",
        on_box,
    ),
)

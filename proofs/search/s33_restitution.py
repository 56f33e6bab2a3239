"""Section 3.3: the impact map with restitution on the printed rectangles. Claims N1 to N5.

Candidates by floating point; every impact, rectangle and barred word is proved by interval
arithmetic and recorded for the checker.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product

from proofs.search.evidence import Evidence
from proofs.search.repair import places, short_decimal
from proofs.search.request import Request, proving
from proofs.search.s33_rectangles import (
    Images,
    Sets,
    image_phases,
    narrowed,
    nearest_rectangles,
    widened,
)
from proofs.search.s33_steps import ReboundProver
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper.s33_restitution.horseshoes import shoes
from proofs.trusted.parameters import Place

_ATTEMPTS = 12  # with widened rectangles


@proving
def prove(request: Request) -> Evidence:
    """Decide the claims asked for: the printed rectangles, the nearest that do, and boxes.

    What cannot be proved leaves no step; the claim is then undecided for want of it.
    """
    if request.of.box is None or request.of.epsilon is None or request.of.velocities is None:
        return Evidence()
    prover = ReboundProver(request.of, request.digits)
    at = Place.restituting(request.of.eta, request.of.nu, request.of.epsilon)
    exact = [claim for claim in request.claims if claim not in ("N4", "N5")]
    named, notes = _at_exact_numbers(prover, at, exact, request.tell) if exact else ({}, {})
    if request.asks("N4"):
        from proofs.search.s33_boxes import on_box  # what one claim alone needs

        request.tell("the box of parameters")
        named["N4"], notes["N4"] = on_box(prover, request.of.box)
    if request.asks("N5"):
        from proofs.search.s33_family import along_epsilon

        request.tell("larger epsilon")
        named["N5"], notes["N5"] = along_epsilon(prover)
    proofs = {
        claim: [(name, prover.known[name]) for name in dict.fromkeys(names)]
        for claim, names in named.items()
    }
    return Evidence(prover.steps, proofs, notes)


def _at_exact_numbers(
    prover: ReboundProver, at: Place, claims: Sequence[str], tell: Callable[[str], None]
) -> tuple[dict[str, list[str]], dict[str, str]]:
    """Return the names of steps for N1, N2 and N3, and why there are no more."""
    statement = prover.of
    images, sets = image_phases(at, prover.velocities), (statement.left, statement.right)
    nearest = next(nearest_rectangles(statement, images), None)
    cuts = sorted({end for pair in (sets, nearest or sets) for ends in pair for end in ends})
    tell("impacts on V1 and V2")
    named: dict[str, list[str]] = {claim: [] for claim in claims}
    try:
        pair = prover.pair(at, sets, cuts)
    except Unproved as failure:
        if "N1" in named:
            named["N1"] = prover.corners(at, sets)
        return named, dict.fromkeys(claims, str(failure))
    if "N2" in named:
        named["N2"] = pair
    common: list[str] = []
    if nearest == sets:
        common = _attempt(lambda: prover.crossing(at, sets, cuts))
    elif {"N1", "N3"} & set(claims):
        tell("which itineraries are missing")
        common = _attempt(lambda: _never_repeats(prover, pair, images))
    for claim in {"N1", "N3"} & set(claims):
        named[claim] += common
    if "N1" in named and nearest != sets:
        named["N1"] += [*_attempt(lambda: prover.constant_word(pair)), *prover.corners(at, sets)]
        if nearest is not None:
            named["N1"] += _attempt(lambda: prover.crossing(at, nearest, cuts))
    if "N3" in named and nearest is not None:
        tell("ranges of parameters")
        named["N3"] += _ranges(prover, at, nearest)
    return named, {}


def _attempt(make: Callable[[], str]) -> list[str]:
    """Return the name of the step made, if that succeeds."""
    try:
        return [make()]
    except Unproved:
        return []


def _never_repeats(prover: ReboundProver, pair: Sequence[str], images: Images) -> str:
    ends = narrowed(prover.of, images)
    if ends is None:
        raise Unproved("no part of V2 has an edge beyond V1 and within the images of V1")
    third = (ends[1] - ends[0]) / 3
    end = short_decimal(ends[0] + third, ends[1] - third)
    return prover.never_repeats(pair, (prover.of.right[0], end))


def _ranges(prover: ReboundProver, exact: Place, nearest: Sets) -> list[str]:
    """Prove the theorem for all eta and epsilon that print as given, and as many nu as go.

    Then, at eta and nu as given, for larger epsilon; and where edges fail beyond. All start from
    epsilon = 0 if that is as near as the printed place. The rectangles are the first widened ones
    with which it succeeds.
    """
    statement = prover.of
    eta, nu, epsilon = (low for low, _ in exact.sides)
    half, unit = _half_unit(epsilon), _half_unit(nu) / 50
    etas = eta - _half_unit(eta), eta + _half_unit(eta)
    epsilons = max(Fraction(0), epsilon - 2 * half), epsilon + half
    corners = [
        image_phases(replace(exact, eta=(x, x), epsilon=(y, y)), prover.velocities)
        for x, y in product(etas, epsilons)
    ]
    box = Place(etas, (nu - unit, nu + unit), epsilons)
    for sets in islice(widened(statement, nearest, corners), _ATTEMPTS):
        with suppress(Unproved):
            parts = [prover.crossing(box, sets)]
            parts += prover.slabs(box, sets, "nu", 2 * unit)
            parts += prover.slabs(box, sets, "nu", -2 * unit)
            more = prover.slabs(replace(exact, epsilon=epsilons), sets, "epsilon", half)
            wide, most = (
                shoes(prover.known[name] for name in each)[-1].at for each in (parts, more or parts)
            )
            names = [*parts, *more]
            names += prover.beyond(exact, sets, "nu", wide.nu[1], 2 * unit)
            names += prover.beyond(exact, sets, "nu", wide.nu[0], -2 * unit)
            names += prover.beyond(exact, sets, "epsilon", most.sides[2][1], half)
            return names
    return []


def _half_unit(value: Fraction) -> Fraction:
    """Return half a unit of the last place that a decimal is printed with."""
    return Fraction(1, 2 * 10 ** places((value,)))

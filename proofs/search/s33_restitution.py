"""Section 3.3: the impact map with restitution on the printed rectangles. Claims N1 to N4.

Candidates by floating point; every impact, rectangle and barred word is proved by interval
arithmetic and recorded for the checker.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from itertools import islice, product

from intervals import DomainError, Undecided
from proofs.motion.impact import HORIZON
from proofs.motion.system import System
from proofs.search.evidence import Evidence
from proofs.search.repair import places, short_decimal
from proofs.search.s33_boxes import on_box
from proofs.search.s33_rectangles import Sets, image_phases, narrowed, nearest_rectangles, widened
from proofs.search.s33_steps import ReboundProver
from proofs.search.steps import Prover
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s33_restitution.rebound_facts import oscillator
from proofs.trusted.paper.s33_restitution.rebounds import Box, Unjoined
from proofs.trusted.parameters import Parameters

CLAIMS = ("N1", "N2", "N3", "N4")
_ATTEMPTS = 12  # with widened rectangles


def prove(
    of: Parameters,
    claims: Sequence[str],
    *,
    digits: int = 30,
    tell: Callable[[str], None] = lambda stage: None,
) -> Evidence:
    """Decide the claims asked for: the printed rectangles, the nearest that do, and boxes.

    What cannot be proved leaves no step; the claim is then undecided for want of it.
    """
    box = oscillator(of)
    if box is None or of.velocities is None:
        return Evidence()
    prover = ReboundProver(of, Prover(System(of.eta, of.nu), digits, HORIZON))
    exact = [claim for claim in claims if claim != "N4"]
    named = _at_exact_numbers(prover, box, exact, tell) if exact else {}
    if "N4" in claims:
        tell("the box of parameters")
        named["N4"] = on_box(prover)
    found = {**prover.rebounds, **prover.rectangles, **prover.words}
    proofs = {
        claim: [(name, found[name]) for name in dict.fromkeys(names)]
        for claim, names in named.items()
    }
    return Evidence(prover.steps, proofs)


def _at_exact_numbers(
    prover: ReboundProver, box: Box, claims: Sequence[str], tell: Callable[[str], None]
) -> dict[str, list[str]]:
    """Return the names of steps for N1, N2 and N3."""
    of = prover.of
    images, sets = image_phases(of), (of.left, of.right)
    nearest = next(nearest_rectangles(of, images), None)
    cuts = sorted({end for pair in (sets, nearest or sets) for ends in pair for end in ends})
    tell("impacts on V1 and V2")
    try:
        pair = prover.pair(box, sets, cuts)
    except (Undecided, DomainError, Unjoined):
        return {"N1": prover.corners(box, sets)} if "N1" in claims else {}
    named = {claim: list(pair) for claim in claims}
    if nearest != sets and {"N1", "N3"} & set(claims):
        tell("which itineraries are missing")
        golden = _attempt(prover, lambda: _restricted(prover, pair, narrowed(of, images)))
        for claim in {"N1", "N3"} & set(claims):
            named[claim] += golden
        if "N1" in claims:
            named["N1"] += _refutation(prover, pair, sets)
            if nearest is not None:
                repaired = nearest
                named["N1"] += _attempt(prover, lambda: prover.horseshoe(box, repaired, cuts))
    if "N3" in claims and nearest is not None:
        tell("ranges of parameters")
        named["N3"] += _ranges(prover, nearest)
    return named


def _attempt(prover: ReboundProver, make: Callable[[], list[str]]) -> list[str]:
    """Return the names of the steps made; none of an attempt that fails."""
    before = dict(prover.steps)
    try:
        return make()
    except (Undecided, DomainError, Unjoined):
        prover.forget(before)
        return []


def _refutation(prover: ReboundProver, pair: Sequence[str], sets: Sets) -> list[str]:
    """Prove a word without orbit, and states on edges whose images fall short."""
    box = prover.rectangles[pair[0]].box
    word = _attempt(prover, lambda: [prover.constant_word(pair)])
    return word + prover.corners(box, sets)


def _restricted(prover: ReboundProver, pair: Sequence[str], right_ends: Range | None) -> list[str]:
    if right_ends is None:
        raise Unjoined("no part of V2 has an edge beyond V1 and within the images of V1")
    low, high = right_ends
    third = (high - low) / 3
    return prover.never_repeats(
        pair, (prover.of.right[0], short_decimal(low + third, high - third))
    )


def _ranges(prover: ReboundProver, nearest: Sets) -> list[str]:
    """Prove the theorem for all eta and epsilon that print as given, and as many nu as go.

    Then, at eta and nu as given, for larger epsilon. All start from epsilon = 0 if that is as near
    as the printed place. The rectangles are the first widened ones with which it succeeds.
    """
    of, exact = prover.of, oscillator(prover.of)
    if exact is None:
        return []
    eta, nu, epsilon = (low for low, _ in exact)
    half, unit = _half_unit(epsilon), _half_unit(nu) / 50
    etas = (eta - _half_unit(eta), eta + _half_unit(eta))
    epsilons = (max(Fraction(0), epsilon - 2 * half), epsilon + half)
    corners = [replace(of, eta=x, epsilon=y, reach=None) for x, y in product(etas, epsilons)]
    box = (etas, (nu - unit, nu + unit), epsilons)
    for sets in islice(widened(of, nearest, corners), _ATTEMPTS):
        with suppress(Unjoined):
            names = prover.horseshoe(box, sets)
            for step in (2 * unit, -2 * unit):
                names += prover.ranges(box, sets, 1, step)
            return names + prover.ranges((exact[0], exact[1], epsilons), sets, 2, half)
    return []


def _half_unit(value: Fraction) -> Fraction:
    """Return half a unit of the last place that a decimal is printed with."""
    return Fraction(1, 2 * 10 ** places((value,)))

"""Slope bounds of f' over I0 and I1: loss against time, for us and for others on the same work."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from fractions import Fraction
from functools import cache, partial
from itertools import pairwise

import numpy as np

from intervals import IntervalArray, Undecided
from intervals.taylor import polynomial_range
from proofs.benchmark import horseshoe_flint
from proofs.benchmark.arithmetics import Arithmetic, Flint, Iv, Ours
from proofs.benchmark.codac_slopes import slopes as slopes_by_codac
from proofs.benchmark.curves import Budget, Curve, Maker, Task, sweep
from proofs.benchmark.horseshoe import DOMAINS, SYSTEM
from proofs.benchmark.operations import ARRAY, SCALAR
from proofs.benchmark.peers import CODAC, FLINT, IV, Codac
from proofs.benchmark.slope_forms import MONOTONE, Work, coefficients, exclude, one_by_one
from proofs.motion.covering import cover_by_impacts
from proofs.motion.impact import HORIZON
from proofs.motion.kernel import (
    Launches,
    enclose_times,
    exclude_impacts,
    find_times,
    prove_brackets,
)
from proofs.motion.slope_cover import cut, grid_of, slope_cover, slope_extremes
from proofs.search.steps import Prover
from proofs.trusted.numbers import Range

NAMES = {0: "natural", 1: "mean value", 2: "Taylor 2", 3: "Taylor 3", 4: "Taylor 4"}
_BITS = 53
_TRUE_DIGITS = 400  # more than are asked of any
_SPARE_BITS = 30
_OPENING = 1e-11  # relative: a bracket that one library proves, another can prove too
_MONOTONE_BOXES = 8
_ROUNDING = 1e-14  # about the error that binary64 leaves
_WORK = "f' on I0 and I1"


def bits_for(digits: float) -> int:
    """Return bits for so many digits, with some to spare."""
    return math.ceil(digits * math.log2(10)) + _SPARE_BITS


def at_bits(name: str, bits: int) -> AbstractContextManager[object]:
    """Set the precision of python-flint, which is global, where it is meant."""
    if name != FLINT:
        return nullcontext()
    import flint

    manager: AbstractContextManager[object] = flint.ctx.workprec(bits)
    return manager


def arithmetic(name: str, bits: int) -> Arithmetic:
    """Return the numbers of a library."""
    kinds: dict[str, Callable[[int], Arithmetic]] = {SCALAR: Ours, FLINT: Flint, IV: Iv}
    return kinds[name](bits)


@cache
def truth() -> list[Range]:
    """Return the extremes of f' by monotonicity, to more digits than any other here."""
    prover = Prover(SYSTEM, _TRUE_DIGITS, HORIZON)
    found = [prover.slopes(list(domain))[1].pieces for domain in DOMAINS]
    return [(min(low for low, _ in one), max(high for _, high in one)) for one in found]


def loss(found: Sequence[Range]) -> float:
    """Return by how much the bounds miss the truth; < 0 if they exclude it."""
    losses = [
        lost
        for (low, high), (least, most) in zip(found, truth(), strict=True)
        for lost in (least - low, high - most)
    ]
    return float(min(losses)) if min(losses) < 0 else float(max(losses))


@cache
def grids() -> list[list[float]]:
    """Return times before every impact, for each domain: what the scalar proof found."""
    return [grid_of(cover_by_impacts(SYSTEM, domain)[0]) for domain in DOMAINS]


@cache
def works(boxes: int) -> list[Work]:
    """Return what is given to all; Undecided if the kernel does not find it."""
    truth()  # not in anybody's time
    return [work(*given, boxes) for given in zip(DOMAINS, grids(), strict=True)]


def work(domain: Range, grid: list[float], boxes: int) -> Work:
    """Return the work of one domain."""
    times = slope_cover(SYSTEM, domain, boxes, grid).times
    cuts = cut(domain, boxes)
    low, high = times.inf * (1 - _OPENING), times.sup * (1 + _OPENING)
    ends = find_times(SYSTEM, np.array([float(end) for end in domain])).tolist()
    return Work(
        domain,
        cuts.tolist(),
        grid,
        list(zip(low.tolist(), high.tolist(), strict=True)),
        find_times(SYSTEM, 0.5 * (cuts[:-1] + cuts[1:])).tolist(),
        (ends[0], ends[1]),
    )


# -- ways ------------------------------------------------------------------------------------------


class _Arrays(Ours):
    """IntervalArrays: the exact parameters enter as they are."""

    def number(self, low: object, high: object) -> object:  # type: ignore[override]
        """Return an exact number."""
        return low


def at_once(given: Work, order: int) -> Range:
    """Do the work for all boxes at once, in binary64."""
    cuts = np.array(given.cuts)
    launches = Launches(SYSTEM, IntervalArray.from_floats(cuts[:-1], cuts[1:]))
    exclude_impacts(launches, given.grid)
    last = np.full(len(cuts) - 1, given.grid[-1])
    low, high = np.array(given.brackets).T
    prove_brackets(launches, last, low, high)
    of, times = _Arrays(_BITS), IntervalArray.from_floats(low, high)
    over = coefficients(of, SYSTEM, launches.phases, times, order)
    found = over[0]
    if order:
        centre, about = launches.centre, np.array(given.centres)
        thin = enclose_times(centre, last, (about, about))
        at = coefficients(of, SYSTEM, centre.phases, thin, order - 1)
        found = polynomial_range([*at, over[order]], launches.offset)
    return Fraction(float(found.inf.min())), Fraction(float(found.sup.max()))


def _by_array(order: int, size: float) -> Task:
    given = works(int(size))
    return lambda: loss([at_once(one, order) for one in given])


def _by_scalars(name: str, order: int, bits: int, size: float) -> Task:
    """Return the work box by box in a library, signs at 53 bits, f' at `bits`."""
    given = works(int(size))
    of, coarse = arithmetic(name, bits), arithmetic(name, _BITS)

    def excluded(one: Work) -> None:
        if name == FLINT:
            if not horseshoe_flint.exclusion(one.cuts, one.grid)():
                raise Undecided("an earlier impact is not excluded")
        else:
            boxes = [coarse.number(*ends) for ends in pairwise(one.cuts)]
            exclude(coarse, SYSTEM, boxes, one.grid)

    def task() -> float:
        for one in given:
            excluded(one)
        with at_bits(name, bits):
            return loss([one_by_one(of, coarse, SYSTEM, one, order) for one in given])

    return task


def _by_codac(server: Codac, order: int, size: float) -> Task:
    given = works(int(size))
    return lambda: loss([slopes_by_codac(server, one, order) for one in given])


def _monotone(_: float) -> Task:
    def task() -> float:
        found = [slope_extremes(SYSTEM, domain) for domain in DOMAINS]
        return loss([(Fraction(x.minimum[0]), Fraction(x.maximum[1])) for x in found])

    return task


def _prover(digits: float) -> Task:
    def task() -> float:
        provers = (Prover(SYSTEM, int(digits), HORIZON).slopes(list(d))[1] for d in DOMAINS)
        pieces = [one.pieces for one in provers]
        return loss([(min(x for x, _ in one), max(y for _, y in one)) for one in pieces])

    return task


# -- curves ----------------------------------------------------------------------------------------


def binary64(
    budget: Budget, sizes: Sequence[float], flint: bool, codac: Codac | None
) -> list[Curve]:
    """Measure the forms in binary64, at numbers of boxes."""
    curves = []
    for order in NAMES:
        makers: dict[str, Maker] = {ARRAY: partial(_by_array, order)}
        if flint:
            makers[FLINT] = partial(_by_scalars, FLINT, order, _BITS)
        makers[IV] = partial(_by_scalars, IV, order, _BITS)
        if codac is not None:
            makers[CODAC] = partial(_by_codac, codac, order)
        curves += _forms("binary64", order, makers, sizes, budget, floor=_ROUNDING)
    one = Curve(f"{_WORK}, binary64", f"monotonicity, {ARRAY}", "boxes")
    return curves + sweep({"": (one, _monotone)}, (_MONOTONE_BOXES,), budget)


def multiprecision(
    budget: Budget, digits: int, orders: Sequence[int], sizes: Sequence[float], flint: bool
) -> list[Curve]:
    """Measure the forms at a number of digits."""
    curves = []
    for order in orders:
        names = (SCALAR, FLINT, IV) if flint else (SCALAR, IV)
        makers: dict[str, Maker] = {
            name: partial(_by_scalars, name, order, bits_for(digits)) for name in names
        }
        title, floor = f"{digits} digits", 10.0**-digits
        curves += _forms(title, order, makers, sizes, budget, floor=floor)
    return curves


def by_monotonicity(budget: Budget, digits: Sequence[float], flint: bool) -> list[Curve]:
    """Measure f'' > 0 and f' at the ends, at numbers of digits."""
    title = f"{_WORK}, f'' > 0"
    names = (SCALAR, FLINT, IV) if flint else (SCALAR, IV)
    makers: dict[str, tuple[Curve, Maker]] = {
        name: (Curve(title, name, "digits", against="time"), _monotone_by(name)) for name in names
    }
    prover = Curve(title, "search.steps, grid found and witness kept", "digits", against="time")
    return sweep({**makers, "": (prover, _prover)}, digits, budget)


def _monotone_by(name: str) -> Maker:
    return lambda d: _by_scalars(name, MONOTONE, bits_for(d), _MONOTONE_BOXES)


def _forms(
    title: str,
    order: int,
    makers: dict[str, Maker],
    sizes: Sequence[float],
    budget: Budget,
    *,
    floor: float,
) -> list[Curve]:
    """Measure one form; the excess of order m goes with the number of boxes^-(m + 1)."""
    return sweep(
        {
            name: (
                Curve(
                    f"{_WORK}, {title}",
                    f"{NAMES[order]}, {name}",
                    "boxes",
                    floor=floor,
                    least=order + 0.8,
                ),
                make,
            )
            for name, make in makers.items()
        },
        sizes,
        budget,
    )

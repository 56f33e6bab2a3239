"""Work-precision of whole proofs: dimensions, periodic orbits, and the checks of certificates."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from pathlib import Path
from time import perf_counter

from proofs import orbits
from proofs.benchmark.curves import Budget, Curve, Point, Task, sweep
from proofs.benchmark.measuring import Row, in_turn, spread, timed
from proofs.methods.orbits import periodic_points
from proofs.methods.words import Words
from proofs.motion.horseshoe_map import ImpactMap
from proofs.search import s32_dimension as dimension
from proofs.trusted.certificate import SCHEMA, Malformed, read
from proofs.trusted.paper.s32_sets.repeller import Repeller
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, check

_PERIOD = 4
_DIGITS = 25
_MAIN = "horseshoe"  # the certificate of the main job


def dimensions(budget: Budget, digits: Sequence[float]) -> list[Curve]:
    """Measure the proof of both Hausdorff dimensions, to so many digits."""
    curve = Curve("both dimensions (H13)", "proofs.dimension", "digits", against="time")
    return sweep({"": (curve, _dimension)}, digits, budget)


def _dimension(digits: float) -> Task:
    def task() -> float:
        found = dimension.prove(PAPER, ["H13"], digits=int(digits)).proofs["H13"]
        sizes = [one.dimension for _, one in found if isinstance(one, Repeller)]
        return float(max(high - low for low, high in sizes))

    return task


@cache
def _horseshoe() -> ImpactMap:
    of = replace(
        PAPER,
        left=orbits.LEFT,
        right=orbits.RIGHT,
        interval=(orbits.LEFT[0], orbits.RIGHT[1]),
        slopes=(Fraction(1), Fraction(1)),
        ratios=None,
        printed_s0=None,
    )
    return orbits.horseshoe(of)


def _points(period: int, digits: int | None) -> Task:
    """Return the enclosure of all periodic points of a horseshoe that is proved before."""
    given, words = _horseshoe(), Words.of_length(period)

    def task() -> float:
        points = periodic_points(given, words, digits)
        return float(max(one.point[1] - one.point[0] for one in points))

    return task


def periodic(
    budget: Budget, periods: Sequence[int], digits: Sequence[float]
) -> tuple[list[Curve], list[Curve]]:
    """Measure all periodic points against the number of words, and against digits."""
    words = [float(2**n) for n in periods]
    title = "all periodic points of a period"

    def of_length(places: int | None, count: float) -> Task:
        return _points(int(count).bit_length() - 1, places)

    ways = {"binary64": None, f"{_DIGITS} digits": _DIGITS}
    found = sweep(
        {
            way: (Curve(title, way, "words", against="time"), partial(of_length, places))
            for way, places in ways.items()
        },
        words,
        budget,
    )
    against = Curve(f"{title}, {2**_PERIOD} words", "multiprecision", "digits", against="time")
    return found, sweep({"": (against, lambda d: _points(_PERIOD, int(d)))}, digits, budget)


def checks(budget: Budget, folder: Path, most: float) -> tuple[list[Curve], list[Row]]:
    """Measure the check of each certificate in a folder: of the main job, then the small ones.

    Ends when `most` seconds are spent; what is then not checked is reported so. Files of another
    kind than certificates are passed over.
    """
    curve = Curve("check", "certificates", "kB", against="", proved=False)
    rows, began = [], perf_counter()
    files = [path for path in folder.glob("*.json") if _says_certificate(path)]
    for path in sorted(files, key=lambda path: (path.stem != _MAIN, path.stat().st_size)):
        kilobytes, name = path.stat().st_size / 1000, f"check of {path.name}"
        if perf_counter() - began > most:
            rows.append(Row(name, f"{kilobytes:.0f} kB, not measured: --full does"))
            continue
        task = partial(_check, path)
        try:
            seconds = [timed(task)]
        except (Malformed, Rejected) as error:
            rows.append(Row(name, f"{kilobytes:.0f} kB, not accepted: {error}", "accepted", False))
            continue
        if seconds[0] <= budget.limit:
            (seconds,) = in_turn([partial(timed, task)], budget.rounds)
        samples = {"seconds": seconds, "bytes": path.stat().st_size}
        rows.append(Row(f"{name} [s]", f"{spread(seconds)}, {kilobytes:.0f} kB", samples=samples))
        curve.points.append(Point(kilobytes, None, seconds, path.stem))
    if not files:
        rows.append(Row("check of certificates", "no certificates there: see --reports"))
    return [curve], rows


def _says_certificate(path: Path) -> bool:
    """Whether a file says that it is a certificate, or is not even JSON."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return True
    return isinstance(found, dict) and found.get("schema") == SCHEMA


def _check(path: Path) -> None:
    check(read(path))

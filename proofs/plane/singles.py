"""Which single-impact orbits are stable? What rule `stable-singles` needs, for a box."""

from __future__ import annotations

import math
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from intervals import Undecided
from proofs.plane.steps import Steps
from proofs.trusted.certificate import texts
from proofs.trusted.equations import Clock, Launch, gap, launch_acceleration
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.paper.beyond.singles import Numbers, Part, launched, parts, ratios, solution
from proofs.trusted.parameters import Place

Floats = NDArray[np.float64]
_SHARES = np.array([1e-6, 0.25, 0.5, 0.75, 1 - 1e-6])  # of a part, where it is looked at
_TIMES = 24  # looked at in a table period
_CUTS = (1, 4, 16)
_EXACT = 1000  # denominators of times


def propose(box: Place, most: int) -> Steps:
    """Return a certificate that seems to say which n up to the most there is a stable orbit for."""
    stable, none = [], []
    for n in range(1, most + 1):
        seen = [_seen(part) for part in parts(box, n) if not _excluded(part, [])]
        alive = [each.alive for each in seen]
        if not seen or not any(each.any() for each in alive):
            none += _none(box, n, bool(seen))
        elif len(seen) == 1 and alive[0].all():
            stable.append(_stable(box, n))
        else:
            raise Undecided(f"stable at some of the oscillators, n = {n}")
    made = Steps(box)
    made.add("stable-singles", {"most": str(most), "stable": stable, "none": none})
    return made


class Seen(NamedTuple):
    """Some oscillators of a part: where there is a stable orbit, and gaps where none is excluded.

    gaps: a row for each oscillator at which the closed forms exclude nothing; `times` are those.
    """

    alive: NDArray[np.bool_]
    times: Floats
    gaps: Floats


def _seen(part: Part) -> Seen:
    low, high = map(float, part.at.eta)
    etas, nus = np.meshgrid(low + (high - low) * _SHARES, [float(nu) for nu in part.at.nu])
    eta, nu = etas.ravel(), nus.ravel()
    q = float(sum(ratios(part.at)) / 2)
    sine, cosine = np.sin(math.pi * part.n * eta), np.cos(math.pi * part.n * eta)
    turn = part.signed(sine, cosine)
    with np.errstate(all="ignore"):
        solved = solution(
            Numbers(eta, nu, q), turn, part.leans, lambda x: np.sqrt(np.maximum(x, 0))
        )
        start = launched(part, Numbers(eta, nu, q), turn, solved)
        left = (solved.delta > 0) & (solved.above / solved.below > 0) & (solved.flips < 0)
        if start.kick is None:
            left &= launch_acceleration(start) > 0
    times = math.tau * part.n * (np.arange(_TIMES * part.n - 1) + 1) / (_TIMES * part.n)
    numbers = [None if x is None else x[left][:, None] for x in start[1:]]
    own = Launch(start.side, *numbers)
    mass = own.eta * times
    gaps = gap(own, Clock(np.sin(mass), np.cos(mass), np.sin(times), np.cos(times)))
    alive = left.copy()
    alive[left] = (gaps > 0).all(axis=1)
    return Seen(alive, times, gaps)


def _excluded(part: Part, times: list[Fraction]) -> bool:
    try:
        return part.has_none(times)
    except Unproved:
        return False


def _none(box: Place, n: int, needed: bool) -> list[dict[str, Any]]:
    """Return what excludes stable orbits for an n, where closed forms on the whole do not."""
    if not needed:
        return []
    for cuts in _CUTS:
        times: list[Fraction] = []
        if all(_early(part, times) for part in parts(box, n, cuts)):
            return [{"n": str(n), "cuts": str(cuts), "times": texts(sorted(set(times)))}]
    raise Undecided(f"stable orbits are not excluded, n = {n}")


def _early(part: Part, times: list[Fraction]) -> bool:
    """Whether there is none; times: those at which the gap is < 0, to be tried and added to."""
    if _excluded(part, times):
        return True
    seen = _seen(part)
    if not len(seen.gaps):
        return False
    worst = seen.gaps.max(axis=0)
    best = Fraction(float(seen.times[int(worst.argmin())])).limit_denominator(_EXACT)
    times.append(best)
    return _excluded(part, [best])


def _stable(box: Place, n: int) -> dict[str, Any]:
    """Return what proves a stable orbit for an n."""
    for cuts in _CUTS[:2]:
        with suppress(Unproved):
            if all(part.has_one for part in parts(box, n, cuts)):
                return {"n": str(n), "cuts": str(cuts)}
    raise Undecided(f"orbits are not seen to be stable all over the box, n = {n}")

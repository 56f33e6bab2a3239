"""Where the map is at its worst: grazing launches, and the ends of the sticking arc."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import Any

from proofs.benchmark.peers import Arithmetic
from proofs.stress.truth import BITS, Launched, Motion, separation

# By eta and nu: phases, and times after them where gap = gap' = 0, before which gap > 0.
GRAZES = {
    ("0.2121", "-0.2"): "1.19998 25.874, 2.13648 5.152",
    ("0.9", "-0.3"): "2.04245 49.322, 2.30669 42.51, 2.60456 35.632, 2.94474 28.668, "
    "3.33137 21.612, 3.7621 14.467, 4.2276 7.253",
    ("1.7", "-0.9"): "0.01179 3.118, 1.4051 6.615, 1.47264 25.329, 1.83351 12.041, 2.40476 4.615",
    ("0.35", "-0.5"): "1.16952 13.369, 1.27043 32.017, 2.11154 5.202",
    ("1.4", "-2.3"): "0.38704 2.368, 0.51608 2.109",
}
_PLACES = [(*of, *each.split()) for of, some in GRAZES.items() for each in some.split(", ")]
_STEPS = 10


@cache
def graze(kernel: Arithmetic, number: int) -> tuple[Fraction, Fraction, Fraction]:
    """Return (eta, nu, phase) of one of the grazing launches, to 80 digits, by Newton's method."""
    eta, nu, *near = map(Fraction, _PLACES[number % len(_PLACES)])
    with kernel.precision(BITS):
        phase, time = map(kernel.point, near)
        for _ in range(_STEPS):
            motion = Motion(kernel, Launched(eta, nu, Fraction(0)), phase)
            gap, rate, bend = motion.gap(time, 2)
            phase = kernel.middle(phase - gap / motion.rates(time, 0)[0])
            time = kernel.middle(time - rate / bend)
        return eta, nu, _decimal(kernel, phase)


def separation_point(
    kernel: Arithmetic, eta: Fraction, nu: Fraction, *, beginning: bool = False
) -> Fraction:
    """Return the phase where a sticking mass leaves, or where sticking begins, to 80 digits."""
    with kernel.precision(BITS):
        phase = separation(kernel, eta, nu)
        if beginning:
            phase = kernel.pi() - phase
        return _decimal(kernel, phase if kernel.ends(phase)[0] >= 0 else phase + 2 * kernel.pi())


def _decimal(kernel: Arithmetic, x: Any) -> Fraction:
    return Fraction(round(kernel.ends(x)[0] * 10**80), 10**80)

"""Which bifurcation it is: one classifier, for closed forms and for enclosures.

A candidate is a fixed point with the multiplier 1 or -1, or with two multipliers of product 1. What
happens there is decided by signs of numbers: first of the other multipliers, then the coefficients
of the normal form, then how a parameter unfolds it. Where a number depends on parameters that are
left, that it is not 0 is a condition, and is told.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

CONDITIONS = {"fold": "1", "flip": "-1", "neimark_sacker": "e^(i t), e^(-i t)"}
Sign = Callable[[str], int | None]  # of a number, by its name; None: it depends on parameters


class Class(NamedTuple):
    """What a candidate is: a bifurcation, resonance 1:k, degenerate or none; and why.

    where: what is to be true of the parameters that are left.
    """

    kind: str
    why: str = ""
    where: tuple[str, ...] = ()

    @property
    def dropped(self) -> bool:
        """Whether nothing bifurcates there, or nothing that is known here."""
        return self.kind in ("degenerate", "none", "undecided")


class _Decided(Exception):
    """A test that ends the classification."""

    def __init__(self, kind: str, why: str = "") -> None:
        self.what = Class(kind, why)


@dataclass
class Tests:
    """The signs that are asked for, and what is open."""

    sign: Sign
    where: list[str]

    def nonzero(self, name: str, kind: str, why: str) -> int | None:
        """Require that a number is not 0: if it is, the candidate is of another kind."""
        sign = self.sign(name)
        if sign == 0:
            raise _Decided(kind, why)
        if sign is None:
            self.where.append(f"{name} is not 0")
        return sign

    def positive(self, name: str, otherwise: Class) -> None:
        """Require that a number is positive."""
        sign = self.sign(name)
        if sign is None:
            self.where.append(f"{name} > 0")
        elif sign <= 0:
            raise _Decided(otherwise.kind, otherwise.why)


def classified(condition: str, plane: bool, sign: Sign) -> Class:
    """Return what a candidate of a condition (fold, flip or neimark_sacker) is.

    Names whose signs are asked for: trace, determinant and sums with them such as "determinant - 1"
    of the Jacobian; critical and speed of the normal form; "cubic", "crossing" and "mixed" of a
    fixed point with the multiplier 1 that is not unfolded, see `unfolding`.

    Theorem (Kuznetsov, Elements of Applied Bifurcation Theory, chapter 4; Wiggins, chapter 3, for
    the transcritical and the pitchfork bifurcation). With all other multipliers off the unit
    circle: multiplier 1, critical and speed not 0: fold; critical not 0, speed 0, crossing > 0:
    transcritical; critical and speed 0, cubic and mixed not 0: pitchfork. Multiplier -1, critical
    and speed not 0: flip. Two complex multipliers of product 1, no third or fourth roots of 1,
    critical and speed not 0: Neimark-Sacker.
    """
    tests = Tests(sign, [])
    try:
        circle = condition == "neimark_sacker"
        kind = _circle(tests) if circle else _line(tests, condition, plane)
    except _Decided as end:
        return end.what._replace(where=tuple(tests.where))
    return Class(kind, where=tuple(tests.where))


def _circle(tests: Tests) -> str:
    for name, k in (("trace - 2", 1), ("trace + 2", 2), ("trace + 1", 3), ("trace", 4)):
        if tests.sign(name) == 0:
            raise _Decided(f"resonance 1:{k}", f"a multiplier is a root of 1 of order {k}")
    real = "the multipliers are real, of product 1: a saddle, on whose sides nothing changes"
    tests.positive("4 - trace^2", Class("none", real))
    for name in ("trace + 1", "trace"):
        tests.nonzero(name, "resonance", "")
    tests.nonzero("critical", "degenerate", "critical = 0")
    tests.nonzero("speed", "degenerate", "speed = 0: the parameter does not move the multipliers")
    return "neimark_sacker"


def _line(tests: Tests, condition: str, plane: bool) -> str:
    if plane:
        mixed = "the multipliers are 1 and -1"
        tests.nonzero("determinant + 1", "degenerate", mixed)
        order = 1 if condition == "fold" else 2
        why = f"both multipliers are {CONDITIONS[condition]}"
        tests.nonzero("determinant - 1", f"resonance 1:{order}", why)
    if condition == "flip":
        tests.nonzero("critical", "degenerate", "critical = 0")
        tests.nonzero(
            "speed", "degenerate", "speed = 0: the parameter does not move the multiplier"
        )
        return "flip"
    return _at_one(tests)


def _at_one(tests: Tests) -> str:
    """Tell a fold from what has speed 0 (the parameter does not move the fixed points apart)."""
    critical, speed = tests.sign("critical"), tests.sign("speed")
    if speed != 0:
        cusp = "critical = 0: the fixed point goes on, or a cusp"
        tests.nonzero("critical", "degenerate", cusp)
        tests.nonzero("speed", "degenerate", "")
        return "fold"
    if critical == 0:
        tests.nonzero("cubic", "degenerate", "critical, speed and the cubic coefficient are 0")
        tests.nonzero("mixed", "degenerate", "critical = speed = 0, and the multiplier rests at 1")
        return "pitchfork"
    tests.nonzero("critical", "degenerate", "")
    isolated = "speed = 0, and no curves of fixed points cross: they meet in one point, or touch"
    tests.positive("crossing", Class("degenerate", isolated))
    return "transcritical"


# -- what the signs mean ---------------------------------------------------------------------------


def meaning(kind: str, parameter: str, plane: bool, sign: Sign) -> Iterator[tuple[str, str]]:
    """Yield the numbers that decide, each with its normal form and what its sign means."""
    manifold = " on the centre manifold" if plane else ""
    size, rate = (sign(name) if kind in MEANT else None for name in ("critical", "speed"))
    if kind == "fold":
        yield "critical", f"h goes to h + speed ({parameter} - ...) + critical h^2 + ...{manifold}"
        yield "speed", f"two fixed points {_side(parameter, size, rate)}, none on the other side"
    elif kind == "flip":
        second = f"the second iterate is h - 2 critical h^3 + ...{manifold}: "
        yield "critical", second + _stable(size, 1, f"cycle of period two{manifold}")
        says = f"the multiplier is -1 + speed ({parameter} - ...) + ...: the cycle is there "
        yield "speed", says + _side(parameter, size, rate)
    elif kind == "neimark_sacker":
        says = "the square of the radius changes with the sign of critical: "
        yield "critical", says + _stable(size, -1, "circle")
        says = f"the product of the multipliers is 1 + speed ({parameter} - ...) + ...: the circle "
        yield "speed", f"{says}is there {_side(parameter, size, rate)}"
    elif kind == "transcritical":
        yield "critical", f"h goes to h + critical h^2 + ...{manifold}: two fixed points cross"
        yield "crossing", "the discriminant of the two directions in which they cross, > 0"
    elif kind == "pitchfork":
        yield "cubic", f"h goes to h + cubic h^3 + ...{manifold}: three fixed points on one side"
        yield "mixed", f"how fast {parameter} moves the multiplier of the one that goes on"


MEANT = ("fold", "flip", "neimark_sacker")  # of which critical and speed are told


def _stable(size: int | None, stable: int, what: str) -> str:
    if size is None:
        return f"a stable {what} where it is {'> 0' if stable > 0 else '< 0'}, else unstable"
    return f"a stable {what}" if size == stable else f"an unstable {what}"


def _side(parameter: str, size: int | None, rate: int | None) -> str:
    """Return on which side of the bifurcation speed (parameter - ...) / critical < 0."""
    if size is None or rate is None:
        return f"where speed ({parameter} - ...)/critical < 0"
    return f"for {'smaller' if size * rate > 0 else 'greater'} {parameter}"

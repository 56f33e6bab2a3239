"""Other people's numbers, for the truth: Arb balls, or mpmath's numbers without bounds.

Nothing here is evidence for a claim. python-flint is imported where it is used.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

Range = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Kernel:
    """Numbers with + - * / and what else is asked of them.

    digits: a context in which numbers have so many bits. number: from a rational. plain: an
    elementary function by name. bounds: rationals that a number lies between, ArithmeticError if
    it is not finite. middle: a number without radius in it. between: one around two rationals.
    """

    name: str
    digits: Callable[[int], AbstractContextManager[Any]]
    number: Callable[[Fraction | int], Any]
    plain: Callable[[str, Any], Any]
    pi: Callable[[], Any]
    bounds: Callable[[Any], Range]
    middle: Callable[[Any], Any]
    between: Callable[[Fraction, Fraction], Any]

    def call(self, function: str, x: Any) -> Any:
        """Return a function of a number, also where a kernel lacks it or has another domain."""
        if function == "cbrt":
            low, high = self.bounds(x)
            if low <= 0 <= high:
                return x
            third = self.plain("exp", self.plain("log", x if low > 0 else -x) / 3)
            return third if low > 0 else -third
        if function in ("exp2", "exp10"):
            return self.plain("exp", x * self.plain("log", self.number(int(function[3:]))))
        if function in ("log2", "log10"):
            return self.plain("log", x) / self.plain("log", self.number(int(function[3:])))
        return self.plain(function, x)


def arb() -> Kernel:
    """Return python-flint: balls, so that what is between the bounds is proved."""
    import flint

    def number(value: Fraction | int) -> Any:
        return flint.arb(flint.fmpq(value.numerator, value.denominator))

    def bounds(x: Any) -> Range:
        if not x.is_finite():
            raise ArithmeticError("the truth is not known: no finite ball")
        low, high = (_dyadic(*end.man_exp()) for end in (x.lower(), x.upper()))
        return low, high

    return Kernel(
        "python-flint (Arb)",
        digits=flint.ctx.workprec,
        number=number,
        plain=lambda function, x: getattr(x, function)(),
        pi=flint.arb.pi,
        bounds=bounds,
        middle=lambda x: x.mid(),
        between=lambda low, high: number(low).union(number(high)),
    )


def mpmath() -> Kernel:
    """Return mpmath: candidates, a quarter of whose bits are believed, and never a proof."""
    from mpmath import mp

    context = mp.clone()

    def number(value: Fraction | int) -> Any:
        return context.mpf(value.numerator) / value.denominator

    def bounds(x: Any) -> Range:
        if not context.isfinite(x):
            raise ArithmeticError("the truth is not known: not a finite number")
        sign, mantissa, exponent, _ = x._mpf_
        middle = _dyadic(-mantissa if sign else mantissa, exponent)
        spread = abs(middle) / 2 ** (context.prec // 4)  # 90 digits at 1200 bits
        return middle - spread, middle + spread

    return Kernel(
        "mpmath (candidates)",
        digits=context.workprec,
        number=number,
        plain=lambda function, x: getattr(context, function)(x),
        pi=lambda: +context.pi,
        bounds=bounds,
        middle=lambda x: x,
        between=lambda low, high: number((low + high) / 2),
    )


def _dyadic(mantissa: Any, exponent: Any) -> Fraction:
    return int(mantissa) * Fraction(2) ** int(exponent)


def kernel(name: str | None = None) -> Kernel:
    """Return the kernel named, "flint" or "mpmath"; by default Arb where it is installed."""
    if name == "mpmath":
        return mpmath()
    try:
        return arb()
    except ImportError:
        if name == "flint":
            raise
        return mpmath()

"""Other people's numbers, for the truth: Arb balls, or mpmath's numbers without bounds.

Nothing here is evidence for a claim. Arb and mpmath's own functions are imported where used.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from fractions import Fraction
from typing import Any, Protocol

from proofs.trusted.numbers import Range


class Kernel(Protocol):
    """Numbers with + - * / and, by name, elementary functions."""

    name: str
    proves: bool

    def digits(self, bits: int) -> AbstractContextManager[Any]:
        """Return a context in which numbers have `bits` bits."""

    def number(self, value: Fraction | int) -> Any:
        """Return (a ball around) a rational."""

    def call(self, function: str, x: Any) -> Any:
        """Return a function of a number."""

    def pi(self) -> Any:
        """Return pi."""

    def bounds(self, x: Any) -> Range:
        """Return rationals that x lies between; for mpmath x itself, give or take rounding."""

    def middle(self, x: Any) -> Any:
        """Return a number without radius in x."""

    def between(self, low: Fraction, high: Fraction) -> Any:
        """Return a ball around [low, high]; its middle where numbers have no radius."""


class Arb:
    """python-flint: balls, so that what is between the bounds is proved."""

    name, proves = "python-flint (Arb)", True

    def __init__(self) -> None:
        import flint

        self._flint = flint

    def digits(self, bits: int) -> AbstractContextManager[Any]:
        """Return Arb's precision context."""
        context: AbstractContextManager[Any] = self._flint.ctx.workprec(bits)
        return context

    def number(self, value: Fraction | int) -> Any:
        """Return a ball around a rational."""
        value = Fraction(value)
        return self._flint.arb(self._flint.fmpq(value.numerator, value.denominator))

    def call(self, function: str, x: Any) -> Any:
        """Return a function of a ball."""
        named = _composed(function, self)
        return named(x) if named else getattr(x, function)()

    def pi(self) -> Any:
        """Return a ball around pi."""
        return self._flint.arb.pi()

    def bounds(self, x: Any) -> Range:
        """Return the ends of a ball; ArithmeticError where it is the whole line."""
        if not x.is_finite():
            raise ArithmeticError("the truth is not known: no finite ball")
        low, high = (end.man_exp() for end in (x.lower(), x.upper()))
        return _dyadic(*low), _dyadic(*high)

    def middle(self, x: Any) -> Any:
        """Return the centre of a ball."""
        return x.mid()

    def between(self, low: Fraction, high: Fraction) -> Any:
        """Return the smallest ball around both."""
        return self.number(low).union(self.number(high))


class Mpmath:
    """mpmath: candidates, believed to all but a few of their bits and never a proof."""

    name, proves = "mpmath (candidates)", False

    def __init__(self) -> None:
        import mpmath

        self._context = mpmath.mp.clone()

    def digits(self, bits: int) -> AbstractContextManager[Any]:
        """Return mpmath's precision context."""
        context: AbstractContextManager[Any] = self._context.workprec(bits)
        return context

    def number(self, value: Fraction | int) -> Any:
        """Return the nearest number."""
        value = Fraction(value)
        return self._context.mpf(value.numerator) / value.denominator

    def call(self, function: str, x: Any) -> Any:
        """Return a function of a number."""
        named = _composed(function, self)
        return named(x) if named else getattr(self._context, function)(x)

    def pi(self) -> Any:
        """Return pi."""
        return +self._context.pi

    def bounds(self, x: Any) -> Range:
        """Return x, a quarter of its bits believed: 90 digits at 1200 bits."""
        if not self._context.isfinite(x):
            raise ArithmeticError("the truth is not known: not a finite number")
        sign, mantissa, exponent, _ = x._mpf_
        middle = _dyadic(-mantissa if sign else mantissa, exponent)
        spread = abs(middle) / 2 ** (self._context.prec // 4)
        return middle - spread, middle + spread

    def middle(self, x: Any) -> Any:
        """Return x."""
        return x

    def between(self, low: Fraction, high: Fraction) -> Any:
        """Return the middle."""
        return self.number((low + high) / 2)


def _dyadic(mantissa: Any, exponent: Any) -> Fraction:
    return int(mantissa) * Fraction(2) ** int(exponent)


def _composed(function: str, kernel: Kernel) -> Callable[[Any], Any] | None:
    """Return what a kernel has under no such name, or not on the same domain."""
    if function == "cbrt":

        def root(x: Any) -> Any:
            low, high = kernel.bounds(x)
            if low <= 0 <= high:
                return x
            third = kernel.call("exp", kernel.call("log", x if low > 0 else -x) / 3)
            return third if low > 0 else -third

        return root
    if function in ("exp2", "exp10"):
        base = kernel.number(int(function[3:]))
        return lambda x: kernel.call("exp", x * kernel.call("log", base))
    if function in ("log2", "log10"):
        base = kernel.number(int(function[3:]))
        return lambda x: kernel.call("log", x) / kernel.call("log", base)
    return None


def kernel(name: str | None = None) -> Kernel:
    """Return the kernel named, "flint" or "mpmath"; by default Arb where it is installed."""
    if name == "mpmath":
        return Mpmath()
    try:
        return Arb()
    except ImportError:
        if name == "flint":
            raise
        return Mpmath()

"""One number type after the other under one interface, so that all do literally the same work.

Nothing here is evidence for a claim. The equations are those of the package. Peers are imported
where they are used: they may be absent. codac changes the rounding mode of its process, and has
one of its own (`codac_slopes`).
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, Protocol

from intervals import Interval, Jet
from intervals import exp as exp_of
from intervals import log as log_of
from proofs.trusted.equations import sincos
from proofs.trusted.numbers import Range

End = Fraction | float | int


class Arithmetic(Protocol):
    """Intervals of some library at some precision."""

    bits: int

    def number(self, low: End, high: End) -> Any:
        """Enclose [low, high]."""

    def ends(self, x: Any) -> Range:
        """Return the exact ends."""

    def middle(self, x: Any) -> Any:
        """Return a point of x, about its middle."""

    def hull(self, x: Any, y: Any) -> Any:
        """Enclose both."""

    def positive(self, x: Any) -> bool:
        """Whether x > 0 is certain."""

    def jet(self, coefficients: list[Any]) -> Any:
        """Return a truncated Taylor series."""

    def coefficient(self, series: Any, k: int) -> Any:
        """Return its k-th coefficient."""

    def exp(self, x: Any) -> Any:
        """Return the exponential."""

    def log(self, x: Any) -> Any:
        """Return the logarithm."""


class Jets:
    """Series by our jets, which take any number type."""

    def jet(self, coefficients: list[Any]) -> Any:
        """Return a jet."""
        return Jet(*coefficients)

    def coefficient(self, series: Any, k: int) -> Any:
        """Return its k-th coefficient."""
        return series.coefficients[k]


class Ours(Jets):
    """`Interval`."""

    def __init__(self, bits: int) -> None:
        self.bits = bits

    def number(self, low: End, high: End) -> Interval:
        """Enclose [low, high]."""
        return Interval(Fraction(low), Fraction(high), precision=self.bits)

    def ends(self, x: Interval) -> Range:
        """Return the exact ends."""
        return x.inf, x.sup

    def middle(self, x: Interval) -> Interval:
        """Return the middle."""
        return Interval(x.mid, precision=self.bits)

    def hull(self, x: Interval, y: Interval) -> Interval:
        """Enclose both."""
        return x.hull(y)

    def positive(self, x: Interval) -> bool:
        """Whether x > 0 is certain."""
        return x.certainly_positive()

    def exp(self, x: Interval) -> Interval:
        """Return the exponential."""
        found: Interval = exp_of(x)
        return found

    def log(self, x: Interval) -> Interval:
        """Return the logarithm."""
        found: Interval = log_of(x)
        return found


class Flint:
    """python-flint's arb and arb_series; the precision must be set by `flint.ctx.workprec`."""

    def __init__(self, bits: int) -> None:
        import flint

        self.bits, self._arb, self._series = bits, flint.arb, flint.arb_series
        for kind in (flint.arb, flint.arb_series):
            sincos.register(kind, kind.sin_cos)

    def number(self, low: End, high: End) -> Any:
        """Enclose [low, high]."""
        one = self._exact(low)
        return one if low == high else one.union(self._exact(high))

    def _exact(self, x: End) -> Any:
        if isinstance(x, float):
            return self._arb(x)
        return self._arb(x.numerator) / x.denominator

    def ends(self, x: Any) -> Range:
        """Return the exact ends."""
        (m, e), (n, f) = (end.man_exp() for end in (x.lower(), x.upper()))
        return int(m) * Fraction(2) ** int(e), int(n) * Fraction(2) ** int(f)

    def middle(self, x: Any) -> Any:
        """Return the middle."""
        return x.mid()

    def hull(self, x: Any, y: Any) -> Any:
        """Enclose both."""
        return x.union(y)

    def positive(self, x: Any) -> bool:
        """Whether x > 0 is certain."""
        return bool(x > 0)

    def jet(self, coefficients: list[Any]) -> Any:
        """Return a power series."""
        return self._series(coefficients, len(coefficients))

    def coefficient(self, series: Any, k: int) -> Any:
        """Return its k-th coefficient."""
        return series[k]

    def exp(self, x: Any) -> Any:
        """Return the exponential."""
        return x.exp()

    def log(self, x: Any) -> Any:
        """Return the logarithm."""
        return x.log()


class Iv(Jets):
    """mpmath.iv: not proved sound (its exp can exclude the true value), measured all the same."""

    def __init__(self, bits: int) -> None:
        from mpmath.ctx_iv import MPIntervalContext

        self.bits, self._context = bits, MPIntervalContext()
        self._context.prec = bits
        self._context.mpf.sincos = lambda x: (self._context.sin(x), self._context.cos(x))
        for name in ("__add__", "__sub__", "__mul__", "__truediv__"):
            setattr(self._context.mpf, name, _yielding(getattr(self._context.mpf, name)))

    def number(self, low: End, high: End) -> Any:
        """Enclose [low, high]."""
        ends = [Fraction(end) for end in (low, high)]
        one, other = (self._context.mpf(x.numerator) / x.denominator for x in ends)
        return self.hull(one, other)

    def ends(self, x: Any) -> Range:
        """Return the exact ends."""
        (s, m, e, _), (t, n, f, _) = x._mpi_
        low, high = int(m) * Fraction(2) ** int(e), int(n) * Fraction(2) ** int(f)
        return -low if s else low, -high if t else high

    def middle(self, x: Any) -> Any:
        """Return the middle."""
        return x.mid

    def hull(self, x: Any, y: Any) -> Any:
        """Enclose both."""
        return self._context.mpf([min(x.a, y.a).a, max(x.b, y.b).b])

    def positive(self, x: Any) -> bool:
        """Whether x > 0 is certain."""
        return (x > 0) is True

    def exp(self, x: Any) -> Any:
        """Return the exponential."""
        return self._context.exp(x)

    def log(self, x: Any) -> Any:
        """Return the logarithm."""
        return self._context.log(x)


def _yielding(operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """Let a jet on the right do the operation, where mpmath raises NotImplementedError."""
    return lambda x, y: NotImplemented if isinstance(y, Jet) else operation(x, y)

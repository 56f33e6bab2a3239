"""The numbers of each library under one interface, so that all do literally the same work.

Nothing here is evidence for a claim. Peers are imported where they are used: they may be absent.
"""

from __future__ import annotations

import importlib.util
import operator
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any

from intervals import Interval, Jet
from proofs.trusted.equations import registered_sincos

OURS, FLINT, IV = "Interval", "python-flint", "mpmath.iv"
PEERS = (FLINT, IV)
Range = tuple[Fraction, Fraction]
End = Fraction | float | int


@dataclass(frozen=True)
class Arithmetic:
    """Numbers of some library with + - * / and `sincos`, of `bits` bits.

    number: one that encloses two ends. ends: its exact ends, ArithmeticError if it is not finite.
    middle: a point of it. positive: whether it is > 0 for certain. call: an elementary function by
    name. series, coefficient: to and from a truncated Taylor series. precision: a context of so
    many bits, which some libraries need.
    """

    name: str
    bits: int
    number: Callable[[End, End], Any]
    ends: Callable[[Any], Range]
    middle: Callable[[Any], Any]
    positive: Callable[[Any], bool]
    call: Callable[[str, Any], Any]
    series: Callable[[list[Any]], Any] = lambda coefficients: Jet(*coefficients)
    coefficient: Callable[[Any, int], Any] = lambda series, k: series.coefficients[k]
    precision: Callable[[int], AbstractContextManager[object]] = nullcontext
    greater: Callable[[Any, Any], bool] | None = None  # where that is faster than a difference

    def point(self, x: End) -> Any:
        """Enclose one number."""
        return self.number(x, x)

    def pi(self) -> Any:
        """Enclose pi."""
        return 4 * self.call("atan", self.point(1))


@cache
def arithmetic(library: str, bits: int) -> Arithmetic:
    """Return the numbers of a library; ImportError if it is absent."""
    return {OURS: _ours, FLINT: _flint, IV: _iv}[library](bits)


def installed(module: str) -> bool:
    """Whether a module can be imported."""
    return importlib.util.find_spec(module) is not None


def libraries() -> list[str]:
    """Return those that are here and prove what they say in any precision, ours first."""
    return [OURS, FLINT, IV] if installed("flint") else [OURS, IV]


def _ours(bits: int) -> Arithmetic:
    return Arithmetic(
        OURS,
        bits,
        number=lambda low, high: Interval(Fraction(low), Fraction(high), precision=bits),
        ends=lambda x: (x.inf, x.sup),
        middle=lambda x: Interval(x.mid, precision=bits),
        positive=Interval.certainly_positive,
        call=lambda function, x: getattr(x, function)(),
    )


def _flint(bits: int) -> Arithmetic:
    import flint

    arb, series = flint.arb, flint.arb_series
    for kind in (arb, series):
        registered_sincos.register(kind, kind.sin_cos)

    def exact(x: End) -> Any:
        return arb(x) if isinstance(x, float) else arb(flint.fmpq(x.numerator, x.denominator))

    def ends(x: Any) -> Range:
        if not x.is_finite():
            raise ArithmeticError("no finite ball")
        low, high = (_dyadic(*end.man_exp()) for end in (x.lower(), x.upper()))
        return low, high

    return Arithmetic(
        FLINT,
        bits,
        number=lambda low, high: exact(low) if low == high else exact(low).union(exact(high)),
        ends=ends,
        middle=lambda x: x.mid(),
        positive=arb(0).__lt__,  # 0 < x
        call=lambda function, x: getattr(x, function)(),
        series=lambda coefficients: series(coefficients, len(coefficients)),
        coefficient=lambda taylor, k: taylor[k],
        precision=flint.ctx.workprec,
        greater=operator.gt,
    )


def _iv(bits: int) -> Arithmetic:
    """Return mpmath.iv: not proved sound (its exp can exclude the truth), measured all the same."""
    from mpmath.ctx_iv import MPIntervalContext

    context = MPIntervalContext()  # of its own: mpmath.iv itself keeps its precision
    context.prec = bits
    context.mpf.sincos = lambda x: (context.sin(x), context.cos(x))
    for name in ("__add__", "__sub__", "__mul__", "__truediv__"):
        setattr(context.mpf, name, _yielding(getattr(context.mpf, name)))

    def exact(x: Fraction) -> Any:
        return context.mpf(x.numerator) / x.denominator

    return Arithmetic(
        IV,
        bits,
        number=lambda x, y: context.mpf([exact(Fraction(x)).a, exact(Fraction(y)).b]),
        ends=lambda x: (_signed(*x._mpi_[0]), _signed(*x._mpi_[1])),
        middle=lambda x: x.mid,
        positive=lambda x: (x > 0) is True,
        call=lambda function, x: getattr(context, function)(x),
    )


def _yielding(operation: Callable[[Any, Any], Any]) -> Callable[[Any, Any], Any]:
    """Let a jet on the right do the operation, where mpmath raises NotImplementedError."""
    return lambda x, y: NotImplemented if isinstance(y, Jet) else operation(x, y)


def _dyadic(mantissa: Any, exponent: Any) -> Fraction:
    return int(mantissa) * Fraction(2) ** int(exponent)


def _signed(sign: int, mantissa: Any, exponent: Any, _: int) -> Fraction:
    return _dyadic(-mantissa if sign else mantissa, exponent)

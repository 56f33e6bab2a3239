"""Decorated: sets of reals with what is known of the functions that they went through (IEEE 1788).

A set is empty, or closed and connected, perhaps unbounded. f(X) holds f(x) for those x of X that
are in the domain of f, so nothing raises DomainError; the decoration says what was seen. It is the
least of the arguments' and f's own on X, which is the first that holds of

    com  f is defined and continuous at each point of X; X and the result are bounded, X not empty;
    dac  f is defined on X, which is not empty, and the restriction of f to X is continuous;
    def  f is defined on X, which is not empty;
    trv  nothing is known; ill is for what is no interval, NaI.

The ends are the tightest, as Interval's, but for `pow` and `atan2` of what is unbounded or leaves
their domain, and for the last bits of `hypot` and x^-n. `hull` and `intersection` are trv, as they
are no functions of points.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from math import inf
from operator import methodcaller
from typing import Any

from intervals import decorations as of
from intervals.decorations import COM, DAC, EMPTY, ILL, TRV, Decoration, End, Image, infinite
from intervals.exact import Exact, decimal_down, decimal_up, fraction, refuse_equality
from intervals.functions import REALS, TABLE, Elementary
from intervals.interval import Interval


def _operation(image: Callable[..., Image]) -> Callable[..., Decorated]:
    """Return the method for f, given its image for sets that are not empty."""

    def method(*arguments: Any) -> Decorated:
        p = max(x.precision for x in arguments if isinstance(x, Decorated | Interval))
        operands = [_lifted(x, p) for x in arguments]
        empty = any(x.inf > x.sup for x in operands)
        low, high, known = EMPTY if empty else image(*operands)
        if infinite(low, high):
            known = min(known, DAC)
        return _make(low, high, min(known, *(x.decoration for x in operands)), p)

    return method


class Decorated(Elementary):
    """Decorated(X) is X with the best decoration, Decorated(None) the empty set.

    X is an Interval, or what makes one, or a text: "[1, inf]", "[entire]", "[empty]", "[nai]",
    "[0.1, 0.2]_dac". With a second argument X has that decoration, or the best that it can have.
    """

    __slots__ = ("decoration", "inf", "precision", "sup")
    inf: End  # oo for the empty set and NaI
    sup: End  # -oo for these
    decoration: Decoration

    def __init__(
        self,
        value: Interval | Exact | None,
        decoration: Decoration = COM,
        *,
        precision: int | None = None,
    ) -> None:
        low, high, known = EMPTY
        if isinstance(value, str) and (parts := re.fullmatch(r"\[(.*)\](?:_(\w+))?", value)):
            low, high, known = _read(parts[1].strip().lower(), parts[2])
        elif value is not None:
            x = value if isinstance(value, Interval) else Interval(value, precision=precision or 53)
            low, high, known, precision = x.inf, x.sup, COM, precision or x.precision
        self._set(low, high, min(known, decoration), precision or 53)

    def _set(self, low: End, high: End, decoration: Decoration, precision: int) -> None:
        """Round outward; the empty set is trv."""
        if low > high or decoration is ILL:
            low, high, decoration = inf, -inf, min(decoration, TRV)
        self.inf = low if infinite(low) else Interval(Fraction(low), precision=precision).inf
        self.sup = high if infinite(high) else Interval(Fraction(high), precision=precision).sup
        self.decoration = decoration
        self.precision = precision

    @property
    def interval(self) -> Interval | None:
        """The set alone, None for the empty one; NaI raises ValueError, oo OverflowError."""
        if self.decoration is ILL:
            raise ValueError("not an interval")
        if self.inf > self.sup:
            return None
        if infinite(self.inf, self.sup):
            raise OverflowError(f"not bounded: {self}")
        return Interval(Fraction(self.inf), Fraction(self.sup), precision=self.precision)

    def __eq__(self, other: object) -> bool:
        """Return whether set and decoration are the same; with a number it raises TypeError."""
        if not isinstance(other, Decorated):
            refuse_equality(other)
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __bool__(self) -> bool:
        raise TypeError("the truth of a set is not defined: compare it with something")

    def _key(self) -> Image:
        return self.inf, self.sup, self.decoration

    def _sets(self, other: Any, low: Callable[..., End], high: Callable[..., End]) -> Decorated:
        y = _lifted(other, self.precision)
        known = min(TRV, self.decoration, y.decoration)
        ends = low(self.inf, y.inf), high(self.sup, y.sup)
        return _make(*ends, known, max(self.precision, y.precision))

    def hull(self, other: Any) -> Decorated:
        """Return the smallest connected set that holds both."""
        return self._sets(other, min, max)

    def intersection(self, other: Any) -> Decorated:
        """Return the common part."""
        return self._sets(other, max, min)

    # -- functions: what they return is said in Elementary ---------------------------------------

    def _monotone(self, name: str) -> Decorated:
        return _operation(partial(of.named, name))(self)

    def __pos__(self) -> Decorated:
        return self

    __neg__ = _operation(lambda x: (-x.sup, -x.inf, COM))
    __abs__ = _operation(of.size)
    __add__ = __radd__ = _operation(
        lambda x, y: (of.total(x.inf, y.inf), of.total(x.sup, y.sup), COM)
    )
    __sub__ = _operation(lambda x, y: (of.total(x.inf, -y.sup), of.total(x.sup, -y.inf), COM))
    __mul__ = __rmul__ = _operation(lambda x, y: (*of.products(x, y.inf, y.sup), COM))
    __truediv__ = _operation(of.quotient)
    fma = _operation(of.fma)
    sin = _operation(partial(of.circular, "sin"))
    cos = _operation(partial(of.circular, "cos"))
    tan = _operation(partial(of.circular, "tan"))
    minimum = _operation(lambda x, y: (min(x.inf, y.inf), min(x.sup, y.sup), COM))
    maximum = _operation(lambda x, y: (max(x.inf, y.inf), max(x.sup, y.sup), COM))
    pow = _operation(of.power)
    atan2 = _operation(of.angle)

    def __rsub__(self, other: Any) -> Decorated:
        return _lifted(other, self.precision) - self

    def __rtruediv__(self, other: Any) -> Decorated:
        return _lifted(other, self.precision) / self

    def __rpow__(self, base: Any) -> Decorated:
        return _lifted(base, self.precision).pow(self)

    def __pow__(self, exponent: Any) -> Decorated:
        """Return x^n, for an int n on all reals, but 0 if n < 0; else see `pow`."""
        if not isinstance(exponent, int):
            return self.pow(exponent)
        if exponent <= 0:
            return _lifted(1, self.precision) / self**-exponent if exponent else self * 0 + 1
        x = self if exponent % 2 else abs(self)
        return _operation(partial(of.monotone, methodcaller("__pow__", exponent)))(x)

    def sqr(self) -> Decorated:
        """Return the square."""
        return self**2

    def recip(self) -> Decorated:
        """Return 1 / x."""
        return _lifted(1, self.precision) / self

    def rootn(self, n: int) -> Decorated:
        """Return the real n-th root, n >= 1, for even n of x >= 0."""
        domain = REALS if n % 2 else TABLE["sqrt"].domain
        return _operation(lambda x: of.monotone(methodcaller("rootn", n), x, domain))(self)

    def hypot(self, other: Any) -> Decorated:
        """Return sqrt(x^2 + y^2)."""
        return (self.sqr() + _lifted(other, self.precision).sqr()).sqrt()

    # -- text ------------------------------------------------------------------------------------

    def __str__(self) -> str:
        """Return decimals that enclose, with the decoration, as the constructor reads it."""
        if self.inf > self.sup:
            return "[nai]" if self.decoration is ILL else "[empty]_trv"
        digits = max(3, self.precision * 3 // 10)
        low, high = (
            str(end) if infinite(end) else rounded(Fraction(end), digits)
            for end, rounded in ((self.inf, decimal_down), (self.sup, decimal_up))
        )
        return f"[{low}, {high}]_{self.decoration.name.lower()}"

    def __repr__(self) -> str:
        ends = f"[{self.inf}, {self.sup}]_{self.decoration.name.lower()}"
        text = str(self) if self.inf > self.sup else ends
        return f"Decorated({text!r}, precision={self.precision})"


def _lifted(value: Any, precision: int) -> Decorated:
    if isinstance(value, Decorated):
        return value
    return Decorated(value, precision=None if isinstance(value, Interval) else precision)


def _make(low: End, high: End, decoration: Decoration, precision: int) -> Decorated:
    new = object.__new__(Decorated)
    new._set(low, high, decoration, precision)
    return new


def _read(ends: str, name: str | None) -> Image:
    """Return what "1, 2", "entire" and so on say with a decoration; ValueError for nonsense."""
    if ends == "nai" and not name:
        return inf, -inf, ILL
    low, high, best = EMPTY
    if ends not in ("", "empty"):
        first, comma, last = ("," if ends == "entire" else ends).partition(",")
        low, high = _end(first, "-inf"), _end(last if comma else first, "inf")
        best = DAC if infinite(low, high) else COM
        if not low <= high or low == inf or high == -inf:
            raise ValueError(f"not an interval: [{ends}]")
    known = Decoration.__members__.get(name.upper(), ILL) if name else best
    if not ILL < known <= best:
        raise ValueError(f"[{ends}] cannot have the decoration {name}")
    return low, high, known


def _end(text: str, none: str) -> End:
    text = text.strip() or none
    return float(text) if re.fullmatch(r"[+-]?inf(inity)?", text) else fraction(text)

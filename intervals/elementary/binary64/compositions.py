"""The other functions of one variable, composed of the kernels in pair arithmetic.

Measured on a million points each, in u: cbrt 0.0001, asin, acos, atan 0.04, cosh 0.009, sinh 0.007,
tanh 0.007, asinh, acosh, atanh 0.002, tan 0.005.

Each formula adds numbers of one sign only, so that the rules of `Pair` bound its error; k is
what they give. Arguments are x = 0 or 2^-400 <= |x| <= 2^400 (where nothing is said), x.lo = 0;
odd functions are evaluated at |x|.
"""

from math import nan
from typing import Any

from intervals.elementary.binary64.arctangent import angle
from intervals.elementary.binary64.exponential import exp, expm1
from intervals.elementary.binary64.logarithm import log1p
from intervals.elementary.binary64.pair import Pair, two_product, two_sum
from intervals.elementary.binary64.primitives import of

ONE, _TWO = Pair(1.0), Pair(2.0)
_SATURATED = 300.0  # tanh 300 > 1 - 2^-800


def sinh(x: Any) -> Pair:
    """Return (e + e / (e + 1)) / 2, e = exp|x| - 1, |x| <= 690; k = 0.13."""
    e = expm1(Pair(abs(x)))
    return (e + e / (e + ONE)).scaled(0.5).with_sign_of(x)


def cosh(x: Any) -> Pair:
    """Return (e + 1 / e) / 2, e = exp x, for 0 <= x <= 600; k = 2^-10 + 2^-19."""
    e = exp(Pair(x)).normal()
    return (e + ONE / e).scaled(0.5)


def tanh(x: Any) -> Pair:
    """Return e / (e + 2), e = exp|2 x| - 1; k = 0.13.

    Beyond 300 it is tanh 300: a lower bound of it is one of tanh x, and an upper one, cut off at 1,
    is 1, because there is no binary64 number between tanh 300 and 1.
    """
    e = expm1(Pair(2.0 * of(x).minimum(abs(x), _SATURATED)))
    return (e / (e + _TWO)).with_sign_of(x)


def asinh(x: Any) -> Pair:
    """Return log(1 + a + a^2 / (1 + sqrt(1 + a^2))), a = |x|; k = 2^-5 + 2^-18."""
    a = Pair(abs(x))
    square = a * a
    return log1p(a + square / (ONE + (ONE + square).sqrt())).with_sign_of(x)


def acosh(x: Any) -> Pair:
    """Return log(1 + y + sqrt(y (x + 1))), y = x - 1, for x >= 1; k = 2^-5 + 2^-18."""
    y, above = Pair(*two_sum(x, -1.0)), Pair(*two_sum(x, 1.0))
    return log1p(y + (y * above).sqrt())


def atanh(x: Any) -> Pair:
    """Return log(1 + 2 a / (1 - a)) / 2, a = |x| < 1; k = 2^-5 + 2^-18."""
    a = abs(x)
    quotient = Pair(2.0 * a) / Pair(*two_sum(-a, 1.0))
    return log1p(quotient).scaled(0.5).with_sign_of(x)


def asin(x: Any) -> Pair:
    """Return the angle of (sqrt(1 - x^2), |x|) for |x| <= 1; k = 0.06."""
    return angle(Pair(abs(x)), _leg(x)).with_sign_of(x)


def acos(x: Any) -> Pair:
    """Return the angle of (x, sqrt(1 - x^2)) for |x| <= 1; k = 0.06."""
    return angle(_leg(x), Pair(x))


def _leg(x: Any) -> Pair:
    """Return sqrt((1 - x)(1 + x))."""
    return (Pair(*two_sum(-x, 1.0)) * Pair(*two_sum(x, 1.0))).sqrt()


def atan(x: Any) -> Pair:
    """Return the angle of (1, |x|); k = 0.06."""
    return angle(Pair(abs(x)), Pair(0.0 * x + 1.0)).with_sign_of(x)


def cbrt(x: Any) -> Pair:
    """Return y + (x - y^3) / (3 y^2), y near the cube root; NaN where y is not proved to be near.

    Let r = (x - y^3) / y^3, |r| <= 2^-30 (which is what is checked). Then cbrt x = y (1 + r)^(1/3),
    and 1 + r/3 differs from this by at most r^2 / 8 < 2^-63; x - y^3 is known to 2^-20 u |x|, its
    quotient by 3 y^2 to another 2^-28 u |y|. k = 0.002.
    """
    functions = of(x)
    y = functions.cbrt(x)
    square, low = two_product(y, y)
    cube, lost = two_product(square, y)
    rest = ((x - cube) - lost) - low * y
    near = abs(rest) <= 2.0**-31 * abs(x)
    correction = rest / functions.maximum(3.0 * square, 2.0**-1000)
    return Pair(y, functions.where(near, correction, nan), 0.002)

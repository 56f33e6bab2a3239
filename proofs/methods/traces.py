"""The escape rate of an expanding map of the interval from its periodic points: a candidate.

Let L h be the sum of |g_j'| h(g_j) over the inverse branches g_j of a full shift, all analytic. The
trace of L^n is the sum of 1 / |m - 1| over the multipliers m of the words of length n; the function
d(z) = det(1 - z L) = exp(-sum of z^n/n tr L^n) is entire, and its first zero is 1 / lambda, lambda
the largest eigenvalue: lengths of what has not escaped shrink like lambda^n. The coefficients of d
fall faster than any exponential. So the zero of its Taylor polynomial comes close with few periods;
what is left out is not bounded here. The polynomial's own zero is enclosed.

Source: Ruelle, Invent. Math. 34 (1976); Artuso, Aurell, Cvitanovic, Nonlinearity 3 (1990).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from intervals import Interval, Undecided

_STEPS = 200  # of Newton's method


def escape_rate(cycles: Sequence[Sequence[Interval]]) -> Interval:
    """Enclose log z for the first zero z of the Taylor polynomial of d, of degree N.

    cycles[n - 1]: the multipliers of the cycles of least period n <= N. Raises Undecided where no
    change of sign is found.
    """
    series = coefficients(traces(cycles))
    precision = min(x.precision for x in series)
    point, least = Fraction(1), Fraction(1, 2**precision)
    for _ in range(_STEPS):
        value, slope = (
            _at(f, Interval(point, precision=precision)) for f in (series, _slope(series))
        )
        if not slope.mid:
            break
        step = value.mid / slope.mid
        point = Interval(point - step, precision=precision).mid
        if abs(step) < least * 16:
            break
    reach = least
    while reach < point:
        before, after = (
            _at(series, Interval(end, precision=precision))
            for end in (point - reach, point + reach)
        )
        if before.inf > 0 > after.sup:
            return Interval(point - reach, point + reach, precision=precision).log()
        reach *= 2
    raise Undecided("the first zero of the determinant is not enclosed")


def traces(cycles: Sequence[Sequence[Interval]]) -> list[Interval]:
    """Enclose the traces of L, ..., L^N: p times for a cycle of period p where p divides n."""
    return [
        sum(
            (
                p / abs(m ** (n // p) - 1)
                for p in range(1, n + 1)
                if n % p == 0
                for m in cycles[p - 1]
            ),
            Interval(0, precision=cycles[0][0].precision),
        )
        for n in range(1, len(cycles) + 1)
    ]


def coefficients(of: Sequence[Interval]) -> list[Interval]:
    """Enclose those of exp(-sum of z^n/n t_n) from t_1, ..., t_N: n c_n = -sum of t_k c_(n-k)."""
    found = [of[0] * 0 + 1]
    for n in range(1, len(of) + 1):
        found.append(sum((of[k - 1] * found[n - k] for k in range(1, n + 1)), of[0] * 0) / -n)
    return found


def _slope(series: Sequence[Interval]) -> list[Interval]:
    return [n * c for n, c in enumerate(series)][1:]


def _at(series: Sequence[Interval], z: Interval) -> Interval:
    """Enclose the polynomial (Horner)."""
    value = z * 0
    for c in reversed(series):
        value = value * z + c
    return value

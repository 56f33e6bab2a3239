"""The angle of a point, as a pair with a proved error.

Theorem. For y >= 0 and x, not both 0, each of them 0 or with 2^-400 <= |.| <= 2^400, `angle`
returns theta in [0, pi] with x = r cos theta, y = r sin theta, and k = k_x + k_y + 0.06.

Proof. Let a / b be the smaller of y, |x| over the larger, q = fl(a / b) in [0, 1], j = round(16 q),
but 0 for j = 1, and c = j / 16. With T = (a - c b) / (b + c a), atan(a / b) = atan c + atan T.
|T| <= 1/32 up to 2^-50 if j >= 2, |T| <= 3/32 if j = 0. c has 5 bits, so that c b and c a are exact
in two parts each; their sums with a and b are, up to the roundings of small numbers, 2^11 u^2 b.
So t + d, d being the rest of the division over the divisor, is T up to 2^-30 u c if j >= 2, and up
to 2^-30 u |t| if j = 0; the result is at least 0.99 c and 0.99 |t|.
atan T = T - t^3 p + ..., p = 1/3 - t^2/5 + ... + t^12/15: errors relative to |t|, in units of u,
for |t| = 3/32: 0.024 from 8 relative errors of t^3 p <= 0.003 |t| (t for T among them), 0.003 from
adding d to it, 0.02 from the tail, at most t^16 / 17: together 0.047, and the result is at least
0.997 |t|. If j >= 2 each is smaller still and the result is at least 0.09 > |t|. Measured on a
million points: 0.033 u.
The base, atan c, pi/2 - atan c, pi - atan c or pi/2 + atan c, is known in two parts to 2^-104, and
its sum with +-t is exact in two parts.
A relative error of a / b changes atan(a / b) by no more, relatively: s <= (1 + s^2) atan s for
s >= 0; and the other angles change as much absolutely, and are no smaller.
"""

from fractions import Fraction
from typing import Any

from intervals.elementary.binary64.pair import Pair, fast_two_sum, two_product, two_sum
from intervals.elementary.binary64.primitives import Table, horner, nearest_integers, split

_ARCTANGENTS = (  # of j/16 in two parts, j = 2, ..., 16
    ("0x1.fd5ba9aac2f6ep-4", "-0x1.cd37686760c17p-59"),
    ("0x1.7b97b4bce5b02p-3", "0x1.347b0b4f881cap-58"),
    ("0x1.f5b75f92c80ddp-3", "0x1.8ab6e3cf7afbdp-57"),
    ("0x1.362773707ebccp-2", "-0x1.963a544b672d8p-57"),
    ("0x1.6f61941e4def1p-2", "-0x1.c63aae6f6e918p-56"),
    ("0x1.a64eec3cc23fdp-2", "-0x1.24dec1b50b7ffp-56"),
    ("0x1.dac670561bb4fp-2", "0x1.a2b7f222f65e2p-56"),
    ("0x1.0657e94db30d0p-1", "-0x1.d5b495f6349e6p-56"),
    ("0x1.1e00babdefeb4p-1", "-0x1.928df287a668fp-58"),
    ("0x1.345f01cce37bbp-1", "0x1.1021137c71102p-55"),
    ("0x1.4978fa3269ee1p-1", "0x1.2419a87f2a458p-56"),
    ("0x1.5d58987169b18p-1", "0x1.0028e4bc5e7cap-57"),
    ("0x1.700a7c5784634p-1", "-0x1.8c34d25aadef6p-56"),
    ("0x1.819d0b7158a4dp-1", "-0x1.bf76229d3b917p-56"),
    ("0x1.921fb54442d18p-1", "0x1.1a62633145c07p-55"),
)
_SERIES = tuple((-1) ** (k // 2 + 1) / k for k in range(15, 2, -2))


def _bases() -> tuple[Table, Table]:
    """Return both parts of atan c, pi/2 - atan c, pi - atan c, pi/2 + atan c, 17 numbers c each."""
    arcs = [sum(map(Fraction, map(float.fromhex, pair))) for pair in _ARCTANGENTS]
    arcs, right = [Fraction(0), Fraction(0), *arcs], 2 * arcs[-1]
    angles = ((0, 1), (right, -1), (2 * right, -1), (right, 1))
    exact = [base + sign * arc for base, sign in angles for arc in arcs]
    high = [float(x) for x in exact]
    low = [float(x - Fraction(h)) for x, h in zip(exact, high, strict=True)]
    return Table(high), Table(low)


_HIGH, _LOW = _bases()
_NODES = Table([0.0, 0.0, *(j / 16 for j in range(2, 17))])
_SIGNS = Table(sign for sign in (1.0, -1.0, -1.0, 1.0) for _ in range(17))


def angle(y: Pair, x: Pair) -> Pair:
    """Return the angle in [0, pi] of the point (x, y), y >= 0: see the theorem."""
    left = x.hi < 0.0
    right = (-x).where(left, x)
    steep = y.hi > right.hi
    a, b = right.where(steep, y), y.where(steep, right)
    _, node = nearest_integers(16.0 * (a.hi / b.hi))
    c = _NODES[node]
    t, rest = _rotated(a, b, c)
    z = t * t
    cubic = horner(z, _SERIES)
    cubic *= z
    cubic *= t
    rest -= cubic
    node += 17 * (steep + 2 * left)
    sign = _SIGNS[node]
    high, low = two_sum(_HIGH[node], sign * t)
    low += _LOW[node] + sign * rest
    return Pair(*fast_two_sum(high, low), x.k + y.k + 0.06)


def _rotated(a: Pair, b: Pair, c: Any) -> tuple[Any, Any]:
    """Return (a - c b) / (b + c a) in two parts."""
    n, n_low = two_sum(a.hi, -(c * b.hi))
    n_low += a.lo - _low_of_product(c, b)
    m, m_low = fast_two_sum(b.hi, c * a.hi)
    m_low += b.lo + _low_of_product(c, a)
    t = n / m
    p, e = two_product(t, m)
    return t, (((n - p) - e) + (n_low - t * m_low)) / m


def _low_of_product(c: Any, x: Pair) -> Any:
    """Return c x - fl(c x.hi), for c of at most 26 bits: exact but for the rounding of x.lo."""
    head, tail = split(x.hi)
    return ((c * head - c * x.hi) + c * tail) + c * x.lo

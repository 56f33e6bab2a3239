"""Section 4: where stable orbits are in eta if the table is below the mass's rest, nu < 0.

Names and lemmas 1 to 4 are those of `orbits`: x = pi n eta, e = (eta tan x)^2, D = side gap/h is
`distance`, the mass minus the table, < 0 in flight. Let N = |nu|, {n eta} = 1 - d, 0 < d < 1/2,
tau = sqrt(e) = eta tan(pi d), a = atan(tau); solutions exist if sin(a) <= N (lemma 1: e/(1 + e) <=
nu^2). An orbit with M < 1 is at the p > -e with A(p) = nu^2.

Lemma 6 (n eta < 1). Fix n. On (1/(2 n), 1/n) e falls from oo to 0, and is convex. So stable orbits
are where e/(1 + e) < nu^2 < A(eta^2), lemma 3: after the saddle-node, the eta_S with e/(1 + e) =
nu^2, where G = eta^4 + e - nu^2 (1 - eta^2)^2 > 0. G is convex, and > 0 up to eta_S. So if G(b) < 0
< G(a), eta_S < a < b, and (1 + N) <= n^2 N, they are between eta_S and the zero of G in (a, b),
where M = 0; if (1 + N) eta_S^2 >= N, between eta_S and 1/n. If (1 + N) <= n^2 N and G < 0 at an
eta in (1/(2 n), 1/n), there are none in [eta, 1/n), and none for greater n in [eta, 1).
Proof. With T = tan(pi d), S = 1 + T^2, u = pi (1 - d) = pi n eta: sqrt(e) = u T/(pi n) has the
derivative (u S - T)/n > 0 in d, and half the second one of (u T)^2 is pi^2 times u S (u + 3 u T^2 -
4 T) + T^2 > 0, as 12 u^2 > 16. A(-e) = e/(1 + e) is the least of A, so G > 0 up to eta_S. At 1/n,
e = 0 and G <= 0 exactly if (1 + N) <= n^2 N: a convex G has one zero between a > 0 and a <= 0. If
(1 + N) eta^2 >= N, eta^4 >= nu^2 (1 - eta^2)^2. At fixed eta e falls as n < 1/eta grows.

Lemma 7 (n eta > 1). If N <= 3/10, an orbit with M < 1 and n eta > 1 has n = 1, 3/2 < eta < 2.
Proof. By lemma 4 D < 0 on (0, T) at p = -e, too, where the table is h (1 - 2 tau sin(t/2) (cos(t/2)
- tau sin(t/2))). Let m < n eta < m + 1. The mass has its m peaks, h/cos(pi d) > h, at the t = pi n
+ k pi/eta, |k| <= m - 1, m - 1 - k even. There sin(t/2) (cos(t/2) - tau sin(t/2)) < 0, so with t =
r mod 2 pi, 0 <= r < 2 pi: r > pi - 2 a; as T - t is a peak, too, |r - pi| < 2 a; and the mean of
both is 1/cos(pi d) < 1 + tau^2 (1 - cos r) <= 1 + 2 tau^2: so eta >= cos(a)/2, and tan(pi d/2) <=
sin(a) <= N. (1) m > 1. Let 2 pi/eta = 2 pi q + c, q whole, |c| <= pi. As 4 a < pi, r grows by c
from peak to peak: (m - 1) |c| < 4 a. k = 0, for odd m, gives r = pi n, n odd; k = 1, for even m, n
+ q odd. So n - (m + 1) q is odd; but it is (m + 1) c/(2 pi) - d/eta, by n eta = m + 1 - d, and
its size below (6 asin N + 4 atan N/sqrt(1 - N^2))/pi < 1. (2) m = 1. n is odd: k = 0. At t = pi n
- 2 a the table is at h, so the mass, cos(2 a eta) h/cos(pi d), is below: 2 eta atan(tau) > pi d =
atan(tau/eta). For n >= 3, eta < 2/3, but 4/3 atan(tau) <= atan(3 tau/2): they are 0 at 0, and the
derivative of the left side is the smaller one for 9 tau^2 <= 1; tau <= N/sqrt(1 - N^2) < 0.315.

Lemma 8 (n = 1, 3/2 < eta < 2). If N <= 3/10, stable orbits are between the saddle-node, where
e/(1 + e) = nu^2, and the eta_G at which the flight touches the table on its way, at a t in J =
[pi - 5/7, pi + 5/7]. On J, D'' < -1/5; if D > 0 at eta and a t in J, then eta_G < eta.
Proof. tau < 0.315, so d < 0.066, eta > 1.934, 1/cos(pi d) < 1.014. At t = pi + s, D = cos(eta s)/
cos(pi d) - 1 + p (1 + cos s) - tau sin s. (1) For |s| <= 5/7, D'' = -eta^2 cos(eta s)/cos(pi d) - p
cos s + tau sin s < -0.53 + 0.1 + 0.21, as p >= -e. (2) If p >= 0, D > 0 at s = 0. Let p < 0. For 0
< t <= 1, cos(eta t) - 1 <= -(25/72) eta^2 t^2 < -1.29 t^2 and sin t - sin(eta t)/eta <= 2 t^3/3, so
D < 0; for T - t = v in (0, 1], D = cos(eta v) - 1 - tau sin(eta v)/eta + p (1 - cos v) - tau sin v
< 0; for 5/7 <= |s| <= pi - 1, cos(eta s) < 0.19, so D < 0. (3) tau falls and p grows with eta: it
is -dtau/deta = pi eta (1 + (tau/eta)^2) - tau/eta > 5.9, dp/dtau = -tau (1 - p)/(p + tau^2) <
-1/tau < -3.17 for p < 0. So for |s| <= 5/7 D grows with eta as long as p < 0: its derivative is at
least 5.9 (3.17 (1 + cos s) - |sin s|) > 28 from p and tau, less s sin(eta s)/cos(pi d) + pi (tau/
eta) cos(eta s)/cos(pi d) < 1.3.
"""

from __future__ import annotations

from fractions import Fraction

from proofs.trusted.equations import clock
from proofs.trusted.kernel.arithmetic import Dual, Unproved, pi, rational
from proofs.trusted.kernel.operations import sqrt
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s4_single.orbits import bits_of, distance, turn

MOST_NU = Fraction(3, 10)
LATE = Fraction(3, 2), Fraction(2)  # between which eta is in lemma 8
_REACH = Fraction(5, 7)  # from pi, of the times at which it looks


def grazed(nu: Fraction, bracket: Range, time: Fraction) -> Range:
    """Require that the flight passes the table below the bracket and not above, by lemma 8."""
    if not LATE[0] < bracket[0] < bracket[1] < LATE[1]:
        raise Unproved("a bracket of grazing outside (3/2, 2)")
    bits = bits_of(bracket[1] - bracket[0], 1)
    from_pi = rational(time, bits) - pi(bits)
    if not -_REACH < from_pi.range[0] <= from_pi.range[1] < _REACH:
        raise Unproved("the touch is not within 5/7 of pi")
    free, hit = (_distance(nu, eta, time, bits) for eta in bracket)
    if (free.value + free.derivative * free.derivative * 5 / 2).hi >= 0 or hit.value.lo <= 0:
        raise Unproved("an end of a window by grazing is not bracketed")
    return bracket


def _distance(nu: Fraction, eta: Fraction, time: Fraction, bits: int) -> Dual:
    """Enclose D and D' at a time, n = 1, at the p > -e with A(p) = nu^2."""
    own, square = rational(eta, bits), rational(nu * nu, bits)
    around = turn(eta, 1, bits)
    tangent = own * around[0] / around[1]
    share = (sqrt(square - (1 - square) * tangent * tangent) - square) / (1 - square)
    now = clock(own, Dual(rational(time, bits), rational(Fraction(1), bits)))
    found: Dual = distance(own, around, now, share)
    return found

"""The impact map at resonance, eta = 1, in closed form, to as many digits as are asked for.

Theorem. Let eta = 1, side the sign of nu, c = gamma + nu cos(phi) with side c >= 0, K = epsilon c.
The gap at time t after the impact is side 2 sin(t/2) (K cos(t/2) - sin(t/2)). If K is not 0, the
next impact is at the phase phi + 2 arctan(K) mod 2 pi, and c is K there: so the phases tend to
phi + 2 sum over n >= 0 of arctan(epsilon^n K), for epsilon < 1. If K = 0 and nu < 0, the mass
touches the table again after 2 pi, at the same phase, where c = 0. If K = 0 and nu > 0, it rests
on the table for ever. Proof. `trusted.paper.s6_resonance.resonance.closed_form`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from intervals import Interval, Undecided, atan
from proofs.motion.digits import to_digits
from proofs.motion.witness import Impossible
from proofs.trusted.equations import Clock, arrival, closing, launch
from proofs.trusted.flights import phase_after
from proofs.trusted.numbers import Range

_MOST_IMPACTS = 20_000  # one by one, until the series converges


class TooManyImpacts(Undecided):
    """So many impacts that are not weak come before the limit that it is not computed."""


@dataclass(frozen=True)
class Motion:
    """The impact after a state: phase and velocity gamma; the limit of the phases of all impacts.

    phase, velocity: None if the mass rests on the table for ever. limit: None if there is none,
    the impacts being elastic.
    """

    phase: Range | None
    velocity: Range | None
    limit: Range | None

    @property
    def sticking(self) -> bool:
        """Whether the mass rests on the table."""
        return self.phase is None


def motion(
    nu: Fraction, epsilon: Fraction, phi: Fraction, gamma: Fraction, *, digits: int = 30
) -> Motion:
    """Enclose the next impact and the limit phase; bounds agree to `digits` significant digits.

    Raises ValueError for parameters outside the model, Impossible where the mass would come from
    inside the table, Undecided where the digits are not reached.
    """
    if nu == 0:
        raise ValueError("nu must not be 0: the table would stand still")
    if not 0 <= epsilon <= 1:
        raise ValueError(f"epsilon must be in [0, 1], not {epsilon}")
    return to_digits(
        digits,
        lambda bits: _at_precision(nu, epsilon, phi, gamma, bits),
        lambda x: [each for each in (x.phase, x.velocity, x.limit) if each is not None],
        final=(TooManyImpacts,),
    )


def _at_precision(
    nu: Fraction, epsilon: Fraction, phi: Fraction, gamma: Fraction, bits: int
) -> Motion:
    def exact(value: Fraction | int) -> Interval:
        return Interval(value, precision=bits)

    side = 1 if nu > 0 else -1
    start = launch(side, exact(1), exact(nu), exact(phi))
    relative: Interval = closing(start, exact(gamma))
    meeting = relative * side
    zero = phi == 0 and gamma == -nu  # the cosine of any other rational phase is irrational
    if not zero and meeting.sup < 0:
        raise Impossible(
            "physically impossible: the mass would come from inside the table; nu (gamma + nu cos "
            "phi) >= 0 before an impact"
        )
    if not zero and meeting.inf <= 0:
        raise Undecided("whether the mass meets the table")
    kick = exact(0) if zero else relative * epsilon
    rests = zero or epsilon == 0
    if rests and side > 0:
        return Motion(None, None, (phi, phi))
    sin, cos = 2 * kick / (1 + kick.sqr()), (1 - kick.sqr()) / (1 + kick.sqr())
    velocity = arrival(start._replace(kick=kick), Clock(sin, cos, sin, cos))[1]
    phase = (phi, phi) if rests else _on_circle(atan(kick) * 2 + phi)
    if rests:
        limit: Range | None = phase
    else:
        limit = _on_circle(angles(kick, epsilon) * 2 + phi) if epsilon < 1 else None
    return Motion(phase, (velocity.inf, velocity.sup), limit)


def _on_circle(phase: Interval) -> Range:
    return phase_after(Fraction(0), (phase.inf, phase.sup), phase.precision)


def angles(kick: Interval, epsilon: Fraction) -> Interval:
    """Enclose the sum over n >= 0 of arctan(epsilon^n kick), for 0 <= epsilon < 1."""
    ratio = Interval(epsilon, precision=kick.precision)
    total = Interval(0, precision=kick.precision)
    for _ in range(_MOST_IMPACTS):
        if kick.mag <= Fraction(1, 2):
            return total + _small_angles(kick, ratio)
        total, kick = total + atan(kick), kick * ratio
    raise TooManyImpacts(f"more than {_MOST_IMPACTS} impacts before they are weak")


def _small_angles(x: Interval, ratio: Interval) -> Interval:
    """Enclose the sum over n >= 0 of arctan(ratio^n x), |x| < 1.

    By the power series of arctan it is the sum over odd j of +-x^j / (j (1 - ratio^j)). The rest
    behind a term is at most the next one: so it is for each n, and all have the same sign.
    """
    total, sign, j = Interval(0, precision=x.precision), 1, 1
    power, factor = x, ratio
    smallest = x.mag / 2**x.precision
    while True:
        term = power / ((1 - factor) * j)
        if term.mag <= smallest:
            return total.widen(term.mag)
        total = total + term * sign
        power, factor, sign, j = power * x.sqr(), factor * ratio.sqr(), -sign, j + 2

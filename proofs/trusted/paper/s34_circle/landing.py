"""Where flights land (section 3.4): on the arc where the mass sticks, or nowhere."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import Launch, launch_acceleration
from proofs.trusted.flights import Motion, lifted, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import (
    TURN,
    Phase,
    Phases,
    Range,
    between,
    bits_for,
    floor_text,
    increasing,
    show_range,
)
from proofs.trusted.oscillator import SEPARATES, PlasticMap
from proofs.trusted.parameters import Place
from proofs.trusted.windows import BITS, clear, level

Number = Any
TURN_AT_MOST = TURN + Fraction(1, 10**9)  # a little more than 2 pi
_THREE = 3  # less than pi


# -- the sticking arc ------------------------------------------------------------------------------


@dataclass(frozen=True)
class Separation(Conclusion):
    """The mass sticks exactly on an arc [start, phi_s), until phi_s in `phase`.

    The flights from phi_s to phase[1] have their first impact, a transversal one, after a time in
    `time`, at a phase in `arrival` + 2 pi turns, with a relative speed in `speed`. Start and
    arrival are on the line, below phi_s; in the turn that ends with it, where the flight returns.
    """

    at: Place
    start: Range
    phase: Phase
    time: Range
    turns: int
    arrival: Range
    speed: Range

    def __post_init__(self) -> None:
        if not self.start[1] < self.phase[0] <= self.phase[1] < self.start[0] + TURN:
            raise Unproved("no arc where the mass sticks")

    @property
    def returns(self) -> bool:
        """Whether these flights end in the interior of the arc."""
        return self.start[1] < self.arrival[0] and self.arrival[1] < self.phase[0]

    @property
    def share(self) -> Fraction:
        """The least share of the circle that the arc is."""
        return (self.phase[0] - self.start[1]) / TURN_AT_MOST

    @property
    def sentence(self) -> str:
        start, phase, arrival = (between(x, 20) for x in (self.start, self.phase, self.arrival))
        periodic = (
            ", inside the arc: the motion is periodic, with one impact and one separation a "
            "period. If f maps a sticking phase to phi_s, (phi_1, phi_s) is an orbit of period 2 "
            "of f; if f maps it to the next impact phase, as section 2 defines f, phi_1 is a fixed "
            "point, and phi_s is on no periodic orbit. It is superstable: phases near phi_1 and "
            "below phi_s stick at this impact, those a little above phi_s at the next one, and so "
            "join it exactly."
        )
        return (
            f"the mass sticks after a plastic impact exactly at the phases, mod 2 pi, of an arc "
            f"[phi_a, phi_s), phi_a in {start}, phi_s in {phase}; f is constant there, whether it "
            "maps to phi_s or on to the next impact. The flight from phi_s ends at a phase phi_1 "
            f"in {arrival}{periodic if self.returns else '.'}"
        )

    @property
    def brief(self) -> str:
        period = ", superstable: period 2 if separation counts as a step of f, else 1"
        return (
            f"sticking from a phase in {between(self.start)} to one in {between(self.phase)}, "
            f"then impact at {between(self.arrival)}{period if self.returns else ''}"
        )

    @property
    def quantities(self) -> dict[str, Range]:
        return {
            "arc_start": self.start,
            "separation_phase": self.phase,
            "flight": self.time,
            "impact_phase": self.arrival,
            "impact_speed": self.speed,
        }


def separation(context: Context, reader: Reader) -> Separation:
    """Rule `separation`: {phase: [l, u]}.

    Hypotheses: the launch acceleration A is < 0 at l, > 0 at u; transversal first impacts after the
    launches in [l, u] are found, gap''' being > 0 at first (see `FirstZero`). Conclusion:
    `Separation`.

    Proof. A = side (nu (1 - eta^2) sin(phi) - eta^2). At launch gap''' is A', since gap'' =
    A(phi + t) - eta^2 gap: so A' > 0 on [l, u], and A has one zero phi_s there, one more on the
    circle, at pi - phi_s, and is < 0 on the arc between them that ends at phi_s. It falls through 0
    at the start of that arc, so that the mass sticks there too, and rises through 0 at phi_s. After
    a launch in [phi_s, u] gap = gap' = 0 <= gap'' at first: gap > 0 as long as gap''' has been,
    and until it falls through its first zero.
    """
    (phase_of,) = reader.fields("phase")
    phase, at = Phase(*phase_of.range()), context.place
    bits = bits_for(phase)
    low, high = (launch_acceleration(Motion(at, (x, x), bits).start) for x in phase)
    if not low.hi < 0 < high.lo:
        raise Unproved("the launch acceleration does not change sign in the bracket")
    flight = PlasticMap(at, leaves=SEPARATES).landing(enclosed((phase,), bits))
    time, speed = flight.time.range, -flight.fall
    quarters = phase[0] / pi(bits).range[0] * 2
    ends = (pi(bits) * ((quarters - 1) // 2 * 2 + 1)).range  # of the arc, added: an odd half turn
    impact = phase[0] + time[0], phase[1] + time[1]
    turns = 1 + (impact[1] - phase[0]) // whole_turns(1, bits)[0]
    start, arrival = (ends[0] - phase[1], ends[1] - phase[0]), lifted(impact, -turns, bits)
    return Separation(at, start, phase, time, turns, arrival, speed.range)


# -- landing on it ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Lands(Conclusion):
    """The first impact of every launch in `phases`, mod 2 pi, that does not stick is in the arc."""

    at: Place
    phases: Range

    @property
    def sentence(self) -> str:
        return (
            f"every launch from a phase in {show_range(self.phases)}, mod 2 pi, sticks or has its "
            "first impact at a phase where the mass sticks."
        )


def lands(context: Context, reader: Reader) -> Lands:
    """Rule `lands`: {separation, cuts x_0 < ... < x_n, turns k >= 0}.

    Let the sticking arc be (a, s). Hypotheses: eta (s - x_0) < pi. If k = 0, [x_0, x_n] lies in
    (s - 2 pi, s), and gap < 0 at phase s after the launch at x_0. If k > 0, [x_0, x_n] lies in
    (a - 2 pi, a), and after the launches in [x_(i-1), x_i] gap > 0 from the time a - x_i to
    a + 2 pi k - x_(i-1), gap < 0 at the time s + 2 pi k - x_i. Conclusion: the first impact of
    every launch in [x_0, x_n] that does not stick is in the sticking arc.

    Proof. Let A be the launch acceleration. For the plastic gap, gap'' = A(phi + t) - eta^2 gap,
    so gap(phi, t) is the integral of sin(eta (t - u)) / eta A(phi + u) over 0 < u < t. Where A > 0
    on (phi, phi + t) and eta t < pi it is positive: no impact until phase a. Its derivative at
    fixed phi + t is -sin(eta t) / eta A(phi), so for k = 0 the gap at phase s is largest at x_0.
    The first zero is where A < 0: the mass sticks.
    """
    separation_of, cuts_of, turns_of = reader.fields("separation", "cuts", "turns")
    arc, cuts = context.step(separation_of, Separation), cuts_of.numbers(2, 200)
    turns = turns_of.number()
    if turns.denominator != 1 or not 0 <= turns <= 1000:
        raise turns_of.fail("a whole number from 0 to 1000 is expected")
    if not increasing(cuts):
        raise cuts_of.fail("phases must increase")
    first = lifted(arc.phase if turns == 0 else arc.start, -1, BITS)[1]
    last = arc.phase[0] if turns == 0 else arc.start[0]
    if (
        cuts[0] < first
        or cuts[-1] > last
        or context.place.eta[1] * (arc.phase[1] - cuts[0]) >= _THREE
    ):
        raise Unproved("the launches are not proved to stay up until the sticking arc")
    start, end = (lifted(each, int(turns), BITS) for each in (arc.start, arc.phase))
    for low, high in pairwise(cuts if turns else (cuts[0], cuts[0])):
        motion = Motion(context.place, (low, high), BITS)
        if turns:
            if end[0] - high <= start[1] - low:
                raise Unproved("a piece is longer than the sticking arc")
            clear(motion, (arc.start[0] - high, start[1] - low))
        if level(motion, end[0] - high)[1] >= 0:
            raise Unproved("the gap is not negative at the end of the sticking arc")
    return Lands(context.place, (cuts[0], cuts[-1]))


# -- landing nowhere -------------------------------------------------------------------------------


@dataclass(frozen=True)
class NeverImpacts(Conclusion):
    """After a launch in `phases` gap > 0 up to the time 2 pi q, where eta = p/q in lowest terms.

    At that time gap = gap' = 0 after every launch that does not stick: mass and table are exactly
    where they were, and as fast. Such a gap is > 0 at first, so that it has a first zero.
    """

    at: Place
    phases: Phases

    @property
    def share(self) -> Fraction:
        """The least share of the circle that these phases are."""
        return (self.phases[1] - self.phases[0]) / TURN_AT_MOST

    @property
    def sentence(self) -> str:
        turns = self.at.eta[0].denominator
        return (
            f"after a launch at a phase of {show_range(self.phases)}, "
            f"{floor_text(100 * self.share)} percent of the circle or more, the mass stays off the "
            f"table for {turns} turns, then touches it at the phase of the launch, without "
            f"relative velocity, and so on forever: the motion has the period {2 * turns} pi, and "
            "there is no impact, or f(phi) = phi if a touch counts as one. Since eta is rational, "
            "mass and table are then where they were, after a launch at any phase: so the gap has "
            "a first zero after every phase (after the mass leaves the table, where it sticks), "
            "and f is defined on [0, 2 pi) if a touch counts as an impact."
        )

    @property
    def brief(self) -> str:
        return f"no impact ever after a launch in {show_range(self.phases)}, unless touches count"


def never_impacts(context: Context, reader: Reader) -> NeverImpacts:
    """Rule `never-impacts`: {phases}, for -1 < nu < 0 and eta = p/q in lowest terms.

    Hypotheses: all phases are in (0, 3), and `closest_approach` gives positive numbers for them.
    Conclusion: `NeverImpacts`.
    """
    (phases_of,) = reader.fields("phases")
    phases = Phases(*phases_of.range())
    if not 0 < phases[0] < phases[1] < _THREE:
        raise phases_of.fail("phases between 0 and 3 are expected")
    eta, nu = context.place.point
    if not -1 < nu < 0:
        raise Unproved("closest approaches are known for -1 < nu < 0")
    start = Motion(context.place, phases, BITS).start
    away = Enclosure.of(*phases, BITS) - pi(BITS) / 2
    bounds = closest_approach(eta, rational(nu, BITS), start, away, pi(BITS))
    if any(bound.lo <= 0 for bound in bounds):
        raise Unproved("an impact is not excluded")
    return NeverImpacts(context.place, phases)


def closest_approach(
    eta: Fraction, nu: Number, start: Launch, away: Number, half_turn: Number
) -> tuple[Number, ...]:
    """Return numbers; if all are > 0, the launch at pi/2 + away is one of `NeverImpacts`.

    Theorem, for -1 < nu < 0, eta = p/q in lowest terms and |away| < pi/2. Proof. Let n = |nu| and
    a = 1 - n. The mass is at X = R cos(eta s), the table at Z = 1 - n cos(u), s and u being times
    since the highest point of X and the lowest of Z: u = s + w + 2 pi m q/p mod 2 pi in the mass's
    oscillation m, with w = delta/eta + away and tan(delta) = rate / (eta (1 + lift)), which has the
    sign of away.
    An impact X = Z says n (1 - cos u) + R (1 - cos eta s) = R - a =: r. As 1 - cos x >= 2 (x/pi)^2
    on [-pi, pi], u^2 <= 5 r/n and (eta s)^2 <= 5 r/a; as 1 - cos x >= x^2/2 (1 - x^2/12),
    n c u^2 + a eta^2 d s^2 <= 2 r with c = 1 - 5r/(12n), d = 1 - 5r/(12a). So (|u| + |s|)^2 <=
    T = 2r (1/(n c) + 1/(a eta^2 d)), s^2 <= S = 2r/(a eta^2 d).
    (1) In an oscillation m that p does not divide, w + 2 pi m q/p is 2 pi/p - |w| or more from all
    multiples of 2 pi: no impact if (|w| + |u| + |s|)^2 <= 2 (w^2 + T) < (2 pi/p)^2.
    (2) In the others, by periodicity m = 0: where s^2 <= S, gap'' = n cos(u) + R eta^2 cos(eta s)
    >= n (1 - S - w^2) + a eta^2 - (a + r) eta^4 S/2, R = a + r and cos x >= 1 - x^2/2. If that is
    > 0 the gap is convex there, 0 with its derivative at launch: > 0 elsewhere.
    Below r is bounded by (R^2 - a^2) / (2a), and w by away + rate / (eta^2 (1 + lift)); the
    numbers are the differences in (1) and (2), n c and a eta^2 d.
    """
    height, speed = 1 + start.lift, start.rate / start.eta
    deepest, size, square = 1 + nu, -nu, start.eta * start.eta
    excess = (height * height + speed * speed - deepest * deepest) / (2 * deepest)
    table = size * (1 - 5 * excess / (12 * size))
    mass = deepest * square * (1 - 5 * excess / (12 * deepest))
    lag = away + speed / (start.eta * height)
    near = 2 * excess / mass
    reach = near + 2 * excess / table
    turn = 2 * half_turn / eta.numerator
    passes = turn * turn - 2 * (lag * lag + reach)
    bent = (deepest + excess) * square * near / 2
    convex = size * (1 - near - lag * lag) + square * (deepest - bent)
    return passes, convex, table, mass

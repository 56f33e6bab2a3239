"""The inference rules: each turns a witness into a conclusion, or raises Unproved.

A rule's docstring is its theorem. Conclusions are recomputed from exact data by
`proofs.trusted.kernel.arithmetic`; the equations are the shared ones.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import Clock, Launch, clock, gap, launch, slope
from proofs.trusted.kernel.arithmetic import Dual, Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import TURN, Phase, Phases, Range, show_range
from proofs.trusted.parameters import Place
from proofs.trusted.slopes import Avoids, Impact, SlopeRange

COVER_BITS = 64
MAX_BITS = 4000
LATEST = 10**6
_ZERO = Fraction(0)


@dataclass(frozen=True)
class Motion:
    """The gap of all launches in `phases`, in the checker's arithmetic."""

    side: int
    eta: Fraction
    nu: Fraction
    phases: Range
    bits: int = COVER_BITS

    def start(self) -> Launch:
        """Return the launch states."""
        return self._launch(Enclosure.of(*self.phases, self.bits))

    def _launch(self, phi: Enclosure | Dual) -> Launch:
        return launch(self.side, self._eta(), rational(self.nu, self.bits), phi)

    def _eta(self) -> Enclosure:
        return rational(self.eta, self.bits)

    def clock(self, time: Range) -> Clock:
        """Return the time functions over an interval of times."""
        return clock(self._eta(), Enclosure.of(*time, self.bits))

    def gap(self, start: Launch, time: Range, order: int = 0) -> Enclosure:
        """Enclose a time derivative of the gap."""
        value = gap(start, self.clock(time), order)
        return value if isinstance(value, Enclosure) else rational(Fraction(value), self.bits)

    def falls(self, start: Launch, time: Range) -> bool:
        """Whether gap' < 0 on an interval of times."""
        return falls(partial(self.gap, start), time)

    def _fall(self, start: Launch, time: Range) -> Enclosure:
        """Enclose gap' on an interval of times, directly and by the mean value theorem."""
        direct = self.gap(start, time, 1)
        return direct.meet(Enclosure.of(*fall(partial(self.gap, start), time), self.bits))

    def slope(self, time: Range) -> Enclosure:
        """Enclose f' for impacts at times in `time`."""
        start = self.start()
        value: Enclosure = slope(start, self.clock(time), self._fall(start, time))
        return value

    def curvature(self, time: Range) -> Enclosure:
        """Enclose f'': the derivative of the slope along (phi + s, t + (f' - 1) s)."""
        start, now = self.start(), self.clock(time)
        one, down = rational(Fraction(1), self.bits), self._fall(start, time)
        faster = slope(start, now, down) - 1
        moved = self._launch(Dual(Enclosure.of(*self.phases, self.bits), one))
        change = gap(moved, now, 1).derivative + self.gap(start, time, 2) * faster
        later = clock(self._eta(), Dual(Enclosure.of(*time, self.bits), faster))
        bent: Dual = slope(moved, later, Dual(down, change))
        return bent.derivative


@dataclass(frozen=True)
class FirstImpact(Conclusion):
    """Every launch in motion.phases has its first impact, at a time in one of `windows`."""

    at: Place
    motion: Motion
    windows: tuple[Range, ...]
    transversal: bool

    @property
    def sentence(self) -> str:
        """Return the statement."""
        times = ", ".join(show_range(window) for window in self.windows)
        kind = "transversal first" if self.transversal else "first"
        return (
            f"every launch from a phase in {show_range(self.motion.phases)} has its {kind} impact "
            f"at a time in {times}."
        )


Gap = Callable[[Range, int], Enclosure]


def read_phases(reader: Reader) -> Range:
    """Read an interval of phases from 0 to 2 pi, one phase as well."""
    low, high = reader.range()
    if low < 0 or high > TURN:
        raise reader.fail("phases lie between 0 and 2 pi")
    return low, high


def first_impact(context: Context, reader: Reader) -> FirstImpact:
    """Rule `first-impact`: {phases, times 0 < t_1 < ... < t_n}.

    Hypotheses: gap'' > 0 on phases x [0, t_1]; gap < 0 at t_n. A piece [t_j, t_(j+1)] of width
    w is closed if min(gap(t_j), gap(t_(j+1))) > w^2/8 max(0, sup gap'') on it, else open.
    Conclusion: since gap = gap' = 0 at launch, gap > 0 on (0, t_1]; by the error of linear
    interpolation gap > 0 on closed pieces; so each launch has a first impact, in an open piece.
    It is transversal (unique, smooth in the phase) if the open pieces are one interval that ends
    at t_n, with gap' < 0 on it.
    """
    phases_of, times_of = reader.fields("phases", "times")
    times = times_of.numbers(least=2)
    if times[-1] > LATEST:
        raise times_of.fail(f"times beyond {LATEST} are not examined")
    if any(now <= before for before, now in zip((_ZERO, *times), times, strict=False)):
        raise times_of.fail("times must increase from 0")
    # a piece of width w has gaps of the order w^2: as many bits again as the shortest needs
    shortest = min(now - before for before, now in zip((_ZERO, *times), times, strict=False))
    bits = min(MAX_BITS, COVER_BITS + 2 * (1 / shortest).__ceil__().bit_length())
    of = context.of
    motion = Motion(1 if of.nu > 0 else -1, of.eta, of.nu, read_phases(phases_of), bits)
    start = motion.start()
    gap_of = partial(motion.gap, start)
    if gap_of((_ZERO, times[0]), 2).lo <= 0:
        raise Unproved("the launches are not proved to leave the table")
    windows = open_windows(gap_of, times)
    single = len(windows) == 1 and windows[0][1] == times[-1]
    transversal = single and motion.falls(start, windows[0])
    return FirstImpact(of.place, motion, tuple(windows), transversal)


def open_windows(gap_of: Gap, times: Sequence[Fraction]) -> list[Range]:
    """Return the runs of open pieces of [times[0], times[-1]]; gap < 0 must hold at the end.

    gap_of(interval of times, order) encloses derivatives of the gap of the flights in question.
    """
    windows: list[Range] = []
    value = gap_of((times[0], times[0]), 0)
    for before, now in pairwise(times):
        following = gap_of((now, now), 0)
        bend = max(_ZERO, gap_of((before, now), 2).range[1]) * (now - before) ** 2 / 8
        if min(value.range[0], following.range[0]) <= bend:
            begin = windows.pop()[0] if windows and windows[-1][1] == before else before
            windows.append((begin, now))
        value = following
    if value.hi >= 0:
        raise Unproved("the gap is not proved negative at the last time")
    return windows


def fall(gap_of: Gap, time: Range) -> Range:
    """Enclose gap' on an interval of times: mean value theorem from either end."""
    width, bend = time[1] - time[0], gap_of(time, 2).range
    down, up = min(bend[0], _ZERO) * width, max(bend[1], _ZERO) * width
    first, last = (gap_of((t, t), 1).range for t in time)
    return max(first[0] + down, last[0] - up), min(first[1] + up, last[1] - down)


def falls(gap_of: Gap, time: Range) -> bool:
    """Whether gap' < 0 on an interval of times."""
    return fall(gap_of, time)[1] < 0


def transversal_step(context: Context, name: Reader, phases: Range) -> FirstImpact:
    """Return the transversal first-impact step of that name, which must contain `phases`."""
    step = context.step(name, FirstImpact)
    if not step.transversal:
        raise Unproved("the first impact is not transversal")
    if phases[0] < step.motion.phases[0] or phases[1] > step.motion.phases[1]:
        raise name.fail("the step is about other phases")
    return step


def bits_for(time: Range) -> int:
    """Return the precision that a bracket of this width deserves."""
    width = time[1] - time[0]
    if width == 0:
        raise Unproved("an empty bracket")
    return min(MAX_BITS, max(COVER_BITS, (1 / width).__ceil__().bit_length() + 40))


def bracketed(step: FirstImpact, phases: Range, time_of: Reader) -> tuple[Motion, Range]:
    """Return the motion, and the bracket read: all launches in `phases` have their impacts there.

    In the window of a transversal impact the gap falls through its only zero, so gap > 0 at the
    lower end and gap < 0 at the upper one bracket it.
    """
    time, window, motion = time_of.range(), step.windows[0], step.motion
    if time[0] < window[0] or time[1] > window[1]:
        raise Unproved("a bracket leaves the window of the first impact")
    bits = bits_for(time)
    for factor in (1, 2, 4):  # a slow impact needs more
        precision = min(factor * bits, MAX_BITS)
        inner = Motion(motion.side, motion.eta, motion.nu, phases, precision)
        start = inner.start()
        low, high = (inner.gap(start, (t, t)) for t in time)
        if low.lo > 0 > high.hi:
            return inner, time
    raise Unproved("a bracket does not have the signs +, - at its ends")


def whole_turns(count: int, bits: int) -> Range:
    """Enclose count 2 pi."""
    return (pi(bits) * (2 * count)).range


def phase_after(phase: Fraction, time: Range, bits: int) -> Range:
    """Enclose phase + time, less the multiple of 2 pi that puts its lower end in [0, 2 pi).

    The upper end may lie beyond 2 pi.
    """
    total = phase + time[0]
    count = total // whole_turns(1, bits)[0]
    if total < whole_turns(count, bits)[1]:  # the multiple is not decided: take the smaller one
        count -= 1
    low, high = whole_turns(count, bits)
    return total - high, phase + time[1] - low


def point(context: Context, reader: Reader) -> Impact:
    """Rule `point`: {flight, phase, time}: a bracket of one launch's transversal first impact.

    Conclusion: f'(phase) and f(phase), from the slope formula and phase + time.
    """
    flight, phase_of, time_of = reader.fields("flight", "phase", "time")
    phase = phase_of.number()
    step = transversal_step(context, flight, (phase, phase))
    motion, time = bracketed(step, (phase, phase), time_of)
    image = Phase(*phase_after(phase, time, motion.bits))
    return Impact(step.at, phase, motion.slope(time).range, image)


def slope_range(context: Context, reader: Reader) -> SlopeRange:
    """Rule `slope-range`: {points: [{flight, phase, time}], pieces: [{flight, time}]}.

    Hypotheses: phases x_0 < ... < x_n with brackets; for every piece [x_i, x_(i+1)] a transversal
    first-impact step that contains it, and a bracket for all its launches. Conclusion: f is C^1
    on each piece, hence on [x_0, x_n] (at a shared end the first impact is the same), and with
    f'' enclosed over a piece of width w, f' lies in both f'(x_i) + f'' [0, w] and
    f'(x_(i+1)) - f'' [0, w] (mean value theorem).
    """
    points_of, pieces_of = reader.fields("points", "pieces")
    entries = points_of.items(least=2)
    facts = [point(context, entry) for entry in entries]
    pieces = []
    for index, entry in enumerate(pieces_of.items(len(facts) - 1, len(facts) - 1)):
        flight, time_of = entry.fields("flight", "time")
        left, right = facts[index], facts[index + 1]
        if left.phase >= right.phase:
            raise points_of.fail("phases must increase")
        phases = (left.phase, right.phase)
        motion, time = bracketed(transversal_step(context, flight, phases), phases, time_of)
        low, high = motion.curvature(time).range
        width = right.phase - left.phase
        fall, rise = min(_ZERO, low) * width, max(_ZERO, high) * width
        pieces.append(
            (
                max(left.slope[0] + fall, right.slope[0] - rise),
                min(left.slope[1] + rise, right.slope[1] - fall),
            )
        )
    return SlopeRange(
        facts[0].at,
        tuple(fact.phase for fact in facts),
        tuple(fact.slope for fact in facts),
        tuple(fact.image for fact in facts),
        tuple(pieces),
    )


def avoids(context: Context, reader: Reader) -> Avoids:
    """Rule `avoids`: {flights, target}: first-impact steps whose phases follow one another.

    Hypothesis: for each step and each of its windows, phases + window misses target + 2 pi k
    for every k. Conclusion: no phase of the union has its first impact in the target.
    """
    flights_of, target_of = reader.fields("flights", "target")
    target = read_phases(target_of)
    steps: list[FirstImpact] = []
    for name in flights_of.items(least=1):
        step = context.step(name, FirstImpact)
        if steps and step.motion.phases[0] != steps[-1].motion.phases[1]:
            raise name.fail("its phases do not continue those of the step before")
        steps.append(step)
        for window in step.windows:
            if _meets(step.motion.phases, window, target):
                raise Unproved(f"a window of {name.string()} is not proved to miss the target")
    phases = Phases(steps[0].motion.phases[0], steps[-1].motion.phases[1])
    return Avoids(steps[0].at, phases, Phases(*target))


def _meets(phases: Range, time: Range, target: Range) -> bool:
    """Return False only if phases + time is proved to miss target + 2 pi k for every k."""
    arrival = (phases[0] + time[0], phases[1] + time[1])
    count = (
        arrival[0] // whole_turns(1, COVER_BITS)[0] - 1
    )  # target + 2 pi k for lower k lies before
    while True:
        low, high = whole_turns(count, COVER_BITS)
        if arrival[1] < low + target[0]:
            return False
        if arrival[0] <= high + target[1]:
            return True
        count += 1

"""Rules: sticking, flights that never end, and how much of the circle ends up sticking."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import launch_acceleration
from proofs.trusted.flights import FirstImpact, Motion, phase_after
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s34_circle.absorption import Cell, absorbed, cells_met, links, with_gaps
from proofs.trusted.paper.s34_circle.entropy import Branch
from proofs.trusted.paper.s34_circle.landing import (
    Absorption,
    Lands,
    NeverImpacts,
    Separation,
    closest_approach,
)
from proofs.trusted.parameters import Parameters
from proofs.trusted.windows import BITS, clear, falls, level

BRACKET = Fraction(1, 2**26)  # the width of the time brackets in the rule `absorption`
_MOST_STEPS = 400
_MAX_BITS = 2000
_THREE = 3  # less than pi
_EARLIER = Fraction(1, 4)


def _motion(of: Parameters, phases: Range, bits: int = BITS) -> Motion:
    """Return the flights from some phases, for -1 < nu < 0 and eta < 1."""
    if not (-1 < of.nu < 0 < of.eta < 1):
        raise Unproved("sticking is examined for -1 < nu < 0 and eta < 1 only")
    return Motion(-1, of.eta, of.nu, phases, bits)


def _acceleration(motion: Motion) -> Enclosure:
    value: Enclosure = launch_acceleration(motion.start())
    return value


def separation(context: Context, reader: Reader) -> Separation:
    """Rule `separation`: {phase: [l, u], time: [v, w]}, for -1 < nu < 0 and eta < 1.

    Hypotheses: 3 pi/2 < l, u < 2 pi; the launch acceleration A is < 0 at l, > 0 at u. After every
    launch in [l, u] gap > 0 from the time 5 pi - 2 u to v - 1/4, gap' < 0 from there to w, and
    gap > 0 at v, < 0 at w. Conclusion: `Separation`.

    Proof. A increases with sin(phi), and sin increases on (3 pi/2, 2 pi): there is one zero phi_s
    in (l, u), and on the circle A < 0 exactly where sin(phi) < sin(phi_s), on
    (3 pi - phi_s, phi_s). After phi_s, A > 0 up to the phase 5 pi - phi_s, and so is the gap, see
    `lands`; then it falls to its first zero, in (v, w).
    """
    phase_of, time_of = reader.fields("phase", "time")
    phase, time = phase_of.range(), time_of.range()
    width = min(phase[1] - phase[0], time[1] - time[0])
    if width <= 0:
        raise Unproved("an empty bracket")
    bits = min(_MAX_BITS, max(BITS, 2 * (1 / width).__ceil__().bit_length() + 40))
    half, two = (pi(bits) * 3).range, (pi(bits) * 2).range
    if not (half[1] < 2 * phase[0] and phase[1] < two[0]):
        raise Unproved("the separation phase is sought between 3 pi/2 and 2 pi")
    ends = [_acceleration(_motion(context.of, (x, x), bits)) for x in phase]
    if not ends[0].hi < 0 < ends[1].lo:
        raise Unproved("the launch acceleration does not change sign in the bracket")
    arc = half[0] - phase[1], half[1] - phase[0]
    motion = _motion(context.of, phase)
    leaves = arc[0] - (phase[1] - two[0])
    if not (0 < leaves < time[0] - _EARLIER and context.of.eta * leaves < _THREE):
        raise Unproved("the first time of the flight is not examined")
    clear(motion, (leaves, time[0] - _EARLIER), time_of)
    falls(motion, (time[0] - _EARLIER, time[1]), time_of)
    fine = _motion(context.of, phase, bits)
    early, late = (fine.gap(fine.start(), (t, t)) for t in time)
    if not early.lo > 0 > late.hi:
        raise Unproved("the impact after separation is not bracketed")
    low, high = phase_after(phase[0], (time[0], time[1] + phase[1] - phase[0]), bits)
    return Separation(arc, phase, time, (low, high))


def _lifted(ends: Range, turns: int) -> Range:
    """Add 2 pi turns to an enclosure."""
    low, high = (pi(BITS) * (2 * turns)).range
    return ends[0] + low, ends[1] + high


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
    if any(high <= low for low, high in pairwise(cuts)):
        raise cuts_of.fail("phases must increase")
    first = _lifted(arc.phase if turns == 0 else arc.start, -1)[1]
    last = arc.phase[0] if turns == 0 else arc.start[0]
    if cuts[0] < first or cuts[-1] > last or context.of.eta * (arc.phase[1] - cuts[0]) >= _THREE:
        raise Unproved("the launches are not proved to stay up until the sticking arc")
    if turns == 0:
        motion = _motion(context.of, (cuts[0], cuts[0]))
        time = arc.phase[0] - cuts[0]
        if motion.gap(motion.start(), (time, time)).hi >= 0:
            raise Unproved("the gap is not negative at the end of the sticking arc")
        return Lands((cuts[0], cuts[-1]))
    start, end = _lifted(arc.start, int(turns)), _lifted(arc.phase, int(turns))
    for low, high in pairwise(cuts):
        if end[0] - high <= start[1] - low:
            raise Unproved("a piece is longer than the sticking arc")
        motion = _motion(context.of, (low, high))
        clear(motion, (arc.start[0] - high, start[1] - low), reader)
        if level(motion, end[0] - high)[1] >= 0:
            raise Unproved("the gap is not negative at the end of the sticking arc")
    return Lands((cuts[0], cuts[-1]))


def never_impacts(context: Context, reader: Reader) -> NeverImpacts:
    """Rule `never-impacts`: {phases}, for -1 < nu < 0 and eta = p/q in lowest terms.

    Hypotheses: all phases are in (0, 3), and `closest_approach` gives positive numbers for them.
    Conclusion: `NeverImpacts`.
    """
    (phases_of,) = reader.fields("phases")
    phases = phases_of.range()
    if not 0 < phases[0] <= phases[1] < _THREE:
        raise phases_of.fail("phases between 0 and 3 are expected")
    motion = _motion(context.of, phases)
    start = motion.start()
    away = Enclosure.of(*phases, BITS) - pi(BITS) / 2
    bounds = closest_approach(context.of.eta, rational(context.of.nu, BITS), start, away, pi(BITS))
    if any(bound.lo <= 0 for bound in bounds):
        raise Unproved("an impact is not excluded")
    return NeverImpacts(phases)


def absorption(context: Context, reader: Reader) -> Absorption:
    """Rule `absorption`: {separation, lands, impacts, cells: [{branch, cuts, times, after}], rest,
    within}.

    Hypotheses: the phases of the `lands` steps, of the `first-impact` steps, and of cells between
    the cuts of each branch do not overlap, and lie on a line that reaches from before the
    separation phase, less 2 pi, to beyond the start of the sticking arc; at each cut the gap is
    > 0 at the time given and < 0 by 2^-26 later, both in the window of the branch, which begins at
    `after` if gap > 0 then; sin(eta t) has one sign there. rest: bounds of what `absorbed` leaves
    after 0, 1, ... steps; within: [low, high, n] such that all cells in [low, high] are absorbed
    within n. Conclusion: `Absorption`.

    Proof. f' = (sin(eta t) / eta) A / gap' has one sign on a branch, so that f is monotone there
    and a cell's images lie between those of its ends; those of a `first-impact` step are in its
    windows. Phases between cells form cells of which nothing is known. Then `absorbed` applies.
    """
    separation_of, lands_of, impacts_of, cells_of, rest_of, within_of = reader.fields(
        "separation", "lands", "impacts", "cells", "rest", "within"
    )
    arc = context.step(separation_of, Separation)
    cells = [Cell(context.step(name, Lands).phases, ()) for name in lands_of.items(least=2)]
    cells.sort(key=lambda cell: cell.phases)
    origin, end = cells[0].phases[0], cells[-1].phases[1]
    if origin > _lifted(arc.phase, -1)[0] or end < arc.start[1]:
        raise Unproved("the cells do not reach the sticking arc on both sides")
    for name in impacts_of.items():
        cells.append(_whole(context.step(name, FirstImpact), origin))
    for entry in cells_of.items():
        cells += _cells(context, entry, origin)
    cells.sort(key=lambda cell: cell.phases)
    rest, claimed = rest_of.numbers(1, _MOST_STEPS), within_of.items()
    cells = with_gaps(cells)
    try:
        met = links(cells)
    except ValueError as error:
        raise cells_of.fail(str(error)) from None
    found = absorbed(cells, met, len(rest) - 1)
    if any(own > given for own, given in zip(found.rest, rest, strict=True)):
        raise Unproved("more may be left than is said")
    within = []
    for item in claimed:
        low, high, steps = item.numbers(3, 3)
        counts = [found.steps[i] for i, common in cells_met(cells, (low, high)) if common > 0]
        if not origin <= low < high <= end or any(n is None or n > steps for n in counts):
            raise Unproved("a phase is not proved to be absorbed so soon")
        within.append(((low, high), int(steps)))
    return Absorption(rest, tuple(within))


def _cells(context: Context, reader: Reader, origin: Fraction) -> list[Cell]:
    """Read and prove the cells of one branch."""
    branch_of, cuts_of, times_of, after_of = reader.fields("branch", "cuts", "times", "after")
    branch = context.step(branch_of, Branch)
    cuts = cuts_of.numbers(2)
    times = times_of.numbers(len(cuts), len(cuts))
    if cuts[0] < branch.cuts[0] or cuts[-1] > branch.cuts[-1]:
        raise cuts_of.fail("cuts outside the branch")
    if any(high <= low for low, high in pairwise(cuts)):
        raise cuts_of.fail("phases must increase")
    window = after_of.number(), max(branch.ends)
    if not branch.begin <= window[0] < min(branch.ends):
        raise Unproved("the window of the first impact begins later, or ends before")
    for phases in pairwise(cuts) if window[0] > branch.begin else ():
        if level(_motion(context.of, phases), window[0])[0] <= 0:
            raise Unproved("an impact before the time given is not excluded")
    along = _motion(context.of, (cuts[0], cuts[-1])).clock(window).mass_sin
    if along.lo <= 0 <= along.hi:
        raise Unproved("f' is not proved to have one sign on a branch")
    images = [_image(context.of, branch, window[0], x, t) for x, t in zip(cuts, times, strict=True)]
    cells = []
    for phases, ends in zip(pairwise(cuts), pairwise(images), strict=True):
        low, high = min(ends[0][0], ends[1][0]), max(ends[0][1], ends[1][1])
        flight = max(window[0], low - phases[1]), min(window[1], high - phases[0])
        stretch = _stretch(_motion(context.of, phases), flight)
        cells.append(Cell(phases, tuple(_reduced((low, high), origin)), stretch))
    return cells


def _whole(found: FirstImpact, origin: Fraction) -> Cell:
    """Return the phases of a `first-impact` step as one cell."""
    low, high = found.motion.phases
    images = (_reduced((low + t, high + u), origin) for t, u in found.windows)
    return Cell((low, high), tuple(image for pair in images for image in pair))


def _image(
    of: Parameters, branch: Branch, after: Fraction, phase: Fraction, time: Fraction
) -> Range:
    """Return phase + impact time, bracketed by the signs of the gap in the branch's window."""
    piece = max(0, bisect_left(branch.cuts, phase) - 1)
    later = time + BRACKET
    if time < after or later > branch.ends[piece]:
        raise Unproved("a bracket leaves the window of the first impact")
    motion = _motion(of, (phase, phase))
    start = motion.start()
    if not motion.gap(start, (time, time)).lo > 0 > motion.gap(start, (later, later)).hi:
        raise Unproved("a bracket does not have the signs +, - at its ends")
    return phase + time, phase + later


def _stretch(motion: Motion, time: Range) -> Fraction | None:
    """Bound 1/|f'| = |gap'| / |(sin(eta t) / eta) A|; None where that may vanish."""
    start = motion.start()
    now = motion.clock(time)
    along = now.mass_sin / rational(motion.eta, motion.bits) * _acceleration(motion)
    if along.lo <= 0 <= along.hi:
        return None
    ratio: Enclosure = motion.gap(start, time, 1) / along
    return max(-ratio.range[0], ratio.range[1])


def _reduced(image: Range, origin: Fraction) -> Iterator[Range]:
    """Yield the images, less multiples of 2 pi, that meet [origin, origin + 2 pi]."""
    turn = (pi(BITS) * 2).range
    if image[1] - image[0] >= turn[0]:
        raise Unproved("a cell's image is longer than the circle")
    count = (image[0] - origin) // turn[1] - 1
    for turns in range(int(count), int(count) + 4):
        low, high = _lifted(image, -turns)
        if high >= origin and low <= origin + turn[1]:
            yield low, high

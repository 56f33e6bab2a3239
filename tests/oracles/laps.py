"""Judges of what is said of the circle's pieces: grazes, monotone f, entropy."""

from fractions import Fraction
from itertools import pairwise

import flint
import numpy as np

from tests.oracles.motion import (
    PRECISION,
    TURN,
    Gap,
    Impact,
    _Balls,
    ball,
    flight,
    inside,
    next_impact,
    sticks,
)
from tests.oracles.plastic import between, lifted

_LONG = 70_000.0
_TINY = Fraction(1, 10**30)


def graze(view):
    """Phase and time with gap = gap' = 0, by Newton's method, dgap/dphi by a difference."""
    with flint.ctx.workprec(PRECISION):
        phase, time = (ball(between(x, Fraction(1, 2))) for x in (view.phases, view.time))
        step = ball(_TINY)
        for _ in range(8):
            here = Gap(_Balls, view.eta, view.nu, phase.mid(), 0, 0).at(time.mid())
            beside = Gap(_Balls, view.eta, view.nu, phase.mid() + step, 0, 0).at(time.mid())
            (a, c), (b, d) = (
                ((y - x) / step, z) for x, y, z in zip(here, beside, here[1:], strict=False)
            )
            total = a * d - b * c
            phase = phase.mid() - (here[0] * d - here[1] * c) / total
            time = time.mid() - (a * here[1] - b * here[0]) / total
        return phase, time, abs(a), here[2]


def grazing(view, rng):
    """Where the graze is, the coefficient of the square root, and where f leads on both sides."""
    told = []
    with flint.ctx.workprec(PRECISION):
        phase, time, steep, bend = graze(view)
        root = (2 * steep / bend).sqrt()
        for name, own, given in (
            ("phase", phase, view.phases),
            ("time", time, view.time),
            ("root", root, view.root),
        ):
            if not inside(own, given):
                told.append(f"the {name} of the graze is {own.str(12)}")
    near, far = view.phases if view.below else view.phases[::-1]
    for launch, window, turn in ((near, None, view.turn), (far, view.landing, view.beyond)):
        found = flight(view.eta, view.nu, launch, latest=_LONG)
        if found == "touches":
            if window is not None or turn != Fraction(view.eta).denominator:
                told.append(f"no impact after {float(launch):.12g}")
        elif isinstance(found, Impact):
            if abs((float(found.lifted) - TURN / 4) / TURN - turn) > 0.7:
                told.append(f"the impact after {float(launch):.12g} is not in turn {turn}")
            if (launch == near) is not (found.time < ball(view.time[1])):
                told.append(f"the impact after {float(launch):.12g} is on the wrong side")
            if launch == far and (window is None or not inside(found.time, window)):
                told.append(f"the impact after {float(launch):.12g} is at {found.time.str(12)}")
            if (found.slope > 0) is not view.below:
                told.append(f"f' at {float(launch):.12g} has the other sign")
    return told


def _branches(view):
    return [part for part in view.arcs if part.kind == "Branch"]


def pieces(view, rng):
    """What is outside J comes to the arc at once; in J, pieces with one sign of f' up to grazes."""
    told, ends = [], [part.phases for part in view.arcs]
    low, high = view.region
    for _ in range(6):
        phase = high + (low + Fraction(TURN) - high) * Fraction(rng.random())
        found = next_impact(view.eta, view.nu, phase, _LONG)
        stays = isinstance(found, Impact) and not sticks(view.eta, view.nu, found.phase)
        if stays and not sticks(view.eta, view.nu, phase):
            told.append(f"{float(phase) % TURN:.9g} does not lead to the arc at once")
    if ends[0][0] > low or ends[-1][1] < high:
        told.append("the parts do not reach the ends of J")
    if any(b[0] > a[1] or b[0] <= a[0] for a, b in pairwise(ends)):
        told.append("the parts leave phases out, or are not in order")
    if [part.kind == "Grazing" for part in view.arcs] != [i % 2 == 1 for i in range(len(ends))]:
        told.append("parts without and with a graze do not take turns")
    for part in rng.sample(_branches(view), min(6, len(_branches(view)))):
        slopes = [
            found.slope > 0
            for share in (0, rng.random(), rng.random(), 1)
            if isinstance(
                found := flight(
                    view.eta, view.nu, between(part.phases, Fraction(share)), latest=_LONG
                ),
                Impact,
            )
        ]
        if len(set(slopes)) > 1:
            told.append(f"f' changes its sign on [{part.phases[0]}, {part.phases[1]}]")
    return told


def entropy_range(view, rng):
    """Bounds of the logarithm; the growth is no less than that of the branches mapped over others.

    Of the pieces i, j with f(i) over j the spectral radius is that of words that do occur.
    """
    told = pieces(view.pieces, rng)
    with flint.ctx.workprec(PRECISION):
        logs = ball(view.lower.growth).log(), ball(view.growth).log()
        if logs[0] < ball(view.entropy[0]) or logs[1] > ball(view.entropy[1]):
            told.append("the entropy may lie outside")
    parts = _branches(view.pieces)
    ends = [tuple(map(float, part.phases)) for part in parts]
    images = []
    for part in parts:
        pair = [lifted(view, phase, _LONG) for phase in part.phases]
        if None in pair:
            return told
        low, high = min(pair), max(pair)
        turns = round((low + high) / 2 / TURN - 0.25)
        images.append((low - turns * TURN, high - turns * TURN))
    matrix = np.array([[float(a <= c and d <= b) for c, d in ends] for a, b in images])
    radius = max(abs(np.linalg.eigvals(matrix)))
    if float(view.growth) < radius - 1e-9 or view.growth < view.lower.growth:
        told.append(f"growth below {radius:.6g}, that of words that occur")
    return told


def expansion(view, rng):
    """Lengths times the pieces' scales grow by the rate, at the ends of branches and in between."""
    at, told = view.pieces, pieces(view.pieces, rng)
    parts = _branches(at)
    if len(parts) != len(view.scales) or not min(view.scales) > 0 or not view.rate > 1:
        return [*told, "no scales > 0, or no rate > 1"]
    for part, scale in zip(parts, view.scales, strict=True):
        for share in (0, Fraction(rng.random()), 1):
            found = flight(at.eta, at.nu, between(part.phases, share), latest=_LONG)
            if not isinstance(found, Impact):
                continue
            for other, target in zip(parts, view.scales, strict=True):
                inside_it = float(other.phases[0]) < found.phase < float(other.phases[1])
                size = abs(float(found.slope)) * float(target / scale)
                if inside_it and size < float(view.rate) * (1 - 1e-9):
                    told.append(f"lengths near f = {found.phase:.9g} grow by {size:.6g} only")
    return told


def coding(view, rng):
    """An expansion and an entropy range, about the same pieces."""
    told = [*expansion(view.expansion, rng), *entropy_range(view.entropy, rng)]
    one, two = (
        [part.phases for part in each.pieces.arcs] for each in (view.expansion, view.entropy)
    )
    return told if one == two else [*told, "two different partitions of the circle"]


def _on_line(found):
    """The phase of an impact, on the line around pi/2."""
    return (float(found.lifted) + TURN / 4) % TURN - TURN / 4


def _closes(view, parts):
    """Whether Newton's method, backwards, finds a periodic orbit through branches."""
    ends = [tuple(map(float, part.phases)) for part in parts]
    phases = [(low + high) / 2 for low, high in ends]
    moved = [1.0] * len(phases)
    for _ in range(40):
        for k in reversed(range(len(phases))):
            found = flight(view.eta, view.nu, Fraction(phases[k]), latest=_LONG)
            if not isinstance(found, Impact):
                return None
            off = phases[(k + 1) % len(phases)] - _on_line(found)
            new = min(max(phases[k] + off / float(found.slope), ends[k][0]), ends[k][1])
            phases[k], moved[k] = new, abs(off)
    return max(moved) < 1e-6


def cycles(view, rng):
    """One fixed point in each branch that crosses the diagonal; orbits for some of the words."""
    told, parts = expansion(view.expansion, rng), _branches(view.expansion.pieces)
    crossing = 0
    for part in parts:
        found = [flight(view.eta, view.nu, phase, latest=_LONG) for phase in part.phases]
        if all(isinstance(each, Impact) for each in found):
            off = [_on_line(each) - float(x) for each, x in zip(found, part.phases, strict=True)]
            crossing += off[0] * off[1] < 0
    low, high = view.counts[0]
    if not low <= crossing <= high:
        told.append(f"{crossing} branches cross the diagonal")
    rotations = [{w[i:] + w[:i] for i in range(len(w))} for w in (*view.words, *view.left)]
    if sum(map(len, rotations)) != len(set().union(*rotations)):
        told.append("a word twice, up to rotation")
    for word in rng.sample(view.words, min(4, len(view.words))):
        if max(word) >= len(parts) or _closes(view, [parts[i] for i in word]) is False:
            told.append(f"no orbit is seen to follow {word}")
    return told


def narrow(view, rng):
    """Grazes as they are said to be, and f between them, seen close to its ends, as is told."""
    told = []
    for one in view.grazes:
        told += grazing(one, rng)
    for (low, high), one, two in zip(view.images, view.grazes, view.grazes[1:], strict=False):
        for phase, (least, most) in ((one.phases[1], low), (two.phases[0], high)):
            beside = phase + (1 if phase == one.phases[1] else -1) * Fraction(1, 10**13)
            found = flight(view.eta, view.nu, beside, latest=_LONG)
            seen = isinstance(found, Impact)
            if seen and not float(least) - 1e-4 < _on_line(found) < float(most) + 1e-4:
                told.append(f"f({float(phase):.12g}) is {_on_line(found):.9g}")
    for m in range(1, view.full + 1):
        (low, _), (_, high) = view.images[m - 1]
        if low > view.grazes[0].phases[0] or high < view.grazes[view.full].phases[1]:
            told.append(f"piece {m} is not mapped over the first {view.full}")
    return told

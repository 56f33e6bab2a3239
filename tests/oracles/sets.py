"""Judges of conclusions about Cantor sets and dimensions (section 3.2)."""

from fractions import Fraction
from itertools import pairwise

import flint
import numpy as np
from numpy.polynomial import chebyshev

from tests.oracles.motion import TURN, ball, inside
from tests.oracles.plastic import between, lifted

_DEGREE = 22


def moran_sum(ratios, s):
    """r0^s + r1^s - 1."""
    return sum((ball(ratio) ** s for ratio in ratios), flint.arb(-1))


def moran_root(view, rng):
    """The sum, which decreases, changes its sign in the bracket."""
    if not all(0 < ratio < 1 for ratio in view.ratios):
        return ["a ratio is not between 0 and 1: no root, or none > 0"]
    with flint.ctx.workprec(400):
        low, high = (moran_sum(view.ratios, ball(s)) for s in view.root)
        return [] if view.root[0] > 0 and not low < 0 and not high > 0 else ["not the root"]


def _root(ratios):
    low, high = flint.arb(0), flint.arb(1)
    while moran_sum(ratios, high) > 0:
        high *= 2
    for _ in range(200):
        middle = ((low + high) / 2).mid()
        low, high = (middle, high) if moran_sum(ratios, middle) > 0 else (low, middle)
    return (low + high) / 2


def linear_set(view, rng):
    """There is a linear set only if the ratios sum to less than 1."""
    told = moran_root(view, rng)
    if sum(view.ratios) >= 1:
        told.append("no linear Cantor set: the ratios sum to 1 or more")
    if not told and view.interval:
        with flint.ctx.workprec(400):
            measure = ball(view.interval[1] - view.interval[0]) ** _root(view.ratios)
            if not inside(measure, view.measure):
                told.append(f"|I|^s is {measure.str(20)}")
    return told


def no_gap(view, rng):
    """The ratios leave no gap."""
    return [] if min(view.ratios) > 0 and sum(view.ratios) >= 1 else ["there is a gap"]


def gap_function(view, rng):
    """q(x) = ((1 - r1)/r0 + x)^s - 1 - x^s decreases and vanishes at r1/r0."""
    first, second = view.ratios
    if not 0 < min(view.ratios) <= max(view.ratios) < 1:
        return ["a ratio is not between 0 and 1"]
    with flint.ctx.workprec(200):
        s = _root(view.ratios)
        places = [ball(second / first), *(ball(Fraction(k, 7)) for k in (1, 5, 30))]
        q = [(ball((1 - second) / first) + x) ** s - 1 - x**s for x in places]
        falls = q[1] > q[2] > q[3]
    return [] if falls and abs(q[0]) < 1e-30 else ["q does not decrease, or does not vanish"]


def _unit(printed):
    return Fraction("/" not in printed, 10 ** len(printed.partition(".")[2]))


def unlike(view, rng):
    """1/slope is not the decimal that is given, rounded."""
    places = 0
    while view.given * 10**places % 1 and places < 60:
        places += 1
    exact = places == 60
    near = abs(1 / view.slope - view.given) < (0 if exact else Fraction(1, 2 * 10**places))
    return ["it is that, rounded"] if near or 1 / view.slope == view.given else []


def digits(view, rng):
    """Which readings of printed digits hold, for both roots."""
    told, printed, unit = moran_root(view.given, rng) + moran_root(view.exact, rng), 0, 0
    printed, unit = ball(Fraction(view.printed)), _unit(view.printed)
    for each, given in zip((view.given, view.exact), view.readings, strict=True):
        s = _root(each.ratios)
        own = (abs(s - printed) < ball(unit / 2), bool(s >= printed) and s < printed + ball(unit))
        if any(x is not None and bool(y) != x for x, y in zip(given, own, strict=True)):
            told.append(f"s_0 is {s.str(12)}")
    return told


def excess(view, rng):
    """(|L| + d)^s - |L|^s - d for an interval L of the linear set."""
    if not all(0 < ratio < 1 for ratio in view.ratios) or sum(view.ratios) >= 1:
        return ["no linear Cantor set for these ratios"]
    length = view.interval[1] - view.interval[0]
    for letter in view.word:
        length *= view.ratios[int(letter)]
    with flint.ctx.workprec(400):
        s, d = _root(view.ratios), ball(view.epsilon / 2 ** len(view.word))
        found = (ball(length) + d) ** s - ball(length) ** s - d
        return [] if inside(found, view.excess) else [f"it is {found.str(15)}"]


def repeller(view, rng):
    """The dimension is where the transfer operator, on polynomials, has the eigenvalue 1."""
    branches = [_interpolated(view, domain) for domain in view.domains]
    if None in branches:
        return []
    low, high = map(float, view.hull)
    nodes = (low + high) / 2 + (high - low) / 2 * chebyshev.chebpts1(_DEGREE)
    told, images, rates = [], [], []
    for word, slopes in zip(view.words, view.slopes, strict=True):
        y, rate = np.array([low, high, *nodes]), 1.0
        for letter in reversed(word):
            y, slope = _inverse(branches[int(letter)], y)
            if y is None:
                return [f"no inverse branch for the word {word}"]
            rate = rate / slope
        images.append(y)
        rates.append(rate)
        if np.any(1 / rate < float(slopes[0]) - 1e-7) or np.any(1 / rate > float(slopes[1]) + 1e-7):
            told.append(
                f"slopes along {word} reach from {min(1 / rate):.9g} to {max(1 / rate):.9g}"
            )
    spans = sorted((min(y), max(y)) for y in images)
    if spans[0][0] < low - 1e-9 or spans[-1][1] > high + 1e-9:
        told.append("the inverse branches leave the hull")
    if any(b[0] <= a[1] for a, b in pairwise(spans)):
        told.append("the images of the inverse branches overlap")
    found = _dimension([y[2:] for y in images], [r[2:] for r in rates], nodes, (low, high))
    if not float(view.dimension[0]) - 1e-7 < found < float(view.dimension[1]) + 1e-7:
        told.append(f"the dimension is about {found:.9g}")
    return told


def _interpolated(view, domain):
    """f on a domain, on the line next to the hull, as a Chebyshev polynomial."""
    low, high = map(float, domain)
    places = [between(domain, Fraction(float(x + 1) / 2)) for x in chebyshev.chebpts1(_DEGREE)]
    values = [lifted(view, place) for place in places]
    if None in values:
        return None
    values = np.array(values)
    turns = np.round((np.median(values) - float(sum(view.hull)) / 2) / TURN)
    fit = chebyshev.Chebyshev.fit(
        [float(x) for x in places], values - TURN * turns, _DEGREE - 1, [low, high]
    )
    return fit, (low, high)


def _inverse(branch, targets):
    """The points of the domain that f maps to the targets, f increasing, and f' there."""
    fit, (low, high) = branch
    if fit(low) > min(targets) + 1e-9 or fit(high) < max(targets) - 1e-9:
        return None, None
    a, b = np.full_like(targets, low), np.full_like(targets, high)
    for _ in range(50):
        middle = (a + b) / 2
        below = fit(middle) < targets
        a, b = np.where(below, middle, a), np.where(below, b, middle)
    return a, fit.deriv()(a)


def _dimension(images, rates, nodes, hull):
    scale = chebyshev.chebvander(2 * (nodes - hull[0]) / (hull[1] - hull[0]) - 1, _DEGREE - 1)
    basis = [
        chebyshev.chebvander(2 * (y - hull[0]) / (hull[1] - hull[0]) - 1, _DEGREE - 1)
        for y in images
    ]
    inverse = np.linalg.inv(scale)

    def eigenvalue(s):
        operator = sum((r**s)[:, None] * values for r, values in zip(rates, basis, strict=True))
        return max(np.linalg.eigvals(operator @ inverse).real)

    low, high = 0.0, 2.0
    for _ in range(34):
        middle = (low + high) / 2
        low, high = (middle, high) if eigenvalue(middle) > 1 else (low, middle)
    return low


JUDGES = {
    "MoranRoot": moran_root,
    "NoGap": no_gap,
    "GapFunction": gap_function,
    "Unlike": unlike,
    "Digits": digits,
    "LinearSet": linear_set,
    "Excess": excess,
    "Repeller": repeller,
}

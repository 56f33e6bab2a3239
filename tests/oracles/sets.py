"""Judges of conclusions about Cantor sets and dimensions (section 3.2)."""

import math
import re
from collections import Counter
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise, product
from types import SimpleNamespace

import flint
import numpy as np
from numpy.polynomial import chebyshev

from tests.oracles.motion import TURN, ball, inside
from tests.oracles.plastic import between, itinerary, lifted, staying_set

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


def exact_measure(view, rng):
    """Claim 1 for the linear set, (1) to (4) at random places; there is one only with a gap."""
    r0, r1 = view.ratios
    if not (0 < r0 <= r1 and r0 + r1 < 1 and view.interval[0] < view.interval[1]):
        return ["no linear Cantor set for these ratios"]
    told, s, k = [], float(_root(view.ratios)), float(1 - r0 - r1)
    r0, r1 = float(r0), float(r1)
    x, y = r0 * rng.random(), r1 * rng.random()
    if k < (1 - r0 - r1) * max(x / r0, y / r1) - 1e-12 or (x + k + y) ** s < x**s + y**s - 1e-12:
        told.append("(1) fails")
    q = [((1 - r1) / r0 + x) ** s - 1 - x**s for x in (0.1, 0.7, r1 / r0, 5 + r1 / r0)]
    if not (0 < s < 1 and q[0] > q[1] > q[3] and abs(q[2]) < 1e-9):
        told.append("(2) fails")
    level = [(0.0, 1.0)]
    for _ in range(rng.randint(1, 5)):
        parts = (((a, a + r0 * (b - a)), (b - r1 * (b - a), b)) for a, b in level)
        level = [part for pair in parts for part in pair]
    low, high = sorted(rng.choice((rng.random(), *rng.choice(level))) for _ in range(2))
    if (high - low) ** s < sum((b - a) ** s for a, b in level if low <= a < b <= high) - 1e-9:
        told.append("(3) fails")
    n, epsilon = rng.randint(0, 5), rng.random()
    more = min((epsilon / 2 ** (n + 1)) ** (1 / s), r1**n - r1 ** (n + 1))
    for size in (r0 ** (n + 1), r1 ** (n + 1)):
        if (
            size + more > r1**n + 1e-9
            or (size + more) ** s > size**s + epsilon / 2 ** (n + 1) + 1e-9
        ):
            told.append("(4) fails")
    return told


def linear_dimension(view, rng):
    """The same, with the root and the measure |I|^s."""
    told = exact_measure(view, rng) + moran_root(view, rng)
    if not told:
        with flint.ctx.workprec(400):
            measure = ball(view.interval[1] - view.interval[0]) ** _root(view.ratios)
            if not inside(measure, view.measure):
                told.append(f"|I|^s is {measure.str(20)}")
    return told


def no_gap(view, rng):
    """The ratios leave no gap."""
    return [] if min(view.ratios) > 0 and sum(view.ratios) >= 1 else ["there is a gap"]


def digits(view, rng):
    """Which readings of printed digits hold, of 1/slope or of the root for some ratios."""
    printed, unit = Fraction(view.printed), Fraction("/" not in view.printed)
    unit /= 10 ** len(view.printed.partition(".")[2])
    values = [ball(1 / Fraction(view.name[2:]))] if view.name.startswith("1/") else []
    if not values:
        pairs = {view.numbers.ratios, view.numbers.reciprocals}
        with flint.ctx.workprec(400):
            values = [_root(pair) for pair in pairs if max(pair) < 1]
    values = [x for x in values if inside(x, view.value)]
    if not values:
        return ["the bounds hold no such number"]
    told = []
    for x in values:
        near = abs(x - ball(printed)) < ball(unit / 2) or view.value == (printed,) * 2
        cut = (x >= ball(printed) and x < ball(printed + unit)) or view.value == (printed,) * 2
        known = zip(view.readings, (near, cut), strict=True)
        if any(given not in (None, bool(own)) for given, own in known):
            told.append(f"{view.name} is {x.str(12)}")
    return told


def _size(view, word):
    length = view.interval[1] - view.interval[0]
    for letter in word:
        length *= view.ratios[int(letter)]
    return length


def excess(view, rng):
    """(|L| + d)^s - |L|^s - d > 0 for all intervals L of some levels, d up to what (11) admits."""
    told, longest = exact_measure(view, rng), max(view.ratios)
    if told or view.level < 1:
        return told or ["(11) is about n >= 1"]
    with flint.ctx.workprec(400):
        s = _root(view.ratios)
        if not inside(s, view.root):
            told.append(f"the root is {s.str(15)}")
        for n in range(view.level, view.level + 3):
            for share in (Fraction(1, 10**6), Fraction(rng.random()), 1):
                word = rng.choice(("0", "1")) * (n + 1)
                d = ball(share * (longest**n - longest ** (n + 1)) / 2 ** (n + 1))
                length = ball(_size(view, word))
                if not (length + d) ** s - length**s - d > 0:
                    told.append(f"not so for n = {n}, I_{word} and epsilon/2^(n+1) = {d.str(9)}")
    return told


def short_gap(view, rng):
    """Of I_001, I_01 and the gap of I_0 between: the gap is shorter than is printed."""
    told, (r0, r1) = exact_measure(view, rng), view.ratios
    gap = _size(view, "0") - _size(view, "00") - _size(view, "01")
    sizes = [_size(view, "001"), _size(view, "01")]
    if not (gap < (1 - r0 - r1) / r0 * max(sizes) and gap == (1 - r0 - r1) / r1 * sizes[1]):
        told.append("the gap is not shorter")
    return told if sizes[1] >= sizes[0] else [*told, "I_001 is the longer one"]


# -- invariant sets of the map ---------------------------------------------------------------------


@lru_cache(maxsize=256)
def _periodic(eta, nu, left, right, most=6):
    """For all words up to a length, the points of I0 and I1 that follow them periodically."""
    hull, found = (left[0], right[1]), []
    about = SimpleNamespace(eta=eta, nu=nu, hull=hull)
    branches = [_interpolated(about, part) for part in (left, right)]
    for n in range(1, most + 1 if None not in branches else 0):
        words = ["".join(letters) for letters in product("01", repeat=n)]
        x, orbit = np.full(len(words), float(hull[0])), []
        for k in range(24 + n):
            both = [_inverse(branch, x)[0] for branch in branches]
            if both[0] is None or both[1] is None:
                return found
            x = np.where([word[-1 - k % n] == "0" for word in words], *both)
            orbit.append(x)
        found += zip(words, np.transpose(orbit[-n:]).tolist(), strict=True)
    return found


def invariant_set(view, rng):
    """Periodic orbits of the horseshoe: which stay in the interval, which words they follow."""
    told, base, low, high = [], view.base, *map(float, view.interval)
    for one in view.orbits:
        told += itinerary(one, rng)
    factors = [each for each in view.shift.factors.split(" or ") if each]
    counts = Counter()
    for word, orbit in _periodic(base.eta, base.nu, *base.cells):
        near = min(abs(x - end) for x in orbit for end in (low, high))
        stays = low <= min(orbit) and max(orbit) <= high
        said = not any(each in word * 12 for each in factors)
        counts[len(word)] += stays
        if near > 1e-9 and stays != said:
            told.append(f"the orbit of {word} stays, or not, otherwise")
    printed = re.search(r"f\^n has ([0-9, ]+) fixed points", view.sentence)
    if printed and counts:
        given = [int(each) for each in printed[1].split(", ")]
        if given[:6] != [counts[n] for n in range(1, 7)]:
            told.append(f"the numbers of fixed points are {dict(counts)}")
    return told


def staying_dimension(view, rng):
    """The repeller and the invariant set of one interval have the same periodic points."""
    told = repeller(view.repeller, rng) + invariant_set(view.staying, rng)
    factors = [each for each in view.staying.shift.factors.split(" or ") if each]
    for letters in product("01", repeat=5):
        word = "".join(letters) * 8
        starts = (word[k:] for k in range(5))
        made = any(re.fullmatch(f"(?:{'|'.join(view.repeller.words)})*.?.?.?", x) for x in starts)
        if made == any(each in word for each in factors):
            told.append(f"the sequences of the words and of the invariant set differ at {word[:5]}")
    same = view.repeller.hull == view.staying.interval
    return told if same else [*told, "the two are about different intervals"]


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
            rate = rate / abs(slope)
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
    eigenvalue = _growth([y[2:] for y in images], [r[2:] for r in rates], nodes, (low, high))
    found, grown = _dimension(eigenvalue), eigenvalue(float(view.exponent))
    if not float(view.dimension[0]) - 1e-7 < found < float(view.dimension[1]) + 1e-7:
        told.append(f"the dimension is about {found:.9g}")
    if not float(view.growth[0]) - 1e-7 < grown < float(view.growth[1]) + 1e-7:
        told.append(f"the growth at {float(view.exponent):.9g} is about {grown:.9g}")
    return told


def thin_shift(view, rng):
    """The full shift is one; the repellers have its branches; lengths shrink by the growth."""
    told = staying_set(view.shift, rng) + [
        x for y in (view.repeller, view.escape) for x in repeller(y, rng)
    ]
    count = len(view.shift.cells)
    for each in (view.repeller, view.escape):
        if (each.hull,) != view.shift.region or each.words != tuple(map(str, range(count))):
            told.append("a repeller is not that of the full shift")
    if view.escape.exponent != 1:
        told.append("the growth is not that of lengths")
    slow, fast = (-math.log(end) for end in reversed(view.escape.growth))
    if not float(view.rate[0]) - 1e-12 <= slow <= fast <= float(view.rate[1]) + 1e-12:
        told.append(f"orbits escape at a rate of about {slow:.9g}")
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
    """The points of the domain that f, monotone there, maps to the targets, and f' there."""
    fit, (low, high) = branch
    if fit(low) > fit(high):
        points, slopes = _inverse((-fit, (low, high)), -targets)
        return points, None if points is None else -slopes
    if fit(low) > min(targets) + 1e-9 or fit(high) < max(targets) - 1e-9:
        return None, None
    a, b = np.full_like(targets, low), np.full_like(targets, high)
    for _ in range(50):
        middle = (a + b) / 2
        below = fit(middle) < targets
        a, b = np.where(below, middle, a), np.where(below, b, middle)
    return a, fit.deriv()(a)


def _growth(images, rates, nodes, hull):
    """The leading eigenvalue of the operator on polynomials, as a function of s."""
    scale = chebyshev.chebvander(2 * (nodes - hull[0]) / (hull[1] - hull[0]) - 1, _DEGREE - 1)
    basis = [
        chebyshev.chebvander(2 * (y - hull[0]) / (hull[1] - hull[0]) - 1, _DEGREE - 1)
        for y in images
    ]
    inverse = np.linalg.inv(scale)

    def eigenvalue(s):
        operator = sum((r**s)[:, None] * values for r, values in zip(rates, basis, strict=True))
        return max(np.linalg.eigvals(operator @ inverse).real)

    return eigenvalue


def _dimension(eigenvalue):
    low, high = 0.0, 2.0
    for _ in range(34):
        middle = (low + high) / 2
        low, high = (middle, high) if eigenvalue(middle) > 1 else (low, middle)
    return low

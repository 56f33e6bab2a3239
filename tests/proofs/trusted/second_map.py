"""The map and the rules of proofs/CERTIFICATE.md in Arb's arithmetic, typed from that page.

A range is a pair of fractions, a flight (phases, windows, whether transversal for all).
"""

from fractions import Fraction
from itertools import pairwise

from flint import arb, arb_series, fmpq


class NotAProof(Exception):
    """The certificate does not prove what it says."""


def proof(condition, what):
    if not condition:
        raise NotAProof(what)


def within(inner, outer):
    return outer[0] <= inner[0] and inner[1] <= outer[1]


# -- balls -----------------------------------------------------------------------------------------


def ball(ends):
    """A ball that contains a range, or a number."""
    low, high = ends if isinstance(ends, tuple) else (ends, ends)
    left, right = (arb(fmpq(end.numerator, end.denominator)) for end in (low, high))
    return left if low == high else left.union(right)


def bounds(value):
    """The ends of a ball as fractions."""
    proof(value.is_finite(), "no enclosure")
    ends = [end.man_exp() for end in (value.lower(), value.upper())]
    return tuple(int(man) * Fraction(2) ** int(exp) for man, exp in ends)


def halves(box):
    """Two boxes, cut at the middle of the longest side."""
    side = max(range(len(box)), key=lambda side: box[side][1] - box[side][0])
    low, high = box[side]
    for half in ((low, (low + high) / 2), ((low + high) / 2, high)):
        yield (*box[:side], half, *box[side + 1 :])


def positive(f, *box, boxes=300):
    """Whether f > 0 on the box is proved, by bisection; a middle that is not positive ends it."""
    waiting = [box]
    while waiting and boxes:
        box, boxes = waiting.pop(), boxes - 1
        if not f(*map(ball, box)) > 0:
            if not f(*(ball((low + high) / 2) for low, high in box)) > 0:
                return False
            waiting += halves(box)
    return not waiting


def thin(value):
    return value, value


# -- the map and its rules -------------------------------------------------------------------------


class Impacts:
    """The map at (eta, nu), of balls or power series phi and t."""

    def __init__(self, eta, nu):
        self.eta, self.nu, self.sign = ball(eta), ball(nu), 1 if nu > 0 else -1

    def gap(self, phi, t):
        eta, nu = self.eta, self.nu
        free = (1 + nu * phi.sin()) * (eta * t).cos() + nu * phi.cos() * (eta * t).sin() / eta
        return self.sign * (free - 1 - nu * (phi + t).sin())

    def fall(self, phi, t):
        """-gap'."""
        eta, nu = self.eta, self.nu
        free = nu * phi.cos() * (eta * t).cos() - eta * (1 + nu * phi.sin()) * (eta * t).sin()
        return self.sign * (nu * (phi + t).cos() - free)

    def bend(self, phi, t):
        """gap''."""
        eta, nu = self.eta, self.nu
        free = eta * (1 + nu * phi.sin()) * (eta * t).cos() + nu * phi.cos() * (eta * t).sin()
        return self.sign * (nu * (phi + t).sin() - eta * free)

    def slope(self, phi, t):
        """f'."""
        return (self.eta * t).sin() / self.eta * self.bend(phi, 0 * t) / -self.fall(phi, t)

    def slope_change(self, phases, time, cuts=8):
        """Bounds of f'' where gap = 0 in phases x time."""
        boxes = [(phases, time)]
        for _ in range(cuts):
            boxes = [half for box in boxes for half in halves(box)]
            boxes = [box for box in boxes if self.gap(*map(ball, box)).contains(0)]
        found = []
        for phi, t in (map(ball, box) for box in boxes):
            along = arb_series([t, self.slope(phi, t) - 1], prec=2)
            found.append(bounds(self.slope(arb_series([phi, 1], prec=2), along)[1]))
        return min(low for low, _ in found), max(high for _, high in found)

    def below(self, phases, time):
        """Whether gap < 0 at a time, for all phases."""
        return positive(lambda phi, t: -self.gap(phi, t), phases, thin(time))

    def first_impact(self, phases, times):
        proof(positive(self.bend, phases, (Fraction(0), times[0])), "gap'' > 0 at launch")
        proof(self.below(phases, times[-1]), "gap < 0 at the last time")
        windows = []
        for start, end in pairwise(times):
            if not self.closed(phases, (start, end)):
                joined = windows and windows[-1][1] == start
                windows.append((windows.pop()[0] if joined else start, end))
        single = len(windows) == 1 and windows[0][1] == times[-1]
        return phases, windows, single and positive(self.fall, phases, windows[0])

    def closed(self, phases, piece):
        """Whether gap > w^2/8 max(0, gap'') at both ends, gap'' from 4 parts."""
        boxes = [(phases, piece)]
        for _ in range(2):
            boxes = [half for box in boxes for half in halves(box)]
        most = max(Fraction(0), *(bounds(self.bend(*map(ball, box)))[1] for box in boxes))
        least = ball((piece[1] - piece[0]) ** 2 / 8 * most)
        return all(
            positive(lambda phi, t: self.gap(phi, t) - least, phases, thin(end)) for end in piece
        )

    def bracketed(self, flight, phases, time):
        """Prove that the flight's impacts at these phases lie in `time`."""
        _, windows, transversal = flight
        proof(transversal, "not transversal")
        proof(within(time, windows[0]), "a time out of the window")
        proof(positive(self.gap, phases, thin(time[0])), "gap > 0 at the lower time")
        proof(self.below(phases, time[1]), "gap < 0 at the upper time")

    def point(self, flight, phase, time):
        """The phase, and enclosures of f' and f there."""
        self.bracketed(flight, thin(phase), time)
        turns = (ball(phase + time[0]) / (2 * arb.pi())).floor().unique_fmpz()
        proof(turns is not None, "how many turns")
        image = ball((phase + time[0], phase + time[1])) - 2 * arb.pi() * turns
        return phase, bounds(self.slope(ball(phase), ball(time))), bounds(image)

    def slope_range(self, points, pieces):
        """The points, and an enclosure of f' on each piece."""
        found = []
        for left, right, (flight, time) in zip(points, points[1:], pieces, strict=False):
            piece, width = (left[0], right[0]), right[0] - left[0]
            self.bracketed(flight, piece, time)
            low, high = self.slope_change(piece, time)
            low, high = min(0, low) * width, max(0, high) * width
            (at_left, to_left), (at_right, to_right) = left[1], right[1]
            found.append((max(at_left + low, at_right - high), min(to_left + high, to_right - low)))
        return points, found


def avoids(flights, target):
    """The union of the flights' phases, and the target."""
    for (low, high), windows, _ in flights:
        for start, end in windows:
            turns = (ball(low + start - target[1]) / (2 * arb.pi())).ceil()
            proof(ball(high + end - target[0]) < 2 * arb.pi() * turns, "a window meets the target")
    return (flights[0][0][0], flights[-1][0][1]), target


def moran_root(ratios, root):
    proof(all(0 < ratio < 1 for ratio in ratios) and 0 < root[0] < root[1], "ratios and bracket")
    for exponent, sign in zip(root, (1, -1), strict=True):
        excess = sum(ball(ratio) ** ball(exponent) for ratio in ratios) - 1
        proof(sign * excess > 0, "the bracket holds no root")
    return tuple(ratios), root

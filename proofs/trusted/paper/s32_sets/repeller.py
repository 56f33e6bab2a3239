"""The rule `dimension`: the Hausdorff dimension of a set that the impact map repels."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import clock, gap, launch, launch_acceleration
from proofs.trusted.flights import (
    FirstImpact,
    Motion,
    bits_for,
    read_phases,
    transversal_step,
    whole_turns,
)
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, log, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.series import Series, polynomial
from proofs.trusted.numbers import Phases, Range, ceil_text, floor_text, hull, show_range, within
from proofs.trusted.parameters import Place

_MOST_WORDS, _LONGEST_WORD, _MOST_PIECES, _HIGHEST = 16, 16, 200, 200


@dataclass(frozen=True)
class Repeller(Conclusion):
    """The compact set K = union of g_w(K) over the words; g_w is g_j after g_v where w = jv.

    f increases on both domains; g_j is its inverse from `hull` into domains[j], for letters that
    end a word, and on its part that g_v reaches for others; f takes no other points of domains[j]
    there. The g_w map the hull into itself, to disjoint images; 1 / g_w' lies in the range that
    `slopes` has for w, all above 1. The Hausdorff dimension of K lies in `dimension`.
    """

    at: Place
    hull: Phases
    domains: tuple[Phases, Phases]
    words: tuple[str, ...]
    slopes: tuple[Range, ...]
    dimension: Range

    def __post_init__(self) -> None:
        """Raise Unproved unless domains and bounds are in order."""
        if self.domains[0][1] >= self.domains[1][0] or self.dimension[0] >= self.dimension[1]:
            raise Unproved("the domains or the bounds of the dimension are not in order")
        if min(low for low, _ in self.slopes) <= 1:
            raise Unproved("the inverse branches are not proved to contract")

    @property
    def sentence(self) -> str:
        """Return the statement."""
        domains, (low, high) = " and ".join(map(show_range, self.domains)), self.dimension
        return (
            f"let g_0, g_1 be the inverse branches of f from {show_range(self.hull)} into {domains}"
            f". The compact set that is the union of its images by {', '.join(self.words)}, which "
            "are disjoint, has a Hausdorff dimension in "
            f"[{floor_text(low, 12)}, {ceil_text(high, 12)}]."
        )


@dataclass(frozen=True)
class _Branch:
    """F on a domain: the time of the first impact after y, plus y, less 2 pi `turns`."""

    step: FirstImpact
    domain: Phases
    turns: int
    bits: int

    def excess(self, phase: Fraction, image: Range) -> int:
        """Return the sign of F(phase) - x for all x in `image`, 0 where it is not decided.

        Let T = x - phase + 2 pi turns, t the time of the impact. F(phase) > x means T < t. In the
        window the gap has the one zero t; it is positive before that and negative after.
        """
        low, high = whole_turns(self.turns, self.bits)
        time = (image[0] - phase + low, image[1] - phase + high)
        begin, end = self.step.windows[0]
        if time[1] < begin or time[0] > end:
            return 1 if time[1] < begin else -1
        motion = self.step.motion
        thin = Motion(motion.eta, motion.nu, (phase, phase), self.bits)
        height = thin.gap(thin.start(), time)
        if height.lo > 0 and time[1] <= end:
            return 1
        return -1 if height.hi < 0 and begin <= time[0] else 0

    def brackets(self, around: Range, image: Range) -> bool:
        """Whether for each x in `image` the domain has one y with F(y) = x, and it is around."""
        low, high = around
        return within(around, self.domain) and self.excess(low, image) < 0 < self.excess(
            high, image
        )

    def inverse(self, x: Series, value: Range, order: int) -> Series:
        """Return g(x) up to an order, where F(g) = id and g(x_0) is in `value`.

        Let z be the first m terms of y = g(x), and G(y) = gap(y, x - y + 2 pi turns). Then G(y) = 0
        and y - z = -G(z) / G'(z) + O(h^2m), so G(z) begins with h^m. By `slope`, -G' is
        sin(eta t) / eta times the launch acceleration.
        """
        motion = self.step.motion
        eta, nu = (Series.constant(rational(z, self.bits)) for z in (motion.eta, motion.nu))
        ahead = x + Series.constant(pi(self.bits) * (2 * self.turns))
        known = [Enclosure.of(*value, self.bits)]
        while (m := len(known)) <= order:
            z = Series.polynomial(*known)
            start, now = launch(motion.side, eta, nu, z), clock(eta, ahead - z)
            rate = now.mass_sin / eta * launch_acceleration(start)
            rest = gap(start, now).over_power(m) / rate
            known += [rest[k] for k in range(min(m, order + 1 - m))]
        return Series(known.__getitem__)


@dataclass(frozen=True)
class _System:
    """The inverse branches of words over the hull, where they are known to be, and a test h, s.

    test: the coefficients of h, a polynomial in u = (x - middle of the hull) / half its width.
    """

    branches: tuple[_Branch, _Branch]
    hull: Phases
    words: tuple[str, ...]
    centres: dict[str, tuple[Fraction, ...]]
    radius: Fraction
    pieces: int
    order: int
    test: tuple[Fraction, ...]
    s: Fraction
    bits: int

    @cached_property
    def points(self) -> list[Fraction]:
        """The ends and the middles of the pieces, in order."""
        (low, high), steps = self.hull, 2 * self.pieces
        return [low + (high - low) * j / steps for j in range(steps + 1)]

    def around(self, suffix: str, first: int, last: int) -> Range:
        """Return where g_suffix takes [points[first], points[last]]: it increases."""
        if not suffix:
            return self.points[first], self.points[last]
        centres = self.centres[suffix]
        return centres[first] - self.radius, centres[last] + self.radius

    def show(self) -> None:
        """Show that all inverse branches are where the witness puts them, and disjoint."""
        (low, high), turn = self.hull, whole_turns(1, self.bits)
        last, first = (high - turn[1], high - turn[0]), (low + turn[0], low + turn[1])
        for branch in self.branches:
            bottom, top = branch.domain
            if not branch.excess(bottom, last) > 0 > branch.excess(top, first):
                raise Unproved("f is not proved to pass the hull only once on a domain")
        for suffix in self.centres:
            branch = self.branches[int(suffix[0])]
            for j in range(len(self.points)):
                if not branch.brackets(self.around(suffix, j, j), self.around(suffix[1:], j, j)):
                    raise Unproved(f"an inverse image by {suffix} is not proved where it is said")
        images = sorted(self.around(word, 0, 2 * self.pieces) for word in self.words)
        if not within(hull(images), self.hull):
            raise Unproved("the inverse branches leave the hull")
        if any(before[1] >= after[0] for before, after in pairwise(images)):
            raise Unproved("the images of the inverse branches are not proved disjoint")

    def germs(self, first: int, last: int) -> dict[str, Series]:
        """Return the series of g_w(x) at all points of [points[first], points[last]], x for ""."""
        x, one = (
            Enclosure.of(*self.around("", first, last), self.bits),
            rational(Fraction(1), self.bits),
        )
        found = {"": Series.polynomial(x, one)}
        for suffix in sorted(self.centres, key=len):
            branch, value = self.branches[int(suffix[0])], self.around(suffix, first, last)
            found[suffix] = branch.inverse(found[suffix[1:]], value, self.order + 1)
        return found

    def range(self, middle: Series, whole: Series) -> Range:
        """Enclose a function on a piece by Taylor's formula, with Lagrange's remainder.

        The series are those at the middle of the piece and at all of its points.
        """
        step = (self.hull[1] - self.hull[0]) / (2 * self.pieces)
        total, h = whole[self.order], Enclosure.of(-step, step, self.bits)
        for k in reversed(range(self.order)):
            total = total * h + middle[k]
        return total.range

    def h(self, x: Series) -> Series:
        """Return h(x)."""
        low, high = self.hull
        middle, scale = (rational(z, self.bits) for z in ((low + high) / 2, 2 / (high - low)))
        u = (x - Series.constant(middle)) * Series.constant(scale)
        return polynomial(self.test, u)

    def defect(self, germs: dict[str, Series]) -> Series:
        """Return L_s h - h, L_s h the sum of (g_w')^s h(g_w)."""
        total, s = -self.h(germs[""]), Series.constant(rational(self.s, self.bits))
        for word in self.words:
            y = germs[word]
            total = total + (y.derivative().log() * s).exp() * self.h(y)
        return total


def dimension(context: Context, reader: Reader) -> Repeller:
    """Rule `dimension`: {flights, turns, hull, domains, words, inverse, ..., dimension: [l, u]}.

    f is the impact map; for j = 0, 1 flights[j] is a transversal first-impact step that contains
    domains[j], F = phase + time of flight - 2 pi turns[j]. x_0, ..., x_2n are equidistant on
    hull = [a, b], n `pieces`. inverse: a list y_0, ..., y_2n for each word and each shorter end of
    a word, in alphabetical order; r is `radius`. Special, since inverse branches of the impact map
    have no formula: their series come from gap = 0 by Newton's method (`_Branch.inverse`).

    Hypotheses. (1) F' > 0, by sin(eta t) < 0 in the window; F > b - 2 pi at the lower and
    F < a + 2 pi at the upper end of the domain. (2) Let g_w(x) for a word w = jv be the y in
    domains[j] with F(y) = g_v(x), g of the empty word x. g_w(x_i) exists within y_i - r, y_i + r:
    F takes these on both sides of all that g_v(x_i) may be. The images g_w([a, b]) of the words
    lie in [a, b] and are disjoint. (3) With the polynomial h > 0, `test`, s = (l + u)/2,

        L_s h(x) = sum over the words of g_w'(x)^s h(g_w(x)),      0 < g_w' <= exp(-m) < 1,

    and q = (u - l) m / 2, on [a, b]: -q h / (1 + q) <= L_s h - h <= q h.
    By Taylor's formula of that `order` N on each piece, with Lagrange's remainder: coefficients
    at its middle below N, over the piece at N.

    Conclusion: let K be the compact set with K = union of g_w(K) (Hutchinson). Its Hausdorff
    dimension is in [l, u]; f, on the circle, takes no other points of domains[j] into the hull
    than those of g_j. slopes: bounds of 1 / g_w' over [a, b], by word.

    Proof (Bowen 1979; min-max: Pollicott, Vytnova 2022). L_(s+t) <= exp(-t m) L_s for t >= 0.
    So L_u h <= exp(-q) (1 + q) h <= h and L_l h >= (1 + q) (1 - q / (1 + q)) h = h.
    For words of n letters w let R_w and r_w be the extremes of the derivatives of the n-fold
    compositions g_W. R_w <= C r_w with C free of n, since log g_w' are Lipschitz and the arguments
    approach each other by exp(-m) a step. Upper bound: the sum of R_W^u is at most
    C^u L_u^n h / min h <= C', the intervals g_W([a, b]) cover K and are at most R_W (b - a) long,
    which tends to 0: the u-dimensional measure of K is finite. Lower bound: the sum of r_W^l is
    at least L_l^n h / (C^l max h) >= c > 0, so for t > 0 that of r_W^(l - t) >= exp(n m t) c,
    over 1 for a large n. As g_W contract by r_W at most and have disjoint images,
    dim K >= l - t (Falconer, Fractal Geometry, Proposition 9.7).
    """
    system, span = _read(context, reader)
    system.show()
    above = below = Fraction(0)  # the extremes of (L_s h - h) / h, at least 0
    slopes: dict[str, list[Range]] = {word: [] for word in system.words}
    for j in range(0, 2 * system.pieces, 2):
        whole, middle = system.germs(j, j + 2), system.germs(j + 1, j + 1)
        least = system.h(whole[""])[0].range[0]
        if least <= 0:
            raise Unproved("the test function is not proved positive")
        low, high = system.range(system.defect(middle), system.defect(whole))
        above, below = max(above, high / least), max(below, -low / least)
        for word, bounds in slopes.items():
            rates = system.range(middle[word].derivative(), whole[word].derivative())
            if rates[0] <= 0:
                raise Unproved("the inverse branches are not proved to increase")
            bounds.append((1 / rates[1], 1 / rates[0]))
    bounds_of = tuple(hull(bounds) for bounds in slopes.values())
    domains = (system.branches[0].domain, system.branches[1].domain)
    at = system.branches[0].step.at
    found = Repeller(at, system.hull, domains, system.words, bounds_of, span)
    q = (span[1] - span[0]) / 2 * log(hull(bounds_of)[0], system.bits).range[0]
    if above > q or below * (1 + q) > q:
        worst = float(min(Fraction(1), max(above, below)))  # a larger one may be no float
        raise Unproved(f"the operator is only proved within {worst:.1e} of 1")
    return found


def _read(context: Context, reader: Reader) -> tuple[_System, Range]:
    """Read a witness of the rule `dimension`; return what it is about, and [l, u]."""
    flights, turns, hull_of, domains, words_of, inverse, radius_of, *rest = reader.fields(
        "flights", "turns", "hull", "domains", "words", "inverse", "radius",
        "pieces", "order", "test", "dimension",
    )  # fmt: skip
    pieces_of, order_of, test, span_of = rest
    radius, span = radius_of.number(), span_of.range()
    words = tuple(word.string() for word in words_of.items(2, _MOST_WORDS))
    if not all(1 <= len(x) <= _LONGEST_WORD and set(x) <= {"0", "1"} for x in words):
        raise words_of.fail("words over 0 and 1 are expected")
    if radius <= 0 or len(set(words)) != len(words) or not 0 < span[0] < span[1]:
        raise reader.fail("no radius, a word that is there twice, or no bounds of a dimension")
    bits = bits_for((-radius, radius))
    pieces, order = integer(pieces_of, 1, _MOST_PIECES), integer(order_of, 1, _HIGHEST)
    suffixes = sorted({word[k:] for word in words for k in range(len(word))})
    lists = inverse.items(len(suffixes), len(suffixes))
    steps = 2 * pieces + 1
    system = _System(
        _branches(context, flights, domains, turns, bits),
        Phases(*read_phases(hull_of)),
        words,
        {name: each.numbers(steps, steps) for name, each in zip(suffixes, lists, strict=True)},
        radius,
        pieces,
        order,
        test.numbers(1, _HIGHEST),
        (span[0] + span[1]) / 2,
        bits,
    )
    return system, span


def _branches(
    context: Context, flights: Reader, domains: Reader, turns: Reader, bits: int
) -> tuple[_Branch, _Branch]:
    """Read both branches, and show that F' > 0: the slope's other factors have known signs."""
    found = []
    for each in zip(flights.items(2, 2), domains.items(2, 2), turns.items(2, 2), strict=True):
        domain = Phases(*read_phases(each[1]))
        step = transversal_step(context, each[0], domain)
        eta, time = (rational(step.motion.eta, step.motion.bits), step.windows[0])
        if (eta * Enclosure.of(*time, step.motion.bits)).sincos()[0].hi >= 0:
            raise Unproved("f is not proved to increase on a domain")
        found.append(_Branch(step, domain, integer(each[2], 0, 10**6), bits))
    return found[0], found[1]

"""The rule `dimension`: the Hausdorff dimension of a set that the impact map repels."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import clock, gap, launch, launch_acceleration
from proofs.trusted.flights import FirstImpact, bits_for, excess, transversal_step, whole_turns
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, log, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.series import Series, polynomial
from proofs.trusted.numbers import Phases, Range, between, hull, show_range, within
from proofs.trusted.parameters import Place

_WORD = re.compile("[01]{1,16}")
_MOST_WORDS, _MOST = 16, 200


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
        if self.domains[0][1] >= self.domains[1][0]:
            raise Unproved("the domains are not in order")
        if not 0 < self.dimension[0] < self.dimension[1]:
            raise Unproved("the bounds of the dimension are not in order")
        if min(low for low, _ in self.slopes) <= 1:
            raise Unproved("the inverse branches are not proved to contract")

    @property
    def sentence(self) -> str:
        return (
            f"let g_0, g_1 be the inverse branches of f from {show_range(self.hull)} into "
            f"{' and '.join(map(show_range, self.domains))}. The compact set that is the union of "
            f"its images by {', '.join(self.words)}, which are disjoint, has a Hausdorff dimension "
            f"in {between(self.dimension, 12)}."
        )


@dataclass(frozen=True)
class _Branch:
    """F on a domain: the time of the first impact after y, plus y, less 2 pi `turns`."""

    step: FirstImpact
    domain: Phases
    turns: int
    bits: int

    def excess(self, phase: Fraction, image: Range) -> int:
        """Return the sign of F(phase) - x for all x in `image`, 0 where it is not decided."""
        return excess(self.step, phase, image, self.turns, self.bits)

    def brackets(self, around: Range, image: Range) -> bool:
        """Whether for each x in `image` the domain has one y with F(y) = x, and it is around."""
        signs = (self.excess(end, image) for end in around)
        return within(around, self.domain) and tuple(signs) == (-1, 1)

    def inverse(self, x: Series, value: Range, order: int) -> Series:
        """Return g(x) up to an order, where F(g) = id and g(x_0) is in `value`.

        Let z be the first m terms of y = g(x), and G(y) = gap(y, x - y + 2 pi turns). Then G(y) = 0
        and y - z = -G(z) / G'(z) + O(h^2m), so G(z) begins with h^m. By `slope`, -G' is
        sin(eta t) / eta times the launch acceleration.
        """
        motion = self.step.motion
        eta, nu = (Series.constant(rational(z, self.bits)) for z in motion.at.point)
        ahead = x + Series.constant(pi(self.bits) * (2 * self.turns))
        known = [Enclosure.of(*value, self.bits)]
        while (m := len(known)) <= order:
            z = Series.polynomial(*known)
            start, now = launch(motion.side, eta, nu, z), clock(eta, ahead - z)
            rate = now.mass_sin / eta * launch_acceleration(start)
            rest = gap(start, now).over_power(m) / rate
            known += [rest[k] for k in range(min(m, order + 1 - m))]
        return Series(known.__getitem__)


def _branch(context: Context, flight: Reader, phases: Reader, turns: Reader, bits: int) -> _Branch:
    """Read a branch, and show that F' > 0: the slope's other factors have known signs."""
    domain = Phases(*phases.range())
    step = transversal_step(context, flight, domain)
    if step.motion.clock(step.windows[0]).mass_sin.hi >= 0:
        raise Unproved("f is not proved to increase on a domain")
    return _Branch(step, domain, integer(turns, 0, 10**6), bits)


class _System:
    """The witness of the rule `dimension`, as it is read.

    images: enclosures of g_w(x_0), ..., g_w(x_2n) for the words and their shorter ends w, x_i for
    the empty one. test: the coefficients of h, a polynomial in u = (x - middle) / half the width.
    """

    def __init__(self, context: Context, reader: Reader) -> None:
        flights, turns, whole, domains, words, inverse, radius_of, *rest = reader.fields(
            "flights", "turns", "hull", "domains", "words", "inverse", "radius",
            "pieces", "order", "test", "dimension",
        )  # fmt: skip
        pieces, order, test, span = rest
        self.order, self.test = integer(order, 1, _MOST), test.numbers(1, _MOST)
        self.hull, self.dimension = Phases(*whole.range()), span.range()
        self.words = tuple(word.string() for word in words.items(2, _MOST_WORDS))
        radius, steps = radius_of.number(), 2 * integer(pieces, 1, _MOST)
        if radius <= 0 or not all(map(_WORD.fullmatch, self.words)):
            raise reader.fail("a positive radius, and words over 0 and 1 of up to 16 letters")
        self.bits = bits_for((-radius, radius))
        parts = zip(flights.items(2, 2), domains.items(2, 2), turns.items(2, 2), strict=True)
        self.branches = [_branch(context, *part, self.bits) for part in parts]
        self.step = (self.hull[1] - self.hull[0]) / steps
        points = [self.hull[0] + self.step * j for j in range(steps + 1)]
        self.images = {"": [(x, x) for x in points]}
        ends = sorted({word[k:] for word in self.words for k in range(len(word))})
        for word, each in zip(ends, inverse.items(len(ends), len(ends)), strict=True):
            centres = each.numbers(len(points), len(points))
            self.images[word] = [(y - radius, y + radius) for y in centres]

    def around(self, word: str, first: int, last: int) -> Range:
        """Return where g_word takes all phases from one x_i to another: it increases."""
        return self.images[word][first][0], self.images[word][last][1]

    def require(self) -> None:
        """Raise Unproved unless the inverse images are where they are said to be, and disjoint."""
        (low, high), turn = self.hull, whole_turns(1, self.bits)
        last, first = (high - turn[1], high - turn[0]), (low + turn[0], low + turn[1])
        for branch in self.branches:
            bottom, top = branch.domain
            if not branch.excess(bottom, last) > 0 > branch.excess(top, first):
                raise Unproved("f is not proved to pass the hull only once on a domain")
        for word in filter(None, self.images):
            brackets = self.branches[int(word[0])].brackets
            if not all(map(brackets, self.images[word], self.images[word[1:]])):
                raise Unproved(f"an inverse image by {word} is not proved where it is said")
        spans = sorted(self.around(word, 0, -1) for word in self.words)
        if not within(hull(spans), self.hull):
            raise Unproved("the inverse branches leave the hull")
        if any(before[1] >= after[0] for before, after in pairwise(spans)):
            raise Unproved("the images of the inverse branches are not proved disjoint")

    def germs(self, first: int, last: int) -> dict[str, Series]:
        """Return the series of g_w at all phases from one x_i to another, x for the empty w."""
        x = Enclosure.of(*self.around("", first, last), self.bits)
        found = {"": Series.polynomial(x, rational(Fraction(1), self.bits))}
        for word in sorted(filter(None, self.images), key=len):
            inverse, value = self.branches[int(word[0])].inverse, self.around(word, first, last)
            found[word] = inverse(found[word[1:]], value, self.order + 1)
        return found

    def range(self, middle: Series, whole: Series) -> Range:
        """Enclose a function on a piece by Taylor's formula, with Lagrange's remainder.

        The series are those at the middle of the piece and at all of its points.
        """
        total, h = whole[self.order], Enclosure.of(-self.step, self.step, self.bits)
        for k in reversed(range(self.order)):
            total = total * h + middle[k]
        return total.range

    def h(self, x: Series) -> Series:
        """Return h(x)."""
        numbers = sum(self.hull, Fraction(0)) / 2, 2 / (self.hull[1] - self.hull[0])
        middle, scale = (Series.constant(rational(z, self.bits)) for z in numbers)
        return polynomial(self.test, (x - middle) * scale)

    def defect(self, germs: dict[str, Series]) -> Series:
        """Return L_s h - h, L_s h the sum of (g_w')^s h(g_w)."""
        s = Series.constant(rational(sum(self.dimension, Fraction(0)) / 2, self.bits))
        total = -self.h(germs[""])
        for y in (germs[word] for word in self.words):
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

    Conclusion: `Repeller`, K the compact set with K = union of g_w(K) (Hutchinson).

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
    system = _System(context, reader)
    system.require()
    above = below = Fraction(0)  # the extremes of (L_s h - h) / h, at least 0
    rates: dict[str, list[Range]] = {word: [] for word in system.words}
    for j in range(1, len(system.images[""]), 2):
        whole, middle = system.germs(j - 1, j + 1), system.germs(j, j)
        least = system.h(whole[""])[0].range[0]
        if least <= 0:
            raise Unproved("the test function is not proved positive")
        low, high = system.range(system.defect(middle), system.defect(whole))
        above, below = max(above, high / least), max(below, -low / least)
        for word, bounds in rates.items():
            bounds.append(system.range(middle[word].derivative(), whole[word].derivative()))
    if min(low for bounds in rates.values() for low, _ in bounds) <= 0:
        raise Unproved("the inverse branches are not proved to increase")
    slopes = tuple((1 / high, 1 / low) for low, high in map(hull, rates.values()))
    first, second = system.branches
    domains, span = (first.domain, second.domain), system.dimension
    found = Repeller(first.step.at, system.hull, domains, system.words, slopes, span)
    q = (span[1] - span[0]) / 2 * log(hull(slopes)[0], system.bits).range[0]
    if above > q or below * (1 + q) > q:
        raise Unproved("the operator is not proved near enough to 1")
    return found

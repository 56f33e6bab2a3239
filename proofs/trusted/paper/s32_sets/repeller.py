"""The rule `dimension`: how a set that the impact map repels grows thin, and its dimension."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.complexes import BITS, Ellipse
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.elementary import log
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.transfer import Collocation, Growth, Trial, growth
from proofs.trusted.numbers import Phases, Range, between, ceil_text, floor_text, show, show_range
from proofs.trusted.paper.branches import Branch
from proofs.trusted.paper.s32_sets.inverses import Inverses, Letter
from proofs.trusted.parameters import Place

_ONE, _LOG_BITS = Fraction(1), 64
_WORD = re.compile("[0-9]{1,16}")
_MOST_LETTERS, _MOST_WORDS, _MOST_ARCS, _MOST_TERMS, _MOST_BITS = 10, 16, 2000, 2500, 4000


@dataclass(frozen=True)
class Repeller(Conclusion):
    """The compact set K = union of g_w(K) over the words; g_w is g_j after g_v where w = jv.

    f is monotone on each domain; g_j is its inverse from `hull` into domains[j], for letters that
    end a word, and on its part that g_v reaches for others; f takes no other points of domains[j]
    there. The g_w map the hull into itself, to disjoint images; 1 / |g_w'| lies in the range that
    `slopes` has for w, all above 1. With some h > 0 on the hull and s = `exponent`, the sum over
    the words of |g_w'|^s h(g_w), divided by h, lies in `growth`; the Hausdorff dimension of K, in
    `dimension`. falls: whether f decreases on some domain.
    """

    at: Place
    hull: Phases
    domains: tuple[Phases, ...]
    words: tuple[str, ...]
    slopes: tuple[Range, ...]
    exponent: Fraction
    growth: Range
    dimension: Range
    falls: bool = False

    def __post_init__(self) -> None:
        """Raise Unproved unless domains and bounds are in order."""
        if any(one[1] >= two[0] for one, two in pairwise(self.domains)):
            raise Unproved("the domains are not in order")
        if not (0 <= self.dimension[0] < self.dimension[1] and 0 < self.growth[0] < self.growth[1]):
            raise Unproved("the bounds of the dimension are not in order")
        if len(self.slopes) != len(self.words) or min(low for low, _ in self.slopes) <= 1:
            raise Unproved("the inverse branches are not proved to contract")

    @property
    def rate(self) -> Range:
        """Bounds of -log of the growth."""
        bits = _LOG_BITS + int(1 / (self.growth[1] - self.growth[0])).bit_length()
        low, high = (log(end, bits).range for end in self.growth)
        return -high[1], -low[0]

    @property
    def sentence(self) -> str:
        rate = "|g_w'|" if self.falls else "(g_w')"
        return (
            f"let g_0, ..., g_{len(self.domains) - 1} take phases of {show_range(self.hull)} back "
            f"to those of {', '.join(map(show_range, self.domains))} that f maps to them, where "
            "there are such; for a word w = jv let g_w be g_j after g_v. On all of "
            f"{show_range(self.hull)} g_w is defined for w = {', '.join(self.words)}, with images "
            "there that are disjoint. The compact set K that is the union of its images by these "
            f"has a Hausdorff dimension in {between(self.dimension, 12)}; with "
            f"s = {show(self.exponent)} and some h > 0, the sum of {rate}^s h(g_w) over these "
            f"words w lies between {floor_text(self.growth[0], 12)} h and "
            f"{ceil_text(self.growth[1], 12)} h on {show_range(self.hull)}."
        )


def _read(context: Context, reader: Reader) -> tuple[Inverses, Trial, Collocation]:
    """Read the witness of the rule `dimension`."""
    names, whole, *rest = reader.fields(
        "branches", "hull", "words", "rho", "arcs", "paths", "radii",
        "nodes", "exponent", "growth", "test", "bits",
    )  # fmt: skip
    words_of, rho, arcs, paths, radii, nodes, exponent, mean, test, bits_of = rest
    letters = tuple(Letter(context.step(x, Branch)) for x in names.items(2, _MOST_LETTERS))
    count, bits = len(letters), integer(bits_of, BITS, _MOST_BITS)
    words = tuple(word.string() for word in words_of.items(2, _MOST_WORDS))
    if not all(_WORD.fullmatch(word) and int(max(word)) < count for word in words):
        raise words_of.fail("words of up to 16 letters, which are the numbers of the domains")
    ends = sorted({word[k:] for word in words for k in range(len(word))}, key=by_length)
    ellipse = Ellipse(Phases(*whole.range()), rho.number())
    inverses = Inverses(
        letters,
        words,
        ellipse,
        {
            end: path.numbers(1, 100)
            for end, path in zip(ends, paths.items(len(ends), len(ends)), strict=True)
        },
        dict(zip(ends, radii.numbers(len(ends), len(ends)), strict=True)),
    )
    first, *others = test.numbers(1, _MOST_TERMS)
    if first == 0:
        raise Unproved("the test function is not proved positive")
    trial = Trial(exponent.number(), (_ONE, *(c / first for c in others)))
    by = Collocation(
        ellipse, integer(arcs, 1, _MOST_ARCS), integer(nodes, 1, _MOST_TERMS), mean.number(), bits
    )
    return inverses, trial, by


def by_length(word: str) -> tuple[int, str]:
    """Order words by length, then by the alphabet."""
    return len(word), word


def dimension(context: Context, reader: Reader) -> Repeller:
    """Rule `dimension`: {branches, hull, words, rho, arcs, paths, radii, ...}.

    f is the impact map. branches: steps, whose phases are the domains; on domain j, F = phase +
    time of flight - 2 pi turns, those of the branch. paths: a polynomial for each word and each
    shorter end of a word, shorter ones first. Special, since inverse branches of the impact map
    have no formula: they are proved near these polynomials, in a complex neighbourhood
    (`Inverses`).

    Hypotheses: F' has the sign of -sin(eta t), one in all windows of a domain, and F passes
    hull = [a, b] once on it (`Letter`); those of `Inverses`, at g_w on the ellipse with foci a, b
    and `rho`; those of the theorem `kernel.transfer.growth` for the g_w of the words, `exponent`,
    `growth`, with the test function h whose coefficients by Chebyshev's polynomials are `test`,
    divided by the first, so many `arcs` and `nodes`, and in so many `bits`; |g_w'| < 1.

    Conclusion: `Repeller`, K the compact set with K = union of g_w(K) (Hutchinson), its dimension
    by the theorem `kernel.transfer.Growth.dimension`.
    """
    inverses, trial, by = _read(context, reader)
    return repeller(inverses, growth(inverses, trial, by), by.bits)


def repeller(inverses: Inverses, found: Growth, bits: int) -> Repeller:
    """Return what the rule `dimension` concludes."""
    inverses.require(bits)
    if min(low for low, _ in found.rates) <= 0:
        raise Unproved("the inverse branches are not proved monotone")
    slopes = tuple((1 / high, 1 / low) for low, high in found.rates)
    return Repeller(
        inverses.letters[0].branch.at,
        Phases(*inverses.ellipse.hull),
        tuple(letter.domain for letter in inverses.letters),
        inverses.words,
        slopes,
        found.s,
        found.bounds,
        found.dimension(bits),
        any(letter.sign < 0 for letter in inverses.letters),
    )

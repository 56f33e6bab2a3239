"""Hausdorff dimensions: of the set that stays in I (H13), of the full shifts beside it (G19)."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from math import lcm
from typing import Any

from intervals import Undecided
from proofs.methods.dimension import POINTS, Images, Remembered, boundary, ellipses, enough_arcs
from proofs.methods.eigenfunction import candidate
from proofs.motion.inverse import InverseBranch
from proofs.search.evidence import FAILED, Evidence, Proof, Tell
from proofs.search.request import Request, proving
from proofs.search.s32_sets import LEAST_DIGITS, prove_staying
from proofs.search.s34_staying import prove_full_shifts
from proofs.search.steps import Prover
from proofs.trusted.certificate import texts
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.complexes import Ellipse
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.kernel.transfer import growth, on_boundary
from proofs.trusted.numbers import Phases, Range
from proofs.trusted.paper.s32_sets.dimension import FULL, WITHOUT_000
from proofs.trusted.paper.s32_sets.invariant import staying as invariant_set
from proofs.trusted.paper.s32_sets.inverses import Inverses, Letter
from proofs.trusted.paper.s32_sets.repeller import Repeller, by_length, repeller
from proofs.trusted.paper.s34_circle.other_sets import PRINTED
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Found

_ZERO, _ROOM = Fraction(0), Fraction(3, 2)  # between a branch and its path
_MARGIN = Fraction(1, 2000)  # of a domain around what is needed
_MOST_TERMS, _TAIL = 30, 1e-3  # of a path
_SOME = 4  # every such arc tells how far the branches may be from their paths


@dataclass
class _Run:
    """One run: its prover, the digits of the dimension, and whom to tell of the stages."""

    of: Parameters
    prover: Prover
    digits: int
    tell: Tell
    letters: dict[Range, tuple[str, Letter]] = field(default_factory=dict)
    inverses: dict[Any, tuple[Inverses, Remembered, int]] = field(default_factory=dict)

    def attempt(self, make: Callable[[], tuple[str, Repeller]]) -> Proof:
        """Make a part of the proof; what cannot be proved leaves no step."""
        letters = dict(self.letters)
        with suppress(*FAILED), self.prover.undone():
            return [make()]
        self.letters = letters
        return []

    def letter(self, domain: Range) -> tuple[str, Letter]:
        """Prove the first impact transversal on all of a domain, once."""
        if domain not in self.letters:
            turns = InverseBranch(self.prover.system, domain).turns
            cuts = [domain[0], *(high for _, high in self.prover.windows(domain))]
            name, branch = self.prover.derive("branch", {"cuts": texts(cuts), "turn": str(turns)})
            self.letters[domain] = name, Letter(branch)
        return self.letters[domain]

    def repeller(
        self,
        hull: Range,
        domains: Sequence[Range],
        words: tuple[str, ...],
        exponent: Fraction | None = None,
    ) -> tuple[str, Repeller]:
        """Enclose the dimension of the set of all sequences of these words (rule dimension).

        exponent: where the growth of the operator is asked for, not the dimension.
        """
        names, letters = zip(*map(self.letter, domains), strict=True)
        self.tell("the inverse branches of f on an ellipse")
        sets = hull, tuple(domains), words
        if sets not in self.inverses:
            self.inverses[sets] = self._inverses(hull, letters, words)
        inverses, remembered, arcs = self.inverses[sets]
        self.tell("a test function for the dimension")
        trial, by = candidate(remembered, inverses.ellipse, arcs, self.digits, exponent)
        self.tell("the operator's inequality, on all of the interval")
        conclusion = repeller(inverses, growth(remembered, trial, by), by.bits)
        scale = lcm(*(c.denominator for c in trial.coefficients))
        witness = {
            "branches": list(names),
            "hull": texts(hull),
            "words": list(words),
            "rho": str(inverses.ellipse.rho),
            "arcs": str(arcs),
            "paths": [texts(path) for path in inverses.paths.values()],
            "radii": texts(list(inverses.radii.values())),
            "nodes": str(by.nodes),
            "exponent": str(trial.s),
            "growth": str(by.mean),
            "test": [str(c * scale) for c in trial.coefficients],
            "bits": str(by.bits),
        }
        return self.prover.record("dimension", witness, conclusion), conclusion

    def shift(
        self, shift: StayingSet, words: tuple[str, ...], exponent: Fraction | None
    ) -> tuple[str, Repeller]:
        """Enclose the dimension of a full shift, by domains as small as may be in its cells."""
        domains = [self._image(shift.interval, cell) for cell in shift.cells]
        return self.repeller(shift.interval, domains, words, exponent)

    def _image(self, hull: Range, cell: Range) -> Range:
        """Return a little more than the part of a cell that f takes to the hull."""
        branch = InverseBranch(self.prover.system, cell)
        ends = [branch.along([float(sum(hull)) / 2, float(end)])[1][0].real for end in hull]
        low, high = (round(Fraction(y), 4) for y in ends)
        return (max(cell[0], low - _MARGIN), min(cell[1], high + _MARGIN))

    def _inverses(
        self, hull: Range, letters: tuple[Letter, ...], words: tuple[str, ...]
    ) -> tuple[Inverses, Remembered, int]:
        """Find an ellipse and paths on which the inverse branches are proved, and how many arcs."""
        ends = sorted({word[k:] for word in words for k in range(len(word))}, key=by_length)
        branches = [InverseBranch(self.prover.system, letter.domain) for letter in letters]

        def along(path: Sequence[complex]) -> dict[str, Images]:
            values: dict[str, Images] = {"": [(x, 1) for x in path]}
            for word in ends:
                before = values[word[1:]]
                pairs = branches[int(word[0])].along([x for x, _ in before])
                values[word] = [(y, d * e) for (y, d), (_, e) in zip(pairs, before, strict=True)]
            return values

        def of_words(path: Sequence[complex]) -> list[Images]:
            images = along(path)
            return [images[word] for word in words]

        for rho in ellipses(of_words, hull, self.digits):
            images = along(boundary(hull, float(rho)))
            paths = {word: _path(images[word], float(rho)) for word in ends}
            inverses = Inverses(
                letters, words, Ellipse(hull, rho), paths, dict.fromkeys(ends, _ZERO)
            )
            with suppress(Unproved):
                return enough_arcs(partial(_with_radii, inverses))
        raise Undecided("no ellipse is found that the inverse branches map into itself")


def _with_radii(branches: Inverses, arcs: int) -> tuple[Inverses, Remembered, int]:
    """Find how far from their paths the branches may be, if so many arcs prove it."""
    rough, parts = replace(branches, found={}), branches.ellipse.arcs(arcs)
    on_boundary(rough, parts[::_SOME])
    radii = {word: round(_ROOM * each, 12) for word, each in rough.found.items()}
    wide = replace(branches, radii=radii, found={})
    remembered = Remembered(wide)
    on_boundary(remembered, parts)
    wide.require_near()
    return wide, remembered, arcs


def _path(images: Images, rho: float) -> tuple[Fraction, ...]:
    """Return Chebyshev coefficients of a branch, from its values at equal angles from 0 to pi.

    On the ellipse T_k = (w^k + w^-k) / 2: they are those of its Fourier series.
    """
    values = [y for y, _ in images[-POINTS:]]
    steps, coefficients = len(values) - 1, list[float]()
    weights = [0.5, *[1.0] * (steps - 1), 0.5]
    for k in range(_MOST_TERMS):
        turned = (
            weight * (y * cmath.exp(-1j * math.pi * k * j / steps)).real
            for j, (weight, y) in enumerate(zip(weights, values, strict=True))
        )
        coefficients.append((2 if k else 1) * sum(turned) / steps / rho**k)
    sizes = [abs(c) * rho**k for k, c in enumerate(coefficients)]
    while len(coefficients) > 2 and sizes[len(coefficients) - 1] < _TAIL * max(sizes[1:]):
        del coefficients[-1]
    return tuple(round(Fraction(c), 12) for c in coefficients)


@proving
def prove(request: Request) -> Evidence:
    """Prove what the claims rest on: dimensions, rates of escape and s_0, to so many digits."""
    run = _Run(request.of, request.prover(least_digits=LEAST_DIGITS), request.digits, request.tell)
    provers = {"H13": _staying, "G19": _shifts}
    proofs = {claim: provers[claim](run) for claim in provers if request.asks(claim)}
    return Evidence(run.prover.steps, proofs)


def _staying(run: _Run) -> Proof:
    """H13: s_0, and the sets that stay in I and in an interval around it."""
    statement, proof = run.of, list[tuple[str, Conclusion]]()
    if max(statement.moran_ratios) < 1:
        proof.append(run.prover.root(statement.moran_ratios))
    run.tell("a horseshoe around I, and the orbits of the ends of I")
    around = prove_staying(statement, run.prover)
    proof += around
    if around:
        staying = invariant_set(statement.interval, Found(statement, [each for _, each in around]))
        base = staying.base
        full = base.interval, base.cells, FULL
        proof += run.attempt(partial(run.repeller, *full))
        if staying.shift.factors == "000":
            inner = (
                Phases(*statement.interval),
                (Phases(*statement.left), Phases(*statement.right)),
                WITHOUT_000,
            )
            proof += run.attempt(partial(run.repeller, *inner))
    return proof


def _shifts(run: _Run) -> Proof:
    """G19: the full shifts of G5, and for each its dimension and the growth of lengths."""
    run.tell("full shifts around [1.32, 1.48]")
    proof = list[tuple[str, Conclusion]]()
    for name, shift in prove_full_shifts(run.prover, PRINTED, run.of.interval):
        proof.append((name, shift))
        words = tuple(map(str, range(len(shift.cells))))
        for exponent in (None, Fraction(1)):
            proof += run.attempt(partial(run.shift, shift, words, exponent))
    return proof

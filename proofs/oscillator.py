"""The oscillator as a library: `from proofs import Oscillator`.

Numbers go in as text (or as int or Fraction), since 0.2121 is 2121/10000 and the float is not.
What comes out encloses the true values, prints decimals that are rounded outward, and shows itself
in notebooks. What cannot be proved raises `intervals.Undecided`.

    >>> from proofs import Oscillator
    >>> oscillator = Oscillator("0.2121", "-0.2")
    >>> print(oscillator.slope("1.13", digits=6))
    [5.29635330, 5.29635331]

What `image` answers has a `certificate`, as a theorem has: `python -m proofs.check` accepts it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from html import escape

from intervals import Undecided, decimal_bounds
from intervals.exact import whole
from proofs.methods.ends import Ends, Exact, ends_of
from proofs.methods.grammar import exact
from proofs.motion.digits import MOST_DIGITS
from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search.evidence import FAILED, Evidence, Proof, Proved
from proofs.search.image import Image, PossibleImages, image
from proofs.search.rebound import Rebound, rebound
from proofs.search.s33_steps import ReboundProver
from proofs.search.steps import Prover
from proofs.shell import groups
from proofs.theorem import Theorem
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.horseshoe import Horseshoe
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.numbers import TURN, Range, show, show_range
from proofs.trusted.oscillator import LATEST
from proofs.trusted.paper.s33_restitution.horseshoes import restituting
from proofs.trusted.parameters import Parameters, Place

_SYMBOLS = {
    "dwell": r"t_s",
    "flight": r"t",
    "phase": r"\varphi_1",
    "slope": r"f'(\varphi)",
    "velocity": r"\gamma_1",
    "dphase_dphi": r"\partial\varphi_1/\partial\varphi",
    "dphase_dgamma": r"\partial\varphi_1/\partial\gamma",
    "dgamma_dphi": r"\partial\gamma_1/\partial\varphi",
    "dgamma_dgamma": r"\partial\gamma_1/\partial\gamma",
}
_DERIVATIVES = ("dphase_dphi", "dphase_dgamma", "dgamma_dphi", "dgamma_dgamma")


@dataclass(frozen=True)
class Bounds:
    """A proved enclosure: the true value lies between `lower` and `upper`, exact rationals."""

    lower: Fraction
    upper: Fraction
    digits: int

    def __contains__(self, value: Exact) -> bool:
        return self.lower <= exact(value) <= self.upper

    def __str__(self) -> str:
        """Write it in decimals, rounded outward."""
        return f"[{', '.join(decimal_bounds(self.lower, self.upper, self.digits))}]"

    def _repr_latex_(self) -> str:
        return "$" + str(self).replace(", ", r",\ ") + "$"


@dataclass(frozen=True)
class Answer:
    """Enclosures by name: `answer["phase"]`. sticks: whether the mass first rests on the table."""

    bounds: tuple[tuple[str, Bounds], ...]
    sticks: bool
    _prove: Callable[[], Proved] = field(compare=False, repr=False)

    @property
    def certificate(self) -> str:
        """A certificate of it that `python -m proofs.check` accepts; of the flight, if it sticks.

        Raises Undecided where the checker's rules do not go as far as the bounds here.
        """
        try:
            return render(groups.certificate(*self._prove()))
        except FAILED as failure:
            raise Undecided(str(failure)) from None

    def __getitem__(self, name: str) -> Bounds:
        """Return the enclosure of that name; KeyError says which there are."""
        known = dict(self.bounds)
        if name not in known:
            raise KeyError(f"{name}: this answer has {', '.join(known)}")
        return known[name]

    def __str__(self) -> str:
        """Write a line for each."""
        return "\n".join(f"{name:14} {each}" for name, each in self.bounds)

    def _repr_html_(self) -> str:
        rows = (
            f"<tr><th>{name}</th><td>{escape(str(each))}</td></tr>" for name, each in self.bounds
        )
        return f"<table>{''.join(rows)}</table>"

    def _repr_latex_(self) -> str:
        rows = (
            rf"{_SYMBOLS[name]} &\in {each._repr_latex_().strip('$')}" for name, each in self.bounds
        )
        return r"$\begin{aligned}" + r" \\ ".join(rows) + r"\end{aligned}$"


class Oscillator:
    """A mass on a spring above a vibrating table: eta = omega_n/omega, nu = -beta/p, epsilon.

    Without epsilon impacts are plastic, and states are phases; with it (0 as well) states are
    phases and velocities gamma = v/(omega_n p) before an impact.
    """

    def __init__(self, eta: Exact, nu: Exact, epsilon: Exact | None = None) -> None:
        self._system = System(exact(eta), exact(nu))
        self._epsilon = None if epsilon is None else exact(epsilon)
        if self._epsilon is not None and not 0 <= self._epsilon < 1:
            raise ValueError(f"epsilon must be in [0, 1), not {epsilon}")

    def __repr__(self) -> str:
        """Return what makes it."""
        numbers = (self._system.eta, self._system.nu, self._epsilon)
        return f"Oscillator({', '.join(repr(show(x)) for x in numbers if x is not None)})"

    def image(
        self, phases: Ends, gamma: Ends | None = None, *, digits: int = 30, horizon: Exact = HORIZON
    ) -> Answer:
        """Enclose the next impact of all states given: flight, phase, slope or velocity and DF.

        Raises Undecided where the map is not continuous on them, or nothing can be said.
        """
        ends, latest, digits = _phases(phases), exact(horizon), _places(digits)
        if not 0 < latest <= LATEST:
            raise ValueError(f"a horizon is a positive number up to {LATEST}")
        if (gamma is None) != (self._epsilon is None):
            raise TypeError("epsilon, of the oscillator, and gamma, of the state, go together")
        if gamma is None or self._epsilon is None:
            found = image(self._system, ends, digits=digits, horizon=latest)
            if isinstance(found, PossibleImages):
                raise Undecided(f"{found.reason}: {len(found.images)} images are possible")
            return _answer(found, digits)
        state = ends, ends_of(gamma), self._epsilon
        return _answer(rebound(self._system, *state, digits=digits, horizon=latest), digits)

    def first_impact(
        self, phases: Ends, gamma: Ends | None = None, *, digits: int = 30, horizon: Exact = HORIZON
    ) -> Bounds:
        """Enclose the time of flight until the first impact, in units of 1/omega."""
        return self.image(phases, gamma, digits=digits, horizon=horizon)["flight"]

    def slope(self, phases: Ends, *, digits: int = 30) -> Bounds:
        """Enclose f' at all phases given; for plastic impacts."""
        if self._epsilon is not None:
            raise TypeError("f' is about plastic impacts; with epsilon, image gives DF")
        return self.image(phases, digits=digits)["slope"]

    def horseshoe(
        self, left: Ends, right: Ends, gamma: Ends | None = None, *, digits: int = 30
    ) -> Theorem:
        """Prove that the map takes each of two sets across both: a horseshoe.

        The sets are intervals of phases; with epsilon, times the interval of velocities gamma.
        Raises Undecided with the reason where that does not succeed.
        """
        sets, digits = (_phases(left), _phases(right)), _places(digits)
        if (gamma is None) != (self._epsilon is None):
            raise TypeError("epsilon, of the oscillator, and gamma, of the sets, go together")
        try:
            if gamma is None:
                return self._plastic_horseshoe(*sets, digits)
            return self._rectangles(*sets, ends_of(gamma), digits)
        except Unproved as failure:
            raise Undecided(str(failure)) from None

    def _plastic_horseshoe(self, left: Range, right: Range, digits: int) -> Theorem:
        of = self._parameters(left, right)
        prover = Prover(self._system, digits, HORIZON)
        parts: list[tuple[str, SlopeRange]] = [prover.slopes(list(x)) for x in (left, right)]
        gap = prover.avoids(of.gap, of.interval)
        name, found = prover.horseshoe(parts, gap, of)
        return _certified(of, prover.steps, {"H5": [*parts, gap], "H8": [(name, found)]}, digits)

    def _rectangles(self, left: Range, right: Range, gamma: Range, digits: int) -> Theorem:
        of = self._parameters(left, right, gamma)
        epsilon = of.epsilon or Fraction(0)
        at = Place.restituting(of.eta, of.nu, epsilon)
        prover = ReboundProver(of, digits)
        name = prover.crossing(at, (left, right))
        found = prover.get(name, Horseshoe)
        theorem = _certified(of, prover.steps, {"N1": [(name, found)]}, digits)
        return Theorem((restituting(found),), theorem.certificate)

    def _parameters(self, left: Range, right: Range, gamma: Range | None = None) -> Parameters:
        eta, nu, one = self._system.eta, self._system.nu, Fraction(1)
        sets = left, right, (left[0], right[1])
        return Parameters(eta, nu, *sets, (one, one), epsilon=self._epsilon, velocities=gamma)


def _places(digits: int) -> int:
    """Return how many significant digits are asked for, as the commands take them."""
    if whole(digits) is None or not 1 <= digits <= MOST_DIGITS:
        raise ValueError(f"digits is a whole number from 1 to {MOST_DIGITS}, not {digits!r}")
    return digits


def _phases(values: Ends) -> Range:
    low, high = ends_of(values)
    if low < 0 or high > TURN:
        raise ValueError(f"phases are from 0 to {show(TURN)}, not {show_range((low, high))}")
    return low, high


def _answer(found: Image | Rebound, digits: int) -> Answer:
    values: list[tuple[str, Range]] = []
    if found.dwell is not None:
        values.append(("dwell", found.dwell))
    values += [("flight", found.flight), ("phase", found.phase)]
    if isinstance(found, Rebound):
        values.append(("velocity", found.velocity))
        values += zip(_DERIVATIVES, found.jacobian, strict=True)
    else:
        values.append(("slope", found.slope))
    bounds = tuple((name, Bounds(*ends, digits)) for name, ends in values)
    return Answer(bounds, found.sticking, found.prove)


def _certified(
    of: Parameters, steps: dict[str, dict[str, object]], proofs: dict[str, Proof], digits: int
) -> Theorem:
    """Return the last conclusion, with a certificate of the claims that it decides."""
    evidence = Evidence(steps, proofs)
    entries = [groups.decide(claim, of, evidence, digits)[1] for claim in proofs]
    *_, last = proofs.values()
    return Theorem((last[-1][1],), render(groups.certificate(of, steps, entries)))

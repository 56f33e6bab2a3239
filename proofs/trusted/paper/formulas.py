"""What is proved about formulas, and claims that follow from it. Trusted, and shared.

A formula is a text in Python's notation: + - * / and ** with integers, pi, sin, cos, sqrt, exp,
log; D(F, x, y) is the derivative of F by x and then by y, at(F, x=G, y=H) is F with G and H put
in the places of x and y at once. Every other name is a real variable.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, between, show_range
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision as RowDecision
from proofs.trusted.verdicts import Found, Row, Verdict, decided
from proofs.trusted.verdicts import undecided as row_undecided


@dataclass(frozen=True)
class Equal(Conclusion):
    """left = right, at all real values of the variables at which all parts of both are defined."""

    left: str
    right: str

    @property
    def sentence(self) -> str:
        """Return the equation."""
        return f"{self.left} = {self.right}, wherever all parts of both sides are defined."


@dataclass(frozen=True)
class Series(Conclusion):
    """function = coefficients[0] + coefficients[1] x + ... + O(x^len(coefficients)) as x -> 0.

    x is the variable, from both sides; at fixed real values of the other variables at which the
    formulas `nonzero` are not 0 and the parts of the coefficients are defined.
    """

    function: str
    variable: str
    coefficients: tuple[str, ...]
    nonzero: tuple[str, ...] = ()

    @property
    def sentence(self) -> str:
        """Return the series."""
        terms = " + ".join(
            f"({each})*{self.variable}**{n}" for n, each in enumerate(self.coefficients)
        )
        where = f" where {', '.join(self.nonzero)} are not 0" if self.nonzero else ""
        return (
            f"{self.function} = {terms} + O({self.variable}**{len(self.coefficients)}) as "
            f"{self.variable} -> 0{where}."
        )


@dataclass(frozen=True)
class Value(Conclusion):
    """The function and all its parts are defined on a box; its values there are in these bounds."""

    function: str
    box: tuple[tuple[str, Range], ...]
    bounds: Range

    @property
    def sentence(self) -> str:
        """Return the bounds."""
        box = ", ".join(f"{name} in {show_range(side)}" for name, side in self.box)
        return f"{self.function} lies in {between(self.bounds)} for {box}."


@dataclass(frozen=True)
class Asked:
    """What a claim asks about a formula on a box: bounds; with a sign, which is to be proved."""

    function: str
    box: tuple[tuple[str, Range], ...]
    signs: tuple[int, ...] = (-1, 0, 1)

    def met_by(self, found: object) -> bool:
        """Whether a conclusion bounds the values, with one of the signs asked for."""
        if not isinstance(found, Value) or (found.function, found.box) != (self.function, self.box):
            return False
        low, high = found.bounds
        return 0 in self.signs or (1 in self.signs and low > 0) or (-1 in self.signs and high < 0)

    def best(self, found: Sequence[Value]) -> Range | None:
        """Return the narrowest bounds among conclusions, None if there are none."""
        met = [value.bounds for value in found if self.met_by(value)]
        return min(met, key=lambda ends: ends[1] - ends[0], default=None)


def _point(places: dict[str, str]) -> tuple[tuple[str, Range], ...]:
    return tuple((name, (Fraction(value), Fraction(value))) for name, value in places.items())


def at(function: str, sign: int = 0, /, **point: str) -> Asked:
    """Ask for the value at an exact point, of a sign if that is not 0."""
    return Asked(function, _point(point), (sign,) if sign else (-1, 0, 1))


def over(function: str, sign: int, variable: str, ends: tuple[str, str], /, **point: str) -> Asked:
    """Ask for a sign while one variable goes over an interval, the others being fixed."""
    side = (variable, (Fraction(ends[0]), Fraction(ends[1])))
    return Asked(function, (side, *_point(point)), (sign,))


def differ(printed: str, derived: str, /, **point: str) -> Asked:
    """Ask for a point at which two formulas have different values."""
    return Asked(f"({printed}) - ({derived})", _point(point), (-1, 1))


Lemma = Equal | Series


@dataclass(frozen=True)
class Derivation:
    """A claim that follows from lemmas and from values.

    decision: what follows, given bounds on the values in their order.
    """

    id: str
    text: str
    lemmas: tuple[Lemma, ...]
    decision: Callable[..., Decision]
    values: tuple[Asked, ...] = ()

    def decide(self, of: Parameters, found: Sequence[object]) -> Decision:
        """Decide the claim: UNDECIDED if something that it follows from is not proved."""
        missing: list[Lemma | Asked] = [lemma for lemma in self.lemmas if lemma not in found]
        bounds = []
        for value in self.values:
            proved = [one.bounds for one in found if isinstance(one, Value) and value.met_by(one)]
            bounds.append(min(proved, key=lambda ends: ends[1] - ends[0]) if proved else None)
            if not proved:
                missing.append(value)
        if missing:
            count = f"{len(missing)} of {len(self.lemmas) + len(self.values)}"
            return undecided(f"not proved: {count} of what it follows from")
        return self.decision(*bounds)

    @property
    def claim(self) -> Claim:
        """The claim, as the catalogue has it."""
        return Claim(self.id, self.text, self.decide)


# -- theorems that follow from formulas ------------------------------------------------------------


@dataclass(frozen=True)
class Theorem(Conclusion):
    """A theorem that follows from proved formulas: its text and, in a line, its point."""

    text: str
    short: str
    tex: str

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        return self.text

    @property
    def brief(self) -> str:
        """Return its point."""
        return self.short or self.text

    @property
    def latex(self) -> str:
        """Return it as a formula."""
        return self.tex


@dataclass(frozen=True)
class Derived:
    """How a theorem follows: what it needs, and its text given bounds on the values in order.

    The docstring of `text` is the proof, in steps that name what they use.
    """

    text: Callable[..., str]
    lemmas: tuple[Lemma, ...]
    values: tuple[Asked, ...]
    short: str
    tex: str

    @property
    def needs(self) -> tuple[Lemma | Asked, ...]:
        """All that has to be proved."""
        return (*self.lemmas, *self.values)

    def prove(self, found: Found) -> Theorem | None:
        """Return the theorem, None if something that it needs is not proved."""
        known = set(found.all(Equal)) | set(found.all(Series))
        bounds = [value.best(found.all(Value)) for value in self.values]
        if not set(self.lemmas) <= known or None in bounds:
            return None
        shown = [between(each) for each in bounds if each is not None]
        return Theorem(self.text(*shown), self.short.format(*shown), self.tex)


def theorem(
    *lemmas: Lemma, values: tuple[Asked, ...] = (), short: str = "", tex: str = ""
) -> Callable[[Callable[..., str]], Derived]:
    """Make a theorem of the function that returns its text; bounds of values are its arguments."""
    return lambda text: Derived(text, lemmas, values, short, tex)


@dataclass(frozen=True)
class DerivedRow(Row):
    """A claim that is decided once its theorems are proved, whatever the parameters.

    because: the theorems that verify, refute or condition it. corrected: those that hold nearby.
    """

    verdict: Verdict = Verdict.UNDECIDED
    because: tuple[Derived, ...] = ()
    corrected: tuple[Derived, ...] = ()

    @property
    def needs(self) -> tuple[Lemma | Asked, ...]:
        """All that has to be proved, once each."""
        parts = (*self.because, *self.corrected)
        return tuple(dict.fromkeys(need for part in parts for need in part.needs))


def derived_row(
    claim: str,
    where: str,
    words: str,
    reading: str,
    verdict: Verdict,
    *because: Derived,
    corrected: tuple[Derived, ...] = (),
) -> DerivedRow:
    """Return the row of a claim that follows from formulas."""

    def decide(of: Parameters, found: Found) -> RowDecision:
        reasons = [each.prove(found) for each in because]
        nearby = [each.prove(found) for each in corrected]
        if None in reasons or None in nearby:
            missing = sum(each is None for each in (*reasons, *nearby))
            return row_undecided(f"{missing} of the theorems that decide it are not proved")
        return decided(
            verdict,
            *(each for each in reasons if each is not None),
            corrected=[each for each in nearby if each is not None],
        )

    return DerivedRow(claim, where, words, reading, decide, None, verdict, because, corrected)

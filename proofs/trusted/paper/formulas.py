"""What is proved about formulas, and claims that follow from it. Trusted, and shared.

What sentences say are the formulas of these statements, not those of a file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.solutions import Expressions
from proofs.trusted.kernel.trees import Places, Tree, Variable, formula
from proofs.trusted.kernel.values import Equal, Series, Value
from proofs.trusted.numbers import Range, between
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

__all__ = ["Equal", "Series", "Value"]  # of the kernel, here too


@dataclass(frozen=True)
class Asked:
    """What a theorem asks about a formula on a box: bounds; with a sign, which is to be proved."""

    function: Tree
    box: tuple[tuple[Variable, Range], ...]
    signs: tuple[int, ...] = (-1, 0, 1)

    def met_by(self, found: Conclusion) -> bool:
        """Whether a conclusion bounds the values, with one of the signs asked for."""
        if not isinstance(found, Value) or found.function != self.function:
            return False
        if found.box != self.box:
            return False
        low, high = found.bounds
        return 0 in self.signs or (1 in self.signs and low > 0) or (-1 in self.signs and high < 0)

    def best(self, found: Found) -> Range | None:
        """Return the narrowest bounds that are proved, None if there are none."""
        met = [value.bounds for value in found.all(Value) if self.met_by(value)]
        return min(met, key=lambda ends: ends[1] - ends[0], default=None)


def _point(places: dict[str, str]) -> tuple[tuple[Variable, Range], ...]:
    sides = sorted((name, Fraction(value)) for name, value in places.items())
    return tuple((Variable(name), (value, value)) for name, value in sides)


def at(function: str, sign: int = 0, /, **point: str) -> Asked:
    """Ask for the value at an exact point, of a sign if that is not 0."""
    return Asked(formula(function), _point(point), (sign,) if sign else (-1, 0, 1))


def differ(printed: str, derived: str, /, **point: str) -> Asked:
    """Ask for a point at which two formulas have different values."""
    return Asked(formula(f"({printed}) - ({derived})"), _point(point), (-1, 1))


@dataclass(frozen=True)
class Unknowns:
    """What a theorem asks for: expressions in some variables that solve equations for unknowns.

    given: what they are, where the theorem says it; else any will do.
    """

    names: tuple[str, ...]
    variables: frozenset[str]
    lemmas: tuple[Equal | Series, ...]
    given: Places = ()

    def met_by(self, found: Conclusion) -> bool:
        """Whether a conclusion has such expressions."""
        return (
            isinstance(found, Expressions)
            and found.lemmas == self.lemmas
            and tuple(name for name, _ in found.expressions) == self.names
            and all(each.free <= self.variables for _, each in found.expressions)
            and self.given in ((), found.expressions)
        )


def unknowns(
    names: str,
    variables: str,
    *lemmas: Equal | Series,
    nonzero: tuple[str, ...] = (),
    given: str = "",
) -> Unknowns:
    """Ask for expressions for these names, in these variables, for which the lemmas hold.

    They are to be defined where the formulas `nonzero` are not 0: h times their sum is O(h) there.
    """
    parts = tuple(names.split())
    defined = Series.read(f"h*({' + '.join(parts)})", "h", ("0",), nonzero)
    places = tuple(zip(parts, map(formula, given.split("; ")), strict=True)) if given else ()
    return Unknowns(parts, frozenset(variables.split()), (defined, *lemmas), places)


# -- theorems that follow from formulas ------------------------------------------------------------


@dataclass(frozen=True)
class Theorem(Conclusion):
    """A theorem that follows from proved formulas; the first sentence of its text is its point."""

    text: str
    tex: str = ""
    reported: tuple[tuple[str, Range], ...] = ()

    @property
    def sentence(self) -> str:
        """Return the theorem."""
        return self.text

    @property
    def brief(self) -> str:
        """Return its point."""
        return self.text.rstrip(".").partition(". ")[0]

    @property
    def latex(self) -> str:
        """Return it as a formula."""
        return self.tex

    @property
    def quantities(self) -> Mapping[str, Range]:
        """Return the values that it reports."""
        return dict(self.reported)


Lemma = Equal | Series | Unknowns
Need = Lemma | Asked


@dataclass(frozen=True)
class Derived:
    """How a theorem follows: all that has to be proved; its text, given bounds on its values.

    The docstring of `text` is the proof, in steps that name the lemmas and the theorems they use.
    """

    text: Callable[..., str]
    needs: tuple[Need, ...]
    values: tuple[Asked, ...]
    tex: str
    reports: tuple[str, ...]

    def prove(self, found: Found) -> Theorem | None:
        """Return the theorem, None if something that it needs is not proved."""
        known = {*found.all(Equal), *found.all(Series)}
        expressions: dict[str, Tree] = {}
        for need in self.needs:
            if isinstance(need, Equal | Series):
                proved = need in known
            else:
                proved = any(map(need.met_by, found.here))
            if not proved:
                return None
            expressions |= dict(need.given) if isinstance(need, Unknowns) else {}
        bounds = [each for value in self.values if (each := value.best(found)) is not None]
        shown = [between(each) for each in bounds]
        reported = tuple(zip(self.reports, bounds, strict=False))
        return Theorem(self.text(*shown, **expressions), self.tex, reported)


def theorem(
    *premises: Lemma | Derived,
    values: tuple[Asked, ...] = (),
    tex: str = "",
    reports: tuple[str, ...] = (),
) -> Callable[[Callable[..., str]], Derived]:
    """Make a theorem of the function that returns its text.

    premises: lemmas, and theorems, that its proof uses. values: bounds on them are the arguments of
    the function; the first ones are reported by these names.
    """
    needs: list[Need] = []
    for each in premises:
        needs += each.needs if isinstance(each, Derived) else [each]
    whole = tuple(dict.fromkeys((*needs, *values)))
    return lambda text: Derived(text, whole, values, tex, reports)


def corollary(
    text: str,
    *premises: Lemma | Derived,
    values: tuple[Asked, ...] = (),
    tex: str = "",
    reports: tuple[str, ...] = (),
) -> Derived:
    """Return a theorem that says of itself why it holds; {0}, {1} in its text are the bounds."""
    return theorem(*premises, values=values, tex=tex, reports=reports)(text.format)


class Passage(NamedTuple):
    """Where the paper makes a claim: the claim's id, the place, a few of the paper's words."""

    id: str
    where: str
    words: str


def derived_row(
    passage: Passage,
    reading: str,
    verdict: Verdict,
    *because: Derived,
    corrected: tuple[Derived, ...] = (),
) -> Row:
    """Return the row of a claim that follows from formulas.

    because: the theorems that verify, refute or condition it. corrected: those that hold nearby.
    """

    def decide(of: Parameters, found: Found) -> Decision:
        reasons = [proved for each in because if (proved := each.prove(found)) is not None]
        nearby = [proved for each in corrected if (proved := each.prove(found)) is not None]
        missing = len(because) + len(corrected) - len(reasons) - len(nearby)
        if missing:
            return undecided(f"{missing} of the theorems that decide it are not proved")
        return decided(verdict, *reasons, corrected=nearby)

    needs = dict.fromkeys(need for each in (*because, *corrected) for need in each.needs)
    return Row(*passage, reading, decide, needs=tuple(needs))

"""What the cells of an atlas are about: the paper's oscillator, or a system that functions give."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar, Protocol

from proofs.trusted.certificate import Reader, texts
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Place
from proofs.trusted.questions import Question, map_question, question
from proofs.trusted.verify import Report

Box = tuple[Range, Range]


class Subject(Protocol):
    """Systems, one for each pair of values of two parameters.

    cuts: a value of each parameter, or None, at which a region of them is cut.
    """

    @property
    def names(self) -> tuple[str, str]: ...
    @property
    def cuts(self) -> tuple[Fraction | None, Fraction | None]: ...
    def question(self, name: str) -> Question:
        """Return what is asked under a name; ValueError where that is nothing."""

    def require(self, first: Range, second: Range, asked: str) -> None:
        """Raise ValueError where there are no such systems, or that is not asked of them."""

    def written(self, box: Box, asked: str) -> dict[str, Any]:
        """Return the head of an atlas, as it is written."""

    def is_about(self, certificate: Reader, report: Report, box: Box) -> bool:
        """Whether a certificate with this report is about all systems of a box."""


@dataclass(frozen=True)
class Oscillators:
    """The paper's oscillators by eta and nu; epsilon as in `Place`."""

    epsilon: Range | None = None
    names: ClassVar = ("eta", "nu")
    cuts: ClassVar = (Fraction(1), Fraction(0))

    def question(self, name: str) -> Question:
        """Return what is asked under a name."""
        return question(name)

    def require(self, first: Range, second: Range, asked: str) -> None:
        """Raise ValueError where this is no oscillator, or that is not asked of it."""
        least, most = self.epsilon or (Fraction(0),) * 2
        if first[0] <= 0:
            raise ValueError("eta must be positive")
        if not 0 <= least <= most < 1:
            raise ValueError("epsilon: a number or a range in [0, 1) is expected")
        if question(asked).plastic and self.epsilon is not None:
            raise ValueError(f"{asked} is asked for plastic impacts alone, without epsilon")

    def at(self, box: Box) -> Place:
        """Return the oscillators of a box; Unproved for a strip at nu = 0."""
        return Place(*box, self.epsilon)

    def written(self, box: Box, asked: str) -> dict[str, Any]:
        """Return the head of an atlas."""
        more = {} if self.epsilon is None else {"epsilon": texts(self.epsilon)}
        return {"eta": texts(box[0]), "nu": texts(box[1]), "question": asked, **more}

    @classmethod
    def read(cls, document: Reader) -> tuple[str, Range, Range, str, Oscillators]:
        """Read the head: schema, ranges, question, and what it is about."""
        more = ["epsilon"] if document.has("epsilon") else []
        schema, eta, nu, name, *rest = document.fields("schema", "eta", "nu", "question", *more)
        made = cls(*(each.range() for each in rest))
        return schema.string(), eta.range(), nu.range(), name.string(), made

    def is_about(self, certificate: Reader, report: Report, box: Box) -> bool:
        """Whether what a certificate says is about all oscillators of a box.

        Its steps may be about other ones, and about functions of its own.
        """
        return all(each.place == self.at(box) for each in report.conclusions)


PLASTIC = Oscillators()


@dataclass(frozen=True)
class Systems:
    """A map, one of `functions`, by two of its parameters; the others have values, or ranges.

    functions: as a certificate has them. region: where its orbits are looked for.
    """

    functions: Mapping[str, Any]
    function: str
    names: tuple[str, str]
    region: tuple[Range, ...] = ()
    cuts: ClassVar = (None, None)

    def question(self, name: str) -> Question:
        """Return what is asked under a name."""
        return map_question(name, self.function)

    def require(self, first: Range, second: Range, asked: str) -> None:
        """Raise ValueError where the functions have no such parameters."""
        map_question(asked, self.function)
        known = {name for each in self.functions.values() for name in each.get("parameters", {})}
        if unknown := [name for name in self.names if name not in known]:
            raise ValueError(f"the system has no parameter {unknown[0][:30]!r}")
        if self.names[0] == self.names[1]:
            raise ValueError("two different parameters are expected")

    def at(self, box: Box) -> dict[str, Any]:
        """Return the functions for all values in a box."""
        sides = dict(zip(self.names, map(texts, box), strict=True))
        return {
            name: {
                field: {each: sides.get(each, ends) for each, ends in value.items()}
                if field == "parameters"
                else value
                for field, value in function.items()
            }
            for name, function in self.functions.items()
        }

    def written(self, box: Box, asked: str) -> dict[str, Any]:
        """Return the head of an atlas."""
        return {
            "parameters": dict(zip(self.names, map(texts, box), strict=True)),
            "question": asked,
            "functions": self.functions,
            "function": self.function,
            "region": [texts(side) for side in self.region],
        }

    @classmethod
    def read(cls, document: Reader) -> tuple[str, Range, Range, str, Systems]:
        """Read the head: schema, ranges, question, and what it is about."""
        schema, sides, name, functions, function, region = document.fields(
            "schema", "parameters", "question", "functions", "function", "region"
        )
        named = [(each, value.range()) for each, value in sides.members()]
        if len(named) != 2:
            raise sides.fail("two parameters are expected")
        for _, each in functions.members():
            for field, value in each.entries():
                if field == "parameters":
                    list(value.entries())
        (one, first), (two, second) = named
        box = tuple(side.range() for side in region.items(0, 12))
        made = cls(functions.value, function.string(), (one, two), box)
        return schema.string(), first, second, name.string(), made

    def is_about(self, certificate: Reader, report: Report, box: Box) -> bool:
        """Whether a certificate's functions are those at a box, as far as it has them."""
        known = self.at(box)
        own = certificate.value["functions"]
        return all(known.get(name) == function for name, function in own.items())

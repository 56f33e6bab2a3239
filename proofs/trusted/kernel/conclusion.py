"""What is proved, as a value."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from proofs.trusted.kernel.arithmetic import Unproved

if TYPE_CHECKING:
    from proofs.trusted.kernel.arithmetic import Enclosure
    from proofs.trusted.numbers import Range
    from proofs.trusted.parameters import Place


class Subject(Protocol):
    """A map, as conclusions speak of it; if it is the oscillator's, `at` says which.

    periods: of those variables that are angles, by their places.
    """

    @property
    def name(self) -> str: ...
    @property
    def definition(self) -> str: ...
    def periods(self, bits: int) -> dict[int, Enclosure]: ...


def given(subject: Subject) -> str:
    """Begin a sentence about a map; what the oscillator's is, the text before says."""
    return "" if getattr(subject, "at", None) else f"for {subject.definition}: "


def named(subject: Subject) -> str:
    """Return a map's name, between backquotes if a file gives it."""
    return subject.name if getattr(subject, "at", None) else f"`{subject.name}`"


class About:
    """As `at` in a conclusion: the oscillators are those of the part of that name."""

    def __init__(self, part: str) -> None:
        self.part = part

    def __get__(self, conclusion: Conclusion, _: type) -> Place:
        """Return them; TypeError, not AttributeError, which `Conclusion.place` takes for none.

        Unproved where the part is about another map.
        """
        part: Conclusion | None = getattr(conclusion, self.part, None)
        if part is None or (part.place is None and not part.is_foreign):
            raise TypeError(f"no oscillators of the part {self.part!r}")
        return place_of(part)


class Conclusion:
    """What a rule or a theorem yields: one immutable value that carries all that it is about.

    Subclasses are frozen dataclasses. Their constructor raises Unproved unless the data are
    canonical (ordered, disjoint, of positive width), and theorems are functions from conclusions to
    a conclusion. Nothing is printed about the mathematics but what conclusions print of themselves.
    """

    @property
    def place(self) -> Place | None:
        """The oscillators that it is about, its own or its map's `at`; None if there are none."""
        place: Place | None = getattr(self, "at", None)
        return place or getattr(getattr(self, "function", None), "at", None)

    @property
    def is_foreign(self) -> bool:
        """Whether it is about a map, and that is not the oscillator's."""
        return self.place is None and hasattr(getattr(self, "function", None), "definition")

    @property
    def kind(self) -> str:
        """Return the name by which pictures and counts tell conclusions apart."""
        return type(self).__name__

    @property
    def sentence(self) -> str:
        """Return it in words, complete but for `at`; names aside, nothing from a file's texts."""
        raise NotImplementedError

    @property
    def brief(self) -> str:
        """Return it in a line, its numbers first, without the full stop."""
        return self.sentence.rstrip(".")

    @property
    def latex(self) -> str:
        """Return it as a formula in LaTeX; "" where the sentence says it better."""
        return ""

    @property
    def quantities(self) -> Mapping[str, Range]:
        """Return the enclosures that it reports, by name."""
        return {}


class AboutMap(Conclusion):
    """What is concluded about a map."""

    function: Subject

    @property
    def place(self) -> Place | None:
        """The map's oscillators, if it is theirs."""
        place: Place | None = getattr(self.function, "at", None)
        return place

    @property
    def at(self) -> Place:
        """The same; Unproved where it is another map."""
        return place_of(self)


def place_of(conclusion: Conclusion) -> Place:
    """Return the oscillators that a conclusion is about; Unproved where it is about another map."""
    if conclusion.place is None:
        raise Unproved("a map that is not the oscillator's")
    return conclusion.place

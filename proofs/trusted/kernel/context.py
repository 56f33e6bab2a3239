"""What a rule may use: the statement's numbers, the file's functions, the steps before it."""

from __future__ import annotations

from dataclasses import dataclass, field
from importlib import import_module
from typing import TYPE_CHECKING, TypeVar

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.parameters import Parameters, Place

if TYPE_CHECKING:
    from proofs.trusted.kernel.maps import Map

C = TypeVar("C", bound=Conclusion)
OSCILLATOR = "proofs.trusted.oscillator"


@dataclass
class Context:
    """The premises of a step: the statement's numbers, the file's functions, the steps before."""

    parameters: Parameters | Place | None = None
    functions: dict[str, Map] = field(default_factory=dict)
    known: dict[str, Conclusion] = field(default_factory=dict)

    @property
    def of(self) -> Parameters:
        """The statement's numbers; Unproved in a file that has none."""
        if not isinstance(self.parameters, Parameters):
            raise Unproved("the rule is about one oscillator, and the file is not")
        return self.parameters

    @property
    def oscillators(self) -> Place:
        """The oscillators: that of the statement, or all of the box that the file is about."""
        return self.parameters if isinstance(self.parameters, Place) else self.of.place

    @property
    def place(self) -> Place:
        """The same, where impacts are plastic, as nearly all rules require; else Unproved."""
        if self.oscillators.epsilon is not None:
            raise Unproved("the rule is about plastic impacts, and the file is not")
        return self.oscillators

    def function(self, name: Reader) -> Map:
        """Return the function of that name; or the paper's map, for {eta, nu, epsilon}: ranges."""
        if name.has(
            "eta"
        ):  # which no file words: as the rules, it is imported where it is asked for
            paper: Map = import_module(OSCILLATOR).read_oscillator(name)
            return paper
        if name.string() not in self.functions:
            raise name.fail(f"names no function: {name.string()[:40]!r}")
        return self.functions[name.string()]

    def step(self, name: Reader, kind: type[C]) -> C:
        """Return the conclusion of an earlier step of one kind."""
        step = self.known.get(name.string())
        if not isinstance(step, kind):
            raise name.fail(f"names no earlier step that is a {kind.__name__}")
        return step

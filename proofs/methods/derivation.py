"""A certificate in the making, from steps that the checker's own rules conclude."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from proofs.trusted.certificate import SCHEMA, Reader, used_steps
from proofs.trusted.files import render
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.maps import Map
from proofs.trusted.rules import find_rule


@dataclass
class Derivation:
    """A certificate in the making: what a rule does not conclude from a witness is not added."""

    functions: Mapping[str, Any]
    steps: dict[str, Any] = field(default_factory=dict)
    context: Context = field(default_factory=Context)

    def __post_init__(self) -> None:
        for name, function in self.functions.items():
            self._define(name, function)

    def _define(self, name: str, function: Any) -> None:
        maps = self.context.functions
        maps[name] = read_map(name, Reader(function, f"$.functions.{name}"), maps)

    def map(self, name: str) -> Map:
        """Return a function as the checker reads it."""
        return self.context.functions[name]

    def add(self, rule: str, witness: Mapping[str, Any], kind: str = "") -> str:
        """Add a step that its rule concludes, and return its name; raises Unproved otherwise.

        kind: how the name begins, if not as the rule's.
        """
        return self.record(rule, witness, concluded(rule, witness, self.context), kind)

    def record(
        self, rule: str, witness: Mapping[str, Any], conclusion: Conclusion, kind: str = ""
    ) -> str:
        """Add a step with what its rule concludes, and return its name."""
        kind = kind or rule.removeprefix("formula-")
        name = f"{kind}-{1 + sum(x['rule'] == rule for x in self.steps.values())}"
        self.steps[name] = {"rule": rule, "witness": dict(witness)}
        self.known[name] = conclusion
        return name

    @property
    def known(self) -> dict[str, Conclusion]:
        """What the steps conclude."""
        return self.context.known

    def forget(self, names: set[str]) -> None:
        """Take steps out again, on which no other one rests."""
        for name in names:
            del self.steps[name], self.known[name]

    @contextmanager
    def undone(self) -> Iterator[None]:
        """Take back the steps and functions made inside if that fails; the failure goes on."""
        functions = self.functions
        tables: list[dict[str, Any]] = [self.steps, self.known, self.context.functions]
        before = [dict(table) for table in tables]
        try:
            yield
        except Exception:
            self.functions = functions
            for table, entries in zip(tables, before, strict=True):
                table.clear()
                table.update(entries)
            raise

    def conclusion(self, name: str) -> Conclusion:
        """Return what a step concludes."""
        return self.known[name]

    def document(self, *claims: str) -> dict[str, Any]:
        """Return what a certificate of some steps says, with what they need.

        Without names all steps but h-sets are claims.
        """
        named = claims or [name for name, step in self.steps.items() if step["rule"] != "h-set"]
        needed = used_steps(Reader(self.steps), {*named})
        return {
            "schema": SCHEMA,
            "parameters": None,
            "functions": _needed(self.functions, needed),
            "steps": {name: step for name, step in self.steps.items() if name in needed},
            "claims": list(named),
        }

    def certificate(self, *claims: str) -> str:
        """Return the text of a certificate of some steps."""
        return render(self.document(*claims))


def _needed(functions: Mapping[str, Any], names: set[str]) -> dict[str, Any]:
    """Return the functions that are named, and those of which these are composed."""
    needed = set(names)
    for name, each in reversed([*functions.items()]):
        if name in needed:
            needed.update(each.get("maps", ()))
    return {name: each for name, each in functions.items() if name in needed}


def concluded(rule: str, witness: Mapping[str, Any], context: Context) -> Any:
    """Return what the checker's rule concludes from a witness, or raise as it does."""
    derive = find_rule(rule)
    if derive is None:
        raise ValueError(f"no rule {rule}")
    return derive(context, Reader(dict(witness)))

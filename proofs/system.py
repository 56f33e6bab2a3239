"""Your own impacting system: `from proofs import System`, from a file of some ten lines.

>>> from proofs import System
>>> ball = System.example("bouncing-ball")
>>> print(ball.variables)
('phi', 'v')
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any, Self

from intervals import Undecided
from proofs.map import Ends, Map, ends_of, optional
from proofs.methods.grammar import GrammarError, canonical, name
from proofs.theorem import Theorem

_HEAD = {"variables", "time", "motion", "impact"}
_MORE = {"title", "source", "units", "parameters", "periods", "region"}


class System(Map):
    """A motion between impacts, gaps that end it, and the state after an impact: a map of states.

    The map takes the state after an impact to that after the next. All that `Map` proves is proved
    about it; `impact` has the time as well. Make one with `System.read` or `System.example`.
    """

    def __init__(self, file: Mapping[str, Any], /, **parameters: Ends) -> None:
        system = _Read(file, parameters)
        self.title = str(file.get("title", ""))
        self.notes = {key: str(file[key]) for key in ("source", "units") if key in file}
        self._begin({"P": system.flight(), "Impact": system.flight(timed=True)}, "P")
        self.functions = {"P": self.functions["P"]}
        self._timed = {"Impact": system.flight(timed=True)}
        self.box = dict(file.get("region", {}))

    @classmethod
    def read(cls, path: str | Path, **parameters: Ends) -> Self:
        """Read a system's file (TOML); parameters: instead of those of the file.

        Raises ValueError, in a sentence, where it is none, OSError where it cannot be read.
        """
        text = Path(path).read_text("utf-8")
        try:
            return cls(tomllib.loads(text), **parameters)
        except tomllib.TOMLDecodeError as error:
            raise GrammarError(f"{path}: {error}") from None
        except ValueError as error:
            raise GrammarError(f"{path}: {error}") from None

    @classmethod
    def example(cls, which: str, **parameters: Ends) -> Self:
        """Read a published system that comes with the package; `examples` has the names."""
        if which not in cls.examples():
            raise ValueError(f"no system {which!r}; there are {', '.join(cls.examples())}")
        text = (files("proofs.systems") / f"{which}.toml").read_text("utf-8")
        return cls(tomllib.loads(text), **parameters)

    @staticmethod
    def examples() -> list[str]:
        """Return the names of the systems that come with the package."""
        names = (each.name for each in files("proofs.systems").iterdir())
        return sorted(each.removesuffix(".toml") for each in names if each.endswith(".toml"))

    def impact(self, **state: Ends) -> Theorem:
        """Enclose the next impact after a state, or after all states of a box: state and time."""
        from proofs.methods.derivation import Derivation

        return self._image(Derivation(self._timed), "Impact", state)


class _Read:
    """A system's file, as it is read: every failure is a sentence."""

    def __init__(self, file: Mapping[str, Any], given: Mapping[str, Ends]) -> None:
        self.file = file
        for key in _HEAD:
            if key not in file:
                raise GrammarError(f"the system has no {key!r}")
        if unknown := sorted({*file} - _HEAD - _MORE):
            raise GrammarError(f"unknown key {unknown[0]!r}; keys are {_listed(_HEAD | _MORE)}")
        self.state = [name(each) for each in _list(file["variables"], "variables")]
        self.time = name(str(file["time"]))
        own = file.get("parameters", {})
        if unknown := sorted({*given} - {*own}):
            raise GrammarError(f"the system has no parameter {unknown[0]!r}")
        self.parameters = {name(each): value for each, value in {**own, **given}.items()}
        for each, value in self.parameters.items():
            if isinstance(value, float) or value in (None, ""):
                raise GrammarError(f'the parameter {each} is no text: write {each} = "{value}"')
        self.impacts = _list(file["impact"], "impact")

    def flight(self, timed: bool = False) -> dict[str, Any]:
        """Return the flight as a certificate has it; timed: with the time as a last value."""
        if len(self.impacts) > 1:
            raise GrammarError("one [[impact]] is expected; other walls are its `others`")
        impact = dict(_table(self.impacts[0], "impact"))
        keys = {"gap", "others", *self.state}
        if unknown := sorted({*impact} - keys):
            raise GrammarError(f"unknown key {unknown[0]!r} of impact; keys are {_listed(keys)}")
        if missing := [each for each in ("gap", *self.state) if each not in impact]:
            raise GrammarError(f"[[impact]] has no {missing[0]!r}")
        gaps = [impact["gap"], *_list(impact.get("others", []), "others")]
        values = [self._formula(impact[each], f"{each} after the impact") for each in self.state]
        return {
            "variables": self.state,
            **optional(self.parameters, self.file.get("periods", {})),
            "time": self.time,
            "motion": [
                self._motion(name(each), _table(motion, each))
                for each, motion in _table(self.file["motion"], "motion").items()
            ],
            "gaps": [self._formula(gap, "a gap") for gap in gaps],
            "values": [*values, *([self.time] if timed else [])],
        }

    def _motion(self, which: str, motion: Mapping[str, Any]) -> dict[str, Any]:
        keys = {"equation", "start", "form"}
        if unknown := sorted({*motion} - keys):
            raise GrammarError(f"unknown key {unknown[0]!r} of {which}; keys are {_listed(keys)}")
        for key in ("equation", "start"):
            if key not in motion:
                raise GrammarError(f"[motion.{which}] has no {key!r}")
        start = [self._formula(each, "a start") for each in _list(motion["start"], "start")]
        left, equals, right = str(motion["equation"]).partition("=")
        if left.strip() != which + "'" * len(start) or not equals:
            wanted = which + "'" * len(start)
            raise GrammarError(
                f"the equation of {which} begins {wanted} =, as {len(start)} numbers start it"
            )
        equation = self._formula(right, f"the equation of {which}")
        if "form" in motion:
            form = self._formula(motion["form"], f"the form of {which}")
        else:
            form = self._closed(which, equation, start)
        return {"name": which, "form": form, "equation": equation, "start": start}

    def _closed(self, which: str, equation: str, start: Sequence[str]) -> str:
        """Return a closed form that sympy finds, parameters with one value being put in."""
        from proofs.methods.linear import closed_form

        sides = {each: ends_of(value) for each, value in self.parameters.items()}
        numbers = {each: low for each, (low, high) in sides.items() if low == high}
        try:
            return closed_form(which, self.time, equation, start, numbers)
        except Undecided as error:
            raise GrammarError(f"{error}: give its `form` in the file") from None

    def _formula(self, text: Any, what: str) -> str:
        try:
            return canonical(text, self.time)
        except GrammarError as error:
            raise GrammarError(f"{what}: {error}") from None


def _listed(keys: set[str]) -> str:
    return ", ".join(sorted(keys))


def _list(value: Any, what: str) -> list[Any]:
    if not isinstance(value, list):
        raise GrammarError(f"{what!r} is a list")
    return value


def _table(value: Any, what: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise GrammarError(f"{what!r} is a table")
    return value

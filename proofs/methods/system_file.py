"""A system's file, read: parts of flights and flows as certificates have them, or a sentence."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from intervals import Undecided
from proofs.methods.ends import Ends, exact_sides, optional
from proofs.methods.grammar import GrammarError, canonical, name, names, typed
from proofs.methods.orders import FirstOrder, first_order

_HEAD = {"variables", "time", "motion"}
_MORE = {"title", "source", "units", "parameters", "periods", "region", "flow", "impact", "end"}
_END = {"time", "section", "direction", "count"}
_IMPACT = {"gap", "wall", "at", "next", "rest"}


class SystemFile:
    """A system's file, as it is read: every failure is a sentence."""

    def __init__(self, file: Mapping[str, Any], given: Mapping[str, Ends]) -> None:
        self.file = file
        for key in _HEAD:
            if key not in file:
                raise GrammarError(f"the system has no {key!r}")
        if unknown := sorted({*file} - _HEAD - _MORE):
            raise GrammarError(f"unknown key {unknown[0]!r}; keys are {_listed(_HEAD | _MORE)}")
        typed = _list(file["variables"], "variables")
        self.names = {str(each): name(str(each)) for each in typed}
        if len(self.names) < len(typed):
            raise GrammarError("two variables have one name")
        self.state = [*self.names.values()]
        self.time = name(str(file["time"]))
        own = _table(file.get("parameters", {}), "parameters")
        if unknown := sorted({*given} - {*own}):
            raise GrammarError(f"no parameter {unknown[0]!r}; there are {', '.join(own) or 'none'}")
        self.parameters: dict[str, Ends] = {**own, **given}
        if file.get("flow", "closed") not in ("closed", "validated"):
            raise GrammarError('flow is "validated", or "closed", which it is without this key')
        self.is_validated = file.get("flow") == "validated"
        if "end" in file and ("impact" in file or not self.is_validated):
            raise GrammarError('[end] is in the place of [[impact]], and needs flow = "validated"')
        ends = [file["end"]] if "end" in file else _list(file.get("impact", []), "impact")
        self.impacts = [_table(each, "impact") for each in ends]
        self.region = _table(file.get("region", {}), "region")
        if not self.impacts:
            raise GrammarError("one [[impact]] at least, or an [end], is expected")
        self.walls = tuple(str(each.get("wall", k + 1)) for k, each in enumerate(self.impacts))
        if len({*self.walls}) < len(self.walls):
            raise GrammarError("two walls have one name")
        self._motions: dict[int, list[dict[str, Any]]] = {}
        for wall in (k for k, each in enumerate(self.impacts) if "rest" in each):
            self.contact(wall)

    def require_used(self) -> None:
        """Raise GrammarError where a parameter is in no formula: it may be another's old name."""
        used = [self.file.get(key) for key in ("motion", "periods", "impact", "end")]
        if unused := sorted({*self.parameters} - {*re.findall(r"[A-Za-z]\w*", str(used))}):
            raise GrammarError(f"the parameter {unused[0]} is in none of the formulas")

    def map(self, before: int, after: int, timed: bool = False) -> dict[str, Any]:
        """Return the flight or flow from one wall to another as a certificate has it.

        timed: with the time as a last value.
        """
        impact = self._impact(after)
        gaps = [impact, *(self._impact(k) for k in self.next(before) if k != after)]
        values = [self._formula(impact[each], f"{each} after the impact") for each in self.state]
        values += [self.time] if timed else []
        if before not in self._motions:
            self._motions[before] = [
                self._motion(each, _table(motion, each), self._here(before))
                for each, motion in _table(self.file["motion"], "motion").items()
            ]
        head = {
            "variables": self.state,
            **optional(self._here(before), self.file.get("periods", {})),
            "time": self.time,
        }
        if not self.is_validated:
            ends = [self._formula(each["gap"], "a gap") for each in gaps]
            return {**head, "motion": self._motions[before], "gaps": ends, "values": values}
        system = first_order(self._motions[before], self.time)
        return {
            **head,
            "state": system.state,
            "field": system.field,
            "start": system.start,
            "end": self._end(system, gaps),
            "values": [*map(system.formula, values)],
        }

    def _end(
        self, system: FirstOrder, gaps: Sequence[Mapping[str, Any]]
    ) -> dict[str, str | list[str]]:
        end = gaps[0]
        if "end" not in self.file:
            texts = [self._formula(each["gap"], "a gap") for each in gaps]
            return {"gaps": list(map(system.formula, texts))}
        if "time" in end:
            return {"time": system.formula(self._formula(end["time"], "the time"))}
        section = system.formula(self._formula(end["section"], "the section"))
        count, direction = str(end.get("count", 1)), str(end.get("direction", "-"))
        return {"section": section, "direction": direction, "count": count}

    def _here(self, wall: int) -> dict[str, Ends]:
        """Return the parameters, and what else has a value after an impact with a wall.

        Such a value is a number, or the name of a parameter.
        """
        own = _table(self.impacts[wall].get("at", {}), "at")
        known = {each: self.parameters.get(str(value), value) for each, value in own.items()}
        try:
            exact_sides(known)
        except ValueError as error:
            raise GrammarError(f"at: {error}; a number, or a parameter, is expected") from None
        return {**self.parameters, **known}

    def next(self, wall: int) -> list[int]:
        """Return the walls that may be hit after one: all, or those of its key `next`."""
        names = _list(self.impacts[wall].get("next", [*self.walls]), "next")
        if unknown := [each for each in names if each not in self.walls]:
            raise GrammarError(f"next: no wall {unknown[0]!r}; there are {', '.join(self.walls)}")
        return [self.walls.index(each) for each in names]

    def contact(self, wall: int) -> dict[str, str]:
        """Return what variables are, by formulas of the others, where the motion rests."""
        impact = self.impacts[wall]
        if "rest" not in impact:
            raise GrammarError(
                "[[impact]] has no 'rest', what the state is in contact: as rest = { v = \"0\" }"
            )
        rest = {name(each): text for each, text in _table(impact["rest"], "rest").items()}
        if unknown := sorted({*rest} - {*self.state}):
            raise GrammarError(f"rest: {unknown[0]} is none of the variables")
        return {each: self._formula(text, f"{each} at rest") for each, text in rest.items()}

    def _impact(self, wall: int) -> Mapping[str, Any]:
        impact, which = self.impacts[wall], "end" if "end" in self.file else "impact"
        keys = {*self.names, *(_END if which == "end" else _IMPACT)}
        if unknown := sorted({*impact} - keys):
            raise GrammarError(f"unknown key {unknown[0]!r} of {which}; keys are {_listed(keys)}")
        first = "gap" if which == "impact" else "time" if "time" in impact else "section"
        if missing := [each for each in (first, *self.names) if each not in impact]:
            raise GrammarError(f"[[{which}]] has no {missing[0]!r}")
        return {self.names.get(each, each): value for each, value in impact.items()}

    def _motion(
        self, which: str, motion: Mapping[str, Any], parameters: Mapping[str, Ends]
    ) -> dict[str, Any]:
        keys = {"equation", "start", *(() if self.is_validated else ("form",))}
        if unknown := sorted({*motion} - keys):
            raise GrammarError(f"unknown key {unknown[0]!r} of {which}; keys are {_listed(keys)}")
        for key in ("equation", "start"):
            if key not in motion:
                raise GrammarError(f"[motion.{which}] has no {key!r}")
        start = [self._formula(each, "a start") for each in _list(motion["start"], "start")]
        left, _, right = str(motion["equation"]).partition("=")
        wanted, count = which + "'" * len(start), len(start)
        if left.strip() != wanted:
            raise GrammarError(
                f"the equation of {which} begins {wanted} = ...: `start` has {count} "
                f"value{'s'[: count > 1]}, and the derivative that comes next stands alone"
            )
        equation = self._formula(right, f"the equation of {which}")
        which = name(which)
        if self.is_validated:
            return {"name": which, "equation": equation, "start": start}
        coupled = sorted({*names(equation)} & {*map(name, self.file["motion"])} - {which})
        if "form" in motion:
            form = self._formula(motion["form"], f"the form of {which}")
        elif coupled:
            raise GrammarError(
                f"{typed(coupled[0])} is in the equation of {typed(which)}, and forms are found of "
                'one equation alone: give the form of each, or flow = "validated"'
            )
        else:
            form = self._closed(which, equation, start, parameters)
        return {"name": which, "form": form, "equation": equation, "start": start}

    def _closed(
        self, which: str, equation: str, start: Sequence[str], parameters: Mapping[str, Ends]
    ) -> str:
        """Return a closed form that sympy finds, parameters with one value being put in."""
        from proofs.methods.linear import closed_form

        sides = exact_sides(parameters)
        numbers = {each: low for each, (low, high) in sides.items() if low == high}
        try:
            return closed_form(which, self.time, equation, start, numbers)
        except Undecided as error:
            raise GrammarError(f'{error}: give its `form`, or flow = "validated"') from None

    def _formula(self, text: Any, what: str) -> str:
        try:
            return canonical(text, self.time)
        except GrammarError as error:
            raise GrammarError(f"{what}: {error}") from None


def _listed(keys: set[str]) -> str:
    return ", ".join(sorted(keys))


def _list(value: Any, what: str) -> list[Any]:
    if not isinstance(value, list):
        hint = f": write [[{what}]]" if isinstance(value, Mapping) else ""
        raise GrammarError(f"{what!r} is a list{hint}")
    return value


def _table(value: Any, what: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise GrammarError(f"{what!r} is a table")
    return value

"""Your own impacting system: `from proofs import System`, from a file of some ten lines.

>>> from proofs import System
>>> ball = System.example("bouncing-ball")
>>> print(ball.variables)
('phi', 'v')
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from copy import copy
from importlib.resources import files
from pathlib import Path
from typing import Any, Self

from intervals import Undecided
from proofs.map import Map, theorem_of
from proofs.methods.ends import Ends, box_of, ends_of, exact_sides, optional
from proofs.methods.grammar import GrammarError, typed
from proofs.methods.system_file import SystemFile
from proofs.theorem import Theorem
from proofs.trusted.numbers import Range

_ADVICE = {  # what a reason means in the motion, what is not proved, and the next step
    "it is not proved that the gap is > 0": "where impacts get slower and slower, as in chatter, "
    "none of them is next to a launch like that, and that they accumulate is not proved; give "
    "states that leave the wall faster, or ask for `rest`",
    "a gap is not proved > 0 at launch": "give a state between the walls",
    "a graze": "the motion may touch a wall there; give fewer states, or ask for `graze`",
    "no impact": "the mass may never hit a wall again, which is proved where its gap is bounded "
    "from below, term by term, for all late times",
    "> 0 up to the time": "two walls may be hit at once, and then no state after it is given; "
    "give fewer states",
    "the impact is not": "the motion may touch the wall there; give fewer states",
    "the gap is < 0 right after launch": "give a state with which the gap opens",
}


class System(Map):
    """A motion between impacts, gaps that end it, and the state after an impact: a map of states.

    With one [[impact]] the map takes the state after an impact to that after the next. With several
    walls it takes a state after an impact with the first wall to that after the next one, each of
    the walls being hit once, in the order of the file, or in that of `around`. With [end] in the
    place of impacts the map goes to a time, or to a section. With flow = "validated" the equations
    need no closed form: the checker takes Taylor steps itself. All that `Map` proves is proved
    about it; `impact` has the time as well. Make one with `System.read` or `System.example`.
    """

    def __init__(self, file: Mapping[str, Any], /, **parameters: Ends) -> None:
        self._file, self._given = SystemFile(file, parameters), dict(parameters)
        self.title = str(file.get("title", ""))
        self.notes = {key: str(file[key]) for key in ("source", "units") if key in file}
        self._turn(range(len(self._file.impacts)))
        self._file.require_used()

    def _turn(self, walls: Sequence[int]) -> None:
        pairs = [*zip(walls, (*walls[1:], walls[0]), strict=True)]
        names = ["P" if len(self.walls) == 1 else f"P{i + 1}{j + 1}" for i, j in pairs]
        functions = {
            which: self._file.map(i, j) for which, (i, j) in zip(names, pairs, strict=True)
        }
        if len(names) > 1:
            functions["R"] = {"maps": names}
        self._begin(functions, "R" if len(names) > 1 else names[0])
        self.box = dict(self._file.region)

    @property
    def walls(self) -> tuple[str, ...]:
        """The names of the walls, in the order of the file."""
        return self._file.walls

    def around(self, *walls: str) -> System:
        """Return the system with the map that hits these walls in turn, back to the first."""
        if not walls:
            raise ValueError(f"walls are expected, of {', '.join(self.walls)}")
        other = copy(self)
        other._turn([*map(self._wall, walls)])
        return other

    def at(self, **parameters: Ends) -> Self:
        """Return the same with other values, or ranges, of some parameters."""
        other = type(self)(self._file.file, **{**self._given, **parameters})
        other.box, other.effort = dict(self.box), self.effort
        return other

    @property
    def _sides(self) -> dict[str, Range]:
        sides = exact_sides(self._file.parameters)
        return {typed(name): side for name, side in sides.items() if side[0] != side[1]}

    @classmethod
    def read(cls, path: str | Path, **parameters: Ends) -> Self:
        """Read a system's file (TOML); parameters: instead of those of the file.

        Raises ValueError, in a sentence, where it is none, OSError where it cannot be read.
        """
        try:
            text = Path(path).read_text("utf-8-sig")  # some editors begin it with a mark
            return cls(tomllib.loads(text), **parameters)
        except UnicodeDecodeError:
            raise GrammarError(f"{path}: this is no text in UTF-8: save it as such") from None
        except (ValueError, TypeError) as error:  # of tomllib as well
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

    def impact(self, *, wall: str = "", **state: Ends) -> Theorem:
        """Prove what comes after a state, or after all states of a box.

        That is the next impact, state and time; or that there is none ever; or that no flight
        begins, the motion being pressed against the wall. wall: that of the impact before, the
        first without one. The next impact is with any wall.
        """
        before, reasons = self._wall(wall), []
        for after in self._file.next(before):
            timed = self._flights("Impact", self._file.map(before, after, timed=True))
            try:
                return self._image(timed, "Impact", state)
            except Undecided as error:
                reasons.append(str(error))
        for rule in ("pressed", "no_impact"):
            with suppress(Undecided):
                return self._outcome(rule, self._file.map(before, before), state)
        told = (f"{why}: {advice}" for x, advice in _ADVICE.items() for why in reasons if x in why)
        raise Undecided(next(told, reasons[-1]))

    def flow(self, *times: Ends, **state: Ends) -> Theorem:
        """Enclose where the solutions from a state, or a box, are at times: flow(1, 10, p="-8.4").

        Of a system with flow = "validated", whose walls or section do not end it here. The time may
        be given by its name as well.
        """
        from proofs.methods.tubes import prove_states

        file, steps = prove_states(*self._solution(times, state))
        return theorem_of(file, steps)

    def tube(self, until: Ends, **state: Ends) -> Any:
        """Enclose the solutions at all times up to one, as far as is proved: `methods.tubes.Tube`.

        Beside `flow` it has no certificate; `report.figures.portrait.drawn_tube` is its picture.
        """
        from proofs.methods.tubes import tube

        own, (moment,), box = self._solution((until,), state)
        return tube(own, moment, box)

    def _solution(self, times: Sequence[Ends], state: Mapping[str, Ends]) -> Any:
        """Return the flow of a system, times of it, one of which a state may name, and a box."""
        here = [ends for each, ends in state.items() if each == self._file.time]
        own = self.functions[next(iter(self.functions))]
        if "field" not in own:
            raise ValueError('the flow is one of closed forms: give flow = "validated" to the file')
        moments = [*map(ends_of, (*times, *here))]
        if not moments:
            raise ValueError(f"a time is expected: {self._file.time}=...")
        if any(low != high or low <= 0 for low, high in moments):
            raise ValueError(f"a time {self._file.time} > 0 is expected, one number")
        box = {each: ends for each, ends in state.items() if each != self._file.time}
        return own, [low for low, _ in moments], box_of(self.variables, box)

    def graze(self, *, wall: str = "", **state: Ends) -> Theorem:
        """Prove that a value of the variable with a range is followed by a graze, if one is found.

        graze(phi="0.3", v=("1", "2")): wall: that of the impact before; the wall that is touched is
        the first, in the order of the file, with which a graze is found.
        """
        before, reason = self._wall(wall), Undecided("no graze is seen")
        for after in self._file.next(before):
            try:
                return self._outcome("graze", self._file.map(before, after), state)
            except Undecided as error:
                reason = error
        raise reason

    def touching(self, *, wall: str = "", **sides: Ends) -> Theorem:
        """Follow curves of launches that are followed by a graze, over the second of two ranges.

        touching(a=("-0.2", "0.2"), v="-0.5", d=("0.1", "0.2")): a number or a range for each
        variable, and ranges of parameters; two ranges in all. wall: as in `graze`.
        """
        from proofs.methods.branches import Moving
        from proofs.methods.touches import launches

        moving, fixed, given = self._launched(sides, 2)
        two, other = [Moving(*each) for each in moving.items()], self.at(**given)
        before, reason = self._wall(wall), Undecided("no graze is seen")
        for after in self._file.next(before):
            flight = other._file.map(before, after)
            own = {**flight, **optional({**flight.get("parameters", {}), **fixed}, {})}
            try:
                file = launches(own, (two[0], two[1]), share=self._share)
                return theorem_of(file, [*file.steps])
            except Undecided as error:
                reason = error
        raise reason

    def _launched(self, sides: Mapping[str, Ends], count: int) -> list[dict[str, Any]]:
        """Return those of the sides that are ranges, so many, the numbers, and the parameters."""
        given = {each: ends for each, ends in sides.items() if each in self._file.parameters}
        box_of(self.variables, {each: sides[each] for each in sides if each not in given})
        known = exact_sides(sides)
        moving = {each: ends for each, ends in known.items() if ends[0] < ends[1]}
        if len(moving) != count:
            wanted = "two ranges are" if count == 2 else "one variable with a range is"
            raise ValueError(f"{wanted} expected, and numbers for the other variables")
        return [moving, {each: known[each] for each in known if each not in moving}, given]

    def grazing(self, **parameters: Ends) -> Theorem:
        """Follow curves of motions that graze a wall periodically, over the second of two ranges.

        grazing(w=("2.5", "3"), d=("0.1", "0.2")): from contact with the first wall, see the key
        `rest`, nothing is hit before this wall is touched again, the other variables being as at
        the start.
        """
        from proofs.methods.outcomes import resting
        from proofs.methods.touches import periodic

        one, two = self._moving(parameters, 2)
        own = self.at(**parameters)._file
        contact = own.contact(0)
        sides = zip(self.variables, self.region(), strict=True)
        region = [side for each, side in sides if each not in contact]
        flight = resting(own.map(0, 0), contact)
        file = periodic(flight, region, (one, two), share=self._share)
        return theorem_of(file, [*file.steps])

    def rest(self, *, wall: str = "", **state: Ends) -> Theorem:
        """Prove that no flight begins at a wall, from states of contact.

        They are those of the key `rest` of the wall, for these values of the other variables.
        """
        from proofs.methods.outcomes import resting

        before = self._wall(wall)
        contact = self._file.contact(before)
        return self._outcome("pressed", resting(self._file.map(before, before), contact), state)

    def require(self, method: str, sides: Mapping[str, Ends]) -> None:
        """Raise ValueError where a method is none of this system, or sides are none for it."""
        if method in ("rest", "grazing"):
            contact = self._file.contact(0)
        if method == "flow":
            self._solution((), sides)
        elif method == "rest":
            box_of([each for each in self.variables if each not in contact], sides)
        elif method in ("graze", "touching"):
            self._launched(sides, 1 + (method == "touching"))
        else:
            super().require(method, sides)

    def require_launches(self) -> None:
        """Raise ValueError where a gap is seen to be < 0 after all launches of the region.

        That is a gap of the wrong sign, or a region of states before impacts; one with the first
        wall is looked at, in floating point, and nothing where the flow is validated.
        """
        from proofs.methods.sampling import shut

        if wrong := shut(self._derivation().map(next(iter(self.functions))), self.region()):
            raise ValueError(
                f"the gap {wrong} is < 0 right after each launch from the region that is tried: "
                "give it the other sign, or another region"
            )

    def _wall(self, wall: str) -> int:
        if wall and wall not in self.walls:
            raise ValueError(f"no wall {wall!r}; walls are {', '.join(self.walls)}")
        return self.walls.index(wall) if wall else 0

    def _flights(self, name: str, function: Mapping[str, Any]) -> Any:
        from proofs.methods.derivation import Derivation

        return Derivation({name: function})

    def _outcome(
        self, rule: str, function: Mapping[str, Any], state: Mapping[str, Ends]
    ) -> Theorem:
        from proofs.methods import outcomes

        file = self._flights("Flight", function)
        box = box_of(function["variables"], state)
        return theorem_of(file, [getattr(outcomes, rule)(file, "Flight", box)])

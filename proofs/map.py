"""Your own map: `from proofs import Map`.

>>> from proofs import Map
>>> print(Map("r*x*(1 - x)", r="3.5").stable(box={"x": ("0", "1")})[0].brief.partition(": ")[2])
exactly one periodic orbit of least period 4 that begins at ...
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from fractions import Fraction
from typing import Any, Self

from intervals import Undecided
from proofs.methods.ends import Ends, Exact, box_of, exact_sides, listed, optional
from proofs.methods.grammar import GrammarError, as_typed, canonical, name, names, typed
from proofs.theorem import Theorem
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.numbers import Range, show_range

Box = Mapping[str, Sequence[Exact]]  # by variables

_BITS = 128  # of periods
EFFORT = 3
_PARTS = Fraction(1, 4), Fraction(1, 16), Fraction(1, 64)  # of ranges that are too wide
_POINTS, _PASSED, _LONGEST = 1500, 4, 8  # of a picture; periods that are looked for
_ITERATES = 9  # of which horseshoes are asked for
_MOST = 60  # of periods
_SIDE = Fraction(-3), Fraction(3)  # of a box where points are looked for, if none is given
_MOVING = {"branches": 1, "folds": 2, "flips": 2, "grazing": 2}  # ranges of parameters
_HINTS = {  # what to do about a reason why a map is none
    "unknown variable": ": give it a value among the parameters",
    "respect the period": ": with one period more each value is to change by periods of its own, "
    "or not at all; periods are exact, as 2*pi",
}


class Map:
    """A map given by a formula for each variable; Theorems about it come with certificates.

    formulas: in textbook notation, in the order of the variables, which is that of the alphabet
    unless `variables` says otherwise. parameters: exact numbers, or ranges (low, high): what is
    proved then holds for all of them. periods: of those variables that are angles. Raises
    ValueError, in a sentence, where that is no map; the methods raise `intervals.Undecided` where
    nothing is proved. effort: each more doubles the points and candidates that are looked at.
    """

    def __init__(
        self,
        *formulas: str,
        variables: Sequence[str] = (),
        periods: Mapping[str, str] | None = None,
        **parameters: Ends,
    ) -> None:
        if not isinstance(periods, Mapping | None):
            raise ValueError(f"periods are as {{'x': '2*pi'}}, not {periods!r}")
        values = [canonical(text) for text in formulas]
        fields = optional(parameters, periods or {})
        given = fields.get("parameters", {})
        texts_ = [*values, *fields.get("periods", {}).values()]
        there = {each for text in texts_ for each in names(text)}
        state = list(map(name, variables)) or sorted(there - {*given})
        if unknown := sorted(there - {*given, *state}):
            raise GrammarError(f"{listed(unknown)} has no value: give one among the parameters")
        if unused := sorted({*given} - there):
            raise GrammarError(f"the parameter {typed(unused[0])} is in none of the formulas")
        if len(state) != len(values):
            raise GrammarError(
                f"{len(values)} formulas for the variables {listed(state) or '(none)'}: as many "
                "are expected; give numbers to parameters, as in Map('r*x', r='2'), or --set r=2"
            )
        self._begin({"F": {"variables": state, **fields, "values": values}}, "F")

    def _begin(self, functions: Mapping[str, Any], function: str) -> None:
        from proofs.methods.derivation import Derivation

        self.functions, self.function = dict(functions), function
        self.box: dict[str, Sequence[Exact]] = {}
        self.effort = EFFORT
        self._known: dict[tuple[Any, ...], Any] = {}
        try:
            self._kernel = Derivation(self.functions).map(function)
        except (Malformed, Unproved) as error:
            reason = str(error).partition(": ")[2] if str(error)[0] == "$" else str(error)
            hints = (hint for each, hint in _HINTS.items() if each in reason)
            raise GrammarError(as_typed(reason) + next(hints, "")) from None

    @property
    def variables(self) -> tuple[str, ...]:
        """The variables, in their order."""
        return self._kernel.variables

    def at(self, **parameters: Ends) -> Self:
        """Return the same with other values, or ranges, of some parameters."""
        other = copy(self)
        function = self.functions[self.function]
        known = {**function.get("parameters", {}), **optional(parameters, {}).get("parameters", {})}
        if unused := sorted({*known} - {*function.get("parameters", {})}):
            raise GrammarError(f"the parameter {typed(unused[0])} is in none of the formulas")
        other._begin({self.function: {**function, "parameters": known}}, self.function)
        other.box, other.effort = dict(self.box), self.effort
        return other

    @property
    def ranges(self) -> tuple[str, ...]:
        """The parameters for all of whose values theorems hold."""
        return tuple(self._sides)

    @property
    def _sides(self) -> dict[str, Range]:
        known = self.functions[self.function].get("parameters", {})
        return {typed(name): (Fraction(x), Fraction(y)) for name, (x, y) in known.items() if x != y}

    def narrower(self, ask: Callable[[Self], Theorem]) -> str:
        """Say for which part of the ranges a question has an answer, if one is found for some."""

        def around(part: Fraction | int) -> dict[str, Range]:
            ends = {name: ((x + y) / 2, (y - x) / 2 * part) for name, (x, y) in self._sides.items()}
            return {name: (middle - r, middle + r) for name, (middle, r) in ends.items()}

        with suppress(Undecided):
            ask(self.at(**around(0)))
            for part in _PARTS:
                with suppress(Undecided):
                    ask(self.at(**around(part)))
                    return ", ".join(f"{x} in {show_range(y)}" for x, y in around(part).items())
        return ""

    def __repr__(self) -> str:
        """Return the definition."""
        return self._kernel.definition

    def respelled(self) -> list[str]:
        """Say which names of variables and parameters the theorems spell otherwise, if any are."""
        names = dict.fromkeys(self.variables)
        for each in self.functions.values():
            motions = [motion["name"] for motion in each.get("motion", ())]
            names |= dict.fromkeys([*each.get("parameters", {}), *motions, *each.get("state", ())])
        pairs = [f"`{each}` is {typed(each)}" for each in names if typed(each) != each]
        return [f"In what follows {', '.join(pairs)}.", ""] if pairs else []

    def require(self, method: str, sides: Mapping[str, Ends]) -> None:
        """Raise ValueError where a method is none of this map, or sides are none for it."""
        if not hasattr(self, method):
            raise ValueError(f"{method} is asked of systems, not of maps")
        if method in _MOVING:
            self._moving(sides, _MOVING[method])
        elif sides:
            box_of(self.variables, sides)

    # -- theorems ----------------------------------------------------------------------------------

    def image(self, **state: Ends) -> Theorem:
        """Enclose where the map takes a point, or a box: image(x="0.2", y=("0", "0.1"))."""
        return self._image(self._derivation(), self.function, state)

    def trapping(self, *others: Box, **state: Ends) -> Theorem:
        """Prove that a box, or the union of some, is taken into its interior: an attractor.

        trapping(x=("-1.3", "1.3"), y=("-0.4", "0.4")); others: boxes as {"x": (low, high), ...}.
        """
        from proofs.methods.trapping import prove_trapping

        file, boxes = self._derivation(), [box_of(self.variables, x) for x in (state, *others)]
        return theorem_of(file, [prove_trapping(file, self.function, boxes)])

    def orbits(
        self,
        period: int = 1,
        box: Box | None = None,
        near: Mapping[str, Exact] | Sequence[Mapping[str, Exact]] = (),
    ) -> Theorem:
        """Prove the periodic orbits of a least period that are found; there may be others.

        near: a state, or some, next to which they are looked for; else points at random in a box.
        `periodic_orbits` has all of them, for a formula.
        """
        return self._proved(self._cycles(period, box, near))

    def stable(self, longest: int = _LONGEST, box: Box | None = None, shortest: int = 1) -> Theorem:
        """Prove the attracting periodic orbits, up to a period, that points at random come to."""
        found = self._followed(_whole(longest), box).orbits
        if not (orbits := [each for each in found if len(each.points) >= shortest]):
            up_to = "" if shortest == longest else "up to "
            raise Undecided(f"none is seen, of a period {up_to}{longest}")
        return self._proved(orbits, is_attracting=True)

    def horseshoe(self, box: Box | None = None, longest: int = 2) -> Theorem:
        """Prove a full shift on two symbols, of the map or an iterate; sets are found.

        longest: the last iterate that is looked at.
        """
        from proofs.methods.shifts import Candidates, find_horseshoe

        reason, saddles = "", list[Any]()
        for power in range(1, _whole(longest) + 1):
            for cycle in self._cycles(power, box):
                saddles += list(cycle.points) if cycle.is_saddle else []
            later = self._return(power)
            file = self._derivation(**later)
            name, iterate = (next(iter(later)), 1) if later else (self.function, power)
            candidates = Candidates(saddles, self.region(box), iterate, self._share)
            try:
                return theorem_of(file, find_horseshoe(file, name, candidates))
            except Undecided as error:
                reason = str(error)
        hint = f"; horseshoe:{min(longest + 2, _ITERATES)} looks at later iterates"
        raise Undecided(reason + hint * (longest < _ITERATES and not self.ranges))

    def periodic_orbits(self, period: int, box: Box) -> Theorem:
        """Prove which periodic orbits a formula has in a box, and that there are no others.

        In the work that a check has by default; each more of effort allows twice as much.
        """
        from proofs.methods.periodic import prove_all_orbits

        file = self._derivation()
        sides = self.region(box)
        work = int(DEFAULT * self._share)
        return theorem_of(file, [prove_all_orbits(file, self.function, period, sides, work)])

    def branches(self, **parameter: Ends) -> Theorem:
        """Follow the fixed points that are found at the low end of a parameter's range, up to high.

        branches(g=("0.7", "0.8")): zeros of F(x) - x as graphs over the parameter; each ends where
        no proof is found, as at a fold.
        """
        from proofs.methods.branches import branches

        (moving,) = self._moving(parameter, 1)
        file = self.at(**parameter)._derivation()
        file = branches(file, self.function, moving, self.region(), share=self._share)
        return theorem_of(file, [*file.steps])

    def folds(self, **parameters: Ends) -> Theorem:
        """Follow curves of fixed points with the multiplier 1 over the second of two parameters.

        folds(g=("0.8", "1"), e=("0.4", "0.6")): points are looked for at the low end of the second.
        """
        return self._curves(1, parameters)

    def flips(self, **parameters: Ends) -> Theorem:
        """Do as `folds` for the multiplier -1."""
        return self._curves(-1, parameters)

    # -- what they share ---------------------------------------------------------------------------

    def _curves(self, multiplier: int, parameters: Mapping[str, Ends]) -> Theorem:
        from proofs.methods.branches import curves

        one, two = self._moving(parameters, 2)
        file = self.at(**parameters)._derivation()
        file = curves(file, self.function, (one, two), multiplier, self.region(), share=self._share)
        return theorem_of(file, [*file.steps])

    def _moving(self, parameters: Mapping[str, Ends], count: int) -> list[Any]:
        from proofs.methods.branches import Moving

        known = {key: 0 for each in self.functions.values() for key in each.get("parameters", {})}
        sides = exact_sides(parameters)
        if unknown := sorted({*sides} - {*known}):
            raise ValueError(f"{typed(unknown[0])} is none of the parameters {listed(known)}")
        if len(sides) != count or any(low == high for low, high in sides.values()):
            raise ValueError(f"ranges of {count} parameters are expected, as in g=('0.7', '0.8')")
        return [Moving(*each) for each in sides.items()]

    @property
    def _share(self) -> float:
        return float(2.0 ** (self.effort - EFFORT))

    @property
    def _sampled(self) -> Any:
        from proofs.methods.sampling import Sampled

        return Sampled(self._kernel)

    def _derivation(self, **others: Any) -> Any:
        from proofs.methods.derivation import Derivation

        return Derivation({**self.functions, **others})

    def _return(self, power: int) -> dict[str, Any]:
        """Return the map to a later return, by its name, if the map is a flow to a section.

        Along a solution a set keeps its shape; an iterate would begin anew from a box around it.
        """
        function = self.functions[self.function]
        end, name = function.get("end", {}), f"{self.function}{power}"
        if power == 1 or "section" not in end or name in self.functions:
            return {}
        return {name: {**function, "end": {**end, "count": str(power * int(end["count"]))}}}

    def _proved(self, cycles: Sequence[Any], is_attracting: bool = False) -> Theorem:
        """Return the theorem about those of some orbits that are proved, or proved attracting."""
        from proofs.methods.newton import prove_orbits

        file = self._derivation()
        work = int(DEFAULT * min(self._share, 1))
        theorem = theorem_of(file, prove_orbits(file, self.function, cycles, work))
        if not is_attracting:
            return theorem
        kept = [each for each in file.steps if file.known[each].stability == "attracting"]
        if not kept:
            raise Undecided(f"not that it is attracting: {theorem.conclusion.brief}")
        return theorem_of(file, kept)

    def _cycles(
        self,
        period: int,
        box: Box | None,
        near: Mapping[str, Exact] | Sequence[Mapping[str, Exact]] = (),
    ) -> list[Any]:
        from proofs.methods.newton import as_points, cycles, returning, seeds
        from proofs.trusted.kernel.enclose import centre_of

        sampled, sides = self._sampled, self.region(box)
        if near:
            states = [near] if isinstance(near, Mapping) else near
            starts = as_points([centre_of(box_of(self.variables, state)) for state in states])
            return cycles(sampled, _whole(period), starts)
        count = int(sampled.starts * _whole(period) * self._share)

        def found() -> list[Any]:
            orbits = cycles(sampled, period, seeds(sampled, sides, count))
            orbits = orbits or cycles(sampled, period, returning(sampled, sides, count, period))
            return sorted(orbits, key=lambda each: not each.meets(sides))

        return list(self._once((period, count, *sides), found))

    def sample(self) -> Any:
        """Return points in floating point, a row each, that others at random come to."""
        from proofs.methods.newton import seeds

        return seeds(self._sampled, self.region(), _POINTS, _PASSED)[:, _POINTS:].T

    def seen(self) -> list[str]:
        """Say what floating point sees points at random come to; nothing of it is proved."""
        from proofs.methods.fates import fates

        way = self._followed(_LONGEST, None)
        return fates(self._sampled, self.region(), way, _LONGEST)

    def _followed(self, longest: int, box: Box | None) -> Any:
        from proofs.methods.fates import followed

        sides = self.region(box)
        return self._once(
            ("followed", longest, *sides), lambda: followed(self._sampled, sides, longest)
        )

    def _once(self, key: tuple[Any, ...], work: Callable[[], Any]) -> Any:
        """Return what was computed before, in floating point, for another question."""
        if key not in self._known:
            self._known[key] = work()
        return self._known[key]

    def region(self, box: Box | None = None) -> list[Range]:
        """Return a box where points are looked for: angles all around, others as given."""
        if not isinstance(box, Mapping | None):
            raise ValueError(f"a box is as {{'x': ('0', '1')}}, not {box!r}")
        sides = exact_sides({**self.box, **(box or {})})
        if unknown := sorted({*sides} - {*self.variables}):
            raise ValueError(
                f"{typed(unknown[0])} is none of the variables {listed(self.variables)}"
            )
        periods = self._kernel.periods(_BITS)
        around = [
            (Fraction(0), periods[i].range[1]) if i in periods else _SIDE
            for i in range(len(self.variables))
        ]
        return [sides.get(each, side) for each, side in zip(self.variables, around, strict=True)]

    def _image(self, file: Any, function: str, state: Mapping[str, Ends]) -> Theorem:
        from proofs.methods.trapping import prove_image

        return theorem_of(file, [prove_image(file, function, box_of(self.variables, state))])


def _whole(period: int) -> int:
    if not isinstance(period, int) or not 1 <= period <= _MOST:
        raise ValueError(f"a period is a whole number from 1 to {_MOST}, not {period!r}")
    return period


def theorem_of(file: Any, steps: Sequence[str]) -> Theorem:
    """Return what some steps conclude, with their certificate."""
    return Theorem(tuple(file.known[step] for step in steps), file.certificate(*steps))

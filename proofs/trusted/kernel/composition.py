"""Maps of a file: formulas, flights, flows, compositions; their parameters, and their angles.

A function of a file is an object {variables, values}: a formula; with `parameters` {name: range}
too, and with `periods` {variable: formula} of those variables that are angles. It is a flight if it
has `time`, `motion` and `gaps` as well (see `flight`), a flow without a closed form if it has a
`field` (see `flow`), a composition if it has `maps` alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.enclose import Box, Circle, Matrix, multiply
from proofs.trusted.kernel.head import read_function, require_function_name
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.parametric import Parametric, chained, ranges_of
from proofs.trusted.kernel.trees import Tree

_MOST_MAPS = 100


@dataclass(frozen=True, eq=False)
class Composition:
    """The maps one after the other, the first first; none of them is a composition."""

    name: str
    maps: tuple[Map, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        """Those of the first map."""
        return self.maps[0].variables

    @property
    def size(self) -> int:
        """That of the last map."""
        return self.maps[-1].size

    @property
    def trees(self) -> tuple[Tree, ...]:
        """The values, as the last map has them written."""
        return tuple(getattr(self.maps[-1], "trees", ()))

    @property
    def circles(self) -> tuple[Circle, ...]:
        """The angles, which all maps have in common."""
        return self.maps[0].circles

    @property
    def definition(self) -> str:
        """Write which maps follow each other, and what they are."""
        names = ", then ".join(f"`{each.name}`" for each in self.maps)
        known = {each.name: each.definition for each in self.maps}
        return f"`{self.name}` is {names}, where {'; '.join(known.values())}"

    def periods(self, bits: int) -> dict[int, Enclosure]:
        """Enclose the periods."""
        return self.maps[0].periods(bits)

    @property
    def ranges(self) -> Box:
        """Those of all maps; none where one of them has no derivatives by its parameters."""
        known = all(isinstance(each, Parametric) for each in self.maps)
        return tuple(side for each in self.maps for side in ranges_of(each)) if known else ()

    def pinned(self) -> Composition:
        """Return the map at the middle of the ranges."""
        maps = [each.pinned() for each in self.maps if isinstance(each, Parametric)]
        return Composition(self.name, tuple(maps))

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivatives by the parameters, by those of each map in turn."""
        maps = [each for each in self.maps if isinstance(each, Parametric)]
        return chained(maps, x, shared=False)

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        """Enclose the values on a box."""
        return reduce(lambda point, each: each.values(point), self.maps, list(x))

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        """Enclose the derivative (chain rule)."""
        point, product = list(x), self.maps[0].jacobian(x)
        for before, each in zip(self.maps, self.maps[1:], strict=False):
            point = before.values(point)
            product = multiply(each.jacobian(point), product)
        return product

    def is_reversible(self, on_images: bool) -> bool:
        """Whether all maps are proved to be one-to-one; on images only if they are one map."""
        from proofs.trusted.kernel.injective import is_one_to_one

        is_one = all(each is self.maps[0] for each in self.maps)
        return all(is_one_to_one(each, on_images and is_one) for each in self.maps)


def read_map(name: str, reader: Reader, maps: Mapping[str, Map]) -> Map:
    """Read a function of a file; maps: those before it, of which a composition may be made."""
    if reader.has("maps"):
        return _read_composition(name, reader, maps)
    if reader.has("field"):  # what a file has none of is not imported
        from proofs.trusted.kernel.flow import read_flow

        return read_flow(name, reader)
    if reader.has("gaps"):
        from proofs.trusted.kernel.flight import read_flight

        return read_flight(name, reader)
    return read_function(name, reader)


def _read_composition(name: str, reader: Reader, maps: Mapping[str, Map]) -> Composition:
    (names_of,) = reader.fields("maps")
    require_function_name(reader, name)
    chain: list[Map] = []
    for each in names_of.items(2, _MOST_MAPS):
        if each.string() not in maps:
            raise each.fail(f"names no function before this one: {each.string()[:30]!r}")
        map_ = maps[each.string()]
        chain += map_.maps if isinstance(map_, Composition) else [map_]
        if not same_state(chain[0], map_) or map_.size != len(chain[0].variables):
            raise each.fail("maps that follow each other have one state, with the same angles")
    if len(chain) > _MOST_MAPS:
        raise names_of.fail(f"more than {_MOST_MAPS} maps, one after the other")
    return Composition(name, tuple(chain))


def same_state(one: Map, two: Map) -> bool:
    """Whether two maps have one state: the same variables, and the same angles among them."""
    angles = [{(circle.place, circle.period) for circle in each.circles} for each in (one, two)]
    return one.variables == two.variables and angles[0] == angles[1]

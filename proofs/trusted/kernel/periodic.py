"""Rule: all periodic orbits of a map in a box, those that are there and no others."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.contractor import Cutter, Empty, Point, contractor, meet
from proofs.trusted.kernel.covers import MAX_POWER, along, images
from proofs.trusted.kernel.enclose import Box, Matrix, box_text, enclosed, integer, read_box, shown
from proofs.trusted.kernel.maps import Map, turned
from proofs.trusted.kernel.meter import METER
from proofs.trusted.kernel.parametric import Parametric, chained, ranges_of
from proofs.trusted.kernel.zeros import read_matrix, require_zero
from proofs.trusted.numbers import within

_BITS = 64  # of tubes
_FINE = 256  # of points
_SMALLEST = 1 << 28  # side of a tube, in units of 2^-64 of that of the box
_CUT = 509, 1024  # of a side: not in its middle, where a symmetric map has points

Tube = list[Point]  # boxes around x_0, x_1 = F(x_0), ...


@dataclass(frozen=True)
class PeriodicOrbits(Conclusion):
    """How many periodic orbits a map has in a box, by least period, of those that divide one."""

    function: Map
    box: Box
    period: int
    counts: tuple[tuple[int, int], ...]

    @property
    def sentence(self) -> str:
        """Return the statement."""
        place = box_text(self.box, self.function.variables)
        found = ", ".join(f"{count} of least period {n}" for n, count in self.counts)
        return (
            f"for {self.function.definition}: the periodic orbits whose points all have {place}, "
            f"and whose least period divides {self.period}, are exactly these: {found or 'none'}."
        )


def periodic_orbits(context: Context, reader: Reader) -> PeriodicOrbits:
    """Rule `periodic-orbits`: {function F, period p, box, radius, orbits: [{point, period n,
    matrix C}]}.

    Hypotheses. (1) For each orbit n divides p, and by `require_zero` with C the function F^n(x) - x
    has a zero within `radius` of the point; the enclosures of this zero and of its n - 1 images are
    in the box, and no two of all these enclosures, of all orbits, meet. (2) By halving the tubes,
    beginning with the box p times, each is found to hold no orbit (`Contractor`, `_in_front`), or
    I - M is regular for all M = A_(p-1) ... A_0, A_i in an enclosure of F' on a box around its i-th
    one and that of a listed orbit.

    Conclusion: the orbits listed, n the least period of each, are all the periodic orbits with all
    points in the box whose least period divides p.

    Proof. By (1) the listed orbits are different, and n is the least period of each. Let x_0,
    x_1, ... be any orbit as in the conclusion, x_0 a point with the least first coordinate. No cut
    loses it, so it is in a tube that is left; let y_0, y_1, ... be the listed orbit there. By the
    mean value theorem, row by row, x_(i+1) - y_(i+1) = A_i (x_i - y_i). Hence
    (I - M) (x_0 - y_0) = 0 and x_0 = y_0. Source: Galias, Int. J. Bifurcation Chaos 11 (2001).
    """
    names = ("function", "period", "box", "radius", "orbits")
    function_of, period_of, box_of, radius_of, orbits_of = reader.fields(*names)
    function, period = context.function(function_of), integer(period_of, 1, MAX_POWER)
    n, radius = len(function.variables), radius_of.number()
    if function.size != n or function.circles:
        raise function_of.fail("as many values as variables, and no angles, are expected")
    box = read_box(box_of, n)
    if not all(low < high for low, high in box) or radius <= 0:
        raise box_of.fail("sides of a box, and the radius, must be positive")
    orbits = [read_orbit(function, radius, each, period) for each in orbits_of.items()]
    points = sorted((x for each in orbits for x in each), key=lambda x: x[0].lo)
    if not all(within(x.range, side) for each in points for x, side in zip(each, box, strict=True)):
        raise Unproved("a periodic point is not proved to be in the box")
    _require_apart(points)
    Search(function, box, period, orbits).require_complete()
    counts = Counter(map(len, orbits))
    return PeriodicOrbits(function, box, period, tuple(sorted(counts.items())))


def read_orbit(function: Map, radius: Fraction, reader: Reader, period: int) -> Tube:
    """Prove a periodic orbit; return enclosures of its points."""
    point_of, length_of, matrix_of = reader.fields("point", "period", "matrix")
    n, length = len(function.variables), integer(length_of, 1, period)
    if period % length:
        raise length_of.fail("the period of an orbit must divide that of the rule")
    point, matrix = point_of.numbers(n, n), read_matrix(matrix_of, n)
    box = tuple((x - radius, x + radius) for x in point)
    require_zero(Closing(function, length), box, matrix)
    return images(function, enclosed(box, _FINE), length)


def derivative(function: Map, tube: Tube) -> Matrix:
    """Enclose all products A_(p-1) ... A_0, A_i in the enclosure of F' on the i-th box."""
    return along(function, tube[1:], function.jacobian(tube[0]))


@dataclass(frozen=True)
class Closing:
    """F^n(x) - x, less some periods of the angles."""

    map: Map
    power: int
    turns: tuple[int, ...] = ()

    def values(self, x: Sequence[Enclosure]) -> list[Enclosure]:
        after = turned(self.map, images(self.map, x, self.power + 1)[-1], self.turns)
        return [a - b for a, b in zip(after, x, strict=True)]

    def jacobian(self, x: Sequence[Enclosure]) -> Matrix:
        return less_one(derivative(self.map, images(self.map, x, self.power)))

    @property
    def ranges(self) -> Box:
        return ranges_of(self.map)

    def pinned(self) -> Closing:
        return replace(self, map=self.map.pinned()) if isinstance(self.map, Parametric) else self

    def sensitivity(self, x: Sequence[Enclosure]) -> Matrix:
        maps = [self.map] * self.power if isinstance(self.map, Parametric) else []
        return chained(maps, x, shared=True)


def less_one(matrix: Matrix) -> Matrix:
    """Enclose a matrix less the unit matrix."""
    return [[x - int(i == j) for j, x in enumerate(row)] for i, row in enumerate(matrix)]


def _regular(matrix: Matrix) -> bool:
    """Whether all matrices in an interval matrix are: elimination finds pivots other than 0."""
    while matrix:
        pivot = max(range(len(matrix)), key=lambda i: abs(matrix[i][0].lo + matrix[i][0].hi))
        first, others = matrix[pivot], [row for i, row in enumerate(matrix) if i != pivot]
        if first[0].has_zero:
            return False
        matrix = [
            [x - row[0] * y / first[0] for x, y in zip(row[1:], first[1:], strict=True)]
            for row in others
        ]
    return True


def _meets(x: Point, y: Point) -> bool:
    return all(a.lo <= b.hi and b.lo <= a.hi for a, b in zip(x, y, strict=True))


def _require_apart(points: Sequence[Point]) -> None:
    """Raise Unproved unless boxes, sorted by their first lower ends, are pairwise disjoint."""
    near: list[Point] = []
    for x in points:
        METER.get().spend(10 + 4 * len(near))
        near = [y for y in near if y[0].hi >= x[0].lo]
        if any(_meets(x, y) for y in near):
            raise Unproved("two periodic points are not proved to be different")
        near.append(x)


# -- no others -------------------------------------------------------------------------------------


def _in_front(tube: Tube) -> None:
    """Cut a tube by x_0 <= x_i, x the first coordinate."""
    first, others = tube[0][0], tube[1:]
    for point in others:
        point[0] = meet(point[0], Enclosure(first.lo, max(first.lo, point[0].hi), _BITS))
        first = meet(first, Enclosure(min(first.lo, point[0].hi), point[0].hi, _BITS))
    tube[0][0] = first


@dataclass(frozen=True)
class Search:
    """The search for periodic orbits in a box that are not listed."""

    function: Map
    box: Box
    period: int
    orbits: Sequence[Tube]

    @cached_property
    def _contractor(self) -> Cutter:
        return contractor(self.function, _BITS)

    @cached_property
    def _listed(self) -> list[tuple[int, int, int]]:
        """The first coordinates of all listed points, the places of their orbits and in these."""
        return sorted(
            (point[0].lo, which, k)
            for which, orbit in enumerate(self._rounded)
            for k, point in enumerate(orbit)
        )

    @cached_property
    def _rounded(self) -> list[Tube]:
        """The listed orbits at the precision of tubes."""
        return [
            [[Enclosure.of(*x.range, _BITS) for x in point] for point in orbit]
            for orbit in self.orbits
        ]

    @cached_property
    def _reach(self) -> int:
        return max((x[0].hi - x[0].lo for orbit in self._rounded for x in orbit), default=0)

    def require_complete(self) -> None:
        """Raise Unproved unless all orbits in the box are proved to be listed."""
        for tube in self.open_tubes(_SMALLEST):
            place = shown([x.range for x in tube[0]])
            raise Unproved(f"not decided whether another periodic orbit has a point in {place}")

    def open_tubes(self, smallest: int) -> Iterator[Tube]:
        """Yield tubes that hold all orbits in the box that are not listed.

        Each side is shorter than so many units of 2^-64 of that of the box.
        """
        sides = enclosed(self.box, _BITS)
        waiting: list[Tube] = [[list(sides) for _ in range(self.period)]]
        while waiting:
            tube = waiting.pop()
            try:
                self._cut(tube)
            except Empty:
                continue
            if self._is_known(tube):
                continue
            share, i, k = max(
                (((x.hi - x.lo) << 64) // (side.hi - side.lo), i, k)
                for i, point in enumerate(tube)
                for k, (x, side) in enumerate(zip(point, sides, strict=True))
            )
            if share < smallest:
                yield tube
            else:
                waiting += _halves(tube, i, k)

    def _cut(self, tube: Tube) -> None:
        """Cut by the map, back along the tube, as long as that takes much away."""
        period, before, after = self.period, 2, 0
        while 3 * after < 2 * before:
            before = _size(tube)
            for i in reversed(range(period)):
                following = (i + 1) % period
                tube[i], image = self._contractor.cut(tube[i], tube[following])
                tube[following] = list(map(meet, tube[following], image))
            _in_front(tube)
            after = _size(tube)

    def _is_known(self, tube: Tube) -> bool:
        """Whether a tube holds no orbit but a listed one: with that around it, one at most."""
        side = tube[0][0]
        first = bisect_left(self._listed, (side.lo - self._reach,))
        last = bisect_right(self._listed, (side.hi + 1,))
        METER.get().spend(8 * (last - first) + 10)
        for _, which, k in self._listed[first:last]:
            orbit = self._rounded[which]
            if not _meets(tube[0], orbit[k]):
                continue
            METER.get().spend(4 * len(tube))
            turned = [orbit[(k + i) % len(orbit)] for i in range(len(tube))]
            if all(map(_meets, tube, turned)):
                pairs = zip(tube, turned, strict=True)
                return self._holds_one([list(map(Enclosure.hull, x, y)) for x, y in pairs])
        return False

    def _holds_one(self, tube: Tube) -> bool:
        """Whether a tube holds one orbit at most."""
        try:
            return _regular(less_one(derivative(self.function, tube)))
        except Unproved:
            return False


def _halves(tube: Tube, i: int, k: int) -> list[Tube]:
    """Cut a side of a tube."""
    x, halves = tube[i][k], []
    middle = x.lo + (x.hi - x.lo) * _CUT[0] // _CUT[1]
    for low, high in ((x.lo, middle), (middle, x.hi)):
        halves.append([list(point) for point in tube])
        halves[-1][i][k] = Enclosure(low, high, _BITS)
    return halves


def _size(tube: Tube) -> int:
    return sum(x.hi - x.lo for point in tube for x in point)

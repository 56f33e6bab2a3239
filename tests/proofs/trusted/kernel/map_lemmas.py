"""Lemma files about any map, witnesses found with the checker's own enclosures.

(The prover's `SymbolicLemmas` has formulas alone.)
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from intervals import Interval, Undecided
from proofs.methods.formulas import mean_value_form
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.certificate import Reader, texts
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.covers import LocalMap, images
from proofs.trusted.kernel.enclose import enclosed, point_box
from proofs.trusted.kernel.maps import read_map
from proofs.trusted.kernel.periodic import Closing

BITS = 64


def floats(values):
    return np.array([float(sum(x.range)) / 2 for x in values])


@dataclass(frozen=True)
class Local:
    """A map of the checker in the coordinates of two h-sets, on the prover's intervals."""

    local: LocalMap

    @property
    def formula(self):
        return self.local.map

    def values(self, q):
        return self._intervals(self.local.values, q)

    def jacobian(self, q):
        rows = self._try(self.local.jacobian, q)
        return [[Interval(*x.range) for x in row] for row in rows]

    def on(self, box):
        return mean_value_form(self.values, self.jacobian, box)

    def _intervals(self, function, q):
        return [Interval(*x.range) for x in self._try(function, q)]

    def _try(self, function, q):
        try:
            return function([Enclosure.of(x.inf, x.sup, BITS) for x in q])
        except Unproved as error:
            raise Undecided(str(error)) from None


class MapLemmas(SymbolicLemmas):
    """A lemma file about functions {name: JSON} of any kind."""

    def _json(self, name):
        return self.functions[name]

    def function(self, name):
        maps = {}
        for each, data in self.functions.items():
            maps[each] = read_map(each, Reader(data), maps)
        return maps[name]

    def turns(self, map_, before, after, power):
        """By how many periods the angles of an image are more than those of another point."""
        image = images(map_, enclosed(point_box(before), BITS), power + 1)[-1]
        periods = map_.periods(BITS)
        return tuple(
            round(floats([image[k] - after[k]])[0] / floats([period])[0])
            for k, period in periods.items()
        )

    def local(self, function, power, source, target):
        map_, sets = self.function(function), [self.h_sets[name] for name in (source, target)]
        turns = self.turns(map_, *(each.centre for each in sets), power)
        return Local(LocalMap(map_, power, *sets, turns))

    def covers(self, function, power, source, target):
        name = super().covers(function, power, source, target)
        if turns := self.local(function, power, source, target).local.turns:
            self.steps[name]["witness"]["turns"] = list(map(str, turns))
        return name

    def periodic_orbit(self, function, start, period, turns, radius):
        """Add a step `periodic-orbit`: Newton's method in floats, then a box of that radius."""
        point, matrix = self.newton(function, start, period, turns)
        point = [rounded(x, int(100 / radius)) for x in point]
        witness = {
            "function": function,
            "period": str(period),
            "box": [texts((x - radius, x + radius)) for x in point],
            "matrix": [texts(row) for row in matrix],
        }
        return self.add("periodic-orbit", witness | ({"turns": texts(turns)} if turns else {}))

    def newton(self, function, start, period, turns):
        """A point of a periodic orbit, and the inverse derivative, both rounded."""
        closing, point = Closing(self.function(function), period, tuple(turns)), np.array(start)
        for _ in range(20):
            x = enclosed(point_box([rounded(each) for each in point]), BITS)
            matrix = np.array([floats(row) for row in closing.jacobian(x)])
            point = point - np.linalg.solve(matrix, floats(closing.values(x)))
        inverse = np.linalg.inv(matrix)
        return [rounded(x, 2**20) for x in point], [
            [rounded(x, 2**20) for x in row] for row in inverse
        ]


def rounded(x, places=2**40):
    return Fraction(round(float(x) * places), places)


def horseshoe(file):
    """Words of two letters over two saddles of the ball on a table: four sets, entropy log 2."""
    sets = {}
    for word, centre, (u, v), (s, w) in (
        ("00", ("1.019727", "1.570796"), ("-0.793", "1"), ("1", "-0.0676")),
        ("11", ("-1.019727", "1.570796"), ("-0.773", "-1"), ("-1", "0.0658")),
        ("01", ("1.158856", "1.411681"), ("-0.738", "1"), ("1", "-0.0646")),
        ("10", ("-0.876519", "1.722933"), ("0.857", "1"), ("1", "-0.0684")),
    ):
        columns = [(Fraction(u), Fraction(v)), (Fraction(s), Fraction(w))]
        sides = Fraction("0.014"), Fraction("0.04")
        rows = [
            [x * r for x, r in zip(row, sides, strict=True)] for row in zip(*columns, strict=True)
        ]
        sets[word] = file.h_set(centre, rows)
    arrows = [(a, b) for a in sets for b in sets if a[1] == b[0]]
    return file.entropy(file.graph([file.covers("P", 1, sets[a], sets[b]) for a, b in arrows]))

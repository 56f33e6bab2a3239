"""Rules: covering relations, the symbolic dynamics of their graph, its entropy."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, log
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context, read_point
from proofs.trusted.kernel.enclose import Box, decide, integer, leaves, size
from proofs.trusted.kernel.formula import MAX_VARIABLES, Formula
from proofs.trusted.kernel.hset import HSet, LocalMap, disjoint, inverse
from proofs.trusted.kernel.inequalities import read_sign
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import ceil_text, floor_text, show

_MAX_POWER = 100
_MAX_GROWTH = 10**30
_SIDE = (Fraction(-1), Fraction(1))
_LOG_BITS = 128
_MOST_DIGITS = 1000  # bits


@dataclass(frozen=True)
class Covers(Conclusion):
    """The map covers the target by the source."""

    formula: Formula
    local: LocalMap
    orientation: int

    @property
    def map_name(self) -> str:
        """The map, F or F^k."""
        power = self.local.power
        return self.formula.name if power == 1 else f"the iterate {self.formula.name}^{power}"

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"for {self.formula.definition()}: N => M under {self.map_name}, with N "
            f"{self.local.source.sentence}, and M {self.local.target.sentence}"
        )


@dataclass(frozen=True)
class Graph(Conclusion):
    """Covering relations of one map among pairwise disjoint h-sets."""

    covers: tuple[Covers, ...]
    nodes: tuple[HSet, ...]
    edges: tuple[tuple[int, int], ...]

    @property
    def described(self) -> str:
        """The map, the sets and the relations."""
        first = self.covers[0]
        sets = "; ".join(f"N{i} is {node.sentence}" for i, node in enumerate(self.nodes, 1))
        edges = ", ".join(f"N{i + 1} => N{j + 1}" for i, j in self.edges)
        return f"for {first.formula.definition()}: {edges} under {first.map_name}, where {sets}"

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"{self.described}; the sets are disjoint; each infinite path of these arrows is "
            "followed by a point, each closed path by a periodic point, and the map on the "
            "compact set of all points that follow paths is semiconjugate to the shift on paths"
        )


@dataclass(frozen=True)
class Entropy(Conclusion):
    """A lower bound log(growth) / (length k) on the entropy."""

    graph: Graph
    growth: int
    length: int

    @property
    def sentence(self) -> str:
        """Return the statement, with the bound as decimals."""
        steps = self.length * self.graph.covers[0].local.power
        low, high = (end / steps for end in log(Fraction(self.growth), _LOG_BITS).range)
        name = self.graph.covers[0].formula.name
        return (
            f"{self.graph.described}; the topological entropy of {name} on a compact invariant "
            f"set is at least log({self.growth})/{steps}, which lies in "
            f"[{floor_text(low, 12)}, {ceil_text(high, 12)}]"
        )


def h_set(_: Context, reader: Reader) -> HSet:
    """Rule `h-set`: {centre, matrix A}: a parallelepiped, if A is regular (exact elimination)."""
    centre_of, matrix_of = reader.fields("centre", "matrix")
    centre = centre_of.numbers(1, MAX_VARIABLES)
    n = len(centre)
    matrix = tuple(read_point(row, n) for row in matrix_of.items(n, n))
    if any(size(entry) > _MOST_DIGITS for row in (centre, *matrix) for entry in row):
        raise matrix_of.fail(f"a number of more than {_MOST_DIGITS} bits")
    return HSet(centre, matrix, inverse(matrix))


def covers(context: Context, reader: Reader) -> Covers:
    """Rule `covers`: {function, power k, source N, target M, sign, left, right, support}.

    N = c + A [-1, 1]^n and M = d + B [-1, 1]^n are h-sets of which the first coordinate is
    unstable; f(q) = B^-1 (F^k(c + A q) - d). Hypotheses, with the sign s = 1 or -1, on each leaf
    of the trees: s f_1 < -1 on `left`, the face q_1 = -1; s f_1 > 1 on `right`, the face q_1 = 1;
    on `support`, the whole [-1, 1]^n, either |f_1| > 1 or |f_j| < 1 for every j > 1.

    Conclusion: N =F^k=> M in the sense of Zgliczynski and Gidea (2004, definition 6), of degree s.

    Proof. f is continuous on the cube. Let h_t shrink the coordinates f_j, j > 1, by 1 - 2t for
    t <= 1/2, then move f_1 along a segment to 2 s q_1. Up to t = 1/2 a point with |f_1| > 1 keeps
    its f_1, another one its |h_j| < 1, and then h_j = 0: h never meets the sides |q_j| = 1 of the
    target within |q_1| <= 1. On the faces q_1 = -1, 1, h_1 stays beyond -1 and 1. At t = 1,
    h(q) = (2 s q_1, 0, ..., 0). That is the definition.
    """
    function, power, source_of, target_of, sign, left, right, support = reader.fields(
        "function", "power", "source", "target", "sign", "left", "right", "support"
    )
    formula, k = context.formula(function), integer(power, 1, _MAX_POWER)
    source, target = context.step(source_of, HSet), context.step(target_of, HSet)
    n = len(formula.variables)
    if not n == len(formula.roots) == len(source.centre) == len(target.centre):
        raise function.fail("the function and the h-sets must have one dimension")
    local, s = LocalMap(context.map_of(formula), k, source, target), read_sign(sign)
    for tree, face, way in ((left, -1, -s), (right, 1, s)):
        for leaf in leaves(tree, ((Fraction(face), Fraction(face)), *cube(n - 1))):
            decide(local, leaf, partial(_first_beyond, way))
    for leaf in leaves(support, cube(n)):
        decide(local, leaf, _clear_of_the_sides)
    return Covers(formula, local, s)


def cube(n: int) -> Box:
    """Return [-1, 1]^n."""
    return (_SIDE,) * n


def beyond(value: Enclosure, way: int) -> bool:
    """Whether way value > 1."""
    one = 1 << value.bits
    return value.lo > one if way > 0 else value.hi < -one


def _first_beyond(way: int, values: list[Enclosure]) -> bool:
    return beyond(values[0], way)


def _clear_of_the_sides(values: list[Enclosure]) -> bool:
    one = 1 << values[0].bits
    within = all(-one < value.lo and value.hi < one for value in values[1:])
    return within or any(beyond(values[0], way) for way in (1, -1))


def graph(context: Context, reader: Reader) -> Graph:
    """Rule `graph`: {covers}: steps about one map G = F^k, each relation once.

    Hypothesis: the h-sets N_1, ..., N_r that occur are pairwise disjoint. Conclusion: for each
    infinite path i_0, i_1, ... of relations there is x in N_(i_0) with G^m(x) in N_(i_m) for all
    m; for each closed path of length p one with G^p(x) = x too. The set K of all points that follow
    infinite paths is compact, G maps it into itself, and the itinerary K -> {paths} is continuous,
    onto, and turns G into the shift.

    Proof. For finite and closed paths: Zgliczynski and Gidea, Covering relations for
    multidimensional dynamical systems, J. Differential Equations 202 (2004), theorem 9. Infinite
    paths: the sets of points that follow m steps are compact, nested, not empty. K is compact as
    all its conditions are closed; the itinerary is continuous as the N_i are compact and disjoint.
    """
    (names,) = reader.fields("covers")
    steps = tuple(context.step(name, Covers) for name in names.items(least=1))
    first = steps[0]
    places: dict[int, int] = {}
    nodes: list[HSet] = []
    edges: dict[tuple[int, int], Covers] = {}
    for name, step in zip(names.items(), steps, strict=True):
        if step.formula is not first.formula or step.local.power != first.local.power:
            raise name.fail("a relation of another map")
        for node in (step.local.source, step.local.target):
            if id(node) not in places:
                _check_disjoint(context, node, nodes)
                places[id(node)] = len(nodes)
                nodes.append(node)
        edge = (places[id(step.local.source)], places[id(step.local.target)])
        if edge in edges:
            raise name.fail("a relation twice")
        edges[edge] = step
    return Graph(tuple(edges.values()), tuple(nodes), tuple(edges))


def _check_disjoint(context: Context, node: HSet, others: Iterable[HSet]) -> None:
    """Raise Unproved unless an h-set is proved disjoint from the others."""
    for other in others:
        METER.get().spend(20 * len(node.centre) ** 2)
        if not disjoint(node, other):
            raise Unproved("two h-sets are not proved disjoint")


def entropy(context: Context, reader: Reader) -> Entropy:
    """Rule `entropy`: {graph, length p, vector v, growth m}, v >= 0 integers, not all 0, m >= 1.

    Hypothesis: A^p v >= m v in each component, A the matrix of the graph (A_ij = 1 for a relation
    N_i => N_j). Conclusion: the topological entropy of G = F^k on the set K of the graph step is at
    least log(m) / p, that of F on the union of K, F(K), ..., F^(k-1)(K) at least log(m) / (p k).

    Proof. A^(pq) v >= m^q v for all q, so A has spectral radius at least m^(1/p) (Collatz and
    Wielandt), and the log of that radius is the entropy of the shift on infinite paths (Lind and
    Marcus 1995, theorem 4.4.4). G on K has no smaller one, being an extension of that shift, and
    the entropy of F on the union is 1/k of that of its iterate G there.
    """
    graph_of, length_of, vector_of, growth_of = reader.fields("graph", "length", "vector", "growth")
    of, length = context.step(graph_of, Graph), integer(length_of, 1, _MAX_POWER)
    n = len(of.nodes)
    vector = [integer(entry, 0, _MAX_GROWTH) for entry in vector_of.items(n, n)]
    growth = integer(growth_of, 1, _MAX_GROWTH)
    if not any(vector):
        raise vector_of.fail("a vector other than 0 is expected")
    image = vector
    METER.get().spend(2 * length * len(of.edges))
    for _ in range(length):
        following = [0] * n
        for i, j in of.edges:
            following[i] += image[j]
        image = following
    if any(after < growth * before for after, before in zip(image, vector, strict=True)):
        raise Unproved(f"the graph does not multiply the vector by {show(Fraction(growth))}")
    return Entropy(of, growth, length)

"""Rules: the symbolic dynamics of a graph of covering relations, its entropy."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import same_state
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import MAX_POWER, Covers, HSet, disjoint
from proofs.trusted.kernel.elementary import log
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import ceil_text, floor_text, hull, show

_MAX_GROWTH = 10**30
_LOG_BITS = 128


@dataclass(frozen=True)
class Graph(Conclusion):
    """Covering relations of one map among pairwise disjoint h-sets."""

    covers: tuple[Covers, ...]
    nodes: tuple[HSet, ...]
    edges: tuple[tuple[int, int], ...]

    @property
    def described(self) -> str:
        """The map, the sets and the relations."""
        relations = [each.local for each in self.covers]
        maps = "; ".join(dict.fromkeys(each.map.definition for each in relations))
        sets = "; ".join(f"N{i} is {node.described}" for i, node in enumerate(self.nodes, 1))
        arrows: dict[str, list[str]] = {}
        for each, (i, j) in zip(relations, self.edges, strict=True):
            arrows.setdefault(each.label, []).append(f"N{i + 1} => N{j + 1}")
        edges = "; ".join(f"{', '.join(some)} under {label}" for label, some in arrows.items())
        return f"for {maps}: {edges}, where {sets}"

    @property
    def map_name(self) -> str:
        """The map of whose orbits it speaks: F, or, on each source, the map of its relations."""
        pairs = zip(self.covers, self.edges, strict=True)
        maps = {f"N{i + 1}": each.local.map.name for each, (i, _) in pairs}
        if len({*maps.values()}) == 1:
            return f"`{self.covers[0].local.map.name}`"
        return f"the map that is {', '.join(f'`{name}` on {node}' for node, name in maps.items())}"

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"{self.described}; the sets are disjoint; each infinite path of these arrows is "
            "followed by a point, each closed path by a periodic point, and the map on the "
            "compact set of all points that follow paths is semiconjugate to the shift on paths."
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
        share = f"/{steps}" if steps > 1 else ""
        return (
            f"{self.graph.described}; the topological entropy of {self.graph.map_name} on a "
            f"compact invariant set is at least log({self.growth}){share}, which lies in "
            f"[{floor_text(low, 12)}, {ceil_text(high, 12)}]."
        )


def graph(context: Context, reader: Reader) -> Graph:
    """Rule `graph`: {covers}.

    They are steps about one map G = F^k, each relation once; or about several maps, those from one
    set being about one, all with k = 1, with one state and the same angles: then G is on each set
    the map of its relations. Hypotheses: the h-sets N_1, ..., N_r that occur are pairwise disjoint;
    in each angle all of them together are shorter than its period, so that they are disjoint also
    with angles taken modulo their periods, which G respects. Conclusion: for each infinite path
    i_0, i_1, ... of relations there is x in N_(i_0) with G^m(x) in N_(i_m) for all m; for each
    closed path of length p one with G^p(x) = x too. The set K of all points that follow
    infinite paths is compact, G maps it into itself, and the itinerary K -> {paths} is continuous,
    onto, and turns G into the shift.

    Proof. For finite and closed paths: Zgliczynski and Gidea, Covering relations for
    multidimensional dynamical systems, J. Differential Equations 202 (2004), theorem 9. Infinite
    paths: the sets of points that follow m steps are compact, nested, not empty. K is compact as
    all its conditions are closed; the itinerary is continuous as the N_i are compact and disjoint.
    """
    (names,) = reader.fields("covers")
    steps = tuple(context.step(name, Covers) for name in names.items(least=1))
    first, maps = steps[0].local, dict[int | str, Map]()
    places: dict[int, int] = {}
    nodes: list[HSet] = []
    edges: dict[tuple[int, int], Covers] = {}
    for name, step in zip(names.items(), steps, strict=True):
        local = step.local
        ends = (local.source, local.target)
        for key in (id(ends[0]), local.map.name):
            if maps.setdefault(key, local.map) != local.map:
                raise name.fail("a relation of another map from the same set, or of the same name")
        if local.power != first.power or (local.map != first.map and local.power > 1):
            raise name.fail("a relation of another map or iterate")
        if not same_state(local.map, first.map):
            raise name.fail("a map with another state, or other angles")
        for node in ends:
            if id(node) not in places:
                places[id(node)] = len(nodes)
                nodes.append(node)
        edge = (places[id(ends[0])], places[id(ends[1])])
        if edge in edges:
            raise name.fail("a relation twice")
        edges[edge] = step
    _require_disjoint(nodes)
    _require_short(first.map, nodes)
    return Graph(tuple(edges.values()), tuple(nodes), tuple(edges))


def _require_short(map_: Map, nodes: list[HSet]) -> None:
    """Raise Unproved unless in each angle all h-sets together are shorter than its period."""
    for place, period in map_.periods(_LOG_BITS).items():
        low, high = hull([node.span(place) for node in nodes])
        if high - low >= period.range[0]:
            raise Unproved("h-sets that are not all within one period of an angle")


def _require_disjoint(nodes: list[HSet]) -> None:
    """Raise Unproved unless any two are disjoint: by their first coordinates, or by `disjoint`."""
    near: list[tuple[Fraction, HSet]] = []
    for low, high, i in sorted((*node.span(), i) for i, node in enumerate(nodes)):
        METER.get().spend(10 + len(near))
        near = [(end, node) for end, node in near if end >= low]
        if not all(disjoint(nodes[i], node) for _, node in near):
            raise Unproved("two h-sets are not proved disjoint")
        near.append((high, nodes[i]))


def entropy(context: Context, reader: Reader) -> Entropy:
    """Rule `entropy`: {graph, length p, vector v, growth m}.

    Hypotheses: v has integers >= 0, not all 0, m >= 1 is an integer; A^p v >= m v in each
    component, A the matrix of the graph (A_ij = 1 for a relation N_i => N_j). Conclusion: the
    topological entropy of G = F^k on the set K of the graph step is at least log(m) / p, that of F
    on the union of K, F(K), ..., F^(k-1)(K) at least log(m) / (p k).

    Proof. A^(pq) v >= m^q v for all q, so A has spectral radius at least m^(1/p) (Collatz and
    Wielandt), and the log of that radius is the entropy of the shift on infinite paths (Lind and
    Marcus 1995, theorem 4.4.4). G on K has no smaller one, being an extension of that shift, and
    the entropy of F on the union is 1/k of that of its iterate G there.
    """
    graph_of, length_of, vector_of, growth_of = reader.fields("graph", "length", "vector", "growth")
    of, length = context.step(graph_of, Graph), integer(length_of, 1, MAX_POWER)
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

"""Rule: cone conditions, and from them uniqueness: symbolic dynamics as a conjugacy."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import product

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import HSet, LocalMap, beyond, cube
from proofs.trusted.kernel.enclose import (
    Box,
    Matrix,
    decide,
    enclosed,
    leaves,
    read_box,
    tried,
)
from proofs.trusted.kernel.graph import Graph
from proofs.trusted.kernel.injective import is_one_to_one
from proofs.trusted.kernel.operations import Enclosures
from proofs.trusted.numbers import hull, within

Form = tuple[Fraction, ...]
_MOST_PARTS = 256  # of bounds on derivatives


@dataclass(frozen=True)
class Conjugacy(Conclusion):
    """Each path of a graph is followed once.

    unstable: the number of unstable directions, if these orbits are hyperbolic. one_to_one:
    whether the map is, on the points of full orbits.
    """

    graph: Graph
    unstable: int | None
    one_to_one: bool

    @property
    def forward(self) -> bool:
        """Whether that is so of paths forward: all forms are positive."""
        return self.unstable == len(self.graph.nodes[0].centre)

    @property
    def sentence(self) -> str:
        """Return the statement."""
        if self.forward:
            return (
                f"{self.graph.described}; each infinite path of these arrows is followed by "
                "exactly one point, and the map on the compact set of these points is conjugate "
                "to the one-sided shift on paths, and uniformly expanding."
            )
        stable = len(self.graph.nodes[0].centre) - (self.unstable or 0)
        hyperbolic = (
            ", and these orbits are uniformly hyperbolic, with "
            f"{self.unstable} unstable and {stable} stable direction{'s' * (stable > 1)}"
        )
        return (
            f"{self.graph.described}; each bi-infinite path of these arrows is followed by "
            "exactly one full orbit, and the shift on these orbits is conjugate to the two-sided "
            "shift on paths (so is the map on the compact set of their points"
            f"{'' if self.one_to_one else ', if it is one-to-one there'})"
            f"{hyperbolic if self.unstable else ''}."
        )


def cone(context: Context, reader: Reader) -> Conjugacy:
    """Rule `cone`: {graph, forms, relations: [{box, tree}, ...]}.

    forms: for each h-set of the graph numbers d_1, ..., d_n, the form Q(q) = sum d_i q_i^2 in its
    coordinates. Hypotheses, for each relation N => M in the graph's order, with f in coordinates,
    a box R in [-1, 1]^n and a tree that divides [-1, 1]^n: on each leaf that is not in R, some
    |f_j| > 1; D^T Q_M D - Q_N is positive definite for all matrices D in J, the hull of enclosures
    of f' on the parts of leaves in R. J is halved where that is needed. For a map with angles, on
    each leaf no other turns than those of the relation bring an image into M.

    Conclusion: each bi-infinite path is followed by exactly one full orbit x_(m+1) = G(x_m) of
    G = F^k, and G is one-to-one on their points where `is_one_to_one` has a proof. If all d_i > 0,
    each infinite path is followed by exactly one point, and G is uniformly expanding there. If no
    d_i is 0, and in each form u > 0 of them are positive, these orbits are uniformly hyperbolic: at
    each there are subspaces E, E' of the dimensions u and n - u, taken into those at its image, E
    onto; vectors of E' shrink exponentially, and those of E backwards.

    Proof. Existence: the graph step, and compactness. Let x_m, y_m be orbits along one path, in
    coordinates, D_m the mean of f' between them. Both lie in R, a convex set, since f maps them
    into [-1, 1]^n; so D_m is in J, z_m = x_m - y_m obeys z_(m+1) = D_m z_m, and Q(z_(m+1)) >=
    Q(z_m) + c |z_m|^2 with one c > 0, as J is compact. So Q(z_m) increases in m and is bounded, the
    sum of all |z_m|^2 is finite. Two-sided: z_m -> 0 at both ends, so Q(z_m) increases from 0 to
    0, and all z_m = 0. One-sided, Q > 0: |z_m| does not tend to 0 unless z_0 = 0. The itinerary is
    then a continuous bijection of compact sets.

    Hyperbolic: let now v_(m+1) = D_m v_m, D_m the derivative at x_m, so that again Q(v_(m+1)) >=
    Q(v_m) + c |v_m|^2, and |Q(v)| <= a |v|^2. If Q(v_0) >= 0, v_0 != 0, then Q(v_m) > 0 grows at
    least by 1 + c / a in each step from v_1 on. If all Q(v_m) <= 0, then -Q(v_(m+1)) <= (1 - c / a)
    (-Q(v_m)) and |v_m|^2 <= -Q(v_m) / c: these v_0 are the ones with |v_m| -> 0, a subspace E'. It
    is the intersection of the decreasing closed cones where Q(v_m) <= 0, each of which contains a
    subspace of dimension n - u, by the preimage of a negative one; so does E' (compactness of
    Grassmannians). On E' Q < 0, else Q(v_1) > 0; so its dimension is n - u. Subspaces of dimension
    u with Q > 0 at x_-m have images of this dimension, with Q > 0 on the way; limits of these over
    m, at x_0, x_-1, ..., are subspaces E with Q >= 0, each taken onto the next; on them Q shrinks
    backwards by 1 + c / a, and |v_(m-1)|^2 <= Q(v_m) / c. Q > 0 on E, Q < 0 on E': they span all.

    Source: Kokubu, Wilczak and Zgliczynski,
    Rigorous verification of cocoon bifurcations, Nonlinearity 20 (2007); Zgliczynski, Covering
    relations, cone conditions and the stable manifold theorem, J. Differential Equations 246
    (2009).
    """
    graph_of, forms_of, relations_of = reader.fields("graph", "forms", "relations")
    of = context.step(graph_of, Graph)
    n, count = len(of.nodes[0].centre), len(of.nodes)
    forms = [form.numbers(n, n) for form in forms_of.items(count, count)]
    relations = relations_of.items(len(of.covers), len(of.covers))
    for step, (i, j), relation in zip(of.covers, of.edges, relations, strict=True):
        require_cone(step.local, _staying(step.local, relation, n), forms[i], forms[j])
    positive = {sum(entry > 0 for entry in form) for form in forms}
    is_regular = len(positive) == 1 and all(entry for form in forms for entry in form)
    return Conjugacy(of, max(positive) if is_regular else None, _one_to_one(of))


def _one_to_one(graph: Graph) -> bool:
    """Whether G is proved to be one-to-one on points of full orbits: the images of F^i are such."""
    first, *others = (each.local for each in graph.covers)
    if any(each.map is not first.map or each.power != first.power for each in others):
        return False
    with suppress(Unproved):
        return is_one_to_one(first.map, on_images=True)
    return False


def _staying(local: LocalMap, relation: Reader, n: int) -> list[Box]:
    """Return parts of a box that contains all of [-1, 1]^n that is proved to be mapped into it."""
    box_of, tree = relation.fields("box", "tree")
    box, inner = read_box(box_of, n), list[Box]()
    if not _inside(box, cube(n)) or not _has_interior(box):
        raise box_of.fail("a box with interior points is expected, which never leaves [-1, 1]^n")
    lifted = replace(local, target=_unit(n))
    for leaf in leaves(tree, cube(n)):
        if not _inside(leaf, box):
            decide(local, leaf, lambda values: any(map(beyond, values)))
        if local.turns:
            decide(lifted, leaf, partial(_turns_so, local))
        part = tuple((max(x[0], y[0]), min(x[1], y[1])) for x, y in zip(leaf, box, strict=True))
        if _has_interior(part):  # such parts cover the box
            inner.append(part)
    return inner


def _unit(n: int) -> HSet:
    rows = tuple(tuple(Fraction(int(i == j)) for j in range(n)) for i in range(n))
    return HSet((Fraction(0),) * n, rows, rows)


def _turns_so(local: LocalMap, values: list[Enclosure]) -> bool:
    """Whether angles in an enclosure can be in the target with these turns alone."""
    for place, period in local.map.periods(values[0].bits).items():
        low, high = local.target.span(place)
        image, side = values[place], Enclosure.of(low, high, values[0].bits)
        if (image - period).hi >= side.lo or (image + period).lo <= side.hi:
            return False
    return True


def require_cone(local: LocalMap, parts: Sequence[Box], before: Form, after: Form) -> None:
    """Prove D^T Q_M D - Q_N positive definite for all D in the hull of f' on parts of a box."""

    def is_proved(bits: int) -> bool:
        rows = [derivatives(local, part, bits) for part in parts]
        return _is_cone(tuple(map(hull, zip(*rows, strict=True))), before, after, bits)

    if not any(tried(is_proved)):
        raise Unproved("the cone condition is not proved for all derivatives in a box")


def derivatives(local: LocalMap, box: Box, bits: int) -> Box:
    """Enclose the entries of f' on a box, row by row."""
    return tuple(entry.range for row in local.jacobian(enclosed(box, bits)) for entry in row)


def _inside(one: Box, two: Box) -> bool:
    return all(map(within, one, two))


def _has_interior(box: Box) -> bool:
    return all(low < high for low, high in box)


def _is_cone(matrices: Box, before: Form, after: Form, bits: int) -> bool:
    """Whether that is proved for all D within bounds; the widest is halved again and again."""
    waiting = [matrices]
    for _ in range(_MOST_PARTS):
        if not waiting:
            return True
        part = waiting.pop()
        if not positive_definite(difference(part, before, after, bits)):
            k = max(range(len(part)), key=lambda k: part[k][1] - part[k][0])
            low, high = part[k]
            middle = (low + high) / 2
            waiting += (
                (*part[:k], half, *part[k + 1 :]) for half in ((low, middle), (middle, high))
            )
    return not waiting


def difference(matrices: Box, before: Form, after: Form, bits: int) -> Matrix:
    """Enclose D^T Q_M D - Q_N, on and below the diagonal; squares are those of one number."""
    n, numbers = len(before), Enclosures(bits)
    entries = enclosed(matrices, bits)
    result = [[entries[0] * 0 for _ in range(i + 1)] for i in range(n)]
    for i, row in enumerate(result):
        row[i] = rational(-before[i], bits)
        for j, (d, weight) in product(range(i + 1), zip(range(n), after, strict=True)):
            a, b = entries[d * n + i], entries[d * n + j]
            squared = numbers.apply("^", [a], Fraction(2)) if i == j else a * b
            row[j] = row[j] + squared * rational(weight, bits)
    return result


def positive_definite(lower: Matrix) -> bool:
    """Whether all symmetric matrices in an interval matrix, given by its lower rows, are.

    Elimination: a symmetric matrix is positive definite exactly if its first entry a is positive
    and the matrix a_ij - a_i1 a_j1 / a, i, j > 1, is (Schur complement). Each step encloses the
    complements of all matrices.
    """
    while lower:
        pivot = lower[0][0]
        if pivot.lo <= 0:
            return False
        column = [row[0] for row in lower[1:]]
        lower = [
            [entry - column[i] * column[j] / pivot for j, entry in enumerate(row[1:])]
            for i, row in enumerate(lower[1:])
        ]
    return True

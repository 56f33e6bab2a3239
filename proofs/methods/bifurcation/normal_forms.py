"""Normal forms of the bifurcations of fixed points: which equations their coefficients obey.

Let G(x, x1) = 0 be a map with a fixed point p, see `maps`. A curve or chart H with H(0) = p and a
map N of its coordinates with

    G(H(h), H(N(h))) = O(|h|^(n + 1))                                                          (*)

make N the map on the image of H, in its coordinates and but for terms of order n + 1: on a centre
manifold, to that order, for a fold (N = h + b2 h^2) and a flip (N = -h + b2 h^2 + b3 h^3), where h
is one variable of the state; in the plane for a Neimark-Sacker bifurcation. The coefficients of the
powers of h in (*) are the homological equations. Those of order 0 and 1 say that p is a fixed point
with the multiplier; each higher order is linear in the unknowns of that order.

Neimark-Sacker: the multipliers are e^(+- i theta), t = 2 cos(theta); H(u, v) has the linear part P
with J P = P A, A = [[t, -1], [1, 0]], and no u^3; N(w) = A (w + Q(w) (a w + b (A - t/2) w)), with
Q(u, v) = u^2 - t u v + v^2, which A preserves. There is one such H, if no power of e^(i theta) from
the first to the fourth is 1 (the operator H -> J H - H A on cubic terms has the kernel spanned by
Q P w and Q P A w, of which the terms u^3 are independent). In formulas u, v are h1, h2.

What is reported, with the names of Kuznetsov, Elements of Applied Bifurcation Theory, chapters 4
and 5 (Theorems 4.1, 4.3, 4.5, equations (5.40) to (5.47)), for the eigenvector q given here:
- fold: a = b2, for q with the entry 1 at the variable h;
- flip: c = b2^2 + b3, likewise: the second iterate is h - 2 c h^3 + O(h^4). If c > 0 the cycle of
  period two is stable in the centre manifold;
- Neimark-Sacker: a (4 - t^2), for q = (e^(i theta) - J22, J21): with w = z (e^(i theta), 1) and its
  conjugate, Q(w) = (4 - t^2) |z|^2. If it is negative the circle is stable.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from proofs.methods.bifurcation.maps import Map

KINDS = ("fold", "flip", "neimark_sacker")
MULTIPLIER = {"fold": "1", "pitchfork": "1", "flip": "(-1)"}
_ORDER = {"fold": 2, "pitchfork": 3, "flip": 3, "neimark_sacker": 3}
_COEFFICIENTS = {
    "fold": ("b2",),
    "pitchfork": ("b2", "b3"),
    "flip": ("b2", "b3"),
    "neimark_sacker": ("a3", "b3"),
}
_CRITICALITY = {
    "fold": "b2",
    "pitchfork": "b2",
    "flip": "b2**2 + b3",
    "neimark_sacker": "a3*(4 - t**2)",
}
_SCALED = "({0}**2 - t*{0}*{1} + {1}**2)"


@dataclass(frozen=True)
class NormalForm:
    """The equations of one kind; `lead` is the variable of the state that is h."""

    map: Map
    kind: str
    lead: int = 0

    def __post_init__(self) -> None:
        if self.kind == "neimark_sacker" and len(self.map.state) == 1:
            raise ValueError("a map of one variable has no Neimark-Sacker bifurcation")
        own = {"h", *self.coordinates, *self.coefficients, *self.unknowns}
        if taken := sorted(own & {*self.map.state, *self.map.images, *self.map.parameters}):
            raise ValueError(f"a name that is used for something else: {taken[0]}")

    @property
    def order(self) -> int:
        """n, the order to which H and N are known."""
        return _ORDER[self.kind]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The coordinates of the chart."""
        return ("h1", "h2") if self.kind == "neimark_sacker" else ("h",)

    @property
    def coefficients(self) -> tuple[str, ...]:
        """The coefficients of N."""
        return _COEFFICIENTS[self.kind]

    @property
    def criticality(self) -> str:
        """The coefficient that is reported, in those of N."""
        return _CRITICALITY[self.kind]

    def powers(self, order: int) -> list[tuple[int, ...]]:
        """Return the exponents of the monomials of an order."""
        exponents = product(range(order, -1, -1), repeat=len(self.coordinates))
        return [each for each in exponents if sum(each) == order]

    def unknowns_of(self, order: int) -> tuple[str, ...]:
        """Return the names of what the equations of an order determine, those of H last."""
        own: tuple[str, ...] = ()
        if order == 1:
            own = ("t",) if self.kind == "neimark_sacker" else ()
        elif self.kind != "neimark_sacker":
            own = (f"b{order}",)
        elif order == 3:
            own = self.coefficients
        return own + tuple(
            _term(x, powers)
            for place, x in enumerate(self.map.state)
            for powers in self.powers(order)
            if not self._given(place, powers)
        )

    @property
    def unknowns(self) -> tuple[str, ...]:
        """All unknowns but the fixed point and a parameter, by the order of their equations."""
        return tuple(name for k in range(1, self.order + 1) for name in self.unknowns_of(k))

    def _given(self, place: int, powers: tuple[int, ...]) -> str | None:
        """Return the coefficient in H that is chosen, not found."""
        if self.kind != "neimark_sacker":
            return ("1" if sum(powers) == 1 else "0") if place == self.lead else None
        if powers == (1, 0):
            return "10"[place]
        return "0" if powers == (3, 0) else None

    # -- formulas ----------------------------------------------------------------------------------

    def chart(self) -> list[str]:
        """Return H, a formula for each variable of the state."""
        rows = []
        for place, x in enumerate(self.map.state):
            terms = [x]
            for order in range(1, self.order + 1):
                for powers in self.powers(order):
                    coefficient = self._given(place, powers) or _term(x, powers)
                    if coefficient != "0":
                        terms.append("*".join((coefficient, *self._monomial(powers))))
            rows.append(" + ".join(terms).replace(" + 1*", " + "))
        return rows

    def _monomial(self, powers: tuple[int, ...]) -> list[str]:
        pairs = zip(self.coordinates, powers, strict=True)
        return [f"{h}**{n}" if n > 1 else h for h, n in pairs if n]

    def reduced(self) -> list[str]:
        """Return N, a formula for each coordinate."""
        if self.kind == "fold":
            return ["h + b2*h**2"]
        if self.kind == "pitchfork":
            return ["h + b2*h**2 + b3*h**3"]
        if self.kind == "flip":
            return ["-h + b2*h**2 + b3*h**3"]
        size = _SCALED.format("h1", "h2")
        turned = (  # w + Q(w) (a w + b (A - t/2) w), to which A is applied
            f"(h1 + {size}*(a3*h1 + b3*(t*h1/2 - h2)))",
            f"(h2 + {size}*(a3*h2 + b3*(h1 - t*h2/2)))",
        )
        return [f"t*{turned[0]} - {turned[1]}", turned[0]]

    def conjugacy(self) -> list[str]:
        """Return the left sides of (*)."""
        chart = self.chart()
        moves = ", ".join(f"{h}={n}" for h, n in zip(self.coordinates, self.reduced(), strict=True))
        places = zip(self.map.state, self.map.images, chart, strict=True)
        put = ", ".join(f"{x}={here}, {x1}=at({here}, {moves})" for x, x1, here in places)
        return [f"at({each}, {put})" for each in self.map.equations]

    def homological(self, order: int) -> list[str]:
        """Return the equations of an order: formulas that are 0, up to positive factors."""
        rest = ", ".join(f"{h}=0" for h in self.coordinates)
        found = []
        for side, powers in product(self.conjugacy(), self.powers(order)):
            by = [h for h, n in zip(self.coordinates, powers, strict=True) for _ in range(n)]
            found.append(f"at(D({side}, {', '.join(by)}), {rest})" if by else f"at({side}, {rest})")
        return found

    def condition(self) -> str:
        """Return the formula that is 0, with `fixed`, at the bifurcation."""
        if self.kind == "neimark_sacker":
            return f"{self.map.characteristic('0')} - {self.map.turning()}"
        return self.map.characteristic(MULTIPLIER[self.kind])

    def speed(self, parameter: str) -> str:
        """Return how fast a parameter drives the map through the bifurcation.

        Of a fold the derivative of N; of a flip that of the multiplier; of a Neimark-Sacker
        bifurcation that of its absolute value squared, det J. It is not 0 if the parameter unfolds.
        """
        map_ = self.map
        if MULTIPLIER.get(self.kind) == "1":
            return self._drift_of_fold(parameter)
        if self.kind == "flip":
            polynomial = map_.characteristic("multiplier")
            rate = _along(polynomial, map_, parameter)
            return f"at(-({rate})/D({polynomial}, multiplier), multiplier=-1)"
        return _along(f"({map_.characteristic('0')}/{map_.turning()})", map_, parameter)

    def _drift_of_fold(self, parameter: str) -> str:
        """Return -l G_mu/(l G_x1 q), l the left null vector of G_x + G_x1, q the right one."""
        rows = [[f"D({each}, {x})" for x in self.map.state] for each in self.map.fixed]
        left, right = self._left(rows), self._right()
        turned = [
            " + ".join(f"{self.map.resting(a)}*{b}" for a, b in zip(row, right, strict=True))
            for row in self.map.partials(self.map.images)
        ]
        rates = [f"D({each}, {parameter})" for each in self.map.fixed]
        top, below = (
            " + ".join(f"{a}*({b})" for a, b in zip(left, column, strict=True))
            for column in (rates, turned)
        )
        return f"-({top})/({below})"

    def _left(self, rows: list[list[str]]) -> list[str]:
        """Return the left null vector of the derivative of `fixed`, given by rows."""
        if len(rows) == 1:
            return ["1"]
        return [rows[1][1 - self.lead], f"(-{rows[0][1 - self.lead]})"]

    def _right(self) -> list[str]:
        """Return the eigenvector, with the entry 1 at the variable h."""
        return [self._given(place, (1,)) or f"{x}_1" for place, x in enumerate(self.map.state)]

    def unfolding(self, parameter: str, row: int) -> tuple[str, str]:
        """Return what decides where the multiplier is 1 and the speed is 0: crossing, and mixed.

        Theorem (Lyapunov and Schmidt). Where F = 0, F_x q = 0 and l F_x = l F_mu = 0, the solutions
        of F = 0 near are those of a s^2 + 2 b s t + c t^2 + ... = 0, (x, mu) = (q, 0) s + (w, 1) t,
        F_x w = -F_mu, with a, 2 b, c the second derivative of l F in these directions: two curves
        that cross if b^2 > a c, one of them along s if a = 0. mixed is b; w is taken from `row`,
        with the entry 0 at the variable h.
        """
        rows = [[f"D({each}, {x})" for x in self.map.state] for each in self.map.fixed]
        names, left = (*self.map.state, parameter), self._left(rows)
        along = [*self._right(), "0"]
        across = ["0"] * len(self.map.state) + ["1"]
        if len(rows) == 2:
            other = 1 - self.lead
            across[other] = f"(-D({self.map.fixed[row]}, {parameter})/{rows[row][other]})"

        def second(first: list[str], last: list[str]) -> str:
            return " + ".join(
                f"{weight}*D({each}, {x}, {y})*{a}*{b}"
                for weight, each in zip(left, self.map.fixed, strict=True)
                for x, a in zip(names, first, strict=True)
                for y, b in zip(names, last, strict=True)
                if "0" not in (a, b)
            )

        mixed = second(along, across)
        return f"({mixed})**2 - ({second(along, along)})*({second(across, across)})", mixed


def _along(text: str, map_: Map, parameter: str) -> str:
    """Write the derivative of a formula by a parameter along the fixed point."""
    moves = zip(map_.state, map_.drift(parameter), strict=True)
    return " + ".join([f"D({text}, {parameter})", *(f"D({text}, {x})*{by}" for x, by in moves)])


def _term(variable: str, powers: tuple[int, ...]) -> str:
    return f"{variable}_{''.join(map(str, powers))}"

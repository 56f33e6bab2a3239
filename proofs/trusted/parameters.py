"""The numbers of a statement, and the parameters that a conclusion is about."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import TURN, Range, show, show_range, within


@dataclass(frozen=True)
class Place:
    """The oscillators that a conclusion is about: ranges of eta and nu, points as a rule.

    epsilon: the range of the coefficient of restitution; None: impacts are plastic.
    """

    eta: Range
    nu: Range
    epsilon: Range | None = None

    def __post_init__(self) -> None:
        """Raise Unproved where this is no oscillator, or the sign of p is not one."""
        low, high = self.sides[2]
        if not 0 < self.eta[0] <= self.eta[1] or not 0 <= low <= high < 1:
            raise Unproved("eta > 0 and 0 <= epsilon < 1 are required")
        if not (self.nu[0] <= self.nu[1] < 0 or 0 < self.nu[0] <= self.nu[1]):
            raise Unproved("nu must be positive or negative")

    @classmethod
    def plastic(cls, eta: Fraction, nu: Fraction) -> Place:
        """Return one oscillator with plastic impacts."""
        return cls((eta, eta), (nu, nu))

    @classmethod
    def restituting(cls, eta: Fraction, nu: Fraction, epsilon: Fraction) -> Place:
        """Return one oscillator whose impacts have a coefficient of restitution."""
        return cls((eta, eta), (nu, nu), (epsilon, epsilon))

    @property
    def sides(self) -> tuple[Range, Range, Range]:
        """The ranges of eta, nu and epsilon."""
        return self.eta, self.nu, self.epsilon or (Fraction(0), Fraction(0))

    @property
    def point(self) -> tuple[Fraction, Fraction]:
        """The one eta and the one nu, or Unproved: what a rule needs that knows no boxes."""
        (eta, last), (nu, most) = self.eta, self.nu
        if (eta, nu) != (last, most):
            raise Unproved("one eta and one nu are expected")
        return eta, nu

    @property
    def side(self) -> int:
        """The sign of nu."""
        return 1 if self.nu[0] > 0 else -1

    def inside(self, other: Place) -> bool:
        """Whether these oscillators are among those of another box."""
        return all(map(within, self.sides, other.sides))

    def holds(self, of: Parameters) -> bool:
        """Whether the oscillator of a statement is among these."""
        if self.epsilon is None:
            return of.place.inside(self)
        return of.epsilon is not None and Place.restituting(of.eta, of.nu, of.epsilon).inside(self)

    def __str__(self) -> str:
        """Write "(eta, nu) = (0.2121, -0.2)", or each parameter by itself."""
        if self.epsilon is None and self.eta[0] == self.eta[1] and self.nu[0] == self.nu[1]:
            return f"(eta, nu) = ({show(self.eta[0])}, {show(self.nu[0])})"
        return ", ".join(
            f"{name} = {show(low)}" if low == high else f"{name} in {show_range((low, high))}"
            for name, (low, high) in zip(("eta", "nu", "epsilon"), self.sides, strict=True)
        )


@dataclass(frozen=True)
class Parameters:
    """One statement's numbers, exact: the oscillator, I0 = left, I1 = right, I, slope bounds.

    `ratios` are eta0, eta1 of section 3.2 as printed, without them they are 1 / slopes;
    `printed_s0` the digits printed for s_0, if any. For section 3.3: the coefficient of
    restitution and the range of the velocity gamma, both sets of phases times it being the
    rectangles ABCD and EFGH. `reach`: how far eta, nu and epsilon may be from these, for claims
    about a box of parameters. `signs`: those of f' that claims are about, on I0 and on I1.
    """

    eta: Fraction
    nu: Fraction
    left: Range
    right: Range
    interval: Range
    slopes: Range
    ratios: Range | None = None
    printed_s0: str | None = None
    epsilon: Fraction | None = None
    velocities: Range | None = None
    reach: tuple[Fraction, Fraction, Fraction] | None = None
    signs: tuple[int, int] = (1, 1)

    def __post_init__(self) -> None:
        """Raise ValueError, one line, where the numbers do not describe a horseshoe."""
        if self.eta <= 0:
            raise ValueError(f"eta must be positive, not {show(self.eta)}")
        if self.nu == 0:
            raise ValueError("nu must not be 0: the table would stand still")
        if self.left[1] >= self.right[0]:
            raise ValueError("left and right intervals overlap, or are in the wrong order")
        for name in ("left", "right", "interval"):
            low, high = getattr(self, name)
            if low >= high:
                raise ValueError(f"{name}: reversed or empty: {show(low)} >= {show(high)}")
            if low < 0 or high > TURN:
                raise ValueError(f"{name}: {show_range((low, high))} leaves [0, {show(TURN)}]")
        if self.left[0] < self.interval[0] or self.right[1] > self.interval[1]:
            raise ValueError("left and right intervals must lie in the interval I")
        for name in ("slopes", "ratios"):
            low, high = getattr(self, name) or (1, 1)
            if not 0 < low <= high:
                raise ValueError(f"{name} must be positive and in increasing order")
        if self.epsilon is not None and not 0 <= self.epsilon < 1:
            raise ValueError(f"epsilon must be in [0, 1), not {show(self.epsilon)}")
        if self.velocities is not None and self.velocities[0] >= self.velocities[1]:
            raise ValueError(f"velocities reversed or empty: {show_range(self.velocities)}")
        if self.reach is not None:
            self._check_reach(*self.reach)

    def _check_reach(self, eta: Fraction, nu: Fraction, epsilon: Fraction) -> None:
        """Raise ValueError where numbers of the box leave the model."""
        if min(eta, nu, epsilon) < 0:
            raise ValueError("reach: distances from eta, nu and epsilon must not be negative")
        if eta >= self.eta:
            raise ValueError(f"reach: eta - {show(eta)} must be positive")
        if nu >= abs(self.nu):
            raise ValueError(f"reach: nu must keep its sign, {show(nu)} around it does not")
        if self.epsilon is not None and self.epsilon + epsilon >= 1:
            raise ValueError(f"reach: epsilon + {show(epsilon)} must be below 1")

    @property
    def box(self) -> Place | None:
        """The ranges of eta, nu and epsilon >= 0 within reach; None without epsilon."""
        if self.epsilon is None:
            return None
        eta, nu, epsilon = self.reach or (Fraction(0),) * 3
        return Place(
            (self.eta - eta, self.eta + eta),
            (self.nu - nu, self.nu + nu),
            (max(Fraction(0), self.epsilon - epsilon), self.epsilon + epsilon),
        )

    @property
    def place(self) -> Place:
        """The oscillator, with plastic impacts."""
        return Place.plastic(self.eta, self.nu)

    @property
    def gap(self) -> Range:
        """The phases between I0 and I1 (open)."""
        return self.left[1], self.right[0]

    @property
    def reciprocals(self) -> Range:
        """1 / slopes, the contraction ratios, larger slope first as in the paper."""
        return 1 / self.slopes[1], 1 / self.slopes[0]

    @property
    def moran_ratios(self) -> Range:
        """eta0, eta1 of the equation for s_0."""
        return self.ratios or self.reciprocals

    def fill(self, text: str) -> str:
        """Put these numbers into the text of a claim."""
        return text.format(
            eta=show(self.eta),
            nu=show(self.nu),
            i=show_range(self.interval),
            i0=show_range(self.left),
            i1=show_range(self.right),
            gap=f"({show(self.gap[0])}, {show(self.gap[1])})",
            slope=SIGNED[self.signs],
            signed=""
            if len(set(self.signs)) == 1
            else f", s = {self.signs[0]} on I0, {self.signs[1]} on I1",
            moves=MOVES[self.signs[0]],
            again="" if len(set(self.signs)) == 1 else f"{MOVES[self.signs[1]]} ",
            lo=show(self.slopes[0]),
            hi=show(self.slopes[1]),
            r0=_base(self.moran_ratios[0]),
            r1=_base(self.moran_ratios[1]),
            s0=f", s_0 = {self.printed_s0}..." if self.printed_s0 else "",
            epsilon="no epsilon" if self.epsilon is None else show(self.epsilon),
            gamma="no velocities" if self.velocities is None else show_range(self.velocities),
            box="no epsilon" if self.box is None else str(self.box),
        )


def _base(ratio: Fraction) -> str:
    """Write a number that is raised to a power."""
    written = show(ratio)
    return f"({written})" if "/" in written else written


SIGNED = {(1, 1): "f'", (-1, -1): "-f'", (1, -1): "s f'", (-1, 1): "s f'"}  # what is bounded
MOVES = {1: "increases", -1: "decreases"}
PAPER = Parameters(
    eta=Fraction("0.2121"),
    nu=Fraction("-0.2"),
    left=(Fraction("1.11"), Fraction("1.15")),
    right=(Fraction("1.27"), Fraction("1.32")),
    interval=(Fraction("1.11"), Fraction("1.32")),
    slopes=(Fraction("4.2"), Fraction("5.25")),
    ratios=(Fraction("0.1905"), Fraction("0.2381")),
    printed_s0="0.449",
    epsilon=Fraction("0.01"),
    velocities=(Fraction("-0.45"), Fraction(0)),
    reach=(Fraction("0.00005"), Fraction("0.00005"), Fraction("0.005")),
)

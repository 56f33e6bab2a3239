"""The numbers of a statement, and what has been proved about them: trusted, and shared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

Range = tuple[Fraction, Fraction]

TURN = Fraction("6.283185307")  # a little less than 2 pi


def show(value: Fraction) -> str:
    """Write an exact rational as a plain decimal where it is one, else as p/q."""
    rest, twos, fives = value.denominator, 0, 0
    while rest % 2 == 0:
        rest, twos = rest // 2, twos + 1
    while rest % 5 == 0:
        rest, fives = rest // 5, fives + 1
    places = max(twos, fives)
    if rest != 1 or places > 40:
        return str(value)
    digits = str(abs(value.numerator) * (10**places // value.denominator)).rjust(places + 1, "0")
    sign = "-" if value < 0 else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def show_range(values: Range) -> str:
    """Write a closed interval of exact rationals."""
    return f"[{show(values[0])}, {show(values[1])}]"


def floor_text(value: Fraction, places: int = 6) -> str:
    """Write a decimal of so many places that is <= value."""
    return show(Fraction(value * 10**places // 1, 10**places))


def ceil_text(value: Fraction, places: int = 6) -> str:
    """Write a decimal of so many places that is >= value."""
    return show(-Fraction(-value * 10**places // 1, 10**places))


def parameters_text(box: tuple[Range, Range, Range]) -> str:
    """Write eta, nu and epsilon, exact or in ranges."""
    parts = zip(("eta", "nu", "epsilon"), box, strict=True)
    return ", ".join(
        f"{name} = {show(low)}" if low == high else f"{name} in {show_range((low, high))}"
        for name, (low, high) in parts
    )


def within(inner: Range, outer: Range) -> bool:
    """Whether one range contains another."""
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def hull(ranges: Sequence[Range]) -> Range:
    """Return the smallest range that contains all."""
    return min(low for low, _ in ranges), max(high for _, high in ranges)


def agree(bounds: Range, digits: int) -> bool:
    """Whether two bounds are equal to `digits` significant digits."""
    return bounds[1] - bounds[0] <= min(abs(bounds[0]), abs(bounds[1])) / Fraction(10) ** digits


@dataclass(frozen=True)
class Parameters:
    """One statement's numbers, exact: the oscillator, I0 = left, I1 = right, I, slope bounds.

    `ratios` are eta0, eta1 of section 3.2 as printed, without them they are 1 / slopes;
    `printed_s0` the digits printed for s_0, if any. For section 3.3: the coefficient of
    restitution and the range of the velocity gamma, both sets of phases times it being the
    rectangles ABCD and EFGH. `reach`: how far eta, nu and epsilon may be from these, for claims
    about a box of parameters.
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

    def __post_init__(self) -> None:
        """Raise ValueError, one line, where the numbers do not describe a horseshoe."""
        if self.eta <= 0:
            raise ValueError(f"eta must be positive, not {show(self.eta)}")
        if self.nu == 0:
            raise ValueError("nu must not be 0: the table would stand still")
        for name in ("left", "right", "interval"):
            low, high = getattr(self, name)
            if low >= high:
                raise ValueError(f"{name} interval reversed or empty: {show(low)} >= {show(high)}")
            if low < 0 or high > TURN:
                raise ValueError(f"{name} interval {show_range((low, high))} leaves [0, 2 pi)")
        if self.left[1] >= self.right[0]:
            raise ValueError("left and right intervals overlap, or are in the wrong order")
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
    def box(self) -> tuple[Range, Range, Range] | None:
        """The ranges of eta, nu and epsilon >= 0 within reach; None without epsilon."""
        if self.epsilon is None:
            return None
        eta, nu, epsilon = self.reach or (Fraction(0),) * 3
        return (
            (self.eta - eta, self.eta + eta),
            (self.nu - nu, self.nu + nu),
            (max(Fraction(0), self.epsilon - epsilon), self.epsilon + epsilon),
        )

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


@dataclass(frozen=True)
class PointFact:
    """A phase with a proved transversal first impact: f'(phase) and f(phase) mod 2 pi."""

    phase: Fraction
    slope: Range
    image: Range


@dataclass(frozen=True)
class SlopeRange:
    """f is C^1 on [points[0], points[-1]]; f' and f at the points, f' over each piece between."""

    points: tuple[Fraction, ...]
    slopes: tuple[Range, ...]
    images: tuple[Range, ...]
    pieces: tuple[Range, ...]


@dataclass(frozen=True)
class Avoids:
    """No phase in `phases` has its first impact at a phase in `target`, mod 2 pi."""

    phases: Range
    target: Range


@dataclass(frozen=True)
class MoranRoot:
    """The one root s > 0 of ratios[0]^s + ratios[1]^s = 1 lies in `root`."""

    ratios: Range
    root: Range


@dataclass
class Facts:
    """What has been proved, as rational enclosures; empty where nothing has.

    Keys 0 and 1 stand for I0 and I1. slope_min, slope_max: the extremes of f' on the closed
    interval, where f is C^1, every phase's first impact being transversal. images: f(left end)
    and f(right end), mod 2 pi. avoided: f maps the closed gap outside I. s0: the root for
    `moran_ratios`, s0_reciprocal: the root for 1 / slopes. points, missed: witnesses to look
    at, the second an interval J that may have no preimage.
    """

    slope_min: dict[int, Range] = field(default_factory=dict)
    slope_max: dict[int, Range] = field(default_factory=dict)
    images: dict[int, tuple[Range, Range]] = field(default_factory=dict)
    avoided: bool = False
    points: list[PointFact] = field(default_factory=list)
    missed: Range | None = None
    s0: Range | None = None
    s0_reciprocal: Range | None = None

    def add(self, of: Parameters, step: object) -> bool:
        """Take what a conclusion says about these sets; False if it is of another kind."""
        if isinstance(step, SlopeRange):
            self.add_slopes(of, step)
        elif isinstance(step, Avoids):
            self.add_avoided(of, step.phases, step.target)
        elif isinstance(step, MoranRoot):
            self.add_root(of, step.ratios, step.root)
        else:
            return False
        return True

    def add_slopes(self, of: Parameters, found: SlopeRange) -> None:
        """Take what `found` says about I0 and I1, where their ends are among its points.

        The minimum of f' lies between the least lower bound over the pieces and the least
        upper bound at the points, the maximum likewise.
        """
        for index, domain in enumerate((of.left, of.right)):
            if not set(domain) <= set(found.points):
                continue
            first, last = (found.points.index(end) for end in domain)
            slopes, pieces = found.slopes[first : last + 1], found.pieces[first:last]
            self.slope_min[index] = (
                min(low for low, _ in pieces),
                min(high for _, high in slopes),
            )
            self.slope_max[index] = (
                max(low for low, _ in slopes),
                max(high for _, high in pieces),
            )
            self.images[index] = (found.images[first], found.images[last])

    def add_avoided(self, of: Parameters, phases: Range, target: Range) -> None:
        """Take that no phase of `phases` has its first impact in `target`."""
        whole = phases[0] <= of.gap[0] and of.gap[1] <= phases[1]
        if whole and target[0] <= of.interval[0] and of.interval[1] <= target[1]:
            self.avoided = True

    def add_root(self, of: Parameters, ratios: Range, root: Range) -> None:
        """Take a bracket of the root of ratios[0]^s + ratios[1]^s = 1."""
        if ratios == of.moran_ratios:
            self.s0 = root
        if ratios == of.reciprocals:
            self.s0_reciprocal = root

    @property
    def slopes_known(self) -> bool:
        """Whether f' is bounded on both I0 and I1."""
        return len(self.slope_min) == 2

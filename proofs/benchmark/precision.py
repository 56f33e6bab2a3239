"""Time against error: slope bounds, flights, s_0, dimensions, orbits, coverings, checks.

Each curve is one way to do one work at growing cost; orders are least-squares fits. Ours and
those of peers run in turn, and ratios are of samples taken side by side. An enclosure that
excludes the truth is reported as such; python-flint, codac and scipy are optional. mpmath.iv is
measured, but it is not proved sound: its exp can exclude the true value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from proofs.benchmark import long_curves, point_curves, slope_curves
from proofs.benchmark.curves import Budget, Curve, ratios, row
from proofs.benchmark.diagrams import Diagram
from proofs.benchmark.measuring import Row, version_of
from proofs.benchmark.page import Section
from proofs.benchmark.peers import CODAC, FLINT, IV, Codac, codac, has_flint

Tell = Callable[[str], None]
Sizes = tuple[float, ...]


@dataclass(frozen=True)
class Plan:
    """How much is measured. Sizes grow until one run takes longer than the budget's limit."""

    budget: Budget  # of the forms, which are many
    points: Budget
    long: Budget
    boxes: Sizes
    few_boxes: Sizes
    slope_digits: tuple[int, ...]
    orders: tuple[int, ...]
    digits: Sizes
    steps: Sizes
    dimension_digits: Sizes
    pieces: Sizes
    periods: tuple[int, ...]
    checking: float


PLANS = {
    "smallest": Plan(
        Budget(1, 0.01),
        Budget(1, 0.01),
        Budget(1, 0.01),
        (1, 4, 16),
        (1, 4),
        (30, 300),
        (1,),
        (15, 100),
        (1e-1, 1e-2, 1e-3),
        (1,),
        (1, 2),
        (1, 2),
        0.1,
    ),
    "quick": Plan(
        Budget(2, 0.1),
        Budget(4, 0.1),
        Budget(1, 4.0),
        (1, 4, 16, 64, 256, 1024, 4096),
        (1, 4, 16),
        (30, 50, 100, 300),
        (4,),
        (15, 30, 50, 100, 300),
        (1e-1, 1e-2, 1e-3, 1e-4, 1e-5),
        (2, 4, 6),
        (1, 2, 4),
        (1, 2, 4, 6, 8, 10, 12),
        12.0,
    ),
    "full": Plan(
        Budget(5, 0.1),
        Budget(5, 0.2),
        Budget(3, 20.0),
        tuple(2.0**k for k in range(13)),
        tuple(2.0**k for k in range(10)),
        (30, 50, 100, 300),
        (0, 1, 2, 3, 4),
        (15, 30, 50, 100, 200, 300),
        (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6),
        (2, 5, 10, 15, 20, 30),
        (1, 2, 4, 8, 16, 32),
        tuple(range(1, 15)),
        float("inf"),
    ),
}
_PEERS = (FLINT, IV, CODAC)
_SLOPES = (
    "Bounds of f' over I0 and I1 by the natural, the mean-value and Taylor forms. Boxes, grids and "
    "brackets are given to all alike; each excludes earlier impacts, proves the brackets and "
    "encloses f'."
)
_LOSS = "error: by how much the bounds of f' miss its extremes [1]"
_FLIGHT = "error: of the worst of six flight times [1/ω]"


def measure(mode: str, python: str, reports: Path, tell: Tell) -> Iterator[Section]:
    """Measure everything; codac in a process of the interpreter `python`."""
    plan, flint = PLANS[mode], has_flint()
    with codac(python, "codac_slopes") as server:
        yield Section("Beside whom", _WHO, list(_peers(flint, server)))
        tell("slope bounds in binary64")
        slopes = slope_curves.binary64(plan.budget, plan.boxes, flint, server)
    title = "Slope bounds in binary64"
    diagram = Diagram("slopes-binary64", title, slopes, _LOSS, panels=True)
    about = "Monotonicity proves f'' > 0 and takes f' at the ends; ours does all boxes at once."
    yield _section(title, f"{_SLOPES} {about}", diagram)
    yield _multiprecision(plan, flint, tell)
    yield _monotone(plan, flint, tell)
    yield _flights(plan, flint, tell)
    yield from _at_points(plan, flint, tell)
    yield from _proofs(plan, reports, tell)


def _section(title: str, about: str, *diagrams: Diagram) -> Section:
    """Return the rows of all curves and of their ratios."""
    rows = []
    for diagram in diagrams:
        if not diagram.certified:  # else drawn twice, listed once
            rows += [row(curve) for curve in diagram.curves]
            rows += _beside(diagram.curves)
    return Section(title, about, rows, list(diagrams))


def _multiprecision(plan: Plan, flint: bool, tell: Tell) -> Section:
    """Measure slope bounds in multiprecision: all forms at the first number of digits."""
    diagrams = []
    for digits in plan.slope_digits:
        tell(f"slope bounds, {digits} digits")
        orders = tuple(slope_curves.NAMES) if digits == plan.slope_digits[0] else plan.orders
        found = slope_curves.multiprecision(plan.budget, digits, orders, plan.few_boxes, flint)
        title = f"Slope bounds at {digits} digits"
        diagrams.append(Diagram(f"slopes-{digits}-digits", title, found, _LOSS, panels=True))
    about = "f' to so many digits, signs to 53 bits, box by box in all libraries."
    return _section("Slope bounds in multiprecision", f"{_SLOPES} {about}", *diagrams)


def _monotone(plan: Plan, flint: bool, tell: Tell) -> Section:
    """Measure slope bounds by monotonicity."""
    tell("slope bounds by monotonicity")
    found = slope_curves.by_monotonicity(plan.points, plan.digits, flint)
    title = "Slope bounds by monotonicity, where f'' > 0"
    about = (
        "f'' > 0 is proved on 8 boxes of each interval to 53 bits; then f' at the two ends, to so "
        "many digits, is all. search.steps is what the main job calls: it is given nothing and "
        "keeps the witness."
    )
    across = "digits: -log10 of what the bounds of f' miss its extremes by"
    return _section(title, about, Diagram("slopes-monotone", title, found, across, "digits"))


def _flights(plan: Plan, flint: bool, tell: Tell) -> Section:
    """Measure flights."""
    tell("flights")
    found = point_curves.flights(plan.points, plan.digits, plan.steps, flint)
    title = "Flight time and map at a point"
    about = (
        "The first impact after six launches, and the map and its slope there. The certified map "
        "is given the phase alone; where the grid is given, earlier impacts are excluded on the "
        "same grid by all. The others prove nothing: algorithm A.1 marches as the paper prints it, "
        "solve_ivp integrates until an event. An error above 1 is an impact that was passed over."
    )
    both = Diagram("flights", title, found, _FLIGHT, least=1e-40)
    title, across = f"{title}, certified", "digits: -log10 of the largest width in 1/ω"
    digits = Diagram("flights-digits", title, found, across, "digits", certified=True)
    return _section(both.title, about, both, digits)


def _at_points(plan: Plan, flint: bool, tell: Tell) -> Iterator[Section]:
    """Measure s_0 and images of edges."""
    tell("s_0 and coverings")
    moran = point_curves.moran(plan.points, plan.digits, flint)
    title = "The root s_0"
    about = (
        "Brackets of the root of r0^s + r1^s = 1 at the printed ratios: Newton's method and two "
        "signs. The peers run the same algorithm."
    )
    across = "digits: -log10 of the width of the bracket"
    yield _section(title, about, Diagram("s0", title, moran, across, "digits"))
    edges = point_curves.coverings(plan.long, plan.pieces)
    title = "Covering relations: images of edges"
    about = (
        "The vertical edges of V1 and V2 are cut into pieces, and each is mapped with restitution "
        "0.01, as claim N1 does. The error is what the images of the pieces exceed those of the "
        "corners by."
    )
    across = "error: excess of the image phases [rad]"
    yield _section(title, about, Diagram("coverings", title, edges, across))


def _proofs(plan: Plan, reports: Path, tell: Tell) -> Iterator[Section]:
    """Measure dimensions, periodic points and checks."""
    tell("dimensions")
    dimensions = long_curves.dimensions(plan.long, plan.dimension_digits)
    title = "Two Hausdorff dimensions"
    about = (
        "The proof of claim H13 to so many digits: the true dimensions of two repellers. No peer "
        "has this."
    )
    across = "digits: -log10 of the width of the wider enclosure"
    yield _section(title, about, Diagram("dimensions", title, dimensions, across, "digits"))
    tell("periodic points")
    by_period, by_digits = long_curves.periodic(plan.points, plan.periods, plan.digits)
    title = "All periodic points of a period"
    about = (
        "Each word of 0 and 1 has one periodic point, which is enclosed. There are 2^n words of "
        "length n, and the errors stay those of the arithmetic."
    )
    across = "digits: -log10 of the width of the widest phase in rad"
    yield _section(
        title,
        about,
        Diagram("orbits", title, by_period, "words: 2^period", "size"),
        Diagram("orbits-digits", f"{title}, period 4, by digits", by_digits, across, "digits"),
    )
    tell("checks")
    (checked,), rows = long_curves.checks(plan.long, reports, plan.checking)
    title = "The check of certificates"
    about = (
        "The independent checker on certificates that are there, read and checked in this process. "
        "It decides; there is no error to show, so the size is shown."
    )
    across = "size of the certificate [kB]"
    yield Section(title, about, rows, [Diagram("checks", title, [checked], across, "size")])


_WHO = (
    "Ours is measured beside these, on the same work, as far as they are installed. All but scipy "
    "claim to enclose the truth, and each enclosure is compared with it."
)


def _peers(flint: bool, server: Codac | None) -> Iterator[Row]:
    """Say of each peer what it is, or that it is absent."""
    balls = f"version {version_of(FLINT)}: balls of any precision, in C (FLINT, Arb)"
    yield Row(FLINT, balls if flint else f"{FLINT} is absent")
    yield Row(
        IV,
        f"version {version_of('mpmath')}: intervals of any precision, in Python; measured, but not "
        "proved sound: its exp can exclude the true value",
    )
    boxes = "binary64 intervals, in C++; in a process of its own: it changes the rounding mode"
    yield Row(CODAC, f"version {server.version}: {boxes}" if server else f"{CODAC} is absent")
    solver = f"version {version_of('scipy')}: solve_ivp with an event at the impact, a simulation"
    yield Row("scipy", solver if point_curves.has_scipy() else "scipy is absent: no solve_ivp")


def _beside(curves: list[Curve]) -> Iterator[Row]:
    """Yield the ratios of peers to the first way of the same work and form, which is ours."""
    own: dict[tuple[str, str, str], Curve] = {}
    for curve in curves:
        form = curve.way.rpartition(", ")[0]
        first = own.setdefault((curve.work, form, curve.unit), curve)
        if first is not curve and curve.way.endswith(_PEERS):
            found = ratios(first, curve)
            if found is not None:
                yield found

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
from proofs.benchmark.measuring import Row
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
        Budget(2, 0.05),
        Budget(4, 0.05),
        Budget(1, 4.0),
        (1, 4, 16, 64, 256, 1024, 4096),
        (1, 4, 16),
        (30, 50, 100, 300),
        (4,),
        (15, 30, 50, 100, 300),
        (1e-1, 1e-2, 1e-3, 1e-4, 1e-5),
        (2, 4, 6),
        (1, 2, 4, 8),
        (1, 2, 4, 6, 8, 10, 12),
        3.0,
    ),
    "full": Plan(
        Budget(5, 0.1),
        Budget(5, 0.1),
        Budget(1, 20.0),
        tuple(2.0**k for k in range(13)),
        tuple(2.0**k for k in range(10)),
        (30, 50, 100, 300),
        (0, 1, 2, 3, 4),
        (15, 30, 50, 100, 300, 1000),
        (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6),
        (2, 5, 10, 15, 20, 30),
        (1, 2, 4, 8, 16, 32),
        tuple(range(1, 15)),
        float("inf"),
    ),
}
_PEERS = (FLINT, IV, CODAC)


def measure(mode: str, python: str, reports: Path, tell: Tell) -> tuple[list[Row], list[Diagram]]:
    """Measure everything; codac in a process of the interpreter `python`."""
    plan, flint = PLANS[mode], has_flint()
    with codac(python, "codac_slopes") as server:
        rows = [*_absent(flint, server)]
        tell("slope bounds in binary64")
        slopes = slope_curves.binary64(plan.budget, plan.boxes, flint, server)
    diagrams = [Diagram("slopes-binary64", "Slope bounds in binary64", slopes)]
    diagrams += _slopes(plan, flint, tell)
    diagrams += _points(plan, flint, tell)
    tell("checks")
    checked, about = long_curves.checks(plan.points, reports, plan.checking)
    for diagram in diagrams:
        if not diagram.certified:  # else drawn twice, listed once
            rows += [row(curve) for curve in diagram.curves]
            rows += _beside(diagram.curves)
    diagrams.append(Diagram("checks", "The check of a certificate", checked))
    return rows + about, diagrams


def _slopes(plan: Plan, flint: bool, tell: Tell) -> Iterator[Diagram]:
    """Measure slope bounds in multiprecision: all forms at the first number of digits."""
    for digits in plan.slope_digits:
        tell(f"slope bounds, {digits} digits")
        orders = tuple(slope_curves.NAMES) if digits == plan.slope_digits[0] else plan.orders
        found = slope_curves.multiprecision(plan.budget, digits, orders, plan.few_boxes, flint)
        yield Diagram(f"slopes-{digits}-digits", f"Slope bounds at {digits} digits", found)
    tell("slope bounds by monotonicity")
    monotone = slope_curves.by_monotonicity(plan.points, plan.digits, flint)
    yield Diagram("slopes-monotone", "Slope bounds where f'' > 0", monotone)


def _points(plan: Plan, flint: bool, tell: Tell) -> Iterator[Diagram]:
    """Measure the rest."""
    tell("flights")
    flights = point_curves.flights(plan.points, plan.digits, plan.steps, flint)
    yield Diagram("flights", "Six flight times", flights, least=1e-40)
    yield Diagram("flights-digits", "Six flight times", flights, certified=True)
    tell("s_0 and coverings")
    yield Diagram("s0", "The root s_0", point_curves.moran(plan.points, plan.digits, flint))
    edges = point_curves.coverings(plan.points, plan.pieces)
    yield Diagram("coverings", "Images of edges, for the coverings of N1", edges)
    tell("dimensions")
    dimensions = long_curves.dimensions(plan.long, plan.dimension_digits)
    yield Diagram("dimensions", "Two Hausdorff dimensions", dimensions)
    tell("periodic points")
    orbits = long_curves.periodic(plan.points, plan.periods, plan.digits)
    yield Diagram("orbits", "All periodic points of a period", orbits)


def _absent(flint: bool, server: Codac | None) -> Iterator[Row]:
    """Say of each peer what it is, or that it is absent."""
    version = f"version {server.version}, in a process of its own" if server else "codac is absent"
    yield Row(CODAC, version)
    if not flint:
        yield Row("python-flint", "python-flint is absent")
    if not point_curves.has_scipy():
        yield Row("scipy", "scipy is absent: no solve_ivp")
    yield Row("mpmath.iv", "measured, but not proved sound: its exp can exclude the true value")


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

"""Time against error: slope bounds and flights.

Each curve is one way to do one work at growing cost; orders are least-squares fits. Ours and
those of peers run in turn, and ratios are of samples taken side by side. An enclosure that
excludes the truth is reported as such; python-flint and scipy are optional.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from proofs.benchmark import tasks
from proofs.benchmark.curves import Budget, Curve, Diagram, beside, sweep
from proofs.benchmark.measure import Row, Tell, version_of
from proofs.benchmark.page import Section
from proofs.benchmark.peers import FLINT, IV, installed, libraries


class Plan(NamedTuple):
    """How much is measured: sizes grow until one run takes longer than the budget's limit."""

    many: Budget  # of forms and points
    stride: int  # of the powers of 2 that are numbers of boxes
    orders: Sequence[int]  # of the forms at 50 digits and more


PLANS = {
    "smallest": Plan(Budget(1, 0.01), 2, ()),
    "quick": Plan(Budget(2, 0.1), 2, (4,)),
    "full": Plan(Budget(5, 0.1), 1, (0, 1, 2, 3, 4)),
}
_FORMS = ("natural", "mean value", "Taylor 2", "Taylor 3", "Taylor 4")
_DIGITS = (15, 30, 50, 100, 200, 300)
_WIDTH = "digits: -log10 of the width"


def section(about: str, works: Sequence[Sequence[Curve]], *diagrams: Diagram) -> Section:
    """Return the rows and diagrams of curves that are measured, those of each work together."""
    curves = [curve for work in works for curve in work]
    for diagram in diagrams:
        diagram.curves.extend(curves)
    rows = [curve.row() for curve in curves] + beside(curves)
    return Section(diagrams[0].title, about, rows, diagrams)


def measure(mode: str, tell: Tell) -> Iterator[Section]:
    """Measure everything."""
    plan = PLANS[mode]
    yield _peers()
    for digits in (None, 30, 50, 100, 300) if plan.orders else (None, 30):
        tell(f"slope bounds, {digits or 'binary64'}")
        yield _slopes(plan, digits)
    yield of_main_job(mode, tell)
    tell("flights")
    yield _flights(plan)


def of_main_job(mode: str, tell: Tell) -> Section:
    """Measure the bounds of f' that the main job rests on."""
    plan = PLANS[mode]
    tell("slope bounds by monotonicity")
    curve = partial(Curve, "f' on I0 and I1, f'' > 0", unit="digits", sizes=_DIGITS)
    ways = [curve(name, run=partial(tasks.monotone, name)) for name in libraries()]
    ways.append(curve("the main job's, witness kept", run=tasks.main_job_slopes))
    title = "Slope bounds by monotonicity, where f'' > 0"
    across = "digits: -log10 of what the bounds of f' miss its extremes by"
    return section(
        "f'' > 0 is proved on 8 boxes of each interval to 53 bits; then f' at the two ends, to so "
        "many digits, is all. What the main job calls is given nothing and keeps the witness.",
        [sweep(ways, plan.many)],
        Diagram("slopes-monotone", title, across, "digits"),
    )


def _slopes(plan: Plan, digits: int | None) -> Section:
    """Measure the bounds of f' by all forms, in binary64 or to some digits; to many by some."""
    where = f"{digits} digits" if digits else "binary64"
    floor = 10.0**-digits if digits else 1e-14
    sizes = [2.0**k for k in range(0, 10 if digits else 13, plan.stride)]
    curve = partial(Curve, f"f' on I0 and I1, {where}", unit="boxes", sizes=sizes, against="error")
    works = []
    for order in plan.orders if digits and digits > 30 else range(len(_FORMS)):
        form = partial(curve, floor=floor, least=order + 0.8)  # the excess: boxes^-(order + 1)
        ways = [
            form(f"{_FORMS[order]}, {name}", run=partial(tasks.by_library, name, order, digits))
            for name in libraries()
        ]
        works.append(sweep(ways, plan.many))
    name, title = where.replace(" ", "-"), f"Slope bounds {'at' if digits else 'in'} {where}"
    across = "error: by how much the bounds of f' miss its extremes [1]"
    return section(
        "Bounds of f' over I0 and I1 by the natural, the mean-value and Taylor forms. Boxes, grids "
        "and brackets are given to all alike; each excludes earlier impacts, proves the brackets, "
        "both to 53 bits, and encloses f', box by box.",
        works,
        Diagram(f"slopes-{name}", title, across, panels=True),
    )


def _flights(plan: Plan) -> Section:
    curve = partial(Curve, "6 flights, I0 and I1", sizes=_DIGITS, unit="digits")
    proved = [
        curve(f"the grid given, {name}", run=partial(tasks.flights, name)) for name in libraries()
    ]
    proved.append(curve("certified map (search.image)", run=tasks.images))
    guess = partial(curve, proved=False, against="")
    steps, tolerances = [10.0**-k for k in range(1, 7)], [10.0**-k for k in range(3, 14, 2)]
    march = guess("algorithm A.1", unit="step", sizes=steps, run=tasks.marches, least=0.8)
    march.against = "error"
    others = [march]
    for method in ("RK45", "DOP853") if installed("scipy") else ():
        name, run = f"scipy solve_ivp, {method}", partial(tasks.solved, method)
        others.append(guess(name, unit="tolerance", sizes=tolerances, run=run))
    title, error = "Flight time and map at a point", "error: of the worst of six flight times [1/ω]"
    return section(
        "The first impact after six launches, and the map and its slope there. The certified map "
        "is given the phase alone; where the grid is given, earlier impacts are excluded on the "
        "same grid by all. The others prove nothing: algorithm A.1 marches as the paper prints it, "
        "solve_ivp integrates until an event. An error above 1 is an impact that was passed over.",
        [sweep(proved, plan.many), sweep(others, plan.many)],
        Diagram("flights", title, error, least=1e-40),
        Diagram("flights-digits", f"{title}, certified", _WIDTH, "digits", certified=True),
    )


def _peers() -> Section:
    """Say of each peer what it is, or that it is absent."""
    peers = {
        FLINT: "balls of any precision, in C (FLINT, Arb)",
        "mpmath": f"as {IV}, in Python; not proved sound: its exp can exclude the truth",
        "scipy": "solve_ivp with an event at the impact, a simulation",
    }
    rows = [Row(name, f"{version_of(name)}: {what}") for name, what in peers.items()]
    about = (
        "Ours is measured beside these, on the same work, as far as they are installed. All but "
        "scipy claim to enclose the truth, and each enclosure is compared with it."
    )
    return Section("Beside whom", about, rows)

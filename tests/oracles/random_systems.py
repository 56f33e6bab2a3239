"""Maps and impacting systems at random, and their images by simulation, from other formulas.

`python -m tests.oracles.random_systems 200` runs the command on so many and counts what is proved.
"""

from __future__ import annotations

import contextlib
import io
import json
import math
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import numpy as np

from proofs.commands.system import main
from proofs.trusted.kernel.cycle import PeriodicOrbit
from proofs.trusted.kernel.graph import Entropy
from proofs.trusted.verify import check

TURN = 2 * math.pi
STEP, LATEST = 1e-2, 80.0
ROOM = 1e-2  # of multipliers to 1
MOST = 8  # conclusions of one claim that are simulated, spread over all


@dataclass
class Case:
    """What the command gets, and one step of the map in floating point, angles not reduced."""

    kind: str
    arguments: list[str]
    file: str
    image: Callable[[list[float]], list[float]]
    periods: list[float]  # 0 for what is no angle


def case(seed: int) -> Case:
    """Return the case of a seed; the kinds take turns."""
    rng = Random(seed)
    kinds = (_line, _plane, _cylinder, _ball, _wall, _walls)
    return kinds[seed % len(kinds)](lambda low, high: f"{rng.uniform(low, high):.3f}")


def _line(draw):
    a, b, c, d = draw(-1, 1), draw(-2, 2), draw(-2, 2), draw(-0.5, 0.5)
    p, q, r, s = map(float, (a, b, c, d))
    formula = f"{a} + {b}*x + {c}*x^2 + {d}*x^3"
    return Case(
        "line", ["--map", formula], "", lambda x: [p + x[0] * (q + x[0] * (r + x[0] * s))], [0]
    )


def _plane(draw):
    a, b, c, d = draw(0.3, 6), draw(-1, 1), draw(-0.5, 0.5), draw(-0.3, 0.3)
    p, q, r, s = map(float, (a, b, c, d))
    formulas = [f"1 - {a}*x^2 + y + {c}*x", f"{b}*x + {d}*x*y"]

    def image(x):
        return [1 - p * x[0] ** 2 + x[1] + r * x[0], q * x[0] + s * x[0] * x[1]]

    return Case("plane", ["--map", *formulas], "", image, [0, 0])


def _cylinder(draw):
    k, b, w = draw(0.2, 7), draw(0.1, 1), draw(-1, 1)
    p, q, r = map(float, (k, b, w))
    formulas = [f"{b}*x + {k}*sin(y) + {w}", f"y + {b}*x + {k}*sin(y) + {w}"]

    def image(x):
        kicked = q * x[0] + p * math.sin(x[1]) + r
        return [kicked, x[1] + kicked]

    return Case("cylinder", ["--map", *formulas, "--period", "y=2*pi"], "", image, [0, TURN])


def _ball(draw):
    g, e, c = draw(0.05, 1.2), draw(0.05, 0.9), draw(-0.4, 0.4)
    gravity, rest, second = float(g), float(e), float(c)
    text = _file(
        ("phi", "v"),
        "phi",
        f'v = ["-1", "{4 if gravity < 0.3 else 2}"]',
        f"y'' = -{g}",
        (f"sin(phi) + {c}*sin(2*phi)", "v"),
        [
            (
                f"y - sin(phi + t) - {c}*sin(2*phi + 2*t)",
                "phi + t",
                f"(1 + {e})*(cos(phi + t) + 2*{c}*cos(2*phi + 2*t)) - {e}*y'",
                "",
            )
        ],
    )

    def table(phase):
        return math.sin(phase) + second * math.sin(2 * phase)

    def image(x):
        t, _, (_, speed) = _flown(
            (table(x[0]), x[1]), lambda t, y, v: -gravity, [lambda t, y: y - table(x[0] + t)]
        )
        moving = math.cos(x[0] + t) + 2 * second * math.cos(2 * (x[0] + t))
        return [x[0] + t, (1 + rest) * moving - rest * speed]

    return Case("ball", [], text, image, [TURN, 0])


def _wall(draw):
    d, w, e, m = draw(0.02, 0.5), draw(0.6, 3), draw(0.2, 0.95), draw(-0.5, 0.5)
    damping, forcing, rest, offset = map(float, (d, w, e, m))
    text = _file(
        ("a", "v"),
        "a",
        'v = ["-3", "0"]',
        f"x'' = -{d}*x' - x + cos(a + {w}*t)",
        (m, "v"),
        [(f"{m} - x", f"a + {w}*t", f"-{e}*x'", "")],
        "x",
    )

    def image(x):
        t, _, (_, speed) = _flown(
            (offset, x[1]),
            lambda t, y, v: math.cos(x[0] + forcing * t) - y - damping * v,
            [lambda t, y: offset - y],
        )
        return [x[0] + forcing * t, -rest * speed]

    return Case("wall", [], text, image, [TURN, 0])


def _walls(draw):
    d, f, e, w = draw(0.005, 0.4), draw(0.1, 1.5), draw(0.5, 0.98), draw(0.7, 2)
    damping, force, rest, forcing = map(float, (d, f, e, w))
    impact = (f"a + {w}*t", f"-{e}*x'")
    text = _file(
        ("a", "v"),
        "a",
        'v = ["-3", "-0.05"]',
        f"x'' = -{d}*x' + {f}*cos(a + {w}*t)",
        ("s/2", "v"),
        [("1/2 - x", *impact, 'at = { s = "1" }\n'), ("1/2 + x", *impact, 'at = { s = "-1" }\n')],
        "x",
    )

    def image(x):
        for side in (1, -1):
            t, hit, (_, speed) = _flown(
                (side / 2, x[1]),
                lambda t, y, v, a=x[0]: force * math.cos(a + forcing * t) - damping * v,
                [lambda t, y, side=side: side * y + 0.5, lambda t, y, side=side: 0.5 - side * y],
            )
            if hit:
                return [math.nan, math.nan]
            x = [x[0] + forcing * t, -rest * speed]
        return x

    return Case("two walls", [], text, image, [TURN, 0])


def _file(names, angle, region, equation, start, impacts, motion="y"):
    """Write a system's file."""
    lines = [
        f'variables = ["{names[0]}", "{names[1]}"]',
        'time = "t"',
        f'periods = {{ {angle} = "2*pi" }}',
    ]
    lines += [f"region = {{ {region} }}", f'[motion.{motion}]\nequation = "{equation}"']
    lines += [f'start = ["{start[0]}", "{start[1]}"]']
    for gap, phase, speed, more in impacts:
        lines.append(
            f'[[impact]]\n{more}gap = "{gap}"\n{names[0]} = "{phase}"\n{names[1]} = "{speed}"'
        )
    return "\n".join(lines) + "\n"


def _flown(start, force, gaps):
    """The first time at which a gap is 0, which one, and place and velocity there (Runge-Kutta)."""

    def step(t, y, v, h):
        a1 = force(t, y, v)
        v2 = v + h / 2 * a1
        a2 = force(t + h / 2, y + h / 2 * v, v2)
        v3 = v + h / 2 * a2
        a3 = force(t + h / 2, y + h / 2 * v2, v3)
        v4 = v + h * a3
        a4 = force(t + h, y + h * v3, v4)
        return y + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)

    (y, v), t = start, 0.0
    y, v, t = *step(0.0, y, v, 1e-5), 1e-5
    while t < LATEST:
        after = step(t, y, v, STEP)
        for k, gap in enumerate(gaps):
            if gap(t + STEP, after[0]) <= 0:
                low, high = 0.0, STEP
                for _ in range(50):
                    h = (low + high) / 2
                    low, high = (h, high) if gap(t + h, step(t, y, v, h)[0]) > 0 else (low, h)
                return t + high, k, step(t, y, v, high)
        (y, v), t = after, t + STEP
    return math.nan, 0, (math.nan, math.nan)


# -- what is proved, against simulation ------------------------------------------------------------


def answers(of: Case, folder: Path, *more: str) -> list[dict]:
    """Run the command, as a user would; return the claims of its machine form."""
    if of.file:
        (folder / "system.toml").write_text(of.file)
    where = [str(folder / "system.toml")] if of.file else of.arguments
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        status = main([*where, "--json", "-", "--quiet", *more])
    claims = json.loads(out.getvalue())["claims"]
    decided = all(claim["verdict"] == "VERIFIED" for claim in claims)
    if status != (0 if decided else 1):
        raise AssertionError(f"status {status}")
    return claims


def falsehoods(of: Case, claims: list[dict]) -> list[str]:
    """The sentences that simulation contradicts."""
    wrong = []
    for claim in claims:
        if claim["certificate"] is None:
            continue
        report = check(json.dumps(claim["certificate"]))
        if list(report.sentences) != claim["theorems"]:
            wrong.append("other sentences than the checker's")
        for each in report.conclusions[:: 1 + len(report.conclusions) // MOST]:
            holds = True
            if isinstance(each, PeriodicOrbit):
                holds = _is_orbit(of, each)
            elif isinstance(each, Entropy):
                holds = all(
                    _covers(of, cover.local, cover.orientation) for cover in each.graph.covers
                )
            wrong += [] if holds else [each.sentence]
    return wrong


def _iterated(of, x, count):
    for _ in range(count):
        x = of.image(x)
    return np.array(x)


def _jacobian(of, x, count, h=1e-6):
    units = h * np.eye(len(x))
    return np.array(
        [(_iterated(of, x + u, count) - _iterated(of, x - u, count)) / (2 * h) for u in units]
    ).T


def _apart(of, difference):
    periods = np.array(of.periods)
    return (
        difference
        - np.where(periods, np.round(difference / np.where(periods, periods, 1)), 0) * periods
    )


def _is_orbit(of, orbit):
    x = np.array([float(sum(side)) / 2 for side in orbit.box])
    n, turns = orbit.period, iter(orbit.turns)
    whole = np.array([next(turns) * period if period else 0 for period in of.periods])
    matrix = _jacobian(of, x, n)
    newton = np.linalg.solve(matrix - np.eye(len(x)), _iterated(of, x, n) - x - whole)
    if not np.abs(newton).max() < 1e-5:
        return False
    if any(np.abs(_apart(of, _iterated(of, x, k) - x)).max() < 1e-7 for k in range(1, n)):
        return False
    sizes = np.sort(np.abs(np.linalg.eigvals(matrix)))
    room = 1e-3
    return {
        "attracting": sizes[-1] < 1 + room,
        "repelling": sizes[0] > 1 - room,
        "a saddle": sizes[0] < 1 + room and sizes[-1] > 1 - room,
        None: True,
    }[orbit.stability]


def _covers(of, local, sign):
    """Whether points of a set are mapped as a covering relation says; at the faces, and inside."""
    (c, a), (d, b) = (
        (np.array(each.centre, float), np.array(each.matrix, float))
        for each in (local.source, local.target)
    )
    turns = iter(local.turns)
    whole = np.array([next(turns) * period if period else 0 for period in of.periods])
    side = np.linspace(-1, 1, 3)
    others = [[]] if len(c) == 1 else [[q] for q in side]
    for first in np.linspace(-1, 1, 5):
        for rest in others:
            image = _iterated(of, c + a @ np.array([first, *rest]), local.power) - whole
            q = np.linalg.solve(b, image - d)
            if abs(first) == 1 and not sign * first * q[0] > 1:
                return False
            if not (abs(q[0]) > 1 or (np.abs(q[1:]) < 1).all()):
                return False
    return True


# -- what simulation sees --------------------------------------------------------------------------


def seen_orbits(of: Case, period: int, starts: int, rng: Random) -> list[np.ndarray]:
    """Hyperbolic orbits of a least period that Newton's method on the simulation comes to."""
    sides, orbits = _sides(of), []
    for _ in range(starts):
        point = _newton(of, np.array([rng.uniform(*side) for side in sides]), period)
        if point is None or not _is_hyperbolic(of, point, period):
            continue
        points = np.array([_iterated(of, point, k) for k in range(period)])
        inside = all(p or low <= x <= high for (low, high), p, x in _each(sides, of, point))
        if inside and not any(_is_on(of, point, other) for other in orbits):
            orbits.append(points)
    return orbits


def _each(sides, of, point):
    return zip(sides, of.periods, point, strict=True)


def _sides(of):
    """Where the command looks for orbits."""
    head = tomllib.loads(of.file) if of.file else {"variables": ["x", "y"]}
    region = {k: tuple(map(float, v)) for k, v in head.get("region", {}).items()}
    names = zip(head["variables"], of.periods, strict=False)
    return [(0.0, period) if period else region.get(each, (-3.0, 3.0)) for each, period in names]


def _newton(of, x, period):
    for _ in range(10):
        try:
            change = _apart(of, _iterated(of, x, period) - x)
            x = x - (step := np.linalg.solve(_jacobian(of, x, period) - np.eye(len(x)), change))
        except (np.linalg.LinAlgError, OverflowError):
            return None
        if not np.abs(step).max() < 10:
            return None
        if np.abs(step).max() < 1e-7:
            return x
    return None


def _is_hyperbolic(of, x, period):
    """And of this least period."""
    if any(_is_on(of, x, _iterated(of, x, k)[None]) for k in range(1, period)):
        return False
    sizes = np.abs(np.linalg.eigvals(_jacobian(of, x, period)))
    return bool((np.abs(sizes - 1) > ROOM).all())


def _is_on(of, x, points):
    return any(np.abs(_apart(of, x - each)).max() < 1e-5 for each in points)


def has_theorem(of: Case, orbit: np.ndarray, claims: list[dict]) -> bool:
    """Whether a theorem is about an orbit that simulation sees."""
    proved = [
        np.array([float(sum(side)) / 2 for side in each.box])
        for claim in claims
        if claim["certificate"]
        for each in check(json.dumps(claim["certificate"])).conclusions
        if isinstance(each, PeriodicOrbit) and each.period == len(orbit)
    ]
    return any(_is_on(of, x, orbit) for x in proved)


def _told(seed: int, folder: Path, counts: Counter) -> float:
    """Run one case, count and print; return the time that it took."""
    of, begun = case(seed), time.process_time()
    claims = answers(of, folder, "--effort", "2")
    took, wrong = time.process_time() - begun, falsehoods(of, claims)
    counts["false"] += len(wrong)
    for claim in claims:
        counts[of.kind, claim["id"], claim["verdict"]] += 1
        counts[of.kind, claim["id"], "theorems"] += len(claim["theorems"])
    for period in (1, 2):
        for orbit in seen_orbits(of, period, 12, Random(seed)):
            counts[of.kind, f"seen, period {period}"] += 1
            counts[of.kind, f"with a theorem, period {period}"] += has_theorem(of, orbit, claims)
    print(seed, of.kind, round(took, 1), wrong, flush=True)
    return took


if __name__ == "__main__":
    first, last = (
        (int(sys.argv[1]), int(sys.argv[2])) if len(sys.argv) > 2 else (0, int(sys.argv[1]))
    )
    totals = Counter()
    with TemporaryDirectory() as where:
        times = [_told(seed, Path(where), totals) for seed in range(first, last)]
    for key, count in sorted(totals.items(), key=str):
        print(key, count)
    print("CPU s: mean", sum(times) / len(times), "most", max(times))

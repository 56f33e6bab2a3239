"""Points where the binary64 kernels are most likely to fail, and true values from Arb."""

import math

import flint
import numpy as np

from tests.intervals.oracle import FUNCTIONS

MAX = math.nextafter(math.inf, 0.0)
ETA = 2.0**-1074
BITS = 160
LN2, LN10 = math.log(2), math.log(10)


# ends of the domain that the tests use: beyond them the value is beyond binary64
DOMAIN = {
    **dict.fromkeys(("cbrt", "atan", "tanh", "asinh"), (-MAX, MAX)),
    **dict.fromkeys(("log", "log2", "log10"), (ETA, MAX)),
    **dict.fromkeys(("asin", "acos"), (-1.0, 1.0)),
    **dict.fromkeys(("sin", "cos", "tan"), (-1024.0, 1024.0)),
    "exp": (-740.0, 709.7),
    "exp2": (-1070.0, 1023.9),
    "exp10": (-320.0, 308.2),
    "expm1": (-800.0, 709.7),
    "log1p": (math.nextafter(-1.0, 0.0), MAX),
    "sinh": (-710.4, 710.4),
    "cosh": (0.0, 710.4),
    "acosh": (1.0, MAX),
    "atanh": (math.nextafter(-1.0, 0.0), math.nextafter(1.0, 0.0)),
}

# where the reductions of the kernels break: half-integers times this
STEPS = {
    **dict.fromkeys(("exp", "expm1", "sinh", "cosh"), LN2),
    **dict.fromkeys(("atan", "asin", "acos"), 1 / 16),
    **dict.fromkeys(("sin", "cos", "tan"), math.pi / 2),
    "exp2": 1.0,
    "exp10": LN2 / LN10,
    "tanh": LN2 / 2,
}


def near(x, rng):
    """Move numbers by a few of their own ulps, most of them, or by a relative 2^-30 .. 1/64."""
    x = np.clip(x, -MAX / 2, MAX / 2)
    few = x + rng.integers(-3, 4, x.shape) * np.spacing(x)
    some = x * (1 + rng.choice([-1, 1], x.shape) * 2.0 ** rng.uniform(-50, -6, x.shape))
    return np.where(rng.random(x.shape) < 0.5, few, some)


def breakpoints(name, count, rng):
    """Numbers at the breaks of the reduction, or at 1, sqrt 2, their multiples by 2^k."""
    if name in STEPS:
        reach = {"sin": 652, "cos": 652, "tan": 652, "exp10": 900}.get(name, 1000)
        reach = rng.choice([2, 4, 30, reach], count)
        return STEPS[name] * 0.5 * np.rint(rng.uniform(-2, 2, count) * reach)
    k = rng.integers(-3, 4, count) * rng.choice([1, 1, 100], count)
    x = rng.choice([1.0, math.sqrt(2), math.sqrt(3)], count) * 2.0**k
    if name == "log1p":
        x = x - 1
    return x * rng.choice([-1, 1], count)


def points(name, count, seed, inside=None):
    """Return binary64 numbers in the domain, or in `inside`, that crowd the dangerous places."""
    rng = np.random.default_rng(seed)
    low, high = inside or DOMAIN[name]
    part = count // 8 + 1
    spread = rng.uniform(max(low, -1000.0), min(high, 1000.0), part)
    central = rng.uniform(max(low, -1.0), min(high, 1.0 if low < 1 else 2.0), part)
    sizes = 2.0 ** rng.uniform(-60, 12, part) * rng.choice([-1, 1], part)
    extreme = 2.0 ** rng.uniform(-1074, 1023.9, part // 2) * rng.choice([-1, 1], part // 2)
    special = np.array(
        [0.0, ETA, 2.0**-1022, 2.0**-400, 2.0**-27, 2.0**-53, 0.5, 1.0, 2.0, 2.0**400, MAX]
    )
    special = rng.choice(np.concatenate([special, -special]), part // 2)
    ends = rng.choice([low, high], part)
    near_one = 1 + rng.choice([-1, 1], part) * 2.0 ** rng.uniform(-53, -1, part)
    broken = near(breakpoints(name, part, rng), rng)
    crowded = near(special, rng), near(ends, rng), near_one, broken, ends
    x = np.concatenate((spread, central, sizes, extreme, *crowded))
    x = np.where(np.isfinite(x), x, 0.0)
    x = np.concatenate([x, near(breakpoints(name, count, rng), rng)])
    x = np.where((x < low) | (x > high), rng.uniform(max(low, -50.0), min(high, 50.0), x.shape), x)
    return rng.permutation(x)[:count]


def true_at(name, point):
    """The ball of f at binary64 numbers, at the precision of the context."""
    return FUNCTIONS["pow" if name == "power" else name](*map(flint.arb, point))


def distances(name, arguments, bounds):
    """How far bounds (-lower, upper) are from f(arguments), in ulps; they must contain it."""
    columns = [column.tolist() for column in (*arguments, -bounds[0], bounds[1])]
    result = []
    with flint.ctx.workprec(BITS):
        for *point, low, high in zip(*columns, strict=True):
            y = true_at(name, point)
            # where f(x) is binary64 itself Arb's ball may reach beyond the bounds
            assert y.is_finite()
            assert not y < low, (name, [p.hex() for p in point], low)
            assert not y > high, (name, [p.hex() for p in point], high)
            reach = max(float((y - low).upper()), float((high - y).upper()))
            result.append(reach / math.ulp(max(abs(low), abs(high))))
    return np.array(result)


def rows(lower, upper=None):
    upper = lower if upper is None else upper
    return np.stack((-lower, upper))


def plane(count, seed):
    """Points of the plane, near the axes, the diagonals, the breaks j/16, of all moderate sizes."""
    rng = np.random.default_rng(seed)
    x = rng.choice([-1, 1], count) * 2.0 ** rng.uniform(-30, 30, count)
    slope = rng.choice(
        [0.0, 2.0**-300, 2.0**-53, 2.0**-30, 1 / 32, 3 / 32, 5 / 32, 0.5, 31 / 32, 1.0], count
    )
    slope = slope * (1 + rng.integers(-3, 4, count) * 2.0 ** rng.integers(-53, -1, count))
    slope = np.where(rng.random(count) < 0.4, rng.uniform(0, 1, count), slope)
    y = x * slope * rng.choice([-1, 1], count)
    swap = rng.random(count) < 0.5
    return np.where(swap, y, x), np.where(swap, x, y)


def bases_and_exponents(count, seed):
    rng = np.random.default_rng(seed)
    x = 2.0 ** (rng.uniform(-1, 1, count) * rng.choice([1.0, 10.0, 900.0], count))
    near_one = 1 + rng.choice([-1, 1], count) * 2.0 ** rng.uniform(-53, -1, count)
    breaks = (
        (rng.integers(90, 184, count) + 0.5) / 128 * (1 + rng.integers(-3, 4, count) * 2.0**-52)
    )
    x = np.choose(rng.integers(0, 3, count), [x, near_one, breaks])
    largest = 600 / np.maximum(np.abs(np.log(x)), 2.0**-53)
    y = rng.choice([-1, 1], count) * largest * rng.choice([1.0, 0.5, 0.01, 2.0**-60], count)
    y = y * rng.uniform(0.9, 1, count)
    small = np.where(np.abs(np.log(x)) < 100, rng.integers(-5, 6, count) / 2, y)
    return x, np.where(rng.random(count) < 0.2, small, y)


def plane_points(name, count, seed):
    """Return the arguments of a function of two variables, within the proved range."""
    if name == "power":
        return bases_and_exponents(count, seed)
    return plane(count, seed)

"""Foreign states of the floating-point unit, each provoked in a process of its own.

A library that somebody imports may leave the thread in another rounding mode, or let it flush
subnormal numbers to zero. Every public operation then encloses the truth, or refuses.
"""

import json
import platform
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.skipif(
    platform.machine() != "x86_64" or platform.system() != "Linux", reason="needs glibc on x86-64"
)

STATES = {
    "nearest": ("rounding", 0x000),
    "downward": ("rounding", 0x400),
    "upward": ("rounding", 0x800),
    "toward zero": ("rounding", 0xC00),
    "flush to zero": ("flush", 0x8000),
    "denormals are zero": ("flush", 0x0040),
    "both flushes": ("flush", 0x8040),
}
ANY_MODE = [
    "from_exact",
    "from_floats",
    "x + y",
    "x - y",
    "x * y",
    "x / y",
    "s + s",
    "s * s",
    "s - s",
    "x * s",
    "3 * s",
    "abs s",
    "x ** 3",
    "sum",
    "prod",
    "matmul",
    "hull",
    "intersection",
    "sign",
    "minimum",
    "floor",
    "round",
    "sqrt",
    "subset",
    "positive",
]
MULTIPRECISION = ["interval", "interval third", "interval exp"]  # on integers


def run(state):
    kind, word = STATES[state]
    command = [sys.executable, "-m", "tests.intervals.foreign_states", kind, hex(word)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=60, check=True)
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def undisturbed():
    return run("nearest")


def encloses(outer, inner):
    """Whether each interval overlaps its undisturbed twin, and by all but a few ulps of it."""
    for a, b, c, d in zip(*outer, *inner, strict=True):
        low, high, true_low, true_high = map(Fraction, (a, b, c, d))
        slack = (abs(true_low) + abs(true_high)) * Fraction(1, 2**47) + Fraction(1, 2**1071)
        if not (low <= true_high and true_low <= high):
            return False
        if abs(low - true_low) > slack or abs(high - true_high) > slack:
            return False
    return True


def test_undisturbed_results_are_results(undisturbed):
    assert not [name for name, value in undisturbed.items() if isinstance(value, str)]
    assert set(ANY_MODE + MULTIPRECISION) < set(undisturbed)
    assert undisturbed["positive"] == [True, False, True]
    assert undisturbed["subset"] == [False, False, False]


@pytest.mark.parametrize(
    "mode",
    [
        "upward",
        pytest.param("downward", marks=pytest.mark.slow),
        pytest.param("toward zero", marks=pytest.mark.slow),
    ],
)
def test_rounding_modes(mode, undisturbed):
    found = run(mode)
    for name, value in found.items():
        if name in ("subset", "positive"):
            assert value == undisturbed[name]
        elif name in ANY_MODE + MULTIPRECISION:
            assert encloses(value, undisturbed[name]), name
        else:
            assert value == "this thread does not round to nearest", name


@pytest.mark.parametrize(
    "state",
    [
        "flush to zero",
        pytest.param("denormals are zero", marks=pytest.mark.slow),
        pytest.param("both flushes", marks=pytest.mark.slow),
    ],
)
def test_flushing_is_refused(state, undisturbed):
    found = run(state)
    for name, value in found.items():
        if name in MULTIPRECISION:
            assert value == undisturbed[name], name
        else:
            assert value == "subnormal numbers are flushed to zero in this thread", name

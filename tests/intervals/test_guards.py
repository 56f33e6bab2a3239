"""Foreign states of the floating-point unit, each provoked in a process of its own.

A library that somebody imports may leave the thread in another rounding mode, or let it flush
subnormal numbers to zero. Every public operation then encloses the truth, or refuses.
"""

import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from tests.intervals.foreign_states import (
    ANY_MODE,
    MULTIPRECISION,
    OPERATIONS,
    RELATIONS,
    STATES,
    x86_linux,
)

ROOT = Path(__file__).parents[2]
FLUSHED = "subnormal numbers are flushed to zero in this thread"
NOT_NEAREST = "this thread does not round to nearest"

pytestmark = x86_linux


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
    assert set(OPERATIONS) == set(undisturbed)
    assert undisturbed["positive"] == [True, False, True]
    assert undisturbed["subset"] == [False, False, False]


def slow(*names):
    return [pytest.param(name, marks=pytest.mark.slow) for name in names]


@pytest.mark.parametrize("mode", ["upward", *slow("downward", "toward zero")])
def test_rounding_modes(mode, undisturbed):
    for name, value in run(mode).items():
        if name in RELATIONS:
            assert value == undisturbed[name]
        elif name in ANY_MODE | MULTIPRECISION:
            assert encloses(value, undisturbed[name]), name
        else:
            assert value == NOT_NEAREST, name


@pytest.mark.parametrize("state", ["flush to zero", *slow("denormals are zero", "both flushes")])
def test_flushing_is_refused(state, undisturbed):
    for name, value in run(state).items():
        assert value == (undisturbed[name] if name in MULTIPRECISION else FLUSHED), name

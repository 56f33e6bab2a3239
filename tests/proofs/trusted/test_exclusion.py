"""The forms whose signs exclude impacts, against the gap as printed."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf

from proofs.motion.kernel import _forms
from proofs.motion.system import System

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
OTHER = System(Fraction("0.31"), Fraction("0.4"))
GRID = np.array([0.0, 0.7, 2.0, 2.5, 5.1, 5.125, 9.0])


def true_gap(system, launch, time, order):
    """x - z, or its second derivative, as printed, from a table at height 1 + lift."""
    eta, (lift, rate) = mpf(system.eta.numerator) / system.eta.denominator, map(mpf, launch)
    spring, table = eta**order, (-1) ** (order // 2)
    mass = (1 + lift) * mp.cos(eta * time) + rate / eta * mp.sin(eta * time)
    moved = (1 if order == 0 else 0) + table * (lift * mp.cos(time) + rate * mp.sin(time))
    return (-1 if system.nu < 0 else 1) * (table * spring * mass - moved)


def lower(forms, launch):
    """The least value of each form at a launch, to some rounding."""
    lift, rate = (Fraction(x) for x in launch)
    total = forms[0] * lift + forms[1] * rate + forms[2]
    return total.inf


@pytest.mark.parametrize("system", [PAPER, OTHER])
@pytest.mark.parametrize("launch", [(-0.19, 0.05), (0.1, 0.3), (0.0, -0.1)])
def test_the_forms_are_below_what_must_be_positive(system, launch):
    forms = _forms(system, GRID)
    count = len(GRID) - 1
    assert forms.shape == (3, 3 * count - 1)
    bound = lower(forms, launch)
    first, heights = bound[0], bound[1 : count + 1]
    after, before = np.split(bound[count + 1 :], 2)
    with mp.workdps(40):
        gaps = [true_gap(system, launch, mpf(t), 0) for t in GRID]
        for j in range(1, count + 1):
            assert gaps[j] - mpf(10) ** -12 < heights[j - 1] <= gaps[j]
        for j, (begin, end) in enumerate(pairwise(GRID)):
            drops = []
            for share in range(9):
                time = mpf(begin) + (mpf(end) - mpf(begin)) * share / 8
                bend = true_gap(system, launch, time, 2)
                drops.append((mpf(end) - mpf(begin)) ** 2 / 8 * bend)
            if j == 0:
                assert first <= min(drops)
                continue
            assert after[j - 1] <= gaps[j + 1] - max(drops)
            assert before[j - 1] <= gaps[j] - max(drops)
            assert after[j - 1] > gaps[j + 1] - max(drops) - (end - begin) ** 3


def test_forms_of_one_time_have_no_chord():
    assert _forms(PAPER, GRID[:2]).shape == (3, 2)


def test_a_gap_that_is_no_form_is_refused(monkeypatch):
    monkeypatch.setattr(
        "proofs.motion.kernel.gap", lambda start, now, order: start.lift * start.lift
    )
    with pytest.raises(ValueError, match="not a form"):
        _forms(System(Fraction("0.123"), Fraction("0.4")), GRID)

"""Flights as data for Coq: the enclosures by which they are cut, and data that is not right."""

import re
from fractions import Fraction
from functools import partial

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.formal.flights import Flown, graph, march
from proofs.formal.hints import Hints, NoHint
from proofs.formal.plan import plan
from proofs.formal.written import Writer
from tests.proofs.formal.coq import PAPER, asking, computed, needs_coqc, one

ETA, NU = Fraction("0.2121"), Fraction("-0.2")
UNIT = 1000


def height(eta, nu, phi, t, eps, gamma):
    """The gap after an impact, typed from the paper."""
    launch = (1 + nu * mpmath.sin(phi)) * mpmath.cos(eta * t)
    kick = eps * gamma + nu / eta * (1 + eps) * mpmath.cos(phi)
    launch += kick * mpmath.sin(eta * t)
    return mpmath.sign(nu) * (launch - 1 - nu * mpmath.sin(phi + t))


@given(
    st.sampled_from([("0.2121", "-0.2"), ("0.7", "0.4"), ("1.3", "-0.9")]),
    st.floats(0, 6.28),
    st.floats(0, 0.05),
    st.floats(0.1, 60),
    st.floats(0, 0.5),
    st.sampled_from([0, 1, 2]),
    st.tuples(st.floats(0, 0.9), st.floats(-1, 1), st.floats(0, 0.5)),
    st.randoms(use_true_random=False),
)
def test_the_enclosures_by_which_flights_are_cut(numbers, m, r, t, aside, order, impact, rng):
    eta, nu = map(float, numbers)
    eps, g, s = impact
    side = 1 if nu > 0 else -1
    low, high = Flown(side, eta, nu, m, r, *impact).height(t, order, aside)
    with mpmath.workdps(40):
        for _ in range(4):
            phi, time = m + rng.choice([-r, r, 0]), t + rng.choice([-aside, aside, 0])
            gamma = g + rng.choice([-s, s, 0])
            at = partial(height, *map(mpmath.mpf, numbers), phi, eps=eps, gamma=gamma)
            exact = mpmath.diff(at, time, order)
            assert low - 1e-9 <= exact <= high + 1e-9


def test_steps_go_to_the_end_and_each_is_tested():
    seen = []

    def test(start, step):
        seen.append((start, step))
        return step < 0.3 and (start < 2 or step < 0.02)

    runs = march(test, 0, 2100, UNIT)
    assert sum(step * count for step, count in runs) == 2100
    assert all(step < 300 for step, _ in runs)
    with pytest.raises(NoHint, match="no step is found"):
        march(lambda start, step: start < 1, 0, 2000, UNIT)


@pytest.fixture(scope="module")
def lines():
    """The definitions of the graph of the paper's horseshoe."""
    asked = plan(PAPER.read_text())
    horseshoe = next(each for each in asked.sets if each.is_horseshoe)
    writer = Writer()
    graph(writer, Hints(ETA, NU), 1, horseshoe)
    text = "".join(writer.lines)
    check = re.search(r"Lemma checked1 : (check_flights .*?) = true", text, re.DOTALL)[1]
    return text[: text.index("Lemma checked1")], " ".join(check.split())


def test_the_theorem_that_is_stated(lines):
    definitions, check = lines
    assert (
        "cells1 : list (R * R) := [((11 / 10), (23 / 20)); ((127 / 100), (33 / 25))]" in definitions
    )
    assert "arrows1 : list (nat * nat) := [(0, 0); (0, 1); (1, 0); (1, 1)]" in definitions
    assert "(Laps 4 true" in definitions and "(Laps 9 true" in definitions
    assert "(Some (364, 100)%positive)" in check or "(Some (91, 25)%positive)" in check


FIRST_CUT = r"\(Cut \((\d+)\) \((\d+)\) \[(.*?)\] \[(.*?)\] \[(.*?)\]\)"


def again(runs):
    """Runs of steps with the last step three times more: once need not be beyond the impact."""
    return re.sub(r"(\d+)%nat\)$", lambda count: f"{int(count[1]) + 3}%nat)", runs)


LIES = {
    "a turn more": one(r"Laps 4", "Laps 5"),
    "f decreases": one(r"Laps 4 true", "Laps 4 false"),
    "too steep": asking(r"Some \(\d+, \d+\)", "Some (7, 1)"),
    "another eta": asking(r"569351602176", "579351602176"),
    "another nu": asking(r"\(-536870912000\)", "(-336870912000)"),
    "another side": asking(r"\(-1\)", "(1)"),
    "an interval that begins earlier": one(
        r"numerators1 := \[\(\d+", "numerators1 := [(2900000000000"
    ),
    "an interval that ends too late": one(r"(numerators1.*, )\d+\)\]", r"\g<1>3900000000000)]"),
    "intervals that meet": one(r"(numerators1 := \[\(\d+, )\d+", r"\g<1>3409130291200"),
    "an arrow to nowhere": one(r"\(1, 1\)\]%nat", "(1, 2)]%nat"),
    "a piece left out": one(FIRST_CUT + r";", ""),
    "no fall": one(FIRST_CUT, r"(Cut (\1) (\2) [\3] [\4] [])"),
    "no flight": one(FIRST_CUT, r"(Cut (\1) (\2) [\3] [] [\5])"),
    "a flight beyond the impact": one(
        FIRST_CUT, lambda m: f"(Cut ({m[1]}) ({m[2]}) [{m[3]}] [{again(m[4])}] [{m[5]}])"
    ),
    "a launch for too long": one(
        FIRST_CUT, lambda m: f"(Cut ({m[1]}) ({m[2]}) [{m[3]}; {m[4]}] [{m[4]}] [{m[5]}])"
    ),
    "a step backwards": one(
        FIRST_CUT, lambda m: f"(Cut ({m[1]}) ({m[2]}) [{m[3]}; ((-1)%Z, 1%nat)] [{m[4]}] [{m[5]}])"
    ),
}


@needs_coqc
@pytest.mark.long
def test_data_that_is_not_right_is_refused(lines, tmp_path):
    """All in one file: the true data first, then each lie."""
    parts = [lines, *(lie(*lines) for lie in LIES.values())]
    said = computed(tmp_path, "Numbers March Flights Graph Cells", parts)
    assert dict(zip(["true data", *LIES], said, strict=True)) == {
        "true data": "true",
        **dict.fromkeys(LIES, "false"),
    }

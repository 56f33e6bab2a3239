"""Flights as data for Coq: the enclosures by which they are cut, and data that is not right."""

import math
import random
import re
from fractions import Fraction
from functools import partial
from itertools import product

import mpmath
import numpy as np
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


def image(eta, nu, phi):
    """The phase of the next impact, not reduced, from samples of the gap; None if none is seen."""
    times = np.arange(0.02, 70, 0.01)
    gaps = np.sign(nu) * (
        (1 + nu * math.sin(phi)) * np.cos(eta * times)
        + nu / eta * math.cos(phi) * np.sin(eta * times)
        - 1
        - nu * np.sin(phi + times)
    )
    below = np.flatnonzero(gaps <= 0)
    return None if len(below) == 0 or below[0] == 0 else phi + times[below[0]]


def is_false(side, eta, nu, slope, cells, arrows):
    """Whether a claim fails, by a margin: a sign, an order, an arrow, a covering or a slope."""
    ordered = [end for cell in cells for end in cell]
    if side * nu < 0 or ordered != sorted(set(ordered)):
        return True
    for i, j in arrows:
        if max(i, j) >= len(cells):
            return True
        ends = [image(eta, nu, end) for end in cells[i]]
        if None in ends:
            return True
        low, high = sorted(ends)
        turns = round((low + high) / 2 / math.tau - sum(cells[j]) / 2 / math.tau)
        target = [end + turns * math.tau for end in cells[j]]
        if low > target[0] + 0.03 or high < target[1] - 0.03:
            return True
        if (high - low) / (cells[i][1] - cells[i][0]) < slope - 0.3:
            return True
    return False


TRUE = (-1, 2121, -2000, 364, (110, 115, 127, 132))  # eta, nu in 1/10000, f' and ends in 1/100
MOVES = range(-9, 10)


def claims(count, seed):
    """Yield false claims: one or two of the parameters, signs, sets and arrows are others."""
    rng = random.Random(seed)
    while count:
        side, eta, nu, slope, ends = TRUE
        arrows, alphabet = sorted(product(range(2), repeat=2)), 2
        for kind in rng.sample(["side", "eta", "nu", "sign", "slope", "ends", "alphabet"], 2):
            side = -side if kind == "side" else side
            eta += rng.randint(-900, 900) if kind == "eta" else 0
            nu = -nu if kind == "sign" else nu + (rng.randint(-900, 900) if kind == "nu" else 0)
            slope = rng.randint(420, 900) if kind == "slope" else slope
            if kind == "ends":
                ends = [end + (rng.choice(MOVES) if rng.random() < 0.5 else 0) for end in ends]
            alphabet += rng.randint(1, 3) if kind == "alphabet" else 0
        arrows += [(1, alphabet - 1)] if alphabet > 2 else []
        cells = [(ends[0] / 100, ends[1] / 100), (ends[2] / 100, ends[3] / 100)]
        if nu and is_false(side, eta / 1e4, nu / 1e4, slope / 100, cells, arrows):
            count -= 1
            yield side, eta, nu, slope, ends, arrows


def claimed(lines, side, eta, nu, slope, ends, arrows):
    """The definitions and the check of a claim: what is claimed is changed, flights are not."""
    definitions, check = lines
    unit = int(re.match(r"check_flights \d+ (\d+)", check)[1])
    a, b, c, d = (end * unit // 100 for end in ends)
    numbers = f"{side if side > 0 else f'({side})'} {eta * unit // 10000} ({nu * unit // 10000})"
    check = re.sub(r"(check_flights \d+ \d+) \(-1\) \d+ \(-\d+\)", rf"\1 {numbers}", check)
    check = re.sub(r"Some \(\d+, \d+\)", f"Some ({slope}, 100)", check)
    definitions = re.sub(
        r"numerators1 := .*", f"numerators1 := [({a}, {b}); ({c}, {d})]%Z.", definitions
    )
    text = "; ".join(map(str, arrows))
    return re.sub(r"(arrows1 : .* := ).*", rf"\1[{text}]%nat.", definitions), check


def test_an_edit_that_changes_nothing_leaves_the_claim_as_it_is(lines):
    side, eta, nu, slope, _ = TRUE
    arrows = sorted(product(range(2), repeat=2))
    cells = [(1.10, 1.15), (1.27, 1.32)]
    assert not is_false(side, eta / 1e4, nu / 1e4, slope / 100, cells, arrows)
    definitions, check = claimed(lines, *TRUE, arrows)
    assert definitions == lines[0] and check.replace("(364, 100)", "(91, 25)") in (
        lines[1],
        lines[1].replace("(364, 100)", "(91, 25)"),
    )


@needs_coqc
@pytest.mark.slow
@pytest.mark.parametrize("count", [12, pytest.param(200, marks=pytest.mark.long)])
def test_no_false_claim_about_the_impact_map_is_accepted(lines, tmp_path, count):
    parts = [claimed(lines, *claim) for claim in claims(count, seed=9)]
    assert len({check + definitions for definitions, check in parts}) > count * 0.9
    assert computed(tmp_path, "Numbers March Flights Graph Cells", parts) == ["false"] * count


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

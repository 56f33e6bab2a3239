"""Initial value problems, beside solutions in closed form; blow-up, and what is no question."""

import math
from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intervals import Undecided
from proofs import System
from proofs.commands.system import main
from proofs.report.figures.portrait import drawn_tube
from proofs.trusted.verify import check


def system(equation, *start, section="x - 100", **more):
    file = {"variables": ["a"], "time": "t", "flow": "validated"}
    motion = {"x": {"equation": equation, "start": list(start)}}
    end = {"section": section, "direction": "+", "a": "x"}
    return System({**file, "motion": motion, "end": end, **more})


SQUARE = system("x' = x^2", "a")  # 1/(1/a - t)
TURN = system("x'' = -x", "a", "0")  # a cos t, -a sin t
ROOT = system("x' = -1/(2*x)", "a")  # sqrt(a^2 - t)


def test_states_at_times():
    theorem = SQUARE.flow("1/2", "0.9", a="1")
    assert check(theorem.certificate).sentences == tuple(each.sentence for each in theorem)
    for each, exact in zip(theorem, (2, 10), strict=True):
        ((low, high),) = each.bounds
        assert low <= exact <= high < low + Fraction(1, 10**12)
    assert "at `t = 1/2`" in theorem[0].sentence or "at `t = 0.5`" in theorem[0].sentence
    (whole,) = TURN.flow(t="1", a=("0.9", "1.1"))
    for part in (0.9, 1, 1.1):
        for (low, high), value in zip(whole.bounds, (math.cos(1), -math.sin(1)), strict=True):
            assert low - 1e-9 <= part * value <= high + 1e-9


@given(st.fractions(0, 8))
def test_a_tube_is_around_the_solution(time):
    tube = turn()
    for (low, high), value in zip(tube.at(time), (math.cos(time), -math.sin(time)), strict=True):
        assert low - 1e-12 <= value <= high + 1e-12 and high - low < 1e-12
    low, high = tube.at(time / 2, time)[0]
    assert low <= min(math.cos(time), math.cos(time / 2)) + 1e-12
    assert high >= max(math.cos(time), math.cos(time / 2)) - 1e-12


@cache
def turn():
    """The solution 8 long, made once."""
    return TURN.tube(8, a="1")


def test_pieces_of_a_tube_follow_each_other():
    pieces = turn().pieces()
    assert pieces[0].time[0] == 0 and pieces[-1].time[1] == 8 == turn().until
    assert all(one.time[1] == two.time[0] for one, two in pairwise(pieces))
    assert (
        not turn().reason
        and drawn_tube(turn()).count("<path") > 2
        and max(b - a for each in pieces for a, b in each.box) < 1
    )
    for times in ((-1,), (9,), (3, 2), (1, 9)):
        with pytest.raises(ValueError, match="are those of the tube"):
            turn().at(*map(Fraction, times))


@pytest.mark.parametrize(("own", "end"), [(SQUARE, 1), (ROOT, 1)], ids=["blow-up", "undefined"])
def test_where_solutions_end(own, end):
    with pytest.raises(Undecided, match=r"may end.* followed up to the time 0\.9"):
        own.flow(2, a="1")
    tube = own.tube(2, a="1")
    assert 0.99 < tube.until < end and "the solutions go on" in tube.reason
    assert own.tube("0.9", a="1").reason == ""


def test_not_defined_at_first():
    tube = ROOT.tube(1, a=("-1", "1"))
    assert tube.until == 0 and "up to the time 0," in tube.reason and tube.pieces() == []


WRONG = [
    (lambda: SQUARE.flow(a="1"), "a time is expected: t=..."),
    (lambda: SQUARE.flow(("1", "2"), a="1"), "one number"),
    (lambda: SQUARE.flow(0, a="1"), "a time t > 0"),
    (lambda: SQUARE.flow(1, b="1"), "a value for each variable"),
    (lambda: System.example("wall").flow(1, a="0", v="-1"), 'give flow = "validated"'),
]


@pytest.mark.parametrize(("ask", "message"), WRONG, ids=[x[1] for x in WRONG])
def test_what_is_no_question(ask, message):
    with pytest.raises(ValueError) as caught:
        ask()
    assert message in str(caught.value)


@pytest.mark.slow
def test_the_command_takes_it(capsys):
    assert main(["--example", "roessler", "--ask", "flow:t=1,p=-8.4,q=0.03"]) == 0
    assert "its values are `x` in [7.7565107555" in capsys.readouterr().out

"""Subdivision: what is yielded abuts and covers, and an incomplete cover is an error."""

import itertools
from fractions import Fraction

import pytest
from hypothesis import example
from hypothesis import strategies as st

from intervals import Undecided
from intervals.cover import cover
from tests.intervals.boxes import for_all


def halves(part):
    low, high = part
    middle = (low + high) / 2
    return (low, middle), (middle, high)


def thirds(part):
    low, high = part
    step = (high - low) / 3
    return ((low + k * step, low + (k + 1) * step) for k in range(3))


class Decide:
    """Answer a part that is short, or shorter than its distance from a point; count the calls."""

    def __init__(self, point, width):
        self.point, self.width, self.calls = point, width, 0

    def __call__(self, part):
        self.calls += 1
        low, high = part
        distance = max(low - self.point, self.point - high, Fraction(0))
        return high - low if high - low <= max(self.width, distance) else None


points = st.fractions(-1, 4, max_denominator=1000)
cuts = st.lists(st.fractions(0, 3, max_denominator=50), min_size=2, max_size=5, unique=True).map(
    sorted
)


def pieces(ends):
    return list(itertools.pairwise(ends))


def check_cover(found, ends):
    assert found[0][0][0] == ends[0]
    assert found[-1][0][1] == ends[-1]
    for (part, answer), (after, _) in itertools.pairwise(found):
        assert part[1] == after[0]
        assert answer == part[1] - part[0] > 0


@for_all(cuts, points, st.integers(0, 6), st.sampled_from([halves, thirds]))
@example([Fraction(0), Fraction(1)], Fraction(1, 3), 6, halves)
def test_the_parts_abut_and_cover(ends, point, depth, split):
    decide = Decide(point, Fraction(3, 2**depth))
    found = list(cover(pieces(ends), decide, split))
    check_cover(found, ends)
    assert all(answer == Decide(point, decide.width)(part) for part, answer in found)


WHOLE = (Fraction(0), Fraction(1))


@pytest.mark.parametrize(
    ("answer", "limit", "message"),
    [
        *((answer, 1, None) for answer in (True, False, 0, "")),
        (True, 0, "0 parts"),
        (None, 1, "1 parts"),
        (None, 2, r"2 parts.*Fraction\(1, 4\)"),
        (None, 100, "100 parts"),
    ],
)
def test_the_limit_and_what_is_an_answer(answer, limit, message):
    found = cover([WHOLE], lambda part: answer, halves, limit=limit)
    if message is None:
        assert list(found) == [(WHOLE, answer)]
    else:
        with pytest.raises(Undecided, match=message):
            list(found)


def test_the_answers_before_the_error_are_yielded():
    parts = cover([(0, 1), (1, 2)], lambda part: part if part[0] == 0 else None, halves, limit=2)
    assert next(parts) == ((0, 1), (0, 1))
    with pytest.raises(Undecided):
        next(parts)


def test_a_split_into_nothing_is_refused():
    with pytest.raises(ValueError, match="split"):
        list(cover([(0, 1)], lambda part: None, lambda part: [], limit=10))

"""What excludes, brackets and falls: on gaps that are known in closed form."""

from fractions import Fraction as F

import pytest

from proofs.trusted.flights import lifted
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.gaps import brackets, fall, falls, first_windows, open_windows, stays_up

BITS = 64
TURN = F("6.283185307179586476925286766559005768394338798750211641949889")


def cosine(time, order):
    """cos t, its derivatives; the first zero is pi/2."""
    sin, cos = Enclosure.of(*time, BITS).sincos()
    return (cos, -sin, -cos, sin)[order % 4]


def spread(time, order):
    """cos t + u for all |u| <= 1/5, and its derivatives."""
    value = cosine(time, order)
    return value if order else value + Enclosure.of(F("-0.2"), F("0.2"), BITS)


def parabola(time, order):
    """t (1 - t)."""
    t = Enclosure.of(*time, BITS)
    one = Enclosure.of(F(1), F(1), BITS)
    return (t * (one - t), one - 2 * t, -2 * one)[order]


def test_a_chord_bounds_from_below_less_the_bend():
    """cos on [2 pi - 1, 2 pi + 1]: ends cos 1 = 0.54; on [pi - 1/2, pi + 1/2] sup cos'' = 1."""
    unit, bent = 2**BITS, (F("2.6"), F("3.6"))
    assert stays_up(cosine, (F(-1), F(1)), F("0.54") * unit)  # cos'' < 0 there: the chord is below
    assert not stays_up(cosine, (F(-1), F(1)), 0)
    assert not stays_up(cosine, bent, F("0.12") * unit)  # 1/8 < 0.12 is needed
    assert stays_up(cosine, bent, F("0.13") * unit)


def test_a_bend_on_a_longer_interval_may_do():
    """cos'' <= 1 at all times; on [-1, 1] it is below -0.54."""
    unit, around = 2**BITS, (F(-1), F(1))
    ever = cosine((F(-1), F(7)), 2)
    assert ever.hi == unit
    assert stays_up(lambda time, order: pytest.fail("not needed"), around, F("0.51") * unit, ever)
    assert stays_up(cosine, around, F("0.49") * unit, ever)  # its own bend is looked at
    assert not stays_up(cosine, (F("2.6"), F("3.6")), F("0.12") * unit, ever)


@pytest.mark.parametrize(
    ("time", "whether"),
    [
        (("1.5", "1.6"), True),
        (("1.4", "1.5"), False),
        (("1.6", "1.7"), False),
        (("4.6", "4.8"), False),  # it rises through this zero
        (("1.5", "7"), False),
    ],
)
def test_a_bracket_has_the_signs_plus_and_minus(time, whether):
    assert brackets(cosine, tuple(map(F, time))) is whether


def test_what_holds_for_a_part_of_the_launches_is_not_enough():
    assert brackets(spread, (F(1), F(2)))
    assert not brackets(spread, (F("1.5"), F(2)))  # cos 1.5 = 0.07
    assert not brackets(spread, (F(1), F("1.65")))  # cos 1.65 = -0.08
    with pytest.raises(Unproved, match="negative at the last time"):
        open_windows(spread, [F(1), F("1.65")])
    with pytest.raises(Unproved, match="leave the table"):  # (t (1 - t))' is < 0 for t > 1/2
        first_windows(parabola, [F("0.75"), F("1.1")], 1)


@pytest.mark.parametrize("time", [("0.1", "0.2"), ("0.5", "3"), ("2", "5"), ("0", "7")])
def test_the_fall_is_enclosed(time):
    low, high = map(F, time)
    found = fall(cosine, (low, high))
    for k in range(21):
        at = low + (high - low) * k / 20
        value = cosine((at, at), 1)
        assert found.lo <= value.hi and value.lo <= found.hi
    own = cosine((low, high), 1)  # never wider than the direct enclosure
    assert own.lo <= found.lo <= found.hi <= own.hi


def test_falling_may_need_halving():
    def wide(time, order):
        """cos t, enclosed with an excess of the order of the width."""
        value, excess = cosine(time, order), int((time[1] - time[0]) * 2**BITS / 4)
        return Enclosure(value.lo - excess, value.hi + excess, BITS)

    time = (F("0.3"), F("2.8"))
    assert not falls(wide, time)
    assert falls(wide, time, 4)
    assert not falls(wide, (F("-0.1"), F("2.8")), 8)


def test_windows_are_where_nothing_is_excluded():
    times = [F(k, 8) for k in range(1, 15)]
    ((low, high),) = open_windows(cosine, times)
    assert low < TURN / 4 < high <= F(14, 8)
    with pytest.raises(Unproved, match="negative at the last time"):
        open_windows(cosine, times[:-2])


def test_the_first_window_is_transversal_if_the_gap_falls_to_the_end():
    fine = [F(k, 16) for k in range(1, 19)]
    windows, transversal = first_windows(parabola, fine, 1)
    assert transversal and windows[0][0] < 1 < windows[0][1]
    with pytest.raises(Unproved, match="leave the table"):
        first_windows(parabola, fine, 2)  # t (1 - t) is bent down
    assert first_windows(parabola, fine, 2, 1) == (windows, True)
    coarse = [F(1, 16), F(9, 8)]  # gap' > 0 at first, so that it is no fall
    assert not first_windows(parabola, coarse, 1)[1]


def test_a_second_crossing_is_not_hidden():
    """cos falls, rises and falls again by 8: the window reaches from the first zero to the last."""
    times = [F(1, 8), F(1, 4), F(1, 2), F(1), F(3, 2), F(2), F(4), F(5), F(6), F(7), F(8)]
    windows, transversal = first_windows(lambda t, k: cosine(t, k), times, 0)
    assert windows[0][0] <= TURN / 4 and not transversal


@pytest.mark.parametrize("turns", [-3, 0, 1, 20_000])
def test_phases_a_few_turns_later(turns):
    low, high = lifted((F(1), F(2)), turns, 100)
    thin = F(1, 10**20)
    assert 1 + TURN * turns - thin < low <= 1 + TURN * turns + thin**2
    assert 2 + TURN * turns - thin**2 <= high < 2 + TURN * turns + thin

"""What excludes, brackets and falls, on gaps in closed form; the paper's maps as flights."""

import random
from fractions import Fraction
from fractions import Fraction as F

import pytest

from proofs.trusted import oscillator
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.equations import AT_LAUNCH, Launch, gap, launch_acceleration
from proofs.trusted.flights import lifted
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import Covers, HSet, LocalMap
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.kernel.flight import read_flight
from proofs.trusted.kernel.gaps import brackets, fall, falls, first_windows, open_windows, stays_up
from proofs.trusted.kernel.returns import Launches
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import Place
from proofs.trusted.rules import find_rule
from tests.proofs.trusted.kernel.systems import OSCILLATOR

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


# -- the paper's maps as data for the kernel -------------------------------------------------------


TINY = Fraction(1, 10**60)
SIDES = [{"eta": ["2121/10000"] * 2, "nu": [nu] * 2} for nu in ("-1/5", "1/5")]
PLASTIC = {
    "variables": ["phi"],
    "periods": {"phi": "2*pi"},
    "time": "t",
    "motion": [
        {
            "name": "q",
            "form": "(1 + nu*sin(phi))*cos(eta*t) + nu*cos(phi)/eta*sin(eta*t)",
            "equation": "-eta**2*q",
            "start": ["1 + nu*sin(phi)", "nu*cos(phi)"],
        }
    ],
    "gaps": ["1 + nu*sin(phi + t) - q"],
    "values": ["phi + t"],
}
CLOSING = "-(eta*gamma + nu*cos(phi))"


def flights(sides):
    """The checker's maps, each with a flight that a file gives, by its equation of motion."""
    signed = {"-": ("{}", CLOSING), "1": ("-({})", CLOSING[1:])}[sides["nu"][0][0]]
    for data, more in ((PLASTIC, {}), (OSCILLATOR, {"epsilon": ["1/100", "1/100"]})):
        gaps = [signed[0].format(data["gaps"][0]), *([signed[1]] if more else [])]
        # ranges that are points would be numbers: so nearly points
        wide = {x: [low, str(Fraction(low) + TINY)] for x, (low, _) in (sides | more).items()}
        given = read_flight("F", Reader(data | {"parameters": wide, "gaps": gaps}))
        yield oscillator.read_oscillator(Reader(wide)), given


def overlap(one, two):
    return one.lo <= two.hi and two.lo <= one.hi


def agree(one, two):
    return overlap(one, two) and max(one.hi, two.hi) - min(one.lo, two.lo) < 2**40


@pytest.mark.parametrize("sides", SIDES)
def test_the_functions_and_their_derivatives_are_those_of_the_motion(sides):
    rng = random.Random(5)
    for own, given in flights(sides):
        for _ in range(10):
            states = [Enclosure.of(x, x, 200) for x in (number(rng) for _ in own.variables)]
            t = Enclosure.of(x := number(rng), x, 200)
            one, two = (Launches(x, states, enclosed(x.ranges, 200)) for x in (own, given))
            every = range(len(own.variables) + len(own.ranges))
            roots = ((*f.gaps[0].orders[:3], *f.outcome) for f in (own, given))
            for a, b in zip(*roots, strict=True):
                assert agree(*one.on((a,), t), *two.on((b,), t))
                slopes = one.on(own.slopes(a, every), t), two.on(given.slopes(b, every), t)
                assert all(map(agree, *slopes))
            for a, b in zip(own.gaps, given.gaps, strict=True):
                start = rational(Fraction(0), 200)
                assert a.order == b.order
                assert agree(*one.on((a.launch,), start), *two.on((b.launch,), start))


def number(rng):
    return Fraction(rng.randint(1, 999), 200)


@pytest.mark.parametrize("sides", SIDES)
def test_the_maps_are_those_of_the_motion(sides):
    for own, given in flights(sides):
        box = [(Fraction("1.12"), Fraction("1.121")), (Fraction("-0.3"),) * 2][: len(own.variables)]
        if sides["nu"][0][0] != "-":
            box = [(Fraction("1.5"), Fraction("1.501")), (Fraction(3),) * 2][: len(own.variables)]
        x = enclosed(tuple(box), 128)
        assert all(map(overlap, own.values(x), given.values(x)))
        for rows in zip(own.jacobian(x), given.jacobian(x), strict=True):
            assert all(map(overlap, *rows))
        if len(own.variables) == 1:
            one, two = own.bend(x), given.bend(x)
            assert overlap(one, two) and one.hi - one.lo < 1 << 132


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("kick", [None, Fraction(3, 7)])
def test_how_the_gap_leaves_0_at_launch(side, kick):
    start = Launch(side, Fraction(1, 5), Fraction(1, 3), Fraction(-2, 9), kick)
    assert gap(start, AT_LAUNCH, 0) == 0
    assert gap(start, AT_LAUNCH, 1) == (0 if kick is None else side * kick)
    if kick is None:
        assert gap(start, AT_LAUNCH, 2) == launch_acceleration(start)


def differential(phases, gammas, **change):
    sides = {"eta": ["2121/10000"] * 2, "nu": ["-1/5"] * 2, "epsilon": ["1/100"] * 2}
    witness = {"function": sides | change, "box": [phases, gammas], "turns": ["4"], "bits": "64"}
    return find_rule("differential")(Context(), Reader(witness))


def test_a_box_of_states_and_of_oscillators():
    point = differential(["113/100"] * 2, ["-1/5"] * 2)
    wide = differential(["28/25", "57/50"], ["-1/4", "-3/20"], nu=["-201/1000", "-199/1000"])
    for one, two in zip(point.values, wide.values, strict=True):
        assert two[0] < one[0] <= one[1] < two[1]
    assert "F`" in wide.sentence and str(wide.place).startswith("eta = 0.2121, nu in [-0.201,")
    assert point.place != wide.place and point.function != wide.function


@pytest.mark.parametrize(
    ("phases", "gammas", "change", "reason"),
    [
        (["111/100"] * 2, ["4193/10000"] * 2, {}, "does not leave the wall"),
        (["111/100"] * 2, ["4193/10000"] * 2, {"epsilon": ["0", "0"]}, "> 0 at launch"),
        (["119/100", "123/100"], ["-9/20", "0"], {}, "graze|transversal"),
        (["5"] * 2, ["-13/50"] * 2, {"epsilon": ["0", "0"]}, "right after launch"),  # it sticks
        (["113/100"] * 2, ["-1/5"] * 2, {"epsilon": ["1", "1"]}, "epsilon < 1"),
        (["113/100"] * 2, ["-1/5"] * 2, {"nu": ["-1/5", "1/5"]}, "nu must be"),
        (["113/100"] * 2, ["-1/5"] * 2, {"eta": ["0", "1/5"]}, "eta > 0"),
    ],
)
def test_states_without_an_impact_that_is_proved(phases, gammas, change, reason):
    phases, gammas = ([str(Fraction(x)) for x in side] for side in (phases, gammas))
    with pytest.raises(Unproved, match=reason):
        differential(phases, gammas, **change)


def related(centre, nu):
    """A relation of an h-set to itself, under the map of one oscillator."""
    half, zero = Fraction(1, 2), Fraction(0)
    node = HSet((centre, zero), ((half, zero), (zero, half)), ((2, zero), (zero, 2)))
    sides = [(x, x) for x in (Fraction("0.2121"), nu, Fraction("0.01"))]
    return Covers(LocalMap(oscillator.Oscillator(sides), 1, node, node, (4,)), 1)


def graph(*relations):
    known = {f"c{k}": each for k, each in enumerate(relations)}
    return find_rule("graph")(Context(known=known), Reader({"covers": list(known)}))


def test_relations_say_about_which_oscillator_they_are():
    one, two = related(Fraction(0), Fraction("-0.2")), related(Fraction(3), Fraction("-0.2"))
    for conclusion in (one, graph(one, two)):
        assert "eta = 0.2121, nu = -0.2, epsilon = 0.01: N" in conclusion.sentence
    with pytest.raises(Malformed, match="of the same name"):
        graph(one, related(Fraction(3), Fraction("-0.3")))


def test_relations_of_the_plastic_map_say_so_too():
    """f is expanding near its fixed point in [1.1, 1.113]."""
    sides = {"eta": ["2121/10000"] * 2, "nu": ["-1/5"] * 2}
    faces = dict.fromkeys(("left", "right", "support"))
    known = {
        "n": HSet((Fraction("1.1065"),), ((Fraction("0.0065"),),), ((1 / Fraction("0.0065"),),))
    }
    witness = {"function": sides, "power": "1", "source": "n", "target": "n", "sign": "+"}
    relation = find_rule("covers")(Context(known=known), Reader(witness | faces | {"turns": ["4"]}))
    for conclusion in (relation, graph(relation)):
        assert conclusion.sentence.startswith("for f at (eta, nu) = (0.2121, -0.2): N")


@pytest.mark.parametrize(
    ("phases", "horizon", "is_none"),
    [
        (("1.13",) * 2, 24, True),
        (("1.13",) * 2, "25.2317694082590049861307", False),
        (("1.19", "1.2"), 40, False),
    ],
)
def test_no_impact_is_said_where_none_is_proved_alone(phases, horizon, is_none):
    """That after 1.13 is just before that horizon; some after [1.19, 1.2] are at 27, some at 57."""
    f = PlasticMap(Place.plastic(Fraction("0.2121"), Fraction("-0.2")), Fraction(horizon))
    for impacts in (f.impact, lambda x: list(f.possible_values(x))):
        with pytest.raises(Unproved) as failure:
            impacts([Enclosure.of(*map(Fraction, phases), BITS)])
        assert isinstance(failure.value, NoFirstZero) is is_none

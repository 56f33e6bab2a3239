"""The paper's map as data for the kernel: its formulas are those of the equations."""

import random
from fractions import Fraction

import pytest

from proofs.trusted import oscillator
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.equations import arrival, clock, closing, gap, launch_with_restitution
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.covers import Covers, HSet, LocalMap
from proofs.trusted.kernel.flight import read_gap
from proofs.trusted.kernel.formulas import on_tape
from proofs.trusted.kernel.head import read_head
from proofs.trusted.kernel.trees import formula
from proofs.trusted.kernel.values import Equal
from proofs.trusted.rules import find_rule
from tests.proofs.trusted.kernel.systems import OSCILLATOR

NAMES = ("eta", "nu", "epsilon", "phi", "gamma", "t")
FORM = OSCILLATOR["motion"][0]["form"]


@pytest.mark.parametrize("side", [1, -1])
def test_the_formulas_are_the_equations(side):
    rng = random.Random(side)
    trees = map(formula, (oscillator.GAP, oscillator.ARRIVAL, oscillator.CLOSING))
    formulas = on_tape(*trees, variables=NAMES)
    for _ in range(20):
        numbers = [Fraction(rng.randint(1, 999), 200) for _ in NAMES]
        numbers[1] *= side
        eta, nu, epsilon, phi, gamma, t = x = [Enclosure.of(n, n, 200) for n in numbers]
        start = launch_with_restitution(side, eta, nu, phi, epsilon=epsilon, gamma=gamma)
        now = clock(eta, t)
        own = gap(start, now) * side, arrival(start, now)[1], closing(start, gamma)
        for one, two in zip(formulas.values(x), own, strict=True):
            assert one.lo <= two.hi and two.lo <= one.hi
            assert max(one.hi, two.hi) - min(one.lo, two.lo) < 2**30


def test_the_gap_and_the_velocity_are_those_of_the_motion():
    """By normal forms: x - z for the x that solves x'' = -eta^2 x after the impact, and -x'/eta."""
    Equal.read(oscillator.GAP, f"{FORM} - (1 + nu*sin(phi + t))").prove()
    Equal.read(oscillator.ARRIVAL, f"-D({FORM}, t)/eta").prove()
    Equal.read(f"D({FORM}, t, t)", f"-eta**2*({FORM})").prove()


def test_a_launch_that_is_written_otherwise_is_refused():
    placer = read_head("F", Reader(oscillator._HEAD)).placer()
    tree = formula(oscillator.GAP)
    for wrong in ("epsilon*eta*gamma", "0", "2*epsilon*(eta*gamma + nu*cos(phi))"):
        with pytest.raises(Unproved, match="does not leave 0 so"):
            read_gap(placer, "t", tree, formula(wrong))


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
    return Covers(LocalMap(oscillator.flight(sides), 1, node, node, (4,)), 1)


def graph(*relations):
    known = {f"c{k}": each for k, each in enumerate(relations)}
    return find_rule("graph")(Context(known=known), Reader({"covers": list(known)}))


def test_relations_say_about_which_oscillator_they_are():
    one, two = related(Fraction(0), Fraction("-0.2")), related(Fraction(3), Fraction("-0.2"))
    for conclusion in (one, graph(one, two)):
        assert "eta = 0.2121, nu = -0.2, epsilon = 0.01: N" in conclusion.sentence
    with pytest.raises(Malformed, match="of the same name"):
        graph(one, related(Fraction(3), Fraction("-0.3")))

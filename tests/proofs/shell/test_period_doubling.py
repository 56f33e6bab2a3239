"""`python -m proofs period_doubling`: the numbers, at any precision, and what it refuses."""

import json
import math
from fractions import Fraction

import pytest
from flint import arb, ctx

from proofs.commands.period_doubling import main
from proofs.motion.soft import Springs


def answer(capsys, *arguments):
    assert main([*arguments, "--json", "-"]) == 0
    return json.loads(capsys.readouterr().out)


def expected(m, epsilon):
    """The closed forms, by Arb."""
    ctx.prec = 600
    e, c = arb(epsilon.numerator) / epsilon.denominator, 2 * arb.pi() * m
    alpha = 4 * (1 + e**2) / (1 + e)
    r = (1 - e) / (1 + e)
    found = {
        "rise": (r * c) ** 2 + 4 * (1 - 2 * r**2 + 3 * r**4) / 3,
        "rho_flip": (alpha**2 + ((1 - e) * c) ** 2).sqrt() / (1 + e),
        "rho_saddle_node": (1 - e) / (1 + e) * c,
        "psi": (alpha / ((1 - e) * c)).atan(),
        "cubic": (3 * (c * (1 - e**2)) ** 2 + 8 * (1 - e) ** 4 + 64 * e**2) / (48 * (1 - e**4)),
    }
    if epsilon == 0:
        found["f2_psi_rho"] = (4 + (arb.pi() * m) ** 2).sqrt() / 2
        found["f2_psi_psi_psi"] = -(3 * (arb.pi() * m) ** 2 + 2)
    return found


@pytest.mark.parametrize(("m", "epsilon"), [(1, "0"), (3, "1/5"), (7, "0"), (10**9, "0.999999")])
@pytest.mark.parametrize("digits", [5, 30, 100])
def test_against_arb(capsys, m, epsilon, digits):
    arguments = ("--m", str(m), "--epsilon", epsilon, "--digits", str(digits))
    found = answer(capsys, *arguments)
    for name, true in expected(m, Fraction(epsilon)).items():
        low, high = (Fraction(found[name][side]) for side in ("lower", "upper"))
        assert arb(low.numerator) / low.denominator < true
        assert true < arb(high.numerator) / high.denominator
        assert 0 < (high - low) * 10**digits <= 10 * abs(low)
    more = {"schema", "m", "epsilon", "k", "q", "saddle_node", "flip", "at"}
    more |= {"height_least", "rho_graze", "epsilon_least"}
    assert set(found) == more | set(expected(m, Fraction(epsilon)))


def test_by_default_the_plastic_orbit_of_one_period(capsys):
    """The saddle-node at epsilon = 0 is no orbit: the mass sticks."""
    found = answer(capsys)
    assert (found["m"], found["epsilon"], found["k"]) == ("1", "0", "0")
    assert found["rho_flip"]["lower"].startswith("7.448383556474346")
    assert found["rho_graze"]["lower"].startswith("6.593816618951230")
    assert (found["saddle_node"]["orbit"], found["flip"]["orbit"]) == (False, True)
    assert main([]) == 0
    said = capsys.readouterr().out
    assert "saddle-node of two fixed points: no orbit (rho sin psi < h: the mass sticks)" in said
    assert "a supercritical period doubling: an orbit" in said
    assert "f2_psi_psi_psi  [-31.6088132" in said and "eigenvalue" in said and "J21" in said


def near(bounds, value, room=1e-9):
    return float(bounds["lower"]) - room < value < float(bounds["upper"]) + room


@pytest.mark.parametrize(("epsilon", "orbit"), [("0.0204", False), ("0.0205", True)])
def test_the_saddle_node_is_one_of_orbits_from_epsilon_1_on(capsys, epsilon, orbit):
    found = answer(capsys, "--epsilon", epsilon)
    assert found["saddle_node"]["orbit"] is orbit
    assert near(found["epsilon_least"], 0.02045763242544665)


@pytest.mark.slow
def test_at_the_numbers_of_a_referee(capsys):
    """epsilon = 1/2, rho = 6: the second fixed point goes through the table, so does no orbit."""
    (motions,) = answer(capsys, "--epsilon", "1/2", "--rho", "6")["at"].values()
    assert [(len(each["impacts"]), each["orbit"]) for each in motions] == [
        (1, True),
        (1, False),
        (2, True),
    ]
    assert answer(capsys, "--epsilon", "1/2", "--rho", "2")["at"] == {"2": []}


def test_springs_of_any_stiffness(capsys):
    """The flip of S23, the eigenvalues -1 and -epsilon^2; the rise, by an orbit of period 2."""
    plastic = answer(capsys, "--k", "0.1")
    assert near(plastic["rho_flip"], 7.91012305614)
    found = answer(capsys, "--k", "0.1", "--epsilon", "0.3", "--q", "2")
    for ends, value in zip(found["flip"]["eigenvalues"], (-0.09, -1), strict=True):
        assert near(ends, value)
    assert "cubic" not in found and found["flip"]["orbit"] is True
    springs = Springs(1, Fraction(3, 10), Fraction(1, 10), Fraction(2), 100)
    rho = springs.double(springs.exact(Fraction(1, 500))).rho  # h = 1/1000
    rise = (rho.sqr() - springs.flip.rho.sqr()) * 10**6
    assert near(found["rise"], float(rise.mid), 1e-4)
    assert main(["--k", "0.1", "--epsilon", "0.3"]) == 0
    assert "a supercritical period doubling: an orbit" in capsys.readouterr().out


@pytest.mark.slow
def test_the_orbit_of_period_2_is_followed(capsys):
    found = answer(capsys, "--epsilon", "0.3", "--follow", "--digits", "10")["followed"]
    rhos = [float(each["rho"]["lower"]) for each in found]
    assert rhos == sorted(rhos) and len(rhos) > 20
    assert [each["attracting"] for each in found] == [True] * (len(found) - 1) + [False]
    assert main(["--follow", "--digits", "10"]) == 0
    assert "no orbit (the mass sticks after an impact)" in capsys.readouterr().out.split("\n")[-2]


def test_what_is_not_decided_is_said(capsys):
    """Where the mass grazes the table, to 60 digits: null, and status 1."""
    grazing = answer(capsys, "--epsilon", "0.01", "--digits", "60")["rho_graze"]["lower"]
    arguments = ["--epsilon", "0.01", "--rho", grazing, "--digits", "5"]
    assert main([*arguments, "--json", "-"]) == 1
    (motions,) = json.loads(capsys.readouterr().out)["at"].values()
    assert [each["orbit"] for each in motions] == [None, False]
    assert main(arguments) == 1 and "too close to h to tell" in capsys.readouterr().out


@pytest.mark.slow
def test_digits_do_not_cancel(capsys):
    epsilon = str(1 - Fraction(1, 10**150))
    found = answer(capsys, "--epsilon", epsilon)["rho_saddle_node"]
    low, high = Fraction(found["lower"]), Fraction(found["upper"])
    assert 0 < (high - low) * 10**29 <= low


STICKING = [  # rho, and after how many table periods the mass leaves again; None: it does not stick
    ("1.9", None),
    ("2.5", 1),
    ("6.5", 1),
    ("6.6", None),
    ("9.2", None),
    ("9.3", 2),
    ("12.7", 2),
    ("12.73", None),
]


@pytest.mark.parametrize(("rho", "periods"), STICKING)
def test_the_motion_that_sticks(rho, periods, capsys):
    """S18: against the flight from rho sin psi = 2, marched in floating point."""
    for m in (1, 2):
        motions = answer(capsys, "--m", str(m), "--rho", rho)["at"][rho]
        stuck = [each for each in motions if "leaves" in each["impacts"][0]]
        assert len(stuck) == (m == periods)
        for each in stuck:
            (impact,) = each["impacts"]
            psi, height = math.asin(2 / float(rho)), float(rho)
            t = 0.01
            while gap(height, psi, t) > 0:
                t += 1e-5
            assert near(impact["leaves"], psi) and each["attracting"] is True
            landed = (psi + t) % (2 * math.pi)
            assert near(impact["psi"], landed, 1e-4) and height * math.sin(landed) < 2
            assert math.ceil(t / (2 * math.pi)) == m


def gap(rho, psi, t):
    return rho * (math.sin(psi) + math.cos(psi) * t - math.sin(psi + t)) - t * t


def test_at_rho_2_5_the_screen_tells_of_it(capsys):
    assert main(["--rho", "2.5"]) == 0
    assert "rho = 2.5: 1 motion\n period 1: an orbit (the mass sticks" in capsys.readouterr().out

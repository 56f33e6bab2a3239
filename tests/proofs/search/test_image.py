"""The certified impact map against a brute-force scan of the paper's equation (10)."""

from fractions import Fraction

import pytest
from mpmath import mpf

from intervals import Undecided
from proofs.motion.landing import separation_phase
from proofs.motion.system import System
from proofs.motion.witness import NoImpact
from proofs.search.image import Image, PossibleImages, image
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.reference import as_mpf

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))


def holds(bounds, value, slack=mpf(0)):
    return as_mpf(bounds[0]) - slack <= value <= as_mpf(bounds[1]) + slack


def point(system, phi, **options):
    return image(system, (Fraction(phi), Fraction(phi)), **options)


CASES = [
    ("0.2121", "-0.2", phi)
    for phi in map(str, (0, 0.5, 1.11, 1.15, 1.2, 1.27, 1.32, 1.45, 2, 3, 3.37, 6.05, 6.2))
] + [
    ("0.2121", "0.2", "0.7"),
    ("0.2121", "0.2", "1.5"),
    ("0.9", "-0.3", "1"),
    ("1.7", "-0.9", "4"),
    ("1.7", "2.5", "4.5"),
    ("3.3", "-1.2", "3"),
    ("0.05", "-0.9", "2.5"),
    ("7/5", "3", "5"),
]


@pytest.mark.parametrize(("eta", "nu", "phi"), CASES)
def test_a_point_agrees_with_brute_force(eta, nu, phi):
    system = System(Fraction(eta), Fraction(nu))
    e, n, p = (as_mpf(Fraction(x)) for x in (eta, nu, phi))
    assert reference.launch_acceleration(e, n, p) > 0, "a case that does not stick is wanted"
    expected = reference.first_impact(e, n, p)
    assert expected is not None
    found = point(system, phi)
    assert isinstance(found, Image) and not found.sticking
    slack = mpf(10) ** -40
    assert holds(found.flight, expected[0], slack)
    assert holds(found.phase, expected[1], slack)
    assert holds(found.slope, reference.slope(e, n, p, expected[0]), mpf(10) ** -15)
    for low, high in (found.flight, found.phase, found.slope):
        assert (high - low) * 10**30 <= abs(low)


@pytest.mark.parametrize(
    ("eta", "nu", "phi"),
    [("0.2121", "-0.2", "4.64"), ("0.2121", "-0.2", "3.4"), ("0.2121", "0.2", "0.1"),
     ("1.5", "2.2", "0.5"), ("1.5", "-4", "1"), ("0.6", "1.1", "5")],
)  # fmt: skip
def test_a_sticking_phase_leaves_at_the_separation_phase(eta, nu, phi):
    system = System(Fraction(eta), Fraction(nu))
    e, n, p = (as_mpf(Fraction(x)) for x in (eta, nu, phi))
    assert reference.launch_acceleration(e, n, p) < 0
    leave = reference.separation_phase(e, n)
    assert holds(separation_phase(system, 100), leave, mpf(10) ** -45)
    expected = reference.first_impact(e, n, leave)
    found = point(system, phi)
    assert found.sticking and found.slope == (0, 0)
    assert holds(found.flight, expected[0], mpf(10) ** -30)
    assert holds(found.phase, expected[1], mpf(10) ** -30)
    assert holds(found.dwell, (leave - p) % (2 * reference.mp.pi), mpf(10) ** -40)


def test_an_interval_contains_the_images_of_its_points():
    low, high = Fraction("1.27"), Fraction("1.32")
    found = image(PAPER, (low, high))
    for k in range(6):
        phi = low + (high - low) * k / 5
        flight, phase = reference.first_impact(mpf("0.2121"), mpf("-0.2"), as_mpf(phi))
        slack = mpf(10) ** -28
        assert holds(found.flight, flight, slack) and holds(found.phase, phase, slack)
    ends = [point(PAPER, x) for x in (low, high)]
    assert found.phase[0] <= ends[0].phase[1] and ends[1].phase[0] <= found.phase[1]
    assert found.phase[1] - found.phase[0] < ends[1].phase[1] - ends[0].phase[0] + Fraction(
        1, 10**29
    )


@pytest.mark.slow
def test_a_grazing_phase_inside_gives_the_set_of_possible_images():
    found = image(PAPER, (Fraction("1.17"), Fraction("1.2")))
    assert isinstance(found, PossibleImages) and len(found.images) >= 2
    for k in range(31):
        phi = Fraction("1.17") + Fraction(k, 1000)
        expected = reference.first_impact(mpf("0.2121"), mpf("-0.2"), as_mpf(phi))
        if expected is not None:
            assert any(holds(t, expected[0]) and holds(f, expected[1]) for t, f in found.images)


def test_launches_just_before_a_short_sticking_arc_are_not_left_out():
    """The arc from 4.669 to 4.756 lies inside the first part of the interval."""
    system, low = System(Fraction("0.2121"), Fraction("-0.04715")), Fraction("4.665")
    e, n, phi = (as_mpf(x) for x in (system.eta, system.nu, Fraction("4.667")))
    assert reference.first_impact(e, n, phi)[0] < mpf("0.01")
    with pytest.raises(Undecided, match="sticking begins"):
        image(system, (low, low + 32 * Fraction("0.0915")))


@pytest.mark.slow
def test_forever_on_the_table_and_horizon():
    with pytest.raises(NoImpact, match="forever"):
        point(System(Fraction("0.2121"), Fraction("0.02")), "1")
    with pytest.raises(NoImpact, match="forever"):
        point(System(Fraction(1), Fraction(5)), "1")
    with pytest.raises(NoImpact, match="horizon"):
        point(PAPER, "1.57")
    with pytest.raises(Undecided, match="without relative velocity"):  # at 2 pi k
        point(System(Fraction(1), Fraction("-0.4")), "2", horizon=Fraction(50))
    with pytest.raises(NoImpact, match="horizon"):
        point(PAPER, "1.11", horizon=Fraction(10))


@pytest.mark.parametrize("digits", [1, 15, 30, 100, 300])
def test_digits_asked_for_are_digits_certified(digits):
    found = point(PAPER, "1.31", digits=digits)
    more = point(PAPER, "1.31", digits=2 * digits + 20)
    for low, high in zip(
        (found.flight, found.phase, found.slope), (more.flight, more.phase, more.slope), strict=True
    ):
        assert low[0] <= high[0] and high[1] <= low[1]
        assert (low[1] - low[0]) * 10**digits < abs(low[0])

"""Precision where it is needed, part by part and box by box, against 250 digits of mpmath."""

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from intervals import Undecided
from proofs.benchmark.peers import FLINT, arithmetic
from proofs.motion.system import System
from proofs.motion.witness import Flights
from proofs.search.image import Image, image
from proofs.stress.truth import BITS, graze
from proofs.trusted.flights import Motion
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.kernel.firstzero import NoFirstZero
from proofs.trusted.kernel.gaps import brackets, falls
from proofs.trusted.numbers import COVER_BITS
from proofs.trusted.oscillator import PlasticMap
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.reference import as_mpf

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
DIGITS = 250


def fraction(x):
    sign, mantissa, exponent, _ = x._mpf_
    return Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** exponent


def ends(system):
    """(onset, separation): where sticking begins and ends, to 250 digits, in [0, 2 pi)."""
    with mp.workdps(DIGITS):
        leave = mp.findroot(
            lambda x: reference.launch_acceleration(as_mpf(system.eta), as_mpf(system.nu), x),
            reference.separation_phase(as_mpf(system.eta), as_mpf(system.nu)),
        )
        return fraction((mp.pi - leave) % (2 * mp.pi)), fraction(leave % (2 * mp.pi))


def short_flight(system, phase, about):
    """(time, slope) next to the onset of sticking, the root of (10) near 3 `about`."""
    with mp.workdps(DIGITS):
        eta, nu, phi = as_mpf(system.eta), as_mpf(system.nu), as_mpf(phase)

        def scaled(t, phi=phi):  # the double zero at 0 taken out
            return reference.left_side_10(eta, nu, phi, t) / t**2

        guess = 3 * as_mpf(about)
        near = guess * mpf("0.99"), guess
        time = mp.findroot(scaled, near, verify=False)
        h = as_mpf(about) * mpf(10) ** -40
        later = mp.findroot(lambda t: scaled(t, phi + h), near, verify=False)
        assert abs(scaled(time)) < as_mpf(about) * mpf(10) ** -100
        return fraction(time), fraction(1 + (later - time) / h)


ONSET, SEPARATION = ends(PAPER)


def flights(system, low, high=None, bits=COVER_BITS):
    """The flights from phases of an interval, or from one phase."""
    motion = Motion(system.place, (low, low if high is None else high), bits)
    return Flights.plastic(motion)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("exponent", "share"),
    [
        (13, Fraction(1, 100)),
        (30, Fraction(1, 10**6)),
        *(
            pytest.param(exponent, share, marks=pytest.mark.slow)
            for exponent in (2, 13, 17, 30)
            for share in (Fraction(1, 2), Fraction(1, 300), Fraction(1, 10**7))
        ),
    ],
)
def test_intervals_next_to_the_onset_of_sticking_have_images(exponent, share):
    distance = Fraction(1, 10**exponent)
    low = ONSET - distance
    found = image(PAPER, (low, low + share * distance), digits=12)
    assert isinstance(found, Image) and not found.sticking
    for part in (Fraction(0), Fraction(1, 3), Fraction(1)):
        time, slope = short_flight(PAPER, low + part * share * distance, distance)
        assert found.flight[0] <= time <= found.flight[1]
        assert found.slope[0] <= slope <= found.slope[1]
    first = short_flight(PAPER, low, distance)[0]
    last = short_flight(PAPER, low + share * distance, distance)[0]
    assert found.flight[1] - found.flight[0] <= (first - last) * (1 + Fraction(1, 10**5))
    assert found.slope[1] - found.slope[0] < max(share / 4, Fraction(1, 50))


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [3, 25, 40])
def test_both_sides_of_the_separation_phase(exponent):
    distance = Fraction(1, 10**exponent)
    before = image(PAPER, (SEPARATION - distance,) * 2, digits=20)
    after = image(PAPER, (SEPARATION + distance,) * 2, digits=20)
    assert before.sticking and not after.sticking
    rounding = Fraction(1, 10**240)  # of SEPARATION
    assert before.dwell[0] - rounding <= distance <= before.dwell[1] + rounding
    assert abs(after.flight[0] - before.flight[0]) < 5 * distance + Fraction(1, 10**18)
    assert 0 < after.slope[0] < 10 * distance


# -- next to grazing -----------------------------------------------------------------------------


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("exponent", [5, 17, 30])
def test_times_next_to_grazing_are_what_the_rules_prove(exponent, side):
    eta, nu, phase = graze(arithmetic(FLINT, BITS), 2)
    point, system = phase + side * Fraction(1, 10**exponent), System(eta, nu)
    flown = flights(system, point, bits=4 * COVER_BITS)
    times = flown.times((2,))
    assert times == sorted(set(times)) and times[0] > 0
    window = times[-2], times[-1]
    assert falls(flown.gap_of, window, 4) and brackets(flown.gap_of, window)
    own = PlasticMap(system.place).window(enclosed(((point, point),), 256))
    assert own[0] < times[-1] and times[-2] < own[1]


@pytest.mark.parametrize(
    ("low", "high", "error"),
    [("1.19", "1.21", Unproved), ("1.57", "1.57", NoFirstZero), ("4", "4", Undecided)],
    ids=["some graze", "none impacts", "sticks"],
)
def test_where_no_first_impact_is_proved_there_are_no_times(low, high, error):
    with pytest.raises(error):
        flights(PAPER, Fraction(low), Fraction(high)).times((2,))

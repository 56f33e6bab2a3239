"""Precision where it is needed, part by part and box by box, against 250 digits of mpmath."""

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from proofs.benchmark.peers import FLINT, arithmetic
from proofs.motion.simulate import next_impact
from proofs.motion.system import System
from proofs.motion.witness import FlightBox, Unsettled, locate, march
from proofs.plane.steps import impact_times
from proofs.search.image import Image, image
from proofs.stress.grazing import graze
from proofs.stress.truth import BITS
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.numbers import COVER_BITS
from proofs.trusted.oscillator import PlasticMap
from tests.proofs.trusted.paper import reference

PAPER = System(Fraction("0.2121"), Fraction("-0.2"))
DIGITS = 250


def fraction(x):
    sign, mantissa, exponent, _ = x._mpf_
    return Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** exponent


def number(x):
    return mpf(x.numerator) / x.denominator


def ends(system):
    """(onset, separation): where sticking begins and ends, to 250 digits, in [0, 2 pi)."""
    with mp.workdps(DIGITS):
        leave = mp.findroot(
            lambda x: reference.launch_acceleration(number(system.eta), number(system.nu), x),
            reference.separation_phase(number(system.eta), number(system.nu)),
        )
        return fraction((mp.pi - leave) % (2 * mp.pi)), fraction(leave % (2 * mp.pi))


def short_flight(system, phase, about):
    """(time, slope) next to the onset of sticking, the root of (10) near 3 `about`."""
    with mp.workdps(DIGITS):
        eta, nu, phi = number(system.eta), number(system.nu), number(phase)

        def scaled(t, phi=phi):  # the double zero at 0 taken out
            return reference.left_side_10(eta, nu, phi, t) / t**2

        guess = 3 * number(about)
        near = guess * mpf("0.99"), guess
        time = mp.findroot(scaled, near, verify=False)
        h = number(about) * mpf(10) ** -40
        later = mp.findroot(lambda t: scaled(t, phi + h), near, verify=False)
        assert abs(scaled(time)) < number(about) * mpf(10) ** -100
        return fraction(time), fraction(1 + (later - time) / h)


ONSET, SEPARATION = ends(PAPER)


def flights(system, low, high=None):
    """The flights from phases of an interval, or from one phase."""
    return FlightBox.plastic(system.place, (low, low if high is None else high))


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


def test_precision_grows_where_it_must():
    needed = [locate(flights(PAPER, Fraction("1.13"))).bits]
    for exponent in (1, 6, 12, 24):
        needed.append(locate(flights(PAPER, ONSET - Fraction(1, 10**exponent))).bits)
    assert needed[0] == needed[1] == COVER_BITS and needed == sorted(needed)
    assert needed[-1] > needed[2] > COVER_BITS


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
def test_what_is_found_next_to_grazing_is_what_the_checker_finds(exponent, side):
    eta, nu, phase = graze(arithmetic(FLINT, BITS), 2)
    point = phase + side * Fraction(1, 10**exponent)
    found = locate(flights(System(eta, nu), point))
    assert found.transversal and len(found.windows) == 1
    assert list(found.times) == sorted(set(found.times)) and found.times[0] > 0
    own = PlasticMap(System(eta, nu).place).window(enclosed((found.flights.phases,), 256))
    assert own[0] < found.windows[0][1] and found.windows[0][0] < own[1]
    assert found.proved_windows() == found.windows


@pytest.fixture
def asked(monkeypatch):
    """(bits, time) of each gap that is evaluated."""
    found, sound = [], FlightBox.gap_of

    def gap_of(self, bits, start=None):
        plain = sound(self, bits, start)

        def spied(time, order):
            found.append((bits, time[0]))
            return plain(time, order)

        return spied

    monkeypatch.setattr(FlightBox, "gap_of", gap_of)
    return found


@pytest.mark.parametrize("single", [True, False])
def test_unsettled_knows_where_the_gap_is_positive(single, asked):
    # a launch next to grazing, looked at with coarse steps: the minimum is neither > 0 nor < 0
    eta, nu, phase = graze(arithmetic(FLINT, BITS), 2)
    box, start = flights(System(eta, nu), phase), [Fraction(1, 64)]
    about = (
        next_impact(System(eta, nu), float(phase) + 1e-3),
        next_impact(System(eta, nu), float(phase) - 1e-3),
    )
    horizon = Fraction(min(each.time for each in about)) + 5
    with pytest.raises(Unsettled) as refused:
        march(box, COVER_BITS, horizon, Fraction(1, 8), start, single=single)
    excluded, latest = refused.value.excluded, max(time for _, time in asked)
    assert (latest >= horizon - 1) != single  # a window left behind ends a single search
    assert excluded[:1] == start and excluded == sorted(set(excluded))
    assert excluded[-1] < horizon - 4
    gap_of = box.gap_of(COVER_BITS)
    assert all(gap_of((time, time), 0).lo > 0 for time in excluded)


def test_a_window_is_narrowed_to_the_impacts_of_all_launches():
    box = flights(PAPER, Fraction("1.11"), Fraction("1.12"))
    (window,) = march(box, COVER_BITS).windows
    low, high = impact_times(box.gap_of(COVER_BITS + 16), window, 16)
    times = [next_impact(PAPER, float(phase)).time for phase in box.phases]
    assert window[0] < low < min(times) and max(times) < high < window[1]
    last, gap_of = (window[1] - window[0]) / 2**16, box.gap_of(2 * COVER_BITS)
    signs = [gap_of((x, x), 0) for x in (low, low + last, high, high - last)]
    assert signs[0].lo > 0 >= signs[1].lo and signs[2].hi < 0 <= signs[3].hi


def test_what_is_seen_and_not_proved_is_refused():
    seen = march(flights(PAPER, Fraction("1.19"), Fraction("1.21")), COVER_BITS)  # some graze
    assert not seen.transversal and seen.proved_windows() == seen.windows
    early = seen._replace(times=seen.times[:-1])
    with pytest.raises(Unproved, match="negative at the last time"):
        early.proved_windows()

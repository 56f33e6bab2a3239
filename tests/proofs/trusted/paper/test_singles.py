"""Stable single-impact orbits of all oscillators of a box, and of no others."""

import json
import math
import random
from contextlib import suppress
from fractions import Fraction
from functools import cache, partial

import pytest

from intervals import Undecided
from proofs.plane.singles import propose
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.firstzero import FirstZero
from proofs.trusted.oscillator import REBOUNDS
from proofs.trusted.paper.beyond.singles import Part, StableSingles, parts
from proofs.trusted.parameters import Place
from proofs.trusted.verify import Rejected, check
from tests.oracles.judge import oracle
from tests.oracles.single import stable_count as count
from tests.oracles.sources import committed

F = Fraction


def place(eta, nu, epsilon=None, width="0.0005"):
    sides = [(F(x), F(x) + F(width)) for x in (eta, nu)]
    return Place(*sides, None if epsilon is None else (F(epsilon),) * 2)


SHORT = place("0.237", "0.3")  # closed forms are enough
FLIES = place("0.6", "-0.75", "0.3")  # needs its flight
HIT = place("0.52", "1.3", "0.3")
PLACES = {"short": SHORT, "flies": FLIES, "hit": HIT}


@cache
def text(at, most=5):
    return propose(at, most).certificate()


def changed(at, change, parameters=None):
    document = json.loads(text(at))
    (step,) = document["steps"].values()
    change(step["witness"])
    document["parameters"] |= {k: [str(F(x)) for x in v] for k, v in (parameters or {}).items()}
    return json.dumps(document)


def nothing(witness):
    pass


# -- what is proved --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("at", "stable", "flight"), [(SHORT, (1,), False), (FLIES, (1,), True), (HIT, (), False)]
)
def test_what_is_proved_in_boxes(at, stable, flight):
    report = check(text(at))
    (found,) = report.conclusions
    assert found == StableSingles(at, 5, stable) and report.parameters == at
    (part,) = parts(at, 1)
    assert part._is_short is (bool(stable) and not flight)
    assert oracle(found, random.Random(1)) == []


def test_the_sentence_has_its_hypotheses():
    (plastic,) = check(text(SHORT)).sentences
    assert "epsilon = 0: there is exactly one stable periodic motion" in plastic
    assert "impacts being plastic, it leaves at once" in plastic and "a transversal one" in plastic
    assert "for n = 1, and none for another n." in plastic  # 2 n eta >= 1 for n > 5
    (none,) = check(text(HIT)).sentences
    assert "epsilon = 0.3: no periodic motion" in none and "leaves at once" not in none
    assert "for any n up to 5:" in none
    both = StableSingles(Place(*(((F(1), F(2)),) * 2), (F(0), F("0.1"))), 5, (1, 3)).sentence
    assert "for n = 1, 3, each, and none for another n up to 5" in both
    assert "if impacts are plastic, it leaves at once" in both


@pytest.mark.parametrize(
    ("eta", "nu", "most", "complete"),
    [
        (("0.1", "0.2"), ("0.3", "1"), 4, True),
        (("0.1", "0.2"), ("0.3", "1"), 3, False),
        (("0.1", "0.2"), ("0.3", "1.1"), 4, False),  # the table goes below the rest of the mass
        (("0.1", "0.2"), ("-0.4", "-0.3"), 4, False),
    ],
)
def test_greater_n_are_excluded_only_where_lemma_3_does(eta, nu, most, complete):
    at = Place(tuple(map(F, eta)), tuple(map(F, nu)))
    assert StableSingles(at, most, ()).is_complete is complete


@pytest.mark.parametrize(
    ("most", "stable"), [(0, ()), (101, ()), (3, (2, 1)), (3, (1, 1)), (3, (4,))]
)
def test_what_is_no_conclusion(most, stable):
    with pytest.raises(Unproved):
        StableSingles(SHORT, most, stable)


def random_boxes(count, seed):
    rng = random.Random(seed)
    for _ in range(count):
        width = F(rng.choice(("0.0005", "0.002", "0.01")))
        eta, nu = (F(rng.randrange(a, b), 1000) for a, b in ((100, 3000), (-1500, 1490)))
        if nu * (nu + width) > 0:
            epsilon = rng.choice((None, "0.01", "0.3", "0.8"))
            yield place(eta, nu, epsilon, width), rng


@pytest.mark.slow
def test_boxes_at_random_by_what_repeats_and_its_first_impact():
    """Everything that is proved is true at a random oscillator of the box, by `tests.oracles`."""
    seen = {True: 0, False: 0}
    for at, rng in random_boxes(120, 7):
        try:
            (found,) = check(propose(at, 4).certificate()).conclusions
        except (Undecided, Rejected):
            continue
        eta, nu = (low + (high - low) * F(rng.random()) for low, high in (at.eta, at.nu))
        for n in range(1, 5):
            assert count(eta, nu, (at.epsilon or (F(0),))[0], n) in (None, int(n in found.stable))
        seen[bool(found.stable)] += 1
    assert seen[True] > 8 and seen[False] > 40


def test_the_windows_of_section_4():
    """Of nu = 0.2, proved there by other lemmas: stable inside, for this n alone; not beside."""
    steps = committed("single")["steps"].values()
    ends = next(x["witness"]["ends"] for x in steps if x["rule"] == "single-windows")
    near = F(1, 10**6)
    for n, (flip_low, flip_high, stick_low, stick_high) in enumerate(ends[:8], start=1):
        for eta, stable in (
            (F(flip_high) + near, (n,)),
            (F(stick_low) - 2 * near, (n,)),
            (F(flip_low) - 2 * near, ()),
            (F(stick_high) + near, ()),
        ):
            at = Place((eta, eta + near / 2), (F("0.2"), F("0.2") + near / 1000))
            assert check(propose(at, 8).certificate()).conclusions[0].stable == stable


@pytest.mark.parametrize(
    ("eta", "nu", "n"),
    [("0.5", "-0.4", 2), ("1", "-0.4", 1), ("0.25", "0.9", 2), ("1.5", "1.2", 1)],
)
def test_where_n_eta_is_an_integer_or_half_of_one(eta, nu, n):
    """On both sides, and at eta itself, where all launches touch the table at 2 pi n, or h = 0."""
    at = Place((F(eta) - F("0.0001"), F(eta) + F("0.0001")), (F(nu), F(nu) + F("0.0001")))
    assert [part.k for part in parts(at, n)] == [2 * n * F(eta) - 1, 2 * n * F(eta)]
    try:
        (found,) = check(propose(at, 3).certificate()).conclusions
    except (Undecided, Rejected):
        return
    for share in (F(0), F(1, 3), F(1, 2), F(1)):
        own = at.eta[0] + (at.eta[1] - at.eta[0]) * share
        for m in range(1, 4):
            assert count(own, F(nu), F(0), m) in (None, int(m in found.stable))


# -- what is not -----------------------------------------------------------------------------------


def entry(n, cuts="1", times=()):
    return {"n": str(n), "cuts": str(cuts), "times": list(times)}


@pytest.mark.parametrize("name", PLACES)
def test_forgeries_about_which_are_stable(name):
    at = PLACES[name]
    (found,) = check(text(at)).conclusions
    for n in range(1, 6):
        if n in found.stable:
            with pytest.raises(Rejected, match="not excluded"):
                check(
                    changed(
                        at,
                        lambda w: w.update(
                            stable=[], none=w["none"] + [{**x, "times": []} for x in w["stable"]]
                        ),
                    )
                )
        else:
            with pytest.raises(Rejected, match=r"not proved|not excluded|no impact is proved"):
                check(changed(at, partial(call_stable, {"n": str(n), "cuts": "1"})))


def call_stable(forged, witness):
    witness["none"] = [each for each in witness["none"] if each["n"] != forged["n"]]
    witness["stable"].append(forged)


def test_an_earlier_impact_must_be_before_the_period():
    """After it the gap is < 0 for any motion."""
    late = str(F(math.tau + 0.05).limit_denominator(1000))
    forged = changed(FLIES, lambda w: w.update(stable=[], none=[entry(1, 1, [late])]))
    with pytest.raises(Rejected, match="n = 1"):
        check(forged)


def test_the_first_impact_of_a_flight_must_be_the_one_that_repeats():
    """This flight is proved, and ends at a transversal impact, before 2 pi."""
    (part,) = parts(HIT, 1)
    low, high = FirstZero(part, REBOUNDS).window(F(9))
    assert 0 < low < high < 3 and part.contracts
    with pytest.raises(Rejected, match="not proved for n = 1"):
        check(changed(HIT, partial(call_stable, {"n": "1", "cuts": "1"})))


def has_one(part):
    with suppress(Unproved):
        return part.has_one
    return False


def test_at_resonance_the_impact_has_no_velocity():
    """At eta = 1 exactly; up to there the orbit of n = 1 is stable."""
    for end, proved in (("0.9999", True), ("1", False)):
        at = Place((F("0.99"), F(end)), (F("-0.3001"), F("-0.3")))
        (part,) = parts(at, 1)
        assert part.contracts and has_one(part) is proved


@pytest.mark.parametrize(
    ("at", "sides"),
    [
        (SHORT, {"eta": ("0.1", "0.3")}),  # wider than where it is stable
        (SHORT, {"nu": ("0.3", "0.9")}),
        (SHORT, {"eta": ("0.3", "0.31")}),  # elsewhere
        (SHORT, {"nu": ("-0.3", "-0.299")}),
        (FLIES, {"nu": ("-1.2", "-0.7495")}),
        (FLIES, {"epsilon": ("0", "0.5")}),
        (HIT, {"eta": ("0.5", "0.5205")}),
        (HIT, {"epsilon": ("0", "0.9")}),
    ],
)
def test_a_larger_box_or_another_one_is_rejected(at, sides):
    with pytest.raises(Rejected):
        check(changed(at, nothing, sides))


def test_what_sticks_is_no_orbit_of_plastic_impacts_and_may_be_one_of_others():
    at = place("0.228", "0.2")  # beyond the window of n = 1
    assert not check(text(at)).conclusions[0].stable
    (part,) = parts(at, 1)
    assert part.contracts and not part.has_one
    assert not Part(place("0.228", "0.2", "0.01"), 1, 0).has_none(())

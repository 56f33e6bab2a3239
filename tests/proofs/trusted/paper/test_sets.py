"""The invariant set of the map: by brute force on itineraries, and by edited certificates.

Phases with a given itinerary come from bisection on equation (10), typed by hand: a flight from
I0 takes 4 turns of the table, one from I1 takes 9.
"""

import copy
from fractions import Fraction
from math import cos, sin, tau

import pytest

from proofs.search.s32_sets import prove
from proofs.shell.groups import settle
from proofs.trusted.certificate import Malformed, render
from proofs.trusted.numbers import Range
from proofs.trusted.paper.s32_sets.itinerary import Horseshoe, Itinerary, follow, invariant_set
from proofs.trusted.paper.s32_sets.sets import CLAIMS
from proofs.trusted.paper.s32_sets.subshift import words
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.slopes import SlopeRange
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check

ETA, NU = 0.2121, -0.2
TURNS = {"0": 4, "1": 9}
DECIDE = {claim.id: claim.decide for claim in CLAIMS}
UPPER_FIXED_POINT = 1.316386182666309667  # mpmath, 50 digits


def distance(phase, time):
    """Equation (10), the left side."""
    return (
        (1 + NU * sin(phase)) * cos(ETA * time)
        + NU / ETA * cos(phase) * sin(ETA * time)
        - 1
        - NU * sin(phase + time)
    )


def preimage(letter, image):
    """The phase of I0 or I1 whose next impact is at `image`."""
    low, high = (1.1, 1.15) if letter == "0" else (1.27, 1.32)
    flight = tau * TURNS[letter] + image

    def ahead(phase):
        return distance(phase, flight - phase) > 0

    assert ahead(low) is not ahead(high)
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if ahead(middle) is ahead(low) else (low, middle)
    return low


@pytest.fixture(scope="module")
def points():
    """The phase with the itinerary w 1 1 1 ... for each word w of at most 8 letters."""
    found = {"": UPPER_FIXED_POINT}
    for size in range(1, 9):
        for word in words(size):
            found[word] = preimage(word[0], found[word[1:]])
    return found


def sets(left, right):
    low, high = (tuple(map(Fraction, part)) for part in (left, right))
    return Parameters(PAPER.eta, PAPER.nu, low, high, (low[0], high[1]), PAPER.slopes)


@pytest.fixture(scope="module")
def proved():
    """The certificate at the paper's numbers."""
    return settle("sets", PAPER, digits=12, tell=lambda stage: None)[1]


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (("1.11", "1.15"), ("1.27", "1.32")),
        (("1.105", "1.15"), ("1.27", "1.316")),
        (("1.1", "1.15"), ("1.27", "1.31")),
        (("1.1", "1.15"), ("1.27", "1.32")),
    ],
)
def test_subshift_by_brute_force(points, left, right):
    """The orbits that stay in I are those of the words without a forbidden factor."""
    of = sets(left, right)
    found = [conclusion for _, conclusion in prove(of, ["H8"], digits=10).proofs["H8"]]
    known = invariant_set(of, found)
    assert not isinstance(known, str)
    shift = known[1]
    verdict = DECIDE["H7"](of, found).verdict
    assert verdict is (Verdict.REFUTED if shift.missing else Verdict.VERIFIED)
    low, high = map(float, of.interval)
    for word in words(8):
        stays = all(low <= points[word[k:]] <= high for k in range(9))
        assert shift.begins(word + "1" * 12) is stays


def test_printed_set_has_no_000(proved):
    """1.11 lies between the phases with the itineraries 000... and those with 001..."""
    entry = {claim["id"]: claim for claim in proved["claims"]}["H7"]
    assert entry["verdict"] == "REFUTED"
    assert "begins with 000" in entry["witness"]
    assert "itineraries 0111... and 1111..." in entry["witness"]


def test_order_of_phases_is_the_order_of_itineraries(points):
    ordered = sorted(words(8), key=points.__getitem__)
    assert ordered == words(8)


def test_inequality_of_the_proof_fails(points, proved):
    """|I_001| and |I_00| in the printed sets, from their ends, against the witness."""
    low = 1.11
    high = preimage("0", 1.15)
    first = preimage("0", preimage("0", 1.27))
    last = preimage("0", preimage("0", 1.32))
    assert last - first > (high - low) / 4.2
    text = proved["claims"][0]["witness"]
    u, v = (float(x) for x in text.split("fails too: ")[1].split(" are in I_001")[0].split(" and "))
    a, b = (float(x) for x in text.split("lies between ")[1].split(",")[0].split(" and "))
    assert first <= u < v <= last
    assert a <= low < high <= b
    assert v - u > (b - a) / 4.2


# -- following an orbit ----------------------------------------------------------------------------

BASE = sets(("1", "1.2"), ("1.3", "1.4"))


def known(*pairs: tuple[str, Range]) -> SlopeRange:
    """f at points, as a slope-range step has it."""
    images = tuple((Fraction(a), Fraction(b)) for _, (a, b) in pairs)
    nothing = (Fraction(0), Fraction(9))
    return SlopeRange(
        tuple(Fraction(p) for p, _ in pairs),
        (nothing,) * len(pairs),
        images,
        (nothing,) * (len(pairs) - 1),
    )


def test_follow_takes_the_nearest_points():
    steps = [known(("1", ("0.8", "0.9")), ("1.1", ("1.25", "1.26")), ("1.2", ("1.5", "1.6")))]
    found = follow(BASE, steps, Fraction("1.1"))
    assert found == Itinerary(
        BASE,
        Fraction("1.1"),
        "0",
        1,
        ((Fraction("1.1"),) * 2, (Fraction("1.25"), Fraction("1.26"))),
    )
    assert follow(BASE, steps, Fraction("1.15")) is None  # anywhere in [1.25, 1.6]
    assert follow(BASE, steps, Fraction("1.35")) is None  # nothing is known there
    assert follow(BASE, steps, Fraction("0.9")).leaves == 0
    assert follow(BASE, steps, Fraction("1.5")).leaves == 2


@pytest.mark.parametrize(
    "image",
    [("1.19", "1.21"), ("1.15", "1.35"), ("0.99", "1.01"), ("1.39", "1.41"), ("6.2", "6.3")],
)
def test_follow_gives_up_where_the_set_is_not_decided(image):
    assert follow(BASE, [known(("1.1", image), ("1.2", ("1.5", "1.6")))], Fraction("1.1")) is None


def test_points_within_the_uncertainty_bound_nothing():
    """x in [1.11, 1.13], f(1.12) = 1.25: f(x) is between f(1.1) and f(1.2) only."""
    steps = [
        known(("1.1", ("1.11", "1.13")), ("1.12", ("1.25", "1.25")), ("1.2", ("1.26", "1.27")))
    ]
    assert follow(BASE, steps, Fraction("1.12")).word == "0"
    assert follow(BASE, steps, Fraction("1.1")) is None


def test_follow_gives_up_on_an_orbit_that_stays():
    steps = [known(("1.1", ("1.1", "1.1")), ("1.2", ("1.5", "1.6")))]
    assert follow(BASE, steps, Fraction("1.1")) is None


# -- decisions -------------------------------------------------------------------------------------

AROUND = sets(("1.1", "1.15"), ("1.27", "1.32"))
CUT = Itinerary(AROUND, Fraction("1.11"), "00", 1, ((Fraction("1.11"),) * 2,) * 3)


@pytest.mark.parametrize("claim", ["H7", "H8", "H9", "H10"])
@pytest.mark.parametrize(
    "found",
    [
        [],
        [CUT],
        [Horseshoe(sets(("1.115", "1.15"), ("1.27", "1.32")))],
        [Horseshoe(sets(("1.1", "1.15"), ("1.27", "1.319")))],
    ],
)
def test_nothing_without_a_horseshoe_around_the_interval(claim, found):
    assert DECIDE[claim](PAPER, found).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("claim", ["H7", "H8", "H9"])
@pytest.mark.parametrize("change", [{"phase": Fraction("1.12")}, {"sets": PAPER}])
def test_the_end_itself_must_be_followed(claim, change):
    other = Itinerary(**{**vars(CUT), **change})
    assert DECIDE[claim](PAPER, [Horseshoe(AROUND), other]).verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("word", "leaves", "missing"),
    [
        ("00", 1, "000"),
        ("00", 0, None),
        ("00", 2, "00"),
        ("0", 1, "00"),
        ("", 2, "0"),
        ("1", 0, "0"),
    ],
)
def test_what_an_orbit_forbids(word, leaves, missing):
    """Of the lower end of I: all words before its own."""
    cut = Itinerary(AROUND, Fraction("1.11"), word, leaves, CUT.orbit)
    _, shift = invariant_set(PAPER, [Horseshoe(AROUND), cut])
    assert shift.missing == missing


def test_gap_of_another_width():
    """Points of Lambda that are in neither printed set have no symbol there."""
    narrow = sets(("1.11", "1.14"), ("1.27", "1.32"))
    assert DECIDE["H7"](narrow, [Horseshoe(AROUND), CUT]).verdict is Verdict.UNDECIDED
    assert DECIDE["H9"](narrow, [Horseshoe(AROUND), CUT]).verdict is Verdict.VERIFIED


def test_slopes_of_two_are_not_enough_for_measure_zero():
    slow = Parameters(**{**vars(AROUND), "slopes": (Fraction(2), Fraction(7))})
    assert DECIDE["H10"](PAPER, [Horseshoe(slow)]).verdict is Verdict.UNDECIDED


def test_an_empty_invariant_set():
    """If the orbit of the lower end is above that of all points, nothing stays in I."""
    gone = Itinerary(AROUND, Fraction("1.11"), "", 2, CUT.orbit)
    one = Itinerary(AROUND, Fraction("1.11"), "1", 2, CUT.orbit)
    for claim in ("H7", "H8", "H9"):
        for cut in (gone, one):
            assert DECIDE[claim](PAPER, [Horseshoe(AROUND), cut]).verdict is not Verdict.VERIFIED


def passing(phase, word, *orbit):
    ranges = tuple((Fraction(x), Fraction(x)) for x in (phase, *orbit))
    return Itinerary(AROUND, Fraction(phase), word, 1, ranges)


def inequality_fails(*orbits):
    return "fails too" in DECIDE["H7"](PAPER, [Horseshoe(AROUND), CUT, *orbits]).witness


def test_what_the_failing_inequality_needs():
    """Two phases in one I_001, and I_00 within 4.2 times their distance."""
    u, v = (passing(phase, "001", "1.13", "1.28", "1.2") for phase in ("1.1118", "1.1135"))
    beside = passing("1.1144", "0", "1.16")
    assert inequality_fails(u, v, beside)
    assert not inequality_fails(u, v)  # I_00 might be all of I
    assert not inequality_fails(u, v, passing("1.1144", "00", "1.14", "1.16"))
    assert not inequality_fails(u, passing("1.1119", "001", "1.13", "1.28", "1.2"), beside)
    assert not inequality_fails(u, passing("1.1135", "010", "1.28", "1.13", "1.2"), beside)
    below = passing("1.1118", "001", "1.105", "1.28", "1.2")  # not in the printed I_00
    assert not inequality_fails(below, v, beside)


# -- certificates ----------------------------------------------------------------------------------


def test_certificate_is_accepted(proved):
    report = check(render(proved))
    verdicts = {claim.id: claim.verdict.value for claim in report.claims}
    assert verdicts == {
        "H7": "REFUTED",
        "H8": "VERIFIED",
        "H9": "VERIFIED",
        "H10": "VERIFIED",
        "H12": "VERIFIED",
        "H14": "REFUTED",
        "H15": "REFUTED",
        "H17": "REFUTED",
    }


def witness(name, **fields):
    return lambda document: document["steps"][name]["witness"].update(fields)


def claim(name, **fields):
    def edit(document):
        entry = next(entry for entry in document["claims"] if entry["id"] == name)
        entry.update({key: value(entry[key]) for key, value in fields.items()})

    return edit


def always(value):
    return lambda before: value


def without(name):
    return lambda names: [each for each in names if each != name]


def dropped_point(document):
    """f at a phase beside an image of 1.11 is not known any more."""
    step = document["steps"]["slope-range-1"]["witness"]
    middle = len(step["points"]) // 2
    del step["points"][middle], step["pieces"][middle]


def fewer_flights(document):
    """The end of the gap is not proved to escape."""
    document["steps"]["avoids-1"]["witness"]["flights"].pop()


FORGED = {
    "a part of the gap": fewer_flights,
    "escape from a part of I": witness("avoids-1", target=["6/5", "33/25"]),
    "slopes tightened below": witness("horseshoe-1", slopes=["22/5", "619/100"]),
    "slopes tightened above": witness("horseshoe-1", slopes=["43/10", "6"]),
    "slopes that do not expand": witness("horseshoe-1", slopes=["1", "619/100"]),
    "the printed sets": witness("horseshoe-1", left=["111/100", "23/20"]),
    "wider than proved": witness("horseshoe-1", left=["109/100", "23/20"]),
    "a wider gap": witness("horseshoe-1", left=["11/10", "57/50"]),
    "I0 and I1 overlap": witness("horseshoe-1", left=["11/10", "13/10"]),
    "no escape": witness("horseshoe-1", proof=["slope-range-1", "slope-range-2"]),
    "no slopes on I1": witness("horseshoe-1", proof=["slope-range-1", "avoids-1"]),
    "no steps": witness("horseshoe-1", proof=[]),
    "a step of another rule": witness("horseshoe-1", proof=["first-impact-1"]),
    "another phase": witness("itinerary-1", phase="28/25"),
    "the fixed point's side": witness("itinerary-1", phase="11/10"),
    "orbit without slopes": witness("itinerary-1", slopes=[]),
    "orbit in no horseshoe": witness("itinerary-1", horseshoe="avoids-1"),
    "closer phases": witness("itinerary-2", phase="89/80"),
    "another L": witness("excess-1", word="10"),
    "no word": witness("excess-1", word=""),
    "letters": witness("excess-1", word="12"),
    "epsilon too large": witness("excess-1", epsilon="19/100"),
    "epsilon 0": witness("excess-1", epsilon="0"),
    "another root": witness("linear-set-1", root="moran-root-2"),
    "root of no such step": witness("linear-set-1", root="excess-1"),
    "onto after all": claim("H7", verdict=always("VERIFIED")),
    "chaos denied": claim("H8", verdict=always("REFUTED")),
    "another word": claim("H7", witness=lambda text: text.replace("000", "010")),
    "a larger subshift": claim("H7", corrected=lambda text: text.replace("000", "0000")),
    "no correction": claim("H15", corrected=always(None)),
    "correction of a true claim": claim("H9", corrected=always("Lambda is empty.")),
    "another J": claim("H15", witness=lambda text: text.replace("1.112", "1.113")),
    "no orbit": claim("H8", proof=without("itinerary-1")),
    "no horseshoe": claim("H10", proof=always([])),
    "an L for one pair of ratios": claim("H14", proof=without("excess-2")),
    "statement softened": claim("H17", statement=lambda text: text.replace("keeps", "may keep")),
    "entropy tightened": claim(
        "H7", quantities=always({"growth": {"lower": "1.8393", "upper": "1.84"}})
    ),
    "dimension tightened": claim(
        "H12", quantities=always({"dimension": {"lower": "0.4489694", "upper": "0.449"}})
    ),
    "points dropped": dropped_point,
    "another eta": lambda document: document["parameters"].update(eta="53/250"),
}


@pytest.mark.parametrize("name", FORGED)
def test_forged_certificates_are_refused(proved, name):
    document = copy.deepcopy(proved)
    FORGED[name](document)
    assert document != proved
    with pytest.raises((Rejected, Malformed)):
        check(render(document))


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("slopes that do not expand", "do not expand"),
        ("a part of the gap", "no horseshoe: H4"),
        ("escape from a part of I", "no horseshoe: H4"),
        ("orbit without slopes", "not known until it leaves"),
    ],
)
def test_why_a_step_is_refused(proved, name, reason):
    document = copy.deepcopy(proved)
    FORGED[name](document)
    with pytest.raises((Rejected, Malformed), match=reason):
        check(render(document))

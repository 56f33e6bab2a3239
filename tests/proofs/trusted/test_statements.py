"""The rows of section 3.1 and H11 on conclusions made by hand: which hypotheses decide them."""

from dataclasses import replace
from fractions import Fraction

import pytest

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.images import ImageArc, image_arc
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.kernel.staying import staying_set
from proofs.trusted.numbers import (
    TURN,
    Phase,
    Phases,
    ceil_text,
    floor_text,
    show,
    show_range,
)
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper import find
from proofs.trusted.paper.s32_sets.moran import Digits, NoGap
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.slopes import Impact
from proofs.trusted.verdicts import Verdict
from tests.proofs.trusted.paper.steps import moved_to

VERIFIED, REFUTED, UNDECIDED = Verdict.VERIFIED, Verdict.REFUTED, Verdict.UNDECIDED
CONDITIONAL = Verdict.CONDITIONAL
HERE = PAPER.place
ELSEWHERE = replace(PAPER, nu=Fraction("-0.21")).place
STEEP = (("4.3", "4.31"), ("5.1", "5.11"))


def span(low, high=None):
    """An exact range; one number is a range of no width."""
    return Fraction(low), Fraction(low if high is None else high)


def phases(low, high):
    return Phases(Fraction(low), Fraction(high))


def slopes(domain, least=STEEP[0], greatest=STEEP[1], images=("1.1", "1.33"), at=HERE):
    """f on an interval: f' from least at one end to greatest at the other, and both images."""
    values = span(*least), span(*greatest)
    piece = min(x for x, _ in values), max(x for _, x in values)
    ends = tuple(Phase(*(span(*x) if isinstance(x, tuple) else span(x))) for x in images)
    return SlopeRange(PlasticMap(at), tuple(map(Fraction, domain)), values, ends, (piece,))


def both(least=STEEP[0], greatest=STEEP[1], at=HERE):
    return [slopes(x, least, greatest, at=at) for x in (("1.11", "1.15"), ("1.27", "1.32"))]


def point(phase, slope=("5", "5"), image=("3", "3"), at=HERE):
    return Impact(at, Fraction(phase), span(*slope), Phase(*span(*image)))


def avoids(gap=("1.15", "1.27"), target=("1.11", "1.32"), at=HERE):
    return Avoids(PlasticMap(at), phases(*gap), phases(*target))


def verdict(claim, found, of=PAPER):
    decision = find(claim).decide(of, found)
    assert (decision.witness is None) is (decision.verdict not in (REFUTED, CONDITIONAL))
    assert decision.why
    return decision.verdict


# -- dropped hypotheses ----------------------------------------------------------------------------


@pytest.mark.parametrize("claim", ["H1", "H2", "H3", "H5", "H6"])
def test_one_interval_is_not_both(claim):
    wide = replace(PAPER, slopes=span("4.2", "5.3"))
    assert verdict(claim, [*both(), avoids()], wide) is VERIFIED
    for known in ([], both()[:1], both()[1:], both(at=ELSEWHERE)):
        assert verdict(claim, [*known, avoids()], wide) is UNDECIDED


@pytest.mark.parametrize("claim", ["H1", "H2", "H3", "H6"])
def test_conclusions_elsewhere_refute_nothing(claim):
    steep = {"H2": ("6", "6")}.get(claim, ("-1", "-1") if claim == "H3" else ("1", "1"))
    found = point("1.13", steep, ("1.12", "1.13"))
    assert verdict(claim, [found]) is REFUTED
    assert verdict(claim, [moved_to(found, ELSEWHERE)]) is UNDECIDED


# -- H1, H2, H3, H6: slopes ------------------------------------------------------------------------


@pytest.mark.every
@pytest.mark.parametrize(
    ("claim", "least", "greatest", "expected"),
    [
        ("H1", ("4.2", "4.3"), ("5", "5"), VERIFIED),  # >= 4.2 holds at equality
        ("H1", ("4.1999999999", "4.2"), ("5", "5"), UNDECIDED),
        ("H1", ("4.1", "4.11"), ("5", "5"), UNDECIDED),  # a failed bound is not a witness
        ("H2", ("4.3", "4.3"), ("5.2", "5.25"), VERIFIED),
        ("H2", ("4.3", "4.3"), ("5.25", "5.2500000001"), UNDECIDED),
        ("H2", ("4.3", "4.3"), ("6", "6"), UNDECIDED),
        ("H3", ("0.0001", "1"), ("5", "5"), VERIFIED),
        ("H3", ("0", "1"), ("5", "5"), UNDECIDED),
        ("H3", ("-2", "-1"), ("5", "5"), UNDECIDED),
        ("H6", ("4.2", "4.3"), ("5", "5"), UNDECIDED),  # "shorter" is strict
        ("H6", ("4.2000000001", "4.3"), ("5", "5"), VERIFIED),
    ],
)
def test_slope_bounds(claim, least, greatest, expected):
    assert verdict(claim, both(least, greatest)) is expected


@pytest.mark.parametrize(
    ("claim", "slope", "expected"),
    [
        ("H1", ("4.1", "4.1999"), REFUTED),
        ("H1", ("4.1", "4.2"), UNDECIDED),
        ("H1", ("4.1", "4.3"), UNDECIDED),
        ("H2", ("5.2501", "5.3"), REFUTED),
        ("H2", ("5.25", "5.3"), UNDECIDED),
        ("H3", ("-1", "-0.0001"), REFUTED),
        ("H3", ("-1", "0"), UNDECIDED),
    ],
)
@pytest.mark.parametrize(
    ("phase", "inside"),
    [("1.13", True), ("1.3", True), ("1.11", False), ("1.15", False), ("1.2", False), ("1", False)],
)
def test_a_point_refutes_in_the_interiors_only(claim, slope, expected, phase, inside):
    assert verdict(claim, [point(phase, slope)]) is (expected if inside else UNDECIDED)


@pytest.mark.parametrize(
    ("slope", "image", "expected"),
    [
        (("4.1", "4.15"), ("1.12", "1.13"), REFUTED),
        (("4.1", "4.15"), ("1.28", "1.3"), REFUTED),
        (("4.1", "4.15"), ("1.2", "1.21"), UNDECIDED),  # lands in no J
        (("4.1", "4.15"), ("1.11", "1.12"), UNDECIDED),  # at the end of I0
        (("4.1", "4.15"), ("1.14", "1.16"), UNDECIDED),
        (("4.1", "4.2"), ("1.12", "1.13"), UNDECIDED),
        (("-4.1", "-4"), ("1.12", "1.13"), UNDECIDED),
    ],
)
def test_long_preimages(slope, image, expected):
    assert verdict("H6", [point("1.13", slope, image)]) is expected


# -- H4: the gap -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phase", "image", "expected"),
    [
        ("1.2", ("1.2", "1.3"), REFUTED),
        ("1.2", ("1.11", "1.32"), REFUTED),
        ("1.2", ("1.1", "1.2"), UNDECIDED),
        ("1.2", ("1.3", "1.33"), UNDECIDED),
        ("1.2", ("5", "5"), UNDECIDED),
        ("1.15", ("1.2", "1.3"), UNDECIDED),  # the gap is open
        ("1.27", ("1.2", "1.3"), UNDECIDED),
        ("1.13", ("1.2", "1.3"), UNDECIDED),
    ],
)
def test_gap_points(phase, image, expected):
    assert verdict("H4", [point(phase, image=image)]) is expected


@pytest.mark.parametrize(
    ("gap", "target", "avoided"),
    [
        (("1.15", "1.27"), ("1.11", "1.32"), True),
        (("1.1", "1.3"), ("1", "2"), True),
        (("1.16", "1.27"), ("1.11", "1.32"), False),
        (("1.15", "1.26"), ("1.11", "1.32"), False),
        (("1.15", "1.27"), ("1.12", "1.32"), False),
        (("1.15", "1.27"), ("1.11", "1.31"), False),
    ],
)
def test_avoiding_covers_gap_and_interval(gap, target, avoided):
    found = avoids(gap, target)
    assert verdict("H4", [found]) is (VERIFIED if avoided else UNDECIDED)
    assert verdict("H4", [moved_to(found, ELSEWHERE)]) is UNDECIDED
    if not avoided:
        assert horseshoe(*both(), found) is None


def horseshoe(left, right, gap):
    """The horseshoe on I0 and I1, None if it is not proved."""
    try:
        found = staying_set([phases("1.11", "1.32")], [left, right], [gap])
    except Unproved:
        return None
    return found if found.is_horseshoe else None


# -- H5 and the theorem: covering ------------------------------------------------------------------


def covering(images, sign=1):
    """f on I0 and I1, increasing or decreasing, with images from the first to the second end."""
    least, greatest = STEEP if sign > 0 else (("-5.1", "-5.1"), ("-4.3", "-4.3"))
    domains = ("1.11", "1.15"), ("1.27", "1.32")
    return [
        slopes(domain, least, greatest, ends[::sign])
        for domain, ends in zip(domains, images, strict=True)
    ]


COVERS = ("1.1", "1.33")


@pytest.mark.every
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("first", "escape", "expected"),
    [
        (COVERS, True, VERIFIED),
        (("1.11", "1.32"), True, VERIFIED),  # the ends may agree
        (COVERS, False, UNDECIDED),
        ((("1.1", "1.1100001"), "1.33"), True, UNDECIDED),
        (("1.1", ("1.3199999", "1.33")), True, UNDECIDED),
        (("1.33", "1.1"), True, UNDECIDED),  # the arc from 1.33 round to 1.1
        (("6.2", "1.33"), True, UNDECIDED),  # across phase 0
        (("1.2", "1.19"), True, UNDECIDED),
        (("0.0006", ("6.2739", "6.2831")), True, VERIFIED),
        (("1.1100001", "1.33"), True, REFUTED),  # [1.11, 1.1100001) has no preimage in I0
        (("1.1", "1.3199999"), True, REFUTED),
        (("1.13", "1.33"), False, REFUTED),
        (("2", "3"), True, REFUTED),
    ],
)
def test_covering(sign, first, escape, expected):
    found = [*covering((first, COVERS), sign), *([avoids()] if escape else [])]
    assert verdict("H5", found) is expected
    if expected is VERIFIED:
        made = horseshoe(*found)
        assert (made.interval, made.signs) == (PAPER.interval, (sign, sign))
        assert ("decreasing on 0, 1" in made.sentence) is (sign < 0)
    elif escape:
        assert horseshoe(*found) is None


@pytest.mark.parametrize("least", [("0", "1"), ("-1", "1")])
def test_no_covering_without_monotonicity(least):
    flat = slopes(("1.11", "1.15"), least)
    assert verdict("H5", [flat, both()[1], avoids()]) is UNDECIDED
    with pytest.raises(Unproved, match="monotone"):
        image_arc(flat)


def test_an_image_as_long_as_the_circle_is_no_arc():
    """On I0, 0.04 long, a slope up to 157.08 turns once round: 157.08 * 0.04 > 2 pi."""
    for steepest, expected in (("157.08", UNDECIDED), ("157.07", VERIFIED)):
        first = slopes(("1.11", "1.15"), greatest=("5", steepest))
        found = [first, both()[1], avoids()]
        assert verdict("H5", found) is expected
        assert verdict("H6", found[:2]) is expected


@pytest.mark.parametrize("ends", [("6.2739", "6.2841"), ("6.3", "6.4"), ("-0.1", "0.1")])
def test_an_end_that_straddles_phase_zero_is_no_phase(ends):
    with pytest.raises(Unproved, match="straddles"):
        slopes(("1.11", "1.15"), images=("0.0006", ends))


def test_covering_needs_an_interval_made_of_both_and_the_gap():
    wide = replace(PAPER, interval=span("1.1", "1.33"))
    found = covering((("1", "2"), ("1", "2")))
    assert verdict("H5", [*found, avoids(target=("1.1", "1.33"))], wide) is UNDECIDED


@pytest.mark.every
@pytest.mark.parametrize(
    ("left", "right"),
    [
        (both()[0], moved_to(both()[1], ELSEWHERE)),
        (both()[0], both()[0]),
        both(("0.9", "0.9")),
        both(("1", "1")),
    ],
)
def test_no_horseshoe(left, right):
    assert horseshoe(left, right, avoids()) is None
    assert horseshoe(*both(), avoids()) == horseshoe(*both()[::-1], avoids()) is not None


def test_cells_meet_at_ends_at_most():
    cells = [slopes(("1.11", "1.28")), both()[1]]
    with pytest.raises(Unproved, match="cells overlap"):
        staying_set([phases("1.11", "1.32")], cells, [])


def test_every_interval_of_a_region_is_covered():
    region = [phases("1.11", "1.15"), phases("1.26", "1.32")]
    with pytest.raises(Unproved, match="do not cover the region"):
        staying_set(region, [*both()], [])
    assert staying_set([region[0], phases("1.27", "1.32")], [*both()], []).full


@pytest.mark.every
@pytest.mark.parametrize(
    ("low", "high"), [("1.15", "1.11"), ("1.1", "1.1"), ("6.2", "6.3"), ("-1", "1")]
)
def test_an_interval_of_phases_is_canonical(low, high):
    with pytest.raises(Unproved):
        phases(low, high)


def test_the_arc_s_hull_is_not_what_it_covers():
    arc = ImageArc(
        PlasticMap(HERE), phases("1.11", "1.15"), Phase(*span("6.2", "6.21")), Phase(*span("1.33"))
    )
    assert not arc.is_interval and not arc.covers(span("1.11", "1.34"))
    assert arc.covers(span("1.11", "1.32"))  # around the circle; a horseshoe asks for an interval
    assert arc.misses(span("1.34", "6.1")) and not arc.misses(span("1.3", "6.1"))
    assert not arc.misses(span("1.34", "6.205"))


# -- parts of what is known ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ends", "known"),
    [
        (("1.11", "1.15"), True),
        (("1.1", "1.11", "1.13", "1.15", "1.16"), True),
        (("1.1", "1.16"), False),  # around I0, but not at its ends
        (("1.11", "1.14"), False),
        (("1.27", "1.32"), False),
    ],
)
def test_slopes_are_taken_at_the_ends_named(ends, known):
    whole = SlopeRange(
        PlasticMap(HERE),
        tuple(map(Fraction, ends)),
        (span("4.5", "4.6"),) * len(ends),
        (Phase(*span("1.1")),) * len(ends),
        (span("4.5", "4.6"),) * (len(ends) - 1),
    )
    assert (whole.over(PAPER.left) is not None) is known


def test_extremes_lie_between_pieces_and_points():
    found = SlopeRange(
        PlasticMap(HERE),
        (Fraction("1.11"), Fraction("1.13"), Fraction("1.15"), Fraction("1.2")),
        (span("4.7", "4.8"), span("5.2", "5.3"), span("6.1", "6.2"), span("9", "9")),
        (Phase(*span("1")),) * 4,
        (span("4.6", "5.4"), span("5.1", "6.3"), span("1", "99")),
    ).over(PAPER.left)
    assert (found.minimum, found.maximum) == (span("4.6", "4.8"), span("6.1", "6.3"))
    with pytest.raises(Unproved, match="order"):
        replace(found, points=(Fraction("1.11"), Fraction("1.16"), Fraction("1.15")))


# -- H11: the root and its digits ------------------------------------------------------------------


@pytest.mark.every
@pytest.mark.parametrize(
    ("value", "printed", "expected"),
    [
        (("0.44898970740667915",), "0.449", (True, False)),
        (("0.44898970740667915",), "0.448", (False, True)),
        (("0.44898970740667915",), "0.44898", (False, True)),
        (("0.44898970740667915",), "0.44899", (True, False)),
        (("0.4491",), "0.449", (True, True)),
        (("0.44898970740667915",), "0.450", (False, False)),
        (("0.44898970740667915",), "0.45", (True, False)),
        (("0.44898970740667915",), "0", (True, True)),
        (("0.4485",), "0.449", (False, False)),  # a tie is no reading
        (("0.4495",), "0.449", (False, True)),
        (("0.45",), "0.449", (False, False)),
        (("0.449",), "0.449", (True, True)),
        (("1/3",), "1/3", (True, True)),
        (("0.3333",), "1/3", (False, False)),
        # brackets: None where they hold numbers that are read so and numbers that are not
        (("0.4489", "0.4491"), "0.449", (True, None)),
        (("0.448", "0.4485"), "0.449", (False, False)),
        (("0.4484", "0.4486"), "0.449", (None, False)),
        (("0.4", "0.5"), "0.449", (None, None)),
        (("0.4485", "0.4495"), "0.449", (None, None)),
        (("0.448", "0.450"), "0.449", (None, None)),
        (("0", "10"), "0.449", (None, None)),
        (("0.3", "0.4"), "1/3", (None, None)),
    ],
)
def test_readings_of_printed_digits(value, printed, expected):
    found = Digits("s", span(*value), printed)
    assert found.readings == expected
    words = [{True: "is", False: "is not", None: "may be"}[reading] for reading in expected]
    assert found.sentence.endswith(
        f", {words[0]} {printed} if rounded, and {words[1]} if truncated."
    )


def roots(first=("0.448989", "0.44899"), second=("0.448969", "0.44897"), of=PAPER):
    pairs = zip((of.moran_ratios, of.reciprocals), (first, second), strict=True)
    return [MoranRoot(ratios, span(*root)) for ratios, root in pairs]


@pytest.mark.every
@pytest.mark.parametrize(
    ("found", "printed", "expected"),
    [
        (roots(), "0.449", CONDITIONAL),  # rounded, not truncated
        (roots(), "0.4490", CONDITIONAL),
        (roots(), "0.448", CONDITIONAL),  # truncated, not rounded
        (roots(("0.4491", "0.4492"), ("0.4493", "0.4494")), "0.449", VERIFIED),
        (roots(("0.4491", "0.4492"), ("0.4489", "0.4489")), "0.449", UNDECIDED),
        (roots(), None, VERIFIED),
        (roots(), "0.44899", UNDECIDED),  # true for the given ratios, not for the exact ones
        (roots(), "0.46", REFUTED),
        (roots(("0.4", "0.5"), ("0.4", "0.5")), "0.449", UNDECIDED),
        (roots(("0.4", "0.5"), ("0.4", "0.5")), None, VERIFIED),
        (roots()[:1], "0.449", UNDECIDED),
        (roots()[1:], "0.449", UNDECIDED),
        ([MoranRoot(x.ratios[::-1], x.root) for x in roots()], "0.449", UNDECIDED),
    ],
)
def test_moran_root(found, printed, expected):
    assert verdict("H11", found, replace(PAPER, printed_s0=printed)) is expected


OTHERS = ["0.1904 0.2381", "0.1905 0.2382", "0.3 0.4", "1/3 3/7", "4/22 5/21", "0.25 1", "0.25 3"]
RECIPROCALS = ["0.19 0.24", "0.2 0.2", "4/21 5/21", ""]  # to the places given; a fraction is exact


@pytest.mark.parametrize("ratios", [*OTHERS, *RECIPROCALS])
@pytest.mark.parametrize("printed", ["0.449", None])
def test_ratios_are_the_reciprocals(ratios, printed):
    of = replace(PAPER, ratios=span(*ratios.split()) if ratios else None, printed_s0=printed)
    if ratios in OTHERS or printed is None:
        expected = REFUTED if ratios in OTHERS else VERIFIED
        assert verdict("H11", roots(of=of), of) is expected


def test_ratios_with_a_gap_are_not_without_one():
    with pytest.raises(Unproved):
        NoGap(span("0.3", "0.69"))
    with pytest.raises(Unproved):
        NoGap(span("-1", "3"))


# -- words and numbers -----------------------------------------------------------------------------


@pytest.mark.parametrize("claim", ["H1", "H2", "H3", "H4", "H5", "H6"])
def test_statements_name_every_number_that_matters(claim):
    """Two sets of parameters never share a statement about f."""
    words = find(claim).says(PAPER)
    assert "0.2121" in words and "-0.2" in words
    assert find(claim).says(replace(PAPER, nu=Fraction(-1, 3))) != words


DECIMALS = ["0", "7", "-7", "1200", "0.2121", "-0.2", "0.05", "1/3", "-22/7", "123456789.000000001"]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        *zip(DECIMALS, DECIMALS, strict=True),
        ("1/1024", "0.0009765625"),
        ("1e-40", "0." + "0" * 39 + "1"),
        ("1e-41", "1/1" + "0" * 41),
    ],
)
def test_show(value, text):
    assert show(Fraction(value)) == text
    assert show_range((Fraction(value), Fraction(value))) == f"[{text}, {text}]"


@pytest.mark.parametrize(
    ("value", "floor", "ceiling"),
    [
        ("0.1234565", "0.123456", "0.123457"),
        ("-0.1234565", "-0.123457", "-0.123456"),
        ("1/3", "0.333333", "0.333334"),
        ("-1/3", "-0.333334", "-0.333333"),
        ("2", "2", "2"),
        ("1e-9", "0", "0.000001"),
        ("-1e-9", "-0.000001", "0"),
    ],
)
def test_printed_bounds_are_rounded_outward(value, floor, ceiling):
    assert floor_text(Fraction(value)) == floor
    assert ceil_text(Fraction(value)) == ceiling


# -- parameters ------------------------------------------------------------------------------------


@pytest.mark.every
@pytest.mark.parametrize(
    "change",
    [
        {"eta": Fraction(0)},
        {"eta": Fraction(-1)},
        {"nu": Fraction(0)},
        {"left": span("1.15", "1.11")},
        {"left": span("1.11")},
        {"left": span("1.11", "1.27")},
        {"left": span("1.11", "1.3")},
        {"left": span("1.1", "1.15")},
        {"right": span("1.27", "1.33")},
        {"left": span("1.27", "1.32"), "right": span("1.11", "1.15")},
        {"interval": span("-0.1", "1.32")},
        {"interval": span("1.11", "6.2832")},
        {"slopes": span("0", "5")},
        {"slopes": span("-4", "5")},
        {"slopes": span("5", "4")},
        {"ratios": span("0", "0.2")},
        {"ratios": span("0.3", "0.2")},
    ],
)
def test_numbers_that_describe_no_horseshoe(change):
    with pytest.raises(ValueError, match=r"^[^\n]+$"):
        replace(PAPER, **change)


def test_derived_numbers():
    assert Fraction("6.2831853") < TURN < Fraction("6.28318530717958647692")
    assert PAPER.gap == span("1.15", "1.27")
    assert PAPER.reciprocals == (Fraction(4, 21), Fraction(5, 21))
    assert PAPER.moran_ratios == span("0.1905", "0.2381")
    assert replace(PAPER, ratios=None).moran_ratios == (Fraction(4, 21), Fraction(5, 21))
    assert isinstance(PAPER, Parameters)

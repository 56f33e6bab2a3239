"""The rules that turn facts into verdicts, on facts made by hand."""

from dataclasses import replace
from fractions import Fraction

import pytest
from proofs.trusted.GONE import (
    HORSESHOE,
    STATEMENTS,
    Facts,
    decide,
    image_arcs,
    quantities,
    readings,
    theorem,
)

from proofs.trusted.numbers import TURN, ceil_text, floor_text, show, show_range
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.slopes import Impact, SlopeRange
from proofs.trusted.verdicts import Verdict

VERIFIED, REFUTED, UNDECIDED = Verdict.VERIFIED, Verdict.REFUTED, Verdict.UNDECIDED


def span(low, high=None):
    """An exact range; one number is a range of no width."""
    return Fraction(low), Fraction(low if high is None else high)


def slopes(least=("4.3", "4.31"), greatest=("5.1", "5.11")):
    """Facts about f' on both intervals."""
    return Facts(
        slope_min={0: span(*least), 1: span(*least)},
        slope_max={0: span(*greatest), 1: span(*greatest)},
    )


def covering(first=("1.1", "1.33"), second=("1.1", "1.33"), avoided=True, sign=1):
    """Facts about increasing (or decreasing) branches whose images have these ends."""
    facts = slopes() if sign > 0 else slopes(("-5.1", "-5.1"), ("-4.3", "-4.3"))
    for index, (low, high) in enumerate((first, second)):
        ends = (span(low), span(high))
        facts.images[index] = ends if sign > 0 else ends[::-1]
    facts.avoided = avoided
    return facts


def point(phase, slope=("5", "5"), image=("3", "3")):
    return Facts(points=[Impact(Fraction(phase), span(*slope), span(*image))])


def verdict(claim, facts, of=PAPER):
    return decide(claim, of, facts)[0]


# -- nothing known ---------------------------------------------------------------------------------


@pytest.mark.parametrize("claim", ["H1", "H2", "H3", "H4", "H5", "H6", "H11"])
def test_without_facts_nothing_is_decided(claim):
    found, why = decide(claim, PAPER, Facts())
    assert found is UNDECIDED
    assert why


@pytest.mark.parametrize("claim", ["H1", "H2", "H3", "H6"])
@pytest.mark.parametrize("index", [0, 1])
def test_one_interval_is_not_both(claim, index):
    facts = slopes()
    del facts.slope_min[index], facts.slope_max[index]
    assert verdict(claim, facts) is UNDECIDED


@pytest.mark.parametrize("missing", ["s0", "s0_reciprocal"])
def test_one_root_is_not_both(missing):
    facts = Facts(s0=span("0.44898", "0.44899"), s0_reciprocal=span("0.44896", "0.44897"))
    setattr(facts, missing, None)
    assert verdict("H11", facts) is UNDECIDED


# -- H1, H2, H3, H6: slopes ------------------------------------------------------------------------


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
    assert verdict(claim, slopes(least, greatest)) is expected


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
    assert verdict(claim, point(phase, slope)) is (expected if inside else UNDECIDED)


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
    assert verdict("H6", point("1.13", slope, image)) is expected


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
    assert verdict("H4", point(phase, image=image)) is expected


@pytest.mark.parametrize(
    ("phases", "target", "avoided"),
    [
        (("1.15", "1.27"), ("1.11", "1.32"), True),
        (("1.1", "1.3"), ("1", "2"), True),
        (("1.16", "1.27"), ("1.11", "1.32"), False),
        (("1.15", "1.26"), ("1.11", "1.32"), False),
        (("1.15", "1.27"), ("1.12", "1.32"), False),
        (("1.15", "1.27"), ("1.11", "1.31"), False),
        (("7.43", "7.56"), ("1.11", "1.32"), False),
    ],
)
def test_avoiding_covers_gap_and_interval(phases, target, avoided):
    facts = Facts()
    facts.add_avoided(PAPER, span(*phases), span(*target))
    assert facts.avoided is avoided
    assert verdict("H4", facts) is (VERIFIED if avoided else UNDECIDED)


# -- H5: covering ----------------------------------------------------------------------------------


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("first", "second", "avoided", "expected"),
    [
        (("1.1", "1.33"), ("1.1", "1.33"), True, VERIFIED),
        (("1.11", "1.32"), ("1.11", "1.32"), True, VERIFIED),  # the ends may agree
        (("1.1", "1.33"), ("1.1", "1.33"), False, UNDECIDED),
        (("1.1100001", "1.33"), ("1.1", "1.33"), True, UNDECIDED),
        (("1.1", "1.33"), ("1.1", "1.3199999"), True, UNDECIDED),
        (("1.33", "1.1"), ("1.1", "1.33"), True, UNDECIDED),  # the arc from 1.33 round to 1.1
        (("6.2", "1.33"), ("1.1", "1.33"), True, UNDECIDED),  # across phase 0
        (("0", "1.2"), ("1.1", "1.33"), True, UNDECIDED),
    ],
)
def test_covering(sign, first, second, avoided, expected):
    assert verdict("H5", covering(first, second, avoided, sign)) is expected


@pytest.mark.parametrize("least", ["0", "-1"])
def test_no_covering_without_monotonicity(least):
    facts = covering()
    facts.slope_min[0] = span(least, "1")
    assert image_arcs(PAPER, facts)[0] is None
    assert verdict("H5", facts) is UNDECIDED


@pytest.mark.parametrize("index", [0, 1])
def test_no_covering_without_images(index):
    facts = covering()
    del facts.images[index]
    assert verdict("H5", facts) is UNDECIDED


def test_an_image_as_long_as_the_circle_is_no_arc():
    """On I0, 0.04 long, a slope up to 157.08 turns once round: 157.08 * 0.04 > 2 pi."""
    facts = covering()
    facts.slope_max[0] = span("5", "157.08")
    assert verdict("H5", facts) is UNDECIDED
    facts.slope_max[0] = span("5", "157.07")
    assert verdict("H5", facts) is VERIFIED


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("top", [("6.2739", "6.2841"), ("6.2831", "6.2838"), ("6.3", "6.4")])
def test_a_short_image_across_phase_zero_does_not_cover(sign, top):
    """f from 2 pi + 0.0006 to 2 pi + 0.0010, the second enclosed from before 2 pi on."""
    facts = covering(sign=sign)
    ends = (span("0.0006", "0.0007"), span(*top))
    facts.images[0] = ends if sign > 0 else ends[::-1]
    assert verdict("H5", facts) is UNDECIDED


def test_covering_needs_an_interval_made_of_both_and_the_gap():
    wide = replace(PAPER, interval=span("1.1", "1.32"))
    assert verdict("H5", covering(("1", "2"), ("1", "2")), wide) is UNDECIDED


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    ("missed", "expected"),
    [
        (("1.11", "1.12"), REFUTED),
        (("1.11", "1.129"), REFUTED),
        (("1.11", "1.13"), UNDECIDED),  # reaches the image
        (("1.12", "1.12"), UNDECIDED),  # of no length
        (("1.16", "1.2"), UNDECIDED),  # in neither interval
        (("1.1", "1.12"), UNDECIDED),
        (("1.31", "1.32"), UNDECIDED),  # inside both images
    ],
)
def test_missed_intervals(sign, missed, expected):
    facts = covering(("1.13", "1.33"), ("1.1", "1.33"), sign=sign)
    facts.missed = span(*missed)
    assert verdict("H5", facts) is expected


@pytest.mark.parametrize("image", [("6.2", "1.125"), ("1.13", "6.2832"), ("1.2", "1.19")])
def test_no_interval_is_missed_by_an_arc_that_passes_phase_zero(image):
    facts = covering(image, ("1.1", "1.33"))
    facts.missed = span("1.11", "1.12")
    assert verdict("H5", facts) is UNDECIDED


# -- taking facts ----------------------------------------------------------------------------------


def steps_of(*ends, slope=("4.5", "4.6")):
    count = len(ends)
    return SlopeRange(
        tuple(map(Fraction, ends)),
        tuple(span("4.5", "4.6") for _ in range(count)),
        tuple(span("1.1", "1.1") for _ in range(count)),
        tuple(span(*slope) for _ in range(count - 1)),
    )


@pytest.mark.parametrize(
    ("ends", "known"),
    [
        (("1.11", "1.15"), {0}),
        (("1.1", "1.11", "1.13", "1.15", "1.16"), {0}),
        (("1.1", "1.16"), set()),  # around I0, but not at its ends
        (("1.11", "1.14"), set()),
        (("1.27", "1.32"), {1}),
        (("1.11", "1.15", "1.27", "1.32"), {0, 1}),
    ],
)
def test_slopes_are_taken_at_the_ends_named(ends, known):
    facts = Facts()
    facts.add_slopes(PAPER, steps_of(*ends))
    assert set(facts.slope_min) == set(facts.slope_max) == set(facts.images) == known


def test_extremes_lie_between_pieces_and_points():
    found = SlopeRange(
        (Fraction("1.11"), Fraction("1.13"), Fraction("1.15"), Fraction("1.2")),
        (span("4.7", "4.8"), span("5.2", "5.3"), span("6.1", "6.2"), span("9", "9")),
        tuple(span("1") for _ in range(4)),
        (span("4.6", "5.4"), span("5.1", "6.3"), span("1", "99")),
    )
    facts = Facts()
    facts.add_slopes(PAPER, found)
    assert facts.slope_min[0] == span("4.6", "4.8")
    assert facts.slope_max[0] == span("6.1", "6.3")


def test_roots_are_taken_for_their_ratios_only():
    facts = Facts()
    facts.add_root(PAPER, span("0.2381", "0.1905"), span("0.4", "0.5"))
    facts.add_root(PAPER, span("0.19", "0.24"), span("0.4", "0.5"))
    assert facts.s0 is None and facts.s0_reciprocal is None
    facts.add_root(PAPER, span("0.1905", "0.2381"), span("0.4", "0.5"))
    assert facts.s0 is not None and facts.s0_reciprocal is None
    facts.add_root(PAPER, (Fraction(4, 21), Fraction(5, 21)), span("0.4", "0.5"))
    assert facts.s0_reciprocal is not None


# -- H11 and H16: ratios ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("root", "printed", "expected"),
    [
        ("0.44898970740667915", "0.449", (True, False)),
        ("0.44898970740667915", "0.448", (False, True)),
        ("0.44898970740667915", "0.44898", (False, True)),
        ("0.44898970740667915", "0.44899", (True, False)),
        ("0.4491", "0.449", (True, True)),
        ("0.44898970740667915", "0.450", (False, False)),
        ("0.44898970740667915", "0.45", (True, False)),
        ("0.44898970740667915", "0", (True, True)),
        ("0.4485", "0.449", (False, False)),  # a tie is no reading
        ("0.4495", "0.449", (False, True)),
        ("0.45", "0.449", (False, False)),
        ("0.449", "0.449", (True, True)),
    ],
)
def test_readings_of_printed_digits(root, printed, expected):
    assert readings(span(root), printed) == expected


@pytest.mark.parametrize(
    ("root", "expected"),
    [
        (("0.4489", "0.4491"), (True, None)),
        (("0.448", "0.4485"), (False, False)),
        (("0.4484", "0.4486"), (None, False)),
        (("0.4", "0.5"), (None, None)),  # both ends outside, the digits' numbers inside
        (("0.4485", "0.4495"), (None, None)),
        (("0.448", "0.450"), (None, None)),
        (("0", "10"), (None, None)),
    ],
)
def test_readings_of_a_bracket(root, expected):
    """None where the bracket holds numbers that are read so and numbers that are not."""
    assert readings(span(*root), "0.449") == expected


def roots(first=("0.448989", "0.44899"), second=("0.448969", "0.44897")):
    return Facts(s0=span(*first), s0_reciprocal=span(*second))


@pytest.mark.parametrize(
    ("facts", "printed", "expected"),
    [
        (roots(), "0.449", VERIFIED),
        (roots(), None, VERIFIED),
        (roots(), "0.4490", VERIFIED),
        (roots(), "0.44899", UNDECIDED),  # true for the given ratios, not for the exact ones
        (roots(), "0.46", REFUTED),
        (roots(("0.4", "0.5"), ("0.4", "0.5")), "0.449", UNDECIDED),
        (roots(("0.4", "0.5"), ("0.4", "0.5")), None, VERIFIED),
    ],
)
def test_moran_root(facts, printed, expected):
    assert verdict("H11", facts, replace(PAPER, printed_s0=printed)) is expected


@pytest.mark.parametrize(
    "ratios",
    [
        ("0.1904", "0.2381"),
        ("0.1905", "0.2382"),
        ("0.3", "0.4"),
        ("1/3", "3/7"),  # no decimals: no places to round to
        ("4/22", "5/21"),
        ("0.25", "1"),
        ("0.25", "3"),
    ],
)
@pytest.mark.parametrize("printed", ["0.449", None])
def test_ratios_that_are_not_the_reciprocals(ratios, printed):
    of = replace(PAPER, ratios=span(*ratios), printed_s0=printed)
    assert verdict("H11", roots(), of) is not VERIFIED


@pytest.mark.parametrize("ratios", [("0.19", "0.24"), ("0.2", "0.2"), ("4/21", "5/21"), None])
def test_ratios_to_the_places_given(ratios):
    of = replace(PAPER, ratios=ratios and span(*ratios), printed_s0=None)
    assert verdict("H11", roots(), of) is VERIFIED


@pytest.mark.parametrize(
    ("ratios", "expected"),
    [
        (("0.1905", "0.2381"), VERIFIED),
        (("0.3", "0.69999"), VERIFIED),
        (("0.3", "0.7"), REFUTED),  # s_0 = 1: q is constant
        (("0.5", "0.6"), REFUTED),
        (("0.5", "1"), REFUTED),
        (("2", "3"), REFUTED),
    ],
)
def test_gap_function(ratios, expected):
    assert verdict("H16", Facts(), replace(PAPER, ratios=span(*ratios))) is expected


def test_gap_function_against_values():
    """q(x) = ((1 - eta1)/eta0 + x)^s - 1 - x^s at the two sides of eta0 + eta1 = 1."""
    for eta0, eta1, falls in ((0.1905, 0.2381, True), (0.5, 0.6, False)):
        low, high = 0.0, 50.0
        for _ in range(100):
            s = (low + high) / 2
            low, high = (s, high) if eta0**s + eta1**s > 1 else (low, s)

        def q(x, s=low, eta0=eta0, eta1=eta1):
            return ((1 - eta1) / eta0 + x) ** s - 1 - x**s

        assert (q(0.5) > q(1) > q(3)) is falls
        assert abs(q(eta1 / eta0)) < 1e-12


# -- quantities and words --------------------------------------------------------------------------


def test_quantities_are_those_of_the_claim():
    facts = covering()
    facts.s0, facts.s0_reciprocal = span("0.4"), span("0.5")
    assert set(quantities("H1", facts)) == {"slope_min_I0", "slope_min_I1"}
    assert set(quantities("H2", facts)) == {"slope_max_I0", "slope_max_I1"}
    assert set(quantities("H4", facts)) == set()
    assert quantities("H5", facts)["image_right_I1"] == span("1.33")
    assert set(quantities("H11", facts)) == {"s0", "s0_reciprocal_slopes"}
    assert all(quantities(claim, Facts()) == {} for claim in STATEMENTS)


@pytest.mark.parametrize("claim", HORSESHOE)
def test_statements_name_every_number_that_matters(claim):
    """Two sets of parameters never share a statement about f."""
    words = STATEMENTS[claim].says(PAPER)
    assert "0.2121" in words and "-0.2" in words
    other = replace(PAPER, nu=Fraction(-1, 3))
    assert STATEMENTS[claim].says(other) != words
    assert theorem(other) != theorem(PAPER)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("0", "0"),
        ("7", "7"),
        ("-7", "-7"),
        ("1200", "1200"),
        ("0.2121", "0.2121"),
        ("-0.2", "-0.2"),
        ("1/3", "1/3"),
        ("-22/7", "-22/7"),
        ("0.05", "0.05"),
        ("1/1024", "0.0009765625"),
        ("1e-40", "0." + "0" * 39 + "1"),
        ("1e-41", "1/1" + "0" * 41),
        ("123456789.000000001", "123456789.000000001"),
    ],
)
def test_show(value, text):
    assert show(Fraction(value)) == text


def test_show_range():
    assert show_range(span("1.11", "1.32")) == "[1.11, 1.32]"


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


def test_turn_is_just_below_two_pi():
    assert Fraction("6.2831853") < TURN < Fraction("6.28318530717958647692")


def test_derived_numbers():
    assert PAPER.gap == span("1.15", "1.27")
    assert PAPER.reciprocals == (Fraction(4, 21), Fraction(5, 21))
    assert PAPER.moran_ratios == span("0.1905", "0.2381")
    assert replace(PAPER, ratios=None).moran_ratios == (Fraction(4, 21), Fraction(5, 21))
    assert isinstance(PAPER, Parameters)

"""Rule `dimension`: a true witness is taken, an edited one is not."""

import copy
from dataclasses import replace
from fractions import Fraction
from functools import cache, reduce
from operator import getitem

import pytest
from mpmath import findroot, mp, mpf

from proofs.motion.system import System
from proofs.motion.witness import HORIZON
from proofs.search import s32_dimension as dimension
from proofs.search.steps import Prover
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, rational
from proofs.trusted.kernel.complexes import Ellipse
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.numbers import Phases
from proofs.trusted.paper.s32_sets.dimension import FULL, WITHOUT_000
from proofs.trusted.paper.s32_sets.inverses import Inverses, Letter
from proofs.trusted.paper.s32_sets.repeller import Repeller, _read
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import find_rule
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.steps import derive

DIGITS = 5
HULL = Phases(Fraction("1.1"), Fraction("1.32"))
DOMAINS = Phases(HULL[0], Fraction("1.15")), Phases(Fraction("1.27"), HULL[1])
DIMENSION = Fraction("0.425083744300103")  # see test_dimension: periodic orbits


@cache
def proved(words=FULL, hull=HULL):
    """The steps of the full horseshoe, the name of its own, and its conclusion."""
    prover = Prover(System(PAPER.eta, PAPER.nu), DIGITS, HORIZON)
    run = dimension._Run(PAPER, prover, DIGITS, lambda stage: None)
    name, found = run.repeller(hull, DOMAINS, words)
    return prover.steps, name, found


@cache
def branches():
    steps, name, _ = proved()
    return derive({other: step for other, step in steps.items() if other != name})


def witness():
    steps, name, _ = proved()
    return copy.deepcopy(steps[name]["witness"])


def conclude(given, known=None):
    context = Context(PAPER, {}, branches() if known is None else known)
    return find_rule("dimension")(context, Reader(given))


@pytest.mark.slow
def test_the_conclusion_is_the_prover_s():
    found, own = conclude(witness()), proved()[2]
    assert found == own
    low, high = found.dimension
    assert low < DIMENSION < high < low + Fraction(1, 10**DIGITS)
    assert found.growth[0] < 1 < found.growth[1]


def dimension_read(given):
    return _read(Context(PAPER, {}, branches()), Reader(given))


def at(*path):
    """An edit of the number at a path in the witness."""

    def edit(change):
        def apply(given):
            *rest, last = path
            inner = reduce(getitem, rest, given)
            inner[last] = change(inner[last])

        return apply

    return edit


def put(**fields):
    return lambda given: given.update(fields)


def of_words(*words):
    """Other words, with paths that are right for them."""

    def apply(given):
        first, second = (path for path in given["paths"])
        later = [["113/100"], ["32/25"]]
        ends = sorted({word[k:] for word in words for k in range(len(word))}, key=len)
        known = {"0": first, "1": second}
        given["paths"] = [known.get(end, later[int(end[0])]) for end in ends]
        given["radii"] = [given["radii"][int(end[0])] for end in ends]
        given["words"] = list(words)

    return apply


NEAR, DOMAIN, ONCE = "where it is said", "in its domain", "only once"
UNPROVED = {
    "a word twice": (of_words("0", "0"), "disjoint"),
    "a word and its extension": (of_words("0", "00"), None),
    "a negative h": (put(test=["-1", "2"]), "not proved positive"),
    "an h with huge coefficients": (put(test=["1" + "0" * 900, "1" + "0" * 899] * 9), None),
    "few arcs": (put(arcs="2"), None),
    "a small radius": (at("radii", 1)(lambda text: str(Fraction(text) / 10)), NEAR),
}
WIDE = {
    "another h": at("test", 1)(lambda text: str(Fraction(text) * 1001 / 1000)),
    "few nodes": put(nodes="4"),
    "another growth": put(growth="999/1000"),
}


@pytest.mark.slow
def test_a_letter_that_ends_no_word_need_not_be_an_inverse_on_the_hull():
    """f maps I0 of the paper's I over a part of it only, so the sentence must not say all."""
    sentence = replace(proved()[2], words=WITHOUT_000, slopes=(proved()[2].slopes[0],) * 3).sentence
    assert "that f maps to them, where there are such" in sentence
    assert f"is defined for w = {', '.join(WITHOUT_000)}, with" in sentence


@pytest.mark.parametrize("name", WIDE)
def test_what_makes_the_bounds_wide(name):
    given = witness()
    WIDE[name](given)
    low, high = conclude(given).dimension
    assert low < DIMENSION < high and high - low > Fraction(10, 10**DIGITS)


@pytest.mark.parametrize("name", UNPROVED)
def test_is_not_proved(name):
    given = witness()
    edit, reason = UNPROVED[name]
    edit(given)
    with pytest.raises(Unproved, match=reason):
        conclude(given)


def test_work_is_counted():
    with metered(10**4), pytest.raises(Exhausted):
        conclude(witness())


def letter(j=0):
    return Letter(branches()[witness()["branches"][j]])


def root_at(x, turns=4, guess="1.12"):
    """The y with F(y) = x, also of complex x, by equation (10) typed by hand."""
    return findroot(
        lambda y: reference.left_side_10(mpf("0.2121"), mpf("-0.2"), y, x - y + 2 * mp.pi * turns),
        mp.mpmathify(guess),
    )


@pytest.mark.parametrize("bits", [64, 100, 140, 700])
@pytest.mark.parametrize("around", [("1.11", "1.14"), ("1.124", "1.125"), ("1.1", "1.15")])
def test_an_inverse_image_to_all_bits(bits, around):
    y = Enclosure.of(*map(Fraction, around), 64)
    value, rate = letter().inverse(rational(Fraction("1.2"), bits), y)
    with mp.workdps(bits):
        true, step = root_at(mpf("1.2")), mpf(2) ** -bits
        slope = 2 * step / (root_at(mpf("1.2") + step) - root_at(mpf("1.2") - step))
        low, high = (mpf(end.numerator) / end.denominator for end in value.range)
        assert low < true < high and high - low < mpf(2) ** (12 - bits)
        low, high = (mpf(end.numerator) / end.denominator for end in rate.range)
        assert low < slope < high and high - low < mpf(2) ** (20 - bits)


def test_without_an_inverse_image_there_is_none():
    with pytest.raises(Unproved):
        around = Enclosure.of(Fraction("1.13"), Fraction("1.15"), 64)
        letter().inverse(rational(Fraction("1.2"), 64), around)


@pytest.mark.slow
def test_branches_on_arcs_by_newton_s_method():
    """g and g' at complex numbers, by equation (10) typed by hand, are in the boxes."""
    inverses, _, by = dimension_read(witness())
    middle, half = map(float, by.ellipse.coordinates)
    for arc in by.ellipse.arcs(16)[::5]:
        found = inverses.over(arc)
        for share in (0.01, 0.5, 0.99):
            w = mp.expjpi((arc.j + share) / arc.count) * float(by.ellipse.rho)
            x = middle + half * (w + 1 / w) / 2
            for (y, rate), turns, guess in zip(found, (4, 9), (1.12, 1.29), strict=True):
                y0 = guess
                for step in range(1, 5):  # continued from the real axis
                    y0 = root_at(middle + (x - middle) * step / 4, turns, y0)
                ends = (root_at(x + sign * 1e-6, turns, y0) for sign in (1, -1))
                slope = (next(ends) - next(ends)) / 2e-6
                for box, value in ((y, y0), (rate, slope)):
                    for (low, high), part in zip(box.ranges, (value.real, value.imag), strict=True):
                        assert float(low) - 1e-7 < part < float(high) + 1e-7


def test_a_branch_of_two_letters_is_as_far_off_as_the_first_one_makes_it():
    """Paths that fit each other, both a little beside the branches: boxes hold the true ones."""
    known, *_ = dimension_read(witness())
    inner, move = known.paths["1"], Fraction(1, 2000)
    centre = float(HULL[0] + HULL[1]) / 2
    first = root_at(mpf(centre), 9, "1.29")
    second = root_at(first), root_at(first + 0.0005)
    slope = Fraction(float(second[1] - second[0])) / move
    shifted = inner[0] + move, *inner[1:]
    outer = Fraction(float(second[1])), *(slope * c for c in inner[1:])
    ellipse = Ellipse(HULL, Fraction(11, 10))
    paths = {"1": shifted, "01": outer}
    branches = Inverses(known.letters, ("1", "01"), ellipse, paths, dict.fromkeys(paths, move * 4))
    count = 128
    for arc in ellipse.arcs(count)[:: count // 4]:
        y = branches.over(arc)[1][0]
        w = mp.expjpi((arc.j + mpf(1) / 2) / count) * float(ellipse.rho)
        x = centre + float(ellipse.coordinates[1]) * (w + 1 / w) / 2
        true = root_at(root_at(x, 9, "1.29"))
        for (low, high), part in zip(y.ranges, (true.real, true.imag), strict=True):
            assert float(low) < part < float(high)


def known_with(j=0, **change):
    name = witness()["branches"][j]
    return {**branches(), name: replace(branches()[name], **change)}


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"turn": 5}, ONCE),
        ({"j": 1, "turn": 8}, ONCE),
        ({"turn": 9}, ONCE),
        ({"cuts": (Fraction("1.12"), Fraction("1.15"))}, DOMAIN),
        ({"j": 1, "cuts": (Fraction("1.27"), Fraction("1.3"))}, DOMAIN),
        # sin(eta t) > 0 for t in (0, 14) alone: in such a window f' < 0, or has no known sign
        ({"windows": ((Fraction(5), Fraction(6)),)}, ONCE),
        ({"windows": ((Fraction(14), Fraction(15)),)}, "monotone"),
        # it ends before the true impact: the gap is positive on all of it
        ({"windows": ((Fraction("25.09"), Fraction("25.10")),)}, None),
        # on a domain that f takes once around, phases may come back to the hull unseen
        ({"cuts": (Fraction(1), Fraction("1.15")), "turn": 3}, ONCE),
    ],
)
def test_another_branch_is_refused(change, reason):
    with pytest.raises(Unproved, match=reason):
        conclude(witness(), known_with(**change))


@pytest.mark.every
@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"domains": (DOMAINS[0], Phases(Fraction("1.14"), HULL[1]))}, "in order"),
        ({"slopes": ((Fraction(1), Fraction(2)), (Fraction(2), Fraction(3)))}, "to contract"),
        ({"slopes": ((Fraction(2), Fraction(3)),)}, "to contract"),
        ({"dimension": (Fraction(1), Fraction(1))}, "dimension are not in order"),
    ],
)
def test_what_is_no_repeller(change, reason):
    bounds = (Fraction(1, 3), Fraction(1, 2))
    slopes = ((Fraction(2), Fraction(3)),) * 2
    own = Repeller(PAPER.place, HULL, DOMAINS, ("0", "1"), slopes, Fraction(1), bounds, bounds)
    with pytest.raises(Unproved, match=reason):
        replace(own, **change)

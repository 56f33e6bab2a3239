"""Rule `dimension`: a true witness is taken, an edited one is not."""

import copy
from dataclasses import replace
from fractions import Fraction
from functools import cache, reduce
from operator import getitem

import pytest
from mpmath import findroot, mp, mpf

from proofs.motion.inverse import InverseBranch, InverseSystem
from proofs.search import s32_dimension as dimension
from proofs.search.repair import nearest_sets
from proofs.search.steps import Prover
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.paper.s32_sets.dimension import FULL
from proofs.trusted.paper.s32_sets.repeller import _Branch
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import find_rule
from tests.proofs.trusted.paper import reference

DIGITS = 5
SETS = next(nearest_sets(PAPER))  # I0 = [1.1, 1.15], I1 = [1.27, 1.32]
DIMENSION = Fraction("0.425083744300103")  # see test_dimension: periodic orbits


@cache
def proved():
    """The steps of the full horseshoe, the name of its own, and its conclusion."""
    prover = Prover(dimension.System(PAPER.eta, PAPER.nu), DIGITS, dimension.HORIZON)
    run = dimension._Run(PAPER, prover, DIGITS, lambda stage: None)
    name, found = run.repeller(SETS, FULL)
    return prover.steps, name, found


@cache
def flights():
    steps, name, _ = proved()
    return {
        other: find_rule(step["rule"])(Context(PAPER), Reader(step["witness"]))
        for other, step in steps.items()
        if other != name
    }


def witness():
    steps, name, _ = proved()
    return copy.deepcopy(steps[name]["witness"])


def conclude(given, known=None):
    context = Context(PAPER, {}, flights() if known is None else known)
    return find_rule("dimension")(context, Reader(given))


@pytest.mark.slow
def test_the_conclusion_is_the_prover_s():
    found, own = conclude(witness()), proved()[2]
    assert replace(found, slopes=own.slopes) == own
    low, high = found.dimension
    assert low < DIMENSION < high < low + Fraction(1, 10**DIGITS)
    for mine, other in zip(found.slopes, own.slopes, strict=True):
        assert all(abs(a - b) < Fraction(1, 20) for a, b in zip(mine, other, strict=True))


def test_wider_bounds_are_proved_too():
    given = witness()
    given["dimension"] = [str(DIMENSION - Fraction(1, 10**3)), str(DIMENSION + Fraction(1, 10**3))]
    assert conclude(given).dimension[0] == DIMENSION - Fraction(1, 10**3)


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


def add(by):
    return lambda text: str(Fraction(text) + Fraction(by))


def move_dimension(by):
    return at("dimension")(lambda ends: list(map(add(by), ends)))


def tighter(given):
    low, high = map(Fraction, given["dimension"])
    middle, width = (low + high) / 2, (high - low) / 10**9
    given["dimension"] = [str(middle - width), str(middle + width)]


def negated(given):
    given["test"] = [str(-Fraction(c)) for c in given["test"]]


def swapped(*names):
    return lambda given: [given[name].reverse() for name in names]


def true_images(words=FULL, hull=SETS.interval):
    """Other words or another hull, with their true inverse images."""

    def apply(given):
        radius = Fraction(given["radius"])
        letters = []
        for domain in (SETS.left, SETS.right):
            (impact,) = dimension.cover_by_impacts(dimension.System(PAPER.eta, PAPER.nu), domain)
            letters.append(InverseBranch(impact, domain, radius))
        system = InverseSystem(tuple(letters), hull, words, radius, 120)
        count = len(given["inverse"][0]) - 1
        found = system.centres(
            [hull[0] + (hull[1] - hull[0]) * j / count for j in range(count + 1)]
        )
        given["inverse"] = [[str(y) for y in found[suffix]] for suffix in sorted(found)]
        given["words"], given["hull"] = list(words), list(map(str, hull))

    return apply


BOUND, PLACE, ONCE = "not proved near enough", "where it is said", "only once"
UNPROVED = {
    "a hull that is a point": (put(hull=["11/10", "11/10"]), "no interval of phases"),
    "a hull beyond the circle": (put(hull=["11/10", "7"]), "no interval of phases"),
    "a word twice": (
        lambda given: given.update(words=["0", "0"], inverse=given["inverse"][:1]),
        "disjoint",
    ),
    "equal bounds": (put(dimension=["2/5", "2/5"]), "not in order"),
    "a dimension from 0": (put(dimension=["0", "17/20"]), "not in order"),
    "domains in the wrong order": (
        swapped("domains", "flights", "turns", "inverse"),
        "not in order",
    ),
    "higher": (move_dimension("1e-5"), BOUND),
    "lower": (move_dimension("-1e-5"), BOUND),
    "much higher": (move_dimension("1/10"), BOUND),
    "tighter than h allows": (tighter, BOUND),
    "another h": (at("test", 3)(add("1/1000")), BOUND),
    "an h with huge coefficients": (put(test=["1" + "0" * 900, "1" + "0" * 899] * 9), BOUND),
    "an h of the highest degree": (put(test=["2", "1/9", *["1/1000000"] * 198]), BOUND),
    "a constant h": (put(test=["1"]), BOUND),
    "a negative h": (negated, "not proved positive"),
    "an h with a zero": (put(test=["0", "1"]), "not proved positive"),
    "an inverse image moved": (at("inverse", 0, 1)(add("1e-9")), PLACE),
    "one of the other branch moved": (at("inverse", 1, 2)(add("-1e-9")), PLACE),
    "one moved far": (at("inverse", 0, 0)(add("1/100")), PLACE),
    "images of the other branch": (swapped("inverse"), PLACE),
    "a radius that rounding needs": (put(radius="1/" + str(2**150)), PLACE),
    "a large radius": (put(radius="1/100"), PLACE),
    "a turn more": (at("turns", 0)(add(1)), ONCE),
    "a turn less": (at("turns", 1)(add(-1)), ONCE),
    "turns of the other branch": (swapped("turns"), ONCE),
    "low order": (put(order="2"), BOUND),
    "a hull too wide": (put(hull=["1", "33/25"]), PLACE),
    "a hull not invariant": (true_images(hull=(Fraction("1.12"), SETS.right[1])), "leave the hull"),
    "a domain too short": (at("domains", 0, 0)(add("1/50")), PLACE),
    "overlapping images": (true_images(("0", "1", "11")), "disjoint"),
    "a word and its extension": (true_images(("0", "01")), "disjoint"),
}
MALFORMED = {
    "one word": put(words=["0"]),
    "another letter": put(words=["0", "2"]),
    "an empty word": put(words=["", "1"]),
    "a long word": put(words=["0", "1" * 17]),
    "flights swapped": swapped("flights"),
    "domains swapped": swapped("domains"),
    "a domain beyond its flight": at("domains", 0, 0)(add("-1/100")),
    "no such flight": put(flights=["first-impact-1", "first-impact-9"]),
    "half a turn": put(turns=["9/2", "9"]),
    "turns missing": put(turns=["4"]),
    "too few inverse images": at("inverse", 0)(lambda values: values[:-1]),
    "no images of a branch": at("inverse")(lambda values: values[:1]),
    "more pieces than images": put(pieces="3"),
    "half a piece": put(pieces="5/2"),
    "order 0": put(order="0"),
    "an enormous order": put(order="1000"),
    "no coefficients": put(test=[]),
    "a hull reversed": put(hull=["33/25", "11/10"]),
    "no radius": put(radius="0"),
    "a negative radius": put(radius="-1/1000"),
    "bounds reversed": swapped("dimension"),
    "a float": put(radius="1e-9"),
    "a field more": put(comment="true"),
    "a field less": lambda given: given.pop("order"),
}


@pytest.mark.parametrize("name", UNPROVED)
def test_is_not_proved(name):
    given = witness()
    edit, reason = UNPROVED[name]
    edit(given)
    with pytest.raises(Unproved, match=reason):
        conclude(given)


@pytest.mark.slow
@pytest.mark.parametrize("name", MALFORMED)
def test_is_malformed(name):
    given = witness()
    MALFORMED[name](given)
    with pytest.raises(Malformed):
        conclude(given)


def test_work_is_counted():
    with metered(10**4), pytest.raises(Exhausted):
        conclude(witness())


def test_the_side_of_a_point_may_stay_undecided():
    """F(y) is 1.2 at the y below, to 30 digits: 64 bits cannot tell, 200 can."""
    flight = flights()[witness()["flights"][0]]
    eta, nu = mpf("0.2121"), mpf("-0.2")
    root = findroot(
        lambda y: reference.left_side_10(eta, nu, y, mpf("1.2") - y + 8 * mp.pi), mpf("1.12")
    )
    y, image = Fraction(mp.nstr(root, 30)), (Fraction("1.2"),) * 2
    more, less = y + Fraction(1, 10**28), y - Fraction(1, 10**28)
    for bits, above, below in ((64, 0, 0), (200, 1, -1)):
        branch = _Branch(flight, SETS.left, 4, bits)
        assert branch.excess(more, image) == above and branch.excess(less, image) == below
        assert branch.brackets((less, more), image) is (bits == 200)
        assert branch.brackets((less, more + 1), image) is False
    wide = (Fraction("1.19"), Fraction("1.21"))
    assert branch.excess(y, wide) == 0 and not branch.brackets((less, more), wide)


def known_with(**change):
    name = witness()["flights"][0]
    return {**flights(), name: replace(flights()[name], **change)}


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"transversal": False}, "transversal"),
        # sin(eta t) > 0 for t in (0, 14): in such a window f' < 0
        ({"windows": ((Fraction(5), Fraction(6)),)}, "increase"),
        # it ends before the true impact: the gap is positive on all of it
        ({"windows": ((Fraction("25.09"), Fraction("25.10")),)}, None),
    ],
)
def test_another_flight_is_refused(change, reason):
    with pytest.raises(Unproved, match=reason):
        conclude(witness(), known_with(**change))


def test_f_may_not_pass_the_hull_twice():
    """On a domain that f takes once around, phases may come back to the hull unseen."""
    given = witness()
    motion = flights()[given["flights"][0]].motion
    longer = replace(motion, phases=(Fraction("0.9"), Fraction("1.15")))
    given["domains"][0] = ["1", "23/20"]
    given["turns"][0] = "3"
    with pytest.raises(Unproved, match="once"):
        conclude(given, known_with(motion=longer))

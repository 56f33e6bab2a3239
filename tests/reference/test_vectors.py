"""Interval, arrays and Decorated on the vectors of ITF1788: ranges, relations, numbers, texts.

An enclosure of a true range contains the vector as soon as its ends are rounded outward to
binary64, since the vector has the nearest numbers. It is tight if it is the vector then. Where an
operand leaves the natural domain, all but Decorated must refuse. OverflowError may be raised where
the vector ends next to the largest number, or beyond.
"""

from collections import Counter
from fractions import Fraction
from math import inf, nextafter
from operator import add, matmul, methodcaller, mul, neg, pos, sub, truediv

import pytest

from intervals import Decorated, Decoration, DomainError, Interval, IntervalArray, TightArray
from tests.intervals.oracle import DOMAINS, FUNCTIONS, quarter_turns
from tests.reference.vectors import Box, statement, statements

pytestmark = pytest.mark.slow
MAX = nextafter(inf, 0)
NAMES = {"roundTiesToEven": "round_ties_to_even", "roundTiesToAway": "round_ties_to_away"}
ALIKE = [*FUNCTIONS, "sqr", "sign", "floor", "ceil", "trunc", "recip", "fma", "minimum", "maximum"]
OPERATIONS = {
    **{name: lambda x, *y, name=name: getattr(x, name)(*y) for name in ALIKE},
    **{name: methodcaller(method) for name, method in NAMES.items()},
    **{"pos": pos, "neg": neg, "abs": abs, "add": add, "sub": sub, "mul": mul, "div": truediv},
    "pown": lambda x, n: x ** int(n),
    "logp1": lambda x: x.log1p(),
    "min": lambda x, y: x.minimum(y),
    "max": lambda x, y: x.maximum(y),
    "convexHull": lambda x, y: x.hull(y),
    "intersection": lambda x, y: x.intersection(y),
    "cancelMinus": lambda x, y: x.cancel_minus(y),
    "cancelPlus": lambda x, y: x.cancel_plus(y),
}


# -- where operations are defined, told by the operands alone --------------------------------------


def holds_zero(x):
    return x.lower <= 0 <= x.upper


def between_poles(x):
    """No odd multiple of pi/2 lies in x: the quarter turn before each end is the same, or even."""
    if not x.bounded:
        return False
    low, high = (quarter_turns(Fraction(end)) for end in x[:2])
    return (low + 1) // 2 == (high + 1) // 2


DEFINED = {  # of boxes that are not empty
    **{name: lambda x, f=f: f(x.lower) and f(x.upper) for name, f in DOMAINS.items()},
    "tan": between_poles,
    "recip": lambda x: not holds_zero(x),
    "div": lambda x, y: not holds_zero(y),
    "pown": lambda x, n: n >= 0 or not holds_zero(x),
    "pow": lambda x, y: x.lower > 0 or (x.lower == 0 and y.lower > 0),
    "atan2": lambda y, x: not (holds_zero(y) and holds_zero(x)),
}
DEFINED["logp1"] = DEFINED["log1p"]


# -- ranges ----------------------------------------------------------------------------------------


def down(x):
    """The largest binary64 number <= x, -oo if there is none."""
    try:
        nearest = float(x)
    except OverflowError:
        nearest = inf if x > 0 else -inf
    return nearest if nearest <= x else nextafter(nearest, -inf)


def text(box):
    """The set as a text, with its decoration; a bare one has the best."""
    if box.nai:
        return "[nai]"
    ends = [end if abs(end) == inf else Fraction(end) for end in box[:2]]
    body = "[empty]" if box.empty else f"[{ends[0]}, {ends[1]}]"
    return f"{body}_{box.decoration}" if box.decoration else body


def made(box, kind):
    """An operand, in a kind of numbers."""
    if not isinstance(box, Box):
        return box
    if kind is Decorated:
        return Decorated(text(box))
    if kind is Interval:
        return Interval(*map(Fraction, box[:2]))
    return kind.from_floats([box.lower], [box.upper])


def ends(found):
    """The ends of a result, rounded outward."""
    low, high = found.inf, found.sup
    if isinstance(found, IntervalArray):
        low, high = low.item(), high.item()
    return down(low), -down(-high)


def applies(vector, kind):
    """Whether its operands are sets that a kind of numbers has."""
    boxes = [x for x in vector.operands if isinstance(x, Box)]
    if vector.operation not in OPERATIONS or "midRad" in vector.operation or not boxes:
        return False
    if kind is Decorated:
        return "cancel" not in vector.operation
    is_one = "cancel" not in vector.operation or (kind is Interval)
    return is_one and all(x.bounded if kind is Interval else x.lower <= x.upper for x in boxes)


def judged(vector, kind, compute=None):
    """How a result is: tight, wider, refused, overflow; or wrong."""
    operation, (expected,) = vector.operation, vector.results
    is_inside = kind is Decorated or DEFINED.get(operation, lambda *_: True)(*vector.operands)
    try:
        found = (compute or OPERATIONS[operation])(*(made(x, kind) for x in vector.operands))
    except DomainError:
        return "wrong" if is_inside else "refused"
    except OverflowError:
        return "overflow" if max(map(abs, expected[:2])) >= MAX * (1 - 2.0**-48) else "wrong"
    if not is_inside or found is None or kind is Decorated:
        return _of_a_set(expected, found, is_inside, vector)
    bounds = ends(found)
    if not (bounds[0] <= expected.lower and expected.upper <= bounds[1]):
        return "wrong"
    return "tight" if bounds == expected[:2] else "wider"


def _of_a_set(expected, found, is_inside, vector):
    """The same for no interval, which stands for the empty set or, of `cancel`, for all numbers.

    And for Decorated: a bare vector says nothing of the decoration. Where it is unbounded beyond
    the largest number only, the result is bounded, and com where the vector is dac.
    """
    if found is None or not is_inside:
        is_none = expected.empty or expected[:2] == (-inf, inf)
        return "tight" if found is None and is_inside and is_none else "wrong"
    if expected.nai:
        return "tight" if found.decoration is Decoration.ILL else "wrong"
    bounds, decoration = ends(found), found.decoration.name.lower()
    if inf in (-expected.lower, expected.upper) and found.decoration is Decoration.COM:
        decoration = "dac"
    is_decorated = any(x.decoration for x in vector.operands if isinstance(x, Box))
    contains = bounds[0] <= expected.lower and expected.upper <= bounds[1]
    if not contains or (is_decorated and decoration != expected.decoration):
        return "wrong"
    return "tight" if bounds == expected[:2] else "wider"


EXACT = {"pos", "neg", "abs", "min", "max", "sign", "floor", "ceil", "trunc", "intersection"}
EXACT |= {"roundTiesToEven", "roundTiesToAway", "convexHull"}
ROUNDED_ONCE = {"add", "sub", "mul", "div", "sqr", "sqrt", "recip"}


def is_moderate(vector):
    boxes = [x for x in (*vector.operands, *vector.results) if isinstance(x, Box)]
    return all(end == 0 or 2.0**-900 < abs(end) < 2.0**900 for box in boxes for end in box[:2])


MUST_BE_TIGHT = {
    Interval: lambda x: x.operation != "pown" or x.operands[1] >= 0,  # else 1 / x^n
    Decorated: lambda x: x.operation not in ("pow", "atan2", "pown"),  # see intervals.decorated
    IntervalArray: lambda x: x.operation in EXACT,
    TightArray: lambda x: x.operation in EXACT | (ROUNDED_ONCE if is_moderate(x) else set()),
}


@pytest.mark.parametrize("kind", MUST_BE_TIGHT)
def test_ranges(kind):
    counts, wrong = Counter(), []
    for vector in statements():
        if applies(vector, kind):
            outcome = judged(vector, kind)
            counts[outcome] += 1
            is_right = outcome != "wrong" and (
                outcome != "wider" or not MUST_BE_TIGHT[kind](vector)
            )
            wrong += [] if is_right else [(vector, outcome)]
    assert not wrong, wrong[:9]
    assert counts["overflow"] <= 4 and counts["tight"] > 1100
    assert kind is Decorated or counts["refused"] >= 783


@pytest.mark.parametrize("kind", MUST_BE_TIGHT)
def test_a_result_that_is_an_ulp_too_narrow_is_wrong(kind):
    """Each vector that is met exactly, with an end moved outward."""
    kept = Counter()
    for vector in statements():
        if applies(vector, kind) and judged(vector, kind) == "tight":
            (box,) = vector.results
            for low, high in ((nextafter(box[0], -inf), box[1]), (box[0], nextafter(box[1], inf))):
                if low < high and (low, high) != box[:2]:
                    wider = vector._replace(results=(Box(low, high, box.decoration),))
                    kept[judged(wider, kind)] += 1
    assert kept.keys() == {"wrong"} and kept["wrong"] > 1500


def test_a_decoration_that_is_too_good_is_wrong():
    """Each vector in which something was lost, judged with a result that kept it."""
    kept = Counter()
    for vector in filter(lambda x: applies(x, Decorated), statements()):
        boxes = {x.decoration for x in vector.operands if isinstance(x, Box)}
        if boxes == {"com"} and vector.results[0].decoration in ("trv", "def"):

            def better(*operands, operation=vector.operation):
                result = OPERATIONS[operation](*operands)
                result.decoration = Decoration.DAC
                return result

            kept[judged(vector, Decorated, better)] += 1
    assert kept.keys() == {"wrong"} and kept["wrong"] > 30


@pytest.mark.parametrize("kind", [Interval, IntervalArray])
@pytest.mark.parametrize(
    ("line", "lie"),
    [
        ("exp [0.0, 1.0] = [0x1p0, 0x1.5BF0A8B14576Ap+1];", lambda x: x),
        ("sqrt [-1.0, 4.0] = [0.0, 2.0];", lambda x: x),
        ("log [0.0, 1.0] = [-infinity, 0.0];", lambda x: x),
        ("intersection [1.0, 2.0] [3.0, 4.0] = [2.0, 3.0];", lambda x, y: None),
    ],
)
def test_lies_are_wrong(kind, line, lie):
    assert judged(statement(line), kind, lie) == "wrong"


# -- relations and numbers -------------------------------------------------------------------------

RELATIONS = {
    **{name: name for name in ("equal", "subset", "interior", "less", "precedes", "disjoint")},
    **{"strictLess": "strictly_less", "strictPrecedes": "strictly_precedes"},
    **{"isSingleton": "is_singleton", "overlap": "overlap"},
}


def holds(vector, kind):
    """What a relation is, and what it should be."""
    *operands, box = (made(x, kind) for x in vector.operands)
    if vector.operation == "isMember":
        (number,) = operands
        point = Fraction(number) if kind is Interval else kind.from_floats([number])
        found = box.contains(point)
    else:
        first, *others = (*operands, box)
        found = getattr(first, RELATIONS[vector.operation])(*others)
    found = found if kind is Interval else found.item()
    return found.name.replace("_", "").lower() if vector.operation == "overlap" else found


@pytest.mark.parametrize("kind", [Interval, IntervalArray])
def test_relations(kind):
    count = 0
    for vector in statements():
        if vector.operation not in {*RELATIONS, "isMember"}:
            continue
        if all(x.bounded if isinstance(x, Box) else abs(x) < inf for x in vector.operands):
            (expected,) = vector.results
            expected = expected.lower() if isinstance(expected, str) else expected
            assert holds(vector, kind) == expected, vector
            count += 1
    assert count >= 260


def numbers_are_right(name, box, found, expected, is_exact):
    """inf, sup, mag, mig are exact; wid is no less, rad reaches both ends from mid."""
    low, high = map(Fraction, box[:2])
    if name in ("mid", "rad", "midRad"):
        middle, radius = found
        reaches = low <= middle <= high and radius >= max(middle - low, high - middle)
        return reaches and (name != "mid" or not is_exact or float(middle) == expected[0])
    if name == "wid":
        return found[0] >= high - low and (not is_exact or -down(-found[0]) == expected[0])
    return (found[0],) == expected


@pytest.mark.parametrize("kind", [Interval, IntervalArray])
def test_numbers(kind):
    count = 0
    for vector in statements():
        (box, *rest), name = vector.operands, vector.operation
        if name in ("inf", "sup", "mag", "mig", "wid", "mid", "rad", "midRad") and not rest:
            if not box.bounded:
                continue
            names = ("mid", "rad") if name in ("mid", "rad", "midRad") else (name,)
            found = [getattr(made(box, kind), each) for each in names]
            found = found if kind is Interval else [y.item() for y in found]
            found = [y if y == inf else Fraction(y) for y in found]
            right = numbers_are_right(name, box, found, vector.results, kind is Interval)
            assert right, (vector, found)
            count += 1
    assert count >= 92


def test_wrong_numbers_are_seen():
    box = Box(1.0, 5.0)
    for name, expected, lies in (
        ("wid", (4.0,), [(3,)]),
        ("mid", (3.0,), [(6, 9), (0, 9), (2, 3)]),
        ("rad", (2.0,), [(3, 1)]),
        ("sup", (5.0,), [(4,)]),
    ):
        for lie in lies:
            assert not numbers_are_right(name, box, [*map(Fraction, lie)], expected, True)


SUMS = {
    "sum_nearest": (lambda x: x.sum(), sum),
    "sum_abs_nearest": (lambda x: abs(x).sum(), lambda x: sum(map(abs, x))),
    "sum_sqr_nearest": (lambda x: x.sqr().sum(), lambda x: sum(a * a for a in x)),
    "dot_nearest": (matmul, lambda x, y: sum(map(mul, x, y))),
}


def test_sums():
    count = 0
    for vector in statements():
        if vector.operation in SUMS and all(abs(x) < inf for x in sum(vector.operands, ())):
            of_arrays, of_fractions = SUMS[vector.operation]
            exact = of_fractions(*([*map(Fraction, x)] for x in vector.operands))
            found = of_arrays(*(IntervalArray.from_floats(x) for x in vector.operands))
            assert found.contains(exact) and float(exact) == vector.results[0]
            points = [[*map(Interval, map(Fraction, x))] for x in vector.operands]
            assert vector.operation == "dot_nearest" or of_fractions(*points) == Interval(exact)
            count += 1
    assert count == 5


# -- texts, parts ----------------------------------------------------------------------------------

NOT_READ = {  # of the standard's texts
    "d-textToInterval": ("?", "0x", "e+400", "E+400", "000000000"),
    "b-textToInterval": ("0x", "e380", "000000000000000000", "E+400", "??"),
}
PARTS = {
    "newDec": lambda box: Decorated(text(box)),
    "setDec": lambda box, name: Decorated(text(box), Decoration[name.upper()]),
    "intervalPart": lambda box: Decorated(text(box)).interval,
    "decorationPart": lambda box: Decorated(text(box)).decoration.name.lower(),
    "isNaI": lambda box: Decorated(text(box)).decoration is Decoration.ILL,
    "d-textToInterval": Decorated,
    "b-textToInterval": Interval,
    "b-numsToInterval": lambda *ends: Interval(*map(Fraction, ends)),
}


@pytest.mark.parametrize("name", PARTS)
def test_constructors_and_parts(name):
    tried = 0
    for vector in (x for x in statements() if x.operation == name):
        (expected,), (first, *_) = vector.results, vector.operands
        if any(form in str(first) for form in NOT_READ.get(name, ())):
            continue
        tried += 1
        try:
            found = PARTS[name](*vector.operands)
        except (ValueError, OverflowError):  # an Interval is bounded
            unbounded = isinstance(expected, Box) and not expected.bounded
            assert vector.signal or unbounded, vector
            continue
        assert vector.signal != "UndefinedOperation" or expected.nai, vector
        if isinstance(found, Interval):
            assert ends(found) == expected[:2], vector
        elif isinstance(expected, Box):
            assert found == Decorated(text(expected)) if found is not None else expected.empty
        else:
            assert found == expected, vector
    assert tried > 5

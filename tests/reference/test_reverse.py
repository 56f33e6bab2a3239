"""The reverse operations of ITF1788 by the contractor of formulas, on arrays with infinite ends."""

from collections import Counter
from math import inf

import numpy as np
import pytest

from intervals import DomainError, Formula, IntervalArray
from intervals.contractor import contracted
from tests.reference.vectors import Box, statements

pytestmark = pytest.mark.slow

OF_ONE = {
    "sqrRev": lambda x: x.sqr(),
    "absRev": abs,
    **{f"{name}Rev": lambda x, f=name: getattr(x, f)() for name in ("sin", "cos", "tan", "cosh")},
}
OF_TWO = {  # of what is given first, and of x
    **dict.fromkeys(("mulRev", "mulRevTen"), lambda b, x: b * x),
    "powRev1": lambda b, x: x.pow(b),
    "powRev2": lambda a, x: a.pow(x),
}


def problem(statement):
    """The formula, its boxes and target, and where x is; None for what has an empty operand."""
    name, operands = statement.operation.removesuffix("Bin"), list(statement.operands)
    if any(isinstance(x, Box) and (x.nai or x.empty) for x in operands):
        return None
    given = [operands.pop(0)] if name in OF_TWO else []
    target, *rest = operands
    if name == "pownRev":
        n = int(rest.pop())
        f = lambda x: x**n  # noqa: E731
    else:
        f = OF_TWO.get(name) or OF_ONE[name]
    boxes = tuple(map(array, [*given, *(rest or [Box(-inf, inf)])]))
    return f, boxes, array(target)


def array(box):
    return IntervalArray.from_floats([box.lower], [box.upper])


LOOSE = {
    "pow_rev.itl, line 609"
}  # a^x >= 2, a in [1/4, 1/2]: x <= -1/2, but the vector has all numbers


def outcome(statement):
    """Whether the result holds the vector's, as it must; whether it is the same.

    Refused: a box over which the formula has no enclosure, such as x^-1 with 0 inside.
    """
    f, boxes, target = problem(statement)
    (expected,) = statement.results
    try:
        found, empty = contracted(Formula(f, len(boxes)), boxes, [target])
    except DomainError:
        return "refused"
    if empty.all():
        return "same" if expected.empty else "wrong"
    if expected.empty:
        return "wider"
    x, least = found[-1], array(expected)
    if not least.subset(x).all():
        return "wrong"
    return "same" if (least == x).all() else "wider"


def asked():
    """The statements of reverse operations with one result and no empty operand."""
    reverse = [s for s in statements() if "Rev" in s.operation and len(s.results) == 1]
    return [s for s in reverse if problem(s)]


def test_results_hold_those_of_the_vectors():
    outcomes = {s.place: outcome(s) for s in asked()}
    assert {place for place, kind in outcomes.items() if kind == "wrong"} == LOOSE
    kinds = Counter(outcomes.values())
    assert kinds["same"] > 600 and kinds["wider"] > 300 and kinds["refused"] < 600


def test_the_loose_vector():
    (loose,) = (s for s in asked() if s.place in LOOSE)
    f, boxes, target = problem(loose)
    (_, x), _ = contracted(Formula(f, 2), boxes, [target])
    assert x.inf == -inf and -0.5 <= x.sup < -0.5 + 1e-9


def test_a_result_that_is_too_narrow_is_wrong(monkeypatch):
    statement = next(s for s in asked() if s.operation == "sqrRev")
    assert outcome(statement) == "same"
    monkeypatch.setattr(
        "tests.reference.test_reverse.contracted",
        lambda formula, boxes, targets: ((IntervalArray([0]),), np.array([False])),
    )
    wider = statement._replace(results=(Box(-1, 1),))
    assert outcome(wider) == "wrong"

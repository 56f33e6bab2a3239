"""Decorated on the vectors of ITF1788: sets that are empty or unbounded, NaI, and decorations."""

from collections import Counter
from fractions import Fraction
from functools import cache
from math import inf

import pytest

from intervals import Decorated, Decoration
from tests.reference.itf1788_judge import down, up
from tests.reference.itf1788_operations import OPERATIONS
from tests.reference.itf1788_run import FOLDER
from tests.reference.itl import Box, binary64, read

FORWARD = {
    name: operation
    for name, operation in OPERATIONS.items()
    if operation.category == "forward" or name in ("intersection", "convexHull")
}
OTHERS = {
    "newDec": lambda box: decorated(box),
    "setDec": lambda box, name: Decorated(text(box), Decoration[name.value.upper()]),
    "intervalPart": lambda box: decorated(box).interval,
    "decorationPart": lambda box: decorated(box).decoration.name.lower(),
    "isNaI": lambda box: decorated(box).decoration is Decoration.ILL,
    "d-textToInterval": lambda words: Decorated(words.value),
}
LOOSE = {"pow", "atan2", "pown"}  # see the docstring of intervals.decorated
FORMS = ("?", "0x", "e+400", "000000000", "E+400")  # texts of the standard that are not read


def text(box):
    """The set alone, as text."""
    if box.nai:
        return "[nai]"
    return "[empty]" if box.empty else f"[{binary64(box.lower)}, {binary64(box.upper)}]"


def decorated(box):
    """The set with its decoration; a bare one has the best."""
    return Decorated(text(box) + (f"_{box.decoration}" if box.decoration else ""))


def judged(statement, function):
    """Return whether the result holds the vector's and has its decoration; whether it is the same.

    A bare vector says nothing of the decoration. Where it is unbounded beyond binary64's largest
    number only, the result is bounded, and com where the vector is dac.
    """
    (expected,) = statement.tightest
    boxes = [x for x in statement.operands if isinstance(x, Box)]
    operands = [decorated(x) if isinstance(x, Box) else int(x) for x in statement.operands]
    result = function(*operands)
    if expected.nai:
        return result.decoration is Decoration.ILL, True
    ends = down(result.inf), up(result.sup)
    wanted = binary64(expected.lower), binary64(expected.upper)
    overflow = inf in (-wanted[0], wanted[1]) and result.decoration is Decoration.COM
    found = "dac" if overflow else result.decoration.name.lower()
    right = expected.decoration == found or not any(x.decoration for x in boxes)
    return ends[0] <= wanted[0] and wanted[1] <= ends[1] and right, ends == wanted


def applies(statement):
    operands, operation = statement.operands, FORWARD.get(statement.operation)
    return (
        operation
        and [isinstance(x, Box) for x in operands] == [kind == "x" for kind in operation.kinds]
        and len(statement.tightest) == 1
        and all(isinstance(x, Box | Fraction) for x in (*operands, *statement.tightest))
    )


@cache
def statements():
    return [s for path in FOLDER.glob("*.itl") for s in read(path.read_text(encoding="utf-8"))]


@pytest.mark.slow
def test_sets_and_decorations_of_functions():
    failed, same, counts = [], Counter(), Counter()
    for statement in filter(applies, statements()):
        name = statement.operation
        try:
            right, tight = judged(statement, FORWARD[name].evaluate)
        except OverflowError:
            counts["overflow"] += 1
            continue
        failed += [] if right else [(statement.line, name)]
        same[name in LOOSE, tight] += 1
        counts["decorated" if statement.tightest[0].decoration else "bare"] += 1
    assert not failed
    assert counts["overflow"] <= 4 and counts["decorated"] > 490 and counts["bare"] > 3300
    assert not same[False, False] and same[True, False] < 200


@pytest.mark.slow
def test_a_decoration_that_is_too_good_fails():
    """Each vector in which something was lost, judged with a result that kept it."""
    kept = Counter()
    for statement in filter(applies, statements()):
        boxes = [x.decoration for x in statement.operands if isinstance(x, Box)]
        if set(boxes) == {"com"} and statement.tightest[0].decoration in ("trv", "def"):
            value = FORWARD[statement.operation].evaluate

            def better(*operands, value=value):
                result = value(*operands)
                result.decoration = Decoration.DAC
                return result

            kept[judged(statement, better)[0]] += 1
    assert kept[False] > 30 and not kept[True]


@pytest.mark.slow
@pytest.mark.parametrize("name", OTHERS)
def test_constructors_and_parts(name):
    tried = 0
    for statement in statements():
        if statement.operation != name or any(f in str(statement.operands[0]) for f in FORMS):
            continue
        (expected,), tried = statement.tightest, tried + 1
        try:
            found = OTHERS[name](*statement.operands)
        except ValueError:
            assert expected.nai or statement.operands[0].nai, statement
            continue
        except OverflowError:
            assert name == "intervalPart" and not expected.bounded
            continue
        if name == "intervalPart":
            ends = None if found is None else (found.inf, found.sup)
            assert ends == (None if expected.empty else tuple(map(binary64, expected[:2])))
        elif isinstance(expected, Box):
            assert found == decorated(expected), statement
        else:
            assert found == getattr(expected, "value", expected), statement
    assert tried > 5

"""Run statements of ITF1788 through Interval (53 bits) and IntervalArray, each to one outcome."""

from fractions import Fraction
from math import inf
from pathlib import Path
from typing import NamedTuple

from intervals import Interval, IntervalArray
from tests.reference.itf1788_judge import CONTAINED, FAILED, OVERFLOW, Case, as_numbers, judged
from tests.reference.itf1788_operations import CONSTRUCTORS, DECORATIONS, OPERATIONS, Operation
from tests.reference.itl import Box, Name, Statement, Text, binary64, interval, read

FOLDER = Path(__file__).parent / "itf1788"


class Outcome(NamedTuple):
    """Of a statement; `kind` is CONTAINED, RAISED, OVERFLOW, FAILED, or why it is not applicable.

    CONTAINED is said of Interval, and of IntervalArray unless it raised OverflowError.
    """

    statement: Statement
    category: str
    kind: str
    tight: bool = False  # of the Interval
    tight_array: bool = False
    message: str = ""


class NotApplicable(Exception):
    """Says for what reason: something that bounded nonempty intervals do not have."""


def run(statements):
    """Return the outcomes of statements, one each, in their order."""
    return [_outcome_of(statement) for statement in statements]


def outcomes_of(path):
    """Return the outcomes of the statements of a file."""
    return run(read(path.read_text(encoding="utf-8-sig", errors="replace")))


def _outcome_of(statement):
    try:
        if statement.operation in CONSTRUCTORS:
            return _constructed(statement)
        case = _case(statement)
    except NotApplicable as reason:
        return Outcome(statement, "", str(reason))
    scalar = judged(case, _attempt(_scalar, case))
    array = judged(case, _attempt(_element, case)) if case.operation.arrays else None
    return _outcome(case, scalar, array)


def _outcome(case, scalar, array):
    """Return the outcome from the verdicts on Interval and, if there is one, IntervalArray."""
    array = array or scalar._replace(tight=False)
    same = array.kind == scalar.kind or (scalar.kind, array.kind) == (CONTAINED, OVERFLOW)
    return Outcome(
        case.statement,
        case.operation.category,
        scalar.kind if same else FAILED,
        scalar.tight,
        array.tight,
        f"Interval {scalar.kind}: {scalar.message}; IntervalArray {array.kind}: {array.message}",
    )


def _attempt(compute, *arguments):
    """Return the result, or the exception that was raised: a case never stops the run."""
    try:
        return compute(*arguments)
    except Exception as error:
        return error


# -- what is applicable ------------------------------------------------------------------------


def _case(statement):
    """Return the Case of a statement; NotApplicable if it has none."""
    name = statement.operation
    for obstacle, reason in (
        (statement.problem, "not understood"),
        ("Rev" in name, "reverse"),
        (name in DECORATIONS, "decorations"),
        (name not in OPERATIONS, "not provided"),
    ):
        if obstacle:
            raise NotApplicable(reason)
    operands = tuple(map(_rounded, statement.operands))
    for operand in operands:
        _require_bounded(operand)
    operation = OPERATIONS[name]
    if len(operands) != len(operation.kinds):
        raise NotApplicable("not understood")
    operands = tuple(map(_typed, operation.kinds, operands))
    if not statement.tightest:
        raise NotApplicable("no tightest result")
    _require_results(statement, operation.category)
    return Case(statement, operation, operands, tuple(map(_rounded, statement.tightest)))


def _rounded(value):
    """Replace the numbers of a statement by what they stand for."""
    if isinstance(value, Box):
        return value._replace(lower=binary64(value.lower), upper=binary64(value.upper))
    if _is_list(value):
        return tuple(map(binary64, value))
    return value if isinstance(value, bool | Text | Name) else binary64(value)


def _is_list(value):
    return isinstance(value, tuple) and not isinstance(value, Box | Text | Name)


def _require_bounded(value):
    if isinstance(value, Box):
        if value.nai or value.empty:
            raise NotApplicable("NaI" if value.nai else "empty")
        value = (value.lower, value.upper)
    if any(isinstance(x, float) for x in (value if isinstance(value, tuple) else (value,))):
        raise NotApplicable("unbounded")


def _require_results(statement, category):
    number = Fraction | float
    kinds = {"boolean": bool | Name, "numeric": number}
    right = all(isinstance(x, kinds.get(category, Box)) for x in statement.tightest)
    if not right or len(statement.tightest) != (2 if statement.operation == "midRad" else 1):
        raise NotApplicable("not understood")


def _typed(kind, value):
    """Return an operand of a kind, an int for n; NotApplicable if it is of another."""
    number = isinstance(value, Fraction)
    if kind == "n" and number and value.denominator == 1:
        return int(value)
    if not {"x": isinstance(value, Box), "r": number, "l": _is_list(value)}.get(kind):
        raise NotApplicable("not understood")
    return value


# -- Interval and IntervalArray ----------------------------------------------------------------


def _scalar(case):
    """Return the result of Interval as plain data."""
    make = {
        "x": lambda x: Interval(x.lower, x.upper),
        "l": lambda numbers: list(map(Interval, numbers)),
    }
    operands = zip(case.operation.kinds, case.operands, strict=True)
    return as_numbers(case.operation.evaluate(*(make.get(k, _same)(x) for k, x in operands)))


def _element(case):
    """Return the result of an IntervalArray of one element as plain data."""
    make = {
        "x": lambda x: IntervalArray.from_floats([float(x.lower)], [float(x.upper)]),
        "l": lambda numbers: IntervalArray.from_floats(list(map(float, numbers))),
        "r": lambda number: IntervalArray.from_floats([float(number)]),
    }
    operands = zip(case.operation.kinds, case.operands, strict=True)
    return _plain(case.operation.evaluate(*(make.get(k, _same)(x) for k, x in operands)))


def _same(value):
    return value


def _plain(result):
    """Return plain data for a result of IntervalArray that has one element."""
    if isinstance(result, IntervalArray):
        result = result.reshape(-1)
        return as_numbers((result.inf.item(), result.sup.item()))
    if isinstance(result, tuple):
        return as_numbers(tuple(x.item() for x in result))
    return None if result is None else as_numbers(result.item())


# -- constructors ------------------------------------------------------------------------------


def _constructed(statement):
    """Judge numsToInterval and textToInterval: what denotes no interval must raise."""
    box = _denoted(statement)
    if box is not None:
        _require_bounded(box)
        if box.decoration:
            raise NotApplicable("decorations")
    inside = box is not None
    operation = Operation("constructor", "", Interval, lambda: inside, (ValueError, TypeError))
    case = Case(statement, operation, (), tuple(map(_rounded, statement.tightest)))
    scalar, array = _attempt(_interval, *statement.operands), _attempt(_pair, *statement.operands)
    if inside and isinstance(scalar, ValueError) and isinstance(statement.operands[0], Text):
        raise NotApplicable("text form")
    return _outcome(case, judged(case, scalar), judged(case, array))


def _denoted(statement):
    """Return the Box that the operands of a constructor denote, None if they denote none."""
    kinds = [Text] if "text" in statement.operation else [Fraction | float] * 2
    operands = statement.operands
    if statement.problem or len(operands) != len(kinds):
        raise NotApplicable("not understood")
    if not all(map(isinstance, operands, kinds)):
        raise NotApplicable("not understood")
    _require_results(statement, "constructor")
    if len(kinds) == 1:
        try:
            box = interval(operands[0].value)
        except ValueError:
            return None
        bare = statement.operation.startswith("b-")
        return None if bare and (box.decoration or box.nai) else box
    lower, upper = map(binary64, operands)
    return Box(lower, upper) if lower <= upper and lower < inf and upper > -inf else None


def _interval(*operands):
    if isinstance(operands[0], Text):
        return as_numbers(Interval(operands[0].value))
    return as_numbers(Interval(*map(binary64, operands)))


def _pair(*operands):
    if isinstance(operands[0], Text):
        array = IntervalArray([Interval(operands[0].value)])
    else:
        array = IntervalArray.from_floats(*([float(x)] for x in operands))
    return _plain(array)

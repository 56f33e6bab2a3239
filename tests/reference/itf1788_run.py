"""Run statements of ITF1788 through Interval (53 bits) and IntervalArray, each to one outcome."""

from fractions import Fraction
from math import inf
from typing import NamedTuple

from intervals import Interval, IntervalArray
from tests.reference.itf1788_judge import CONTAINED, FAILED, OVERFLOW, Case, as_numbers, judged
from tests.reference.itf1788_operations import CONSTRUCTORS, DECORATIONS, OPERATIONS, Operation
from tests.reference.itl import Box, Name, Statement, Text, binary64, interval


class Outcome(NamedTuple):
    """Of a statement; `kind` is CONTAINED, RAISED, OVERFLOW, FAILED, or why it is not applicable.

    CONTAINED is said of Interval, and of IntervalArray unless it raised OverflowError.
    """

    statement: Statement
    category: str
    kind: str
    tight: bool = False  # of the Interval
    tight_array: bool = False
    overflow_array: bool = False
    message: str = ""


class NotApplicable(Exception):
    """Says for what reason: something that bounded nonempty intervals do not have."""


def run(statements):
    """Return the outcomes of statements, one each, in their order."""
    outcomes, cases = {}, {}
    for index, statement in enumerate(statements):
        try:
            if statement.operation in CONSTRUCTORS:
                outcomes[index] = _constructed(statement)
            else:
                cases[index] = _case(statement)
        except NotApplicable as reason:
            outcomes[index] = Outcome(statement, "", str(reason))
    arrays = _in_batches({i: case for i, case in cases.items() if case.operation.arrays})
    for index, case in cases.items():
        scalar = judged(case, _attempt(_scalar, case))
        outcomes[index] = _outcome(case, scalar, arrays.get(index))
    return [outcomes[index] for index in range(len(statements))]


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
        array.kind == OVERFLOW != scalar.kind,
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
    operands = [
        make[kind](x) if kind in make else x
        for kind, x in zip(case.operation.kinds, case.operands, strict=True)
    ]
    return as_numbers(case.operation.evaluate(*operands))


def _in_batches(cases):
    """Return the verdicts on IntervalArray: it evaluates the cases of an operation together.

    One by one come those outside the domain, sums, and the cases of a batch that raises.
    """
    batches = {}
    for index, case in cases.items():
        ints = tuple(x for x in case.operands if isinstance(x, int))
        alone = None if case.inside and "l" not in case.operation.kinds else index
        batches.setdefault((case.operation, ints, alone), []).append(index)
    verdicts = {}
    for batch in batches.values():
        results = _attempt(_elements, [cases[index] for index in batch])
        if isinstance(results, Exception):
            results = [_attempt(_element, cases[index]) for index in batch]
        for index, result in zip(batch, results, strict=True):
            verdicts[index] = judged(cases[index], result)
    return verdicts


def _element(case):
    (result,) = _elements([case])
    return result


def _elements(cases):
    """Return the results of IntervalArray, as plain data, for cases of one operation."""
    kinds = cases[0].operation.kinds
    columns = zip(*(case.operands for case in cases), strict=True)
    operands = [_array(kind, column) for kind, column in zip(kinds, columns, strict=True)]
    return _listed(cases[0].operation.evaluate(*operands), len(cases))


def _array(kind, values):
    if kind == "n":
        return values[0]
    if kind == "x":
        lower, upper = zip(*((float(x.lower), float(x.upper)) for x in values), strict=True)
        return IntervalArray.from_floats(lower, upper)
    return IntervalArray.from_floats(list(map(float, values[0] if kind == "l" else values)))


def _listed(result, count):
    """Return plain data for each element of a result of IntervalArray."""
    if isinstance(result, IntervalArray):
        result = result.reshape(-1)
        return [as_numbers(x) for x in zip(result.inf.tolist(), result.sup.tolist(), strict=True)]
    if isinstance(result, tuple):
        return [as_numbers(row) for row in zip(*(x.tolist() for x in result), strict=True)]
    if result is not None:
        return list(map(as_numbers, result.tolist()))
    if count > 1:
        raise ValueError("one of the results is empty: they are to be found one by one")
    return [None]


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
    return _listed(array, 1)[0]

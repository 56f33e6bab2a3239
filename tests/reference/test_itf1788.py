"""Interval and IntervalArray on the vectors of ITF1788, and on those in the folder ITF1788_DIR."""

import os
import re
from collections import Counter
from fractions import Fraction
from functools import cache
from math import inf, nextafter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from intervals import DomainError, Interval, IntervalArray, TightArray
from tests.reference.itf1788_judge import CONTAINED, FAILED, OVERFLOW, RAISED, down, up
from tests.reference.itf1788_operations import CONSTRUCTORS, DECORATIONS, OPERATIONS
from tests.reference.itf1788_run import FOLDER, outcomes_of, run
from tests.reference.itl import Box, binary64, read

COMMITTED = sorted(FOLDER.glob("*.itl"))
OTHERS = (
    sorted(Path(os.environ["ITF1788_DIR"]).rglob("*.itl")) if "ITF1788_DIR" in os.environ else []
)
RUN = (CONTAINED, RAISED, OVERFLOW)
REASONS = {
    *("NaI", "decorations", "empty", "no tightest result", "not provided", "not understood"),
    *("reverse", "text form", "unbounded"),
}


@cache
def outcomes(path):
    return outcomes_of(path)


def named(paths):
    """Each file a case; the longest ones are slow."""
    marks = {True: [pytest.mark.slow], False: []}
    cases = [pytest.param(path, marks=marks[path.stat().st_size > 100_000]) for path in paths]
    return pytest.mark.parametrize("path", cases, ids=lambda path: path.name)


@pytest.mark.slow
@named([*COMMITTED, *OTHERS])
def test_every_case_contains_the_expected_result_or_raises(path):
    failed = [
        f"line {x.statement.line}, {x.statement.operation}: {x.message}"
        for x in outcomes(path)
        if x.kind == FAILED
    ]
    assert not failed, f"{len(failed)} of {len(outcomes(path))}:\n" + "\n".join(failed[:20])
    statements = read(path.read_text(encoding="utf-8-sig", errors="replace"))
    assert [x.statement for x in outcomes(path)] == statements
    kinds = Counter(x.kind for x in outcomes(path))
    assert set(kinds) <= {*RUN, *REASONS}
    assert kinds["not understood"] <= (0.05 * len(statements) if path in OTHERS else 0)


def test_a_folder_named_by_the_environment_has_vectors():
    assert OTHERS or "ITF1788_DIR" not in os.environ


def everything():
    return [x for path in COMMITTED for x in outcomes(path)]


@pytest.mark.slow
def test_enough_is_run_in_each_category():
    """What the files hold: fewer would mean that the reader or the runner drops cases."""
    done = Counter((x.category, x.kind) for x in everything() if x.kind in RUN)
    assert done["forward", CONTAINED] >= 970
    assert done["forward", RAISED] >= 780
    assert done["forward", OVERFLOW] <= 4
    assert done["set", CONTAINED] >= 154
    assert done["boolean", CONTAINED] >= 260
    assert done["numeric", CONTAINED] >= 97
    assert done["constructor", CONTAINED] + done["constructor", RAISED] >= 69


@pytest.mark.slow
def test_reasons_not_to_run_are_counted():
    """Counted in the texts themselves: a line with [nai], [empty] or an infinity is no case."""
    source = "\n".join(path.read_text(encoding="utf-8") for path in COMMITTED)
    reasons = Counter(x.kind for x in everything() if x.kind not in RUN)
    assert reasons["reverse"] == len(re.findall(r"^\s*\w+Rev\w* ", source, re.MULTILINE))
    decorations = r"^\s*(?:newDec|setDec|decorationPart|intervalPart|isNaI) |_(?:com|trv|da.|def)\""
    assert reasons["decorations"] <= len(re.findall(decorations, source, re.MULTILINE))
    for reason, pattern in (
        ("NaI", r"^.*\[ *nai *\].*= *"),
        ("empty", r"^.*\[(?: *empty *| *)\].*="),
        ("unbounded", r"^.*(?:inf|entire|\[,|,\]|\?\?|NaN).*="),
    ):
        lines = re.findall(pattern, source, re.MULTILINE | re.IGNORECASE)
        assert 0 < reasons[reason] <= len(lines)


def test_interval_is_tight():
    """At 53 bits, in every single case of an operation that is rounded once.

    Not so x^-n = 1/x^n and the sum of several products; rad is that of the exact midpoint.
    """
    loose = [x.statement for x in everything() if x.kind == CONTAINED and not x.tight]
    loose = [x for x in loose if x.operation not in ("rad", "midRad", "dot_nearest")]
    assert not [x for x in loose if x.operation != "pown" or x.operands[1] >= 0]


def test_array_is_tight_where_nothing_is_rounded():
    exact = {"pos", "neg", "abs", "min", "max", "sign", "floor", "ceil", "trunc", "convexHull"}
    exact |= {"roundTiesToEven", "roundTiesToAway", "intersection", "inf", "sup", "mag", "mig"}
    loose = [x for x in everything() if x.kind == CONTAINED and not x.tight_array]
    assert not [x for x in loose if x.statement.operation in exact or x.category == "boolean"]


# -- the runner is strict ----------------------------------------------------------------------


def shifted(x, step):
    """The binary64 number next to x in the direction of step."""
    value = nextafter(float(x), step)
    return Fraction(value) if abs(value) < inf else value


def spoiled(statement):
    """The statement with an expected result that is an ulp too wide below, and above."""
    (box,) = statement.tightest
    lower, upper = binary64(box.lower), binary64(box.upper)
    for wide in (Box(shifted(lower, -inf), upper), Box(lower, shifted(upper, inf))):
        if wide[:2] != (lower, upper):
            yield statement._replace(tightest=(wide,))


@pytest.mark.slow
def test_a_result_that_is_an_ulp_too_narrow_fails():
    ranges = [
        x.statement
        for x in everything()
        if x.kind == CONTAINED and x.tight and isinstance(x.statement.tightest[0], Box)
    ]
    ranges = [x for x in ranges if not x.tightest[0].empty and x.tightest[0].bounded]
    wrong = [x for statement in ranges for x in spoiled(statement)]
    kinds = Counter(x.kind for x in run(wrong))
    assert len(ranges) > 1000 and set(kinds) == {FAILED}


def kinds_of(lines):
    return [x.kind for x in run(read("testcase t {" + lines + "}"))]


def test_a_wrong_truth_or_number_fails():
    lines = """equal [1.0, 2.0] [1.0, 2.0] = false; overlap [1.0, 2.0] [3.0, 4.0] = meets;
    isMember 1.5 [1.0, 2.0] = false; intersection [1.0, 2.0] [3.0, 4.0] = [2.0, 3.0];
    sup [1.0, 2.0] = 1.0; mag [-3.0, 2.0] = 2.0; mig [1.0, 2.0] = 0.0; sum_nearest {1.0} = 2.0;
    isSingleton [1.0, 1.0] = false; b-textToInterval "[1, 2]" = [1.0, 3.0];"""
    assert kinds_of(lines) == [FAILED] * 10


def test_what_is_empty_is_none():
    lines = """intersection [1.0, 2.0] [3.0, 4.0] = [empty];
    intersection [3.0, 4.0] [1.0, 2.0] = [empty]; cancelMinus [1.0, 2.0] [3.0, 5.0] = [entire];"""
    found = run(read("testcase t {" + lines + "}"))
    assert [(x.kind, x.tight) for x in found] == [(CONTAINED, True)] * 3


def test_results_of_the_wrong_kind_are_not_understood():
    lines = """add [1.0, 1.0] [1.0, 1.0] = 2.0; sup [1.0, 2.0] = [2.0, 2.0];
    equal [1, 1] [1, 1] = 1; midRad [1.0, 1.0] = 1.0; neg [1.0, 1.0] = [-1.0, -1.0] [-1.0, -1.0];
    midRad [1, 1] [1, 1] = 1 0;
    pown [1.0, 1.0] 0.5 = [1.0, 1.0]; b-numsToInterval 1.0 = [1.0, 1.0]; sqr 1.0 = [1.0, 1.0];"""
    assert kinds_of(lines) == ["not understood"] * 9


def inside_out(_x):
    raise OverflowError


def itself(x):
    return x


WRONG = [  # an operation, what it should give, wrong versions of it
    ("wid [1.0, 5.0] = 4.0;", property(lambda x: x.sup - x.inf - 1)),
    ("mid [1.0, 5.0] = 3.0;", property(lambda x: x.sup + 1), property(lambda x: x.inf - 1)),
    ("rad [1.0, 5.0] = 2.0;", property(lambda x: (x.sup - x.inf) / 4)),
    ("exp [0.0, 1.0] = [0x1p0, 0x1.5BF0A8B14576Ap+1];", inside_out, itself, lambda _x: None),
    ("sqrt [-1.0, 4.0] = [0.0, 2.0];", itself),
    ("log [0.0, 1.0] = [-infinity, 0.0];", itself),
]


@pytest.mark.parametrize("cls", [Interval, IntervalArray])
@pytest.mark.parametrize(("line", "wrong"), [(line, wrong) for line, *wrong in WRONG])
def test_what_is_wrong_in_one_number_type_fails(cls, line, wrong, monkeypatch):
    name = line.split()[0]
    assert kinds_of(line) == [RAISED if name in ("sqrt", "log") else CONTAINED]
    for version in wrong:
        monkeypatch.setattr(cls, name, version)
        assert kinds_of(line) == [FAILED]


def test_down_and_up_are_the_neighbours():
    third = Fraction(1, 3)
    assert (down(third), up(third)) == (Fraction(1 / 3), Fraction(nextafter(1 / 3, 1)))
    tiny, huge = Fraction(2) ** -2000, Fraction(2) ** 2000
    assert (down(tiny), up(tiny), down(-tiny), up(-tiny)) == (0, 2**-1074, -(2**-1074), 0)
    assert (down(huge), up(huge)) == (2**1024 - 2**971, inf)
    assert (down(-huge), up(-huge)) == (-inf, 2**971 - 2**1024)


def test_vectors_of_another_style(tmp_path):
    """Operations and numbers as other libraries write them; what is unknown is counted."""
    text = """testcase FI_LIB.sin {
        sin [0X1.0000000000000P+0, 0X1.0000000000000P+0]
            = [0X1.AED548F090CEEP-1, 0X1.AED548F090CEFP-1];
        logp1 [0XC.4B4A6EB6B3AF0P-264, 0X1P-200] = [0XC.4B4A6EB6B3AE8P-264, 0X1P-200];
        logp1 [-0.5, 0.0] = [-0X1.62E42FEFA39F0P-1, 0.0]; logp1 [-1.0, 0.0] = [-infinity, 0.0];
        cbrt [-8.0, 27.0] = [-2.0, 3.0]; expm1 [0.0, 0.0] = [0.0, 0.0]; sec [0.0, 0.0] = [1.0, 1.0];
    }
    testcase mpfi_add { add [-4.0, +7.0] [-0x123456789abcdp-17, 3e300] = [-0x123456791abcdp-17,
        0x8f596b3002c1bp+947]; frobnicate [1.0, 2.0] = 3; add [1.0 = ;
        hypot [-3.0, 3.0] [4.0, 4.0] = [4.0, 5.0];
        exp [800.0, 800.0] = [0x1.fffffffffffffp+1023, +infinity];
        pow [1.0, 4.0] [0.5, 0.5] <= [1.0, 3.0]; }
    """
    path = tmp_path / "mpfi.itl"
    path.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode() + b"/* \xff */")
    kinds = [x.kind for x in outcomes_of(path)]
    assert kinds == [
        *(CONTAINED, CONTAINED, CONTAINED, RAISED, CONTAINED, CONTAINED, "not provided"),
        *(CONTAINED, "not provided", "not understood"),
        *(CONTAINED, CONTAINED, "no tightest result"),
    ]


LITERALS = [
    *(
        "[1.0, 2.0]",
        "[-1.0, 1e308]",
        "[0.0, 0.0]_com",
        "[empty]",
        "[nai]",
        "[entire]",
        "[1.0, inf]",
    ),
    *("1.0", "-2", "0x1p2000", "NaN", "-infinity", "{1.0, 2.0}", "{}", "true", "equals", "ill"),
    *('"[1, 2]"', '"[2, 1]"', '"x"', "3?", "2/3"),
]


@given(
    st.sampled_from([*OPERATIONS, *CONSTRUCTORS, *DECORATIONS, "mulRevToPair", "sec"]),
    st.lists(st.sampled_from(LITERALS), max_size=3),
    st.lists(st.sampled_from(LITERALS), max_size=2),
)
def test_any_statement_has_an_outcome(operation, operands, results):
    line = " ".join([operation, *operands, "=", *results, ";"])
    (outcome,) = run(read("testcase t {" + line + "}"))
    assert outcome.kind in {*RUN, FAILED, *REASONS}


# -- arrays alone: unbounded operands, and the least bounds ----------------------------------------


def arrays_of(statement, kind):
    """The operands as arrays of one element, None if one is no nonempty interval."""
    boxes = statement.operands
    if not all(isinstance(x, Box) and not (x.nai or x.empty) for x in boxes):
        return None
    ends = [(binary64(x.lower), binary64(x.upper)) for x in boxes]
    return [kind.from_floats([float(low)], [float(high)]) for low, high in ends]


def forward(kind, wanted):
    """The statements of forward operations on intervals, their results by a type of arrays."""
    for x in everything():
        operation = OPERATIONS.get(x.statement.operation)
        if not (operation and operation.category == "forward" and wanted(x)):
            continue
        operands = set(operation.kinds) == {"x"} and arrays_of(x.statement, kind)
        if operands and len(operands) == len(operation.kinds) and x.statement.tightest:
            try:
                found = operation.evaluate(*operands)
                yield x.statement, (found.inf.item(), found.sup.item())
            except DomainError:
                yield x.statement, None


@pytest.mark.slow
def test_arrays_contain_the_results_of_unbounded_intervals():
    done = Counter()
    for statement, found in forward(IntervalArray, lambda x: x.kind == "unbounded"):
        (expected,) = statement.tightest
        if found is None:  # it leaves the domain: so it does for bounded ones
            assert statement.operation in LEAVING, statement
        else:
            low, high = binary64(expected.lower), binary64(expected.upper)
            assert expected.empty or (found[0] <= low and high <= found[1]), statement
        done[statement.operation, found is None] += 1
    assert sum(n for (_, outside), n in done.items() if not outside) > 400


LEAVING = {"div", "recip", "sqrt", "log", "log2", "log10", "tan", "asin", "acos", "acosh", "atanh"}
LEAVING |= {"pow", "pown", "atan2", "log1p", "logp1", "rootn"}
TIGHT = {"add", "sub", "mul", "div", "sqr", "sqrt", "recip", "neg"}


@pytest.mark.slow
def test_tight_arrays_are_as_tight_as_the_vectors():
    count = 0
    for statement, found in forward(TightArray, lambda x: x.kind == CONTAINED):
        expected = statement.tightest[0]
        ends = [binary64(e) for e in (expected.lower, expected.upper)]
        moderate = all(e == 0 or Fraction(1, 2**900) < abs(e) < 2**900 for e in ends)
        if statement.operation in TIGHT and moderate:
            assert [*map(Fraction, found)] == ends, statement
            count += 1
    assert count > 90

"""The reader of ITF1788 on lines whose meaning is plain, and on text that is broken."""

import re
from decimal import Decimal
from fractions import Fraction
from math import inf, isnan
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.reference.itl import Box, Name, Text, binary64, interval, number, read

FOLDER = Path(__file__).parent / "itf1788"


def read_one(line):
    (statement,) = read("testcase t {" + line + "}")
    assert not statement.problem, statement.problem
    return statement


def box(lower, upper, decoration=""):
    return Box(Fraction(lower), Fraction(upper), decoration)


def test_a_file():
    text = """/* A licence; it has { and } and = [1,2]; and "quotes. */
    // testcase commented { add [1,1] [1,1] = [3,3]; }
    testcase FI_LIB.addii {
        add [0XF.FFFFFFFFFFFF8P+1020, 0XF.FFFFFFFFFFFF8P+1020] [-0X1.0000000000000P+0, -0X1P+0]
            = [0XF.FFFFFFFFFFFF0P+1020, 0XF.FFFFFFFFFFFF8P+1020]; // special; values
        //exp [-1.0, 1.0] = [0.0, 3.0];
        inf[-infinity,3.5]=-infinity;midRad [0.0,2.0] = 1.0 1.0;
    }
    # another kind of comment
    testcase mpfi_sub { #* and its block form *#
        sub [-4.0, 0x123456789p-16] [-3e300, +8] = [1, 2] <= [0, 3]; }
    """
    for variant in (text, text.replace("\n", "\r\n")):
        first, second, third, fourth = read(variant)
        assert not any(x.problem for x in (first, second, third, fourth))
        top, below = (Fraction(float.fromhex(f"0x1.{x}p1023")) for x in ("f" * 13, "f" * 12 + "e"))
        assert first[:4] == ("FI_LIB.addii", 4, "add", (Box(top, top), box(-1, -1)))
        assert first.tightest == (Box(below, top),)
        assert second[:5] == ("FI_LIB.addii", 7, "inf", (Box(-inf, Fraction(7, 2)),), (-inf,))
        assert (third.operation, third.tightest) == ("midRad", (1, 1))
        assert (fourth.testcase, fourth.line) == ("mpfi_sub", 11)
        assert fourth.operands[0] == box(-4, Fraction(0x123456789, 2**16))
        assert fourth.operands[1] == box(-3 * 10**300, 8)
        assert (fourth.tightest, fourth.accurate) == ((box(1, 2),), (box(0, 3),))


def exactly(text):
    return float(text) if "inf" in text else Fraction(text)


NUMBERS = """1=1; -0.0=0; +1.e-3=1/1000; .5=1/2; 1E+400=1e400; 0.1=1/10; 2/3=2/3; -10 / 4=-5/2;
0x1.8p+3=12; 0X1.8P+3=12; -0X.8p1=-1; 0x10000000000001p0=4503599627370497; 0xFF=255; 0x1.=1;
infinity=inf; +inf=inf; -Infinity=-inf"""


@pytest.mark.parametrize("line", NUMBERS.split(";"))
def test_numbers_are_exact(line):
    text, value = line.split("=")
    assert number(text) == exactly(value)
    assert read_one(f"op {text}={text};").operands == (exactly(value),)


def test_nan():
    assert isnan(number("NaN")) and isnan(read_one("sup [nai] = NaN;").tightest[0])


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_floats_come_back(x):
    assert number(x.hex()) == number(x.hex().upper()) == Fraction(x)
    assert number(repr(x)) == Fraction(Decimal(repr(x)))
    assert binary64(number(repr(x))) == Fraction(x)


@given(st.fractions(), st.integers(-1100, 1100))
def test_binary64_is_nearest(x, e):
    x *= Fraction(2) ** e
    y = binary64(x)
    if y not in (inf, -inf):
        assert Fraction(float(y)) == y
        step = max(Fraction(2) ** -1074, abs(y) / 2**52)
        assert abs(x - y) <= step / 2


def test_binary64_beyond_its_range():
    assert (binary64(Fraction(10**400)), binary64(Fraction(-(10**400)))) == (inf, -inf)
    assert binary64(Fraction(2**1024 - 2**970 - 1)) == 2**1024 - 2**971


INTERVALS = """[1,2]: 1 2; [ -1.5 , +0x1p1 ]_com: -3/2 2 com; [3.5]: 3.5 3.5; [empty]: inf -inf;
[ Empty ]_trv: inf -inf trv; []: inf -inf; [entire]_dac: -inf inf dac; [ENTIRE]: -inf inf;
[,]: -inf inf; [-1,]: -1 inf; [,1/3]_DEF: -inf 1/3 def; [-Inf, 2/3]: -inf 2/3; 3.56?1: 3.55 3.57;
3.56?1e2: 355 357; 3.560?2u: 3.560 3.562; 3.56?: 3.555 3.565; -10?d: -10.5 -10; -10?12: -22 2;
-10??u: -10 inf; 10?3_com: 7 13 com; 2.500?5ue4_def: 25000 25050 def"""


@pytest.mark.parametrize("line", INTERVALS.split(";"))
def test_intervals(line):
    text, value = line.strip().split(": ")
    lower, upper, *decoration = value.split()
    box = Box(exactly(lower), exactly(upper), *decoration)
    assert interval(text) == box
    assert read_one(f"op {text} {text} = {text};").operands == (box, box)


def test_nai():
    assert interval("[nai]").nai and not interval("[nai]").empty
    assert not interval("[empty]").nai and interval("[empty]").empty


NO_INTERVALS = """[ | [1,2 | 1,2] | [2,1] | [inf] | [-inf] | [inf,-inf] | [nan,1] | [1,2]_ | [a] |
[1,2]_fooo | [1,2]_ill | [empty]_com | [1,]_com | [nai]_trv | [1 2] | [1,2,3] | [-I  nf, 1.000 ] |
[-Inf, 1.0  00 ] | [1_0] | [1/0] | ?? | 1?x | 1?2? | [0x] | [1e999999999] | [0x1p999999999] |
1?e999999999 | [1.0F] | [0.1,0.2L] |"""


@pytest.mark.parametrize("text", NO_INTERVALS.split("|"))
def test_what_denotes_no_interval(text):
    with pytest.raises(ValueError):
        interval(text)


def test_other_literals():
    assert read_one('b-textToInterval "[a;b}//\\"" = [empty];').operands == (Text('[a;b}//"'),)
    assert read_one("isMember 1 [1,2] = true;").tightest == (True,)
    assert read_one("overlap [1,2] [3,4] = before;").tightest == (Name("before"),)
    assert read_one("dot {1.0, -2} {} = 3.0;").operands == ((1, -2), ())
    statement = read_one("x 1 = [empty] signal UndefinedOperation signal Other;")
    assert statement.signals == ("UndefinedOperation", "Other")


BROKEN = """add [1,2] [3,4]; | add [1,2 [3,4] = [4,6]; | = [1,2]; | add [2,1] = [1,1]; | 12 = 3; |
add [1,1] = ?; | add 1.5.2 = 1; | add 0x = 1; | add [1,2] = [1,2] | add 1x = 1; | ; | a 1F = 1;"""


@pytest.mark.parametrize("line", BROKEN.split("|"))
def test_a_broken_statement_is_told_and_does_no_harm(line):
    before, broken, after = read("testcase a { pos 1 = 1; " + line + "} testcase b { neg 1 = -1; }")
    assert broken.problem and not before.problem and not after.problem
    assert (after.testcase, after.operation) == ("b", "neg")


@given(st.text(alphabet='testcase{}[]";,=<_/*#\n 01.xpeE+-?', max_size=80))
def test_any_text_is_read(text):
    for statement in read(text):
        assert statement.problem or statement.operation


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.itl")), ids=lambda path: path.name)
def test_every_statement_of_the_vectors(path):
    """Each of them has a line of its own, and a word and an = in it."""
    lines = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL).splitlines()
    lines = [line.strip() for line in lines if "=" in line and not line.strip().startswith("//")]
    statements = read(path.read_text(encoding="utf-8"))
    assert [x.operation for x in statements] == [line.split()[0] for line in lines]
    assert not [x for x in statements if x.problem]
    assert all(x.tightest and x.testcase for x in statements)

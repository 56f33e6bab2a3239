"""The two libraries that compute for Interval: the same bits, the same exceptions."""

import os
import subprocess
import sys
from fractions import Fraction
from random import Random
from threading import Thread

import flint
import pytest

from intervals import Interval, _engine
from intervals.functions import DOMAINS
from tests.once import examples

BY_FLINT = _engine.fastest(Interval)
FUNCTIONS = [
    *("sqrt", "cbrt", "exp", "exp2", "exp10", "expm1", "log", "log2", "log10", "log1p", "floor"),
    *("sin", "cos", "sincos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh"),
    *("acosh", "atanh", "sqr", "recip", "__neg__", "__abs__", "certainly_positive"),
]
OPERATIONS = [
    *("__add__", "__sub__", "__mul__", "__truediv__", "__radd__", "__rsub__", "__rmul__"),
    *("__rtruediv__", "hypot", "atan2", "pow", "hull", "intersection", "overlap", "contains"),
    *("interior", "__lt__", "__ge__", "__eq__", "__add__", "__mul__", "__truediv__"),
]
EXTREMES = [Fraction(10) ** 30, Fraction(2) ** -3000, Fraction(2) ** 3000, Fraction(2) ** 30]


def outcome(operations, name, x, *others):
    """What an operation by one of the libraries returns or raises."""
    _engine.use(Interval, operations)
    try:
        return repr(getattr(x, name)(*others))
    except (ArithmeticError, ValueError, TypeError) as error:
        return f"{type(error).__name__}: {error}"


@pytest.fixture
def restored():
    """What computes before the test does so after it."""
    before = {name: getattr(Interval, name) for name in _engine.BY_MPMATH}
    context = flint.ctx.prec
    yield
    flint.ctx.prec = context
    _engine.use(Interval, before)


@pytest.fixture
def agree(restored):
    """A check that both libraries do the same."""

    def check(name, x, *others):
        by_flint = outcome(BY_FLINT, name, x, *others)
        assert by_flint == outcome(_engine.BY_MPMATH, name, x, *others), (name, x, others)

    return check


def number(random):
    """A rational near what is awkward: small integers, 1, powers of 2, short and long mantissas."""
    sign = random.choice((-1, 1))
    return random.choice(
        (
            lambda: Fraction(random.randrange(-5, 6)),
            lambda: Fraction(random.uniform(-3, 3)),
            lambda: Fraction(random.randrange(-9, 10), random.choice((1, 2, 4, 8, 3, 7, 10))),
            lambda: random.getrandbits(400) * Fraction(2) ** random.randrange(-500, 100),
            lambda: sign * (1 + Fraction(sign, 2 ** random.randrange(1, 300))),
            lambda: sign * Fraction(random.choice((1, 4, 9, 27, 64, 100, 1000))),
            lambda: Fraction(random.gauss(0, 1000)),
        )
    )()


def interval(random):
    """A point, a narrow or a wide interval, of some precision."""
    a = number(random)
    near = a + Fraction(1, 2 ** random.randrange(1, 200))
    b = random.choice((a, near, a + Fraction(random.random()), number(random)))
    return Interval(min(a, b), max(a, b), precision=random.choice((2, 3, 24, 53, 113, 333, 1000)))


@pytest.mark.slow
def test_the_results_are_the_same_to_the_bit(agree):
    random = Random(1)
    for _ in range(examples(1500)):
        x = interval(random)
        y = random.choice((interval(random), number(random), random.randrange(-4, 5), 0))
        for name in random.sample(FUNCTIONS, 5):
            agree(name, x)
        for name in random.sample(OPERATIONS, 5):
            agree(name, x, y)
        agree("__pow__", x, random.randrange(-6, 70))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_so_at_the_ends_of_the_domains_and_far_out(agree, name):
    domain = DOMAINS.get(name)
    ends = [Fraction(end) for end in domain[:2] if end is not None] if domain else []
    for x in [*ends, Fraction(0), Fraction(1), Fraction(-1), Fraction(1, 2), *EXTREMES]:
        for point in (x, -x):
            for width in (0, Fraction(1, 2**70), 1):
                for precision in (53, 100):
                    agree(name, Interval(point, point + width, precision=precision))


def test_a_bound_next_to_a_number_of_the_precision_is_left_to_what_settles_it(agree):
    """1 + 2^-53 x^2 ... : balls of a few bits more cannot tell on which side these values lie."""
    for k in range(20, 400, 7):
        tiny = Interval(Fraction(1, 2**k), precision=53)
        for name in ("exp", "cos", "cosh", "sin", "tan", "expm1", "atan", "tanh", "log1p"):
            agree(name, tiny)
        agree("__add__", Interval(1, precision=53), tiny)
        agree("__mul__", Interval(1, precision=53) - tiny, 1 + tiny)
        agree("__truediv__", Interval(1, precision=24), 1 + tiny)


def test_the_context_of_python_flint_is_left_alone(restored):
    flint.ctx.dps = 77
    before = flint.ctx.prec, flint.ctx.dps
    x = Interval("0.3", "0.4", precision=333)
    for name in ("exp", "sin", "log"):
        outcome(BY_FLINT, name, x)
    assert outcome(BY_FLINT, "log", -x).startswith("DomainError")
    assert outcome(BY_FLINT, "__truediv__", x, x - x).startswith("DomainError")
    outcome(BY_FLINT, "__add__", x, x)
    assert (flint.ctx.prec, flint.ctx.dps) == before


def test_threads_do_not_disturb_each_other(restored):
    """FLINT has one precision for all: each thread gets its own bits, and leaves that as it was."""
    _engine.use(Interval, BY_FLINT)
    interval, before = sys.getswitchinterval(), flint.ctx.prec

    def work(precision):
        x, results = Interval("0.3", "0.4", precision=precision), []
        for _ in range(300):
            x = (x + x.exp() / 7).sin().cbrt() / 3 + (x**3).exp2() / 9 - x * Fraction(1, 3)
            results += [x]
        return results

    precisions = (30, 60, 200, 500)
    alone = [work(precision) for precision in precisions]
    together = {}
    threads = [Thread(target=lambda p=p: together.update({p: work(p)})) for p in precisions]
    sys.setswitchinterval(1e-6)
    try:
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert [together[p] for p in precisions] == alone
    assert flint.ctx.prec == before


SCRIPT = """
import sys
{before}
from intervals import Interval
x = Interval("0.3", "0.4", precision=3333)
for _ in range({times}):
    y = x + x
print(sys.modules.get("flint") is not None, y, (x * y).exp())
"""


@pytest.mark.parametrize(
    "before, times, environment, imported",
    [
        ("", 10, {}, False),
        ("", 3000, {}, True),
        ("", 3000, {"INTERVALS_ENGINE": "mpmath"}, False),
        ("sys.modules['flint'] = None", 3000, {}, False),
    ],
    ids=["few", "many", "forced", "not installed"],
)
def test_what_is_imported(before, times, environment, imported):
    kept = {name: text for name, text in os.environ.items() if name != "INTERVALS_ENGINE"}
    script = SCRIPT.format(before=before, times=times)
    done = subprocess.run(
        [sys.executable, "-c", script],
        env=kept | environment,
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    x = Interval("0.3", "0.4", precision=3333)
    assert done.stdout.split(maxsplit=1) == [str(imported), f"{x + x} {(x * (x + x)).exp()}\n"]

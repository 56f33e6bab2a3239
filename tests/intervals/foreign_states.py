"""The public operations, and foreign states of the floating-point unit to run them in.

A state is a word that goes to fesetround, or into the control word MXCSR of x86-64.
"""

import ctypes
import platform
from contextlib import contextmanager
from fractions import Fraction
from functools import partial

import numpy as np
import pytest

from intervals import Interval, IntervalArray

_MXCSR = slice(28, 32)  # in glibc's fenv_t
STATES = {
    "nearest": ("rounding", 0x000),
    "downward": ("rounding", 0x400),
    "upward": ("rounding", 0x800),
    "toward zero": ("rounding", 0xC00),
    "flush to zero": ("flush", 0x8000),
    "denormals are zero": ("flush", 0x0040),
    "both flushes": ("flush", 0x8040),
}
x86_linux = pytest.mark.skipif(
    platform.machine() != "x86_64" or platform.system() != "Linux", reason="needs glibc on x86-64"
)
TINY = 2.0**-1074

X = IntervalArray.from_floats([1.1, 0.3, 5.0], [1.2, 0.3, 7.0])
Y = IntervalArray.from_floats([0.7, 0.1, 3.0], [0.9, 0.1, 3.5])
SMALL = IntervalArray.from_floats([TINY, -TINY, 2.0**-1040], [TINY, 3 * TINY, 2.0**-1030])
ZERO = IntervalArray.from_floats([0.0, 0.0, 0.0])
ANY_MODE = {  # hold in every rounding mode
    "from_exact": lambda: IntervalArray(["0.1", "1/3", (1, 2)]),
    "from_floats": lambda: IntervalArray.from_floats([TINY, 0.1]),
    "x + y": lambda: X + Y,
    "x - y": lambda: X - Y,
    "x * y": lambda: X * Y,
    "x / y": lambda: X / Y,
    "s + s": lambda: SMALL + SMALL,
    "s - s": lambda: SMALL - SMALL,
    "s * s": lambda: SMALL * SMALL,
    "x * s": lambda: X * SMALL,
    "3 * s": lambda: 3 * SMALL,
    "abs s": lambda: abs(SMALL),
    "x ** 3": lambda: X**3,
    "sum": lambda: X.sum(),
    "prod": lambda: Y.prod(),
    "matmul": lambda: X @ Y,
    "hull": lambda: X.hull(Y),
    "intersection": lambda: SMALL.intersection(SMALL),
    "sign": lambda: SMALL.sign(),
    "minimum": lambda: SMALL.minimum(0),
    "floor": lambda: X.floor(),
    "round": lambda: X.round_ties_to_even(),
    "sqrt": lambda: X.sqrt(),
}
RELATIONS = {  # and what is read from an array
    **{name: partial(getattr, SMALL, name) for name in ("inf", "mag", "mig")},
    "mid": lambda: SMALL.contains(IntervalArray.from_floats(SMALL.mid)),
    "repr": lambda: [repr(SMALL)],
    "str": lambda: [str(SMALL)],
    "item": lambda: [repr(SMALL[2].item())],
    "subset": lambda: SMALL.subset(ZERO),
    "positive": lambda: SMALL.certainly_positive(),
}
MULTIPRECISION = {  # on integers
    "interval": lambda: Interval.from_float(TINY) + 0,
    "interval third": lambda: Interval("1/3"),
    "interval exp": lambda: Interval("1/3").exp(),
}
_EVERYWHERE = "cbrt exp exp2 exp10 expm1 log log2 log10 log1p sin cos tan atan sinh cosh tanh asinh"
NEAREST = {  # need rounding to nearest
    "asin": lambda: (Y / 8).asin(),
    "acos": lambda: (Y / 8).acos(),
    "atanh": lambda: (Y / 8).atanh(),
    "acosh": lambda: (X + 1).acosh(),
    "atan2": lambda: X.atan2(Y),
    "hypot": lambda: X.hypot(Y),
    "pow": lambda: X.pow(Y),
} | {name: lambda name=name: getattr(X / 8, name)() for name in _EVERYWHERE.split()}
OPERATIONS = ANY_MODE | RELATIONS | MULTIPRECISION | NEAREST


def control_word(clear, add=0):
    libm = ctypes.CDLL("libm.so.6")
    state = ctypes.create_string_buffer(32)
    libm.fegetenv(state)
    word = int.from_bytes(state.raw[_MXCSR], "little") & ~clear | add
    ctypes.memmove(ctypes.addressof(state) + _MXCSR.start, word.to_bytes(4, "little"), 4)
    libm.fesetenv(state)


@contextmanager
def foreign(kind, word):
    """Set the rounding mode or the flushing of this thread, and restore the usual state."""
    if kind == "rounding":
        ctypes.CDLL("libm.so.6").fesetround(word)
    else:
        control_word(0, word)
    try:
        yield
    finally:
        ctypes.CDLL("libm.so.6").fesetround(0)
        control_word(0x8040)


def attempt(operation):
    try:
        return operation()
    except FloatingPointError as error:
        return str(error)


def written(value):
    if isinstance(value, str | list):
        return value
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Interval):
        return [[value.inf], [value.sup]]
    return [[*map(Fraction, end.ravel().tolist())] for end in (value.inf, value.sup)]


def results(state):
    """What each operation gives in a state: exact ends, a mask, or the text of the refusal."""
    with foreign(*STATES[state]):
        found = {name: attempt(operation) for name, operation in OPERATIONS.items()}
    return {name: written(value) for name, value in found.items()}

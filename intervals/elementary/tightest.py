"""The elementary functions of dyadic numbers, rounded to the next numbers of `precision` bits.

Theorem. For a dyadic x in the domain, each function returns (y_down, y_up): the largest number of
`precision` bits that is <= f(x), and the smallest that is >= f(x). They are equal if and only if
f(x) is such a number.

Proof. The kernels `exp_fixed`, `log_fixed`, `sincos_fixed`, `angle_fixed` enclose f(x) as closely
as asked; `ziv.tighten` asks for more until the bounds are settled, which happens unless f(x) is a
number of `precision` bits. Where that occurs is known, from Lindemann's theorem for transcendental
functions and from unique factorization for roots, powers and the bases 2 and 10; these values are
computed exactly. Arguments so near to 0, 1, infinity that many bits would be needed are settled by
the inequalities that each function names.
"""

from collections.abc import Callable

from intervals.elementary.algebraic import cbrt, hypot, root, sqrt
from intervals.elementary.circular import acos, asin, atan, atan2, sincos, tan
from intervals.elementary.exponential import cosh, exp, exp2, exp10, expm1, sinh, tanh
from intervals.elementary.logarithm import acosh, asinh, atanh, log, log1p, log2, log10
from intervals.elementary.power import integer_power, power
from intervals.elementary.ziv import DOWN, UP, Bounds, Raw

__all__ = [
    "DOWN",
    "FUNCTIONS",
    "UP",
    "Bounds",
    "Raw",
    "atan2",
    "exp",
    "hypot",
    "integer_power",
    "log",
    "power",
    "root",
    "sincos",
]

FUNCTIONS: dict[str, Callable[[Raw, int], Bounds]] = {
    "sqrt": sqrt,
    "cbrt": cbrt,
    "exp": exp,
    "exp2": exp2,
    "exp10": exp10,
    "expm1": expm1,
    "log": log,
    "log2": log2,
    "log10": log10,
    "log1p": log1p,
    "tan": tan,
    "asin": asin,
    "acos": acos,
    "atan": atan,
    "sinh": sinh,
    "cosh": cosh,
    "tanh": tanh,
    "asinh": asinh,
    "acosh": acosh,
    "atanh": atanh,
}

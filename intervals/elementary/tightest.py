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

from intervals.elementary import algebraic, circular, exponential, logarithm
from intervals.elementary.algebraic import hypot, root
from intervals.elementary.circular import atan2, sincos
from intervals.elementary.exponential import exp
from intervals.elementary.logarithm import log
from intervals.elementary.power import integer_power, power
from intervals.elementary.ziv import DOWN, UP, Bounds, Raw
from intervals.functions import TABLE

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
    name: getattr(module, name)
    for module in (algebraic, circular, exponential, logarithm)
    for name in TABLE
    if hasattr(module, name)
}

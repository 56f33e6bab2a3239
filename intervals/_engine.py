"""Which library computes for `Interval`: mpmath, or python-flint where it is installed.

Both give the same results, to the bit, and raise the same exceptions; FLINT is faster. With
INTERVALS_ENGINE=mpmath in the environment it stays unused. It is imported after many operations
only: fewer are done sooner without it.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any

Method = Callable[..., Any]

_REPLACED = (
    *("__add__", "__radd__", "__sub__", "__mul__", "__rmul__", "__truediv__", "__neg__", "__abs__"),
    *("__pow__", "sqr", "sqrt", "exp", "log", "sin", "cos", "sincos", "_monotone", "_bounds"),
)
_PATIENCE = 5_000_000  # bits of operands: about a second, of which the import takes a part
BY_MPMATH: dict[str, Method] = {}  # the operations as `Interval` defines them


def arrange(interval: type) -> None:
    """Have the operations of Interval count themselves, and pass to FLINT when they are many."""
    BY_MPMATH.update({name: getattr(interval, name) for name in _REPLACED})
    if os.environ.get("INTERVALS_ENGINE") == "mpmath":
        return
    computed = 0

    def counted(name: str) -> Method:
        @wraps(BY_MPMATH[name])
        def method(self: Any, *arguments: Any) -> Any:
            nonlocal computed
            computed += self.precision
            if computed > _PATIENCE:
                use(interval, fastest(interval))
            return BY_MPMATH[name](self, *arguments)

        return method

    use(interval, {name: counted(name) for name in _REPLACED})


def fastest(interval: type) -> dict[str, Method]:
    """Return the operations of Interval by FLINT, or by mpmath where that is not installed."""
    try:
        from intervals import _engine_flint
    except ImportError:
        return BY_MPMATH
    _engine_flint.take(interval, BY_MPMATH)
    return _engine_flint.BY_FLINT


def use(interval: type, operations: dict[str, Method]) -> None:
    """Have Interval compute by these."""
    for name, operation in operations.items():
        setattr(interval, name, operation)


@contextmanager
def by_mpmath(interval: type) -> Iterator[None]:
    """Have Interval compute by mpmath inside the `with`: to the same bits, where it is watched."""
    before = {name: getattr(interval, name) for name in BY_MPMATH}
    use(interval, BY_MPMATH)
    try:
        yield
    finally:
        use(interval, before)

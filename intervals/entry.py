"""Numbers into rows: exact ones, text, binary64 numbers, and ends to compare with."""

import json
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from intervals.exact import fraction, no_decimal, pair, whole
from intervals.rounding import BeyondRange, Rows, float_down, float_up, joined, towards


def scalar_rows(value: object) -> Rows | None:
    """Return the tightest rows of an int, Fraction, Interval or array of ints; None for others.

    A float, or an array of anything else, raises TypeError.
    """
    if isinstance(value, np.ndarray) and value.dtype.kind in "iu":
        return integer_rows(value)
    if isinstance(value, float | np.floating):
        raise no_decimal(value, "from_floats")
    if isinstance(value, np.ndarray):
        raise TypeError("floats do not mix with intervals: use IntervalArray.from_floats")
    if isinstance(value, np.generic) and whole(value) is None:  # else numpy asks again
        raise TypeError(f"not an interval or an exact number: {value!r}")
    if type(value) is int or type(value) is Fraction:
        return _rational_rows(value)
    if isinstance(value, int | Fraction | np.integer | Decimal) or _is_interval(value):
        return np.array(_enclosure(value))
    return None


@lru_cache(maxsize=256)
def _rational_rows(value: int | Fraction) -> Rows:
    """Return the tightest rows of a number: the few constants of a formula come again and again."""
    rows = np.array(_enclosure(value))
    rows.setflags(write=False)
    return rows


def integer_rows(values: NDArray[Any]) -> Rows:
    """Return the tightest rows of an array of ints."""
    try:
        return float_rows(values, values)
    except ValueError:  # binary64 does not hold them all
        return exact_rows(values)


def _is_interval(value: object) -> bool:
    """Return whether `value` has exact endpoints `inf` and `sup`, as an Interval has."""
    if hasattr(value, "decoration"):
        raise TypeError(f"{value} would lose its decoration: take its .interval")
    return isinstance(getattr(value, "inf", None), Fraction)


def exact_rows(values: Any) -> Rows:
    """Return rows of (nested lists of) exact numbers and pairs, as `IntervalArray.from_exact`."""
    if isinstance(values, np.ndarray) and not values.size:
        return np.empty((2, *values.shape))
    if isinstance(rows := getattr(values, "_rows", None), np.ndarray):
        return rows
    pairs = np.array(_nested(values), dtype=np.float64)
    if pairs.size == 0:
        pairs = pairs.reshape(*pairs.shape, 2)
    return np.ascontiguousarray(np.moveaxis(pairs, -1, 0))


def _nested(values: Any) -> Any:
    """Replace the elements in nested lists by their pairs (-lower, upper)."""
    if isinstance(values, str) and values.lstrip().startswith("["):
        values = _from_text(values)
    if isinstance(values, np.ndarray):
        if _unmasked(values).dtype.kind == "m":
            raise TypeError("spans of time are no numbers")
        values = values.tolist()
    if isinstance(values, list | range):
        return [_nested(value) for value in values]
    if not isinstance(values, tuple):
        return _enclosure(values)
    if len(values) != 2:
        raise ValueError(f"a tuple is a pair (lower, upper), a list is an axis: {values!r}")
    lower, upper = values
    if _endpoint(lower, "inf") > _endpoint(upper, "sup"):
        raise ValueError(f"reversed interval: {lower} > {upper}")
    return (_enclosure(lower)[0], _enclosure(upper)[1])


def _from_text(text: str) -> Any:
    """Return the nested lists of pairs that `str` of an IntervalArray prints."""

    try:
        values = json.loads(text, parse_float=str, parse_int=str, parse_constant=str)
        return _elements(values)
    except ValueError:
        raise ValueError(f"not intervals in nested brackets: {text[:40]!r}") from None


def _elements(values: list[Any]) -> Any:
    """Return one or two numbers as a pair, lists as an axis."""
    if not any(isinstance(value, str) for value in values):
        return [_elements(value) for value in values]
    if len(values) > 2 or any(isinstance(value, list) for value in values):
        raise ValueError("neither an interval nor an axis")
    return values[0], values[-1]


def _unmasked(values: NDArray[Any]) -> NDArray[Any]:
    if isinstance(values, np.ma.MaskedArray):
        raise TypeError("a masked array has no numbers where it is masked: take its .compressed()")
    return values


def _endpoint(value: Any, name: str) -> Fraction:
    """Return the exact endpoint `name` of an Interval, or the exact number itself."""
    if _is_interval(value):
        end: Fraction = getattr(value, name)
        return end
    if isinstance(value, float | np.floating):
        raise no_decimal(value, "from_floats")
    return fraction(value)


def _enclosure(value: Any) -> tuple[float, float]:
    """Return (-lower, upper), the tightest, of an exact number or an Interval."""
    if isinstance(value, str):
        low, high = pair(value, None)
    else:
        low, high = _endpoint(value, "inf"), _endpoint(value, "sup")
    return -towards(low, float_down), towards(high, float_up)


def float_rows(lower: Any, upper: Any) -> Rows:
    """Return rows of binary64 bounds, as `IntervalArray.from_floats`."""
    low = high = _binary64(lower)
    if upper is not lower:
        low, high = np.broadcast_arrays(low, _binary64(upper))
    if not (low <= high).all():
        raise ValueError("bounds must be numbers or infinite, with lower <= upper")
    if (low == inf).any() or (high == -inf).any():
        raise BeyondRange("an interval holds a number")
    return joined(-low, high)


def _binary64(values: Any) -> NDArray[np.float64]:
    """Return floats as an array, unchanged; ints that binary64 does not hold raise ValueError."""
    if isinstance(values, np.ndarray) and _unmasked(values).dtype == np.float64:
        return values
    objects = np.asarray(values, dtype=object)
    if not all(isinstance(x, float | int | np.floating | np.integer) for x in objects.flat):
        raise TypeError("from_floats takes binary64 numbers only: use the constructor for others")
    floats = objects.astype(np.float64)
    if not (np.isnan(floats) | (floats == objects)).all():
        raise ValueError("from_floats takes binary64 numbers only: one of these needs more bits")
    return floats


class End:
    """An endpoint that binary64 need not hold, between its neighbours `down` <= it <= `up`.

    A binary64 number x is below it if and only if x < up, and at most it if and only if x <= down.
    """

    __array_ufunc__ = None  # so that `array < End` comes here
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Fraction) -> None:
        self.down, self.up = towards(value, float_down), towards(value, float_up)

    def __gt__(self, x: Any) -> Any:
        return x < self.up

    def __ge__(self, x: Any) -> Any:
        return x <= self.down

    def __lt__(self, x: Any) -> Any:
        return self.down < x

    def __le__(self, x: Any) -> Any:
        return self.up <= x

    def __eq__(self, x: object) -> Any:
        return (self.down == x) & (self.up == x)


def ends(value: Any) -> tuple[End, End]:
    """Return the endpoints of an exact number or an Interval, to be compared with arrays."""
    return End(_endpoint(value, "inf")), End(_endpoint(value, "sup"))

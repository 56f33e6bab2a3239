"""The form of a certificate, and a reader that takes nothing on faith.

- A UTF-8 JSON object with the fields `schema` ("impact-proofs.certificate/4"), `parameters` (of a
  statement; {`eta`, `nu`}, two ranges, in a file about all plastic oscillators of a box, and with
  them `epsilon` in one about others; null in a file about formulas alone), `functions` (name to
  {`variables`, `values`}), `steps` (name to {`rule`, `witness`}, in the order of the proof) and
  `claims` (a list, not empty).
- Every number is a string, a rational in lowest terms such as "111/100" or "-7", of at most 3000
  characters, 400 in `parameters`; bounds of quantities are plain decimals. Bare JSON numbers are
  refused. A range is a list of two numbers in increasing order, equal ones allowed.
- Objects have exactly the fields that are named (`signs`, of f' on I0 and I1, is one of the
  parameters' only where one of them is -1); one that is there twice, unknown or missing is
  refused. Names match `[A-Za-z][A-Za-z0-9_-]{0,59}`; a step is not named like a rule or a function.
- A step refers to earlier steps by name; each step and function is used, by a claim or by a step
  that is. At most 4,000,000 bytes and 10,000 entries a list.
- The digest is the SHA-256 of the JSON without white space, its keys in the order of the file, in
  ASCII.

What breaks this form, or that of a witness, is malformed; whatever else fails is no proof.
"""

from __future__ import annotations

import dataclasses
import json
import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range
from proofs.trusted.parameters import Parameters, Place

SCHEMA = "impact-proofs.certificate/4"
FIELDS = ("schema", "parameters", "functions", "steps", "claims")
MANIFEST = "impact-proofs.manifest/3"
LEDGER = "impact-proofs.ledger/3"
MAX_BYTES = 4_000_000
_MAX_DIGITS = 3000
SIGNS = "signs"  # a field of the parameters that is there only if f decreases
_MAX_DIGITS_OF_PARAMETERS = 400
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,59}")
_RATIONAL = re.compile(r"-?(0|[1-9][0-9]*)(/[1-9][0-9]*)?")
_DECIMAL = re.compile(r"-?(0|[1-9][0-9]*)(\.[0-9]+)?")


class Malformed(ValueError):
    """The file is not a certificate of this schema; the message starts with the JSON path."""


def text(value: Fraction) -> str:
    """Write an exact rational in the canonical form."""
    return str(value)


def texts(values: tuple[Fraction, ...] | list[Fraction]) -> list[str]:
    """Write several exact rationals."""
    return [str(value) for value in values]


class _Broken(str):
    """Stands in the parsed JSON for what is not allowed there, until its path is known."""


_BARE = _Broken("a bare JSON number: numbers are strings here")
_TWICE = _Broken("a field is there twice")


class Reader:
    """A value in the JSON with its path; every access states what it expects."""

    def __init__(self, value: Any, path: str = "$") -> None:
        METER.get().spend(1)
        self.value = value  # as parsed
        self.path = path

    def _inner(self, value: Any, path: str) -> Reader:
        return Reader(value, self.path + path)

    def fail(self, message: str) -> Malformed:
        """Return the error to raise for this place."""
        return Malformed(f"{self.path}: {message}")

    def fields(self, *names: str) -> list[Reader]:
        """Return the members of an object that has exactly these, in the order asked for."""
        if not isinstance(self.value, dict):
            raise self.fail("an object is expected")
        for name in self.value:
            if name not in names:
                raise self.fail(f"unknown field {name[:40]!r}")
        for name in names:
            if name not in self.value:
                raise self.fail(f"missing field {name!r}")
        return [self._inner(self.value[name], f".{name}") for name in names]

    def entries(self) -> Iterator[tuple[str, Reader]]:
        """Iterate over the members of an object, whatever their names."""
        if not isinstance(self.value, dict):
            raise self.fail("an object is expected")
        for name, value in self.value.items():
            yield name, self._inner(value, f".{_shown(name)}")

    def has(self, name: str) -> bool:
        """Whether an object has a field."""
        return isinstance(self.value, dict) and name in self.value

    def members(self) -> Iterator[tuple[str, Reader]]:
        """Iterate over the members of an object with free names."""
        for name, inner in self.entries():
            if not _NAME.fullmatch(name):
                raise self.fail(f"not a name: {name[:40]!r}")
            yield name, inner

    def items(self, least: int = 0, most: int = 10_000) -> list[Reader]:
        """Return the members of a list."""
        if not isinstance(self.value, list):
            raise self.fail("a list is expected")
        if not least <= len(self.value) <= most:
            raise self.fail(f"{len(self.value)} entries, expected {least} to {most}")
        return [self._inner(value, f"[{i}]") for i, value in enumerate(self.value)]

    def mentioned(self) -> Iterator[str]:
        """Iterate over all strings inside, however deep."""
        waiting = [self.value]
        while waiting:
            value = waiting.pop()
            METER.get().spend(1)
            if isinstance(value, str):
                yield value
            elif isinstance(value, list | dict):
                waiting += value.values() if isinstance(value, dict) else value

    def is_null(self) -> bool:
        """Whether the value is null."""
        return self.value is None

    def string(self) -> str:
        """Return a string."""
        if not isinstance(self.value, str):
            raise self.fail("a string is expected")
        return self.value

    def _matching(self, pattern: re.Pattern[str]) -> str:
        value = self.string()
        if len(value) > _MAX_DIGITS or not pattern.fullmatch(value):
            raise self.fail(f"not a number in canonical form: {value[:40]!r}")
        METER.get().spend(len(value) >> 3)
        return value

    def number(self) -> Fraction:
        """Return an exact rational, written in lowest terms."""
        numerator, _, denominator = (text_value := self._matching(_RATIONAL)).partition("/")
        value = Fraction(int(numerator), int(denominator or 1))
        if str(value) != text_value:
            raise self.fail(f"not in lowest terms: {text_value[:40]!r}")
        return value

    def numbers(self, least: int = 1, most: int = 10_000) -> tuple[Fraction, ...]:
        """Return a list of exact rationals."""
        return tuple(item.number() for item in self.items(least, most))

    def range(self) -> Range:
        """Return two exact rationals in increasing order (equal ones allowed)."""
        low, high = self.numbers(2, 2)
        if low > high:
            raise self.fail("reversed interval")
        return low, high

    def decimals(self) -> Range:
        """Return the bounds {"lower", "upper"} of a quantity, plain decimals."""
        low, high = (Fraction(side._matching(_DECIMAL)) for side in self.fields("lower", "upper"))
        if low > high:
            raise self.fail("reversed bounds")
        return low, high


def _shown(name: str) -> str:
    return name if _NAME.fullmatch(name) else ascii(name[:40])


def _unique(pairs: list[tuple[str, Any]]) -> Any:
    result = dict(pairs)
    return result if len(result) == len(pairs) else _TWICE


def _no_number(value: str) -> Any:
    return _BARE


def _refuse_broken(value: Any, *path: str | int) -> None:
    """Raise Malformed at the first place that is not in the accepted form."""
    if isinstance(value, _Broken):
        parts = (f"[{part}]" if isinstance(part, int) else f".{_shown(part)}" for part in path)
        raise Malformed(f"${''.join(parts)}: {value}")
    if isinstance(value, dict):
        for name, inner in value.items():
            _refuse_broken(inner, *path, name)
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            _refuse_broken(inner, *path, index)


def parse(source: str) -> Reader:
    """Parse a certificate's text; Malformed if it is not JSON in the accepted form."""
    if len(source) > MAX_BYTES:
        raise Malformed(f"$: {len(source)} characters; at most {MAX_BYTES} are read")
    METER.get().spend(len(source) >> 3)
    try:
        value = json.loads(
            source,
            object_pairs_hook=_unique,
            parse_float=_no_number,
            parse_int=_no_number,
            parse_constant=_no_number,
        )
        _refuse_broken(value)
    except RecursionError:
        raise Malformed("$: nested too deeply") from None
    except json.JSONDecodeError as error:
        raise Malformed(f"$: not JSON (truncated?): {error}") from None
    return Reader(value)


def parameters_from_json(reader: Reader) -> Parameters:
    """Read and validate one statement's numbers."""
    names = [field.name for field in dataclasses.fields(Parameters)]
    if not reader.has(SIGNS):
        names.remove(SIGNS)
    eta, nu, left, right, interval, slopes, ratios, printed, epsilon, *more = reader.fields(*names)
    velocities, reach, *signs = more
    try:
        parameters = Parameters(
            eta.number(),
            nu.number(),
            left.range(),
            right.range(),
            interval.range(),
            slopes.range(),
            None if ratios.is_null() else ratios.range(),
            None if printed.is_null() else printed._matching(_DECIMAL),
            None if epsilon.is_null() else epsilon.number(),
            None if velocities.is_null() else velocities.range(),
            None if reach.is_null() else _three(reach),
            *map(_signs, signs),
        )
    except Malformed:
        raise
    except ValueError as error:
        raise reader.fail(str(error)) from None
    _require_short(reader)
    return parameters


def subject_from_json(reader: Reader) -> Parameters | Place | None:
    """Read and validate what a file is about: one statement's numbers, a box, formulas alone."""
    if reader.is_null():
        return None
    names = ["eta", "nu", "epsilon"][: 3 if reader.has("epsilon") else 2]
    if {name for name, _ in reader.entries()} != {*names}:
        return parameters_from_json(reader)
    _require_short(reader)
    try:
        return Place(*(side.range() for side in reader.fields(*names)))
    except Unproved as error:
        raise reader.fail(str(error)) from None


def _require_short(reader: Reader) -> None:
    if any(len(number) > _MAX_DIGITS_OF_PARAMETERS for number in reader.mentioned()):
        raise reader.fail(f"a number of more than {_MAX_DIGITS_OF_PARAMETERS} digits")


def _signs(reader: Reader) -> tuple[int, int]:
    """Read those of f' on I0 and I1; they are left out where f increases on both."""
    signs = {("1", "-1"): (1, -1), ("-1", "1"): (-1, 1), ("-1", "-1"): (-1, -1)}
    read = tuple(entry.string() for entry in reader.items(2, 2))
    if read not in signs:
        raise reader.fail("not the signs of two slopes, one of them -1")
    return signs[read]


def _three(reader: Reader) -> tuple[Fraction, Fraction, Fraction]:
    first, second, third = reader.numbers(3, 3)
    return first, second, third


def used_steps(steps: Reader, named: set[str]) -> set[str]:
    """Return the names given and those of all steps that these need; steps name earlier ones."""
    reached = set(named)
    for name, step in reversed(list(steps.members())):
        if name in reached:
            reached.update(step.mentioned())
    return reached

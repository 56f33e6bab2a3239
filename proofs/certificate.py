"""The certificate: its numbers, its JSON, and a reader that takes nothing on faith.

A certificate is a JSON object of strings, lists and objects; every number is a string, in
lowest terms ("111/100", "-7"), bounds of quantities are decimals. This file knows the form, not
what it means: `proofs.check` does.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

from proofs.facts import Parameters, Range

SCHEMA = "impact-proofs.certificate/1"
MAX_BYTES = 4_000_000
_MAX_DIGITS = 3000
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


class Reader:
    """A value in the JSON with its path; every access states what it expects."""

    def __init__(self, value: Any, path: str = "$") -> None:
        self._value = value
        self.path = path

    def fail(self, message: str) -> Malformed:
        """Return the error to raise for this place."""
        return Malformed(f"{self.path}: {message}")

    def fields(self, *names: str) -> list[Reader]:
        """Return the members of an object that has exactly these, in the order asked for."""
        if not isinstance(self._value, dict):
            raise self.fail("an object is expected")
        for name in self._value:
            if name not in names:
                raise self.fail(f"unknown field {name[:40]!r}")
        for name in names:
            if name not in self._value:
                raise self.fail(f"missing field {name!r}")
        return [Reader(self._value[name], f"{self.path}.{name}") for name in names]

    def members(self) -> Iterator[tuple[str, Reader]]:
        """Iterate over the members of an object with free names."""
        if not isinstance(self._value, dict):
            raise self.fail("an object is expected")
        for name, value in self._value.items():
            if not _NAME.fullmatch(name):
                raise self.fail(f"not a name: {name[:40]!r}")
            yield name, Reader(value, f"{self.path}.{name}")

    def items(self, least: int = 0, most: int = 10_000) -> list[Reader]:
        """Return the members of a list."""
        if not isinstance(self._value, list):
            raise self.fail("a list is expected")
        if not least <= len(self._value) <= most:
            raise self.fail(f"{len(self._value)} entries, expected {least} to {most}")
        return [Reader(value, f"{self.path}[{i}]") for i, value in enumerate(self._value)]

    def mentioned(self) -> Iterator[str]:
        """Iterate over all strings inside, however deep."""
        if isinstance(self._value, str):
            yield self._value
        elif isinstance(self._value, list | dict):
            inner = self._value.values() if isinstance(self._value, dict) else self._value
            for value in inner:
                yield from Reader(value).mentioned()

    def is_null(self) -> bool:
        """Whether the value is null."""
        return self._value is None

    def string(self) -> str:
        """Return a string."""
        if not isinstance(self._value, str):
            raise self.fail("a string is expected")
        return self._value

    def _matching(self, pattern: re.Pattern[str]) -> str:
        value = self.string()
        if len(value) > _MAX_DIGITS or not pattern.fullmatch(value):
            raise self.fail(f"not a number in canonical form: {value[:40]!r}")
        return value

    def number(self) -> Fraction:
        """Return an exact rational, written in lowest terms."""
        value = Fraction(text_value := self._matching(_RATIONAL))
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


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result = dict(pairs)
    if len(result) != len(pairs):
        raise Malformed("$: an object has the same field twice")
    return result


def _no_number(value: str) -> Any:
    raise Malformed(f"$: a bare JSON number, {value[:40]}: numbers are strings here")


def parse(source: str) -> Reader:
    """Parse a certificate's text; Malformed if it is not JSON in the accepted form."""
    if len(source) > MAX_BYTES:
        raise Malformed(f"$: {len(source)} characters; at most {MAX_BYTES} are read")
    try:
        value = json.loads(
            source,
            object_pairs_hook=_unique,
            parse_float=_no_number,
            parse_int=_no_number,
            parse_constant=_no_number,
        )
    except RecursionError:
        raise Malformed("$: nested too deeply") from None
    except json.JSONDecodeError as error:
        raise Malformed(f"$: not JSON (truncated?): {error}") from None
    return Reader(value)


def render(document: dict[str, Any]) -> str:
    """Write a certificate's text: the same document gives the same bytes."""
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def parameters_to_json(of: Parameters) -> dict[str, Any]:
    """Write one statement's numbers."""
    return {
        "eta": text(of.eta),
        "nu": text(of.nu),
        "left": texts(of.left),
        "right": texts(of.right),
        "interval": texts(of.interval),
        "slopes": texts(of.slopes),
        "ratios": None if of.ratios is None else texts(of.ratios),
        "printed_s0": of.printed_s0,
    }


def parameters_from_json(reader: Reader) -> Parameters:
    """Read and validate one statement's numbers."""
    eta, nu, left, right, interval, slopes, ratios, printed = reader.fields(
        "eta", "nu", "left", "right", "interval", "slopes", "ratios", "printed_s0"
    )
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
        )
    except Malformed:
        raise
    except ValueError as error:
        raise reader.fail(str(error)) from None
    if any(len(number) > _MAX_DIGITS_OF_PARAMETERS for number in reader.mentioned()):
        raise reader.fail(f"a number of more than {_MAX_DIGITS_OF_PARAMETERS} digits")
    return parameters


def used_steps(steps: Reader, named: set[str]) -> set[str]:
    """Return the names given and those of all steps that these need; steps name earlier ones."""
    reached = set(named)
    for name, step in reversed(list(steps.members())):
        if name in reached:
            reached.update(step.mentioned())
    return reached


def write_atomically(path: Path, content: str) -> None:
    """Write a file whole or not at all: a temporary file beside it, then a rename."""
    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        with beside.open("x", encoding="utf-8") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(path)
    except OSError:
        beside.unlink(missing_ok=True)
        raise

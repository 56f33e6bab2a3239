"""The operations that are measured, as each library writes them, and the ratios asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from proofs.benchmark.libraries import Job
from proofs.benchmark.peers import CODAC, FLINT, IV

ARRAY, SCALAR = "IntervalArray", "Interval"
_SIGNED, _POSITIVE, _UNIT = "signed", "positive", "unit"  # libraries.RANGES


@dataclass(frozen=True)
class Operation:
    """An operation, and the expression of each library that has it.

    That of IntervalArray is about all elements, and those of the others too if `whole`: see Job.
    target: how many times the time of IntervalArray, at 10,000 elements, python-flint is to need;
    aim: what is hoped for. cheap: measured at a million elements in the quick mode, too.
    """

    name: str
    texts: Mapping[str, str]
    x: str = _SIGNED
    y: str | None = None
    whole: bool = False
    matrices: bool = False
    target: float | None = None
    aim: float | None = None
    cheap: bool = False

    def job(self, library: str, wide: bool, count: int) -> Job | None:
        """Return what a library has to do, None where it lacks the operation."""
        if library not in self.texts:
            return None
        whole = self.whole or library == ARRAY
        return Job(self.texts[library], self.x, self.y, whole, self.matrices, wide, count)


def _operator(symbol: str, target: float | None = None, y: str = _SIGNED) -> Operation:
    one = dict.fromkeys((SCALAR, FLINT, IV, CODAC), f"x {symbol} y")
    array = {ARRAY: f"xs {symbol} ys"}
    return Operation(symbol, array | one, y=y, target=target, cheap=symbol != "-")


def _function(
    name: str,
    x: str = _SIGNED,
    target: float | None = None,
    aim: float | None = None,
    **texts: str,
) -> Operation:
    """Return a function that the libraries write alike, but for the given texts; "" if it lacks."""
    usual = {
        ARRAY: f"xs.{name}()",
        SCALAR: f"x.{name}()",
        FLINT: f"x.{name}()",
        CODAC: f"{name}(x)",
    }
    own = {{"flint": FLINT, "iv": IV, "codac": CODAC}[key]: text for key, text in texts.items()}
    return Operation(
        name,
        {library: text for library, text in (usual | own).items() if text},
        x,
        target=target,
        aim=aim,
        cheap=name in ("sqr", "sqrt"),
    )


OPERATIONS = (
    _operator("+", 25),
    _operator("-"),
    _operator("*", 12),
    _operator("/", 1, _POSITIVE),
    _function("sqr", flint="x * x", iv="x * x"),
    _function("sqrt", _POSITIVE, 1, iv="sqrt(x)"),
    _function("cbrt", _POSITIVE, flint="x.root(3)", codac="root(x, 3)"),
    _function("exp", target=1, iv="exp(x)"),
    _function("log", _POSITIVE, 1, iv="log(x)"),
    _function("sin", target=1.5, aim=3, iv="sin(x)"),
    _function("cos", iv="cos(x)"),
    _function(
        "sincos", target=2, aim=4, flint="x.sin_cos()", iv="cos_sin(x)", codac="(sin(x), cos(x))"
    ),
    _function("tan", _UNIT, iv="tan(x)"),
    _function("atan", target=1, iv="atan2(x, one)"),
    _function("asin", _UNIT),
    _function("acos", _UNIT, codac=""),  # of an Interval codac makes a symbolic expression
    _function("sinh", codac=""),
    _function("cosh"),
    _function("tanh"),
    Operation(
        "pow",
        {
            ARRAY: "xs.pow(ys)",
            SCALAR: "x.pow(y)",
            FLINT: "x ** y",
            IV: "x ** y",
            CODAC: "pow(x, y)",
        },
        x=_POSITIVE,
        y=_SIGNED,
    ),
    Operation(
        "atan2",
        {
            ARRAY: "ys.atan2(xs)",
            SCALAR: "y.atan2(x)",
            FLINT: "arb.atan2(y, x)",
            IV: "atan2(y, x)",
            CODAC: "atan2(y, x)",
        },
        y=_POSITIVE,
    ),
    Operation(
        "hypot",
        {
            ARRAY: "xs.hypot(ys)",
            SCALAR: "x.hypot(y)",
            FLINT: "(x * x + y * y).sqrt()",
            IV: "sqrt(x * x + y * y)",
            CODAC: "sqrt(sqr(x) + sqr(y))",
        },
        x=_POSITIVE,
        y=_POSITIVE,
    ),
    Operation(
        "sum",
        {ARRAY: "xs.sum()", FLINT: "sum(xs)", IV: "fsum(xs)", CODAC: "sum(xs)"},
        whole=True,
        cheap=True,
    ),
    Operation(
        "@",
        {ARRAY: "a @ b", FLINT: "a * b", IV: "a * b", CODAC: "a * b"},
        y=_SIGNED,
        whole=True,
        matrices=True,
    ),
)

"""Single operations of IntervalArray and Interval beside python-flint, mpmath.iv and codac.

    python -m proofs.benchmark.operations --only sin exp --length 1000000 -o sin.json

By pyperf, whose options hold, each in processes of its own (codac changes their rounding mode):
seconds an element of wide intervals, x in [-10, 10], y in [1, 4], u in [-1, 1]. `pyperf compare_to`
and `pyperf stats` tell more of what -o writes.
"""

from __future__ import annotations

import sys
from random import Random
from typing import Any

from proofs.benchmark.peers import CODAC, FLINT, IV, OURS, arithmetic, installed

ARRAY = "IntervalArray"
_SELF = "proofs.benchmark.operations"
_MODULES = {ARRAY: "intervals", OURS: "intervals", FLINT: "flint", IV: "mpmath", CODAC: "codac"}
_OPERANDS = {
    **dict.fromkeys(("+", "-", "*", "/", "atan2", "hypot"), ("x", "y")),
    **dict.fromkeys(("sqr", "exp", "sin", "cos", "sincos", "atan", "sinh", "cosh", "tanh"), ("x",)),
    **dict.fromkeys(("sqrt", "cbrt", "log"), ("y",)),
    **dict.fromkeys(("tan", "asin", "acos"), ("u",)),
    **{"pow": ("y", "x"), "sum": ("x",), "@": ("x", "y")},
}
_HYPOT = "(x * x + y * y)"
_OWN = {  # what they write neither as methods nor (mpmath.iv, codac) as functions; "": they lack it
    FLINT: {"sqr": "x * x", "cbrt": "y.root(3)", "sincos": "x.sin_cos()", "pow": "y ** x"}
    | {"hypot": f"{_HYPOT}.sqrt()", "atan2": "atan2(x, y)"},
    IV: {"sqr": "x * x", "sincos": "cos_sin(x)", "atan": "atan2(x, one)", "pow": "y ** x"}
    | {"hypot": f"sqrt{_HYPOT}"}
    | dict.fromkeys(("cbrt", "asin", "acos", "sinh", "cosh", "tanh"), ""),
    CODAC: {"cbrt": "root(y, 3)", "sincos": "(sin(x), cos(x))", "hypot": f"sqrt{_HYPOT}"}
    | dict.fromkeys(("acos", "sinh"), ""),
}
_WHOLE = {  # of all elements
    "sum": {ARRAY: "x.sum()", FLINT: "sum(x)", IV: "fsum(x)", CODAC: "sum(x)"},
    "@": {ARRAY: "square(x) @ square(y)", FLINT: "square(x) * square(y)"},
}


def statement(name: str, library: str) -> str:
    """Return what a library does with its x, y and u, lists or an array each; "" if it lacks it."""
    if name in _WHOLE:
        return _WHOLE[name].get(library, "")
    first, *others = _OPERANDS[name]
    text = f"{first}.{name}({', '.join(others)})"
    if library in (IV, CODAC):
        text = f"{name}({', '.join([first, *others])})"
    text = f"x {name} y" if name in "+-*/" else _OWN.get(library, {}).get(name, text)
    return f"[{text} for x, y, u in zip(x, y, u)]" if text and library != ARRAY else text


def operands(library: str, bits: int, length: int) -> dict[str, Any]:
    """Return so many intervals for x, y and u, the same in all libraries, and their functions."""
    random, width, side = Random(length), 2.0**-6, round(length**0.5)
    lower, upper = dict[str, list[float]](), dict[str, list[float]]()
    for name, ends in {"x": (-10, 10 - width), "y": (1, 4), "u": (-1, 1 - width)}.items():
        lower[name] = [random.uniform(*ends) for _ in range(length)]
        upper[name] = [x + width * random.random() for x in lower[name]]
    if library == ARRAY:
        from intervals import IntervalArray

        arrays = {name: IntervalArray.from_floats(lower[name], upper[name]) for name in lower}
        return {**arrays, "square": lambda x: x.reshape(side, side)}
    of, known = arithmetic(library, bits), dict[str, Any]()
    if library == FLINT:
        import flint

        flint.ctx.prec = bits
        known = {"square": lambda x: flint.arb_mat(side, side, x), "atan2": flint.arb.atan2}
    elif library == IV:
        known = {name: getattr(of.point(1).ctx, name) for name in dir(of.point(1).ctx)}
    elif library == CODAC:
        import codac  # type: ignore[import-not-found, unused-ignore]

        known = vars(codac)
    return known | {name: list(map(of.number, lower[name], upper[name])) for name in lower}


def main() -> None:
    """Measure what the command line asks for."""
    try:
        import pyperf  # type: ignore[import-not-found, unused-ignore]
    except ImportError:
        sys.exit(f"python -m {_SELF} needs pyperf: pip install pyperf")

    def forward(command: list[str], arguments: Any) -> None:
        command += ["--only", *arguments.only, "--libraries", *arguments.libraries]
        command += [f"--bits={arguments.bits}", f"--length={arguments.length}"]

    runner = pyperf.Runner(program_args=("-m", _SELF), add_cmdline_args=forward)
    here = [name for name, module in _MODULES.items() if installed(module)]
    add = runner.argparser.add_argument
    add("--only", nargs="+", choices=_OPERANDS, default=list(_OPERANDS), help="operations")
    add("--libraries", nargs="+", choices=_MODULES, default=here, help="default: all here")
    add("--bits", type=int, default=53, help="of the precision; IntervalArray and codac have 53")
    add("--length", type=int, default=10_000, help="elements; at most 100 of mpmath.iv")
    arguments = runner.parse_args()
    for name in arguments.only:
        for library in arguments.libraries:
            length = min(arguments.length, 100) if library == IV else arguments.length
            given = f"{_SELF}.operands({library!r}, {arguments.bits}, {length})"
            setup = f"import {_SELF}\nglobals().update({given})"
            steps = round(length**1.5) if name == "@" else length
            if text := statement(name, library):
                runner.timeit(f"{name}, {library}", text, setup, inner_loops=steps, globals={})


if __name__ == "__main__":
    main()

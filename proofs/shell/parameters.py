"""The numbers of a statement as options: a command takes those that its claims depend on."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from intervals import Undecided
from proofs.shell.cli import Parser, number
from proofs.trusted.numbers import show
from proofs.trusted.parameters import PAPER, Parameters

Box = tuple[Fraction, Fraction, Fraction]
_MEANING = {
    "eta": "frequency ratio",
    "nu": "amplitude -beta/p",
    "left": "I0",
    "right": "I1",
    "interval": "I (default: from the left end of I0 to the right end of I1)",
    "slopes": "bounds of f'",
    "epsilon": "of restitution",
    "velocities": "range of velocities gamma",
    "reach": "box around eta, nu, epsilon, less if need be to stay in the model",
}


def add_parameters(parser: Parser, heeded: Iterable[str], *, beyond: bool) -> None:
    """Add the options for those numbers of a statement that are heeded, by default the paper's.

    beyond: whether the statement is not the paper's: then impacts are plastic if not said.
    """
    for name in heeded:
        value, meaning = getattr(PAPER, name), _MEANING[name]
        several: dict[str, Any] = {}
        if isinstance(value, tuple):
            several = {"nargs": len(value), "metavar": ("A", "B", "C")[: len(value)]}
        if name == "epsilon" and beyond:
            meaning += " (default: plastic impacts)"
        elif name != "interval":
            numbers = value if several else (value,)
            meaning += f" (default {' '.join(map(show, numbers))})"
        parser.add_argument(f"--{name}", type=number, help=meaning, **several)


def refusal(unknown: Sequence[str], heeded: Sequence[str]) -> str:
    """Say why options are not taken: at times as nothing here depends on them."""
    names = [option.partition("=")[0] for option in unknown]
    if not any(name.removeprefix("--") in _MEANING for name in names):
        return f"unrecognized arguments: {' '.join(unknown)}"
    taken = ", ".join(f"--{name}" for name in heeded) or "no numbers"
    return f"{names[0]} would change nothing here: what is proved depends on {taken}"


def parameters(options: Namespace, heeded: Iterable[str], *, beyond: bool) -> Parameters:
    """Return the statement's numbers; those printed for s_0 go with the printed slopes only.

    At another oscillator than the paper's, I0, I1 and the slopes that are not given are found, if
    there is a horseshoe: `own_sets`.
    """
    given = {name: value for name in heeded if (value := getattr(options, name)) is not None}
    given = {name: tuple(x) if isinstance(x, list) else x for name, x in given.items()}
    reach = given.pop("reach", None)
    left, right = given.get("left", PAPER.left), given.get("right", PAPER.right)
    interval = given.get("interval", (left[0], right[1]))
    plain = replace(PAPER, **{**given, "interval": interval}, reach=None)
    if beyond:
        return replace(plain, epsilon=given.get("epsilon"), velocities=None)
    of = _with_sets(plain, given, "slopes" in heeded)
    if of.slopes != PAPER.slopes:
        of = replace(of, ratios=None, printed_s0=None)
    return replace(of, reach=_reach(of, reach, "reach" in heeded))


def _with_sets(of: Parameters, given: Mapping[str, Any], is_found: bool) -> Parameters:
    """Return the numbers, at another oscillator with sets that are found unless some are given.

    Undecided where none are found: the paper's are not meant there.
    """
    elsewhere = (of.eta, of.nu) != (PAPER.eta, PAPER.nu)
    if is_found and elsewhere and not {"left", "right", "interval"} & {*given}:
        from proofs.search.shifts import own_sets

        sets = own_sets(of)
        if sets is None:
            raise Undecided(
                f"no sets with a horseshoe are seen at {of.place}: give --left and --right, or see "
                "python -m proofs explore"
            )
        return replace(sets, slopes=given.get("slopes", sets.slopes))
    return of


def _reach(of: Parameters, given: Box | None, is_heeded: bool) -> Box | None:
    """Return the box asked for, else the paper's, narrowed where the numbers leave less room.

    Where it is not heeded, there is none rather than a narrower one.
    """
    epsilon = of.epsilon or Fraction(0)
    if given is None:
        room = of.eta / 2, abs(of.nu) / 2, min(epsilon, (1 - epsilon) / 2)
        first, second, third = map(min, PAPER.reach or room, room)
        narrowed = first, second, third
        return narrowed if is_heeded or narrowed == PAPER.reach else None
    if given[2] > epsilon:
        raise ValueError("reach: epsilon must stay in [0, 1)")
    return given

"""Orbits with one plastic impact in N table periods: every solution of (16), and what it is.

For each N from 1 on, or the one given: the phases that solve (16), enclosed, with the multiplier
(the slope (18)); whether it is an orbit (admissible: the mass leaves at once, and its first impact
is N periods later and transversal), and whether that is stable.
"""

from __future__ import annotations

import json
import sys
from argparse import ArgumentTypeError, Namespace
from collections.abc import Iterable
from typing import Any

from intervals import DomainError, Undecided, decimal_bounds
from proofs.motion.single_orbits import SingleImpact, last_period, solutions
from proofs.motion.system import System
from proofs.shell.cli import Parser, add_stats, digits, number, stats
from proofs.trusted.numbers import Range, show

EPILOG = """\
Numbers are exact: 0.237 is 237/1000; 7/5 and 2e-3 are fine too. Without --n, N goes up to where
no solution can be an orbit any more, or to --most (then "complete" is false). "resonant" lists the
N with N eta an integer: there every phase solves (16), none with a transversal impact. What is not
decided, too close to sticking or grazing, is null; "undecided" lists the N at a saddle-node.

exit status: 0 all is decided, 1 something is not, 2 bad input

examples:
  python -m proofs.single_impact --eta 0.237 --nu 0.3
  python -m proofs.single_impact --eta 0.2121 --nu -0.2 --n 4 --digits 50
  python -m proofs.single_impact --eta 2/3 --nu -0.9 --most 20 --json -
"""
_MOST_PERIODS = 10**6


def main(arguments: list[str] | None = None) -> int:
    """Print the solutions; return the exit status."""
    parser = Parser("proofs.single_impact", __doc__, EPILOG)
    add = parser.add_argument
    add("--eta", type=number, required=True, help="omega_n / omega > 0")
    add("--nu", type=number, required=True, help="-beta / p, not 0: negative for a table below")
    add("--n", type=_periods, metavar="N", help="table periods between impacts (default: all)")
    add("--most", type=_periods, default=100, help="largest N without --n (default 100)")
    add("--digits", type=digits, default=30, help="significant digits (default 30)")
    add("--json", choices=["-"], help="print the machine form on standard output")
    add_stats(parser)
    options = parser.parse_args(arguments)
    try:
        system = System(options.eta, options.nu)
    except ValueError as error:
        parser.error(str(error))
    asked = "all n" if options.n is None else f"n = {options.n}"
    with stats(options.stats, f"{asked}, {options.digits} digits", quiet=bool(options.json)):
        return _answer(system, options)


def _answer(system: System, options: Namespace) -> int:
    """Print the solutions asked for; return the exit status."""
    last = last_period(system)
    most = options.most if last is None else min(last, options.most)
    periods = range(1, most + 1) if options.n is None else (options.n,)
    answer = answer_for(system, periods, options.digits)
    answer["complete"] = options.n is None and last is not None and last <= options.most
    print(json.dumps(answer, indent=1) if options.json else _text(answer))
    open_ones = [one for one in answer["solutions"] if None in (one["admissible"], one["stable"])]
    return int(bool(answer["undecided"] or open_ones))


def answer_for(system: System, periods: Iterable[int], places: int) -> dict[str, Any]:
    """Return the JSON object of an answer."""
    found: list[dict[str, Any]] = []
    resonant, undecided = [], []
    for n in periods:
        if n * system.eta % 1 == 0:
            resonant.append(n)
            continue
        try:
            found += [machine_form(one, places) for one in solutions(system, n, 4 * places + 20)]
        except (Undecided, DomainError):
            undecided.append(n)
    return {
        "eta": show(system.eta),
        "nu": show(system.nu),
        "solutions": found,
        "resonant": resonant,
        "undecided": undecided,
    }


def machine_form(one: SingleImpact, places: int) -> dict[str, Any]:
    """Return the JSON object of a solution: decimal strings, rounded outward."""

    def bounds(values: Range) -> dict[str, str]:
        lower, upper = decimal_bounds(*values, places)
        return {"lower": lower, "upper": upper}

    return {
        "n": one.n,
        "phase": bounds(one.phase),
        "multiplier": bounds(one.multiplier),
        "admissible": one.admissible,
        "stable": one.stable,
        "reason": one.reason,
    }


def _periods(text: str) -> int:
    value = number(text)
    if value.denominator != 1 or not 1 <= value <= _MOST_PERIODS:
        raise ArgumentTypeError(f"a whole number from 1 to 10^6 is expected, not {text[:20]!r}")
    return int(value)


def _text(answer: dict[str, Any]) -> str:
    lines = [f"eta = {answer['eta']}, nu = {answer['nu']}"]
    for one in answer["solutions"]:
        kind = {True: "an orbit", False: "no orbit", None: "undecided"}[one["admissible"]]
        if one["admissible"]:
            kind += {True: ", stable", False: ", not stable", None: ""}[one["stable"]]
        lines.append(f"n = {one['n']}: {kind} ({one['reason']})")
        for name in ("phase", "multiplier"):
            lines.append(f"  {name:10} [{one[name]['lower']},")
            lines.append(f"  {'':10}  {one[name]['upper']}]")
    if answer["resonant"]:
        periods = ", ".join(map(str, answer["resonant"]))
        lines.append(f"n = {periods}: n eta is an integer, every phase solves (16)")
    lines += [f"n = {n}: undecided, a saddle-node" for n in answer["undecided"]]
    if len(lines) == 1:
        lines.append("no solution of (16)")
    if answer["complete"]:
        lines.append("for greater n no solution is an orbit")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())

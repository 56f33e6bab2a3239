"""Soft springs: where does the motion with an impact every M table periods double its period?

In the limit omega_n -> 0 the orbit appears at rho_saddle_node and doubles its period, by a
supercritical bifurcation, at rho_flip, where it impacts at the phase psi; rho = 2 omega^2 beta / g.
For plastic impacts, EPSILON = 0, f2_psi_rho and f2_psi_psi_psi are the derivatives of the second
iterate of the phase map there, by psi and rho, and three times by psi. Proofs: claims S18, S22, S23
of `python -m proofs.soft`.
"""

from __future__ import annotations

import json
import sys
from argparse import ArgumentTypeError, Namespace
from fractions import Fraction
from typing import Any

from intervals import Interval, atan, decimal_bounds
from proofs.search.derivations import SPARE_BITS, enclose
from proofs.shell.cli import Parser, add_stats, digits, number, stats
from proofs.trusted.numbers import Range, show
from proofs.trusted.paper.s5_soft import displayed as eq

EPILOG = """\
Numbers are exact: 0.2 is 1/5; 7/5 and 2e-3 are fine too. All digits asked for are certified:
each value lies between its bounds, which are rounded outward.

exit status: 0 certified, 2 bad input

examples:
  python -m proofs.period_doubling
  python -m proofs.period_doubling --m 3 --epsilon 0.2
  python -m proofs.period_doubling --json - --digits 50
"""
_MOST_PERIODS = 10**9


def values(m: int, epsilon: Fraction, places: int) -> dict[str, Range]:
    """Return enclosures, of so many digits, of what the command prints."""
    point = {"m": Fraction(m), "epsilon": epsilon}
    found = {
        "rho_flip": enclose(eq.RHO_FLIP, places, **point),
        "rho_saddle_node": enclose(eq.RHO_SN, places, **point),
        "psi": _phase(places, point),
    }
    if epsilon == 0:
        for name, formula in (
            ("f2_psi_rho", eq.F2_PSI_RHO),
            ("f2_psi_psi_psi", eq.F2_PSI_PSI_PSI),
        ):
            found[name] = enclose(formula, places, m=Fraction(m))
    return found


def _phase(places: int, point: dict[str, Fraction]) -> Range:
    """Enclose psi_o at the flip: tan psi_o = alpha / ((1 - epsilon) 2 pi m)."""
    bits = places * 4 + SPARE_BITS
    tangent = enclose(f"({eq.ALPHA_FLIP})/((1 - epsilon)*2*pi*m)", places + 12, **point)
    angle = atan(Interval(*tangent, precision=bits))
    lower, upper = decimal_bounds(angle.inf, angle.sup, places)
    return Fraction(lower), Fraction(upper)


def main(arguments: list[str] | None = None) -> int:
    """Print the bifurcation values; return the exit status."""
    parser = Parser("proofs.period_doubling", __doc__, EPILOG)
    add = parser.add_argument
    add("--m", type=_periods, default=1, help="table periods between impacts, m >= 1 (default 1)")
    add("--epsilon", type=_epsilon, default=Fraction(0), help="of restitution, in [0, 1)")
    add("--digits", type=digits, default=30, help="significant digits (default 30)")
    add("--json", choices=["-"], help="print the machine form on standard output")
    add_stats(parser)
    options = parser.parse_args(arguments)
    asked = f"m = {options.m}, epsilon = {show(options.epsilon)}, {options.digits} digits"
    with stats(options.stats, asked, quiet=bool(options.json)):
        _answer(options)
    return 0


def _answer(options: Namespace) -> None:
    """Print the values asked for."""
    found = values(options.m, options.epsilon, options.digits)
    answer: dict[str, Any] = {"m": str(options.m), "epsilon": show(options.epsilon)}
    for name, ends in found.items():
        lower, upper = decimal_bounds(*ends, options.digits)
        answer[name] = {"lower": lower, "upper": upper}
    print(json.dumps(answer, indent=1) if options.json else _text(answer))


def _periods(text: str) -> int:
    value = number(text)
    if value.denominator != 1 or not 1 <= value <= _MOST_PERIODS:
        raise ArgumentTypeError(f"m is a whole number from 1 to 10^9, not {text[:20]!r}")
    return int(value)


def _epsilon(text: str) -> Fraction:
    value = number(text)
    if not 0 <= value < 1:
        raise ArgumentTypeError(f"epsilon is in [0, 1), not {text[:20]!r}")
    return value


def _text(answer: dict[str, Any]) -> str:
    lines = [f"m = {answer['m']}, epsilon = {answer['epsilon']}: a supercritical period doubling"]
    for name, ends in answer.items():
        if isinstance(ends, dict):
            lines += [f"  {name:15} [{ends['lower']},", f"  {'':15}  {ends['upper']}]"]
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())

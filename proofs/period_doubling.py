"""Soft springs: where does the motion with an impact every M table periods double its period?

In the limit omega_n -> 0 the orbit appears at rho_saddle_node and doubles its period, by a
supercritical bifurcation, at rho_flip, where it impacts at the phase psi; rho = 2 omega^2 beta / g.
For plastic impacts, EPSILON = 0, f2_psi_rho and f2_psi_psi_psi are the derivatives of the second
iterate of the phase map there, by psi and rho, and three times by psi. Proofs: claims S18, S22, S23
of `python -m proofs.soft`.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.period_doubling")

from argparse import ArgumentTypeError
from fractions import Fraction

from intervals import Interval, atan, decimal_bounds
from proofs.search.derivations import SPARE_BITS, enclose
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number, whole
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
    add(
        "--m",
        type=whole("m", 10**9),
        default=1,
        help="table periods between impacts, m >= 1 (default 1)",
    )
    add("--epsilon", type=_epsilon, default=Fraction(0), help="of restitution, in [0, 1)")
    add_answer(parser)
    options = parser.parse_args(arguments)
    asked = f"m = {options.m}, epsilon = {show(options.epsilon)}, {options.digits} digits"
    with answering(parser, options, asked):
        found = values(options.m, options.epsilon, options.digits)
        answer: Answer = {"m": str(options.m), "epsilon": show(options.epsilon)}
        answer |= {name: bounds(ends, options.digits) for name, ends in found.items()}
        give(parser, options, answer, _text)
    return 0


def _epsilon(text: str) -> Fraction:
    value = number(text)
    if not 0 <= value < 1:
        raise ArgumentTypeError(f"epsilon is in [0, 1), not {text[:20]!r}")
    return value


def _text(answer: Answer) -> str:
    said = [f"m = {answer['m']}, epsilon = {answer['epsilon']}: a supercritical period doubling"]
    for name, ends in answer.items():
        if isinstance(ends, dict):
            said += lines(name, ends, 15)
    return "\n".join(said)

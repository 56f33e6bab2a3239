"""The plastic impact map, certified: where and when is the next impact after one at phase PHI?

Give one phase, or two for an interval. Prints bounds on the time of flight (in units of
1 / omega, from the moment the mass leaves the table), on the next impact phase (mod 2 pi), on
the slope of the map, and whether the mass sticks first: then it dwells on the table up to the
separation phase, leaves there, and the slope is 0.
"""

import json
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

from intervals import IntervalError, Undecided, decimal_bounds
from proofs.certificate import write_atomically
from proofs.cli import Parser, digits, horizon, number
from proofs.facts import TURN, Range, show
from proofs.model.image import Image, PossibleImages, image
from proofs.model.impact import HORIZON, NoImpact
from proofs.model.system import System

_COARSE_DIGITS = 9  # of a set of possible images, whose ends mean little

EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. For one phase all digits
asked for are certified; for an interval the bounds enclose the images of all its phases. Where
the map jumps in the interval (grazing, the edge of the sticking arc), the set of possible
images is printed instead, and the exit status is 1.

exit status: 0 certified, 1 only a set of possible images, or undecided,
             2 bad input, or no impact within the horizon

examples:
  python -m proofs.impact --eta 0.2121 --nu -0.2 --phi 1.11
  python -m proofs.impact --eta 0.2121 --nu -0.2 --phi 1.11 1.15 --json -
  python -m proofs.impact --eta 2/3 --nu 0.9 --phi 0.5 --digits 100
"""


def main(arguments: list[str] | None = None) -> int:
    """Answer for the phase or phases on the command line; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        system = System(options.eta, options.nu)
        phases = _phases(options.phi)
    except ValueError as error:
        parser.error(str(error))
    try:
        found = image(system, phases, digits=options.digits, horizon=options.horizon)
    except NoImpact as failure:
        parser.error(str(failure))
    except (Undecided, IntervalError) as failure:
        print(f"{parser.prog}: undecided: {failure}", file=sys.stderr)
        return 1
    answer = {"eta": show(system.eta), "nu": show(system.nu), "phi": [show(x) for x in phases]}
    answer |= machine_form(found, options.digits)
    if options.json == "-":
        print(json.dumps(answer, indent=1))
    else:
        print(_text(answer))
    if options.json not in (None, "-"):
        try:
            write_atomically(Path(options.json), json.dumps(answer, indent=1) + "\n")
        except OSError as error:
            parser.error(f"cannot write {options.json}: {error.strerror or error}")
    return int(isinstance(found, PossibleImages))


def _parser() -> Parser:
    parser = Parser("proofs.impact", __doc__, EPILOG)
    add = parser.add_argument
    add("--eta", type=number, required=True, help="omega_n / omega > 0")
    add("--nu", type=number, required=True, help="-beta / p, not 0: negative for a table below")
    add("--phi", type=number, nargs="+", required=True, metavar="A [B]", help="launch phase(s)")
    add("--digits", type=digits, default=30, help="significant digits (default 30)")
    add("--horizon", type=horizon, default=HORIZON, help="longest flight looked at (default 1000)")
    add("--json", metavar="FILE", help="write the machine form to a file, or - for the screen")
    return parser


def _phases(values: list[Fraction]) -> Range:
    """Return the interval of launch phases; ValueError if it is none, or not on the circle."""
    if len(values) > 2:
        raise ValueError(f"--phi takes one phase or two, not {len(values)}")
    low, high = values[0], values[-1]
    if low > high:
        raise ValueError(f"interval reversed: {show(low)} > {show(high)}")
    if low < 0 or high > TURN:
        raise ValueError(f"phase outside the circle [0, 2 pi): {show(low if low < 0 else high)}")
    return low, high


def machine_form(found: Image | PossibleImages, places: int) -> dict[str, Any]:
    """Return the JSON object of an answer: decimal strings, rounded outward."""

    def bounds(values: Range) -> dict[str, str]:
        lower, upper = decimal_bounds(*values, places)
        return {"lower": lower, "upper": upper}

    if isinstance(found, PossibleImages):
        places = min(places, _COARSE_DIGITS)
        return {
            "sticking": None,
            "reason": found.reason,
            "possible": [
                {"flight": bounds(flight), "phase": bounds(phase)} for flight, phase in found.images
            ],
        }
    answer: dict[str, Any] = {
        "flight": bounds(found.flight),
        "phase": bounds(found.phase),
        "slope": bounds(found.slope),
        "sticking": found.sticking,
    }
    if found.dwell is not None:
        answer["dwell"] = bounds(found.dwell)
    return answer


def _text(answer: dict[str, Any]) -> str:
    phases = " to ".join(dict.fromkeys(answer["phi"]))
    at = f"eta = {answer['eta']}, nu = {answer['nu']}, phi = {phases}"
    if "possible" in answer:
        lines = [at, f"several images are possible: {answer['reason']}; each is one of"]
        for pair in answer["possible"]:
            flight, phase = (f"[{x['lower']}, {x['upper']}]" for x in pair.values())
            lines.append(f"  flight {flight}, phase {phase}")
        return "\n".join(lines)
    lines = [at]
    for name, label in (
        ("dwell", "dwell on the table"),
        ("flight", "time of flight"),
        ("phase", "next impact phase"),
        ("slope", "slope of the map"),
    ):
        if name in answer:
            lines.append(f"  {label:18} [{answer[name]['lower']},")
            lines.append(f"  {'':18}  {answer[name]['upper']}]")
    lines.append(f"  sticks first       {'yes' if answer['sticking'] else 'no'}")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())

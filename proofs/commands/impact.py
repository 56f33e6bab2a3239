"""The impact map, certified: where and when is the next impact after one at phase PHI?

Give one phase, or two for an interval. Prints bounds on the time of flight (in units of
1 / omega, from the moment the mass leaves the table), on the next impact phase (mod 2 pi), on
the slope of the map, and whether the mass sticks first: then it dwells on the table up to the
separation phase, leaves there, and the slope is 0.

This is the plastic map. With a coefficient of restitution EPSILON and the velocity GAMMA = v /
(omega_n p) of the mass before the impact, one or two numbers like PHI, it is the map F of section
3.3: the velocity before the next impact is bounded too, and DF, rows (phase, velocity) by columns
(PHI, GAMMA), instead of the slope.
"""

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.impact")

import sys
from argparse import Namespace
from fractions import Fraction

from intervals import IntervalError, Undecided
from proofs.motion.system import System
from proofs.motion.witness import HORIZON, Impossible, NoImpact
from proofs.search.image import Image, PossibleImages, image
from proofs.search.rebound import Rebound, rebound
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, horizon, number
from proofs.trusted.numbers import TURN, Range, show

_COARSE_DIGITS = 9  # of a set of possible images, whose ends mean little

EPILOG = """\
Numbers are exact: 0.2121 is 2121/10000; 7/5 and 2e-3 are fine too. For one phase all digits
asked for are certified; for an interval the bounds enclose the images of all its phases. Where
the map jumps in the interval (grazing, the edge of the sticking arc), the set of possible
images is printed instead, and the exit status is 1.

exit status: 0 certified, 1 only a set of possible images, undecided, or no impact within the
             horizon, 2 bad input

examples:
  python -m proofs impact --eta 0.2121 --nu -0.2 --phi 1.11
  python -m proofs impact --eta 0.2121 --nu -0.2 --phi 1.11 1.15 --json -
  python -m proofs impact --eta 2/3 --nu 0.9 --phi 0.5 --digits 100
  python -m proofs impact --eta 0.2121 --nu -0.2 --phi 1.11 --epsilon 0.01 --gamma -0.3
"""


def main(arguments: list[str] | None = None) -> int:
    """Answer for the phase or phases on the command line; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        system = System(options.eta, options.nu)
        phases = _phases(options.phi)
        _check_restitution(options)
    except ValueError as error:
        parser.error(str(error))
    with answering(parser, options):
        return _answer(parser, system, phases, options)


def _answer(parser: Parser, system: System, phases: Range, options: Namespace) -> int:
    """Print or write the image; return the exit status."""
    try:
        image = _image(system, phases, options)
    except Impossible as failure:
        parser.error(str(failure))
    except (Undecided, IntervalError) as failure:
        kind = "no impact" if isinstance(failure, NoImpact) else "undecided"
        print(f"{parser.prog}: {kind}: {failure}", file=sys.stderr)
        return 1
    answer = {"eta": show(system.eta), "nu": show(system.nu), "phi": [show(x) for x in phases]}
    if options.gamma:
        answer |= {"epsilon": show(options.epsilon), "gamma": [show(x) for x in options.gamma]}
    answer |= machine_form(image, options.digits)
    give(parser, options, answer, _text)
    return int(isinstance(image, PossibleImages))


def _parser() -> Parser:
    parser = Parser("proofs impact", __doc__, EPILOG)
    add = parser.add_argument
    add("--eta", type=number, required=True, help="omega_n / omega > 0")
    add("--nu", type=number, required=True, help="-beta / p, not 0: negative for a table below")
    add("--phi", type=number, nargs="+", required=True, metavar="A [B]", help="launch phase(s)")
    add("--epsilon", type=number, help="coefficient of restitution, from 0 to 1")
    add("--gamma", type=number, nargs="+", metavar=("A", "B"), help="velocity before the impact")
    add("--horizon", type=horizon, default=HORIZON, help="longest flight looked at (default 1000)")
    add_answer(parser)
    return parser


def _image(system: System, phases: Range, options: Namespace) -> Image | PossibleImages | Rebound:
    """Ask the plastic map, or F if a velocity is given."""
    if not options.gamma:
        return image(system, phases, digits=options.digits, horizon=options.horizon)
    return rebound(
        system,
        phases,
        _ends("--gamma", options.gamma, "velocity", "velocities"),
        options.epsilon,
        digits=options.digits,
        horizon=options.horizon,
    )


def _check_restitution(options: Namespace) -> None:
    """Raise ValueError unless epsilon and gamma come together, and describe an impact."""
    if (options.epsilon is None) != (options.gamma is None):
        missing = "--epsilon" if options.epsilon is None else "--gamma"
        raise ValueError(f"{missing} is missing: F takes both --epsilon and --gamma")
    if options.gamma:
        _ends("--gamma", options.gamma, "velocity", "velocities")
        if not 0 <= options.epsilon <= 1:
            raise ValueError(f"epsilon must be in [0, 1], not {show(options.epsilon)}")


def _ends(option: str, values: list[Fraction], one: str, two: str) -> Range:
    """Return the interval that one number or two stand for; ValueError if it is none."""
    if len(values) > 2:
        raise ValueError(f"{option} takes one {one} or two {two}, not {len(values)}")
    low, high = values[0], values[-1]
    if low > high:
        raise ValueError(f"interval reversed: {show(low)} > {show(high)}")
    return low, high


def _phases(values: list[Fraction]) -> Range:
    """Return the interval of launch phases; ValueError if it is none, or not on the circle."""
    low, high = _ends("--phi", values, "phase", "phases")
    if low < 0 or high > TURN:
        beyond = show(low if low < 0 else high)
        raise ValueError(f"phase outside the circle, 0 to {show(TURN)}: {beyond}")
    return low, high


def machine_form(image: Image | PossibleImages | Rebound, places: int) -> Answer:
    """Return the JSON object of an answer."""
    if isinstance(image, PossibleImages):
        coarse = min(places, _COARSE_DIGITS)
        pairs = [
            {"flight": bounds(flight, coarse), "phase": bounds(phase, coarse)}
            for flight, phase in image.images
        ]
        return {"sticking": None, "reason": image.reason, "possible": pairs}
    answer: Answer = {"flight": bounds(image.flight, places), "phase": bounds(image.phase, places)}
    if isinstance(image, Rebound):
        answer["velocity"] = bounds(image.velocity, places)
        p, q, r, s = (bounds(entry, places) for entry in image.jacobian)
        answer["jacobian"] = [[p, q], [r, s]]
    else:
        answer["slope"] = bounds(image.slope, places)
    answer["sticking"] = image.sticking
    if image.dwell is not None:
        answer["dwell"] = bounds(image.dwell, places)
    return answer


def _text(answer: Answer) -> str:
    phases = " to ".join(dict.fromkeys(answer["phi"]))
    at = f"eta = {answer['eta']}, nu = {answer['nu']}, phi = {phases}"
    if "gamma" in answer:
        velocities = " to ".join(dict.fromkeys(answer["gamma"]))
        at += f", epsilon = {answer['epsilon']}, gamma = {velocities}"
    if "possible" in answer:
        said = [at, f"several images are possible: {answer['reason']}; each is one of"]
        for pair in answer["possible"]:
            flight, phase = (f"[{x['lower']}, {x['upper']}]" for x in pair.values())
            said.append(f"  flight {flight}, phase {phase}")
        return "\n".join(said)
    names = ("d phase / d phi", "d phase / d gamma", "d gamma / d phi", "d gamma / d gamma")
    entries = (entry for row in answer.get("jacobian", []) for entry in row)
    rows = [
        ("dwell on the table", answer.get("dwell")),
        ("time of flight", answer["flight"]),
        ("next impact phase", answer["phase"]),
        ("slope of the map", answer.get("slope")),
        ("velocity gamma", answer.get("velocity")),
        *zip(names, entries, strict=False),
    ]
    said = [at, *(line for label, ends in rows if ends is not None for line in lines(label, ends))]
    return "\n".join([*said, f"  sticks first       {'yes' if answer['sticking'] else 'no'}"])

"""Section 6, resonance: the claims, or the next impact after a state that is given.

See `proofs.commands.groups`.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.resonance")

import sys
from argparse import Namespace

from intervals import Undecided
from proofs.commands.groups import GROUPS
from proofs.motion.resonant import Motion, motion
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number
from proofs.shell.runner import run
from proofs.trusted.numbers import TURN, show

_NUMBERS = ("nu", "epsilon", "phi", "gamma")
_STATE = ("--nu", "--epsilon", "--phi", "--gamma")  # options that only the map takes
EPILOG = """\
Numbers are exact: 0.2 is 1/5; 7/5 and 2e-3 are fine too. All digits asked for are certified. A
mass that rests on the table for ever has no next impact, elastic impacts have no limit phase:
null in the machine form.

exit status: 0 certified, 1 undecided, 2 bad input

examples:
  python -m proofs resonance
  python -m proofs resonance --nu -0.2 --epsilon 0.5 --phi 1 --gamma -0.3
  python -m proofs resonance --nu 3/2 --epsilon 0.9 --phi 2 --gamma 1 --digits 50 --json -
"""


def main(arguments: list[str] | None = None) -> int:
    """Prove the claims, or answer for the state on the command line; return the exit status."""
    given = sys.argv[1:] if arguments is None else arguments
    if any(option.partition("=")[0] in _STATE for option in given):
        return next_impact(given)
    return run(GROUPS["resonance"], given)


def next_impact(arguments: list[str]) -> int:
    """Print the next impact and the limit phase; return the exit status."""
    parser = Parser("proofs resonance", GROUPS["resonance"].about, EPILOG)
    add = parser.add_argument
    add("--nu", type=number, required=True, help="amplitude -beta/p, not 0")
    add("--epsilon", type=number, required=True, help="coefficient of restitution, from 0 to 1")
    add("--phi", type=number, required=True, help="phase of an impact, in [0, 2 pi)")
    add("--gamma", type=number, required=True, help="velocity of the mass before it")
    add_answer(parser)
    options = parser.parse_args(arguments)
    if not 0 <= options.phi <= TURN:
        parser.error(f"phase outside the circle, 0 to {show(TURN)}: {show(options.phi)}")
    with answering(parser, options):
        return _answer(parser, options)


def _answer(parser: Parser, options: Namespace) -> int:
    """Print the next impact of the state given; return the exit status."""
    state = {name: getattr(options, name) for name in _NUMBERS}
    try:
        found = motion(**state, digits=options.digits)
    except ValueError as error:
        parser.error(str(error))
    except Undecided as failure:
        print(f"{parser.prog}: undecided: {failure}", file=sys.stderr)
        return 1
    answer = {"eta": "1"} | {name: show(value) for name, value in state.items()}
    give(parser, options, answer | machine_form(found, options.digits), _text)
    return 0


def machine_form(found: Motion, places: int) -> Answer:
    """Return the JSON object of an answer."""
    values = {"phase": found.phase, "velocity": found.velocity, "limit_phase": found.limit}
    ends = {name: None if x is None else bounds(x, places) for name, x in values.items()}
    return {**ends, "sticking": found.sticking}


def _text(answer: Answer) -> str:
    said = [", ".join(f"{name} = {answer[name]}" for name in _NUMBERS)]
    for label, key in (
        ("next impact phase", "phase"),
        ("velocity gamma", "velocity"),
        ("limit phase", "limit_phase"),
    ):
        ends = answer[key]
        said += [f"  {label:18} none"] if ends is None else lines(label, ends)
    said.append(f"  rests at once      {'yes' if answer['sticking'] else 'no'}")
    return "\n".join(said)

"""Orbits with one plastic impact in N table periods: every solution of (16), and what it is.

For each N from 1 on, or the one given: the phases that solve (16), enclosed, with the multiplier
(the slope (18)); whether it is an orbit (admissible: the mass leaves at once, and its first impact
is N periods later and transversal), and whether that is stable.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.single_impact")

from argparse import Namespace
from collections.abc import Callable, Sequence

from intervals import DomainError, Undecided
from proofs.motion.single_orbits import SingleImpact, last_period, solutions
from proofs.motion.system import System
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number, progress, whole
from proofs.trusted.numbers import show

EPILOG = """\
Numbers are exact: 0.237 is 237/1000; 7/5 and 2e-3 are fine too. Without --n, N goes up to where
no solution can be an orbit any more, or to --most (then "complete" is false). "resonant" lists the
N with N eta an integer: there every phase solves (16), none with a transversal impact. What is not
decided, too close to sticking or grazing, is null, as is a slope (18) that is 0/0; "undecided"
lists the N at which the solutions are two or none, at a saddle-node or next to one.

exit status: 0 all is decided, 1 something is not, 2 bad input

examples:
  python -m proofs single_impact --eta 0.237 --nu 0.3
  python -m proofs single_impact --eta 0.2121 --nu -0.2 --n 4 --digits 50
  python -m proofs single_impact --eta 2/3 --nu -0.9 --most 20 --json -
"""
_PERIODS = whole("N", 10**6)


def main(arguments: list[str] | None = None) -> int:
    """Print the solutions; return the exit status."""
    parser = Parser("proofs single_impact", __doc__, EPILOG)
    add = parser.add_argument
    add("--eta", type=number, required=True, help="omega_n / omega > 0")
    add("--nu", type=number, required=True, help="-beta / p, not 0: negative for a table below")
    add("--n", type=_PERIODS, metavar="N", help="table periods between impacts (default: all)")
    add("--most", type=_PERIODS, default=100, help="largest N without --n (default 100)")
    add_answer(parser)
    options = parser.parse_args(arguments)
    try:
        system = System(options.eta, options.nu)
    except ValueError as error:
        parser.error(str(error))
    with answering(parser, options):
        return _answer(parser, system, options)


def _answer(parser: Parser, system: System, options: Namespace) -> int:
    """Print the solutions asked for; return the exit status."""
    last = last_period(system)
    most = options.most if last is None else min(last, options.most)
    periods = range(1, most + 1) if options.n is None else range(options.n, options.n + 1)
    with progress() as tell:
        answer = answer_for(system, periods, options.digits, tell)
    answer["asked"] = options.n
    answer["complete"] = options.n is None and last is not None and last <= options.most
    give(parser, options, answer, _text)
    open_ones = [
        each for each in answer["solutions"] if None in (each["admissible"], each["stable"])
    ]
    return int(bool(answer["undecided"] or open_ones))


def answer_for(
    system: System,
    periods: Sequence[int],
    places: int,
    tell: Callable[[str], None] = lambda stage: None,
) -> Answer:
    """Return the JSON object of an answer."""
    orbits: list[Answer] = []
    resonant, undecided = [], []
    for n in periods:
        tell(f"n = {n} of {periods[-1]}")
        if n * system.eta % 1 == 0:
            resonant.append(n)
            continue
        try:
            orbits += [machine_form(each, places) for each in solutions(system, n, 4 * places + 20)]
        except (Undecided, DomainError):
            undecided.append(n)
    return {
        "eta": show(system.eta),
        "nu": show(system.nu),
        "periods": [periods[0], periods[-1]] if periods else [],
        "solutions": orbits,
        "resonant": resonant,
        "undecided": undecided,
    }


def machine_form(solution: SingleImpact, places: int) -> Answer:
    """Return the JSON object of a solution."""
    return {
        "n": solution.n,
        "phase": bounds(solution.phase, places),
        "multiplier": None if solution.multiplier is None else bounds(solution.multiplier, places),
        "admissible": solution.admissible,
        "stable": solution.stable,
        "reason": solution.reason,
    }


def _text(answer: Answer) -> str:
    said = [f"eta = {answer['eta']}, nu = {answer['nu']}", *_summary(answer)]
    for each in answer["solutions"]:
        kind = {True: "an orbit", False: "no orbit", None: "undecided"}[each["admissible"]]
        if each["admissible"]:
            kind += {True: ", stable", False: ", not stable", None: ""}[each["stable"]]
        said.append(f"n = {each['n']}: {kind} ({each['reason']})")
        said += lines("phase", each["phase"], 10)
        said += lines("multiplier", each["multiplier"], 10) if each["multiplier"] else []
    return "\n".join(said)


def _summary(answer: Answer) -> list[str]:
    """Say what there is, before all of it is listed."""
    if not answer["periods"]:
        return [
            "no orbit for any n: for 0 < nu < 1 one needs n eta < 1/2; (16) may have solutions "
            "all the same: --n 1 lists those for n = 1"
        ]
    first, last = answer["periods"]
    looked, solutions = f"n = {first}" + f", ..., {last}" * (first < last), answer["solutions"]
    orbits = [each for each in solutions if each["admissible"]]
    stable = sorted({each["n"] for each in orbits if each["stable"]})
    open_ones = sum(None in (each["admissible"], each["stable"]) for each in solutions)
    named = f", for n = {', '.join(map(str, stable))}" if stable else ""
    said = [
        f"{looked}: {_count(solutions, 'solution')} of (16) where n eta is no integer, "
        f"{_count(orbits, 'orbit')}, {len(stable)} stable{named}"
    ]
    if open_ones:
        said.append(f"{open_ones} of the solutions are not decided")
    for name, why in (
        ("resonant", "n eta is an integer, every phase solves (16), no impact is transversal"),
        ("undecided", "undecided, two solutions or none: a saddle-node, or close to one"),
    ):
        if answer[name]:
            said.append(f"n = {', '.join(map(str, answer[name]))}: {why}")
    if answer["complete"]:
        said.append("for greater n no solution is an orbit")
    elif answer["asked"] is None:
        said.append(f"the list is not complete: for n > {last} nothing is said")
    return said


def _count(solutions: Sequence[Answer], noun: str) -> str:
    return f"{len(solutions) or 'no'} {noun}" + "s" * (len(solutions) != 1)

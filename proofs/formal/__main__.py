"""Have Coq prove the theorems of a horseshoe certificate, from a statement of 75 lines.

Writes the theory and the certificate's cases as Coq files, runs coqc on them, and prints for each
theorem its name, what it says, and the seconds that it takes with its lemmas; then the axioms that
all of them together rest on. What writes the cases is not trusted, nor is Python: read Impact.v
and the theorems' statements (docs/formal.md), and believe Coq.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.formal.__main__")

import sys
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

from proofs.formal import coqc
from proofs.formal.cases import Case, case
from proofs.formal.hints import NoHint
from proofs.formal.plan import NoTheorem, plan
from proofs.shell.answers import Answer, machine_text
from proofs.shell.cli import Parser, progress, share
from proofs.shell.files import check_folder, check_targets, refusing, write_target, writing
from proofs.shell.screen import say
from proofs.trusted.certificate import Malformed, read
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.verify import Rejected

MODULE = "Horseshoe"
EPILOG = """\
With Coq's own integers, the default, the axioms are the four of the standard library's real
numbers; with --floats also the specifications of machine integers and floats.

exit status: 0 coqc accepts all, and the axioms are those named; 1 Coq is missing (the files are
             written), or no way is found to cut the proof; 2 no right certificate of a horseshoe;
             3 coqc refuses what the checker accepts, or there are other axioms: a bug

examples:
  python -m proofs formal reports/horseshoe.json
  python -m proofs formal reports/horseshoe.json --floats --out coq
  python -m proofs horseshoe --nu -0.201 --out mine && python -m proofs formal mine/horseshoe.json
"""


def main(arguments: list[str] | None = None) -> int:
    """Write the files of a certificate and run coqc on them; return the exit status."""
    parser = Parser("proofs formal", __doc__, EPILOG)
    add = parser.add_argument
    add("certificate", metavar="CERTIFICATE", type=Path, help="of python -m proofs horseshoe")
    add("--out", type=Path, default=Path("formal"), metavar="DIR", help="default: formal")
    add("--floats", action="store_true", help="compute with machine floats: less time, more axioms")
    share(parser, "--json")
    options = parser.parse_args(arguments)
    made = _made(parser, options)
    if isinstance(made, int):
        return made
    check_targets(parser, options.json)
    check_folder(parser, options.out)
    modules = coqc.order(made.text)
    with refusing(parser, options.out), writing(options.out) as put:
        coqc.copy_theory(options.out, modules)
        put(f"{MODULE}.v", made.text)
    try:
        with progress() as tell:
            return _prove(parser, options, made, modules, tell)
    except coqc.Missing as missing:
        say(f"{parser.prog}: {options.out} is written; {missing}", sys.stderr)
        return 1
    except coqc.Refused as refused:
        say(f"{parser.prog}: coqc REFUSES {options.out}/{refused}: a bug", sys.stderr)
        return 3


def _made(parser: Parser, options: Namespace) -> Case | int:
    """Return the case of a certificate, or the exit status after a line that says why not."""
    name = options.certificate
    try:
        return case(plan(read(name)), name.name, options.floats)
    except (Malformed, Rejected) as error:
        parser.error(f"{name}: {error}")
    except OSError as error:
        parser.error(f"{name}: cannot be read: {error.strerror or error}")
    except (NoTheorem, NoHint, Exhausted, Unproved, ArithmeticError) as failure:
        say(f"{parser.prog}: {name}: nothing written: {failure}", sys.stderr)
        return 1


def _prove(
    parser: Parser, options: Namespace, made: Case, modules: list[str], tell: Callable[[str], None]
) -> int:
    """Compile the theory and the case, print what is proved, and return the exit status."""
    began, memory = perf_counter(), 0
    for module in modules:
        tell(f"coqc {module}.v, theory")
        memory = max(memory, coqc.run(options.out, module).memory)
    tell(f"coqc {MODULE}.v, {len(made.theorems)} theorems")
    done = coqc.run(options.out, MODULE)
    names = [theorem.name for theorem in made.theorems]
    times, written = coqc.seconds(made.text, done.output, names), coqc.statements(made.text, names)
    found = coqc.axioms(done.output)
    others = sorted(set(found) - (coqc.MACHINE if options.floats else coqc.REALS))
    answer: Answer = {
        "arithmetic": "floats" if options.floats else "integers",
        "theorems": [
            {
                "name": name,
                "says": says,
                "statement": written(name),
                "seconds": f"{times[name]:.1f}",
            }
            for name, says in made.theorems
        ],
        "axioms": found,
        "other_axioms": others,
        "seconds": f"{perf_counter() - began:.0f}",
        "megabytes": max(memory, done.memory) // 1024,
    }
    write_target(parser, options.json, lambda: machine_text(parser, answer))
    if options.json != "-":
        say(_text(answer, options.out))
    if others or not found:
        say(f"{parser.prog}: axioms not expected: {', '.join(others)}: a bug", sys.stderr)
        return 3
    return 0


def _text(answer: Answer, folder: Path) -> str:
    """Return what is proved, for people."""
    theorems, axioms = answer["theorems"], answer["axioms"]
    lines = [f"{each['name']:18} {each['seconds']:>5} s  {each['says']}" for each in theorems]
    named = [name for name in axioms if name in coqc.REALS]
    more = len(axioms) - len(named)
    return "\n".join(
        [
            *lines,
            f"axioms of all together: {', '.join(named)}"
            + (f", and {more} on machine integers and floats" if more else ""),
            f"coqc accepts {len(theorems)} theorems in {folder}/{MODULE}.v, with "
            f"{answer['arithmetic']}: {answer['seconds']} s, {answer['megabytes']} MB",
        ]
    )

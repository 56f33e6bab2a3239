"""Have Coq prove the theorems of a certificate: of a horseshoe, or of a graph of a map.

Writes the theory and the certificate's case as Coq files, runs coqc on them, and prints for each
theorem its name, what it says, and the seconds that it takes with its lemmas; then the axioms that
all of them together rest on. What writes the case is not trusted, nor is Python: read Impact.v or
Graph.v and the theorems' statements (docs/formal.md), and believe Coq.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.formal.__main__")

import re
import sys
from argparse import Namespace
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

from proofs.formal import cases, coqc, graphs, rebounds
from proofs.formal.hints import NoHint
from proofs.formal.plan import CLAIMS, plan
from proofs.formal.written import Case, NoTheorem, Theorem, ended
from proofs.report.accepted import RECORD, recorded
from proofs.shell.answers import Answer, machine_text
from proofs.shell.cli import Parser, progress, share, whole
from proofs.shell.files import check_folder, check_targets, refusing, write_target, writing
from proofs.shell.screen import say
from proofs.trusted.certificate import Malformed
from proofs.trusted.files import digest, read
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.verify import Rejected, check

MODULE = "Case"
_SECONDS = 900
_LIMIT = f"that coqc has for the case (default {_SECONDS})"
_COMPILED = (".v", ".vo")
EPILOG = """\
The axioms are the four of the standard library's real numbers. The theory is compiled once and
kept in the user's cache, by a digest of its text and of the installed Coq.

exit status: 0 coqc accepts all, and the axioms are those named; 1 Coq or a part of it is missing or
             too old, it was killed or ran out of memory or time, or no way is found to write the
             proof; 2 no right certificate, or nothing can be written; 3 coqc refuses what the
             checker accepts, or there are other axioms: a bug

examples:
  python -m proofs formal reports/horseshoe.json
  python -m proofs horseshoe --nu -0.201 --out mine && python -m proofs formal mine/horseshoe.json
  python -m proofs formal reports/nonplastic.json --brief
  python -m proofs formal reports/systems/logistic/horseshoe.json
"""


def main(arguments: list[str] | None = None) -> int:
    """Write the files of a certificate and run coqc on them; return the exit status."""
    parser = Parser("proofs formal", __doc__, EPILOG)
    add = parser.add_argument
    add(
        "certificate", metavar="CERTIFICATE", type=Path, nargs="?", help="of a horseshoe or a graph"
    )
    add(
        "--arithmetic", action="store_true", help="prove that the checker's own arithmetic encloses"
    )
    add("--out", type=Path, default=Path("formal"), metavar="DIR", help="default: formal")
    about = "enter what coqc accepts in the project's record, which the ledger shows"
    add("--record", action="store_true", help=about)
    add("--brief", action="store_true", help="print the theorems alone, as Coq has them")
    seconds = whole("seconds", 10**6)
    add("--seconds", type=seconds, default=_SECONDS, metavar="N", help=_LIMIT)
    share(parser, "--json")
    options = parser.parse_args(arguments)
    if options.arithmetic == (options.certificate is not None):
        parser.error("a certificate is expected, or --arithmetic")
    if options.record and options.arithmetic:
        parser.error("--record is about a certificate")
    made = _made(parser, options)
    if isinstance(made, int):
        return made
    check_targets(parser, options.json)
    check_folder(parser, options.out)
    modules = coqc.order(made.text)
    with refusing(parser, options.out), writing(options.out) as put:
        coqc.copy(coqc.THEORY, options.out, modules, ".v")
        put(f"{MODULE}.v", made.text)
    try:
        with progress() as tell:
            return _prove(parser, options, made, modules, tell)
    except (coqc.Missing, coqc.Ended) as missing:
        say(f"{parser.prog}: {options.out} is written; {missing}", sys.stderr)
        return 1
    except coqc.Refused as refused:
        say(f"{parser.prog}: coqc REFUSES {options.out}/{refused}: a bug", sys.stderr)
        return 3


def _made(parser: Parser, options: Namespace) -> Case | int:
    """Return the case of a certificate, or the exit status after a line that says why not."""
    if options.arithmetic:
        return arithmetic()
    name = options.certificate
    try:
        return _of_certificate(read(name))
    except (Malformed, Rejected) as error:
        parser.error(f"{name}: {error}")
    except OSError as error:
        parser.error(f"{name}: cannot be read: {error.strerror or error}")
    except (NoTheorem, NoHint, Exhausted, Unproved, ArithmeticError) as failure:
        say(f"{parser.prog}: {name}: nothing written: {failure}", sys.stderr)
        return 1


def _of_certificate(source: str) -> Case:
    """Check a certificate, and return its case: of graphs, of rectangles or of a horseshoe."""
    report, of = check(source), digest(source)
    if report.parameters is None:
        return graphs.case(report, source, of)
    claims = {claim.id for claim in report.claims}
    if claims.isdisjoint(CLAIMS) and not claims.isdisjoint(rebounds.CLAIMS):
        return rebounds.case(report, source, of)
    return cases.case(plan(source, report), of)


def arithmetic() -> Case:
    """Return the theorems on the checker's arithmetic, which stand beside the theory."""
    text = (coqc.THEORY / "Enclosures.v").read_text()
    stated = re.findall(r"^\(\* (.*) \*\)\nTheorem (\w+)", text, re.MULTILINE)
    return ended(text, [Theorem(name, says) for says, name in stated])


def _prove(
    parser: Parser, options: Namespace, made: Case, modules: list[str], tell: Callable[[str], None]
) -> int:
    """Compile the case, print what is proved, and return the exit status."""
    began = perf_counter()
    coqc.copy(coqc.theory(modules, tell), options.out, modules, *_COMPILED)
    names = [theorem.name for theorem in made.theorems]
    done = coqc.run(
        options.out, MODULE, options.seconds, lambda lemma: tell(f"coqc {MODULE}.v: {lemma}")
    )
    times, written = coqc.seconds(made.text, done.output, names), coqc.statements(made.text, names)
    found = coqc.axioms(done.output)
    others = sorted(set(found) - coqc.REALS)
    answer: Answer = {
        "theorems": [
            {
                "name": name,
                "says": says,
                "statement": written(name),
                "seconds": f"{times[name]:.1f}",
            }
            for name, says, _ in made.theorems
        ],
        "left_out": list(made.left_out),
        "axioms": found,
        "other_axioms": others,
        "seconds": f"{perf_counter() - began:.0f}",
        "megabytes": done.memory // 1024,
    }
    write_target(parser, options.json, lambda: machine_text(parser, answer))
    if options.json != "-":
        say(_brief(answer) if options.brief else _text(answer, options.out))
    if others or not found:
        say(f"{parser.prog}: axioms not expected: {', '.join(others)}: a bug", sys.stderr)
        return 3
    if options.record:
        with refusing(parser, RECORD.parent), writing(RECORD.parent) as put:
            put(RECORD.name, _entered(options.certificate, made))
    return 0


def _entered(certificate: Path, made: Case) -> str:
    """Return the project's record with what is proved of a certificate."""
    claims: dict[str, list[str]] = {}
    for theorem in made.theorems:
        for claim in theorem.decides:
            claims.setdefault(claim, []).append(theorem.name)
    return recorded(certificate.name, read(certificate), claims, RECORD)


def _brief(answer: Answer) -> str:
    """Return the theorems as Coq has them."""
    return "\n".join(each["statement"] for each in answer["theorems"])


def _text(answer: Answer, folder: Path) -> str:
    """Return what is proved, for people."""
    theorems = answer["theorems"]
    lines = [f"{each['name']:18} {each['seconds']:>5} s  {each['says']}" for each in theorems]
    return "\n".join(
        [
            *lines,
            *(f"not stated: {each}" for each in answer["left_out"]),
            f"axioms of all together: {', '.join(answer['axioms'])}",
            f"coqc accepts {len(theorems)} theorems in {folder}/{MODULE}.v: "
            f"{answer['seconds']} s, {answer['megabytes']} MB",
        ]
    )

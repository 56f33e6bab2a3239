"""`python -m proofs.check FILE ...`: re-derive every verdict in certificates, print them."""

from __future__ import annotations

import argparse
import inspect
import sys
from pathlib import Path

from proofs.trusted.certificate import LEMMA, MANIFEST, Malformed, digest, read, schema_of
from proofs.trusted.manifest import check_manifest
from proofs.trusted.paper import GROUPS, rules_of
from proofs.trusted.statements import Verdict
from proofs.trusted.verify import Rejected, Report, check

EPILOG = """\
exit status: 0 every claim in every file is proved as stated (verified or refuted)
             1 a claim is undecided, or a file does not prove what it says
             2 a file cannot be read or is no certificate

examples:
  python -m proofs.check reports/horseshoe.json
  python -m proofs.check reports/MANIFEST.json    every file listed there, against what is listed
  python -m proofs.check --rules                  what may be inferred, and from what
"""


def main(arguments: list[str] | None = None) -> int:
    """Check the files named on the command line; return the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m proofs.check",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("files", nargs="*", metavar="FILE", type=Path)
    parser.add_argument("--rules", action="store_true", help="print the rules of inference")
    parser.add_argument("--stats", action="store_true", help="count what is evaluated")
    options = parser.parse_args(arguments)
    if options.rules:
        print_rules()
    elif not options.files:
        parser.error("no file to check")
    examine = check_counting if options.stats else check_file
    return max((examine(path) for path in options.files), default=0)


def check_counting(path: Path) -> int:
    """Check one file, and print what that evaluates; return its exit status."""
    from proofs.shell.counting import counted, show

    with counted() as counts:
        status = check_file(path)
    if status < 2:
        show(counts, [printable(path)], quiet=False)
    return status


def printable(path: Path) -> str:
    """Return the name of a file as a terminal may show it."""
    return str(path) if str(path).isprintable() else ascii(str(path))


def check_file(path: Path) -> int:
    """Check one file, print a line a claim; return its exit status."""
    name = printable(path)
    try:
        source = read(path)
        schema = schema_of(source)
        if schema == MANIFEST:
            print(f"{name}: {check_manifest(source, path.parent)}")
            return 0
        if schema == LEMMA:
            print_lemma(name, source)
            return 0
        report = check(source)
    except Malformed as error:
        print(f"{name}: malformed: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"{name}: cannot be read: {error.strerror or error}", file=sys.stderr)
        return 2
    except Rejected as error:
        print(f"{name}: REJECTED: {error}", file=sys.stderr)
        return 1
    print_report(name, report, digest(source))
    return int(any(claim.verdict is Verdict.UNDECIDED for claim in report.claims))


def print_rules() -> None:
    """Print what each rule takes, what it checks and what it concludes."""
    from proofs.trusted import flights as rules
    from proofs.trusted.kernel import lemma

    groups = {f"group {group}": rules_of(group) for group in GROUPS}
    titles = {"the impact map": rules.RULES, **groups, "maps by formulas": lemma.RULES}
    for title, known in titles.items():
        print(f"Rules about {title}\n")
        for rule in known.values():
            print(inspect.cleandoc(rule.__doc__ or ""), end="\n\n")


def print_lemma(name: str, source: str) -> None:
    """Print what a file about formulas was found to prove."""
    from proofs.trusted.kernel.lemma import check_lemma

    claims = check_lemma(source).claims
    print(f"{name}: accepted, {digest(source)}")
    for claim in claims:
        print(f"  {claim}")


def print_report(name: str, report: Report, digest_of: str) -> None:
    """Print what a certificate was found to prove."""
    whose = "the paper's parameters" if report.is_paper else "not the paper's parameters"
    print(f"{name}: accepted, {whose}, {digest_of}")
    for claim in report.claims:
        print(f"  {claim.id:4} {claim.verdict.value:11} {claim.statement} [{claim.why}]")
        if claim.corrected is not None:
            print(f"       corrected, VERIFIED: {claim.corrected}")
    if report.theorem is not None:
        print(f"  corrected theorem, VERIFIED: {report.theorem}")


if __name__ == "__main__":
    sys.exit(main())

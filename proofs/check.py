"""`python -m proofs.check FILE ...`: re-derive every verdict in certificates, print them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from proofs.trusted.certificate import LEDGER, MANIFEST, Malformed, digest, read, schema_of
from proofs.trusted.kernel.meter import DEFAULT, Exhausted
from proofs.trusted.manifest import Listed, check_ledger, check_manifest
from proofs.trusted.verdicts import Verdict, tally
from proofs.trusted.verify import Rejected, Report, check

FOLDERS = {MANIFEST: check_manifest, LEDGER: check_ledger}
EPILOG = """\
exit status: 0 every claim in every file is decided as stated (SIMULATED is no proof)
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
    help_text = f"how much work a file may take (default {DEFAULT})"
    parser.add_argument("--work", type=_work, default=DEFAULT, metavar="N", help=help_text)
    options = parser.parse_args(arguments)
    if options.rules:
        from proofs.report.specification import specification

        print(specification(), end="")
    elif not options.files:
        parser.error("no file to check")
    examine = check_counting if options.stats else check_file
    return max((examine(path, options.work) for path in options.files), default=0)


def _work(text: str) -> int:
    """Read an amount of work for argparse."""
    if not text.isascii() or not text.isdigit() or not int(text[:19]) > 0:
        raise argparse.ArgumentTypeError(f"a positive whole number is expected, not {text[:20]!r}")
    return int(text[:19])


def check_counting(path: Path, work: int) -> int:
    """Check one file, and print what that evaluates; return its exit status."""
    from proofs.shell.counting import counted, show

    with counted() as counts:
        status = check_file(path, work)
    if status < 2:
        show(counts, [printable(path)], quiet=False)
    return status


def printable(path: Path) -> str:
    """Return the name of a file as a terminal may show it."""
    return str(path) if str(path).isprintable() else ascii(str(path))


def check_file(path: Path, work: int = DEFAULT) -> int:
    """Check one file, print a line a claim; return its exit status."""
    name = printable(path)
    try:
        source = read(path)
        schema = schema_of(source)
        if schema in FOLDERS:
            listed = FOLDERS[schema](source, path.parent, work)
            print(f"{name}: {_counted(listed)}, all as listed")
            return int(any(each.verdict is Verdict.UNDECIDED for each in listed))
        report = check(source, work)
    except Malformed as error:
        print(f"{name}: malformed: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"{name}: cannot be read: {error.strerror or error}", file=sys.stderr)
        return 2
    except Rejected as error:
        print(f"{name}: REJECTED: {error}", file=sys.stderr)
        return 1
    except Exhausted as error:
        print(f"{name}: not decided: {error}", file=sys.stderr)
        return 1
    print_report(name, report, digest(source))
    return int(any(claim.verdict is Verdict.UNDECIDED for claim in report.claims))


def _counted(listed: list[Listed]) -> str:
    named = tally((each.verdict, each.is_own) for each in listed)
    other = sum(not each.is_paper for each in listed)
    where = f", {other} of them at other parameters" if other else " at the paper's parameters"
    return f"{len(listed)} claims{where}: {named}"


def print_report(name: str, report: Report, digest_of: str) -> None:
    """Print what a certificate was found to prove."""
    whose = "the paper's parameters" if report.is_paper else "not the paper's parameters"
    about = "about formulas" if report.parameters is None else whose
    print(f"{name}: accepted, {about}, {digest_of}")
    for claim in report.claims:
        print(f"  {claim.id:4} {claim.verdict.value:11} {claim.statement} [{claim.why}]")
        if claim.corrected is not None:
            print(f"       corrected, VERIFIED: {claim.corrected}")
    for sentence in report.sentences:
        print(f"  {sentence}")


if __name__ == "__main__":
    sys.exit(main())

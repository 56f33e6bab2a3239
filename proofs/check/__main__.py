"""`python -m proofs.check FILE ...`: re-derive every verdict in certificates, print them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from proofs.certificate import MAX_BYTES, Malformed
from proofs.check.verify import Rejected, Report, check
from proofs.statements import Verdict

EPILOG = """\
exit status: 0 every claim in every file is proved as stated (verified or refuted)
             1 a claim is undecided, or a file does not prove what it says
             2 a file cannot be read or is no certificate

example: python -m proofs.check reports/horseshoe.json
"""


def main(arguments: list[str] | None = None) -> int:
    """Check the files named on the command line; return the exit status."""
    parser = argparse.ArgumentParser(
        prog="python -m proofs.check",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("files", nargs="+", metavar="FILE", type=Path)
    return max(check_file(path) for path in parser.parse_args(arguments).files)


def check_file(path: Path) -> int:
    """Check one file, print a line a claim; return its exit status."""
    name = str(path) if str(path).isprintable() else ascii(str(path))
    try:
        report = check(read(path))
    except Malformed as error:
        print(f"{name}: malformed: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"{name}: cannot be read: {error.strerror or error}", file=sys.stderr)
        return 2
    except Rejected as error:
        print(f"{name}: REJECTED: {error}", file=sys.stderr)
        return 1
    print_report(name, report)
    return int(any(claim.verdict is Verdict.UNDECIDED for claim in report.claims))


def read(path: Path) -> str:
    """Return a file's text; Malformed if it is too large or no UTF-8."""
    with path.open("rb") as file:
        content = file.read(MAX_BYTES + 1)
    if len(content) > MAX_BYTES:
        raise Malformed(f"$: larger than {MAX_BYTES} bytes")
    try:
        return content.decode()
    except UnicodeDecodeError:
        raise Malformed("$: not a text file") from None


def print_report(name: str, report: Report) -> None:
    """Print what a certificate was found to prove."""
    whose = "the paper's parameters" if report.is_paper else "not the paper's parameters"
    print(f"{name}: accepted, {whose}")
    for claim in report.claims:
        print(f"  {claim.id:4} {claim.verdict.value:9} {claim.statement} [{claim.why}]")
    if report.theorem is not None:
        print(f"  corrected theorem, VERIFIED: {report.theorem}")


if __name__ == "__main__":
    sys.exit(main())

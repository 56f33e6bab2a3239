"""`python -m proofs.check FILE ...`: re-derive every verdict in certificates, print them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from proofs.certificate import MANIFEST, Malformed, digest, read, schema_of
from proofs.check.manifest import check_manifest
from proofs.check.verify import Rejected, Report, check
from proofs.statements import Verdict

EPILOG = """\
exit status: 0 every claim in every file is proved as stated (verified or refuted)
             1 a claim is undecided, or a file does not prove what it says
             2 a file cannot be read or is no certificate

examples:
  python -m proofs.check reports/horseshoe.json
  python -m proofs.check reports/MANIFEST.json    every file listed there, against what is listed
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
        source = read(path)
        if schema_of(source) == MANIFEST:
            print(f"{name}: {check_manifest(source, path.parent)}")
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


def print_report(name: str, report: Report, digest_of: str) -> None:
    """Print what a certificate was found to prove."""
    whose = "the paper's parameters" if report.is_paper else "not the paper's parameters"
    print(f"{name}: accepted, {whose}, {digest_of}")
    for claim in report.claims:
        print(f"  {claim.id:4} {claim.verdict.value:9} {claim.statement} [{claim.why}]")
    if report.theorem is not None:
        print(f"  corrected theorem, VERIFIED: {report.theorem}")


if __name__ == "__main__":
    sys.exit(main())

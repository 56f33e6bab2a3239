"""What the report says about verdicts, quantities and rules: words that are no mathematics."""

from __future__ import annotations

from collections import Counter
from types import MappingProxyType

from proofs.report.findings import Findings
from proofs.trusted.verdicts import Verdict

PAPER_TITLE = (
    "On the Dynamics of a Harmonic Oscillator Undergoing Impacts with a Vibrating Platform"
)
MEANINGS = MappingProxyType(
    {
        Verdict.VERIFIED: "true as printed",
        Verdict.REFUTED: "false as printed",
        Verdict.CONDITIONAL: "true under conditions",
        Verdict.UNDECIDED: "not decided",
        Verdict.SIMULATED: "observed, not proved",
    }
)
DEFINITIONS = MappingProxyType(
    {
        Verdict.VERIFIED: "Proved as printed, misprints of the scan aside.",
        Verdict.REFUTED: "Proved false as printed, with an exact witness; beside it stands the "
        "strongest true statement nearby that could be proved.",
        Verdict.CONDITIONAL: "True exactly under conditions that the paper leaves out; they are "
        "stated and proved.",
        Verdict.UNDECIDED: "Neither proved nor refuted; what is missing is said.",
        Verdict.SIMULATED: "An observation, not mathematics: reproduced by simulation, and never "
        "called a proof.",
    }
)


def verdict_name(verdict: Verdict) -> str:
    """Return a verdict as a word."""
    return verdict.value.capitalize()


def summary(findings: Findings) -> str:
    """Return in two sentences what the report is about and what it does."""
    count = sum(not claim.row.own for claim in findings.claims)
    return (
        "A mass on a spring bounces on a vibrating table. Is it chaotic, as the paper says? Here "
        f"are its {count} claims, one by one: what is true, what is not, and what is true instead, "
        "with proofs that a small independent program checks. The paper was received on 16 July "
        "1999 and accepted on 22 August 2000; the scan that was read names neither authors nor "
        "journal."
    )


def tally(findings: Findings) -> list[tuple[Verdict, int]]:
    """Return how many of the paper's claims have which verdict."""
    counts = Counter(claim.verdict for claim in findings.claims if not claim.row.own)
    return [(verdict, counts[verdict]) for verdict in Verdict if counts[verdict]]

"""The theorem: what is proved of the oscillator at the paper's parameters, collected on one page.

Each clause is what conclusions say of themselves, with their hypotheses; nothing is added to them.
"""

from __future__ import annotations

from proofs.report.findings import Finding, Findings, Statement
from proofs.report.ledger import statement_text
from proofs.report.names import verdict_name
from proofs.report.typeset import markdown
from proofs.trusted.numbers import floor_text, show
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict

CLAUSES = (
    ("Where the mass sticks, and where it is never hit", ("G1", "M6")),
    ("Where the motions go", ("G13",)),
    ("The horseshoe of the paper, repaired", ("H2", "H7", "H13")),
    ("All that does not come to rest", ("G17", "G18", "G19")),
    ("Grazing", ("H18",)),
    ("With restitution: the horseshoe", ("N5",)),
    ("With restitution: the motion that sticks", ("G7", "G14", "G15", "G16")),
)  # what it is about, and the claims whose theorems say it


def theorem(findings: Findings) -> str:
    """Return the page, with the clauses whose claims the ledger lists."""
    claims = {claim.id: claim for claim in findings.claims}
    eta, nu = (markdown(show(x)) for x in (PAPER.eta, PAPER.nu))
    parts = [
        f"# The impact oscillator at η = {eta}, ν = {nu}",
        "What is proved of it, and where. The words of each clause are those of the conclusion "
        "that the checker derives from the certificate; all claims are in "
        "[the ledger](ledger.md).",
    ]
    for number, (title, ids) in enumerate(CLAUSES, 1):
        here = [claims[each] for each in ids if each in claims]
        if here:
            parts.append(f"## {number} {title}")
        for claim in here:
            for each in _proved(findings, claim):
                if (clause := _clause(findings, each)) not in parts:
                    parts.append(clause)
            parts.append(_source(claim))
    return "\n\n".join(parts) + "\n"


def _proved(findings: Findings, claim: Finding) -> list[Statement]:
    """Return the theorems of a claim: what verifies it, or what is true in its place."""
    because, corrected = claim.decision.because, claim.decision.corrected
    kept = corrected if claim.verdict is Verdict.REFUTED else (*because, *corrected)
    return [findings.statements[each] for each in dict.fromkeys(kept)]


def _clause(findings: Findings, statement: Statement) -> str:
    return f"**{statement.label}.** {statement_text(findings, statement, 'ledger.md')}"


def _source(claim: Finding) -> str:
    """Return where it is proved, and how to find and to check it."""
    margin = claim.decision.margin
    spare = "" if margin is None else f" with margin {markdown(floor_text(margin))}"
    verdict = verdict_name(claim.verdict).lower()
    found = f"found by `{claim.made}`, checked by `{claim.checked}`"
    return f"*[{claim.id}](ledger.md#{claim.id}), {verdict}{spare}; {found}.*"

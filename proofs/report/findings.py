"""What a folder of certificates proves, claim by claim, in the paper's order.

Every conclusion is derived again from its certificate, as the checker does; nothing is searched.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any

from proofs.report.accepted import Accepted, accepted
from proofs.trusted.certificate import LEDGER, Reader, parse, used_steps
from proofs.trusted.files import read
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.manifest import command
from proofs.trusted.paper import find
from proofs.trusted.verdicts import Decision, Row, Verdict, told
from proofs.trusted.verify import Rejected

SECTIONS: Mapping[str, str] = MappingProxyType(
    {
        "2": "Model description",
        "3.1": "Symbolic dynamics",
        "3.2": "Hausdorff dimension of the invariant set",
        "3.3": "Nonplastic impacts",
        "3.4": "Analysis of the mappings",
        "4": "Single impact periodic orbits",
        "5": "Impact oscillator with soft springs",
        "6": "Resonance condition",
        "7": "Experimental study",
        "A": "Appendix",
    }
)  # the paper's


_ENTRY = ("id", "verdict", "file", "statement", "why", "witness", "corrected", "quantities", "coq")


_WORTH = 200  # characters of a statement that is not repeated in another


@dataclass(frozen=True)
class Step:
    """A step of a proof: the rule that infers it, what is inferred, and from which steps."""

    name: str
    rule: str
    conclusion: Conclusion
    premises: tuple[str, ...]


@dataclass(frozen=True)
class Finding:
    """A claim, decided: its row, the decision, and the steps of the proof, in their order.

    own_steps: those that decide it; the others are what these rest on. quantities: as printed in
    the certificate, rounded outward. coq: the theorems that decide it in Coq, if there are any.
    """

    row: Row
    reading: str
    decision: Decision
    file: str
    own_steps: tuple[Step, ...]
    other_steps: tuple[Step, ...]
    quantities: Mapping[str, tuple[str, str]]
    made: str
    coq: Accepted | None

    @property
    def id(self) -> str:
        """The claim's id."""
        return self.row.id

    @property
    def section(self) -> str:
        """The section of the paper, one of `SECTIONS`."""
        return section_of(self.row)

    @property
    def verdict(self) -> Verdict:
        """The verdict."""
        return self.decision.verdict

    @property
    def steps(self) -> tuple[Step, ...]:
        """All steps of the proof: those that decide the claim, then the others."""
        return (*self.own_steps, *self.other_steps)

    @property
    def checked(self) -> str:
        """The command that checks it."""
        return f"python -m proofs check reports/{self.file}"

    @property
    def in_coq(self) -> str:
        """The theorems that decide it in Coq, and the command that has them proved."""
        if self.coq is None:
            return ""
        names = ", ".join(f"`{name}`" for name in self.coq.theorems)
        return f"{names}, by `python -m proofs formal reports/{self.coq.file}`"


@dataclass(frozen=True)
class Statement:
    """A conclusion that decides claims, with the place where it stands: once, at one claim."""

    label: str
    kind: str  # "Theorem", "Witness", "Condition"
    conclusion: Conclusion
    claim: str

    @cached_property
    def text(self) -> str:
        """It in full, with the parameters that it is about."""
        return told([self.conclusion])


@dataclass(frozen=True)
class Findings:
    """All claims of a ledger in the paper's order, and by their texts what decides them."""

    claims: tuple[Finding, ...]
    statements: Mapping[str, Statement]

    def sections(self) -> Iterator[tuple[str, str, list[Finding]]]:
        """Yield the sections with their titles and claims."""
        for key, title in SECTIONS.items():
            members = [claim for claim in self.claims if claim.section == key]
            if members:
                yield key, title, members

    def parts(self, statement: Statement) -> list[Statement | str]:
        """Return the text of a statement, in it those that stand elsewhere as themselves."""
        for other in self.statements.values():
            if other != statement and len(other.text) > _WORTH and other.text in statement.text:
                before, _, after = statement.text.partition(other.text)
                parts: list[Statement | str] = [before, other, after.lstrip()]
                return [part for part in parts if part]
        return [statement.text]

    def stated(self, conclusions: Iterable[Conclusion]) -> list[Statement]:
        """Return where conclusions stand, each text once."""
        return list(dict.fromkeys(self.statements[told([each])] for each in conclusions))

    def at(self, claim: str) -> list[Statement]:
        """Return the statements that stand at a claim."""
        return [each for each in self.statements.values() if each.claim == claim]


def section_of(row: Row) -> str:
    """Return the section that a row is about."""
    match = re.match(r"(3\.\d|\d|A)", row.where)
    if match is None or match[1] not in SECTIONS:
        raise ValueError(f"{row.id}: no section of the paper: {row.where}")
    return match[1]


def findings(folder: Path, documents: Mapping[str, Context]) -> Findings:
    """Return what the ledger of a folder lists, derived from its certificates.

    Raises Malformed, Rejected or OSError where they are not there or prove something else.
    """
    schema, entries_of = parse(read(folder / "ledger.json")).fields("schema", "claims")
    if schema.string() != LEDGER:
        raise schema.fail(f"schema {schema.string()[:60]!r} is not {LEDGER!r}")
    order = {key: place for place, key in enumerate(SECTIONS)}
    claims = []
    entries = [entry.fields(*_ENTRY)[:3] for entry in entries_of.items(least=1)]
    sources = {file: read(folder / file) for file in dict.fromkeys(x[2].string() for x in entries)}
    texts = {file: json.loads(source) for file, source in sources.items()}
    in_coq = accepted(sources.values())
    for id_of, verdict_of, file_of in entries:
        file = file_of.string()
        finding = _finding(id_of, file, texts[file], documents, in_coq.get(id_of.string()))
        if finding.verdict.value != verdict_of.string():
            raise Rejected(f"{verdict_of.path}: {file} gives {finding.verdict.value}")
        claims.append(finding)
    claims.sort(key=lambda claim: order[claim.section])  # stable: within a section as listed
    return Findings(tuple(claims), _statements(claims))


def _finding(
    id_of: Reader,
    file: str,
    document: dict[str, Any],
    documents: Mapping[str, Context],
    coq: Accepted | None,
) -> Finding:
    claim = id_of.string()
    row = find(claim)
    own = next((each for each in document["claims"] if each["id"] == claim), None)
    if row is None or own is None:
        raise id_of.fail(f"{file} says nothing about {claim[:20]}")
    context = documents[file.removesuffix(".json")]
    decision = row.decide(context.of, [context.known[name] for name in own["proof"]])
    steps = _steps(document, context, set(own["proof"]))
    return Finding(
        row,
        row.says(context.of),
        decision,
        file,
        tuple(step for step in steps if step.name in own["proof"]),
        tuple(step for step in steps if step.name not in own["proof"]),
        {name: (ends["lower"], ends["upper"]) for name, ends in own["quantities"].items()},
        command(file, context.of, (claim,)),
        coq,
    )


def _steps(document: dict[str, Any], context: Context, named: set[str]) -> list[Step]:
    """Return the steps named and those that they rest on, in the order of the file."""
    needed = used_steps(Reader(document["steps"]), named)
    return [
        Step(
            name,
            step["rule"],
            context.known[name],
            tuple(
                dict.fromkeys(
                    text
                    for text in Reader(step["witness"]).mentioned()
                    if text in document["steps"] and text != name
                )
            ),
        )
        for name, step in document["steps"].items()
        if name in needed
    ]


def _statements(claims: list[Finding]) -> dict[str, Statement]:
    """Let every conclusion that decides something stand at the first claim that needs it.

    Conclusions with one text, of numbers that differ by less than is written, are one statement.
    """
    lasting = {
        told([each])
        for claim in claims
        for each in (
            *claim.decision.corrected,
            *(claim.decision.because if claim.verdict is Verdict.VERIFIED else ()),
        )
    }
    statements: dict[str, Statement] = {}
    for claim in claims:
        number = 0
        for each in (*claim.decision.because, *claim.decision.corrected):
            text = told([each])
            if text in statements:
                continue
            number += 1
            kind = "Witness" if claim.verdict is Verdict.REFUTED else "Condition"
            kind = "Theorem" if text in lasting else kind
            statements[text] = Statement(f"{claim.id}.{number}", kind, each, claim.id)
    return statements

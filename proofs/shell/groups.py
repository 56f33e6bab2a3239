"""Groups of claims: what a prover found, decided, and written as a certificate and a page.

A group has a prover in `proofs.search` and a command `proofs.<group>`, see `proofs.shell.runner`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from importlib import import_module
from types import MappingProxyType
from typing import Any

from intervals import decimal_bounds
from proofs.search.evidence import Evidence, Tell
from proofs.trusted import paper as catalogue
from proofs.trusted.certificate import (
    SCHEMA,
    Reader,
    parameters_to_json,
    render,
    used_steps,
)
from proofs.trusted.facts import Parameters, Range
from proofs.trusted.statements import Verdict

PROVERS: Mapping[str, str] = MappingProxyType(
    {
        "foundations": "s2_foundations",
        "nonplastic": "s33_restitution",
        "sets": "s32_sets",
        "dimension": "s32_dimension",
        "chaos": "s34_chaos",
        "circle": "s34_circle",
        "persistence": "s34_persistence",
        "single": "s4_single",
        "soft": "s5_soft",
        "resonance": "s6_resonance",
    }
)
_SPARE = Fraction(1, 10**12)


@dataclass(frozen=True)
class Row:
    """One decided claim, with the numbers and the time that it took."""

    id: str
    verdict: Verdict
    statement: str
    why: str
    quantities: Mapping[str, Range]
    seconds: float | None = None
    corrected: str | None = None


def printed(bounds: Range, digits: int) -> dict[str, str]:
    """Write an enclosure outward, with a little to spare for another arithmetic."""
    width = bounds[1] - bounds[0]
    spare = min(width / 8, max(_SPARE, width / 2**16))
    lower, upper = decimal_bounds(bounds[0] - spare, bounds[1] + spare, digits)
    return {"lower": lower, "upper": upper}


def decide(
    claim: str, of: Parameters, proof: Sequence[tuple[str, object]], digits: int
) -> tuple[Row, dict[str, Any]]:
    """Decide a claim of a group by what was proved; return its row and its certificate entry."""
    stated = catalogue.find(claim)
    if stated is None:
        raise ValueError(f"no group has the claim {claim}")
    found = stated.decide(of, [conclusion for _, conclusion in proof])
    row = Row(
        claim, found.verdict, stated.says(of), found.why, found.quantities, None, found.corrected
    )
    return row, {
        "id": claim,
        "statement": row.statement,
        "verdict": found.verdict.value,
        "proof": [name for name, _ in proof],
        "witness": found.witness,
        "corrected": found.corrected,
        "quantities": {name: printed(each, digits) for name, each in found.quantities.items()},
    }


def certificate(
    of: Parameters,
    steps: Mapping[str, dict[str, Any]],
    entries: Sequence[dict[str, Any]],
    corrected: dict[str, Any] | None = None,
) -> dict[str, Any]:
    """Assemble a certificate; steps that nothing uses are left out."""
    named = {name for entry in entries for name in entry["proof"]}
    if corrected is not None:
        named.update(corrected["proof"])
    needed = used_steps(Reader(dict(steps)), named)
    return {
        "schema": SCHEMA,
        "parameters": parameters_to_json(of),
        "steps": {name: step for name, step in steps.items() if name in needed},
        "claims": list(entries),
        "corrected": corrected,
    }


def settle(
    group: str, of: Parameters, claims: Iterable[str] | None = None, *, digits: int, tell: Tell
) -> tuple[list[Row], dict[str, Any]]:
    """Prove and decide claims of a group; return rows for people and the certificate."""
    asked = set(catalogue.GROUPS[group] if claims is None else claims)
    wanted = [claim for claim in catalogue.GROUPS[group] if claim in asked]
    evidence: Evidence = import_module(f"proofs.search.{PROVERS[group]}").prove(
        of, wanted, digits=digits, tell=tell
    )
    decided = [decide(claim, of, evidence.proofs.get(claim, []), digits) for claim in wanted]
    return [row for row, _ in decided], certificate(
        of, evidence.steps, [entry for _, entry in decided]
    )


@dataclass(frozen=True)
class Made:
    """What a run made: rows for the screen, certificate, page; theorem about corrected sets."""

    rows: list[Row]
    certificate: str
    page: str
    theorem: str | None = None
    corrected: Parameters | None = None


def produce(
    group: str,
    of: Parameters,
    claims: Iterable[str] | None = None,
    *,
    digits: int,
    tell: Tell = lambda stage: None,
) -> Made:
    """Prove and decide claims of a group; return the texts of the certificate and the page."""
    from proofs.report.page import page

    rows, found = settle(group, of, claims, digits=digits, tell=tell)
    return Made(rows, render(found), page(group, of, found, rows))

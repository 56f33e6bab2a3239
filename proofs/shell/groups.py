"""Groups of claims: what a prover proved, decided, and written as a certificate and a page.

A group has a prover in `proofs.search`, and a command, a row of `proofs.commands.groups`.

MANIFEST.json says for each file the claims that it settles, its digest, and the two commands: that
makes the certificate, and that checks it in the folder where it lies. The same certificates always
are the same bytes there: nothing tells when or where they were made.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from intervals import decimal_bounds
from proofs.report.page import Line, page
from proofs.search.evidence import Evidence, Tell
from proofs.trusted.certificate import MANIFEST, SCHEMA, Reader, parameters_from_json, used_steps
from proofs.trusted.files import box_to_json, digest, parameters_to_json, render
from proofs.trusted.manifest import BESIDE, checking, command
from proofs.trusted.numbers import Range
from proofs.trusted.paper import BEYOND, GROUPS, find
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Row, Verdict

PROVERS: Mapping[str, str] = MappingProxyType(
    {
        "horseshoe": "s31_horseshoe",
        "foundations": "s2_foundations",
        "nonplastic": "s33_restitution",
        "sets": "s32_sets",
        "dimension": "s32_dimension",
        "chaos": "s34_chaos",
        "circle": "s34_circle",
        "entropy": "s34_whole",
        "persistence": "s34_persistence",
        "single": "s4_single",
        "soft": "s5_soft",
        "resonance": "s6_resonance",
        "explore": "beyond",
        "curves": "curves",
        "rebounding": "beyond_restitution",
    }
)
FILES: Mapping[str, Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {group: {group: claims} for group, claims in GROUPS.items()}
    | {"horseshoe": {"horseshoe": GROUPS["horseshoe"], "nonplastic": BESIDE["horseshoe"]}}
    | {"explore": {"explore": BEYOND["explore"], "rebounding": BESIDE["explore"]}}
    | {"curves": {"curves": BEYOND["curves"]}}
)  # what each certificate is about, by group
_SPARE = Fraction(1, 10**12)


class Made(NamedTuple):
    """What a run made: lines for the screen, certificate, page; what floating point saw beside."""

    lines: list[Line]
    certificate: str
    page: str
    seen: str = ""


def printed(bounds: Range, digits: int) -> dict[str, str]:
    """Write an enclosure outward, with a little to spare for another arithmetic."""
    width = bounds[1] - bounds[0]
    spare = min(width / 8, max(_SPARE, width / 2**16))
    lower, upper = decimal_bounds(bounds[0] - spare, bounds[1] + spare, digits)
    return {"lower": lower, "upper": upper}


def row_of(claim: str) -> Row:
    """Return the row of a claim."""
    row = find(claim)
    if row is None:
        raise ValueError(f"no section has the claim {claim}")
    return row


def decide(
    claim: str, numbers: Parameters, evidence: Evidence, digits: int
) -> tuple[Line, dict[str, Any]]:
    """Decide a claim by what was proved; return its line and its certificate entry."""
    row, proof = row_of(claim), evidence.proofs.get(claim, [])
    decision = row.decide(numbers, [conclusion for _, conclusion in proof])
    quantities = decision.quantities.items()
    noted = decision.verdict in (Verdict.UNDECIDED, Verdict.SIMULATED)
    note = evidence.notes.get(claim) if noted else None
    why, theorem = decision.why, decision.theorem
    truth = theorem or (decision.witness if row.own else None)
    said = (row.words, row.says(numbers), "; ".join(filter(None, (why, note))), truth)
    line = Line(claim, decision.verdict, *said, decision.quantities)
    return line, {
        "id": claim,
        "statement": line.statement,
        "verdict": decision.verdict.value,
        "proof": [name for name, _ in proof],
        "why": why,
        "witness": decision.witness,
        "corrected": theorem,
        "quantities": {name: printed(each, digits) for name, each in quantities},
    }


def certificate(
    at: Parameters | Place,
    steps: Mapping[str, dict[str, Any]],
    claims: Sequence[dict[str, Any]] | Sequence[str],
) -> dict[str, Any]:
    """Assemble a certificate; steps that nothing uses are left out.

    claims: entries about a statement's numbers; about a box of oscillators, names of steps.
    """
    proofs = ([claim] if isinstance(claim, str) else claim["proof"] for claim in claims)
    needed = used_steps(Reader(dict(steps)), {name for proof in proofs for name in proof})
    return {
        "schema": SCHEMA,
        "parameters": box_to_json(at) if isinstance(at, Place) else parameters_to_json(at),
        "functions": {},
        "steps": {name: step for name, step in steps.items() if name in needed},
        "claims": list(claims),
    }


def produce(
    groups: Mapping[str, Sequence[str]],
    numbers: Parameters,
    *,
    digits: int,
    tell: Tell = lambda stage: None,
    **options: Any,
) -> Made:
    """Prove and decide claims of groups; return the texts of the certificate and the page.

    options go to the prover of the first group.
    """
    lines: list[Line] = []
    entries: list[dict[str, Any]] = []
    steps: dict[str, dict[str, Any]] = {}
    for group, claims in groups.items():
        prover = import_module(f"proofs.search.{PROVERS[group]}")
        evidence = prover.prove(numbers, claims, digits=digits, tell=tell, **options)
        options = {}
        if steps.keys() & evidence.steps.keys():
            evidence = _apart(evidence, steps, group)
        steps |= evidence.steps
        for claim in claims:
            line, entry = decide(claim, numbers, evidence, digits)
            lines.append(line)
            entries.append(entry)
    proved = certificate(numbers, steps, entries)
    first = next(iter(groups))
    file = first if first in FILES else next(name for name, ids in FILES.items() if first in ids)
    return Made(lines, render(proved), page(file, numbers, proved, lines))


def _apart(evidence: Evidence, earlier: Mapping[str, dict[str, Any]], group: str) -> Evidence:
    """Return evidence with names of its own for steps whose names others have already."""
    names, steps = dict[str, str](), dict[str, dict[str, Any]]()
    for name, step in evidence.steps.items():
        text = re.sub(r'(?<=")[^"]+(?=")', lambda x: names.get(x[0], x[0]), json.dumps(step))
        own = json.loads(text)
        if earlier.get(name, own) != own:
            names[name] = f"{group}-{name}"
        steps[names.get(name, name)] = own
    proofs = {
        claim: [(names.get(name, name), conclusion) for name, conclusion in proof]
        for claim, proof in evidence.proofs.items()
    }
    return Evidence(steps, proofs, evidence.notes)


def wanted(
    file: str, numbers: Parameters, claims: Iterable[str] | None = None
) -> dict[str, tuple[str, ...]]:
    """Return what is asked for of a file, by group; without a choice all that is asked there:
    beyond the paper, what is about plastic impacts, or what is about those with epsilon.
    """
    other = {"rebounding" if numbers.epsilon is None else "explore"} & {*BEYOND} & {*FILES[file]}

    def is_wanted(claim: str) -> bool:
        return row_of(claim).is_asked(numbers) if claims is None else claim in claims

    groups = {
        group: tuple(filter(is_wanted, ids))
        for group, ids in FILES[file].items()
        if claims is not None or group not in other
    }
    return {group: ids for group, ids in groups.items() if ids}


MANIFEST_NAME = "MANIFEST.json"


def entered(folder: Path, certificates: Mapping[str, str]) -> str:
    """Return the folder's manifest with certificates, by the names of their files, entered.

    Entries about other files stay; a manifest that cannot be read is replaced.
    """
    files = _existing(folder)
    files |= {name: _entry(name, content) for name, content in certificates.items()}
    order = {f"{file}.json": place for place, file in enumerate(FILES)}
    names = sorted(files, key=lambda file: (order.get(file, len(order)), file))
    return render({"schema": MANIFEST, "files": {file: files[file] for file in names}})


def _entry(name: str, content: str) -> dict[str, Any]:
    """Return what is said of a certificate."""
    document = json.loads(content)
    claims = {
        entry["id"]: {"verdict": entry["verdict"], "statement": entry["statement"]}
        for entry in document["claims"]
    }
    numbers = parameters_from_json(Reader(document["parameters"]))
    return {
        "digest": digest(content),
        "parameters": document["parameters"],
        "made": command(name, numbers, tuple(claims)),
        "checked": checking(name),
        "claims": claims,
    }


def _existing(folder: Path) -> dict[str, Any]:
    """Return the entries of the manifest that is there, if it has the usual form."""
    try:
        document = json.loads((folder / MANIFEST_NAME).read_text(encoding="utf-8"))
        return dict(document["files"]) if document["schema"] == MANIFEST else {}
    except (OSError, ValueError, KeyError, TypeError):
        return {}

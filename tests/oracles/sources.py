"""Where the tests get conclusions from: committed certificates, lemmas, provers, the checker.

The only part of these tests, beside the names in `adapter`, that touches the project.
"""

import importlib
import json
import pkgutil
from dataclasses import is_dataclass, replace
from fractions import Fraction
from pathlib import Path

REPORTS = Path(__file__).parents[2] / "reports"


def _parts(document):
    """A document without texts: parameters, steps, and the steps that each claim rests on."""
    proofs = {claim["id"]: claim["proof"] for claim in document["claims"]}
    return {"parameters": document["parameters"], "steps": document["steps"], "proofs": proofs}


def committed(name):
    """The parts of a committed certificate."""
    return _parts(json.loads((REPORTS / f"{name}.json").read_text()))


def certificates():
    """The names of the committed certificates."""
    documents = (
        (path.stem, json.loads(path.read_text())) for path in sorted(REPORTS.glob("*.json"))
    )
    return [name for name, document in documents if "steps" in document]


def proved(group, eta, nu):
    """The parts of what the prover of a group finds at other parameters."""
    from proofs.trusted.facts import PAPER

    from proofs.shell.groups import settle

    of = replace(PAPER, eta=Fraction(eta), nu=Fraction(nu))
    return _parts(settle(group, of, digits=20, tell=lambda stage: None)[1])


def conclusions(made):
    """The parameters and the conclusions of all steps by name, as the checker derives them."""
    from proofs.trusted import verify
    from proofs.trusted.certificate import Reader, parameters_from_json

    of = parameters_from_json(Reader(made["parameters"]))
    return of, verify._derive_steps(of, Reader(made["steps"]))


def rows(made, claims):
    """For each claim (id, verdict, texts): what the checker's own functions say about it."""
    from proofs.trusted import paper

    of, known = conclusions(made)
    for claim in claims:
        row = paper.find(claim)
        found = row.decide(of, [known[name] for name in made["proofs"][claim]])
        texts = (row.says(of), found.why, found.witness, found.corrected)
        yield claim, found.verdict.value, [text for text in texts if text]


def reported(name):
    """The parameters and (id, verdict, texts) of the claims of a committed certificate."""
    from proofs.trusted import verify

    report = verify.check((REPORTS / f"{name}.json").read_text())
    document = json.loads((REPORTS / f"{name}.json").read_text())
    for own, entry in zip(report.claims, document["claims"], strict=True):
        texts = (own.statement, own.why, own.corrected, str(entry["witness"]), entry["corrected"])
        yield report.parameters, own.id, own.verdict.value, [text for text in texts if text]


def joined(made):
    """Conclusions that claims draw from others: crossed rectangles, stable pairs."""
    from proofs.trusted.paper.s33_restitution.rebound_facts import FULL, horseshoes
    from proofs.trusted.paper.s34_circle.persistence import stable_pair

    of, known = conclusions(made)
    found = list(known.values())
    pair = stable_pair(of, [known[name] for name in made["proofs"].get("G7", ())])
    return [*list(horseshoes(of, found, FULL))[:2], *([pair] if pair else [])]


def lemmas():
    """The conclusions of the lemma examples, by example and step."""
    from proofs.trusted.certificate import parse
    from proofs.trusted.kernel import lemma
    from proofs.trusted.kernel.context import Context
    from proofs.trusted.kernel.formula import read_formula
    from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

    for name in EXAMPLES:
        functions, steps, _ = lemma._read(parse(text(name)))
        context = Context({key: read_formula(key, part) for key, part in functions.members()})
        lemma._derive(context, steps)
        yield from ((f"{name}.{key}", found) for key, found in context.known.items())


# frozen dataclasses of the trusted part that conclude nothing by themselves
OTHERS = {
    "Parameters", "Motion", "Checked", "Report", "Decision", "Claim", "Statement",
    "Derivation", "Asked", "Marching", "Cell", "Absorbed", "Subshift", "Meetings",
    "Inequality", "Quantity", "Formula", "LocalMap", "LemmaReport", "Enclosure", "Dual",
    "Quotient", "ManifestReport", "Components",
}  # fmt: skip


def classes():
    """The names of all classes of conclusions: by a common base, or all frozen dataclasses."""
    import proofs.trusted

    found = {}
    for info in pkgutil.walk_packages(proofs.trusted.__path__, "proofs.trusted."):
        for value in vars(importlib.import_module(info.name)).values():
            if isinstance(value, type) and value.__module__.startswith("proofs.trusted"):
                found[f"{value.__module__}.{value.__qualname__}"] = value
    bases = [c for c in found.values() if c.__name__ == "Conclusion"]
    bases = [c for c in bases if not getattr(c, "_is_protocol", False)]
    if bases:
        own = [c for c in found.values() if issubclass(c, tuple(bases)) and c not in bases]
        return {c.__name__ for c in own if not c.__subclasses__()}
    frozen = [c for c in found.values() if is_dataclass(c) and c.__dataclass_params__.frozen]
    return {c.__name__ for c in frozen if not c.__name__.startswith("_")} - OTHERS

"""Where the tests get conclusions from: committed certificates, lemmas, provers, the checker.

The only part of these tests, beside the names in `adapter`, that touches the project.
"""

import importlib
import json
import pkgutil
from dataclasses import replace
from fractions import Fraction
from functools import cache
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
    from proofs.shell.groups import produce
    from proofs.trusted.paper import GROUPS
    from proofs.trusted.parameters import PAPER

    of = replace(PAPER, eta=Fraction(eta), nu=Fraction(nu))
    return _parts(json.loads(produce({group: GROUPS[group]}, of, digits=20).certificate))


def conclusions(made):
    """The parameters and the conclusions of all steps by name, as the checker derives them."""
    from proofs.trusted import verify
    from proofs.trusted.certificate import Reader, parameters_from_json
    from proofs.trusted.kernel.context import Context

    context = Context(parameters_from_json(Reader(made["parameters"])))
    verify.derive(context, Reader(made["steps"]))
    return context.of, context.known


@cache
def committed_conclusions(name):
    """The same of a committed certificate."""
    return conclusions(committed(name))


def rows(made, claims, of, known):
    """For each claim (id, verdict, texts, the conclusions that decide it or correct it)."""
    from proofs.trusted import paper

    for claim in claims:
        row = paper.find(claim)
        found = row.decide(of, [known[name] for name in made["proofs"][claim]])
        texts = (row.says(of), found.why, found.witness, found.theorem)
        shown = (*found.because, *found.corrected) if hasattr(found, "because") else ()
        yield claim, found.verdict.value, [text for text in texts if text], shown


def reported(name):
    """The parameters and (id, verdict, texts) of the claims of a committed certificate."""
    document = json.loads((REPORTS / f"{name}.json").read_text())
    for entry in document["claims"]:
        texts = (entry[key] for key in ("statement", "why", "witness", "corrected"))
        told = [text for text in texts if text]
        yield committed_conclusions(name)[0], entry["id"], entry["verdict"], told


def joined(name):
    """Conclusions that the rows of a committed certificate draw from those of its steps."""
    from proofs.trusted.paper.s33_restitution.rebound_facts import FULL, horseshoes

    from proofs.trusted.paper.s34_circle.persistence import stable_pair

    made, (of, known) = committed(name), committed_conclusions(name)
    for _, _, _, shown in rows(made, made["proofs"], of, known):
        yield from shown
        yield from (one.arc for one in shown if hasattr(one, "arc"))
    yield from list(horseshoes(of, list(known.values()), FULL))[:2]
    pair = stable_pair(of, [known[name] for name in made["proofs"].get("G7", ())])
    yield from [pair] if pair else []


def lemmas():
    """The conclusions of the lemma examples, by example and step."""
    from proofs.trusted.verify import premises
    from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

    for name in EXAMPLES:
        yield from ((f"{name}.{key}", x) for key, x in premises(text(name)).known.items())


def classes():
    """The names of all classes of conclusions, the innermost ones."""
    import proofs.trusted
    from proofs.trusted.kernel.conclusion import Conclusion

    for info in pkgutil.walk_packages(proofs.trusted.__path__, "proofs.trusted."):
        importlib.import_module(info.name)
    found, waiting = set(), [Conclusion]
    while waiting:
        inner = waiting.pop().__subclasses__()
        found |= {one.__name__ for one in inner if not one.__subclasses__()}
        waiting += inner
    return found

"""Certificates with every text as the checker itself would write it: what an adversary has."""

import copy
import json

from proofs.shell.groups import produce
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import GROUPS, find
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, derive, premises

REFUSED = (Malformed, Rejected, Unproved)


def entry(of, claim, proof, known):
    """The entry that the checker accepts for a claim with this proof; quantities are left out."""
    row = find(claim)
    decision = row.decide(of, [known[name] for name in proof])
    return {
        "id": claim,
        "statement": row.says(of),
        "verdict": decision.verdict.value,
        "proof": list(proof),
        "why": decision.why,
        "witness": decision.witness,
        "corrected": decision.theorem,
        "quantities": {},
    }


def renewed(document):
    """The document with all texts renewed; unchanged where its steps do not hold."""
    try:
        context = premises(render(document))
        entries = [
            entry(context.of, claim["id"], claim["proof"], context.known)
            for claim in document["claims"]
        ]
    except (*REFUSED, KeyError, TypeError):
        return document
    for new, old in zip(entries, document["claims"], strict=True):
        new["quantities"] = old["quantities"]
    return {**copy.deepcopy(document), "claims": entries}


def fresh(of=PAPER, claims=GROUPS["horseshoe"]):
    """A new certificate of plastic claims, parsed."""
    return json.loads(produce({"horseshoe": claims}, of, digits=30).certificate)


def rederived(context, steps, changed):
    """What is proved where one step is changed: it is derived again, and all that rest on it."""
    again = {changed}
    for name, step in steps.items():
        if again.intersection(Reader(step["witness"]).mentioned()):
            again.add(name)
    known = {name: each for name, each in context.known.items() if name not in again}
    result = Context(context.parameters, context.functions, known)
    derive(result, Reader({name: step for name, step in steps.items() if name in again}))
    return result

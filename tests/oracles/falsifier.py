"""A semantic falsifier: edits witnesses, proofs and parameters, and renews every text.

Blind mutation cannot find a false theorem, since every edit of a witness changes a text. Here the
texts of an edited document are what the checker's own functions make of it, so that what is left
to refuse a falsehood is the mathematics. What is accepted is judged, conclusion by conclusion and
row by row, by the oracles, which share nothing with the project but the paper.

From the root, `python -m tests.oracles.falsifier 50000` judges so many accepted documents.
"""

import copy
import json
import random
import sys
from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from typing import Any

from proofs.trusted import paper, verify
from proofs.trusted.certificate import Malformed, Reader, parameters_from_json
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import Exhausted, metered
from tests.oracles.judge import oracle
from tests.oracles.sources import certificates, committed, proved
from tests.oracles.verdicts import verdict_oracle

REFUSED = (Malformed, verify.Rejected, Unproved, Exhausted)
WORK = 2_000_000  # for one edited document
ODD = (  # where the audit found falsehoods, and where the motion is of another kind
    ("horseshoe", "1/4", "-3/10"), ("horseshoe", "0.2", "0.2"), ("horseshoe", "0.35", "-0.5"),
    ("sets", "0.2125", "-0.2"), ("circle", "1/6", "-9/20"), ("circle", "5/22", "-19/20"),
    ("chaos", "0.2123", "-0.2"), ("nonplastic", "0.2122", "-0.2"),
)  # fmt: skip
NUMBERS = ("0", "1", "2", "1/2", "-1", "1/5", "7/5", "6/5", "3/2", "4/5", "31/5", "3", "22/7")
SETS = ("left", "right", "interval", "slopes", "ratios", "velocities", "reach")


@dataclass
class Base:
    """A document without texts that the checker accepts, and what its steps prove."""

    name: str
    made: dict[str, Any]
    known: dict[str, Any]


@dataclass
class Tally:
    """What was judged: conclusions by type, verdicts by claim, and the complaints."""

    accepted: int = 0
    refused: int = 0
    conclusions: Counter = field(default_factory=Counter)
    verdicts: Counter = field(default_factory=Counter)
    complaints: list[str] = field(default_factory=list)


@cache
def bases(odd: bool = False) -> tuple[Base, ...]:
    """The committed certificates; with `odd` also what the provers find at other parameters."""
    made = {name: committed(name) for name in certificates()}
    made |= {f"{group} at {eta}, {nu}": proved(group, eta, nu) for group, eta, nu in ODD if odd}
    return tuple(Base(name, each, derived(each, {}, set())) for name, each in made.items())


def derived(made: dict[str, Any], known: dict[str, Any], old: set[str]) -> dict[str, Any]:
    """What the steps prove; those in `old` are taken from `known`."""
    context = Context(parameters_from_json(Reader(made["parameters"])))
    for name, step in made["steps"].items():
        if name in old:
            context.known[name] = known[name]
        else:
            found = Context(context.parameters, known=dict(context.known))
            verify.derive(found, Reader({name: step}))
            context.known[name] = found.known[name]
    return context.known


def needed(made: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """The steps that some need, in order."""
    reached = set(names)
    for name, step in reversed(list(made["steps"].items())):
        if name in reached:
            reached |= set(Reader(step).mentioned())
    return {name: step for name, step in made["steps"].items() if name in reached}


# -- edits -----------------------------------------------------------------------------------------


def places(value: Any, path: tuple = ()) -> list[tuple]:
    """The paths of all lists and strings inside."""
    found = [path] if path and isinstance(value, list | str) else []
    items = value.items() if isinstance(value, dict) else ()
    items = enumerate(value) if isinstance(value, list) else items
    return found + [place for key, inner in items for place in places(inner, (*path, key))]


def edit_list(value: list, chance: random.Random) -> list:
    """The same list in another order, with an entry more, or less, or twice."""
    value, kind = list(value), chance.randrange(5)
    if len(value) < 2:
        return value * 2
    i, j = chance.sample(range(len(value)), 2)
    if kind == 0:
        value[i], value[j] = value[j], value[i]
    elif kind == 1:
        value.reverse()
    elif kind == 2:
        del value[i]
    elif kind == 3:
        value.insert(i, value[j])
    else:
        value[i] = value[j]
    return value


def edit_number(text: str, chance: random.Random) -> str:
    """Another number: near by a part, by a turn of the table, or of another kind."""
    try:
        value = Fraction(text)
    except (ValueError, ZeroDivisionError):
        return text
    small = Fraction(chance.choice((-1, 1)), 10 ** chance.choice((2, 4, 6, 9, 12, 20, 30)))
    turn = Fraction("6.283185307179586") * chance.choice((-1, 1))
    choices = (value + small, value * (1 + small), value + turn, -value, 1 / (value or 1))
    return str(chance.choice(choices)) if chance.random() < 0.8 else chance.choice(NUMBERS)


def edited(base: Base, claim: str, chance: random.Random) -> dict[str, Any] | None:
    """A document about one claim, with one edit or a few; None if it is the same."""
    proof = list(base.made["proofs"][claim])
    made = {"parameters": dict(base.made["parameters"]), "proofs": {claim: proof}}
    if chance.random() < 0.25:
        others = [name for name in base.made["steps"] if name not in proof]
        proof[:] = edit_list(proof, chance) if proof else proof
        proof += chance.sample(others, min(len(others), chance.randrange(3)))
        proof[:] = dict.fromkeys(proof)
    made["steps"] = copy.deepcopy(needed(base.made, proof))
    for _ in range(chance.choice((0, 1, 1, 1, 2, 3))):
        about = "parameters" if chance.random() < 0.35 or not made["steps"] else "steps"
        paths = places(made[about])
        if about == "steps":  # first the last steps, which conclude, then those they rest on
            names = list(made["steps"])
            name = names[-1 - min(int(chance.expovariate(0.7)), len(names) - 1)]
            paths = [path for path in paths if path[0] == name and path[1] == "witness"]
        if paths:
            _put(made[about], chance.choice(paths), chance)
    same = made["steps"] == needed(base.made, proof) and proof == base.made["proofs"][claim]
    return None if same and made["parameters"] == base.made["parameters"] else made


def _put(value: Any, path: tuple, chance: random.Random) -> None:
    for key in path[:-1]:
        value = value[key]
    old = value[path[-1]]
    if isinstance(old, list):
        value[path[-1]] = edit_list(old, chance)
    else:
        value[path[-1]] = edit_number(old, chance)


# -- judging ---------------------------------------------------------------------------------------


def judge(base: Base, claim: str, made: dict[str, Any], tally: Tally, seed: int) -> None:
    """Have the checker look at an edited document, and the oracles at what it accepts."""
    same = made["parameters"] == base.made["parameters"]
    old: set[str] = set()
    for name, step in made["steps"].items():  # what is as it was, down to what it names
        inner = set(Reader(step).mentioned()) & set(made["steps"])
        if same and step == base.made["steps"].get(name) and inner <= old:
            old.add(name)
    try:
        with metered(WORK):
            of = parameters_from_json(Reader(made["parameters"]))
            known = derived(made, base.known, old)
            row = paper.find(claim)
            decision = row.decide(of, [known[name] for name in made["proofs"][claim]])
            texts = [row.says(of), decision.why, decision.witness, decision.theorem]
    except REFUSED:
        tally.refused += 1
        return
    tally.accepted += 1
    tally.verdicts[claim, decision.verdict.value] += 1
    chance, told = random.Random(seed), []
    new = [known[name] for name in known if name not in old]
    for conclusion in (*new, *decision.because, *decision.corrected):
        tally.conclusions[type(conclusion).__name__] += 1
        told += oracle(conclusion, chance, of)
    told += verdict_oracle(claim, of, decision.verdict.value, [text for text in texts if text])
    if told:
        where = json.dumps({"base": base.name, "seed": seed, "claim": claim})
        tally.complaints += [f"{where}: {one}" for one in told]


def run(wanted: int, seed: int = 0, odd: bool = False) -> Tally:
    """Judge so many accepted documents, spread over all claims of all bases."""
    tally, sources = Tally(), bases(odd)
    targets = [(base, claim) for base in sources for claim in base.made["proofs"]]
    index = 0
    while tally.accepted < wanted and index < 60 * wanted:
        base, claim = targets[index % len(targets)]
        made = edited(base, claim, random.Random(f"{seed} {index}"))
        if made is not None:
            judge(base, claim, made, tally, index)
        index += 1
    return tally


def report(tally: Tally) -> str:
    """The counts, as a table."""
    rows = [f"accepted {tally.accepted}, refused {tally.refused}"]
    rows += [f"  {name:24} {count}" for name, count in sorted(tally.conclusions.items())]
    rows += [f"COMPLAINT {one}" for one in tally.complaints[:50]]
    return "\n".join([*rows, f"{len(tally.complaints)} complaints"])


if __name__ == "__main__":
    found = run(int(sys.argv[1]), int((sys.argv[2:] or ["0"])[0]), odd=True)
    print(report(found))
    sys.exit(bool(found.complaints))

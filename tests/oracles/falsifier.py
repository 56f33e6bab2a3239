"""A semantic falsifier: edits witnesses, proofs and parameters, and renews every text.

Blind mutation cannot find a false theorem, since every edit of a witness changes a text. Here the
texts of an edited document are what the checker's own functions make of it, so that what is left
to refuse a falsehood is the mathematics. What is accepted is judged, conclusion by conclusion and
row by row, by the oracles, which share nothing with the project but the paper.

An edited document is about one claim, or about one step, of whatever file: of the paper's claims,
of boxes of oscillators, of formulas and maps. What it has in common with a certificate, whose
premises and parameters are as they were, is not derived again. From the root,
`python -m tests.oracles.falsifier 30000 SEED` judges so many accepted documents.
"""

import json
import math
import random
import sys
from collections import Counter
from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any, ClassVar

from proofs.trusted import paper, verify
from proofs.trusted.certificate import Malformed, Reader, subject_from_json
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.maps import Map, read_map
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.parameters import Parameters
from tests.oracles.edits import (
    PARAMETERS,
    edit_function,
    edit_list,
    edit_parameters,
    edit_step,
    needed,
    transplant,
)
from tests.oracles.judge import oracle
from tests.oracles.sources import (
    certificates,
    committed,
    committed_conclusions,
    conclusions,
    others,
    proved,
)
from tests.oracles.verdicts import verdict_oracle

REFUSED = (Malformed, verify.Rejected, Unproved, Exhausted)
WORK = 300_000  # for one edited document
ODD = (  # where the audit found falsehoods, and where the motion is of another kind
    ("horseshoe", "1/4", "-3/10"), ("horseshoe", "0.2", "0.2"), ("horseshoe", "0.35", "-0.5"),
    ("sets", "0.2125", "-0.2"), ("circle", "1/6", "-9/20"), ("circle", "5/22", "-19/20"),
    ("chaos", "0.2123", "-0.2"), ("nonplastic", "0.2122", "-0.2"),
    ("explore", "0.112", "-0.336"), ("explore", "0.237", "0.3"), ("explore", "0.5", "0.2"),
    ("rebounding", "0.5", "0.2"), ("rebounding", "0.237", "0.3"),
)  # fmt: skip


@dataclass(frozen=True)
class Watched(Parameters):
    """Parameters that note which of them are looked at."""

    seen: ClassVar[set[str]] = set()

    def __getattribute__(self, name):
        if name in PARAMETERS:
            Watched.seen.add(name)
        return super().__getattribute__(name)


@dataclass
class Base:
    """An accepted document without texts, and what its steps prove."""

    name: str
    made: dict[str, Any]
    known: dict[str, Any]
    looked: dict[str, set[str]] = field(default_factory=dict)

    def __post_init__(self):
        of = subject_from_json(Reader(self.made["parameters"]))
        if isinstance(of, Parameters):
            of = Watched(**{each.name: getattr(of, each.name) for each in fields(of)})
        self.of, self.functions = of, read_maps(self.made["functions"])

    def used(self, name):
        """The parameters from which a step is proved: those that its rule looks at."""
        if name not in self.looked:
            Watched.seen.clear()
            with metered(math.inf):
                derived(Context(self.of, self.functions, self.known), name, self.made)
            self.looked[name] = set(Watched.seen)
        return self.looked[name]


@dataclass
class Tally:
    """What was judged: conclusions by type, verdicts by claim, and the complaints."""

    accepted: int = 0
    refused: int = 0
    idle: int = 0  # accepted, undecided, and nothing new is proved
    rules: Counter = field(default_factory=Counter)  # of edited steps that are accepted
    work: Counter = field(default_factory=Counter)  # on the steps of each rule
    conclusions: Counter = field(default_factory=Counter)
    verdicts: Counter = field(default_factory=Counter)
    judged: Counter = field(default_factory=Counter)
    complaints: list[str] = field(default_factory=list)


@cache
def base_of(group: str, eta: str = "", nu: str = "") -> Base:
    """A committed certificate, or what the prover finds at other parameters."""
    if not eta:
        return Base(group, committed(group), committed_conclusions(group)[1])
    made = proved(group, eta, nu)
    return Base(f"{group} at {eta}, {nu}", made, conclusions(made)[1])


@cache
def bases_of_no_claims() -> tuple[Base, ...]:
    """Files about formulas, maps and flights, and about boxes of oscillators."""
    return tuple(Base(name, made, conclusions(made)[1]) for name, made in others())


def read_maps(functions: dict[str, Any]) -> dict[str, Map]:
    """The maps of a file."""
    maps: dict[str, Map] = {}
    for name, each in functions.items():
        maps[name] = read_map(name, Reader(each), maps)
    return maps


def derived(context: Context, name: str, made: dict[str, Any]) -> Any:
    """What a step proves, after those known."""
    inner = Context(context.parameters, context.functions, dict(context.known))
    inner.known.pop(name, None)
    verify.derive(inner, Reader({name: made["steps"][name]}))
    return inner.known[name]


# -- what is edited --------------------------------------------------------------------------------


def edited(base: Base, claim: str, sources: tuple[Base, ...], chance: random.Random) -> dict | None:
    """A document about one claim, or one step, with one edit or a few; None if it is the same."""
    proof = list(base.made["proofs"].get(claim, [claim]))
    others_made = [each.made for each in sources]
    if claim in base.made["proofs"] and chance.random() < 0.2:
        more = [name for name in base.made["steps"] if name not in proof]
        proof = edit_list(proof, chance) if proof else proof
        proof += chance.sample(more, min(len(more), chance.randrange(3)))
        proof = list(dict.fromkeys(proof))
    made = {**base.made, "proofs": {claim: proof}, "steps": needed(base.made["steps"], proof)}
    for _ in range(chance.choice((0, 1, 1, 1, 2, 3))):
        kind = chance.random()
        if kind < 0.3 and made["functions"]:
            made["functions"] = edit_function(made["functions"], chance)
        elif made["parameters"] and (kind < 0.3 or not made["steps"]):
            made["parameters"] = edit_parameters(made["parameters"], chance)
        elif kind < 0.34:
            made["parameters"] = chance.choice(others_made)["parameters"]
        elif kind < 0.4 and not made["functions"]:
            transplant(made, proof, chance.choice(others_made), chance)
        else:
            edit_step(made["steps"], proof, others_made, chance)
    same = all(base.made["steps"].get(name) is step for name, step in made["steps"].items())
    same = same and proof == base.made["proofs"].get(claim, [claim])
    same = same and made["parameters"] == base.made["parameters"]
    return None if same and made["functions"] == base.made["functions"] else made


# -- judging ---------------------------------------------------------------------------------------


def unchanged(base: Base, made: dict[str, Any], of: Any) -> set[str]:
    """What proves what it did: steps of the same witness, premises, and numbers; functions."""
    functions = made["functions"]
    old = set(functions) if functions is base.made["functions"] else set[str]()
    if isinstance(of, Parameters) and isinstance(base.of, Parameters):
        changed = {name for name in PARAMETERS if getattr(of, name) != getattr(base.of, name)}
    elif of != base.of:
        return old
    else:
        changed = set()
    for name, step in made["steps"].items():
        same = step is base.made["steps"].get(name)
        same = same and set(Reader(step).mentioned()) & {*made["steps"], *functions} <= old
        if same and not (changed and base.used(name) & changed):
            old.add(name)
    return old


def judge(base: Base, claim: str, made: dict[str, Any], tally: Tally, seed: str) -> None:
    """Have the checker look at an edited document, and the oracles at what it accepts."""
    rule, row = made["steps"].get(claim, {}).get("rule"), paper.find(claim)
    try:
        with metered(WORK) as meter:
            of = subject_from_json(Reader(made["parameters"]))
            old = unchanged(base, made, of)
            same = made["functions"] is base.made["functions"]
            context = Context(of, base.functions if same else read_maps(made["functions"]))
            known = context.known
            for name in made["steps"]:
                known[name] = base.known[name] if name in old else derived(context, name, made)
            because = [known[name] for name in made["proofs"][claim]]
            _ = [verify._said(each) for each in because]
            decision = row.decide(context.of, because) if row else None
            _ = decision and (row.says(of), decision.why, decision.witness, decision.theorem)
    except REFUSED:
        tally.refused += 1
        return
    finally:
        tally.work[rule] += meter.spent + WORK / 20
    verdict = decision.verdict.value if decision else "VERIFIED"
    because = (*decision.because, *decision.corrected) if decision else ()
    new = [name for name in known if name not in old]
    if not new and (verdict == "UNDECIDED" or not decision) and not because:
        tally.idle += 1
        return
    tally.accepted += 1
    tally.rules.update(made["steps"][name]["rule"] for name in new)
    tally.verdicts[claim if row else "", verdict] += 1
    told = verdict_oracle(claim, of, verdict) if row else []
    for conclusion in (*(known[name] for name in new), *because):
        name = type(conclusion).__name__
        tally.conclusions[name] += 1
        key = hash((conclusion, of))
        if not tally.judged[key]:
            numbers = of if isinstance(of, Parameters) else None
            told += [f"{name}: {one}" for one in oracle(conclusion, random.Random(seed), numbers)]
        tally.judged[key] += 1
    if told:
        where = json.dumps({"base": base.name, "seed": seed, "claim": claim, "made": made})
        tally.complaints += [f"{one}: {where[:4000]}" for one in told]


def run(
    wanted: int,
    seed: int = 0,
    odd: tuple = (),
    told: bool = False,
    only: tuple[str, ...] = (),
    enough: int = 60,
) -> Tally:
    """Judge so many accepted documents, spread over all claims of all bases, or over some.

    odd: groups and parameters, beside those of the committed certificates. It ends where there are
    enough complaints.
    """
    tally, index = Tally(), 0
    sources = (*map(base_of, certificates()), *(base_of(*each) for each in odd))
    while tally.accepted < wanted and index < 60 * wanted and len(tally.complaints) < enough:
        base = sources[index % len(sources)]
        claims = [each for each in base.made["proofs"] if not only or each in only]
        chance = random.Random(f"{seed} {index}")
        index += 1
        if not claims:
            continue
        claim = claims[index // len(sources) % len(claims)]
        made = edited(base, claim, sources, chance)
        if made is not None:
            judge(base, claim, made, tally, f"{seed} {index}")
        if told and index % 2000 == 0:
            print(report(tally), flush=True)
    return tally


def run_rules(
    wanted: int,
    seed: int = 0,
    odd: tuple = (),
    told: bool = False,
    only: tuple[str, ...] = (),
    enough: int = 60,
) -> Tally:
    """Judge so many accepted documents about one step each, with as much work on each rule."""
    tally, index = Tally(), 0
    sources = (*map(base_of, certificates()), *(base_of(*each) for each in odd))
    places: dict[str, list[tuple[Base, str]]] = {}
    for base in (*sources, *bases_of_no_claims()):
        for name, step in base.made["steps"].items():
            places.setdefault(step["rule"], []).append((base, name))
    rules = [rule for rule in places if not only or rule in only]
    while tally.accepted < wanted and index < 60 * wanted and len(tally.complaints) < enough:
        base, name = random.Random(f"{seed} {index}").choice(
            places[min(rules, key=lambda rule: tally.work[rule])]
        )
        index += 1
        alike = bases_of_no_claims() if base in bases_of_no_claims() else sources
        made = edited(base, name, alike, random.Random(f"{seed} {index}"))
        if made is not None:
            judge(base, name, made, tally, f"{seed} {index}")
        if told and index % 2000 == 0:
            print(report(tally), flush=True)
    return tally


def report(tally: Tally) -> str:
    """The counts, as a table."""
    rows = [
        f"accepted {tally.accepted}, refused {tally.refused}, undecided with nothing new "
        f"{tally.idle}; {len(tally.judged)} different conclusions judged"
    ]
    for counts in (tally.rules, tally.conclusions):
        rows += [f"  {name:24} {count}" for name, count in sorted(counts.items())] + [""]
    verdicts = Counter(verdict for (_, verdict), n in tally.verdicts.items() for _ in range(n))
    rows += [f"verdicts {dict(verdicts)} of {len({claim for claim, _ in tally.verdicts})} claims"]
    rows += [f"COMPLAINT {one}" for one in tally.complaints]
    return "\n".join([*rows, f"{len(tally.complaints)} complaints"])


if __name__ == "__main__":
    way = run_rules if "rules" in sys.argv else run
    found = way(int(sys.argv[1]), int((sys.argv[2:] or ["0"])[0]), odd=ODD, told=True)
    print(report(found))
    sys.exit(bool(found.complaints))

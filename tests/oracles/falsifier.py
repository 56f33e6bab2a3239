"""A semantic falsifier: edits witnesses, proofs and parameters, and renews every text.

Blind mutation cannot find a false theorem, since every edit of a witness changes a text. Here the
texts of an edited document are what the checker's own functions make of it, so that what is left
to refuse a falsehood is the mathematics. What is accepted is judged, conclusion by conclusion and
row by row, by the oracles, which share nothing with the project but the paper.

An edited document is about one claim, or about one step, of whatever file: of the paper's claims,
of boxes of oscillators, of formulas and maps. What it has in common with a certificate, whose
premises and parameters are as they were, is not derived again. An edit that is refused is made
smaller, until it is accepted: so most of what is judged lies near the border of what is proved.
From the root, `python -m tests.oracles.falsifier 30000 SEED rules` judges so many accepted
documents, with as much time on each rule.
"""

import json
import math
import random
import sys
import time
from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass, field, fields
from fractions import Fraction
from functools import cache, cached_property
from typing import Any, ClassVar

from proofs.trusted import paper, verify
from proofs.trusted.certificate import Malformed, Reader, subject_from_json
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.maps import Map
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.parameters import Parameters
from tests.oracles.edits import (
    PARAMETERS,
    Chance,
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
WORK = 300_000  # for one edited document, beside some times that for what it was made from
SIZES = [Fraction(1, 12**k) for k in range(6)]
ENOUGH = 200  # accepted edits of a rule, until which it has more of the time
Place = tuple["Base", str]  # a claim or a step of a document
ODD = (  # where the audit found falsehoods, and where the motion is of another kind
    ("horseshoe", "1/4", "-3/10"), ("horseshoe", "0.2", "0.2"), ("horseshoe", "0.35", "-0.5"),
    ("sets", "0.2125", "-0.2"), ("circle", "1/6", "-9/20"), ("circle", "5/22", "-19/20"),
    ("chaos", "0.2123", "-0.2"), ("nonplastic", "0.2122", "-0.2"),
    ("explore", "0.112", "-0.336"), ("explore", "0.237", "0.3"), ("explore", "0.5", "0.2"),
    ("rebounding", "0.5", "0.2"), ("rebounding", "0.237", "0.3"),
    ("explore", "0.01", "-0.2"), ("explore", "20", "-0.5"), ("explore", "1", "-2"),
    ("explore", "0.7", "5/2"), ("rebounding", "0.7", "3/2", "0.99"),
    ("rebounding", "20", "-1/2", "1/1000"), ("rebounding", "0.05", "-3/2", "0.9"),
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
    """An accepted document without texts; is_committed: as a certificate of that name."""

    name: str
    made: dict[str, Any]
    is_committed: bool = False
    looked: dict[str, set[str]] = field(default_factory=dict)
    costs: dict[str, float] = field(default_factory=dict)

    def __post_init__(self):
        of = subject_from_json(Reader(self.made["parameters"]))
        if isinstance(of, Parameters):
            of = Watched(**{each.name: getattr(of, each.name) for each in fields(of)})
        self.of, self.functions = of, read_maps(self.made["functions"])

    @cached_property
    def known(self):
        """What its steps prove, by name."""
        found = committed_conclusions(self.name) if self.is_committed else conclusions(self.made)
        return found[1]

    def used(self, name):
        """The parameters from which a step is proved: those that its rule looks at."""
        if name not in self.looked:
            Watched.seen.clear()
            with metered(math.inf) as meter:
                derived(Context(self.of, self.functions, self.known), name, self.made)
            self.looked[name], self.costs[name] = set(Watched.seen), meter.spent
        return self.looked[name]

    def allowed(self, names):
        """The work for an edited document of which these steps are derived anew."""
        own = [name for name in names if name in self.known and self.used(name) is not None]
        return WORK + 3 * sum(self.costs[name] for name in own)


@dataclass
class Tally:
    """What was judged: conclusions by type, verdicts by claim, and the complaints."""

    accepted: int = 0
    refused: int = 0
    idle: int = 0  # accepted, undecided, and nothing new is proved
    rules: Counter = field(default_factory=Counter)  # of edited steps that are accepted
    targets: Counter = field(default_factory=Counter)  # claims, or rules, that were looked for
    where: Counter = field(default_factory=Counter)  # in the space of parameters
    conclusions: Counter = field(default_factory=Counter)
    verdicts: Counter = field(default_factory=Counter)
    judged: Counter = field(default_factory=Counter)
    complaints: list[str] = field(default_factory=list)


@cache
def base_of(group: str, *numbers: str) -> Base:
    """A committed certificate, or what the prover finds at other parameters."""
    if not numbers:
        return Base(group, committed(group), is_committed=True)
    return Base(f"{group} at {', '.join(numbers)}", proved(group, *numbers))


@cache
def bases_of_no_claims() -> tuple[Base, ...]:
    """Files about formulas, maps and flights, and about boxes of oscillators."""
    return tuple(Base(name, made) for name, made in others())


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


def edited(base: Base, claim: str, sources: tuple[Base, ...], chance: Chance) -> dict | None:
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


def judge(base: Base, claim: str, made: dict[str, Any], tally: Tally, seed: str) -> bool:
    """Whether the checker accepts an edited document; if so the oracles look at what it says."""
    row = paper.find(claim)
    try:
        of = subject_from_json(Reader(made["parameters"]))
        old = unchanged(base, made, of)
        with metered(base.allowed({*made["steps"]} - old)):
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
        return False
    verdict = decision.verdict.value if decision else "VERIFIED"
    because = (*decision.because, *decision.corrected) if decision else ()
    new = [name for name in known if name not in old]
    if not new and (verdict == "UNDECIDED" or not decision) and not because:
        tally.idle += 1
        return True
    tally.accepted += 1
    tally.where.update(where_in_space(of))
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
    return True


def where_in_space(of: Any) -> list[str]:
    """In which corners of the space of parameters a document is."""
    eta, nu, epsilon = (getattr(of, name, None) or 0 for name in ("eta", "nu", "epsilon"))
    eta, nu, epsilon = (x[0] if isinstance(x, tuple) else x for x in (eta, nu, epsilon))
    corners = {"|nu| > 1": abs(nu) > 1, "eta <= 0.1": eta <= 0.1, "eta >= 2": eta >= 2}
    corners |= {"nu > 0": nu > 0, "epsilon >= 0.9": epsilon >= 0.9, "epsilon > 0": epsilon > 0}
    return [name for name, is_there in corners.items() if is_there and eta > 0]


def claims_of(bases: tuple[Base, ...]) -> dict[str, list[Place]]:
    """By claim the documents about it."""
    places: dict[str, list[Place]] = {}
    for base in bases:
        for claim in base.made["proofs"]:
            if paper.find(claim):
                places.setdefault(claim, []).append((base, claim))
    return places


def rules_of(bases: tuple[Base, ...]) -> dict[str, list[Place]]:
    """By rule the steps that it proves; those about flows by themselves."""
    places: dict[str, list[Place]] = {}
    for base in (*bases, *bases_of_no_claims()):
        flows = any("field" in function for function in base.made["functions"].values())
        for name, step in base.made["steps"].items():
            key = f"{step['rule']}, flows" if flows else step["rule"]
            places.setdefault(key, []).append((base, name))
    return places


def run(
    wanted: int,
    seed: int = 0,
    odd: tuple = (),
    told: bool = False,
    only: Collection[str] = (),
    enough: int = 60,
    targets: Callable[[tuple[Base, ...]], dict[str, list[Place]]] = claims_of,
) -> Tally:
    """Judge so many accepted documents, with as much time on each claim, or rule, as on another.

    odd: groups and parameters, beside those of the committed certificates; only: some claims, or
    rules. It ends where there are enough complaints.
    """
    tally, spent, tries, last = Tally(), Counter[Any](), Counter[Any](), time.monotonic()
    sources = (*map(base_of, certificates()), *(base_of(*each) for each in odd))
    places = {key: each for key, each in targets(sources).items() if not only or key in only}
    while tally.accepted < wanted and tries.total() < 60 * wanted:
        key = min(places, key=lambda x: spent[x] / (1 if tally.targets[x] >= ENOUGH else 4))
        name = min((base.name for base, _ in places[key]), key=lambda x: spent[key, x])
        base, target = random.Random(f"{seed} {key} {name} {tries[key, name]}").choice(
            [place for place in places[key] if place[0].name == name]
        )
        alike = sources if base in sources else bases_of_no_claims()
        begun, before = time.process_time(), tally.accepted
        attempt(base, target, alike, tally, f"{seed} {key} {name} {tries[key, name]}")
        for each in (key, (key, name)):
            spent[each] += time.process_time() - begun
        tries[key, name] += 1
        tally.targets[key] += tally.accepted - before
        if len(tally.complaints) >= enough:
            break
        if told and time.monotonic() > last + 60:
            print(report(tally, spent), flush=True)
            last = time.monotonic()
    return tally


def attempt(base: Base, target: str, alike: tuple[Base, ...], tally: Tally, seed: str) -> None:
    """Make an edit smaller until it is accepted, or until it is no other edit."""
    last = None
    for size in SIZES:
        made = edited(base, target, alike, Chance(seed, size))
        if made is None or made == last:
            return
        try:
            if judge(base, target, made, tally, f"{seed} {size}"):
                return
        except Exception as error:  # of the checker, which has none of its own, or of a judge
            tally.complaints.append(f"{error!r}: {json.dumps(made)[:4000]}")
            return
        last = made


def report(tally: Tally, spent: Counter | None = None) -> str:
    """The counts, as a table: of what is looked for, with its seconds, and of what that makes."""
    rows = [
        f"accepted {tally.accepted}, refused {tally.refused}, undecided with nothing new "
        f"{tally.idle}; {len(tally.judged)} different conclusions judged",
        f"where: {dict(sorted(tally.where.items()))}",
    ]
    for name in sorted({*tally.targets, *tally.rules}):
        seconds = (spent or {}).get(name, 0)
        rows.append(f"  {name:24} {tally.targets[name]:6} {tally.rules[name]:6} {seconds:8.1f}")
    rows += [f"  {name:24} {count}" for name, count in sorted(tally.conclusions.items())]
    verdicts = Counter(verdict for (_, verdict), n in tally.verdicts.items() for _ in range(n))
    rows += [f"verdicts {dict(verdicts)} of {len({claim for claim, _ in tally.verdicts})} claims"]
    rows += [f"COMPLAINT {one}" for one in tally.complaints]
    return "\n".join([*rows, f"{len(tally.complaints)} complaints"])


if __name__ == "__main__":
    wanted, seed, *way = sys.argv[1:]
    found = run(
        int(wanted), int(seed), ODD, told=True, targets=rules_of if "rules" in way else claims_of
    )
    print(report(found))
    sys.exit(bool(found.complaints))

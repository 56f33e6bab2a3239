"""A semantic falsifier: edits witnesses, proofs and parameters, and renews every text.

Blind mutation cannot find a false theorem, since every edit of a witness changes a text. Here the
texts of an edited document are what the checker's own functions make of it, so that what is left
to refuse a falsehood is the mathematics. What is accepted is judged, conclusion by conclusion and
row by row, by the oracles, which share nothing with the project but the paper.

An edited document is about one claim; steps that it has in common with a certificate, whose
premises and parameters are as they were, are not derived again. From the root,
`python -m tests.oracles.falsifier 50000` judges so many accepted documents.
"""

import copy
import json
import math
import random
import re
import sys
from collections import Counter
from dataclasses import dataclass, field, fields
from fractions import Fraction
from functools import cache
from typing import Any, ClassVar

from proofs.trusted import paper, verify
from proofs.trusted.certificate import Malformed, Reader, parameters_from_json
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import Exhausted, metered
from proofs.trusted.parameters import Parameters
from tests.oracles.judge import oracle
from tests.oracles.sources import (
    certificates,
    committed,
    committed_conclusions,
    conclusions,
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
NUMBERS = ("0", "1", "2", "1/2", "-1", "1/5", "7/5", "6/5", "3/2", "4/5", "31/5", "3", "22/7")
PARAMETERS = {  # some of one's own
    "eta": ("1/4", "1/6", "5/22", "2121/10000", "2123/10000", "1/2", "1", "13/10", "7/3"),
    "nu": ("-1/5", "1/5", "-19/20", "-9/20", "-3/10", "9/10", "-2001/10000"),
    "left": (["111/100", "23/20"], ["11/10", "113/100"], ["1/10", "1"], ["112/100", "23/20"]),
    "right": (["127/100", "33/25"], ["129/100", "33/25"], ["5", "31/5"], ["127/100", "131/100"]),
    "interval": (["111/100", "33/25"], ["1", "3/2"], ["1/10", "31/5"], ["0", "157/25"]),
    "slopes": (["21/5", "21/4"], ["6/5", "3/2"], ["4", "4"], ["43/10", "31/5"], ["1", "9"]),
    "ratios": (None, ["1/5", "1/5"], ["7/10", "4/5"], ["1/3", "2/3"], ["1905/10000", "2381/10000"]),
    "printed_s0": (None, "0.449", "0.44", "0.4", "0.448", "0.4485"),
    "epsilon": (None, "0", "1/100", "1/1000", "99/100", "1/50"),
    "velocities": (None, ["-9/20", "0"], ["-1/2", "0"], ["-9/20", "-1/5"], ["-1", "1"]),
    "reach": (None, ["0", "0", "0"], ["1/20000", "1/20000", "1/200"], ["1/100", "1/100", "1/200"]),
    "signs": (["-1", "-1"], ["-1", "1"], ["1", "-1"]),
}


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
        of = parameters_from_json(Reader(self.made["parameters"]))
        self.of = Watched(**{each.name: getattr(of, each.name) for each in fields(of)})

    def used(self, name):
        """The parameters from which a step is proved: those that its rule looks at."""
        if name not in self.looked:
            Watched.seen.clear()
            with metered(math.inf):
                derived(self.of, self.known, name, self.made["steps"][name])
            self.looked[name] = set(Watched.seen)
        return self.looked[name]


@dataclass
class Tally:
    """What was judged: conclusions by type, verdicts by claim, and the complaints."""

    accepted: int = 0
    refused: int = 0
    idle: int = 0  # accepted, undecided, and nothing new is proved
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


def derived(of: Parameters, known: dict[str, Any], name: str, step: dict[str, Any]) -> Any:
    """What a step proves, after those known."""
    found = Context(of, known=dict(known))
    verify.derive(found, Reader({name: step}))
    return found.known[name]


def needed(steps: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """The steps that some need, in order."""
    reached = set(names)
    for name, step in reversed(list(steps.items())):
        if name in reached:
            reached |= set(Reader(step).mentioned())
    return {name: step for name, step in steps.items() if name in reached}


# -- edits -----------------------------------------------------------------------------------------


def place(value: Any, chance: random.Random) -> tuple:
    """A path to a list, an object or a string inside, as likely near the root as deep."""
    inner = list(value) if isinstance(value, dict) else range(len(value))
    stay = {list: 0.3, dict: 0.05}.get(type(value), 1)
    if not inner or chance.random() < stay:
        return ()
    key = chance.choice(inner)
    return (
        (key, *place(value[key], chance)) if isinstance(value[key], list | dict | str) else (key,)
    )


def number(text: Any) -> Fraction | None:
    """A number, None if it is none."""
    try:
        return Fraction(text)
    except (ValueError, TypeError, ZeroDivisionError):
        return None


def edit_object(value: dict, chance: random.Random) -> dict:
    """The same members in another order, one less, one under another name, two exchanged."""
    names, kind = list(value), chance.randrange(4)
    one, two = chance.choice(names), chance.choice(names)
    if kind == 0:
        chance.shuffle(names)
        return {name: value[name] for name in names}
    if kind == 1:
        return {name: x for name, x in value.items() if name != one}
    if kind == 2:
        return {chance.choice((f"{one}1", two)) if x == one else x: y for x, y in value.items()}
    return {**value, one: value[two], two: value[one]}


def edit_formula(text: str, chance: random.Random) -> str:
    """The same function in other words, as often another one."""
    same = f"-(-({text}))", f"at({text}, truth=1)", f"({text})*1", f"{text} + 0", f"1/(1/({text}))"
    other = (
        f"-({text})",
        f"({text})*2",
        f"D({text}, epsilon)",
        text.replace(" + ", " - ", 1),
        text.replace("sin(", "cos(", 1),
        re.sub(r"[a-z]+\b(?!\()", lambda name: chance.choice(("nu", name[0])), text),
    )
    return chance.choice(same if chance.random() < 0.5 else other)


def edit_list(value: list, chance: random.Random) -> list:
    """The same list in another order, an entry more, less, or twice; a pair wider or narrower.

    A pair may become a point; all of a list may be gone.
    """
    if chance.random() < 0.03:
        return []
    value, kind = list(value), chance.randrange(5)
    pair = [number(each) for each in value]
    if len(value) == 2 and None not in pair and chance.random() < 0.75:
        if chance.random() < 0.15:
            return [chance.choice(value)] * 2
        step = (pair[1] - pair[0] or 1) / chance.choice((2, 10, 1000, 10**6, -3, -10, -1000))
        sides = chance.choice(((1, 1), (1, 0), (0, 1)))
        return [str(pair[0] - step * sides[0]), str(pair[1] + step * sides[1])]
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


def edit_text(text: str, chance: random.Random) -> str:
    """Another number: near by a part, by a turn of the table, or of another kind; a formula."""
    value = number(text)
    if value is None:
        numbers = list(re.finditer(r"(?<![A-Za-z_])\d+", text)) if "-" not in text[1:2] else []
        if re.search(r"[*(+]", text) and chance.random() < 0.6:
            return edit_formula(text, chance)
        if not numbers:
            return text
        one = chance.choice(numbers)
        return text[: one.start()] + str(chance.randint(1, 5)) + text[one.end() :]
    small = Fraction(chance.choice((-1, 1)), 10 ** chance.choice((2, 4, 6, 9, 12, 20, 30)))
    turn = Fraction("6.283185307179586") * chance.choice((-1, 1))
    choices = (value + small, value * (1 + small), value + turn, -value, 1 / (value or 1))
    weights = (6, 6, 1, 1, 1)
    return (
        str(chance.choices(choices, weights)[0])
        if chance.random() < 0.9
        else chance.choice(NUMBERS)
    )


def edit_parameters(given: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    """Another number, one of `PARAMETERS` or near by."""
    made = copy.deepcopy(given)
    name = chance.choices(list(PARAMETERS), (1, 1, 2, 2, 3, 3, 3, 2, 2, 2, 2, 1))[0]
    if chance.random() < 0.5 or made.get(name) is None:
        made[name] = copy.copy(chance.choice(PARAMETERS[name]))
    else:
        _put(made, (name, *place(made[name], chance)), chance)
    return made


def edit_step(
    steps: dict[str, Any], proof: list[str], others: list[dict[str, Any]], chance: random.Random
) -> None:
    """Edit a step of the proof, or another that it rests on; or take one like it from elsewhere."""
    known = [name for name in proof if name in steps]
    name = chance.choice(known if known and chance.random() < 0.6 else list(steps))
    if chance.random() < 0.1:
        rule = steps[name]["rule"]
        alike = [step for each in others for step in each["steps"].values() if step["rule"] == rule]
        steps[name] = chance.choice(alike)
        return
    steps[name] = copy.deepcopy(steps[name])
    path = place(steps[name]["witness"], chance)
    if path:
        _put(steps[name]["witness"], path, chance)


def transplant(made: dict[str, Any], proof: list[str], other: dict, chance: random.Random) -> None:
    """Add what another document proves of a claim, under other names."""
    taken = needed(other["steps"], other["proofs"][chance.choice(list(other["proofs"]))])
    names = {name: f"{name}-b" for name in taken}

    def renamed(value):
        if isinstance(value, list):
            return [renamed(each) for each in value]
        if isinstance(value, dict):
            return {key: renamed(each) for key, each in value.items()}
        return names.get(value, value)

    if len(taken) < 30:
        made["steps"] |= {names[name]: renamed(step) for name, step in taken.items()}
        proof[:0] = [names[name] for name in list(taken)[-6:]]


def edited(base: Base, claim: str, sources: tuple[Base, ...], chance: random.Random) -> dict | None:
    """A document about one claim, with one edit or a few; None if it is the same."""
    proof, others = list(base.made["proofs"][claim]), [each.made for each in sources]
    if chance.random() < 0.2:
        more = [name for name in base.made["steps"] if name not in proof]
        proof = edit_list(proof, chance) if proof else proof
        proof += chance.sample(more, min(len(more), chance.randrange(3)))
        proof = list(dict.fromkeys(proof))
    made = {"parameters": base.made["parameters"], "proofs": {claim: proof}}
    made["steps"] = needed(base.made["steps"], proof)
    for _ in range(chance.choice((0, 1, 1, 1, 2, 3))):
        kind = chance.random()
        if kind < 0.3 or not made["steps"]:
            made["parameters"] = edit_parameters(made["parameters"], chance)
        elif kind < 0.34:
            made["parameters"] = chance.choice(others)["parameters"]
        elif kind < 0.4:
            transplant(made, proof, chance.choice(others), chance)
        else:
            edit_step(made["steps"], proof, others, chance)
    same = all(base.made["steps"].get(name) is step for name, step in made["steps"].items())
    unchanged = same and proof == base.made["proofs"][claim]
    return None if unchanged and made["parameters"] == base.made["parameters"] else made


def _put(value: Any, path: tuple, chance: random.Random) -> None:
    for key in path[:-1]:
        value = value[key]
    old = value[path[-1]]
    edits = {list: edit_list, dict: edit_object, str: edit_text}
    if type(old) in edits and old:
        value[path[-1]] = edits[type(old)](old, chance)


# -- judging ---------------------------------------------------------------------------------------


def unchanged(base: Base, made: dict[str, Any], of: Parameters) -> set[str]:
    """The steps that prove what they did: same witness, premises, and numbers of the statement."""
    old: set[str] = set()
    changed = {name for name in PARAMETERS if getattr(of, name) != getattr(base.of, name)}
    for name, step in made["steps"].items():
        same = step is base.made["steps"].get(name)
        same = same and set(Reader(step).mentioned()) & set(made["steps"]) <= old
        if same and not (changed and base.used(name) & changed):
            old.add(name)
    return old


def judge(base: Base, claim: str, made: dict[str, Any], tally: Tally, seed: str) -> None:
    """Have the checker look at an edited document, and the oracles at what it accepts."""
    known: dict[str, Any] = {}
    try:
        with metered(WORK):
            of = parameters_from_json(Reader(made["parameters"]))
            old = unchanged(base, made, of)
            for name, step in made["steps"].items():
                known[name] = base.known[name] if name in old else derived(of, known, name, step)
            row = paper.find(claim)
            decision = row.decide(of, [known[name] for name in made["proofs"][claim]])
            _ = row.says(of), decision.why, decision.witness, decision.theorem
    except REFUSED:
        tally.refused += 1
        return
    verdict, new = decision.verdict.value, [known[name] for name in known if name not in old]
    if verdict == "UNDECIDED" and not new and not decision.corrected:
        tally.idle += 1
        return
    tally.accepted += 1
    tally.verdicts[claim, verdict] += 1
    told = verdict_oracle(claim, of, verdict)
    for conclusion in (*new, *decision.because, *decision.corrected):
        name = type(conclusion).__name__
        tally.conclusions[name] += 1
        key = hash((conclusion, of))
        if not tally.judged[key]:
            told += [f"{name}: {one}" for one in oracle(conclusion, random.Random(seed), of)]
        tally.judged[key] += 1
    if told:
        where = json.dumps({"base": base.name, "seed": seed, "claim": claim})
        tally.complaints += [f"{where}: {one}" for one in told]


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


def report(tally: Tally) -> str:
    """The counts, as a table."""
    rows = [
        f"accepted {tally.accepted}, refused {tally.refused}, undecided with nothing new "
        f"{tally.idle}; {len(tally.judged)} different conclusions judged"
    ]
    rows += [f"  {name:24} {count}" for name, count in sorted(tally.conclusions.items())]
    verdicts = Counter(verdict for (_, verdict), n in tally.verdicts.items() for _ in range(n))
    rows += [f"verdicts {dict(verdicts)} of {len({claim for claim, _ in tally.verdicts})} claims"]
    rows += [f"COMPLAINT {one}" for one in tally.complaints]
    return "\n".join([*rows, f"{len(tally.complaints)} complaints"])


if __name__ == "__main__":
    found = run(int(sys.argv[1]), int((sys.argv[2:] or ["0"])[0]), odd=ODD, told=True)
    print(report(found))
    sys.exit(bool(found.complaints))

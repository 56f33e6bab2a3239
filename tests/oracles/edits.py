"""Random edits of certificates: each makes another document, true or false, well-formed or not.

Numbers, ranges, lists and objects are moved, made points, emptied, exchanged, put in another order
or there twice; formulas are written in equal and in other words; steps and functions are taken from
elsewhere. The same edit may be made smaller: whatever is a number moves a part of the way.
"""

import copy
import random
import re
from contextlib import suppress
from fractions import Fraction
from typing import Any

from proofs.trusted.certificate import Reader

NUMBERS = ("0", "1", "2", "1/2", "-1", "1/5", "7/5", "6/5", "3/2", "4/5", "31/5", "3", "22/7")
PARAMETERS = {  # some of one's own
    "eta": ("1/4", "1/6", "5/22", "2121/10000", "2123/10000", "1/2", "1", "7/3", "1/100", "20"),
    "nu": ("-1/5", "1/5", "-19/20", "-3/10", "9/10", "-2001/10000", "1", "-3/2", "5/2", "1/1000"),
    "left": (["111/100", "23/20"], ["11/10", "113/100"], ["1/10", "1"], ["112/100", "23/20"]),
    "right": (["127/100", "33/25"], ["129/100", "33/25"], ["5", "31/5"], ["127/100", "131/100"]),
    "interval": (["111/100", "33/25"], ["1", "3/2"], ["1/10", "31/5"], ["0", "157/25"]),
    "slopes": (["21/5", "21/4"], ["6/5", "3/2"], ["4", "4"], ["43/10", "31/5"], ["1", "9"]),
    "ratios": (None, ["1/5", "1/5"], ["7/10", "4/5"], ["1/3", "2/3"], ["1905/10000", "2381/10000"]),
    "printed_s0": (None, "0.449", "0.44", "0.4", "0.448", "0.4485"),
    "epsilon": (None, "0", "1/100", "1/1000", "99/100", "1/50", "1/10000000", "999/1000"),
    "velocities": (None, ["-9/20", "0"], ["-1/2", "0"], ["-9/20", "-1/5"], ["-1", "1"]),
    "reach": (None, ["0", "0", "0"], ["1/20000", "1/20000", "1/200"], ["1/100", "1/100", "1/200"]),
    "signs": (["-1", "-1"], ["-1", "1"], ["1", "-1"]),
}


class Chance(random.Random):
    """Random choices, and how large edits are: 1, or less for the same edit on a smaller scale."""

    def __init__(self, seed: str, size: Fraction = Fraction(1)):
        super().__init__(seed)
        self.size = size


def part_of_the_way(old: Any, new: Any, size: Fraction) -> Any:
    """From a number or a pair towards another one; the other one where that has no meaning."""
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        return [part_of_the_way(a, b, size) for a, b in zip(old, new, strict=True)]
    one, two = number(old), number(new)
    return new if None in (one, two) else str(one + (two - one) * size)


def needed(steps: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """The steps that some need, in order."""
    reached = set(names)
    for name, step in reversed(list(steps.items())):
        if name in reached:
            reached |= set(Reader(step).mentioned())
    return {name: step for name, step in steps.items() if name in reached}


def place(value: Any, chance: Chance) -> tuple:
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


def edit_object(value: dict, chance: Chance) -> dict:
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


def edit_formula(text: str, chance: Chance) -> str:
    """The same function in other words, as often another one."""
    name, other_name = (
        chance.choice(re.findall(r"\b[a-z]\w*\b(?!\()", text) or ["x"]) for _ in "ab"
    )
    same = (
        *(f"-(-({text}))", f"at({text}, truth=1)", f"({text})*1", f"{text} + 0", f"1/(1/({text}))"),
        *(
            f"({text})**2/({text})",
            f"sqrt({text})**2",
            f"log(exp({text}))",
            f"{text} + 0*log({name})",
        ),
        *(f"at({text}, {name}={name})", f"sqrt(({text})**2)", f"({text})*{name}/{name}"),
    )
    other = (
        *(f"-({text})", f"({text})*2", f"D({text}, {name})", f"at({text}, {name}={name} + 1)"),
        *(f"sqrt({text})", f"({text})/{name}", f"({text})**2", f"({text})*{other_name}"),
        f"at({text}, {name}={other_name}, {other_name}={name})",
        text.replace(" + ", " - ", 1),
        text.replace("sin(", "cos(", 1),
        re.sub(r"[a-z]+\b(?!\()", lambda found: chance.choice(("nu", found[0][0])), text),
        re.sub(rf"\b{name}\b(?!\()", other_name, text),
    )
    return chance.choice(same if chance.random() < 0.5 else other)


def edit_list(value: list, chance: Chance) -> list:
    """The same list in another order, an entry more, less, or twice, or one in between; a pair
    wider or narrower or elsewhere.

    A pair may become a point; all of a list may be gone.
    """
    if chance.random() < 0.03:
        return []
    value, kind = list(value), chance.randrange(6)
    pair = [number(each) for each in value]
    if len(value) == 2 and None not in pair and chance.random() < 0.75:
        if chance.random() < 0.15:
            return [chance.choice(value)] * 2
        step = (pair[1] - pair[0] or 1) / chance.choice((2, 10, 1000, 10**6, -3, -10, -1000))
        step *= chance.size
        sides = chance.choice(((1, 1), (1, 0), (0, 1), (1, -1)))
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
    elif kind == 4 and None not in (number(value[i]), number(value[i - 1])):
        value.insert(i, part_of_the_way(value[i - 1], value[i], Fraction(1, 2)))
    else:
        value[i] = value[j]
    return value


def edit_text(text: str, chance: Chance) -> str:
    """Another number: near by a part, by a turn of the table, or of another kind; a formula."""
    value = number(text)
    if value is None:
        numbers = list(re.finditer(r"(?<![A-Za-z_])\d+", text)) if "-" not in text[1:2] else []
        if re.search(r"[*(+]", text) and chance.random() < 0.6:
            return edit_formula(text, chance)
        if not numbers:
            return text
        one = chance.choice(numbers)
        other = str(chance.randint(1, 5))
        if chance.random() < 0.7 and not text[: one.start()].endswith("**"):
            other = f"({part_of_the_way(one[0], other, chance.size / 10)})"
        return text[: one.start()] + other + text[one.end() :]
    small = Fraction(chance.choice((-1, 1)), 10 ** chance.choice((2, 4, 6, 9, 12, 20, 30)))
    small *= chance.size
    turn = Fraction("6.283185307179586") * chance.choice((-1, 1))
    choices = (value + small, value * (1 + small), value + turn, -value, 1 / (value or 1))
    weights = (6, 6, 1, 1, 1)
    if chance.random() < 0.9:
        return str(chance.choices(choices, weights)[0])
    return part_of_the_way(text, chance.choice(NUMBERS), chance.size)


def edit_parameters(given: dict[str, Any], chance: Chance) -> dict[str, Any]:
    """Another number, on the way to one of `PARAMETERS` or near by; of a box another side."""
    made = copy.deepcopy(given)
    if "left" not in made:
        name = chance.choice(list(made))
        if chance.random() < 0.5:
            other = chance.choice([each for each in PARAMETERS[name] if each])
            made[name] = part_of_the_way(made[name], [other, other], chance.size)
        else:
            made[name] = edit_list(made[name], chance) or ["1", "2"]
        return made
    name = chance.choices(list(PARAMETERS), (1, 1, 2, 2, 3, 3, 3, 2, 2, 2, 2, 1))[0]
    if chance.random() < 0.5 or made.get(name) is None:
        other = copy.copy(chance.choice(PARAMETERS[name]))
        made[name] = part_of_the_way(made.get(name), other, chance.size)
    else:
        put(made, (name, *place(made[name], chance)), chance)
    return made


def edit_function(functions: dict[str, Any], chance: Chance) -> dict[str, Any]:
    """Edit a map of a file: its formulas, names, parameters, periods, gaps, or its parts."""
    name = chance.choice(list(functions))
    changed = copy.deepcopy(functions[name])
    if path := place(changed, chance):
        put(changed, path, chance)
    told, before = str(changed), str(functions[name])
    if "gaps" in changed and ("at(" in told or told.count("D(") > before.count("D(")):
        return functions  # the judge of flights reads derivatives of motions by the time alone
    return functions | {name: changed}


def stretch(witness: dict[str, Any], chance: Chance) -> None:
    """Make an h-set longer or shorter in one of its directions."""
    by, j = Fraction(chance.choice((11, 2, 9, 30)), 10), chance.randrange(len(witness["centre"]))
    by = 1 + (by - 1) * chance.size
    for row in witness["matrix"]:
        row[j] = str(Fraction(row[j]) * by)
    witness["inverse"][j] = [str(Fraction(x) / by) for x in witness["inverse"][j]]


def edit_step(
    steps: dict[str, Any], proof: list[str], others: list[dict[str, Any]], chance: Chance
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
    if steps[name]["rule"] == "h-set" and chance.random() < 0.5:
        with suppress(LookupError, TypeError, ValueError):  # it may have been edited before
            stretch(steps[name]["witness"], chance)
        return
    path = place(steps[name]["witness"], chance)
    if path:
        put(steps[name]["witness"], path, chance)


def transplant(made: dict[str, Any], proof: list[str], other: dict, chance: Chance) -> None:
    """Add what another document proves of a claim, under other names."""
    proofs = other["proofs"] or {name: [name] for name in other["steps"]}
    taken = needed(other["steps"], proofs[chance.choice(list(proofs))])
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


def put(value: Any, path: tuple, chance: Chance) -> None:
    """Edit what is at a path."""
    for key in path[:-1]:
        value = value[key]
    old = value[path[-1]]
    edits = {list: edit_list, dict: edit_object, str: edit_text}
    if type(old) in edits and old:
        value[path[-1]] = edits[type(old)](old, chance)

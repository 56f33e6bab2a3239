"""No text of a file gets into a sentence: what conclusions are made of, and phrases put into files.

Whatever text a conclusion carries is a formula's tree, or one of the few kinds of words in `WORDS`.
"""

import copy
import dataclasses
import json
import re
import sys
import typing

import pytest

from proofs.trusted.files import render
from proofs.trusted.kernel.composition import Composition
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.flight import Flight
from proofs.trusted.kernel.formulas import Formulas
from proofs.trusted.kernel.maps import Map
from proofs.trusted.oscillator import PaperMap
from proofs.trusted.rules import RULES
from proofs.trusted.verify import premises
from tests.once import committed, report
from tests.oracles.sources import classes
from tests.proofs.trusted.edits import at, walk
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES
from tests.proofs.trusted.kernel.lemma_examples import text as lemma
from tests.proofs.trusted.paper.test_edits import REFUSED, SMALLER, again, shortest, source

NAME = r"[A-Za-z][A-Za-z0-9_]{0,11}|_[0-9]+"
OPERATION = r"[-+*/^]|negative|number|variable|pi|sqrt|exp|log|sin|cos"
WORDS = {  # the fields that are texts, and which: None for those that only the program writes
    "Variable.name": NAME,
    "Derivative.by": NAME,
    "At.names": r"_[0-9]+",
    "Expressions.expressions": NAME,
    "Formulas.variables": NAME,
    "Formulas.name": r"[A-Z][A-Za-z0-9]{0,11}|",
    "Formulas.given": None,
    "Equations.name": "f|F",
    "Equations.variables": "phi|gamma",
    "Circle.period": None,
    "Composition.name": r"[A-Z][A-Za-z0-9]{0,11}",
    "Motion.name": NAME,
    "Placer.places": NAME,
    "Placer.solutions": NAME,
    "PeriodicOrbit.stability": "attracting|a saddle|repelling",
    "Operation.op": OPERATION,
    "Node.op": OPERATION,
    "Step.op": OPERATION,
    "Meeting.other": "fold|flip",
    "Repeller.words": "[0-9]+",
    "Digits.printed": r"[0-9]+(\.[0-9]+)?",
    "Digits.name": None,
    "Theorem.text": None,
    "Theorem.tex": None,
    "Theorem.reported": None,
}
MAPS = (Formulas, Flight, PaperMap, Composition)  # all that are a `Map`, which is a protocol
PHRASES = ("the paper is wrong", "truth", "`, and all is proved", "1 = 1, hence x")


def parts(kind):
    """The types of the fields of a dataclass or a named tuple, by name."""
    known = {k: v for name in SOURCES for k, v in vars(sys.modules[name]).items()}
    hints = typing.get_type_hints(kind, {**known, **vars(sys.modules[kind.__module__])})
    if dataclasses.is_dataclass(kind):
        return {each.name: hints[each.name] for each in dataclasses.fields(kind)}
    return {name: hints[name] for name in getattr(kind, "_fields", ())}


def text_fields():
    """The fields of type str of all that conclusions are made of, and how many types these are."""
    found, seen, waiting = set(), set(), [("", Conclusion)]
    while waiting:
        where, kind = waiting.pop()
        if kind is str:
            found.add(where)
        waiting += [(where, inner) for inner in typing.get_args(kind)]
        own = isinstance(kind, type) and kind.__module__.startswith("proofs.") and kind not in seen
        if own and typing.get_origin(kind) is None:
            seen.add(kind)
            waiting += [(f"{kind.__name__}.{x}", y) for x, y in parts(kind).items()]
            waiting += [("", each) for each in (MAPS if kind is Map else kind.__subclasses__())]
    return found, len(seen)


classes()  # imports all of the trusted part
SOURCES = sorted(name for name in sys.modules if name.startswith("proofs.trusted"))


def test_conclusions_carry_no_other_texts():
    """A new field that is a text is a way from a file into a sentence: let it be a type."""
    found, count = text_fields()
    assert found == WORDS.keys() and count > 90


def words(value, where="", outer=()):
    """The texts inside of a conclusion, by field; what a map remembers may lead back to it."""
    if id(value) in outer:
        return
    outer = (*outer, id(value))
    if isinstance(value, str):
        yield where, value
    elif isinstance(value, list | tuple | frozenset | dict) and not hasattr(value, "_fields"):
        for each in value.items() if isinstance(value, dict) else value:
            yield from words(each, where, outer)
    elif dataclasses.is_dataclass(value) or hasattr(value, "_fields"):
        for name in getattr(value, "_fields", None) or [x.name for x in dataclasses.fields(value)]:
            yield from words(getattr(value, name), f"{type(value).__name__}.{name}", outer)


# -- phrases in files ------------------------------------------------------------------------------

SMALL = {x: text for x, text in committed().items() if "/" not in x and len(text) < 100_000}


def told(found):
    """All ways in which a conclusion is told."""
    return " ".join([found.sentence, found.brief, found.latex, *found.quantities])


@pytest.mark.slow
@pytest.mark.parametrize("rule", RULES)
def test_a_phrase_in_a_step_is_in_no_sentence(rule):
    if rule not in shortest() | SMALLER:
        pytest.skip("no committed file has such a step")
    steps, context, name = source(rule)
    witness = steps[name]["witness"]
    for where, text in words(context.known[name]):
        assert WORDS[where] is None or re.fullmatch(WORDS[where], text), (where, text)
    texts = [
        (place, value)
        for place, value in walk(witness)
        if isinstance(value, str) and not re.fullmatch(r"-?[0-9/]+", value)
    ]
    for place, value in texts[:3]:
        for text in (*PHRASES, f"{value} {PHRASES[0]}"):
            changed = copy.deepcopy(witness)
            at(changed, place[:-1])[place[-1]] = text
            try:
                found = again(context, name, rule, changed)
            except REFUSED:
                continue
            assert text not in re.sub(r"`[A-Za-z0-9_]*`", "", told(found))


def renamed(value, names):
    """A document with other names for its steps."""
    if isinstance(value, str):
        return names.get(value, value)
    if isinstance(value, list):
        return [renamed(each, names) for each in value]
    if isinstance(value, dict):
        return {names.get(key, key): renamed(each, names) for key, each in value.items()}
    return value


@pytest.mark.slow
@pytest.mark.parametrize("file", [*SMALL, *EXAMPLES])
def test_the_names_of_steps_are_in_no_sentence(file):
    text = SMALL.get(file) or lemma(file)
    document = json.loads(text)
    names = {name: f"false-{k}" for k, name in enumerate(document["steps"])}
    before = (report(file[:-5]).context if file in SMALL else premises(text)).known
    after = premises(render(renamed(document, names))).known
    for old, new in names.items():
        one, two = before[old], after[new]
        assert (one.sentence, one.brief, one.latex) == (two.sentence, two.brief, two.latex)

"""Steps of proofs, derived as the checker does, and numbers of `reference` as rationals."""

import copy
from dataclasses import replace
from fractions import Fraction
from functools import cache

from mpmath import mp

from proofs.search.evidence import Evidence
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.context import Context
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.parameters import PAPER
from proofs.trusted.rules import find_rule
from tests.oracles.edits import needed
from tests.oracles.sources import committed, committed_conclusions


@cache
def evidence(group):
    """What the committed certificate of a group proves, as the prover would hand it on."""
    made, (_, known) = committed(group), committed_conclusions(group)
    named = made["proofs"].items()
    return Evidence(made["steps"], {x: [(y, known[y]) for y in names] for x, names in named})


def known_of(group):
    """The conclusions of its steps, by name."""
    return committed_conclusions(group)[1]


@cache
def proved_by(group, *names):
    """What some steps of its certificate prove, which derives no others but those that they need.

    Arguments after the group: the names of the steps.
    """
    known = derive(needed(committed(group)["steps"], names))
    return [known[name] for name in names]


def apply(rule, witness, known=None, of=PAPER):
    """Derive the conclusion of one step."""
    return find_rule(rule)(Context(of, {}, known or {}), Reader(copy.deepcopy(witness)))


def derive(steps, of=PAPER, known=None, originals=None):
    """Derive steps in order; those that are as they were, and rest on none that is not, are known.

    Steps before the first that was edited are taken from `known`.
    """
    result, fresh = {}, False
    for name, step in steps.items():
        fresh = fresh or not known or step != originals[name]
        result[name] = apply(step["rule"], step["witness"], result, of) if fresh else known[name]
    return result


def texts(values):
    return [str(value) for value in values]


def add(amount):
    """Return the edit that moves a number."""
    return lambda text: str(Fraction(text) + Fraction(amount))


def exact(value):
    """A 50-digit number as a rational."""
    return Fraction(mp.nstr(value, 45))


def edited(steps, path, change):
    """Return a copy of nested lists and dictionaries with the value at a path changed."""
    result = copy.deepcopy(steps)
    *inner, last = path
    place = result
    for key in inner:
        place = place[key]
    place[last] = change(place[last])
    return result


def moved_to(found, place):
    """A conclusion as if it were about other oscillators."""
    about_map = "function" in getattr(found, "__dataclass_fields__", ())
    return replace(found, **({"function": PlasticMap(place)} if about_map else {"at": place}))

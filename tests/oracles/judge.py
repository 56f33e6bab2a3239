"""`oracle(conclusion, rng, of)`: complaints about a conclusion, by what shares nothing with it.

The judge of a class of conclusions is the function of its name in one of the modules.
"""

import re
from fractions import Fraction

from tests.oracles import (
    beyond,
    circle,
    curves,
    formulas,
    kernel,
    laps,
    lines,
    outcomes,
    planar,
    plastic,
    restitution,
    sets,
    single,
)
from tests.oracles.adapter import view

MODULES = (
    *(plastic, sets, circle, laps, restitution, single, formulas, kernel, beyond),
    *(curves, outcomes),
)
OTHER_NAMES = {
    "Impact": plastic.point,
    "Graze": outcomes.graze,
    "Separation": circle.separation_arc,
    "Between": laps.narrow,
    "Uncovered": sets.exact_measure,  # of which it is a consequence of the names alone
}


def judge_of(kind):
    """The judge of a class; None if there is none."""
    name = re.sub("(?<!^)(?=[A-Z])", "_", kind).lower()
    named = (getattr(module, name, None) for module in MODULES)
    return OTHER_NAMES.get(kind) or next(filter(callable, named), None)


def judge(record, rng):
    """Complaints about a record that `adapter.view` made."""
    own = planar.is_of_a_file(getattr(record, "base", record)) and lines.JUDGES.get(record.kind)
    return (own or judge_of(record.kind))(record, rng)


def oracle(conclusion, rng, of=None):
    """Complaints about a conclusion; of: the document's parameters, if it carries none itself."""
    return judge(view(conclusion, of, rng.choice((0, 1, Fraction(1, 3)))), rng)

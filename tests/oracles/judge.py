"""`oracle(conclusion, rng, of)`: complaints about a conclusion, by what shares nothing with it."""

from fractions import Fraction

from tests.oracles import (
    beyond,
    circle,
    curves,
    formulas,
    kernel,
    laps,
    lines,
    planar,
    plastic,
    restitution,
    sets,
    single,
    singles,
)
from tests.oracles.adapter import view

JUDGES = {
    name: judge
    for module in (
        plastic,
        sets,
        circle,
        laps,
        restitution,
        single,
        singles,
        formulas,
        kernel,
        beyond,
        curves,
    )
    for name, judge in module.JUDGES.items()
}


def judge(record, rng):
    """Complaints about a record that `adapter.view` made."""
    own = planar.is_of_a_file(getattr(record, "base", record)) and lines.JUDGES.get(record.kind)
    return (own or JUDGES[record.kind])(record, rng)


def oracle(conclusion, rng, of=None):
    """Complaints about a conclusion; of: the document's parameters, if it carries none itself."""
    return judge(view(conclusion, of, rng.choice((0, 1, Fraction(1, 3)))), rng)

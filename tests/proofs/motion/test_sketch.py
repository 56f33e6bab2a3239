"""Floats that stand for intervals in a search: like these, and never believed."""

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from intervals import DomainError, Interval
from proofs.motion import flight
from proofs.motion.impact import HORIZON
from proofs.motion.sketch import Sketch
from proofs.motion.system import System
from proofs.search.steps import Prover
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.parameters import PAPER

ends = st.lists(st.fractions(-9, 9, max_denominator=999), min_size=2, max_size=2).map(sorted)


def alike(seen, proved):
    """Whether a sketch has about the ends of an interval."""
    pairs = (seen.inf, proved.inf), (seen.sup, proved.sup)
    return all(math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-9) for x, y in pairs)


@pytest.mark.slow
@settings(deadline=None)
@given(ends, ends)
def test_operations_are_about_those_of_intervals(first, second):
    (x, y), (u, v) = ([kind(*ends) for ends in (first, second)] for kind in (Sketch, Interval))
    pairs = [(x + y, u + v), (x - y, u - v), (x * y, u * v), (-x, -u), (2 - x, 2 - u)]
    pairs += [(Fraction(1, 3) * x + 1, u / 3 + 1), (x**2, u * u), (Sketch(x.mid), Interval(u.mid))]
    pairs += [*zip(x.sincos(), u.sincos(), strict=True), (Sketch(x.wid), Interval(u.wid))]
    if y.mig > 0.01:
        pairs += [(x / y, u / v), (1 / y, 1 / v), (Sketch(y.mig), Interval(v.mig))]
    assert all(alike(*pair) for pair in pairs)
    assert x.contains_zero() == u.contains_zero()
    assert x.certainly_positive() == u.certainly_positive()
    assert x.certainly_negative() == u.certainly_negative()


def test_what_a_float_is_too_small_for_is_refused():
    for make in (
        lambda: Sketch(Fraction(10) ** 400),
        lambda: 1 / Sketch(Fraction(-1), Fraction(1)),
        lambda: Sketch(math.inf).sincos(),
        lambda: Sketch(math.nan).sincos(),
    ):
        with pytest.raises(DomainError):
            make()


def prover():
    return Prover(System(PAPER.eta, PAPER.nu), 30, HORIZON)


JOBS = {
    "slopes": lambda by: by.slopes([Fraction("1.27"), Fraction("1.32")]),
    "avoids": lambda by: by.avoids(PAPER.gap, PAPER.interval),
    "point": lambda by: by.point(Fraction("1.13")),
}


def by_intervals(monkeypatch, job):
    """What is proved where floats are no help."""
    with monkeypatch.context() as patch:
        patch.setattr(Sketch, "certainly_positive", lambda self: False)
        made = prover()
        return JOBS[job](made), made.steps


@pytest.mark.parametrize("job", JOBS)
def test_the_witness_is_that_of_intervals(job, monkeypatch):
    made = prover()
    found = JOBS[job](made)
    assert (found, made.steps) == by_intervals(monkeypatch, job)


@pytest.mark.parametrize("job", JOBS)
@pytest.mark.parametrize(
    ("name", "lie"),
    [
        ("certainly_positive", lambda self: True),
        ("certainly_negative", lambda self: True),
        ("sincos", lambda self: (Sketch(0.5, 0.6), Sketch(0.7, 0.8))),
        ("__mul__", lambda self, other: Sketch(1)),
    ],
)
def test_a_sketch_that_is_wrong_is_not_believed(name, lie, job, monkeypatch):
    """The rules refuse what it shows, and intervals find the proof."""
    expected = by_intervals(monkeypatch, job)
    monkeypatch.setattr(Sketch, name, lie)
    made = prover()
    assert (JOBS[job](made), made.steps) == expected


def test_floats_alone_conclude_nothing(monkeypatch):
    """Where intervals are not asked, a lie ends without a conclusion."""
    plain = Sketch.sincos
    monkeypatch.setattr(Sketch, "sincos", lambda self: plain(self * Fraction("1.001")))
    made = prover()
    with pytest.raises(Unproved):
        made._point(Fraction("1.13"), flight.sketch)
    assert "point-1" not in made.known

"""Enclosing in dictionaries of integers: the bounds of the objects, whatever is known before."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.evaluation import Partial, enclose
from proofs.trusted.kernel.formulas import on_tape
from proofs.trusted.kernel.operations import Enclosures
from proofs.trusted.kernel.trees import formula

TEXTS = (
    "x*t - t/(3 + x) + sin(x*t) - cos(t)",
    "exp(sin(x)) * t**3 - x**2",
    "sqrt(9 + x*x) - 7/5 + pi*t",
    "x*x - 1/3",
)
SIDE = st.tuples(*[st.integers(-200, 200)] * 2).map(sorted)


def sides(box, bits):
    return [Enclosure.of(*(Fraction(end, 100) for end in side), bits) for side in box]


TIMES, BITS = st.lists(SIDE, min_size=1, max_size=3), st.sampled_from([64, 100, 600])


@given(state=SIDE, times=TIMES, bits=BITS)
def test_the_bounds_are_those_of_the_objects(state, times, bits):
    formulas = on_tape(*map(formula, TEXTS), variables=("x", "t"))
    partial, tape = Partial(1), formulas.tape
    for time in times:
        x = sides((state, time), bits)
        own = tape.evaluate(formulas.roots, Enclosures(bits), x)
        for roots in (formulas.roots[::-1], formulas.roots):
            for known in (partial, None):
                found = enclose(tape, roots, x, bits, known)
                pairs = zip(found, own[::-1] if roots != formulas.roots else own, strict=True)
                assert all((a.lo, a.hi) == (b.lo, b.hi) for a, b in pairs)


def test_what_does_not_change_is_enclosed_once_and_what_changes_each_time():
    formulas = on_tape(formula("sin(x)*t"), variables=("x", "t"))
    partial, (root,) = Partial(1), formulas.roots
    for time in (100, 200):
        x = sides(((50, 50), (time, time)), 64)
        (value,) = enclose(formulas.tape, (root,), x, 64, partial)
        assert value.lo <= x[0].sincos()[0].lo * time // 100 + 2
        assert root not in partial.lower
    assert len(partial.lower) == 2  # x and sin(x)


@pytest.mark.parametrize("text", ["1/x", "sqrt(x - 1)", "log(x)", "exp(200 + x)", "10**90*(x + 1)"])
def test_what_is_not_proved_defined_or_too_large(text):
    formulas = on_tape(formula(text), variables=("x",))
    with pytest.raises(Unproved):
        enclose(formulas.tape, formulas.roots, sides(((0, 0),), 64), 64)

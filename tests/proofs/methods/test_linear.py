"""A linear horseshoe by the lemma kernel: two strips, each mapped affinely across both.

F(x, y) = (5|x| - 4, y/4 + sign(x)/2), with sqrt(x^2) for |x|. All is known: points with an infinite
past and future in the strips form a product of two Cantor sets, and F on it is the 2-shift.
"""

import json
from fractions import Fraction
from functools import cache

import pytest

from intervals import Undecided
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.files import render
from proofs.trusted.verify import check

MODULUS = "sqrt(x**2)"
LINEAR = (["x", "y"], [f"5*{MODULUS} - 4", f"y/4 + x/(2*{MODULUS})"])


def horseshoe(reach="21/100"):
    """|x| within `reach` of 4/5, all of |y| <= 1; for 1/5 the edges go to the edges exactly."""
    file = SymbolicLemmas({"F": LINEAR})
    return file, [file.h_set([x, "0"], [[reach, "0"], ["0", "1"]]) for x in ("-4/5", "4/5")]


@cache
def certificate():
    file, sets = horseshoe()
    graph = file.graph([file.covers("F", 1, a, b) for a in sets for b in sets])
    file.entropy(graph)
    file.cone(graph, ["4", "-1"])
    return render(file.document())


def test_the_two_shift():
    report = check(certificate())
    entropy, cone = report.sentences[-2:]
    assert "at least log(2), which lies in [0.69314718055" in entropy
    assert "exactly one full orbit" in cone
    for arrow in ("N1 => N1", "N1 => N2", "N2 => N1", "N2 => N2"):
        assert arrow in cone
    assert "(0.21, 0), (0, 1)" in cone


def test_a_cone_of_the_wrong_form():
    """5 > 1 > 1/4: 4 q_1^2 - q_2^2 increases along differences of orbits, the others do not."""
    file, sets = horseshoe()
    graph = file.graph([file.covers("F", 1, a, b) for a in sets for b in sets])
    for form in (["-1", "1"], ["1", "1"]):
        with pytest.raises(Undecided):
            file.cone(graph, form)


def test_the_bounds_of_the_derivative_are_those_of_the_strips():
    """In the coordinates of the strips F' is diag(+-5, 1/4), up to the enclosure of x/|x|."""
    relations = json.loads(certificate())["steps"]["cone-1"]["witness"]["relations"]
    for relation, sign in zip(relations, (-1, -1, 1, 1), strict=True):
        (a, b), _, _, (c, d) = ([Fraction(end) for end in ends] for ends in relation["jacobian"])
        assert a <= 5 * sign <= b and c <= Fraction(1, 4) <= d

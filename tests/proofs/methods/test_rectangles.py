"""Sets around cycles: horseshoes whose entropy is known, one of them linear; what is refused."""

from fractions import Fraction
from functools import cache
from math import log

import numpy as np
import pytest

from intervals import Undecided
from proofs.methods.newton import cycles, seeds
from proofs.methods.rectangles import Rectangles, _disjoint, lemma, rectangles
from proofs.methods.sampling import Sampled
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.files import render
from proofs.trusted.verify import check
from tests.proofs.trusted.kernel.lemma_examples import henon

HORSESHOE = henon("5", "3/10")  # all bounded orbits have |x| < 0.596: conjugate to the full shift


@cache
def horseshoe():
    sampled = Sampled(SymbolicLemmas({"F": HORSESHOE}).map("F"))
    box = [(Fraction("-3/5"), Fraction("3/5")), (Fraction("-1/5"), Fraction("1/5"))]
    orbits = [c for n in range(1, 8) for c in cycles(sampled, n, seeds(sampled, box, 1000 * n))]
    assert sum(len(c.points) for c in orbits if 6 % len(c.points) == 0) == 2**6
    return sampled, orbits


@pytest.mark.slow
@pytest.mark.parametrize(("past", "future"), [(1, 1), (1, 2)])
def test_the_full_shift(past, future):
    """One set for each word, two arrows from each; the entropy is log 2, and no more is proved."""
    sampled, orbits = horseshoe()
    sets = rectangles(sampled, orbits, angle=0.2, past=past, future=future)
    assert len(sets.centres) == 2 ** (past + future)
    assert np.bincount(sets.arrows[:, 0]).tolist() == [2] * len(sets.centres)
    file = SymbolicLemmas({"F": HORSESHOE})
    name = lemma(file, "F", sets)
    (sentence,) = check(render(file.document(name))).sentences
    low, high = map(Fraction, sentence.rpartition("[")[2].rstrip("].").split(", "))
    assert log(2) - 1e-9 < low < high < log(2) + 1e-9


@pytest.mark.slow
def test_each_point_is_in_the_set_of_its_word():
    sampled, orbits = horseshoe()
    sets = rectangles(sampled, orbits, angle=0.2, past=1, future=2)
    points = np.concatenate([orbit.points for orbit in orbits])
    local = np.linalg.solve(sets.matrices, (points[:, np.newaxis] - sets.centres)[..., np.newaxis])
    inside = (np.abs(local[..., 0]) < 1).all(axis=2)
    assert (inside.sum(axis=1) == 1).all() and inside.any(axis=0).all()


@pytest.mark.slow
def test_relations_that_are_not_proved_are_left_out():
    """An arrow the wrong way: without it there is the horseshoe as before."""
    sampled, orbits = horseshoe()
    sets = rectangles(sampled, orbits, angle=0.2, past=1, future=1)
    missing = {(i, j) for i in range(4) for j in range(4)} - set(map(tuple, sets.arrows.tolist()))
    more = Rectangles(*sets[:2], np.concatenate([sets.arrows, sorted(missing)]))
    files = [SymbolicLemmas({"F": HORSESHOE}) for _ in range(2)]
    one, two = (lemma(file, "F", some) for file, some in zip(files, (sets, more), strict=True))
    assert files[0].steps[one]["witness"]["growth"] == files[1].steps[two]["witness"]["growth"]
    assert len(files[0].steps) == len(files[1].steps)
    with pytest.raises(Undecided, match="no closed path"):
        lemma(files[0], "F", Rectangles(*sets[:2], np.array(sorted(missing))[:1]))


@pytest.mark.slow
def test_what_is_refused():
    sampled, orbits = horseshoe()
    with pytest.raises(Undecided, match="no two words"):
        rectangles(sampled, orbits, angle=1, past=1, future=1)
    with pytest.raises(Undecided, match="without end"):
        rectangles(sampled, orbits, angle=0.2, past=1, future=1, spare=3)


def test_sets_that_meet_go():
    """Three squares on a line, the middle one over the left one, with arrows between all."""
    centres, matrices = np.array([[0, 0], [0.5, 0], [3, 0]]), np.array([np.eye(2)] * 3)
    arrows = np.array([[i, j] for i in range(3) for j in range(3)])
    kept = _disjoint(centres, matrices / 2, arrows)
    assert set(kept.ravel().tolist()) in ({0, 2}, {1, 2}) and len(kept) == 4
    assert len(_disjoint(centres, matrices / 5, arrows)) == 9


# -- a linear horseshoe by the lemma kernel --------------------------------------------------------


MODULUS = "sqrt(x**2)"
LINEAR = (["x", "y"], [f"5*{MODULUS} - 4", f"y/4 + x/(2*{MODULUS})"])


def linear(reach="21/100"):
    """|x| within `reach` of 4/5, all of |y| <= 1; for 1/5 the edges go to the edges exactly."""
    file = SymbolicLemmas({"F": LINEAR})
    return file, [file.h_set([x, "0"], [[reach, "0"], ["0", "1"]]) for x in ("-4/5", "4/5")]


@cache
def certificate():
    file, sets = linear()
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
    file, sets = linear()
    graph = file.graph([file.covers("F", 1, a, b) for a in sets for b in sets])
    for form in (["-1", "1"], ["1", "1"]):
        with pytest.raises(Undecided):
            file.cone(graph, form)

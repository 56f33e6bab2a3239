"""Periodic orbits alone in a box, their least periods and multipliers: truths and lies."""

import json
import random
from fractions import Fraction

import numpy as np
import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.cycle import _stability, periodic_orbit
from proofs.trusted.verify import Rejected, check
from tests.once import examples
from tests.proofs.trusted.kernel.lemma_examples import text

LOGISTIC = {"variables": ["x"], "values": ["16/5*x*(1 - x)"]}
HENON = {"variables": ["x", "y"], "values": ["1 - 7/5*x**2 + y", "3/10*x"]}
TRIPLE = {"variables": ["x"], "periods": {"x": "1"}, "values": ["3*x"]}


def proved(data, period, box, matrix, turns=()):
    witness = {"function": "F", "period": period, "box": box, "matrix": matrix}
    witness |= {"turns": list(turns)} if turns else {}
    return periodic_orbit(
        Context(functions={"F": read_map("F", Reader(data), {})}), Reader(witness)
    )


TRUTHS = [
    (LOGISTIC, "1", [["0.68", "0.69"]], [["-5/11"]], (), "repelling"),
    (LOGISTIC, "2", [["0.51", "0.52"]], [["-6/5"]], (), "attracting"),
    (HENON, "1", [["0.63", "0.632"], ["0.189", "0.19"]], [["-1/3", "-1/3"], ["-1/10", "-1"]], (),
     "a saddle"),
    (TRIPLE, "1", [["2/5", "3/5"]], [["1/2"]], ("1",), "repelling"),
    (TRIPLE, "2", [["1/10", "3/20"]], [["1/8"]], ("1",), "repelling"),
]  # fmt: skip


def exact(box):
    return [[str(Fraction(x)) for x in side] for side in box]


@pytest.mark.every
@pytest.mark.parametrize(("data", "period", "box", "matrix", "turns", "stability"), TRUTHS)
def test_truths(data, period, box, matrix, turns, stability):
    found = proved(data, period, exact(box), matrix, turns)
    assert found.stability == stability
    assert ("fixed point" in found.sentence) == (period == "1")


SAME = "not proved to be different"
LIES = [  # what is false, the map, period, box, matrix, turns; the reason
    ("a fixed point of period 2", LOGISTIC, "2", [["0.687", "0.688"]], [["1/4"]], (), SAME),
    ("a fixed point on the circle", TRIPLE, "2", [["0.49", "0.51"]], [["1/8"]], ("4",), SAME),
    ("no orbit", LOGISTIC, "1", [["0.4", "0.5"]], [["-5/11"]], (), "strictly inside"),
    ("two orbits", LOGISTIC, "2", [["0.5", "0.8"]], [["-6/5"]], (), "strictly inside"),
    ("another matrix", LOGISTIC, "1", [["0.68", "0.69"]], [["5/11"]], (), "strictly inside"),
    ("other turns", TRIPLE, "1", [["2/5", "3/5"]], [["1/2"]], ("0",), "strictly inside"),
    ("no turns", TRIPLE, "1", [["2/5", "3/5"]], [["1/2"]], (), "needed there"),
    ("turns of nothing", LOGISTIC, "1", [["0.68", "0.69"]], [["1"]], ("1",), "for maps with ang"),
    ("half a turn", TRIPLE, "1", [["2/5", "3/5"]], [["1/2"]], ("1/2",), "an integer"),
    ("period 0", LOGISTIC, "0", [["0.68", "0.69"]], [["1"]], (), "an integer from 1"),
]


@pytest.mark.every
@pytest.mark.parametrize(
    ("data", "period", "box", "matrix", "turns", "reason"), [x[1:] for x in LIES],
    ids=[x[0] for x in LIES],
)  # fmt: skip
def test_lies(data, period, box, matrix, turns, reason):
    with pytest.raises((Unproved, Malformed), match=reason):
        proved(data, period, exact(box), matrix, turns)


def test_no_lie_about_the_multipliers_of_random_matrices():
    """The Jury conditions against eigenvalues, of matrices exact, wide and near the border."""
    rng, seen = random.Random(5), set()
    for _ in range(10 * examples(300)):
        n, width = rng.choice((1, 2, 3)), rng.choice((0, 0, 0.05, 0.5))
        most = 0.9 if n == 3 else 2.5
        middle = np.array([[rng.uniform(-most, most) for _ in range(n)] for _ in range(n)])
        said = _stability(
            [[Enclosure.of(Fraction(x - width), Fraction(x + width), 64) for x in row]
             for row in middle]
        )  # fmt: skip
        seen.add(said)
        for _ in range(4):
            sizes = abs(np.linalg.eigvals(middle + rng.uniform(-width, width) * signs(n, rng)))
            fits = {
                None: n > 2 or width > 0 or np.min(abs(sizes - 1)) < 1e-9 or complex_border(sizes),
                "attracting": np.max(sizes) < 1,
                "repelling": np.min(sizes) > 1,
                "a saddle": np.min(sizes) < 1 < np.max(sizes),
            }
            assert fits[said], (middle, width, said, sizes)
    assert seen == {None, "attracting", "repelling", "a saddle"}


def signs(n, rng):
    return np.array([[rng.choice((-1, 1)) for _ in range(n)] for _ in range(n)])


def complex_border(sizes):
    return abs(np.prod(sizes) - 1) < 1e-9


def test_of_three_variables_attraction_alone_is_said():
    def said(size):
        value = Enclosure.of(Fraction(size), Fraction(size), 64)
        return _stability([[value * int(i == j) + int(j == i + 1) for j in range(3)]
                           for i in range(3)])  # fmt: skip

    assert [said(size) for size in ("1/2", "9/10", "1", "2")] == ["attracting"] * 2 + [None] * 2


def test_a_determinant_around_one_decides_nothing():
    zero, wide = (Enclosure.of(*map(Fraction, x), 64) for x in (("0", "0"), ("0.9", "1.1")))
    assert _stability([[zero, -wide], [wide, zero]]) is None


@pytest.mark.parametrize(
    ("example", "field", "value", "reason"),
    [
        ("ball", "turns", ["2"], "strictly inside"),
        ("ball", "period", "2", "strictly inside|not proved"),
        ("rattle", "turns", ["0"], "strictly inside"),
        ("rattle", "function", "U", "strictly inside"),
    ],
)
def test_lies_about_flights(example, field, value, reason):
    document = json.loads(text(example))
    document["steps"]["periodic-orbit-1"]["witness"][field] = value
    if field == "function":
        del document["functions"]["P"], document["functions"]["V"]
    with pytest.raises(Rejected, match=reason):
        check(render(document))

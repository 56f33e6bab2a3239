"""The transcription Arithmetic.v against the checker's own functions, on random numbers."""

import random
import re
import subprocess
from fractions import Fraction

import pytest

from proofs.formal import coqc
from proofs.trusted.kernel import arithmetic
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi
from tests.proofs.formal.coq import needs_coqc

pytestmark = [pytest.mark.slow, needs_coqc]

BITS = (8, 24, 53, 64, 113, 250)
HEAD = f"""From Coq Require Import ZArith List.
From {coqc.NAME} Require Import Arithmetic.
Import ListNotations.
Open Scope Z_scope.
Definition E := Enclosure.
Definition ends (X : enclosure) : list Z := [lo X; hi X].
Definition found (X : option enclosure) : list Z := match X with Some X => ends X | None => [] end.
Definition pair (X : option (enclosure * enclosure)) : list Z :=
  match X with Some (sin, cos) => ends sin ++ ends cos | None => [] end.
Set Printing Width 1000000.
"""


@pytest.fixture(scope="module")
def transcription(tmp_path_factory):
    """Arithmetic.v compiled, in a folder."""
    folder = tmp_path_factory.mktemp("arithmetic")
    coqc.copy(coqc.theory(["Arithmetic"], print), folder, ["Arithmetic"], ".vo")
    return folder


def evaluated(folder, terms):
    """The lists of integers that Coq computes."""
    lines = [f"Eval vm_compute in {term}." for term in terms]
    (folder / "Asked.v").write_text(HEAD + "\n".join(lines) + "\n")
    command = ["coqc", *coqc.OPTIONS, "Asked.v"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    values = re.findall(r"^     = (\[.*?\]|nil)", done.stdout, re.MULTILINE)
    return [[int(x) for x in re.findall(r"-?\d+", value)] for value in values]


def term(x: Enclosure) -> str:
    return f"(E ({x.lo}) ({x.hi}))"


def ends(*found: Enclosure) -> list[int]:
    return [end for each in found for end in (each.lo, each.hi)]


def number(rng, bits):
    """An integer of any size and sign, or one next to a multiple of pi/2."""
    if rng.random() < 0.3:
        return rng.randint(-9, 9) * pi(bits).lo // 2 + rng.randint(-2, 2)
    return rng.randint(-1, 1) * rng.getrandbits(rng.randint(1, bits + 8)) + rng.randint(-1, 1)


def enclosure(rng, bits):
    width = rng.choice([0, 1, rng.getrandbits(bits // 2), rng.getrandbits(bits + 3)])
    low = number(rng, bits)
    return Enclosure(low, low + width, bits)


def proved(compute):
    try:
        return ends(compute())
    except Unproved:
        return []


def cases(rng):
    """One term of Coq and its value in Python for each operation."""
    bits = rng.choice(BITS)
    x, y, n = enclosure(rng, bits), enclosure(rng, bits), rng.randint(-99, 99)
    low, high = sorted(Fraction(rng.randint(-999, 999), rng.randint(1, 999)) for _ in range(2))
    one, two = term(x), term(y)
    fraction = f"({low.numerator}) {low.denominator} ({high.numerator}) {high.denominator}"
    yield f"ends (fractions {bits} {fraction})", ends(Enclosure.of(low, high, bits))
    yield f"ends (neg {one})", ends(-x)
    yield f"ends (add {one} {two})", ends(x + y)
    yield f"ends (sub {one} {two})", ends(x - y)
    yield f"ends (add {one} (integer {bits} ({n})))", ends(x + n)
    yield f"ends (mul {bits} {one} {two})", ends(x * y)
    yield f"ends (scale {one} ({n}))", ends(x * n)
    yield f"found (div {bits} {one} {two})", proved(lambda: x / y)
    yield f"ends (pow {bits} {one} 3)", ends(x**3)
    yield f"ends (hull {one} {two})", ends(x.hull(y))
    yield f"found (meet {one} {two})", proved(lambda: x.meet(y))
    yield f"found (pi 500 {bits})", ends(pi(bits))
    yield f"pair (sincos 500 {bits} {one})", ends(*x.sincos())


def differences(folder, count, seed):
    rng = random.Random(seed)
    asked = [case for _ in range(count) for case in cases(rng)]
    given = evaluated(folder, [text for text, _ in asked])
    assert len(given) == len(asked)
    return [
        (text, value, by) for (text, value), by in zip(asked, given, strict=True) if value != by
    ]


def test_coq_and_python_compute_the_same_integers(transcription):
    assert differences(transcription, 6, 1) == []


@pytest.mark.long
def test_coq_and_python_compute_the_same_integers_often(transcription):
    assert differences(transcription, 400, 2) == []


def test_another_rounding_is_noticed(transcription, monkeypatch):
    """The comparison fails if one step of the checker's loop differs."""
    original = arithmetic._sincos_between

    def wider(lo, hi, bits):
        sin, cos = original(lo, hi, bits)
        return (sin[0], sin[1] + 1), cos

    monkeypatch.setattr(arithmetic, "_sincos_between", wider)
    assert differences(transcription, 2, 3) != []

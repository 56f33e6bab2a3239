"""Section 5: its lemmas by sympy, its equations read a second time, and misprints."""

import random
from fractions import Fraction

import mpmath as mp
import pytest

from proofs.search.derivations import Steps, enclose
from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.formulas import read_formulas
from proofs.trusted.kernel.values import Equal, Series, equal
from proofs.trusted.paper.formulas import differ
from proofs.trusted.paper.s5_soft import displayed as eq
from proofs.trusted.paper.s5_soft import soft, stability
from proofs.trusted.parameters import PAPER
from tests.oracles.algebra import agrees

ROWS = (*soft.ROWS, *stability.ROWS)


@pytest.mark.slow
@pytest.mark.parametrize("each", [5, pytest.param(1, marks=pytest.mark.long)])
def test_sympy_proves_every_lemma(each):
    lemmas = [x for row in ROWS for x in row.needs if isinstance(x, Equal | Series)]
    assert all(map(agrees, lemmas[::each]))


# -- bent certificates -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("printed", "misprinted"),
    [
        (eq.S27, eq.S27.replace("- g/omega_n", "+ g/omega_n")),
        (eq.JACOBIAN[0], "1 + (1 + epsilon)/2*alpha"),
        (eq.TRUE26, eq.S26),
    ],
)
def test_a_misprint_is_refuted_and_what_is_right_is_not(printed, misprinted):
    names = read_formulas(Reader(printed)).variables
    point = {name: str(Fraction(n + 2, 7)) for n, name in enumerate(names)}
    for other, met in ((misprinted, True), (f"{printed} + 0", False)):
        asked = differ(other, printed, **point)
        assert asked.met_by(Steps(20).prove(asked)[1]) is met


def test_nothing_and_the_printed_identity_decide_nothing():
    witness = {"left": eq.DISCRIMINANT, "right": eq.PRINTED_SUM}
    with pytest.raises(Unproved, match="differ"):
        equal(Context(PAPER), Reader(witness))
    for row in ROWS:
        assert row.decide(PAPER, []).verdict.value == "UNDECIDED"


# -- the equations, read a second time -------------------------------------------------------------


def printed_equations(p, beta, omega, wn, eps, g, m, psi, v, psi1):
    """Transcribe (24)-(29) from the paper once more, by hand, for numbers."""
    s, c = mp.sin, mp.cos
    phase = wn / omega * (psi1 - psi + 2 * mp.pi * m)
    out = -eps * v + (1 + eps) * beta * omega * c(psi)
    th = 2 * mp.pi * m * wn / omega
    low = 1 + eps * c(th)
    return {
        eq.S24: (-p + beta * s(psi)) * c(phase)
        + out / wn * s(phase)
        - 2 * g / wn**2 * s(phase / 2) ** 2
        + p
        - beta * s(psi1),
        eq.S25: out * c(phase) - wn * (-p + beta * s(psi)) * s(phase) - g / wn * s(phase),
        eq.S26: (-p + beta * s(psi)) * c(th)
        + out / wn * s(th)
        - 2 * g / wn**2 * s(th) ** 2
        + p
        - beta * s(psi),
        eq.S27: out * c(th) - wn * (-p + beta * s(psi)) * s(th) - g / wn * s(th),
        eq.S28: 2 * (p - beta * s(psi)) * s(th / 2) ** 2
        + eps * (-p + beta * s(psi)) * s(th) ** 2 / (wn * low)
        + eps * g * s(th) ** 2 / (wn**2 * low)
        - 2 * g / wn**2 * s(th / 2) ** 2
        + (1 + eps) * beta * omega * c(psi) * s(th) / (wn * low),
        eq.S29: -wn * (-p + beta * s(psi)) * s(th) / low
        - g * s(th) / (wn * low)
        + (1 + eps) * beta * omega * c(psi) * c(th) / low,
    }


def test_transcriptions_against_a_second_reading():
    names = ["p", "beta", "omega", "omega_n", "epsilon", "g", "m", "psi", "v", "psi1"]
    chance = random.Random(3)
    with mp.workdps(40):
        for _ in range(3):
            point = [Fraction(chance.randint(1, 40), 17) for _ in names]
            numbers = [mp.mpf(x.numerator) / x.denominator for x in point]
            for text, expected in printed_equations(*numbers).items():
                low, high = enclose(text, 25, **dict(zip(names, point, strict=True)))
                assert mp.mpf(low.numerator) / low.denominator <= expected + mp.mpf(10) ** -35
                assert mp.mpf(high.numerator) / high.denominator >= expected - mp.mpf(10) ** -35


def step(rho, eps, psi, lam, guess):
    """Solve the limit map for the next impact near a guess of the flight."""
    speed = -eps * lam + (1 + eps) * rho * mp.cos(psi)

    def gap(t):
        return rho * mp.sin(psi) + speed * t - t * t - rho * mp.sin(psi + t)

    t = mp.findroot(gap, guess)
    return psi + t, speed - 2 * t


def fixed(rho, eps, m):
    return mp.acos((1 - eps) * 2 * mp.pi * m / ((1 + eps) * rho))


def jacobian(rho, eps, m):
    h = mp.mpf(10) ** -20
    c, psi = 2 * mp.pi * m, fixed(rho, eps, m)
    columns = []
    for d in ((h, 0), (0, h)):
        ends = [step(rho, eps, psi + s * d[0], -c + s * d[1], c) for s in (1, -1)]
        columns.append([(a - b) / (2 * h) for a, b in zip(*ends, strict=True)])
    return columns


@pytest.mark.parametrize(("m", "eps"), [(1, "1/2"), (2, "1/5"), (1, "9/10"), (3, "0")])
def test_the_flip_is_where_an_eigenvalue_is_minus_one(m, eps):
    low, high = enclose(eq.flip(eq.ALPHA_FLIP), 40, m=Fraction(m), epsilon=Fraction(eps))
    with mp.workdps(50):
        rho = mp.mpf(low.numerator) / low.denominator + mp.mpf(high.numerator) / high.denominator
        (a, b), (c, d) = jacobian(
            rho / 2, mp.mpf(Fraction(eps).numerator) / Fraction(eps).denominator, m
        )
        assert abs(1 + a + d + a * d - b * c) < 1e-25

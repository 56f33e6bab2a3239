"""Curves in the plane of eta and nu: closed forms, published limits, section 4, brute force."""

import copy
import json
import math
import random
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from proofs.methods.arcs import follow, thin
from proofs.search.curves import Curves, seen_curves
from proofs.shell.groups import produce
from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.equations import clock, return_map_derivative
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import BEYOND
from proofs.trusted.paper.beyond.curves import ROWS, curves, sticking
from proofs.trusted.paper.beyond.grazing import (
    ETA,
    GrazingCurve,
    P,
    gap_along,
    grazing_curve,
    nu_squared,
    ratio,
    single_launch,
    touch,
)
from proofs.trusted.paper.beyond.meetings import Meeting, meeting
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import check
from tests.oracles import curves as oracle

F = Fraction
SINGLE = json.loads((Path(__file__).parents[4] / "reports" / "single.json").read_text())
KNOWN = {name: x for claim in SINGLE["claims"] for name, x in claim["quantities"].items()}


def known(name):
    return float(KNOWN[name]["lower"])


def fold(n, q, eta):
    return -((q * eta * math.tan(math.pi * n * eta)) ** 2)


def flip(n, q, eta):
    return eta**2 * (q * q + 1 / math.cos(math.pi * n * eta) ** 2)


def nu_at(n, q, eta, p):
    return math.sqrt(nu_squared(n, F(q), (eta, p), math.pi))


# -- closed forms ----------------------------------------------------------------------------------


@pytest.mark.parametrize("epsilon", [0, 0.1, 0.5, 0.9])
def test_multipliers_of_the_return_map(epsilon):
    """Trace and determinant of the derivative that the equations give, at solutions."""
    rng = random.Random(epsilon)
    for _ in range(40):
        n, eta, p = rng.randint(1, 3), rng.uniform(0.05, 2), rng.uniform(-3, 0.9)
        x, q = math.pi * n * eta, F(epsilon).limit_denominator(100)
        start = single_launch(n, ratio(q), 1, (eta, p), math.pi)
        now = clock(eta, 2 * math.pi * n)
        (a, b), (c, d) = return_map_derivative(start, now, epsilon)
        trace = 2 * epsilon + math.cos(x) ** 2 * (
            (1 - epsilon) ** 2 - (1 + epsilon) ** 2 * p / eta**2
        )
        size = 1 + abs(a) + abs(b * c) + abs(d)
        assert abs(a + d - trace) < 1e-8 * size
        assert abs(a * d - b * c - epsilon**2) < 1e-8 * size * size


@pytest.mark.parametrize("n", [1, 2, 3])
def test_windows_of_section_4_are_cuts_at_nu_one_fifth(n):
    at_flip, at_stick = known(f"eta_flip_{n}"), known(f"eta_stick_{n}")
    assert nu_at(n, 1, at_flip, flip(n, 1, at_flip)) == pytest.approx(0.2, abs=1e-12)
    assert nu_at(n, 1, at_stick, at_stick**2) == pytest.approx(0.2, abs=1e-12)
    saddle = known(f"eta_below_saddle_{n}")
    assert nu_at(n, 1, saddle, fold(n, 1, saddle)) == pytest.approx(0.2, abs=1e-12)


def test_the_window_that_ends_by_grazing_is_a_cut():
    eta = F(KNOWN["eta_late_graze"]["lower"])
    side, p, t = oracle.grazing(1, 0, float(eta))
    box, _ = thin(touch(1, F(0)), ETA, [eta, F(p), F(t)], 20)
    assert side == -1
    assert nu_at(1, 1, float(eta), float(box[P][0])) == pytest.approx(0.2, abs=1e-13)


@pytest.mark.parametrize("epsilon", [0.0, 0.2, 0.6])
def test_soft_springs_are_the_bouncing_ball(epsilon):
    """rho = 2 nu/eta^2 -> 2 pi n q at folds, 2 sqrt((1 + q^2)^2 + (pi n q)^2) at flips.

    Source: Guckenheimer and Holmes 1983, section 2.4 (gamma at the saddle-node), and the exact
    bouncing ball, e.g. Luo and Han 1996; for epsilon = 0 sqrt(16 + (2 pi n)^2), row S23.
    """
    q, eta = (1 - epsilon) / (1 + epsilon), 1e-4
    for n in (1, 2):
        for p, rho in (
            (fold(n, q, eta), 2 * math.pi * n * q),
            (flip(n, q, eta), 2 * math.hypot(1 + q * q, math.pi * n * q)),
        ):
            assert 2 * nu_at(n, q, eta, p) / eta**2 == pytest.approx(rho, rel=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize(("row", "theorem"), [(ROWS[0], curves), (ROWS[3], sticking)])
def test_the_theorem_needs_each_lemma(row, theorem):
    from proofs.search.derivations import Steps
    from proofs.trusted.verdicts import Found

    steps = Steps(20)
    proved = [steps.prove(need)[1] for need in theorem.needs]
    assert row.own and row.decide(PAPER, proved).verdict is Verdict.VERIFIED
    for k in range(len(proved)):
        rest = [*proved[:k], *proved[k + 1 :]]
        assert row.decide(PAPER, rest).verdict is Verdict.UNDECIDED
        assert theorem.prove(Found(PAPER, rest)) is None


# -- curves of grazing, and what false witnesses come to -------------------------------------------


@cache
def found():
    """A part of the curve for n = 2, with the point where it meets the folds."""
    made = Curves(F(0))
    made.grazing(2, [x for x in seen_curves(2, F(0))[-1] if 1.41 < x.eta < 1.45])
    return made


def steps_of():
    first, second = (step["witness"] for step in found().derivation.steps.values())
    return copy.deepcopy(first), copy.deepcopy(second)


@cache
def checked():
    return grazing_curve(Context(), Reader(steps_of()[0]))


def judged(witness):
    """What the second step says beside the first one."""
    return meeting(Context(known={"grazing-curve-1": checked()}), Reader(witness))


@pytest.mark.slow
def test_amplitudes_are_known_to_many_places():
    curve, point = checked(), judged(steps_of()[1])
    assert isinstance(curve, GrazingCurve) and isinstance(point, Meeting) and curve.amplitudes
    assert all(high - low < F(1, 10**12) for low, high in (*curve.amplitudes, point.amplitude))


@pytest.mark.slow
def test_rows_are_decided_by_what_is_about_their_epsilon():
    curve, point = checked(), judged(steps_of()[1])
    plastic, other = (replace(PAPER, epsilon=F(x)) for x in ("0", "0.01"))
    for row, known, said in ((ROWS[1], curve, "touches the table once"), (ROWS[2], point, "folds")):
        here, there = row.decide(plastic, [known]), row.decide(other, [known])
        assert here.verdict is Verdict.VERIFIED and said in here.theorem
        assert there.verdict is row.decide(plastic, []).verdict is Verdict.UNDECIDED


@pytest.mark.slow
def test_orbits_are_on_the_side_that_is_said():
    """Simulated: an impact 2 pi n later on one side of the curve, an earlier one on the other."""
    curve = checked()
    for point in curve.arc.points:
        eta, p = float(point[ETA][0]), float(point[P][0])
        assert oracle.repeats(2, 0.0, eta, p - 1e-4, -1) is True
        assert oracle.repeats(2, 0.0, eta, p + 1e-4, -1) is False


@pytest.mark.slow
def test_the_gap_of_a_piece_is_enclosed():
    curve, rng = checked(), random.Random(7)
    for piece in curve.arc.pieces[::3]:
        gap_of = gap_along(curve.n, ratio(curve.epsilon), curve.side, piece)
        for _ in range(20):
            share, time = F(rng.random()), F(rng.uniform(0.1, 12))
            eta = piece.box[ETA][0] + share * (piece.box[ETA][1] - piece.box[ETA][0])
            low, high = piece.cut(ETA, eta)[P]
            p = float(low + F(rng.random()) * (high - low))
            value = -oracle.distance(2, 0, float(eta), p, float(time)) / (1 - p)
            found = gap_of((time, time), 0).range
            assert float(found[0]) - 1e-9 <= value <= float(found[1]) + 1e-9


def edit(name, change):
    def edited(witness):
        witness[name] = change(witness[name])

    return edited


def entry(name, k, change):
    def edited(witness):
        witness[name][k] = change(witness[name][k])

    return edited


LIES = [
    edit("n", lambda x: str(int(x) + 1)),
    edit("epsilon", lambda x: "1/2"),
    edit("pieces", lambda x: [x[0], *x[2:]]),
]


@pytest.mark.parametrize("change", LIES)
def test_false_curves_are_refused(change):
    witness = steps_of()[0]
    change(witness)
    with pytest.raises((Unproved, Malformed)):
        grazing_curve(Context(), Reader(witness))


def mirrored(point):
    """The same zero at -eta: the equations are even in eta."""
    (low, high), *rest = point["box"]
    first, *others = point["matrix"]
    turned = [str(-F(x)) for x in first]
    box = [[str(-F(high)), str(-F(low))], *rest]
    return {"box": box, "matrix": [turned, *others]}


MISSED = [
    edit("other", lambda x: "cusp"),
    edit("box", lambda x: mirrored(x)),
]


@pytest.mark.parametrize("change", MISSED)
def test_false_meetings_are_refused(change):
    witness = steps_of()[1]
    change(witness)
    with pytest.raises((Unproved, Malformed)):
        judged(witness)


def test_touches_before_an_earlier_impact_are_refused():
    """For n = 2 near eta = 1.42 there is a touch at 3.72, and an impact at 7.47 < 4 pi."""
    start = [F("1.42"), F("0.230927"), F("3.71823")]
    (traced,) = follow(touch(2, F(0)), ETA, start, F("1.4201"), step=F(1, 100))
    witness = {"n": "2", "epsilon": "0", "pieces": [traced.witness]}
    with pytest.raises(Unproved, match="impact is not proved"):
        grazing_curve(Context(), Reader({**witness, "points": []}))


def test_touches_that_would_come_after_the_impact_are_refused():
    """For n = 1 near eta = 0.2, epsilon = 1/2, the gap is 0 again at 8.69, if it is followed past
    2 pi; before, flights touch nothing.
    """
    start, epsilon = [F("0.2"), F("0.276977"), F("8.691")], F(1, 2)
    (traced,) = follow(touch(1, epsilon), ETA, start, F("0.2001"), step=F(1, 100))
    assert not any(oracle.distance(1, 0.5, 0.2, 0.277127, t / 50) <= 0 for t in range(1, 314))
    witness = {"n": "1", "epsilon": "1/2", "pieces": [traced.witness]}
    with pytest.raises(Unproved, match="before the impact"):
        grazing_curve(Context(), Reader({**witness, "points": []}))


def test_a_curve_that_ends_before_does_not_meet():
    short = steps_of()[0]
    short["pieces"] = short["pieces"][:4]
    short["points"] = []
    curve = grazing_curve(Context(), Reader(short))
    assert F(short["pieces"][-1]["box"][0][1]) == curve.arc.ends[1]
    with pytest.raises(Unproved, match="meet once"):
        meeting(Context(known={"grazing-curve-1": curve}), Reader(steps_of()[1]))


@pytest.mark.long
@pytest.mark.parametrize(("epsilon", "count"), [("0", 1), ("0.3", 4)])
def test_all_curves_from_the_search_to_the_checker(epsilon, count):
    of = replace(PAPER, epsilon=F(epsilon))
    made = produce({"curves": BEYOND["curves"]}, of, digits=20)
    report = check(made.certificate)
    assert {claim.verdict for claim in report.claims} == {Verdict.VERIFIED}
    points = next(line for line in made.lines if line.id == "C3").quantities
    assert sum(name.startswith("eta_") for name in points) == count
    assert all(high - low < F(1, 10**12) for low, high in points.values())

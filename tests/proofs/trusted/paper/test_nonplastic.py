"""Claims N1-N3: verdicts against independent numbers, and certificates that must be rejected."""

import copy
import json
import math
import random
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from mpmath import mp, mpf

from proofs.shell.groups import produce
from proofs.trusted.certificate import Malformed
from proofs.trusted.files import render
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.parameters import PAPER
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted.paper import reference


@cache
def made(of, *claims):
    """The entries of claims by id, and the certificate, which the checker accepts."""
    found = produce({"nonplastic": claims}, of, digits=30)
    certificate = json.loads(found.certificate)
    entries = {entry["id"]: entry for entry in certificate["claims"]}
    checked = {claim.id: claim.verdict.value for claim in check(found.certificate).claims}
    assert checked == {line.id: line.verdict.value for line in found.lines}
    assert checked == {claim: entry["verdict"] for claim, entry in entries.items()}
    return entries, certificate


@pytest.fixture(scope="module")
def paper():
    return made(PAPER, "N1", "N2")


def pair_of(low, high):
    return Fraction(low), Fraction(high)


# -- what is proved --------------------------------------------------------------------------------


def corner(phi, gamma, near):
    """The image phase of a state, by the root of (14) typed by hand, at 50 digits."""
    numbers = [mpf(x) for x in ("0.2121", "-0.2", "0.01", phi, gamma)]
    time = mp.findroot(lambda t: reference.left_side_14(*numbers, t), near)
    return (numbers[3] + time) % (2 * mp.pi)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "state"),
    [
        ("image_of_left_edge_of_V1", ("1.11", "0", 25.13)),
        ("image_of_right_edge_of_V1", ("1.15", "-0.45", 25.28)),
        ("image_of_left_edge_of_V2", ("1.27", "0", 56.36)),
        ("image_of_right_edge_of_V2", ("1.32", "-0.45", 56.53)),
    ],
)
def test_extreme_images_of_the_edges(paper, name, state):
    printed = paper[0]["N1"]["quantities"][name]
    true = corner(*state)
    assert mpf(printed["lower"]) <= true <= mpf(printed["upper"])
    assert mpf(printed["upper"]) - mpf(printed["lower"]) < mpf(10) ** -25


def image(numbers, state, begin=0.1):
    """F in floating point, by a scan of (14); no impact comes before the time `begin`."""
    phi, gamma = state

    def height(t):
        return -reference.left_side_14(*numbers, phi, gamma, t, math.sin, math.cos)

    t = begin
    while height(t + 0.005) > 0:
        t += 0.005
    low, high = t, t + 0.005
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if height(middle) > 0 else (low, middle)
    velocity = reference.right_side_15(*numbers, phi, gamma, low, math.sin, math.cos)
    return (phi + low) % math.tau, velocity


def symbol(state):
    phases = ((1.11, 1.15), (1.27, 1.32))
    return next((i for i, (low, high) in enumerate(phases) if low <= state[0] <= high), None)


def test_barred_words_are_not_seen_and_others_are():
    random.seed(1)
    seen = set()
    for _ in range(600):
        state = (random.choice((1.11, 1.27)) + random.uniform(0, 0.05), random.uniform(-0.45, 0))
        word = []
        while (now := symbol(state)) is not None and len(word) < 6:
            word.append(now)
            state = image((0.2121, -0.2, 0.01), state, 24.0 if state[0] < 1.2 else 56.0)
        seen.update(tuple(word[i:j]) for i in range(len(word)) for j in range(i + 1, len(word) + 1))
    assert {(0, 0), (0, 1), (1, 0), (1, 1)} <= seen
    assert not seen & {(1, 1, 1, 1, 1), (0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1)}


@pytest.mark.parametrize("edge", [1.11, 1.15, 1.27, 1.32])
def test_full_orbits_without_22_have_no_state_on_an_edge(edge):
    """So Lambda_2 is in the open rectangles: V2 is followed by V1 there, V1 by either; velocities
    before impacts are in (-0.45, 0).
    """
    for gamma in (-0.45, -0.3, -0.15, 0.0):
        state, word = (edge, gamma), []
        for _ in range(2):
            state = image((0.2121, -0.2, 0.01), state, 24.0 if state[0] < 1.2 else 56.0)
            word.append(symbol(state))
            assert -0.45 < state[1] < 0
            if word[-1] is None:
                break
        assert word[0] != 0 if edge > 1.2 else word in ([None], [1, None], [1, 1])


def other(**change):
    """Other numbers, with an I that holds all sets of phases."""
    return replace(PAPER, interval=pair_of("1.1", "1.4"), **change)


def slow(*case):
    return pytest.param(*case, marks=pytest.mark.slow)


WIDER = other(left=pair_of("1.11", "1.16"), right=pair_of("1.27", "1.33"))
BOTH_OPEN = {"N1": "UNDECIDED", "N2": "UNDECIDED"}
ONE_OPEN = {"N1": "REFUTED", "N2": "UNDECIDED"}


@pytest.mark.parametrize(
    ("of", "verdicts", "texts"),
    [
        (
            PAPER,
            {"N1": "REFUTED", "N2": "VERIFIED"},
            [
                "V2 V2 V2 V2",
                "short of 1.32 by at least 0.019174",
                "V1 = [1.11, 1.16] x [-0.45, 0], V2 = [1.27, 1.33] x [-0.45, 0]",
                "golden mean",
                "physically possible",
            ],
        ),
        slow(
            PAPER,
            {"N3": "VERIFIED"},
            [
                "eta in [0.21205, 0.21215], nu in [-0.20675, -0.19825], epsilon in [0, 0.015]",
                "without 22",
                "short of 1.35 by at least 0.0018",
            ],
        ),
        slow(  # a rectangle grazes; the images of its corners are proved all the same
            other(nu=Fraction("-0.25")),
            BOTH_OPEN,
            ["the right edge of V2 to a phase in [1.015248, 1.015249]"],
        ),
        slow(  # an edge alone refutes
            other(eta=Fraction("0.212")),
            {"N1": "REFUTED"},
            ["left edge of V1 to a phase in [1.114936, 1.114937], short of 1.11 by at least"],
        ),
        slow(WIDER, {"N1": "VERIFIED", "N2": "VERIFIED"}, []),
        slow(other(epsilon=Fraction(0)), ONE_OPEN, []),  # the left edge of V1 fails
        slow(other(velocities=pair_of("-0.3", 0)), ONE_OPEN, []),  # images leave them
        slow(other(velocities=pair_of("0.5", 1)), BOTH_OPEN, []),  # impossible states
        (other(epsilon=None), BOTH_OPEN, []),
        (other(velocities=None), BOTH_OPEN, []),
    ],
)
def test_verdicts_and_what_is_said(of, verdicts, texts):
    entries, certificate = made(of, *verdicts)
    assert {claim: entry["verdict"] for claim, entry in entries.items()} == verdicts
    first = next(iter(entries.values()))
    said = " ".join(first[part] or "" for part in ("why", "witness", "corrected"))
    assert [text for text in texts if text not in said] == []
    assert len(render(certificate)) < 1_000_000


# -- what must be rejected -------------------------------------------------------------------------


def broken(made_of, change):
    """Why a certificate is rejected after a change."""
    certificate = copy.deepcopy(made_of[1])
    change(certificate)
    with pytest.raises((Rejected, Malformed)) as failure:
        check(json.dumps(certificate))
    return str(failure.value)


def entry(certificate, claim):
    return next(one for one in certificate["claims"] if one["id"] == claim)


def steps(certificate, rule):
    return [step["witness"] for step in certificate["steps"].values() if step["rule"] == rule]


def widened(values):
    low, high = map(Fraction, values)
    share = Fraction(1, 20)
    return [str(low - abs(low) * share), str(high + abs(high) * share)]


@pytest.mark.parametrize(
    ("path", "change", "reason"),
    [
        (("function", "eta"), widened, ""),
        (("function", "nu"), widened, ""),
        (("function", "epsilon"), widened, ""),
        (("box", 0), widened, ""),
        (("box", 1), lambda x: [x[0], "1/2"], "launch"),  # from inside the table
        (("box", 1), lambda x: ["-2/5", x[1]], ""),
        (("box",), lambda x: x[:1], "entries"),
        (("box",), lambda x: x[::-1], ""),
        (("turns",), lambda x: [str(int(x[0]) + 1)], ""),
        (("turns",), lambda x: ["1/2"], "integer"),
        (("turns",), lambda x: [], "entries"),
        (("cuts",), lambda x: ["0"], "increase"),
        (("cuts",), lambda x: x * 2, "increase"),
        (("cuts",), lambda x: ["2"], "increase"),
        (("function", "eta"), lambda x: ["-1", "1"], "required"),
        (("function", "eta"), lambda x: ["0", "1"], "required"),
        (("function", "nu"), lambda x: ["-1/5", "1/5"], "positive or negative"),
        (("function", "nu"), lambda x: ["0", "1/5"], "positive or negative"),
        (("function", "epsilon"), lambda x: ["-1/100", "1/100"], "required"),
        (("function", "epsilon"), lambda x: ["1/100", "11/10"], "required"),
        (("function", "gravity"), lambda x: ["0", "0"], "unknown field"),
        (("function",), lambda x: "F", "names no function"),
    ],
)
def test_impacts_are_not_talked_into(paper, path, change, reason):
    def edit(certificate):
        one = steps(certificate, "rectangle")[0]
        for key in path[:-1]:
            one = one[key]
        old = one[path[-1]] if isinstance(one, list) else one.get(path[-1])
        assert old != change(old)
        one[path[-1]] = change(old)

    assert reason in broken(paper, edit)


def without(index):
    return lambda names: [name for k, name in enumerate(names) if k != index]


@pytest.mark.parametrize(
    ("rule", "field", "change"),
    [
        *(("golden-mean", "words", without(index)) for index in range(4)),
        ("golden-mean", "part", lambda x: "rectangle-1"),
        ("horseshoe", "rectangles", lambda x: ["rectangle-1", "rectangle-2"]),
        ("horseshoe", "rectangles", lambda x: x[::-1]),
        ("horseshoe", "arrows", lambda x: [["1"], ["1", "2"]]),
        ("barred-word", "word", lambda x: x[:2]),
        ("barred-word", "word", lambda x: ["1"] * len(x)),
        ("barred-word", "word", lambda x: ["2", "3"]),
        ("barred-word", "word", lambda x: []),
        ("barred-word", "from", lambda x: "below"),
        ("barred-word", "from", lambda x: "left"),
        ("barred-word", "rectangles", lambda x: x[::-1]),
        ("barred-word", "rectangles", lambda x: x[:1] * 2),
        ("barred-word", "rectangles", lambda x: ["barred-word-1", "rectangle-1"]),
    ],
)
def test_theorems_are_not_talked_into(paper, rule, field, change):
    def edit(certificate):
        one = steps(certificate, rule)[0]
        assert one[field] != change(one[field])
        one[field] = change(one[field])

    broken(paper, edit)


@pytest.mark.parametrize(
    ("field", "value"),
    [("eta", "1061/5000"), ("epsilon", "1/50"), ("nu", "-19/100"), ("velocities", ["-1/2", "0"])],
)
def test_other_parameters(paper, field, value):
    broken(paper, lambda certificate: certificate["parameters"].update({field: value}))


@pytest.mark.slow
def test_too_much_work(paper):
    certificate = copy.deepcopy(paper[1])
    one = steps(certificate, "rectangle")[0]
    low, high = map(Fraction, one["box"][0])
    one["cuts"] = [str(low + (high - low) * k / 4000) for k in range(1, 4000)]
    with pytest.raises(Exhausted):
        check(json.dumps(certificate), 10**6)

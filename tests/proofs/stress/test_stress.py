import json
import os
import time
from dataclasses import replace
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from intervals import Interval, IntervalArray
from proofs.benchmark.peers import FLINT, arithmetic
from proofs.motion.witness import NoImpact
from proofs.shell.backstop import within
from proofs.stress import __main__ as command
from proofs.stress import arithmetic as drawn
from proofs.stress import cases
from proofs.stress.__main__ import main
from proofs.stress.arithmetic import function_case, operation_case
from proofs.stress.cases import flight
from proofs.stress.families import FAMILIES
from proofs.stress.judge import Outcome, judge, text
from proofs.stress.truth import BITS, Launched, first_impact, graze
from tests.proofs.trusted.paper import reference
from tests.proofs.trusted.paper.reference import as_mpf

pytest.importorskip("flint")
KERNEL = arithmetic(FLINT, BITS)
COUNT = int(os.environ.get("STRESS_CASES", "5000"))
EXACT = ("operations", "functions", "arrays")
ETA, NU, FAR = Fraction("0.2121"), Fraction("-0.2"), Fraction(1000)


@pytest.fixture
def by():
    return KERNEL


def close(bounds, value, slack):
    return as_mpf(bounds[0]) - slack <= value <= as_mpf(bounds[1]) + slack


def truths(kernel, function, low, high):
    return function_case("functions", function, (low, high)).truths(kernel)


def point(phi, **options):
    return flight("tangent", (ETA, NU), (Fraction(phi), Fraction(phi)), **options)


# -- the truth, against what was typed and published elsewhere -------------------------------------


@pytest.mark.parametrize(
    "given", [("0.2121", "-0.2", "1.11"), ("0.2121", "-0.2", "6.2"), ("1.7", "2.5", "4.5")]
)
def test_the_truth_agrees_with_a_scan_of_equation_10(by, given):
    known = [as_mpf(Fraction(x)) for x in given]
    flight, phase = reference.first_impact(*known)
    found = first_impact(by, Launched(*map(Fraction, given)), FAR).bounds
    assert close(found["flight"], flight, mpf(10) ** -40)
    assert mp.fabs(mp.sin((as_mpf(found["phase"][0]) - phase) / 2)) < mpf(10) ** -40
    assert close(found["slope"], reference.slope(*known, flight), mpf(10) ** -15)
    assert all(high - low <= abs(low) / Fraction(10) ** 90 for low, high in found.values())


def test_the_truth_after_sticking(by):
    leave = reference.separation_phase(mpf("0.2121"), mpf("-0.2"))
    flight, _ = reference.first_impact(mpf("0.2121"), mpf("-0.2"), leave)
    found = first_impact(by, Launched(ETA, NU, Fraction(5)), FAR).bounds
    assert close(found["flight"], flight, mpf(10) ** -30)
    assert mp.fabs(mp.sin((as_mpf(found["dwell"][0]) - (leave - 5)) / 2)) < mpf(10) ** -45
    assert found["slope"] == (0, 0)


def test_the_truth_with_restitution_solves_14_and_15(by):
    of = Launched(ETA, NU, Fraction("1.11"), Fraction("0.1"), Fraction("-0.5"))
    found = first_impact(by, of, FAR).bounds
    state = [as_mpf(x) for x in (of.eta, of.nu, of.epsilon, of.phi, of.gamma)]
    flight = as_mpf(found["flight"][0])
    assert mp.fabs(reference.left_side_14(*state, flight)) < mpf(10) ** -45
    assert close(found["velocity"], reference.right_side_15(*state, flight), mpf(10) ** -45)
    step = Fraction(1, 10**12)
    for name in ("phi", "gamma"):
        moved = replace(of, **{name: getattr(of, name) + step})
        other = first_impact(by, moved, FAR).bounds
        for quantity in ("phase", "velocity"):
            quotient = (other[quantity][0] - found[quantity][0]) / step
            assert abs(found[f"{quantity} by {name}"][0] - quotient) < Fraction(1, 10**7)


def test_the_truth_without_impact(by):
    never = first_impact(by, Launched(ETA, Fraction("0.02"), Fraction(1)), FAR)
    assert not never.bounds and never.reason == "the mass stays on the table"
    later = first_impact(by, Launched(ETA, NU, Fraction("1.11")), Fraction(10))
    assert not later.bounds and later.reason == "no impact up to the horizon"


@pytest.mark.slow
def test_each_graze_is_seen_from_both_sides(by):
    """Next to a grazing launch the flight is about as long as the graze, or much longer."""
    for k in range(20):
        eta, nu, phase = graze(by, k)
        beside = [Launched(eta, nu, phase + side * Fraction(1, 10**25)) for side in (-1, 1)]
        low, high = sorted(first_impact(by, of, FAR).bounds["flight"][0] for of in beside)
        assert high - low > Fraction(1, 2)


@pytest.mark.parametrize(
    ("function", "ends", "expected"),
    [("sin", (0, 7), (-1, 1)), ("sin", (1, 2), (None, 1)), ("cos", (-1, 1), (None, 1)),
     ("cos", (3, 4), (-1, None)), ("cosh", (-1, 2), (1, None)), ("sin", (4, 5), (-1, None)),
     ("cos", ("-456142519478952627/10", "-136842755843685788/3"), (-1, None))],
)  # fmt: skip
def test_ranges_have_their_turning_points(by, function, ends, expected):
    found = truths(by, function, *map(Fraction, ends))
    for truth, value in zip(found, expected, strict=True):
        assert value is None or truth.bounds["value"] == (value, value)


# -- the verdicts ----------------------------------------------------------------------------------

ONE, TWO, THREE, SEVEN = map(Fraction, (1, 2, 3, 7))
SINE = function_case("functions", "sin", (THREE, THREE), 64)
EXP = function_case("arrays", "exp", (ONE, TWO), array=True)
TAN = function_case("functions", "tan", (ONE, TWO))
BY_ZERO = operation_case("operations", "/", ((ONE, TWO), (-ONE, ONE)))
SEVERAL = flight("intervals", (ETA, NU), (Fraction("1.17"), Fraction("1.2")), 12)
REBOUND = flight(
    "restitution",
    (ETA, NU),
    (Fraction("1.11"), Fraction("1.11")),
    before=(Fraction("0.1"), Fraction("-0.5")),
)
SOUND = [
    *(SINE, EXP, point("1.11"), REBOUND),
    operation_case("operations", "/", ((ONE, TWO), (THREE, SEVEN))),
    operation_case("operations", "*", ((-ONE, TWO), (-THREE, SEVEN)), array=True),
    flight("intervals", (ETA, NU), (Fraction("1.27"), Fraction("1.32")), 12),
]
NEVER = point("1.11", horizon=10)


@pytest.mark.slow
@pytest.mark.parametrize("case", SOUND, ids=lambda case: case.family)
def test_a_sound_answer_is_enclosed(case):
    found = judge(case, KERNEL, 10.0)
    assert found.outcome is Outcome.ENCLOSED and found.width < 2
    assert judge(SEVERAL, KERNEL, 10.0).outcome is Outcome.POSSIBLE


def up(bounds):
    return bounds[0] + Fraction(1, 10**25), bounds[1] + Fraction(1, 10**25)


def moved_entry(found, k):
    entries = [*found.jacobian]
    entries[k] = up(entries[k])
    return replace(found, jacobian=tuple(entries))


DEFECTS = [  # what is broken, how, and a case on which it shows
    *((cases, "image", lambda x, q=q: replace(x, **{q: up(getattr(x, q))}), point("1.11"))
      for q in ("flight", "phase", "slope")),
    *((cases, "rebound", lambda x, q=q: replace(x, **{q: up(getattr(x, q))}), REBOUND)
      for q in ("flight", "phase", "velocity")),
    *((cases, "rebound", lambda x, k=k: moved_entry(x, k), REBOUND) for k in range(4)),
    (cases, "image", lambda x: replace(x, images=x.images[:1]), SEVERAL),
    (Interval, "sin", lambda x: x * (1 + Fraction(1, 2**48)), SINE),
    (IntervalArray, "exp", lambda x: x * (1 + Fraction(1, 2**48)), EXP),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("holder", "name", "spoil", "case"), DEFECTS)
def test_a_wrong_answer_excludes_the_truth(monkeypatch, holder, name, spoil, case):
    sound = getattr(holder, name)
    monkeypatch.setattr(holder, name, lambda *args, **options: spoil(sound(*args, **options)))
    found = judge(case, KERNEL, 10.0)
    assert found.outcome is Outcome.EXCLUDED and "not " in found.reason
    assert found.case == case


@pytest.mark.parametrize("name", ["__add__", "__sub__", "__mul__", "__truediv__"])
@pytest.mark.parametrize("kind", [Interval, IntervalArray])
def test_an_operation_rounded_inward_excludes_the_truth(monkeypatch, kind, name):
    """By a part in 2^40 of its width: each operation of each type."""
    sound = getattr(kind, name)

    def broken(x, y):
        found = sound(x, y)
        inward = (found.sup - found.inf) / 2**40
        if kind is Interval:
            return Interval(found.inf + inward, found.sup - inward, precision=100)
        return IntervalArray.from_floats(found.inf + inward, found.sup - inward)

    monkeypatch.setattr(kind, name, broken)
    symbol = {"__add__": "+", "__sub__": "-", "__mul__": "*", "__truediv__": "/"}[name]
    pairs = (ONE, TWO), (THREE, SEVEN)
    case = operation_case("operations", symbol, pairs, array=kind is IntervalArray)
    assert judge(case, KERNEL).outcome is Outcome.EXCLUDED


@pytest.mark.parametrize(
    ("case", "holder", "name"),
    [(TAN, Interval, "tan"), (BY_ZERO, Interval, "__truediv__"), (NEVER, cases, "image")],
)
def test_a_value_where_there_is_none_excludes_the_truth(monkeypatch, case, holder, name):
    image = cases.image(cases.System(ETA, NU), (Fraction("1.11"),) * 2)
    assert judge(case, KERNEL).outcome is Outcome.REFUSED
    monkeypatch.setattr(holder, name, lambda x, *_, **options: image if options else x)
    found = judge(case, KERNEL)
    assert found.outcome is Outcome.EXCLUDED and "there is no value" in found.reason


def raises(error):
    def broken(*args, **options):
        raise error

    return broken


def test_a_refusal_is_missed_only_where_there_is_an_impact(monkeypatch):
    monkeypatch.setattr(cases, "image", raises(NoImpact("none")))
    assert judge(NEVER, KERNEL).outcome is Outcome.REFUSED
    assert judge(point("1.11"), KERNEL).outcome is Outcome.MISSED


def busy(seconds):
    began = time.process_time()
    while time.process_time() < began + seconds:
        pass


@pytest.mark.slow
def test_what_takes_too_long_is_stopped_and_the_alarm_is_off(monkeypatch):
    monkeypatch.setattr(cases, "image", lambda *args, **options: busy(9))
    assert judge(point("1.11"), KERNEL, 0.05).outcome is Outcome.STOPPED
    with within(0.05, "VIRTUAL"):
        pass
    busy(0.1)


# -- the cases and the command ---------------------------------------------------------------------


@pytest.mark.slow
def test_the_command_reports_a_failure_and_exits_1(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(Interval, "exp", lambda x: x)
    monkeypatch.setattr(drawn, "NAMES", ("exp",))
    out = tmp_path / "new"
    assert main(["--family", "functions", "--cases", "4", "--out", str(out)]) == 1
    text = capsys.readouterr().out
    assert "4 EXCLUDE THE TRUTH" in text and "function = exp" in text
    data = json.loads((out / "stress.json").read_text())
    assert data["failures"] == 4 and data["cases"][0]["outcome"] == "EXCLUDES THE TRUTH"
    assert "## Failures" in (out / "stress.md").read_text()
    monkeypatch.setattr(Interval, "exp", raises(KeyError("lost")))
    assert main(["--family", "functions", "--cases", "2"]) == 1
    assert "CRASHED: family = functions: KeyError: 'lost'; input" in capsys.readouterr().out


HARD = [  # shrunk from random cases on which the library is weakest
    flight("resonance", (1 + Fraction(1, 10**20), Fraction("-0.4")), (TWO, TWO), 20, 50),
    flight("rational", (Fraction(1, 3), NU), (Fraction("1.5707"),) * 2, horizon=100),
    flight("intervals", (ETA, NU), (Fraction(0), Fraction("6.2831")), horizon=100),
    flight("chatter", (ETA, NU), (Fraction("3.5"),) * 2,
           before=(Fraction("0.16"), Fraction("-0.88303318574285"))),
    flight("restitution", (ETA, NU), (Fraction("1.4181"), Fraction("1.4181000000001")),
           before=(ONE, Fraction("-7.7"))),
    flight("separation", (ETA, NU),
           (Fraction("6.04542391200064212730138120793999696716995844"),) * 2, 10),
    flight("short flights", (ETA, NU),
           (Fraction("3.379354048768637588086548941897511685422"),) * 2, 12),
]  # fmt: skip


@pytest.mark.parametrize("case", HARD, ids=lambda case: case.family)
def test_hard_inputs_stay_without_failure(case):
    assert not judge(case, KERNEL).outcome.failure


@pytest.mark.slow
@pytest.mark.parametrize(("exact", "count"), [(True, COUNT), (False, max(15, COUNT // 150))])
def test_no_random_case_excludes_the_truth(exact, count):
    some = [family for family in FAMILIES if (family.name in EXACT) is exact]
    run = command.stress(some, count, 20261121, KERNEL, lambda stage: None)
    assert not run.failures, text(run)
    assert len(run.judgements) >= count - 12
    assert (
        sum(each.outcome is Outcome.ENCLOSED for each in run.judgements) > len(run.judgements) / 3
    )

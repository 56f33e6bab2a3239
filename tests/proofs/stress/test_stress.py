import itertools
import json
import os
import sys
import time
from dataclasses import replace
from fractions import Fraction

import pytest
from mpmath import mp, mpf

from intervals import Interval, IntervalArray
from proofs.motion.impact import NoImpact
from proofs.stress import __main__ as command
from proofs.stress import families, functions, motions, report
from proofs.stress.__main__ import main
from proofs.stress.cases import inputs
from proofs.stress.families import FAMILIES, cases
from proofs.stress.functions import FunctionCase, true_range
from proofs.stress.grazing import graze, separation_point
from proofs.stress.judge import Outcome, judge
from proofs.stress.kernels import Mpmath, kernel
from proofs.stress.limit import TookTooLong, limited
from proofs.stress.motions import CoverCase, ImageCase, ReboundCase
from proofs.stress.operations import OperationCase
from proofs.stress.shrink import shrunk
from proofs.stress.truth import Launched, first_impact
from tests.proofs.trusted.paper import reference

pytestmark = pytest.mark.slow

COUNT = int(os.environ.get("STRESS_CASES", "10000"))
EXACT = ("operations", "functions", "arrays")
ETA, NU = Fraction("0.2121"), Fraction("-0.2")
KERNELS = [pytest.param("flint", id="flint"), pytest.param("mpmath", id="mpmath")]


@pytest.fixture(params=KERNELS)
def by(request):
    if request.param == "flint":
        pytest.importorskip("flint")
    return kernel(request.param)


def number(value):
    return mpf(value.numerator) / value.denominator


def close(bounds, value, slack):
    return number(bounds[0]) - slack <= value <= number(bounds[1]) + slack


def point(phi, **options):
    return ImageCase("tangent", ETA, NU, Fraction(phi), Fraction(phi), **options)


# -- the truth, against what was typed and published elsewhere -------------------------------------


@pytest.mark.parametrize(
    ("eta", "nu", "phi"),
    [("0.2121", "-0.2", "1.11"), ("0.2121", "-0.2", "6.2"), ("1.7", "2.5", "4.5"),
     ("0.9", "-0.3", "1")],
)  # fmt: skip
def test_the_truth_agrees_with_a_scan_of_equation_10(by, eta, nu, phi):
    eta, nu, phi = Fraction(eta), Fraction(nu), Fraction(phi)
    flight, phase = reference.first_impact(number(eta), number(nu), number(phi))
    found = first_impact(by, Launched(eta, nu, phi), Fraction(1000)).known
    assert close(found["flight"], flight, mpf(10) ** -40)
    assert mp.fabs(mp.sin((number(found["phase"][0]) - phase) / 2)) < mpf(10) ** -40
    slope = reference.slope(number(eta), number(nu), number(phi), flight)
    assert close(found["slope"], slope, mpf(10) ** -15)
    assert all(high - low <= abs(low) / Fraction(10) ** 90 for low, high in found.values())


def test_the_truth_after_sticking(by):
    leave = reference.separation_phase(mpf("0.2121"), mpf("-0.2"))
    flight, _ = reference.first_impact(mpf("0.2121"), mpf("-0.2"), leave)
    found = first_impact(by, Launched(ETA, NU, Fraction(5)), Fraction(1000)).known
    assert close(found["flight"], flight, mpf(10) ** -30)
    dwell = number(found["dwell"][0])
    assert mp.fabs(mp.sin((dwell - (leave - 5)) / 2)) < mpf(10) ** -45
    assert found["slope"] == (0, 0)


def test_the_truth_with_restitution_solves_14_and_15(by):
    of = Launched(ETA, NU, Fraction("1.11"), Fraction("0.1"), Fraction("-0.5"))
    found = first_impact(by, of, Fraction(1000)).known
    state = [number(x) for x in (of.eta, of.nu, of.epsilon, of.phi, of.gamma)]
    flight = number(found["flight"][0])
    assert mp.fabs(reference.left_side_14(*state, flight)) < mpf(10) ** -45
    assert close(found["velocity"], reference.right_side_15(*state, flight), mpf(10) ** -45)
    step = Fraction(1, 10**12)
    for name, moved in (("phi", replace(of, phi=of.phi + step)),
                        ("gamma", replace(of, gamma=of.gamma + step))):  # fmt: skip
        other = first_impact(by, moved, Fraction(1000)).known
        for quantity in ("phase", "velocity"):
            quotient = (other[quantity][0] - found[quantity][0]) / step
            assert abs(found[f"{quantity} by {name}"][0] - quotient) < Fraction(1, 10**7)


def test_the_truth_without_impact(by):
    never = first_impact(by, Launched(ETA, Fraction("0.02"), Fraction(1)), Fraction(1000))
    assert not never.known and never.reason == "the mass stays on the table"
    later = first_impact(by, Launched(ETA, NU, Fraction("1.11")), Fraction(10))
    assert not later.known and later.reason == "no impact up to the horizon"


def test_next_to_zero_flight_time_the_flight_is_three_times_the_distance(by):
    distance = Fraction(1, 10**30)
    phase = separation_point(by, ETA, NU, beginning=True) - distance
    found = first_impact(by, Launched(ETA, NU, phase), Fraction(1000)).known
    assert abs(found["flight"][0] / distance - 3) < Fraction(1, 10**25)
    assert abs(found["slope"][0] + 2) < Fraction(1, 10**25)


def test_a_soft_spring_has_the_limit_of_free_flight(by):
    """As eta -> 0 the gap tends to |nu| times sin(phi) + t cos(phi) - sin(phi + t)."""
    phi = mpf("2.5")
    limit = mp.findroot(lambda t: mp.sin(phi) + t * mp.cos(phi) - mp.sin(phi + t), 3.5)
    for sign in (-1, 1):
        of = Launched(Fraction(1, 10**20), Fraction(sign, 2), Fraction("2.5"))
        assert close(first_impact(by, of, Fraction(100)).known["flight"], limit, mpf(10) ** -35)


def test_a_graze_is_seen_from_both_sides(by):
    """Next to a grazing launch the flight is about as long as the graze, or much longer."""
    eta, nu, phase = graze(0)
    flights = [
        first_impact(by, Launched(eta, nu, phase + side * Fraction(1, 10**25)), Fraction(1000))
        for side in (-1, 1)
    ]
    low, high = sorted(flight.known["flight"][0] for flight in flights)
    assert high - low > Fraction(1, 2)


def test_the_hardest_binary64_argument(by):
    """6381956970095103 * 2^797 is 4.687165924254624e-19 from a multiple of pi/2 (Muller)."""
    (cosine, _) = true_range(by, "cos", *[Fraction(6381956970095103 << 797)] * 2, 53)
    assert abs(abs(float(cosine.known["value"][0])) - 4.687165924254624e-19) < 1e-33


@pytest.mark.parametrize(
    ("function", "ends", "expected"),
    [("sin", (0, 7), (-1, 1)), ("sin", (1, 2), (None, 1)), ("cos", (-1, 1), (None, 1)),
     ("cos", (3, 4), (-1, None)), ("cosh", (-1, 2), (1, None)), ("sin", (4, 5), (-1, None)),
     ("cos", ("-456142519478952627/10", "-136842755843685788/3"), (-1, None))],
)  # fmt: skip
def test_ranges_have_their_turning_points(by, function, ends, expected):
    found = true_range(by, function, *map(Fraction, ends), 53)
    for truth, value in zip(found, expected, strict=True):
        if value is not None:
            assert truth.known["value"] == (value, value)


def test_a_value_next_to_a_number_of_the_precision_is_told_from_it(by):
    """exp(x) > 1 for x = 2^-800, however little."""
    tiny = Fraction(1, 1 << 800)
    (least, most) = true_range(by, "exp", tiny, tiny, 53)
    assert 1 < least.known["value"][0] <= most.known["value"][1] < 1 + 2 * tiny


def test_a_pole_is_no_value(by):
    (found,) = true_range(by, "tan", Fraction(1), Fraction(2), 53)
    assert not found.known and found.reason == "a pole"


# -- the verdicts ----------------------------------------------------------------------------------

EVERY_KIND = [
    FunctionCase("functions", "sin", Fraction(3), Fraction(3), 64),
    FunctionCase("arrays", "exp", Fraction(1), Fraction(2), 53),
    OperationCase("operations", "/", *map(Fraction, (1, 2, 3, 7)), 53, False),
    OperationCase("operations", "*", *map(Fraction, (-1, 2, -3, 7)), 53, True),
    point("1.11"),
    ImageCase("intervals", ETA, NU, Fraction("1.27"), Fraction("1.32"), 12),
    ImageCase("intervals", ETA, NU, Fraction("1.17"), Fraction("1.2"), 12),
    ReboundCase("restitution", ETA, NU, *[Fraction("1.11")] * 2, Fraction("0.1"), Fraction("-0.5")),
    CoverCase("kernel", ETA, NU, Fraction("1.27"), Fraction("1.32"), 4),
]


@pytest.mark.parametrize("case", EVERY_KIND, ids=lambda case: case.family)
def test_a_sound_answer_is_enclosed(case):
    found = judge(case, kernel(), 10.0)
    possible = case.low == Fraction("1.17")
    assert found.outcome is (Outcome.POSSIBLE if possible else Outcome.ENCLOSED)
    assert possible or found.ratio < 2


def _shift(bounds, by=Fraction(1, 2**40)):
    return bounds[0] + by, bounds[1] + by


@pytest.mark.parametrize("quantity", ["flight", "phase", "slope"])
def test_a_shifted_image_excludes_the_truth(monkeypatch, quantity):
    sound = motions.image

    def broken(*args, **options):
        found = sound(*args, **options)
        return replace(found, **{quantity: _shift(getattr(found, quantity), Fraction(1, 10**25))})

    monkeypatch.setattr(motions, "image", broken)
    found = judge(point("1.11"), kernel(), 10.0)
    assert found.outcome is Outcome.EXCLUDED and quantity in found.reason
    assert found.inputs["low"] == "111/100"


@pytest.mark.parametrize("entry", range(7))
def test_a_shifted_rebound_excludes_the_truth(monkeypatch, entry):
    sound = motions.rebound

    def broken(*args, **options):
        found = sound(*args, **options)
        flat = [found.flight, found.phase, found.velocity, *sum(found.jacobian, ())]
        flat[entry] = _shift(flat[entry])
        return replace(found, flight=flat[0], phase=flat[1], velocity=flat[2],
                       jacobian=(tuple(flat[3:5]), tuple(flat[5:])))  # fmt: skip

    monkeypatch.setattr(motions, "rebound", broken)
    assert judge(EVERY_KIND[7], kernel(), 10.0).outcome is Outcome.EXCLUDED


@pytest.mark.parametrize("part", ["times", "slopes"])
def test_a_shifted_cover_excludes_the_truth(monkeypatch, part):
    sound = motions.slope_cover

    def broken(*args):
        found = sound(*args)
        return replace(found, **{part: getattr(found, part) + 1})

    monkeypatch.setattr(motions, "slope_cover", broken)
    assert judge(EVERY_KIND[8], kernel(), 10.0).outcome is Outcome.EXCLUDED


def test_a_lost_possible_image_excludes_the_truth(monkeypatch):
    sound = motions.image
    monkeypatch.setattr(
        motions, "image",
        lambda *args, **options: replace(found := sound(*args, **options), images=found.images[:1]),
    )  # fmt: skip
    assert judge(EVERY_KIND[6], kernel(), 10.0).outcome is Outcome.EXCLUDED


def test_an_image_where_there_is_none_excludes_the_truth(monkeypatch):
    sound = motions.image(motions.System(ETA, NU), (Fraction("1.11"),) * 2)
    monkeypatch.setattr(motions, "image", lambda *args, **options: sound)
    found = judge(point("1.11", horizon=Fraction(10)), kernel())
    assert found.outcome is Outcome.EXCLUDED and "there is no value" in found.reason


@pytest.mark.parametrize("case", EVERY_KIND[:2], ids=lambda case: case.family)
def test_a_rounding_in_the_wrong_direction_excludes_the_truth(monkeypatch, case):
    kind = Interval if case.family == "functions" else functions.IntervalArray
    sound = getattr(kind, case.function)
    monkeypatch.setattr(kind, case.function, lambda x: sound(x) * (1 + Fraction(1, 2**48)))
    assert judge(case, kernel()).outcome is Outcome.EXCLUDED


def test_a_pole_that_is_not_noticed_excludes_the_truth(monkeypatch):
    monkeypatch.setattr(Interval, "tan", lambda x: x)
    case = FunctionCase("functions", "tan", Fraction(1), Fraction(2), 53)
    assert judge(case, kernel()).outcome is Outcome.EXCLUDED


@pytest.mark.parametrize("name", ["__add__", "__sub__", "__mul__", "__truediv__"])
@pytest.mark.parametrize("kind", [Interval, IntervalArray])
def test_an_operation_rounded_inward_excludes_the_truth(monkeypatch, kind, name):
    """By a part in 2^40 of its width: each operation of each type."""
    sound = getattr(kind, name)

    def broken(x, y):
        found = sound(x, y)
        if kind is Interval:
            inward = found.wid / 2**40
            return Interval(found.inf + inward, found.sup - inward, precision=100)
        inward = (found.sup - found.inf) / 2**40
        return IntervalArray.from_floats(found.inf + inward, found.sup - inward)

    monkeypatch.setattr(kind, name, broken)
    symbol = {"__add__": "+", "__sub__": "-", "__mul__": "*", "__truediv__": "/"}[name]
    ends = map(Fraction, (1, 2, 3, 7))
    case = OperationCase("operations", symbol, *ends, 53, kind is IntervalArray)
    assert judge(case, kernel()).outcome is Outcome.EXCLUDED


def test_a_quotient_by_zero_that_is_not_noticed_excludes_the_truth(monkeypatch):
    case = OperationCase("operations", "/", *map(Fraction, (1, 2, -1, 1)), 53, False)
    assert judge(case, kernel()).outcome is Outcome.REFUSED
    monkeypatch.setattr(Interval, "__truediv__", lambda x, y: x)
    assert judge(case, kernel()).outcome is Outcome.EXCLUDED


def _raises(error):
    def broken(*args, **options):
        raise error

    return broken


def test_a_refusal_is_missed_only_where_there_is_an_impact(monkeypatch):
    assert judge(point("1.11", horizon=Fraction(10)), kernel()).outcome is Outcome.REFUSED
    monkeypatch.setattr(motions, "image", _raises(NoImpact("none")))
    assert judge(point("1.11", horizon=Fraction(10)), kernel()).outcome is Outcome.REFUSED
    assert judge(point("1.11"), kernel()).outcome is Outcome.MISSED


def test_what_takes_too_long_is_stopped_and_the_alarm_is_off(monkeypatch):
    def slow(*args, **options):
        for _ in itertools.count():
            pass

    monkeypatch.setattr(motions, "image", slow)
    assert judge(point("1.11"), kernel(), 0.05).outcome is Outcome.STOPPED
    with pytest.raises(TookTooLong), limited(0.05):
        slow()
    with limited(0.05):
        pass
    began = time.process_time()
    while time.process_time() < began + 0.1:
        pass


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_an_alarm_that_is_lost_in_a_finaliser_comes_again():
    class Slow:
        def __del__(self):
            began = time.process_time()
            while time.process_time() < began + 0.2:
                pass

    with pytest.raises(TookTooLong), limited(0.05):
        Slow()
        for _ in itertools.count():
            pass


# -- the cases and the command ---------------------------------------------------------------------


def test_a_seed_draws_the_same_cases():
    some = [family for family in FAMILIES if family.name not in ("grazing", "tangent", "kernel")]
    first, again, other = (
        [inputs(case) for case in cases(some, 60, seed, kernel())] for seed in (1, 1, 2)
    )
    assert first == again != other
    assert {case["family"] for case in first} == {family.name for family in some}


def test_mpmath_draws_and_judges_without_flint(monkeypatch):
    monkeypatch.setitem(sys.modules, "flint", None)
    assert isinstance(kernel(), Mpmath)
    some = [family for family in FAMILIES if family.name in ("functions", "soft spring")]
    for case in cases(some, 12, 3, kernel()):
        assert judge(case, kernel(), 10.0).outcome in (Outcome.ENCLOSED, Outcome.REFUSED)
    assert main(["--kernel", "flint"]) == 2


def test_a_failure_is_made_smaller():
    case = ImageCase("tangent", ETA + Fraction(1, 10**40), NU, *[Fraction("1.23456789")] * 2)
    small = shrunk(case, lambda other: other.low > 1 and other.eta < 1)
    assert (small.low, small.high) in ((2, 2), (Fraction(6, 5), Fraction(6, 5)))
    assert len(str(small.eta)) <= 4 and small.family == "tangent"


def test_the_command_reports_a_failure_and_exits_1(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(Interval, "exp", lambda x: x)
    monkeypatch.setattr(functions, "NAMES", ("exp",))
    arguments = ["--family", "functions", "--cases", "4", "--out", str(tmp_path)]
    assert main(arguments) == 1
    text = capsys.readouterr().out
    assert "4 EXCLUDE THE TRUTH" in text and "function = exp" in text
    data = json.loads((tmp_path / "stress.json").read_text())
    assert data["failures"] == 4 and data["cases"][0]["outcome"] == "EXCLUDES THE TRUTH"
    assert "## Failures" in (tmp_path / "stress.md").read_text()
    assert (tmp_path / "stress.svg").read_text().startswith("<?xml")


def test_a_crash_exits_1_and_says_which(monkeypatch, capsys):
    monkeypatch.setattr(Interval, "exp", _raises(KeyError("lost")))
    monkeypatch.setattr(functions, "NAMES", ("exp",))
    assert main(["--family", "functions", "--cases", "2"]) == 1
    assert "CRASHED: functions: KeyError: 'lost'; input function = exp" in capsys.readouterr().out


def test_without_matplotlib_the_rest_is_written(monkeypatch, capsys, tmp_path):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["--family", "functions", "--cases", "2", "--out", str(tmp_path)]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["stress.json", "stress.md"]
    assert "matplotlib is not installed" in capsys.readouterr().err


def test_json_goes_to_the_screen_alone(capsys):
    assert main(["--family", "arrays", "--cases", "3", "--json", "-"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["schema"] == report.SCHEMA and len(data["cases"]) == 3
    again = data["cases"][0]
    case = FunctionCase("arrays", again["function"], Fraction(again["low"]),
                        Fraction(again["high"]), int(again["precision"]))  # fmt: skip
    assert judge(case, kernel()).outcome.value == again["outcome"]


@pytest.mark.parametrize(
    "arguments",
    [["--nonsense"], ["--cases", "0"], ["--cases", "many"], ["--seed", "-1"], ["--json", "x"],
     ["--family", "circles"], ["--kernel", "numpy"]],
)  # fmt: skip
def test_bad_usage_exits_2(arguments, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(arguments)
    assert stopped.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_what_cannot_be_written_is_refused_before_the_work(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(command, "stress", None)
    (tmp_path / "file").write_text("")
    with pytest.raises(SystemExit) as stopped:
        main(["--out", str(tmp_path / "file" / "absent")])
    assert stopped.value.code == 2
    assert "cannot write to" in capsys.readouterr().err


def test_a_missing_directory_is_made(tmp_path):
    folder = tmp_path / "new" / "one"
    assert main(["--family", "operations", "--cases", "5", "--out", str(folder)]) == 0
    assert "no case excludes the truth" in (folder / "stress.md").read_text()


def test_help_has_examples_and_every_family(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--help"])
    assert stopped.value.code == 0
    text = capsys.readouterr().out
    assert "examples:" in text and "exit status:" in text
    assert all(family.about in text for family in families.FAMILIES)


HARD = [  # shrunk from random cases on which the library is weakest
    ImageCase("resonance", 1 + Fraction(1, 10**20), Fraction("-0.4"), *[Fraction(2)] * 2,
              20, Fraction(50)),
    ImageCase("rational", Fraction(1, 3), NU, *[Fraction("1.5707")] * 2, 20, Fraction(100)),
    ImageCase("intervals", ETA, NU, Fraction(0), Fraction("6.2831"), 12, Fraction(100)),
    ReboundCase("chatter", ETA, NU, *[Fraction("3.5")] * 2, Fraction("0.16"),
                Fraction("-0.88303318574285"), 20),
    ReboundCase("restitution", ETA, NU, Fraction("1.4181"), Fraction("1.4181000000001"),
                Fraction(1), Fraction("-7.7")),
    ImageCase("separation", ETA, NU,
              *[Fraction("6.04542391200064212730138120793999696716995844")] * 2, 10),
    ImageCase("short flights", ETA, NU, Fraction("3.379354048768637588086548941897511685422"),
              Fraction("3.379354048768687588086548941897511685422"), 12),
    CoverCase("kernel", Fraction("0.9"), Fraction("-0.3"), Fraction(30, 13), Fraction("2.31"), 16),
]  # fmt: skip


@pytest.mark.parametrize("case", HARD, ids=lambda case: case.family)
def test_hard_inputs_stay_without_failure(case):
    assert not judge(case, kernel()).outcome.failure


# -- the random cases ------------------------------------------------------------------------------


@pytest.mark.slow
def test_no_random_argument_excludes_the_truth():
    some = [family for family in FAMILIES if family.name in EXACT]
    run = command.stress(some, COUNT, 20261121, kernel(), lambda stage: None)
    assert not run.failures, report.text(run)
    assert len(run.judgements) >= COUNT - 2


@pytest.mark.slow
def test_no_random_motion_excludes_the_truth():
    some = [family for family in FAMILIES if family.name not in EXACT]
    run = command.stress(some, max(15, COUNT // 150), 20261121, kernel(), lambda stage: None)
    assert not run.failures, report.text(run)
    assert sum(one.outcome is Outcome.ENCLOSED for one in run.judgements) > len(run.judgements) / 3

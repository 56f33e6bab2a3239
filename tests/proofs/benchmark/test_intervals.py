"""The benchmark of the arithmetic: that all libraries do the same work, and that rows say so."""

import json
import subprocess
import sys
from fractions import Fraction
from functools import partial

import numpy as np
import pytest

from proofs.benchmark import arrays, first_calls, libraries, memory, peers, scalars
from proofs.benchmark.__main__ import main
from proofs.benchmark.comparison import Comparison
from proofs.benchmark.libraries import RANGES, Job, endpoints
from proofs.benchmark.measuring import EFFORTS, table
from proofs.benchmark.operations import ARRAY, OPERATIONS, SCALAR
from proofs.benchmark.peers import CODAC, FLINT, IV

flint = pytest.importorskip("flint")

NAMES = ["+", "-", "*", "/", "sqr", "sqrt", "cbrt", "exp", "log", "sin", "cos", "sincos", "tan"]
NAMES += ["atan", "asin", "acos", "sinh", "cosh", "tanh", "pow", "atan2", "hypot", "sum", "@"]
COUNT = 9


def of(name):
    (operation,) = (one for one in OPERATIONS if one.name == name)
    return operation


def results(library, operation, name, wide):
    """Return the list of results of a library: pairs (lower, upper) of exact numbers."""
    statement, names = library.prepare(operation.job(name, wide, COUNT))
    return flat(eval(statement, names))


def flat(found):
    if isinstance(found, flint.arb):
        return [(exact(found.lower()), exact(found.upper()))]
    if hasattr(found, "_mpi_"):  # mpmath.iv
        return [tuple(-of_raw(x) if x[0] else of_raw(x) for x in found._mpi_)]
    if hasattr(found, "inf"):  # ours
        ends = np.ravel(found.inf).tolist(), np.ravel(found.sup).tolist()
        return [tuple(map(Fraction, pair)) for pair in zip(*ends, strict=True)]
    return [pair for one in getattr(found, "tolist", found.__iter__)() for pair in flat(one)]


def of_raw(raw):
    return int(raw[1]) * Fraction(2) ** int(raw[2])


def exact(x):
    man, exp = map(int, x.man_exp())
    return Fraction(man) * Fraction(2) ** exp


def test_the_operations_are_those_of_the_table():
    assert [one.name for one in OPERATIONS] == NAMES


@pytest.mark.parametrize("wide", [True, False])
@pytest.mark.parametrize("name", NAMES)
def test_all_libraries_do_the_same_work(name, wide):
    operation = of(name)
    with peers.at_precision(53) as beside:
        libraries = {ARRAY: arrays.library(), SCALAR: scalars.library(53), **beside}
        found = {
            library: ordered(name, library, results(one, operation, library, wide))
            for library, one in libraries.items()
            if library in operation.texts
        }
    assert ARRAY in found and FLINT in found and (SCALAR in found or operation.whole)
    for library, pairs in found.items():
        assert len(pairs) == len(found[FLINT]), library
        for (low, high), (least, most) in zip(pairs, found[FLINT], strict=True):
            assert low <= most and least <= high, library
            assert abs(low - least) <= max(high - low, most - least), library
            assert wide or high - low <= (1 + abs(low)) * Fraction(1, 10**9), library


def ordered(name, library, pairs):
    """Return the pairs in the order of python-flint, whose sin_cos gives (sin, cos) of each."""
    if name == "sincos" and library == ARRAY:
        return [pair for i in range(COUNT) for pair in (pairs[i], pairs[COUNT + i])]
    if name == "sincos" and library == IV:  # cos_sin
        return [pairs[i + 1 - 2 * (i % 2)] for i in range(len(pairs))]
    return pairs


@pytest.mark.parametrize("bits", [53, 333])
@pytest.mark.parametrize("inside", RANGES)
def test_operands_are_in_their_range(inside, bits):
    low, high = RANGES[inside]
    for wide in (True, False):
        ends = endpoints("x", inside, wide, bits, 50)
        assert ends != endpoints("y", inside, wide, bits, 50)
        for m, n in ends:
            lower, upper = Fraction(m, 2 ** (bits - 4)), Fraction(n, 2 ** (bits - 4))
            assert low <= lower <= upper <= high
            assert max(abs(m), abs(n)) < 2**bits
            assert (0 < upper - lower < Fraction(1, 64)) if wide else lower == upper
        assert max(m.bit_length() for m, _ in ends) >= bits - 5  # not a few short numbers


@pytest.mark.parametrize("wide", [True, False])
def test_all_libraries_have_the_same_operands(wide):
    job = Job("x", "signed", None, whole=False, matrices=False, wide=wide, count=COUNT)
    ends = endpoints("x", "signed", wide, 53, COUNT)
    with peers.at_precision(53) as beside:
        for library in (arrays.library(), scalars.library(53), *beside.values()):
            found = flat(library.prepare(job)[1]["xs"])
            for pair, given in zip(found, ends, strict=True):
                for x, m in zip(pair, given, strict=True):
                    assert abs(x - Fraction(m, 2**49)) < (1e-9 if wide else 2e-15)


@pytest.mark.parametrize("matrices, steps", [(False, 100), (True, 1000)])
def test_times_are_those_of_one_element(monkeypatch, matrices, steps):
    class TwoSeconds:
        def __init__(self, statement, globals):
            self.timeit = lambda number: calls.append(number) or 2.0 * number

    calls = []
    monkeypatch.setattr(libraries, "Timer", TwoSeconds)
    job = Job("", "signed", "signed", whole=matrices, matrices=matrices, wide=True, count=100)
    assert arrays.library().sampler(job, enough=5.0)() == 2.0 / steps
    assert calls == [1, 1, 3]  # the first may have filled a cache; then 3 * 2.0 >= 5.0


def test_long_operands_repeat_the_pool_in_objects_of_their_own():
    job = Job("x + y", "signed", "signed", whole=False, matrices=False, wide=True, count=20_003)
    with peers.at_precision(53) as beside:
        _, names = beside[FLINT].prepare(job)
    xs = names["xs"]
    assert len(xs) == 20_003 == len({id(x) for x in xs})
    assert exact(xs[1].lower()) == exact(xs[10_001].lower())
    _, names = arrays.library().prepare(job)
    assert names["xs"].shape == (20_003,)
    assert names["xs"].inf[1] == names["xs"].inf[10_001]
    assert abs(names["xs"].inf[1] - float(exact(xs[1].lower()))) < 1e-9


@pytest.mark.parametrize("least, reached", [(3.0, True), (3.1, False)])
def test_a_target_is_about_the_median_of_the_ratios(least, reached):
    seconds = {"ours": [0.25, 0.5, 0.25], "first": [0.5, 1.5, 1.25], "other": [1.0, 1e3, 2e3]}
    row = Comparison(seconds).row("sin", "ours", ("first", "other", "absent"), ">= 3", least)
    assert row.reached is reached
    assert row.samples["ratios"] == {"first": [2.0, 3.0, 5.0], "other": [4.0, 2e3, 8e3]}
    assert row.measured.split() == ["250,000,000", "3", "(2", "..", "5)", "2,000", "-"]


def test_without_a_target_or_a_peer_nothing_is_reached():
    seconds = {"ours": [1.0], "other": [2.0]}
    assert Comparison(seconds).row("sin", "ours", ("other",), "", 0).reached is None
    assert Comparison(seconds).row("sin", "ours", ("absent", "other"), ">= 1", 1).reached is None


def test_temporary_memory_is_below_its_target():
    rows = memory.measure()
    assert len(rows) == 6
    assert all(0 <= row.samples["bytes an element"] <= 64 for row in rows)
    assert all(row.target == "<= 64" and row.reached for row in rows), table(rows)


def test_memory_that_is_given_back_counts():
    assert memory.peak_bytes(lambda: np.zeros(10**5).sum()) >= 8 * 10**5


@pytest.mark.slow
def test_first_calls_are_made_in_a_process_that_has_made_none(monkeypatch):
    made, run = [], subprocess.run

    def watched(command, **options):
        made.append(command)
        return run(command, **options)

    monkeypatch.setattr(first_calls.subprocess, "run", watched)
    sampler = partial(first_calls._in_new_process, "log", SCALAR)
    assert sampler() > 0 and sampler() > 0
    assert [command[0] for command in made] == [sys.executable] * 2
    assert all(command[-2:] == ["log", SCALAR] for command in made)
    assert first_calls.seconds("log", SCALAR) > 0 and len(made) == 2


# -- codac -----------------------------------------------------------------------------------------

FAKE = """
class Interval:
    def __init__(self, lower, upper=None):
        self.ends = lower.ends if upper is None else (lower, upper)
    def __add__(self, other):
        print("what a library prints is no reply")
        return Interval(*(x + y for x, y in zip(self.ends, other.ends)))
"""


@pytest.fixture
def fake_codac(tmp_path, monkeypatch):
    (tmp_path / "codac.py").write_text(FAKE)
    (tmp_path / "codac-9.8.7.dist-info").mkdir()
    (tmp_path / "codac-9.8.7.dist-info" / "METADATA").write_text("Name: codac\nVersion: 9.8.7\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))


def test_codac_is_measured_in_a_process_of_its_own(fake_codac):
    with peers.codac(sys.executable) as codac:
        assert codac.version == "9.8.7"
        sampler = codac.sampler(of("+").job(CODAC, wide=True, count=3), 0.0)
        assert sampler() > 0 and sampler() > 0
        with pytest.raises(RuntimeError, match="failed"):
            codac.sampler(of("*").job(CODAC, wide=True, count=3), 0.0)


def test_absent_peers_are_reported(tmp_path, monkeypatch):
    (tmp_path / "codac.py").write_text("raise ImportError\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setattr(peers, "has_flint", lambda: False)
    some = [(of("sin"), True, 10_000), (of("+"), True, 10_000), (of("asin"), True, 1)]
    monkeypatch.setattr(arrays, "cases", lambda effort: some)
    text = table(arrays.measure(EFFORTS["smallest"], sys.executable, lambda stage: None))
    assert "codac is absent" in text and "python-flint is absent" in text
    assert text.count("not measured") == 2


# -- all -------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_smallest_run_measures_each_operation(tmp_path, capsys):
    target = tmp_path / "samples.json"
    assert main(["intervals", "--smallest", "--json", str(target)]) in (0, 1)  # never asserted
    assert capsys.readouterr().out.startswith("what ")
    data = json.loads(target.read_text())
    assert data["subject"] == "intervals" and data["mpmath"] and data["python-flint"]
    rows = {row["name"]: row for row in data["rows"]}
    for name in NAMES[:-1]:
        for length in ("1", "100", "10,000"):
            assert rows[f"{name}, {length}"]["samples"]["ratios"][FLINT]
    for name in ("+", "*", "/", "sqr", "sqrt", "sum"):
        assert rows[f"{name}, 1,000,000"]["samples"]["ratios"][FLINT]
    assert "@, 100 x 100" in rows and "sin, 10,000 points" in rows
    for bits in (53, 113, 333, 3333):
        for name in NAMES[:-2]:
            for points in ("", " points"):
                assert rows[f"{name}, {bits} bits{points}"]["samples"]["ratios"][FLINT]
    for name in ("exp", "log", "sin"):
        assert rows[f"{name}, 333 bits, first 100"]["samples"]["ratios"][IV]
    targets = {name: row["target"] for name, row in rows.items() if row["target"]}
    assert targets["+, 10,000"] == ">= 25" and targets["*, 10,000"] == ">= 12"
    assert targets["sin, 10,000"] == ">= 1.5, aim 3"
    assert targets["sincos, 10,000"] == ">= 2, aim 4"
    for name in ("/", "sqrt", "exp", "log", "atan"):
        assert targets[f"{name}, 10,000"] == ">= 1"
    at_333 = [name for name in targets if name.endswith(("333 bits", "333 bits points"))]
    assert len(at_333) == 2 * 16 and not any("3333" in name for name in at_333)

"""Files made to eat the checker's time or memory: each is refused in seconds, in a line."""

import copy
import json
import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from proofs.check import main
from proofs.trusted.certificate import MAX_BYTES, Malformed, Reader
from proofs.trusted.certificate import render as text_of
from proofs.trusted.kernel.arithmetic import rational
from proofs.trusted.kernel.meter import DEFAULT, Exhausted, metered
from proofs.trusted.verify import check
from tests.proofs.trusted import corpus

ROOT = Path(__file__).parents[3]
ALONE = """
import sys
import time
from proofs.check import main
status = main(sys.argv[1:])
peak = [line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM")]
print("peak", *peak, "time", time.process_time())
sys.exit(status)
"""
LONG = 10**2900


def horseshoe():
    return json.loads(corpus.path_of("accepted/horseshoe").read_text(encoding="utf-8"))


def first(document, rule):
    return next(name for name, step in document["steps"].items() if step["rule"] == rule)


def with_times(times):
    document = horseshoe()
    step = document["steps"][first(document, "first-impact")]
    step["witness"]["times"] = [str(t) for t in times]
    return text_of(document)


def with_copies(rule, count, change=lambda witness, i: None):
    document = horseshoe()
    step = document["steps"][first(document, rule)]
    for i in range(count):
        document["steps"][f"copy{i}"] = copy.deepcopy(step)
        change(document["steps"][f"copy{i}"]["witness"], i)
    return text_of(document)


def thin_roots(witness, i):
    root = Fraction(44, 100)
    witness["root"] = [str(root), str(root + Fraction(1, 10**1100 + i))]


def with_points(count):
    document = horseshoe()
    witness = document["steps"][first(document, "slope-range")]["witness"]
    point = witness["points"][0]
    step = Fraction(1, 10**9)
    witness["points"] = [
        {**point, "phase": str(Fraction(point["phase"]) + i * step)} for i in range(count)
    ]
    witness["pieces"] = witness["pieces"][:1] * (count - 1)
    return text_of(document)


HOSTILE = {
    "ten thousand times": lambda: with_times([Fraction(k, 10007) for k in range(1, 10001)]),
    "times of 2900 digits": lambda: with_times([Fraction(k, LONG) for k in range(1, 600)]),
    "three thousand steps": lambda: with_copies("first-impact", 3000),
    "thin brackets": lambda: with_copies("moran-root", 500, thin_roots),
    "nine thousand points": lambda: with_points(9000),
    "deep lists": lambda: "[" * 1_000_000,
    "deep objects": lambda: '{"a":' * 500_000,
    "a wide list": lambda: "[" + ",".join(['"a"'] * 900_000) + "]",
    "a wide object": lambda: "{" + ",".join(f'"k{i}":""' for i in range(300_000)) + "}",
    "too long": lambda: " " * (MAX_BYTES + 1),
}


@pytest.mark.slow
@pytest.mark.parametrize("part", [5, pytest.param(1, marks=pytest.mark.long)])
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_end_soon(name, part, tmp_path):
    """Within a part of the work that a check is given, and of the time."""
    path = tmp_path / "hostile.json"
    path.write_text(HOSTILE[name](), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-S", "-O", "-c", ALONE, str(path), "--work", str(DEFAULT // part)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode in (1, 2)
    assert done.stderr.count("\n") == 1 and ("$" in done.stderr or "--work" in done.stderr)
    if sys.platform == "linux":
        _, kilobytes, _, seconds = done.stdout.split()[-4:]
        assert int(kilobytes) < 200 * 1024 and float(seconds) < 2 + 15 / part


def test_work_is_counted_in_the_arithmetic_and_in_the_reader():
    with metered(1000) as meter:
        x = rational(Fraction(1, 3), 64)
        before = meter.left
        assert (x * x / x).bits == 64 and meter.left < before
        small, before = before - meter.left, meter.left
        y = rational(Fraction(1, 3), 6400)
        assert (y * y / y).bits == 6400 and before - meter.left > 10 * small
        before = meter.left
        list(Reader({"a": ["1", "2"]}).mentioned())
        assert meter.left <= before - 4
        with pytest.raises(Exhausted, match="--work 2000"):
            for _ in range(1000):
                x.sincos()


def test_the_main_job_is_far_from_the_limit():
    text = corpus.path_of("accepted/horseshoe").read_text(encoding="utf-8")
    assert check(text, DEFAULT // 50).claims
    with pytest.raises(Exhausted):
        check(text, 1000)


def test_a_file_that_needs_more_work_is_status_1_and_says_how_much(capsys):
    path = str(corpus.path_of("accepted/horseshoe"))
    assert main(["--work", "5000", path]) == 1
    assert "it needs more work, --work 10000" in capsys.readouterr().err
    assert main(["--work", str(DEFAULT), path]) == 0
    with pytest.raises(SystemExit) as leave:
        main(["--work", "-1", path])
    assert leave.value.code == 2


@pytest.mark.skipif(not hasattr(os, "posix_spawn"), reason="needs processes")
@pytest.mark.parametrize(
    ("text", "path"),
    [
        ('{"a": 1}', "$.a"),
        ('{"steps": {"s": {"x": ["1", {"y": 1.5}]}}}', "$.steps.s.x[1].y"),
        ('{"claims": [{"id": "H1", "id": "H2"}]}', "$.claims[0]"),
        ('{"a": NaN}', "$.a"),
        ('{"a\\u001b": 1}', "$.'a\\x1b'"),
    ],
)
def test_faults_have_their_path(text, path):
    from proofs.trusted.certificate import parse

    with pytest.raises(Malformed) as caught:
        parse(text)
    assert str(caught.value).startswith(f"{path}: ")

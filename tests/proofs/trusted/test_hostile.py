"""Files made to eat the checker's time or memory: each is refused in seconds, in a line."""

import json
import os
import subprocess
import sys
import time
from fractions import Fraction

import pytest

from proofs.check import main
from proofs.trusted.certificate import LEDGER, MANIFEST, Malformed, Reader
from proofs.trusted.kernel.arithmetic import rational
from proofs.trusted.kernel.meter import DEFAULT, METER, Exhausted, metered
from proofs.trusted.manifest import check_ledger, check_manifest
from proofs.trusted.verify import Rejected, check
from tests.proofs.shell.processes import started, wait_until_it_listens
from tests.proofs.trusted import corpus
from tests.proofs.trusted.hostile import ROOT, SHAPES, checked, is_fair, made
from tests.proofs.trusted.kernel.hostile import source_of


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(16))
def test_a_hostile_file_costs_little(seed, tmp_path):
    taken = checked(*made(seed, tmp_path), options=["--work", str(DEFAULT // 20)])
    assert is_fair(taken) and taken.megabytes < 200 and taken.seconds < 3, taken


@pytest.mark.long
@pytest.mark.parametrize("seed", range(300))
def test_hundreds_of_hostile_files(seed, tmp_path):
    taken = checked(*made(seed, tmp_path))
    assert is_fair(taken) and taken.megabytes < 200 and taken.seconds < 25, taken


@pytest.mark.slow
@pytest.mark.parametrize("part", [4, pytest.param(1, marks=pytest.mark.long)])
@pytest.mark.parametrize("name", ["many_sums", "many_terms", "many_functions"])
def test_what_is_kept_takes_little_room(name, part, tmp_path):
    path = tmp_path / "hostile.json"
    path.write_text(source_of(name))
    taken = checked(name, path, options=["--work", str(DEFAULT // part)])
    assert taken.status == 1 and is_fair(taken), taken
    assert taken.megabytes < 30 + 170 / part, taken


SIZED = "numbers", "small objects", "empty lists", "a wide object", "a field twice, often"


@pytest.mark.slow
@pytest.mark.parametrize("name", SIZED)
def test_what_is_read_takes_little_room(name, tmp_path):
    path = tmp_path / "hostile.json"
    path.write_text(SHAPES[name]())
    taken = checked(name, path)
    assert taken.status == 2 and is_fair(taken) and taken.megabytes < 200 and taken.seconds < 5


@pytest.mark.slow
@pytest.mark.parametrize("name", ["wide_tree_of_powers", "long_coefficients"])
def test_a_check_is_ended_within_a_second(name, tmp_path):
    path = tmp_path / "hostile.json"
    path.write_text(source_of(name))
    with started("check", [str(path), "--work", str(10**9)]) as process:
        wait_until_it_listens(process)
        time.sleep(0.1)
        began = time.monotonic()
        process.terminate()
        _, said = process.communicate(timeout=20)
    assert time.monotonic() - began < 1
    assert (process.returncode, said) == (143, b"python -m proofs: terminated\n")


BLIND = """
import resource, sys
from proofs import check
from proofs.shell import backstop

def unseen(text, work):
    held = []
    while True:
        held += [bytes(10**6)] if sys.argv[1] == "memory" else []

backstop.DEFAULT, backstop.SECONDS, backstop.BYTES = 1, 1, 10**8
check.check = unseen
before = [resource.getrlimit(kind) for kind in (resource.RLIMIT_CPU, resource.RLIMIT_AS)]
status = check.check_file(check.Path(sys.argv[2]), 1)
assert before == [resource.getrlimit(kind) for kind in (resource.RLIMIT_CPU, resource.RLIMIT_AS)]
sys.exit(status)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="needs limits of memory")
@pytest.mark.parametrize("what", ["time", "memory"])
def test_the_system_ends_what_the_meter_does_not_see(what):
    path = str(corpus.path_of("accepted/horseshoe"))
    command = [sys.executable, "-S", "-c", BLIND, what, path]
    done = subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 1 and done.stdout == ""
    assert done.stderr == f"{path}: not decided: it needs more time or memory: --work 2\n"


@pytest.mark.parametrize("kind", ["a pipe", "a device", "a folder", "a link to itself"])
def test_regular_files_alone_are_opened(kind, tmp_path, capsys):
    path = tmp_path / "horseshoe.json"
    {
        "a pipe": lambda: os.mkfifo(path),
        "a device": lambda: path.symlink_to("/dev/zero"),
        "a folder": path.mkdir,
        "a link to itself": lambda: path.symlink_to(path),
    }[kind]()
    entry = {"digest": "", "parameters": "", "made": "", "checked": "", "claims": ""}
    for name, held in (
        ("MANIFEST.json", {"schema": MANIFEST, "files": {path.name: entry}}),
        ("ledger.json", {"schema": LEDGER, "claims": [{"id": "H1", "file": path.name}]}),
    ):
        (tmp_path / name).write_text(json.dumps(held))
        assert main([str(tmp_path / name)]) == 1
        said = capsys.readouterr().err
        assert "cannot be read: " in said and said.count("\n") == 1
    assert main([str(path)]) == 2
    assert "cannot be read: " in capsys.readouterr().err


def test_names_are_compared_before_anything_is_opened(tmp_path, monkeypatch):
    monkeypatch.setattr("proofs.trusted.manifest.read", None)
    entry = {"digest": "", "parameters": "", "made": "", "checked": "", "claims": ""}
    for name in ("other.json", "horseshoe", "../horseshoe.json", "/dev/zero", "x\0.json", ""):
        for held, examine in (
            ({"schema": MANIFEST, "files": {name: entry}}, check_manifest),
            ({"schema": LEDGER, "claims": [{"id": "H1", "file": name}]}, check_ledger),
        ):
            with pytest.raises(Rejected, match="no command makes a file of this name"):
                examine(json.dumps(held), tmp_path, DEFAULT)


def test_a_part_is_taken_from_the_whole_and_a_whole_has_an_end():
    with metered(1000) as whole:
        for _ in range(3):
            with metered(300) as part:
                part.spend(300)
        with pytest.raises(Exhausted, match="more work, --work 600"), metered(300) as part:
            part.spend(101)
        assert whole.spent == 1001
    with pytest.raises(Exhausted), metered(10) as outer, metered(20):
        outer.spend(0)
        METER.get().spend(11)


def test_work_is_counted_in_the_arithmetic_and_in_the_reader():
    with metered(1000) as meter:
        x = rational(Fraction(1, 3), 64)
        before = meter.spent
        assert (x * x / x).bits == 64 and meter.spent > before
        small, before = meter.spent - before, meter.spent
        y = rational(Fraction(1, 3), 6400)
        assert (y * y / y).bits == 6400 and meter.spent - before > 10 * small
        before = meter.spent
        list(Reader({"a": ["1", "2"]}).mentioned())
        assert meter.spent >= before + 4
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

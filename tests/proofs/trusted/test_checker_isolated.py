"""The checker alone: `python -S -O -m proofs.check`, without any other package, on any file."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from proofs.trusted.certificate import MAX_BYTES
from proofs.trusted.files import render
from tests.proofs.trusted import corpus
from tests.proofs.trusted.renewing import renewed

ROOT = Path(__file__).parents[3]
REFUSED = ("numpy", "mpmath", "sympy", "flint", "gmpy2", "scipy", "matplotlib", "intervals")
REFUSED += (
    "sqlite3",
    "proofs.plane",
    "proofs.methods",
    "proofs.search.s31_horseshoe",
    "proofs.search.steps",
    "proofs.motion",
)

ALONE = f"""
import runpy, sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if any(name == one or name.startswith(one + ".") for one in {REFUSED!r}):
            raise ImportError("the checker must not import " + name)

sys.meta_path.insert(0, Refuse())
sys.path.insert(0, "")
sys.argv[0] = "proofs.check"
runpy.run_module("proofs.check", run_name="__main__", alter_sys=True)
"""


def run(*arguments, code=None):
    start = ("-c", code) if code else ("-m", "proofs.check")
    return subprocess.run(
        [sys.executable, "-S", "-O", *start, *map(str, arguments)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        encoding="utf-8",
        errors="replace",
        timeout=60,
        check=False,
        env={key: value for key, value in os.environ.items() if key != "PYTHONPATH"},
    )


def complains(result, status=2):
    """Whether there is one line on standard error, no traceback, nothing on standard output."""
    lines = result.stderr.splitlines()
    return (
        result.returncode == status
        and len(lines) == 1
        and "Traceback" not in result.stderr
        and result.stdout == ""
    )


@pytest.mark.slow
def test_an_atlas_needs_no_database():
    result = run(ROOT / "reports" / "atlas" / "across-resonance.jsonl", code=ALONE)
    assert result.stderr == "" and result.returncode == 1  # some cells are undecided
    assert "an atlas of 120 REFUTED, 75 UNDECIDED, 49 VERIFIED, 1 left out cells" in result.stdout


@pytest.mark.parametrize("code", [None, ALONE], ids=["plain", "others refused"])
def test_accepts_with_the_standard_library_alone(code):
    brief, whole = (
        run(corpus.path_of("accepted/horseshoe"), *more, code=code) for more in ((), ["--verbose"])
    )
    assert brief.stderr == whole.stderr == ""
    assert brief.returncode == whole.returncode == 0
    lines = brief.stdout.splitlines()[1:]
    assert max(map(len, lines)) <= 100
    assert {line.split()[0]: line.split()[1] for line in lines} == corpus.VERDICTS
    lines = [line.split() for line in whole.stdout.splitlines()[1:]]
    assert {line[0]: line[1] for line in lines if line[0] != "corrected,"} == corpus.VERDICTS
    assert sum(line[0] == "corrected," for line in lines) == 3  # beside H2, H5 and H11


def test_the_refusal_works():
    result = run(code=ALONE.replace("runpy.run_module(", "import mpmath\nrunpy.run_module("))
    assert "the checker must not import mpmath" in result.stderr


@pytest.mark.slow
def test_rejects_under_optimisation():
    """No step of the proof is an `assert`, that -O would remove."""
    names = [name for name in corpus.CORPUS if name.startswith("rejected/")]
    result = run(*(corpus.path_of(name) for name in names), code=ALONE)
    assert result.returncode == 1
    assert result.stdout == ""
    lines = result.stderr.splitlines()
    assert len(lines) == len(names) and all("REJECTED" in line for line in lines)


@pytest.mark.slow
def test_the_worst_status_is_the_exit_status():
    accepted, rejected, malformed = (
        corpus.path_of(name)
        for name in ("accepted/h16_alone", "rejected/root_off", "malformed/not_json")
    )
    assert run(accepted, accepted).returncode == 0
    assert run(accepted, rejected, accepted).returncode == 1
    assert run(malformed, rejected, accepted).returncode == 2
    assert run().returncode == 2


def test_an_undecided_claim_is_status_1(tmp_path):
    file = tmp_path / "undecided.json"
    document = corpus.accepted()
    corpus.only("H4")(document)
    document["claims"][0]["proof"], document["steps"] = [], {}
    file.write_text(render(renewed(document)))
    result = run(file)
    assert result.returncode == 1
    assert "H4   UNDECIDED" in result.stdout


FILES = {
    "empty": b"",
    "binary": bytes(range(256)) * 50,
    "latin-1": '{"schema": "é"}'.encode("latin-1"),
    "utf-16": '{"schema": "x"}'.encode("utf-16"),
    "byte order mark": b"\xef\xbb\xbf{}",
    "null bytes": b"\x00" * 1000,
    "surrogate": b'{"schema": "\\ud800"}',
    "escape sequence": b'{"\\u001b[2K accepted": 1}',
    "other object": b'{"claims": []}',
    "huge": b" " * (MAX_BYTES + 1),
    "huge number": b"9" * 100_000,
    "list": b"[]",
}


@pytest.mark.parametrize("name", FILES)
def test_other_files(tmp_path, name):
    file = tmp_path / "file.json"
    file.write_bytes(FILES[name])
    result = run(file)
    assert complains(result), result.stderr
    assert "\x1b" not in result.stderr
    assert ("larger than" in result.stderr) == (name == "huge")


@pytest.mark.parametrize("bytes_kept", [1, 100, 5000])
def test_truncated_file(tmp_path, bytes_kept):
    file = tmp_path / "file.json"
    file.write_bytes(corpus.path_of("accepted/horseshoe").read_bytes()[:bytes_kept])
    assert complains(run(file))


@pytest.mark.parametrize("name", ["", "missing.json", "missing/file.json"])
def test_directory_and_missing_files(tmp_path, name):
    assert complains(run(tmp_path / name))


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="needs an endless file")
def test_endless_file():
    assert complains(run("/dev/zero"))


def test_a_file_name_cannot_speak_for_the_checker(tmp_path):
    file = tmp_path / "x\nhorseshoe.json: accepted, the paper's parameters"
    file.write_text("{}")
    assert complains(run(file))


@pytest.mark.skipif(sys.platform == "win32", reason="file names are bytes elsewhere")
def test_a_file_name_that_is_no_text(tmp_path):
    file = tmp_path / "x\udcff.json"
    try:
        file.write_bytes(corpus.path_of("accepted/h16_alone").read_bytes())
    except OSError:
        pytest.skip("this file system refuses such names")
    result = run(file)
    assert result.returncode == 0
    assert "accepted" in result.stdout


def test_no_file_is_bad_usage():
    assert run().returncode == 2

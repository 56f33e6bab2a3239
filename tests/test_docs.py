"""The documentation and the README: examples run, commands exist, numbers are the ledger's."""

import doctest
import importlib
import json
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from proofs.shell.screen import Decided, in_a_line
from proofs.trusted.kernel.differential import Avoids
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import premises

ROOT = Path(__file__).parents[1]
PAGES = [
    ROOT / "README.md",
    *sorted(path for path in (ROOT / "docs").glob("*.md") if not path.is_symlink()),
]
TEXTS = {page.name: page.read_text() for page in PAGES}
COMMAND = re.compile(r"python (?:-[SO] )*-m (proofs[\w.]*(?: [a-z_]+)?)([^`\n|#]*)")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_examples_run(page):
    outcome = doctest.testfile(str(page), module_relative=False)
    assert not outcome.failed
    assert outcome.attempted or ">>>" not in TEXTS[page.name]


def test_there_are_examples():
    assert "Oscillator" in TEXTS["guide.md"] and ">>>" in TEXTS["guide.md"]


@pytest.mark.slow
def test_commands_and_their_options_exist():
    used = {}
    for text in TEXTS.values():
        for module, rest in COMMAND.findall(text):
            used.setdefault(module.rstrip("."), set()).update(re.findall(r"--[a-z][a-z-]*", rest))
    assert len(used) > 8
    for module, options in used.items():
        if options - {"--help"} or " " in module:
            told = help_of(module)
            if module == "proofs":
                told += help_of("proofs ledger")  # which options without a command go to
            assert not {option for option in options if option not in told}, module
        else:
            importlib.import_module(module)


def help_of(module):
    call = [sys.executable, "-m", *module.split(), "--help"]
    done = subprocess.run(call, capture_output=True, text=True, cwd=ROOT, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_files_that_are_named_exist():
    for name, text in TEXTS.items():
        paths = re.findall(r"`((?:proofs|intervals|tests|reports|docs)/[\w./-]*)`", text)
        paths += re.findall(r"\]\(([\w./-]+\.(?:svg|md|html|json))\)", text)
        for path in paths:
            assert (ROOT / path).exists() or (ROOT / "docs" / path).exists(), f"{name}: {path}"


def test_the_four_inequalities_are_those_of_the_certificate():
    proved = premises((ROOT / "reports" / "horseshoe.json").read_text()).known
    slopes = [each for each in proved.values() if isinstance(each, SlopeRange)]
    images = {x: y for each in slopes for x, y in zip(each.points, each.images, strict=True)}
    found = re.findall(r"f\((\d\.\d+)\) ([<>]) (\d\.\d+)", TEXTS["proof.md"])
    assert {point for point, _, _ in found} == {"1.1", "1.15", "1.27", "1.32"}
    for point, sign, bound in found:
        low, high = images[Fraction(point)]
        assert high < Fraction(bound) < Fraction("1.1") if sign == "<" else low > Fraction(bound)
        assert sign == "<" or Fraction(bound) > Fraction("1.32")
    (least,) = re.findall(r"on I1 \| f' ≥ ([\d.]+) \|", TEXTS["proof.md"])
    assert min(each.minimum[0] for each in slopes) >= Fraction(least)
    avoided = [each for each in proved.values() if isinstance(each, Avoids)]
    assert "no phase of [1.15, 1.27] has its first impact in I" in TEXTS["proof.md"]
    assert any(
        "[1.15, 1.27] has its first impact in [1.1, 1.32]" in each.sentence for each in avoided
    )


def test_the_readme_shows_what_the_screen_shows():
    rows = json.loads((ROOT / "reports" / "ledger.json").read_text())["claims"]
    claims = [Decided(x["id"], Verdict(x["verdict"]), x["statement"], x["why"]) for x in rows]
    shown = TEXTS["README.md"].partition("```text\n")[2].partition("\n```")[0].splitlines()
    true, verdicts = shown[0], shown[2:-1]
    assert shown[1] == shown[-1] == "..." and len(verdicts) == 5
    assert set(verdicts) <= {in_a_line(each) for each in claims}
    assert true.startswith("True (H2, H5): ") and any(
        true.removesuffix(" ...").split(": ", 1)[1] in (x["corrected"] or "") for x in rows
    )


def outputs(notebook):
    """What a reader of a notebook sees, but for pictures."""
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    data = [[{"text": x.get("text"), **x.get("data", {})} for x in cell.outputs] for cell in cells]
    shown = ("text", "text/html", "text/plain")
    return [[next(x[k] for k in shown if x.get(k)) for x in each] for each in data]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["horseshoe", "figures"])
def test_notebooks_run_and_have_the_outputs_that_they_keep(name):
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = ROOT / "docs" / "notebooks" / f"{name}.ipynb"
    read = nbformat.read(notebook, as_version=4)
    kept = outputs(read)
    where = {"metadata": {"path": str(notebook.parent)}}
    client = nbclient.NotebookClient(read, timeout=120, resources=where)
    client.execute(env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert all(kept) and outputs(read) == kept

"""Without what is optional, each command of the README runs, or names in a line what to install."""

import subprocess
import sys
from importlib.util import find_spec

import pytest

from tests.proofs.shell.processes import ROOT

OPTIONAL = {  # of pyproject.toml
    "report": ("jinja2", "latex2mathml", "markupsafe", "matplotlib"),
    "cluster": ("dask", "distributed"),
    "benchmark": ("flint", "scipy"),
}
WITHOUT = """
import runpy, sys
sys.modules.update(dict.fromkeys(sys.argv.pop(1).split()))  # None: an import fails
runpy.run_module(sys.argv.pop(1), run_name="__main__", alter_sys=True)
"""
BOX = ["--eta", "0.21", "0.215", "--nu", "-0.205", "-0.195", "--ask", "horseshoe", "--depth", "1"]
COMMANDS = {  # arguments, the status, the extra that a line names
    "list": (["--help"], 0, None),
    "main job": (["horseshoe", "--only", "H16"], 0, None),
    "figure": (["horseshoe", "--only", "H16", "--figure"], 2, "report"),
    "ledger": (["ledger", "--only", "H16"], 0, "report"),
    "atlas": (["atlas", *BOX], 1, "report"),
    "dask": (["atlas", *BOX, "--executor", "dask:"], 2, "cluster"),
    "explore": (["explore", "--eta", "0.25", "--nu", "-0.3", "--only", "X1"], 0, None),
    "curves": (["curves", "--epsilon", "0", "--only", "C1"], 0, None),
    "stress": (["stress", "--cases", "3"], 1, "benchmark"),
    "bifurcation": (["bifurcation", "x1 = r*x*(1 - x)"], 0, None),
}


def without(packages, module, arguments):
    command = [sys.executable, "-c", WITHOUT, " ".join(packages), module, *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_a_plain_install_runs_what_the_readme_says(name, tmp_path):
    arguments, status, extra = COMMANDS[name]
    out = [] if name in ("list", "bifurcation", "stress") else ["--out", str(tmp_path)]
    done = without(sum(OPTIONAL.values(), ()), "proofs", [*arguments, *out])
    said = done.stdout + done.stderr
    assert done.returncode == status and "Traceback" not in said, said
    assert ("pip install 'impact-proofs[" in said) == (extra is not None)
    assert extra is None or f"pip install 'impact-proofs[{extra}]'" in said


@pytest.mark.slow
def test_the_report_names_what_it_needs(tmp_path):
    """The report without its page: a line and status 1."""
    folder = ["--out", str(tmp_path)]
    done = without(OPTIONAL["report"], "proofs", ["ledger", "--only", "H16", *folder])
    assert done.returncode == 0
    done = without(OPTIONAL["report"], "proofs.report", folder)
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "pip install 'impact-proofs[report]'" in done.stdout + done.stderr


def test_the_packages_that_are_left_out_are_those_that_are_optional():
    """Else a package that is always there would hide what is missing."""
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    needed = " ".join(project["dependencies"])
    for extra, packages in OPTIONAL.items():
        assert extra in project["optional-dependencies"]
        assert not any(f"{name}>" in needed for name in packages)
    assert find_spec("jinja2") is not None  # here; so what is tested is that it is left out

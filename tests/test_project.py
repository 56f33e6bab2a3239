"""The project's own promises: import boundaries, a typed package, a version told once."""

import os
import subprocess
import sys
import tomllib
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def run(*arguments):
    command = [sys.executable, *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)


@pytest.mark.slow
def test_import_contracts_hold():
    done = run("-c", "from importlinter.cli import lint_imports_command as c; c()")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "5 kept, 0 broken" in done.stdout


def test_no_module_imports_itself_in_a_circle_not_even_lazily_or_for_types():
    import grimp

    graph = grimp.build_graph("intervals", "proofs", cache_dir=None)
    TopologicalSorter(
        {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    ).prepare()  # raises CycleError


def test_packages_are_typed_and_complete():
    folders = {
        path.parent
        for package in ("intervals", "proofs")
        for path in (ROOT / package).rglob("*.py")
    }
    assert all((folder / "__init__.py").exists() for folder in folders)
    assert all((ROOT / package / "py.typed").exists() for package in ("intervals", "proofs"))


def test_what_the_packages_read_is_installed_with_them():
    data = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"][
        "package-data"
    ]
    installed = {
        path
        for name, globs in data.items()
        for each in globs
        for path in (ROOT / name.replace(".", "/")).glob(each)
    }
    command = ["git", "ls-files", "intervals", "proofs"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    files = {ROOT / path for path in done.stdout.split() if not path.endswith(".py")}
    assert files <= installed


def test_the_readme_s_table_names_things_that_exist():
    from proofs.motion import landing
    from proofs.search import image
    from proofs.trusted import equations
    from proofs.trusted.parameters import Parameters

    assert {"eta", "nu", "left", "right", "interval", "slopes", "ratios"} <= set(
        Parameters.__dataclass_fields__
    )
    assert {"lift", "rate", "side"} <= set(equations.Launch._fields)
    assert callable(equations.gap) and callable(equations.slope)
    assert callable(landing.separation_phase) and callable(image.image)


def test_the_tools_forget_nothing_in_the_tree():
    """No file of the packages names a folder of somebody's machine."""
    for package in ("intervals", "proofs"):
        for path in (ROOT / package).rglob("*.py"):
            assert "/tmp/" not in path.read_text() and "/home/" not in path.read_text(), path


def collected(marks, place):
    """The names of the cases of a file, or of one of its tests, that such a run takes."""
    command = [sys.executable, "-m", "pytest", "--collect-only", "-n", "0", "-m", marks]
    done = subprocess.run(
        [*command, f"tests/proofs/trusted/{place}"],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=False,
    )
    return [line.partition("::")[2] for line in done.stdout.splitlines() if "::" in line]


@pytest.mark.slow
def test_what_is_long_is_no_part_of_the_quick_run_and_cases_between_are_none():
    """`-m 'not slow'` takes the place of the usual `-m 'not long'`."""
    file = "kernel/test_flight.py"
    assert collected("long", file) and not collected("long and not slow", file)
    name = "test_two_basins_of_a_quadratic_map"
    place = f"paper/test_circle.py::{name}"
    assert collected("not slow", place) == [f"{name}[0]", f"{name}[2]"]
    assert collected("not long", place) == [f"{name}[{seed}]" for seed in range(3)]


@pytest.mark.parametrize("module", ["proofs", "proofs.horseshoe", "proofs.check"])
@pytest.mark.parametrize("text", [None, "", "class Interval: ..."])
def test_another_distribution_s_intervals_is_a_line(module, text, tmp_path):
    (tmp_path / "intervals").mkdir()
    if text is not None:  # else a folder without __init__, which Python takes for a package
        (tmp_path / "intervals" / "__init__.py").write_text(text)
    done = subprocess.run(
        [sys.executable, "-m", module, "--version"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        check=False,
    )
    if text is None:  # a package with __init__ comes before such a folder
        assert done.returncode == 0 and "impact-proofs" in done.stdout
    else:
        assert done.returncode == 1 and done.stderr.count("\n") == 1
        assert "own package intervals: pip uninstall intervals" in done.stderr


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="files are counted by git")
@pytest.mark.slow
def test_budgets_are_kept():
    done = run("-m", "tests.budgets")
    assert done.returncode == 0, done.stdout + done.stderr

"""The examples of the pages and of the docstrings are run."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import intervals

ROOT = Path(intervals.__file__).parent
PAGES = ["TUTORIAL.md"]


@pytest.mark.parametrize("page", PAGES)
def test_pages(page):
    outcome = doctest.testfile(str(ROOT / page), module_relative=False)
    assert outcome.attempted > 20
    assert not outcome.failed


def modules():
    found = pkgutil.walk_packages(intervals.__path__, "intervals.")
    return [importlib.import_module(module.name) for module in found]


def test_docstrings():
    outcomes = [doctest.testmod(module) for module in modules()]
    assert not sum(outcome.failed for outcome in outcomes)


def test_every_operation_of_the_conformance_page_exists():
    """Names in backticks in the second column of the table are attributes, or are spelled out."""
    page = (ROOT / "CONFORMANCE.md").read_text(encoding="utf-8")
    lines = page.split("## What users")[0].splitlines()
    rows = [line.split("|")[2] for line in lines if line.startswith("| ") and "---" not in line]
    names = [name for row in rows[1:] for name in row.split("`")[1::2] if name.isidentifier()]
    assert len(names) > 30
    for name in names:
        assert hasattr(intervals.Interval, name) or hasattr(intervals, name) or name in BUILTIN


BUILTIN = {"abs", "str", "format", "repr", "eval"}


def test_what_users_asked_for_names_its_tests():
    page = (ROOT / "CONFORMANCE.md").read_text(encoding="utf-8")
    rows = [line for line in page.splitlines() if re.search(r"#\d+", line)]
    sources = "".join(path.read_text() for path in Path(__file__).parent.glob("test_*.py"))
    assert len(rows) >= 10
    for row in rows:
        (name,) = re.findall(r"`(test_\w+)`", row)
        assert f"def {name}(" in sources

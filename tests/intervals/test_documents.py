"""The examples of the pages and of the docstrings are run."""

import doctest
import importlib
import pkgutil
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

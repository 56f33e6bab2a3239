"""The page on your own map: every example is run."""

import doctest
from pathlib import Path

import pytest

import proofs.methods

PAGE = Path(proofs.methods.__file__).with_name("README.md")


@pytest.mark.slow
def test_the_page():
    outcome = doctest.testfile(str(PAGE), module_relative=False)
    assert outcome.attempted > 20
    assert not outcome.failed

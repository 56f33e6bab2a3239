"""The trusted part, with mistakes made on purpose: each is seen."""

import pytest

from tests.mutants import main, mutants


@pytest.mark.parametrize("mutant", mutants(), ids=lambda mutant: mutant.told)
def test_the_text_to_change_is_there_once(mutant):
    assert mutant.applies and mutant.old != mutant.new


@pytest.mark.long
def test_every_mistake_is_seen():
    assert main([]) == 0

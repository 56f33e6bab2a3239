"""The tests of Interval run by python-flint and by mpmath, those that take long by one of them."""

import pytest

from intervals import Interval, _engine

ENGINES = {"flint": _engine.fastest(Interval), "mpmath": _engine.BY_MPMATH}
BRIEF = {"exact", "functions", "relations", "sharing", "text"}
LENGTHY = {"complex", "decorated", "interval", "jet", "krawczyk", "newton", "search", "taylor"}


@pytest.fixture(scope="module")
def engine(request):
    """Have Interval compute by the library that is named."""
    before = {name: getattr(Interval, name) for name in _engine.BY_MPMATH}
    _engine.use(Interval, ENGINES[request.param])
    yield request.param
    _engine.use(Interval, before)


def pytest_generate_tests(metafunc):
    """Ask for both libraries; the second is for the long mode where it would double the time."""
    module = metafunc.module.__name__.rpartition("test_")[2]
    if module in BRIEF | LENGTHY:
        metafunc.fixturenames.append("engine")
        marks = pytest.mark.long if module in LENGTHY else ()
        both = ["flint", pytest.param("mpmath", marks=marks)]
        metafunc.parametrize("engine", both, indirect=True, scope="module")

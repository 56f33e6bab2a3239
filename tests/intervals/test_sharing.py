"""Threads and forks: nothing is shared but caches of constants, so all find the same."""

import multiprocessing
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from intervals import Interval, IntervalArray
from intervals.elementary import constants


def work(precision):
    """Exact texts of results at a precision: equal for equal arguments, whoever computes them."""
    x = Interval("1.1", "1.2", precision=precision)
    array = IntervalArray([("1.1", "1.2"), "1/3"])
    results = (
        x.sin(),
        x.exp().log1p(),
        x.atan(),
        x.pow(Interval("1/3")),
        Interval.pi(precision=precision),
    )
    arrays = (array.sin(), array.exp(), array.sum(), array @ array)
    return [repr(y) for y in (*results, *arrays)]


PRECISIONS = [20, 53, 113, 200, 333, 1000] * 4


def test_threads_find_the_same_at_their_own_precisions():
    expected = [work(p) for p in PRECISIONS]
    constants.pi_fixed.cache_clear()
    barrier = threading.Barrier(4)

    def together(part):
        barrier.wait()
        return [work(p) for p in part]

    parts = [PRECISIONS[i::4] for i in range(4)]
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(together, parts))
    assert found == [expected[i::4] for i in range(4)]


@pytest.mark.skipif(sys.platform != "linux", reason="needs fork")
def test_forked_processes_find_the_same():
    expected = [work(p) for p in PRECISIONS[:6]]
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(work, PRECISIONS[:6]) == expected


def test_precision_travels_with_the_number():
    low, high = Interval("1/3", precision=30), Interval("1/3", precision=300)
    assert (low + high).precision == (high * low).precision == high.atan2(low).precision == 300
    assert low.sin().precision == low.bisect()[0].precision == low.widen("1/8").precision == 30
    assert low.fma(low, high).precision == low.hypot(high).precision == 300
    assert low.sin().contains(high.sin())

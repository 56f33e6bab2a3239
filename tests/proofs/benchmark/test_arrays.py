"""Arrays of other packages: all do the same work, and widths are told apart."""

import numpy as np
import pytest

from intervals import IntervalArray
from proofs.benchmark import arrays


@pytest.mark.parametrize("name", arrays.NAMES)
@pytest.mark.parametrize("package", arrays.packages())
def test_packages_do_the_same_work_and_widths_are_counted(package, name):
    lower = np.linspace(0.1, 3, 40)
    upper = lower + 2.0**-9
    p = arrays.packages()[package]
    beyond = arrays.excess(p, name, lower, upper)
    assert 0 <= beyond.max() <= (3 if package == "IntervalArray" else 1)

    wider = p._replace(ends=lambda x: (p.ends(x)[0], np.nextafter(p.ends(x)[1], np.inf)))
    assert arrays.excess(wider, name, lower, upper).mean() > beyond.mean()


def test_a_row_for_each_operation_and_package():
    section = arrays.measure("smallest", lambda _: None)
    assert len(section.rows) == len(arrays.NAMES) * len(arrays.packages())
    assert all("ulps" in row.measured for row in section.rows)
    assert IntervalArray.__name__ in section.rows[0].name

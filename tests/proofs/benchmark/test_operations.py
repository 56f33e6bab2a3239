"""Single operations: all libraries do the same work on the same intervals."""

from fractions import Fraction

import numpy as np
import pytest

from proofs.benchmark import operations
from proofs.benchmark.operations import ARRAY
from proofs.benchmark.peers import FLINT, IV, OURS

flint = pytest.importorskip("flint")
COUNT = 9


def flat(found):
    """Return pairs of exact ends."""
    if isinstance(found, flint.arb):
        ends = (end.man_exp() for end in (found.lower(), found.upper()))
        return [tuple(int(m) * Fraction(2) ** int(e) for m, e in ends)]
    if hasattr(found, "_mpi_"):  # mpmath.iv
        ends = ((-1) ** s * int(m) * Fraction(2) ** e for s, m, e, _ in found._mpi_)
        return [tuple(ends)]
    if hasattr(found, "inf"):  # ours
        ends = np.ravel(found.inf).tolist(), np.ravel(found.sup).tolist()
        return [tuple(map(Fraction, pair)) for pair in zip(*ends, strict=True)]
    return [pair for one in getattr(found, "tolist", found.__iter__)() for pair in flat(one)]


@pytest.mark.parametrize("name", operations._TEXTS)
def test_all_libraries_do_the_same_work(name):
    found = {}
    for library in (ARRAY, OURS, FLINT, IV):
        text = operations.statement(name, library)
        if (name, library) != ("hypot", FLINT):  # which has none
            found[library] = flat(eval(text, operations.operands(library, 53, COUNT)))
    for library, pairs in found.items():
        assert len(pairs) == len(found[OURS]), library
        for (low, high), (least, most) in zip(pairs, found[OURS], strict=True):
            assert low <= most and least <= high, library
            assert abs(low - least) <= max(high - low, most - least), library

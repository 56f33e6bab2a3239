"""Single operations: all libraries do the same work on the same intervals."""

from fractions import Fraction

import numpy as np
import pytest

from proofs.benchmark import operations
from proofs.benchmark.operations import ARRAY, _pairs, _task
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


@pytest.mark.parametrize("pair", list(_pairs()), ids=str)
def test_pairs_are_the_same_work(pair):
    """What both find meets, and is about as wide."""
    with flint.ctx.workprec(pair.bits):
        ours, theirs = (flat(_task(pair, name)()) for name in pair[:2])
    if pair.at_ends:
        lows, highs = theirs[: pair.length], theirs[pair.length :]
        theirs = [(low[0], high[1]) for low, high in zip(lows, highs, strict=True)]
    assert len(ours) == len(theirs) == pair.length
    assert all(a[0] <= b[1] and b[0] <= a[1] for a, b in zip(ours, theirs, strict=True))
    widths = [b - a for a, b in ours]
    assert all(w / 2 < hi - lo < 3 * w for w, (lo, hi) in zip(widths, theirs, strict=True))


def test_a_long_name_of_a_precision_is_heeded():
    names = operations.operands(OURS, 333, COUNT)
    (found, *_) = eval(operations.statement("exp", OURS), names)
    assert (found.inf.denominator.bit_length()) > 200

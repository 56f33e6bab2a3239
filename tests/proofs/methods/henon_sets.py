"""Covering relations of the third iterate of the Henon map at a = 1.4, b = 0.3.

A dozen parallelograms along the attractor, with axes along the stable and unstable directions of
points of period up to 8, were chosen by a random local search in floating point for many crossings
under F^3. Each set below is the part of one of them that F^3 maps across some of them, so a set
covers all sets of the parallelograms that it covers.
"""

from __future__ import annotations

from functools import cache

from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.certificate import render
from tests.proofs.trusted.kernel.lemma_examples import henon

# parallelogram: centre, unstable column, stable column, in units of 1/10000 -> those it covers
TABLE = """
0: 8632 1376 -158 25 -87 -180 -> 7
0: 7779 1511 -521 83 -87 -180 -> 2 10
0: 6416 1727 -636 101 -87 -180 -> 0 3
0: 5427 1883 -255 40 -87 -180 -> 1
1: 11264 668 -228 70 -119 -329 -> 9
1: 10709 838 -219 67 -119 -329 -> 2
1: 10289 967 -196 60 -119 -329 -> 10
2: -4294 2865 -1632 203 428 -421 -> 4 5
3: 3022 2354 -1076 131 -80 -60 -> 4 5
3: 1221 2574 -617 75 -80 -60 -> 6
4: 10804 -1168 -523 -130 -373 -928 -> 9 11
4: 9502 -1491 -673 -167 -373 -928 -> 2 10
5: 6202 -2166 -906 -125 -200 -288 -> 2 10
5: 3453 -2546 -1530 -212 -200 -288 -> 0 3
6: -3600 -3337 -1164 -118 296 -187 -> 0
7: -11552 3746 294 -21 -165 577 -> 8
8: 7268 889 -263 111 -82 -182 -> 2
8: 6521 1204 -272 115 -82 -182 -> 3
9: 2394 1875 -1244 229 -163 -116 -> 4 5
10: -7235 3407 -344 29 154 -314 -> 1
10: -8405 3504 -639 53 154 -314 -> 0
11: 5748 1052 -339 113 -51 -86 -> 0
11: 5054 1282 -226 75 -51 -86 -> 1
"""


def rows():
    """The lines as (parallelogram, numbers, parallelograms covered)."""
    for line in TABLE.strip().splitlines():
        name, _, rest = line.partition(":")
        numbers, _, targets = rest.partition("->")
        yield int(name), [f"{n}/10000" for n in numbers.split()], set(map(int, targets.split()))


@cache
def entropy_lemma():
    """The lemma file: every relation proved, and the entropy of the graph."""
    file, nodes = SymbolicLemmas({"F": henon("7/5", "3/10")}), []
    for name, (x, y, ux, uy, sx, sy), targets in rows():
        nodes.append((file.h_set([x, y], [[ux, sx], [uy, sy]]), name, targets))
    arrows = [(a, b) for a, _, targets in nodes for b, name, _ in nodes if name in targets]
    graph = file.graph([file.covers("F", 3, a, b) for a, b in arrows])
    return render(file.document(file.entropy(graph, 24)))

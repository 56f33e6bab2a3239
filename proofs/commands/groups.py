"""The commands that prove a group of claims: `python -m proofs NAME`, one row for each.

A row is the text of `--help`, the numbers that what is proved depends on, and what one of them has
more than others.
"""

from __future__ import annotations

from argparse import ArgumentTypeError, Namespace
from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType

from proofs.search.budget import EFFORT
from proofs.shell.cli import horizon, number, whole
from proofs.shell.runner import Group
from proofs.trusted.parameters import Parameters

_OSCILLATOR, _SETS = ("eta", "nu"), ("left", "right")
_MOST_EFFORT = 5


def _seconds(text: str) -> Fraction:
    """Read a time for argparse."""
    value = number(text)
    if value <= 0:
        raise ArgumentTypeError(f"seconds are a positive number, not {text!r}")
    return value


def _dossier(statement: Parameters, options: Namespace) -> str:
    from proofs.commands.dossier import dossier

    return dossier(statement, options)


_ROWS = (
    Group(
        "horseshoe",
        """\
Is the impact map a horseshoe on the printed sets? Claims H1-H6, H11, H16, N1 and N2.

The main job: proves or refutes each claim at exact parameters, repairs the sets where the
printed numbers fail, writes certificate and report, and has the checker re-derive them.""",
        (*_OSCILLATOR, *_SETS, "interval", "slopes", "epsilon", "velocities"),
        """
  python -m proofs horseshoe --eta 0.22 --nu -0.2      I0, I1 and the slopes are found there
  python -m proofs horseshoe --eta 0.103 --nu 0.541    f decreases on the sets that are found
  python -m proofs horseshoe --eta 0.212 --nu -0.2 --left 1.1 1.15 --right 1.27 1.32
  python -m proofs horseshoe --only N1 N2 --epsilon 0.02
""",
        {"horizon": {"type": horizon, "help": "longest flight looked at (default 1000)"}},
    ),
    Group(
        "foundations",
        """\
Section 2 and the appendix: the model's equations derived, sticking, marching, and measures.

Claims M1 to M5, M7 to M9, A1 and A2. They are about all values of the parameters, or about exact
witnesses; A1 also names phases of the parameters given that never impact again.""",
        _OSCILLATOR,
        fixed=("M1", "M2", "M3", "M4", "M5", "M7", "M8", "M9", "A2"),
    ),
    Group(
        "sets",
        """\
Sections 3.1 and 3.2: is the invariant set what Theorems 2 to 4 and the proof of Claim 1 say?

Claims H7-H10, on the invariant set of the map, rest on a horseshoe around the given interval I and
on the orbits of the ends of I; H12, H14, H15 and H17, on the linear set, on powers of rationals.
""",
        (*_OSCILLATOR, *_SETS, "interval", "slopes"),
    ),
    Group(
        "dimension",
        "Hausdorff dimensions of the sets that stay in I and in the intervals of G5. "
        "Claims H13, G19.",
        (*_OSCILLATOR, *_SETS, "interval", "slopes"),
    ),
    Group(
        "chaos",
        """\
Section 3.4: is there another invariant set, and how much chaos is there in all?

Claims G5, G11: which orbits stay in [1.32, 1.48], and the full shifts around it. G9: a lower
bound on the topological entropy, from all branches of f near the phase pi/2.""",
        _OSCILLATOR,
    ),
    Group(
        "circle",
        """\
Sections 2 and 3.4: where the mass sticks, and how much of the circle ends up sticking.

Claims M6, G1-G4, G6, and G10, G13, G14 of our own: the sticking arc and the orbit through it, an
interval of phases that never impact again, and a partition of the circle into cells whose images
are followed until they stick, or never impact again.""",
        _OSCILLATOR,
    ),
    Group(
        "entropy",
        """\
Section 3.4: the chaos of the plastic map as a whole.

G17: its topological entropy from both sides. H18: phases at which it jumps, after which the mass
grazes the table, and the coefficients of its square roots there.""",
        _OSCILLATOR,
    ),
    Group(
        "nonplastic",
        """\
Section 3.3: the impact map with restitution on the printed rectangles. Claims N1 to N5.

Candidates by floating point; every impact, rectangle and barred word is proved by interval
arithmetic and recorded for the checker.""",
        (*_OSCILLATOR, *_SETS, "epsilon", "velocities", "reach"),
    ),
    Group(
        "persistence",
        """\
Section 3.4 with restitution: the stable orbit persists, with infinitely many impacts a period.

Claims G7, G8, and G12, G15 and G16 (our own). The flight from phi_s does not depend on epsilon;
after it, for ever larger epsilon, bounces are enclosed until they are proved to end before that
phase.""",
        (*_OSCILLATOR, "epsilon"),
    ),
    Group(
        "single",
        """\
Section 4: single-impact orbits. (16)-(18) derived; which solutions are orbits, and stable.

Identities are found with sympy; solutions, first impacts and the ends of the windows of stable
orbits in figures 7a and 7b are enclosed with the package `intervals`.""",
        _OSCILLATOR,
        fixed=("P1", "P2", "P3", "P5", "P6"),
    ),
    Group(
        "soft",
        "Section 5: every equation of the soft springs derived, and its bifurcations decided.",
    ),
    Group(
        "resonance",
        """\
Section 6, resonance: the map in closed form, every formula derived, and what the paper missed.""",
    ),
    Group(
        "explore",
        """\
What can be proved about the motion at parameters of one's own: chaos, attractors, rest.

Asks at any eta > 0 and nu: does the mass come to rest on the table for ever (X1)? Is there a
compact invariant set on which the impact map has positive entropy (X2)? A stable periodic motion on
which the mass sticks and leaves again (X3)? A stable periodic orbit without sticking (X4)? Are
there flights without an end (X5)? Does more than half of the circle come to a motion that sticks
(X10)? With --epsilon, about impacts with restitution: is there chaos (X6)? A stable motion (X7)?
Does every motion come to rest (X8)? Do motions that only touch the table attract (X9)? Sets and
orbits are found by themselves, then proved. Beside the verdicts, and apart from them: the circle
cut into branches, as floating point sees it.""",
        (*_OSCILLATOR, "epsilon"),
        """
  python -m proofs explore --eta 0.25 --nu -0.3
  python -m proofs explore --eta 0.103 --nu 0.541 --only X2
  python -m proofs explore --eta 0.22 --nu -0.2 --epsilon 0.05
  python -m proofs explore --eta 1.1009 --nu -1.2954 --effort 4 --seconds 60
""",
        {
            "effort": {"type": whole("effort", _MOST_EFFORT), "metavar": "N"}
            | {
                "help": f"how much is looked at, 1 to {_MOST_EFFORT} (default {EFFORT}); each takes"
                " about four times as long as the one before"
            },
            "seconds": {"type": _seconds, "metavar": "S"}
            | {"help": "stop looking early; what is found then depends on the machine"},
        },
        _dossier,
    ),
    Group(
        "curves",
        """\
Curves in the plane of eta and nu: where single-impact orbits fold, flip, or graze the table.

Of orbits with one impact in n table periods, with restitution epsilon: the curves of folds and of
flips in closed form, for all n and epsilon (C1). Curves on which the orbit touches the table on its
way, below |nu| = 1, followed and enclosed in boxes around all of each curve, with points to 15
places (C2). Where these meet folds or flips (C3). For n = 1 and 2, eta < 2. For plastic impacts and
all n: where orbits with a sticking phase end, other than by grazing, in closed form (C4).""",
        ("epsilon",),
        """
  python -m proofs curves --epsilon 0
  python -m proofs curves --epsilon 0.3 --figure
""",
    ),
)
GROUPS: Mapping[str, Group] = MappingProxyType({group.name: group for group in _ROWS})

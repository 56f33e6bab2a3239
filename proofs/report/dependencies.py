"""What in the paper rests on what, as the paper says it; and what falls with a false claim.

The table is about the paper's own argument, not about our proofs: where a claim is refuted, the
argument for all that rests on it falls, whatever is true of these by other means.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple


class Rest(NamedTuple):
    """The claims that the paper derives another from, and where it does, in its words."""

    on: tuple[str, ...]
    where: str


RESTS: Mapping[str, Rest] = MappingProxyType(
    {
        "M3": Rest(("M1", "M2"), "2: 'After substituting (4), (5), (2) and (3) in (6) and (7)'"),
        "M4": Rest(("M3",), "2: 'We nondimensionalize Equation (8)'"),
        "M5": Rest(("M3",), "2: 'the above equations are transcendental'"),
        "M6": Rest(("M4", "M8"), "2: 'Using this phase value (phi_s) and Equation (10)'"),
        "A1": Rest(("M4",), "A.1: 'This algorithm to solve Equation (10)'"),
        "H1": Rest(("M6",), "3.1: 'From Figure 2, we note'"),
        "H2": Rest(("M6",), "3.1: 'From Figure 2, we note'"),
        "H3": Rest(("M6",), "3.1: 'Also note the function is monotonically increasing'"),
        "H4": Rest(("M6",), "3: '(see Figure 2)'"),
        "H5": Rest(("H3",), "3.1: 'and therefore f^(-1)(J) consists of two closed intervals'"),
        "H6": Rest(("H1", "H5"), "3.1: 'less than (1/gamma_2)|J|'"),
        "H7": Rest(
            ("H2", "H4", "H5", "H6"),
            "3.1, proof of Theorem 2: 'is a closed interval', '(1/gamma_2)', '1/gamma_1^N |I|'",
        ),
        "H8": Rest(("H7",), "3.1: 'an immediate consequence', of Theorems 1 and 2"),
        "H9": Rest(("H5",), "3.2: 'f^(-n)(I) consists of 2^n closed intervals'"),
        "H12": Rest(
            ("H9", "H11", "H14", "H17", "A2"),
            "3.2, Claim 1: 'Lambda is a compact set', (12) and (13), 'From Theorem 7'",
        ),
        "H13": Rest(
            ("H1", "H2", "H12"),
            "3.2: 'simplifying assumptions', slopes lambda_0 = 5.25 and lambda_1 = 4.2",
        ),
        "H14": Rest(("A2",), "3.2, Claim 1: 'concepts from the measure theory'"),
        "H16": Rest(("H11",), "3.2: 'Let s_o > 0 be such that'"),
        "H17": Rest(("H15", "H16"), "3.2, Claim 1: 'Thus replacing every such J'"),
        "N1": Rest(("M3",), "3.3: 'We denote this map', of (14) and (15)"),
        "N2": Rest(("M3",), "3.3: 'These images are shown in the same figure'"),
        "N3": Rest(("N1",), "3.3: 'having a horseshoe implies that'"),
        "G1": Rest(("M6",), "3.4: 'the graph of f over its full domain'"),
        "G2": Rest(("G1",), "3.4: 'This leads to a 2-periodic orbit'"),
        "G3": Rest(("G1", "G2"), "3.4, Figure 6: 'stable 2-periodic orbit'"),
        "G4": Rest(("G2",), "3.4: 'That is, this 2-periodic orbit attracts'"),
        "G5": Rest(("G20",), "3.4: 'This suggests the existence of another invariant set'"),
        "G20": Rest(("H8",), "3.4: 'depended only on the geometrical attributes of the graph'"),
        "G6": Rest(("G2", "G5"), "3.4: 'near the invariant sets'"),
        "G7": Rest(("M3",), "3.4: 'Similar simulations were done in the nonplastic case'"),
        "G8": Rest(("G7",), "3.4: 'took longer time to reach the periodic orbit'"),
        "P1": Rest(("M4",), "4: 'Substituting this condition in Equation (10)'"),
        "P2": Rest(("P1",), "4: 'Equation (16) can be rewritten as'"),
        "P3": Rest(("M4",), "4: 'The slope is given by'"),
        "P4": Rest(("P2", "P3"), "4: 'checking if the magnitude of the slope'"),
        "P5": Rest(("P1", "P4"), "4: 'obtained by solving Equation (16)'"),
        "P6": Rest(("P1", "P4"), "4: 'obtained by solving Equation (16)'"),
        "S2": Rest(("S1", "M2"), "5: 'after carrying out computations as in Section 2'"),
        "S3": Rest(("S2",), "5: 'we use the relations' in (24) and (25)"),
        "S4": Rest(("S2",), "5: 'we use the relations' in (24) and (25)"),
        "S5": Rest(("S3", "S4"), "5: 'These equations can be rewritten as'"),
        "S6": Rest(("S4",), "5: 'These equations can be rewritten as'"),
        "S7": Rest(("S5", "S6"), "5: the limits of A to G of (28) and (29)"),
        "S8": Rest(("S7", "S10"), "5: 'So, for every mu > 0, there exists a delta > 0'"),
        "S9": Rest(("S7", "S8", "S10"), "5: 'and', from the limits of E, F and G"),
        "S11": Rest(("S2", "S8", "S9"), "5: 'obtained from Equations (24) and (25)', at psi_o"),
        "S12": Rest(("S11",), "5: 'The eigenvalues of this matrix'"),
        "S14": Rest(("S12", "S13"), "5: 'and therefore the eigenvalues are real'"),
        "S15": Rest(("S12",), "5: 'This means that the fixed points are either sinks or saddles'"),
        "S16": Rest(("S12", "S14"), "5: 'We show that the fixed points are saddles'"),
        "S17": Rest(("S12", "S14"), "5: 'We show that the fixed points are saddles'"),
        "S18": Rest(("S16", "S17"), "5: 'are bifurcation values'"),
        "S19": Rest(("S8", "S9"), "5: 'the same results have been obtained in [1]'"),
        "S20": Rest(("S2",), "5: 'obtained by substituting epsilon = 0'"),
        "S21": Rest(("S20",), "5: 'By taking successive derivatives of this map'"),
        "S22": Rest(("S20", "S21"), "5: 'By taking successive derivatives of this map'"),
        "S23": Rest(("S22",), "5: 'This implies that the map f undergoes'"),
        "R1": Rest(("M3",), "6: 'substituting eta = 1 in Equations (14) and (15)'"),
        "R2": Rest(("R1",), "6.1: 'Thus, in resonance condition'"),
        "R3": Rest(("R1", "R2"), "6.1: 'the Jacobian of this map at these values'"),
        "R4": Rest(("R3",), "6.1: 'and its eigenvalues are'"),
        "R5": Rest(("R1",), "6.2: 'We shall use these relations'"),
        "R6": Rest(("R5",), "6.2, Case 1.1: 'Using Equation (30), we deduce'"),
        "R7": Rest(("R5",), "6.2, Case 1.2: 'Equation (30) implies'"),
        "R8": Rest(("R5",), "6.2, Case 1.2: 'Equation (30) implies'"),
        "R9": Rest(("R1",), "6.2, Case 2: 'solving the corresponding equations'"),
        "R10": Rest(("R1",), "6.2: 'the Jacobian matrix'"),
        "R11": Rest(("R1",), "6.2: 'the Jacobian matrix'"),
        "R13": Rest(
            ("R6", "R7", "R8", "R9", "R10", "R11", "R12"),
            "6.2, Figure 8: 'how these fixed points vary', unstable, not sticking",
        ),
    }
)  # claims that are not here rest on no other claim


def rests_on(claim: str) -> set[str]:
    """Return all claims that the paper's argument for one rests on, directly or not."""
    return _reached(claim, {other: rest.on for other, rest in RESTS.items()})


def falls_with(claim: str) -> set[str]:
    """Return all claims whose argument in the paper falls with one."""
    uses: dict[str, tuple[str, ...]] = {}
    for other, rest in RESTS.items():
        for premise in rest.on:
            uses[premise] = (*uses.get(premise, ()), other)
    return _reached(claim, uses)


def _reached(start: str, arrows: Mapping[str, tuple[str, ...]]) -> set[str]:
    reached: set[str] = set()
    waiting = list(arrows.get(start, ()))
    while waiting:
        claim = waiting.pop()
        if claim not in reached:
            reached.add(claim)
            waiting += arrows.get(claim, ())
    return reached

"""The rules of inference, from name to function: each turns a witness into a conclusion.

A rule takes the premises of a step and its witness; it raises Unproved where a hypothesis is not
established. Its docstring is its theorem.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from types import MappingProxyType

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context

Rule = Callable[[Context, Reader], Conclusion]

RULES: Mapping[str, str] = MappingProxyType(
    {
        "formula-equal": "kernel.values.equal",
        "formula-series": "kernel.values.series",
        "formula-solution": "kernel.solutions.solution",
        "formula-value": "kernel.values.value",
        "unique-zero": "kernel.zeros.unique_zero",
        "periodic-orbits": "kernel.periodic.periodic_orbits",
        "periodic-orbit": "kernel.cycle.periodic_orbit",
        "image": "kernel.differential.image",
        "avoids": "kernel.differential.avoids",
        "no-impact": "kernel.outcomes.no_impact",
        "pressed": "kernel.outcomes.pressed",
        "graze": "kernel.outcomes.graze",
        "trapping": "kernel.trapping.trapping",
        "arc": "kernel.arcs.arc",
        "flight-arc": "kernel.flightarcs.flight_arc",
        "h-set": "kernel.covers.h_set",
        "covers": "kernel.covers.covers",
        "graph": "kernel.graph.graph",
        "entropy": "kernel.graph.entropy",
        "cone": "kernel.cones.cone",
        "differential": "kernel.differential.differential",
        "slopes": "kernel.differential.slopes",
        "rectangle": "kernel.rectangles.rectangle",
        "horseshoe": "kernel.horseshoe.horseshoe",
        "barred-word": "kernel.words.barred_word",
        "stable-cycle": "kernel.stable.stable_cycle",
        "moran-root": "kernel.moran.moran_root",
        "itinerary": "kernel.itineraries.itinerary",
        "staying-set": "kernel.staying.prove_staying_set",
        "covering-graph": "kernel.coverings.covering_graph",
        "stable-orbit": "kernel.loops.prove_stable_orbit",
        "dimension": "paper.s32_sets.repeller.dimension",
        "separation": "paper.s34_circle.landing.separation",
        "lands": "paper.s34_circle.landing.lands",
        "never-impacts": "paper.s34_circle.landing.never_impacts",
        "absorption": "paper.s34_circle.absorption.absorption",
        "branch": "paper.branches.branch",
        "grazing": "paper.s34_circle.grazing.grazing",
        "pieces": "paper.s34_circle.pieces.pieces",
        "itinerary-graph": "paper.s34_circle.laps.itinerary_graph",
        "expansion": "paper.s34_circle.cycles.prove_expansion",
        "superstable-motion": "paper.s34_circle.persistence.prove_superstable_motion",
        "single-solution": "paper.s4_single.orbits.single_solution",
        "single-windows": "paper.s4_single.windows.single_windows",
        "sticking-motion": "paper.beyond.attractors.prove_sticking_motion",
        "grazing-curve": "paper.beyond.grazing.grazing_curve",
        "grazing-meets": "paper.beyond.meetings.meeting",
        "stable-singles": "paper.beyond.singles.stable_singles",
    }
)


def find_rule(name: str) -> Rule | None:
    """Return a rule by its name; only its own module is imported."""
    if name not in RULES:
        return None
    module, _, function = RULES[name].rpartition(".")
    found: Rule = getattr(import_module(f"proofs.trusted.{module}"), function)
    return found

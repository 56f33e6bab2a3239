"""Motions from the arc where the mass sticks: back to it, or to what never sticks. X3."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.images import image_range, inside
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.loops import StableOrbit, led
from proofs.trusted.numbers import TURN, Range, between, ceil_text, show, show_range
from proofs.trusted.oscillator import PlasticMap
from proofs.trusted.paper.s34_circle.landing import Lands, NeverImpacts, Separation
from proofs.trusted.parameters import Place

_MOST_NAMED = 12  # cells


def _named(cells: Sequence[Range]) -> str:
    return ", ".join(map(show_range, cells)) + ", mod 2 pi"


def _earliest(arc: Separation, landing: Lands | None) -> Fraction:
    """Return a short decimal: after that a mass sticks, up to phi_s, or at its next impact."""
    if landing is None:
        return Fraction(ceil_text(arc.start[1]))
    if landing.at != arc.at or landing.phases[1] < arc.start[1]:
        raise Unproved("the launches that land on the arc are not known up to it")
    return Fraction(ceil_text(landing.phases[0]))


@dataclass(frozen=True)
class _Released(Conclusion):
    """A mass that sticks leaves at phi_s, and its next impacts are in sets of phases, in turn.

    parts: what f, C^1, is on these sets.
    """

    arc: Separation
    parts: tuple[SlopeRange, ...]

    at = About("arc")

    @property
    def cells(self) -> tuple[Range, ...]:
        """The sets."""
        return tuple(part.ends for part in self.parts)

    @property
    def quantities(self) -> dict[str, Range]:
        return {"separation_phase": self.arc.phase}

    def last_impacts(self, *beside: SlopeRange) -> list[Range]:
        """Return what holds the first impact after all of them, and that of launches beside.

        Unproved unless the first one is inside the first set, f of that inside the next, and so on.
        """
        if any(part.at != self.at for part in (*self.parts, *beside)):
            raise Unproved("the hypotheses are about different oscillators")
        return led([self.arc.arrival, *map(image_range, beside)], self.parts)


@dataclass(frozen=True)
class StickingMotion(_Released):
    """Theorem. Let f be C^1 on sets C_1, ..., C_n of phases, the first impact after the separation
    at phi_s inside C_1, f(C_i) inside C_(i+1), and f(C_n), or for n = 0 the first impact, inside
    (b, phi_s), where after each launch between b and the arc the first impact is on the arc, by
    `landing`; without that b is in the arc. Then what the sentence says.

    Proof. The mass leaves the arc at phi_s, whatever the phase at which it came to stick, and what
    makes an impact in (b, phi_s) comes to stick: so the motion from phi_s repeats. f is continuous
    on the C_i and the first impact is inside C_1: impacts near those of the motion are followed by
    impacts near its next ones, the last inside (b, phi_s).
    """

    landing: Lands | None = None

    def __post_init__(self) -> None:
        sticking = _earliest(self.arc, self.landing), self.arc.phase[0]
        _require_inside(self.at, self.last_impacts(), sticking)

    @property
    def sentence(self) -> str:
        between_them = f" at phases in {_named(self.cells)}" if self.cells else ""
        return (
            f"{self.brief}. It leaves the table at a phase in {between(self.arc.phase, 12)}, with "
            f"impacts{between_them}, the last one where the mass sticks until it leaves again. The "
            "motion is superstable: a mass that sticks anywhere joins it exactly when it leaves, "
            "and so do those that make their next impact near one of these."
        )

    @property
    def brief(self) -> str:
        count = len(self.cells) + 1
        most = f"{count} or {count + 1}" if self.landing else f"{count}"
        each = "1 impact" if most == "1" else f"{most} impacts"
        return f"a periodic motion has {each} and one separation a period"


@dataclass(frozen=True)
class ReturningMotion(_Released):
    """Theorem. Let the first impacts after launches in (phi_s, u], on which f is C^1, be inside
    C_1, too, and f(C_n), or for n = 0 the first impacts, inside (b, u), all else being as in
    `StickingMotion`. Let the product of sup |f'| on (phi_s, u] and on all C_i be below 1. Then what
    the sentence says.

    beyond: what f is on (phi_s, u].

    Proof. Let R(x) be f^(n+1)(x) where that is after phi_s, else phi_s, for x in [phi_s, u]: the
    phase of the next launch from there. As max(phi_s, y) does not expand, R contracts [phi_s, u]
    into itself: all its orbits come to one fixed point, a motion that sticks if that is phi_s, else
    one of f.
    """

    beyond: SlopeRange
    landing: Lands | None = None

    def __post_init__(self) -> None:
        (first, last), leaves = self.beyond.ends, self.arc.phase[1]
        if not first <= leaves <= last:
            raise Unproved("the launches after the arc are not known from its end on")
        back = _earliest(self.arc, self.landing), last
        if back[1] - back[0] >= TURN or self.contraction >= 1:
            raise Unproved("f is not proved to contract around the loop")
        _require_inside(self.at, self.last_impacts(self.beyond), back)

    @property
    def contraction(self) -> Fraction:
        """A bound on |R'|."""
        steepest = max(_steepest(self.arc), self.beyond.steepest)
        return steepest * prod(part.steepest for part in self.parts)

    @property
    def sentence(self) -> str:
        each = f" an impact at a phase in each of {_named(self.cells)}, and" if self.cells else ""
        sticks = "sticks until phi_s" + (", perhaps after one more impact," if self.landing else "")
        return (
            f"{self.brief}: it has{each} a last one at a phase, mod 2 pi, after "
            f"{show(_earliest(self.arc, self.landing))} and up to {show(self.beyond.ends[1])}, "
            f"where the mass {sticks} if it is before phi_s, in {between(self.arc.phase)}, and "
            "leaves at once if it is after that. It attracts all motions that have an impact "
            "between these two phases."
        )

    @property
    def brief(self) -> str:
        most = ceil_text(self.contraction)
        return f"a periodic motion is stable, |multiplier| <= {most}, whether it sticks or not"


@dataclass(frozen=True)
class SticksOnce(_Released):
    """Theorem. Let f be C^1 on sets C_1, ..., C_n of phases, the first impact after the separation
    inside C_1, f(C_i) inside C_(i+1), and f(C_n), or for n = 0 the first impact, inside a set of a
    stable orbit, or inside phases after which there is no impact. Then what the sentence says.

    Proof. What sticks leaves at phi_s. Its impacts are in the C_i in turn, where it leaves at once,
    as f is C^1 there; then in the sets of the orbit, which f maps into each other; or there is
    none, and no touch, which comes at the phase of the launch with the gap > 0 before it, is where
    the mass sticks. So from the separation on it never sticks, and no such motion repeats.
    """

    end: StableOrbit | NeverImpacts

    def __post_init__(self) -> None:
        if self.end.at != self.at:
            raise Unproved("the hypotheses are about different oscillators")
        sets = self.end.cells if isinstance(self.end, StableOrbit) else (self.end.phases,)
        _require_inside(self.at, self.last_impacts(), *sets)

    @property
    def sentence(self) -> str:
        many = len(self.cells) > _MOST_NAMED
        named = (
            f"{len(self.cells)} impacts" if many else f"impacts at phases in {_named(self.cells)}"
        )
        impacts = f" makes {named}," if self.cells else ""
        if isinstance(self.end, StableOrbit):
            end = (
                f"makes all {'further ' * bool(self.cells)}impacts at phases in "
                f"{_named(self.end.cells)}, around a stable periodic orbit of period "
                f"{len(self.end.cells)}, and leaves at once after each"
            )
        else:
            end = (
                f"makes one {'more ' * bool(self.cells)}impact, at a phase in "
                f"{show_range(self.end.phases)}, mod 2 pi, and no other, only touches without "
                "relative velocity"
            )
        return (
            f"a mass that sticks leaves the table at a phase in {between(self.arc.phase, 12)},"
            f"{impacts} {end}: it never sticks again, and no periodic motion sticks."
        )

    @property
    def brief(self) -> str:
        period = len(self.end.cells) if isinstance(self.end, StableOrbit) else 0
        end = f"a stable orbit of period {period}" if period else "motions without an impact"
        return f"a mass that sticks comes to {end}, and never sticks again"


def _require_inside(at: Place, impacts: Sequence[Range], *targets: Range) -> None:
    """Require that each impact is inside one of these sets."""
    f = PlasticMap(at)
    if not all(any(inside(f, impact, each) for each in targets) for impact in impacts):
        raise Unproved("the last impact is not proved to be where the motion goes on from")


def _steepest(arc: Separation) -> Fraction:
    """Bound |f'| for launches from phi_s to arc.phase[1].

    By `slope` |f'| <= A / (eta |gap'|), and A = 0 at phi_s, |A'| <= |nu (1 - eta^2)|.
    """
    (low, high), width = arc.at.eta, arc.phase[1] - arc.phase[0]
    if arc.speed[0] <= 0:
        raise Unproved("the first impact is not proved to be transversal")
    rise = max(map(abs, arc.at.nu)) * max(abs(1 - low**2), abs(1 - high**2))
    return rise * width / (low * arc.speed[0])

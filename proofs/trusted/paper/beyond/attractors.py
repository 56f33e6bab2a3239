"""At any parameters: rest, chaos, motions that stick, stable orbits that do not. X1 to X4."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.coverings import EntropyBound
from proofs.trusted.kernel.loops import MOST_CELLS, StableOrbit
from proofs.trusted.kernel.staying import StayingSet, read_part
from proofs.trusted.numbers import between
from proofs.trusted.paper.beyond.returning import (
    ReturningMotion,
    StickingMotion,
    SticksOnce,
)
from proofs.trusted.paper.s34_circle.landing import Lands, NeverImpacts, Separation
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_HALF_TURN = 3  # less than pi


# -- X1: the mass that never leaves ----------------------------------------------------------------


def _has_an_arc(at: Place) -> bool:
    """Whether |nu| |1 - eta^2| > eta^2, for all oscillators or for none: A takes both signs.

    A = nu (1 - eta^2) sin(phi) - eta^2 is the relative acceleration of a free mass at the table, in
    units of the sign of nu: the mass sticks where sign(nu) A < 0 (`sticking`, in section 2). Where
    A = 0 = cos(phi) the gap begins with its fourth derivative, -sign(nu) eta^2.
    """
    ratios = [abs(1 - eta**2) / eta**2 for eta in at.eta]  # 0 at 1, monotone beside
    sizes = [abs(nu) for nu in at.nu]
    least = Fraction(0) if at.eta[0] < 1 < at.eta[1] else min(ratios)
    if least * min(sizes) > 1:
        return True
    if max(ratios) * max(sizes) > 1:
        raise Unproved("the mass sticks somewhere, or leaves somewhere, at some of the oscillators")
    return False


@dataclass(frozen=True)
class AtRest(Conclusion):
    """Theorem. Let nu > 0 and nu |1 - eta^2| <= eta^2. Then what the sentence says.

    Proof. A <= 0 at every phase; where it is 0, the mass stays: `_has_an_arc`.
    """

    at: Place

    def __post_init__(self) -> None:
        if self.at.nu[0] < 0 or _has_an_arc(self.at):
            raise Unproved("the mass leaves the table at some phase")

    @property
    def sentence(self) -> str:
        return (
            "nothing lifts the mass off the table at any phase: after its first plastic impact it "
            "stays on the table for ever, and f is defined at no phase."
        )


@dataclass(frozen=True)
class Leaves(Conclusion):
    """Theorem. If nu < 0 or |nu| |1 - eta^2| > eta^2, then what the sentence says.

    Proof. sign(nu) A is eta^2 > 0 at the phase 0 if nu < 0. If nu > 0 it is nu |1 - eta^2| - eta^2
    > 0 at the phase pi/2 or 3 pi/2. Each phase comes within one turn.
    """

    at: Place

    def __post_init__(self) -> None:
        if self.at.nu[0] > 0 and not _has_an_arc(self.at):
            raise Unproved("the mass may rest on the table for ever")

    @property
    def sentence(self) -> str:
        return (
            "a mass that rests on the table, as after a plastic impact, leaves it within one turn "
            "at the latest."
        )


@dataclass(frozen=True)
class NeverSticks(Conclusion):
    """Theorem. Let nu < 0 and |nu| |1 - eta^2| <= eta^2. Then what the sentence says.

    Proof. -A >= 0 at every phase; where it is 0, the mass leaves: `_has_an_arc`.
    """

    at: Place

    def __post_init__(self) -> None:
        if self.at.nu[0] > 0 or _has_an_arc(self.at):
            raise Unproved("the mass sticks at some phase")

    @property
    def sentence(self) -> str:
        return "the mass leaves the table at once after every plastic impact: it never sticks."


@dataclass(frozen=True)
class OnlyTouches(Conclusion):
    """Theorem. Let eta = 1 and nu < 0. Then what the sentence says.

    Proof. (10) is cos t - 1 at eta = 1, as sin(phi + t) = sin(phi) cos t + cos(phi) sin t: as long
    as there is no impact the gap is 1 - cos t, whatever the phase of the launch. It is > 0 for 0 <
    t < 2 pi, and 0 with its derivative at 2 pi, where mass and table are as they were.
    """

    at: Place

    def __post_init__(self) -> None:
        if not self.at.eta[0] == 1 == self.at.eta[1] or self.at.nu[1] >= 0:
            raise Unproved("eta = 1 and nu < 0 are expected")

    @property
    def sentence(self) -> str:
        return (
            "after a plastic impact at any phase the mass leaves the table at once, and touches it "
            "after each turn, without relative velocity: there is no other impact, and f is "
            "defined at no phase, or is the identity if a touch counts as one."
        )


def first_proved(at: Place, *kinds: Callable[[Place], Conclusion]) -> Conclusion | None:
    """Return the first of these conclusions about an oscillator that holds."""
    for kind in kinds:
        with suppress(Unproved):
            return kind(at)
    return None


def _rests(of: Parameters, found: Found) -> Decision:
    del found
    rests = first_proved(of.place, AtRest)
    if rests is not None:
        return decided(Verdict.VERIFIED, rests)
    return decided(Verdict.REFUTED, Leaves(of.place))


# -- where no motion is chaotic --------------------------------------------------------------------


@dataclass(frozen=True)
class AllStick(Conclusion):
    """Theorem. Let eta <= 3/7, and let the flight after the separation end in the sticking arc
    within one turn. Then what the sentence says.

    Proof. Let the arc be (a, s), s = phi_s, A the launch acceleration, < 0 on the arc and > 0 from
    s to a + 2 pi. By `lands` gap is the integral of sin(eta (t - u)) / eta A(phi + u), 0 < u < t,
    eta t < pi here. 1. The flight from s has its first impact on the arc, where A < 0: from there,
    with the gap falling from 0, the same formula gives gap < 0 until phase s + 2 pi. 2. That at
    phase s + 2 pi decreases in the launch phase, where A > 0: it is < 0 after all launches
    between s and a + 2 pi, and there is no impact before phase a + 2 pi. So the first impact is on
    the arc. 3. What sticks leaves at s: f maps all phases to the arc, and that to one phase.
    """

    arc: Separation

    def __post_init__(self) -> None:
        if not self.arc.returns or self.arc.turns != 1 or 7 * self.at.eta[1] > _HALF_TURN:
            raise Unproved("the flight from the separation is not proved to end soon on the arc")

    at = About("arc")

    @property
    def sentence(self) -> str:
        return (
            "every mass that does not stick after an impact sticks after its next one, and one "
            "that sticks leaves the table at a phase in "
            f"{between(self.arc.phase)} and has its next impact where it sticks, at a phase in "
            f"{between(self.arc.arrival)}: one periodic motion attracts all, exactly from the "
            "second impact on, f(f(phi)) is constant, and f has no horseshoe."
        )


def all_stick(found: Found) -> AllStick | None:
    """Return it of a claim's oscillator, if where the mass separates proves it."""
    for arc in found.all(Separation):
        with suppress(Unproved):
            return AllStick(arc)
    return found.first(AllStick)


def prove_sticking_motion(
    context: Context, reader: Reader
) -> AtRest | AllStick | StickingMotion | ReturningMotion | SticksOnce:
    """Rule `sticking-motion`: {separation, cells: [{slopes, domain}], beyond, landing}.

    separation, landing: names of steps, or null; slopes: a step of that rule; domain: two of its
    points; beyond: null, or as a cell. Conclusion: `AtRest` without all of them; `AllStick` for a
    separation alone, where that holds; `SticksOnce` where landing is a `stable-orbit` or a
    `never-impacts` step; `ReturningMotion` where there is a beyond; else `StickingMotion`.
    """
    separation_of, cells_of, beyond_of, landing_of = reader.fields(
        "separation", "cells", "beyond", "landing"
    )
    parts = tuple(read_part(context, cell) for cell in cells_of.items(0, MOST_CELLS))
    is_plain = not parts and beyond_of.is_null() and landing_of.is_null()
    if is_plain and separation_of.is_null():
        return AtRest(context.place)
    arc = context.step(separation_of, Separation)
    if is_plain:
        with suppress(Unproved):
            return AllStick(arc)
    beyond = None if beyond_of.is_null() else read_part(context, beyond_of)
    landing = None if landing_of.is_null() else context.step(landing_of, Conclusion)
    if isinstance(landing, StableOrbit | NeverImpacts) and beyond is None:
        return SticksOnce(arc, parts, landing)
    if not isinstance(landing, Lands | None):
        raise landing_of.fail("names no step about where the last impact is")
    if beyond is None:
        return StickingMotion(arc, parts, landing)
    return ReturningMotion(arc, parts, beyond, landing)


# -- X2: chaos -------------------------------------------------------------------------------------


def _chaotic(of: Parameters, found: Found) -> Decision:
    for shift in found.all(StayingSet):
        if not shift.orbit:
            known = {"growth": shift.growth, "entropy_on_the_set": shift.entropy}
            return decided(Verdict.VERIFIED, shift, known=known)
    for graph in found.all(EntropyBound):
        if graph.growth > 1:
            return decided(Verdict.VERIFIED, graph)
    none = first_proved(of.place, AtRest, OnlyTouches) or all_stick(found)
    return undecided("no horseshoe is proved") if none is None else decided(Verdict.REFUTED, none)


# -- X3: motions that stick ------------------------------------------------------------------------


def _sticks(of: Parameters, found: Found) -> Decision:
    motion = found.first(StickingMotion) or found.first(AllStick)
    if motion is not None:
        return decided(Verdict.VERIFIED, motion)
    none = first_proved(of.place, AtRest, NeverSticks) or found.first(SticksOnce)
    return undecided("none is proved") if none is None else decided(Verdict.REFUTED, none)


# -- X4: stable orbits -----------------------------------------------------------------------------


def _stable(of: Parameters, found: Found) -> Decision:
    orbits = found.all(StableOrbit)
    if orbits:
        return decided(Verdict.VERIFIED, *orbits)
    none = first_proved(of.place, AtRest, OnlyTouches) or all_stick(found)
    return undecided("none is proved") if none is None else decided(Verdict.REFUTED, none)


_AT = "At (eta, nu) = ({eta}, {nu}), for plastic impacts: "
ROWS = (
    Row("X1", "beyond", "", _AT + "the mass comes to rest on the table for ever.", _rests),
    Row(
        "X2",
        "beyond",
        "",
        _AT + "f has a compact invariant set on which it is continuous and its topological entropy "
        "is positive.",
        _chaotic,
    ),
    Row(
        "X3",
        "beyond",
        "",
        _AT + "there is a stable periodic motion on which the mass sticks and leaves again.",
        _sticks,
    ),
    Row(
        "X4",
        "beyond",
        "",
        _AT + "f has a stable periodic orbit of transversal impacts, at which the mass leaves at "
        "once.",
        _stable,
    ),
)

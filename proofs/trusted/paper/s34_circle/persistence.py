"""Section 3.4 with restitution: does the stable orbit persist, and do transients grow?

Trusted, and shared: what the rules of `s34_circle.persistence_rules` conclude, and what follows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Range, ceil_text, floor_text, show, show_range, within
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.s33_restitution.rebounds import Rebound, restitution, size
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Verdict


@dataclass(frozen=True)
class SeparationFlight(Conclusion):
    """The flight that starts at the separation phase with relative velocity 0.

    It has its first impact after a time in `flight`, at the phase phi_s + time - 2 pi `turns`,
    which lies in `impact`, the one between phi_s - 2 pi and phi_s, with a
    relative speed in `speed`. phi_s is in `separation`; from separation[0] up to it the
    launch acceleration is negative, there it vanishes and increases.
    """

    separation: Range
    flight: Range
    turns: int
    impact: Range
    speed: Range


@dataclass(frozen=True)
class Chatter(Conclusion):
    """For every epsilon in `epsilon`: impacts near that of `after` end in rest before phi_s.

    Near means: at a phase within `spread` of after.impact, with a relative speed before the
    impact within `spread` of after.speed, which is then > 0. All later impacts come at phases
    up to `rest` < phi_s (not reduced); for epsilon > 0 there are infinitely many.
    """

    after: SeparationFlight
    epsilon: Range
    spread: Fraction
    rest: Fraction


@dataclass(frozen=True)
class StablePair:
    """At an exact epsilon F maps `first` into `second` and back, two boxes of states apart.

    Each is phases x velocities. F^2 contracts `first`: it has one fixed point there, a 2-periodic
    orbit of F, which attracts all motions with an impact in `first`.
    """

    epsilon: Fraction
    first: tuple[Range, Range]
    second: tuple[Range, Range]


def stable_pair(of: Parameters, found: Sequence[object]) -> StablePair | None:
    """Return what four `Rebound` conclusions prove, None if they do not prove a `StablePair`.

    They are about F on a box B1, at its centre c1, on B2, at c2. Hypotheses: F(c1) + DF(B1)
    (B1 - c1) lies in B2, the same with 1 and 2 exchanged; the phases of B1 and B2 are disjoint;
    with r the sides of B1 and |D| the largest absolute values of entries,
    |DF(B2)| |DF(B1)| r < r. Proof: by the mean value theorem F(B1) lies in B2 and F(B2) in B1,
    and F^2 contracts the convex B1 in the norm max |x_i| / r_i. Banach's theorem.
    """
    steps = [step for step in found if isinstance(step, Rebound)]
    if len(steps) != 4:
        return None
    first, at_first, second, at_second = steps
    epsilon = restitution(first.at)[0]
    at = Place((of.eta, of.eta), (of.nu, of.nu), (epsilon, epsilon))
    if any(step.at != at for step in steps):
        return None
    apart = first.phases[1] < second.phases[0] or second.phases[1] < first.phases[0]
    there, back = _maps_into(first, at_first, second), _maps_into(second, at_second, first)
    if not (apart and there and back):
        return None
    sides = [high - low for low, high in (first.phases, first.velocities)]
    moved = _moved(second, _moved(first, sides))
    if not all(after < before for after, before in zip(moved, sides, strict=True)):
        return None
    return StablePair(epsilon, (first.phases, first.velocities), (second.phases, second.velocities))


def _moved(step: Rebound, sides: Sequence[Fraction]) -> list[Fraction]:
    """Return |DF| times a vector with entries >= 0."""
    return [
        sum((size(entry) * side for entry, side in zip(row, sides, strict=True)), Fraction(0))
        for row in step.derivative
    ]


def _maps_into(on: Rebound, at: Rebound, target: Rebound) -> bool:
    """Whether F maps the box of `on` into that of `target`, by its value `at` a point of it."""
    if on.turns != at.turns or not (
        within(at.phases, on.phases) and within(at.velocities, on.velocities)
    ):
        return False
    reach = [
        max(outer[1] - inner[0], inner[1] - outer[0])
        for outer, inner in ((on.phases, at.phases), (on.velocities, at.velocities))
    ]
    images = zip((at.phase, at.velocity), _moved(on, reach), strict=True)
    phase, velocity = ((low - more, high + more) for (low, high), more in images)
    return within(phase, target.phases) and within(velocity, target.velocities)


def _decide_orbit(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide G7: a motion of the theorem has infinitely many impacts a period, not two.

    F maps an impact to the next one. Under F the impacts of a chattering motion have increasing
    phases that stay below phi_s and converge, with speeds that converge to 0. So they are
    pairwise different, and converge to one limit, a state of rest on the table, not to two points
    that F exchanges. The states near the first impact form an open set, so that no 2-periodic
    orbit of F attracts them.
    """
    proved = [step for step in found if isinstance(step, Chatter)]
    if not proved:
        return undecided("no proof that the motion from phi_s comes to rest")
    best = max(proved, key=lambda step: step.epsilon[1])
    if of.epsilon is None or best.epsilon[0] != 0 or not 0 < of.epsilon <= best.epsilon[1]:
        return Decision(
            Verdict.UNDECIDED,
            f"proved for epsilon in [{show(best.epsilon[0])}, {show(best.epsilon[1])}] only",
        )
    after = best.after
    return Decision(
        Verdict.REFUTED,
        f"for 0 < epsilon <= {show(best.epsilon[1])} the stable motion has infinitely many "
        f"impacts in each period, of {_turns(after)} of the table",
        witness=_witness(of.epsilon, best),
        corrected=_theorem(of, best) + _coexistence(best, stable_pair(of, found)),
        quantities={
            "epsilon_max": (best.epsilon[1], best.epsilon[1]),
            "separation_phase": after.separation,
            "impact_phase": after.impact,
            "impact_speed": after.speed,
            "flight": after.flight,
        },
    )


def _bounds(values: Range, places: int = 12) -> str:
    """Write an enclosure, rounded outward."""
    return f"[{floor_text(values[0], places)}, {ceil_text(values[1], places)}]"


def _turns(after: SeparationFlight) -> str:
    return "1 turn" if after.turns == 1 else f"{after.turns} turns"


def _witness(epsilon: Fraction, proved: Chatter) -> str:
    after = proved.after
    return (
        f"epsilon = {show(epsilon)}: every impact at a phase within {show(proved.spread)} of "
        f"{_bounds(after.impact)} with a relative speed within {show(proved.spread)} of "
        f"{_bounds(after.speed)} is followed by infinitely many impacts, at phases up "
        f"to {ceil_text(proved.rest)} that increase to a limit below phi_s, and with speeds that "
        "tend to 0; so this open set of states is not attracted by a 2-periodic orbit of F"
    )


def _theorem(of: Parameters, proved: Chatter) -> str:
    """State what follows from the conclusion; epsilon = 0 is the plastic orbit."""
    after, top = proved.after, show(proved.epsilon[1])
    spread = show(proved.spread)
    return (
        f"Let (eta, nu) = ({show(of.eta)}, {show(of.nu)}), 0 <= epsilon <= {top}, and phi_s in "
        f"{_bounds(after.separation)} the separation phase. The mass that leaves the table at "
        f"phi_s with relative velocity 0 flies for a time in {_bounds(after.flight)}, and lands "
        f"at a phase phi_1 in {_bounds(after.impact)} with a relative speed u in "
        f"{_bounds(after.speed)}. All further impacts of this passage come at phases "
        f"below phi_s and up to {ceil_text(proved.rest)}: none if epsilon = 0, infinitely many, at "
        "phases that increase to a limit below phi_s, if epsilon > 0. Then the mass rests on the "
        "table until phi_s and leaves it as before. So it moves periodically, with period 2 pi * "
        f"{after.turns}, {_turns(after)} of the table; phi_s, phi_1 and u do not depend on "
        "epsilon. "
        f"Every motion with an impact at a phase within {spread} of phi_1 and a relative speed "
        f"within {spread} of u comes to rest before phi_s too, and from phi_s on it is this "
        "periodic motion, exactly: the return map is constant near the orbit, which is "
        "superstable. For epsilon > 0 it is not a 2-periodic orbit of the impact map F."
    )


def _coexistence(proved: Chatter, pair: StablePair | None) -> str:
    """State that the periodic motion does not attract everything, where that is proved."""
    if pair is None or not 0 < pair.epsilon <= proved.epsilon[1]:
        return ""
    first, second = (
        f"{show_range(phases)} x {show_range(velocities)}"
        for phases, velocities in (pair.first, pair.second)
    )
    return (
        f" It does not attract everything: at epsilon = {show(pair.epsilon)}, F has a 2-periodic "
        f"orbit too, one impact in {first} (phases x velocities gamma), the other in {second}; F^2 "
        "contracts the first box, so that this orbit attracts every motion with an impact there."
    )


def _decide_transients(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide G8: an observation about simulated initial conditions; no step proves anything."""
    del of, found
    return Decision(
        Verdict.SIMULATED,
        "an observation about simulated motions, nothing to prove: proofs.motion.simulate "
        "tabulates the time until rest against epsilon",
    )


CLAIMS = (
    Claim(
        "G7",
        "At (eta, nu) = ({eta}, {nu}), for other coefficients of restitution too (epsilon = "
        "{epsilon} among them): the map F from one impact to the next has a stable 2-periodic "
        "orbit, and it attracts the initial conditions.",
        _decide_orbit,
    ),
    Claim(
        "G8",
        "At (eta, nu) = ({eta}, {nu}): trajectories take the longer to reach the stable orbit the "
        "larger the coefficient of restitution is.",
        _decide_transients,
    ),
)

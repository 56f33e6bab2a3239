"""Motions that touch the table for ever, with restitution (section 3.4). Row G14, our own."""

from __future__ import annotations

from dataclasses import dataclass

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import Phases, show_range
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class TouchingFamily(Conclusion):
    """For every 0 < epsilon < 1 motions that touch the table attract an open set of states."""

    at: Place
    phases: Phases

    @property
    def sentence(self) -> str:
        turns = self.at.eta[0].denominator
        return (
            f"for every 0 < epsilon < 1 and every phase x of [a, b] = {show_range(self.phases)} the"
            " motion that leaves the table there without relative velocity touches it again, "
            f"without relative velocity, after {turns} turns, at x, and so on for ever: each of "
            f"these motions has the period {2 * turns} pi. For every a < x < b all states before "
            "an impact near x and near this velocity, the closing speed c = -gap' being > 0, "
            f"impact once in about {turns} turns, the n-th time with a speed c_n, c_(n+1)/c_n -> "
            "epsilon, at phases that decrease to a limit in (a, b): the motion tends to one that "
            "touches the table. So an open set of states is attracted to this family; none of its "
            "members is asymptotically stable."
        )

    @property
    def brief(self) -> str:
        return (
            f"motions that touch the table at phases of {show_range(self.phases)} attract an open "
            "set of states for every 0 < epsilon < 1"
        )


def touching_family(never: NeverImpacts) -> TouchingFamily:
    """Theorem. If all plastic flights from [a, b] have gap > 0 up to the time T = 2 pi q, where eta
    = p/q, as in `NeverImpacts`, then `TouchingFamily`.

    Proof. Let g(x, t) be the plastic gap, A(x) = g_tt(x, 0), which is > 0 on [a, b] by
    `closest_approach`, (2), and k = epsilon c the relative speed after an impact: the gap is G = g
    + (k/eta) sin(eta t), of period T in t. 1. For some s > 0 and k_0 > 0, all x in [a, b] and 0 < k
    <= k_0: G_tt > 0 for |t| <= s, and G > 0 on [s, T - s], where g is bounded from below. As G = 0
    and G_t = k at t = 0, G is > 0 on (0, s], and, convex, has one zero in (-s, 0), falling through
    it: at t = -2 k/A + O(k^2), with G_t = -k + O(k^2). So the first impact is at T - 2 k/A + O(k^2)
    with the closing speed k + O(k^2), uniformly in x. 2. Let r = (1 + epsilon)/2 < 1. For small k
    the next k is at most r k, and the phase goes down by at most 3 k/A: in all by at most 3 k/((1 -
    r) min A), which is less than x - a if k is small. So this goes on for ever, k -> 0, the phases
    converge in (a, b), and c_(n+1)/c_n -> epsilon. The states are an open set. 3. With k = 0 the
    gap g is > 0 up to T, and touches there, g = g_t = 0. So another member of the family stays as
    near to one as it was.
    """
    return TouchingFamily(never.at, never.phases)


def _touching(of: Parameters, found: Found) -> Decision:
    """G14: by an interval of phases that never impact again."""
    del of
    never = found.first(NeverImpacts)
    if never is None:
        return undecided("no phases are proved after which there is no impact")
    family = touching_family(never)
    return decided(Verdict.VERIFIED, family, corrected=[family, never])


ROWS = (
    Row(
        "G14",
        "3.4, for epsilon > 0",
        "",
        "At (eta, nu) = ({eta}, {nu}), for every 0 < epsilon < 1: an open set of states, phases "
        "and velocities, is attracted to motions that touch the table for ever, without relative "
        "velocity.",
        _touching,
    ),
)

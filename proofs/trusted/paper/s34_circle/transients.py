"""How long it takes until the mass sticks, near the invariant sets (section 3.4, Figure 6)."""

from __future__ import annotations

from dataclasses import dataclass

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Phases, floor_text, show, show_range, within
from proofs.trusted.paper.s34_circle.absorption import Absorption
from proofs.trusted.paper.s34_circle.landing import Separation


@dataclass(frozen=True)
class LongTransients(Conclusion):
    """Near every phase of a full shift transients are as long as one likes, and end.

    inside: phases in the shift's interval that all come to the sticking arc, within `steps`.
    """

    shift: StayingSet
    arc: Separation
    inside: Phases
    steps: int

    def __post_init__(self) -> None:
        if not self.shift.whole or not within(self.inside, self.shift.interval):
            raise Unproved("no full shift on an interval, or phases outside of it")
        if self.shift.at != self.arc.at:
            raise Unproved("phases and shift are about different oscillators")
        if self.shift.interval[1] >= self.arc.start[0]:
            raise Unproved("the interval of the shift is not proved to be before the sticking arc")

    at = About("shift")

    @property
    def sentence(self) -> str:
        interval, slope = self.shift.interval, floor_text(self.shift.expansion, 2)
        length = show(interval[1] - interval[0])
        return (
            f"let K be the set of phases whose orbits stay in {show_range(interval)}: every "
            "invariant set of f in there is part of it. For every phase x of K and every n >= 1 "
            f"there is an interval of phases, no further than {length}/{slope}^(n-1) from x, from "
            f"all of which it takes more than n and at most n + {self.steps} impacts to come to "
            "the arc where the mass sticks."
        )

    @property
    def brief(self) -> str:
        interval = show_range(self.shift.interval)
        return f"transients of every length near each phase whose orbit stays in {interval}"


def long_transients(shift: StayingSet, known: Absorption) -> LongTransients:
    """Theorem. If phases in the interval of a full shift come to the arc, and the interval does not
    meet the arc, then `LongTransients`.

    Proof. 1. The orbit of a point of an invariant set in the interval stays there. 2. The phases
    that follow the first n symbols of x are an interval J around x, at most |cell| / mu^(n-1) long,
    mu = min |f'| > 1, and f^n maps J over the interval of the shift, as f maps each cell over it.
    So an interval in J is mapped onto `inside` by f^n; its first n images lie in the interval of
    the shift, where the mass does not stick. All that is there then is absorbed within `steps`.
    """
    low, high = shift.interval
    parts = [((max(low, a), min(high, b)), n) for (a, b), n in known.within if a < high and low < b]
    if not parts:
        raise Unproved("no phases in the interval of the shift are proved to stick")
    inside, steps = max(parts, key=lambda part: part[0][1] - part[0][0])
    return LongTransients(shift, known.arc, Phases(*inside), steps)

"""Rule: the root of Moran's equation, the dimension of a set that is made of smaller copies."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.elementary import exp, log
from proofs.trusted.numbers import Range, between, bits_for, ceil_text, floor_text, show

_MOST = 100  # ratios


@dataclass(frozen=True)
class MoranRoot(Conclusion):
    """The one root s > 0 of the sum of ratios[i]^s = 1 lies in `root`."""

    ratios: tuple[Fraction, ...]
    root: Range

    @property
    def sentence(self) -> str:
        powers = " + ".join(f"({show(ratio)})^s" for ratio in self.ratios)
        return f"the equation {powers} = 1 has exactly one root s > 0, in {between(self.root, 12)}."

    @property
    def brief(self) -> str:
        return f"{floor_text(self.root[0])} <= s_0 <= {ceil_text(self.root[1])}"


def moran_root(_: Context, reader: Reader) -> MoranRoot:
    """Rule `moran-root`: {ratios r_1, ..., r_n in (0, 1), root: [l, u]}, n > 1, 0 < l < u.

    Hypothesis: F(l) > 0 > F(u), F(s) = r_1^s + ... + r_n^s - 1. Conclusion: F has exactly one zero
    s > 0, and that is in [l, u]. Proof. F decreases from n - 1 to -1.
    """
    ratios_of, root_of = reader.fields("ratios", "root")
    ratios, root = ratios_of.numbers(2, _MOST), root_of.range()
    if not (0 < min(ratios) <= max(ratios) < 1 and root[0] > 0):
        raise Unproved("the ratios must lie in (0, 1) and the root's bracket be positive")
    bits = bits_for(root)
    logs = [log(ratio, bits) for ratio in ratios]
    low, high = (sum((exp(each * s) for each in logs[1:]), exp(logs[0] * s)) - 1 for s in root)
    if low.lo <= 0 or high.hi >= 0:
        raise Unproved("the bracket of the root does not have the signs +, -")
    return MoranRoot(ratios, root)

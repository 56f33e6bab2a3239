"""Section 3.2: Moran's equation, and the digits printed for its root. Claim H11."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.numbers import Range, between, show
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class NoGap(Conclusion):
    """Two positive ratios leave no linear Cantor set, or Moran's equation no root."""

    ratios: Range

    def __post_init__(self) -> None:
        """Raise Unproved where there is a gap."""
        if min(self.ratios) <= 0 or sum(self.ratios) < 1:
            raise Unproved("the ratios sum to less than 1")

    @property
    def sentence(self) -> str:
        first, second = map(show, self.ratios)
        if max(self.ratios) >= 1:
            return f"({first})^s + ({second})^s > 1 for every s > 0: there is no s_0."
        return f"eta0 + eta1 >= 1 for {first} and {second}: s_0 >= 1, and q does not decrease."


@dataclass(frozen=True)
class Digits(Conclusion):
    """A number in `value` against printed digits; a fraction p/q stands for itself alone.

    Rounded they stand for the numbers within half a unit of the last place, truncated for those
    from the printed one on, up to a unit more. Decided where all of `value` is inside or outside.
    """

    name: str
    value: Range
    printed: str

    @property
    def readings(self) -> tuple[bool | None, ...]:
        """Whether these are the digits of the number, rounded and truncated; None: not decided.

        Each end of `value` is below the numbers that are meant (-1), above them (1) or one of them.
        """
        printed = Fraction(self.printed)
        unit = Fraction("/" not in self.printed, 10 ** len(self.printed.partition(".")[2]))
        rounded = [(x >= printed + unit / 2) - (x <= printed - unit / 2) for x in self.value]
        truncated = [(x >= printed + unit) - (x < printed) for x in self.value] if unit else rounded
        return tuple(low == 0 if low == high else None for low, high in (rounded, truncated))

    @property
    def rounded(self) -> bool | None:
        """The first of these readings."""
        return self.readings[0]

    @property
    def sentence(self) -> str:
        words = {True: "is", False: "is not", None: "may be"}
        rounded, truncated = (words[reading] for reading in self.readings)
        return (
            f"{self.name}, in {between(self.value)}, {rounded} {self.printed} if rounded, and "
            f"{truncated} if truncated."
        )


def _moran_root(of: Parameters, found: Found) -> Decision:
    """H11: dots after digits may mean that these are rounded, or that more digits follow: where
    these readings differ, the one under which the digits are the root's is a condition.
    """
    ratios = of.moran_ratios
    if max(ratios) >= 1:
        return decided(Verdict.REFUTED, NoGap(ratios))
    for slope, ratio in zip(of.slopes[::-1], ratios, strict=True):
        digits = Digits(f"1/{show(slope)}", (1 / slope, 1 / slope), show(ratio))
        if not digits.rounded:
            return decided(Verdict.REFUTED, digits)
    roots = {each.ratios: each for each in found.all(MoranRoot)}
    if ratios not in roots or of.reciprocals not in roots:
        return undecided("no bracket of s_0")
    given, exact = roots[ratios], roots[of.reciprocals]
    known = {"s0": given.root, "s0_reciprocal_slopes": exact.root}
    printed = of.printed_s0
    read = [
        Digits(f"s_0 for the ratios {' and '.join(map(show, each.ratios))}", each.root, printed)
        for each in (given, exact)
        if printed
    ]
    readings = {each.readings for each in read}
    holds = {reading for pair in readings for reading in pair}
    if len(readings) > 1 or None in holds:
        return undecided("; ".join(each.brief for each in read), known)
    if False not in holds:
        return decided(Verdict.VERIFIED, given, *read, known=known)
    verdict = Verdict.CONDITIONAL if True in holds else Verdict.REFUTED
    return decided(verdict, *read, corrected=[given], known=known)


ROWS = (
    Row(
        "H11",
        "3.2",
        "s_o evaluates to 0.449...",
        "{r0}^s + {r1}^s = 1 has exactly one root s_0 > 0{s0}; the ratios are 1/{hi} and 1/{lo}, "
        "to the places given.",
        _moran_root,
    ),
)

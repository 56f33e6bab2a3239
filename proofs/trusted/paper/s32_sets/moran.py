"""Section 3.2: Moran's equation, and the digits printed for its root. Claim H11."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from proofs.trusted.certificate import Reader
from proofs.trusted.flights import bits_for
from proofs.trusted.kernel.arithmetic import Unproved, exp, log, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.numbers import Range, ceil_text, floor_text, show
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided


@dataclass(frozen=True)
class MoranRoot(Conclusion):
    """The one root s > 0 of ratios[0]^s + ratios[1]^s = 1 lies in `root`."""

    ratios: Range
    root: Range

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return (
            f"the equation ({show(self.ratios[0])})^s + ({show(self.ratios[1])})^s = 1 has exactly "
            f"one root s > 0, and {floor_text(self.root[0], 12)} <= s <= "
            f"{ceil_text(self.root[1], 12)}."
        )

    @property
    def brief(self) -> str:
        """Return the bounds."""
        return f"{floor_text(self.root[0])} <= s_0 <= {ceil_text(self.root[1])}"

    @property
    def latex(self) -> str:
        """Return the equation and the bounds."""
        first, second = map(show, self.ratios)
        low, high = floor_text(self.root[0], 9), ceil_text(self.root[1], 9)
        return rf"{first}^s + {second}^s = 1,\ s \in [{low}, {high}]"


def moran_root(context: Context, reader: Reader) -> MoranRoot:
    """Rule `moran-root`: {ratios in (0, 1), root: [l, u]}, 0 < l < u.

    F(s) = r0^s + r1^s - 1 decreases from 1 to -1, so F(l) > 0 > F(u) brackets its one root.
    """
    ratios_of, root_of = reader.fields("ratios", "root")
    ratios, root = ratios_of.numbers(2, 2), root_of.range()
    if not all(0 < ratio < 1 for ratio in ratios) or root[0] <= 0:
        raise Unproved("the ratios must lie in (0, 1) and the root's bracket be positive")
    bits = bits_for(root)
    logs = [log(ratio, bits) for ratio in ratios]
    low, high = (
        exp(rational(s, bits) * logs[0]) + exp(rational(s, bits) * logs[1]) - 1 for s in root
    )
    if low.lo <= 0 or high.hi >= 0:
        raise Unproved("the bracket of the root does not have the signs +, -")
    return MoranRoot((ratios[0], ratios[1]), root)


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
        """Return the statement."""
        first, second = map(show, self.ratios)
        if max(self.ratios) >= 1:
            return f"({first})^s + ({second})^s > 1 for every s > 0: there is no s_0."
        return f"eta0 + eta1 >= 1 for {first} and {second}: s_0 >= 1, and q does not decrease."


# -- the row ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Unlike(Conclusion):
    """1 / slope does not round to the ratio that is given."""

    slope: Fraction
    given: Fraction

    def __post_init__(self) -> None:
        """Raise Unproved where it does."""
        if is_printed(1 / self.slope, self.given):
            raise Unproved("the ratio is 1 / slope, rounded")

    @property
    def sentence(self) -> str:
        """Return the statement."""
        return f"1/{show(self.slope)} does not round to {show(self.given)}."


@dataclass(frozen=True)
class Digits(Conclusion):
    """Printed digits against the roots for given and for exact ratios."""

    printed: str
    given: MoranRoot
    exact: MoranRoot

    @property
    def readings(self) -> list[tuple[bool | None, bool | None]]:
        """Whether they are the digits of each root, (rounded, truncated); None: not decided."""
        return [readings(each.root, self.printed) for each in (self.given, self.exact)]

    @property
    def verdict(self) -> Verdict:
        """Whether they are the digits of both roots, rounded; or of neither in any reading."""
        if all(rounded for rounded, _ in self.readings):
            return Verdict.VERIFIED
        none = all(reading == (False, False) for reading in self.readings)
        return Verdict.REFUTED if none else Verdict.UNDECIDED

    @property
    def sentence(self) -> str:
        """Return which readings of the digits hold."""
        truncated = {second for _, second in self.readings}
        cut = {(True,): ", also if truncated", (False,): ", not if truncated"}
        says = {
            Verdict.VERIFIED: f"{self.printed} if rounded{cut.get(tuple(truncated), '')}",
            Verdict.REFUTED: f"not {self.printed} in any reading",
        }.get(self.verdict, f"the readings of {self.printed} differ between the ratios")
        return f"{self.given.brief}: {says}."

    @property
    def brief(self) -> str:
        """Return the statement."""
        return self.sentence.rstrip(".")


def _last_place(printed: str) -> Fraction:
    """Return the unit of the last place of a decimal; 0 for a fraction, which is exact."""
    return Fraction("/" not in printed, 10 ** len(printed.partition(".")[2]))


def is_printed(value: Fraction, given: Fraction) -> bool:
    """Whether a number is the given one, or rounds to its digits."""
    return value == given or 2 * abs(value - given) < _last_place(show(given))


def readings(root: Range, printed: str) -> tuple[bool | None, bool | None]:
    """Return whether the printed digits are the root's, (rounded, truncated); None: undecided.

    Rounded they stand for the numbers within half a unit of the last place, truncated for those
    from the printed one on, up to a unit more: decided where the bracket is inside or outside.
    """
    (low, high), value, unit = root, Fraction(printed), _last_place(printed)
    nearest: bool | None = (value - unit / 2 < low and high < value + unit / 2) or None
    if high <= value - unit / 2 or low >= value + unit / 2:
        nearest = False
    first: bool | None = (value <= low and high < value + unit) or None
    if high < value or low >= value + unit:
        first = False
    return nearest, first


def _moran_root(of: Parameters, found: Found) -> Decision:
    ratios = of.moran_ratios
    if max(ratios) >= 1:
        return decided(Verdict.REFUTED, NoGap(ratios))
    for slope, ratio in zip(of.slopes[::-1], ratios, strict=True):
        if not is_printed(1 / slope, ratio):
            return decided(Verdict.REFUTED, Unlike(slope, ratio))
    roots = {each.ratios: each for each in found.all(MoranRoot)}
    if ratios not in roots or of.reciprocals not in roots:
        return undecided("no bracket of s_0")
    given, exact = roots[ratios], roots[of.reciprocals]
    known = {"s0": given.root, "s0_reciprocal_slopes": exact.root}
    if of.printed_s0 is None:
        return decided(Verdict.VERIFIED, given, known=known)
    digits = Digits(of.printed_s0, given, exact)
    if digits.verdict is Verdict.UNDECIDED:
        return undecided(digits.brief, known=known)
    corrected = [given] if digits.verdict is Verdict.REFUTED else []
    return decided(digits.verdict, digits, corrected=corrected, known=known)


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

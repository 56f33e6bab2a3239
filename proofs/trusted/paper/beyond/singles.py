"""Stable motions with one impact in n table periods, for all oscillators of a box.

A single motion, here, has the period T = 2 pi n and one impact in it, a transversal one; for
plastic impacts the mass leaves the table at once (launch acceleration > 0). 0 <= epsilon < 1, q =
(1 - epsilon)/(1 + epsilon), x = pi n eta, s, c = sin x, cos x; side, sigma are the signs of nu and
nu s, S, C = sigma s side, sigma c (S = |s|); E = (q eta s)^2, K = c^2 + E, delta = nu^2 c^2 +
(nu^2 - 1) E.

Lemma 1 (solutions). A single motion has s != 0 and delta >= 0; the mass is at sigma v cos(eta t -
x), v = (C + sqrt(delta))/K or (C - sqrt(delta))/K, v > 0, and what the impact is like follows from
v: it is at the height h = v C, the velocity of the mass after it is W = side v eta S, that of the
table r = q W. Conversely, v, if it is > 0, gives a single motion if gap > 0 on (0, T), and if, for
epsilon = 0, launch acceleration = side (h (1 - eta^2) - 1) > 0.
Proof. The mass is at h cos(eta t) + (W/eta) sin(eta t). At T it is at h again: s (W c - eta h s) =
0, and its velocity is V = W - 2 s (W s + eta h c). If s = 0, V = W, and the impact, W - r =
-epsilon (V - r), needs V = r: it is not transversal. So W c = eta h s and V = -W, (1 - epsilon) W =
(1 + epsilon) r. Transversal and from above the table: side (V - r) < 0, side W > 0. Let W = side v
eta S; then h = v C. The table: r = nu cos(phi), h - 1 = nu sin(phi), nu^2 = E v^2 + (v C - 1)^2, a
quadratic equation for v; where it holds phi is determined.

Lemma 2 (multipliers). If delta > 0, the motion with the lesser v has a multiplier > 1; let v be the
greater one. Both multipliers are inside the unit circle if F = (c^2 - eta^2 (1 + q^2 c^2)) v - C is
< 0, one is below -1 if F > 0.
Proof. By `curves.curves` (MULTIPLIERS), for h != 0, they are the roots of z^2 - tr z + epsilon^2,
tr = 2 epsilon + (1 - epsilon)^2 c^2 - (1 + epsilon)^2 P/eta^2, P = c^2 nu sin(phi)/h = c^2 - C/v;
this is continuous, so true where h = c = 0 as well. Inside exactly if |tr| < 1 + epsilon^2 (Jury):
tr < 1 + epsilon^2 is P > -E, K v > C; -tr < 1 + epsilon^2 is P < eta^2 (1 + q^2 c^2), F < 0.

Lemma 3 (none). There is no single motion if C <= 0 and |nu| <= 1; if 0 < nu <= 1 and 2 n eta >= 1.
Proof. If |nu| <= 1, delta <= c^2. If 0 < nu <= 1, the mass is above a table that is above 0, for a
time T: at most half its period, and it is that for C = 0.

Lemma 4 (short flights). Let epsilon = 0, v > 0 and launch acceleration > 0, and n eta < 1/2, nu > 0
or 1/2 < n eta < 1, nu < 0. Then gap > 0 on (0, T), and the impact there is transversal.
Proof. Lemma 3 of `s4_single.orbits`, whose proof needs of |nu| < 1 that h > 0 alone: C > 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

from proofs.trusted.certificate import Reader
from proofs.trusted.equations import Launch, launch_acceleration
from proofs.trusted.kernel.arithmetic import Enclosure, Unproved, pi, rational
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.firstzero import FirstZero
from proofs.trusted.kernel.operations import sqrt
from proofs.trusted.numbers import COVER_BITS, Range, increasing
from proofs.trusted.oscillator import LEAVES, REBOUNDS, Flown
from proofs.trusted.paper.beyond.grazing import ratio
from proofs.trusted.parameters import Place

MOST_PERIODS = 100
_MOST_PARTS = 1000
_LATER = 6  # than T, at most, all flights are proved below the table
_BITS = COVER_BITS
Number = Any


class Numbers(NamedTuple):
    """Of an oscillator; q instead of epsilon."""

    eta: Number
    nu: Number
    q: Number


class Solution(NamedTuple):
    """v = above/below, and what has the sign of F where v > 0; nothing is said where delta < 0."""

    delta: Number
    above: Number
    below: Number
    flips: Number


def solution(
    of: Numbers, turn: tuple[Number, Number], leans: bool, root: Callable[[Number], Number]
) -> Solution:
    """Return the greater v for turn = (S, C), where C >= 0 (leans), or C <= 0.

    root: the square root of a number, or of 0 where that is < 0.
    """
    (eta, nu, q), (sine, cosine) = of, turn
    across, square, along, reach = q * eta * sine, nu * nu, cosine * cosine, q * cosine
    over = across * across
    delta = square * along + (square - 1) * over
    rest = root(delta)
    if leans:
        above, below = cosine + rest, along + over
    else:  # the product of both solutions is (1 - nu^2)/K
        above, below = square - 1, rest - cosine
    flips = (along - eta * eta * (reach * reach + 1)) * above - cosine * below
    return Solution(delta, above, below, flips)


@dataclass(frozen=True)
class Part:
    """Oscillators with k <= 2 n eta <= k + 1."""

    at: Place
    n: int
    k: int

    @property
    def side(self) -> int:
        """The sign of nu."""
        return self.at.side

    @property
    def leans(self) -> bool:
        """Whether C >= 0, else C <= 0."""
        return (self.side > 0) is (self.k % 2 == 0)

    def signed(self, sine: Number, cosine: Number) -> tuple[Number, Number]:
        """Return S and C from s and c."""
        sign = 1 if self.k % 4 < 2 else -1
        return sine * sign, cosine * (sign * self.side)

    @cached_property
    def _numbers(self) -> Numbers:
        sides = self.at.eta, self.at.nu, ratios(self.at)
        return Numbers(*(Enclosure.of(*side, _BITS) for side in sides))

    @cached_property
    def _turn(self) -> tuple[Enclosure, Enclosure]:
        return self.signed(*(pi(_BITS) * self.n * self._numbers.eta).sincos())

    @cached_property
    def solution(self) -> Solution:
        """Enclose the greater solution."""
        return solution(self._numbers, self._turn, self.leans, _root)

    @cached_property
    def start(self) -> Launch:
        """Enclose the state after its impact; Unproved where that is not defined all over."""
        return launched(self, self._numbers, self._turn, self.solution)

    @property
    def states(self) -> list[Enclosure]:
        """All that flights depend on, but for what `start` has from it."""
        return [self._numbers.eta]

    def on(self, roots: Sequence[int], t: Enclosure) -> list[Enclosure]:
        """Enclose functions of the flights at times, by their numbers."""
        flown = Flown(None, None, self.start)
        return [flown.function(root, t) for root in roots]

    @property
    def whole(self) -> Range:
        """Enclose T."""
        return (pi(_BITS) * (2 * self.n)).range

    @property
    def is_empty(self) -> bool:
        """Whether there is no single motion, by lemma 3 or as delta < 0."""
        if max(map(abs, self.at.nu)) <= 1 and (not self.leans or self.k > 0 < self.side):
            return True
        return bool(self.solution.delta.hi < 0)

    def has_none(self, times: Sequence[Fraction]) -> bool:
        """Whether no single motion is stable; times: at which the gap may be < 0."""
        if self.is_empty or self.solution.flips.lo > 0:
            return True
        if self.at.epsilon is None and launch_acceleration(self.start).hi <= 0:
            return True
        early = (rational(t, _BITS) for t in times if t < self.whole[0])
        return any(self.on((0,), t)[0].hi < 0 for t in early)

    @property
    def contracts(self) -> bool:
        """Whether the greater v is > 0 and the multipliers are inside the unit circle."""
        delta, above, below, flips = self.solution
        return bool(delta.lo > 0 < above.lo and below.lo > 0 > flips.hi)

    @property
    def has_one(self) -> bool:
        """Whether there is a stable motion, by lemma 4 or by its flight."""
        if not self.contracts:
            return False
        if self._is_short:
            return bool(launch_acceleration(self.start).lo > 0)
        search = FirstZero(self, LEAVES if self.at.epsilon is None else REBOUNDS)
        begin, end = search.window(self.whole[1] + _LATER)
        return begin < self.whole[0] and self.whole[1] < end

    @property
    def _is_short(self) -> bool:
        """Whether lemma 4 is about the motion."""
        inside = self.k < 2 * self.n * self.at.eta[0] and 2 * self.n * self.at.eta[1] < self.k + 1
        return self.at.epsilon is None and inside and self.k == (0 if self.side > 0 else 1)


def ratios(at: Place) -> Range:
    """Return the range of q."""
    low, high = at.sides[2]
    return ratio(high), ratio(low)


def launched(part: Part, of: Numbers, turn: tuple[Number, Number], found: Solution) -> Launch:
    """Return the state after the impact."""
    v = found.above / found.below
    speed = v * of.eta * turn[0] * part.side
    kick = None if part.at.epsilon is None else speed * (1 - of.q)
    return Launch(part.side, of.eta, v * turn[1] - 1, speed * of.q, kick)


def _root(x: Enclosure) -> Enclosure:
    return sqrt(Enclosure(max(x.lo, 0), max(x.hi, 0), x.bits))


def parts(at: Place, n: int, cuts: int = 1) -> Iterator[Part]:
    """Yield the parts of a box between multiples of 1/(2 n), each cut evenly."""
    low, high = at.eta
    first = 2 * n * low // 1
    last = max(-(-2 * n * high // 1), first + 1)
    if (last - first) * cuts > _MOST_PARTS:
        raise Unproved("a range of eta with too many parts")
    for k in range(first, last):
        least, most = max(low, Fraction(k, 2 * n)), min(high, Fraction(k + 1, 2 * n))
        ends = [least + (most - least) * Fraction(i, cuts) for i in range(cuts + 1)]
        yield from (Part(replace(at, eta=each), n, k) for each in pairwise(ends))


# -- the rule --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class StableSingles(Conclusion):
    """For these n, and no others up to `most`, there is a stable single motion, and only one."""

    at: Place
    most: int
    stable: tuple[int, ...]

    def __post_init__(self) -> None:
        periods = [0, *self.stable, self.most + 1]
        if not 1 <= self.most <= MOST_PERIODS or periods != sorted({*periods}):
            raise Unproved("numbers of periods from 1 to the most, in order")

    @property
    def kind(self) -> str:
        return "-".join([type(self).__name__, *map(str, self.stable)])

    @property
    def is_complete(self) -> bool:
        """Whether lemma 3 excludes all greater n."""
        return 0 < self.at.nu[0] <= self.at.nu[1] <= 1 <= 2 * (self.most + 1) * self.at.eta[0]

    @property
    def sentence(self) -> str:
        low, leaves = self.at.sides[2][0], ""
        if low == 0:
            plastic = "if impacts are plastic" if self.at.epsilon else "impacts being plastic"
            leaves = f", after which, {plastic}, it leaves at once (launch acceleration > 0)"
        motion = (
            "periodic motion of the mass with one impact, a transversal one, in n table periods"
            f"{leaves},"
        )
        most = "" if self.is_complete else f" up to {self.most}"
        if not self.stable:
            return (
                f"no {motion} is stable, for any n{most}: each that there is has a multiplier "
                "outside of the unit circle."
            )
        return (
            f"there is exactly one stable {motion} for n = {', '.join(map(str, self.stable))}, "
            f"{'each, ' if len(self.stable) > 1 else ''}and none for another n{most}. Its "
            "multipliers are inside of the unit circle, and it attracts all motions that are near "
            "it after an impact; each other one that there is has a multiplier outside."
        )

    @property
    def brief(self) -> str:
        named = ", ".join(map(str, self.stable))
        return (
            f"for n up to {self.most} a motion that never sticks, with one impact in n table "
            f"periods, is stable for {f'n = {named} alone' if named else 'none'}"
        )


def stable_singles(context: Context, reader: Reader) -> StableSingles:
    """Rule `stable-singles`: {most, stable: [{n, cuts}], none: [{n, cuts, times}]}.

    The box is cut at multiples of 1/(2 n), each part evenly into `cuts`. For n in `stable` it is in
    one part, and in all that this is cut into delta > 0, v > 0, F < 0, and nothing is hit before T:
    by lemma 4, or as T is inside of the window of a transversal first impact that is found (see
    `FirstZero`). For each other n up to `most`,
    where `none` does not name it without cuts and times, there are in each part no motions, by
    lemma 3 or as delta < 0; or F > 0; or, for plastic impacts, launch acceleration <= 0; or gap < 0
    at one of the times, in (0, T). Conclusion: `StableSingles`. Proof. Lemmas 1 to 4.
    """
    most_of, stable_of, none_of = reader.fields("most", "stable", "none")
    most, at = integer(most_of, 1, MOST_PERIODS), context.oscillators
    stable, none = _read(stable_of, most), _read(none_of, most, "times")
    if stable.keys() & none.keys():
        raise none_of.fail("a number of periods that is named as stable, too")
    for n in range(1, most + 1):
        cuts, times = (stable if n in stable else none).get(n, (1, ()))
        every = list(parts(at, n, cuts))
        if n in stable:
            if len({part.k for part in every}) > 1 or not all(part.has_one for part in every):
                raise Unproved(f"a stable motion is not proved for n = {n}")
        elif not all(part.has_none(times) for part in every):
            raise Unproved(f"stable motions are not excluded for n = {n}")
    return StableSingles(at, most, tuple(sorted(stable)))


def _read(entries: Reader, most: int, *more: str) -> dict[int, tuple[int, tuple[Fraction, ...]]]:
    """Read cuts, and perhaps times, for some n, each once."""
    found = {}
    for entry in entries.items(0, most):
        n_of, cuts_of, *times_of = entry.fields("n", "cuts", *more)
        n = integer(n_of, 1, most)
        if n in found:
            raise n_of.fail("named twice")
        times = tuple(time for each in times_of for time in each.numbers(0))
        if not increasing((Fraction(0), *times)):
            raise entry.fail("times must increase from 0")
        found[n] = integer(cuts_of, 1, _MOST_PARTS), times
    return found

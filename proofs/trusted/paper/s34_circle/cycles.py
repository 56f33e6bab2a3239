"""All periodic orbits up to a period, where f expands: those that are there, no others. Row G18."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.coverings import read_image, read_images
from proofs.trusted.kernel.enclose import integer
from proofs.trusted.kernel.meter import METER
from proofs.trusted.numbers import Range, show, within
from proofs.trusted.paper.s34_circle.expansion import Expansion, read_expansion
from proofs.trusted.paper.s34_circle.grazing import Grazing
from proofs.trusted.paper.s34_circle.landing import NeverImpacts
from proofs.trusted.paper.s34_circle.laps import EntropyRange
from proofs.trusted.paper.s34_circle.pieces import Known, Pieces
from proofs.trusted.parameters import Parameters, Place
from proofs.trusted.verdicts import Decision, Found, Row, Verdict, decided, undecided

_LONGEST = 6  # period
_ROUNDS = 20
_UNIT = Fraction(1, 10**8)  # to which the ends of images are rounded
Word = tuple[int, ...]


@dataclass(frozen=True)
class Cycles(Conclusion):
    """Periodic orbits through the pieces of an expansion, by the numbers of these, in order.

    words: one orbit each; left: the other words, of up to `longest` pieces, that may have one.
    touching: the word that has one, through two grazes, exactly if a touch counts as an impact.
    """

    expansion: Expansion
    words: tuple[Word, ...]
    left: tuple[Word, ...]
    longest: int
    touching: Word | None = None

    @property
    def at(self) -> Place:
        """The oscillator."""
        return self.expansion.pieces.at

    @property
    def counts(self) -> list[tuple[int, int]]:
        """How many orbits of least period 1, 2, ... there are at least and at most."""
        low, high = (
            [sum(len(word) == n for word in words) for n in range(1, self.longest + 1)]
            for words in (self.words, (*self.words, *self.left))
        )
        return list(zip(low, high, strict=True))

    @property
    def sentence(self) -> str:
        return (
            "but for phases without any impact and the orbit that sticks, f has "
            f"{_counted(self.counts)}; each is unstable and follows a sequence of its own of "
            f"{len(self.expansion.scales)} intervals on which f is C^1 and monotone.{self._touches}"
        )

    @property
    def _touches(self) -> str:
        if self.touching is None:
            return ""
        return (
            " If a touch without relative velocity counts as an impact, there is one more, of "
            "least period 2, through both ends of the interval of phases without any impact: the "
            "motion that leaves the table at one of them touches it at the other, and then at the "
            "first again. If none counts, there is none."
        )

    @property
    def brief(self) -> str:
        return _counted(self.counts)


def _counted(counts: Sequence[tuple[int, int]]) -> str:
    """Say how many periodic orbits there are."""
    return ", ".join(
        f"{low if low == high else f'{low} to {high}'} periodic orbits of least period {n}"
        for n, (low, high) in enumerate(counts, 1)
    )


def cycles(
    known: Known,
    expansion: Expansion,
    orbits: Sequence[Sequence[tuple[Fraction, Range]]],
    radius: Fraction,
    longest: int,
) -> Cycles:
    """Theorem. Let f expand on pieces by `rate` with scales s_i. Let x_1, ..., x_n be phases, each
    with all within radius / s_i of it on one branch i, and f(x_k) so near to x_(k+1), x_(n+1) =
    x_1: within min(rate - 1, 1) radius / s_i of it. Let the words of such orbits be different and
    no powers, up to rotation; for each other such word of up to `longest` pieces that is not left,
    let the images of its first piece in the others, round and round, end in none, or let it be
    the word of `touching`. Then what `Cycles.sentence` says.

    Proof. 1. Going away from x_k in branch i while f stays within radius / s_j of x_(k+1), one goes
    at most (radius + (rate - 1) radius) / (rate s_i) far: so f maps the phases around x_k over
    those around x_(k+1), and f^n has a fixed point in the first ones. 2. A word is followed for
    ever by one phase at most, see `expansion`: so it belongs to one orbit at most, of its length.
    With f extended to grazes by its limit from one side this is true of closed pieces, too.
    """
    if not 1 <= longest <= _LONGEST or radius <= 0:
        raise Unproved("no radius, or no periods that can be looked at")
    found = [word_of(expansion, orbit, radius) for orbit in orbits]
    if len(set(found)) != len(found) or not all(is_least(x) and len(x) <= longest for x in found):
        raise Unproved("periodic orbits are not proved different")
    outer = Outer(expansion, known)
    others = (
        (word, state)
        for length in range(1, longest + 1)
        for word, state in outer.words(length)
        if is_least(word) and word not in found
    )
    touched = touching(expansion) if longest > 1 else None
    left = tuple(word for word, state in others if word != touched and not outer.dies(word, state))
    return Cycles(expansion, tuple(found), left, longest, None if touched in found else touched)


def touching(expansion: Expansion) -> Word | None:
    """Theorem. Let the pieces i and j be those on both sides of the phases that never impact, with
    the grazes a and b between, after each of which, on the side of these phases, there is no impact
    for q turns, eta = p/q; let the limits of f at a on i and at b on j be known to lie beside these
    phases: at the other graze, among phases of the next piece, or of those that never impact. Then
    f on i tends to b at a, f on j to a at b, and if a touch counts as an impact, a and b are an
    orbit of period 2; if none does, no orbit follows the word i j.

    Proof. The motion that leaves the table at a without relative velocity touches it first at c,
    the limit of f at a, and then, as from phases beside a, not until q turns after a, at a: so the
    motion that leaves it at c, which is the same one, touches it at a first, before q turns. No
    phase that never impacts does so within q turns; no phase of a branch touches first, its impact
    is transversal; of those in the interval around a graze only that one: so c is b. And so with a
    and b exchanged. An orbit with the word i j would be a second one in the closed pieces.
    """
    arcs = expansion.pieces.arcs
    place = next(i for i, each in enumerate(arcs) if isinstance(each, NeverImpacts))
    if not 2 <= place < len(arcs) - 2:
        return None
    (one, a), never, (b, two) = arcs[place - 2 : place], arcs[place], arcs[place + 1 : place + 3]
    if not (isinstance(a, Grazing) and isinstance(b, Grazing)) or a.other or b.other:
        return None
    if not a.below or b.below:
        return None
    after, before = (never.phases[0], two.phases[1]), (one.phases[0], never.phases[1])
    for limit, sides in ((a.graze, after), (b.graze, before)):
        if not (sides[0] < limit[0] and limit[1] < sides[1]):
            return None
    places = [i for i, piece in enumerate(expansion.pieces.monotone) if piece.branch in (one, two)]
    return _least(tuple(places))


def word_of(
    expansion: Expansion, orbit: Sequence[tuple[Fraction, Range]], radius: Fraction
) -> Word:
    """Return the word of a periodic orbit near some phases."""
    places = [_place(expansion, phase, radius) for phase, _ in orbit]
    near = radius * min(expansion.rate - 1, Fraction(1))
    for place, (phase, _), (_, image) in zip(
        places, orbit, (*orbit[-1:], *orbit[:-1]), strict=True
    ):
        off = max(image[1] - phase, phase - image[0])
        if off > near / expansion.scales[place]:
            raise Unproved("a phase is not mapped close enough to the next one")
    return _least(tuple(places))


def _place(expansion: Expansion, phase: Fraction, radius: Fraction) -> int:
    """Return the number of the branch that a phase and what is near it are on."""
    METER.get().spend(2 * len(expansion.scales))
    for place, (piece, scale) in enumerate(
        zip(expansion.pieces.monotone, expansion.scales, strict=True)
    ):
        if within((phase - radius / scale, phase + radius / scale), piece.branch.phases):
            return place
    raise Unproved("a phase is not far enough inside of a branch")


def _least(word: Word) -> Word:
    """Return the first of a word's rotations."""
    return min(word[i:] + word[:i] for i in range(len(word)))


def is_least(word: Word) -> bool:
    """Whether a word is the first of its rotations, and no power of a shorter one."""
    return all(word < word[i:] + word[:i] for i in range(1, len(word)))


class Outer:
    """What holds the images of pieces, and of parts of them, in pieces."""

    def __init__(self, expansion: Expansion, known: Known) -> None:
        self.pieces = expansion.pieces.monotone

        @cache
        def image(state: Range, place: int) -> Range | None:
            METER.get().spend(20)
            found = self.pieces[place].image(state, known)
            if found is None:
                return None
            low, high = expansion.pieces.unwrapped(found)
            return low // _UNIT * _UNIT, -(-high // _UNIT) * _UNIT

        self._image = image

    def step(self, state: Range, place: int, after: int) -> Range | None:
        """Return what holds the image of a state in one piece that lies in another; None: none."""
        image, (first, last) = self._image(state, place), self.pieces[after].phases
        if image is None or image[1] < first or last < image[0]:
            return None
        return max(image[0], first), min(image[1], last)

    def words(self, length: int) -> Iterator[tuple[Word, Range]]:
        """Yield the words that may be followed, with what holds the last of the phases."""
        waiting: list[tuple[Word, Range]] = [((i,), x.phases) for i, x in enumerate(self.pieces)]
        while waiting:
            word, state = waiting.pop()
            METER.get().spend(4 * len(self.pieces))
            if len(word) == length:
                yield word, state
                continue
            for after in range(len(self.pieces)):
                then = self.step(state, word[-1], after)
                if then is not None:
                    waiting.append(((*word, after), then))

    def dies(self, word: Word, state: Range) -> bool:
        """Whether no phase is proved to follow a word, the last one in a state, for ever."""
        for k in range(_ROUNDS * len(word)):
            then = self.step(state, word[(k - 1) % len(word)], word[k % len(word)])
            if then is None:
                return True
            state = then
        return False


def prove_expansion(context: Context, reader: Reader) -> Cycles:
    """Rule `expansion`: {pieces, cells: [{cuts, times}] for each piece, scales, rate, orbits:
    [[{phase, time}]], radius, longest, images}.

    images: [{phase, time}]; time brackets the first impact after a phase on a branch, as in
    `Branch.image`. Conclusion: `expansion`, by `read_expansion`, and `cycles`, the ends of images
    being rounded outward to 8 decimals.
    """
    pieces_of, cells_of, scales, rate, orbits_of, radius, longest, images = reader.fields(
        "pieces", "cells", "scales", "rate", "orbits", "radius", "longest", "images"
    )
    expansion = read_expansion(context.step(pieces_of, Pieces), cells_of, scales, rate)
    branches = [piece.branch for piece in expansion.pieces.monotone]
    orbits = [
        [read_image(branches, entry) for entry in orbit.items(1, _LONGEST)]
        for orbit in orbits_of.items(0, 5000)
    ]
    return cycles(
        read_images(branches, images).get,
        expansion,
        orbits,
        radius.number(),
        integer(longest, 1, _LONGEST),
    )


# -- the row ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Coding(Conclusion):
    """Theorem. Let f expand on pieces, and the graphs of an entropy range be about the same ones.
    Then what the sentence says.

    Proof. Orbits with the same sequence are equal: `Expansion`. Each path of the inner graph is
    followed by an orbit, and each orbit follows one of the outer graph: `entropy_range`.
    """

    expansion: Expansion
    entropy: EntropyRange

    def __post_init__(self) -> None:
        if self.expansion.pieces != self.entropy.pieces:
            raise Unproved("expansion and entropy are about different pieces")

    at = About("entropy")

    @property
    def sentence(self) -> str:
        lower = self.entropy.lower
        return (
            f"{self.expansion.sentence} Which sequences of the intervals on which f is monotone "
            "are followed by orbits that stay in them lies between two sofic shifts: those of the "
            f"paths in a graph with {lower.states} states all are, and all that are belong to "
            f"paths in a graph with {self.entropy.states} states; their entropies are log "
            f"{show(lower.growth)} or more and log {show(self.entropy.growth)} or less."
        )

    @property
    def brief(self) -> str:
        return f"{self.expansion.brief}; {self.entropy.brief}"


def _tame(of: Parameters, found: Found) -> Decision:
    """G18: by an expansion with its periodic orbits, and an entropy range about the same pieces."""
    del of
    orbits, entropy = found.first(Cycles), found.first(EntropyRange)
    if orbits is None or entropy is None:
        return undecided("no expansion, or no graph of what follows what, is proved")
    both = Coding(orbits.expansion, entropy), orbits
    return decided(Verdict.VERIFIED, *both, corrected=both)


ROWS = (
    Row(
        "G18",
        "3.4",
        "",
        "At (eta, nu) = ({eta}, {nu}): all orbits of f that come neither to the one that sticks "
        "nor to a phase without any impact are unstable, and told apart by the sequences of "
        "intervals that they follow.",
        _tame,
    ),
)

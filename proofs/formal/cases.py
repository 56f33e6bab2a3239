"""Write the Coq file of a plan: lemmas with numbers for `interval`, and the theorems from them.

The writer is not trusted: coqc proves every line, and a reader reads `theory/Impact.v` and the
theorems' statements.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

from proofs.formal import templates
from proofs.formal.hints import SLACK, Branch, Hints, NoHint, binary
from proofs.formal.plan import Headline, Plan
from proofs.search.repair import rounded_slopes, short_decimal
from proofs.trusted.numbers import Range, hull, show_range, within

_PLACES = 6  # of a root of Moran's equation
_BITS = 40  # of Coq's integers, where no margin is thin
_ROOM = 2.0**-24
_TINY = Fraction(1, 2**30)


class Theorem(NamedTuple):
    """A theorem by its name in Coq and in words."""

    name: str
    says: str


class Case(NamedTuple):
    """A Coq file, and the theorems in it."""

    text: str
    theorems: list[Theorem]


class Sets(NamedTuple):
    """I0 and I1 by a name, and bounds on f' there."""

    name: str
    domains: tuple[Range, Range]
    bounds: tuple[Range, Range]

    def sign(self, index: int) -> int:
        """The sign of f' on I0 or I1; 0 if the bounds leave it open."""
        low, high = self.bounds[index]
        return 1 if low > 0 else -1 if high < 0 else 0

    def sizes(self, index: int) -> Range:
        """Bounds on |f'|."""
        low, high = self.bounds[index]
        return (low, high) if self.sign(index) > 0 else (-high, -low)

    def with_common_bounds(self) -> Sets:
        """Return the sets with bounds on |f'| that hold on both, if f' has a sign on each."""
        signs = self.sign(0), self.sign(1)
        if not all(signs):
            return self
        m, M = hull([self.sizes(0), self.sizes(1)])
        first, second = ((m, M) if sign > 0 else (-M, -m) for sign in signs)
        return self._replace(bounds=(first, second))

    @property
    def interval(self) -> Range:
        """I, from the left end of I0 to the right end of I1."""
        return self.domains[0][0], self.domains[1][1]


def rational(x: Fraction) -> str:
    """Write a rational as a Coq term."""
    text = f"{abs(x.numerator)}" + (f" / {x.denominator}" if x.denominator > 1 else "")
    return f"(- {text})" if x < 0 else f"({text})"


def fields(**values: object) -> dict[str, str]:
    """Return values as they are written in Coq."""
    return {k: rational(x) if isinstance(x, Fraction) else str(x) for k, x in values.items()}


class Writer:
    """Collects the lemmas and theorems of a plan."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.hints = Hints(plan.of.eta, plan.of.nu)
        self.lines: list[str] = []
        self.theorems: list[Theorem] = []
        self.finest = 1.0
        self.sets = list(self._sets())
        self.branches = [self._branches(index) for index in (0, 1)] if self.sets else []
        self.laps: dict[int, int] = {}
        self.stated: dict[str, object] = {}  # the theorem on the horseshoe and its numbers
        self.avoid: dict[str, str] = {}  # for each of the sets, the lemma that the gap leaves I

    def add(self, template: str, **values: object) -> None:
        """Write a template with these values."""
        self.lines.append(template.format(**fields(**values)))

    def state(self, name: str, says: str, template: str, **values: object) -> None:
        """Write a theorem."""
        self.add(template, name=name, says=says.replace("*)", "* )"), **values)
        self.theorems.append(Theorem(name, says))

    # -- sets and slopes -----------------------------------------------------------------------

    def _sets(self) -> Iterator[Sets]:
        """Yield the sets of the horseshoe, and those printed if something is stated there."""
        plan, headline = self.plan, self.plan.headline
        if headline is not None:
            low, high = headline.slopes
            bounds = [(low, high) if sign > 0 else (-high, -low) for sign in headline.signs]
            yield Sets("horseshoe", (headline.left, headline.right), (bounds[0], bounds[1]))
        asked = {"H1", "H2", "H3", "H6"} & {name for name in plan.verdicts if plan.holds(name)}
        if asked or "H5" in plan.verdicts:
            printed = Sets(
                "printed",
                (plan.of.left, plan.of.right),
                (self._bounds(plan.of.left), self._bounds(plan.of.right)),
            )
            yield printed.with_common_bounds()

    def _bounds(self, domain: Range) -> Range:
        """Return what the claims say about f' on a printed set, roughly where they say nothing."""
        least, greatest = self.hints.rates(domain)
        low = binary(least / 2 if least > 0 else least * 2, 10)
        high = binary(greatest * 2 if greatest > 0 else greatest / 2, 10, up=True)
        if self.plan.holds("H1"):
            low = max(low, self.plan.of.slopes[0])
        if self.plan.holds("H6"):
            low = short_decimal(self.plan.of.slopes[0], Fraction(least))
        if self.plan.holds("H2"):
            high = min(high, self.plan.of.slopes[1])
        return low, high

    def _branches(self, index: int) -> list[Branch]:
        """Write that the launches near I0, or I1, have transversal first impacts."""
        whole = hull([sets.domains[index] for sets in self.sets])
        branches = self.hints.branches(*whole)
        parts = []
        for j, branch in enumerate(branches):
            self.add(templates.BRANCH, i=f"{index}_{j}", **branch._asdict())
            part = templates.LAST if branch is branches[-1] else templates.GLUED
            next_a = branches[min(j + 1, len(branches) - 1)].a
            parts.append(part.format(branch=f"{index}_{j}", b=rational(branch.b), c=rational(next_a)))
        ends = {"a": branches[0].a, "b": branches[-1].b}
        self.add(templates.REGULAR, i=index, parts="".join(parts), **ends)
        self._rates(index, branches, whole)
        return branches

    def _rates(self, index: int, branches: list[Branch], whole: Range) -> None:
        """Write the bounds on f', piece by piece, then for each of the sets and on the whole."""
        parts = [(sets.domains[index], sets.bounds[index]) for sets in self.sets]
        cuts = {end for domain, _ in parts for end in domain}
        cuts |= {branch.b - SLACK for branch in branches}
        pieces: list[tuple[str, Range]] = []
        used = [bounds for _, bounds in parts]
        for zone in pairwise(sorted(cuts)):
            j = next(j for j, branch in enumerate(branches) if within(zone, branch[:2]))
            inside = [bounds for domain, bounds in parts if within(zone, domain)]
            inside = inside or [self._bounds(zone)]
            bounds = max(low for low, _ in inside), min(high for _, high in inside)
            used.append(bounds)
            for piece in self.hints.pieces(branches[j], zone, bounds):
                name = f"piece{index}_{len(pieces)}"
                self.finest = min(self.finest, float(piece.d))
                named = {"name": name, "branch": f"{index}_{j}", "lo": bounds[0], "hi": bounds[1]}
                self.add(templates.PIECE, **named, **piece._asdict())
                pieces.append((name, (piece.p, piece.q)))
        everywhere = Sets("whole", (whole, whole), (hull(used),) * 2)
        for sets in (*self.sets, everywhere):
            self._bounded(sets, index, branches, pieces)

    def _bounded(
        self, sets: Sets, index: int, branches: list[Branch], pieces: list[tuple[str, Range]]
    ) -> None:
        """Write the bounds on f' for I0 or I1, and that f is monotone there."""
        (x, y), (lo, hi) = sets.domains[index], sets.bounds[index]
        mine = [(name, part[1]) for name, part in pieces if within(part, (x, y))]
        named = {"i": index, "set": sets.name, "x": x, "y": y, "lo": lo, "hi": hi}
        self.add(templates.RATE, **named, cuts=by_cases(mine, "destruct ({} phi); lra"))
        sign, (m, M) = sets.sign(index), sets.sizes(index)
        if sign:
            ends = {"a": branches[0].a, "b": branches[-1].b}
            self.add(templates.MONOTONE, **named, **ends, s=f"({sign})", m=m, M=M)

    # -- images ----------------------------------------------------------------------------------

    def _impact(self, index: int, phases: Range, name: str, room: float = _ROOM) -> Range:
        """Write a bracket of the impact times of some launches, and return it."""
        times = [self.hints.impact(float(phase)) for phase in phases]
        bits = 2 - math.floor(math.log2(room))
        low, high = binary(min(times) - room, bits), binary(max(times) + room, bits, up=True)
        self.finest = min(self.finest, room)
        j = next(j for j, x in enumerate(self.branches[index]) if within(phases, x[:2]))
        named = {"name": name, "branch": f"{index}_{j}", "p": phases[0], "q": phases[1]}
        self.add(templates.IMPACT, **named, s=low, t=high)
        return low, high

    def lap(self, index: int) -> dict[str, object]:
        """Write in which lap all images of a branch are; return it with the branch's ends."""
        a, b = self.branches[index][0].a, self.branches[index][-1].b
        if index not in self.laps:
            x, y = hull([sets.domains[index] for sets in self.sets])
            if not all(sets.sign(index) == self.sets[0].sign(index) != 0 for sets in self.sets):
                raise NoHint("f is not monotone")
            low = self._impact(index, (a, x), f"before{index}", _ROOM * 2**8)
            high = self._impact(index, (y, b), f"after{index}", _ROOM * 2**8)
            least = min(a + low[0], y + high[0])
            greatest = max(x + low[1], b + high[1])
            lap = math.floor(least / Fraction(math.tau))
            if greatest > (lap + 1) * Fraction(math.tau):
                raise NoHint("an image passes phase 0")
            self.add(templates.LAP, i=index, x=x, y=y, k=lap, l=least, r=greatest, a=a, b=b)
            self.laps[index] = lap
        return {"a": a, "b": b, "k": self.laps[index]}

    def covers(self, sets: Sets) -> None:
        """Write that f maps I0 and I1 over I."""
        (A, B) = sets.interval
        for index, (x, y) in enumerate(sets.domains):
            where, sign = self.lap(index), sets.sign(index)
            targets = (A, B) if sign > 0 else (B, A)
            for end, phase, target in ((0, x, targets[0]), (1, y, targets[1])):
                room = min(_ROOM, abs(self._image(index, phase) - float(target)) / 8)
                self._impact(index, (phase, phase), f"end_{sets.name}{index}_{end}", room)
            named = {"i": index, "set": sets.name, "x": x, "y": y, "A": A, "B": B}
            self.add(templates.COVERS, **named, **where, s=f"({sign})")

    def _image(self, index: int, phase: Fraction) -> float:
        """Return about f(phase), in the lap of the branch."""
        return float(phase) + self.hints.impact(float(phase)) - self.laps[index] * math.tau

    def avoids(self, name: str, phases: Range, target: Range) -> None:
        """Write that no launch from an interval of phases has its impact in the target."""
        escapes = self.hints.escapes(phases, target)
        for j, escape in enumerate(escapes):
            laps = " \\/ ".join(f"(k = {lap})%Z" for lap in range(1, escape.K)) or "False"
            named = {"name": name, "j": j, "A": target[0], "B": target[1], "cases": laps}
            self.add(templates.ESCAPE, **named, **escape._asdict())
        parts = [(f"{name}{j}", escape.q) for j, escape in enumerate(escapes)]
        named = {"name": name, "A": target[0], "B": target[1], "p": phases[0], "q": phases[1]}
        cuts, met = by_cases(parts, "apply ({} phi psi); [lra | exact N]"), by_cases(parts, "apply {}_meets; lra")
        self.add(templates.AVOIDS, **named, cuts=cuts, met=met)

    # -- theorems --------------------------------------------------------------------------------

    def horseshoe(self, headline: Headline) -> None:
        """Write the theorem on the horseshoe, and what follows from it."""
        sets, (A, B), (m, M) = self.sets[0], headline.interval, headline.slopes
        self.covers(sets)
        name = "corrected_theorem" if headline.is_corrected else "horseshoe_theorem"
        values = {"A": A, "b0": headline.left[1], "a1": headline.right[0], "B": B, "m": m, "M": M}
        signs = {"s0": f"({headline.signs[0]})", "s1": f"({headline.signs[1]})"}
        says = templates.horseshoe_in_words(headline)
        self.state(name, says, templates.HORSESHOE, **values, **signs, avoid=self.avoid[sets.name])
        self.stated = {"of": name, "s1": signs["s1"], **values}
        for follows, words in templates.FOLLOWS_IN_WORDS.items():
            if m > 2 or follows != "measure_zero":
                self.state(follows, words, templates.FOLLOWS[follows], of=name, **values)

    def claims(self) -> None:
        """Write the theorems on H1 to H6, as far as they are decided."""
        of = self.plan.of
        (x0, y0), (x1, y1) = of.left, of.right
        ends = {"x0": x0, "y0": y0, "x1": x1, "y1": y1, "lo": of.slopes[0], "hi": of.slopes[1]}
        for claim, verdict in self.plan.verdicts.items():
            name = f"{claim}_{verdict.value.lower()}"
            says = f"{claim} {verdict.value}: {self.plan.statements[claim]}"
            if claim in self.plan.points:
                self._refuted(claim, name, says, ends)
            elif claim == "H5":
                self._preimages(name, says, ends)
            elif claim in ("H11", "H16"):
                self._moran(claim, name, says)
            elif claim == "H4":
                A, B = of.interval
                avoid = self.avoid["printed"]
                self.state(name, says, templates.H4_VERIFIED, **ends, A=A, B=B, avoid=avoid)
            else:
                printed = self.sets[-1]
                lows = {f"m{i}": printed.sizes(i)[0] for i in (0, 1)}
                self.state(name, says, templates.VERIFIED[claim], **ends, **lows)

    def _refuted(self, claim: str, name: str, says: str, ends: dict[str, Fraction]) -> None:
        """Write what one phase shows against a claim."""
        point, of = self.plan.points[claim], self.plan.of
        phase, (low, high) = point.phase, point.slope
        self.add(templates.BRANCH, i=f"_{claim}", **self.hints.branch(phase, phase, _TINY)._asdict())
        lo, hi = of.slopes
        limits = {"H1": [lo], "H2": [hi], "H3": [Fraction(0)], "H6": [Fraction(0), lo]}
        nearest = min((abs(end - x) for x in limits.get(claim, []) for end in (low, high)), default=1)
        spare = float(min(nearest, 1))
        room = min(_ROOM, spare / 2**12)
        bits, time = 2 - math.floor(math.log2(room)), self.hints.impact(float(phase))
        s, t = binary(time - room, bits), binary(time + room, bits, up=True)
        named = {"c": claim, "p": phase, "s": s, "t": t, **ends}
        self.finest = min(self.finest, room)
        m, M = binary(float(low) - spare / 4, bits), binary(float(high) + spare / 4, bits, True)
        lap, image = math.floor((phase + s) / Fraction(math.tau)), point.image
        if claim == "H4":
            A, B = of.interval
            self.state(name, says, templates.H4_REFUTED, **named, k=lap, A=A, B=B)
        elif claim == "H6":
            A, B = next(x for x in (of.left, of.right) if x[0] < image[0] and image[1] < x[1])
            y = next(x[1] for x in (of.left, of.right) if x[0] < phase < x[1])
            more = {"m": m, "M": M, "A": A, "B": B, "y": y, "k": lap}
            self.state(name, says, templates.H6_REFUTED, **named, **more)
        else:
            self.state(name, says, templates.REFUTED[claim], **named, m=m, M=M)

    def _moran(self, claim: str, name: str, says: str) -> None:
        """Write H11, a bracket of each root of Moran's equation, or H16."""
        if not self.plan.holds(claim):
            return
        if claim == "H16":
            r0, r1 = self.plan.of.moran_ratios
            self.state(name, says, templates.H16, r0=r0, r1=r1)
        for number, root in enumerate(self.plan.roots if claim == "H11" else ()):
            (r0, r1), (l, r) = root.ratios, rounded_slopes(root.root, _PLACES)
            more = f"_{number}" if number else ""
            self.state(name + more, says, templates.H11, r0=r0, r1=r1, l=l, r=r)

    def _preimages(self, name: str, says: str, ends: dict[str, Fraction]) -> None:
        """Write H5: I0 and I1 are mapped over I, or one of them misses an end of it."""
        printed = self.sets[-1]
        if self.plan.holds("H5"):
            self.covers(printed)
            signs = {f"s{i}": f"({printed.sign(i)})" for i in (0, 1)}
            lows = {"m": min(printed.sizes(i)[0] for i in (0, 1))}
            self.state(name, says, templates.H5_VERIFIED, **ends, **signs, **lows, avoid=self.avoid["printed"])
            return
        for index, (x, y) in enumerate(printed.domains):
            where, sign = self.lap(index), printed.sign(index)
            images = [self._image(index, end) for end in (x, y)]
            missed = self._missed(min(images), max(images))
            if missed is not None:
                for end, phase in ((0, x), (1, y)):
                    self._impact(index, (phase, phase), f"missed{index}_{end}")
                named = {"i": index, "x": x, "y": y, "c": missed[0], "d": missed[1], **ends}
                self.state(name, says, templates.H5_REFUTED, **named, k=where["k"])
                if index == 0 and sign > 0 and missed[0] == x:
                    self._no_word(ends, self.laps[0])
                return
        raise NoHint("H5: no interval is seen to be missed")

    def _no_word(self, ends: dict[str, Fraction], lap: int) -> None:
        """Write that the word 000... has no point in the printed I0, if the horseshoe's contains it."""
        headline = self.plan.headline
        if headline is None or headline.signs[0] < 0 or not within(self.plan.of.left, headline.left):
            return
        says = f"H7 as printed fails: no orbit stays in I0 = {show_range(self.plan.of.left)}"
        self.state("no_word_000", says, templates.NO_WORD, **ends, k=lap, **self.stated)

    def _missed(self, low: float, high: float) -> Range | None:
        """Return an interval in I0 or in I1 that an image from `low` to `high` misses."""
        left, right = self.plan.of.left, self.plan.of.right
        if low > left[0]:
            return left[0], short_decimal(left[0], min(Fraction(low), left[1]))
        if high < right[1]:
            return short_decimal(max(Fraction(high), right[0]), right[1]), right[1]
        return None

    def write(self) -> Case:
        """Return the whole file."""
        self.leaving()
        if self.plan.headline is not None:
            self.horseshoe(self.plan.headline)
        self.claims()
        return Case("".join(self.lines), self.theorems)

    def leaving(self) -> None:
        """Write that the gap leaves I: for the horseshoe and for H4 at once, if that can be."""
        of, headline, wanted = self.plan.of, self.plan.headline, []
        if headline is not None:
            wanted.append(("horseshoe", (headline.left[1], headline.right[0]), headline.interval))
        if self.plan.holds("H4"):
            wanted.append(("printed", of.gap, of.interval))
        if not wanted:
            return
        phases, target = (hull([each[index] for each in wanted]) for index in (1, 2))
        try:
            self.avoids("escape", phases, target)
            self.avoid = {name: "escape" for name, _, _ in wanted}
        except NoHint:
            for name, *where in wanted:
                self.avoid[name] = f"escape_{name}"
                self.avoids(self.avoid[name], *where)


def case(plan: Plan, source: str, floats: bool) -> Case:
    """Return the Coq file of a plan, for Coq's integers or for machine floats."""
    writer = Writer(plan)
    body = writer.write()
    bits = max(_BITS, 16 - math.floor(math.log2(writer.finest)))
    precision = "" if floats and bits <= 53 else f"i_prec {bits}"
    head = templates.HEAD.format(
        source=source,
        arithmetic=templates.FLOATS if floats else templates.INTEGERS,
        plain=precision and f" with ({precision})",
        bits=precision and f", {precision}",
        **fields(side=writer.hints.side, eta=plan.of.eta, nu=plan.of.nu),
    )
    names = [theorem.name for theorem in body.theorems]
    return Case(head + body.text + templates.ALL.format(names=", ".join(names)), body.theorems)


def by_cases(parts: Sequence[tuple[str, Fraction]], tactic: str) -> str:
    """Return a proof script: by which of the adjoining pieces phi is in."""
    lines = [
        f"\n  destruct (Rle_dec phi {rational(end)}) as [?|?]; [{tactic.format(name)} |]."
        for name, end in parts[:-1]
    ]
    return "".join(lines) + f"\n  {tactic.format(parts[-1][0])}."

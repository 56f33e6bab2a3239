"""Write the Coq file of a plan: the theorems on the horseshoe and on the paper's claims.

The writer is not trusted: a reader reads `theory/Impact.v` and the theorems' statements.
"""

from __future__ import annotations

import math
from fractions import Fraction

from proofs.formal import lemma_text, theorem_text
from proofs.formal.flights import Cutter, graph
from proofs.formal.hints import NoHint, binary
from proofs.formal.lemmas import ROOM, Lemmas
from proofs.formal.plan import Headline, Plan
from proofs.formal.written import Case, fields
from proofs.search.repair import rounded_slopes, short_decimal
from proofs.trusted.kernel.itineraries import Itinerary
from proofs.trusted.numbers import Range, show, show_range, within
from proofs.trusted.verdicts import Verdict

_PLACES = 6  # of a root of Moran's equation
_BITS = 40  # of Coq's integers, where no margin is thin
_NARROW = Fraction(1, 2**14), Fraction(1, 2**8)  # about the images of an end of I
_TINY = Fraction(1, 2**30)


class Theorems(Lemmas):
    """Collects the lemmas and theorems of a plan."""

    def __init__(self, plan: Plan) -> None:
        super().__init__(plan)
        self.stated: dict[str, object] = {}  # the theorem on the horseshoe and its numbers

    def horseshoe(self, headline: Headline) -> None:
        """Write the theorem on the horseshoe, and what follows from it."""
        sets, (low, high), (least, greatest) = self.sets[0], headline.interval, headline.slopes
        self.covers(sets)
        name = "corrected_theorem" if headline.is_corrected else "horseshoe_theorem"
        values = {"A": low, "b0": headline.left[1], "a1": headline.right[0], "B": high}
        values |= {"m": least, "M": greatest}
        signs = {"s0": f"({headline.signs[0]})", "s1": f"({headline.signs[1]})"}
        says = theorem_text.horseshoe_in_words(headline)
        self.state(
            name, says, theorem_text.HORSESHOE, **values, **signs, avoid=self.avoid[sets.name]
        )
        self.stated = {"of": name, "s1": signs["s1"], **values}
        for follows, (what, by, words) in theorem_text.CONSEQUENCES.items():
            if least > 2 or follows != "measure_zero":
                self.state(
                    follows, words, theorem_text.FOLLOWS, of=name, what=what, by=by, **values
                )
            else:
                self.left_out.append(
                    f"{follows}: stated where |f'| > 2, and its bound here is {show(least)}"
                )

    def invariant(self, headline: Headline, orbit: Itinerary) -> None:
        """Write H8 to H10, on Lambda: where the orbit of an end of I is in I0, then in the gap."""
        end, interval = orbit.phase, (orbit.phase, headline.interval[1])
        if self.plan.of.interval != interval or len(orbit.orbit) != 3:
            return
        images = [_widened(*x) for x in zip(orbit.orbit[1:], _NARROW, strict=True)]
        inside = within(images[0], headline.left), within(images[1], headline.gap)
        if headline.signs != (1, 1) or not all(inside):
            return
        cutter = Cutter(self.hints, [end, *images[0], *images[1]])
        start = cutter.cut(end, end, float(_NARROW[0]) / 4), cutter.cut(*images[0])
        data = [
            f"{self._turns(phase)} {cut} {cutter.in_units(low)} {cutter.in_units(high)}"
            for phase, cut, (low, high) in zip((end, images[0][0]), start, images, strict=True)
        ]
        named = {**cutter.numbers, "first": data[0], "second": data[1], "P": end}
        self.add(theorem_text.FOLLOWED, **named, **self.stated)
        for claim, text in theorem_text.LAMBDA.items():
            if claim in self.plan.statements and (claim != "H10" or headline.slopes[0] > 2):
                says = f"{claim} VERIFIED: {self.plan.statements[claim]}"
                self.state(f"{claim}_verified", says, text, (claim,), P=end, **self.stated)

    def _turns(self, phase: Fraction) -> int:
        return math.floor((float(phase) + self.hints.impact(float(phase))) / math.tau)

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
                named = {"A": of.interval[0], "B": of.interval[1], "avoid": self.avoid["printed"]}
                self.state(name, says, theorem_text.H4_VERIFIED, (claim,), **ends, **named)
            else:
                printed = self.sets[-1]
                lows = {f"m{i}": printed.sizes(i)[0] for i in (0, 1)}
                self.state(name, says, theorem_text.VERIFIED[claim], (claim,), **ends, **lows)

    def _refuted(self, claim: str, name: str, says: str, ends: dict[str, Fraction]) -> None:
        """Write what one phase shows against a claim."""
        point, of = self.plan.points[claim], self.plan.of
        phase, (low, high) = point.phase, point.slope
        spare = self._spare(claim, point.slope)
        room = min(ROOM, spare / 2**12)
        cutter = Cutter(self.hints, (phase, _TINY))
        self.branch(f"_{claim}", cutter, cutter.cut(phase - _TINY, phase + _TINY, 2 * room))
        self.finest = min(self.finest, room)
        bits, time = 2 - math.floor(math.log2(room)), self.hints.impact(float(phase))
        named: dict[str, object] = {
            **ends,
            "c": claim,
            "p": phase,
            "s": (start := binary(time - room, bits)),
            "t": binary(time + room, bits, up=True),
            "k": math.floor((phase + start) / Fraction(math.tau)),
            "m": binary(float(low) - spare / 4, bits),
            "M": binary(float(high) + spare / 4, bits, up=True),
            "A": of.interval[0],
            "B": of.interval[1],
        }
        if claim == "H6":
            sets, image = (of.left, of.right), point.image
            named["A"], named["B"] = next(x for x in sets if x[0] < image[0] and image[1] < x[1])
            named["y"] = next(x[1] for x in sets if x[0] < phase < x[1])
        self.state(name, says, theorem_text.REFUTED[claim], (claim,), **named)

    def _spare(self, claim: str, slope: Range) -> float:
        """Return how far f' at a phase is from the bounds that it must keep to refute a claim."""
        least, greatest = self.plan.of.slopes
        zero = Fraction(0)
        limits = {"H1": [least], "H2": [greatest], "H3": [zero], "H6": [zero, least]}
        distances = [abs(end - limit) for limit in limits.get(claim, []) for end in slope]
        return float(min([Fraction(1), *distances]))

    def _moran(self, claim: str, name: str, says: str) -> None:
        """Write H11, a bracket of each root of Moran's equation, or H16."""
        if self.plan.verdicts[claim] is Verdict.REFUTED:
            return
        if claim == "H16":
            r0, r1 = self.plan.of.moran_ratios
            self.state(name, says, theorem_text.H16, (claim,), r0=r0, r1=r1)
        for number, root in enumerate(self.plan.roots if claim == "H11" else ()):
            ends = rounded_slopes(root.root, _PLACES)
            named = {"r0": root.ratios[0], "r1": root.ratios[1], "l": ends[0], "r": ends[1]}
            self.state(
                name + (f"_{number}" if number else ""), says, theorem_text.H11, (claim,), **named
            )

    def _preimages(self, name: str, says: str, ends: dict[str, Fraction]) -> None:
        """Write H5: I0 and I1 are mapped over I, or one of them misses an end of it."""
        printed = self.sets[-1]
        if self.plan.holds("H5"):
            self.covers(printed)
            named: dict[str, object] = {f"s{i}": f"({printed.sign(i)})" for i in (0, 1)}
            named |= {"m": min(printed.sizes(i)[0] for i in (0, 1)), "avoid": self.avoid["printed"]}
            self.state(name, says, theorem_text.H5_VERIFIED, ("H5",), **ends, **named)
            return
        for index, (x, y) in enumerate(printed.domains):
            where, sign = self.lap(index), printed.sign(index)
            images = [self.image(index, end) for end in (x, y)]
            missed = self._missed(min(images), max(images))
            if missed is not None:
                for end, phase in ((0, x), (1, y)):
                    self.impact(index, (phase, phase), f"missed{index}_{end}")
                named = {**ends, "i": index, "x": x, "y": y, "c": missed[0], "d": missed[1]}
                self.state(name, says, theorem_text.H5_REFUTED, ("H5",), **named, k=where["k"])
                if index == 0 and sign > 0 and missed[0] == x:
                    self._no_word(ends, self.laps[0])
                return
        raise NoHint("H5: no interval is seen to be missed")

    def _no_word(self, ends: dict[str, Fraction], lap: int) -> None:
        """Write that 000... has no point in the printed I0, if the horseshoe's contains that."""
        headline = self.plan.headline
        if (
            headline is None
            or headline.signs[0] < 0
            or not within(self.plan.of.left, headline.left)
        ):
            return
        says = f"H7 as printed fails: no orbit stays in I0 = {show_range(self.plan.of.left)}"
        self.state("no_word_000", says, theorem_text.NO_WORD, ("H7",), **ends, k=lap, **self.stated)

    def _missed(self, low: float, high: float) -> Range | None:
        """Return an interval in I0 or in I1 that an image from `low` to `high` misses."""
        left, right = self.plan.of.left, self.plan.of.right
        if low > left[0]:
            return left[0], short_decimal(left[0], min(Fraction(low), left[1]))
        if high < right[1]:
            return short_decimal(max(Fraction(high), right[0]), right[1]), right[1]
        return None

    def graphs(self) -> None:
        """Write the graphs of the sets that stay, beside the horseshoe."""
        sets = self.plan.sets
        others = sets[1:] if sets and sets[0].is_horseshoe else sets  # the first has its theorem
        for number, staying in enumerate(others, 1):
            try:
                graph(self, self.hints, number, staying)
            except NoHint as failure:
                self.left_out.append(f"graph{number}: {failure}")

    def write(self) -> None:
        """Write all lemmas and theorems."""
        self.state("model", theorem_text.MODEL_IN_WORDS, theorem_text.MODEL)
        self.slopes()
        self.leaving()
        if self.plan.headline is not None:
            self.horseshoe(self.plan.headline)
            if self.plan.orbit is not None:
                self.invariant(self.plan.headline, self.plan.orbit)
        self.claims()
        self.graphs()


def _widened(inner: Range, by: Fraction) -> Range:
    """Return an interval around another."""
    return (inner[0] - by) // by * by, -(-(inner[1] + by) // by) * by


def case(plan: Plan, digest: str) -> Case:
    """Return the Coq file of a plan."""
    writer = Theorems(plan)
    writer.write()
    bits = max(_BITS, 16 - math.floor(math.log2(writer.finest)))
    head = lemma_text.HEAD.format(
        digest=digest,
        bits=bits,
        **fields(side=writer.hints.side, eta=plan.of.eta, nu=plan.of.nu),
    )
    return writer.ended(head)

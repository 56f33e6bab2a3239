"""A second opinion: every inequality of a certificate in the checker's numbers and in Arb's.

A leaf is a quantity that a rule of proofs.trusted.flights needs positive, or only encloses. Both
kernels evaluate the shared equations on the certificate's exact data: the checker at the bits that
it chose, python-flint at several. Their enclosures must meet. From the root,
`python -m tests.proofs.trusted.second_opinion CERTIFICATE` prints every
leaf, those that one kernel decides and the other does not, and the checker's time by rule.
"""

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from itertools import pairwise
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

from flint import ctx

from proofs.trusted import flights as rules
from proofs.trusted.certificate import Reader, parameters_from_json, parse
from proofs.trusted.flights import FirstImpact, Motion
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.numbers import Range
from tests.proofs.trusted import second_reader
from tests.proofs.trusted.second_kernels import Arb, Checker, Kernel
from tests.proofs.trusted.second_map import NotAProof, thin

BITS = (53, 128, 256)
Known = dict[str, Any]


# -- leaves ----------------------------------------------------------------------------------------


class Leaf(NamedTuple):
    """A quantity of a step, over a motion, at the checker's bits; whether it must be positive."""

    rule: str
    step: str
    what: str
    motion: Motion | None
    bits: int
    needed: bool
    value: Callable[[Kernel], Range]


Part = tuple[str, bool, Callable[[Kernel], Range]]


def minus(value: Range) -> Range:
    return -value[1], -value[0]


def closed(kernel: Kernel, phases: Range, piece: Range) -> Range:
    """gap at the ends of a piece, less w^2/8 max(0, gap'')."""
    ends = [kernel.gap(phases, thin(end)) for end in piece]
    bend = [max(Fraction(0), end) for end in kernel.gap(phases, piece, 2)]
    part = (piece[1] - piece[0]) ** 2 / 8
    least = [min(end[i] for end in ends) for i in (0, 1)]
    return least[0] - part * bend[1], least[1] - part * bend[0]


def falls(kernel: Kernel, phases: Range, window: Range) -> Range:
    """-gap' on a window: what the mean value theorem leaves of its values at the ends."""
    width = window[1] - window[0]
    bend = kernel.gap(phases, window, 2)
    first, last = (kernel.gap(phases, thin(end), 1) for end in window)
    rise, fall = max(bend[1], Fraction(0)) * width, min(bend[0], Fraction(0)) * width
    most = min(first[1] + rise, last[1] - fall)
    return -most, -min(first[0], last[0], most)


def first_impact(conclusion: FirstImpact, phases: Range, times: list[Fraction]) -> Iterator[Part]:
    windows, first = conclusion.windows, (Fraction(0), times[0])
    yield "gap'' > 0 at launch", True, lambda kernel: kernel.gap(phases, first, 2)
    yield "gap < 0 at the end", True, lambda kernel: minus(kernel.gap(phases, thin(times[-1])))
    for piece in pairwise(times):
        name = f"closed {float(piece[0]):g} to {float(piece[1]):g}"
        is_open = any(start <= piece[0] and piece[1] <= end for start, end in windows)
        yield name, not is_open, lambda kernel, piece=piece: closed(kernel, phases, piece)
    if conclusion.transversal:
        yield "gap' < 0 on the window", True, lambda kernel: falls(kernel, phases, windows[0])


def bracket(phases: Range, time: Range) -> Iterator[Part]:
    name = " to ".join(f"{float(end):g}" for end in sorted({*phases}))
    yield f"gap > 0 before, {name}", True, lambda kernel: kernel.gap(phases, thin(time[0]))
    yield f"gap < 0 after, {name}", True, lambda kernel: minus(kernel.gap(phases, thin(time[1])))
    if phases[0] < phases[1]:
        yield f"f'' on {name}", False, lambda kernel: kernel.curvature(phases, time)
    else:
        yield f"f' at {name}", False, lambda kernel: kernel.slope(phases, time)
        yield f"f at {name}", False, lambda kernel: kernel.image(phases[0], time)


def misses(kernel: Kernel, phases: Range, window: Range, target: Range) -> Range:
    """The distance of phases + window from target + 2 pi k, for the k before and after it."""
    early, late = phases[0] + window[0] - target[1], phases[1] + window[1] - target[0]
    count = int(early // kernel.turns(1)[1])
    before, after = kernel.turns(count), kernel.turns(count + 1)
    return min(early - before[1], after[0] - late), min(early - before[0], after[1] - late)


def moran(kernel: Kernel, ratios: Range, exponent: Fraction) -> Range:
    """r0^s + r1^s - 1."""
    powers = [kernel.power(ratio, exponent) for ratio in ratios]
    return sum(low for low, _ in powers) - 1, sum(high for _, high in powers) - 1


def parts_of(rule: str, conclusion: Any, data: Any, known: Known) -> Iterator[tuple[Any, ...]]:
    """The leaves of a step: motion, bits, and a Part."""
    if rule == "first-impact":
        for part in first_impact(conclusion, *data):
            yield conclusion.motion, conclusion.motion.bits, part
    elif rule in ("point", "slope-range"):
        points, pieces = ([data], []) if rule == "point" else data
        brackets = [(flight, thin(phase), time) for flight, phase, time in points]
        ends = pairwise(phase for _, phase, _ in points)
        brackets += [(flight, end, time) for (flight, time), end in zip(pieces, ends, strict=True)]
        for flight, phases, time in brackets:
            motion, _ = rules.bracketed(known[flight], phases, Reader(list(map(str, time))))
            for part in bracket(phases, time):
                yield motion, motion.bits, part
    elif rule == "avoids":
        for flight in map(known.get, data[0]):
            for window in flight.windows:
                value = partial(misses, phases=flight.motion.phases, window=window, target=data[1])
                name = f"missed from {float(window[0]):g} to {float(window[1]):g}"
                yield None, rules.COVER_BITS, (name, True, value)
    else:
        ratios, root = data
        for end, sign in zip(root, (1, -1), strict=True):
            value = partial(moran, ratios=ratios, exponent=end)
            signed = value if sign > 0 else lambda kernel, value=value: minus(value(kernel))
            yield None, rules.bits_for(root), (f"sum at s = {float(end):g}", True, signed)


class Opinion(NamedTuple):
    """A leaf and both kernels' enclosures, None where there is none."""

    leaf: Leaf
    own: Range | None
    arbs: dict[int, Range | None]

    def decides(self, value: Range | None) -> bool:
        """Whether an enclosure has one sign."""
        return value is not None and (value[0] > 0 or (value[1] < 0 and not self.leaf.needed))

    def contradicted(self) -> bool:
        """Whether an enclosure of one kernel misses that of the other."""
        pairs = [(self.own, value) for value in self.arbs.values()]
        return any(a and b and (a[1] < b[0] or b[1] < a[0]) for a, b in pairs)

    def differs(self) -> list[int]:
        """The bits at which Arb decides and the checker does not, or the other way round."""
        own = self.decides(self.own)
        return [bits for bits, value in self.arbs.items() if self.decides(value) != own]


def evaluate(leaf: Leaf, kernel: Kernel) -> Range | None:
    try:
        return leaf.value(kernel)
    except (Unproved, NotAProof):
        return None


def steps_of(text: str) -> Iterator[tuple[str, str, Any, Known, float]]:
    """The steps with their exact data, the checker's conclusions so far, and its seconds."""
    _, parameters, steps, _, _ = parse(text).fields(
        "schema", "parameters", "steps", "claims", "corrected"
    )
    of, known = parameters_from_json(parameters), {}
    data = second_reader.read_whole(text)[1]
    for name, step in steps.members():
        rule, witness = step.fields("rule", "witness")
        started = perf_counter()
        known[name] = rules.RULES[rule.string()](of, known, witness)
        yield name, rule.string(), data[name][1], known, perf_counter() - started


def opinions(text: str, precisions: tuple[int, ...] = BITS) -> Iterator[Opinion]:
    """Both kernels' answers on every leaf of an accepted certificate."""
    before = ctx.prec
    try:
        for name, rule, data, known, _ in steps_of(text):
            for motion, bits, part in parts_of(rule, known[name], data, known):
                leaf = Leaf(rule, name, part[0], motion, bits, *part[1:])
                arbs = {prec: evaluate(leaf, Arb(motion, prec)) for prec in precisions}
                yield Opinion(leaf, evaluate(leaf, Checker(motion, bits)), arbs)
    finally:
        ctx.prec = before


# -- the table -------------------------------------------------------------------------------------


def margin(value: Range | None) -> str:
    """An enclosure in short: its lower end, or both where they differ much."""
    if value is None:
        return "none"
    low, high = map(float, value)
    return f"{low:.3g}" if high - low < abs(low) / 1000 else f"{low:.3g} to {high:.3g}"


def table(found: list[Opinion]) -> str:
    """Every leaf as a row of Markdown."""
    rows = ["| rule | step | leaf | bits | checker | "]
    rows[0] += " | ".join(f"Arb {bits}" for bits in BITS) + " |"
    rows.append("|---" * (5 + len(BITS)) + "|")
    for opinion in found:
        leaf = opinion.leaf
        values = [opinion.own, *opinion.arbs.values()]
        answers = [f"{margin(v)}{'' if opinion.decides(v) else ' ?'}" for v in values]
        rows.append(f"| {' | '.join([*leaf[:3], str(leaf.bits), *answers])} |")
    return "\n".join(rows)


def summary(text: str, found: list[Opinion]) -> str:
    """How often the kernels agree, and the checker's time a leaf and by rule."""
    lines = [f"{len(found)} leaves, {sum(o.contradicted() for o in found)} contradictions"]
    for bits in BITS:
        one = [o for o in found if bits in o.differs()]
        told = "; ".join(f"{o.leaf.step}: {o.leaf.what}" for o in one) or "none"
        lines.append(f"decided by one kernel only, Arb at {bits} bits: {len(one)} ({told})")
    spent: Counter[str] = Counter()
    for _, rule, _, _, seconds in steps_of(text):
        spent[rule] += seconds
    for rule, seconds in spent.items():
        leaves = sum(o.leaf.rule == rule for o in found)
        lines.append(
            f"{rule}: {leaves} leaves, {1e3 * seconds:.2f} ms, {1e6 * seconds / leaves:.0f} us a "
            f"leaf, {seconds / spent.total():.0%} of the checker's time in rules"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    certificate = Path(sys.argv[1]).read_text()
    all_found = list(opinions(certificate))
    print(table(all_found))
    print(summary(certificate, all_found))

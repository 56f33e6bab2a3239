"""What follows from steps: the table of claims of proofs/CERTIFICATE.md, typed from that page."""

from fractions import Fraction

from tests.proofs.trusted.second_map import within

BELOW_TURN = Fraction("6.283185307")


class Facts:
    """What the steps of a proof, (rule, conclusion), say about the parameters."""

    def __init__(self, of, steps):
        self.of, self.sides = of, (of.left, of.right)
        self.slopes, self.roots, self.escape = [None, None], [None, None], False
        self.reciprocals = (1 / of.slopes[1], 1 / of.slopes[0])
        self.ratios = of.ratios or self.reciprocals
        for rule, conclusion in steps:
            if rule == "slope-range":
                for index, side in enumerate(self.sides):
                    self.slopes[index] = slopes_of(side, *conclusion) or self.slopes[index]
            elif rule == "avoids":
                union, target = conclusion
                whole = within((of.left[1], of.right[0]), union) and within(of.interval, target)
                self.escape = self.escape or whole
            elif rule == "moran-root":
                for index, ratios in enumerate((self.ratios, self.reciprocals)):
                    if conclusion[0] == ratios:
                        self.roots[index] = conclusion[1]

    def short(self, index):
        least, most, *_ = self.slopes[index]
        low, high = self.sides[index]
        return max(-least[0], most[1]) * (high - low) < BELOW_TURN

    def arc(self, index):
        """The enclosures of both ends of the arc of I0 or I1, or None."""
        if not self.slopes[index] or not self.short(index):
            return None
        least, most, *ends = self.slopes[index]
        if any(end[1] >= BELOW_TURN for end in ends):
            return None
        return ends if least[0] > 0 else ends[::-1] if most[1] < 0 else None

    def quantities(self, claim):
        """The enclosures that a claim may report."""
        if claim == "H11":
            names = ("s0", "s0_reciprocal_slopes")
            return dict(zip(names, self.roots, strict=True)) if all(self.roots) else {}
        found = {}
        for side, facts in zip(("I0", "I1"), self.slopes, strict=True):
            names = ("slope_min", "slope_max", "image_left", "image_right")
            found |= {
                f"{name}_{side}": fact for name, fact in zip(names, facts or (), strict=False)
            }
        kind = {"H1": "slope_min", "H3": "slope_min", "H6": "slope_min", "H2": "slope_max"}
        kind = kind.get(claim, "image" if claim == "H5" else "none")
        return {name: fact for name, fact in found.items() if name.startswith(kind)}


def slopes_of(side, points, pieces):
    """Enclosures of min f', of max f', and of the images of both ends; or None."""
    marks = [phase for phase, _, _ in points]
    if not set(side) <= set(marks):
        return None
    first, last = map(marks.index, side)
    at_points = [slope for _, slope, _ in points[first : last + 1]]
    least = (min(low for low, _ in pieces[first:last]), min(high for _, high in at_points))
    most = (max(low for low, _ in at_points), max(high for _, high in pieces[first:last]))
    return least, most, points[first][2], points[last][2]


def interior(inner, outer):
    return outer[0] < inner[0] and inner[1] < outer[1]


def verified(claim, facts):
    """Whether the facts prove one of H1 to H6."""
    lo, hi = facts.of.slopes
    if claim == "H4":
        return facts.escape
    if not all(facts.slopes):
        return False
    if claim == "H5":
        whole, arcs = facts.of.interval, [facts.arc(0), facts.arc(1)]
        cover = all(arc and arc[0][1] <= whole[0] and whole[1] <= arc[1][0] for arc in arcs)
        return cover and facts.escape and whole == (facts.of.left[0], facts.of.right[1])
    least = min(slopes[0][0] for slopes in facts.slopes)
    most = max(slopes[1][1] for slopes in facts.slopes)
    return {
        "H1": least >= lo,
        "H2": most <= hi,
        "H3": least > 0,
        "H6": least > lo and facts.short(0) and facts.short(1),
    }[claim]


def refuted(claim, facts, point=None, missed=None):
    """Whether a point (phase, f', f), or an interval, refutes one of H1 to H6."""
    (lo, hi), sides = facts.of.slopes, facts.sides
    if claim == "H5" and missed:
        arcs = [arc for arc in (facts.arc(0), facts.arc(1)) if arc and arc[0][1] < arc[1][0]]
        off = any(missed[1] < first[0] or last[1] < missed[0] for first, last in arcs)
        return missed[0] < missed[1] and any(within(missed, side) for side in sides) and off
    if claim == "H5" or not point:
        return False
    phase, slope, image = point
    if claim == "H4":
        return sides[0][1] < phase < sides[1][0] and within(image, facts.of.interval)
    return (
        any(side[0] < phase < side[1] for side in sides)
        and {
            "H1": slope[1] < lo,
            "H2": slope[0] > hi,
            "H3": slope[1] < 0,
            "H6": slope[0] > 0 and slope[1] < lo and any(interior(image, side) for side in sides),
        }[claim]
    )


def verdict(claim, facts, point=None, missed=None):
    if claim in ("H11", "H16"):
        return of_dimension(claim, facts)
    if refuted(claim, facts, point, missed):
        return "REFUTED"
    return "VERIFIED" if verified(claim, facts) else "UNDECIDED"


def rounds_to(value, ratio):
    places = next((k for k in range(41) if ratio * 10**k % 1 == 0), None)
    near = places is not None and 2 * abs(value - ratio) < Fraction(1, 10**places)
    return near or value == ratio


def of_dimension(claim, facts):
    """The verdict on H11 or H16."""
    if max(facts.ratios) >= 1:
        return "REFUTED"
    if claim == "H16":
        return "VERIFIED" if sum(facts.ratios) < 1 else "REFUTED"
    if not all(map(rounds_to, facts.reciprocals, facts.ratios)):
        return "REFUTED"
    return of_digits(facts.of.printed_s0, facts.roots) if all(facts.roots) else "UNDECIDED"


def of_digits(printed, roots):
    if printed is None:
        return "VERIFIED"
    value, unit = Fraction(printed), Fraction(1, 10 ** len(printed.partition(".")[2]))
    if all(interior(root, (value - unit / 2, value + unit / 2)) for root in roots):
        return "VERIFIED"
    off = all(low >= value + unit or high <= value - unit / 2 for low, high in roots)
    return "REFUTED" if off else "UNDECIDED"

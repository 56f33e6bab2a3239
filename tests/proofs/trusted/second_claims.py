"""What follows from steps: the claims on I0 and I1, typed from what they say."""

from fractions import Fraction

from tests.proofs.trusted.second_map import within

BELOW_TURN = Fraction("6.283185307")


class Facts:
    """What the steps of a proof, (rule, conclusion), say about the parameters."""

    def __init__(self, of, steps):
        self.of, self.sides = of, (of.left, of.right)
        self.slopes, self.roots, self.escape = [None, None], [None, None], False
        self.points = []
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
            elif rule == "point":
                self.points.append(conclusion)
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
        if any(end[1] > BELOW_TURN for end in ends):
            return None
        return ends if least[0] > 0 else ends[::-1] if most[1] < 0 else None

    def quantities(self, claim):
        """The enclosures that a claim may report."""
        if claim == "H11":
            names = ("s0", "s0_reciprocal_slopes")
            return dict(zip(names, self.roots, strict=True)) if all(self.roots) else {}
        if claim == "H5":
            arcs = [(f"I{i}", self.arc(i)) for i in (0, 1) if self.arc(i)]
            names = ("image_low", "image_high")
            pairs = [(side, zip(names, arc, strict=True)) for side, arc in arcs]
        else:
            known = all(self.slopes) and claim in ("H1", "H2", "H3", "H6")
            names = ("slope_min", "slope_max")
            pairs = [
                (f"I{i}", zip(names, self.slopes[i][:2], strict=True)) for i in (0, 1) if known
            ]
        return {f"{name}_{side}": ends for side, named in pairs for name, ends in named}


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


def verified(claim, facts, closed=False):
    """Whether the facts prove one of H1 to H6; closed: H6 with <= for <, as in a horseshoe."""
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
        "H6": (least >= lo if closed else least > lo) and facts.arc(0) and facts.arc(1),
    }[claim]


def missed(facts):
    """Whether an image misses an interval at the lower end of I0, or the upper one of I1."""
    arcs = [arc for arc in (facts.arc(0), facts.arc(1)) if arc and arc[0][1] < arc[1][0]]
    return any(facts.sides[0][0] < first[0] or last[1] < facts.sides[1][1] for first, last in arcs)


def refuted(claim, facts):
    """Whether a point (phase, f', f), or an interval, refutes one of H1 to H6."""
    if claim == "H5":
        return missed(facts)
    return any(refutes(claim, facts, *point) for point in facts.points)


def refutes(claim, facts, phase, slope, image):
    (lo, hi), sides = facts.of.slopes, facts.sides
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


def verdict(claim, facts):
    if claim in ("H11", "H16"):
        return of_dimension(claim, facts)
    if refuted(claim, facts):
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
    nearest = [side(root, value - unit / 2, value + unit / 2, open_below=True) for root in roots]
    first = [side(root, value, value + unit, open_below=False) for root in roots]
    if None in nearest + first or len({*nearest}) > 1 or len({*first}) > 1:
        return "UNDECIDED"
    return {2: "VERIFIED", 1: "CONDITIONAL", 0: "REFUTED"}[nearest[0] + first[0]]


def side(root, low, high, open_below):
    """Whether a bracket lies in [low, high), or (low, high); None: partly."""
    inside = [(x > low or (x == low and not open_below)) and x < high for x in root]
    if all(inside):
        return True
    above = all(x >= high for x in root)
    below = all(x < low or (x == low and open_below) for x in root)
    return False if above or below else None

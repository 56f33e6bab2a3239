"""Lemma files made by the prover: textbook maps, and the gap of the impact model."""

from functools import cache
from typing import Any

from proofs.methods.lemmas import Lemmas
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.certificate import render
from proofs.trusted.equations import AT_LAUNCH, clock, gap, launch, launch_acceleration, slope

LOGISTIC = (["x"], [["*", "5", "x", ["-", "1", "x"]]])
CUBIC = (["x"], [["+", ["-", ["^", "x", "3"], ["*", "3", "x"]], "1"]])


def henon(a, b):
    return (["x", "y"], [["+", ["-", "1", ["*", a, ["^", "x", "2"]]], "y"], ["*", b, "x"]])


HENON_FIXED = (
    ["x", "y"],
    [
        ["-", ["+", ["-", "1", ["*", "7/5", ["^", "x", "2"]]], "y"], "x"],
        ["-", ["*", "3/10", "x"], "y"],
    ],
)


class Written:
    """A number type that writes down what is computed: the shared equations as an expression."""

    def __init__(self, expression: Any) -> None:
        self.expression = expression

    def _with(self, op, other, swapped=False):
        pair = [self.expression, other.expression if isinstance(other, Written) else str(other)]
        return Written([op, *(pair[::-1] if swapped else pair)])

    def __add__(self, other):
        return self._with("+", other)

    def __radd__(self, other):
        return self._with("+", other, True)

    def __sub__(self, other):
        return self._with("-", other)

    def __rsub__(self, other):
        return self._with("-", other, True)

    def __mul__(self, other):
        return self._with("*", other)

    def __rmul__(self, other):
        return self._with("*", other, True)

    def __truediv__(self, other):
        return self._with("/", other)

    def __pow__(self, n):
        return Written(["^", self.expression, str(n)])

    def __neg__(self):
        return Written(["-", self.expression])

    def sincos(self):
        return Written(["sin", self.expression]), Written(["cos", self.expression])


def impact_gap():
    """The gap, its derivatives in time, the slope theorem of `proofs.trusted.equations.slope`."""
    eta, nu, phi, t = map(Written, ("eta", "nu", "phi", "t"))
    start, now = launch(1, eta, nu, phi), clock(eta, t)
    g, rate, acceleration = (gap(start, now, order) for order in range(3))
    right = now.mass_sin / eta * launch_acceleration(start)
    values = (g, rate, acceleration, rate - right, slope(start, now) * rate, right)
    launched = gap(start, AT_LAUNCH, 2)
    return ["eta", "nu", "phi", "t"], [*(v.expression for v in values), launched.expression]


# -- the files -------------------------------------------------------------------------------------


def logistic():
    """x -> 5 x (1 - x): a full horseshoe of two intervals, its expansion and entropy."""
    file = SymbolicLemmas({"F": LOGISTIC})
    sets = [file.h_set([centre], [["3/20"]]) for centre in ("7/50", "43/50")]
    graph = file.graph([file.covers("F", 1, a, b) for a in sets for b in sets])
    file.entropy(graph)
    file.cone(graph, ["1"])
    for interval in (["-1/100", "29/100"], ["71/100", "101/100"]):
        claim = {"function": "F", "interval": interval, "bound": "209/100"}
        file.inequality("expansion", claim)
    return file


def henon_fixed_points():
    """Both fixed points of the Henon map at a = 1.4, b = 0.3, and a box without any."""
    file = Lemmas({"P": HENON_FIXED})
    file.unique_zero("P", ["0.63", "0.19"], "1/100")
    file.unique_zero("P", ["-1.13", "-0.34"], "1/100")
    file.no_zero("P", [("-1", "1/2"), ("-1", "1")])
    return file


def henon_horseshoe():
    """The Henon map at a = 5, b = 0.3: a full horseshoe, conjugate to the two-sided shift."""
    file = SymbolicLemmas({"F": henon("5", "3/10")})
    rows = [["47/200", "0"], ["0", "1/5"]]
    sets = [file.h_set([x, "0"], rows) for x in ("-77/200", "77/200")]
    graph = file.graph([file.covers("F", 1, a, b) for a in sets for b in sets])
    file.entropy(graph)
    file.cone(graph, ["1", "-2"])
    return file


def golden_mean():
    """x -> 3.9 x (1 - x) with the arrows 12, 21, 22: entropy of the golden mean."""
    file = SymbolicLemmas({"F": (["x"], [["*", "39/10", "x", ["-", "1", "x"]]])})
    one, two = file.h_set(["61/200"], [["27/200"]]), file.h_set(["303/400"], [["79/400"]])
    graph = file.graph([file.covers("F", 1, a, b) for a, b in ((one, two), (two, one), (two, two))])
    file.entropy(graph, 24)
    return file


def second_iterate():
    """The logistic horseshoe under its second iterate: one set, one arrow."""
    file = SymbolicLemmas({"F": LOGISTIC})
    low = file.h_set(["1/20"], [["3/50"]])
    file.graph([file.covers("F", 2, low, low)])
    return file


def cubic():
    """x^3 - 3 x + 1: three roots, each in an interval where the cubic is monotone."""
    file = Lemmas({"F": CUBIC})
    base = {"function": "F", "component": "1", "variable": "x"}
    for box, sign in ((["-2", "-11/10"], "+"), (["-9/10", "9/10"], "-"), (["11/10", "2"], "+")):
        name = file.inequality("monotone", {**base, "box": [box], "sign": sign})
        file.root(name)
    file.zero("F", 1, ("-2", "2"))
    claim = {"function": "F", "component": "1", "box": [["8/5", "3"]], "sign": "+"}
    file.inequality("sign", claim)
    file.inequality(
        "range", {**base, "variable": None, "box": [["-2", "2"]], "bounds": ["-2", "4"]}
    )
    file.inequality("range", {**base, "box": [["-1", "2"]], "bounds": ["-4", "10"]})
    return file


def gap_identities():
    """d gap / dt, d^2 gap / dt^2, and d gap / dt - d gap / d phi, by exact normal forms."""
    file = Lemmas({"G": impact_gap()})
    file.identity("G", 1, 2, ["t"])
    file.identity("G", 2, 3, ["t"])
    file.identity("G", 1, 3, ["t", "t"])
    file.identity("G", 1, 4, ["phi"])
    file.identity("G", 5, 6)
    return file


def refutations():
    """False inequalities, each with a point."""
    file = Lemmas({"F": CUBIC, "S": (["x", "y"], [["-", ["sin", "x"], "y"]])})
    base = {"function": "F", "component": "1"}
    sign = {**base, "box": [["0", "1"]], "sign": "+"}
    file.refute_at("sign", sign, ["1/2"])
    monotone = {**base, "variable": "x", "box": [["-2", "2"]], "sign": "+"}
    file.refute_at("monotone", monotone, ["0"])
    bounds = {**base, "variable": None, "box": [["-2", "2"]], "bounds": ["-2", "1"]}
    file.refute_at("range", bounds, ["2"])
    expansion = {"function": "F", "interval": ["-2", "2"], "bound": "3/2"}
    file.refute_at("expansion", expansion, ["1"])
    below = {"function": "S", "component": "1", "box": [["0", "2"], ["0", "1"]], "sign": "-"}
    file.refute_at("sign", below, ["3/2", "99/100"])
    return file


EXAMPLES = {
    "logistic": logistic,
    "henon_fixed_points": henon_fixed_points,
    "henon_horseshoe": henon_horseshoe,
    "golden_mean": golden_mean,
    "second_iterate": second_iterate,
    "cubic": cubic,
    "gap_identities": gap_identities,
    "refutations": refutations,
}


@cache
def text(name):
    """The text of an example's file."""
    return render(EXAMPLES[name]().document())

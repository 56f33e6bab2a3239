"""Lemma files made by the prover: textbook maps, and the gap of the impact model."""

from fractions import Fraction
from functools import cache

import sympy

from proofs.methods.arcs import follow, thin
from proofs.methods.branches import add_arc, over, residual
from proofs.methods.derivation import Derivation
from proofs.methods.lemmas import Lemmas
from proofs.methods.symbolic import SymbolicLemmas
from proofs.trusted.equations import (
    AT_LAUNCH,
    clock,
    gap,
    launch,
    launch_acceleration,
    registered_sincos,
    slope,
)
from proofs.trusted.files import render
from proofs.trusted.kernel.values import Equal, Series
from tests.proofs.trusted.kernel.lines import Lines
from tests.proofs.trusted.kernel.systems import BALL, DAMPED, FAR, RATTLE, RATTLE_BACK, RESTING

LOGISTIC = (["x"], ["5*x*(1 - x)"])
CUBIC = "x**3 - 3*x + 1"


def henon(a, b):
    return (["x", "y"], [f"1 - {a}*x**2 + y", f"{b}*x"])


registered_sincos.register(sympy.Expr, lambda x: (sympy.sin(x), sympy.cos(x)))
HENON_FIXED = (["x", "y"], ["1 - 7/5*x**2 + y - x", "3/10*x - y"])


# -- the files -------------------------------------------------------------------------------------


def logistic():
    """x -> 5 x (1 - x): a full horseshoe of two intervals, its expansion and entropy."""
    file = SymbolicLemmas({"F": LOGISTIC})
    sets = [file.h_set([centre], [["3/20"]]) for centre in ("7/50", "43/50")]
    graph = file.graph([file.covers("F", 1, a, b) for a in sets for b in sets])
    file.entropy(graph)
    file.cone(graph, ["1"])
    slope_of = f"D({LOGISTIC[1][0]}, x)"
    file.value(slope_of, ("209/100", "6"), x=("-1/100", "29/100"))
    file.value(slope_of, ("-6", "-209/100"), x=("71/100", "101/100"))
    return file


def henon_fixed_points():
    """Both fixed points of the Henon map at a = 1.4, b = 0.3, and a box without any."""
    file = Lemmas({"P": HENON_FIXED})
    file.unique_zero("P", ["0.63", "0.19"], "1/100")
    file.unique_zero("P", ["-1.13", "-0.34"], "1/100")
    first, second = HENON_FIXED[1]
    file.sign(f"({first})**2 + ({second})**2", 1, x=("-1", "1/2"), y=("-1", "1"))
    return file


def circle():
    """An arc of the unit circle, a graph over x, that passes (3/5, 4/5)."""
    file = Lemmas({"C": (["x", "y"], ["x**2 + y**2 - 1"])})
    formula, start, place = file.function("C"), [Fraction(-3, 5), Fraction(4, 5)], Fraction(3, 5)
    traced = follow(formula, 0, start, Fraction(4, 5), step=Fraction(1, 5))
    point = thin(formula, 0, [place, Fraction(4, 5)], 20)[1]
    pieces = [each.witness for each in traced]
    file.add("arc", {"function": "C", "axis": "x", "pieces": pieces, "points": [point]})
    return file


def henon_orbits():
    """All periodic orbits of the Henon map with periods 1, 2 and 4."""
    file = SymbolicLemmas({"F": henon("7/5", "3/10")})
    file.periodic_orbits("F", 4, [("-1.43", "1.43"), ("-0.43", "0.43")])
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
    file = SymbolicLemmas({"F": (["x"], ["39/10*x*(1 - x)"])})
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
    """x^3 - 3 x + 1: where it is monotone, bounds."""
    file = Lemmas()
    for side, sign in ((("-2", "-11/10"), 1), (("-9/10", "9/10"), -1), (("11/10", "2"), 1)):
        file.sign(f"D({CUBIC}, x)", sign, x=side)
    file.value(CUBIC, ("-2", "4"), x=("-2", "2"))
    file.sign(CUBIC, 1, x=("8/5", "3"))
    file.value(f"D({CUBIC}, x)", ("-4", "10"), x=("-1", "2"))
    return file


def gap_identities():
    """d gap / dt, d^2 gap / dt^2, and d gap / dt - d gap / d phi, by exact normal forms."""
    eta, nu, phi, t = sympy.symbols("eta nu phi t")
    start, now = launch(1, eta, nu, phi), clock(eta, t)
    g, rate, acceleration = (gap(start, now, order) for order in range(3))
    right = now.mass_sin / eta * launch_acceleration(start)
    file = Lemmas()
    file.equal(f"D({g}, t)", str(rate))
    file.equal(f"D({rate}, t)", str(acceleration))
    file.equal(f"D({g}, t, t)", str(acceleration))
    file.equal(f"D({g}, phi)", str(rate - right))
    file.equal(f"({slope(start, now)})*({rate})", str(right))
    file.equal(f"at({acceleration}, t=0)", str(gap(start, AT_LAUNCH, 2)))
    return file


def refutations():
    """What contradicts false inequalities: values at points, one exact; and a series."""
    file = Lemmas()
    file.value(CUBIC, ("-3/8", "-3/8"), x=("1/2", "1/2"))
    file.value(f"D({CUBIC}, x)", ("-3", "-3"), x=("0", "0"))
    file.value("3*x - 1", ("0", "0"), x=("1/3", "1/3"))
    file.sign("sin(x) - y", 1, x=("3/2", "3/2"), y=("99/100", "99/100"))
    file.series("sin(x)/x", "x", "1", "0", "-1/6")
    return file


def flips():
    """The logistic map flips at r = 3, with the normal form of a stable cycle of period two."""
    file = Lemmas()
    step = "x1 - r*x*(1 - x)"
    reduced = "-h + b2*h**2 + b3*h**3"
    file.solution(
        {"x": "2/3", "r": "3", "b2": "-3", "b3": "0", "c": "9"},
        Equal.read(f"at({step}, x1=x)", "0"),
        Series.read(f"at({step}, x=x + h, x1=x + ({reduced}))", "h", ("0",) * 4),
        Equal.read("b2**2 + b3", "c"),
    )
    file.solution(
        {"c": "-x**2/4", "d": "-x"},
        Equal.read("x**2 + 4*c", "0"),
        Series.read("sin(h*d)/d", "h", ("0", "1", "0", "-d**2/6"), ("x",)),
    )
    return file


def add_orbit(file, period, box, matrix, turns):
    """A step `periodic-orbit` of the map P with one angle."""
    rows = [[str(Fraction(entry)) for entry in row] for row in matrix]
    witness = {"function": "P", "period": str(period), "box": box, "matrix": rows}
    return file.add("periodic-orbit", {**witness, "turns": [turns]})


def horseshoe(file):
    """Words of two letters over two saddles of the ball on a table: four sets, entropy log 2."""
    sets = {}
    for word, centre, (u, v), (s, w) in (
        ("00", ("1.019727", "1.570796"), ("-0.793", "1"), ("1", "-0.0676")),
        ("11", ("-1.019727", "1.570796"), ("-0.773", "-1"), ("-1", "0.0658")),
        ("01", ("1.158856", "1.411681"), ("-0.738", "1"), ("1", "-0.0646")),
        ("10", ("-0.876519", "1.722933"), ("0.857", "1"), ("1", "-0.0684")),
    ):
        columns = [(Fraction(u), Fraction(v)), (Fraction(s), Fraction(w))]
        sides = Fraction("0.014"), Fraction("0.04")
        rows = [
            [x * r for x, r in zip(row, sides, strict=True)] for row in zip(*columns, strict=True)
        ]
        sets[word] = file.h_set(centre, rows)
    arrows = [(a, b) for a in sets for b in sets if a[1] == b[0]]
    return file.entropy(file.graph([file.covers("P", 1, sets[a], sets[b]) for a, b in arrows]))


def ball():
    """A ball on a vibrating table: a saddle of three periods, and its cones."""
    file = SymbolicLemmas({"P": BALL})
    box = [["10009/8000", "50053/40000"], ["471189/500000", "471289/500000"]]
    add_orbit(file, 1, box, [["-1.0351", "-0.7022"], ["0.0667", "0"]], "3")
    rows = [["-71/40000", "1/400"], ["1/400", "-67/400000"]]
    around = file.h_set(["1251/1000", "471/500"], rows)
    graph = file.graph([file.covers("P", 1, around, around)])
    file.cone(graph, ["1", "-4"])
    box, bounds = [["1", "1001/1000"], ["3/2", "3/2"]], [["31", "32"], ["2", "5/2"]]
    file.add("image", {"function": "P", "box": box, "tree": None, "bounds": bounds})
    return file


def rattle():
    """A tooth between two walls, for all restitutions of a range: an attracting orbit."""
    more = {"parameters": {**RATTLE["parameters"], "e": ["3/5", "60001/100000"]}}
    walls = {"U": {**RATTLE, **more}, "V": {**RATTLE_BACK, **more}}
    file = SymbolicLemmas({**walls, "P": {"maps": ["U", "V"]}})
    box = [["-39433/50000", "-39333/50000"], ["6267/12500", "1573/3125"]]
    add_orbit(file, 1, box, [["-0.6181", "-1.8879"], ["0.0433", "-1.0784"]], "1")
    return file


def rectangles():
    """Two rectangles that a cubic map takes across both, a word without orbits, an attractor."""
    maps = {"F": ["16*x**3 - 8*x + y/50", "x/20"], "G": ["33/10*x*(1 - x) + y/100", "x/50"]}
    file = SymbolicLemmas({name: (["x", "y"], values) for name, values in maps.items()})

    def rectangle(low, high, cuts):
        ends = [
            Fraction(low) + (Fraction(high) - Fraction(low)) * k / cuts for k in range(cuts + 1)
        ]
        box = [[low, high], ["-1/4", "1/4"]]
        return file.add(
            "rectangle", {"function": "F", "box": box, "cuts": list(map(str, ends[1:-1]))}
        )

    both = [rectangle("-4/5", "-3/5", 16), rectangle("3/5", "4/5", 16)]
    arrows = [["1", "2"], ["1", "2"]]
    file.add("horseshoe", {"rectangles": both, "arrows": arrows, "cone": ["0", "1"]})
    beyond = rectangle("19/25", "4/5", 4)
    file.add("barred-word", {"rectangles": [beyond], "word": ["1", "1"], "from": "below"})
    box = [["3/5", "4/5"], ["-1/4", "1/4"]]
    file.add("differential", {"function": "F", "box": box, "bits": "64"})
    box = [["8237/10000", "4119/5000"], ["19/2000", "97/10000"]]
    matrix = [["-1", "0"], ["0", "-1"]]
    orbit = {"function": "G", "period": "2", "box": box, "matrix": matrix}
    file.add("stable-cycle", {"orbit": orbit, "rounds": "2"})
    return file


def outcomes():
    """No further impact from a wall out of reach; a ball at rest; a graze of a wall."""
    file = SymbolicLemmas({"F": FAR, "R": RESTING, "P": BALL, "G": DAMPED})
    box = [["0", "1/50"], ["-1/10", "-9/100"]]
    file.add("no-impact", {"function": "F", "box": box, "tree": None, "time": "32"})
    file.add("pressed", {"function": "R", "box": [["-6/5", "1/2"]], "tree": None})
    file.add(
        "pressed",
        {"function": "P", "box": [["0", "1"], ["1/2", "1/2"]], "tree": ["1", "1/2", None, None]},
    )
    box = [["0", "0"], ["-208180717/100000000", "-41636143/20000000"]]
    file.add("graze", {"function": "G", "box": box, "axis": "2", "time": ["2519/1000", "1261/500"]})
    return file


def flight_arcs():
    """Launches of an oscillator after which it touches the wall; a ball's fixed points over g."""
    speed, half = over(DAMPED, ["v", "phi"], ["D(s - x, t)"]), (Fraction(0), Fraction(1, 2))
    file = Derivation({"G": speed, "B": residual(BALL, ["g"], [1])})
    add_arc(file, "G", [*map(Fraction, ("-2.08", "0", "2.52"))], half, 2)
    place = [*map(Fraction, ("1.466", "0.314", "0.1", "6.283"))]
    add_arc(file, "B", place, (Fraction(1, 10), Fraction(1, 5)), 2)
    return file


def trapping():
    """Two boxes side by side whose images lie across their common side; a map of a cylinder."""
    turning = {"variables": ["a", "v"], "periods": {"a": "2*pi"}}
    file = Lemmas(
        {
            "F": (["x", "y"], ["x/4 + 3/4", "(x + sin(y))/4 + 1/8"]),
            "G": {**turning, "values": ["a + v", "v/2 + sin(a)/4"]},
        }
    )

    def image(function, box, bounds):
        witness = {"function": function, "box": box, "tree": None, "bounds": bounds}
        return file.add("image", witness)

    left, right = ([[low, high], ["0", "1"]] for low, high in (("0", "1"), ("1", "2")))
    first = image("F", left, [["3/4", "1"], ["1/10", "3/5"]])
    last = image("F", right, [["1", "5/4"], ["3/10", "7/8"]])
    ring = image("G", [["0", "7"], ["-1", "1"]], [["-1", "8"], ["-4/5", "4/5"]])
    for images in ([first, last], [ring]):
        file.add("trapping", {"images": images})
    return file


EXAMPLES = {
    "flight_arcs": flight_arcs,
    "trapping": trapping,
    "outcomes": outcomes,
    "lines": Lines,
    "rectangles": rectangles,
    "ball": ball,
    "rattle": rattle,
    "flips": flips,
    "logistic": logistic,
    "henon_fixed_points": henon_fixed_points,
    "circle": circle,
    "henon_orbits": henon_orbits,
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

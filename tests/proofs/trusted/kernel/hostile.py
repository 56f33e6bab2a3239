"""Files that would keep a checker busy, each of a few MB at most: where could work hide?"""

import json
from fractions import Fraction

from proofs.trusted.certificate import SCHEMA
from tests.proofs.trusted.kernel.lemma_examples import text


def document(steps, functions=None, claims=None):
    return {
        "schema": SCHEMA,
        "parameters": None,
        "functions": functions or {},
        "steps": {name: {"rule": rule, "witness": witness} for name, rule, witness in steps},
        "claims": claims or [name for name, _, _ in steps],
    }


def many(rule, witnesses):
    return document([(f"s{i}", rule, witness) for i, witness in enumerate(witnesses)])


def value(function, bounds=("0", "0"), tree=None, **box):
    return {"function": function, "box": box, "tree": tree, "bounds": list(bounds)}


def equal(left, right="0"):
    return {"left": left, "right": right}


def balanced(low, high, levels):
    """A balanced tree of 2^levels leaves."""
    if levels == 0:
        return None
    cut = (low + high) / 2
    return ["1", str(cut), balanced(low, cut, levels - 1), balanced(cut, high, levels - 1)]


UNIT = balanced(Fraction(0), Fraction(1), 15)
LONG = "9" * 2990
LONG_TEXT = "*".join(["(" + "*".join("x" * 70) + ")"] * 70)


def polynomial_bomb():
    bomb = "x"
    for _ in range(4):
        bomb = f"({bomb} + y + 1)**1000"
    return many("formula-equal", [equal(bomb, "x")])


def many_generators():
    terms = " + ".join(f"sin({k}/x)*sqrt(x + {k})" for k in range(1, 60))
    return many("formula-equal", [equal(f"D(({terms})**9, x)", "x")])


def nested_inverses():
    nested = "x"
    for k in range(60):
        nested = f"1/({nested} + y**{k + 1})"
    return many("formula-equal", [equal(nested, "1")])


def long_coefficients():
    big = LONG[:800]
    return many("formula-equal", [equal(f"(x + {big})**6", f"({big} + x)**6")] * 2000)


def wild_series():
    function = "*".join(f"sin({k}*x + a{k})/cos(x*a{k})" for k in range(1, 9))
    lists = {"coefficients": ["0"] * 12, "nonzero": [f"cos(a{k})" for k in range(1, 9)]}
    return many("formula-series", [{"function": function, "variable": "x", **lists}])


def many_derivatives():
    names = ", x" * 3000
    return many("formula-equal", [equal(f"D(sin(x**2)*exp(x)*y{names})", "0")] * 200)


def doubling():
    """x -> x*x written as substitutions: 2^140 products, 140 on the tape."""
    nested = "x"
    for _ in range(140):
        nested = f"at(x*x, x={nested})"
    return many("formula-value", [value(nested, ("-1", "2"), x=["1/2", "1"])] * 1500)


def wide_tree_of_powers():
    return many("formula-value", [value("(x/2)**1000", ("-1", "999"), UNIT, x=["0", "1"])])


def undecided_leaves():
    """Every precision is tried in vain."""
    names = list("uvwxyz")
    terms = " + ".join(f"sin({names[k % 6]}*{names[k % 5]}*{k + 1})" for k in range(100))
    box = {name: ["0", "1"] for name in names}
    return many("formula-value", [value(f"({terms}) - ({terms})", **box)])


def functions_of_many_bits():
    """log(exp(x)) - x at a point, at all precisions, in many steps."""
    box = {"x": ["1/3", "1/3"]}
    return many("formula-value", [value("log(exp(x)) - x", ("1/7", "1/7"), **box)] * 1)


def long_h_sets():
    """1 + a nilpotent matrix of long numbers, and its inverse."""
    n, big = 6, LONG[:300]
    first = [["1", *[f"{sign}{big}{j}" for j in range(1, n)]] for sign in ("", "-")]
    rest = [[str(int(i == j)) for j in range(n)] for i in range(1, n)]
    matrices = {"matrix": [first[0], *rest], "inverse": [first[1], *rest]}
    return many("h-set", [{"centre": ["0"] * n, **matrices}] * 1000)


def many_h_sets(count=3000):
    wave = {"variables": ["x"], "values": ["x + 1/10*sin(2*pi*x)"]}
    radius = 10**20 + 7
    steps = []
    for i in range(count):
        h_set = {"centre": [str(i)], "matrix": [[f"1/{radius}"]], "inverse": [[str(radius)]]}
        covers = {"function": "F", "power": "1", "source": f"n{i}", "target": f"n{i}", "sign": "+"}
        trees = {"left": None, "right": None, "support": None}
        steps += [(f"n{i}", "h-set", h_set), (f"c{i}", "covers", {**covers, **trees})]
    steps.append(("g", "graph", {"covers": [f"c{i}" for i in range(count)]}))
    return document(steps, {"F": wave}, ["g"])


def long_iterate():
    made = json.loads(text("second_iterate"))
    made["functions"]["F"]["values"] = ["5*sin(sin(x))*(1 - x)"]
    covers = next(s["witness"] for s in made["steps"].values() if s["rule"] == "covers")
    covers["power"] = "100"
    return made


def wide_newton():
    names = [f"x{i}" for i in range(20)]
    values = ["*".join(f"sin({name} + {i})" for name in names) for i in range(20)]
    function = {"variables": names, "values": values}
    matrix = [[str(int(i == j)) for j in range(20)] for i in range(20)]
    witness = {"function": "F", "box": [["0", "1"]] * 20, "centre": ["1/2"] * 20, "matrix": matrix}
    steps = [(f"s{i}", "unique-zero", witness) for i in range(200)]
    return document(steps, {"F": function})


def long_sentences():
    one = LONG_TEXT.replace("x", "1")
    function = {"variables": ["x", "y"], "values": ["x", f"y*{one}"]}
    witness = {
        "function": "F",
        "box": [["-1", "1"]] * 2,
        "centre": ["0", "0"],
        "matrix": [["1", "0"], ["0", "1"]],
    }
    steps = [(f"s{i}", "unique-zero", witness) for i in range(9000)]
    return document(steps, {"F": function})


def long_entropy():
    made = json.loads(text("golden_mean"))
    entropy = next(s["witness"] for s in made["steps"].values() if s["rule"] == "entropy")
    made["steps"] |= {
        f"e{i}": {"rule": "entropy", "witness": {**entropy, "length": "100", "growth": "1"}}
        for i in range(20_000)
    }
    made["claims"] = [name for name in made["steps"] if name[0] == "e"][:9_000]
    made["steps"] = {k: v for k, v in made["steps"].items() if k[0] != "e" or k in made["claims"]}
    return made


def wide_cone():
    made = json.loads(text("henon_horseshoe"))
    cone = next(s["witness"] for s in made["steps"].values() if s["rule"] == "cone")
    cone["relations"][0]["tree"] = balanced(Fraction(-1), Fraction(1), 14)
    cone["forms"] = [["1", f"-{LONG}"], ["1", "-1/3"]]
    return made


def product(count):
    """A polynomial of 2^count terms."""
    return "*".join(f"(1 + a{k})" for k in range(count))


def added(terms):
    """A sum that is not nested deeply."""
    while len(terms) > 1:
        terms = [f"({' + '.join(terms[k : k + 12])})" for k in range(0, len(terms), 12)]
    return terms[0]


def many_quotients():
    terms = [f"{k}/q" for k in range(2, 1000)]
    return many("formula-equal", [equal(f"at({added(terms)}, q={product(12)})")])


def many_sums():
    terms = [f"(-({k} - q))" for k in range(2, 600)]
    return many("formula-equal", [equal(f"at({added(terms)}, q={product(12)})")])


def many_terms():
    return many("formula-equal", [equal(product(25))])


def long_series():
    """A pole of an order beyond all memory."""
    pole = "(((x**(-1))**1000)**1000)**1000"
    lists = {"coefficients": ["0"], "nonzero": []}
    return many("formula-series", [{"function": pole, "variable": "x", **lists}])


def many_unknowns(count=20_000):
    expressions = {f"a{k}": "1" for k in range(count)}
    return many("formula-solution", [{"expressions": expressions, "lemmas": [equal("x", "x")]}])


def many_functions():
    function = {"variables": ["x"], "values": ["x + " + added([str(k) for k in range(1, 60)])]}
    return document([], {f"F{k}": function for k in range(9_000)}, ["none"])


def long_decimals(count=50):
    """Binary fractions, each with thousands of decimals."""
    unit = [[str(int(i == j)) for i in range(6)] for j in range(6)]
    h_set = {"centre": [f"1/{2**9940}"] * 6, "matrix": unit, "inverse": unit}
    return many("h-set", [h_set] * count)


def many_points(count=2000):
    """An arc of very many pieces, in the last of which are as many points."""
    line, none, one = {"variables": ["x", "y"], "values": ["y"]}, ["0", "0"], [["1"]]
    sides = [[str(k), str(k + 1)] for k in range(count)]
    pieces = [{"box": [side, ["-1", "1"]], "slope": none, "matrix": one} for side in sides]
    points = [{"box": [[f"{count}"] * 2, ["-1/2", "1/2"]], "matrix": one}] * count
    witness = {"function": "F", "axis": "x", "pieces": pieces, "points": points}
    return document([("s", "arc", witness)], {"F": line})


def tower_of_maps(count=1500):
    maps = {f"F{k}": {"maps": [f"F{k - 1}", "F0"]} for k in range(1, count)}
    box = {"function": f"F{count - 1}", "box": [["0", "1"]], "tree": None, "bounds": ["0", "1"]}
    return document([("s", "image", box)], {"F0": {"variables": ["x"], "values": ["x"]}} | maps)


def wide_flow():
    """Eight states for a long time, with derivatives by as many variables."""
    states, starts = ([f"{name}{k}" for k in range(8)] for name in "xw")
    sums = [" + ".join(f"{j + 1}/100*{x}*{y}" for j, y in enumerate(states)) for x in states]
    flow = {"variables": starts, "time": "t", "state": states, "start": starts, "values": ["x0"]}
    rates = {"field": [f"{each} - {x}" for each, x in zip(sums, states, strict=True)]}
    box = {"box": [["1/10", "11/100"]] * 8, "tree": None, "bounds": [["0", "1"]]}
    image = ("s", "image", {"function": "P", **box})
    return document([image], {"P": flow | rates | {"end": {"time": "1000"}}})


def deep_json():
    return "[" * 2_000_000


def deep_tree():
    made = json.dumps(many("formula-value", [value("x", x=["0", "1"])]))
    cuts = "".join(f'["1", "{2 ** (k + 2) - 1}/{2 ** (k + 1)}", ' for k in range(200))
    return made.replace('"tree": null', f'"tree": {cuts}null' + ", null]" * 200)


HOSTILE = {
    name: made
    for name, made in list(globals().items())
    if callable(made)
    and getattr(made, "__module__", "") == __name__
    and name not in ("document", "many", "value", "equal", "balanced", "source_of")
    and name not in ("product", "added")
}


def source_of(name):
    made = HOSTILE[name]()
    return made if isinstance(made, str) else json.dumps(made, separators=(",", ":"))

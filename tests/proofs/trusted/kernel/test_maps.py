"""Maps with parameters, angles and compositions: what they enclose, what is refused of them."""

import json
import random
from fractions import Fraction
from math import cos, sin

import pytest

from proofs.trusted.certificate import Malformed, Reader
from proofs.trusted.files import render
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.composition import read_map
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import enclosed
from proofs.trusted.rules import find_rule
from proofs.trusted.verify import Rejected, check
from tests.once import examples
from tests.proofs.trusted.kernel.lemma_examples import text
from tests.proofs.trusted.kernel.systems import BALL

STANDARD = {  # Chirikov's map, of all strengths k in a range
    "variables": ["x", "y"],
    "parameters": {"k": ["1/2", "3/5"]},
    "periods": {"x": "2*pi", "y": "2*pi"},
    "values": ["x + y + k*sin(x)", "y + k*sin(x)"],
}
DOUBLING = {"variables": ["x"], "periods": {"x": "1"}, "values": ["2*x"]}
MAPS = {"S": STANDARD, "T": {"maps": ["S", "S"]}, "U": {"maps": ["T", "S"]}}


def read(functions):
    maps = {}
    for name, data in functions.items():
        maps[name] = read_map(name, Reader(data, f"$.{name}"), maps)
    return maps


def standard(x, y, k):
    return x + y + k * sin(x), y + k * sin(x)


@pytest.mark.parametrize(("name", "count"), [("S", 1), ("T", 2), ("U", 3)])
def test_values_and_derivatives_for_all_parameters(name, count):
    rng, map_ = random.Random(name), read(MAPS)[name]
    for _ in range(examples(40)):
        low = [Fraction(rng.uniform(-4, 4)) for _ in range(2)]
        box = [(x, x + Fraction(1, 100)) for x in low]
        values, rows = map_.values(enclosed(box, 64)), map_.jacobian(enclosed(box, 64))
        point, k = [float(x) + rng.random() / 100 for x in low], rng.uniform(0.5, 0.6)
        tangents = [[1.0, 0.0], [0.0, 1.0]]
        for _ in range(count):
            c = k * cos(point[0])
            tangents = [[(1 + c) * a + b, c * a + b] for a, b in tangents]
            point = standard(*point, k)
        flat = [tangents[j][i] for i in range(2) for j in range(2)]
        for enclosure, value in zip([*values, *rows[0], *rows[1]], [*point, *flat], strict=True):
            least, most = enclosure.range
            assert least - Fraction(1, 10**9) <= value <= most + Fraction(1, 10**9)


def test_definitions_say_parameters_and_periods():
    said = read(MAPS)["U"].definition
    head = "`U` is `S`, then `S`, then `S`, where `S(x, y) = (x + y + k*sin(x)"
    assert said.startswith(head)
    assert ", for all `k` in [0.5, 0.6], `x` modulo `2*pi`, `y` modulo `2*pi`" in said


def with_(data, **fields):
    return {**data, **fields}


TWO = with_(DOUBLING, parameters={"c": ["1", "1"]}, periods={"x": "c"})
LIES = [
    ("another period", {"F": with_(DOUBLING, periods={"x": "pi"}, values=["sin(x)*x"])}, "respect"),
    ("half of a period", {"F": with_(STANDARD, periods={"x": "pi"})}, "respect the period of x"),
    ("a part of the angles", {"F": with_(STANDARD, periods={"y": "2*pi"})}, "respect"),
    ("no whole multiple", {"F": with_(DOUBLING, values=["3/2*x"])}, "respect"),
    ("a negative period", {"F": with_(DOUBLING, periods={"x": "-1"})}, "positive"),
    ("a range as a period", {"F": with_(STANDARD, periods={"x": "k"})}, "a period is a number"),
    ("the state as a period", {"F": with_(DOUBLING, periods={"x": "x"})}, "a period is a number"),
    ("the state, bound away", {"F": with_(DOUBLING, periods={"x": "at(1, k=x)"})}, "is a number"),
    ("a derivative as a period", {"F": with_(DOUBLING, periods={"x": "D(x, x)"})}, "is a number"),
    ("e as a variable", {"F": {"variables": ["e"], "parameters": {}, "values": ["e"]}}, "not a n"),
    ("a parameter of no range", {"F": with_(STANDARD, parameters={"k": ["1", "0"]})}, "reversed"),
    ("an unknown name", {"F": with_(STANDARD, parameters={"r": ["1", "2"]})}, "unknown variable"),
    ("a state as a parameter", {"F": with_(STANDARD, parameters={"x": ["1", "2"]})}, "twice"),
    ("a derivative by a number", {"F": with_(TWO, values=["D(c*x, c)"])}, "not a variable: 'c'"),
    ("a later map", {"F": {"maps": ["G", "G"]}, "G": DOUBLING}, "names no function before"),
    ("itself", {"F": {"maps": ["F", "F"]}}, "names no function before"),
    ("one map", {"F": DOUBLING, "G": {"maps": ["F"]}}, "1 entries, expected 2"),
    ("other states", {"F": DOUBLING, "S": STANDARD, "G": {"maps": ["F", "S"]}}, "one state"),
    ("another circle", {"F": DOUBLING, "G": with_(DOUBLING, periods={"x": "2"}),
     "P": {"maps": ["F", "G"]}}, "one state, with the same angles"),
    ("a circle of another number", {"F": TWO, "G": with_(TWO, parameters={"c": ["2", "2"]}),
     "P": {"maps": ["F", "G"]}}, "one state, with the same angles"),
    ("named as the derivative", {"D": DOUBLING}, "functions are named like F"),
    ("a tower of maps", {"F": DOUBLING, "G0": {"maps": ["F", "F"]}} | {
     f"G{k}": {"maps": [f"G{k - 1}", f"G{max(k - 2, 0)}"]} for k in range(1, 40)}, "more than 100"),
    ("too few values", {"F": {"variables": ["x", "y"], "values": ["x"]},
     "G": {"maps": ["F", "F"]}}, "one state"),
]  # fmt: skip


@pytest.mark.every
@pytest.mark.parametrize(("functions", "reason"), [x[1:] for x in LIES], ids=[x[0] for x in LIES])
def test_lies(functions, reason):
    with pytest.raises(Malformed, match=reason) as caught:
        read(functions)
    assert len(str(caught.value).splitlines()) == 1


# -- rules on circles ------------------------------------------------------------------------------


def proved(functions, steps):
    """The conclusion of the last step."""
    context = Context(functions=read(functions))
    for name, (rule, witness) in steps.items():
        context.known[name] = find_rule(rule)(context, Reader(witness))
    return context.known[name]


def h_set(centre, radius):
    inverse = str(1 / Fraction(radius))
    return "h-set", {"centre": [centre], "matrix": [[radius]], "inverse": [[inverse]]}


def covering(source, target, turns, function="F", sign="+"):
    trees = dict.fromkeys(("left", "right", "support"))
    place = {"function": function, "power": "1", "source": source, "target": target}
    return "covers", {**place, "sign": sign, **trees, "turns": [turns]}


GOLDEN = {"aa": "0", "ab": "0", "ba": "1"}  # turns
TWO_SETS = {"a": h_set("0", "1/10"), "b": h_set("1/4", "1/20")}
FOUR = {"F": with_(DOUBLING, values=["4*x"])}


def golden_mean(**changes):
    arrows = {way: covering(*way, turns) for way, turns in (GOLDEN | changes).items()}
    vector = {"graph": "g", "length": "2", "vector": ["2", "1"], "growth": "2"}
    graph = "graph", {"covers": list(arrows)}
    return TWO_SETS | arrows | {"g": graph, "h": ("entropy", vector)}


def test_turns_are_those_of_a_relation():
    """From one set the map turns by 0, from the other one by 1."""
    said = proved(FOUR, golden_mean()).sentence
    assert "N1 => N1, N1 => N2 under `F`; N2 => N1 under `F` (`x` less 1 period)" in said
    assert "at least log(2)/2" in said


@pytest.mark.every
@pytest.mark.parametrize("way", GOLDEN)
@pytest.mark.parametrize("turns", ["2", "-1", "1/2"])
def test_other_turns_are_refused(way, turns):
    with pytest.raises((Unproved, Malformed), match=r"not proved on|an integer"):
        proved(FOUR, golden_mean(**{way: turns}))


def test_sets_that_are_the_same_on_the_circle_are_no_two():
    """0 and 1 are one fixed point of x -> 4 x modulo 1: no horseshoe."""
    sets = {"a": h_set("0", "1/10"), "b": h_set("1", "1/10")}
    arrows = {"aa": "0", "ab": "-1", "bb": "3", "ba": "4"}
    steps = sets | {f"c{way}": covering(*way, turn) for way, turn in arrows.items()}
    proved(FOUR, steps)
    with pytest.raises(Unproved, match="not all within one period"):
        proved(FOUR, steps | {"g": ("graph", {"covers": [f"c{way}" for way in arrows]})})


CONE = {"box": [["-1", "1"]], "tree": None}


@pytest.mark.every
@pytest.mark.parametrize(
    ("radius", "shift"), [("1/20", "0"), ("3/10", "0"), ("1/5", "1/8"), ("1/5", "-1/8")]
)
def test_no_image_comes_round_the_circle_in_a_cone(radius, shift):
    """A set so long that its image meets it with other turns, too, has more orbits than paths.

    Shifted by 1/8 it comes round on one side alone.
    """
    map_ = {"F": with_(DOUBLING, values=[f"4*x + ({shift})"])}
    steps = {"a": h_set("0", radius), "c": covering("a", "a", "0")}
    steps |= {"g": ("graph", {"covers": ["c"]})}
    cone = "cone", {"graph": "g", "forms": [["1"]], "relations": [CONE]}
    assert proved(map_, steps).nodes
    if radius == "1/20":
        assert "exactly one point" in proved(map_, steps | {"k": cone}).sentence
    else:
        with pytest.raises(Unproved, match="not proved on"):
            proved(map_, steps | {"k": cone})


def test_one_graph_of_two_maps():
    """Each set has one map; a second one from it is refused, as is an iterate."""
    maps = FOUR | {"G": with_(DOUBLING, values=["5/4 - 4*x"])}
    arrows = {"aa": covering("a", "a", "0"), "ab": covering("a", "b", "0")}
    arrows |= {"bb": covering("b", "b", "0", "G", "-")}
    steps = TWO_SETS | arrows
    graph = proved(maps, steps | {"g": ("graph", {"covers": list(arrows)})})
    assert graph.map_name == "the map that is `F` on N1, `G` on N2"
    other = {"a2": covering("a", "a", "1", "G", "-")}
    with pytest.raises(Malformed, match="another map from the same set"):
        proved(maps, steps | other | {"g": ("graph", {"covers": [*arrows, "a2"]})})


# -- images ----------------------------------------------------------------------------------------

PRODUCT = {"F": {"variables": ["x", "y"], "values": ["x*y", "x - y"]}}
CUT = ["1", "1/2", None, None]


@pytest.mark.every
@pytest.mark.parametrize(
    ("bounds", "tree", "is_true"),
    [
        ([["0", "1"], ["-1", "1"]], None, True),
        ([["0", "1"], ["-1", "1/2"]], None, False),
        ([["0", "9/10"], ["-1", "1"]], None, False),
        ([["0", "1/2"], ["-1", "1"]], CUT, False),  # true of the first half
        ([["1/100", "1"], ["-1", "1"]], CUT, False),
    ],
)
def test_where_a_box_is_taken(bounds, tree, is_true):
    witness = {"function": "F", "box": [["0", "1"]] * 2, "tree": tree, "bounds": bounds}
    if is_true:
        said = proved(PRODUCT, {"i": ("image", witness)}).sentence
        assert said.endswith("and its values are `x` in [0, 1], `y` in [-1, 1].")
    else:
        with pytest.raises(Unproved, match="not proved on"):
            proved(PRODUCT, {"i": ("image", witness)})


@pytest.mark.parametrize(
    ("values", "said"),
    [
        (["x*y"], "in [-9, 9]"),  # a value that has no name
        (["x*y", "y", "x"], "in [-9, 9] x [-9, 9] x [-9, 9]"),  # two that would have one name
        (["y", "x"], "`x` in [-9, 9], `y` in [-9, 9]"),
    ],
)
def test_values_without_names_of_their_own_are_said_to_be_in_a_box(values, said):
    witness = {"function": "F", "box": [["0", "1"]] * 2, "tree": None}
    witness["bounds"] = [["-9", "9"]] * len(values)
    made = {"F": {"variables": ["x", "y"], "values": values}}
    assert proved(made, {"i": ("image", witness)}).sentence.endswith(f"its values are {said}.")


# -- files -----------------------------------------------------------------------------------------


def test_functions_of_a_composition_are_used_and_others_are_not():
    document = json.loads(text("rattle"))
    assert check(render(document)).sentences
    document["functions"]["W"] = STANDARD
    with pytest.raises(Malformed, match="that nothing uses: W"):
        check(render(document))


@pytest.mark.every
@pytest.mark.parametrize(
    "data",
    [
        with_(DOUBLING, periods={"x": "1/(1 - 1)"}),
        with_(DOUBLING, periods={"x": "log(-1)"}),
        with_(DOUBLING, values=["(12345678901*x)**1000"]),
        {**BALL, "gaps": ["y - 1/(v - v)"]},
    ],
)
def test_what_cannot_be_read_is_refused_in_a_line(data):
    document = json.loads(text("ball"))
    document["functions"]["P"] = data
    with pytest.raises((Malformed, Rejected), match=r"^\$\.functions\.P") as caught:
        check(render(document))
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize("rule", ["unique-zero", "periodic-orbits", "arc"])
def test_rules_without_turns_refuse_angles(rule):
    fields = {
        "unique-zero": {"box": [], "centre": [], "matrix": []},
        "periodic-orbits": {"period": "1", "box": [], "radius": "1", "orbits": []},
        "arc": {"axis": "x", "pieces": [], "points": []},
    }[rule]
    with pytest.raises(Malformed, match="no angles"):
        proved({"F": DOUBLING}, {"x": (rule, {"function": "F", **fields})})

"""Figures: what they draw as proved is what the certificates say, and no more."""

import cmath
import json
import math
import random
import re
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import pytest
from mpmath import mpf

from intervals import Undecided
from proofs.commands.ledger import CLAIMS
from proofs.report.dependencies import RESTS, falls_with, rests_on
from proofs.report.figures import resonance
from proofs.report.graph import falling, svg
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.paper import find
from proofs.trusted.parameters import PAPER
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import premises
from tests.oracles.curves import amplitude, grazing
from tests.oracles.sources import about_curves
from tests.proofs.trusted.paper import reference

pytest.importorskip("matplotlib")

from proofs.__main__ import main as command
from proofs.report.figures import curves, dossier, figures
from proofs.report.figures.figure import all_of
from proofs.report.figures.style import PROVED, style, svg_of

pytestmark = pytest.mark.slow

REPORTS = Path(__file__).parents[3] / "reports"
FIGURES = figures()
BY_NAME = {figure.name: figure for figure in FIGURES}
ETA, NU = mpf("0.2121"), mpf("-0.2")


@pytest.fixture(scope="module")
def ledger():
    rows = json.loads((REPORTS / "ledger.json").read_text())["claims"]
    return {row["id"]: row for row in rows}


def step(file, name):
    return json.loads((REPORTS / f"{file}.json").read_text())["steps"][name]["witness"]


def numbers(values):
    return [numbers(x) if isinstance(x, list) else float(Fraction(x)) for x in values]


@pytest.fixture(scope="module")
def drawings(documents):
    """Every figure, drawn once."""
    from matplotlib import pyplot as plt

    found = {}
    for name, figure in BY_NAME.items():
        with style(name):
            found[name] = figure.plot(documents[figure.certificate])
    yield found
    plt.close("all")


def shapes(drawing):
    """Return for each of its axes what a drawing shows as proved: polygons, by their labels."""
    found = []
    for axes in drawing.axes:
        labelled = {}
        for patch in axes.patches:
            if patch.get_gid() == PROVED:
                path = patch.get_patch_transform().transform_path(patch.get_path())
                labelled.setdefault(patch.get_label(), []).extend(map(points, path.to_polygons()))
        found.append(labelled)
    return found


def points(polygon):
    return [tuple(map(float, point)) for point in polygon]


def box(polygon):
    xs, ys = zip(*polygon, strict=True)
    return (min(xs), max(xs)), (min(ys), max(ys))


def inside(polygon, x, y):
    """Whether a point is in a convex polygon, to rounding."""
    turns = [
        (bx - ax) * (y - ay) - (by - ay) * (x - ax) for (ax, ay), (bx, by) in pairwise(polygon)
    ]
    return all(t <= 1e-12 for t in turns) or all(t >= -1e-12 for t in turns)


def on_circle(low, high):
    """The interval's parts in [0, 2 pi], for ends above -2 pi."""
    whole = [(low + turn, high + turn) for turn in (math.tau, 0.0)]
    parts = [(max(a, 0.0), min(b, math.tau)) for a, b in whole]
    return [(a, b) for a, b in parts if a < b]


def image(phase):
    time, _ = reference.first_impact(ETA, NU, mpf(phase))
    return float((phase + time) % (2 * mpf(math.pi)))


# -- all of them -----------------------------------------------------------------------------------


def test_each_is_small_and_whole_and_names_nothing_twice(drawings):
    names, ids = set(), set()
    for figure in FIGURES:
        text = svg_of(drawings[figure.name], figure.name, figure.title)
        root = ElementTree.fromstring(text)
        assert root.find("{http://www.w3.org/2000/svg}title").text == figure.title
        assert len(text) < 150_000 and "<image" not in text and "date" not in text
        own = re.findall(r' id="([^"]+)"', text)
        assert len(own) == len(set(own)) and not ids.intersection(own)
        used = {name[1:] for name in re.findall(r'(?<=href=")#[^"]+|(?<=url\()#[^)]+', text)}
        assert used <= set(own)
        ids.update(own)
        assert figure.name not in names
        names.add(figure.name)


def test_each_belongs_to_claims_the_first_decided_by_its_certificate(ledger):
    for figure in FIGURES:
        assert figure.claims and figure.shows.endswith(".")
        document = json.loads((REPORTS / f"{figure.certificate}.json").read_text())
        assert figure.claims[0] in {claim["id"] for claim in document["claims"]}
        assert set(figure.claims) <= set(ledger)


@pytest.mark.parametrize("name", sorted(BY_NAME.keys() - {"figure-1", "figure-10", "restitution"}))
def test_what_is_not_proved_is_not_drawn(name):
    with style(name), pytest.raises(Undecided):
        BY_NAME[name].plot(Context(PAPER))


@pytest.mark.parametrize(
    "path, short",
    [
        ("M 1 2.0051 \nL -3.456 4 \nL 5 6 \nz\n", "M1 2.01 -3.46 4 5 6z"),
        ("M 1 2 \nQ 1 2 3.999 4 \nL 0 1 \n", "M1 2Q1 2 4 4L0 1"),
        ("M 7.001 8 \nL 7.002 8 \nM 1 2 \nL 3 2 \n", "M7 8h0M1 2 3 2"),
    ],
)
def test_a_path_leads_to_the_same_points_to_two_places(path, short):
    from matplotlib import pyplot as plt

    with style("path"):
        drawing = plt.figure()
    drawing.savefig = lambda file, **_: file.write(f'<svg><path d="{path}" style="a"/></svg>')
    assert f'<path d="{short}" style="a"/>' in svg_of(drawing, "path", "a path")


# -- one by one ------------------------------------------------------------------------------------


def test_2_the_graph_lies_in_the_shapes_and_the_gap_is_the_certificate_s(drawings):
    (found,) = shapes(drawings["figure-2"])
    graph = {label: polygons for label, polygons in found.items() if label.startswith("graph")}
    assert len(graph) == 2
    for polygons in graph.values():
        for polygon in polygons:
            xs = [x for x, _ in polygon]
            low, high = min(xs), max(xs)
            for share in (0.1, 0.5, 0.9):
                x = low + (high - low) * share
                assert inside(polygon, x, image(x))
                assert not inside(polygon, x, image(x) + (high - low))
    (label,) = set(found) - set(graph)
    target = numbers(step("horseshoe", "avoids-1")["target"])
    assert [box(each) for each in found[label]] == [((1.15, 1.27), tuple(target))]


def test_3_the_first_levels_are_the_sets(drawings):
    for axes, name in zip(
        shapes(drawings["figure-3"]), ("dimension-2", "dimension-1"), strict=True
    ):
        witness = step("dimension", name)
        drawn = {label: [box(each)[0] for each in polygons] for label, polygons in axes.items()}
        assert drawn["I, exact"] == [tuple(numbers(witness["hull"]))]
        cuts = [step("dimension", each)["cuts"] for each in witness["branches"]]
        domains = [(each[0], each[-1]) for each in cuts]
        assert drawn["I0 and I1, exact"] == [tuple(numbers(x)) for x in domains]


def test_4_every_state_has_its_image_in_a_box(drawings):
    rng = random.Random(4)
    sets = (((1.11, 1.15), (1.27, 1.32)), ((1.11, 1.16), (1.27, 1.33)))
    for found, strips in zip(shapes(drawings["figure-4"]), sets, strict=True):
        for index, (low, high) in enumerate(strips, start=1):
            boxes = [box(x) for x in found[f"image of V{index} lies in here, proved"]]
            for phase in (low, rng.uniform(low, high), rng.uniform(low, high), high):
                gamma = rng.uniform(-0.45, 0)
                time, y = reference.rebound(ETA, NU, mpf("0.01"), mpf(phase), mpf(gamma))
                x = float(phase + time) % math.tau
                assert any(a <= x <= b and c <= y <= d for (a, b), (c, d) in boxes)


def test_5_arc_landing_and_silence(drawings, ledger):
    (found,) = shapes(drawings["figure-5"])
    ends = {name: float(x["lower"]) for name, x in ledger["G2"]["quantities"].items()}
    arc = ends["arc_start"], ends["separation_phase"]
    landing = [box(x) for label, each in found.items() if "land" in label for x in each]
    assert all(y == pytest.approx(arc, abs=1e-12) for _, y in landing)
    for (low, high), (first, last) in landing:
        assert first < image(0.3 * low + 0.7 * high) < last
    cuts = [numbers(step("circle", name)["cuts"]) for name in ("lands-1", "lands-2")]
    assert [x for x, _ in landing] == [part for x in cuts for part in on_circle(x[0], x[-1])]
    (silent,) = (box(x) for label, each in found.items() if "ever" in label for x in each)
    assert silent[0] == tuple(numbers(step("circle", "never-impacts-1")["phases"]))
    sticks = [box(x) for label, each in found.items() if "sticks" in label for x in each]
    assert sticks[0][0] == pytest.approx(arc, abs=1e-12)


def test_section_5_colours_are_the_eigenvalues(drawings):
    import numpy as np

    regions = {}
    for artist in drawings["section-5"].axes[0].collections:
        colour = tuple(artist.get_facecolor()[0])
        regions.setdefault(colour, []).extend(artist.get_paths())
        if not artist.get_label().startswith("_"):
            regions[artist.get_label()] = regions[colour]
    seen = set()
    rng = random.Random(5)
    for _ in range(300):
        epsilon, rho = rng.uniform(0.02, 0.97), rng.uniform(0.1, 8.9)
        square = (1 + epsilon) ** 2 * rho**2 - (1 - epsilon) ** 2 * (2 * math.pi) ** 2
        kinds = [
            label
            for label, paths in regions.items()
            if isinstance(label, str) and any(path.contains_point((epsilon, rho)) for path in paths)
        ]
        if square <= 0:
            wanted = "no fixed points"
        else:
            alpha = math.sqrt(square)
            matrix = [
                [1 - (1 + epsilon) / 2 * alpha, -epsilon * (1 + epsilon) / 2],
                [epsilon * alpha, epsilon**2],
            ]
            values = np.linalg.eigvals(matrix)
            wanted = "a saddle of the second kind"
            if max(abs(values)) < 1:
                kind = "complex eigenvalues" if abs(values[0].imag) > 1e-9 else "real eigenvalues"
                wanted = f"a sink with {kind}"
        assert len(kinds) == 1 and kinds[0].startswith(wanted)
        seen.add(wanted)
    assert len(seen) == 4


def test_curves_of_grazing_pass_where_the_oracle_says():
    """Thick lines go through the proved pieces, the point where they meet is one of them."""
    from matplotlib import pyplot as plt

    figure = curves.FIGURE
    with pytest.raises(Undecided):
        figure.plot(Context())
    made = about_curves()
    curve = made[0]
    drawing = figure.plot(Context(known=dict(enumerate(made))))
    lines = [line for line in drawing.axes[0].lines if line.get_gid() == PROVED]
    plt.close(drawing)
    etas, nus = lines[0].get_data()
    assert len(etas) == len(curve.arc.pieces) + 1
    assert (etas[0], etas[-1]) == tuple(map(float, curve.arc.ends))
    for eta, nu in zip(etas, nus, strict=True):
        side, p, _ = grazing(2, 0.0, eta)
        assert nu == pytest.approx(amplitude(2, 0.0, eta, p, side), abs=5e-3)
    (x,), (y,) = lines[1].get_data()
    assert (x, y) == pytest.approx((1.42393906912, -0.59355799944), abs=1e-10)


# -- at parameters of one's own --------------------------------------------------------------------


def test_the_dossier_s_boxes_are_crossed_by_f_from_edge_to_edge(tmp_path):
    options = ["--eta", "0.22", "--nu", "-0.2", "--only", "X2", "X3", "--effort", "1", "--figure"]
    assert command(["explore", *options, "--quiet", "--out", str(tmp_path)]) == 0
    assert (tmp_path / "figures" / "dossier.svg").read_text().count("<path") > 5
    proved = premises((tmp_path / "explore.json").read_text())
    (shift,) = all_of(proved, StayingSet)
    boxes = dossier.crossings(shift)
    assert len(boxes) == 4
    for domain, target in boxes:
        ends = sorted(
            float((phase + reference.first_impact(mpf("0.22"), NU, phase)[0]) % (2 * mpf(math.pi)))
            for phase in (mpf(float(end)) for end in domain)
        )
        assert ends[0] < target[0] and target[1] < ends[1]


# -- figure 10 simulated ---------------------------------------------------------------------------


def height_of(samples, cycles):
    """The height of the oscillation with so many cycles a table period, 64 samples each."""
    turn = -2j * math.pi * float(cycles) / 64
    return 2 * abs(sum(x * cmath.exp(turn * k) for k, x in enumerate(samples))) / len(samples)


def below(samples):
    """The largest height at a multiple of an eighth of the table's frequency below it."""
    return max(height_of(samples, Fraction(j, 8)) for j in range(1, 8))


def test_the_steady_motion_has_the_frequency_of_the_table():
    for nu in (Fraction(-1, 10), Fraction(-2)):
        samples = resonance.displacement(nu, 432)
        early, late = samples[: 32 * 64], samples[400 * 64 :]
        assert below(early) > 0.01 and below(late) < 1e-6 and height_of(late, 1) > 0.5


def test_elastic_impacts_may_repeat_after_eight_periods_without_a_line_below_the_drive():
    nu = -Fraction(math.tan(math.pi / 9))  # nine impacts in eight periods
    samples = resonance.displacement(nu, 40, epsilon=1.0)
    period, window = 8 * 64, samples[512:]
    assert max(abs(a - b) for a, b in zip(window[period:], window, strict=False)) < 1e-6
    assert max(abs(a - b) for a, b in zip(window[64:], window, strict=False)) > 0.1
    whole = samples[: 32 * 64]
    assert below(whole) < 1e-3 and height_of(whole, Fraction(9, 8)) > 0.1


# -- what the paper derives from what --------------------------------------------------------------


def test_ids_are_claims_of_the_paper_and_no_argument_goes_in_a_circle():
    for claim, rest in RESTS.items():
        for each in (claim, *rest.on):
            assert each in CLAIMS and not find(each).own
        assert rest.on and len(set(rest.on)) == len(rest.on)
        assert claim not in rests_on(claim)


def test_the_theorem_of_the_paper_falls_with_its_slope_bound():
    assert {"H7", "H8", "H13", "G5"} <= falls_with("H2")
    assert "H1" not in falls_with("H2") and rests_on("H8") >= {"H7", "H2", "M6", "M4", "M1"}


@pytest.mark.slow
def test_the_graph_shows_each_claim_once_and_carries_refutations_forward(found):
    graph = svg(found)
    refuted = {claim.id for claim in found.claims if claim.verdict is Verdict.REFUTED}
    boxes = re.findall(r'<a href="#([A-Z]\d+)">(?:(?!</a>).)*</a>', graph)
    assert sorted(boxes) == sorted(claim.id for claim in found.claims)
    ringed = set(re.findall(r'<a href="#(\w+)"><title>[^<]*</title><rect class="ring"', graph))
    assert ringed == {claim.id for claim in found.claims if rests_on(claim.id) & refuted}
    assert "H8" in ringed and "H1" not in ringed
    told = {each.claim.id: each for each in falling(found)}
    assert set(told) == {claim for claim in refuted if falls_with(claim)}
    for claim, each in told.items():
        members = [other.id for other in (*each.standing, *each.falling)]
        assert sorted(members) == sorted(falls_with(claim))
    corners = re.findall(r'<rect class="[A-Z]+" x="(\d+)" y="(\d+)"', graph)
    assert len(set(corners)) == len(corners) == len(found.claims)

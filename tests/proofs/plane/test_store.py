"""The command and its store: nothing lost, nothing twice, one writer at a time."""

import json
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import Future
from fractions import Fraction

import pytest

from proofs import atlas
from proofs.check import main as check
from proofs.plane import picture, summary
from proofs.plane.head import Here, run
from proofs.plane.store import NAME, Held, opened
from proofs.report.figures.style import style
from proofs.trusted.atlas import check_store
from proofs.trusted.verdicts import Verdict

F = Fraction
SMALL = ["--eta", "0.2115", "0.2127", "--nu", "-0.201", "-0.199", "--ask", "horseshoe"]
LARGE = ["--eta", "0.211", "0.2134", "--nu", "-0.204", "-0.2", "--ask", "horseshoe"]


@pytest.fixture(autouse=True)
def draw(monkeypatch):
    """Pictures take longer than all else here: what makes one is returned, not done."""
    made = atlas._draw
    monkeypatch.setattr(atlas, "_draw", lambda folder, store, made: None)
    return made


def start(folder, *more):
    command = [sys.executable, "-m", "proofs.atlas", *LARGE, "--depth", "3", "--chunk", "3"]
    return subprocess.Popen([*command, "--out", str(folder), "--quiet", *more])


def test_an_atlas_and_a_cell_of_it(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert atlas.main([*SMALL, "--depth", "2", *out]) == 0
    said = capsys.readouterr().out
    assert "VERIFIED         16 cells, 1 of the area" in said and "Opposite: " in said
    made = json.loads((tmp_path / "atlas.json").read_text())
    assert made["cells"] == {"VERIFIED": 16} and made["kinds"] == {"CoveringShift": 16}
    assert check([str(tmp_path / NAME)]) == 0
    assert "16 VERIFIED cells, all as their certificates prove" in capsys.readouterr().out
    assert check([str(tmp_path / NAME), "--jobs", "2", "--quiet"]) == 0
    assert atlas.main([*out, "--cell", "0.2122", "-0.2001"]) == 0
    assert "VERIFIED: At eta in [0.2121, 0.2124], nu in [-0.2005, -0.2]" in capsys.readouterr().out
    (path,) = tmp_path.glob("cell-*.json")
    assert check([str(path)]) == 0
    assert "about a box of parameters" in capsys.readouterr().out


def test_the_picture_has_what_is_proved_and_no_more(tmp_path, draw):
    with opened(
        tmp_path, atlas.Region((F("0.45"), F("0.5")), (F("0.1"), F("0.6")), "horseshoe")
    ) as store:
        run(store, 2, (Here(), 1), 16)
        made = summary.summary(store)
        with style("atlas"):
            drawing = picture.picture(store.region, picture.shown(store, made))
        (path,) = drawing.axes[0].patches[1:]  # but for what is below it
        draw(tmp_path, store, made)
        proved = {cell.key for cell in store.cells(Verdict.REFUTED)}
        inside = [path.get_path().contains_point(middle(store.region.box(key))) for key in proved]
        left = [cell.key for cell in store.cells(Verdict.UNDECIDED)]
    assert proved and all(inside) and left
    assert not any(path.get_path().contains_point(middle(store.region.box(key))) for key in left)
    assert (tmp_path / "atlas.png").read_bytes().startswith(b"\x89PNG")
    words, share = "every motion comes to rest", made["share_of_area"]["AtRest"]
    for name in ("atlas.svg", "atlas.html"):
        text = (tmp_path / name).read_text()
        assert words in text and picture.percent(share) in text
    assert "cut in four" in (tmp_path / "cost.svg").read_text()


def middle(box):
    return float(sum(box.eta)) / 2, float(sum(box.nu)) / 2


def test_it_goes_on_and_deeper(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert atlas.main([*SMALL, "--depth", "1", *out]) == 1
    assert "4 cells undecided" in capsys.readouterr().out
    assert atlas.main([*SMALL, "--depth", "1", *out]) == 1
    assert "0 cells looked at now" in capsys.readouterr().out
    assert atlas.main(["--depth", "2", *out]) == 0
    assert "16 cells looked at now" in capsys.readouterr().out
    assert check_store(tmp_path / NAME).missing == 0


def survives(tmp_path, kills, seed):
    """Kill the head at random; return what there is after it was let finish."""
    rng, rows = random.Random(seed), 0
    for _ in range(kills):
        process = start(tmp_path)
        time.sleep(rng.uniform(0.3, 1))
        process.send_signal(signal.SIGKILL)
        process.wait()
        if (tmp_path / NAME).exists() and (tmp_path / NAME).stat().st_size:
            with opened(tmp_path, None) as store:
                now = sum(1 for _ in store.cells(*Verdict))
            assert now >= rows  # what was there is there
            rows = now
    assert start(tmp_path).wait() in (0, 1)
    return check_store(tmp_path / NAME)


def whole(found):
    return found.missing == 0 and sum(found.areas.values()) == found.whole


@pytest.mark.slow
def test_a_head_that_is_killed_five_times(tmp_path):
    assert whole(survives(tmp_path, 5, 1))


@pytest.mark.long
def test_a_head_that_is_killed_fifty_times(tmp_path):
    for seed in range(5):
        folder = tmp_path / str(seed)
        folder.mkdir()
        assert whole(survives(folder, 10, seed))


def test_a_worker_that_dies_loses_its_chunk_alone(tmp_path):
    """What breaks the pool ends the run; what was written stays, and the next run goes on."""

    class Breaks(Here):
        left = 3

        def submit(self, work, /, *data, **more):
            self.left -= 1
            if self.left:
                return super().submit(work, *data, **more)
            lost = Future()
            lost.set_exception(ConnectionError("a worker has gone"))
            return lost

    region = atlas.Region(
        *(tuple(map(atlas.number, x)) for x in (SMALL[1:3], SMALL[4:6])), SMALL[7]
    )
    with pytest.raises(ConnectionError), opened(tmp_path, region) as store:
        run(store, 2, (Breaks(), 1), 2)
    assert 0 < check_store(tmp_path / NAME).cells.total() < 21
    with opened(tmp_path, region) as store:
        run(store, 2, (Here(), 1), 2)
    assert whole(check_store(tmp_path / NAME))


def test_a_second_head_is_refused(tmp_path, capsys):
    assert atlas.main([*SMALL, "--depth", "0", "--out", str(tmp_path)]) == 1
    with opened(tmp_path, None):
        with pytest.raises(Held, match="another run"), opened(tmp_path, None):
            pass
        command = [sys.executable, "-m", "proofs.atlas", "--out", str(tmp_path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "another run writes to" in done.stderr


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        (["--eta", "0.3", "0.2", *SMALL[3:]], "eta: reversed or empty"),
        (["--eta", "0.2", "0.2", *SMALL[3:]], "eta: reversed or empty"),
        (["--eta", "0", "0.2", *SMALL[3:]], "eta must be positive"),
        (SMALL[:6], "go together"),
        ([*SMALL, "--depth", "41"], "depth"),
        ([*SMALL, "--jobs", "0"], "--jobs"),
        ([*SMALL, "--executor", "ssh:somewhere"], "dask:"),
        ([], "there is no"),
        ([*SMALL[:6], "--ask", "chaos"], "the question is one of attractor, horseshoe"),
        ([*SMALL[:6], "--ask", "entropy:1"], "entropy:2 to entropy:50"),
        ([*SMALL, "--epsilon", "0.3"], "plastic impacts alone"),
        ([*SMALL[:6], "--ask", "orbits", "--epsilon", "0.3", "0.2"], "in [0, 1)"),
        ([*SMALL[:6], "--ask", "orbits", "--epsilon", "1"], "in [0, 1)"),
        ([*SMALL[:6], "--ask", "orbits", "--epsilon", "0", "0.1", "0.2"], "in [0, 1)"),
        (["--epsilon", "0.1"], "go together"),
    ],
)
def test_bad_input_is_one_line(arguments, match, tmp_path, capsys):
    with pytest.raises(SystemExit) as left:
        atlas.main([*arguments, "--out", str(tmp_path)])
    said = capsys.readouterr().err
    assert left.value.code == 2 and match in said and said.count("\n") == 1


def test_orbits_with_restitution(tmp_path, capsys):
    asked = ["--eta", "0.59", "0.61", "--nu", "-0.76", "-0.74", "--ask", "orbits:3"]
    out = ["--depth", "1", "--out", str(tmp_path)]
    assert atlas.main([*asked, "--epsilon", "0.3", *out]) == 0
    said = capsys.readouterr().out
    assert "4 cells, 1 of the area: stable with one impact in n periods: n = 1" in said
    assert check([str(tmp_path / NAME)]) == 0
    with pytest.raises(SystemExit):
        atlas.main([*asked, "--epsilon", "0", *out])
    assert "another region" in capsys.readouterr().err
    assert atlas.main(["--out", str(tmp_path), "--cell", "0.6", "-0.75"]) == 0
    assert "epsilon = 0.3: there is exactly one stable" in capsys.readouterr().out


def test_another_region_in_the_same_folder_is_refused(tmp_path, capsys):
    assert atlas.main([*SMALL, "--depth", "0", "--out", str(tmp_path)]) == 1
    with pytest.raises(SystemExit) as left:
        atlas.main([*LARGE, "--depth", "0", "--out", str(tmp_path)])
    assert left.value.code == 2 and "another region" in capsys.readouterr().err


def test_a_region_across_resonance_is_cut_there(tmp_path, capsys):
    region = ["--eta", "0.9", "1.1", "--nu", "-0.1", "0.1", "--ask", "horseshoe"]
    assert atlas.main([*region, "--depth", "0", "--out", str(tmp_path)]) == 1
    said = capsys.readouterr().out
    assert "cut at eta = 1 and nu = 0" in said and "eta [0.9, 1]" in said
    assert check_store(tmp_path / NAME).cells == {"REFUTED": 2, "UNDECIDED": 2}

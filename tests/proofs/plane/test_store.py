"""The command and its store: nothing lost, nothing twice, one writer at a time."""

import json
import random
import signal
import sqlite3
import subprocess
import sys
import time
import tracemalloc
from concurrent.futures import Future
from contextlib import closing
from fractions import Fraction
from pathlib import Path

import pytest

from proofs import atlas
from proofs.check import _mapped
from proofs.check import main as check
from proofs.plane import cost, picture, summary
from proofs.plane.cells import decide
from proofs.plane.head import Here, run
from proofs.plane.store import NAME, Held, opened
from proofs.report.figures.style import style
from proofs.report.layout import percent
from proofs.trusted.atlas import SPLIT, check_store, without_proof
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import check as prove

F = Fraction
SMALL = ["--eta", "0.2115", "0.2127", "--nu", "-0.201", "-0.199", "--ask", "horseshoe"]
LARGE = ["--eta", "0.211", "0.2134", "--nu", "-0.204", "-0.2", "--ask", "horseshoe"]


@pytest.fixture(autouse=True)
def draw(monkeypatch):
    """Pictures take longer than all else here: what makes one is returned, not done."""
    made = atlas._draw
    monkeypatch.setattr(atlas, "_draw", lambda folder, store, made, spent: None)
    return made


def start(folder, *more):
    command = [sys.executable, "-m", "proofs.atlas", *LARGE, "--depth", "3", "--chunk", "3"]
    return subprocess.Popen([*command, "--out", str(folder), "--quiet", *more])


@pytest.mark.slow
def test_an_atlas_and_a_cell_of_it(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert atlas.main([*SMALL, "--depth", "2", *out]) == 0
    said = capsys.readouterr().out
    assert "VERIFIED         16 cells, 1 of the area" in said and "Opposite: " in said
    made = json.loads((tmp_path / "atlas.json").read_text())
    assert made["cells"] == {"VERIFIED": 16} and made["kinds"] == {"CoveringShift": 16}
    assert [(row["depth"], row["cells"]) for row in made["cpu_milliseconds"]] == [
        (0, 1),
        (1, 4),
        (2, 16),
    ]
    assert check([str(tmp_path / NAME)]) == 0
    assert "16 VERIFIED cells, all as their certificates prove" in capsys.readouterr().out
    assert check([str(tmp_path / NAME), "--jobs", "2", "--quiet"]) == 0
    assert atlas.main([*out, "--cell", "0.2122", "-0.2001"]) == 0
    assert "VERIFIED: At eta in [0.2121, 0.2124], nu in [-0.2005, -0.2]" in capsys.readouterr().out
    (path,) = tmp_path.glob("cell-*.json")
    assert check([str(path)]) == 0
    assert "about a box of parameters" in capsys.readouterr().out
    assert atlas.main([*out, "--cell", "0.2122", "-0.2001", "--json", "-"]) == 0
    cell = json.loads(capsys.readouterr().out)
    assert cell["box"]["eta"] == ["2121/10000", "531/2500"] and cell["verdict"] == "VERIFIED"
    assert cell["certificate"] == str(path)
    with closing(sqlite3.connect(tmp_path / NAME)) as store, store:
        store.execute(
            "UPDATE cells SET conclusion = 'all is well', verdict = 'REFUTED' "
            "WHERE verdict = 'VERIFIED'"
        )
    assert atlas.main([*out, "--cell", "0.2122", "-0.2001"]) == 0
    said = capsys.readouterr().out
    assert "VERIFIED: At eta in [0.2121, 0.2124]" in said and "well" not in said
    with closing(sqlite3.connect(tmp_path / NAME)) as store, store:
        other = (
            "SELECT certificate FROM cells AS o WHERE o.key != cells.key AND certificate NOT NULL"
        )
        store.execute(f"UPDATE cells SET certificate = ({other} LIMIT 1)")
    assert atlas.main([*out, "--cell", "0.2122", "-0.2001"]) == 1
    assert "about other parameters" in capsys.readouterr().err


@pytest.mark.slow
def test_the_picture_has_what_is_proved_and_no_more(tmp_path, draw):
    with opened(
        tmp_path, atlas.Region((F("0.45"), F("0.5")), (F("0.1"), F("0.6")), "horseshoe")
    ) as store:
        run(store, 2, (Here(), 1), 16)
        made = summary.summary(store)
        with style("atlas"):
            drawing = picture.picture(store.region, picture.shown(store, made))
        (path,) = drawing.axes[0].patches[1:]  # but for what is below it
        draw(tmp_path, store, made, cost.costs(store))
        proved = {cell.key for cell in store.cells(Verdict.REFUTED)}
        inside = [path.get_path().contains_point(middle(store.region.box(key))) for key in proved]
        left = [cell.key for cell in store.cells(Verdict.UNDECIDED)]
    assert proved and all(inside) and left
    assert not any(path.get_path().contains_point(middle(store.region.box(key))) for key in left)
    assert (tmp_path / "atlas.png").read_bytes().startswith(b"\x89PNG")
    words, share = "every motion comes to rest", made["share_of_area"]["AtRest"]
    for name in ("atlas.svg", "atlas.html"):
        text = (tmp_path / name).read_text()
        assert words in text and percent(share) in text
    assert "cut in four" in (tmp_path / "cost.svg").read_text()


def middle(box):
    return float(sum(box.eta)) / 2, float(sum(box.nu)) / 2


@pytest.mark.slow
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
            try:
                with opened(tmp_path, None) as store:
                    now = sum(1 for _ in store.rows())
            except Held as early:
                assert "has no region" in str(early)
                now = 0
            assert now >= rows  # what was there is there
            rows = now
    assert start(tmp_path).wait() in (0, 1)
    return check_store(tmp_path / NAME)


def whole(found):
    return found.missing == 0 and sum(found.areas.values()) == found.whole


@pytest.mark.slow
def test_a_head_that_is_killed_three_times(tmp_path):
    assert whole(survives(tmp_path, 3, 1))


@pytest.mark.long
def test_a_head_that_is_killed_fifty_times(tmp_path):
    for seed in range(5):
        folder = tmp_path / str(seed)
        folder.mkdir()
        assert whole(survives(folder, 10, seed))


@pytest.mark.slow
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


@pytest.mark.slow
def test_a_second_head_is_refused(tmp_path, capsys):
    assert atlas.main([*SMALL, "--depth", "0", "--out", str(tmp_path)]) == 1
    with opened(tmp_path, None):
        with pytest.raises(Held, match="another run"), opened(tmp_path, None):
            pass
        command = [sys.executable, "-m", "proofs.atlas", "--out", str(tmp_path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "another run writes to" in done.stderr


@pytest.mark.slow
def test_a_store_may_be_read_while_a_run_ends(tmp_path):
    """As the checker reads it, row by row; a run that begins meanwhile is refused in a line."""
    assert atlas.main([*SMALL, "--depth", "1", "--quiet", "--out", str(tmp_path)]) == 1
    with closing(sqlite3.connect(tmp_path / NAME)) as reader:
        with opened(tmp_path, None) as store:
            reading = reader.execute("SELECT key FROM cells")
            assert reading.fetchone()
            store.reopen(2)
        assert len(reading.fetchall()) == 4
    with closing(sqlite3.connect(tmp_path / NAME)) as reader:
        assert reader.execute("PRAGMA journal_mode = DELETE").fetchone() == ("delete",)
        reading = reader.execute("SELECT key FROM cells")
        assert reading.fetchone()
        with pytest.raises(Held, match="locked"), opened(tmp_path, None):
            pass


def test_what_is_no_store_is_one_line(tmp_path, capsys):
    (tmp_path / NAME).write_text("no store, and long enough for a header of a hundred bytes" * 9)
    with pytest.raises(SystemExit) as left:
        atlas.main([*SMALL, "--out", str(tmp_path)])
    said = capsys.readouterr().err
    assert left.value.code == 2 and "not a database" in said and said.count("\n") == 1


def test_what_is_left_are_roots_and_quarters_that_are_not_there(tmp_path):
    region = atlas.Region((F("0.9"), F("1.1")), (F("0.1"), F("0.2")), "horseshoe")
    with opened(tmp_path, region) as store:
        assert store.left() == [("0/", ""), ("1/", "")]
        parent = without_proof(region, "0/", SPLIT, "")._replace(sets="near")
        store.put([parent, without_proof(region, "0/2", "UNDECIDED", "why")])
        assert store.left() == [(key, "near") for key in ("0/0", "0/1", "0/3")] + [("1/", "")]
        store.put([without_proof(region, key, "UNDECIDED", "") for key in ("0/0", "0/1", "1/")])
        assert store.left() == [("0/3", "near")]


@pytest.mark.slow
def test_memory_does_not_grow_with_the_number_of_cells(tmp_path):
    """The head's own, of a region that is cut down to the depth everywhere."""

    class Cuts(Here):
        def submit(self, work, /, *data, **more):
            region, depth, todo = data
            ends = [SPLIT if len(key) - 2 < depth else "UNDECIDED" for key, _ in todo]
            rows = [
                without_proof(region, key, end, "")
                for (key, _), end in zip(todo, ends, strict=True)
            ]
            return super().submit(lambda: rows)

    region = atlas.Region((F("0.2"), F("0.3")), (F("0.1"), F("0.2")), "horseshoe")
    peaks, counts = [], []
    for depth in (3, 5):
        with opened(tmp_path, region) as store:
            tracemalloc.start()
            counts.append(run(store, depth, (Cuts(), 1), 16))
            peaks.append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
        (tmp_path / NAME).unlink()
    assert counts == [85, 1365] and peaks[1] < 2 * peaks[0]


@pytest.fixture
def small(tmp_path):
    """An atlas with two cells that are proved, and two that are not."""
    region = atlas.Region((F("0.2121"), F("0.2122")), (F("-0.2"), F("-0.1999")), "horseshoe")
    with opened(tmp_path, region) as store:
        store.put([without_proof(region, "0/", SPLIT, "")])
        store.put([without_proof(region, key, "UNDECIDED", "why") for key in ("0/0", "0/3")])
        store.put(decide(region, 1, [("0/1", ""), ("0/2", "")]))
    return tmp_path


def test_cells_as_a_table_are_those_of_the_store(small, capsys, monkeypatch):
    parquet = pytest.importorskip("pyarrow.parquet")
    monkeypatch.setattr("proofs.plane.export._AT_A_TIME", 3)
    path = small / "cells.parquet"
    assert atlas.main(["--out", str(small), "--export", str(path)]) == 0
    assert f"4 cells: {path}" in capsys.readouterr().out
    table = parquet.read_table(path)
    assert json.loads(table.schema.metadata[b"atlas"])["question"] == "horseshoe"
    rows = {row["key"]: row for row in table.to_pylist()}
    with opened(small, None) as store:
        cells = {cell.key: cell for cell in store.rows() if cell.verdict != SPLIT}
        region = store.region
    assert rows.keys() == cells.keys() and rows["0/0"]["certificate"] is None
    for key, row in rows.items():
        cell, box = cells[key], region.box(key)
        assert all(
            row[name] == getattr(cell, name)
            for name in row.keys() & {*cell._fields} - {"certificate"}
        )
        assert (row["eta_from"], row["eta_to"]) == tuple(map(float, box.eta))
        assert (row["nu_from"], row["nu_to"]) == tuple(map(float, box.nu))
        if key in ("0/1", "0/2"):
            assert prove(row["certificate"]).parameters == box


def test_a_table_that_cannot_be_written_is_one_line(small, capsys, monkeypatch):
    monkeypatch.setattr(atlas, "find_spec", lambda name: None)
    with pytest.raises(SystemExit) as left:
        atlas.main(["--out", str(small), "--export", "cells.parquet"])
    said = capsys.readouterr().err
    assert left.value.code == 2 and "impact-proofs[parquet]" in said and said.count("\n") == 1
    monkeypatch.undo()
    pytest.importorskip("pyarrow")
    with pytest.raises(SystemExit) as left:
        atlas.main(["--out", str(small), "--export", str(small)])
    said = capsys.readouterr().err
    assert left.value.code == 2 and "not a regular file" in said and said.count("\n") == 1


def test_a_check_without_a_reader_blames_no_file(small, monkeypatch):
    """Where output is not buffered, as by python -u: the file can be read, the line not written."""

    def closed(text, stream=None):
        if stream is None:
            raise BrokenPipeError

    monkeypatch.setattr("proofs.check.say", closed)
    with pytest.raises(BrokenPipeError):
        check([str(small / NAME)])


def test_the_checker_reads_few_rows_ahead_and_keeps_their_order():
    read = []
    rows = (read.append(k) or k for k in range(10_000))
    found = _mapped(Here(), 2, str, rows)
    assert [next(found) for _ in range(5)] == ["0", "1", "2", "3", "4"] and len(read) < 500
    assert list(found) == [str(k) for k in range(5, 10_000)]


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
    assert "4 cells, 1 of the area: a stable single-impact orbit: n = 1" in said
    assert check([str(tmp_path / NAME)]) == 0
    with pytest.raises(SystemExit):
        atlas.main([*asked, "--epsilon", "0", *out])
    assert "another region" in capsys.readouterr().err
    assert atlas.main(["--out", str(tmp_path), "--cell", "0.6", "-0.75"]) == 0
    assert "epsilon = 0.3: there is exactly one stable" in capsys.readouterr().out


@pytest.mark.parametrize(
    "more",
    [
        ["--json", "NOWHERE/atlas.json"],
        ["--export", "cells.parquet", "--json", "-"],
        ["--export", "cells.parquet", "--cell", "0.2122", "-0.2"],
    ],
)
def test_no_work_for_a_form_that_cannot_be_written(tmp_path, capsys, more, monkeypatch):
    monkeypatch.setattr(atlas, "opened", None)
    monkeypatch.setattr(atlas, "_parquet", Path)
    (tmp_path / "file").touch()
    more = [each.replace("NOWHERE", str(tmp_path / "file")) for each in more]
    with pytest.raises(SystemExit) as left:
        atlas.main([*SMALL, "--out", str(tmp_path / "out"), *more])
    assert left.value.code == 2 and capsys.readouterr().err.count("\n") == 1


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

"""The command and its store: nothing lost, nothing twice, one writer at a time."""

import contextvars
import json
import math
import random
import signal
import sqlite3
import subprocess
import sys
import time
from concurrent.futures import Future
from contextlib import closing
from fractions import Fraction
from functools import partial
from hashlib import sha256

import pytest

from proofs.check import _mapped
from proofs.check import main as check
from proofs.commands import atlas
from proofs.plane import picture, summary
from proofs.plane.cells import decide
from proofs.plane.head import Here, run
from proofs.plane.store import LEAVES, LINES, NAME, SAMPLE, SPLIT, Held, Row, opened
from proofs.report.figures.style import style
from proofs.report.layout import percent
from proofs.trusted.atlas import LEFT_OUT, NOT_YET, check_atlas
from proofs.trusted.kernel.meter import METER, metered
from proofs.trusted.verdicts import Verdict

F = Fraction
SMALL = ["--eta", "0.2115", "0.2127", "--nu", "-0.201", "-0.199", "--ask", "horseshoe"]
LARGE = ["--eta", "0.211", "0.2134", "--nu", "-0.204", "-0.2", "--ask", "horseshoe"]


@pytest.fixture(autouse=True)
def draw(monkeypatch):
    """Pictures take longer than all else here: what makes one is returned, not done."""
    made = atlas._draw
    monkeypatch.setattr(atlas, "_draw", lambda folder, store, made: "atlas.html")
    return made


def proved(folder):
    """What the checker makes of the lines of a store."""
    with opened(folder, None) as store:
        return check_atlas(store.lines(), math.inf)


def start(folder, depth=3, **streams):
    command = [sys.executable, "-m", "proofs.commands.atlas", *LARGE, "--depth", str(depth)]
    command += ["--chunk", "3", "--out", str(folder), "--quiet"]
    listen = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # a background job ignores it
    return subprocess.Popen(command, preexec_fn=listen, **streams)  # noqa: PLW1509


@pytest.mark.slow
def test_an_atlas_and_a_cell_of_it(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert atlas.main([*SMALL, "--depth", "2", *out]) == 0
    said = capsys.readouterr().out
    assert "VERIFIED         16 cells, 1 of the area" in said and "Opposite: " in said
    made = json.loads((tmp_path / "atlas.json").read_text())
    assert made["cells"] == {"VERIFIED": 16} and made["kinds"] == {"EntropyBound": 16}
    lines = tmp_path / LINES
    assert made["digest"] == f"sha256:{sha256(lines.read_bytes()).hexdigest()}"
    assert check([str(lines)]) == 0
    assert "16 VERIFIED cells, all as their certificates prove" in capsys.readouterr().out
    assert check([str(lines), "--jobs", "2", "--quiet"]) == 0
    assert check([str(lines), "--work", made["checker_work"]]) == 0
    few = list(map(json.loads, (tmp_path / SAMPLE).read_text().splitlines()))[1:]
    kept = [line["cell"] for line in few if line["certificate"]]
    assert len(kept) == 10 and (kept[0], kept[-1]) == ("0/00", "0/32")
    assert check([str(tmp_path / SAMPLE)]) == 1  # the other cells are not looked at
    capsys.readouterr()
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
        draw(tmp_path, store, made)
        proved = {cell.key for cell in store.cells(Verdict.REFUTED)}
        inside = [
            path.get_path().contains_point(middle(store.region.subject.at(store.region.sides(key))))
            for key in proved
        ]
        left = [cell.key for cell in store.cells(Verdict.UNDECIDED)]
    assert proved and all(inside) and left
    assert not any(
        path.get_path().contains_point(middle(store.region.subject.at(store.region.sides(key))))
        for key in left
    )
    assert (tmp_path / "atlas.png").read_bytes().startswith(b"\x89PNG")
    words, share = "every motion comes to rest", made["share_of_area"]["AtRest"]
    for name in ("atlas.svg", "atlas.html"):
        text = (tmp_path / name).read_text()
        assert words in text and percent(share) in text


def middle(box):
    return float(sum(box.eta)) / 2, float(sum(box.nu)) / 2


@pytest.mark.slow
def test_it_goes_on_and_deeper(tmp_path, capsys):
    out = ["--out", str(tmp_path)]
    assert atlas.main([*SMALL, "--depth", "1", *out]) == 1
    assert "4 cells undecided" in capsys.readouterr().out
    assert atlas.main([*SMALL, "--depth", "1", *out]) == 1
    said = capsys.readouterr().out
    assert "0 cells looked at now" in said
    assert said.splitlines()[-1] == f"all of it: {tmp_path / 'atlas.html'}"
    assert atlas.main(["--depth", "2", *out]) == 0
    assert "16 cells looked at now" in capsys.readouterr().out
    assert proved(tmp_path).shares == {"VERIFIED": 1}


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
                    now = store.total("1")
            except Held as early:
                assert "has no region" in str(early)
                now = 0
            assert now >= rows  # what was there is there
            rows = now
    assert start(tmp_path).wait() in (0, 1)
    return proved(tmp_path)


def has_rows(path):
    with closing(sqlite3.connect(path)) as store:
        try:
            return store.execute("SELECT count(*) FROM cells").fetchone()[0] > 0
        except sqlite3.OperationalError:  # no table yet, or it is being written
            return False


@pytest.mark.slow
def test_an_interrupt_says_that_all_is_saved_and_what_goes_on(tmp_path):
    process = start(tmp_path, 12, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not has_rows(tmp_path / NAME):
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    (said,) = process.communicate()[1].splitlines()
    assert process.returncode == 130 and "interrupted; what is done is saved" in said
    goes_on = said.partition("python -m proofs atlas ")[2].removesuffix(" goes on").split()
    assert goes_on == ["--out", str(tmp_path), "--depth", "12"]
    with opened(tmp_path, None) as store:
        assert store.left()


def whole(found):
    return NOT_YET not in found.shares and sum(found.shares.values()) == 1


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
    with opened(tmp_path, None) as store:
        assert 0 < store.total("1") < 21
    assert proved(tmp_path).shares == {NOT_YET: 1}
    with opened(tmp_path, region) as store:
        run(store, 2, (Here(), 1), 2)
    assert whole(proved(tmp_path))


@pytest.mark.slow
def test_a_second_head_is_refused(tmp_path, capsys):
    assert atlas.main([*SMALL, "--depth", "0", "--out", str(tmp_path)]) == 1
    with opened(tmp_path, None):
        with pytest.raises(Held, match="another run"), opened(tmp_path, None):
            pass
        command = [sys.executable, "-m", "proofs", "atlas", "--out", str(tmp_path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "another run writes to" in done.stderr


def test_what_is_no_store_is_one_line(tmp_path, capsys):
    (tmp_path / NAME).write_text("no store, and long enough for a header of a hundred bytes" * 9)
    with pytest.raises(SystemExit) as left:
        atlas.main([*SMALL, "--out", str(tmp_path)])
    said = capsys.readouterr().err
    assert left.value.code == 2 and "not a database" in said and said.count("\n") == 1


@pytest.fixture
def small(tmp_path):
    """An atlas with two cells that are proved, and two that are not."""
    region = atlas.Region((F("0.2121"), F("0.2122")), (F("-0.2"), F("-0.1999")), "horseshoe")
    with opened(tmp_path, region) as store:
        store.put([Row("0/", SPLIT)])
        store.put([Row(key, "UNDECIDED", "", "why") for key in ("0/0", "0/3")])
        store.put(decide(region, 1, [("0/1", ""), ("0/2", "")]))
    return tmp_path


@pytest.mark.slow
def test_lines_of_what_there_is(small, capsys):
    """Also while cells are not looked at; what reads it are others' tables, too."""
    assert atlas.main(["--out", str(small), "--lines"]) == 0
    path = small / LINES
    shares = check_atlas(path.read_text().splitlines()).shares
    assert shares == {"VERIFIED": F(1, 2), "UNDECIDED": F(1, 2)}
    with opened(small, None) as store:
        there = {cell.key: cell for cell in store.cells(*LEAVES)}
    pandas = pytest.importorskip("pandas")
    table = pandas.read_json(path, lines=True).iloc[1:].set_index("cell")
    assert [*table.index] == sorted(there)
    for key, row in table.iterrows():
        assert (row.verdict, row.kind, row.says) == there[key][1:4]
        assert row.certificate == (json.loads(there[key].text) if row.kind else None)
    duckdb = pytest.importorskip("duckdb")
    counted = duckdb.sql(
        f"SELECT verdict, count(certificate) FROM '{path}' WHERE cell NOTNULL GROUP BY ALL"
    )
    assert {*counted.fetchall()} == {("VERIFIED", 2), ("UNDECIDED", 0)}


def test_what_is_not_looked_at_are_lines_and_so_is_the_strip(tmp_path):
    region = atlas.Region((F("0.9"), F("1.1")), (F("-0.1"), F("0.2")), "horseshoe")
    with opened(tmp_path, region) as store:
        store.put([Row("1/", SPLIT), Row("1/12", "UNDECIDED"), Row("1/2", "UNDECIDED")])
        keys = [json.loads(line).get("cell") for line in store.lines()]
    assert keys == [
        None,
        "0/",
        "1/0",
        "1/10",
        "1/11",
        "1/12",
        "1/13",
        "1/2",
        "1/3",
        "2/",
        "3/",
        "4/",
    ]
    found = proved(tmp_path)
    assert found.cells == {NOT_YET: 8, "UNDECIDED": 2, LEFT_OUT: 1}
    assert found.shares[LEFT_OUT] == F(1, 2**20) and sum(found.shares.values()) == 1
    assert found.shares["UNDECIDED"] == (1 - F(1, 2**20)) * F(1, 2) * F(1, 3) * F(5, 16)


def test_a_store_is_not_checked_but_its_lines_are(small, capsys):
    assert check([str(small / NAME)]) == 2
    said = capsys.readouterr().err
    assert f"python -m proofs atlas --out {small} --lines" in said and said.count("\n") == 1


def test_a_store_of_another_version_is_refused_by_name(small, capsys):
    with closing(sqlite3.connect(small / NAME)) as store, store:
        store.execute("UPDATE region SET text = replace(text, 'atlas/2', 'atlas/1')")
    held = (small / NAME).read_bytes()
    with pytest.raises(SystemExit) as left:
        atlas.main(["--out", str(small)])
    said = capsys.readouterr().err
    assert left.value.code == 2 and "of another version" in said and said.count("\n") == 1
    assert (small / NAME).read_bytes() == held


def test_the_checker_reads_few_lines_ahead_keeps_their_order_and_adds_up_their_work():
    read = []
    rows = (read.append(k) or k for k in range(10_000))

    def spends(k):
        METER.get().spend(2)
        return str(k)

    class Apart(Here):
        def submit(self, work, /, *data, **more):
            return super().submit(contextvars.Context().run, work, *data, **more)

    with metered(20_000) as meter:
        found = _mapped(Apart(), 2, 1000, spends, rows)
        assert [next(found) for _ in range(5)] == ["0", "1", "2", "3", "4"] and len(read) < 500
        assert list(found) == [str(k) for k in range(5, 10_000)]
        assert meter.spent == 20_000


def test_orbits_with_restitution(tmp_path, capsys):
    asked = ["--eta", "0.59", "0.61", "--nu", "-0.76", "-0.74", "--ask", "orbits:3"]
    out = ["--depth", "1", "--out", str(tmp_path)]
    assert atlas.main([*asked, "--epsilon", "0.3", *out]) == 0
    said = capsys.readouterr().out
    assert "4 cells, 1 of the area: a stable single-impact orbit: n = 1" in said
    assert check([str(tmp_path / LINES)]) == 0
    with pytest.raises(SystemExit):
        atlas.main([*asked, "--epsilon", "0", *out])
    assert "another region" in capsys.readouterr().err
    assert atlas.main(["--out", str(tmp_path), "--cell", "0.6", "-0.75"]) == 0
    assert "epsilon = 0.3: there is exactly one stable" in capsys.readouterr().out

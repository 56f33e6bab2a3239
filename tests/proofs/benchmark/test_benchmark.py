"""The command, its page and its status; single operations and arrays: all do the same work."""

import json
import re
import sys
from fractions import Fraction

import numpy as np
import pytest

from intervals import IntervalArray
from proofs.benchmark import __main__ as command
from proofs.benchmark import horseshoe, operations
from proofs.benchmark.__main__ import main
from proofs.benchmark.curves import Curve, Diagram, Point
from proofs.benchmark.measure import Row
from proofs.benchmark.operations import ARRAY
from proofs.benchmark.page import Section
from proofs.benchmark.peers import FLINT, IV, OURS

MISSED, REACHED = Row("ratio", "5.00", "<= 4", False), Row("loss|", "1e-30", "< 1e-20", True)


def measured(monkeypatch, *sections):
    """Have a run measure these sections, at once."""
    monkeypatch.setattr(command, "measure", lambda options, tell: iter(sections))


def diagram():
    return Diagram("curves", "Work", curves=[Curve("work", "way", "kB", points=[Point(2, 1, [1])])])


def test_an_absent_peer_and_a_failing_process_are_reported(monkeypatch, capsys):
    done = horseshoe.Process(1.0, 0, 99.0)
    monkeypatch.setattr(horseshoe, "process", lambda command: done)
    monkeypatch.setattr(horseshoe, "libraries", lambda: [])
    assert main(["limit"]) == 1
    text = capsys.readouterr().out
    assert "python-flint is absent" in text and "1 not measured" in text
    monkeypatch.undo()
    with pytest.raises(ChildProcessError, match="exit status 3"):
        horseshoe.process(["-c", "raise SystemExit(3)"])


@pytest.mark.parametrize(
    ("row", "status"),
    [(REACHED, 0), (Row("no target", "1"), 0), (Row("ratio", "absent", ">= 10"), 1),
     (Row("not an enclosure", "1", "", False), 1), (MISSED, 1)],
)  # fmt: skip
def test_the_status_is_0_if_all_that_is_asked_is_reached(monkeypatch, row, status):
    measured(monkeypatch, Section("A title", "About.", [REACHED, row]))
    assert main([]) == status


def test_help_has_examples(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--help"])
    assert stopped.value.code == 0 and "examples:" in capsys.readouterr().out


@pytest.mark.slow
def test_the_page_says_what_was_measured_and_shows_it(monkeypatch, tmp_path, capsys):
    pytest.importorskip("matplotlib")
    rows = [MISSED, REACHED, Row("rate", "absent", ">= 10"), Row("other", "1", samples={"s": 2})]
    measured(monkeypatch, Section("First", "About it.", rows, [diagram()]))
    out, samples = tmp_path / "new" / "out", tmp_path / "samples.json"
    assert main(["--out", str(out), "--json", str(samples)]) == 1
    assert "3 targets: 1 reached, 1 missed, 1 not measured" in capsys.readouterr().out
    names = {"benchmark.md", "benchmark.json", "benchmark-curves.svg"}
    assert {path.name for path in out.iterdir()} == names
    text = (out / "benchmark.md").read_text()
    assert "Missed: ratio: 5.00.\n\nMissed: rate: absent." in text
    assert "## First\n\nAbout it.\n\n| what " in text
    assert re.search(r"^\| loss\\\| +\| < 1e-20 \| 1e-30 +\| yes +\|$", text, re.M)
    assert "Drawn by the command: `benchmark-curves.svg`.\n" in text
    for private in (str(tmp_path), sys.prefix):
        assert private not in text
    data = json.loads((out / "benchmark.json").read_text())
    assert data["subject"] == "all" and data["rows"][3]["samples"] == {"s": 2}
    assert {"python", "numpy", "scipy", "processors"} <= set(data)
    assert samples.read_text() == (out / "benchmark.json").read_text()
    assert main(["--json", "-"]) == 1
    assert json.loads(capsys.readouterr().out)["rows"][0]["name"] == "ratio"


def test_without_matplotlib_the_page_has_no_pictures(monkeypatch, tmp_path, capsys):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    measured(monkeypatch, Section("First", "About.", [REACHED], [diagram()]))
    assert main(["--out", str(tmp_path)]) == 0
    assert "no pictures" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.svg"))


# -- arrays ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", operations.NAMES)
@pytest.mark.parametrize("kind", operations.KINDS)
def test_widths_are_counted(kind, name):
    lower = np.linspace(0.1, 3, 40)
    upper = lower + 2.0**-9
    done = operations.computed(kind, name, lower, upper)()
    beyond = operations.excess(done, name, lower, upper)
    assert 0 <= beyond.max() <= (3 if kind is IntervalArray else 1)

    wider = kind.from_floats(done.inf, np.nextafter(done.sup, np.inf))
    assert operations.excess(wider, name, lower, upper).mean() > beyond.mean()


def test_a_row_for_each_operation_and_kind():
    section = operations.measure_arrays("smallest", lambda _: None)
    assert len(section.rows) == len(operations.NAMES) * len(operations.KINDS)
    assert all("ulps" in row.measured for row in section.rows)
    assert IntervalArray.__name__ in section.rows[0].name


# -- single operations -----------------------------------------------------------------------------


flint = pytest.importorskip("flint")
COUNT = 9


def flat(found):
    """Return pairs of exact ends."""
    if isinstance(found, flint.arb):
        ends = (end.man_exp() for end in (found.lower(), found.upper()))
        return [tuple(int(m) * Fraction(2) ** int(e) for m, e in ends)]
    if hasattr(found, "_mpi_"):  # mpmath.iv
        ends = ((-1) ** s * int(m) * Fraction(2) ** e for s, m, e, _ in found._mpi_)
        return [tuple(ends)]
    if hasattr(found, "inf"):  # ours
        ends = np.ravel(found.inf).tolist(), np.ravel(found.sup).tolist()
        return [tuple(map(Fraction, pair)) for pair in zip(*ends, strict=True)]
    return [pair for one in getattr(found, "tolist", found.__iter__)() for pair in flat(one)]


@pytest.mark.parametrize("name", operations._TEXTS)
def test_all_libraries_do_the_same_work(name):
    found = {}
    for library in (ARRAY, OURS, FLINT, IV):
        text = operations.statement(name, library)
        if (name, library) != ("hypot", FLINT):  # which has none
            found[library] = flat(eval(text, operations.operands(library, 53, COUNT)))
    for library, pairs in found.items():
        assert len(pairs) == len(found[OURS]), library
        for (low, high), (least, most) in zip(pairs, found[OURS], strict=True):
            assert low <= most and least <= high, library
            assert abs(low - least) <= max(high - low, most - least), library

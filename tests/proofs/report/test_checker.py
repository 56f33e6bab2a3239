"""The checker inside the page: the browser derives every verdict, and it is said where not."""

import io
import json
import shutil
import zipfile

import pytest

from proofs.report import __main__ as command
from proofs.report.checker import NoPyodide, checker, runtime, trusted
from proofs.report.figures.figure import Certificates
from proofs.report.findings import findings
from tests.proofs.report.conftest import CHROMIUM


def test_the_archive_holds_the_trusted_part_alone_and_is_the_same_each_time():
    names = zipfile.ZipFile(io.BytesIO(trusted())).namelist()
    assert "proofs/trusted/verify.py" in names and "proofs/__init__.py" in names
    others = [name for name in names if not name.startswith("proofs/trusted/")]
    assert others == ["proofs/__init__.py"] and trusted() == trusted()


def test_without_pyodide_one_line_and_nothing_is_written(small, tmp_path_factory, capsys):
    empty = tmp_path_factory.mktemp("empty")
    before = sorted(small.iterdir())
    assert command.main(["--out", str(small), "--pyodide", str(empty)]) == 1
    assert capsys.readouterr().err.count("\n") == 1 and sorted(small.iterdir()) == before


def test_other_modules_than_pyodide_s_are_refused(tmp_path, small):
    for name in ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip"):
        (tmp_path / name).write_text("export {a as b};")
    (tmp_path / "pyodide-lock.json").write_text("{}")
    with runtime(tmp_path) as folder, pytest.raises(NoPyodide, match="are not those"):
        checker(folder, small, ["horseshoe.json"])


@pytest.fixture(scope="module")
def pyodide():
    if shutil.which("npm") is None:
        pytest.skip("no npm")
    try:
        with runtime(None) as folder:
            yield folder
    except NoPyodide as error:
        pytest.skip(str(error))


@pytest.fixture
def derive(small, pyodide, tmp_path):
    """Have the browser derive all again, from the certificates of a folder; return what it says."""
    html = pytest.importorskip("proofs.report.html")
    playwright = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("no chromium")
    found = findings(small, Certificates(small))

    def derive(certificates, change=""):
        path = tmp_path / "checker.html"
        embedded = checker(pyodide, certificates, ["horseshoe.json"])
        path.write_text(html.page(found, [], {}, embedded), encoding="utf-8")
        with playwright.sync_playwright() as running:
            browser = running.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
            tab = browser.new_page()
            asked = []
            tab.on("request", lambda request: asked.append(request.url))
            tab.goto(path.as_uri())
            tab.evaluate(change or "0")
            tab.click("#checker button")
            tab.wait_for_function(
                "/here, in|failed/.test(document.querySelector('#checker output').value)",
                timeout=180_000,
            )
            assert all(url.startswith(("file:", "blob:")) for url in asked)
            return tab.text_content("#checker output"), tab.text_content("#checker ol")

    return derive


@pytest.mark.slow
@pytest.mark.long
def test_the_browser_derives_every_verdict(small, derive):
    told, lines = derive(small)
    assert told.startswith("3 of 3 verdicts derived here")
    assert "horseshoe: 3 of 3" in lines


@pytest.mark.slow
@pytest.mark.long
def test_a_verdict_that_is_not_derived_is_said_loudly(small, derive):
    told, _ = derive(small, "document.getElementById('H2').dataset.verdict = 'VERIFIED'")
    assert told.startswith("NOT ALL AS PRINTED: 2 of 3")


@pytest.mark.slow
@pytest.mark.long
def test_a_certificate_that_proves_nothing_is_said_loudly(small, derive, tmp_path_factory):
    folder = tmp_path_factory.mktemp("forged")
    document = json.loads((small / "horseshoe.json").read_text())
    entry = next(each for each in document["claims"] if each["id"] == "H2")
    entry["verdict"] = "VERIFIED"
    (folder / "horseshoe.json").write_text(json.dumps(document))
    told, lines = derive(folder)
    assert told.startswith("NOT ALL AS PRINTED: 0 of 3") and "rejected" in lines

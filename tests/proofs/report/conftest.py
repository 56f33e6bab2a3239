"""The report of the certificates that are committed, made once."""

import json
import shutil

import pytest

from proofs.report.atlases import atlases
from proofs.report.build import shown as shown_figures
from proofs.report.figures.figure import Certificates
from proofs.report.findings import findings
from tests.once import REPORTS, report

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


@pytest.fixture(scope="session")
def browser():
    """Headless Chromium, where it is installed."""
    playwright = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("no chromium")
    with playwright.sync_playwright() as running:
        yield running.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])


@pytest.fixture
def visit(browser):
    """Open a page from the disk; it must be quiet, and load nothing."""
    opened, noise, asked = [], [], set()

    def visit(path, place="", width=1280, colours="light", **more):
        tab = browser.new_page(
            viewport={"width": width, "height": 900}, color_scheme=colours, **more
        )
        opened.append(tab)
        asked.add(path.as_uri())
        tab.on("console", lambda message: noise.append(message.text))
        tab.on("pageerror", lambda error: noise.append(str(error)))
        tab.on("request", lambda request: noise.append(request.url.partition("#")[0]))
        tab.goto(path.as_uri() + place)
        return tab

    yield visit
    for tab in opened:
        tab.close()
    assert set(noise) == asked


class Committed(Certificates):
    """The committed certificates, each derived once for all workers."""

    def __getitem__(self, name):
        return report(name).context


@pytest.fixture(scope="session")
def documents():
    """What the committed certificates prove."""
    return Committed(REPORTS)


@pytest.fixture(scope="session")
def found(documents):
    """What they prove."""
    return findings(REPORTS, documents)


@pytest.fixture(scope="session")
def shown(found, documents):
    """The figures that belong to it."""
    return shown_figures(documents, [claim.id for claim in found.claims])


@pytest.fixture(scope="session")
def page(found, shown):
    """The page about it, with the figures that are committed."""
    html = pytest.importorskip("proofs.report.html")
    files = {x.name: (REPORTS / "figures" / f"{x.name}.svg").read_text() for x in shown}
    return html.page(found, shown, files, atlases=atlases(REPORTS))


@pytest.fixture
def small(tmp_path):
    """A folder with the horseshoe's certificate, and a ledger of three of its claims."""
    entries = json.loads((REPORTS / "ledger.json").read_text())
    entries["claims"] = [x for x in entries["claims"] if x["id"] in ("H2", "H5", "H11")]
    (tmp_path / "ledger.json").write_text(json.dumps(entries))
    shutil.copy(REPORTS / "horseshoe.json", tmp_path)
    return tmp_path

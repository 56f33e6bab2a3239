"""The report of the certificates that are committed, made once."""

import json
import shutil

import pytest

from proofs.report.figures.figure import Certificates
from proofs.report.findings import findings
from proofs.report.pictures import pictures
from tests.once import REPORTS, report


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
    return pictures(documents, [claim.id for claim in found.claims])


@pytest.fixture(scope="session")
def page(found, shown):
    """The page about it, with the figures that are committed."""
    html = pytest.importorskip("proofs.report.html")
    files = {x.name: (REPORTS / "figures" / f"{x.name}.svg").read_text() for x in shown}
    return html.page(found, shown, files)


@pytest.fixture
def small(tmp_path):
    """A folder with the horseshoe's certificate, and a ledger of three of its claims."""
    entries = json.loads((REPORTS / "ledger.json").read_text())
    entries["claims"] = [x for x in entries["claims"] if x["id"] in ("H2", "H5", "H11")]
    (tmp_path / "ledger.json").write_text(json.dumps(entries))
    shutil.copy(REPORTS / "horseshoe.json", tmp_path)
    return tmp_path

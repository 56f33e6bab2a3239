"""The repaired rectangles with restitution in Coq: accepted, from what, and what is refused."""

import re
import shutil

import pytest

from proofs.formal import coqc
from tests.proofs.formal.coq import edited, needs_coqc

pytestmark = [pytest.mark.long, pytest.mark.slow, needs_coqc]

THEOREMS = ("repaired_horseshoe", "repaired_hyperbolic", "printed_edge_falls_short")
REPAIRED = (coqc.THEORY / "Repaired.v").read_text()


@pytest.fixture(scope="module")
def restitution(tmp_path_factory):
    """The folder with all that Repaired.v requires, compiled."""
    folder = tmp_path_factory.mktemp("restitution")
    modules = coqc.order(REPAIRED)
    coqc.copy(coqc.theory(modules, print), folder, modules, ".vo")
    return folder


def asked(folder, name, text):
    (folder / f"{name}.v").write_text(text)
    return coqc.run(folder, name)


def test_repaired_horseshoe_rests_on_the_axioms_of_the_reals(restitution):
    listed = "".join(f"Print Assumptions {name}.\n" for name in THEOREMS)
    parts = asked(restitution, "Repaired", f"{REPAIRED}\n{listed}").output.split("\nAxioms:\n")[1:]
    assert len(parts) == len(THEOREMS)
    for part in parts:
        names = re.findall(r"^(\w[\w.']*)(?= :|$)", part.split("Chars")[0], re.MULTILINE)
        assert set(names) == coqc.REALS


@pytest.mark.parametrize(
    ("lemma", "edits"),
    [
        ("rates0", [("3 <= DP_p", "5 <= DP_p")]),
        ("velocity0_0", [("Notation g0 := (-9 / 20)", "Notation g0 := (-2 / 5)")]),
        ("right1", [("(133 / 100)", "(132 / 100)"), ("133/100", "132/100")]),
        ("launch0", [("Notation side := (-1)", "Notation side := 1")]),
        ("repaired_horseshoe", [("g0 g1 2 (4 / 5) size", "g0 g1 2 (2 / 5) size")]),
    ],
)
def test_false_rectangles_are_refused(restitution, tmp_path, lemma, edits):
    for path in restitution.glob("*.vo"):
        shutil.copy(path, tmp_path)
    with pytest.raises(coqc.Refused) as refused:
        asked(tmp_path, "False", edited(REPAIRED, *edits))
    assert refused.value.lemma == lemma

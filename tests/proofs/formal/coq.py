"""What the tests of the Coq files share: certificates, the compiled theory, edited cases."""

import fcntl
import re
import shutil
import subprocess
from contextlib import redirect_stdout
from functools import cache, partial
from pathlib import Path

import pytest

from proofs import horseshoe
from proofs.formal import __main__ as formal
from proofs.formal import coqc
from proofs.formal.cases import case
from proofs.formal.plan import plan

ROOT = Path(__file__).parents[3]
PAPER = ROOT / "reports" / "horseshoe.json"
CLAIMS = ("H1", "H2", "H3", "H4", "H5", "H6")
needs_coqc = pytest.mark.skipif(shutil.which("coqc") is None, reason="coqc is not there")


def certificate(folder, *options):
    """Make a certificate of H1 to H6 at other parameters; return its text."""
    arguments = ["--only", *CLAIMS, *options, "--out", str(folder), "--no-check"]
    assert horseshoe.main(list(arguments)) in (0, 1)
    return (folder / "horseshoe.json").read_text()


@cache
def paper_case():
    """The case of the paper's certificate."""
    return case(plan(PAPER.read_text()), "0")


def proved(base):
    """Run the command on the paper's certificate, once; keep what it prints beside its files."""
    folder = base / "proved"
    with (base / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not folder.exists():
            with (base / "shown").open("w") as shown, redirect_stdout(shown):
                arguments = [str(PAPER), "--out", str(folder)]
                assert formal.main([*arguments, "--json", str(base / "answer.json")]) == 0
    return folder


def without_assumptions(text):
    """Leave out the listing of axioms, which takes longer than the proofs."""
    return text.replace("Print Assumptions all.\n", "")


def edited(text, *edits):
    """Replace parts of a text, each of which must be there."""
    for old, new in edits:
        assert old in text, old
        text = text.replace(old, new)
    return text


def in_lemma(text, name, *edits):
    """Replace parts of one lemma's statement and proof."""
    begin = re.search(rf"^(Lemma|Theorem) {name}\b", text, re.MULTILINE).start()
    end = text.index("Qed.", begin)
    return text[:begin] + edited(text[begin:end], *edits) + text[end:]


def accepts(proved, folder, text):
    """Run coqc on a text beside the compiled theory; Refused goes through."""
    for module in coqc.order(paper_case().text):
        (folder / f"{module}.vo").symlink_to(proved / f"{module}.vo")
    (folder / "Case.v").write_text(without_assumptions(text))
    return coqc.run(folder, "Case")


def stops_at(proved, folder, text):
    """Return the lemma at which coqc refuses a text, and why."""
    with pytest.raises(coqc.Refused) as refused:
        accepts(proved, folder, text)
    return refused.value.lemma, str(refused.value)


def computed(folder, needed, parts):
    """Have Coq compute checks, each a pair of definitions and a term; return what they say."""
    head = "From Coq Require Import Reals ZArith List.\n"
    head += (
        f"From {coqc.NAME} Require Import {needed}.\nImport ListNotations.\nOpen Scope R_scope.\n"
    )
    modules = coqc.order(head)
    coqc.copy(coqc.theory(modules, print), folder, modules, ".vo")
    text = head + "".join(
        f"Module M{i}.\n{definitions}\nEval vm_compute in ({check}).\nEnd M{i}.\n"
        for i, (definitions, check) in enumerate(parts)
    )
    (folder / "Asked.v").write_text(text)
    return re.findall(r"= (true|false)", coqc.run(folder, "Asked").output)


def one(pattern, change, place=0):
    """An edit of the first place of a pattern, which must change something: in the definitions, or,
    if place is 1, in what is asked.
    """

    def edit(*parts):
        edited = re.sub(pattern, change, parts[place], count=1)
        assert edited != parts[place]
        return (edited, parts[1]) if place == 0 else (parts[0], edited)

    return edit


asking = partial(one, place=1)


def printed_by_coq(folder, *commands):
    """Return in a line what coqc prints for commands after a compiled Case.v."""
    head = ["From Coq Require Import Reals.", "From Coquelicot Require Import Coquelicot."]
    head += [f"From {coqc.NAME} Require Import Impact Corrected Case.", "Open Scope R_scope."]
    (folder / "Asked.v").write_text("\n".join([*head, *commands]) + "\n")
    command = ["coqc", *coqc.OPTIONS, "Asked.v"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return " ".join(done.stdout.split())

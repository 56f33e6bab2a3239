"""No edited lemma file proves what is not so; the corpus of the interesting ones."""

import json
import random
from collections import Counter

import pytest

from proofs.trusted.certificate import Malformed, render
from proofs.trusted.rules import RULES
from proofs.trusted.verify import Rejected, check, premises
from tests.effort import EFFORT
from tests.oracles.edits import edit_anywhere
from tests.oracles.judge import oracle
from tests.proofs.trusted.kernel import lemma_corpus
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

LONGEST = {"henon_orbits", "henon_horseshoe", "gap_identities", "ball", "rattle"}  # to check
COUNT = 40 if EFFORT.quick else 200


def falsehoods(source):
    """Yield what the oracles, which know nothing of the checker, say about its conclusions."""
    for name, conclusion in premises(source).known.items():
        yield from oracle(conclusion, random.Random(name))


def outcome(source, sentences):
    """Return accepted, rejected or malformed; what is accepted and new is true."""
    try:
        report = check(source)
    except (Malformed, Rejected) as error:
        assert str(error).startswith("$") and len(str(error).splitlines()) == 1
        return type(error).__name__
    if set(report.sentences) - sentences:
        assert not list(falsehoods(source)), source
    return "accepted"


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_examples_are_not_falsified(name):
    assert not list(falsehoods(text(name)))


@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=[pytest.mark.slow] * (x in LONGEST)) for x in EXAMPLES]
)
def test_edits_anywhere(name):
    document, sentences = json.loads(text(name)), set(check(text(name)).sentences)
    count, ended = COUNT // (5 if name in LONGEST else 1), Counter()
    for k in range(count):
        made = edit_anywhere(document, random.Random(f"{name} {k}"))
        ended[outcome(render(made), sentences)] += 1
    print(name, dict(ended))
    assert ended["Malformed"] and ended["Malformed"] + ended["Rejected"] > count / 5


def test_every_rule_of_the_kernel_is_edited():
    used = {x["rule"] for name in EXAMPLES for x in json.loads(text(name))["steps"].values()}
    assert used == {name for name, place in RULES.items() if place.startswith("kernel.")}


# -- the corpus ------------------------------------------------------------------------------------

ERRORS = {"rejected": Rejected, "malformed": Malformed}


@pytest.mark.parametrize("name", lemma_corpus.CORPUS)
def test_corpus(name):
    source = lemma_corpus.path_of(name).read_text(encoding="utf-8")
    kind = name.partition("/")[0]
    if kind == "accepted":
        assert check(source).sentences
        return
    with pytest.raises(ERRORS[kind], match=lemma_corpus.CORPUS[name].message) as caught:
        check(source)
    assert type(caught.value) is ERRORS[kind]
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize("name", lemma_corpus.CORPUS)
def test_corpus_is_made_from_the_examples(name):
    made = lemma_corpus.CORPUS[name].make()
    assert lemma_corpus.path_of(name).read_text(encoding="utf-8") == made


def test_corpus_has_no_other_files():
    folder = lemma_corpus.FOLDER
    files = {path for path in folder.rglob("*") if path.is_file()}
    named = {lemma_corpus.path_of(name) for name in lemma_corpus.CORPUS}
    assert files - named == {folder / "README.md"}
    assert (folder / "README.md").read_text(encoding="utf-8") == lemma_corpus.readme()

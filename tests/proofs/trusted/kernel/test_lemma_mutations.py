"""No changed lemma file proves what is not so; the corpus of the interesting ones."""

import json
import random
from collections import Counter
from os import environ
from zlib import crc32

import pytest

from proofs.trusted.certificate import Malformed
from proofs.trusted.rules import RULES
from proofs.trusted.verify import Rejected, check, premises
from tests.effort import EFFORT
from tests.oracles.judge import oracle
from tests.proofs.trusted.kernel import lemma_corpus
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text
from tests.proofs.trusted.kernel.lemma_mutations import GROUPS, HARMLESS, mutations

FLIGHTS = {"ball", "rattle"}  # which the oracles simulate: one in so many
LONGEST = {"henon_horseshoe", "henon_fixed_points", "gap_identities", *FLIGHTS}  # to check
# one mutation in so many, at random; 1 is all of them
STRIDE = 12 if EFFORT.quick else int(environ.get("ONE_MUTATION_IN", "4"))


def judge(mutation, original):
    """Return accepted, rejected or malformed; an accepted file is of a harmless kind and true."""
    source = mutation.make()
    told = f"{mutation.kind} at {mutation.where}"
    try:
        report = check(source)
    except Malformed as error:
        assert str(error).startswith("$"), told
        return "malformed"
    except Rejected as error:
        assert str(error).startswith("$"), told
        return "rejected"
    assert mutation.kind in HARMLESS, f"accepted: {told}"
    if set(report.sentences) - set(original.sentences):
        assert not list(falsehoods(source)), f"accepted and false: {told}"
    return "accepted"


def falsehoods(source):
    """Yield what the oracles, which know nothing of the checker, say about its conclusions."""
    for name, conclusion in premises(source).known.items():
        yield from oracle(conclusion, random.Random(name))


def run(name):
    made, stride = json.loads(text(name)), STRIDE * (5 if name in FLIGHTS else 1)
    original = check(text(name))
    counts = {}
    for mutation in mutations(made):
        if crc32(f"{mutation.where}{mutation.kind}".encode()) % stride == 0:
            counts.setdefault(mutation.kind, Counter())[judge(mutation, original)] += 1
    return counts


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_examples_are_not_falsified(name):
    assert not list(falsehoods(text(name)))


@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=[pytest.mark.slow] * (x in LONGEST)) for x in EXAMPLES]
)
def test_many_mutations(name):
    total = Counter()
    for kind, count in run(name).items():
        print(f"  {kind}: {dict(count)}")
        total += count
    print(name, dict(total))
    assert total["rejected"] + total["malformed"] > total["accepted"]


def test_every_rule_is_mutated():
    rules = Counter()
    for name in EXAMPLES:
        for step in json.loads(text(name))["steps"].values():
            rules[step["rule"]] += 1
    assert set(rules) == {name for name, place in RULES.items() if place.startswith("kernel.")}


def test_there_are_thousands_of_mutations_of_many_kinds():
    kinds = Counter(m.kind for name in EXAMPLES for m in mutations(json.loads(text(name))))
    assert len(kinds) > 40
    assert sum(kinds.values()) > 5000
    assert set(HARMLESS) <= set(kinds)


@pytest.mark.parametrize("group", GROUPS, ids=lambda group: group.__name__)
def test_every_group_yields(group):
    assert any(True for name in EXAMPLES for _ in group(json.loads(text(name))))


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

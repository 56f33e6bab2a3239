"""No edited certificate proves what is not so; the committed corpus and its exit statuses."""

import json
from collections import Counter

import pytest

from proofs.check import check_file
from proofs.trusted.certificate import MAX_BYTES, Malformed, parse
from proofs.trusted.certificate import render as text_of
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Rejected, check
from tests.proofs.trusted import corpus
from tests.proofs.trusted.mutations import (
    GROUPS,
    HARMLESS,
    mutation_table,
    mutations,
    outcome,
    tally,
    texts,
)
from tests.proofs.trusted.renewing import fresh

SAMPLE = 3  # mutations of each kind in the quick run


@pytest.fixture(scope="session")
def document():
    """A fresh certificate of all claims, as the prover writes it."""
    return fresh()


@pytest.fixture(scope="session")
def original(document):
    return {claim.id: claim for claim in check(text_of(document)).claims}


def verify(mutation, original):
    """Assert that a mutation is refused with a reason, or is harmless and proves no more."""
    verdict, reason, report = outcome(mutation.make())
    told = f"{mutation.kind} at {mutation.where}"
    if verdict == "malformed":
        assert reason.startswith("$"), told
    elif verdict == "rejected":
        assert reason.startswith("$."), told
    else:
        assert mutation.kind in HARMLESS, f"accepted: {told}"
        for claim in report.claims:
            if "renewed" in mutation.kind:  # another statement, of which less may be proved
                known = (original[claim.id].verdict, Verdict.UNDECIDED)
                assert claim.verdict in known, told
            else:
                assert claim.verdict is original[claim.id].verdict, told
                assert claim.statement == original[claim.id].statement, told
    return verdict


def sample(found, size=SAMPLE):
    kinds = {}
    for mutation in found:
        kinds.setdefault(mutation.kind, []).append(mutation)
    for members in kinds.values():
        step = max(1, len(members) // size)
        yield from members[::step][:size]


@pytest.mark.slow
@pytest.mark.parametrize("part", range(4))
def test_a_sample_of_every_kind_is_refused(document, original, part):
    few = list(sample(mutations(document)))[part::4]
    counts = tally(few, lambda mutation: verify(mutation, original))
    print(mutation_table(counts))
    assert len(few) > 50


def test_there_are_thousands_of_mutations_of_a_hundred_kinds(document):
    kinds = Counter(mutation.kind for mutation in mutations(document))
    assert len(kinds) > 100
    assert sum(kinds.values()) > 5000
    assert set(HARMLESS) < set(kinds)
    assert all(reason for reason in HARMLESS.values())


@pytest.mark.slow
def test_every_mutation_changes_something(document):
    whole = text_of(document)
    for mutation in sample(mutations(document), 3):
        text = mutation.make()
        assert text != whole, mutation
        if mutation.kind not in {"nested deeply", "too large"} and text.startswith("{"):
            try:
                same = json.dumps(json.loads(text)) == json.dumps(document)
                assert not same or mutation.kind == "duplicate field", mutation
            except ValueError:
                assert mutation.kind in {"truncated", "not a certificate"}, mutation


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.usefixtures("remembered_clock")
def test_all_mutations(document, original):
    counts = tally(mutations(document), lambda mutation: verify(mutation, original))
    print(mutation_table(counts))
    assert {kind for kind, count in counts.items() if count["accepted"]} == set(HARMLESS)
    assert sum(count["rejected"] for count in counts.values()) > 500
    assert sum(count["malformed"] for count in counts.values()) > 500


@pytest.mark.parametrize("group", GROUPS, ids=lambda group: group.__name__)
def test_every_group_yields(document, group):
    assert next(iter(group(document)))


def test_texts_are_malformed(document):
    for kind, where, text in texts(document):
        assert outcome(text)[0] == "malformed", (kind, where)


# -- forms that the mutations do not reach ---------------------------------------------------------


def test_a_parameter_of_a_thousand_digits(document):
    """Refused before it is printed: Python would not print it."""
    only = json.loads(corpus.H16(document))
    only["parameters"]["ratios"] = ["1/" + "7" * 1000, "1/3"]
    with pytest.raises(Malformed, match="digits"):
        check(text_of(only))


@pytest.mark.slow
def test_a_bracket_of_thousands_of_digits_is_read(document):
    """More digits than the checker computes with decide nothing, and raise nothing else."""
    root = json.loads(corpus.changing(corpus.H11)(document))
    low = 4489897 * 10**1393
    root["steps"]["moran-root-1"]["witness"]["root"] = [
        f"{low + 1}/{10**1400}",
        f"{low + 3}/{10**1400}",
    ]
    with pytest.raises(Rejected, match="signs"):
        check(text_of(root))


def test_size_is_limited():
    with pytest.raises(Malformed, match="at most"):
        parse(" " * (MAX_BYTES + 1))


# -- the corpus ------------------------------------------------------------------------------------

STATUS = {"accepted": 0, "rejected": 1, "malformed": 2}


@pytest.mark.parametrize("name", corpus.CORPUS)
def test_corpus(name, capsys):
    status = check_file(corpus.path_of(name))
    printed = capsys.readouterr()
    assert status == STATUS[name.partition("/")[0]]
    assert corpus.CORPUS[name].message in printed.err
    assert len(printed.err.splitlines()) == (status > 0)
    assert bool(printed.out) == (status == 0)


@pytest.mark.parametrize("name", corpus.CORPUS)
def test_corpus_is_made_from_the_accepted_certificate(name):
    made = corpus.CORPUS[name].make(corpus.accepted())
    assert corpus.path_of(name).read_text(encoding="utf-8") == made


def test_corpus_has_no_other_files():
    files = {path.relative_to(corpus.FOLDER) for path in corpus.FOLDER.rglob("*") if path.is_file()}
    named = {corpus.path_of(name).relative_to(corpus.FOLDER) for name in corpus.CORPUS}
    others = {path for path in files - named if path.parts[0] != "lemmas"}  # has its own test
    assert {str(path) for path in others} == {"README.md"}
    assert (corpus.FOLDER / "README.md").read_text(encoding="utf-8") == corpus.readme()


def test_accepted_certificate_says_what_the_prover_says_today(document):
    """The committed copy may have other subdivisions; its claims and verdicts are today's."""
    old, new = corpus.accepted(), document
    assert old["schema"] == new["schema"]
    assert old["parameters"] == new["parameters"]
    for before, now in zip(old["claims"], new["claims"], strict=True):
        for field in ("id", "statement", "verdict"):
            assert before[field] == now[field]


def test_the_false_horseshoe_is_false():
    """By the paper's equation: every image lies in (0, 0.05), far from I = [0.752, 0.77]."""
    from mpmath import mpf

    from tests.proofs.trusted.paper import reference

    for phase in ("0.752", "0.756", "0.76", "0.766", "0.77"):
        _, image = reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf(phase))
        assert 0 < image < 0.05

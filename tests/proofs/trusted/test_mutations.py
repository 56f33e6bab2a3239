"""No edited certificate proves what is not so; the corpus and its exit statuses."""

import json
import random
from collections import Counter

import pytest

from proofs.check import check_file
from proofs.trusted.certificate import MAX_BYTES, Malformed, parse
from proofs.trusted.files import render as text_of
from proofs.trusted.kernel.meter import DEFAULT
from proofs.trusted.rules import RULES
from proofs.trusted.verify import Rejected, check, premises
from tests.once import EFFORT
from tests.oracles.judge import oracle
from tests.proofs.trusted import corpus
from tests.proofs.trusted.edits import lie
from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text
from tests.proofs.trusted.mutations import EXCUSED, FORM, HARMLESS, mutations, outcome
from tests.proofs.trusted.renewing import fresh

SHARES = {"ball": 0.04, "rattle": 0.04, "outcomes": 0.15, "flight_arcs": 0.15}  # simulated
SLOW = SHARES.keys() | {"lines", "horseshoe", "henon_horseshoe", "gap_identities"}
FILES = ["horseshoe", *EXAMPLES]


def source(name):
    return text(name) if name in EXAMPLES else text_of(corpus.accepted())


def falsehoods(certificate):
    """What the oracles, which know nothing of the checker, say about its conclusions."""
    for name, conclusion in premises(certificate).known.items():
        yield from oracle(conclusion, random.Random(name))


def verify(mutation, original):
    """Assert that a mutation is refused with a reason, or harmless, or says what is true."""
    certificate = mutation.make()
    verdict, reason, report = outcome(certificate)
    field, _, kind = mutation.kind.partition(" ")
    told = f"{verdict}: {mutation.kind} at {mutation.where}"
    if verdict != "accepted":
        assert reason.startswith("$"), told
    elif kind in FORM:
        assert mutation.kind in EXCUSED, told
    elif (report.claims, report.sentences) == (original.claims, original.sentences):
        kinds, _ = HARMLESS.get(field, ("none", ""))
        assert not kinds or kind in kinds.split(), told
    elif report.claims:
        assert {*report.claims} <= {*original.claims}, told
    else:
        assert not list(falsehoods(certificate)), told
    return verdict


def sample(name, share):
    """Of each kind one, or of a share of the kinds."""
    chance, kinds = random.Random(name), {}
    for mutation in mutations(json.loads(source(name))):
        kinds.setdefault(mutation.kind, []).append(mutation)
    return [chance.choice(some) for some in kinds.values() if chance.random() < share]


BY_SPEED = [pytest.param(x, marks=[pytest.mark.slow] * (x in SLOW)) for x in FILES]


@pytest.mark.parametrize("name", BY_SPEED)
def test_a_mutation_of_every_kind_is_refused_or_true(name):
    share = 0.2 if EFFORT.quick else SHARES.get(name, 1)
    original = check(source(name))
    counts = Counter(verify(mutation, original) for mutation in sample(name, share))
    assert counts["rejected"] + counts["malformed"] > counts["accepted"]


@pytest.mark.long
@pytest.mark.parametrize("name", FILES)
def test_all_mutations(name):
    original, document = check(source(name)), json.loads(source(name))
    counts = Counter(verify(mutation, original) for mutation in mutations(document))
    assert counts["rejected"] + counts["malformed"] > counts["accepted"]


@pytest.mark.parametrize("name", BY_SPEED[1:])
def test_the_examples_are_not_falsified(name):
    assert not list(falsehoods(text(name)))


def test_every_rule_is_mutated_in_many_ways():
    documents = [json.loads(source(name)) for name in FILES]
    rules = {step["rule"] for each in documents for step in each["steps"].values()}
    assert rules >= {name for name, place in RULES.items() if place.startswith("kernel.")}
    kinds = Counter(mutation.kind for each in documents for mutation in mutations(each))
    assert len(kinds) > 300 and sum(kinds.values()) > 20_000
    assert EXCUSED.keys() <= kinds.keys()


# -- forms that the mutations do not reach ---------------------------------------------------------

SEVENS = "7" * 1000


@pytest.mark.every
@pytest.mark.parametrize(
    ("claim", "edit", "error", "message"),
    [
        ("H16", f"parameters.ratios = 1/{SEVENS} 1/3", Malformed, "digits"),  # not to be printed
        (
            "H11",
            f"moran-root-1.root = {4489897 * 10**1393 + 1}/{10**1400} "
            f"{4489897 * 10**1393 + 3}/{10**1400}",
            Rejected,
            "signs",
        ),  # more digits than are computed with decide nothing
    ],
)
def test_numbers_of_many_digits(claim, edit, error, message):
    document = corpus.accepted()
    corpus.only(claim)(document)
    lie(edit)(document)
    with pytest.raises(error, match=message):
        check(text_of(document))


@pytest.mark.every
@pytest.mark.parametrize(
    "number",
    ["-0", "1/1", "0/1", "-0/3", "01", "1/02", "1.0", "1/-3", "\u0661", "1" * 401, "1" * 5000],
)
def test_a_number_out_of_form(number):
    document = corpus.accepted()
    corpus.only("H16")(document)
    document["parameters"]["interval"][0] = number  # any from 0 to 1.11 would do
    with pytest.raises(Malformed):
        check(text_of(document))


def test_size_is_limited():
    with pytest.raises(Malformed, match="at most"):
        parse(" " * (MAX_BYTES + 1))


# -- the corpus ------------------------------------------------------------------------------------

STATUS = {"accepted": 0, "rejected": 1, "malformed": 2}


@pytest.mark.every
@pytest.mark.parametrize("name", corpus.CORPUS)
def test_corpus(name, capsys):
    path, entry = corpus.path_of(name), corpus.CORPUS[name]
    status = check_file(path, DEFAULT)
    printed = capsys.readouterr()
    assert status == STATUS[path.parent.name]
    assert entry.message in printed.err and bool(entry.message) == (status > 0)
    assert len(printed.err.splitlines()) == (status > 0)
    assert bool(printed.out) == (status == 0)


def test_accepted_certificate_says_what_the_prover_says_today():
    """The committed copy may have other subdivisions; its claims and verdicts are today's."""
    old, new = corpus.accepted(), fresh()
    assert (old["schema"], old["parameters"]) == (new["schema"], new["parameters"])
    for before, now in zip(old["claims"], new["claims"], strict=True):
        assert all(before[field] == now[field] for field in ("id", "statement", "verdict"))


def test_the_false_horseshoe_is_false():
    """By the paper's equation: every image lies in (0, 0.05), far from I = [0.752, 0.77]."""
    from mpmath import mpf

    from tests.proofs.trusted.paper import reference

    for phase in ("0.752", "0.756", "0.76", "0.766", "0.77"):
        _, image = reference.first_impact(mpf("0.2121"), mpf("-0.2"), mpf(phase))
        assert 0 < image < 0.05

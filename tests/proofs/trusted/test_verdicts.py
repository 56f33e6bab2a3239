"""How decisions are told, and the small predicates on intervals."""

from dataclasses import dataclass, replace
from fractions import Fraction as F

import pytest

from proofs.trusted.kernel.conclusion import About, Conclusion
from proofs.trusted.numbers import covered
from proofs.trusted.parameters import PAPER, Place
from proofs.trusted.verdicts import Found, Row, Verdict, decided, told, undecided


@dataclass(frozen=True)
class Said(Conclusion):
    text: str
    at: Place | None = None

    @property
    def sentence(self):
        return self.text


def test_later_sentences_begin_with_a_capital_unless_with_a_symbol():
    here, other = PAPER.place, Place.plastic(F(1, 2), F(-1, 2))
    known = [Said("the mass sticks.", here), Said("f is C^1.", here), Said("let x = 1.", here)]
    assert told(known) == ("At (eta, nu) = (0.2121, -0.2): the mass sticks. f is C^1. Let x = 1.")
    known = [Said("every phase flies.", other), Said("since 1 < 2, so it is."), Said("phi_s = 1.")]
    assert told(known) == (
        "At (eta, nu) = (0.5, -0.5): every phase flies. Since 1 < 2, so it is. phi_s = 1."
    )
    assert told([Said("a."), Said("a.")]) == "a."
    assert told([]) == ""


def test_why_says_of_which_oscillator_a_witness_is_unless_it_is_the_claims():
    here, other = PAPER.place, Place.plastic(F(1, 2), F(-1, 2))
    because = Said("f'(1) is 2.", here), Said("f'(2) is 3.", other), Said("1 < 2.")
    assert decided(Verdict.REFUTED, *because)._replace(of=PAPER).why == (
        "f'(1) is 2; at (eta, nu) = (0.5, -0.5): f'(2) is 3; 1 < 2"
    )


@dataclass(frozen=True)
class Part(Conclusion):
    of: Conclusion
    at = About("of")


@dataclass(frozen=True)
class Misnamed(Conclusion):
    of: Conclusion
    at = About("off")


def test_a_conclusion_about_a_part_is_never_about_all_oscillators():
    """No place would mean: true of every oscillator."""
    here = Said("the mass sticks.", PAPER.place)
    assert Part(here).place == Part(Part(here)).place == PAPER.place
    for made in (Misnamed(here), Part(Misnamed(here)), Part(Conclusion())):
        with pytest.raises(TypeError, match="no oscillators"):
            Found(PAPER, [made])


def test_what_is_about_rebounds_says_nothing_where_no_restitution_is_given():
    eta, nu, epsilon = PAPER.box.sides
    plastic = replace(PAPER, epsilon=None, reach=None)
    assert PAPER.box.holds(PAPER) and not PAPER.box.holds(plastic)
    assert PAPER.place.holds(PAPER) and PAPER.place.holds(plastic)
    assert PAPER.place.inside(Place(eta, nu, (F(0), F(0)))) and not PAPER.place.inside(PAPER.box)
    for other in (Place(eta, nu, (epsilon[0], F("0.009"))), Place((eta[0],) * 2, nu, epsilon)):
        assert not other.holds(PAPER) and other.inside(PAPER.box)


@pytest.mark.every
@pytest.mark.parametrize(
    ("parts", "whether"),
    [
        ([(0, 3)], True),
        ([(0, 1), (1, 2)], True),
        ([(0, 1), (F("1.1"), 2)], False),
        ([(F("0.1"), 2)], False),
        ([(0, F("1.9"))], False),
        ([(0, 2), (0, 1)], True),
        ([], False),
    ],
)
def test_an_interval_is_covered_by_others_without_a_gap(parts, whether):
    assert covered((F(0), F(2)), parts) is whether


def test_printed_numbers_are_asked_about_at_their_oscillator_alone():
    row = Row("Z1", "", "", "", lambda of, found: undecided(""), printed_at=PAPER.place)
    assert row.is_asked(PAPER) and not row.is_asked(replace(PAPER, eta=F(1, 2)))
    assert replace(row, printed_at=None).is_asked(replace(PAPER, eta=F(1, 2)))

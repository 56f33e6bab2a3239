"""Which theorems a certificate asks Coq for: the horseshoe, and the paper's claims as decided."""

from __future__ import annotations

from dataclasses import dataclass

from proofs.formal.written import NoTheorem
from proofs.search.repair import places, rounded_slopes
from proofs.trusted.certificate import FIELDS, Malformed, parse
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.itineraries import Itinerary
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.kernel.moran import MoranRoot
from proofs.trusted.kernel.staying import StayingSet
from proofs.trusted.numbers import Range, hull
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import Impact, impacts
from proofs.trusted.verdicts import Verdict
from proofs.trusted.verify import Report, check

PRINTED = ("H8", "H9", "H10")  # of Lambda
CLAIMS = ("H1", "H2", "H3", "H4", "H5", "H6", "H11", "H16")
_OF_RISING = ("H1", "H2", "H3", "H6")
_MOST_DIGITS = 12


@dataclass(frozen=True)
class Headline:
    """A horseshoe on I0 and I1: f' has these signs there, and |f'| these bounds."""

    left: Range
    right: Range
    signs: tuple[int, int]
    slopes: Range
    is_corrected: bool

    @property
    def gap(self) -> Range:
        """The phases between I0 and I1."""
        return self.left[1], self.right[0]

    @property
    def interval(self) -> Range:
        """I, from the left end of I0 to the right end of I1."""
        return self.left[0], self.right[1]


@dataclass(frozen=True)
class Plan:
    """What is to be stated: a horseshoe, if there is one, and what is decided of the claims.

    points: the phases by which claims are refuted; roots: of Moran's equation; sets: those that
    stay, a horseshoe first; orbit: of the printed end of I, by which Lambda is known.
    """

    of: Parameters
    headline: Headline | None
    verdicts: dict[str, Verdict]
    statements: dict[str, str]
    points: dict[str, Impact]
    roots: tuple[MoranRoot, ...]
    sets: tuple[StayingSet, ...]
    orbit: Itinerary | None

    def holds(self, *claims: str) -> bool:
        """Whether claims are verified."""
        return all(self.verdicts.get(claim) is Verdict.VERIFIED for claim in claims)


def plan(source: str, report: Report | None = None) -> Plan:
    """Return what a certificate asks for; it is checked, unless there is a report.

    Raises Malformed, Rejected or Exhausted as the checker does, Malformed as well where the file
    is about other claims that rest on no horseshoe, NoTheorem where nothing is decided. H1 to H3
    and H6 are stated in Coq where f increases; where it decreases, the theorem on the horseshoe
    says what they say.
    """
    report = report or check(source)
    of = report.parameters
    claims = {each.id: each for each in report.claims if each.id in CLAIMS}
    if not isinstance(of, Parameters):
        raise Malformed("$.claims: no certificate of one oscillator")
    known = report.context.known
    proofs = {
        str(claim["id"]): [known[name] for name in claim["proof"]]
        for claim in parse(source).fields(*FIELDS)[4].value
    }
    decided: dict[str, Verdict] = {
        name: each.verdict
        for name, each in claims.items()
        if each.verdict is not Verdict.UNDECIDED and (of.signs == (1, 1) or name not in _OF_RISING)
    }
    points = {name: x for name in decided for x in impacts(proofs[name])}
    found = [x for name in (decided if claims else proofs) for x in proofs[name]]
    result = Plan(
        of,
        _headline(of, found, decided, bool(claims)),
        decided,
        {each.id: each.statement for each in report.claims if each.id in (*CLAIMS, *PRINTED)},
        points,
        tuple(x for x in proofs.get("H11", []) if isinstance(x, MoranRoot)),
        tuple(_staying(found)),
        next((x for x in found if isinstance(x, Itinerary)), None),
    )
    if not claims and result.headline is None:
        raise Malformed("$.claims: none is of python -m proofs horseshoe, or rests on a horseshoe")
    if result.headline is None and not decided:
        raise NoTheorem(f"it decides none of the claims {', '.join(CLAIMS)}")
    return result


def _headline(
    of: Parameters, found: list[Conclusion], verdicts: dict[str, Verdict], is_corrected: bool
) -> Headline | None:
    """Return the corrected theorem, or that of the given sets if H4 and H5 hold on them."""
    for each in _staying(found)[:1]:
        if each.is_horseshoe:
            slopes = rounded_slopes(each.steepness, max(2, places(of.slopes)))
            left, right = each.cells
            signs = each.signs[0], each.signs[1]
            return Headline(left, right, signs, slopes, is_corrected)
    if not all(verdicts.get(claim) is Verdict.VERIFIED for claim in ("H4", "H5")):
        return None
    ranges = [each for each in found if isinstance(each, SlopeRange)]
    known = (_part(ranges, of.left), _part(ranges, of.right))
    parts = [part for part in known if part is not None and part.expands]
    if len(parts) < 2:
        return None
    bounds = hull([part.bounds(part.sign) for part in parts])
    low, high = of.slopes
    if not (1 < low <= bounds[0] and bounds[1] <= high):
        low, high = _rounded(bounds)
    return Headline(of.left, of.right, (parts[0].sign, parts[1].sign), (low, high), False)


def _staying(found: list[Conclusion]) -> list[StayingSet]:
    """Return the sets that stay, a horseshoe first."""
    sets = dict.fromkeys(each for each in found if isinstance(each, StayingSet))
    return sorted(sets, key=lambda each: not each.is_horseshoe)


def _part(ranges: list[SlopeRange], domain: Range) -> SlopeRange | None:
    """Return what is known about f' on an interval."""
    return next((part for each in ranges if (part := each.over(domain)) is not None), None)


def _rounded(bounds: Range) -> Range:
    """Round bounds outward to few digits, the lower one to above 1."""
    rounded = (rounded_slopes(bounds, digits) for digits in range(2, _MOST_DIGITS))
    return next((each for each in rounded if each[0] > 1), bounds)

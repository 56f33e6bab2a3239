"""Theorems 2 to 4 of the paper, on the invariant set of the plastic map. Trusted, and shared.

Lambda is the set of phases of I whose orbits stay in I; f^-n(I) is read as the phases of I whose
n-th image is in I, since f maps phases outside I into it too. `s32_sets.itinerary` proves that
Lambda is conjugate to a subshift of finite type; the claims follow from properties of that.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations

from proofs.trusted.numbers import ceil_text, floor_text, show, show_range
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.s31_horseshoe import Horseshoe
from proofs.trusted.paper.s32_sets.cantor import CLAIMS as LINEAR_CLAIMS
from proofs.trusted.paper.s32_sets.itinerary import (
    NO_HORSESHOE,
    Itinerary,
    invariant_set,
    surrounding,
)
from proofs.trusted.paper.s32_sets.subshift import Subshift
from proofs.trusted.parameters import Parameters
from proofs.trusted.verdicts import Verdict, told


def _told(sets: Horseshoe, of: Parameters, shift: Subshift) -> str:
    """Say what the invariant set of I is, with its numbers."""
    if not shift.forbidden:
        return "Lambda is conjugate to the full shift on two symbols"
    return (
        f"for I = {show_range(of.interval)} Lambda consists of exactly the points of the Cantor "
        f"set on {show_range(sets.interval)} whose itineraries have no factor {shift.factors}"
    )


def _counts(shift: Subshift) -> str:
    counts = ", ".join(str(shift.fixed_points(n)) for n in range(1, 9))
    return f"f^n has {counts} fixed points in Lambda for n = 1, ..., 8"


def _homeomorphism(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H7: h is onto exactly if no word is forbidden.

    It is one-to-one, continuous and open onto its image in any case, being a restriction of the
    itinerary map of the horseshoe.
    """
    known = invariant_set(of, found)
    if isinstance(known, str):
        return undecided(known)
    sets, shift = known
    cut = sets.gap[0] <= of.gap[0] and of.gap[1] <= sets.gap[1]
    if not cut or of.interval != (of.left[0], of.right[1]):
        return undecided("I0 and I1 do not hold all points of Lambda on their sides of the gap")
    growth = {"growth": shift.growth} if shift.chaotic else {}
    if shift.missing is None:
        return Decision(Verdict.VERIFIED, _told(sets, of, shift), quantities=growth)
    return Decision(
        Verdict.REFUTED,
        f"h is not onto: no itinerary begins with {shift.missing}"
        + "".join(
            f"; f^{len(orbit.word)}({show(orbit.phase)}) is in "
            f"[{floor_text(orbit.orbit[-1][0])}, {ceil_text(orbit.orbit[-1][1])}]"
            for orbit in _of_ends(of, sets, found)
        ),
        witness=_no_point(of, sets, shift, found),
        corrected=_corrected(of, sets, shift),
        quantities=growth,
    )


def _of_ends(of: Parameters, sets: Horseshoe, found: Iterable[object]) -> list[Itinerary]:
    """Return the orbits of the ends of I among the conclusions."""
    return [x for x in _orbits(sets, found) if x.phase in of.interval]


def _orbits(sets: Horseshoe, found: Iterable[object]) -> list[Itinerary]:
    orbits = [x for x in found if isinstance(x, Itinerary) and x.sets == sets]
    return sorted(orbits, key=lambda orbit: orbit.phase)


def _no_point(of: Parameters, sets: Horseshoe, shift: Subshift, found: Sequence[object]) -> str:
    """Name the shortest word without a point, and why; and two points that the index confuses."""
    where = (f"below {show(sets.left[0])}", "in the gap", f"above {show(sets.right[1])}")
    orbits = "; ".join(
        f"the orbit of {show(orbit.phase)} has the itinerary {orbit.word or 'empty'} and is then "
        f"{where[orbit.leaves]}"
        for orbit in _of_ends(of, sets, found)
    )
    text = (
        f"no point of Lambda has an itinerary that begins with {shift.missing}: {orbits}, and f "
        "increases on I0 and on I1."
    )
    tail = next((x for x in "10" if shift.begins("0" + x * 40) and shift.begins("1" + x * 40)), "")
    if tail:
        text += (
            " If h leaves out the symbol of the phase itself, as 0.alpha_1 alpha_2... with alpha_k "
            f"from f^k says, it is not one-to-one either: the points with the itineraries 0{tail}"
            f"{tail}{tail}... and 1{tail}{tail}{tail}... are in Lambda and have the same image."
        )
    return text + _slow(of, sets, found)


def _slow(of: Parameters, sets: Horseshoe, found: Sequence[object]) -> str:
    """Name a word w and a letter a for which |I_wa| < |I_w| / lo fails, if orbits prove one.

    I_w is the interval of the phases whose first iterates are in the given I0 and I1 as w says.
    Two phases u < v in I_wa are v - u apart; phases around them that are not in I_w, or the ends
    of I, are farther apart than |I_w|.
    """
    if of.gap != sets.gap:
        return ""
    orbits = _orbits(sets, found)
    for first, last in combinations(orbits, 2):
        for size in range(2, min(_stays(of, first), _stays(of, last)) + 1):
            word = first.word[:size]
            if word != last.word[:size]:
                break
            outside = [x.phase for x in orbits if not x.word.startswith(word[:-1])]
            low = max((x for x in outside if x < first.phase), default=of.interval[0])
            high = min((x for x in outside if x > last.phase), default=of.interval[1])
            if (last.phase - first.phase) * of.slopes[0] >= high - low:
                return (
                    " The step |I_wa| < |I_w| / gamma_2 of the proof fails too: "
                    f"{show(first.phase)} and {show(last.phase)} are in I_{word}, while "
                    f"I_{word[:-1]} lies between {show(low)} and {show(high)}, less than "
                    f"{show(of.slopes[0])} times as far apart. What slopes above g give is "
                    "|I_(w_1 ... w_n)| <= |I_(w_2 ... w_n)| / g."
                )
    return ""


def _stays(of: Parameters, orbit: Itinerary) -> int:
    """Return for how many steps an orbit is proved to be in the given I0 and I1."""
    count = 0
    for low, high in orbit.orbit:
        if not any(begin <= low and high <= end for begin, end in (of.left, of.right)):
            break
        count += 1
    return count


def _corrected(of: Parameters, sets: Horseshoe, shift: Subshift) -> str:
    """State the theorem for the horseshoe, and what holds for the given I."""
    text = (
        f"{told([sets])} The conjugacy is phi -> alpha_0 alpha_1 alpha_2 ..., f^k(phi) in "
        f"I_(alpha_k), from k = 0 on. And {_told(sets, of, shift)}; there it is a homeomorphism "
        "onto the one-sided subshift of the sequences without these factors and conjugates f to it"
    )
    if not shift.chaotic:
        return text + "."
    low, high = shift.growth
    return (
        f"{text}. This subshift is irreducible: Lambda is a Cantor set with a dense orbit, "
        f"{_counts(shift)}, and the topological entropy of f on it is the log of a "
        f"number in [{floor_text(low, 12)}, {ceil_text(high, 12)}]."
    )


def _subshift(of: Parameters, found: Sequence[object]) -> tuple[str, Subshift] | Decision:
    """Return how Lambda is told and its irreducible subshift, or what is decided without one."""
    known = invariant_set(of, found)
    if isinstance(known, str):
        return undecided(known)
    sets, shift = known
    told = _told(sets, of, shift)
    if not shift.arrows:
        return Decision(Verdict.REFUTED, "Lambda is empty", witness=told)
    if not shift.chaotic:
        return undecided(f"the subshift is not irreducible: {told}")
    return told, shift


def _chaotic(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H8 by the conjugacy to a subshift: see `Subshift.chaotic`, 2 to 4."""
    known = _subshift(of, found)
    if isinstance(known, Decision):
        return known
    told, shift = known
    return Decision(
        Verdict.VERIFIED,
        f"{told}, an irreducible subshift; {_counts(shift)}",
        quantities={"growth": shift.growth},
    )


def _cantor(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H9 by the homeomorphism to a subshift: see `Subshift.chaotic`, 1."""
    known = _subshift(of, found)
    if isinstance(known, Decision):
        return known
    return Decision(
        Verdict.VERIFIED, f"{known[0]}: compact, nowhere dense, without isolated points"
    )


def _measure_zero(of: Parameters, found: Sequence[object]) -> Decision:
    """Decide H10 by the 2^(n+1) intervals of the words of n + 1 letters in a horseshoe around I.

    They cover Lambda, and with slopes of at least g they are at most |I| / g^n long. In all that
    is 2 |I| (2 / g)^n, which tends to 0 if g > 2.
    """
    sets = surrounding(of, found)
    if sets is None:
        return undecided(NO_HORSESHOE)
    slope = sets.slopes[0]
    if slope <= 2:
        return undecided(f"f' >= {show(slope)} only, not above 2")
    length = sets.interval[1] - sets.interval[0]
    return Decision(
        Verdict.VERIFIED,
        f"Lambda lies in 2^(n+1) intervals of length at most {show(length)} / {show(slope)}^n, for "
        f"every n: f' >= {show(slope)} > 2 on {show_range(sets.left)} and {show_range(sets.right)}",
    )


_AT = "At (eta, nu) = ({eta}, {nu}), for Lambda = {{phi in I : f^n(phi) in I for all n}}, I = {i}: "

CLAIMS = (
    Claim(
        "H7",
        _AT + "the itinerary map h from Lambda to the sequences alpha_0 alpha_1 ... over 0, 1, "
        "alpha_k = 0 or 1 where f^k(phi) is in I0 = {i0} or I1 = {i1}, is a homeomorphism.",
        _homeomorphism,
    ),
    Claim(
        "H8",
        _AT + "f has in Lambda countably many periodic orbits of arbitrarily high periods, "
        "uncountably many nonperiodic orbits, and an orbit dense in Lambda.",
        _chaotic,
    ),
    Claim("H9", _AT + "Lambda is a Cantor set.", _cantor),
    Claim("H10", _AT + "Lambda has Lebesgue measure zero.", _measure_zero),
    *LINEAR_CLAIMS,
)

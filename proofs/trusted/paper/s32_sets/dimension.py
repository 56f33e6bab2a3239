"""Claim 1 read for the map itself: the dimension of the set that stays in I. Trusted, and shared.

Lambda(I) is the set of the phases in I whose images by f all stay in I. The paper has s_0 for its
dimension, that of a linear Cantor set whose two ratios are the extremes of 1 / f'.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import TURN, Range, ceil_text, floor_text, hull, show, show_range
from proofs.trusted.paper import Claim, Decision, undecided
from proofs.trusted.paper.s32_sets.moran import MoranRoot
from proofs.trusted.parameters import Parameters
from proofs.trusted.slopes import Avoids, Impact
from proofs.trusted.verdicts import Verdict

FULL = ("0", "1")
WITHOUT_000 = ("1", "01", "001")


@dataclass(frozen=True)
class Repeller(Conclusion):
    """The compact set K = union of g_w(K) over the words; g_w is g_j after g_v where w = jv.

    f increases on both domains; g_j is its inverse from `hull` into domains[j], for letters that
    end a word, and on its part that g_v reaches for others; f takes no other points of domains[j]
    there. The g_w map the hull into itself, to disjoint images; 1 / g_w' lies in the range that
    `slopes` has for w, all above 1. The Hausdorff dimension of K lies in `dimension`.
    """

    hull: Range
    domains: tuple[Range, Range]
    words: tuple[str, ...]
    slopes: tuple[Range, ...]
    dimension: Range


def _within(inner: Range, outer: Range) -> bool:
    return outer[0] <= inner[0] and inner[1] <= outer[1]


def _escapes(gap: Range, interval: Range, found: Sequence[object]) -> bool:
    """Whether f takes no phase of the closed gap into the interval."""
    return any(
        isinstance(one, Avoids) and _within(gap, one.phases) and _within(interval, one.target)
        for one in found
    )


def _whole(found: Sequence[object]) -> Iterator[Repeller]:
    """Yield the repellers that are Lambda(hull), for the words 0 and 1.

    The domains begin and end with the hull, and no phase between them is taken into the hull. So
    a point of Lambda(hull) lies in a domain with all its images: x = g_j(f(x)), and so on, is in K.
    Conversely f maps K = g_0(K) and g_1(K) to K.
    """
    for one in found:
        if isinstance(one, Repeller) and one.words == FULL:
            (first, low), (high, last) = one.domains
            if (first, last) == one.hull and _escapes((low, high), one.hull, found):
                yield one


def _without_000(of: Parameters, found: Sequence[object]) -> Repeller | None:
    """Return the repeller of the words 1, 01, 001 that is Lambda(I), if one is proved to be.

    I reaches from the lower end a of I0 to the upper end of I1; f takes no phase between into I.
    So a point of Lambda(I) lies in I0 or I1 with all its images. Let c be the upper end of I0, and
    f(a) >= y and f(y) > c for a phase y of I0. If x and f(x) are in I0, then f(x) >= f(a) >= y, so
    that f(f(x)) >= f(y) > c: no three images in a row are in I0. So x is in some g_w(Lambda(I)),
    and in K. Conversely g_w(K), with its images up to K, is in I0 and I1.

    On I0 f, lifted as its inverse is, stays below the lower end of I + 2 pi and above the upper
    end - 2 pi. So a phase within I is the lifted value; one beyond c in [0, 2 pi) is that
    value, or is 2 pi above it, and then the value is below I, where f(y) >= f(a) is not.
    """
    points = [one for one in found if isinstance(one, Impact)]
    start, top = of.interval[0], of.left[1]
    blocked = any(
        first.phase == start < second.phase <= first.image[0]
        and first.image[1] <= of.interval[1]
        and second.phase <= top < second.image[0]
        and second.image[1] < TURN
        for first in points
        for second in points
    )
    spans = of.interval == (of.left[0], of.right[1])
    if not (blocked and spans and _escapes(of.gap, of.interval, found)):
        return None
    about = (WITHOUT_000, of.interval, (of.left, of.right))
    repellers = [one for one in found if isinstance(one, Repeller)]
    return next((one for one in repellers if (one.words, one.hull, one.domains) == about), None)


def _crude(of: Repeller, found: Sequence[object]) -> Range | None:
    """Return bounds of the dimension from those of 1 / g_w' alone, by Moran's equation.

    If r_w |x - y| <= |g_w(x) - g_w(y)| <= R_w |x - y|, the dimension lies between the roots for
    r and for R (Falconer, Fractal Geometry, Propositions 9.6 and 9.7).
    """
    roots = [one for one in found if isinstance(one, MoranRoot)]
    pairs = [(one, list(zip(one.ratios, of.slopes, strict=True))) for one in roots]
    lower = [one.root[0] for one, pair in pairs if all(r * steep <= 1 for r, (_, steep) in pair)]
    upper = [one.root[1] for one, pair in pairs if all(r * flat >= 1 for r, (flat, _) in pair)]
    return (max(lower), min(upper)) if lower and upper else None


def _between(bounds: Range, name: str) -> str:
    """Write bounds outward, with two digits more than they decide."""
    places = len(str(int(1 / (bounds[1] - bounds[0])))) + 1
    return f"{floor_text(bounds[0], places)} <= {name} <= {ceil_text(bounds[1], places)}"


def _decide_dimension(of: Parameters, found: Sequence[object]) -> Decision:
    if max(of.moran_ratios) >= 1:
        return Decision(Verdict.REFUTED, "there is no s_0", witness="a ratio is at least 1")
    roots = [
        one.root for one in found if isinstance(one, MoranRoot) and one.ratios == of.moran_ratios
    ]
    around = [one for one in _whole(found) if _within(of.interval, one.hull)]
    if not roots or not around:
        missing = "no bracket of s_0" if not roots else "no full horseshoe around I with dimension"
        return undecided(missing)
    root, whole, itself = roots[0], around[0], _without_000(of, found)
    quantities = {"dimension": whole.dimension, "s0": root}
    crude = _crude(whole, found)
    if crude is not None:
        quantities["dimension_crude"] = crude
    if whole.hull == of.interval:
        itself = whole
    elif itself is not None:
        quantities["dimension_of_I"] = itself.dimension
    # Lambda(I) is a part of Lambda(hull): its dimension is not larger
    exact = itself is not None
    low, high = itself.dimension if itself is not None else (0 * root[0], whole.dimension[1])
    why = _between((low, high), "dim") if exact else f"dim <= {ceil_text(high, 9)}"
    why = f"{why}, and {_between(root, 's_0')}"
    if low <= root[1] and root[0] <= high:
        return Decision(Verdict.UNDECIDED, why, quantities=quantities)
    relation = "is less than" if high < root[0] else "is greater than"
    return Decision(
        Verdict.REFUTED,
        why,
        witness=f"the dimension of Lambda {relation} s_0: {why}",
        corrected=_theorem(of, whole, itself, root, crude),
        quantities=quantities,
    )


def _theorem(
    of: Parameters, whole: Repeller, itself: Repeller | None, root: Range, crude: Range | None
) -> str:
    """State what is proved about the dimension."""
    flat, steep = hull(whole.slopes)
    first, second = whole.domains
    parts = [
        f"At (eta, nu) = ({show(of.eta)}, {show(of.nu)}) let Lambda(I) be the set of the phases "
        f"in I whose images by the impact map f all stay in I. For I = {show_range(whole.hull)} "
        f"f increases on {show_range(first)} and on {show_range(second)}, takes each over all of I "
        f"and no phase between them into I, its derivative where it arrives in I is between "
        f"{floor_text(flat, 2)} and {ceil_text(steep, 2)}, and the Hausdorff dimension D of "
        f"Lambda(I) satisfies {_between(whole.dimension, 'D')}"
    ]
    if crude is not None:
        parts.append(f" (the derivative's bounds alone give {_between(crude, 'D')})")
    if itself is not None and itself is not whole:
        parts.append(
            f". For I = {show_range(of.interval)} Lambda(I) consists of the points without three "
            f"images in a row in {show_range(of.left)}, and {_between(itself.dimension, 'D')}"
        )
    elif itself is None:
        parts.append(f". For I = {show_range(of.interval)} the dimension is at most that")
    ratios = " and ".join(map(show, of.moran_ratios))
    parts.append(
        f". {_between(root, 's_0')} is the dimension of the linear Cantor set of the ratios "
        f"{ratios}, not that of Lambda(I)."
    )
    return "".join(parts)


CLAIMS = (
    Claim(
        "H13",
        "At (eta, nu) = ({eta}, {nu}): the phases whose images by f all stay in I = {i} form a set "
        "of Hausdorff dimension s_0, where {r0}^s_0 + {r1}^s_0 = 1.",
        _decide_dimension,
    ),
)

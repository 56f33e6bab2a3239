"""The report beside a certificate: Markdown, for people, with numbers rounded outward."""

from __future__ import annotations

from typing import Any

from proofs.facts import PAPER, Parameters, show, show_range
from proofs.statements import Verdict

_NAMES = {
    "slope_min_I0": "min f' on I0",
    "slope_max_I0": "max f' on I0",
    "slope_min_I1": "min f' on I1",
    "slope_max_I1": "max f' on I1",
    "image_left_I0": "f(left end of I0)",
    "image_right_I0": "f(right end of I0)",
    "image_left_I1": "f(left end of I1)",
    "image_right_I1": "f(right end of I1)",
    "s0": "s_0",
    "s0_reciprocal_slopes": "s_0 with the ratios 1 / slope",
}


def markdown(
    of: Parameters, corrected: Parameters | None, certificate: dict[str, Any], whys: dict[str, str]
) -> str:
    """Return the report on one run: verdicts, the corrected theorem, the numbers, how to check."""
    at = f"(eta, nu) = ({show(of.eta)}, {show(of.nu)})"
    whose = "the paper's parameters" if of == PAPER else "parameters of your own"
    sections = [
        "# The plastic horseshoe, claim by claim",
        f"At {at}, {whose}: I = {show_range(of.interval)}, I0 = {show_range(of.left)}, "
        f"I1 = {show_range(of.right)}, slopes between {show(of.slopes[0])} and "
        f"{show(of.slopes[1])}.",
        "The paper's f follows a mass that sticks to the table until it separates, then to its "
        "next impact. Verdicts are proved by interval arithmetic and re-derived by the checker.",
        "## Verdicts",
        _verdicts(certificate, whys),
        *_correction(of, corrected, certificate),
        "## Numbers",
        "Each true value lies between the bounds; they are rounded outward.",
        _numbers(certificate),
        "## Check it yourself",
        "The certificate `horseshoe.json` beside this page holds the witnesses in exact numbers. "
        "From the repository's root, with nothing but Python:",
        "    python -S -m proofs.check reports/horseshoe.json",
    ]
    return "\n\n".join(sections) + "\n"


def _verdicts(certificate: dict[str, Any], whys: dict[str, str]) -> str:
    rows = ["| claim | verdict | statement | because |", "|---|---|---|---|"]
    for claim in certificate["claims"]:
        cells = (claim["id"], claim["verdict"], claim["statement"], whys[claim["id"]])
        rows.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(rows)


def _correction(
    of: Parameters, corrected: Parameters | None, certificate: dict[str, Any]
) -> list[str]:
    refuted = any(claim["verdict"] == Verdict.REFUTED.value for claim in certificate["claims"])
    if corrected is None:
        return ["## Correction", "No corrected sets were found nearby."] if refuted else []
    changes = [
        f"{name} {show_range(old)} becomes {show_range(new)}"
        for name, old, new in (
            ("I", of.interval, corrected.interval),
            ("I0", of.left, corrected.left),
            ("I1", of.right, corrected.right),
            ("the slopes' range", of.slopes, corrected.slopes),
        )
        if old != new
    ]
    return [
        "## Corrected theorem (VERIFIED)",
        certificate["corrected"]["theorem"],
        f"What changes: {'; '.join(changes)}.",
    ]


def _numbers(certificate: dict[str, Any]) -> str:
    rows = ["| quantity | at least | at most |", "|---|---|---|"]
    seen: set[str] = set()
    for claim in certificate["claims"]:
        for name, bounds in claim["quantities"].items():
            if name not in seen:
                rows.append(f"| {_NAMES[name]} | {bounds['lower']} | {bounds['upper']} |")
                seen.add(name)
    return "\n".join(rows)

"""The report beside a certificate: Markdown, for people, with numbers rounded outward."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from proofs.trusted.numbers import Range
from proofs.trusted.parameters import PAPER, Parameters
from proofs.trusted.verdicts import Verdict

_TITLES = {
    "horseshoe": "The horseshoe, claim by claim",
    "nonplastic": "Section 3.3: impacts with restitution, and their horseshoe",
    "sets": "Sections 3.1 and 3.2: the invariant set, and the steps of Claim 1",
    "dimension": "Sections 3.2 and 3.4: Hausdorff dimensions of the invariant sets",
    "chaos": "Section 3.4: more chaos than the paper saw",
    "circle": "Section 3.4: the global picture",
    "entropy": "Section 3.4: the chaos of the plastic map as a whole",
    "persistence": "Section 3.4: what restitution changes",
    "single": "Section 4: single-impact periodic orbits",
    "soft": "Section 5: soft springs, equation by equation",
    "resonance": "Sections 6 and 7: resonance",
    "foundations": "Section 2 and the appendix",
    "explore": "What is proved about the motion",
    "curves": "Curves in the plane of eta and nu",
}

_HOW = (
    "Verdicts are proved, by exact algebra and interval arithmetic, and re-derived by the checker; "
    "SIMULATED is no proof."
)

_QUANTITIES = MappingProxyType(
    {
        **{f"slope_min_I{i}": f"least f' on I{i}" for i in (0, 1)},
        **{f"slope_max_I{i}": f"greatest f' on I{i}" for i in (0, 1)},
        **{f"image_low_I{i}": f"f(left end of I{i})" for i in (0, 1)},
        **{f"image_high_I{i}": f"f(right end of I{i})" for i in (0, 1)},
        "s0": "s_0",
        "s0_reciprocal_slopes": "s_0 with the ratios 1/slope",
    }
)
_SCOPE = {
    "foundations": "About all parameters, or those named; A1's flights without impact are at {at}.",
    "single": "P1 to P3 are about all parameters, P5 and P6 about those of figure 7; in P4 the "
    "solutions that are no orbits are at (eta, nu) = (0.2121, -0.2), the orbits at {at}.",
    "soft": "About all springs, tables and coefficients of restitution, or those named.",
    "resonance": "About eta = 1, all nu and all epsilon, or those named.",
}  # where not all is about the parameters of a run


class Line(NamedTuple):
    """One decided claim, as the screen and the page show it.

    words: the paper's own, a few. truth: the theorem that stands first, if there is one.
    """

    id: str
    verdict: Verdict
    words: str
    statement: str
    why: str
    truth: str | None
    quantities: Mapping[str, Range]


def page(group: str, numbers: Parameters, certificate: dict[str, Any], rows: Sequence[Line]) -> str:
    """Return the report on a group of claims: verdicts, theorems, the numbers, how to check."""
    whose = "the paper's parameters" if numbers == PAPER else "parameters of your own"
    scope = _SCOPE.get(group, f"At {whose}.").format(at=numbers.place)
    sections = [
        f"# {_TITLES[group]}",
        f"{scope} {_HOW}",
        "## Verdicts",
        table(
            ("claim", "verdict", "the paper's words", "statement", "because"),
            [(x.id, x.verdict.value, quoted(x.words), x.statement, x.why) for x in rows],
        ),
        *_theorems(certificate["claims"]),
        *_ending(certificate, group),
    ]
    return "\n\n".join(sections) + "\n"


def quantity_name(name: str) -> str:
    """Return the name of a number in words."""
    return _QUANTITIES.get(name, name.replace("_", " "))


def quoted(words: str) -> str:
    """Return the paper's words in quotes, or that a claim is not the paper's."""
    return f"'{words}'" if words else "(our own question)"


def _theorems(entries: Iterable[dict[str, Any]]) -> list[str]:
    """Return for each claim with a witness or a theorem of its own a section with these."""
    sections = []
    for claim in entries:
        witness, corrected = claim["witness"], claim["corrected"]
        if witness is None and corrected is None:
            continue
        sections.append(f"## {claim['id']}")
        sections += [] if witness is None else [f"Witness: {witness}"]
        sections += [] if corrected is None else [f"Theorem (VERIFIED). {corrected}"]
    return sections


def _ending(certificate: dict[str, Any], name: str) -> list[str]:
    """Return the numbers, each once, and how to check them."""
    bounds: dict[str, dict[str, str]] = {}
    for claim in certificate["claims"]:
        bounds |= {name: x for name, x in claim["quantities"].items() if name not in bounds}
    rows = [(quantity_name(name), ends["lower"], ends["upper"]) for name, ends in bounds.items()]
    about = "Each true value lies between the bounds; they are rounded outward."
    numbers = ["## Numbers", about, table(("quantity", "at least", "at most"), rows)]
    return [
        *(numbers if rows else []),
        "## Check it yourself",
        f"The certificate `{name}.json` beside this page holds the witnesses in exact numbers. "
        "From the repository's root, with nothing but Python:",
        f"    python -S -m proofs.check reports/{name}.json",
    ]


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table for a browser; a cell may have its bars escaped already."""
    cells = [
        [cell.replace("|", "\\|").replace("\\\\|", "\\|") for cell in row] for row in (head, *rows)
    ]
    first, *others = (f"| {' | '.join(row)} |" for row in cells)
    return "\n".join([first, "|" + "---|" * len(head), *others])


def markdown_table(rows: Sequence[Sequence[str]], numbers_from: int = 99) -> list[str]:
    """Return the lines of a table, the first row its header, aligned for a screen, too.

    Columns from `numbers_from` on are aligned to the right.
    """
    rows = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]

    def line(row: Sequence[str]) -> str:
        cells = [
            cell.rjust(width) if k >= numbers_from else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        return "| " + " | ".join(cells) + " |"

    rule = "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    header, *others = rows
    return [line(header), rule, *map(line, others)]

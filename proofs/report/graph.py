"""The dependency graph of the paper's claims, drawn: what falls, what stands, and by what theorem.

A band is a chapter, from left to right goes the paper's argument; what comes from another chapter
is named above a claim. Below it stand, small, the theorems and witnesses that decide it; dotted
lines lead to other claims that they decide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from proofs.report.dependencies import RESTS, falls_with, rests_on
from proofs.report.findings import Finding, Findings, Statement
from proofs.report.typeset import plain
from proofs.trusted.verdicts import Verdict

MARKS = {
    Verdict.VERIFIED: "✓",
    Verdict.REFUTED: "✗",
    Verdict.CONDITIONAL: "◐",
    Verdict.UNDECIDED: "?",
    Verdict.SIMULATED: "~",
}
_CHAPTERS = {
    "2": "2 Model description",
    "3": "3 Sensitive dependence on initial conditions",
    "4": "4 Single impact periodic orbits",
    "5": "5 Soft springs",
    "6": "6 Resonance",
    "7A": "7 Experiment, and appendix",
}
_WIDTH, _COLUMN, _ROW, _LEFT, _TOP = 54, 86, 54, 16, 48
_BOX = 26  # the height of a claim
_CHAPTER_OF = dict.fromkeys("HNG", "3") | {"E": "7", "A": "7"}  # by the claims' letters
_STYLE = """
.edge{fill:none;stroke:var(--edge,#8a939d);stroke-width:1.1}
.edge.fallen{stroke:var(--refuted,#b3400c);stroke-dasharray:4 3}
.edge.decides{stroke:var(--verified,#00694f);stroke-width:.9;stroke-dasharray:1 3}
.band{fill:var(--band,#f3f5f7)}
.graph text{font:600 12px system-ui,sans-serif;fill:var(--paper,#fff);text-anchor:middle}
.graph text.section{font-weight:400;fill:var(--muted,#5b6570);text-anchor:start}
.graph text.from{font-weight:400;font-size:9.5px;fill:var(--muted,#5b6570);text-anchor:start}
.VERIFIED,.Theorem{fill:var(--verified,#00694f)}
.REFUTED,.Witness{fill:var(--refuted,#b3400c)}
.CONDITIONAL,.Condition{fill:var(--conditional,#7a5200)}
.UNDECIDED{fill:var(--undecided,#5b6570)}
.SIMULATED{fill:var(--simulated,#0b5c93)}
.ring{fill:none;stroke:var(--refuted,#b3400c);stroke-width:1.4;stroke-dasharray:4 3}
"""


@dataclass(frozen=True)
class Falling:
    """A refuted claim, and the claims whose argument in the paper falls with it, by verdict."""

    claim: Finding
    standing: tuple[Finding, ...]  # true all the same, or under conditions
    falling: tuple[Finding, ...]


def falling(findings: Findings) -> list[Falling]:
    """Return what falls with each refuted claim of the paper, in its order."""
    consequences = []
    for claim in findings.claims:
        after = falls_with(claim.id)
        if claim.verdict is Verdict.REFUTED and after:
            others = [other for other in findings.claims if other.id in after]
            stands = (Verdict.VERIFIED, Verdict.CONDITIONAL)
            standing = tuple(other for other in others if other.verdict in stands)
            rest = tuple(other for other in others if other.verdict not in stands)
            consequences.append(Falling(claim, standing, rest))
    return consequences


def svg(findings: Findings) -> str:
    """Return the graph as SVG; a claim links to its place, "#H2"."""
    places, bands, height = _layout(findings)
    width = max(x for x, _ in places.values()) + _WIDTH + _LEFT
    refuted = {claim.id for claim in findings.claims if claim.verdict is Verdict.REFUTED}
    parts = [
        f'<svg class="graph" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        f'width="{width}" height="{height}" role="group" aria-labelledby="graph-title">',
        '<title id="graph-title">Which claims of the paper rest on which</title>',
        f"<style>{_STYLE}</style>",
    ]
    for title, top, tall in bands:
        parts.append(f'<rect class="band" y="{top}" width="{width}" height="{tall}" rx="6"/>')
        parts.append(f'<text class="section" x="{_LEFT}" y="{top + 19}">{escape(title)}</text>')
    parts += _edges(places, refuted)
    parts += _decisions(findings, places)
    for claim in findings.claims:
        parts.append(_claim(claim, places[claim.id], bool(rests_on(claim.id) & refuted)))
    return "\n".join([*parts, "</svg>"]) + "\n"


Places = dict[str, tuple[int, int]]


def _layout(findings: Findings) -> tuple[Places, list[tuple[str, int, int]], int]:
    """Return the corners of the claims, the bands with their tops and heights, and the height."""
    places: Places = {}
    bands = []
    top = 0
    for keys, title in _CHAPTERS.items():
        members = [claim.id for claim in findings.claims if claim.section[0] in keys]
        if not members:
            continue
        columns, alone = _columns(members)
        rows = max(map(len, columns))
        for column, claim in enumerate(alone):
            places[claim] = _LEFT + column * _COLUMN, top + _TOP + rows * _ROW
        for column, ids in enumerate(columns):
            shift = (rows - len(ids)) * _ROW // 2
            for row, claim in enumerate(ids):
                x, y = _LEFT + column * _COLUMN, top + _TOP + shift + row * _ROW
                places[claim] = x, y
        tall = _TOP + (rows + bool(alone)) * _ROW
        bands.append((title, top, tall))
        top += tall + 10
    return places, bands, top


def _columns(claims: Sequence[str]) -> tuple[list[list[str]], list[str]]:
    """Put claims in columns by the longest way to them; and return those that stand alone."""
    before = {claim: [x for x in _premises(claim) if x in claims] for claim in claims}
    after = {claim: [x for x in claims if claim in before[x]] for claim in claims}
    alone = [claim for claim in claims if not before[claim] and not after[claim]]
    depth: dict[str, int] = {}

    def deep(claim: str) -> int:
        if claim not in depth:
            depth[claim] = 1 + max(map(deep, before[claim]), default=-1)
        return depth[claim]

    for claim in claims:
        deep(claim)
    for claim in claims:  # what begins an argument stands next to it
        if not before[claim] and after[claim]:
            depth[claim] = min(depth[x] for x in after[claim]) - 1
    linked = [claim for claim in claims if claim not in alone]
    columns = [
        [claim for claim in linked if depth[claim] == column]
        for column in range(1 + max((depth[claim] for claim in linked), default=0))
    ]
    for neighbours in (before, after) * 3:
        _untangle(columns, neighbours)
    return columns, alone


def _untangle(columns: list[list[str]], neighbours: dict[str, list[str]]) -> None:
    """Order each column by the mean height of the neighbours of its claims."""
    height = {
        claim: place - (len(column) - 1) / 2
        for column in columns
        for place, claim in enumerate(column)
    }
    for column in columns:
        mean = {
            claim: sum(height[x] for x in neighbours[claim]) / len(neighbours[claim])
            if neighbours[claim]
            else height[claim]
            for claim in column
        }
        column.sort(key=lambda claim: mean[claim])


def _premises(claim: str) -> tuple[str, ...]:
    return RESTS[claim].on if claim in RESTS else ()


def _edges(places: Places, refuted: set[str]) -> list[str]:
    """Draw the paper's arguments; refuted premises are carried forward."""
    parts = []
    for claim, rest in RESTS.items():
        others = [premise for premise in rest.on if not _together(claim, premise)]
        if claim in places and others:
            x, y = places[claim]
            names = escape(f"from {', '.join(others)}")
            parts.append(f'<text class="from" x="{x + 2}" y="{y - 6}">{names}</text>')
        for premise in rest.on:
            if claim in places and premise in places and premise not in others:
                fallen = {premise, *rests_on(premise)} & refuted
                kind = "edge fallen" if fallen else "edge"
                parts.append(f'<path class="{kind}" d="{_curve(places[premise], places[claim])}"/>')
    return parts


def _together(claim: str, other: str) -> bool:
    """Whether two claims are of one chapter."""
    chapters = "".join(_CHAPTER_OF.get(each[0], each[0]) for each in (claim, other))
    return chapters[0] == chapters[1]


def _curve(start: tuple[int, int], end: tuple[int, int]) -> str:
    """Return a path from the right side of a claim to the left side of another."""
    a, b, c, d = start[0] + _WIDTH, start[1] + _BOX // 2, end[0], end[1] + _BOX // 2
    bend = (c - a) // 2
    return f"M{a} {b}C{a + bend} {b} {c - bend} {d} {c} {d}"


def _decisions(findings: Findings, places: Places) -> list[str]:
    """Draw the statements that decide claims, and lines to the other claims that they decide."""
    parts, spots = [], {}
    for claim in findings.claims:
        x, y = places[claim.id]
        for place, each in enumerate(findings.at(claim.id)):
            spots[each.label] = x + 7 + 11 * place, y + _BOX + 8
    for claim in findings.claims:
        decision = claim.decision
        for each in findings.stated((*decision.because, *decision.corrected)):
            if each.claim != claim.id and _together(each.claim, claim.id):
                (x, y), (c, d) = spots[each.label], places[claim.id]
                parts.append(f'<path class="edge decides" d="M{x} {y}L{c + 6} {d + _BOX}"/>')
    return parts + [_diamond(each, *spots[each.label]) for each in findings.statements.values()]


def _diamond(statement: Statement, x: int, y: int) -> str:
    name = escape(f"{statement.kind} {statement.label}")
    shape = f'<path class="{statement.kind}" d="M{x} {y - 5}l5 5l-5 5l-5-5z"/>'
    return f'<a href="#{statement.label}"><title>{name}</title>{shape}</a>'


def _claim(claim: Finding, place: tuple[int, int], falls: bool) -> str:
    x, y = place
    verdict = claim.verdict
    ring = (
        f'<rect class="ring" x="{x - 3}" y="{y - 3}" width="{_WIDTH + 6}" height="{_BOX + 6}" '
        'rx="8"/>'
        if falls
        else ""
    )
    name = escape(f"{claim.id}, {verdict.value}: {plain(claim.row.words)}")
    return (
        f'<a href="#{claim.id}"><title>{name}</title>{ring}'
        f'<rect class="{verdict.value}" x="{x}" y="{y}" width="{_WIDTH}" height="{_BOX}" rx="6"/>'
        f'<text x="{x + _WIDTH // 2}" y="{y + 17}">{MARKS[verdict]} {claim.id}</text></a>'
    )

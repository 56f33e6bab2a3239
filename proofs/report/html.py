"""The report as one page that needs nothing else: `page(findings, figures)`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from proofs.report import graph
from proofs.report.atlases import Atlas
from proofs.report.checker import Checker
from proofs.report.dependencies import RESTS
from proofs.report.figures.figure import Figure
from proofs.report.findings import Finding, Findings, Statement, Step
from proofs.report.formulas import lines, mathml
from proofs.report.layout import (
    DEFINITIONS,
    MEANINGS,
    PAPER_TITLE,
    Block,
    block,
    enclosure,
    marked,
    sentences,
    summary,
    tally,
    verdict_name,
)
from proofs.report.page import quantity_name
from proofs.report.specification import rule_theorem
from proofs.report.typeset import html
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.numbers import floor_text
from proofs.trusted.verdicts import Verdict, told

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src 'unsafe-inline'"
_POLICY_OF_CHECKER = f"{POLICY} 'unsafe-eval' blob:; worker-src blob:"
_TEMPLATES = Path(__file__).parent / "templates"
_TITLE = re.compile("<title>.*</title>\\n")  # of a drawing; in the page it stands beside
_LONGEST = 1200  # characters of a formula that is set; longer ones are shown as they are read


def page(
    findings: Findings,
    figures: Sequence[Figure],
    drawn: Mapping[str, str],
    checker: Checker | None = None,
    atlases: Sequence[Atlas] = (),
) -> str:
    """Return the page. drawn: the figures as SVG, by name. checker: what one in the page needs.

    atlases: those beside it.
    """
    return rendered(
        "page.html",
        view=View(findings, figures),
        drawn={name: _TITLE.sub("", text, count=1) for name, text in drawn.items()},
        RESTS=RESTS,
        title=PAPER_TITLE,
        policy=_POLICY_OF_CHECKER if checker else POLICY,
        summary=summary(findings),
        sections=list(findings.sections()),
        graph=Markup(graph.svg(findings)),
        falling=graph.falling(findings),
        figures=figures,
        checker=checker,
        atlases=atlases,
    )


def rendered(template: str, **values: Any) -> str:
    """Return a page by a template, which may include other files of its folder as they are."""
    environment = Environment(
        loader=FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    values = {"policy": POLICY, **values}
    environment.globals.update(
        values,
        text_of=_text_of,
        MARKS=graph.MARKS,
        MEANINGS=MEANINGS,
        DEFINITIONS=DEFINITIONS,
        verdict_name=verdict_name,
        quantity_name=quantity_name,
        enclosure=enclosure,
        floor_text=floor_text,
    )
    environment.filters.update(
        typeset=lambda text: Markup(html(text)), formula=formula, coded=_coded
    )
    return environment.get_template(template).render()


def _coded(text: str) -> Markup:
    """Return a text with what stands between backquotes as code."""
    return _alternating(text, "`", lambda inner: f"<code>{escape(inner)}</code>", escape)


def _alternating(
    text: str, mark: str, inside: Callable[[str], str], outside: Callable[[str], str]
) -> Markup:
    """Return a text, each part between two marks in one way, and all others in another."""
    parts = text.split(mark)
    return Markup("".join(inside(x) if k % 2 else outside(x) for k, x in enumerate(parts)))


def _text_of(name: str) -> Markup:
    return Markup((_TEMPLATES / name).read_text(encoding="utf-8"))


@dataclass(frozen=True)
class View:
    """What the templates ask for."""

    findings: Findings
    figures: Sequence[Figure]

    @cached_property
    def tally(self) -> list[tuple[Verdict, int]]:
        """How many of the paper's claims have which verdict."""
        return tally(self.findings)

    @property
    def headline(self) -> Statement | None:
        """The theorem beside the paper's main one: what it corrects, if that is decided."""
        for claim in self.findings.claims:
            if claim.row.where.endswith("Theorem 2") and claim.decision.corrected:
                return self.findings.stated(claim.decision.corrected)[0]
        return None

    @cached_property
    def first(self) -> Mapping[tuple[str, str], str]:
        """The claim at which a step of a certificate is shown."""
        shown: dict[tuple[str, str], str] = {}
        for claim in self.findings.claims:
            for step in claim.steps:
                shown.setdefault((claim.file, step.name), claim.id)
        return shown

    @property
    def lead(self) -> Markup:
        """The headline theorem in a line."""
        statement = self.headline
        return (
            Markup("")
            if statement is None
            else Markup(html(f"At {statement.conclusion.place}: {statement.conclusion.brief}."))
        )

    def words(self, claim: Finding) -> Markup:
        """Return the paper's own words, a formula between dollars as one."""
        return _alternating(claim.row.words, "$", mathml, html)

    def blocks(self, statement: Statement, printed: str = "") -> list[Block]:
        """Return a statement sentence by sentence, values marked that are printed otherwise."""
        blocks = []
        for part in self.findings.parts(statement):
            if isinstance(part, Statement):
                blocks.append(Block(self.link(part) + "; moreover:"))
            else:
                blocks += [block(sentence, printed) for sentence in sentences(part)]
        return blocks

    def link(self, statement: Statement) -> Markup:
        """Return a link to where a statement stands."""
        return Markup('<a href="#{0}">{1} {0}</a>').format(statement.label, statement.kind)

    def printed(self, claim: Finding) -> Markup:
        """Return the claim as printed, the values marked that the correction changes."""
        proved = " ".join(each.sentence for each in claim.decision.corrected)
        return Markup(marked(claim.reading, proved))

    def brief(self, statement: Statement, printed: str = "") -> Markup:
        """Return a statement in a line."""
        return Markup(marked(statement.conclusion.brief, printed))

    def groups(self, claim: Finding) -> list[tuple[str, list[Step]]]:
        """Return the steps that the proof rests on, by rule."""
        rules: dict[str, list[Step]] = {}
        for step in claim.other_steps:
            rules.setdefault(step.rule, []).append(step)
        return list(rules.items())

    def seen(self, claim: Finding, step: Step) -> str:
        """Return the claim at which a step is shown, "" where that is here."""
        at = self.first[claim.file, step.name]
        return "" if at == claim.id else at

    def step_text(self, step: Step) -> Markup:
        """Return what a step concludes: a link to where that stands, a formula, or a sentence."""
        stands = self.findings.statements.get(told([step.conclusion]))
        if stands is not None:
            return self.link(stands) + ": " + Markup(html(stands.conclusion.brief))
        return formula(step.conclusion) or Markup(html(step.conclusion.sentence))

    def rests(self, claim: Finding) -> list[str]:
        """Return the claims of this page that one rests on, in the paper."""
        present = {each.id for each in self.findings.claims}
        return [each for each in RESTS[claim.id].on if each in present] if claim.id in RESTS else []

    def uses(self, claim: Finding) -> list[str]:
        """Return the claims of this page that the paper derives from one."""
        return [
            each.id
            for each in self.findings.claims
            if each.id in RESTS and claim.id in RESTS[each.id].on
        ]

    @cached_property
    def rules(self) -> list[tuple[str, list[str]]]:
        """The rules that the proofs use, with their theorems."""
        steps = (
            s for claim in self.findings.claims for s in (*claim.own_steps, *claim.other_steps)
        )
        return [(rule, rule_theorem(rule)) for rule in dict.fromkeys(step.rule for step in steps)]

    @property
    def main(self) -> Figure | None:
        """The figure for the first screen: of the headline theorem."""
        for figure in self.figures:
            if self.headline is not None and self.headline.claim in figure.claims:
                return figure
        return None


def formula(conclusion: Conclusion) -> Markup:
    """Return a conclusion as formulas, "" where it has none."""
    parts = lines(conclusion)
    if any(len(latex) > _LONGEST for latex in parts):
        return Markup("<code>{}</code>").format(conclusion.sentence)
    return Markup("").join(Markup('<span class="line">{}</span>').format(_math(x)) for x in parts)


def _math(latex: str) -> Markup:
    return Markup(mathml(latex))

"""The report as Markdown, for code hosts: the same claims, theorems and pictures as the page."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from proofs.report.dependencies import RESTS
from proofs.report.figures.figure import Figure
from proofs.report.findings import Finding, Findings, Statement
from proofs.report.graph import MARKS, falling
from proofs.report.layout import DEFINITIONS, PAPER_TITLE, summary, tally, verdict_name
from proofs.report.page import table
from proofs.report.typeset import markdown
from proofs.trusted.verdicts import Verdict


def ledger(findings: Findings, figures: Sequence[Figure] = ()) -> str:
    """Return the page on all claims."""
    sections = list(findings.sections())
    parts = [
        f"# {PAPER_TITLE}: the claims, decided",
        summary(findings),
        "The same with proofs, search and formulas is [index.html](index.html), to be opened in a "
        "browser; what is proved of the motion, on one page, is [theorem.md](theorem.md).",
        table(
            ("verdict", "claims of the paper", "means"),
            [(_verdict(v), str(count), DEFINITIONS[v]) for v, count in tally(findings)],
        ),
        "## Contents",
        "\n".join(
            [
                *(f"- [{key} {title}](#sec-{key})" for key, title, _ in sections),
                "- [What falls, what stands](#dependencies)",
                "- [Check it yourself](#check)",
            ]
        ),
    ]
    for key, title, claims in sections:
        parts.append(f'## <a id="sec-{key}"></a>{key} {title}')
        parts.append(
            table(
                ("claim", "verdict", "Coq", "the paper's words"),
                [
                    (_link(each), _verdict(each.verdict), "✓" if each.coq else "", _words(each))
                    for each in claims
                ],
            )
        )
        parts += [
            f"![{picture.title}](figures/{picture.name}.svg)\n\n{_caption(findings, picture)}"
            for picture in figures
            if picture.section == key
        ]
        for claim in claims:
            parts += _claim(findings, claim)
    parts += _falls(findings)
    parts += [
        '## <a id="check"></a>Check it yourself',
        "A tick under Coq: the claim's verdict has a theorem that Coq's kernel accepts, too.",
        "The certificates beside this page hold the witnesses in exact numbers. From the "
        "repository's root, with nothing but Python:",
        "    python -m proofs check reports/MANIFEST.json",
    ]
    return "\n\n".join(parts) + "\n"


def _claim(findings: Findings, claim: Finding) -> list[str]:
    """Return what is said of a claim: the reading, why, and the statements that stand here."""
    decision = claim.decision
    parts = [
        f'### <a id="{claim.id}"></a>{claim.id} {_verdict(claim.verdict)}',
        f"{_words(claim)} ({markdown(claim.row.where)})",
        f"**Claim.** {markdown(claim.reading)}",
    ]
    if decision.missing or not decision.because:
        parts.append(f"**Because:** {markdown(decision.why)}.")
    here = {each.label for each in findings.at(claim.id)}
    for each in findings.stated((*decision.because, *decision.corrected)):
        label = f"{each.kind} {each.label}"
        if each.label in here:
            parts.append(f'<a id="{each.label}"></a>**{label}.** {statement_text(findings, each)}')
        else:
            parts.append(f"See [{label}](#{each.label}): {markdown(each.conclusion.brief)}.")
    rest = RESTS.get(claim.id)
    argument = f"In the paper it rests on {_links(rest.on)}. " if rest else ""
    coq = f" In Coq: {claim.in_coq}." if claim.coq else ""
    made = f"Certificate: [{claim.file}]({claim.file}), made by `{claim.made}`."
    parts.append(argument + made + coq)
    return parts


def statement_text(findings: Findings, statement: Statement) -> str:
    """Return a statement in full, what of it stands elsewhere as a link."""
    return " ".join(
        markdown(part)
        if isinstance(part, str)
        else f"[{part.kind} {part.label}](#{part.label}); moreover:"
        for part in findings.parts(statement)
    )


def _falls(findings: Findings) -> list[str]:
    """Return what falls with each refuted claim."""
    parts = ['## <a id="dependencies"></a>What falls, what stands']
    parts.append("![Which claims rest on which](figures/dependencies.svg)")
    for each in falling(findings):
        words = [f"With {_link(each.claim)} falls the printed argument for"]
        if each.falling:
            words.append(f"{_links(x.id for x in each.falling)}, not true as printed either")
        if each.standing:
            also = "; and for " if each.falling else ""
            standing = _links(x.id for x in each.standing)
            words.append(f"{also}{standing}, true all the same or under conditions")
        parts.append(f"- {' '.join(words)}.".replace(" ; ", "; "))
    return [*parts[:2], "\n".join(parts[2:])]


def _caption(findings: Findings, picture: Figure) -> str:
    """Return a title, how to read the figure, and the claims that it belongs to."""
    verdicts = [
        f"{_link(claim)} {_verdict(claim.verdict)}"
        for claim in findings.claims
        if claim.id in picture.claims
    ]
    shows = markdown(picture.shows)
    return f"**{markdown(picture.title)}.** {shows} Claims: {', '.join(verdicts)}."


def _words(claim: Finding) -> str:
    if claim.row.own:
        return "*The project's own claim*"
    texts = claim.row.words.split("$")
    parts = (f"${text}$" if k % 2 else markdown(text) for k, text in enumerate(texts))
    return f"“{''.join(parts)}”"


def _verdict(verdict: Verdict) -> str:
    return f"{MARKS[verdict]} {verdict_name(verdict)}"


def _link(claim: Finding) -> str:
    return f"[{claim.id}](#{claim.id})"


def _links(ids: Iterable[str]) -> str:
    return ", ".join(f"[{each}](#{each})" for each in ids)

"""The theorem: what is proved of the oscillator at the paper's parameters, as a paper.

A person wrote the template. Each of its lines is a title, or a sentence after a tag: @def, a
definition or a reference within the page; @classical, a theorem of the books; the label of a
conclusion in the ledger, @step:FILE/NAME or @rule:NAME, what a sentence renders. {text} is the
conclusion in its own words, {f(x)} an enclosure of f at a point of a step.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from importlib import resources
from itertools import pairwise
from typing import NamedTuple

from proofs.report.findings import Findings, Statement
from proofs.report.layout import enumerated, sentences
from proofs.report.typeset import markdown
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.laps import SlopeRange
from proofs.trusted.numbers import between

_LINE = re.compile(r"@(\S+) (.+)")
_RULES = "../proofs/trusted/CERTIFICATE.md"
_MARKS = re.compile(r"\[[a-z ]+\]\([^)]+\)|\*\*[A-Za-z ]+(?:\d+)?\*\*|\*Proof\.\*|^#+ ")


class Sentence(NamedTuple):
    """A sentence of the template, with its tag; a title or an empty line has the tag ""."""

    tag: str
    text: str


def template() -> list[Sentence]:
    """Return the lines of the template; ValueError for a sentence that has no tag."""
    sentences = []
    text = (resources.files("proofs.report") / "templates" / "theorem.md").read_text("utf-8")
    for line in text.splitlines():
        match = _LINE.fullmatch(line)
        if match is None and line and not line.startswith("#"):
            raise ValueError(f"a sentence without a tag: {line[:60]}")
        sentences.append(Sentence(match[1], match[2]) if match else Sentence("", line))
    return sentences


def theorem(findings: Findings) -> str:
    """Return the page, with the sentences whose conclusions the ledger lists."""
    conclusions, paragraphs = sources(findings), [list[str]()]
    labels = {each.label: each for each in findings.statements.values()}
    above: dict[str, str] = {}  # the theorems of this page, by what is told in them
    number = ""
    for tag, text in template():
        if tag and tag not in ("def", "classical") and tag not in conclusions:
            continue
        if not tag or text == "{text}" or text.startswith(("**Theorem", "*Proof")):
            paragraphs.append([])  # that begins here
        if text == "{text}":
            paragraphs += [[_quoted(findings, labels[tag], above)], []]
            above[tag] = number
        elif written := f"{rendered(conclusions.get(tag), text)} {_source(tag)}".strip():
            paragraphs[-1].append(written)
        if heading := re.match(r"\*\*(Theorem \d+)", text):
            number = heading[1]
    return "\n\n".join(" ".join(each) for each in paragraphs if each) + "\n"


def _quoted(findings: Findings, statement: Statement, above: Mapping[str, str]) -> str:
    """Return a theorem as a quotation; of it, what a theorem above says is named by that."""
    lines = [""]
    for part in findings.parts(statement):
        if isinstance(part, Statement) and part.label in above:
            lines[-1] += f"What {above[part.label]} says of these sets holds; moreover: "
            continue
        for sentence in sentences(part.text if isinstance(part, Statement) else part):
            head, parts, _ = enumerated(sentence)
            lines[-1] += markdown(head) + " "
            if parts:
                lines += [*(f"- {markdown(each)}" for each in parts), "", ""]
    lines[-1] += _source(statement.label)
    return "\n".join(f"> {line.strip()}".strip() for line in _spaced(lines))


def _spaced(lines: Sequence[str]) -> Iterator[str]:
    """Yield lines, an empty one before a list."""
    for before, line in pairwise(["", *lines]):
        if line.startswith("- ") and not before.startswith("- "):
            yield ""
        yield line


def sources(findings: Findings) -> dict[str, Conclusion | None]:
    """Return what a tag may name: labels, steps, and rules, which have no conclusion."""
    conclusions: dict[str, Conclusion | None] = {
        each.label: each.conclusion for each in findings.statements.values()
    }
    for claim in findings.claims:
        for step in claim.steps:
            conclusions[f"step:{claim.file.removesuffix('.json')}/{step.name}"] = step.conclusion
            conclusions[f"rule:{step.rule}"] = None
    return conclusions


def rendered(conclusion: Conclusion | None, text: str) -> str:
    """Return a sentence with what it takes from its conclusion."""

    def put(match: re.Match[str]) -> str:
        if isinstance(conclusion, SlopeRange) and match[1] is not None:
            place = conclusion.points.index(Fraction(match[1]))
            return between(conclusion.images[place])
        raise ValueError(f"nothing to put for {match[0]}")

    return _linked(re.sub(r"\{f\(([\d.]+)\)\}", put, text))


def _source(tag: str) -> str:
    """Return the mark behind a sentence."""
    kind, _, name = tag.partition(":")
    if tag in ("", "def", "classical"):
        return ""
    if kind == "rule":
        return f"[`{name}`]({_RULES}#{name})"
    if kind == "step":
        file, _, step = name.partition("/")
        return f"[{step}]({file}.json)"
    return f"[[{tag}](ledger.md#{tag})]"


def _linked(text: str) -> str:
    """Typeset a text but for its links and its marks of emphasis."""
    parts, place = [], 0
    for match in _MARKS.finditer(text):
        parts += [markdown(text[place : match.start()]), match[0]]
        place = match.end()
    return "".join([*parts, markdown(text[place:])])

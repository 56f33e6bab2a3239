"""From a lemma file's text to sentences: every step about formulas re-derived."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from proofs.trusted.certificate import Reader, parse, used_steps
from proofs.trusted.kernel import cones, graph, identity, inequalities, zeros
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.context import SCHEMA, Conclusion, Context
from proofs.trusted.kernel.formula import Exhausted, read_formula
from proofs.trusted.verify import Rejected

_MAX_TEXT = 1_000_000

RULES: dict[str, Callable[[Context, Reader], Conclusion]] = {
    "sign": inequalities.sign,
    "monotone": inequalities.monotone,
    "range": inequalities.range_,
    "expansion": inequalities.expansion,
    "no-zero": inequalities.no_zero,
    "refute-at": inequalities.refute_at,
    "zero": zeros.zero,
    "root": zeros.root,
    "unique-zero": zeros.unique_zero,
    "identity": identity.identity,
    "h-set": graph.h_set,
    "covers": graph.covers,
    "graph": graph.graph,
    "entropy": graph.entropy,
    "cone": cones.cone,
}


@dataclass(frozen=True)
class LemmaReport:
    """All that a lemma file proves: a sentence a claim, in the order of the file."""

    claims: tuple[str, ...]


def check_lemma(source: str) -> LemmaReport:
    """Re-derive every step of a lemma file.

    Raises Malformed where it is no such file, Rejected where a step does not follow from its
    witness. Names aside, the sentences contain nothing that the checker did not compute or print
    itself from the exact data.
    """
    functions_of, steps_of, claims_of = _read(parse(source))
    context = Context({name: read_formula(name, reader) for name, reader in functions_of.members()})
    try:
        _derive(context, steps_of)
        names = [_named(context, name) for name in claims_of.items(least=1)]
        if len(set(names)) != len(names):
            raise claims_of.fail("a claim appears twice")
        used = used_steps(steps_of, set(names))
        unused = sorted((set(context.known) | set(context.functions)) - used)
        if unused:
            raise steps_of.fail(f"steps or functions that nothing uses: {', '.join(unused)[:80]}")
        return LemmaReport(tuple(_sentences(context, names)))
    except Exhausted as error:
        raise Rejected(f"$: {error}") from None


def _read(root: Reader) -> list[Reader]:
    schema, *parts = root.fields("schema", "functions", "steps", "claims")
    if schema.string() != SCHEMA:
        raise schema.fail(f"schema {schema.string()[:60]!r} is not {SCHEMA!r}")
    return parts


def _derive(context: Context, steps_of: Reader) -> None:
    """Derive the steps, in the order of the file: each names only earlier ones."""
    for name, step in steps_of.members():
        rule_of, witness = step.fields("rule", "witness")
        rule = RULES.get(rule_of.string())
        if rule is None:
            raise rule_of.fail(f"unknown rule {rule_of.string()[:40]!r}")
        if name in RULES or name in context.functions:
            raise step.fail("a step is not named like a rule or a function")
        try:
            context.known[name] = rule(context, witness)
        except Unproved as error:
            raise Rejected(f"{step.path}: {error}") from None


def _named(context: Context, name: Reader) -> str:
    if name.string() not in context.known:
        raise name.fail(f"names no step: {name.string()[:40]!r}")
    return name.string()


def _sentences(context: Context, names: list[str]) -> list[str]:
    """Return what the steps say; Exhausted where that is more than anybody reads."""
    sentences, left = [], _MAX_TEXT
    for name in names:
        sentences.append(context.known[name].says())
        left -= len(sentences[-1])
        if left < 0:
            raise Exhausted(f"sentences of more than {_MAX_TEXT} characters")
    return sentences

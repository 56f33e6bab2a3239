"""From a certificate's text to verdicts: every step re-derived, every field accounted for.

Each step is proved by the rule that it names, from its witness and the conclusions of the steps
that it names. A claim is {`id`, `statement`, `verdict`, `proof`: names of steps, `why`, `witness`,
`corrected`, `quantities`: name to {`lower`, `upper`}}. The row of that id says what the conclusions
of its proof make of it, at these parameters; verdict and texts must be what the row gives, and each
bound of a quantity must contain the enclosure that is proved. In a file without such parameters,
about a box of oscillators or about formulas, a claim is the name of a step, whose conclusion is
printed as a sentence.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from proofs.trusted.certificate import FIELDS, SCHEMA, Reader, parse, subject_from_json, used_steps
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.meter import DEFAULT, METER, metered
from proofs.trusted.numbers import Range
from proofs.trusted.paper import find
from proofs.trusted.parameters import PAPER, Parameters, Place
from proofs.trusted.rules import RULES, find_rule
from proofs.trusted.verdicts import Verdict, told

_MAX_TEXT = 1_000_000
_STEP = 150  # work on a step or a function, beside what is counted there
_LOOK = 20  # work of a row on one conclusion: whether it is of a kind, and about its oscillator


class Rejected(ValueError):
    """The certificate is well-formed and does not prove what it says."""


class Checked(NamedTuple):
    """One claim that the checker derived by itself."""

    id: str
    verdict: Verdict
    statement: str
    why: str
    corrected: str | None


class Report(NamedTuple):
    """All that a file proves: claims of the catalogue about parameters; else conclusions.

    context: the conclusion of every step.
    """

    context: Context
    claims: tuple[Checked, ...] = ()
    conclusions: tuple[Conclusion, ...] = ()

    @property
    def sentences(self) -> tuple[str, ...]:
        """The conclusions in words, each after the oscillators that it is about, if any."""
        return tuple(_said(each) for each in self.conclusions)

    @property
    def parameters(self) -> Parameters | Place | None:
        """The numbers that the claims are about; or the box of oscillators, None for formulas."""
        return self.context.parameters

    @property
    def is_paper(self) -> bool:
        """Whether the claims are the paper's own, at its printed numbers."""
        return self.parameters == PAPER


def check(source: str, work: int = DEFAULT) -> Report:
    """Re-derive everything in a certificate's text, with so much work at most.

    Raises Malformed where it is no certificate, Rejected where a step, a bound, a text or a verdict
    does not follow from the witnesses, Exhausted where that takes more work.
    """
    with metered(work):
        return check_document(parse(source))


def check_document(document: Reader) -> Report:
    """Do as `check` with what is parsed, on the meter that there is."""
    functions_of, steps_of, claims_of = document.fields(*FIELDS)[2:]
    context = _premises(document)
    used: set[str] = set()
    try:
        report = _conclude(context, claims_of, used)
    except Unproved as error:
        raise Rejected(f"{claims_of.path}: {error}") from None
    used = used_steps(steps_of, used)
    unused = sorted(
        ({*context.known} - used) | ({*context.functions} - used_steps(functions_of, used))
    )
    if unused:
        raise steps_of.fail(f"steps or functions that nothing uses: {', '.join(unused)[:80]}")
    return report


def premises(source: str) -> Context:
    """Return what the steps of a certificate prove, whatever its claims."""
    return _premises(parse(source))


def _premises(document: Reader) -> Context:
    schema, parameters_of, functions_of, steps_of, _ = document.fields(*FIELDS)
    if schema.string() != SCHEMA:
        again = "`python -m proofs ledger --fresh` makes those of a folder of reports anew"
        raise schema.fail(f"schema {schema.string()[:60]!r} is not {SCHEMA!r}; {again}")
    context = Context(subject_from_json(parameters_of))
    for name, each in functions_of.members():
        METER.get().spend(_STEP)
        from proofs.trusted.kernel.composition import read_map  # that few files have

        try:
            context.functions[name] = read_map(name, each, context.functions)
        except Unproved as error:
            raise Rejected(f"{each.path}: {error}") from None
    derive(context, steps_of)
    return context


def derive(context: Context, steps_of: Reader) -> None:
    """Derive the steps, in the order of the file: each names only earlier ones."""
    rules = {step.fields("rule", "witness")[0].string() for _, step in steps_of.members()}
    for name, step in steps_of.members():
        rule_of, witness = step.fields("rule", "witness")
        METER.get().spend(_STEP)
        rule = find_rule(rule_of.string())
        if rule is None:
            raise rule_of.fail(f"unknown rule {rule_of.string()[:40]!r}")
        if name in rules or name in RULES or name in context.functions:
            raise step.fail("a step is not named like a rule or a function")
        try:
            context.known[name] = rule(context, witness)
        except Unproved as error:
            raise Rejected(f"{step.path}: {error}") from None


def _conclude(context: Context, claims_of: Reader, used: set[str]) -> Report:
    """Return what the claims of a file are: of the catalogue, or the sentences of its steps."""
    entries = claims_of.items(least=1)
    if not isinstance(context.parameters, Parameters):
        known, length = _conclusions(context, claims_of, used), 0
        for each in known:
            length += len(_said(each))
            if length > _MAX_TEXT:
                raise Rejected(f"$: sentences of more than {_MAX_TEXT} characters")
        return Report(context, conclusions=tuple(known))
    claims = tuple(_check_claim(context, entry, used) for entry in entries)
    if len({claim.id for claim in claims}) != len(claims):
        raise claims_of.fail("a claim appears twice")
    return Report(context, claims)


def _said(conclusion: Conclusion) -> str:
    return conclusion.sentence if conclusion.place is None else told([conclusion])


def _check_claim(context: Context, entry: Reader, used: set[str]) -> Checked:
    """Check an entry whose every text must be what the conclusions of its steps decide."""
    id_of, statement, verdict, proof, why, witness, corrected, bounds = entry.fields(
        "id", "statement", "verdict", "proof", "why", "witness", "corrected", "quantities"
    )
    row = find(id_of.string())
    if row is None:
        raise id_of.fail(f"unknown claim {id_of.string()[:20]!r}")
    decision = row.decide(context.of, _conclusions(context, proof, used))
    says, own_why, theorem = row.says(context.of), decision.why, decision.theorem
    for given, own in (
        (statement, says),
        (verdict, decision.verdict.value),
        (why, own_why),
        (witness, decision.witness),
        (corrected, theorem),
    ):
        if (None if given.is_null() else given.string()) != own:
            raise Rejected(f"{given.path}: the proof of {row.id} gives {str(own)[:100]!r}")
    _check_quantities(row.id, decision.quantities, bounds)
    return Checked(row.id, decision.verdict, says, own_why, theorem)


def _conclusions(context: Context, names: Reader, used: set[str]) -> list[Conclusion]:
    """Return what the named steps prove, each named once, and mark these as used."""
    named: dict[str, Conclusion] = {}
    for name in names.items():
        if (step := name.string()) not in context.known:
            raise name.fail(f"names no step: {step[:40]!r}")
        if step in named:
            raise name.fail("names a step twice")
        named[step] = context.known[step]
    used.update(named)
    METER.get().spend(_LOOK * len(named))
    return [*named.values()]


def _check_quantities(claim: str, own: Mapping[str, Range], bounds: Reader) -> None:
    """Reject a printed bound that the checker's own enclosure does not imply."""
    for name, value in bounds.members():
        if name not in own:
            raise Rejected(f"{value.path}: {claim} proves no quantity of this name")
        lower, upper = value.decimals()
        if not (lower <= own[name][0] and own[name][1] <= upper):
            raise Rejected(f"{value.path}: the bounds do not contain the proved enclosure")

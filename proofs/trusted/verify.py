"""From a certificate's text to verdicts: every step re-derived, every field accounted for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from proofs.trusted import flights as rules
from proofs.trusted import paper as catalogue
from proofs.trusted.certificate import SCHEMA, Reader, parameters_from_json, parse, used_steps
from proofs.trusted.facts import PAPER, Facts, Parameters, PointFact, Range
from proofs.trusted.flights import Known, Rule
from proofs.trusted.kernel.arithmetic import Unproved
from proofs.trusted.statements import HORSESHOE, STATEMENTS, Verdict, decide, quantities, theorem


class Rejected(ValueError):
    """The certificate is well-formed and does not prove what it says."""


@dataclass(frozen=True)
class Checked:
    """One claim that the checker derived by itself."""

    id: str
    verdict: Verdict
    statement: str
    why: str
    corrected: str | None = None


@dataclass(frozen=True)
class Report:
    """All that a certificate proves."""

    parameters: Parameters
    claims: tuple[Checked, ...]
    theorem: str | None

    @property
    def is_paper(self) -> bool:
        """Whether the claims are the paper's own, at its printed numbers."""
        return self.parameters == PAPER


def check(source: str) -> Report:
    """Re-derive everything in a certificate's text.

    Raises Malformed where it is no certificate, Rejected where a step, a bound or a verdict
    does not follow from the witnesses.
    """
    root = parse(source)
    schema, parameters_of, steps_of, claims_of, corrected_of = root.fields(
        "schema", "parameters", "steps", "claims", "corrected"
    )
    if schema.string() != SCHEMA:
        raise schema.fail(f"schema {schema.string()[:60]!r} is not {SCHEMA!r}")
    parameters = parameters_from_json(parameters_of)
    known = _derive_steps(parameters, steps_of, _groups(claims_of))
    used: set[str] = set()
    theorem_text = None
    if not corrected_of.is_null():
        theorem_text = _check_corrected(parameters, known, corrected_of, used)
    claims = [
        _check_claim(parameters, known, entry, used, theorem_text)
        for entry in claims_of.items(least=1)
    ]
    if len({claim.id for claim in claims}) != len(claims):
        raise claims_of.fail("a claim appears twice")
    unused = sorted(set(known) - used_steps(steps_of, used))
    if unused:
        raise steps_of.fail(f"steps that nothing uses: {', '.join(unused)[:80]}")
    return Report(parameters, tuple(claims), theorem_text)


def _groups(claims_of: Reader) -> list[str]:
    """Return all groups of claims, those that the file is about first."""
    named = set(claims_of.mentioned())
    groups = catalogue.GROUPS
    return sorted(groups, key=lambda group: named.isdisjoint(groups[group]))


def _derive_steps(
    of: Parameters, steps_of: Reader, groups: Iterable[str] = tuple(catalogue.GROUPS)
) -> Known:
    known: Known = {}
    names = {step.fields("rule", "witness")[0].string() for _, step in steps_of.members()}
    for name, step in steps_of.members():
        rule_of, witness = step.fields("rule", "witness")
        rule = find_rule(rule_of.string(), groups)
        if rule is None:
            raise rule_of.fail(f"unknown rule {rule_of.string()[:40]!r}")
        if name in names or name in rules.RULES:
            raise step.fail("a step is not named like a rule")
        try:
            known[name] = rule(of, known, witness)
        except Unproved as error:
            raise Rejected(f"{step.path}: {error}") from None
    return known


def find_rule(name: str, groups: Iterable[str] = tuple(catalogue.GROUPS)) -> Rule | None:
    """Return a rule by its name; the modules of the groups are imported until one has it."""
    found = rules.RULES.get(name)
    for group in groups:
        if found is not None:
            break
        found = catalogue.rules_of(group).get(name)
    return found


def _facts(of: Parameters, conclusions: Iterable[object]) -> Facts:
    """Collect what the steps prove about one set of parameters, points aside."""
    facts = Facts()
    for step in conclusions:
        facts.add(of, step)
    return facts


def _check_claim(
    of: Parameters, known: Known, entry: Reader, used: set[str], theorem_text: str | None
) -> Checked:
    id_of, statement, verdict_of, proof, witness, corrected, bounds = entry.fields(
        "id", "statement", "verdict", "proof", "witness", "corrected", "quantities"
    )
    claim = id_of.string()
    other = None if claim in STATEMENTS else catalogue.find(claim)
    if other is not None:
        return _check_decision(of, known, entry, used, other)
    if claim not in STATEMENTS:
        raise id_of.fail(f"unknown claim {claim[:20]!r}")
    if statement.string() != STATEMENTS[claim].says(of):
        raise Rejected(f"{statement.path}: this is not what {claim} says at these parameters")
    facts = _facts(of, _named(known, proof, used))
    alone, _ = decide(claim, of, facts)
    if not witness.is_null():
        _take_witness(witness, facts, known, proof)
    verdict, why = decide(claim, of, facts)
    if verdict_of.string() != verdict.value:
        raise Rejected(
            f"{verdict_of.path}: {claim} is given as {verdict_of.string()[:20]!r}, "
            f"its proof makes it {verdict.value} ({why})"
        )
    if not witness.is_null() and verdict is alone:
        raise Rejected(f"{witness.path}: a witness that the verdict does not rest on")
    correction = theorem_text if verdict is Verdict.REFUTED else None
    if not corrected.is_null() and corrected.string() != correction:
        raise Rejected(f"{corrected.path}: not a proved correction of a refuted claim")
    _check_quantities(claim, quantities(claim, facts), bounds)
    return Checked(claim, verdict, STATEMENTS[claim].says(of), why)


def _check_decision(
    of: Parameters, known: Known, entry: Reader, used: set[str], claim: catalogue.Claim
) -> Checked:
    """Check an entry whose every text must be what the conclusions of its steps decide."""
    _, statement, verdict, proof, witness, corrected, bounds = entry.fields(
        "id", "statement", "verdict", "proof", "witness", "corrected", "quantities"
    )
    decided = claim.decide(of, _named(known, proof, used))
    for given, own in (
        (statement, claim.says(of)),
        (verdict, decided.verdict.value),
        (witness, decided.witness),
        (corrected, decided.corrected),
    ):
        if (None if given.is_null() else given.string()) != own:
            raise Rejected(f"{given.path}: the proof of {claim.id} gives {str(own)[:100]!r}")
    _check_quantities(claim.id, decided.quantities, bounds)
    return Checked(claim.id, decided.verdict, claim.says(of), decided.why, decided.corrected)


def _take_witness(witness: Reader, facts: Facts, known: Known, proof: Reader) -> None:
    """Read the witness that a refutation points at: an interval J, or a step about a phase."""
    if "interval" in dict(witness.members()):
        (interval,) = witness.fields("interval")
        facts.missed = interval.range()
        return
    name, phase = witness.fields("point", "phase")
    step = known.get(name.string())
    if not isinstance(step, PointFact) or name.string() not in set(proof.mentioned()):
        raise name.fail("names no point step of this proof")
    if step.phase != phase.number():
        raise phase.fail("is not the phase of that step")
    facts.points.append(step)


def _named(known: Known, names: Reader, used: set[str]) -> list[object]:
    """Return the named conclusions and mark them, and the first impacts, as used."""
    result: dict[str, object] = {}
    for name in names.items():
        if name.string() not in known:
            raise name.fail(f"names no step: {name.string()[:40]!r}")
        if name.string() in result:
            raise name.fail("names a step twice")
        result[name.string()] = known[name.string()]
    used.update(result)
    return list(result.values())


def _check_quantities(claim: str, own: Mapping[str, Range], bounds: Reader) -> None:
    """Reject a printed bound that the checker's own enclosure does not imply."""
    for name, value in bounds.members():
        if name not in own:
            raise Rejected(f"{value.path}: {claim} proves no quantity of this name")
        lower, upper = value.decimals()
        if not (lower <= own[name][0] and own[name][1] <= upper):
            raise Rejected(f"{value.path}: the bounds do not contain the proved enclosure")


def _check_corrected(paper: Parameters, known: Known, corrected: Reader, used: set[str]) -> str:
    """Check H1-H6 at the corrected sets; return the theorem that follows from them."""
    parameters_of, statement, proof = corrected.fields("parameters", "theorem", "proof")
    of = parameters_from_json(parameters_of)
    if (of.eta, of.nu) != (paper.eta, paper.nu):
        raise Rejected(f"{parameters_of.path}: a correction is about the same eta and nu")
    if of.ratios is not None or of.printed_s0 is not None:
        raise Rejected(f"{parameters_of.path}: a correction proves nothing about s_0")
    if (of.epsilon, of.velocities, of.reach) != (None, None, None):
        raise Rejected(f"{parameters_of.path}: a correction is about plastic impacts")
    facts = _facts(of, _named(known, proof, used))
    if of.slopes[0] <= 1:
        raise Rejected(f"{parameters_of.path}: the corrected slopes do not expand")
    for claim in HORSESHOE:
        verdict, why = decide(claim, of, facts)
        if verdict is not Verdict.VERIFIED:
            raise Rejected(f"{corrected.path}: {claim} is {verdict.value} there ({why})")
    if statement.string() != theorem(of):
        raise Rejected(f"{statement.path}: not the theorem at these numbers")
    return theorem(of)

"""Beyond the paper: what can be proved about the motion at any parameters. Rows X1 to X5, X10.

Horseshoes and attractors are found in floating point; what is not proved then is left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import partial
from types import MappingProxyType

from intervals import Undecided
from proofs.search.beyond_attractors import Run, settled, stable, sticking
from proofs.search.budget import EFFORT, FASTEST, Budget
from proofs.search.evidence import FAILED, Evidence, Proof, search_each
from proofs.search.loops import loops
from proofs.search.request import Request, proving
from proofs.search.s34_absorbing import Partition
from proofs.search.s34_chaos import prove_entropy
from proofs.search.s34_circle import prove_longest
from proofs.search.shifts import full_shifts, pieces
from proofs.trusted.numbers import Range
from proofs.trusted.paper.beyond.returning import StickingMotion, SticksOnce
from proofs.trusted.paper.s34_circle.circle import MAJORITY
from proofs.trusted.parameters import Parameters

_TURNS, _DEPTH = 150, 1  # of the flights, and of the tower of states, in covering graphs
_GAIN, _SPARE, _PIECES, _LONGEST_FLIGHT = 2e-3, 1e-2, 150, 200  # see `Partition`


@proving
def prove(request: Request, effort: int = EFFORT, seconds: float | Fraction = math.inf) -> Evidence:
    """Prove what the claims asked for rest on, as far as it goes: see `Budget`."""
    prover = request.prover()
    run = Run(prover, Budget(request.of.eta, effort, seconds))
    evidence = Evidence(prover.steps, {claim: [] for claim in request.claims})
    if too_fast(request.of, evidence, _SEARCHES):
        return evidence
    within = partial(run.budget.attempt, prover.undone)
    return search_each(evidence, request.claims, _SEARCHES, request.tell, run, within=within)


def too_fast(statement: Parameters, evidence: Evidence, searches: Iterable[str]) -> bool:
    """Whether eta is too large for any search, which is noted at each claim that asks for one."""
    if statement.eta <= FASTEST:
        return False
    note = f"for eta > {FASTEST} flights are not followed"
    evidence.notes |= dict.fromkeys(evidence.proofs.keys() & set(searches), note)
    return True


# -- horseshoes ------------------------------------------------------------------------------------


def _chaos(run: Run) -> Proof:
    """Prove a full shift, or else a covering graph of positive entropy, or two loops."""
    budget, calm = run.budget, settled(run)
    if calm:
        return calm
    seen = pieces(run.system, budget.grid, budget.farthest, budget.check)
    with suppress(*FAILED):
        return _markov(run, full_shifts(seen))
    graph = [x for x in prove_entropy(run.prover, _TURNS, _DEPTH) if x[1].growth > 1]
    if graph:
        return [*graph]
    try:
        return _markov(run, loops(run.system, seen, run.budget.check))
    except Undecided as failure:
        looked = f"looked at: {len(seen)} pieces of branches of f with |f'| > 1, flights up to time"
        raise Undecided(f"{failure}; {looked} {run.budget.farthest:g}") from None


def _markov(run: Run, candidates: Iterator[list[Range]]) -> Proof:
    """Prove a subshift (rule staying-set), on the first sets that allow it."""
    failure, prover = "no sets are seen that f maps over each other in several ways", run.prover
    for sets, _ in zip(candidates, range(run.budget.tries), strict=False):
        run.budget.check()
        try:
            with prover.undone():
                parts = [prover.slopes(list(domain)) for domain in sets]
                cells = [part.domain for _, part in parts]
                kept = prover.stays(cells, list(zip(parts, cells, strict=True)))
                if kept[1].orbit:
                    raise Undecided("one orbit alone stays in the sets")
                return [kept]
        except FAILED as error:
            failure = str(error)
    raise Undecided(failure)


def _shares(run: Run) -> Proof:
    """Prove how much of the circle comes to the sticking arc, or never impacts again.

    Not where the one motion that sticks has more than one impact a period, or never sticks again.
    """
    run.budget.check()
    with suppress(*FAILED), run.prover.undone():
        ends: Proof = [*run.made(StickingMotion), *run.made(SticksOnce)] or sticking(run)
        if not any(isinstance(x, StickingMotion) and not x.cells for _, x in ends):
            return ends
    arc, never = run.arc, None
    if settled(run) or (arc[1].returns and arc[1].share > MAJORITY):
        return [arc]
    with suppress(*FAILED):
        never = prove_longest(run.prover)
    cells, impacts = run.budget.grid // 2, run.budget.impacts // 8
    partition = Partition(
        run.prover,
        arc,
        never,
        _GAIN,
        most=cells,
        turns=_LONGEST_FLIGHT,
        impacts=impacts,
        spare=_SPARE,
        pieces=_PIECES,
    )
    return [arc, partition.prove(), *([] if never is None else [never])]


_SEARCHES: Mapping[str, tuple[str, Callable[[Run], Proof]]] = MappingProxyType(
    {
        "X2": ("horseshoes", _chaos),
        "X3": ("motions that stick", sticking),
        "X4": ("stable orbits that do not", stable),
        "X5": ("flights without an end", lambda run: [prove_longest(run.prover)]),
        "X10": ("where all phases lead", _shares),
    }
)

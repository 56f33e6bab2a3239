"""A second reader of certificates, written from the docstrings of the rules alone.

It shares with the checker the words of the claims and nothing else; it decides verdicts and bounds,
and leaves it to the checker whether a reason is worded as it should be.
"""

import json
import re
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import gcd

from flint import ctx

from proofs.trusted.paper import GROUPS, find
from proofs.trusted.parameters import Parameters
from tests.proofs.trusted.second_claims import BELOW_TURN, Facts, verdict, verified
from tests.proofs.trusted.second_map import Impacts, NotAProof, avoids, moran_root, proof, within

__all__ = ["NotACertificate", "NotAProof", "read"]

RULES = ("first-impact", "point", "slope-range", "avoids", "moran-root", "staying-set")
CLAIMS = GROUPS["horseshoe"]
PARAMETERS_OF_CLAIMS = ("slopes", "ratios", "printed_s0", "epsilon", "velocities", "reach")
NUMBER = "-?(0|[1-9][0-9]*)(/[1-9][0-9]*)?"
DECIMAL = r"-?(0|[1-9][0-9]*)(\.[0-9]+)?"
NAME = "[A-Za-z][A-Za-z0-9_-]{0,59}"


class NotACertificate(Exception):
    """The text has not the form of a certificate."""


def form(condition, what):
    if not condition:
        raise NotACertificate(what)


# -- form ------------------------------------------------------------------------------------------


def parse(text):
    def unique(pairs):
        form(len(dict(pairs)) == len(pairs), "a field twice")
        return dict(pairs)

    def refuse(number):
        raise NotACertificate(f"a bare number: {number[:40]}")

    form(len(text) <= 4_000_000, "too large")
    hooks = dict.fromkeys(("parse_int", "parse_float", "parse_constant"), refuse)
    try:
        return json.loads(text, object_pairs_hook=unique, **hooks)
    except (ValueError, RecursionError) as error:
        raise NotACertificate(str(error)) from None


def fields(value, *names):
    form(isinstance(value, dict) and set(value) == set(names), f"an object of {names}")
    return [value[name] for name in names]


def entries(value, of, least=0, most=10_000):
    form(isinstance(value, list) and least <= len(value) <= most, "a list")
    return [of(entry) for entry in value]


def string(value, pattern=None, limit=3000):
    form(isinstance(value, str), "a string")
    form(not pattern or (len(value) <= limit and re.fullmatch(pattern, value)), f"not {pattern}")
    return value


def number(value, limit=3000):
    above, _, below = string(value, NUMBER, limit).partition("/")
    form(value != "-0" and below != "1" and gcd(int(above), int(below or 1)) == 1, "lowest terms")
    return Fraction(value)


def interval(value, limit=3000):
    low, high = entries(value, lambda end: number(end, limit), 2, 2)
    form(low <= high, "a range")
    return low, high


def phases(value, limit=3000, turns=1):
    low, high = interval(value, limit)
    form(low >= 0 and high <= turns * BELOW_TURN, "phases in [0, 2 pi), or [0, 4 pi)")
    return low, high


def increasing(values):
    form(all(a < b for a, b in pairwise(values)), "increasing order")
    return values


def parameters(value):
    eta, nu, left, right, whole, *more = fields(
        value, "eta", "nu", "left", "right", "interval", *PARAMETERS_OF_CLAIMS
    )
    slopes, ratios, printed, epsilon, gamma, reach = more
    left, right, whole = (phases(each, 400) for each in (left, right, whole))
    eta, nu, slopes = number(eta, 400), number(nu, 400), interval(slopes, 400)
    ratios = None if ratios is None else interval(ratios, 400)
    form(printed is None or string(printed, DECIMAL, 400), "printed digits")
    epsilon = None if epsilon is None else number(epsilon, 400)
    gamma = None if gamma is None else interval(gamma, 400)
    form(epsilon is None or 0 <= epsilon < 1, "epsilon in [0, 1)")
    if reach is not None:
        reach = tuple(entries(reach, lambda end: number(end, 400), 3, 3))
        form(min(reach) >= 0 and reach[0] < eta and reach[1] < abs(nu), "reach")
        form(epsilon is None or epsilon + reach[2] < 1, "reach of epsilon")
    form(gamma is None or gamma[0] < gamma[1], "a range of velocities")
    form(eta > 0 and nu != 0 and slopes[0] > 0, "signs of the parameters")
    form(ratios is None or ratios[0] > 0, "signs of the ratios")
    form(all(low < high for low, high in (left, right, whole)), "a point")
    form(whole[0] <= left[0] and left[1] < right[0] and right[1] <= whole[1], "order of I0, I1, I")
    return Parameters(eta, nu, left, right, whole, slopes, ratios, printed, epsilon, gamma, reach)


# -- steps -----------------------------------------------------------------------------------------


def read_step(step, earlier, used):
    """The rule and the arguments of its function; the steps it names go into `used`."""
    rule, witness = fields(step, "rule", "witness")
    form(rule in RULES, "no such rule")

    def flight(value):
        form(string(value) in earlier and earlier[value][0] == "first-impact", "no such flight")
        used.add(value)
        return value

    def contains(name, piece):
        form(within(piece, earlier[name][1][0]), "the flight is about other phases")

    def point(value):
        name, phase, time = fields(value, "flight", "phase", "time")
        name, phase, time = flight(name), number(phase), interval(time)
        contains(name, (phase, phase))
        return name, phase, time

    def piece(value):
        name, time = fields(value, "flight", "time")
        return flight(name), interval(time)

    if rule == "first-impact":
        inside, times = fields(witness, "phases", "times")
        times = increasing(entries(times, number, 2))
        form(times[0] > 0 and times[-1] <= 10**6, "times from 0 to 10^6")
        return rule, (phases(inside, turns=2), times)
    if rule == "point":
        return rule, point(witness)
    if rule == "slope-range":
        points, pieces = fields(witness, "points", "pieces")
        points = entries(points, point, 2)
        pieces = entries(pieces, piece, len(points) - 1, len(points) - 1)
        marks = increasing([phase for _, phase, _ in points])
        for (name, _), *ends in zip(pieces, marks, marks[1:], strict=False):
            contains(name, ends)
        return rule, (points, pieces)
    if rule == "avoids":
        flights, target = fields(witness, "flights", "target")
        flights = entries(flights, flight, 1)
        parts = [earlier[name][1][0] for name in flights]
        touching = all(a[1] == b[0] for a, b in pairwise(parts))
        form(touching, "flights that do not touch")
        return rule, (flights, phases(target))
    if rule == "staying-set":
        region, cells, gaps = fields(witness, "region", "cells", "gaps")

        def part(value):
            name, domain = fields(value, "slopes", "domain")
            form(string(name) in earlier and earlier[name][0] == "slope-range", "no such slopes")
            domain = interval(domain)
            marks = [phase for _, phase, _ in earlier[name][1][0]]
            form(set(domain) <= set(marks), "points of the slopes")
            used.add(name)
            return name, domain

        def gap(name):
            form(string(name) in earlier and earlier[name][0] == "avoids", "no such gap")
            used.add(name)
            return name

        region = entries(region, interval, 1, 500)
        return rule, (region, entries(cells, part, 1, 500), entries(gaps, gap, 0, 50))
    ratios, root = fields(witness, "ratios", "root")
    return rule, (entries(ratios, number, 2, 2), interval(root))


def prove_step(impacts, rule, data, earlier, of):
    """The conclusion of a step, from those of the earlier ones."""
    if rule == "staying-set":  # horseshoes alone
        region, parts, gaps = data
        proof(len(region) == 1 and len(parts) == 2, "one interval and two sets")
        left, right = sorted(domain for _, domain in parts)
        proof(left[0] < left[1] < right[0] < right[1] <= BELOW_TURN, "I0 before I1")
        proof(region[0] == (left[0], right[1]), "I from I0 to I1")
        its = replace(of, left=left, right=right, interval=region[0], slopes=(1, 10**9))
        facts = [("slope-range", earlier[name]) for name, _ in parts]
        facts = Facts(its, facts + [("avoids", earlier[gap]) for gap in gaps])
        proof(all(within(region[0], earlier[gap][1]) for gap in gaps), "gaps that leave I")
        proof(all(verified(f"H{k}", facts, closed=True) for k in range(1, 7)), "H1-H6")
        proof(all(slopes[0][0] > 1 for slopes in facts.slopes), "slopes that expand")
        return its
    if rule == "first-impact":
        return impacts.first_impact(*data)
    if rule == "point":
        return impacts.point(earlier[data[0]], *data[1:])
    if rule == "slope-range":
        points = [impacts.point(earlier[name], *rest) for name, *rest in data[0]]
        return impacts.slope_range(points, [(earlier[name], time) for name, time in data[1]])
    if rule == "avoids":
        return avoids([earlier[name] for name in data[0]], data[1])
    return moran_root(*data)


# -- the whole -------------------------------------------------------------------------------------


def read_names(value, steps, used):
    names = entries(value, string)
    form(len(set(names)) == len(names) and set(names) <= set(steps), "names of steps, each once")
    used.update(names)
    return names


def read_claim(value, steps, used):
    names = ("id", "statement", "verdict", "proof", "why", "witness", "corrected", "quantities")
    claim = dict(zip(names, fields(value, *names), strict=True))
    form(string(claim["id"]) in CLAIMS, "no such claim")
    for name in ("statement", "verdict", "why"):
        string(claim[name])
    for name in ("witness", "corrected"):
        form(claim[name] is None or string(claim[name]) is not None, "a text or nothing")
    read_names(claim["proof"], steps, used)
    form(isinstance(claim["quantities"], dict), "an object")
    for name, ends in claim["quantities"].items():
        low, high = (Fraction(string(end, DECIMAL)) for end in fields(ends, "lower", "upper"))
        form(re.fullmatch(NAME, name) and low <= high, "bounds of a quantity")
        claim["quantities"] = claim["quantities"] | {name: (low, high)}
    return claim


def read_whole(text):
    """The parameters, steps and claims, with their form checked."""
    names = ("schema", "parameters", "functions", "steps", "claims")
    schema, of, functions, step_texts, claims = fields(parse(text), *names)
    form(schema == "impact-proofs.certificate/4", "another schema")
    form(functions == {}, "no functions are used")
    of, steps, used = parameters(of), {}, set()
    form(isinstance(step_texts, dict), "an object")
    for name, step in step_texts.items():
        form(string(name, NAME) not in RULES, "named like a rule")
        steps[name] = read_step(step, steps, used)
    claims = entries(claims, lambda claim: read_claim(claim, steps, used), 1)
    form(len({claim["id"] for claim in claims}) == len(claims), "a claim twice")
    form(used == set(steps), "a step that nothing uses")
    return of, steps, claims


def judge(claim, of, facts):
    """Prove the verdict of a claim."""
    id_ = claim["id"]
    proof(claim["statement"] == find(id_).says(of), f"{id_}: another statement")
    mine = Facts(of, [facts[name] for name in claim["proof"]])
    own = verdict(id_, mine)
    proof(claim["verdict"] == own, f"{id_} is {own}")
    proof(
        own in ("REFUTED", "CONDITIONAL") or claim["witness"] is None,
        f"{id_}: a witness for nothing",
    )
    known = mine.quantities(id_)
    for name, ends in claim["quantities"].items():
        proof(name in known and within(known[name], ends), f"{id_}: {name}")


def read(text):
    """The verdict of each claim; NotACertificate or NotAProof if there is no proof of it."""
    of, steps, claims = read_whole(text)
    before = ctx.prec
    ctx.prec = 200 + 4 * max(map(len, re.findall("[0-9]+", text)))
    try:
        impacts, conclusions, facts = Impacts(of.eta, of.nu), {}, {}
        for name, (rule, data) in steps.items():
            conclusions[name] = prove_step(impacts, rule, data, conclusions, of)
            facts[name] = rule, conclusions[name]
        for claim in claims:
            judge(claim, of, facts)
        return {claim["id"]: claim["verdict"] for claim in claims}
    finally:
        ctx.prec = before

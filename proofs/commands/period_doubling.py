"""Soft springs: where do orbits with an impact every M table periods appear, and where do they
double their period?

rho = 2 omega^2 beta / g, lambda = 2 omega v / g, K = omega_n / omega, Q = 2 omega^2 p / g; without
K the limit omega_n -> 0. At rho_saddle_node two fixed points of the impact equations appear, at
rho_flip one of them has the eigenvalue -1. Each is said to be an orbit, the mass staying above the
table from launch to impact, or not. For K = 0 fixed points are orbits exactly if rho sin psi >
height_least, which is negative exactly for epsilon > epsilon_least; at rho_graze it is |rho sin
psi|. Orbits of period 2 with phases 2 h apart are at rho^2 = rho_flip^2 + rise h^2 + O(h^4). For K
= 0 cubic is the coefficient of h -> h - 2 cubic h^3 on the centre manifold, the second iterate, and
for plastic impacts f2_psi_rho and f2_psi_psi_psi are its derivatives. Motions whose mass sticks are
told of for plastic impacts and K = 0. Proofs: claims S18, S22, S23 of `python -m proofs soft`.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.period_doubling")

from argparse import ArgumentTypeError, Namespace
from collections.abc import Iterable
from fractions import Fraction

from intervals import Interval, Undecided, sqrt
from proofs.motion.soft import Motion, Springs
from proofs.motion.soft_orbits import (
    Judgement,
    attracts,
    critical_epsilon,
    double_at,
    eigenvalues,
    followed,
    judge,
    judge_fixed,
    least_height,
)
from proofs.motion.soft_sticking import sticking
from proofs.search.derivations import SPARE_BITS, enclose
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number, whole
from proofs.trusted.kernel.enclose import size
from proofs.trusted.numbers import between, show
from proofs.trusted.paper.s5_soft import near
from proofs.trusted.paper.s5_soft.doubling import LIMIT_RISE, RISE

EPILOG = """\
Numbers are exact: 0.2 is 1/5; 7/5 and 2e-3 are fine too. All digits asked for are certified:
each value lies between its bounds, which are rounded outward. Orbits of period 2 are looked for
on the curve that begins at the flip, where their phases are less than 3 apart.

exit status: 0 certified, 1 something is undecided (null in the machine form), 2 bad input

examples:
  python -m proofs period_doubling
  python -m proofs period_doubling --m 3 --epsilon 0.2 --follow
  python -m proofs period_doubling --epsilon 0.3 --k 0.1 --q 2 --rho 5 5.4
  python -m proofs period_doubling --json - --digits 50
"""


def main(arguments: list[str] | None = None) -> int:
    """Print the bifurcations, and motions at rho; return the exit status."""
    parser = Parser("proofs period_doubling", __doc__, EPILOG)
    add = parser.add_argument
    periods = "table periods between impacts, m >= 1 (default 1)"
    add("--m", type=whole("m", 10**9), default=1, help=periods)
    add("--epsilon", type=_epsilon, default=Fraction(0), help="of restitution, in [0, 1)")
    add(
        "--k", type=number, default=Fraction(0), help="omega_n / omega, in [0, 1/(2 m)) (default 0)"
    )
    add("--q", type=number, default=Fraction(0), help="2 omega^2 p / g, with K > 0 (default 0)")
    add("--rho", type=_positive, nargs="+", default=[], help="fixed points and period 2 at RHO")
    add("--follow", action="store_true", help="orbits of period 2 from the flip on, while stable")
    add_answer(parser)
    options = parser.parse_args(arguments)
    if not 0 <= options.k * 2 * options.m < 1:
        parser.error(f"k is in [0, 1/(2 m)), not {show(options.k)}")
    if options.q and not options.k:
        parser.error("q plays no part without --k")
    if options.k**2 * options.q >= 2:
        parser.error("k^2 q is less than 2, else the mass does not rest on the table")
    with answering(parser, options):
        try:
            answer = answer_for(options)
        except Undecided as failure:
            parser.exit(1, f"{parser.prog}: undecided: {failure}\n")
        give(parser, options, answer, _text)
    return int(_open(answer))


def answer_for(options: Namespace) -> Answer:
    """Return the JSON object of an answer."""
    exact, places = (options.epsilon, options.k, options.q), options.digits
    bits = places * 4 + SPARE_BITS + 2 * sum(map(size, (*exact, Fraction(options.m))))
    springs = Springs(options.m, *exact, bits)
    names = zip(("epsilon", "k", "q"), map(show, exact), strict=True)
    answer: Answer = {"m": str(options.m), **dict(names)}
    least = None if springs.k else least_height(springs)
    saddle, flip = springs.saddle_node, springs.flip
    answer["rho_saddle_node"] = _written(saddle.rho, places)
    answer["saddle_node"] = _motion(springs, saddle, judge_fixed(springs, saddle, least), places)
    if least is not None:
        graze = sqrt((springs.period * springs.ratio).sqr() + least.sqr())
        answer["height_least"] = _written(least, places)
        answer["rho_graze"] = _written(graze, places)
        answer["epsilon_least"] = _written(critical_epsilon(springs), places)
    if flip is not None:
        answer["rho_flip"] = _written(flip.rho, places)
        answer["psi"] = _written(flip.impacts[0].psi, places)
        answer["flip"] = _motion(springs, flip, judge_fixed(springs, flip, least), places)
        answer |= _kind(springs, places)
    answer["at"] = {show(rho): _at(springs, rho, least, places) for rho in options.rho}
    if options.follow and flip is not None:
        pairs = followed(springs)
        answer["followed"] = [_stable(springs, *pair, places) for pair in pairs]
    return answer


def _kind(springs: Springs, places: int) -> Answer:
    """Return the values at the flip that S22 and S23 prove."""
    point = {"m": Fraction(springs.m)}
    if springs.k:
        tangent, ratio = "t=sin(pi*m*k)/cos(pi*m*k)", springs.ratio
        base = "(2 - k**2*q)/(1 - k**2*(1 + t**2 + r**2))"
        rise = f"at(at({RISE}, B={base}), {tangent})"
        point |= {"k": springs.k, "q": springs.q, "r": ratio}
        return {"rise": bounds(enclose(rise, places, **point), places)}
    found = {"rise": enclose(LIMIT_RISE, places, r=springs.ratio, **point)}
    point |= {"epsilon": springs.epsilon}
    found["cubic"] = enclose(f"at({near.CUBIC}, c=2*pi*m)", places, **point)
    if not springs.epsilon:
        found["f2_psi_rho"] = enclose(near.F2_PSI_RHO, places, **point)
        found["f2_psi_psi_psi"] = enclose(near.F2_PSI_PSI_PSI, places, **point)
    return {name: bounds(ends, places) for name, ends in found.items()}


def _at(springs: Springs, rho: Fraction, least: Interval | None, places: int) -> list[Answer]:
    """Return the fixed points at rho, and the orbit of period 2."""
    found = [(each, judge_fixed(springs, each, least)) for each in springs.at(rho)]
    double = double_at(springs, rho) if springs.flip is not None else None
    if double is not None:
        found.append((double, judge(springs, double)))
    return [_stable(springs, *pair, places) for pair in found] + _sticking(springs, rho, places)


def _sticking(springs: Springs, rho: Fraction, places: int) -> list[Answer]:
    """Return the orbit of m table periods that sticks: for plastic impacts, in the limit (S18)."""
    if springs.epsilon or springs.k:
        return []
    found = sticking(rho, springs.bits)
    if found is None or found.periods != springs.m:
        return []
    impact = {"psi": _written(found.lands, places), "leaves": _written(found.leaves, places)}
    reason = "the mass sticks after its impact, until rho sin psi rises through 2"
    return [{"impacts": [impact], "orbit": True, "reason": reason, "attracting": True}]


def _motion(springs: Springs, motion: Motion, found: Judgement, places: int) -> Answer:
    """Return the JSON object of a periodic motion."""
    said: Answer = {
        "rho": _written(motion.rho, places),
        "impacts": [
            {"psi": _written(each.psi, places), "lambda": _written(each.lam, places)}
            for each in motion.impacts
        ],
        "jacobian": [
            [_written(entry, places) for entry in row] for row in springs.derivative(motion)
        ],
    }
    real = eigenvalues(springs, motion)
    said["eigenvalues"] = [_written(each, places) for each in real or ()]
    return said | {"orbit": found.orbit, "reason": found.reason}


def _stable(springs: Springs, motion: Motion, found: Judgement, places: int) -> Answer:
    """Return the JSON object of a periodic motion with its stability."""
    stable = attracts(springs, motion)
    return _motion(springs, motion, found, places) | {"attracting": stable}


def _written(value: Interval, places: int) -> dict[str, str]:
    return bounds((value.inf, value.sup), places)


# -- arguments and text ----------------------------------------------------------------------------


def _epsilon(text: str) -> Fraction:
    value = number(text)
    if not 0 <= value < 1:
        raise ArgumentTypeError(f"epsilon is in [0, 1), not {text[:20]!r}")
    return value


def _positive(text: str) -> Fraction:
    value = number(text)
    if value <= 0:
        raise ArgumentTypeError(f"rho is positive, not {text[:20]!r}")
    return value


def _open(part: object) -> bool:
    """Whether something in an answer is null."""
    parts = part.values() if isinstance(part, dict) else part if isinstance(part, list) else ()
    return part is None or any(map(_open, parts))


def _text(answer: Answer) -> str:
    springs = "the limit of soft springs" if answer["k"] == "0" else f"q = {answer['q']}"
    said = [f"m = {answer['m']}, epsilon = {answer['epsilon']}, k = {answer['k']}, {springs}"]
    said += [f"saddle-node of two fixed points: {_whether(answer['saddle_node'])}"]
    said += _named(answer, ("rho_saddle_node", "height_least", "rho_graze", "epsilon_least"))
    if "flip" in answer:
        said += [f"a supercritical period doubling: {_whether(answer['flip'])}"]
        at_flip = ("rho_flip", "psi", "rise", "cubic", "f2_psi_rho", "f2_psi_psi_psi")
        said += _named(answer, at_flip) + _matrix(answer["flip"])
    else:
        said.append("no fixed point has the eigenvalue -1")
    for rho, motions in answer["at"].items():
        said.append(f"rho = {rho}: {len(motions) or 'no'} motion{'s' * (len(motions) != 1)}")
        for each in motions:
            said += [f" period {len(each['impacts'])}: {_stability(each)}", *_impacts(each)]
    for each in answer.get("followed", ()):
        phases = ", ".join(_short(impact["psi"]) for impact in each["impacts"])
        said.append(f"period 2, rho {_short(each['rho'])}, psi {phases}: {_stability(each)}")
    return "\n".join(said)


def _named(answer: Answer, names: Iterable[str]) -> list[str]:
    return [line for name in names if name in answer for line in lines(name, answer[name], 15)]


def _whether(motion: Answer) -> str:
    kind = {True: "an orbit", False: "no orbit", None: "undecided"}[motion["orbit"]]
    return f"{kind} ({motion['reason']})"


def _stability(motion: Answer) -> str:
    words = {True: "attracting", False: "not attracting", None: "stability undecided"}
    return f"{_whether(motion)}, {words[motion['attracting']]}"


def _short(ends: dict[str, str]) -> str:
    return between((Fraction(ends["lower"]), Fraction(ends["upper"])))


def _impacts(motion: Answer) -> list[str]:
    return [
        line
        for impact in motion["impacts"]
        for name, ends in impact.items()
        for line in lines(name, ends, 15)
    ]


def _matrix(motion: Answer) -> list[str]:
    cells = [
        (f"J{i + 1}{j + 1}", entry)
        for i, row in enumerate(motion["jacobian"])
        for j, entry in enumerate(row)
    ]
    cells += [("eigenvalue", each) for each in motion["eigenvalues"]]
    return [line for name, ends in cells for line in lines(name, ends, 15)]

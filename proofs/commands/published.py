"""Published systems and maps: proves what is asked of each, and writes its page and the index.

Certificates that are there are kept, as the checker concludes them again; --fresh proves anew.
Writes reports/systems and docs/systems.md.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.published")

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from intervals import Undecided
from proofs import Map, System
from proofs.commands.published_page import FOLDER, INDEX, Published, index, page, picture, theorem
from proofs.shell.cli import Parser, progress
from proofs.shell.files import write_files
from proofs.shell.screen import say
from proofs.theorem import Theorem
from proofs.trusted.certificate import Malformed
from proofs.trusted.kernel.cycle import PeriodicOrbit
from proofs.trusted.verify import Rejected

_BILLIARD = [f"orbits-2-{k}" for k in range(1, 9)]  # each within the checker's default of work

EPILOG = """\
exit status: 0 written; 2 a certificate is wrong, or something is not proved any more

examples:
  python -m proofs published            what is there is checked, pages are written
  python -m proofs published --fresh    everything is proved again
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the pages; return the exit status."""
    parser = Parser("proofs published", __doc__, EPILOG)
    parser.add_argument("--fresh", action="store_true", help="prove all of it again")
    options = parser.parse_args(arguments)
    pages: list[tuple[Published, dict[str, Theorem]]] = []
    with progress() as tell:
        for each in published():
            tell(each.name)
            try:
                pages.append((each, proved(each, FOLDER, options.fresh)))
            except (Malformed, Rejected, Undecided, OSError) as error:
                parser.error(f"{each.name}: {error}")
    for each, theorems in pages:
        files = {f"{each.name}.md": page(each, theorems)}
        files[f"{each.name}/portrait.svg"] = picture(each, theorems)
        write_files(FOLDER, files)
    write_files(INDEX.parent, {INDEX.name: index(pages)})
    say(f"{len(pages)} pages in {FOLDER}, {INDEX}")
    return 0


def proved(of: Published, folder: Path, fresh: bool) -> dict[str, Theorem]:
    """Return the theorems about a system, from its certificates; they are made where missing."""
    theorems = {}
    for name, prove in of.asked.items():
        file = folder / of.name / f"{name}.json"
        if fresh or not file.exists():
            write_files(file.parent, {file.name: prove().certificate})
        theorems[name] = theorem(file)
    return theorems


def published() -> list[Published]:
    """Return what is published, systems first."""
    return [*_systems(), *_maps()]


def _systems() -> list[Published]:
    ball = System.example("bouncing-ball")
    near = System.example("bouncing-ball", e=["0.4999", "0.5001"])
    slow = System.example("bouncing-ball", g="0.3", e="0.1")
    hardly = {"e": ["0.499", "0.501"], "g": ["0.0999", "0.1001"]}
    chaotic = System.example("bouncing-ball", **hardly)
    calm = System.example("bouncing-ball", e=["0.498", "0.502"], g=["0.798", "0.802"])
    billiard = System.example("billiard")
    inelastic = System.example("billiard", e="0.95")
    lossy = System.example("billiard", a="2", e="0.8")
    fermi, gears = System.example("fermi-ulam"), System.example("gear-rattle")
    wall, soft = System.example("wall"), System.example("wall", w="2")
    resonant = {"d": ("0", "0.6"), "w": ("1.95", "2.05")}  # 2 is twice the wall's own frequency
    return [
        _of(
            "bouncing-ball",
            ball,
            {
                "impact": lambda: ball.impact(phi="1.02", v="1.57"),
                "orbits-1": lambda: ball.orbits(1),
                "orbits-2": lambda: ball.orbits(2),
                "orbits-1-range": lambda: near.orbits(1),
                "stable": slow.stable,
                "horseshoe": ball.horseshoe,
                "stable-range": lambda: calm.stable(1),
                "horseshoe-range": chaotic.horseshoe,
                "branches": lambda: calm.branches(g=("0.7", "0.9")),
                "folds": lambda: calm.folds(g=("0.6", "1"), e=("0.45", "0.5")),
                "flips": lambda: calm.flips(g=("0.3", "0.9"), e=("0.45", "0.46")),
            },
            [
                'Vogel and Linz (2011) write in their abstract: "Using extensive numerical '
                "simulations, we address the not yet conclusively settled problem of the "
                'occurrence of chaos in the partially elastic case". The theorem with restitution '
                "1/2 settles that there is an invariant set on which the exact map is chaotic. It "
                "is no attractor, and the theorem says nothing about what most motions do.",
            ],
            ["that the points of `folds` and `flips` are bifurcations: their normal forms"],
        ),
        _of(
            "billiard",
            billiard,
            {
                **{name: partial(_again, billiard, name) for name in _BILLIARD},
                "orbits-2-lossy": lambda: _again(inelastic, *_BILLIARD[:2]),
                "first-impact": lambda: lossy.impact(
                    s=("0.770007346", "0.770007348"),
                    x=("-0.000000001", "0.000000001"),
                    v=("-0.000000001", "0.000000001"),
                    w=("-6.373271422", "-6.373271420"),
                ),
            },
            [
                "Church and Fortin prove by interval arithmetic, in their abstract's words, "
                '"the existence of 608 isolated periodic orbits". The abstract does not say of '
                "which parameters they are, and the article could not be had. The authors' public "
                "repository lists orbits of two impacts in seven tables, 3504 rows.",
                "A comparison made once in floating point, no part of the theorems. The table for "
                "(a, e, b) = (1, 1, 1) has 824 rows. A row is one impact, so that most orbits are "
                "in it twice: 812 rows are impacts of the 432 orbits proved here. Nine rows are "
                "orbits with one impact a period, gone through twice. Three, of balls that bounce "
                "on the axis at more than 20 a second, are not proved: their multipliers are too "
                "large for the numbers with which the search begins.",
                'The table titled "(2, 0.89, 1)" solves the equations with restitution 0.80, and '
                'not with 0.89. In the one titled "(2, 0.80, 1)" five rows, the first among them, '
                "are no orbits of the billiard: an impact comes before the one in the table. The "
                "theorem about the next impact is about all states that round to the first row, "
                "whose next impact is to come after the time 0.476728220; the last of the values "
                "is the time. The orbits with restitution 0.95 are in none of the tables.",
            ],
            ["their branches of orbits, continued in the amplitude"],
        ),
        _of(
            "fermi-ulam",
            fermi,
            {
                "orbits-1": lambda: fermi.orbits(1),
                "orbits-2": lambda: fermi.orbits(2),
                "horseshoe": fermi.horseshoe,
            },
            [
                'Leonel, McClintock and da Silva (arXiv nlin/0406056) summarise: "(ii) it presents '
                "a set of invariant spanning curves in the phase space for high energy; (iii) a "
                "set of KAM islands surrounded by a chaotic sea can be observed in the low energy "
                'regime". The horseshoe is a compact invariant set in that regime, for the '
                "complete model.",
            ],
            ["that all velocities stay bounded: no invariant curve is proved"],
        ),
        _of(
            "gear-rattle",
            gears,
            {"orbits-1": lambda: gears.orbits(1)},
            [
                "Mason and Piiroinen (2009) report, in their abstract's words, \"an interval of "
                'robust chaos in between the codimension-two points". Their equations and '
                "parameters could not be had, so that nothing here speaks of that interval. All "
                "orbits below hit both sides of the backlash in turn.",
            ],
            ["their parameters, and robust chaos", "a horseshoe: none is found"],
        ),
        _of(
            "wall",
            wall,
            {
                "orbits-1": lambda: wall.orbits(1),
                "orbits-2": lambda: wall.orbits(2),
                "stable": soft.stable,
                "grazing": lambda: wall.grazing(**resonant),
                "folds": lambda: wall.folds(d=("0", "0.6"), w=("1.95", "1.99")),
                "flips": lambda: wall.flips(d=("0", "0.6"), w=("2.7", "2.9")),
                "touching": lambda: wall.touching(v=("-1", "0"), a=("0.3", "0.4")),
            },
            [
                "Simpson and Ghosh (2026) prove that the curves of saddle-node and of "
                "period-doubling bifurcations of motions with one impact a period are "
                '"quadratically tangent to the curve of grazing bifurcations" at resonance.',
            ],
            ["that the curves of `grazing` and `folds` are tangent, and where"],
        ),
        *_flows(),
    ]


def _flows() -> list[Published]:
    """Return the systems whose flow has no closed form."""
    roessler, lorenz = System.example("roessler"), System.example("lorenz")
    oscillator, duffing = System.example("van-der-pol"), System.example("duffing-wall")
    patient = System.example("roessler")
    patient.effort = 5  # a box takes a fifth of a second
    stiff = System.example("van-der-pol", m="2")
    return [
        _of(
            "roessler",
            roessler,
            {
                "orbits-1": lambda: roessler.orbits(1),
                "orbits-2": lambda: roessler.orbits(2),
                "orbits-3": lambda: roessler.orbits(3),
                "horseshoe": patient.horseshoe,
                "trapping": lambda: roessler.trapping(p=("-10.8", "-2.2"), q=("0.027", "0.035")),
            },
            [
                "The map is the first return to the half plane x = 0, x rising. In the direction "
                "that contracts a turn takes distances to 10^-11 of themselves or less. The "
                "checker derives the horseshoe again with `--work 16000000`, in some 20 seconds.",
            ],
            [
                "that there are no other orbits of these periods",
                "that motions in the attractor are chaotic: the horseshoe is a part of it",
            ],
        ),
        _of(
            "lorenz",
            lorenz,
            {"orbits-2": lambda: lorenz.orbits(2), "orbits-3": lambda: lorenz.orbits(3)},
            [
                "Periodic orbits are called by words in A and B in the literature, for turns about "
                "the two outer equilibria. As floating point sees them, the orbit of period 2 is "
                "AB, those of period 3 are AAB and ABB.",
            ],
            ["that there are no other orbits of these periods", "an attractor"],
        ),
        _of(
            "van-der-pol",
            oscillator,
            {"stable": lambda: oscillator.stable(1), "stable-2": lambda: stiff.stable(1)},
            ["For each damping m > 0 there is exactly one limit cycle, by Lienard's theorem."],
            ["that all other motions but rest come to it"],
        ),
        _of(
            "duffing-wall",
            duffing,
            {
                "impact": lambda: duffing.impact(a="3.3", v="1.1"),
                "stable": lambda: duffing.stable(1),
            },
            ["The system is this file's: a hardening spring, a harmonic force, a wall at rest."],
            ["orbits that hit the wall more than once a period", "a horseshoe: none is found"],
        ),
    ]


def _maps() -> list[Published]:
    henon = Map("1 - 1.4*x^2 + y", "0.3*x")
    logistic, window = Map("r*x*(1 - x)", r="5"), Map("r*x*(1 - x)", r="3.83")
    turned = {"x": "2*pi", "y": "2*pi"}
    standard = Map("x + k*sin(y)", "x + y + k*sin(y)", k="6", periods=turned)
    circle = Map("x + w + k*sin(2*pi*x)/(2*pi)", w="0.5", k="0.9", periods={"x": "1"})
    unit = {"x": ("0", "1")}
    square = {"x": ("-1.5", "1.5"), "y": ("-0.5", "0.5")}
    logistic.box, henon.box = dict(unit), dict(square)
    return [
        Published(
            "logistic",
            "Logistic map",
            "R. M. May, Nature 261 (1976); its text could not be had",
            logistic,
            {
                "periodic-orbits": lambda: logistic.periodic_orbits(6, {"x": ("-0.1", "1.1")}),
                "horseshoe": lambda: logistic.horseshoe(unit),
                "stable": lambda: window.stable(box=unit),
            },
            [
                "For r > 4 the map is conjugate to the full shift on two symbols where orbits "
                "stay: it has 2, 1, 2 and 9 orbits of the least periods 1, 2, 3 and 6, by counting "
                "words."
            ],
        ),
        Published(
            "henon",
            "Henon map",
            "M. Henon, A two-dimensional mapping with a strange attractor, Comm. Math. Phys. 50 "
            "(1976); Z. Galias, Int. J. Bifurcation Chaos 11 (2001): their texts could not be had",
            henon,
            {
                "periodic-orbits": lambda: henon.periodic_orbits(6, square),
                "horseshoe": lambda: henon.horseshoe(longest=7),
            },
            [
                "That all orbits of low periods are counted by interval methods goes back to "
                "Galias (2001); his numbers are not repeated here, for want of his text."
            ],
        ),
        Published(
            "standard",
            "Standard map",
            "B. V. Chirikov, Phys. Rep. 52 (1979): its text could not be had",
            standard,
            {"orbits-1": lambda: standard.orbits(1), "horseshoe": standard.horseshoe},
            ["The traces at (0, 0) and (0, pi) are 2 + k and 2 - k: for k > 4 both are saddles."],
        ),
        Published(
            "circle",
            "Circle map",
            "V. I. Arnold, Transl. Amer. Math. Soc. 46 (1965): its text could not be had",
            circle,
            {"orbits-2": lambda: circle.orbits(2)},
            [
                "In the tongue of the rotation number 1/2 one orbit of period 2 attracts, one "
                "repels."
            ],
        ),
    ]


def _of(
    name: str,
    system: System,
    asked: Mapping[str, Callable[[], Theorem]],
    beside: Sequence[str],
    omitted: Sequence[str] = (),
) -> Published:
    return Published(name, system.title, system.notes["source"], system, asked, beside, omitted)


def _again(billiard: System, *names: str) -> Theorem:
    """Prove the orbits of period 2 next to those of certificates, to some decimals."""
    known = [each for name in names for each in theorem(FOLDER / f"billiard/{name}.json")]
    boxes = [each.box for each in known if isinstance(each, PeriodicOrbit)]
    middles = [[f"{float(sum(side)) / 2:.12f}" for side in box] for box in boxes]
    return billiard.orbits(2, near=[dict(zip("sxvw", x, strict=True)) for x in middles])

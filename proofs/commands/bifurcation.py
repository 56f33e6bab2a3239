"""Bifurcations of fixed points of a map of your own: Jacobian, conditions, normal forms, proved.

The map is given by an equation for each of its one or two variables; x1 is the image of x, and the
equations may be implicit. Every other name is a parameter. sympy differentiates and solves: for a
fold (saddle-node), a flip (period doubling) and a Neimark-Sacker bifurcation it gives the
condition, and, where it finds them in closed form, the fixed point, a parameter and the
coefficients of the normal form (Kuznetsov's a, c and a). With --near they are enclosed at exact
numbers instead. All of it is written as lemmas, which the checker derives again: sympy is not
trusted.
"""

from __future__ import annotations

if __name__ == "__main__":
    from proofs.shell.entry import launch

    launch("proofs.commands.bifurcation")

import sys
from argparse import ArgumentTypeError, Namespace
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from intervals import IntervalError, Undecided
from proofs.methods import derive
from proofs.methods.bifurcation.certify import Enclosed, enclosure, prove_jacobian
from proofs.methods.bifurcation.classify import meaning
from proofs.methods.bifurcation.closed import Closed, closed
from proofs.methods.bifurcation.maps import Map
from proofs.methods.bifurcation.normal_forms import KINDS, NormalForm
from proofs.methods.grammar import name as spelled
from proofs.methods.lemmas import Lemmas
from proofs.shell.answers import Answer, add_answer, answering, bounds, give, lines
from proofs.shell.cli import Parser, number, progress
from proofs.shell.files import check_folder, refusing, writing
from proofs.shell.screen import say
from proofs.trusted.files import render
from proofs.trusted.kernel.meter import Exhausted
from proofs.trusted.verify import Rejected, check

EPILOG = """\
Formulas and names are those of `python -m proofs system`; e is none of the names. An argument @FILE
is replaced by the lines of the file. Each candidate, a fixed point at which a multiplier is 1 or -1
or two have the product 1, is classified: fold, transcritical, pitchfork, flip, neimark_sacker,
resonance 1:k; what is degenerate, or none, is listed as dropped, with the reason. What decides is
told where it stands, "critical" of the normal form, "speed" of the parameter, and what their signs
mean; where it depends on other parameters, under which conditions; "root" and "root2" are
parameters, too, where a closed form has roots of parameters. Other bifurcations than those in
closed form may exist.

exit status: 0 done and checked, 1 a bifurcation that was asked for is not found, or what sympy
             finds is not derived by the checker, 2 bad input, 3 the checker disagrees (a bug)

examples:
  python -m proofs bifurcation "x1 = r*x*(1 - x)"
  python -m proofs bifurcation "x1 = 1 - a*x^2 + y" "y1 = b*x" --kind flip
  python -m proofs bifurcation "x1 = 1 - a*x^2 + y" "y1 = b*x" --kind flip \\
         --set b=0.3 --near x=1,y=0.3,a=0.4 --digits 50
  python -m proofs bifurcation "phi1 = phi + v - 2*pi*n" "v1 = alpha*v - g*cos(phi1)" \\
         --kind flip --solve v,g,n                       the bouncing ball
  python -m proofs bifurcation "x1 = r*x*(1 - y)" "y1 = x" --kind neimark_sacker --out lemmas
"""


def main(arguments: list[str] | None = None) -> int:
    """Derive the bifurcations of a map; return the exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.out is not None:
        check_folder(parser, options.out)
    try:
        map_ = Map.read(*options.equations).with_numbers(
            **{name: f"({value})" for name, value in options.set.items()}
        )
        _ = map_.jacobian, map_.jacobian_at_rest
        forms = {kind: NormalForm(map_, kind) for kind in _kinds(map_, options)}
        names = _names(map_, options)
    except ValueError as error:
        parser.error(str(error))
    with answering(parser, options):
        return _answer(parser, options, forms, names)


def _parser() -> Parser:
    parser = Parser("proofs bifurcation", __doc__, EPILOG)
    parser.fromfile_prefix_chars = "@"
    add = parser.add_argument
    add("equations", nargs="+", metavar="EQUATION", help='such as "x1 = r*x*(1 - x)"')
    add("--kind", action="append", choices=KINDS, help="which bifurcation (default: all)")
    solve = "names to solve for, one more than variables (default: these and the first parameter)"
    add("--solve", metavar="NAME,...", help=solve)
    add("--set", type=_numbers, default={}, metavar="NAME=NUMBER,...", help="exact parameters")
    near = "enclose the bifurcation near these numbers for the variables and the parameter left"
    add("--near", type=_numbers, metavar="NAME=NUMBER,...", help=near)
    add("--out", type=Path, metavar="DIR", help="write the lemmas to DIR/bifurcation.json")
    add_answer(parser)
    return parser


def _numbers(text: str) -> dict[str, Fraction]:
    numbers = {}
    for each in text.split(","):
        typed, equals, value = each.partition("=")
        if not equals or not typed.strip().isidentifier() or spelled(typed.strip()) in numbers:
            raise ArgumentTypeError(f"NAME=NUMBER is expected, once a name, not {each[:30]!r}")
        numbers[spelled(typed.strip())] = number(value.strip())
    return numbers


def _kinds(map_: Map, options: Namespace) -> list[str]:
    possible = KINDS if len(map_.state) == 2 else KINDS[:2]
    return options.kind or [*possible]


def _names(map_: Map, options: Namespace) -> tuple[str, ...]:
    """Return what is solved for: the variables, then a parameter; with --near its names."""
    if options.near is not None:
        if len(options.kind or ()) != 1:
            raise ValueError("--near is about one bifurcation: --kind KIND")
        if {*options.near} != {*map_.state, *map_.parameters} or len(map_.parameters) != 1:
            wanted = ", ".join((*map_.state, "one parameter"))
            raise ValueError(f"--near has numbers for {wanted}, --set for all other parameters")
        return (*map_.state, *map_.parameters)
    if options.solve:
        names = tuple(spelled(each.strip()) for each in options.solve.split(","))
    else:
        names = (*map_.state, *map_.parameters[:1])
    if len(set(names)) != len(map_.state) + 1 or not {*names} <= {*map_.state, *map_.parameters}:
        raise ValueError(f"{len(map_.state) + 1} names of variables and parameters are solved for")
    return names


def _answer(
    parser: Parser, options: Namespace, forms: Mapping[str, NormalForm], names: tuple[str, ...]
) -> int:
    """Derive, check and print; return the exit status."""
    file, missing = Lemmas(), list[str]()
    map_ = next(iter(forms.values())).map
    answer = _map_form(map_)
    try:
        prove_jacobian(file, map_)
    except Undecided as failure:
        say(f"{parser.prog}: undecided: the Jacobian: {failure}", sys.stderr)
        return 1
    with progress() as tell:
        for kind, form in forms.items():
            tell(kind)
            entry: Answer = {"condition": _formula(derive.read(form.condition()))}
            answer["bifurcations"][kind] = entry
            try:
                if options.near is not None:
                    enclosed = enclosure(file, form, names[-1], options.near, options.digits)
                    entry["enclosed"] = _enclosed_form(enclosed, options.digits)
                else:
                    entry |= _candidates(file, form, names)
                    if reason := _not_found(entry):
                        missing.append(f"{kind}: {reason}")
            except (Undecided, IntervalError, OverflowError) as failure:
                missing.append(f"undecided: {kind}: {failure}")
                entry["undecided"] = str(failure)
        tell("the check")
        source = render(file.document())
        try:
            answer["checked"] = list(check(source).sentences)
        except (Rejected, Exhausted) as error:
            say(f"{parser.prog}: the checker disagrees: {error}", sys.stderr)
            return 3
    if options.out is not None:
        with refusing(parser, options.out), writing(options.out) as put:
            put("bifurcation.json", source)
    give(parser, options, answer, _text)
    for each in missing if options.kind or options.near else []:
        say(f"{parser.prog}: {each}", sys.stderr)
    return int(bool(missing and (options.kind or options.near)))


def _candidates(file: Lemmas, form: NormalForm, names: tuple[str, ...]) -> Answer:
    """Return what is found of a condition, and what is dropped."""
    if derive.simplest(derive.read(form.condition())).is_nonzero:
        return {"closed": [], "dropped": []}
    parameter = next(x for x in names if x not in form.map.state)
    candidates = closed(file, form, names)
    forms = [_closed_form(each, parameter, len(form.map.state) == 2) for each in candidates]
    pairs = list(zip(forms, candidates, strict=True))
    return {
        "closed": [each for each, candidate in pairs if candidate.kept],
        "dropped": [each for each, candidate in pairs if not candidate.kept],
    }


def _not_found(entry: Answer) -> str:
    """Say why there is no bifurcation of a condition; "" if there is one."""
    if entry["closed"]:
        return ""
    reasons = (f"{each['kind']}: {each['why']}" for each in entry["dropped"])
    return "; ".join(reasons) or "the condition is met nowhere"


# -- the machine form ------------------------------------------------------------------------------


def _formula(expression: Any) -> dict[str, str]:
    import sympy

    simple = derive.simplest(expression)
    return {"formula": derive.write(simple), "latex": sympy.latex(simple)}


def _map_form(map_: Map) -> Answer:
    """Return the map, its Jacobian and what holds at fixed points."""
    matrix = map_.jacobian
    return {
        "variables": list(map_.state),
        "parameters": list(map_.parameters),
        "equations": [_formula(derive.read(each)) for each in map_.equations],
        "fixed_points": [_formula(derive.read(each)) for each in map_.fixed],
        "jacobian": [[_formula(entry) for entry in row] for row in matrix.tolist()],
        "trace": _formula(map_.jacobian_at_rest.trace()),
        "determinant": _formula(map_.jacobian_at_rest.det()),
        "bifurcations": {},
    }


def _closed_form(candidate: Closed, parameter: str, plane: bool) -> Answer:
    return {
        "kind": candidate.what.kind,
        "why": candidate.what.why,
        "where": list(candidate.what.where),
        "values": {name: _formula(value) for name, value in candidate.values.items()},
        "meaning": dict(meaning(candidate.what.kind, parameter, plane, candidate.signs.get)),
    }


def _enclosed_form(enclosed: Enclosed, digits: int) -> Answer:
    values = {**enclosed.box, "critical": enclosed.critical, "speed": enclosed.speed}
    values["determinant"] = enclosed.determinant
    ends = {name: bounds(each, digits) for name, each in values.items()}
    plane = len(enclosed.form.map.state) == 2
    meanings = dict(meaning(enclosed.form.kind, enclosed.parameter, plane, enclosed.signs.get))
    return {**ends, "says": enclosed.says, "meaning": meanings}


def _place(answer: Answer, candidate: Answer) -> str:
    """Write the fixed point and the parameter of a candidate."""
    own = (*answer["variables"], *answer["parameters"])
    places = {x: candidate["values"][x]["formula"] for x in own if x in candidate["values"]}
    return ", ".join(f"{name} = {value}" for name, value in places.items())


def _told(answer: Answer, candidate: Answer) -> list[str]:
    """Write a bifurcation: where, the numbers that decide with what they mean, the others."""
    why = f": {candidate['why']}" if candidate["why"] else ""
    said = [f"  {candidate['kind']} at {_place(answer, candidate)}{why}"]
    values = {name: value["formula"] for name, value in candidate["values"].items()}
    for name in dict.fromkeys((*candidate["meaning"], "critical", "speed", "trace", "determinant")):
        if name in values:
            says = candidate["meaning"].get(name, "")
            said.append(f"    {name} = {values[name]}{says and f': {says}'}")
    if candidate["where"]:
        said.append(f"    where {', '.join(candidate['where'])}")
    return said


def _text(answer: Answer) -> str:
    """Write the answer for the screen."""
    rows = [" ".join(f"{entry['formula']}," for entry in row)[:-1] for row in answer["jacobian"]]
    said = [
        f"variables {', '.join(answer['variables'])}; parameters "
        f"{', '.join(answer['parameters']) or 'none'}",
        *(f"  0 = {each['formula']}" for each in answer["equations"]),
        "Jacobian, rows",
        *(f"  {row}" for row in rows),
        f"at fixed points: trace {answer['trace']['formula']}, "
        f"determinant {answer['determinant']['formula']}",
    ]
    for kind, entry in answer["bifurcations"].items():
        said.append(f"{kind}: 0 = {entry['condition']['formula']}")
        for each in entry.get("closed", ()):
            said += _told(answer, each)
        if entry.get("closed") == entry.get("dropped") == []:
            said.append("  none: the condition is met nowhere")
        for each in entry.get("dropped", ()):
            said.append(f"  dropped: {_place(answer, each)}: {each['kind']}: {each['why']}")
        enclosed = entry.get("enclosed", {})
        for name, value in enclosed.items():
            if name == "says":
                said.append(f"  {value}")
            elif name != "meaning":
                said += lines(name, value, 12)
        said += [f"    {name}: {says}" for name, says in enclosed.get("meaning", {}).items()]
        if "undecided" in entry:
            said.append(f"  undecided: {entry['undecided']}")
    said.append(f"{len(answer['checked'])} lemmas, derived again by the checker")
    return "\n".join(said)

"""Where the tests get conclusions from: committed certificates, lemmas, provers, the checker.

The only part of these tests, beside the names in `judge`, that touches the project.
"""

import importlib
import json
import pkgutil
import random
import re
from dataclasses import replace
from fractions import Fraction

from tests import once as made_once
from tests.once import REPORTS, once, report


def _parts(document):
    """A document without texts: its parts, and the steps that each claim rests on."""
    claims = (each for each in document["claims"] if isinstance(each, dict))
    kept = {name: document[name] for name in ("parameters", "functions", "steps")}
    return {**kept, "proofs": {claim["id"]: claim["proof"] for claim in claims}}


def committed(name):
    """The parts of a committed certificate."""
    return _parts(json.loads((REPORTS / f"{name}.json").read_text()))


def others():
    """By name the parts of files that decide no claims: lemma examples, systems, atlases.

    No judge takes derivatives by the variables of a flight, which folds and flips are made of.
    """
    from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

    yield from ((f"lemma {name}", _parts(json.loads(text(name)))) for name in EXAMPLES)
    for name, made in made_once.committed().items():
        if "/" in name and not re.search("orbits-2-[^1]|folds|flips", name):  # like the first
            yield name, _parts(json.loads(made))
    yield from ((f"box: {name}", _parts(json.loads(made))) for name, made in about_boxes().items())
    bare = {"parameters": None, "functions": {}, "proofs": {}}
    yield "curves", {**bare, "steps": curves()}
    for name, (function, witness) in images_of_flows().items():
        steps = {"image-1": {"rule": "image", "witness": {"function": "P", **witness}}}
        yield f"flow {name}", {**bare, "functions": {"P": function}, "steps": steps}


def images_of_flows():
    """By name a flow, and the witness of where it takes a small box."""
    from proofs.trusted.certificate import Reader
    from proofs.trusted.kernel.composition import read_map
    from proofs.trusted.kernel.enclose import enclosed
    from tests.proofs.trusted.kernel.flows import FLOWS, box_of

    made = {}
    for name, example in FLOWS.items():
        box = box_of(example, random.Random(name))
        values = read_map("P", Reader(example.data), {}).values(enclosed(box, 100))
        box, bounds = ([[str(x) for x in y] for y in z] for z in (box, [x.range for x in values]))
        made[name] = example.data, {"box": box, "tree": None, "bounds": bounds}
    return made


def certificates():
    """The names of the committed certificates."""
    paths = sorted(REPORTS.glob("*.json"))
    return [path.stem for path in paths if "steps" in json.loads(path.read_text())]


def proved(group, eta, nu, epsilon="1/100"):
    """The parts of what the prover of a group finds at other parameters."""
    from proofs.shell.groups import produce
    from proofs.trusted.paper import BEYOND, GROUPS
    from proofs.trusted.parameters import PAPER

    of = replace(PAPER, eta=Fraction(eta), nu=Fraction(nu), epsilon=Fraction(epsilon))
    return _parts(
        json.loads(produce({group: {**GROUPS, **BEYOND}[group]}, of, digits=20).certificate)
    )


def conclusions(made):
    """The parameters and the conclusions of all steps by name, as the checker derives them."""
    from proofs.trusted import verify
    from proofs.trusted.certificate import Reader, subject_from_json
    from proofs.trusted.kernel.composition import read_map
    from proofs.trusted.kernel.context import Context

    context = Context(subject_from_json(Reader(made["parameters"])))
    for name, each in made["functions"].items():
        context.functions[name] = read_map(name, Reader(each), context.functions)
    verify.derive(context, Reader(made["steps"]))
    return context.parameters, context.known


@once
def curves(epsilon="0", n=2):
    """The steps about a part of the last curve of grazing that the prover sees."""
    from proofs.search.curves import Curves, seen_curves

    made = Curves(Fraction(epsilon))
    made.grazing(n, [x for x in seen_curves(n, Fraction(epsilon))[-1] if 1.41 < x.eta < 1.45])
    return made.derivation.steps


def about_curves():
    """The conclusions of these steps."""
    made = {"parameters": None, "functions": {}, "steps": curves()}
    return tuple(conclusions(made)[1].values())


def committed_conclusions(name):
    """The same of a committed certificate."""
    context = report(name).context
    return context.of, context.known


def rows(made, claims, of, known):
    """For each claim its id, its verdict, and the conclusions that decide it or correct it."""
    from proofs.trusted import paper

    for claim in claims:
        found = paper.find(claim).decide(of, [known[name] for name in made["proofs"][claim]])
        yield claim, found.verdict.value, (*found.because, *found.corrected)


@once
def committed_rows(name):
    """The same of a committed certificate."""
    made, (of, known) = committed(name), committed_conclusions(name)
    return of, list(rows(made, made["proofs"], of, known))


def lemmas():
    """The conclusions of the lemma examples, by example and step."""
    from proofs.trusted.verify import premises
    from tests.proofs.trusted.kernel.lemma_examples import EXAMPLES, text

    for name in EXAMPLES:
        yield from ((f"{name}.{key}", x) for key, x in premises(text(name)).known.items())


def boxes():
    """The conclusions about boxes of oscillators, by step."""
    from proofs.trusted.verify import premises

    for name, made in about_boxes().items():
        yield from ((f"{name} {x}", one) for x, one in premises(made).known.items())


def about_boxes():
    """Certificates about boxes of oscillators, by name."""
    from proofs.plane import horseshoe, settling, singles
    from proofs.trusted.parameters import Place

    full, short, stable, single, none, back, late, zero = (
        Place(*(tuple(map(Fraction, side)) for side in sides))
        for sides in (
            (("0.2119", "0.2122"), ("-0.2004", "-0.1996")),
            (("0.3", "0.302"), ("0.19", "0.192")),
            (("0.237", "0.2372"), ("0.3", "0.3002")),
            (("0.6", "0.6002"), ("-0.75", "-0.7498"), ("0.3", "0.3")),
            (("1.3", "1.3002"), ("-0.7", "-0.6998"), ("0.3", "0.31")),
            (("0.2378", "0.2382"), ("-0.2059", "-0.2055")),
            (("0.2213", "0.2217"), ("-0.1843", "-0.1839")),
            (("0.2655", "0.2661"), ("-0.1978", "-0.1972")),
        )
    )
    made = {
        "full": next(horseshoe.propose(full, []))[0],
        "sticking": next(settling.propose(full)),
        "all stick": settling.settles(short),
        "stable": next(settling.propose(stable)),
        "short single": singles.propose(stable, 3),
        "single": singles.propose(single, 2),
        "no single": singles.propose(none, 5),
        "back": settling.sticks(back),
        "late": settling.sticks(late),
        "zero": settling.stays_stable(zero),
    }
    return {name: steps.certificate() for name, steps in made.items()}


def classes():
    """The names of all classes of conclusions that say something; tests may have their own."""
    import proofs.trusted
    from proofs.trusted.kernel.conclusion import Conclusion

    for info in pkgutil.walk_packages(proofs.trusted.__path__, "proofs.trusted."):
        importlib.import_module(info.name)
    found, waiting = set(), [Conclusion]
    while waiting:
        inner = [
            one
            for one in waiting.pop().__subclasses__()
            if one.__module__.startswith("proofs.trusted.")
        ]
        found |= {
            one.__name__ for one in inner if "sentence" in vars(one) or not one.__subclasses__()
        }
        waiting += inner
    return found

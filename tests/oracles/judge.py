"""`oracle(conclusion, rng, of)`: complaints about a conclusion, by what shares nothing with it.

The judge of a class of conclusions is the function of its name in one of the modules. It gets a
plain record: `view(conclusion, of)` has the fields of a conclusion, numbers, texts and tuples
alone, and the parameters eta, nu, epsilon, box that it is about: its own, else those of the
document, `of`. Where a class or a field is renamed, the judges that are named like it are all that
changes.
"""

import re
from dataclasses import fields, is_dataclass
from fractions import Fraction
from types import SimpleNamespace

from tests.oracles import (
    beyond,
    circle,
    curves,
    flights,
    formulas,
    kernel,
    laps,
    lines,
    planar,
    plastic,
    restitution,
    sets,
    single,
)

MODULES = (
    *(plastic, sets, circle, laps, restitution, single, formulas, kernel, beyond),
    *(curves, flights),
)
OTHER_NAMES = {
    "Impact": plastic.point,
    "Graze": flights.graze,
    "Separation": circle.separation_arc,
    "Between": laps.narrow,
    "Uncovered": sets.exact_measure,  # of which it is a consequence of the names alone
}


def judge_of(kind):
    """The judge of a class; None if there is none."""
    name = re.sub("(?<!^)(?=[A-Z])", "_", kind).lower()
    named = (getattr(module, name, None) for module in MODULES)
    return OTHER_NAMES.get(kind) or next(filter(callable, named), None)


def judge(record, rng):
    """Complaints about a record that `view` made."""
    own = planar.is_of_a_file(getattr(record, "base", record)) and lines.JUDGES.get(record.kind)
    return (own or judge_of(record.kind))(record, rng)


def oracle(conclusion, rng, of=None):
    """Complaints about a conclusion; of: the document's parameters, if it carries none itself."""
    return judge(view(conclusion, of, rng.choice((0, 1, Fraction(1, 3)))), rng)


# -- conclusions as plain records ------------------------------------------------------------------


_BLIND = {
    "tape",
    "roots",
    "parts",
    "placer",
    "work",
    "_known",
    "_last",
    "_taken",
    "_proved",
}  # the checker's machinery inside of conclusions
_MORE = {  # properties that sentences or rows rest on
    "Rectangle": ("parts",),
    "Separation": ("returns",),
    "EntropyBound": ("entropy",),
    "Between": ("images", "full"),
    "Branch": ("phases",),
    "Cycles": ("counts",),
    "EntropyRange": ("entropy",),
    "Pieces": ("region",),
    "ThinShift": ("rate",),
    "StayingSet": ("growth", "fixed_points", "orbit", "expansion"),
    "Digits": ("readings",),
    "Excess": ("level",),
    "LinearDimension": ("measure",),
    "Itinerary": ("cut",),
    "InvariantSet": ("shift", "sentence"),
    "Subshift": ("factors",),
    "StableSingles": ("is_complete",),
    "GrazingCurve": ("amplitudes",),
    "Meeting": ("amplitude",),
    "StickingMotion": ("cells",),
    "SticksOnce": ("cells",),
    "ReturningMotion": ("cells", "contraction"),
}
_PARAMETERS = (
    "eta", "nu", "left", "right", "interval", "slopes", "ratios", "printed_s0", "epsilon",
    "velocities", "reach", "signs",
)  # fmt: skip


def plain(value, share=0):
    """Numbers, texts, tuples of them, and records in the place of the project's classes."""
    if value is None or isinstance(value, str | int | float | Fraction | frozenset):
        return value
    if any(kind.__name__ == "Tree" for kind in type(value).__mro__):
        return str(value)
    if isinstance(value, list | tuple):
        return tuple(plain(part, share) for part in value)
    if is_dataclass(value):
        name = type(value).__name__
        if name == "Flow":
            return SimpleNamespace(**flow(value), circles=plain(value.circles), kind=name)
        names = [f.name for f in fields(value) if f.name not in _BLIND]
        record = {each: plain(getattr(value, each), share) for each in names if each != "at"}
        record |= {each: plain(getattr(value, each), share) for each in _MORE.get(name, ())}
        if "box" in record:  # of states; the other one is of oscillators
            record["region"] = record["box"]
        about = value.place if hasattr(value, "place") else getattr(value, "at", None)
        record |= place(about, share)
        return SimpleNamespace(**record, kind=name)
    raise TypeError(f"nothing is known about {type(value).__name__}")


def flow(value):
    """A flow as a file would write it, and what is said of its parameters."""
    names, n = value.outcome.variables, value.equation.n
    texts = (value.section.velocity, value.start, value.outcome)
    field, start, values = ([str(tree) for tree in each.trees] for each in texts)
    end = {"gaps": [str(gap) for gap in value.end.gaps], "count": str(value.end.number)}
    state, time = names[value.first :][:n], names[value.first + n]
    own = {"variables": value.variables, "state": state, "time": time, "given": value.outcome.given}
    return {**own, "field": field, "start": start, "values": values, "end": end}


def place(about, share=0):
    """The oscillators that something is about: a box of them, and a point of that."""
    if about is None:
        return {}
    ranges = [getattr(about, name, None) or 0 for name in ("eta", "nu", "epsilon")]
    box = [(x, x) if isinstance(x, int | Fraction) else tuple(map(Fraction, x)) for x in ranges]
    point = [low + (high - low) * share for low, high in box]
    return dict(zip(("eta", "nu", "epsilon"), point, strict=True), box=tuple(box))


def parameters(of):
    """The numbers of a statement; `ratios` are those printed, or 1/slopes."""
    record = {name: plain(getattr(of, name, None)) for name in _PARAMETERS}
    record["reciprocals"] = 1 / record["slopes"][1], 1 / record["slopes"][0]
    record["ratios"] = record["ratios"] or record["reciprocals"]
    return SimpleNamespace(**record)


def view(conclusion, of=None, share=0):
    """A plain record of a conclusion; of: the numbers of the document, where it has some."""
    beside = {"numbers": of and parameters(of), **place(of)}
    return SimpleNamespace(**{**beside, **vars(plain(conclusion, share))})

"""The one place that knows the project's conclusions: class names and fields, by name alone.

`view(conclusion, of)` is a plain record: `kind` (which judge), the fields under the names that
the judges use, and the parameters eta, nu, ... that it is about: its own if it has any, else those
of the document, `of`. Where a class or a field is renamed, or moved, this file is all that changes.
"""

from dataclasses import fields, is_dataclass
from fractions import Fraction
from types import SimpleNamespace

# class: (kind, fields; "own=path" where the class has another name for it)
CLASSES = {
    "FirstImpact": (
        "first_impact",
        "eta=motion.eta nu=motion.nu phases=motion.phases windows transversal",
    ),
    "Impact": ("point", "phase slope image"),
    "SlopeRange": ("slope_range", "points slopes images pieces"),
    "Avoids": ("avoids", "phases target"),
    "ImageArc": ("image_arc", "domain low high"),
    "Missed": ("missed", "domain=arc.domain target=missed"),
    "MoranRoot": ("moran_root", "ratios root"),
    "NoGap": ("no_gap", "ratios"),
    "GapFunction": ("gap_function", "ratios"),
    "Unlike": ("unlike", "slope given"),
    "Digits": ("digits", "printed given exact readings"),
    "LinearSet": ("linear_set", "ratios root measure"),
    "Excess": ("excess", "ratios epsilon word excess"),
    "Horseshoe": ("horseshoe", "left right slopes interval"),
    "Itinerary": ("itinerary", "sets phase word leaves orbit"),
    "Repeller": ("repeller", "hull domains words slopes dimension"),
    "Branch": ("branch", "cuts turn begin ends"),
    "CoveringGraph": ("covering_graph", "branches states growth entropy"),
    "StayingSet": ("staying_set", "interval cells full=is_full_shift finite cycle increasing"),
    "Separation": ("separation", "start phase time arrival returns"),
    "Lands": ("lands", "phases"),
    "NeverImpacts": ("never_impacts", "phases"),
    "Absorption": ("absorption", "rest within"),
    "SeparationFlight": ("separation_flight", "separation flight turns impact speed"),
    "Chatter": ("chatter", "after epsilon spread rest"),
    "StablePair": ("stable_pair", "epsilon first second"),
    "Solution": ("solution", "eta nu n phase multiplier acceleration early"),
    "Orbit": ("orbit", "eta=solution.eta nu=solution.nu n=solution.n phase=solution.phase"),
    "EtaWindows": ("eta_windows", "nu low ends"),
    "NuWindows": ("nu_windows", "eta above below early"),
    "Rebound": ("rebound", "box phases velocities turns phase velocity derivative"),
    "Rectangle": ("rectangle", "box phases velocities turns left right velocity derivative"),
    "BarredWord": ("barred_word", "box sets velocities word short"),
    "RectangleHorseshoe": ("crossings", "rectangles arrows margin expansion contraction"),
    "Equal": ("equal", "left right"),
    "Series": ("series", "function variable coefficients nonzero"),
    "Value": ("value", "function box bounds"),
    "Theorem": ("theorem", "text"),
    "MethodOne": ("method_one", "points sets values outer"),
    "Sign": ("sign", "quantity box sign"),
    "Monotone": ("monotone", "quantity box sign"),
    "Within": ("within", "quantity box bounds"),
    "Expands": ("expands", "quantity box bound"),
    "NoZero": ("no_zero", "formula box"),
    "Refuted": ("refuted", "statement point"),
    "Zero": ("zero", "quantity interval"),
    "Root": ("root", "quantity interval bracket"),
    "UniqueZero": ("unique_zero", "formula box"),
    "Identity": ("identity", "formula left derivative right"),
    "HSet": ("h_set", "centre matrix inverse"),
    "Covers": ("covers", "formula local orientation"),
    "Graph": ("graph", "covers nodes edges"),
    "Entropy": ("entropy", "graph growth length"),
    "Conjugacy": ("conjugacy", "graph forward"),
}  # fmt: skip
_BLIND = {"tape", "roots", "map", "work"}  # the checker's machinery inside of conclusions
_PARAMETERS = (
    "eta", "nu", "left", "right", "interval", "slopes", "ratios", "printed_s0", "epsilon",
    "velocities", "reach",
)  # fmt: skip


def name_of(conclusion):
    """The name under which `CLASSES` knows a conclusion; two classes are called Horseshoe."""
    name = type(conclusion).__name__
    return "RectangleHorseshoe" if hasattr(conclusion, "arrows") else name


def plain(value):
    """Numbers, texts, tuples of them, and records in the place of the project's classes."""
    if value is None or isinstance(value, str | int | float | Fraction | frozenset):
        return value
    if isinstance(value, list | tuple):
        return tuple(plain(part) for part in value)
    if is_dataclass(value):
        names = [f.name for f in fields(value) if f.name not in _BLIND]
        names += [name for name in ("interval",) if hasattr(value, name) and name not in names]
        record = {name: plain(getattr(value, name)) for name in names}
        kind = CLASSES.get(name_of(value), (None,))[0]
        return SimpleNamespace(**{**place(record.pop("at", None)), **record, "kind": kind})
    raise TypeError(f"nothing is known about {type(value).__name__}")


def place(about, share=0):
    """eta and nu of the oscillators that something is about; a point of them, if they are many."""
    if about is None:
        return {}
    pairs = ((name, plain(getattr(about, name))) for name in ("eta", "nu"))
    return {
        name: x if isinstance(x, Fraction) else x[0] + (x[1] - x[0]) * share for name, x in pairs
    }


def parameters(of):
    """The numbers of a statement; `ratios` are those printed, or 1/slopes."""
    record = {name: plain(getattr(of, name, None)) for name in _PARAMETERS}
    record["reciprocals"] = 1 / record["slopes"][1], 1 / record["slopes"][0]
    record["ratios"] = record["ratios"] or record["reciprocals"]
    return SimpleNamespace(**record)


def view(conclusion, of=None, share=0):
    """A plain record of a conclusion; of: the numbers of the document, where it has some."""
    kind, wanted = CLASSES[name_of(conclusion)]
    record = {"interval": plain(getattr(of, "interval", None))}
    record |= place(getattr(conclusion, "at", None) or of, share)
    for part in wanted.split():
        name, _, path = part.partition("=")
        value = conclusion
        for step in (path or name).split("."):
            value = getattr(value, step)
        record[name] = plain(value)
    return SimpleNamespace(kind=kind, **record)

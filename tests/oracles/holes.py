"""The holes that a hostile audit found, to be put back one by one: the falsifier must find them.

Each is lines of the checker that close it, with what they were like when it was open.
"""

import importlib
import inspect
import textwrap
from contextlib import contextmanager
from typing import Any, NamedTuple


class Lines(NamedTuple):
    """A function, "module:name" below proofs.trusted, and pieces of it as they are and were."""

    where: str
    pieces: tuple[tuple[str, str], ...]


@contextmanager
def reopened(lines):
    """The function as it was."""
    name, _, path = lines.where.partition(":")
    module = importlib.import_module(f"proofs.trusted.{name}")
    function = module
    for part in path.split("."):
        function = getattr(function, part)
    source = textwrap.dedent(inspect.getsource(function))
    for closed, opened in lines.pieces:
        assert closed in source, f"{lines.where} has no {closed!r}"
        source = source.replace(closed, opened)
    made: dict[str, Any] = {}
    exec(f"from __future__ import annotations\n{source}", vars(module), made)
    code = getattr(made[function.__name__], "__func__", made[function.__name__]).__code__
    function.__code__, before = code, function.__code__
    try:
        yield
    finally:
        function.__code__ = before


ORDER = (
    Lines(
        "kernel.staying:staying_set",
        (
            ("sorted(cells, key=lambda x: x.domain)", "list(cells)"),
            ('raise Unproved("cells overlap")', "pass"),
        ),
    ),
    Lines(
        "kernel.staying:StayingSet.__post_init__",
        (("not apart(self.cells)", "False"),),
    ),
)
ASKED = Lines("verdicts:Row.is_asked", (("self.printed_at is None", "True"),))
PLACES = Lines(
    "paper.s34_circle.circle:_is_the_printed_orbit",
    (("all(within(phase, (x - _HALF, x + _HALF)) for x, phase in printed)", "True"),),
)
GAP = Lines("paper.s32_sets.linear:LinearSet.__post_init__", (("sum(self.ratios) >= 1", "False"),))
EQUAL = Lines(
    "paper.s32_sets.linear_steps:_gap_estimates",
    (("if true and false:", "if False:"), ("if true:", "if not false:")),
)
POINT = (
    Lines("numbers:Phases._require", (("low < high", "low <= high"),)),
    Lines("paper.s34_circle.landing:never_impacts", (("phases[0] < phases[1]", "True"),)),
)

"""Rule: where a map takes a box."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from proofs.trusted.certificate import Reader
from proofs.trusted.kernel.arithmetic import Enclosure
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.kernel.enclose import Box, box_text, decide, leaves, read_box
from proofs.trusted.kernel.maps import Map
from proofs.trusted.numbers import show_range, within


@dataclass(frozen=True)
class Image(Conclusion):
    """A map is defined and continuous on a box, and takes it into another one."""

    function: Map
    box: Box
    bounds: Box

    @property
    def sentence(self) -> str:
        """Return the statement."""
        place = box_text(self.box, self.function.variables)
        values = ", ".join(map(show_range, self.bounds))
        return (
            f"for {self.function.definition}: `{self.function.name}` is defined for {place}, and "
            f"its values are in {values}."
        )


def image(context: Context, reader: Reader) -> Image:
    """Rule `image`: {function F, box, tree, bounds}, bounds being a range for each value.

    Hypothesis: on each leaf of the tree, which divides the box, an enclosure of F, in the natural
    or in the mean value form, lies within the bounds. Conclusion: F is defined on the box, and its
    values there are in the bounds; those of angles are not reduced. Proof. The leaves cover the
    box; an enclosure contains all values on its leaf, and exists only where F is defined.
    """
    function_of, box_of, tree, bounds_of = reader.fields("function", "box", "tree", "bounds")
    function = context.function(function_of)
    box, bounds = read_box(box_of, len(function.variables)), read_box(bounds_of, function.size)
    for leaf in leaves(tree, box):
        decide(function, leaf, partial(_inside, bounds))
    return Image(function, box, bounds)


def _inside(bounds: Box, values: list[Enclosure]) -> bool:
    return all(within(value.range, side) for value, side in zip(values, bounds, strict=True))

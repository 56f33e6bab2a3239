"""What a figure is: what certificates prove, drawn; and the certificates of a folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from proofs.report.figures.style import style, svg_of
from proofs.trusted.certificate import read
from proofs.trusted.kernel.context import Context
from proofs.trusted.verify import premises

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

Documents = Mapping[str, Context]


@dataclass(frozen=True)
class Figure:
    """A figure beside one of the paper's.

    name: of its file, without ".svg". claims: the rows that it belongs to. certificates: those that
    it is drawn from. `caption` is made of their conclusions; filled shapes are what they prove,
    dots are computed in floating point and prove nothing.
    """

    name: str
    title: str
    claims: tuple[str, ...]
    certificates: tuple[str, ...]
    describe: Callable[[Documents], str]
    plot: Callable[[Documents], Drawing]

    def caption(self, documents: Documents) -> str:
        """Return what the figure shows, from the conclusions of the certificates."""
        return self.describe(documents)

    def svg(self, documents: Documents) -> str:
        """Return the figure as SVG, the same text for the same certificates.

        Raises Undecided where they do not prove what it is about.
        """
        with style(self.name):
            return svg_of(self.plot(documents), self.name, self.title)


class Certificates(Mapping[str, Context]):
    """What the certificates of a folder prove, by name; each is derived once, when asked for."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[str, Context] = {}

    def __getitem__(self, name: str) -> Context:
        if name not in self._known:
            path = self._folder / f"{name}.json"
            if not path.exists():
                raise KeyError(name)
            self._known[name] = premises(read(path))
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return (path.stem for path in sorted(self._folder.glob("*.json")))

    def __len__(self) -> int:
        return sum(1 for _ in self)

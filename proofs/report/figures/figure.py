"""What a figure is: what certificates prove, drawn; and the certificates of a folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from intervals import Undecided
from proofs.report.figures.style import Drawing, style, svg_of
from proofs.report.findings import section_of
from proofs.trusted.files import read
from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.kernel.context import Context
from proofs.trusted.paper import find
from proofs.trusted.verify import premises

Documents = Mapping[str, Context]
C = TypeVar("C", bound=Conclusion)


@dataclass(frozen=True)
class Figure:
    """A figure beside one of the paper's.

    name: of its file, without ".svg". claims: the rows that it belongs to. certificate: the one
    that it is drawn from. shows: how to read it; what it shows is said by the claims. Filled shapes
    and thick lines are what the certificate proves; dots and thin lines are floating point, which
    proves nothing.
    """

    name: str
    title: str
    claims: tuple[str, ...]
    certificate: str
    shows: str
    plot: Callable[[Context], Drawing]

    @property
    def section(self) -> str:
        """The section of the paper that it belongs to: that of its first claim."""
        row = find(self.claims[0])
        return "" if row is None else section_of(row)

    def svg(self, documents: Documents) -> str:
        """Return the figure as SVG, the same text for the same certificate.

        Raises Undecided where that does not prove what the figure is about.
        """
        with style(self.name):
            return svg_of(self.plot(documents[self.certificate]), self.name, self.title)


class Certificates(Mapping[str, Context]):
    """What the certificates of a folder prove, by name; each is derived once, when asked for.

    derived: what was derived from some of them just now.
    """

    def __init__(self, folder: Path, derived: Documents = MappingProxyType({})) -> None:
        self._folder = folder
        self._known = dict(derived)

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


def all_of(proved: Context, kind: type[C]) -> list[C]:
    """Return the conclusions of a kind, in their order."""
    return [each for each in proved.known.values() if isinstance(each, kind)]


def the(proved: Context, kind: type[C]) -> C:
    """Return the first conclusion of a kind, or raise Undecided."""
    for each in all_of(proved, kind):
        return each
    raise Undecided(f"the certificate proves no {kind.__name__}")

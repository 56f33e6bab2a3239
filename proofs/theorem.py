"""What was proved, with a certificate that anybody can check."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from itertools import takewhile
from pathlib import Path

from proofs.trusted.kernel.conclusion import Conclusion
from proofs.trusted.verdicts import told


@dataclass(frozen=True)
class Theorem:
    """Conclusions of the checker's rules, and a certificate that `python -m proofs check` accepts.

    Printing it says them with all their hypotheses; nothing else is claimed.
    """

    conclusions: tuple[Conclusion, ...]
    certificate: str

    @property
    def conclusion(self) -> Conclusion:
        """The last of them."""
        return self.conclusions[-1]

    def __iter__(self) -> Iterator[Conclusion]:
        return iter(self.conclusions)

    def __len__(self) -> int:
        return len(self.conclusions)

    def __getitem__(self, index: int) -> Conclusion:
        return self.conclusions[index]

    def __str__(self) -> str:
        """Return them in words, a line each, after the map that all are about."""
        return self.text(len(self))

    def text(self, most: int) -> str:
        """Return so many of them in words, and how many more there are."""
        if len(self) > most:
            more = f"- and {len(self) - most} more of this kind, in the certificate"
            return f"{Theorem(self.conclusions[:most], '')}\n{more}"
        lines = [each.sentence if each.place is None else told([each]) for each in self.conclusions]
        shared = _shared(lines) if len(lines) > 1 else ""
        if not shared:
            return "\n".join(lines)
        return "\n".join([f"{shared}:", *(f"- {line[len(shared) + 2 :]}" for line in lines)])

    def _repr_html_(self) -> str:
        return "".join(f"<p>{escape(part)}</p>" for part in str(self).split("\n"))

    def save(self, path: str | Path) -> Path:
        """Write the certificate to a file; FileExistsError where another system's is there."""
        from proofs.shell.files import writing

        file = Path(path)
        if file.exists() and not self._is_about_same(file):
            raise FileExistsError(f"{file} is a file about another system, or no certificate")
        with writing(file.parent) as put:
            put(file.name, self.certificate)
        return file

    def _is_about_same(self, file: Path) -> bool:
        try:
            there, here = json.loads(file.read_text("utf-8")), json.loads(self.certificate)
            return all(there[part] == here[part] for part in ("parameters", "functions"))
        except (ValueError, KeyError, TypeError):
            return False


def _shared(lines: list[str]) -> str:
    """Return what texts begin with in common, up to a colon or a semicolon."""
    columns = takewhile(lambda letters: len({*letters}) == 1, zip(*lines, strict=False))
    text = "".join(letters[0] for letters in columns)
    return text[: max(text.rfind(": "), text.rfind("; "), 0)]

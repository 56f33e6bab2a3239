"""Sentences, which are plain ASCII, as typeset text: symbols, subscripts, powers.

Conclusions write phi, f', <=, omega_n, sin^2(x), f^(k-1)(phi), and formulas of a user's own between
backquotes. Nothing is added or left out here: a mark of the sentence becomes a mark of the page, or
a script its place.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from types import MappingProxyType

GREEK = MappingProxyType(
    {
        **dict(zip(("alpha", "beta", "gamma", "delta", "epsilon", "eta"), "αβγδεη", strict=True)),
        **dict(zip(("theta", "lambda", "mu", "nu", "pi", "rho"), "θλμνπρ", strict=True)),
        **dict(zip(("sigma", "tau", "phi", "psi", "omega"), "στφψω", strict=True)),
        **dict(zip(("Delta", "Lambda", "Sigma"), "ΔΛΣ", strict=True)),
    }
)
_SIGNS = MappingProxyType(
    {"<=": "≤", ">=": "≥", "->": "→", "+-": "±", "...": "…", "=:": "=:", ":=": ":="}
)
_WORDS = MappingProxyType({"infinity": "∞", "sqrt": "√"})
_TOKEN = re.compile(
    r"`(?P<formula>[^`]*)`"
    r"|(?P<code>[a-z_]{2,}(?:\.[a-z_]{2,})+)"
    r"|(?P<name>[A-Za-z]+)(?P<index>[0-9]*)"
    r"|(?P<number>[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?)"
    r"|(?P<sign><=|>=|->|\+-|\.\.\.|=:|:=)"
    r"|(?P<prime>'+)"
    r"|(?P<mark>.)",
    re.DOTALL,
)
_SCRIPT = re.compile(r"[A-Za-z0-9]+|\*")
_INDEXED = set("IVHa")  # I0, V1, H0, a11; A1, M2, S5 and the like are claims


@dataclass(frozen=True)
class Piece:
    """A part of typeset text: words, a variable, a name from the code; or a script of pieces."""

    kind: str  # "words", "variable", "code", "sub", "sup"
    text: str = ""
    inner: tuple[Piece, ...] = ()


def typeset(sentence: str) -> tuple[Piece, ...]:
    """Divide a sentence into pieces."""
    return tuple(_Setter(sentence).pieces())


def html(sentence: str) -> str:
    """Return a sentence as HTML; whatever it holds is escaped."""
    return _rendered(typeset(sentence), escape, {"variable": "var", "code": "code"})


def markdown(sentence: str) -> str:
    """Return a sentence as Markdown, its scripts as HTML; nothing in it is markup by itself."""
    return _rendered(typeset(sentence), _unmarked, {"code": "code"})


def plain(sentence: str) -> str:
    """Return a sentence with symbols, in one line without markup, for titles and labels."""
    scripts = {"sub": "_", "sup": "^"}

    def flat(piece: Piece) -> str:
        if piece.kind not in scripts:
            return piece.text
        inner = "".join(map(flat, piece.inner))
        return scripts[piece.kind] + (inner if len(piece.inner) == 1 else f"({inner})")

    return "".join(map(flat, typeset(sentence)))


def begun(sentence: str) -> str:
    """Begin a sentence with a capital letter, unless it begins with a symbol, such as f."""
    word = sentence.split(" ", 1)[0].rstrip(",:")
    is_word = word.isalpha() and (len(word) > 1 or word == "a") and word not in GREEK
    return sentence[:1].upper() + sentence[1:] if is_word else sentence


def _unmarked(text: str) -> str:
    return re.sub(r"([\\`*_\[\]|~$])", r"\\\1", escape(text, quote=False))


def _rendered(pieces: Sequence[Piece], write: Callable[[str], str], tags: dict[str, str]) -> str:
    parts = []
    for piece in pieces:
        tag = piece.kind if piece.inner else tags.get(piece.kind, "")
        text = _rendered(piece.inner, write, tags) if piece.inner else write(piece.text)
        parts.append(f"<{tag}>{text}</{tag}>" if tag else text)
    return "".join(parts)


class _Setter:
    """Goes through a sentence; what a mark means depends on what stands beside it."""

    def __init__(self, sentence: str) -> None:
        self.sentence = sentence
        self.place = 0
        self.before = Piece("words", " ")  # the last piece

    def pieces(self) -> Iterator[Piece]:
        """Yield the pieces, words that follow one another together."""
        words = ""
        while self.place < len(self.sentence):
            for piece in self._next():
                if piece.kind == "words":
                    words += piece.text
                else:
                    if words:
                        yield Piece("words", words)
                    words = ""
                    yield piece
                self.before = piece
        if words:
            yield Piece("words", words)

    def _next(self) -> Iterator[Piece]:
        match = _TOKEN.match(self.sentence, self.place)
        if match is None:  # cannot be: the last alternative takes any mark
            raise ValueError(self.sentence[self.place :])
        if match["mark"] in ("_", "^") and self._is_base() and (script := self._script()):
            yield script
            return
        self.place = match.end()
        if match["name"]:
            yield from self._name(match["name"], match["index"])
        elif match["code"] or match["formula"]:
            yield Piece("code", match["code"] or match["formula"])
        elif match["sign"]:
            yield Piece("words", _SIGNS[match["sign"]])
        elif match["prime"]:
            yield Piece("words", self._prime(match["prime"]))
        elif match["mark"] == "-":
            yield Piece("words", self._dash())
        elif match["mark"] == "*" and self._beside() == (" ", " "):
            yield Piece("words", "·")
        else:
            yield Piece("words", match["number"] or match["mark"])

    def _beside(self) -> tuple[str, str]:
        """Return the characters before and after the mark that was just taken."""
        before = self.sentence[self.place - 2] if self.place > 1 else " "
        after = self.sentence[self.place] if self.place < len(self.sentence) else " "
        return before, after

    def _is_base(self) -> bool:
        """Whether a script can stand here: after a symbol, a number, a bracket, a function."""
        return self.place > 0 and (self.sentence[self.place - 1].isalnum() or self._closes())

    def _closes(self) -> bool:
        return self.sentence[self.place - 1] in ")]|'}"

    def _script(self) -> Piece | None:
        """Take a subscript or a power: a symbol with its own subscript, or what is in brackets."""
        kind = {"_": "sub", "^": "sup"}[self.sentence[self.place]]
        start = self.place + 1
        if self.sentence[start : start + 1] == "(":
            end = _closing(self.sentence, start)
            inner = self.sentence[start + 1 : end - 1]
        elif match := _SCRIPT.match(self.sentence, start):
            end, inner = match.end(), match[0]
            if kind == "sup" and (index := re.match(r"_[A-Za-z0-9]+", self.sentence[end:])):
                end, inner = end + index.end(), inner + index[0]
        else:
            return None
        self.place = end
        if kind == "sub" and len(inner) > 1 and inner.isalnum() and inner not in GREEK:
            return Piece(kind, inner=(Piece("words", inner),))  # w0, SN, 011
        return Piece(kind, inner=typeset(inner))

    def _name(self, name: str, index: str) -> Iterator[Piece]:
        if name in GREEK:
            yield Piece("variable", GREEK[name])
        elif name in _WORDS:
            self._skip_space(name)
            yield Piece("words", _WORDS[name])
        elif name[0] == "d" and name[1:] in GREEK:
            yield Piece("words", "d")
            yield Piece("variable", GREEK[name[1:]])
        elif len(name) == 1 and self._is_cross(name):
            yield Piece("words", "×")
        elif len(name) == 1 and not self._is_word(name, index):
            yield Piece("variable", name)
        else:
            yield Piece("words", name + index)
            return
        if index:
            yield Piece("sub", inner=(Piece("words", index),))

    def _skip_space(self, name: str) -> None:
        """Write the root of 5, "sqrt 5", without the space."""
        if name == "sqrt" and self.sentence[self.place : self.place + 1] == " ":
            self.place += 1

    def _is_word(self, letter: str, index: str) -> bool:
        """Whether a letter is an article, a possessive, or part of the name of a claim."""
        rest = self.sentence[self.place :]
        if index:
            return letter not in _INDEXED
        if self.before.text == "’" or self._beside()[0].isdigit():  # paper's, 7a
            return True
        article = {"a": r" [A-Za-z0-9(|]", "A": r" [a-z]{2}"}.get(letter)
        return article is not None and re.match(article, rest) is not None

    def _is_cross(self, letter: str) -> bool:
        """Whether an x stands between two ranges, or for "times"."""
        before = self.sentence[: self.place - 1]
        return letter == "x" and before.endswith(("] ", "phases "))

    def _prime(self, marks: str) -> str:
        if self.before.kind == "variable" or self.sentence[: self.place].endswith("gap'"):
            return {1: "′", 2: "″"}.get(len(marks), "′" * len(marks))
        if self.sentence[: self.place].endswith(")'") and self._beside()[1] in "|(":  # |(f^n)'|
            return "′"
        return "’" * len(marks)

    def _dash(self) -> str:
        before, after = self._beside()
        if after == " " or before in " ([{,=/|^":
            return "−"
        if before == ")" and after == "(":
            return "–"
        return "−" if self.before.kind == "variable" and after.isdigit() else "-"


def _closing(sentence: str, start: int) -> int:
    """Return the place after the bracket that closes the one at `start`."""
    depth = 0
    for place in range(start, len(sentence)):
        depth += {"(": 1, ")": -1}.get(sentence[place], 0)
        if not depth:
            return place + 1
    return len(sentence) + 1

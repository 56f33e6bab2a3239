"""Typeset sentences say what the plain ones say: read back, nothing is lost or added."""

import re
from html.parser import HTMLParser

import pytest
from hypothesis import given
from hypothesis import strategies as st

from proofs.report.typeset import html, markdown, plain

ASCII = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "η": "eta",
    "θ": "theta", "λ": "lambda", "μ": "mu", "ν": "nu", "π": "pi", "ρ": "rho", "σ": "sigma",
    "τ": "tau", "φ": "phi", "ψ": "psi", "ω": "omega", "Λ": "Lambda", "Δ": "Delta", "Σ": "Sigma",
    "≤": "<=", "≥": ">=", "→": "->", "±": "+-", "…": "...", "−": "-", "–": "-", "×": "x",
    "′": "'", "″": "''", "’": "'", "·": "*", "∞": "infinity", "√": "sqrt",
}  # fmt: skip
CASES = [
    ("f^(k-1)(phi) in I_(w_k)", "<var>f</var><sup><var>k</var>−1</sup>(<var>φ</var>) in "
     "<var>I</var><sub><var>w</var><sub><var>k</var></sub></sub>"),
    ("sin^2(x) <= omega_n^2", "sin<sup>2</sup>(<var>x</var>) ≤ "
     "<var>ω</var><sub><var>n</var></sub><sup>2</sup>"),
    ("eta0^s_0 = 0.5", "<var>η</var><sub>0</sub><sup><var>s</var><sub>0</sub></sup> = 0.5"),
    ("a 2-periodic orbit of A", "a 2-periodic orbit of <var>A</var>"),
    ("A mass, a = b, S5 and I1", "A mass, <var>a</var> = <var>b</var>, S5 and "
     "<var>I</var><sub>1</sub>"),
    ("the paper's f' and x'_o",
     "the paper’s <var>f</var>′ and <var>x</var>′<sub><var>o</var></sub>"),
    ("[1, 2] x [-0.45, 0]", "[1, 2] × [−0.45, 0]"),
    ("2 - 3, n-1, (8)-(9), -p", "2 − 3, <var>n</var>−1, (8)–(9), −<var>p</var>"),
    ("sqrt 5, Figure 7a, 2e-8", "√5, Figure 7a, 2e-8"),
    ("rho_SN and d^2(f^2)/dpsi drho", "<var>ρ</var><sub>SN</sub> and <var>d</var><sup>2</sup>"
     "(<var>f</var><sup>2</sup>)/d<var>ψ</var> d<var>ρ</var>"),
    ("by proofs.report.figures", "by <code>proofs.report.figures</code>"),
    ("for `F(x) = -2*x**(-1)` and `x`", "for <code>F(x) = -2*x**(-1)</code> and <code>x</code>"),
]  # fmt: skip


class Text(HTMLParser):
    """Collects text and checks that tags are the few that there may be, and closed in order."""

    def __init__(self):
        super().__init__()
        self.parts, self.open = [], []

    def handle_starttag(self, tag, attrs):
        assert tag in {"var", "sub", "sup", "code"} and not attrs
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.parts.append(data)


def text_of(markup):
    reader = Text()
    reader.feed(markup)
    reader.close()
    assert not reader.open
    return "".join(reader.parts)


def bare(text):
    """What stands in a text whatever its notation: without scripts' marks, brackets, spaces."""
    for symbol, name in ASCII.items():
        text = text.replace(symbol, name)
    return re.sub(r"[_^()\s]", "", text)


@pytest.mark.parametrize("sentence, markup", CASES)
def test_cases(sentence, markup):
    assert html(sentence) == markup


@pytest.mark.parametrize("symbol", "αβγδεηθλμνπρστφψωΛΔΣ≤≥→±…∞")
def test_symbols(symbol):
    assert plain(f"c {ASCII[symbol]} c, {ASCII[symbol]}") == f"c {symbol} c, {symbol}"


@given(st.text(alphabet="abefxIAV01239 .,;:-+*/^_()[]{}|<>='&\"é", max_size=40))
def test_nothing_is_lost_or_added_whatever_the_text(text):
    assert bare(text_of(html(text))) == bare(text)
    assert bare(plain(text)) == bare(text)


@given(st.sampled_from(CASES), st.sampled_from(['<script src="x">', "&amp;", "<b>", "]]>"]))
def test_markup_in_a_sentence_is_text(case, hostile):
    shown = html(f"{case[0]} {hostile} {case[0]}")
    assert bare(hostile) in bare(text_of(shown))


@pytest.mark.parametrize("text", ["a*b*c", "[x](y)", "|x| _y_ `z`", "1. ~a~ $b$", "<i>"])
def test_nothing_in_markdown_is_markup(text):
    shown = re.sub(r"</?(sub|sup|code)>", "", markdown(text))
    assert not re.search(r"(?<!\\)[*_`|~$\[\]]", shown) and "<" not in shown

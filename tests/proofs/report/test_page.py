"""The page as a reader's parser sees it: anchors, links, theorems once, nothing from elsewhere."""

import re
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from html.parser import HTMLParser

import pytest

from proofs.report import __main__ as command
from proofs.report import theorem as _page
from proofs.report.accepted import Accepted
from proofs.report.layout import enclosure, enumerated, facts, marked, percents, sentences
from proofs.report.ledger import ledger
from proofs.report.theorem import sources, template, theorem
from proofs.report.typeset import html, markdown
from tests.proofs.report.conftest import REPORTS

VOID = {"meta", "link", "input", "br", "hr", "img", "mspace"}


class Page(HTMLParser):
    """Ids, links, text, and that every tag is closed in order."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.sources, self.open, self.text = [], [], [], [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.ids += [attrs["id"]] if "id" in attrs else []
        for name in ("href", "xlink:href"):
            self.links += [attrs[name]] if name in attrs else []
        self.sources += [attrs[name] for name in ("src", "srcset", "action") if name in attrs]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


@pytest.fixture(scope="module")
def parsed(page):
    return Page(page)


@pytest.mark.slow
def test_every_claim_and_statement_is_an_anchor_and_none_is_there_twice(found, parsed):
    twice = [each for each, count in Counter(parsed.ids).items() if count > 1]
    assert not twice
    labels = [statement.label for statement in found.statements.values()]
    assert {*labels, *(claim.id for claim in found.claims)} <= set(parsed.ids)


@pytest.mark.slow
def test_every_link_leads_somewhere_and_nothing_is_loaded(page, parsed):
    for link in parsed.links:
        if link.startswith("#"):
            assert link[1:] in parsed.ids, link
        elif not link.startswith("data:,"):
            assert (REPORTS / link).is_file(), link
    assert not parsed.sources and "@import" not in page and 'http-equiv="refresh' not in page
    assert not re.search(r"url\((?!#)", page)
    addresses = set(re.findall(r"https?://[^\s\"'<>)]+", page))
    assert addresses <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}
    assert len(page.encode()) < 2_200_000
    for claim in parsed.links:
        assert "://" not in claim


@pytest.mark.slow
def test_each_statement_stands_once_in_full_at_its_claim(found, page):
    for statement in found.statements.values():
        start = page.index(f'id="{statement.label}"')
        assert page.count(f'id="{statement.label}"') == 1
        assert page.rindex('<details class="claim" id="', 0, start) == page.index(
            f'<details class="claim" id="{statement.claim}"'
        )
        parts = [part for part in found.parts(statement) if isinstance(part, str)]
        shown = [html(sentence) for part in parts for sentence in sentences(part)]
        assert min(map(page.count, shown)) <= 1 or max(map(len, shown)) < 150, statement.label


@pytest.mark.slow
def test_the_texts_of_every_claim_are_there(found, parsed):
    text = " ".join("".join(parsed.text).split())
    for claim in found.claims:
        assert claim.made in text and claim.checked in text
        for sentence in (claim.reading, claim.decision.why):
            shown = "".join(Page(f"<p>{html(sentence)}</p>").text)
            assert " ".join(shown.split()) in text, claim.id


@pytest.mark.slow
def test_what_is_committed_is_this_page(found, shown, page):
    assert (REPORTS / "index.html").read_text(encoding="utf-8") == page
    assert (REPORTS / "ledger.md").read_text(encoding="utf-8") == ledger(found, shown)
    assert (REPORTS / "theorem.md").read_text(encoding="utf-8") == theorem(found)


@pytest.mark.slow
def test_markdown_has_every_statement_once_and_no_broken_link(found):
    text = (REPORTS / "ledger.md").read_text(encoding="utf-8")
    anchors = re.findall(r'<a id="([^"]*)"></a>', text)
    assert len(set(anchors)) == len(anchors)
    for _, link in re.findall(r"(!?)\[[^\]]*\]\(([^)\s]*)\)", text):
        assert link[1:] in anchors if link.startswith("#") else (REPORTS / link).is_file(), link
    for statement in found.statements.values():
        assert text.count(f"**{statement.kind} {statement.label}.** ") == 1
        for part in found.parts(statement):
            assert not isinstance(part, str) or markdown(part) in text


def test_a_sentence_without_a_tag_is_refused(monkeypatch):
    monkeypatch.setattr(_page, "_LINE", re.compile(r"@(def) (.+)"))  # no other tag is one
    with pytest.raises(ValueError, match="without a tag"):
        template()


@pytest.mark.slow
def test_numbers_of_the_theorem_are_those_of_the_conclusions_that_they_render(found):
    """Those written by hand; definitions and rules have none but those of the oscillator."""
    known = sources(found)
    for tag, text in template():
        numbers = re.findall(r"(?<![\w.])\d\.\d{3,}", text)
        assert tag in {*known, "", "def", "classical"}  # else it would not be on the page
        conclusion = known.get(tag)
        if conclusion is None:
            assert tag == "" or set(numbers) <= {"0.2121"}, text
        else:
            assert all(each in conclusion.sentence for each in numbers), text
        for least in re.findall(r"f' > (\d\.\d+)", text):
            assert Fraction(least) < conclusion.minimum[0], text
        for point, word, bound in re.findall(r"\{f\(([\d.]+)\)\}, (below|above) (\d\.\d+)", text):
            low, high = conclusion.images[conclusion.points.index(Fraction(point))]
            assert (high < Fraction(bound)) if word == "below" else (low > Fraction(bound)), text


@pytest.mark.slow
def test_the_theorem_stands_alone(found):
    """Statements in full, or by a theorem above; what it links is there; no verdict on the paper,
    no other page needed.
    """
    text, whole = theorem(found), (REPORTS / "ledger.md").read_text(encoding="utf-8")
    labels = {each.label: each for each in found.statements.values()}
    for tag, said in template():
        if said == "{text}":
            quoted = text[: text.index(f"[[{tag}]")].rpartition("\n\n")[2]
            for part in found.parts(labels[tag]):
                if isinstance(part, str):
                    sets = [x for each in sentences(part) for x in [*enumerated(each)[1]] or [each]]
                    assert [x for x in sets if markdown(x) not in quoted] == []
                elif f"[[{part.label}]" in text[: text.index(f"[[{tag}]")]:
                    assert "says of these sets holds; moreover:" in quoted
                else:
                    assert markdown(part.text) in quoted
    for named in re.findall(r"(.{0,60})moreover:", text):
        above = re.search(r"What (Theorem \d+) says of these sets holds; $", named)
        assert text.index(f"**{above[1]}** (") < text.index(named)
    assert "efuted" not in text and "{" not in text
    for link in re.findall(r"\]\(([^)\s]*)\)", text):
        file, _, anchor = link.partition("#")
        assert (REPORTS / file).resolve().is_file(), link
        if file == "ledger.md" and anchor:
            assert f'<a id="{anchor}"></a>' in whole, link
        elif anchor:
            assert f"### `{anchor}`" in (REPORTS / file).resolve().read_text(encoding="utf-8")
    assert re.findall(r"\*\*Theorem (\d+)\*\* \(", text) == [str(n) for n in range(1, 11)]


@pytest.mark.slow
def test_a_small_folder_makes_a_page_of_its_own(small, capsys):
    assert command.main(["--out", str(small)]) == 0
    parsed = Page((small / "index.html").read_text())
    assert {"H2", "H5", "H11", "H2.1"} <= set(parsed.ids) and "H1" not in parsed.ids
    assert all(x[1:] in parsed.ids for x in parsed.links if x.startswith("#"))
    assert (small / "ledger.md").is_file() and (small / "figures" / "dependencies.svg").is_file()
    before = {path: path.read_bytes() for path in small.rglob("*") if path.is_file()}
    assert command.main(["--out", str(small), "--quiet"]) == 0
    assert before == {path: path.read_bytes() for path in small.rglob("*") if path.is_file()}


@pytest.mark.parametrize(
    "name, old, new, status",
    [
        ("ledger.json", '"REFUTED"', '"VERIFIED"', 3),
        ("ledger.json", '"H5"', '"H99"', 2),
        ("ledger.json", '"H5"', '"M5"', 2),
        ("ledger.json", "horseshoe.json", "circle.json", 2),
        ("ledger.json", "impact-proofs.ledger", "impact-proofs.other", 2),
        ("ledger.json", "{", "", 2),
        ("horseshoe.json", "2121/10000", "2123/10000", 3),
    ],
)
def test_what_is_not_proved_is_not_printed(small, name, old, new, status, capsys):
    path = small / name
    text = path.read_text()
    path.write_text(text.replace(old, new) if "json" in old else text.replace(old, new, 1))
    try:
        assert command.main(["--out", str(small)]) == status
    except SystemExit as leaving:
        assert leaving.code == status
    told = capsys.readouterr()
    assert (told.out + told.err).count("\n") == 1
    assert not (small / "index.html").exists() and not (small / "ledger.md").exists()


@pytest.mark.parametrize(
    "text, expected",
    [
        ("x = 1, y <= 2.5", [("x", "=", "1"), ("y", "<=", "2.5")]),
        ("4.3 <= f' <= 6.19", [("f'", "<=", "6.19"), ("f'", ">=", "4.3")]),
        ("I0 = [1.1, 1.15].", [("I0", "=", "[1.1, 1.15]")]),
        ("V1 = [1, 2] x [-1, 0]", [("V1", "=", "[1, 2] x [-1, 0]")]),
        ("rho_o = sqrt(4 + (2 pi m)^2)", [("rho_o", "=", "sqrt(4 + (2 pi m)^2)")]),
        ("f(x) <= 2, x = 2 pi, x = 4/3 y", []),
    ],
)
def test_facts(text, expected):
    found = [fact[:3] for fact in facts(text)]
    assert [fact for fact in found if fact in expected] == expected
    assert not [fact for fact in found if expected and fact not in expected]


def test_what_differs_is_marked_on_both_sides_and_nothing_else():
    printed, proved = "f' <= 5.25 on I0 = [1.11, 1.15]", "4.3 <= f' <= 6.19, I0 = [1.1, 1.15]"
    assert re.findall("<mark>(.*?)</mark>", marked(printed, proved)) == ["5.25", "[1.11, 1.15]"]
    assert re.findall("<mark>(.*?)</mark>", marked(proved, printed)) == ["6.19", "[1.1, 1.15]"]
    assert "<mark>" not in marked(printed, printed) + marked(printed, "g <= 7")


@pytest.mark.parametrize(
    "bounds, shown",
    [
        (("1.2345678", "1.2345679"), "1.234567[8, 9]"),
        (("1.5", "1.5"), "1.5"),
        (("0.1234599", "0.12346"), "0.1234[599, 600]"),
        (("-2.00001", "-2"), "-2.0000[1, 0]"),
        (("-1", "2"), "[-1, 2]"),
        (("0.1", "0.2000000001"), "[0.1, 0.20000001]"),
        (("9.99999", "10.00001"), "[9.99999, 10.00001]"),
    ],
)
def test_enclosures(bounds, shown):
    assert enclosure(*bounds) == shown


@pytest.mark.parametrize(
    ("shares", "expected"),
    [
        ({"V": "0.0909", "R": "0.8119", "U": "0.0972"}, ["9.0 %", "81.1 %", "9.9 %"]),  # not more
        ({"V": "0.33333", "R": "0.66667", "U": "0"}, ["33.3 %", "66.7 %", "0.0 %"]),
        ({"V": "1", "R": "0", "U": "0"}, ["100.0 %", "0.0 %", "0.0 %"]),
        ({"V": "0.9999", "R": "0", "U": "0.0001"}, ["99.9 %", "0.0 %", "0.1 %"]),
    ],
)
def test_percentages_add_up_and_say_no_more_than_is_proved(shares, expected):
    assert list(percents(shares, "U").values()) == expected


@pytest.fixture(scope="module")
def in_coq(found):
    """The findings, where Coq has decided H1 and H7, by a certificate of another name, alone."""
    known = {"H1": Accepted("horseshoe.json", ("one", "two")), "H7": Accepted("a.json", ("three",))}
    return replace(found, claims=tuple(replace(x, coq=known.get(x.id)) for x in found.claims))


@pytest.mark.slow
def test_the_column_of_coq_in_markdown(in_coq):
    text = ledger(in_coq)
    ticked = re.findall(r"^\| \[(\w+)\]\(#\w+\) \| [^|]* \| ✓ \|", text, re.MULTILINE)
    assert ticked == ["H1", "H7"] and text.count("In Coq:") == 2
    said = text.partition('<a id="H7"></a>H7')[2].partition("###")[0]
    assert "In Coq: `three`, by `python -m proofs formal reports/a.json`." in said
    assert "`one`, `two`, by `python -m proofs formal reports/horseshoe.json`." in text


@pytest.mark.slow
def test_the_page_says_which_claims_coq_has(in_coq):
    html = pytest.importorskip("proofs.report.html")
    text = html.page(in_coq, [], {})
    assert "too: 2 claims." in text and text.count("<dt>proved by Coq</dt>") == 2
    claim = text.partition('<details class="claim" id="H1"')[2].partition("</details>")[0]
    assert ">Coq</span>" in claim.partition("</summary>")[0]
    other = text.partition('<details class="claim" id="H2"')[2].partition("</summary>")[0]
    assert "Coq" not in other

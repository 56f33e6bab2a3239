"""The page in headless Chromium: quiet, nothing loaded, and what a reader does with it works."""

import json
import shutil
import subprocess

import pytest

from tests.proofs.report.conftest import REPORTS

pytestmark = pytest.mark.slow


@pytest.fixture
def view(visit):
    """Open the page, in the width and colours asked for."""
    return lambda place="", **look: visit(REPORTS / "index.html", place, **look)


def shown(tab):
    return tab.eval_on_selector_all(
        ".claim", "all => all.filter(x => x.checkVisibility()).map(x => x.id)"
    )


def test_search_and_filters_show_what_fits(view):
    tab = view()
    everything = shown(tab)
    assert len(everything) == len(json.loads((REPORTS / "ledger.json").read_text())["claims"])
    tab.fill("[name=query]", "h2")
    assert shown(tab) == ["H2"]
    tab.fill("[name=query]", "Hausdorff dimension")
    found = shown(tab)
    assert {"H12", "H13"} <= set(found) and len(found) < 20
    tab.fill("[name=query]", "dimension")
    assert shown(tab)[0] == "H13" and tab.evaluate("CSS.highlights.get('found').size") > 20
    tab.fill("[name=query]", "omega_n")
    assert {"M1", "S7"} <= set(shown(tab))  # as it is spelt in ASCII
    tab.fill("[name=query]", "I0")
    assert "H1" in shown(tab) and "M1" not in shown(tab)
    tab.fill("[name=query]", "xyzzy")
    assert shown(tab) == [] and tab.is_visible(".nothing")
    tab.click(".nothing button")
    assert shown(tab) == everything
    tab.uncheck("[value=VERIFIED]", force=True)
    assert shown(tab) == tab.eval_on_selector_all(
        ".claim:not([data-verdict=VERIFIED])", "all => all.map(x => x.id)"
    )
    tab.select_option("[name=section]", "3.1")
    assert shown(tab) == ["H2", "H5", "H7"]
    assert tab.text_content("output") == "3 of 83 claims of the paper"


def test_a_deep_link_opens_what_it_names_whatever_is_filtered(view):
    tab = view("#H7")
    assert tab.eval_on_selector_all("details[open]", "all => all.map(x => x.id)") == ["H7"]
    assert tab.locator("#H7").bounding_box()["y"] < 400
    tab.fill("[name=query]", "M1")
    tab.evaluate("location.hash = '#H2.2'")
    tab.wait_for_function("document.getElementById('H2').open")
    assert tab.is_visible("[id='H2.2']")
    box = tab.locator("[id='H2.2']").bounding_box()
    assert 0 <= box["y"] < 900


def test_a_lower_case_link_and_no_formula_cut_off(view):
    tab = view("#h13", width=390)
    assert tab.get_attribute("#H13", "open") is not None
    wide = "all => all.filter(x => x.scrollWidth > x.clientWidth + 1).length"
    assert tab.eval_on_selector_all("#H13 .formula", wide) == 0


def test_the_counts_lead_to_the_claims(view):
    tab = view()
    tab.click("[data-only=REFUTED]")
    verdicts = {tab.get_attribute(f"#{each}", "data-verdict") for each in shown(tab)}
    assert verdicts == {"REFUTED"}


def test_all_claims_open_and_close(view):
    tab = view()
    tab.click("[name=open]")
    assert tab.locator(".claim[open]").count() == tab.locator(".claim").count()
    tab.click("[name=open]")
    assert tab.locator(".claim[open]").count() == 0


def test_the_keyboard_is_enough(view):
    tab = view()
    tab.keyboard.press("Tab")
    assert tab.evaluate("document.activeElement.className") == "skip"
    tab.keyboard.press("Enter")
    tab.focus("#M1 > summary")
    tab.keyboard.press("Enter")
    assert tab.get_attribute("#M1", "open") is not None


@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_is_wider_than_the_screen_even_with_all_open(view, width):
    tab = view(width=width, colours="dark" if width == 390 else "light")
    tab.evaluate("document.querySelectorAll('details').forEach(each => each.open = true)")
    assert tab.evaluate("document.documentElement.scrollWidth") <= width
    hidden = "x => x.getBoundingClientRect().right > innerWidth + 1 && !x.closest("
    hidden += "'.scroll, .formula, .steps li, .hidden, svg')"
    outside = tab.eval_on_selector_all(
        "main *", f"all => all.filter({hidden}).map(x => x.outerHTML.slice(0, 80))"
    )
    assert outside == []


@pytest.mark.long
@pytest.mark.parametrize("colours", ["light", "dark"])
def test_axe_finds_nothing_serious(view, colours, axe):
    tab = view("#H7", colours=colours)
    tab.evaluate("document.querySelectorAll('#S3, #S3 details').forEach(x => x.open = true)")
    assert serious(tab, axe) == []


@pytest.mark.long
@pytest.mark.parametrize("colours", ["light", "dark"])
@pytest.mark.parametrize("asked", ["attractor", "horseshoe"])
def test_axe_finds_nothing_serious_in_an_atlas(visit, asked, colours, axe):
    tab = visit(REPORTS / "atlas" / asked / "atlas.html", colours=colours)
    tab.focus("#map")
    assert serious(tab, axe) == []


def serious(tab, axe):
    """What the checker of accessibility finds."""
    tab.evaluate(axe)
    found = tab.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    bad = [x for x in found if x["impact"] in ("serious", "critical")]
    return [(x["id"], x["nodes"][0]["html"][:200]) for x in bad]


@pytest.fixture(scope="module")
def axe(tmp_path_factory):
    """The checker of accessibility, if npm can give it."""
    if shutil.which("npm") is None:
        pytest.skip("no npm")
    folder = tmp_path_factory.mktemp("axe")
    command = ["npm", "pack", "axe-core@4"]
    packed = subprocess.run(
        command, check=False, cwd=folder, capture_output=True, text=True, timeout=60
    )
    if packed.returncode:
        pytest.skip(f"npm gives no axe-core: {packed.stderr[-200:]}")
    shutil.unpack_archive(folder / packed.stdout.split()[-1], folder)
    return (folder / "package" / "axe.min.js").read_text()

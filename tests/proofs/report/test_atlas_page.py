"""The page of an atlas in headless Chromium: a cell says what the store says of it."""

import random

import pytest

from proofs.commands import atlas
from proofs.plane import summary
from proofs.plane.store import opened
from proofs.trusted.numbers import show_range
from tests.proofs.plane.test_page import CUT as REGION
from tests.proofs.plane.test_page import cells as some_cells

pytestmark = pytest.mark.slow
SAYS = "#cell .says"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The page about a region of four parts, and its cells by key."""
    folder, cells = tmp_path_factory.mktemp("atlas"), list(some_cells(REGION, 2, random.Random(5)))
    with opened(folder, REGION) as store:
        store.put(cells)
        atlas._draw(folder, store, summary.summary(store))
    assert {cell.verdict for cell in cells} == {"VERIFIED", "REFUTED", "UNDECIDED"}
    return folder / "atlas.html", {cell.key: cell for cell in cells}


def box_told(cell):
    eta, nu = map(show_range, REGION.sides(cell.key))
    return f"η in {eta}\nν in {nu}"


def told_of(cell):
    why = f"Neither proved nor refuted: {cell.conclusion}."
    return why if cell.verdict == "UNDECIDED" else cell.conclusion


def says(tab, cell):
    assert tab.inner_text("#cell .box") == box_told(cell)
    assert tab.inner_text(SAYS) == told_of(cell)
    assert tab.inner_text("#cell .chip").lower() == cell.verdict.lower()


def middle(cell):
    box = REGION.subject.at(REGION.sides(cell.key))
    return float(sum(box.eta)) / 2, float(sum(box.nu)) / 2


def on_screen(tab, eta, nu):
    """The point of the map at these numbers."""
    tab.locator("#map").scroll_into_view_if_needed()
    box = tab.locator("#map svg").bounding_box()
    shares = (
        (eta - float(REGION.first[0])) / float(REGION.first[1] - REGION.first[0]),
        (nu - float(REGION.second[0])) / float(REGION.second[1] - REGION.second[0]),
    )
    return box["x"] + shares[0] * box["width"], box["y"] + (1 - shares[1]) * box["height"]


def test_every_cell_that_is_pointed_at_says_what_is_proved_in_it(visit, made):
    path, cells = made
    tab = visit(path)
    for cell in cells.values():
        tab.mouse.move(*on_screen(tab, *middle(cell)))
        says(tab, cell)


def test_a_click_keeps_a_cell_until_the_next(visit, made):
    path, cells = made
    tab = visit(path)
    first, *_, last = cells.values()
    tab.mouse.click(*on_screen(tab, *middle(first)))
    tab.mouse.move(*on_screen(tab, *middle(last)))
    says(tab, first)
    tab.mouse.click(*on_screen(tab, *middle(last)))
    says(tab, last)
    tab.keyboard.press("Escape")
    tab.mouse.move(*on_screen(tab, *middle(first)))
    says(tab, first)


def test_the_keyboard_goes_from_cell_to_cell_and_over_the_cuts(visit, made):
    path, cells = made
    tab = visit(path)
    for _ in range(12):
        tab.keyboard.press("Tab")
        if tab.evaluate("document.activeElement.id") == "map":
            break
    seen = []
    for key in ["ArrowRight"] * 9 + ["ArrowLeft"] * 9 + ["ArrowDown"] * 9 + ["ArrowUp"] * 9:
        tab.keyboard.press(key)
        seen.append(tab.inner_text("#cell .box"))
    known = {box_told(cell) for cell in cells.values()}
    assert len(known.intersection(seen)) > 8
    right, left, low, high = seen[8], seen[17], seen[26], seen[-1]
    assert "1.1]" in right and "[0.9," in left and "[-1/3" in low and "0.1]" in high
    tab.keyboard.press("+")
    assert tab.get_attribute("#map svg", "viewBox").split()[2] == "500"
    tab.keyboard.press("0")
    assert tab.get_attribute("#map svg", "viewBox") == "0 0 1000 1000"


def test_numbers_and_links_lead_to_a_cell(visit, made):
    path, cells = made
    tab, cell = visit(path), next(iter(cells.values()))
    eta, nu = middle(cell)
    tab.fill("[name=eta]", f"{eta:.6f}")
    tab.fill("[name=nu]", f"{nu:.6f}")
    tab.keyboard.press("Enter")
    says(tab, cell)
    says(visit(path, tab.evaluate("location.hash")), cell)
    tab.fill("[name=eta]", "7")
    tab.keyboard.press("Enter")
    assert "No cell is at these numbers" in tab.inner_text("#cell")
    tab.fill("[name=eta]", "x")
    tab.keyboard.press("Enter")
    assert "No cell is at these numbers" in tab.inner_text("#cell")


def test_the_picture_needs_no_script(visit, made):
    path, _ = made
    tab = visit(path, java_script_enabled=False)
    assert tab.locator("#map svg [data-kind=AtRest] path").count() > 0
    assert "every motion comes to rest" in tab.inner_text(".legend")
    assert "needs none" in tab.inner_text("#cell")


@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_is_wider_than_the_screen(visit, made, width):
    tab = visit(made[0], width=width, colours="dark")
    assert tab.evaluate("document.documentElement.scrollWidth") <= width

"""The lecture on the real page."""

import pytest
from playwright.sync_api import Locator, Page, expect
from test_session_page import design_in_address
from watched import Visit

from explorer.story.steps import STEPS

FIGURES = '[data-explorer="figures"] b'
LONG = 600_000
"""[ms] for the numbers of a step on a machine where much else runs."""


def stands_at(page: Page, step: int) -> None:
    """A step stands, and its numbers have come."""
    page.wait_for_selector(f'[data-explorer="lecture"][data-step="{step}"]')
    page.wait_for_function(
        "k => RX.state.steps[k].control.words.length > 0", arg=step - 1, timeout=LONG
    )


def section(page: Page, step: int) -> Locator:
    return page.locator(f'.rxs-list > [data-step="{step}"]')


@pytest.mark.slow
def test_the_lecture_asks_answers_and_gives_the_design_back(visit: Visit):
    watched = visit()
    page = watched.page
    watched.drawer("lecture")
    watched.type("Adv. ratio", 0.22)
    own = "d=1;uh60a;mu=0.22"
    design_in_address(watched, own)
    page.get_by_role("button", name="Start the lecture").click()
    stands_at(page, 1)
    page.wait_for_function("() => !location.search.includes('mu=')")
    page.get_by_role("button", name="Next").click()
    stands_at(page, 2)
    design_in_address(watched, "linear:-16;mu=0")
    watched.answered()
    figures = page.locator(FIGURES)
    assert figures.all_inner_texts() == ["?", "?", "?"]  # Nothing is told before the guess.
    assert page.evaluate("() => RX.state.lecture.answer") is None
    section(page, 2).locator(".rxs-guess button").first.click()
    page.wait_for_function("() => RX.state.lecture.answer")
    watched.answered()
    told = figures.all_inner_texts()
    assert all(any(character.isdigit() for character in one) for one in told)
    # The right answer, and the word on the guess.
    assert section(page, 2).locator("[data-right]").count() == 2
    slider = section(page, 2).locator("[data-stop]")
    slider.press("End")
    design_in_address(watched, "linear:-24;mu=0")
    watched.answered()
    assert figures.all_inner_texts()[0] == told[0]  # A has no twist, whatever B has,
    assert figures.all_inner_texts()[1] != told[1]  # and B another.
    page.get_by_role("button", name="Back", exact=True).click()
    stands_at(page, 1)
    page.keyboard.press("PageDown")
    stands_at(page, 2)
    expect(section(page, 2).locator("[data-chosen]")).to_have_count(1)  # A guess is made once.
    page.evaluate("k => RX.send('story', k)", len(STEPS) - 1)
    page.wait_for_function("() => RX.state.bar.mode === 'actuate'")
    # The step has them.
    expect(page.locator(".rxf-stage :is(input[type=range], [data-fly]):visible")).to_have_count(0)
    page.get_by_role("button", name="End", exact=True).click()
    page.wait_for_selector('[data-explorer="lecture"]', state="hidden")
    design_in_address(watched, own)  # The visitor's own design is back.
    page.wait_for_function("() => RX.state.bar.mode === 'explore'")
    page.locator('[data-explorer="figures"]').wait_for(state="hidden")
    watched.drawer("settings")
    page.get_by_label("Big type").check()
    page.wait_for_function(
        """() => parseFloat(getComputedStyle(document.querySelector('[data-explorer="drawer"]')).fontSize) > 16"""
    )


@pytest.mark.slow
def test_a_scroll_by_hand_is_a_step_and_a_new_layout_none(visit: Visit):
    watched = visit()
    page = watched.page
    page.keyboard.press("t")
    page.wait_for_selector('[data-explorer="lecture"][data-step="1"]')
    watched.answered()
    page.locator(".rxs-list").hover()
    page.mouse.wheel(
        0, page.evaluate("() => document.querySelector('.rxs-list').children[2].offsetTop")
    )
    page.wait_for_selector('[data-explorer="lecture"][data-step="3"]')
    design_in_address(watched, "inflow=pitt-peters")
    page.evaluate("() => RX.send('story', 3)")
    at_its_place = """() => {
        const list = document.querySelector('.rxs-list'), step = list.children[3];
        return !step.inert && Math.abs(list.scrollTop - step.offsetTop) < 2;
    }"""
    page.wait_for_function(at_its_place)
    for size in ((820, 1100), (1500, 940), (1180, 640)):
        page.set_viewport_size({"width": size[0], "height": size[1]})
        page.wait_for_function(f"wide => innerWidth === wide && ({at_its_place})()", arg=size[0])
        watched.answered()
        page.wait_for_function(at_its_place)
    # What scrolls the column by itself, as a focus does, asks for no step and does not last.
    page.evaluate("() => { document.querySelector('.rxs-list').scrollTop = 0; }")
    page.wait_for_function(at_its_place)
    watched.answered()
    assert page.evaluate("() => RX.state.lecture.at") == 3

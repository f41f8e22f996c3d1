"""The line on top: its numbers are dragged, set by key and read out, and move what their sliders move."""

import re

import pytest
from watched import LARGE, MEDIUM, Visit, Watched

from explorer.app import App

WINDOWS = {"desk": [LARGE, MEDIUM], "sheet": [(390, 844), (844, 390), (812, 734)]}
"""Sizes of one page; its numbers are dragged at the first."""
FITS = """name => {
    const {left, width, top, height} = document.querySelector(name).getBoundingClientRect();
    const met = document.elementFromPoint(left + width / 2, top + height / 2)?.closest('[data-slide]')?.dataset.slide;
    return [...[document.querySelector('.rxf-line'), document.querySelector('canvas')].map(e => {
        const {left, right, top, bottom} = e.getBoundingClientRect(), style = getComputedStyle(e);
        const rows = (e.clientHeight - 2 * parseFloat(style.paddingTop)) / parseFloat(style.lineHeight);
        return [left, right, top, bottom, e.scrollWidth - e.clientWidth, Math.round(rows)];
    }), met];
}"""
"""Boxes of line and canvas, and which number a pointer meets in the middle of this one."""


def numbers(watched: Watched) -> dict[str, list[str | None]]:
    """Of each number of the line its label, place and words."""
    return watched.page.evaluate(
        """() => Object.fromEntries([...document.querySelectorAll('.rxf-line [data-slide]')].map(e =>
            [e.dataset.slide, ['label', 'valuenow', 'valuetext'].map(name => e.getAttribute(`aria-${name}`))]))"""
    )


def fits(watched: Watched, sizes: list[tuple[int, int]], dragged: str) -> None:
    """At each size the line has the width of the window, few rows and the scene below it."""
    for width, height in reversed(sizes):
        watched.page.set_viewport_size({"width": width, "height": height})
        box, canvas, met = watched.at_rest(
            lambda: watched.page.evaluate(FITS, f"[data-slide='{dragged}']")
        )
        assert (box[0], box[1], box[4], abs(canvas[2] - box[3]) < 2) == (0, width, 0, True), (
            width,
            height,
        )
        # A telephone has no room for the longest sentence in two.
        assert box[5] <= (3 if width < 480 and dragged.startswith("drive") else 2), (width, height)
        assert met == dragged, (width, height)


@pytest.mark.parametrize("sizes", WINDOWS.values(), ids=WINDOWS)
def test_numbers_of_the_line_move_their_sliders_in_every_mode(
    visit: Visit, sizes: list[tuple[int, int]]
):
    watched = visit(size=sizes[0])
    page = watched.page
    watched.answered()
    as_built = watched.text("line")
    assert numbers(watched).keys() == {"mass_t", "advance_ratio", "built_outer"}
    # Tab goes from one to the next; a key is a step of the slider, and one press of undo takes it back.
    page.locator("[data-slide=mass_t]").focus()
    page.keyboard.press("Tab")
    assert page.evaluate("() => document.activeElement.dataset.slide") == "advance_ratio"
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement.dataset.slide") == "advance_ratio"
    watched.answered()
    assert numbers(watched)["advance_ratio"] == ["Adv. ratio µ", "0.205", "0.205"]
    assert watched.number("Adv. ratio") == 0.205
    page.keyboard.press("Control+z")
    watched.until(lambda: watched.text("line").split(" ±")[0] == as_built.split(" ±")[0])
    # A drag with a pause is one step too; what is said meanwhile is that of the sliders.
    for place, dragged in (
        ("explore", "built_outer"),
        ("optimise", "mass_t"),
        ("actuate", "drive 0"),
    ):
        if place != "explore":
            watched.mode(place)
            watched.answered()
        before, name = numbers(watched)[dragged][1], f"[data-slide='{dragged}']"
        power = watched.text("total-power")
        x, y = watched.middle(name)
        watched.hold(x, y)
        page.mouse.move(x + 40, y, steps=4)
        if place == "explore":
            page.wait_for_timeout(1500)
        page.mouse.move(x + 120, y, steps=4)
        page.mouse.up()
        watched.answered()
        after = float(numbers(watched)[dragged][1] or 0.0)
        assert after > float(before or 0.0)
        assert watched.text("total-power") != power
        fits(watched, sizes, dragged)
        label = {"built_outer": "Δ outboard", "mass_t": "Mass", "drive 0": "Voltage"}[dragged]
        if place != "optimise":
            assert watched.number(label) == pytest.approx(after)
        page.evaluate("() => document.activeElement.blur()")
        page.locator("[data-do=undo]").first.click()
        watched.until(
            lambda name=dragged, before=before: (
                numbers(watched).get(name, [None, None])[1] == before
            )
        )
    said = r"twist as built, with MFC P1 at 0\s%.* than without it \(\d+\), (sure|likely|unclear)"
    watched.reads("line", said)
    # Above it, the lecture says it too.
    watched.mode("explore")
    page.keyboard.press("t")
    page.wait_for_selector('[data-explorer="lecture"][data-step="1"]')
    watched.reads("line", r"^(The )?UH-60A of ")


def test_where_the_rail_still_stands_the_longest_sentence_has_two_rows(visit: Visit):
    """Another twist, altitude, an actuator by schedule whose limits are exceeded, and its estimated mass."""
    watched = visit(size=(861, 600))
    page = watched.page
    for name, place in (("built_outer", -2.0), ("altitude_m", 1200.0)):
        page.evaluate("to => RX.send('slide', to)", [name, place])
        watched.answered()
    watched.mode("actuate")
    page.evaluate("() => RX.send('slide', ['drive 0', 77])")
    watched.answered()
    page.evaluate("() => RX.send('state', 'schedule')")
    watched.reads("line", r" t at µ 0\.200, altitude 1.200 m, twist .*Δ 0\.0/−2\.0")
    watched.reads("exceeded", "; over 3 limits")
    said = watched.reads(
        "line", r"MFC P1 by schedule at .* needs .* than without it \(\d+\), .*estimated"
    )
    assert len(said) > 200
    fits(watched, [(861, 600)], "mass_t")


FAINT = """() => [...document.querySelectorAll('[data-answers]')].filter(e => e.checkVisibility()).map(e =>
    [e.dataset.explorer ?? e.dataset.part ?? '', Number(getComputedStyle(e).opacity)])"""
"""Of each answer on the page its name and how faint it is."""


def test_from_another_actuator_to_its_answer_all_numbers_have_one_mark(visit: Visit, app: App):
    """Line, card, tip twist, balance and rail alike, while what they name stays clear."""
    watched = visit(size=MEDIUM)
    page = watched.page
    watched.mode("actuate")
    watched.answered()
    with app.sessions[-1].page.context.whole:  # No update reads what is set.
        page.evaluate("() => RX.send('kind', 'AFC')")
        page.wait_for_selector("html[data-stale]", state="attached")
        page.wait_for_function(f"() => ({FAINT})().every(([name, opacity]) => opacity === .45)")
        marked = {name for name, _ in page.evaluate(FAINT)}
        assert marked >= {"total-power", "moved", "verdict", "tip-twist", "labels"}
        assert "with MFC P1 at" in watched.text("line")
    watched.reads("line", "with AFC at .* needs ")
    page.wait_for_selector("html:not([data-stale])", state="attached")
    page.wait_for_function(f"() => ({FAINT})().every(([name, opacity]) => opacity === 1)")


def test_touch_drags_and_a_refused_trim_is_said(visit: Visit):
    watched = visit(size=(390, 844))
    page = watched.page
    x, y = watched.middle("[data-slide=advance_ratio]")
    touch, finger = page.context.new_cdp_session(page), {"x": x, "y": y, "id": 0}
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [finger]})
    for _ in range(10):
        finger["x"] += 12
        touch.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [finger]})
        page.wait_for_timeout(40)
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    watched.answered()
    assert watched.number("Adv. ratio") > 0.2
    page.locator("[data-slide=mass_t]").press("End")
    watched.reads("line", r"^UH-60A of 11\.00 t")
    page.locator("[data-slide=advance_ratio]").press("End")
    said = watched.reads("line", r"^UH-60A of 11\.00 t at µ 0\.450 .* has no trim: ")
    assert not re.search(r"needs|kW", said)
    page.get_by_role("button", name="Nearest that trims").click()
    watched.reads("line", r" needs [\d\u2009]+ ± ")

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
    assert numbers(watched).keys() == {"mass_t", "advance_ratio", "airspeed", "built_outer"}
    # Tab goes from one to the next; a key is a step of the slider, and one press of undo takes it back.
    page.locator("[data-slide=mass_t]").focus()
    page.keyboard.press("Tab")
    assert page.evaluate("() => document.activeElement.dataset.slide") == "advance_ratio"
    page.keyboard.press("ArrowRight")
    assert page.evaluate("() => document.activeElement.dataset.slide") == "advance_ratio"
    watched.answered()
    assert numbers(watched)["advance_ratio"] == ["Adv. ratio µ", "0.205", "0.205"]
    assert numbers(watched)["airspeed"][2] == "163 km/h"
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


FOCUSED = "() => document.activeElement.dataset.handle ?? document.activeElement.tagName"
INSIDE = """() => {
    const values = document.querySelector('.rxf-values'), {left, right, top, bottom} = values.getBoundingClientRect();
    const met = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
    return left >= 0 && right <= innerWidth && top > 0 && bottom <= innerHeight && values.contains(met);
}"""
"""Whether what is open is wholly in the window, and above all else."""


def shown(watched: Watched) -> list[str]:
    """The lines of what is open below a word; none where nothing is."""
    if not watched.page.locator(".rxf-values").is_visible():
        return []
    return [line for line in watched.text("values").splitlines() if line]


def handle(watched: Watched, name: str) -> None:
    """Press a word of the line, as a pointer does."""
    watched.page.mouse.click(*watched.middle(f"[data-handle={name}]"))


def test_a_number_opens_its_slider_which_follows_and_keeps_its_bounds(visit: Visit):
    watched = visit(size=MEDIUM)
    page = watched.page
    watched.answered()
    handle(watched, "mass_t")
    assert shown(watched) == ["Mass", "8.32 t", "5.00 t", "11.00 t"]
    assert page.get_by_role("dialog", name="Mass").is_visible()
    assert page.evaluate(FOCUSED) == "INPUT"
    page.keyboard.press("End")
    page.keyboard.press("ArrowRight")  # Its slider ends there.
    watched.reads("line", r"^The UH-60A of 11\.00 t")
    assert shown(watched)[1] == "11.00 t"
    assert watched.number("Mass") == 11.0
    # Whatever moves it, what is open follows with the focus in it: undo, and a drag of the number in the line.
    page.keyboard.press("Control+z")
    watched.until(lambda: shown(watched)[1:2] == ["8.32 t"])
    assert page.evaluate(FOCUSED) == "INPUT"
    x, y = watched.middle("[data-handle=mass_t]")
    watched.drag(x, y, by=(-60, 0))
    watched.answered()
    mass = watched.number("Mass")
    assert mass < 8.0
    watched.until(lambda: shown(watched)[1:2] == [f"{mass:.2f} t"])
    # A press on the number closes it, and so do Enter, Escape and a press elsewhere.
    handle(watched, "mass_t")
    assert shown(watched) == []
    for key in ("Enter", "Escape"):
        page.keyboard.press("Enter")
        assert shown(watched)[0] == "Mass"
        page.keyboard.press(key)
        assert (shown(watched), page.evaluate(FOCUSED)) == ([], "mass_t")
    # Airspeed is the slider of the advance ratio, also where it leads to hover.
    handle(watched, "airspeed")
    assert shown(watched) == ["Airspeed", "159 km/h", "0 km/h", "358 km/h"]
    page.keyboard.press("ArrowRight")
    watched.answered()
    assert (watched.number("Adv. ratio"), shown(watched)[1]) == (0.205, "163 km/h")
    page.keyboard.press("Home")
    watched.reads("line", r" in hover ")
    assert shown(watched)[1] == "0 km/h"
    page.keyboard.press("End")
    watched.reads("line", r" at µ 0\.450 \(358 km/h\)")
    page.mouse.click(*watched.middle(".rxf-brand"))
    assert shown(watched) == []


def test_a_word_opens_its_menu_and_a_choice_is_one_step(visit: Visit):
    watched = visit(size=MEDIUM)
    page = watched.page
    watched.answered()
    as_built = watched.text("line")
    page.locator("[data-handle=law]").press("ArrowDown")
    assert page.get_by_role("listbox", name="Twist law").is_visible()
    assert shown(watched)[:3] == ["As built + two-segment change", "Linear", "Quadratic"]
    assert page.locator("[data-handle=law]").get_attribute("aria-expanded") == "true"
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    assert (shown(watched), page.evaluate(FOCUSED)) == ([], "law")
    watched.reads("line", r" with twist −12\.0\s°/R needs \d+ .* less than as built")
    assert watched.row("Twist concept").locator("input").first.input_value() == "Linear"
    handle(watched, "law")
    page.get_by_role("option", name="Two segments").click()
    watched.reads("line", r" with twist −14\.0/−8\.0\s°/R")
    watched.answered()
    # However soon they follow, choices are steps of their own.
    page.keyboard.press("Control+z")
    watched.reads("line", r" with twist −12\.0\s°/R")
    page.keyboard.press("Control+z")
    watched.reads("line", re.escape(as_built.split(" ±")[0]))
    page.keyboard.press("Enter")
    page.keyboard.press("End")
    page.keyboard.press("Escape")
    watched.answered()
    assert (shown(watched), page.evaluate(FOCUSED)) == ([], "law")
    assert watched.text("line").split(" ±")[0] == as_built.split(" ±")[0]


def test_the_link_keeps_what_is_compared_with(visit: Visit, app: App):
    watched = visit(size=MEDIUM)
    page = watched.page
    page.evaluate("() => RX.send('slide', ['built_outer', -2])")
    watched.answered()
    page.keyboard.press("m")
    watched.answered()
    page.evaluate("() => RX.send('slide', ['built_outer', -4])")
    watched.answered()
    handle(watched, "than")
    built, here, bookmark = shown(watched)
    assert (built, here) == ("as built", "this design: keep it as A")
    assert bookmark.startswith("bookmark: UH-60A as built + segments 0/−2 at 0.5")
    page.get_by_role("option", name=bookmark).click()
    watched.says("against", "A")
    watched.answered()
    assert "&a=1;uh60a~segments:0,-2@0.5" in page.url
    compared = watched.text("line")
    page.keyboard.press("Control+z")
    watched.says("against", "as built")
    page.keyboard.press("Control+Shift+z")
    watched.says("against", "A")
    watched.mode("actuate")
    page.wait_for_selector("[data-handle=than]")
    handle(watched, "than")
    page.get_by_role("option", name="best fixed blade").click()
    watched.reads("line", " than with the best fixed blade")
    handle(watched, "actuator")
    page.get_by_role("option", name="AFC: d33 fibres").click()
    watched.reads("line", r" with AFC at ")
    page.keyboard.press("Control+z")
    watched.reads("line", r" with MFC P1 at .* than with the best fixed blade")
    watched.answered()
    assert "&against=best-fixed" in page.url
    other = visit(query=page.url[len(app.address) :], size=MEDIUM)
    other.reads("line", r" with MFC P1 at .* than with the best fixed blade")
    other.mode("explore")
    other.until(lambda: other.text("line") == compared)


def test_the_mission_of_the_verdict_leads_to_its_hours(visit: Visit):
    watched = visit(size=LARGE)
    page = watched.page
    watched.mode("actuate")
    watched.reads("assessed", "over the mission")
    page.get_by_role("button", name="mission", exact=True).click()
    assert page.evaluate("() => document.activeElement.dataset.hours") == "0"
    page.keyboard.type("2")
    page.keyboard.press("Tab")
    watched.until(lambda: "&h=2,0.25,1,0.25" in page.url)


@pytest.mark.parametrize("mode", ["explore", "actuate"])
def test_what_opens_is_wholly_in_the_window_and_finger_high_on_a_telephone(visit: Visit, mode: str):
    watched = visit(size=MEDIUM)
    page = watched.page
    page.evaluate("() => RX.send('slide', ['built_outer', -2])")
    watched.mode(mode)
    page.wait_for_selector("[data-handle=than]")
    names = ["mass_t", "advance_ratio", "law", "built_outer", "than"]
    names += ["actuator", "drive 0"] if mode == "actuate" else []
    for width, height in ((1500, 940), (1366, 650), (861, 481), (390, 844)):
        page.set_viewport_size({"width": width, "height": height})
        watched.answered()
        for name in names:
            page.locator(f"[data-handle='{name}']").focus()
            page.keyboard.press("Enter")
            assert shown(watched) != [], name
            assert page.evaluate(INSIDE), (width, height, name)
            if width < 480:
                sizes = page.evaluate(
                    "() => [...document.querySelectorAll('.rxf-values :is(button, input)')].map(e => e.offsetHeight)"
                )
                assert min(sizes) >= 44
            page.keyboard.press("Escape")


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

"""Nothing lies behind or over anything and all can be read, at the sizes of desks, tablets and telephones, in each
mode."""

from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect
from watched import LARGE, ON_SCREEN, WAIT, Visit, Watched

MEASURE, LEGIBLE = (
    (Path(__file__).parent / f"{name}.js").read_text(encoding="utf-8")
    for name in ("overlaps", "legible")
)
CLEAN: dict[str, Any] = {
    **{name: [] for name in ("hit", "outside", "hidden", "nameless", "cut", "small", "faint")}, "wide": 0
}  # fmt: skip
LEAST = {
    "desk": {(1280, 720): 400, (1180, 820): 360, (1500, 940): 600, (1920, 1080): 600},
    "sheet": {(390, 844): 370, (820, 1180): 500},
}
"""Width of the plan's disk [px] at each size of one page: one with a sheet opens with it."""
SMALL = [(390, 844), (844, 390), (812, 734), (768, 1024)]
MODES = ("explore", "optimise", "actuate", "lecture")
LEAST_SHARE = 0.36
"""Width of the disk's rim, in Actuate of the blade, over that of the window."""
# Where the rim of the disk is, or the ends of the lifted blade: [left, right, top, bottom].
SUBJECT = """name => {
    const {camera, canvas, nodeRefFromName: nodes} = __viserMutable, box = canvas.getBoundingClientRect(), at = [];
    let mesh = null;
    nodes[name].traverse(part => { if (part.isMesh) mesh ??= part; });
    mesh.geometry.computeBoundingBox();
    const {min, max} = mesh.geometry.boundingBox, middle = min.clone().add(max).divideScalar(2);
    for (let k = 0; k < 36; k++) {
        const point = middle.clone(), turn = Math.PI * k / 18;
        point.x += 0.475 * (max.x - min.x) * Math.cos(turn);
        point.y += 0.475 * (max.y - min.y) * Math.sin(turn);
        const {x, y} = point.applyMatrix4(mesh.matrixWorld).project(camera);
        at.push([box.left + (x + 1) / 2 * box.width, box.top + (1 - y) / 2 * box.height]);
    }
    const [xs, ys] = [0, 1].map(k => at.map(point => point[k]));
    return [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
}"""
# How many masses are named at the blade, and what is behind the dots of the schedule's key.
LIFTED = """() => [[...document.querySelectorAll('.rxf-label[data-kind=lifted]')].filter(label =>
    label.checkVisibility({opacityProperty: true, visibilityProperty: true})).length,
    getComputedStyle(document.querySelector('.rxf-fly [data-key=reached]'), '::before').backgroundColor]"""
TOTAL = "() => RX.state.line.pieces.find(piece => piece.part === 'total-power')?.text"


def found(watched: Watched) -> tuple[dict[str, Any], int]:
    """What is wrong once nothing is stale, and the width of the plan's disk [px]."""
    page = watched.page
    look = f"""() => ({{...({MEASURE})(), ...({LEGIBLE})(),
        stale: Boolean(document.querySelector('[data-stale]'))}})"""
    now: dict[str, Any] = {"stale": True}
    while now["stale"]:  # A search that runs makes numbers stale again at any time.
        page.wait_for_function("() => !document.querySelector('[data-stale]')", timeout=4 * WAIT)
        now = watched.at_rest(lambda: page.evaluate(look))
    return {name: now[name] for name in CLEAN}, now["disk"] or 0


@pytest.mark.slow
@pytest.mark.parametrize("least", LEAST.values(), ids=LEAST)
def test_nothing_lies_over_anything(visit: Visit, least: dict[tuple[int, int], int]):
    watched = visit(size=next(iter(least)))
    watched.quiet()
    page = watched.page

    def clean(state: str) -> None:
        for width, height in least:
            page.set_viewport_size({"width": width, "height": height})
            faults, disk = found(watched)
            assert faults == CLEAN, (state, width, height)
            assert state != "disk" or disk >= least[width, height], (width, height)
            if state == "actuate" and width > 1200:
                page.wait_for_selector(".rxf-fly [data-key=reached]", timeout=4 * WAIT)
                assert watched.at_rest(lambda: page.evaluate(LIFTED)) == [4, "rgba(0, 0, 0, 0)"]

    clean("explore")
    page.locator("[data-do=view][data-value=disk]").click()
    page.wait_for_function("() => RX.state.plan?.values")
    clean("disk")
    page.locator("[data-do=view][data-value='3d']").click()
    for mode in ("optimise", "actuate"):
        watched.mode(mode)
        page.wait_for_function(
            "() => document.documentElement.dataset.mode !== 'actuate' || RX.state.earns"
        )
        clean(mode)
    for drawer in ("share", "lecture"):
        watched.drawer(drawer)
        clean(drawer)


def lines_of_sizes() -> list[tuple[int, int]]:
    """Windows of laptops and of zoomed pages, every 80 px: the lowest ones, the narrowest ones, and between them."""
    widths, heights = [*range(861, 1536, 80), 1536], [*range(481, 940, 80), 940]
    between = [(width, 481 + round(459 * (width - 861) / 675)) for width in widths[1:]]
    return [
        *((width, 481) for width in widths),
        *((861, height) for height in heights[1:]),
        *between,
    ]


def begin(watched: Watched, mode: str) -> None:
    """Choose a mode in a narrow window, where it brings its controls along."""
    page = watched.page
    if mode == "lecture":
        watched.mode("explore")
        watched.drawer("lecture")
        page.get_by_role("button", name="Start the lecture").click()
        page.wait_for_selector("html[data-lecture]", state="attached")
    elif mode != "explore":
        watched.mode(mode)
    if mode == "actuate":
        page.wait_for_selector("html[data-assessed]", state="attached", timeout=4 * WAIT)
    watched.answered()


@pytest.mark.slow
def test_the_rotor_has_room_at_all_sizes_in_all_modes(visit: Visit):
    watched = visit(size=(861, 481))
    watched.quiet()
    page = watched.page
    look = f"name => [({SUBJECT})(name), ({MEASURE})().hit]"
    for mode in MODES:
        page.set_viewport_size({"width": 861, "height": 481})
        begin(watched, mode)
        name = "/lifted/skin" if mode == "actuate" else "/rotor/disk/field"
        for width, height in lines_of_sizes():
            page.set_viewport_size({"width": width, "height": height})
            page.wait_for_function("wide => innerWidth === wide", arg=width)
            (left, right, top, bottom), hit = watched.at_rest(
                lambda name=name: page.evaluate(look, name)
            )
            assert hit == [], (mode, width, height)
            if mode == "explore":
                assert watched.box(".rxp-curve")["height"] >= 90.0, (width, height)
            assert right - left >= LEAST_SHARE * width, (mode, width, height)
            assert 0 < left < right < width, (mode, width, height)
            assert 0 < top < bottom < height, (mode, width, height)


def test_a_press_on_the_disk_opens_its_section_and_moves_nothing(visit: Visit):
    watched = visit(size=(1366, 650))
    watched.quiet()
    page = watched.page

    def rim() -> list[float]:
        return watched.at_rest(lambda: page.evaluate(SUBJECT, "/rotor/disk/field"))

    for width, height in ((1366, 650), (1680, 1000)):
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_function("wide => innerWidth === wide", arg=width)
        watched.answered()
        before = rim()
        left, right, top, bottom = before
        page.mouse.click(left + 0.6 * (right - left), top + 0.6 * (bottom - top))
        page.wait_for_function("() => RX.state.bar.drawer === 'probe'")
        watched.answered()
        assert rim() == pytest.approx(before, abs=1.5), (width, height)
        page.keyboard.press("Escape")
        page.wait_for_function("() => !RX.state.bar.drawer")


def test_the_chart_of_power_shows_the_bowl_and_all_of_it_on_demand(visit: Visit):
    watched = visit(size=LARGE)
    page = watched.page
    chart, button = (
        page.locator("[data-name=power]"),
        page.locator("[data-name=power] [data-page=scale]"),
    )
    page.wait_for_function("() => RX.state.strip?.[0].chart.y.whole?.range[1] >= 3000")

    def numbers() -> list[float]:
        """Of the axis, from below."""
        texts = chart.locator("svg text[text-anchor=end]").all_text_contents()
        return [float(text) for text in texts if text.replace(".", "").isdigit()]

    near = numbers()
    assert near[0] > 500.0
    assert 2 <= len(near) <= 5
    button.focus()
    page.keyboard.press("Enter")
    watched.until(lambda: numbers()[0] == 0.0)
    assert numbers()[-1] >= 3000.0
    assert (
        button.evaluate("button => button === document.activeElement && button.ariaPressed")
        == "true"
    )
    chart.locator("svg").dblclick(position={"x": 200, "y": 30})
    watched.until(lambda: numbers() == near)


def test_a_large_screen_has_large_type_charts_and_rail(visit: Visit):
    watched = visit(size=(2560, 1440))
    page = watched.page
    assert found(watched)[0] == CLEAN
    assert (
        page.locator(".rxf-chart > svg").first.evaluate("e => e.getBoundingClientRect().height")
        > 220.0
    )
    assert (
        page.locator("[data-dock-region=right]").evaluate("e => e.getBoundingClientRect().width")
        > 480.0
    )
    assert (
        page.evaluate(
            "() => parseFloat(getComputedStyle(document.querySelector('.rxf-line')).fontSize)"
        )
        > 24.0
    )
    # What is dragged in a drawing that has grown stays under the pointer.
    knot = "[data-knot]:last-of-type [data-reach]"
    x, y = watched.middle(knot)
    watched.hold(x, y)
    page.mouse.move(x, y - 30.0, steps=4)
    watched.until(lambda: watched.middle(knot)[1] < y - 27.0)
    assert watched.middle(knot)[1] == pytest.approx(y - 30.0, abs=3.0)
    page.mouse.up()


def has_room(watched: Watched, subject: str, height: int) -> None:
    """Nothing lies over 45 % of the window's height, what is looked at lies within, and a finger meets all controls."""
    look = f"() => {{ const all = ({MEASURE})(); return [all.free, all.narrow, all.hit, ({LEGIBLE})().small]; }}"
    free, narrow, clean, unread = watched.at_rest(lambda: watched.page.evaluate(look))
    left, right, top, bottom = watched.at_rest(lambda: watched.page.evaluate(SUBJECT, subject))
    assert free["bottom"] - free["top"] >= 0.45 * height
    assert (narrow, clean, unread) == ([], [], [])
    assert free["left"] - 2 <= left < right <= free["right"] + 2
    assert free["top"] - 2 <= top < bottom <= free["bottom"] + 2


@pytest.mark.slow
def test_a_telephone_and_a_tablet_show_the_rotor(visit: Visit):
    """One page, turned and resized in each mode."""
    watched = visit(size=SMALL[0])
    watched.quiet()
    page = watched.page
    for mode in ("actuate", "optimise", "explore"):
        watched.mode(mode)
        for width, height in SMALL:
            page.set_viewport_size({"width": width, "height": height})
            for tab in ("controls", "charts"):
                if (
                    page.locator(f".rxf-grip [data-page={tab}]").get_attribute("aria-expanded")
                    == "false"
                ):
                    page.locator(f".rxf-grip [data-page={tab}]").click()
                has_room(
                    watched, "/lifted/skin" if mode == "actuate" else "/rotor/disk/field", height
                )
            for card in (
                (".rxf-fly", ".rxf-earns") if mode == "actuate" and min(width, height) > 480 else ()
            ):
                box = watched.box(card)
                assert box["y"] + box["height"] <= height  # On a tablet the whole of both.
            assert page.evaluate("() => document.querySelector('canvas').clientWidth") >= width / 2
    for size in SMALL:
        page.set_viewport_size({"width": size[0], "height": size[1]})
        held_by_a_finger(watched, size)


def held_by_a_finger(watched: Watched, size: tuple[int, int]) -> None:
    """A finger takes the tip: the stage is the blade, the disk and the scale of power; a second one takes it back."""
    page = watched.page
    x, y = watched.at_rest(lambda: page.evaluate(ON_SCREEN, 7.2))
    finger, touch = {"x": x, "y": y, "id": 0}, page.context.new_cdp_session(page)
    power = page.evaluate(TOTAL)
    touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [finger]})
    for _ in range(9):
        finger["y"] += 4
        page.wait_for_timeout(60)
        touch.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [finger]})
    page.wait_for_function(
        "() => RX.state.hand && document.querySelector('.rxf-twisting').style.getPropertyValue('--rx-shown') === '1'"
    )
    watched.until(lambda: page.evaluate(TOTAL) != power)
    page.wait_for_function("() => RX.part('twisting').textContent.includes('second finger')")
    stage = """() => [[...document.querySelectorAll('.rxf-stage > *')]
            .filter(e => e.checkVisibility({opacityProperty: true, visibilityProperty: true}) && e.innerHTML.trim())
            .map(e => e.dataset.part), document.querySelectorAll('.rxf-plan text').length,
            ...['.rxf-twisting', '.rxf-plan circle'].map(name =>
            document.querySelector(name).getBoundingClientRect())]"""
    shown, words, blade, disk = watched.at_rest(lambda: page.evaluate(stage))
    assert (shown, words) == (["plan", "twisting"], 0)
    assert (blade["width"], blade["height"]) == size  # Over the bar and the sheet.
    assert disk["height"] >= 0.4 * min(size)
    touch.send(
        "Input.dispatchTouchEvent",
        {"type": "touchStart", "touchPoints": [finger, {"x": 40, "y": 60, "id": 1}]},
    )
    page.wait_for_function(
        "() => !RX.state.twisting && !document.documentElement.hasAttribute('data-twisting')"
    )
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    watched.answered()
    assert page.evaluate(TOTAL) == power


@pytest.mark.slow
def test_a_ride_on_a_telephone_shows_blade_and_card(visit: Visit):
    watched = visit(size=(390, 844))
    page = watched.page
    page.evaluate("() => RX.send('ride', [0.85, 20])")
    card = page.locator("[data-explorer=ride]")
    card.locator("b").wait_for()
    top = watched.box(card)["y"]
    watched.until(lambda: 120 < page.evaluate(ON_SCREEN, 0.85 * 8.18)[1] < top - 40)
    assert top > 0.6 * 844
    page.keyboard.press("Escape")
    page.wait_for_function("() => !RX.state.ride")
    watched.until(lambda: watched.box(page.locator(".rxf-grip"))["y"] < 700)


def test_the_sheet_is_pulled_and_modes_bring_it(visit: Visit):
    watched = visit(size=(390, 844))
    page, grip, tab = (
        watched.page,
        watched.page.locator(".rxf-grip"),
        watched.page.locator("[data-page=controls]"),
    )
    sheet = "() => innerHeight - document.querySelector('.rxf-grip').getBoundingClientRect().bottom"
    canvas = "() => document.querySelector('canvas').getBoundingClientRect().height"
    box = watched.box(grip)
    half, high = page.evaluate(sheet), page.evaluate(canvas)
    x, y = box["x"] + 150, box["y"] + box["height"] / 2
    watched.hold(x, y)
    page.mouse.move(x, y - 120, steps=4)
    pulled = pytest.approx(half + 120, abs=3)
    watched.until(lambda: page.evaluate(sheet) == pulled)
    # Of another size only once it is let go.
    assert page.evaluate(canvas) == pytest.approx(high, abs=1)
    page.mouse.up()
    page.wait_for_function(f"high => ({canvas})() < high - 100", arg=high)
    expect(tab).to_have_attribute("aria-expanded", "true")
    tab.click()
    page.wait_for_function(f"() => ({sheet})() === 0")
    expect(tab).to_have_attribute("aria-expanded", "false")
    watched.mode("optimise")
    page.get_by_role("button", name="Optimise", exact=True).last.wait_for(state="visible")
    watched.until(lambda: page.evaluate(sheet) == pulled)  # As high as it was pulled.


def test_on_a_tablet_optimise_shows_its_controls_and_its_search(visit: Visit):
    watched = visit(size=(820, 1180))
    watched.mode("optimise")
    begin = watched.page.locator("[data-dock-region=right]").get_by_role(
        "button", name="Optimise", exact=True
    )
    begin.click()
    watched.page.locator("[data-explorer=notice]").wait_for(state="visible")
    assert found(watched)[0] == CLEAN


def test_what_folds_in_a_low_window_opens_by_a_press_and_closes_again(visit: Visit):
    watched = visit(size=(1280, 585))
    page = watched.page
    for name, shown in (
        ("charts", "[data-name=power] [data-page=scale]"),
        ("inset", ".rxf-inset > svg"),
    ):
        button, folded = page.locator(f"button[data-unfold={name}]"), page.locator(shown)
        expect(button).to_have_attribute("aria-expanded", "false")
        expect(folded).to_be_hidden()
        button.click()
        expect(button).to_have_attribute("aria-expanded", "true")
        folded.wait_for()
        button.press("Enter")
        expect(button).to_have_attribute("aria-expanded", "false")
        expect(folded).to_be_hidden()
    # A sparkline itself opens the charts.
    page.locator(".rxf-chart").first.click()
    page.locator("[data-name=power] [data-page=scale]").wait_for()


RIM_OF_PLAN = """() => { const {left, right, top, bottom} =
    document.querySelector('.rxf-plan svg circle').getBoundingClientRect(); return [left, right, top, bottom]; }"""
# Whether the disk, in the scene or as a plan, is what lies at a place of the window.
BARE = "([x, y]) => document.elementFromPoint(x, y).matches('canvas, .rxf-plan *')"


@pytest.mark.parametrize("view", ["3d", "disk"])
@pytest.mark.parametrize(
    ("size", "mode"),
    [((1366, 650), "explore"), ((861, 481), "explore"), ((985, 554), "optimise")],
    ids=lambda value: "x".join(map(str, value)) if isinstance(value, tuple) else value,
)
def test_a_press_on_the_disk_leaves_it_where_it_is(
    visit: Visit, size: tuple[int, int], mode: str, view: str
):
    """The section that opens lies over the cards, or over the rail of a narrow window."""
    watched = visit(size=size)
    watched.quiet()
    page = watched.page
    if mode != "explore":
        watched.mode(mode)
        watched.answered()  # In a narrow window the mode opens the rail, which moves the views.
    page.locator(f"[data-do=view][data-value='{view}']").click()
    if view == "disk":
        page.wait_for_function("() => RX.state.plan?.values")

    def rim() -> list[float]:
        return page.evaluate(RIM_OF_PLAN if view == "disk" else f"({SUBJECT})('/rotor/disk/field')")

    before = watched.at_rest(rim)
    left, right, top, bottom = before
    place = [left + 0.62 * (right - left), top + 0.8 * (bottom - top)]
    for k in range(2):  # The first press opens the section, the second shows another one.
        page.mouse.click(place[0] + 8 * k, place[1])
        page.wait_for_selector('[data-explorer="drawer"][data-name="probe"]')
        assert watched.at_rest(rim) == pytest.approx(before, abs=0.5)
        assert page.evaluate(BARE, place)
        assert page.evaluate(MEASURE)["hit"] == []
    watched.drawer("share")  # It is no part of what is looked at: the disk makes room for it.
    assert watched.at_rest(rim) != pytest.approx(before, abs=5.0)
    page.get_by_role("button", name="Close").first.click()
    assert watched.at_rest(rim) == pytest.approx(before, abs=5.0)


def test_the_section_never_lies_over_the_pressed_place(visit: Visit):
    watched = visit(size=(861, 940))
    watched.quiet()
    page = watched.page
    left, right, top, bottom = watched.at_rest(
        lambda: page.evaluate(f"({SUBJECT})('/rotor/disk/field')")
    )
    page.mouse.click(left + 0.1 * (right - left), 0.5 * (top + bottom))
    page.wait_for_selector('[data-explorer="drawer"][data-name="probe"]')
    drawer = page.locator("[data-dock-region=left]")
    left, *_ = watched.at_rest(lambda: page.evaluate(f"({SUBJECT})('/rotor/disk/field')"))
    edge = drawer.bounding_box()
    assert edge is not None
    assert left > edge["x"] + edge["width"]


def test_sliders_show_their_values_from_the_first_view(visit: Visit):
    page = visit(size=LARGE).page
    fields = page.locator(
        "[data-dock-region=right] input[aria-label][inputmode]:not([type=hidden])"
    )
    shown = fields.evaluate_all(
        "all => all.filter(e => e.checkVisibility({opacityProperty: true, visibilityProperty: true}))"
        ".map(e => [getComputedStyle(e).opacity, e.value])"
    )
    assert len(shown) >= 4
    assert all(opacity == "1" and value for opacity, value in shown)


@pytest.mark.slow
def test_what_is_measured_can_fail(visit: Visit):
    page = visit(size=(820, 1180)).page
    for name, style in (
        (".rxf-views", "inset: -20px auto auto 20px !important"),
        (".rxf-grip button", "min-height: 20px !important; height: 20px; align-self: start"),
    ):
        page.evaluate(
            "([name, style]) => { document.querySelector(name).style.cssText = style; }",
            [name, style],
        )
    now = page.evaluate(MEASURE)
    assert "line × views" in now["hit"]
    assert [name for name in now["narrow"] if name.endswith("×20")]

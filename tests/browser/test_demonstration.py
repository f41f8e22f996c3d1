"""A demonstration of five minutes as a presenter gives it, as pictures to look at: `artefacts/demonstration`.

Nothing in it is typed: each number is read from the page and compared with a trim, or with what the server worked out.
"""

import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from test_lecture_page import FIGURES, LONG, section, stands_at
from test_plan import _READY as PLAN_READY
from test_plan import _point as on_the_plan
from watched import MEDIUM, Watched

from explorer.app import App
from explorer.model.inputs import OPENING
from explorer.model.units import UNITS
from explorer.story.steps import STEPS, quantities
from rotor.actuator import programmes
from rotor.trim.solve import solve

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.browser, pytest.mark.slow, pytest.mark.nightly]
SIZES = ((1920, 1080), MEDIUM)

# The scene is drawn while the page opens, which also makes its light, and for pictures: software takes long for it.
_DRAW_AT_TIMES = """
window.painted = true;
const gl = WebGL2RenderingContext.prototype;
for (const name of Object.keys(gl).filter(name => /^draw(Arrays|Elements|RangeElements)/.test(name))) {
    const draw = gl[name];
    gl[name] = function (...all) { if (window.painted) draw.apply(this, all); };
}"""
_PAINT = """async () => {
    window.painted = true;
    for (let k = 0; k < 4; k++) {
        window.__viserMutable?.requestRender?.();
        await new Promise(requestAnimationFrame);
    }
}"""


class Pictures:
    """Numbered as they are taken, of both sizes."""

    def __init__(self, folder: Path, scheme: str) -> None:
        self._folder, self._scheme, self._count = folder, scheme, 0
        folder.mkdir(parents=True, exist_ok=True)

    def take(self, watched: Watched, name: str, still: bool = True) -> None:
        """`still` False: something is held by the mouse, so that the window stays as it is."""
        page, self._count = watched.page, self._count + 1
        for width, height in SIZES if still else SIZES[:1]:
            if still:
                page.set_viewport_size({"width": width, "height": height})
                watched.answered()
            _look(watched, self._folder / f"{self._count:02d}-{name}-{self._scheme}-{width}x{height}.png")
        if still:
            page.set_viewport_size({"width": SIZES[0][0], "height": SIZES[0][1]})
            watched.answered()
            _rest(watched)


def _rest(watched: Watched) -> None:
    """Wait until nothing of the page itself moves any more, such as a camera."""
    seen = """() => { const {camera, canvas} = window.__viserMutable ?? {};
        return [camera?.matrixWorld.elements.map(v => v.toFixed(3)), canvas?.clientWidth, canvas?.clientHeight]; }"""
    before: object = None
    while (now := watched.page.evaluate(seen)) != before:
        before = now
        watched.page.wait_for_timeout(400)


def _look(watched: Watched, path: Path) -> None:
    _rest(watched)
    watched.page.evaluate(_PAINT)
    watched.page.screenshot(path=path, timeout=120_000)
    watched.page.evaluate("() => { window.painted = false; }")
    assert path.stat().st_size > 50_000
    assert not re.search(r"\b(NaN|nan|inf|undefined)\b", watched.page.inner_text("body"))


@pytest.fixture(params=["dark", "light"])
def scheme(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def take(artefacts: Path, scheme: str, request: pytest.FixtureRequest) -> Callable[..., None]:
    name = request.node.originalname.removeprefix("test_")
    return Pictures(artefacts / "demonstration" / name, scheme).take


@pytest.fixture
def watched(browser: "Browser", app: App, scheme: Any) -> Iterator[Watched]:
    """A window of its own as a person sees it."""
    width, height = SIZES[0]
    context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme)
    context.add_init_script(_DRAW_AT_TIMES)
    watched = Watched(context.new_page())
    watched.open(app.address, query="")
    watched.quiet()
    watched.answered(wholly=True)
    watched.page.evaluate("() => { window.painted = false; }")
    yield watched
    assert watched.complaints == []
    context.close()


def _kw(text: str) -> float:
    return float(text.replace("\u2009", "").replace("\u00a0", " ").split()[0].replace("−", "-").replace("+", ""))


def _state(app: App) -> Any:
    state = app.sessions[-1].page.context.state()
    assert state is not None
    return state


def _power_is_a_trim(watched: Watched, app: App) -> None:
    """What the card shows is the power of the design on the sliders, trimmed here from cold."""
    watched.answered()
    own = solve(app.sessions[-1].page.context.inputs().design()).require()
    assert _kw(watched.text("total-power")) == pytest.approx(own.power.total / 1e3, abs=0.6)


def test_explore(watched: Watched, app: App, take: Callable[..., None]):
    """Opening; the tip taken and twisted; the disk with its stall."""
    page = watched.page
    watched.answered(wholly=True)
    _power_is_a_trim(watched, app)
    take(watched, "opening")
    x, y = watched.grab_tip()
    page.mouse.move(x, y + 110, steps=8)
    watched.answered()
    page.wait_for_function("() => RX.state.hand?.place.startsWith('tip')")
    take(watched, "tip-in-the-hand", still=False)
    before = solve(OPENING.design()).power.total
    page.mouse.up()
    watched.answered(wholly=True)
    change = _state(app).solution.power.total - before
    assert _kw(watched.text("since")) == pytest.approx(change / 1e3, abs=0.6)
    take(watched, "twisted")
    page.keyboard.press("r")
    watched.type("Adv. ratio", 0.38)
    page.get_by_role("button", name="Disk", exact=True).click()
    page.wait_for_function(PLAN_READY)
    watched.answered(wholly=True)
    _power_is_a_trim(watched, app)
    page.mouse.move(*on_the_plan(watched, 0.82, 285.0))
    page.locator("[data-reading]").wait_for(state="visible")
    page.mouse.down()
    page.mouse.up()
    page.locator("[data-pin]").wait_for(state="visible")
    said = re.findall(r"[Ss]tall\n([\d.]+) % area", page.locator(".rxf-plan").inner_text())
    assert sum(map(float, said)) == pytest.approx(100.0 * _state(app).solution.stalled_area, abs=0.11)
    take(watched, "disk-with-stall")


def test_optimise(watched: Watched, app: App, take: Callable[..., None]):
    """The search on the blade, its landscape, and the replay."""
    page = watched.page
    watched.type("Adv. ratio", 0.3)
    watched.mode("optimise")
    watched.choose("Concept", "Two segments")
    page.locator("[data-dock-region=right]").get_by_role("button", name="Optimise", exact=True).click()
    page.wait_for_selector('[data-explorer="search"][data-kind="done"]', timeout=LONG)
    watched.answered()
    run = app.sessions[-1].page.optimise.run
    assert run is not None
    assert run.best is not None
    assert solve(run.best.design).power.total == pytest.approx(run.best.power, rel=1e-6)
    take(watched, "found")
    watched.section("Map")
    page.get_by_role("button", name="Compute map").click()
    page.wait_for_function("() => RX.state.landscape?.balls.length", timeout=LONG)
    page.wait_for_function("() => RX.landscape.at === 1 && !RX.landscape.running", timeout=LONG)
    watched.answered(wholly=True)
    said = page.evaluate("() => RX.state.landscape")
    assert said["least"] in watched.text("landscape")
    assert _kw(said["least"]) >= run.best.power / 1e3 - 0.1  # Of the map's points, so no less than the search found.
    take(watched, "landscape")
    slider = page.get_by_label("Replay of the search")
    slider.evaluate("slider => { slider.value = 0.12; slider.dispatchEvent(new Event('input', {bubbles: true})); }")
    take(watched, "replay")


def test_actuate(watched: Watched, app: App, take: Callable[..., None]):
    """One blade lifted out, from hover to fast; what would pay."""
    page = watched.page
    watched.type("Adv. ratio", 0.3)
    watched.mode("actuate")
    page.wait_for_selector('[data-explorer="verdict"][data-kind="ready"]', timeout=LONG)
    page.wait_for_function("() => RX.state.flight?.kind === 'ready' && RX.state.earns?.kind === 'ready'", timeout=LONG)
    legs = page.evaluate("() => RX.state.flight.legs.map(leg => leg[0])")
    for at in (0, len(legs) - 1):
        page.locator(f'.rxf-fly-bar [data-fly="{at}"]').click()
        watched.until(lambda at=at: abs(page.evaluate("() => RX.state.flight.at") - at) < 0.01)
        watched.answered(wholly=True)
        flight, earns = page.evaluate("() => [RX.state.flight, RX.state.earns]")
        curve = next(line for line in flight["chart"]["series"] if line["label"] == "reached")
        reached = curve["y"][-1 if at else 0]
        assert float(watched.text("tip-twist").rstrip("°").replace("−", "-")) == pytest.approx(reached, abs=0.006)
        *parts, net = [_kw(bar["text"]) for bar in earns["bars"]]
        assert math.fsum(parts) == pytest.approx(net, abs=0.2)  # The waterfall adds up.
        assert earns["mission"] in " ".join(watched.text("power-card").split())
        page.wait_for_function("() => RX.state.dial?.settled", timeout=LONG)
        watched.reads("verdict", "needs|saves")
        take(watched, f"flight-{legs[at]}")
    page.get_by_role("button", name="What would pay?").click()
    page.wait_for_function("() => RX.state.suppose?.chart", timeout=2 * LONG)
    take(watched, "what-would-pay")


def test_dial(watched: Watched, app: App, take: Callable[..., None]):
    """Twist at n/rev: dial and front, with what published programmes reached."""
    page = watched.page
    watched.type("Adv. ratio", 0.3)
    watched.mode("actuate")
    page.wait_for_function("() => RX.state.dial", timeout=LONG)
    page.wait_for_function(
        "() => RX.state.dial_matrix && document.querySelectorAll('[data-do=dial_front]')[4]", timeout=LONG
    )
    page.evaluate("() => RX.send('dial_front', 4)")
    page.wait_for_function("() => RX.state.dial.now.length && RX.state.dial.settled", timeout=LONG)
    watched.answered()
    page.locator("[data-dial]").first.scroll_into_view_if_needed()
    dots, settled = page.evaluate(
        "() => [RX.state.dial_front.series.find(one => one.action === 'dial_front'), RX.state.dial.settled]"
    )
    assert settled["index"][0] == pytest.approx(dots["y"][4], abs=8.0)
    take(watched, "dial")
    page.get_by_role("button", name="Enlarge dial and front").click()
    page.wait_for_selector("[data-dial][data-large] .rxd-front [data-name]")
    assert page.locator("[data-dial][data-large] .rxd-front [data-name]").count() == sum(
        one.vibration_percent is not None for one in programmes()
    )
    take(watched, "dial-and-front")


def test_story(watched: Watched, app: App, take: Callable[..., None]):
    """Every step of the lecture: one before its guess, all with their answers; A and B on either side of the handle."""
    page = watched.page
    page.keyboard.press("t")
    for k, step in enumerate(STEPS, start=1):
        stands_at(page, k)
        watched.answered()
        assert page.locator(FIGURES).all_inner_texts() == ["?", "?", "?"]
        if k == 2:
            take(watched, f"step-{k}-guess")
        section(page, k).locator(".rxs-guess button").first.click()
        page.wait_for_function(
            "() => RX.state.lecture.answer && RX.state.lecture.figures.every(([, one]) => one !== '–')"
        )
        watched.answered()
        state = _state(app)
        known = quantities(state.solution, state.reference, UNITS["SI"])
        shown = page.evaluate("() => RX.state.lecture.figures.map(([, value]) => value)")
        for (name, _), value in zip(step.figures, shown, strict=True):
            assert known.get(name, value) == value
        take(watched, f"step-{k}-{step.name}")
        if k < len(STEPS):
            page.get_by_role("button", name="Next", exact=True).click()

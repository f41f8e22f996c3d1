"""The explorer in a browser as tests use it: sliders moved, parts read, complaints collected."""

import re
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import Any

from chromium import DRAW_NOTHING
from playwright.sync_api import Browser, BrowserContext, Locator, Page, TimeoutError

SMALL, MEDIUM, LARGE = (1180, 640), (1280, 720), (1500, 940)
WAIT = 90_000
"""[ms]; far more than it takes, for machines that draw in software."""
_POINTING = 9_000
"""[ms] after which the pointer is moved to the blade again."""
COARSE = "?fixedDpr=0.5"
"""Half as many pixels each way, for tests that read no picture."""
OPEN = """() => document.querySelector('[data-explorer=status]')?.dataset.kind === 'converged'
    && !document.documentElement.classList.contains('rx-veiled')"""
DRAWN = (
    "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done())))"
)
"""Waits until what was asked for is drawn."""


ON_SCREEN = """r => {
    const viewer = window.__viserMutable, blade = viewer.nodeRefFromName['/rotor/blade_0'];
    blade.updateWorldMatrix(true, false);
    const at = blade.position.clone().set(r, -0.1, 0).applyMatrix4(blade.matrixWorld).project(viewer.camera);
    const box = viewer.canvas.getBoundingClientRect();
    return [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height];
}"""
"""Pixel of a point of the reference blade, so far from its hinge [m]."""


class Watched:
    """A page and everything it complained about, except of what viser does itself."""

    def __init__(self, page: Page) -> None:
        self.page = page
        page.set_default_timeout(WAIT)
        self.complaints: list[str] = []
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("console", lambda m: self.complaints.append(m.text) if m.type == "error" else None)

    def open(self, address: str, query: str = COARSE) -> None:
        self.page.goto(address + query)
        self.ready()

    def ready(self) -> None:
        """Wait for the first answer, and until the page is seen. The first kernels may have to be compiled."""
        self.page.wait_for_function(OPEN, timeout=4 * WAIT)

    def drawn(self) -> None:
        """Wait until what has arrived is drawn: `RX.state` is ahead of what is seen by a frame."""
        self.page.evaluate(DRAWN)

    def close(self) -> None:
        self.page.close()

    def row(self, label: str) -> Locator:
        named = self.page.locator("label", has_text=re.compile(rf"^{re.escape(label)}")).first
        return named.locator("xpath=ancestor::div[contains(@class,'Flex-root')][1]")

    def field(self, label: str) -> Locator:
        """Where a slider's number stands."""
        return self.row(label).locator("input:not([type=hidden])").last

    def number(self, label: str) -> float:
        return float(self.field(label).input_value())

    def seen(self, node: str) -> bool:
        """Whether a node of the scene is visible."""
        return self.page.evaluate(
            "name => window.__viserMutable.nodeRefFromName[name].visible", node
        )

    def hold(self, x: float, y: float) -> None:
        self.page.mouse.move(x, y)
        self.page.mouse.down()

    def drag(self, x: float, y: float, *, by: tuple[float, float], steps: int = 5) -> None:
        self.hold(x, y)
        self.page.mouse.move(x + by[0], y + by[1], steps=steps)
        self.page.mouse.up()

    def unfold(self, label: str) -> None:
        """Show a control that is folded at first."""
        if label == "Limit past static angle" and not self.row(label).is_visible():
            self.page.get_by_text("Limits", exact=True).click()
            self.row(label).wait_for()
        if label.startswith(
            ("Altitude", "ISA offset", "Climb", "Rotor speed", "Load factor", "Flight or test")
        ):
            self.page.evaluate("() => RX.send('more', 'on')")
            self.row(label).wait_for()

    def open_folders(self) -> None:
        """All of the rail and of the drawer that is open."""
        folders = self.page.locator("[data-dock-group] svg.tabler-icon-chevron-down:visible")
        while closed := folders.count():
            folders.first.click()
            self.until(lambda closed=closed: folders.count() != closed)

    def press(self, label: str, key: str, times: int = 1) -> None:
        self.unfold(label)
        self.row(label).get_by_role("slider").focus()
        for _ in range(times):
            self.page.keyboard.press(key)

    def choose(self, label: str, option: str) -> None:
        self.unfold(label)
        self.row(label).locator("input").first.click()
        self.page.get_by_role("option", name=option, exact=True).click()

    def type(self, label: str, value: float) -> None:
        self.unfold(label)
        self.field(label).fill(f"{value:g}")
        self.page.keyboard.press("Enter")

    def mode(self, name: str) -> None:
        """Explore, Optimise or Actuate: what the rail holds."""
        self.page.locator(f".rxf-modes [data-value={name}]").click()
        self.page.wait_for_function("name => RX.state.bar?.mode === name", arg=name)
        self.page.wait_for_selector(f".rxf-modes [data-value={name}][aria-current=true]")

    def drawer(self, name: str) -> None:
        """Open a drawer, unless it is open."""
        if self.page.evaluate("() => RX.state.bar.drawer") != name:
            self.page.evaluate("name => RX.send('drawer', name)", name)
        self.page.wait_for_selector(f'[data-explorer="drawer"][data-name="{name}"]')

    def point_at_tip(self) -> tuple[float, float]:
        """Point near the tip of the reference blade until viser shows that it can be taken; the pixel.

        The camera goes where the cards leave room: where it moved on meanwhile, point again, as a person would.
        """
        for _ in range(WAIT // _POINTING):
            x, y = self.at_rest(lambda: self.page.evaluate(ON_SCREEN, 7.2))
            self.page.mouse.move(x, y)
            with suppress(TimeoutError):
                self.page.wait_for_function(
                    "() => window.__viserMutable.canvas.style.cursor === 'grab'", timeout=_POINTING
                )
                return x, y
            self.page.mouse.move(x, y + 40)
        raise AssertionError("the tip of the blade is never under the pointer")

    def grab_tip(self) -> tuple[float, float]:
        """Press on the reference blade near its tip and begin to pull it down; the pixel of the press."""
        x, y = self.point_at_tip()
        self.page.mouse.down()
        self.page.mouse.move(x, y + 12, steps=4)
        self.page.wait_for_function("() => RX.state.twisting")
        return x, y

    def section(self, title: str) -> None:
        """A part of a rail or drawer that has several."""
        button = self.page.locator(".rxp-sections button", has_text=title)
        button.click()
        self.page.wait_for_selector(f'.rxp-sections button[aria-pressed=true] >> text="{title}"')

    def reset(self) -> None:
        """Back to the design the page began with, in Explore, with no drawer open and nothing pinned."""
        self.page.evaluate(
            """() => {
                document.activeElement?.blur();
                if (RX.state.bar.drawer) RX.send('drawer', '');
                if (RX.state.bar.pinned) RX.send('pin', '');
                if (RX.state.bar.mode !== 'explore') RX.send('mode', 'explore');
            }"""
        )
        self.page.keyboard.press("r")
        self.answered()

    def show(self, field: str) -> None:
        """Another quantity on the disk."""
        self.page.locator(".rxf-field select").select_option(field)

    def text(self, part: str) -> str:
        self.drawn()
        return self.page.locator(f'[data-explorer="{part}"]').first.inner_text()

    def until_changed(self, read: Callable[[], Any], before: Any) -> Any:
        for _ in range(WAIT // 100):
            now = read()
            if now != before:
                return now
            self.page.wait_for_timeout(100)
        raise AssertionError(f"nothing changed: still {before!r:.200}")

    def until(self, condition: Callable[[], Any]) -> None:
        """Wait until something holds, on the page or in the server."""
        self.until_changed(lambda: bool(condition()), False)

    def says(self, part: str, text: str) -> None:
        """Wait until a part of the page says exactly this."""
        self.page.wait_for_function(
            "([part, text]) => document.querySelector(`[data-explorer='${part}']`)?.innerText.trim() === text",
            arg=[part, text],
        )

    def reads(self, part: str, pattern: str) -> str:
        """What a part of the page says once it has a match of the pattern."""
        text = self.text(part)
        for _ in range(WAIT // 100):
            if re.search(pattern, text):
                return text
            self.page.wait_for_timeout(100)
            text = self.text(part)
        raise AssertionError(f"{part} says {text!r}, without {pattern!r}")

    def answered(self, wholly: bool = False) -> None:
        """Wait until all that was done on the page is answered and drawn; `wholly`, until nothing more is computed: the
        curve of power, the worth of each slider, the waterfall. A fact that the page and the server agree on."""
        self.page.wait_for_function("wholly => RX.idle(wholly)", arg=wholly, timeout=4 * WAIT)

    def at_rest(self, read: Callable[[], Any]) -> Any:
        """What is read once all is answered and it no longer moves on the page itself, as a camera or a panel does."""
        self.answered()
        now = read()
        for _ in range(WAIT // 100):
            self.page.wait_for_timeout(100)
            self.drawn()
            before, now = now, read()
            if now == before is not None:  # None: not drawn at this moment.
                return now
        raise AssertionError(f"never at rest: {now!r:.200}")

    def box(self, of: Locator | str) -> dict[str, float]:
        """Where something is once it rests: cards and charts are drawn anew with each answer."""
        return self.at_rest((self.page.locator(of) if isinstance(of, str) else of).bounding_box)

    def middle(self, of: Locator | str) -> tuple[float, float]:
        box = self.box(of)
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def thumb(self, label: str) -> tuple[float, float]:
        """Middle of a slider's thumb."""
        return self.middle(self.row(label).get_by_role("slider"))

    def node(self, name: str) -> str:
        """A digest of what is drawn of a scene node: a blade's vertices or the numbers on a disk."""
        return self.page.evaluate(
            """name => {
                const {geometry, material} = Common.node(name).getObjectByProperty('isMesh', true);
                const {buffer, byteOffset, byteLength} = name.endsWith('/disk/field')
                    ? rotorDisk.drawn(name.slice(0, -11)).image.data : geometry.attributes.position.array;
                const view = new Uint8Array(buffer, byteOffset, byteLength);
                let hash = 5381;
                for (const byte of view) hash = (hash * 33 + byte) | 0;
                return view.length + ':' + hash;
            }""",
            name,
        )

    def quiet(self) -> None:
        """Close viser's remark on drawing in software, which only headless browsers see."""
        # In one call: the page itself closes it after some seconds, perhaps just when it is looked for.
        self.page.evaluate("() => document.querySelector('[class*=otification] button')?.click()")
        self.page.wait_for_timeout(400)


Visit = Callable[..., Watched]
"""Opens a page with this query and of this size."""


@cache
def window(browser: Browser, scheme: Any = None) -> BrowserContext:
    """One for all pages in which nothing is painted: what a test reads needs no pixels."""
    context = browser.new_context(color_scheme=scheme)
    context.add_init_script(DRAW_NOTHING)
    return context


def opened(
    browser: Browser,
    address: str,
    query: str = COARSE,
    size: tuple[int, int] = SMALL,
    scheme: Any = None,
) -> Watched:
    """A page in which nothing is painted."""
    watched = Watched(window(browser, scheme).new_page())
    watched.page.set_viewport_size({"width": size[0], "height": size[1]})
    watched.open(address, query)
    return watched

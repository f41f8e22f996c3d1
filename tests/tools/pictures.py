"""Make what the documents show of the page: `python -m tests.tools.pictures`.

With `--live` only the page that travels. For pictures it needs Chromium (`make browser`). Software draws the scene, so
one picture takes about half a minute.
"""

import io
import sys
from dataclasses import replace
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

from explorer.app import App
from explorer.export.live import live_html
from explorer.model.inputs import OPENING
from rotor import make_design, solve
from tests.chromium import LAUNCH_ARGUMENTS, find_chromium

FOLDER = Path(__file__).parents[2] / "docs" / "images"
LIVE = FOLDER.parent / "style"
SIZE = (1500, 940)
START = replace(OPENING, advance_ratio=0.22, mass_t=9.6)
"""Heavy: the disk has a stalled region."""
WAIT = 120_000
"""[ms]"""
MOST_BYTES = 560_000

ANGLES = tuple(range(2, 19, 2))
"""Twist of the root in the moving picture, less that at 0.75 R [°]."""
MOVING_SIZE = (900, 564)

_AS_WITH_A_GPU = """
const read = WebGL2RenderingContext.prototype.getParameter;
WebGL2RenderingContext.prototype.getParameter = function (name) {
  return name === 37446 ? 'GPU' : read.call(this, name);
};
"""
"""The page filters the words on the disk as well as a graphics card would: UNMASKED_RENDERER_WEBGL is 37446."""


def main() -> int:
    """0, or 1 with a sentence where there is no browser."""
    (LIVE / "twist.html").write_text(live_html(solve(make_design(mu=0.2))), encoding="utf-8")
    _weigh(LIVE / "twist.html")
    if "--live" in sys.argv:
        return 0
    browser_path = find_chromium()
    if browser_path is None:
        print(
            "No Chromium found: `make browser` gets one, ROTOR_CHROMIUM names one.", file=sys.stderr
        )
        return 1
    app = App("127.0.0.1", 0, START)
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=browser_path, args=list(LAUNCH_ARGUMENTS)
            )
            context = browser.new_context(
                viewport={"width": SIZE[0], "height": SIZE[1]},
                color_scheme="light",
                reduced_motion="reduce",
            )
            context.add_init_script(_AS_WITH_A_GPU)
            page = context.new_page()
            page.goto(app.address)
            _write(_twisted(page), FOLDER / "explorer.png")
            _write_moving(_twisting(page), FOLDER / "twisting.webp")
            browser.close()
    finally:
        app.stop()
    return 0


def _twisted(page: Page) -> bytes:
    """The first view after the root was twisted by hand."""
    page.wait_for_selector('[data-explorer="status"][data-kind="converged"]', timeout=WAIT)
    page.wait_for_function("() => RX.state.strip?.length === 3", timeout=WAIT)
    page.evaluate("() => RX.send('knot', ['0', 'start'])")
    page.evaluate("() => RX.send('knot', ['0', [0.13, 6.8]])")
    page.wait_for_function("() => RX.state.power.why", timeout=WAIT)
    page.evaluate("() => RX.send('knot', ['0', 'end'])")
    page.evaluate("() => RX.send('azimuth', 65)")
    swept = "() => RX.state.strip[0].chart.series.some(one => one.filled && one.y.some(y => Math.abs(y) > 1))"
    page.wait_for_function(swept, timeout=WAIT)
    page.wait_for_function("() => Object.keys(RX.state.worth).length >= 6", timeout=WAIT)
    page.wait_for_function(
        "() => !document.querySelector('.mantine-Notification-root')", timeout=WAIT
    )
    page.wait_for_timeout(6_000)  # The fine picture of the disk is drawn once nothing moves.
    return page.screenshot(timeout=WAIT)


def _twisting(page: Page) -> list[bytes]:
    """The page while the root of the blade is twisted by hand, a picture at each angle."""
    pictures: list[bytes] = []
    page.evaluate("() => RX.send('knot', ['0', 'start'])")
    for angle in ANGLES:
        page.evaluate("angle => RX.send('knot', ['0', [0.13, angle]])", angle)
        page.wait_for_function("() => RX.idle(true)", timeout=WAIT)
        page.wait_for_timeout(3_000)  # The fine picture of the disk.
        pictures.append(page.screenshot(timeout=WAIT))
    page.evaluate("() => RX.send('knot', ['0', 'end'])")
    return pictures


def _write_moving(pictures: list[bytes], path: Path) -> None:
    """There and back, for ever, as a WebP."""
    frames = [
        Image.open(io.BytesIO(one)).convert("RGB").resize(MOVING_SIZE, Image.Resampling.LANCZOS)
        for one in pictures
    ]
    there_and_back = [*frames, *frames[-2:0:-1]]
    times = [900 if k in (0, len(frames) - 1) else 220 for k in range(len(there_and_back))]
    there_and_back[0].save(
        path,
        save_all=True,
        append_images=there_and_back[1:],
        duration=times,
        loop=0,
        quality=68,
        method=6,
    )
    _weigh(path)


def _write(content: bytes, path: Path) -> None:
    """As a PNG without transparency, as small as it gets."""
    Image.open(io.BytesIO(content)).convert("RGB").save(path, optimize=True)
    _weigh(path)


def _weigh(path: Path) -> None:
    size = path.stat().st_size
    if size > MOST_BYTES:
        raise SystemExit(f"{path} has {size} bytes, more than {MOST_BYTES}: show less")
    print(f"{path}: {size / 1e3:.0f} kB")


if __name__ == "__main__":
    sys.exit(main())

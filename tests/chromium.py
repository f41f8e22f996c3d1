"""Find a Chromium for the browser tests: `python tests/chromium.py` prints its path, or exits 1."""

import os
import shutil
import sys
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
PLACES = (
    Path("/Applications/Google Chrome.app/Contents/MacOS/Google Chrome"),
    Path("/Applications/Chromium.app/Contents/MacOS/Chromium"),
)

LAUNCH_ARGUMENTS = (
    "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync",
)  # fmt: skip
"""WebGL in software, no sandbox (containers run as root), and no calls home."""

DRAW_NOTHING = """
for (const draw of ["drawArrays", "drawElements", "drawRangeElements", "drawArraysInstanced", "drawElementsInstanced"])
    WebGL2RenderingContext.prototype[draw] = () => {};
"""
"""For `BrowserContext.add_init_script`: everything works but nothing is drawn, as fast as if a GPU drew it.

Software WebGL on two busy cores makes a page four times slower; what a test reads from page and scene needs no pixels.
"""


def find_chromium() -> str | None:
    """Path of a browser: ROTOR_CHROMIUM, else one that is installed, else Playwright's own download."""
    if named := os.environ.get("ROTOR_CHROMIUM"):
        return named if Path(named).is_file() else None
    for name in NAMES:
        if path := shutil.which(name):
            return path
    for place in PLACES:
        if place.is_file():
            return str(place)
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        return None
    with sync_playwright() as playwright:
        own = playwright.chromium.executable_path
    return own if Path(own).is_file() else None


if __name__ == "__main__":
    found = find_chromium()
    sys.exit(print(found) if found else 1)

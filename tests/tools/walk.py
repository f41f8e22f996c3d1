"""Walk through the page at five sizes, in light and dark: `python -m tests.tools.walk FOLDER [--sizes 390x844]`.

Writes a picture of each place, and prints for each what covers what and how many numbers and controls are in sight.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, sync_playwright

from explorer.app import App
from tests.chromium import LAUNCH_ARGUMENTS, find_chromium

SIZES = ("1500x940", "1280x720", "1180x820", "820x1180", "390x844")
TOUCHED = ("1180x820", "820x1180", "390x844")
"""Sizes of tablets and telephones: a finger, no pointer."""
WAIT = 180_000
"""[ms]"""
MEASURE = (Path(__file__).parents[1] / "browser" / "overlaps.js").read_text(encoding="utf-8")


PLACES: dict[str, tuple[str, ...]] = {
    "explore": (),
    "disk": ("view=disk",),
    "optimise": ("view=3d", "mode=optimise"),
    "actuate": ("mode=actuate",),
    "share": ("mode=explore", "drawer=share"),
    "lecture": ("drawer=lecture",),
}
"""Buttons of the frame to press, in the order of the walk: each place begins where the one before ended."""


def walked(browser: Browser, address: str, size: str, scheme: Any, folder: Path, places: list[str]) -> None:
    """One page of this size through all places."""
    width, height = map(int, size.split("x"))
    context = browser.new_context(
        viewport={"width": width, "height": height}, color_scheme=scheme, has_touch=size in TOUCHED,
        reduced_motion="reduce",
    )  # fmt: skip
    page = context.new_page()
    page.set_default_timeout(WAIT)
    page.goto(address)
    page.wait_for_function("() => !document.documentElement.classList.contains('rx-veiled')")
    for place, buttons in PLACES.items():
        for name, value in (button.split("=") for button in buttons):
            page.locator(f"#rx [data-do={name}][data-value='{value}']").first.click()
        page.wait_for_function("() => RX.idle()")
        if place not in places:
            continue
        page.evaluate("() => document.querySelector('[class*=otification] button')?.click()")
        page.wait_for_timeout(1500)  # A card that slides in, and software that draws.
        page.screenshot(path=folder / f"{place}-{size}-{scheme}.png")
        found = page.evaluate(MEASURE)
        counts = f"{found.pop('numbers')} numbers, {found.pop('controls')} controls"
        print(f"{place} {size} {scheme}: {counts}", {name: what for name, what in found.items() if what}, flush=True)
    context.close()


def main() -> int:
    """0, or 1 with a sentence where there is no browser."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("--sizes", nargs="+", default=SIZES, metavar="WxH", help="of the window [px]")
    parser.add_argument("--schemes", nargs="+", default=("light", "dark"), choices=("light", "dark"))
    parser.add_argument("--places", nargs="+", default=list(PLACES), choices=list(PLACES))
    args = parser.parse_args()
    browser_path = find_chromium()
    if browser_path is None:
        print("No Chromium found: `make browser` gets one, ROTOR_CHROMIUM names one.", file=sys.stderr)
        return 1
    args.folder.mkdir(parents=True, exist_ok=True)
    app = App("127.0.0.1", 0)
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=browser_path, args=list(LAUNCH_ARGUMENTS))
            for size in args.sizes:
                for scheme in args.schemes:
                    walked(browser, app.address, size, scheme, args.folder, args.places)
            browser.close()
    finally:
        app.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())

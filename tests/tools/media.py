"""The poster and the film, made from the real page in a browser.

    python -m tests.tools.media poster poster.png --size 2560x1440
    python -m tests.tools.media film film.mp4 --seconds 120

The film is made frame by frame: each frame moves a slider by keys or presses a button, turns the rotor by what it turns
in that time, and is a picture of the page. So its pace does not depend on how fast the machine draws; without a
graphics card a frame takes a second or more. An .mp4 or .webm needs ffmpeg; an animated .webp is written without it.
"""

import argparse
import contextlib
import math
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from PIL import Image
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).parent.parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "browser")]

from chromium import LAUNCH_ARGUMENTS, find_chromium  # noqa: E402
from watched import Watched, painted  # noqa: E402

from explorer.app import App  # noqa: E402
from explorer.model.inputs import Inputs  # noqa: E402
from rotor.terminal import run_command  # noqa: E402

if TYPE_CHECKING:
    from playwright.sync_api import Page


class Act(NamedTuple):
    """A part of the film: nothing but the turning rotor where no slider moves and no button is pressed."""

    share: int
    """Of the length of the film."""
    slider: str = ""
    key: str = ""
    """Pressed on the slider."""
    presses: int = 0
    """How often, spread over the act."""
    button: str = ""
    """Pressed once, in the first frame."""


ACTS = (
    Act(3),
    Act(5, "Rate", "ArrowRight", 100),
    Act(5, "Rate", "ArrowLeft", 100),
    Act(1),
    Act(6, "Adv. ratio", "ArrowRight", 36),
    Act(2),
    Act(7, button="Optimise this blade"),
    Act(3, button="Apply"),
    Act(1, button="Explore"),
    Act(4, "Adv. ratio", "ArrowLeft", 36),
    Act(4, button="Actuate"),
    Act(3, button="Explore"),
)
_LEAST_WIDTH = 1100
"""[pixels] A narrower page folds the sliders away that the film moves."""
TURN = 54.0
"""Degrees per second of the film that the rotor turns."""


def storyboard(frames: int) -> Iterator[Act]:
    """What happens in each frame: acts last in proportion to their shares, and each frame has its part of the act."""
    whole, done, share = sum(act.share for act in ACTS), 0, 0
    for act in ACTS:
        share += act.share
        end = round(frames * share / whole)
        for k in range(end - done):
            presses = act.presses * (k + 1) // (end - done) - act.presses * k // (end - done)
            yield act._replace(presses=presses, button="" if k else act.button)
        done = end


def film(watched: Watched, folder: Path, frames: int, fps: float) -> None:
    """The frames as numbered pictures."""
    for k, act in enumerate(storyboard(frames)):
        if act.button:
            watched.page.get_by_role("button", name=act.button, exact=True).first.click(timeout=120_000)
        if act.presses:
            watched.press(act.slider, act.key, act.presses)
        turn_rotor(watched.page, (k * TURN / fps) % 360.0)
        watched.page.wait_for_timeout(60)
        watched.page.screenshot(path=folder / f"{k:05d}.png", timeout=120_000)
        if sys.stderr.isatty():
            print(f"\r{k + 1} of {frames} frames", end="", file=sys.stderr, flush=True)


def turn_rotor(page: "Page", azimuth: float) -> None:
    """As the slider below the disk does it [degrees]."""
    page.evaluate(
        """psi => { const slider = document.querySelector('.rxf-turn input');
            slider.value = psi; slider.dispatchEvent(new Event('input', {bubbles: true})); }""",
        azimuth,
    )


def encode(folder: Path, fps: float, out: Path) -> None:
    """Numbered pictures as one video; ValueError with the remedy where there is no program for it."""
    if out.suffix == ".webp":
        with contextlib.ExitStack() as opened:
            first, *rest = (opened.enter_context(Image.open(path)) for path in sorted(folder.glob("*.png")))
            first.save(out, save_all=True, append_images=rest, duration=round(1000.0 / fps), loop=0, quality=80)
        return
    command = (
        str(shutil.which("ffmpeg")), "-y", "-loglevel", "error", "-framerate", f"{fps:g}",
        "-i", str(folder / "%05d.png"), "-pix_fmt", "yuv420p", "-crf", "20",
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", str(out),
    )  # fmt: skip
    subprocess.run(command, check=True)


def check_encoder(out: Path) -> None:
    """Before an hour of frames: ValueError where the file could not be written in the end."""
    if out.suffix not in (".mp4", ".webm", ".webp"):
        raise ValueError(f"{out.name} is not a film: give a name that ends in .mp4, .webm or .webp")
    if out.suffix != ".webp" and shutil.which("ffmpeg") is None:
        raise ValueError(
            f"{out.name} needs ffmpeg, which is missing: apt-get install ffmpeg, or name a file that ends in .webp"
        )


def _run(options: argparse.Namespace) -> int:
    out = Path(options.out)
    width, _, height = options.size.partition("x")
    if not (width.isdigit() and height.isdigit() and 300 <= int(width) <= 8000 and 300 <= int(height) <= 8000):
        raise ValueError(f"size {options.size!r} is not a size: write for example 1920x1080")
    if options.what == "film":
        check_encoder(out)
        if int(width) < _LEAST_WIDTH:
            raise ValueError(f"a film {width} pixels wide has no sliders in the picture: give at least {_LEAST_WIDTH}")
    frames = math.ceil(options.seconds * options.fps)
    if not 1 <= frames <= 20_000:
        raise ValueError(f"{options.seconds:g} s at {options.fps:g} frames a second are {frames} frames: give 1…20000")
    chromium = find_chromium()
    if chromium is None:
        raise ValueError("there is no Chromium on this machine: make browser")
    app = App("127.0.0.1", 0, Inputs(law="linear", linear=-16.0))
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=chromium, args=list(LAUNCH_ARGUMENTS))
            watched = painted(browser, app.address, "dark" if options.dark else "light", (int(width), int(height)))
            watched.quiet()
            if options.what == "poster":
                watched.page.wait_for_timeout(3000)
                watched.page.screenshot(path=out, timeout=300_000)
            else:
                with tempfile.TemporaryDirectory() as folder:
                    film(watched, Path(folder), frames, options.fps)
                    encode(Path(folder), options.fps, out)
            browser.close()
    finally:
        app.stop()
    print(f"{out}: {out.stat().st_size / 1e6:.1f} MB")
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """0 when the file is written, 2 when something is missing or wrong."""
    parser = argparse.ArgumentParser(prog="python -m tests.tools.media", description="Poster and film of the page.")
    parser.add_argument("what", choices=("poster", "film"))
    parser.add_argument("out", metavar="FILE", help="poster: .png; film: .mp4, .webm (with ffmpeg) or .webp")
    parser.add_argument("--size", default="1920x1080", metavar="WxH", help="pixels (default 1920x1080)")
    parser.add_argument("--seconds", type=float, default=120.0, metavar="S", help="length of the film (default 120)")
    parser.add_argument("--fps", type=float, default=15.0, metavar="N", help="frames a second (default 15)")
    parser.add_argument("--dark", action="store_true", help="the dark page")
    return run_command("media", lambda: _run(parser.parse_args(arguments)))


if __name__ == "__main__":
    raise SystemExit(main())

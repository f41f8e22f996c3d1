"""A reader of the site, who knows only what is on it: from the start page to an answer in three clicks at most.

What a page says to type is typed as it stands, in an empty folder; files are those that the page shows.
"""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from PIL import Image
from watched import MEDIUM, opened

import rotor

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

pytestmark = [pytest.mark.browser, pytest.mark.slow]
ROOT = Path(__file__).parents[2]
READ = {"index.md", "tutorials/own_rotor.md", "guide/sweep.md", "guide/page.md"}
"""What this reader comes to; other pages are built by `make docs` and would take minutes here."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    docs, out = ROOT / "docs", tmp_path_factory.mktemp("site")
    pages = {path.relative_to(docs).as_posix() for path in docs.rglob("*.md")}
    left_out = ",".join([*sorted(pages - READ), "_made", "notebooks", "templates"])
    options = (
        "-D",
        "extensions=myst_parser,sphinx.ext.autodoc,sphinxcontrib.programoutput",
        "-D",
        f"exclude_patterns={left_out}",
    )
    command = (sys.executable, "-m", "sphinx", "-q", "-b", "html", *options, str(docs), str(out))
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    return out


class Reader:
    """Clicks links, and takes what stands in the boxes of a page."""

    def __init__(self, page: "Page", site: Path) -> None:
        self.page, self.clicks = page, 0
        page.goto((site / "index.html").as_uri())

    def click(self, link: str) -> None:
        self.page.get_by_role("link", name=link).first.click()
        self.clicks += 1
        assert self.clicks <= 3

    def box(self, words: str) -> str:
        """The text of the first box with these words in it."""
        return self.page.locator(".highlight pre", has_text=words).first.inner_text()


@pytest.fixture
def reader(browser: "Browser", site: Path) -> Iterator[Reader]:
    page = browser.new_page(viewport={"width": 1280, "height": 720})
    yield Reader(page, site)
    page.close()


def typed(command: str, folder: Path) -> str:
    """What a command of the page prints."""
    words = [sys.executable, *command.strip().removeprefix("$ ").split()[1:]]
    as_wide = {**os.environ, "COLUMNS": "96"}  # As docs/conf.py has it.
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300, env=as_wide)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_from_the_start_page_to_a_rotor_of_ones_own(reader: Reader, tmp_path: Path):
    reader.click("Bring your own rotor")
    (tmp_path / "mine.toml").write_text(reader.box("root_cutout_r"), encoding="utf-8")
    command, _, printed = reader.box("$ python -m rotor solve").partition("\n")
    out = typed(command, tmp_path)
    assert "converged" in out
    assert out.strip() == printed.strip(), "what is printed is what the page shows"


def test_from_the_start_page_to_a_chart_of_three_twists(reader: Reader, tmp_path: Path):
    reader.click("Over speed, mass or altitude")
    (tmp_path / "sweep.py").write_text(reader.box("speeds.csv"), encoding="utf-8")
    typed("python sweep.py", tmp_path)
    with Image.open(tmp_path / "speeds.png") as drawn:
        assert min(drawn.size) > 300
    lines = (tmp_path / "speeds.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1 + 3 * 3


def test_from_the_start_page_to_a_design_on_the_page(reader: Reader, browser: "Browser", tmp_path: Path):
    reader.click("The page")
    save, show = reader.box("python -m explorer --design").strip().splitlines()
    typed(save, tmp_path)
    words = [sys.executable, *show.split()[1:], "--port", "0", "--no-browser"]
    with subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            (address,) = re.findall(r"http://\S+", server.stdout.readline())
            watched = opened(browser, address, size=MEDIUM)
            said = watched.text("total-power").replace("\u2009", "")
            watched.close()
        finally:
            server.send_signal(signal.SIGINT)
    design = rotor.make_design(twist="linear:-12", mu=0.2)
    assert int(said.split("kW")[0]) == round(rotor.solve(design).power.total / 1e3)

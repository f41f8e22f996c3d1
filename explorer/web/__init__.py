"""All JavaScript, CSS and HTML text of the page, the report and the lecture, as files.

What Python computes goes into them in two ways: into the served page as calls of its functions with JSON arguments
(`explorer.hosting.browser.call`), into a file that is written as `{{name}}` of its HTML (`fill`), data as a JSON block.
"""

import json
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

_FOLDER = Path(__file__).parent
STYLES = ("widgets.css", "actuator.css", "dial.css", "frame.css", "panels.css", "story.css", "big.css")
"""Of the page; those that come later outweigh those before."""
SCRIPTS = (
    "viser.js", "chart.js", "frame.js", "page.js", "keys.js", "scene.js", "cards.js", "charts.js", "inset.js",
    "plan.js", "rubber.js", "flight.js", "dial.js", "landscape.js", "spoken.js", "wipe.js", "story.js", "lecture.js",
)  # fmt: skip
"""Of the page, in the order in which they run: `viser.js` before viser's client, and `frame.js` defines `RX`."""


@cache
def text(name: str) -> str:
    """The content of one file of this folder."""
    return (_FOLDER / name).read_text(encoding="utf-8")


def fill(name: str, values: Mapping[str, str]) -> str:
    """An HTML file with `{{key}}` replaced, in one pass; KeyError for a key without a value."""
    return re.sub(r"\{\{(\w+)\}\}", lambda match: values[match[1]], text(name))


def json_block(name: str, data: Any) -> str:
    """Data for a script, in an element of this id: no `<` in it, so that nothing ends the element."""
    content = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return f'<script id="{name}" type="application/json">{content}</script>'


def styles(*names: str) -> str:
    """Style elements, one a file."""
    return "".join(f"<style>{text(name)}</style>" for name in names)


def scripts(*names: str) -> str:
    """Script elements, one a file."""
    return "".join(f"<script>{text(name)}</script>" for name in names)


@cache
def frame() -> str:
    """Style sheets, skeleton and scripts of the page, to stand at the beginning of its body."""
    body = fill("frame.html", {"column": text("column.html"), "stage": text("wipe.html")})
    return f"{styles(*STYLES)}{body}{scripts(*SCRIPTS)}"

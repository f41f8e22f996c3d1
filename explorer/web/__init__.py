"""All JavaScript, CSS and HTML text of the page, and the report, as files.

What Python computes goes into them in two ways: into the served page as calls of its functions with JSON arguments
(`explorer.hosting.browser.call`), into a file that is written as `{{name}}` of its HTML (`fill`), data as a JSON block.
"""

import base64
import hashlib
import json
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from rotor.support.markup import Markup, group, tag

_FOLDER = Path(__file__).parent
STYLES = (
    "widgets.css",
    "actuator.css",
    "dial.css",
    "frame.css",
    "panels.css",
    "story.css",
    "small.css",
    "big.css",
)
"""Style sheets of the page; those that come later outweigh those before."""
SCRIPTS = (
    *(
        "viser.js",
        "common.js",
        "chart.js",
        "frame.js",
        "page.js",
        "keys.js",
        "scene.js",
        "disk.js",
        "line.js",
    ),
    *(
        "cards.js",
        "verdict.js",
        "charts.js",
        "inset.js",
        "plan.js",
        "ride.js",
        "twisting.js",
        "flight.js",
        "dial.js",
    ),
    *("spoken.js", "wipe.js", "story.js", "lecture.js"),
)
"""Scripts of the page in the order in which they run: `viser.js` before viser's client; `common.js` defines
`Common`, `frame.js` defines `RX`."""

_INSIDE = "data: blob:"  # viser's viewer evaluates text.
_POLICY = (
    f"default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval' {_INSIDE}; worker-src {_INSIDE}; "
    f"style-src 'unsafe-inline'; img-src {_INSIDE}; font-src data:; connect-src {_INSIDE}; base-uri 'none'; "
    "form-action 'none'"
)
_STRICT = (
    "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data:; connect-src 'none'; "
    "base-uri 'none'; form-action 'none'"
)


@cache
def text(name: str) -> Markup:
    """The content of one file of this folder."""
    return Markup((_FOLDER / name).read_text(encoding="utf-8"))


def fill(name: str, values: Mapping[str, str]) -> Markup:
    """An HTML file with `{{key}}` replaced, in one pass, text escaped; KeyError for a key without a value."""
    return Markup(re.sub(r"\{\{(\w+)\}\}", lambda match: group(values[match[1]]), text(name)))


def policy(*names: str) -> Markup:
    """For the head of a file that is passed on: what is in it may run and be shown, nothing is asked of any host.

    names: of its scripts, of which no other may run; without them it holds a viewer.
    """
    hashes = (hashlib.sha256(text(name).encode()).digest() for name in names)
    allowed = " ".join(f"'sha256-{base64.b64encode(each).decode()}'" for each in hashes)
    content = _STRICT.format(allowed) if names else _POLICY
    return tag("meta", http_equiv="Content-Security-Policy", content=content)


def json_block(name: str, data: Any) -> Markup:
    """Data for a script, in an element of this id: no `<` in it, so that nothing ends the element."""
    content = json.dumps(msgspec.to_builtins(data), separators=(",", ":"), allow_nan=False).replace(
        "<", "\\u003c"
    )
    return tag("script", Markup(content), id=name, type="application/json")


def styles(*names: str) -> Markup:
    """Style elements, one a file."""
    return group(tag("style", text(name)) for name in names)


def scripts(*names: str) -> Markup:
    """Script elements, one a file."""
    return group(tag("script", text(name)) for name in names)


@cache
def frame() -> Markup:
    """Style sheets, skeleton and scripts of the page, to stand at the beginning of its body."""
    return group(styles(*STYLES), text("frame.html"), scripts(*SCRIPTS))

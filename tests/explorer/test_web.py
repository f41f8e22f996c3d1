"""The page's own files: all of its JavaScript, CSS and HTML text, used, whole, and filled in."""

import re
from pathlib import Path

import pytest

from explorer import web

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "explorer").rglob("*.py"))
WRITTEN = "".join(path.read_text(encoding="utf-8") for path in SOURCES)


def test_every_function_that_python_calls_is_there():
    called = set(re.findall(r'call\([\w.]+, "(?:RX|rotorScene)\.(\w+)"', WRITTEN))
    assert {"begin", "facts", "keep", "dialog", "move", "turn", "stop"} <= called
    scripts = "".join(map(web.text, web.SCRIPTS))
    assert {
        name
        for name in called
        if not re.search(rf"^    (?:async )?{name}\(", scripts, re.MULTILINE)
    } == set()


def test_a_file_is_filled_in_one_pass(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(web, "text", lambda name: "<p>{{one}} {{two}} {{one}}</p>")
    assert web.fill("x.html", {"one": "{{two}}", "two": "2"}) == "<p>{{two}} 2 {{two}}</p>"
    with pytest.raises(KeyError, match="two"):
        web.fill("x.html", {"one": "1"})


def test_no_rule_asks_the_whole_page_what_it_has():
    """Then everything drawn has the whole page styled anew: 8 ms a frame, and half as many frames of a drag."""
    sheets = [path.read_text(encoding="utf-8") for path in Path(web.__file__).parent.glob("*.css")]
    assert len(sheets) > 5
    assert [
        rule
        for sheet in sheets
        for rule in re.findall(r"(?:html|:root|body)[^\s,{>+~]*:has\([^{]*", sheet)
    ] == []


def test_data_cannot_end_its_element():
    text = '<script id="x" type="application/json">{"a":"\\u003c/script>"}</script>'
    assert web.json_block("x", {"a": "</script>"}) == text

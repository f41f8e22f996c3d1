"""The page's own files: all of its JavaScript, CSS and HTML text, used, whole, and filled in."""

import ast
import re
from pathlib import Path

import pytest

from explorer import web
from tests.tools import lint_web

ROOT = Path(__file__).parents[2]
SOURCES = sorted((ROOT / "explorer").rglob("*.py"))
WRITTEN = "".join(path.read_text(encoding="utf-8") for path in SOURCES)
JAVASCRIPT_OR_CSS = re.compile(
    r"<(style|script)\b|\bonclick=|=>|\bfunction\b ?\(|\b(document|window|localStorage|sessionStorage)\.\w"
    r"|[\w\])] ?\{ ?[a-z-]+: ?[^{}]+; ?[a-z-]+:"
)


def test_no_script_and_no_style_sheet_stands_in_python():
    found = []
    for path in SOURCES:
        nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
        docstrings = {node.value for node in nodes if isinstance(node, ast.Expr)}
        for node in nodes:
            if not isinstance(node, ast.Constant) or not isinstance(node.value, str) or node in docstrings:
                continue
            if JAVASCRIPT_OR_CSS.search(node.value):
                found.append((str(path.relative_to(ROOT)), node.lineno, node.value))
    assert not found, "put it into explorer/web"


def test_every_file_is_used():
    names = {path.name for path in (ROOT / "explorer" / "web").iterdir() if path.suffix in (".js", ".css", ".html")}
    assert len(names) > 20
    assert {name for name in names if f'"{name}"' not in WRITTEN and f"'{name}'" not in WRITTEN} == set()


def test_every_function_that_python_calls_is_there():
    called = set(re.findall(r'call\([\w.]+, "(?:RX|rotorScene)\.(\w+)"', WRITTEN))
    assert {"begin", "facts", "keep", "dialog", "move", "turn", "stop"} <= called
    scripts = "".join(map(web.text, web.SCRIPTS))
    assert {name for name in called if not re.search(rf"^    (?:async )?{name}\(", scripts, re.MULTILINE)} == set()


def test_a_file_is_filled_in_one_pass(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(web, "text", lambda name: "<p>{{one}} {{two}} {{one}}</p>")
    assert web.fill("x.html", {"one": "{{two}}", "two": "2"}) == "<p>{{two}} 2 {{two}}</p>"
    with pytest.raises(KeyError, match="two"):
        web.fill("x.html", {"one": "1"})


def test_data_cannot_end_its_element():
    text = '<script id="x" type="application/json">{"a":"\\u003c/script>"}</script>'
    assert web.json_block("x", {"a": "</script>"}) == text


def test_style_sheets_and_html_are_whole():
    assert lint_web.faults() == []


@pytest.mark.parametrize(
    ("sheet", "fault"),
    [
        (".a { color: red; ", "a brace is not closed"),
        (".a { color: red; } }", "a brace is closed that was not opened"),
        (".a { color red; }", "'color red' is no declaration"),
        (".a { color: red background: blue; }", "'color: red background: blue' is no declaration"),
    ],
)
def test_a_broken_sheet_is_found(sheet: str, fault: str):
    assert lint_web.sheet_faults(sheet) == [fault]


def test_a_sheet_that_nobody_uses_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "x.css").write_text(".rx-nobody { color: var(--rx-nothing); }\n.rx-dim { color: red; }\n")
    monkeypatch.setattr(lint_web, "FOLDER", tmp_path)
    assert lint_web.faults() == ["x.css: nobody sets --rx-nothing", "x.css: nothing has the class rx-nobody"]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("<p><b></p>", "</p> closes another element"),
        ("<div>", "<div> is not closed"),
        ('<p id="a" id="b"></p>', "<p> has id twice"),
    ],
)
def test_broken_html_is_found(text: str, fault: str):
    assert fault in lint_web.html_faults(text)

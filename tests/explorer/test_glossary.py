"""Everything on the page explains itself, and every equation it names is in docs/theory.md."""

import ast
import re
from html import escape
from pathlib import Path

import pytest

from explorer.text import readout
from explorer.text.glossary import CONTROLS, READOUTS
from explorer.text.status import status_panel
from rotor import make_design, solve

ROOT = Path(__file__).parent.parent.parent
THEORY = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
WIDGETS = {
    f"add_{kind}"
    for kind in ("slider", "multi_slider", "number", "vector2", "text", "checkbox", "dropdown", "button",
                 "button_group", "upload_button")
}  # fmt: skip
ENTRIES = {
    **{f"control {k}": v for k, v in CONTROLS.items()},
    **{f"read-out {k}": v for k, v in READOUTS.items()},
}


def test_every_equation_and_section_named_is_there():
    for name, entry in ENTRIES.items():
        for number in entry.equations:
            assert f"({number})" in THEORY, f"{name}: eq. ({number}) is not in docs/theory.md"
        if entry.section:
            assert f"\n## {entry.section} " in THEORY, (
                f"{name}: docs/theory.md has no section {entry.section}"
            )


def _never_seen(call: ast.Call) -> bool:
    """Whether a widget only carries messages of the frame: it is made invisible and stays so."""
    label = call.args[0].value if call.args and isinstance(call.args[0], ast.Constant) else ""
    return label == "frame" and any(word.arg == "visible" for word in call.keywords)


def test_every_widget_that_is_made_anywhere_has_its_hint_from_the_glossary():
    """Names of the hints of all tabs, by reading the code: `hint=hint("name")`, or a variable that holds it."""
    for path in sorted((ROOT / "explorer").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Attribute)
                and node.func.attr in WIDGETS
            ):
                continue
            label = (
                node.args[0].value if node.args and isinstance(node.args[0], ast.Constant) else ""
            )
            given = [keyword.value for keyword in node.keywords if keyword.arg == "hint"]
            where = f"{path.relative_to(ROOT)}:{node.lineno}, {label!r}"
            assert given or label == "Close" or _never_seen(node), (
                f"{where}: give it hint=hint(…) and a sentence in explorer/text/glossary.toml"
            )
            assert not any(isinstance(value, ast.Constant) for value in given), (
                f"{where}: put it into the glossary"
            )


@pytest.mark.parametrize("mu", [0.0, 0.25])
def test_every_line_of_the_results_has_its_sentence(mu: float):
    solution = solve(make_design(mu=mu)).require()
    texts = {escape(entry.text, quote=True) for entry in READOUTS.values()}
    other = solve(make_design(mu=mu, twist="linear:-8")).require()
    page = [
        readout.power_panel(solution, other),
        readout.trim_panel(solution),
        readout.compared_power_panel(solution, other),
        readout.compared_trim_panel(solution, other),
        status_panel(solution),
    ]
    for html in page:
        for said in re.findall(r'title="([^"]*)"', html):
            assert said in texts
        for line in re.findall(r'<(?:tr|div class="rx-(?:line|four))[^>]*>(?:<span[^>]*>)?', html):
            head = "rx-dim rx-small" in line  # Column heads name what the rows explain.
            assert head or "title=" in line, f"{line} explains nothing"

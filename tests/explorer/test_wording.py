"""One name for one thing: phrases that the page and the command line do not use, because another one stands for it."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
INSTEAD = {
    "our best": "best available",
    "marked blade": "reference blade",
    "In grey": "greyed",
    "last good answer": "last converged solution",
    "that answers": "that responds to loading",
    "answer to where": "respond to the load distribution",
    "even load": "uniform loading",
    "flies along": "fly A at the current condition",
    "met from behind": "reverse flow",
    "valley": "local minimum",
    "plies a side": "plies per side",
    "Nothing searched": "not run yet",
    "Work out": "compute",
    "worth of moving": "value of in-flight twist change",
    "what moving is worth": "value of in-flight twist change",
    "sets this design aside": "bookmarks this design",
    "Inner [": "Inboard [",
    "Outer [": "Outboard [",
    "Inner break": "Inboard break",
    "Outer break": "Outboard break",
    "Weight [": "Mass [",
    "lower the weight": "lower the mass",
    "UH-60A twist": "UH-60A as built",
    "Division [": "Break point [",
    "the division at": "the break point at",
    "As built, changed": "as built + two-segment change",
    "not measured here": "no test data at this condition",
    "beyond what was measured": "outside the test range",
    "Where to twist": "power sensitivity to local pitch",
    "At first µ": "hover or cruise µ",
    "carried already": "gross mass",
    "pulsates": "unsteady wake at N/rev",
    "the link for others": "copy link",
    "moves by itself": "controlled by the presenter",
    "visitor waits": "You are second in the queue",
}
"""Phrase → the one to use."""


def shown_texts(path: Path) -> Iterator[str]:
    """String constants of a file, without its docstrings; all of a data file."""
    if path.suffix == ".toml":
        yield path.read_text(encoding="utf-8")
        return
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    silent = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in silent:
            yield node.value


@pytest.mark.parametrize("package", ["explorer", "rotor"])
def test_no_text_uses_a_second_name(package: str):
    phrases = {phrase.lower(): better for phrase, better in INSTEAD.items()}
    found = [
        f"{path.relative_to(ROOT)}: {phrase!r}: write {better!r}"
        for path in sorted((*(ROOT / package).rglob("*.py"), *(ROOT / package).rglob("*.toml")))
        for text in map(str.lower, shown_texts(path))
        for phrase, better in phrases.items()
        if phrase in text
    ]
    assert not found, "\n".join(found)

"""Check the files of the page, as `make lint` does: `python -m tests.tools.lint_web`.

A declaration that cannot be read, a custom property that nobody sets, a class that nothing has, elements that are not
closed, and a line of a script that is too long. The rest of JavaScript has a linter of its own, oxlint.
"""

import re
import sys
from html.parser import HTMLParser
from itertools import accumulate
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "explorer" / "web"
_FOREIGN = re.compile(r"mantine|uplot|multi-slider|ui-")
"""Classes of viser's client and of what it uses."""
_LONGEST = 120
"""Characters of a line of a script, as in Python."""
_VOID = {"br", "hr", "img", "input", "link", "meta"}
_DECLARATION = re.compile(
    r"-{0,2}[a-z][\w-]*\s*:\s*\S[^:{}]*|--[\w-]+\s*:[^{}]+|[a-z-]+\s*:\s*\S.*url\(.*"
)


def faults() -> list[str]:
    """One sentence for each."""
    sheets = {
        path.name: _bare(path.read_text(encoding="utf-8")) for path in sorted(FOLDER.glob("*.css"))
    }
    others = "".join(
        path.read_text(encoding="utf-8")
        for path in sorted((ROOT / "explorer").rglob("*"))
        if path.suffix in (".py", ".js", ".html")
    )
    found = [f"{name}: {fault}" for name, sheet in sheets.items() for fault in sheet_faults(sheet)]
    defined = set(re.findall(r"(--[\w-]+)['\"]?\s*[:,]", "".join(sheets.values()) + others))
    for name, sheet in sheets.items():
        used = set(re.findall(r"var\((--[\w-]+)", sheet))
        found += [
            f"{name}: nobody sets {one}"
            for one in sorted(used - defined)
            if not _FOREIGN.search(one)
        ]
        selectors = " ".join(re.findall(r"([^{};@]+)\{", sheet))
        classes = set(re.findall(r"\.([a-zA-Z][\w-]*)", selectors))
        found += [
            f"{name}: nothing has the class {one}"
            for one in sorted(classes)
            if not _FOREIGN.search(one) and not _is_named(one, others)
        ]
    for path in sorted(FOLDER.glob("*.js")):
        found += [
            f"{path.name}: line {number} has {len(line)} characters, more than {_LONGEST}"
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
            if len(line) > _LONGEST
        ]
    for path in sorted(FOLDER.glob("*.html")):
        found += [
            f"{path.name}: {fault}" for fault in html_faults(path.read_text(encoding="utf-8"))
        ]
    return found


def sheet_faults(sheet: str) -> list[str]:
    """Faults of one style sheet: braces that do not match, and declarations that are none."""
    depths = list(
        accumulate({"{": 1, "}": -1}[brace] for brace in re.findall("[{}]", _bare(sheet)))
    )
    if min(depths, default=0) < 0:
        return ["a brace is closed that was not opened"]
    found = ["a brace is not closed"] if depths and depths[-1] else []
    for statement in re.findall(r"(?<=[{;}])([^{};]*)(?=[;}])", _bare(sheet)):
        if statement.strip() and not _DECLARATION.fullmatch(statement.strip()):
            found.append(f"{' '.join(statement.split())!r} is no declaration")
    return found


class _Elements(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attrs]
        self.found += [f"<{tag}> has {name} twice" for name in set(names) if names.count(name) > 1]
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        pass

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.found.append(f"</{tag}> closes another element")


def html_faults(text: str) -> list[str]:
    """Faults of one HTML file: elements that are not closed in their order, and attributes given twice."""
    parser = _Elements()
    parser.feed(text)
    return parser.found + [f"<{tag}> is not closed" for tag in parser.open]


def _bare(sheet: str) -> str:
    """Without comments, and without what stands in quotation marks."""
    return re.sub(r'"[^"]*"', '""', re.sub(r"/\*.*?\*/", "", sheet, flags=re.DOTALL))


def _is_named(name: str, others: str) -> bool:
    """Whether other files have this class, in one piece or put together, as `rxf-${kind}` with a kind of "good"."""
    if re.search(rf"(?<![\w-]){name}(?![\w-])", others):
        return True
    stem, _, end = name.rpartition("-")
    return (
        re.search(rf"{stem}-\$?\{{", others) is not None
        and re.search(rf"[\"' ]{end}[\"']", others) is not None
    )


if __name__ == "__main__":
    found = faults()
    print("\n".join(found) or "All checks passed!")
    sys.exit(bool(found))

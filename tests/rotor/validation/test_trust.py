"""The trust page stays current: rows and pictures are recomputed, tests exist, and every page can be read."""

import ast
import re
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from rotor.support.assets import csv_rows
from rotor.support.chart_svg import small_svg, svg
from rotor.validation.compare import SETS as MEASURED
from rotor.validation.compare import load_set
from rotor.validation.page import SETS
from rotor.validation.trust import KINDS, trust_rows
from tests.shipped_rows import still_true

TESTS = Path(__file__).parent.parent.parent
DOCS = TESTS.parent / "docs"
NAMES = tuple(dict.fromkeys(row.set for row in trust_rows()))
PAGES = (DOCS / "validation.md", *sorted((DOCS / "validation").glob("*.md")))


def tables(path: Path) -> list[list[str]]:
    """The cells of every row of every table of a page, as they are read: links by their words, pictures left out."""
    text = re.sub(r"<sub>(.*?)</sub>", r"_\1", path.read_text(encoding="utf-8"))
    text = re.sub(r"!\[.*?\]\(.*?\)", "", text.replace("\\|", "¦"))
    text = re.sub(r"\[(.*?)\]\(.*?\)", r"\1", text)
    return [
        [cell.strip() for cell in line.split("|")[1:-1]]
        for line in text.splitlines()
        if line.startswith("| ")
    ]


def as_printed(text: str) -> str:
    """A shown error with the page's signs and spaces."""
    raised = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
    text = re.sub(
        r"(\d\.\d)e-0*(\d+)", lambda found: f"{found[1]} · 10⁻{found[2].translate(raised)}", text
    )
    text = re.sub(r"1e-0*(\d+)", lambda found: "10⁻" + found[1].translate(raised), text)
    return text.replace("-", "−").replace(" %", "\u00a0%")


def places(drawn: str) -> list[float]:
    """Every coordinate of a drawing."""
    held = "".join(re.findall(r" (?:d|x|y|cx|cy|r|width|height|viewBox)=(\"[^\"]*\")", drawn))
    return [float(number) for number in re.findall(r"-?\d+\.?\d*", held)]


def test_every_set_has_its_page_and_picture():
    text = PAGES[0].read_text(encoding="utf-8")
    assert tuple(re.findall(r"\| \[[^\]]+\]\(validation/([\w-]+)\.md\)", text)) == NAMES
    assert {*SETS} < {*NAMES}
    assert {path.stem for path in PAGES[1:]} == {*NAMES}
    for name in NAMES:
        assert f"](validation/{name}-small.svg) | [" in text
        assert f"\nvalidation/{name}\n" in text, f"{name} is not in the navigation"
        assert f"]({name}.svg)" in (DOCS / f"validation/{name}.md").read_text(encoding="utf-8")


def test_pages_show_the_shipped_rows():
    summary = {row[1]: row for row in tables(PAGES[0])}
    for name in NAMES:
        page = DOCS / f"validation/{name}.md"
        title = page.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")
        rows = [row for row in trust_rows() if row.set == name]
        verdicts = {row.verdict for row in rows}
        worst = next((one for one in ("missed", "met") if one in verdicts), "no target")
        assert summary[title][-1].strip("*") == worst
        if rows[0].kind == "document":
            text = page.read_text(encoding="utf-8")
            assert all(f"**{row.what}: {row.shown}.**" in text for row in rows)
            continue
        head, *cells = tables(page)
        shown = [row[head.index("Error")] for row in cells[: len(rows)]]
        assert shown == [as_printed(row.shown) for row in rows]


@pytest.mark.parametrize("name", ["knight-hefner-3", "xv15-forward-15deg", "uh60a-constants"])
def test_pictures_are_drawn_from_the_same_numbers(name: str):
    one = SETS[name]()
    for drawn, file in (
        (svg(one.charts[0]), f"{name}.svg"),
        (small_svg(one.charts[0]), f"{name}-small.svg"),
    ):
        shipped = (DOCS / "validation" / file).read_text(encoding="utf-8")
        assert_allclose(places(drawn), places(shipped), atol=0.5)


# That page has C_P/σ.
@pytest.mark.parametrize("name", [name for name in MEASURED if name != "uh60a-hover"])
def test_every_measured_point_stands_in_the_table_beside_its_page(name: str):
    measured = load_set(name)
    rows = csv_rows(DOCS / "validation" / f"{name}.csv")
    assert [float(row["Measured"]) for row in rows] == pytest.approx(
        [point[measured.quantity] for point in measured.points], rel=1e-4
    )


def test_every_row_names_a_test_that_exists():
    known: dict[str, set[str]] = {}
    for path in TESTS.rglob("test_*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        known[path.relative_to(TESTS).as_posix()] = {
            node.name for node in tree.body if isinstance(node, ast.FunctionDef)
        }
    assert {row.kind for row in trust_rows()} == set(KINDS)
    for row in trust_rows():
        file, _, name = row.test.partition("::")
        assert name in known.get(file, set()), f"{row.what}: {row.test}"


@pytest.mark.slow
def test_rows_are_reproduced():
    for make in SETS.values():
        for row in make().rows:
            still_true(row)

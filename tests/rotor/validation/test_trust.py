"""The trust page stays current: rows and pictures are recomputed, tests exist, and every page can be read."""

import ast
import re
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from rotor.support.assets import csv_rows
from rotor.support.chart_svg import small_svg, svg
from rotor.validation.compare import PAGES as MEASURED
from rotor.validation.compare import SETS as MEASURED_SETS
from rotor.validation.compare import load_set, page_of
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


def verdict_of(table: list[list[str]]) -> str:
    """What the summary says of a page with this table: missed if one quantity is, with how many meet their target."""
    met: dict[str, bool] = {}
    for label, *cells in table:
        for word in {"met", "**missed**"} & {*cells}:
            quantity = label.partition(", inflow ")[0]
            met[quantity] = met.get(quantity, True) and word == "met"
    if not met:
        return "no target"
    if all(met.values()):
        return "met"
    if len(met) == 1:
        return "missed"
    return f"missed: {[*met.values()].count(True)} of {len(met)} meet it"


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
        assert summary[title][-1].replace("**", "") == verdict_of(tables(page))
        if rows[0].kind == "document":
            text = page.read_text(encoding="utf-8")
            assert all(f"**{row.what}: {row.shown}.**" in text for row in rows)
            continue
        head, *cells = tables(page)
        shown = [row[head.index("Error")] for row in cells[: len(rows)]]
        assert shown == [as_printed(row.shown) for row in rows]


@pytest.mark.parametrize("name", [name for name, sets in MEASURED.items() if len(sets) > 1])
def test_a_page_of_several_sets_has_them_all_and_its_summary_the_worst_miss(name: str):
    text = (DOCS / f"validation/{name}.md").read_text(encoding="utf-8")
    title = text.splitlines()[0].removeprefix("# ")
    (error,) = (row[3] for row in tables(PAGES[0]) if row[1] == title)
    labels = [row[0].lower() for row in tables(DOCS / f"validation/{name}.md")[1:]]
    missed: dict[str, float] = {}
    for measured in map(load_set, MEASURED[name]):
        rows = [row for row in trust_rows() if row.what.startswith(f"{measured.title}: ")]
        part = as_printed(measured.part)
        assert {row.set for row in rows} == {name}
        assert sum(label.startswith(f"{part.lower()}: ") for label in labels) == len(rows)
        errors = [row.error for row in rows if row.verdict == "missed" and row.error is not None]
        if errors:
            missed[part] = max(errors)
    assert len(labels) == len([row for row in trust_rows() if row.set == name])
    assert ("worst miss" in error) == bool(missed)
    if missed:
        worst = max(missed, key=missed.__getitem__)
        assert error.endswith(f"; worst miss: {worst}, {100.0 * missed[worst]:.1f}\u00a0%")


@pytest.mark.parametrize("name", ["knight-hefner", "xv15-forward", "uh60a-constants"])
def test_pictures_are_drawn_from_the_same_numbers(name: str):
    one = SETS[name]()
    drawn = {f"{name}-small.svg": small_svg(one.charts[0])}
    for k, chart in enumerate(one.charts, start=1):
        drawn[f"{name}.svg" if k == 1 else f"{name}-{k}.svg"] = svg(chart)
    for file, picture in drawn.items():
        shipped = (DOCS / "validation" / file).read_text(encoding="utf-8")
        assert_allclose(places(picture), places(shipped), atol=0.5)


@pytest.mark.parametrize("name", MEASURED_SETS)
def test_every_measured_point_stands_in_the_table_beside_its_page(name: str):
    measured = load_set(name)
    rows = csv_rows(DOCS / "validation" / f"{page_of(name)}.csv")
    rows = [row for row in rows if row.get("Set", "") == measured.part]
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

"""The trust page stays current: its rows are recomputed, its tests exist, its text is that of the rows."""

import ast
import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from numpy.testing import assert_allclose
from rotor.reproduce.cross_codes import have
from rotor.reproduce.trust import KINDS, TrustRow, sensitivity_rows, trust_rows
from rotor.reproduce.trust_page import FAST, page, sensitivity
from rotor.reproduce.trust_rows import LIFT_SLOPE, public_codes

from rotor.airfoil.sections import load_section
from rotor.reproduce import ENTRIES, Report

TESTS = Path(__file__).parent.parent.parent
DOCS = TESTS.parent / "docs"
SHIPPED = {(row.kind, row.what, row.against): row for row in trust_rows()}


def still_true(made: TrustRow) -> None:
    """A recomputed row against the shipped one: bounds must hold, numbers must agree within their tolerance."""
    key = (made.kind, made.what, made.against)
    assert key in SHIPPED, f"{key} is not in assets/trust.csv: python -m rotor reproduce OUT --trust"
    shipped = SHIPPED[key]
    assert made.error is not None
    assert shipped.error is not None
    if shipped.bound:
        assert made.error < shipped.allowed, key
    else:
        assert abs(made.error - shipped.error) <= shipped.allowed, f"{key}: {shipped.error} → {made.error}"


def test_the_page_is_generated_from_the_shipped_rows():
    made = page(trust_rows(), sensitivity_rows())
    assert (DOCS / "validation.md").read_text(encoding="utf-8") == made, "copy validation.md of a --trust run to docs/"


def test_every_link_of_the_pages_has_a_target():
    """Links of theory, trust page and README point to existing files."""
    for text in (*DOCS.glob("*.md"), DOCS.parent / "README.md"):
        links = re.findall(r"\]\(([^)#]+)", text.read_text(encoding="utf-8"))
        # The site builds docs/_made/notebooks from docs/notebooks.
        written = [link.removesuffix("/index").replace("_made/", "") if "_made/" in link else link for link in links]
        missing = [link for link in written if "://" not in link and not (text.parent / link).exists()]
        assert not missing, f"{text.name}: {missing}"


def test_every_row_names_a_test_that_exists():
    known: dict[str, set[str]] = {}
    for path in TESTS.rglob("test_*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        known[path.relative_to(TESTS).as_posix()] = {
            node.name for node in tree.body if isinstance(node, ast.FunctionDef)
        }
    for row in trust_rows():
        file, _, name = row.test.partition("::")
        assert name in known.get(file, set()), f"{row.what}: {row.test}"


def test_every_kind_has_rows():
    assert {row.kind for row in trust_rows()} == set(KINDS)


@pytest.mark.slow
def test_fast_rows_are_reproduced():
    for make in FAST:
        for row in make():
            still_true(row)


@pytest.mark.slow
def test_verdicts_are_reproduced(report: Callable[[str], Report]):
    """Verdicts on the thesis' statements; none of chapter 4 can be judged."""
    shown = {row.what: row.shown for row in trust_rows() if row.kind == "document"}
    for entry in ENTRIES:
        if not entry.slow:
            one = report(entry.number)
            assert shown[one.title] == one.verdict.value, one.title
    assert len(shown) == len(ENTRIES)


def test_public_code_rows_are_reproduced():
    assert have("dynbem") or have("wisdem"), "pip install 'rotor-explorer[test]'"
    for row in public_codes():
        still_true(row)


@pytest.mark.slow
def test_sensitivities_are_reproduced():
    """Angles to 0.3°, a tenth of their bands; savings to a tenth of a per cent of power."""
    for made, shipped in zip(sensitivity(), sensitivity_rows(), strict=True):
        assert (made.change, made.mu) == (shipped.change, shipped.mu)
        assert_allclose(made.optimum_deg, shipped.optimum_deg, atol=0.3)
        assert_allclose(made.saving_percent, shipped.saving_percent, atol=0.1)
        assert made.low_deg <= made.optimum_deg <= made.high_deg


def test_lift_slope_compared_with_the_public_deck():
    """Within 2 % of the deck of CR-166309: McCroskey's slope (assets/airfoils/CITATION.md)."""
    for name, published in LIFT_SLOPE.items():
        table = load_section(name)
        slope = float(table(math.radians(8.0), 0.3).cl - table(0.0, 0.3).cl) / math.radians(8.0)
        assert 0.98 < slope / published < 1.03

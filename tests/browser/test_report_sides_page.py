"""The report on one actuator on paper: two sides of A4, in a browser that prints it."""

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import rotor
from explorer.export.actuator_sides import actuator_html
from explorer.export.contents import actuator_report

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.browser, pytest.mark.slow]


@pytest.mark.parametrize("actuator", ["MFC_P1", "SMA_tube"])
def test_it_is_two_printed_sides(browser: "Browser", actuator: str, tmp_path: Path):
    design = rotor.make_design(inflow="drees", elements=16, azimuths=36, mu=0.3)
    path = tmp_path / "report.html"
    path.write_text(actuator_html(actuator_report(actuator, design)), encoding="utf-8")
    page = browser.new_page(viewport={"width": 695, "height": 1039})  # 184 by 275 mm: A4 within its margins.
    page.goto(path.as_uri())
    printed = page.pdf(prefer_css_page_size=True)
    assert len(re.findall(rb"/Type\s*/Page\b", printed)) == 2
    page.emulate_media(media="print")
    sides = page.query_selector_all(".side")
    assert len(sides) == 2
    for side in sides:
        box = side.bounding_box()
        assert box is not None
        assert box["height"] < 1039
    assert page.evaluate("document.documentElement.scrollWidth") <= 695
    page.close()

"""Pictures and reports as text: complete, to the point, and nothing in them that needs a network."""

import io
import math
import re
import threading
import xml.etree.ElementTree as ET
from dataclasses import asdict, replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from explorer import __main__ as command
from explorer.charts import svg
from explorer.charts.line_chart import Trace, line_chart
from explorer.charts.plots import SWEEP, PowerCurve
from explorer.charts.power_curve import PowerCurves
from explorer.export.provenance import versions
from explorer.export.report import command as report_command
from explorer.export.report.contents import DesignReport, ReportEntry, report_of
from explorer.export.report.document import report_html
from explorer.export.sheet import SIZES, Paper, disk_sheet, shown, view_sheet, window
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.picture import disk_image
from explorer.picture.disk_image import SIZE
from explorer.picture.fields import FIELDS
from explorer.picture.picture import disk_png
from explorer.scene.still_scene import EmbeddedViewer, embedded_viewer, make_stage
from explorer.web import json_block
from rotor.design.design import Design
from rotor.trim.solution import Status
from rotor.trim.solve import solve

NOW = solve(Inputs().design())
BASELINE = solve(baseline_of(NOW.design))
FAST = solve(Inputs(law="linear", linear=-16.0, advance_ratio=0.41).design())
VIEW = ViewState()
ALPHA = FIELDS[VIEW.field]
RANGE = ALPHA.low, ALPHA.high
SHOWN = shown(VIEW)
SVG = "{http://www.w3.org/2000/svg}"


class Swept(PowerCurves):
    """Curves that cost nothing."""

    def sweep(self, design: Design, reference: Design, superseded: object, known: object = None) -> bool:
        return True

    def known(self, design: Design, reference: Design) -> PowerCurve:
        curve = 900.0 + 4000.0 * (np.array(SWEEP) - 0.2) ** 2
        holes = curve.copy()
        holes[-3:] = math.nan
        return PowerCurve(holes, curve, 0.9 * curve)


def words(document: ET.Element) -> str:
    return "\n".join(element.text or "" for element in document.iter(f"{SVG}text"))


class TestDrawing:
    def test_segments_that_share_ends_are_one_line(self):
        corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        ring = np.stack((corners, np.roll(corners, -1, axis=0)), axis=1)
        ring[2] = ring[2][::-1]  # Whichever way a segment runs.
        apart = np.array([[[3.0, 3.0], [4.0, 4.0]]])
        square, line = svg.joined(np.concatenate((ring, apart)))
        assert len(square) == 5
        assert_allclose(square[0], square[-1])
        assert_allclose(line, apart[0])
        assert svg.polylines([square]).endswith("Z")

    def test_the_disk_has_the_pixels_asked_for_up_to_the_largest(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setattr(disk_image, "LARGEST", 600)
        for size, made in ((200, 200), (SIZE, SIZE), (9000, 600)):
            assert Image.open(io.BytesIO(disk_png(NOW, ALPHA, RANGE, size=size))).size == (made, made)

    def test_a_chart_breaks_its_line_at_a_gap_and_keeps_inside_its_axes(self):
        x = np.linspace(0.0, 1.0, 9)
        y = np.array([0.0, 1.0, math.nan, 2.0, 3.0, math.nan, 1e9, 1.0, 0.0])
        chart = line_chart("A <title>", "x", "y", [Trace("one", "#123456", x, y)], (0.0, 1.0), (0.0, 4.0))
        drawn = ET.fromstring(chart)  # Well formed.
        (path,) = [p for p in drawn.iter("path") if p.get("stroke") == "#123456" and p.get("stroke-linejoin")]
        assert path.get("d", "").count("M") == 3
        assert "nan" not in chart
        assert max(abs(float(number)) for number in re.findall(r"-?\d+\.\d", path.get("d", ""))) < 1000.0

    def test_a_chart_of_nothing_known_is_empty_axes(self):
        nothing = np.full(3, math.nan)
        assert "nan" not in line_chart("t", "x", "y", [Trace("a", "red", nothing, nothing)], (0.0, 1.0))


class TestSheet:
    @pytest.mark.parametrize(("size", "dark"), [((1280, 720), True), ((2000, 2000), False)])
    def test_size_ground_and_words(self, size: tuple[int, int], dark: bool):
        assert size in SIZES.values()
        drawn = ET.fromstring(disk_sheet(FAST, SHOWN, Paper(*size, dark)))
        assert (drawn.get("width"), drawn.get("height")) == tuple(map(str, size))
        ground = drawn[0]
        assert ground.tag == f"{SVG}rect"
        assert (ground.get("fill") == "#ffffff") != dark
        said = words(drawn)
        assert f"{FAST.power.total / 1e3:,.0f} kW".replace(",", "\u2009") in said
        assert "µ 0.410 · 326 km/h · 176 kt · 8.32 t · 0 m" in said
        assert ALPHA.label in said
        assert "quasi-steady sections" in said  # Its caveat, broken into lines or not.
        assert "not a measurement" in said

    def test_words_stay_on_the_paper(self):
        for width, height in ((1280, 720), (800, 800), (700, 1000), (1000, 400)):
            drawn = ET.fromstring(disk_sheet(FAST, SHOWN, Paper(width, height)))
            for element in drawn.findall(f"{SVG}text"):
                assert 0.0 <= float(element.get("x", "-1")) <= width
                assert 0.0 <= float(element.get("y", "-1")) <= height

    def test_aviation_units_are_those_of_the_page(self):
        said = words(ET.fromstring(disk_sheet(FAST, shown(replace(VIEW, units="Aviation")), Paper(1280, 720))))
        assert f"{FAST.power.total / 745.699872:,.0f} hp".replace(",", "\u2009") in said
        assert "µ 0.410 · 176 kt · 326 km/h · 18\u2009342 lb · 0 ft" in said

    def test_transparent_paper_has_no_ground(self):
        assert ET.fromstring(disk_sheet(NOW, SHOWN, Paper(800, 450, transparent=True)))[0].tag != f"{SVG}rect"

    def test_lines_that_are_off_are_not_drawn_and_not_explained(self):
        plain = words(ET.fromstring(disk_sheet(NOW, shown(replace(VIEW, stall=False)), Paper(1280, 720))))
        assert "reverse flow" in plain
        assert "stall" not in plain.splitlines()

    @pytest.mark.parametrize("size", [(1280, 720), (2000, 2000), (600, 900)])
    def test_the_view_fills_its_window(self, size: tuple[int, int]):
        paper = Paper(*size)
        x, y, wide, high = window(FAST, paper)
        assert x + wide <= size[0]
        assert y + high <= size[1]
        drawn = ET.fromstring(view_sheet(FAST, SHOWN, paper, b"png"))
        (image,) = drawn.iter(f"{SVG}image")
        assert [float(image.get(name, "")) for name in ("x", "y", "width", "height")] == [x, y, wide, high]

    @pytest.mark.parametrize("size", [(100, 720), (1280, 9000), (3000, 500)])
    def test_a_size_that_cannot_be_is_one_sentence(self, size: tuple[int, int]):
        with pytest.raises(ValueError, match=r"^.*: keep .*\.$"):
            Paper(*size)


class Checked(HTMLParser):
    """What a page asks for, and whether its elements close."""

    VOID = frozenset({"meta", "br", "stop", "rect", "path", "circle", "image", "hr", "img"})

    def __init__(self, page: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wanted: list[str] = []
        self.ids: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in self.VOID:
            self.open.append(tag)
        for name, value in attrs:
            if name in ("src", "href", "srcset", "data") and value and not value.startswith(("data:", "#")):
                self.wanted.append(value)
            if name == "id" and value:
                self.ids.append(value)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert tag in self.VOID or self.open.pop() == tag


@pytest.fixture(scope="module")
def report() -> DesignReport:
    return report_of(
        ReportEntry("UH-60A as built", BASELINE), [ReportEntry("Now", NOW), ReportEntry("Kept <1>", FAST)], VIEW
    )


@pytest.fixture(scope="module")
def page(report: DesignReport) -> str:
    return report_html(report, EmbeddedViewer("a", "b", "c", ("d", "e")), Swept())


class TestReport:
    def test_is_one_file_that_requests_nothing(self, page: str):
        checked = Checked(page)
        assert checked.wanted == []
        assert checked.open == []
        assert len(set(checked.ids)) == len(checked.ids)
        assert not re.search(r"url\((?!#)|@import|https?://", page)
        assert not re.search(r"\b(nan|NaN|None|inf)\b", page)

    def test_says_power_parts_condition_caveats_and_versions(self, page: str):
        for solution in (NOW, FAST, BASELINE):
            assert f"{solution.power.total / 1e3:,.1f} kW".replace(",", "\u2009") in page
        assert f"{100 * (NOW.power.total / BASELINE.power.total - 1):+.1f} %".replace("-", "−") in page
        for caveat in FAST.caveats:
            assert f"<li>{caveat.sentence}</li>" in page
        for name, number in versions().items():
            assert f"<tr><td>{name}</td><td>{number}</td></tr>" in page
        assert "python -m rotor solve" in page
        assert "Kept &lt;1&gt;" in page

    def test_does_not_compare_what_flies_differently(self, page: str):
        assert "other flight condition" in page
        change = f"{100 * (FAST.power.total / BASELINE.power.total - 1):+.1f} %"
        assert change not in page

    def test_draws_four_disks_a_design_each_with_its_scale(self, page: str):
        assert page.count("over the disk") == 8
        assert page.count("<linearGradient") == 9  # One more below the view in 3D.
        assert page.count("data:image/png;base64,") == 8

    def test_stays_small(self, page: str):
        assert len(page) < 900_000  # Without the viewer, which has as much again.

    def test_aviation_units_are_those_of_the_page(self, report: DesignReport):
        page = report_html(replace(report, view=replace(VIEW, units="Aviation")), None, Swept())
        first = page.split('data-report="total-power">')[1]
        assert first.startswith(f"{NOW.power.total / 745.699872:,.0f} hp".replace(",", "\u2009"))
        assert "total power [hp]" in page

    def test_without_3d_there_is_none(self, report: DesignReport):
        assert "<iframe" not in report_html(report, None, Swept())

    def test_a_design_that_is_not_trimmed_is_refused_in_a_sentence(self):
        heavy = replace(NOW, status=Status.NOT_CONVERGED, message="Too heavy.")
        with pytest.raises(ValueError, match="Now is not trimmed, so it cannot be reported: Too heavy"):
            report_of(ReportEntry("A", BASELINE), [ReportEntry("Now", heavy)], VIEW)
        with pytest.raises(ValueError, match="no design to report on"):
            report_of(ReportEntry("A", BASELINE), [], VIEW)


class TestStage:
    def test_is_visers_page_in_parts_and_safe_inside_a_script(self):
        stage = make_stage([NOW, FAST], VIEW, RANGE)
        parts = asdict(stage)
        page = parts["before"] + parts["scenes"][1] + parts["between"] + "true" + parts["after"]
        assert page.startswith("<!doctype html>")
        assert "window.__VISER_EMBED_CONFIG__={darkMode:true};" in page
        assert stage.scenes[0] != stage.scenes[1]
        assert len(json_block("stage", parts)) < 1_550_000

    def test_two_at_once_leave_the_program_its_voice(self, capsys: pytest.CaptureFixture[str]):
        threads = [threading.Thread(target=make_stage, args=([NOW], VIEW, RANGE)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        print("still heard")
        assert capsys.readouterr().out == "still heard\n"

    def test_another_viewer_is_one_sentence(self):
        with pytest.raises(ValueError, match="not laid out as it was"):
            embedded_viewer(["<html></html>"])


class TestCommand:
    def test_design_files_become_one_report(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ):
        monkeypatch.setattr(report_command, "report_html", lambda report, stage: report_html(report, stage, Swept()))
        for name, solution in (("now", NOW), ("fast", FAST)):
            solution.design.save(tmp_path / f"{name}.json")
        out = tmp_path / "out.html"
        files = [str(tmp_path / f"{name}.json") for name in ("now", "fast")]
        assert command.main(["report", *files, "--out", str(out), "--field", "Mach number"]) == 0
        page = out.read_text(encoding="utf-8")
        assert f"{NOW.power.total / 1e3:,.0f} kW".replace(",", "\u2009") in page
        assert "Mach number" in page
        assert '"scenes":["' in page
        assert capsys.readouterr().out == f"{out}: 2 designs\n"

    def test_a_file_that_is_not_there_is_one_line(self, capsys: pytest.CaptureFixture[str]):
        assert command.main(["report", "nowhere.json"]) == 2
        assert capsys.readouterr().err.count("\n") == 1

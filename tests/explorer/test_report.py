"""Pictures and reports as text: complete, to the point, and nothing in them that needs a network."""

import io
import json
import math
import re
import threading
from collections.abc import Generator
from dataclasses import asdict, replace
from html import escape
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from explorer import __main__ as command
from explorer.charts.plots import SWEEP, PowerCurve, PowerCurves
from explorer.charts.svg import key_entries
from explorer.export import report as document
from explorer.export.blade import blade_mesh
from explorer.export.contents import DesignReport, ReportEntry
from explorer.export.provenance import versions
from explorer.export.report import report_html
from explorer.export.tables import blade, change_words, doubts, vibration
from explorer.model.inputs import Inputs, ViewState, baseline_of
from explorer.model.units import SI, UNITS
from explorer.picture import disk_image
from explorer.picture.disk_image import SIZE
from explorer.picture.fields import FIELDS
from explorer.picture.picture import disk_png
from explorer.scene.still_scene import EmbeddedViewer, embedded_viewer, make_stage
from explorer.text.line import sentence
from explorer.text.readout import part_change
from explorer.text.status import validated
from explorer.web import json_block
from rotor import Design, Status, doubt, hub_loads, make_design, solve
from tests.tools.lint_web import html_faults

NOW = solve(Inputs().design())
BASELINE = solve(baseline_of(NOW.design))
FAST = solve(Inputs(law="linear", linear=-16.0, advance_ratio=0.41).design())
VIEW = ViewState()
ALPHA = FIELDS[VIEW.field]
RANGE = ALPHA.low, ALPHA.high


class Swept(PowerCurves):
    """Curves that cost nothing."""

    def sweep(
        self, design: Design, reference: Design, superseded: object = None, known: object = None
    ) -> Generator[None, None, bool]:
        yield
        return True

    def known(self, design: Design, reference: Design) -> PowerCurve:
        curve = 900.0 + 4000.0 * (np.array(SWEEP) - 0.2) ** 2
        holes = curve.copy()
        holes[-3:] = math.nan
        return PowerCurve(holes, curve, 0.9 * curve)


class TestDrawing:
    def test_the_disk_has_the_pixels_asked_for_up_to_the_largest(
        self, monkeypatch: pytest.MonkeyPatch
    ):
        monkeypatch.setattr(disk_image, "LARGEST", 600)
        for size, made in ((200, 200), (SIZE, SIZE), (9000, 600)):
            assert Image.open(io.BytesIO(disk_png(NOW, ALPHA, RANGE, size=size))).size == (
                made,
                made,
            )

    def test_the_key_has_only_what_is_marked_and_there(self):
        assert [title for title, _ in key_entries(FAST)] == [
            "reverse flow",
            "separated",
            "past the static angle",
            "drag divergence",
        ]
        assert "reverse flow" not in dict(key_entries(solve(NOW.design.at(hover=True))))


@pytest.fixture(scope="module")
def report() -> DesignReport:
    return DesignReport(
        ReportEntry("UH-60A as built", BASELINE),
        [ReportEntry("Now", NOW), ReportEntry("Kept <1>", FAST)],
        VIEW,
    )


@pytest.fixture(scope="module")
def page(report: DesignReport) -> str:
    return report_html(report, EmbeddedViewer("a", "b", "c", ("d", "e")), Swept())


class TestReport:
    def test_is_one_file_that_requests_nothing(self, page: str):
        assert html_faults(page) == []
        assert re.findall(r'\b(?:src|href|srcset|data)="(?!data:|#)[^"]+"', page) == []
        ids = re.findall(r'\sid="([^"]+)"', page)
        assert len(set(ids)) == len(ids)
        assert not re.search(r"url\((?!#)|@import|https?://", page)
        assert not re.search(r"\b(nan|NaN|None|inf)\b", page)

    def test_says_power_parts_condition_caveats_and_versions(self, page: str):
        for solution in (NOW, FAST, BASELINE):
            assert f"{solution.power.total / 1e3:,.1f} kW".replace(",", "\u2009") in page
        band = doubt(NOW, BASELINE)
        assert band.saving_words in page
        for part in ("total", "induced", "profile", "main_rotor"):
            change, word = part_change(part, NOW.power, BASELINE.power, band, SI)
            assert f"<small>{change} kW: {word}</small>" in page
        for caveat in FAST.caveats:
            assert f"<li>{SI.in_power_unit(caveat.sentence)}</li>" in page
        for name, number in versions().items():
            assert f"<tr><td>{name}</td><td>{number}</td></tr>" in page
        assert escape(json.dumps(FAST.design.to_dict()["twist"]), quote=False) in page
        assert "Kept &lt;1&gt;" in page
        assert validated(NOW).sentence in page.partition("<footer>")[2]

    def test_hub_loads_of_blades_that_bend(self, page: str):
        assert "Vibration index" not in page
        design = make_design(mu=0.3, inflow="pitt-peters", bending=True)
        fast, slow = solve(design), solve(design.at(mu=0.1))
        words = vibration(fast)
        loads = hub_loads(fast)
        assert f"{loads.index:.1f} % of weight" in words
        assert "over inflow models" in words
        assert "below µ 0.2" in vibration(slow)
        assert "per rev" in vibration(slow)

    def test_does_not_compare_what_flies_differently(self, page: str):
        assert "other flight condition" in page
        change = f"{100 * (FAST.power.total / BASELINE.power.total - 1):+.1f} %"
        assert change not in page

    @pytest.mark.parametrize("units", UNITS)
    def test_causes_add_up_to_the_band_above_them(self, units: str):
        """As squares, for power and for the change apart, within the digits printed."""
        near = ReportEntry("Now", NOW)
        report = DesignReport(ReportEntry("A", BASELINE), [near], replace(VIEW, units=units))
        tables = re.findall(
            r"<h3>(Uncertainty of .+?)</h3><table>(.+?)</table>", doubts(report, near)
        )
        assert [title for title, _ in tables] == [
            "Uncertainty of power",
            "Uncertainty of the change",
        ]
        band, size = doubt(NOW, BASELINE), UNITS[units].power[0].size
        for (_, rows), known in zip(tables, (band.band, band.change_band), strict=True):
            first, *causes = [
                float(value) for value in re.findall(r"±\s([\d.]+)\s\w+</td></tr>", rows)
            ]
            assert known is not None
            assert first == pytest.approx(known / size, rel=0.06)
            assert math.hypot(*causes) == pytest.approx(first, rel=0.1)
            assert causes[0] > 0.3 * first

    def test_a_change_has_a_colour_where_its_sign_is_known(self):
        near = replace(
            BASELINE.design, twist=Inputs(law="builtin", built_inner=-0.2).design().twist
        )
        for design, sureness in ((near, "unclear"), (NOW.design, "likely")):
            entry = ReportEntry("Now", solve(design))
            report = DesignReport(ReportEntry("As built", BASELINE), [entry], VIEW)
            assert doubt(entry.solution, BASELINE).sureness == sureness
            words = str(change_words(report, entry))
            assert ("less" in words or "more" in words) == (sureness == "likely")

    def test_a_blade_as_built_is_compared_with_nothing(self):
        alone = DesignReport(
            ReportEntry("As built", BASELINE), [ReportEntry("Now", solve(BASELINE.design))], VIEW
        )
        page = report_html(alone, None, Swept())
        assert page.count('data-report="total-power"') == 1
        assert "reference</span>" not in page
        assert "Side by side" not in page
        assert "Change of power" not in page
        assert "Uncertainty of the change" not in page
        assert "Uncertainty of power" in page

    def test_the_first_page_of_a_print_has_the_line_the_rotor_and_the_disk(self):
        alone = DesignReport(ReportEntry("As built", BASELINE), [ReportEntry("Now", NOW)], VIEW)
        page = report_html(alone, None, Swept(), rotor=b"drawn")
        line = sentence(NOW, alone.units, BASELINE, doubt(NOW, BASELINE))
        assert f"<h1>{line}</h1>".replace("\u00a0", " ") in page.replace("\u00a0", " ")
        front = page[page.index('class="front"') : page.index('class="glance"')]
        assert "image/webp;base64,ZHJhd24=" in front
        assert front.count('aria-label="Angle of attack over the disk"') == 1

    def test_chords_are_those_of_the_stl(self):
        said = re.search(r"Chord \[m\]</td>(.+?)</tr>", blade(NOW.design))
        drawn = blade_mesh(NOW.design).vertices
        assert said is not None
        for r, chord in zip(
            (0.6, 0.95),
            np.array(re.findall(r"[\d.]+(?=</td>)", said[1]), float)[[5, 11]],
            strict=True,
        ):
            near = drawn[np.abs(drawn[:, 0] - r * NOW.design.rotor.radius) < 0.04]
            assert np.ptp(near[:, 1]) == pytest.approx(chord, abs=0.004)

    def test_aviation_units_are_those_of_the_page(self, report: DesignReport):
        page = report_html(replace(report, view=replace(VIEW, units="Aviation")), None, Swept())
        first = page.split('data-report="total-power">')[1]
        assert first.startswith(f"{NOW.power.total / 745.699872:,.0f} hp".replace(",", "\u2009"))
        assert "total power [hp]" in page
        cares = "".join(re.findall(r'<ul class="care">.*?</ul>', page, re.S))
        assert "hp" in cares
        assert "kW" not in cares

    def test_a_design_that_is_not_trimmed_is_refused_in_a_sentence(self):
        heavy = replace(NOW, status=Status.NOT_CONVERGED, message="Too heavy.")
        with pytest.raises(
            ValueError, match="Now is not trimmed, so it cannot be reported: Too heavy"
        ):
            DesignReport(ReportEntry("A", BASELINE), [ReportEntry("Now", heavy)], VIEW)
        with pytest.raises(ValueError, match="no design to report on"):
            DesignReport(ReportEntry("A", BASELINE), [], VIEW)


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
        monkeypatch.setattr(
            document, "report_html", lambda report, stage: report_html(report, stage, Swept())
        )
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

    def test_a_file_of_another_kind_is_refused(
        self, tmp_path: Path, capsys: pytest.CaptureFixture[str]
    ):
        """It held HTML."""
        NOW.design.save(tmp_path / "now.json")
        assert (
            command.main(["report", str(tmp_path / "now.json"), "--out", str(tmp_path / "now.pdf")])
            == 2
        )
        assert "write '" in capsys.readouterr().err
        assert not (tmp_path / "now.pdf").exists()

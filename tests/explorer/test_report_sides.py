"""The report on one actuator: its numbers are those of the Python API, and every row leads to what exists."""

import math
import re
from functools import cache
from pathlib import Path

import pytest

import rotor
from explorer.export import contents
from explorer.export.actuator_sides import SOURCES, actuator_html
from explorer.export.contents import ActuatorReport, actuator_report
from explorer.export.report import main
from rotor.actuator import Verdict, actuator_stability, failure, fly, phase_sweep, try_actuator, verdict_sentence

ROOT = Path(__file__).parents[2]
MU = 0.3
DESIGN = rotor.make_design(inflow="drees", elements=16, azimuths=36, mu=MU)


@cache
def verdict() -> Verdict:
    return try_actuator("MFC_P1", DESIGN, (0.0, MU))


@cache
def report() -> ActuatorReport:
    return actuator_report("MFC_P1", DESIGN)


@cache
def page() -> str:
    return actuator_html(report())


def rows() -> dict[str, list[str]]:
    """Cells after the first of each row of numbers, by its key."""
    found = re.findall(r'<tr(?: class="\w+")? data-report="([^"]*)">(.*?)</tr>', page())
    assert found
    return {key: re.findall(r"<td>([^<]*)</td>", row)[1:] for key, row in found}


def value(text: str) -> float:
    """The first number of a cell."""
    found = re.search(r"[+-]?\d+(\.\d+)?", text.replace("\u2009", "").replace("−", "-"))
    assert found, text
    return float(found[0])


def shown(key: str) -> list[float]:
    return [value(cell) for cell in rows()[key] if re.search(r"\d", cell)]


@pytest.mark.slow
def test_what_it_moves_saves_and_weighs():
    here = verdict()
    degrees = {"reach": here.attainable, "derated": here.attainable_derated, "required": here.required,
               "attained": here.attained, "rate": here.installed.twist_rate}  # fmt: skip
    for key, angle in degrees.items():
        assert shown(key) == [pytest.approx(math.degrees(angle), abs=0.0051)], key
    assert shown("moment") == [pytest.approx(here.installed.moment, abs=0.51)]
    assert shown("net") == [pytest.approx(1e-3 * here.net_saving, abs=0.051)]
    assert here.net_band is not None
    assert shown("band") == [pytest.approx(1e-3 * here.net_band, abs=0.051)]
    assert rows()["band"][0].partition(": ")[2] in verdict_sentence(here)
    assert shown("ideal") == [pytest.approx(1e-3 * here.ideal_saving, abs=0.051)]
    assert shown("mass") == [pytest.approx(here.installed.masses.aircraft, abs=0.051)]
    assert shown("slew-power") == [pytest.approx(here.drive.slew_power, abs=0.51)]
    assert verdict_sentence(here) in page()
    for limit in here.limits:
        assert rows()[f"limit-{limit.name}"] == ["met" if limit.ok else "exceeded"]


@pytest.mark.slow
def test_the_flight_is_that_of_fly():
    flight = fly(verdict())
    legs = re.findall(r"<tr><td>[^<]*</td>(.*?)<td class=\"link\">", page())
    assert len(legs) == len(flight.legs)
    for k, leg in enumerate(legs):
        wanted, reached, _, net, _ = map(value, re.findall(r"<td>([^<]*)</td>", leg))
        assert wanted == pytest.approx(math.degrees(flight.wanted[k]), abs=0.051)
        assert reached == pytest.approx(math.degrees(flight.reached[k]), abs=0.051)
        assert net == pytest.approx(1e-3 * flight.net_saving[k], abs=0.051)


@pytest.mark.parametrize(("stop", "mu"), [(0.0, MU), (0.25, 0.0), (0.25, MU)])
def test_failure_is_that_of_the_api(stop: float, mu: float):
    (point,) = failure(verdict(), stops_at=stop, mu=[mu]).points
    there, one = point.stopped, point.one_blade
    assert there.power is not None
    assert point.cost is not None
    assert point.power_left is not None
    loads = [] if one is None else [one.force_n, one.moment_nm, 1e3 * one.track_m]
    of_api = [
        math.degrees(there.twist), 1e-3 * there.power, 1e-3 * point.cost, 1e-3 * point.power_left,
        100.0 * there.stalled_area, math.degrees(there.collective), math.degrees(there.cyclic),
        100.0 * (there.controls_left or 0.0), *loads,
    ]  # fmt: skip
    cells = [value(cell) for cell in rows()[f"failure-{stop:g}-{mu:g}"][1:] if re.search(r"\d", cell)]
    assert cells == pytest.approx(of_api, abs=0.51)
    assert cells[0] == pytest.approx(of_api[0], abs=0.0051)
    assert cells[2] == pytest.approx(of_api[2], abs=0.051)


def test_stability_is_that_of_the_api():
    cases = actuator_stability(verdict().installed, DESIGN).cases
    for mode in ("flap 1", "lag 1", "torsion 1"):
        pairs = [re.findall(r"\d+\.\d+", cell) for cell in rows()[f"mode-{mode}"]]
        assert len(pairs) == len(cases) == 3
        for (frequency, damping), case in zip(pairs, cases.values(), strict=True):
            assert float(frequency) == pytest.approx(case.mode(mode).frequency, abs=0.0051)
            assert float(damping) == pytest.approx(100.0 * case.mode(mode).damping_ratio, abs=0.051)
    margins = [case.margins for case in cases.values()]
    for cell, margin in zip(rows()["margin-flutter"], margins, strict=True):
        assert margin is not None
        assert value(cell) == pytest.approx(100.0 * margin.instability_stiffness, abs=0.51)


def test_vibration_and_twist_at_n_per_rev_are_those_of_the_api():
    bending = rotor.make_design(inflow="drees", elements=16, azimuths=36, mu=MU, bending=True)
    loads = rotor.solve(bending).hub_loads
    assert loads is not None
    assert shown("index-built") == [pytest.approx(loads.index, abs=0.0051)]
    assert rows()["index-built"] != rows()["index-fitted"]
    sweep = phase_sweep(verdict().actuator_off, verdict().installed, 2, reference=verdict().without_actuator)
    assert shown("wave") == [pytest.approx(math.degrees(sweep.response[0]), abs=0.0051)]
    assert shown("wave-saving") == [pytest.approx(1e-3 * sweep.wave_saving, abs=0.051)]
    assert sweep.net_saving is not None
    assert shown("wave-net") == [pytest.approx(1e-3 * sweep.net_saving, abs=0.051)]


def test_the_envelope_is_that_of_the_api():
    envelope = rotor.envelope(DESIGN, [MU])
    (point,) = envelope.points
    n, top = point.load_factor, envelope.top_speed.value
    assert n.stall is not None
    assert top is not None
    assert shown("n-stall")[0] == pytest.approx(n.stall, abs=0.0051)
    assert rows()["n-engines"][0] == ("–" if n.engines is None else f"{n.engines:.2f}")
    assert shown("top-speed")[0] == pytest.approx(envelope.record()["top_speed_kt"], abs=0.51)
    assert shown("n-stall")[1] < shown("n-stall")[0]  # It carries the actuator.


def test_every_row_of_numbers_leads_to_a_source():
    body = re.findall(r"<tbody>(.*?)</tbody>", page())
    lines = [row for table in body for row in re.findall(r"<tr.*?</tr>", table)]
    assert len(lines) > 40
    for row in lines:
        (source,) = re.findall(r'href="#source-([\w-]+)"', row)
        assert page().count(f'id="source-{source}"') == 1, row
        assert source in SOURCES


@pytest.mark.parametrize("name", SOURCES)
def test_every_source_exists(name: str):
    words, place, test = SOURCES[name]
    path, _, anchor = place.partition("#")
    text = (ROOT / path).read_text(encoding="utf-8")
    heads = [re.sub(r"[^\w -]", "", head.lower()).replace(" ", "-") for head in re.findall(r"^#+ (.*)$", text, re.M)]
    assert not anchor or anchor in heads
    assert "def test_" in (ROOT / test).read_text(encoding="utf-8")
    assert words in page()


def test_a_part_that_cannot_be_computed_is_a_sentence(monkeypatch: pytest.MonkeyPatch):
    """Without blades that bend, and where a leg of the failure does not trim."""

    def none(*_: object, **__: object) -> None:
        raise RuntimeError("µ 0.25: no trim.")

    for name in ("failure", "actuator_stability", "phase_sweep", "reach"):
        monkeypatch.setattr(contents, name, none)
    slow = actuator_report("MFC_P1", DESIGN.at(mu=0.1))
    text = actuator_html(slow)
    assert text.count("µ 0.25: no trim.") == 4
    assert "No hub loads below µ 0.2" in text


def test_command_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    """`--actuator` writes the two sides in place of the comparison."""
    DESIGN.save(tmp_path / "a.json")
    design, out = str(tmp_path / "a.json"), tmp_path / "r.html"
    assert main([design, "--actuator", "glue", "--out", str(out)]) == 2
    assert "actuator 'glue' is not known" in capsys.readouterr().err
    assert main([design, design, "--actuator", "MFC_P1", "--out", str(out)]) == 2
    assert "is of one design" in capsys.readouterr().err
    rotor.make_design(rotor="s61").save(tmp_path / "s61.json")
    assert main([str(tmp_path / "s61.json"), "--actuator", "MFC_P1", "--out", str(out)]) == 2
    assert "choose that rotor" in capsys.readouterr().err
    assert not out.exists()
    monkeypatch.setattr("explorer.export.report.actuator_report", lambda *_: report())
    assert main([design, "--actuator", "MFC_P1", "--out", str(out)]) == 0
    assert out.read_text(encoding="utf-8") == page()

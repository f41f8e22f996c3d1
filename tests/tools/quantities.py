"""Every number of a design by its quantity: the function of `rotor` that gives its value, and the places that show it.

`python -m tests.tools.quantities FILE.csv` writes what each place shows of three rotors and of three actuators. A new
place is one line in `QUANTITIES`: tests/explorer/test_quantities.py compares it from then on.
"""

import csv
import math
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from explorer.charts.strip import alpha_chart
from explorer.model.inputs import Inputs
from explorer.picture.ride import turn_of
from explorer.text.readout import ideal_induced
from rotor import hub_loads
from rotor.actuator import Verdict
from rotor.support.chart import Line
from rotor.trim.doubt import rounded_pair
from tests.actuate import INPUTS
from tests.tools.screens import PSI_DEG, STATION, TURN_STEP, Screen, actuated, explored, plain

NUMBER = r"[+−-]?\d+(?:[\u2009,]\d{3})*(?:\.\d+)?"
"""A number on screen or in a text."""
_SAME = 1e-5
"""Part of a number by which it may differ where it was divided by another unit."""
_KILO = 1e3
_REGION = "(?:[Ss]talled|[Ss]eparated)"
_SOLUTION_RECORD = "rotor.trim.export.solution_record"
_TRIM_PANEL = "explorer.text.readout.trim_panel"
_DOUBT_RECORD = "rotor.trim.doubt.Doubt.record"
_DOUBT_SENTENCE = "rotor.trim.doubt.Doubt.sentence"
_SOLVE = "rotor.command.solve.report"
_POWER_PANEL = "explorer.text.readout.power_panel"
_COMPARISON = "explorer.export.tables.comparison"
_PROBE_PANEL = "explorer.charts.probe_drawing.probe_panel"
_CARD = "explorer.views.assessed.card"
_CAUSES = "explorer.export.tables.doubts"
_FLIGHT_BAR = "explorer.views.flight.view"
_LIVE = "explorer.export.live.live_html"
_RAIL = "explorer.views.actuator_words.fit_panel"
_ACTUATOR = "rotor.command.actuator.report"
_SECTION = "explorer.export.figures.actuator_section"
_VERDICT_RECORD = "rotor.command.actuator.record"


Read = Callable[[Screen], str]
"""The number of a place as it is printed there; empty where it is not shown."""


class Place(NamedTuple):
    """A place that shows a quantity."""

    name: str
    function: str
    """Of the program, from which the place has its number."""
    read: Read


class ShownQuantity(NamedTuple):
    """A quantity with its value and the places that show it."""

    name: str
    unit: str
    function: str
    """Of `rotor`, whose value all places must have."""
    value: Callable[[Screen], float | None]
    """In the unit; None where the design has none."""
    places: tuple[Place, ...]
    printed: Callable[[Screen], float | None] = lambda screen: None
    """Of a change and its band, which are rounded together: the value as `rounded_pair` prints it."""


def first_number(pattern: str, text: str) -> str:
    """The first number of a text, at # in a pattern; empty where the pattern is not there."""
    found = re.search(pattern.replace("#", f"({NUMBER})"), text)
    return "" if found is None else found[1]


def _line(part: str, pattern: str = "#") -> Read:
    """A part of the line on top."""

    def read(screen: Screen) -> str:
        pieces = (screen.frame.get("line") or {}).get("pieces", ())
        named = (one["text"] for one in pieces if one["part"] == part and not one["stale"])
        return first_number(pattern, "".join(named))

    return read


def _text(name: str, pattern: str) -> Read:
    """A text beside the frame."""
    return lambda screen: first_number(pattern, plain(screen.texts.get(name, "")))


def _frame(pattern: str, *path: str) -> Read:
    """A part of the frame, by the names that lead to its text."""

    def read(screen: Screen) -> str:
        found: Any = screen.frame
        for name in path:
            found = (found or {}).get(name)
        return first_number(pattern, found or "")

    return read


def _region(name: str, pattern: str) -> Read:
    """What is written beside a region of the disk."""

    def read(screen: Screen) -> str:
        regions = (screen.frame.get("plan") or {}).get("regions", ())
        words = " ".join(one["words"] for one in regions if one["name"] == name)
        return first_number(pattern, words)

    return read


def _status(pattern: str) -> Read:
    """The end of the line."""

    def read(screen: Screen) -> str:
        line = screen.frame.get("line") or {}
        return first_number(pattern, line["status"]["words"]) if line else ""

    return read


def _document(name: str, pattern: str) -> Read:
    """A text outside the page, by its name in `Documents`."""

    def read(screen: Screen) -> str:
        if screen.documents is None:
            return ""
        return first_number(pattern, getattr(screen.documents, name))

    return read


def _report(pattern: str) -> Read:
    return _document("report", pattern)


def _solved(pattern: str) -> Read:
    """What `rotor solve` prints."""
    return _document("solved", pattern)


def _cell(document: str, *path: str, size: float = 1.0) -> Read:
    """A number of a document with keys, by its place in it, in so many of its units."""

    def read(screen: Screen) -> str:
        if screen.documents is None:
            return ""
        return _exact(getattr(screen.documents, document), path, size)

    return read


def _record(*path: str, size: float = 1.0) -> Read:
    """A number of `rotor solve --json`."""
    return _cell("record", *path, size=size)


def _verdict_record(*path: str, size: float = 1.0) -> Read:
    """A number of `rotor actuator --json`."""
    return _cell("verdict_record", *path, size=size)


def _travelling(name: str) -> Read:
    """A number of the page that travels, in whole kilowatts as for a heavy helicopter."""

    def read(screen: Screen) -> str:
        value = None if screen.documents is None else screen.documents.travelling.get(name)
        return "" if value is None else f"{value:.0f}"

    return read


def _swept(name: str, size: float = 1.0) -> Read:
    """A number of `rotor sweep`."""
    return _cell("swept", name, size=size)


def _unsigned(read: Read) -> Read:
    """A number without its sign, which places write as a word."""
    return lambda screen: read(screen).lstrip("-")


def _undriven(read: Read) -> Read:
    """A number without its sign; empty where a drive takes power, which only the page adds to a change."""
    return lambda screen: "" if screen.drive else read(screen).lstrip("-")


def _exact(record: Any, path: Sequence[str], size: float) -> str:
    """The number at a path in nested records, with all its digits; empty where it is not there."""
    for name in path:
        record = (record or {}).get(name)
    return "" if record is None else repr(float(record) / size)


def _least_induced(screen: Screen) -> float | None:
    ideal = ideal_induced(screen.solution)
    return None if ideal is None else ideal / _KILO


def _elastic_tip(screen: Screen) -> float | None:
    elastic = screen.solution.elastic
    return None if elastic is None else math.degrees(float(elastic.tip.mean()))


def _pitch_link(screen: Screen) -> float | None:
    elastic = screen.solution.elastic
    return None if elastic is None else float(elastic.pitch_link_load.mean()) / _KILO


def _index(screen: Screen) -> float | None:
    if not screen.solution.design.models.bending:
        return None
    loads = hub_loads(screen.solution)
    return None if loads is None else loads.index


def _column(screen: Screen) -> int:
    """The column of the disk's fields at the azimuth of the section."""
    return round(PSI_DEG / 360.0 * len(screen.solution.disk.psi))


def _alpha_along(screen: Screen) -> str:
    """The chart of the angle of attack along the blade, at the element of the section."""
    if screen.documents is None:
        return ""
    own = alpha_chart(screen.solution, None, PSI_DEG).series[-1]
    assert isinstance(own, Line)
    return repr(float(own.y[STATION]))


def _ride(name: str) -> Read:
    """A turn with the section, where it passes the azimuth of the section."""

    def read(screen: Screen) -> str:
        if screen.documents is None:
            return ""
        turn = turn_of(screen.solution, float(screen.solution.disk.r[STATION]), PSI_DEG)
        value = getattr(turn, name)[TURN_STEP]
        return "" if value is None else str(value)

    return read


def _of_verdict(read: Callable[[Verdict], float | None]) -> Callable[[Screen], float | None]:
    """A number of the verdict; None where there is none."""
    return lambda screen: None if screen.verdict is None else read(screen.verdict)


def _net_pair(verdict: Verdict) -> tuple[float, float]:
    """The net saving without its sign and its band, as they are printed [kW]."""
    pair = rounded_pair(abs(verdict.net_saving) / _KILO, (verdict.net_band or 0.0) / _KILO)
    return pair.change, pair.band


def _balance_total(screen: Screen) -> str:
    """The total of the chart of extra power, without its sign."""
    bars = (screen.frame.get("earns") or {}).get("bars", ())
    return "".join(bar["text"] for bar in bars if bar["total"]).lstrip("+−")


def _section(pattern: str) -> Read:
    """The report's section on the actuator."""
    return _document("actuator", pattern)


def _judged(pattern: str) -> Read:
    """What `rotor actuator` prints."""
    return _document("judged", pattern)


def _pays(screen: Screen) -> str:
    """The sentence of the card that says which mass would pay."""
    return first_number("below # kg", "".join((screen.frame.get("assessed") or {}).get("pays", ())))


def _pair(screen: Screen, *, percent: bool = False) -> tuple[float, float] | None:
    """A change without its sign and its band as they are printed, in kW or in per cent; None where there is none."""
    if percent:
        change = _saving(screen)
        band = _saving_band(screen)
    else:
        change = _change(screen)
        band = _change_band(screen)
    if change is None or band is None:
        return None
    pair = rounded_pair(change, band)
    return pair.change, pair.band


def _of_pair(k: int, *, percent: bool = False) -> Callable[[Screen], float | None]:
    """The change (0) or the band (1) of `_pair`."""

    def read(screen: Screen) -> float | None:
        pair = _pair(screen, percent=percent)
        return None if pair is None else pair[k]

    return read


def _change(screen: Screen) -> float | None:
    """The change of power without its sign [kW]; None where there is none."""
    if screen.band.change is None or screen.band.sureness is None:
        return None
    return abs(screen.band.change + screen.drive) / _KILO


def _change_band(screen: Screen) -> float | None:
    """The band of the change of power [kW]; None where there is none."""
    band = screen.band
    return None if band.sureness is None else (band.change_band or 0.0) / _KILO


def _saving(screen: Screen) -> float | None:
    """The change of power without its sign, in per cent of the reference; None where there is none."""
    band = screen.band
    if band.sureness is None or not band.against:
        return None
    return abs(100.0 * (band.change or 0.0) / band.against)


def _saving_band(screen: Screen) -> float | None:
    """The band of that change in per cent of the reference; None where there is none."""
    return None if screen.band.sureness is None else screen.band.change_band_percent


def _power_part(name: str, title: str) -> ShownQuantity:
    """A part of the power, by its title on the page."""

    def card(screen: Screen) -> str:
        parts = (screen.frame.get("power") or {}).get("parts", ())
        return "".join(one["value"] for one in parts if one["part"] == name)

    words = title.lower()
    return ShownQuantity(
        f"{words} power",
        "kW",
        f"Solution.power.{name}",
        lambda screen: getattr(screen.solution.power, name) / _KILO,
        (
            Place("power card", "explorer.views.power.power_card", card),
            Place(
                "power and trim",
                "explorer.text.readout.power_panel",
                _text("details.power", f"{title} # kW"),
            ),
            Place("report", "explorer.export.tables.comparison", _report(f"{title} # kW")),
            Place("solve", "rotor.command.solve.report", _solved(f"(?m)^{words} +# kW")),
            Place("solve --json", _SOLUTION_RECORD, _record("power_w", name, size=_KILO)),
            Place("sweep", "rotor.study.series.SweepTable", _swept(f"power_{name}_w", _KILO)),
        ),
    )


def _angle(name: str, title: str, words: str) -> ShownQuantity:
    """An angle of the trim, by its titles in the drawer and in the command's text."""
    return ShownQuantity(
        words,
        "°",
        f"Solution.controls.{name}",
        lambda screen: math.degrees(getattr(screen.solution.controls, name)),
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", f"{title} #°")),
            Place("solve", "rotor.command.solve.report", _solved(f"(?m)^{words} +# °")),
            Place("solve --json", _SOLUTION_RECORD, _record(f"{name}_deg")),
        ),
    )


QUANTITIES: tuple[ShownQuantity, ...] = (
    ShownQuantity(
        "total power",
        "kW",
        "Solution.power.total",
        lambda screen: screen.solution.power.total / _KILO,
        (
            Place("line", "explorer.text.line.power_pieces", _line("total-power")),
            Place("power and trim", _POWER_PANEL, _text("details.power", "^ ?# kW")),
            Place("trust", _DOUBT_SENTENCE, _text("trust.doubts", "Power # ±")),
            Place("flight bar", _FLIGHT_BAR, _frame(": # kW", "flight", "words")),
            Place("report, line", "explorer.text.line.sentence", _report(" needs # ±")),
            Place("report, card", "explorer.export.report.report_html", _report(" Now # kW")),
            Place("report, table", _COMPARISON, _report("Total power # kW")),
            Place("page that travels", _LIVE, _travelling("power")),
            Place("CSV", "explorer.export.provenance.provenance_lines", _document("provenance", "total power # kW")),
            Place("notebook", "rotor.Solution.__repr__", _document("notebook", "power # kW")),
            Place("solve", _SOLVE, _solved("(?m)^total +# kW")),
            Place("solve --json", _SOLUTION_RECORD, _record("power_w", "total", size=_KILO)),
            Place("solve --doubt", _DOUBT_RECORD, _record("doubt", "power_w", size=_KILO)),
            Place("sweep", "rotor.study.series.SweepTable", _swept("power_total_w", _KILO)),
        ),
    ),
    _power_part("induced", "Induced"),
    _power_part("profile", "Profile"),
    _power_part("parasite", "Parasite"),
    _power_part("tail", "Tail rotor"),
    ShownQuantity(
        "band of power",
        "kW",
        "doubt(solution).band",
        lambda screen: screen.band.band / _KILO,
        (
            Place("line", "explorer.text.line.power_pieces", _line("within")),
            Place("trust", _DOUBT_SENTENCE, _text("trust.doubts", f"Power {NUMBER} ± #")),
            Place("report, line", "explorer.text.line.sentence", _report(f"needs {NUMBER} ± #")),
            Place("report, card", "explorer.export.report.report_html", _report(f" Now {NUMBER} kW ± #")),
            Place("report, causes", _CAUSES, _report("Uncertainty of power Power ± #")),
            Place("page that travels", _LIVE, _travelling("band")),
            Place("solve --doubt", _DOUBT_RECORD, _record("doubt", "total_w", size=_KILO)),
        ),
    ),
    ShownQuantity(
        "change of power",
        "kW",
        "doubt(solution, reference).change",
        _change,
        (
            Place("line", "explorer.text.line.change_pieces", _line("moved")),
            Place("report, line", "explorer.text.line.sentence", _report(f"kW: # ± {NUMBER} kW (?:more|less)")),
            Place("report, table", _COMPARISON, _report(f"Total power {NUMBER} kW [+−]?# ±")),
            Place("solve --doubt", _DOUBT_RECORD, _undriven(_record("doubt", "change_w", size=_KILO))),
        ),
        _of_pair(0),
    ),
    ShownQuantity(
        "band of the change",
        "kW",
        "doubt(solution, reference).change_band",
        _change_band,
        (
            Place("line", "explorer.text.line.change_pieces", _line("sure-band")),
            Place("report, line", "explorer.text.line.sentence", _report(f"kW: {NUMBER} ± # kW (?:more|less)")),
            Place("report, table", _COMPARISON, _report(f"Total power {NUMBER} kW {NUMBER} ± #")),
            Place("report, causes", _CAUSES, _report(r"Uncertainty of the change Change: \w+ ± #")),
            Place("solve --doubt", _DOUBT_RECORD, _record("doubt", "change_band_w", size=_KILO)),
        ),
        _of_pair(1),
    ),
    ShownQuantity(
        "saving",
        "%",
        "doubt(solution, reference).saving_words",
        _saving,
        (
            Place("power and trim", _POWER_PANEL, _text("details.power", "(?:saves|costs) # ±")),
            Place("trust", _DOUBT_SENTENCE, _text("trust.doubts", "It (?:saves|costs) # ±")),
            Place("report, card", "explorer.export.tables.change_words", _report("hp (?:saves|costs) # ±")),
            Place("sweep", "rotor.study.series.SweepTable", _unsigned(_swept("change_percent"))),
        ),
        _of_pair(0, percent=True),
    ),
    ShownQuantity(
        "band of the saving",
        "%",
        "doubt(solution, reference).change_band_percent",
        _saving_band,
        (
            Place("power and trim", _POWER_PANEL, _text("details.power", f"(?:saves|costs) {NUMBER} ± #")),
            Place("trust", _DOUBT_SENTENCE, _text("trust.doubts", f"It (?:saves|costs) {NUMBER} ± #")),
            Place("report, card", "explorer.export.tables.change_words", _report(f"hp (?:saves|costs) {NUMBER} ± #")),
            Place("sweep", "rotor.study.series.SweepTable", _swept("change_band_percent")),
        ),
        _of_pair(1, percent=True),
    ),
    ShownQuantity(
        "reverse flow",
        "% of the disk",
        "Solution.reverse_flow_area",
        lambda screen: 100.0 * screen.solution.reverse_flow_area,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", "Reverse flow # %")),
            Place("disk", "explorer.picture.plan.plan", _region("reverse_flow", "# % area")),
            Place("report", "explorer.export.tables.trim", _report("Reverse flow # % of the disk")),
            Place("solve", _SOLVE, _solved("reverse flow # %")),
            Place("solve --json", _SOLUTION_RECORD, _record("reverse_flow_area_percent")),
        ),
    ),
    ShownQuantity(
        "separated area",
        "% of the disk",
        "Solution.stalled_area",
        lambda screen: 100.0 * screen.solution.stalled_area,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", f"{_REGION} area # %")),
            Place("line, status", "explorer.views.power.status", _status("# % of disk")),
            Place("disk", "explorer.picture.plan.plan", _region("stall", "# % area")),
            Place("key of the disk", "explorer.widgets.display.Display", _frame("#", "field", "shares", "stall")),
            Place("flight bar", _FLIGHT_BAR, _frame(f"# % (?:of the disk )?{_REGION}", "flight", "words")),
            Place("report, table", _COMPARISON, _report(f"{_REGION} area # %")),
            Place("report, trim", "explorer.export.tables.trim", _report(f"{_REGION} # % of the disk, ")),
            Place("caveat", "rotor.trim.validity.caveats", _report("# % of the disk(?: is|;) ")),
            Place("solve", _SOLVE, _solved(f"{_REGION} # % with")),
            Place("solve --json", _SOLUTION_RECORD, _record("stalled_percent", "area")),
        ),
    ),
    ShownQuantity(
        "thrust of the separated area",
        "% of the thrust",
        "Solution.stalled_thrust",
        lambda screen: 100.0 * screen.solution.stalled_thrust,
        (
            Place("line, status", "explorer.views.power.status", _status("# % of thrust")),
            Place("disk", "explorer.picture.plan.plan", _region("stall", "# % thrust")),
            Place("report, trim", "explorer.export.tables.trim", _report("% of the disk, # % of the thrust")),
            Place("solve", _SOLVE, _solved("with # % of the thrust")),
            Place("solve --json", _SOLUTION_RECORD, _record("stalled_percent", "thrust")),
        ),
    ),
    _angle("collective", "Collective θ0", "collective"),
    _angle("cyclic_1c", "Cyclic θ1c", "cyclic 1c"),
    _angle("cyclic_1s", "Cyclic θ1s", "cyclic 1s"),
    _angle("shaft_tilt", "Shaft tilt α", "shaft tilt"),
    _angle("coning", "Coning β0", "coning"),
    ShownQuantity(
        "CT/σ",
        "",
        "Solution.ct_over_sigma",
        lambda screen: screen.solution.ct_over_sigma,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", "CT/σ #")),
            Place("report", "explorer.export.tables.trim", _report(f"CT, CT/σ {NUMBER}, #")),
            Place("solve", _SOLVE, _solved("C_T/σ #")),
            Place("solve --json", _SOLUTION_RECORD, _record("ct_over_sigma")),
        ),
    ),
    ShownQuantity(
        "induced factor κ",
        "",
        "Solution.induced_power_factor",
        lambda screen: screen.solution.induced_power_factor,
        (
            Place("power and trim", _POWER_PANEL, _text("details.power", r"κ = Pi/\(CT·λ0\) #")),
            Place("report, table", _COMPARISON, _report("Induced factor κ #")),
            Place("report, trim", "explorer.export.tables.trim", _report(r"κ = Pi/\(CT·λ0\) #")),
            Place("solve", _SOLVE, _solved(r"κ = P_i/\(C_T λ0\) #")),
        ),
    ),
    ShownQuantity(
        "figure of merit",
        "",
        "Solution.figure_of_merit",
        lambda screen: screen.solution.figure_of_merit,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", "Figure of merit #")),
            Place("report, table", _COMPARISON, _report("FM #")),
            Place("report, trim", "explorer.export.tables.trim", _report("Figure of merit #")),
            Place("solve", _SOLVE, _solved("figure of merit #")),
        ),
    ),
    ShownQuantity(
        "lift to drag",
        "",
        "Solution.lift_to_drag",
        lambda screen: screen.solution.lift_to_drag,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", "Rotor L/De #")),
            Place("report, table", _COMPARISON, _report("Efficiency L/De #")),
            Place("report, trim", "explorer.export.tables.trim", _report("Rotor L/De #")),
            Place("solve", _SOLVE, _solved("L/D_e #")),
        ),
    ),
    ShownQuantity(
        "least induced power",
        "kW",
        "ideal_factor of rotor.optimisation, by explorer.text.readout.ideal_induced",
        _least_induced,
        (
            Place("power card", "explorer.views.power.power_card", _frame(": # kW", "power", "ideal_title")),
            Place("power and trim", "explorer.text.readout.ideal_line", _text("details.power", "ideal # kW")),
            Place("report", _COMPARISON, _report("Least induced, any circulation # kW")),
        ),
    ),
    ShownQuantity(
        "elastic twist of the tip",
        "°",
        "ElasticTwist.tip",
        _elastic_tip,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", "Elastic tip #°")),
            Place("solve --json", _SOLUTION_RECORD, _record("elastic_twist_deg", "mean_tip")),
        ),
    ),
    ShownQuantity(
        "load of the pitch link",
        "kN",
        "ElasticTwist.pitch_link_load",
        _pitch_link,
        (
            Place("power and trim", _TRIM_PANEL, _text("details.trim", "Pitch link # kN")),
            Place("solve --json", _SOLUTION_RECORD, _record("pitch_link_load_n", "mean", size=_KILO)),
        ),
    ),
    ShownQuantity(
        "vibration index",
        "%",
        "hub_loads(solution).index",
        _index,
        (
            Place("power card", "explorer.views.vibration.vibration", _frame("#", "vibration", "index")),
            Place("report", "explorer.export.tables.vibration", _report("Vibration index # %")),
            Place("solve", _SOLVE, _solved("index # % of the weight")),
        ),
    ),
    ShownQuantity(
        "angle of attack of a section",
        "°",
        "Solution.disk.alpha",
        lambda screen: math.degrees(
            float(screen.solution.disk.alpha[STATION, _column(screen)])
        ),
        (
            Place("section", _PROBE_PANEL, _document("section", " α #°")),
            Place("chart along the blade", "explorer.charts.strip.alpha_chart", _alpha_along),
            Place("ride", "explorer.picture.ride.turn_of", _ride("alpha")),
        ),
    ),
    ShownQuantity(
        "margin of a section",
        "°",
        "Solution.disk.stall_margin",
        lambda screen: math.degrees(
            float(screen.solution.disk.stall_margin[STATION, _column(screen)])
        ),
        (
            Place("section", _PROBE_PANEL, _document("section", "Stall margin #°")),
            Place("ride", "explorer.picture.ride.turn_of", _ride("margin")),
        ),
    ),
    ShownQuantity(
        "net saving over the mission",
        "kW",
        "Verdict.net_saving",
        _of_verdict(lambda verdict: abs(verdict.net_saving) / _KILO),
        (
            Place("card", _CARD, _frame("# ±", "assessed", "earns")),
            Place("balance", "explorer.text.readout.balance", _balance_total),
            Place("report", _SECTION, _section(" it (?:saves|needs) #")),
            Place("actuator --json", _VERDICT_RECORD, _unsigned(_verdict_record("net_saving_w", size=_KILO))),
            Place("actuator", _ACTUATOR, _judged(r"(?m)^  net +(?:saves|costs) #")),
        ),
        _of_verdict(lambda verdict: _net_pair(verdict)[0]),
    ),
    ShownQuantity(
        "band of the net saving",
        "kW",
        "Verdict.net_band",
        _of_verdict(lambda verdict: (verdict.net_band or 0.0) / _KILO),
        (
            Place("card", _CARD, _frame(f"{NUMBER} ± #", "assessed", "earns")),
            Place("report", _SECTION, _section(f" it (?:saves|needs) {NUMBER} ± #")),
            Place("actuator --json", _VERDICT_RECORD, _verdict_record("net_saving_band_w", size=_KILO)),
            Place("actuator", _ACTUATOR, _judged(rf"(?m)^  net +(?:saves|costs) {NUMBER} ± #")),
        ),
        _of_verdict(lambda verdict: _net_pair(verdict)[1]),
    ),
    ShownQuantity(
        "mass of the actuator",
        "kg",
        "InstalledActuator.masses.aircraft",
        _of_verdict(lambda verdict: verdict.installed.masses.aircraft),
        (
            Place("card", _CARD, _frame("# kg", "assessed", "mass")),
            Place("report", _SECTION, _section("; # kg")),
            Place("actuator --json", _VERDICT_RECORD, _verdict_record("added_mass_kg")),
            Place("actuator", _ACTUATOR, _judged("added mass +# kg")),
        ),
    ),
    ShownQuantity(
        "range of tip twist",
        "°",
        "Verdict.attainable",
        _of_verdict(lambda verdict: math.degrees(verdict.attainable)),
        (
            Place("rail", _RAIL, _text("actuator.numbers", "range of tip twist #°")),
            Place("actuator --json", _VERDICT_RECORD, _verdict_record("attainable_twist_deg")),
            Place("actuator", _ACTUATOR, _judged("twist attainable +# °")),
        ),
    ),
    ShownQuantity(
        "mass that pays",
        "kg",
        "Verdict.mass_allowed",
        _of_verdict(lambda verdict: verdict.mass_allowed),
        (
            Place("card", _CARD, _pays),
            Place("stage", "explorer.views.pay.view", _frame("pays below #", "suppose", "note")),
        ),
    ),
)  # fmt: skip
"""All quantities that have more than one place."""


def shown(screen: Screen) -> Iterator[tuple[ShownQuantity, Place, str]]:
    """Every place of a screen that shows a number, with that number as it is printed."""
    for quantity in QUANTITIES:
        for place in quantity.places:
            text = place.read(screen)
            if text:
                yield quantity, place, text


def value_of(text: str) -> float:
    """The value of a printed number."""
    return float(re.sub("[\u2009,]", "", text).replace("−", "-"))


def agrees(quantity: ShownQuantity, text: str, screen: Screen) -> bool:
    """Whether a printed number is the quantity's value to the digits shown."""
    known = quantity.value(screen)
    if known is None:
        return False
    printed = value_of(text)
    digits = len(text.partition(".")[2])
    within = 0.5 * 10.0**-digits + _SAME * abs(known)
    if abs(printed - known) <= within:
        return True
    # A pair of a change and its band is rounded together: one of them may be rounded the other way.
    pair = quantity.printed(screen)
    return pair is not None and abs(printed - pair) <= 1e-9


def disagreeing(screen: Screen) -> list[str]:
    """The places that show another number than the function of `rotor` gives."""
    return [
        f"{quantity.name}, {place.name}: {text} {quantity.unit}, not {quantity.value(screen)}"
        for quantity, place, text in shown(screen)
        if not agrees(quantity, text, screen)
    ]


ROTORS = (
    Inputs(law="builtin", built_outer=-2.5, advance_ratio=0.3),
    Inputs(rotor="bo105", law="linear", linear=-10.0, mass_t=2.2, advance_ratio=0.2),
    Inputs(rotor="s61", law="linear", linear=-6.0, mass_t=8.0, advance_ratio=0.0),
)
"""Three designs: UH-60A, MBB Bo 105, and Sikorsky S-61 in hover."""
ACTUATORS = "MFC_P1", "AFC", "SMA_tube"
_COLUMNS = "design", "quantity", "place", "shown", "unit", "value", "function", "read by"


def rows(name: str, screen: Screen) -> list[tuple[str, ...]]:
    """What a screen shows, one row a place."""
    return [
        (
            name,
            quantity.name,
            place.name,
            text,
            quantity.unit,
            repr(quantity.value(screen)),
            quantity.function,
            place.function,
        )
        for quantity, place, text in shown(screen)
    ]


def main(path: str) -> None:
    """Write the table of three rotors and three actuators."""
    screens = [(inputs.aircraft.name, explored(inputs)) for inputs in ROTORS]
    screens += [(f"UH-60A with {id}", actuated(id, INPUTS)) for id in ACTUATORS]
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(_COLUMNS)
        for name, screen in screens:
            writer.writerows(rows(name, screen))


if __name__ == "__main__":
    main(sys.argv[1])

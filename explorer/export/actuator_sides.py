"""A report on one actuator as two printed sides (A4): every row of numbers leads to its source and its test."""

import math
from collections.abc import Iterable, Sequence

from explorer import web
from explorer.export.contents import CRUISE, HARMONIC, ActuatorReport
from explorer.export.figures import balance_bars, legs_table, twist_over_flight
from explorer.export.provenance import PROGRAM, versions
from explorer.model.units import BLANK, SI, number
from explorer.text.design_words import flight_words, model_words, title_words
from explorer.text.readout import fuel_used, pair_words
from rotor.actuator import PiezoPly, Verdict, verdict_details, verdict_sentence
from rotor.actuator.verdict import count
from rotor.markup import Content, Markup, group, tag
from rotor.study.envelope import Reach
from rotor.trim.doubt import decimals, sureness
from rotor.units import KNOT

SOURCES = {
    "verdict": ("Need and savings", "docs/guide/actuator.md", "tests/rotor/actuator/test_actuator_verdict.py"),
    "doubt": ("Doubt", "docs/guide/doubt.md", "tests/rotor/trim/test_doubt.py"),
    "twist": ("Twist and drive of an actuator", "docs/theory.md#17-the-actuator",
              "tests/rotor/actuator/test_actuator_blade.py"),
    "data": ("Data of actuators with their grades", "assets/actuators.toml",
             "tests/rotor/actuator/test_actuator_catalogue.py"),
    "flight": ("Twist over a flight", "docs/guide/actuator.md", "tests/rotor/actuator/test_actuator_flight.py"),
    "limits": ("Limits", "docs/theory.md#17-the-actuator", "tests/rotor/actuator/test_actuator_blade.py"),
    "failure": ("An actuator that stops", "docs/guide/actuator.md", "tests/rotor/actuator/test_stopped.py"),
    "stability": ("Damping and margins", "docs/guide/stability.md", "tests/rotor/trim/test_stability.py"),
    "vibration": ("Loads on the hub", "docs/guide/vibration.md", "tests/rotor/trim/test_bending.py"),
    "per-rev": ("Twist at n/rev", "docs/theory.md#17-the-actuator", "tests/rotor/design/test_active_twist.py"),
    "envelope": ("Load factor and top speed", "docs/guide/envelope.md", "tests/rotor/study/test_envelope.py"),
}  # fmt: skip
"""Where numbers come from: what they are, a page with its heading or a data file, and the test."""
_HIGHEST = 6.0
"""Modes up to this frequency are listed [per rev]: those above are far from what flutters."""
_CASES = {"without": "as built", "with": "with it", "without nose weight": "with it, no nose weight"}
_FEW = 3
"""Inputs named as the largest part of the doubt."""


def actuator_html(report: ActuatorReport) -> str:
    """The file's text."""
    verdict = report.verdict
    name = f"{verdict.installed.actuator.name} on the {verdict.baseline.pair.design.aircraft.name}"
    low, high = verdict.installed.placement.span
    lead = f"{count(verdict)}, {verdict.installed.host.label}, {low:.2f} to {high:.2f} R"
    return web.fill(
        "sides.html",
        {
            "title": name,
            "program": PROGRAM,
            "policy": web.policy(),
            "styles": web.styles("report.css", "sides.css"),
            "lead": f"{lead} · {title_words(report.design)} · {flight_words(report.design)}",
            "models": model_words(report.design),
            "when": f"{report.when.day} {report.when:%B %Y}",
            "version": versions()[PROGRAM],
            "first": group(_answer(verdict), _moves(report), _saves(verdict), _limits(verdict)),
            "second": group(
                _carries(verdict),
                _fails(report),
                _stable(report),
                tag("div.pair", _vibrates(report), _flies(report)),
                _sources(),
            ),
        },
    )


def _answer(verdict: Verdict) -> Markup:
    return tag("p.answer", verdict_sentence(verdict), class_="less" if verdict.pays else "more", data_report="verdict")


def _moves(report: ActuatorReport) -> Markup:
    verdict, flight = report.verdict, report.judged.flight
    installed, actuator = verdict.installed, verdict.installed.actuator
    first, second = verdict.baseline.pair.advance_ratios
    rows: list[Markup | None] = []
    if isinstance(actuator, PiezoPly):
        volts = "{:g} to {:g} V".format(*actuator.voltage_range).replace("-", "−")
        rows.append(_row("voltage", "Voltage range", volts, "data"))
    tested = math.degrees(verdict.attainable_derated)
    rows += [
        _row("reach", "Twist of the tip over the whole range", _angle(verdict.attainable), "twist"),
        _row("derated", "the same, derated by test", f"{number(tested, 2)}°", "twist") if installed.derating < 1.0
        else None,
        _row("required", f"Twist needed from µ {first:g} to {second:g}", _angle(verdict.required), "verdict"),
        _row("attained", "Twist used", _angle(verdict.attained), "verdict"),
        _row("rate", "Twist per metre of the active section", f"{number(math.degrees(installed.twist_rate), 3)} °/m",
             "twist"),
        _row("stiffness", "Torsional stiffness GJ with it", f"{number(installed.section_stiffness / 1e3, 1)} kN·m²",
             "twist"),
    ]  # fmt: skip
    if (time := verdict.drive.slew_time) > 0.0:
        speed = math.degrees(verdict.attained) / time
        rows.append(_row("slew", f"Speed of the change, in {number(time)} s", f"{number(speed, 2)} °/s", "twist"))
    if installed.moment:
        rows.append(_row("moment", "Moment of the actuator", f"{number(installed.moment)} N·m", "twist"))
    table = _table(rows)
    if isinstance(flight, str):
        return tag("section", tag("h2", "What it moves"), table, tag("p.note", flight))
    return tag(
        "section",
        tag("h2", "What it moves"),
        tag("div.pair", table, twist_over_flight(flight)),
        tag("h3", "Over a flight"),
        legs_table(flight, verdict, SI, _link("flight")),
    )


def _saves(verdict: Verdict) -> Markup:
    band, doubt = verdict.net_band, verdict.doubt
    digits = 1 if band is None else max(1, decimals(band / 1e3))
    net = f"{_kw(verdict.net_saving, digits, sign=True)} kW"
    rows = [_row("net", "Net saving", net, "verdict")]
    if band is not None:
        said = f"± {_kw(band, digits)} kW: {sureness(verdict.net_saving, band)}"
        rows.append(_row("band", "Its doubt", said, "doubt"))
    share = f"{number(100.0 * verdict.net_saving / verdict.reference_power, 1, sign=True)} %"
    rows += [
        _row("share", f"of {_kw(verdict.reference_power, 0)} kW without it", share, "verdict"),
        _row("ideal", "Unlimited twist would save", f"{_kw(verdict.ideal_saving, 1)} kW", "verdict"),
        _row("fuel", "More fuel", f"{number(fuel_used(verdict), 1, sign=True)} kg/h", "verdict"),
    ]
    bars = tag(
        "figure.chart",
        tag("figcaption", tag("b", "Balance of power"), tag("span.dim", f"kW, {pair_words(verdict)} "),
            _link("verdict")),
        balance_bars(verdict, SI),
    )  # fmt: skip
    largest = None
    if doubt is not None and doubt.change_band:
        named = ", ".join(f"{row.words} {_kw(abs(row.change or 0.0), 1)}" for row in doubt.rows[:_FEW])
        largest = tag("p.note", f"Most of the doubt, in kW: {named} ", _link("doubt"), data_report="doubts")
    return tag(
        "section",
        tag("h2", "What it saves"),
        tag("div.pair", tag("div", _table(rows), largest), bars),
        tag("p.note", verdict_details(verdict), " ", _link("verdict")),
    )


def _carries(verdict: Verdict) -> Markup:
    masses, drive = verdict.installed.masses, verdict.drive
    kilograms = {"actuator": "Actuator, per blade", "wiring": "Leads, per blade", "balance": "Nose weight, per blade",
                 "electronics": "Electronics"}  # fmt: skip
    mass = [_row(key, words, f"{number(getattr(masses, key), 1)} kg", "twist") for key, words in kilograms.items()]
    mass.append(_row("mass", "On the aircraft", f"{number(masses.aircraft, 1)} kg", "twist", "total"))
    power = [
        _row("slew-power", "Mean power while the twist changes", f"{number(drive.slew_power)} W", "twist"),
        _row("hold-power", "Power to hold it", f"{number(drive.hold_power)} W", "twist"),
        _row("capacitance", "Capacitance of a blade's plies", f"{number(1e6 * drive.capacitance, 1)} µF", "twist")
        if drive.capacitance else None,
    ]  # fmt: skip
    return tag(
        "section.pair", tag("div", tag("h2", "Mass"), _table(mass)), tag("div", tag("h2", "Power"), _table(power))
    )


def _limits(verdict: Verdict) -> Markup:
    rows = [
        _cells((limit.sentence, "met" if limit.ok else "exceeded"), "limits", f"limit-{limit.name}",
               "" if limit.ok else "broken")
        for limit in verdict.limits
    ]  # fmt: skip
    caveats = [tag("li", caveat) for caveat in verdict.caveats]
    return tag(
        "section",
        tag("h2", "Limits of the blade"),
        _table(rows, kind="words"),
        tag("ul.caveats", caveats) if caveats else None,
    )


def _fails(report: ActuatorReport) -> Markup:
    title = tag("h2", "If it stops: its twist frozen, the flight goes on")
    if isinstance(report.failures, str):
        return tag("section", title, tag("p.note", report.failures))
    rows: list[Markup] = []
    for case in report.failures:
        for point in case.points:
            all_blades, single = point.stopped, point.one_blade
            cells = (
                _flight(case.stops_at),
                _flight(point.mu) + (f", {number(point.speed / KNOT)} kt" if point.speed else ""),
                number(math.degrees(all_blades.twist), 2),
                BLANK if all_blades.power is None else _kw(all_blades.power, 0),
                BLANK if point.cost is None else _kw(point.cost, 1, sign=True),
                BLANK if point.power_left is None else _kw(point.power_left, 0),
                number(100.0 * all_blades.stalled_area, 1),
                number(math.degrees(all_blades.collective), 1),
                number(math.degrees(all_blades.cyclic), 1),
                number(None if all_blades.controls_left is None else 100.0 * all_blades.controls_left),
                number(None if single is None else single.force_n),
                number(None if single is None else single.moment_nm),
                number(None if single is None else 1e3 * single.track_m),
            )
            rows.append(_cells(cells, "failure", f"failure-{case.stops_at:g}-{point.mu:g}"))
    heads = ("stops in", "flown in", "twist °", "power kW", "cost kW", "engines left kW", "stalled %", "collective °",
             "cyclic °", "controls left %", "1/rev N", "1/rev N·m", "track mm")  # fmt: skip
    note = (
        f"All blades stopped, cruise at µ {CRUISE:g}; the last three columns: stopped on one blade only, at once per "
        "revolution on the hub. Controls left: of a control's range to its nearer stop, 50 in the middle. Engines as "
        "at sea level, without losses. Left out there: a pilot who trims again, the "
        "wake of one different blade, its motion in lag and bending."
    )
    return tag("section", title, _table(rows, heads, "failures"), tag("p.note", note))


def _stable(report: ActuatorReport) -> Markup:
    title = tag("h2", f"Stability at µ {report.speed:g}")
    if isinstance(report.stability, str):
        return tag("section", title, tag("p.note", report.stability))
    cases = report.stability.cases
    rows: list[Markup] = []
    for mode in report.stability.without.modes:
        if mode.frequency <= _HIGHEST:
            beside = [case.mode(mode.name) for case in cases.values()]
            words = [f"{number(b.frequency, 2)}/rev, {number(100.0 * b.damping_ratio, 1)} %" for b in beside]
            rows.append(_cells((mode.name, *words), "stability", f"mode-{mode.name}"))
    margins = [case.margins for case in cases.values()]
    if all(margin is not None for margin in margins):
        known = [margin for margin in margins if margin is not None]
        stated = {
            "Flutter or divergence below, % of torsional stiffness": [
                number(100.0 * margin.instability_stiffness) for margin in known
            ],
            "Divergence below, % of torsional stiffness": [
                number(100.0 * margin.divergence_stiffness) if margin.divergence_stiffness else "never"
                for margin in known
            ],
            "Centre of gravity may move aft by, % of the chord": [
                "> 25" if margin.offset is None else number(100.0 * margin.offset, 1) for margin in known
            ],
        }
        for key, (words, values) in zip(("flutter", "divergence", "offset"), stated.items(), strict=True):
            rows.append(_cells((words, *values), "stability", f"margin-{key}"))
    heads = ("mode: frequency, damping over critical", *(_CASES[name] for name in cases))
    bound = next((limit.bound for limit in report.verdict.limits if limit.name == "flutter"), None)
    said = "" if bound is None else f"At most {number(bound, 1)} % of the stiffness may be needed (MIL-A-8870). "
    note = f"{said}Quasi-steady air, linear; no measured flutter of a full-scale rotor stands behind it."
    return tag("section", title, _table(rows, heads), tag("p.note", note))


def _vibrates(report: ActuatorReport) -> Markup:
    rows: list[Markup] = []
    notes: list[str] = []
    if isinstance(report.hub_loads, str):
        notes.append(report.hub_loads)
    else:
        for key, words, loads in zip(("built", "fitted"), ("As built", "With it, steady"), report.hub_loads,
                                     strict=True):  # fmt: skip
            low, high = loads.band or (loads.index, loads.index)
            value = f"{number(loads.index, 2)} % ({number(low, 2)} to {number(high, 2)})"
            rows.append(_row(f"index-{key}", f"{words}: index of {loads.per_rev}/rev", value, "vibration"))
        notes.append(
            "Index of hub loads in per cent of the weight, with blades that bend; in brackets over inflow models."
        )
    if isinstance(report.sweep, str):
        notes.append(report.sweep)
    elif not report.sweep.dynamic.amplitude:
        notes.append("Too slow to follow the azimuth.")
    else:
        sweep = report.sweep
        net = BLANK if sweep.net_saving is None else f"{_kw(sweep.net_saving, 1, sign=True)} kW"
        tip = f"± {_angle(sweep.response[0])}"
        rows += [
            _row("wave", f"Tip twist at {HARMONIC}/rev in flight", tip, "per-rev"),
            _row("wave-saving", "saves, against not driven", f"{_kw(sweep.wave_saving, 1, sign=True)} kW",
                 "per-rev"),
            _row("wave-net", "saves, all counted", net, "per-rev"),
        ]  # fmt: skip
        notes.append("No measured power benefit of active twist was found.")
    title = tag("h2", "Vibration and twist at n/rev")
    return tag("section", title, _table(rows) if rows else None, tag("p.note", " ".join(notes)))


def _flies(report: ActuatorReport) -> Markup:
    title = tag("h2", "Envelope")
    if isinstance(report.limits, str):
        return tag("section", title, tag("p.note", report.limits))
    tip_speed = report.design.rotor.tip_speed

    def knots(limit: Reach) -> str:
        value = limit.value
        return BLANK if value is None else f"{number(value * tip_speed / KNOT)} kt, {limit.limit}"

    n = report.limits.load_factors
    rows = [
        _cells((f"n at µ {report.speed:g} by stall", *(number(each.stall, 2) for each in n)), "envelope",
               "n-stall"),
        _cells(("the same, by engines", *(number(each.engines, 2) for each in n)), "envelope", "n-engines"),
        _cells(("Top speed", *map(knots, report.limits.top_speeds)), "envelope", "top-speed"),
    ]  # fmt: skip
    note = (
        "Load factor n of a steady turn at the propulsive force of straight flight; its twist of this speed "
        "held. Over speed, with ceiling and with the best moving twist: rotor envelope --moving."
    )
    return tag("section", title, _table(rows, ("", "as built", "with it")), tag("p.note", note))


def _sources() -> Markup:
    items: list[Markup] = []
    for name, (words, page, test) in SOURCES.items():
        items.append(tag("li", f"{words}: ", tag("code", page), ", ", tag("code", test), id=f"source-{name}"))
    return tag("section.sources", tag("h2", "Sources and tests"), tag("ol", items))


def _link(source: str) -> Markup:
    place = list(SOURCES).index(source) + 1
    return tag("a.source", f"[{place}]", href=f"#source-{source}", title=SOURCES[source][0])


def _row(key: str, words: str, value: str, source: str, kind: str = "") -> Markup:
    return _cells((words, value), source, key, kind)


def _cells(cells: Sequence[str], source: str, key: str, kind: str = "") -> Markup:
    """A row of numbers with the link to their source."""
    first, *others = cells
    shown = [tag("td", first), *(tag("td", cell) for cell in others), tag("td.link", _link(source))]
    return tag("tr", shown, data_report=key, class_=kind)


def _table(rows: Iterable[Content], heads: Sequence[str] = (), kind: str = "") -> Markup:
    head = tag("thead", tag("tr", [tag("th", name) for name in (*heads, "")])) if heads else None
    return tag("table", head, tag("tbody", rows), class_=kind)


def _angle(angle: float) -> str:
    return f"{number(math.degrees(angle), 2)}°"


def _kw(power: float, digits: int, *, sign: bool = False) -> str:
    return number(power / 1e3, digits, sign=sign)


def _flight(mu: float) -> str:
    return "hover" if mu == 0.0 else f"µ {mu:g}"

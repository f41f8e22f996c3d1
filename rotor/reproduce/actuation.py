"""Chapter 5: free strain of piezoelectric sheets, how far plies twist the blade, and whether it pays.

Only the captions of the thesis are known; what is here is ours.
"""

import math

import numpy as np

from rotor.actuator import tables as actuator_tables
from rotor.actuator.catalogue import PiezoPly, actuators, derating, find_actuator
from rotor.actuator.electrical import electric_field, free_strain
from rotor.actuator.installation import InstalledActuator, install
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pictures import twist_under_voltage
from rotor.actuator.section import Host, default_placement
from rotor.chart import Axis, Chart, Series
from rotor.files.make_design import uh60a_rotor
from rotor.reproduce.report import Report, card, curve, table
from rotor.reproduce.runs import CachedFunction, Call, variant

SPEEDS = (0.0, 0.3)
"""The two flight conditions of Table 5.2."""
BLADES: dict[str, tuple[int, Host]] = {
    "flown blade, 1 ply": (1, Host()),
    "flown blade, 2 plies": (2, Host()),
    "flown blade, 4 plies": (4, Host()),
    "new blade, GJ/2, 2 plies": (2, Host("new", 0.5)),
}
SOURCE = "Properties and sources: assets/actuators.toml; recalled or assumed values are marked in Table 5.1."
PPM, KV_MM = 1e6, 1e-6
"""From strains and volts per metre."""


def sheet(id: str) -> PiezoPly:
    """A ply of the catalogue."""
    actuator = find_actuator(id)
    assert isinstance(actuator, PiezoPly)
    return actuator


def fitted_blade(plies: int, host: Host) -> InstalledActuator:
    """MFC P1 as the worked example places it."""
    return install(sheet("MFC_P1"), default_placement(plies), host, uh60a_rotor("flight"))


def figure_5_5() -> Report:
    """Free strain."""
    curves: list[Series] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    known = [actuator for actuator in actuators().values() if isinstance(actuator, PiezoPly)]
    # Variants for heat or cut into strips strain as their own kind does.
    for shown in (shown for shown in known if shown.id not in ("MFC_P1_HT", "PZT5H_strips")):
        field, (along, across) = electric_field(shown, shown.voltage_range), free_strain(shown, shown.voltage_range)
        label = f"{shown.name} ({'d33' if shown.electrodes == 'interdigitated' else 'd31'})"
        curves.append(curve(label, KV_MM * field, PPM * along))
        rows.append((shown.id, *shown.voltage_range, *PPM * along, *PPM * across))
        numbers[shown.id] = float(np.ptp(along))
    return card(
        "5.5",
        "Free strain along the fibres over the whole voltage range, against the field: interdigitated (d33) and "
        "continuous electrodes (d31).",
        "Peak to peak: "
        + ", ".join(f"{id.replace('_', ' ')} {PPM * value:.0f} µε" for id, value in numbers.items())
        + f". The same fibres strain {numbers['MFC_P1'] / numbers['MFC_P2']:.1f} times as much with interdigitated "
        "electrodes.",
        f"d33 is about twice d31, and the range of field is wider. {SOURCE}",
        table(
            "strain",
            ("actuator", "lowest_v", "highest_v", "along_low_ppm", "along_high_ppm", "across_low_ppm",
             "across_high_ppm"),
            rows,
        ),
        (Chart("", Axis("field [kV/mm]"), Axis("free strain along [µε]"), tuple(curves)),),
        numbers,
    )  # fmt: skip


def figure_5_7() -> Report:
    """Field over voltage: a line each, whose slope is 1 over the gap between electrodes."""
    known = [sheet_data for sheet_data in map(sheet, ("MFC_P1", "MFC_P2")) if sheet_data]
    ends = [(actuator, np.array(actuator.voltage_range)) for actuator in known]
    fields = {actuator.id: KV_MM * electric_field(actuator, volts) for actuator, volts in ends}
    return card(
        "5.7",
        "Electric field over the whole voltage range: interdigitated electrodes (P1) and continuous ones (P2).",
        "; ".join(
            f"{id.replace('_', ' ')}: {row[0]:.2f} to {row[1]:.2f} kV/mm for {volts[0]:.0f} to {volts[1]:.0f} V"
            for (_, volts), (id, row) in zip(ends, fields.items(), strict=True)
        ) + ".",
        f"Voltage over gap; between interdigitated electrodes that is the mean, and the field is not even. {SOURCE}",
        table("field", ("actuator", "lowest_v", "highest_v", "low_kv_mm", "high_kv_mm"),
              [(actuator.id, *volts, *fields[actuator.id]) for actuator, volts in ends]),
        (Chart("", Axis("voltage [V]"), Axis("field [kV/mm]"),
               tuple(curve(actuator.name, volts, fields[actuator.id], "both") for actuator, volts in ends)),),
        {id: float(np.ptp(row)) for id, row in fields.items()},
    )  # fmt: skip


def figure_5_10() -> Report:
    """Torsion angle along the blade."""
    curves: list[Series] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    low, high = sheet("MFC_P1").voltage_range
    for k, (name, (plies, host)) in enumerate(BLADES.items()):
        installed = fitted_blade(plies, host)
        up, down = (twist_under_voltage(installed, [volts]) for volts in (high, low))
        curves.append(curve(name, up.r, np.degrees(up.twist), colour=k))
        curves.append(curve("", down.r, np.degrees(down.twist), "dashed", colour=k))
        rows.append((name, math.degrees(up.twist[-1]), math.degrees(down.twist[-1])))
        numbers[name] = math.degrees(installed.attainable)
    return card(
        "5.10",
        f"Twist of the rotating blade with every ply at {high:.0f} V (full) and at {low:.0f} V (dashed), zero at 0 V: "
        "a volt acts on the plies like a kelvin of the thermal analogy.",
        "Root to tip over the whole range: "
        + "; ".join(f"{name}: {value:.2f}°" for name, value in numbers.items())
        + ".",
        "Thin-walled laminate section (Bredt–Batho) on a rotating beam in torsion; finite elements of the section "
        "agree within 2 % (tests/rotor/actuator/test_actuator_fem.py). With the low end of the maker's strain and what "
        f"one tested blade relative to its model, use {100 * derating(sheet('MFC_P1')):.0f} %.",
        table("tip_twist", ("blade", f"at_{high:.0f}_v_deg", f"at_{low:.0f}_v_deg"), rows),
        (Chart("", Axis("r/R"), Axis("twist [°]"), tuple(curves)),),
        numbers,
    )


def table_5_1() -> Report:
    """Properties of actuators."""
    rows = actuator_tables.table_5_1()
    return card(
        "5.1",
        "Properties of the actuators in this package; columns and choice are ours.",
        f"{len(rows.rows)} actuators. " + " ".join(rows.notes),
        "Each number carries its source and grade in assets/actuators.toml.",
        table("properties", rows.columns, rows.rows),
    )


@CachedFunction
def compared(preset: str) -> actuator_tables.ActuatorTable:
    """Table 5.2 of one preset: four optima a concept, and the reach of six actuators."""
    return actuator_tables.table_5_2(ConditionPair(variant(preset, mu=SPEEDS[0]), SPEEDS))


COMPARED: Call = (compared, ("flight",))


def table_5_2() -> Report:
    """Actuators and concepts compared."""
    rows = compared("flight")
    net = rows.columns.index("net kW")
    best = rows.rows[0]
    gains = [float(row[net]) for row in rows.rows]
    fitted = next(row for row in rows.rows if row[0].startswith("MFC_P1,") and row[1] == "linear")
    return card(
        "5.2",
        f"Actuators and twist concepts compared between hover and µ {SPEEDS[1]:g}, half the time each, on the flown "
        "blade (flight preset); best net saving first.",
        f"{sum(gain > 0.0 for gain in gains)} of {len(gains)} have a net benefit. The best is {best[0]} with the "
        f"{best[1]} concept: {best[net]} kW net. {rows.notes[1]}",
        rows.notes[0],
        table("verdicts", rows.columns, rows.rows),
        numbers={
            "rows": float(len(gains)),
            "best_kw": gains[0],
            "actuators": float(len({row[0].partition(",")[0] for row in rows.rows})),
            **{
                key: float(fitted[rows.columns.index(column)])
                for key, column in (
                    ("needed", "needed °"),
                    ("reach", "nominal °"),
                    ("net_kw", "net kW"),
                    ("ideal_kw", "ideal kW"),
                )
            },
        },
    )

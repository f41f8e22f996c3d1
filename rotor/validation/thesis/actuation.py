"""Chapter 5: free strain of piezoelectric sheets, how far plies twist the blade, and whether it pays.

Only the captions of the thesis are known; the rest is this project's.
"""

import math

import numpy as np

from rotor.actuator import tables as actuator_tables
from rotor.actuator.catalogue import PiezoPly, actuators_of_kind
from rotor.actuator.installation import install
from rotor.actuator.section import HostBlade, default_placement
from rotor.files.make_design import uh60a_rotor
from rotor.optimisation.mission import mission_at
from rotor.support.chart import Series
from rotor.validation.thesis.report import Report, curve, panel, report, table
from rotor.validation.thesis.runs import CachedFunction, Call, variant

SPEEDS = (0.0, 0.3)
"""The two flight conditions of Table 5.2."""
BLADES: dict[str, tuple[int, HostBlade]] = {
    "flown blade, 1 ply": (1, HostBlade()),
    "flown blade, 2 plies": (2, HostBlade()),
    "flown blade, 4 plies": (4, HostBlade()),
    "new blade, GJ/2, 2 plies": (2, HostBlade("new", 0.5)),
}
PPM, KV_MM = 1e6, 1e-6
"""From strains and volts per metre."""


PLIES = actuators_of_kind(PiezoPly)


def figure_5_5() -> Report:
    """Free strain."""
    curves: list[Series] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    # Variants for heat or cut into strips strain as their own kind does.
    for shown in (
        shown for shown in PLIES.values() if shown.id not in ("MFC_P1_HT", "PZT5H_strips")
    ):
        field, (along, across) = (
            shown.field(shown.voltage_range),
            shown.free_strain(shown.voltage_range),
        )
        label = f"{shown.name} ({'d33' if shown.electrodes == 'interdigitated' else 'd31'})"
        curves.append(curve(label, KV_MM * field, PPM * along))
        rows.append((shown.id, *shown.voltage_range, *PPM * along, *PPM * across))
        numbers[shown.id] = float(np.ptp(along))
    ends = (f"{way}_{end}_ppm" for way in ("along", "across") for end in ("low", "high"))
    return report(
        "5.5",
        tables=[table("strain", ("actuator", "lowest_v", "highest_v", *ends), rows)],
        panels=[panel("", "field [kV/mm]", "free strain along [µε]", tuple(curves))],
        numbers=numbers,
        each=", ".join(
            f"{id.replace('_', ' ')} {PPM * value:.0f} µε" for id, value in numbers.items()
        ),
        ratio=numbers["MFC_P1"] / numbers["MFC_P2"],
    )


def figure_5_7() -> Report:
    """Field over voltage: a line each, whose slope is 1 over the gap between electrodes."""
    known = [PLIES["MFC_P1"], PLIES["MFC_P2"]]
    ends = {ply.id: np.array(ply.voltage_range) for ply in known}
    fields = {ply.id: KV_MM * ply.field(ends[ply.id]) for ply in known}
    lines = tuple(curve(ply.name, ends[ply.id], fields[ply.id], "both") for ply in known)
    return report(
        "5.7",
        tables=[
            table(
                "field",
                ("actuator", "lowest_v", "highest_v", "low_kv_mm", "high_kv_mm"),
                [(id, *ends[id], *fields[id]) for id in ends],
            )
        ],
        panels=[panel("", "voltage [V]", "field [kV/mm]", lines)],
        numbers={id: float(np.ptp(row)) for id, row in fields.items()},
        each="; ".join(
            f"{id.replace('_', ' ')}: {row[0]:.2f} to {row[1]:.2f} kV/mm for {ends[id][0]:.0f} to {ends[id][1]:.0f} V"
            for id, row in fields.items()
        ),
    )


def figure_5_10() -> Report:
    """Torsion angle along the blade."""
    curves: list[Series] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    ply = PLIES["MFC_P1"]
    low, high = ply.voltage_range
    for k, (name, (plies, host)) in enumerate(BLADES.items()):
        installed = install(ply, default_placement(plies), host, uh60a_rotor("flight"))
        r = np.linspace(float(installed.r[0]), 1.0, 61)
        up, down = (
            np.degrees(installed.change([volts / ply.voltage_swing], r)) for volts in (high, low)
        )
        curves += curve(name, r, up, colour=k), curve("", r, down, "dashed", colour=k)
        rows.append((name, float(up[-1]), float(down[-1])))
        numbers[name] = math.degrees(installed.attainable)
    return report(
        "5.10",
        tables=[table("tip_twist", ("blade", f"at_{high:.0f}_v_deg", f"at_{low:.0f}_v_deg"), rows)],
        panels=[panel("", "r/R", "twist [°]", tuple(curves))],
        numbers=numbers,
        each="; ".join(f"{name}: {value:.2f}°" for name, value in numbers.items()),
    )


def table_5_1() -> Report:
    """Properties of actuators."""
    rows = actuator_tables.table_5_1()
    properties = table("properties", rows.columns, rows.rows)
    return report(
        "table 5.1", tables=[properties], count=len(rows.rows), notes=" ".join(rows.notes)
    )


@CachedFunction
def compared(preset: str) -> actuator_tables.ActuatorTable:
    """Table 5.2 of one preset: four optima a concept, and the reach of six actuators."""
    return actuator_tables.table_5_2(mission_at(variant(preset, mu=SPEEDS[0]), SPEEDS))


COMPARED: Call = (compared, ("flight",))


def _saving(cell: str) -> float:
    """A number, with its band or without."""
    return float(cell.partition(" ± ")[0])


def table_5_2() -> Report:
    """Actuators and concepts compared."""
    rows = compared("flight")
    place = {column: k for k, column in enumerate(rows.columns)}
    best, gains = rows.rows[0], [_saving(row[place["net kW"]]) for row in rows.rows]
    fitted = next(row for row in rows.rows if row[0].startswith("MFC_P1,") and row[1] == "linear")
    columns = {
        "needed": "needed °",
        "reach": "nominal °",
        "net_kw": "net kW",
        "ideal_kw": "ideal kW",
    }
    return report(
        "table 5.2",
        tables=[table("verdicts", rows.columns, rows.rows)],
        numbers={
            "rows": float(len(gains)),
            "best_kw": gains[0],
            "best_band_kw": float(best[place["net kW"]].partition(" ± ")[2]),
            "actuators": float(len({row[0].partition(",")[0] for row in rows.rows})),
            **{key: _saving(fitted[place[column]]) for key, column in columns.items()},
        },
        positive=sum(gain > 0.0 for gain in gains),
        actuator=best[0],
        concept=best[1],
        net=best[place["net kW"]],
        angles=rows.notes[0],
        savings=rows.notes[1],
    )

"""Where an exported file comes from, and solutions as CSV tables with units."""

import io
import math
import platform
import re
import zipfile
from collections.abc import Sequence
from dataclasses import fields
from datetime import datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version

import numpy as np

from explorer import web
from explorer.charts import plots
from explorer.charts.plots import SWEEP, PowerCurve
from explorer.model.units import SI, Units
from explorer.picture.picture import flown_twist
from explorer.text.design_words import inflow_words, physics_words, title_words
from explorer.text.glossary import COLUMNS
from explorer.text.status import validated
from rotor import Design, Solution
from rotor.aero.problem import grid_of
from rotor.design.aircraft import in_words
from rotor.support.arrays import Array
from rotor.support.assets import commit
from rotor.support.markup import Markup, group, tag
from rotor.support.units import KNOT
from rotor.support.user_input import csv_text
from rotor.trim import DiskFields

PROGRAM = "rotor explorer"
LONGEST_NAME = 60
"""Characters of a file name."""
_SHOWN = {
    "rotor-explorer": PROGRAM,
    "viser": "viser",
    "numpy": "NumPy",
    "scipy": "SciPy",
    "numba": "Numba",
}


@cache
def versions() -> dict[str, str]:
    """Version of the program (with the commit, where it runs from a checkout) and of what it computes with."""
    numbers: dict[str, str] = {}
    for package, shown in _SHOWN.items():
        try:
            numbers[shown] = version(package)
        except PackageNotFoundError:
            numbers[shown] = "unknown"
    at = commit()
    if at:
        numbers[PROGRAM] += (
            f" (commit {at.removesuffix('+')}{', changed' if at.endswith('+') else ''})"
        )
    numbers["Python"] = platform.python_version()
    return numbers


def document_html(
    title: str,
    solution: Solution,
    line: str,
    content: Markup,
    validity: str,
    when: datetime,
    styles: Sequence[str] = ("report.css",),
    scripts: Sequence[str] = ("report.js",),
    units: Units = SI,
) -> str:
    """A file that opens without a server, with what its numbers are worth and what was measured of `solution`. Of
    scripts other than the report's no further one may run in it."""
    return web.fill(
        "report.html",
        {
            "title": title,
            "line": line.replace(" ± ", "\u00a0±\u00a0"),
            "program": PROGRAM,
            "policy": web.policy(*(scripts if scripts != ("report.js",) else ())),
            "styles": web.styles(*styles),
            "when": f"{when.day} {when:%B %Y, %H:%M}",
            "version": versions()[PROGRAM],
            "content": content,
            "validity": validity,
            "measured": units.in_power_unit(validated(solution).sentence),
            "versions": group(
                tag("tr", tag("td", name), tag("td", text)) for name, text in versions().items()
            ),
            "scripts": web.scripts(*scripts),
        },
    )


def condition_line(design: Design) -> str:
    condition = design.condition
    speed = "hover" if design.hovering else f"advance ratio {condition.advance_ratio:g}"
    load = f"{condition.mass:.0f} kg, {condition.altitude:.0f} m"
    if condition.stand is not None:
        load = f"{design.models.trim}: {condition.stand}"
    return ", ".join((speed, *in_words(design.unusual), load))


def provenance_lines(solution: Solution) -> list[str]:
    """What stands above a table of data: design, condition, models, how it converged, caveats, versions."""
    design = solution.design
    lines = [
        f"{title_words(design)}; twist {design.twist.spec()}",
        condition_line(design),
        f"preset {design.preset}; inflow {inflow_words(design)}; {physics_words(design)}; "
        f"{' x '.join(map(str, grid_of(design)))} elements and azimuths",
        f"{solution.status.value}: {solution.message} Residual {solution.residual:.1e} of weight.",
        f"total power {solution.power.total / 1e3:.6f} kW, main rotor {solution.power.main_rotor / 1e3:.6f} kW",
    ]
    for what, harmonics in (
        ("root pitch", design.pitch_per_rev),
        ("active twist", design.active_waves),
    ):
        if harmonics:
            waves = (
                f"{each.per_rev}/rev {each.amplitude:g} rad, phase {each.phase:g} rad"
                for each in harmonics
            )
            lines.insert(
                1,
                f"added {what}: {', '.join(waves)}"
                + (" (at rest in hover)" if design.hovering else ""),
            )
    lines += [f"caveat: {caveat.sentence}" for caveat in solution.caveats]
    lines.append(", ".join(f"{name} {number}" for name, number in versions().items()))
    lines.append("A model, not a measurement.")
    return lines


def file_name(design: Design, ending: str) -> str:
    """Rotor, twist, speed and an ending such as `-report.html`: at most 60 characters that every system takes."""
    speed = "hover" if design.hovering else f"mu{design.condition.advance_ratio:.3f}"
    tail = f"-{speed}{ending}"
    plain = title_words(design).lower().replace("−", "-").replace("\u2009", "")
    head = re.sub(r"[^a-z0-9.-]+", "_", plain)[: LONGEST_NAME - len(tail)]
    return head.strip("_.-") + tail


_ANGLES = {"theta", "alpha", "stall_margin", "elastic_twist"}
"""Fields in radians that are written in degrees."""


def tables_zip(
    solution: Solution, reference: Design, curve: PowerCurve, azimuth_deg: float
) -> bytes:
    """What `disk_csv`, `blade_csv` and `power_csv` give, as one archive."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("disk.csv", disk_csv(solution))
        archive.writestr("blade.csv", blade_csv(solution, reference, azimuth_deg))
        archive.writestr("power.csv", power_csv(solution, reference, curve))
    return out.getvalue()


def disk_csv(solution: Solution) -> bytes:
    """Every field over the disk, a row for each element and azimuth, and loads in SI beside the coefficients."""
    disk, design = solution.disk, solution.design
    r, psi = np.meshgrid(disk.r, np.degrees(disk.psi), indexing="ij")
    columns: list[tuple[str, Array]] = [("r/R [-]", r), ("psi [deg]", psi)]
    for name in _disk_fields(disk):
        values = getattr(disk, name)
        angle = name in _ANGLES
        columns.append(
            (f"{name} [{'deg' if angle else '-'}]", np.degrees(values) if angle else values)
        )
    columns.append(("thrust per blade [N/m]", disk.dct * design.thrust_per_metre))
    power = disk.r[:, None] * disk.dcq * design.thrust_per_metre * design.rotor.tip_speed
    columns.append(("power per blade [W/m]", power))
    notes = [
        f"{len(disk.r)} elements of {_widths(disk.dr)}; {len(disk.psi)} azimuths",
        "psi = 0 over the tail, 90 on the advancing side",
        *(f"{name}: {COLUMNS[name]}" for name in _disk_fields(disk) if name in COLUMNS),
    ]
    return _table(solution, notes, columns)


def _widths(dr: Array) -> str:
    """Widths of the elements over R in words: one where all are equally wide."""
    if np.ptp(dr) < 1e-12:
        return f"width dr/R = {dr[0]:.9g} about r"
    return f"widths dr/R = {' '.join(f'{width:.9g}' for width in dr)} from root to tip"


def blade_csv(solution: Solution, reference: Design, azimuth_deg: float) -> bytes:
    """The charts along the blade: built-in and flown twist, angle of attack with its stall angles, lift coefficient.

    `reference`: what the page compares with, A or the baseline.
    """
    disk, design = solution.disk, solution.design
    lower, upper, alpha = plots.angles_along(solution, azimuth_deg)
    columns = [
        ("r/R [-]", disk.r),
        ("chord [m]", design.rotor.blade.chord(disk.r)),
        ("built-in twist [deg]", np.degrees(design.twist(disk.r))),
        ("flown twist [deg]", np.degrees(flown_twist(solution, math.radians(azimuth_deg))(disk.r))),
        ("reference built-in twist [deg]", np.degrees(reference.twist(disk.r))),
        ("alpha [deg]", alpha),
        ("stall below [deg]", lower),
        ("stall above [deg]", upper),
        ("cl [-]", plots.lift_along(solution, azimuth_deg)),
    ]
    notes = [
        f"at azimuth {azimuth_deg:g} deg; angles are empty in reverse flow",
        f"reference: {reference.twist.spec()}, {condition_line(reference)}",
    ]
    return _table(solution, notes, columns)


def power_csv(solution: Solution, reference: Design, curve: PowerCurve) -> bytes:
    """Total power over advance ratio: this design, what the page compares it with, and the bound of an ideal lift."""
    mu = np.array(SWEEP)
    columns = [
        ("mu [-]", mu),
        ("speed [m/s]", mu * solution.design.rotor.tip_speed),
        ("speed [kt]", mu * solution.design.rotor.tip_speed / KNOT),
        ("total power [kW]", curve.design),
        ("reference power [kW]", curve.reference),
        ("power with ideal lift [kW]", curve.ideal),
    ]
    notes = [
        f"reference: {reference.twist.spec()}, {condition_line(reference)}",
        "mu = 0 is hover; empty where there is no trim or no valid inflow",
        "ideal lift: the least induced power of any circulation with this lift",
    ]
    return _table(solution, notes, columns)


def _disk_fields(disk: DiskFields) -> list[str]:
    """Names of the fields of shape (elements, azimuths)."""
    shape = (len(disk.r), len(disk.psi))
    return [entry.name for entry in fields(disk) if np.shape(getattr(disk, entry.name)) == shape]


def _table(solution: Solution, notes: Sequence[str], columns: Sequence[tuple[str, Array]]) -> bytes:
    heading = "".join(f"# {line}\n" for line in (*provenance_lines(solution), *notes))
    table = np.stack([np.asarray(values, dtype=float).ravel() for _, values in columns], axis=1)
    rows = (
        [f"{value + 0.0:.9g}" if math.isfinite(value) else "" for value in row]
        for row in table.tolist()
    )
    return csv_text([[name for name, _ in columns], *rows], heading).encode("utf-8")

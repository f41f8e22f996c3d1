"""The trust page as files: trust.csv, sensitivity.csv, and validation.md made from these two."""

import csv
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import astuple, fields, replace
from pathlib import Path
from typing import Any

from rotor.design.blade import with_airfoils
from rotor.design.design import Design
from rotor.design.structure import BladeStructure
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.reproduce.cross_codes import have
from rotor.reproduce.report import Report, typographic
from rotor.reproduce.trust import KINDS, SensitivityRow, TrustRow, trust_rows
from rotor.reproduce.trust_rows import (
    indicative,
    public_codes,
    statements,
    validation,
    verification,
)

SPEEDS = (0.0, 0.15, 0.30)
BASELINE = "linear:-16"

Change = Callable[[Design], Design]


def _airfoil(name: str) -> Change:
    return lambda design: replace(design, rotor=with_airfoils(design.rotor, (name,), ()))


def _models(**choices: Any) -> Change:
    return lambda design: replace(design, models=replace(design.models, **choices))


def _mass(factor: float) -> Change:
    return lambda design: replace(design, condition=replace(design.condition, mass=factor * design.condition.mass))


def _drag(factor: float) -> Change:
    return lambda design: replace(
        design, fuselage=replace(design.fuselage, drag_area=factor * design.fuselage.drag_area)
    )


def _blades(count: int) -> Change:
    """The same solidity on another number of blades; flap inertia and mass go with the chord."""

    def change(design: Design) -> Design:
        rotor, share = design.rotor, design.rotor.blades / count
        blade = replace(
            rotor.blade,
            chords=tuple(share * chord for chord in rotor.blade.chords),
            flap_inertia=share * rotor.blade.flap_inertia,
            flap_static_moment=share * rotor.blade.flap_static_moment,
            mass=share * rotor.blade.mass,
            structure=_scaled(rotor.blade.structure, stiffness=share**2, inertia=share**2, mass=share),
        )
        chord = share * rotor.reference_chord
        return replace(design, rotor=replace(rotor, blades=count, blade=blade, reference_chord=chord))

    return change


def _scaled(
    structure: BladeStructure | None,
    *,
    stiffness: float = 1.0,
    controls: float = 1.0,
    inertia: float = 1.0,
    mass: float = 1.0,
) -> BladeStructure | None:
    """A structure with other stiffness, of blade and controls, inertia and mass, as factors."""
    if structure is None:
        return None
    return replace(
        structure,
        torsional_stiffness=tuple(stiffness * value for value in structure.torsional_stiffness),
        control_stiffness=stiffness * controls * structure.control_stiffness,
        torsional_inertia=tuple(inertia * value for value in structure.torsional_inertia),
        mass_per_length=tuple(mass * value for value in structure.mass_per_length),
    )


def _structure(**factors: float) -> Change:
    def change(design: Design) -> Design:
        blade = replace(design.rotor.blade, structure=_scaled(design.rotor.blade.structure, **factors))
        return replace(design, rotor=replace(design.rotor, blade=blade))

    return change


def _slow_tip(design: Design) -> Design:
    """Half the tip speed and a quarter of the mass: every coefficient as before, tip Mach numbers halved."""
    blade = replace(design.rotor.blade, structure=_scaled(design.rotor.blade.structure, stiffness=0.25))
    rotor = replace(design.rotor, angular_speed=0.5 * design.rotor.angular_speed, blade=blade)
    return _mass(0.25)(replace(design, rotor=rotor))


CHANGES: tuple[tuple[str, Change], ...] = (
    ("none: flight preset", lambda design: design),
    ("section: SC1095 deck all along", _airfoil("sc1095")),
    ("section: SC1094 R8 deck all along", _airfoil("sc1094r8")),
    ("section: the thesis' polynomials (M 0.3, free transition)", _airfoil("sc1095-thesis")),
    ("Mach: half the tip speed, same coefficients", _slow_tip),
    ("inflow: Pitt–Peters, linear", _models(inflow="pitt-peters")),
    ("inflow: Drees, linear", _models(inflow="drees")),
    ("inflow: local momentum", _models(inflow="local-momentum")),
    ("trim: thrust only, flapping free, no cyclic", _models(trim="thrust")),
    ("U_P without µ sin α, as (3.6) prints", _models(disk_axial_flow=False)),
    ("both of these", _models(trim="thrust", disk_axial_flow=False)),
    ("blades: 3, same solidity", _blades(3)),
    ("blades: 5, same solidity", _blades(5)),
    ("blade rigid in torsion", _models(elastic_twist=False)),
    ("control stiffness, an assumption: half", _structure(controls=0.5)),
    ("control stiffness, an assumption: double", _structure(controls=2.0)),
    ("torsional inertia: −15 %", _structure(inertia=0.85)),
    ("weight: −20 %", _mass(0.8)),
    ("weight: +10 %", _mass(1.1)),
    ("drag area: −30 %", _drag(0.7)),
    ("drag area: +30 %", _drag(1.3)),
)
"""Name and change."""


def sensitivity() -> Iterator[SensitivityRow]:
    """All rows; about 70 searches."""
    concept = find_concept("linear")
    for name, change in CHANGES:
        for mu in SPEEDS:
            design = change(make_design(twist=BASELINE, mu=mu))
            found = run_search(Search(design, concept, starts=2))
            assert found.best is not None, f"{name}, µ {mu:g}: {found.message}"
            assert found.saving is not None, f"{name}, µ {mu:g}: the baseline does not trim"
            rate = found.best.parameters[0]
            band = found.band[0] if found.band else None
            yield SensitivityRow(
                change=name,
                mu=mu,
                optimum_deg=math.degrees(rate),
                low_deg=math.degrees(band.low if band else rate),
                high_deg=math.degrees(band.high if band else rate),
                total_kw=found.best.power / 1e3,
                saving_percent=100.0 * found.saving,
            )


CODES = {"dynbem": "dynbem", "wisdem": "CCBlade"}
"""Package of each public code, and how its rows name it."""
FAST: tuple[Callable[[], Iterator[TrustRow]], ...] = (verification, validation, indicative)
"""Makers that need a few seconds."""

_HEADING = (
    "# Made by: python -m rotor reproduce OUT --trust. Read by rotor/reproduce/trust.py; docs/validation.md shows it.\n"
)
_NOT_MODELLED = (
    "blade bending; torsion where the rotor file has no blade structure",
    "dynamic stall (steady sections)",
    "pressure drag and lift in yawed flow: radial flow acts through skin friction alone",
    "a change of lift slope by the swept tip",
    "the trailing-edge tab of the UH-60A between 0.73 and 0.86 R: 0.01 of C_m there would twist the tip by about 0.3°",
    "roll-up and contraction of the wake. Up to µ 0.15 they decide what twist is worth: from −8° to −16° it takes 1.6, "
    "2.3, 1.5 and 0.0 % off the UH-60A's power in hover and at µ 0.05, 0.1 and 0.15 here, 4 to 5 % with wakes that "
    "roll up. No measurement known to us decides; a free wake gives ±10 % by choices that no report fixes",
    "the airframe but for its drag and its download: no upwash, no lift, no interference with the tail",
    "tunnel data of the sections themselves: XFOIL with levels and shocks from public tunnel-derived data; see "
    "[assets/airfoils/CITATION.md](../assets/airfoils/CITATION.md)",
    "what a real surface adds to section drag, unless the rotor file states it (surface_drag)",
    "any inflow model below µ 0.05 (0.075 with linear inflow): wakes that respond to the load pass over to the hover "
    "model by interpolation",
    "climb and descent, which are verified against theory but compared with no measurement; the vortex ring state",
)


def all_rows(reports: Sequence[Report], tell: Callable[[str], None] = print) -> list[TrustRow]:
    """Every row, run anew; rows of a public code that is not installed are the shipped ones, named to `tell`."""
    rows = [*verification(), *public_codes()]
    for package, name in CODES.items():
        if not have(package):
            tell(f"{name} is not installed: its shipped rows are kept (pip install 'rotor-explorer[crosscheck]')")
            rows += [row for row in trust_rows() if row.kind == "public code" and row.against.startswith(name)]
    return [*rows, *validation(), *indicative(), *statements(reports)]


def write_trust(reports: Sequence[Report], folder: Path) -> Path:
    """Write all three files; the path of the page."""
    rows, changes = all_rows(reports), list(sensitivity())
    _write(folder / "trust.csv", [field.name for field in fields(TrustRow)], (_cells(row) for row in rows))
    columns = [field.name for field in fields(SensitivityRow)]
    _write(folder / "sensitivity.csv", columns, ([_short(cell) for cell in astuple(row)] for row in changes))
    path = folder / "validation.md"
    path.write_text(page(rows, changes), encoding="utf-8")
    return path


def page(rows: Iterable[TrustRow], changes: Iterable[SensitivityRow]) -> str:
    """docs/validation.md."""
    rows, changes = list(rows), list(changes)
    parts = [
        "# How far to trust the numbers",
        "Made by `python -m rotor reproduce OUT --trust` from actual runs; "
        "`tests/rotor/reproduce/test_trust.py` recomputes the "
        "rows and compares.",
        "Three kinds of comparison: **verification** (against theory, identities, other codes: are the "
        "equations solved correctly?), **validation** (against measurement: are they the right equations?), "
        "**indicative** "
        "(against another model, or data of unclear origin: no proof). `python -m rotor validate` prints every "
        "measured point beside ours; none was fitted to. No measured forward-flight power of the UH-60A could be "
        "reached, and no measured benefit of active twist: published figures of both are computed.",
    ]
    for kind, heading in KINDS.items():
        mine = [row for row in rows if row.kind == kind]
        if not mine:
            continue
        parts.append(f"## {heading}")
        first = ("Statement", "Verdict") if kind == "document" else ("Against", "Error")
        lines = [f"| What | {first[0]} | {first[1]} | Verified by | |", "| --- | --- | --- | --- | --- |"]
        cells = ((row.what, row.against, row.shown, f"`{row.test}`", _own(row)) for row in mine)
        lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in cells]
        parts.append("\n".join(lines))
        parts += dict.fromkeys(_shared(row) for row in mine if _shared(row))  # Once, under the table.
    parts += _sensitivity_part(changes)
    parts.append("## Not modelled")
    parts.append("\n".join(f"- {one}" for one in _NOT_MODELLED))
    return typographic("\n\n".join(parts)) + "\n"


def _sensitivity_part(changes: Sequence[SensitivityRow]) -> list[str]:
    speeds = sorted({row.mu for row in changes})
    heads = ["hover: best twist, saving" if mu == 0.0 else f"µ {mu:g}: best twist, saving" for mu in speeds]
    lines = [f"| Change | {' | '.join(heads)} |", "| --- |" + " --- |" * len(speeds)]
    for name in dict.fromkeys(row.change for row in changes):
        mine = {row.mu: row for row in changes if row.change == name}
        cells = [
            f"{mine[mu].optimum_deg:.1f}° ({mine[mu].low_deg:.1f}…{mine[mu].high_deg:.1f}), "
            f"{mine[mu].saving_percent:z.1f} %"
            for mu in speeds
        ]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return [
        "## Sensitivity of the best linear twist and its saving",
        "Flight preset with one choice changed; the best linear twist per radius with its band within 0.1 % of the "
        "least total power, and the saving of total power against a linear −16° under the same choice. The optimum "
        "changes by degrees, its saving by tenths of a per cent up to a few: compare powers, not angles alone.",
        "\n".join(lines),
    ]


def _own(row: TrustRow) -> str:
    """The part of a note that is the row's own."""
    return row.note.partition(" Same: ")[0]


def _shared(row: TrustRow) -> str:
    """The part that several rows share: the physics differences of a code."""
    head, mark, rest = row.note.partition(" Same: ")
    del head
    code = row.against.partition(",")[0]
    return f"{code}. Same: {rest}" if mark else ""


def _cells(row: TrustRow) -> list[str]:
    error = "" if row.error is None else f"{row.error:.6g}"
    return [row.kind, row.what, row.against, row.shown, error, f"{row.allowed:g}", row.test, row.note]


def _short(cell: str | float) -> str:
    return cell if isinstance(cell, str) else f"{cell:.6g}"


def _write(path: Path, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(_HEADING)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)

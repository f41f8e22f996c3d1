"""How the best linear twist and its saving move with section data, inflow, trim, blade and aircraft."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from rotor.chart import Axis, Chart, Points
from rotor.design.blade import BladeStructure, with_airfoils
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.validation.trust import SensitivityRow

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


def with_blades(count: int) -> Change:
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
    ("blades: 3, same solidity", with_blades(3)),
    ("blades: 5, same solidity", with_blades(5)),
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


def sensitivity_chart(rows: Sequence[SensitivityRow]) -> Chart:
    """The best twist of each change with its band, one colour a speed."""
    changes = tuple(dict.fromkeys(row.change for row in rows))
    series: list[Points] = []
    for k, mu in enumerate(dict.fromkeys(row.mu for row in rows)):
        mine = [row for row in rows if row.mu == mu]
        series.append(
            Points(
                "hover" if mu == 0.0 else f"µ {mu:g}",
                tuple(row.optimum_deg for row in mine),
                tuple(changes.index(row.change) + 0.25 * (k - 1) for row in mine),
                k + 1,
                scatter=tuple(0.5 * (row.high_deg - row.low_deg) for row in mine),
            )
        )
    title = "Best linear twist by choice of model, with its band"
    return Chart(title, Axis("best linear twist [° per radius]"), Axis(names=changes), tuple(series))

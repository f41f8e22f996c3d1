"""How the best linear twist and its worth move with polar, Mach number, inflow, blade number, weight and drag area."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from rotor.design.blade import with_airfoils
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.search import Search, run_search
from rotor.reproduce.trust import SensitivityRow

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
        )
        chord = share * rotor.reference_chord
        return replace(design, rotor=replace(rotor, blades=count, blade=blade, reference_chord=chord))

    return change


def _slow_tip(design: Design) -> Design:
    """Half the tip speed and a quarter of the mass: every coefficient as before, tip Mach numbers halved."""
    rotor = replace(design.rotor, angular_speed=0.5 * design.rotor.angular_speed)
    return _mass(0.25)(replace(design, rotor=rotor))


CHANGES: tuple[tuple[str, Change], ...] = (
    ("none: flight preset", lambda design: design),
    ("section: SC1095 deck all along", _airfoil("sc1095")),
    ("section: SC1094 R8 deck all along", _airfoil("sc1094r8")),
    ("section: the document's polynomials (M 0.3, free transition)", _airfoil("sc1095-thesis")),
    ("Mach: half the tip speed, same coefficients", _slow_tip),
    ("inflow: Pitt–Peters, linear", _models(inflow="pitt-peters")),
    ("inflow: Drees, linear", _models(inflow="drees")),
    ("inflow: local momentum", _models(inflow="local-momentum")),
    ("inflow: dynamic wake, infinite blades", _models(inflow="dynamic-wake-infinite-blades")),
    ("inflow: dynamic wake, few states", _models(inflow="dynamic-wake-quick")),
    ("losses off: hub, and tips as of infinitely many blades", _models(tip_loss=False, hub_loss=False)),
    ("trim: thrust only, flapping free, no cyclic", _models(trim="thrust")),
    ("U_P without µ sin α, as (3.6) prints", _models(disk_axial_flow=False)),
    ("both of these", _models(trim="thrust", disk_axial_flow=False)),
    ("blades: 3, same solidity", _blades(3)),
    ("blades: 5, same solidity", _blades(5)),
    ("weight: −20 %", _mass(0.8)),
    ("weight: +10 %", _mass(1.1)),
    ("drag area: −30 %", _drag(0.7)),
    ("drag area: +30 %", _drag(1.3)),
)
"""Name and change."""


def sensitivity() -> Iterator[SensitivityRow]:
    """All rows; about 50 searches."""
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

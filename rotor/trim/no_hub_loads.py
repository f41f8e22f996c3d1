"""Designs without vibratory loads on the hub, and why they have none."""

from rotor.aero.bending import can_bend
from rotor.columns.bending import has_hub_loads
from rotor.design.design import Design
from rotor.trim.solution import Caveat

SLOWEST = 0.2
"""Advance ratio below which the wake model decides the loads."""


def why_no_hub_loads(design: Design) -> Caveat | None:
    """Why a design has none, None where it has them."""
    structure, rotor = design.rotor.blade.structure, design.rotor
    if structure is not None and structure.bends and not can_bend(rotor):
        sentence = (
            "No hub loads: blades hinged at the shaft flap as rigid blades here; give flap_hinge_m."
        )
    elif structure is None or not structure.bends:
        sentence = (
            f"No hub loads: the stiffness of the {design.aircraft.name} blade in flap and lag is not known, so it "
            "flaps as a rigid blade."
        )
    elif not design.flaps:
        sentence = "No hub loads: the blades are rigid, or flapping is switched off."
    elif not has_hub_loads(rotor.blades):
        sentence = f"No hub loads: those of {rotor.blades} blades are at harmonics that are not solved for."
    elif design.hovering or design.condition.advance_ratio < SLOWEST:
        sentence = (
            f"Hub loads are not shown below µ {SLOWEST:g}, where they depend on the wake model."
        )
    else:
        return None
    return Caveat("no-hub-loads", sentence)

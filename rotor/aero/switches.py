"""The parts of the physics that can be switched off to see what they cost."""

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from rotor.aero.inflow import inflow_model
from rotor.design.design import Design, Models


@dataclass(frozen=True)
class Switch:
    """One part of the physics."""

    name: str
    """The field of `Models`."""
    title: str
    on: str
    """What is there when it is on, one sentence."""
    off: str
    """What is left out when it is off, one sentence."""

    @property
    def flag(self) -> str:
        """As on the command line."""
        return self.name.replace("_", "-")


_SWITCHES = (
    Switch(
        "flapping",
        "Flapping",
        "The blades flap about their hinges; cyclic trims the first harmonic of flapping.",
        "Rigid blades, β = 0, without cyclic: the hub carries the moment of the asymmetric lift.",
    ),
    Switch(
        "tip_loss",
        "Tip loss",
        "Lift falls to zero at the tip of each blade: Prandtl's factor, or the wake of each blade.",
        "F_tip = 1; the dynamic wake becomes that of infinitely many blades.",
    ),
    Switch(
        "hub_loss",
        "Hub loss",
        "Lift falls to zero at the root: Prandtl's factor, in hover and with inflow independent of the loading.",
        "F_hub = 1.",
    ),
    Switch(
        "reverse_flow",
        "Reverse flow",
        "On the retreating side, inside r < −µ sin ψ, the flow comes from the trailing edge and adds drag.",
        "No load inside the circle r < −µ sin ψ.",
    ),
    Switch(
        "compressibility",
        "Compressibility",
        "Section data depend on Mach number: steeper lift curve, earlier stall, wave drag on the advancing tip.",
        "Section data at Mach 0.3 everywhere.",
    ),
    Switch(
        "fuselage",
        "Fuselage drag",
        "The rotor overcomes the drag of the aircraft: parasite power, and a disk tilted forward.",
        "Drag area 0.",
    ),
)
SWITCHES: dict[str, Switch] = {switch.name: switch for switch in _SWITCHES}
"""By field name, in the order in which a waterfall puts them on: the blade's motion, its ends, its air, its task."""


def switched_off(models: Models) -> tuple[Switch, ...]:
    """What these models leave out."""
    return tuple(switch for switch in _SWITCHES if not getattr(models, switch.name))


def with_switches(design: Design, off: Collection[str]) -> Design:
    """The design with exactly these switches (field names) off and all others on."""
    return replace(design, models=replace(design.models, **{name: name not in off for name in SWITCHES}))


def parse_switches(text: str) -> tuple[str, ...]:
    """Field names from `tip-loss,reverse-flow`; ValueError names one that does not exist."""
    names = tuple(part.strip() for part in text.split(",") if part.strip())
    flags = {switch.flag: switch.name for switch in _SWITCHES}
    for name in names:
        if name.replace("_", "-") not in flags:
            raise ValueError(f"switch {name!r} is not known: use {', '.join(flags)}, separated by commas")
    return tuple(flags[name.replace("_", "-")] for name in names)


def no_effect(design: Design, name: str) -> str:
    """Why a switch cannot change the power of this design, as a clause; empty where it can."""
    hovering = design.hovering
    inflow = inflow_model(design.models.inflow)
    match name:
        case "flapping" | "fuselage" if hovering:
            return "hover is axisymmetric" if name == "flapping" else "no drag in hover"
        case "tip_loss" if not hovering and inflow.load_dependent and inflow.without_tip_loss() == inflow:
            return "this wake resolves the blade tips itself"
        case "hub_loss" if not hovering and inflow.load_dependent:
            return "this wake resolves the root itself"
        case "reverse_flow" if design.condition.advance_ratio <= design.rotor.blade.root_cutout:
            return "no blade element is in reverse flow at this speed"
        case "compressibility" if _one_mach(design):
            return "the section data hold for one Mach number"
        case _:
            return ""


def _one_mach(design: Design) -> bool:
    """Whether the data of every section of the blade hold for one Mach number only."""
    blade = design.rotor.blade
    names = {span.section for span in blade.spans}
    return not any(np.any(blade.installed(name).table.coefficients[..., 1:]) for name in names)

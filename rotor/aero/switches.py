"""The effects that can be switched off to see their cost in power. For teaching: every aircraft has all of them."""

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from rotor.aero.inflow import inflow_model
from rotor.design.design import BEYOND_DOCUMENT, Design, Models
from rotor.user_input import did_you_mean


@dataclass(frozen=True)
class Switch:
    """One effect that can be switched off."""

    name: str
    """The field of `Models`."""
    title: str
    on: str
    """The effect, one sentence."""
    off: str
    """The model without the effect, one sentence."""

    @property
    def flag(self) -> str:
        """As on the command line."""
        return self.name.replace("_", "-")


_SWITCHES = (
    Switch(
        "flapping",
        "Flapping",
        "The blades flap about their hinges, and cyclic removes the remaining first-harmonic flapping.",
        "Rigid blades, β = 0, and no cyclic: the hub carries the moment of the unequal lift.",
    ),
    Switch(
        "tip_loss",
        "Tip loss",
        "Lift falls off at the tips of a finite number of blades: Prandtl's factor, or the wake of each blade.",
        "F_tip = 1; a lifting line keeps the tips of its blades.",
    ),
    Switch(
        "hub_loss",
        "Hub loss",
        "Lift falls off at the root: Prandtl's factor, in hover and with inflow that does not depend on the load.",
        "F_hub = 1.",
    ),
    Switch(
        "reverse_flow",
        "Reverse flow",
        "On the retreating side, inside r < −µ sin ψ, air meets the blade from behind and adds drag.",
        "No load inside the circle r < −µ sin ψ.",
    ),
    Switch(
        "compressibility",
        "Compressibility",
        "Section data depend on the Mach number: steeper lift, earlier stall, wave drag on the advancing tip.",
        "Section data at Mach 0.3 everywhere.",
    ),
    Switch(
        "surface_drag",
        "Surface drag",
        "Drag is multiplied by the factor that the rotor file states for the surface of its blades.",
        "Drag is that of the section data.",
    ),
    Switch(
        "swept_tip",
        "Swept tip",
        "A swept tip sees the Mach number of the flow normal to its quarter chord.",
        "The tip sees Mach numbers as if it were straight.",
    ),
    Switch(
        "radial_friction",
        "Radial friction",
        "Skin friction follows the yawed velocity: air flows along the blade at the front and the rear of the disk.",
        "Friction of the flow across the blade only.",
    ),
    Switch(
        "elastic_twist",
        "Elastic twist",
        "The blade twists under its own loads: the air meets the flown twist, not the jig twist that is built.",
        "The blade is rigid in torsion: flown and jig twist are the same.",
    ),
    Switch(
        "swirl",
        "Swirl",
        "The rotor turns the air it works in, which takes power and meets the blade more slowly.",
        "The air in the disk moves along the shaft only.",
    ),
    Switch(
        "fuselage",
        "Fuselage drag",
        "The rotor overcomes the drag of the aircraft: parasite power, and a disk tilted forward.",
        "Drag area 0: no parasite power.",
    ),
    Switch(
        "download",
        "Download",
        "The wake presses on the airframe: in hover the thrust exceeds the weight by what the rotor file states.",
        "Thrust carries the weight alone.",
    ),
)
SWITCHES: dict[str, Switch] = {switch.name: switch for switch in _SWITCHES}
"""By field name, in the order in which a waterfall adds them."""


def switched_off(models: Models) -> tuple[Switch, ...]:
    """The effects that these models leave out."""
    return tuple(switch for switch in _SWITCHES if not getattr(models, switch.name))


def with_switches(design: Design, off: Collection[str]) -> Design:
    """The design with exactly these switches (field names) off and all others on."""
    return replace(design, models=replace(design.models, **{name: name not in off for name in SWITCHES}))


OPTIONS = ("bending", "dynamic_stall")
"""Effects that are off unless they are asked for, by field name: for a design file that has them."""


def parse_switches(text: str) -> tuple[str, ...]:
    """Field names from `tip-loss,reverse-flow`; ValueError for a name that is not known."""
    names = tuple(part.strip() for part in text.split(",") if part.strip())
    flags = {switch.flag: switch.name for switch in _SWITCHES} | {name.replace("_", "-"): name for name in OPTIONS}
    for name in names:
        if name.replace("_", "-") not in flags:
            hint = did_you_mean(name, flags) or ":"
            raise ValueError(f"switch {name!r} is not known{hint} use {', '.join(flags)}, separated by commas")
    return tuple(flags[name.replace("_", "-")] for name in names)


def no_effect(design: Design, name: str) -> str:
    """Why a switch cannot change the power of this design, as a clause; empty where it can."""
    hovering = design.hovering
    inflow = inflow_model(design.models.inflow)
    if name in BEYOND_DOCUMENT and design.models.document_losses:
        return "the document does not have it"
    if name in ("fuselage", "download") and design.condition.stand is not None:
        return "there is no airframe on a test stand"
    match name:
        case "flapping" if hovering:
            return "hover is the same at every azimuth"
        case "fuselage" if design.flight_speed == 0.0:
            return "no drag in hover"
        case "tip_loss" if not hovering and inflow.load_dependent and inflow.without_tip_loss() == inflow:
            return "tip loss is part of this wake"
        case "hub_loss" if not hovering and inflow.load_dependent:
            return "root loss is part of this wake"
        case "reverse_flow" if design.condition.advance_ratio <= design.rotor.blade.root_cutout:
            return "no blade element is in reverse flow at this speed"
        case "surface_drag" if design.rotor.blade.surface_drag == 1.0:
            return "the rotor file states none"
        case "swept_tip" if not design.rotor.blade.tip_sweep:
            return "the tip is not swept"
        case "swept_tip" if not design.models.compressibility or _one_mach(design):
            return "sections do not depend on the Mach number"
        case "elastic_twist" if design.rotor.blade.structure is None:
            return "the rotor file has no blade structure"
        case "radial_friction" if hovering:
            return "no air flows along the blade in hover"
        case "download" if not design.fuselage.hover_download:
            return "the rotor file states none"
        case "compressibility" if _one_mach(design):
            return "the section data are for one Mach number"
        case _:
            return ""


def _one_mach(design: Design) -> bool:
    """Whether no section of the blade depends on the Mach number."""
    blade = design.rotor.blade
    names = {span.section for span in blade.spans}
    return not any(np.any(blade.installed(name).table.coefficients[..., 1:]) for name in names)

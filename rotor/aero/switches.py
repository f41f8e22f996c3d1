"""The effects that can be switched off to see their cost in power. For teaching: every aircraft has all of them."""

from collections.abc import Collection

import numpy as np

from rotor.aero.inflow import inflow_model
from rotor.design.design import BEYOND_DOCUMENT, Design, Models, with_models
from rotor.design.quantities import OPTIONS, QUANTITIES, SWITCHES
from rotor.design.quantity import Quantity
from rotor.support.user_input import did_you_mean


def switched_off(models: Models) -> tuple[Quantity, ...]:
    """The effects that these models leave out."""
    return tuple(switch for name, switch in SWITCHES.items() if not getattr(models, name))


def with_switches(design: Design, off: Collection[str]) -> Design:
    """The design with exactly these switches (field names) off and all others on."""
    return with_models(design, **{name: name not in off for name in SWITCHES})


def parse_switches(text: str) -> tuple[str, ...]:
    """Field names from `tip-loss,reverse-flow`; ValueError for a name that is not known."""
    names = tuple(part.strip() for part in text.split(",") if part.strip())
    flags = {QUANTITIES[name].flag: name for name in (*SWITCHES, *OPTIONS)}
    for name in names:
        if name.replace("_", "-") not in flags:
            hint = did_you_mean(name, flags) or ":"
            raise ValueError(
                f"switch {name!r} is not known{hint} use {', '.join(flags)}, separated by commas"
            )
    return tuple(flags[name.replace("_", "-")] for name in names)


def no_effect(design: Design, name: str) -> str:
    """Why a switch cannot change the power of this design, as a clause; empty where it can."""
    hovering = design.hovering
    inflow = inflow_model(design.models.inflow)
    if name in BEYOND_DOCUMENT and design.models.document_losses:
        return "the source document does not have it"
    if name in ("fuselage", "download") and design.condition.stand is not None:
        return "there is no airframe on a test stand"
    match name:
        case "flapping" if design.rotor.blade.rigid:
            return "these blades are rigid"
        case "flapping" | "unsteady" | "dynamic_stall" if hovering:
            return "hover is the same at every azimuth"
        case "dynamic_stall" if not inflow.pointwise:
            return "this inflow balances each point by itself, without lags"
        case "fuselage" if design.flight_speed == 0.0:
            return "no drag in hover"
        case "tip_loss" if not hovering and inflow.keeps_tips:
            return "included in the wake"
        case "hub_loss" if not hovering and inflow.load_dependent:
            return "included in the wake"
        case "reverse_flow" if design.condition.advance_ratio <= design.rotor.blade.root_cutout:
            return "no blade element is in reverse flow at this speed"
        case "surface_drag" if design.rotor.blade.surface_drag == 1.0:
            return "not given in the rotor file"
        case "swept_tip" if not design.rotor.blade.tip_sweep:
            return "the tip is not swept"
        case "swept_tip" if not design.models.compressibility or _one_mach(design):
            return "sections do not depend on the Mach number"
        case "elastic_twist" if design.rotor.blade.structure is None:
            return "the rotor file has no blade structure"
        case "radial_friction" if hovering:
            return "no air flows along the blade in hover"
        case "download" if not design.fuselage.hover_download:
            return "not given in the rotor file"
        case "compressibility" if _one_mach(design):
            return "the section data are for one Mach number"
        case _:
            return ""


def _one_mach(design: Design) -> bool:
    """Whether no section of the blade depends on the Mach number."""
    blade = design.rotor.blade
    names = {span.section for span in blade.spans}
    return not any(np.any(blade.installed(name).table.coefficients[..., 1:]) for name in names)

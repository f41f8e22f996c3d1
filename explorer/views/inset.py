"""The inset: the blade from the side of its tip, and the overlay that it is compared with."""

import math
from typing import Any

from explorer.parts.results import InsetPart
from explorer.picture.blade_mesh import inset_sections
from explorer.picture.picture import drawn_times, flown_twist, follows_azimuth, overlay_twist
from explorer.text.design_words import against
from explorer.views.page_state import PageState, Panel

_OVERLAY_HINT = (
    "The grey blade has the same elastic twist, so you see only the change of built-in twist."
)


def blade_inset(now: PageState) -> dict[str, Any]:
    """The inset with the blade at the azimuth of the reference blade."""
    state = now.state
    if state is None:
        return {}
    solution, psi, turns = (
        state.solution,
        math.radians(state.view.azimuth_deg),
        follows_azimuth(state.solution),
    )
    design, reference = solution.design, state.reference.design
    changed = reference.twist != design.twist
    same_size = design.rotor.radius == reference.rotor.radius
    overlay = overlay_twist(solution, reference.twist, psi) if same_size or not changed else None
    compared = against(design, reference, state.pinned is not None).removeprefix(
        f"{design.aircraft.name} "
    )
    if solution.elastic is None:
        names = "this blade", "The blade is rigid in torsion here.", compared, ""
    else:
        hint = "Built-in plus elastic twist, at the azimuth of the reference blade"
        hint += f", ψ {state.view.azimuth_deg:.0f}°." if turns else "."
        jig = "built-in", "The blade without the loads of flight."
        names = "in flight", hint, *((compared, _OVERLAY_HINT) if changed else jig)
    shown = inset_sections(
        design.rotor, flown_twist(solution, psi), overlay, drawn_times(design, state.view)
    )
    return {"inset": InsetPart(**vars(shown), **dict(zip(_NAMES, names, strict=True)))}


_NAMES = "name", "name_hint", "overlay_name", "overlay_hint"
INSET = Panel(blade_inset, turns=True)

"""The two presets: `flight`, what we believe, and `thesis`, what the document states. Values, not branches."""

from rotor.design.design import Models

PRESETS = ("flight", "thesis")

FLIGHT_MODELS = Models(
    inflow="dynamic-wake",
    hover_inflow="annulus",
    trim="propulsive",
    disk_axial_flow=True,
    blade_weight=True,
    tail_rotor_solved=True,
)
THESIS_MODELS = Models(
    inflow="pitt-peters-15pi/23",
    hover_inflow="closed-form",
    trim="thrust",
    disk_axial_flow=False,
    blade_weight=False,
    tail_rotor_solved=False,
)


def check_preset(preset: str) -> None:
    """Raise ValueError for a preset that does not exist."""
    if preset not in PRESETS:
        raise ValueError(f"preset {preset!r} is not known: use {' or '.join(PRESETS)}")

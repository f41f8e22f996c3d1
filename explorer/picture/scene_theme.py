"""Colours and lights of the 3D scene, for a light page and a dark one.

Colours of lit surfaces are albedos: the lights and the tone mapping brighten them, so they are darker than they look.
"""

from dataclasses import dataclass, field

from explorer.colours import Rgb


@dataclass(frozen=True)
class DiskInk:
    """Colours on the disk, unlit, and how opaque the disk is."""

    stall: Rgb = (158, 18, 84)
    reverse_flow: Rgb = (92, 99, 112)
    reverse_flow_rim: Rgb = (255, 255, 255)
    drag_divergence: Rgb = (16, 20, 30)
    opacity: float = 1.0


@dataclass(frozen=True)
class Light:
    colour: Rgb
    intensity: float
    position: tuple[float, float, float]


_WARM, _COOL, _PALE = (255, 247, 236), (214, 228, 255), (220, 232, 255)


def _lights(key: float, fill: float, rim: float) -> tuple[Light, ...]:
    """Key from port above, fill and rim from starboard: opposite the camera they would whiten the blades."""
    return (
        Light(_WARM, key, (3.0, -9.0, 10.0)),
        Light(_COOL, fill, (2.0, 10.0, 4.0)),
        Light(_PALE, rim, (-5.0, 9.0, 2.6)),
    )


@dataclass(frozen=True)
class SceneTheme:
    """Everything in the scene that a dark page changes; the defaults are those of a light one."""

    blade: Rgb = (30, 33, 40)
    reference_blade: Rgb = (168, 22, 6)
    ghost: Rgb = (120, 130, 146)
    head: Rgb = (52, 56, 64)
    body: Rgb = (96, 104, 117)
    glass: Rgb = (38, 46, 58)
    dark_parts: Rgb = (38, 41, 48)
    lettering: Rgb = (36, 44, 58)
    """Colour of the words round the disk, unlit."""
    shadow: Rgb = (32, 42, 60)
    shadow_strength: float = 0.40
    """Opacity where the shadow is deepest."""
    vortex: Rgb = (8, 44, 128)
    """A tip vortex where it leaves the blade."""
    vortex_end: Rgb = (196, 208, 224)
    """Where it fades, close to the background."""
    inflow: Rgb = (20, 60, 130)
    hub_force: Rgb = (24, 33, 47)
    """Colour of the force over the hub, unlit."""
    hub_moment: Rgb = (0, 118, 150)
    lights: tuple[Light, ...] = _lights(2.3, 0.7, 0.7)
    sky: float = 1.1
    """Intensity of the hemisphere light."""
    environment: float = 0.26
    """Intensity of the environment map, which gives the gloss."""
    ink: DiskInk = field(default_factory=lambda: DiskInk(opacity=0.76))


LIGHT = SceneTheme()
DARK = SceneTheme(
    blade=(96, 104, 118),
    reference_blade=(186, 28, 8),
    ghost=(150, 160, 176),
    head=(70, 76, 88),
    body=(62, 69, 82),
    glass=(10, 13, 18),
    dark_parts=(20, 22, 27),
    lettering=(214, 221, 232),
    shadow=(0, 0, 0),
    shadow_strength=0.60,
    vortex=(40, 96, 190),
    vortex_end=(14, 18, 25),
    inflow=(64, 120, 220),
    hub_force=(240, 244, 250),
    hub_moment=(64, 205, 235),
    lights=_lights(1.9, 0.55, 1.3),
    sky=0.55,
    environment=0.20,
    ink=DiskInk(
        stall=(255, 92, 150),
        reverse_flow=(58, 63, 74),
        drag_divergence=(245, 247, 250),
        opacity=0.80,
    ),
)


def scene_theme(dark: bool) -> SceneTheme:
    return DARK if dark else LIGHT

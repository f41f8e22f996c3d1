"""Colours: perceptual, colour-blind-safe maps made in OKLab, the fixed colours of the page, and of the 3D scene, with
lights.

Colours of lit surfaces are albedos: the lights and the tone mapping brighten them, so they are darker than they look.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rotor.support.arrays import Array

Rgb = tuple[int, int, int]
Scheme = Literal["sequential", "diverging", "margin"]
"""One-sided; two-sided with rust for positive; two-sided with rust for negative, where a margin is used up."""

# OKLab (Ottosson 2020): cube-rooted cone responses from L, a, b, and linear sRGB from cone responses.
_CONES = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
_LINEAR = np.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
)

THIS = "#1c7ed6"
"""The design on the sliders, B where two are compared, in charts."""
PINNED = "#d98a00"
"""The pinned design, A: amber beside blue, which every eye tells apart, and dashed besides."""
BASELINE = "#868e96"
"""The baseline twist, in charts."""
IDEAL = "#0ca678"
"""The power of an ideal lift, in charts."""
NOW = "#e03131"
"""The present point and the reference blade, in charts."""
LIMIT = "#b5179e"
"""A limit, in charts."""
PARTS = {
    "induced": "#3b82c4",
    "profile": "#e6a117",
    "parasite": "#8d949c",
    "climb": "#2f9e44",
    "tail": "#983a6e",
}
"""Power parts, told apart by every eye (tested, as are the lines of charts and the maps)."""

PINNED_OVERLAY: Rgb = (96, 58, 214)
"""The blade of A, in the violet that A has in the frame; an albedo."""
RIM: Rgb = (112, 118, 128)
"""A grey that reads on white and on near-black."""
VOID: Rgb = (150, 152, 156)
"""Where the shown field has no meaning."""
CASING_DARK: Rgb = (20, 20, 24)
"""Outlines have a casing, so that each reads on every colour of the disk."""
CASING_LIGHT: Rgb = (255, 255, 255)


def css(colour: Sequence[int] | NDArray[np.uint8]) -> str:
    """A colour of three channels 0…255 as style sheets and charts write it."""
    red, green, blue = (int(channel) for channel in colour)
    return f"rgb({red},{green},{blue})"


def _linear_rgb(lightness: float, chroma: float, hue_deg: float) -> Array:
    hue = np.radians(hue_deg)
    lab = np.array([lightness, chroma * np.cos(hue), chroma * np.sin(hue)])
    return _LINEAR @ (_CONES @ lab) ** 3


def _srgb(lightness: float, chroma: float, hue_deg: float) -> Array:
    """sRGB 0…1 of an OKLCh colour, its chroma lowered until it fits the gamut (lightness is what carries the data)."""
    low, high = 0.0, chroma
    inside = _linear_rgb(lightness, chroma, hue_deg)
    if inside.min() < 0.0 or inside.max() > 1.0:
        for _ in range(30):
            middle = 0.5 * (low + high)
            linear = _linear_rgb(lightness, middle, hue_deg)
            low, high = (
                (middle, high) if linear.min() >= 0.0 and linear.max() <= 1.0 else (low, middle)
            )
        inside = _linear_rgb(lightness, low, hue_deg)
    inside = np.clip(inside, 0.0, 1.0)
    return np.where(inside <= 0.0031308, 12.92 * inside, 1.055 * inside ** (1.0 / 2.4) - 0.055)


@cache
def _sequential(n: int) -> tuple[Rgb, ...]:
    colours = []
    for t in np.linspace(0.0, 1.0, n):
        # The gamut is narrowest at the greens, and chroma follows it: clipped colours would show a false edge.
        chroma = float(np.interp(t, [0.0, 0.25, 0.5, 1.0], [0.13, 0.11, 0.105, 0.17]))
        colours.append(_bytes(_srgb(0.30 + 0.62 * t, chroma, 290.0 - 190.0 * t)))
    return tuple(colours)


@cache
def _diverging(n: int) -> tuple[Rgb, ...]:
    colours = []
    for t in np.linspace(-1.0, 1.0, n):
        hue = 252.0 if t < 0.0 else 45.0
        away = abs(t)
        chroma = np.interp(away, [0.0, 0.75, 1.0], [0.0, 0.15, 0.14])
        colours.append(_bytes(_srgb(0.96 - 0.60 * away**1.1, float(chroma), hue)))
    return tuple(colours)


def colour_map(scheme: Scheme, n: int) -> NDArray[np.uint8]:
    """`n` colours, shape (n, 3): violet to yellow of steadily rising lightness, or two-sided about a pale middle."""
    if scheme == "sequential":
        return np.array(_sequential(n), dtype=np.uint8)
    colours = np.array(_diverging(n), dtype=np.uint8)
    return colours if scheme == "diverging" else colours[::-1]


def greyed(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Colours without hue, drawn together towards grey: a picture that is no longer the answer."""
    luminance = colours @ np.array([0.2126, 0.7152, 0.0722])
    return np.repeat((0.5 * luminance + 70.0).astype(np.uint8)[:, None], 3, axis=1)


def _bytes(srgb: Array) -> Rgb:
    red, green, blue = (round(255.0 * float(channel)) for channel in srgb)
    return red, green, blue


@dataclass(frozen=True)
class DiskInk:
    """Colours on the disk, unlit, and how opaque the disk is."""

    stall: Rgb = (158, 18, 84)
    reverse_flow: Rgb = (92, 99, 112)
    reverse_flow_rim: Rgb = (255, 255, 255)
    drag_divergence: Rgb = (16, 20, 30)
    opacity: float = 1.0


@dataclass(frozen=True)
class SceneLight:
    colour: Rgb
    intensity: float
    position: tuple[float, float, float]


_WARM, _COOL, _PALE = (255, 247, 236), (214, 228, 255), (220, 232, 255)


def _lights(key: float, fill: float, rim: float) -> tuple[SceneLight, ...]:
    """Key from port above, fill and rim from starboard: opposite the camera they would whiten the blades."""
    return (
        SceneLight(_WARM, key, (3.0, -9.0, 10.0)),
        SceneLight(_COOL, fill, (2.0, 10.0, 4.0)),
        SceneLight(_PALE, rim, (-5.0, 9.0, 2.6)),
    )


@dataclass(frozen=True)
class SceneTheme:
    """Everything in the scene that a dark page changes; the defaults are those of a light one."""

    blade: Rgb = (30, 33, 40)
    reference_blade: Rgb = (168, 22, 6)
    overlay: Rgb = (120, 130, 146)
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
    lights: tuple[SceneLight, ...] = _lights(2.3, 0.7, 0.7)
    sky: float = 1.1
    """Intensity of the hemisphere light."""
    environment: float = 0.26
    """Intensity of the environment map, which gives the gloss."""
    ink: DiskInk = field(default_factory=lambda: DiskInk(opacity=0.76))


LIGHT = SceneTheme()
DARK = SceneTheme(
    blade=(96, 104, 118),
    reference_blade=(186, 28, 8),
    overlay=(150, 160, 176),
    head=(70, 76, 88),
    body=(62, 69, 82),
    glass=(10, 13, 18),
    dark_parts=(20, 22, 27),
    lettering=(214, 221, 232),
    shadow=(0, 0, 0),
    shadow_strength=0.60,
    vortex=(40, 96, 190),
    vortex_end=(14, 18, 25),
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

"""Vibratory hub loads as lines over the hub, in the axes of the shaft: paths of force and moment, a vertical bar."""

import math
from dataclasses import dataclass

import numpy as np

from explorer.model.units import number
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.trim.solution import HubLoads
from rotor.units import GRAVITY

_TENTH = 0.5
"""A tenth of the reference weight is drawn about this long [R]."""
HEIGHT = 0.11
"""Of the lines over the hub [R]: they stand clear of the blades."""
_POINTS = 72


def load_scale(design: Design) -> float:
    """Newtons, and newton metres, that are drawn one metre long: 1, 2 or 5 times a power of ten, for each rotor one."""
    wanted = 0.1 * design.aircraft.mass * GRAVITY / (_TENTH * design.rotor.radius)
    return min(
        (factor * 10.0**power for power in range(1, 6) for factor in (1.0, 2.0, 5.0)),
        key=lambda own: abs(math.log(own / wanted)),
    )


@dataclass(frozen=True, eq=False)
class HubLines:
    """Lines in the axes of the shaft [m], (segments, 2, 3), and where their labels stand."""

    force: Array
    """Path of the in-plane force over one period."""
    bar: Array
    """Vertical force, up and down."""
    moment: Array
    """Path of the moment, right-handed about its own direction."""
    stem: Array
    """From the hub to their centre."""
    now: Array
    """Force and moment at the azimuth of the reference blade, (2, 2, 3)."""
    places: dict[str, list[float]]
    """Of the labels of `force`, `bar` and `moment`."""
    centre: list[float]


def hub_lines(loads: HubLoads, design: Design, psi: float) -> HubLines:
    """Of these loads with the reference blade at ψ [rad]."""
    scale, radius = load_scale(design), design.rotor.radius
    centre = np.array([0.0, 0.0, HEIGHT * radius])

    def points(x: str, y: str, at: Array) -> Array:
        """Ends of the vector where N_b ψ is `at` [rad], (points, 3)."""
        flat = [loads.amplitudes[name] * np.cos(at - loads.phases[name]) / scale for name in (x, y)]
        return centre + np.stack([*flat, np.zeros_like(at)], axis=1)

    period, here = np.linspace(0.0, 2.0 * math.pi, _POINTS + 1), np.array([loads.per_rev * psi])
    force, moment = points("fx", "fy", period), points("mx", "my", period)
    half = np.array([0.0, 0.0, loads.amplitudes["fz"] / scale])
    ends = {
        "force": force[int(np.argmax(force[:, 1]))],
        "bar": centre + half,
        "moment": moment[int(np.argmin(moment[:, 1]))],
    }
    return HubLines(
        force=np.stack((force[:-1], force[1:]), axis=1),
        bar=np.array([[centre - half, centre + half]]),
        moment=np.stack((moment[:-1], moment[1:]), axis=1),
        stem=np.array([[np.zeros(3), centre]]),
        now=np.array([[centre, points(*names, here)[0]] for names in (("fx", "fy"), ("mx", "my"))]),
        places={name: end.tolist() for name, end in ends.items()},
        centre=centre.tolist(),
    )


def scale_words(design: Design) -> str:
    """What a metre of the lines stands for."""
    scale = f"{load_scale(design) / 1e3:g}"
    return f"1 m drawn: {scale} kN, {scale} kN m"


def hub_words(loads: HubLoads, design: Design) -> dict[str, tuple[str, str]]:
    """Label and sentence of `force`, `bar` and `moment`."""
    digits = 1 if load_scale(design) >= 1e3 else 2
    fx, fy, fz, mx, my = (number(loads.amplitudes[name] / 1e3, digits) for name in ("fx", "fy", "fz", "mx", "my"))
    per_rev, scale = f"{loads.per_rev}/rev", f"{load_scale(design) / 1e3:g}"
    return {
        "force": (
            f"in-plane {fx} × {fy} kN",
            f"In-plane force on the hub at {per_rev}: {fx} kN aft, {fy} kN to starboard. The ellipse is its path over "
            f"one period, drawn 1 m for {scale} kN.",
        ),
        "bar": (
            f"vertical ±{fz} kN",
            f"Vertical force on the hub at {per_rev}: up and down by {fz} kN, drawn 1 m for {scale} kN.",
        ),
        "moment": (
            f"moment {mx} × {my} kN m",
            f"Moment on the hub at {per_rev}: {mx} kN m in roll, {my} kN m in pitch. The ellipse is the path of its "
            f"vector over one period, drawn 1 m for {scale} kN m.",
        ),
    }

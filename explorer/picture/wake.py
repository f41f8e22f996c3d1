"""Lines in the air about the rotor: tip vortices and inflow arrows, as segments in the shaft's frame. Metres."""

import math
from collections.abc import Sequence

import numpy as np

from rotor.arrays import Array
from rotor.trim.solution import Solution

_TURNS = 0.8
"""Length of a drawn vortex, in turns of the rotor."""
_POINTS = 59
_CONTRACTION, _CONTRACTS_WITHIN = 0.22, 2.2
"""In hover the wake contracts towards 0.78 R (Landgrebe, 1972), by a factor e within this age [rad]."""
_ARROW_RADII = (0.3, 0.5, 0.7, 0.9)
_ARROW_AZIMUTHS = 24
_ARROW_SCALE = 2.6
"""Length of an inflow arrow in radii per unit of inflow ratio."""
_HEAD = 0.28
"""Length of an arrow's head, as a fraction of the arrow."""


def tip_vortices(solution: Solution, azimuths: Sequence[float]) -> tuple[Array, Array]:
    """Segments of the vortices behind tips at `azimuths` [rad], shape (n, 2, 3), and the age 0…1 of each end, (n, 2).

    A rigid skewed helix: what left a tip at ψ − ζ has since drifted with the stream and the mean inflow. It contracts
    in hover, and less the faster the rotor flies.
    """
    controls, rotor = solution.controls, solution.design.rotor
    mu = solution.design.condition.advance_ratio
    along, down = mu * math.cos(controls.shaft_tilt), mu * math.sin(controls.shaft_tilt) + controls.lambda0
    age = np.linspace(0.0, 2.0 * math.pi * _TURNS, _POINTS)
    hovering = abs(down) / max(math.hypot(along, down), 1e-9)
    r = 1.0 - hovering * _CONTRACTION * (1.0 - np.exp(-age / _CONTRACTS_WITHIN))
    hinge = rotor.blade.flap_hinge
    lines = []
    for psi in azimuths:
        left = psi - age
        flap = controls.coning + controls.flap_1c * np.cos(left) + controls.flap_1s * np.sin(left)
        points = np.stack((r * np.cos(left) + along * age, r * np.sin(left), (1.0 - hinge) * flap - down * age), axis=1)
        lines.append(np.stack((points[:-1], points[1:]), axis=1))
    ages = np.stack((age[:-1], age[1:]), axis=1) / age[-1]
    return rotor.radius * np.concatenate(lines), np.tile(ages, (len(lines), 1))


def inflow_arrows(solution: Solution) -> Array:
    """Arrows from the disk along the induced inflow, as long as it is strong; segments of shape (n, 2, 3).

    Three segments an arrow: shaft and two sides of its head. They point up where the rotor meets an upwash.
    """
    disk, rotor, controls = solution.disk, solution.design.rotor, solution.controls
    psi = 2.0 * math.pi * np.arange(_ARROW_AZIMUTHS) / _ARROW_AZIMUTHS
    columns = np.rint((psi - disk.psi[0]) / (2.0 * math.pi) * len(disk.psi)).astype(int) % len(disk.psi)
    r = np.array(_ARROW_RADII)[:, None]
    length = _ARROW_SCALE * np.stack([np.interp(r[:, 0], disk.r, disk.induced[:, k]) for k in columns], axis=1)
    x, y = r * np.cos(psi), r * np.sin(psi)
    z = controls.flap_1c * x + controls.flap_1s * y
    tail = np.stack((x, y, z), axis=-1).reshape(-1, 3)
    drop = length.reshape(-1)[:, None] * np.array([0.0, 0.0, -1.0])
    tip = tail + drop
    around = np.stack((-np.sin(psi), np.cos(psi), np.zeros_like(psi)), axis=-1)
    aside = np.tile(around, (len(_ARROW_RADII), 1)) * 0.4 * _HEAD * np.abs(length).reshape(-1)[:, None]
    neck = tip - _HEAD * drop
    segments = [np.stack(ends, axis=1) for ends in ((tail, tip), (neck + aside, tip), (neck - aside, tip))]
    return rotor.radius * np.concatenate(segments)

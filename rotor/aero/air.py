"""How the air moves at the blade elements, but for what the load there induces: climb, gust and joined inflow.

Flight, hover, unsteady flow and power read it here, so a further motion of the air is a term of `air_motion`.
"""

from dataclasses import dataclass

import numpy as np

from rotor.aero.disk import Disk
from rotor.design.design import Design
from rotor.design.gust import Gust
from rotor.support.arrays import Array


@dataclass(frozen=True, eq=False)
class AirMotion:
    """Velocities of the air over ΩR, positive down; climb and gust need no load."""

    climb: float
    """λ_c of axial flow, µ_c of flight, which `Design.in_disk_axes` turns with the shaft."""
    gust: Array | None = None
    """What a gust adds to U_P, (elements, azimuths); None in still air."""
    gust_rate: Array | None = None
    """What it adds to U_P' of unsteady flow."""
    joined: tuple[Array, Array] | None = None
    """What is added at low speed to the inflow of the model and to the swirl of momentum theory, (elements,) each."""


def air_motion(design: Design, disk: Disk) -> AirMotion:
    """Value and rate at the elements of a disk.

    A section in unsteady flow moves through the gust: its value is that at three quarters of the chord 2b, its rate
    that in the middle, behind the quarter chord by b/r and b/2r of azimuth. To first order in b the lift is then the
    steady one of the air in the middle (Sears, J. Aero. Sci. 8(3), 1941, at C = 1).

    Raises ValueError in hover for a gust that follows the azimuth.
    """
    gust, speed = design.gust, design.rotor.tip_speed
    if gust is None or type(gust).over_disk is Gust.over_disk:
        return AirMotion(design.vertical_ratio)
    if design.hovering and not gust.axisymmetric:
        raise ValueError(
            f"{gust!r:.80} changes with azimuth, and hover has one azimuth: give a speed, or w(r) alone"
        )
    r, unsteady = disk.r[:, None], design.models.has("unsteady") and not design.hovering
    lag = 0.5 * design.rotor.blade.chord(r) / (design.rotor.radius * r) if unsteady else 0.0
    value, rate = gust.over_disk(r, disk.psi - lag), gust.over_disk(r, disk.psi - 0.5 * lag, 1)
    value, rate = (np.broadcast_to(-each / speed, disk.shape) for each in (value, rate))
    return AirMotion(design.vertical_ratio, value, rate)

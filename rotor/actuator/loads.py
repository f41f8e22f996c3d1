"""Strain that flight puts on the fibres: centrifugal pull, flap bending, twist."""

from dataclasses import dataclass

import numpy as np

from rotor.actuator.catalogue import PiezoPly
from rotor.actuator.fitted import Fitted
from rotor.actuator.flap_bending import elastic_flap_moment
from rotor.arrays import Array
from rotor.dynamics.structure import uh60a_structure
from rotor.dynamics.torsion_beam import added_pull
from rotor.trim.solution import Solution

HALF_THICKNESS = 0.0475
"""Of the SC1095, in chords: how far a skin is from the middle."""


@dataclass(frozen=True, eq=False)
class FibreStrain:
    """Largest tension along the fibres where the plies are [-], (stations,)."""

    r: Array
    """r/R, (stations,)."""
    centrifugal: Array
    flap: Array
    twist: Array

    @property
    def total(self) -> Array:
        return self.centrifugal + self.flap + self.twist


def fibre_strain(fitted: Fitted, solution: Solution | None = None, stations: int = 25) -> FibreStrain:
    """ε_f = ½ε_x(1 − ν) + ½γ at 45°, from F_c/EA, M_flap h/EI and the twist's own shear.

    At another angle ε_f = ε_x(c² − ν s²) + γ s c. Without a solution the flap part is zero. The shear of a full
    voltage swing is taken from the twist rate, γ = 2A θ'/s of a closed cell, a bound for sheets that follow the skin.
    """
    rotor_structure = uh60a_structure(float(fitted.beam.r[-1]))
    r = np.linspace(*fitted.placement.span, stations)
    metres = r * rotor_structure.radius
    speed = fitted.beam.angular_speed
    pull = rotor_structure.centrifugal_force(metres, speed) + added_pull(fitted.added, metres, speed)
    s, c = np.sin(fitted.placement.angle), np.cos(fitted.placement.angle)
    nu = fitted.actuator.material.nu12 if isinstance(fitted.actuator, PiezoPly) else 0.3
    along = c**2 - nu * s**2
    bending = np.zeros_like(r)
    if solution is not None:
        moment = np.abs(elastic_flap_moment(solution, rotor_structure, metres)).max(axis=1)
        arm = HALF_THICKNESS * rotor_structure.chord
        bending = moment * arm / rotor_structure.at(metres, rotor_structure.flap_stiffness)
    # 2A/s of a closed contour is its mean thickness, at most the greatest: on the safe side.
    shear = abs(fitted.twist_rate) * 2.0 * HALF_THICKNESS * rotor_structure.chord
    return FibreStrain(
        r=r,
        centrifugal=along * pull / rotor_structure.axial_stiffness,
        flap=along * bending,
        twist=np.full_like(r, abs(s * c) * shear),
    )

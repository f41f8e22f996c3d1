"""Torque tubes of shape-memory alloy."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from rotor.actuator.kind import (
    MOST_BOUNDS,
    Actuator,
    Drive,
    InstalledActuator,
    Limit,
    MassBreakdown,
    Swings,
)
from rotor.actuator.section import Placement
from rotor.dynamics.structure import structure_data, titanium, uh60a_structure
from rotor.support.arrays import Array
from rotor.trim.solution import Solution

WEB_HEIGHT = 0.0907
"""Height of the SC1095 spar's web at 0.40 c, in chords."""


@dataclass(frozen=True, kw_only=True)
class TorqueTube(Actuator):
    """A shape-memory tube that twists the blade by a moment over its span; `plies` counts tubes in each segment."""

    torque: float
    """[N m] per tube, blocking."""
    free_rotation: float
    """Rotation of the unloaded tube [rad], where its torque has fallen to nothing."""
    link_stiffness: float
    """GJ of the passive tube that carries the torque along the segment [N m²]."""
    link_mass: float
    """Mass of the tube that links actuator and blade [kg/m]."""
    mass: float
    """Package near the hub [kg] per tube."""
    move_power: float
    """[W] per tube."""
    hold_power: float
    """[W] per tube."""
    move_time: float
    """[s]"""
    diameter: float
    """[m]"""

    noun = "tube", "tubes"
    settings = "plies", "span", "crossed"
    range_limits = ("torque",)

    @classmethod
    def read(cls, row: Mapping[str, Any]) -> Self:
        outer, metal = row["link_outer"], titanium()
        inner = outer - 2.0 * row["link_wall"]
        derived = {
            "free_rotation": row["free_shear"] * row["length"] / (0.5 * row["diameter"]),
            "link_stiffness": metal.g12 * math.pi / 32.0 * (outer**4 - inner**4),
            "link_mass": metal.density * math.pi / 4.0 * (outer**2 - inner**2),
        }
        return super().read({**row, **derived})

    @property
    def mode(self) -> str:
        return f"heat, {self.torque:.0f} N·m"

    def count(self, placement: Placement) -> str:
        return f"{super().count(placement)}{' a segment' if placement.divisions else ''}"

    def depth(self, placement: Placement) -> float:
        return self.diameter

    def working_torque(self, compliance: float, length: float, count: int = 1) -> float:
        """Moment of `count` tubes side by side on a segment of a length [m] that twists by compliance [rad/(N m)].

        The tube's line T = T_b (1 − φ/φ_free) meets its load: φ = M c + (M/n) l/GJ_link. Source of the line between
        blocking torque and free rotation, and of tests against torsional springs: Prahlad & Chopra, AIAA 2002-1445
        (their curve is not straight). Range: heated through; hysteresis and the return stroke are not modelled.
        """
        load = count * compliance + length / self.link_stiffness
        return count * self.torque / (1.0 + self.torque * load / self.free_rotation)

    def moments(
        self, moment: float, compliance: Array, lengths: Array, placement: Placement
    ) -> Array:
        pairs = zip(compliance.tolist(), lengths.tolist(), strict=True)
        return np.array(
            [self.working_torque(unit, length, placement.plies) for unit, length in pairs]
        )

    def masses(
        self, placement: Placement, blades: int, skin_area: float, length: float
    ) -> MassBreakdown:
        limits = structure_data()["limits"]
        packages = placement.plies * self.mass * len(placement.segments)
        wiring, electronics = (
            float(limits["wiring_share"]) * packages,
            float(limits["electronics_share"]) * packages,
        )
        made = packages + placement.plies * self.link_mass * length
        return MassBreakdown(blades, made, wiring, 0.0, electronics * blades)

    def drive(self, installed: InstalledActuator, swings: Swings) -> Drive:
        tubes = (
            installed.masses.blades * installed.placement.plies * len(installed.placement.segments)
        )
        return Drive(0.0, tubes * self.hold_power, tubes * self.move_power, self.move_time)

    def limits(
        self, installed: InstalledActuator, swings: Swings, solutions: Sequence[Solution]
    ) -> tuple[Limit, ...]:
        worst = max((abs(swing) for swing in swings), default=0.0)
        retrofit = installed.host.kind == "retrofit"
        height = WEB_HEIGHT * uh60a_structure().chord
        where = (
            "the existing spar is pressurised with nitrogen for its crack indicator and must not be opened"
            if retrofit
            else "a spar designed for it can hold it"
        )
        tubes, moment = installed.placement.plies, installed.moment
        needs = f"{worst * moment:.0f} N·m"
        if worst > MOST_BOUNDS:
            needs = "far more torque than they have"
        by_torque = (
            f"The required twist needs {needs}; {tubes} tube(s) per segment give {moment:.0f} of "
            f"{tubes * self.torque:.0f} N·m when blocked."
        )
        fits = not retrofit and self.diameter <= height
        by_space = (
            f"A tube of {1e3 * self.diameter:.0f} mm in a spar {1e3 * height:.0f} mm high: {where}."
        )
        return (
            Limit("torque", worst <= 1.0 + 1e-9, worst * moment, moment, "N·m", by_torque),
            Limit(
                "space",
                fits,
                1e3 * self.diameter,
                0.0 if retrofit else 1e3 * height,
                "mm",
                by_space,
            ),
        )

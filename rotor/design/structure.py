"""The structure of a blade, as a rotor file states it."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from rotor.arrays import Array


@dataclass(frozen=True)
class BladeStructure:
    """Stiffness, inertia and mass along one blade; linear between stations and constant beyond."""

    radius: float
    """Of the tip [m]."""
    stations: tuple[float, ...]
    """Radii [m], ascending."""
    torsional_stiffness: tuple[float, ...]
    """GJ [N m²]"""
    mass_per_length: tuple[float, ...]
    """[kg/m]"""
    torsional_inertia: tuple[float, ...]
    """I_θ about the pitch axis [kg m]."""
    tension_gyration: float
    """k_A² [m²], the square of the polar radius of gyration of the part that carries the tension."""
    clamp: float
    """Radius of the pitch bearing [m], where the control system holds the blade."""
    control_stiffness: float
    """K_θ of pitch link, swashplate and their supports, as a moment per pitch of one blade [N m/rad]."""
    pitch_horn: float
    """Distance of the pitch link from the pitch axis [m]."""
    flap_stiffness: tuple[float, ...] = ()
    """EI in flap [N m²]; empty where it is not known, as the next."""
    lag_stiffness: tuple[float, ...] = ()
    """EI in lag [N m²]"""
    lag_damper: float = 0.0
    """Of a linear damper at the lag hinge [N m s/rad]."""
    lag_spring: float | None = None
    """Of the root in lag [N m/rad]; None: a hinge is free, a hingeless root is held."""

    def __post_init__(self) -> None:
        bending = tuple(own for own in (self.flap_stiffness, self.lag_stiffness) if own)
        columns = (self.torsional_stiffness, self.mass_per_length, self.torsional_inertia, *bending)
        if len(self.stations) < 2 or any(len(column) != len(self.stations) for column in columns):
            raise ValueError(
                f"a blade structure has {len(self.stations)} stations: give two or more, with one stiffness, mass and "
                "inertia each"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(f"blade structure stations {list(self.stations)} must ascend: sort them")
        smallest = min(min(column) for column in columns)
        if min(smallest, self.control_stiffness, self.pitch_horn) <= 0.0 or self.tension_gyration < 0.0:
            raise ValueError("blade stiffness, mass, inertia, control stiffness and pitch horn must be positive")
        if len(bending) == 1:
            raise ValueError("a blade structure has one of flap and lag stiffness: give both, or neither")

    @property
    def bends(self) -> bool:
        """Whether its stiffness in bending is known."""
        return bool(self.flap_stiffness)

    def at(self, r: ArrayLike, values: tuple[float, ...]) -> Array:
        """One of the distributions at r [m]."""
        return np.interp(np.asarray(r, dtype=float), self.stations, values)

    def centrifugal_force(self, r: ArrayLike, angular_speed: float, steps: int = 400) -> Array:
        """F_c(r) = Ω² ∫_r^R m ρ dρ [N] at r [m]."""
        grid = np.linspace(0.0, self.radius, steps + 1)
        pull = self.at(grid, self.mass_per_length) * grid
        strips = 0.5 * (pull[1:] + pull[:-1]) * np.diff(grid)
        outward = np.concatenate((np.cumsum(strips[::-1])[::-1], [0.0]))
        return angular_speed**2 * np.interp(np.asarray(r, dtype=float), grid, outward)

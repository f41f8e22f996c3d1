"""Classical plane-stress laminates with free strain, and the wall of a beam made of them.

Axes of a wall: x along the span, s around the section. Resultants are of membrane kind, thickness times stress [N/m].
"""

import math
from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array


@dataclass(frozen=True)
class Material:
    """An orthotropic sheet, axis 1 along the fibres [Pa]."""

    name: str
    e1: float
    e2: float
    nu12: float
    g12: float
    density: float
    """[kg/m³]"""

    def __post_init__(self) -> None:
        if min(self.e1, self.e2, self.g12, self.density) <= 0.0 or self.nu12**2 >= self.e1 / self.e2:
            raise ValueError(f"material {self.name!r} is not elastic: give positive moduli and nu12² < E1/E2")


@dataclass(frozen=True)
class Layer:
    """A sheet in a wall."""

    material: Material
    thickness: float
    """[m]"""
    angle: float
    """Of the fibres from the span axis [rad]."""
    free_strain: tuple[float, float] = (0.0, 0.0)
    """Λ1, Λ2 along and across the fibres: what voltage (or heat) does to the sheet when nothing holds it [-]."""


def reduced_stiffness(material: Material) -> Array:
    """Plane-stress Q of the sheet in its own axes (1, 2, 12) [Pa], (3, 3). Jones, Mechanics of Composite Materials."""
    nu21 = material.nu12 * material.e2 / material.e1
    k = 1.0 / (1.0 - material.nu12 * nu21)
    off = material.nu12 * material.e2 * k
    return np.array([[material.e1 * k, off, 0.0], [off, material.e2 * k, 0.0], [0.0, 0.0, material.g12]])


def strain_rotation(angle: float) -> Array:
    """Strains (ε_x, ε_s, γ_xs) to fibre axes (ε_1, ε_2, γ_12), (3, 3). Its transpose turns stresses back."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]])


def rotated_stiffness(material: Material, angle: float) -> Array:
    """Q̄ of the sheet in wall axes (x, s, xs) [Pa], (3, 3)."""
    turn = strain_rotation(angle)
    return turn.T @ reduced_stiffness(material) @ turn


def free_strain_in_wall_axes(layer: Layer) -> Array:
    """(ε_x, ε_s, γ_xs) of the unheld sheet: ε_x = Λ1c² + Λ2s², ε_s = Λ1s² + Λ2c², γ = 2sc(Λ1 − Λ2) [-]."""
    c, s = math.cos(layer.angle), math.sin(layer.angle)
    along, across = layer.free_strain
    return np.array([along * c * c + across * s * s, along * s * s + across * c * c, 2.0 * s * c * (along - across)])


def blocked_shear_flow(layer: Layer) -> float:
    """Shear flow of a sheet held still [N/m]; at 45° ½t[(Q11 − Q12)Λ1 − (Q22 − Q12)Λ2], zero for an isotropic one."""
    blocked = rotated_stiffness(layer.material, layer.angle) @ free_strain_in_wall_axes(layer)
    return layer.thickness * float(blocked[2])


@dataclass(frozen=True, eq=False)
class Wall:
    """A laminate as a beam's wall, free of hoop force: N_x, q = stiffness · (ε_x, γ) − actuation."""

    stiffness: Array
    """[N/m], (2, 2)."""
    actuation: Array
    """Blocked (N_x, q) [N/m], (2,)."""
    mass: float
    """[kg/m²]"""


def wall_of(layers: tuple[Layer, ...]) -> Wall:
    """The laminate with its hoop force set to zero, as a thin wall between stations that are far apart may do."""
    a, n = np.zeros((3, 3)), np.zeros(3)
    for layer in layers:
        q = rotated_stiffness(layer.material, layer.angle)
        a += layer.thickness * q
        n += layer.thickness * (q @ free_strain_in_wall_axes(layer))
    keep = np.array([0, 2])
    across = a[keep, 1] / a[1, 1]
    return Wall(
        stiffness=a[np.ix_(keep, keep)] - np.outer(across, a[1, keep]),
        actuation=n[keep] - across * n[1],
        mass=sum(layer.thickness * layer.material.density for layer in layers),
    )

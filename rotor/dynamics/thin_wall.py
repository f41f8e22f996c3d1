"""Thin-walled beams of several cells: laminated walls, sections by Bredt–Batho, active plies included.

Axes of a wall: x along the span, s around the section. Resultants are thickness times stress [N/m]. The laminate is
under plane stress with free strain, without hoop force. Every wall element carries N_x and q; extension, both bendings
and twist are free. With q = Σ ± q_j of the cells it borders and γ = (q + q_a − S₂₁ ε_x)/S₂₂,

    ∫N_x ds = F,   ∫N_x y ds = M_y,   ∫N_x z ds = M_z,   ∮_j γ ds = 2A_j θ',   Σ 2A_j q_j = T.

Source: Jones, Mechanics of Composite Materials, for the laminate; Bredt 1896 and Batho 1916 for isotropic walls
(Megson, Aircraft Structures); an active ply enters as a blocked shear flow.
Range: thin walls, long beams, uniform section, no restrained warping.
"""

import math
from dataclasses import dataclass

import numpy as np

from rotor.support.arrays import Array


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
        if (
            min(self.e1, self.e2, self.g12, self.density) <= 0.0
            or self.nu12**2 >= self.e1 / self.e2
        ):
            raise ValueError(
                f"material {self.name!r} is not elastic: give positive moduli and nu12² < E1/E2"
            )


@dataclass(frozen=True)
class Layer:
    """A sheet of one material in a wall, with its thickness, fibre angle and free strain."""

    material: Material
    thickness: float
    """[m]"""
    angle: float
    """Angle of the fibres from the span axis [rad]."""
    free_strain: tuple[float, float] = (0.0, 0.0)
    """Λ1, Λ2 along and across the fibres: strain of the free sheet under voltage or heat [-]."""


def reduced_stiffness(material: Material) -> Array:
    """Plane-stress Q of the sheet in its own axes (1, 2, 12) [Pa], (3, 3). Jones, Mechanics of Composite Materials."""
    nu21 = material.nu12 * material.e2 / material.e1
    k = 1.0 / (1.0 - material.nu12 * nu21)
    off = material.nu12 * material.e2 * k
    return np.array(
        [[material.e1 * k, off, 0.0], [off, material.e2 * k, 0.0], [0.0, 0.0, material.g12]]
    )


def strain_rotation(angle: float) -> Array:
    """Strains (ε_x, ε_s, γ_xs) to axes of fibres at an angle [rad], (3, 3). Its transpose turns stresses back."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array(
        [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]]
    )


def rotated_stiffness(material: Material, angle: float) -> Array:
    """Q̄ of the sheet in wall axes (x, s, xs) [Pa], (3, 3)."""
    turn = strain_rotation(angle)
    return turn.T @ reduced_stiffness(material) @ turn


def free_strain_in_wall_axes(layer: Layer) -> Array:
    """(ε_x, ε_s, γ_xs) of the free sheet: ε_x = Λ1c² + Λ2s², ε_s = Λ1s² + Λ2c², γ = 2sc(Λ1 − Λ2) [-]."""
    return strain_rotation(-layer.angle) @ np.array([*layer.free_strain, 0.0])


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
    """The laminate without hoop force, as in a thin wall far from ribs and ends."""
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


@dataclass(frozen=True, eq=False)
class WallPanel:
    """A stretch of wall with one laminate."""

    points: Array
    """(y, z) along it [m], (points, 2)."""
    layers: tuple[Layer, ...]
    cells: tuple[int, ...]
    """Numbers (from 1) of the cells on the left along the points; negative for a cell on the right."""


@dataclass(frozen=True, eq=False)
class WallSection:
    """Wall elements of a closed section, each straight."""

    y: Array
    z: Array
    """Middle of each element [m], (elements,)."""
    length: Array
    """[m], (elements,)."""
    stiffness: Array
    """(elements, 2, 2) [N/m]."""
    actuation: Array
    """Blocked (N_x, q) at unit voltage fraction, (elements, 2) [N/m]."""
    mass: Array
    """[kg/m²], (elements,)."""
    membership: Array
    """+1 where the cell is on the left, −1 on the right, (elements, cells)."""
    areas: Array
    """Enclosed by each cell [m²], (cells,)."""


@dataclass(frozen=True)
class SectionResponse:
    """Deformation of a section under loads or actuation."""

    extension: float
    """ε_x at y = z = 0 [-]."""
    curvature_y: float
    """Change of ε_x with y [1/m]."""
    curvature_z: float
    """Change of ε_x with z [1/m]."""
    twist_rate: float
    """θ' [rad/m]."""


def build_section(panels: tuple[WallPanel, ...]) -> WallSection:
    """A section of straight wall elements, with the areas of its cells."""
    walls = [wall_of(panel.layers) for panel in panels]
    cells = max(abs(cell) for panel in panels for cell in panel.cells)
    counts = [len(panel.points) - 1 for panel in panels]
    step = np.concatenate([np.diff(panel.points, axis=0) for panel in panels])
    middle = np.concatenate([0.5 * (panel.points[1:] + panel.points[:-1]) for panel in panels])
    side = np.zeros((len(panels), cells))
    for k, panel in enumerate(panels):
        for cell in panel.cells:
            side[k, abs(cell) - 1] = np.sign(cell)
    membership = np.repeat(side, counts, axis=0)
    return WallSection(
        y=middle[:, 0],
        z=middle[:, 1],
        length=np.hypot(*step.T),
        stiffness=np.repeat([wall.stiffness for wall in walls], counts, axis=0),
        actuation=np.repeat([wall.actuation for wall in walls], counts, axis=0),
        mass=np.repeat([wall.mass for wall in walls], counts),
        membership=membership,
        areas=0.5 * (membership.T @ (middle[:, 0] * step[:, 1] - middle[:, 1] * step[:, 0])),
    )


def respond(
    section: WallSection,
    *,
    torque: float = 0.0,
    force: float = 0.0,
    moments: tuple[float, float] = (0.0, 0.0),
    voltage: float = 0.0,
) -> SectionResponse:
    """The section under T [N m], F [N], (∫N_x y, ∫N_x z) [N m], and voltage as a fraction of the plies' full range."""
    s11, s12, s22 = (
        section.stiffness[:, 0, 0],
        section.stiffness[:, 0, 1],
        section.stiffness[:, 1, 1],
    )
    axial = (s11 - s12**2 / s22) * section.length
    coupling = s12 / s22 * section.length
    flexibility = section.length / s22
    n_a, q_a = voltage * section.actuation.T
    shape = np.stack([np.ones_like(section.y), section.y, section.z])
    side = section.membership
    cells = side.shape[1]
    size = 4 + cells  # ε_x and its two slopes, twist rate, cell flows.
    matrix, right = np.zeros((size, size)), np.zeros(size)
    matrix[:3, :3] = (shape * axial) @ shape.T
    matrix[:3, 4:] = (shape * coupling) @ side
    right[:3] = np.array([force, *moments]) + shape @ (n_a * section.length - coupling * q_a)
    matrix[4:, :3] = -matrix[:3, 4:].T
    matrix[4:, 3] = -2.0 * section.areas
    matrix[4:, 4:] = side.T @ (flexibility[:, None] * side)
    right[4:] = -side.T @ (flexibility * q_a)
    matrix[3, 4:] = 2.0 * section.areas
    right[3] = torque
    scale = np.sqrt(np.abs(np.diagonal(matrix)))
    scale[3] = np.abs(2.0 * section.areas).max() / scale[4:].max()
    unknowns = np.linalg.solve(matrix / np.outer(scale, scale), right / scale) / scale
    return SectionResponse(*unknowns[:4].tolist())


def torsional_stiffness(section: WallSection) -> float:
    """GJ [N m²]; for one isotropic cell Bredt's 4A²/∮ds/(Gt)."""
    return 1.0 / respond(section, torque=1.0).twist_rate


def induced_twist_rate(section: WallSection) -> float:
    """θ'_a of the free section at the full voltage range of its plies [rad/m]."""
    return respond(section, voltage=1.0).twist_rate


def mass_per_length(section: WallSection) -> float:
    """Mass per length of the section [kg/m]."""
    return float(section.mass @ section.length)

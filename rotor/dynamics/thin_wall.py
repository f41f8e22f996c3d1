"""Thin-walled beams of several cells: Bredt–Batho with laminated walls that may be active.

Every wall element carries N_x and q; extension, both bendings and twist are free to follow. With q = Σ ± q_j of the
cells it borders and γ = (q + q_a − S₂₁ ε_x)/S₂₂,

    ∫N_x ds = F,   ∫N_x y ds = M_y,   ∫N_x z ds = M_z,   ∮_j γ ds = 2A_j θ',   Σ 2A_j q_j = T.

Source: Bredt 1896 and Batho 1916 for isotropic walls (Megson, Aircraft Structures); active ply as a blocked shear flow.
Range: thin walls, long beams, uniform section, no restrained warping.
"""

from dataclasses import dataclass

import numpy as np

from rotor.arrays import Array
from rotor.dynamics.laminate import Layer, Wall, wall_of


@dataclass(frozen=True, eq=False)
class Panel:
    """A stretch of wall with one laminate."""

    points: Array
    """(y, z) along it [m], (points, 2)."""
    layers: tuple[Layer, ...]
    cells: tuple[int, ...]
    """Cells on its left as it is walked, as numbers from 1; minus the number for a cell on its right."""


@dataclass(frozen=True, eq=False)
class Section:
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
class Response:
    """What a section does under loads, or when its active plies are switched on."""

    twist_rate: float
    """θ' [rad/m]."""
    extension: float
    """ε_x at y = z = 0 [-]."""
    curvature_y: float
    """Change of ε_x with y [1/m]."""
    curvature_z: float
    """Change of ε_x with z [1/m]."""
    cell_flows: tuple[float, ...]
    """q of each cell [N/m]."""


def build_section(panels: tuple[Panel, ...]) -> Section:
    """Cut panels into straight elements and measure the cells."""
    walls: list[Wall] = [wall_of(panel.layers) for panel in panels]
    cells = max(abs(cell) for panel in panels for cell in panel.cells)
    parts: list[tuple[Array, Array, Array, Array, Wall]] = []
    for panel, wall in zip(panels, walls, strict=True):
        step = np.diff(panel.points, axis=0)
        middle = 0.5 * (panel.points[1:] + panel.points[:-1])
        side = np.zeros((len(step), cells))
        for cell in panel.cells:
            side[:, abs(cell) - 1] = np.sign(cell)
        parts.append((middle, np.hypot(*step.T), side, middle[:, 0] * step[:, 1] - middle[:, 1] * step[:, 0], wall))
    counts = [len(part[0]) for part in parts]
    middles = np.concatenate([part[0] for part in parts])
    membership = np.concatenate([part[2] for part in parts])
    swept = np.concatenate([part[3] for part in parts])
    return Section(
        y=middles[:, 0],
        z=middles[:, 1],
        length=np.concatenate([part[1] for part in parts]),
        stiffness=np.repeat(np.stack([wall.stiffness for wall in walls]), counts, axis=0),
        actuation=np.repeat(np.stack([wall.actuation for wall in walls]), counts, axis=0),
        mass=np.repeat([wall.mass for wall in walls], counts),
        membership=membership,
        areas=0.5 * (membership.T @ swept),
    )


def respond(
    section: Section,
    *,
    torque: float = 0.0,
    force: float = 0.0,
    moments: tuple[float, float] = (0.0, 0.0),
    voltage: float = 0.0,
) -> Response:
    """The section under T [N m], F [N], (∫N_x y, ∫N_x z) [N m], and voltage as a fraction of the plies' full range."""
    s11, s12, s22 = section.stiffness[:, 0, 0], section.stiffness[:, 0, 1], section.stiffness[:, 1, 1]
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
    answer = np.linalg.solve(matrix / np.outer(scale, scale), right / scale) / scale
    return Response(
        twist_rate=float(answer[3]),
        extension=float(answer[0]),
        curvature_y=float(answer[1]),
        curvature_z=float(answer[2]),
        cell_flows=tuple(float(flow) for flow in answer[4:]),
    )


def torsional_stiffness(section: Section) -> float:
    """GJ [N m²]; for one isotropic cell Bredt's 4A²/∮ds/(Gt)."""
    return 1.0 / respond(section, torque=1.0).twist_rate


def axial_stiffness(section: Section) -> float:
    """EA [N], bendings and twist free."""
    return float(1.0 / _extension_at_centre(section))


def _extension_at_centre(section: Section) -> float:
    """ε_x per newton applied at the tension centre, where it bends nothing: the least over all points."""
    base = respond(section, force=1.0)
    by_y, by_z = respond(section, moments=(1.0, 0.0)), respond(section, moments=(0.0, 1.0))
    compliance = np.array(
        [
            [base.extension, by_y.extension, by_z.extension],
            [base.curvature_y, by_y.curvature_y, by_z.curvature_y],
            [base.curvature_z, by_y.curvature_z, by_z.curvature_z],
        ]
    )
    return float(compliance[0, 0] - compliance[0, 1:] @ np.linalg.solve(compliance[1:, 1:], compliance[1:, 0]))


def induced_twist_rate(section: Section) -> float:
    """θ'_a of the free section when its plies see their whole voltage range [rad/m]."""
    return respond(section, voltage=1.0).twist_rate


def actuation_moment(section: Section) -> float:
    """M_a = GJ θ'_a: the end moment that would twist the passive section as much [N m]."""
    return torsional_stiffness(section) * induced_twist_rate(section)


def mass_per_length(section: Section) -> float:
    """[kg/m]"""
    return float(section.mass @ section.length)

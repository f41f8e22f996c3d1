"""A uniform beam's cross section by finite elements: the oracle for thin-walled sections with active plies.

Saint-Venant's problem without thin-wall assumptions: every point of the section may move in all three directions, the
same at every station of the span, on top of extension, two curvatures and twist,

    ε_xx = e + κ_y y + κ_z z,   γ_xy = u,y − θ' z,   γ_xz = u,z + θ' y,   and v, w in the plane,

with three-dimensional orthotropic layers and a free strain in some of them (heat in place of voltage: the thermal
analogy). Minimum of the elastic energy gives the 4 × 4 stiffness of the beam and what the free strain does to it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from skfem import (
    Basis,
    BilinearForm,
    ElementQuad2,
    ElementVector,
    LinearForm,
    MeshQuad,
    condense,
    solve,
)

from rotor.dynamics.thin_wall import Layer

# Strain order: xx, yy, zz, yz, xz, xy; the section's plane is (y, z).
PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


@dataclass(frozen=True, eq=False)
class Stiffness:
    matrix: np.ndarray
    """By (extension, κ_y, κ_z, θ'), (4, 4)."""
    actuation: np.ndarray
    """What the free strain pushes with, (4,)."""

    @property
    def torsional(self) -> float:
        """GJ with extension and bendings free."""
        return float(1.0 / np.linalg.inv(self.matrix)[3, 3])

    @property
    def twist_rate(self) -> float:
        """θ' of the free section under its free strain."""
        return float(np.linalg.solve(self.matrix, self.actuation)[3])


def closed_wall(line: np.ndarray, layers: list[list[Layer]]) -> tuple[MeshQuad, list, np.ndarray]:
    """A closed line thickened about itself. `layers[k]`: of the wall from point k on, from inside to outside.

    Every stretch must have layers of the same thicknesses. Returns mesh, layer and tangent of each element.
    """
    n = len(line)
    ahead, behind = np.roll(line, -1, axis=0) - line, line - np.roll(line, 1, axis=0)
    normals = [
        np.column_stack([d[:, 1], -d[:, 0]]) / np.hypot(*d.T)[:, None] for d in (behind, ahead)
    ]
    half = normals[0] + normals[1]
    mitre = 2.0 * half / (half**2).sum(axis=1)[:, None]  # Outward: the line runs counter-clockwise.
    thicknesses = [layer.thickness for layer in layers[0]]
    heights = np.concatenate([[0.0], np.cumsum(thicknesses)])
    rows = len(heights)
    points = np.concatenate([line + mitre * (height - 0.5 * heights[-1]) for height in heights])
    quads, owners, tangents = [], [], []
    for row in range(rows - 1):
        for k in range(n):
            a, b = row * n + k, row * n + (k + 1) % n
            quads.append((a, a + n, b + n, b))
            owners.append(layers[k][row])
            tangents.append(ahead[k] / np.hypot(*ahead[k]))
    return MeshQuad(points.T, np.array(quads).T), owners, np.array(tangents)


def with_web(
    mesh: MeshQuad,
    owners: list,
    tangents: np.ndarray,
    ends: tuple[int, int],
    layer: Layer,
    rows: int = 12,
) -> tuple[MeshQuad, list, np.ndarray]:
    """A web across the inside of a closed wall, from its stretch `ends[0]` on top to `ends[1]` below."""
    top, bottom = ends
    a, b = mesh.p[:, top], mesh.p[:, top + 1]  # Walked backwards on top, forwards below.
    d, c = mesh.p[:, bottom + 1], mesh.p[:, bottom]
    n = mesh.p.shape[1]
    inner = np.linspace(0.0, 1.0, rows + 1)[1:-1]
    points = np.concatenate([np.array([a + t * (d - a), b + t * (c - b)]) for t in inner])
    left = [top + 1, *(n + 1 + 2 * k for k in range(rows - 1)), bottom]
    right = [top, *(n + 2 * k for k in range(rows - 1)), bottom + 1]
    quads = np.array([(left[k + 1], right[k + 1], right[k], left[k]) for k in range(rows)])
    whole = MeshQuad(np.column_stack([mesh.p, points.T]), np.column_stack([mesh.t, quads.T]))
    return (
        whole,
        [*owners, *[layer] * rows],
        np.concatenate([tangents, np.tile([0.0, 1.0], (rows, 1))]),
    )


def analyse(mesh: MeshQuad, owners: list[Layer], tangents: np.ndarray) -> Stiffness:
    """Solve the section."""
    stiffness, free = zip(
        *(_in_space(*pair) for pair in zip(owners, tangents, strict=True)), strict=True
    )
    c = np.moveaxis(np.array(stiffness), 0, -1)[..., None]  # (6, 6, elements, 1)
    e0 = np.moveaxis(np.array(free), 0, -1)[..., None]
    basis = Basis(mesh, ElementVector(ElementQuad2(), 3), intorder=4)
    points = np.asarray(basis.global_coordinates())
    zero = np.zeros_like(points[0])
    one = zero + 1.0
    modes = [
        [one, zero, zero, zero, zero, zero],
        [points[0], zero, zero, zero, zero, zero],
        [points[1], zero, zero, zero, zero, zero],
        [zero, zero, zero, zero, points[0], -points[1]],
    ]

    def strain(u):
        g = u.grad
        return [None, g[1, 0], g[2, 1], g[1, 1] + g[2, 0], g[0, 1], g[0, 0]]

    def product(left, right):
        return sum(
            left[i] * c[i, j] * right[j]
            for i in range(6)
            for j in range(6)
            if left[i] is not None and right[j] is not None
        )

    k = BilinearForm(lambda u, v, w: product(strain(v), strain(u))).assemble(basis)
    loads = [
        LinearForm(lambda v, w, m=m: product(strain(v), m)).assemble(basis)
        for m in [*modes, list(e0)]
    ]
    corner = int(np.argmin(mesh.p[0]))
    far = int(np.argmax(mesh.p[0]))
    dofs: Any = basis.nodal_dofs
    fixed = np.concatenate([dofs[:, corner], dofs[2:3, far]])
    moved = [_solve(k, load, fixed) for load in loads]
    dx = basis.dx
    direct = np.array([[float((product(a, b) * dx).sum()) for b in modes] for a in modes])
    pushed = np.array([float((product(a, list(e0)) * dx).sum()) for a in modes])
    coupling = np.array([[load @ answer for answer in moved] for load in loads[:4]])
    return Stiffness(direct - coupling[:, :4], pushed - coupling[:, 4])


def _solve(matrix: Any, load: Any, fixed: Any) -> Any:
    """The displacements with some of them held at zero."""
    held: Any = condense(matrix, load, D=fixed)
    return solve(*held)


def _in_space(layer: Layer, tangent: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness (6, 6) and free strain (6,) of a layer in section axes; transversely isotropic about its fibres."""
    m = layer.material
    nu23 = m.nu12 if m.e1 == m.e2 else min(m.nu12 * 1.2, 0.4)
    g23 = m.g12 if m.e1 == m.e2 else m.e2 / (2.0 * (1.0 + nu23))
    compliance = np.zeros((6, 6))
    compliance[0, 0] = 1.0 / m.e1
    compliance[1, 1] = compliance[2, 2] = 1.0 / m.e2
    compliance[0, 1] = compliance[1, 0] = compliance[0, 2] = compliance[2, 0] = -m.nu12 / m.e1
    compliance[1, 2] = compliance[2, 1] = -nu23 / m.e2
    compliance[3, 3], compliance[4, 4], compliance[5, 5] = 1.0 / g23, 1.0 / m.g12, 1.0 / m.g12
    own = np.linalg.inv(compliance)
    along, across = np.array([1.0, 0.0, 0.0]), np.array([0.0, *tangent])
    cos, sin = np.cos(layer.angle), np.sin(layer.angle)
    axes = np.array(
        [cos * along + sin * across, -sin * along + cos * across, np.cross(along, across)]
    )
    turn = np.zeros((6, 6))  # Engineering strains, section axes to layer axes.
    for i, (a, b) in enumerate(PAIRS):
        for j, (p, q) in enumerate(PAIRS):
            pair = axes[a, p] * axes[b, q]
            if a != b:
                pair = 2.0 * pair if p == q else pair + axes[a, q] * axes[b, p]
            turn[i, j] = pair
    free = np.array([*layer.free_strain, 0.0, 0.0, 0.0, 0.0])
    return turn.T @ own @ turn, np.linalg.solve(turn, free)

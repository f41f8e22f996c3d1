"""The vortex lattice as an inflow model: slower, and the reference for the others.

The helices are rigid: fixed once by the wake of momentum theory at the required thrust, not moved by the trim. So the
inflow is exactly linear in the load and the trim's derivatives stay exact. The lattice is coarser around the azimuth
than the grid of blade elements, and finer at the tip. Fields are interpolated by Fourier series around the azimuth and
by straight lines along the blade, so that λ_i = B A Γ(d) is one linear map on the grid of blade elements.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import AnyField, InflowFeedback, Wake
from rotor.aero.inflow.vortex_lattice import Lattice, shared_azimuths
from rotor.arrays import Array


@dataclass(frozen=True, eq=False)
class LatticeTransfer:
    """Interpolation both ways; a field is (elements, azimuths) on the grid, (panels, azimuths) on the lattice."""

    inward: Array
    """Elements → panels, (panels, elements); goes to zero at root and tip as circulation does."""
    outward: Array
    """Panels → elements, (elements, panels); constant beyond the last panel."""
    around: Array
    """Azimuths of the grid → of the lattice, (lattice, grid)."""
    back: Array
    """Azimuths of the lattice → of the grid, (grid, lattice)."""

    def circulation_to_lattice(self, field: Array) -> Array:
        return self.inward @ field @ self.around.T

    def inflow_to_grid(self, field: Array) -> Array:
        return self.outward @ field @ self.back.T


def transfer(lattice: Lattice, r: Array, azimuths: int) -> LatticeTransfer:
    """The transfer for elements r, (elements,), and evenly spaced azimuths."""
    own, n = lattice.r, len(r)
    padded = np.concatenate(([lattice.root], r, [1.0]))
    inward = np.stack([np.interp(own, padded, np.pad(unit, 1)) for unit in np.eye(n)], axis=1)
    outward = np.stack([np.interp(r, own, unit) for unit in np.eye(lattice.panels)], axis=1)
    return LatticeTransfer(
        inward, outward, _resampling(azimuths, lattice.azimuths), _resampling(lattice.azimuths, azimuths)
    )


def _resampling(source: int, target: int) -> Array:
    """Fourier interpolation of evenly spaced periodic samples, (target, source): the harmonics that both resolve."""
    highest = (min(source, target) - 1) // 2
    angle = 2.0 * np.pi * (np.arange(target)[:, None] / target - np.arange(source) / source)
    waves = np.arange(1, highest + 1)
    return (1.0 + 2.0 * np.cos(angle[..., None] * waves).sum(axis=-1)) / source


PANELS, AZIMUTHS = 16, 36
"""Lattice whose power is within 0.4 % of 24 × 60 with 80 elements (tested); the least number of azimuths."""


@dataclass(frozen=True)
class VortexWakeInflow(AnyField):
    """Rigid skewed helical vortex lattice of the rotor's own blades."""

    geometry: Wake | None = None
    """The wake that the helices follow; None until it is fixed."""

    name = "vortex-wake"
    title = "Vortex wake (rigid helices)"
    explanation = "Each blade trails a rigid helical vortex sheet: the reference for other models, about 1 s per trim."
    load_dependent = True

    def without_tip_loss(self) -> "VortexWakeInflow":
        """Itself: the tip loss of a lattice is that of its finite blades."""
        return self

    def with_wake_geometry(self, expected: Wake) -> "VortexWakeInflow":
        """The model with its helices along the expected wake."""
        return replace(self, geometry=expected)

    def respond(self, disk: Disk, wake: Wake, load: Array) -> "VortexWakeResponse":
        """λ_i = A d of the fixed helices."""
        geometry = self.geometry or wake
        return VortexWakeResponse(_influence(disk, geometry.mu_x, geometry.axial), load)


@dataclass(frozen=True, eq=False)
class _Influence:
    """The map from a load field on the disk to the inflow there, by the lattice."""

    grids: LatticeTransfer
    matrix: Array
    """Downwash of the lattice per load on it, (points, points)."""

    @cached_property
    def by_slope(self) -> "_SlopeMap":
        """What the feedback of any slope needs."""
        grids = self.grids
        across = np.einsum("pi,iq->pqi", grids.inward, grids.outward)
        pairs = np.nonzero(across.any(axis=-1))
        panels, azimuths = len(grids.inward), len(grids.around)
        return _SlopeMap(
            pairs=(pairs[0].tolist(), pairs[1].tolist()),
            across=across[pairs],
            around=np.einsum("aj,jb->jab", grids.around, grids.back).reshape(-1, azimuths * azimuths),
            matrix=np.ascontiguousarray(self.matrix.reshape(-1, panels, azimuths).transpose(1, 0, 2)),
        )

    def gather(self, fields: Array) -> Array:
        """Disk to lattice, (…, points)."""
        return (self.grids.inward @ fields @ self.grids.around.T).reshape(*fields.shape[:-2], -1)

    def spread(self, points: Array) -> Array:
        """Lattice to disk, (…, elements, azimuths)."""
        return self.grids.outward @ self._square(points) @ self.grids.back.T

    def gather_transposed(self, points: Array) -> Array:
        return self.grids.inward.T @ self._square(points) @ self.grids.around

    def spread_transposed(self, field: Array) -> Array:
        return (self.grids.outward.T @ field @ self.grids.back).reshape(-1)

    def _square(self, points: Array) -> Array:
        return points.reshape(*points.shape[:-1], len(self.grids.inward), len(self.grids.around))


@dataclass(frozen=True, eq=False)
class _SlopeMap:
    """Interpolations and influence, arranged to assemble A diag K on the lattice."""

    pairs: tuple[list[int], list[int]]
    """Panels that interpolation to the elements and back joins."""
    across: Array
    """Of each pair, by element, (pairs, elements)."""
    around: Array
    """Of each two azimuths of the lattice, by azimuth of the disk, (azimuths, pairs of azimuths)."""
    matrix: Array
    """The influence by panel that sends, (panels, points, azimuths)."""


class VortexWakeResponse:
    """The response to one load."""

    def __init__(self, influence: _Influence, load: Array) -> None:
        self._influence = influence
        self.induced = self.apply(load)
        self.coordinates = self.induced.ravel()
        self.by_wake = np.zeros((3, *load.shape))

    def apply(self, fields: Array) -> Array:
        """A f."""
        return self._influence.spread(self._influence.gather(fields) @ self._influence.matrix.T)

    def apply_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        return self._influence.gather_transposed(self._influence.spread_transposed(field) @ self._influence.matrix)

    def feedback(self, slope: Array) -> InflowFeedback:
        """(I − A diag K)⁻¹ through one factorisation of the lattice's size."""
        lattice = self._influence.by_slope
        panels, points, azimuths = lattice.matrix.shape
        # Matrix · gather · diag(K) · spread; interpolation along the blade joins neighbouring panels only.
        joined = (lattice.across @ slope @ lattice.around).reshape(-1, azimuths, azimuths)
        product = np.zeros((panels, points, azimuths))
        for p, q, block in zip(*lattice.pairs, joined, strict=True):
            product[q] -= lattice.matrix[p] @ block
        system = product.transpose(1, 0, 2).reshape(points, points)
        system.flat[:: points + 1] += 1.0
        return _LatticeFeedback(self._influence, slope, lu_factor(system, overwrite_a=True, check_finite=False))


@dataclass(frozen=True, eq=False)
class _LatticeFeedback:
    influence: _Influence
    slope: Array
    lu: tuple[Array, NDArray[np.int32]]

    def solve(self, fields: Array) -> Array:
        points = self.influence.gather(self.slope * fields) @ self.influence.matrix.T
        return fields + self.influence.spread(lu_solve(self.lu, points.T).T)

    def solve_transposed(self, field: Array) -> tuple[Array, Array]:
        back = lu_solve(self.lu, self.influence.spread_transposed(field), trans=1) @ self.influence.matrix
        on_load = self.influence.gather_transposed(back)
        return field + self.slope * on_load, on_load


@lru_cache(maxsize=4)
def _influence(disk: Disk, mu_x: float, axial: float) -> _Influence:
    azimuths = shared_azimuths(AZIMUTHS, disk.blades)
    lattice = Lattice(blades=disk.blades, root=disk.root, panels=PANELS, azimuths=azimuths)
    circulation = lattice.circulation(np.ones((PANELS, azimuths)), lattice.tangential(mu_x)).ravel()
    return _Influence(
        grids=transfer(lattice, disk.r, len(disk.psi)), matrix=lattice.downwash(mu_x, axial) * circulation
    )

"""The Peters–He dynamic wake as an inflow model: λ_i = A d with A = (1/F) C T W.

W projects the load on the states, T is the theory's periodic solution for a given wake, C gives the field (see
`wake_projection`, `peters_he`). F is Prandtl's tip factor for the infinite-blade form, 1 otherwise.
"""

from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgetrf, dgetrs

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import HarmonicShapes, InflowFeedback, ResponseTerms, Wake
from rotor.aero.inflow.peters_he import FlowParameters, flow_parameters
from rotor.aero.inflow.wake_projection import Projection, build_projection
from rotor.aero.losses import tip_factor
from rotor.arrays import Array


@dataclass(frozen=True)
class DynamicWake:
    """The order of a dynamic wake, and the number of blade harmonics."""

    blades: int = 4
    order: int = 8
    """S: all modes with n − 1 ≤ S; 8 gives 25 cosines and 20 sines."""
    harmonics: int = 2
    """k: blade harmonics with the wave numbers N_b, 2N_b, … kN_b around the azimuth.
    0 is the time average: infinitely many blades, with the effect of their number restored by λ_i/F."""
    tip: bool = True
    """Whether F is used; F = 1 otherwise."""

    def __post_init__(self) -> None:
        if self.order < 1:
            raise ValueError(f"a dynamic wake of order {self.order} has no gradient: use 1 or more")
        if self.harmonics not in (0, self.order / self.blades):
            raise ValueError(
                f"{self.harmonics} blade harmonics do not match order {self.order} with {self.blades} blades: "
                "use order/blades, or 0 for infinitely many blades"
            )

    @classmethod
    def of(cls, blades: int, order: int = 8, *, infinite_blades: bool = False, tip: bool = True) -> "DynamicWake":
        """The wake with at most `order` that satisfies the truncation rule k = S/N_b, but not below ¾ of `order`.

        The rule is empirical: with it the optimum twist at µ 0.2 is −12.5, −11.4, −11.2, −11.2° for S = 4, 8, 12, 16;
        without it −9.3° (S 8, k 1).

        Induced power does not settle with the order: it grows with each blade harmonic k, for any number of blades. The
        theory's load is normal to the disk, so it has a part along the relative wind, which leaves a sheet of slowed
        air behind the blade. The more harmonics, the thinner the sheet and the more of it at the blade: each harmonic
        adds (µ_z + λ0) d/(2 r U_T²) to the inflow, 1 to 4 % of induced power. The lift of a real blade is normal to
        its wind and leaves none. Two harmonics agree best with a vortex lattice, for three, four and five blades.
        """
        if infinite_blades:
            return cls(blades, order, 0, tip)
        harmonics = order // blades
        if harmonics * blades < 0.75 * order:
            harmonics += 1
        return cls(blades, blades * harmonics, harmonics)

    @property
    def infinite_blades(self) -> bool:
        return self.harmonics == 0

    def on(self, root: float, elements: int, azimuths: int) -> Projection:
        """Its projection on a grid (cached)."""
        return build_projection(self.order, self.blades, self.harmonics, root, elements, azimuths)

    def factor(self, projection: Projection, wake: Wake) -> tuple[Array, Array]:
        """F at a wake and its slope by µ_z + λ0, (elements,)."""
        if self.infinite_blades and self.tip:
            return tip_factor(projection.r, wake.axial, self.blades)
        return projection.no_factor

    def operator(self, projection: Projection, wake: Wake) -> "WakeOperator":
        """A(wake) on that grid."""
        return WakeOperator(projection, flow_parameters(wake), *self.factor(projection, wake))


@dataclass(frozen=True, eq=False)
class WakeOperator:
    """A for one wake on one grid. Fields are (elements, azimuths), coefficients of terms (113,) for S = 8, k = 2."""

    projection: Projection
    flow: FlowParameters
    factor: Array
    """F, (elements,)."""
    factor_slope: Array
    """∂F/∂(µ_z + λ0), (elements,)."""

    def coefficients(self, d: Array) -> Array:
        """The inflow under a load or a stack of loads in terms, (…, elements, azimuths) → (…, terms)."""
        sums = self.projection.sums(d)
        return self.projection.answer(sums, self.flow) if d.ndim == 2 else sums @ self.transfer.T

    def field(self, coefficients: Array) -> Array:
        """λ_i of coefficients of the terms over F, (…, terms) → (…, elements, azimuths)."""
        return self.over_factor(self.projection.field(coefficients))

    def over_factor(self, fields: Array) -> Array:
        """Fields over F; themselves where F = 1."""
        return fields if self._no_factor else fields / self.factor[:, None]

    @property
    def _no_factor(self) -> bool:
        return self.factor is self.projection.no_factor[0]

    def induced(self, d: Array) -> Array:
        """λ_i = A d of a load, (elements, azimuths), by the wake's equations, or of a stack of loads."""
        return self.field(self.coefficients(d))

    def induced_transposed(self, g: Array) -> Array:
        """Aᵀ g, for adjoints."""
        return self.projection.field(self.projection.sums(self.over_factor(g)) @ self.transfer)

    def coefficients_by_wake(self, d: Array) -> Array:
        """∂ of the terms' coefficients by (µ_x, µ_z, λ0) at fixed load, (3, terms)."""
        slopes = self.projection.answer_slopes(self.projection.sums(d), self.flow, self._blocks)
        return self.flow.slopes.T @ slopes

    def induced_by_wake(self, d: Array) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        out, beyond = self.field(self.coefficients_by_wake(d)), self.beyond_terms(d)
        if beyond is not None:
            out[1:] += beyond
        return out

    def beyond_terms(self, d: Array) -> Array | None:
        """The part of ∂λ_i/∂(µ_z + λ0) through F, (elements, azimuths); None where F does not follow the wake."""
        if self._no_factor:
            return None
        return self.induced(d) * (-self.factor_slope / self.factor)[:, None]

    def feedback(self, slope: Array, load: Array) -> "DynamicWakeFeedback":
        """The feedback for a pointwise slope K = ∂d/∂λ_i, negative where more inflow reduces the lift, at a load."""
        system = -(self.transfer @ self.projection.reduced(self.over_factor(slope)))
        system.ravel()[:: len(system) + 1] += 1.0
        # Of the transpose, which is what LAPACK sees in these rows without copying them.
        factors, pivots, _ = dgetrf(system.T, overwrite_a=True)
        return DynamicWakeFeedback(self, slope, load, (factors, pivots))

    @cached_property
    def transfer(self) -> Array:
        """From sums of the load with the terms to coefficients of the inflow, (terms, terms): the states eliminated."""
        return self.projection.transfer(self._blocks)

    @cached_property
    def _blocks(self) -> tuple[Array, Array]:
        return self.projection.blocks(self.flow)


@dataclass(frozen=True, eq=False)
class DynamicWakeFeedback:
    """(I − A diag K)⁻¹, exactly, through one LU of the size of the terms.

    With the sums B over the grid and A = (1/F) Bᵀ T B it is I + (Bᵀ/F) (I − T B (K/F) Bᵀ)⁻¹ T B K.
    """

    operator: WakeOperator
    slope: Array
    load: Array
    """The load at which the wake changes."""
    lu: tuple[Array, NDArray[np.int32]]
    """Factors of (I − T B (K/F) Bᵀ)ᵀ."""

    def solve_terms(self, coefficients: Array) -> Array:
        """(I − T B (K/F) Bᵀ)⁻¹ c, (terms,) or (terms, n): the feedback in terms of the coefficients."""
        return dgetrs(*self.lu, coefficients, trans=1)[0]

    def solve(self, fields: Array) -> Array:
        """λ with λ − A (K λ) = fields, for a field or a stack of fields, (…, elements, azimuths)."""
        return fields + self.operator.field(self.solve_terms(self.operator.coefficients(self.slope * fields).T).T)

    def solve_transposed(self, field: Array) -> tuple[Array, Array]:
        """v with v − K Aᵀ v = field, and Aᵀ v: the sums of v with the terms follow from those of the field."""
        operator, projection = self.operator, self.operator.projection
        back = dgetrs(*self.lu, projection.sums(operator.over_factor(field)))[0]
        on_load = projection.field(back @ operator.transfer)
        return field + self.slope * on_load, on_load

    def answer_columns(self, loads: Array, wake: Array, slope: Array, shapes: HarmonicShapes | None) -> "TermColumns":
        """As `ColumnFeedback`: the terms under every change, c = (I − T B (K/F) Bᵀ)⁻¹ (T B load + ∂c/∂wake)."""
        operator, projection = self.operator, self.operator.projection
        beyond, shares = operator.beyond_terms(self.load), wake[:, 1] + wake[:, 2]
        if beyond is not None:
            loads = loads + shares[:, None, None] * (self.slope * beyond)
        sums = projection.sums(loads).T
        if shapes is not None:
            sums = np.hstack([sums, projection.against(slope, shapes)])
        columns = operator.transfer @ sums
        columns[:, : len(wake)] += operator.coefficients_by_wake(self.load).T @ wake.T
        shares = np.concatenate([shares, np.zeros(columns.shape[1] - len(wake))])
        return TermColumns(self, self.solve_terms(columns), beyond, shares)


@dataclass(frozen=True, eq=False)
class TermColumns:
    """The inflow that answers several changes, in terms of the projection."""

    feedback: DynamicWakeFeedback
    coefficients: Array
    """(terms, columns)"""
    beyond: Array | None
    """What no term can hold, (elements, azimuths), see `WakeOperator.beyond_terms`."""
    shares: Array
    """How much of it is in each column, (columns,)."""

    def change(self, shares: Array) -> Array:
        """As `InflowColumns`."""
        return self.coefficients @ shares

    def solve(self, error: Array) -> Array:
        """As `InflowColumns`."""
        return self.feedback.solve_terms(error)

    def rows(self, fields: Array) -> Array:
        """As `InflowColumns`; what no term can hold is one more."""
        operator = self.feedback.operator
        rows = operator.projection.sums(operator.over_factor(fields))
        return rows if self.beyond is None else np.column_stack([rows, np.tensordot(fields, self.beyond, 2)])

    def projected_rows(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """As `InflowColumns`."""
        operator = self.feedback.operator
        rows = operator.projection.against(operator.over_factor(slope), shapes).T
        rows = np.tile(shapes.weights, len(shapes.radial))[:, None] * rows
        return rows if self.beyond is None else np.column_stack([rows, shapes.project(slope * self.beyond).ravel()])

    def times(self, rows: Array) -> Array:
        """As `InflowColumns`; the row of a field's sums with the terms alone will do as well."""
        terms = len(self.coefficients)
        out = rows[:, :terms] @ self.coefficients
        return out if rows.shape[1] == terms else out + rows[:, terms:] * self.shares


@dataclass(frozen=True)
class DynamicWakeInflow:
    """Peters–He with the rotor's own blade number, or with infinitely many blades."""

    name: str
    title: str
    explanation: str
    order: int
    infinite_blades: bool = False
    tip: bool = True

    load_dependent = True

    def without_tip_loss(self) -> "DynamicWakeInflow":
        """Infinitely many blades with F = 1: the tip loss of a few blades is in the harmonics of their wake."""
        return replace(self, infinite_blades=True, tip=False)

    def with_wake_geometry(self, expected: Wake) -> "DynamicWakeInflow":
        """Itself: the wake follows the trim."""
        del expected
        return self

    def respond(self, disk: Disk, wake: Wake, load: Array) -> "DynamicWakeResponse":
        """λ_i = A d."""
        model = self._wake(disk)
        return DynamicWakeResponse(model.operator(model.on(disk.root, *disk.shape), wake), load)

    def basis(self, disk: Disk) -> "TermBasis":
        """The terms of the projection over F."""
        model = self._wake(disk)
        return TermBasis(model, model.on(disk.root, *disk.shape))

    def _wake(self, disk: Disk) -> DynamicWake:
        return _of(disk.blades, self.order, self.infinite_blades, self.tip)


@dataclass(frozen=True, eq=False)
class TermBasis:
    """The terms of the projection as the coordinates of a dynamic wake's inflow, see `InflowBasis`."""

    model: DynamicWake
    projection: Projection

    @property
    def size(self) -> int:
        return self.projection.terms

    def nearest(self, field: Array, wake: Wake) -> Array:
        factor, _ = self.model.factor(self.projection, wake)
        return self.projection.nearest(factor[:, None] * field)

    def field(self, coordinates: Array, wake: Wake) -> Array:
        field, factor = self.projection.field(coordinates), self.model.factor(self.projection, wake)[0]
        return field if factor is self.projection.no_factor[0] else field / factor[:, None]

    def bound(self, change: Array) -> float:
        """Before the division by F, which only the elements next to the tip notice."""
        return self.projection.bound(change)

    def resolved_by(self, azimuths: int) -> bool:
        return azimuths > 2 * int(self.projection.wave.max())


@cache
def _of(blades: int, order: int, infinite_blades: bool, tip: bool) -> DynamicWake:
    return DynamicWake.of(blades, order, infinite_blades=infinite_blades, tip=tip)


class DynamicWakeResponse:
    """A at one wake, and the response to one load."""

    def __init__(self, operator: WakeOperator, load: Array) -> None:
        self._operator = operator
        self._load = load
        self.coordinates = operator.coefficients(load)

    @property
    def induced(self) -> Array:
        """λ_i"""
        return self._operator.field(self.coordinates)

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at this load."""
        return self._operator.induced_by_wake(self._load)

    def terms(self) -> ResponseTerms:
        """A in the terms of the projection."""
        operator, projection = self._operator, self._operator.projection
        beyond = operator.beyond_terms(self._load)
        return ResponseTerms(
            load_shapes=projection.radial_columns,
            inflow_shapes=operator.over_factor(projection.radial.T).T.copy(),
            waves=projection.all_waves,
            begin=projection.terms_by_shape[0],
            term=projection.terms_by_shape[1],
            wave=projection.terms_by_shape[2],
            transfer=operator.transfer,
            by_wake=operator.coefficients_by_wake(self._load),
            beyond=np.zeros((0, 0)) if beyond is None else beyond,
        )

    def apply(self, fields: Array) -> Array:
        """A f."""
        return self._operator.induced(fields)

    def apply_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        return self._operator.induced_transposed(field)

    def feedback(self, slope: Array) -> InflowFeedback:
        """(I − A diag K)⁻¹ through one factorisation of the size of the terms."""
        return self._operator.feedback(slope, self._load)


DYNAMIC_WAKES = (
    DynamicWakeInflow(
        "dynamic-wake",
        "Dynamic wake (Peters–He)",
        "Responds to the load distribution, with this rotor's own blades: the disk shows the inflow at the blade at ψ.",
        order=8,
    ),
    DynamicWakeInflow(
        "dynamic-wake-quick",
        "Dynamic wake, few states",
        "The same theory with fewer shapes: faster and coarser.",
        order=4,
    ),
    DynamicWakeInflow(
        "dynamic-wake-infinite-blades",
        "Dynamic wake, infinite blades",
        "The time-averaged wake of infinitely many blades with Prandtl's tip factor, to compare with real blades.",
        order=8,
        infinite_blades=True,
    ),
)

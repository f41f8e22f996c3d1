"""The interface of every forward-flight inflow model, and the wake that its answer depends on.

A model gives the inflow induced by a load on the disk. At a given wake (µ_x, µ_z, λ0) every model is linear in the
load, λ_i = A d + b, with A = 0 for the models that prescribe their inflow. The trim and its adjoint need the action of
A on fields and the solution of the feedback load → inflow → load; no model forms A.

Fields are (elements, azimuths); d = dC_T/dr of the whole rotor as if smeared; stacks of fields lead with their number.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from rotor.aero.disk import Disk
from rotor.arrays import Array, Integers


@dataclass(frozen=True)
class Wake:
    """Flow through the disk by momentum theory; all over ΩR."""

    mu_x: float
    """Advance ratio in the disk plane, µ cos α."""
    mu_z: float
    """Advance ratio through the disk, µ sin α, positive down."""
    lambda0: float
    """Mean induced inflow of momentum theory."""

    @property
    def axial(self) -> float:
        return self.mu_z + self.lambda0

    @property
    def speed(self) -> float:
        return math.hypot(self.mu_x, self.axial)


class InflowBasis(Protocol):
    """The functions of which the inflow of a model is a sum, on one grid; their coefficients are its coordinates."""

    @property
    def size(self) -> int:
        """Number of coordinates."""
        ...

    def nearest(self, field: Array, wake: Wake) -> Array:
        """Coordinates of the sum that is nearest to a field at a wake, (elements, azimuths) → (coordinates,)."""
        ...

    def field(self, coordinates: Array, wake: Wake) -> Array:
        """λ_i at a wake, (coordinates,) → (elements, azimuths)."""
        ...

    def bound(self, change: Array) -> float:
        """What |∂λ_i| does not exceed anywhere for a change of the coordinates."""
        ...

    def resolved_by(self, azimuths: int) -> bool:
        """Whether the same coordinates mean the same inflow on a grid with this number of azimuths."""
        ...


@dataclass(frozen=True)
class FieldBasis:
    """The coordinates of any field: its values on the grid."""

    shape: tuple[int, int]
    """(elements, azimuths)"""

    @property
    def size(self) -> int:
        return self.shape[0] * self.shape[1]

    def nearest(self, field: Array, wake: Wake) -> Array:
        del wake
        return field.ravel()

    def field(self, coordinates: Array, wake: Wake) -> Array:
        del wake
        return coordinates.reshape(self.shape)

    def bound(self, change: Array) -> float:
        return float(np.abs(change).max())

    def resolved_by(self, azimuths: int) -> bool:
        return azimuths == self.shape[1]


class AnyField:
    """Part of a model whose inflow may be any field."""

    def basis(self, disk: Disk) -> InflowBasis:
        """As `InflowModel`."""
        return FieldBasis(disk.shape)


class InflowFeedback(Protocol):
    """The feedback inflow → load → inflow for a pointwise load slope K = ∂d/∂λ_i."""

    def solve(self, fields: Array) -> Array:
        """z with z − A K z = fields, for a stack of fields."""
        ...

    def solve_transposed(self, field: Array) -> tuple[Array, Array]:
        """v with v − K Aᵀ v = field, and Aᵀ v."""
        ...


@dataclass(frozen=True, eq=False)
class HarmonicShapes:
    """Fields Φ_k(r) cos hψ and Φ_k(r) sin hψ: every shape along the blade with every harmonic around the disk.

    Columns are ordered by shape, then by harmonic: 1, cos ψ, sin ψ, cos 2ψ, …
    """

    radial: Array
    """Φ_k, (shapes, elements)."""
    waves: Array
    """(functions, azimuths), functions = 1 + 2·highest."""
    rates: Array
    """Their derivatives by ψ."""
    wave: Integers
    """h of each function, (functions,)."""
    parity: Integers
    """0 for a cosine, 1 for a sine, (functions,)."""
    dr: float

    @classmethod
    def on(cls, disk: Disk, radial: Array, highest: int) -> "HarmonicShapes":
        """The harmonics 0 … `highest` with shapes given at the elements."""
        wave = np.array([0] + [h for h in range(1, highest + 1) for _ in (0, 1)], dtype=np.int64)
        parity = np.array([0] + [0, 1] * highest, dtype=np.int64)
        phase = np.outer(wave, disk.psi)
        waves = np.where(parity[:, None] == 0, np.cos(phase), np.sin(phase))
        rates: Array = wave[:, None] * np.where(parity[:, None] == 0, -np.sin(phase), np.cos(phase)).astype(np.float64)
        return cls(radial, waves, rates, wave, parity, disk.dr)

    @property
    def columns(self) -> int:
        return len(self.radial) * len(self.waves)

    @cached_property
    def scale(self) -> Array:
        """Factors that turn a mean with a function into the amplitude of its harmonic: 1, 2, 2, …, (functions,)."""
        return np.where(self.wave == 0, 1.0, 2.0)

    def field(self, coordinates: Array) -> Array:
        """Σ q Φ_k H_h of coordinates (shapes, functions), (elements, azimuths)."""
        return self.radial.T @ (coordinates @ self.waves)

    def rate(self, coordinates: Array) -> Array:
        """The derivative of `field` by ψ."""
        return self.radial.T @ (coordinates @ self.rates)

    def gather(self, fields: Array) -> Array:
        """Σ over the grid of a field times every column, (…, elements, azimuths) → (…, shapes, functions)."""
        return self.radial @ fields @ self.waves.T

    def harmonics(self, around: Array) -> Array:
        """Fourier amplitudes of functions of azimuth, (…, azimuths) → (…, functions)."""
        return around @ self.waves.T * (self.scale / self.waves.shape[1])

    @property
    def weights(self) -> Array:
        """Factors that turn a sum over the grid into an integral along r and a harmonic, (functions,)."""
        return self.scale * (self.dr / self.waves.shape[1])

    def project(self, fields: Array) -> Array:
        """Harmonics of ∫ Φ_k f dr, (…, elements, azimuths) → (…, shapes, functions)."""
        return self.analyse(self.radial @ fields)

    def analyse(self, along: Array) -> Array:
        """Harmonics of such sums along the blade, (…, shapes, azimuths) → (…, shapes, functions)."""
        return along @ self._analysis

    @cached_property
    def _analysis(self) -> Array:
        return self.waves.T * self.weights

    def times(self, field: Array) -> Array:
        """Every column times a field, (columns, elements, azimuths)."""
        columns = self.radial[:, None, :, None] * self.waves[None, :, None, :] * field
        return columns.reshape(-1, *field.shape)


class InflowColumns(Protocol):
    """The inflow that answers a unit of each of several changes, the feedback through the load included.

    It is given by the coordinates of the model: sums over the grid of a field times λ_i are products with a row.
    """

    def change(self, shares: Array) -> Array:
        """Coordinates of a combination of the columns, (columns,) → (coordinates,)."""
        ...

    def solve(self, error: Array) -> Array:
        """z with z − A K z = error, all in coordinates, (coordinates,)."""
        ...

    def rows(self, fields: Array) -> Array:
        """Fields as rows: Σ over the grid of a field times λ_i, (n, elements, azimuths) → (n, coordinates)."""
        ...

    def projected_rows(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """`HarmonicShapes.project` of slope · λ_i, (shapes × functions, coordinates)."""
        ...

    def times(self, rows: Array) -> Array:
        """Rows times every column, (n, coordinates) → (n, columns)."""
        ...


@runtime_checkable
class ColumnFeedback(Protocol):
    """A feedback that answers many changes at once, without a field for each."""

    def answer_columns(self, loads: Array, wake: Array, slope: Array, shapes: HarmonicShapes | None) -> InflowColumns:
        """λ with λ − A (K λ) = A load + ∂λ/∂wake · change of the wake, for every change.

        The first changes have the loads given, (changes, elements, azimuths), and change (µ_x, µ_z, λ0) by `wake`,
        (changes, 3). Those of every column of `shapes` follow, with the load slope · column.
        """
        ...


@dataclass(frozen=True, eq=False)
class FieldColumns:
    """The answer of any inflow model, as a field for every column."""

    fields: Array
    """(columns, elements, azimuths)"""
    feedback: InflowFeedback

    @classmethod
    def of(
        cls,
        response: "InflowResponse",
        feedback: InflowFeedback,
        loads: Array,
        wake: Array,
        slope: Array,
        shapes: HarmonicShapes | None,
    ) -> "FieldColumns":
        """As `ColumnFeedback.answer_columns`."""
        fields = response.apply(loads) + np.tensordot(wake, response.by_wake, 1)
        if shapes is not None:
            fields = np.concatenate([fields, response.apply(shapes.times(slope))])
        return cls(feedback.solve(fields), feedback)

    def change(self, shares: Array) -> Array:
        return shares @ self.fields.reshape(len(self.fields), -1)

    def solve(self, error: Array) -> Array:
        return self.feedback.solve(error.reshape(1, *self.fields.shape[1:])).ravel()

    def rows(self, fields: Array) -> Array:
        return fields.reshape(len(fields), -1)

    def projected_rows(self, slope: Array, shapes: HarmonicShapes) -> Array:
        return (np.tile(shapes.weights, len(shapes.radial))[:, None, None] * shapes.times(slope)).reshape(
            shapes.columns, -1
        )

    def times(self, rows: Array) -> Array:
        return rows @ self.fields.reshape(len(self.fields), -1).T


class ResponseTerms(NamedTuple):
    """A response in terms, functions along the blade times waves around the disk: A = (1/F) Bᵀ T B with the sums B.

    Arrays in the order of rows, for compiled code.
    """

    load_shapes: Array
    """Functions along the blade, (elements, shapes)."""
    inflow_shapes: Array
    """The same over F, (shapes, elements)."""
    waves: Array
    """(waves, azimuths)"""
    begin: Integers
    """Where the terms of one shape begin in the next two, (shapes + 1,)."""
    term: Integers
    """The terms of every shape, four or a multiple; the number of terms stands where there is none."""
    wave: Integers
    """The wave of each."""
    transfer: Array
    """T, (terms, terms)."""
    by_wake: Array
    """∂λ_i by (µ_x, µ_z, λ0) at fixed load in terms, (3, terms)."""
    beyond: Array
    """The part of ∂λ_i by µ_z and by λ0 that no term can hold, (elements, azimuths), or (0, 0) where there is none."""


@runtime_checkable
class TermResponse(Protocol):
    """A response that has terms."""

    def terms(self) -> ResponseTerms | None:
        """None where the model inside has none."""
        ...


class InflowResponse(Protocol):
    """The response of a model to one load at one wake."""

    @property
    def induced(self) -> Array:
        """λ_i"""
        ...

    @property
    def coordinates(self) -> Array:
        """The same in the coordinates of the model's basis."""
        ...

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        ...

    def apply(self, fields: Array) -> Array:
        """A f: the inflow induced by a change of load f, for a stack of fields."""
        ...

    def apply_transposed(self, field: Array) -> Array:
        """Aᵀ f."""
        ...

    def feedback(self, slope: Array) -> InflowFeedback:
        """The feedback for K, (elements, azimuths)."""
        ...


class InflowModel(Protocol):
    """A forward-flight inflow model."""

    @property
    def name(self) -> str:
        """As on the command line."""
        ...

    @property
    def title(self) -> str:
        """As on the page."""
        ...

    @property
    def explanation(self) -> str:
        """One line for the page: what the model is, and its source."""
        ...

    @property
    def load_dependent(self) -> bool:
        """Whether the inflow responds to the load distribution (A ≠ 0).

        With a model that does not, Prandtl's factor multiplies the section lift; one that does has tip losses of its
        own.
        """
        ...

    def without_tip_loss(self) -> "InflowModel":
        """The model without tip loss; the model itself where tip loss is on the section lift or cannot be removed."""
        ...

    def with_wake_geometry(self, expected: Wake) -> "InflowModel":
        """The model with its wake geometry fixed as momentum theory expects; itself where the wake follows the trim."""
        ...

    def respond(self, disk: Disk, wake: Wake, load: Array) -> InflowResponse:
        """The response at a wake to a load d(r, ψ), which a model that is not load-dependent ignores."""
        ...

    def basis(self, disk: Disk) -> InflowBasis:
        """The functions of which the inflow is a sum."""
        ...

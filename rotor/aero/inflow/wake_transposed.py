"""The wake's answer transposed, for adjoints: Tᵀ w without the transfer matrix, from factors made once for a wake."""

from typing import Any, NamedTuple

import numpy as np

from rotor.aero.inflow.peters_he import (
    FlowParameters,
    TransposedAnswer,
    answer_transposed,
    influences,
    powers_of_skew,
    transpose_answer,
)
from rotor.aero.inflow.wake_projection import Projection, add_family, loads_on_family
from rotor.arrays import Array, Integers
from rotor.compiled import compiled

_compile = compiled(error_model="numpy", fastmath={"contract"})


class TransposedWake(NamedTuple):
    """The wake's answer transposed, at one load."""

    cosines: TransposedAnswer
    sines: TransposedAnswer
    m: Integers
    order: Integers
    steady: int
    harmonics: Array
    table: Integers
    cell: float
    slopes: Array
    """Those of X, V_T and V̄, see `peters_he.FlowParameters`."""
    terms: int


def no_wake() -> TransposedWake:
    """One without terms, for models that have none."""
    plane, line, places = np.zeros((0, 0)), np.zeros(0), np.zeros(0, dtype=np.int64)
    stack = np.zeros((0, 0, 0))
    family = TransposedAnswer(plane, plane, stack, places.reshape(0, 0), plane, (0.0, 0.0, 0.0), stack)
    return TransposedWake(family, family, places, places, 0, line, places.reshape(0, 0, 0), 0.0, np.zeros((3, 3)), 0)


def transposed_wake(projection: Projection, sums: Array, flow: FlowParameters) -> TransposedWake:
    """What `transposed` needs, at the sums of a load with the terms."""
    basis, parameters = projection.basis, (flow.half_skew, flow.speed, flow.mass_flow)
    families = _transpose(
        sums, parameters, basis.gain, basis.driven, basis.uniform, basis.m, basis.order, basis.steady,
        projection.harmonics, projection.table, projection.cell,
    )  # fmt: skip
    cosines, sines = (
        TransposedAnswer(influence, scaled, factors, pivots, uniform, parameters, by_flow)
        for (influence, scaled, factors, pivots, by_flow), uniform in zip(families, projection.uniform, strict=True)
    )
    return TransposedWake(
        cosines, sines, basis.m, basis.order, basis.steady, projection.harmonics, projection.table, projection.cell,
        flow.slopes, len(projection.order),
    )  # fmt: skip


@_compile
def _transpose(
    sums: Any, flow: Any, gain: Any, driven: Any, uniform: Any, m: Any, order: Any, steady: int, harmonics: Any,
    table: Any, cell: float,
) -> Any:  # fmt: skip
    """What `TransposedAnswer` holds of both families, as far as it depends on the flow."""
    powers = powers_of_skew(flow[0], 2 * m[-1])
    influence = influences(gain, driven, m, 1.0, powers[0])
    slopes = influences(gain, driven, m, 1.0, powers[1])
    loads = loads_on_family(sums, 1.0, m, order, harmonics, table, cell)
    cosines = transpose_answer(influence[0], influence[1], slopes, flow, uniform, harmonics, loads)
    part, k = m[steady:], order[steady:]
    own = influences(gain[steady:, steady:], driven[steady:, steady:], part, -1.0, powers[0])
    slopes = influences(gain[steady:, steady:], driven[steady:, steady:], part, -1.0, powers[1])
    loads = loads_on_family(sums, -1.0, part, k, harmonics, table, cell)
    sines = transpose_answer(own[0], own[1], slopes, flow, uniform[:, steady:].copy(), harmonics, loads)
    return (influence[0].copy(), *cosines), (own[0].copy(), *sines)


@_compile
def transposed(wake: Any, weights: Any) -> Any:
    """Tᵀ w, (terms,), and wᵀ times the slopes of the coefficients by (µ_x, µ_z, λ0).

    The amplitudes are added to terms as loads are taken from sums, but for the factors.
    """
    out, by_flow = np.zeros(len(weights)), np.zeros(3)
    for first, sign, made in ((0, 1.0, wake.cosines), (wake.steady, -1.0, wake.sines)):
        m, order = wake.m[first:], wake.order[first:]
        given = loads_on_family(weights, sign, m, order, wake.harmonics, wake.table, wake.cell).T.copy()
        factors = np.empty(given.shape)
        for c in range(len(factors)):
            for i in range(len(m)):
                factors[c, i] = wake.cell * (0.5 if m[i] == 0 else 1.0) * (0.5 if c > 0 else 1.0)
                given[c, i] /= factors[c, i]
        found, own = answer_transposed(made, wake.harmonics, given)
        by_flow += own
        found *= factors
        add_family(out, found.T.copy(), sign, m, order, wake.harmonics, wake.table)
    return out, wake.slopes.T @ by_flow

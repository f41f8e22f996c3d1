"""The Peters–He dynamic wake as an inflow model: λ_i = A d with A = (1/F) C T W.

W projects the load on the states, T is the theory's periodic solution for a given wake, C gives the field (see
`wake_projection`, `peters_he`). F is Prandtl's tip factor for the infinite-blade form, 1 otherwise.
"""

from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgetrf, dgetrs

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import HarmonicShapes, InflowFeedback, Wake
from rotor.aero.inflow.peters_he import FlowParameters, families, flow_parameters
from rotor.aero.inflow.wake_projection import Projection, build_projection
from rotor.aero.losses import tip_factor
from rotor.arrays import Array
from rotor.compiled import compiled


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

    def operator(self, projection: Projection, wake: Wake) -> "WakeOperator":
        """A(wake) on that grid."""
        flow = flow_parameters(wake)
        responses = tuple(_FamilyResponse.solve(self, which, flow, projection.harmonics) for which in (0, 1))
        r = projection.r
        if self.infinite_blades and self.tip:
            factor, slope = tip_factor(r, wake.axial, self.blades)
        else:
            factor, slope = projection.no_factor
        return WakeOperator(projection, flow, responses, factor, slope)


@dataclass(frozen=True, eq=False)
class _FamilyResponse:
    """T of the cosines or of the sines. States of a family are (rotor harmonics 1 + 2k, modes).

    a = ½ L (V + iqM L)⁻¹ τ for the amplitudes a = x_c − i x_s of a load τ = p_c − i p_s with cos qψ and sin qψ. [L]⁻¹,
    singular for edgewise flight, is never formed.
    """

    influence: Array
    """L"""
    influence_slope: Array
    """∂L/∂X"""
    flow: Array
    """Diagonal of V."""
    uniform: Array
    mass: Array
    """Diagonal of M."""
    harmonics: Array
    """q"""

    @classmethod
    def solve(
        cls, model: DynamicWake, which: int, flow: FlowParameters, harmonics: tuple[int, ...]
    ) -> "_FamilyResponse":
        """At these parameters of the flow."""
        family = families(model.order)[which]
        influence, slope = family.influence(flow.half_skew)
        diagonal = flow.mass_flow + (flow.speed - flow.mass_flow) * family.uniform
        return cls(influence, slope, diagonal, family.uniform, family.mass, _numbers(harmonics))

    def respond(self, p: Array) -> Array:
        """T p of one load, (states of the family,)."""
        loads = p.reshape(1 + 2 * len(self.harmonics), -1)
        return _respond(self.influence, self.flow, self.mass, self.harmonics, loads).ravel()

    @cached_property
    def blocks(self) -> Array:
        """½ L (V + iqM L)⁻¹ for q = 0 and every harmonic, complex, (1 + k, modes, modes)."""
        return _blocks(self.influence, self.flow, self.mass, self.harmonics)

    def slopes(self, p: Array) -> Array:
        """∂(T p) by X, V_T and V̄, (3, states of the family)."""
        loads = p.reshape(1 + 2 * len(self.harmonics), -1)
        out = _slopes(
            self.blocks, self.influence_slope, self.flow, self.uniform, self.mass, self.harmonics, loads
        )  # fmt: skip
        return out.reshape(3, -1)


@cache
def _numbers(harmonics: tuple[int, ...]) -> Array:
    return np.array(harmonics, dtype=np.float64)


_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def _respond(influence: Any, flow: Any, mass: Any, harmonics: Any, loads: Any) -> Any:
    """T p, steady, then cosine and sine of every q: a = ½ L (V + iqM L)⁻¹ τ with a = x_c − i x_s, τ = p_c − i p_s.

    As in `_blocks`, a = ½ L (z − iq B z) with (I + q²B²) z = V⁻¹ τ, so only real equations are solved.
    """
    out = np.empty_like(loads)
    modes = len(flow)
    out[0] = 0.5 * _times(influence, loads[0] / flow)
    scaled = _scaled(influence, flow, mass)
    square = scaled @ scaled
    system = np.empty((modes, modes + 2))
    for k in range(len(harmonics)):
        q, cosine, sine = harmonics[k], 1 + 2 * k, 2 + 2 * k
        for i in range(modes):
            for j in range(modes):
                system[i, j] = q * q * square[i, j]
            system[i, i] += 1.0
            system[i, modes], system[i, modes + 1] = loads[cosine, i] / flow[i], loads[sine, i] / flow[i]
        _eliminate(system)
        real, imaginary = system[:, modes].copy(), system[:, modes + 1].copy()  # z is real − i imaginary.
        out[cosine] = 0.5 * _times(influence, real - q * _times(scaled, imaginary))
        out[sine] = 0.5 * _times(influence, imaginary + q * _times(scaled, real))
    return out


@_compile
def _scaled(influence: Any, flow: Any, mass: Any) -> Any:
    """B = V⁻¹M L."""
    out = np.empty_like(influence)
    for i in range(len(flow)):
        for j in range(len(flow)):
            out[i, j] = mass[i] / flow[i] * influence[i, j]
    return out


@_compile
def _eliminate(system: Any) -> None:
    """Solve equations with their right sides beside them, (n, n + columns), in place: Gaussian elimination.

    Rows are exchanged for the largest pivot. LAPACK takes twice as long for few right sides of 25 unknowns.
    """
    n = len(system)
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(system[i, k]) > abs(system[best, k]):
                best = i
        if best != k:
            for j in range(k, system.shape[1]):
                system[k, j], system[best, j] = system[best, j], system[k, j]
        pivot = 1.0 / system[k, k]
        for i in range(k + 1, n):
            factor = system[i, k] * pivot
            for j in range(k + 1, system.shape[1]):
                system[i, j] -= factor * system[k, j]
    for k in range(n - 1, -1, -1):
        for j in range(n, system.shape[1]):
            total = system[k, j]
            for i in range(k + 1, n):
                total -= system[k, i] * system[i, j]
            system[k, j] = total / system[k, k]


@_compile
def _blocks(influence: Any, flow: Any, mass: Any, harmonics: Any) -> Any:
    """`_FamilyResponse.blocks`: ½ (L − iq L B)(I + q²B²)⁻¹V⁻¹ with B = V⁻¹M L, without complex arithmetic."""
    modes, scaled = len(flow), _scaled(influence, flow, mass)
    out = np.empty((1 + len(harmonics), modes, modes), np.complex128)
    for i in range(modes):
        for j in range(modes):
            out[0, i, j] = 0.5 * influence[i, j] / flow[j]
    square, turned = scaled @ scaled, influence @ scaled
    for k in range(len(harmonics)):
        q = harmonics[k]
        inverse = _inverse_beside_one(q * q * square)
        real, imaginary = influence @ inverse, turned @ inverse
        for i in range(modes):
            for j in range(modes):
                out[1 + k, i, j] = complex(0.5 * real[i, j] / flow[j], -0.5 * q * imaginary[i, j] / flow[j])
    return out


@_compile
def _inverse_beside_one(matrix: Any) -> Any:
    """(I + A)⁻¹ by Gauss and Jordan's elimination in place, rows exchanged for the largest pivot."""
    n = len(matrix)
    a, place = matrix.copy(), np.arange(n)
    for k in range(n):
        a[k, k] += 1.0
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i, k]) > abs(a[best, k]):
                best = i
        if best != k:
            place[k], place[best] = place[best], place[k]
            for j in range(n):
                a[k, j], a[best, j] = a[best, j], a[k, j]
        pivot = 1.0 / a[k, k]
        a[k, k] = 1.0
        for j in range(n):
            a[k, j] *= pivot
        for i in range(n):
            if i != k:
                factor = a[i, k]
                a[i, k] = 0.0
                for j in range(n):
                    a[i, j] -= factor * a[k, j]
    out = np.empty((n, n))
    for k in range(n):
        for i in range(n):
            out[i, place[k]] = a[i, k]
    return out


@_compile
def _slopes(
    blocks: Any, influence_slope: Any, flow: Any, uniform: Any, mass: Any, harmonics: Any, loads: Any
) -> Any:  # fmt: skip
    """∂(T p) by X, V_T and V̄, (3, 1 + 2k, modes).

    With a = H τ = L y and (V + iqM L) y = ½ τ:  da = dL y − 2H (dV y + iqM dL y).
    """
    modes = len(flow)
    out = np.empty((3, *loads.shape))
    load, pushed = np.zeros(modes, np.complex128), np.empty((3, modes), np.complex128)
    driven, turned = np.empty(modes, np.complex128), np.zeros(modes, np.complex128)
    for k in range(len(blocks)):
        q = harmonics[k - 1] if k else 0.0
        cosine, sine = max(2 * k - 1, 0), 2 * k
        for i in range(modes):
            load[i] = complex(loads[cosine, i], -loads[sine, i] if k else 0.0)
        answer = _times(blocks[k], load)
        for i in range(modes):
            driven[i] = (0.5 * load[i] - 1j * q * mass[i] * answer[i]) / flow[i]
        turned = _times(influence_slope, driven)
        for i in range(modes):
            pushed[0, i] = 1j * q * mass[i] * turned[i]
            pushed[1, i] = uniform[i] * driven[i]
            pushed[2, i] = (1.0 - uniform[i]) * driven[i]
        for row in range(3):
            change = -2.0 * _times(blocks[k], pushed[row])
            if row == 0:
                change += turned
            for i in range(modes):
                out[row, sine, i] = -change[i].imag
                out[row, cosine, i] = change[i].real
    return out


@compiled(error_model="numpy", fastmath={"contract", "reassoc"})
def _times(matrix: Any, vector: Any) -> Any:
    """Matrix times vector; sums in any order, so that they become vector code."""
    out = np.empty_like(vector)
    for i in range(len(out)):
        total = 0.0 * vector[0]
        for j in range(len(vector)):
            total += matrix[i, j] * vector[j]
        out[i] = total
    return out


@dataclass(frozen=True, eq=False)
class WakeOperator:
    """A for one wake on one grid. Fields are (elements, azimuths), states (225,) and terms (113,) for S = 8, k = 2."""

    projection: Projection
    flow: FlowParameters
    families: tuple[_FamilyResponse, ...]
    factor: Array
    """F, (elements,)."""
    factor_slope: Array
    """∂F/∂(µ_z + λ0), (elements,)."""

    def states(self, d: Array) -> Array:
        """x = T W d: the wake's states under a load, (states,)."""
        p = self.projection.state_loads(self.projection.sums(d))
        split = self._split
        cosines, sines = self.families
        return np.concatenate([cosines.respond(p[:split]), sines.respond(p[split:])])

    def coefficients(self, d: Array) -> Array:
        """The inflow under a stack of loads in terms, (…, elements, azimuths) → (…, terms)."""
        return self.projection.sums(d) @ self.transfer.T

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
        if d.ndim > 2:
            return self.field(self.coefficients(d))
        return self.field(self.projection.coefficients(self.states(d)))

    def induced_transposed(self, g: Array) -> Array:
        """Aᵀ g, for adjoints."""
        return self.projection.field(self.projection.sums(self.over_factor(g)) @ self.transfer)

    def coefficients_by_wake(self, d: Array) -> Array:
        """∂ of the terms' coefficients by (µ_x, µ_z, λ0) at fixed load, (3, terms)."""
        p = self.projection.state_loads(self.projection.sums(d))
        split = self._split
        parts = [family.slopes(part) for family, part in zip(self.families, (p[:split], p[split:]), strict=True)]
        return self.flow.slopes.T @ self.projection.coefficients(np.concatenate(parts, axis=1))

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
        """From sums of the load with the terms to coefficients of the inflow, (terms, terms): the states eliminated.

        With u± = a ∓ i b of the amplitudes a, b of cosines and sines of one m, a state's field is the real part of
        ½ Σ u± exp i(q ± m)ψ, and its load is made of the sums with exp −i(q ± m)ψ. So what leads from the one to the
        other is half of the cosines' matrix plus or minus the sines'.
        """
        projection, (cosines, sines) = self.projection, self.families
        return projection.cell * _between_terms(
            cosines.blocks, sines.blocks, projection.block_expansion, projection.mode_blocks, projection.mode_order,
            projection.mode_place, np.array((0, *projection.harmonics)), projection.term_table, projection.terms,
        )  # fmt: skip

    @property
    def _split(self) -> int:
        return len(self.projection.modes) * (1 + 2 * len(self.projection.harmonics))


@_compile
def _between_terms(
    cosines: Any, sines: Any, expansion: Any, blocks: Any, m: Any, order: Any, harmonics: Any, table: Any, terms: int
) -> Any:
    """`WakeOperator.transfer` without the cell: blocks between g_k with m, added at the terms of both sides."""
    out = np.zeros((terms, terms))
    modes, steady = len(m), len(m) - sines.shape[1]
    sine_expansion, sine_blocks = expansion[steady:, steady:], blocks[steady:] - steady
    rows, turns = np.empty((2, modes, 2), np.int64), np.empty((2, modes))
    for h in range(len(harmonics)):
        even = _expanded(cosines[h], expansion, blocks)
        odd = _expanded(sines[h], sine_expansion, sine_blocks)
        weight = 0.5 if h else 0.25
        for side in range(2):
            for i in range(modes):
                wave = harmonics[h] + (m[i] if side == 0 else -m[i])
                turns[side, i] = np.sign(wave)
                rows[side, i] = table[order[i], abs(wave)]
        for i in range(modes):
            for j in range(modes):
                half = weight * (0.5 if m[j] == 0 else 1.0)
                mean, difference = half * even[i, j], 0.0j
                if i >= steady and j >= steady:
                    difference = half * odd[i - steady, j - steady]
                same, opposite = mean + difference, mean - difference
                for side in range(2):
                    row, sine_row, turn = rows[side, i, 0], rows[side, i, 1], turns[side, i]
                    for other in range(2):
                        column, sine_column, back = rows[other, j, 0], rows[other, j, 1], turns[other, j]
                        value = same if side == other else opposite
                        out[row, column] += value.real
                        out[sine_row, sine_column] += turn * back * value.real
                        if h:
                            out[row, sine_column] += back * value.imag
                            out[sine_row, column] -= turn * value.imag
    return out


@_compile
def _expanded(block: Any, expansion: Any, blocks: Any) -> Any:
    """Eᵀ H E with the blocks along the diagonal of E."""
    n = len(block)
    half, out = np.zeros_like(block), np.zeros_like(block)
    for i in range(n):
        for k in range(blocks[i, 0], blocks[i, 1]):
            for j in range(n):
                half[i, j] += expansion[k, i] * block[k, j]
    for i in range(n):
        for k in range(n):
            for j in range(blocks[k, 0], blocks[k, 1]):
                out[i, j] += half[i, k] * expansion[k, j]
    return out


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
        return TermColumns(operator, self.solve_terms(columns), beyond, shares)


@dataclass(frozen=True, eq=False)
class TermColumns:
    """The inflow that answers several changes, in terms of the projection."""

    operator: WakeOperator
    coefficients: Array
    """(terms, columns)"""
    beyond: Array | None
    """What no term can hold, (elements, azimuths), see `WakeOperator.beyond_terms`."""
    shares: Array
    """How much of it is in each column, (columns,)."""

    def field(self, coefficients: Array) -> Array:
        """As `InflowColumns`."""
        out = self.operator.field(self.coefficients @ coefficients)
        return out if self.beyond is None else out + float(self.shares @ coefficients) * self.beyond

    def integrate(self, fields: Array) -> Array:
        """As `InflowColumns`."""
        out = self.operator.projection.sums(self.operator.over_factor(fields)) @ self.coefficients
        return out if self.beyond is None else out + np.outer(np.tensordot(fields, self.beyond, 2), self.shares)

    def project(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """As `InflowColumns`."""
        projection = self.operator.projection
        rows = projection.against(self.operator.over_factor(slope), shapes)
        scale = np.tile(shapes.scale, len(shapes.radial)) * projection.cell
        out = scale[:, None] * (rows.T @ self.coefficients)
        return out if self.beyond is None else out + np.outer(shapes.project(slope * self.beyond), self.shares)


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
        model = DynamicWake.of(disk.blades, self.order, infinite_blades=self.infinite_blades, tip=self.tip)
        elements, azimuths = disk.shape
        projection = model.on(disk.root, elements, azimuths)
        return DynamicWakeResponse(model.operator(projection, wake), load)


class DynamicWakeResponse:
    """A at one wake, and the response to one load."""

    def __init__(self, operator: WakeOperator, load: Array) -> None:
        self._operator = operator
        self._load = load
        self.induced = operator.induced(load)

    @property
    def by_wake(self) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at this load."""
        return self._operator.induced_by_wake(self._load)

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

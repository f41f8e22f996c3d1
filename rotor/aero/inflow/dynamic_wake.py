"""The Peters–He dynamic wake as an inflow model: λ_i = A d with A = (1/F) C T W.

W projects the load on the states, T is the theory's periodic solution for a given wake, C gives the field (see
`wake_projection`, `peters_he`). F is Prandtl's tip factor for the infinite-blade form, 1 otherwise.
"""

from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

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
            factor, slope = np.ones_like(r), np.zeros_like(r)
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
    rate: Array
    """±qM: d/dψ of a pair of cosine and sine amplitudes times M, (1 + 2k, modes)."""
    swap: NDArray[np.int64]
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
        diagonal = np.where(family.uniform > 0.0, flow.speed, flow.mass_flow)
        waves, swap = _pairing(harmonics)
        rate = waves[:, None] * family.mass
        return cls(influence, slope, diagonal, family.uniform, rate, swap, family.mass, waves[1::2])

    def respond(self, p: Array) -> Array:
        """T p of one load, (states of the family,)."""
        return _respond(self.influence, self.flow, self.mass, self.harmonics, p.reshape(self.rate.shape)).ravel()

    @cached_property
    def blocks(self) -> tuple[Array, ...]:
        """T: steady (modes, modes), then for each q cosine and sine together, (2 modes, 2 modes)."""
        pairs = [_pair_block(self.influence, self.flow, self.mass, q) for q in self.harmonics.tolist()]
        return 0.5 * self.influence / self.flow, *pairs

    def apply(self, p: Array, *, transposed: bool = False) -> Array:
        """T p or Tᵀ p along the first axis, (states of the family, …)."""
        out = np.empty_like(p)
        start = 0
        for block in self.blocks:
            stop = start + len(block)
            out[start:stop] = (block.T if transposed else block) @ p[start:stop]
            start = stop
        return out

    def slopes(self, p: Array) -> Array:
        """∂(T p) by X, V_T and V̄, (3, states of the family).

        With x = T p = L y and (V + iqML) y = ½ p:  dx = dL y − 2T (dV y + iqM dL y).
        """
        shape = self.rate.shape
        x = self.apply(p).reshape(shape)
        y = (0.5 * p.reshape(shape) - self.rate * x[self.swap]) / self.flow
        turned = y @ self.influence_slope.T
        pushed = np.stack([self.rate * turned[self.swap], y * self.uniform, y * (1.0 - self.uniform)])
        out = -2.0 * self.apply(np.ascontiguousarray(pushed.reshape(3, -1).T)).T
        out[0] += turned.ravel()
        return out


_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def _system(influence: Any, flow: Any, mass: Any, q: float, transposed: bool, columns: int) -> Any:
    """V + iqM L or its transpose with room for right sides, (2, modes, modes + columns): real, imaginary part."""
    modes = len(flow)
    out = np.zeros((2, modes, modes + columns))
    for i in range(modes):
        out[0, i, i] = flow[i]
        for j in range(modes):
            row, column = (j, i) if transposed else (i, j)
            out[1, row, column] = q * mass[i] * influence[i, j]
    return out


@_compile
def _respond(influence: Any, flow: Any, mass: Any, harmonics: Any, loads: Any) -> Any:
    """T p, steady, then cosine and sine of every q: a = ½ L (V + iqM L)⁻¹ τ with a = x_c − i x_s, τ = p_c − i p_s."""
    out = np.zeros_like(loads)
    modes = len(flow)
    for i in range(modes):
        for j in range(modes):
            out[0, i] += 0.5 * influence[i, j] * loads[0, j] / flow[j]
    for k in range(len(harmonics)):
        cosine, sine = 1 + 2 * k, 2 + 2 * k
        system = _system(influence, flow, mass, harmonics[k], False, 1)
        for i in range(modes):
            system[0, i, modes], system[1, i, modes] = loads[cosine, i], -loads[sine, i]
        _eliminate(system[0], system[1])
        for i in range(modes):
            for j in range(modes):
                out[cosine, i] += 0.5 * influence[i, j] * system[0, j, modes]
                out[sine, i] -= 0.5 * influence[i, j] * system[1, j, modes]
    return out


@_compile
def _pair_block(influence: Any, flow: Any, mass: Any, q: float) -> Any:
    """T of cosine and sine of one q, (2 modes, 2 modes): with ½ L (V + iqM L)⁻¹ = R + iI it is [[R, I], [−I, R]]."""
    modes = len(flow)
    system = _system(influence, flow, mass, q, True, modes)
    for i in range(modes):
        for j in range(modes):
            system[0, j, modes + i] = 0.5 * influence[i, j]
    _eliminate(system[0], system[1])
    out = np.empty((2 * modes, 2 * modes))
    for i in range(modes):
        for j in range(modes):
            out[i, j] = out[modes + i, modes + j] = system[0, j, modes + i]
            out[i, modes + j] = system[1, j, modes + i]
            out[modes + i, j] = -system[1, j, modes + i]
    return out


@_compile
def _eliminate(real: Any, imaginary: Any) -> None:
    """Solve a complex system with its right sides beside it, (n, n + columns), in place: Gaussian elimination.

    Rows are exchanged for the largest pivot. LAPACK takes twice as long for one right side of 25 unknowns. Real and
    imaginary parts are apart, so that the loops along a row become vector code.
    """
    n = len(real)
    for k in range(n):
        best, largest = k, 0.0
        for i in range(k, n):
            size = real[i, k] * real[i, k] + imaginary[i, k] * imaginary[i, k]
            if size > largest:
                best, largest = i, size
        if best != k:
            for rows in (real, imaginary):
                for j in range(k, rows.shape[1]):
                    rows[k, j], rows[best, j] = rows[best, j], rows[k, j]
        for i in range(k + 1, n):
            a = (real[i, k] * real[k, k] + imaginary[i, k] * imaginary[k, k]) / largest
            b = (imaginary[i, k] * real[k, k] - real[i, k] * imaginary[k, k]) / largest
            _subtract(real, imaginary, i, a, b, k, k + 1)
    for k in range(n - 1, -1, -1):
        for i in range(k + 1, n):
            _subtract(real, imaginary, k, real[k, i], imaginary[k, i], i, n)
        size = real[k, k] * real[k, k] + imaginary[k, k] * imaginary[k, k]
        for j in range(n, real.shape[1]):
            x, y = real[k, j], imaginary[k, j]
            real[k, j] = (x * real[k, k] + y * imaginary[k, k]) / size
            imaginary[k, j] = (y * real[k, k] - x * imaginary[k, k]) / size


@_compile
def _subtract(real: Any, imaginary: Any, row: int, a: float, b: float, other: int, start: int) -> None:
    """A row less (a + ib) times another, from a column on."""
    for j in range(start, real.shape[1]):
        x, y = real[other, j], imaginary[other, j]
        real[row, j] -= a * x - b * y
        imaginary[row, j] -= a * y + b * x


@cache
def _pairing(harmonics: tuple[int, ...]) -> tuple[Array, NDArray[np.int64]]:
    """0, then q and −q of every pair of cosine and sine; and the place of the other of each pair."""
    signed = np.array([0.0] + [s * q for q in harmonics for s in (1.0, -1.0)])
    return signed, np.array([0] + [2 * k + s for k in range(len(harmonics)) for s in (2, 1)], dtype=np.int64)


@dataclass(frozen=True, eq=False)
class WakeOperator:
    """A for one wake on one grid. Fields are (elements, azimuths), states (225,) for S = 8, k = 2."""

    projection: Projection
    flow: FlowParameters
    families: tuple[_FamilyResponse, ...]
    factor: Array
    """F, (elements,)."""
    factor_slope: Array
    """∂F/∂(µ_z + λ0), (elements,)."""

    def states(self, d: Array) -> Array:
        """x = T W d: the wake's states under a load or a stack of loads, (…, states)."""
        p = self.projection.loads(d)
        if p.ndim > 1:
            return self.transfer(p.T).T
        split = self._split
        return np.concatenate([self.families[0].respond(p[:split]), self.families[1].respond(p[split:])])

    def field(self, x: Array) -> Array:
        """λ_i = C x/F, (…, states) → (…, elements, azimuths)."""
        return self.over_factor(self.projection.field(x))

    def over_factor(self, fields: Array) -> Array:
        """Fields over F; themselves where F = 1."""
        return fields if self._no_factor else fields / self.factor[:, None]

    @cached_property
    def _no_factor(self) -> bool:
        return bool((self.factor == 1.0).all())

    def induced(self, d: Array) -> Array:
        """λ_i = A d."""
        return self.field(self.states(d))

    def induced_transposed(self, g: Array) -> Array:
        """Aᵀ g, for adjoints."""
        back = self.transfer(self.projection.field_transposed(self.over_factor(g)), transposed=True)
        return self.projection.loads_transposed(back)

    def states_by_wake(self, d: Array) -> Array:
        """∂x by (µ_x, µ_z, λ0) at fixed load, (3, states)."""
        p = self.projection.loads(d)
        split = self._split
        parts = [family.slopes(part) for family, part in zip(self.families, (p[:split], p[split:]), strict=True)]
        return self.flow.slopes.T @ np.concatenate(parts, axis=1)

    def induced_by_wake(self, d: Array) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        out, beyond = self.field(self.states_by_wake(d)), self.beyond_states(d)
        if beyond is not None:
            out[1:] += beyond
        return out

    def beyond_states(self, d: Array) -> Array | None:
        """The part of ∂λ_i/∂(µ_z + λ0) through F, (elements, azimuths); None where F does not follow the wake."""
        if not np.any(self.factor_slope):
            return None
        return self.induced(d) * (-self.factor_slope / self.factor)[:, None]

    def feedback(self, slope: Array, load: Array) -> "DynamicWakeFeedback":
        """The feedback for a pointwise slope K = ∂d/∂λ_i, negative where more inflow reduces the lift, at a load."""
        reduced = self.projection.reduced(self.over_factor(slope))
        system = -self.transfer(reduced)
        system.ravel()[:: len(system) + 1] += 1.0
        # Of the transpose, which is what LAPACK sees in these rows without copying them.
        return DynamicWakeFeedback(self, slope, load, lu_factor(system.T, overwrite_a=True, check_finite=False))

    def transfer(self, p: Array, *, transposed: bool = False) -> Array:
        """T p or Tᵀ p along the first axis: loads on the states → states."""
        split = self._split
        cosines, sines = self.families
        return np.concatenate(
            [cosines.apply(p[:split], transposed=transposed), sines.apply(p[split:], transposed=transposed)]
        )

    @property
    def _split(self) -> int:
        return self.projection.family[0] * (1 + 2 * len(self.projection.harmonics))


@dataclass(frozen=True, eq=False)
class DynamicWakeFeedback:
    """(I − A diag K)⁻¹, exactly, through one LU of the size of the states: I + (C/F) (I − T W (K/F) C)⁻¹ T W K."""

    operator: WakeOperator
    slope: Array
    load: Array
    """The load at which the wake changes."""
    lu: tuple[Array, NDArray[np.int32]]
    """Factors of (I − T W (K/F) C)ᵀ."""

    def solve_states(self, x: Array) -> Array:
        """(I − T W (K/F) C)⁻¹ x, (states,) or (states, n): the feedback in terms of the states."""
        return lu_solve(self.lu, x, trans=1, check_finite=False)

    def solve(self, fields: Array) -> Array:
        """λ with λ − A (K λ) = fields, for a field or a stack of fields, (…, elements, azimuths)."""
        return fields + self.operator.field(self.solve_states(self.operator.states(self.slope * fields).T).T)

    def solve_transposed(self, field: Array) -> Array:
        """v with v − K Aᵀ v = field."""
        operator, projection = self.operator, self.operator.projection
        back = projection.field_transposed(operator.over_factor(field))
        back = lu_solve(self.lu, back, check_finite=False)
        return field + self.slope * projection.loads_transposed(operator.transfer(back, transposed=True))

    def answer_columns(self, loads: Array, wake: Array, slope: Array, shapes: HarmonicShapes | None) -> "StateColumns":
        """As `ColumnFeedback`: the states under every change, x = (I − T W (K/F) C)⁻¹ (T W load + ∂x/∂wake)."""
        operator, projection = self.operator, self.operator.projection
        beyond, shares = operator.beyond_states(self.load), wake[:, 1] + wake[:, 2]
        if beyond is not None:
            loads = loads + shares[:, None, None] * (self.slope * beyond)
        states = operator.transfer(projection.loads(loads).T) + operator.states_by_wake(self.load).T @ wake.T
        if shapes is not None:
            own = projection.load_factor[:, None] * projection.against(slope, shapes)
            states = np.hstack([states, operator.transfer(own)])
            shares = np.concatenate([shares, np.zeros(shapes.columns)])
        return StateColumns(operator, self.solve_states(states), beyond, shares)


@dataclass(frozen=True, eq=False)
class StateColumns:
    """The inflow that answers several changes, in terms of the wake's states."""

    operator: WakeOperator
    states: Array
    """(states, columns)"""
    beyond: Array | None
    """What no state can hold, (elements, azimuths), see `WakeOperator.beyond_states`."""
    shares: Array
    """How much of it is in each column, (columns,)."""

    def field(self, coefficients: Array) -> Array:
        """As `InflowColumns`."""
        out = self.operator.field(self.states @ coefficients)
        return out if self.beyond is None else out + float(self.shares @ coefficients) * self.beyond

    def integrate(self, fields: Array) -> Array:
        """As `InflowColumns`."""
        out = self.operator.projection.field_transposed(self.operator.over_factor(fields)) @ self.states
        return out if self.beyond is None else out + np.outer(np.tensordot(fields, self.beyond, 2), self.shares)

    def project(self, slope: Array, shapes: HarmonicShapes) -> Array:
        """As `InflowColumns`."""
        projection = self.operator.projection
        rows = projection.field_factor[:, None] * projection.against(self.operator.over_factor(slope), shapes)
        out = np.tile(shapes.scale, len(shapes.radial))[:, None] * (rows.T @ self.states)
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
        """(I − A diag K)⁻¹ through one factorisation of the wake's states."""
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

"""The equations of the hovering rotor with a free wake, and their exact Jacobian.

Unknowns: the nodes (r, z) of the filaments behind one blade, the circulation Γ of every blade element, the collective.
Equations, with χ the azimuth behind the blade, lengths over R, velocities over ΩR:

    dr/dχ = v_r/(1 − v_θ/r),   dz/dχ = (v_z − λ_c)/(1 − v_θ/r)   filaments are streamlines, steady seen from the blade
    Γ = ½ c U C_l                                           lifting line on the section data
    C_T = C_W                                               the thrust that is asked for

The first by the trapezoidal rule, all by one Newton's method: influence coefficients of a free wake (Bliss, Wachspress
& Quackenbush, AHS Forum 41, 1985) with the loads in the same system. The wake is `TURNS` free turns, two more of
constant pitch, then vortex cylinders. The tip vortex has a core that grows (Bhagwat & Leishman, J. AHS 47(3), 2002).
Blades are straight and lie in the disk, their near wake over `NEAR_WAKE` is a sheet of arcs in the disk plane.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rotor.aero.free_wake.biot_savart import filament_velocity, wake_velocities
from rotor.aero.free_wake.roll_up import RolledUp, RollUp
from rotor.aero.problem import Problem
from rotor.aero.section import (
    ALPHA as _ALPHA,
)  # fmt: skip
from rotor.aero.section import (
    CD as _CD,
)
from rotor.aero.section import (
    CD_MACH as _CD_MACH,
)
from rotor.aero.section import (
    CHANNELS,
    LOSS,
    PAIRS,
    TH,
    UP,
    UT,
    M,
    section,
)
from rotor.aero.section import (
    CL as _CL,
)
from rotor.aero.section import (
    FX as _FX,
)
from rotor.aero.section import (
    FZ as _FZ,
)
from rotor.aero.section import (
    MACH as _MACH,
)
from rotor.arrays import Array

(FZ, FX, LIFT, ALPHA, MACH, CL, CD, CD_MACH, FZ_THETA, FX_THETA, FZ_UT, FX_UT, FZ_UP, FX_UP, MOMENT, M_THETA, M_UT,
 M_UP) = range(18)  # fmt: skip
"""Rows. LIFT: ½σ U C_l. MOMENT: that of the air with the propeller moment, of an elastic blade."""

_SLOPES = ((_FZ, TH), (_FX, TH), (_FZ, UT), (_FX, UT), (_FZ, UP), (_FX, UP))


def line_loads(problem: Problem, theta: Array, u_t: Array, u_p: Array) -> Array:
    """Rows by element, (18, elements), at pitch and velocities, (elements,) each."""
    channels = np.zeros((len(CHANNELS), len(theta), 1))
    channels[TH, :, 0], channels[UT, :, 0], channels[UP, :, 0], channels[LOSS] = theta, u_t, u_p, 1.0
    data = problem.section_data(len(problem.disk.psi))
    f, d, s = section(channels, data, True, True)
    lift = data.half_solidity * np.sqrt(u_t**2 + u_p**2) * s[_CL, :, 0]
    rows = [f[_FZ], f[_FX], lift[:, None], s[_ALPHA], s[_MACH], s[_CL], s[_CD], s[_CD_MACH]]
    rows += [d[PAIRS.index(pair)] for pair in _SLOPES]
    if problem.torsion is None:
        rows += [np.zeros_like(f[_FZ])] * 4
    else:
        rows += [f[M], *(d[PAIRS.index((M, channel))] for channel in (TH, UT, UP))]
    return np.array(rows)[:, :, 0]


TURNS = 2
"""Free turns. A third changes power by −0.1 to −0.4 %, and at high thrust its filaments pair up and find no
equilibrium, as real helices do not."""
FIXED_TURNS = 3
"""Turns of constant pitch behind them."""
STEPS = 24
"""Least azimuth steps of a turn; a multiple of the number of blades is taken."""
NEAR_WAKE = math.radians(30.0)
"""Azimuth behind a blade over which its own trailing vorticity is a sheet."""
INITIAL_CORE = 0.1
"""Core radius of the tip vortex where it leaves the blade, over the chord."""
CORE_GROWTH = 2e-4
"""a1 of Bhagwat & Leishman: effective viscosity over ν is 1 + a1 Γ/ν; ν itself is negligible at full scale."""
LAMB = 1.25643
"""r_c² = 4 · 1.25643 ν t of the Lamb–Oseen vortex."""
SHEET_CORE = 0.065
"""Core radius of inboard filaments where they leave the blade, over R: each stands for a strip of vortex sheet."""
SHEET_GROWTH = 1.0
"""Growth of the square of that core in a turn, as a part of its first value: strips stretch and wind up."""
BOUND_CORE = 0.25
"""Core radius of the lifting line where it acts on the wake, over the chord: the chord spreads its circulation."""
SELF_CORE = 0.5735
"""Cut-off of the law of Biot and Savart over the core radius of a Gaussian core: gives the speed of a thin vortex ring,
Γ/4πR (ln 8R/√(4νt) − 0.558) (Saffman, Stud. Appl. Math. 49, 1970)."""
SELF_ARC = 0.9229
"""Arc of a curved segment over its length in the self-induction: the chords beyond it induce as much more as the arcs
they stand for, whatever the number of steps (0.0802 in the bracket, by comparison of a polygon with a ring)."""
LEAST_PITCH = 0.002
"""Rounds the pitch of the fixed turns off towards zero; theirs is always down."""
CYLINDER_POINTS = 16


def landgrebe_radius(age: Array | float, thrust: float) -> Array:
    """r/R of a tip vortex at wake azimuth χ [rad] for C_T, as measured: 0.78 + 0.22 exp(−(0.145 + 27 C_T) χ).

    Landgrebe, The Wake Geometry of a Hovering Helicopter Rotor and its Influence on Rotor Performance, J. AHS 17(4),
    1972.
    """
    return 0.78 + 0.22 * np.exp(-(0.145 + 27.0 * thrust) * np.asarray(age))


def landgrebe_rates(thrust: float, solidity: float, twist: float) -> tuple[float, float]:
    """dz/dχ of a tip vortex over R up to the next blade and beyond it, k1 and k2; twist [rad per R].

    k1 = −0.25 (C_T/σ + 0.001 θ), k2 = −(1.41 + 0.0141 θ) √(C_T/2), θ in degrees; source as above.
    """
    degrees = math.degrees(twist)
    return -0.25 * (thrust / solidity + 0.001 * degrees), -(1.41 + 0.0141 * degrees) * math.sqrt(thrust / 2.0)


def first_passage_radius(blades: int, thrust: float) -> float:
    """r/R at which a tip vortex passes under the next blade, by Landgrebe's measurements; at least 0.8."""
    return max(0.8, float(landgrebe_radius(2.0 * math.pi / blades, thrust)))


@dataclass(frozen=True)
class WakeLayout:
    """The numbers of a discrete wake."""

    blades: int
    elements: int
    steps: int
    """Azimuth steps of a turn."""
    inboard: int = 2
    """Strips of the lifting line besides the outer one."""
    turns: int = TURNS

    @property
    def filaments(self) -> int:
        return self.inboard + 2

    @property
    def free(self) -> int:
        """Free nodes of a filament."""
        return self.steps * self.turns

    @property
    def nodes(self) -> int:
        """All nodes of a filament, the one on the blade included."""
        return self.steps * (self.turns + FIXED_TURNS) + 1

    @property
    def geometry(self) -> int:
        """Unknowns of the geometry."""
        return 2 * self.filaments * self.free

    @property
    def size(self) -> int:
        return self.geometry + self.elements + 1

    @property
    def step(self) -> float:
        return 2.0 * math.pi / self.steps

    @property
    def near(self) -> int:
        """Steps of the near wake."""
        return max(1, round(NEAR_WAKE / self.step))

    def refined(self, steps: int) -> "WakeLayout":
        return WakeLayout(self.blades, self.elements, steps, self.inboard, self.turns)


def layout_of(problem: Problem, steps: int = STEPS, inboard: int = 2) -> WakeLayout:
    """The layout with at least so many azimuth steps of a turn."""
    blades = problem.disk.blades
    return WakeLayout(blades, len(problem.disk.r), blades * math.ceil(steps / blades), inboard)


@dataclass(frozen=True, eq=False)
class WakeState:
    """All unknowns."""

    layout: WakeLayout
    values: Array
    """(size,): r and z of node after node, filament after filament; Γ/ΩR² of the elements; the collective [rad]."""

    @property
    def nodes(self) -> Array:
        """r and z of the free nodes, (filaments, free, 2)."""
        return self.values[: self.layout.geometry].reshape(self.layout.filaments, self.layout.free, 2)

    @property
    def circulation(self) -> Array:
        return self.values[self.layout.geometry : -1]

    @property
    def collective(self) -> float:
        return float(self.values[-1])


@dataclass(frozen=True, eq=False)
class WakeEvaluation:
    """The equations at a state."""

    state: WakeState
    rolled: RolledUp
    radius: Array
    """r of all nodes, (filaments, nodes)."""
    height: Array
    inflow: Array
    """λ_i at the elements, down, (elements,)."""
    swirl: Array
    """In the direction of rotation, (elements,)."""
    loads: Array
    """As `line_loads`, (rows, elements)."""
    residual: Array
    jacobian: Array
    """(size, size); empty where it was not asked for."""
    inflow_slopes: Array
    """∂λ_i/∂unknowns, (elements, size)."""
    swirl_slopes: Array

    @property
    def error(self) -> float:
        return float(np.abs(self.residual).max())


class HoverSystem:
    """The equations of one design on one layout."""

    def __init__(
        self, problem: Problem, layout: WakeLayout, roll_up: RollUp | None = None, sheet_core: float = SHEET_CORE
    ) -> None:
        self.problem, self.layout = problem, layout
        disk = problem.disk
        if roll_up is None:
            passage = first_passage_radius(layout.blades, problem.weight)
            roll_up = RollUp.of(disk.root, layout.elements, layout.inboard, passage)
        self.roll_up = roll_up
        self.swirling = problem.design.models.has("swirl")
        length = layout.near * layout.step
        self.near_wake = near_wake_influence(disk.root, layout.elements, length)
        angle = layout.step * np.arange(layout.steps)
        self.cos, self.sin = np.cos(angle), np.sin(angle)
        chord = 2.0 * math.pi * float(np.interp(0.9, disk.r, disk.half_solidity)) / disk.blades
        middle = layout.step * (np.arange(layout.nodes - 1) + 0.5)
        self.initial_core, self.bound_core = (INITIAL_CORE * chord) ** 2, (BOUND_CORE * chord) ** 2
        turns = layout.step * np.arange(layout.nodes) / (2.0 * math.pi)
        self.sheet = sheet_core
        self.sheet_core = sheet_core**2 * (1.0 + SHEET_GROWTH * turns)
        self.growth = np.zeros((layout.filaments, layout.nodes - 1))
        self.growth[-1] = 4.0 * LAMB * CORE_GROWTH * middle
        nodes = np.arange(layout.free + 1)
        families = np.repeat(np.arange(layout.filaments), layout.free + 1)
        self.family = np.append(families, np.full(layout.elements, -1))
        self.azimuth = np.append(np.tile(nodes, layout.filaments), np.zeros(layout.elements, dtype=np.int64))
        self.age = layout.step * nodes

    def evaluate(self, state: WakeState, extra_core: float = 0.0, *, slopes: bool = True) -> WakeEvaluation:
        """Residuals at a state, and the Jacobian with `slopes`; `extra_core` [R] widens the core of the tip vortex."""
        layout, disk = self.layout, self.problem.disk
        rolled = self.roll_up(state.circulation)
        radius, height, pitch, pitch_slope = self._all_nodes(state, rolled)
        source = np.tile(0.5 * (self.sheet_core[1:] + self.sheet_core[:-1]), (layout.filaments, 1))
        source[-1] = self.initial_core + extra_core**2 + abs(float(rolled.strength[-1])) * self.growth[-1]
        free = layout.free
        target = np.zeros((len(self.family), 3))
        wake = layout.filaments * (free + 1)
        target[:wake, 0], target[:wake, 1] = radius[:, : free + 1].ravel(), height[:, : free + 1].ravel()
        target[:wake, 2] = np.where(
            self.family[:wake] == layout.filaments - 1, 0.0, self.sheet_core[self.azimuth[:wake]]
        )
        target[wake:, 0] = disk.r
        velocity, by_node, by_target, by_strength, by_bound, by_core = wake_velocities(
            radius, height, rolled.strength, rolled.bound, pitch, pitch_slope, free, self.cos, self.sin,
            layout.blades, target, self.azimuth, self.family, source, self.growth, layout.near, self.bound_core,
            CYLINDER_POINTS, slopes,
        )  # fmt: skip
        own = self.self_induction(radius[:, : free + 1], rolled, extra_core)
        velocity[:wake, 2] += own.velocity.ravel()
        velocity[wake:, 2] += self.near_wake @ state.circulation
        velocity[:wake, 2] -= self.problem.climb
        inflow = -velocity[wake:, 2]
        swirl = velocity[wake:, 1] if self.swirling else np.zeros_like(inflow)
        u_t = disk.r - swirl
        loads = line_loads(self.problem, self.problem.twist + state.collective, u_t, inflow + self.problem.climb)
        residual = np.empty(layout.size)
        drift = self._drift(velocity[:wake], target[:wake, 0])
        residual[: layout.geometry] = self._streamlines(radius, height, drift)
        gain = math.pi / layout.blades
        residual[layout.geometry : -1] = state.circulation - gain * loads[LIFT]
        residual[-1] = loads[FZ].sum() * disk.dr - self.problem.weight
        empty = np.zeros((0, 0))
        if not slopes:
            return WakeEvaluation(state, rolled, radius, height, inflow, swirl, loads, residual, empty, empty, empty)

        count = len(self.family)
        by_circulation = by_strength.reshape(-1, layout.filaments) @ rolled.strength_slopes
        by_circulation += by_bound.reshape(-1, layout.filaments - 1) @ rolled.bound_slopes
        by_circulation = by_circulation.reshape(count, 3, layout.elements)
        by_circulation += by_node[:, :, -1, 0, 0, None] * rolled.tip_slopes
        growing = np.sign(rolled.strength[-1]) * rolled.strength_slopes[-1]
        by_circulation += by_core[:, :, None] * growing
        by_circulation[:wake, 2] += own.by_strength.reshape(-1, 1) * rolled.strength_slopes[self.family[:wake]]
        by_circulation[:wake, 2] += own.by_core.reshape(-1, 1) * growing
        by_circulation[wake:, 2] += self.near_wake
        by_target[:wake, 2] += own.by_radius.ravel()

        geometry = layout.geometry
        velocity_slopes = np.zeros((count, 3, layout.size))
        velocity_slopes[:, :, :geometry] = by_node[:, :, :, 1:, :].reshape(count, 3, geometry)
        velocity_slopes[:, :, geometry:-1] = by_circulation
        rows = np.arange(wake).reshape(layout.filaments, free + 1)
        moving = rows[:, 1:].ravel()  # Targets that are unknowns themselves.
        columns = 2 * np.arange(len(moving))
        for c in range(3):
            velocity_slopes[moving, c, columns] += by_target[moving, c]
            velocity_slopes[moving, c, columns + 1] += by_target[moving, 3 + c]
        tip_root = rows[-1, 0]
        velocity_slopes[tip_root, :, geometry:-1] += by_target[tip_root, :3, None] * rolled.tip_slopes
        jacobian = np.zeros((layout.size, layout.size))
        jacobian[:geometry] = self._streamline_slopes(velocity[:wake], velocity_slopes[:wake], target[:wake, 0], rolled)
        inflow_slopes = -velocity_slopes[wake:, 2]
        swirl_slopes = velocity_slopes[wake:, 1] * float(self.swirling)
        by_t, by_p, by_theta = lift_slopes(loads, u_t, inflow + self.problem.climb)
        jacobian[geometry:-1] = -gain * (by_p[:, None] * inflow_slopes - by_t[:, None] * swirl_slopes)
        jacobian[geometry:-1, -1] -= gain * by_theta
        elements = np.arange(layout.elements)
        jacobian[geometry + elements, geometry + elements] += 1.0
        jacobian[-1] = disk.dr * (loads[FZ_UP] @ inflow_slopes - loads[FZ_UT] @ swirl_slopes)
        jacobian[-1, -1] += disk.dr * loads[FZ_THETA].sum()
        return WakeEvaluation(
            state, rolled, radius, height, inflow, swirl, loads, residual, jacobian, inflow_slopes, swirl_slopes
        )

    def core_squares(self, rolled: RolledUp) -> Array:
        """Square of the core radius at every node, (filaments, nodes)."""
        layout = self.layout
        square: Array = np.tile(self.sheet_core, (layout.filaments, 1)).astype(np.float64)
        age = layout.step * np.arange(layout.nodes)
        square[-1] = self.initial_core + abs(float(rolled.strength[-1])) * 4.0 * LAMB * CORE_GROWTH * age
        return square

    def lift_slopes(self, at: WakeEvaluation) -> tuple[Array, Array, Array]:
        """`lift_slopes` of an evaluation."""
        return lift_slopes(at.loads, self.problem.disk.r - at.swirl, at.inflow + self.problem.climb)

    def _all_nodes(self, state: WakeState, rolled: RolledUp) -> tuple[Array, Array, Array, Array]:
        """r and z of all nodes, the pitch of the fixed turns (down, per radian) and its slope."""
        layout = self.layout
        free, turn = layout.free, layout.steps
        radius, height = np.empty((2, layout.filaments, layout.nodes))
        radius[:, 0], height[:, 0] = rolled.release, 0.0
        radius[:, 1 : free + 1], height[:, 1 : free + 1] = state.nodes[..., 0], state.nodes[..., 1]
        mean = (height[:, free] - height[:, free - turn]) / (2.0 * math.pi)
        size = np.hypot(mean, LEAST_PITCH)
        pitch = 0.5 * (size - mean)
        beyond = layout.step * np.arange(1, layout.nodes - free)
        radius[:, free + 1 :] = radius[:, free, None]
        height[:, free + 1 :] = height[:, free, None] - pitch[:, None] * beyond
        return radius, height, pitch, 0.5 * (mean / size - 1.0) / (2.0 * math.pi)

    def self_induction(self, radius: Array, rolled: RolledUp, extra_core: float) -> "SelfInduction":
        """Velocity that the two segments at each node induce there by their curvature, up.

        The arc of half-length l with a cut-off a induces Γ/4πr (asinh l/a − l/√(l² + a²)).
        """
        layout = self.layout
        growth = np.zeros((layout.filaments, 1)) + 4.0 * LAMB * CORE_GROWTH * self.age
        growth[:-1] = 0.0
        square = np.tile(2.0 * self.sheet_core[: layout.free + 1], (layout.filaments, 1))
        square[-1] = self.initial_core + extra_core**2 + abs(float(rolled.strength[-1])) * growth[-1]
        share = np.ones_like(growth)
        share[:, 0], share[0] = 0.5, 0.0
        arc, cut = SELF_ARC * radius * layout.step, SELF_CORE * np.sqrt(square)
        root = np.hypot(arc, cut)
        bracket = np.arcsinh(arc / cut) - arc / root
        unit = -share / (4.0 * math.pi * radius)
        by_arc = arc**2 / root**3
        by_cut = -(arc**3) / (cut * root**3)
        strength = rolled.strength[:, None]
        return SelfInduction(
            velocity=strength * unit * bracket,
            by_strength=unit * bracket,
            by_radius=strength * unit * (by_arc * SELF_ARC * layout.step - bracket / radius),
            by_core=strength * unit * by_cut * SELF_CORE**2 * growth / (2.0 * cut),
        )

    def _drift(self, velocity: Array, radius: Array) -> Array:
        """dr/dχ and dz/dχ, (targets, 2)."""
        return velocity[:, [0, 2]] / (1.0 - velocity[:, 1] / radius)[:, None]

    def _streamlines(self, radius: Array, height: Array, drift: Array) -> Array:
        layout = self.layout
        free = layout.free
        drift = drift.reshape(layout.filaments, free + 1, 2)
        steps = np.stack([np.diff(radius[:, : free + 1]), np.diff(height[:, : free + 1])], axis=-1)
        return (steps - 0.5 * layout.step * (drift[:, 1:] + drift[:, :-1])).ravel()

    def _streamline_slopes(self, velocity: Array, slopes: Array, radius: Array, rolled: RolledUp) -> Array:
        layout = self.layout
        free, size = layout.free, layout.size
        turning = 1.0 / (1.0 - velocity[:, 1] / radius)
        tangential = turning**2 / radius
        drift_slopes = np.empty((len(velocity), 2, size))
        for row, c in enumerate((0, 2)):
            drift_slopes[:, row] = slopes[:, c] * turning[:, None]
            drift_slopes[:, row] += slopes[:, 1] * (velocity[:, c] * tangential)[:, None]
        # 1 − v_θ/r by the target's own radius.
        rows = np.arange(len(velocity)).reshape(layout.filaments, free + 1)
        moving = rows[:, 1:].ravel()
        columns = 2 * np.arange(len(moving))
        by_own = -(turning**2) * velocity[:, 1] / radius**2
        tip_root = rows[-1, 0]
        for row, c in enumerate((0, 2)):
            drift_slopes[moving, row, columns] += velocity[moving, c] * by_own[moving]
            drift_slopes[tip_root, row, layout.geometry : -1] += (
                velocity[tip_root, c] * by_own[tip_root] * rolled.tip_slopes
            )
        drift_slopes = drift_slopes.reshape(layout.filaments, free + 1, 2, size)
        jacobian = -0.5 * layout.step * (drift_slopes[:, 1:] + drift_slopes[:, :-1])
        jacobian = jacobian.reshape(layout.geometry, size)
        diagonal = np.arange(layout.geometry)
        jacobian[diagonal, diagonal] += 1.0
        inner = diagonal.reshape(layout.filaments, free, 2)[:, 1:].ravel()
        jacobian[inner, inner - 2] -= 1.0
        first = 2 * free * (layout.filaments - 1)
        jacobian[first, layout.geometry : -1] -= rolled.tip_slopes
        return jacobian


@dataclass(frozen=True, eq=False)
class SelfInduction:
    """Velocity up that a curved filament induces at its own nodes, (filaments, nodes), and its slopes."""

    velocity: Array
    by_strength: Array
    by_radius: Array
    by_core: Array
    """By the size of the circulation of the tip vortex, through its core."""


def lift_slopes(loads: Array, u_t: Array, u_p: Array) -> tuple[Array, Array, Array]:
    """Slopes of ½σ U C_l, the row `LIFT`, by U_T, U_P and pitch; from ½σ U C_l U² = F_z U_T + F_x U_P."""
    square = u_t**2 + u_p**2
    lift = loads[LIFT]
    by_t = (loads[FZ_UT] * u_t + loads[FX_UT] * u_p + loads[FZ] - 2.0 * u_t * lift) / square
    by_p = (loads[FZ_UP] * u_t + loads[FX_UP] * u_p + loads[FX] - 2.0 * u_p * lift) / square
    by_theta = (loads[FZ_THETA] * u_t + loads[FX_THETA] * u_p) / square
    return by_t, by_p, by_theta


@lru_cache(maxsize=16)
def near_wake_influence(root: float, elements: int, length: float) -> Array:
    """v_z at the elements by Γ of the elements, (elements, elements), of the near wake of the own blade.

    Arcs in the disk plane from every border of two elements, `length` radians long, in steps that grow with distance.
    """
    edges = np.linspace(root, 1.0, elements + 1)
    centres = 0.5 * (edges[1:] + edges[:-1])
    angle = length * np.linspace(0.0, 1.0, 65) ** 2
    cos, sin = np.cos(angle), -np.sin(angle)
    flat, thin = np.zeros_like(angle), np.zeros(len(angle) - 1)
    by_edge = np.empty((elements, elements + 1))
    for k, edge in enumerate(edges):
        x, y = edge * cos, edge * sin
        for i, r in enumerate(centres):
            velocity = np.zeros(3)
            filament_velocity((r, 0.0, 0.0), x, y, flat, thin, 0, velocity)
            by_edge[i, k] = velocity[2]
    return by_edge[:, 1:] - by_edge[:, :-1]

"""Forward flight, in an aircraft or on a stand, as a system of the engine.

    U_T = r − u + µ_x sin ψ                                (3.5) with the swirl u
    U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ             (3.6), and a gust of `rotor.aero.air`
    U_R = µ_x cos ψ

µ_x = µ cos α − µ_c sin α, µ_z = µ sin α + µ_c cos α with µ_c = V_c/ΩR. Where the models leave out the axial flow of the
tilted disk, as (3.6) prints it, µ_x is µ and µ_z is 0; λ_i is then still skewed by the tilt, eq. (2.31).
"""

import math
from collections.abc import Hashable
from dataclasses import dataclass, field

import numpy as np

from rotor.aero.bent_section import SLOPES
from rotor.aero.elements import (
    STATE_NAMES,
    BentState,
    BladeElements,
    DiskSums,
    TrimState,
    TwistState,
    section_fields,
)
from rotor.aero.inflow.interface import DiskFlow, InflowTerms
from rotor.aero.problem import Problem, swirl_of
from rotor.aero.section import FZ, LOSS, RATE, TH, UP, UR, UT, M
from rotor.aero.unsteady_section import DTH, DUP, RATES
from rotor.columns.bending import bends, coordinates_of, freedoms_of
from rotor.columns.blade import (
    Freedom,
    Torsion,
    add_accelerations,
    add_pitch_rates,
    add_rigid_blade,
    power_of_air,
)
from rotor.columns.trims import Trim, add_equations, declare_equations, trim_numbers, trim_of
from rotor.engine.linearise import Grid, Live, Point, Shapes, System, part
from rotor.engine.terms import ONE, Shape, Structure
from rotor.engine.waves import COS, SIN, STEADY, harmonic_of, wave_grid
from rotor.support.arrays import Array
from rotor.support.bytes_cache import bytes_cache

LEAST_AZIMUTHS = 40
"""Least azimuths on which derivatives are evaluated, and first steps made: a step with those on 40 leaves 1e-5 to 6e-3
of an error on 120 (tested)."""


@dataclass(frozen=True)
class SystemTolerances:
    """Residuals at which a trim is solved, and the largest steps towards it."""

    residual_tolerance: float = 1e-10
    """Largest residual of the trim equations, as a fraction of C_W; it keeps the energy identity to 1e-9."""
    inflow_tolerance: float = 1e-8
    """Largest difference of N_b Γ/π from that of the lift, as a fraction of C_W."""
    torsion_tolerance: float = 1e-10
    """Largest residual of the equations of torsion and bending [rad]."""
    angle_step: float = 0.08
    """Largest Newton step of an angle [rad]: beyond it the section slopes no longer hold."""
    inflow_step: float = 0.02
    """Largest Newton step of λ0, over ΩR."""


DEFAULT_TOLERANCES = SystemTolerances()


@dataclass(frozen=True)
class _StructureKey:
    """All that the structure of a flight depends on."""

    trim: Trim
    blade: tuple[Hashable, ...]
    """The keys of `freedoms`."""
    numbers: tuple[Hashable, ...]
    inflow: Hashable
    follows_rate: bool
    """Whether forces follow the rate of pitch."""
    rates: int | None
    """The first channel of those that unsteady flow adds; None in steady flow."""
    section: tuple[tuple[tuple[int, int], ...], int, int]
    """Pairs, channels and forces of the section."""
    freedoms: tuple[Freedom, ...] = field(compare=False)
    terms: InflowTerms = field(compare=False)


@bytes_cache
def _structure(key: _StructureKey) -> Structure:
    """Atoms, columns and equations of a flight; see the head of this file."""
    terms, s = key.terms, Structure(*key.section, key)
    for number in key.numbers:
        s.number(number)
    for state in STATE_NAMES:
        s.state(state)
    names = [name for freedom in key.freedoms for name in freedom.states]
    for name in names:
        s.state(name)
    s.roots = s.states["shaft_tilt"], s.states["lambda0"]
    derived = {name: s.quantity(name) for name in _DERIVED}
    declare_equations(s, key.trim)
    add_rigid_blade(s, bends=bends(s))
    if key.follows_rate and not any(isinstance(freedom, Torsion) for freedom in key.freedoms):
        add_pitch_rates(s)
    s.column(UT, "one", SIN, 1.0, derived["mu_x"])
    s.column(UR, "one", COS, 1.0, derived["mu_x"])
    for freedom in key.freedoms:
        freedom.build(s)
    if key.rates is not None:
        add_accelerations(s, key.rates, s.channels + SLOPES[0] if bends(s) else None)
    _add_sums(s, key)
    s.column(UP, "one", STEADY, 1.0, derived["mu_z"])
    terms.build(s)
    s.column(UT, SWIRL_SLOPE, STEADY, 1.0, derived["change of swirl"])
    live = terms.live_columns(s)
    for channel, name, wave, atom in live:
        s.column(channel, (name, "tilt"), wave, 1.0, derived["change of tilt"], atom)
        s.column(channel, (name, "inflow"), wave, 1.0, derived["change of lambda0"], atom)
    # Last, since most of them do not change.
    for channel, name, wave, atom in (
        (UT, SWIRL, STEADY, ONE),
        *live,
    ):
        s.column(channel, name, wave, 1.0, atom)
    return s.finish([s.states[name] for name in (*key.trim.unknowns, *names)])


def _add_sums(s: Structure, key: _StructureKey) -> None:
    """The equations of the trim, and what power is made of: C_H, C_Q, and of parts of the shaft's power those of twist.

    Induced and profile power are C_Q + µ_x C_H − µ_z C_T less the power of the air on the blade's motion: from
    U dD = U_T dF_x − U_P dF_z + U_R dF_r, r = U_T + u − µ_x sin ψ and U_P = µ_z + λ_i + (r − e) β' + µ_x β cos ψ.
    On a stand what the rotor pulls is among the parts too.
    """
    drag, torque, motion = power_of_air(s)
    add_equations(s, key.trim, drag, torque)
    damping = [term for freedom in key.freedoms for term in freedom.power(s)]
    parts = torque + [(-share, i, j, q) for share, i, j, q in motion] + damping
    mu_x, mu_z = s.derived["mu_x"], s.derived["mu_z"]
    pull = [(share, mu_x, atom, q) for share, atom, _, q in drag] + [
        (-1.0, mu_z, ONE, s.measure(FZ, "one", STEADY))
    ]
    sums = {"drag": drag, "torque": torque, "motion": motion, "damping": damping}
    for name, terms in (*sums.items(), ("power", parts + pull), ("power on a stand", parts)):
        s.sum(name, terms)


_CHANGES = ("change of tilt", "change of lambda0", "change of swirl")
_DERIVED = ("cos", "sin", "mu_x", "mu_z", "speed", "wake_x", "wake_z", *_CHANGES)
"""Made atoms: cos α, sin α, µ_x and µ_z as the blade elements see them, V, µ_x and µ_z of the wake, and three that are
zero, whose columns hold the slopes of live shapes: α, λ0 and λ0 (µ_z + λ0)."""
SWIRL, SWIRL_SLOPE = "swirl", "swirl slope"
"""Shapes of the channel UT: −u, and its slope by λ0 (µ_z + λ0)."""


def flight_system(problem: Problem, wanted: SystemTolerances = DEFAULT_TOLERANCES) -> System:
    """The equations of a design in forward flight."""
    terms, freedoms, disk = (
        problem.inflow_terms,
        (*freedoms_of(problem), *problem.freedoms),
        problem.disk,
    )
    values: dict[Hashable, float] = {**trim_numbers(problem)}
    shapes: dict[Shape, Array] = {"one": np.ones_like(disk.r), "r": disk.r, "arm": problem.arm}
    for freedom in freedoms:
        values |= freedom.numbers(problem)
        shapes |= freedom.shapes(problem)
    section, blade = problem.interface, tuple(freedom.key for freedom in freedoms)
    kind = (section.pairs, section.channels, section.forces)
    first = terms.interface.channels if problem.unsteady else None
    trim, numbers = trim_of(problem.design), tuple(values)
    key = _StructureKey(
        trim, blade, numbers, terms.key, problem.unsteady, first, kind, freedoms, terms
    )
    structure = _structure(key)
    grid = _grid(problem, structure, 1)
    step = _thinning(len(problem.disk.psi), terms.least_azimuths)
    tolerance = np.full(len(structure.equations), wanted.residual_tolerance * problem.scale)
    for kind in ("twist", "bend"):
        tolerance[structure.equations_of(kind)] = wanted.torsion_tolerance
    limits = np.full(len(structure.free), wanted.angle_step)
    limits[structure.states_of("lambda0")] = wanted.inflow_step
    nodes = terms.nodes(wanted.inflow_tolerance * problem.scale, problem.scale)
    if nodes is not None:
        points = len(nodes.matrix)
        tolerance = np.concatenate([tolerance, np.full(points, nodes.tolerance)])
        limits = np.concatenate([limits, np.full(points, nodes.limit)])
    along, make = (
        Shapes(structure, shapes | terms.shapes(), disk.dr),
        _Flow(problem, structure, terms),
    )
    thin, given = (
        grid if step == 1 else _grid(problem, structure, step),
        np.array([1.0, *values.values()]),
    )
    return System(
        structure,
        along,
        grid,
        thin,
        section.section,
        make,
        given,
        tolerance,
        limits,
        nodes,
        section.memory,
    )


def check_freedoms(problem: Problem) -> None:
    """Raise TypeError or ValueError for further freedoms that this blade cannot have, or that contradict others."""
    if problem.design.hovering:
        raise ValueError(
            "Hover is solved at one azimuth and takes no further freedoms: give a speed."
        )
    if problem.bending is not None:
        raise ValueError(
            "Bending blades already flap and lag: switch bending off, or give no freedoms."
        )
    taken: tuple[set[Hashable], ...] = {*STATE_NAMES}, {*trim_numbers(problem)}, {"one", "r", "arm"}
    for freedom in (*freedoms_of(problem), *problem.freedoms):
        if not isinstance(freedom, Freedom):
            raise TypeError(
                f"freedoms contains {freedom!r:.80}: give instances of classes derived from rotor.Freedom"
            )
        try:
            hash(freedom.key)
        except TypeError as error:
            raise TypeError(
                f"A field of {type(freedom).__name__} cannot be hashed ({error}): use tuples."
            ) from None
        for names, named in zip(
            taken, (freedom.states, freedom.numbers(problem), freedom.shapes(problem)), strict=True
        ):
            if again := names.intersection(named):
                raise ValueError(
                    f"{type(freedom).__name__} repeats the name {min(again, key=str)!r}: choose another."
                )
            names.update(named)
    s = flight_system(problem).structure
    used = {name for shapes in (s.shapes[TH], s.shapes[RATE], *s.weights) for name in shapes}
    if unknown := used - taken[2]:
        raise ValueError(f"No freedom has a shape {min(unknown, key=str)!r}: add it to shapes.")


def _thinning(azimuths: int, least: int) -> int:
    """Every how many azimuths are enough to begin with.

    Means over evenly spaced azimuths of a smooth periodic field converge faster than any power of their number.
    """
    for step in range(azimuths // LEAST_AZIMUTHS, 1, -1):
        if azimuths % step == 0 and azimuths // step >= least:
            return step
    return 1


def _grid(problem: Problem, structure: Structure, step: int) -> Grid:
    """The design's own part of the channels, on every `step`-th azimuth."""
    disk = problem.disk
    steady = np.zeros((structure.channels, len(disk.r)))
    steady[TH], steady[UT] = problem.twist, disk.r
    if problem.air.joined is not None:
        steady[UP] += problem.air.joined[0]
        steady[UT] -= problem.air.joined[1]
    if not structure.shapes[LOSS]:
        steady[LOSS] = 1.0
    varying, first = dict[int, Array](), problem.inflow_terms.interface.channels
    if problem.waves.size > 1:
        varying = {TH: problem.waves, RATE: problem.wave_rates[0]}
        if problem.unsteady:
            varying[first + DTH] = problem.wave_rates[1]
    if problem.air.gust is not None and problem.air.gust_rate is not None:
        varying[UP] = problem.air.gust
        if problem.unsteady:
            varying[first + DUP] = problem.air.gust_rate
    varying = {channel: added[:, ::step] for channel, added in varying.items()}
    waves = wave_grid(structure.waves, len(disk.psi) // step)
    return Grid(waves, steady, varying, problem.grid_data(step))


class _Flow:
    """Made atoms and live shapes of a flight."""

    def __init__(self, problem: Problem, structure: Structure, terms: InflowTerms) -> None:
        self._design, models = problem.design, problem.design.models
        self._mu, self._sees_tilt = self._design.condition.advance_ratio, models.disk_axial_flow
        self._swirls, self._r, self._terms = models.has("swirl"), problem.disk.r, terms
        self._tilt, self._lambda0 = structure.roots
        self._atoms = {name: k for k, name in enumerate(structure.derived)}

    def at_disk(self, x: Array) -> DiskFlow:
        """The flow of momentum theory, in axes of the shaft."""
        return DiskFlow(*self._design.in_disk_axes(float(x[self._tilt])), float(x[self._lambda0]))

    def flow(self, x: Array) -> DiskFlow:
        """The flow as the blade elements see it."""
        return self._seen(self.at_disk(x))

    def _seen(self, flow: DiskFlow) -> DiskFlow:
        return flow if self._sees_tilt else DiskFlow(self._mu, 0.0, flow.lambda0)

    def __call__(self, x: Array) -> tuple[Array, Array, Live]:
        """Values, slopes by shaft tilt and λ0, and live shapes; in axes of the shaft dµ_x = −µ_z dα, dµ_z = µ_x dα."""
        flow, tilt = self.at_disk(x), float(x[self._tilt])
        seen = self._seen(flow)
        values, slopes, sees = (
            np.zeros(len(self._atoms)),
            np.zeros((len(self._atoms), 2)),
            float(self._sees_tilt),
        )
        cos, sin, l0, speed, axial = (
            math.cos(tilt),
            math.sin(tilt),
            flow.lambda0,
            seen.speed,
            seen.axial,
        )
        values[:7] = cos, sin, seen.mu_x, seen.mu_z, speed, flow.mu_x, flow.mu_z
        slopes[:2, 0], slopes[5:7, 0] = (-sin, cos), (-flow.mu_z, flow.mu_x)
        slopes[2:5, 0] = -sees * seen.mu_z, sees * seen.mu_x, sees * seen.mu_x * l0 / speed
        slopes[4, 1] = axial / speed
        slopes[7, 0] = slopes[8, 1] = 1.0
        live = dict[tuple[int, Shape], Array]()
        if self._swirls:
            swirl, by_product = swirl_of(self._r, l0 * axial)
            live[UT, SWIRL], live[UT, SWIRL_SLOPE] = -swirl, -by_product
            slopes[9] = sees * l0 * seen.mu_x, axial + l0
        followed = self._terms.follow(flow, seen.mu_z, self._sees_tilt)
        for name, (value, by_flow) in followed.atoms.items():
            row = self._atoms[name]
            values[row], slopes[row] = (
                value,
                (flow.mu_x * by_flow[1] - flow.mu_z * by_flow[0], by_flow[2]),
            )
        for (channel, name), (value, by_flow) in followed.live.items():
            live[channel, name] = value
            if (channel, name) in self._terms.live:
                live[channel, (name, "tilt")] = flow.mu_x * by_flow[1] - flow.mu_z * by_flow[0]
                live[channel, (name, "inflow")] = by_flow[2]
        return values, slopes, live


def state_of(structure: Structure, x: Array) -> TrimState:
    """The eight trim quantities of x."""
    first = structure.states["collective"]
    return TrimState(*x[first : first + len(STATE_NAMES)].tolist())


def parts_of(structure: Structure, x: Array) -> tuple[TrimState, Array, Array, Array]:
    """Trim state, coordinates of the elastic twist, of all other freedoms and nodes of the inflow, flat."""
    first = structure.first_state + len(STATE_NAMES)
    others = first + len(structure.equations_of("twist"))
    return (
        state_of(structure, x),
        x[first:others],
        x[others : structure.given],
        x[structure.given :],
    )


def disk_sums(point: Point) -> DiskSums:
    """Thrust, H-force and torque at a point of a flight or of hover."""
    s, z, q = point.system.structure, point.z, point.q
    sums = [float(s.sums[name].value(z, q)[0]) for name in ("drag", "torque", "motion", "damping")]
    return DiskSums(float(q[s.measure(FZ, "one", STEADY)]), *sums)


def induced_air(problem: Problem, point: Point) -> tuple[Array, Array, Array | float]:
    """λ_i, (elements, azimuths), the swirl u, (elements,), and what of λ_i sections balance by themselves."""
    terms, structure, nodes = problem.inflow_terms, point.system.structure, point.system.nodes
    induced = part(point, UP, list(terms.names))
    balanced: Array | float = (
        0.0 if terms.interface.balanced is None else point.forces[terms.interface.balanced]
    )
    induced += balanced
    if nodes is not None:
        induced += nodes.field(point.x[structure.given :]).reshape(induced.shape)
    swirl = -point.phi[structure.first_row[UT] + structure.shapes[UT][SWIRL]]
    if problem.air.joined is not None:
        induced += problem.air.joined[0][:, None]
        swirl = swirl + problem.air.joined[1]
    return induced, swirl, balanced


def elements_of(problem: Problem, point: Point) -> BladeElements:
    """The blade elements at a point that has the flow at the sections."""
    c, f, s, x = point.channels, point.forces, point.flow, point.x
    terms, torsion, structure = problem.inflow_terms, problem.torsion, point.system.structure
    state, disk, make = state_of(structure, x), problem.disk, point.system.make
    assert isinstance(make, _Flow)
    flow = make.flow(x)
    induced, swirl, balanced = induced_air(problem, point)
    twist = None
    if torsion is not None:
        coordinates = parts_of(structure, x)[1].reshape(len(torsion.gain), -1)
        around = coordinates @ wave_grid(torsion.functions, c.shape[2]).at
        twist = TwistState(coordinates.copy(), torsion.radial.T @ around, f[M])
    bent, first = None, terms.interface.channels
    if problem.bending is not None:
        q, _ = coordinates_of(problem.bending, structure, point.z)
        modes = problem.bending.shapes[0].T @ (
            q * [-float(harmonic_of(h) ** 2) for h in range(q.shape[1])]
        )
        lift = modes @ wave_grid(q.shape[1], c.shape[2]).at
        bent = BentState(c[SLOPES[0] :], lift)
    beta = state.coning + state.flap_1c * disk.cos + state.flap_1s * disk.sin
    return BladeElements(
        state=state,
        flow=flow,
        theta=c[TH],
        u_t=c[UT],
        u_p=c[UP] + balanced,
        u_r=c[UR],
        loss=c[LOSS],
        rate=c[RATE],
        beta=beta,
        induced=induced,
        swirl=swirl,
        **section_fields(f, s),
        torsion=twist,
        bent=bent,
        rates=c[first : first + len(RATES)] if problem.unsteady else None,
    )

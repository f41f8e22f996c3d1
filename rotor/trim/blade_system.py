"""The linear equations of one blade about its trim: flap, lag and torsion with the air's slopes of the section.

    M q'' + C q' + K q = 0,    w = Σ W_k q_k up,    v = Σ V_k q_k forward,    φ = Σ Φ_k q_k nose up

in the modes of `rotor.aero.bending` and `rotor.aero.elastic`, time ψ, lengths over R, forces over ρπR²(ΩR)²/N_b. A
blade whose stiffness in bending is not known flaps as a rigid one and does not lag.

Structure. With the centre of gravity a distance x behind the pitch axis the mass lies, to first order, at
X = r − x…, Y = v + x φ sin θ and Z = w − x φ cos θ; Lagrange's equations in axes that turn (Houbolt & Brooks, NACA TR
1346, 1958; Bramwell, Helicopter Dynamics, ch. 9) give beside the modes' own mass and stiffness

    M_φw = ∫ m x (V sin θ − W cos θ) Φ,    K_φw = ∫ m x [r (V' sin θ − W' cos θ) − V sin θ] Φ
    C_jk = 2 ∫ m (Y_j X_k − Y_k X_j),      K_jk += 2 ∫ m Y_j X_k',    X = −β W + x (V' cos θ + W' sin θ + φ β cos θ)

the last two of the Coriolis forces on a blade that cones and flaps by β(ψ). Bending at another pitch than that of its
modes has the terms of `rotor.aero.bent_section`, the propeller moment those of `rotor.aero.section`.

Air. The partial derivatives of the engine's own section in unsteady attached flow (`rotor.aero.unsteady_section`,
Theodorsen with C = 1: flow at three quarters of the chord, damping of pitch, apparent mass) at every element and
azimuth of the trim, times what a motion does to the channels:

    θ: Φ φ,   U_T: V v' + V_r U_R v,   U_P: W w' + W_r U_R w + β (V − U_T V_r) v,   U_R: (V − V_r U_T) v − W_r U_P w

With `shed`, the lift follows by R. T. Jones' two lags of a flat plate (NACA Report 681, 1940): of the angle of attack α
that it feels, half at once, and x_i' = U/b (α − b_i x_i), α_e = ½ α + Σ a_i b_i x_i, with the mean speed U of each
element around the azimuth.

Left out: changes of inflow, steady bending between hinge and tip, structural damping, friction in hinges, the drive
train, and other blades.
"""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from rotor.aero.bending import build_bending, can_bend
from rotor.aero.inflow.interface import PLAIN
from rotor.aero.problem import Problem
from rotor.aero.section import CHANNELS, FX, FZ, RATE, TH, UP, UR, UT, M
from rotor.aero.unsteady_section import DTH, DUP, DUT, UnsteadyData, at_three_quarters, slopes_ahead, unsteady_interface
from rotor.dynamics.periodic import first_order
from rotor.support.arrays import Array
from rotor.trim.newton import LinearisedTrim

JONES = ((0.165, 0.0455), (0.335, 0.3))
"""a_i and b_i, the latter per semi-chord."""
_FIRST = len(CHANNELS)
_STATIONS = 2001


@dataclass(frozen=True, eq=False)
class _Mass:
    """The structure on stations along the blade and the motion of its modes there; torsion after bending."""

    r: Array
    strips: Array
    """m dr"""
    x: Array
    """How far the centre of gravity lies behind the pitch axis, over R."""
    chord: Array
    """c/R where the blade lifts, 0 inboard."""
    theta: Array
    """Mean pitch [rad]."""
    w: Array
    """W, and Φ below, without elements of the other kind, (modes, stations)."""
    w_slope: Array
    v: Array
    v_slope: Array
    phi: Array


@dataclass(frozen=True, eq=False)
class BladeSystem:
    """The equations; matrices are (n, n), periodic ones (azimuths, n, n)."""

    names: tuple[str, ...]
    """Modes by name: flap 1, lag 1, torsion 1, …"""
    scale: Array
    """Modal masses: by which shares of motion are compared, (n,)."""
    mass: Array
    """Periodic, with apparent mass."""
    damping: Array
    stiffness: Array
    elastic: Array
    """The part of `stiffness` that goes with GJ and the stiffness of the control system."""
    offset: tuple[Array, Array, Array]
    """What one chord of offset of the centre of gravity adds to mass, damping and stiffness."""
    lags: tuple[Array, Array, Array, Array] | None = None
    """States of shed vorticity: rates −U b_i/b (azimuths, lags), what drives them by q and q' (azimuths, lags, 2n), how
    they force the equations (azimuths, n, lags), and what comes off at once by q and q' (azimuths, n, 2n)."""

    def at(self, torsion: float = 1.0, offset: float = 0.0) -> Array:
        """A of z' = A z, (azimuths, states, states).

        torsion: factor on GJ and control stiffness; offset: that the centre of gravity moves aft [chords].
        """
        mass, damping, stiffness = (
            matrix + offset * by
            for matrix, by in zip((self.mass, self.damping, self.stiffness), self.offset, strict=True)
        )
        plain = first_order(mass, damping, stiffness + (torsion - 1.0) * self.elastic)
        if self.lags is None:
            return plain
        rates, drives, forces, once = self.lags
        n, count = len(self.names), rates.shape[1]
        out = np.zeros((len(mass), 2 * n + count, 2 * n + count))
        out[:, : 2 * n, : 2 * n] = plain
        out[:, n : 2 * n, : 2 * n] += np.linalg.solve(mass, once)
        out[:, n : 2 * n, 2 * n :] = np.linalg.solve(mass, forces)
        out[:, 2 * n :, : 2 * n] = drives
        out[:, range(2 * n, 2 * n + count), range(2 * n, 2 * n + count)] = rates
        return out

    def only(self, kinds: tuple[str, ...]) -> "BladeSystem":
        """This blade with the other kinds of modes held."""
        kept = [k for k, name in enumerate(self.names) if name.split()[0] in kinds]
        pair, both = np.ix_(kept, kept), [*kept, *(len(self.names) + k for k in kept)]
        lags = self.lags
        if lags is not None:
            rates, drives, forces, once = lags
            lags = rates, drives[:, :, both], forces[:, kept], once[:, kept][:, :, both]
        rows, columns = pair
        return BladeSystem(
            names=tuple(self.names[k] for k in kept),
            scale=self.scale[kept],
            mass=self.mass[:, rows, columns],
            damping=self.damping[:, rows, columns],
            stiffness=self.stiffness[:, rows, columns],
            elastic=self.elastic[pair],
            offset=(self.offset[0][pair], self.offset[1][:, rows, columns], self.offset[2][:, rows, columns]),
            lags=lags,
        )


def blade_system(linear: LinearisedTrim, *, shed: bool = False) -> BladeSystem:
    """The equations about a trim, at its azimuths; with `shed`, lift follows with the lag of shed vorticity.

    ValueError for blades that do not flap because they are held rigidly at the hub.
    """
    problem, elements = linear.problem, linear.elements
    rotor, torsion, disk = problem.design.rotor, problem.torsion, problem.disk
    if rotor.blade.rigid:
        raise ValueError("these blades are rigid and have no modes: give flap_spring_nm_rad in the rotor file")
    n_torsion = 0 if torsion is None else len(torsion.frequency)
    if can_bend(rotor):
        bending = build_bending(rotor, disk, problem.design.condition.density)
        shapes, mass, nu = bending.shapes, bending.mass, bending.frequency
        along, r, strips, damper = bending.along, bending.r, bending.strips, bending.damping
        flaps = bending.modes.flap_share > 0.5
        stiff = _at_pitch(bending.coupling, bending.reference, shapes, elements.theta, disk.dr)
    else:
        r = np.linspace(problem.flap.hinge, 1.0, _STATIONS)
        arm = np.stack([problem.arm, np.ones_like(disk.r), *np.zeros((4, len(disk.r)))])
        shapes, mass = arm[:, None], np.array([1.0 / problem.flap.load_gain])
        nu = np.sqrt([problem.flap.frequency_squared])
        along = np.stack([r - problem.flap.hinge, np.ones_like(r), *np.zeros((4, len(r)))])[:, None]
        strips, damper, flaps = _strips(problem, r), np.zeros((1, 1)), np.array([True])
        stiff = np.zeros((disk.shape[1], 1, 1))
    n_bend, n = len(mass), len(mass) + n_torsion
    names = [*_numbered("flap" if flap else "lag" for flap in flaps), *(f"torsion {k + 1}" for k in range(n_torsion))]
    masses = np.zeros((n, n))
    masses[:n_bend, :n_bend] = np.diag(mass)
    springs, damping, elastic = np.zeros((disk.shape[1], n, n)), np.zeros_like(masses), np.zeros_like(masses)
    springs[:, :n_bend, :n_bend] = np.diag(mass * nu**2) + stiff
    damping[:n_bend, :n_bend] = damper
    phi = np.zeros((n_torsion, len(r)))
    if torsion is not None:
        inertia = 1.0 / (torsion.gain * torsion.frequency**2)
        masses[n_bend:, n_bend:] = np.diag(inertia)
        springs[:, n_bend:, n_bend:] = np.diag(inertia * torsion.frequency**2) - torsion.coupling
        length = np.diff(torsion.modes.r)
        slopes = np.diff(torsion.modes.shape) / length
        pull = slopes * (torsion.modes.pull * length) @ slopes.T / torsion.moment_unit
        elastic[n_bend:, n_bend:] = np.diag(inertia * (torsion.frequency**2 - 1.0)) - pull
        phi = torsion.modes.at(r * rotor.radius)
    mean: Array = elements.theta.mean(axis=1)
    theta: Array = np.interp(r, disk.r, mean)
    chord = rotor.blade.chord(r) / rotor.radius * (r >= disk.root)
    on_blade = _Mass(r, strips, _offset(problem, r), chord, theta, along[0], along[1], along[3], along[4], phi)
    slope, rate = elements.beta, _derivative(elements.beta)
    offset, unit = (_inertia(on_blade, x, slope, rate) for x in (on_blade.x, on_blade.chord))
    none = _inertia(on_blade, np.zeros_like(r), slope, rate)
    air, lags = _air(linear, shapes, np.zeros((0, len(disk.r))) if torsion is None else torsion.radial, shed)
    return BladeSystem(
        names=tuple(names),
        scale=np.diagonal(masses).copy(),
        mass=masses + offset[0] - air[2],
        damping=damping + offset[1] - air[1],
        stiffness=springs + offset[2] - air[0],
        elastic=elastic,
        offset=(unit[0] - none[0], unit[1] - none[1], unit[2] - none[2]),
        lags=lags,
    )


def _numbered(kinds: Iterable[str]) -> list[str]:
    """flap 1, lag 1, flap 2, …"""
    seen = Counter[str]()
    out: list[str] = []
    for kind in kinds:
        seen[kind] += 1
        out.append(f"{kind} {seen[kind]}")
    return out


def _strips(problem: Problem, r: Array) -> Array:
    """m dr at even stations, of a blade that flaps as a rigid one."""
    rotor, structure = problem.design.rotor, problem.design.rotor.blade.structure
    if structure is None:
        return np.zeros_like(r)
    widths = np.full(len(r), r[1] - r[0])
    widths[[0, -1]] *= 0.5
    unit = problem.design.condition.density * np.pi * rotor.radius**2 / rotor.blades  # F/(R Ω)² [kg/m].
    return structure.at(r * rotor.radius, structure.mass_per_length) * widths / unit


def _offset(problem: Problem, r: Array) -> Array:
    """How far the centre of gravity lies behind the pitch axis, over R: as the structure says, and at the swept tip."""
    rotor, structure = problem.design.rotor, problem.design.rotor.blade.structure
    swept = problem.design.models.has("swept_tip")
    behind = np.maximum(r - rotor.blade.tip_sweep_start, 0.0) * (np.tan(rotor.blade.tip_sweep) if swept else 0.0)
    if structure is None or not structure.mass_offset:
        return behind
    return behind + structure.at(r * rotor.radius, structure.mass_offset) / rotor.radius


def _at_pitch(coupling: Array, reference: Array, shapes: Array, theta: Array, dr: Array) -> Array:
    """What the pitch in the trim changes in the stiffness of bending, (azimuths, modes, modes)."""
    cosine, sine = np.cos(2.0 * theta) - reference[0][:, None], np.sin(2.0 * theta) - reference[1][:, None]
    w, v = shapes[2], shapes[5]
    weight = (coupling * dr)[:, None]

    def over(first: Array, second: Array, along: Array) -> Array:
        return np.einsum("ki,li,ij->jkl", first, second, weight * along)

    return over(w, v, sine) + over(v, w, sine) + over(v, v, cosine) - over(w, w, cosine)


def _inertia(on: _Mass, x: Array, slope: Array, rate: Array) -> tuple[Array, Array, Array]:
    """Mass (n, n), damping and stiffness (azimuths, n, n) of an offset x and of Coriolis forces; slope, rate: β, β'."""
    bend, n = len(on.w), len(on.w) + len(on.phi)
    sine, cosine = np.sin(on.theta), np.cos(on.theta)
    mass, stiffness = np.zeros((n, n)), np.zeros((n, n))
    m, lever = on.strips, on.strips * x
    mass[:bend, bend:] = (on.v * sine - on.w * cosine) * lever @ on.phi.T
    pulled = on.r * (on.v_slope * sine - on.w_slope * cosine) - on.v * sine
    stiffness[:bend, bend:] = pulled * lever @ on.phi.T
    forward = np.concatenate([on.v, x * sine * on.phi])
    none = np.zeros_like(on.phi)
    steady = np.concatenate([x * (on.v_slope * cosine + on.w_slope * sine), none])
    coned = np.concatenate([-on.w, x * cosine * on.phi])  # Times β.
    at_rest, by_slope = (2.0 * (forward * m @ rows.T) for rows in (steady, coned))
    damping = (at_rest - at_rest.T) + slope[:, None, None] * (by_slope - by_slope.T)
    return mass + mass.T, damping, stiffness + stiffness.T + rate[:, None, None] * by_slope


def _derivative(around: Array) -> Array:
    """d/dψ of functions of azimuth along the last axis, by their Fourier series."""
    count = around.shape[-1]
    waves = np.arange(count // 2 + 1, dtype=float)
    waves[-1] *= count % 2  # The highest of an even number has no derivative that it resolves.
    return np.fft.irfft(1j * waves * np.fft.rfft(around, axis=-1), count, axis=-1)


_Motion = dict[int, tuple[Array, Array, Array]]
"""What q, q' and q'' do to a channel, (n, elements, azimuths) each."""


def _air(
    linear: LinearisedTrim, shapes: Array, phi: Array, shed: bool
) -> tuple[tuple[Array, Array, Array], tuple[Array, Array, Array, Array] | None]:
    """Generalised forces of the air by q, q' and q'', (azimuths, n, n), and the lags of shed vorticity."""
    problem, e = linear.problem, linear.elements
    plain = problem.section_data()
    data = problem.unsteady_data(plain, plain)
    c = np.zeros((_FIRST + 3, *e.theta.shape))
    c[:_FIRST] = e.theta, e.u_t, e.u_p, e.u_r, e.loss, e.rate
    for channel, source in ((DTH, c[RATE]), (DUT, c[UT]), (DUP, c[UP] - e.induced)):
        c[_FIRST + channel] = _derivative(source)
    interface = unsteady_interface(PLAIN)
    _, slopes, _ = interface.section(c, data, True, False)
    motion = _motion(e.u_t, e.u_p, e.u_r, e.beta, shapes, phi)
    n_bend, n = shapes.shape[1], shapes.shape[1] + len(phi)
    # A blade rigid in torsion has no slopes of the moment: what stands in their rows is undefined.
    forces = (FZ, FX, M) if len(phi) else (FZ, FX)
    weights = {force: np.zeros((n, len(problem.disk.r))) for force in forces}
    weights[FZ][:n_bend], weights[FX][:n_bend] = shapes[0], -shapes[3]
    if len(phi):
        weights[M][n_bend:] = phi
    out = [np.zeros((len(problem.disk.psi), n, n)) for _ in range(3)]
    for (force, channel), slope in zip(interface.pairs, slopes, strict=True):
        if force not in weights or channel not in motion:
            continue
        along = weights[force] * problem.disk.dr
        for k, by in enumerate(motion[channel]):
            if by.any():
                out[k] += np.einsum("ai,ij,bij->jab", along, slope, by)
    return (out[0], out[1], out[2]), _lags(linear, c, data, motion, weights) if shed else None


def _motion(u_t: Array, u_p: Array, u_r: Array, beta: Array, shapes: Array, phi: Array) -> _Motion:
    """What the modes do to the channels; shapes: W, W', W'', V, V', V'' of bending, phi: of torsion."""
    n_bend, none = shapes.shape[1], np.zeros((shapes.shape[1] + len(phi), *u_t.shape))

    def of_bending(value: Array) -> Array:
        out = none.copy()
        out[:n_bend] = value
        return out

    twisted = none.copy()
    twisted[n_bend:] = phi[:, :, None]
    w, w_slope, v, v_slope = (shapes[k][:, :, None] for k in (0, 1, 3, 4))
    motion: _Motion = {
        TH: (twisted, none, none),
        RATE: (none, twisted, none),
        UT: (of_bending(v_slope * u_r), of_bending(v), none),
        UP: (of_bending(w_slope * u_r + beta * (v - v_slope * u_t)), of_bending(w), none),
        UR: (of_bending(v - v_slope * u_t - w_slope * u_p), none, none),
    }
    for channel, source in ((DTH, RATE), (DUT, UT), (DUP, UP)):
        by_q, by_rate, _ = motion[source]
        motion[_FIRST + channel] = _derivative(by_q), by_q + _derivative(by_rate), by_rate
    return motion


def _lags(
    linear: LinearisedTrim, c: Array, data: UnsteadyData, motion: _Motion, weights: dict[int, Array]
) -> tuple[Array, Array, Array, Array]:
    """The four of `BladeSystem.lags`: two states an element."""
    problem = linear.problem
    half_chord, inertia = problem.half_chord[:, None], data.section.inertia
    within, (_, _, ahead) = at_three_quarters(c[:_FIRST], problem.half_chord), slopes_ahead(c, problem.half_chord)
    _, slopes, _ = PLAIN.section(within, data.section, True, False)
    by_alpha = {force: slope for (force, channel), slope in zip(PLAIN.pairs, slopes, strict=True) if channel == TH}
    if len(inertia):
        by_alpha[M] = by_alpha[M] + inertia[:, None] * np.cos(2.0 * within[TH])  # Without the propeller moment.
    forced = sum(np.einsum("ai,ij->aij", weights[f] * problem.disk.dr, by_alpha[f]) for f in weights if f in by_alpha)
    square = c[UT] ** 2 + c[UP] ** 2 + 1e-30
    felt = [
        motion[TH][k] + (c[UP] * motion[UT][k] - c[UT] * motion[UP][k]) / square + motion[RATE][k] * ahead
        for k in range(2)
    ]
    alpha = np.concatenate(felt)  # By q, then by q', (2n, elements, azimuths).
    speed = np.broadcast_to(np.sqrt(square).mean(axis=1, keepdims=True) / half_chord, square.shape)
    rates = np.concatenate([-speed * b for _, b in JONES]).T
    drives = np.concatenate([speed * alpha] * len(JONES), axis=1).transpose(2, 1, 0)
    forces = np.concatenate([forced * (a * b) for a, b in JONES], axis=1).transpose(2, 0, 1)
    once = -sum(a for a, _ in JONES) * np.einsum("aij,bij->jab", forced, alpha)
    return rates, drives, forces, once

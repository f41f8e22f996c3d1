"""Hover and axial flight by blade element momentum theory, annulus by annulus (thesis §2.4), as a system of the engine.

Each annulus balances the momentum it gives the air with the lift of its blade elements,

    4 F λ_i|λ| r = dC_T/dr(θ, r − u, λ),    λ = λ_c + λ_i,    u: swirl of λ_i λ

which is (2.24) with Prandtl's F; λ_c = 0 in hover. With a lift curve C_lα α it closes as eq. (2.28), in hover (3.3). So
the section balances itself, at one azimuth: its pitch is the only channel that matters, and dλ/dθ follows from the
balance by the implicit function theorem. What remains are collective, coning and the steady elastic twist.
"""

import math
from collections.abc import Hashable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rotor.aero.elements import (
    BladeElements,
    TrimState,
    TwistState,
    Unknown,
    over_azimuths,
    section_fields,
)
from rotor.aero.inflow.interface import DiskFlow
from rotor.aero.inflow.local_momentum import BALANCED, MOST_PASSES, balancing_step, bracket_of
from rotor.aero.losses import HUB_FACTOR, end_factor
from rotor.aero.momentum import axial_inflow, is_windmill
from rotor.aero.problem import Problem, swirl_of
from rotor.aero.section import (
    CHANNELS,
    FORCES,
    FX,
    FZ,
    LOSS,
    PAIRS,
    TH,
    UP,
    UT,
    M,
    SectionData,
    section,
)
from rotor.airfoil.sections import Section
from rotor.columns.bending import freedoms_of
from rotor.columns.blade import Torsion
from rotor.columns.trims import Trim, add_equations, declare_equations, trim_numbers
from rotor.engine.linearise import Grid, Live, Point, Shapes, System
from rotor.engine.terms import ONE, Shape, Structure
from rotor.engine.waves import STEADY, wave_grid
from rotor.support.arrays import Array
from rotor.support.bytes_cache import bytes_cache
from rotor.support.compiled import compiled

LIFT_CURVE_MACH = 0.3
"""Mach number at which the linear lift curve of (3.3) is read off; the document's polar has no other."""


def closed_form_inflow(
    r: ArrayLike,
    pitch: ArrayLike,
    solidity: ArrayLike,
    lift_slope: float,
    *,
    factor: ArrayLike = 1.0,
    climb: float = 0.0,
) -> Array:
    """λ(r) of eq. (2.28), with the loss factor F of eq. (3.3), for a linear lift curve.

    pitch θ [rad] from the zero-lift line, lift_slope C_lα [1/rad], climb λ_c; shapes broadcast. (3.3) is (2.28) with
    λ_c = 0 and σ → σ/F, the outer 1/F included; it closes 4Fλ²r = ½σC_lα(θr² − λr). Below zero pitch the mirrored root
    is taken.
    """
    r, pitch = np.asarray(r, dtype=float), np.asarray(pitch, dtype=float)
    k = np.asarray(solidity, dtype=float) * lift_slope / (16.0 * np.asarray(factor, dtype=float))
    sign = np.where(pitch * r < climb, -1.0, 1.0)
    half = k - sign * 0.5 * climb
    return sign * (np.sqrt(half**2 + 2.0 * k * sign * pitch * r) - half)


def lift_curve(problem: Problem) -> tuple[Array, Array]:
    """C_lα [1/rad] and the zero-lift pitch [rad] of each element's linear lift curve, (elements,); blended sections."""
    disk = problem.disk
    slopes, zeros = np.array([_straight_line(item, LIFT_CURVE_MACH) for item in disk.sections]).T
    first, second = disk.section.T
    return (
        slopes[first] + disk.weight * (slopes[second] - slopes[first]),
        zeros[first] + disk.weight * (zeros[second] - zeros[first]),
    )


@bytes_cache
def _straight_line(section_: Section, mach: float) -> tuple[float, float]:
    zero = float(section_.table.zero_lift_alpha(mach)) + section_.incidence_offset
    return float(section_.table.lift_slope(mach)), zero


class Annuli(NamedTuple):
    """What the balance of annuli needs beside their pitch, for compiled code."""

    r: Array
    climb: Array
    """λ_c with an axisymmetric gust."""
    windmill: bool
    """Whether the wake goes with the wind, against the thrust."""
    swirls: bool
    ends: Array
    """f times |λ| of Prandtl's factors at tip and root, (2, elements); infinite where there is no loss."""
    slope: Array
    """C_lα of the linear lift curve, for the closed form (3.3); empty with section data."""
    zero: Array
    """Zero-lift pitch of the element."""


class AnnulusData(NamedTuple):
    """What the section of an annulus needs beside the channels."""

    annuli: Annuli
    section: SectionData
    start: Array
    """Inflow from which the search begins, (elements,): the last one found."""


LOADED = (FZ, FX, M)
"""Forces of an annulus; no air flows along the blade."""
HOVER_PAIRS = (*((force, TH) for force in LOADED), (BALANCED, TH))
"""An annulus follows its pitch alone."""
_ROW = {pair: k for k, pair in enumerate(PAIRS)}
_FZ_TH, _FZ_UT, _FZ_UP = _ROW[FZ, TH], _ROW[FZ, UT], _ROW[FZ, UP]

_compile = compiled(error_model="numpy")


def _annulus_section(
    c: Array, data: AnnulusData, slopes: bool, flow: bool
) -> tuple[Array, Array, Array]:
    """The section with the inflow that balances its annulus; as `section.section`, with the rows `HOVER_PAIRS`."""
    theta = c[TH, :, 0].copy()
    inflow, answer = _balanced(theta, data.start, data.annuli, data.section)
    data.start[:] = np.nan_to_num(inflow) if data.annuli.windmill else inflow
    channels, turning = _channels(theta, inflow, data.annuli)
    f, d, s = section(channels, data.section, slopes, flow)
    f = np.concatenate([f, inflow[None, :, None]])
    if not slopes:
        return f, np.zeros((len(HOVER_PAIRS), 0, 1)), s
    if not len(data.section.moment_gain):
        d[[_ROW[M, channel] for channel in (TH, UT, UP)]] = 0.0  # A rigid blade has no moment.
    by_inflow = {o: d[_ROW[o, UP]] - d[_ROW[o, UT]] * turning[:, None] for o in LOADED}
    by_theta = answer[:, None]
    return f, np.array([*(d[_ROW[o, TH]] + by_inflow[o] * by_theta for o in LOADED), by_theta]), s


@_compile
def _channels(theta: Any, inflow: Any, annuli: Any) -> Any:
    """Channels of the section, (channels, elements, 1), and the slope of the swirl by λ_i, (elements,)."""
    channels, turning = np.zeros((6, len(theta), 1)), np.zeros(len(theta))
    for i in range(len(theta)):
        total, r = inflow[i] + annuli.climb[i], annuli.r[i]
        channels[TH, i, 0], channels[UT, i, 0], channels[UP, i, 0], channels[LOSS, i, 0] = (
            theta[i],
            r,
            total,
            1.0,
        )
        if annuli.swirls:
            swirl, slope = swirl_of(r, inflow[i] * total)
            channels[UT, i, 0] -= swirl
            turning[i] = (inflow[i] + total) * slope
    return channels, turning


@_compile
def _balance(
    theta: Any, inflow: Any, annuli: Any, half_solidity: Any, f: Any, d: Any, turning: Any
) -> Any:
    """Momentum less lift of every annulus, its slope by λ_i, the lift, and its slope by pitch; last the slope of an
    annulus whose lift falls with λ_i or not at all, (5, elements). f, d: of the section; turning: of `_channels`."""
    out, closed = np.empty((5, len(theta))), len(annuli.slope) > 0
    for i in range(len(theta)):
        r, total = annuli.r[i], inflow[i] + annuli.climb[i]
        (tip, tip_slope), (hub, hub_slope) = (
            end_factor(annuli.ends[0, i], total),
            end_factor(annuli.ends[1, i], total),
        )
        factor, slope, size = tip * hub, tip_slope * hub + tip * hub_slope, abs(total)
        signed = math.copysign(inflow[i], inflow[i] * total)
        momentum = 4.0 * r * (size * (2.0 * factor + slope * inflow[i]) + factor * (signed - size))
        if closed:  # Small angles and a linear lift curve, as (2.28) takes it.
            gain = half_solidity[i] * annuli.slope[i]
            lift, by_inflow = gain * ((theta[i] - annuli.zero[i]) * r**2 - total * r), -gain * r
            out[3, i] = gain * r**2
        else:
            lift, by_inflow = f[FZ, i, 0], d[_FZ_UP, i, 0] - d[_FZ_UT, i, 0] * turning[i]
            out[3, i] = d[_FZ_TH, i, 0]
        out[0, i], out[1, i] = 4.0 * factor * inflow[i] * size * r - lift, momentum - by_inflow
        out[2, i], out[4, i] = lift, momentum - min(by_inflow, 0.0)
    return out


def _balanced(theta: Array, start: Array, annuli: Annuli, data: SectionData) -> tuple[Array, Array]:
    """λ_i that balances every annulus, and dλ_i/dθ, (elements,) both: Newton's method with a bracket.

    As a windmill an annulus has up to three balances. The first on the way from λ_i = 0 is that of momentum theory, so
    where momentum falls faster than lift the way back is taken. In the turbulent state it has no such balance: NaN.
    """
    inflow, bracket, left = start.copy(), bracket_of(len(start)), MOST_PASSES
    if annuli.windmill:  # The disk does not turn the wind back.
        for end, here in zip(bracket, (annuli.climb > 0.0, annuli.climb <= 0.0), strict=True):
            end[here] = -annuli.climb[here]
    while True:  # Here and not in a kernel, whose compiler would make another copy of the section.
        channels, turning = _channels(theta, inflow, annuli)
        f, d, _ = section(channels, data, not len(annuli.slope), False)
        balance = _balance(theta, inflow, annuli, data.half_solidity, f, d, turning)
        if annuli.windmill:
            falls = balance[4] <= 0.0
            balance[0, falls] = np.copysign(1.0, inflow[falls])
        if left == 0 or not balancing_step(inflow, bracket, balance[0], balance[1], balance[2]):
            break
        left -= 1
    if annuli.windmill:
        inflow[np.abs(balance[0]) > 1e-9 + 1e-6 * np.abs(balance[2])] = np.nan
    return inflow, balance[3] / np.maximum(balance[1], 1e-12)


@bytes_cache
def _structure(modes: int, trim: Trim, numbers: tuple[Hashable, ...]) -> Structure:
    """Atoms, columns and equations of a trim for thrust and coning, and of steady twist."""
    s = Structure(HOVER_PAIRS, len(CHANNELS), len(FORCES) + 1, ("hover", modes, trim))
    for number in numbers:
        s.number(number)
    twist = Torsion(modes, 1)
    for name in ("collective", "coning", *twist.states):
        s.state(name)
    s.column(TH, "one", STEADY, 1.0, s.states["collective"])
    for name in ("drag", "motion", "damping"):
        s.sum(name, [])
    torque = s.measure(FX, "r", STEADY)
    for name in ("torque", "power", "power on a stand"):
        s.sum(name, [(1.0, ONE, ONE, torque)])
    declare_equations(s, trim)
    add_equations(s, trim, [], [])
    twist.build(s)
    return s.finish([s.states[name] for name in (*trim.unknowns, *twist.states)])


def _nothing_made(x: Array) -> tuple[Array, Array, Live]:
    del x
    return np.zeros(0), np.zeros((0, 0)), {}


def hover_system(problem: Problem, ct: float | None = None) -> System:
    """The equations of a hovering design at C_T `ct`, at one azimuth; tolerances are those of the caller.

    `ct`: sign and size of the thrust, by which axial wind finds its state; left out, that to be trimmed.
    """
    design, disk, torsion = problem.design, problem.disk, problem.torsion
    models, stand = design.models, design.condition.stand
    solved: tuple[Unknown, ...] = (
        () if stand is not None and stand.collective is not None else ("collective",)
    )
    cones: tuple[Unknown, ...] = (
        ("coning",) if models.flapping and design.rotor.precone is None else ()
    )
    trim = Trim((*solved, *cones), (*("thrust" for _ in solved), *cones))
    values: dict[Hashable, float] = {**trim_numbers(problem)}
    shapes: dict[Shape, Array] = {"one": np.ones_like(disk.r), "r": disk.r, "arm": problem.arm}
    for freedom in freedoms_of(problem, 1):
        values |= freedom.numbers(problem)
        shapes |= freedom.shapes(problem)
    structure = _structure(0 if torsion is None else len(torsion.gain), trim, tuple(values))
    closed = models.hover_inflow == "closed-form"
    far, none = np.full_like(disk.r, math.inf), np.zeros(0)
    tip = 0.5 * problem.tip_spacing * disk.blades * (1.0 - disk.r) if models.tip_loss else far
    ends = np.stack([tip, 0.5 * HUB_FACTOR * (disk.r - disk.root) if models.hub_loss else far])
    windmill = is_windmill(problem.weight if ct is None else ct, problem.air.climb)
    thrust = math.copysign(problem.scale, problem.weight) if ct is None else ct
    (slope, zero), gust = lift_curve(problem) if closed else (none, none), problem.air.gust
    climb = (
        np.full_like(disk.r, problem.air.climb) if gust is None else problem.air.climb + gust[:, 0]
    )
    data = AnnulusData(
        Annuli(
            r=disk.r,
            climb=climb,
            windmill=windmill,
            swirls=models.has("swirl"),
            ends=ends,
            slope=slope,
            zero=zero,
        ),
        section=problem.section_data(len(disk.psi)),
        start=np.full_like(disk.r, 0.0 if windmill else axial_inflow(thrust, problem.air.climb)),
    )
    steady = np.zeros((structure.channels, len(disk.r)))
    steady[TH], steady[UT], steady[LOSS] = problem.twist, disk.r, 1.0
    grid = Grid(wave_grid(structure.waves, 1), steady, {}, data)
    along, numbers = Shapes(structure, shapes, disk.dr), np.array([1.0, *values.values()])
    tolerance, limits = (size * np.ones(len(structure.equations)) for size in (problem.scale, 1.0))
    return System(
        structure, along, grid, grid, _annulus_section, _nothing_made, numbers, tolerance, limits
    )


def hover_elements(problem: Problem, point: Point) -> BladeElements:
    """The hovering rotor as blade elements over the whole disk; `point` has the flow at the sections."""
    disk, torsion, structure = problem.disk, problem.torsion, point.system.structure
    azimuths, f, s, states = len(disk.psi), point.forces, point.flow, structure.states
    channels, inflow = _at_balance(point)[0][:, :, 0], f[BALANCED, :, 0]
    collective, coning = (float(point.x[states[name]]) for name in ("collective", "coning"))
    lambda0 = axial_inflow(float(disk.dr @ f[FZ, :, 0]), problem.air.climb)
    everywhere = partial(over_azimuths, azimuths=azimuths)
    twist = None
    if torsion is not None:
        coordinates = np.zeros_like(problem.given_torsion)
        coordinates[:, 0] = point.x[
            [atom for name, atom in states.items() if isinstance(name, tuple)]
        ]
        twist = TwistState(
            coordinates, everywhere(torsion.radial.T @ coordinates[:, 0]), everywhere(f[M, :, 0])
        )
    return BladeElements(
        state=TrimState(collective=collective, coning=coning, lambda0=lambda0),
        flow=DiskFlow(0.0, problem.air.climb, lambda0),
        theta=everywhere(channels[TH]),
        u_t=everywhere(channels[UT]),
        u_p=everywhere(channels[UP]),
        u_r=np.zeros(disk.shape),
        loss=np.ones(disk.shape),
        rate=np.zeros(disk.shape),
        beta=np.full(azimuths, coning),
        induced=everywhere(inflow),
        swirl=disk.r - channels[UT],
        **section_fields(np.repeat(f, azimuths, axis=2), np.repeat(s, azimuths, axis=2)),
        torsion=twist,
    )


def _at_balance(point: Point) -> tuple[Array, Array]:
    """`_channels` at a point."""
    return _channels(
        point.channels[TH, :, 0].copy(), point.forces[BALANCED, :, 0].copy(), point.grid.data.annuli
    )


def turning_of(point: Point) -> Array:
    """∂(swirl)/∂λ_i of each annulus, (elements,)."""
    return _at_balance(point)[1]

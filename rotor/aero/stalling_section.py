"""The section with dynamic stall: static forces, what `dynamic_stall` adds, and how both follow the channels.

What is added to C_n and C_c is turned by the angle from zero lift x into lift and drag,

    ΔC_l = ΔC_n cos x + ΔC_c sin x,    ΔC_d = ΔC_n sin x − ΔC_c cos x

The circulation of a lifting line stays that of attached flow: its wake sheds as before.
"""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.dynamic_stall import (
    ADDED,
    DECAYING,
    INPUTS,
    LINKS,
    SEPARATION,
    STATES,
    VORTEX,
    StallData,
    empty_lags,
    stall_states,
    window,
)  # fmt: skip
from rotor.aero.inflow.interface import SectionInterface
from rotor.aero.look_up import wrapped
from rotor.aero.section import (
    FR,
    FX,
    FZ,
    LOSS,
    TH,
    UP,
    UR,
    UT,
    M,
    SectionData,
    angles_of_attack,
    of_double_angle,
)
from rotor.airfoil.stall_onset import ZERO
from rotor.engine.memory import LagFactors, Lags
from rotor.support.arrays import Array
from rotor.support.compiled import compiled

_compile = compiled(error_model="numpy")


class StallingData(NamedTuple):
    """Data of a section with dynamic stall."""

    section: SectionData
    stall: StallData


@_compile
def _inputs(
    c: Any,
    i: int,
    section: Any,
    stall: Any,
    inputs: Any,
    y: Any,
    weight: Any,
    zero: Any,
    right: Any,
) -> None:
    """x and M of one row, y from zero lift, its weight with slope; slopes of α and M by the channels in `right`."""
    cos, sin, tip = section.cos_sweep[i], section.sin_sweep[i], stall.tip_mach
    numbers = stall.numbers[i]
    last = numbers.shape[1] - 1
    angles_of_attack(c[TH, i], c[UT, i], c[UP, i], y)
    for j in range(len(y)):
        t, p, r = c[UT, i, j], c[UP, i, j], c[UR, i, j]
        normal = t * cos - r * sin
        v = np.sqrt(normal * normal + p * p + 1e-30)
        place = min(v * tip * last, last - 1e-9)
        cell = int(place)
        rise = numbers[ZERO, cell + 1] - numbers[ZERO, cell]
        y[j] = wrapped(y[j] - numbers[ZERO, cell] - rise * (place - cell))
        zero[j] = rise * last if v * tip < 1.0 else 0.0
        weight[0, j], weight[1, j] = window(y[j])
        inputs[0, j], inputs[1, j] = y[j] * weight[0, j], v * tip
    for j in range(len(y) if right.shape[2] > 0 else 0):
        t, p, r = c[UT, i, j], c[UP, i, j], c[UR, i, j]
        normal, square, v = t * cos - r * sin, t * t + p * p + 1e-30, inputs[1, j] / tip
        right[0, TH, i, j], right[0, UT, i, j], right[0, UP, i, j] = 1.0, p / square, -t / square
        right[1, UT, i, j], right[1, UP, i, j] = tip * normal * cos / v, tip * p / v
        right[1, UR, i, j] = -tip * normal * sin / v


@_compile
def _added(c: Any, data: Any, slopes: bool) -> Any:
    """ΔC_l, ΔC_d and ΔC_m, `STATES`, and with slopes what the memory is made of.

    That is: slopes of the three by `ADDED` and by the angle from zero lift, (3, 4, elements, azimuths); slope of x by
    this angle; the inner arrays of the lags; slopes of this angle and of M by the channels.
    """
    section, stall = data
    n, m = c.shape[1:]
    out, states = np.zeros((3, n, m)), np.zeros((len(STATES), n, m))
    elements = n if slopes else 0
    turn, by_angle, lags = (
        np.zeros((3, 4, elements, m)),
        np.empty((elements, m)),
        empty_lags(elements, m),
    )
    right = np.zeros((len(INPUTS), c.shape[0], elements, m))
    inputs, y, weight, zero = np.empty((len(INPUTS), m)), np.empty(m), np.empty((2, m)), np.empty(m)
    inside, falls = weight[0], weight[1]
    added, shown = np.empty((len(ADDED), m)), np.empty((len(STATES), m))
    for i in range(n):
        _inputs(c, i, section, stall, inputs, y, weight, zero, right)
        stall_states(i, inputs[0], inputs[1], stall, slopes, added, lags, shown)
        for j in range(m):
            sin, cos = of_double_angle(0.5 * inputs[0, j])
            out[0, i, j] = inside[j] * (added[0, j] * cos + added[1, j] * sin)
            out[1, i, j] = inside[j] * (added[0, j] * sin - added[1, j] * cos)
            out[2, i, j] = inside[j] * added[2, j]
        for j in range(m if slopes else 0):
            sin, cos = of_double_angle(0.5 * inputs[0, j])
            lift, drag = (
                added[0, j] * cos + added[1, j] * sin,
                added[0, j] * sin - added[1, j] * cos,
            )
            by_angle[i, j] = inside[j] + y[j] * falls[j]  # Of x = y w(y).
            turn[0, 0, i, j], turn[0, 1, i, j] = inside[j] * cos, inside[j] * sin
            turn[1, 0, i, j], turn[1, 1, i, j] = inside[j] * sin, -inside[j] * cos
            turn[2, 2, i, j], turn[2, 3, i, j] = inside[j], falls[j] * added[2, j]
            turn[0, 3, i, j] = falls[j] * lift - inside[j] * drag * by_angle[i, j]
            turn[1, 3, i, j] = falls[j] * drag + inside[j] * lift * by_angle[i, j]
        for k in range(len(STATES)):
            for j in range(m):
                states[k, i, j] = shown[k, j] * inside[j]
        for j in range(m):
            states[SEPARATION, i, j] += 1.0 - inside[j]
        for channel in range(len(c) if slopes else 0):
            for j in range(m):
                right[0, channel, i, j] -= zero[j] * right[1, channel, i, j]
    return out, states, turn, by_angle, lags, right


def added_to(c: Array, data: StallingData) -> tuple[Array, Array]:
    """ΔC_l, ΔC_d, ΔC_m, (3, elements, azimuths), and `dynamic_stall.STATES`, (4, elements, azimuths)."""
    return _added(c, data, False)[:2]


def _with_shown(flow: Array, states: Array, added: Array) -> Array:
    """The flow with the fields of `rotor.aero.elements.Unsteady`."""
    return np.concatenate([flow, states[[SEPARATION, VORTEX]], added[2:]])


def _memory(c: Array, data: StallingData, forces: int) -> LagFactors:
    """How forces follow what is added, with the inputs around the azimuth."""
    section = data.section
    _, _, turn, by_angle, (linked, decays, factors, places), right = _added(c, data, True)
    t, p, r = c[UT], c[UP], c[UR] if section.yawed else np.zeros_like(c[UR])
    u = np.hypot(t, p)
    k, along = section.half_solidity[:, None] * u, section.half_solidity[:, None] * np.hypot(u, r)
    lift = c[LOSS] if section.lossy else 1.0
    left = np.zeros((forces, 3, *c.shape[1:]))
    left[FZ, 0], left[FZ, 1] = k * lift * t, -along * p
    left[FX, 0], left[FX, 1] = k * lift * p, along * t
    left[FR, 1] = along * r
    if len(section.moment_gain):
        left[M] = -section.lag[:, None] * left[FZ]
        left[M, 2] += section.moment_gain[:, None] * u * u
    if len(section.unloaded):
        left *= ~section.unloaded
    lags = Lags(LINKS, DECAYING, linked, by_angle, decays, factors, places)
    return LagFactors(np.einsum("oaei,akei->okei", left, turn), lags, right)


@lru_cache(maxsize=8)
def stalling_interface(inner: SectionInterface) -> SectionInterface:
    """The interface of a section with dynamic stall; partial derivatives are those at what is added."""

    def section(
        c: Array, data: StallingData, slopes: bool, flow: bool
    ) -> tuple[Array, Array, Array]:
        added, states = added_to(c, data)
        f, d, s = inner.section(c, data.section._replace(added=added), slopes, flow)
        return f, d, _with_shown(s, states, added) if flow else s

    def memory(c: Array, data: StallingData) -> LagFactors:
        return _memory(c, data, inner.forces)

    return SectionInterface(section, inner.pairs, inner.channels, inner.forces, None, memory)

"""The section of a blade that bends: velocities turned into its axes, forces turned back, and the coupling of bending
with pitch; with partial derivatives.

Channels are then relative to axes that turn with the hub, along the undeformed blade. At slopes w' up and v' forward

    U_T' = U_T + v' U_R,    U_P' = U_P + w' U_R − w' v' U_T,    U_R' = U_R − v' U_T − w' U_P

and forces go back by the transposed matrix, F_x U_T − F_z U_P + F_r U_R being the same in both: so the lift of a
blade that slopes up leans inboard, F_r = … − w' F_z, and no energy is lost.

Bending has its stiffness at a pitch of reference θ0 in the equations' own numbers; what the pitch θ changes is here.
With the curvatures κ and b = ½ (EI_l − EI_f), from the energy ½ (EI_f κ_flap² + EI_l κ_lag²) along turned axes,

    M_w = b (κ_v Δsin 2θ − κ_w Δcos 2θ),    M_v = b (κ_w Δsin 2θ + κ_v Δcos 2θ),    Δ: at θ less at θ0
    M   = … − b [(κ_w² − κ_v²) sin 2θ + 2 κ_w κ_v cos 2θ]

The last is the moment of a bent blade about its pitch axis (Houbolt & Brooks, NACA TR 1346, 1958). From the Coriolis
forces of a blade that shortens, −½ ∫ (w'² + v'²) dr, with B = ∫_r^R m v̇ dr: E = w'² + v'², G_w = 2 w' B, G_v = 2 v' B.
"""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from rotor.aero.inflow.interface import SectionInterface, places_of
from rotor.aero.section import FR, FX, FZ, TH, UP, UR, UT, M, of_double_angle
from rotor.engine.memory import LagFactors
from rotor.support.arrays import Array
from rotor.support.compiled import compiled

SLOPES = (SW, SV, KW, KV, B) = tuple(range(-5, 0))
"""Channels w', v', κ_w, κ_v and B: the last five."""
BENDING = (E, GW, GV, MW, MV) = tuple(range(-5, 0))
"""Forces: the last five."""


class BentData(NamedTuple):
    """Data of a section that bends."""

    section: Any
    """Data of the section within."""
    coupling: Array
    """b, (elements,)."""
    reference: Array
    """cos 2θ0 and sin 2θ0, (2, elements)."""
    share: Array
    """By what an element stands for the blade inboard of the first as well, in E, G_w and G_v, (elements,)."""


_compile = compiled(error_model="numpy")


def turned(c: Array, first: int) -> Array:
    """The channels of a section, the first ones of all, in its own axes; those of its slopes begin at `first`."""
    out = c[:first].copy()
    t, p, r, w, v = c[UT], c[UP], c[UR], c[first], c[first + 1]
    out[UT], out[UP], out[UR] = t + v * r, p + w * r - w * v * t, r - v * t - w * p
    return out


@_compile
def _back(z: Any, x: Any, r: Any, w: Any, v: Any) -> Any:
    """F_z, F_x and F_r in axes of the hub, from those in axes of the section."""
    return z + w * r, x + w * v * z - v * r, r + v * x - w * z


@_compile
def _by_hub(by_t: Any, by_p: Any, by_r: Any, t: Any, p: Any, r: Any, w: Any, v: Any) -> Any:
    """Slopes by U_T, U_P, U_R, w' and v', from those by the velocities in axes of the section."""
    by_w, by_v = by_p * (r - v * t) - by_r * p, by_t * r - by_p * w * t - by_r * t
    return by_t - w * v * by_p - v * by_r, by_p - w * by_r, v * by_t + w * by_p + by_r, by_w, by_v


@_compile
def _turn_back(c: Any, first: int, f: Any, forces: int, data: Any, out: Any) -> None:
    """All forces in axes of the hub, with those of bending."""
    coupling, reference, share = data
    for i in range(c.shape[1]):
        for j in range(c.shape[2]):
            for o in range(forces):
                out[o, i, j] = f[o, i, j]
            w, v = c[first, i, j], c[first + 1, i, j]
            kw, kv, b = c[first + 2, i, j], c[first + 3, i, j], c[first + 4, i, j]
            out[FZ, i, j], out[FX, i, j], out[FR, i, j] = _back(
                f[FZ, i, j], f[FX, i, j], f[FR, i, j], w, v
            )
            sine, cosine = of_double_angle(c[TH, i, j])
            out[M, i, j] -= coupling[i] * ((kw * kw - kv * kv) * sine + 2.0 * kw * kv * cosine)
            out[forces, i, j] = share[i] * (w * w + v * v)
            out[forces + 1, i, j] = 2.0 * share[i] * w * b
            out[forces + 2, i, j] = 2.0 * share[i] * v * b
            cosine -= reference[0, i]
            sine -= reference[1, i]
            out[forces + 3, i, j] = coupling[i] * (kv * sine - kw * cosine)
            out[forces + 4, i, j] = coupling[i] * (kw * sine + kv * cosine)


@_compile
def _slopes_back(
    c: Any, first: int, f: Any, d: Any, rows: Any, place: Any, data: Any, out: Any
) -> None:
    """Partial derivatives of all forces by all channels; rows: those of the section, place: those here, by pair."""
    coupling, reference, share = data
    forces, channels = rows.shape
    full = np.zeros((forces, channels + 2, c.shape[2]))
    for i in range(c.shape[1]):
        t, p, r, w, v = c[UT, i], c[UP, i], c[UR, i], c[first, i], c[first + 1, i]
        stiff, row = coupling[i], place[M, channels + 1] + 1
        for o in range(forces):
            by = full[o]
            for k in range(channels):
                for j in range(len(t)):
                    by[k, j] = d[rows[o, k], i, j] if rows[o, k] >= 0 else 0.0
            for j in range(len(t)):
                by[UT, j], by[UP, j], by[UR, j], by[channels, j], by[channels + 1, j] = _by_hub(
                    by[UT, j], by[UP, j], by[UR, j], t[j], p[j], r[j], w[j], v[j]
                )
        for k in range(channels + 2):
            for j in range(len(t)):
                full[FZ, k, j], full[FX, k, j], full[FR, k, j] = _back(
                    full[FZ, k, j], full[FX, k, j], full[FR, k, j], w[j], v[j]
                )
        for j in range(len(t)):
            full[FX, channels, j] += v[j] * f[FZ, i, j]
            full[FX, channels + 1, j] += w[j] * f[FZ, i, j] - f[FR, i, j]
            full[FZ, channels, j] += f[FR, i, j]
            full[FR, channels, j] -= f[FZ, i, j]
            full[FR, channels + 1, j] += f[FX, i, j]
        for j in range(len(t)):
            kw, kv, b = c[first + 2, i, j], c[first + 3, i, j], c[first + 4, i, j]
            sine, cosine = of_double_angle(c[TH, i, j])
            full[M, TH, j] -= 2.0 * stiff * ((kw * kw - kv * kv) * cosine - 2.0 * kw * kv * sine)
            by_w, by_v = (
                2.0 * stiff * (kw * sine + kv * cosine),
                2.0 * stiff * (kw * cosine - kv * sine),
            )
            out[row, i, j] = -by_w  # M by κ_w and κ_v.
            out[row + 1, i, j] = -by_v
            out[row + 2, i, j] = 2.0 * share[i] * w[j]  # E by w' and v'.
            out[row + 3, i, j] = 2.0 * share[i] * v[j]
            out[row + 4, i, j] = 2.0 * share[i] * b  # G_w by w' and B.
            out[row + 5, i, j] = 2.0 * share[i] * w[j]
            out[row + 6, i, j] = 2.0 * share[i] * b  # G_v by v' and B.
            out[row + 7, i, j] = 2.0 * share[i] * v[j]
            cosine -= reference[0, i]
            sine -= reference[1, i]
            out[row + 8, i, j] = by_w  # M_w by θ, κ_w and κ_v.
            out[row + 9, i, j] = -stiff * cosine
            out[row + 10, i, j] = stiff * sine
            out[row + 11, i, j] = by_v  # M_v by θ, κ_w and κ_v.
            out[row + 12, i, j] = stiff * sine
            out[row + 13, i, j] = stiff * cosine
        for o in range(forces):
            for k in range(channels + 2):
                if place[o, k] >= 0:
                    out[place[o, k], i] = full[o, k]


@lru_cache(maxsize=8)
def bending_interface(inner: SectionInterface) -> SectionInterface:
    """The interface of a section on a blade that bends."""
    first, forces = inner.channels, inner.forces
    tilts, (kw, kv, b) = (
        (first + SW + 5, first + SV + 5),
        (first + 5 + channel for channel in (KW, KV, B)),
    )
    moved = {channel for force, channel in inner.pairs if force in (FX, FZ, FR)}
    pairs = list[tuple[int, int]]()
    for force in sorted(range(forces), key=lambda o: o == M):  # M last: those of bending follow it.
        followed = (
            moved
            if force in (FX, FZ, FR)
            else {channel for o, channel in inner.pairs if o == force}
        )
        pairs += [(force, channel) for channel in (*sorted(followed | {UT, UP, UR}), *tilts)]
    rows, place = places_of(inner.pairs, forces, first), places_of(pairs, forces, first + 2)
    last = {force: forces + 5 + force for force in BENDING}
    pairs += [
        (M, kw), (M, kv), (last[E], tilts[0]), (last[E], tilts[1]), (last[GW], tilts[0]), (last[GW], b),
        (last[GV], tilts[1]), (last[GV], b), (last[MW], TH), (last[MW], kw), (last[MW], kv), (last[MV], TH),
        (last[MV], kw), (last[MV], kv),
    ]  # fmt: skip

    def section(c: Array, data: BentData, slopes: bool, flow: bool) -> tuple[Array, Array, Array]:
        f, d, s = inner.section(turned(c, first), data.section, slopes, flow)
        out, blade = (
            np.empty((forces + 5, *c.shape[1:])),
            (data.coupling, data.reference, data.share),
        )
        _turn_back(c, first, f, forces, blade, out)
        partials = np.empty((len(pairs), *(c.shape[1:] if slopes else (0, c.shape[2]))))
        if slopes:
            _slopes_back(c, first, f, d, rows, place, blade, partials)
        return out, partials, s

    def memory(c: Array, data: BentData) -> LagFactors:
        """That of the section within, its forces turned back and its channels turned."""
        assert inner.memory is not None
        within = inner.memory(turned(c, first), data.section)
        t, p, r, w, v = c[UT], c[UP], c[UR], c[first], c[first + 1]
        left = np.concatenate([within.left, np.zeros((5, *within.left.shape[1:]))])
        left[FZ], left[FX], left[FR] = _back.py_func(
            within.left[FZ], within.left[FX], within.left[FR], w, v
        )
        right = np.concatenate([within.right, np.zeros((len(within.right), 5, *t.shape))], axis=1)
        by_air = (within.right[:, channel] for channel in (UT, UP, UR))
        right[:, UT], right[:, UP], right[:, UR], right[:, first], right[:, first + 1] = (
            _by_hub.py_func(*by_air, t, p, r, w, v)
        )
        return LagFactors(left, within.lags, right)

    remembers = None if inner.memory is None else memory
    return SectionInterface(section, tuple(pairs), first + 5, forces + 5, inner.balanced, remembers)

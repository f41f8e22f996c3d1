"""Coordinates of bending among the states of a structure, and sums of them with measures."""

from collections.abc import Hashable
from typing import cast

import numpy as np

from rotor.aero.bending import BladeBending
from rotor.aero.section import FR, FX, FZ
from rotor.arrays import Array
from rotor.engine.terms import ONE, Structure
from rotor.engine.waves import STEADY, rate_of

FLAPPING_STATES = ("coning", "flap_1c", "flap_1s")
"""What the first flap mode's coordinates of the waves 1, cos ψ and sin ψ are called."""
OFFSET: Hashable = ("bend", "offset")
"""y0 over R: how far the axis of the steadily lagged blade lies forward of the shaft, in the place of the steady
coordinate of the lag mode of an articulated blade."""


def bends(s: Structure) -> bool:
    """Whether a structure has bending."""
    return ("bend", 0, 1) in s.states or ("bend", 1, 1) in s.states


def coordinate(s: Structure, first: int, k: int, h: int) -> int:
    """The atom of q_kh."""
    return s.states[FLAPPING_STATES[h]] if k == first and h < len(FLAPPING_STATES) else s.states["bend", k, h]


def coordinates_of(b: BladeBending, s: Structure, z: Array) -> tuple[Array, float]:
    """q_kh of the states at z, (modes, functions), and y0 over R."""
    places = _all(s)
    q = np.zeros((len(b.mass), 1 + max(h for _, h, _ in places)))
    for k, h, atom in places:
        q[k, h] = z[atom]
    return q, float(z[s.states[OFFSET]]) if OFFSET in s.states else 0.0


def torque_terms(s: Structure) -> list[tuple[float, int, int, int]]:
    """C_Q = Σ r F_x + (y0 + v) F_r, as factor · z_i z_j Q: (factor, z_i, z_j, measure)."""
    terms = [(1.0, ONE, ONE, s.measure(FX, "r", STEADY))]
    if bends(s):
        terms.append((1.0, s.numbers["precone"], ONE, s.measure(FR, ("precone", "V"), STEADY)))
        if OFFSET in s.states:
            terms.append((1.0, s.states[OFFSET], ONE, s.measure(FR, "one", STEADY)))
        terms += [(1.0, atom, ONE, s.measure(FR, ("V", k), h)) for k, h, atom in _all(s)]
    return terms


def bending_work(s: Structure) -> list[tuple[float, int, int, int]]:
    """Power that the air does on bending, Σ (W_k F_z − V_k F_x) q_k', in the same form."""
    terms = list[tuple[float, int, int, int]]()
    for k, h, atom in _all(s):
        rate, factor = rate_of(h)
        if factor:
            terms.append((factor, atom, ONE, s.measure(FZ, ("W", k), rate)))
            terms.append((-factor, atom, ONE, s.measure(FX, ("V", k), rate)))
    return terms


def _all(s: Structure) -> list[tuple[int, int, int]]:
    """Mode, wave and atom of all coordinates."""
    own = list[tuple[int, int, int]]()
    for name, atom in s.states.items():
        if isinstance(name, tuple) and name != OFFSET:
            kind, k, h = cast(tuple[str, int, int], name)
            if kind == "bend":
                own.append((k, h, atom))
    present = {(k, h) for k, h, _ in own}
    first = next(k for k, _, _ in own if (k, 1) not in present)
    return [(first, h, s.states[name]) for h, name in enumerate(FLAPPING_STATES)] + own

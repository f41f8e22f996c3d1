"""Loads of a trial state without slopes, in one pass over the disk: what a step of Newton's method has to know.

The formulas are those of `rotor.aero.kernel`, row by row. A pass writes the lift alone to memory and takes half the
time of loads and moments with slopes (`evaluate_elements`).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rotor.aero.elements import BladeElements, Problem, blade_motion
from rotor.aero.inflow.interface import InflowResponse, Wake
from rotor.aero.kernel import (
    BETA,
    add_twist,
    angles_of_attack,
    around_azimuth,
    force_values,
    mach_numbers,
    moment_values,
    velocities_of_row,
)
from rotor.aero.look_up import look_up_values, places_along_alpha, places_along_mach
from rotor.aero.radial_flow import friction_of_row
from rotor.aero.sums import add_along_blade, around_disk, sum_array
from rotor.aero.torsion_balance import add_modal_moments, modal_moments
from rotor.aero.trim_state import TrimState
from rotor.arrays import Array
from rotor.compiled import compiled

_NO_MOMENTS = *(np.zeros(0),) * 3, np.zeros((0,) * 6), np.zeros(0)
"""In the place of `BladeTorsion.moment_data`, of a rigid blade."""
_ALL_LOADED = np.zeros((0, 0), np.bool_)


@dataclass(frozen=True, eq=False)
class TrialLoads:
    """What the loads of a trial state add up to."""

    state: TrimState
    flow: Wake
    """As in `BladeElements`."""
    induced: Array
    """λ_i of the trial, (elements, azimuths)."""
    elastic: Array
    """Coordinates of the elastic twist, (modes, functions)."""
    response: InflowResponse
    """Response of the inflow model to the loads."""
    sums: Array
    """In the order of `SumName`, (6,)."""
    modal: Array
    """`modal_moments`, (modes, azimuths)."""


def evaluate_loads(problem: Problem, state: TrimState, induced: Array | None, elastic: Array) -> TrialLoads:
    """The loads of a trial state; arguments as in `evaluate_elements`."""
    disk = problem.disk
    motion = blade_motion(problem, state, induced, elastic)
    torsion = problem.torsion
    lift, sums, modal = _pass(
        *motion.arguments, disk.r, problem.active, problem.active_rates[0], problem.friction,
        problem.unloaded if problem.unloaded is not None else _ALL_LOADED, motion.loss, problem.tip_mach,
        disk.dr / len(disk.psi), disk.section_data, torsion.moment_data if torsion is not None else _NO_MOMENTS,
    )  # fmt: skip
    response = motion.response or problem.inflow.respond(disk, motion.wake, lift)
    return TrialLoads(state, motion.flow, motion.induced, elastic, response, sums, modal)


def loads_of(problem: Problem, elements: BladeElements) -> TrialLoads:
    """The same from blade elements that have been evaluated whole."""
    assert elements.response is not None
    modal, elastic = np.zeros((0, len(problem.disk.psi))), np.zeros(0)
    if elements.torsion is not None:
        modal, elastic = modal_moments(problem, elements), elements.torsion.coordinates
    return TrialLoads(
        elements.state, elements.flow, elements.induced, elastic, elements.response, sum_array(problem, elements), modal
    )


@compiled(error_model="numpy", fastmath={"contract"})
def _pass(
    twist: Array, along: Array, arm: Array, cos: Array, sin: Array, pitch: Any, flap: Any, mu_x: float, mu_z: float,
    induced: Array, shapes: Array, twist_around: Array, rate_around: Array, r: Array, active: Array,
    active_rate: Array, friction: float, unloaded: Any, loss: Array, tip_mach: float, cell: float, section_data: Any,
    moment_data: Any,
) -> Any:  # fmt: skip
    """F_z, (elements, azimuths), its sums over the disk, (6,), and the modal moments, (modes, azimuths).

    The arguments up to `rate_around` are those of `kernel.velocities`. active, active_rate: θ_act and its rate,
    (elements, azimuths), (1, 1) without; friction: c_f; unloaded: elements without load, (0, 0) where all have.
    """
    half_solidity, section, weight, offset, tables, cos_sweep, sin_sweep = section_data
    gain, damping, lag, moment_tables, inertia = moment_data
    n, m = induced.shape
    elastic = len(shapes) > 0
    around = around_azimuth(cos, sin, pitch, flap, mu_x, mu_z)
    lift, sums, modal = np.empty((n, m)), np.zeros((5, m)), np.zeros((len(shapes), m))
    theta, u_t, u_p, u_r = np.empty(m), np.empty(m), np.empty(m), mu_x * cos
    alpha, mach, fx, fr = np.empty(m), np.empty(m), np.empty(m), np.zeros(m)
    elastic_twist, rate, moment = np.empty(m), np.empty(m), np.empty(m)
    cells, places, found = np.empty((2, m), np.int32), np.empty((3, m)), np.zeros((3, m))
    for i in range(n):
        fz = lift[i]
        velocities_of_row(twist[i], along[i], arm[i], sin, mu_x, induced[i], around, theta, u_t, u_p)
        if elastic:
            add_twist(shapes[:, i], twist_around, rate_around, around, theta, elastic_twist, rate)
        if len(active) > 1:
            theta += active[i]
            rate += active_rate[i]
        angles_of_attack(theta, u_t, u_p, alpha)
        mach_numbers(u_t, u_p, u_r, cos_sweep[i], sin_sweep[i], tip_mach, mach)
        places_along_mach(mach, cells[1], places[1], places[2])
        for which in range(2):
            share = weight[i] if which == 1 else 1.0
            if share > 0.0:
                places_along_alpha(alpha, offset[i, which], cells[0], places[0])
                one = section[i, which]
                look_up_values(tables, one, cells[0], cells[1], places[0], places[1], share, found[:2])
                if elastic:
                    look_up_values(moment_tables, one, cells[0], cells[1], places[0], places[1], share, found[2:])
        force_values(u_t, u_p, half_solidity[i], loss[i], found[0], found[1], fz, fx)
        if elastic:
            moment_values(u_t, u_p, rate, gain[i], damping[i], lag[i], found[2], fz, moment)
        if friction > 0.0:
            friction_of_row(r[i], cos, sin, friction * half_solidity[i], mu_x, fx, fr)
        if len(unloaded) > 0:
            for j in range(m):
                if unloaded[i, j]:
                    fz[j], fx[j], fr[j], moment[j] = 0.0, 0.0, 0.0, 0.0
        add_along_blade(arm[i], r[i], fz, fx, fr, sums)
        if elastic:
            add_modal_moments(shapes[:, i], inertia[i], moment, theta, modal)
    return lift, around_disk(sums, cos, sin, around[BETA], cell), modal

"""The blade elements of a trim on more azimuths than it was solved on, and areas of the disk finer than its elements.

An inflow model may be solved on fewer azimuths than were asked for: channels are smooth around the disk. They are
continued between the azimuths by their Fourier series and the section is evaluated there, so no coefficient is
interpolated, and reverse flow, stall and drag rise begin where they would if the trim were solved there.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from rotor.aero.disk import Disk
from rotor.aero.elements import (
    FLOW_FIELDS,
    SECTION_FIELDS,
    BentState,
    BladeElements,
    TwistState,
    over_azimuths,
    section_fields,
)
from rotor.aero.inflow.interface import PLAIN
from rotor.aero.problem import Problem, on_azimuths
from rotor.aero.section import M, angles_of_attack, stall_angles, stall_margins
from rotor.airfoil.stall_onset import STALLED
from rotor.design.design import SHOWN_AZIMUTHS
from rotor.engine.waves import wave_grid
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache

ENOUGH_ELEMENTS = 40
"""Elements whose cells are counted as they are: the border of a region cuts few of them."""
AREA_RADII = 80
"""Even radii at which regions are counted where there are fewer elements."""


@bytes_cache
@read_only
def resampling(source: int, target: int) -> Array:
    """Matrix of the Fourier interpolation of evenly spaced periodic samples, (source, target), exact at the samples."""
    angle = 2.0 * np.pi * (np.arange(target) / target - np.arange(source)[:, None] / source)
    waves = np.arange(1, (source + 1) // 2)
    kernel = 1.0 + 2.0 * np.cos(angle[..., None] * waves).sum(axis=-1)
    if source % 2 == 0:
        kernel += np.cos(0.5 * source * angle)
    return kernel / source


def at_display_azimuths(problem: Problem, elements: BladeElements) -> tuple[Problem, BladeElements]:
    """Problem and blade elements on at least as many azimuths as the models ask for, a multiple of those of the trim.

    The same two where the trim has as many.
    """
    solved = len(problem.disk.psi)
    times = -(-(problem.design.models.azimuths or SHOWN_AZIMUTHS) // solved)
    if times <= 1:
        return problem, elements
    finer = on_azimuths(problem, times * solved)
    return finer, (_all_round if problem.design.hovering else _between)(finer, elements)


def _all_round(problem: Problem, elements: BladeElements) -> BladeElements:
    """The elements of a hovering rotor, the same at all azimuths of a problem."""
    e, torsion, azimuths = elements, elements.torsion, len(problem.disk.psi)

    def around(field: Array) -> Array:
        return over_azimuths(field[:, 0], azimuths)

    values = {name: around(getattr(e, name)) for name in (*FLOW_FIELDS, *SECTION_FIELDS)}
    twist = torsion and replace(torsion, twist=around(torsion.twist), moment=around(torsion.moment))
    return replace(e, **values, beta=np.full(azimuths, e.beta[0]), torsion=twist)


def _between(problem: Problem, elements: BladeElements) -> BladeElements:
    """The elements at all azimuths of a problem."""
    e, torsion, azimuths = elements, problem.torsion, len(problem.disk.psi)
    matrix = resampling(len(e.beta), azimuths)
    fields = np.stack([getattr(e, name) for name in FLOW_FIELDS]) @ matrix
    rates = None if e.rates is None else e.rates @ matrix
    f, s, bends = _sections(
        problem, e, fields[:6] if rates is None else np.concatenate([fields[:6], rates]), matrix
    )
    twist = None
    if e.torsion is not None and torsion is not None:
        around = e.torsion.coordinates @ wave_grid(torsion.functions, azimuths).at
        twist = TwistState(e.torsion.coordinates, torsion.radial.T @ around, f[M])
    values = dict(zip(FLOW_FIELDS, fields, strict=True)) | section_fields(f, s)
    return replace(e, **values, beta=e.beta @ matrix, torsion=twist, bent=bends, rates=rates)


def _sections(
    problem: Problem, e: BladeElements, flow: Array, matrix: Array
) -> tuple[Array, Array, BentState | None]:
    """Forces and flow of a problem at channels of its azimuths, and there how the blade bends."""
    bends = None
    if e.bent is not None:
        bends = BentState(e.bent.channels @ matrix, e.bent.lift @ matrix)
        flow = np.concatenate([flow, bends.channels])
    f, _, s = problem.with_effects(PLAIN).section(flow, problem.grid_data(1), False, True)
    return f, s, bends


def pitch_of_alpha(flow: Any) -> Array:
    """θ + Δ that gives the angle of attack α = θ + Δ − atan2(U_P, U_T) of a flow at three quarters of the chord.

    Unlike α it does not run through ±180°. flow: what has `theta`, `alpha`, `u_t` and `u_p`.
    """
    ahead = flow.alpha - flow.theta + np.arctan2(flow.u_p, flow.u_t)
    return flow.theta + np.remainder(ahead + math.pi, 2.0 * math.pi) - math.pi


def areas(
    disk: Disk, elements: BladeElements, stall_margin: Array
) -> tuple[float, float, float, float, float]:
    """Reverse-flow area and stalled area over πR², the latter outside reverse flow, and the stalled parts of the thrust
    and of its moment about the hub, Σ r dT; last the least margin to stall, negative where there is a stalled area.

    Steady sections are stalled beyond the stall angle, unsteady ones where f″ is below `STALLED`.
    stall_margin: of the elements [rad], (elements, azimuths). With few elements the velocities, the pitch and the stall
    angles, which are smooth, are taken linear along the blade, and the angle of attack follows from them.
    """
    unsteady = elements.unsteady
    if len(disk.r) >= ENOUGH_ELEMENTS:
        reverse = elements.u_t < 0.0
        left = stall_margin if unsteady is None else unsteady.separation - STALLED
        cells, lift, r = disk.cells, disk.dr[:, None] * elements.fz, disk.r
    else:
        matrix, cells = _finer_radii(disk.root, tuple(disk.r.tolist()))
        u_t, lift = matrix @ np.stack((elements.u_t, elements.fz))
        reverse, cells, r = u_t < 0.0, cells / len(disk.psi), matrix @ disk.r
        if unsteady is None:
            limits = stall_angles(elements.mach, disk.weight, disk.offset, disk.stall)
            pitch = elements.theta if elements.rates is None else pitch_of_alpha(elements)
            theta, u_p, low, high = matrix @ np.stack((pitch, elements.u_p, *limits))
            alpha = np.empty_like(theta)
            angles_of_attack(theta.ravel(), u_t.ravel(), u_p.ravel(), alpha.reshape(-1))
            left = np.minimum(high - alpha, alpha - low)
        else:
            left = matrix @ unsteady.separation - STALLED
    stalled = (left < 0.0) & ~reverse
    moment = r[:, None] * lift
    of_lift, of_moment = (
        float(own[stalled].sum() / own.sum()) if own.any() else 0.0 for own in (lift, moment)
    )
    reversed_area, area = (
        float(cells @ np.count_nonzero(part, axis=1)) for part in (reverse, stalled)
    )
    return (
        reversed_area,
        area,
        of_lift,
        of_moment,
        float(left.min(initial=math.inf, where=~reverse)),
    )


def stalled_parts(problem: Problem, elements: BladeElements) -> tuple[float, float]:
    """Stalled fractions of πR² and of the lift's moment about the hub on the azimuths that are shown."""
    return own_stalled_parts(*at_display_azimuths(problem, elements))


def own_stalled_parts(problem: Problem, elements: BladeElements) -> tuple[float, float]:
    """`stalled_parts` on the azimuths of the trim."""
    disk, e = problem.disk, elements
    margin = stall_margins(e.alpha, e.mach, e.u_t, disk.weight, disk.offset, disk.stall)
    _, area, _, moment, _ = areas(disk, e, margin)
    return area, moment


@bytes_cache
@read_only
def _finer_radii(root: float, r: tuple[float, ...]) -> tuple[Array, Array]:
    """Linear interpolation from elements at r/R to even radii, (radii, elements), and the parts of πR² about these.

    Beyond the first and the last element the lines run on.
    """
    edges, known = np.linspace(root, 1.0, AREA_RADII + 1), np.array(r)
    radii, rows = 0.5 * (edges[1:] + edges[:-1]), np.arange(AREA_RADII)
    before = np.clip(np.searchsorted(known, radii) - 1, 0, len(known) - 2)
    share = (radii - known[before]) / np.diff(known)[before]
    matrix = np.zeros((AREA_RADII, len(known)))
    matrix[rows, before], matrix[rows, before + 1] = 1.0 - share, share
    return matrix, np.diff(edges**2)

"""The blade elements of a trim on more azimuths than it was solved on, and areas of the disk finer than its elements.

An inflow model may be solved on fewer azimuths than were asked for: channels are smooth around the disk. They are
continued between the azimuths by their Fourier series and the section is evaluated there, so no coefficient is
interpolated, and reverse flow, stall and drag rise begin where they would if the trim were solved there.
"""

import math
from dataclasses import dataclass, replace
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
from rotor.airfoil.section_table import DRAG_DIVERGENCE
from rotor.airfoil.stall_onset import STALLED
from rotor.design.design import SHOWN_AZIMUTHS
from rotor.engine.waves import wave_grid
from rotor.support.arrays import Array, Booleans, read_only
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
    asked = problem.design.models.azimuths or SHOWN_AZIMUTHS
    times = math.ceil(asked / solved)
    if times <= 1:
        return problem, elements
    finer = on_azimuths(problem, times * solved)
    if problem.design.hovering:
        return finer, _repeated(elements, len(finer.disk.psi))
    return finer, _interpolated(finer, elements)


def _repeated(elements: BladeElements, azimuths: int) -> BladeElements:
    """The elements of a hovering rotor, the same at so many azimuths."""

    def around(field: Array) -> Array:
        return over_azimuths(field[:, 0], azimuths)

    names = (*FLOW_FIELDS, *SECTION_FIELDS)
    values = {name: around(getattr(elements, name)) for name in names}
    torsion = elements.torsion
    if torsion is not None:
        torsion = replace(torsion, twist=around(torsion.twist), moment=around(torsion.moment))
    beta = np.full(azimuths, elements.beta[0])
    return replace(elements, **values, beta=beta, torsion=torsion)


def _interpolated(problem: Problem, e: BladeElements) -> BladeElements:
    """The elements in forward flight at the azimuths of a problem: channels are interpolated, sections evaluated."""
    azimuths = len(problem.disk.psi)
    matrix = resampling(len(e.beta), azimuths)
    fields = np.stack([getattr(e, name) for name in FLOW_FIELDS]) @ matrix
    flow = fields[:6]
    rates = None
    if e.rates is not None:
        rates = e.rates @ matrix
        flow = np.concatenate([flow, rates])
    f, s, bends = _sections(problem, e, flow, matrix)
    torsion = problem.torsion
    twist = None
    if e.torsion is not None and torsion is not None:
        around = e.torsion.coordinates @ wave_grid(torsion.functions, azimuths).at
        twist = TwistState(e.torsion.coordinates, torsion.radial.T @ around, f[M])
    values = dict(zip(FLOW_FIELDS, fields, strict=True)) | section_fields(f, s)
    return replace(e, **values, beta=e.beta @ matrix, torsion=twist, bent=bends, rates=rates)


def _sections(
    problem: Problem, e: BladeElements, flow: Array, matrix: Array
) -> tuple[Array, Array, BentState | None]:
    """Section forces, section flow, and bending of the blade at the azimuths of a problem.

    flow: channels there; matrix: from the azimuths of the trim to those.
    """
    bends = None
    if e.bent is not None:
        bends = BentState(e.bent.channels @ matrix, e.bent.lift @ matrix)
        flow = np.concatenate([flow, bends.channels])
    f, _, s = problem.with_effects(PLAIN).section(flow, problem.grid_data(1), False, True)
    return f, s, bends


def pitch_of_alpha(flow: Any) -> Array:
    """Pitch plus Δ, by which the angle of attack at three-quarter chord is α = θ + Δ − atan2(U_P, U_T) [rad].

    Unlike α it does not run through ±180°. flow: what has `theta`, `alpha`, `u_t` and `u_p`.
    """
    ahead = flow.alpha - flow.theta + np.arctan2(flow.u_p, flow.u_t)
    return flow.theta + np.remainder(ahead + math.pi, 2.0 * math.pi) - math.pi


@dataclass(frozen=True)
class Regions:
    """Regions of the disk: areas over πR², and the parts of the thrust and of its moment about the hub in them."""

    reverse_flow: float
    """Area with U_T < 0."""
    separated: float
    """Area where the flow is separated, outside reverse flow."""
    past_static: float
    """Area past the static stall angle with the flow still attached, outside reverse flow; 0 for steady sections."""
    drag_divergence: float
    """Area beyond drag divergence, outside reverse flow and where the flow is attached."""
    reverse_flow_thrust: float
    separated_thrust: float
    past_static_thrust: float
    drag_divergence_thrust: float
    """Parts of the thrust that the elements in each region carry; negative where they push down."""
    separated_moment: float
    """Part of the moment of the lift about the hub, Σ r dT, from separated elements."""
    least_margin: float
    """Least distance to separation outside reverse flow, negative where some flow is separated: of the angle of attack
    [rad], or in unsteady flow of the separation point [chords]."""


@dataclass(frozen=True, eq=False)
class _ElementFlow:
    """What decides the region of an element: of the trim, or on finer radii, (elements, azimuths) each."""

    r: Array
    """y/R, (elements,)."""
    cells: Array
    """Part of πR² of one element at one azimuth, (elements,)."""
    u_t: Array
    lift: Array
    """Thrust of an element, to a common factor."""
    margin: Array
    """Of the angle of attack to the static stall angle [rad], negative beyond it."""
    separation_margin: Array
    """Negative where the flow is separated, see `Regions.least_margin`."""
    cd_mach: Array


def regions(disk: Disk, elements: BladeElements) -> Regions:
    """The regions of a disk from its blade elements.

    The flow of a steady section is separated beyond the stall angle, that of an unsteady one where f″ is below
    `STALLED`.
    """
    if len(disk.r) >= ENOUGH_ELEMENTS:
        return _counted(_as_solved(disk, elements))
    return _counted(_on_finer_radii(disk, elements))


def _as_solved(disk: Disk, elements: BladeElements) -> _ElementFlow:
    """Elements at the radii of the trim."""
    e = elements
    margin = stall_margins(e.alpha, e.mach, e.u_t, disk.weight, disk.offset, disk.stall)
    separation_margin = margin
    if e.unsteady is not None:
        separation_margin = e.unsteady.separation - STALLED
    return _ElementFlow(
        r=disk.r,
        cells=disk.cells,
        u_t=e.u_t,
        lift=disk.dr[:, None] * e.fz,
        margin=margin,
        separation_margin=separation_margin,
        cd_mach=e.cd_mach,
    )


def _on_finer_radii(disk: Disk, elements: BladeElements) -> _ElementFlow:
    """Elements at even radii: what is smooth is linear along the blade, and the angle of attack follows from it.

    The angle itself, and with it the margin to stall, jumps beside reverse flow.
    """
    matrix, cells = _finer_radii(disk.root, tuple(disk.r.tolist()))
    pitch = elements.theta if elements.rates is None else pitch_of_alpha(elements)
    limits = stall_angles(elements.mach, disk.weight, disk.offset, disk.stall)
    smooth = elements.u_t, elements.u_p, elements.fz, pitch, *limits, elements.cd_mach
    u_t, u_p, lift, theta, low, high, cd_mach = matrix @ np.stack(smooth)
    alpha = np.empty_like(theta)
    angles_of_attack(theta.ravel(), u_t.ravel(), u_p.ravel(), alpha.reshape(-1))
    margin = np.minimum(high - alpha, alpha - low)
    separation_margin = margin
    if elements.unsteady is not None:
        separation_margin = matrix @ elements.unsteady.separation - STALLED
    return _ElementFlow(
        r=matrix @ disk.r,
        cells=cells / elements.u_t.shape[1],
        u_t=u_t,
        lift=lift,
        margin=margin,
        separation_margin=separation_margin,
        cd_mach=cd_mach,
    )


def _counted(e: _ElementFlow) -> Regions:
    """The regions as sums over the elements."""
    reverse = e.u_t < 0.0
    separated = (e.separation_margin < 0.0) & ~reverse
    attached = ~separated & ~reverse
    past_static = (e.margin < 0.0) & attached
    divergence = (e.cd_mach > DRAG_DIVERGENCE) & attached

    def area(region: Booleans) -> float:
        return float(e.cells @ np.count_nonzero(region, axis=1))

    moment = e.r[:, None] * e.lift
    return Regions(
        reverse_flow=area(reverse),
        separated=area(separated),
        past_static=area(past_static),
        drag_divergence=area(divergence),
        reverse_flow_thrust=_part(e.lift, reverse),
        separated_thrust=_part(e.lift, separated),
        past_static_thrust=_part(e.lift, past_static),
        drag_divergence_thrust=_part(e.lift, divergence),
        separated_moment=_part(moment, separated),
        least_margin=float(e.separation_margin.min(initial=math.inf, where=~reverse)),
    )


def _part(load: Array, region: Booleans) -> float:
    """The part of a load that comes from a region; 0 where there is no load."""
    if not load.any():
        return 0.0
    return float(load[region].sum() / load.sum())


def stalled_parts(problem: Problem, elements: BladeElements) -> tuple[float, float]:
    """Separated fractions of πR² and of the lift's moment about the hub on the azimuths that are shown."""
    return own_stalled_parts(*at_display_azimuths(problem, elements))


def own_stalled_parts(problem: Problem, elements: BladeElements) -> tuple[float, float]:
    """`stalled_parts` on the azimuths of the trim."""
    found = regions(problem.disk, elements)
    return found.separated, found.separated_moment


@bytes_cache
@read_only
def _finer_radii(root: float, r: tuple[float, ...]) -> tuple[Array, Array]:
    """Linear interpolation from elements at r/R to even radii, (radii, elements), and the parts of πR² about these.

    Beyond the first and the last element the lines run on.
    """
    known = np.array(r)
    edges = np.linspace(root, 1.0, AREA_RADII + 1)
    radii = 0.5 * (edges[1:] + edges[:-1])
    rows = np.arange(AREA_RADII)
    before = np.clip(np.searchsorted(known, radii) - 1, 0, len(known) - 2)
    share = (radii - known[before]) / np.diff(known)[before]
    matrix = np.zeros((AREA_RADII, len(known)))
    matrix[rows, before] = 1.0 - share
    matrix[rows, before + 1] = share
    return matrix, np.diff(edges**2)

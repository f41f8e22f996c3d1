"""One blade element under the glass: flow, angles and loads at a point (r, ψ) of the disk."""

import math
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from explorer.picture.blade_mesh import blade_axes_outline
from explorer.picture.polar import chord_of, stall_angles
from explorer.text.status import section_title
from rotor import Solution
from rotor.aero.display import STALLED
from rotor.aero.elements import Unsteady
from rotor.aero.problem import LOW_MACH
from rotor.airfoil.section_table import DRAG_DIVERGENCE
from rotor.airfoil.sections import Section
from rotor.airfoil.stall_delay import delay_gain, delayed_lift
from rotor.airfoil.stall_onset import unstalled
from rotor.support.arrays import Array
from rotor.trim import DiskFields

_OUTLINE = 61


class FlowRegion(Enum):
    ATTACHED = "attached"
    SEPARATED = "separated"
    PAST_STATIC = "past the static angle, attached"
    REVERSE = "reverse flow"
    IDLE = "reverse flow, left out"
    DIVERGED = "drag divergence"


@dataclass(frozen=True)
class SectionBlend:
    """The section at a radius: between two spans, or two Reynolds numbers of its data, a mixture."""

    parts: tuple[tuple[Section, float], ...]
    """The sections that take part, with their shares."""
    delay: float = 0.0
    """g of `rotor.airfoil.stall_delay`; 0 where rotation does not delay stall."""

    def lift_curve(self, alpha: Array, mach: float) -> Array:
        """C_l at angles of attack [rad] about the blade's reference line."""
        curve = np.zeros_like(alpha)
        for section, share in self.parts:
            own = alpha - section.incidence_offset
            curve += share * delayed_lift(section.table, self.delay, own, mach)
        return curve


@dataclass(frozen=True, eq=False)
class UnsteadyProbe:
    """What dynamic stall does at the element, and its way around the disk."""

    separation: float
    """f″, over the chord."""
    loop: Array
    """α [rad] and C_l at the azimuths of the disk, NaN in reverse flow, (2, azimuths)."""


@dataclass(frozen=True)
class Probe:
    """A blade element as it passes (r, ψ). SI and radians; loads are of one blade and per metre of span."""

    r: float
    """y/R"""
    psi: float
    """ψ [rad], 0 … 2π, 0 over the tail."""
    radius: float
    """y [m]"""
    chord: float
    """[m]"""
    section: SectionBlend
    theta: float
    """Pitch with twist [rad]."""
    elastic: float | None
    """Elastic twist [rad]; None for a rigid blade."""
    phi: float
    """Inflow angle atan2(U_P, U_T) [rad]: near π where the flow comes from the trailing edge."""
    pitch_rate: float | None
    """What the pitch rate adds to α at three quarters of the chord [rad]; None in steady flow."""
    alpha: float
    """θ − φ, in unsteady flow with the part of the pitch rate, in (−π, π], about the blade's reference line."""
    u_t: float
    """In the plane of the disk and normal to the blade [m/s]."""
    u_p: float
    """Down through the blade [m/s]."""
    induced: float
    """Induced velocity, down [m/s]."""
    mach: float
    table_mach: float
    """Where the section data are read: the same, unless compressibility is switched off."""
    cl: float
    cd: float
    lift: float
    """Normal to the flow, tip and root loss taken off [N/m]."""
    drag: float
    """Along the flow [N/m]."""
    thrust: float
    """Along the shaft [N/m]."""
    pull: float
    """In the plane, against the rotation [N/m]."""
    power: float
    """Ω y times the pull [W/m]."""
    stall: tuple[float, float] | None
    """Negative and positive static stall angle [rad]; None where sections do not stall."""
    cd_mach: float
    """∂C_d/∂M"""
    idle: bool
    """Whether the models leave its loads out, as they may in reverse flow."""
    unsteady: "UnsteadyProbe | None"
    """None with steady sections."""

    @property
    def u(self) -> float:
        """Resultant velocity at the section [m/s]."""
        return math.hypot(self.u_t, self.u_p)

    @property
    def stall_margin(self) -> float | None:
        """Angle of attack left before the static stall angle [rad]; None in reverse flow, where it means nothing, and
        without stall."""
        if self.u_t < 0.0 or self.stall is None:
            return None
        return min(self.stall[1] - self.alpha, self.alpha - self.stall[0])

    @property
    def stall_share(self) -> float | None:
        """α over the static stall angle on its side; None where there is no margin."""
        if self.u_t < 0.0 or self.stall is None:
            return None
        return max(self.alpha / self.stall[1], self.alpha / self.stall[0])

    @property
    def region(self) -> FlowRegion:
        if self.u_t < 0.0:
            return FlowRegion.IDLE if self.idle else FlowRegion.REVERSE
        if self.separated:
            return FlowRegion.SEPARATED
        if self.past_static:
            return FlowRegion.PAST_STATIC
        return FlowRegion.DIVERGED if self.cd_mach > DRAG_DIVERGENCE else FlowRegion.ATTACHED

    @property
    def past_static(self) -> bool:
        """Whether the angle of attack is past the static stall angle, outside reverse flow."""
        margin = self.stall_margin
        return margin is not None and margin < 0.0

    @property
    def separated(self) -> bool:
        """Whether the flow is separated, outside reverse flow."""
        if self.u_t < 0.0:
            return False
        if self.unsteady is None:
            return self.past_static
        return self.unsteady.separation < STALLED


def probe(solution: Solution, r: float, psi: float) -> Probe:
    """What the solution says at r = y/R and ψ [rad]: the disk's own values at its stations, linear between them.

    ψ may be any turn. ValueError for an r that is not on the blade.
    """
    design, disk = solution.design, solution.disk
    rotor = design.rotor
    if not rotor.blade.root_cutout - 1e-9 <= r <= 1.0 + 1e-9:
        raise ValueError(f"r/R {r:g} is not on the blade: choose {rotor.blade.root_cutout:g} … 1")
    psi = psi % (2.0 * math.pi)
    at = _GridPoint(disk, r, psi)
    speed = rotor.tip_speed
    theta, u_t, u_p, mach = (
        at.reaching(field) for field in (disk.theta, disk.u_t, disk.u_p, disk.mach)
    )
    phi = math.atan2(u_p, u_t)
    thrust, pull = (
        design.thrust_per_metre * at.held(disk.dct),
        design.thrust_per_metre * at.held(disk.dcq),
    )
    parts = rotor.blade.mixture(r, design.reynolds_per_metre)
    if not design.models.stall:
        parts = tuple((replace(one, table=unstalled(one.table)), share) for one, share in parts)
    chord = chord_of(rotor, parts, r)
    delay = 0.0
    if design.models.has("stall_delay"):
        delay = float(delay_gain(chord / (r * rotor.radius)))
    section = SectionBlend(parts, delay)
    mach = max(mach, 0.0)
    table_mach = mach if design.models.compressibility else LOW_MACH
    pitch_rate = None
    if disk.find_apparent is not None:
        pitch_rate = at.held(disk.pitch_of_alpha - disk.theta)
    alpha = math.pi - (math.pi - theta - (pitch_rate or 0.0) + phi) % (2.0 * math.pi)
    lower, upper = stall_angles(solution)
    unsteady = disk.unsteady
    idle = u_t < 0.0 and not design.models.reverse_flow
    return Probe(
        r=r,
        psi=psi,
        radius=r * rotor.radius,
        chord=chord,
        section=section,
        theta=theta,
        elastic=None if disk.elastic_twist is None else at.reaching(disk.elastic_twist),
        phi=phi,
        pitch_rate=pitch_rate,
        alpha=alpha,
        u_t=speed * u_t,
        u_p=speed * u_p,
        induced=speed * at.reaching(disk.induced),
        mach=mach,
        table_mach=table_mach,
        cl=at.held(disk.cl),
        cd=at.held(disk.cd),
        lift=thrust * math.cos(phi) + pull * math.sin(phi),
        drag=pull * math.cos(phi) - thrust * math.sin(phi),
        thrust=thrust,
        pull=pull,
        power=pull * r * speed,
        stall=(at.held(lower), at.held(upper)) if design.models.stall else None,
        cd_mach=at.held(disk.cd_mach),
        idle=idle,
        unsteady=None if unsteady is None else _around(disk, unsteady, at, r),
    )


def _around(disk: DiskFields, unsteady: Unsteady, at: "_GridPoint", r: float) -> UnsteadyProbe:
    """At a point, and around the disk at its radius."""
    loop = np.empty((2, len(disk.psi)))
    for k, psi in enumerate(disk.psi.tolist()):
        there = _GridPoint(disk, r, psi)
        loop[:, k] = (
            (there.held(disk.alpha), there.held(disk.cl))
            if there.reaching(disk.u_t) > 0.0
            else math.nan
        )
    return UnsteadyProbe(at.held(unsteady.separation), loop)


def outline(section: SectionBlend) -> Array:
    """The true outline, blended as the blade is; (y, z) in reference chords about the quarter chord."""
    return sum(
        (share * blade_axes_outline(part, _OUTLINE) for part, share in section.parts), np.zeros(())
    )


def where(psi: float) -> str:
    """What an azimuth [rad] is called."""
    advancing = "over the tail", "aft, advancing", "advancing side", "ahead, advancing"
    retreating = "over the nose", "ahead, retreating", "retreating side", "aft, retreating"
    return (*advancing, *retreating)[round(math.degrees(psi) / 45.0) % 8]


def sections_of(section: SectionBlend) -> str:
    """Name of the section; of two where one goes over into the other."""
    return " → ".join(dict.fromkeys(section_title(s.name) for s, _ in section.parts))


class _GridPoint:
    """Where a point lies among the stations: periodic in azimuth, linear along the blade."""

    def __init__(self, disk: DiskFields, r: float, psi: float) -> None:
        n = len(disk.psi)
        around = (psi - float(disk.psi[0])) * n / (2.0 * math.pi)
        row = min(max(int(np.searchsorted(disk.r, r, "right")) - 1, 0), len(disk.r) - 2)
        along = row + (r - float(disk.r[row])) / float(disk.r[row + 1] - disk.r[row])
        # A station met to rounding is that station: what stands there is read, not blended.
        around, along = (
            float(round(x)) if abs(x - round(x)) < 1e-9 else x for x in (around, along)
        )
        before = math.floor(around)
        self._columns = before % n, (before + 1) % n
        self._late = around - before
        self._row = min(max(math.floor(along), 0), len(disk.r) - 2)
        self._out = along - self._row

    def reaching(self, field: Array) -> float:
        """A field that runs on straight over the half elements at root and tip, as velocities do."""
        return self._blend(field, self._out)

    def held(self, field: Array) -> float:
        """A field that keeps its last value there: a coefficient that jumps must not be drawn out."""
        return self._blend(field, min(max(self._out, 0.0), 1.0))

    def _blend(self, field: Array, out: float) -> float:
        first, second = self._columns
        inner, outer = (
            float(field[row, first]) + self._late * float(field[row, second] - field[row, first])
            for row in (self._row, self._row + 1)
        )
        # Two products rather than a difference: so the outer station has exactly its own value, too.
        return (1.0 - out) * inner + out * outer

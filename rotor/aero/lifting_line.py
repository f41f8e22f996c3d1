"""One lifting line for each blade and its wake: where the wake lies, and the downwash w = A Γ at every blade element.

What leaves the blade at r and azimuth ψ moves along with the flight, x = r cos ψ + µ_x t, y = r sin ψ, and down with

    inside the disk    dz/dt = −µ_z − λ0 (1 + E (8/15π + k x − |y|³))
    behind it          dz/dt = −µ_z − 2 λ0 (1 + E (8/15π − |y|³)),    E = tan(χ/2),  χ = atan2(µ_x, µ_z + λ0),  k = 3

t is ψ_b − ψ for the blade at ψ_b now. The form is that of Beddoes (11th European Rotorcraft Forum, 1985; Leishman,
Principles of Helicopter Aerodynamics, ch. 10), where the brackets are 1 + E (x − |y|³) and 1 − E |y|³ with E = χ/2. Tip
vortices measured on HART II rise over the front and sink over the rear four times as steeply. 8/15π is the mean of |y|³
over the disk, so λ0 is that of dz/dt. Nothing rolls up or contracts. Below µ_x = 2.5 √(C_T/2) it passes over to the
helix of momentum theory at µ = 0, dz/dt = −µ_z − λ0: at no speed nothing lies behind the disk. Under negative thrust
χ is that of the mirrored rotor.
Axes of the shaft, over R: x aft, y to starboard, z up; velocities over ΩR.

A blade is a lifting line of panels, the blade elements themselves; circulation is that of each panel at each azimuth.
What changes along the span trails from the panels' edges, what changes in time is shed.

    age 0…30°           a full lattice: trailers at every edge, shed lines, four straight pieces a step
    to two turns        trailers of groups of panels, each with the mean circulation of its panels, and shed lines
    beyond, to 8 R      the same trailers in steps of 30°, with the mean circulation around the azimuth

The law of Biot and Savart with the core of Vatistas, n = 2 (Exp. Fluids 11, 1991), of a unit line from A to B:

    4π v = (a × b)(|a| + |b|)(1 − a·b/|a||b|)/√(|a × b|⁴ + c⁴ |AB|⁴)

A blade's own young trailers have no core from µ_x + 0.45 outward, where control points lie midway between smooth
trailers, and inboard, where the wake passes back over the blade in reverse flow, 0.05; a core of 0.02 there loses the
tip. All are sums over the targets that see one rotor position: the loops run along them, in single precision.

Under unsteady sections what the lattice's shed vorticity lacks of a thin aerofoil's is added, for lift changes faster
than its steps follow. With lift ρUΓ, Γ ~ exp(inψ), Theodorsen's function C(k) asks for the downwash (1/C − 1) Γ/2πb at
the line, k = n b/r (NACA Report 496, 1935). Shed lines 15° apart behind a line without chord leave 1 to 8 % less lift
than C at k 0.05 to 0.2. The difference, in two dimensions and at the mean speed r, is the same for all azimuths: it
adds to a panel's own block. Inboard it fades out as the core of the young trailers does.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import exp1, hankel2

from rotor.aero.disk import azimuths_of, stations
from rotor.aero.momentum import DiskFlow
from rotor.support.arrays import Array, Integers, Singles, fixed_property, read_only
from rotor.support.bytes_cache import bytes_cache
from rotor.support.compiled import compiled

STEEPNESS = 3.0
"""k. Least squares give 2.8 over 89 tip vortices of HART II, BL and MN, and 2.9 over 39 of a third case, MV."""
MEAN_OUTWARD = 8.0 / (15.0 * math.pi)
"""Mean of |y|³ over the disk."""
SKEWED = 2.5
"""µ_x over √(C_T/2) from which a wake is wholly that of forward flight: µ 0.144 for a UH-60A at sea level, where it
trails at 81° to the shaft. Our choice: with 1.5 power up to µ 0.06 is 0.5 to 1.6 % less, further below momentum
theory."""


@compiled(error_model="numpy")
def _sink(begin: Any, y: Any, t: Any, course: Any, z: Any) -> None:
    """Lower what left the blade at (begin, y, z) the times t ago, (places, radii) and (places,)."""
    mu_x, mu_z, lambda0, skewed, first, aft, outer = course
    for k in range(z.shape[0]):
        for r in range(z.shape[1]):
            inside, outward = t[k], min(abs(y[k, r]), 1.0)
            if mu_x > 0.0:
                way = math.sqrt(max(1.0 - y[k, r] * y[k, r], 0.0)) - begin[k, r]
                inside = min(max(way, 0.0), mu_x * t[k]) / mu_x
            sunk = (first - outer * outward * outward * outward) * (2.0 * t[k] - inside)
            sunk += aft * inside * (begin[k, r] + 0.5 * mu_x * inside)
            z[k, r] -= mu_z * t[k] + lambda0 * (t[k] + skewed * (sunk - t[k]))


@dataclass(frozen=True, kw_only=True)
class WakeCourse(DiskFlow):
    """The quantities on which the course of a wake depends."""

    coning: float
    """β0 [rad], and β1c and β1s."""
    flap_1c: float
    flap_1s: float
    core: tuple[float, float]
    """Square of the core of a young tip vortex over R², and its growth by age."""
    beddoes: float = 0.0
    """0 for the path of the module's docstring, 1 for that of Beddoes, between them in proportion: bands ask for it."""

    @property
    def skewed(self) -> float:
        """0 for the helix of hover, 1 for the wake of forward flight, and smoothly between; C_T is 2 λ0 V."""
        share = min(
            self.mu_x / (SKEWED * math.sqrt(max(abs(self.lambda0), 1e-9) * self.speed)), 1.0
        )
        return share * share * (3.0 - 2.0 * share)

    @property
    def descent(self) -> tuple[float, float, float]:
        """a, b, c of the velocity down over λ0: `a + b x − c |y|³` inside the disk, `2 (a − c |y|³)` behind it."""
        chi = math.atan2(self.mu_x, -self.axial if self.lambda0 < 0.0 else self.axial)
        skew, old, share = math.tan(0.5 * chi), 0.5 * chi, self.beddoes
        fitted = 1.0 + MEAN_OUTWARD * skew, STEEPNESS * skew, skew
        first, aft, outward = (
            a + share * (b - a) for a, b in zip(fitted, (1.0, old, old), strict=True)
        )
        return first, aft, outward

    def flapping(self, psi: Array) -> Array:
        """β(ψ) [rad], shape of psi."""
        return self.coning + self.flap_1c * np.cos(psi) + self.flap_1s * np.sin(psi)

    def nodes(self, psi_b: Array, ages: Array, r: Array) -> Array:
        """Positions of what left the blades that are now at psi_b, (blades, ages, radii, 3)."""
        released = psi_b[:, None] - ages
        begin, y, z = (
            (each[..., None] * r).reshape(-1, len(r))
            for each in (np.cos(released), np.sin(released), self.flapping(released))
        )
        t = np.tile(ages, len(psi_b))
        _sink(begin, y, t, (self.mu_x, self.mu_z, self.lambda0, self.skewed, *self.descent), z)
        return np.stack([begin + self.mu_x * t[:, None], y, z], axis=-1).reshape(
            *released.shape, len(r), 3
        )


def tip_core(chord: float, thrust: float, blades: int, reynolds: float) -> tuple[float, float]:
    """c² over R² of a young tip vortex, and its growth by age: (0.2 chord)² + 4 · 1.25643 (1 + a1 Γ/ν) ν t.

    With Squire's a1 = 1e-4 (Leishman, ch. 10). chord: at 0.9 R, over R; thrust: C_T; reynolds: ΩR²/ν.
    """
    # Γ of the tip vortex is near 2 C_T ΩR²/N_b.
    grown = 1.0 + 1e-4 * 2.0 * thrust / blades * reynolds
    return (0.2 * chord) ** 2, 4.0 * 1.25643 * grown / reynolds


PIECES = 4
"""Straight pieces of a step there: one leaves the blade at a wrong angle."""
TURNS = 2
FAR_STEP = math.pi / 6.0
LENGTH = 8.0
"""Distance of the wake's end, over R."""
OLDEST = 200.0 * math.pi
"""Age of the wake's end [rad] where hardly anything carries it away, so that its nodes are bounded. 100 turns reach
8 R down to a transport of 0.0127 ΩR, in hover C_T 3e-4; helicopters fly at some 5e-3."""
GROUP = 3
"""Panels of one strip of the far wake."""
LEAST_CORE = 0.02
FAR_CORE = 0.03
"""Core of the far trailers from outboard, at least. Their place is known to 0.02 to 0.03 R, rms beside measured tip
vortices; wakes displaced by as much induce, in the mean, what one with this core does."""
OWN_CORE, BARE = 0.05, (0.05, 0.45)
"""Core of a blade's own young trailers, fading from the first to the second radius beyond µ_x."""
ROOT_CORE, ROOT = 0.08, 0.5
"""Core of the far trailers inboard of a radius, which come from the root and are no concentrated vortex."""
SHED_CORE = 0.08
"""Core of shed lines of strips, and of the near wake's last: with one core alone it and the strips' first cancel."""


@dataclass(frozen=True)
class LiftingLine:
    """The lifting lines of a rotor."""

    blades: int
    root: float
    panels: int
    azimuths: int
    near: float = math.radians(30.0)
    """Age [rad] to which the lattice is full."""

    @fixed_property
    def edges(self) -> Array:
        """(panels + 1,)"""
        return stations(self.root, self.panels, fine_tip=True)[0]

    @fixed_property
    def r(self) -> Array:
        """(panels,)"""
        return stations(self.root, self.panels, fine_tip=True)[1]

    @property
    def psi(self) -> Array:
        """[rad], (azimuths,)"""
        return azimuths_of(self.azimuths)


@compiled(error_model="numpy", fastmath=True)
def _sum_lines(
    targets: Any,
    nodes: Any,
    ends: Any,
    core: Any,
    young: Any,
    places: Any,
    shares: Any,
    first: int,
    out: Any,
) -> None:
    """Add the downwash of unit lines at targets to rows of `out`, (rows, azimuths, targets).

    targets: positions and normals, (6, targets). nodes: (nodes, 3). ends: nodes A and B, (lines, 2); a line that begins
    where the one before ends has the distance from there already. core: c⁴, (lines,), and `young` instead at each
    target, (targets,), where it is negative. places: row and the two ages in steps of each line's circulation,
    (lines, 3), the blade being at azimuth `first`; shares: what each of the two has, (lines, 2).
    """
    n, m = targets.shape[1], out.shape[1]
    x, y, z, u, v, w = targets[0], targets[1], targets[2], targets[3], targets[4], targets[5]
    far, induced, here, at = np.empty((2, n), np.float32), np.empty(n, np.float32), 0, -1
    for s in range(len(ends)):
        ax, ay, az = nodes[ends[s, 0], 0], nodes[ends[s, 0], 1], nodes[ends[s, 0], 2]
        bx, by, bz = nodes[ends[s, 1], 0], nodes[ends[s, 1], 1], nodes[ends[s, 1], 2]
        l2 = (ax - bx) * (ax - bx) + (ay - by) * (ay - by) + (az - bz) * (az - bz)
        fixed = max(core[s], np.float32(0.0)) * l2 * l2 + np.float32(1e-20)
        own = l2 * l2 if core[s] < 0.0 else np.float32(0.0)
        if ends[s, 0] != at:
            for t in range(n):
                dx, dy, dz = x[t] - ax, y[t] - ay, z[t] - az
                far[here, t] = math.sqrt(dx * dx + dy * dy + dz * dz + np.float32(1e-12))
        there, at = 1 - here, ends[s, 1]
        for t in range(n):
            dx, dy, dz = x[t] - ax, y[t] - ay, z[t] - az
            ex, ey, ez = x[t] - bx, y[t] - by, z[t] - bz
            a, b = far[here, t], math.sqrt(ex * ex + ey * ey + ez * ez + np.float32(1e-12))
            far[there, t] = b
            cx, cy, cz = dy * ez - dz * ey, dz * ex - dx * ez, dx * ey - dy * ex
            c2 = cx * cx + cy * cy + cz * cz
            # (1 − a·b/|a||b|)(|a| + |b|) = ½(l² − (|a| − |b|)²)(|a| + |b|)/|a||b|, without the loss of digits.
            near = np.float32(0.5) * (l2 - (a - b) * (a - b)) * (a + b)
            down = -(cx * u[t] + cy * v[t] + cz * w[t]) * near
            induced[t] = down / (a * b * math.sqrt(c2 * c2 + (fixed + own * young[t])))
        here = there
        # One after the other: as two sums in one loop they might be the same, so not in vectors.
        for k in range(2):
            row, column, share = places[s, 0], (first - places[s, 1 + k]) % m, shares[s, k]
            # As rows of their own they would be counted by references: slower.
            for t in range(n if share else 0):
                out[row, column, t] += share * induced[t]


@dataclass(frozen=True, eq=False)
class _Lattice:
    """How the lines of a wake hang together, wherever it lies; the row of each is an edge, panel, or one of a strip."""

    ends: Integers
    """Nodes where each line begins and ends, (lines, 2)."""
    cores: Integers
    """Place of each line's core among those of `build_wake`, (lines,)."""
    places: Integers
    shares: Singles
    rows: tuple[int, ...]
    """First rows of: near edges, near panels, bound lines, far edges, far strips, far edges with mean circulation."""
    strips: Singles
    """By which circulations of strips become those of panels, (panels, strips)."""


@dataclass(frozen=True, eq=False)
class WakeLines(_Lattice):
    """Lines of the wakes of all blades at a course."""

    nodes: Singles
    """(azimuths, nodes, 3)."""
    core: Singles


def _groups(panels: int) -> Integers:
    """Edges of the strips of the far wake."""
    return np.unique(np.r_[0, np.arange(panels, 0, -GROUP)])


def _strip_weights(line: LiftingLine) -> Array:
    """By which circulations of panels become those of strips: weighted with r Δr, for the same impulse."""
    edges = _groups(line.panels)
    weight = line.r * np.diff(line.edges)
    out = np.zeros((len(edges) - 1, line.panels))
    for k, (a, b) in enumerate(pairwise(edges.tolist())):
        out[k, a:b] = weight[a:b] / weight[a:b].sum()
    return out


_OWN, _LEAST, _SHED, _FAR = range(4)
"""Cores that lines have: of whose blade it is, the least, that of shed lines, and the first by age and edge."""


def _steps(line: LiftingLine) -> tuple[int, int, float]:
    """Steps to the end of the near wake and to that of the strips, and a step [rad]."""
    step = 2.0 * math.pi / line.azimuths
    return max(round(line.near / step), 1), TURNS * line.azimuths, step


def build_wake(line: LiftingLine, course: WakeCourse, psi: Array) -> WakeLines:
    """The lines of the wakes of blades at azimuths psi."""
    picked, (near, turns, step) = line.edges[_groups(line.panels)], _steps(line)
    begin, end = turns * step, LENGTH / max(course.speed, LENGTH / OLDEST)
    # The last piece is as long as is left: nothing jumps with the number of pieces.
    end = max(end, begin + FAR_STEP)
    last = np.append(np.arange(begin, end - 1e-9, FAR_STEP)[1:], end)
    young = course.nodes(psi, np.arange(near * PIECES + 1) * step / PIECES, line.edges)
    half = 0.5 * (young[:, 0] + young[:, 1])  # What the first piece sheds, at its middle.
    old = course.nodes(psi, np.append(np.arange(near, turns + 1) * step, last), picked)
    nodes = [each.reshape(len(psi), -1, 3) for each in (young, half, old)]
    tip = np.sqrt(course.core[0] + course.core[1] * (np.arange(near, turns) + 0.5) * step)
    far = np.maximum(tip[:, None], np.where(picked < ROOT, ROOT_CORE, FAR_CORE)) ** 4
    lattice, core = (
        _lattice(line, len(last)),
        np.append([-1.0, LEAST_CORE**4, SHED_CORE**4], far).astype(np.float32),
    )
    return WakeLines(
        **vars(lattice),
        nodes=np.concatenate(nodes, axis=1, dtype=np.float32),
        core=core[lattice.cores],
    )


@bytes_cache
@read_only
def _lattice(line: LiftingLine, pieces: int) -> _Lattice:
    """That of wakes with so many trailing pieces beyond the strips."""
    (near, turns, _), n, strips = _steps(line), line.panels, len(_groups(line.panels)) - 1
    rows = tuple(np.cumsum([0, n + 1, n, n, strips + 1, strips, strips + 1]).tolist())
    young = np.arange((near * PIECES + 1) * (n + 1)).reshape(-1, n + 1)
    half = young[-1:] + n + 1
    old = (
        half[0, -1]
        + 1
        + np.arange((turns - near + 1 + pieces) * (strips + 1)).reshape(-1, strips + 1)
    )
    parts = list[Any]()

    def add(
        a: Integers, b: Integers, row: int, core: Any, ages: Any, shares: Any, order: Any = "C"
    ) -> None:
        """Lines from a to b, (ages, radii), age by age, or radius by radius with "F"; core: place of it."""
        columns: list[Any] = [a, b, core, row + np.arange(a.shape[1])]
        columns += (np.reshape(each, (-1, 1)) for each in (*ages, *np.transpose(shares)))
        parts.append(
            np.stack([np.broadcast_to(each, a.shape).ravel(order) for each in columns], axis=1)
        )

    def trailers(nodes: Integers, row: int, core: Any, ages: Any, shares: Any) -> None:
        """Lines from age to age."""
        add(nodes[:-1], nodes[1:], row, core, ages, shares, "F")

    def across(nodes: Integers, row: int, core: int, ages: Any, shares: Any) -> None:
        """Lines from radius to radius."""
        add(nodes[:, :-1], nodes[:, 1:], row, core, ages, shares)

    # Trailers and shed lines of the near wake. A piece carries the circulation of its middle.
    k, later = np.divmod(np.arange(near * PIECES), PIECES)
    later = (later + 0.5) / PIECES
    trailers(young, rows[0], _OWN, (k, k + 1), np.stack([1.0 - later, later], axis=1))
    across(half, rows[1], _OWN, (0, 1), np.array([[-0.5, 0.5]]) / PIECES)
    inner = np.arange(1, near * PIECES)
    whole, where = np.divmod(inner, PIECES)
    joint = where == 0  # Between two steps: half a piece of either.
    share = np.where(joint, 0.5, 1.0)[:, None] * np.array([-1.0, 1.0]) / PIECES
    across(young[inner], rows[1], _LEAST, (np.where(joint, whole - 1, whole), whole + 1), share)
    across(young[-1:], rows[1], _SHED, (near - 1, near), np.array([[-0.5, 0.5 - PIECES]]) / PIECES)
    across(young[:1], rows[2], _LEAST, (0, 0), np.array([[1.0, 0.0]]))

    # Strips: trailers carry the mean of a step's two ends, what changes from step to step is shed.
    k, count = np.arange(near, turns), turns - near
    core = _FAR + np.arange(count * (strips + 1)).reshape(count, -1)
    trailers(old[: count + 1], rows[3], core, (k, k + 1), np.full((count, 2), 0.5))
    share = np.broadcast_to([-0.5, 0.5], (count, 2)).copy()
    share[0] = 0.5
    across(old[:count], rows[4], _SHED, (np.append(near, k[:-1]), k + 1), share)
    trailers(old[count:], rows[5], core[-1], (0, 0), np.array([[1.0, 0.0]]))
    ends, cores, places, shares = np.split(np.concatenate(parts), [2, 3, 6], axis=1)
    ends, cores, places = (each.astype(np.int64) for each in (ends, cores[:, 0], places))
    return _Lattice(
        ends,
        cores,
        places,
        shares.astype(np.float32),
        rows,
        _strip_weights(line).T.astype(np.float32),
    )


def _by_panels(line: LiftingLine, wake: WakeLines, rows: Singles) -> Singles:
    """From sums by line, (rows, azimuths, targets), to those by panel, (panels, azimuths, targets)."""
    near_edges, near_panels, bound, edges, strips, mean, end = (*wake.rows,)
    panels = (
        rows[near_panels:bound] + rows[bound:edges] + np.diff(rows[near_edges:near_panels], axis=0)
    )
    grouped = rows[strips:mean] + np.diff(rows[edges:strips], axis=0)
    grouped += np.diff(rows[mean:end].sum(axis=1), axis=0)[:, None] / line.azimuths
    return panels + (wake.strips @ grouped.reshape(len(grouped), -1)).reshape(panels.shape)


def influence(line: LiftingLine, course: WakeCourse) -> Singles:
    """A, (points, points) with points in the order (panel, azimuth): row target, column source.

    Downwash over ΩR along the blade's normal, by circulation over ΩR².
    """
    n, m, blades = line.panels, line.azimuths, line.blades
    wake, young = build_wake(line, course, line.psi), own_core(line, course)
    out = np.empty((n, m, n, m), dtype=np.float32)
    for position in range(m // blades):
        at = position + m // blades * np.arange(blades)
        targets = _on_blades(line, course, line.psi[at])
        downwash = _seen(line, wake, targets, at, at, np.repeat(np.arange(blades), n), young)
        out[:, at] = downwash.reshape(n, m, blades, n).transpose(3, 2, 0, 1)
    return out.reshape(n * m, n * m)


@bytes_cache
@read_only
def mean_influence(line: LiftingLine, course: WakeCourse) -> Array:
    """Influence of circulations that do not change around the azimuth on the blade at azimuth 0, (panels, panels)."""
    at = line.azimuths // line.blades * np.arange(line.blades)
    wake, targets = build_wake(line, course, line.psi[at]), _on_blades(line, course, np.zeros(1))
    order = np.arange(line.blades)
    return (
        _seen(
            line, wake, targets, at, order, np.zeros(line.panels, np.int64), own_core(line, course)
        )
        .sum(axis=1)
        .T
    )


def at_points(line: LiftingLine, course: WakeCourse, points: Array, normals: Array) -> Array:
    """Downwash over ΩR at fixed points along their normals, by circulation over ΩR².

    points, normals: (targets, 3), in the axes of `geometry`. (positions, targets, points of the line): one value for
    each position of the rotor until a blade takes the place of the one before; their mean is the mean over time.
    """
    step, targets = (
        line.azimuths // line.blades,
        np.concatenate([points, normals], axis=1).T.astype(np.float32),
    )
    wake, off, places = (
        build_wake(line, course, line.psi),
        np.full(len(points), -1),
        step * np.arange(line.blades),
    )
    downwash = (
        _seen(line, wake, targets, k + places, k + places, off, np.zeros(0)) for k in range(step)
    )
    return np.stack([by_panel.reshape(-1, len(points)).T for by_panel in downwash]).astype(
        np.float64
    )


def _seen(
    line: LiftingLine,
    wake: WakeLines,
    targets: Singles,
    azimuths: Integers,
    places: Integers,
    seen: Integers,
    young: Array,
) -> Singles:
    """Downwash at targets on some blades, (panels, azimuths, targets).

    The blades stand at `azimuths`, their wakes are those at `places` of `wake`. seen: the blade on which each target
    lies, panel by panel, or −1, (targets,); young: c⁴ of that blade's young trailers, (panels,).
    """
    rows = np.zeros((wake.rows[-1], line.azimuths, targets.shape[1]), dtype=np.float32)
    for b, (first, place) in enumerate(zip(azimuths.tolist(), places.tolist(), strict=True)):
        core, on_it = np.full(targets.shape[1], LEAST_CORE**4, dtype=np.float32), seen == b
        core[on_it] = young[: on_it.sum()]
        _sum_lines(
            targets,
            wake.nodes[place],
            wake.ends,
            wake.core,
            core,
            wake.places,
            wake.shares,
            first,
            rows,
        )
        # A blade's own bound line has no downwash on it.
        rows[wake.rows[2] : wake.rows[3], first, on_it] = 0.0
    return _by_panels(line, wake, rows) / (4.0 * math.pi)


def _on_blades(line: LiftingLine, course: WakeCourse, psi: Array) -> Singles:
    """Control points and normals of blades at psi, (6, blades × panels)."""
    beta, cos, sin = course.flapping(psi)[:, None], np.cos(psi)[:, None], np.sin(psi)[:, None]
    r, ones = line.r, np.ones(line.panels)
    along = [r * cos, r * sin, beta * r, -beta * cos * ones, -beta * sin * ones, ones + 0.0 * cos]
    return np.array(along, dtype=np.float32).reshape(6, -1)


def own_core(line: LiftingLine, course: WakeCourse) -> Array:
    """c⁴ of a blade's own young trailers at its control points, (panels,)."""
    return (OWN_CORE * (1.0 - _outboard(line, course))) ** 4


def _outboard(line: LiftingLine, course: WakeCourse) -> Array:
    """1 where no wake passes back over the blade, 0 where it does, and smoothly between, (panels,)."""
    y = np.clip((line.r - course.mu_x - BARE[0]) / (BARE[1] - BARE[0]), 0.0, 1.0)
    return y * y * (3.0 - 2.0 * y)


def theodorsen(k: Array) -> NDArray[np.complex128]:
    """C(k) = H1/(H1 + i H0) of the second kind, complex, shape of k; 1 at k = 0 (Theodorsen, NACA Report 496, 1935)."""
    h1, h0 = hankel2(1, np.maximum(k, 1e-12)), hankel2(0, np.maximum(k, 1e-12))
    return np.asarray(h1 / (h1 + 1j * h0), dtype=np.complex128)


def lattice_lag(line: LiftingLine, course: WakeCourse, harmonic: Array) -> NDArray[np.complex128]:
    """Downwash over ΩR of a panel's own shed lines by its circulation exp(inψ) over ΩR², in a straight wake: complex.

    harmonic: n, (harmonics,). (panels, harmonics). The lines are those of `build_wake`, as if they ran on along the
    blade.
    """
    straight = WakeCourse(0.0, 0.0, 1.0, coning=0.0, flap_1c=0.0, flap_1s=0.0, core=course.core)
    wake, groups = build_wake(line, straight, np.zeros(1)), _groups(line.panels)
    row, rows = wake.places[:, 0], wake.rows
    young, old = (
        np.flatnonzero((row >= rows[k]) & (row < rows[k + 1])).reshape(-1, rows[k + 1] - rows[k])
        for k in (1, 4)
    )
    strip = np.searchsorted(groups, np.arange(line.panels), side="right") - 1
    shed = np.concatenate(
        [young, old[:, strip]]
    ).T  # (panels, lines): the lines of all panels are of the same ages.
    # It sinks by 1 in an age of 1.
    age = -wake.nodes[0, wake.ends[shed], 2].mean(axis=-1, dtype=np.float64)
    x, core = line.r[:, None] * age, wake.core[shed].astype(np.float64)
    core = np.where(core < 0.0, own_core(line, course)[:, None], core)
    gain = -wake.shares[shed] * (x / (2.0 * math.pi * np.sqrt(np.square(x * x) + core)))[..., None]
    step = 2.0 * math.pi / line.azimuths
    turned = np.exp(-1j * step * np.multiply.outer(harmonic, wake.places[shed[0], 1:]))
    return np.asarray(
        gain.reshape(line.panels, -1) @ turned.reshape(len(harmonic), -1).T, dtype=np.complex128
    )


def shed_correction(line: LiftingLine, course: WakeCourse, half_chord: Array) -> Array:
    """To be added to A/D between azimuths of a panel, (panels, azimuths, azimuths); half_chord: b/R, (panels,)."""
    n, r, b = (
        np.arange((line.azimuths + 1) // 2, dtype=np.float64),
        line.r[:, None],
        half_chord[:, None],
    )
    missing = (1.0 / theodorsen(n * b / r) - 1.0) / (2.0 * math.pi * b)
    beyond = 1j * n[1:] / (2.0 * math.pi * r) * exp1(1j * n[1:] * 2.0 * math.pi * TURNS)
    missing[:, 1:] -= beyond  # Further back than the shed lines reach.
    missing -= lattice_lag(line, course, n) / course.mass_flow
    missing *= _outboard(line, course)[:, None]
    missing[:, 0] = 0.0
    back = (np.arange(line.azimuths)[:, None] - np.arange(line.azimuths)) % line.azimuths
    return (2.0 / line.azimuths * (missing @ np.exp(1j * np.outer(n, line.psi))).real)[:, back]

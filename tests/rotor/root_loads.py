"""Loads of one blade on its root, summed station by station along the blade: hub loads seen from another side."""

import numpy as np

from rotor.aero.bending import BladeBending
from rotor.aero.problem import Problem
from rotor.aero.section import FR, FX, FZ
from rotor.columns.bending import coordinates_of
from rotor.engine.linearise import Point
from rotor.engine.waves import wave_grid
from rotor.support.arrays import Array
from rotor.support.units import GRAVITY


def root_loads(problem: Problem, point: Point) -> tuple[Array, Array]:
    """Loads of one blade on its root: force outward, forward and up [N], and moment in flap and in lag [N m].

    (3, azimuths) and (2, azimuths): air loads and weight less mass times acceleration. Moments are positive up and
    forward; at a hinge or a sprung root they are those of springs and damper, up to what the modes leave and small
    angles neglect: the mean lag moment of HART II on a soft spring by 5 % with any number of modes; that of the UH-60A
    on stiff springs by 17 %, less with more modes. Loads on the hub are made of the forces.
    """
    b, disk, forces = problem.bending, problem.disk, point.forces
    assert b is not None
    rotor = problem.design.rotor
    u, v, w = displacements(b, *coordinates_of(b, point.system.structure, point.z), forces.shape[2])
    (u_rate, u_second), (v_rate, v_second), (_, w_second) = (
        _rates(deflection) for deflection in (u, v, w)
    )
    acceleration = np.stack(
        [u_second - (b.r[:, None] + u) - 2.0 * v_rate, v_second - v + 2.0 * u_rate, w_second]
    )
    acceleration[2] += GRAVITY / (rotor.radius * rotor.angular_speed**2)
    air = np.stack([forces[FR], -forces[FX], forces[FZ]])
    force = np.einsum("i,kij->kj", disk.dr, air) - np.einsum("i,kij->kj", b.strips, acceleration)

    def moment(along: int, moved: Array) -> Array:
        """Moment of the forces along one axis times their distance from the root, less those outward times theirs."""
        moved = moved - moved[0]
        columns: list[Array] = [np.interp(disk.r, b.r, column) for column in moved.T]
        of_air = (disk.r - b.r[0]) * disk.dr @ air[along] - disk.dr @ (
            np.stack(columns, axis=1) * air[0]
        )
        return (
            of_air
            - (b.r - b.r[0]) * b.strips @ acceleration[along]
            + b.strips @ (moved * acceleration[0])
        )

    return force * b.force, np.stack([moment(2, w), moment(1, v)]) * (b.force * rotor.radius)


def displacements(
    b: BladeBending, q: Array, offset: float, azimuths: int
) -> tuple[Array, Array, Array]:
    """u outward, v forward with the offset y0, and w up over R at the stations of a blade: (stations, azimuths)."""
    q = q.copy()
    q[b.first, 0] -= b.precone
    around = q @ wave_grid(q.shape[1], azimuths).at
    w = b.precone * (b.r - b.r[0])[:, None] + b.along[0].T @ around
    v = offset + b.along[3].T @ around
    slopes = (b.precone + b.along[1].T @ around) ** 2 + (b.along[4].T @ around) ** 2
    u = -0.5 * (b.r[1] - b.r[0]) * (np.cumsum(slopes, axis=0) - 0.5 * (slopes + slopes[0]))
    return u, v, w


def _rates(field: Array) -> tuple[Array, Array]:
    """First and second derivative by ψ of a periodic field, (…, azimuths)."""
    count = field.shape[-1]
    harmonic: Array = np.arange(count // 2 + 1, dtype=float)
    spectrum = np.fft.rfft(field)
    first = np.where(2.0 * harmonic == count, 0.0, 1j * harmonic)
    return np.fft.irfft(first * spectrum, count), np.fft.irfft(-(harmonic**2) * spectrum, count)

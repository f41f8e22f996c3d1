"""Field and free strain of a piezoelectric sheet, with continuous and with interdigitated electrodes.

What figures 5.2–5.7 of the document are about, by their titles. Strain along the fibres is d·E with E = V/gap:
interdigitated electrodes lay the field along the fibres (d33, gap = electrode pitch), continuous ones through the
thickness (d31, gap = thickness).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from rotor.actuator.catalogue import PiezoPly
from rotor.arrays import Array


def electric_field(ply: PiezoPly, voltage: ArrayLike) -> Array:
    """E = V/gap [V/m]."""
    return np.asarray(voltage, dtype=float) / ply.electrode_gap


def thermal_coefficients(ply: PiezoPly) -> tuple[float, float]:
    """α = d/ΔES along and across the fibres [1/V]: a volt does what a kelvin would do to a sheet of this expansion.

    Source: thermal analogy of piezoelectric strain (Cote et al. 2004; the document's ΔES is the electrode gap).
    MFC P1: 460 pm/V over 0.5 mm = 9.2e-7 per V; measured 7.5e-7…9.0e-7. Range: strain linear in the field.
    """
    return ply.d_along / ply.electrode_gap, ply.d_across / ply.electrode_gap


def free_strain(ply: PiezoPly, voltage: ArrayLike) -> Array:
    """Free strain along and across the fibres [-], (2, …), linear between the ends of the range, zero at 0 V.

    Measured swing over the voltage swing, not the coefficient d: the two differ by the material's non-linearity.
    """
    per_volt = np.array(ply.swing) / ply.voltage_swing
    return np.multiply.outer(per_volt, np.asarray(voltage, dtype=float))


@dataclass(frozen=True, eq=False)
class StrainCurve:
    """Strain of one sheet over its voltage range, for a chart."""

    label: str
    voltage: Array
    """[V]"""
    field: Array
    """[V/m]"""
    along: Array
    """Free strain along the fibres [-]."""
    across: Array
    by_coefficient: Array
    """α V of the thermal analogy along the fibres [-]."""


def strain_curve(ply: PiezoPly, points: int = 41) -> StrainCurve:
    """Free strain against voltage and field."""
    voltage = np.linspace(*ply.voltage_range, points)
    along, across = free_strain(ply, voltage)
    return StrainCurve(
        label=f"{ply.name} ({'d33' if ply.electrodes == 'interdigitated' else 'd31'})",
        voltage=voltage,
        field=electric_field(ply, voltage),
        along=along,
        across=across,
        by_coefficient=thermal_coefficients(ply)[0] * voltage,
    )


def deformed_sheet(ply: PiezoPly, voltage: float, *, exaggerate: float = 1.0) -> Array:
    """Corners of a unit square of the free sheet, fibres along x, at a voltage, (4, 2): what figure 5.2 is about."""
    along, across = exaggerate * free_strain(ply, voltage)
    half = 0.5 * np.array([1.0 + along, 1.0 + across])
    return half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


@dataclass(frozen=True, eq=False)
class FieldMap:
    """The field between electrodes in a cut along the fibres, over the mean field of the gap."""

    x: Array
    """Along the fibre, one gap, in gaps (columns,)."""
    z: Array
    """Through the sheet, in gaps (rows,)."""
    potential: Array
    """0…1 from one electrode to the other, (rows, columns)."""
    strength: Array
    """|E| over V/gap, (rows, columns)."""


@lru_cache(maxsize=16)
def field_map(ply: PiezoPly, finger: float = 0.2, points: int = 61, sweeps: int = 4000) -> FieldMap:
    """Potential between two interdigitated fingers (or two plates), by relaxation of Laplace's equation.

    One gap along the fibre between finger centres, fingers on both faces, each covering `finger` of the gap.
    Continuous electrodes need no solution: the field is V over the thickness. Range: one dielectric, static.
    """
    if ply.electrodes == "continuous":
        z = np.linspace(0.0, 1.0, points)
        potential = np.repeat(z[:, None], points, axis=1)
        return FieldMap(np.linspace(0.0, 1.0, points), z, potential, np.ones((points, points)))
    x = np.linspace(0.0, 1.0, points)
    rows = max(7, round(ply.thickness / ply.electrode_gap * (points - 1)) + 1)
    step = x[1]
    value = np.repeat(x[None, :], rows, axis=0)
    low, high = x <= 0.5 * finger + 1e-12, x >= 1.0 - 0.5 * finger - 1e-12
    for _ in range(sweeps):
        # Insulated faces and symmetry planes: mirror; over-relaxation is not worth its words here.
        wide = np.pad(value, 1, mode="reflect")
        value = 0.25 * (wide[:-2, 1:-1] + wide[2:, 1:-1] + wide[1:-1, :-2] + wide[1:-1, 2:])
        for face in (0, -1):
            value[face, low], value[face, high] = 0.0, 1.0
    value_x, value_z = np.gradient(value, step, axis=1), np.gradient(value, step, axis=0)
    return FieldMap(x, step * np.arange(rows), value, np.hypot(value_x, value_z))

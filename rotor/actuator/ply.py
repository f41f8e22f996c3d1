"""Piezoelectric plies.

Strain along the fibres is d·E with E = V/gap. Interdigitated electrodes lay the field along the fibres (d33, gap =
electrode pitch), continuous electrodes through the thickness (d31, gap = thickness). Figures 5.4–5.7 of the thesis.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from rotor.actuator.kind import (
    MOST_BOUNDS,
    Actuator,
    Drive,
    InstalledActuator,
    Limit,
    MassBreakdown,
    Swings,
)
from rotor.actuator.limits import HALF_THICKNESS, fibre_strain
from rotor.actuator.section import (
    HostBlade,
    Placement,
    SectionSpec,
    calibrate,
    panels,
    passive_wall,
)
from rotor.dynamics.structure import structure_data, uh60a_structure
from rotor.dynamics.thin_wall import (
    Layer,
    Material,
    WallSection,
    build_section,
    induced_twist_rate,
    torsional_stiffness,
)
from rotor.support.arrays import Array
from rotor.trim.solution import Solution

Electrodes = Literal["interdigitated", "continuous"]


@dataclass(frozen=True, kw_only=True)
class PiezoPly(Actuator):
    """A piezoelectric sheet bonded to, or cured into, the skin."""

    electrodes: Electrodes
    """`interdigitated`: field along the fibres, d33 works; `continuous`: field through the thickness, d31 works."""
    material: Material
    thickness: float
    """[m]"""
    d_along: float
    """Strain along the fibres over field [m/V], high field."""
    d_across: float
    """Strain across the fibres over field [m/V], high field."""
    electrode_gap: float
    """Distance between electrodes, the path of the field [m]."""
    voltage_range: tuple[float, float]
    """[V]"""
    swing: tuple[float, float]
    """Free strain along and across over the whole voltage range, peak to peak [-]."""
    capacitance_per_area: float
    """[F/m²]"""
    linear_strain: float
    """Tension along the fibres that the sheet follows linearly [-]."""
    largest_strain: float
    """[-]"""
    hysteresis: float
    """Width of the strain loop over its height [-]."""

    noun = "ply", "plies"
    settings = "plies", "span", "chord", "crossed"
    drive_noun, drive_unit = "voltage", "V"
    follows_azimuth = True
    range_limits = "voltage", "field"

    @classmethod
    def read(cls, row: Mapping[str, Any]) -> Self:
        moduli = (row[key] for key in ("e1", "e2", "nu12", "g12", "density"))
        ranges = {"voltage_range": (row["voltage_min"], row["voltage_max"])}
        ranges["swing"] = row["swing_along"], row["swing_across"]
        own = {
            "material": Material(row["name"], *moduli),
            "capacitance_per_area": row["capacitance"],
        }
        return super().read({**row, **ranges, **own})

    @property
    def mode(self) -> str:
        return "d33 fibres" if self.electrodes == "interdigitated" else "d31 sheet"

    @property
    def properties(self) -> dict[str, str]:
        material, gap, (low, high) = self.material, self.electrode_gap, self.voltage_range
        return {
            "E1 GPa": f"{material.e1 / 1e9:.1f}",
            "E2 GPa": f"{material.e2 / 1e9:.1f}",
            "G12 GPa": f"{material.g12 / 1e9:.2f}",
            "d pm/V": f"{self.d_along * 1e12:.0f}",
            "ΔES mm": f"{gap * 1e3:.3g}",
            "α 1e-6/V": f"{self.d_along / gap * 1e6:.2f}",
            "voltage V": f"{low:g}…{high:g}",
            "field kV/mm": f"{low / gap * 1e-6:.2f}…{high / gap * 1e-6:.2f}",
            "free strain µε": f"{self.swing[0] * 1e6:.0f}",
            "thickness mm": f"{self.thickness * 1e3:.3g}",
            "density kg/m³": f"{material.density:.0f}",
        }

    @property
    def caveats(self) -> tuple[str, ...]:
        return (
            *super().caveats,
            f"{self.name}: {100.0 * self.hysteresis:.0f} % hysteresis and creep, so holding a twist needs strain "
            "feedback or charge drive. Without voltage the blade returns to its built-in twist.",
        )

    def depth(self, placement: Placement) -> float:
        return placement.plies * self.thickness

    # Voltage

    @property
    def voltage_swing(self) -> float:
        """Peak-to-peak voltage over the whole range [V]."""
        return self.voltage_range[1] - self.voltage_range[0]

    @property
    def drive_range(self) -> tuple[float, float]:
        return self.voltage_range

    @property
    def drive_swing(self) -> float:
        return self.voltage_swing

    def field(self, voltage: ArrayLike) -> Array:
        """Electric field E = V/gap [V/m] at a voltage [V]."""
        return np.asarray(voltage, dtype=float) / self.electrode_gap

    def free_strain(self, voltage: ArrayLike) -> Array:
        """Free strain along and across the fibres [-], (2, …), linear between the ends of the range, zero at 0 V.

        Measured swing over the voltage swing, not the coefficient d: the two differ by the material's non-linearity.
        """
        return np.multiply.outer(
            np.array(self.swing) / self.voltage_swing, np.asarray(voltage, dtype=float)
        )

    def voltages(
        self, swings: tuple[Swings, ...], host: HostBlade
    ) -> tuple[tuple[float, ...], ...]:
        """A retrofit counts from zero volts. A new blade's jig twist is set so that the voltages of a segment lie
        around zero as far as the negative range allows; without voltage the blade then flies between its twists.
        """
        low, high = self.voltage_range
        voltages = self.voltage_swing * np.array(swings).T
        for segment in voltages:
            if host.kind == "new":
                segment += max(low, -0.5 * np.ptp(segment)) - segment.min()
            elif segment.min() < low - 1e-6 or segment.max() > high + 1e-6:
                segment *= -1.0  # Fibres laid in the other direction.
        return tuple(tuple(segment) for segment in voltages.tolist())

    # On a blade

    def layer(self, plies: int, angle: float) -> Layer:
        """The plies as one layer of a wall, fibres at `angle` [rad], driven through the whole voltage range."""
        return Layer(self.material, plies * self.thickness, angle, self.swing)

    def masses(
        self, placement: Placement, blades: int, skin_area: float, length: float
    ) -> MassBreakdown:
        limits = structure_data()["limits"]
        wiring, electronics = float(limits["wiring_share"]), float(limits["electronics_share"])
        plies = self.material.density * self.thickness * placement.plies * skin_area
        nose = balance_mass((1.0 + wiring) * plies, 0.5 * sum(placement.chord))
        return MassBreakdown(blades, plies, wiring * plies, nose, electronics * plies * blades)

    def section(self, spec: SectionSpec, placement: Placement) -> tuple[float, float]:
        section = active_section(spec, self, placement)
        stiffness = torsional_stiffness(section)
        return stiffness, stiffness * induced_twist_rate(section)

    def capacitance(self, installed: InstalledActuator) -> float:
        """Capacitance C = c_A A n of the plies on one blade [F]."""
        return self.capacitance_per_area * installed.skin_area * installed.placement.plies

    def drive(self, installed: InstalledActuator, swings: Swings) -> Drive:
        """Power to slew: the energy ½C ΔV² of each segment over the slewing time."""
        data = structure_data()["electrical"]
        per_area = self.capacitance_per_area * installed.placement.plies
        segments = zip(installed.segment_areas, swings, strict=True)
        energy = sum(
            0.5 * per_area * area * (swing * self.voltage_swing) ** 2 for area, swing in segments
        )
        time = float(data["slew_s"])
        slew = installed.masses.blades * energy / time / float(data["amplifier_efficiency"])
        return Drive(self.capacitance(installed), 0.0, slew, time)

    def harmonic_loss(
        self, installed: InstalledActuator, per_rev: float, amplitude: float
    ) -> float:
        """Heat π f C V_a² tan δ [W] on one blade, the dielectric loss of a capacitor."""
        frequency = per_rev * installed.beam.angular_speed / (2.0 * math.pi)
        voltage = 0.5 * amplitude * self.voltage_swing
        loss_tangent = float(structure_data()["electrical"]["loss_tangent"])
        return math.pi * frequency * self.capacitance(installed) * voltage**2 * loss_tangent

    # Limits

    def limits(
        self, installed: InstalledActuator, swings: Swings, solutions: Sequence[Solution]
    ) -> tuple[Limit, ...]:
        return (
            *self._electrical(swings),
            self._strain(installed, solutions),
            self._surface(installed),
        )

    def _electrical(self, swings: Swings) -> tuple[Limit, Limit]:
        most = max((abs(swing) for swing in swings), default=0.0) * self.voltage_swing
        (low, high), gap = self.voltage_range, self.electrode_gap
        ok = most <= self.voltage_swing * (1.0 + 1e-9)
        field, allowed = (volts / gap * 1e-6 for volts in (most, self.voltage_swing))
        span = f"{low:g}…{high:g} V ({low / gap * 1e-6:.2g}…{high / gap * 1e-6:.2g} kV/mm)"
        needs, swings_by = f"needs a swing of {most:.0f} V", f"swings by {field:.2f} kV/mm"
        if most > MOST_BOUNDS * self.voltage_swing:  # A sheet that hardly shears.
            needs = "is out of range at any voltage"
            swings_by = f"would have to swing by far more than {allowed:.2f} kV/mm"
        by_voltage = f"The required twist {needs}; the range is {span}."
        by_field = f"The field {swings_by}; a reverse field beyond the range depolarises the sheet."
        voltage = Limit("voltage", ok, most, self.voltage_swing, "V", by_voltage)
        return voltage, Limit("field", ok, field, allowed, "kV/mm", by_field)

    def _strain(self, installed: InstalledActuator, solutions: Sequence[Solution]) -> Limit:
        strain = fibre_strain(installed, self.material.nu12, solutions)
        worst, linear, most = (
            1e6 * x for x in (float(strain.total.max()), self.linear_strain, self.largest_strain)
        )
        where = float(strain.r[strain.total.argmax()])
        flap = "with flap bending of the trimmed rotor" if solutions else "without flap bending"
        sentence = (
            f"Fibre strain is up to {worst:.0f} µε at {where:.2f} R ({flap}); the sheet is linear "
            f"up to {linear:.0f} µε and must stay below {most:.0f} µε."
        )
        return Limit("fibre-strain", worst <= linear, worst, linear, "µε", sentence)

    def _surface(self, installed: InstalledActuator) -> Limit:
        plies = installed.placement.plies
        share = plies * self.thickness / (HALF_THICKNESS * uh60a_structure().chord)
        bound = float(structure_data()["limits"]["surface_share"])
        outside = installed.host.kind == "retrofit"
        where = (
            "outside the skins, which changes the contour" if outside else "inside the torsion skin"
        )
        sentence = (
            f"Plies per side: {plies}, {where}: {100.0 * share:.1f} % of the section's thickness."
        )
        return Limit(
            "space",
            not outside or share <= bound,
            100.0 * share,
            100.0 * bound,
            "% of thickness",
            sentence,
        )


def balance_mass(mass: float, centre: float) -> float:
    """Nose weight [kg] for a mass with its centre at x/c: Δm = m (x − 0.25)/(0.25 − 0.02), none when it is forward."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    return max(0.0, mass * (centre - axis) / (axis - nose))


def active_section(spec: SectionSpec, ply: PiezoPly, placement: Placement) -> WallSection:
    """The section with its plies.

    Retrofit: the passive section is calibrated, then plies are bonded outside, so GJ grows. New blade: the plies are
    part of the torsion box, whose passive skin is made as thick as the wanted GJ leaves room for.
    """
    active = ply.layer(placement.plies, placement.angle)
    if spec.host.kind == "retrofit":
        return build_section(panels(spec, passive_wall(spec), placement, active))
    plain = Placement(chord=placement.chord, plies=placement.plies, angle=placement.angle)
    return build_section(panels(spec, passive_skin(spec, ply, plain), placement, active))


@lru_cache(maxsize=64)
def passive_skin(spec: SectionSpec, ply: PiezoPly, placement: Placement) -> float:
    """Passive skin [m] of a new blade that, with the plies in it, has the wanted GJ."""
    return calibrate(spec, placement, ply.layer(placement.plies, placement.angle))

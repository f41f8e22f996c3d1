"""Our rotor compared with two independent public codes: dynbem in forward flight, WISDEM's CCBlade in axial flow.

Both use our trimmed controls, our blade and our section data, so the remaining differences come from their
mathematics. Neither is a dependency: they are installed by the extras `test` and `crosscheck`.
"""

import importlib
import importlib.util
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import root

from rotor.airfoil.sections import load_section
from rotor.arrays import Array
from rotor.files.make_design import make_design
from rotor.line_chart import LineChart, Series
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation.trust import TrustRow, TrustSet, share, trust_rows

DYNBEM_SPEEDS = (0.10, 0.20, 0.30)
CCBLADE_MASSES = (5000.0, 8322.4)
RATE_DEG = -8.0
SECTION = "sc1095-thesis"
MACH = 0.3
AXIAL_SPEED = 0.02
"""CCBlade divides by the axial speed; hover is run as a climb of 0.02 m/s, with about 13 m/s induced."""


@dataclass(frozen=True)
class CodeComparison:
    """One condition in both codes."""

    condition: str
    thrust: float
    """Their value over ours, minus one."""
    power: float
    """Their torque over ours, minus one."""
    detail: str


DYNBEM_DIFFERENCES = (
    "Same: blade, twist, section table, collective, cyclic, shaft tilt, no loss factors. Theirs: three inflow states "
    "driven by thrust and both hub moments, rigid blades. Ours: the same states with zero hub moments, and coning "
    "taken away by a heavy blade."
)
CCBLADE_DIFFERENCES = (
    "Same: blade, twist, section table, collective, Prandtl tip factor. Theirs: a turbine code run as a rotor (section "
    "mirrored), sin φ for φ in the tip factor. Ours leaves out swirl; both are shown."
)


def have(package: str) -> bool:
    """Whether the code is installed."""
    return importlib.util.find_spec(package) is not None


def dynbem() -> TrustSet:
    """Pitt–Peters inflow in forward flight; the shipped rows where dynbem is not installed."""
    test = "rotor/validation/test_cross_codes.py::test_dynbem_pitt_peters_forward_flight"
    made = beside_dynbem() if have("dynbem") else []
    rows = [
        share("dynbem", "public code", f"Torque, {one.condition}", "dynbem 0.8, Pitt–Peters", one.power, 5e-4, test,
              f"Thrust {100 * one.thrust:+.2f} %. {one.detail}.", digits=2)
        for one in made
    ]  # fmt: skip
    rows = rows or [row for row in trust_rows() if row.set == "dynbem"]
    series = Series("dynbem's torque over ours", DYNBEM_SPEEDS, _percent(rows), "both", 1)
    chart = LineChart("Torque of dynbem over ours", "advance ratio µ", "difference [%]", (series,))
    return TrustSet(
        "dynbem", "dynbem", "Torque in forward flight", f"{_percent(rows)[-1]:+.2f} % at most",
        "dynbem 0.8, run at our controls with its inflow settled.", tuple(rows), (chart,), (DYNBEM_DIFFERENCES,),
    )  # fmt: skip


def ccblade() -> TrustSet:
    """Hover, without and with swirl; the shipped rows where WISDEM is not installed."""
    test = "rotor/validation/test_cross_codes.py::test_ccblade_hover"
    made = beside_ccblade() if have("wisdem") else []
    rows = [
        share("ccblade", "public code", f"Power, {one.condition}", "CCBlade of WISDEM 4.2, axial", one.power, 5e-4,
              test, f"Thrust {100 * one.thrust:+.2f} %, {one.detail}.", digits=2)
        for one in made
    ]  # fmt: skip
    rows = rows or [row for row in trust_rows() if row.set == "ccblade"]
    power = _percent(rows)
    series = (
        Series("without swirl", CCBLADE_MASSES, power[0::2], "both", 1),
        Series("with swirl", CCBLADE_MASSES, power[1::2], "both", 2),
    )
    chart = LineChart("Hover power of CCBlade over ours", "mass [kg]", "difference [%]", series)
    return TrustSet(
        "ccblade", "CCBlade", "Hover power without and with swirl",
        f"{power[0]:+.2f} %, with swirl {min(power):+.2f} %",
        "CCBlade of WISDEM 4.2, run at our collective.", tuple(rows), (chart,), (CCBLADE_DIFFERENCES,),
    )  # fmt: skip


def _percent(rows: list[TrustRow]) -> tuple[float, ...]:
    return tuple(100.0 * (row.error or 0.0) for row in rows)


def beside_dynbem() -> list[CodeComparison]:
    """Pitt–Peters, forward flight, moment trim; dynbem at our controls with its inflow settled."""
    return [_one_dynbem(mu) for mu in DYNBEM_SPEEDS]


def beside_ccblade() -> list[CodeComparison]:
    """Hover: CCBlade at our collective, without and with its swirl."""
    return [_one_ccblade(mass, swirl) for mass in CCBLADE_MASSES for swirl in (False, True)]


def moment_trimmed(mu: float) -> Solution:
    """The thesis' rotor in propulsive trim with three-state gains, no loss factors and, as dynbem's, rigid blades."""
    design = make_design(preset="thesis", twist=f"linear:{RATE_DEG}", mu=mu)
    models = replace(
        design.models, trim="propulsive", disk_axial_flow=True, inflow="pitt-peters", tip_loss=False, hub_loss=False
    )
    blade = replace(design.rotor.blade, flap_inertia=1e8 * design.rotor.blade.flap_inertia)  # Too heavy to cone.
    return solve(replace(design, models=models, rotor=replace(design.rotor, blade=blade))).require()


def _one_dynbem(mu: float) -> CodeComparison:
    dynbem: Any = importlib.import_module("dynbem")
    ours = moment_trimmed(mu)
    design, controls, rotor = ours.design, ours.controls, ours.design.rotor
    alpha = np.radians(np.arange(-180.0, 180.1, 0.25))
    section = load_section(SECTION)(alpha, MACH)
    stations = np.linspace(rotor.blade.root_cutout, 1.0, 81)
    chord = [rotor.reference_chord] * len(stations)
    blade = dynbem.BladeGeometry(
        rotor.blades, rotor.radius, rotor.blade.root_cutout * rotor.radius, rotor.reference_chord, 0.0,
        design.models.elements, (rotor.radius * stations).tolist(), chord, (RATE_DEG * (stations - 0.75)).tolist(),
        False,
    )  # fmt: skip
    definition = dynbem.RotorDefinition(
        blade,
        dynbem.LinearPolarParameters(0.0, 6.0, 0.01, 12.0),  # Not used: replaced by the table below.
        control=dynbem.ControlProperties(swashplate_pitch_gain_rad=1.0),
    )
    polar = dynbem.TabulatedPolar(alpha, np.ascontiguousarray(section.cl), np.ascontiguousarray(section.cd))
    model = dynbem.PittPetersModel(definition, polar, design.models.azimuths)
    speed, tilt = design.airspeed, controls.shaft_tilt
    # World axes: x forward, z down; azimuth from the nose, so both cyclics change sign.
    inputs = dynbem.RotorInputs(
        collective_rad=controls.collective, tilt_lon=controls.cyclic_1c, tilt_lat=-controls.cyclic_1s, R_hub=np.eye(3),
        v_hub_world=np.array([speed * math.cos(tilt), 0.0, -speed * math.sin(tilt)]), wind_world=np.zeros(3),
        omega_rad_s=rotor.angular_speed, rho_kg_m3=design.condition.density,
    )  # fmt: skip
    state = dynbem.PittPetersRotorState(controls.lambda0, 0.0, 0.0)
    forces, state = _settle(model, inputs, state)
    thrust = -float(forces.F_world[2])
    torque = ours.power.shaft / rotor.angular_speed
    lambda0, gradient, _ = (float(value) for value in state.to_array())
    return CodeComparison(
        condition=f"µ {mu:g}",
        thrust=thrust / (ours.ct * design.thrust_unit) - 1.0,
        power=float(forces.Q_spin) / torque - 1.0,
        detail=f"λ0 {lambda0:.5f} against {controls.lambda0:.5f}; its gradient {-gradient / lambda0:.4f} λ0 against "
        f"{_gradient(ours):.4f} λ0",
    )


def _gradient(ours: Solution) -> float:
    """k_x = 15π/32 tan(χ/2) at the trim."""
    mu, tilt = ours.design.condition.advance_ratio, ours.controls.shaft_tilt
    skew = math.atan2(mu * math.cos(tilt), mu * math.sin(tilt) + ours.controls.lambda0)
    return 15.0 * math.pi / 32.0 * math.tan(0.5 * skew)


def _settle(model: Any, inputs: Any, state: Any) -> tuple[Any, Any]:
    """Forces and inflow states where the rates of these are zero."""

    def rates(x: Array) -> Array:
        return np.array(model.compute_forces(inputs, state.from_array(x))[1].to_array(), dtype=np.float64)

    found = root(rates, np.array(state.to_array(), dtype=np.float64), tol=1e-13)
    assert np.abs(rates(found.x)).max() < 1e-10, found.message
    settled = state.from_array(found.x)
    return model.compute_forces(inputs, settled)[0], settled


class _MirroredSection:
    """Our section table in CCBlade's interface: for a turbine α is φ − θ, and lift changes sign."""

    def __init__(self) -> None:
        self.table = load_section(SECTION)

    def evaluate(self, alpha: float, reynolds: float, return_cm: bool = False) -> tuple[float, ...]:
        """(cl, cd) at α [rad], and cm, which CCBlade does not use."""
        del reynolds
        found = self.table(-float(np.asarray(alpha).item()), MACH)
        pair = (-float(found.cl), float(found.cd))
        return (*pair, 0.0) if return_cm else pair


def _one_ccblade(mass: float, swirl: bool) -> CodeComparison:
    ccblade: Any = importlib.import_module("wisdem.ccblade.ccblade")
    design = make_design(preset="thesis", twist=f"linear:{RATE_DEG}", mu=0.0, mass_kg=mass)
    models = replace(design.models, hover_inflow="annulus", hub_loss=False)
    ours = solve(replace(design, models=models)).require()
    rotor = design.rotor
    root = rotor.blade.root_cutout
    n = models.elements
    r = root + (np.arange(n) + 0.5) / n * (1.0 - root)
    section = _MirroredSection()
    code = ccblade.CCBlade(
        rotor.radius * r, np.full(n, rotor.reference_chord), RATE_DEG * (r - 0.75), [section] * n,
        rotor.radius * root, rotor.radius, B=rotor.blades, rho=design.condition.density, tiploss=True, hubloss=False,
        wakerotation=swirl, usecd=True, shearExp=0.0,
    )  # fmt: skip
    rpm = rotor.angular_speed * 60.0 / (2.0 * math.pi)
    loads, _ = code.distributedAeroLoads(AXIAL_SPEED, rpm, math.degrees(ours.controls.collective), 0.0)
    # Summed like ours, element by element; CCBlade's own sum adds zero loads at both ends of the blade.
    width = rotor.radius * (1.0 - root) / n
    thrust = -rotor.blades * float(np.asarray(loads["Np"]).sum()) * width
    torque = -rotor.blades * float((np.asarray(loads["Tp"]) * rotor.radius * r).sum()) * width
    return CodeComparison(
        condition=f"hover, {mass:g} kg, {'with' if swirl else 'without'} swirl",
        thrust=thrust / (ours.ct * design.thrust_unit) - 1.0,
        power=torque * rotor.angular_speed / ours.power.main_rotor - 1.0,
        detail=f"C_T/σ {ours.ct_over_sigma:.3f}",
    )

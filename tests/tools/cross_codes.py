"""Our trims beside two independent public codes; `python -m tests.tools.cross_codes` renews their rows of trust.csv.

dynbem in forward flight, WISDEM's CCBlade in axial flow, both with our trimmed controls, blade and section data, so the
remaining differences come from their mathematics. They are installed by the extras `test` and `crosscheck`; the rows of
one that is not installed stay as they are.
"""

import importlib
import importlib.util
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import root

from rotor import Solution, make_design, solve
from rotor.aero.problem import grid_of
from rotor.airfoil.sections import load_section
from rotor.support.arrays import Array
from rotor.support.assets import asset_path
from rotor.validation.page import trust_csv
from rotor.validation.trust import TrustRow, description, trust_rows
from rotor.validation.verification import CCBLADE_MASSES, SPEEDS

PACKAGES = {"dynbem": "dynbem", "ccblade": "wisdem"}
"""Python package of each set of the trust page."""
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
    """Thrust of the other code over this project's, minus one."""
    power: float
    """Torque of the other code over this project's, minus one."""
    detail: str
    """Behind that of thrust in a remark."""


def have(package: str) -> bool:
    """Whether the code is installed."""
    return importlib.util.find_spec(package) is not None


def code_rows(name: str) -> list[TrustRow]:
    """Each condition in another code, as a row of the trust page."""
    what, beside = ("Torque", beside_dynbem) if name == "dynbem" else ("Power", beside_ccblade)
    return [
        description(name).share(f"{what}, {case.condition}", case.power, 5e-4, digits=2,
                                note=f"Thrust {100 * case.thrust:+.2f} %{case.detail}.")
        for case in beside()
    ]  # fmt: skip


def beside_dynbem() -> list[CodeComparison]:
    """Pitt–Peters, forward flight, moment trim; dynbem at our controls with its inflow settled."""
    return [_one_dynbem(mu) for mu in SPEEDS]


def beside_ccblade() -> list[CodeComparison]:
    """Hover: CCBlade at our collective, without and with its swirl."""
    return [_one_ccblade(mass, swirl) for mass in CCBLADE_MASSES for swirl in (False, True)]


def moment_trimmed(mu: float) -> Solution:
    """The thesis' rotor in propulsive trim with three-state gains, no loss factors and, as dynbem's, rigid blades."""
    design = make_design(preset="thesis", twist=f"linear:{RATE_DEG}", mu=mu, airfoils=SECTION)
    models = replace(
        design.models,
        trim="propulsive",
        disk_axial_flow=True,
        inflow="pitt-peters",
        tip_loss=False,
        hub_loss=False,
    )
    # Too heavy to cone.
    blade = replace(design.rotor.blade, flap_inertia=1e8 * design.rotor.blade.flap_inertia)
    return solve(replace(design, models=models, rotor=replace(design.rotor, blade=blade))).require()


def dynbem_case(solution: Solution) -> tuple[Any, Any, Any]:
    """Model, inputs and first inflow states of dynbem for a trim of `moment_trimmed`; ImportError without it."""
    dynbem: Any = importlib.import_module("dynbem")
    design, controls, rotor = solution.design, solution.controls, solution.design.rotor
    alpha = np.radians(np.arange(-180.0, 180.1, 0.25))
    polar = load_section(SECTION)(alpha, MACH)
    stations = np.linspace(rotor.blade.root_cutout, 1.0, 81)
    chord = [rotor.reference_chord] * len(stations)
    blade = dynbem.BladeGeometry(
        rotor.blades, rotor.radius, rotor.blade.root_cutout * rotor.radius, rotor.reference_chord, 0.0,
        design.models.elements, (rotor.radius * stations).tolist(), chord, (RATE_DEG * (stations - 0.75)).tolist(),
        False,
    )  # fmt: skip
    definition = dynbem.RotorDefinition(
        blade,
        # Not used: replaced by the table below.
        dynbem.LinearPolarParameters(0.0, 6.0, 0.01, 12.0),
        control=dynbem.ControlProperties(swashplate_pitch_gain_rad=1.0),
    )
    table = dynbem.TabulatedPolar(
        alpha, np.ascontiguousarray(polar.cl), np.ascontiguousarray(polar.cd)
    )
    model = dynbem.PittPetersModel(definition, table, grid_of(design)[1])
    speed, tilt = design.airspeed, controls.shaft_tilt
    # World axes: x forward, z down; azimuth from the nose, so both cyclics change sign.
    inputs = dynbem.RotorInputs(
        collective_rad=controls.collective, tilt_lon=controls.cyclic_1c, tilt_lat=-controls.cyclic_1s, R_hub=np.eye(3),
        v_hub_world=np.array([speed * math.cos(tilt), 0.0, -speed * math.sin(tilt)]), wind_world=np.zeros(3),
        omega_rad_s=rotor.angular_speed, rho_kg_m3=design.condition.density,
    )  # fmt: skip
    return model, inputs, dynbem.PittPetersRotorState(controls.lambda0, 0.0, 0.0)


def _one_dynbem(mu: float) -> CodeComparison:
    solution = moment_trimmed(mu)
    design, controls = solution.design, solution.controls
    forces, state = _settle(*dynbem_case(solution))
    thrust = -float(forces.F_world[2])
    torque = solution.power.shaft / design.rotor.angular_speed
    lambda0, gradient, _ = (float(value) for value in state.to_array())
    return CodeComparison(
        condition=f"µ {mu:g}",
        thrust=thrust / (solution.ct * design.thrust_unit) - 1.0,
        power=float(forces.Q_spin) / torque - 1.0,
        detail=f". λ0 {lambda0:.5f} against {controls.lambda0:.5f}; its gradient {-gradient / lambda0:.4f} λ0 against "
        f"{_inflow_gradient(solution):.4f} λ0",
    )


def _inflow_gradient(solution: Solution) -> float:
    """k_x = 15π/32 tan(χ/2) at the trim."""
    mu, tilt = solution.design.condition.advance_ratio, solution.controls.shaft_tilt
    skew = math.atan2(mu * math.cos(tilt), mu * math.sin(tilt) + solution.controls.lambda0)
    return 15.0 * math.pi / 32.0 * math.tan(0.5 * skew)


def _settle(model: Any, inputs: Any, state: Any) -> tuple[Any, Any]:
    """Forces and inflow states where the rates of these are zero."""

    def rates(x: Array) -> Array:
        return np.array(
            model.compute_forces(inputs, state.from_array(x))[1].to_array(), dtype=np.float64
        )

    solution = root(rates, np.array(state.to_array(), dtype=np.float64), tol=1e-13)
    assert np.abs(rates(solution.x)).max() < 1e-10, solution.message
    settled = state.from_array(solution.x)
    return model.compute_forces(inputs, settled)[0], settled


class _MirroredSection:
    """Our section table in CCBlade's interface: for a turbine α is φ − θ, and lift changes sign."""

    def __init__(self) -> None:
        self.table = load_section(SECTION)

    def evaluate(self, alpha: float, reynolds: float, return_cm: bool = False) -> tuple[float, ...]:
        """(cl, cd) at α [rad], and cm, which CCBlade does not use."""
        del reynolds
        forces = self.table(-float(np.asarray(alpha).item()), MACH)
        pair = (-float(forces.cl), float(forces.cd))
        return (*pair, 0.0) if return_cm else pair


def _one_ccblade(mass: float, swirl: bool) -> CodeComparison:
    ccblade: Any = importlib.import_module("wisdem.ccblade.ccblade")
    design = make_design(
        preset="thesis", twist=f"linear:{RATE_DEG}", mu=0.0, mass_kg=mass, airfoils=SECTION
    )
    models = replace(design.models, hover_inflow="annulus", hub_loss=False)
    solution = solve(replace(design, models=models)).require()
    rotor = design.rotor
    root = rotor.blade.root_cutout
    n = models.elements
    r = root + (np.arange(n) + 0.5) / n * (1.0 - root)
    code = ccblade.CCBlade(
        rotor.radius * r, np.full(n, rotor.reference_chord), RATE_DEG * (r - 0.75), [_MirroredSection()] * n,
        rotor.radius * root, rotor.radius, B=rotor.blades, rho=design.condition.density, tiploss=True, hubloss=False,
        wakerotation=swirl, usecd=True, shearExp=0.0,
    )  # fmt: skip
    rpm = rotor.angular_speed * 60.0 / (2.0 * math.pi)
    loads, _ = code.distributedAeroLoads(
        AXIAL_SPEED, rpm, math.degrees(solution.controls.collective), 0.0
    )
    # Summed as here, element by element; CCBlade's own sum adds zero loads at both ends of the blade.
    width = rotor.radius * (1.0 - root) / n
    thrust = -rotor.blades * float(np.asarray(loads["Np"]).sum()) * width
    torque = -rotor.blades * float((np.asarray(loads["Tp"]) * rotor.radius * r).sum()) * width
    return CodeComparison(
        condition=f"hover, {mass:g} kg, {'with' if swirl else 'without'} swirl",
        thrust=thrust / (solution.ct * design.thrust_unit) - 1.0,
        power=torque * rotor.angular_speed / solution.power.main_rotor - 1.0,
        detail=f", C_T/σ {solution.ct_over_sigma:.3f}",
    )


def main() -> None:
    rows = [row for name, package in PACKAGES.items() if have(package) for row in code_rows(name)]
    renewed = {(row.set, row.what): row for row in rows}
    text = trust_csv(renewed.get((row.set, row.what), row) for row in trust_rows())
    asset_path("trust.csv").write_text(text, encoding="utf-8", newline="")


if __name__ == "__main__":
    main()

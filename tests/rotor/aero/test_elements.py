"""Blade elements: the kernel against the plain formulas, and exact derivatives against differences."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.aero import kernel
from rotor.aero.elements import Problem, build_problem, evaluate_elements
from rotor.aero.sums import disk_sums, integrate, slopes, weighted_loads
from rotor.aero.torsion_balance import torsion_residual
from rotor.aero.trim_state import TrimState
from rotor.airfoil.sections import load_installed
from rotor.files.make_design import make_design
from rotor.trim.equations import jacobian, residuals, unknowns_of
from rotor.trim.forward import first_guess
from rotor.trim.newton import coordinates_of, full_jacobian, newton

STATE = TrimState(0.17, 0.03, -0.09, 0.08, 0.06, -0.02, 0.01, 0.012)


def problem(preset: str = "flight", mu: float = 0.3, **models: object) -> Problem:
    """A problem with prescribed inflow, so that a pass needs no induced field."""
    design = make_design(preset=preset, mu=mu, twist="segments:-14,-6@0.6")
    prescribed = replace(design.models, inflow="pitt-peters" if preset == "flight" else design.models.inflow)
    return build_problem(replace(design, models=replace(prescribed, **models)))


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_velocities_and_loads_by_the_formulas(preset: str):
    """Eqs. (3.5)–(3.12) written out in plain NumPy at one state, reverse flow included."""
    p = problem(preset)
    elements = evaluate_elements(p, STATE)
    disk, mu = p.disk, 0.3
    r, psi = disk.r[:, None], disk.psi[None, :]
    tilt, beta0, b1c, b1s = STATE.shaft_tilt, STATE.coning, STATE.flap_1c, STATE.flap_1s
    axial = preset == "flight"
    mu_x, mu_z = (mu * math.cos(tilt), mu * math.sin(tilt)) if axial else (mu, 0.0)
    beta = beta0 + b1c * np.cos(psi) + b1s * np.sin(psi)
    beta_rate = -b1c * np.sin(psi) + b1s * np.cos(psi)
    hinge = p.design.rotor.blade.flap_hinge
    turning = STATE.lambda0 * (mu_z + STATE.lambda0) if axial else 0.0
    u_t = r - turning * r / (r * r + turning) + mu_x * np.sin(psi)
    u_p = mu_z + elements.induced + (r - hinge) * beta_rate + mu_x * beta * np.cos(psi)
    assert_allclose(elements.u_t, u_t, rtol=1e-14, atol=1e-15)
    assert_allclose(elements.u_p, u_p, rtol=1e-12, atol=1e-15)
    assert (u_t < 0.0).any()

    theta = (
        STATE.collective
        + STATE.cyclic_1c * np.cos(psi)
        + STATE.cyclic_1s * np.sin(psi)
        + p.design.twist(disk.r)[:, None]
    )
    phi = np.arctan2(u_p, u_t)
    alpha = theta - phi
    speed = np.hypot(u_t, u_p)
    blade = p.design.rotor.blade
    along = mu_x * np.cos(psi[0])
    reynolds = 0.75 * 27.0 * 8.1788 * 0.5273 * 1.225 / 1.789e-5  # Viscosity at 15 °C: ISO 2533.
    friction = 0.91 / math.log10(reynolds) ** 2.58 if axial else 0.0
    for i in (0, 12, 22, 33, 39):
        inner, outer, weight = blade.section_at(float(disk.r[i]))
        parts = []
        for name in (inner, outer):
            section = load_installed(name)
            sweep = math.radians(20.0) if axial and disk.r[i] > 0.965 else 0.0  # Half a chord beyond the kink.
            normal = np.hypot(u_t[i] * math.cos(sweep) - along * math.sin(sweep), u_p[i])
            at = section.table(alpha[i] - section.incidence_offset, normal * p.tip_mach)
            parts.append((at.cl, at.cd))
        cl = (1.0 - weight) * parts[0][0] + weight * parts[1][0]
        cd = (1.0 - weight) * parts[0][1] + weight * parts[1][1]
        lift, drag = (disk.half_solidity[i] * speed[i] ** 2 * c for c in (elements.loss[i] * cl, cd))
        loads = elements.loads[:, i]
        assert_allclose(loads[kernel.CL], cl, rtol=1e-9, atol=1e-10)
        assert_allclose(loads[kernel.CD], cd, rtol=1e-9, atol=1e-10)
        assert_allclose(loads[kernel.FZ], lift * np.cos(phi[i]) - drag * np.sin(phi[i]), rtol=1e-9, atol=1e-12)
        across = disk.r[i] + mu_x * np.sin(psi[0])
        rubbing = friction * disk.half_solidity[i] * (np.hypot(across, along) - np.abs(across)) * across
        expected = lift * np.sin(phi[i]) + drag * np.cos(phi[i]) + rubbing
        assert_allclose(loads[kernel.FX], expected, rtol=1e-9, atol=1e-4 * np.abs(rubbing).max() + 1e-12)


def test_chord_ratio_and_droop_of_the_r8():
    """SC1094 R8 between 0.497 and 0.823 R: chord 1.009875 wider, chord line 1° nose-down."""
    disk = problem().disk
    solidity = 2.0 * disk.half_solidity
    assert_allclose(solidity[0], 4 * 0.5273 / (math.pi * 8.1788), rtol=1e-12)
    middle = int(np.argmin(np.abs(disk.r - 0.65)))
    assert_allclose(solidity[middle] / solidity[0], 1.009875, rtol=1e-12)
    assert_allclose(np.degrees(disk.offset[middle]), 1.0, rtol=1e-12)
    blended = (disk.weight > 0.0) & (disk.weight < 1.0)
    assert blended.any()


@pytest.mark.parametrize("row", [0, 1, 2, 3])
def test_pointwise_derivatives(row: int):
    """∂F_z, ∂F_x by θ, U_T, U_P, U_R against central differences, everywhere on the disk."""
    p = problem()
    elements = evaluate_elements(p, STATE)
    disk = p.disk
    fields = [elements.theta, elements.u_t, elements.u_p, elements.flow.mu_x * disk.cos]
    h = 1e-6

    def loads(shift: float):
        moved = [f + shift * (k == row) for k, f in enumerate(fields)]
        return kernel.element_loads(
            *moved, elements.loss, p.tip_mach, disk.half_solidity, disk.section, disk.weight, disk.offset, disk.tables,
            disk.cos_sweep, disk.sin_sweep,
        )  # fmt: skip

    ahead, behind = loads(h), loads(-h)
    rows = [
        (kernel.FZ_THETA, kernel.FX_THETA),
        (kernel.FZ_UT, kernel.FX_UT),
        (kernel.FZ_UP, kernel.FX_UP),
        (kernel.FZ_UR, kernel.FX_UR),
    ][row]
    for value, slope in ((kernel.FZ, rows[0]), (kernel.FX, rows[1])):
        difference = (ahead[value] - behind[value]) / (2.0 * h)
        scale = np.abs(difference).max()
        # C¹ data: a difference across a knot errs by (jump of curvature) × h, 1e-6 of the scale here.
        assert_allclose(elements.loads[slope], difference, rtol=1e-5, atol=3e-6 * scale)


@pytest.mark.parametrize(
    ("preset", "models"),
    [
        ("flight", {}),
        ("flight", {"inflow": "drees", "tip_loss": False}),
        ("flight", {"inflow": "white-blake", "trim": "thrust"}),
        ("thesis", {}),
        ("thesis", {"trim": "propulsive"}),
        ("thesis", {"inflow": "coleman", "hub_loss": False}),
    ],
)
@pytest.mark.parametrize("mu", [0.03, 0.15, 0.4])
def test_trim_jacobian(preset: str, models: dict[str, object], mu: float):
    """The exact Jacobian of the trim residual against central differences."""
    p = problem(preset, mu, **models)
    unknowns = unknowns_of(p.design)
    state = STATE
    if preset == "thesis" or models.get("trim") == "thrust":
        state = replace(STATE, shaft_tilt=math.atan2(p.drag, p.weight))
    elements = evaluate_elements(p, state)
    exact = jacobian(p, elements, slopes(p, elements, unknowns, None))
    h = 1e-6
    for k, unknown in enumerate(unknowns):
        step = np.array([h * (0.1 if unknown == "lambda0" else 1.0)])
        ahead, behind = (residuals(p, evaluate_elements(p, state.moved([unknown], s * step))) for s in (1.0, -1.0))
        difference = (ahead - behind) / (2.0 * step[0])
        assert_allclose(exact[:, k], difference, rtol=2e-5, atol=2e-7)


def test_newton_converges_quadratically():
    """Near the root each residual is of the order of the last one squared: the mark of an exact Jacobian."""
    p = problem(mu=0.2)
    unknowns = unknowns_of(p.design)
    trimmed, count = newton(p, first_guess(p)).elements, len(unknowns)
    state, twist = trimmed.state.moved(unknowns, np.full(count, 2e-3)), coordinates_of(trimmed)
    sizes = []
    for _ in range(4):
        elements = evaluate_elements(p, state, None, twist)
        balance = torsion_residual(p, elements)
        error = np.concatenate([residuals(p, elements), balance.ravel()])
        sizes.append(np.abs(error[:count]).max() / p.weight)
        matrix = full_jacobian(p, elements, slopes(p, elements, unknowns, None))[0]
        step = np.asarray(np.linalg.solve(matrix, -error), dtype=float)
        state, twist = state.moved(unknowns, step[:count]), twist + step[count:].reshape(twist.shape)
    assert sizes[1] < sizes[0] ** 2
    assert sizes[2] < sizes[1] ** 2
    assert sizes[3] < 1e-13


def test_the_sums_are_those_over_the_elements():
    """The compiled sums against the contributions of all elements."""
    p = problem(mu=0.2)
    elements = evaluate_elements(p, STATE)
    fz, fx = elements.loads[kernel.FZ], elements.loads[kernel.FX]
    sums = integrate(p, elements, np.stack([fx, fz]), np.stack([fz, fx]))[:, 1]
    assert_allclose(weighted_loads(p, elements, fz, fx).sum(axis=(1, 2)), sums, rtol=1e-12)


def test_loss_average_over_azimuth_is_settled():
    """24 azimuths for the average of F against 360 azimuths of the same field."""
    from rotor.aero.losses import loss_factor

    p = problem(mu=0.35)
    state = newton(p, first_guess(p)).elements.state
    elements = evaluate_elements(p, state)
    psi = 2.0 * np.pi * np.arange(360) / 360
    around = replace(p.disk, psi=psi, cos=np.cos(psi), sin=np.sin(psi))
    field = p.inflow.respond(around, elements.flow, np.zeros((0, 0))).induced
    rotor = p.design.rotor
    factor, _ = loss_factor(p.disk.r[:, None], elements.flow.mu_z + field, rotor.blades, rotor.blade.root_cutout)
    assert_allclose(elements.loss, factor.mean(axis=1), atol=1e-4)


def test_sums_by_quadrature_of_a_known_field():
    """A hovering untwisted rotor of constant C_l would give C_T = ½σ Cl/3 (1 − r0³): the sums integrate to that."""
    p = problem(mu=0.0)
    elements = evaluate_elements(p, TrimState(collective=0.1, lambda0=1e-6))
    loads = elements.loads.copy()
    loads[kernel.FZ] = 0.5 * 0.08 * 0.6 * elements.u_t**2
    loads[kernel.FX] = 0.0
    total = disk_sums(p, replace(elements, loads=loads))
    start = p.design.rotor.blade.root_cutout
    assert_allclose(total.thrust, 0.5 * 0.08 * 0.6 * (1.0 - start**3) / 3.0, rtol=2e-4)  # midpoint rule, 40 elements
    assert_allclose(total.moment[1:], 0.0, atol=1e-15)

"""Blade elements: the section against the plain formulas, and exact derivatives against differences."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotor import TrimState, make_design
from rotor.aero.problem import Problem, build_problem
from rotor.aero.section import FZ, LOSS, TH, UP, UR, UT, arctangent, section
from rotor.airfoil.sections import load_installed
from rotor.airfoil.stall_delay import fully_delayed
from rotor.columns.flight import disk_sums as sums_at
from rotor.support.arrays import Array
from rotor.support.compiled import compiled
from tests.rotor.at_state import disk_sums, elements_at, point_at

STATE = TrimState(0.17, 0.03, -0.09, 0.08, 0.06, -0.02, 0.01, 0.012)


def problem(preset: str = "flight", mu: float = 0.3, **models: object) -> Problem:
    """A problem with prescribed inflow, so that a pass needs no induced field."""
    design = make_design(preset=preset, mu=mu, twist="segments:-14,-6@0.6")
    prescribed = replace(
        design.models, inflow="pitt-peters" if preset == "flight" else design.models.inflow
    )
    return build_problem(replace(design, models=replace(prescribed, **models)))


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_velocities_and_loads_by_the_formulas(preset: str):
    """Eqs. (3.5)–(3.12), of steady flow, written out in plain NumPy at one state, reverse flow included."""
    p = problem(preset, unsteady=False, dynamic_stall=False)
    point, elements = point_at(p, STATE), elements_at(p, STATE)
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
    radial = along if axial else 0.0
    whole = np.hypot(speed, radial)
    chordwise = speed * np.cos(alpha)
    front = np.arctan2(speed * np.sin(alpha), np.hypot(chordwise, radial))
    share = np.clip(chordwise / (0.25 * np.hypot(chordwise, radial)), -1.0, 1.0)
    share = 0.5 + 0.25 * share * (3.0 - share**2)  # Of C_d with the leading edge first.
    assert ((share > 0.01) & (share < 0.99)).any() == axial
    for i in (0, 12, 22, 33, 39):
        inner, outer, weight = blade.section_at(float(disk.r[i]))
        parts = []
        for name in (inner, outer):
            section = load_installed(name)
            # Half a chord beyond the kink.
            sweep = math.radians(20.0) if axial and disk.r[i] > 0.965 else 0.0
            normal = np.hypot(u_t[i] * math.cos(sweep) - along * math.sin(sweep), u_p[i])
            own, first, last = (
                getattr(
                    section.table(angle[i] - section.incidence_offset, normal * p.tip_mach), name
                )
                for angle, name in ((alpha, "cl"), (front, "cd"), (math.pi - front, "cd"))
            )
            cl = own
            if axial:
                ratio = 2.0 * math.pi * disk.half_solidity[i] / (disk.blades * disk.r[i])
                attached = fully_delayed(section.table)(
                    alpha[i] - section.incidence_offset, normal * p.tip_mach
                )
                cl = own + 3.0 * ratio**2 * (attached.cl - own)
            parts.append((cl, share[i] * first + (1.0 - share[i]) * last))
        cl = (1.0 - weight) * parts[0][0] + weight * parts[1][0]
        cd = (1.0 - weight) * parts[0][1] + weight * parts[1][1]
        lift = disk.half_solidity[i] * speed[i] ** 2 * point.channels[LOSS, i] * cl
        drag = disk.half_solidity[i] * whole[i] * cd
        assert_allclose(elements.cl[i], cl, rtol=1e-9, atol=1e-10)
        assert_allclose(elements.cd[i], cd, rtol=1e-9, atol=1e-10)
        assert_allclose(
            elements.fz[i], lift * np.cos(phi[i]) - drag * u_p[i], rtol=1e-9, atol=1e-12
        )
        assert_allclose(
            elements.fx[i], lift * np.sin(phi[i]) + drag * u_t[i], rtol=1e-9, atol=1e-12
        )
        assert_allclose(elements.fr[i], drag * radial, rtol=1e-9, atol=1e-12)


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


def test_the_residuals_are_sums_over_the_elements():
    """Carried weight, pulled drag and flap moments from the forces of all elements."""
    p = problem(mu=0.2)
    point, e = point_at(p, STATE), elements_at(p, STATE)
    total, own = disk_sums(p.disk, e), sums_at(point)
    assert_allclose(
        (own.thrust, own.drag, own.torque), (total.thrust, total.drag, total.torque), rtol=1e-12
    )
    cos, sin = math.cos(STATE.shaft_tilt), math.sin(STATE.shaft_tilt)
    moment = p.arm * p.disk.dr @ e.fz / len(p.disk.psi)
    flap = p.flap
    stiffness = (flap.frequency_squared - 1.0) / flap.load_gain
    expected = {
        "vertical": total.thrust * cos + total.drag * sin - p.weight,
        "forward": total.thrust * sin - total.drag * cos - p.drag,
        "coning": moment.sum()
        - (flap.frequency_squared * STATE.coning + flap.weight) / flap.load_gain,
        "flap_1c": 2.0 * moment @ p.disk.cos - stiffness * STATE.flap_1c,
        "flap_1s": 2.0 * moment @ p.disk.sin - stiffness * STATE.flap_1s,
        "momentum": 2.0 * STATE.lambda0 * e.flow.speed - total.thrust,
    }
    rows = point.system.structure.equations
    for name, value in expected.items():
        assert_allclose(
            point.residual[rows[name]], value, rtol=1e-12, atol=1e-12 * p.weight, err_msg=name
        )


# The compiled loops at their borders


@compiled()
def angles(p: Array, t: Array) -> Array:
    out = np.empty_like(p)
    for k in range(len(p)):
        out[k] = arctangent(p[k], t[k])
    return out


def test_arctangent_to_rounding():
    """Against the arctangent of the C library: all quadrants, sixteen orders of magnitude, and both axes."""
    random = np.random.default_rng(1)
    p = random.normal(size=400_000) * 10.0 ** random.uniform(-8.0, 8.0, 400_000)
    t = random.normal(size=400_000)
    found, exact = angles(p, t), np.arctan2(p, t)
    assert np.abs((found - exact) / np.spacing(np.abs(exact))).max() <= 3.0
    axes = np.array([0.0, 1.0, -1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0, -1.0, 0.0])
    assert_array_equal(angles(*axes), [0.0, 0.5 * math.pi, -0.5 * math.pi, math.pi, 0.0])


def test_what_is_not_a_number_stays_so():
    """A pitch that is not a number reads no memory outside the tables, and no other element is touched."""
    design = make_design(mu=0.2, inflow="pitt-peters")
    problem = build_problem(replace(design, models=replace(design.models, elements=6, azimuths=8)))
    disk, data = problem.disk, problem.section_data()
    channels = np.zeros((6, *disk.shape))
    channels[TH], channels[UP], channels[UR], channels[LOSS] = 0.1, 0.02, 0.2 * disk.cos, 1.0
    channels[UT] = disk.r[:, None] + 0.2 * disk.sin
    whole = section(channels, data, True, True)
    channels[TH, 2, 3] = channels[UT, 4, 5] = np.nan
    broken = section(channels, data, True, True)
    bad = np.isnan(broken[0][FZ])
    assert np.argwhere(bad).tolist() == [[2, 3], [4, 5]]
    for found, before in zip(broken, whole, strict=True):
        assert_array_equal(found[:, ~bad], before[:, ~bad])

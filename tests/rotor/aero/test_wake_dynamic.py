"""The dynamic wake on the disk: its terms against brute force, its limits, and time marching."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inflow_tables import table
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotor.aero.disk import build_disk
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.dynamic_wake import DynamicWake, DynamicWakeTheory
from rotor.aero.inflow.interface import Wake
from rotor.aero.inflow.peters_he import eliminate, families, flow_parameters, highest_modes, radial_functions
from rotor.aero.losses import tip_factor
from rotor.aero.momentum import glauert_inflow
from rotor.arrays import Array
from rotor.files.make_design import make_design

ROOT, ELEMENTS, AZIMUTHS = 0.13, 12, 42
PSI = 2.0 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS
R = DynamicWake().on(ROOT, ELEMENTS).projection.r
FORWARD = Wake(0.199, 0.012, 0.0163)
MODELS = [DynamicWake(), DynamicWake(harmonics=0), DynamicWake(order=4, harmonics=1), DynamicWake.of(5)]


def means_of(theory: DynamicWakeTheory, d: Array) -> Array:
    return np.tensordot(theory.projection.at(PSI), d, 2) * theory.projection.dr / AZIMUTHS


def noise(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(ELEMENTS, AZIMUTHS))


@pytest.fixture(params=MODELS, ids=str)
def model(request: pytest.FixtureRequest) -> DynamicWake:
    return request.param


def test_size_of_the_default():
    # g_k with k ≥ the least m for which one of m, |m ± 4|, |m ± 8| is p; p = 0, then 1 … 16 as cosine and sine.
    terms = 5 + 2 * (4 + 4 + 4 + 5 + 4 + 4 + 4 + 5 + 4 + 4 + 3 + 3 + 2 + 2 + 1 + 1)
    assert len(DynamicWake().on(ROOT, ELEMENTS).names) == terms


def test_terms_written_out(model: DynamicWake):
    """g_k(r) cos pψ or sin pψ, one by one."""
    projection = model.on(ROOT, ELEMENTS).projection
    g = radial_functions(highest_modes(model.order), R)
    names = zip(projection.order, projection.wave, projection.parity, strict=True)
    terms = [np.outer(g[k], (np.cos, np.sin)[sine](p * PSI)) for k, p, sine in names]
    assert_allclose(projection.at(PSI), terms, rtol=0, atol=1e-13)


@pytest.mark.parametrize("wake", [FORWARD, Wake(0.35, 0.04, 0.011), Wake(0.3, -0.05, 0.01), Wake(0.0, 0.0, 0.057)])
def test_inflow_is_that_of_the_states(model: DynamicWake, wake: Wake):
    """The theory written out: modes times blade harmonics on the grid, complex equations of the modes."""
    theory = model.on(ROOT, ELEMENTS)
    flow, cell = flow_parameters(wake), (1.0 - ROOT) / ELEMENTS / AZIMUTHS
    d, inflow = noise(1), np.zeros((ELEMENTS, AZIMUTHS))
    for family, trig in zip(families(model.order), (np.cos, np.sin), strict=True):
        influence, _ = family.influence(flow.half_skew)
        flows = np.diag(np.where(family.uniform > 0.0, flow.speed, flow.mass_flow))
        modes = zip(family.m, radial_functions(family.modes, R), strict=True)
        shapes = np.array([np.outer(phi, trig(m * PSI)) for m, phi in modes])
        for k in range(model.harmonics + 1):
            q = k * model.blades
            turn = np.exp(-1j * q * PSI)
            loads = np.where(family.m == 0, 0.5, 1.0) * cell * np.tensordot(shapes, d * turn, 2)
            amplitudes = 0.5 * influence @ np.linalg.solve(flows + 1j * q * family.mass[:, None] * influence, loads)
            inflow += (2.0 if q else 1.0) * (np.tensordot(amplitudes, shapes, 1) / turn).real
    means, tolerance = means_of(theory, d), 1e-13 * np.abs(inflow).max()
    found = theory.answer(means, wake)
    assert_allclose(np.tensordot(found, theory.projection.at(PSI), 1), inflow, rtol=0, atol=tolerance)
    # Many loads are answered by the matrix made of the same equations.
    assert_allclose(theory.linear(means, wake)[0] @ means, found, rtol=0, atol=5e-14 * np.abs(found).max())


def test_elimination_of_two_unknowns_at_a_time():
    """Even and odd numbers of equations, of which some need their rows exchanged."""
    for n in (1, 2, 3, 24, 25):
        random = np.random.default_rng(n)
        matrix, right = random.normal(size=(n, n)), random.normal(size=(n, 3))
        matrix[0, 0] = matrix[n // 2, n // 2] = 0.0 if n > 1 else 1.0
        system = np.hstack([matrix, right])
        eliminate(system)
        assert_allclose(matrix @ system[:, n:], right, rtol=0, atol=1e-12 * max(1.0, np.abs(system[:, n:]).max()))


def test_coordinates_of_a_sum_of_terms(model: DynamicWake):
    """A sum of terms is found again on any grid; of another field the nearest one."""
    projection = model.on(0.1, ELEMENTS).projection
    own = np.random.default_rng(26).normal(size=projection.terms)
    error = 1e-3 if model.blades % 2 else 1e-9  # Of an odd number of blades some terms depend on others.
    for azimuths in (AZIMUTHS, 48):
        terms = projection.at(2.0 * np.pi * np.arange(azimuths) / azimuths)
        field = np.tensordot(own, terms, 1)
        found = projection.nearest(field)
        assert_allclose(np.tensordot(found, terms, 1), field, rtol=0, atol=error)
        assert_allclose(np.tensordot(found - own, projection.at(np.linspace(0.0, 6.0, 90)), 1), 0.0, atol=error)
        other = field + np.random.default_rng(27).normal(size=field.shape)
        rest = other - np.tensordot(projection.nearest(other), terms, 1)
        assert_allclose(np.tensordot(terms, rest, 2), 0.0, atol=1e-2 if model.blades % 2 else 1e-9)


@pytest.mark.parametrize("wake", [FORWARD, Wake(0.35, 0.04, 0.011), Wake(0.02, 0.0, 0.055), Wake(0.0, 0.0, 0.057)])
def test_slopes_by_wake(model: DynamicWake, wake: Wake):
    theory, d = model.on(ROOT, ELEMENTS), noise(11)
    means, terms, (over, slope) = means_of(theory, d), theory.projection.at(PSI), theory.over_factor(wake)
    plain = np.tensordot(theory.answer(means, wake), terms, 1)
    exact = np.tensordot(theory.linear(means, wake)[1].T, terms, 1) * over[:, None]
    exact += np.multiply.outer([0.0, 1.0, 1.0], plain * slope[:, None])
    given_wake = np.array([wake.mu_x, wake.mu_z, wake.lambda0])
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-6
        ahead, behind = (theory.induced(d, Wake(*(given_wake + s * step))) for s in (1, -1))
        # Central differences: 1e-12 × third derivative (λ/V³ ~ 1e4) and rounding 1e-14/1e-6.
        assert_allclose(exact[k], (ahead - behind) / 2e-6, rtol=0, atol=1e-6 * np.abs(exact).max())


@given(mu=st.floats(0.0, 0.45), axial=st.floats(0.005, 0.1), lambda0=st.floats(0.002, 0.08))
def test_slopes_exist_everywhere(mu: float, axial: float, lambda0: float):
    """Near-edgewise flow included, where [L] itself cannot be inverted."""
    theory, wake = DynamicWake().on(ROOT, ELEMENTS), Wake(mu, axial - lambda0, lambda0)
    if flow_parameters(wake).mass_flow <= 0.0:
        return  # Fast descent: the theory has no answer there.
    means = means_of(theory, noise(12))
    for found in (theory.answer(means, wake), *theory.linear(means, wake)):
        assert np.isfinite(found).all()


def test_steady_response_to_a_load_that_vanishes_at_the_hub():
    """Induced power of the actuator disk's type III load over Glauert's at µ 0.2, without tip factor: 1.169."""
    elements, azimuths = 200, 36
    theory = DynamicWake(harmonics=0, tip=False).on(ROOT, elements)
    r, dr = theory.projection.r, (1.0 - ROOT) / elements
    load = r**3 * np.sqrt(1.0 - r**2)
    ct = 0.006511
    d = np.repeat((ct * load / (load.sum() * dr))[:, None], azimuths, axis=1)
    lambda0, _ = glauert_inflow(ct, 0.2, 0.0)
    inflow = theory.induced(d, Wake(0.2, 0.0, lambda0))
    kappa = (inflow * d).mean(axis=1).sum() * dr / (ct * lambda0)
    assert 1.169 <= kappa <= 1.173  # The span of the reference's own values.


def test_sideways_symmetry():
    """A load mirrored about the fore-aft line makes the mirrored inflow of the mirrored rotor.

    With rotation reversed sin qψ changes sign as well, so the apparent mass must be reversed: only its steady part is
    mirror-symmetric for one sense of rotation.
    """
    theory = DynamicWake(harmonics=0).on(ROOT, ELEMENTS)
    d = noise(13)
    mirror = -np.arange(AZIMUTHS) % AZIMUTHS
    there, here = theory.induced(d[:, mirror], FORWARD), theory.induced(d, FORWARD)[:, mirror]
    assert_allclose(there, here, rtol=0, atol=1e-11)


def test_blade_harmonics_against_time_marching():
    """Four blades with equal steady loads: march the wake's own equations until they repeat, and look from the blade.

    An axisymmetric load has only the wave numbers 4 and 8 for the modes kept, so nothing is lost to truncation.
    """
    wake = Wake(0.15, 0.01, 0.03)
    elements, azimuths = 20, 24
    theory = DynamicWake(order=4, harmonics=1).on(ROOT, elements)
    r, dr = theory.projection.r, (1.0 - ROOT) / elements
    load = 0.01 * np.square(r)
    balanced = theory.induced(np.repeat(load[:, None], azimuths, axis=1), wake)

    flow = flow_parameters(wake)
    marched = np.zeros((elements, azimuths))
    blades = 0.5 * math.pi * np.arange(4)
    times = 2.0 * math.pi * (np.arange(azimuths) / azimuths + 12)
    for family, trig in zip(families(4), (np.cos, np.sin), strict=True):
        influence, _ = family.influence(flow.half_skew)
        diagonal = np.where(family.uniform > 0.0, flow.speed, flow.mass_flow)
        stiffness = diagonal[:, None] * np.linalg.inv(influence)
        radial = radial_functions(family.modes, r)
        m = np.array([mode[0] for mode in family.modes])
        strength = np.where(m == 0, 0.5, 1.0) * (radial @ load) * dr

        def rate(psi: float, alpha: np.ndarray) -> np.ndarray:
            tau = strength * trig(m[:, None] * (psi + blades)).mean(axis=1)  # noqa: B023
            return (0.5 * tau - stiffness @ alpha) / family.mass  # noqa: B023

        end = solve_ivp(rate, (0.0, times[-1]), np.zeros(len(m)), method="LSODA", t_eval=times, rtol=1e-9, atol=1e-13)
        marched += np.einsum("jr,jt,jt->rt", radial, end.y, trig(np.outer(m, times)))
    assert_allclose(balanced, marched, rtol=0, atol=1e-7 * np.abs(balanced).max())  # Tolerance of the integrator.


@pytest.mark.parametrize(("order", "harmonics"), [(4, 1), (8, 2)])
def test_axial_optimum_matches_an_independent_program(order: int, harmonics: int):
    """Least induced power in axial flow over loads r √(1 − r²) × polynomial: blade harmonics to four digits."""
    elements, azimuths = 400, 36
    theory = DynamicWake(order=order, harmonics=harmonics).on(ROOT, elements)
    r, dr = theory.projection.r, (1.0 - ROOT) / elements
    across = (2.0 * r - 1.0 - ROOT) / (1.0 - ROOT)
    loads = (r * np.sqrt(1.0 - np.square(r)))[:, None] * np.polynomial.chebyshev.chebvander(across, 5)
    spread = np.repeat(loads.T[:, :, None], azimuths, axis=2)
    for row in table("axial_kappa"):
        axial = float(row["lam"])
        inflow = np.stack([theory.induced(load, Wake(0.0, axial, 0.0))[:, 0] for load in spread], axis=1)
        form, thrust = loads.T @ inflow * dr, loads.sum(axis=0) * dr
        # Some combinations of loads drive no state at all; the least-squares solution leaves them out.
        best = np.linalg.lstsq(0.5 * (form + form.T), thrust, rcond=1e-10)[0]
        # The table has four decimals.
        assert_allclose(2.0 * axial / (thrust @ best), float(row[f"GDW_S{order}k{harmonics}"]), atol=2e-4)


def test_infinite_blades_use_the_tip_factor():
    d, (factor, _) = noise(14), tip_factor(R, FORWARD.axial, 4)
    lossy, plain = (
        DynamicWake.of(4, infinite_blades=True, tip=tip).on(ROOT, ELEMENTS).induced(d, FORWARD) for tip in (True, False)
    )
    assert_allclose(lossy, plain / factor[:, None], rtol=1e-14)
    assert np.all(DynamicWake().on(ROOT, ELEMENTS).over_factor(FORWARD)[0] == 1.0)  # Blade harmonics hold the tip.


def test_tip_factor():
    factor, _ = tip_factor([0.2, 0.95, 1.0], 0.03, 4)
    by_hand = 2.0 / math.pi * math.acos(math.exp(-4.0 * 0.05 / (2.0 * 0.03)))
    assert_allclose(factor, [1.0, by_hand, 0.1], rtol=1e-9)  # 1 − F at 0.2 R is 1e-23.
    r = np.linspace(0.5, 0.999, 9)
    _, slope = tip_factor(r, 0.03, 4)
    above, below = (tip_factor(r, 0.03 + h, 4)[0] for h in (1e-6, -1e-6))
    assert_allclose(slope, (above - below) / 2e-6, rtol=1e-6, atol=1e-8)


def test_each_blade_harmonic_adds_the_part_of_the_load_along_the_wind():
    """Axial flow, where the inflow at the blade grows by (µ_z + λ0) d/2r³ with each harmonic, for any blade number.

    A smooth load away from its ends; the theory's own tip effect leaves a few tenths of that.
    """
    wake = Wake(0.0, 0.06, 0.03)
    r = np.linspace(0.05 + 0.95 / 120, 1.0 - 0.95 / 120, 60)
    load = np.repeat((0.02 * r**2 * np.sqrt(1.0 - r**2))[:, None], 120, axis=1)
    inside = (r > 0.4) & (r < 0.75)
    expected = wake.axial * load[:, 0] / (2.0 * r**3)
    for blades in (3, 4):
        fields = []
        for harmonics in (2, 3, 4):
            model = DynamicWake(blades, blades * harmonics, harmonics)
            fields.append(model.on(0.05, 60).induced(load, wake)[:, 0])
        growth = (fields[2] - fields[0]) / 2.0
        assert 0.5 < growth[inside].mean() / expected[inside].mean() < 1.5


def test_truncation_rule():
    assert DynamicWake.of(4) == DynamicWake(4, 8, 2)
    assert DynamicWake.of(5) == DynamicWake(5, 10, 2)
    assert DynamicWake.of(4, 4) == DynamicWake(4, 4, 1)
    assert DynamicWake.of(2) == DynamicWake(2, 8, 4)
    assert DynamicWake.of(3) == DynamicWake(3, 6, 2)
    assert DynamicWake.of(3, 4) == DynamicWake(3, 3, 1)
    assert DynamicWake.of(7) == DynamicWake(7, 7, 1)
    with pytest.raises(ValueError, match="do not match"):
        DynamicWake(4, 8, 1)
    with pytest.raises(ValueError, match="use more than 32"):
        INFLOW_MODELS["dynamic-wake"].on(build_disk(make_design().rotor, ELEMENTS, 32), FORWARD, (True, True))

"""The dynamic wake on the disk: fast operators against brute force, its limits, and time marching."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inflow_tables import table
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotor.aero.disk import build_disk
from rotor.aero.inflow.dynamic_wake import DynamicWake, DynamicWakeResponse, WakeOperator
from rotor.aero.inflow.interface import ColumnFeedback, FieldColumns, HarmonicShapes, Wake
from rotor.aero.inflow.peters_he import eliminate, families, flow_parameters, highest_modes, radial_functions
from rotor.aero.losses import tip_factor
from rotor.aero.momentum import glauert_inflow
from rotor.files.make_design import make_design

ROOT, ELEMENTS, AZIMUTHS = 0.13, 12, 42
R = DynamicWake().on(ROOT, ELEMENTS, AZIMUTHS).r
FORWARD = Wake(0.199, 0.012, 0.0163)
MODELS = [DynamicWake(), DynamicWake(harmonics=0), DynamicWake(order=4, harmonics=1), DynamicWake.of(5)]


def respond(model: DynamicWake, wake: Wake = FORWARD) -> WakeOperator:
    return model.operator(model.on(ROOT, ELEMENTS, AZIMUTHS), wake)


def noise(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(ELEMENTS, AZIMUTHS))


@pytest.fixture(params=MODELS, ids=str)
def model(request: pytest.FixtureRequest) -> DynamicWake:
    return request.param


def test_size_of_the_default():
    # g_k with k ≥ the least m for which one of m, |m ± 4|, |m ± 8| is p; p = 0, then 1 … 16 as cosine and sine.
    terms = 5 + 2 * (4 + 4 + 4 + 5 + 4 + 4 + 4 + 5 + 4 + 4 + 3 + 3 + 2 + 2 + 1 + 1)
    assert respond(DynamicWake()).projection.terms == terms


@pytest.mark.parametrize("azimuths", [AZIMUTHS, AZIMUTHS + 1])
def test_projection_against_brute_force(model: DynamicWake, azimuths: int):
    """Every term written out, g_k(r) cos pψ or sin pψ, and summed over the grid one by one.

    An odd number of azimuths has none half a turn apart.
    """
    projection = model.on(ROOT, ELEMENTS, azimuths)
    psi = 2.0 * np.pi * np.arange(azimuths) / azimuths
    g = radial_functions(highest_modes(model.order), R)
    names = zip(projection.order, projection.wave, projection.parity, strict=True)
    terms = np.array([np.outer(g[k], (np.cos, np.sin)[sine](p * psi)) for k, p, sine in names])
    fields = np.random.default_rng(1).normal(size=(2, ELEMENTS, azimuths))
    expected = np.tensordot(fields, terms, axes=((1, 2), (1, 2)))
    assert_allclose(projection.sums(fields), expected, rtol=0, atol=1e-14 * np.abs(expected).max() * ELEMENTS)
    assert_allclose(projection.sums(fields[1]), expected[1], rtol=0, atol=1e-14 * np.abs(expected).max() * ELEMENTS)
    x = np.random.default_rng(2).normal(size=(2, projection.terms))
    assert_allclose(projection.field(x), np.tensordot(x, terms, axes=1), rtol=0, atol=1e-11)
    slope = fields[0]
    expected = np.tensordot(terms * slope, terms, axes=((1, 2), (1, 2)))
    assert_allclose(projection.reduced(slope), expected, rtol=0, atol=2e-14 * np.abs(expected).max())


@pytest.mark.parametrize("wake", [FORWARD, Wake(0.35, 0.04, 0.011), Wake(0.3, -0.05, 0.01), Wake(0.0, 0.0, 0.057)])
def test_inflow_is_that_of_the_states(model: DynamicWake, wake: Wake):
    """The theory written out: modes times blade harmonics on the grid, complex equations of the modes."""
    response = respond(model, wake)
    flow, cell = response.flow, (1.0 - ROOT) / ELEMENTS / AZIMUTHS
    psi = 2.0 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS
    d, inflow = noise(1), np.zeros((ELEMENTS, AZIMUTHS))
    for family, trig in zip(families(model.order), (np.cos, np.sin), strict=True):
        influence, _ = family.influence(flow.half_skew)
        flows = np.diag(np.where(family.uniform > 0.0, flow.speed, flow.mass_flow))
        modes = zip(family.m, radial_functions(family.modes, R), strict=True)
        shapes = np.array([np.outer(phi, trig(m * psi)) for m, phi in modes])
        for k in range(model.harmonics + 1):
            q = k * model.blades
            turn = np.exp(-1j * q * psi)
            loads = np.where(family.m == 0, 0.5, 1.0) * cell * np.tensordot(shapes, d * turn, 2)
            amplitudes = 0.5 * influence @ np.linalg.solve(flows + 1j * q * family.mass[:, None] * influence, loads)
            inflow += (2.0 if q else 1.0) * (np.tensordot(amplitudes, shapes, 1) / turn).real
    tolerance = 1e-13 * np.abs(inflow).max()
    assert_allclose(response.projection.field(response.coefficients(d)), inflow, rtol=0, atol=tolerance)
    assert_allclose(response.projection.field(response.coefficients(d[None]))[0], inflow, rtol=0, atol=tolerance)


def test_elimination_of_two_unknowns_at_a_time():
    """Even and odd numbers of equations, of which some need their rows exchanged."""
    for n in (1, 2, 3, 24, 25):
        random = np.random.default_rng(n)
        matrix, right = random.normal(size=(n, n)), random.normal(size=(n, 3))
        matrix[0, 0] = matrix[n // 2, n // 2] = 0.0 if n > 1 else 1.0
        system = np.hstack([matrix, right])
        eliminate(system)
        assert_allclose(matrix @ system[:, n:], right, rtol=0, atol=1e-12 * max(1.0, np.abs(system[:, n:]).max()))


def test_transposes(model: DynamicWake):
    response = respond(model)
    projection = response.projection
    d, g = noise(4), noise(5)
    x = np.random.default_rng(6).normal(size=projection.terms)
    # Dot products of some hundred numbers of order 10.
    assert_allclose(np.vdot(g, projection.field(x)), projection.sums(g) @ x, rtol=0, atol=1e-11)
    assert_allclose(np.vdot(g, response.induced(d)), np.vdot(response.induced_transposed(g), d), rtol=0, atol=1e-10)


def test_feedback_is_solved_exactly(model: DynamicWake):
    response = respond(model)
    slope, f, g = -0.3 * np.abs(noise(7)), noise(8), noise(9)
    loop = response.feedback(slope, f)
    inflow = loop.solve(f)
    assert_allclose(inflow - response.induced(slope * inflow), f, rtol=0, atol=1e-12)
    v, on_load = loop.solve_transposed(g)
    assert_allclose(response.induced_transposed(v), on_load, rtol=0, atol=1e-11)
    assert_allclose(v - slope * on_load, g, rtol=0, atol=1e-11)
    assert_allclose(np.vdot(g, inflow), np.vdot(v, f), rtol=0, atol=1e-10)
    # Inflow that the terms can hold: the same loop without leaving them.
    x = np.random.default_rng(10).normal(size=response.projection.terms)
    assert_allclose(loop.solve(response.field(x)), response.field(loop.solve_terms(x)), rtol=0, atol=1e-10)


def test_inflow_of_one_load_and_of_many(model: DynamicWake):
    """One load by the wake's equations, many by the matrix made of them."""
    response = respond(model)
    loads = np.stack([noise(13), noise(14)])
    one = response.induced(loads[1])
    assert_allclose(response.induced(loads)[1], one, rtol=0, atol=5e-14 * np.abs(one).max())


def test_coordinates_of_a_sum_of_terms(model: DynamicWake):
    """A sum of terms is found again on any grid; of another field the nearest one; the bound holds."""
    own = np.random.default_rng(26).normal(size=model.on(0.1, ELEMENTS, AZIMUTHS).terms)
    for azimuths in (AZIMUTHS, 48):
        projection = model.on(0.1, ELEMENTS, azimuths)
        field = projection.field(own)
        found = projection.nearest(field)
        error = 1e-3 if model.blades % 2 else 1e-9  # Of an odd number of blades some terms depend on others.
        assert_allclose(projection.field(found), field, rtol=0, atol=error)
        assert_allclose(model.on(0.1, ELEMENTS, 90).field(found), model.on(0.1, ELEMENTS, 90).field(own), atol=error)
        assert np.abs(field).max() <= projection.bound(own) < 100.0 * np.abs(field).max()
        other = field + np.random.default_rng(27).normal(size=field.shape)
        rest = other - projection.field(projection.nearest(other))
        assert_allclose(projection.sums(rest), 0.0, atol=1e-2 if model.blades % 2 else 1e-9)


def test_many_changes_are_answered_as_each_with_its_field(model: DynamicWake):
    """Loads, changes of the wake and twist by two shapes with three harmonics each."""
    disk = build_disk(make_design().rotor, ELEMENTS, AZIMUTHS)
    shapes = HarmonicShapes.on(disk, np.stack([disk.r, disk.r**2]), 1)
    projection = model.on(disk.root, ELEMENTS, AZIMUTHS)
    response = DynamicWakeResponse(model.operator(projection, FORWARD), np.abs(noise(15)))
    feedback = response.feedback(-0.3 * np.abs(noise(16)))
    assert isinstance(feedback, ColumnFeedback)
    wake = np.array([[0.0, 0.0, 0.0], [-0.1, 0.2, 0.0], [0.0, 0.0, 1.0]])
    changes = np.stack([noise(17), noise(18), 0.0 * noise(19)]), wake, noise(20), shapes
    by_terms, by_fields = feedback.answer_columns(*changes), FieldColumns.of(response, feedback, *changes)
    mix = np.random.default_rng(21).normal(size=9)
    operator = response._operator
    own, beyond = operator.field(by_terms.change(mix)), operator.beyond_terms(np.abs(noise(15)))
    if beyond is not None:
        own += beyond * ((wake[:, 1] + wake[:, 2]) @ mix[:3])
    assert_allclose(own.ravel(), by_fields.change(mix), rtol=0, atol=1e-11)
    error = np.random.default_rng(25).normal(size=projection.terms)
    settled = by_fields.solve(operator.field(error).ravel())
    assert_allclose(operator.field(by_terms.solve(error)).ravel(), settled, rtol=0, atol=1e-10)
    weights, slope = np.stack([noise(22), noise(23)]), noise(24)
    sums = [answer.times(answer.rows(weights)) for answer in (by_terms, by_fields)]
    assert_allclose(sums[0], sums[1], rtol=0, atol=1e-10)
    projected = [answer.times(answer.projected_rows(slope, shapes)) for answer in (by_terms, by_fields)]
    assert_allclose(projected[0], projected[1], rtol=0, atol=1e-12)


@pytest.mark.parametrize("wake", [FORWARD, Wake(0.35, 0.04, 0.011), Wake(0.02, 0.0, 0.055), Wake(0.0, 0.0, 0.057)])
def test_slopes_by_wake(model: DynamicWake, wake: Wake):
    d = noise(11)
    exact = respond(model, wake).induced_by_wake(d)
    given_wake = np.array([wake.mu_x, wake.mu_z, wake.lambda0])
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-6
        ahead, behind = (respond(model, Wake(*(given_wake + s * step))).induced(d) for s in (1, -1))
        # Central differences: 1e-12 × third derivative (λ/V³ ~ 1e4) and rounding 1e-14/1e-6.
        assert_allclose(exact[k], (ahead - behind) / 2e-6, rtol=0, atol=1e-6 * np.abs(exact).max())


@given(mu=st.floats(0.0, 0.45), axial=st.floats(0.005, 0.1), lambda0=st.floats(0.002, 0.08))
def test_slopes_exist_everywhere(mu: float, axial: float, lambda0: float):
    """Near-edgewise flow included, where [L] itself cannot be inverted."""
    response = respond(DynamicWake(), Wake(mu, axial - lambda0, lambda0))
    flow = response.flow
    if flow.mass_flow <= 0.0:
        return  # Fast descent: the theory has no answer there.
    assert np.isfinite(response.induced(noise(12))).all()
    assert np.isfinite(response.induced_by_wake(noise(12))).all()


def test_steady_response_to_a_load_that_vanishes_at_the_hub():
    """Induced power of the actuator disk's type III load over Glauert's at µ 0.2, without tip factor: 1.169."""
    model = DynamicWake(harmonics=0)
    elements, azimuths = 200, 36
    projection = model.on(ROOT, elements, azimuths)
    r, dr = projection.r, (1.0 - ROOT) / elements
    load = r**3 * np.sqrt(1.0 - r**2)
    ct = 0.006511
    d = np.repeat((ct * load / (load.sum() * dr))[:, None], azimuths, axis=1)
    lambda0, _ = glauert_inflow(ct, 0.2, 0.0)
    response = model.operator(projection, Wake(0.2, 0.0, lambda0))
    inflow = projection.field(response.coefficients(d))
    kappa = (inflow * d).mean(axis=1).sum() * dr / (ct * lambda0)
    assert 1.169 <= kappa <= 1.173  # The span of the reference's own values.


def test_sideways_symmetry():
    """A load mirrored about the fore-aft line makes the mirrored inflow of the mirrored rotor.

    With rotation reversed sin qψ changes sign as well, so the apparent mass must be reversed: only its steady part is
    mirror-symmetric for one sense of rotation.
    """
    response = respond(DynamicWake(harmonics=0))
    d = noise(13)
    mirror = -np.arange(AZIMUTHS) % AZIMUTHS
    assert_allclose(response.induced(d[:, mirror]), response.induced(d)[:, mirror], rtol=0, atol=1e-11)


def test_blade_harmonics_against_time_marching():
    """Four blades with equal steady loads: march the wake's own equations until they repeat, and look from the blade.

    An axisymmetric load has only the wave numbers 4 and 8 for the modes kept, so nothing is lost to truncation.
    """
    model, wake = DynamicWake(order=4, harmonics=1), Wake(0.15, 0.01, 0.03)
    elements, azimuths = 20, 24
    projection = model.on(ROOT, elements, azimuths)
    r, dr = projection.r, (1.0 - ROOT) / elements
    load = 0.01 * np.square(r)
    response = model.operator(projection, wake)
    balanced = response.induced(np.repeat(load[:, None], azimuths, axis=1))

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
    model = DynamicWake(order=order, harmonics=harmonics)
    elements, azimuths = 400, 36
    projection = model.on(ROOT, elements, azimuths)
    r, dr = projection.r, (1.0 - ROOT) / elements
    across = (2.0 * r - 1.0 - ROOT) / (1.0 - ROOT)
    loads = (r * np.sqrt(1.0 - np.square(r)))[:, None] * np.polynomial.chebyshev.chebvander(across, 5)
    spread = np.repeat(loads.T[:, :, None], azimuths, axis=2)
    for row in table("axial_kappa"):
        axial = float(row["lam"])
        response = model.operator(projection, Wake(0.0, axial, 0.0))
        inflow = np.stack([response.induced(load)[:, 0] for load in spread], axis=1)
        form, thrust = loads.T @ inflow * dr, loads.sum(axis=0) * dr
        # Some combinations of loads drive no state at all; the least-squares solution leaves them out.
        best = np.linalg.lstsq(0.5 * (form + form.T), thrust, rcond=1e-10)[0]
        # The table has four decimals.
        assert_allclose(2.0 * axial / (thrust @ best), float(row[f"GDW_S{order}k{harmonics}"]), atol=2e-4)


def test_infinite_blades_use_the_tip_factor():
    model = DynamicWake.of(4, infinite_blades=True)
    response = respond(model)
    d = noise(14)
    factor, _ = tip_factor(R, FORWARD.axial, 4)
    plain = response.projection.field(response.coefficients(d))
    assert_allclose(response.induced(d), plain / factor[:, None], rtol=1e-14)
    assert np.all(respond(DynamicWake()).factor == 1.0)  # Blade harmonics hold the tip themselves.


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
            fields.append(model.operator(model.on(0.05, 60, 120), wake).induced(load)[:, 0])
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
        DynamicWake().on(ROOT, ELEMENTS, 32)

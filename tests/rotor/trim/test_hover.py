"""Hover: blade element momentum theory against its closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from rotor import Solution, make_design, solve
from rotor.aero.problem import build_problem
from rotor.airfoil.sections import load_installed
from rotor.columns.hover import closed_form_inflow, hover_system, lift_curve
from rotor.command.solve import report
from rotor.engine.linearise import evaluate

R = np.linspace(0.13, 0.99, 44)
SIGMA, SLOPE = 0.0821, 5.9


def hover(
    preset: str = "flight", twist: str = "linear:-12", mass: float = 8322.4, **models: object
) -> Solution:
    design = make_design(preset=preset, twist=twist, mu=0.0, mass_kg=mass)
    return solve(replace(design, models=replace(design.models, **models))).require()


@pytest.mark.parametrize(("factor", "climb"), [(1.0, 0.0), (0.6, 0.0), (1.0, 0.02)])
def test_closed_form_closes_the_balance(factor: float, climb: float):
    """(3.3), and (2.28) with λ_c, are the root of 4Fλ(λ − λ_c)r = ½σC_lα(θr² − λr)."""
    pitch = np.radians(16.0 - 8.0 * R)
    lam = closed_form_inflow(R, pitch, SIGMA, SLOPE, factor=factor, climb=climb)
    assert (lam > climb).all()  # The other root is an upflow.
    left = 4.0 * factor * lam * (lam - climb) * R
    assert_allclose(left, 0.5 * SIGMA * SLOPE * (pitch * R**2 - lam * R), rtol=1e-11)


@pytest.mark.parametrize("mu", [5e-324, 1e-12, 9e-10])
def test_an_advance_ratio_below_a_billionth_is_hover(mu: float):
    assert make_design(mu=mu) == make_design(hover=True)
    assert make_design(mu=0.2).at(mu=mu).hovering
    assert not make_design(mu=1e-9).hovering


def test_ideal_twist_gives_uniform_inflow():
    """θ = θ_tip/r, no losses, linear lift: λ is the same at every radius (eq. 1.1)."""
    lam = closed_form_inflow(R, 0.11 / R, SIGMA, SLOPE)
    assert_allclose(lam, lam[0], rtol=1e-12)


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_thrust_is_weight_and_nothing_varies_with_azimuth(preset: str):
    solution = hover(preset)
    # Of the UH-60A's rotor file; the document has none.
    download = 0.035 if preset == "flight" else 0.0
    assert_allclose(solution.ct, (1.0 + download) * solution.design.weight_coefficient, rtol=1e-10)
    assert np.ptp(solution.disk.dct, axis=1).max() == 0.0
    assert (
        solution.controls.cyclic_1s
        == solution.controls.shaft_tilt
        == solution.power.parasite
        == 0.0
    )


def test_without_losses_power_is_above_momentum_theory():
    """Induced power of any radial loading is at least T v_h; without losses a good twist is within 6 % of it."""
    ideal = 8322.4 * 9.80665 * math.sqrt(8322.4 * 9.80665 / (2 * 1.225 * math.pi * 8.1788**2))
    for twist, largest in (("linear:-12", 1.06), ("linear:0", 1.15)):
        induced = hover(
            twist=twist, tip_loss=False, hub_loss=False, swirl=False, download=False
        ).power.induced
        assert 1.0 < induced / ideal < largest


@pytest.mark.parametrize("preset", ["flight", "thesis"])
def test_coning_by_the_moment_integral(preset: str):
    """Eq. (2.35) with the hinge offset: ν²β0 I Ω² = ∫(y − e) dF_z − g S."""
    solution = hover(preset)
    design, disk = solution.design, solution.disk
    rotor, blade = design.rotor, design.rotor.blade
    # [N] per element and blade
    force = disk.dct[:, 0] * disk.dr * design.thrust_unit / rotor.blades
    arm = (disk.r - blade.flap_hinge) * rotor.radius
    weight = 9.80665 * blade.flap_static_moment if preset == "flight" else 0.0
    spring = blade.flap_inertia + blade.flap_hinge * rotor.radius * blade.flap_static_moment
    expected = ((force * arm).sum() - weight) / (spring * rotor.angular_speed**2)
    assert_allclose(solution.controls.coning, expected, rtol=1e-10)
    assert 0.04 < expected < 0.09


def test_collective_agrees_with_a_root_finder():
    """The collective that Newton finds is the one scipy's bracketing finds on thrust against collective."""
    solution = hover()
    system = hover_system(build_problem(solution.design))
    modes = len(system.structure.equations_of("twist"))
    rates = [-system.numbers[system.structure.numbers["coning stiffness"]], *np.ones(modes)]

    def excess(collective: float) -> float:
        x = np.concatenate([system.numbers, [collective, 0.0], np.zeros(modes)])
        while np.abs((point := evaluate(system, system.grid, x)).residual[1:]).max() > 1e-13:
            x[system.structure.free[1:]] -= point.residual[1:] / rates
        return float(point.residual[0])

    root = brentq(excess, 0.0, 0.3, xtol=1e-13)
    assert_allclose(solution.controls.collective, root, atol=1e-10)


def test_what_does_not_trim_says_why():
    solution = solve(make_design(mu=0.0, mass_kg=20_000.0, altitude_m=4000.0))
    assert not solution.converged
    assert "lower the mass or the altitude" in solution.message
    with pytest.raises(RuntimeError, match="Not trimmed"):
        solution.require()
    # UH-60A at µ 0.2: D = ½·1.225·(0.2·221)²·3.265 = 3.91 kN, four times 100 kg.
    solution = solve(make_design(mu=0.2, mass_kg=100.0))
    assert not solution.converged
    assert "drag tilts the shaft by 76°" in solution.message
    assert solution.message.endswith("raise the mass, or lower the speed or the drag area.")
    # 18 t at sea level and 8.3 t at 7000 m: no rotor has lifted as much.
    for design in (
        make_design(hover=True, mass_kg=18_000.0),
        make_design(hover=True, altitude_m=7000.0),
    ):
        solution = solve(design)
        assert not solution.converged
        assert "rotors have reached about 0.17" in solution.message


def test_a_rotor_that_presses_down_is_the_mirrored_one():
    """A blade of a symmetrical section: thrust and inflow of −4° are those of 4° with another sign; at 0° neither."""

    def at(collective: float) -> Solution:
        stand = {"collective_deg": collective}
        return solve(
            make_design(rotor="knight-hefner-3", hover=True, trim="controls", stand=stand)
        ).require()

    up, none, down = map(at, (4.0, 0.0, -4.0))
    assert down.ct < 0.0
    for read in (
        lambda s: s.ct,
        lambda s: s.controls.lambda0,
        lambda s: float(s.disk.induced.mean()),
    ):
        assert_allclose(read(down), -read(up), rtol=1e-4)
    assert_allclose(down.controls.lambda0, -math.sqrt(-0.5 * down.ct), rtol=1e-12)
    assert down.figure_of_merit == pytest.approx(up.figure_of_merit, rel=5e-3)
    assert down.induced_power_factor == pytest.approx(up.induced_power_factor, rel=1e-4)
    assert abs(none.ct) < 1e-12
    assert none.induced_power_factor is None
    assert "κ = P_i/(C_T λ0) none: there is no thrust" in report(none)
    assert f"shaft       {none.power.shaft:10.1f} W" in report(none)


@pytest.mark.parametrize(("altitude", "side"), [(6000.0, "below"), (6950.0, "above")])
def test_hover_at_high_loading_says_how_near_stall_is(altitude: float, side: str):
    """UH-60A: C_T/σ 0.152 and 0.169; above 0.17 the answer is refused."""
    solution = solve(make_design(mu=0.0, altitude_m=altitude)).require()
    (caveat,) = (caveat.sentence for caveat in solution.caveats if caveat.name == "blade-loading")
    margin = np.degrees(solution.disk.stall_margin).min()
    at = solution.disk.r[solution.disk.stall_margin.min(axis=1).argmin()]
    assert f"At {at:.2f} R the blade is {abs(margin):.1f}° {side} its stall angle." in caveat
    assert (margin > 0.0) == (solution.stalled_area == 0.0) == (side == "below")


def test_closed_form_uses_each_sections_own_lift_curve():
    """Eq. (3.3) on the flown blade: slope and zero-lift pitch are those of the section there, R8 drooped by 1°."""
    problem = build_problem(make_design(preset="flight", mu=0.0))
    slope, zero = lift_curve(problem)
    for radius, name in ((0.3, "sc1095"), (0.65, "sc1094r8"), (0.95, "sc1095")):
        element = int(np.argmin(np.abs(problem.disk.r - radius)))
        section = load_installed(name)
        assert_allclose(slope[element], section.table.lift_slope(0.3), rtol=1e-12)
        assert_allclose(
            zero[element], section.table.zero_lift_alpha(0.3) + section.incidence_offset, rtol=1e-12
        )
    # XFOIL's own α0.
    assert_allclose(np.degrees(zero[len(zero) // 2] - zero[0]), -1.6 + 1.0 + 0.72, atol=0.1)

"""Trims of a rotor on a test stand: their agreement with each other and with flight, their limits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, Solution, make_design, solve
from rotor.aero.lifting_line import WakeCourse
from rotor.design.aircraft import Stand
from rotor.trim.analysis import Analysis, power_gradient

TRIMS = {
    "tunnel-thrust": ("wind-tunnel", Stand(shaft_tilt=math.radians(5.0), ct_over_sigma=0.075)),
    "tunnel-backward": ("wind-tunnel", Stand(shaft_tilt=math.radians(-12.0), ct_over_sigma=0.075)),
    "tunnel-collective": ("wind-tunnel", Stand(shaft_tilt=math.radians(3.0), collective=0.12)),
    "tunnel-free-flapping": ("wind-tunnel", Stand(ct_over_sigma=0.06, flapping="free", cyclic_1s=-0.03)),
    "tunnel-hub-moments":
        ("wind-tunnel", Stand(ct_over_sigma=0.06, flapping="hub-moments", hub_roll=2e4, hub_pitch=-1e4)),
    "tunnel-no-thrust": ("wind-tunnel", Stand(ct_over_sigma=0.0)),
    "free-collective": ("free-rotor", Stand(collective=math.radians(2.0), flapping="free")),
    "free-thrust": ("free-rotor", Stand(ct_over_sigma=0.06, flapping="free")),
    "free-trimmed": ("free-rotor", Stand(thrust=60e3)),
    "controls": ("controls", Stand(collective=0.12, flapping="free", cyclic_1c=0.01, cyclic_1s=-0.05)),
}  # fmt: skip


def bench(
    name: str, mu: float = 0.2, inflow: str = "pitt-peters", precone: float | None = None
) -> Design:
    trim, stand = TRIMS[name]
    design = make_design(mu=mu, inflow=inflow, trim=trim, stand=stand)
    models = replace(design.models, elements=20, azimuths=48)
    return replace(design, models=models, rotor=replace(design.rotor, precone=precone))


@pytest.mark.parametrize("inflow", ["pitt-peters", "lifting-line"])
def test_a_free_rotor_has_no_torque_and_its_drag_does_the_work(inflow: str):
    solution = solve(bench("free-thrust", inflow=inflow)).require()
    _, drag = solution.lift_and_drag
    spent = solution.power.induced + solution.power.profile
    assert abs(solution.power.shaft) < 1e-8 * spent
    assert_allclose(drag * solution.design.airspeed, spent, rtol=1e-8)
    assert solution.controls.shaft_tilt < 0.0
    assert_allclose(solution.ct_over_sigma, 0.06, rtol=1e-9)


@pytest.mark.parametrize("inflow", ["pitt-peters", "lifting-line"])
def test_the_wind_tunnel_finds_the_trim_of_flight(inflow: str, same_course: WakeCourse):
    """With the wake on the same course: each is laid along a trim with linear inflow, which tilts differently."""
    flight = solve(make_design(mu=0.2, inflow=inflow)).require()
    stand = Stand(shaft_tilt=flight.controls.shaft_tilt, ct_over_sigma=flight.ct_over_sigma)
    tunnel = solve(make_design(mu=0.2, inflow=inflow, trim="wind-tunnel", stand=stand)).require()
    assert_allclose(tunnel.power.main_rotor, flight.power.main_rotor, rtol=1e-8)
    assert_allclose(tunnel.power.parasite, flight.power.parasite, rtol=1e-7)


def test_given_controls_return_the_trim_they_came_from():
    tunnel = solve(bench("tunnel-thrust")).require()
    state = tunnel.controls
    given = {
        name: getattr(state, name)
        for name in ("shaft_tilt", "collective", "cyclic_1c", "cyclic_1s")
    }
    stand = Stand(**given, flapping="free")
    models = replace(tunnel.design.models, trim="controls")
    back = solve(
        replace(
            tunnel.design, models=models, condition=replace(tunnel.design.condition, stand=stand)
        )
    )
    assert_allclose(back.require().controls.array(), state.array(), atol=1e-9)
    assert_allclose(back.power.shaft, tunnel.power.shaft, rtol=1e-8)


def test_hover_at_a_collective_and_without_thrust():
    thrust = solve(bench("tunnel-thrust", 0.0)).require()
    stand = Stand(collective=thrust.controls.collective)
    given = solve(
        replace(thrust.design, condition=replace(thrust.design.condition, stand=stand))
    ).require()
    assert_allclose(given.ct, thrust.ct, rtol=1e-10)
    assert_allclose(given.power.shaft, thrust.power.shaft, rtol=1e-10)
    # σ C_d0/8 with the drag near zero lift, and a little from the twist: between 0.006 and 0.016.
    solution = solve(bench("tunnel-no-thrust", 0.0)).require()
    assert abs(solution.ct) < 1e-12
    assert 0.006 < 8.0 * solution.cp / solution.design.rotor.solidity < 0.016


def test_a_free_rotor_is_not_said_to_speed_up():
    """Its power is zero but for rounding, of either sign."""
    loads = [replace(bench("free-thrust").condition, stand=Stand(ct_over_sigma=ct, flapping="free"))
             for ct in (0.03, 0.045, 0.055, 0.06, 0.065)]  # fmt: skip
    found = [solve(replace(bench("free-thrust"), condition=load)).require() for load in loads]
    assert not any(caveat.name == "beyond-autorotation" for one in found for caveat in one.caveats)


def test_shaft_power_of_a_free_rotor_has_no_gradient():
    solution = solve(bench("free-thrust"))
    with pytest.raises(RuntimeError, match="no power from its shaft"):
        power_gradient(solution)
    assert np.all(np.isfinite(power_gradient(solution, "induced").by_element))


def test_a_gimbal_keeps_its_coning_and_passes_no_moment():
    design = bench("tunnel-free-flapping", precone=math.radians(1.5))
    blade = replace(design.rotor.blade, flap_hinge=0.0)
    solution = solve(replace(design, rotor=replace(design.rotor, blade=blade))).require()
    assert_allclose(solution.controls.coning, math.radians(1.5))
    disk, lift = Analysis(solution).linear.problem.disk, Analysis(solution).linear.elements.fz
    moment = disk.r * disk.dr @ lift
    assert_allclose(
        2.0 / len(disk.psi) * moment @ np.array([disk.cos, disk.sin]).T, 0.0, atol=1e-12
    )
    assert solution.hub_moment.size < 1e-3


@pytest.mark.parametrize("mu", [0.005, 0.02, 0.05, 0.2])
@pytest.mark.parametrize("inflow", ["lifting-line", "local-momentum", "pitt-peters"])
def test_negative_thrust_mirrors_positive(inflow: str, mu: float):
    """An untwisted rotor of symmetric sections without weight, ±3° of collective, tilted by ±4°."""

    def at(sign: float) -> Solution:
        stand = {"collective_deg": 3.0 * sign, "shaft_tilt_deg": 4.0 * sign, "flapping": "free"}
        made = make_design(
            rotor="knight-hefner-3", mu=mu, inflow=inflow, trim="controls", stand=stand
        )
        return solve(replace(made, models=replace(made.models, blade_weight=False))).require()

    up, down = at(1.0), at(-1.0)
    assert up.ct > 1e-3
    assert down.ct == pytest.approx(-up.ct, rel=1e-4)  # The tables of the section mirror to 2e-5.
    assert down.power.induced == pytest.approx(up.power.induced, rel=1e-4)
    assert down.controls.flap_1c == pytest.approx(-up.controls.flap_1c, abs=1e-6)
    assert down.controls.flap_1s == pytest.approx(-up.controls.flap_1s, abs=1e-6)


def test_a_thrust_beyond_the_rotor_fails_with_a_sentence():
    design = bench("tunnel-thrust", 0.3)
    stand = Stand(ct_over_sigma=0.22)
    solution: Solution = solve(replace(design, condition=replace(design.condition, stand=stand)))
    assert not solution.converged
    assert solution.message.startswith("Not trimmed: the rotor on the stand has no equilibrium")


def test_speed_and_mass_are_wider_on_a_stand():
    design = bench("tunnel-thrust", 0.7)
    assert design.condition.advance_ratio == 0.7
    assert (
        make_design(mass_kg=5.0, trim="wind-tunnel", stand={"ct_over_sigma": 0.07}).condition.mass
        == 5.0
    )
    with pytest.raises(ValueError, match=r"outside 0…0\.6"):
        make_design(mu=0.7)

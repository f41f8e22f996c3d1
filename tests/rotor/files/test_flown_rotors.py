"""HART II, the SA349/2 Gazelle and the Bo 105 against numbers that are not in their files."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rotor import Solution, make_design, solve
from rotor.dynamics.flapping import flap_dynamics, lock_number
from rotor.dynamics.torsion import blade_modes
from rotor.files.rotor_file import read_aircraft, shipped_aircraft
from rotor.support.assets import asset_path
from rotor.trim.analysis import Analysis
from rotor.trim.power import hub_moment

HART2 = {
    "shaft_tilt_deg": -4.3, "thrust_n": 3300.0, "density_kg_m3": 1.2055, "tip_mach": 109.12 * 2.0 / 341.7,
    "flapping": "hub-moments", "hub_roll_nm": 20.0, "hub_pitch_nm": -20.0,
}  # fmt: skip


@pytest.fixture(scope="module")
def baseline() -> Solution:
    """The baseline case of HART II."""
    return solve(make_design(rotor="hart2", mu=32.9 / (109.12 * 2.0), stand=HART2)).require()


def test_more_power_than_the_engines_give_is_a_caveat():
    """The R22's placard speed, 102 kt, takes less than its 124 hp; 135 kt takes more."""
    slow, fast = (
        solve(make_design(rotor="r22", speed_kt=speed)).require() for speed in (102.0, 135.0)
    )
    assert slow.power.total < 124.0 * 745.7 < fast.power.total
    assert "installed-power" not in {one.name for one in slow.caveats}
    (caveat,) = [one for one in fast.caveats if one.name == "installed-power"]
    assert f"need {1e-3 * fast.power.total:.0f} kW; the engines give 92 kW" in caveat.sentence
    hot = solve(make_design(rotor="r22", speed_kt=60.0, isa_offset_c=20)).require()
    (caveat,) = [one for one in hot.caveats if one.name == "engines-of-a-standard-day"]
    assert "At altitude and in warmer air they give less, which is not counted" in caveat.sentence


def test_stops_of_the_uh60a_follow_from_its_mixer():
    """Sticks from stop to stop through the gains of GenHel: linkage, mixer, swashplate; pitch at the root."""
    # Lateral, fore and aft, up, pedals.
    travel = np.array([10.0, 10.0, 10.0, 5.38]) * [
        0.2062,
        0.2172,
        0.2025,
        0.3780,
    ]
    mixer = np.array([[0.68, 0, 0.993, 0], [0, 1.202, 0.905, -0.4288], [0, -1.202, 1.299, 0.4288]])
    plate = np.array([[11.3413, -5.6706, -5.6706], [0, -5.6706, 5.6706], [0, 3.5034, 3.5034]])

    def pitch(**places: float) -> list[float]:
        sticks = [
            places.get(name, 0.5) for name in ("lateral", "longitudinal", "collective", "pedals")
        ]
        a1, b1, root = plate @ (mixer @ (sticks * travel)) + [-7.9738, 9.7280, 10.1111]
        return [-a1, -b1, root - 9.65]

    stops = shipped_aircraft("uh60a").controls
    for k, name in enumerate(("lateral", "longitudinal", "collective")):
        ends = sorted(pitch(**{name: end})[k] for end in (0.0, 1.0))
        assert_allclose(np.degrees(getattr(stops, name)), ends, atol=0.01)
    # The same pitch around the disk, told by the swashplate and by the blade.
    psi, (c, s) = np.linspace(0.0, 6.0, 7), np.radians([2.0, -5.0])
    places = stops.places(0.1, c, s)
    plate_c, plate_s = (
        low + places[name] * (high - low)
        for name, (low, high) in (("lateral", stops.lateral), ("longitudinal", stops.longitudinal))
    )
    turned = psi - math.radians(9.7)
    assert_allclose(
        c * np.cos(psi) + s * np.sin(psi), plate_c * np.cos(turned) + plate_s * np.sin(turned)
    )


def test_pitch_beyond_the_stops_is_a_caveat():
    within, beyond = (solve(make_design(mu=mu, inflow="drees")).require() for mu in (0.3, 0.4))
    assert "controls" not in {one.name for one in within.caveats}
    (caveat,) = [one for one in beyond.caveats if one.name == "controls"]
    needed = math.degrees(beyond.controls.collective)
    assert needed > 16.1
    assert f"collective {needed:.1f}° of 0.5 to 16.1°" in caveat.sentence


def test_flap_frequency_of_point_masses_on_a_hinge_with_a_spring():
    """ν² = 1 + 3e/2(1 − e) + K/(IΩ²) of a uniform blade, against 400 masses that swing in the centrifugal field."""
    radius, hinge, mass, spring, speed = 3.0, 0.45, 20.0, 9000.0, 40.0
    text = asset_path("bo105.toml").read_text(encoding="utf-8")
    own = {
        "radius_m": radius, "blade_mass_kg": mass, "flap_spring_nm_rad": spring, "angular_speed_rad_s": speed,
    }  # fmt: skip
    main, rest = text.split("[tail_rotor]")
    for key, value in own.items():
        main = re.sub(rf"^{key} = .*$", f"{key} = {value}", main, flags=re.M)
    main = re.sub(r"^flap_inertia_kg_m2 = .*$", f"flap_hinge_m = {hinge}", main, flags=re.M)
    rotor = read_aircraft("own.toml", {"own.toml": f"{main}[tail_rotor]{rest}"}).rotor

    out = (np.arange(400) + 0.5) / 400.0 * (radius - hinge)
    point = mass / 400.0

    def swing(_t: float, y: np.ndarray) -> list[float]:
        arm, height = hinge + out * math.cos(y[0]), out * math.sin(y[0])
        # Centrifugal force times height, and the spring.
        back = point * speed**2 * float(arm @ height) + spring * y[0]
        return [y[1], -back / (point * float(out @ out))]

    def crossing(_t: float, y: np.ndarray) -> float:
        return float(y[0])

    found = solve_ivp(swing, (0.0, 2.0), [1e-3, 0.0], events=crossing, rtol=1e-9, atol=1e-12)
    period = 2.0 * float(np.diff(found.t_events[0]).mean())
    marched = 2.0 * math.pi / (period * speed)
    e = hinge / radius
    inertia = mass * (radius - hinge) ** 2 / 3.0
    assert_allclose(
        marched**2, 1.0 + 1.5 * e / (1.0 - e) + spring / (inertia * speed**2), rtol=1e-4
    )
    assert_allclose(math.sqrt(rotor.flap_frequency_squared), marched, rtol=1e-4)


def test_published_frequencies_and_lock_numbers():
    """Bo 105: 1.117/rev and 5.09 at a = 6.113 (Padfield); Gazelle: 6.4 Hz read off figure 15 of NASA TM-88370."""
    bo105, gazelle = shipped_aircraft("bo105").rotor, shipped_aircraft("gazelle").rotor
    assert_allclose(math.sqrt(bo105.flap_frequency_squared), 1.117, atol=0.001)
    assert_allclose(lock_number(bo105, 1.225, 6.113), 5.087, rtol=0.005)
    hertz = math.sqrt(gazelle.flap_frequency_squared) * gazelle.angular_speed / (2.0 * math.pi)
    assert_allclose(hertz, 6.4, rtol=0.03)
    assert_allclose(
        math.sqrt(shipped_aircraft("hart2").rotor.flap_frequency_squared), 1.12, atol=0.001
    )


def test_geometry():
    """Solidity 0.06366 (TM-88370) and 0.077 (aspect ratio 16.5); tip speeds of rotor speed times radius."""
    gazelle, hart2, bo105 = (shipped_aircraft(name).rotor for name in ("gazelle", "hart2", "bo105"))
    assert_allclose(
        [gazelle.solidity, hart2.solidity], [0.06366, 4.0 / (math.pi * 16.5)], rtol=2e-3
    )
    assert_allclose(
        [gazelle.tip_speed, hart2.tip_speed, bo105.tip_speed], [212.8, 218.2, 218.0], atol=0.1
    )
    # A model to scale, its chord 10 % larger.
    assert_allclose(hart2.radius / bo105.radius, 0.121 / 0.27, rtol=0.1)


def test_first_torsion_frequency_of_hart2():
    """β tan β = K L/GJ, ω² = (β/L)² GJ/I_θ + Ω² of a uniform rod on a spring; published 3.85/rev."""
    rotor = shipped_aircraft("hart2").rotor
    structure = rotor.blade.structure
    assert structure is not None
    length, stiffness = rotor.radius - structure.clamp, structure.torsional_stiffness[0]
    held = structure.control_stiffness * length / stiffness
    beta = float(brentq(lambda b: b * math.tan(b) - held, 0.1, 1.57))
    square = (beta / length) ** 2 * stiffness / structure.torsional_inertia[
        0
    ] + rotor.angular_speed**2
    exact = math.sqrt(square) / rotor.angular_speed
    assert_allclose(exact, 3.85, atol=0.01)
    found = blade_modes(structure, rotor.angular_speed, 1).frequency[0] / rotor.angular_speed
    assert_allclose(float(found), exact, rtol=1e-4)


def test_hub_moments_are_those_given(baseline: Solution):
    """They are Σ r dF_z, and also the spring's moments and the shear at the hinge, which know nothing of r dF_z."""
    assert_allclose([baseline.hub_moment.roll, baseline.hub_moment.pitch], [20.0, -20.0], atol=1e-3)
    assert_allclose(baseline.ct * baseline.design.thrust_unit, 3300.0, rtol=1e-6)
    problem, elements, c = (
        Analysis(baseline).linear.problem,
        Analysis(baseline).linear.elements,
        baseline.controls,
    )
    rotor, disk = baseline.design.rotor, problem.disk
    lift = disk.dr @ elements.fz * baseline.design.thrust_unit / len(disk.psi)
    offset = rotor.blade.flap_hinge * rotor.radius
    half = 0.5 * rotor.blades
    stiffness = half * (
        rotor.blade.flap_spring + offset * rotor.blade.flap_static_moment * rotor.angular_speed**2
    )
    assert_allclose(offset * (lift @ np.sin(disk.psi)) + stiffness * c.flap_1s, 20.0, rtol=1e-4)
    assert_allclose(-offset * (lift @ np.cos(disk.psi)) - stiffness * c.flap_1c, -20.0, rtol=1e-4)
    assert_allclose(hub_moment(problem, elements).roll, 20.0, atol=1e-3)
    assert_allclose(baseline.power.shaft, baseline.power.main_rotor, rtol=1e-8)


def test_the_coning_balances_lift_weight_and_a_spring_that_rests_at_the_precone(baseline: Solution):
    """I Ω² β0 + e S Ω² β0 + K (β0 − 2.5°) = lift times arm − g S, in N m of one blade."""
    problem, rotor = Analysis(baseline).linear.problem, baseline.design.rotor
    blade, disk, beta = rotor.blade, problem.disk, baseline.controls.coning
    arm = (disk.r - blade.flap_hinge) * rotor.radius
    fz = Analysis(baseline).linear.elements.fz
    lift = float(arm * disk.dr @ fz.mean(axis=1)) * baseline.design.thrust_unit / rotor.blades
    offset = blade.flap_hinge * rotor.radius
    stiff = (blade.flap_inertia + offset * blade.flap_static_moment) * rotor.angular_speed**2
    against = stiff * beta + blade.flap_spring * (beta - math.radians(2.5))
    assert_allclose(against, lift - 9.80665 * blade.flap_static_moment, rtol=1e-5)
    assert flap_dynamics(rotor, 1.2, blade_weight=True).preload > 0.0


def test_a_spring_at_the_offset_hinge_of_an_articulated_hub():
    """ν² = 1 + eS/I + K/IΩ² by hand, and a rigid blade that cones between its rest and where it would without."""
    text = asset_path("gazelle.toml").read_text(encoding="utf-8")
    given = "flap_spring_nm_rad = 20000.0\nprecone_deg = 1.0"
    files = {"own.toml": text.replace("[main_rotor]", f"[main_rotor]\n{given}", 1)}
    sprung, free = read_aircraft("own.toml", files).rotor, shipped_aircraft("gazelle").rotor
    blade = sprung.blade
    assert not blade.hingeless
    by_hand = 20000.0 / (blade.flap_inertia * sprung.angular_speed**2)
    assert by_hand > 0.005
    assert_allclose(sprung.flap_frequency_squared - free.flap_frequency_squared, by_hand, rtol=1e-9)
    assert_allclose(math.degrees(blade.flap_rest), 1.0)
    design = make_design(rotor="gazelle", mu=0.2)
    before, after = solve(design).require(), solve(replace(design, rotor=sprung)).require()
    square = free.flap_frequency_squared
    expected = (square * before.controls.coning + by_hand * math.radians(1.0)) / (square + by_hand)
    assert_allclose(after.controls.coning, expected, rtol=2e-3)


def test_masses_agree_with_their_moments():
    """m R²/3 of a uniform blade; and of any blade S²/m ≤ I ≤ S L, with its centre of mass about half-way out."""
    bo105, gazelle = (shipped_aircraft(name).rotor for name in ("bo105", "gazelle"))
    assert_allclose(bo105.blade.mass * bo105.radius**2 / 3.0, bo105.blade.flap_inertia, rtol=2e-3)
    blade, length = gazelle.blade, gazelle.radius * (1.0 - gazelle.blade.flap_hinge)
    first, second = blade.flap_static_moment, blade.flap_inertia
    assert first**2 / blade.mass <= second <= first * length
    assert_allclose(first / blade.mass, 0.5 * length, rtol=0.12)
    hart2 = shipped_aircraft("hart2").rotor
    spanned = hart2.radius * (1.0 - hart2.blade.flap_hinge)
    assert_allclose(hart2.blade.mass, hart2.blade.structure.mass_per_length[0] * spanned, rtol=1e-3)
    # Lock number of the model beside that of the full-scale blade, 5.09 (Padfield): it was scaled to it.
    offset = hart2.blade.flap_hinge * hart2.radius
    inertia = (
        hart2.blade.flap_inertia
        + 2.0 * offset * hart2.blade.flap_static_moment
        + offset**2 * hart2.blade.mass
    )
    assert_allclose(1.225 * 6.113 * 0.121 * hart2.radius**4 / inertia, 5.087, rtol=0.15)

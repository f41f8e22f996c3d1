"""An actuator that stops: nothing changes where it worked the same, and one blade's loads against hand calculation."""

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.__main__ import main
from rotor.actuator import one_blade
from rotor.actuator.stopped import frozen
from rotor.design import LinearTwist
from rotor.design.design import Design

PLAIN: dict[str, Any] = {
    "inflow": "drees", "elements": 24, "azimuths": 48, "mu": 0.25, "twist": "linear:-10", "dynamic_stall": "off",
    "off": "compressibility,tip-loss,hub-loss,elastic-twist,surface-drag,swirl,swept-tip,download",
}  # fmt: skip
CHANGE = math.radians(1.0)


def stiff(design: Design) -> Design:
    """Blades that hardly flap."""
    blade = replace(design.rotor.blade, flap_spring=1e9)
    return replace(design, rotor=replace(design.rotor, blade=blade))


def changed(design: Design, by: float = CHANGE) -> LinearTwist:
    assert isinstance(design.twist, LinearTwist)
    return LinearTwist(design.twist.rate + by)


def test_stopped_where_it_works_the_same_changes_nothing():
    design = rotor.make_design(**PLAIN)
    (point,) = frozen([design], design)
    assert point.cost == 0.0
    assert point.one_blade is not None
    assert point.one_blade.force_n == point.one_blade.moment_nm == point.one_blade.track_m == 0.0
    assert point.power_left == pytest.approx((design.aircraft.installed_power or 0.0) - (point.stopped.power or 0.0))


def test_frozen_twist_is_that_design():
    design = rotor.make_design(**PLAIN)
    other = design.with_twist("linear:-16")
    (point,) = frozen([design], other)
    powers = [rotor.solve(one).require().power.total for one in (design, other)]
    assert_allclose(point.cost or 0.0, powers[1] - powers[0], rtol=1e-4)
    assert point.record()["stopped_power_w"] == point.stopped.power


def test_a_twist_frozen_takes_the_pitch_at_the_root_from_the_controls():
    """Built −10° and stopped at −16°, with 0.62 R from root to 0.75 R: 3.7° more at the root."""
    design = rotor.make_design(**PLAIN)
    (rigged,) = frozen([design], design.with_twist("linear:-16"), design.twist)
    (own,) = frozen([design], design.with_twist("linear:-16"))
    low, high = rotor.make_design().aircraft.controls.collective  # pyright: ignore[reportOptionalMemberAccess]
    left = {"own": own.stopped.collective, "rigged": own.stopped.collective + math.radians(6.0 * (0.75 - 0.1304))}
    for point, pitch in ((own, left["own"]), (rigged, left["rigged"])):
        place = (pitch - low) / (high - low)
        assert point.stopped.controls_left is not None
        assert point.stopped.controls_left <= min(place, 1.0 - place) + 1e-12  # A cyclic may be nearer to its stop.
    assert rigged.stopped.controls_left == pytest.approx((high - left["rigged"]) / (high - low))
    assert rotor.make_design(rotor="r22").aircraft.controls is None


def test_frozen_twist_at_n_per_rev_keeps_amplitude_and_phase():
    design = rotor.make_design(**PLAIN, twist_per_rev="2:1.5:200")
    (same,) = frozen([design], design)
    assert same.cost == 0.0
    assert same.one_blade is not None
    assert same.one_blade.force_n == 0.0
    elsewhere = rotor.make_design(**PLAIN).at(mu=0.15)
    other = replace(elsewhere, active_twist=rotor.make_design(**PLAIN, twist_per_rev="2:1.5:20").active_twist)
    (point,) = frozen([design], other)
    by_phase = {
        phase: rotor.solve(rotor.make_design(**PLAIN, twist_per_rev=f"2:1.5:{phase}")).require().power.total
        for phase in (20, 200)
    }
    assert_allclose(point.stopped.power or 0.0, by_phase[20], rtol=1e-5)
    assert_allclose(point.working.power or 0.0, by_phase[200], rtol=1e-5)
    assert abs(by_phase[20] / by_phase[200] - 1.0) > 2e-4
    assert point.one_blade is None  # One blade alone has the twist law of the stop, not its twist at n/rev.


def test_one_stiff_blade_by_hand():
    """ΔdF_z = ½ρ c a U_T² Δθ of one blade, U_T = ΩR (r + µ sin ψ) and Δθ = k (r − 0.75).

    Its first harmonic shakes the hub up and down; its mean moment about the hub turns with the blade, so it rolls and
    pitches the airframe once per revolution. The drag that differs is small beside these.
    """
    design = stiff(rotor.make_design(**PLAIN))
    found = one_blade(rotor.solve(design), changed(design))
    blade, mu = design.rotor, design.condition.advance_ratio
    r = np.linspace(blade.blade.root_cutout, 1.0, 4001)
    slope = float(blade.blade.installed(blade.blade.spans[0].section).table.lift_slope(0.3))
    pressure = 0.5 * design.condition.density * blade.tip_speed**2 * blade.reference_chord * blade.radius
    shape = pressure * slope * CHANGE * (r - 0.75)
    assert_allclose(found.up_n, abs(np.trapezoid(2.0 * r * mu * shape, r)), rtol=0.08)
    mean = blade.radius * np.trapezoid(r * (r**2 + 0.5 * mu**2) * shape, r)
    second = 0.5 * mu**2 * blade.radius * np.trapezoid(r * shape, r)  # Of sin² ψ: it changes roll and pitch a little.
    assert_allclose(found.roll_nm, mean + 0.5 * second, rtol=0.08)
    assert_allclose(found.pitch_nm, mean - 0.5 * second, rtol=0.08)
    assert found.track_m < 1e-3
    assert found.aft_n < 0.3 * found.up_n


def test_small_changes_add_up_and_hinges_carry_little_moment():
    design = rotor.make_design(**PLAIN)
    trim = rotor.solve(design)
    half, whole, back = (one_blade(trim, changed(design, by)) for by in (0.5 * CHANGE, CHANGE, -CHANGE))
    for name in ("up_n", "roll_nm", "pitch_nm", "track_m"):
        assert_allclose(2.0 * getattr(half, name), getattr(whole, name), rtol=0.05)
        assert_allclose(getattr(back, name), getattr(whole, name), rtol=0.1)
    held = one_blade(rotor.solve(stiff(design)), changed(design))
    assert whole.moment_nm < 0.2 * held.moment_nm
    assert whole.track_m > 1e-3


def test_what_has_none():
    hover = rotor.make_design(**PLAIN).at(hover=True)
    with pytest.raises(ValueError, match="In hover the inflow"):
        one_blade(rotor.solve(hover), changed(hover))
    bent = rotor.make_design(**PLAIN, bending=True)
    with pytest.raises(ValueError, match="bending off"):
        one_blade(rotor.solve(bent), changed(bent))


def test_the_command(capsys: pytest.CaptureFixture[str]):
    small = ("--inflow=drees", "--elements=16", "--azimuths=36")
    assert main(["actuator", *small, "--stops-at", "0", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["failures"]
    assert found["stops_at_mu"] == 0.0
    hover, *_, fast = found["points"]
    assert hover["cost_w"] == 0.0
    assert hover["one_blade"] is None
    assert fast["cost_w"] > 0.0
    assert fast["one_blade"]["up_n"] > 0.0
    assert main(["actuator", *small, "--stops-at", "0"]) == 0
    assert "stopped at µ 0, its twist frozen" in capsys.readouterr().out

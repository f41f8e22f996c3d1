"""The charts of the results strip as values: differences, speeds, stall limits, lift."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.charts.curve_bands import Bands, band_along, curve_bands
from explorer.charts.plots import SWEEP, PowerCurve, angles_along
from explorer.charts.strip import (
    LOOKS,
    Role,
    alpha_chart,
    lift_per_metre,
    power_change_chart,
    total_power_chart,
    with_band,
    with_speeds,
)
from explorer.model.units import AVIATION, SI
from rotor import Solution, Status, doubt, make_design, solve
from rotor.aero.switches import with_switches
from rotor.support.chart import Band, Chart, Line, Points, drawn_chart


@pytest.fixture(scope="module")
def linear() -> Solution:
    return solve(make_design(mu=0.2, twist="linear:-8")).require()


def lines(chart: Chart) -> list[Line]:
    return [one for one in chart.series if isinstance(one, Line)]


def roles(chart: Chart) -> list[Role]:
    """What its lines look like."""
    by_look: dict[tuple[object, ...], Role] = {look: role for role, look in LOOKS.items()}
    return [by_look[one.colour, one.width, one.dashes] for one in lines(chart)]


def line(chart: Chart, role: Role) -> np.ndarray:
    (found,) = [one.y for one, own in zip(lines(chart), roles(chart), strict=True) if own == role]
    return np.array(found)


def dots(chart: Chart) -> list[tuple[float, float, str]]:
    """Place and words of each."""
    return [(one.x[0], one.y[0], one.words[0]) for one in chart.series if isinstance(one, Points)]


class TestPowerChange:
    def curve(self, slope: float) -> PowerCurve:
        mu = np.array(SWEEP)
        reference = 900.0 + 2000.0 * mu
        return PowerCurve(reference + slope * mu, reference, np.full(len(mu), math.nan))

    def test_the_line_is_the_difference_and_hover_is_marked(self):
        chart = power_change_chart(self.curve(-50.0), 0.2, -10e3, "UH-60A as built")
        assert chart.y.label == "kW vs. UH-60A as built"
        assert lines(chart)[0].x[0] == 0.0
        assert_allclose(lines(chart)[0].y, -50.0 * np.array(lines(chart)[0].x), atol=1e-9)
        assert [(x, words) for x, _, words in dots(chart)] == [(0.0, "hover"), (0.2, "now")]
        assert chart.value == ""  # The card has it, with its band.

    def test_points_without_trim_are_gaps(self):
        curve = self.curve(-50.0)
        curve.design[-1] = math.nan
        chart = power_change_chart(curve, 0.2, None, "A")
        told: Any = drawn_chart(chart).series
        assert told[0].y[-1] is None
        assert told[-1].y == [None]
        assert chart.value == ""

    def test_a_design_that_is_its_own_reference_shows_its_power(self):
        """A line at zero would say nothing: the bucket does, and where it is deepest."""
        curve = self.curve(0.0)
        curve.design[:] = 700.0 + 8000.0 * (np.array(SWEEP) - 0.15) ** 2
        chart = total_power_chart(curve, 0.2, 720e3)
        assert (chart.y.label, chart.value) == ("kW", "least near µ 0.15")
        assert_allclose(
            lines(chart)[0].y, 700.0 + 8000.0 * (np.array(lines(chart)[0].x) - 0.15) ** 2
        )
        assert dots(chart) == [(0.0, curve.design[0], "hover"), (0.2, 720.0, "now")]

    def test_the_bowl_fills_its_chart_and_the_whole_is_at_hand(self):
        """Of a bowl from 1,550 over 870 to 3,850 kW, whose 35 kW about the least were 1 % of the axis."""
        curve = self.curve(0.0)
        curve.design[:] = np.where(
            np.array(SWEEP) < 0.17, 870.0 + 23500.0 * (np.array(SWEEP) - 0.17) ** 2, 0.0
        )
        curve.design[7:] = 870.0 + 38000.0 * (np.array(SWEEP)[7:] - 0.17) ** 2
        near = total_power_chart(curve, 0.2, 904e3).y
        drawn = drawn_chart(total_power_chart(curve, 0.2, 904e3)).y
        assert near.range == (800.0, 1100.0)
        assert near.whole == (0.0, 4000.0)
        assert [at for at, _ in drawn.ticks] == [800.0, 1000.0]
        assert drawn.whole is not None
        assert [at for at, _ in drawn.whole.ticks] == [0.0, 2000.0, 4000.0]
        # What is flown is always within the axis, and measured powers are.
        assert total_power_chart(curve, 0.0, 1550e3).y.range == (800.0, 1600.0)
        flown = Points("", (0.1, 0.3), (700.0, 2000.0))
        low, high = total_power_chart(curve, 0.2, 904e3, marks=flown).span("y")
        assert low <= 700.0
        assert high >= 2000.0
        # A change is judged where one flies, too.
        curve.reference[:] = curve.design + np.where(np.array(SWEEP) < 0.3, 5.0, 400.0)
        assert power_change_chart(curve, 0.2, -5e3, "A").span("y")[0] > -50.0

    def test_the_top_speed_is_where_power_meets_that_of_the_engines(self):
        """A parabola meets a level at a place known in closed form; the points lie .025 apart."""
        curve, black_hawk = self.curve(0.0), make_design()
        curve.design[:] = 700.0 + 40000.0 * (np.array(SWEEP) - 0.15) ** 2
        chart = total_power_chart(curve, 0.2, 720e3, design=black_hawk)
        mu = 0.15 + math.sqrt((2327.0 - 700.0) / 40000.0)
        kmh = float(re.findall(r"[\d.]+", chart.value)[-1])
        assert kmh == pytest.approx(3.6 * mu * black_hawk.rotor.tip_speed, rel=0.005)
        assert roles(chart)[0] == "limit"
        assert_allclose(lines(chart)[0].y, 2327.0)
        curve.design[:] = 700.0
        assert total_power_chart(curve, 0.2, 700e3, design=black_hawk).value.startswith(
            "least near"
        )
        assert "limit" not in roles(
            total_power_chart(curve, 0.2, 700e3, design=make_design(rotor="s61"))
        )

    def test_speeds_of_endurance_and_range_and_the_walls(self):
        """Power a/µ + bµ³ is least at (a/3b)^¼, power over speed a/µ² + bµ² at (a/b)^¼."""
        curve, design, mus = self.curve(0.0), make_design(), np.array(SWEEP)
        a, b = 60.0, 15000.0
        with np.errstate(divide="ignore"):
            curve.design[:] = np.where((mus > 0.06) & (mus < 0.4), a / mus + b * mus**3, math.nan)
        plain = total_power_chart(curve, 0.2, 420e3)
        chart, fastest = with_speeds(plain, curve, design)
        pressed = {
            one.names[0]: one.x[0]
            for one in chart.series
            if isinstance(one, Points) and one.mark == "ring"
        }
        assert pressed == {
            "endurance": pytest.approx((a / (3.0 * b)) ** 0.25, abs=0.002),
            "range": pytest.approx((a / b) ** 0.25, abs=0.002),
        }
        last = mus[mus < 0.4][-1]
        # The engines give more.
        assert (fastest, [rule.at for rule in chart.rules]) == (
            last,
            [last],
        )
        curve.design[:] *= 5.0
        meets = np.linspace(0.2, 0.4, 20001)
        wall = meets[np.argmin(np.abs(5.0 * (a / meets + b * meets**3) - 2327.0))]
        chart, fastest = with_speeds(plain, curve, design)
        assert fastest == pytest.approx(wall, abs=0.002)
        assert len(chart.rules) == 2
        climbing = replace(design, condition=replace(design.condition, climb_speed=3.0))
        assert not any(
            isinstance(one, Points) and one.action
            for one in with_speeds(plain, curve, climbing)[0].series
        )

    def test_autorotation_is_marked_below_zero(self):
        curve = self.curve(0.0)
        curve.design[:] = 4e4 * (np.array(SWEEP) - 0.15) ** 2 - 150.0
        curve.design[:3] = math.nan
        chart = total_power_chart(curve, 0.15, -150e3)
        assert chart.span("y")[0] <= -150.0
        assert chart.value == "driven by the air"
        assert chart.note == (
            "Autorotation between µ 0.1 and 0.2: the air drives the rotor. "
            "No solution below µ 0.075: vortex ring state."
        )
        (tinted,) = [np.array(one.y) for one in lines(chart) if one.filled]
        assert (tinted[np.isfinite(tinted)] < 0.0).all()
        assert total_power_chart(curve, 0.3, 750e3).value == "least near µ 0.15"
        assert power_change_chart(curve, 0.15, 0.0, "A").note == chart.note

    def test_a_power_not_swept_yet_is_its_dot_alone(self):
        curve = self.curve(0.0)
        curve.design[:] = math.nan
        chart = total_power_chart(curve, 0.2, 720e3, AVIATION)
        assert (chart.value, chart.y.range, chart.y.whole) == ("", (0.0, 1500.0), None)
        assert dots(chart)[-1][1] == pytest.approx(720e3 / 745.699872, abs=0.1)


class TestAlpha:
    def test_lines_and_least_margin(self, cruise: Solution, linear: Solution):
        chart = alpha_chart(cruise, linear, 65.0)
        # The lower limit lies below the axis.
        assert roles(chart) == [
            "limit",
            "reference",
            "this",
        ]
        lower, upper, alpha = angles_along(cruise, 65.0)
        assert_allclose(line(chart, "this"), alpha)
        margin = float(np.nanmin(np.minimum(upper - alpha, alpha - lower)))
        assert chart.value == f"{margin:.1f}° to static stall"
        lost = replace(linear, status=Status.NOT_CONVERGED)
        assert "reference" not in roles(alpha_chart(cruise, lost, 65.0))
        assert "pinned" in roles(alpha_chart(cruise, linear, 65.0, compared="pinned"))

    def test_separated_flow_and_angles_past_the_static_one_are_told_apart(self):
        heavy = solve(make_design(mu=0.3, mass_kg=9800.0)).require()
        disk = heavy.disk
        psi = np.degrees(disk.psi)
        chart = alpha_chart(heavy, None, float(psi[np.argmax(disk.stalled.sum(axis=0))]))
        assert chart.value == "separated"
        assert chart.note.startswith("Separated between 0.")
        past = (disk.stall_margin < 0.0) & (disk.u_t > 0.0) & ~disk.stalled
        only = past.any(axis=0) & ~disk.stalled.any(axis=0)
        chart = alpha_chart(heavy, None, float(psi[np.argmax(only)]))
        assert chart.value == "past the static angle"
        assert chart.note.startswith("Past the static stall angle, still attached, between 0.")

    def test_shaded_is_what_lies_between_alpha_and_the_static_angle(self):
        """In the colour of stall just where the flow is separated, as the disk has it."""
        heavy = solve(make_design(mu=0.3, mass_kg=9800.0)).require()
        disk, stall = heavy.disk, LOOKS["limit"][0]
        for column in range(0, len(disk.psi), 3):
            psi = float(np.degrees(disk.psi[column]))
            bands = [b for b in alpha_chart(heavy, None, psi).series if isinstance(b, Band)]
            lower, upper, alpha = angles_along(heavy, psi)
            static = np.where(alpha > 0.5 * (lower + upper), upper, lower)
            for row, r in enumerate(disk.r):
                inside = [band for band in bands if band.x[0] <= r <= band.x[-1]]
                separated = bool(disk.stalled[row, column])
                shaded = separated or bool(alpha[row] > upper[row] or alpha[row] < lower[row])
                assert len(inside) == shaded, (psi, r)
                for band in inside:
                    assert (band.colour == stall) == separated
                    at = list(band.x).index(r)
                    ends = sorted((alpha[row], static[row]))
                    assert_allclose((band.low[at], band.high[at]), ends)

    def test_without_stall_nothing_is_said_or_shaded(self):
        heavy = solve(make_design(mu=0.3, mass_kg=9800.0)).require()
        without = replace(heavy, design=with_switches(heavy.design, ("stall",)))
        assert (
            alpha_chart(without, None, 65.0).value,
            roles(alpha_chart(without, None, 65.0)),
        ) == ("", ["this"])


class TestLift:
    def test_the_blades_carry_the_thrust(self):
        made = make_design(mu=0.2)
        cruise = solve(
            replace(made, models=replace(made.models, azimuths=24))
        ).require()  # As solved.
        design = cruise.design
        per_blade = float(cruise.disk.dr @ lift_per_metre(cruise)) * design.rotor.radius
        assert_allclose(per_blade * design.rotor.blades, cruise.ct * design.thrust_unit, rtol=1e-9)
        assert_allclose(per_blade * design.rotor.blades, design.condition.weight, rtol=0.05)


BLADES = tuple(make_design(twist=twist) for twist in ("linear:-12", "builtin"))


@pytest.fixture(scope="module")
def bands() -> Bands:
    return curve_bands(*BLADES)


def test_the_band_of_the_curve_is_that_of_its_trims(bands: Bands):
    """Where it is worked out, and between; beyond, and on a curve without it, there is none."""
    for mu, atol in ((0.1, 1.0), (0.25, 1500.0)):
        here, there = (solve(design.at(mu=mu)) for design in BLADES)
        (within,) = band_along(bands, np.array([mu]))
        assert within == pytest.approx(doubt(here, there).change_band, abs=atol)
    assert np.isnan(band_along(bands, np.array([0.43]))).all()
    ((mu, power), *_) = curve_bands(BLADES[0], None)
    assert (mu, power) == (0.0, pytest.approx(doubt(solve(BLADES[0].at(mu=0.0))).band, rel=1e-3))


@pytest.mark.parametrize("bands", [(), ((0.0, 9e3),), ((0.6, 9e3), (0.7, 9e3))])
def test_a_curve_without_band_stays_as_it_is(bands: Bands):
    mu = np.array(SWEEP)
    chart = total_power_chart(
        PowerCurve(900.0 + mu, 900.0 + mu, np.full(len(mu), math.nan)), 0.2, 900e3
    )
    assert with_band(chart, bands, SI) == chart


def test_the_band_lies_about_the_curve(bands: Bands):
    mu = np.array(SWEEP)
    curve = PowerCurve(900.0 - 100.0 * mu, np.full(len(mu), 900.0), np.full(len(mu), math.nan))
    first, *rest = with_band(power_change_chart(curve, 0.2, -20e3, "A"), bands, SI).series
    assert isinstance(first, Band)
    assert rest[0] == replace(rest[0], filled=False)
    assert rest[1:] == list(power_change_chart(curve, 0.2, -20e3, "A").series)[1:]
    assert 0.5 * (np.array(first.low) + np.array(first.high)) == pytest.approx(
        -100.0 * np.array(first.x)
    )
    assert 1e3 * (np.array(first.high) - np.array(first.low)) == pytest.approx(
        2.0 * band_along(bands, np.array(first.x))
    )
    assert (first.x[0], first.x[-1]) == (0.0, pytest.approx(0.4))

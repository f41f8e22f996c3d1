"""The SA349/2 Gazelle and the Bo 105 in level flight beside this project's: section lift, power, controls.

Nothing is fitted to any of it. Drag that no source states decides the level of power, so the shape over speed stands
beside it: each power over the measured one, by the mean of that quotient over all speeds. No scatter of these
measurements is known, so they have no target.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from rotor.aero.momentum import glauert_inflow
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.assets import asset_path, csv_rows
from rotor.support.chart import Axis, Chart, Line, Points, Series
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation import airloads
from rotor.validation.trust import TrustRow, TrustSet, description, rms

POWERS = "flown-power"
"""Name of the set."""
TITLES = {"gazelle": "SA349/2 Gazelle", "bo105": "Bo 105"}
ANGLES = {
    "theta0": "collective",
    "theta1c": "cyclic 1c",
    "theta1s": "cyclic 1s",
    "theta0_tail": "tail rotor",
}
"""Angles of the Bo 105: of the main rotor collective at its centre, and cyclic; of the tail rotor collective."""
SPEEDS_KT = (0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 105.0)
"""At which the angles of the Bo 105 are computed; linear between."""
MASS_KG = 2200.0
"""Mass of the Bo 105, assumed: the source states none."""
AIRLOADS = "gazelle-airloads"
"""Name of the set of the Gazelle's section lift."""
_LIFT = {"cl": "c_l", "cl_u2": "c_l (r + µ sin ψ)²"}


POWER_REPORTS = {
    "gazelle": "NASA TM-88351 (1987), digitised by the authors of HEROES",
    "bo105": "DLR flight test in Padfield, Helicopter Flight Dynamics (1996), figure 4.11; its mass is not stated, "
    "2200 kg assumed",
}
"""Sources of the powers, by rotor."""


@dataclass(frozen=True)
class MeasuredPower:
    """Main-rotor power of one flight in level flight."""

    rotor: str
    case: str
    mu: float
    mass: float
    """[kg]"""
    altitude: float
    """Pressure altitude [m]."""
    power: float
    """[W]"""
    angles: tuple[float, ...] | None
    """Collective, cyclic 1c and 1s [°]; None where they were not measured."""

    def same_air(self, design: Design) -> bool:
        """Whether a design has this mass and altitude, and all else as in level flight."""
        here = design.condition
        pairs = ((here.mass, self.mass), (here.altitude, self.altitude))
        same = all(math.isclose(value, other, abs_tol=1e-6) for value, other in pairs)
        return here.stand is None and same and not design.unusual

    def same_flight(self, design: Design) -> bool:
        """Whether a design also flies at this advance ratio."""
        return self.same_air(design) and math.isclose(
            design.condition.advance_ratio, self.mu, abs_tol=1e-9
        )

    def error(self, solution: Solution) -> float:
        """Computed less measured power of the main rotor, over the measured one."""
        return solution.power.main_rotor / self.power - 1.0

    @property
    def title(self) -> str:
        """The flight in words."""
        return f"{self.case}: µ {self.mu:g}, {self.mass:g} kg, {self.altitude:g} m"


@cache
def measured_powers() -> tuple[MeasuredPower, ...]:
    """Every power that was measured in flight."""
    angles = ("theta0_deg", "theta1c_deg", "theta1s_deg")
    return tuple(
        MeasuredPower(
            row["rotor"], row["case"], float(row["mu"]), float(row["mass_kg"]), float(row["altitude_m"]),
            1e3 * float(row["power_kw"]), tuple(float(row[name]) for name in angles) if row["theta0_deg"] else None,
        )
        for row in csv_rows(asset_path("measured/flown_power.csv"))
    )  # fmt: skip


@dataclass(frozen=True)
class FlownPower:
    """Main-rotor power of one flight [W], angles in degrees."""

    rotor: str
    case: str
    mu: float
    measured: float
    computed: float | None
    """None where our rotor does not trim."""
    measured_angles: tuple[float, ...] | None
    """Collective, cyclic 1c and 1s; None where they were not measured. Where along the blade the report takes the
    collective is not known."""
    angles: tuple[float, ...] | None
    """Computed, the collective at 0.75 R."""


@dataclass(frozen=True)
class FlownAngle:
    """One pitch of the Bo 105 over speed [°], (speeds,)."""

    quantity: str
    speed_kt: tuple[float, ...]
    measured: tuple[float, ...]
    computed: tuple[float, ...]

    @property
    def error(self) -> Array:
        """Computed less measured."""
        return np.subtract(self.computed, self.measured)


def flown_powers() -> Iterator[FlownPower]:
    """Every measured power beside the computed one."""
    for power in measured_powers():
        solution = solve(
            make_design(
                rotor=power.rotor, mu=power.mu, mass_kg=power.mass, altitude_m=power.altitude
            )
        )
        controls = solution.controls
        computed = (controls.collective, controls.cyclic_1c, controls.cyclic_1s)
        main = solution.power.main_rotor if solution.converged else None
        angles = tuple(map(math.degrees, computed)) if solution.converged else None
        yield FlownPower(power.rotor, power.case, power.mu, power.power, main, power.angles, angles)


def shape_errors(computed: Sequence[float], measured: Sequence[float]) -> tuple[float, float]:
    """Root mean square of the errors of a curve's shape, and the mean error of its level.

    The quotient of each two values over the mean of all quotients, less 1; that mean less 1.
    """
    quotient = np.divide(computed, measured)
    level = float(quotient.mean())
    return rms(quotient / level - 1.0), level - 1.0


def flown_angles() -> tuple[FlownAngle, ...]:
    """The four pitch angles of the Bo 105."""
    solutions = [
        solve(make_design(rotor="bo105", speed_kt=speed, mass_kg=MASS_KG)).require()
        for speed in SPEEDS_KT
    ]
    computed: Array = np.degrees(np.array([_angles(solution) for solution in solutions])).T
    rows = csv_rows(asset_path("measured/bo105_controls.csv"))
    angles: list[FlownAngle] = []
    for name, values in zip(ANGLES, list(computed), strict=True):
        mine = [row for row in rows if row["quantity"] == name]
        speeds = tuple(float(row["speed_kt"]) for row in mine)
        there = np.asarray(np.interp(speeds, SPEEDS_KT, values), dtype=np.float64)
        angles.append(
            FlownAngle(
                name, speeds, tuple(float(row["value_deg"]) for row in mine), tuple(there.tolist())
            )
        )
    return tuple(angles)


def _angles(solution: Solution) -> tuple[float, float, float, float]:
    """In the order of `ANGLES` [rad]; the pitch of a linear blade at the centre, by its own twist."""
    design, controls = solution.design, solution.controls
    ends = design.rotor.builtin_twist(np.array([0.75, 1.0]))
    centre = controls.collective - 3.0 * float(ends[1] - ends[0])
    return centre, controls.cyclic_1c, controls.cyclic_1s, tail_pitch(solution)


def tail_pitch(solution: Solution) -> float:
    """Collective of an untwisted tail rotor that balances the torque [rad]; ValueError where none does.

    C_T = ½ σ a [θ (1/3 + µ²/2) − λ/2], uniform inflow by Glauert (Leishman, Principles of Helicopter Aerodynamics).
    """
    design, tail = solution.design, solution.design.tail_rotor
    if tail is None:
        raise ValueError(f"{design.rotor.name} has no tail rotor: its pitch cannot be computed")
    tip_speed = tail.angular_speed * tail.radius
    thrust = (
        solution.power.main_rotor / design.rotor.angular_speed / (tail.arm * math.cos(tail.cant))
    )
    ct = thrust / (design.condition.density * math.pi * tail.radius**2 * tip_speed**2)
    solidity, mu = (
        tail.blades * tail.chord / (math.pi * tail.radius),
        design.flight_speed / tip_speed,
    )
    inflow = glauert_inflow(ct / tail.tip_loss**2, mu, 0.0)[0]
    return (2.0 * ct / (solidity * tail.lift_slope) + 0.5 * inflow) / (1.0 / 3.0 + 0.5 * mu**2)


def flown_set() -> TrustSet:
    """The set of the trust page: powers and control angles measured in flight."""
    words, powers, angles = description(POWERS), list(flown_powers()), flown_angles()
    gazelle, bo105 = (
        100.0 * shape_errors(*_trimmed(powers, rotor))[0] for rotor in ("gazelle", "bo105")
    )
    return words.page(
        f"shape: {TITLES['gazelle']} {gazelle:.1f} %; {TITLES['bo105']} {bo105:.1f} %",
        (*_power_rows(powers), *_gazelle_rows(powers), *map(_angle_row, angles)),
        (*(_power_chart(powers, rotor) for rotor in ("bo105", "gazelle")), _angle_chart(angles)),
        points=_points(powers, angles),
    )


def _trimmed(powers: Sequence[FlownPower], rotor: str) -> tuple[list[float], list[float]]:
    """Computed and measured powers where the computation trims."""
    mine = [
        (row.computed, row.measured)
        for row in powers
        if row.rotor == rotor and row.computed is not None
    ]
    return [computed for computed, _ in mine], [measured for _, measured in mine]


def _power_rows(powers: Sequence[FlownPower]) -> Iterator[TrustRow]:
    words, test = description(POWERS), "test_powers_of_flight"
    for rotor, title in TITLES.items():
        shape, level = shape_errors(*_trimmed(powers, rotor))
        what, shown = f"{title}: power over speed, shape", f"rms {100 * shape:.1f} %"
        yield words.row(what, shown, shape, 5e-3, test=test, note=rotor)
        yield words.share(f"{title}: power over speed, level", level, 5e-3, test=test)


def _gazelle_rows(powers: Sequence[FlownPower]) -> Iterator[TrustRow]:
    words = description(POWERS)
    errors = [
        np.subtract(row.angles, row.measured_angles)
        for row in powers
        if row.angles and row.measured_angles
    ]
    for name, differences in zip(list(ANGLES.values())[:3], list(np.array(errors).T), strict=True):
        size, note = rms(differences), words.notes.get(name, "")
        yield words.row(
            f"SA349/2 Gazelle: {name}, four flights", f"rms {size:.1f}°", size, 0.05, note=note
        )


def _angle_row(angle: FlownAngle) -> TrustRow:
    words, size = description(POWERS), rms(angle.error)
    return words.row(
        f"Bo 105: {ANGLES[angle.quantity]} over speed", f"rms {size:.1f}°, mean {angle.error.mean():+.1f}°", size, 0.1,
        note=words.notes.get(angle.quantity, ""),
    )  # fmt: skip


def _power_chart(powers: Sequence[FlownPower], rotor: str) -> Chart:
    mine = sorted(
        (row for row in powers if row.rotor == rotor and row.computed is not None),
        key=lambda row: row.mu,
    )
    mu = [row.mu for row in mine]
    series = (
        Points("measured", mu, [row.measured / 1e3 for row in mine]),
        Line("computed", mu, [(row.computed or math.nan) / 1e3 for row in mine], 1, dots=True),
    )
    return Chart(
        f"Power of the {TITLES[rotor]}",
        Axis("advance ratio µ"),
        Axis("main-rotor power [kW]"),
        series,
    )


def _angle_chart(angles: Sequence[FlownAngle]) -> Chart:
    series: list[Series] = []
    for k, angle in enumerate(angles, start=1):
        series.append(
            Points(f"{ANGLES[angle.quantity]}, measured", angle.speed_kt, angle.measured, k)
        )
        series.append(Line("computed", angle.speed_kt, angle.computed, k))
    return Chart(
        "Pitch angles of the Bo 105", Axis("airspeed [kt]"), Axis("pitch [°]"), tuple(series)
    )


def _points(
    powers: Sequence[FlownPower], angles: Sequence[FlownAngle]
) -> tuple[tuple[str, ...], ...]:
    rows = [("Helicopter", "Quantity", "At", "Measured", "Computed", "Error")]
    for row in powers:
        computed = "no trim" if row.computed is None else f"{row.computed / 1e3:.1f}"
        rows.append(
            (TITLES[row.rotor], "power [kW]", row.case, f"{row.measured / 1e3:.1f}", computed, "")
        )
    for row in powers:
        if row.measured_angles and row.angles:
            for name, theirs, computed in zip(
                ANGLES.values(), row.measured_angles, row.angles, strict=False
            ):
                error = f"{computed - theirs:+.1f}"
                rows.append(
                    (
                        TITLES[row.rotor],
                        f"{name} [°]",
                        row.case,
                        f"{theirs:.1f}",
                        f"{computed:.1f}",
                        error,
                    )
                )
    for angle in angles:
        for speed, theirs, computed in zip(
            angle.speed_kt, angle.measured, angle.computed, strict=True
        ):
            what = f"{ANGLES[angle.quantity]} [°]"
            at, error = f"{speed:.1f} kt", f"{computed - theirs:+.1f}"
            rows.append(("Bo 105", what, at, f"{theirs:.1f}", f"{computed:.1f}", error))
    return tuple(rows)


def gazelle_set() -> TrustSet:
    """The set of the trust page: section lift of the Gazelle, as c_l and times the dynamic pressure."""
    solutions = {
        case.name: solve(case.design()).require()
        for case in airloads.CASES
        if case.test == AIRLOADS
    }
    curves = [curve for curve in airloads.measured_curves() if curve.case.test == AIRLOADS]
    agreements = [airloads.agreement(curve, solutions[curve.case.name]) for curve in curves]
    lift = [beside.correlation for beside in agreements if beside.quantity == "cl"]
    return description(AIRLOADS).page(
        f"correlation {min(lift):.2f} to {max(lift):.2f}",
        (_lift_row(name, quantity, agreements) for quantity in _LIFT for name in solutions),
        (_lift_chart(solution, [curve for curve in curves if (curve.case.name, curve.quantity) == (name, "cl")])
         for name, solution in solutions.items()),
        points=_lift_points(agreements),
    )  # fmt: skip


def _lift_row(name: str, quantity: str, agreements: Sequence[airloads.CurveAgreement]) -> TrustRow:
    mine = [curve for curve in agreements if (curve.case.name, curve.quantity) == (name, quantity)]
    return description(AIRLOADS).row(
        f"{name}: correlation of {_LIFT[quantity]} at r/R {', '.join(f'{curve.r:g}' for curve in mine)}",
        ", ".join(f"{curve.correlation:.2f}" for curve in mine),
        min(curve.correlation for curve in mine),
        0.02,
    )


def _lift_chart(solution: Solution, curves: Sequence[airloads.MeasuredCurve]) -> Chart:
    """c_l at the radii."""
    series: list[Series] = []
    for k, measured in enumerate(curves, start=1):
        series.append(
            Points(f"measured, {measured.r:g} R", np.degrees(measured.psi), measured.values, k)
        )
        series.append(
            Line(
                "computed", *airloads.closed_around(*airloads.computed_curve(measured, solution)), k
            )
        )
    case = curves[0].case
    title = f"Section lift coefficient, {case.name}, µ {case.conditions['mu']:g}"
    return airloads.azimuth_chart(title, f"c_l, {case.name}", series)


def _lift_points(agreements: Sequence[airloads.CurveAgreement]) -> tuple[tuple[str, ...], ...]:
    rows: list[tuple[str, ...]] = [
        (
            "Flight",
            "r/R",
            "Quantity",
            "Correlation",
            "rms error",
            "Measured rms",
            "Mean",
            "Measured mean",
        )
    ]
    for curve in agreements:
        numbers = (
            curve.correlation,
            curve.rms,
            curve.measured_rms,
            curve.mean,
            curve.measured_mean,
        )
        rows.append(
            (curve.case.name, f"{curve.r:g}", _LIFT[curve.quantity], *(f"{x:.3f}" for x in numbers))
        )
    return tuple(rows)

"""Rotors in flight: measured airloads and twist over the azimuth, power and controls, beside ours.

HART II in the tunnel, the SA349/2 Gazelle and the Bo 105 in flight. Nothing is fitted to any of it. The level of power
is decided by drag that no source states, so it stands between the drag areas of the rotor file, without a target.

Of airloads the harmonics 1 to 10 are compared, which a lifting line on 24 azimuths can have: what is above is the blade
meeting single vortices, out of its reach. The mean stands beside them, for in HART II it differs by 12 % between cases
of the same thrust.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rotor.analysis.series import between_drag_areas
from rotor.arrays import Array
from rotor.assets import asset_path, csv_rows
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.distribution import distribution
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

HIGHEST = 10
"""Harmonic of loads."""
HIGHEST_TWIST = 3
"""The same of the tip's twist, which has 22 points a revolution."""


@dataclass(frozen=True)
class FlownCase:
    """One condition of a test."""

    test: str
    """Name of the set on the command line."""
    name: str
    rotor: str
    conditions: Mapping[str, Any] = field(hash=False)
    """For `make_design`."""

    def design(self) -> Design:
        """The rotor there, with the models of `flight`."""
        return make_design(rotor=self.rotor, **self.conditions)


def _tunnel(density: float, sound: float, speed: float, moment: float) -> dict[str, Any]:
    stand = {
        "thrust_n": 3300.0, "shaft_tilt_deg": -4.3, "density_kg_m3": density, "tip_mach": 2.0 * speed / sound,
        "flapping": "hub-moments", "hub_roll_nm": moment, "hub_pitch_nm": -moment,
    }  # fmt: skip
    return {"mu": round(32.9 / (2.0 * speed), 4), "stand": stand}


HART2_BASELINE = FlownCase("hart2-airloads", "BL", "hart2", _tunnel(1.2055, 341.7, 109.12, 20.0))
"""As OpenCOPTER's case files state it; shaft wall-corrected. The signs of the hub moments are not checked: 20 N m is
0.3 % of thrust times radius, and the other sign moves power by 1.5 % and the twist of the tip by 0.01°."""
CASES = (
    HART2_BASELINE,
    FlownCase(
        "hart2-airloads", "MN", "hart2", _tunnel(1.1931, 342.2, 109.01, 30.0) | {"pitch_per_rev": ((3, 0.8, 300.0),)}
    ),
    FlownCase("gazelle-airloads", "FC1", "gazelle", {"mu": 0.14, "mass_kg": 1985.0, "altitude_m": 317.0}),
    FlownCase("gazelle-airloads", "FC2", "gazelle", {"mu": 0.362, "mass_kg": 1934.0, "altitude_m": 1521.0}),
)
"""MN: 0.8° of pitch at 3/rev at the root, for least noise. NASA TM-88351 for the Gazelle."""
TESTS = tuple(dict.fromkeys(case.test for case in CASES))
REPORTS = {
    "hart2-airloads": "HART II, DNW 2001, as the public code OpenCOPTER carries it",
    "gazelle-airloads": "NASA TM-88351 (1987), flight, digitised by the authors of HEROES",
}


@dataclass(frozen=True, eq=False)
class MeasuredCurve:
    """One measured quantity over the azimuth."""

    case: FlownCase
    quantity: str
    """`cn_m2`, `cm_m2`: normal force and moment coefficient times Mach number squared; `cl_u2`: lift coefficient times
    (r + µ sin ψ)²; `tip_twist_deg`: elastic twist of the tip, nose up, without the pitch of the root."""
    r: float
    """r/R"""
    psi: Array
    """[rad], (points,)"""
    values: Array
    """(points,)"""

    @property
    def highest(self) -> int:
        """Harmonic up to which it is compared."""
        return HIGHEST_TWIST if self.quantity == "tip_twist_deg" else HIGHEST


@dataclass(frozen=True)
class CurveAgreement:
    """A measured curve and ours by harmonics, without the mean."""

    case: FlownCase
    quantity: str
    r: float
    correlation: float
    rms: float
    """Of the difference."""
    measured_rms: float
    """Of the measured curve itself."""
    mean: float
    measured_mean: float


def measured_curves() -> tuple[MeasuredCurve, ...]:
    """All of them, in the order of `CASES`."""
    return tuple(curve for case in CASES for curve in _curves(case))


def _curves(case: FlownCase) -> Iterator[MeasuredCurve]:
    if case.rotor == "hart2":
        loads = csv_rows(asset_path("measured/hart2_airloads.csv"))
        psi = np.radians([float(row["psi_deg"]) for row in loads])
        for name in ("cn", "cm"):
            values = np.array([float(row[f"{name}_{case.name.lower()}"]) for row in loads])
            yield MeasuredCurve(case, f"{name}_m2", 0.87, psi, values)
        twist = [row for row in csv_rows(asset_path("measured/hart2_twist.csv")) if row["case"] == case.name]
        psi = np.radians([float(row["psi_deg"]) for row in twist])
        yield MeasuredCurve(case, "tip_twist_deg", 1.0, psi, np.array([float(row["twist_deg"]) for row in twist]))
        return
    rows = [row for row in csv_rows(asset_path("measured/gazelle_airloads.csv")) if row["case"] == case.name]
    for r in sorted({float(row["r"]) for row in rows}):
        here = [row for row in rows if float(row["r"]) == r]
        psi = np.radians([float(row["psi_deg"]) for row in here])
        cl = np.array([float(row["cl"]) for row in here])
        yield MeasuredCurve(case, "cl_u2", r, psi, cl * (r + case.conditions["mu"] * np.sin(psi)) ** 2)


def our_curve(measured: MeasuredCurve, solution: Solution) -> tuple[Array, Array]:
    """Azimuths [rad] and our values of a measured quantity there, (azimuths,) each."""
    disk = solution.disk
    if measured.quantity == "tip_twist_deg":
        assert solution.elastic is not None
        twist = solution.elastic.tip
        return np.linspace(0.0, 2.0 * math.pi, len(twist), endpoint=False), np.degrees(twist)
    found = distribution(solution)
    match measured.quantity:
        case "cn_m2":
            field_ = (disk.cl * np.cos(disk.alpha) + disk.cd * np.sin(disk.alpha)) * disk.mach**2
        case "cm_m2":
            field_ = found.cm * disk.mach**2
        case _:
            field_ = disk.cl * (disk.r[:, None] + solution.design.condition.advance_ratio * np.sin(disk.psi)) ** 2
    after = int(np.clip(np.searchsorted(disk.r, measured.r), 1, len(disk.r) - 1))
    share = (measured.r - disk.r[after - 1]) / (disk.r[after] - disk.r[after - 1])
    return disk.psi, (1.0 - share) * field_[after - 1] + share * field_[after]


def harmonics(psi: Array, values: Array, highest: int) -> Array:
    """Mean and the cosine and sine amplitudes 1 … `highest` by least squares, (1 + 2 highest,)."""
    order = np.arange(1, highest + 1)
    waves = np.concatenate([np.cos(np.outer(psi, order)), np.sin(np.outer(psi, order))], axis=1)
    basis = np.concatenate([np.ones((len(psi), 1)), waves], axis=1)
    return np.asarray(np.linalg.lstsq(basis, values, rcond=None)[0], dtype=np.float64)


def airload_agreement(tests: tuple[str, ...] = TESTS) -> Iterator[CurveAgreement]:
    """Every measured curve of these tests beside ours; RuntimeError where a rotor does not trim."""
    solutions: dict[str, Solution] = {}
    for measured in measured_curves():
        case = measured.case
        if case.test not in tests:
            continue
        if case.test + case.name not in solutions:
            solutions[case.test + case.name] = solve(case.design()).require()
        theirs = harmonics(measured.psi, measured.values, measured.highest)
        ours = harmonics(*our_curve(measured, solutions[case.test + case.name]), measured.highest)
        one, other = ours[1:], theirs[1:]  # By Parseval's theorem sums over harmonics are means over the azimuth.
        yield CurveAgreement(
            case=case,
            quantity=measured.quantity,
            r=measured.r,
            correlation=float(one @ other / math.sqrt((one @ one) * (other @ other))),
            rms=math.sqrt(0.5 * float((one - other) @ (one - other))),
            measured_rms=math.sqrt(0.5 * float(other @ other)),
            mean=float(ours[0]),
            measured_mean=float(theirs[0]),
        )


POWERS = "flown-power"
"""Name of the set of powers on the command line."""


@dataclass(frozen=True)
class FlownPower:
    """Main-rotor power of one flight [W], angles in degrees."""

    rotor: str
    case: str
    mu: float
    measured: float
    ours: float | None
    """None where our rotor does not trim."""
    band: tuple[float, float] | None
    """Ours with the lowest and the highest drag area of the sources."""
    measured_angles: tuple[float, float, float] | None
    """Collective, cyclic 1c and 1s; None where they were not measured. Where along the blade the report takes the
    collective is not known."""
    angles: tuple[float, float, float] | None
    """Ours, the collective at 0.75 R."""


def flown_powers() -> Iterator[FlownPower]:
    """Every measured power beside ours."""
    for row in csv_rows(asset_path("measured/flown_power.csv")):
        mu = float(row["mu"])
        mass, altitude = float(row["mass_kg"]), float(row["altitude_m"])
        solution = solve(make_design(rotor=row["rotor"], mu=mu, mass_kg=mass, altitude_m=altitude))
        ends, controls = between_drag_areas(solution), solution.controls
        ours = (controls.collective, controls.cyclic_1c, controls.cyclic_1s)
        names = ("theta0_deg", "theta1c_deg", "theta1s_deg")
        yield FlownPower(
            rotor=row["rotor"],
            case=row["case"],
            mu=mu,
            measured=1e3 * float(row["power_kw"]),
            ours=solution.power.main_rotor if solution.converged else None,
            band=None if ends is None else (ends[0].power.main_rotor, ends[1].power.main_rotor),
            measured_angles=_three([float(row[name]) for name in names]) if row["theta0_deg"] else None,
            angles=_three([math.degrees(one) for one in ours]) if solution.converged else None,
        )


def _three(values: list[float]) -> tuple[float, float, float]:
    first, second, third = values
    return first, second, third

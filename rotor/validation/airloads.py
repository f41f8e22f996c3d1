"""Measured airloads, twist, flapping and pitch-link loads over the azimuth beside computed ones: HART II and the
UH-60A in tunnels, the Gazelle in flight.

Nothing is fitted to any of it.

Of airloads the harmonics 1 to 10 are compared, which a lifting line on 24 azimuths can have: what is above is the blade
meeting single vortices, out of its reach. The mean stands beside them, for in HART II it differs by 12 % between cases
of the same thrust.
"""

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.assets import asset_path, csv_rows
from rotor.support.chart import AZIMUTH, Axis, Chart, Series
from rotor.trim.distribution import distribution
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation.trust import description

HIGHEST = 10
"""Harmonic of loads."""
HIGHEST_TIP = 3
"""Highest harmonic of the tip's twist and flapping, which have 22 and 23 points a revolution."""


@dataclass(frozen=True)
class FlownCase:
    """One measured condition of a flight or wind-tunnel test."""

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


PITCH_LINK = "uh60a-pitch-link"
PITCH_LINK_SPEEDS = (0.15, 0.2, 0.24, 0.3, 0.35, 0.37)
"""Advance ratios of the UH-60A in the tunnel."""


def _pitch_link_test(mu: float) -> dict[str, Any]:
    """Shaft tilt and hub moments are not stated: 5° forward and no first-harmonic flapping are assumed."""
    return {"mu": mu, "stand": {"ct_over_sigma": 0.09, "shaft_tilt_deg": 5.0}, "bending": True}


HART2_BASELINE = FlownCase("hart2-airloads", "BL", "hart2", _tunnel(1.2055, 341.7, 109.12, 20.0))
"""The baseline case as OpenCOPTER's case files state it; shaft wall-corrected. The signs of the hub moments are not
checked: 20 N m is 0.3 % of thrust times radius, and the other sign moves power by 1.6 % and the twist of the tip by
0.01°."""
CASES = (
    HART2_BASELINE,
    FlownCase(
        "hart2-airloads",
        "MN",
        "hart2",
        _tunnel(1.1931, 342.2, 109.01, 30.0) | {"pitch_per_rev": ((3, 0.8, 300.0),)},
    ),
    FlownCase(
        "gazelle-airloads", "FC1", "gazelle", {"mu": 0.14, "mass_kg": 1985.0, "altitude_m": 317.0}
    ),
    FlownCase(
        "gazelle-airloads", "FC2", "gazelle", {"mu": 0.362, "mass_kg": 1934.0, "altitude_m": 1521.0}
    ),
    *(
        FlownCase(PITCH_LINK, f"µ {mu:.2f}", "uh60a", _pitch_link_test(mu))
        for mu in PITCH_LINK_SPEEDS
    ),
)
"""MN: 0.8° of pitch at 3/rev at the root, for least noise. NASA TM-88351 for the Gazelle."""
TESTS = tuple(dict.fromkeys(case.test for case in CASES))
REPORTS = {name: description(name).against or description(name).source for name in TESTS}
"""Sources, by test."""


@dataclass(frozen=True, eq=False)
class MeasuredCurve:
    """One measured quantity over the azimuth."""

    case: FlownCase
    quantity: str
    """`cn_m2`, `cm_m2`: normal force and moment coefficient times Mach number squared; `cl`: lift coefficient of the
    section; `cl_u2`: the same times (r + µ sin ψ)²; `tip_twist_deg`: elastic twist of the tip, nose up, without the
    pitch of the root; `tip_flap`: deflection of the tip up from the precone, over R; `pitch_link`: load of one pitch
    link without its mean [N], positive where the blade's moment is nose up."""
    r: float
    """r/R"""
    psi: Array
    """[rad], (points,)"""
    values: Array
    """(points,)"""

    @property
    def highest(self) -> int:
        """Harmonic up to which it is compared."""
        return HIGHEST_TIP if self.quantity.startswith("tip_") else HIGHEST

    @property
    def waves(self) -> Array:
        """`harmonics` of this curve."""
        return harmonics(self.psi, self.values, self.highest)


@dataclass(frozen=True, eq=False)
class CurveAgreement:
    """A measured curve and the computed one by harmonics, without the mean."""

    case: FlownCase
    quantity: str
    r: float
    correlation: float
    """Of the two curves without their means, −1…1."""
    rms: float
    """Root mean square of the difference, in the unit of the quantity."""
    measured_rms: float
    """Root mean square of the measured curve itself, in the same unit."""
    mean: float
    measured_mean: float
    """In the unit of the quantity, as `mean`."""
    waves: Array = field(repr=False)
    """Of the computed curve, by `harmonics`."""
    measured_waves: Array = field(repr=False)

    def amplitude(self, n: int, *, measured: bool = False) -> float:
        """Amplitude of harmonic n, in the unit of the quantity."""
        return abs(wave_amplitude(self.measured_waves if measured else self.waves, n))

    def phase_deg(self, n: int, *, measured: bool = False) -> float:
        """φ of A cos(nψ − φ), −180 to 180°."""
        return math.degrees(
            cmath.phase(wave_amplitude(self.measured_waves if measured else self.waves, n))
        )

    def ratio(self, n: int) -> float:
        """Computed amplitude over the measured one, less 1 [-]."""
        return self.amplitude(n) / self.amplitude(n, measured=True) - 1.0

    def late_deg(self, n: int) -> float:
        """Computed phase less the measured one, −180 to 180°."""
        return math.degrees(
            cmath.phase(wave_amplitude(self.waves, n) / wave_amplitude(self.measured_waves, n))
        )

    def miss(self, n: int) -> float:
        """|computed − measured| of harmonic n as vectors, over the measured amplitude [-]."""
        measured = wave_amplitude(self.measured_waves, n)
        return abs(wave_amplitude(self.waves, n) - measured) / abs(measured)

    def to_dict(self) -> dict[str, Any]:
        """The agreement as `validate --json` prints it."""
        names = ("quantity", "r", "correlation", "rms", "measured_rms", "mean", "measured_mean")
        waves = {
            "harmonics": self.waves.tolist(),
            "measured_harmonics": self.measured_waves.tolist(),
        }
        return (
            {"test": self.case.test, "case": self.case.name}
            | {name: getattr(self, name) for name in names}
            | waves
        )


def measured_curves() -> tuple[MeasuredCurve, ...]:
    """All measured airload curves, in the order of `CASES`."""
    return tuple(curve for case in CASES for curve in _curves(case))


def _curves(case: FlownCase) -> Iterator[MeasuredCurve]:
    name = case.name.lower()
    if case.rotor == "hart2":
        for quantity, r, file, column in (
            ("cn_m2", 0.87, "airloads", f"cn_{name}"), ("cm_m2", 0.87, "airloads", f"cm_{name}"),
            ("tip_twist_deg", 1.0, "twist", "twist_deg"), ("tip_flap", 1.0, "flap", "z"),
        ):  # fmt: skip
            rows = csv_rows(asset_path(f"measured/hart2_{file}.csv"))
            # One column of loads for each case.
            rows = [row for row in rows if row.get("case", case.name) == case.name]
            psi_deg, values = columns(rows, "psi_deg", column)
            yield MeasuredCurve(case, quantity, r, np.radians(psi_deg), values)
        return
    if case.test == PITCH_LINK:
        rows = csv_rows(asset_path("measured/uh60a_pitch_link.csv"))
        psi_deg, load = columns(rows, "psi_deg", case.name.removeprefix("µ "))
        yield MeasuredCurve(case, "pitch_link", 0.0, np.radians(psi_deg), load)
        return
    rows = [
        row
        for row in csv_rows(asset_path("measured/gazelle_airloads.csv"))
        if row["case"] == case.name
    ]
    for r in sorted({float(row["r"]) for row in rows}):
        psi_deg, cl = columns([row for row in rows if float(row["r"]) == r], "psi_deg", "cl")
        psi = np.radians(psi_deg)
        yield MeasuredCurve(case, "cl", r, psi, cl)
        yield MeasuredCurve(
            case, "cl_u2", r, psi, cl * (r + case.conditions["mu"] * np.sin(psi)) ** 2
        )


def columns(rows: Sequence[Mapping[str, str]], *names: str) -> list[Array]:
    """Columns of a table as numbers, (rows,) each."""
    return [np.array([float(row[name]) for row in rows]) for name in names]


def computed_curve(measured: MeasuredCurve, solution: Solution) -> tuple[Array, Array]:
    """Azimuths [rad] and computed values of a measured quantity there, (azimuths,) each."""
    disk = solution.disk
    if measured.quantity == "tip_twist_deg":
        twist = np.zeros(len(disk.psi)) if solution.elastic is None else solution.elastic.tip
        return np.linspace(0.0, 2.0 * math.pi, len(twist), endpoint=False), np.degrees(twist)
    if measured.quantity == "tip_flap":
        blade, state = solution.design.rotor.blade, solution.controls
        flapping = (
            state.coning + state.flap_1c * np.cos(disk.psi) + state.flap_1s * np.sin(disk.psi)
        )
        return disk.psi, (1.0 - blade.flap_hinge) * (flapping - blade.flap_rest)
    if measured.quantity == "pitch_link":
        load = (
            np.zeros(len(disk.psi))
            if solution.elastic is None
            else solution.elastic.pitch_link_load
        )
        return disk.psi, load.mean() - load
    loads = distribution(solution)
    match measured.quantity:
        case "cn_m2":
            field_ = disk.cl * np.cos(disk.alpha) + disk.cd * np.sin(disk.alpha)
            field_ = (field_ if disk.apparent is None else field_ + disk.apparent[0]) * disk.mach**2
        case "cm_m2":
            moment = _pitch_damping(solution) if disk.apparent is None else disk.apparent[1]
            field_ = (loads.cm + moment) * disk.mach**2
        case "cl":
            field_ = disk.cl
        case _:
            field_ = (
                disk.cl
                * (disk.r[:, None] + solution.design.condition.advance_ratio * np.sin(disk.psi))
                ** 2
            )
    after = int(np.clip(np.searchsorted(disk.r, measured.r), 1, len(disk.r) - 1))
    share = (measured.r - disk.r[after - 1]) / (disk.r[after] - disk.r[after - 1])
    return disk.psi, (1.0 - share) * field_[after - 1] + share * field_[after]


def _pitch_damping(solution: Solution) -> Array:
    """C_m about the quarter chord of the rate of pitch, −(π/4) c θ̇/U (Theodorsen, NACA Report 496), shape of the disk.

    Pressures on the surface hold it, and the trim of an elastic blade; the section's own C_m does not.
    """
    disk, rotor = solution.disk, solution.design.rotor
    order = np.fft.rfftfreq(len(disk.psi), 1.0 / len(disk.psi))
    rate = np.fft.irfft(1j * order * np.fft.rfft(disk.theta, axis=1), len(disk.psi), axis=1)
    chord = rotor.blade.chord(disk.r) / rotor.radius
    return -0.25 * math.pi * chord[:, None] * rate / np.hypot(disk.u_t, disk.u_p)


def harmonics(psi: Array, values: Array, highest: int) -> Array:
    """Mean and the cosine and sine amplitudes 1 … `highest` by least squares, (1 + 2 highest,)."""
    order = np.arange(1, highest + 1)
    waves = np.concatenate([np.cos(np.outer(psi, order)), np.sin(np.outer(psi, order))], axis=1)
    basis = np.concatenate([np.ones((len(psi), 1)), waves], axis=1)
    return np.asarray(np.linalg.lstsq(basis, values, rcond=None)[0], dtype=np.float64)


def wave_amplitude(of: Array, n: int) -> complex:
    """A exp(iφ) of the part A cos(nψ − φ) of `harmonics`."""
    return complex(of[n], of[n + len(of) // 2])


def closed_around(psi: Array, values: Array) -> tuple[Array, Array]:
    """Azimuths [°] and values of a line around the azimuth, with the first repeated at 360°."""
    return np.append(np.degrees(psi), 360.0), np.append(values, values[0])


def azimuth_chart(title: str, label: str, series: Iterable[Series]) -> Chart:
    """A chart over the azimuth."""
    return Chart(title, Axis("azimuth [°]", ticks=AZIMUTH), Axis(label), tuple(series))


def airload_agreement(tests: tuple[str, ...] = TESTS) -> Iterator[CurveAgreement]:
    """Every measured curve of these tests beside the computed one; RuntimeError where a rotor does not trim."""
    for case in CASES:
        if case.test in tests:
            solution = solve(case.design()).require()
            yield from (agreement(measured, solution) for measured in _curves(case))


def agreement(measured: MeasuredCurve, solution: Solution) -> CurveAgreement:
    """Agreement of a measured curve with the curve that a solution gives."""
    theirs, computed = (
        measured.waves,
        harmonics(*computed_curve(measured, solution), measured.highest),
    )
    # By Parseval's theorem sums over harmonics are means over the azimuth.
    wave, other = (
        computed[1:],
        theirs[1:],
    )
    size = math.sqrt((wave @ wave) * (other @ other))
    return CurveAgreement(
        case=measured.case,
        quantity=measured.quantity,
        r=measured.r,
        correlation=float(wave @ other / size) if size > 0.0 else 0.0,
        rms=math.sqrt(0.5 * float((wave - other) @ (wave - other))),
        measured_rms=math.sqrt(0.5 * float(other @ other)),
        mean=float(computed[0]),
        measured_mean=float(theirs[0]),
        waves=computed,
        measured_waves=theirs,
    )

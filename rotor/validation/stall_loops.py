"""Loops of a pitching aerofoil: dynamic stall beside what the University of Glasgow measured.

Nothing is fitted: f and m come from the static table that goes with the runs, lags from `rotor.airfoil.stall_onset`.
"""

import math
from dataclasses import dataclass

import numpy as np

from rotor.aero.dynamic_stall import ADDED_M, ADDED_N, StallData, empty_lags, stall_states
from rotor.aero.lifting_line import theodorsen
from rotor.airfoil.c81 import C81Block, C81Deck
from rotor.airfoil.section_table import SectionTable, table_from_deck
from rotor.airfoil.stall_onset import stall_onset
from rotor.support.arrays import Array
from rotor.support.assets import asset_path, csv_rows
from rotor.support.chart import Axis, Chart, Line, Points
from rotor.validation.airloads import columns
from rotor.validation.trust import TrustSet, description

SET = "glasgow-loops"
MACH = 0.119
RUNS = ("14051", "14061")
NAMES = ("C_n", "C_m")
_AZIMUTHS = 192
_ENDS = ((90.0, 0.0, 1.29, -0.32), (180.0, 0.0, 1.8, 0.0))
"""Where the table has no measurement, as it continues: α [°], C_l, C_d, C_m. Far from all angles compared."""


@dataclass(frozen=True, eq=False)
class StallLoop:
    """C_n and C_m at the measured points of one run."""

    run: str
    alpha: Array
    """[rad], in the order of time, (points,) as all others."""
    measured: Array
    """C_n and C_m, (2, points)."""
    static: Array
    """The section's static data there."""
    dynamic: Array
    """Loops with dynamic stall."""

    @property
    def motion(self) -> str:
        """The motion of the section in words: amplitude and mean angle."""
        low, high = np.degrees([self.alpha.min(), self.alpha.max()])
        return f"by {0.5 * (high - low):.0f}° about {0.5 * (high + low):.0f}°"

    def rms(self, computed: Array) -> tuple[float, float]:
        """Root mean square of the differences in C_n and C_m."""
        apart = np.sqrt(np.mean((computed - self.measured) ** 2, axis=1))
        return float(apart[0]), float(apart[1])


def glasgow_section() -> SectionTable:
    """The static data of the model, symmetric."""
    rows = [
        row
        for row in csv_rows(asset_path("measured/glasgow_dynamic_stall.csv"))
        if row["run"] == "static"
    ]
    upper = np.concatenate([np.stack(columns(rows, "alpha_deg", "cl", "cd", "cm"), axis=1), _ENDS])
    whole = np.concatenate([upper[:0:-1] * [-1.0, -1.0, 1.0, -1.0], upper])
    mach = np.array([0.0, 1.0])
    blocks = (
        C81Block(mach, whole[:, 0], np.repeat(whole[:, k : k + 1], 2, axis=1)) for k in (1, 2, 3)
    )
    return table_from_deck(
        "glasgow-5", "University of Glasgow, model 5", C81Deck("glasgow-5", *blocks)
    )


def stall_loop(run: str) -> StallLoop:
    """A run beside the computed one."""
    rows = [
        row
        for row in csv_rows(asset_path("measured/glasgow_dynamic_stall.csv"))
        if row["run"] == run
    ]
    alpha, cl, cd, cm = columns(rows, "alpha_deg", "cl", "cd", "cm")
    mean, amplitude, k = (float(rows[0][name]) for name in ("mean_deg", "amplitude_deg", "k"))
    rises = np.append(np.diff(alpha) > 0.0, True)
    share = np.arcsin(np.clip((alpha - mean) / amplitude, -1.0, 1.0))
    phase = np.where(rises, share, math.pi - share) % (2.0 * math.pi)
    alpha = np.radians(alpha)
    static, dynamic = pitching(
        glasgow_section(), MACH, math.radians(mean), math.radians(amplitude), k
    )
    ends = np.linspace(0.0, 2.0 * math.pi, _AZIMUTHS + 1)

    def at_points(around: Array) -> Array:
        return np.stack([np.interp(phase, ends, np.append(values, values[0])) for values in around])

    measured = np.stack([cl * np.cos(alpha) + cd * np.sin(alpha), cm])
    return StallLoop(run, alpha, measured, at_points(static), at_points(dynamic))


def pitching(
    table: SectionTable, mach: float, mean: float, amplitude: float, k: float
) -> tuple[Array, Array]:
    """Static C_n and C_m at α = mean + amplitude sin ωt about the quarter chord, and those in unsteady flow, (2, 192).

    Angles in radians; k = ωb/U. The aerofoil sheds its wake into even air: the flow at three quarters of its chord is
    C(k) (1 + ik) times the pitch, C being Theodorsen's function. A turn of the kernel is a period: at V = 1 its half
    chord is k.
    """
    phase = 2.0 * math.pi * np.arange(_AZIMUTHS) / _AZIMUTHS
    alpha, q = mean + amplitude * np.sin(phase), k * amplitude * np.cos(phase)
    turning = -k * k * amplitude * np.sin(phase)
    lag = complex(theodorsen(np.array([k]))[0])
    seen = mean + amplitude * np.imag(lag * (1.0 + 1j * k) * np.exp(1j * phase))
    onset = stall_onset(table)
    section, weight, half_chord = np.zeros((1, 2), np.int64), np.zeros(1), np.full(1, k)
    own = {
        "numbers": onset.numbers[None].copy(),
        "tables": onset.tables[None].copy(),
        "half_chord": half_chord,
    }
    data = StallData(**own, section=section, weight=weight, tip_mach=mach)
    added, shown = np.empty((3, _AZIMUTHS)), np.empty((4, _AZIMUTHS))
    x = seen - float(table.zero_lift_alpha(mach))
    stall_states(
        0, x, np.full(_AZIMUTHS, mach), data, False, added, empty_lags(0, _AZIMUTHS), shown
    )
    mass = math.pi * (q + 0.5 * turning)
    moment = -0.25 * (mass + math.pi * q + 0.25 * math.pi * turning)
    dynamic = _static(table, seen, mach) + np.stack(
        [added[ADDED_N] + mass, added[ADDED_M] + moment]
    )
    return _static(table, alpha, mach), dynamic


def _static(table: SectionTable, alpha: Array, mach: float) -> Array:
    """C_n and C_m of the section data, (2, …)."""
    forces, moment = table(alpha, mach), table.moment(alpha, mach)
    assert moment is not None
    return np.stack([forces.cl * np.cos(alpha) + forces.cd * np.sin(alpha), moment])


def loops_set() -> TrustSet:
    """For the trust page: rms of C_n and C_m beside that of static data, and the loops."""
    words = description(SET)
    loops = [stall_loop(run) for run in RUNS]
    rows_of = {
        name: [
            words.row(
                f"{words.title}: {name}, {loop.motion}",
                f"rms {dynamic:.3f}, of static data {static:.3f}",
                dynamic,
                0.005,
                note=words.notes.get(name, ""),
            )
            for loop in loops
            for dynamic, static in [(loop.rms(loop.dynamic)[k], loop.rms(loop.static)[k])]
        ]
        for k, name in enumerate(NAMES)
    }
    error = "; ".join(
        f"{name} rms {', '.join(f'{row.error:.2f}' for row in rows)}"
        for name, rows in rows_of.items()
    )
    charts = (_chart(loop, k) for loop in loops for k in range(len(NAMES)))
    return words.page(error, (row for rows in rows_of.values() for row in rows), charts)


def _chart(loop: StallLoop, k: int) -> Chart:
    """Measured, static and with dynamic stall over the angle of attack."""
    parts = np.degrees(loop.alpha), loop.static[k], loop.dynamic[k]
    alpha, static, dynamic = (np.append(part, part[0]) for part in parts)  # Closed loops.
    series = (
        Points("measured", alpha[:-1], loop.measured[k]),
        Line("dynamic stall", alpha, dynamic, 1),
        Line("static data", alpha, static, 2),
    )
    return Chart(
        f"{NAMES[k]}, pitching {loop.motion}", Axis("angle of attack [°]"), Axis(NAMES[k]), series
    )

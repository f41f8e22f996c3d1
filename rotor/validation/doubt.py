"""Whether measured powers lie within the bands of `rotor.trim.doubt`, and the sizes of the model's errors behind them.

The errors of induced and of profile power are fitted to measured powers: their sizes are those under which the errors
seen are most likely. The points of a rotor share an error, so together they count as one.
`python -m tests.tools.bands` fits them again.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.optimize import minimize

from rotor.design.uncertain import UNCERTAIN
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.chart import Axis, Chart, Points
from rotor.trim.doubt import doubt, known_power
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation.assumed import assumed_table
from rotor.validation.compare import SETS, at_zero, design_at, load_set
from rotor.validation.flown import measured_powers
from rotor.validation.trust import LEFT_OUT, TrustRow, TrustSet, description

NAME, HOVER = "doubt", "hover"
ROTORS = {
    "uh60a": "UH-60A",
    "xv15": "XV-15",
    "knight-hefner": "Knight and Hefner",
    "castles-gray": "Castles and Gray",
    "gazelle": "SA349/2 Gazelle",
    "bo105": "Bo 105",
    "pca2": "PCA-2",
}
"""Titles, by the name with which the names of the shipped rotors of a test begin."""
QUANTITIES = ("cp", "cq_over_sigma", "cq_above_zero", "cp_drag")
"""Measured quantities that are powers."""
LEAST_LIFT = 0.03
"""Least C_T/σ where torque was measured above a zero that drifted: below it, that torque is small."""
MODEL = ("induced_power_percent", "profile_power_percent")
"""Uncertain inputs whose sizes are fitted."""
COVERAGES = {50: 0.6745, 68: 1.0, 90: 1.6449}
"""Part of the points that belongs within so many bands [%], of a normal distribution."""


@dataclass(frozen=True)
class PointAndBand:
    """One measured power beside the computed one with its band; all in parts of the computed power."""

    rotor: str
    """Of `ROTORS`."""
    kind: str
    """`hover` or `forward flight`."""
    error: float
    """Measured less computed [-]."""
    induced: float
    profile: float
    rest: float
    """Band of all inputs but `MODEL`."""

    def over_band(self, sizes: Sequence[float]) -> float:
        """Error over band, with the sizes of `MODEL` as fractions."""
        return self.error / math.hypot(sizes[0] * self.induced, sizes[1] * self.profile, self.rest)


@cache
def points_and_bands() -> tuple[PointAndBand, ...]:
    """All measured powers at which our rotor trims."""
    return (*_of_sets(), *_flown())


def _of_sets() -> Iterator[PointAndBand]:
    for measured in map(load_set, SETS):
        if measured.quantity not in QUANTITIES:
            continue
        for point in measured.points:
            solution, above_zero = (
                solve(design := design_at(measured, point)),
                measured.quantity == "cq_above_zero",
            )
            if not solution.converged or (
                above_zero and solution.ct < LEAST_LIFT * design.rotor.solidity
            ):
                continue
            unit = design.power_unit * (
                design.rotor.solidity if measured.quantity == "cq_over_sigma" else 1.0
            )
            power = point[measured.quantity] * unit + (
                at_zero(design).power.main_rotor if above_zero else 0.0
            )
            yield _point(
                measured.rotor, HOVER if design.hovering else "forward flight", solution, power
            )


def _flown() -> Iterator[PointAndBand]:
    for power in measured_powers():
        design = make_design(
            rotor=power.rotor, mu=power.mu, mass_kg=power.mass, altitude_m=power.altitude
        )
        # Without the rotor file's own sizes: that of the Bo 105's drag area follows from these powers, which would then
        # count twice.
        solution = solve(replace(design, aircraft=replace(design.aircraft, doubt=())))
        if solution.converged:
            yield _point(power.rotor, "forward flight", solution, power.power)


def _point(rotor: str, kind: str, solution: Solution, measured: float) -> PointAndBand:
    """A power at the main rotor's shaft, or of a free rotor drag times speed; the band is without the tail rotor's."""
    computed = known_power(solution) - solution.power.tail
    rows = [row for row in doubt(solution).rows if row.name not in {*MODEL, "tail_rotor_percent"}]
    rest = math.hypot(*(row.power for row in rows)) / known_power(solution)
    name = next(name for name in ROTORS if rotor.startswith(name))
    power = solution.power
    return PointAndBand(
        name,
        kind,
        measured / computed - 1.0,
        power.induced / computed,
        power.profile / computed,
        rest,
    )


def fitted(points: Iterable[PointAndBand]) -> tuple[float, float]:
    """The sizes of `MODEL`, as fractions, under which the errors are most likely; each rotor counts once."""
    by_rotor: dict[str, list[PointAndBand]] = {}
    for point in points:
        by_rotor.setdefault(point.rotor, []).append(point)

    def unlikely(logs: Array) -> float:
        """−ln of the likelihood, but for a constant."""
        sizes = tuple(np.exp(logs).tolist())
        each = (
            np.mean(
                [
                    0.5 * (z := point.over_band(sizes)) ** 2 + math.log(abs(point.error / z))
                    for point in mine
                ]
            )
            for mine in by_rotor.values()
        )
        return float(sum(each))

    first, second = np.exp(minimize(unlikely, np.log([0.1, 0.2]), method="Nelder-Mead").x).tolist()
    return first, second


def shipped_sizes() -> tuple[float, float]:
    """The sizes of `MODEL` in `assets/doubt.toml`, as fractions."""
    first, second = (0.01 * row.size for name in MODEL for row in UNCERTAIN if row.name == name)
    return first, second


def left_out_sizes(points: Sequence[PointAndBand]) -> dict[str, tuple[float, float]]:
    """By rotor the sizes that all others give."""
    return {name: fitted(point for point in points if point.rotor != name) for name in ROTORS}


def coverage(points: Iterable[tuple[PointAndBand, Sequence[float]]]) -> tuple[float, ...]:
    """Part of the points within the bands of `COVERAGES`, the mean over rotors; each point with the sizes it has."""
    by_rotor: dict[str, list[float]] = {}
    for point, sizes in points:
        by_rotor.setdefault(point.rotor, []).append(abs(point.over_band(sizes)))
    return tuple(
        float(np.mean([np.mean([one <= bands for one in mine]) for mine in by_rotor.values()]))
        for bands in COVERAGES.values()
    )


def doubt_set() -> TrustSet:
    """The set of the trust page: measured powers and the bands of the computed ones.

    Each rotor is judged by sizes of `MODEL` that are fitted to the other rotors.
    """
    words, points, sizes = description(NAME), points_and_bands(), shipped_sizes()
    left = left_out_sizes(points)
    judged = [(point, left[point.rotor]) for point in points]
    rows: list[TrustRow] = []
    series: list[Points] = []
    for rotor, kind in dict.fromkeys((point.rotor, point.kind) for point in points):
        mine = [pair for pair in judged if (pair[0].rotor, pair[0].kind) == (rotor, kind)]
        over = [point.over_band(of_others) for point, of_others in mine]
        name = f"{ROTORS[rotor]}, {kind}"
        series.append(Points("", over, [len(rows)] * len(mine), 1))
        inside = sum(abs(ratio) <= 1.0 for ratio in over) / len(mine)
        note = words.notes.get(name, "")
        rows.append(words.row(name, _shown(mine, over), inside, 0.1, note=note))
    along = Axis("(measured − computed)/band")
    chart = Chart(
        "Error over band", along, Axis(names=tuple(row.what for row in rows)), tuple(series)
    )
    means = {
        "Mean over rotors, hover": [pair for pair in judged if pair[0].kind == HOVER],
        "Mean over rotors, forward flight": [pair for pair in judged if pair[0].kind != HOVER],
        LEFT_OUT: judged,
        "Mean over rotors, all of them in the fit": [(point, sizes) for point in points],
    }
    for name, mine in means.items():
        held = coverage(mine)
        shown = f"{_percent(held)} in the bands of 50, 68 and 90 %"
        rows.append(words.row(name, shown, held[1], 0.05))
    (low_i, low_0), (high_i, high_0) = (
        end(list(left.values()), axis=0) for end in (np.min, np.max)
    )
    text = words.text[0].format(
        induced=f"{100 * sizes[0]:g}", profile=f"{100 * sizes[1]:g}", rotors=len(left),
        others=f"{100 * low_i:.0f} to {100 * high_i:.0f} % and {100 * low_0:.0f} to {100 * high_0:.0f} %",
    )  # fmt: skip
    error = next(row.shown for row in rows if row.what == LEFT_OUT)
    return words.page(error, rows, (chart,), text=(text, *words.text[1:], assumed_table()))


def _shown(points: Sequence[tuple[PointAndBand, Sequence[float]]], over: Sequence[float]) -> str:
    """The mean error of some powers, how many lie within their band, and the mean band; over: errors over bands."""
    errors = [1.0 / (1.0 + point.error) - 1.0 for point, _ in points]
    bands = [abs(point.error / ratio) for (point, _), ratio in zip(points, over, strict=True)]
    inside = sum(abs(ratio) <= 1.0 for ratio in over)
    return (
        f"{100 * np.mean(errors):+.0f} % on average, {inside} of {len(points)} within "
        f"± {100 * np.mean(bands):.0f} % ({_percent(coverage(points))})"
    )


def _percent(shares: Iterable[float]) -> str:
    return f"{', '.join(f'{100 * share:.0f}' for share in shares)} %"

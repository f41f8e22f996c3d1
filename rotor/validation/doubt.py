"""Whether measured powers lie within the bands of `rotor.trim.doubt`: for the trust page, good or bad."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from rotor.chart import Axis, Chart, Points
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.doubt import doubt
from rotor.trim.solve import solve
from rotor.validation.compare import design_at, load_set
from rotor.validation.flown import TITLES, measured_powers
from rotor.validation.trust import TrustRow, TrustSet, description

NAME = "doubt"
QUANTITIES: dict[str, Callable[[Design], float]] = {
    "cp": lambda design: 1.0,
    "cq_over_sigma": lambda design: design.rotor.solidity,
}
"""What shaft power over ρA(ΩR)³ is, by quantity of a set: σ times C_Q/σ."""
POWERS = ("xv15-hover", "xv15-forward-15deg", "xv15-forward-0deg", "uh60a-hover")
"""Sets of absolute shaft powers. The free rotor of `pca2` takes none."""


@dataclass(frozen=True)
class HeldPoint:
    """One measured power beside ours with its band."""

    name: str
    """Name of the set, or the helicopter."""
    error: float
    """Measured over ours, less 1."""
    band: float
    """Over our power."""

    @property
    def inside(self) -> bool:
        return abs(self.error) <= self.band


def held_points() -> Iterator[HeldPoint]:
    """All measured powers at which our rotor trims."""
    for name in POWERS:
        measured = load_set(name)
        for point in measured.points:
            design = design_at(measured, point)
            coefficient = point[measured.quantity] * QUANTITIES[measured.quantity](design)
            yield from _held(measured.title, design, coefficient * design.power_unit)
    for power in measured_powers():
        design = make_design(rotor=power.rotor, mu=power.mu, mass_kg=power.mass, altitude_m=power.altitude)
        yield from _held(TITLES[power.rotor], design, power.power)


def _held(name: str, design: Design, measured: float) -> Iterator[HeldPoint]:
    """Doubt of the power at the main rotor's shaft beside a measurement, without that of the tail rotor."""
    solution = solve(design)
    if not solution.converged:
        return
    rows = [row.power for row in doubt(solution).rows if row.name != "tail_rotor_percent"]
    yield HeldPoint(name, measured / solution.power.main_rotor - 1.0, math.hypot(*rows) / solution.power.total)


def doubt_set() -> TrustSet:
    """For the trust page."""
    words, held = description(NAME), list(held_points())
    by_name = {name: [point for point in held if point.name == name] for name in dict.fromkeys(p.name for p in held)}
    heads = ("Set", "Points", "Inside", "Mean band [%]", "Mean error [%]", "Worst error [%]")
    rows: list[TrustRow] = []
    series: list[Points] = []
    cells: list[tuple[str, ...]] = [heads]
    for k, (name, points) in enumerate(by_name.items()):
        count, inside = len(points), sum(point.inside for point in points)
        rows.append(words.row(name, f"{inside} of {count}", inside / count, 0.1, note=words.notes.get(name, "")))
        series.append(Points("", [point.error / point.band for point in points], [k] * count, 1))
        errors = [point.error for point in points]
        band, mean = sum(point.band for point in points) / count, sum(errors) / count
        parts = f"{100 * band:.1f}", f"{100 * mean:+.1f}", f"{100 * max(errors, key=abs):+.1f}"
        cells.append((name, f"{count}", f"{inside}", *parts))
    error = f"{sum(point.inside for point in held)} of {len(held)} inside"
    chart = Chart("Error over band", Axis("(measured − ours)/band"), Axis(names=tuple(by_name)), tuple(series))
    return words.page(error, rows, (chart,), points=cells)

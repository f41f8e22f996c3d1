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
from rotor.validation.trust import TrustRow, TrustSet

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
    held = list(held_points())
    by_name = {name: [point for point in held if point.name == name] for name in dict.fromkeys(p.name for p in held)}
    rows = tuple(_row(name, points) for name, points in by_name.items())
    names = tuple(by_name)
    series = tuple(
        Points("", tuple(p.error / p.band for p in points), (float(k),) * len(points), 1)
        for k, points in enumerate(by_name.values())
    )
    inside = sum(point.inside for point in held)
    return TrustSet(
        name=NAME,
        title="Measured powers within the bands",
        compared="Shaft powers within the band of ours",
        error=f"{inside} of {len(held)} inside",
        source="the sets of measured powers above; sizes and sources of what is uncertain: assets/doubt.toml",
        rows=rows,
        charts=(Chart("Error over band", Axis("(measured − ours)/band"), Axis(names=names), series),),
        text=(
            "A band holds what the inputs leave open, not what the models leave out, nor the scatter of the "
            "measurement. It is not widened where it misses: a cause is named, or it stays as it is.",
        ),
        points=(
            ("Set", "Points", "Inside", "Mean band", "Mean error", "Worst error"),
            *(
                (
                    name, f"{len(points)}", f"{sum(p.inside for p in points)}",
                    f"{100 * sum(p.band for p in points) / len(points):.1f} %",
                    f"{100 * sum(p.error for p in points) / len(points):+.1f} %",
                    f"{100 * max((p.error for p in points), key=abs):+.1f} %",
                )
                for name, points in by_name.items()
            ),
        ),
    )  # fmt: skip


_NOTES = {
    "Bo 105": "Mass, attitude and what the figure's power holds are not stated: 25 % low at 99 kt.",
}


def _row(name: str, points: list[HeldPoint]) -> TrustRow:
    inside = sum(point.inside for point in points)
    return TrustRow(
        NAME, "validation", name, "measurement", f"{inside} of {len(points)}",
        inside / len(points), 0.1, "rotor/validation/test_doubt_set.py::test_the_shares_are_those_shipped",
        _NOTES.get(name, ""),
    )  # fmt: skip

"""Whether measured powers lie within the bands of `rotor.trim.doubt`: for the trust page, good or bad."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from rotor.files.make_design import make_design
from rotor.support.chart import Axis, Chart, Points
from rotor.trim.doubt import doubt
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation.compare import MeasuredSet, at_zero, design_at, load_set
from rotor.validation.flown import TITLES, measured_powers
from rotor.validation.trust import TrustRow, TrustSet, description

NAME = "doubt"
POWERS = {
    "hover": (
        "uh60a-hover", "knight-hefner-3", "knight-hefner-4", "castles-gray-hover", "castles-gray-4ft",
        "castles-gray-tapered", "castles-gray", "castles-gray-twisted",
    ),
    "XV-15 hover": ("xv15-hover",),
    "XV-15 tunnel": ("xv15-forward-15deg", "xv15-forward-0deg"),
}  # fmt: skip
"""Sets of shaft powers by kind of flight. The free rotor of `pca2` takes none."""
FLOWN = {"gazelle": "level flight", "bo105": "Bo 105, mass assumed"}
"""Kind of the powers measured in flight, by rotor."""


@dataclass(frozen=True)
class PointAndBand:
    """One measured power beside the computed one with its band."""

    name: str
    """Name of the set, or the helicopter."""
    kind: str
    """Kind of flight: of `POWERS` or `FLOWN`."""
    error: float
    """Measured over computed, less 1 [-]."""
    band: float
    """Over our power."""

    @property
    def inside(self) -> bool:
        return abs(self.error) <= self.band


def points_and_bands() -> Iterator[PointAndBand]:
    """All measured powers at which our rotor trims, in order of kind."""
    for kind, names in POWERS.items():
        for measured in map(load_set, names):
            points = [point for point in measured.points if measured.counts(point) or not measured.indicative]
            yield from (held for point in points for held in _held_of(measured, point, kind))
        if kind == "hover":
            yield from _flown()


def _flown() -> Iterator[PointAndBand]:
    for power in measured_powers():
        solution = solve(make_design(rotor=power.rotor, mu=power.mu, mass_kg=power.mass, altitude_m=power.altitude))
        if solution.converged:
            yield _point_and_band(TITLES[power.rotor], FLOWN[power.rotor], solution, power.power)


def _held_of(measured: MeasuredSet, point: dict[str, float], kind: str) -> Iterator[PointAndBand]:
    """One point of a set; none where our rotor does not trim."""
    solution = solve(design_at(measured, point))
    if solution.converged:
        design, above_zero = solution.design, measured.quantity == "cq_above_zero"
        part = design.rotor.solidity if measured.quantity == "cq_over_sigma" else 1.0
        power = point[measured.quantity] * part * design.power_unit
        yield _point_and_band(measured.title, kind, solution, power, at_zero(design) if above_zero else None)


def _point_and_band(
    name: str, kind: str, solution: Solution, measured: float, zero: Solution | None = None
) -> PointAndBand:
    """A power at the main rotor's shaft, or what it is above that without thrust, beside a measurement.

    The band is that of the same power or difference, without that of the tail rotor.
    """
    computed, total = solution.power.main_rotor, solution.power.total
    if zero is not None:
        computed, total = computed - zero.power.main_rotor, total - zero.power.total
    rows = [row for row in doubt(solution, zero).rows if row.name != "tail_rotor_percent"]
    band = math.hypot(*(row.power if row.change is None else row.change for row in rows))
    return PointAndBand(name, kind, measured / computed - 1.0, band / abs(total))


def doubt_set() -> TrustSet:
    """For the trust page."""
    words, held = description(NAME), list(points_and_bands())
    by_name = {name: [point for point in held if point.name == name] for name in dict.fromkeys(p.name for p in held)}
    heads = ("Set", "Kind of flight", "Points", "Inside", "Mean band [%]", "Mean error [%]", "Worst error [%]")
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
        cells.append((name, points[0].kind, f"{count}", f"{inside}", *parts))
    chart = Chart("Error over band", Axis("(measured − computed)/band"), Axis(names=tuple(by_name)), tuple(series))
    text = (paragraph.format(counted=count_by_kind(held)) for paragraph in words.text)
    return words.page(count_by_kind(held), rows, (chart,), text=text, points=cells)


def count_by_kind(held: Iterable[PointAndBand]) -> str:
    """Points inside their band, by kind of flight: many of one rotor in hover do not stand for the rest."""
    kinds: dict[str, list[bool]] = {}
    for point in held:
        kinds.setdefault(point.kind, []).append(point.inside)
    each = (f"{kind} {sum(inside)} of {len(inside)}" for kind, inside in kinds.items())
    return f"inside the band: {'; '.join(each)}"

"""Sets of measured points: one file a set in `assets/measured/`, with report, rotor, trim and scatter."""

import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, cast

from rotor.assets import asset_path

SETS = (
    "xv15-hover",
    "xv15-forward-15deg",
    "xv15-forward-0deg",
    "xv15-forward-figure-18",
    "pca2",
    "knight-hefner-3",
    "knight-hefner-4",
    "castles-gray",
    "castles-gray-twisted",
    "castles-gray-twist-effect",
    "uh60a-hover",
)
"""Names of the sets, in the order in which they are shown."""


FIELDS = ("2mrts-inflow", "hart2-airloads", "gazelle-airloads", "flown-power")
"""Names of the sets that are not single points with a scatter: `rotor.validation.inflow` and `airloads`."""


@dataclass(frozen=True)
class MeasuredSet:
    """The points of one test."""

    name: str
    title: str
    report: str
    rotor: str
    """Name of a shipped rotor."""
    kind: Literal["hover", "forward"]
    trim: str
    given: tuple[str, ...]
    """Columns that the trim is given; the others are measured."""
    quantity: str
    """The column that is compared."""
    points: tuple[dict[str, float], ...]
    scatter: float | None
    """Of the quantity; None where it is a part of it."""
    scatter_percent: float | None
    judged: dict[str, tuple[float, float]]
    """Ranges of columns within which a target is set."""
    tolerance: float | None
    """Largest difference of a judged point; None where it is a part of the measured value, or there is no target."""
    tolerance_percent: float | None
    indicative: bool
    """Whether the set is shown without a target."""
    against: str | None
    """Rotor from which a change is counted."""
    note: str
    missed: str
    """Why the target is missed, as far as it is known."""

    def scatter_of(self, measured: float) -> float:
        """Scatter of a measured value."""
        return self.scatter if self.scatter is not None else abs(measured) * (self.scatter_percent or 0.0) / 100.0

    def is_judged(self, point: dict[str, float]) -> bool:
        """Whether a target is set for a point."""
        inside = all(low - 1e-12 <= point[name] <= high + 1e-12 for name, (low, high) in self.judged.items())
        return inside and not self.indicative

    def allows(self, measured: float, ours: float) -> bool:
        """Whether our value is within the target."""
        largest = self.tolerance
        if largest is None:
            largest = abs(measured) * (self.tolerance_percent or 0.0) / 100.0
        return abs(ours - measured) <= largest

    @property
    def varied(self) -> tuple[str, ...]:
        """The given columns that are not the same everywhere; the first is that of charts."""
        return tuple(name for name in self.given if len({point[name] for point in self.points}) > 1)

    @property
    def target(self) -> str:
        """The target in words; empty where there is none."""
        if self.indicative:
            return ""
        size = f"{self.tolerance:g}" if self.tolerance is not None else f"{self.tolerance_percent:g} %"
        ranges = [f"{name} {low:g}…{high:g}" for name, (low, high) in self.judged.items()]
        return f"{size} {'for ' + ', '.join(ranges) if ranges else 'everywhere'}"


def sets_of(rotor: str) -> tuple["MeasuredSet", ...]:
    """The sets of a shipped rotor by its name, for example `xv15`; none for a rotor that was not measured."""
    return tuple(one for one in map(load_set, SETS) if one.rotor == rotor)


@cache
def load_set(name: str) -> MeasuredSet:
    """The set of that name; ValueError with one sentence for any other."""
    if name not in SETS:
        raise ValueError(f"set {name!r} is not known: use one of {', '.join(SETS)}")
    record: dict[str, Any] = tomllib.loads(asset_path(f"measured/{name}.toml").read_text(encoding="utf-8"))
    columns = cast(dict[str, list[float]], record["points"])
    points = tuple(
        dict(zip(columns, map(float, values), strict=True)) for values in zip(*columns.values(), strict=True)
    )
    return MeasuredSet(
        name=name,
        title=record["title"],
        report=record["report"],
        rotor=record["rotor"],
        kind=record["kind"],
        trim=record["trim"],
        given=tuple(record["given"]),
        quantity=record["quantity"],
        points=points,
        scatter=record.get("scatter"),
        scatter_percent=record.get("scatter_percent"),
        judged={key: (low, high) for key, (low, high) in record.get("judged", {}).items()},
        tolerance=record.get("tolerance"),
        tolerance_percent=record.get("tolerance_percent"),
        indicative=record.get("indicative", False),
        against=record.get("against"),
        note=record.get("note", ""),
        missed=record.get("missed", ""),
    )

"""The inputs of a rotor that are uncertain, and by how much: `assets/doubt.toml`, or what a rotor file states.

What they do to power: `rotor.trim.doubt`.
"""

from dataclasses import dataclass, replace

from rotor.design.design import Design
from rotor.support.assets import toml_asset


@dataclass(frozen=True)
class Uncertain:
    """An input that is known only within limits."""

    name: str
    """Name in `assets/doubt.toml` and rotor files; ends in `_percent` where the size is a share of the input."""
    words: str
    size: float
    """Uncertainty to either side, in `unit`."""
    source: str

    @property
    def unit(self) -> str:
        return "%" if self.name.endswith("_percent") else ""

    @property
    def largest(self) -> float:
        """The largest size that a rotor file may state, in `unit`."""
        return max(90.0 if self.unit else 0.1, self.size)


UNCERTAIN = tuple(Uncertain(name, **row) for name, row in toml_asset("doubt.toml").items())
"""Uncertain inputs of `assets/doubt.toml`, in its order."""


def uncertain_inputs(design: Design) -> tuple[Uncertain, ...]:
    """The uncertain inputs of a design, with the sizes that its rotor file states."""
    given = dict(design.aircraft.doubt)
    band, area = design.fuselage.drag_area_band, design.fuselage.drag_area
    if band is not None and area:
        given.setdefault("drag_area_percent", 50.0 * (band[1] - band[0]) / area)
    return tuple(
        replace(row, size=given[row.name], source="rotor file") if row.name in given else row
        for row in UNCERTAIN
    )

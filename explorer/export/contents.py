"""The content of a report: the designs of a session, their reference, their actuator, colours and fields."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property

import numpy as np

from explorer.charts.plots import Range
from explorer.colours import BASELINE
from explorer.model.inputs import ViewState
from explorer.model.units import Units, units_of
from explorer.picture.fields import FIELDS, Field, fitted_range
from explorer.picture.picture import field_values
from explorer.text.readout import mass_parts, needs_words
from explorer.views.actuated import ActuatedBlade, against_words
from rotor import Design, Solution, doubt
from rotor.actuator import Verdict
from rotor.trim.doubt import Doubt

COLOURS = ("#1c7ed6", "#e8590c", "#0ca678", "#9c36b5", "#c99700", "#c2255c", "#0b7285", "#5f3dc4")
"""Colours of the designs in charts and badges, in turn."""
FIELDS_SHOWN = 4
_USUAL = ("Angle of attack", "Induced inflow λi", "Thrust dT/dr", "Power dP/dr")


@dataclass(frozen=True, eq=False)
class ReportEntry:
    title: str
    """The name that the user knows, for example Now."""
    solution: Solution
    """Converged."""


@dataclass(frozen=True, eq=False)
class DesignReport:
    """The content of a report; ValueError where there is no design, or where one did not converge."""

    reference: ReportEntry
    """The reference of all changes: the pinned design, or the baseline twist."""
    entries: Sequence[ReportEntry]
    """The designs, the present one first; the reference is not among them."""
    view: ViewState
    ranges: Mapping[str, Range] = field(default_factory=dict)
    """Colour range by title of the field, where the page has another."""
    own_section: bool = False
    """Whether the reference is the user's own design, which is shown like the others."""
    actuator: Verdict | str = ""
    """The verdict on the actuator chosen for the first design, or why there is none; empty where none was chosen."""
    driven: ActuatedBlade | None = None
    """The actuator on board of the first design."""
    line: str = ""
    """That of the page; empty: as the first design says it."""
    when: datetime = field(default_factory=lambda: datetime.now().astimezone())

    def __post_init__(self) -> None:
        if not self.entries:
            raise ValueError("There is no design to report on: wait for the first solution.")
        for entry in self.all:
            if not entry.solution.converged:
                raise ValueError(
                    f"{entry.title} is not trimmed, so it cannot be reported: {entry.solution.message}"
                )

    @property
    def units(self) -> Units:
        """Units of power, speed and weight."""
        return units_of(self.view.units, self.entries[0].solution.design.aircraft)

    def colour_range(self, shown: Field) -> Range:
        """The colour range of a field, the same for all designs."""
        return self.ranges.get(shown.title) or self._fitted.get(
            shown.title, (shown.low, shown.high)
        )

    @cached_property
    def _fitted(self) -> dict[str, Range]:
        """Colour ranges that cover all entries, so that their pictures can be compared."""
        shown = [FIELDS[name] for name in _USUAL if not FIELDS[name].void_in_reverse_flow]
        values = [
            [field_values(entry.solution, one).ravel() for entry in self.entries] for one in shown
        ]
        return {
            one.title: fitted_range(one, np.concatenate(each))
            for one, each in zip(shown, values, strict=True)
        }

    def comparable(self, entry: ReportEntry) -> bool:
        """Whether it has the reference's flight condition, so that the blade explains a difference of power."""
        return entry.solution.design.bare.condition == self.reference.solution.design.bare.condition

    def band(self, entry: ReportEntry) -> Doubt:
        """How sure power is, and its change from the reference."""
        solution, other = entry.solution, self.reference.solution
        if solution.design not in self._bands:
            free = "free-rotor" in {one.design.models.trim for one in (solution, other)}
            compared = self.comparable(entry) and not self.is_reference(entry) and not free
            self._bands[solution.design] = doubt(solution, other if compared else None)
        return self._bands[solution.design]

    @cached_property
    def _bands(self) -> dict[Design, Doubt]:
        return {}

    def is_reference(self, entry: ReportEntry) -> bool:
        """Whether it is the reference, or the same design, so that there is nothing to compare."""
        return entry.solution.design == self.reference.solution.design

    @property
    def all(self) -> tuple[ReportEntry, ...]:
        """All designs, the reference last where it is none of them."""
        return (
            *self.entries,
            *([] if any(map(self.is_reference, self.entries)) else [self.reference]),
        )

    @property
    def shown(self) -> tuple[ReportEntry, ...]:
        """The designs with a section and a 3D scene: the first of `all`."""
        return self.all if self.own_section else tuple(self.entries)


def on_board(driven: ActuatedBlade, units: Units) -> tuple[str, str, str]:
    """The change of power here by the actuator on board, as the page says it; what it counts from; and its
    `change_kind`, empty for a gain that nothing within its limits makes."""
    mass, here = mass_parts(driven.installed)["in all"], driven.here
    if here is None:
        return "", f"with {mass} on board", ""
    against = (
        f"with {mass} on board, compared with the {against_words(driven, driven.question.against)}"
    )
    words = needs_words(-here.power, here.band, units, driven.sourced)
    return words, against, {"loss": "more", "gain": "less", "": ""}[here.kind]


def colours_of(report: DesignReport) -> list[str]:
    """The colour of each entry; grey for the reference."""
    return [*(COLOURS[k % len(COLOURS)] for k in range(len(report.entries))), BASELINE][
        : len(report.all)
    ]


def fields_of(report: DesignReport) -> list[Field]:
    """The field on the page, then the default ones."""
    names = dict.fromkeys((report.view.field, *_USUAL))
    return [FIELDS[name] for name in list(names)[:FIELDS_SHOWN]]

"""The content of a report: the designs of a session, their reference, their actuator, colours and fields."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime

import numpy as np

from explorer.charts.plots import Range
from explorer.colours import BASELINE
from explorer.model.inputs import ViewState
from explorer.model.units import UNITS, Units
from explorer.picture.fields import FIELDS, Field, fitted_range
from explorer.picture.picture import field_values
from rotor import Solution
from rotor.actuator import Verdict

COLOURS = ("#1c7ed6", "#e8590c", "#0ca678", "#9c36b5", "#c99700", "#c2255c", "#0b7285", "#5f3dc4")
"""Colours of the designs in charts and badges, in turn."""
FIELDS_SHOWN = 4
_USUAL = ("Angle of attack", "Induced inflow λi", "Thrust dT/dr", "Power dP/dr")


@dataclass(frozen=True, eq=False)
class ReportEntry:
    """A design of the report: the name that the user knows, for example Now, and a converged solution."""

    title: str
    solution: Solution


@dataclass(frozen=True, eq=False)
class DesignReport:
    """The content of a report: designs, the present one first, and what all changes are counted from.

    `ranges`: colour range by title of the field, where it is not the default; the same for all designs. `own_section`:
    the reference is the user's own design, which is shown like the others. `actuator`: the verdict on that chosen for
    the first design, or why there is none; empty where none was chosen.
    """

    reference: ReportEntry
    entries: tuple[ReportEntry, ...]
    view: ViewState
    when: datetime
    ranges: Mapping[str, Range] = field(default_factory=dict)
    own_section: bool = False
    actuator: Verdict | str = ""

    @property
    def units(self) -> Units:
        return UNITS[self.view.units]

    def colour_range(self, shown: Field) -> Range:
        """The colour range of a field."""
        return self.ranges.get(shown.title, (shown.low, shown.high))

    def comparable(self, entry: ReportEntry) -> bool:
        """Whether it has the reference's flight condition, so that the blade explains a difference of power."""
        return entry.solution.design.condition == self.reference.solution.design.condition

    @property
    def all(self) -> tuple[ReportEntry, ...]:
        """All designs, the reference last."""
        return (*self.entries, self.reference)

    @property
    def shown(self) -> tuple[ReportEntry, ...]:
        """The designs with a section and a 3D scene: the first of `all`."""
        return self.all if self.own_section else self.entries


def colours_of(report: DesignReport) -> list[str]:
    """The colour of each entry; grey for the reference."""
    return [*(COLOURS[k % len(COLOURS)] for k in range(len(report.entries))), BASELINE]


def fields_of(report: DesignReport) -> list[Field]:
    """The field on the page, then the default ones."""
    names = dict.fromkeys((report.view.field, *_USUAL))
    return [FIELDS[name] for name in list(names)[:FIELDS_SHOWN]]


def report_of(
    reference: ReportEntry,
    entries: Sequence[ReportEntry],
    view: ViewState,
    ranges: Mapping[str, Range] | None = None,
    *,
    own_section: bool = False,
    actuator: Verdict | str = "",
) -> DesignReport:
    """A report of these designs; ValueError where there is none, or where one did not converge."""
    if not entries:
        raise ValueError("There is no design to report on: wait for the first solution.")
    for entry in (*entries, reference):
        if not entry.solution.converged:
            raise ValueError(f"{entry.title} is not trimmed, so it cannot be reported: {entry.solution.message}")
    installed = dict[str, Range]()
    for name in _USUAL:
        if not (shown := FIELDS[name]).void_in_reverse_flow:  # One range for all designs, so that they can be compared.
            values = [field_values(entry.solution, shown).ravel() for entry in entries]
            installed[name] = fitted_range(shown, np.concatenate(values))
    return DesignReport(
        reference=reference,
        entries=tuple(entries),
        view=view,
        when=datetime.now().astimezone(),
        ranges={**installed, **(ranges or {})},
        own_section=own_section,
        actuator=actuator,
    )

"""Every figure and table that can be rebuilt, in the document's order."""

from collections.abc import Callable
from dataclasses import dataclass

from rotor.reproduce import (
    aircraft,
    comparison,
    fits,
    five_twists,
    grids,
    hover_twists,
    keys,
    optimum_twist,
    sections,
    velocities,
)
from rotor.reproduce.report import Report


@dataclass(frozen=True)
class Entry:
    """One figure or table and what makes it."""

    number: str
    make: Callable[[], Report]
    chapter: str
    slow: bool = False
    """Whether it searches for optima: seconds rather than tenths."""


_SECTIONS = "2 Background"
_MODEL = "3.1 Numerical model"
_AIRCRAFT = "3.2 Verification and validation"
_TWIST = "3.3 Effect of blade twist on main-rotor power"
_OPTIMUM = "4 Results"

ENTRIES: tuple[Entry, ...] = (
    Entry("2.3", sections.figure_2_3, _SECTIONS),
    Entry("2.4", sections.figure_2_4, _SECTIONS),
    Entry("2.6", velocities.figure_2_6, _SECTIONS),
    Entry("2.7", velocities.figure_2_7, _SECTIONS),
    Entry("2.8", velocities.figure_2_8, _SECTIONS),
    Entry("3.1", sections.figure_3_1, _MODEL),
    Entry("3.2", sections.figure_3_2, _MODEL),
    Entry("3.3", fits.figure_3_3, _MODEL),
    Entry("3.4", fits.figure_3_4, _MODEL),
    Entry("3.5", fits.figure_3_5, _MODEL),
    Entry("3.6", fits.figure_3_6, _MODEL),
    Entry("3.7", grids.figure_3_7, _MODEL),
    Entry("3.8", grids.figure_3_8, _MODEL),
    Entry("3.9", grids.figure_3_9, _MODEL),
    Entry("table 3.1", aircraft.table_3_1, _AIRCRAFT),
    Entry("table 3.2", aircraft.table_3_2, _AIRCRAFT),
    Entry("tail rotor", aircraft.tail_rotor, _AIRCRAFT),
    Entry("3.10", aircraft.figure_3_10, _AIRCRAFT),
    Entry("3.11", hover_twists.figure_3_11, _TWIST),
    Entry("3.12", five_twists.figure_3_12, _TWIST),
    Entry("3.13", five_twists.figure_3_13, _TWIST),
    Entry("3.14", five_twists.figure_3_14, _TWIST),
    Entry("3.15", five_twists.figure_3_15, _TWIST),
    Entry("keys 1987", keys.keys_1987, _TWIST),
    Entry("4.1", optimum_twist.figure_4_1, _OPTIMUM, slow=True),
    Entry("4.2", optimum_twist.figure_4_2, _OPTIMUM, slow=True),
    Entry("4.3", optimum_twist.figure_4_3, _OPTIMUM, slow=True),
    Entry("4.4", optimum_twist.figure_4_4, _OPTIMUM, slow=True),
    Entry("4.5", optimum_twist.figure_4_5, _OPTIMUM, slow=True),
    Entry("4.6", optimum_twist.figure_4_6, _OPTIMUM, slow=True),
    Entry("4.7", optimum_twist.figure_4_7, _OPTIMUM, slow=True),
    Entry("4.8", optimum_twist.figure_4_8, _OPTIMUM, slow=True),
    Entry("4.9", comparison.figure_4_9, _OPTIMUM),
    Entry("4.10", optimum_twist.figure_4_10, _OPTIMUM, slow=True),
    Entry("4.11", comparison.figure_4_11, _OPTIMUM),
    Entry("4.12", comparison.figure_4_12, _OPTIMUM, slow=True),
    Entry("4.13", comparison.figure_4_13, _OPTIMUM, slow=True),
    Entry("table 4.1", comparison.table_4_1, _OPTIMUM, slow=True),
)


def find_entry(number: str) -> Entry:
    """The entry of that number; ValueError with the numbers there are."""
    for entry in ENTRIES:
        if entry.number.lower() == number.lower():
            return entry
    raise ValueError(f"figure {number!r} cannot be rebuilt: choose one of {', '.join(e.number for e in ENTRIES)}")

"""Every figure and table that can be rebuilt, in the thesis' order."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rotor.reproduce import (
    actuated_blade,
    actuator_sheets,
    aircraft,
    comparison,
    disk_figures,
    literature,
    optimum_twist,
    readings,
    schematics,
    sections,
    today,
    twist_effect,
)
from rotor.reproduce.report import Report
from rotor.reproduce.runs import (
    CONCEPTS,
    EVERY_VARIANT,
    FULL,
    Call,
    best,
    best_fixed,
    choices,
    linear_twin,
    searches,
)


@dataclass(frozen=True)
class CatalogueEntry:
    """One figure or table and the function that makes it."""

    number: str
    make: Callable[[], Report]
    chapter: str
    needs: Callable[[str], Sequence[Call]] | None = None
    """The searches it needs, of one variant."""

    @property
    def slow(self) -> bool:
        """Whether it searches for optima: minutes rather than tenths of a second."""
        return self.needs is not None


def _of(*concepts: str) -> Callable[[str], Sequence[Call]]:
    return lambda name: searches(concepts, name, FULL)


def _all_and_fixed(name: str) -> Sequence[Call]:
    return [*searches(tuple(CONCEPTS), name, FULL), (best_fixed, (name, FULL))]


def _compared(name: str) -> Sequence[Call]:
    return [(actuated_blade.compared, (name,))] if name == "flight" else []


def _beside_data(name: str) -> Sequence[Call]:
    return [(comparison.three_segment_rows, (name, FULL))]


_INTRODUCTION = "1.2 Active blade twist control"
_SECTIONS = "2 Background"
_MODEL = "3.1 Numerical model"
_AIRCRAFT = "3.2 Verification and validation"
_TWIST = "3.3 Effect of blade twist on main-rotor power"
_OPTIMUM = "4 Results"
_CONCEPT = "5 Concept"
_TODAY = "What the thesis would have found"

ENTRIES: tuple[CatalogueEntry, ...] = (
    CatalogueEntry("literature", literature.literature, _INTRODUCTION),
    CatalogueEntry("2.1", schematics.figure_2_1, _SECTIONS),
    CatalogueEntry("2.2", schematics.figure_2_2, _SECTIONS),
    CatalogueEntry("2.3", sections.figure_2_3, _SECTIONS),
    CatalogueEntry("2.4", sections.figure_2_4, _SECTIONS),
    CatalogueEntry("2.5", schematics.figure_2_5, _SECTIONS),
    CatalogueEntry("2.6", disk_figures.figure_2_6, _SECTIONS),
    CatalogueEntry("2.7", disk_figures.figure_2_7, _SECTIONS),
    CatalogueEntry("2.8", disk_figures.figure_2_8, _SECTIONS),
    CatalogueEntry("2.9", schematics.figure_2_9, _SECTIONS),
    CatalogueEntry("3.1", sections.figure_3_1, _MODEL),
    CatalogueEntry("3.2", sections.figure_3_2, _MODEL),
    CatalogueEntry("3.3", sections.figure_3_3, _MODEL),
    CatalogueEntry("3.4", sections.figure_3_4, _MODEL),
    CatalogueEntry("3.5", sections.figure_3_5, _MODEL),
    CatalogueEntry("3.6", sections.figure_3_6, _MODEL),
    CatalogueEntry("3.7", disk_figures.figure_3_7, _MODEL),
    CatalogueEntry("3.8", disk_figures.figure_3_8, _MODEL),
    CatalogueEntry("3.9", disk_figures.figure_3_9, _MODEL),
    CatalogueEntry("table 3.1", aircraft.table_3_1, _AIRCRAFT),
    CatalogueEntry("table 3.2", aircraft.table_3_2, _AIRCRAFT),
    CatalogueEntry("tail rotor", aircraft.tail_rotor, _AIRCRAFT),
    CatalogueEntry("3.10", aircraft.figure_3_10, _AIRCRAFT),
    CatalogueEntry("3.11", twist_effect.figure_3_11, _TWIST),
    CatalogueEntry("3.12", twist_effect.figure_3_12, _TWIST),
    CatalogueEntry("3.13", twist_effect.figure_3_13, _TWIST),
    CatalogueEntry("3.14", twist_effect.figure_3_14, _TWIST),
    CatalogueEntry("3.15", twist_effect.figure_3_15, _TWIST),
    CatalogueEntry("readings", readings.readings, _TWIST, readings.needed),
    CatalogueEntry("keys 1987", twist_effect.keys_1987, _TWIST),
    CatalogueEntry("4.1", optimum_twist.figure_4_1, _OPTIMUM, _of("linear")),
    CatalogueEntry("4.2", optimum_twist.figure_4_2, _OPTIMUM, _of("quadratic")),
    CatalogueEntry("4.3", optimum_twist.figure_4_3, _OPTIMUM, _of("quadratic")),
    CatalogueEntry("4.4", optimum_twist.figure_4_4, _OPTIMUM, _of("two 40-60")),
    CatalogueEntry("4.5", optimum_twist.figure_4_5, _OPTIMUM, _of("two 50-50")),
    CatalogueEntry("4.6", optimum_twist.figure_4_6, _OPTIMUM, _of("two 60-40")),
    CatalogueEntry("4.7", optimum_twist.figure_4_7, _OPTIMUM, _of("two 70-30")),
    CatalogueEntry("4.8", optimum_twist.figure_4_8, _OPTIMUM, _of("two airfoils")),
    CatalogueEntry("4.9", comparison.figure_4_9, _OPTIMUM),
    CatalogueEntry("4.10", optimum_twist.figure_4_10, _OPTIMUM, _of("three")),
    CatalogueEntry("4.11", comparison.figure_4_11, _OPTIMUM),
    CatalogueEntry("4.12", comparison.figure_4_12, _OPTIMUM, _beside_data),
    CatalogueEntry("4.13", comparison.figure_4_13, _OPTIMUM, _of(*CONCEPTS)),
    CatalogueEntry("table 4.1", comparison.table_4_1, _OPTIMUM, _all_and_fixed),
    CatalogueEntry("5.1", schematics.figure_5_1, _CONCEPT),
    CatalogueEntry("5.2", actuator_sheets.figure_5_2, _CONCEPT),
    CatalogueEntry("5.3", actuator_sheets.figure_5_3, _CONCEPT),
    CatalogueEntry("5.4", actuator_sheets.figure_5_4, _CONCEPT),
    CatalogueEntry("5.5", actuator_sheets.figure_5_5, _CONCEPT),
    CatalogueEntry("5.6", actuator_sheets.figure_5_6, _CONCEPT),
    CatalogueEntry("5.7", actuator_sheets.figure_5_7, _CONCEPT),
    CatalogueEntry("5.8", actuated_blade.figure_5_8, _CONCEPT),
    CatalogueEntry("5.9", actuated_blade.figure_5_9, _CONCEPT),
    CatalogueEntry("5.10", actuated_blade.figure_5_10, _CONCEPT),
    CatalogueEntry("table 5.1", actuated_blade.table_5_1, _CONCEPT),
    CatalogueEntry("table 5.2", actuated_blade.table_5_2, _CONCEPT, _compared),
    CatalogueEntry("today", today.today, _TODAY, today.needed),
)


def find_entry(number: str) -> CatalogueEntry:
    """The entry of that number, or of the title printed for it; ValueError with the numbers there are."""
    wanted = number.strip().lower().removeprefix("figure ")
    for entry in ENTRIES:
        if entry.number.lower() == wanted:
            return entry
    raise ValueError(f"figure {number!r} cannot be rebuilt: choose one of {', '.join(e.number for e in ENTRIES)}")


def searches_of(entries: Sequence[CatalogueEntry]) -> list[list[Call]]:
    """All searches that the entries need, one list per process, the longest first.

    The linear inflow models of a preset are one list, because they start from the optima of one of them. Calls that
    start from no other are lists of their own: the longest first, the others at the end, where they fill what is left
    of the processes' time.
    """
    groups: dict[str, list[str]] = {}
    for name in sorted(
        EVERY_VARIANT, key=lambda name: (linear_twin(name) is not None, choices(name)[1] != "lifting-line")
    ):
        groups.setdefault(linear_twin(name) or name, []).append(name)
    chained: list[list[Call]] = []
    alone: list[list[Call]] = []
    for names in groups.values():
        calls = dict.fromkeys(call for name in names for entry in entries if entry.needs for call in entry.needs(name))
        chained.append([call for call in calls if call[0] in (best, best_fixed)])
        alone += [[call] for call in calls if call[0] not in (best, best_fixed)]
    long = [calls for calls in alone if calls[0][0] is actuated_blade.compared]
    short = [calls for calls in alone if calls not in long]
    return [*long, *(calls for calls in chained if calls), *short]

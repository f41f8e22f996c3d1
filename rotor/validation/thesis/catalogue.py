"""Every figure and table that can be rebuilt, in the thesis' order; what they say, as sets of the trust page."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from rotor.design.design import TRIM_AZIMUTHS
from rotor.support.chart import INK, Axis, Chart, Line, Points
from rotor.validation.thesis import (
    actuation,
    disk_figures,
    implementation,
    ladder,
    optimum_twist,
    twist_effect,
)
from rotor.validation.thesis.report import Report, thesis
from rotor.validation.thesis.runs import CONCEPTS, FLIGHT_LINEAR, VARIANTS, Call, best, searches
from rotor.validation.trust import TrustRow, TrustSet, description

Searches = Callable[[], Sequence[Call]]


@dataclass(frozen=True)
class CatalogueEntry:
    """One figure or table and the function that makes it."""

    number: str
    make: Callable[[], Report]
    needs: Searches | None = None
    """The searches it needs."""

    @property
    def chapter(self) -> str:
        """Chapter of the thesis."""
        return thesis()[self.number]["chapter"]

    @property
    def slow(self) -> bool:
        """Whether it searches for optima, which is slow."""
        return self.needs is not None


_OF_ALL = partial(searches, CONCEPTS)
_SLOW: dict[str, tuple[Callable[[], Report], Searches]] = {
    **{
        number: (partial(optimum_twist.optimum_figure, number), partial(searches, (concept,)))
        for number, (concept, _) in optimum_twist.FIGURES.items()
    },
    "4.12": (
        optimum_twist.figure_4_12,
        lambda: [(optimum_twist.three_segment_rows, ("flight", None))],
    ),
    "4.13": (optimum_twist.figure_4_13, _OF_ALL),
    "table 4.1": (optimum_twist.table_4_1, _OF_ALL),
    "table 5.2": (actuation.table_5_2, lambda: [actuation.COMPARED]),
}
_FAST: dict[str, Callable[[], Report]] = {
    "2.7": disk_figures.figure_2_7,
    "2.8": disk_figures.figure_2_8,
    **{number: partial(implementation.error_figure, number) for number in ("3.3", "3.4")},
    **{number: partial(implementation.fit_figure, number) for number in ("3.5", "3.6")},
    **{number: partial(disk_figures.elements_figure, number) for number in ("3.7", "3.8")},
    "3.9": disk_figures.figure_3_9,
    **{
        number: partial(implementation.loaded_table, number)
        for number in ("table 3.1", "table 3.2")
    },
    "tail rotor": implementation.tail_rotor,
    "3.10": implementation.figure_3_10,
    "3.11": twist_effect.figure_3_11,
    "3.12": twist_effect.figure_3_12,
    "3.13": twist_effect.figure_3_13,
    "3.14": twist_effect.figure_3_14,
    "3.15": twist_effect.figure_3_15,
    "keys 1987": twist_effect.keys_1987,
    "4.11": optimum_twist.figure_4_11,
    "5.5": actuation.figure_5_5,
    "5.7": actuation.figure_5_7,
    "5.10": actuation.figure_5_10,
    "table 5.1": actuation.table_5_1,
}
DRAWINGS = thesis()["drawings"]
"""Figures of the thesis that show nothing of its model, and so are not rebuilt."""
ENTRIES = tuple(
    CatalogueEntry(number, *_SLOW[number])
    if number in _SLOW
    else CatalogueEntry(number, _FAST[number])
    for number in thesis()
    if number != "drawings"
)


def find_entry(number: str) -> CatalogueEntry:
    """The entry of that number, or of the title printed for it; ValueError with the numbers there are."""
    wanted = number.strip().lower().removeprefix("figure ")
    for entry in ENTRIES:
        if entry.number.lower() == wanted:
            return entry
    if wanted in DRAWINGS:
        raise ValueError(
            f"figure {wanted} is a drawing in the thesis ({DRAWINGS[wanted]}): it is not rebuilt"
        )
    raise ValueError(
        f"figure {number!r} cannot be rebuilt: choose one of {', '.join(e.number for e in ENTRIES)}"
    )


def searches_of(entries: Sequence[CatalogueEntry]) -> list[list[Call]]:
    """All searches that the entries need, one list per process, the longest first.

    The optima of a preset are one list, because each starts from its neighbours. The other calls start from none and
    are lists of their own: the longest first, the others at the end, where they fill what is left of the processes'
    time.
    """
    calls = dict.fromkeys(call for entry in entries if entry.needs for call in entry.needs())
    groups: dict[object, list[Call]] = {}
    for function, args in calls:
        kind = args[0] if function is best else (function, args)
        groups.setdefault(kind, []).append((function, args))
    first = (actuation.COMPARED, *reversed(VARIANTS))  # The lifting line takes longest.
    return [
        groups[one]
        for one in sorted(groups, key=lambda one: first.index(one) if one in first else len(first))
    ]


def trust_sets(reports: Iterable[Report]) -> tuple[TrustSet, ...]:
    """What the figures show beyond the thesis: grid, Keys et al., tail rotor; and what became of its statements."""
    reports = list(reports)
    known = {report.number: report for report in reports}
    return (
        _grid(known),
        _keys_1987(known["Keys 1987"]),
        _tail_rotor(known["Tail rotor"]),
        _statements(reports),
    )


def _grid(known: dict[str, Report]) -> TrustSet:
    words, presets = description("grid"), ("thesis", FLIGHT_LINEAR)
    rows = [
        words.share(
            f"Power at 40 elements, {where}",
            max(known[number].numbers[f"{p}_error_at_40"] for p in presets),
            2e-4,
            digits=2,
            against="limit of finer grids",
        )
        for where, number in (("hover", "3.7"), ("µ 0.30", "3.8"))
    ]
    speeds = f"µ {', '.join(f'{mu:g}' for mu in disk_figures.SPEEDS)}"
    line = [disk_figures.line_error(mu) for mu in disk_figures.SPEEDS]
    linear, added = zip(*map(disk_figures.linear_errors, disk_figures.SPEEDS), strict=True)
    error = max(known["3.9"].numbers[f"{preset}_error_at_100"] for preset in presets)
    area = known["2.8"].numbers
    rows += [
        words.bound(
            "Power at 100 azimuths, µ 0.30, linear inflow",
            "720 azimuths",
            error,
            1e-5,
            "test_figure_3_9",
            "The edges of stalled regions lie between azimuths, so the error does not fall steadily with their number: "
            "it is smaller at 120, and at 90 it is as large without the delay of stall.",
        ),
        words.row(
            f"Power at −8° of twist, linear inflow on {TRIM_AZIMUTHS} azimuths, {speeds}",
            ", ".join(f"{100.0 * error:+.3f}" for error in linear) + " %",
            max(linear, key=abs),
            1e-4,
            test="test_the_grid_of_linear_inflow",
            against="240 azimuths",
            note=f"The change due to −16° of twist is off by {', '.join(f'{error:+.2f}' for error in added)} kW.",
        ),
        words.row(
            f"Power of the default model, 24 panels × 24 azimuths, {speeds}",
            ", ".join(f"{100.0 * error:+.2f}" for error in line) + " %",
            max(line, key=abs),
            1e-3,
            test="test_the_grid_of_the_default_model",
            against="48 × 48",
            note=f"With linear inflow stall lags use the azimuths of the trim; the error at 100 is {error:.1e}. At "
            "µ 0.1 the error of the default model comes from its azimuths.",
        ),
        words.share(
            "Reverse-flow area, µ 0.30, counted in cells",
            area["reverse_area"] / area["circle_area"] - 1.0,
            5e-3,
            digits=2,
            against="the circle r = −µ sin ψ",
            test="rotor/validation/thesis/test_chapter_2.py::test_figure_2_8",
        ),
    ]
    charts = (_chart(known[number], -1) for number in ("3.7", "3.8", "3.9"))
    return words.page(f"{rows[0].shown} at 40 elements", rows, charts)


def _keys_1987(report: Report) -> TrustSet:
    words = description("keys-1987")
    rows = [
        words.share(
            f"Power of −17.3° over −11.5°, {where}, {name}",
            report.numbers[f"{name}_{key}"] - published,
            3e-3,
            unit="points",
            against=f"{100 * published:+.1f} % (Keys et al. 1987, another rotor)",
        )
        for name in ("thesis-wake", "flight")
        for key, where, published in (
            ("hover", "hover", ladder.HOVER),
            ("fast", "330 km/h", ladder.FAST),
        )
    ]
    return words.page(
        f"{rows[2].shown}, {rows[3].shown}", rows, (_chart(report),), text=(report.because,)
    )


def _tail_rotor(report: Report) -> TrustSet:
    words = description("tail-rotor")
    what = "Tail rotor over main-rotor power, mean of four speeds"
    row = words.share(what, report.numbers["mean"] - 0.05, 3e-3, unit="points")
    return words.page(row.shown, (row,), (_chart(report),), text=(report.because,))


def _statements(reports: Sequence[Report]) -> TrustSet:
    words, rows = description("thesis"), list[TrustRow]()
    for checked in filter(lambda report: report.checkable, reports):
        chapter = checked.number[0] if checked.number[0].isdigit() else "3"
        name = checked.title.lower().replace(" ", "_").replace(".", "_")
        test = f"rotor/validation/thesis/test_chapter_{chapter}.py::test_{name}"
        row = words.row(
            checked.title,
            checked.verdict.value,
            0.0,
            0.0,
            test=test,
            note=checked.finding,
            against=checked.statement,
        )
        rows.append(replace(row, error=None))
    count = Counter(row.shown for row in rows)
    series = (Points("", tuple(count.values()), range(len(count)), 1),)
    chart = Chart("Verdicts", Axis("figures, tables and claims"), Axis(names=tuple(count)), series)
    error = f"{count['agrees']} agree, {count['differs']} differ"
    return words.page(error, rows, (chart,), compared=f"{len(rows)} figures, tables and claims")


def _chart(report: Report, place: int = 0) -> Chart:
    """A panel as a chart of the trust page: what the thesis says in ink."""
    panel = report.panels[place]
    series = tuple(
        replace(
            series,
            colour=INK
            if isinstance(series, Points) or (isinstance(series, Line) and series.dashes)
            else k,
        )
        for k, series in enumerate(panel.series, start=1)
    )
    return replace(panel, title=report.caption, series=series)

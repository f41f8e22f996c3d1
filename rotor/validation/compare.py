"""Sets of measured points, one file a set in `assets/measured/`, and the rotor trimmed at every point beside them.

Each file has report, rotor, trim and scatter; the comparison gives rows and charts of the trust page. Sets of one
report share a page.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, lru_cache
from typing import Any, Literal

import numpy as np
from scipy.special import gammaincinv

from rotor.design.aircraft import Stand
from rotor.design.design import Design, with_models
from rotor.files.make_design import make_design
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import toml_asset
from rotor.support.chart import Axis, Chart, Line, Points, Series
from rotor.support.user_input import check_known
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation.scatter import scatter_about_law
from rotor.validation.trust import (
    Kind,
    SetDescription,
    TrustRow,
    TrustSet,
    description,
    rms,
)

PAGES: dict[str, tuple[str, ...]] = {
    "xv15-hover": ("xv15-hover",),
    "xv15-forward": ("xv15-forward-15deg", "xv15-forward-0deg", "xv15-forward-figure-18"),
    "pca2": ("pca2",),
    "knight-hefner": ("knight-hefner-3", "knight-hefner-4"),
    "caradonna-tung-lift": ("caradonna-tung-lift",),
    "caradonna-tung": ("caradonna-tung",),
    "castles-gray": (
        "castles-gray-hover",
        "castles-gray-4ft",
        "castles-gray-tapered",
        "castles-gray-table-1",
        "castles-gray-twisted",
        "castles-gray-twist-effect",
    ),
    "uh60a-hover": ("uh60a-hover",),
}
"""Names of the sets on each page, in the order in which they are shown. A page has the kind of its first set."""
SETS = tuple(name for sets in PAGES.values() for name in sets)
"""Names of the sets."""
FIELDS = ("2mrts-inflow", "hart2-airloads", "gazelle-airloads", "uh60a-pitch-link", "flown-power")
"""Names of the sets that are not single points with a scatter: `rotor.validation.inflow`, `airloads` and `flown`."""
LABELS = {
    "mu": "Advance ratio µ",
    "r": "r/R",
    "ct": "C_T",
    "ct_over_sigma": "C_T/σ",
    "cl": "Section C_l",
    "cp": "C_P",
    "cq_over_sigma": "C_Q/σ",
    "cp_drag": "C_P of the rotor's drag",
    "cq_above_zero": "C_Q above its zero",
    "change_percent": "Change of C_Q [%]",
    "collective_deg": "Collective [°]",
    "shaft_tilt_deg": "Shaft tilt [°]",
    "tip_mach": "Tip Mach number",
}
"""Labels of axes and columns."""
CONFIDENCE = 0.95
"""Part of the tests in which a model without error meets its target."""
ALSO = {"xv15-forward-15deg": ("uniform",)}
"""Inflow models that the trust page shows beside that of `flight`, where they give a trim."""


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
    part: str = ""
    """What tells it from the other sets of its page; empty where there are none."""
    note: str = ""
    page_note: str = ""
    """What holds for every set of its page."""
    menu: str = ""
    """Short title, for a menu."""
    missed: str = ""
    """Why the target is missed, as far as it is known."""
    scatter: float | None = None
    """Scatter of the quantity, in its unit; None where it is a part of the measured value."""
    scatter_percent: float | None = None
    """Scatter as a part of the measured value [%]; None where `scatter_law` gives it."""
    scatter_law: dict[str, int] = field(default_factory=dict[str, int])
    """Degree of the smooth law of the points, by column: what they scatter about it is their scatter."""
    scatter_source: str = ""
    """Where the scatter comes from; empty where that is not known, or it is that about a law."""
    judged: dict[str, tuple[float, float]] = field(default_factory=dict[str, tuple[float, float]])
    """Ranges of columns within which points count, for a reason that lies in the data."""
    indicative: bool = False
    """Whether origin, test or scatter of the data is unclear; then there is no target."""
    against: str | None = None
    """Rotor from which a change is counted."""

    def scatter_of(self, point: dict[str, float]) -> float:
        """Scatter of a measured point in the unit of the quantity: its own, else that of the set."""
        if "scatter" in point:
            return point["scatter"]
        if self.scatter is not None:
            return self.scatter
        return abs(point[self.quantity]) * self.relative_scatter

    @cached_property
    def relative_scatter(self) -> float:
        """Scatter as a part of the measured value [-]: as stated, or of the counted points about their law."""
        if self.scatter_percent is not None:
            return self.scatter_percent / 100.0
        counted = [point for point in self.points if self.counts(point)]
        return scatter_about_law(counted, self.quantity, self.scatter_law)

    def counts(self, point: dict[str, float]) -> bool:
        """Whether a point lies within the ranges that count."""
        return all(
            low - 1e-12 <= point[name] <= high + 1e-12 for name, (low, high) in self.judged.items()
        )

    @property
    def remarks(self) -> str:
        """Its own note, then that of its page."""
        return f"{self.note} {self.page_note}".strip()

    @property
    def unit(self) -> str:
        """Unit of errors: `%`, or `points` for a change that is itself in per cent, whose error is the difference."""
        return "points" if self.against else "%"

    @cached_property
    def largest_rms(self) -> float | None:
        """The target: largest rms error as a part of what is measured [-]; None where no scatter is known.

        A model without error meets it in 19 of 20 tests: it has the scatter of the points, whose squares over their
        number of points are distributed as chi-squared.
        """
        if self.indicative or not (self.scatter_law or self.scatter_source):
            return None
        half = 0.5 * sum(map(self.counts, self.points))
        return self.rms_scatter * math.sqrt(float(gammaincinv(half, CONFIDENCE)) / half)

    @property
    def rms_scatter(self) -> float:
        """Root mean square of the scatter of the points that count, as a part of what is measured [-]."""
        counted = [point for point in self.points if self.counts(point)]
        return rms([self.scatter_of(point) / abs(point[self.quantity]) for point in counted])

    @property
    def scatter_words(self) -> str:
        """A sentence on the scatter that the target follows from; empty where there is no target."""
        if self.largest_rms is None:
            return ""
        source = "about a smooth law of them" if self.scatter_law else self.scatter_source
        return f"The measured points scatter by {100.0 * self.rms_scatter:.1f} %, {source}."

    @property
    def varied(self) -> tuple[str, ...]:
        """The given columns that are not the same everywhere; the first is that of charts."""
        return tuple(name for name in self.given if len({point[name] for point in self.points}) > 1)

    @property
    def target(self) -> str:
        """The target in words; empty where there is none."""
        if self.largest_rms is None:
            return ""
        ranges = [f"{name} {low:g}…{high:g}" for name, (low, high) in self.judged.items()]
        where = f" for {', '.join(ranges)}" if ranges else ""
        return f"rms {100.0 * self.largest_rms:.1f} %{where}"


def sets_of(rotor: str) -> tuple[MeasuredSet, ...]:
    """The sets of a shipped rotor by its name, for example `xv15`; none for a rotor that was not measured.

    Without those whose points are places on the blade in one condition.
    """
    sets = (measured for measured in map(load_set, SETS) if measured.rotor == rotor)
    return tuple(measured for measured in sets if "r" not in measured.given)


def page_of(name: str) -> str:
    """The page of a set, which has its name unless several sets share the page."""
    return next((page for page, sets in PAGES.items() if name in sets), name)


@cache
def load_set(name: str) -> MeasuredSet:
    """The set of that name; ValueError with one sentence for any other."""
    if name in PAGES and name not in SETS:
        raise ValueError(f"{name!r} has several sets: use one of {', '.join(PAGES[name])}")
    check_known("set", name, SETS)
    page = page_of(name)
    shared = description(page).text if len(PAGES[page]) > 1 else ()
    record: dict[str, Any] = dict(toml_asset(f"measured/{name}.toml"))
    columns: dict[str, list[float]] = record.pop("points")
    rows = zip(*columns.values(), strict=True)
    return MeasuredSet(
        name=name,
        given=tuple(record.pop("given")),
        judged={key: (low, high) for key, (low, high) in record.pop("judged", {}).items()},
        points=tuple(dict(zip(columns, map(float, values), strict=True)) for values in rows),
        page_note=" ".join(shared),
        **record,
    )


@dataclass(frozen=True)
class ComparedPoint:
    """One measured point with the computed one."""

    given: dict[str, float]
    measured: dict[str, float]
    computed: dict[str, float] | None
    """Computed values of the quantities measured; None where the rotor does not trim."""
    message: str
    """Why it does not."""
    error_percent: float | None
    """In the unit of the set."""
    within_scatter: bool
    judged: bool
    """Whether a target is set and this point counts for it."""


@dataclass(frozen=True)
class Comparison:
    """A set of measured points with the computed ones."""

    measured: MeasuredSet
    inflow: str
    points: tuple[ComparedPoint, ...]
    chosen: bool = False
    """Whether the inflow was asked for, and is not that of the preset."""

    @property
    def counting(self) -> tuple[ComparedPoint, ...]:
        """The points within the ranges that count."""
        return tuple(
            point
            for point in self.points
            if self.measured.counts({**point.given, **point.measured})
        )

    @property
    def counted(self) -> str:
        """What is compared at how many points, in words."""
        of = f" of {len(self.points)}" if len(self.counting) < len(self.points) else ""
        return f"{LABELS[self.measured.quantity].removesuffix(' [%]')}, {len(self.counting)} points{of}"

    @property
    def lost(self) -> int:
        """How many of the points that count do not trim."""
        return sum(point.computed is None for point in self.counting)

    @cached_property
    def rms_percent(self) -> float | None:
        """Root mean square of the errors of the points that count and trim; None where none does."""
        errors = [point.error_percent for point in self.counting if point.error_percent is not None]
        return rms(errors) if errors else None

    @property
    def worst_percent(self) -> float | None:
        """The error of the largest size among the points that count and trim."""
        return max(
            (one.error_percent for one in self.counting if one.error_percent is not None),
            key=abs,
            default=None,
        )

    @property
    def worst(self) -> str:
        """The worst of the points that count, in words; also how many do not trim."""
        words = f"{self.worst_percent:+.1f} {self.measured.unit}"
        if not self.lost:
            return words
        return f"{words}; {self.lost} of {len(self.counting)} do not trim"

    @property
    def why_missed(self) -> str:
        """Why the target is missed, which is known for the inflow of the preset."""
        return self.measured.missed if self.passed is False and not self.chosen else ""

    @property
    def passed(self) -> bool | None:
        """Whether all points that count trim and their rms error is within the target; None without one."""
        largest = self.measured.largest_rms
        if largest is None:
            return None
        return (
            not self.lost and self.rms_percent is not None and self.rms_percent <= 100.0 * largest
        )

    def to_dict(self) -> dict[str, Any]:
        """The comparison as `validate --json` prints it."""
        rows = self.measured
        shown = ("given", "measured", "computed", "error_percent", "within_scatter", "judged")
        return {
            **{name: getattr(rows, name) for name in ("name", "title", "report", "rotor", "kind")},
            "inflow": self.inflow,
            "quantity": rows.quantity,
            "points": [
                {name: getattr(point, name) for name in shown}
                | ({"message": point.message} if point.message else {})
                for point in self.points
            ],
            "rms_percent": self.rms_percent,
            "worst_percent": self.worst_percent,
            "not_trimmed": self.lost,
            "target": rows.target or None,
            "passed": self.passed,
            "note": rows.remarks,
            "why_missed": self.why_missed,
            "fitted": False,
        }


def compare(measured: MeasuredSet, inflow: str | None = None) -> Comparison:
    """Trim the rotor at every point of a set; `inflow`: a model by name, by default that of the preset `flight`."""
    base = _base(measured, inflow)
    points = tuple(compare_point(measured, point, base) for point in measured.points)
    name = base.models.hover_inflow if measured.kind == "hover" else base.models.inflow
    return Comparison(measured, name, points, chosen=inflow is not None)


def compare_point(measured: MeasuredSet, point: dict[str, float], base: Design) -> ComparedPoint:
    """Trim the blade and models of `base` at one point of a set of its rotor."""
    given = {name: point[name] for name in measured.given}
    targets = {name: value for name, value in point.items() if name not in given}
    solution = solve(design_at(measured, point, base))
    wanted = targets[measured.quantity]
    judged = measured.counts(point) and measured.largest_rms is not None
    if not solution.converged:
        return ComparedPoint(given, targets, None, solution.message, None, False, judged)
    r = given.get("r", math.nan)
    computed = {
        name: quantity_of(name, solution, measured, r) for name in targets if name != "scatter"
    }
    value = computed[measured.quantity]
    error = value - wanted if measured.against else 100.0 * (value / wanted - 1.0)
    within = abs(value - wanted) <= measured.scatter_of(point)
    return ComparedPoint(given, targets, computed, "", error, within, judged)


def measured_set(name: str) -> TrustSet:
    """A page of measured points for the trust page; every one is trimmed here."""
    words = _description(name)
    parts = [_part(words, each) for each in PAGES[name]]
    rows = [row for part in parts for row in part.rows]
    charts = [comparison_chart(part.comparisons) for part in parts]
    error = _error([part.comparisons[0] for part in parts])
    points = _points(parts)
    if len(parts) == 1:
        compared = parts[0].comparisons[0].counted
        return words.page(error, rows, charts, compared=compared, text=parts[0].text, points=points)
    labels = [part.label(row) for part in parts for row in part.rows]
    remarks = [f"- **{part.name}.** {' '.join(part.text)}" for part in parts if part.text]
    text = (*words.text, "\n".join(remarks)) if remarks else words.text
    return words.page(error, rows, charts, text=text, points=points, labels=labels)


@dataclass(frozen=True)
class _Part:
    """One set of a page, compared with each inflow model that is shown."""

    comparisons: list[Comparison]
    rows: list[TrustRow]
    text: tuple[str, ...]
    """Paragraphs that hold for its rows alone."""

    @property
    def measured(self) -> MeasuredSet:
        return self.comparisons[0].measured

    @property
    def name(self) -> str:
        """What tells it from the other sets of its page, as a line begins."""
        return f"{self.measured.part[:1].upper()}{self.measured.part[1:]}"

    def label(self, row: TrustRow) -> str:
        """The name of one of its rows beside those of other sets."""
        return f"{self.name}: {row.what.removeprefix(f'{self.measured.title}: ')}"


def _description(name: str) -> SetDescription:
    """The words of a page; of a set with a page of its own they are those of the set."""
    if len(PAGES[name]) > 1:
        return description(name)
    measured = load_set(PAGES[name][0])
    test = "rotor/validation/test_validation.py::test_rows_of_the_trust_page"
    return SetDescription(name, measured.title, "", measured.report, test)


def _part(words: SetDescription, name: str) -> _Part:
    """A set of the page that has these words, trimmed at every point."""
    measured = load_set(name)
    comparisons = [compare(measured)]
    comparisons += [compare(measured, inflow) for inflow in ALSO.get(name, ())]
    rows = [_row(words, comparison) for comparison in comparisons]
    text = [_constant(measured), measured.scatter_words, measured.note]
    if measured.given[0] == "collective_deg":
        by_pitch, missing = zip(*_by_pitch(words, comparisons[0]), strict=True)
        rows += by_pitch
        text.append(
            f"The measured thrust needs less collective, on average by {', '.join(missing)}."
        )
    return _Part(comparisons, rows, tuple(filter(None, text)))


def _error(comparisons: list[Comparison]) -> str:
    """Errors of all sets of a page and its worst miss, `rms 7.2 to 8.8 %; worst miss: 3 blades, 8.8 %`."""
    errors: dict[str, list[float]] = {}
    for comparison in comparisons:
        errors.setdefault(comparison.measured.unit, []).append(_rms(comparison))
    text = f"rms {', '.join(_range(sizes, unit) for unit, sizes in errors.items())}"
    missed = [comparison for comparison in comparisons if comparison.passed is False]
    if len(comparisons) == 1 or not missed:
        return text
    worst = max(missed, key=_rms)
    return f"{text}; worst miss: {worst.measured.part}, {_rms(worst):.1f} {worst.measured.unit}"


def _range(sizes: list[float], unit: str) -> str:
    """The least and the largest of some errors, `7.2 to 8.8 %`."""
    if len(sizes) == 1:
        return f"{sizes[0]:.1f} {unit}"
    return f"{min(sizes):.1f} to {max(sizes):.1f} {unit}"


def _rms(comparison: Comparison) -> float:
    size = comparison.rms_percent
    assert size is not None
    return size


def _by_pitch(words: SetDescription, comparison: Comparison) -> Iterator[tuple[TrustRow, str]]:
    """Of each given collective its row, and how much lower a collective gives the measured thrust."""
    measured = comparison.measured
    at_thrust = compare(
        replace(
            measured,
            given=("ct", "tip_mach"),
            quantity="collective_deg",
            scatter_law={"ct": 2, "tip_mach": 1},
        )
    )
    for pitch in dict.fromkeys(point["collective_deg"] for point in measured.points):
        here = [k for k, point in enumerate(measured.points) if point["collective_deg"] == pitch]
        less = -float(np.mean([at_thrust.points[k].error_percent or math.nan for k in here]))
        part = replace(comparison, points=tuple(comparison.points[k] for k in here))
        row = _row(words, part, f"Collective {pitch:g}°: ")
        yield (
            replace(row, target="", verdict="no target"),  # The target is that of all pitches.
            f"{0.01 * less * pitch:.1f}° ({less:.0f} %) at {pitch:g}°",
        )


def _row(words: SetDescription, comparison: Comparison, where: str = "") -> TrustRow:
    """The root mean square of the errors at the points that count."""
    measured = comparison.measured
    size = _rms(comparison)
    kind: Kind = "indicative" if measured.indicative else "validation"
    return replace(words, kind=kind).row(
        f"{measured.title}: {where}{comparison.counted}, inflow {comparison.inflow}",
        f"rms {size:.1f} {measured.unit}, worst {comparison.worst}",
        size / 100.0,
        5e-3,
        note=comparison.why_missed,
        target=measured.target,
        met=comparison.passed,
        against=measured.report,
    )


def comparison_chart(comparisons: list[Comparison]) -> Chart:
    """Measured points with their scatter, and computed ones: a line where no two points share a place, else crosses."""
    measured, quantity = comparisons[0].measured, comparisons[0].measured.quantity
    along = measured.varied[0]
    values = tuple(point[quantity] for point in measured.points)
    places = tuple(point[along] for point in measured.points)
    scatter = tuple(map(measured.scatter_of, measured.points))
    label = f"measured, {measured.part}" if measured.part else "measured"
    series: list[Series] = [Points(label, places, values, scatter=scatter)]
    for k, comparison in enumerate(comparisons, start=1):
        computed = sorted(
            (point.given[along], point.computed[quantity])
            for point in comparison.points
            if point.computed is not None
        )
        x, y = zip(*computed, strict=True)
        alone = len(set(x)) == len(x)
        label = f"computed, inflow {comparison.inflow}"
        series.append(
            Line(label, x, y, k, dots=True) if alone else Points(label, x, y, k, mark="cross")
        )
    return Chart(measured.title, Axis(LABELS[along]), Axis(LABELS[quantity]), tuple(series))


def _constant(measured: MeasuredSet) -> str:
    """What is the same at every point."""
    same = [name for name in measured.given if name not in measured.varied]
    words = "; ".join(f"{LABELS[name]} {measured.points[0][name]:g}" for name in same)
    return f"Constant at every point: {words}." if same else ""


def _points(parts: list[_Part]) -> list[tuple[str, ...]]:
    """Every measured point beside the computed one, with what is not the same at all points of one set."""
    names = list(dict.fromkeys(name for part in parts for name in part.measured.varied))
    lines = [line for part in parts for line in _lines(part, names)]
    head = list(dict.fromkeys(column for line in lines for column in line))
    return [tuple(head), *(tuple(line.get(column, "") for column in head) for line in lines)]


def _lines(part: _Part, names: list[str]) -> Iterator[dict[str, str]]:
    """The points of one set, by column."""
    measured = part.measured
    for k, point in enumerate(measured.points):
        line: dict[str, str] = {}
        if measured.part:
            line["Set"] = measured.part
        line |= {LABELS[name]: f"{point[name]:.5g}" for name in names if name in point}
        line["Measured"] = f"{point[measured.quantity]:.5g}"
        line["Scatter"] = f"{measured.scatter_of(point):.2g}"
        for comparison in part.comparisons:
            compared = comparison.points[k]
            value = f"Computed, {comparison.inflow}"
            error = f"Error [{measured.unit}], {comparison.inflow}"
            line[value] = "no trim"
            line[error] = ""
            if compared.computed is not None:
                line[value] = f"{compared.computed[measured.quantity]:.5g}"
                line[error] = f"{compared.error_percent:+.1f}"
        yield line


def _base(measured: MeasuredSet, inflow: str | None) -> Design:
    """The rotor of a set as built, with the models of `flight` and the inflow asked for."""
    if measured.kind == "forward" or inflow is None:
        return make_design(rotor=measured.rotor, inflow=inflow)
    return with_models(make_design(rotor=measured.rotor), hover_inflow=inflow)


def design_at(measured: MeasuredSet, point: dict[str, float], base: Design | None = None) -> Design:
    """The test of one point, with the blade and models of `base`; else the rotor as built with those of `flight`."""
    stand = {
        key: point[key] for key in ("shaft_tilt_deg", "ct_over_sigma", "tip_mach") if key in point
    }
    if "collective_deg" in measured.given:
        stand["collective_deg"] = point["collective_deg"]
    if measured.trim != "free-rotor" and "shaft_tilt_deg" not in measured.given:
        stand.pop("shaft_tilt_deg", None)
    if "ct" in measured.given:
        stand["ct_over_sigma"] = point["ct"] / shipped_aircraft(measured.rotor).rotor.solidity
    design = make_design(
        rotor=measured.rotor, mu=point.get("mu", 0.0), trim=measured.trim, stand=stand
    )
    if base is None:
        return design
    models = replace(base.models, trim=design.models.trim)
    return replace(
        base, condition=replace(design.condition, mass=base.condition.mass), models=models
    )


def quantity_of(name: str, solution: Solution, measured: MeasuredSet, r: float = math.nan) -> float:
    """A computed quantity in the unit of the measured one of that name; r: r/R of a section; else ValueError."""
    design = solution.design
    match name:
        case "ct":
            return solution.ct
        case "cl":
            return float(np.interp(r, solution.disk.r, solution.disk.cl[:, 0]))
        case "cp":
            return solution.cp
        case "cq_over_sigma":
            return solution.cq / design.rotor.solidity
        case "cp_drag":
            return solution.lift_and_drag[1] * design.airspeed / design.power_unit
        case "cq_above_zero":
            return solution.cq - at_zero(design).cq
        case "change_percent":
            assert measured.against is not None
            other = make_design(rotor=measured.against)
            plain = solve(
                replace(other, condition=design.condition, models=design.models)
            ).require()
            return 100.0 * (
                (solution.cq - at_zero(design).cq) / (plain.cq - at_zero(plain.design).cq) - 1.0
            )
        case "collective_deg":
            return math.degrees(solution.controls.collective)
        case "shaft_tilt_deg":
            return math.degrees(solution.controls.shaft_tilt)
        case _:
            raise ValueError(
                f"measured quantity {name!r} is not known: check assets/measured/{measured.name}.toml"
            )


def at_zero(design: Design) -> Solution:
    """The rotor of a design in hover without thrust, by annuli. A twist of −12° makes an eighth of its C_Q."""
    air = design.condition.stand or Stand(ct_over_sigma=0.0)
    stand = Stand(ct_over_sigma=0.0, tip_mach=air.tip_mach, density=air.density)
    models = replace(design.models, hover_inflow="annulus", trim="wind-tunnel")
    condition = replace(design.condition, advance_ratio=0.0, stand=stand)
    return _solved(replace(design, condition=condition, models=models))


@lru_cache(maxsize=16)
def _solved(design: Design) -> Solution:
    return solve(design).require()

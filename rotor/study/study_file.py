"""Study files: TOML with axes, fixed values, models, sampling and optimum settings.

Every error is a ValueError with one sentence that names the file, the line, the value and the remedy.
"""

import math
import re
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, field

from rotor.design.aircraft import Aircraft
from rotor.design.twist import inline_spec
from rotor.files.declared import (
    BY_KIND,
    FileTable,
    Number,
    Refusal,
    Text,
    convert,
    naming,
    read_toml,
)
from rotor.files.make_design import make_design
from rotor.files.rotor_file import find_aircraft
from rotor.optimisation.objective import Quantity as Objective
from rotor.study.point import check_point
from rotor.study.study import (
    PLAIN,
    QUANTITIES,
    Method,
    OptimumSettings,
    ShowSettings,
    Study,
    StudyAxis,
    StudyPoints,
    StudySample,
    Value,
    check_uncertain,
    columns_of,
    default_chunk,
)
from rotor.support.assets import SHIPPED_ROTORS, asset_path
from rotor.support.user_input import (
    did_you_mean,
    is_file,
    parse_range,
    read_text,
    refusing,
    shorten,
)

_MANY = 10**10
_STEEPEST_TWIST = 100.0
"""Twist rates beyond this [°/R] are an error of writing, as in `--twist`."""
_Rate = Annotated[float, Meta(ge=-_STEEPEST_TWIST, le=_STEEPEST_TWIST)]
_Seed = Annotated[int, Meta(ge=0, le=2**31)]


class _Range(FileTable, frozen=True, kw_only=True):
    """An axis that is sampled."""

    low: Number
    high: Number


def _kind(key: str) -> Any:
    """What a value of a quantity is. Parameters of a concept have no limits of their own; others have theirs."""
    return BY_KIND[QUANTITIES[key].kind] if key in PLAIN else _Rate


class _Sample(FileTable, frozen=True, kw_only=True):
    method: Method = "sobol"
    count: Annotated[int, Meta(ge=1, le=2**24)]
    seed: _Seed = 0


class _OptimumTable(FileTable, frozen=True, kw_only=True):
    """The table [optimum]: angles in degrees, shares in per cent."""

    starts: Annotated[int, Meta(ge=1, le=1000)] = OptimumSettings.starts
    seed: _Seed = OptimumSettings.seed
    objective: Objective = OptimumSettings.objective
    rate_deg: tuple[_Rate, _Rate] | None = None
    stalled_percent: Annotated[float, Meta(ge=0.0, le=100.0)] | None = None
    index_percent: Annotated[float, Meta(ge=1e-6, le=1e12)] | None = None

    def __post_init__(self) -> None:
        if self.rate_deg and self.rate_deg[0] >= self.rate_deg[1]:
            raise Refusal(
                f"rate_deg is {list(self.rate_deg)}: give the lower one first, as [-20, 0]",
                "rate_deg",
            )

    def settings(self) -> OptimumSettings:
        rate = self.rate_deg and (math.radians(self.rate_deg[0]), math.radians(self.rate_deg[1]))
        stalled = None if self.stalled_percent is None else self.stalled_percent / 100.0
        return OptimumSettings(
            self.starts, self.seed, self.objective, rate, stalled, self.index_percent
        )


class _Show(FileTable, frozen=True, kw_only=True):
    least: Text = ShowSettings.least
    uncertain: Text | tuple[Text, ...] = ()


class _Top(FileTable, frozen=True, kw_only=True):
    """The keys of the first three tables are names of quantities."""

    axes: dict[str, Any] = field(default_factory=dict[str, Any])
    fixed: dict[str, Any] = field(default_factory=dict[str, Any])
    models: dict[str, Any] = field(default_factory=dict[str, Any])
    title: Text | None = None
    chunk: Annotated[int, Meta(ge=1, le=10**6)] | None = None
    sample: _Sample | None = None
    optimum: _OptimumTable | None = None
    show: _Show = _Show()


class Reader:
    """Reads a study from the text of a file. Raises Refusal for what is wrong."""

    def __init__(self, values: dict[str, Any], name: str) -> None:
        self._name = name
        self._aircraft: dict[str, Aircraft] = {}
        self._top = convert(values, _Top)

    def study(self) -> Study:
        top = self._top
        axes, ranges = self._axes()
        if top.sample and not ranges:
            raise Refusal(
                "[sample] has no range to sample: give an axis as { low = …, high = … }", "sample"
            )
        if ranges and not top.sample:
            key = ranges[0][0]
            raise Refusal(f"axis {key} is a range: add [sample] with method and count", "axes", key)
        sample = top.sample and StudySample(
            top.sample.method, top.sample.count, top.sample.seed, tuple(ranges)
        )
        places = StudyPoints(axes, sample)
        if not axes and not ranges:
            raise Refusal(
                "the study has no axes: add for example mu = [0.1, 0.2, 0.3] to [axes]", "axes"
            )
        given = self._given({axis.name for axis in axes} | {name for name, _, _ in ranges})
        if places.count > _MANY:
            raise Refusal(
                f"the study has {places.count:.3g} points: keep below {_MANY:.0e}", "axes"
            )
        searching = top.optimum and top.optimum.settings()
        chunk = top.chunk or default_chunk(places.count, search=searching is not None)
        aircraft, title = tuple(self._aircraft.items()), top.title or Path(self._name).stem
        study = Study(
            title, places, tuple(given.items()), searching, chunk, ShowSettings(), aircraft
        )
        self._try_points(study)
        return replace(study, show=self._aims(study))

    def _axes(self) -> tuple[tuple[StudyAxis, ...], list[tuple[str, float, float]]]:
        axes: list[StudyAxis] = []
        ranges: list[tuple[str, float, float]] = []
        for key, value in self._top.axes.items():
            self._check_known("axes", key)
            axis = self._axis(key, value)
            if isinstance(axis, _Range):
                for end in (axis.low, axis.high):
                    convert(end, _kind(key), "axes", key)
                if axis.low >= axis.high:
                    runs = f"axis {key} runs from {axis.low:g} to {axis.high:g}"
                    raise Refusal(f"{runs}: give the lower one first", "axes", key)
                ranges.append((key, axis.low, axis.high))
            else:
                if len(set(axis)) < len(axis):
                    raise Refusal(f"axis {key} holds a value twice: remove one", "axes", key)
                numeric = QUANTITIES[key].numeric
                values: Any = (
                    map(float, axis)
                    if numeric
                    else (self._portable("axes", key, text) for text in axis)
                )
                axes.append(StudyAxis(key, tuple(values)))
        return tuple(axes), ranges

    def _axis(self, key: str, given: Any) -> _Range | tuple[Any, ...]:
        """A range to sample, or the values, which may be written as a range in a text."""
        quantity, one = QUANTITIES[key], _kind(key)
        if isinstance(given, str) and quantity.numeric:
            try:
                given = [
                    int(value) if value.is_integer() else value for value in parse_range(given)
                ]
            except ValueError as error:
                raise Refusal(f"axis {key}: {error}", "axes", key) from None
        kind: Any = Annotated[tuple[one, ...], Meta(min_length=1)]
        return convert(given, kind | _Range if quantity.kind == "number" else kind, "axes", key)

    def _check_known(self, section: str, key: str) -> None:
        quantity = QUANTITIES.get(key)
        if quantity is None:
            axes, rows = section == "axes", QUANTITIES.items()
            names = [
                name
                for name, row in rows
                if (row.kind != "switch" if axes else row.section == section)
            ]
            says = f"{key!r} is not a quantity of [{section}]{did_you_mean(key, names) or ':'}"
            raise Refusal(f"{says} use one of {', '.join(names)}", section, key)
        if section == "axes" and quantity.kind == "switch":
            raise Refusal(
                f"{key} cannot be an axis: set it in [models] and make two studies", section, key
            )
        if section not in ("axes", quantity.section):
            raise Refusal(
                f"{key} does not belong in [{section}]: move it to [{quantity.section}]",
                section,
                key,
            )

    def _portable(self, section: str, key: str, text: str) -> str:
        """The value without files, for other machines: reads a rotor file, inlines a twist table."""
        try:
            if key == "rotor" and text not in SHIPPED_ROTORS:
                beside = Path(self._name).parent / text
                self._aircraft[text] = find_aircraft(str(beside) if beside.is_file() else text)
            elif key == "twist" and "table:" in text:
                return inline_spec(make_design(twist=text).twist)
        except ValueError as error:
            raise Refusal(str(error), section, key) from None
        return text

    def _given(self, varied: set[str]) -> dict[str, Value]:
        given: dict[str, Value] = {}
        for section, values in (("fixed", self._top.fixed), ("models", self._top.models)):
            for key, written in values.items():
                self._check_known(section, key)
                if key in varied:
                    raise Refusal(
                        f"{key} is an axis and also in [{section}]: remove one", section, key
                    )
                quantity = QUANTITIES[key]
                value = convert(written, _kind(key), section, key)
                if isinstance(value, str):
                    value = self._portable(section, key, value)
                given[key] = float(value) if quantity.numeric else value
        return given

    def _aims(self, study: Study) -> ShowSettings:
        show = self._top.show
        numbers = [column.name for column in columns_of(study) if column.kind == "number"]
        if show.least not in numbers:
            hint = did_you_mean(show.least, numbers) or ":"
            raise Refusal(
                f"least is {show.least!r}{hint} use {' or '.join(numbers)}", "show", "least"
            )
        uncertain = (show.uncertain,) if isinstance(show.uncertain, str) else show.uncertain
        try:
            check_uncertain(uncertain, study.axis_names, tuple(study.points.sampled))
        except ValueError as error:
            raise Refusal(str(error), "show", "uncertain") from None
        return ShowSettings(show.least, uncertain)

    def _try_points(self, study: Study) -> None:
        """Try every value of every axis, the others at their first, to report errors before the run."""
        first: dict[str, Value] = {axis.name: axis.values[0] for axis in study.points.axes}
        first |= {name: low for name, (low, _) in study.points.sampled.items()}
        shared = dict(study.given)
        tried: list[tuple[str, dict[str, Value]]] = [("", {})]
        for axis in study.points.axes:
            ends = axis.values if axis.textual else (min(axis.values), max(axis.values))
            tried.extend((axis.name, {axis.name: value}) for value in ends)
        tried.extend(
            (name, {name: value}) for name, ends in study.points.sampled.items() for value in ends
        )
        for key, point in tried:
            try:
                check_point({**shared, **first, **point}, study)
            except ValueError as error:
                section, at = (
                    ("axes", key) if key else self._culprit(str(error), {**shared, **first}, study)
                )
                raise Refusal(str(error), section, *([at] if at else [])) from None

    def _culprit(
        self, sentence: str, values: dict[str, Value], study: Study
    ) -> tuple[str, str | None]:
        """The key named in an error message, else the key whose removal makes the point valid."""
        keys = [
            (section, key)
            for section in ("fixed", "models", "axes")
            for key in getattr(self._top, section)
        ]
        for section, key in keys:
            value = values[key]
            if re.search(rf"\b{re.escape(key)}\b", sentence) or (
                isinstance(value, str) and repr(value) in sentence
            ):
                return section, key
        for section, key in keys:
            with suppress(ValueError):
                check_point({name: value for name, value in values.items() if name != key}, study)
                return section, key
        return "axes", None


@dataclass(frozen=True)
class StudyFile:
    """A study and the text it was read from."""

    study: Study
    text: str
    path: str


def read_study(path: str | Path) -> StudyFile:
    """Read a study file, or one that comes with the package by its name. ValueError with one sentence."""
    path = Path(path)
    if 0 < len(path.name) < 200 and path.parent == Path() and not is_file(path):
        try:
            path = asset_path(f"studies/{path.name}")
        except FileNotFoundError:
            examples = ", ".join(sorted(path.name for path in asset_path("studies").glob("*.toml")))
            raise ValueError(
                f"study file {path.name!r} does not exist: give a TOML file, or an example of the package: {examples}"
            ) from None
    remedy = "give the path of a TOML file"
    text = read_text(path, "study file", remedy)
    with refusing(f"study file {shorten(str(path))!r}", remedy):
        return StudyFile(parse_study(text, str(path)), text, str(path))


def parse_study(text: str, name: str = "study.toml") -> Study:
    """The study of a file's text. ValueError with one sentence that names file, line, key and remedy."""
    file = f"study file {name!r}"
    with naming(file, text):
        return Reader(read_toml(file, text), name).study()

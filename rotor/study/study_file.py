"""Study files: TOML with axes, fixed values, models, sampling and optimum settings.

Every error is a ValueError with one sentence that names the file, the line, the value and the remedy.
"""

import math
import re
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast, get_args

from rotor.assets import SHIPPED_ROTORS, asset_path
from rotor.design.aircraft import Aircraft
from rotor.design.twist import inline_spec
from rotor.files.make_design import current_model, make_design
from rotor.files.rotor_file import find_aircraft
from rotor.files.toml_table import TomlTable, read_toml
from rotor.optimisation.objective import QUANTITIES as OBJECTIVES
from rotor.study.point import check_point
from rotor.study.study import (
    PLAIN,
    QUANTITIES,
    Method,
    OptimumSettings,
    Sample,
    ShowSettings,
    Study,
    StudyAxis,
    StudyPoints,
    Value,
    check_uncertain,
    columns_of,
    default_chunk,
)
from rotor.user_input import is_file, parse_range, read_text, refusing, shorten

_MANY = 10**10
_STEEPEST = 100.0
"""Twist rates beyond this [°/R] are an error of writing, as in `--twist`."""
_SECTIONS = ("axes", "fixed", "models", "sample", "optimum", "show")
"""The keys of the first three are names of quantities."""


class Reader:
    """Reads a study from the text of a file. ValueError with the line for whatever is wrong."""

    def __init__(self, text: str, name: str) -> None:
        self._name = name
        self._aircraft: dict[str, Aircraft] = {}
        top = read_toml(f"study file {name!r}", text)
        self._title = top.string("title", Path(name).stem)
        self._chunk = top.count("chunk", None, low=1, high=10**6)
        self._searched = top.has("optimum")
        self._sections: dict[str, TomlTable] = {
            section: top.table(section, None) or TomlTable(top.file, text, (section,), {}) for section in _SECTIONS
        }
        top.finish()

    def _wrong(self, section: str, key: str | None, sentence: str) -> ValueError:
        """The error for a key, or a section: the sentence with file and line."""
        return self._sections[section].fail(key, sentence)

    def study(self) -> Study:
        axes, ranges = self._axes()
        places = StudyPoints(axes, self._sample(ranges))
        if not axes and places.sample is None:
            raise self._wrong("axes", None, "the study has no axes: add for example mu = [0.1, 0.2, 0.3] to [axes]")
        given = self._given({axis.name for axis in axes} | {name for name, _, _ in ranges})
        searching = self._searching()
        if places.count > _MANY:
            raise self._wrong("axes", None, f"the study has {places.count:.3g} points: keep below {_MANY:.0e}")
        chunk = self._chunk or default_chunk(places.count, search=searching is not None)
        aircraft = tuple(self._aircraft.items())
        study = Study(self._title, places, tuple(given.items()), searching, chunk, ShowSettings(), aircraft)
        self._try_points(study)
        return replace(study, show=self._aims(study))

    def _axes(self) -> tuple[tuple[StudyAxis, ...], list[tuple[str, float, float]]]:
        axes: list[StudyAxis] = []
        ranges: list[tuple[str, float, float]] = []
        for key, value in self._sections["axes"].values.items():
            self._known("axes", key)
            if isinstance(value, dict):
                ranges.append((key, *self._range(key, cast(dict[str, Any], value))))
            else:
                axes.append(StudyAxis(key, self._listed(key, value)))
        return tuple(axes), ranges

    def _known(self, section: str, key: str) -> None:
        if key not in QUANTITIES:
            names = [
                name
                for name, quantity in QUANTITIES.items()
                if (quantity.kind != "switch" if section == "axes" else quantity.section == section)
            ]
            raise self._wrong(section, key, f"{key!r} is not a quantity of [{section}]: use one of {', '.join(names)}")
        if QUANTITIES[key].kind == "switch" and section == "axes":
            raise self._wrong(section, key, f"{key} cannot be an axis: set it in [models] and make two studies")

    def _listed(self, key: str, value: Any) -> tuple[float, ...] | tuple[str, ...]:
        """The values of an axis: a list, or a range written as a text."""
        how = 'give a list, a range such as "0.05:0.40:0.05", or { low = 0.1, high = 0.3 } to sample'
        if not QUANTITIES[key].numeric:
            if not isinstance(value, list) or not all(isinstance(text, str) for text in cast(list[Any], value)):
                raise self._wrong("axes", key, f'axis {key} is {value!r}: give a list of texts, as ["a", "b"]')
            values: list[Any] = [self._portable("axes", key, text) for text in cast(list[str], value)]
        elif isinstance(value, str):
            try:
                values = list(parse_range(value))
            except ValueError as error:
                raise self._wrong("axes", key, f"axis {key}: {error}") from None
        elif isinstance(value, list):
            values = cast(list[Any], value)
        else:
            raise self._wrong("axes", key, f"axis {key} is {value!r}: {how}")
        if not values:
            raise self._wrong("axes", key, f"axis {key} has no values: give one at least")
        for entry in values:
            if QUANTITIES[key].numeric and not _finite(entry):
                raise self._wrong("axes", key, f"axis {key} holds {entry!r}: {how}")
            self._check_size("axes", key, entry)
            if QUANTITIES[key].kind == "whole" and float(entry) % 1.0:
                raise self._wrong("axes", key, f"axis {key} holds {entry!r}: give whole numbers")
        if len(set(values)) < len(values):
            raise self._wrong("axes", key, f"axis {key} holds a value twice: remove one")
        return tuple(float(entry) for entry in values) if QUANTITIES[key].numeric else tuple(values)

    def _check_size(self, section: str, key: str, value: Any) -> None:
        """Parameters of a concept have no limits of their own; those of the other quantities are with the quantity."""
        if key not in PLAIN and abs(value) > _STEEPEST:
            raise self._wrong(section, key, f"{key} is {value:g}: give −{_STEEPEST:g}…{_STEEPEST:g}")

    def _portable(self, section: str, key: str, text: str) -> str:
        """The value without files, for other machines: reads a rotor file, inlines a twist table.

        In place of a retired model it is the one that stands in for it.
        """
        try:
            if key == "rotor" and text not in SHIPPED_ROTORS:
                beside = Path(self._name).parent / text
                self._aircraft[text] = find_aircraft(str(beside) if beside.is_file() else text)
            elif key == "twist" and "table:" in text:
                return inline_spec(make_design(twist=text).twist)
        except ValueError as error:
            raise self._wrong(section, key, str(error)) from None
        return current_model(key, text)

    def _range(self, key: str, value: dict[str, Any]) -> tuple[float, float]:
        low, high = value.get("low"), value.get("high")
        if not QUANTITIES[key].numeric or set(value) != {"low", "high"} or not (_finite(low) and _finite(high)):
            raise self._wrong("axes", key, f"axis {key} is {value!r}: give two numbers, {{ low = 0.1, high = 0.3 }}")
        if QUANTITIES[key].kind == "whole":
            raise self._wrong("axes", key, f"axis {key} takes whole numbers: give a list, as [20, 40]")
        for end in (low, high):
            self._check_size("axes", key, end)
        if not cast(float, low) < cast(float, high):
            raise self._wrong("axes", key, f"axis {key} runs from {low:g} to {high:g}: give the lower one first")
        return float(cast(float, low)), float(cast(float, high))

    def _sample(self, ranges: list[tuple[str, float, float]]) -> Sample | None:
        sample = self._sections["sample"]
        if not ranges:
            if sample.values:
                raise sample.fail(None, "[sample] has no range to sample: give an axis as { low = …, high = … }")
            return None
        if not sample.values:
            key = ranges[0][0]
            raise self._wrong("axes", key, f"axis {key} is a range: add [sample] with method and count")
        methods = get_args(Method)
        method = sample.string("method", methods[0], choices=methods)
        count, seed = sample.count("count", low=1, high=2**24), sample.count("seed", 0, low=0, high=2**31)
        sample.finish()
        return Sample(method, count, seed, tuple(ranges))

    def _given(self, varied: set[str]) -> dict[str, Value]:
        given: dict[str, Value] = {}
        for section in ("fixed", "models"):
            for key, value in self._sections[section].values.items():
                self._known(section, key)
                quantity = QUANTITIES[key]
                if quantity.section != section:
                    raise self._wrong(section, key, f"{key} is in [{section}]: move it to [{quantity.section}]")
                if key in varied:
                    raise self._wrong(section, key, f"{key} is an axis and also in [{section}]: remove one")
                if not quantity.holds(value) or (quantity.numeric and not _finite(value)):
                    raise self._wrong(section, key, f"{key} is {value!r}: give {quantity.wants}")
                self._check_size(section, key, value)
                if isinstance(value, str):
                    value = self._portable(section, key, value)
                given[key] = float(value) if quantity.numeric else value
        return given

    def _searching(self) -> OptimumSettings | None:
        if not self._searched:
            return None
        section, plain = self._sections["optimum"], OptimumSettings()
        rate = section.numbers("rate_deg", None, low=-_STEEPEST, high=_STEEPEST)
        if rate is not None and not (len(rate) == 2 and rate[0] < rate[1]):
            raise section.fail("rate_deg", f"rate_deg is {list(rate)}: give two numbers, as [-20, 0]")
        stalled = section.number("stalled_percent", None, low=0.0, high=100.0)
        settings = OptimumSettings(
            starts=section.count("starts", plain.starts, low=1, high=1000),
            seed=section.count("seed", plain.seed, low=0, high=2**31),
            objective=section.string("objective", plain.objective, choices=OBJECTIVES),
            rate=rate and (math.radians(rate[0]), math.radians(rate[1])),
            stalled=None if stalled is None else stalled / 100.0,
            index=section.number("index_percent", None, low=1e-6),
        )
        section.finish()
        return settings

    def _aims(self, study: Study) -> ShowSettings:
        show = self._sections["show"]
        numbers = [column.name for column in columns_of(study) if column.kind == "number"]
        least = show.string("least", ShowSettings.least, choices=numbers)
        uncertain = show.strings("uncertain", ())
        show.finish()
        try:
            check_uncertain(uncertain, study.axis_names, tuple(study.points.sampled))
        except ValueError as error:
            raise show.fail("uncertain", str(error)) from None
        return ShowSettings(least, uncertain)

    def _try_points(self, study: Study) -> None:
        """Try every value of every axis, the others at their first, to report errors before the run."""
        first: dict[str, Value] = {axis.name: axis.values[0] for axis in study.points.axes}
        first |= {name: low for name, (low, _) in study.points.sampled.items()}
        shared = dict(study.given)
        tried: list[tuple[str, dict[str, Value]]] = [("", {})]
        for axis in study.points.axes:
            ends = axis.values if axis.textual else (min(axis.values), max(axis.values))
            tried.extend((axis.name, {axis.name: value}) for value in ends)
        tried.extend((name, {name: value}) for name, ends in study.points.sampled.items() for value in ends)
        for key, point in tried:
            try:
                check_point({**shared, **first, **point}, study)
            except ValueError as error:
                section, at = ("axes", key) if key else self._culprit(str(error), {**shared, **first}, study)
                raise self._wrong(section, at, str(error)) from None

    def _culprit(self, sentence: str, values: dict[str, Value], study: Study) -> tuple[str, str | None]:
        """The key named in an error message, else the key whose removal makes the point valid."""
        keys = [(section, key) for section in ("fixed", "models", "axes") for key in self._sections[section].values]
        for section, key in keys:
            value = values[key]
            if re.search(rf"\b{re.escape(key)}\b", sentence) or (isinstance(value, str) and repr(value) in sentence):
                return section, key
        for section, key in keys:
            with suppress(ValueError):
                check_point({name: value for name, value in values.items() if name != key}, study)
                return section, key
        return "axes", None


def _finite(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


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
    return Reader(text, name).study()

"""A page that travels: one HTML file without server or network in which a design's twist can be dragged.

Its scripts evaluate the polynomials of `explorer.export.fitted`, and draw.
"""

import json
import math
from dataclasses import asdict, replace
from datetime import datetime
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from explorer import web
from explorer.charts.svg import HALF_EDGE, disk_marks
from explorer.colours import PARTS, VOID, colour_map
from explorer.export.figures import bar
from explorer.export.fitted import TOLERANCE, Family, Fitted, fitted
from explorer.export.provenance import PROGRAM, document_html
from explorer.model.inputs import ViewState, inputs_of
from explorer.model.units import SI, Units, number
from explorer.parts.results import LinePiece
from explorer.picture.blade_mesh import inset_places, inset_sections
from explorer.picture.fields import FIELDS, Field, fitted_range
from explorer.picture.picture import field_values, flown_twist
from explorer.picture.plan import outline, packed, reverse_flow_segments
from explorer.picture.polar import CLEAR_OF_REVERSE, DrawnSolution, PolarGrid, polar_grid
from explorer.text.design_words import flight_words, model_words, title_words
from explorer.text.line import (
    blade_pieces,
    carried_layout,
    carrying_pieces,
    control,
    flight_pieces,
    sentence,
)
from explorer.text.readout import fineness, part_titles
from rotor import Solution
from rotor.design import TwistLaw
from rotor.support.arrays import Array
from rotor.support.markup import Markup, group, tag
from rotor.trim.doubt import LEAST_REPORTED, LIKELY, MOST_DECIMALS, MOST_OF_SMALL, SURE

_FIELDS = "Angle of attack", "Induced inflow λi", "Thrust dT/dr"
_GRID = 36, 120
"""Radii and azimuths of the fields; in between the page interpolates."""
_SCRIPTS = "common.js", "disk.js", "live.js", "inset.js", "report.js"
_VIEW = ViewState()


def live_html(solution: Solution, units: Units = SI) -> str:
    """The file's text; ValueError with one sentence for a design whose twist cannot be taken along."""
    made = fitted(solution)
    design = solution.design
    drawn = [_FittedField(made, FIELDS[name]) for name in _FIELDS if FIELDS[name].exists(solution)]
    content = group(
        tag(
            "section.live",
            tag("div.seen", _rotor(made, drawn, units)),
            tag("div.held", _sliders(made), _card(made)),
        ),
        tag("p.note", _accuracy(made, drawn[0], units)),
        web.json_block("model", _model(made, drawn, units)),
        tag(
            "details",
            tag("summary", "Design file"),
            tag("p.dim", flight_words(design, units), tag("br"), model_words(design)),
            tag("pre", json.dumps(design.to_dict(), indent=1, ensure_ascii=False)),
        ),
    )
    validity = (
        "Numbers here come from polynomials through trimmed designs, with the error stated above."
    )
    title, line, when = title_words(design), sentence(solution, units), datetime.now().astimezone()
    return document_html(
        title, solution, line, content, validity, when, ("report.css", "live.css"), _SCRIPTS
    )


class _FittedField:
    """A field over the disk as polynomials."""

    def __init__(self, made: Fitted, field: Field) -> None:
        self.field = field
        values = field_values(made.solution, field)
        self.range = (
            (field.low, field.high) if field.void_in_reverse_flow else fitted_range(field, values)
        )
        low, high = self.range
        # What lies far beyond the colours, as α in reverse flow, is not followed.
        width = high - low
        self.table = made.fit(lambda one: np.clip(_sample(one, field), low - width, high + width))

    def error(self, made: Fitted) -> float:
        """Root mean square over the disk and the tested twists, in the field's unit."""
        squares = []
        for x, trim in zip(made.tested_x, made.tested, strict=True):
            solution = trim.solution
            inside = DrawnSolution(solution).flow(_grid(solution)).u_t > CLEAR_OF_REVERSE
            squares.append(
                np.mean(
                    (made.at(self.table, x[None])[0] - _sample(solution, self.field))[inside] ** 2
                )
            )
        return math.sqrt(float(np.mean(squares)))


def _grid(solution: Solution) -> PolarGrid:
    return polar_grid(solution.disk, *_GRID)


def _sample(solution: Solution, field: Field) -> Array:
    return field.sample(DrawnSolution(solution), _grid(solution))


def _rotor(made: Fitted, drawn: list[_FittedField], units: Units) -> Markup:
    """Disk, scale and inset."""
    tabs = [
        tag("button", one.field.title, type="button", data_field=k) for k, one in enumerate(drawn)
    ]
    lines = outline(reverse_flow_segments(made.solution))
    reverse = "".join(
        "M" + "L".join(f"{100 * x:.1f} {100 * y:.1f}" for x, y in line) for line in lines
    )
    marks = tag("path.reverse", d=reverse) + tag("path.stall")
    box = f"{-HALF_EDGE:g} {-HALF_EDGE:g} {2 * HALF_EDGE:g} {2 * HALF_EDGE:g}"
    over = tag(
        "svg",
        marks,
        disk_marks(made.solution, 9.0, units),
        viewBox=box,
        role="img",
        aria_label="The disk",
    )
    regions = (("stall", "separated"), *([("reverse", "reverse flow")] if lines else []))
    key = [tag("span", tag("i", class_=name), title) for name, title in regions]
    bars = [
        tag("div", bar(one.field, one.range, f"bar-{k}"), data_scale=k)
        for k, one in enumerate(drawn)
    ]
    return group(
        tag("div.tabs", tabs),
        tag("figure.plan", tag("canvas", aria_hidden="true"), over),
        tag("div.below", tag("div.scale", bars), tag("p.key", key)),
        tag("div.inset", data_part="inset"),
    )


def _sliders(made: Fitted) -> Markup:
    rows = []
    for k, one in enumerate(made.family.handles):
        label, _, unit = one.form.label.partition(" [")
        form, id = one.form, f"handle-{k}"
        rows.append(
            tag(
                "div.slider",
                tag("label", label, for_=id),
                tag("output", for_=id, data_unit=unit.rstrip("]")),
                tag(
                    "input",
                    id=id,
                    type="range",
                    min=form.low,
                    max=form.high,
                    step=form.step,
                    value=one.value,
                ),
                tag(
                    "small",
                    tag("span", number(form.low, form.digits)),
                    tag("span", number(form.high, form.digits)),
                ),
            )
        )
    buttons = (
        tag("button", "As shared", type="button", data_to="shared"),
        tag("button", "Least power in these ranges", type="button", data_to="best"),
    )
    return group(tag("h2", made.family.title), rows, tag("div.tabs", buttons))


def _card(made: Fitted) -> Markup:
    titles = part_titles(made.solution.design)
    rows = [
        tag(
            "tr",
            tag("td", tag("i", style=f"background:{PARTS[name]}"), title),
            tag("td"),
            tag("td"),
            data_part=name,
        )
        for name, title in titles.items()
    ]
    bars = [tag("i", style=f"background:{PARTS[name]}", data_bar=name) for name in titles]
    return tag(
        "article.card",
        tag("h3", "Power"),
        tag("div.big", tag("b", data_live="total"), tag("span", data_live="band")),
        tag("p.change", data_live="change", aria_live="polite"),
        tag("div.bar", bars),
        tag("table", rows),
    )


def _line(made: Fitted, units: Units) -> list[tuple[str, int | None]]:
    """Words before the power, each piece with the slider whose number it is."""
    design = made.solution.design
    inputs = inputs_of(design)
    names = [one.name for one in made.family.handles]
    carried = design.rotor.blade.carried
    if carried is not None:
        drives = _drive_pieces(made.family, carried_layout(carried))
        pieces = flight_pieces(inputs, units, carried.aircraft_kg)
        pieces += carrying_pieces(inputs, design.bare, drives)
    else:
        pieces = flight_pieces(inputs, units)
        if inputs.law == "builtin":
            # Its changes are named although they are zero.
            inputs = replace(inputs, **{names[0]: 1.0})
        pieces += blade_pieces(inputs, design)
    controls = [piece.control.name if piece.control else "" for piece in pieces]
    return [
        (piece.text, names.index(name) if name in names else None)
        for piece, name in zip(pieces, controls, strict=True)
    ]


def _drive_pieces(family: Family, layout: str) -> list[LinePiece]:
    """The actuator with its drives as controls: ` with MFC P1 at 77, 50 %`."""
    pieces = [LinePiece(f" with {family.title}{layout} at ")]
    for k, one in enumerate(family.handles):
        pieces += [LinePiece(", ")] if k else []
        pieces.append(control(one.name, one.form, one.value))
    unit = family.handles[0].form.label.partition("[")[2].rstrip("]")
    return [*pieces, LinePiece(f" {unit}")]


def _accuracy(made: Fitted, angle: _FittedField, units: Units) -> Markup:
    unit, errors = units.power[0], (made.error, float(made.errors.max()), float(made.errors.mean()))
    stated, worst, mean = (number(math.ceil(100.0 * unit.of(error)) / 100.0, 2) for error in errors)
    return group(
        f"This file computes with polynomials that {PROGRAM} fitted to {len(made.trims)} trims and their exact "
        "gradients. Its power is within ",
        tag("b", f"{stated} {unit.symbol}", data_live="error"),
        f" of a trim: at {len(made.tested)} other twists within the sliders, corners included, it was off by "
        f"{worst} {unit.symbol} at most and {mean} {unit.symbol} on average, the angle of attack by "
        f"{number(angle.error(made), 2)}° (root mean square). The sliders end before this exceeds "
        f"{100.0 * TOLERANCE:g} % of power. ± is the uncertainty of the model; that of a change holds the mean square "
        "of this error, too.",
        " The power of the drive is not included."
        if made.solution.design.rotor.blade.carried is not None
        else "",
    )


def _model(made: Fitted, drawn: list[_FittedField], units: Units) -> dict[str, Any]:
    """What the scripts read: coefficients of terms, the sliders scaled to −1…1."""
    solution, unit = made.solution, units.power[0]
    inputs, family = inputs_of(solution.design), made.family
    grid, least = _grid(solution), unit.of(0.01 * LEAST_REPORTED * abs(solution.power.total))
    power, change = (unit.of(1.0) * rows.T for rows in made.doubts)
    error = unit.of(math.sqrt(float(np.mean(made.errors**2))))
    best, _ = made.best
    flow = DrawnSolution(solution).flow(grid).u_t.astype(np.float64)
    return {
        "handles": [
            {"centre": one.centre, "half": one.half, "digits": one.form.digits, "shared": one.value, "best": value,
             "sign": inputs.law == "builtin" and "°" in one.form.label}
            for one, value in zip(family.handles, best, strict=True)
        ],
        "exponents": made.exponents.tolist(),
        "line": _line(made, units),
        "unit": unit.symbol,
        "digits": fineness(solution.power, units),
        "longest": unit.of(max(1.0, *map(float, _most(made)))),
        "power": {name: _short(unit.of(1.0) * rows) for name, rows in made.power.items()},
        "doubt": {"power": list(map(_short, power)), "change": list(map(_short, change)), "least": least,
                  "error": error, "decimals": (MOST_DECIMALS, MOST_OF_SMALL),
                  "words": [[SURE, "sure"], [LIKELY, "likely"], [0.0, "unclear"]]},
        "inset": _inset(made),
        "disk": {
            "radii": _GRID[0], "azimuths": _GRID[1], "root": solution.design.rotor.blade.root_cutout,
            "clear": CLEAR_OF_REVERSE, "none": bytes(VOID).hex(), "flow": asdict(packed(flow)),
            "stall": asdict(packed(made.fit(lambda one: DrawnSolution(one).flow(_grid(one)).attached))),
            "fields": [
                {"low": one.range[0], "high": one.range[1], "void": one.field.void_in_reverse_flow,
                 "map": colour_map(one.field.colours, 256).tobytes().hex(), "table": asdict(packed(one.table))}
                for one in drawn
            ],
        },
    }  # fmt: skip


def _inset(made: Fitted) -> dict[str, Any]:
    """The blade as shared, which is the overlay, and coefficients of the twist of each station and section [°]."""
    solution, psi = made.solution, math.radians(_VIEW.azimuth_deg)
    rotor, twist = solution.design.rotor, flown_twist(solution, psi)
    places = np.concatenate(inset_places(rotor))
    named, family = "this blade" if solution.elastic is None else "in flight", made.family

    def pieces(law: TwistLaw, r: ArrayLike) -> Array:
        """What is straight between the breaks [°]; the page interpolates it, for a polynomial would round its kinks."""
        bent = law(r) - (family.base(r) if family.base else 0.0)
        return np.degrees(bent) if family.breaks else 0.0 * bent

    of = made.fit(
        lambda one: np.degrees(flown_twist(one, psi)(places)) - pieces(one.design.twist, places)
    )
    ends = [[0.0, *(family.numbers(x)[k] for k in family.breaks), 1.0] for x in made.x]
    knots = [
        pieces(trim.solution.design.twist, r) for r, trim in zip(ends, made.trims, strict=True)
    ]
    return {
        **asdict(inset_sections(rotor, twist, twist, _VIEW.exaggeration)),
        "name": named, "name_hint": "", "overlay_name": "as shared", "overlay_hint": "",
        "twist": list(map(_short, of.T)), "breaks": family.breaks,
        "knots": list(map(_short, made.fit_to(np.array(knots) - np.array(knots)[:, -1:]).T)),
    }  # fmt: skip


def _most(made: Fitted) -> list[float]:
    """Total powers, of which the largest fills the bar [W]."""
    return [trim.solution.power.total for trim in (*made.trims, *made.tested)]


def _short(values: Array) -> list[float]:
    return [float(f"{value:.7g}") for value in values]

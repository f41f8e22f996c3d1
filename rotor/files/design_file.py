"""Design files: the choices behind a `Design` as JSON that a person can read and edit. `Design.save` writes them.

`rotor` names a shipped rotor, or contains the text of a user's own rotor files, so that the design file is complete.
"""

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Annotated, Any, Literal, cast

import msgspec

from rotor.aero.inflow import inflow_model
from rotor.aero.problem import check_azimuths
from rotor.design.active_twist import read_active_twist
from rotor.design.aircraft import Aircraft
from rotor.design.blade import Carried
from rotor.design.design import FORMAT, VERSION, Design, with_grid
from rotor.design.quantities import ARGUMENTS, BY_KEY, OPTIONS, SPEED, SWITCHES
from rotor.design.quantity import Quantity
from rotor.design.twist import SumTwist
from rotor.dynamics.structure import carrying, check_blade
from rotor.files.declared import BY_KIND, FileTable, convert
from rotor.files.make_design import make_design
from rotor.files.rotor_file import LARGEST_FILE, find_aircraft, read_aircraft, shipped_aircraft
from rotor.support.assets import SHIPPED_ROTORS
from rotor.support.user_input import read_bytes, refusing, shorten

_GRID = ("elements", "azimuths")
_MODELS = tuple(BY_KEY[key] for key in ("inflow", "hover_inflow", *SWITCHES, *OPTIONS))
"""Keys that are fields of `Models`."""
_ARGUMENTS = tuple(row for row in BY_KEY.values() if row.name in ARGUMENTS and row not in _MODELS)
"""Keys that are arguments of `make_design`."""
_BESIDE = ("format", "version", "solution", "actuator")
"""Keys that are no quantities; `solution` holds the results that `save_solution` adds, which are not read back."""
_READ_LATER = ("twist_per_rev", "pitch_per_rev", "rotor", "stand", "active_twist", *_BESIDE)
"""Keys whose values are checked where they are read."""


def _declared(row: Quantity) -> Any:
    """The type of a quantity in a file."""
    return Literal[row.choices] if row.kind == "choice" else BY_KIND[row.kind]


_FIELDS = [
    (key, Any if key in _READ_LATER else _declared(BY_KEY[key]), None)
    for key in (*BY_KEY, *_BESIDE)
]
_Record = msgspec.defstruct("_Record", _FIELDS, bases=(FileTable,))


class _ActuatorRecord(FileTable, frozen=True, kw_only=True):
    """An actuator in a file, as `Carried`."""

    name: Annotated[str, msgspec.Meta(max_length=80)]
    spec: Annotated[str, msgspec.Meta(max_length=400)]
    aircraft_kg: Annotated[float, msgspec.Meta(ge=0.0, le=2000.0)]
    blade_kg: Annotated[float, msgspec.Meta(ge=0.0, le=500.0)]
    span_m: tuple[float, float]
    inertia_kg_m: Annotated[float, msgspec.Meta(ge=0.0, le=10.0)]
    added_gj_nm2: Annotated[float, msgspec.Meta(ge=-1e7, le=1e7)]
    gj_factor: float
    sourced: bool = False


def read_rotor_record(record: Any, *, paths: bool = False) -> Aircraft:
    """The aircraft that `Aircraft.record` describes; with `paths`, a text may also be the path of a rotor file.

    Raises ValueError with one sentence for any other record.
    """
    if isinstance(record, str):
        return find_aircraft(record) if paths else shipped_aircraft(record)
    try:
        main, files = record["main"], record["files"]
        texts = {str(name): "".join(f"{line}\n" for line in lines) for name, lines in files.items()}
        if main not in texts or sum(map(len, texts.values())) > LARGEST_FILE:
            raise KeyError(main)
    except (KeyError, TypeError, AttributeError):
        raise ValueError(
            f"design file key 'rotor' does not name or hold a rotor: write one of {', '.join(SHIPPED_ROTORS)}, "
            'or {"main": "my.toml", "files": {"my.toml": ["line", …]}}'
        ) from None
    return read_aircraft(main, texts)


def design_from_record(record: dict[str, Any], *, paths: bool = False) -> Design:
    """The design of a record; keys it leaves out take the preset's values. `paths` as in `read_rotor_record`.

    Raises ValueError with one sentence for a key or a value that it cannot use.
    """
    kind = record.get("format", FORMAT), record.get("version", VERSION)
    if kind != (FORMAT, VERSION):
        raise ValueError(
            f"design file is {kind[0]!r} version {kind[1]!r}: this program reads {FORMAT!r} version {VERSION}"
        )
    if (speed := next((name for name in SPEED if name in record), None)) is not None:
        raise ValueError(
            f"unknown key {speed!r}: write advance_ratio, the speed over that of the blade tip"
        )
    given = convert(record, _Record)
    aircraft = read_rotor_record(record.get("rotor", SHIPPED_ROTORS[0]), paths=paths)
    stand = record.get("stand")
    if not isinstance(stand, dict | None):
        raise ValueError(
            f'design file key \'stand\' is {stand!r}: write {{"shaft_tilt_deg": 5, "ct_over_sigma": 0.08}}'
        )
    asked = {row.name: getattr(given, row.key) for row in _ARGUMENTS if row.key in record}
    asked["rotor"] = aircraft
    # May be too fine for the preset's inflow.
    grid = {name: asked.pop(name) for name in _GRID if name in asked}
    design = make_design(**{name: value for name, value in asked.items() if value != ""})
    changed = {row.field: getattr(given, row.key) for row in _MODELS if row.key in record}
    models = with_grid(replace(design.models, **changed), **grid)
    inflow_model(models.inflow)
    if "active_twist" in record:
        if design.active_twist is not None:
            raise ValueError(
                "design file has both 'active_twist' and 'twist_per_rev', which mean the same: keep one"
            )
        design = replace(design, active_twist=read_active_twist(record["active_twist"]))
    design = replace(design, models=models)
    if (carried := record.get("actuator")) is not None:
        design = _with_carried(design, carried)
    check_azimuths(design)
    return design


def _with_carried(design: Design, record: Any) -> Design:
    """The design with the actuator of a record, whose mass on board is in the design's own."""
    carried = convert(record, _ActuatorRecord, "actuator")
    inner, outer = carried.span_m
    if (
        not 0.0 < inner < outer <= 1.001 * design.rotor.radius
        or not 0.1 <= carried.gj_factor <= 2.0
    ):
        raise ValueError(
            f"design file key 'actuator' has span_m {inner:g}…{outer:g} and gj_factor {carried.gj_factor:g}: give a "
            "span on the blade and a factor of 0.1 to 2"
        )
    check_blade(design.aircraft)
    values = Carried(**{field.name: getattr(carried, field.name) for field in fields(Carried)})
    if isinstance(design.twist, SumTwist) and "drive=" in carried.spec:  # A SPEC has no name.
        design = replace(design, twist=replace(design.twist, name=carried.name))
    return replace(design, rotor=carrying(design.rotor, values, elastic=design.elastic))


def load_design(path: str | Path) -> Design:
    """Read a design file, as `Design.save`, `rotor.save_solution` and the page write it.

    Raises ValueError when it cannot be used; the sentence names the file, the key and the remedy.
    """
    name, remedy = shorten(str(path)), "give the path of a JSON design file"
    content = read_bytes(path, "design file", remedy)
    with refusing(f"design file {name!r}", remedy):
        return _named(_record(content, name), name, paths=True)


def parse_design(content: bytes, name: str) -> Design:
    """The design in an uploaded file, which may not name files of this machine; ValueError for any other content."""
    name = shorten(name)
    with refusing(f"design file {name!r}", "give a JSON design file"):
        record = _record(content, name)
        if "table:" in str(record.get("twist", "")):
            raise ValueError(
                f"design file {name!r} has a twist table of another machine: write its rows as points:…@…"
            )
        return _named(record, name)


def _named(record: dict[str, Any], name: str, *, paths: bool = False) -> Design:
    """The design as of `design_from_record`, with the file's name in the message, since several may be read at once."""
    try:
        return design_from_record(record, paths=paths)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def _record(content: bytes, name: str) -> dict[str, Any]:
    try:
        record = json.loads(content)
    except UnicodeDecodeError:
        raise ValueError(
            f"design file {name!r} cannot be read (not UTF-8 text): give a JSON design file"
        ) from None
    except json.JSONDecodeError as error:
        where = (
            f"line {error.lineno}, column {error.colno}: {error.msg}"
            if content.strip()
            else "it is empty"
        )
        raise ValueError(
            f"design file {name!r} is not JSON ({where}): give a JSON design file"
        ) from None
    except ValueError:
        raise ValueError(
            f"design file {name!r} holds an integer of thousands of digits: check the values"
        ) from None
    if not isinstance(record, dict):
        raise ValueError(
            f'design file {name!r} is not a JSON object: write {{"twist": "linear:-8", …}}'
        )
    return cast(dict[str, Any], record)

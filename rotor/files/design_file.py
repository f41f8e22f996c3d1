"""Design files: the choices behind a `Design` as JSON that a person can read and edit. `Design.save` writes them.

`rotor` names a shipped rotor, or contains the text of a user's own rotor files, so that the design file is complete.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

from rotor.aero.inflow import inflow_model
from rotor.aero.switches import SWITCHES
from rotor.assets import SHIPPED_ROTORS
from rotor.design.active_twist import read_active_twist
from rotor.design.aircraft import Aircraft
from rotor.design.design import FORMAT, VERSION, Design
from rotor.files.make_design import change_airfoils, make_design
from rotor.files.rotor_file import LARGEST_FILE, find_aircraft, read_aircraft, shipped_aircraft

READS = (1, VERSION)
"""Version 1 had no `rotor`: its designs are of the UH-60A."""

_KEYS = (
    "format",
    "version",
    "rotor",
    "preset",
    "twist",
    "advance_ratio",
    "mass_kg",
    "altitude_m",
    "inflow",
    *SWITCHES,
    "airfoils",
    "active_twist",
    "solution",
)
"""`solution` holds the results that `Solution.save` adds; they are not read back."""


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
    unknown = sorted(set(record) - set(_KEYS))
    if unknown:
        raise ValueError(f"design file has the unknown key {unknown[0]!r}: the keys are {', '.join(_KEYS)}")
    if record.get("format", FORMAT) != FORMAT or record.get("version", VERSION) not in READS:
        raise ValueError(
            f"design file is {record.get('format')!r} version {record.get('version')!r}: this program reads "
            f"{FORMAT!r} version {' and '.join(map(str, READS))}"
        )
    preset = _text(record, "preset", "flight")
    twist = _text(record, "twist", "")
    design = make_design(
        preset=preset,
        rotor=read_rotor_record(record.get("rotor", SHIPPED_ROTORS[0]), paths=paths),
        twist=twist or None,
        mu=_number(record, "advance_ratio", 0.2),
        mass_kg=_number(record, "mass_kg", None),
        altitude_m=_number(record, "altitude_m", 0.0),
    )
    inflow = _text(record, "inflow", design.models.inflow)
    inflow_model(inflow)
    models = replace(
        design.models,
        inflow=inflow,
        **{name: _flag(record, name, getattr(design.models, name)) for name in SWITCHES},
    )
    airfoils = _text(record, "airfoils", "")
    rotor = change_airfoils(design.rotor, airfoils) if airfoils else design.rotor
    active_twist = read_active_twist(record["active_twist"]) if "active_twist" in record else None
    return replace(design, models=models, rotor=rotor, active_twist=active_twist)


def load_design(path: str | Path) -> Design:
    """Read a design file; ValueError with one sentence when it cannot be used."""
    path = Path(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise ValueError(f"design file {str(path)!r} does not exist: give the path of a JSON design file") from None
    except OSError as error:
        raise ValueError(f"design file {str(path)!r} cannot be read ({error}): give a JSON design file") from None
    return _named(_record(content, str(path)), str(path), paths=True)


def parse_design(content: bytes, name: str) -> Design:
    """The same for the content of an uploaded file, which may not name files of this machine."""
    record = _record(content, name)
    if "table:" in str(record.get("twist", "")):
        raise ValueError(f"design file {name!r} names a twist table of another machine: write its rows as points:…@…")
    return _named(record, name)


def _named(record: dict[str, Any], name: str, *, paths: bool = False) -> Design:
    """As `design_from_record`, with the name of the file in the message, since several may be read at once."""
    try:
        return design_from_record(record, paths=paths)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def _record(content: bytes, name: str) -> dict[str, Any]:
    try:
        record = json.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ValueError(f"design file {name!r} cannot be read ({error}): give a JSON design file") from None
    if not isinstance(record, dict):
        raise ValueError(f'design file {name!r} is not a JSON object: write {{"twist": "linear:-8", …}}')
    return cast(dict[str, Any], record)


def _number(record: dict[str, Any], key: str, default: Any) -> Any:
    value = record.get(key, default)
    if value is default or (isinstance(value, (int, float)) and not isinstance(value, bool)):
        return value
    raise ValueError(f"design file key {key!r} is {value!r}: give a number")


def _text(record: dict[str, Any], key: str, default: str) -> str:
    value = record.get(key, default)
    if isinstance(value, str):
        return value
    raise ValueError(f"design file key {key!r} is {value!r}: give a text")


def _flag(record: dict[str, Any], key: str, default: bool) -> bool:
    value = record.get(key, default)
    if isinstance(value, bool):
        return value
    raise ValueError(f"design file key {key!r} is {value!r}: give true or false")

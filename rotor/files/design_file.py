"""Design files: the choices behind a `Design` as JSON that a person can read and edit. `Design.save` writes them.

`rotor` names a shipped rotor, or contains the text of a user's own rotor files, so that the design file is complete.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

from rotor.aero.inflow import inflow_model
from rotor.aero.switches import SWITCHES
from rotor.airfoil.polynomial import THESIS_NAME
from rotor.assets import SHIPPED_ROTORS
from rotor.design.active_twist import read_active_twist
from rotor.design.aircraft import Aircraft
from rotor.design.design import FORMAT, VERSION, Design, with_grid
from rotor.files.make_design import BEFORE_LOSS_ON, Tell, current_model, make_design, warn
from rotor.files.rotor_file import LARGEST_FILE, find_aircraft, read_aircraft, shipped_aircraft
from rotor.user_input import read_bytes, refusing, shorten

_LARGEST_NUMBER = 1e12
"""No quantity of a design is larger; JSON has integers of any length. NaN is refused with the range of its quantity."""
_KINDS: dict[type, tuple[str, Any]] = {
    float: ("a number", int | float), int: ("a whole number", int), str: ("a text", str), bool: ("true or false", bool),
}  # fmt: skip
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
    "climb_m_s",
    "inflow",
    "hover_inflow",
    "low_speed",
    "loss_on",
    *SWITCHES,
    "bending",
    "dynamic_stall",
    "elements",
    "azimuths",
    "airfoils",
    "active_twist",
    "twist_per_rev",
    "pitch_per_rev",
    "trim",
    "stand",
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


def design_from_record(record: dict[str, Any], *, paths: bool = False, tell: Tell = warn) -> Design:
    """The design of a record; keys it leaves out take the preset's values. `paths` as in `read_rotor_record`.

    `tell` gets a sentence where the record names a model that was retired; another one stands in for it.
    Raises ValueError with one sentence for a key or a value that it cannot use.
    """
    unknown = sorted(set(record) - set(_KEYS))
    if unknown:
        raise ValueError(f"design file has the unknown key {unknown[0]!r}: the keys are {', '.join(_KEYS[2:-1])}")
    if record.get("format", FORMAT) != FORMAT or record.get("version", VERSION) not in READS:
        raise ValueError(
            f"design file is {record.get('format')!r} version {record.get('version')!r}: this program reads "
            f"{FORMAT!r} version {' and '.join(map(str, READS))}"
        )
    preset = _value(record, "preset", "flight")
    twist = _value(record, "twist", "")
    aircraft = read_rotor_record(record.get("rotor", SHIPPED_ROTORS[0]), paths=paths)
    if preset == "thesis" and "version" in record and "loss_on" not in record:
        record = {"loss_on": "lift"} | ({"airfoils": THESIS_NAME} if aircraft.stated else {}) | record
        tell(BEFORE_LOSS_ON)
    stand = record.get("stand")
    if not isinstance(stand, dict | None):
        raise ValueError(
            f'design file key \'stand\' is {stand!r}: write {{"shaft_tilt_deg": 5, "ct_over_sigma": 0.08}}'
        )
    design = make_design(
        preset=preset,
        rotor=aircraft,
        twist=twist or None,
        twist_per_rev=record.get("twist_per_rev"),
        pitch_per_rev=record.get("pitch_per_rev"),
        mu=_value(record, "advance_ratio", 0.2),
        mass_kg=_value(record, "mass_kg", None, float),
        altitude_m=_value(record, "altitude_m", 0.0),
        climb_m_s=_value(record, "climb_m_s", 0.0),
        low_speed=_value(record, "low_speed", "") or None,
        loss_on=_value(record, "loss_on", "") or None,
        airfoils=_value(record, "airfoils", "") or None,
        trim=_value(record, "trim", "") or None,
        stand=cast(dict[str, Any] | None, stand),
    )
    named = {
        option: current_model(option, _value(record, option, getattr(design.models, option)), tell)
        for option in ("inflow", "hover_inflow")
    }
    inflow_model(named["inflow"])
    switches = ("bending", "dynamic_stall", *SWITCHES)
    models = replace(
        design.models, **named, **{name: _value(record, name, getattr(design.models, name)) for name in switches}
    )
    if "active_twist" in record:
        if design.active_twist is not None:
            raise ValueError("design file has both 'active_twist' and 'twist_per_rev', which are one thing: keep one")
        design = replace(design, active_twist=read_active_twist(record["active_twist"]))
    models = with_grid(models, _value(record, "elements", None, int), _value(record, "azimuths", None, int))
    return replace(design, models=models)


def load_design(path: str | Path) -> Design:
    """Read a design file; ValueError with one sentence when it cannot be used.

    Where it names a model that was retired, a warning says what stands in for it.
    """
    name, remedy = shorten(str(path)), "give the path of a JSON design file"
    content = read_bytes(path, "design file", remedy)
    with refusing(f"design file {name!r}", remedy):
        return _named(_record(content, name), name, warn, paths=True)


def parse_design(content: bytes, name: str, tell: Tell = warn) -> Design:
    """The same for the content of an uploaded file, which may not name files of this machine.

    `tell` as in `design_from_record`.
    """
    name = shorten(name)
    with refusing(f"design file {name!r}", "give a JSON design file"):
        record = _record(content, name)
        if "table:" in str(record.get("twist", "")):
            raise ValueError(
                f"design file {name!r} names a twist table of another machine: write its rows as points:…@…"
            )
        return _named(record, name, tell)


def _named(record: dict[str, Any], name: str, tell: Tell, *, paths: bool = False) -> Design:
    """As `design_from_record`, with the name of the file in the message, since several may be read at once."""
    try:
        return design_from_record(record, paths=paths, tell=tell)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def _record(content: bytes, name: str) -> dict[str, Any]:
    try:
        record = json.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ValueError(f"design file {name!r} cannot be read ({error}): give a JSON design file") from None
    except ValueError:
        raise ValueError(f"design file {name!r} holds an integer of thousands of digits: check the values") from None
    if not isinstance(record, dict):
        raise ValueError(f'design file {name!r} is not a JSON object: write {{"twist": "linear:-8", …}}')
    return cast(dict[str, Any], record)


def _value(record: dict[str, Any], key: str, default: Any, kind: type | None = None) -> Any:
    """A value of the record, or the default; ValueError for one of another kind, which is by default that of the
    default."""
    value, (what, types) = record.get(key, default), _KINDS[kind or type(default)]
    fits = isinstance(value, types) and isinstance(value, bool) == (types is bool)
    if value is default or (fits and not (isinstance(value, int | float) and abs(value) >= _LARGEST_NUMBER)):
        return value
    raise ValueError(f"design file key {key!r} is {value!r}: give {what}")

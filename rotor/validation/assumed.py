"""Which inputs of the shipped aircraft are assumed or recalled, and whether the band of power holds them.

Grades are read from the comments of the rotor files, `key = value  # A  why`: table and files cannot differ.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rotor.design.uncertain import uncertain_inputs
from rotor.files.make_design import make_design
from rotor.support.assets import asset_path, toml_asset

AIRCRAFT = {
    "uh60a": "UH-60A",
    "gazelle": "SA349/2 Gazelle",
    "bo105": "Bo 105",
    "s61": "Sikorsky S-61",
    "r22": "Robinson R22",
}
"""Titles of the shipped aircraft, by name."""
UNSOURCED = {"A": "assumed", "R": "recalled"}
"""Grades without a source, and what they mean."""
IN_BAND = {
    "hover_download": "download_percent",
    "control_stiffness_nm_rad": "control_stiffness_percent",
    "section": "section_lift_percent",
}
"""Uncertain input of `assets/doubt.toml` that holds an input of a rotor file."""
_TABLES_IN_BAND = {"tail_rotor": "tail_rotor_percent"}
"""Uncertain input of `assets/doubt.toml` that holds all inputs of a table."""
_WORDS = {
    "root_cutout_r": "root cut-out",
    "chord_m": "chord",
    "reference_chord_m": "reference chord",
    "section": "section",
    "linear_twist_deg": "twist",
    "flap_hinge_m": "flap hinge",
    "blade_mass_kg": "blade mass",
    "speed_rpm": "rotor speed",
    "radius_m": "radius",
    "mass_kg": "mass of the aircraft",
    "hover_download": "download",
    "control_stiffness_nm_rad": "control-system stiffness",
    "lag_damper_nm_s_rad": "lag damper",
    "pitch_horn_m": "pitch horn",
}
_FLOWN_TABLES = ("main_rotor", "tail_rotor", "airframe", "blade")
"""Tables of rotor and structure files with inputs of the flying aircraft; `document` is the blade of the thesis."""


@dataclass(frozen=True)
class AssumedInput:
    """An input of a shipped aircraft without a source."""

    table: str
    """Table of the file that has it."""
    key: str
    grade: str
    """Of `UNSOURCED`."""

    @property
    def words(self) -> str:
        """Name and grade, for example `tail rotor chord (recalled)`."""
        name = _WORDS[self.key]
        if self.table == "tail_rotor":
            name = f"tail rotor {name.removeprefix('rotor ')}"
        return f"{name} ({UNSOURCED[self.grade]})"

    @property
    def uncertain_input(self) -> str | None:
        """Name of the uncertain input that holds it in the band of power; None where none does."""
        return _TABLES_IN_BAND.get(self.table) or IN_BAND.get(self.key)


def assumed_inputs(aircraft: str) -> tuple[AssumedInput, ...]:
    """The inputs of a shipped aircraft without a source, in the order of its files."""
    main = toml_asset(f"{aircraft}.toml")["main_rotor"]
    files = [f"{aircraft}.toml"]
    if "structure" in main:
        files.append(f"{main['structure']}_structure.toml")
    return tuple(each for file in files for each in _unsourced(file))


def assumed_table() -> str:
    """The table of the trust page, in Markdown: every aircraft with its assumed inputs in the band and not in it."""
    rows = [
        (
            "Aircraft",
            "Drag area",
            "Without a source, in the band",
            "Without a source, not in the band",
        )
    ]
    for name, title in AIRCRAFT.items():
        inputs = assumed_inputs(name)
        inside = [each.words for each in inputs if each.uncertain_input]
        outside = [each.words for each in inputs if not each.uncertain_input]
        rows.append((title, _drag_area(name), ", ".join(inside), ", ".join(outside)))
    head, *lines = (f"| {' | '.join(row)} |" for row in rows)
    return "\n".join((head, "|---|---|---|---|", *lines))


def _unsourced(file: str) -> Iterator[AssumedInput]:
    """The inputs without a source in a rotor or structure file, from lines `key = value  # A  why`."""
    table = ""
    for line in asset_path(file).read_text(encoding="utf-8").splitlines():
        heading = re.match(r"\[([\w.]+)\]", line)
        if heading:
            table = heading[1]
        graded = re.match(r"(\w+) = .*?# ([A-Z])\b", line)
        if graded is None or table not in _FLOWN_TABLES:
            continue
        key, grade = graded.groups()
        if grade in UNSOURCED:
            yield AssumedInput(table, key, grade)


def _drag_area(name: str) -> str:
    """Drag area with its band, for example `1.27 m² ± 65 %`."""
    design = make_design(rotor=name)
    (row,) = (row for row in uncertain_inputs(design) if row.name == "drag_area_percent")
    return f"{design.fuselage.drag_area:.2f} m² ± {row.size:.0f} %"

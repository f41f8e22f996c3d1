"""Rotor files: an aircraft as TOML with the unit in every key's name. The format: docs/rotor_file.md.

The shipped files in `assets/` are read by the same code. Errors name file, line, value and remedy.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from rotor.airfoil.polynomial import THESIS_NAME
from rotor.airfoil.sections import TABLE_NAMES, OwnSection
from rotor.design.aircraft import SEA_LEVEL_DENSITY, Aircraft, DocumentRotor, Fuselage, RotorFiles
from rotor.design.blade import Blade, BladeStructure, Rotor, Span
from rotor.dynamics.structure import uh60a_torsion
from rotor.files.declared import Place, Refusal, check_bounds, convert, naming, read_toml
from rotor.files.rotor_tables import (
    LOCK_NUMBER,
    BladeTable,
    DoubtTable,
    MainRotorTable,
    StructureTable,
    TopTable,
    angular_speed,
)
from rotor.files.section_file import OwnSectionTable, check_section_name, read_section
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS, asset_path
from rotor.support.units import GRAVITY
from rotor.support.user_input import did_you_mean, is_file, read_text, refusing, shorten

ISOLATED_LOADING = 0.07
"""C_T/σ that a rotor without an airframe carries unless a test says otherwise."""
LARGEST_FILE = 2_000_000
"""[bytes], of a rotor file or of a file it names; a deck has about 40 000."""
MOST_SECTIONS = 12
"""Sections of its own that a blade may use: each takes time to build."""
MOST_TABLES = 24
"""Tables that they may have together, one for each Reynolds number: each is large."""
MOST_NAMED = 40
"""Files that the sections in use may name."""
_LONGEST, _LONGEST_LINE = 200_000, 20_000
"""Characters of a rotor file and of a line of it."""
_MOST_DOTS = 100
"""A dotted name takes the square of its length to read."""
_MAIN = ("main_rotor",)


@dataclass(frozen=True)
class RotorFile:
    """The tables of a rotor file."""

    top: TopTable
    main: MainRotorTable
    sections: dict[str, OwnSectionTable]
    """Sections of its own that a span uses, in the order of the file."""

    @property
    def named(self) -> list[str]:
        """The files that the sections name."""
        return list(
            dict.fromkeys(file for section in self.sections.values() for file in section.named)
        )


def read_tables(file: str, text: str) -> RotorFile:
    """A rotor file without the files that it names. ValueError with one sentence that names file, line and remedy."""
    if len(text) > _LONGEST:
        raise ValueError(
            f"{file} has {len(text):,} characters: a rotor file has {_LONGEST:,} at most"
        )
    for number, line in enumerate(text.splitlines(), start=1):
        if len(line) > _LONGEST_LINE:
            raise ValueError(
                f"{file}, line {number}: {len(line):,} characters: break lines of {_LONGEST_LINE:,}"
            )
        if any(part.count(".") > _MOST_DOTS for part in re.split("[,=]", line)):
            raise ValueError(
                f"{file}, line {number}: a name has more than {_MOST_DOTS} dots: shorten it"
            )
    values = read_toml(file, text)
    with naming(file, text):
        top = convert(values, TopTable)
        main = convert(top.main_rotor, MainRotorTable, *_MAIN)
        rotor = RotorFile(
            top, main, _sections(top, [main, *([main.document] if main.document else [])])
        )
        if len(rotor.named) > MOST_NAMED:
            raise Refusal(
                f"the sections in use name {len(rotor.named)} files: {MOST_NAMED} are allowed",
                "sections",
            )
        return rotor


def _sections(top: TopTable, blades: list[BladeTable]) -> dict[str, OwnSectionTable]:
    """The tables of `sections` that a span names."""
    used = {blade.section for blade in blades} | {
        span.section for blade in blades for span in blade.spans or ()
    }
    for name in top.sections:
        check_section_name(name)
    names = [name for name in top.sections if name in used]
    if len(names) > MOST_SECTIONS:
        raise Refusal(
            f"the blade uses {len(names)} sections of its own: {MOST_SECTIONS} are allowed",
            "sections",
        )
    return {name: convert(top.sections[name], OwnSectionTable, "sections", name) for name in names}


def read_aircraft(main: str, texts: Mapping[str, str], key: str = "") -> Aircraft:
    """The aircraft of the rotor file `main`, with the texts by file name; `key` is the name of a shipped one.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    file = read_tables(main, texts[main])
    top, airframe, remarks = file.top, file.top.airframe, list[str]()
    used = {main: texts[main]}
    if spare := [name for name in top.sections if name not in file.sections]:
        more = f" and {len(spare) - 1} more" if len(spare) > 1 else ""
        remarks.append(
            f"Section {shorten(spare[0])}{more} is left out: no span of the blade uses it."
        )
    with naming(main, texts[main]):
        sections = tuple[OwnSection, ...]()
        for name, table in file.sections.items():
            sections = (*sections, read_section(table, name, texts, used, remarks))
            if sum(max(len(section.decks), 1) for section in sections) > MOST_TABLES:
                says = f"the sections of the blade have polars of more than {MOST_TABLES} Reynolds numbers"
                raise Refusal(f"{says}: keep fewer", "sections", name)
        rotor = _rotor(top.name, file.main, sections, key or "builtin")
        if not (rotor.blade.rigid or file.main.weighed or file.main.flap_inertia_kg_m2):
            remarks.append(
                f"The rotor file has no blade_mass_kg: the blades flap with Lock number {LOCK_NUMBER:g}; hover power "
                "does not depend on it."
            )
        if (rate := file.main.linear_twist_deg or 0.0) > 0.0:
            remarks.append(
                f"The twist rises by {rate:g} deg a radius: for washout write linear_twist_deg = {-rate:g}."
            )
        stated, document = None, file.main.document
        if document is not None:
            blade = _blade(file.main, document, (*_MAIN, "document"), sections)
            stated = DocumentRotor(replace(rotor, blade=blade), document.twist("document"))
        controls = top.controls.range() if top.controls else None
        doubt = msgspec.structs.asdict(convert(top.doubt, DoubtTable, "doubt"))
        fuselage = (
            Fuselage(airframe.drag_area_m2, airframe.hover_download, airframe.band())
            if airframe
            else Fuselage(0.0)
        )
    return Aircraft(
        name=top.name,
        rotor=rotor,
        fuselage=fuselage,
        mass=airframe.mass_kg if airframe else _carried(rotor),
        installed_power=1e3 * airframe.installed_power_kw
        if airframe and airframe.installed_power_kw
        else None,
        controls=controls,
        tail_rotor=top.tail_rotor.rotor() if top.tail_rotor else None,
        hub=file.main.hub,
        stated=stated,
        key=key,
        files=None if key else RotorFiles(main, tuple(sorted(used.items()))),
        remarks=tuple(remarks),
        doubt=tuple((name, size) for name, size in doubt.items() if size is not None),
        isolated=airframe is None,
    )


def _carried(rotor: Rotor) -> float:
    """Mass [kg] that a rotor carries at `ISOLATED_LOADING` and sea level."""
    thrust = (
        ISOLATED_LOADING * rotor.solidity * SEA_LEVEL_DENSITY * rotor.disk_area * rotor.tip_speed**2
    )
    return thrust / GRAVITY


def _rotor(
    name: str, main: MainRotorTable, sections: tuple[OwnSection, ...], twist_name: str
) -> Rotor:
    hub, precone = main.hub, main.precone_deg
    blade = _blade(main, main, _MAIN, sections)
    sprung = main.flap_spring_nm_rad is not None
    if precone is not None and not sprung and hub not in ("gimballed", "hingeless", "teetering"):
        says = f"precone_deg on a hub that is {hub!r}"
        raise Refusal(f"{says}: its blades cone freely, so leave it out", *_MAIN, "precone_deg")
    fixed = not sprung and (hub in ("gimballed", "hingeless") or precone is not None)
    return Rotor(
        name=name,
        blade=blade,
        blades=main.blades,
        radius=main.radius_m,
        angular_speed=angular_speed(main),
        reference_chord=main.reference_chord_m or float(blade.chord(0.75)),
        builtin_twist=main.twist(twist_name),
        precone=math.radians(precone or 0.0) if fixed else None,
    )


def _blade(
    main: MainRotorTable, given: BladeTable, at: Place, sections: tuple[OwnSection, ...]
) -> Blade:
    radius, hinge, spring = main.radius_m, given.flap_hinge_m, given.flap_spring_nm_rad
    check_bounds(hinge, 0.0, 0.3 * radius, *at, "flap_hinge_m", given=f"radius_m = {radius:g}")
    sprung = main.hub in ("articulated", "hingeless")
    if hinge and not sprung:
        says = f"flap_hinge_m is {hinge:g} on a {main.hub} hub"
        raise Refusal(f"{says}, which has its hinge at the shaft: write 0", *at, "flap_hinge_m")
    if spring is not None and not sprung:
        says = f"flap_spring_nm_rad on a hub that is {main.hub!r}"
        raise Refusal(f"{says}: write articulated or hingeless", *at, "flap_spring_nm_rad")
    structure = _structure(given, at, radius)
    if spring is None and main.hub == "hingeless" and structure is not None and structure.bends:
        says = f"[{'.'.join(map(str, at))}] has no flap_spring_nm_rad"
        raise Refusal(
            f"{says}: a hingeless blade with bending stiffness also needs it, for use without bending",
            *at,
        )
    stations = given.chord_r or (main.root_cutout_r, 1.0)
    mass, inertia, moment = given.masses(radius - hinge, radius)
    return Blade(
        root_cutout=main.root_cutout_r,
        chord_stations=stations,
        chords=given.chords_at(stations),
        spans=_spans(given, at, main.root_cutout_r, sections),
        flap_hinge=hinge / radius,
        flap_inertia=inertia,
        flap_static_moment=moment,
        mass=mass,
        flap_spring=spring or 0.0,
        flap_rest=0.0 if spring is None else math.radians(main.precone_deg or 0.0),
        hingeless=main.hub == "hingeless",
        tip_sweep=math.radians(given.tip_sweep_deg),
        tip_sweep_start=given.tip_sweep_start_r or 1.0,
        surface_drag=given.surface_drag,
        own_sections=sections,
        structure=structure,
    )


def _structure(given: BladeTable, at: Place, radius: float) -> BladeStructure | None:
    """The table `structure`, or the shipped structure that a text names; None where the file has neither."""
    table = given.structure
    if not isinstance(table, StructureTable):
        return uh60a_torsion(radius) if table else None
    clamp = given.flap_hinge_m if table.clamp is None else table.clamp
    check_bounds(
        clamp, 0.0, 0.5 * radius, *at, "structure", "clamp_m", given=f"radius_m = {radius:g}"
    )
    given_fields: dict[str, Any] = msgspec.structs.asdict(table) | {"clamp": clamp}
    return BladeStructure(radius=radius, **given_fields)


def _spans(
    given: BladeTable, at: Place, root: float, sections: tuple[OwnSection, ...]
) -> tuple[Span, ...]:
    names = (*(each.name for each in sections), *TABLE_NAMES)
    spans = [((), Span(root, 1.0, given.section))] if given.section else []
    spans += [
        (("spans", k), Span(each.start_r, each.end_r, each.section))
        for k, each in enumerate(given.spans or ())
    ]
    for place, span in spans:
        if span.section not in names and not span.section.startswith(f"{THESIS_NAME}:"):
            raise Refusal(
                f"section {span.section!r} is not known: use one of {', '.join(names)}, "
                f"or add a table [sections.{span.section}] that names its deck or polars",
                *(*at, *place, "section"),
            )
    return tuple(span for _, span in spans)


@cache
def shipped_aircraft(name: str) -> Aircraft:
    """A shipped aircraft, or a shipped rotor of a test; ValueError for any other name."""
    known = (*SHIPPED_ROTORS, *MEASURED_ROTORS)
    if name not in known:
        hint = did_you_mean(name, known) or ":"
        raise ValueError(
            f"rotor {name!r} is not known{hint} use {', '.join(known)}, or the path of a rotor file (.toml)"
        )
    file = f"{name}.toml"
    path = asset_path(file if name in SHIPPED_ROTORS else f"rotors/{file}")
    return read_aircraft(file, {file: path.read_text(encoding="utf-8")}, key=name)


def find_aircraft(name: str, *, allow_outside: bool = False) -> Aircraft:
    """The aircraft of a shipped rotor's name or of the path of a rotor file; ValueError with one sentence otherwise.

    `allow_outside` as in `load_rotor`.
    """
    if name in (*SHIPPED_ROTORS, *MEASURED_ROTORS) or not (
        "." in name or "/" in name or is_file(name)
    ):
        return shipped_aircraft(name)
    return load_rotor(name, allow_outside=allow_outside)


def load_rotor(path: str | Path, *, allow_outside: bool = False) -> Aircraft:
    """Read a rotor file and the section files that it names.

    Parameters:
        path: the rotor file (docs/rotor_file.md).
        allow_outside: whether it may name files outside its own folder. A file from somebody else should not: saved
            designs contain what it names.

    Returns:
        The aircraft, for `make_design(rotor=…)`.

    Raises:
        ValueError: a file cannot be used; the sentence names file, line and remedy.
    """
    path = Path(path)
    with refusing(f"rotor file {shorten(path.name)!r}", "check its values, see docs/rotor_file.md"):
        remedy = "give a shipped rotor's name, or a text file of 2 MB at most"
        texts = {path.name: read_text(path, "rotor file", remedy, LARGEST_FILE)}
        rotor = read_tables(path.name, texts[path.name])
        for name in rotor.named:
            beside = path.parent / name
            if not is_file(beside):
                continue
            if not allow_outside and not beside.resolve().is_relative_to(path.parent.resolve()):
                raise ValueError(
                    f"{path.name} names {shorten(name)!r}, outside its folder: copy it there, or give --allow-outside"
                )
            remedy = "save it as a UTF-8 text file of 2 MB at most"
            texts[name] = read_text(beside, "section file", remedy, LARGEST_FILE)
        return read_aircraft(path.name, texts)

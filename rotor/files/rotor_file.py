"""Rotor files: an aircraft as TOML with the unit in every key's name. The format: docs/rotor_file.md.

The shipped files in `assets/` are read by the same code. Errors name file, line, value and remedy.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any, cast

from rotor.airfoil.polynomial import THESIS_NAME
from rotor.airfoil.sections import TABLE_NAMES, OwnSection
from rotor.assets import MEASURED_ROTORS, SHIPPED_ROTORS, asset_path
from rotor.design.aircraft import (
    HUBS,
    SEA_LEVEL_DENSITY,
    Aircraft,
    ControlRange,
    Fuselage,
    Hub,
    RotorFiles,
    Stated,
    TailRotor,
)
from rotor.design.blade import Blade, BladeStructure, Rotor, Span
from rotor.design.twist import LinearTwist, TableTwist, TwistLaw
from rotor.design.uncertain import UNCERTAIN
from rotor.dynamics.structure import KNOWN_BLADE, uh60a_torsion
from rotor.files.section_file import check_section_name, read_section
from rotor.files.toml_table import TomlTable, read_toml
from rotor.units import GRAVITY
from rotor.user_input import did_you_mean, is_file, read_text, refusing, shorten

BAILEY_POLAR = (0.0087, -0.0216, 0.4)
"""c_d = δ0 + δ1 α + δ2 α² of Bailey, NACA Report 716 (1941): used for tail rotors without a polar."""
LIFT_SLOPE = 5.73
"""[1/rad], used for tail rotors without a lift slope."""

_NAME = r"[\w .,'()+/-]{1,40}"
"""A name appears in menus and tables."""
LARGEST_FILE = 2_000_000
"""[bytes], of a rotor file or of a file it names; a deck has about 40 000."""


MOST_SECTIONS = 12
"""Sections of its own that a blade may use: each takes some 0.1 s to build."""
MOST_NAMED = 40
"""Files that the sections in use may name."""


_LONGEST, _LONGEST_LINE = 200_000, 20_000
"""Characters of a rotor file and of a line of it."""
_MOST_DOTS = 100
"""A dotted name takes the square of its length to read: 8000 dots on each of eleven lines took 18 s."""


def rotor_toml(file: str, text: str) -> TomlTable:
    """The top table of a rotor file; ValueError with one sentence for one too long, or that is not TOML."""
    if len(text) > _LONGEST:
        raise ValueError(f"{file} has {len(text):,} characters: a rotor file has {_LONGEST:,} at most")
    for number, line in enumerate(text.splitlines(), start=1):
        if len(line) > _LONGEST_LINE:
            raise ValueError(f"{file}, line {number}: {len(line):,} characters: break lines of {_LONGEST_LINE:,}")
        if any(part.count(".") > _MOST_DOTS for part in re.split("[,=]", line)):
            raise ValueError(f"{file}, line {number}: a name has more than {_MOST_DOTS} dots: shorten it")
    return read_toml(file, text)


def named_files(top: TomlTable) -> list[str]:
    """The files of the sections in use, even where the rest of a rotor file has errors.

    Raises ValueError with one sentence for too many.
    """
    names: list[str] = []
    sections = _as_table(top.values.get("sections"))
    for section in _in_use(top):
        for key in ("deck", "polars", "outline"):
            value: Any = _as_table(sections.get(section)).get(key, [])
            names += [item for item in _as_list(value) if isinstance(item, str)]
    names = list(dict.fromkeys(names))
    if len(names) > MOST_NAMED:
        raise top.fail("sections", f"the sections in use name {len(names)} files: {MOST_NAMED} are allowed")
    return names


def _in_use(top: TomlTable) -> list[str]:
    """Tables of `sections` that a span of the main rotor names, in the order of the file."""
    main = _as_table(top.values.get("main_rotor"))
    used: set[str] = set()
    for given in (main, *(_as_table(main.get(key)) for key in ("flown", "document"))):
        spans = [_as_table(span).get("section") for span in _as_list(given.get("spans", []))]
        used |= {name for name in (given.get("section"), *spans) if isinstance(name, str)}
    sections = [name for name in _as_table(top.values.get("sections")) if name in used]
    if len(sections) > MOST_SECTIONS:
        raise top.fail("sections", f"the blade uses {len(sections)} sections of its own: {MOST_SECTIONS} are allowed")
    return sections


def _as_table(value: Any) -> dict[str, Any]:
    return cast(dict[str, Any], value) if isinstance(value, dict) else {}


def _as_list(value: Any) -> list[Any]:
    return cast(list[Any], value) if isinstance(value, list) else [value]


def read_aircraft(main: str, texts: Mapping[str, str], key: str = "") -> Aircraft:
    """The aircraft of the rotor file `main`, with the texts by file name; `key` is the name of a shipped one.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    top = rotor_toml(main, texts[main])
    name = top.string("name")
    if not re.fullmatch(_NAME, name):
        raise top.fail("name", f"name is {name[:60]!r}: use 1 to 40 letters, digits, blanks and . , ' ( ) + / -")
    remarks: list[str] = []
    used = {main: texts[main]}
    sections = _own_sections(top, texts, used, remarks)
    rotor_table = top.table("main_rotor")
    hub: Hub = rotor_table.string("hub", "articulated", choices=HUBS)
    flown = rotor_table.table("flown", None)
    rotor = _rotor(name, rotor_table, flown or rotor_table, sections, key or "builtin", hub)
    stated = _stated(name, rotor_table, rotor, sections, hub)
    tail = top.table("tail_rotor", None)
    airframe = top.table("airframe", None)
    aircraft = Aircraft(
        name=name,
        rotor=rotor,
        fuselage=_fuselage(airframe) if airframe else Fuselage(0.0),
        mass=airframe.number("mass_kg", low=100.0, high=50_000.0, unit="kg") if airframe else _carried(rotor),
        installed_power=_installed_power(airframe),
        controls=_controls(top.table("controls", None)),
        tail_rotor=_tail_rotor(tail) if tail else None,
        hub=hub,
        stated=stated,
        key=key,
        files=None if key else RotorFiles(main, tuple(sorted(used.items()))),
        remarks=tuple(remarks),
        doubt=_doubt(top.table("doubt", None)),
        isolated=airframe is None,
    )
    if flown:
        flown.finish()
    if airframe:
        airframe.finish()
    rotor_table.finish()
    top.finish()
    return aircraft


ISOLATED_LOADING = 0.07
"""C_T/σ that a rotor without an airframe carries unless a test says otherwise."""


def _fuselage(airframe: TomlTable) -> Fuselage:
    area = airframe.number("drag_area_m2", low=0.0, high=50.0, unit="m²")
    band = None
    if airframe.has("drag_area_low_m2") or airframe.has("drag_area_high_m2"):
        band = (
            airframe.number("drag_area_low_m2", low=0.0, high=area, unit="m²"),
            airframe.number("drag_area_high_m2", low=area, high=50.0, unit="m²"),
        )
    return Fuselage(area, airframe.number("hover_download", 0.0, low=0.0, high=0.3), band)


def _doubt(given: TomlTable | None) -> tuple[tuple[str, float], ...]:
    """Sizes of uncertain inputs, by the names of `assets/doubt.toml`."""
    if given is None:
        return ()
    sizes = {row.name: given.number(row.name, None, low=0.0, high=row.largest, unit=row.unit) for row in UNCERTAIN}
    given.finish()
    return tuple((name, size) for name, size in sizes.items() if size is not None)


def _installed_power(airframe: TomlTable | None) -> float | None:
    if not airframe or not airframe.has("installed_power_kw"):
        return None
    return 1e3 * airframe.number("installed_power_kw", low=1.0, high=50_000.0, unit="kW")


def _controls(given: TomlTable | None) -> ControlRange | None:
    if given is None:
        return None
    ends: list[tuple[float, float]] = []
    for key in ("collective_deg", "lateral_deg", "longitudinal_deg"):
        stops = given.numbers(key, low=-60.0, high=60.0)
        if len(stops) != 2 or stops[0] >= stops[1]:
            raise given.fail(key, f"{key} is {list(stops)}: write both stops, the lower first, for example [-8.0, 8.0]")
        ends.append((math.radians(stops[0]), math.radians(stops[1])))
    phase = math.radians(given.number("phase_deg", 0.0, low=-90.0, high=90.0, unit="°"))
    given.finish()
    return ControlRange(*ends, phase=phase)


def _carried(rotor: Rotor) -> float:
    """Mass [kg] that a rotor carries at `ISOLATED_LOADING` and sea level."""
    thrust = ISOLATED_LOADING * rotor.solidity * SEA_LEVEL_DENSITY * rotor.disk_area * rotor.tip_speed**2
    return thrust / GRAVITY


def _rotor(
    name: str, main: TomlTable, given: TomlTable, sections: tuple[OwnSection, ...], twist_name: str, hub: Hub
) -> Rotor:
    radius = main.number("radius_m", low=0.1, high=30.0, unit="m")
    blades = main.count("blades", low=2, high=12)
    if hub.startswith("teetering") and blades != 2:
        raise main.fail(
            "hub", f"hub is {hub!r} with {blades} blades: a teetering hub has two blades, so write articulated"
        )
    if hub == "gimballed" and blades < 3:
        raise main.fail("hub", f"hub is {hub!r} with {blades} blades: with two blades write teetering")
    precone = None
    if hub == "gimballed" or main.has("precone_deg"):
        precone = math.radians(main.number("precone_deg", 0.0, low=-10.0, high=20.0, unit="°"))
    sprung = hub == "hingeless" or (hub == "articulated" and given.has("flap_spring_nm_rad"))
    if precone is not None and not sprung and hub not in ("gimballed", "teetering"):
        raise main.fail("precone_deg", f"precone_deg on a hub that is {hub!r}: its blades cone freely, so leave it out")
    blade = _blade(main, given, radius, sections, hub)
    chord = float(blade.chord(0.75))
    return Rotor(
        name=name,
        blade=blade,
        blades=blades,
        radius=radius,
        angular_speed=_angular_speed(main, radius),
        reference_chord=main.number("reference_chord_m", chord, low=0.005, high=3.0, unit="m"),
        builtin_twist=_twist(given, twist_name),
        precone=None if sprung else precone,
    )


def _stated(name: str, main: TomlTable, flown: Rotor, sections: tuple[OwnSection, ...], hub: Hub) -> Stated | None:
    document = main.table("document", None)
    if document is None:
        return None
    blade = _blade(main, document, flown.radius, sections, hub)
    twist = _twist(document, "document")
    document.finish()
    return Stated(replace(flown, name=name, blade=blade), twist)


def _angular_speed(main: TomlTable, radius: float) -> float:
    given = [key for key in ("angular_speed_rad_s", "speed_rpm", "tip_speed_m_s") if main.has(key)]
    if len(given) > 1:
        raise main.fail(given[1], f"{given[0]} and {given[1]} both set the rotor speed: keep one of them")
    if main.has("speed_rpm"):
        return main.number("speed_rpm", low=10.0, high=10_000.0, unit="rpm") * math.pi / 30.0
    if main.has("tip_speed_m_s"):
        return main.number("tip_speed_m_s", low=20.0, high=340.0, unit="m/s") / radius
    return main.number("angular_speed_rad_s", low=1.0, high=1000.0, unit="rad/s")


def _blade(main: TomlTable, given: TomlTable, radius: float, sections: tuple[OwnSection, ...], hub: Hub) -> Blade:
    root = main.number("root_cutout_r", low=0.02, high=0.8, unit="r/R")
    hinge = given.number("flap_hinge_m", 0.0, low=0.0, high=0.3 * radius, unit="m")
    if hub not in ("articulated", "hingeless") and hinge:
        raise given.fail(
            "flap_hinge_m",
            f"flap_hinge_m is {hinge:g} on a {hub} hub, which has its hinge at the shaft: write 0",
        )
    chords = given.numbers("chord_m", low=0.005, high=3.0)
    stations = given.numbers("chord_r", (root, 1.0) if len(chords) == 1 else (), low=0.0, high=1.0)
    if len(chords) == 1:
        chords = chords * len(stations)
    _ascending(given, "chord_r", stations, "chord_m", chords)
    sprung = hub == "hingeless" or given.has("flap_spring_nm_rad")
    if sprung and hub not in ("articulated", "hingeless"):
        raise given.fail(
            "flap_spring_nm_rad", f"flap_spring_nm_rad on a hub that is {hub!r}: write articulated or hingeless"
        )
    mass, inertia, moment = _masses(given, radius - hinge)
    sweep = given.number("tip_sweep_deg", 0.0, low=-60.0, high=60.0, unit="°")
    return Blade(
        root_cutout=root,
        chord_stations=stations,
        chords=chords,
        spans=_spans(given, root, sections),
        flap_hinge=hinge / radius,
        flap_inertia=inertia,
        flap_static_moment=moment,
        mass=mass,
        flap_spring=given.number("flap_spring_nm_rad", low=0.0, high=1e8, unit="N m/rad") if sprung else 0.0,
        flap_rest=math.radians(main.number("precone_deg", 0.0, low=-10.0, high=20.0, unit="°")) if sprung else 0.0,
        hingeless=hub == "hingeless",
        tip_sweep=math.radians(sweep),
        tip_sweep_start=given.number("tip_sweep_start_r", *(() if sweep else (1.0,)), low=0.3, high=1.0, unit="r/R"),
        surface_drag=given.number("surface_drag", 1.0, low=0.5, high=3.0),
        own_sections=sections,
        structure=_structure(given, radius, hinge),
    )


def _structure(given: TomlTable, radius: float, hinge: float) -> BladeStructure | None:
    """The table `structure`, or the shipped structure that a text names; None where the file has neither."""
    if not given.has("structure"):
        return None
    if isinstance(given.values["structure"], str):
        given.string("structure", choices=(KNOWN_BLADE,))
        return uh60a_torsion(radius)
    table: TomlTable = given.table("structure")
    stations = table.numbers("r_m", low=0.0, high=30.0)
    columns = {
        key: table.numbers(key, low=low, high=high)
        for key, low, high in (("gj_nm2", 1e-3, 1e9), ("mass_kg_m", 1e-3, 1e4), ("torsional_inertia_kg_m", 1e-9, 1e3))
    }
    bending = [key for key in ("flap_stiffness_nm2", "lag_stiffness_nm2") if table.has(key)]
    if len(bending) == 1:
        raise table.fail(bending[0], f"{bending[0]} alone: give flap_stiffness_nm2 and lag_stiffness_nm2, or neither")
    columns |= {key: table.numbers(key, low=1e-3, high=1e10) for key in bending}
    if table.has("mass_offset_m"):
        columns["mass_offset_m"] = table.numbers("mass_offset_m", low=-1.0, high=1.0)
    for key, values in columns.items():
        _ascending(table, "r_m", stations, key, values)
    structure = BladeStructure(
        radius=radius,
        stations=stations,
        torsional_stiffness=columns["gj_nm2"],
        mass_per_length=columns["mass_kg_m"],
        torsional_inertia=columns["torsional_inertia_kg_m"],
        tension_gyration=table.number("tension_gyration_m2", 0.0, low=0.0, high=1.0, unit="m²"),
        clamp=table.number("clamp_m", hinge, low=0.0, high=0.5 * radius, unit="m"),
        control_stiffness=table.number("control_stiffness_nm_rad", low=1e-3, high=1e12, unit="N m/rad"),
        pitch_horn=table.number("pitch_horn_m", low=1e-3, high=2.0, unit="m"),
        flap_stiffness=columns.get("flap_stiffness_nm2", ()),
        lag_stiffness=columns.get("lag_stiffness_nm2", ()),
        lag_damper=table.number("lag_damper_nm_s_rad", 0.0, low=0.0, high=1e6, unit="N m s/rad"),
        lag_spring=table.number("lag_spring_nm_rad", low=0.0, high=1e8, unit="N m/rad")
        if table.has("lag_spring_nm_rad")
        else None,
        mass_offset=columns.get("mass_offset_m", ()),
    )
    table.finish()
    return structure


def _masses(given: TomlTable, length: float) -> tuple[float, float, float]:
    """Mass, flap inertia and static moment about the hinge; those of a uniform blade where only its mass is given."""
    if given.has("mass_per_length_kg_m"):
        mass = given.number("mass_per_length_kg_m", low=0.05, high=200.0, unit="kg/m") * length
    else:
        mass = given.number("blade_mass_kg", low=0.1, high=2000.0, unit="kg")
    # A uniform blade from the hinge outward: eqs. (2.35), (2.37).
    return (
        mass,
        given.number("flap_inertia_kg_m2", mass * length**2 / 3.0, low=1e-3, high=1e6, unit="kg m²"),
        given.number("flap_static_moment_kg_m", mass * length / 2.0, low=1e-3, high=1e5, unit="kg m"),
    )


def _spans(given: TomlTable, root: float, sections: tuple[OwnSection, ...]) -> tuple[Span, ...]:
    if given.has("section"):
        return (Span(root, 1.0, _known(given, given.string("section"), sections)),)
    spans: list[Span] = []
    for table in given.tables("spans", '{ start_r = 0.2, end_r = 1.0, section = "naca0012" }'):
        section = _known(table, table.string("section"), sections)
        start, end = (table.number(name, low=0.0, high=1.0, unit="r/R") for name in ("start_r", "end_r"))
        if start >= end or (spans and start < spans[-1].end):
            raise table.fail(
                "start_r",
                f"span of {section} runs {start:g}…{end:g}: write the spans in ascending order, not overlapping",
            )
        table.finish()
        spans.append(Span(start, end, section))
    return tuple(spans)


def _known(table: TomlTable, section: str, sections: tuple[OwnSection, ...]) -> str:
    if (
        section in TABLE_NAMES
        or section.startswith(f"{THESIS_NAME}:")
        or any(section == known.name for known in sections)
    ):
        return section
    raise table.fail(
        "section",
        f"section {section!r} is not known: use one of {', '.join((*(each.name for each in sections), *TABLE_NAMES))}, "
        f"or add a table [sections.{section}] that names its deck or polars",
    )


def _twist(given: TomlTable, name: str) -> TwistLaw:
    if given.has("linear_twist_deg"):
        return LinearTwist(math.radians(given.number("linear_twist_deg", low=-60.0, high=60.0, unit="° per radius")))
    stations = given.numbers("twist_r", low=0.0, high=1.0)
    angles = given.numbers("twist_deg", low=-60.0, high=60.0)
    _ascending(given, "twist_r", stations, "twist_deg", angles)
    return TableTwist(stations, tuple(math.radians(angle) for angle in angles), name=name)


def _ascending(table: TomlTable, place: str, stations: tuple[float, ...], key: str, values: tuple[float, ...]) -> None:
    if len(stations) != len(values) or len(stations) < 2:
        raise table.fail(key, f"{place} has {len(stations)} and {key} {len(values)} values: give one each, two or more")
    for low, high in pairwise(stations):
        if low >= high:
            raise table.fail(place, f"{place} goes from {low:g} to {high:g}: write the stations in ascending order")


def _tail_rotor(tail: TomlTable) -> TailRotor:
    radius = tail.number("radius_m", low=0.05, high=10.0, unit="m")
    chord = tail.number("chord_m", low=0.005, high=2.0, unit="m")
    polar = tail.numbers("drag_polar", BAILEY_POLAR, low=-10.0, high=10.0)
    if len(polar) != 3 or polar[0] <= 0.0:
        raise tail.fail("drag_polar", f"drag_polar is {list(polar)}: give δ0 > 0, δ1 and δ2 of δ0 + δ1 α + δ2 α²")
    rotor = TailRotor(
        radius=radius,
        angular_speed=_angular_speed(tail, radius),
        chord=chord,
        blades=tail.count("blades", low=2, high=20),
        arm=tail.number("arm_m", low=0.5, high=40.0, unit="m"),
        cant=math.radians(tail.number("cant_deg", 0.0, low=-60.0, high=60.0, unit="°")),
        tip_loss=tail.number("tip_loss", 1.0 - 0.5 * chord / radius, low=0.5, high=1.0),
        drag_polar=(polar[0], polar[1], polar[2]),
        lift_slope=tail.number("lift_slope_per_rad", LIFT_SLOPE, low=1.0, high=10.0, unit="1/rad"),
    )
    tail.finish()
    return rotor


def _own_sections(
    top: TomlTable, texts: Mapping[str, str], used: dict[str, str], remarks: list[str]
) -> tuple[OwnSection, ...]:
    sections = top.table("sections", None)
    if sections is None:
        return ()
    for name in sections.values:
        check_section_name(sections.table(name), name)
    in_use = _in_use(top)
    if spare := [name for name in sections.values if name not in in_use]:
        more = f" and {len(spare) - 1} more" if len(spare) > 1 else ""
        remarks.append(f"Section {shorten(spare[0])}{more} is left out: no span of the blade uses it.")
    return tuple(read_section(sections.table(name), name, texts, used, remarks) for name in in_use)


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
    if name in (*SHIPPED_ROTORS, *MEASURED_ROTORS) or not ("." in name or "/" in name or is_file(name)):
        return shipped_aircraft(name)
    return load_rotor(name, allow_outside=allow_outside)


def load_rotor(path: str | Path, *, allow_outside: bool = False) -> Aircraft:
    """The aircraft of a rotor file on disk, with the section files in its folder and the folders in that.

    `allow_outside`: it may name files anywhere. A rotor file may come from others, and what it names is kept in saved
    designs. Raises ValueError with one sentence that names file, line and remedy.
    """
    path = Path(path)
    with refusing(f"rotor file {shorten(path.name)!r}", "check its values, see docs/rotor_file.md"):
        texts = {path.name: _read(path)}
        top = rotor_toml(path.name, texts[path.name])
        for name in named_files(top):
            beside = path.parent / name
            if not is_file(beside):
                continue
            if not allow_outside and not beside.resolve().is_relative_to(path.parent.resolve()):
                raise top.fail(
                    None,
                    f"{path.name} names {shorten(name)!r}, which is outside its folder: copy it there, "
                    "or allow it with --allow-outside",
                )
            texts[name] = _read(beside)
        return read_aircraft(path.name, texts)


def _read(path: Path) -> str:
    remedy = "give a shipped rotor's name, or a UTF-8 text file of 2 MB at most"
    return read_text(path, "rotor file", remedy, LARGEST_FILE)

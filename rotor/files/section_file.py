"""A section of a rotor file: a C81 deck, or XFOIL polars converted to one, and an outline for pictures."""

import math
import re
from collections.abc import Mapping
from itertools import pairwise

from rotor.airfoil.c81 import format_c81
from rotor.airfoil.contour import SECTION_NAMES, is_naca, load_contour, parse_contour, thickness_and_camber
from rotor.airfoil.decks import INCOMPRESSIBLE_MACH, NATIVE_MACH_LIMIT, SectionTraits, assemble_deck
from rotor.airfoil.polars import Polar, parse_polar_file
from rotor.airfoil.sections import TABLE_NAMES, OwnSection, install_own
from rotor.files.toml_table import TomlTable

UNKNOWN_OUTLINE = "naca0012"
"""The outline drawn for a section without one."""


def check_section_name(table: TomlTable, name: str) -> None:
    """ValueError with one sentence for a name that no section of a rotor file may have."""
    if not re.fullmatch(r"[a-z0-9][a-z0-9._-]{0,39}", name) or name in TABLE_NAMES:
        raise table.fail(
            None,
            f"section name {name!r} is taken or has other characters: use letters a-z, digits and -, as my-section",
        )


def read_section(
    table: TomlTable, name: str, texts: Mapping[str, str], used: dict[str, str], remarks: list[str]
) -> OwnSection:
    """The section `[sections.name]`; adds the texts it uses to `used` and its assumptions to `remarks`.

    Raises ValueError with one sentence that names file, line and remedy.
    """
    outline, thickness = _outline(table, name, texts, used, remarks)
    if table.has("deck") == table.has("polars"):
        raise table.fail(None, f'section {name} needs either deck = "file.c81" or polars = ["file.txt", …]: give one')
    if table.has("deck"):
        files = (table.string("deck"),)
        deck = _file(table, "deck", files[0], texts, used)
    else:
        files = table.strings("polars")
        polars = [
            polar for file in files for polar in parse_polar_file(file, _file(table, "polars", file, texts, used))
        ]
        deck = _deck_of(table, name, polars, thickness, remarks)
    section = OwnSection(
        name=name,
        deck=deck,
        outline=outline,
        source=", ".join(files),
        incidence_offset=math.radians(table.number("incidence_offset_deg", 0.0, low=-15.0, high=15.0, unit="°")),
        chord_ratio=table.number("chord_ratio", 1.0, low=0.5, high=2.0),
    )
    table.finish()
    try:
        install_own(section)
    except ValueError as error:
        raise ValueError(f"{files[0]}: {error}" if files[0] not in str(error) else str(error)) from None
    return section


def _outline(
    table: TomlTable, name: str, texts: Mapping[str, str], used: dict[str, str], remarks: list[str]
) -> tuple[str, float]:
    """The outline in the form of `OwnSection`, and t/c, given or measured on the outline."""
    given = table.string("outline", None)
    if given is None:
        given = name if is_naca(name) else None
    if given is None:
        remarks.append(f"The outline of section {name} is not given: it is drawn as a symmetric 12 % section.")
        outline, contour = UNKNOWN_OUTLINE, load_contour(UNKNOWN_OUTLINE)
    elif given in SECTION_NAMES or is_naca(given):
        outline, contour = given, load_contour(given)
    else:
        outline = _file(table, "outline", given, texts, used)
        contour = parse_contour(outline, given)
    measured = thickness_and_camber(contour)[0]
    return outline, table.number("thickness", measured, low=0.02, high=0.4, unit="of the chord")


def _deck_of(table: TomlTable, name: str, polars: list[Polar], thickness: float, remarks: list[str]) -> str:
    """A C81 deck from XFOIL polars, one per Mach number."""
    machs = sorted(polar.mach for polar in polars)
    repeated = [mach for mach, after in pairwise(machs) if after - mach < 0.01]
    if repeated:
        raise table.fail("polars", f"two polars of {name} have Mach {repeated[0]:g}: keep one for each Mach number")
    narrow = [p for p in polars if p.alpha_deg[0] > -4.0 or p.alpha_deg[-1] < 8.0]
    if narrow:
        low, high = narrow[0].alpha_deg[0], narrow[0].alpha_deg[-1]
        raise table.fail(
            "polars",
            f"the polar of {name} at Mach {narrow[0].mach:g} covers {low:g}…{high:g} deg: give at least −4…8 deg",
        )
    low = max(polar.alpha_deg[0] for polar in polars)
    high = min(polar.alpha_deg[-1] for polar in polars)
    listed = ", ".join(f"{mach:g}" for mach in machs)
    above = ", above them Prandtl–Glauert lift, a lift limit and Korn's wave drag" if machs[-1] < 0.99 else ""
    remarks.append(
        f"Section {name} is built from polars at Mach {listed} over {low:g}…{high:g}°{above}, "
        "and from a closed form beyond stall."
    )
    if machs[0] <= INCOMPRESSIBLE_MACH and len(machs) == 1:
        remarks.append(f"The polar of {name} is incompressible: friction keeps its Reynolds number at every Mach.")
    if machs[-1] > NATIVE_MACH_LIMIT + 1e-9:
        remarks.append(
            f"The polars of {name} above Mach {NATIVE_MACH_LIMIT:g} are used as given; XFOIL does not model shocks."
        )
    deck = assemble_deck(name.upper()[:30], polars, SectionTraits(thickness=thickness).correct)
    return format_c81(deck)


def _file(table: TomlTable, key: str, name: str, texts: Mapping[str, str], used: dict[str, str]) -> str:
    if name not in texts:
        raise table.fail(
            key, f"{key} names {name!r}, which is missing: put it beside the rotor file, or load it on the page too"
        )
    used[name] = texts[name]
    return texts[name]

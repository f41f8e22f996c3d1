"""A section of a rotor file: a C81 deck, or XFOIL polars converted to one, and an outline for pictures."""

import math
import re
from collections.abc import Mapping
from itertools import combinations
from typing import Annotated

from msgspec import Meta

from rotor.airfoil.c81 import format_c81
from rotor.airfoil.contour import SECTION_NAMES, is_naca, load_contour, parse_contour, thickness_and_camber
from rotor.airfoil.decks import INCOMPRESSIBLE_MACH, NATIVE_MACH_LIMIT, SectionTraits, assemble_deck
from rotor.airfoil.polars import Polar, parse_polar_file
from rotor.airfoil.reynolds import by_reynolds, same_mach, same_reynolds
from rotor.airfoil.sections import TABLE_NAMES, OwnSection, install_own
from rotor.files.declared import FileTable, Place, Refusal, Text, one_of

UNKNOWN_OUTLINE = "naca0012"
"""The outline drawn for a section without one."""


class OwnSectionTable(FileTable, frozen=True, kw_only=True):
    deck: Text | None = None
    polars: Text | Annotated[tuple[Text, ...], Meta(min_length=1)] | None = None
    outline: Text | None = None
    thickness: Annotated[float, Meta(ge=0.02, le=0.4)] | None = None
    """Thickness over chord; None: that of the outline."""
    incidence_offset_deg: Annotated[float, Meta(ge=-15.0, le=15.0)] = 0.0
    chord_ratio: Annotated[float, Meta(ge=0.5, le=2.0)] = 1.0

    def __post_init__(self) -> None:
        one_of(self, "deck", "polars")

    @property
    def data(self) -> tuple[str, ...]:
        """The deck, or the files of polars."""
        given = self.deck or self.polars or ()
        return given if isinstance(given, tuple) else (given,)

    @property
    def named(self) -> tuple[str, ...]:
        """All files; the outline may also be that of a known section."""
        return (*self.data, self.outline) if self.outline else self.data


def check_section_name(name: str) -> None:
    """Refusal for a name that no section of a rotor file may have."""
    if not re.fullmatch(r"[a-z0-9][a-z0-9._-]{0,39}", name) or name in TABLE_NAMES:
        says = f"section name {name!r} is taken or has other characters"
        raise Refusal(f"{says}: use letters a-z, digits and -, as my-section", "sections", name)


def read_section(
    table: OwnSectionTable, name: str, texts: Mapping[str, str], used: dict[str, str], remarks: list[str]
) -> OwnSection:
    """The section `[sections.name]`; adds the texts it uses to `used` and its assumptions to `remarks`.

    Raises ValueError with one sentence, Refusal for what is wrong in the rotor file itself.
    """
    key = "deck" if table.deck else "polars"
    outline, thickness = _outline(table, name, texts, used, remarks)
    contents = [_file(("sections", name, key), file, texts, used) for file in table.data]
    decks = tuple[tuple[float, str], ...]()
    if key == "deck":
        deck = contents[0]
    else:
        polars = [
            polar for file, text in zip(table.data, contents, strict=True) for polar in parse_polar_file(file, text)
        ]
        decks = _decks_of(name, polars, thickness, remarks)
        deck = decks[len(decks) // 2][1]
    section = OwnSection(
        name=name,
        deck=deck,
        outline=outline,
        source=", ".join(table.data),
        incidence_offset=math.radians(table.incidence_offset_deg),
        chord_ratio=table.chord_ratio,
        decks=decks if len(decks) > 1 else (),
    )
    try:
        install_own(section)
    except ValueError as error:
        first = table.data[0]
        raise ValueError(f"{first}: {error}" if first not in str(error) else str(error)) from None
    return section


def _outline(
    table: OwnSectionTable, name: str, texts: Mapping[str, str], used: dict[str, str], remarks: list[str]
) -> tuple[str, float]:
    """The outline in the form of `OwnSection`, and t/c, given or measured on the outline."""
    given = table.outline or (name if is_naca(name) else None)
    if given is None:
        remarks.append(f"The outline of section {name} is not given: it is drawn as a symmetric 12 % section.")
        outline, contour = UNKNOWN_OUTLINE, load_contour(UNKNOWN_OUTLINE)
    elif given in SECTION_NAMES or is_naca(given):
        outline, contour = given, load_contour(given)
    else:
        outline = _file(("sections", name, "outline"), given, texts, used)
        contour = parse_contour(outline, given)
    return outline, table.thickness or thickness_and_camber(contour)[0]


def _decks_of(name: str, polars: list[Polar], thickness: float, remarks: list[str]) -> tuple[tuple[float, str], ...]:
    """C81 decks from XFOIL polars by Reynolds number; one where no Mach number has polars of several."""
    at = ("sections", name, "polars")
    machs = sorted({polar.mach for polar in polars})
    for one, other in combinations(polars, 2):
        if same_reynolds(one.reynolds, other.reynolds) and same_mach(one, other):
            says = f"two polars of {name} have Mach {one.mach:g} and Reynolds number {one.reynolds:,.0f}"
            raise Refusal(f"{says}: keep one of them", *at)
    narrow = [p for p in polars if p.alpha_deg[0] > -4.0 or p.alpha_deg[-1] < 8.0]
    if narrow:
        low, high = narrow[0].alpha_deg[0], narrow[0].alpha_deg[-1]
        says = f"the polar of {name} at Mach {narrow[0].mach:g} covers {low:g}…{high:g} deg"
        raise Refusal(f"{says}: give at least −4…8 deg", *at)
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
    families = by_reynolds(polars)
    if len(families) > 1:
        listed = ", ".join(f"{number:,.0f}" for number, _ in families)
        remarks.append(
            f"Section {name} has data of Reynolds numbers {listed}: each blade element takes those of its mean one, "
            "Ωr c/ν, linear in its logarithm between two."
        )
    traits = SectionTraits(thickness=thickness, fixed_reynolds=len(families) > 1)
    title = name.upper()[:30]
    return tuple((number, format_c81(assemble_deck(title, family, traits.correct))) for number, family in families)


def _file(at: Place, name: str, texts: Mapping[str, str], used: dict[str, str]) -> str:
    if name not in texts:
        says = f"{at[-1]} names {name!r}, which is missing"
        raise Refusal(f"{says}: put it beside the rotor file, or load it on the page too", *at)
    used[name] = texts[name]
    return texts[name]

"""A section of a rotor file: a C81 deck, or polars converted to one, and an outline for pictures and thickness."""

import math
import re
from collections.abc import Mapping
from itertools import combinations, pairwise
from typing import Annotated

import numpy as np
from msgspec import Meta

from rotor.airfoil.c81 import C81Block, C81Deck, format_c81, parse_c81
from rotor.airfoil.contour import (
    SECTION_NAMES,
    is_naca,
    load_contour,
    parse_contour,
    thickness_and_camber,
)
from rotor.airfoil.decks import (
    INCOMPRESSIBLE_MACH,
    NATIVE_MACH_LIMIT,
    USED_ALPHA_DEG,
    SectionTraits,
    assemble_deck,
)
from rotor.airfoil.polars import Polar, PolarSet, parse_polars
from rotor.airfoil.reynolds import by_reynolds, same_conditions
from rotor.airfoil.section_table import SectionTable
from rotor.airfoil.sections import TABLE_NAMES, OwnSection, install_own
from rotor.files.declared import FileTable, Place, Refusal, Text, one_of

UNKNOWN_OUTLINE = "naca0012"
"""The outline drawn for a section without one."""
THICKNESS = (0.02, 0.4)
MOST_REYNOLDS = 12
_LEAST_ALPHA_DEG = (-4.0, 8.0)
"""A polar must at least cover these."""
_WIDEST_HOLE_DEG = 3.0
"""Rows that did not converge may be missing; the line across a wider hole misses stall, or the least drag."""
_WORTH_SAYING = 0.01
"""Share of c_d that a table on Mach steps of 0.05 may be off its deck without a word."""


class OwnSectionTable(FileTable, frozen=True, kw_only=True):
    deck: Text | None = None
    polars: Text | Annotated[tuple[Text, ...], Meta(min_length=1)] | None = None
    drag_coefficient: Annotated[float, Meta(ge=0.01, le=3.0)] | None = None
    """Of a body without lift and moment."""
    outline: Text | None = None
    thickness: Annotated[float, Meta(ge=THICKNESS[0], le=THICKNESS[1])] | None = None
    """Thickness over chord; None: that of the outline."""
    incidence_offset_deg: Annotated[float, Meta(ge=-15.0, le=15.0)] = 0.0
    chord_ratio: Annotated[float, Meta(ge=0.5, le=2.0)] = 1.0

    def __post_init__(self) -> None:
        one_of(self, "deck", "polars", "drag_coefficient")

    @property
    def data(self) -> tuple[str, ...]:
        """The deck, or the files of polars."""
        given = self.deck or self.polars or ()
        return given if isinstance(given, tuple) else (given,)

    @property
    def named(self) -> tuple[str, ...]:
        """Names of all files of the section."""
        return (
            self.data
            if self.outline is None or _is_known(self.outline)
            else (*self.data, self.outline)
        )


def _is_known(outline: str) -> bool:
    return outline in SECTION_NAMES or is_naca(outline)


def check_section_name(name: str) -> None:
    """Refusal for a name that no section of a rotor file may have."""
    if not re.fullmatch(r"[a-z0-9][a-z0-9._-]{0,39}", name) or name in TABLE_NAMES:
        says = f"section name {name!r} is taken or has characters that are not allowed"
        raise Refusal(
            f"{says}: use letters a-z, digits and -, such as my-section", "sections", name
        )


def read_section(
    table: OwnSectionTable,
    name: str,
    texts: Mapping[str, str],
    used: dict[str, str],
    remarks: list[str],
) -> OwnSection:
    """The section `[sections.name]`; adds the texts it uses to `used` and to `remarks` what was read and is assumed.

    Raises ValueError with one sentence, Refusal for what is wrong in the rotor file itself.
    """
    key = "deck" if table.deck else "polars"
    contents = [_file(("sections", name, key), file, texts, used) for file in table.data]
    outline, thickness, shape = _outline(table, name, texts, used)
    given, assumed, decks = None, list[str](), tuple[tuple[float, str], ...]()
    if table.drag_coefficient is not None:
        deck = _without_lift(name, table.drag_coefficient)
        says = f"no lift and no moment, drag coefficient {table.drag_coefficient:g} at every angle and Mach number"
    elif key == "deck":
        deck = contents[0]
        given = parse_c81(deck, table.data[0])
        if not given.cl.values.any():
            raise ValueError(
                f"{table.data[0]}: the lift does not rise through zero: it is zero at every angle; for a body without "
                "lift write `drag_coefficient` in place of `deck`"
            )
        says = _deck_words(given)
    else:
        sets = [parse_polars(text, file) for file, text in zip(table.data, contents, strict=True)]
        decks, says = _decks_of(name, sets, thickness)
        deck = decks[len(decks) // 2][1]
        assumed = [
            f"{file} {each}."
            for file, read in zip(table.data, sets, strict=True)
            for each in read.assumed
        ]
    remarks += [f"Section {name}: {says}; {shape}.", *assumed]
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
        installed = install_own(section)
    except ValueError as error:
        first = table.data[0] if table.data else name
        raise ValueError(f"{first}: {error}" if first not in str(error) else str(error)) from None
    if given is not None and (says := _off_its_knots(given, installed.table)):
        remarks.append(f"Section {name}: {says}")
    return section


def _without_lift(name: str, drag: float) -> str:
    """C81 text of a body that has the same drag at every angle, such as a round shank."""
    alpha, mach, none = np.array([-180.0, 180.0]), np.array([0.0, 1.0]), np.zeros((2, 2))
    lift, drags = C81Block(mach, alpha, none), C81Block(mach, alpha, none + drag)
    return format_c81(C81Deck(name.upper()[:30], lift, drags, lift))


def _outline(
    table: OwnSectionTable, name: str, texts: Mapping[str, str], used: dict[str, str]
) -> tuple[str, float, str]:
    """The outline in the form of `OwnSection`, t/c, given or measured on the outline, and what was read."""
    given = table.outline or (name if is_naca(name) else UNKNOWN_OUTLINE)
    if _is_known(given):
        outline, contour, shape = given, load_contour(given), f"outline {given}"
    else:
        outline = _file(("sections", name, "outline"), given, texts, used)
        contour = parse_contour(outline, given)
        shape = f"outline of {len(contour.points)} points{f', {contour.moved}' if contour.moved else ''}"
    measured, _, camber = thickness_and_camber(contour)
    if table.thickness is None and not THICKNESS[0] <= measured <= THICKNESS[1]:
        raise ValueError(
            f"{given}: the outline is {100.0 * measured:.1f} % thick, outside {100.0 * THICKNESS[0]:g}…"
            f"{100.0 * THICKNESS[1]:g} %: correct its points, or give `thickness` beside `outline`"
        )
    if table.outline is None and not is_naca(name):
        return (
            outline,
            table.thickness or measured,
            "no outline, so it is drawn as a symmetric 12 % section",
        )
    return (
        outline,
        table.thickness or measured,
        f"{shape}, {_percent(measured)} thick, {_percent(camber)} camber",
    )


def _percent(share: float) -> str:
    return f"{100.0 * share:.1f} %"


def _deck_words(deck: C81Deck) -> str:
    lift, held = deck.cl, ", held at all Mach numbers" if len(deck.cl.mach) == 1 else ""
    return (
        f"deck over {_range(lift.alpha_deg[0], lift.alpha_deg[-1])}° at Mach "
        f"{_range(lift.mach[0], lift.mach[-1])}{held}{'' if deck.cm else ', without cm'}"
    )


def _range(low: float, high: float) -> str:
    return f"{low:g}…{high:g}".replace("-", "−") if low < high else f"{low:g}"


def _off_its_knots(deck: C81Deck, table: SectionTable) -> str:
    """How far the table is off the deck's own values where its Mach numbers are none of the table's; "" within 1 %."""
    block = deck.cd
    near = np.abs(block.alpha_deg) <= max(10.0, float(np.abs(block.alpha_deg).min()))
    mach = block.mach <= table.mach_limit + 1e-9
    alpha, given = block.alpha_deg[near], block.values[np.ix_(near, mach)]
    off = table(np.deg2rad(alpha)[:, None], block.mach[mach]).cd / given - 1.0
    angle, at = np.unravel_index(np.argmax(np.abs(off)), off.shape)
    if abs(off[angle, at]) < _WORTH_SAYING:
        return ""
    return (
        f"between Mach steps of 0.05 the table differs from the deck, most by {100.0 * off[angle, at]:+.1f} % of cd at "
        f"Mach {block.mach[mach][at]:g} and {alpha[angle]:g}°."
    )


def _decks_of(
    name: str, sets: list[PolarSet], thickness: float
) -> tuple[tuple[tuple[float, str], ...], str]:
    """C81 decks from polars by Reynolds number, one where no Mach number has polars of several, and what was read."""
    at = ("sections", name, "polars")
    polars = sorted((polar for each in sets for polar in each.polars), key=lambda polar: polar.mach)
    for one, other in combinations(polars, 2):
        if same_conditions(one, other):
            says = f"two polars of {name} have Mach {one.mach:g}"
            if one.reynolds and other.reynolds:
                raise Refusal(
                    f"{says} and Reynolds number {one.reynolds:,.0f}: keep one of them", *at
                )
            raise Refusal(
                f"{says} without Reynolds numbers: keep one, or add a column reynolds", *at
            )
    for polar in polars:
        _check_range(name, polar, at)
    machs = list(dict.fromkeys(polar.mach for polar in polars))
    low = max(polar.alpha_deg[0] for polar in polars)
    high = min(polar.alpha_deg[-1] for polar in polars)
    listed = ", ".join(
        f"{mach:g} (Re {_millions([p.reynolds for p in polars if p.mach == mach])})"
        for mach in machs
    )
    above = (
        ", above these Mach numbers lift by the Prandtl–Glauert rule, a lift limit and Korn's wave drag"
        if machs[-1] < 0.99
        else ""
    )
    says = f"polars at Mach {listed} over {_range(low, high)}°{above}, a closed form beyond stall"
    families = by_reynolds(polars)
    if len(families) > MOST_REYNOLDS:
        says = f"the polars of {name} have {len(families)} Reynolds numbers"
        raise Refusal(f"{says}: keep {MOST_REYNOLDS}, each about 1.5 times the one before", *at)
    if len(families) > 1:
        says += "; each blade element takes those of its Reynolds number Ωr c/ν, linear in its logarithm between two"
    elif machs[0] <= INCOMPRESSIBLE_MACH and len(machs) == 1:
        says += "; its polar is incompressible, so friction keeps its Reynolds number at every Mach"
    if machs[-1] > NATIVE_MACH_LIMIT + 1e-9:
        says += (
            f"; used as given above Mach {NATIVE_MACH_LIMIT:g}, where XFOIL does not model shocks"
        )
    correct = SectionTraits(thickness=thickness, fixed_reynolds=len(families) > 1).correct
    title = name.upper()[:30]
    return tuple(
        (number, format_c81(assemble_deck(title, family, correct))) for number, family in families
    ), says


def _millions(reynolds: list[float | None]) -> str:
    known = [f"{number / 1e6:.3g}" for number in reynolds if number]
    return f"{', '.join(known)} million" if known else "not said"


def _check_range(name: str, polar: Polar, at: Place) -> None:
    """Refusal for a polar that covers too little, or has a hole where it is used."""
    alpha, says = polar.alpha_deg, f"the polar of {name} at Mach {polar.mach:g}"
    low, high = _LEAST_ALPHA_DEG
    if alpha[0] > low or alpha[-1] < high:
        raise Refusal(
            f"{says} covers {_range(alpha[0], alpha[-1])} deg: give at least −4…8 deg", *at
        )
    used = alpha[np.abs(alpha) <= USED_ALPHA_DEG]
    for before, after in pairwise(used):
        if after - before > _WIDEST_HOLE_DEG + 1e-9:
            beyond = ", or remove those beyond" if before >= high or after <= low else ""
            remedy = f"run XFOIL there again with smaller steps of ASEQ{beyond}"
            raise Refusal(f"{says} has no rows between {before:g} and {after:g} deg: {remedy}", *at)


def _file(at: Place, name: str, texts: Mapping[str, str], used: dict[str, str]) -> str:
    if name not in texts:
        slashes = "write / in paths, " if re.search(r"[\\\x00-\x1f]", name) else ""
        says = f"{at[-1]} names {name!r}, which is missing"
        raise Refusal(
            f"{says}: {slashes}put it beside the rotor file, or load it on the page too", *at
        )
    used[name] = texts[name]
    return texts[name]

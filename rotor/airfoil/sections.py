"""Sections by name and as installed on a blade: table, outline, chord line, chord ratio.

Bundled sections are identified by name. A user's section is a value (`OwnSection`) that holds its whole deck as text,
so that a design stays hashable and can be sent to other processes.
"""

from dataclasses import dataclass, replace

import numpy as np

from rotor.airfoil.c81 import parse_c81, read_c81
from rotor.airfoil.contour import SECTION_NAMES, Contour, load_contour, parse_contour
from rotor.airfoil.decks import on_run_time_grid
from rotor.airfoil.polynomial import THESIS_NAME, parse_reading, polynomial_table
from rotor.airfoil.reynolds import shares
from rotor.airfoil.section_table import SectionTable, between, table_from_deck
from rotor.support.arrays import read_only
from rotor.support.assets import asset_path
from rotor.support.bytes_cache import bytes_cache
from rotor.support.user_input import check_known

TABLE_NAMES = (*SECTION_NAMES, THESIS_NAME)

_TUNNEL_SOURCE = (
    "XFOIL 6.99 tripped at 5 % chord; levels, shocks and moments from public tunnel-derived data; "
    "wrapped to ±180 deg"
)
_SLOPE = (
    "XFOIL 6.99 tripped at 5 % chord, Re of its own rotor; lift slope of tunnels; compressibility and ±180 deg wrap by "
    "this project"
)
_MEASURED = "measured by Knight and Hefner (NACA TN 626) at Re 242 000; wrapped to +-180 deg by this project"
_SOURCE = "XFOIL 6.99 tripped at 5 % chord, Re of its own rotor, compressibility and +-180 deg wrap by this project"


@bytes_cache
@read_only
def load_section(name: str) -> SectionTable:
    """The bundled table of `name`, one of `TABLE_NAMES`, read once and cached; ValueError for another name."""
    if name.startswith(THESIS_NAME):
        return polynomial_table(parse_reading(name))
    check_known("section", name, TABLE_NAMES)
    sources = {"naca0012": _SLOPE, "naca63a015": _SLOPE, "naca0015re242k": _MEASURED}
    tunnel = name.startswith(("sc109", "oa209", "naca23012tab"))
    source = _TUNNEL_SOURCE if tunnel else sources.get(name, _SOURCE)
    return table_from_deck(name, source, read_c81(asset_path(f"airfoils/{name}.c81")))


# The UIUC outline `sc1095r8`, the R8 in SC1095 axes, has its chord line 0.997 deg nose-down and 1.010 times
# as long (measured on the coordinates); public UH-60A blade geometry scripts use 1 deg and 1.009875.
_R8_DROOP_DEG = 1.0
_R8_CHORD_RATIO = 1.009875


@dataclass(frozen=True)
class Section:
    """A section on the blade.

    `incidence_offset` [rad] is the nose-down angle of its chord line from the blade's (on the UH-60A that of
    the SC1095): the table is read at alpha_blade - incidence_offset. `chord_ratio` [-] is its chord over the
    blade's. `outline` is its shape, for pictures.
    """

    name: str
    table: SectionTable
    incidence_offset: float
    chord_ratio: float
    outline: Contour
    of_reynolds: tuple[tuple[float, "Section"], ...] = ()
    """The section with the table of one Reynolds number each, ascending; empty where `table` holds at any."""

    def at(self, reynolds: float) -> tuple[tuple["Section", float], ...]:
        """The one or two of `of_reynolds` at the Reynolds number of its chord, with their shares; else itself."""
        if not self.of_reynolds:
            return ((self, 1.0),)
        places = shares([number for number, _ in self.of_reynolds], reynolds)
        return tuple((self.of_reynolds[place][1], share) for place, share in places)

    def one_at(self, reynolds: float) -> "Section":
        """The section with the table of that Reynolds number, made where it lies between two."""
        (first, _), *other = self.at(reynolds)
        return (
            replace(first, table=between(first.table, other[0][0].table, other[0][1]))
            if other
            else first
        )


@dataclass(frozen=True)
class OwnSection:
    """Section data from a user's files, as one value without arrays."""

    name: str
    deck: str
    """C81 text: the user's deck, or one made from the user's polars; of several Reynolds numbers the middle one."""
    outline: str
    """Name of a bundled or NACA outline, or coordinates as text (Selig), one point a line."""
    source: str
    incidence_offset: float = 0.0
    """[rad], nose-down positive."""
    chord_ratio: float = 1.0
    decks: tuple[tuple[float, str], ...] = ()
    """All by Reynolds number, ascending; empty where `deck` holds at any."""


def load_installed(name: str) -> Section:
    """The bundled section `name` (`sc1095`, `sc1094r8`, `naca0012`, …) with its installation."""
    table = load_section(name)
    outline = load_contour("sc1095" if name.startswith(THESIS_NAME) else name)
    if name == "sc1094r8":
        return Section(name, table, float(np.deg2rad(_R8_DROOP_DEG)), _R8_CHORD_RATIO, outline)
    return Section(name, table, 0.0, 1.0, outline)


@bytes_cache
@read_only
def install_own(section: OwnSection) -> Section:
    """A user's section; read once per process and cached.

    Raises ValueError with one sentence that gives line and remedy for a deck or an outline that cannot be used.
    """
    outline = (
        parse_contour(section.outline, section.name)
        if "\n" in section.outline
        else load_contour(section.outline)
    )

    def with_deck(text: str) -> Section:
        table = table_from_deck(
            section.name, section.source, on_run_time_grid(parse_c81(text, section.name))
        )
        return Section(section.name, table, section.incidence_offset, section.chord_ratio, outline)

    return replace(
        with_deck(section.deck),
        of_reynolds=tuple((number, with_deck(text)) for number, text in section.decks),
    )

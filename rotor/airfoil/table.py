"""The bundled section tables by name, and the layout of their arrays for those who read them directly."""

from functools import lru_cache

from rotor.airfoil.bicubic import ALPHA_STEP as ALPHA_STEP
from rotor.airfoil.bicubic import MACH_STEP as MACH_STEP
from rotor.airfoil.bicubic import N_ALPHA as N_ALPHA
from rotor.airfoil.bicubic import N_MACH as N_MACH
from rotor.airfoil.c81 import read_c81
from rotor.airfoil.contour import SECTION_NAMES
from rotor.airfoil.polynomial import THESIS_NAME, polynomial_table
from rotor.airfoil.section_table import SectionCoefficients as SectionCoefficients
from rotor.airfoil.section_table import SectionTable as SectionTable
from rotor.airfoil.section_table import table_from_deck
from rotor.assets import asset_path

TABLE_NAMES = (*SECTION_NAMES, THESIS_NAME)

_SOURCE = "XFOIL 6.99 tripped at 5 % chord, Re of its own rotor, compressibility and +-180 deg wrap by this project"


@lru_cache(maxsize=16)
def load_section(name: str) -> SectionTable:
    """The bundled table of `name`, one of `TABLE_NAMES`; read and laid out once, in about 20 ms."""
    if name == THESIS_NAME:
        return polynomial_table()
    if name not in SECTION_NAMES:
        raise ValueError(f"no section named {name!r}: choose one of {', '.join(TABLE_NAMES)}")
    return table_from_deck(name, _SOURCE, read_c81(asset_path(f"airfoils/{name}.c81")))

"""The sections of the blade as installed: aerodynamic table, chord line and chord against the SC1095 line."""

from dataclasses import dataclass

import numpy as np

from rotor.airfoil.section_table import SectionTable
from rotor.airfoil.table import load_section

# The UIUC outline `sc1095r8`, the R8 in SC1095 axes, has its chord line 0.997 deg nose-down and 1.010 times
# as long (measured on the coordinates); public UH-60A blade geometry scripts use 1 deg and 1.009875.
_R8_DROOP_DEG = 1.0
_R8_CHORD_RATIO = 1.009875


@dataclass(frozen=True)
class Section:
    """A section on the blade.

    `incidence_offset` [rad] is how far its chord line points nose-down of the SC1095 chord line: the table is
    asked at alpha_blade - incidence_offset. `chord_ratio` [-] is its chord over the SC1095 chord.
    """

    name: str
    table: SectionTable
    incidence_offset: float
    chord_ratio: float


def load_installed(name: str) -> Section:
    """The bundled section `name` (`sc1095`, `sc1094r8`, `sc1095-thesis`) with its installation."""
    if name == "sc1094r8":
        return Section(name, load_section(name), float(np.deg2rad(_R8_DROOP_DEG)), _R8_CHORD_RATIO)
    return Section(name, load_section(name), 0.0, 1.0)

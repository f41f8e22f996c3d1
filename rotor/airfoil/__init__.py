"""Section aerodynamics: coordinates, polars, decks, and the smooth run-time table.

The run-time interface is `load_section`, `SectionTable` and `load_contour`. XFOIL is needed only to rebuild the
bundled polars. Angles are radians, except where a name ends in `_deg`.
"""

from rotor.airfoil.contour import Contour as Contour
from rotor.airfoil.contour import load_contour as load_contour
from rotor.airfoil.contour import resample as resample
from rotor.airfoil.polynomial import polynomial_section as polynomial_section
from rotor.airfoil.polynomial import polynomial_table as polynomial_table
from rotor.airfoil.section_table import SectionCoefficients as SectionCoefficients
from rotor.airfoil.section_table import SectionTable as SectionTable
from rotor.airfoil.sections import Section as Section
from rotor.airfoil.sections import load_installed as load_installed
from rotor.airfoil.sections import load_section as load_section

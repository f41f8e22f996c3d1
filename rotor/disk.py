"""The grid of blade elements and azimuths, and what a rotor is on it."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rotor.airfoil.sections import load_installed
from rotor.blade import Rotor

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Disk:
    """Element centres, azimuths and the blade's properties there. Radius first, azimuth second."""

    r: Array
    """Element centres y/R, (elements,)."""
    dr: float
    """Element width over R: (1 − R_min/R)/N, eq. (3.14), whose left side is printed Δy."""
    psi: Array
    """Azimuths [rad], (azimuths,), 0 over the tail, evenly spaced, no repeated end."""
    cos: Array
    sin: Array
    half_solidity: Array
    """½σ(r) = N_b c(r)/(2πR) with the chord there, (elements,)."""
    section: NDArray[np.int64]
    """Rows of `tables` blended at each element, (elements, 2)."""
    weight: Array
    """Weight of the second of the two, (elements,)."""
    offset: Array
    """Incidence offset of the two [rad], (elements, 2): angle of attack is α_blade − offset."""
    tables: Array
    """Section coefficients, (sections, α cells, Mach cells, 2, 4, 4)."""
    stall: Array
    """Stall angles about the section's own chord [rad], (sections, 2, Mach knots): positive, then negative."""
    mach_limit: float
    """Mach number where the section data end."""
    one_mach: bool
    """Whether the section data know one Mach number only (the document's polynomials)."""
    fit_range: tuple[float, float]
    """Angles of attack [rad] beyond which a polynomial polar is clamped; ±π for decks."""


@lru_cache(maxsize=16)
def build_disk(rotor: Rotor, elements: int, azimuths: int) -> Disk:
    """The rotor on a grid of equally wide elements and evenly spaced azimuths."""
    blade = rotor.blade
    dr = (1.0 - blade.root_cutout) / elements
    r = blade.root_cutout + dr * (np.arange(elements) + 0.5)
    psi = 2.0 * math.pi * np.arange(azimuths) / azimuths

    names = tuple(dict.fromkeys(span.section for span in blade.spans))
    installed = [load_installed(name) for name in names]
    section = np.zeros((elements, 2), dtype=np.int64)
    weight = np.zeros(elements)
    offset = np.zeros((elements, 2))
    ratio = np.ones(elements)
    for i, station in enumerate(r):
        inner, outer, blend = blade.section_at(float(station))
        pair = names.index(inner), names.index(outer)
        section[i] = pair
        weight[i] = blend
        offset[i] = [installed[k].incidence_offset for k in pair]
        ratio[i] = (1.0 - blend) * installed[pair[0]].chord_ratio + blend * installed[pair[1]].chord_ratio
    half_solidity = rotor.blades * blade.chord(r) * ratio / (2.0 * math.pi * rotor.radius)
    first = installed[0].table
    return Disk(
        r=r,
        dr=dr,
        psi=psi,
        cos=np.cos(psi),
        sin=np.sin(psi),
        half_solidity=half_solidity,
        section=section,
        weight=weight,
        offset=offset,
        tables=np.stack([one.table.coefficients for one in installed]),
        stall=np.stack([(one.table.alpha_stall_positive, one.table.alpha_stall_negative) for one in installed]),
        mach_limit=min(one.table.mach_limit for one in installed),
        one_mach=first.fit_range is not None,
        fit_range=first.fit_range or (-math.pi, math.pi),
    )

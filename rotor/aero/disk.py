"""The grid of blade elements and azimuths, with the blade properties on it."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotor.airfoil.section_table import (
    SectionTable,
    attached_lift,
    held_beyond_peak,
    mach_nodes,
)
from rotor.airfoil.sections import Section
from rotor.airfoil.stall_delay import delay_gain, delayed_stall, fully_delayed
from rotor.airfoil.stall_onset import (
    NEGATIVE,
    POSITIVE,
    SLOPE,
    ZERO,
    normal_force,
    onset_angles,
    stall_onset,
    unstalled,
)
from rotor.design.blade import Blade, Rotor
from rotor.support.arrays import Array, fix, read_only
from rotor.support.bytes_cache import bytes_cache

NO_DELAY = np.zeros(0)
_NO_TABLES = np.zeros((0,) * 6)
fix((NO_DELAY, _NO_TABLES))


class OnDisk:
    """Values at blade elements out to the tip and at evenly spaced azimuths."""

    dr: Array
    psi: Array

    @property
    def edges(self) -> Array:
        """Edges of the elements y/R, (elements + 1,)."""
        return element_edges(self.dr)

    @property
    def cells(self) -> Array:
        """Fraction of πR² that an element sweeps between two azimuths, (elements,)."""
        return np.diff(self.edges**2) / len(self.psi)


@dataclass(frozen=True, eq=False)
class Disk(OnDisk):
    """Element centres, azimuths and the blade's properties there. Radius first, azimuth second."""

    r: Array
    """Element centres y/R, (elements,)."""
    dr: Array
    """Element widths over R, (elements,); evenly spaced (1 − R_min/R)/N, eq. (3.14), whose left side is printed Δy."""
    root: float
    """r/R where the lifting blade begins."""
    blades: int
    psi: Array
    """Azimuths [rad], (azimuths,), 0 over the tail, evenly spaced, no repeated end."""
    cos: Array
    sin: Array
    half_solidity: Array
    """½σ(r) = N_b c(r)/(2πR) with the chord there, (elements,)."""
    sections: tuple[Section, ...]
    """Those of the rows of `tables`; a section with data of several Reynolds numbers has a row for each."""
    section: NDArray[np.int64]
    """Rows of `tables` blended at each element, (elements, 2)."""
    weight: Array
    """Weight of the second of the two, (elements,)."""
    offset: Array
    """Angle by which the chord lines of the two are nose-down of the blade's reference line [rad], (elements, 2)."""
    tables: Array
    """Section coefficients, (sections, α cells, Mach cells, 2, 4, 4)."""
    held: Array
    """Tables of a lifting line's circulation, `section_table.held_beyond_peak`."""
    delay: Array
    """g of `stall_delay`, (elements,); without elements where rotation does not delay stall. 0 where a section has no
    lift."""
    missing: Array
    """C_l* − C_l of `stall_delay`, (sections, α cells, Mach cells, 1, 4, 4); without sections as `delay`."""
    held_missing: Array
    """The same of `held`: what C_l* held beyond its peak has more than C_l held beyond its own."""
    cos_sweep: Array
    """Cosine and sine of the sweep of the quarter chord, (elements,): of the Mach number normal to it."""
    sin_sweep: Array
    stall: Array
    """Stall angles about the chord of each of the two sections of an element [rad] at the table's Mach nodes,
    (elements, 2, 2, nodes): negative end, positive end. Of the element's own lift curve, delayed where it is."""
    mach_limit: float
    """Mach number where the section data end."""
    fit_range: tuple[float, float] | None
    """Angles of attack [rad] beyond which the document's polynomials are clamped; None with tabulated sections."""

    @property
    def shape(self) -> tuple[int, int]:
        """(elements, azimuths)"""
        return len(self.r), len(self.psi)


def element_edges(widths: Array) -> Array:
    """Edges over R, (elements + 1,), of elements that reach to the tip, from their widths over R, (elements,)."""
    return np.append(1.0 - np.cumsum(widths[::-1])[::-1], 1.0)


def stations(root: float, elements: int, fine_tip: bool) -> tuple[Array, Array]:
    """Edges (elements + 1,) and control points (elements,) over R, evenly spaced or by a sine that is fine at the tip.

    With the sine each control point lies midway in its angle, as a lifting line needs it between its trailers
    (Multhopp's rule, here at one end only: fine at the root too would give near-singular rows in reverse flow).
    """

    def along(count: Array) -> Array:
        share = np.sin(0.5 * math.pi * count / elements) if fine_tip else count / elements
        return root + (1.0 - root) * share

    steps = np.arange(elements + 1, dtype=np.float64)
    return along(steps), along(steps[:-1] + 0.5)


def azimuths_of(count: int) -> Array:
    """Evenly spaced azimuths [rad] from 0, (count,)."""
    return 2.0 * math.pi * np.arange(count) / count


@bytes_cache
def build_disk(
    rotor: Rotor,
    *,
    elements: int,
    azimuths: int,
    only_mach: float | None = None,
    swept: bool = True,
    surface: bool = True,
    stalls: bool = True,
    delays: bool = True,
    fine_tip: bool = False,
    reynolds: float = 0.0,
) -> Disk:
    """The rotor on a grid of elements, evenly spaced or finer towards the tip, and evenly spaced azimuths.

    `only_mach`: section data are those of that Mach number everywhere; None: of the local Mach number.
    `swept`, `surface`, `stalls`, `delays`: whether the sweep of the tip, the drag of the real surface, stall, and its
    delay by rotation count.
    `reynolds`: `Design.reynolds_per_metre` where a section has data of several Reynolds numbers; else 0, so that all
    altitudes share a disk and what is kept by it.
    """
    # Mass and stiffness are not on the grid: blades that differ in them alone share its large tables. Each has a disk
    # of its own, because the modes of a blade are kept by its disk.
    blade = replace(rotor.blade, flap_inertia=1.0, flap_static_moment=0.0, mass=1.0, structure=None)
    rest, shown = (
        replace(rotor, blade=blade),
        {"swept": swept, "surface": surface, "stalls": stalls},
    )
    shown["fine_tip"] = fine_tip
    shown["delays"] = delays
    return replace(
        _disk(
            rest,
            elements=elements,
            azimuths=azimuths,
            only_mach=only_mach,
            reynolds=reynolds,
            **shown,
        )
    )


@bytes_cache
@read_only
def _disk(
    rotor: Rotor,
    *,
    elements: int,
    azimuths: int,
    only_mach: float | None,
    swept: bool,
    surface: bool,
    stalls: bool,
    delays: bool,
    fine_tip: bool,
    reynolds: float,
) -> Disk:
    blade = rotor.blade
    edges, r = stations(blade.root_cutout, elements, fine_tip)
    psi = azimuths_of(azimuths)

    installed = {span.section: blade.installed(span.section) for span in blade.spans}
    pairs = [_pair(blade, installed, float(station), reynolds) for station in r]
    own = (
        part
        for item in installed.values()
        for part in ([each for _, each in item.of_reynolds] or [item])
    )
    sections = tuple(dict.fromkeys((*own, *(item for pair in pairs for item in pair[:2]))))
    section = np.array([[sections.index(item) for item in pair[:2]] for pair in pairs])
    weight = np.array([pair[2] for pair in pairs])
    offset = np.array([[item.incidence_offset for item in pair[:2]] for pair in pairs])
    ratio = np.array(
        [
            (1.0 - share) * inner.chord_ratio + share * outer.chord_ratio
            for inner, outer, share in pairs
        ]
    )
    half_solidity = rotor.blades * blade.chord(r) * ratio / (2.0 * math.pi * rotor.radius)
    sweep = blade.sweep(r, rotor.radius) if swept else np.zeros(elements)
    if not stalls:
        sections = tuple(
            replace(item, table=unstalled(item.table), of_reynolds=()) for item in sections
        )
    tables = _at_mach(sections, only_mach)
    coefficients, held = _stacked(tables, blade.surface_drag if surface else 1.0)
    delay, missing, held_missing = NO_DELAY, _NO_TABLES, _NO_TABLES
    if delays:
        delay = _delay(tables, section, blade.chord(r) * ratio / (r * rotor.radius))
        missing, held_missing = _missing(tables)
    return Disk(
        r=r,
        dr=np.diff(edges),
        root=blade.root_cutout,
        blades=rotor.blades,
        psi=psi,
        cos=np.cos(psi),
        sin=np.sin(psi),
        half_solidity=half_solidity,
        sections=sections,
        section=section,
        weight=weight,
        offset=offset,
        tables=coefficients,
        held=held,
        delay=delay,
        missing=missing,
        held_missing=held_missing,
        cos_sweep=np.cos(sweep),
        sin_sweep=np.sin(sweep),
        stall=_stall(tables, section, delay),
        mach_limit=min(table.mach_limit for table in tables),
        fit_range=next((table.fit_range for table in tables if table.fit_range is not None), None),
    )


def _pair(
    blade: Blade, installed: dict[str, Section], r: float, reynolds: float
) -> tuple[Section, Section, float]:
    """The two sections blended at r = y/R, each with one table, and the share of the second.

    Within a span they are those of the two nearest Reynolds numbers. In a gap between spans, where there would be four,
    the table of each span is made at its Reynolds number.
    """
    inner, outer, weight = blade.section_at(r)
    (first, there), (second, beyond) = (
        (item, float(blade.reynolds(item, r, reynolds)))
        for item in (installed[inner], installed[outer])
    )
    if weight > 0.0:
        return first.one_at(there), second.one_at(beyond), weight
    (one, _), *rest = first.at(there)
    return (one, *rest[0]) if rest else (one, one, 0.0)


@bytes_cache
def _at_mach(sections: tuple[Section, ...], only_mach: float | None) -> tuple[SectionTable, ...]:
    """Their tables, or those of one Mach number."""
    return tuple(
        item.table if only_mach is None else item.table.held_at(only_mach) for item in sections
    )


@bytes_cache
@read_only
def _stacked(tables: tuple[SectionTable, ...], drag: float) -> tuple[Array, Array]:
    """`Disk.tables` and `Disk.held`; drag: of the real surface over that of the data."""
    coefficients = np.stack([table.coefficients for table in tables])
    coefficients[:, :, :, 1] *= drag
    return coefficients, np.stack([held_beyond_peak(each) for each in coefficients])


def _delay(tables: tuple[SectionTable, ...], section: NDArray[np.int64], ratio: Array) -> Array:
    """`Disk.delay`; ratio: c/r of the elements."""
    lifts = np.array([table.lifts for table in tables])
    return np.where(lifts[section].any(axis=1), delay_gain(ratio), 0.0)


@bytes_cache
@read_only
def _missing(tables: tuple[SectionTable, ...]) -> tuple[Array, Array]:
    """`Disk.missing` and `Disk.held_missing`."""
    missing: list[Array] = []
    held_missing: list[Array] = []
    for table in tables:
        full = fully_delayed(table)
        held = held_beyond_peak(full.coefficients) - held_beyond_peak(table.coefficients)
        missing.append((full.coefficients - table.coefficients)[:, :, :1])
        held_missing.append(held[:, :, :1])
    return np.stack(missing), np.stack(held_missing)


def _stall(tables: tuple[SectionTable, ...], section: NDArray[np.int64], delay: Array) -> Array:
    """`Disk.stall`."""
    mach = mach_nodes()
    if not len(delay):
        return np.stack([table.stall_alpha(mach) for table in tables])[section]
    angles = np.empty((*section.shape, 2, len(mach)))
    for k, table in enumerate(tables):
        elements, which = np.nonzero(section == k)
        angles[elements, which] = delayed_stall(table, delay[elements])
    return angles


@bytes_cache
@read_only
def without_stall(disk: Disk, only_mach: float | None = None) -> Array:
    """`Disk.held` with the lift of attached flow at every angle; only_mach as for `build_disk`."""
    tables = disk.held.copy()
    tables[:, :, :, 0] = [attached_lift(table) for table in _at_mach(disk.sections, only_mach)]
    return tables


@bytes_cache
@read_only
def build_onset(disk: Disk, only_mach: float | None = None) -> tuple[Array, Array]:
    """`StallOnset.numbers` of every element, about the blade's reference line, and the tables of its sections.

    (elements, 8, Mach nodes) and (sections, α cells, Mach cells, 2, 4, 4); only_mach as for `build_disk`.
    """
    tables = _at_mach(disk.sections, only_mach)
    onsets = [stall_onset(table) for table in tables]
    numbers = np.stack([each.numbers for each in onsets])[disk.section]  # (elements, 2, 8, nodes)
    if len(disk.delay):
        mach = mach_nodes()
        for k, table in enumerate(tables):
            elements, which = np.nonzero(disk.section == k)
            gain = disk.delay[elements][:, None]
            full = fully_delayed(table)
            for row, end in ((NEGATIVE, 0), (POSITIVE, 1)):
                angles = disk.stall[elements, which, end]
                own, attached = (normal_force(each, angles, mach) for each in (table, full))
                numbers[elements, which, row] = onset_angles(
                    angles, own + gain * (attached - own), numbers[elements, which, SLOPE]
                )
    numbers[:, :, ZERO] += disk.offset[:, :, None]
    share = disk.weight[:, None, None]
    return (1.0 - share) * numbers[:, 0] + share * numbers[:, 1], _onset_tables(
        disk.sections, only_mach
    )


@bytes_cache
@read_only
def _onset_tables(sections: tuple[Section, ...], only_mach: float | None) -> Array:
    """Kept apart from the disks, which share them."""
    return np.stack([stall_onset(table).tables for table in _at_mach(sections, only_mach)])

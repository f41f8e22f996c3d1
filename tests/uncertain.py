"""Designs with an uncertain input larger and smaller by its size, as new trims and searches need them."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from rotor.aero import disk
from rotor.airfoil import sections
from rotor.airfoil.section_table import SectionTable
from rotor.design.design import Design
from rotor.design.uncertain import UNCERTAIN
from tests.patched import Patch

SIZES = {row.name: row.size for row in UNCERTAIN}


def either_side(name: str, design: Design, patch: Patch) -> Iterator[Design]:
    """The design with the input larger, then smaller; each is to be solved before the next is taken."""
    size = SIZES[name]
    for sign in (1.0, -1.0):
        share = 1.0 + 0.01 * sign * size
        match name:
            case "drag_area_percent":
                yield with_drag_area(share, design)
            case (
                "torsional_stiffness_percent"
                | "control_stiffness_percent"
                | "torsional_inertia_percent"
            ):
                yield with_structure(name.removesuffix("_percent"), share, design)
            case _:
                patch_sections(name, sign * size, patch)
                yield design
                patch_sections(name, 0.0, patch)


def with_drag_area(share: float, design: Design) -> Design:
    return replace(
        design, fuselage=replace(design.fuselage, drag_area=share * design.fuselage.drag_area)
    )


def with_structure(field: str, share: float, design: Design) -> Design:
    structure = design.rotor.blade.structure
    value = getattr(structure, field)
    changed = tuple(share * each for each in value) if isinstance(value, tuple) else share * value
    blade = replace(design.rotor.blade, structure=replace(structure, **{field: changed}))  # type: ignore[type-var]
    return replace(design, rotor=replace(design.rotor, blade=blade))


_loaded = sections.load_section.__wrapped__  # type: ignore[attr-defined]


def patch_sections(name: str, amount: float, patch: Patch) -> None:
    """Other tables of all sections, of which the program knows nothing."""

    @lru_cache(maxsize=16)
    def load(section: str) -> SectionTable:
        table = _loaded(section)
        cells, moment = table.coefficients.copy(), table.moment_coefficients.copy()
        match name:
            case "section_lift_percent":
                cells[:, :, 0] *= 1.0 + 0.01 * amount
            case "section_moment":
                moment[..., 0, 0] += amount
            case "drag_rise_mach":  # Each cell's polynomial in Mach, read a little further on.
                drag, shift = table.coefficients[:, :, 1], amount / 0.05
                powers_of = [
                    [math.comb(k, j) * shift ** (k - j) if k >= j else 0.0 for j in range(4)]
                    for k in range(4)
                ]
                cells[:, :, 1] = drag @ np.array(powers_of)
        return replace(table, coefficients=np.ascontiguousarray(cells), moment_coefficients=moment)

    patch("rotor.airfoil.sections.load_section", load)
    disk.build_disk.__dict__["cache_clear"]()

"""Public section data as spot values, to set beside the section tables: `assets/airfoils/public_points.csv`."""

from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from scipy.interpolate import PchipInterpolator

from rotor.airfoil.sections import load_section
from rotor.support.assets import asset_path, csv_rows

Quantity = Literal["cl", "cd", "cm"]


@dataclass(frozen=True)
class PublicPoint:
    """One published value set at one Mach number and angle of attack about the section's own chord line."""

    section: str
    source: str
    """Short name, told at the head of the file."""
    kept_aside: bool
    """Whether no constant of the decks was read off its source."""
    mach: float
    alpha: float
    """[rad]"""
    cl: float
    cd: float
    cm: float | None


@cache
def public_points(section: str) -> tuple[PublicPoint, ...]:
    """All points of a section; none for a section without public data."""
    return tuple(
        PublicPoint(
            section=section,
            source=row["source"],
            kept_aside=row["role"] == "aside",
            mach=float(row["mach"]),
            alpha=float(np.deg2rad(float(row["alpha_deg"]))),
            cl=float(row["cl"]),
            cd=float(row["cd"]),
            cm=float(row["cm"]) if row["cm"] else None,
        )
        for row in csv_rows(asset_path("airfoils/public_points.csv"))
        if row["section"] == section
    )


@dataclass(frozen=True)
class SectionAgreement:
    """Errors of a section table below stall at the measured points that were not used to make it."""

    points: int
    cl_rms: float
    """At Mach 0.7 and below."""
    cd_largest: float
    """Largest |ratio − 1| at Mach 0.5 and below."""
    cm_largest: float
    """Largest |difference| at Mach 0.7 and below."""
    divergence: tuple[float, ...]
    """Drag-divergence Mach numbers of the table less those of the points at 0, 2 and 4 deg."""


def agreement(section: str) -> SectionAgreement:
    """How a section agrees with the measured points not used to make it. Raises ValueError where there are none."""
    aside = [point for point in public_points(section) if point.kept_aside]
    if not aside:
        raise ValueError(f"no public data of {section} was kept aside: there is no second set")
    table = load_section(section)
    below: list[PublicPoint] = []
    for point in aside:
        negative, positive = table.stall_alpha(point.mach)
        if (
            negative < point.alpha < positive
            and point.mach <= 0.7
            and not _shock_stalled(aside, point)
        ):
            below.append(point)
    lift = [float(table(p.alpha, p.mach).cl) - p.cl for p in below]
    drag = [float(table(p.alpha, p.mach).cd) / p.cd - 1.0 for p in below if p.mach <= 0.5]
    moments = [
        abs(float(m) - p.cm)
        for p in below
        if p.cm is not None and (m := table.moment(p.alpha, p.mach)) is not None
    ]
    return SectionAgreement(
        points=len(below),
        cl_rms=float(np.sqrt(np.mean(np.square(lift)))),
        cd_largest=float(np.abs(drag).max()),
        cm_largest=max(moments),
        divergence=tuple(
            float(table.drag_divergence_mach(np.deg2rad(a)))
            - _divergence(aside, float(np.deg2rad(a)))
            for a in (0, 2, 4)
        ),
    )


_ATTACHED_SLOPE = 0.11
"""Lift slope of an attached section [1/deg]."""


def _shock_stalled(points: list[PublicPoint], point: PublicPoint) -> bool:
    """Whether the points themselves stall before this angle: their lift grew by less than half of its attached rate."""
    step = np.deg2rad(2.0)
    beside = (p for p in points if p.mach == point.mach and p.alpha * point.alpha >= 0.0)
    inner = [p for p in beside if abs(abs(p.alpha) - abs(point.alpha) + step) < 1e-6]
    if not inner or abs(point.alpha) < 1.5 * step:
        return False
    return abs(point.cl - inner[0].cl) < 0.5 * _ATTACHED_SLOPE * 2.0


def _divergence(points: list[PublicPoint], alpha: float) -> float:
    """Mach number where dC_d/dM = 0.1 on the monotone cubic through the points at one angle."""
    row = sorted((p.mach, p.cd) for p in points if abs(p.alpha - alpha) < 1e-6)
    mach, drag = np.array(row).T
    fine = np.arange(mach[0], mach[-1], 0.001)
    return float(fine[np.argmax(PchipInterpolator(mach, drag).derivative()(fine) >= 0.1)])

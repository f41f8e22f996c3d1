"""The document's section model: one polar, one polynomial each for lift and drag, no Mach number.

Lonoce fits Cl by order 10 and Cd by order 12 to XFOIL data of SC1095 (figs. 3.3-3.6). Range, Reynolds number,
Mach and transition are not stated (`PolynomialReading`); outside the range coefficients are constant (extrapolated,
Cl is 3.5e3 at 30 deg). The fit is a Chebyshev series in the scaled angle: in degrees, the order-12 power basis would
have a condition number of 2e15.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import ArrayLike, NDArray

from rotor.airfoil.polars import Polar, read_polars
from rotor.airfoil.section_table import ALPHA_STEP, N_ALPHA, N_MACH, SectionTable, make_table
from rotor.support.arrays import Array, read_only
from rotor.support.assets import asset_path
from rotor.support.bytes_cache import bytes_cache

THESIS_NAME = "sc1095-thesis"
LIFT_ORDER = 10  # document, fig. 3.3
DRAG_ORDER = 12  # document, fig. 3.4
FIT_RANGE_DEG = (-10.0, 15.0)  # our choice: within 0.5 % of the interpolated polar in rotor power


@dataclass(frozen=True)
class PolynomialReading:
    """What the document leaves open of its polynomials: transition, Mach number and range of the fit.

    The default has the plain name: it was the reading of the `thesis` preset, which design files and links still name.
    """

    transition: Literal["free", "tripped"] = "free"
    mach: float = 0.3
    range_deg: tuple[float, float] = FIT_RANGE_DEG

    @property
    def name(self) -> str:
        """Name of its section, for example `sc1095-thesis:tripped:0.4:-10:18`."""
        if self == PolynomialReading():
            return THESIS_NAME
        return f"{THESIS_NAME}:{self.transition}:{self.mach:g}:{self.range_deg[0]:g}:{self.range_deg[1]:g}"


THESIS_READING = PolynomialReading("tripped", 0.1)
"""The reading of the preset `thesis`, see `rotor.validation.thesis.readings`."""


def parse_reading(name: str) -> PolynomialReading:
    """The reading of a section name; ValueError for an unknown name."""
    if name == THESIS_NAME:
        return PolynomialReading()
    head, *fields = name.split(":")
    try:
        transition, mach, low, high = fields
        reading = PolynomialReading(
            "free" if transition == "free" else "tripped", float(mach), (float(low), float(high))
        )
    except ValueError:
        reading = None
    if head != THESIS_NAME or reading is None or reading.name != name:
        raise ValueError(
            f"no polynomials named {name!r}: write for example {THESIS_NAME}:tripped:0.4:-10:18"
        )
    return reading


@dataclass(frozen=True, eq=False)
class PolynomialSection:
    """Least-squares Chebyshev series of lift and drag over `fit_range` [rad], constant outside."""

    fit_range: tuple[float, float]
    cl_series: Chebyshev
    cd_series: Chebyshev

    def outside(self, alpha: ArrayLike) -> NDArray[np.bool_]:
        """True where `alpha` [rad] lies outside the fit, where the end value is used; shape of alpha."""
        a = np.asarray(alpha, dtype=np.float64)
        return (a < self.fit_range[0]) | (a > self.fit_range[1])

    def __call__(self, alpha: ArrayLike) -> tuple[Array, Array]:
        """(cl, cd) at `alpha` [rad] without any treatment of reverse flow."""
        held = np.clip(alpha, *self.fit_range)
        return np.asarray(self.cl_series(held)), np.asarray(self.cd_series(held))

    def slopes(self, alpha: ArrayLike) -> tuple[Array, Array]:
        """(dcl, dcd)/dalpha [1/rad], zero outside the fit; at its ends, the slope from inside."""
        a, outside = np.asarray(alpha, dtype=np.float64), self.outside(alpha)
        cl, cd = (
            np.where(outside, 0.0, series.deriv()(a)) for series in (self.cl_series, self.cd_series)
        )
        return cl, cd


def thesis_polar(reading: PolynomialReading = PolynomialReading()) -> Polar:
    """The bundled XFOIL polar behind the fit: SC1095, M 0.3, Re 3.68e6, Ncrit 9, every 0.25 deg.

    Another reading may take transition at 5 % chord and Mach 0.1, 0.2, 0.3 or 0.4, every 0.5 deg; else ValueError.
    """
    file = "sc1095_ncrit9" if reading.transition == "free" else "sc1095_trip5"
    polars = read_polars(asset_path(f"airfoils/{file}.polars.csv")).polars
    for polar in polars:
        if abs(polar.mach - reading.mach) < 1e-9:
            return polar
    raise ValueError(
        f"no {reading.transition} polar of SC1095 at Mach {reading.mach:g}: "
        f"choose one of {', '.join(f'{polar.mach:g}' for polar in polars)}"
    )


def _within(polar: Polar, range_deg: tuple[float, float]) -> tuple[Array, Array, Array]:
    keep = (polar.alpha_deg >= range_deg[0]) & (polar.alpha_deg <= range_deg[1])
    return np.deg2rad(polar.alpha_deg[keep]), polar.cl[keep], polar.cd[keep]


def fit_polynomials(
    polar: Polar,
    lift_order: int = LIFT_ORDER,
    drag_order: int = DRAG_ORDER,
    range_deg: tuple[float, float] = FIT_RANGE_DEG,
) -> PolynomialSection:
    """Least-squares fit of a polar within `range_deg` [°]; ValueError for too few points there."""
    alpha, cl, cd = _within(polar, range_deg)
    if alpha.size <= max(lift_order, drag_order):
        raise ValueError(
            f"{alpha.size} points in {range_deg[0]:g}..{range_deg[1]:g} deg cannot carry order "
            f"{max(lift_order, drag_order)}: widen the range or lower the order"
        )
    ends = float(np.deg2rad(range_deg[0])), float(np.deg2rad(range_deg[1]))
    lift, drag = (
        Chebyshev.fit(alpha, y, order, ends) for y, order in ((cl, lift_order), (cd, drag_order))
    )
    return PolynomialSection(ends, lift, drag)


@dataclass(frozen=True)
class FitError:
    """Root-mean-square error [-] of the lift and of the drag fit of one order."""

    order: int
    cl_rms: float
    cd_rms: float


def fit_error_study(polar: Polar, range_deg: tuple[float, float]) -> tuple[FitError, ...]:
    """Error against order, as in figs. 3.3 and 3.4 of the document, over the points within `range_deg`."""
    alpha, cl, cd = _within(polar, range_deg)
    out: list[FitError] = []
    for order in range(1, 17):
        fit_cl, fit_cd = fit_polynomials(polar, order, order, range_deg)(alpha)
        rms = [float(np.sqrt(np.mean((f - y) ** 2))) for f, y in ((fit_cl, cl), (fit_cd, cd))]
        out.append(FitError(order, rms[0], rms[1]))
    return tuple(out)


@bytes_cache
@read_only
def polynomial_section(reading: PolynomialReading = PolynomialReading()) -> PolynomialSection:
    """The fit with the document's orders to the bundled polar of a reading."""
    return fit_polynomials(thesis_polar(reading), range_deg=reading.range_deg)


def document_angle(alpha: Array) -> tuple[Array, Array]:
    """(angle the document would use [rad], sign of its lift) for an atan2 angle `alpha` [rad] in -pi..pi.

    The document takes phi = arctan(U_P / U_T) and changes the sign of the drag where U_T <= 0. There
    phi = phi_atan2 -+ pi, alpha_doc = alpha +- pi, and with Fz = L cos(phi) - D sin(phi),
    Fx = L sin(phi) + D cos(phi) both cosine and sine change sign: in atan2 form lift and drag would change
    sign, and the document's own change restores the drag: Cl(alpha) = -Cl_doc, Cd(alpha) = +Cd_doc.
    The sign of that lift is wrong: at 175 deg a NACA 0012 measures cl = -0.54 (TN 3361), this gives +0.5.
    It is kept, because the `thesis` preset is the document as stated, and reverse flow is slow.
    """
    reverse = np.abs(alpha) > np.pi / 2
    return np.where(reverse, alpha - np.copysign(np.pi, alpha), alpha), np.where(reverse, -1.0, 1.0)


def _cubic_cells(value: Array, slope: Array) -> Array:
    """Monomial coefficients (N_ALPHA, 4) from end values and per-cell slopes of each cell, both (N_ALPHA, 2)."""
    rise = value[:, 1] - value[:, 0]
    return np.stack(
        (
            value[:, 0],
            slope[:, 0],
            3.0 * rise - 2.0 * slope[:, 0] - slope[:, 1],
            slope.sum(axis=1) - 2.0 * rise,
        ),
        axis=1,
    )


@bytes_cache
@read_only
def polynomial_table(reading: PolynomialReading = PolynomialReading()) -> SectionTable:
    """The document's section on the common grid, the same at every Mach, with its treatment of reverse flow.

    Cubic per half-degree cell with the polynomial's own slopes: within 1e-4 of it. By the document's
    definition it jumps at +-90 deg, and its slope where the fit ends.
    """
    section = polynomial_section(reading)
    edges = -np.pi + (np.arange(N_ALPHA)[:, None] + np.array([0.0, 1.0])) * ALPHA_STEP
    # Determines on which side of a jump a whole cell lies.
    middle = edges.mean(axis=1, keepdims=True)
    turn = document_angle(middle)[0] - middle
    sign = document_angle(middle)[1]
    angle = edges + turn
    # Moved slightly inward: at a shared edge a cell outside the fit has zero slope and one inside the full slope.
    probe = angle + np.array([1e-9, -1e-9])
    (cl, cd), (cl_slope, cd_slope) = section(angle), section.slopes(probe)
    out = np.zeros((N_ALPHA, N_MACH, 2, 4, 4))
    out[:, :, 0, :, 0] = _cubic_cells(sign * cl, sign * cl_slope * ALPHA_STEP)[:, None, :]
    out[:, :, 1, :, 0] = _cubic_cells(cd, cd_slope * ALPHA_STEP)[:, None, :]
    polar = thesis_polar(reading)
    low, high = reading.range_deg
    transition = "Ncrit 9" if reading.transition == "free" else "tripped at 5 % chord"
    source = (
        f"polynomials of order {LIFT_ORDER} and {DRAG_ORDER} over {low:g}..{high:g} deg on own XFOIL polar: SC1095, "
        f"M {polar.mach:g}, Re {(polar.reynolds or 0.0) / 1e6:.2f}e6, {transition}"
    )
    return make_table(reading.name, source, out, 1.0, section.fit_range)

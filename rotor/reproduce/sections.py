"""Figures 3.3–3.6: polynomial fits of lift and drag of SC1095 from XFOIL."""

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.polynomial.chebyshev import chebval

from rotor.airfoil.polynomial import (
    DRAG_ORDER,
    FIT_RANGE_DEG,
    LIFT_ORDER,
    FitError,
    fit_error_study,
    fit_polynomials,
    thesis_polar,
)
from rotor.reproduce.report import PlotPanel, Report, curve, judged, table

Coefficient = Literal["lift", "drag"]
RANGES = ((-10.0, 15.0), (-10.0, 20.0))
"""Ranges of the fit [deg]: ours, and one that reaches into stall. The thesis states none."""
GOOD = 0.01
"""Part of the coefficient's own spread over the range that a good compromise may miss."""
ATTACHED_DEG = (-4.0, 8.0)
"""Where a blade flies: drag there decides power."""


FITS: dict[str, tuple[Coefficient, int]] = {
    "3.3": ("lift", LIFT_ORDER),
    "3.4": ("drag", DRAG_ORDER),
    "3.5": ("lift", LIFT_ORDER),
    "3.6": ("drag", DRAG_ORDER),
}
"""By number: the coefficient, and the order of the thesis."""


def error_figure(number: str) -> Report:
    """Error of a fit against its order; `number` is 3.3 or 3.4."""
    which, chosen = FITS[number]
    polar = thesis_polar()
    studies = {low_high: fit_error_study(polar, low_high) for low_high in RANGES}
    numbers: dict[str, float] = {}
    for low, high in RANGES:
        errors = {one.order: _rms(one, which) for one in studies[low, high]}
        name = f"{low:g}_{high:g}"
        numbers |= {
            f"at_{name}": errors[chosen],
            f"from_2_{name}": errors[2] / errors[chosen],
            f"last_step_{name}": errors[chosen - 2] / errors[chosen],
            f"next_step_{name}": errors[chosen] / errors[chosen + 2],
        }
    spread = _spread(which)
    share = numbers["at_-10_15"] / spread
    knee = knee_of([(one.order, _rms(one, which)) for one in studies[RANGES[0]]])
    enough = next(one.order for one in studies[RANGES[0]] if _rms(one, which) < GOOD * spread)
    rows = [
        (one.order, *(_rms(studies[pair][k], which) for pair in RANGES)) for k, one in enumerate(studies[RANGES[0]])
    ]
    symbol = "Cl" if which == "lift" else "Cd"
    panel = PlotPanel(
        "polynomial order",
        f"rms error of {symbol}",
        tuple(
            curve(f"α {low:g}…{high:g}°", [r[0] for r in rows], [r[k + 1] for r in rows], "both")
            for k, (low, high) in enumerate(RANGES)
        )
        + tuple(
            curve(f"{words} {order}", (order, order), (min(r[1] for r in rows), max(r[2] for r in rows)), "dashed")
            for words, order in (("thesis: order", chosen), ("our knee: order", knee))
        ),
        log="y",
    )
    return Report(
        number=number,
        caption=f"Error of the {which} polynomial of SC1095 against its order, over two ranges of α. Data: XFOIL, M "
        "0.3, Re 3.68 million, Ncrit 9 (our assumption; the thesis states range and flow nowhere).",
        statement=f"Order {chosen} is a good compromise between error and cost (p. 18).",
        ours=f"Order {chosen}: rms {numbers['at_-10_15']:.5f} over −10…15°, {100 * share:.2f} % of the spread of "
        f"{symbol}; {numbers['from_2_-10_15']:.0f} times better than order 2. Over −10…20° the step to it from order "
        f"{chosen - 2} gains a factor {numbers['last_step_-10_20']:.2f}, the step to order {chosen + 2} another "
        f"{numbers['next_step_-10_20']:.2f}.",
        verdict=judged(knee == chosen),
        because=f"Our knee over −10…15° is at order {knee}, and the error is below {100 * GOOD:.0f} % of the spread "
        f"from order {enough} on. There is no plateau: a higher order always helps slightly, because stall is a kink.",
        tables=(table("error", ("order", *(f"rms_{low:g}_{high:g}_deg" for low, high in RANGES)), rows),),
        panels=(panel,),
        numbers={**numbers, "share_of_spread": share, "knee": knee, "enough": enough},
    )


def knee_of(points: Sequence[tuple[int, float]]) -> int:
    """The order whose error lies furthest below the straight line between first and last, in log10 of the error."""
    order = np.array([point[0] for point in points], dtype=np.float64)
    error = np.log10([point[1] for point in points])
    line = error[0] + (error[-1] - error[0]) * (order - order[0]) / (order[-1] - order[0])
    return int(order[int(np.argmax(line - error))])


def fit_figure(number: str) -> Report:
    """A fit beside its data; `number` is 3.5 or 3.6."""
    which, order = FITS[number]
    polar = thesis_polar()
    fit = fit_polynomials(polar)
    low, high = FIT_RANGE_DEG
    keep = (polar.alpha_deg >= low) & (polar.alpha_deg <= high)
    alpha_deg = polar.alpha_deg[keep]
    which_one, symbol = (0, "Cl") if which == "lift" else (1, "Cd")
    data = (polar.cl, polar.cd)[which_one][keep]
    made = fit(np.deg2rad(alpha_deg))[which_one]
    rms = float(np.sqrt(np.mean((made - data) ** 2)))
    attached = (alpha_deg >= ATTACHED_DEG[0]) & (alpha_deg <= ATTACHED_DEG[1])
    relative = made[attached] / data[attached] - 1.0 if which == "drag" else np.zeros(1)
    fine = np.linspace(low, high, 401)
    smooth = fit(np.deg2rad(fine))[which_one]
    # Outside its range the same polynomial, unheld, is worthless: the reason why it must be clamped.
    t = (2.0 * np.deg2rad(30.0) - sum(fit.fit_range)) / (fit.fit_range[1] - fit.fit_range[0])
    series = (fit.cl_series, fit.cd_series)[which_one]
    unheld = float(np.asarray(chebval(t, series), dtype=np.float64))
    words = f"rms {rms:.5f} over {low:g}…{high:g}°."
    if which == "drag":
        words += f" In attached flow ({ATTACHED_DEG[0]:g}…{ATTACHED_DEG[1]:g}°) Cd is off by "
        words += f"{100 * np.sqrt(np.mean(relative**2)):.1f} % rms, {100 * np.abs(relative).max():.1f} % at most."
    words += f" Without holding the end values it would give {symbol} {unheld:.3g} at 30°."
    return Report(
        number=number,
        caption=f"{'Lift' if which == 'lift' else 'Drag'} of SC1095 and its polynomial of order {order}.",
        statement="Polynomials of high order can also represent stall and the drag bucket, and so carry all the "
        "information of the section (p. 18).",
        ours=words,
        verdict=judged(rms < GOOD * _spread(which)),
        because="Inside the range of the fit it does; outside it must be held at its end values, which the thesis "
        "does not mention and a trim needs from µ 0.15.",
        tables=(
            table(
                "fit", ("alpha_deg", symbol.lower(), f"{symbol.lower()}_fit"), zip(alpha_deg, data, made, strict=True)
            ),
        ),
        panels=(
            PlotPanel(
                "α [°]", symbol, (curve("XFOIL", alpha_deg, data, "points"), curve(f"order {order}", fine, smooth))
            ),
        ),
        numbers={
            "rms": rms,
            "attached_rms": float(np.sqrt(np.mean(relative**2))),
            "attached_max": float(np.abs(relative).max()),
            "unheld_at_30": unheld,
        },
    )


def _rms(error: FitError, which: Coefficient) -> float:
    return error.cl_rms if which == "lift" else error.cd_rms


def _spread(which: Coefficient) -> float:
    """Largest less smallest coefficient over the range of the fit."""
    polar = thesis_polar()
    low, high = FIT_RANGE_DEG
    keep = (polar.alpha_deg >= low) & (polar.alpha_deg <= high)
    return float(np.ptp((polar.cl if which == "lift" else polar.cd)[keep]))

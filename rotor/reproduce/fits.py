"""Figures 3.3–3.6: how the error of the polynomial fits falls with their order, and the fits of order 10 and 12."""

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
from rotor.reproduce.report import Panel, Report, curve, judged, table

RANGES = ((-10.0, 15.0), (-10.0, 20.0))
"""Ranges of the fit [deg]: ours, and one that reaches into stall. The document states none."""
GOOD = 0.01
"""Part of the coefficient's own spread over the range that a good compromise may miss."""
ATTACHED_DEG = (-4.0, 8.0)
"""Where a blade flies: drag there decides power."""


def figure_3_3() -> Report:
    """Error of the lift fit."""
    return _error("3.3", "lift", LIFT_ORDER)


def figure_3_4() -> Report:
    """Error of the drag fit."""
    return _error("3.4", "drag", DRAG_ORDER)


def figure_3_5() -> Report:
    """The lift fit."""
    return _fit("3.5", "lift", LIFT_ORDER)


def figure_3_6() -> Report:
    """The drag fit."""
    return _fit("3.6", "drag", DRAG_ORDER)


def _error(number: str, which: str, chosen: int) -> Report:
    polar = thesis_polar()
    studies = {low_high: fit_error_study(polar, low_high) for low_high in RANGES}
    numbers: dict[str, float] = {}
    for low, high in RANGES:
        errors = {one.order: _of(one, which) for one in studies[low, high]}
        name = f"{low:g}_{high:g}"
        numbers |= {
            f"at_{name}": errors[chosen],
            f"from_2_{name}": errors[2] / errors[chosen],
            f"last_step_{name}": errors[chosen - 2] / errors[chosen],
            f"next_step_{name}": errors[chosen] / errors[chosen + 2],
        }
    spread = _spread(which)
    share = numbers["at_-10_15"] / spread
    knee = numbers["last_step_-10_20"] > numbers["next_step_-10_20"]
    rows = [(one.order, *(_of(studies[pair][k], which) for pair in RANGES)) for k, one in enumerate(studies[RANGES[0]])]
    symbol = "Cl" if which == "lift" else "Cd"
    panel = Panel(
        "polynomial order",
        f"rms error of {symbol}",
        tuple(
            curve(f"α {low:g}…{high:g}°", [r[0] for r in rows], [r[k + 1] for r in rows], "both")
            for k, (low, high) in enumerate(RANGES)
        ),
        log="y",
    )
    return Report(
        number=number,
        kind="figure",
        caption=f"Error of the {which} polynomial of SC1095 against its order, over two ranges of α. Data: XFOIL, M "
        "0.3, Re 3.68 million, Ncrit 9 (our assumption; the document states range and flow nowhere).",
        statement=f"Order {chosen} is a good compromise between error and cost (p. 18).",
        ours=f"Order {chosen}: rms {numbers['at_-10_15']:.5f} over −10…15°, {100 * share:.2f} % of the spread of "
        f"{symbol}; "
        f"{numbers['from_2_-10_15']:.0f} times better than order 2. Over −10…20° the step to it from order "
        f"{chosen - 2} "
        f"gains a factor {numbers['last_step_-10_20']:.2f}, the step to order {chosen + 2} another "
        f"{numbers['next_step_-10_20']:.2f}.",
        verdict=judged(share < GOOD),
        because=("It is the knee over −10…20°" if knee else "It is no sharp knee")
        + ", but there is no plateau: more order always helps a little, because stall is a corner.",
        tables=(table("error", ("order", *(f"rms_{low:g}_{high:g}_deg" for low, high in RANGES)), rows),),
        panels=(panel,),
        numbers={**numbers, "share_of_spread": share},
    )


def _fit(number: str, which: str, order: int) -> Report:
    polar = thesis_polar()
    fit = fit_polynomials(polar)
    low, high = FIT_RANGE_DEG
    keep = (polar.alpha_deg >= low) & (polar.alpha_deg <= high)
    alpha_deg = polar.alpha_deg[keep]
    data = (polar.cl if which == "lift" else polar.cd)[keep]
    made = fit(np.deg2rad(alpha_deg))[0 if which == "lift" else 1]
    rms = float(np.sqrt(np.mean((made - data) ** 2)))
    attached = (alpha_deg >= ATTACHED_DEG[0]) & (alpha_deg <= ATTACHED_DEG[1])
    relative = made[attached] / data[attached] - 1.0 if which == "drag" else np.zeros(1)
    fine = np.linspace(low, high, 401)
    smooth = fit(np.deg2rad(fine))[0 if which == "lift" else 1]
    symbol = "Cl" if which == "lift" else "Cd"
    # Outside its range the same polynomial, unheld, is worthless: the reason why it must be clamped.
    t = (2.0 * np.deg2rad(30.0) - sum(fit.fit_range)) / (fit.fit_range[1] - fit.fit_range[0])
    series = fit.cl_series if which == "lift" else fit.cd_series
    unheld = float(np.asarray(chebval(t, series), dtype=np.float64))
    words = f"rms {rms:.5f} over {low:g}…{high:g}°."
    if which == "drag":
        words += f" In attached flow ({ATTACHED_DEG[0]:g}…{ATTACHED_DEG[1]:g}°) Cd is off by "
        words += f"{100 * np.sqrt(np.mean(relative**2)):.1f} % rms, {100 * np.abs(relative).max():.1f} % at most."
    words += f" Not held at its ends, it would give {symbol} {unheld:.3g} at 30°."
    return Report(
        number=number,
        kind="figure",
        caption=f"{'Lift' if which == 'lift' else 'Drag'} of SC1095 and its polynomial of order {order}.",
        statement="Polynomials of high order can also represent stall and the drag bucket, and so carry all the "
        "information of the section (p. 18).",
        ours=words,
        verdict=judged(rms < GOOD * _spread(which)),
        because="Inside the range of the fit it does; outside it must be held at its end values, which the document "
        "does not mention and from µ 0.15 on a trim needs.",
        tables=(
            table(
                "fit", ("alpha_deg", symbol.lower(), f"{symbol.lower()}_fit"), zip(alpha_deg, data, made, strict=True)
            ),
        ),
        panels=(
            Panel(
                "α [°]",
                symbol,
                (curve("XFOIL", alpha_deg, data, "points"), curve(f"order {order}", fine, smooth)),
            ),
        ),
        numbers={
            "rms": rms,
            "attached_rms": float(np.sqrt(np.mean(relative**2))),
            "attached_max": float(np.abs(relative).max()),
            "unheld_at_30": unheld,
        },
    )


def _of(error: FitError, which: str) -> float:
    return error.cl_rms if which == "lift" else error.cd_rms


def _spread(which: str) -> float:
    """Largest less smallest coefficient over the range of the fit."""
    polar = thesis_polar()
    low, high = FIT_RANGE_DEG
    keep = (polar.alpha_deg >= low) & (polar.alpha_deg <= high)
    return float(np.ptp((polar.cl if which == "lift" else polar.cd)[keep]))

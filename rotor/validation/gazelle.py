"""Section lift of the SA349/2 Gazelle over the azimuth beside flight, as a set of the trust page."""

from collections.abc import Sequence

import numpy as np

from rotor.trim.solve import solve
from rotor.validation.airloads import (
    CASES,
    REPORTS,
    CurveAgreement,
    MeasuredCurve,
    agreement,
    measured_curves,
    our_curve,
)
from rotor.validation.chart import AZIMUTH, Series, TrustChart
from rotor.validation.trust import TrustRow, TrustSet

SET = "gazelle-airloads"
LEAST = 0.9
"""Target: correlation of c_l at each radius."""
_NAMES = {"cl": "c_l", "cl_u2": "c_l (r + µ sin ψ)²"}
_TEST = "rotor/validation/test_flown.py::test_airloads_of_the_gazelle"


def gazelle_set() -> TrustSet:
    """For the trust page: c_l as measured, and with the dynamic pressure."""
    solutions = {case.name: solve(case.design()).require() for case in CASES if case.test == SET}
    curves = [one for one in measured_curves() if one.case.test == SET]
    found = [agreement(one, solutions[one.case.name]) for one in curves]
    lift = [one.correlation for one in found if one.quantity == "cl"]
    return TrustSet(
        name=SET,
        title="SA349/2 Gazelle, section lift",
        compared="c_l over azimuth, three radii, µ 0.14 and 0.36",
        error=f"correlation {min(lift):.2f} to {max(lift):.2f}",
        source=f"{REPORTS[SET]}; flights FC1 and FC2, for no other are airloads at hand",
        rows=tuple(
            _row(name, quantity, [one for one in found if (one.case.name, one.quantity) == (name, quantity)])
            for quantity in _NAMES
            for name in solutions
        ),
        charts=tuple(_chart(name, [(one, our_curve(one, solutions[name])) for one in curves]) for name in solutions),
        text=(
            "The report gives c_l of the section, and the target is set for it: harmonics 1 to 10 without the mean. "
            "Most of its change around the azimuth is that of speed: c_l is large where the blade is slow. Lift "
            "itself goes with c_l (r + µ sin ψ)²; there the correlation is lower, and no target was set. Angle of "
            "attack is not measured and the report's way from pressures to c_l is not known to us.",
            "More azimuths and panels (24 × 48, 36 × 48 in place of 24 × 24) move the correlations of c_l by less "
            "than 0.01. Power and controls: [power and controls in flight](flown-power.md).",
        ),
        points=_points(found),
    )


def _row(name: str, quantity: str, found: Sequence[CurveAgreement]) -> TrustRow:
    least = min(one.correlation for one in found)
    judged = quantity == "cl"
    return TrustRow(
        set=SET,
        kind="validation",
        what=f"{name}: correlation of {_NAMES[quantity]} at r/R {', '.join(f'{one.r:g}' for one in found)}",
        against=REPORTS[SET],
        shown=", ".join(f"{one.correlation:.2f}" for one in found),
        error=least,
        allowed=0.02,
        test=_TEST,
        target=f"at least {LEAST:g} at each" if judged else "",
        verdict=("met" if least >= LEAST else "missed") if judged else "no target",
    )


def _chart(name: str, curves: Sequence[tuple[MeasuredCurve, tuple[np.ndarray, np.ndarray]]]) -> TrustChart:
    """c_l at the radii."""
    series: list[Series] = []
    mine = [one for one in curves if one[0].case.name == name and one[0].quantity == "cl"]
    for k, (measured, (psi, values)) in enumerate(mine, start=1):
        at = tuple(np.degrees(measured.psi).tolist())
        series.append(Series(f"measured, {measured.r:g} R", at, tuple(measured.values.tolist()), "points", k))
        ours = tuple(np.append(values, values[0]).tolist())
        series.append(Series("computed", (*np.degrees(psi).tolist(), 360.0), ours, "line", k))
    mu = mine[0][0].case.conditions["mu"]
    return TrustChart(
        f"Section lift coefficient, {name}, µ {mu:g}", "azimuth [°]", f"c_l, {name}", tuple(series), x_ticks=AZIMUTH
    )


def _points(found: Sequence[CurveAgreement]) -> tuple[tuple[str, ...], ...]:
    rows: list[tuple[str, ...]] = [("Flight", "r/R", "Quantity", "Correlation", "rms", "of", "Mean", "Measured mean")]
    for one in found:
        numbers = (one.rms, one.measured_rms, one.mean, one.measured_mean)
        rows.append(
            (
                one.case.name,
                f"{one.r:g}",
                _NAMES[one.quantity],
                f"{one.correlation:.3f}",
                *(f"{x:.3f}" for x in numbers),
            )
        )
    return tuple(rows)

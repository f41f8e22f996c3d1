"""Measured inflow over the disk beside inflow models: correlation and root mean square of the difference.

The laser velocimeter measured the mean over time at points one chord above the plane of the blade tips. A lifting line
has an inflow there, from all blades and their wakes; models that know the disk alone are compared with theirs in it.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotor.aero.inflow import INFLOW_MODELS
from rotor.files.make_design import make_design
from rotor.support.arrays import Array
from rotor.support.assets import asset_path, csv_rows
from rotor.support.chart import Chart, Line, Points, Series
from rotor.trim.doubt import usual_inflows
from rotor.trim.low_speed import trim_problem
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.validation.airloads import azimuth_chart
from rotor.validation.trust import TrustRow, TrustSet, description, rms

ROTOR = "2mrts"
CONDITIONS = {0.15: (3.0, 0.0064), 0.23: (3.04, 0.0064), 0.35: (5.7, 0.0064)}
"""Shaft tilt [°] and C_T at each advance ratio (NASA TM-100541 to 100543)."""
SET = "2mrts-inflow"
"""Name of the set on the command line."""


@dataclass(frozen=True, eq=False)
class MeasuredInflow:
    """The inflow measured at one advance ratio, positive down, over ΩR."""

    mu: float
    r: Array
    """(points,)"""
    psi: Array
    """[rad], (points,)"""
    inflow: Array
    """(points,)"""


@dataclass(frozen=True)
class InflowAgreement:
    """Agreement of one inflow model with measured inflow at one advance ratio."""

    mu: float
    model: str
    correlation: float | None
    """None for an inflow that is the same everywhere."""
    rms: float
    """Root mean square of the difference, over ΩR."""
    mean: float
    """Mean of the model over the points; that of the measurement is `measured_mean`."""
    measured_mean: float


def measured_inflow() -> tuple[MeasuredInflow, ...]:
    """The measured points, one value an advance ratio."""
    rows = csv_rows(asset_path("measured/2mrts_inflow.csv"))
    inflows: list[MeasuredInflow] = []
    for mu in CONDITIONS:
        points = [
            (float(key[1:]) / 100.0, math.radians(float(row["psi_deg"])), float(value))
            for row in rows
            if float(row["mu"]) == mu
            for key, value in row.items()
            if key.startswith("r0") and value
        ]
        r, psi, inflow = np.array(points).T
        inflows.append(MeasuredInflow(mu, r, psi, inflow))
    return tuple(inflows)


CHART_R = 0.74
"""r/R of the charts of the trust page."""


def inflow_set() -> TrustSet:
    """For the trust page: the correlations, and the inflow over azimuth at one radius."""
    words, agreements = description(SET), list(inflow_agreement())
    rows: list[TrustRow] = []
    for name in reversed(INFLOW_MODELS):
        mine = [row for row in agreements if row.model == name]
        known = [row.correlation for row in mine if row.correlation is not None]
        if not known:
            continue
        rows.append(
            words.row(
                f"{words.title}: correlation at µ {', '.join(f'{row.mu:g}' for row in mine)}, {name}",
                ", ".join(f"{value:.2f}" for value in known),
                sum(known) / len(known),
                0.02,
                note=f"rms {', '.join(f'{row.rms:.4f}' for row in mine)} of the tip speed.",
            )
        )
    return words.page(rows[0].shown, rows, map(_chart, measured_inflow()))


def _chart(measured: MeasuredInflow) -> Chart:
    """Measured and computed inflow over azimuth."""
    here = [k for k, r in enumerate(measured.r) if r == CHART_R]
    psi = np.linspace(0.0, 2.0 * math.pi, 73)
    ring = MeasuredInflow(measured.mu, np.full_like(psi, CHART_R), psi, np.zeros_like(psi))
    series: list[Series] = [
        Points("measured", np.degrees(measured.psi)[here], measured.inflow[here])
    ]
    for k, name in enumerate(usual_inflows(), start=1):
        series.append(Line(name, np.degrees(psi), _time_mean(name, ring), k))
    title = f"Inflow at r/R {CHART_R:g}, µ {measured.mu:g}"
    return azimuth_chart(title, f"inflow over ΩR, µ {measured.mu:g}", series)


def inflow_agreement() -> Iterator[InflowAgreement]:
    """Every model at every advance ratio; RuntimeError where the rotor does not trim."""
    for measured in measured_inflow():
        for name in INFLOW_MODELS:
            computed = _time_mean(name, measured)
            yield InflowAgreement(
                mu=measured.mu,
                model=name,
                correlation=float(np.corrcoef(computed, measured.inflow)[0, 1])
                if np.ptp(computed) > 1e-9
                else None,
                rms=rms(computed - measured.inflow),
                mean=float(computed.mean()),
                measured_mean=float(measured.inflow.mean()),
            )


def _time_mean(name: str, measured: MeasuredInflow) -> Array:
    """λ_i of a model at the measured points, (points,)."""
    solution = trimmed(name, measured)
    chord = solution.design.rotor.reference_chord / solution.design.rotor.radius
    above = above_disk(solution, measured, chord)
    return _at(solution.disk.r, solution.disk.induced, measured) if above is None else above


def trimmed(name: str, measured: MeasuredInflow) -> Solution:
    """The rotor of the test with an inflow model."""
    tilt, ct = CONDITIONS[measured.mu]
    solidity = make_design(rotor=ROTOR).rotor.solidity
    stand = {"shaft_tilt_deg": tilt, "ct_over_sigma": ct / solidity}
    return solve(make_design(rotor=ROTOR, mu=measured.mu, inflow=name, stand=stand)).require()


def above_disk(solution: Solution, measured: MeasuredInflow, height: float) -> Array | None:
    """Mean over time of the inflow normal to the plane of the tips, at points above it, (points,); None as `off_disk`.

    height: over R. The disk of the test is normal to the shaft: the rotor is trimmed without flapping.
    """
    above = np.full_like(measured.r, solution.controls.coning + height)
    points = np.stack(
        [measured.r * np.cos(measured.psi), measured.r * np.sin(measured.psi), above], axis=1
    )
    return trim_problem(solution.design).inflow_terms.off_disk(points, solution.start.inflow)


def _at(radii: Array, field: Array, measured: MeasuredInflow) -> Array:
    """A field (radius, azimuth) at the measured points, linear along the blade and around the azimuth."""
    n = field.shape[1]
    place = measured.psi / (2.0 * math.pi) * n
    before = np.floor(place).astype(int)
    share = place - before
    along = np.stack([np.interp(measured.r, radii, field[:, k]) for k in range(n)], axis=1)
    points = np.arange(len(measured.r))
    return (1.0 - share) * along[points, before % n] + share * along[points, (before + 1) % n]

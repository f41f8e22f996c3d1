"""Measured inflow over the disk beside every inflow model: correlation and root mean square of the difference.

The laser velocimeter measured the time mean at points of the disk, one chord above it. A model with single blades
gives the inflow at the blade; its time mean is that of the same load spread over infinitely many blades.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.dynamic_wake import DynamicWakeInflow
from rotor.aero.inflow.interface import Wake
from rotor.aero.problem import build_problem, in_disk_axes
from rotor.arrays import Array
from rotor.assets import asset_path, csv_rows
from rotor.files.make_design import make_design
from rotor.trim.solve import solve

ROTOR = "2mrts"
CONDITIONS = {0.15: (3.0, 0.0064), 0.23: (3.04, 0.0064), 0.35: (5.7, 0.0064)}
"""Shaft tilt [°] and C_T at each advance ratio (NASA TM-100541 to 100543)."""
MODELS = tuple(name for name in INFLOW_MODELS if name != "vortex-wake")
"""Models with a time mean at a point of the disk; the vortex lattice gives the inflow at the blade only."""
SET = "2mrts-inflow"
"""Name of the set on the command line."""
WHY = (
    "Linear inflow ranks above the dynamic wake at advance ratio 0.35. The points lie a chord above the disk, where "
    "what small parts of the load induce has faded; none of these models has a wake that rolls up; and from 0.23 on "
    "the measured mean is little more than half of momentum theory's, which all of them share. Nothing was changed: "
    "linear inflow does not respond to the load, so it cannot tell twists apart."
)
"""What the comparison shows, as far as it is known."""


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
    """One model at one advance ratio."""

    mu: float
    model: str
    correlation: float | None
    """None for an inflow that is the same everywhere."""
    rms: float
    """Of the difference, over ΩR."""
    mean: float
    """Mean of the model over the points; that of the measurement is `measured_mean`."""
    measured_mean: float


def measured_inflow() -> tuple[MeasuredInflow, ...]:
    """The measured points, one value an advance ratio."""
    rows = csv_rows(asset_path("measured/2mrts_inflow.csv"))
    found: list[MeasuredInflow] = []
    for mu in CONDITIONS:
        points = [
            (float(key[1:]) / 100.0, math.radians(float(row["psi_deg"])), float(value))
            for row in rows
            if float(row["mu"]) == mu
            for key, value in row.items()
            if key.startswith("r0") and value
        ]
        r, psi, inflow = np.array(points).T
        found.append(MeasuredInflow(mu, r, psi, inflow))
    return tuple(found)


def inflow_agreement() -> Iterator[InflowAgreement]:
    """Every model at every advance ratio; RuntimeError where the rotor does not trim."""
    for measured in measured_inflow():
        for name in MODELS:
            ours = _time_mean(name, measured)
            difference = ours - measured.inflow
            yield InflowAgreement(
                mu=measured.mu,
                model=name,
                correlation=float(np.corrcoef(ours, measured.inflow)[0, 1]) if np.ptp(ours) > 1e-9 else None,
                rms=float(np.sqrt(np.mean(difference**2))),
                mean=float(ours.mean()),
                measured_mean=float(measured.inflow.mean()),
            )


def _time_mean(name: str, measured: MeasuredInflow) -> Array:
    """λ_i of a model at the measured points, (points,)."""
    tilt, ct = CONDITIONS[measured.mu]
    solidity = make_design(rotor=ROTOR).rotor.solidity
    stand = {"shaft_tilt_deg": tilt, "ct_over_sigma": ct / solidity}
    solution = solve(make_design(rotor=ROTOR, mu=measured.mu, inflow=name, stand=stand)).require()
    problem = build_problem(solution.design)
    model, field = problem.inflow, solution.disk.induced
    if isinstance(model, DynamicWakeInflow):
        tilt = solution.controls.shaft_tilt
        wake = Wake(*in_disk_axes(measured.mu, problem.climb, tilt), solution.controls.lambda0)
        field = model.spread().theory(problem.disk).induced(solution.disk.dct, wake)
    return _at(problem.disk.r, field, measured)


def _at(radii: Array, field: Array, measured: MeasuredInflow) -> Array:
    """A field (radius, azimuth) at the measured points, linear along the blade and around the azimuth."""
    n = field.shape[1]
    place = measured.psi / (2.0 * math.pi) * n
    before = np.floor(place).astype(int)
    share = place - before
    along = np.stack([np.interp(measured.r, radii, field[:, k]) for k in range(n)], axis=1)
    points = np.arange(len(measured.r))
    return (1.0 - share) * along[points, before % n] + share * along[points, (before + 1) % n]

"""Vibratory loads on the hub, what they are summed up to, and their gradient by the pitch along the blade.

The index weighs the amplitudes at N_b per revolution: 0.5, 0.67 and 1 for aft, side and vertical force, moments over
the radius. Studies of lift-offset rotors call such a sum the vibration index (Int. J. Aerospace Engineering, 2019,
9589415, whose abstract states its reductions by 2/rev and 3/rev pitch). The weights of the forces are taken for those
of the intrusion index (S. Crews, Rotorcraft Vibration Criteria, a New Perspective, AHS Forum 43, 1987; US Army
ADS-27A-SP, 2006). No text that prints the weights could be looked up: they are recalled.

Absolute levels are not to be trusted: published codes, with fluid dynamics coupled in, miss measured loads at these
frequencies too, and below µ 0.2 the number is that of the wake model. So it comes with its band over inflow models.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rotor.aero.inflow import INFLOW_MODELS
from rotor.columns.bending import LOADS, hub_load_terms
from rotor.design.design import Design, with_models
from rotor.engine.terms import Terms
from rotor.support.arrays import Array
from rotor.trim.adjoint import Adjoint
from rotor.trim.analysis import Analysis, analysed
from rotor.trim.newton import Guess
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.solution import Solution
from rotor.trim.solve import analyse

_AFT, _SIDE = 0.5, 0.67
"""Weights of the in-plane forces in the index."""


@dataclass(frozen=True)
class HubLoads:
    """Vibratory loads of all blades on the hub, in axes that do not turn: x aft, y to starboard, z up."""

    per_rev: int
    """N_b: the lowest harmonic that reaches the hub."""
    amplitudes: dict[str, float]
    """At N_b/rev of fx, fy, fz [N] and of the moments mx (advancing side up) and my (nose up) about the hub [N m]."""
    phases: dict[str, float]
    """ψ N_b at the largest value [rad], by the same names."""
    index: float
    """√((½ F_x)² + (0.67 F_y)² + F_z²)/W + √(M_x² + M_y²)/(R W) [%]."""
    indices: Mapping[str, float] | None
    """Index by inflow model, its own among them [%]."""

    @property
    def band(self) -> tuple[float, float] | None:
        """Least and largest index over several inflow models [%]."""
        return (min(self.indices.values()), max(self.indices.values())) if self.indices else None

    def change_band(self, other: "HubLoads") -> tuple[float, float] | None:
        """Least and largest change of the index from another's over the inflow models [%]; None where not known."""
        here, there = self.indices or {}, other.indices or {}
        pairs = [(here[name], there[name]) for name in here if name in there]
        changes = [
            100.0 * (index / before - 1.0) for index, before in ((self.index, other.index), *pairs)
        ]
        return (min(changes), max(changes)) if pairs else None

    def record(self) -> dict[str, Any]:
        """The loads as `solve --json` prints them: [N], [N m] and the index [%]."""
        unit = {"f": "n", "m": "nm"}
        return {
            "per_rev": self.per_rev,
            **{f"{name}_{unit[name[0]]}": value for name, value in self.amplitudes.items()},
            "index_percent": self.index,
            "band_percent": None if self.band is None else list(self.band),
        }


Solve = Callable[[Design, Solution | Guess | None], Analysis]
"""As `analyse`."""


def hub_loads(
    given: Solution | Analysis, *, solve: Solve | None = None, band: bool = True
) -> HubLoads | None:
    """Vibratory loads of all blades on the hub at N_b per revolution.

    A design whose blades do not bend is solved again with blades that bend.

    Parameters:
        given: a converged trim, or its `rotor.trim.Analysis`.
        solve: how the further designs are trimmed; by default `rotor.trim.solve.analyse`.
        band: whether to solve with the other inflow models too, for the range of the index.

    Returns:
        The loads, or None for a design that has none, or whose bending blade does not trim;
        `rotor.trim.why_no_hub_loads` says why.

    Raises:
        RuntimeError: the trim did not converge.
    """
    trim, solve = analysed(given), solve or analyse
    design = trim.solution.require().design
    if why_no_hub_loads(design) is not None:
        return None
    if not design.models.bending:
        design = with_models(design, bending=True)
        trim = solve(design, replace(trim.solution.start, box=None))
        if not trim.solution.converged:
            return None
    _, values = terms_and_loads(trim.adjoint)
    index = 100.0 * index_of(design, values)[0]
    indices = {design.models.inflow: index, **_indices(design, solve)} if band else None
    amplitudes, phases = (
        np.hypot(*values.T).tolist(),
        np.arctan2(values[:, 1], values[:, 0]).tolist(),
    )
    sizes: dict[str, float] = dict(zip(LOADS, amplitudes, strict=True))
    angles: dict[str, float] = dict(zip(LOADS, phases, strict=True))
    return HubLoads(design.rotor.blades, sizes, angles, index, indices)


def band_inflows() -> tuple[str, ...]:
    """Names of the inflow models over which the index is stated."""
    return tuple(name for name, model in INFLOW_MODELS.items() if model.in_index_band)


def band_designs(design: Design) -> tuple[Design, ...]:
    """A design whose blades bend with each other inflow model over which its index is stated."""
    others = (name for name in band_inflows() if name != design.models.inflow)
    return tuple(with_models(design, inflow=name) for name in others)


def _indices(design: Design, solve: Solve) -> dict[str, float]:
    """The index with each other inflow model with which the design trims [%]."""
    indices = dict[str, float]()
    for other in band_designs(design):
        trim = solve(other, None)
        loads = hub_loads(trim, solve=solve, band=False) if trim.solution.converged else None
        indices |= {} if loads is None else {other.models.inflow: loads.index}
    return indices


def terms_and_loads(adjoint: Adjoint) -> tuple[Terms, Array]:
    """The terms of `LOADS`, and what they are in a trim: cosine and sine [N, N m], (loads, 2)."""
    problem, point = adjoint.problem, adjoint.point
    assert problem.bending is not None
    terms = hub_load_terms(point.system.structure, problem.design.rotor.blades, problem.bending)
    return terms, terms.value(point.z, point.q).reshape(-1, 2) * load_units(problem.design)


def load_units(design: Design) -> Array:
    """N and N m by units of the equations, (loads, 1)."""
    return design.thrust_unit * np.array([1.0] * 3 + [design.rotor.radius] * 2)[:, None]


def index_gains(design: Design) -> Array:
    """What each load counts in the index [1/N, 1/(N m)], (5,): the index is √Σ of the three forces' squares times their
    gains, and the same of the two moments."""
    condition, radius = design.condition, design.rotor.radius
    weight = (
        condition.weight
        if condition.stand is None
        else design.weight_coefficient * design.thrust_unit
    )
    return np.array([_AFT, _SIDE, 1.0, 1.0 / radius, 1.0 / radius]) / weight


def index_of(design: Design, values: Array) -> tuple[float, Array]:
    """The index, a fraction, and its slopes by the loads, (loads, 2)."""
    gains = index_gains(design)[:, None]
    weighted = gains * values
    force, moment = (
        math.sqrt(float((weighted[:3] ** 2).sum())),
        math.sqrt(float((weighted[3:] ** 2).sum())),
    )
    slopes = gains * weighted
    slopes[:3] /= max(force, 1e-30)
    slopes[3:] /= max(moment, 1e-30)
    return force + moment, slopes


def hub_index(adjoint: Adjoint) -> float:
    """The index [%] of a trim that has hub loads, with blades that bend."""
    return 100.0 * index_of(adjoint.problem.design, terms_and_loads(adjoint)[1])[0]


def index_along(adjoint: Adjoint) -> tuple[float, Array]:
    """The index [%], and its slope by each element's pitch [%/rad], (elements,)."""
    design, (terms, loads) = adjoint.problem.design, terms_and_loads(adjoint)
    index, slopes = index_of(design, loads)
    weights = 100.0 * load_units(design) * slopes
    summed = replace(
        terms,
        row=np.zeros_like(terms.row),
        factor=terms.factor * weights.ravel()[terms.row],
        rows=1,
    )
    return 100.0 * index, adjoint.by_pitch(summed)

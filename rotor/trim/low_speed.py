"""Forward-flight inflow that passes over to the hover model as the speed falls to zero.

A skewed wake at zero speed and a hover model give the same rotor different inflow. Their difference c(r), at the loads
of the hovering rotor, is added to the inflow in forward flight times s(µ), which is 1 at µ = 0:

    λ_i = A d + s c,    c = λ_hover − A_0 d_hover,    s = ((λ̄ − λ̄_e)/(1 − λ̄_e))³,    s = 0 for λ̄ < λ̄_e,
    λ̄² = √(µ̄⁴/4 + 1) − µ̄²/2,    µ̄ = µ/√(C_W/2).

λ̄ is Glauert's inflow over that of hover. With it cos²χ of the wake's skew χ is λ̄⁴, the share of the axial transport in
the squared velocity through the disk; c is taken to fall with it and with the inflow itself, as λ̄⁵, which s follows
within 0.05. λ̄_e belongs to µ̄ = 2.5, where the wake trails at 81° to the shaft: beyond it s is 0 and hover is not
computed. So hover and forward flight have one limit, and neither power nor its slope has a kink. In a climb hover is
that at the same rate of climb.
"""

import math
from collections import deque
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from rotor.aero import kernel
from rotor.aero.disk import Disk
from rotor.aero.elements import BladeElements, Problem, build_problem, swirl_of
from rotor.aero.free_wake.system import WakeState
from rotor.aero.inflow import InflowModel, Wake, inflow_model
from rotor.aero.inflow.interface import InflowBasis, InflowFeedback, InflowResponse, ResponseTerms, TermResponse
from rotor.aero.momentum import vortex_ring_edge
from rotor.arrays import Array
from rotor.design.design import Design
from rotor.trim.hover import hover
from rotor.trim.hover_wake import HoverWakeResult, hover_wake

FASTEST = 2.5
"""µ̄ from which on forward flight owes nothing to hover: µ 0.145 for a UH-60A at sea level. Our choice."""


@dataclass(frozen=True, eq=False)
class HoverDifference:
    """The hovering rotor of a design, and what the forward-flight model lacks there; over ΩR, (elements,)."""

    problem: Problem
    elements: BladeElements
    wake: WakeState | None
    """The unknowns of the free wake, where hover is solved with one."""
    inflow: Array
    """c, λ_hover − A_0 d_hover."""
    swirl: Array
    """The same for the swirl."""

    @property
    def flow(self) -> Wake:
        """The wake of momentum theory in hover."""
        return Wake(0.0, self.problem.climb, self.elements.state.lambda0)

    def by_hover(self, inflow: Array, swirl: Array) -> tuple[Array, Array, Array]:
        """Slopes of a sum of both differences with these weights by F_z, λ_i and swirl of hover; fields each."""
        around = np.ones(self.problem.disk.shape) / len(self.problem.disk.psi)
        by_inflow = inflow[:, None] * around
        return -self._response.apply_transposed(by_inflow), by_inflow, swirl[:, None] * around

    @cached_property
    def _response(self) -> InflowResponse:
        """Of the forward-flight model to hover."""
        return self.problem.inflow.respond(self.problem.disk, self.flow, self.elements.loads[kernel.FZ])


@lru_cache(maxsize=32)
def hover_difference(design: Design) -> HoverDifference | None:
    """The difference for a hovering design; None where hover does not converge.

    A free wake starts from the last one of the same rotor: what it settles to does not depend on the start.
    """
    problem = build_problem(design)
    found = _in_free_wake(problem) if design.models.hover_inflow == "free-wake" else hover(problem)
    if not found.converged:
        return None
    elements, disk = found.elements, problem.disk
    flow = Wake(0.0, problem.climb, elements.state.lambda0)
    axial = problem.inflow.respond(disk, flow, elements.loads[kernel.FZ]).induced.mean(axis=1)
    uniform, _ = swirl_of(disk.r, flow.lambda0**2 + flow.lambda0 * flow.mu_z if design.models.has("swirl") else 0.0)
    wake = found.wake.state if isinstance(found, HoverWakeResult) and found.wake is not None else None
    difference = HoverDifference(problem, elements, wake, elements.induced[:, 0] - axial, elements.swirl - uniform)
    if wake is not None:
        _SETTLED.append(difference)
    return difference


_SETTLED: deque[HoverDifference] = deque(maxlen=4)
"""The last free wakes."""


def _in_free_wake(problem: Problem) -> HoverWakeResult:
    """Hover, from the last free wake of the same rotor with the same models if there is one."""
    design = problem.design
    for near in reversed(list(_SETTLED)):
        if (near.problem.design.rotor, near.problem.design.models) == (design.rotor, design.models):
            torsion = near.elements.torsion
            return hover_wake(problem, near.wake, elastic=None if torsion is None else torsion.coordinates)
    return hover_wake(problem)


def axial_share(mu: float, thrust: float) -> float:
    """s(µ) for the C_T of hover: 1 at µ = 0, falling to 0 at µ = FASTEST √(C_T/2)."""
    end = inflow_ratio(FASTEST)
    share = max(0.0, (inflow_ratio(mu / math.sqrt(0.5 * thrust)) - end) / (1.0 - end))
    return share * share * share


def inflow_ratio(mu: float) -> float:
    """λ̄, mean inflow over that of hover, at µ̄: advance ratio over the inflow of hover."""
    half = 0.5 * mu**2
    return math.sqrt(1.0 / (math.sqrt(half**2 + 1.0) + half))


def trim_problem(design: Design) -> Problem:
    """The design on its grid, with the inflow that its models choose for low speed."""
    problem = build_problem(design)
    share = hover_share(design)
    if not share:
        return problem
    difference = hover_difference(replace(in_hover(design), active_twist=None))
    if difference is None:
        return problem
    inflow = HoverMatched(problem.inflow, share * difference.inflow, difference, share)
    return replace(problem, inflow=inflow, added_swirl=share * difference.swirl)


def in_hover(design: Design) -> Design:
    """The design without forward speed, at its rate of climb: in descent at most that of the vortex ring state's edge.

    Faster descents are flown at speed only, where little of hover is left.
    """
    slowest = vortex_ring_edge(0.0) * math.sqrt(0.5 * design.weight_coefficient) * design.rotor.tip_speed
    return design.at(hover=True, climb_m_s=max(design.condition.climb_speed, slowest))


def passes_over(design: Design) -> bool:
    """Whether forward flight of the design passes over to its hover model as the speed falls."""
    models = design.models
    return models.low_speed == "hover" and design.condition.stand is None and inflow_model(models.inflow).load_dependent


def hover_share(design: Design) -> float:
    """s of a design in forward flight; 0 where it does not pass over to hover, and at speed."""
    if design.hovering or not passes_over(design):
        return 0.0
    return axial_share(design.condition.advance_ratio, design.weight_coefficient)


@dataclass(frozen=True, eq=False)
class HoverMatched:
    """A load-dependent inflow model with a part that does not depend on the load in flight."""

    model: InflowModel
    added: Array
    """s c, (elements,)."""
    difference: HoverDifference
    share: float
    """s."""

    @property
    def name(self) -> str:
        return self.model.name

    @property
    def title(self) -> str:
        return self.model.title

    @property
    def explanation(self) -> str:
        return self.model.explanation

    @property
    def load_dependent(self) -> bool:
        return self.model.load_dependent

    def without_tip_loss(self) -> "HoverMatched":
        return replace(self, model=self.model.without_tip_loss())

    def with_wake_geometry(self, expected: Wake) -> "HoverMatched":
        return replace(self, model=self.model.with_wake_geometry(expected))

    def respond(self, disk: Disk, wake: Wake, load: Array) -> "AddedInflow":
        return AddedInflow(self.model.respond(disk, wake, load), self.added)

    def basis(self, disk: Disk) -> "AddedBasis":
        return AddedBasis(self.model.basis(disk), self.added)


@dataclass(frozen=True, eq=False)
class AddedBasis:
    """The basis of a model, with a given inflow added that is no coordinate."""

    basis: InflowBasis
    added: Array
    """(elements,)"""

    @property
    def size(self) -> int:
        return self.basis.size

    def nearest(self, field: Array, wake: Wake) -> Array:
        return self.basis.nearest(field - self.added[:, None], wake)

    def field(self, coordinates: Array, wake: Wake) -> Array:
        return self.basis.field(coordinates, wake) + self.added[:, None]

    def bound(self, change: Array) -> float:
        return self.basis.bound(change)

    def resolved_by(self, azimuths: int) -> bool:
        return self.basis.resolved_by(azimuths)


@dataclass(frozen=True, eq=False)
class AddedInflow:
    """The response of a model, with a given inflow added."""

    response: InflowResponse
    added: Array

    @property
    def induced(self) -> Array:
        return self.response.induced + self.added[:, None]

    @property
    def coordinates(self) -> Array:
        return self.response.coordinates

    @property
    def by_wake(self) -> Array:
        return self.response.by_wake

    def terms(self) -> ResponseTerms | None:
        return self.response.terms() if isinstance(self.response, TermResponse) else None

    def apply(self, fields: Array) -> Array:
        return self.response.apply(fields)

    def apply_transposed(self, field: Array) -> Array:
        return self.response.apply_transposed(field)

    def feedback(self, slope: Array) -> InflowFeedback:
        return self.response.feedback(slope)

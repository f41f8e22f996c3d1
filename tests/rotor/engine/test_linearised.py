"""Every kind of trim: its energy closes; Jacobian, transpose and all slopes by element against differences.

Differences see rounding at small steps and, at large ones, that the slopes of section data bend from one table cell to
the next: among several steps the one that agrees best counts.
"""

import math
import re
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Design, make_design
from rotor.aero.section import M
from rotor.design import ActiveTwist, Harmonic, Stand
from rotor.engine.linearise import MeasureSlopes, Point, evaluate, jacobian, part, transposed
from rotor.engine.terms import Terms
from rotor.support.arrays import Array
from rotor.trim import Analysis, analyse

STEPS = 10.0 ** -np.arange(4.0, 7.6, 0.5)
ACTIVE = ActiveTwist((Harmonic(2, 0.02, 0.3),), (0.2, 0.9), (0.0, 1.0))


@dataclass(frozen=True)
class Case:
    """A design, and what differs from the flight preset at µ = 0.2."""

    mu: float = 0.2
    preset: str = "flight"
    climb: float = 0.0
    stand: Stand | None = None
    trim: str | None = None
    precone: float | None = None
    active: ActiveTwist | None = None
    flap: tuple[float, float] = (0.0, 0.0)
    grid: tuple[int, int] = (20, 40)
    mass: float | None = None
    models: tuple[tuple[str, Any], ...] = ()


def flight(mu: float = 0.2, *, mass: float | None = None, **models: Any) -> Case:
    return Case(mu, mass=mass, models=tuple(models.items()))


def stand(
    trim: str, mu: float = 0.2, *, elastic: bool = True, precone: float | None = None, **given: Any
) -> Case:
    models = (("inflow", "drees"), ("elastic_twist", elastic))
    return Case(mu, trim=trim, stand=Stand(**given), precone=precone, models=models)


TILT = math.radians(5.0)
CASES = {
    **{name: flight(inflow=name) for name in ("uniform", "pitt-peters", "local-momentum", "lifting-line")},
    **{f"rigid {name}": flight(inflow=name, elastic_twist=False) for name in ("drees", "local-momentum")},
    "rigid lifting-line": flight(inflow="lifting-line", elastic_twist=False),
    "rigid without tip loss": flight(inflow="pitt-peters", elastic_twist=False, tip_loss=False),
    "without tip loss": flight(inflow="drees", tip_loss=False, hub_loss=False),
    "local without losses": flight(inflow="local-momentum", tip_loss=False, hub_loss=False),
    "no flapping": flight(flapping=False),
    "no flapping, rigid": flight(flapping=False, elastic_twist=False, inflow="local-momentum"),
    "precone": Case(precone=0.03),
    "no reverse flow": flight(0.35, reverse_flow=False),
    "fast": flight(0.4),
    "steady": flight(0.35, unsteady=False, dynamic_stall=False),
    "unsteady without dynamic stall": flight(0.35, dynamic_stall=False),
    "dynamic stall in steady flow": flight(0.35, unsteady=False),
    "axial flow of the disk left out": flight(disk_axial_flow=False),
    "without swirl": flight(swirl=False),
    "without yawed drag": flight(radial_friction=False),
    "without tip sweep": flight(swept_tip=False),
    "one Mach number": flight(compressibility=False),
    **{f"bending, {name}": flight(0.3, inflow=name, bending=True) for name in ("pitt-peters", "local-momentum")},
    "bending, lifting-line": flight(0.3, bending=True),
    "stalled": flight(0.35, mass=9500.0),
    "rigid, stalled": flight(0.35, mass=9500.0, elastic_twist=False),
    "bending, stalled": flight(0.35, mass=9500.0, bending=True),
    "active twist": Case(active=ACTIVE, flap=(-0.02, 0.01)),
    "rigid active twist": Case(active=ACTIVE, models=(("elastic_twist", False),)),
    "joined with hover": flight(0.06),
    "joined with hover, rigid": flight(0.06, elastic_twist=False),
    "joined, local-momentum": flight(0.06, inflow="local-momentum"),
    "climb": Case(climb=6.0),
    "descent": Case(climb=-8.0, models=(("inflow", "local-momentum"),)),
    "thrust": replace(flight(inflow="pitt-peters"), trim="thrust"),
    "thesis": Case(preset="thesis"),
    "thesis, loss on the lift": Case(preset="thesis", models=(("loss_on", "lift"),)),
    "loss on the inflow": flight(0.12, inflow="drees", loss_on="inflow"),
    "thesis propulsive": Case(preset="thesis", trim="propulsive"),
    "tunnel thrust": stand("wind-tunnel", ct_over_sigma=0.075, shaft_tilt=TILT),
    "tunnel thrust, free flapping": stand("wind-tunnel", ct_over_sigma=0.06, flapping="free", cyclic_1s=-0.03),
    "tunnel hub moments": stand(
        "wind-tunnel", ct_over_sigma=0.06, flapping="hub-moments", hub_roll=2e4, hub_pitch=-1e4
    ),
    "tunnel collective": stand("wind-tunnel", collective=0.12, elastic=False, shaft_tilt=TILT),
    "tunnel collective, free flapping": stand("wind-tunnel", collective=0.12, flapping="free", precone=0.03),
    "free rotor": stand("free-rotor", ct_over_sigma=0.06, flapping="free"),
    "free rotor, trimmed": stand("free-rotor", ct_over_sigma=0.06, elastic=False),
    "free rotor at a collective": stand("free-rotor", collective=0.035, flapping="free"),
    "controls": stand("controls", collective=0.12, flapping="free", cyclic_1c=0.01, cyclic_1s=-0.05),
    "hover": flight(0.0),
    "rigid hover": flight(0.0, elastic_twist=False),
    "closed form": flight(0.0, hover_inflow="closed-form"),
    "rigid closed form": flight(0.0, hover_inflow="closed-form", elastic_twist=False),
    "climbing hover": Case(0.0, climb=4.0),
    "hover of the thesis": Case(0.0, preset="thesis"),
    "hover without losses": flight(0.0, tip_loss=False, hub_loss=False, swirl=False),
    "hover at a collective": stand("wind-tunnel", 0.0, collective=0.12),
    "hover without flapping": flight(0.0, flapping=False),
}  # fmt: skip


def design(case: Case) -> Design:
    """A design on a coarse grid."""
    at = make_design(
        mu=case.mu,
        preset=case.preset,
        climb_m_s=case.climb,
        trim=case.trim,
        stand=case.stand,
        mass_kg=case.mass,
    )
    elements, azimuths = case.grid
    return replace(
        at,
        models=replace(at.models, elements=elements, azimuths=azimuths, **dict(case.models)),
        rotor=replace(at.rotor, precone=case.precone),
        condition=replace(at.condition, flap_1c=case.flap[0], flap_1s=case.flap[1]),
        active_twist=case.active,
    )


@cache
def trimmed(name: str) -> Analysis:
    return analyse(design(CASES[name]))


def solved(name: str) -> Point:
    """The equations at the trim of a case."""
    return trimmed(name).linear.point


def check(value: Callable[[float], Any], slope: Any, least: float) -> None:
    """A slope against central differences and those of two steps, of fourth order, to 1e-8 of itself or of `least`."""
    near, off, coarse = 1e-8 * max(float(np.abs(slope).max()), least), math.inf, None
    for step in STEPS:
        fine = (value(step) - value(-step)) / (2.0 * step)
        # A step is 1/√10 of that before.
        ways = [fine] if coarse is None else [fine, (10.0 * fine - coarse) / 9.0]
        off, coarse = min(off, *(float(np.abs(way - slope).max()) for way in ways)), fine
        if off <= near:
            return
    pytest.fail(f"{off:g} beside {near:g} with the step that agrees best")


def kinds_of(point: Point) -> tuple[list[Hashable], list[Hashable]]:
    """The kind of every equation and of every unknown, nodes included."""
    nodes: list[Hashable] = ["node"] * (len(point.residual) - len(point.system.structure.equations))
    equations, states = point.system.structure.kinds
    return equations + nodes, states + nodes


def directions(point: Point) -> list[Array]:
    """Steps of random size: each quantity of the trim alone, all of the elastic twist, and all nodes of the inflow."""
    random, kinds = np.random.default_rng(3), kinds_of(point)[1]
    sizes = {"lambda0": 0.1, "node": 0.003}
    found: list[Array] = []
    for kind in dict.fromkeys(kinds):
        own = np.array([kind == other for other in kinds])
        found.append(own * sizes.get(str(kind), 1.0) * random.uniform(0.5, 1.5, len(kinds)))
    return found


def moved(point: Point, way: Array, step: float) -> Point:
    x = point.x.copy()
    x[point.system.free] += step * way
    return evaluate(point.system, point.grid, x)


OPEN = re.compile("thesis|bending|axial flow|thrust$")
"""In the document's equations torque is not power, the damper of a bending blade takes some, and thrust alone leaves
the drag without a force."""


@pytest.mark.parametrize(
    "name", [name for name in CASES if name == "tunnel thrust" or not OPEN.search(name)]
)
def test_the_energy_closes(name: str):
    """P_shaft = Σ(λ_i dF_z + U dD) + D·V + W·V_c: torque, dissipation and trim are computed apart and must meet."""
    solution = trimmed(name).solution.require()
    power, flies = solution.power, solution.design.condition.stand is None
    spent = abs(power.induced) + power.profile + abs(power.parasite) + abs(power.climb)
    assert abs(power.shaft - power.main_rotor) <= 1e-8 * spent
    assert (
        abs(power.main_rotor - power.induced - power.profile - power.parasite - power.climb)
        <= 1e-13 * spent
    )
    if flies:
        assert_allclose(
            power.climb, solution.design.condition.weight * CASES[name].climb, rtol=1e-13
        )
    assert (power.tail > 0.0) == flies


@pytest.mark.parametrize("name", CASES)
def test_jacobian_against_differences(name: str):
    """Each kind of equation by each kind of state."""
    point = solved(name)
    matrix, kinds = jacobian(point)[0], kinds_of(point)[0]
    assert matrix.shape == (len(point.residual), len(point.system.free))
    for way in directions(point):
        ahead = cache(partial(moved, point, way))
        for kind in dict.fromkeys(kinds):
            rows = np.array([kind == other for other in kinds])
            least = 0.1 * float(np.abs(matrix[rows]).max() * np.abs(way).max())
            check(lambda step: ahead(step).residual[rows], matrix[rows] @ way, least)  # noqa: B023


@pytest.mark.parametrize("name", CASES)
def test_transposed_is_the_transpose(name: str):
    point = solved(name)
    matrix, random = jacobian(point)[0], np.random.default_rng(5)
    for v in random.standard_normal((2, len(point.residual))):
        expected = v @ matrix
        assert_allclose(
            transposed(point, v)[0],
            expected,
            rtol=0,
            atol=1e-12 * np.abs(expected).max(initial=0.0),
        )


def any_measures(point: Point) -> list[MeasureSlopes]:
    """Random weights on all that a measure may depend on; one measure of each kind."""
    random, structure = np.random.default_rng(11), point.system.structure
    shape, found = point.forces.shape[1:], structure.weights
    fields = {
        force: random.standard_normal(shape)
        for force, _ in structure.pairs
        if force != M or found[M]
    }
    channels = {channel: random.standard_normal(shape) for _, channel in structure.pairs}
    parts = [
        (c, list(own), random.standard_normal(shape))
        for c, own in enumerate(structure.shapes)
        if own
    ]
    known = [
        atom
        for name, atom in (structure.states | structure.derived).items()
        if "change" not in str(name)
    ]
    terms = [
        (int(random.integers(2)), int(random.integers(len(point.q))), *random.choice(known, 2).tolist(),
         float(random.standard_normal())) for _ in range(12)
    ]  # fmt: skip
    return [
        MeasureSlopes(fields),
        MeasureSlopes(channels=channels),
        MeasureSlopes(parts=parts),
        MeasureSlopes(terms=Terms.of(terms, 2)),
    ]


def value(point: Point, measure: MeasureSlopes) -> float:
    """What a measure adds up to at a point."""
    found = sum(float(np.vdot(own, point.forces[k])) for k, own in measure.forces.items())
    found += sum(float(np.vdot(own, point.channels[k])) for k, own in measure.channels.items())
    found += sum(float(np.vdot(own, part(point, k, names))) for k, names, own in measure.parts)
    return found + (
        0.0 if measure.terms is None else float(measure.terms.value(point.z, point.q).sum())
    )


@pytest.mark.parametrize("name", CASES)
def test_slopes_of_any_measure_by_the_states(name: str):
    point = solved(name)
    ways, nothing = directions(point), np.zeros(len(point.residual))
    for measure in any_measures(point):
        slopes = transposed(point, nothing, measure)[0]
        least = 0.1 * max((float(np.abs(slopes * way).max()) for way in ways), default=0.0)
        for way in ways:
            check(lambda step: value(moved(point, way, step), measure), slopes @ way, least)  # noqa: B023


@pytest.mark.parametrize("name", CASES)
def test_slopes_by_what_is_added_to_a_channel(name: str):
    """Slopes of weighted equations alone, and with measures of forces and of channels."""
    point = solved(name)
    structure, random = point.system.structure, np.random.default_rng(7)
    channels = sorted({channel for _, channel in structure.pairs if structure.shapes[channel]})
    v = random.standard_normal(len(point.residual))
    for measure in (MeasureSlopes(), *any_measures(point)[:2]):
        slopes = transposed(point, v, measure)[1].sum(axis=2)
        least = float(np.abs(slopes[channels]).sum(axis=1).max())
        for channel in channels:
            along = random.uniform(0.5, 1.5, slopes.shape[1])

            def shifted(step: float) -> float:
                steady = point.grid.steady.copy()
                steady[channel] += step * along  # noqa: B023
                there = evaluate(point.system, replace(point.grid, steady=steady), point.x)
                return float(v @ there.residual) + value(there, measure)  # noqa: B023

            check(shifted, slopes[channel] @ along, least)

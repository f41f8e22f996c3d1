"""How sure a power is, and how much surer a difference between two designs: what uncertain inputs do, to first order.

At a trim x of a design, with the multipliers a of power, Jᵀ a = ∂P/∂x, a neighbour d' of the design d costs

    ΔP = P(d', x) − P(d, x) − a·[R(d', x) − R(d, x)]:

one evaluation of its equations, no new trim. The course of the wake, and at low speed what hover adds, stay.
What is uncertain and by how much: `rotor.design.uncertain`.
An input is as wrong for one design as for another, so the change of a *difference* is the difference of the changes.
Inputs are wrong independently of one another, so their changes are summed as squares.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from rotor.aero.problem import Problem, build_problem
from rotor.aero.section import EARLIER_RISE, MORE_DRAG, MORE_LIFT, MORE_MOMENT, SCATTER
from rotor.arrays import Array
from rotor.columns.flight import flight_system
from rotor.columns.hover import hover_system
from rotor.design.blade import BladeStructure
from rotor.design.design import Design
from rotor.design.uncertain import Uncertain, uncertain_inputs
from rotor.engine.linearise import Point, evaluate, with_data
from rotor.trim.adjoint import adjoint_of
from rotor.trim.forward import SLOWEST
from rotor.trim.power import outside_power, tail_power
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

INFLOWS = ("lifting-line", "pitt-peters")
"""The two inflow models that most rotor codes have: vortices of the blades, and states of the disk."""
SURE, LIKELY = 2.0, 1.0
"""A change this many times its band is sure, or likely; a smaller one cannot be told."""
_PART = 0.1
"""Part of its size by which an input is changed: small, so that what is found is the slope for both signs."""


@dataclass(frozen=True)
class DoubtRow(Uncertain):
    """An uncertain input and what it does to one design, or to two."""

    power: float
    """Change of total power where the input is larger by its size [W]."""
    change: float | None = None
    """Change by the input of the power less that of the design compared with [W]; None without one."""


@dataclass(frozen=True)
class OtherModels:
    """A design, or two, solved with other models."""

    name: str
    """Name of the model, as `inflow pitt-peters`."""
    power: float
    """Total power [W]."""
    change: float | None = None
    """Less that of the design compared with [W]; None without one."""


@dataclass(frozen=True, repr=False)
class Doubt:
    """What is uncertain about the power of a design, and about what it saves against another."""

    power: float
    """Total power [W]."""
    rows: tuple[DoubtRow, ...]
    """Largest first."""
    against: float | None = None
    """Total power of the design compared with [W]; None without one."""
    name_of_other: str | None = None
    """SPEC of its twist."""
    models: tuple[OtherModels, ...] = ()
    """Beside the band, not in it."""

    def __repr__(self) -> str:
        return f"Doubt({self.sentence})"

    @property
    def band(self) -> float:
        """Band of the power, to both sides [W]."""
        return math.hypot(*(row.power for row in self.rows))

    @property
    def change(self) -> float | None:
        """Power less that of the design compared with [W]."""
        return None if self.against is None else self.power - self.against

    @property
    def change_band(self) -> float | None:
        """Band of `change`, to both sides [W]."""
        return None if self.against is None else math.hypot(*(row.change or 0.0 for row in self.rows))

    @property
    def change_band_percent(self) -> float | None:
        """`change_band` in per cent of the power compared with."""
        return None if self.change_band is None or not self.against else 100.0 * self.change_band / abs(self.against)

    @property
    def sureness(self) -> str | None:
        """`sure`, `likely` or `cannot be told`: whether the sign of the change is known; None without a change."""
        change, band = self.change, self.change_band
        if change is None or band is None:
            return None
        return sureness(change, band)

    @property
    def sentence(self) -> str:
        """In words: `Power 901 ± 52 kW. It saves 1.8 ± 0.7 % against A: sure.`"""
        said = f"Power {self.power / 1e3:.0f} ± {_two_digits(self.band / 1e3)} kW."
        change, band = self.change, self.change_band
        if change is None or band is None or not self.against:
            return said
        verb, part = ("saves", -change) if change <= 0.0 else ("costs", change)
        amount, within = 100.0 * part / abs(self.against), self.change_band_percent or 0.0
        digits = decimals(within)
        return f"{said} It {verb} {amount:.{digits}f} ± {within:.{digits}f} %: {self.sureness}."

    def record(self) -> dict[str, object]:
        """For `solve --doubt --json`."""
        return {
            "power_w": self.power,
            "total_w": self.band,
            "against": self.name_of_other,
            "against_w": self.against,
            "change_w": self.change,
            "change_band_w": self.change_band,
            "sureness": self.sureness,
            "rows": [
                {
                    "name": row.name,
                    "size": row.size,
                    "unit": row.unit,
                    "source": row.source,
                    "power_w": row.power,
                    "change_w": row.change,
                }
                for row in self.rows
            ],
            "models": {row.name: {"power_w": row.power, "change_w": row.change} for row in self.models},
        }


def sureness(change: float, band: float) -> str:
    """Whether the sign of a change is known within its band."""
    ratio = math.inf if band == 0.0 else abs(change) / band
    return "sure" if ratio >= SURE else "likely" if ratio >= LIKELY else "cannot be told"


def decimals(band: float) -> int:
    """Decimals with which a number is worth printing: those of one digit of its band, one more below 2."""
    if not (math.isfinite(band) and band > 0.0):
        return 1
    first = math.floor(math.log10(band))
    return max(0, -first + (band / 10.0**first < 2.0))


def _two_digits(value: float) -> str:
    return f"{value:.{decimals(value)}f}"


def doubt(solution: Solution, against: Solution | None = None, *, models: bool = False) -> Doubt:
    """How sure the power of a design is, and how much surer what it saves.

    Parameters:
        solution: a trim.
        against: the trim of another twist, or of any other design; by default there is no change to speak of.
        models: whether to solve with other models as well, one new trim each.

    Returns:
        The bands of the power and of its change, with what they consist of.

    Raises:
        RuntimeError: a solution is not converged, or is of a free rotor, which takes no power.

    Example:
        >>> here, built = (rotor.solve(rotor.make_design(mu=0.3, twist=twist)) for twist in ("linear:-12", "builtin"))
        >>> band = rotor.doubt(here, against=built)
        >>> band.change_band < 0.2 * band.band  # [W]
        True
    """
    here, there = power_changes(solution), None if against is None else power_changes(against)
    known = {row.name: row for row in uncertain_inputs(solution.design)}
    rows = [
        DoubtRow(
            name,
            row.words,
            row.size,
            row.source,
            power=here.get(name, 0.0),
            change=None if there is None else here.get(name, 0.0) - there.get(name, 0.0),
        )
        for name, row in known.items()
        if name in here or (there is not None and name in there)
    ]
    rows.sort(key=lambda row: -abs(row.power if row.change is None else row.change))
    return Doubt(
        solution.power.total,
        tuple(rows),
        None if against is None else against.power.total,
        None if against is None else against.design.twist.spec(),
        models_beside(solution.design, against and against.design) if models else (),
    )


def models_beside(design: Design, against: Design | None = None) -> tuple[OtherModels, ...]:
    """A design, or two, solved with one model changed, a new trim each; those that do not trim are left out."""
    rows: list[OtherModels] = []
    for name, changed in other_models(design).items():
        here = solve(changed)
        there = None if against is None else solve(other_models(against).get(name, against))
        if here.converged and (there is None or there.converged):
            change = None if there is None else here.power.total - there.power.total
            rows.append(OtherModels(name, here.power.total, change))
    return tuple(rows)


def other_models(design: Design) -> dict[str, Design]:
    """The design with one model changed, by name: another wake, blades that bend or do not, and unsteady flow.

    In hover the other wake is the lifting line, at the least speed that it has.
    """
    models, designs = design.models, dict[str, Design]()
    if design.hovering:
        line = replace(models, inflow=INFLOWS[0], low_speed="wake")
        return (
            {f"inflow {INFLOWS[0]}": replace(design.at(mu=SLOWEST), models=line)} if models.disk_axial_flow else designs
        )
    for inflow in INFLOWS:
        if inflow != models.inflow:
            designs[f"inflow {inflow}"] = replace(design, models=replace(models, inflow=inflow))
    structure = design.rotor.blade.structure
    if structure is not None and structure.bends and models.flapping:
        name = "rigid in bending" if models.bending else "bending"
        designs[name] = replace(design, models=replace(models, bending=not models.bending))
    if not models.document_losses:
        turned = "off" if build_problem(design).unsteady else "on"
        designs[f"unsteady flow {turned}"] = replace(design, models=replace(models, unsteady=turned))
    return designs


@lru_cache(maxsize=8)
def power_changes(solution: Solution) -> Mapping[str, float]:
    """What every uncertain input does to total power [W], where it is larger by its size.

    Raises RuntimeError with the solution's sentence when it is not converged, and for a free rotor.
    """
    if solution.design.models.trim == "free-rotor":
        raise RuntimeError("A free rotor takes no power from its shaft, so there is no band: use trim wind-tunnel.")
    near = _Near(solution)
    changes = dict[str, float]()
    for row in uncertain_inputs(solution.design):
        changed = _CHANGES[row.name](near.problem, _PART * row.size)
        if changed is not None:
            changes[row.name] = near.change(changed) / _PART
    if (tail := _tail(solution)) is not None:
        changes["tail_rotor_percent"] = tail
    return MappingProxyType(changes)


def _tail(solution: Solution) -> float | None:
    """The tail rotor has no part in the trim."""
    size = next(row.size for row in uncertain_inputs(solution.design) if row.name == "tail_rotor_percent")
    return 0.01 * size * solution.power.tail if solution.power.tail else None


class _Near:
    """A trim, and the power of designs near it."""

    def __init__(self, solution: Solution) -> None:
        adjoint = adjoint_of(solution)
        self.problem, self._point, self._terms = adjoint.problem, adjoint.point, adjoint.total_terms
        self._multipliers = adjoint.of_total
        self._gain = 1.0 + tail_power(solution.design, solution.power.main_rotor)[1]
        self._start = self._main(self.problem, self._point.z, self._point.q)

    def _main(self, problem: Problem, z: Array, q: Array) -> float:
        """Main-rotor power [W]."""
        return float(self._terms.value(z, q)[0]) * problem.design.power_unit + sum(outside_power(problem))

    def change(self, problem: Problem) -> float:
        """Total power of a problem less that of the trim [W], to first order."""
        point = self._point
        if problem.scatter is not self.problem.scatter and not problem.design.hovering:
            there = with_data(point, problem.grid_data(1))  # Only the section's own data are other.
            return self._difference(problem, there)
        system = (hover_system if problem.design.hovering else flight_system)(problem)
        x = point.x.copy()
        x[: len(system.numbers)] = system.numbers
        return self._difference(problem, evaluate(system, system.grid, x))

    def _difference(self, problem: Problem, there: Point) -> float:
        point = self._point
        missing = float(self._multipliers @ (there.residual - point.residual)) * problem.design.power_unit
        return (self._main(problem, there.z, there.q) - self._start - missing) * self._gain


Change = Callable[[Problem, float], Problem | None]
"""A problem where an input is larger by an amount in the unit of its name; None where it has no such input."""


def _section(row: int, unit: float = 1.0) -> Change:
    def change(problem: Problem, amount: float) -> Problem | None:
        if row == MORE_MOMENT and problem.torsion is None:
            return None
        if row == EARLIER_RISE and not problem.design.models.compressibility:
            return None
        return replace(problem, scatter=amount * unit * np.eye(len(SCATTER))[row])

    return change


def _rebuilt(problem: Problem, design: Design) -> Problem:
    """The problem of a design nearby, on the same course of the wake."""
    return replace(build_problem(design), course=problem.course, joined=problem.joined, freedoms=problem.freedoms)


def _drag_area(problem: Problem, amount: float) -> Problem | None:
    design = problem.design
    fuselage = design.fuselage
    if not fuselage.drag_area or design.hovering or design.condition.stand is not None:
        return None
    return _rebuilt(
        problem, replace(design, fuselage=replace(fuselage, drag_area=fuselage.drag_area * (1.0 + 0.01 * amount)))
    )


def _download(problem: Problem, amount: float) -> Problem | None:
    design = problem.design
    fuselage, models = design.fuselage, design.models
    if not (fuselage.hover_download and models.has("download")) or design.condition.stand is not None:
        return None
    download = fuselage.hover_download * (1.0 + 0.01 * amount)
    return _rebuilt(problem, replace(design, fuselage=replace(fuselage, hover_download=download)))


def _structure(change: Callable[[BladeStructure, float], BladeStructure]) -> Change:
    def changed(problem: Problem, amount: float) -> Problem | None:
        design, structure = problem.design, problem.design.rotor.blade.structure
        if problem.torsion is None or structure is None:
            return None
        blade = replace(design.rotor.blade, structure=change(structure, 1.0 + 0.01 * amount))
        return _rebuilt(problem, replace(design, rotor=replace(design.rotor, blade=blade)))

    return changed


def _times(values: tuple[float, ...], factor: float) -> tuple[float, ...]:
    return tuple(factor * value for value in values)


def _wake_transport(problem: Problem, amount: float) -> Problem | None:
    if problem.design.hovering or not problem.inflow.fine_tip:
        return None
    course = problem.course
    return replace(problem, course=replace(course, lambda0=course.lambda0 * (1.0 + 0.01 * amount)))


def _tip_loss(problem: Problem, amount: float) -> Problem | None:
    """1 − B, the part of the radius that does not lift, goes with 1/f."""
    if not problem.design.models.tip_loss or (problem.inflow.fine_tip and not problem.design.hovering):
        return None
    return replace(problem, tip_spacing=1.0 / (1.0 + 0.01 * amount))


_CHANGES: Mapping[str, Change] = {
    "section_drag_percent": _section(MORE_DRAG, 0.01),
    "section_lift_percent": _section(MORE_LIFT, 0.01),
    "section_moment": _section(MORE_MOMENT),
    "drag_rise_mach": _section(EARLIER_RISE),
    "drag_area_percent": _drag_area,
    "download_percent": _download,
    "tail_rotor_percent": lambda problem, amount: None,
    "torsional_stiffness_percent": _structure(
        lambda value, factor: replace(value, torsional_stiffness=_times(value.torsional_stiffness, factor))
    ),
    "control_stiffness_percent": _structure(
        lambda value, factor: replace(value, control_stiffness=factor * value.control_stiffness)
    ),
    "torsional_inertia_percent": _structure(
        lambda value, factor: replace(value, torsional_inertia=_times(value.torsional_inertia, factor))
    ),
    "wake_transport_percent": _wake_transport,
    "tip_loss_percent": _tip_loss,
}
"""By name, in the order of `assets/doubt.toml`."""

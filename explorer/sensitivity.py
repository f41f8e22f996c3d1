"""Power sensitivity of each slider: the change of total power for one natural step of it.

Twist sliders: exact. The adjoint gives ∂P/∂θ(r) with trim and inflow following, and the concept that belongs to the
law gives ∂θ_tw(r)/∂p, so that one step costs (∂P/∂θ · ∂θ_tw/∂p) × step. Flight sliders (advance ratio, mass, altitude):
central differences of two trims each, begun from the present one. They take some 50 ms, so they belong after the frame.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from explorer.pinned import FLIGHT
from explorer.state import LAWS, Inputs
from explorer.text.units import AVIATION, FOOT, FOOT_PER_MINUTE, POUND, SI, Units, number
from rotor.optimisation.concepts import CONCEPTS, Concept
from rotor.trim.adjoint import PitchGradient
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_CONCEPTS: dict[str, Concept] = {
    "builtin": CONCEPTS["two-segment-free"],
    "linear": CONCEPTS["linear"],
    "quadratic": CONCEPTS["quadratic"],
    "two": CONCEPTS["two-segment-free"],
    "three": CONCEPTS["three-segment-free"],
}
"""By law of the page: the concept with the same parameters in the same order as the law's inputs."""
_FLAT = 50.0
"""Power changes per step below this [W] are no effect: less than the last digit shown."""
_FRACTION = 0.1
"""Part of a step by which flight conditions are moved for the differences."""


@dataclass(frozen=True)
class NaturalStep:
    """The step of a slider that an engineer thinks in."""

    size: float
    """In the unit of the field of `Inputs`."""
    unit: str
    """What follows the power, for example `/°` or `/0.1 R`."""


_RATE = NaturalStep(1.0, "/°")
_PLACE = NaturalStep(0.1, "/0.1 R")
STEPS: dict[str, NaturalStep] = {
    "built_inner": _RATE,
    "built_outer": _RATE,
    "built_division": _PLACE,
    "linear": _RATE,
    "quadratic_curvature": _RATE,
    "quadratic_difference": _RATE,
    "two_inner": _RATE,
    "two_outer": _RATE,
    "two_division": _PLACE,
    "three_inner": _RATE,
    "three_middle": _RATE,
    "three_outer": _RATE,
    "three_first": _PLACE,
    "three_second": _PLACE,
    "advance_ratio": NaturalStep(0.01, "/0.01"),
    "mass_t": NaturalStep(0.1, "/100 kg"),
    "altitude_m": NaturalStep(100.0, "/100 m"),
    "climb_m_s": NaturalStep(1.0, "/(m/s)"),
}
"""By the field of `Inputs`, in SI."""
_AVIATION_STEPS = {
    "mass_t": NaturalStep(200.0 * POUND.size / 1e3, "/200 lb"),
    "altitude_m": NaturalStep(500.0 * FOOT.size, "/500 ft"),
    "climb_m_s": NaturalStep(100.0 * FOOT_PER_MINUTE.size, "/(100 ft/min)"),
}


@dataclass(frozen=True)
class SliderSensitivity:
    """Power sensitivity of one slider at its present position."""

    name: str
    """The field of `Inputs`."""
    slope: float
    """∂P/∂(input) of total power [W per unit of the input]."""

    def watts(self, units: Units = SI) -> float:
        """Change of total power for one natural step up [W]."""
        return self.slope * natural_step(self.name, units).size

    @property
    def saving_direction(self) -> int:
        """Where to move the slider to save power: 1 up, −1 down, 0 where a step changes less than 50 W."""
        watts = self.watts()
        return 0 if abs(watts) < _FLAT else -1 if watts > 0.0 else 1

    def value_text(self, units: Units = SI) -> str:
        """The change of power for one step up, signed, one decimal: `−2.6`."""
        return number(units.power[0].of(self.watts(units)), 1, sign=True)

    def unit_text(self, units: Units = SI) -> str:
        """What belongs behind the number: `kW/°`, `kW/0.1 R`, `hp/200 lb`."""
        return units.power[0].symbol + natural_step(self.name, units).unit

    def text(self, units: Units = SI) -> str:
        """Number and unit, or that a step changes nothing: `−2.6 kW/0.1 R`, `no effect`."""
        return f"{self.value_text(units)} {self.unit_text(units)}" if self.saving_direction else "no effect"


def natural_step(name: str, units: Units = SI) -> NaturalStep:
    """The step that the sensitivity of a slider is given for; KeyError for a name without a slider."""
    return _AVIATION_STEPS[name] if units is AVIATION and name in _AVIATION_STEPS else STEPS[name]


def twist_sensitivities(inputs: Inputs, gradient: PitchGradient) -> dict[str, SliderSensitivity]:
    """Exact sensitivity of each slider of the present twist law, in the order of the page; empty without sliders.

    `gradient`: of the solution of these inputs.
    """
    concept = _CONCEPTS.get(inputs.law)
    if concept is None:
        return {}
    names = LAWS[inputs.law].inputs
    values = [
        parameter.from_shown(getattr(inputs, name)) for parameter, name in zip(concept.parameters, names, strict=True)
    ]
    by_parameter = gradient.along(concept.slopes(values, gradient.r))
    return {
        name: SliderSensitivity(name, float(slope) * parameter.from_shown(1.0))
        for name, parameter, slope in zip(names, concept.parameters, by_parameter, strict=True)
    }


def flight_sensitivities(
    solution: Solution, superseded: Callable[[], bool] = lambda: False
) -> dict[str, SliderSensitivity]:
    """Sensitivity of the flight's sliders by central differences of a tenth of a step.

    One-sided where one neighbour does not trim or lies outside the permitted range; a slider without a trimmed
    neighbour is left out, and so is the advance ratio in hover, which another model computes. `superseded` is asked
    before every trim; once it says yes the sliders so far are returned. On a test stand only the advance ratio counts.
    """
    found: dict[str, SliderSensitivity] = {}
    tested = solution.design.condition.stand is not None
    for name in FLIGHT[:1] if tested else FLIGHT:
        if name == "advance_ratio" and solution.design.hovering:
            continue
        if name == "climb_m_s" and not solution.design.models.disk_axial_flow:
            continue
        points = [(0.0, solution.power.total)]
        for direction in (-1.0, 1.0):
            if superseded():
                return found
            step = direction * _FRACTION * STEPS[name].size
            moved = _moved(solution, name, step)
            if moved is not None:
                points.append((step, moved))
        steps, powers = zip(*sorted(points), strict=True)
        if len(points) > 1:
            found[name] = SliderSensitivity(name, float((powers[-1] - powers[0]) / (steps[-1] - steps[0])))
    return found


def _moved(solution: Solution, name: str, step: float) -> float | None:
    """Total power [W] with one flight input moved; None where there is no trim or no such condition."""
    condition = solution.design.condition
    try:
        match name:
            case "advance_ratio":
                if condition.advance_ratio + step <= 0.0:
                    return None  # Hover is another model.
                moved = replace(condition, advance_ratio=condition.advance_ratio + step)
            case "mass_t":
                moved = replace(condition, mass=condition.mass + 1e3 * step)
            case "climb_m_s":
                moved = replace(condition, climb_speed=condition.climb_speed + step)
            case _:
                moved = replace(condition, altitude=condition.altitude + step)
    except ValueError:
        return None
    answer = solve(replace(solution.design, condition=moved), solution)
    return answer.power.total if answer.converged and np.isfinite(answer.power.total) else None

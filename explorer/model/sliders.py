"""The sliders of the design: what each can hold, in SI and in aviation units, and the power sensitivity of each.

Power sensitivity is the change of total power for one natural step of a slider. Twist sliders: exact. The adjoint gives
∂P/∂θ(r) with trim and inflow following, and the concept that belongs to the law gives ∂θ_tw(r)/∂p, so that one step
costs (∂P/∂θ · ∂θ_tw/∂p) × step. Flight sliders: central differences of two trims each, begun from the present one. They
take some 50 ms, so they belong after the frame.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from explorer.model.inputs import FLIGHT, LAWS, ROWS, Inputs, mass_range
from explorer.model.undo import differing
from explorer.model.units import AVIATION, POUND, SI, Units, form_of, meant, number
from rotor import Aircraft, Solution, solve
from rotor.assets import SHIPPED_ROTORS
from rotor.design.quantity import Slider
from rotor.files.rotor_file import shipped_aircraft
from rotor.optimisation import CONCEPTS, Concept
from rotor.trim import PitchGradient

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
_HALVINGS = 6
"""Trims that look for the last design that trims: to a sixty-fourth of the way."""
_FRACTION = 0.1
"""Part of a step by which flight conditions are moved for the differences."""


def _weight(aircraft: Aircraft, units: Units) -> Slider:
    """About the aircraft's reference mass: in tonnes round numbers, in pounds those that reach as far."""
    low, high, step = mass_range(aircraft)
    if units is not AVIATION:
        return Slider("Mass [t]", low, high, step, 0.1, "/100 kg")
    coarse = 100.0 if high > 4.0 else 10.0
    ends = (math.floor(POUND.of(1e3 * low) / coarse), math.ceil(POUND.of(1e3 * high) / coarse))
    return Slider("Mass [lb]", coarse * ends[0], coarse * ends[1], coarse, 0.2 * POUND.size, "/200 lb")


_FIRST = shipped_aircraft(SHIPPED_ROTORS[0])
SLIDERS: dict[str, Slider] = {name: row.slider for name, row in ROWS.items() if row.slider}
"""By the field of `Inputs`, in SI; the weight is the first rotor's."""


def slider(name: str, units: Units, aircraft: Aircraft = _FIRST) -> Slider:
    """The slider as it is shown in these units, for this aircraft."""
    if name == "mass_t":
        return _weight(aircraft, units)
    if name == "advance_ratio" and aircraft.isolated:
        return replace(SLIDERS[name], high=0.75)
    return form_of(ROWS[name], units)


def limits(name: str, aircraft: Aircraft = _FIRST) -> tuple[float, float]:
    """What the slider can hold in whichever units are shown."""
    in_si, in_aviation = slider(name, SI, aircraft), slider(name, AVIATION, aircraft)
    if (row := ROWS[name]).aviation is None:
        return in_si.low, in_si.high
    low, high = meant(row, in_aviation.low, AVIATION), meant(row, in_aviation.high, AVIATION)
    return min(in_si.low, low), max(in_si.high, high)


@dataclass(frozen=True)
class SliderSensitivity:
    """Power sensitivity of one slider at its present position."""

    name: str
    """The field of `Inputs`."""
    slope: float
    """∂P/∂(input) of total power [W per unit of the input]."""

    def watts(self, units: Units = SI) -> float:
        """Change of total power for one natural step up [W]."""
        return self.slope * slider(self.name, units).natural

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
        return units.power[0].symbol + slider(self.name, units).per


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
    sensitivities: dict[str, SliderSensitivity] = {}
    tested, axial = solution.design.condition.stand is not None, solution.design.models.disk_axial_flow
    for name, row in FLIGHT.items():
        if name == "advance_ratio" and solution.design.hovering:
            continue
        if (tested and name != "advance_ratio") or not row.applies(tested=tested, axial=axial):
            continue
        points = [(0.0, solution.power.total)]
        for direction in (-1.0, 1.0):
            if superseded():
                return sensitivities
            step = direction * _FRACTION * SLIDERS[name].natural
            moved = _moved(solution, name, step)
            if moved is not None:
                points.append((step, moved))
        steps, powers = zip(*sorted(points), strict=True)
        if len(points) > 1:
            sensitivities[name] = SliderSensitivity(name, float((powers[-1] - powers[0]) / (steps[-1] - steps[0])))
    return sensitivities


def _moved(solution: Solution, name: str, step: float) -> float | None:
    """Total power [W] with one flight input moved; None where there is no trim or no such condition."""
    row = ROWS[name]
    value = row.of(solution.design) + row.input_size * step
    if name == "advance_ratio" and value <= 0.0:
        return None  # Hover is another model.
    try:
        moved = row.put(solution.design, value)
    except ValueError:
        return None
    answer = solve(moved, solution)
    return answer.power.total if answer.converged and np.isfinite(answer.power.total) else None


def nearest_trim(good: Inputs, wanted: Inputs, trims: Callable[[Inputs], bool]) -> Inputs:
    """The last design that trims, from one that does towards one that does not, on the sliders' steps.

    Sliders that differ move together; where anything else differs it is `good` itself.
    """
    moved = differing(good, wanted)
    if not moved or not all(isinstance(getattr(good, name), float) and name in SLIDERS for name in moved):
        return good

    def between(share: float) -> Inputs:
        values: dict[str, Any] = {}
        for name in moved:
            start, end = getattr(good, name), getattr(wanted, name)
            step = slider(name, SI, good.aircraft).step
            # Towards the good end, so that the step does not lead beyond what trims.
            values[name] = round(start + math.trunc(share * (end - start) / step) * step, 6)
        return replace(good, **values)

    reached, low, high = good, 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        there = between(middle)
        if trims(there):
            reached, low = there, middle
        else:
            high = middle
    return reached

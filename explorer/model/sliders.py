"""The sliders of the design: what each can hold, in SI and in aviation units, and the power sensitivity of each; and
twisting the blade by hand: from a drag in the scene to the inputs on the sliders. Values only.

Power sensitivity is the change of total power for one natural step of a slider. Twist sliders: exact. The adjoint gives
∂P/∂θ(r) with trim and inflow following, and the concept that belongs to the law gives ∂θ_tw(r)/∂p, so that one step
costs (∂P/∂θ · ∂θ_tw/∂p) × step. Flight sliders: central differences of two trims each, begun from the present one. They
come after the frame.

The stations that can be grabbed are the root, the divisions and the tip. Turning one twists the pieces on both sides of
it, so the station turns by that angle relative to its neighbours. Sliding a division moves it along the blade.
"""

import math
import re
from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from explorer.model.inputs import FLIGHT, LAWS, ROWS, Inputs, mass_range
from explorer.model.units import AVIATION, POUND, SI, Units, form_of, number, slider_input
from rotor import Aircraft, Solution, solve
from rotor.design.quantities import STAND
from rotor.design.quantity import Slider
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import SHIPPED_ROTORS
from rotor.trim import PitchGradient

_FRACTION = 0.1
"""Part of a step by which flight conditions are moved for the differences."""


def _weight(aircraft: Aircraft, units: Units) -> Slider:
    """About the aircraft's reference mass: in tonnes round numbers, in pounds those that reach as far."""
    low, high, step = mass_range(aircraft)
    if units.title != AVIATION.title:
        return Slider("Mass [t]", low, high, step, 0.1, "/100 kg")
    coarse = 100.0 if high > 4.0 else 10.0
    ends = (math.floor(POUND.of(1e3 * low) / coarse), math.ceil(POUND.of(1e3 * high) / coarse))
    return Slider(
        "Mass [lb]", coarse * ends[0], coarse * ends[1], coarse, 0.2 * POUND.size, "/200 lb"
    )


_FIRST = shipped_aircraft(SHIPPED_ROTORS[0])
SLIDERS: dict[str, Slider] = {name: row.slider for name, row in ROWS.items() if row.slider}
"""By the field of `Inputs`, in SI; the weight is the first rotor's."""


def slider(name: str, units: Units, aircraft: Aircraft = _FIRST) -> Slider:
    """The slider as it is shown in these units, for this aircraft."""
    if name == "mass_t":
        return _weight(aircraft, units)
    form = form_of(ROWS[name], units)
    # Also the rotor of a propeller.
    if aircraft.isolated and name in (
        "advance_ratio",
        "climb_m_s",
    ):
        row = ROWS[name]
        high = (row.high_on_stand or row.high) / form.size
        return replace(form, high=high, low=-high if row.low < 0.0 else form.low)
    return form


def limits(name: str, aircraft: Aircraft = _FIRST) -> tuple[float, float]:
    """What the slider can hold in whichever units are shown."""
    in_si, in_aviation = slider(name, SI, aircraft), slider(name, AVIATION, aircraft)
    if (row := ROWS[name]).aviation is None:
        return in_si.low, in_si.high
    low, high = (
        slider_input(row, in_aviation.low, AVIATION),
        slider_input(row, in_aviation.high, AVIATION),
    )
    return min(in_si.low, low), max(in_si.high, high)


STAND_SLIDERS = {row.input: row.slider for row in STAND.values() if row.slider}
"""Those of a test, by the field of `StandInputs`, or by what is given."""


def stand_slider(name: str, inputs: Inputs) -> Slider:
    """The slider of a load for this rotor at its speed: thrust to a loading of 0.2 at sea level, in round numbers."""
    form = STAND_SLIDERS[name]
    if name != "thrust_n":
        return form
    rotor = inputs.aircraft.rotor
    most = 0.2 * rotor.solidity * 1.225 * rotor.disk_area * inputs.tip_speed**2
    step = 10.0 ** (len(str(int(most))) - 3)
    return replace(form, high=step * (most // step + 1.0), step=step)


@dataclass(frozen=True)
class SliderSensitivity:
    """∂P/∂(input) of total power [W per unit of the input] by a field of `Inputs` at its present position."""

    name: str
    slope: float

    def watts(self, units: Units = SI) -> float:
        """Change of total power for one natural step up [W]."""
        return self.slope * slider(self.name, units).natural

    def saving_direction(self, units: Units = SI, digits: int = 1) -> int:
        """Where to move the slider to save power: 1 up, −1 down, 0 where a step changes none of so many decimals."""
        change = units.power[0].of(self.watts(units))
        return 0 if abs(change) < 0.5 * 10.0**-digits else -1 if change > 0.0 else 1

    def value_text(self, units: Units = SI, digits: int = 1) -> str:
        """The change of power for one step up, signed: `−2.6`."""
        return number(units.power[0].of(self.watts(units)), digits, sign=True)

    def unit_text(self, units: Units = SI) -> str:
        """What belongs behind the number: `kW per °/R`, `kW/0.1 R`, `hp/200 lb`."""
        return units.power[0].symbol + slider(self.name, units).per


def twist_sensitivities(inputs: Inputs, gradient: PitchGradient) -> dict[str, SliderSensitivity]:
    """Exact sensitivity of each slider of the present twist law, in the order of the page; empty without sliders.

    `gradient`: of the solution of these inputs.
    """
    law = LAWS[inputs.law]
    if not law.parameters:
        return {}
    by_parameter = gradient.along(law.slopes(inputs.parameters, gradient.r))
    rows = zip(law.inputs, law.parameters, by_parameter, strict=True)
    return {
        name: SliderSensitivity(name, float(slope) * parameter.from_shown(1.0))
        for name, parameter, slope in rows
    }


def flight_sensitivities(solution: Solution) -> Generator[None, None, dict[str, SliderSensitivity]]:
    """Sensitivity of the flight's sliders by central differences of a tenth of a step.

    One-sided where one neighbour does not trim or lies outside the permitted range; a slider without a trimmed
    neighbour is left out, and so is the advance ratio in hover, which another model computes. On a test stand only the
    advance ratio counts. Yields before every trim.
    """
    sensitivities: dict[str, SliderSensitivity] = {}
    tested, axial = (
        solution.design.condition.stand is not None,
        solution.design.models.disk_axial_flow,
    )
    for name, row in FLIGHT.items():
        if name == "advance_ratio" and solution.design.hovering:
            continue
        if (tested and name != "advance_ratio") or not row.applies(tested=tested, axial=axial):
            continue
        points = [(0.0, solution.power.total)]
        for direction in (-1.0, 1.0):
            yield
            step = direction * _FRACTION * SLIDERS[name].natural
            moved = _moved(solution, name, step)
            if moved is not None:
                points.append((step, moved))
        steps, powers = zip(*sorted(points), strict=True)
        if len(points) > 1:
            sensitivities[name] = SliderSensitivity(
                name, float((powers[-1] - powers[0]) / (steps[-1] - steps[0]))
            )
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


_MASS_NAMED = re.compile(r"(?:is|are) (\d+) kg (?:at this speed|in hover)")
_MU_NAMED = re.compile(r"advance ratio (\d\.\d+) at this mass")
_LOADING_NAMED = re.compile(r"C_?T/σ (\d\.\d+) (?:at this advance ratio|in hover)")
"""What sentences about a trim that is not found name."""


def nearest_trim(
    wanted: Inputs, trims: Callable[[Inputs], bool], sentence: str, carried: float = 0.0
) -> Inputs | None:
    """The nearest inputs that trim, on the sliders' steps, None where none are known.

    They have the mass, the advance ratio or the loading that the sentence names, of several the one that is least below
    what was asked for.

    `carried`: mass of an actuator [kg], which the sentence counts and the slider does not.
    """
    named = [
        _with_mass_named(wanted, sentence, carried),
        _with_speed_named(wanted, sentence),
        _with_loading_named(wanted, sentence),
    ]
    moves = [move for move in named if move is not None]
    for move in sorted(moves, key=lambda move: move.share):
        if trims(move.inputs):
            return move.inputs
    return None


class _Move(NamedTuple):
    """Inputs with another value of one slider."""

    inputs: Inputs
    share: float
    """By which part of the value that was asked for it is less."""


def _with_mass_named(wanted: Inputs, sentence: str, carried: float) -> _Move | None:
    found = _MASS_NAMED.search(sentence)
    if found is None or wanted.stand is not None:
        return None
    mass = (float(found[1]) - carried) / ROWS["mass_t"].input_size
    return _moved_down(wanted, "mass_t", mass)


def _with_speed_named(wanted: Inputs, sentence: str) -> _Move | None:
    found = _MU_NAMED.search(sentence)
    return None if found is None else _moved_down(wanted, "advance_ratio", float(found[1]))


def _moved_down(wanted: Inputs, name: str, value: float) -> _Move:
    """With the last step of a slider up to a value."""
    there = _last_step(value, slider(name, SI, wanted.aircraft).step)
    return _Move(replace(wanted, **{name: there}), 1.0 - there / getattr(wanted, name))


def _with_loading_named(wanted: Inputs, sentence: str) -> _Move | None:
    """A test with the thrust of the loading that is named."""
    found = _LOADING_NAMED.search(sentence)
    stand = wanted.stand
    if found is None or stand is None or stand.load not in ("ct_over_sigma", "thrust_n"):
        return None
    value = float(found[1])
    if stand.load == "thrust_n":
        design = wanted.design()
        value *= design.rotor.solidity * design.thrust_unit
    there = _last_step(value, stand_slider(stand.load, wanted).step)
    return _Move(replace(wanted, stand=replace(stand, value=there)), 1.0 - there / stand.value)


def _last_step(value: float, step: float) -> float:
    """The last place of a slider up to a value."""
    return round(math.floor(value / step + 1e-6) * step, 6)


DETENT = 0.35
"""Half the width of the hold at the best angle of the grabbed station [°]."""
_LEAST_TURN = 0.15
"""A smaller change of turn [°] gives no slope: the residuals of the trims are too large for it."""
_LARGEST_TURN = 12.0
"""No best angle is given further away than this [°]."""


@dataclass(frozen=True)
class BladeStation:
    """A place of the blade that can be grabbed, at r/R, counted from the root; sliding it changes `division`."""

    index: int
    r: float
    title: str
    division: str | None = None


def grabbed_inputs(inputs: Inputs) -> Inputs:
    """The inputs with a law that can be grabbed: any other is replaced by the nearest two segments."""
    if stations(inputs):
        return inputs
    root, twist = _root(inputs), inputs.design().twist
    *rates, division = LAWS["two"].inputs
    values: dict[str, Any] = {division: (middle := 0.5)}
    for name, ends in zip(rates, ((root, middle), (middle, 1.0)), strict=True):
        r = np.linspace(*ends, 30)
        values[name] = _onto(name, math.degrees(np.polyfit(r, twist(r), 1)[0]))
    return replace(inputs, law="two", given=None, optimised=None, **values)


def stations(inputs: Inputs) -> tuple[BladeStation, ...]:
    """Where the law on the sliders can be grabbed, root to tip; none where its parameters are no turns and bends."""
    law, root = LAWS[inputs.law], _root(inputs)
    motions = [handle.motion for handle in law.handles]
    if motions.count("tilt") != len(law.breaks) + 1 or not {*motions} <= {"tilt", "bend", "slide"}:
        return ()
    places = [(getattr(inputs, name), "break point", name) for name in law.breaks]
    if "bend" in motions:
        places = [(0.5 * (root + 1.0), "middle", None)]
    every = ((root, "root", None), *places, (1.0, "tip", None))
    return tuple(BladeStation(index, *place) for index, place in enumerate(every))


def _root(inputs: Inputs) -> float:
    return inputs.aircraft.rotor_for(inputs.preset).blade.root_cutout


def with_station_turned(inputs: Inputs, station: BladeStation, degrees: float) -> Inputs:
    """The inputs with a station turned nose up relative to its neighbours, as far as the sliders go."""
    slopes = turn_slopes(inputs, station)
    (lowest, _), (highest, _) = turn_ends(inputs, station)
    degrees = min(max(degrees, lowest), highest)
    values: dict[str, Any] = {
        name: _onto(name, getattr(inputs, name) + s * degrees) for name, s in slopes.items()
    }
    return replace(inputs, **values)


def turn_ends(inputs: Inputs, station: BladeStation) -> tuple[tuple[float, str], tuple[float, str]]:
    """The least and the greatest turn [°] of a station, each with the input that meets its limit there first."""
    ends = [
        sorted(((end - getattr(inputs, name)) / slope, name) for end in limits(name))
        for name, slope in turn_slopes(inputs, station).items()
    ]
    return max(low for low, _ in ends), min(high for _, high in ends)


def turn_slopes(inputs: Inputs, station: BladeStation) -> dict[str, float]:
    """By how much each input moves for a degree that a station is turned nose up."""
    places, law = [place.r for place in stations(inputs)], LAWS[inputs.law]
    here, root, tip = places[station.index], places[0], places[-1]
    pieces = pairwise((root, *(getattr(inputs, name) for name in law.breaks), tip))
    slopes: dict[str, float] = {}
    for name, handle in zip(law.inputs, law.handles, strict=True):
        if handle.motion == "tilt":
            inner, outer = next(pieces)
            if here in (inner, outer):
                slopes[name] = (1.0 if here == outer else -1.0) / (outer - inner)
        elif handle.motion == "bend" and here not in (root, tip):
            # A parabola lies a quarter of its coefficient times its span squared below its chord.
            slopes[name] = -4.0 / (tip - root) ** 2
    return slopes


def place_of(inputs: Inputs, station: BladeStation) -> str:
    """A station and its built-in twist, in words."""
    twist = inputs.twist()
    law = inputs.design().twist if isinstance(twist, str) else twist
    angle = math.degrees(float(law(np.array([station.r]))[0]))
    return f"{station.title} {station.r:.2f} R · twist {angle:+.1f}°".replace("-", "−")


def slid(inputs: Inputs, station: BladeStation, r: float) -> Inputs:
    """The inputs with a division at another r/R, within its slider, which ends before the next one's begins."""
    if station.division is None:
        return inputs
    low, high = limits(station.division)
    value = min(max(r, low), high)
    return replace(inputs, **{station.division: _onto(station.division, value)})  # pyright: ignore[reportArgumentType]


@dataclass(frozen=True)
class StationDrag:
    """One drag of a station, from the press to the release."""

    inputs: Inputs
    """When it began, with a law that can be grabbed."""
    station: BladeStation

    def turned(self, degrees: float, best: float | None = None) -> Inputs:
        """The inputs with the station turned so far; `best`: a turn [°] at which it is held for a while."""
        held = best is not None and abs(degrees - best) < DETENT
        return with_station_turned(
            self.inputs, self.station, best if best is not None and held else degrees
        )

    def turn_to(self, inputs: Inputs) -> float | None:
        """By how much the station has been turned in `inputs` [°]; None where they have another law."""
        if inputs.law != self.inputs.law:
            return None
        name, slope = next(iter(turn_slopes(self.inputs, self.station).items()))
        return (getattr(inputs, name) - getattr(self.inputs, name)) / slope

    def power_slope(self, by_input: Mapping[str, float]) -> float | None:
        """Change of power for a degree of turn, from that by each input; None where one is missing."""
        slopes = turn_slopes(self.inputs, self.station)
        if not slopes.keys() <= by_input.keys():
            return None
        return sum(slope * by_input[name] for name, slope in slopes.items())


@dataclass(frozen=True)
class BestTurn:
    """The turn of least power of one station, foreseen from powers and slopes at the turns seen so far."""

    seen: tuple[tuple[float, float, float], ...] = ()
    """Turn [°], power [W] and its exact slope [W/°] there, the latest last."""
    now: tuple[float, float, float] | None = None
    """The latest, where its slope is not known: that of the parabola through its power, which the nearest of those seen
    touches."""

    def with_turn(self, turn: float, power: float, slope: float) -> "BestTurn":
        """This search with one more turn seen."""
        others = tuple(point for point in self.seen if abs(point[0] - turn) > 1e-6)
        return BestTurn((*others, (turn, power, slope))[-40:])

    def with_power(self, turn: float, power: float) -> "BestTurn":
        """This search at a turn whose power alone is known."""
        if not self.seen:
            return self
        at, there, slope = min(self.seen, key=lambda point: abs(point[0] - turn))
        if abs(turn - at) < _LEAST_TURN:
            return replace(self, now=None)
        return replace(self, now=(turn, power, 2.0 * (power - there) / (turn - at) - slope))

    @property
    def turn(self) -> float | None:
        """The turn of least power [°]; None while it is not known, or no minimum is near."""
        least = self._least
        return None if least is None else least[0]

    @property
    def power(self) -> float | None:
        """Least power [W] by turning this station; None while it is not known."""
        least = self._least
        return None if least is None else least[1]

    @property
    def _least(self) -> tuple[float, float] | None:
        """Turn and power where the slope, straight between two turns seen, is zero."""
        seen = self.seen if self.now is None else (*self.seen, self.now)
        if len(seen) < 2:
            return None
        now = seen[-1][0]
        below = [point for point in seen if point[2] < 0.0]
        above = [point for point in seen if point[2] >= 0.0]
        if below and above:
            # Between the two closest turns on either side of the minimum.
            pair = min(
                ((a, b) for a in below for b in above), key=lambda two: abs(two[0][0] - two[1][0])
            )
        else:
            near = sorted(seen, key=lambda point: abs(point[2]))
            pair = (
                near[0],
                next(
                    (point for point in near[1:] if abs(point[0] - near[0][0]) > _LEAST_TURN),
                    near[1],
                ),
            )
        (t1, p1, s1), (t2, p2, s2) = pair
        if not (s2 - s1) * (t2 - t1) > 0.0:
            return None  # Power does not curve upward: no minimum is this way.
        best = t1 - s1 * (t2 - t1) / (s2 - s1)
        if abs(best - now) >= _LARGEST_TURN:
            return None
        t, p, s = min((t1, p1, s1), (t2, p2, s2), key=lambda point: abs(point[0] - best))
        return best, p + 0.5 * s * (best - t)


def drag_from(inputs: Inputs, r: float) -> StationDrag | None:
    """A press on the blade at r/R takes the nearest station. None where there is nothing to grab."""
    ready = grabbed_inputs(inputs)
    choice = stations(ready)
    return (
        StationDrag(ready, min(choice, key=lambda station: abs(station.r - r))) if choice else None
    )


def on_steps(inputs: Inputs) -> Inputs:
    """The inputs with the twist at the nearest places that its sliders have."""
    return replace(
        inputs, **{name: _onto(name, getattr(inputs, name)) for name in LAWS[inputs.law].inputs}
    )


def _onto(name: str, value: float) -> float:
    """The nearest place that the slider has."""
    step = slider(name, SI).step
    low, high = limits(name)
    return round(min(max(step * round(value / step), low), high), 4)

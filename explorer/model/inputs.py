"""The rotors of the menu, the sliders and what is shown, as values; degrees, tonnes and knots end here."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cache, cached_property
from itertools import pairwise
from typing import Any

from explorer.model.stand import StandInputs, stand_of, tested
from rotor import Aircraft, Design, make_design
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES
from rotor.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.design import (
    ActiveTwist,
    Harmonic,
    IdealTwist,
    LinearTwist,
    PiecewiseLinearTwist,
    QuadraticTwist,
    SumTwist,
    TwistLaw,
)
from rotor.design.blade import airfoils_spec
from rotor.design.design import FLIGHT_MODELS, preset_models
from rotor.files.make_design import change_airfoils
from rotor.files.rotor_file import shipped_aircraft
from rotor.units import KNOT

OWN = "own"
"""Name in `Inputs` of the user's own rotor."""
_LIGHTEST, _HEAVIEST = 0.6, 1.32
"""Ends of the weight slider over the rotor's reference mass."""


@cache
def menu_titles(own: Aircraft | None) -> dict[str, str]:
    """The menu: name in `Inputs` → title; rotors that were tested on a stand follow, the user's own comes last."""
    titles = {
        name: re.sub(r"-(\d+) deg\b", "−\\1°", shipped_aircraft(name).name)
        for name in (*SHIPPED_ROTORS, *MEASURED_ROTORS)
    }
    return titles if own is None else {**titles, OWN: f"{own.name} (own)"}


def mass_range(aircraft: Aircraft) -> tuple[float, float, float]:
    """Lowest, highest and step of the weight slider [t], round numbers about the reference mass."""
    tonnes = aircraft.mass / 1e3
    if aircraft.isolated:
        return 0.0, 2.0 * tonnes, tonnes / 50.0  # A rotor alone carries no weight.
    step = 0.05 if tonnes > 3.0 else 0.01 if tonnes > 1.0 else 0.005
    low, high = (round(share * tonnes / step) for share in (_LIGHTEST, _HEAVIEST))
    return round(max(low * step, 0.1), 4), round(high * step, 4), step


def reference_mass_t(aircraft: Aircraft) -> float:
    """The reference mass [t], rounded, within the range of the weight slider."""
    low, high, _ = mass_range(aircraft)
    tonnes = aircraft.mass / 1e3
    if aircraft.isolated:
        return round(tonnes, 9)  # As its slider is read.
    return min(max(round(tonnes, 2 if tonnes > 1.0 else 3), low), high)


PRESET_TITLES = {"flight": "Best available", "thesis": "Thesis (as stated)"}
INFLOW_MENUS = {
    "inflow": {name: model.title for name, model in INFLOW_MODELS.items()},
    "hover_inflow": {"annulus": "Annulus balance", "closed-form": "Closed form"},
    "low_speed": {"wake": "Forward wake at any speed", "hover": "Passes over to hover"},
    "loss_on": {"lift": "On the lift", "inflow": "On the inflow, eq. (3.3)"},
}
"""Inputs that choose the inflow: name → title of each choice."""

MODEL_INPUTS = (*INFLOW_MENUS, *SWITCHES, "bending", "dynamic_stall")
"""Inputs that are fields of `rotor.design.design.Models`."""


@dataclass(frozen=True)
class Inputs:
    """Everything on the sliders that decides the answer. Rates are degrees per radius."""

    rotor: str = SHIPPED_ROTORS[0]
    """Name of a shipped rotor, or `OWN`."""
    own_rotor: Aircraft | None = None
    """The rotor that the user brought; kept while another one is looked at."""
    preset: str = "flight"
    law: str = "two"
    built_inner: float = 0.0
    """Change of the twist as built, inboard of the division; the two with it [°/R], [°/R], [R]."""
    built_outer: float = 0.0
    built_division: float = 0.5
    linear: float = -12.0
    quadratic_curvature: float = 8.0
    quadratic_difference: float = -14.0
    two_inner: float = -14.0
    two_outer: float = -8.0
    two_division: float = 0.5
    three_inner: float = -16.0
    three_middle: float = -12.0
    three_outer: float = -6.0
    three_first: float = 0.4
    three_second: float = 0.75
    advance_ratio: float = 0.2
    mass_t: float = 8.32
    altitude_m: float = 0.0
    climb_m_s: float = 0.0
    """Negative in descent; without effect where `climbs` says so."""
    rotor_speed_percent: float = 100.0
    stand: StandInputs | None = None
    """The test of the rotor alone, in place of mass, altitude and climb; None in flight."""
    inflow: str = FLIGHT_MODELS.inflow
    hover_inflow: str = FLIGHT_MODELS.hover_inflow
    low_speed: str = FLIGHT_MODELS.low_speed
    loss_on: str = FLIGHT_MODELS.loss_on
    flapping: bool = True
    tip_loss: bool = True
    hub_loss: bool = True
    reverse_flow: bool = True
    compressibility: bool = True
    surface_drag: bool = True
    swept_tip: bool = True
    radial_friction: bool = True
    elastic_twist: bool = True
    swirl: bool = True
    fuselage: bool = True
    download: bool = True
    bending: bool = False
    dynamic_stall: bool = False
    """Whether sections stall with lags and vortices."""
    given: TwistLaw | None = None
    """A twist from a design file that none of the laws holds."""
    optimised: TwistLaw | None = None
    """A twist from the optimiser that none of the laws holds."""
    airfoils: str = ""
    """SPEC of the airfoils that go with `given` or `found`; empty: the preset's."""
    pitch_per_rev: tuple[Harmonic, ...] = ()
    """Root pitch at harmonics of rotor speed."""
    twist_per_rev: tuple[Harmonic, ...] = ()
    """Active twist, that of an actuator apart."""
    active_shape: tuple[tuple[float, ...], tuple[float, ...]] | None = None
    """Its stations and shape where a design file gives them; else it is linear from the root cut-out."""

    @property
    def aircraft(self) -> Aircraft:
        """The aircraft of the menu."""
        return self.own_rotor if self.rotor == OWN and self.own_rotor is not None else shipped_aircraft(self.rotor)

    def twist(self) -> TwistLaw | str:
        """The law on the sliders, or the SPEC of one that the rotor supplies."""
        return LAWS[self.law].make(self)

    def design(self) -> Design:
        """The design these inputs mean; ValueError with one sentence for inputs that mean none."""
        return self._design

    @cached_property
    def _design(self) -> Design:
        models = preset_models(self.preset)
        design = make_design(
            preset=self.preset,
            rotor=self.aircraft,
            twist=self.twist(),
            mu=self.advance_ratio,
            mass_kg=None if self.aircraft.isolated else 1e3 * self.mass_t,
            altitude_m=self.altitude_m,
            climb_m_s=self.climb_m_s if self.climbs else 0.0,
            rotor_speed_percent=self.rotor_speed_percent,
            models=replace(models, **{name: getattr(self, name) for name in MODEL_INPUTS}),
            trim=None if self.stand is None else self.stand.trim,
            stand=None if self.stand is None else self.stand.stand(),
            pitch_per_rev=self.pitch_per_rev,
            twist_per_rev=self.twist_per_rev,
        )
        if self.twist_per_rev and self.active_shape is not None:
            design = replace(design, active_twist=ActiveTwist(self.twist_per_rev, *self.active_shape))
        if self.law in NOT_ALWAYS and self.airfoils:
            design = replace(design, rotor=change_airfoils(design.rotor, self.airfoils))
        return design

    @property
    def climbs(self) -> bool:
        """Whether the rate of climb counts: neither on a test stand nor with the document's equations."""
        return self.stand is None and preset_models(self.preset).disk_axial_flow

    @property
    def idle(self) -> frozenset[str]:
        """Names of inputs on the sliders that change nothing now."""
        unchanged = self.law == "builtin" and self.built_inner == self.built_outer == 0.0
        return frozenset({"built_division"}) if unchanged else frozenset()

    @property
    def speed_kt(self) -> float:
        return self.advance_ratio * self.tip_speed / KNOT

    @property
    def tip_speed(self) -> float:
        """ΩR [m/s]"""
        return self.aircraft.rotor.at_speed(self.rotor_speed_percent).tip_speed


OPENING = Inputs(law="builtin")
"""What the page opens with: the first rotor as built."""


@dataclass(frozen=True)
class Law:
    """A twist law of the menu, and the fields of `Inputs` that belong to it."""

    title: str
    make: Callable[[Inputs], TwistLaw | str]
    angles: tuple[str, ...] = ()
    """Degrees, or degrees per radius; of straight pieces from the root outboard."""
    breaks: tuple[str, ...] = ()
    """r/R where straight pieces meet."""

    @property
    def inputs(self) -> tuple[str, ...]:
        """All of them, in the order of the page."""
        return (*self.angles, *self.breaks)


def _radians(inputs: Inputs) -> list[float]:
    return [math.radians(getattr(inputs, name)) for name in LAWS[inputs.law].angles]


def _segments(inputs: Inputs) -> PiecewiseLinearTwist:
    breaks = tuple(getattr(inputs, name) for name in LAWS[inputs.law].breaks)
    if any(high - low < 0.02 for low, high in pairwise(breaks)):
        raise ValueError(
            f"The break points at {' and '.join(f'{b:g}' for b in breaks)} R are out of order or too close: "
            "keep the second at least 0.02 R outboard of the first."
        )
    return PiecewiseLinearTwist(tuple(_radians(inputs)), breaks)


def _built(inputs: Inputs) -> TwistLaw | str:
    """The blade as built, and on top of it a change in two straight pieces where there is one."""
    if inputs.built_inner == inputs.built_outer == 0.0:
        return "builtin"
    return SumTwist(_builtin_twist(inputs), _segments(inputs))


LAWS: dict[str, Law] = {
    "builtin": Law("As built + two-segment change", _built, ("built_inner", "built_outer"), ("built_division",)),
    "linear": Law("Linear", lambda i: LinearTwist(*_radians(i)), ("linear",)),
    "quadratic": Law(
        "Quadratic", lambda i: QuadraticTwist(*_radians(i)), ("quadratic_curvature", "quadratic_difference")
    ),
    "two": Law("Two segments", _segments, ("two_inner", "two_outer"), ("two_division",)),
    "three": Law(
        "Three segments", _segments, ("three_inner", "three_middle", "three_outer"), ("three_first", "three_second")
    ),
    "ideal": Law("Ideal (θtip/r)", lambda i: "ideal"),
    "given": Law("From the design file", lambda i: i.given or i.aircraft.twist_for(i.preset)),
    "optimised": Law("From the optimiser", lambda i: i.optimised or i.aircraft.twist_for(i.preset)),
}
NOT_ALWAYS = ("given", "optimised")
"""Laws that are in the menu only when the field of `Inputs` of the same name holds what they mean."""


TWIST_SHOWN = 1.0, 6.0
"""Least and most times its twist that a blade is drawn with."""


@dataclass(frozen=True)
class ViewState:
    """What is shown, which no answer depends on."""

    field: str = "Angle of attack"
    azimuth_deg: float = 65.0
    exaggeration: float = 4.0
    difference: bool = False
    """Whether the disk shows B − A while a design is pinned."""
    reverse_flow: bool = True
    stall: bool = True
    drag_divergence: bool = True
    dark: bool = False
    units: str = "SI"
    """A title of `explorer.model.units.UNITS`."""
    wake: bool = True
    arrows: bool = False
    beside: bool = False
    """Whether A stands beside B while a design is pinned."""
    wipe: bool = False
    """Whether A is seen left of a handle, and B right of it, while a design is pinned."""


def inputs_of(design: Design) -> Inputs:
    """The slider positions that mean `design`, as near as the sliders can hold it."""
    active = design.active_twist
    start = Inputs(
        rotor=design.aircraft.key or OWN,
        own_rotor=None if design.aircraft.key else design.aircraft,
        preset=design.preset,
        advance_ratio=design.condition.advance_ratio,
        mass_t=reference_mass_t(design.aircraft) if design.aircraft.isolated else design.condition.mass / 1e3,
        altitude_m=design.condition.altitude,
        climb_m_s=design.condition.climb_speed,
        rotor_speed_percent=design.condition.rotor_speed_percent,
        stand=stand_of(design),
        pitch_per_rev=design.pitch_per_rev,
        twist_per_rev=() if active is None else active.harmonics,
        active_shape=None if active is None or design.linear_active_twist else (active.stations, active.shape),
        **{name: getattr(design.models, name) for name in MODEL_INPUTS},
    )
    twist, airfoils = design.twist, _own_airfoils(design)
    if not airfoils and twist == design.rotor.builtin_twist:
        return replace(start, law="builtin")
    held = None if airfoils else _with_law(start, twist)
    return held or replace(start, law="given", given=twist, airfoils=airfoils)


def with_rotor(inputs: Inputs, name: str, own: Aircraft | None = None) -> Inputs:
    """The same flight with another rotor as it is built, at its own reference mass; `own`: one newly brought.

    A rotor without an airframe begins on the test stand, in a condition in which it was measured if it was.
    """
    changed = replace(inputs, rotor=name, own_rotor=own or inputs.own_rotor)
    mass = reference_mass_t(changed.aircraft)
    plain = {"built_inner": 0.0, "built_outer": 0.0, "built_division": 0.5, "rotor_speed_percent": 100.0}
    mu, stand = inputs.advance_ratio, None
    if changed.aircraft.isolated:
        mu, stand = tested(changed.aircraft)
    elif inputs.stand is not None:
        mu = OPENING.advance_ratio
    changed = replace(changed, advance_ratio=mu, stand=stand)
    waves = {"pitch_per_rev": (), "twist_per_rev": (), "active_shape": None}
    return replace(changed, law="builtin", mass_t=mass, given=None, optimised=None, airfoils="", **plain, **waves)


def with_optimum(inputs: Inputs, design: Design) -> Inputs:
    """The same inputs with the blade of an optimum: on the sliders of a law where one holds it."""
    airfoils = _own_airfoils(design)
    held = None if airfoils else _with_law(inputs, design.twist)
    return held or replace(inputs, law="optimised", optimised=design.twist, airfoils=airfoils)


def _own_airfoils(design: Design) -> str:
    """SPEC of a design's airfoils where they are not its preset's; else empty."""
    same = design.rotor.at_speed(100.0) == design.aircraft.rotor_for(design.preset)
    return "" if same else airfoils_spec(design.rotor) or ""


def _with_law(inputs: Inputs, twist: TwistLaw) -> Inputs | None:
    """The inputs moved to the law that holds `twist`; None where none does."""
    match twist:
        case LinearTwist(rate):
            name, angles, breaks = "linear", (rate,), ()
        case QuadraticTwist(curvature, difference):
            name, angles, breaks = "quadratic", (curvature, difference), ()
        case PiecewiseLinearTwist(angles, breaks) if len(breaks) in (1, 2):
            name = "two" if len(breaks) == 1 else "three"
        case SumTwist(base, PiecewiseLinearTwist(angles, (_,) as breaks)) if base == _builtin_twist(inputs):
            name = "builtin"
        case IdealTwist():
            name, angles, breaks = "ideal", (), ()
        case _:
            return None
    values = dict(zip(LAWS[name].inputs, (*map(_degrees, angles), *breaks), strict=True))
    return replace(inputs, law=name, **values)


def _builtin_twist(inputs: Inputs) -> TwistLaw:
    return inputs.aircraft.rotor_for(inputs.preset).builtin_twist


def preset_inflow(preset: str) -> dict[str, Any]:
    """What a preset brings for each of `INFLOW_MENUS`."""
    models = preset_models(preset)
    return {name: getattr(models, name) for name in INFLOW_MENUS}


def baseline_of(design: Design) -> Design:
    """The same flight and models with the preset's rotor and its baseline twist, at rest."""
    craft, preset = design.aircraft, design.preset
    plain = replace(design, active_twist=None, pitch_per_rev=())
    return replace(plain, twist=craft.twist_for(preset), rotor=craft.rotor_for(preset))


def baseline_title(design: Design) -> str:
    """What the change of power is measured against, in the user's words."""
    return design.aircraft.twist_title(design.preset)


INPUT_NAMES = tuple(field.name for field in fields(Inputs))


def _degrees(angle: float) -> float:
    return round(math.degrees(angle), 4)

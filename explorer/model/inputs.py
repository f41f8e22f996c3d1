"""The rotors of the menu, the sliders and what is shown, as values; degrees, tonnes and knots end here.

One file, for the fields, their rows of the table of quantities and the design that they make change together.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, make_dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from explorer.hosting.messages import NoDesign
from explorer.model.stand import StandInputs, stand_of, tested
from rotor import Aircraft, Design, make_design
from rotor.aero.inflow import INFLOW_MODELS
from rotor.design import ActiveTwist, Harmonic, IdealTwist, SumTwist, TwistLaw
from rotor.design.blade import airfoils_spec
from rotor.design.design import FLIGHT_MODELS, grid_arguments, preset_models, with_grid
from rotor.design.quantities import AIRFRAME, CONDITION, QUANTITIES
from rotor.design.quantity import Quantity, Slider
from rotor.files.make_design import change_airfoils
from rotor.files.rotor_file import shipped_aircraft
from rotor.optimisation.concepts import CONCEPTS, TWO_SEGMENT_FREE, Concept, Parameter
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.support.bytes_cache import bytes_cache

OWN = "own"
"""Name in `Inputs` of the user's own rotor."""
_LIGHTEST, _HEAVIEST = 0.6, 1.32
"""Ends of the weight slider over the rotor's reference mass."""


@bytes_cache
def menu_titles(brought: Aircraft | None) -> dict[str, str]:
    """The menu: name in `Inputs` → title; rotors that were tested on a stand follow, the user's own comes last."""
    titles = {
        name: re.sub(r"-(\d+) deg\b", "−\\1°", shipped_aircraft(name).name)
        for name in (*SHIPPED_ROTORS, *MEASURED_ROTORS)
    }
    return titles if brought is None else {**titles, OWN: f"{brought.name} (own)"}


def mass_range(aircraft: Aircraft) -> tuple[float, float, float]:
    """Lowest, highest and step of the weight slider [t], round numbers about the reference mass."""
    tonnes = aircraft.mass / 1e3
    if aircraft.isolated:
        return 0.0, 2.0 * tonnes, tonnes / 50.0  # A rotor alone carries no weight.
    step = 0.05 if tonnes > 3.0 else 0.01 if tonnes > 1.0 else 0.005
    low, high = (round(share * tonnes / step) for share in (_LIGHTEST, _HEAVIEST))
    return round(max(low * step, 0.1), 4), round(high * step, 4), step


def reference_mass_t(aircraft: Aircraft) -> float:
    """The reference mass [t], not rounded: the page opens with the design of `make_design`."""
    return FLIGHT["mass_t"].as_input(aircraft.mass)


PRESET_TITLES = {"flight": "Best available", "thesis": "Thesis (as stated)"}
INFLOW_MENUS = {
    "inflow": {name: model.title for name, model in INFLOW_MODELS.items()},
    "hover_inflow": {"annulus": "Annulus balance", "closed-form": "Closed form"},
    "low_speed": {"wake": "Forward wake at any speed", "hover": "Blends into hover"},
    "loss_on": {"lift": "Less lift", "inflow": "More inflow, eq. (3.3)"},
}
"""Inputs that choose the inflow: name → title of each choice."""


_CHANGE = (
    "Change of twist rate inboard or outboard of the break point, in degrees per radius; 0 is the blade as built. "
    "| section 4"
)


def _change(one: Parameter) -> Parameter:
    """A parameter of two segments as one of the change on top of the blade as built."""
    name = (one.input or f"two_{one.name}").replace("two_", "built_")
    if not one.angular:
        return replace(one, input=name)
    steepest = math.radians(20.0)
    return replace(
        one,
        low=-steepest,
        high=steepest,
        start=0.0,
        help=_CHANGE,
        short=f"Δ {one.short.lower()}",
        input=name,
    )


def _laws() -> Iterator[Concept]:
    changed = tuple(map(_change, TWO_SEGMENT_FREE.every))
    yield replace(
        TWO_SEGMENT_FREE, page="builtin", title="As built + two-segment change", every=changed
    )
    yield from (
        replace(law, title=law.title.partition(",")[0]) for law in CONCEPTS.values() if law.page
    )
    titles = {
        "ideal": "Ideal (θtip/r)",
        "given": "From the design file",
        "optimised": "From the optimiser",
    }
    yield from (Concept(name, title, "", IdealTwist, (), name) for name, title in titles.items())


LAWS = {law.page: law for law in _laws()}
"""Twist laws of the menu, by `Inputs.law`."""
NOT_ALWAYS = ("given", "optimised")
"""Laws that are in the menu only when the field of `Inputs` of the same name holds what they mean."""


def _row(name: str, one: Parameter) -> Quantity:
    """A parameter of a twist law on its slider: in degrees, or r/R."""
    label, unit = one.short or one.title, one.shown_unit
    if one.angular:
        low, high = (round(one.shown(end), 9) for end in (one.low, one.high))
        form = Slider(
            f"{label} [{unit}]", low, high, 0.5 if unit == "°/R²" else 0.1, per=f" per {unit}"
        )
    else:
        form = Slider(f"{label} [r/R]", one.low, one.high, 0.01, 0.1, "/0.1 R")
    return Quantity(name, "number", default=one.start, input=name, slider=form, hint=one.help)


TWISTS = {
    name: _row(name, one)
    for law in LAWS.values()
    for name, one in zip(law.inputs, law.parameters, strict=True)
}
"""Parameters of the twist laws, by input."""
FLIGHT = {row.input: row for row in CONDITION.values()}
"""Quantities of the flight condition, by input."""
HELD = {row.input: row for row in AIRFRAME.values()}
"""Numbers outside it, by input; None is the rotor's own. Files and links set them, no slider."""
MODELS = {
    row.input: row
    for row in QUANTITIES.values()
    if row.input and row.place == f"models.{row.input}" != "models.trim"
}
"""Quantities that are fields of `rotor.design.design.Models`."""
_PRESET = QUANTITIES["preset"]
ROWS = {row.input: row for row in (_PRESET, *TWISTS.values())} | FLIGHT | MODELS
"""Quantities on the sliders, menus and boxes of Explore, by the field of `Inputs`."""


def _default(row: Quantity) -> Any:
    """Default of the first rotor, where the table leaves it to rotor or preset."""
    if row.place == "condition.mass":
        return reference_mass_t(shipped_aircraft(SHIPPED_ROTORS[0]))
    return (
        getattr(FLIGHT_MODELS, row.field)
        if row.default is None and row.input in MODELS
        else row.default
    )


if TYPE_CHECKING:
    _Quantities = Any  # A type checker cannot read fields that come from a table.
else:
    _Quantities = make_dataclass(
        "_Quantities",
        [(name, Any, _default(row)) for name, row in (ROWS | HELD).items()],
        frozen=True,
    )


@dataclass(frozen=True)
class Inputs(_Quantities):
    """Everything on the sliders that decides the answer: a field for each of `ROWS`, and these."""

    rotor: str = SHIPPED_ROTORS[0]
    """Name of a shipped rotor, or `OWN`."""
    own_rotor: Aircraft | None = None
    """The rotor that the user brought; kept while another one is looked at."""
    law: str = "two"
    stand: StandInputs | None = None
    """The test of the rotor alone, in place of mass, altitude and climb; None in flight."""
    given: TwistLaw | None = None
    """A twist from a design file that none of the laws holds."""
    optimised: TwistLaw | None = None
    """A twist from the optimiser that none of the laws holds."""
    airfoils: str = ""
    """SPEC of the airfoils that go with `given` or `optimised`; empty: the preset's."""
    pitch_per_rev: tuple[Harmonic, ...] = ()
    """Root pitch at harmonics of rotor speed."""
    twist_per_rev: tuple[Harmonic, ...] = ()
    """Active twist, that of an actuator apart."""
    elements: int | None = None
    """Blade elements, where a design asks for a number of its own."""
    azimuths: int | None = None
    """Azimuths, where a design asks for a number of its own."""
    active_shape: tuple[tuple[float, ...], tuple[float, ...]] | None = None
    """Stations and shape of active twist where a design file gives them; else it is linear from the root cut-out."""

    @property
    def aircraft(self) -> Aircraft:
        """The aircraft of the menu."""
        return (
            self.own_rotor
            if self.rotor == OWN and self.own_rotor is not None
            else shipped_aircraft(self.rotor)
        )

    def twist(self) -> TwistLaw | str:
        """The law on the sliders, or the SPEC of one that the rotor supplies."""
        if self.law in NOT_ALWAYS:
            return getattr(self, self.law) or self.aircraft.twist_for(self.preset)
        if self.law == "ideal" or self.idle:
            return self.law
        law, base = LAWS[self.law], _builtin_twist(self) if self.law == "builtin" else None
        breaks = [getattr(self, name) for name in law.breaks]
        if any(high - low < 0.02 for low, high in pairwise(breaks)):
            raise ValueError(
                f"The break points at {' and '.join(f'{b:g}' for b in breaks)} R are out of order or too close: "
                "keep the second at least 0.02 R outboard of the first."
            )
        return replace(law, base=base).twist(self.parameters)

    @property
    def parameters(self) -> list[float]:
        """Parameters of the law on the sliders, in SI units."""
        law = LAWS[self.law]
        return [
            one.from_shown(getattr(self, name))
            for name, one in zip(law.inputs, law.parameters, strict=True)
        ]

    def design(self) -> Design:
        """The design these inputs mean; NoDesign with one sentence for inputs that mean none."""
        try:
            return self._design
        except ValueError as error:
            raise NoDesign(str(error)) from None

    @cached_property
    def _design(self) -> Design:
        models = preset_models(self.preset)
        design = make_design(
            preset=self.preset,
            rotor=self.aircraft,
            twist=self.twist(),
            **self._flight(),
            **{row.name: getattr(self, name) for name, row in HELD.items()},
            models=with_grid(
                replace(models, **{name: getattr(self, name) for name in MODELS}),
                self.elements,
                self.azimuths,
            ),
            trim=None if self.stand is None else self.stand.trim,
            stand=None if self.stand is None else self.stand.stand(),
            pitch_per_rev=self.pitch_per_rev,
            twist_per_rev=self.twist_per_rev,
        )
        if self.twist_per_rev and self.active_shape is not None:
            design = replace(
                design, active_twist=ActiveTwist(self.twist_per_rev, *self.active_shape)
            )
        if self.law in NOT_ALWAYS and self.airfoils:
            design = replace(design, rotor=change_airfoils(design.rotor, self.airfoils))
        return design

    def _flight(self) -> dict[str, Any]:
        """The numbers of the flight condition, in the units of their names."""
        return {
            row.name: row.of_input(getattr(self, name))
            for name, row in FLIGHT.items()
            if not (self.aircraft.isolated and row.in_flight)
            and not (row.axial and not self.counts(row))
        }

    def counts(self, row: Quantity) -> bool:
        """Whether a quantity counts: some do not on a test stand, or with the document's equations."""
        return row.applies(
            tested=self.stand is not None, axial=preset_models(self.preset).disk_axial_flow
        )

    @property
    def idle(self) -> frozenset[str]:
        """Names of inputs on the sliders that change nothing now."""
        unchanged = self.law == "builtin" and self.built_inner == self.built_outer == 0.0
        return frozenset({"built_division"}) if unchanged else frozenset()

    @property
    def tip_speed(self) -> float:
        """ΩR [m/s]"""
        return self.aircraft.rotor.at_speed(self.rotor_speed_percent).tip_speed


OPENING = Inputs(law="builtin")
"""What the page opens with: the first rotor as built."""


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
    """Whether separated flow is marked on the disk."""
    past_static: bool = True
    """Whether what is past the static stall angle with the flow attached is."""
    drag_divergence: bool = True
    dark: bool = False
    units: str = "SI"
    """A title of `explorer.model.units.UNITS`."""
    wake: bool = True
    wipe: bool = False
    """Whether A is seen left of a handle, and B right of it, while a design is pinned."""


def inputs_of(design: Design) -> Inputs:
    """The slider positions that mean `design`, as near as the sliders can hold it, without an actuator on board."""
    design, active = design.bare, design.active_twist
    start = Inputs(
        rotor=design.aircraft.key or OWN,
        own_rotor=None if design.aircraft.key else design.aircraft,
        preset=design.preset,
        stand=stand_of(design),
        pitch_per_rev=design.pitch_per_rev,
        twist_per_rev=() if active is None else active.harmonics,
        active_shape=None
        if active is None or design.linear_active_twist
        else (active.stations, active.shape),
        **{name: row.as_input(row.of(design)) for name, row in FLIGHT.items()},
        **{name: design.unusual.get(row.name) for name, row in HELD.items()},
        **{name: row.of(design) for name, row in MODELS.items()},
        **grid_arguments(design.models, preset_models(design.preset)),
    )
    if design.aircraft.isolated:
        start = replace(start, mass_t=reference_mass_t(design.aircraft))
    twist, airfoils = design.twist, _own_airfoils(design)
    if not airfoils and twist == design.rotor.builtin_twist:
        return replace(start, law="builtin")
    held = None if airfoils else _with_law(start, twist)
    return held or replace(start, law="given", given=twist, airfoils=airfoils)


def law_titles(inputs: Inputs) -> dict[str, str]:
    """The menu of twist laws: name in `Inputs` → title; those that are not always there only where inputs hold them."""
    return {
        key: law.title
        for key, law in LAWS.items()
        if key not in NOT_ALWAYS or getattr(inputs, key) is not None
    }


def with_rotor(inputs: Inputs, name: str, brought: Aircraft | None = None) -> Inputs:
    """A flight with another rotor as it is built, at its own reference mass; `own`: one newly brought.

    A rotor without an airframe begins on the test stand, in a condition in which it was measured if it was.
    """
    changed = replace(inputs, rotor=name, own_rotor=brought or inputs.own_rotor)
    mass = reference_mass_t(changed.aircraft)
    plain = {name: ROWS[name].default for name in (*LAWS["builtin"].inputs, "rotor_speed_percent")}
    mu, stand = inputs.advance_ratio, None
    if changed.aircraft.isolated:
        mu, stand = tested(changed.aircraft)
    elif inputs.stand is not None:
        mu = OPENING.advance_ratio
    changed = replace(changed, advance_ratio=mu, stand=stand)
    waves = {"pitch_per_rev": (), "twist_per_rev": (), "active_shape": None, **dict.fromkeys(HELD)}
    return replace(
        changed,
        law="builtin",
        mass_t=mass,
        given=None,
        optimised=None,
        airfoils="",
        **plain,
        **waves,
    )


def with_optimum(inputs: Inputs, design: Design) -> Inputs:
    """Inputs with the blade of an optimum: on the sliders of a law where one holds it."""
    airfoils = _own_airfoils(design)
    held = None if airfoils else _with_law(inputs, design.twist)
    return held or replace(inputs, law="optimised", optimised=design.twist, airfoils=airfoils)


def _own_airfoils(design: Design) -> str:
    """SPEC of a design's airfoils where they are not its preset's; else empty."""
    same = design.rotor.at_speed(100.0) == design.aircraft.rotor_for(design.preset)
    return "" if same else airfoils_spec(design.rotor) or ""


def _with_law(inputs: Inputs, twist: TwistLaw) -> Inputs | None:
    """The inputs moved to the law that holds `twist`; None where none does."""
    if isinstance(twist, IdealTwist):
        return replace(inputs, law="ideal")
    if twist == _builtin_twist(inputs):
        law = LAWS["builtin"]
        turns = [name for name, one in zip(law.inputs, law.parameters, strict=True) if one.angular]
        return replace(inputs, law="builtin", **dict.fromkeys(turns, 0.0))
    change, laws = twist, [law for law in LAWS.values() if law.page != "builtin"]
    if isinstance(twist, SumTwist) and twist.base == _builtin_twist(inputs):
        change, laws = twist.change, [LAWS["builtin"]]
    for law in laws:
        if values := law.values_of(change):
            pairs = zip(law.parameters, values, strict=True)
            shown = (round(one.shown(value), 4) if one.angular else value for one, value in pairs)
            return replace(inputs, law=law.page, **dict(zip(law.inputs, shown, strict=True)))
    return None


def _builtin_twist(inputs: Inputs) -> TwistLaw:
    return inputs.aircraft.rotor_for(inputs.preset).builtin_twist


def preset_inflow(preset: str) -> dict[str, Any]:
    """What a preset brings for each of `INFLOW_MENUS`."""
    models = preset_models(preset)
    return {name: getattr(models, name) for name in INFLOW_MENUS}


def baseline_of(design: Design) -> Design:
    """A flight and models with the preset's rotor and its baseline twist, without n/rev; of a design with an actuator
    on board, the same without it."""
    craft, preset = design.aircraft, design.preset
    if design.rotor.blade.carried is not None:
        return replace(design.bare, active_twist=None, pitch_per_rev=())
    still = replace(design, active_twist=None, pitch_per_rev=())
    return replace(still, twist=craft.twist_for(preset), rotor=craft.rotor_for(preset))


def baseline_title(design: Design, reference: Design | None = None) -> str:
    """What the change of power is measured against, in the user's words."""
    if design.rotor.blade.carried is not None:
        return (
            "same blade without it"
            if reference is None or reference.twist == design.jig
            else "best fixed blade"
        )
    return design.aircraft.twist_title(design.preset)

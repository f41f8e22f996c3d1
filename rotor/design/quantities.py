"""The quantities of a design: one row each, read by everything that names them.

From a row come the argument of `make_design` and its words, the flag, the key of design files, the word of links, the
quantity of studies and sweeps, columns of tables, keys of JSON, and on the page slider, tooltip, units and sentence.

`QUANTITIES[name]` is a row by the name that commands and studies use; `BY_KEY` by the key of design files, `BY_INPUT`
by the name of the page's input. `ARGUMENTS`, `NUMBERS`, `SWITCHES` and `STAND` are the rows of a kind, in order.
`row.of(design)` is the value that a design has, in the unit of its row, `row.put(design, value)` the
design with another, `row.check(value)` refuses what lies outside its bounds, `row.in_words(value)` is it in words, and
`row.slider` what the page shows. How to add one: CONTRIBUTING.md. One file, because it is one table.
"""

from typing import Generic, Literal, TypedDict, TypeVar, get_args

from rotor.airfoil.sections import TABLE_NAMES
from rotor.design.quantity import Quantity, Slider
from rotor.design.twist import SPEC_FORMS
from rotor.support.assets import MEASURED_ROTORS, SHIPPED_ROTORS
from rotor.support.units import FOOT, POUND

HoverInflow = Literal["annulus", "closed-form"]
LowSpeed = Literal["wake", "hover"]
LossOn = Literal["lift", "inflow"]
FlightTrim = Literal["propulsive", "thrust"]
StandTrim = Literal["wind-tunnel", "free-rotor", "controls"]
"""`wind-tunnel`: shaft tilt and thrust or collective given; `free-rotor`: no torque, collective or thrust given;
`controls`: collective, cyclic and shaft tilt given."""
Flapping = Literal["trimmed", "free", "hub-moments"]
Value = TypeVar("Value")


class Flight(TypedDict, Generic[Value], total=False):
    """Arguments of `make_design`, `Design.at` and `rotor.sweep` beside `mu`: a test compares them with the rows."""

    speed_kt: Value
    mass_kg: Value
    altitude_m: Value
    isa_offset_c: Value
    climb_m_s: Value
    rotor_speed_percent: Value
    load_factor: Value
    drag_area_m2: Value


HOVER_INFLOWS: tuple[HoverInflow, ...] = get_args(HoverInflow)
LOW_SPEEDS: tuple[LowSpeed, ...] = get_args(LowSpeed)
LOSS_ON: tuple[LossOn, ...] = get_args(LossOn)
STAND_TRIMS: tuple[StandTrim, ...] = get_args(StandTrim)
TRIMS: tuple[FlightTrim | StandTrim, ...] = (*get_args(FlightTrim), *STAND_TRIMS)
PRESETS = ("flight", "thesis")


def _switch(
    name: str, on: str, off: str, *, source: str = "section 5", title: str = ""
) -> Quantity:
    """An effect that every design has unless it is switched off."""
    return Quantity(
        name, "switch", place=f"models.{name}", default=True, key=name, section="models",
        title=title or name.replace("_", " ").capitalize(), on=on, off=off,
        hint=f"{on} Off: {off} | {source}", input=name, written=True,
    )  # fmt: skip


_SWITCHES = (
    _switch("flapping",
        "The blades flap about their hinges, and cyclic removes the remaining first-harmonic flapping.",
        "Rigid blades, β = 0, and no cyclic: the hub carries the moment of the unequal lift.", source="2.39, 3.20",
    ),
    _switch("tip_loss",
        "Lift falls off at the tips of a finite number of blades: Prandtl's factor, or the wake of each blade.",
        "F_tip = 1. A lifting line still has its blade tips.", source="3.16",
    ),
    _switch("hub_loss",
        "Lift falls off at the root: Prandtl's factor, in hover and with inflow that does not depend on the load.",
        "F_hub = 1.", source="3.17", title="Root loss",
    ),
    _switch("reverse_flow",
        "On the retreating side, inside r < −µ sin ψ, air meets the blade from behind and adds drag.",
        "No load inside the circle r < −µ sin ψ.", source="3.5, 3.15",
    ),
    _switch("compressibility",
        "Section data depend on the Mach number: steeper lift, earlier stall, wave drag on the advancing tip.",
        "Section data at Mach 0.3 everywhere.",
    ),
    _switch("surface_drag",
        "The rotor file gives a factor for the surface of the blades; drag is multiplied by it.",
        "Drag is that of the section data.",
    ),
    _switch("swept_tip",
        "A swept tip sees the Mach number of the flow normal to its quarter chord.",
        "The tip sees the Mach numbers of a straight tip.",
    ),
    _switch("radial_friction",
        "Section drag is along the whole velocity: over nose and tail the blade is yawed to the air.",
        "Drag is that of the flow across the blade.", title="Yawed drag",
    ),
    _switch("elastic_twist",
        "The blade twists under its loads, so its twist in flight differs from its built-in twist.",
        "The blade is rigid in torsion: its twist in flight is its built-in twist.",
    ),
    _switch("unsteady",
        "Attached flow is unsteady: the flow at three-quarter chord sets the lift, and apparent mass adds to it.",
        "Attached flow is steady.", title="Unsteady flow",
    ),
    _switch("dynamic_stall",
        "Separation lags the angle of attack, and stall sheds a vortex (Leishman and Beddoes).",
        "Sections stall as in the steady data.",
    ),
    _switch("stall_delay",
        "Rotation keeps the flow on the blade near the hub, where the chord is a large part of the radius: lift goes "
        "towards that of attached flow (Snel, Houwink and Bosschers).",
        "A blade element stalls as its section does in two dimensions.",
    ),
    _switch("swirl",
        "The rotor swirls the air; this takes power and lowers the speed at the blade.",
        "The air in the disk moves along the shaft only.",
    ),
    _switch("fuselage",
        "The rotor overcomes the drag of the aircraft: parasite power, and a disk tilted forward.",
        "Drag area 0: no parasite power.", source="3.19", title="Fuselage drag",
    ),
    _switch("download",
        "The wake presses on the airframe: in hover, thrust exceeds weight by the download in the rotor file.",
        "Thrust equals weight.",
    ),
    _switch("stall",
        "Beyond its stall angle a section loses lift and gains drag.",
        "The flow separates no further than where stall begins, and no vortex leaves.",
    ),
)  # fmt: skip

_CONDITION = (
    Quantity(
        "mu", "number", "advance ratio V/(ΩR) from the horizontal speed (default 0.2)",
        place="condition.advance_ratio", what="advance ratio", low=0.0, high=0.6, high_on_stand=0.75, default=0.2,
        examples=(0.1, 0.2, 0.3), key="advance_ratio", word="mu", section="fixed", written=True, reported=True,
        input="advance_ratio", slider=Slider("Adv. ratio µ", 0.0, 0.45, 0.005, 0.01, "/0.01"),
        hint="Airspeed over tip speed, µ = V/ΩR; 0 is hover. | section 1",
    ),
    Quantity(
        "speed_kt", "number", "horizontal airspeed, instead of the advance ratio", unit="kt", what="airspeed",
        examples=(60, 90, 120), section="fixed",
    ),
    Quantity("hover", "switch", "hover, instead of a speed", default=False),
    Quantity(
        "mass_kg", "number", "gross mass (default: the rotor's reference mass)", unit="kg",
        place="condition.mass", what="mass", low=100.0, high=50_000.0, in_flight=True,
        examples=(6000, 7000, 8000), key="mass_kg", word="mass", section="fixed", written=True, reported=True,
        input="mass_t", input_size=1e3, slider=Slider("Mass [t]", 5.0, 11.0, 0.05, 0.1, "/100 kg", "t", 1e3),
        aviation=Slider("Mass [lb]", 11_000.0, 24_300.0, 100.0, 0.2 * POUND, "/200 lb", "lb", POUND),
        hint="Gross mass; the rotor carries its weight W = mg. | section 2",
    ),
    Quantity(
        "altitude_m", "number", "pressure altitude (default 0)", unit="m",
        place="condition.altitude", what="altitude", low=-500.0, high=8_000.0, default=0.0,
        examples=(0, 1000, 1500), key="altitude_m", word="alt", section="fixed", written=True, reported=True,
        input="altitude_m", slider=Slider("Altitude [m]", 0.0, 4000.0, 50.0, 100.0, "/100 m"),
        aviation=Slider("Altitude [ft]", 0.0, 13_200.0, 100.0, 500.0 * FOOT, "/500 ft", "ft", FOOT),
        in_place="density_kg_m3",
        hint="Pressure altitude in the standard atmosphere: with the ISA offset it sets air density and speed of "
        "sound. | section 2",
    ),
    Quantity(
        "isa_offset_c", "number", "air temperature above the standard atmosphere at this altitude (default 0)",
        unit="°C", place="condition.isa_offset", what="ISA offset", short="ISA +", below="ISA −",
        plain="a standard day", low=-60.0, high=60.0, default=0.0, examples=(10, 0, 20), key="isa_offset_c",
        word="isa", section="fixed", input="isa_offset_c", in_place="density_kg_m3",
        slider=Slider("ISA offset [°C]", -40.0, 40.0, 1.0, 10.0, "/10 °C"),
        hint="Temperature above the standard atmosphere at this pressure altitude. It changes density, speed of sound "
        "and viscosity, but not engine power. | section 2",
    ),
    Quantity(
        "climb_m_s", "number",
        "rate of climb, negative in descent; on a test stand, wind from above; with preset flight only",
        unit="m/s",
        place="condition.climb_speed", what="rate of climb", short="climb", below="descent",
        plain="level flight", low=-100.0, high=100.0, default=0.0, axial=True, examples=(-5, 0, 5),
        key="climb_m_s", word="climb", section="fixed", reported=True, input="climb_m_s",
        slider=Slider("Climb [m/s]", -20.0, 20.0, 0.1, 1.0, "/(m/s)"),
        aviation=Slider(
            "Climb [ft/min]", -3900.0, 3900.0, 50.0, 100.0 * FOOT / 60.0, "/(100 ft/min)", "ft/min", FOOT / 60.0
        ),
        hint="Rate of climb, negative in descent; µ uses the horizontal speed. On a test stand: wind from above. "
        "| section 2",
    ),
    Quantity(
        "rotor_speed_percent", "number",
        "rotor speed as a percentage of the rotor's own (default 100); the advance ratio stays the same",
        unit="%",
        place="condition.rotor_speed_percent", what="rotor speed", short="rotor speed", plain="its own rotor speed",
        low=70.0, high=110.0, default=100.0, examples=(90, 100, 95), key="rotor_speed_percent", word="rpm",
        section="fixed", input="rotor_speed_percent", slider=Slider("Rotor speed [%]", 70.0, 110.0, 0.5, 1.0, "/%"),
        hint="Rotor speed in per cent of that in the rotor file. µ stays, and the tail rotor follows. | section 2",
    ),
    Quantity(
        "load_factor", "number",
        "lift over weight in a steady turn, with the airframe drag of straight flight (default 1)",
        place="condition.load_factor", what="load factor", short="load factor", plain="straight flight", low=0.1,
        high=5.0, default=1.0, in_flight=True, examples=(1.2, 1.0, 1.5), key="load_factor", word="n", section="fixed",
        input="load_factor", slider=Slider("Load factor n", 0.5, 3.0, 0.01, 0.1, "/0.1"),
        hint="Lift over weight in a steady turn, n = 1/cos of the bank angle; propulsive force as in straight flight. "
        "The turn rate of the body and heavier blades are ignored. | section 2",
    ),
)  # fmt: skip

_AIRFRAME = (
    Quantity(
        "drag_area_m2", "number", "equivalent flat-plate area of the airframe's drag (default: the rotor file's)",
        unit="m²", place="fuselage.drag_area", what="drag area", short="drag area", plain="its own drag area", low=0.0,
        high=50.0, in_flight=True, examples=(2.5, 3.0, 3.5), key="drag_area_m2", word="area", section="fixed",
        input="drag_area_m2",
    ),
)  # fmt: skip

_BLADE = (
    Quantity("case", "object", "design file to start from, or what `load_design` read; the other arguments change it"),
    Quantity(
        "rotor", "text", "a rotor file (docs/rotor_file.md) or the name of a rotor",
        choices=(*SHIPPED_ROTORS, *MEASURED_ROTORS), key="rotor", section="fixed", written=True, input="rotor",
        hint="The helicopter: its blades, sections, rotor speed and mass, as built. | section 4",
    ),
    Quantity(
        "twist", "text",
        f"twist law in degrees and r/R, such as linear:-8 or segments:-12,-4@0.5: {' | '.join(SPEC_FORMS)}",
        key="twist", section="fixed", written=True,
    ),
    Quantity(
        "twist_per_rev", "text",
        "active twist N:DEG:PHASE,…, e.g. 3:1:180: it turns the tip by DEG cos(N ψ − PHASE) degrees relative to the "
        "root of a blade at rest, linearly from the root cut-out; 2:0:0 removes the active twist of a design file",
        key="twist_per_rev", section="fixed",
    ),
    Quantity(
        "pitch_per_rev", "text",
        "harmonic root pitch in the same form, 2 to 8/rev; hover has neither this nor active twist",
        key="pitch_per_rev", section="fixed",
    ),
)  # fmt: skip

_MODELS = (
    Quantity(
        "preset", "text",
        "flight (default): the best models available; thesis: the models of the source document; rotors other than the "
        "UH-60A keep their own sections, planform, hinge and twist",
        place="preset", default=PRESETS[0], key="preset", section="models", written=True, input="preset",
        title="Preset",
        hint="Model choices of the source document, or the best available; each can be changed. | section 15",
    ),
    Quantity(
        "inflow", "text", "inflow model for forward flight or for hover",
        place="models.inflow", key="inflow", section="models", written=True, input="inflow", title="Inflow",
        hint="How the inflow through the disk depends on speed and load distribution. | 3.4",
    ),
    Quantity(
        "low_speed", "choice",
        "hover (preset flight): near µ = 0 the inflow becomes that of the hover model; wake (thesis): it does not",
        place="models.low_speed", choices=LOW_SPEEDS, key="low_speed", input="low_speed", title="At low speed",
        hint="Blends the forward wake into the hover model as speed falls to zero, or keeps it at any speed. "
        "| section 9",
    ),
    Quantity(
        "loss_on", "choice",
        "what Prandtl's factors act on with linear inflow in forward flight: lift (preset flight) or inflow (thesis)",
        place="models.loss_on", choices=LOSS_ON, key="loss_on", input="loss_on", title="Tip and root loss",
        hint="Prandtl's factors with linear inflow in forward flight: less lift at the ends of the blade, or more "
        "inflow. | 3.3",
    ),
    Quantity(
        "airfoils", "text", "sections from root to tip with breaks in r/R, e.g. sc1094r8,sc1095@0.5; their names",
        choices=TABLE_NAMES, key="airfoils", section="fixed",
    ),
    Quantity(
        "off", "text", "physical effects to switch off, separated by commas",
        choices=tuple(switch.flag for switch in _SWITCHES),
    ),
    Quantity(
        "bending", "switch",
        "let the blades bend in flap and lag, if the rotor file gives their stiffness; the report then has hub loads",
        place="models.bending", default=False, key="bending", section="models", input="bending",
        title="Blade bending", short="blades bend",
        hint="On: blades whose stiffness is known bend in flap and lag, drawn ten times as large; the hub then has "
        "vibratory loads. Off: they flap as rigid blades. | section 10",
    ),
    Quantity(
        "elements", "whole", "blade elements (default 40; the lifting line has 24 panels)",
        key="elements", section="models",
    ),
    Quantity(
        "azimuths", "whole", "azimuth stations (default 48, of the preset thesis 120; the lifting line has 24)",
        key="azimuths", section="models",
    ),
    Quantity("models", "object", "all model choices at once"),
    Quantity(
        "trim", "text", "trim in flight (the first two) or on a test stand",
        place="models.trim", choices=TRIMS, key="trim", section="models", input="trim", title="Flight or test",
        hint="Flight: the rotor carries weight and drag. Test stand: wind tunnel, rotor without torque, or given "
        "controls. Measured rotors also offer the conditions of their tests.",
    ),
    Quantity(
        "stand", "object",
        'inputs of the test, a `Stand` or a mapping such as {"shaft_tilt_deg": 5, "ct_over_sigma": 0.08}, its keys '
        "in `rotor.design.quantities.STAND`; a rotor without an airframe is in a wind tunnel at C_T/σ 0.07 by default",
        key="stand",
    ),
)  # fmt: skip

_HOVER_INFLOW = Quantity(
    "hover_inflow", "choice", place="models.hover_inflow", choices=HOVER_INFLOWS, key="hover_inflow",
    input="hover_inflow", title="Inflow in hover",
    hint="Inflow in hover: a momentum balance for each annulus, or one closed equation. | 3.3",
)  # fmt: skip
_ACTIVE_TWIST = Quantity("active_twist", "object", key="active_twist")

_STAND = (
    Quantity(
        "shaft_tilt_deg", "number", "shaft tilt, positive forward (default 0; a free rotor finds its own)",
        unit="°", place="condition.stand.shaft_tilt", low=-40.0, high=40.0, input="shaft_tilt_deg",
        slider=Slider("Shaft tilt [°]", -25.0, 25.0, 0.1), hint="Tilt of the shaft, positive forward.",
    ),
    Quantity(
        "ct_over_sigma", "number", "blade loading C_T/σ",
        place="condition.stand.ct_over_sigma", low=0.0, high=0.25, input="ct_over_sigma", title="Loading CT/σ",
        slider=Slider("CT/σ", 0.0, 0.2, 0.001), hint="Blade loading CT/σ: thrust over ρA(ΩR)²σ.",
    ),
    Quantity(
        "thrust_n", "number", "thrust along the shaft", unit="N",
        place="condition.stand.thrust", low=0.0, high=2e6, input="thrust_n", title="Thrust",
        slider=Slider("Thrust [N]", 0.0, 1e5, 100.0),
    ),
    Quantity(
        "collective_deg", "number", "pitch at 0.75 R", unit="°",
        place="condition.stand.collective", low=-30.0, high=35.0, input="collective_deg", title="Collective",
        slider=Slider("Collective [°]", -10.0, 30.0, 0.1),
    ),
    Quantity(
        "cyclic_1c_deg", "number", "given cyclic pitch, cosine part, with free flapping", unit="°",
        place="condition.stand.cyclic_1c", low=-30.0, high=30.0, default=0.0, input="cyclic_1c_deg",
        slider=Slider("Cyclic θ1c [°]", -15.0, 15.0, 0.1),
        hint="Given cyclic θ1c, cosine part; the blades flap freely.",
    ),
    Quantity(
        "cyclic_1s_deg", "number", "given cyclic pitch, sine part, with free flapping", unit="°",
        place="condition.stand.cyclic_1s", low=-30.0, high=30.0, default=0.0, input="cyclic_1s_deg",
        slider=Slider("Cyclic θ1s [°]", -15.0, 15.0, 0.1),
        hint="Given cyclic θ1s, sine part; the blades flap freely.",
    ),
    Quantity(
        "hub_roll_nm", "number",
        "prescribed rolling moment at the hub, towards the retreating side; needs --flapping hub-moments", unit="N m",
        place="condition.stand.hub_roll", low=-1e6, high=1e6, default=0.0,
    ),
    Quantity(
        "hub_pitch_nm", "number",
        "prescribed nose-up pitching moment at the hub; needs --flapping hub-moments", unit="N m",
        place="condition.stand.hub_pitch", low=-1e6, high=1e6, default=0.0,
    ),
    Quantity(
        "tip_mach", "number", "tip speed over the speed of sound",
        place="condition.stand.tip_mach", low=0.02, high=0.95, input="tip_mach",
        slider=Slider("Tip Mach", 0.05, 0.9, 0.005), hint="Tip speed over the speed of sound of the test.",
    ),
    Quantity(
        "density_kg_m3", "number", "air density", unit="kg/m³",
        place="condition.stand.density", low=0.05, high=3.0, input="density",
        slider=Slider("Density [kg/m³]", 0.3, 1.6, 0.005), hint="Air density of the test.",
    ),
    Quantity(
        "flapping", "choice",
        "first-harmonic flapping: trimmed to zero by cyclic (default in a wind tunnel), free, or for given hub moments",
        place="condition.stand.flapping", choices=get_args(Flapping), input="stand_flapping", title="Flapping",
        hint="First-harmonic flapping: zero by cyclic, free at given cyclic, or free with cyclic that gives the hub "
        "moments.",
    ),
)  # fmt: skip

_STUDIES = (
    Quantity("concept", "text", "twist concept of the blade", section="fixed"),
    Quantity("hover_share", "number", "share of the time in hover, of a search", section="fixed"),
)

ARGUMENTS = {row.name: row for row in (*_BLADE, *_CONDITION, *_AIRFRAME, *_MODELS)}
"""Arguments of `make_design`, in its order."""
NUMBERS = {row.name: row for row in (*_CONDITION, *_AIRFRAME) if row.place}
"""Numbers of a design, wherever their place is."""
CONDITION = {name: row for name, row in NUMBERS.items() if row.place.startswith("condition.")}
"""Those of its flight condition, which a mission sets for each leg."""
AIRFRAME = {name: row for name, row in NUMBERS.items() if name not in CONDITION}
"""Those outside it, which all legs of a mission share."""
SWEPT = {name: row for name, row in ARGUMENTS.items() if name in ("speed_kt", *NUMBERS)}
"""What a sweep may go over, and what `Design.at` takes beside `hover`."""
UNUSUAL = {name: row for name, row in NUMBERS.items() if row.short}
"""Numbers that reports have only where they are not the default."""
SPEED = ("mu", "speed_kt", "hover")
"""Ways to give the speed, of which one is used."""
SWITCHES = {row.name: row for row in _SWITCHES}
"""Effects that can be switched off, in the order in which a waterfall adds them."""
OPTIONS = ("bending",)
"""Effects that are off unless they are asked for."""
STAND = {row.name: row for row in _STAND}
"""Keys of a test stand. In a study `stand_` stands before the name."""
LOAD_KEYS = ("thrust_n", "ct_over_sigma", "collective_deg")
"""Ways to give the load on a stand, of which one is used."""
QUANTITIES = {**ARGUMENTS, **SWITCHES, **{row.name: row for row in (_HOVER_INFLOW, *_STUDIES)}}
"""All by name, but for the test stand's."""
BY_KEY = {row.key: row for row in (*QUANTITIES.values(), _ACTIVE_TWIST) if row.key}
"""By the key of design files."""
BY_INPUT = {row.input: row for row in (*QUANTITIES.values(), *_STAND) if row.input}
"""By the name of the page's input."""

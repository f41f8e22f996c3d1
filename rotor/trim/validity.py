"""The limits of validity of a solution, and why a design did not trim or a trim is refused, in sentences for the user.

Caveats are listed in the order of their conditions here.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rotor.aero.elements import BladeElements, DiskSums
from rotor.aero.momentum import VORTEX_RING_ONSET, vortex_ring_edge
from rotor.aero.problem import Problem
from rotor.aero.switches import switched_off
from rotor.airfoil.polynomial import THESIS_NAME
from rotor.design.aircraft import FIXED_SHARE, Stand, in_words
from rotor.design.design import Design
from rotor.support.arrays import Array
from rotor.support.units import power_text
from rotor.trim.control_stops import rigged_collective
from rotor.trim.low_speed import hover_share
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.power import HubMoment
from rotor.trim.solution import Caveat, Shown, Solution

LOW_SPEED = 0.075
"""Below this advance ratio linear inflow is not trusted (thesis p. 26)."""
LOWEST_SPEED = 0.05
"""Below it a wake rolls up at once, and no model that leaves this out has been compared with measurement."""
HIGH_SPEED = 0.40
"""Above it reverse flow and stall decide: the lift over drag of the PCA-2 is missed by more than 10 %."""
HOVER_CAUTION = 0.12
"""C_T/σ in hover from which maximum lift decides, the least certain part of the section data. Our choice."""
LARGEST_BUILT_TWIST = math.radians(25.0)
"""Root to tip, with a margin: the UH-60A has 18° nominal. Only tiltrotor blades, propellers in cruise, have more."""
NOSE_UP_TWIST = math.radians(1.0)
"""Root to tip, above which the sign is questioned. Our choice: no rotor here is built with any."""
STALL_SHARE = 0.02
"""Stalled part of the disk above which dynamic stall would change the results."""
MOST_STALLED = 0.25
"""Part of the lift's moment about the hub, Σ r dT, that stalled sections carry beyond which there is no power. Rotors
compared with measurement have up to 18 % (an XV-15 tilted aft). Beyond the largest lift a rotor balances the same
weight once more, at a multiple of the power, with 40 % and more: shares of thrust or disk do not tell them apart."""
LEAST_ASPECT_RATIO = 10.0
"""R/c below which thrust at a given collective is not trusted. Our choice: that of Caradonna and Tung's rotor (NASA
TM-81232) is 6, those of the other rotors compared here 10.7 and more."""
CONTROL_SHARE = 0.005
"""Power of pitch links and actuators over that of the main rotor from which it is named. Our choice."""
FAST_PITCH = 0.2
"""Reduced frequency ωc/2V at 0.75 R from which it is named. Our choice: Theodorsen's |C(k)| has fallen to 0.75."""


@dataclass(frozen=True)
class CaveatInputs:
    """A converged trim, and what caveats read of it."""

    problem: Problem
    solution: Solution
    shown: Shown
    """Without the caveats."""

    @property
    def design(self) -> Design:
        return self.problem.design

    @property
    def mu(self) -> float:
        """Advance ratio."""
        return self.design.condition.advance_ratio

    @property
    def on_stand(self) -> bool:
        return self.design.condition.stand is not None

    @property
    def fixed_inflow(self) -> bool:
        """Whether the inflow does not respond to where the lift is."""
        return not self.problem.inflow.load_dependent


def caveats(trim: CaveatInputs) -> Iterator[Caveat]:
    """The limits of validity that a converged solution exceeds, in the order in which they are listed."""
    for remark in trim.design.aircraft.remarks:
        yield Caveat("rotor-file", remark)
    found = (
        _of_the_rotor(trim) | _of_the_models(trim) | _of_the_flight(trim) | _of_the_sections(trim)
    )
    yield from (Caveat(name, sentence) for name, sentence in found.items())


def _of_the_rotor(trim: CaveatInputs) -> dict[str, str]:
    design, models = trim.design, trim.design.models
    found = dict[str, str]()
    if design.aircraft.hub == "teetering" and design.rotor.precone is None:
        found["teetering"] = (
            "A teetering hub has built-in coning; here the blades cone as if hinged at the shaft."
        )
    if design.twist != design.rotor.builtin_twist:
        root, tip = design.twist(np.array([design.rotor.blade.root_cutout, 1.0])).tolist()
        if abs(tip - root) > LARGEST_BUILT_TWIST:
            found["twist-beyond-built"] = (
                f"The blade twists by {math.degrees(tip - root):.0f}° from root to tip; helicopter blades are built "
                "with about 20° or less. Read the result as an extrapolation."
            )
        elif tip - root > NOSE_UP_TWIST:
            found["nose-up-twist"] = (
                f"The twist raises the pitch of the tip {math.degrees(tip - root):.1f}° above that of the root; built "
                "blades lower it. For such a blade give the opposite sign, as in linear:-8."
            )
    if design.tail_rotor is None and models.tail_rotor_solved and not trim.on_stand:
        found["no-tail-rotor"] = (
            f"The rotor file has no tail rotor: {100.0 * FIXED_SHARE:.0f} % of main-rotor power stands in for it."
        )
    if design.preset == "thesis" and design.aircraft.stated is None:
        found["thesis-models"] = (
            f"The source document does not cover the {design.aircraft.name}; its models are used with this blade."
        )
    stand, ratio = design.condition.stand, design.rotor.radius / design.rotor.reference_chord
    if stand is not None and stand.collective is not None and ratio < LEAST_ASPECT_RATIO:
        found["small-aspect-ratio"] = (
            f"At a given collective, blades of aspect ratio {ratio:.1f} get too much thrust here: that of the "
            "Caradonna and Tung blades (6) is a quarter to two thirds above the one measured in hover. Give the thrust "
            "instead."
        )
    if models.has("elastic_twist") and design.rotor.blade.structure is None:
        found["no-blade-structure"] = (
            "The rotor file has no blade structure, so the blade is rigid in torsion; real blades twist by degrees."
        )
    return found


def _of_the_models(trim: CaveatInputs) -> dict[str, str]:
    design, models, power = trim.design, trim.design.models, trim.solution.last_power
    found = dict[str, str]()
    if off := switched_off(models):
        names = ", ".join(switch.title.lower() for switch in off)
        found["switched-off"] = (
            f"Switched off: {names}. The result is for teaching, not for the aircraft."
        )
    if not design.flaps and trim.mu > 0.0:
        found["rigid-blades"] = _rigid(trim.solution.hub_moment)
        if trim.fixed_inflow:
            found["rigid-blades-linear-inflow"] = (
                "Linear inflow does not respond to unequal lift, so the induced power of rigid blades is too low."
            )
    if models.bending and (reason := why_no_hub_loads(design)) is not None:
        found[reason.name] = reason.sentence
    if design.active_twist and design.hovering:
        found["active-twist-rests"] = "Active twist is off in hover, where only the twist law acts."
    if design.pitch_per_rev and design.hovering:
        found["root-pitch-rests"] = (
            "Root pitch at harmonics of rotor speed is off in hover, where nothing depends on azimuth."
        )
    highest = max(
        (harmonic.per_rev for wave in design.pitch_waves for harmonic in wave.harmonics), default=0
    )
    # ωc/2V at 0.75 R.
    frequency = highest * design.rotor.reference_chord / (1.5 * design.rotor.radius)
    if frequency > FAST_PITCH and not trim.problem.unsteady:
        found["fast-pitch"] = (
            f"At {highest}/rev the reduced frequency at 0.75 R is {frequency:.2f}, but section data are steady: only "
            "the shed wake of a lifting line and pitch-rate damping respond to it."
        )
    control_power = 0.0 if trim.shown.elastic is None else trim.shown.elastic.control_power
    if design.pitch_waves and abs(control_power) > CONTROL_SHARE * abs(power.main_rotor):
        found["control-power"] = (
            f"Pitch links and actuators feed {power_text(control_power, 1)} into the pitching blades; the power here "
            "does not include it."
        )
    if models.trim == "thrust" and not trim.on_stand and trim.mu > 0.0:
        found["torque-without-drag"] = (
            f"Only thrust is trimmed, so the shaft delivers {power_text(power.shaft)}; with the drag of the airframe "
            f"the rotor needs {power_text(power.main_rotor)}, the sum of its parts."
        )
    return found


def _of_the_flight(trim: CaveatInputs) -> dict[str, str]:
    design, mu, power = trim.design, trim.mu, trim.solution.last_power
    found = dict[str, str]()
    if 0.0 < mu < LOW_SPEED and trim.fixed_inflow:
        found["low-speed-inflow"] = (
            f"Prescribed inflow is invalid below advance ratio {LOW_SPEED:g}; the rotor flies at {mu:.3f}."
        )
    if 0.0 < mu < LOWEST_SPEED and not trim.fixed_inflow:
        found["low-speed-inflow"] = (
            f"No skewed-wake model is validated below advance ratio {LOWEST_SPEED:g}; the rotor flies at {mu:.3f}."
        )
    if hover_share(design) and trim.problem.air.joined is None:
        found["low-speed-not-matched"] = (
            "The hover model has no solution at this weight, so the inflow is not blended into hover at low speed."
        )
    thrust = trim.solution.ct if design.hovering else design.weight_coefficient
    inflow = math.sqrt(0.5 * abs(thrust))  # In hover.
    if inflow and math.copysign(1.0, thrust) * design.vertical_speed < 0.0:
        descent, edge = abs(design.vertical_ratio) / inflow, -vortex_ring_edge(mu / inflow)
        if -VORTEX_RING_ONSET < descent < edge < math.inf:
            found["vortex-ring"] = (
                f"The rate of descent is {descent:.2f} of the induced velocity in hover. At this low speed, measured "
                f"inflow exceeds momentum theory above {-VORTEX_RING_ONSET:g}, and the vortex ring state begins at "
                f"{edge:.2f}."
            )
    # A free rotor's power is zero but for rounding.
    if power.main_rotor < 0.0 and design.models.trim != "free-rotor":
        found["beyond-autorotation"] = (
            f"The air drives the rotor{_autorotation(design, power.main_rotor)}: power is negative, and with the "
            "engine off the rotor speeds up."
        )
    installed = design.aircraft.installed_power
    if installed and power.total > installed and not trim.on_stand:
        found["installed-power"] = (
            f"The rotors need {power_text(power.total)}; the engines give {power_text(installed)} at sea level on "
            "a standard day, and less at altitude or in warmer air."
        )
    elif installed and design.condition.isa_offset > 0.0 and not trim.on_stand:
        found["engines-of-a-standard-day"] = (
            f"The engines give {power_text(installed)} at sea level on a standard day. At altitude and in warmer "
            "air they give less, which is not counted here."
        )
    if not trim.on_stand and (beyond := _beyond_stops(trim)):
        found["controls"] = f"The trim is beyond the control stops: {', '.join(beyond)}."
    if mu > HIGH_SPEED:
        found["high-speed"] = (
            f"Above advance ratio {HIGH_SPEED:.2f}, reverse flow and stall dominate; section data are only rough there."
        )
    loading = trim.solution.ct / design.rotor.solidity
    if design.hovering and loading > HOVER_CAUTION:
        found["blade-loading"] = (
            f"C_T/σ {loading:.3f} in hover is above {HOVER_CAUTION:g}: maximum lift limits the rotor, and computed "
            f"power is too low. {_nearest_to_stall(trim.shown.disk.stall_margin, trim.problem.disk.r)}"
        )
    return found


def _of_the_sections(trim: CaveatInputs) -> dict[str, str]:
    design, fields, disk = trim.design, trim.shown.disk, trim.problem.disk
    found, separated = dict[str, str](), trim.shown.regions.separated
    if separated > STALL_SHARE:
        what = "section data are steady, without dynamic stall"
        if fields.unsteady is not None:
            what = "the lags of dynamic stall are those of a NACA 0012"
        found["stall"] = (
            f"The flow is separated over {100.0 * separated:.1f} % of the disk; {what}."
        )
    if (
        design.models.has("dynamic_stall")
        and not trim.problem.inflow.pointwise
        and not design.hovering
    ):
        found["no-dynamic-stall"] = (
            f"The inflow {design.models.inflow} balances the load at each point separately, which excludes dynamic "
            "stall: sections are steady here."
        )
    if held := _held_reynolds(trim):
        found["reynolds-outside-data"] = held
    top_mach = float(fields.mach.max())
    if disk.fit_range is None:  # Tables, not polynomials of one Mach number.
        if top_mach > disk.mach_limit:
            found["mach-outside-data"] = (
                f"The tip reaches Mach {top_mach:.2f}; section data end at {disk.mach_limit:.2f}, constant above."
            )
        return found
    if top_mach > 0.5:
        found["no-compressibility"] = (
            f"The section polar holds for one Mach number; the tip reaches Mach {top_mach:.2f}."
        )
    if any(not span.section.startswith(THESIS_NAME) for span in design.rotor.blade.spans):
        found["mixed-section-data"] = (
            f"Part of the blade uses the polynomials {THESIS_NAME} for one Mach number and transition, the rest tables "
            "over Mach number, so the sections differ by their data, not by their airfoils."
        )
    low, high = disk.fit_range
    outside = ((fields.alpha < low) | (fields.alpha > high)) & (fields.u_t >= 0.0)
    if (clamped := float(fields.cells @ outside.sum(axis=1))) > 0.0:
        found["polynomial-clamped"] = (
            f"{100.0 * clamped:.1f} % of the disk is outside the fitted range of the polynomials and clamped."
        )
    return found


def _held_reynolds(trim: CaveatInputs) -> str:
    """Where the blade has Reynolds numbers beyond those of its section data; empty where it has none."""
    design, r = trim.design, trim.problem.disk.r
    blade, words = design.rotor.blade, list[str]()
    for name in dict.fromkeys(span.section for span in blade.spans):
        section = blade.installed(name)
        if not section.of_reynolds:
            continue
        low, high = section.of_reynolds[0][0], section.of_reynolds[-1][0]
        own = np.array([name in blade.section_at(at)[:2] for at in r.tolist()])
        number = blade.reynolds(section, r, design.reynolds_per_metre)
        for beyond, end in ((own & (number < low), low), (own & (number > high), high)):
            if beyond.any():
                first, last = (f"{r[beyond][k]:.2f}" for k in (0, -1))
                least, most = (
                    f"{value:,.0f}" for value in (number[beyond].min(), number[beyond].max())
                )
                where = f"From {first} to {last} R" if first != last else f"At {first} R"
                words.append(
                    f"{where} the Reynolds number is {least if least == most else f'{least} to {most}'}; the data of "
                    f"{name} at {end:,.0f} are used there."
                )
    return " ".join(words)


def _autorotation(design: Design, power: float) -> str:
    """Where this aircraft sinks without power, to first order: each m/s of descent gives its weight times that."""
    if design.condition.stand is not None:
        return ""
    rate = design.vertical_speed - power / design.condition.load
    return f", which sinks by about {-rate:.0f} m/s in autorotation and by {-design.vertical_speed:.1f} here"


def _beyond_stops(trim: CaveatInputs) -> list[str]:
    """What each control that is beyond its stops needs, and what it has, in words."""
    stops, state, words = trim.design.aircraft.controls, trim.solution.controls, list[str]()
    if stops is None:
        return words
    ranges = {
        "collective": stops.collective,
        "lateral": stops.lateral,
        "longitudinal": stops.longitudinal,
    }
    collective = rigged_collective(trim.design, state)
    for name, place in stops.places(collective, state.cyclic_1c, state.cyclic_1s).items():
        if not 0.0 <= place <= 1.0:
            low, high = (math.degrees(end) for end in ranges[name])
            what = name if name == "collective" else f"{name} cyclic"
            words.append(f"{what} {low + place * (high - low):.1f}° of {low:.1f} to {high:.1f}°")
    return words


def _nearest_to_stall(margin: Array, r: Array) -> str:
    """The element of a hovering blade that is nearest to stall, or furthest beyond it."""
    least = margin.min(axis=1)
    at = int(least.argmin())
    side = "below" if least[at] >= 0.0 else "above"
    return (
        f"At {r[at]:.2f} R the blade is {abs(math.degrees(least[at])):.1f}° {side} its stall angle."
    )


def _rigid(moment: HubMoment) -> str:
    side = "retreating" if moment.roll >= 0.0 else "advancing"
    nose = "up" if moment.pitch >= 0.0 else "down"
    unit, size = ("kN m", 1e3) if moment.size >= 1e4 else ("N m", 1.0)
    return (
        f"Rigid blades without cyclic: the hub carries {abs(moment.roll) / size:.0f} {unit} rolling to the {side} side "
        f"and {abs(moment.pitch) / size:.0f} {unit} nose-{nose}."
    )


HOVER_LIMIT = 0.17
"""Largest C_T/σ: every blade element at its maximum lift, as tests show (Prouty, Helicopter Performance, Stability, and
Control, 1986, figure 5.2; Bousman, NASA TM-2000-209601, is quoted with 0.18 for SC1095 at tip Mach 0.65)."""
LARGEST_FLAPPING = math.radians(20.0)
"""Coning and flapping, whose equations are those of small angles."""
LARGEST_CONTROL = math.radians(35.0)
"""Collective at 0.75 R and cyclic: no rotor's controls reach further."""
LARGEST_TILT = math.radians(40.0)
"""Shaft tilt: beyond it the rotor flies as a propeller."""


def implausible(problem: Problem, elements: BladeElements, total: DiskSums) -> str:
    """Why a trim that closes is refused all the same, as a sentence; empty where nothing speaks against it."""
    state, design = elements.state, problem.design
    lighter = _advice(design)
    checks = (
        (
            "coning",
            state.coning,
            LARGEST_FLAPPING,
            f"check the blade's mass and flap inertia, or {lighter}",
        ),
        ("flapping", math.hypot(state.flap_1c, state.flap_1s), LARGEST_FLAPPING, lighter),
        ("collective", state.collective, LARGEST_CONTROL, lighter),
        ("cyclic", math.hypot(state.cyclic_1c, state.cyclic_1s), LARGEST_CONTROL, lighter),
        ("shaft tilt", state.shaft_tilt, LARGEST_TILT, _HEAVIER),
        (
            "elastic twist",
            _largest_twist(elements),
            LARGEST_FLAPPING,
            f"stiffen the blade, or {lighter}",
        ),
    )
    for name, value, largest, remedy in checks:
        if not abs(value) <= largest:
            return (
                f"Not trimmed: the forces balance at a {name} of {math.degrees(value):,.0f}°, beyond "
                f"±{math.degrees(largest):.0f}°, where these equations no longer hold: {remedy}."
            )
    loading = total.thrust / design.rotor.solidity
    if design.hovering and abs(loading) > HOVER_LIMIT:
        return (
            f"Not trimmed: hover needs C_T/σ {loading:.3f}, and rotors have reached about {HOVER_LIMIT:g} with every "
            f"blade element at its maximum lift: {lighter}."
        )
    return ""


_HEAVIER = "raise the mass, or lower the speed or the drag area"


def _tilt(design: Design) -> float:
    """Shaft tilt [rad] at which thrust overcomes drag."""
    drag, down = design.drag_parts
    return math.atan2(drag, design.weight_coefficient + down)


def _advice(design: Design) -> str:
    """What brings a flight or a test nearer to a trim."""
    condition = design.condition
    if condition.stand is not None:
        given = (
            "change the collective"
            if condition.stand.collective is not None
            else "lower the thrust"
        )
        return given if design.hovering else f"{given} or the advance ratio"
    if _tilt(design) > LARGEST_TILT:
        return _HEAVIER
    lower = ["load factor"] if condition.load_factor > 1.0 else []
    lower += ["mass", "altitude"] if design.hovering else ["mass", "altitude", "speed"]
    return f"lower the {', the '.join(lower[:-1])} or the {lower[-1]}"


def _largest_twist(elements: BladeElements) -> float:
    """Elastic twist of the largest size [rad]; 0 for a rigid blade."""
    if elements.torsion is None:
        return 0.0
    twist = elements.torsion.twist
    return float(twist.flat[np.abs(twist).argmax()])


def _share(stalled: float) -> str:
    """How much of the disk was stalled where the last attempt ended."""
    if stalled <= STALL_SHARE:
        return ""
    return f" The flow is separated over {100.0 * stalled:.0f} % of the disk in the last attempt."


def failure_sentence(design: Design, stalled: float) -> str:
    """Why a design did not trim, and the remedy."""
    condition = design.condition
    if condition.stand is not None:
        return _stand_failure(design, condition.stand, stalled)
    share = _share(stalled)
    advice = _advice(design)
    what = ", ".join(
        (f"{condition.mass:.0f} kg at {condition.altitude:.0f} m", *in_words(design.unusual))
    )
    if design.hovering:
        return f"Not trimmed: {what} is beyond this rotor in hover: {advice}."
    if _tilt(design) > LARGEST_TILT:
        return (
            f"Not trimmed: drag tilts the shaft by {math.degrees(_tilt(design)):.0f}° at {what} and advance ratio "
            f"{condition.advance_ratio:.3f}, and these equations hold only up to {math.degrees(LARGEST_TILT):.0f}°: "
            f"{advice}."
        )
    return (
        f"Not trimmed: {what} and advance ratio {condition.advance_ratio:.3f} is beyond this rotor.{share} "
        f"{advice[:1].upper()}{advice[1:]}{'' if design.flaps else ', or let the blades flap'}."
    )


def stalled_sentence(design: Design, stalled: float) -> str:
    """Why a trim with very much stall has no power, and the remedy."""
    advice = _advice(design)
    return (
        f"Not trimmed: {100.0 * stalled:.0f} % of the lift's moment about the hub comes from separated sections; "
        f"beyond {100.0 * MOST_STALLED:.0f} % no rotor here was compared with a measurement. "
        f"{advice[:1].upper()}{advice[1:]}."
    )


@dataclass(frozen=True)
class Largest:
    """The largest values at which a refused design trims, each with all else as it is; None where not known."""

    mass_kg: float | None = None
    mu: float | None = None
    ct_over_sigma: float | None = None
    hovering: bool = False


def largest_sentence(largest: Largest) -> str:
    """`The largest that trims is 13152 kg at this speed.`, never rounded up; empty where nothing is known."""
    named = list[str]()
    if largest.mass_kg is not None:
        place = "in hover" if largest.hovering else "at this speed"
        named.append(f"{math.floor(largest.mass_kg)} kg {place}")
    if largest.mu is not None:
        named.append(f"advance ratio {math.floor(1e3 * largest.mu) / 1e3:.3f} at this mass")
    if largest.ct_over_sigma is not None:
        loading = math.floor(1e4 * largest.ct_over_sigma) / 1e4
        place = "in hover" if largest.hovering else "at this advance ratio"
        named.append(f"C_T/σ {loading:.4f} {place}")
    if not named:
        return ""
    verb = "trim are" if len(named) > 1 else "trims is"
    return f"The largest that {verb} {' and '.join(named)}."


def _stand_failure(design: Design, stand: Stand, stalled: float) -> str:
    """Why a rotor on a test stand did not trim."""
    share = _share(stalled)
    mu = design.condition.advance_ratio
    what = f"the rotor on the stand has no equilibrium at advance ratio {mu:.3f}"
    if stand.collective is not None:
        return (
            f"Not trimmed: {what} with collective {math.degrees(stand.collective):.2f}° and positive thrust.{share} "
            "Change the collective or the advance ratio."
        )
    wanted = design.weight_coefficient / design.rotor.solidity
    return f"Not trimmed: {what} with C_T/σ {wanted:.4f}.{share} Lower the thrust or the advance ratio."

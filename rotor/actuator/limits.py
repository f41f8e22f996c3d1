"""What a real blade allows: each limit as a value, with a sentence."""

from dataclasses import dataclass

from rotor.actuator.catalogue import ExtensionTwist, PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.actuator.loads import fibre_strain
from rotor.dynamics.structure import structure_data, uh60a_structure
from rotor.trim.solution import Solution

SECTION_THICKNESS = 0.095
"""Of the SC1095, in chords."""
WEB_HEIGHT = 0.0907
"""Of the spar's web at 0.40 c, in chords."""
UNREACHABLE = 100.0
"""Times the range from which a number of volts says nothing any more: a sheet that hardly shears."""


@dataclass(frozen=True)
class Limit:
    """One constraint and how it stands."""

    name: str
    """Short and stable, for scripts."""
    ok: bool
    value: float
    bound: float
    unit: str
    sentence: str


def limits(
    installed: InstalledActuator, swings: tuple[float, ...], solution: Solution | None = None
) -> tuple[Limit, ...]:
    """All constraints of §5.2 that can be put in numbers.

    `swings`: what each segment is asked for, as a share of its range, may exceed 1. `solution`: the flight condition
    whose flap bending counts.
    """
    found: list[Limit] = []
    if isinstance(installed.actuator, PiezoPly):
        found += _electrical(installed.actuator, swings)
        found.append(_strain(installed, installed.actuator, solution))
        found.append(_surface(installed, installed.actuator))
    elif isinstance(installed.actuator, TorqueTube):
        found += _tube(installed, installed.actuator, swings)
    else:
        found.append(_rotor_speed(installed.actuator))
    if not isinstance(installed.actuator, ExtensionTwist):
        found += [_temperature(installed), _mass(installed)]
    return (*found, *_torsion(installed))


def _electrical(ply: PiezoPly, swings: tuple[float, ...]) -> list[Limit]:
    most = max((abs(swing) for swing in swings), default=0.0) * ply.voltage_swing
    low, high = ply.voltage_range
    ok = most <= ply.voltage_swing * (1.0 + 1e-9)
    field = most / ply.electrode_gap * 1e-6
    allowed = ply.voltage_swing / ply.electrode_gap * 1e-6
    span = f"{low:g}…{high:g} V ({low / ply.electrode_gap * 1e-6:.2g}…{high / ply.electrode_gap * 1e-6:.2g} kV/mm)"
    needs = f"needs a swing of {most:.0f} V" if most < UNREACHABLE * ply.voltage_swing else "is beyond any voltage"
    swings_by = (
        f"swings by {field:.2f} kV/mm" if field < UNREACHABLE * allowed else "would have to be hundreds of kV/mm"
    )
    return [
        Limit(
            "voltage", ok, most, ply.voltage_swing, "V",
            f"The required twist {needs}; the range is {span}.",
        ),
        Limit(
            "field", ok, field, allowed, "kV/mm",
            f"The field {swings_by}; reverse field beyond the range would depolarise the sheet.",
        ),
    ]  # fmt: skip


def _strain(installed: InstalledActuator, ply: PiezoPly, solution: Solution | None) -> Limit:
    strain = fibre_strain(installed, solution)
    worst = float(strain.total.max())
    where = float(strain.r[strain.total.argmax()])
    flap = "including flap bending of the trimmed rotor" if solution else "without flap bending"
    return Limit(
        "fibre-strain", worst <= ply.linear_strain, 1e6 * worst, 1e6 * ply.linear_strain, "µε",
        f"Fibre strain reaches {1e6 * worst:.0f} µε at {where:.2f} R ({flap}); the sheet "
        f"is linear up to {1e6 * ply.linear_strain:.0f} and must stay below {1e6 * ply.largest_strain:.0f}.",
    )  # fmt: skip


def _surface(installed: InstalledActuator, ply: PiezoPly) -> Limit:
    share = 2.0 * installed.placement.plies * ply.thickness / (SECTION_THICKNESS * uh60a_structure().chord)
    bound = float(structure_data()["limits"]["surface_share"])
    outside = installed.host.kind == "retrofit"
    where = "outside the skin, so they change the contour" if outside else "inside the torsion skin"
    return Limit(
        "space", not outside or share <= bound, 100.0 * share, 100.0 * bound, "% of thickness",
        f"Plies per side: {installed.placement.plies}, {where}: {100.0 * share:.1f} % of the section's thickness.",
    )  # fmt: skip


def _tube(installed: InstalledActuator, tube: TorqueTube, swings: tuple[float, ...]) -> list[Limit]:
    worst = max((abs(swing) for swing in swings), default=0.0)
    retrofit = installed.host.kind == "retrofit"
    height = WEB_HEIGHT * uh60a_structure().chord
    where = (
        "the existing spar is pressurised with nitrogen for crack indication and must not be opened"
        if retrofit
        else "a spar designed for it can hold it"
    )
    return [
        Limit(
            "torque", worst <= 1.0 + 1e-9, worst * installed.moment, installed.moment, "N·m",
            f"The required twist needs {worst * installed.moment:.0f} N·m; {installed.placement.plies} tube(s) per "
            f"segment give {installed.moment:.0f} N·m, without the stiffness of the tubes themselves.",
        ),
        Limit(
            "space", not retrofit and tube.diameter <= height, 1e3 * tube.diameter, 1e3 * height, "mm",
            f"A tube of {1e3 * tube.diameter:.0f} mm goes into a spar {1e3 * height:.0f} mm high: {where}.",
        ),
    ]  # fmt: skip


def _rotor_speed(laminate: ExtensionTwist) -> Limit:
    return Limit(
        "rotor-speed", False, 0.0, 100.0 * laminate.speed_change, "% of Ω",
        f"Only rotor speed changes the twist: {100.0 * laminate.speed_change:.0f} % slower for full change, but "
        "this rotor runs at constant speed.",
    )  # fmt: skip


def _temperature(installed: InstalledActuator) -> Limit:
    data = structure_data()["limits"]
    actuator = installed.actuator
    assert not isinstance(actuator, ExtensionTwist)
    top = actuator.temperature_range[1]
    if top <= 85.0:  # Makers' storage limit; in use they ask for less.
        top = min(top, float(data["running_temperature_c"]))
    on_heater = installed.placement.chord[0] < float(data["de_ice_end_c"]) and isinstance(actuator, PiezoPly)
    hottest = float(data["de_ice_temperature_c"] if on_heater else data["hot_day_c"])
    heater = "over the de-icing mat" if on_heater else "off the de-icing mat, on a hot day"
    remedy = "" if hottest <= top else f"; start at {data['de_ice_end_c']:g} c or use a high-temperature type"
    return Limit(
        "temperature", hottest <= top, hottest, top, "°C",
        f"The skin {heater} reaches about {hottest:.0f} °C; the actuator works up to {top:.0f} °C{remedy}.",
    )  # fmt: skip


def _mass(installed: InstalledActuator) -> Limit:
    bound = float(structure_data()["limits"]["added_mass_share"])
    reference = float(structure_data()["blade"]["reference_mass_kg"])
    masses = installed.masses
    share = masses.blade / reference
    return Limit(
        "mass", share <= bound, 100.0 * share, 100.0 * bound, "% of blade",
        f"Each blade gains {masses.blade:.1f} kg ({masses.actuator:.1f} actuator, {masses.wiring:.1f} leads, "
        f"{masses.balance:.1f} nose weight): {100.0 * share:.0f} % of {reference:.0f} kg.",
    )  # fmt: skip


def _torsion(installed: InstalledActuator) -> list[Limit]:
    data = structure_data()["limits"]
    margin, least = float(data["torsion_margin_per_rev"]), float(data["torsion_least_per_rev"])
    frequency = installed.frequency
    near = min((3.0, 4.0), key=lambda harmonic: abs(frequency - harmonic))
    gap = abs(frequency - near)
    return [
        Limit(
            "torsion-resonance", gap >= margin, gap, margin, "per rev",
            f"First torsion at {frequency:.2f}/rev is {gap:.2f} from {near:.0f}/rev.",
        ),
        Limit(
            "torsion-least", frequency >= least, frequency, least, "per rev",
            f"First torsion at {frequency:.2f}/rev; below {least:g}/rev, flutter and control loads need a study.",
        ),
    ]  # fmt: skip

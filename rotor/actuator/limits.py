"""Limits of a real blade: each a value, a bound and a sentence; the flight loads that strain its fibres.

Flap bending and fibre strain are those of the elastic blade in trimmed flight, quasi-steady:

    (EI w'')'' − (F_c w')' = dL/dρ − m[(ρ − e)β̈ + Ω²ρβ],   w = w'' = 0 at the flap hinge,   free tip

with lift and flapping of the trimmed solution. Centrifugal force carries most of the load; a blade without it would
bend several times as much. Range: below the second flap mode (2.8/rev), no coupling with twist. Hermite finite elements
with tension stiffness.
"""

from dataclasses import dataclass

import numpy as np

from rotor.actuator.catalogue import ExtensionTwist, PiezoPly, TorqueTube
from rotor.actuator.installation import InstalledActuator
from rotor.dynamics.structure import BendingStructure, structure_data, uh60a_structure
from rotor.dynamics.torsion import added_pull
from rotor.support.arrays import Array
from rotor.trim.solution import Solution

ELEMENTS = 60
BENDING = np.array([[12.0, 6.0, -12.0, 6.0], [6.0, 4.0, -6.0, 2.0], [-12.0, -6.0, 12.0, -6.0], [6.0, 2.0, -6.0, 4.0]])
TENSION = np.array([[36.0, 3.0, -36.0, 3.0], [3.0, 4.0, -3.0, -1.0], [-36.0, -3.0, 36.0, -3.0], [3.0, -1.0, -3.0, 4.0]])
"""Stiffness of an element of unit length, of (w, w') at both ends; tension times 30."""


def unbalanced_load(solution: Solution, structure: BendingStructure) -> tuple[Array, Array]:
    """Radii [m], (elements,), and load per length that rigid flapping does not balance [N/m], (elements, azimuths)."""
    design, disk, controls = solution.design, solution.disk, solution.controls
    rotor = design.rotor
    r = rotor.radius * disk.r
    lift = design.thrust_unit / rotor.blades / rotor.radius * disk.dct
    first = controls.flap_1c * np.cos(disk.psi) + controls.flap_1s * np.sin(disk.psi)
    motion = r[:, None] * (controls.coning + first) - (r - rotor.blade.flap_hinge * rotor.radius)[:, None] * first
    return r, lift - structure.at(r, structure.mass_per_length)[:, None] * rotor.angular_speed**2 * motion


def elastic_flap_moment(solution: Solution, structure: BendingStructure, r: Array) -> Array:
    """EI w'' at r [m] over azimuth [N m], (stations, azimuths)."""
    rotor = solution.design.rotor
    nodes = np.linspace(max(rotor.blade.flap_hinge * rotor.radius, structure.clamp), structure.radius, ELEMENTS + 1)
    radii, load = unbalanced_load(solution, structure)
    at_nodes = interpolate_rows(nodes, radii, load.T, left=0.0).T
    return bending_moments(structure, rotor.angular_speed, nodes, at_nodes, r)


def bending_moments(structure: BendingStructure, angular_speed: float, nodes: Array, load: Array, r: Array) -> Array:
    """EI w'' at r [m] under loads per length at even nodes from the hinge, (nodes, cases), (stations, cases) [N m].

    From the curvature in the middle of each element, where cubic elements are best.
    """
    turn = _deflect(structure, angular_speed, nodes, load)[1::2]
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    curvature = np.diff(turn, axis=0) / (nodes[1] - nodes[0])
    return interpolate_rows(r, middles, (structure.at(middles, structure.flap_stiffness)[:, None] * curvature).T).T


def _deflect(structure: BendingStructure, angular_speed: float, nodes: Array, load: Array) -> Array:
    """(w, w') at even nodes, (2 nodes, cases)."""
    n = len(nodes)
    stiffness, force = np.zeros((2 * n, 2 * n)), np.zeros((2 * n, load.shape[1]))
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    bending = structure.at(middles, structure.flap_stiffness)
    pull = structure.centrifugal_force(middles, angular_speed)
    h = nodes[1] - nodes[0]
    unit = np.array([1.0, h, 1.0, h])
    scale = np.outer(unit, unit)
    for k in range(n - 1):
        place = slice(2 * k, 2 * k + 4)
        stiffness[place, place] += scale * (bending[k] / h**3 * BENDING + pull[k] / (30.0 * h) * TENSION)
        mean = 0.5 * (load[k] + load[k + 1])
        force[place] += np.outer([h / 2.0, h**2 / 12.0, h / 2.0, -(h**2) / 12.0], mean)
    out = np.zeros_like(force)
    out[1:] = np.linalg.solve(stiffness[1:, 1:], force[1:])
    return out


def interpolate_rows(x: Array, known: Array, rows: Array, left: float | None = None) -> Array:
    """np.interp for every row, (cases, known) → (cases, x); `left`: the value below the first."""
    columns: list[Array] = [np.interp(x, known, row, left=left) for row in rows]
    return np.stack(columns)


HALF_THICKNESS = 0.0475
"""Half the thickness of the SC1095, in chords: how far a skin is from the middle."""


_STATIONS = 25
"""Along the plies."""


@dataclass(frozen=True, eq=False)
class FibreStrain:
    """Largest tensile strain along the fibres over the span of the plies [-], (stations,)."""

    r: Array
    """r/R, (stations,)."""
    centrifugal: Array
    flap: Array
    twist: Array

    @property
    def total(self) -> Array:
        return self.centrifugal + self.flap + self.twist


def fibre_strain(installed: InstalledActuator, solution: Solution | None = None) -> FibreStrain:
    """ε_f = ½ε_x(1 − ν) + ½γ at 45°, from F_c/EA, M_flap h/EI and the twist's own shear.

    At another angle ε_f = ε_x(c² − ν s²) + γ s c. Without a solution the flap part is zero. The shear of a full
    voltage swing is taken from the twist rate, γ = 2A θ'/s of a closed cell, a bound for sheets that follow the skin.
    """
    rotor_structure = uh60a_structure(float(installed.beam.r[-1]))
    r = np.linspace(*installed.placement.span, _STATIONS)
    metres = r * rotor_structure.radius
    speed = installed.beam.angular_speed
    pull = rotor_structure.centrifugal_force(metres, speed) + added_pull(installed.added, metres, speed)
    s, c = np.sin(installed.placement.angle), np.cos(installed.placement.angle)
    nu = installed.actuator.material.nu12 if isinstance(installed.actuator, PiezoPly) else 0.3
    along = c**2 - nu * s**2
    bending = np.zeros_like(r)
    if solution is not None:
        moment = np.abs(elastic_flap_moment(solution, rotor_structure, metres)).max(axis=1)
        arm = HALF_THICKNESS * rotor_structure.chord
        bending = moment * arm / rotor_structure.at(metres, rotor_structure.flap_stiffness)
    # 2A/s of a closed contour is its mean thickness, at most the greatest: on the safe side.
    shear = abs(installed.twist_rate) * 2.0 * HALF_THICKNESS * rotor_structure.chord
    return FibreStrain(
        r=r,
        centrifugal=along * pull / rotor_structure.axial_stiffness,
        flap=along * bending,
        twist=np.full_like(r, abs(s * c) * shear),
    )


SECTION_THICKNESS = 0.095
"""Thickness of the SC1095, in chords."""
WEB_HEIGHT = 0.0907
"""Height of the SC1095 spar's web at 0.40 c, in chords."""
UNREACHABLE = 100.0
"""Multiple of the voltage range above which no voltage is printed (a sheet that hardly shears)."""


@dataclass(frozen=True)
class Limit:
    """One constraint: value, bound, and whether it is met."""

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
    """All constraints of thesis §5.2 that can be quantified.

    `swings`: required twist of each segment over its range, may exceed 1. `solution`: the flight condition for flap
    bending.
    """
    exceeded: list[Limit] = []
    if isinstance(installed.actuator, PiezoPly):
        exceeded += _electrical(installed.actuator, swings)
        exceeded.append(_strain(installed, installed.actuator, solution))
        exceeded.append(_surface(installed, installed.actuator))
    elif isinstance(installed.actuator, TorqueTube):
        exceeded += _tube(installed, installed.actuator, swings)
    else:
        exceeded.append(_rotor_speed(installed.actuator))
    if not isinstance(installed.actuator, ExtensionTwist):
        exceeded += [_temperature(installed), _mass(installed)]
    return (*exceeded, *_torsion(installed))


def _electrical(ply: PiezoPly, swings: tuple[float, ...]) -> list[Limit]:
    most = max((abs(swing) for swing in swings), default=0.0) * ply.voltage_swing
    low, high = ply.voltage_range
    ok = most <= ply.voltage_swing * (1.0 + 1e-9)
    field = most / ply.electrode_gap * 1e-6
    allowed = ply.voltage_swing / ply.electrode_gap * 1e-6
    span = f"{low:g}…{high:g} V ({low / ply.electrode_gap * 1e-6:.2g}…{high / ply.electrode_gap * 1e-6:.2g} kV/mm)"
    needs = (
        f"needs a swing of {most:.0f} V" if most < UNREACHABLE * ply.voltage_swing else "is out of range at any voltage"
    )
    swings_by = (
        f"swings by {field:.2f} kV/mm" if field < UNREACHABLE * allowed else "would have to swing by hundreds of kV/mm"
    )
    by_voltage = f"The required twist {needs}; the range is {span}."
    by_field = f"The field {swings_by}; a reverse field beyond the range depolarises the sheet."
    return [
        Limit("voltage", ok, most, ply.voltage_swing, "V", by_voltage),
        Limit("field", ok, field, allowed, "kV/mm", by_field),
    ]


def _strain(installed: InstalledActuator, ply: PiezoPly, solution: Solution | None) -> Limit:
    strain = fibre_strain(installed, solution)
    worst, linear, most = (1e6 * value for value in (float(strain.total.max()), ply.linear_strain, ply.largest_strain))
    where = float(strain.r[strain.total.argmax()])
    flap = "with flap bending of the trimmed rotor" if solution else "without flap bending"
    sentence = (
        f"Fibre strain is up to {worst:.0f} µε at {where:.2f} R ({flap}); the sheet is linear "
        f"up to {linear:.0f} µε and must stay below {most:.0f} µε."
    )
    return Limit("fibre-strain", worst <= linear, worst, linear, "µε", sentence)


def _surface(installed: InstalledActuator, ply: PiezoPly) -> Limit:
    share = 2.0 * installed.placement.plies * ply.thickness / (SECTION_THICKNESS * uh60a_structure().chord)
    bound = float(structure_data()["limits"]["surface_share"])
    outside = installed.host.kind == "retrofit"
    where = "outside the skins, which changes the contour" if outside else "inside the torsion skin"
    sentence = (
        f"Plies per side: {installed.placement.plies}, {where}: {100.0 * share:.1f} % of the section's thickness."
    )
    return Limit("space", not outside or share <= bound, 100.0 * share, 100.0 * bound, "% of thickness", sentence)


def _tube(installed: InstalledActuator, tube: TorqueTube, swings: tuple[float, ...]) -> list[Limit]:
    worst = max((abs(swing) for swing in swings), default=0.0)
    retrofit = installed.host.kind == "retrofit"
    height = WEB_HEIGHT * uh60a_structure().chord
    where = (
        "the existing spar is pressurised with nitrogen for its crack indicator and must not be opened"
        if retrofit
        else "a spar designed for it can hold it"
    )
    tubes, moment = installed.placement.plies, installed.moment
    by_torque = (
        f"The required twist needs {worst * moment:.0f} N·m; {tubes} tube(s) per segment give {moment:.0f} of "
        f"{tubes * tube.torque:.0f} N·m when blocked."
    )
    fits = not retrofit and tube.diameter <= height
    by_space = f"A tube of {1e3 * tube.diameter:.0f} mm in a spar {1e3 * height:.0f} mm high: {where}."
    return [
        Limit("torque", worst <= 1.0 + 1e-9, worst * moment, moment, "N·m", by_torque),
        Limit("space", fits, 1e3 * tube.diameter, 1e3 * height, "mm", by_space),
    ]


def _rotor_speed(laminate: ExtensionTwist) -> Limit:
    percent = 100.0 * laminate.speed_change
    sentence = (
        f"Only rotor speed changes the twist: {percent:.0f} % slower for the full change, and this rotor runs at "
        "constant speed."
    )
    return Limit("rotor-speed", False, 0.0, percent, "% of Ω", sentence)


def _temperature(installed: InstalledActuator) -> Limit:
    data = structure_data()["limits"]
    actuator = installed.actuator
    assert not isinstance(actuator, ExtensionTwist)
    top = actuator.temperature_range[1]
    if top <= 85.0:  # Manufacturer's storage limit; the operating limit is lower.
        top = min(top, float(data["running_temperature_c"]))
    on_heater = installed.placement.chord[0] < float(data["de_ice_end_c"]) and isinstance(actuator, PiezoPly)
    hottest = float(data["de_ice_temperature_c"] if on_heater else data["hot_day_c"])
    heater = "over the de-ice heater mat" if on_heater else "off the heater mat, on a hot day"
    remedy = "" if hottest <= top else f"; start at {data['de_ice_end_c']:g} c or use a high-temperature type"
    sentence = f"The skin {heater} reaches about {hottest:.0f} °C; the actuator works up to {top:.0f} °C{remedy}."
    return Limit("temperature", hottest <= top, hottest, top, "°C", sentence)


def _mass(installed: InstalledActuator) -> Limit:
    bound = float(structure_data()["limits"]["added_mass_share"])
    reference = float(structure_data()["blade"]["reference_mass_kg"])
    masses = installed.masses
    share = masses.blade / reference
    sentence = (
        f"Each blade gains {masses.blade:.1f} kg ({masses.actuator:.1f} actuator, {masses.wiring:.1f} leads, "
        f"{masses.balance:.1f} nose weight): {100.0 * share:.0f} % of {reference:.0f} kg."
    )
    return Limit("mass", share <= bound, 100.0 * share, 100.0 * bound, "% of blade", sentence)


def _torsion(installed: InstalledActuator) -> list[Limit]:
    data = structure_data()["limits"]
    margin, least = float(data["torsion_margin_per_rev"]), float(data["torsion_least_per_rev"])
    frequency = installed.frequency
    near = min((3.0, 4.0), key=lambda harmonic: abs(frequency - harmonic))
    gap = abs(frequency - near)
    first = f"First torsion at {frequency:.2f}/rev"
    by_gap, by_load = f"{first} is {gap:.2f} from {near:.0f}/rev.", f"{first}; below {least:g}/rev control loads grow."
    return [
        Limit("torsion-resonance", gap >= margin, gap, margin, "per rev", by_gap),
        Limit("torsion-least", frequency >= least, frequency, least, "per rev", by_load),
    ]

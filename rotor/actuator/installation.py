"""An actuator installed on a blade: moment, twist along the span by segment, added mass, torsion frequency."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.kind import Actuator, InstalledActuator, MassBreakdown
from rotor.actuator.kind import Drive as Drive
from rotor.actuator.optimum import STATIONS, twisted
from rotor.actuator.section import HostBlade, Placement, default_placement, section_spec, skin
from rotor.design.blade import Carried, Rotor
from rotor.design.design import Design, require_design
from rotor.design.twist import TwistLaw
from rotor.dynamics.structure import (
    BendingStructure,
    carrying,
    check_blade,
    structure_data,
    uh60a_structure,
    uh60a_torsion,
)
from rotor.dynamics.torsion import (
    AddedStructure,
    TorsionBeam,
    stiffer_blade,
    torsion_beam,
    torsion_frequency,
    twist_under_moment,
)
from rotor.optimisation.limits import ChangeLimit
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache


def addition(
    masses: MassBreakdown, placement: Placement, structure: BendingStructure, stiffness: float
) -> AddedStructure:
    """Mass, inertia about the balance axis, and `stiffness` (GJ [N m²]), added over the active span."""
    limits = structure_data()["limits"]
    axis, nose = float(limits["balance_axis_c"]), float(limits["nose_weight_c"])
    low, high = (structure.radius * end for end in placement.span)
    front, rear = placement.chord
    plies, weight = (masses.actuator + masses.wiring) / (high - low), masses.balance / (high - low)
    arm = 0.5 * (front + rear) - axis
    spread = plies * (arm**2 + (rear - front) ** 2 / 12.0) + weight * (axis - nose) ** 2
    return AddedStructure((low, high), plies + weight, spread * structure.chord**2, stiffness)


@bytes_cache
@read_only
def install(
    actuator: Actuator, placement: Placement, host: HostBlade, rotor: Rotor
) -> InstalledActuator:
    """Install an actuator on the blade of a rotor. ValueError for a blade that cannot be built."""
    structure = uh60a_structure(rotor.radius)
    spec = section_spec(structure, host)
    if "span" not in actuator.settings:
        placement = replace(placement, divisions=())
    lines = (skin(spec, side, *placement.chord) for side in ("upper", "lower"))
    # Arc length under the plies [m].
    covered = sum(float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in lines)
    lengths = np.array([(high - low) * structure.radius for low, high in placement.segments])
    areas = covered * lengths
    masses = actuator.masses(placement, rotor.blades, float(areas.sum()), float(lengths.sum()))
    stiffness, moment = actuator.section(spec, placement)
    added = addition(masses, placement, structure, stiffness - spec.stiffness)
    beam, still = (
        torsion_beam(structure, speed, scale=host.stiffness, addition=added)
        for speed in (rotor.angular_speed, 0.0)
    )
    units, rest_units = (
        np.stack([_segment_shape(body, structure, span, 1.0) for span in placement.segments])
        for body in (beam, still)
    )
    moments = actuator.moments(moment, units[:, -1], lengths, placement)
    moment = float(moments.max())
    return InstalledActuator(
        actuator=actuator,
        placement=placement,
        host=host,
        section_stiffness=stiffness,
        moment=moment,
        twist_rate=moment / stiffness,
        segment_areas=tuple(float(area) for area in areas),
        masses=masses,
        added=added,
        beam=beam,
        r=beam.r / structure.radius,
        shapes=actuator.shapes(moments, units, beam),
        rest_shapes=actuator.shapes(moments, rest_units, still),
        blade=stiffer_blade(uh60a_torsion(rotor.radius), host.stiffness, added),
        frequency=torsion_frequency(beam),
    )


def _segment_shape(
    beam: TorsionBeam, structure: BendingStructure, span: tuple[float, float], moment: float
) -> Array:
    low, high = (structure.radius * end for end in span)
    edges = np.clip(beam.r, low, high)
    share = np.diff(edges) / np.diff(beam.r)  # Part of each element that is active.
    return twist_under_moment(beam, share * moment)


def with_actuator_mass(
    design: Design, installed: InstalledActuator, carried: Carried | None = None
) -> Design:
    """The design with the actuator's mass in the aircraft and on the blades, and an elastic blade's new stiffness.

    carried: what the design says of it; None: that it is there, without a drive.
    """
    if design.rotor.blade.carried is not None:
        raise ValueError(
            f"the blades carry {design.rotor.blade.carried.name} already: give a design without actuator"
        )
    carried = carried or _carried(installed, (), False, installed.actuator.id.replace("_", " "))
    condition = replace(design.condition, mass=design.condition.mass + carried.aircraft_kg)
    return replace(
        design, rotor=carrying(design.rotor, carried, elastic=design.elastic), condition=condition
    )


def drive_name(installed: InstalledActuator, shares: Sequence[float]) -> str:
    """`MFC P1 at 1 155 V`; where segments differ, from the least to the most."""
    drives = [installed.actuator.driven_at(share) for share in shares]
    ends = "…".join(
        f"{end:,.0f}".replace(",", "\u2009") for end in sorted({min(drives), max(drives)})
    )
    return f"{installed.actuator.id.replace('_', ' ')} at {ends} {installed.actuator.drive_unit}".replace(
        "-", "−"
    )


def carrying_driven(
    design: Design, installed: InstalledActuator, shares: Sequence[float], *, crossed: bool
) -> Design:
    """The design with an actuator on its blades: mass, stiffness, and the twist of its drive.

    shares: drive of each segment, −1…1 of either side. crossed: fibres laid the other way.
    """
    name = drive_name(installed, shares)
    if any(shares):
        actuator = installed.actuator
        sign = -1.0 if crossed and "crossed" in actuator.settings else 1.0
        steady = [sign * actuator.swing_at(share) for share in shares] @ installed.shapes_in(design)
        design = replace(
            design, twist=twisted(design.twist, np.interp(STATIONS, installed.r, steady), name)
        )
    return with_actuator_mass(design, installed, _carried(installed, shares, crossed, name))


def with_actuator(design: Design, actuator: str) -> Design:
    """The design with an actuator on its blades: its mass, its stiffness, and the twist that its drive makes.

    Parameters:
        design: an elastic blade whose structure is known, without an actuator.
        actuator: NAME, or NAME,KEY=VALUE,… such as `MFC_P1,drive=77` with the drive in per cent of its side, by segment
            `77:50`. Other keys: plies, span=A:B [r/R], chord=A:B [x/c], gj (of a new blade, over that of the present
            one), divisions=R:… [r/R], crossed=1 (laid the other way).

    Returns:
        A design like any other, for `solve`, `sweep` and design files.

    Raises:
        ValueError: the actuator, a key or a value cannot be used, or the blade cannot carry it.
    """
    check_blade(require_design(design).aircraft)
    one = read_actuator(actuator)
    installed = install(find_actuator(one.id), one.placement, one.host, design.rotor)
    count = len(installed.shapes)
    drives = one.drives * count if len(one.drives) < 2 else one.drives
    if len(drives) != count:
        raise ValueError(
            f"{len(drives)} drives do not fit {count} segments: give one, or one for each segment"
        )
    return carrying_driven(
        design, installed, [0.01 * drive for drive in drives], crossed=one.crossed
    )


@dataclass(frozen=True)
class ActuatorSpec:
    """An actuator and its settings, as `read_actuator` reads them from text."""

    id: str
    placement: Placement
    host: HostBlade
    drives: tuple[float, ...]
    """Per cent of either side, by segment or one for all."""
    crossed: bool


def read_actuator(text: str) -> ActuatorSpec:
    """The actuator of a text, as `with_actuator` has it; ValueError with one sentence."""
    id, *words = text.split(",")
    known = {"plies", "span", "chord", "gj", "divisions", "drive", "crossed"}
    given = dict[str, tuple[float, ...]]()
    for word in words:
        key, _, value = word.partition("=")
        try:
            numbers = tuple(map(float, value.split(":")))
        except ValueError:
            numbers = ()
        if key not in known or not numbers or not np.isfinite(numbers).all():
            raise ValueError(
                f"actuator {text!r:.80} has {word!r:.40}: write KEY=NUMBER with {', '.join(sorted(known))}"
            )
        given[key] = numbers
    plain, gj, drives = default_placement(), given.get("gj"), given.get("drive", (0.0,))
    span, chord = given.get("span", plain.span), given.get("chord", plain.chord)
    crossed, least = (
        bool(given.get("crossed", (0.0,))[0]),
        -100.0 if find_actuator(id).drive_range[0] else 0.0,
    )
    if not least and max(drives) <= 0.0:  # One that turns the tip one way is laid the other way.
        drives, crossed = tuple(-drive for drive in drives), crossed != any(drives)
    if len(span) != 2 or len(chord) != 2 or min(drives) < least or max(drives) > 100.0:
        low = "−100" if least else "0"
        raise ValueError(
            f"actuator {text!r:.80}: give span and chord two ends, and drives from {low} to 100 %"
        )
    plies = round(given.get("plies", (plain.plies,))[0])
    placement = Placement(
        (span[0], span[1]), (chord[0], chord[1]), plies, divisions=given.get("divisions", ())
    )
    host = HostBlade() if gj is None else HostBlade("new", gj[0])
    return ActuatorSpec(id, placement, host, drives, crossed)


def _carried(
    installed: InstalledActuator, shares: Sequence[float], crossed: bool, name: str
) -> Carried:
    """What a design says of the actuator on it."""
    place, plain, host, added = (
        installed.placement,
        default_placement(),
        installed.host,
        installed.added,
    )
    drives = [100.0 * share for share in shares]
    settings: dict[str, Sequence[float]] = {
        "plies": () if place.plies == plain.plies else (place.plies,),
        "span": () if place.span == plain.span else place.span,
        "chord": () if place.chord == plain.chord else place.chord,
        "gj": (host.stiffness,) if host.kind == "new" else (),
        "divisions": place.divisions,
        "drive": drives[:1]
        if len(set(drives)) == 1 and drives[0]
        else drives
        if any(drives)
        else (),
        "crossed": (1.0,) if crossed else (),
    }
    words = [
        f"{key}={':'.join(f'{value:.10g}' for value in values)}"
        for key, values in settings.items()
        if values
    ]
    return Carried(
        name=name,
        spec=",".join((installed.actuator.id, *words)),
        aircraft_kg=installed.masses.aircraft,
        blade_kg=installed.masses.blade,
        span_m=added.span,
        inertia_kg_m=added.torsional_inertia,
        added_gj_nm2=added.stiffness,
        gj_factor=host.stiffness,
        sourced=installed.actuator.provenance.sourced,
    )


def change_limit(
    installed: InstalledActuator, reference: TwistLaw, *, root: float = 0.1304
) -> ChangeLimit:
    """The actuator's range as a limit on the change of twist in a search; root: r/R where the blade begins.

    Each segment's twist is spread over the whole segment, cut-out and tip included, like the laws of the concepts;
    `best_actuated` uses the true shape along the active span.
    """
    ends = np.cumsum(installed.segment_twists)
    stations = (root, *installed.placement.divisions, 1.0)
    return ChangeLimit(reference, stations, (0.0, *ends.tolist()))

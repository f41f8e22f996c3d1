"""Figures 5.2–5.4: a piezoelectric sheet under voltage, its electrodes and the field between them. Ours alone."""

import math

import numpy as np

from rotor.actuator.catalogue import PiezoPly, find_actuator
from rotor.actuator.electrical import FieldMap, deformed_sheet, field_map
from rotor.arrays import Array
from rotor.reproduce.optimum_twist import UNKNOWN
from rotor.reproduce.report import Curve, FieldPanel, Panel, Report, Verdict, curve, floats, table

PAIR = ("MFC_P1", "MFC_P2")
"""The same fibres with interdigitated and with continuous electrodes."""
EXAGGERATE = 150.0
"""Strains of a part in a thousand, made visible."""
SOURCE = (
    "Properties and their sources stand in assets/actuators.toml; those recalled or assumed are marked in Table 5.1."
)
FINGER = 0.2
"""Part of the gap that an electrode finger covers (assumed)."""
COLOURS = (0.0, 6.0)
"""Of the field [kV/mm], both sheets alike."""
MM, PPM, KV_MM = 1e3, 1e6, 1e-6
"""From metres, strains and volts per metre."""


def sheet(id: str) -> PiezoPly:
    """A ply of the catalogue."""
    found = find_actuator(id)
    assert isinstance(found, PiezoPly)
    return found


def figure_5_2() -> Report:
    """A sheet changes its shape."""
    panels: list[Panel] = []
    numbers: dict[str, float] = {}
    rows: list[tuple[str | float, ...]] = []
    for id in PAIR:
        one = sheet(id)
        curves: list[Curve] = []
        for k, voltage in enumerate((0.0, one.voltage_range[1], one.voltage_range[0])):
            corners = deformed_sheet(one, voltage)
            along, across = (float(np.ptp(corners[:, axis])) - 1.0 for axis in (0, 1))
            rows.append((id, voltage, PPM * along, PPM * across))
            label, style = (f"{voltage:+.0f} V", "line") if voltage else ("at rest", "dashed")
            curves.append(_outline(label, deformed_sheet(one, voltage, exaggerate=EXAGGERATE), style, (7, 1, 0)[k]))
            numbers |= {f"{id}_along_{k}": along, f"{id}_across_{k}": across}
        panels.append(Panel("along the fibres", "across", tuple(curves), title=title_of(one), equal=True))
    one = sheet(PAIR[0])
    square = deformed_sheet(one, one.voltage_range[1], exaggerate=EXAGGERATE)
    shear, turned = _at_45(square)
    numbers["shear_at_45"] = shear / EXAGGERATE
    panels.append(
        Panel(
            "along the span", "across",
            (_outline("", deformed_sheet(one, 0.0), "dashed", 7), _outline("", turned, "line", 1)),
            title=f"{title_of(one)}, fibres at 45°", equal=True,
        )
    )  # fmt: skip
    high = one.voltage_range[1]
    return Report(
        number="5.2",
        kind="figure",
        caption="A free piezoelectric sheet at rest and at both ends of its voltage range, strains × "
        f"{EXAGGERATE:.0f}; right, one whose fibres lie at 45° to the span.",
        statement=UNKNOWN,
        ours=f"At {high:.0f} V MFC P1 grows by {PPM * numbers['MFC_P1_along_1']:.0f} µε along its fibres and shrinks "
        f"by {-PPM * numbers['MFC_P1_across_1']:.0f} µε across; laid at 45° it shears by "
        f"{PPM * shear / EXAGGERATE:.0f} µε, which is what twists a blade. MFC P2 shrinks both ways and hardly shears.",
        verdict=Verdict.ALONE,
        because=SOURCE,
        tables=(table("strain", ("actuator", "voltage_v", "along_ppm", "across_ppm"), rows),),
        panels=tuple(panels),
        numbers=numbers,
    )


def figure_5_3() -> Report:
    """Electrodes and the potential between them."""
    return _cut(
        "5.3", "potential",
        "Cut through a sheet along its fibres, one electrode gap long: interdigitated fingers on both faces lay the "
        "field along the fibres (d33), continuous electrodes through the thickness (d31). Lines of equal potential.",
        "The field runs across the lines: along the fibres under fingers, through the thickness under plates.",
    )  # fmt: skip


def figure_5_4() -> Report:
    """The field itself."""
    return _cut(
        "5.4", "field",
        "Field in the same cuts at the highest voltage allowed.",
        f"Laplace's equation for one dielectric, fingers {100 * FINGER:.0f} % of the gap wide (assumed); the edge of a "
        "finger is a singularity, so its peak grows as the grid is refined and is cut off in the colours.",
    )  # fmt: skip


def _cut(number: str, what: str, caption: str, because: str) -> Report:
    panels: list[FieldPanel] = []
    numbers: dict[str, float] = {}
    rows: list[tuple[str | float, ...]] = []
    for id in PAIR:
        one = sheet(id)
        found = field_map(one, FINGER)
        mean = one.voltage_range[1] / one.electrode_gap * KV_MM
        across = MM * one.electrode_gap * found.x
        # Interdigitated: z in gaps. Continuous: the gap is the thickness, and any length of it will do.
        through = MM * one.electrode_gap * found.z
        middle = found.strength[len(found.z) // 2, len(found.x) // 2]
        numbers |= {f"{id}_mean": mean, f"{id}_middle": mean * float(middle), **_direction(id, found)}
        values = found.potential * one.voltage_range[1] if what == "potential" else found.strength * mean
        for j in range(0, len(found.z), max(1, len(found.z) // 8)):
            for k in range(0, len(found.x), 6):
                rows.append((id, across[k], through[j], found.potential[j, k], mean * found.strength[j, k]))
        panels.append(
            FieldPanel(
                "along the fibre [mm]", "through the sheet [mm]",
                "potential [V]" if what == "potential" else "field [kV/mm]",
                floats(across), floats(through), tuple(floats(row) for row in values),
                lines=tuple(floats(row) for row in found.potential) if what == "potential" else (),
                title=title_of(one), limits=None if what == "potential" else COLOURS,
                marks=_electrodes(one, across, through),
            )
        )  # fmt: skip
    p1, p2 = PAIR
    ours = (
        f"Halfway between the fingers {numbers[f'{p1}_along_share']:.2f} of the field points along the fibres; between "
        f"plates {numbers[f'{p2}_along_share']:.2f} does."
        if what == "potential"
        else f"MFC P1: mean over the gap {numbers[f'{p1}_mean']:.1f} kV/mm, {numbers[f'{p1}_middle']:.1f} halfway "
        f"between the fingers; MFC P2: {numbers[f'{p2}_mean']:.1f} kV/mm everywhere."
    )
    return Report(
        number=number,
        kind="figure",
        caption=caption,
        statement=UNKNOWN,
        ours=ours,
        verdict=Verdict.ALONE,
        because=because,
        tables=(table("cut", ("actuator", "x_mm", "z_mm", "potential_share", "field_kv_mm"), rows),),
        panels=tuple(panels),
        numbers=numbers,
    )


def title_of(one: PiezoPly) -> str:
    return f"{one.id.replace('_', ' ')}, {one.electrodes} ({'d33' if one.electrodes == 'interdigitated' else 'd31'})"


def _electrodes(one: PiezoPly, x: Array, z: Array) -> tuple[Curve, ...]:
    """Where metal lies on the faces of the cut."""
    length, top = float(x[-1]), float(z[-1])
    half = 0.5 * FINGER * length
    ends = [(0.0, half), (length - half, length)] if one.electrodes == "interdigitated" else [(0.0, length)]
    return tuple(curve("", end, (face, face)) for end in ends for face in (0.0, top))


def _outline(label: str, corners: Array, style: str, colour: int) -> Curve:
    closed = np.vstack([corners, corners[:1]])
    return curve(label, closed[:, 0], closed[:, 1], "dashed" if style == "dashed" else "line", colour=colour)


def _at_45(square: Array) -> tuple[float, Array]:
    """Shear between span and chord [-], and the corners of a unit square at 45°, of a sheet so deformed."""
    along, across = (float(np.ptp(square[:, axis])) - 1.0 for axis in (0, 1))
    turn = math.sqrt(0.5) * np.array([[1.0, -1.0], [1.0, 1.0]])
    strain = turn @ np.diag([along, across]) @ turn.T
    rest = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    return 2.0 * float(strain[0, 1]), rest @ (np.eye(2) + strain)


def _direction(id: str, found: FieldMap) -> dict[str, float]:
    """Part of the field along the fibre in the middle of the cut."""
    j, k = len(found.z) // 2, len(found.x) // 2
    along = float(np.gradient(found.potential[j], found.x)[k])
    through = float(np.gradient(found.potential[:, k], found.z)[j])
    return {f"{id}_along_share": abs(along) / math.hypot(along, through)}

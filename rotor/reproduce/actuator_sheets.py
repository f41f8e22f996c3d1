"""Figures 5.2–5.7: piezoelectric sheets under voltage: electrodes, field, free strain, thermal analogy."""

import math

import numpy as np

from rotor.actuator.catalogue import PiezoPly, actuators, find_actuator
from rotor.actuator.electrical import FieldMap, deformed_sheet, field_map, strain_curve, thermal_coefficients
from rotor.arrays import Array
from rotor.reproduce.report import Agreement, Curve, FieldPanel, PlotPanel, Report, caption_only, curve, floats, table

PAIR = ("MFC_P1", "MFC_P2")
"""The same fibres with interdigitated and with continuous electrodes."""
EXAGGERATE = 150.0
"""Strains of a part in a thousand, made visible."""
SOURCE = "Properties and sources: assets/actuators.toml; recalled or assumed values are marked in Table 5.1."
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
    panels: list[PlotPanel] = []
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
        panels.append(PlotPanel("along the fibres", "across", tuple(curves), title=title_of(one), equal=True))
    one = sheet(PAIR[0])
    square = deformed_sheet(one, one.voltage_range[1], exaggerate=EXAGGERATE)
    shear, turned = _at_45(square)
    numbers["shear_at_45"] = shear / EXAGGERATE
    panels.append(
        PlotPanel(
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
        statement=caption_only("Figure 5.2"),
        ours=f"At {high:.0f} V MFC P1 grows by {PPM * numbers['MFC_P1_along_1']:.0f} µε along its fibres and shrinks "
        f"by {-PPM * numbers['MFC_P1_across_1']:.0f} µε across; laid at 45° it shears by "
        f"{PPM * shear / EXAGGERATE:.0f} µε, which twists the blade. MFC P2 shrinks in both directions and hardly "
        "shears.",
        verdict=Agreement.ALONE,
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
        "finger is a singularity, so its peak grows with grid refinement and is clipped in the colours.",
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
        statement=caption_only(f"Figure {number}"),
        ours=ours,
        verdict=Agreement.ALONE,
        because=because,
        tables=(table("cut", ("actuator", "x_mm", "z_mm", "potential_share", "field_kv_mm"), rows),),
        panels=tuple(panels),
        numbers=numbers,
    )


def title_of(one: PiezoPly) -> str:
    return f"{one.id.replace('_', ' ')}, {one.electrodes} ({'d33' if one.electrodes == 'interdigitated' else 'd31'})"


def _electrodes(one: PiezoPly, x: Array, z: Array) -> tuple[Curve, ...]:
    """Outlines of the electrodes on the faces of the section."""
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


def sheets() -> tuple[PiezoPly, ...]:
    """One of every kind: variants for heat or cut into strips strain as their own kind does."""
    known = [one for one in actuators().values() if isinstance(one, PiezoPly)]
    return tuple(one for one in known if one.id not in ("MFC_P1_HT", "PZT5H_strips"))


def figure_5_5() -> Report:
    """Free strain."""
    by_voltage: list[Curve] = []
    by_field: list[Curve] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    for k, one in enumerate(sheets()):
        found = strain_curve(one)
        by_voltage.append(curve(found.label, found.voltage, PPM * found.along, colour=k))
        by_field.append(curve("", KV_MM * found.field, PPM * found.along, colour=k))
        rows += [
            (one.id, volts, KV_MM * field, PPM * along, PPM * across)
            for volts, field, along, across in zip(found.voltage, found.field, found.along, found.across, strict=True)
        ]
        numbers[one.id] = float(np.ptp(found.along))
    ratio = numbers["MFC_P1"] / numbers["MFC_P2"]
    return Report(
        number="5.5",
        kind="figure",
        caption="Free strain along the fibres over the whole voltage range, against voltage and against field: "
        "interdigitated (d33) and continuous electrodes (d31).",
        statement=caption_only("Figure 5.5"),
        ours="Peak to peak: "
        + ", ".join(f"{id.replace('_', ' ')} {PPM * value:.0f} µε" for id, value in numbers.items())
        + f". The same fibres strain {ratio:.1f} times as much with interdigitated electrodes.",
        verdict=Agreement.ALONE,
        because=f"d33 is about twice d31, and the range of field is wider. {SOURCE}",
        tables=(table("strain", ("actuator", "voltage_v", "field_kv_mm", "along_ppm", "across_ppm"), rows),),
        panels=(
            PlotPanel("voltage [V]", "free strain along [µε]", tuple(by_voltage)),
            PlotPanel("field [kV/mm]", "free strain along [µε]", tuple(by_field)),
        ),
        numbers=numbers,
        legend_below=True,
    )


def figure_5_6() -> Report:
    """The macro fibre composite, as a sheet that a kelvin would stretch as a volt does."""
    one = sheet(PAIR[0])
    found = strain_curve(one)
    alpha, across = thermal_coefficients(one)
    per_volt = one.swing[0] / one.voltage_swing
    low = one.low_swing * found.along
    return Report(
        number="5.6",
        kind="figure",
        caption="Macro fibre composite P1: strain over its voltage range between the low and the high end of the "
        "maker's figures, and by the thermal analogy α = d/ΔES (a volt acts like a kelvin).",
        statement=caption_only("Figure 5.6"),
        ours=f"α {1e6 * alpha:.2f}·10⁻⁶ per volt along and {1e6 * across:.2f}·10⁻⁶ across; measured "
        f"{1e6 * one.low_swing * per_volt:.2f} to {1e6 * per_volt:.2f}·10⁻⁶ along, over "
        f"{one.voltage_range[0]:.0f}…{one.voltage_range[1]:.0f} V.",
        verdict=Agreement.ALONE,
        because=f"Electrodes {MM * one.electrode_gap:.1f} mm apart, sheet {MM * one.thickness:.1f} mm thick. {SOURCE}",
        tables=(
            table(
                "strain",
                ("voltage_v", "along_low_ppm", "along_high_ppm", "across_ppm", "along_thermal_analogy_ppm"),
                zip(found.voltage, PPM * low, PPM * found.along, PPM * found.across, PPM * found.by_coefficient,
                    strict=True),
            ),
        ),
        panels=(
            PlotPanel(
                "voltage [V]", "free strain [µε]",
                (
                    curve("", found.voltage, PPM * low, "band", upper=PPM * found.along, colour=0),
                    curve("along the fibres, measured", found.voltage, PPM * found.along, colour=0),
                    curve("along, by α = d/ΔES", found.voltage, PPM * found.by_coefficient, "dashed", colour=1),
                    curve("across", found.voltage, PPM * found.across, colour=2),
                ),
            ),
        ),
        numbers={"alpha": alpha, "per_volt": per_volt, "low_per_volt": one.low_swing * per_volt},
    )  # fmt: skip


def figure_5_7() -> Report:
    """Field against voltage."""
    curves: list[Curve] = []
    rows: list[tuple[str | float, ...]] = []
    numbers: dict[str, float] = {}
    for k, one in enumerate(sheets()):
        found = strain_curve(one, 2)
        curves.append(curve(found.label, found.voltage, KV_MM * found.field, "both", colour=k))
        low, high = KV_MM * found.field
        rows.append((one.id, *one.voltage_range, MM * one.electrode_gap, low, high))
        numbers |= {f"{one.id}_low": float(low), f"{one.id}_high": float(high)}
    return Report(
        number="5.7",
        kind="figure",
        caption="Field between the electrodes, V/ΔES, over the voltage range of each sheet.",
        statement=caption_only("Figure 5.7"),
        ours="; ".join(
            f"{one.id.replace('_', ' ')} {numbers[f'{one.id}_low']:.2f}…{numbers[f'{one.id}_high']:.2f} kV/mm over "
            f"{MM * one.electrode_gap:.2g} mm"
            for one in sheets()
        )
        + ".",
        verdict=Agreement.ALONE,
        because="Against the poling direction the field must stay below the coercive field of the ceramic (1.2 to 1.5 "
        f"kV/mm for PZT-5A); that sets the low end of the voltage. {SOURCE}",
        tables=(
            table("field", ("actuator", "lowest_v", "highest_v", "gap_mm", "lowest_kv_mm", "highest_kv_mm"), rows),
        ),
        panels=(PlotPanel("voltage [V]", "field [kV/mm]", tuple(curves)),),
        numbers=numbers,
        legend_below=True,
    )

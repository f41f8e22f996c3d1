"""Figures 5.5–5.7: free strain and field over the voltage range, and the thermal analogy. Ours stand alone."""

import numpy as np

from rotor.actuator.catalogue import PiezoPly, actuators
from rotor.actuator.electrical import strain_curve, thermal_coefficients
from rotor.reproduce.electrodes import KV_MM, MM, PAIR, PPM, SOURCE, sheet
from rotor.reproduce.optimum_twist import UNKNOWN
from rotor.reproduce.report import Curve, Panel, Report, Verdict, curve, table


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
        statement=UNKNOWN,
        ours="Peak to peak: "
        + ", ".join(f"{id.replace('_', ' ')} {PPM * value:.0f} µε" for id, value in numbers.items())
        + f". The same fibres strain {ratio:.1f} times as far with interdigitated electrodes.",
        verdict=Verdict.ALONE,
        because=f"d33 is about twice d31, and the range of field is wider. {SOURCE}",
        tables=(table("strain", ("actuator", "voltage_v", "field_kv_mm", "along_ppm", "across_ppm"), rows),),
        panels=(
            Panel("voltage [V]", "free strain along [µε]", tuple(by_voltage)),
            Panel("field [kV/mm]", "free strain along [µε]", tuple(by_field)),
        ),
        numbers=numbers,
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
        "maker's figures, and by the thermal analogy α = d/ΔES (a volt does what a kelvin would do).",
        statement=UNKNOWN,
        ours=f"α {1e6 * alpha:.2f}·10⁻⁶ per volt along and {1e6 * across:.2f}·10⁻⁶ across; measured "
        f"{1e6 * one.low_swing * per_volt:.2f} to {1e6 * per_volt:.2f}·10⁻⁶ along, over "
        f"{one.voltage_range[0]:.0f}…{one.voltage_range[1]:.0f} V.",
        verdict=Verdict.ALONE,
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
            Panel(
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
        statement=UNKNOWN,
        ours="; ".join(
            f"{one.id.replace('_', ' ')} {numbers[f'{one.id}_low']:.2f}…{numbers[f'{one.id}_high']:.2f} kV/mm over "
            f"{MM * one.electrode_gap:.2g} mm"
            for one in sheets()
        )
        + ".",
        verdict=Verdict.ALONE,
        because="Against the poling direction the field must stay below the coercive field of the ceramic (1.2 to 1.5 "
        f"kV/mm for PZT-5A); that sets the low end of the voltage. {SOURCE}",
        tables=(
            table("field", ("actuator", "lowest_v", "highest_v", "gap_mm", "lowest_kv_mm", "highest_kv_mm"), rows),
        ),
        panels=(Panel("voltage [V]", "field [kV/mm]", tuple(curves)),),
        numbers=numbers,
    )

"""Tables 5.1 (actuator properties) and 5.2 (actuators and concepts compared).

Only the titles of the thesis' tables are known; columns and numbers here are our own.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotor.actuator.catalogue import STEPS, PiezoPly, TorqueTube, actuators, find_actuator
from rotor.actuator.optimum import ConditionPair
from rotor.actuator.pay import ENOUGH, BreakEven
from rotor.actuator.section import Host, Placement, default_placement
from rotor.actuator.verdict import Verdict, count, judge, reference
from rotor.optimisation.concepts import find_concept
from rotor.terminal import wrapped

NONE = "–"

COMPARED_ACTUATORS = ("MFC_P1", "MFC_P2", "AFC", "PZT5H", "PZT5H_strips", "SMA_tube")
COMPARED_CONCEPTS = ("linear", "quadratic", "two-segment", "three-segment")


@dataclass(frozen=True)
class ActuatorTable:
    """A table as text."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()
    keys: int = 1
    """First columns that name a row: a table too wide for a line goes on below itself, with them again."""

    def text(self, width: int = 120) -> str:
        """The table with aligned columns, in blocks of at most `width` letters."""
        rows = (self.columns, *self.rows)
        widths = [max(len(row[k]) for row in rows) for k in range(len(self.columns))]
        names = list(range(self.keys))
        blocks = [list(names)]
        for k in range(self.keys, len(self.columns)):
            if len(blocks[-1]) > self.keys and sum(widths[j] + 2 for j in blocks[-1]) + widths[k] > width:
                blocks.append(list(names))
            blocks[-1].append(k)
        lines = [self.title]
        for block in blocks:
            lines.append("")
            lines += ["  ".join(row[k].ljust(widths[k]) for k in block).rstrip() for row in rows]
        return "\n".join([*lines, *(("", *map(wrapped, self.notes)) if self.notes else ())])


def table_5_1() -> ActuatorTable:
    """Actuator properties."""
    columns = (
        "actuator", "mode", "E1 GPa", "E2 GPa", "G12 GPa", "d pm/V", "ΔES mm", "α 1e-6/V", "voltage V",
        "field kV/mm", "free strain µε", "thickness mm", "density kg/m³", "T °C", "readiness", "grade",
    )  # fmt: skip
    rows: list[tuple[str, ...]] = []
    for actuator in actuators().values():
        graded = (actuator.provenance.recalled, "recalled"), (actuator.provenance.assumed, "assumed")
        grade = ", ".join(f"{len(keys)} {word}" for keys, word in graded if keys) or "sourced"
        ready = f"{actuator.provenance.readiness} of {len(STEPS)}"
        if isinstance(actuator, PiezoPly):
            low, high = actuator.voltage_range
            gap = actuator.electrode_gap
            rows.append((
                actuator.id, "d33" if actuator.electrodes == "interdigitated" else "d31",
                f"{actuator.material.e1 / 1e9:.1f}", f"{actuator.material.e2 / 1e9:.1f}",
                f"{actuator.material.g12 / 1e9:.2f}", f"{actuator.d_along * 1e12:.0f}", f"{gap * 1e3:.3g}",
                f"{actuator.d_along / gap * 1e6:.2f}", f"{low:g}…{high:g}",
                f"{low / gap * 1e-6:.2f}…{high / gap * 1e-6:.2f}", f"{actuator.swing[0] * 1e6:.0f}",
                f"{actuator.thickness * 1e3:.3g}", f"{actuator.material.density:.0f}",
                "{:.0f}…{:.0f}".format(*actuator.temperature_range), ready, grade,
            ))  # fmt: skip
        else:
            if isinstance(actuator, TorqueTube):
                mode = f"heat, {actuator.torque:.0f} N·m"
                heat = "{:.0f}…{:.0f}".format(*actuator.temperature_range)
            else:
                mode, heat = f"rotor speed, {math.degrees(actuator.twist):.2f}°", NONE
            rows.append((actuator.id, mode, *[NONE] * 11, heat, ready, grade))
    steps = ", ".join(f"{k} {step}" for k, step in enumerate(STEPS, 1))
    tests = "; ".join(f"{actuator.id} {actuator.provenance.tested}" for actuator in actuators().values())
    notes = (
        "Free strain is along the fibres over the whole voltage range, peak to peak; α = d/ΔES is the thermal analogy.",
        f"Readiness: the step reached of {steps} (Burke & Gatto, Review of Rotary-Wing Morphing Actuation Systems, "
        f"Aerospace 13(3) 297, 2026), placed by us: {tests}.",
        "Numbers and sources: assets/actuators.toml.",
    )
    return ActuatorTable("Table 5.1  Actuator properties", columns, tuple(rows), notes)


def table_5_2(
    pair: ConditionPair,
    *,
    placement: Placement | None = None,
    host: Host | None = None,
) -> ActuatorTable:
    """Actuators and concepts compared for one pair of flight conditions, best net saving first."""
    verdicts = [
        judge(find_actuator(id), pair, find_concept(name), placement or default_placement(), host)
        for id in COMPARED_ACTUATORS
        for name in COMPARED_CONCEPTS
    ]
    return verdict_table(sorted(verdicts, key=lambda verdict: -verdict.net_saving))


def verdict_table(verdicts: Sequence[Verdict]) -> ActuatorTable:
    """Rows of verdicts."""
    columns = (
        "actuator", "concept", "blade", "needed °", "nominal °", "needed/nominal", "voltages V",
        "mass kg", "torsion /rev", "ideal kW", "gross kW", "stiffness kW", "mass kW", "drive kW", "net kW",
        "limits exceeded",
    )  # fmt: skip
    rows = [
        (
            f"{verdict.installed.actuator.id}, {count(verdict)}", verdict.baseline.concept.name,
            verdict.installed.host.label, f"{math.degrees(verdict.required):.2f}",
            f"{math.degrees(verdict.attainable):.2f}",
            f"{verdict.ratio:.2f}" if verdict.ratio < 100.0 else "> 100",
            "; ".join(f"{round(a) + 0}→{round(b) + 0}" for a, b in verdict.voltages) or NONE,
            f"{verdict.installed.masses.aircraft:.0f}", f"{verdict.installed.frequency:.2f}",
            kilowatts(verdict.ideal_saving), kilowatts(verdict.gross_saving), kilowatts(-verdict.stiffness_cost),
            kilowatts(-verdict.mass_cost), kilowatts(-verdict.drive_cost), kilowatts(verdict.net_saving),
            ", ".join(limit.name for limit in verdict.broken) or "none",
        )
        for verdict in verdicts
    ]  # fmt: skip
    pair = verdicts[0].baseline.pair
    mu = " and ".join(f"{mu:g}" for mu in pair.advance_ratios)
    notes = (
        "Angles: change of twist from root to tip between the conditions, magnitudes of segments added; nominal: "
        "whole voltage range.",
        f"All savings against {reference(verdicts[0])} of the concept, costs negative: gross, by the twist within the "
        "actuator's range; stiffness, of another elastic blade at rest; mass; drive. They add up to net. Ideal: gross "
        "with unlimited twist in flight.",
    )
    return ActuatorTable(
        f"Table 5.2  Actuators and concepts compared, advance ratios {mu}", columns, tuple(rows), notes, keys=2
    )


def kilowatts(power: float) -> str:
    """Kilowatts with one decimal, without negative zero."""
    return f"{round(power / 1e3, 1) + 0.0:.1f}"


def pay_table(lines: Sequence[BreakEven]) -> ActuatorTable:
    """What an actuator would have to be, a rotor a row."""
    columns = (
        "rotor", "µ", "optima apart °", "ideal kW", "twist ≥ °", "mass ≤ kg", "drive ≤ W", "mass ≤ kg, no drive",
    )  # fmt: skip
    rows: list[tuple[str, ...]] = []
    for even in lines:
        needed, pair = even.requirement, even.pair
        wanted = [NONE] * 4
        if even.worthwhile:
            wanted = [
                f"{math.degrees(needed.twist):.1f}", f"{needed.mass:.1f}", f"{needed.drive:.0f}",
                f"{even.mass_allowed(needed.twist):.1f}",
            ]  # fmt: skip
        mu = " and ".join(f"{ratio:g}" for ratio in pair.advance_ratios)
        apart = f"{math.degrees(abs(even.change)):.1f}"
        rows.append((pair.design.aircraft.name, mu, apart, f"{even.ideal_saving / 1e3:.2f}", *wanted))
    notes = (
        f"An actuator pays if its twist, linear along the blade, has this range ({100.0 * ENOUGH:.0f} % of what "
        "unlimited twist saves over the best fixed blade, the ideal) and all blades together gain no more than this "
        "mass while it draws no more than this power; less of one allows more of the other. Mass alone: the last "
        "column.",
    )
    return ActuatorTable("What an actuator would have to be", columns, tuple(rows), notes)

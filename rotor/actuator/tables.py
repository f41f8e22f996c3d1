"""Tables 5.1 (actuator properties) and 5.2 (actuators and concepts compared).

Only the titles of the thesis' tables are known; columns and numbers here are our own.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotor.actuator.catalogue import STEPS, actuators, find_actuator
from rotor.actuator.kind import MOST_BOUNDS, Actuator
from rotor.actuator.pay import WANTED_SHARE, BreakEven
from rotor.actuator.section import HostBlade, Placement, default_placement
from rotor.actuator.verdict import Verdict, judge, reference
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.mission import Mission
from rotor.support.terminal import wrapped
from rotor.trim.doubt import rounded_pair, sureness

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
            if (
                len(blocks[-1]) > self.keys
                and sum(widths[j] + 2 for j in blocks[-1]) + widths[k] > width
            ):
                blocks.append(list(names))
            blocks[-1].append(k)
        lines = [self.title]
        for block in blocks:
            lines.append("")
            lines += ["  ".join(row[k].ljust(widths[k]) for k in block).rstrip() for row in rows]
        return "\n".join([*lines, *(("", *map(wrapped, self.notes)) if self.notes else ())])


Row = dict[str, str]
"""A cell by the name of its column; all rows of a table have the same names."""


def table_of(
    title: str, rows: Sequence[Row], notes: tuple[str, ...], keys: int = 1
) -> ActuatorTable:
    """A table whose columns are those of its rows."""
    return ActuatorTable(
        title, tuple(rows[0]), tuple(tuple(row.values()) for row in rows), notes, keys
    )


def table_5_1() -> ActuatorTable:
    """Actuator properties; dashes for what only other kinds have."""
    known = actuators().values()
    steps = ", ".join(f"{k} {step}" for k, step in enumerate(STEPS, 1))
    tests = "; ".join(f"{actuator.id} {actuator.provenance.tested}" for actuator in known)
    notes = (
        "Free strain is along the fibres over the whole voltage range, peak to peak; α = d/ΔES is the thermal analogy.",
        f"Readiness: the step reached of {steps} (Burke & Gatto, Review of Rotary-Wing Morphing Actuation Systems, "
        f"Aerospace 13(3) 297, 2026), placed by us: {tests}.",
        "Numbers and sources: assets/actuators.toml.",
    )
    blank = {key: NONE for actuator in known for key in actuator.properties}
    return table_of(
        "Table 5.1  Actuator properties",
        [_properties(actuator, blank) for actuator in known],
        notes,
    )


def _properties(actuator: Actuator, blank: Row) -> Row:
    provenance, ends = actuator.provenance, actuator.temperature_range
    graded = (provenance.recalled, "recalled"), (provenance.assumed, "assumed")
    return {
        "actuator": actuator.id,
        "mode": actuator.mode,
        **blank,
        **actuator.properties,
        "T °C": NONE if ends is None else "{:.0f}…{:.0f}".format(*ends),
        "readiness": f"{provenance.readiness} of {len(STEPS)}",
        "grade": ", ".join(f"{len(keys)} {word}" for keys, word in graded if keys) or "sourced",
    }


def table_5_2(
    mission: Mission, *, placement: Placement | None = None, host: HostBlade | None = None
) -> ActuatorTable:
    """Actuators and concepts compared over one mission, best net saving first."""
    placement = placement or default_placement()
    verdicts = [
        judge(find_actuator(id), mission, find_concept(name), placement, host, against="best-fixed")
        for id in COMPARED_ACTUATORS
        for name in COMPARED_CONCEPTS
    ]
    return verdict_table(sorted(verdicts, key=lambda verdict: -verdict.net_saving))


def verdict_table(verdicts: Sequence[Verdict]) -> ActuatorTable:
    """The table of several verdicts."""
    mission = verdicts[0].baseline.mission
    notes = (
        "Angles: widest change of twist from root to tip between two legs, magnitudes of segments added; nominal: "
        "whole voltage range.",
        f"All savings against {reference(verdicts[0])} of the concept, costs negative: gross, by the twist within the "
        "actuator's range; stiffness, of another elastic blade at rest; mass; drive. They add up to net, their "
        "bands do not. Ideal: gross with unlimited twist in flight. Sign: that of net.",
    )
    title = f"Table 5.2  Actuators and concepts compared over {mission.words}"
    return table_of(title, [_comparison(verdict) for verdict in verdicts], notes, keys=2)


def _comparison(verdict: Verdict) -> Row:
    installed = verdict.installed
    return {
        "actuator": f"{installed.actuator.id}, {installed.count}",
        "concept": verdict.baseline.concept.name,
        "blade": installed.host.label,
        "needed °": f"{math.degrees(verdict.required):.2f}",
        "nominal °": f"{math.degrees(verdict.attainable):.2f}",
        "needed/nominal": _ratio(verdict),
        "voltages V": "; ".join(
            "→".join(f"{round(volts) + 0}" for volts in segment) for segment in verdict.voltages
        )
        or NONE,
        "mass kg": f"{installed.masses.aircraft:.0f}",
        "torsion /rev": f"{installed.frequency:.2f}",
        "ideal kW": _banded(verdict, "ideal", verdict.ideal_saving),
        "gross kW": _banded(verdict, "gross", verdict.gross_saving),
        "stiffness kW": _banded(verdict, "stiffness", -verdict.stiffness_cost),
        "mass kW": _banded(verdict, "mass", -verdict.mass_cost),
        "drive kW": kilowatts(-verdict.drive_cost),
        "net kW": _banded(verdict, "net", verdict.net_saving),
        "sign": NONE
        if verdict.net_band is None
        else sureness(verdict.net_saving, verdict.net_band, sourced=verdict.sourced),
        "limits exceeded": ", ".join(limit.name for limit in verdict.broken) or "none",
    }


def _ratio(verdict: Verdict) -> str:
    """Twist needed over that of the whole drive."""
    if verdict.ratio > MOST_BOUNDS:
        return f"> {MOST_BOUNDS:.0f}"
    return f"{verdict.ratio:.2f}"


def _banded(verdict: Verdict, name: str, saving: float) -> str:
    """A saving with its band, where that is not zero [kW]."""
    band = verdict.band_of(name)
    if not band:
        return kilowatts(saving)
    return _pair_text(saving / 1e3, band / 1e3)


def _pair_text(change: float, band: float) -> str:
    """A change with its band, without negative zero."""
    pair = rounded_pair(change, band)
    return f"{pair.change + 0.0:.{pair.decimals}f} ± {pair.band:.{pair.decimals}f}"


def kilowatts(power: float) -> str:
    """A power [W] in kilowatts with one decimal, without negative zero."""
    return f"{round(power / 1e3, 1) + 0.0:.1f}"


def pay_table(lines: Sequence[BreakEven]) -> ActuatorTable:
    """What an actuator would need to break even, one row for each rotor."""
    notes = (
        f"An actuator pays if its twist, linear along the blade, has this range ({100.0 * WANTED_SHARE:.0f} % of what "
        "unlimited twist saves over the best fixed blade, the ideal) and all blades together gain no more than this "
        "mass while it draws no more than this power; less of one allows more of the other. Mass alone: the last "
        "column. Sign: that of the ideal.",
    )
    return table_of("What an actuator would have to be", [_wanted(even) for even in lines], notes)


def _wanted(even: BreakEven) -> Row:
    needed, mission, pays = even.requirement, even.mission, even.worthwhile
    return {
        "rotor": mission.design.aircraft.name,
        "µ": ", ".join(f"{leg.advance_ratio:g}" for leg in mission.legs),
        "optima apart °": f"{math.degrees(abs(even.change)):.1f}",
        "ideal kW": _pair_text(even.ideal_saving / 1e3, even.ideal_band / 1e3),
        "sign": sureness(even.ideal_saving, even.ideal_band),
        "twist ≥ °": f"{math.degrees(needed.twist):.1f}" if pays else NONE,
        "mass ≤ kg": f"{needed.mass:.1f}" if pays else NONE,
        "drive ≤ kW": f"{needed.drive / 1e3:.2f}" if pays else NONE,
        "mass ≤ kg, no drive": f"{even.mass_allowed(needed.twist):.1f}" if pays else NONE,
    }

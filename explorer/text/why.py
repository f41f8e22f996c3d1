"""One sentence that says why power changed between two solutions: what moved, which part of power, where on the disk.

The cause is read from what differs: the lift over the disk where the twist changed, else the flight condition, the
model or the rotor. Then come the parts of power that changed most, and separated flow or drag divergence that came or
went.
"""

import math

import numpy as np

from explorer.model.inputs import INFLOW_MENUS
from explorer.model.units import SI, Units, number
from explorer.text.readout import part_change, part_titles
from rotor import Design, Solution
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.switches import SWITCHES, no_effect
from rotor.airfoil.section_table import DRAG_DIVERGENCE
from rotor.design.quantities import OPTIONS, QUANTITIES, UNUSUAL
from rotor.support.arrays import Array, Booleans
from rotor.trim.doubt import Doubt

_SMALL_PART = 0.08
"""A part that changed less than this share of the largest change is left out."""
_LEAST_SHIFT = 3e-4
"""Smallest movement of the lift that is mentioned, as a fraction of R; 0.1° of linear twist in hover gives 5e-4."""


def lift_centroid(solution: Solution) -> tuple[float, float] | None:
    """Centroid of the lift over the disk: mean r/R, and mean sin ψ, positive towards the advancing side. None where the
    rotor does not lift."""
    disk = solution.disk
    lift = disk.dr[:, None] * disk.dct
    total = float(lift.sum())
    if not total > 0.0:
        return None
    return float((lift * disk.r[:, None]).sum()) / total, float(
        (lift * np.sin(disk.psi)).sum()
    ) / total


def why(before: Solution, after: Solution, units: Units = SI, band: Doubt | None = None) -> str:
    """Why `after` needs another power than `before`, as one sentence; also for solutions that did not converge.

    `band`: of the change; the parts of power then have theirs.
    """
    if not after.converged:
        return after.message.partition(". ")[0].rstrip(".") + "."
    if not before.converged:
        return "The previous design had no trim, so there is nothing to compare."
    if before.design == after.design:
        return "Nothing has changed."
    cause = _cause(before, after)
    parts = _changed_parts(before, after, units, band)
    regions = [text for text in (_separation(before, after), _divergence(before, after)) if text]
    sentence = (
        f"{cause}: {', '.join(parts)}"
        if parts
        else f"{cause}: no change in power{_reason(before, after)}"
    )
    return "; ".join([sentence, *regions]) + "."


def lift_movement(before: Solution, after: Solution) -> str:
    """Where the lift moved, for example `Lift moved inboard`; `Lift hardly moved` below 0.0003 R."""
    if (old := lift_centroid(before)) is None or (new := lift_centroid(after)) is None:
        return "a new twist"
    outboard, across = new[0] - old[0], new[1] - old[1]
    places: list[str] = []
    if abs(outboard) >= max(_LEAST_SHIFT, 0.5 * abs(across)):
        places.append("outboard" if outboard > 0.0 else "inboard")
    if abs(across) >= max(_LEAST_SHIFT, 0.5 * abs(outboard)):
        places.append(f"towards the {'advancing' if across > 0.0 else 'retreating'} side")
    return f"Lift moved {' and '.join(places)}" if places else "Lift hardly moved"


def _cause(before: Solution, after: Solution) -> str:
    a, b = before.design, after.design
    if a.aircraft.name != b.aircraft.name:
        return f"{b.aircraft.name} instead of {a.aircraft.name}"
    if a.preset != b.preset:
        return f"Preset {b.preset} instead of {a.preset}"
    causes = [*_rotor_causes(a, b), *_model_causes(a, b), *_flight_causes(a, b)]
    pitched, twisted = (a.pitch_per_rev, b.pitch_per_rev), (a.active_waves, b.active_waves)
    for kind, (old, new) in (("root pitch", pitched), ("active twist", twisted)):
        if old != new:
            orders = " and ".join(f"{harmonic.per_rev}/rev" for harmonic in new)
            causes.append(
                f"{'different ' if old else ''}{kind} at {orders}" if orders else f"no n/rev {kind}"
            )
    if a.twist != b.twist or (a.active_twist != b.active_twist and twisted[0] == twisted[1]):
        # With another rotor or flight the lift moves for their sake too, so it is named only on its own.
        causes = [*causes, "a new twist"] if causes else [lift_movement(before, after)]
    if not causes:
        return "Another model"
    if len(causes) > 2:
        return "Several changes at once"
    text = " and ".join(causes)
    return text[:1].upper() + text[1:]


def _rotor_causes(a: Design, b: Design) -> list[str]:
    if a.rotor.at_speed(100.0) == b.rotor.at_speed(100.0):
        return []
    if a.rotor.blade.spans != b.rotor.blade.spans:
        return ["different blade sections"]
    return [
        "actuators in the blade"
        if (a.active_twist is None) != (b.active_twist is None)
        else "a different blade"
    ]


def _model_causes(a: Design, b: Design) -> list[str]:
    switched = [name for name in SWITCHES if getattr(a.models, name) != getattr(b.models, name)]
    causes = [
        f"{'with' if getattr(b.models, name) else 'without'} {SWITCHES[name].title.lower()}"
        for name in switched
    ]
    for row in (QUANTITIES[name] for name in OPTIONS):
        if row.of(a) != row.of(b):
            causes.append(f"{'with' if row.of(b) else 'without'} {row.title.lower()}")
    if a.models.inflow != b.models.inflow:
        causes.append(
            f"{INFLOW_MODELS[b.models.inflow].title} instead of {INFLOW_MODELS[a.models.inflow].title}"
        )
    if a.models.hover_inflow != b.models.hover_inflow:
        new, old = (
            INFLOW_MENUS["hover_inflow"][design.models.hover_inflow].lower() for design in (b, a)
        )
        causes.append(f"{new} instead of {old} in hover")
    if a.models.low_speed != b.models.low_speed:
        causes.append(
            f"{'with' if b.models.low_speed == 'hover' else 'without'} transition to hover at low speed"
        )
    if a.models.loss_on != b.models.loss_on:
        causes.append(f"tip and root loss on the {b.models.loss_on}")
    return causes


def _flight_causes(a: Design, b: Design) -> list[str]:
    old, new = a.condition, b.condition
    causes: list[str] = []
    if old.advance_ratio != new.advance_ratio:
        way = "faster" if new.advance_ratio > old.advance_ratio else "slower"
        causes.append("hover" if b.hovering else f"{way} (µ {new.advance_ratio:g})")
    if old.stand != new.stand:
        began = (
            "flight instead of a test" if new.stand is None else "the rotor alone, on a test stand"
        )
        causes.append(began if old.stand is None or new.stand is None else "another test")
        return causes
    for row in UNUSUAL.values():
        before, now = (design.unusual.get(row.name) for design in (a, b))
        if before != now:
            causes.append(row.plain if now is None else SI.in_words(row, now))
    if old.mass != new.mass:
        percent = 100.0 * (new.mass / old.mass - 1.0)
        causes.append(
            f"{number(abs(percent), _digits(percent))} % {'more' if percent > 0.0 else 'less'} weight"
        )
    if old.density != new.density:
        percent = 100.0 * (new.density / old.density - 1.0)
        causes.append(
            f"{'denser' if percent > 0.0 else 'thinner'} air ({number(percent, _digits(percent), True)} %)"
        )
    return causes


def _changed_parts(
    before: Solution, after: Solution, units: Units, band: Doubt | None
) -> list[str]:
    """At most three parts of power that changed, the largest change first, the unit behind the last."""
    unit = units.power[0]
    titles = part_titles(before.design, after.design)
    changes = {
        name: unit.of(getattr(after.power, name) - getattr(before.power, name)) for name in titles
    }
    largest = max(abs(change) for change in changes.values())
    digits = _digits(largest)
    shown = max(_SMALL_PART * largest, 0.5 * 10.0**-digits)
    order = sorted(
        (name for name in changes if abs(changes[name]) >= shown),
        key=lambda name: -abs(changes[name]),
    )
    powers = after.power, before.power, band, units, digits
    texts = [f"{titles[name].lower()} {part_change(name, *powers)[0]}" for name in order[:3]]
    return [*texts[:-1], f"{texts[-1]} {unit.symbol}"] if texts else []


def _reason(before: Solution, after: Solution) -> str:
    """Why a single switch has no effect here, in brackets; empty where that is not known."""
    a, b = before.design, after.design
    moved = [name for name in SWITCHES if getattr(a.models, name) != getattr(b.models, name)]
    reason = no_effect(b, moved[0]) if len(moved) == 1 else ""
    return f" ({reason})" if reason else ""


def _separation(before: Solution, after: Solution) -> str:
    a, b = before.disk.stalled, after.disk.stalled
    verb, amount = _area_change(100.0 * before.stalled_area, 100.0 * after.stalled_area, 0.5)
    fresh = _fresh(a, b)
    negative = fresh.any() and float((after.disk.alpha[fresh] < 0.0).mean()) > 0.5
    kind = "separation"
    if negative and verb in ("appeared", "grew"):
        kind = "separation at negative angles"
    return _region(kind, verb, _place(after, a, b), amount)


def _divergence(before: Solution, after: Solution) -> str:
    a, b = (_divergent(solution) for solution in (before, after))
    first, last = (100.0 * solution.regions.drag_divergence for solution in (before, after))
    verb, amount = _area_change(first, last, 1.0)
    place = _place(after, a, b)
    # On the retreating side the Mach number is low: there it is the lift that makes drag rise.
    kind = "drag rise at high lift" if place.endswith("retreating side") else "drag divergence"
    return _region(kind, verb, place, amount)


def _region(kind: str, verb: str, place: str, amount: str) -> str:
    if not verb:
        return ""
    if verb == "disappeared":
        return f"{kind} disappeared"
    if verb == "shrank":
        return f"{kind} shrank to {amount} of the disk"
    return f"{kind} {verb} {place} ({amount} of the disk)"


def _area_change(a: float, b: float, least: float) -> tuple[str, str]:
    """What a region of the disk did, empty where it hardly changed, and its size now. `a`, `b`, `least`: % of πR²."""
    amount = f"{number(b, 1)} %"
    if a < 0.05 and b >= 0.5 * least:
        return "appeared", amount
    if b < 0.05 and a >= 0.5 * least:
        return "disappeared", amount
    if abs(b - a) < max(least, 0.2 * max(a, b)):
        return "", amount
    return "grew" if b > a else "shrank", amount


def _divergent(solution: Solution) -> Booleans:
    """Beyond drag divergence, separated elements left out: their drag has another cause."""
    disk = solution.disk
    return (disk.cd_mach > DRAG_DIVERGENCE) & (disk.u_t >= 0.0) & ~disk.stalled


def _ring(solution: Solution) -> Array:
    """Area of each element at each azimuth as a part of πR², (elements, azimuths)."""
    disk = solution.disk
    return np.broadcast_to(disk.cells[:, None], disk.dct.shape)


def _fresh(before: Booleans, after: Booleans) -> Booleans:
    """Elements that are in a region and were not; all of the region where the two grids differ."""
    return after & ~before if before.shape == after.shape else after


def _place(solution: Solution, before: Booleans, after: Booleans) -> str:
    """Where a region came or grew, by its area-weighted mean radius and azimuth."""
    disk, area = solution.disk, np.where(_fresh(before, after), _ring(solution), 0.0)
    total = float(area.sum())
    if total == 0.0:
        return "on the disk"
    r = float((area * disk.r[:, None]).sum()) / total
    sine, cosine = (float((area * wave(disk.psi)).sum()) / total for wave in (np.sin, np.cos))
    radial = "inboard " if r < 0.5 else "near the tip " if r > 0.85 else ""
    if math.hypot(sine, cosine) < 0.35:
        return f"{radial}all round the disk"
    if abs(sine) >= abs(cosine):
        return f"{radial}on the {'advancing' if sine > 0.0 else 'retreating'} side"
    return f"{radial}at the {'rear' if cosine > 0.0 else 'front'} of the disk"


def _digits(value: float) -> int:
    """One decimal for a change below ten, none above."""
    return 1 if abs(value) < 9.95 else 0

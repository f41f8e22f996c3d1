"""The columns of a study's table, with units. An empty place is null, never NaN."""

from dataclasses import dataclass
from typing import Literal

from rotor.study.quantities import QUANTITIES, concept_labels
from rotor.study.study import Study

Kind = Literal["number", "count", "text"]


@dataclass(frozen=True)
class Column:
    """One column."""

    name: str
    kind: Kind
    unit: str = ""


_POWERS = tuple(
    Column(f"power_{part}_w", "number", "W")
    for part in ("total", "main_rotor", "induced", "profile", "parasite", "tail")
)
_ANGLES = tuple(
    Column(f"{name}_deg", "number", "°")
    for name in ("collective", "cyclic_1c", "cyclic_1s", "coning", "flap_1c", "flap_1s", "shaft_tilt")
)
_HEAD = (
    Column("point", "count"),
    Column("status", "text"),
    Column("message", "text"),
)
_CONDITION = (
    Column("rotor", "text"),
    Column("mu", "number"),
    Column("speed_m_s", "number", "m/s"),
    Column("mass_kg", "number", "kg"),
    Column("altitude_m", "number", "m"),
    Column("preset", "text"),
    Column("inflow", "text"),
    Column("twist", "text"),
)
_ANSWER = (
    *_POWERS,
    Column("ct", "number"),
    Column("cp", "number"),
    Column("ct_over_sigma", "number"),
    Column("lambda0", "number"),
    *_ANGLES,
    Column("reverse_flow_area_percent", "number", "%"),
    Column("stalled_area_percent", "number", "%"),
    Column("caveats", "text"),
    Column("passes", "count"),
    Column("elapsed_ms", "number", "ms"),
)
_SEARCH = (
    Column("mean_power_w", "number", "W"),
    Column("hover_power_w", "number", "W"),
    Column("baseline_power_w", "number", "W"),
    Column("saving_percent", "number", "%"),
    Column("local_minima", "count"),
    Column("active", "text"),
    Column("evaluations", "count"),
)
"""`mean_power_w` is what the search made small; `hover_power_w` is there with hover_share."""


def columns_of(study: Study) -> tuple[Column, ...]:
    """All columns of a study's table: point, status, the condition, what the study sets or finds, the answer."""
    known = {column.name for column in (*_HEAD, *_CONDITION)}
    own = tuple(
        Column(name, "number" if QUANTITIES[name].kind == "number" else "text", QUANTITIES[name].unit)
        for name in dict.fromkeys((*study.names, *_found(study)))
        if name not in known and QUANTITIES[name].kind != "flag"
    )
    return (*_HEAD, *_CONDITION, *own, *_ANSWER, *(_SEARCH if study.searching is not None else ()))


def _found(study: Study) -> tuple[str, ...]:
    """Concept parameters that a search finds, by label."""
    if study.searching is None:
        return ()
    return tuple(label for name in study.concepts for label in concept_labels(name, study.parameters))

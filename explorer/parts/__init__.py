"""What Python tells the scripts of the page: one value a part, each a frozen dataclass of this package.

`Bridge.set` sends them, as JSON; `explorer/web/parts.d.ts` is made from them, and the scripts are checked against it.
This package imports only words and numbers of `rotor`.
"""

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

from explorer.parts.frame import BarPart, LecturePart, NoticePart, StepPart, ViewsPart
from explorer.parts.results import HandPart, InsetPart, PowerPart, StripChart, Worth
from explorer.parts.stage import (
    FieldPart,
    PlanPart,
    RidePart,
    RubberPart,
    SceneLabel,
    TurnPart,
    TwistPart,
    VibrationPart,
)


class Parts(TypedDict, total=False):
    """Every part by its name, and what it is."""

    bar: BarPart
    big: bool
    coarse: int
    dial: Any
    dial_front: Any
    dial_matrix: Any
    earns: Any
    field: FieldPart
    flight: Any
    hand: HandPart | None
    hub_labels: Sequence[SceneLabel]
    idle: int
    inset: InsetPart
    lecture: LecturePart | None
    lifted_labels: Any
    notice: NoticePart | None
    plan: PlanPart | None
    power: PowerPart
    probe_label: Sequence[SceneLabel]
    prompt: SceneLabel | None
    ride: RidePart | None
    rubber: RubberPart | None
    steps: Sequence[StepPart]
    strip: Sequence[StripChart]
    suppose: Any
    turn: TurnPart
    twist: TwistPart
    vibration: VibrationPart | None
    views: ViewsPart
    wipe: bool
    wiped: float
    worth: Mapping[str, Worth]

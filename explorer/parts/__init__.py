"""What Python tells the scripts of the page: one value a part, each a frozen dataclass of this package.

`Bridge.set` sends them, as JSON; `explorer/web/parts.d.ts` is made from them, and the scripts are checked against it.
This package imports only words and numbers of `rotor`.
"""

from collections.abc import Mapping, Sequence
from typing import TypedDict

from explorer.parts.actuate import DialMatrix, DialPart, EarnsPart, FlightPart, SupposePart
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
from rotor.chart import DrawnChart


class Parts(TypedDict, total=False):
    """Every part by its name, and what it is."""

    bar: BarPart
    big: bool
    coarse: int
    dial: DialPart
    dial_front: DrawnChart
    dial_matrix: DialMatrix | None
    earns: EarnsPart | None
    field: FieldPart
    flight: FlightPart | None
    hand: HandPart | None
    hub_labels: Sequence[SceneLabel]
    idle: int
    inset: InsetPart
    lecture: LecturePart | None
    lifted_labels: Sequence[SceneLabel]
    notice: NoticePart | None
    plan: PlanPart | None
    power: PowerPart
    probe_label: Sequence[SceneLabel]
    prompt: SceneLabel | None
    ride: RidePart | None
    rubber: RubberPart | None
    steps: Sequence[StepPart]
    strip: Sequence[StripChart]
    suppose: SupposePart | None
    turn: TurnPart
    twist: TwistPart
    vibration: VibrationPart | None
    views: ViewsPart
    wipe: bool
    wiped: float
    worth: Mapping[str, Worth]

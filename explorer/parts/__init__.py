"""What Python tells the scripts of the page: one value a part, each a frozen dataclass of this package.

`Bridge.set` sends them, as JSON. `make lint` writes their types to `explorer/web/parts.d.ts` and checks the scripts
against them. This package imports only words and numbers of `rotor`.
"""

from collections.abc import Mapping, Sequence
from typing import TypedDict

from explorer.parts import actuate, frame, results, stage
from rotor.support.chart import DrawnChart


class Parts(TypedDict, total=False):
    """Every part by its name, and what it is."""

    assessed: actuate.AssessedPart | None
    bar: frame.BarPart
    big: bool
    coarse: int
    dial: actuate.DialPart | None
    dial_front: DrawnChart | None
    dial_matrix: actuate.DialMatrix | None
    earns: actuate.EarnsPart | None
    field: stage.FieldPart
    flight: actuate.FlightPart | None
    hand: results.HandPart | None
    hub_labels: Sequence[stage.SceneLabel]
    idle: int
    inset: results.InsetPart
    lecture: frame.LecturePart | None
    line: results.LinePart
    lifted_labels: Sequence[stage.SceneLabel]
    notice: frame.NoticePart | None
    plan: stage.PlanPart | None
    power: results.PowerPart
    prices: Mapping[str, stage.RegionPrice] | None
    probe_label: Sequence[stage.SceneLabel]
    prompt: stage.SceneLabel | None
    ride: stage.RidePart | None
    ride_cost: stage.RideCostPart | None
    twisting: stage.TwistingPart | None
    stale: bool
    """Whether what is shown belongs to other inputs than those that are set."""
    steps: Sequence[frame.StepPart]
    strip: Sequence[results.StripChart]
    suppose: actuate.SupposePart | None
    turn: stage.TurnPart
    twist: stage.TwistPart
    vibration: stage.VibrationPart | None
    views: frame.ViewsPart
    wipe: bool
    """Place of the handle between A and B from the left, 0…1."""
    worth: Mapping[str, results.SliderSaving]

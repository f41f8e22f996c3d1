"""What Python tells the scripts of the page: one value a part, each a frozen dataclass of this package.

`Bridge.set` sends them, as JSON; `explorer/web/parts.d.ts` is made from them, and the scripts are checked against it.
This package imports only words and numbers of `rotor`.
"""

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

from explorer.parts.actuate import Dial, DialMatrix, Earns, Flight, LiftedLabel, Suppose
from explorer.parts.results import Hand, Inset, Power, StripChart, Worth
from rotor.chart import DrawnChart


class Parts(TypedDict, total=False):
    """Every part by its name, and what it is."""

    bar: Any
    big: Any
    coarse: Any
    dial: Dial
    dial_front: DrawnChart
    dial_matrix: DialMatrix | None
    earns: Earns | None
    field: Any
    flight: Flight | None
    hand: Hand | None
    hub_labels: Any
    idle: Any
    inset: Inset
    lecture: Any
    lifted_labels: Sequence[LiftedLabel]
    notice: Any
    plan: Any
    power: Power
    probe_label: Any
    prompt: Any
    ride: Any
    rubber: Any
    steps: Any
    strip: Sequence[StripChart]
    suppose: Suppose | None
    turn: Any
    twist: Any
    vibration: Any
    views: Any
    wipe: Any
    wiped: Any
    worth: Mapping[str, Worth]

"""What Python tells the scripts of the page: one value a part, each a frozen dataclass of this package.

`Bridge.set` sends them, as JSON; `explorer/web/parts.d.ts` is made from them, and the scripts are checked against it.
This package imports only words and numbers of `rotor`.
"""

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

from explorer.parts.results import Hand, Inset, Power, StripChart, Worth


class Parts(TypedDict, total=False):
    """Every part by its name, and what it is."""

    bar: Any
    big: Any
    coarse: Any
    dial: Any
    dial_front: Any
    dial_matrix: Any
    earns: Any
    field: Any
    flight: Any
    hand: Hand | None
    hub_labels: Any
    idle: Any
    inset: Inset
    lecture: Any
    lifted_labels: Any
    notice: Any
    plan: Any
    power: Power
    probe_label: Any
    prompt: Any
    ride: Any
    rubber: Any
    steps: Any
    strip: Sequence[StripChart]
    suppose: Any
    turn: Any
    twist: Any
    vibration: Any
    views: Any
    wipe: Any
    wiped: Any
    worth: Mapping[str, Worth]

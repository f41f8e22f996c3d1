"""What Python tells the scripts of the page: one value a part, each a frozen dataclass of this package.

`Bridge.set` sends them, as JSON; `explorer/web/parts.d.ts` is made from them, and the scripts are checked against it.
This package imports only words and numbers of `rotor`.
"""

from typing import Any, TypedDict


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
    hand: Any
    hub_labels: Any
    idle: Any
    inset: Any
    lecture: Any
    lifted_labels: Any
    notice: Any
    plan: Any
    power: Any
    probe_label: Any
    prompt: Any
    ride: Any
    rubber: Any
    steps: Any
    strip: Any
    suppose: Any
    turn: Any
    twist: Any
    vibration: Any
    views: Any
    wipe: Any
    wiped: Any
    worth: Any

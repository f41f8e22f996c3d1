"""What the scripts of the page tell Python: every press by its name, and the type and bounds of its value."""

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

_Label = Annotated[str, Meta(max_length=100)]
_Index = Annotated[int, Meta(ge=0, lt=10**6)]
_Radius = Annotated[float, Meta(ge=0.0, le=1.0)]
_Azimuth = Annotated[float, Meta(ge=-3600.0, le=3600.0)]
_Amplitude = Annotated[float, Meta(ge=0.0, le=90.0)]
_Share = Annotated[float, Meta(ge=-10.0, le=10.0)]
_Pull = _Share | None
_Hand = Literal["start", "end"]
_Switch = Literal["on", "off"]
Drawn = Literal["drawn", "none", "lost"]
"""Whether the browser draws the scene, has no WebGL, or had it and has lost it."""


class _Fields(Struct, array_like=True, forbid_unknown_fields=True):
    """A value with several fields, which comes as an array of them."""


class SectionPress(_Fields):
    r: _Radius
    psi: _Azimuth
    """[°]"""


class SlidePress(_Fields):
    name: _Label
    place: Annotated[float, Meta(ge=-1e7, le=1e7)]
    """On the slider of this name, in the unit shown."""


class SupposePress(_Fields):
    tip: _Amplitude
    """Change of twist at the tip [°]."""
    mass: Annotated[float, Meta(ge=0.001, le=1e4)]
    """[kg] of all blades."""


class MapPress(_Fields):
    x: _Radius
    y: _Radius
    """Shares of the map's edges, from the lower left."""


class CoveredPress(_Fields):
    above: _Share
    below: _Share
    left: _Share
    right: _Share
    """Shares of the canvas that cards cover along its edges."""


class IdlePress(_Fields):
    serial: _Index
    wholly: bool
    """Whether nothing more may be computed for the page, searches apart."""


class KnotMove(_Fields):
    r: Annotated[float, Meta(ge=-2.0, le=2.0)] | None
    """None: it stays where it is along the blade."""
    theta: Annotated[float, Meta(ge=-360.0, le=360.0)]
    """Twist less that at 0.75 R [°]."""


class KnotPress(_Fields):
    name: _Label
    change: Literal["start", "end", "undo"] | KnotMove


_Hours = tuple[_Index, Annotated[float, Meta(ge=0.0, le=99.0)]]
"""A leg of the mission, and its flight time [h]."""


class WavePress(_Fields):
    per_rev: _Index
    amplitude: _Amplitude
    phase: _Azimuth
    """Both [°]."""


_ALONE = (
    *("pin", "swap", "back", "undo", "redo", "play", "apply", "discard"),
    *(
        "halt",
        "nearest",
        "aim",
        "taken",
        "beat",
        "game_link",
        "game_take",
        "game_end",
        "feasible",
        "unstall",
    ),
)
"""Presses whose names say it all: what comes with them is not read."""
PRESSES: dict[str, Any] = {
    **dict.fromkeys(_ALONE),
    **dict.fromkeys(("along", "hold", "seen"), bool),
    **dict.fromkeys(
        (
            "field",
            "region",
            "mode",
            "drawer",
            "task",
            "opened",
            "rotor",
            "law",
            "flown",
            "default",
            "kind",
        ),
        _Label,
    ),
    **dict.fromkeys(("story", "guess", "stop", "dial_front"), _Index),
    **dict.fromkeys(("grab_at", "twist_by_hand"), _Radius),
    **dict.fromkeys(("difference", "more"), _Switch),
    "ride": Literal["off"] | SectionPress | None,
    "riding": _Azimuth,
    "section": SectionPress,
    "slide": SlidePress,
    "azimuth": _Azimuth,
    "fly": Annotated[float, Meta(ge=0.0, le=100.0)],
    "hours": _Hours,
    "kind": _Label,
    "compare": Literal["built", "this", "a"] | _Index,
    "against": Literal["same-blade", "best-fixed"],
    "state": Literal["set", "schedule", "stopped"],
    "suppose": _Switch | SupposePress,
    "balance": Literal["here", "flight"],
    "map_at": MapPress,
    "pull": _Pull,
    "covered": CoveredPress,
    "scene": Drawn,
    "view": Literal["actuator", "3d", "disk", "blade", "top", "side", "ride"],
    "colours": Literal["Rescale", "Default"],
    "lecture": Literal["back", "next", "end"],
    "idle": IdlePress,
    "knot": KnotPress,
    "dial": _Hand | Annotated[list[WavePress], Meta(min_length=1, max_length=9)],
}
"""Every press of the page's scripts, and what its value must be."""

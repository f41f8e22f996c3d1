"""What a whole page has been sent after each step of one walk: server, session, workers, widgets; no browser.

The order of messages depends on threads, so the state is kept that each step ends in: parts of the frame, widgets,
notices, address and what is stored, as far as the step changed them.
"""

import asyncio
import json
from collections.abc import Mapping, Sequence
from typing import Any

from .record import Record, named

Action = tuple[str, str, Any]
"""`press` with the name of a press and its value, `move` with the label of a widget and its value, or `until` with the
name of a text of the page and its kind."""

PAUSE_S = 1.3
"""[s] between two actions: what comes sooner is a drag, whose trims have fewer digits, and one step of undo."""
PATIENCE_S = 200.0
"""[s] for one step on a busy machine."""
WALK: Mapping[str, Sequence[Action]] = {
    "arrival": (),
    "twist": (
        ("press", "hold", True),
        ("move", "Δ outboard [°/R]", -2.0),
        ("press", "hold", False),
    ),
    "speed": (("move", "Adv. ratio µ", 0.3),),
    "keep as A": (("press", "pin", None),),
    "linear law": (("move", "Twist concept", "Linear"), ("move", "Rate [°/R]", -10.0)),
    "difference": (("press", "difference", "on"),),
    "swap": (("press", "swap", None),),
    "back to A": (("press", "back", None), ("press", "pin", None)),
    "undo": (("press", "undo", None),),
    "undo again": (("press", "undo", None),),
    "redo": (("press", "redo", None),),
    "more sliders": (("press", "more", "on"), ("move", "Altitude [m]", 1500.0)),
    "Coleman": (("move", "Inflow", "Coleman"),),
    "Drees": (("move", "Inflow", "Drees"),),
    "stall off": (("move", "Stall", False),),
    "stall on": (("move", "Stall", True),),
    "too heavy": (("move", "Mass [t]", 11.0), ("move", "Adv. ratio µ", 0.44)),
    "nearest trim": (("press", "nearest", None),),
    "reset speed": (("move", "Mass [t]", 8.0), ("move", "Adv. ratio µ", 0.2)),
    "details": (("press", "drawer", "details"),),
    "trust": (("press", "drawer", "trust"),),
    "probe": (("press", "drawer", "probe"), ("press", "section", [0.8, 250.0])),
    "disk": (("press", "view", "disk"),),
    "from above": (("press", "view", "top"),),
    "Mach number": (("press", "field", "Mach number"),),
    "fitted colours": (("press", "colours", "Rescale"),),
    "3D": (("press", "view", "3d"), ("press", "region", "stall")),
    "turned": (("press", "azimuth", 200.0),),
    "ride": (("press", "ride", [0.7, 90.0]),),
    "ride ends": (("press", "ride", "off"),),
    "by hand": (("press", "grab_at", 1.0),),
    "aviation": (("press", "drawer", "settings"), ("move", "Units", "Aviation")),
    "SI": (("move", "Units", "SI"), ("move", "Dark page", True)),
    "bookmark": (
        ("press", "drawer", "open"),
        ("press", "opened", "History"),
        ("move", "Keep this design", True),
    ),
    "share": (("press", "drawer", "share"),),
    "design file": (("move", "Design file", True),),
    "tables": (("move", "Tables", True),),
    "optimise": (("press", "mode", "optimise"), ("press", "drawer", "")),
    "found": (
        ("move", "Concept", "Linear"),
        ("move", "Optimise", True),
        ("until", "search", "done"),
    ),
    "applied": (("press", "apply", None),),
    "actuate": (("press", "mode", "actuate"),),
    "voltage": (("move", "Voltage [%]", 77.0),),
    "flight": (("press", "fly", 1.5),),
    "stopped": (("press", "state", "stopped"),),
    "supposed": (("press", "state", "set"), ("press", "suppose", "on")),
    "against": (("press", "suppose", "off"), ("press", "against", "best-fixed")),
    "in the rotor": (("press", "view", "3d"),),
    "explore": (("press", "mode", "explore"),),
    "Bo 105": (("press", "rotor", "bo105"),),
    "R22": (("press", "rotor", "r22"),),
    "tunnel": (("press", "rotor", "xv15"),),
    "lecture": (("press", "drawer", "lecture"), ("move", "Start the lecture", True)),
    "guess": (("press", "guess", 0),),
    "stop": (("press", "stop", 1),),
    "next": (("press", "lecture", "next"),),
    "end": (("press", "lecture", "end"),),
}
"""Steps by name."""
BEGIN = "?d=1;uh60a;inflow=drees"
"""The address that the walk begins with: a model whose trims take little time."""
LINKS: Mapping[str, str] = {
    "A and B": "?d=1;linear:-8;mu=0.3;inflow=drees&a=1;linear:-2;mu=0.3;inflow=drees",
    "not read": "?d=1;linaer:-8",
    "an actuator": "?d=1;uh60a;inflow=drees&actuator=MFC_P1,drive=77",
    "a view": "?d=1;linear:-8;inflow=drees&v=1;field=mach-number",
}
"""Addresses with which a page is opened."""
DROPPED = frozenset(("order", "uuid", "container_uuid", "container_id", "id", "_tab_container_ids"))
"""Properties of widgets that are drawn by chance, or are times."""
COUNTERS = frozenset(("idle", "beat"))
"""Parts of the frame that count presses."""


def write(record: Record) -> None:
    """The walk, then pages that are opened with a link."""
    app = named("explorer.app.App")("127.0.0.1", 0)
    try:
        ran = named("tests.tools.visitor.ran")
        record.scenario("walk", lambda record: ran(lambda: walk(record, app.address), 3600.0))
        for name, query in LINKS.items():
            record.scenario(
                f"link {name}",
                lambda record, name=name, query=query: ran(
                    lambda: open_link(record, app.address, name, query)
                ),
            )
    finally:
        app.stop()


async def walk(record: Record, address: str) -> None:
    """Keep what each step of `WALK` changes on one page."""
    visitor = named("tests.tools.visitor.Visitor")(query=BEGIN)
    await visitor.open(address)
    await visitor.until(lambda: visitor.text("status") == "converged", PATIENCE_S)
    await settle(visitor)
    shown: dict[str, str] = {}
    for number, (name, actions) in enumerate(WALK.items()):
        place = f"{number:02d} {name}"
        for action in actions:
            await attempt(record, f"{place}/{action[0]} {action[1]}", visitor, action)
            await settle(visitor)
        keep_changes(record, place, visitor, shown)
    await visitor.close()


async def open_link(record: Record, address: str, name: str, query: str) -> None:
    """Keep all that a page shows that is opened with a link."""
    visitor = named("tests.tools.visitor.Visitor")(query=query)
    await visitor.open(address)
    await visitor.until(lambda: visitor.frame.get("line") is not None, PATIENCE_S)
    await settle(visitor)
    keep_changes(record, f"link {name}", visitor, {})
    await visitor.close()


async def attempt(record: Record, name: str, visitor: Any, action: Action) -> None:
    """Do one action; why it cannot be done is kept."""
    kind, what, value = action
    try:
        match kind:
            case "press":
                await visitor.press(what, value)
            case "move":
                await visitor.move(what, value)
            case _:
                await visitor.until(
                    lambda: f'data-explorer="{what}" data-kind="{value}"' in contents(visitor),
                    PATIENCE_S,
                )
    except (LookupError, TimeoutError) as error:
        record.keep(name, f"could not be done, {type(error).__name__} {error}")


async def settle(visitor: Any) -> None:
    """Wait until nothing more is computed for the page, and until the next change is not taken for a drag."""
    await visitor.idle(PATIENCE_S)
    await asyncio.sleep(PAUSE_S)
    await visitor.idle(PATIENCE_S)


def contents(visitor: Any) -> str:
    """The markup of all widgets."""
    return "".join(str(widget.get("content", "")) for widget in visitor.widgets.values())


def keep_changes(record: Record, place: str, visitor: Any, shown: dict[str, str]) -> None:
    """Keep what of the page is other than in `shown`, its parts as text by name, and bring `shown` up to date."""
    parts = {f"frame/{name}": part for name, part in visitor.frame.items() if name not in COUNTERS}
    parts |= widgets(visitor)
    parts["notices"] = visitor.notices
    parts["address"] = visitor.query
    parts["blade"] = visitor.blade
    # What the browser stores. Earlier trees have no public name for it, either.
    for name, text in visitor._facts["kept"].items():
        parts[f"kept {name}"] = text
    for name, value in parts.items():
        text = json.dumps(value, sort_keys=True, default=str)
        if shown.get(name) != text:
            shown[name] = text
            record.keep(f"{place}/{name}", value)
    for name in shown.keys() - parts.keys():
        del shown[name]
        record.keep(f"{place}/{name}", "no longer there")


def widgets(visitor: Any) -> dict[str, Any]:
    """Widgets by their place on the page and their label."""
    found = dict[str, Any]()
    for number, widget in enumerate(visitor.widgets.values()):
        label = widget.get("label") or "text"
        properties = {
            key: value
            for key, value in widget.items()
            if key not in DROPPED and not isinstance(value, memoryview)
        }
        found[f"widget {number:03d} {label}".replace(": ", " ")] = json.loads(
            json.dumps(properties, default=str)
        )
    return found

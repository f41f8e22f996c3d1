"""What stands for the bridge to the page's scripts where there is no page."""

import json
from typing import Any

import msgspec

from explorer.hosting.messages import checked_press


class Bridge:
    """Keeps what the frame was told, and the actions that it would call."""

    def __init__(self) -> None:
        self.actions: dict[str, Any] = {}
        self.state: dict[str, Any] = {}

    def on(self, name: str, action: Any) -> None:
        self.actions[name] = action

    def press(self, name: str, value: Any) -> None:
        """As a script sends it."""
        press = checked_press(json.dumps([0, name, value]))
        self.actions[name](press[1])

    def set(self, **parts: Any) -> None:
        msgspec.json.encode(parts)  # Whatever is told must be JSON.
        self.state |= parts

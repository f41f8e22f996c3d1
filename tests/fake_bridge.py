"""What stands for the bridge to the page's scripts where there is no page."""

from typing import Any

import msgspec


class Bridge:
    """Keeps what the frame was told, and the actions that it would call."""

    def __init__(self) -> None:
        self.actions: dict[str, Any] = {}
        self.state: dict[str, Any] = {}

    def on(self, name: str, action: Any) -> None:
        self.actions[name] = action

    def set(self, **parts: Any) -> None:
        msgspec.json.encode(parts)  # Whatever is told must be JSON.
        self.state |= parts

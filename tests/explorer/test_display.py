"""The view of a client without a browser: how fast a played rotor turns."""

import math
from types import SimpleNamespace
from typing import Any

import pytest
from fake_bridge import Bridge

from explorer.model.inputs import ViewState
from explorer.tabs.display import Display
from explorer.tabs.probe_panel import ProbePanel


def test_a_press_takes_the_next_pace_and_the_blade_walks_at_it():
    bridge: Any = Bridge()
    display = Display(bridge, ViewState(), lambda: None, lambda: None)
    rates: dict[str, float] = {}
    for _ in range(3):
        azimuths: list[float] = []
        seen = SimpleNamespace(turn=azimuths.append, turn_rate=display.turn_rate)
        context = SimpleNamespace(view=lambda: ViewState(azimuth_deg=350.0), display=seen)
        panel: Any = SimpleNamespace(_context=context, _left=600.0, _walked=350.0, _pause=lambda: None)
        ProbePanel._walk_on(panel, 0.2)
        assert azimuths == [pytest.approx((350.0 + 0.2 * math.degrees(display.turn_rate)) % 360.0)]
        rates[bridge.state["turn"]["pace"]] = display.turn_rate
        bridge.actions["pace"](None)
    assert sorted(rates, key=lambda pace: rates[pace]) == ["slow", "normal", "fast"]
    assert bridge.state["turn"]["pace"] == next(iter(rates)) == "normal"

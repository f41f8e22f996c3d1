"""The view of a client without a browser: how fast a played rotor turns."""

import math
from types import SimpleNamespace
from typing import Any

import pytest
from fake_bridge import Bridge

from explorer.model.inputs import ViewState
from explorer.scene.controller import TURN_RATES
from explorer.tabs.display import Display
from explorer.tabs.probe.probe_panel import ProbePanel


def test_a_press_takes_the_next_speed():
    bridge: Any = Bridge()
    display = Display(bridge, ViewState(), lambda: None, lambda: None)
    seen = []
    for _ in range(4):
        seen.append((bridge.state["turn"]["pace"], display.turn_rate))
        bridge.actions["pace"](None)
    assert [name for name, _ in seen] == ["normal", "fast", "slow", "normal"]
    assert seen[2][1] < seen[0][1] < seen[1][1]


@pytest.mark.parametrize("pace", TURN_RATES)
def test_the_blade_walks_at_the_chosen_rate(pace: str):
    azimuths: list[float] = []
    display = SimpleNamespace(turn=azimuths.append, turn_rate=TURN_RATES[pace])
    context = SimpleNamespace(view=lambda: ViewState(azimuth_deg=350.0), display=display)
    panel: Any = SimpleNamespace(_context=context, _left=600.0, _walked=350.0, _pause=lambda: None)
    ProbePanel._walk_on(panel, 0.2)
    assert azimuths == [pytest.approx((350.0 + 0.2 * math.degrees(TURN_RATES[pace])) % 360.0)]

"""The change of power since a slider or the blade was taken hold of."""

from dataclasses import replace

import pytest

from explorer.model.inputs import Inputs
from explorer.model.undo import PAUSE, PowerTracker

START = Inputs(law="linear", linear=-8.0)
DRAG = 0.05
"""[s] between two movements of a drag."""


def at(rate: float, **others: float) -> Inputs:
    return replace(START, linear=rate, **others)


R22 = {"rotor": "r22", "mass_t": 0.6}
BEGUN = ((START, 850e3, 0.0, None), (at(-9.0), 847e3, 60.0, -3e3))
"""A page that has opened at 850 kW, and a first movement."""
COURSES = {
    "the first solution is what counting begins from": ((START, 850e3, 0.0, None),),
    "a drag counts from the power before it": (
        (START, 850e3, 0.0, None), (at(-8.5), 849e3, 60.0, -1e3), (at(-9.0), 847e3, DRAG, -3e3),
    ),
    "the same inputs keep the count": (*BEGUN, (at(-9.0), 847e3, 0.0, -3e3)),
    "after a pause the next movement counts anew": (*BEGUN, (at(-10.0), 845e3, PAUSE, -2e3)),
    "another slider counts anew without a pause": (*BEGUN, (at(-9.0, mass_t=9.0), 950e3, DRAG, 103e3)),
    "while the pointer is down neither a pause nor a second input ends the grab": (
        BEGUN[0], "grab", BEGUN[1], (at(-9.5, two_division=0.6), 846e3, 10.0, -4e3), "release",
        (at(-10.0, two_division=0.6), 845e3, 10.0, -1e3),
    ),
    "a second grab counts from where the slider stands": (*BEGUN, "grab", (at(-9.5), 846e3, DRAG, -1e3)),
    "a step without trim has no change and does not spoil the next": (
        *BEGUN, (at(-30.0), None, DRAG, None), (at(-9.5), 846e3, DRAG, -4e3),
    ),
    "a reset drops what was kept": (*BEGUN, "reset", (at(-12.0), 840e3, 0.0, None)),
    "another rotor is no change of power": (
        *BEGUN, (replace(at(-9.0), **R22), 74e3, 60.0, None), (replace(at(-9.5), **R22), 73e3, 60.0, -1e3),
    ),
    # Reset, then a handle taken at once: the change is counted, not lost for as long as it is held.
    "a grab before the new design has a power counts from its first": (
        BEGUN[0], "reset", "grab", (START, 850e3, 0.0, 0.0), (at(-9.0), 847e3, DRAG, -3e3), "release",
    ),
    # A lecture sets another design while the answer to the last drag is still on its way.
    "what no hand has moved does not count": (
        *BEGUN, "reset", (at(-9.5), 846e3, DRAG, None), (at(-16.0, mass_t=10.0), 1349e3, 60.0, None), "touch",
        (at(-16.5, mass_t=10.0), 1347e3, DRAG, -2e3),
    ),
    # The release comes at once, the answers to the last movements of the drag later.
    "a slider let go before its last answers counts from the press": (
        (START, 1047e3, 0.0, None), "grab", (at(-9.0), 1000e3, 60.0, -47e3), (at(-10.0), 901e3, 3.0, -146e3), "release",
        (at(-10.5), 915e3, DRAG, -132e3), (at(-10.6), 929e3, DRAG, -118e3),
    ),
}  # fmt: skip
"""Calls of the tracker, and solutions: inputs, power [W], pause [s] and the change that is expected [W]."""


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES)
def test_change(course: tuple[str | tuple[Inputs, float | None, float, float | None], ...]):
    tracker, expected = PowerTracker(), None
    for step in course:
        if isinstance(step, str):
            getattr(tracker, step)()
            expected = None if step == "reset" else expected
        else:
            inputs, power, pause, expected = step
            assert tracker.solved(inputs, power, pause) == expected
    if course[-1] == "release":
        assert tracker.change == expected

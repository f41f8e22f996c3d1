"""The published results of active blades: stated figures, signs, and what is derived from them."""

import pytest

from rotor.actuator.catalogue import Programme, programmes


def test_lift_to_drag_as_power_by_hand():
    """Of the same lift at the same speed: L/D 3.43 % lower takes 1/0.9657 = 3.55 % more power."""
    single, both = (found for found in programmes() if found.short == "XH-59A")
    assert single.power_change_percent == pytest.approx(3.5518, rel=1e-4)
    assert both.power_change_percent == pytest.approx(-0.3686, rel=1e-3)


def test_a_stated_power_is_not_replaced():
    jain = next(found for found in programmes() if found.short == "Jain et al.")
    assert jain.power_change_percent == -3.3
    assert jain.lift_to_drag_percent == 7.3


@pytest.mark.parametrize("found", programmes(), ids=lambda found: found.name)
def test_each_result_is_complete(found: Programme):
    """A change of vibration or power, how it was found, and a source; computed and measured are told apart."""
    assert found.vibration_percent is not None or found.power_change_percent is not None
    assert (found.vibration_percent is not None) == bool(found.vibration)
    assert found.kind in {"computed", "wind tunnel", "flight"}
    assert found.grade in {"P", "S", "T"}
    assert len(found.source) > 20
    for low, high in filter(None, (found.vibration_percent, found.amplitude_deg)):
        assert low <= high
    if found.vibration_percent is not None:
        assert -100.0 <= found.vibration_percent[0] <= found.vibration_percent[1] < 0.0
    if found.together:
        assert found.power_change_percent is not None

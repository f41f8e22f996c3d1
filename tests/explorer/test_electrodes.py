"""The folder of electrodes without a browser: chart, pictures and words of every sheet."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.tabs.actuator import electrodes as picture
from rotor.actuator.catalogue import PiezoPly, actuators

SHEETS = [one for one in actuators().values() if isinstance(one, PiezoPly)]


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda sheet: sheet.id)
def test_strain_follows_the_voltage(sheet: PiezoPly):
    """Along the fibres it is what the catalogue says at both ends; the present voltage is a point on that line."""
    low, high = sheet.voltage_range
    x, other, across, along, analogy, now = picture.strain_plot(sheet, (0.5 * high, 0.0), None).data
    assert (x[0], x[-1]) == (low, high)
    assert_allclose(along[-1] - along[0], 1e6 * sheet.swing[0], rtol=1e-9)
    assert_allclose(across[-1] - across[0], 1e6 * sheet.swing[1], rtol=1e-9)
    assert_allclose(analogy, along, rtol=0.08, atol=1.0)
    here = np.isfinite(now)
    assert_allclose(x[here], [0.0, 0.5 * high])
    assert_allclose(now[here], along[here])
    assert np.isfinite(other).any()


def test_the_other_kind_strains_the_other_way():
    """d33 grows where d31 shrinks, so that the two lines cross at 0 V."""
    for sheet in SHEETS:
        other = picture.other_kind(sheet)
        assert other.electrodes != sheet.electrodes
        assert np.sign(other.d_along) != np.sign(sheet.d_along)


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda sheet: sheet.id)
def test_cuts_and_ranges_are_whole(sheet: PiezoPly):
    panel = picture.field_panel(sheet)
    assert panel.count("<image") == 2
    assert panel.count("<polyline") == 18
    assert panel.count("<rect") == 6  # Four fingers and two plates.
    assert f"{1e6 * sheet.d_along / sheet.electrode_gap:.2f}·10⁻⁶ /V".replace("-", "−") in panel
    ranges = picture.ranges_panel(sheet, (sheet.voltage_range[1],))
    assert ranges.count("rxa-track") == len(SHEETS)
    assert "nan" not in (panel + ranges).lower()


def test_the_field_now_is_voltage_over_gap():
    text = re.sub(r"<[^>]+>", " ", picture.ranges_panel(SHEETS[0], (900.0, 100.0)))
    assert "Now, segment 1" in text
    assert "+900 V · +1.80 kV/mm · +810 µε" in text

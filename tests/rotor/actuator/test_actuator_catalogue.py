"""Actuator data against each other and against the maker's own derived figures; field, strain, thermal analogy;
published results of active blades."""

import tomllib

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.actuator.catalogue import PiezoPly, Programme, actuators_of_kind, programmes
from rotor.support.assets import asset_path

PLIES = actuators_of_kind(PiezoPly)


def test_mfc_data_are_consistent():
    """The maker also gives 900 N and 150 µm for a patch of 85 × 57 mm, 48.8 kJ/m³ and 0.16 g/cm²."""
    mfc = PLIES["MFC_P1"]
    strain = mfc.swing[0]
    assert_allclose(mfc.material.e1 * strain * 57e-3 * mfc.thickness, 900.0, rtol=0.05)
    assert_allclose(85e-3 * strain, 150e-6, rtol=0.03)
    assert_allclose(0.5 * mfc.material.e1 * strain**2, 48.8e3, rtol=0.02)
    assert_allclose(mfc.material.density * mfc.thickness, 1.6, rtol=0.03)
    nu21 = mfc.material.nu12 * mfc.material.e2 / mfc.material.e1
    assert_allclose(nu21, 0.16, atol=0.005)
    assert_allclose(strain / mfc.voltage_swing, 0.9e-6, rtol=1e-12)


@pytest.mark.parametrize("sheet", PLIES.values(), ids=lambda sheet: sheet.id)
def test_strain_is_coefficient_times_field(sheet: PiezoPly):
    """Free strain over the range against d times the field's swing: they agree to the spread of the material data."""
    field = np.ptp(sheet.field(sheet.voltage_range))
    assert_allclose(sheet.swing[0], sheet.d_along * field, rtol=0.06)
    assert_allclose(sheet.swing[1], sheet.d_across * field, rtol=0.06)


def test_grades_of_the_file_are_those_of_the_lists():
    """Every number of the table is followed by its grade; R and A ones are those that the program warns about."""
    assert "AFC: assumed values: capacitance" in " ".join(PLIES["AFC"].provenance.warnings("AFC"))
    text = asset_path("actuators.toml").read_text(encoding="utf-8")
    for row, block in zip(tomllib.loads(text)["ply"], text.split("[[ply]]")[1:], strict=True):
        marked: dict[str, set[str]] = {"R": set(), "A": set()}
        for line in block.split("\n[[")[0].splitlines():
            key, _, rest = line.partition(" = ")
            value, _, comment = rest.partition("#")
            if comment and value.strip().lstrip("-").replace(".", "").isdigit():
                grade = comment.split()[0]
                assert grade in {"P", "S", "D", "A", "R"}, line
                marked.setdefault(grade, set()).add(key.strip())
        assert marked["R"] == set(row["recalled"]), row["id"]
        assert marked["A"] == set(row["assumed"]), row["id"]


def test_lift_to_drag_as_power_by_hand():
    """At the same lift and speed, L/D 3.43 % lower takes 1/0.9657 = 3.55 % more power."""
    single, both = (found for found in programmes() if found.short == "XH-59A")
    assert single.power_change_percent == pytest.approx(3.5518, rel=1e-4)
    assert both.power_change_percent == pytest.approx(-0.3686, rel=1e-3)
    jain = next(found for found in programmes() if found.short == "Jain et al.")
    # As stated, where it is.
    assert (jain.power_change_percent, jain.lift_to_drag_percent) == (
        -3.3,
        7.3,
    )


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

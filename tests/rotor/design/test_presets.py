"""The loaded UH-60A data against the document's tables and published values; design files."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.airfoil.polynomial import THESIS_READING
from rotor.design.aircraft import in_words
from rotor.design.quantities import PRESETS
from rotor.files.design_file import load_design
from rotor.files.make_design import make_design, uh60a_rotor


def test_tables_3_1_and_3_2_and_what_follows():
    """Thesis tables 3.1 (tail rotor) and 3.2 (main rotor)."""
    rotor, tail = uh60a_rotor("thesis"), make_design().tail_rotor
    assert (rotor.radius, rotor.angular_speed, rotor.reference_chord, rotor.blades) == (
        8.1788,
        27.0,
        0.5273,
        4,
    )
    assert_allclose(rotor.blade.mass / rotor.radius, 13.92, rtol=1e-12)
    assert (tail.radius, tail.angular_speed, tail.chord, tail.blades, tail.arm) == (
        1.6764,
        124.62,
        0.2469,
        4,
        9.926,
    )
    assert make_design(preset="thesis").condition.mass == 8322.4
    assert_allclose(rotor.solidity, 0.0821, atol=5e-5)
    design = make_design()
    ct = design.condition.weight / (1.225 * design.rotor.disk_area * design.rotor.tip_speed**2)
    assert_allclose(ct, 0.0065, atol=1e-5)
    assert_allclose(design.weight_coefficient, ct, rtol=1e-12)
    # ½·1.225·100²·3.2646 = 19 996 N.
    assert_allclose(make_design().fuselage.drag(1.225, 100.0), 19_995.7, rtol=1e-5)


def test_sections_along_the_flown_blade():
    blade = uh60a_rotor("flight").blade
    assert blade.section_at(0.3) == ("sc1095", "sc1095", 0.0)
    assert blade.section_at(0.65) == ("sc1094r8", "sc1094r8", 0.0)
    assert blade.section_at(0.9) == ("sc1095", "sc1095", 0.0)
    inner, outer, weight = blade.section_at(0.5 * (0.4658 + 0.4969))
    assert (inner, outer) == ("sc1095", "sc1094r8")
    assert_allclose(weight, 0.5, rtol=1e-12)
    assert {span.section for span in uh60a_rotor("thesis").blade.spans} == {THESIS_READING.name}


def test_standard_atmosphere_and_a_hot_day():
    """ISO 2533, geopotential altitude: 2000 m 1.00649 kg/m³, 332.53 m/s; 4000 m 0.81913 kg/m³, 324.58 m/s."""
    for altitude, density, sound in (
        (0.0, 1.225, 340.294),
        (2000.0, 1.00649, 332.53),
        (4000.0, 0.81913, 324.58),
    ):
        condition = make_design(altitude_m=altitude).condition
        assert_allclose(condition.density, density, rtol=1e-5)
        assert_allclose(condition.sound_speed, sound, rtol=1e-4)
    # 1500 m, ISA + 20 °C: p 84 556 Pa and T 298.40 K (ISO 2533: 278.40 K), so that ρ is 0.987 kg/m³, a 346.3 m/s,
    # and Sutherland's law gives 1.8384·10⁻⁵ Pa s.
    hot = make_design(altitude_m=1500, isa_offset_c=20).condition
    assert_allclose(hot.density, 84_556.0 / (287.05287 * 298.40), rtol=1e-5)
    assert_allclose(
        (hot.density, hot.sound_speed, hot.viscosity), (0.987, 346.3, 1.8384e-5), rtol=2e-4
    )
    assert in_words(hot.unusual) == ("ISA + 20 °C",)
    assert in_words(make_design(isa_offset_c=-10, climb_m_s=-3).unusual) == (
        "ISA − 10 °C",
        "descent 3 m/s",
    )


STAND = {"shaft_tilt_deg": -12.0, "thrust_n": 60e3, "flapping": "free", "cyclic_1s_deg": -2.0}


@pytest.mark.parametrize(
    "asked",
    [
        *(
            {"preset": one, "twist": law}
            for one in PRESETS
            for law in (None, "segments:-12,-4@0.5", "ideal")
        ),
        {"climb_m_s": -3.5},
        {"low_speed": "wake"},
        *({"trim": trim, "stand": STAND} for trim in ("wind-tunnel", "free-rotor")),
        {
            "trim": "wind-tunnel",
            "stand": {"ct_over_sigma": 0.06, "flapping": "hub-moments", "hub_roll_nm": 2e4},
        },
        {"trim": "controls", "stand": {"collective_deg": 7.0, "cyclic_1c_deg": 0.5}},
    ],
    ids=str,
)
def test_design_files_round_trip(tmp_path: Path, asked: dict[str, Any]):
    """To the last digit but for angles, which are kept to 1e-6 of a degree; what is not asked for is not written."""
    design = make_design(mu=0.23, mass_kg=7654.0, altitude_m=1200.0, **asked)
    assert set(design.to_dict()) - set(make_design().to_dict()) == set(asked) - {"preset", "twist"}
    path = tmp_path / "design.json"
    design.save(path)
    back = load_design(path)
    r = np.linspace(0.13, 1.0, 20)
    assert_allclose(back.twist(r), design.twist(r), atol=1e-8)
    assert replace(back, twist=design.twist, condition=design.condition) == design
    record, again = design.to_dict(), back.to_dict()
    assert again.pop("stand", {}) == pytest.approx(record.pop("stand", {}))
    assert again == record
    assert json.loads(path.read_text())["version"] == 2


def test_the_twist_of_a_case_outlives_a_preset():
    """The blade as built of the other preset takes the place of the blade as built alone."""
    case = make_design(twist="linear:-8", mu=0.3)
    assert make_design(case=case, preset="flight") == case
    assert make_design(case=case, preset="thesis").twist == case.twist
    built = make_design(preset="thesis")
    assert make_design(case=built, preset="flight").twist == make_design().twist

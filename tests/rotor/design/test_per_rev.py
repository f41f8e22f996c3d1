"""Root pitch and twist at harmonics of rotor speed: how they are written, the field, the elastic answer, energy."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.design.active_twist import ActiveTwist, Harmonic, harmonics_text, read_harmonics
from rotor.design.aircraft import Stand
from rotor.design.design import Design
from rotor.dynamics.torsion import torsion_beam
from rotor.files.design_file import design_from_record, load_design
from rotor.files.make_design import make_design
from rotor.study.study_file import parse_study
from rotor.trim.analysis import Analysis
from rotor.trim.forward import course_of
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from tests.solved import SAME, assert_same_trim
from tests.torsion_waves import driven_by_its_root, tip_wave


@pytest.mark.parametrize("per_rev", range(2, 9))
def test_the_pitch_of_a_rigid_blade_has_the_wave(per_rev: int):
    """θ = θ_tw + θ0 + θ1c cos ψ + θ1s sin ψ + A cos(Nψ − φ) at every element and azimuth."""
    design = make_design(
        mu=0.2, inflow="pitt-peters", pitch_per_rev=[(per_rev, 0.8, 70.0)], off="elastic-twist"
    )
    solution = solve(design).require()
    disk, controls, psi = solution.disk, solution.controls, solution.disk.psi
    wave = math.radians(0.8) * np.cos(per_rev * psi - math.radians(70.0))
    wave += (
        controls.collective + controls.cyclic_1c * np.cos(psi) + controls.cyclic_1s * np.sin(psi)
    )
    assert_allclose(disk.theta, design.twist(disk.r)[:, None] + wave, atol=1e-12)


def test_twist_turns_the_tip_nose_up_at_phase_over_n():
    """Zero at the root cut-out, DEG at the tip at ψ = PHASE/N, linear between; −DEG half a period later."""
    design = make_design(mu=0.2, twist_per_rev="4:2:120")
    active, root = design.active_twist, design.rotor.blade.root_cutout
    assert active is not None
    psi = np.radians([120.0 / 4.0, 120.0 / 4.0 + 45.0])
    field = active(np.array([root, 0.5 * (1.0 + root), 1.0]), psi)
    assert_allclose(np.degrees(field), [[0.0, 0.0], [1.0, -1.0], [2.0, -2.0]], atol=1e-12)


def test_an_amplitude_below_zero_is_half_a_turn_of_phase():
    """To the last digit, so that files, links and caches know them as one."""
    for one, other in (
        ("3:-1:20", "3:1:200"),
        ("3:1:-90", "3:1:270"),
        ("5:-0.3:180", "5:0.3:0"),
        ("2:1:400", "2:1:40"),
    ):
        assert make_design(pitch_per_rev=one) == make_design(pitch_per_rev=other)
        assert make_design(twist_per_rev=one) == make_design(twist_per_rev=other)


def in_thin_air(pitch: str, **changes: object) -> Design:
    """The UH-60A's blade with a straight tip, nearly in vacuum: in thin air, all of its structure thirty times as much.

    Frequencies stay, and the air holds it thirty times less.
    """
    stand = Stand(collective=0.05, density=0.05, tip_mach=0.6)
    design = make_design(
        mu=0.2, trim="wind-tunnel", stand=stand, inflow="pitt-peters", pitch_per_rev=pitch
    )
    structure = design.rotor.blade.structure
    assert structure is not None
    heavy = replace(
        structure,
        torsional_stiffness=tuple(30.0 * value for value in structure.torsional_stiffness),
        torsional_inertia=tuple(30.0 * value for value in structure.torsional_inertia),
        mass_per_length=tuple(30.0 * value for value in structure.mass_per_length),
        control_stiffness=30.0 * structure.control_stiffness,
    )
    made = replace(heavy, **changes)
    design = replace(
        design, rotor=replace(design.rotor, blade=replace(design.rotor.blade, structure=made))
    )
    return replace(design, models=replace(design.models, swept_tip=False))


def tip_pitch(make: Callable[[str], Design], per_rev: int) -> complex:
    """Pitch of the tip at a harmonic, elastic and given, by a degree of root pitch at phase 0 [°]."""

    def wave(pitch: str) -> complex:
        return math.degrees(1.0) * tip_wave(solve(make(pitch)).require(), per_rev)

    return 1.0 + wave(f"{per_rev}:1:0") - wave("")


@pytest.mark.parametrize("per_rev", [2, 3, 4, 6])
def test_a_blade_on_its_controls_answers_root_pitch_as_a_beam(per_rev: int):
    """Finite elements of the whole pitch, without modes: (K − N²Ω²M) θ = K_θ θ_p at the root."""
    design = in_thin_air("")
    structure, speed = design.rotor.blade.structure, design.rotor.angular_speed
    assert structure is not None
    beam = torsion_beam(structure, speed, control=True)
    expected = driven_by_its_root(beam, per_rev)
    found = tip_pitch(in_thin_air, per_rev)
    assert_allclose(found, expected, rtol=0.01)
    assert abs(expected) > 1.05  # Further than a rigid blade.


def test_both_are_off_in_hover_and_the_wake_lies_where_it_lay():
    solution = solve(make_design(mu=0.0, pitch_per_rev="3:2:0", twist_per_rev="2:1:0")).require()
    assert_same_trim(solution, solve(make_design(mu=0.0)))
    assert {"root-pitch-rests", "active-twist-rests"} <= {
        caveat.name for caveat in solution.caveats
    }
    plain, moved = (
        solve(make_design(mu=0.15, pitch_per_rev=pitch)).require() for pitch in ("", "3:1:0")
    )
    assert course_of(Analysis(plain).linear.problem) == course_of(Analysis(moved).linear.problem)


def test_what_the_models_leave_out_is_said():
    def names(solution: Solution) -> list[str]:
        return [caveat.name for caveat in solution.require().caveats]

    assert not {"fast-pitch", "control-power"} & set(
        names(solve(make_design(mu=0.2, pitch_per_rev="3:1:180")))
    )
    assert "fast-pitch" not in names(solve(make_design(mu=0.2, pitch_per_rev="5:3:0")))
    solution = solve(make_design(mu=0.2, pitch_per_rev="5:3:0", off="unsteady"))
    assert {"fast-pitch", "control-power"} <= set(names(solution))
    power = rotor.solution_record(solution)["control_power_w"]
    assert power == solution.elastic.control_power > 0.005 * solution.power.main_rotor


def test_all_ways_of_writing_are_one():
    as_text = make_design(pitch_per_rev="2:1.5:90, 3:0.4:10", twist_per_rev="2:1:0")
    as_rows = (
        {"per_rev": 2, "amplitude_deg": 1.5, "phase_deg": 90},
        {"per_rev": 3, "amplitude_deg": 0.4, "phase_deg": 10},
    )
    for pitch in (
        [(3, 0.4, 10), (2, 1.5, 90)],
        as_rows,
        as_text.pitch_per_rev,
        [[2, 1.5, 90], as_rows[1], (4, 0, 0)],
    ):
        assert make_design(pitch_per_rev=pitch, twist_per_rev=[(2, 1, 0)]) == as_text
    assert read_harmonics(harmonics_text(as_text.pitch_per_rev), "again") == as_text.pitch_per_rev


@pytest.mark.parametrize("phase", [0.1, -1.0, 2.0 * math.pi, 5e-324, -1e-20, 6.283185307179586])
def test_text_holds_all_digits(phase: float):
    """Degrees and back cost a unit in the last place, and only once."""
    made = (Harmonic(2, 0.0123456789, phase), Harmonic(7, 0.1, phase / 3.0))
    read = read_harmonics(harmonics_text(made), "again")
    for one, other in zip(made, read, strict=True):
        assert_allclose(
            [one.amplitude, one.phase], [other.amplitude, other.phase], rtol=5e-16, atol=1e-18
        )
    assert read_harmonics(harmonics_text(read), "again") == read


def test_a_grid_too_coarse_for_the_wave_is_refused():
    design = make_design(mu=0.2, inflow="pitt-peters", pitch_per_rev="8:1:0")
    with pytest.raises(ValueError, match="8/rev needs more than 16 azimuths, not 16"):
        solve(replace(design, models=replace(design.models, azimuths=16)))


def test_design_files_hold_both(tmp_path: Path):
    """As on the command line; another shape of twist as an object. Both at once are refused."""
    design = make_design(mu=0.2, pitch_per_rev="3:1:180,2:-0.37:12.5", twist_per_rev="2:1.5:90")
    design.save(tmp_path / "case.json")
    record = json.loads((tmp_path / "case.json").read_text(encoding="utf-8"))
    assert record["pitch_per_rev"] == "2:0.37:192.5,3:1:180"
    assert record["twist_per_rev"] == "2:1.5:90"
    assert load_design(tmp_path / "case.json") == design
    shaped = replace(design, active_twist=ActiveTwist((Harmonic(2, 0.02),), (0.3, 1.0)))
    assert "twist_per_rev" not in shaped.to_dict()
    assert design_from_record(shaped.to_dict()).active_twist == shaped.active_twist
    alone = design_from_record(
        {"active_twist": {"harmonics": [{"per_rev": 2, "amplitude_deg": 1}]}}
    ).active_twist
    assert alone == ActiveTwist((Harmonic(2, math.radians(1.0)),), (0.13, 1.0), (0.0, 1.0))
    with pytest.raises(ValueError, match="both"):
        design_from_record({**record, "active_twist": shaped.to_dict()["active_twist"]})


def test_on_the_command_line(
    tmp_path: Path, printed: Callable[..., str], answer: Callable[..., Any]
):
    """Flags, what is printed, JSON; over a design file a flag counts, and zero takes away."""
    flags = [
        "--mu",
        "0.2",
        "--inflow",
        "pitt-peters",
        "--pitch-per-rev",
        "3:1:180",
        "--twist-per-rev",
        "2:1.5:57",
    ]
    out = printed("solve", *flags)
    assert "root pitch 3/rev ±1.00°, phase 180°" in out
    assert "active twist 2/rev ±1.50°, phase 57°" in out
    found = answer("solve", *flags)
    assert found["pitch_per_rev"] == [{"per_rev": 3, "amplitude_deg": 1.0, "phase_deg": 180.0}]
    assert found["active_twist"]["harmonics"] == [
        {"per_rev": 2, "amplitude_deg": 1.5, "phase_deg": 57.0}
    ]
    design = make_design(
        mu=0.2, inflow="pitt-peters", pitch_per_rev="3:1:180", twist_per_rev="2:1.5:57"
    )
    assert found["power_w"]["total"] == pytest.approx(rotor.solve(design).power.total, rel=1e-9)
    design.save(tmp_path / "case.json")
    case = ("solve", "--case", str(tmp_path / "case.json"))
    assert answer(*case)["power_w"] == pytest.approx(found["power_w"], rel=SAME)
    still = answer(*case, "--pitch-per-rev", "2:0:0", "--twist-per-rev", "2:0:0")
    assert not {"pitch_per_rev", "active_twist"} & set(still)
    other = answer(*case, "--pitch-per-rev", "4:0.5:0")
    assert (other["pitch_per_rev"][0]["per_rev"], other["active_twist"]) == (
        4,
        found["active_twist"],
    )


def test_a_search_keeps_the_pitch():
    """The optimum of a blade with 2/rev pitch is trimmed with it."""
    design = make_design(mu=0.25, inflow="pitt-peters", pitch_per_rev="2:1:180")
    best = rotor.optimise(design, concept="linear")
    assert best.design.pitch_per_rev == design.pitch_per_rev
    assert_allclose(solve(best.design).require().power.total, best.best.power, rtol=1e-8)


def test_studies_vary_it():
    study = parse_study(
        '[axes]\npitch_per_rev = ["", "3:1:0", "3:1:90"]\n[fixed]\ntwist_per_rev = "2:1:0"\n'
    )
    assert study.points.count == 3

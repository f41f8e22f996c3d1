"""Physics switches: limits, hand values, the energy identity and exact derivatives for every combination."""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import TrimState, make_design, solve
from rotor.aero.inflow import INFLOW_MODELS
from rotor.aero.inflow.interface import DiskFlow, Losses
from rotor.aero.inflow.local_momentum import GAIN
from rotor.aero.losses import tip_factor
from rotor.aero.problem import LOW_MACH, build_problem
from rotor.aero.section import LOSS
from rotor.aero.switches import SWITCHES, no_effect, switched_off, with_switches
from rotor.airfoil.sections import load_installed
from rotor.design.design import BEYOND_DOCUMENT, Design
from rotor.files.design_file import design_from_record
from rotor.files.rotor_file import read_aircraft
from rotor.study.series import PARTS, waterfall, waterfall_steps
from rotor.support.assets import asset_path
from rotor.trim.power import hub_moment
from tests.rotor.at_state import elements_at, point_at
from tests.solved import assert_same_trim


def combinations(names: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Every choice of which of these are off."""
    return [
        tuple(n for n, on in zip(names, choice, strict=True) if not on)
        for choice in itertools.product((True, False), repeat=len(names))
    ]


# All 64 of the document's switches, each with another of the 256 of the effects beyond it.
BEYOND = combinations(BEYOND_DOCUMENT)
EVERY = [
    off + BEYOND[37 * k % len(BEYOND)]
    for k, off in enumerate(combinations(tuple(n for n in SWITCHES if n not in BEYOND_DOCUMENT)))
]


def small(mu: float, preset: str = "flight", inflow: str | None = None, **models: object) -> Design:
    """A coarse grid: identities and exactness do not depend on it."""
    design = make_design(preset=preset, mu=mu, twist="segments:-14,-6@0.6")
    inflow = inflow or design.models.inflow
    return replace(
        design, models=replace(design.models, elements=16, azimuths=36, inflow=inflow, **models)
    )


def name(off: tuple[str, ...]) -> str:
    return "+".join(off) or "all on"


@pytest.mark.parametrize(
    ("inflow", "combined"),
    [("lifting-line", EVERY), ("pitt-peters", EVERY), ("local-momentum", EVERY[::63])],
)
def test_energy_identity_for_every_combination(inflow: str, combined: list[tuple[str, ...]]):
    """P_shaft = Σ(λ_i dF_z + u dF_x + U dD) + D·V: torque, dissipation and trim are computed apart and must meet."""
    for off in combined:
        solution = solve(with_switches(small(0.3, inflow=inflow), off)).require()
        assert_allclose(
            solution.power.shaft, solution.power.main_rotor, rtol=2e-9, err_msg=name(off)
        )


class TestReverseFlow:
    @pytest.mark.parametrize("mu", [0.0, 0.05, 0.13])
    def test_changes_nothing_while_the_circle_is_inside_the_cut_out(self, mu: float):
        design = small(mu)
        on, off = solve(design).require(), solve(with_switches(design, ("reverse_flow",))).require()
        assert_same_trim(on, off)
        assert no_effect(design, "reverse_flow")

    def test_no_load_and_no_drag_inside_it(self):
        solution = solve(with_switches(make_design(mu=0.38), ("reverse_flow",))).require()
        inside = solution.disk.r[:, None] + 0.38 * np.sin(solution.disk.psi) < 0.0
        assert inside.sum() > 100
        assert (solution.disk.u_t[~inside] >= 0.0).all()
        for field in (solution.disk.dct, solution.disk.dcq, solution.disk.cl, solution.disk.cd):
            assert not field[inside].any()
            assert field[~inside].any()


class TestCompressibility:
    def test_sections_are_those_of_one_mach_number(self):
        solution = solve(
            with_switches(
                make_design(mu=0.35),
                ("compressibility", "swept_tip", "dynamic_stall", "stall_delay", "radial_friction"),
            )
        ).require()
        disk = solution.disk
        for radius, section in ((0.2, "sc1095"), (0.65, "sc1094r8"), (0.95, "sc1095")):
            i, installed = int(np.searchsorted(disk.r, radius)), load_installed(section)
            at = installed.table(disk.alpha[i] - installed.incidence_offset, LOW_MACH)
            assert_allclose(disk.cl[i], at.cl, rtol=1e-9, atol=1e-11)
            assert_allclose(disk.cd[i], at.cd, rtol=1e-9)
        assert not disk.cd_mach.any()
        assert disk.mach.max() > 0.85  # The Mach number itself stays what it is.

    def test_the_section_of_a_user_counts_for_compressibility(self):
        deck = asset_path("airfoils/naca0012.c81").read_text(encoding="utf-8")
        text = asset_path("r22.toml").read_text(encoding="utf-8").replace('"naca63a015"', '"mine"')
        text += '\n[sections.mine]\ndeck = "mine.c81"\n'
        craft = read_aircraft("my.toml", {"my.toml": text, "mine.c81": deck})
        assert no_effect(make_design(rotor=craft, mu=0.2), "compressibility") == ""

    def test_the_document_has_one_mach_number(self):
        design = make_design(preset="thesis", mu=0.3)
        off = solve(with_switches(design, ("compressibility",))).require()
        assert_same_trim(off, solve(design))
        assert "one Mach number" in no_effect(design, "compressibility")


class TestFlapping:
    def test_rigid_blades_have_neither_flapping_nor_cyclic(self):
        for preset in ("flight", "thesis"):
            for mu in (0.0, 0.25):
                solution = solve(with_switches(small(mu, preset), ("flapping",))).require()
                c = solution.controls
                assert mu == 0.0 or "rigid-blades" in [caveat.name for caveat in solution.caveats]
                assert (c.coning, c.flap_1c, c.flap_1s, c.cyclic_1c, c.cyclic_1s) == (0.0,) * 5

    def test_hub_moment_of_a_rigid_blade_by_hand(self):
        """C_l = aα, untwisted, uniform inflow: rolling moment ½σa·µ(θ/3 − λ/4) to the retreating side."""
        sigma, slope, mu, theta, inflow = 0.08, 5.73, 0.2, 0.12, 0.02
        design = make_design(mu=mu)
        fine = replace(design.models, elements=400, inflow="uniform")
        problem = build_problem(with_switches(replace(design, models=fine), ("flapping", "swirl")))
        e = elements_at(problem, TrimState(collective=theta, lambda0=inflow))
        lift = 0.5 * sigma * slope * (theta * e.u_t**2 - inflow * e.u_t)
        moment = hub_moment(problem, replace(e, fz=lift))
        root = design.rotor.blade.root_cutout
        by_hand = (
            0.5 * sigma * slope * mu * (theta * (1 - root**3) / 3.0 - inflow * (1 - root**2) / 4.0)
        )
        unit = design.thrust_unit * design.rotor.radius
        assert_allclose(moment.roll / unit, by_hand, rtol=1e-4)
        assert_allclose(moment.pitch / unit, 0.0, atol=1e-12)
        assert moment.roll > 0.0


class TestLossesAndFuselage:
    @pytest.mark.parametrize(("off", "end"), [("tip_loss", -1), ("hub_loss", 0)])
    def test_each_loss_acts_at_its_end_of_the_blade(self, off: str, end: int):
        state = TrimState(collective=0.17, shaft_tilt=0.08, lambda0=0.012)
        on, without = (
            point_at(
                build_problem(with_switches(small(0.2, inflow="drees"), names)), state
            ).channels[LOSS, :, 0]
            for names in ((), (off,))
        )
        assert on[end] < 0.95
        assert without[end] == pytest.approx(1.0, abs=1e-4)
        assert without[-1 - end] == pytest.approx(on[-1 - end], abs=1e-4)

    def test_local_momentum_without_tip_loss_drops_its_factor(self):
        """At one load λ_i with tip loss is λ_i without it over F (2.28): F of the mean inflow by Prandtl."""
        problem, wake, model = (
            build_problem(small(0.2)),
            DiskFlow(0.2, 0.01, 0.013),
            INFLOW_MODELS["local-momentum"],
        )
        disk = problem.disk
        terms = [model.on(disk, problem.course, Losses(tip, True)) for tip in (True, False)]
        on, off = (
            one.follow(wake, wake.mu_z, sees_tilt=True).live[GAIN, "gain"][0] for one in terms
        )
        assert_allclose(on * tip_factor(disk.r, wake.axial, 4)[0], off, rtol=1e-9)

    def test_a_lifting_line_keeps_its_tips_and_roots(self):
        design = small(0.2)
        assert no_effect(design, "tip_loss") == "included in the wake"
        assert no_effect(design, "hub_loss") == "included in the wake"
        assert_same_trim(
            *(solve(with_switches(design, names)) for names in ((), ("tip_loss", "hub_loss")))
        )

    def test_no_fuselage_no_parasite_power_and_hardly_a_tilt(self):
        on = solve(make_design(mu=0.3)).require()
        off = solve(with_switches(make_design(mu=0.3), ("fuselage",))).require()
        assert off.power.parasite == 0.0
        assert abs(off.controls.shaft_tilt) < math.radians(1.6) < on.controls.shaft_tilt
        thesis = with_switches(make_design(preset="thesis", mu=0.3), ("fuselage",))
        assert solve(thesis).require().controls.shaft_tilt == 0.0


class TestWaterfall:
    def test_steps_add_up_to_the_whole(self):
        design = small(0.3)
        found = waterfall(design)
        assert found.converged
        assert [step.switch.name for step in found.steps if step.switch] == list(SWITCHES)
        bare = solve(with_switches(design, tuple(SWITCHES))).require().power.total
        full = solve(design).require().power.total
        assert_allclose(sum(step.added or 0.0 for step in found.steps), full - bare, rtol=1e-8)
        assert found.full.design == design
        for part in PARTS:
            total = sum(step.change[part] for step in found.steps if step.change)
            ends = [getattr(found.steps[k].budget, part) for k in (0, -1)]
            assert_allclose(total, ends[1] - ends[0], rtol=1e-12, atol=1e-6)

    def test_each_alone_is_the_full_model_less_one(self):
        design = small(0.3)
        # The design's own switches do not matter.
        found = waterfall(with_switches(design, ("fuselage",)))
        for step in found.alone:
            assert [off.name for off in switched_off(step.design.models)] == [step.switch.name]
            assert step.against is found.full.budget
        by_drag = next(
            step for step in found.alone if step.switch and step.switch.name == "fuselage"
        )
        assert_allclose(by_drag.change["parasite"], -found.full.budget.parasite, rtol=1e-12)

    def test_a_step_that_does_not_trim_is_skipped(self):
        """Hovering at C_T/σ 0.169 the rotor still lifts the weight, and not the download of 3.5 % as well."""
        design = small(0.0)
        mass = design.condition.mass * 0.169 * design.rotor.solidity / design.weight_coefficient
        design = replace(design, condition=replace(design.condition, mass=mass))
        steps = list(waterfall_steps(design, ("download", "tip_loss")))[:3]
        assert [step.power is not None for step in steps] == [True, False, False]
        assert steps[1].change is None
        assert steps[2].against is steps[0].budget

    def test_command(self, printed: Callable[..., str], answer: Callable[..., Any]):
        first, *steps = answer("waterfall", "--mu", "0.3")["steps"]
        assert [first["switch"], *(step["switch"] for step in steps)] == [
            None,
            *(s.flag for s in SWITCHES.values()),
        ]
        added = sum(sum(step["change_w"].values()) for step in steps)
        assert_allclose(added, steps[-1]["total_w"] - first["total_w"], rtol=1e-12)
        assert "-0.0" not in printed("waterfall", "--mu", "0", "--preset", "thesis")


def test_files_keep_every_switch_and_old_files_are_read():
    for off in EVERY[::7]:
        design = with_switches(make_design(mu=0.2), off)
        assert design_from_record(design.to_dict()).models == design.models
    assert (
        switched_off(design_from_record({"tip_loss": False, "hub_loss": True}).models)[0].name
        == "tip_loss"
    )

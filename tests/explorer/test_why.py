"""The sentence that says why power changed, on cases whose cause is known."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.model.units import AVIATION
from explorer.text.why import lift_centroid, lift_movement, why
from rotor.aero.switches import with_switches
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


@cache
def solved(design: Design) -> Solution:
    return solve(design)


def flown(
    mu: float = 0.2, twist: str | None = None, mass: float | None = None, altitude: float = 0.0,
    inflow: str | None = None,
) -> Solution:  # fmt: skip
    return solved(make_design(mu=mu, twist=twist, mass_kg=mass, altitude_m=altitude, inflow=inflow))


def without(solution: Solution, switch: str) -> Solution:
    return solved(with_switches(solution.design, [switch]))


def lifting(solution: Solution, dct: np.ndarray) -> Solution:
    return replace(solution, disk=replace(solution.disk, dct=np.broadcast_to(dct, solution.disk.dct.shape)))


class TestWhereTheLiftIs:
    def test_uniform_loading_along_the_blade_has_its_centroid_at_mid_blade(self):
        solution = flown(inflow="drees")
        centroid = lift_centroid(lifting(solution, np.ones(())))
        cutout = solution.design.rotor.blade.root_cutout
        assert_allclose(centroid.radial, 0.5 * (cutout + 1.0), atol=1e-12)
        assert_allclose((centroid.lateral, centroid.longitudinal), 0.0, atol=1e-12)

    def test_loading_with_one_plus_sin_psi_is_half_way_to_the_advancing_side(self):
        solution = flown()
        centroid = lift_centroid(lifting(solution, 1.0 + np.sin(solution.disk.psi)))
        assert_allclose((centroid.lateral, centroid.longitudinal), (0.5, 0.0), atol=1e-12)

    def test_a_rotor_without_lift_is_refused(self):
        with pytest.raises(ValueError, match="no lift"):
            lift_centroid(lifting(flown(), np.zeros(())))

    def test_movements_below_the_threshold_are_not_given_a_direction(self):
        solution = flown()
        even = lifting(solution, np.ones(()))
        tilted = lifting(solution, (1.0 + 1e-5 * solution.disk.r)[:, None])
        assert lift_movement(even, tilted) == "Lift hardly moved"
        assert lift_movement(even, lifting(solution, solution.disk.r[:, None])) == "Lift moved outboard"
        swayed = lifting(solution, 1.0 - 0.2 * np.sin(solution.disk.psi))
        assert lift_movement(even, swayed) == "Lift moved towards the retreating side"


class TestKnownCauses:
    def test_twist_in_hover_moves_lift_inboard_and_saves_induced_power(self):
        before, after = flown(0.0, "linear:0"), flown(0.0, "linear:-8")
        saved = 1e-3 * (before.power.induced - after.power.induced)
        assert why(before, after).startswith(f"Lift moved inboard: induced −{saved:.0f}, tail rotor −")
        assert why(after, before).startswith(f"Lift moved outboard: induced +{saved:.0f}, ")

    def test_twist_beyond_the_optimum_in_hover_costs_induced_power_although_lift_moves_inboard(self):
        assert why(flown(0.0, "linear:-20"), flown(0.0, "linear:-28")).startswith("Lift moved inboard: induced +")

    def test_twist_at_high_speed_relieves_the_advancing_tip(self):
        sentence = why(flown(0.35, "segments:-17.4,-4@0.5"), flown(0.35, "segments:-17.4,-16.6@0.5"))
        assert sentence.startswith("Lift moved inboard and towards the advancing side: induced −")
        assert "drag divergence shrank" in sentence

    def test_more_mass_costs_induced_power(self):
        assert why(flown(mass=8000.0), flown(mass=9000.0)).startswith("12 % more weight: induced +")
        assert why(flown(mass=9000.0), flown(mass=8000.0)).startswith("11 % less weight: induced −")

    def test_speed_costs_parasite_power_and_saves_induced_power(self):
        sentence = why(flown(0.2), flown(0.3))
        assert sentence.startswith("Faster (µ 0.3): parasite +")
        assert why(flown(0.1), flown(0.15)).startswith("Faster (µ 0.15): induced −")
        assert why(flown(0.1), flown(0.0)).startswith("Hover: induced +")

    def test_the_advancing_tip_passes_drag_divergence_with_speed(self):
        assert "drag divergence grew near the tip on the advancing side" in why(flown(0.25), flown(0.3))
        assert "drag divergence appeared near the tip on the advancing side" in why(flown(0.2), flown(0.3))
        assert "drag divergence shrank" in why(flown(0.3), flown(0.25))

    def test_load_and_speed_stall_the_retreating_side(self):
        assert re.search(r"; (negative )?stall grew .*on the retreating side", why(flown(mass=8e3), flown(mass=9e3)))
        assert re.search(r"stall grew .*on the retreating side", why(flown(0.3, mass=9.8e3), flown(0.42, mass=9.8e3)))
        assert "stall appeared inboard on the retreating side" in why(flown(0.0), flown(0.15))

    def test_thin_air_costs_induced_power_and_saves_drag(self):
        sentence = why(flown(), flown(altitude=2000.0))
        assert sentence.startswith("Thinner air (−18 %): induced +")
        assert "parasite −" in sentence
        assert why(flown(altitude=2000.0), flown()).startswith("Denser air (+22 %): induced −")

    def test_without_tip_loss_the_induced_power_falls(self):
        sectors = flown(inflow="local-momentum")
        assert why(sectors, without(sectors, "tip_loss")).startswith("Without tip loss: induced −")
        assert why(without(sectors, "tip_loss"), sectors).startswith("With tip loss: induced +")
        assert why(flown(), without(flown(), "tip_loss")).endswith(
            "no change in power (tip loss is part of this wake)."
        )

    def test_without_compressibility_drag_divergence_disappears(self):
        assert why(flown(0.37), without(flown(0.37), "compressibility")).endswith("drag divergence disappeared.")

    def test_another_inflow_model_or_rotor_is_named(self):
        flight = flown()
        uniform = solved(replace(flight.design, models=replace(flight.design.models, inflow="uniform")))
        assert why(flight, uniform).startswith("Uniform")
        assert " instead of Lifting line" in why(flight, uniform)
        hover = flown(0.0)
        closed = solved(replace(hover.design, models=replace(hover.design.models, hover_inflow="closed-form")))
        assert why(hover, closed).startswith("Closed form instead of annulus balance in hover: ")
        slow = flown(0.05)
        wake = solved(replace(slow.design, models=replace(slow.design.models, low_speed="wake")))
        assert why(slow, wake).startswith("Without passage to hover at low speed: ")
        coarse = solved(replace(hover.design, models=replace(hover.design.models, elements=20)))
        assert why(hover, coarse).startswith("Another model: ")
        other = solved(make_design(rotor="s61"))
        assert why(flight, other).startswith(f"{other.design.aircraft.name} instead of UH-60A: ")

    def test_several_changes_are_not_put_down_to_one(self):
        assert why(flown(), flown(0.25, "linear:-5", 9000.0)).startswith("Several changes at once: ")
        assert why(flown(), flown(0.2, "linear:-5", 9000.0)).startswith("8.1 % more weight and a new twist: ")


class TestNoEffect:
    def test_the_same_design(self):
        assert why(flown(), flown()) == "Nothing has changed."

    def test_a_switch_without_effect_says_why(self):
        sentence = why(flown(), without(flown(), "hub_loss"))
        assert sentence.startswith("Without hub loss: no change in power (")
        assert why(flown(0.0), without(flown(0.0), "fuselage")).startswith("Without fuselage drag: no change in power")

    def test_a_twist_too_small_to_matter(self):
        sentence = why(flown(twist="linear:-8"), flown(twist="linear:-8.001"))
        assert sentence == "Lift hardly moved: no change in power."


class TestWithoutTrim:
    def test_a_design_without_trim_gives_the_first_sentence_of_its_message(self):
        lost = flown(0.45, mass=14_000.0)
        assert not lost.converged
        sentence = why(flown(), lost)
        assert sentence.endswith("beyond this rotor.")
        assert sentence.count(". ") == 0
        assert lost.message.startswith(sentence[:-1])

    def test_nothing_to_compare_with(self):
        assert "no trim" in why(flown(0.45, mass=14_000.0), flown())


class TestNumbers:
    @pytest.mark.parametrize("mu", [0.1, 0.3])
    def test_parts_come_in_order_of_size_and_are_those_of_the_solutions(self, mu: float):
        before, after = flown(mu), flown(mu, "linear:-4", 9500.0)
        named = re.findall(r"(induced|profile|parasite|tail rotor) ([+−][\d\u2009.]+)", why(before, after))
        sizes = [float(value.replace("−", "-").replace("\u2009", "")) for _, value in named]
        assert sizes == sorted(sizes, key=abs, reverse=True)
        for (name, _), size in zip(named, sizes, strict=True):
            field = "tail" if name == "tail rotor" else name
            change = 1e-3 * (getattr(after.power, field) - getattr(before.power, field))
            assert_allclose(size, change, atol=0.51)

    def test_the_unit_stands_once_behind_the_last_part(self):
        sentence = why(flown(0.3), flown(0.3, "linear:-4", 9500.0))
        assert re.search(r": induced [+−]\d+(, [a-z ]+ [+−]\d+)+ kW[.;]", sentence)
        assert sentence.count("kW") == 1

    def test_aviation_units(self):
        assert " hp" in why(flown(0.2), flown(0.3), AVIATION)
        assert "kW" not in why(flown(0.2), flown(0.3), AVIATION)

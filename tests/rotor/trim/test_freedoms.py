"""Further degrees of freedom of the blade through `rotor.solve`: a rigid blade that lags about its flap hinge."""

import json
import math
import pickle
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotor
from rotor.aero.problem import Problem
from rotor.aero.section import FX, FZ, TH, UR, UT
from rotor.engine.linearise import evaluate, jacobian
from rotor.engine.terms import Addend, Structure
from rotor.engine.waves import COS, SIN, rate_of, times_wave
from rotor.trim.analysis import Analysis, power_gradient

FLAP, LAG = ("coning", "flap_1c", "flap_1s"), ("lag_0", "lag_1c", "lag_1s")


@dataclass(frozen=True)
class RigidLag(rotor.Freedom):
    """δ'' + c δ' + (ν² − 1) δ + 2ββ' = Γ Σ (r − e) F_x, δ aft about the flap hinge; flapping gets −2βδ'."""

    damping: float = 0.0
    states = LAG

    def numbers(self, problem: Problem) -> dict[Any, float]:
        flap = problem.flap
        inertia, stiffness = 1.0 / flap.load_gain, flap.frequency_squared - 1.0
        return {
            "lag gain": flap.load_gain, "lag stiffness": stiffness, "lag hinge": flap.hinge, "lag inertia": inertia,
            "lag damping": self.damping, "lag damper": self.damping * inertia,
        }  # fmt: skip

    def build(self, s: Structure) -> None:
        n, z, mu_x = s.numbers, s.states, s.derived["mu_x"]
        lag, flap = [s.equation(name) for name in LAG], [s.equations[name] for name in FLAP]
        for h, name in enumerate(LAG):
            rate, factor = rate_of(h)
            s.column(UT, "arm", rate, -factor, z[name])
            s.column(UT, "one", h, -1.0, z[name], mu_x, times=COS)
            s.column(UR, "one", h, 1.0, z[name], mu_x, times=SIN)
            s.column(UR, "one", h, 1.0, z[name], n["lag hinge"])
            s.term(lag[h], 2.0 if h else 1.0, n["lag gain"], q=s.measure(FX, "arm", h))
            s.term(lag[h], -1.0, n["lag stiffness"], z[name])
            s.term(lag[h], factor**2, z[name])
            s.term(lag[rate], -factor, n["lag damping"], z[name])
            for k, other in enumerate(FLAP):
                for wave, share in times_wave(k, rate):
                    if wave < len(LAG):
                        s.term(lag[wave], -2.0 * share * factor, z[other], z[FLAP[h]])
                        s.term(
                            flap[wave],
                            2.0 * share * factor,
                            z[other],
                            z[name],
                            number=n["lag inertia"],
                        )

    def power(self, s: Structure) -> list[Addend]:
        return [
            (0.5, s.states[name], s.states[name], 0, s.numbers["lag damper"]) for name in LAG[1:]
        ]


def flapping(inflow: str, **given: Any) -> rotor.Design:
    """At µ = 0.25 with flapping of some degrees, without which there are no Coriolis forces."""
    design = rotor.make_design(mu=0.25, inflow=inflow, **given)
    return replace(
        design,
        condition=replace(design.condition, flap_1c=math.radians(-4.0), flap_1s=math.radians(2.0)),
    )


def lagging(design: rotor.Design, damping: float = 0.3) -> rotor.Solution:
    return rotor.solve(design, freedoms=[RigidLag(damping)]).require()


@pytest.mark.parametrize("inflow", ["pitt-peters", "local-momentum", "lifting-line"])
@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_the_energy_closes(inflow: str, damping: float) -> None:
    """Shaft power is induced, profile and parasite power and what the damper takes, c/Γ of the mean of δ'²."""
    solution = lagging(flapping(inflow), damping)
    power, states = solution.power, solution.freedom_states
    assert_allclose(power.shaft, power.main_rotor, rtol=1e-10)
    rate = 0.5 * (states["lag_1c"] ** 2 + states["lag_1s"] ** 2)
    gain = Analysis(solution).linear.problem.flap.load_gain
    assert_allclose(power.damping, damping / gain * rate * solution.design.power_unit, rtol=1e-12)
    assert (power.damping > 100.0) == (damping > 0.0)


def test_steady_lag_by_hand() -> None:
    """The centrifugal force of the blade, at the arm e δ, balances the drag's moment about the hinge; Coriolis none."""
    solution = lagging(flapping("pitt-peters", off="elastic-twist", azimuths=48))
    design, disk, blade = solution.design, solution.disk, solution.design.rotor.blade
    radius, hinge = design.rotor.radius, blade.flap_hinge
    about_hinge = (
        float(((disk.r - hinge) * disk.dr) @ disk.dcq.mean(axis=1)) * design.thrust_unit * radius
    )
    centrifugal = blade.flap_static_moment * design.rotor.angular_speed**2
    expected = about_hinge / design.rotor.blades / (centrifugal * hinge * radius)
    assert_allclose(solution.freedom_states["lag_0"], expected, rtol=1e-8)
    assert 3.0 < math.degrees(expected) < 9.0


def test_the_first_harmonic_is_that_of_an_oscillator() -> None:
    """Driven by the drag's moment and Coriolis forces: the complex amplitude of δ'' + cδ' + (ν² − 1)δ = f."""
    solution = lagging(flapping("pitt-peters"))
    problem, point = Analysis(solution).linear.problem, Analysis(solution).linear.point
    psi, c, states = problem.disk.psi, solution.controls, solution.freedom_states
    beta = c.coning + c.flap_1c * np.cos(psi) + c.flap_1s * np.sin(psi)
    rate = -c.flap_1c * np.sin(psi) + c.flap_1s * np.cos(psi)
    driving = (
        problem.flap.load_gain * (problem.arm * problem.disk.dr @ point.forces[FX])
        - 2.0 * beta * rate
    )
    amplitude = (
        2.0 * np.mean(driving * np.exp(-1j * psi)) / (problem.flap.frequency_squared - 2.0 + 0.3j)
    )
    assert_allclose(states["lag_1c"] - 1j * states["lag_1s"], amplitude, rtol=1e-8)


def test_the_gradient_of_power_follows_the_lag() -> None:
    """Against differences, which see that section data bend from one table cell to the next."""
    design = rotor.make_design(mu=0.25, inflow="pitt-peters", twist="linear:-10")
    found = power_gradient(lagging(design)).along(_rate(design)[None])[0]
    step = 0.005
    ahead, behind = (
        lagging(design.with_twist(f"linear:{-10 + sign * step}")).power.total
        for sign in (1.0, -1.0)
    )
    assert_allclose(found, (ahead - behind) / (2.0 * math.radians(step)), rtol=5e-4)


def _rate(design: rotor.Design) -> Any:
    """∂θ_tw/∂(rate) at the elements."""
    return rotor.solve(design).disk.r - 0.75


def test_a_solution_from_another_process_has_the_same_gradient() -> None:
    solution = lagging(rotor.make_design(mu=0.25, inflow="pitt-peters"))
    sent = pickle.loads(pickle.dumps(replace(solution, freedoms=())))
    again = power_gradient(replace(sent, freedoms=solution.freedoms))
    assert_allclose(again.by_element, power_gradient(solution).by_element, rtol=1e-6, atol=1.0)


@dataclass(frozen=True)
class Spring(rotor.Freedom):
    """A rigid twist of the whole blade against two springs, whose numbers may stand in either order."""

    swapped: bool = False
    states = ("spring",)

    def numbers(self, problem: Problem) -> dict[Any, float]:
        del problem
        both = [("stiff", 0.1), ("load", 0.002)]
        return dict(reversed(both)) if self.swapped else dict(both)

    def build(self, s: Structure) -> None:
        row = s.equation("spring")
        s.column(TH, "one", 0, 1.0, s.states["spring"])
        s.term(row, 1.0, s.numbers["stiff"], s.states["spring"])
        s.term(row, -1.0, s.numbers["load"])


def test_the_order_of_numbers_is_part_of_the_key() -> None:
    design = rotor.make_design(mu=0.2, inflow="pitt-peters")
    for swapped in (False, True, False):
        assert_allclose(
            rotor.solve(design, freedoms=[Spring(swapped)]).freedom_states["spring"],
            0.02,
            rtol=1e-9,
        )


def test_two_classes_of_one_name_are_two_freedoms() -> None:
    """As when a cell of a notebook is run again after an edit."""

    def made(sign: float) -> rotor.Freedom:
        class Spring(rotor.Freedom):
            states = ("spring",)

            def numbers(self, problem: Problem) -> dict[Any, float]:
                del problem
                return {}

            def build(self, s: Structure) -> None:
                row = s.equation("spring")
                s.column(TH, "one", 0, 1.0, s.states["spring"])
                s.term(row, 1.0, s.states["spring"])
                s.term(row, -0.01 * sign)

        return Spring()

    design = rotor.make_design(mu=0.2, inflow="pitt-peters")
    found = [
        rotor.solve(design, freedoms=[made(sign)]).freedom_states["spring"] for sign in (1.0, -1.0)
    ]
    assert_allclose(found, (0.01, -0.01))


class TestRefused:
    """One sentence each, with the name and the remedy."""

    design = rotor.make_design(mu=0.2, inflow="pitt-peters")

    def refused(
        self, kind: type[Exception], match: str, *freedoms: Any, design: rotor.Design | None = None
    ) -> None:
        with pytest.raises(kind, match=match):
            rotor.solve(design or self.design, freedoms=freedoms)

    def test_where_there_are_none(self) -> None:
        self.refused(
            ValueError,
            "Hover is solved at one azimuth",
            RigidLag(),
            design=rotor.make_design(hover=True),
        )
        self.refused(
            ValueError,
            "Bending blades already flap",
            RigidLag(),
            design=rotor.make_design(mu=0.2, bending=True),
        )

    def test_equations_that_do_not_belong_to_the_columns(self) -> None:
        class NoDamper(RigidLag):
            def power(self, s: Structure) -> list[Addend]:
                return []

        self.refused(ValueError, "kW", NoDamper(0.3))

    def test_too_few_equations(self) -> None:
        class TwoStates(Spring):
            states = ("spring", "another")

        self.refused(ValueError, "equations", TwoStates())


def test_the_record(tmp_path: Any) -> None:
    """Numbers only; without freedoms as before; no design file."""
    solution = lagging(rotor.make_design(mu=0.25, inflow="pitt-peters"))
    record = json.loads(json.dumps(rotor.solution_record(solution), allow_nan=False))
    assert record["freedoms"] == solution.freedom_states
    assert_allclose(record["power_w"]["damping"], solution.power.damping)
    assert "damping" in repr(solution)
    assert "freedoms" not in rotor.solution_record(rotor.solve(solution.design))
    with pytest.raises(ValueError, match="freedoms"):
        rotor.save_solution(solution, tmp_path / "lag.json")


# The worked example of docs/developers/freedom.md


PAGE = Path(__file__).parents[3] / "docs" / "developers" / "freedom.md"
CODE = re.search(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


def test_the_worked_example_flaps_as_its_loads_say_and_its_jacobian_is_exact():
    assert len(CODE.group(1).splitlines()) <= 40
    names: dict[str, Any] = {}
    exec(compile(CODE.group(1), PAGE.name, "exec"), names)
    linear = Analysis(names["solution"].require()).linear
    point, problem, system = linear.point, linear.problem, linear.point.system
    assert point.size <= 1.0
    assert names["beta_2c"] == point.x[system.structure.states["flap_2c"]]
    power = names["solution"].power
    assert_allclose(power.shaft, power.main_rotor, rtol=1e-9)
    disk, states = problem.disk, system.structure.states
    moment = problem.arm * disk.dr @ point.forces[FZ]
    for name, wave in (("flap_2c", np.cos), ("flap_2s", np.sin)):
        driven = 2.0 * problem.flap.load_gain * float((moment * wave(2.0 * disk.psi)).mean())
        beta = point.x[states[name]]
        assert_allclose(beta, driven / (problem.flap.frequency_squared - 4.0), rtol=1e-7)
        assert 1e-4 < abs(beta) < 0.05
    exact = jacobian(evaluate(system, system.grid, point.x, slopes=True))[0][
        :, system.structure.states_of("flap_2s")[0]
    ]
    step = np.zeros_like(point.x)
    step[states["flap_2s"]] = 1e-6  # A longer one reaches a knot of the section data.
    ahead, behind = (
        evaluate(system, system.grid, point.x + sign * step).residual for sign in (1.0, -1.0)
    )
    assert_allclose(exact, (ahead - behind) / 2e-6, atol=1e-6 * np.abs(exact).max())

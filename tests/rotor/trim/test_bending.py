"""Trims of a blade that bends: identities, hub loads from two sides, gradient, time marching, convergence."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from patched import Patch

import rotor
from rotor import Design, Solution
from rotor.aero.bending import BladeBending
from rotor.aero.bent_section import SV, SW
from rotor.aero.problem import Problem
from rotor.aero.section import FR, FX, FZ, RATE, TH, UP, UR, UT, M
from rotor.columns.bending import coordinates_of
from rotor.engine.linearise import Point, evaluate
from rotor.engine.waves import wave_grid, waves_at
from rotor.support.arrays import Array
from rotor.support.units import GRAVITY
from rotor.trim import Analysis, SolverOptions, power_gradient, why_no_hub_loads
from rotor.trim.hub_loads import HubLoads, hub_loads, index_along
from tests.rotor.root_loads import displacements, root_loads

LINEAR, LINE = "pitt-peters", "lifting-line"
PROBLEM = "rotor.aero.problem"
"""It says where the series of an elastic blade end."""
Span = tuple[float, float]


def _design(mu: float, inflow: str, *, twist: str | None = None, twist_per_rev: str = "") -> Design:
    return rotor.make_design(
        mu=mu, inflow=inflow, twist=twist, twist_per_rev=twist_per_rev, bending=True
    )


@cache
def _solved(mu: float, inflow: str) -> Solution:
    return rotor.solve(_design(mu, inflow)).require()


def _at(solution: Solution) -> tuple[Problem, Point, BladeBending]:
    adjoint = Analysis(solution).adjoint
    assert adjoint.problem.bending is not None
    return adjoint.problem, adjoint.point, adjoint.problem.bending


def _loads(solution: Solution) -> HubLoads:
    found = hub_loads(solution, band=False)
    assert found is not None
    return found


@pytest.mark.parametrize("inflow", [LINEAR, LINE])
def test_energy(inflow: str) -> None:
    """Shaft power less its parts is exactly the work of the air on bending; nearly all of it ends in the lag damper."""
    solution = _solved(0.3, inflow)
    _, point, b = _at(solution)
    watts = solution.design.power_unit
    work = float(point.system.structure.sums["motion"].value(point.z, point.q)[0])
    left = solution.power.shaft - solution.power.main_rotor
    assert_allclose(work * watts, left, atol=1e-9 * solution.power.shaft)
    q, _ = coordinates_of(b, point.system.structure, point.z)
    rates = [
        n * n * (q[:, one] @ b.damping @ q[:, one])
        for n in range(1, 9)
        for one in (2 * n - 1, 2 * n)
    ]
    assert_allclose(left, 0.5 * sum(rates) * watts, atol=1e-4 * solution.power.shaft)


@pytest.mark.parametrize("inflow", [LINEAR, LINE])
@pytest.mark.parametrize("mu", [0.15, 0.3, 0.37])
def test_hub_torque_is_that_of_the_shaft(mu: float, inflow: str) -> None:
    """Forces of the blade times the place of its hinge: the torque that the air loads have about the shaft."""
    solution = _solved(mu, inflow)
    problem, point, b = _at(solution)
    force, _ = root_loads(problem, point)
    _, offset = coordinates_of(b, point.system.structure, point.z)
    torque = -force[1].mean() * b.r[0] + force[0].mean() * offset
    torque *= problem.design.rotor.blades * problem.design.rotor.radius
    assert_allclose(torque, solution.torque, rtol=1e-3)


def test_the_section_sees_the_slopes_and_places_of_the_displaced_blade() -> None:
    """On a blade with precone: w', v' and the in-plane place of the axis against the displacements, differentiated."""
    design = rotor.make_design(rotor="hart2", mu=0.2, inflow=LINEAR)
    solution = rotor.solve(replace(design, models=replace(design.models, bending=True))).require()
    problem, point, b = _at(solution)
    assert b.precone > 0.04
    q, offset = coordinates_of(b, point.system.structure, point.z)
    _, v, w = displacements(b, q, offset, len(problem.disk.psi))
    outboard = problem.disk.r > b.r[0] + 0.05
    for channel, place in ((SW, w), (SV, v)):
        expected = np.gradient(place, b.r, axis=0)
        at = np.stack([np.interp(problem.disk.r, b.r, one) for one in expected.T], axis=1)
        assert_allclose(point.channels[channel][outboard], at[outboard], atol=2e-3)
    # The shaft turns what lies beside the radius outward or inward.
    at = 0.2 * np.cos(problem.disk.psi) + np.stack(
        [np.interp(problem.disk.r, b.r, one) for one in v.T], axis=1
    )
    assert_allclose(point.channels[UR][outboard], at[outboard], atol=1e-5)


def test_the_tip_mass_couples_twist_and_bending_both_ways_alike() -> None:
    """Reciprocity: the load of twist does the same work on bending as the load of bending does on twist."""
    problem, point, b = _at(_solved(0.3, LINEAR))
    s, torsion = point.system.structure, problem.torsion
    x, n = point.x.copy(), s.numbers
    x[
        [
            atom
            for name, atom in n.items()
            if isinstance(name, tuple) and str(name[0]).startswith("tip on")
        ]
    ] = 0.0
    load = point.residual - evaluate(point.system, point.grid, x).residual
    q, _ = coordinates_of(b, s, point.z)
    places = [(k, h) for k in range(len(q)) for h in range(q.shape[1]) if (k, h) != (b.lag, 0)]
    on_bending = sum(
        q[k, h]
        * load[s.equations["bend", k, h]]
        * (2.0 if h else 1.0)
        / point.z[n["bend gain", k, (h + 1) // 2]]
        for k, h in places
    )
    on_twist = sum(
        point.z[s.states["twist", j, h]] * load[s.equations["twist", j, h]] / torsion.gain[j]
        for j in range(len(torsion.gain)) for h in range(q.shape[1])
    )  # fmt: skip
    assert abs(on_twist) > 1e-9
    assert_allclose(on_bending, on_twist, rtol=1e-9)


def test_mean_force_is_thrust_less_weight() -> None:
    solution = _solved(0.3, LINEAR)
    problem, point, b = _at(solution)
    design, rotor_ = problem.design, problem.design.rotor
    mass = b.strips.sum() * b.force / (rotor_.radius * rotor_.angular_speed**2)
    expected = solution.ct * design.thrust_unit / rotor_.blades - mass * GRAVITY
    assert_allclose(root_loads(problem, point)[0][2].mean(), expected, rtol=1e-9)


def test_inertia_is_the_second_derivative_of_the_centre_of_mass() -> None:
    """In axes that do not turn: air loads and weight less the force on the hub."""
    problem, point, b = _at(_solved(0.3, LINEAR))
    force, psi = root_loads(problem, point)[0] / b.force, problem.disk.psi
    air = np.einsum(
        "i,kij->kj",
        problem.disk.dr,
        np.stack([point.forces[FR], -point.forces[FX], point.forces[FZ]]),
    )
    u, v, w = displacements(b, *coordinates_of(b, point.system.structure, point.z), len(psi))
    x, y = b.r[:, None] + u, v
    centre = (
        b.strips @ (x * np.cos(psi) - y * np.sin(psi)),
        b.strips @ (x * np.sin(psi) + y * np.cos(psi)),
        b.strips @ w,
    )
    gravity = (
        GRAVITY
        / (problem.design.rotor.radius * problem.design.rotor.angular_speed**2)
        * b.strips.sum()
    )
    left = air - force
    fixed = (
        left[0] * np.cos(psi) - left[1] * np.sin(psi),
        left[0] * np.sin(psi) + left[1] * np.cos(psi),
        left[2] - gravity,
    )
    for found, place in zip(fixed, centre, strict=True):
        waves = np.fft.rfft(place)
        expected = np.fft.irfft(-(np.arange(len(waves)) ** 2) * waves, len(psi))
        assert_allclose(found, expected, atol=1e-9 * float(np.abs(left).max()))


@pytest.mark.parametrize("inflow", [LINEAR, LINE])
def test_hub_loads_are_the_root_loads_of_all_blades(inflow: str) -> None:
    """Vertical force and moments exactly; in the plane the radial shortening is summed over elements here: 2 %."""
    solution = _solved(0.3, inflow)
    problem, point, b = _at(solution)
    loads, psi, blades = _loads(solution), problem.disk.psi, problem.design.rotor.blades
    radial, forward, up = root_loads(problem, point)[0]
    radius, (_, offset) = (
        problem.design.rotor.radius,
        coordinates_of(b, point.system.structure, point.z),
    )
    hinge, beside = b.r[0] * radius * up, offset * radius * up
    fixed = {
        "fx": radial * np.cos(psi) - forward * np.sin(psi), "fy": radial * np.sin(psi) + forward * np.cos(psi),
        "fz": up, "mx": hinge * np.sin(psi) + beside * np.cos(psi), "my": -hinge * np.cos(psi) + beside * np.sin(psi),
    }  # fmt: skip
    for name, of_one in fixed.items():
        wave = 2.0 * blades * (of_one * np.exp(1j * blades * psi)).mean()
        expected = loads.amplitudes[name] * np.exp(1j * loads.phases[name])
        exact = name in ("fz", "mx", "my")
        assert_allclose(wave, expected, rtol=1e-9 if exact else 0.03)


def _sprung(inflow: str) -> Solution:
    """The UH-60A with springs at its hinges: in flap 400 kN m/rad that rests at 3°, in lag 300 kN m/rad."""
    design = _design(0.3, inflow)
    blade = design.rotor.blade
    assert blade.structure is not None
    structure = replace(blade.structure, lag_spring=3e5)
    blade = replace(blade, structure=structure, flap_spring=4e5, flap_rest=math.radians(3.0))
    return rotor.solve(replace(design, rotor=replace(design.rotor, blade=blade))).require()


@pytest.mark.parametrize("inflow", [LINEAR, LINE])
def test_springs_at_the_hinges(inflow: str) -> None:
    """Forces times their distance from the hinge, which know nothing of springs, against K times its angle.

    At 0 to 2/rev within 7 % of the largest in flap and 16 % in lag: modes in series with a hinge's spring converge
    slowly, and more of them meet the forces. The work of the air on bending is still all that the shaft gives beside
    the power. The hub gets the springs' moments: at 4/rev within 20 %, for with the modes angles at the hinge converge
    slower than forces, of which the hub's are made.
    """
    solution = _sprung(inflow)
    problem, point, b = _at(solution)
    psi, radius = problem.disk.psi, problem.design.rotor.radius
    (force, (flap, lag)), (q, offset) = (
        root_loads(problem, point),
        coordinates_of(b, point.system.structure, point.z),
    )
    waves, order = wave_grid(q.shape[1], len(psi)).at, np.arange(len(psi) // 2 + 1)
    up, forward = (b.along[which][:, 0] @ q @ waves for which in (1, 4))
    rate = (
        np.fft.irfft(1j * order * np.fft.rfft(forward), len(psi))
        * problem.design.rotor.angular_speed
    )
    up += b.precone * (1.0 - b.along[1, b.first, 0])  # The cone in the place of the first mode's.
    forward -= b.precone * b.along[4, b.first, 0]
    held = 4e5 * (up - math.radians(3.0)), 3e5 * (forward - offset / b.r[0]) + 6000.0 * rate
    for found, expected, near in zip((flap, lag), held, (0.07, 0.16), strict=True):
        ours, theirs = (np.fft.rfft(own)[:3] / len(psi) for own in (found, expected))
        assert_allclose(ours, theirs, atol=near * float(np.abs(theirs).max()))
    _, free = coordinates_of(
        _at(_solved(0.3, inflow))[2], point.system.structure, _at(_solved(0.3, inflow))[1].z
    )
    assert 0.2 * free < offset < 0.5 * free  # Less lag; in series with it the blade bends in lag.
    left = solution.power.shaft - solution.power.main_rotor
    work = float(point.system.structure.sums["motion"].value(point.z, point.q)[0])
    assert_allclose(work * solution.design.power_unit, left, atol=1e-9 * solution.power.shaft)
    loads, blades = _loads(solution), problem.design.rotor.blades
    about, beside = b.r[0] * radius * force[2] + held[0], offset * radius * force[2]
    fixed = {
        "mx": about * np.sin(psi) + beside * np.cos(psi),
        "my": -about * np.cos(psi) + beside * np.sin(psi),
    }
    for name, of_one in fixed.items():
        wave = 2.0 * blades * (of_one * np.exp(1j * blades * psi)).mean()
        expected = loads.amplitudes[name] * np.exp(1j * loads.phases[name])
        assert_allclose(wave, expected, atol=0.2 * abs(expected))


@pytest.mark.slow
def test_the_lag_springs_moment_meets_the_forces_with_more_modes(patch: Patch) -> None:
    """Mean in lag, by the spring against the forces: 17 % apart with 4 and 3 modes, less than half with 8 and 8."""
    gaps = list[float]()
    for modes in ((4, 3), (8, 8)):
        patch(f"{PROBLEM}.MODES", modes)
        problem, point, b = _at(_sprung(LINEAR))
        q, offset = coordinates_of(b, point.system.structure, point.z)
        angle = (
            float(b.along[4][:, 0] @ q[:, 0])
            - b.precone * float(b.along[4, b.first, 0])
            - offset / float(b.r[0])
        )
        by_forces = float(root_loads(problem, point)[1][1].mean())
        gaps.append(abs(3e5 * angle / by_forces - 1.0))
    assert 0.1 < gaps[0] < 0.2
    assert gaps[1] < 0.5 * gaps[0]


def test_a_hingeless_root_with_a_spring_in_lag() -> None:
    """Held in flap and sprung in lag: lag slower, flap as before; a stiff spring gives the trim of a held root.

    The forces' mean moment in lag is the spring's, −32.7 and −31.1 N m: lever arms of the one are those of the bent
    blade. Modes of a twisted blade move it in flap and lag, so the cone is in the place of the first in both.
    """
    design = rotor.make_design(rotor="hart2", mu=0.2, inflow=LINEAR, bending=True)
    blade, found = design.rotor.blade, list[Solution]()
    structure = blade.structure
    assert structure is not None
    for spring in (None, 1e9, 2e3):
        other = replace(blade, structure=replace(structure, lag_spring=spring))
        found.append(
            rotor.solve(replace(design, rotor=replace(design.rotor, blade=other))).require()
        )
    held, stiff, soft = found
    assert_allclose(stiff.power.main_rotor, held.power.main_rotor, rtol=1e-6)
    assert_allclose(soft.blade_frequencies.flap[0], held.blade_frequencies.flap[0], rtol=0.02)
    assert soft.blade_frequencies.lag[0] < 0.97 * held.blade_frequencies.lag[0]
    problem, point, b = _at(soft)
    q, _ = coordinates_of(b, point.system.structure, point.z)
    slope = float(b.along[4][:, 0] @ q[:, 0]) - b.precone * float(b.along[4, b.first, 0])
    mean = float(root_loads(problem, point)[1][1].mean())
    assert abs(slope) > 1e-3
    assert_allclose(mean, 2e3 * slope, rtol=0.08)


@pytest.mark.parametrize("inflow", [LINEAR, LINE])
def test_gradients(inflow: str) -> None:
    """Slopes of index and power by linear twist, against differences of trims."""
    tight = SolverOptions(residual_tolerance=1e-12, inflow_tolerance=1e-10, torsion_tolerance=1e-12)
    step, before = 0.005, rotor.solve(_design(0.3, inflow, twist="linear:-12"))
    low, high = (
        rotor.solve(
            _design(0.3, inflow, twist=f"linear:{-12 + sign * step}"), options=tight
        ).require()
        for sign in (-1.0, 1.0)
    )
    slopes = np.radians(1.0) * (before.disk.r - 0.75)
    expected = (_loads(high).index - _loads(low).index) / (2.0 * step)
    assert_allclose(index_along(Analysis(before).adjoint)[1] @ slopes, expected, rtol=3e-4)
    expected = (high.power.total - low.power.total) / (2.0 * step)
    assert_allclose(power_gradient(before).by_element @ slopes, expected, rtol=3e-5)


def test_where_there_are_no_hub_loads() -> None:
    assert why_no_hub_loads(rotor.make_design(mu=0.2)) is None
    fast = rotor.make_design(mu=0.25)
    central = replace(fast.rotor, blade=replace(fast.rotor.blade, flap_hinge=0.0))
    for design, words in (
        (replace(fast, rotor=central), "hinged at the shaft"),
        (rotor.make_design(mu=0.19), "below µ 0.2"),
        (rotor.make_design(hover=True), "below µ 0.2"),
        (
            rotor.make_design(rotor="r22", mu=0.25),
            "Robinson R22 blade in flap and lag is not known",
        ),
    ):
        reason = why_no_hub_loads(design)
        assert words in reason.sentence
        assert hub_loads(rotor.solve(design)) is None


def test_solution_has_hub_loads_with_their_band() -> None:
    """A design whose blades do not bend has those of its twin whose blades do."""
    stiff, bent = rotor.solve(rotor.make_design(mu=0.3)), _solved(0.3, LINE)
    loads, frequencies = hub_loads(stiff), bent.blade_frequencies
    assert_allclose(loads.index, _loads(bent).index, rtol=1e-6)
    assert loads.band[0] < 0.6 * loads.index <= loads.index == loads.band[1]
    assert_allclose(frequencies.flap[:2], [1.035, 2.81], rtol=0.02)
    assert_allclose(frequencies.lag[0], 0.27, atol=0.005)
    # Fan plots have 4.3 to 4.6: the control stiffness is assumed.
    assert_allclose(frequencies.torsion[0], 4.97, atol=0.01)


class _March:
    """The modes in time under the inflow and the controls of a trim, by the classical Runge-Kutta method."""

    def __init__(self, solution: Solution, steps: int) -> None:
        self.problem, self.point, self.b = _at(solution)
        p, b, structure, torsion = (
            self.problem,
            self.b,
            self.point.system.structure,
            self.problem.torsion,
        )
        self.torsion, self.steps, size = torsion, 2 * steps, len(b.mass)
        self.q, self.offset = coordinates_of(b, structure, self.point.z)
        self.phi = self.point.x[
            [structure.states["twist", k, h] for k in range(2) for h in range(17)]
        ].reshape(2, 17)
        self.psi = 2.0 * np.pi * np.arange(self.steps) / self.steps
        around = wave_grid(structure.waves, self.steps)
        rest = self.point.x.copy()
        for name, atom in structure.states.items():
            moves = isinstance(name, tuple) and name != ("bend", "offset")
            if moves or name in ("coning", "flap_1c", "flap_1s"):
                rest[atom] = 0.0
        grid = replace(self.point.grid, waves=around, data=p.grid_data(len(p.disk.psi)))
        self.data, self.given = grid.data, evaluate(self.point.system, grid, rest).channels
        tip = torsion.radial * (torsion.tip_mass * torsion.dr)
        self.by_slope, self.by_rise = tip @ b.shapes[1].T, tip / p.disk.r @ b.shapes[0].T
        self.masses = np.block([
            [np.diag(b.mass), -self.by_rise.T], [-self.by_rise, np.diag(1.0 / (torsion.gain * torsion.frequency**2))]
        ])  # fmt: skip
        self.size = size

    def start(self) -> Array:
        """State of harmonic balance at ψ = 0: coordinates and rates, bending first."""
        at, after = (waves_at(17, np.array([one])) for one in (0.0, 1e-6))
        q = np.concatenate([self.q, self.phi])
        return np.concatenate([(q @ at)[:, 0], (q @ (after - at))[:, 0] / 1e-6])

    def rates(self, step: int, state: Array) -> Array:
        """At a half step."""
        b, torsion, k, n = self.b, self.torsion, step % self.steps, self.size
        x, dx = np.split(state, 2)
        q, phi, dq, dphi = x[:n], x[n:], dx[:n], dx[n:]
        c = self.given[:, :, [k]].copy()
        _, dw, ddw, v, dv, ddv = (own.T @ q for own in b.shapes)
        for channel, added in (
            (TH, torsion.radial.T @ phi), (RATE, torsion.radial.T @ dphi), (UP, b.shapes[0].T @ dq),
            (UT, b.shapes[3].T @ dq), (UR, v), (-5, dw), (-4, dv), (-3, ddw), (-2, ddv), (-1, b.outboard.T @ dq),
        ):  # fmt: skip
            c[channel, :, 0] += added
        f = self.problem.interface.section(c, self.data, False, False)[0][:, :, 0]
        width, share = self.problem.disk.dr, b.share
        coriolis = 2.0 * share * (dw * (b.shapes[1].T @ dq) + dv * (b.shapes[4].T @ dq))  # Ė
        of_air = b.shapes[0] @ (width * f[FZ]) - b.shapes[3] @ (width * f[FX])
        inner = sum(
            b.shapes[row] @ (width * f[force])
            for row, force in ((1, -4), (4, -3), (2, -2), (5, -1))
        )
        held = b.load + self.offset * b.in_plane
        held[b.lag] -= 0.5 * self.offset * self._shortened / (1.0 - b.r[0])
        right = (
            of_air
            + held
            - inner
            + b.outboard @ (width * coriolis)
            - b.mass * b.frequency**2 * q
            - b.damping @ dq
        )
        right += self.by_slope.T @ phi
        state_ = self.point.system.structure.states
        cyclic = self.point.x[state_["cyclic_1c"]] * math.cos(self.psi[k])
        cyclic += self.point.x[state_["cyclic_1s"]] * math.sin(self.psi[k])
        moment = (
            torsion.radial @ (width * f[M])
            + torsion.coupling @ phi
            + torsion.modal(torsion.inertia) * cyclic
        )
        moment += self.by_slope @ q - (phi + self.problem.given_torsion[:, 0]) / torsion.gain
        return np.concatenate([dx, np.linalg.solve(self.masses, np.concatenate([right, moment]))])

    @property
    def _shortened(self) -> float:
        structure = self.point.system.structure
        force = structure.forces - 5
        return float(
            (self.problem.disk.dr * self.b.mass_outboard) @ self.point.forces[force].mean(axis=1)
        )

    def turns(self, count: int) -> Array:
        """Coordinates over the last of some turns, (steps, modes)."""
        state, found, width = self.start(), list[Array](), 4.0 * np.pi / self.steps
        for k in range(count * self.steps // 2):
            found.append(state)
            one = self.rates(2 * k, state)
            two = self.rates(2 * k + 1, state + 0.5 * width * one)
            three = self.rates(2 * k + 1, state + 0.5 * width * two)
            four = self.rates(2 * k + 2, state + width * three)
            state = state + width / 6.0 * (one + 2.0 * two + 2.0 * three + four)
        return np.array(found[-self.steps // 2 :])[:, : self.size + 2]


@pytest.mark.slow
def test_time_marching() -> None:
    """Marched in time from the trim, every mode moves the tip as in the trim to 0.1 mm in harmonics 0 to 6.

    In steady flow: the march takes the forces at a point alone.
    """
    design = _design(0.3, LINEAR)
    steady = replace(design, models=replace(design.models, unsteady=False, dynamic_stall=False))
    march = _March(rotor.solve(steady).require(), 540)
    found = march.turns(4)
    psi = march.psi[::2]
    waves = waves_at(13, psi)
    means = found.T @ waves.T / len(psi)
    means[:, 1:] *= 2.0
    expected = np.concatenate([march.q, march.phi])[:, :13]
    assert_allclose(means[:-2], expected[:-2], atol=1e-4 / 8.1788)
    assert_allclose(means[-2:], expected[-2:], atol=math.radians(0.005))


@pytest.mark.slow
def test_loads_do_not_depend_on_the_pitch_of_the_modes(patch: Patch) -> None:
    """What turns the axes of bending is at every point; modes at another pitch leave what they are cut off at."""
    expected = _loads(_solved(0.3, LINE)).index
    patch(f"{PROBLEM}.REFERENCE_COLLECTIVE", math.radians(4.0))
    found = _loads(rotor.solve(_design(0.3, LINE))).index
    assert found != expected
    assert_allclose(found, expected, rtol=0.03)


@pytest.mark.slow
def test_more_modes(patch: Patch) -> None:
    """Two flap modes more: index within 1 %, vertical force within 3 %, power within 0.2 %.

    The target of 3 % is missed by 3 % elsewhere: with a flap and a lag mode more the vertical force has 2.8 % more with
    a lifting line, and 5.6 % less with linear inflow, where it is a sixth of that.
    """
    few, before = (
        _solved(0.3, LINE),
        {inflow: _loads(_solved(0.3, inflow)) for inflow in (LINE, LINEAR)},
    )
    patch(f"{PROBLEM}.MODES", (6, 3))
    more = rotor.solve(_design(0.3, LINE)).require()
    assert_allclose(_loads(more).index, before[LINE].index, rtol=0.01)
    assert_allclose(_loads(more).amplitudes["fz"], before[LINE].amplitudes["fz"], rtol=0.03)
    assert more.power.total != few.power.total
    assert_allclose(more.power.total, few.power.total, rtol=2e-3)
    patch(f"{PROBLEM}.MODES", (5, 4))
    for inflow in (LINE, LINEAR):
        other = _loads(rotor.solve(_design(0.3, inflow)).require())
        assert_allclose(other.index, before[inflow].index, rtol=0.02)
        assert_allclose(other.amplitudes["fz"], before[inflow].amplitudes["fz"], rtol=0.06)


@pytest.mark.slow
def test_more_harmonics(patch: Patch) -> None:
    """Up to 10/rev in place of 8/rev: every load within 1 %."""
    few = _loads(_solved(0.3, LINEAR)).amplitudes
    patch(f"{PROBLEM}.BENDING_HARMONICS", 10)
    more = _loads(rotor.solve(_design(0.3, LINEAR)).require()).amplitudes
    assert more != few
    assert_allclose(list(more.values()), list(few.values()), rtol=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("mu", [0.2, 0.3, 0.35])
def test_more_azimuths(mu: float) -> None:
    """240 in place of 48: the index within 0.2 %, every load within 1 %."""
    few = _design(mu, LINEAR)
    loads = _loads(rotor.solve(few).require())
    more = _loads(rotor.solve(replace(few, models=replace(few.models, azimuths=240))).require())
    assert_allclose(loads.index, more.index, rtol=2e-3)
    assert_allclose(list(loads.amplitudes.values()), list(more.amplitudes.values()), rtol=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    "finer", [{"line_azimuths": 48}, {"panels": 48}], ids=["azimuths", "panels"]
)
def test_twice_the_grid_of_the_lifting_line(finer: dict[str, int]) -> None:
    """The index within 7 %, and what 3/rev twist does to it within 3 % of it.

    The target for all loads, 1 %, is missed by the grid of the wake, which lies with its 24 azimuths and panels.
    """
    few = _loads(_solved(0.3, LINE)).index
    before = _loads(rotor.solve(_design(0.3, LINE, twist_per_rev="3:1:45"))).index / few
    designs = [_design(0.3, LINE, twist_per_rev=own) for own in ("", "3:1:45")]
    plain, moved = (
        _loads(rotor.solve(replace(one, models=replace(one.models, **finer)))).index
        for one in designs
    )
    assert_allclose(plain, few, rtol=0.07)
    assert_allclose(moved / plain, before, atol=0.03)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("inflow", "steep", "two", "at", "three"),
    [
        (LINE, (3.0, math.inf), (-0.20, -0.10), 45, (-0.70, -0.40)),
        (LINEAR, (1.3, 3.0), (-0.35, -0.20), 60, (0.0, 0.6)),
    ],
)
def test_trends(inflow: str, steep: Span, two: Span, at: int, three: Span) -> None:
    """With a lifting line, as an independent prototype with other wakes has them. Linear inflow does not share them.

    The loads at N_b/rev of a rotor in linear inflow miss what its own wake puts into them: there 3/rev at 60° adds
    48 %, 2/rev at 270° takes 32 %, and −20° of twist at µ 0.35 has 1.5 times the index of 0°.
    """
    flat, much = (
        _loads(rotor.solve(_design(0.35, inflow, twist=f"linear:{own}"))).index for own in (0, -20)
    )
    assert steep[0] < much / flat < steep[1]
    base = _loads(_solved(0.3, inflow)).index
    for span, own in ((two, "2:1:270"), (three, f"3:1:{at}")):
        change = _loads(rotor.solve(_design(0.3, inflow, twist_per_rev=own))).index / base - 1.0
        assert span[0] < change < span[1]

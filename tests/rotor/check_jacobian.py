"""The equations of a flight at any state, and their Jacobian against differences."""

import numpy as np
from numpy.testing import assert_allclose

from rotor.aero.disk import Disk
from rotor.aero.elements import STATE_NAMES, BladeElements, DiskSums, TrimState
from rotor.aero.problem import Problem
from rotor.columns.flight import elements_of, flight_system
from rotor.engine.linearise import Point, evaluate, jacobian, transposed
from rotor.support.arrays import Array
from rotor.trim.newton import Guess, first_point


def point_at(problem: Problem, state: TrimState) -> Point:
    """With all eight quantities as in the state, also those that a trim gives another value."""
    system = flight_system(problem)
    x = first_point(problem, system, Guess(state))
    x[[system.structure.states[name] for name in STATE_NAMES]] = state.array()
    return evaluate(system, system.grid, x, slopes=True, flow=True)


def elements_at(problem: Problem, state: TrimState) -> BladeElements:
    """The blade elements there."""
    return elements_of(problem, point_at(problem, state))


def disk_sums(disk: Disk, elements: BladeElements) -> DiskSums:
    """Thrust, H-force and torque of a blade that only flaps, summed over its elements."""
    width = disk.dr / len(disk.psi)
    lift, across, along = width @ elements.fz, width @ elements.fx, width @ elements.fr
    drag = across @ disk.sin + (along - elements.beta * lift) @ disk.cos
    return DiskSums(float(lift.sum()), float(drag), float(disk.r * width @ elements.fx.sum(axis=1)))


def check_along(point: Point, along: Array, tolerance: float) -> None:
    """The Jacobian along a change of all unknowns against differences of fourth order; and its transpose."""
    system, exact = point.system, jacobian(point)[0]

    def residual(share: float) -> Array:
        x = point.x.copy()
        x[system.free] += share * along
        return evaluate(system, point.grid, x).residual

    near, far = residual(0.1) - residual(-0.1), residual(0.2) - residual(-0.2)
    expected = (8.0 * near - far) / 1.2
    assert_allclose(exact @ along, expected, atol=tolerance * float(np.abs(expected).max()))
    weights = np.random.default_rng(2).standard_normal(len(along)) / system.tolerance
    assert_allclose(transposed(point, weights)[0] @ along, weights @ exact @ along, rtol=1e-9)

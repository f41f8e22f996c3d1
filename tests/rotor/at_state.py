"""The equations of a flight at any state, its blade elements and their sums over the disk."""

from rotor.aero.disk import Disk
from rotor.aero.elements import STATE_NAMES, BladeElements, DiskSums, TrimState
from rotor.aero.problem import Problem
from rotor.columns.flight import elements_of, flight_system
from rotor.engine.linearise import Point, evaluate
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

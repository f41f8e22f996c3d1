"""What the rotor head hands to the shaft: the moment of the lopsided lift about the hub."""

from rotor.aero import kernel
from rotor.aero.elements import Pass, Problem
from rotor.trim.solution import HubMoment


def hub_moment(problem: Problem, one: Pass) -> HubMoment:
    """Steady moments about the hub, first harmonics of Σ r dF_z.

    Hinged or not: a blade that flaps once a revolution feels as much from its inertia one way as from its centrifugal
    force the other, about the hub. Blades free to flap at the centre hand over nothing, because flapping evens it out.
    """
    design, disk = problem.design, problem.disk
    moment = disk.r @ one.loads[kernel.FZ] * (design.thrust_unit * design.rotor.radius * disk.dr / len(disk.psi))
    return HubMoment(roll=float(moment @ disk.sin), pitch=-float(moment @ disk.cos))

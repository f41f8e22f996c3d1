"""The controls of a trim between their stops."""

from rotor.aero.elements import TrimState
from rotor.design.design import Design
from rotor.design.twist import TwistLaw


def rigged_collective(design: Design, controls: TrimState, jig: TwistLaw | None = None) -> float:
    """Collective at 0.75 R of a blade with its jig twist whose root stands as in a trim [rad].

    Stops limit the pitch of the root. An actuator twists the blade between the root and 0.75 R, so that a trim with it
    has another collective at the same place of the control. jig: by default the design's own.
    """
    rigged = design.jig if jig is None else jig
    stations = [design.rotor.blade.root_cutout, 0.75]
    root, outer = design.twist(stations)
    rigged_root, rigged_outer = rigged(stations)
    turned = float(root - outer - (rigged_root - rigged_outer))
    return controls.collective + turned

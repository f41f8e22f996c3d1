"""The filaments of a free wake as points in the coordinates of the rotor."""

import math
from dataclasses import dataclass

import numpy as np

from rotor.aero.free_wake.system import HoverSystem, WakeEvaluation, WakeState
from rotor.arrays import Array


@dataclass(frozen=True, eq=False)
class WakeFilaments:
    """The vortex filaments of all blades, for drawing."""

    points: Array
    """x, y, z over R, (filaments, points, 3): blade after blade, root to tip. Blade 0 lies over the tail, ψ = 0, along
    the x-axis; y points to the advancing side, z up; the first point is on the blade."""
    core_radius: Array
    """Over R, (filaments, points)."""
    circulation: Array
    """Over ΩR², positive as that of a tip vortex, (filaments,)."""
    state: WakeState
    """The unknowns of the wake, from which an iteration may begin."""

    @property
    def tip_vortices(self) -> Array:
        """Those of `points` that leave at the tips, (blades, points, 3)."""
        return self.points[self.state.layout.filaments - 1 :: self.state.layout.filaments]


def filaments(system: HoverSystem, at: WakeEvaluation) -> WakeFilaments:
    """The filaments behind all blades in the coordinates of the rotor."""
    layout = system.layout
    blade = 2.0 * math.pi * np.arange(layout.blades) / layout.blades
    psi = blade[:, None] - layout.step * np.arange(layout.nodes)  # (blades, nodes)
    x = at.radius * np.cos(psi)[:, None]
    y = at.radius * np.sin(psi)[:, None]
    z = np.broadcast_to(at.height, x.shape)
    points = np.stack([x, y, z], axis=-1).reshape(-1, layout.nodes, 3)
    core = np.sqrt(system.core_squares(at.rolled))
    return WakeFilaments(
        points, np.tile(core, (layout.blades, 1)), np.tile(at.rolled.strength, layout.blades), at.state
    )

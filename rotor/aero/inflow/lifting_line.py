"""The lifting line: each blade a line of panels, the blade elements, with its wake (`rotor.aero.lifting_line`).

    λ_i = λ0 + (A Γ − λ0)/D,    D = 1 + λ0 (µ_z + λ0)/V²                      (Pitt and Peters, `DiskFlow.mass_flow`)
    Γ = (π/N_b) U_T F_z*/max(U_T², 0.01),  0 in reverse flow                  (Kutta and Joukowski)

F_z* is F_z with lift and drag held beyond the angle of the largest lift (`held_beyond_peak`). If circulation fell with
the lift, panels beyond stall would have several answers; so Γ falls with every downwash, and there is one. Where
rotation delays stall F_z* has the delay, too, because the wake sees the lift that is there: C_l and C_l* of
`rotor.airfoil.stall_delay` are both held. Γ is over ΩR², A the influence matrix of a wake that lies along the trim of
the same rotor with linear inflow and the blade as built: so it stays while twist is changed. Unknowns are the
circulations of all panels at all azimuths.

The whole wake of A moves at one speed V, so A Γ in hover is N_bΓ/4πV; annuli of momentum theory have λ² = N_bΓ/4π. What
differs from the mean would be twice too large there. With D, λ_i has the value and the slope of momentum theory where
the load is that of the course: λ0, V and D are the course's, which also keeps all twists on one linear relation. Pitt
and Peters' theory is of smeared loads; D acts on all of A, our choice. Under unsteady sections the lag of a thin
aerofoil has no D: it does not come from the mass flow of the disk.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import DiskFlow, InflowModel, InflowTerms, Losses, SectionInterface
from rotor.aero.lifting_line import (
    LiftingLine,
    WakeCourse,
    at_points,
    influence,
    mean_influence,
    shed_correction,
)
from rotor.aero.section import (
    CHANNELS,
    FORCES,
    FZ,
    NO_INCREMENTS,
    NO_MOMENT,
    PAIRS,
    UP,
    UT,
    section,
)
from rotor.design.design import Models
from rotor.engine.linearise import Nodes
from rotor.engine.terms import ONE, Shape, Structure
from rotor.engine.waves import STEADY
from rotor.support.arrays import Array, read_only
from rotor.support.bytes_cache import bytes_cache

MOST_PANELS = 128
"""Beyond some 200 the panels at the tip are so short that Newton's method in single precision no longer converges."""
MOST_AZIMUTHS = 480
"""Lags tie all azimuths of a panel to each other, in memory that grows with their square."""
MOST_POINTS = 3000
"""Panels times azimuths. From some 5800 on Newton's method is slow or does not converge."""
SLOWEST = 0.1
"""|U_T| below which circulation is no longer L/U_T, which would grow without bound."""

CIRCULATION = len(FORCES)
"""N_b Γ/π, in the place of a further force."""
_LIFTED = tuple(channel for force, channel in PAIRS if force == FZ)
LINE_PAIRS = (*PAIRS, *((CIRCULATION, channel) for channel in _LIFTED))


def circulation_gain(u_t: Array) -> tuple[Array, Array]:
    """U_T/max(U_T², 0.01), 0 in reverse flow, and its slope by U_T; shape of u_t."""
    over = 1.0 / np.maximum(u_t, SLOWEST) ** 2
    return np.maximum(u_t, 0.0) * over, np.where(
        u_t >= SLOWEST, -over, np.where(u_t > 0.0, over, 0.0)
    )


def _line_section(c: Array, data: Any, slopes: bool, flow: bool) -> tuple[Array, Array, Array]:
    """The section with its circulation; as `section.section`, with the rows of `LINE_PAIRS`."""
    f, d, s = section(c, data, slopes, flow)
    tables = {"tables": data.held, "missing": data.held_missing}
    still = data._replace(**tables, yawed=False, added=NO_INCREMENTS, **NO_MOMENT)
    held, by_held, _ = section(c, still, slopes, False)
    gain, by_speed = circulation_gain(c[UT])
    f = np.concatenate([f, (gain * held[FZ])[None]])
    if slopes:
        by_channel = np.zeros((len(_LIFTED), *gain.shape))
        for k, channel in enumerate(_LIFTED):
            # Derivatives by F are undefined where it is 1.
            if channel < len(CHANNELS) - 2 or data.lossy:
                by_channel[k] = gain * by_held[PAIRS.index((FZ, channel))]
        by_channel[_LIFTED.index(UT)] += by_speed * held[FZ]
        d = np.concatenate([d, by_channel])
    return f, d, s


_LINE = SectionInterface(_line_section, LINE_PAIRS, len(CHANNELS), len(FORCES) + 1)


@dataclass(frozen=True)
class LiftingLineInflow(InflowModel):
    """Lifting lines of the rotor's own blades with the wake along the trim."""

    name = "lifting-line"
    title = "Lifting line"
    explanation = (
        "Each blade is a line of 24 vortex panels. Its wake sinks as measured tip vortices did and does not roll up. "
        "At µ 0.05 to 0.15 this decides what twist is worth: −8° to −16° change power by −1.2 to −3.0 %, and by −4 to "
        "−5 % with a wake that rolls up."
    )
    load_dependent = True
    fine_tip = True
    wake_along = "pitt-peters"
    keeps_tips = True
    usual = True
    in_index_band = True

    def grid(self, models: Models, blades: int) -> tuple[int, int]:
        """Panels, and azimuths in a multiple of the number of blades."""
        panels, azimuths = models.panels, models.line_azimuths
        if panels > MOST_PANELS or azimuths > MOST_AZIMUTHS or panels * azimuths > MOST_POINTS:
            raise ValueError(
                f"a lifting line of {panels} elements at {azimuths} azimuths is too fine: give at most {MOST_PANELS} "
                f"and {MOST_AZIMUTHS}, and {MOST_POINTS} points in all; 24 × 24 is enough for power"
            )
        return models.panels, -(-models.line_azimuths // blades) * blades

    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> "LiftingLineTerms":
        """The model on a disk, with the wake on a course."""
        del losses
        return LiftingLineTerms(LiftingLine(disk.blades, disk.root, *disk.shape), course)


def mean_share(course: DiskFlow) -> float:
    """1 − 1/D, the part of λ_i that is the mean inflow of the course."""
    return 1.0 - 1.0 / course.mass_flow


@bytes_cache
@read_only
def _matrix(
    line: LiftingLine, course: WakeCourse, half_chord: tuple[float, ...]
) -> NDArray[np.float32]:
    """From N_b Γ/π to the downwash, (points, points): one for each condition, for all its twists.

    half_chord: of unsteady sections over R, (panels,), or empty.
    """
    matrix, share, panel = influence(line, course), math.pi / line.blades, np.arange(line.panels)
    blocks, scale = (
        matrix.reshape(2 * (line.panels, line.azimuths)),
        np.float64(share / course.mass_flow),
    )
    own = scale * blocks[panel, :, panel]
    np.multiply(matrix, scale, out=matrix, casting="same_kind")  # In double precision.
    if half_chord:
        blocks[panel, :, panel] = own + share * shed_correction(line, course, np.array(half_chord))
    return matrix


class LiftingLineTerms(InflowTerms):
    """Lifting lines as nodes of the engine, see `InflowTerms`."""

    interface = _LINE
    names = ("mean inflow",)

    def __init__(
        self, line: LiftingLine, course: WakeCourse, half_chord: tuple[float, ...] = ()
    ) -> None:
        """half_chord: of unsteady sections over R, (panels,), or empty."""
        self.line, self.course, self._half_chord = line, course, half_chord
        self.key = "lifting line", line.panels, line.azimuths
        self.least_azimuths = line.azimuths

    def unsteady(self, half_chord: Array) -> "LiftingLineTerms":
        """These terms with the correction of the shed wake, see `rotor.aero.lifting_line.shed_correction`."""
        return LiftingLineTerms(self.line, self.course, tuple(half_chord.tolist()))

    def build(self, structure: Structure) -> None:
        """Add the mean inflow of the course to U_P: (1 − 1/D) λ0."""
        structure.column(UP, self.names[0], STEADY, 1.0, ONE)

    def shapes(self) -> dict[Shape, Array]:
        """The mean inflow of the course, (1 − 1/D) λ0, (panels,)."""
        return {
            self.names[0]: np.full(self.line.panels, mean_share(self.course) * self.course.lambda0)
        }

    def nodes(self, tolerance: float, thrust: float) -> Nodes:
        """Circulations and what they do; tolerance: of N_b Γ/π."""
        matrix, uniform = (
            _matrix(self.line, self.course, self._half_chord),
            self.course.lambda0 / self.course.mass_flow,
        )
        return Nodes(UP, CIRCULATION, matrix, tolerance, 3.0 * thrust, uniform)

    def off_disk(self, points: Array, nodes: Array | None) -> Array:
        """Mean inflow at points off the disk from the wakes of all blades."""
        assert nodes is not None
        upward = np.broadcast_to([0.0, 0.0, 1.0], points.shape)
        matrix = at_points(self.line, self.course, points, upward).mean(axis=0)
        wake = matrix @ nodes * (math.pi / self.line.blades)
        return wake / self.course.mass_flow + mean_share(self.course) * self.course.lambda0

    def axial(self, flow: DiskFlow, u_t: Array) -> tuple[Array, Array]:
        """The matrix of the interface: effect of the load by its circulation and by its thrust, λ0 = C_T/2V."""
        course = replace(
            self.course,
            mu_x=flow.mu_x,
            mu_z=flow.mu_z,
            lambda0=flow.lambda0,
            flap_1c=0.0,
            flap_1s=0.0,
        )
        matrix = mean_influence(self.line, course) * (math.pi / self.line.blades / course.mass_flow)
        gain, slope = circulation_gain(u_t)
        of_thrust = mean_share(course) * 0.5 / course.speed * np.diff(self.line.edges)
        return matrix * gain + of_thrust, matrix * slope


MODELS = (LiftingLineInflow(),)

"""One slow turn with a blade section: what the page needs to go with it, over the azimuth."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from explorer.colours import THIS
from explorer.model.units import number
from explorer.scene.controller import SceneController
from explorer.tabs.context import TabContext
from explorer.tabs.probe.element import Probe, probe
from explorer.tabs.probe.probe_drawing import outline, sections_of, where
from rotor import Solution
from rotor.chart import Axis, Chart, Line, as_json

AZIMUTHS = 72
"""Points of a turn; the page goes straight between them."""
_ANGLES = 91
"""Angles of each lift curve."""
_LEAST_REACH = 14.0
"""The lift curve is drawn at least to this angle of attack either way [°]."""


class Ride:
    """The page moves camera, rotor and arrows by itself; a new answer during the turn changes what it reads."""

    def __init__(self, context: TabContext, scene: SceneController, playing: Callable[[], bool]) -> None:
        """`playing`: whether the rotor turns by itself."""
        self._context, self._scene, self._playing = context, scene, playing
        self._at: tuple[float, float] | None = None
        """r/R and the azimuth where the turn began [°]."""
        self._shown: Solution | None = None

    def begin(self, solution: Solution, r: float, psi_deg: float) -> None:
        if self._scene.camera is not None:
            self._scene.camera.hold(True)
        self._context.layout.show_drawer("")
        self._scene.play(True)
        self._at, self._shown = (r, psi_deg), None
        self.show(solution)

    def show(self, solution: Solution) -> None:
        if self._at is not None and solution is not self._shown:
            self._shown = solution
            self._context.bridge.set(ride=turn_of(solution, *self._at))

    def end(self) -> None:
        if self._at is None:
            return
        self._at = self._shown = None
        self._context.bridge.set(ride=None)
        if not self._playing():
            self._scene.play(False)
        if self._scene.camera is not None:
            self._scene.camera.hold(False)


def turn_of(solution: Solution, r: float, psi_deg: float) -> dict[str, Any]:
    """A section around the disk: flow [m/s], angles [°], lift [kN/m] and C_l at equal steps of ψ from 0, with the lift
    curve at each Mach number. Where the flow comes from the trailing edge, angles count from there.
    """
    around = [probe(solution, r, 2.0 * math.pi * k / AZIMUTHS) for k in range(AZIMUTHS)]
    alpha = np.array([_from_the_edge_that_meets_the_flow(here) for here in around])
    ahead = np.array([here.u_t >= 0.0 for here in around])
    cl = np.array([here.cl for here in around])
    reach = max(_LEAST_REACH, 1.15 * float(np.abs(alpha[ahead]).max(initial=0.0)))
    angles = np.linspace(-reach, reach, _ANGLES)
    curves = [
        here.section.lift_curve(np.radians(angles) + (0.0 if front else math.pi), here.table_mach)
        for here, front in zip(around, ahead, strict=True)
    ]
    highest = max(float(np.abs(cl).max()), *(float(np.abs(curve).max()) for curve in curves))
    path = Line("", np.append(alpha, alpha[0]), np.append(np.where(ahead, cl, np.nan), np.nan), THIS, width=1.2)
    chart = Chart(
        "Lift curve at this Mach number",
        Axis("α", (-reach, reach), unit="°"),
        Axis("C_l", (-1.1 * highest, 1.1 * highest)),
        (path,),
    )
    return {
        "r": r,
        "psi": psi_deg,
        "out": around[0].radius,
        "radius": solution.design.rotor.radius,
        "section": sections_of(around[0].section),
        "outline": np.round(outline(around[0].section), 4).tolist(),
        "u": [round(math.copysign(here.u, here.u_t), 1) for here in around],
        "theta": _rounded([math.degrees(here.theta) for here in around]),
        "phi": _rounded([math.degrees(math.remainder(here.phi, 2.0 * math.pi)) for here in around]),
        "alpha": _rounded(alpha),
        "cl": _rounded(cl, 3),
        "mach": _rounded([here.table_mach for here in around]),
        "lift": _rounded([here.lift / 1e3 for here in around], 3),
        "where": [where(here.psi) for here in around],
        "region": [here.region.value for here in around],
        "margin": [
            None if here.stall_margin is None else number(math.degrees(here.stall_margin), 1) for here in around
        ],
        "angles": _rounded(angles),
        "curves": [_rounded(curve, 3) for curve in curves],
        "chart": as_json(chart),
    }


def _from_the_edge_that_meets_the_flow(here: Probe) -> float:
    return math.degrees(here.alpha if here.u_t >= 0.0 else math.remainder(here.alpha - math.pi, 2.0 * math.pi))


def _rounded(values: Any, digits: int = 2) -> list[float]:
    return np.round(np.asarray(values, dtype=float), digits).tolist()

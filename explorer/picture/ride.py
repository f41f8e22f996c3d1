"""One slow turn with a blade section: what the page needs to go with it, and what a viewer sees at each azimuth."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from explorer.model.units import number
from explorer.parts.stage import RidePart
from explorer.picture.camera_views import RIDE_EYE, RIDE_LOOK, RIDE_VIEW
from explorer.picture.element import FlowRegion, Probe, outline, probe, sections_of, where
from rotor import Solution
from rotor.aero.display import STALLED
from rotor.support.chart import Axis, Chart, Line, drawn_chart

AZIMUTHS = 72
"""Points of a turn; the page goes straight between them."""
FIRST_PSI = 90.0
"""Where a turn begins with no section chosen [°]: attached flow comes first, the retreating side in the middle."""
_USUAL_STATION = 0.75
"""r/R where no section is nearer to stall than another, as sections cannot stall."""
_ANGLES = 91
"""Angles of each lift curve."""
_LEAST_LOW, _LEAST_HIGH = -6.0, 16.0
"""The lift curve is drawn at least between these angles of attack [°]."""
_ROOM = 0.06
"""Free height above and below it, of its own height."""
_LITTLE_MARGIN = math.radians(3.0)
"""Of the angle of attack to static stall, of which the sentence speaks."""
_STEADY_ALPHA, _STEADY_SPEED = math.radians(0.05), 0.5
"""Changes of α [rad] and of the velocity [m/s] over a turn below which nothing changes."""


def telling_station(solution: Solution) -> float:
    """r/R of the section whose turn shows the most stall.

    It is the one over which most separated air passes in a turn. Where no flow is separated, it is the one that comes
    nearest to separation, as `Solution.least_margin` counts it. 0.75 where sections do not stall.
    """
    disk = solution.disk
    if not solution.design.models.stall:
        return _USUAL_STATION
    separated_air = (disk.stalled * disk.u_t).sum(axis=1)
    if separated_air.any():
        return float(disk.r[separated_air.argmax()])
    margin = disk.stall_margin
    if disk.unsteady is not None:
        margin = disk.unsteady.separation - STALLED
    least = np.where(disk.u_t >= 0.0, margin, np.inf).min(axis=1)
    return float(disk.r[least.argmin()])


@dataclass(frozen=True)
class _Moment:
    """A section at an azimuth, and how it changes there."""

    here: Probe
    alpha_rises: bool
    lift_rises: bool
    speed_rises: bool | None
    """None where the velocity is the same around the turn."""

    @property
    def sentence(self) -> str:
        """One sentence on what the flow does here."""
        match self.here.region:
            case FlowRegion.IDLE:
                return "Reverse flow: the air comes from the trailing edge. The model leaves its loads out."
            case FlowRegion.REVERSE:
                return "Reverse flow: the air comes from the trailing edge."
            case FlowRegion.SEPARATED | FlowRegion.PAST_STATIC if self._past_negative_stall:
                return "The flow comes from above: the angle of attack is beyond negative static stall."
            case FlowRegion.SEPARATED:
                return self._separated()
            case FlowRegion.PAST_STATIC:
                return self._past_static()
            case FlowRegion.DIVERGED:
                return "Fast air: the section is beyond drag divergence, where drag climbs with the Mach number."
            case FlowRegion.ATTACHED:
                return self._attached()

    @property
    def _past_negative_stall(self) -> bool:
        return self.here.stall is not None and self.here.alpha < self.here.stall[0]

    def _separated(self) -> str:
        if not self.here.past_static:
            return "The angle of attack is below static stall again; the flow is still separated: it reattaches late."
        if self.here.unsteady is None:
            return "Past the static stall angle the flow is separated: drag is high."
        if self.alpha_rises and self.lift_rises:
            return (
                "The flow separates, and the lift coefficient still rises with the angle of attack."
            )
        if self.lift_rises:
            return "The flow is separated, past the static stall angle."
        return "The flow is separated and the lift coefficient falls: the section has stalled."

    def _past_static(self) -> str:
        if self.alpha_rises and self.lift_rises:
            return "The angle of attack is past static stall, and the lift coefficient still rises: the flow holds on."
        if self.alpha_rises:
            return "The angle of attack is past static stall, and the flow is still attached."
        return "The angle of attack falls back towards static stall with the flow attached."

    def _attached(self) -> str:
        margin = self.here.stall_margin
        angle = "grows" if self.alpha_rises else "falls"
        if self.speed_rises is None:
            sentence = f"The angle of attack {angle}"
        else:
            air = "faster" if self.speed_rises else "slower"
            joint = "and" if self.alpha_rises != self.speed_rises else "yet"
            sentence = f"The blade turns into {air} air, {joint} the angle of attack {angle}"
        if self.alpha_rises and margin is not None and margin < _LITTLE_MARGIN:
            return f"{sentence}: little is left to static stall."
        return f"{sentence}."


def seen_around(around: Sequence[Probe]) -> list[str]:
    """What is seen at each point of a turn, one sentence each."""
    speeds = [math.copysign(here.u, here.u_t) for here in around]
    alphas = [here.alpha for here in around]
    steady = bool(np.ptp(speeds) < _STEADY_SPEED)
    if np.ptp(alphas) < _STEADY_ALPHA and steady:
        return ["Nothing changes around this turn: the air is the same at every azimuth."] * len(
            around
        )
    sentences: list[str] = []
    for k, here in enumerate(around):
        before = around[k - 1]
        after = around[(k + 1) % len(around)]
        moment = _Moment(
            here,
            alpha_rises=after.alpha > before.alpha,
            lift_rises=after.cl > before.cl,
            speed_rises=None if steady else after.u_t > before.u_t,
        )
        sentences.append(moment.sentence)
    return sentences


def turn_of(solution: Solution, r: float, psi_deg: float) -> RidePart:
    """A section around the disk, with the lift curve at each Mach number."""
    around = [probe(solution, r, 2.0 * math.pi * k / AZIMUTHS) for k in range(AZIMUTHS)]
    ahead = np.array([here.u_t >= 0.0 for here in around])
    # From the edge that meets the flow.
    angle = [
        here.alpha if here.u_t >= 0.0 else math.remainder(here.alpha - math.pi, 2.0 * math.pi)
        for here in around
    ]
    alpha = np.degrees(angle)
    cl = np.array([here.cl for here in around])
    met = alpha[ahead] if ahead.any() else np.zeros(1)
    low = min(_LEAST_LOW, 1.15 * float(met.min()))
    high = max(_LEAST_HIGH, 1.15 * float(met.max()))
    angles = np.linspace(low, high, _ANGLES)
    curves = [
        here.section.lift_curve(np.radians(angles) + (0.0 if front else math.pi), here.table_mach)
        for here, front in zip(around, ahead, strict=True)
    ]
    values = np.concatenate([*curves, cl[ahead], np.zeros(1)])
    room = _ROOM * float(np.ptp(values))
    path = Line(
        "",
        np.append(alpha, alpha[0]),
        np.append(np.where(ahead, cl, np.nan), np.nan),
        "var(--rx-faint)",
        width=1.0,
    )
    across = Axis("α", (low, high), unit="°")
    chart = Chart(
        "Lift curve at this Mach number",
        across,
        Axis("C_l", (float(values.min()) - room, float(values.max()) + room)),
        (path,),
    )
    static = [
        float(here.section.lift_curve(np.array([here.alpha]), here.table_mach)[0])
        for here in around
    ]
    stall = [None if here.stall is None else math.degrees(here.stall[1]) for here in around]
    return RidePart(
        r=r,
        psi=psi_deg,
        out=around[0].radius,
        eye=_rounded(solution.design.rotor.radius * np.array(RIDE_EYE)),
        look=_rounded(solution.design.rotor.radius * np.array(RIDE_LOOK)),
        view=math.degrees(RIDE_VIEW),
        section=sections_of(around[0].section),
        outline=np.round(outline(around[0].section), 4).tolist(),
        u=[round(math.copysign(here.u, here.u_t), 1) for here in around],
        # The page rounds angles once more, to one decimal.
        theta=_rounded([math.degrees(here.theta) for here in around], 4),
        phi=_rounded([math.degrees(math.remainder(here.phi, 2.0 * math.pi)) for here in around], 4),
        alpha=_rounded(alpha, 4),
        cl=_rounded(cl, 3),
        mach=_rounded([here.table_mach for here in around]),
        lift=_rounded([here.lift / 1e3 for here in around], 3),
        where=[where(here.psi) for here in around],
        region=[here.region.value for here in around],
        margin=[
            None if here.stall_margin is None else number(math.degrees(here.stall_margin), 1)
            for here in around
        ],
        filled=[
            None if here.stall_share is None else round(here.stall_share, 3) for here in around
        ],
        seen=seen_around(around),
        static=_rounded(static, 3),
        stall=[None if angle is None else round(angle, 2) for angle in stall],
        angles=_rounded(angles),
        curves=[_rounded(curve, 3) for curve in curves],
        chart=drawn_chart(chart),
    )


def _rounded(values: Any, digits: int = 2) -> list[float]:
    return np.round(np.asarray(values, dtype=float), digits).tolist()

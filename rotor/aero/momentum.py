"""Momentum theory: the ideal rotor in hover, climb and forward flight (thesis §2.1, §2.4, §2.5).

Coefficients are of ρA(ΩR)² and ρA(ΩR)³ (eqs. 2.11, 2.12); inflow ratios are velocities over ΩR, positive down.
"""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class DiskFlow:
    """Flow through the disk; all over ΩR."""

    mu_x: float
    """Advance ratio in the disk plane, µ cos α."""
    mu_z: float
    """Advance ratio through the disk, µ sin α, positive down."""
    lambda0: float
    """Mean induced inflow of momentum theory."""

    @property
    def axial(self) -> float:
        """λ = µ_z + λ0, positive down."""
        return self.mu_z + self.lambda0

    @property
    def speed(self) -> float:
        """V, the speed at which the air leaves the disk, over ΩR."""
        return math.hypot(self.mu_x, self.axial)

    @property
    def mass_flow(self) -> float:
        """D = 1 + λ0 (µ_z + λ0)/V²: 2 in hover, near 1 at speed; 1 without any flow.

        λ0 V = C_T/2 gives dλ0/dC_T = 1/(2 V D). V D is Pitt and Peters' mass flow for changes of the load,
        V_m = (µ² + λ(λ + ν))/V with ν = λ0 and λ = µ_z + ν (Vertica 5, 1981; Peters and HaQuang, J. AHS 33, 1988).
        """
        speed = self.speed
        return 1.0 + self.lambda0 / speed * (self.axial / speed) if speed else 1.0


def axial_inflow(ct: float, climb: float) -> float:
    """λ_i = −λ_c/2 + √((λ_c/2)² + C_T/2) of the ideal rotor in axial flight, (2.24) with a uniform λ = λ_c + λ_i.

    √(C_T/2) in hover, less in a climb. In descent it is the root that goes on from hover, with the wake below the disk,
    up to the windmill: from there on λ_i = −λ_c/2 − √((λ_c/2)² − C_T/2), with the wake above. Between the two no steady
    wake exists: see `axial_flow_is_steady`. C_T below zero gives the mirrored root, as in `glauert_inflow`.
    """
    half = math.copysign(0.5, ct) * climb
    if is_windmill(ct, climb):
        return math.copysign(-half - math.sqrt(half * half - 0.5 * abs(ct)), ct)
    return math.copysign(math.sqrt(half * half + 0.5 * abs(ct)) - half, ct)


def is_windmill(ct: float, climb: float) -> bool:
    """Whether axial wind blows against the thrust at 2 v_h or more, and the wake with it: the windmill brake state."""
    wind = math.copysign(1.0, ct) * climb
    return wind < 0.0 and wind * wind >= 2.0 * abs(ct)


def axial_flow_is_steady(ct: float, climb: float) -> bool:
    """Whether momentum theory has an answer in axial flow: climb, slow descent, and the windmill brake state.

    Between V_c/v_h of −0.45 (`vortex_ring_edge`) and −2 the wake is a vortex ring or turbulent. The state with thrust
    and wind both reversed is the same one.
    """
    wind = math.copysign(1.0, ct) * climb
    return wind >= _EDGE * math.sqrt(0.5 * abs(ct)) or is_windmill(ct, climb)


VORTEX_RING_ONSET = -0.2
"""V_c/v_h from which measured inflow leaves momentum theory; with the next three from the source of `vortex_ring_edge`,
where it is point D."""
FASTEST_RING = 0.95
"""V/v_h from which there is no vortex ring state."""
_EDGE, _BELOW = -0.45, -1.5
"""V_c/v_h at which the vortex ring state begins and ends in vertical descent."""


def vortex_ring_edge(forward: float) -> float:
    """V_c/v_h of the upper edge of the vortex ring state at V/v_h; −∞ from V/v_h = 0.95 on.

    Within it the inflow grows so much with the rate of descent that no steady descent is stable:
    ½(N + X) + ½(N − X)(1 − (V/0.95 v_h)²)^0.2 with N = −0.45, X = −1.5 (Johnson, Model for Vortex Ring State Influence
    on Rotorcraft Flight Dynamics, NASA/TP-2005-213477, 2005, with its nominal parameters).
    """
    if forward >= FASTEST_RING:
        return -math.inf
    share = (1.0 - (forward / FASTEST_RING) ** 2) ** 0.2
    return 0.5 * (_EDGE + _BELOW) + 0.5 * (_EDGE - _BELOW) * share


def glauert_inflow(ct: float, mu_x: float, mu_z: float) -> tuple[float, float]:
    """λ0 = C_T/(2√(µ_x² + (µ_z + λ0)²)) and its slope dλ0/dC_T; eq. (2.30) with the axial flow of a tilted disk.

    For C_T ≥ 0 and µ_z ≥ 0 the root is unique, with less the search begins at that of a wake below the disk. C_T below
    zero gives the mirrored root.
    """
    sign = -1.0 if ct < 0.0 else 1.0
    half = 0.5 * abs(ct)
    axial = sign * mu_z
    # λ V(λ) = C_T/2 rises with λ, so the root lies between the two one-flow limits and Newton from above is safe.
    inflow = math.sqrt(half) + max(-axial, 0.0)
    low, high = 0.0, inflow
    for _ in range(60):
        speed = math.hypot(mu_x, axial + inflow)
        if speed == 0.0:
            return 0.0, 0.0
        error = inflow * speed - half
        slope = speed + inflow * (axial + inflow) / speed
        low, high = (low, inflow) if error > 0.0 else (inflow, high)
        step = error / slope if slope > 0.0 else math.inf
        # In fast descent λ V(λ) falls on part of the way.
        if axial < 0.0 and not low <= inflow - step <= high:
            step = inflow - 0.5 * (low + high)
        inflow -= step
        if abs(step) <= 1e-15 + 1e-14 * abs(inflow):
            break
    speed = math.hypot(mu_x, axial + inflow)
    slope = speed + inflow * (axial + inflow) / speed if speed > 0.0 else math.inf
    return sign * inflow, 0.5 / slope

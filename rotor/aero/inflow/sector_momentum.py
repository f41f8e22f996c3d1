"""Sector momentum: every piece of the disk answers its own load as if it were a rotor by itself.

    λ_i = d/(4 r F V) + λ0 k_x r cos ψ,      V = √(µ_x² + (µ_z + λ0)²)

The first term is the annulus balance (2.24) taken sector by sector: exactly the part w = p/2V of the linear actuator
disk that skips all coupling along the wake. It is too kind beyond µ 0.3: induced power 17–39 % low. The second puts
back the fore-aft gradient of the skewed wake, which does not change the power but corrects the lateral cyclic.
"""

import math
from dataclasses import dataclass

import numpy as np

from rotor.aero.inflow.peters_he import flow_parameters
from rotor.aero.inflow.tip_factor import tip_factor
from rotor.aero.inflow.wake_state import Wake
from rotor.arrays import Array

GRADIENT = 15.0 * math.pi / 32.0
"""k_x over tan(χ/2): what the exact actuator disk gives for a load that vanishes at the hub (three-state theory)."""


@dataclass(frozen=True, eq=False)
class SectorResponse:
    """λ_i(r, ψ) = gain(r) d(r, ψ) + offset(r, ψ) for one wake. No point depends on another's load."""

    gain: Array
    """1/(4 r F V), (elements,)."""
    gain_slopes: Array
    """Its slopes by (µ_x, µ_z, λ0), (3, elements)."""
    offset: Array
    """λ0 k_x r cos ψ, (elements, azimuths)."""
    offset_slopes: Array
    """(3, elements, azimuths)"""

    def induced(self, d: Array) -> Array:
        """λ_i for a load d = dC_T/dr of the whole rotor, (elements, azimuths)."""
        return self.gain[:, None] * d + self.offset

    def induced_by_wake(self, d: Array) -> Array:
        """∂λ_i by (µ_x, µ_z, λ0) at fixed load, (3, elements, azimuths)."""
        return self.gain_slopes[:, :, None] * d + self.offset_slopes

    def loop(self, slope: Array) -> Array:
        """1/(1 − gain K) for a pointwise slope K = ∂d/∂λ_i: the loop inflow → load → inflow, point by point.

        Its own transpose. K is negative where lift answers, so the divisor is above 1.
        """
        return 1.0 / (1.0 - self.gain[:, None] * slope)


def sector_response(r: Array, cos: Array, wake: Wake, blades: int, *, tip: bool = True) -> SectorResponse:
    """The response at elements r (n,) > 0 and azimuths with cos ψ (m,); `tip` for Prandtl's factor of finite blades."""
    flow = flow_parameters(wake)
    factor, factor_slope = tip_factor(r, wake, blades) if tip else (np.ones_like(r), np.zeros_like(r))
    gain = 1.0 / (4.0 * r * factor * flow.speed)
    by_axial = -gain * factor_slope / factor
    gain_slopes = -np.outer(flow.slopes[1] / flow.speed, gain) + np.outer([0.0, 1.0, 1.0], by_axial)
    shape = GRADIENT * np.outer(r, cos)
    strength = wake.lambda0 * flow.slopes[0] + np.array([0.0, 0.0, flow.half_skew])
    return SectorResponse(gain, gain_slopes, wake.lambda0 * flow.half_skew * shape, strength[:, None, None] * shape)

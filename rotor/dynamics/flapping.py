"""Flapping about an offset hinge, by harmonic balance (thesis §2.6).

    β'' + ν² β = Γ Σ (r − e) dC_T/dr dr − g S/(I Ω²) + k β_p,
    ν² = 1 + e S/I + k,    k = K/(I Ω²),    Γ = ρ π R⁵/(N_b I)

which is eqs. (2.37), (2.39) and (3.20) with the hinge at e instead of the centre, the blade load written by the smeared
dC_T/dr, the weight moment of the blade, and a spring K at the hinge that is free of load at β_p. Hinge and spring stand
for the root of a hingeless blade: together they give its first flap frequency ν. For a uniform blade from the hinge
outward e S/I = 3e/(2(R − e)). With β = β0 + β1c cos ψ + β1s sin ψ (2.41) the left side is
ν²β0 + (ν² − 1)(β1c cos ψ + β1s sin ψ): with the hinge at the centre the first-harmonic moment vanishes.
"""

import math
from dataclasses import dataclass

from rotor.design.blade import Rotor
from rotor.support.units import GRAVITY


@dataclass(frozen=True)
class FlapDynamics:
    """The flapping equation's constants."""

    hinge: float
    """Hinge offset e/R."""
    frequency_squared: float
    """ν², flap frequency over Ω, squared."""
    load_gain: float
    """Γ: turns Σ (r − e) dC_T/dr dr into flapping acceleration."""
    weight: float
    """g S/(I Ω²) [rad], the static moment of the blade's weight over I Ω²; 0 when neglected."""
    preload: float
    """k β_p [rad]: moment of the spring on a blade without coning, over I Ω²."""

    @property
    def droop(self) -> float:
        """Steady moments on the blade, without coning and lift, downward over I Ω² [rad]."""
        return self.weight - self.preload


def flap_dynamics(rotor: Rotor, density: float, *, blade_weight: bool) -> FlapDynamics:
    """Constants for a rotor in air of a density [kg/m³]."""
    blade = rotor.blade
    droop = GRAVITY * blade.flap_static_moment / (blade.flap_inertia * rotor.angular_speed**2)
    return FlapDynamics(
        hinge=blade.flap_hinge,
        frequency_squared=rotor.flap_frequency_squared,
        load_gain=density * math.pi * rotor.radius**5 / (rotor.blades * blade.flap_inertia),
        weight=droop if blade_weight else 0.0,
        preload=rotor.flap_spring_ratio * blade.flap_rest,
    )


def lock_number(rotor: Rotor, density: float, lift_slope: float) -> float:
    """γ = ρ a c R⁴/I with a density [kg/m³], a lift slope [1/rad] and the reference chord, as in published values."""
    return density * lift_slope * rotor.reference_chord * rotor.radius**4 / rotor.blade.flap_inertia

"""Where the wake of a blade lies, by a closed form.

What leaves the blade at r and azimuth ψ moves along with the flight, x = r cos ψ + µ_x t, y = r sin ψ, and down with
Beddoes' inflow (22nd European Rotorcraft Forum, 1985; Leishman, Principles of Helicopter Aerodynamics, ch. 10),

    inside the disk    dz/dt = −µ_z − λ0 (1 + E x − E |y|³)
    behind it          dz/dt = −µ_z − 2 λ0 (1 − E |y|³),        E = χ/2,  χ = atan2(µ_x, µ_z + λ0)

t is ψ_b − ψ for the blade at ψ_b now. Nothing rolls up or contracts. Below µ_x = 2.5 √(C_T/2) it passes over to the
helix of momentum theory at µ = 0, dz/dt = −µ_z − λ0: at no speed nothing lies behind the disk.
Axes of the shaft, over R: x aft, y to starboard, z up; velocities over ΩR.
"""

import math
from dataclasses import dataclass

import numpy as np

from rotor.aero.momentum import DiskFlow
from rotor.arrays import Array

GRADIENT = 0.5
"""E/χ. With 1, which others take, HART II agrees better, the XV-15 and the Gazelle worse: rotor/validation/hart2.py."""
SKEWED = 2.5
"""µ_x over √(C_T/2) from which a wake is wholly that of forward flight: µ 0.144 for a UH-60A at sea level, where it
trails at 81° to the shaft. Our choice: with 1.5 power up to µ 0.06 is 1 to 3 % less, further below momentum theory."""


@dataclass(frozen=True)
class WakeCourse(DiskFlow):
    """What the course of a wake depends on."""

    coning: float
    """β0 [rad], and β1c and β1s."""
    flap_1c: float
    flap_1s: float
    core: tuple[float, float]
    """Square of the core of a young tip vortex over R², and its growth by age."""

    @property
    def skewed(self) -> float:
        """0 for the helix of hover, 1 for the wake of forward flight, and smoothly between; C_T is 2 λ0 V."""
        share = min(self.mu_x / (SKEWED * math.sqrt(max(self.lambda0, 1e-9) * self.speed)), 1.0)
        return share * share * (3.0 - 2.0 * share)

    def flapping(self, psi: Array) -> Array:
        """β(ψ) [rad], shape of psi."""
        return self.coning + self.flap_1c * np.cos(psi) + self.flap_1s * np.sin(psi)

    def nodes(self, psi_b: Array, ages: Array, r: Array) -> Array:
        """Positions of what left the blades that are now at psi_b, (blades, ages, radii, 3)."""
        released = psi_b[:, None] - ages
        cos, sin = np.cos(released)[..., None], np.sin(released)[..., None]
        begin, y, t = r * cos, r * sin, ages[:, None]
        outward = np.minimum(np.abs(y), 1.0) ** 3
        skew = GRADIENT * math.atan2(self.mu_x, self.axial)
        inside = t + np.zeros_like(y)
        if self.mu_x > 0.0:
            way = np.sqrt(np.maximum(1.0 - y * y, 0.0)) - begin
            inside = np.clip(way, 0.0, self.mu_x * t) / self.mu_x
        sunk = (1.0 - skew * outward) * (2.0 * t - inside) + skew * inside * (begin + 0.5 * self.mu_x * inside)
        sunk = t + self.skewed * (sunk - t)
        z = self.flapping(released)[..., None] * r - self.mu_z * t - self.lambda0 * sunk
        return np.stack([begin + self.mu_x * t, y, z], axis=-1)


def tip_core(chord: float, thrust: float, blades: int, reynolds: float) -> tuple[float, float]:
    """c² over R² of a young tip vortex, and its growth by age: (0.2 chord)² + 4 · 1.25643 (1 + a1 Γ/ν) ν t.

    With Squire's a1 = 1e-4 (Leishman, ch. 10). chord: at 0.9 R, over R; thrust: C_T; reynolds: ΩR²/ν.
    """
    grown = 1.0 + 1e-4 * 2.0 * thrust / blades * reynolds  # Γ of the tip vortex is near 2 C_T ΩR²/N_b.
    return (0.2 * chord) ** 2, 4.0 * 1.25643 * grown / reynolds

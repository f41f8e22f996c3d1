"""Active twist, a function of azimuth: θ_act(r, ψ) = shape(r) Σ_n A_n cos(nψ − φ_n), added to the twist law."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from rotor.arrays import Array


@dataclass(frozen=True)
class Harmonic:
    """One harmonic of rotor speed."""

    per_rev: int
    amplitude: float
    """Twist of the tip relative to the root [rad]."""
    phase: float = 0.0
    """φ [rad]: the tip is most nose-up at ψ = φ/n."""

    def __post_init__(self) -> None:
        if not 1 <= self.per_rev <= 12:
            raise ValueError(f"harmonic {self.per_rev}/rev is outside 1…12: 1 and 2 move power, 3 to 5 vibration")
        if not (math.isfinite(self.amplitude) and 0.0 <= self.amplitude <= 0.35 and math.isfinite(self.phase)):
            raise ValueError(f"active-twist amplitude {math.degrees(self.amplitude):g}° is outside 0…20°: choose less")


@dataclass(frozen=True)
class ActiveTwist:
    """Harmonics of twist with one shape along the span. Not used in hover, where nothing varies with azimuth."""

    harmonics: tuple[Harmonic, ...]
    stations: tuple[float, ...] = (0.13, 1.0)
    """r/R, ascending."""
    shape: tuple[float, ...] = (0.0, 1.0)
    """Twist at the stations over that of the tip; linear between, constant beyond."""

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.shape) or len(self.stations) < 2:
            raise ValueError(
                f"{len(self.stations)} stations but {len(self.shape)} shape values: give two or more pairs"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(f"active-twist stations {list(self.stations)} must ascend: sort them")

    def __call__(self, r: Array, psi: Array, derivative: int = 0) -> Array:
        """θ_act or its derivatives by ψ [rad], (elements, azimuths)."""
        wave = np.zeros_like(psi)
        for harmonic in self.harmonics:
            size = harmonic.amplitude * harmonic.per_rev**derivative
            wave = wave + size * np.cos(harmonic.per_rev * psi - harmonic.phase + 0.5 * math.pi * derivative)
        return np.outer(np.interp(r, self.stations, self.shape), wave)


def active_twist_record(twist: ActiveTwist) -> dict[str, Any]:
    """The record of a design file, with angles in degrees."""
    return {
        "harmonics": [
            {"per_rev": h.per_rev, "amplitude_deg": math.degrees(h.amplitude), "phase_deg": math.degrees(h.phase)}
            for h in twist.harmonics
        ],
        "stations": list(twist.stations),
        "shape": list(twist.shape),
    }


def read_active_twist(record: Any) -> ActiveTwist:
    """The inverse; ValueError with one sentence for any other record."""
    try:
        harmonics = tuple(
            Harmonic(int(row["per_rev"]), math.radians(row["amplitude_deg"]), math.radians(row.get("phase_deg", 0.0)))
            for row in record["harmonics"]
        )
        stations = tuple(float(value) for value in record.get("stations", (0.13, 1.0)))
        shape = tuple(float(value) for value in record.get("shape", (0.0, 1.0)))
    except (KeyError, TypeError, AttributeError):
        raise ValueError(
            f"design file key 'active_twist' is {record!r}: write "
            '{"harmonics": [{"per_rev": 2, "amplitude_deg": 1, "phase_deg": 0}]}'
        ) from None
    return ActiveTwist(harmonics, stations, shape)

"""Pitch given at harmonics of rotor speed: active twist, shape(r) Σ_n A_n cos(nψ − φ_n), and n/rev root pitch.

Both are written `N:DEG:PHASE[,…]`: the harmonic, its amplitude and φ_n in degrees. `3:1:180` is 1° at 3/rev, most
nose-up at ψ = 180°/3. −DEG at PHASE is DEG at PHASE + 180.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, cast

import numpy as np

from rotor.support.arrays import Array
from rotor.support.units import degrees_text

HIGHEST = 8
"""Harmonic. Above it the 24 azimuths of a lifting line have fewer than three for a wave."""
LARGEST_TWIST, LARGEST_PITCH = math.radians(20.0), math.radians(10.0)
"""Amplitudes of active twist and of root pitch. Higher-harmonic control has been tested to a few degrees."""


@dataclass(frozen=True)
class Harmonic:
    """One harmonic A cos(nψ − φ) of rotor speed."""

    per_rev: int
    amplitude: float
    """Amplitude of active twist, tip relative to root, or of root pitch [rad]."""
    phase: float = 0.0
    """φ [rad], 0…2π: most nose-up at ψ = φ/n."""

    def __post_init__(self) -> None:
        if not 1 <= self.per_rev <= HIGHEST:
            raise ValueError(
                f"harmonic {self.per_rev:g}/rev is outside 1…{HIGHEST}: choose a value inside"
            )
        if not (
            math.isfinite(self.amplitude) and 0.0 <= self.amplitude <= LARGEST_TWIST * (1.0 + 1e-12)
        ):
            degrees = math.degrees(self.amplitude)
            raise ValueError(
                f"amplitude {degrees:g}° at {self.per_rev}/rev is outside 0…20°: choose a value inside"
            )
        if not math.isfinite(self.phase):
            raise ValueError(
                f"phase {self.phase:g} at {self.per_rev}/rev is not finite: give an angle"
            )
        # A single remainder gives 2π for −1e-20.
        object.__setattr__(self, "phase", self.phase % math.tau % math.tau)


@dataclass(frozen=True)
class ActiveTwist:
    """Harmonics of twist with one shape along the span. Not used in hover, where nothing varies with azimuth."""

    harmonics: tuple[Harmonic, ...]
    stations: tuple[float, ...] = (0.13, 1.0)
    """r/R, ascending."""
    shape: tuple[float, ...] = (0.0, 1.0)
    """Twist at the stations over that of the tip; linear between, constant beyond."""

    def __post_init__(self) -> None:
        check_harmonics(self.harmonics, "active twist")
        if len(self.stations) != len(self.shape) or len(self.stations) < 2:
            raise ValueError(
                f"{len(self.stations)} stations but {len(self.shape)} shape values: give 2 or more pairs"
            )
        if any(low >= high for low, high in pairwise(self.stations)):
            raise ValueError(f"active-twist stations {list(self.stations)} must ascend: sort them")

    def __call__(self, r: Array, psi: Array, derivative: int = 0) -> Array:
        """θ_act or its derivatives by ψ [rad], (elements, azimuths)."""
        wave = np.zeros_like(psi)
        for harmonic in self.harmonics:
            size = harmonic.amplitude * harmonic.per_rev**derivative
            wave = wave + size * np.cos(
                harmonic.per_rev * psi - harmonic.phase + 0.5 * math.pi * derivative
            )
        return np.outer(np.interp(r, self.stations, self.shape), wave)


def linear_active_twist(harmonics: tuple[Harmonic, ...], root: float) -> ActiveTwist | None:
    """Active twist linear along the blade from its root cut-out `root` (r/R) to the tip; None without harmonics."""
    return ActiveTwist(harmonics, (root, 1.0)) if harmonics else None


def root_pitch(harmonics: tuple[Harmonic, ...]) -> ActiveTwist:
    """n/rev root pitch as a field over the disk: the same along the whole blade."""
    return ActiveTwist(harmonics, (0.0, 1.0), (1.0, 1.0))


def check_harmonics(harmonics: tuple[Harmonic, ...], what: str) -> None:
    """Raise ValueError where a harmonic comes twice; so there are at most `HIGHEST`."""
    orders = [harmonic.per_rev for harmonic in harmonics]
    twice = next((n for k, n in enumerate(orders) if n in orders[:k]), None)
    if twice is not None:
        raise ValueError(f"{what} has {twice}/rev twice: give each harmonic once")


def check_root_pitch(harmonics: tuple[Harmonic, ...]) -> None:
    """Raise ValueError for harmonics that root pitch cannot have."""
    check_harmonics(harmonics, "root pitch")
    for harmonic in harmonics:
        if harmonic.per_rev == 1:
            raise ValueError(
                f"root pitch at 1/rev is cyclic pitch, which is trimmed: choose 2 to {HIGHEST}/rev, or a stand's cyclic"
            )
        if harmonic.amplitude > LARGEST_PITCH * (1.0 + 1e-12):
            degrees = math.degrees(harmonic.amplitude)
            raise ValueError(
                f"root pitch {degrees:g}° at {harmonic.per_rev}/rev is outside 0…10°: choose one inside"
            )


PerRev = str | Sequence["Harmonic | Sequence[float] | Mapping[str, Any]"]
"""What `read_harmonics` reads."""
_FORM = "write N:DEG:PHASE, separated by commas, for example 3:1:180"


def read_harmonics(value: PerRev, name: str) -> tuple[Harmonic, ...]:
    """Harmonics from `N:DEG:PHASE[,…]`, or from a list of (N, DEG, PHASE), of rows of a design file, or of `Harmonic`.

    In the order of N; those of zero amplitude are left out. `name`: of the input, for the ValueError with one sentence
    that any other value raises.
    """
    items: list[Any]
    if isinstance(value, str):
        items = [item.split(":") for item in value.split(",")] if value.strip() else []
    elif isinstance(value, Sequence):  # pyright: ignore[reportUnnecessaryIsInstance] - files and notebooks hold anything
        items = list(value)
    else:
        raise ValueError(f"{name} is {value!r:.80}: {_FORM}")
    harmonics = tuple(
        item if isinstance(item, Harmonic) else _harmonic(item, name) for item in items
    )
    check_harmonics(harmonics, name)
    return tuple(
        sorted((wave for wave in harmonics if wave.amplitude), key=lambda wave: wave.per_rev)
    )


def _harmonic(item: Any, name: str) -> Harmonic:
    try:
        if isinstance(item, Mapping):
            row = cast(Mapping[str, Any], item)
            item = row["per_rev"], row["amplitude_deg"], row.get("phase_deg", 0.0)
        if any(isinstance(number, bool) for number in item):
            raise ValueError
        per_rev, amplitude, phase = (float(number) for number in item)
    except (KeyError, TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} {_shown(item)} is not understood: {_FORM}") from None
    if per_rev % 1.0 or not all(map(math.isfinite, (per_rev, amplitude, phase))):
        raise ValueError(
            f"{name} {_shown(item)} needs a whole number and two finite angles: {_FORM}"
        )
    # In degrees, so that −DEG at PHASE is DEG at PHASE + 180 to the last digit.
    return Harmonic(
        int(per_rev),
        math.radians(abs(amplitude)),
        math.radians((phase + 180.0 * (amplitude < 0.0)) % 360),
    )


def _shown(item: Any) -> str:
    """An item as it was written."""
    return (
        f"{':'.join(map(str, cast(list[Any], item)))!r:.80}"
        if isinstance(item, list | tuple)
        else f"{item!r:.80}"
    )


def harmonics_text(harmonics: tuple[Harmonic, ...]) -> str:
    """`N:DEG:PHASE[,…]`, which `read_harmonics` reads back, to a unit in the last place."""
    return ",".join(
        f"{wave.per_rev}:{degrees_text(wave.amplitude)}:{degrees_text(wave.phase)}"
        for wave in harmonics
    )


def harmonics_record(harmonics: tuple[Harmonic, ...]) -> list[dict[str, Any]]:
    """Rows of a record, with angles in degrees."""
    return [
        {
            "per_rev": harmonic.per_rev,
            "amplitude_deg": float(degrees_text(harmonic.amplitude)),
            "phase_deg": float(degrees_text(harmonic.phase)),
        }
        for harmonic in harmonics
    ]


def active_twist_record(twist: ActiveTwist) -> dict[str, Any]:
    """The record of a design file, with angles in degrees."""
    return {
        "harmonics": harmonics_record(twist.harmonics),
        "stations": list(twist.stations),
        "shape": list(twist.shape),
    }


def read_active_twist(record: Any) -> ActiveTwist:
    """The inverse; ValueError with one sentence for any other record."""
    try:
        rows = record["harmonics"]
        stations = tuple(float(value) for value in record.get("stations", (0.13, 1.0)))
        shape = tuple(float(value) for value in record.get("shape", (0.0, 1.0)))
    except (KeyError, TypeError, AttributeError):
        raise ValueError(
            f"design file key 'active_twist' is {record!r:.80}: write "
            '{"harmonics": [{"per_rev": 2, "amplitude_deg": 1, "phase_deg": 0}]}'
        ) from None
    return ActiveTwist(read_harmonics(rows, "active twist"), stations, shape)

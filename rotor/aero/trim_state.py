"""The trim of a rotor as one value: pitch, shaft tilt, flapping and mean inflow."""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rotor.arrays import Array, Integers

Unknown = Literal["collective", "cyclic_1c", "cyclic_1s", "shaft_tilt", "coning", "flap_1c", "flap_1s", "lambda0"]
"""Name of one of the eight quantities, any of which a trim may solve for."""


@dataclass(frozen=True)
class TrimState:
    """The trim, all angles in radians. θ = θ0 + θ1c cos ψ + θ1s sin ψ, β likewise."""

    collective: float = 0.0
    """θ0, the pitch at 0.75 R."""
    cyclic_1c: float = 0.0
    cyclic_1s: float = 0.0
    shaft_tilt: float = 0.0
    """α, positive forward."""
    coning: float = 0.0
    """β0, positive up."""
    flap_1c: float = 0.0
    """β1c, negative when the disk tilts back."""
    flap_1s: float = 0.0
    lambda0: float = 0.0
    """Mean induced inflow of momentum theory, over ΩR."""

    @classmethod
    def from_array(cls, values: ArrayLike) -> "TrimState":
        """The state of eight numbers in the order of the fields."""
        return cls(*np.asarray(values, dtype=float).tolist())

    def array(self, names: Sequence[Unknown] | None = None) -> Array:
        """The quantities named, in that order; all eight by default."""
        return np.array([getattr(self, name) for name in names] if names else list(vars(self).values()), dtype=float)

    def moved(self, names: Sequence[Unknown], step: Array) -> "TrimState":
        """The state with a step, (names,), added to the quantities named."""
        ahead = dict(vars(self))
        for name, by in zip(names, step.tolist(), strict=True):
            ahead[name] += by
        return TrimState(**ahead)


STATE_NAMES: tuple[Unknown, ...] = tuple(field.name for field in fields(TrimState))  # pyright: ignore[reportAssignmentType]
"""The eight names, in the order of `TrimState.array`."""


@cache
def places_of(unknowns: tuple[Unknown, ...]) -> Integers:
    """The places of these quantities in `TrimState.array`, (unknowns,)."""
    return np.array([STATE_NAMES.index(unknown) for unknown in unknowns], dtype=np.int64)

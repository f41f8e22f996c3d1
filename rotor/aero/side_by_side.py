"""Section data of equal blades that lie beside each other: their elements one after another, as those of one blade."""

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from rotor.support.arrays import fix

_SHARED = frozenset(
    {"tables", "held", "missing", "held_missing", "moment_tables", "added", "scatter"}
)
"""Arrays that are not by element."""
_ROWS = frozenset({"reference"})
"""Arrays by row, then by element."""


def side_by_side(data: Any, count: int) -> Any:
    """Data of `Problem.grid_data` for so many blades with the same data."""

    def repeated(name: str, value: Any) -> Any:
        if hasattr(value, "_asdict"):
            return side_by_side(value, count)
        if name in _SHARED or not np.size(value) or not np.ndim(value):
            return value
        array = cast(NDArray[Any], value)
        out: NDArray[Any] = np.concatenate([array] * count, axis=1 if name in _ROWS else 0)
        if not array.flags.writeable:
            fix(out)  # Kernels are compiled for either kind of array.
        return out

    return type(data)(**{name: repeated(name, value) for name, value in data._asdict().items()})

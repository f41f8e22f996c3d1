"""Ranges in text: `0.05:0.40:0.05`, `0.40:0.05:-0.05`, `0.1,0.3` or one number."""

import math

_MOST_VALUES = 10_000
"""Largest number of values of a range."""


def parse_range(text: str) -> list[float]:
    """`a:b:step`, both ends included (falling with a negative step), or a comma-separated list, or one number."""
    try:
        if ":" not in text:
            values = [float(item) for item in text.split(",")]
        else:
            first, last, step = (float(item) for item in text.split(":"))
            if step * (last - first) < 0.0:
                backward, reversed_ends = f"{first:g}:{last:g}:{-step:g}", f"{last:g}:{first:g}:{step:g}"
                raise _NeverEnds(f"range {text!r} never reaches its end: write {backward} or {reversed_ends}")
            count = math.floor((last - first) / step + 1e-9) + 1
            values = [first + k * step for k in range(min(count, _MOST_VALUES + 1))]
    except _NeverEnds:
        raise
    except (ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(f"range {text!r} is not understood: write a:b:step, for example 0.05:0.40:0.05") from None
    if len(values) > _MOST_VALUES:
        raise ValueError(f"range {text!r} has more than {_MOST_VALUES:,} values: take a larger step")
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"range {text!r} holds a value that is not a number: write for example 0.05:0.40:0.05")
    return [round(value, 12) for value in values]


class _NeverEnds(ValueError):
    """A step away from the end of the range."""

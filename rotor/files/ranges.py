"""Ranges in text: `0.05:0.40:0.05`, `0.1,0.3` or one number."""

import math

_MOST_VALUES = 10_000
"""Largest number of values of a range."""


def parse_range(text: str) -> list[float]:
    """`a:b:step`, both ends included, or a comma-separated list, or one number."""
    try:
        if ":" not in text:
            values = [float(item) for item in text.split(",")]
        else:
            low, high, step = (float(item) for item in text.split(":"))
            if not (step > 0.0 and high >= low):
                raise ValueError
            count = math.floor((high - low) / step + 1e-9) + 1
            values = [low + k * step for k in range(min(count, _MOST_VALUES + 1))]
    except (ValueError, OverflowError):
        raise ValueError(f"range {text!r} is not understood: write a:b:step, for example 0.05:0.40:0.05") from None
    if len(values) > _MOST_VALUES:
        raise ValueError(f"range {text!r} has more than {_MOST_VALUES:,} values: take a larger step")
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"range {text!r} holds a value that is not a number: write for example 0.05:0.40:0.05")
    return [round(value, 12) for value in values]

"""Ranges as people write them: `0.05:0.40:0.05`, `0.1,0.3` or one number."""

import math


def parse_range(text: str) -> list[float]:
    """`a:b:step`, both ends included, or a comma-separated list, or one number."""
    try:
        if ":" not in text:
            values = [float(item) for item in text.split(",")]
        else:
            low, high, step = (float(item) for item in text.split(":"))
            if not (step > 0.0 and high >= low and (high - low) / step < 10_000):
                raise ValueError
            values = [low + k * step for k in range(math.floor((high - low) / step + 1e-9) + 1)]
    except (ValueError, OverflowError):
        raise ValueError(f"range {text!r} is not understood: write a:b:step, for example 0.05:0.40:0.05") from None
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"range {text!r} holds a value that is not a number: write for example 0.05:0.40:0.05")
    return [round(value, 12) for value in values]

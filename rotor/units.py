"""Units and physical constants used in several folders. Everything inside `rotor` is SI."""

KNOT = 1852.0 / 3600.0
"""One knot [m/s], exact."""
GRAVITY = 9.80665
"""Standard gravity [m/s²] (ISO 2533)."""

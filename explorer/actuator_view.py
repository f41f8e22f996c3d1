"""The camera for the blade cut open: from behind, above and inboard, as near as its corners allow."""

import math

import numpy as np

from explorer.actuator_cut import SPAN_SCALE
from explorer.view import FIELD_OF_VIEW, Camera

_AROUND = math.radians(46.0)
"""From behind the trailing edge towards the root."""
_ABOVE = math.radians(33.0)
_MARGIN = 0.93


def fit_cut(radius: float, aspect: float) -> Camera:
    """Root at the near left, tip at the far right, trailing edge towards the viewer."""
    backward = np.array(
        [-math.sin(_AROUND) * math.cos(_ABOVE), -math.cos(_AROUND) * math.cos(_ABOVE), math.sin(_ABOVE)]
    )
    right = np.cross([0.0, 0.0, 1.0], backward)
    right /= np.linalg.norm(right)
    up = np.cross(backward, right)
    inner, outer = (SPAN_SCALE * radius * (r - 0.55) for r in (0.045, 1.01))
    points = np.array([[x, y, z] for x in (inner, outer) for y in (-0.42, 0.2) for z in (-0.12, 0.2)])
    tan_v = _MARGIN * math.tan(FIELD_OF_VIEW / 2.0)
    tan_h = tan_v * max(aspect, 0.2)
    middle = np.zeros(3)
    distance = 5.0
    for _ in range(30):  # Centre what is seen, then come as near as it allows.
        depth = (points - middle) @ backward
        across, height = (points - middle) @ right, (points - middle) @ up
        distance = float(np.max(np.maximum(np.abs(across) / tan_h, np.abs(height) / tan_v) + depth))
        seen = np.stack((across, height), 1) / (distance - depth)[:, None]
        shift = 0.5 * (seen.max(axis=0) + seen.min(axis=0)) * distance
        middle = middle + 0.7 * (shift[0] * right + shift[1] * up)
    return Camera(middle + distance * backward, middle)

"""The camera for the blade cut open: from behind, above and inboard, as near as its corners allow."""

import math

import numpy as np

from explorer.picture.camera_views import Camera, framed
from explorer.tabs.actuator.cut import SPAN_SCALE

_AROUND = math.radians(46.0)
"""From behind the trailing edge towards the root."""
_ABOVE = math.radians(33.0)
_MARGIN = 0.93


def fit_cut(radius: float, aspect: float) -> Camera:
    """Root at the near left, tip at the far right, trailing edge towards the viewer."""
    backward = np.array(
        [-math.sin(_AROUND) * math.cos(_ABOVE), -math.cos(_AROUND) * math.cos(_ABOVE), math.sin(_ABOVE)]
    )
    inner, outer = (SPAN_SCALE * radius * (r - 0.55) for r in (0.045, 1.01))
    points = np.array([[x, y, z] for x in (inner, outer) for y in (-0.42, 0.2) for z in (-0.12, 0.2)])
    return framed(points, backward, aspect, _MARGIN)

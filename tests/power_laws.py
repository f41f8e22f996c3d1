"""Power laws of torque above its zero through tables of measured points, and the change between two of them."""

import math
from dataclasses import dataclass

import numpy as np

from rotor.validation.compare import load_set


@dataclass(frozen=True)
class LawTorque:
    """Torque above its zero at one C_T, by a power law through a table."""

    logarithm: float
    """ln C_Q"""
    variance: float
    """Of `logarithm`."""
    scatter: float
    """Of the points about the law, as a part of C_Q."""


def power_law(name: str, least: float, ct: float) -> LawTorque:
    """The torque of a set at one C_T, by a power law through its points from the C_T `least` up."""
    points = [point for point in load_set(name).points if point["ct"] >= least]
    x, y = (np.log([point[column] for point in points]) for column in ("ct", "cq_above_zero"))
    law, covariance = np.polyfit(x - math.log(ct), y, 1, cov=True)
    left = y - np.polyval(law, x - math.log(ct))
    scatter = math.sqrt(left @ left / (len(points) - 2))
    return LawTorque(float(law[1]), float(covariance[1, 1]), scatter)


def change_of(torque: LawTorque, other: LawTorque) -> tuple[float, float]:
    """The change of torque from the other one, as a part of that, and its standard error."""
    ratio = math.exp(torque.logarithm - other.logarithm)
    return ratio - 1.0, ratio * math.sqrt(torque.variance + other.variance)

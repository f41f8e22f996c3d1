"""Scatter of measured points about a smooth law that is fitted to them."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from rotor.support.arrays import Array


def scatter_about_law(
    points: Sequence[Mapping[str, float]], quantity: str, degrees: Mapping[str, int]
) -> float:
    """Standard scatter of a measured quantity, as a part of its value [-].

    The law is a sum of polynomials, ln|q| = a + Σ b x + c x² + …, with x = ln of each column of `degrees` up to its
    degree, by least squares; its coefficients are taken off the number of points. ValueError for fewer points.
    """
    logs = {name: np.log([point[name] for point in points]) for name in degrees}
    terms: list[Array] = [np.ones(len(points))]
    for name, degree in degrees.items():
        centred = logs[name] - logs[name].mean()
        terms += [centred**power for power in range(1, degree + 1)]
    spare = len(points) - len(terms)
    if spare < 1:
        raise ValueError(f"{len(points)} points do not show their scatter about {len(terms)} terms")
    values = np.log(np.abs([point[quantity] for point in points]))
    law = np.stack(terms, axis=1)
    coefficients = np.linalg.lstsq(law, values)[0]
    rest: Array = values - law @ coefficients
    return math.sqrt(float(rest @ rest) / spare)

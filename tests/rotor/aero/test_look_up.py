"""The polynomials of a cell against NumPy's."""

from typing import Any

import numpy as np
from numpy.polynomial import polynomial
from numpy.testing import assert_allclose

from rotor.aero.look_up import surface
from rotor.compiled import compiled


@compiled()
def at_all(cell: Any, u: Any, v: Any) -> Any:
    out = np.empty((3, len(u)))
    for k in range(len(u)):
        out[0, k], out[1, k], out[2, k] = surface(cell, u[k], v[k])
    return out


def test_polynomial_and_its_slopes():
    random = np.random.default_rng(2)
    tables = random.standard_normal((2, 3, 3, 2, 4, 4))
    u, v = random.uniform(0.0, 1.0, (2, 500))
    cell = tables[1, 2, 0, 1]
    found = at_all(cell, u, v)
    assert_allclose(found[0], polynomial.polyval2d(u, v, cell), rtol=0, atol=1e-14)
    assert_allclose(found[1], polynomial.polyval2d(u, v, polynomial.polyder(cell, axis=0)), rtol=0, atol=3e-14)
    assert_allclose(found[2], polynomial.polyval2d(u, v, polynomial.polyder(cell, axis=1)), rtol=0, atol=3e-14)

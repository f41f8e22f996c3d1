"""Radial functions of the dynamic wake: table, published series, orthonormality."""

import math

import numpy as np
from inflow_tables import table
from numpy.testing import assert_allclose

from rotor.aero.inflow.peters_he import double_factorial, mode_set, norm, radial_function, radial_functions


def series(m: int, n: int, r: np.ndarray) -> np.ndarray:
    """φ_n^m as the published power series."""
    total = np.zeros_like(r)
    for q in range(m, n, 2):
        below = double_factorial(q - m) * double_factorial(q + m) * double_factorial(n - q - 1)
        total += r**q * (-1.0) ** ((q - m) // 2) * double_factorial(n + q) / below
    return math.sqrt((2 * n + 1) * norm(m, n)) * total


def test_radial_functions_match_the_table():
    radii = ["0", "0.1", "0.25", "0.5", "0.75", "0.9", "1.0"]
    for row in table("gdw_phi"):
        m, n = int(row["m"]), int(row["n"])
        assert_allclose(norm(m, n), float(row["H"]), rtol=0, atol=1e-10)  # The table has ten decimals of H.
        expected = [float(row[f"r={r}"]) for r in radii]
        # The table has eight decimals.
        assert_allclose(radial_function(m, n, [float(r) for r in radii]), expected, rtol=0, atol=1e-8)


def test_radial_functions_are_the_published_series():
    r = np.linspace(0.0, 1.0, 21)
    for m, n in mode_set(8):
        # The series loses a few digits to cancellation at n = 9.
        assert_allclose(radial_function(m, n, r), series(m, n, r), rtol=0, atol=1e-11)


def test_first_functions_by_hand():
    r = np.linspace(0.0, 1.0, 5)
    assert_allclose(radial_function(0, 1, r), math.sqrt(3.0), rtol=1e-15)
    assert_allclose(radial_function(1, 2, r), r * math.sqrt(15.0 / 2.0), rtol=1e-14)


def test_functions_of_one_harmonic_are_orthonormal():
    node, weight = np.polynomial.legendre.leggauss(40)  # Exact to degree 79; ν²φφ has at most 34.
    nu, weight = 0.5 * (node + 1.0), 0.5 * weight
    for m in range(17):
        modes = tuple(mode for mode in mode_set(16) if mode[0] == m)
        weighted = nu * radial_functions(modes, np.sqrt(1.0 - nu**2))
        assert_allclose((weighted * weight) @ weighted.T, np.eye(len(modes)), rtol=0, atol=1e-12)


def test_size_of_the_triangular_set():
    assert [len(mode_set(order)) for order in (4, 8)] == [9, 25]
    assert [len(mode_set(order, 1)) for order in (4, 8)] == [6, 20]

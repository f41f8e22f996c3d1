"""The Jacobian of a trim against differences of its residuals."""

import numpy as np
from numpy.testing import assert_allclose

from rotor.aero.elements import Problem, evaluate_elements
from rotor.aero.sums import slopes
from rotor.aero.trim_state import TrimState
from rotor.trim.equations import jacobian, residuals, unknowns_of


def check_jacobian(problem: Problem, state: TrimState) -> None:
    """Every column by central differences; the step of the inflow is smaller, as the inflow itself is."""
    unknowns = unknowns_of(problem.design)
    elements = evaluate_elements(problem, state)
    exact = jacobian(problem, elements, slopes(problem, elements, unknowns, None))
    assert exact.shape == (len(unknowns), len(unknowns))
    for k, unknown in enumerate(unknowns):
        step = np.array([1e-6 * (0.1 if unknown == "lambda0" else 1.0)])
        ahead, behind = (
            residuals(problem, evaluate_elements(problem, state.moved([unknown], sign * step))) for sign in (1.0, -1.0)
        )
        assert_allclose(exact[:, k], (ahead - behind) / (2.0 * step[0]), rtol=2e-5, atol=2e-7)

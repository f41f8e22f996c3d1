"""Trims of a drag, which begin on the secant through the last two."""

from typing import Any

import pytest

from rotor import Design, make_design, solve
from rotor.actuator import with_actuator
from rotor.trim import analyse
from rotor.trim.newton import FEW_DIGITS
from rotor.trim.secant import steps_ahead

FIRST, SECOND = make_design(twist="linear:-10", mu=0.2), make_design(twist="linear:-10.4", mu=0.2)


@pytest.mark.parametrize(
    ("changed", "steps"),
    [
        *(({"twist": f"linear:{rate}"}, steps) for rate, steps in
          ((-10.4, 0.0), (-10.8, 1.0), (-11.4, 2.5), (-10.3, -0.25), (-10.0, -1.0), (-12.0, None))),
        *((changed, None) for changed in
          ({"mu": 0.21}, {"twist": "linear:-10.4", "mu": 0.21}, {"twist": "segments:-10,-8@0.6"}, {"mu": 0.0},
           {"inflow": "drees"}, {"rotor": "bo105"}, {"preset": "thesis"}, {"pitch_per_rev": "3:1:0"})),
    ],
    ids=str,
)  # fmt: skip
def test_steps_of_one_slider_are_counted_and_anything_else_begins_from_the_last_trim(
    changed: dict[str, Any], steps: float | None
):
    found = steps_ahead(
        FIRST, SECOND, make_design(**{"twist": "linear:-10.8", "mu": 0.2} | changed)
    )
    assert found == (steps if steps is None else pytest.approx(steps, abs=1e-9))


def test_many_numbers_count_where_they_move_in_proportion():
    a, b, c = (make_design(mu=0.2 + 0.01 * k, mass_kg=8000.0 + 100.0 * k) for k in range(3))
    assert steps_ahead(a, b, c) == pytest.approx(1.0)
    assert steps_ahead(a, b, c.at(mass_kg=8300.0)) is None
    assert steps_ahead(a, a, b) is None
    a, b, c = (with_actuator(FIRST, f"MFC_P1,drive={drive}") for drive in (10, 20, 25))
    assert steps_ahead(a, b, c) == pytest.approx(0.5)


@pytest.mark.parametrize("models", [{}, {"inflow": "pitt-peters"}, {"bending": True}], ids=str)
@pytest.mark.parametrize("slider", ["twist", "mu", "mass_kg", "altitude_m"])
def test_a_drag_takes_fewer_passes(models: dict[str, Any], slider: str):
    """It turns round, and jumps at the end. Near the tolerance a frame may take one more."""
    step = {"twist": -0.25, "mu": 0.002, "mass_kg": 50.0, "altitude_m": 50.0}[slider]
    begun = {"twist": -10.0, "mu": 0.2, "mass_kg": 8000.0, "altitude_m": 500.0}[slider]

    def design(at: float) -> Design:
        value = begun + at * step
        asked: dict[str, Any] = {
            "mu": 0.2,
            slider: f"linear:{value}" if slider == "twist" else value,
        }
        return make_design(**asked | models)

    def passes(through: bool) -> list[int]:
        latest, each = solve(design(0.0)), list[int]()
        for at in (1.0, 2.0, 3.5, 4.0, 3.5, 2.5, 3.0, 15.0):
            latest = analyse(
                design(at), latest if through else latest.start, FEW_DIGITS
            ).solution.require()
            each.append(latest.passes)
        return each

    plain, secant = passes(False), passes(True)
    assert sum(secant) < sum(plain)
    assert all(one <= other + 1 for one, other in zip(secant, plain, strict=True)), (secant, plain)

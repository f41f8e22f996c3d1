"""Fixtures for trims."""

import pytest
from patched import Patch

from rotor import Design, make_design
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.problem import build_problem
from rotor.trim import forward


@pytest.fixture
def same_course(patch: Patch) -> WakeCourse:
    """The course of every wake of a lifting line: that of the UH-60A at µ = 0.2."""
    course = forward.with_course(build_problem(make_design(mu=0.2))).course

    def given(design: Design) -> WakeCourse:
        del design
        return course

    patch("rotor.trim.forward.found_course", given)
    return course

# pyright: reportUnnecessaryTypeIgnoreComment=error
"""Arguments of the wrong type. Where the type check of `make lint` accepts one, it reports its comment as needless."""

import pytest

import rotor

DESIGN = rotor.make_design()


def test_the_type_check_and_the_call_refuse_a_value_of_the_wrong_type():
    for call in (
        lambda: rotor.make_design(mass_kg="heavy"),  # pyright: ignore[reportArgumentType]
        lambda: rotor.make_design(mu="fast"),  # pyright: ignore[reportArgumentType]
        lambda: rotor.make_design(elements="many"),  # pyright: ignore[reportArgumentType]
        lambda: rotor.make_design(twist=-12),  # pyright: ignore[reportArgumentType]
        lambda: rotor.make_design(mass=8000),  # pyright: ignore[reportCallIssue]
        lambda: DESIGN.at(climb_m_s="up"),  # pyright: ignore[reportArgumentType]
        lambda: rotor.sweep(DESIGN, mass_kg=["heavy"]),  # pyright: ignore[reportArgumentType]
    ):
        with pytest.raises(TypeError):
            call()

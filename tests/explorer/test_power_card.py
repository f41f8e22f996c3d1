"""The numbers of the power card where power is near zero or negative: descent and autorotation."""

from dataclasses import replace

import pytest

from explorer.model.inputs import OPENING, Inputs, ViewState, baseline_of
from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.parts.results import PowerPart
from explorer.views.page_state import PageState
from explorer.views.power import power_card
from rotor.trim.solve import solve


def card(inputs: Inputs) -> PowerPart:
    solution = solve(inputs.design()).require()
    state = SessionState(inputs, ViewState(), solution, solve(baseline_of(solution.design)), None)
    return power_card(PageState(inputs, solution.design, state))["power"]


@pytest.mark.parametrize("climb", [-8.0, -13.0])
@pytest.mark.parametrize("outer", [0.0, -2.0])
def test_no_number_of_the_card_is_blank_in_descent(climb: float, outer: float):
    found = card(replace(OPENING, advance_ratio=0.15, climb_m_s=climb, built_outer=outer))
    assert "–" not in (found.total, found.change)
    assert "– %" not in str(found)
    assert sum(max(one.share, 0.0) for one in found.parts) == pytest.approx(1.0, abs=1e-4)


def test_autorotation_is_marked():
    found = card(replace(OPENING, advance_ratio=0.15, climb_m_s=-13.0))
    assert found.total.startswith("−")
    assert found.status.words == "autorotation"
    assert "The air drives the rotor" in found.status.title
    assert found.change == "0.0 kW"
    descent = card(replace(OPENING, advance_ratio=0.15, climb_m_s=-8.0))
    assert descent.status.words != "autorotation"
    assert descent.change.endswith(" %")


def test_more_than_the_engines_give_is_said_on_the_chip():
    """The UH-60A's two T700 give 2,327 kW by its rotor file."""
    fast = card(replace(OPENING, advance_ratio=0.42))
    assert fast.status.words == f"engines give only {number(2327.0)} kW"
    assert "The rotors need" in fast.status.title
    assert "engines" not in card(replace(OPENING, advance_ratio=0.3)).status.words

"""What the panels of power want computed once the page rests."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from explorer.model.session_state import Analyses
from explorer.model.sliders import SliderSensitivity, flight_sensitivities
from explorer.views.now import Now, Tell
from rotor import Design, Solution, doubt
from rotor.trim import PitchGradient
from rotor.trim.doubt import Doubt


def by_power(design: Design) -> bool:
    """Whether power belongs to a design: the shaft of a free rotor takes none, whatever the twist."""
    return design.models.trim != "free-rotor"


@dataclass(frozen=True, eq=False)
class Doubted:
    """How sure power is, and its change from the reference."""

    solution: Solution
    reference: Solution | None
    analyses: Analyses
    name: str = "doubt"
    soon = True

    @property
    def key(self) -> tuple[Any, ...]:
        return self.name, self.solution.design, self.reference and self.reference.design

    def run(self, superseded: Callable[[], bool], tell: Tell) -> Doubt:
        del superseded, tell  # Some milliseconds.
        other = None if self.reference is None else self.analyses.of(self.reference)
        return doubt(self.analyses.of(self.solution), other)


def doubted(now: Now) -> tuple[Doubted, ...]:
    """The doubt of what is shown; none of a free rotor."""
    state = now.state
    if state is None or not by_power(state.solution.design):
        return ()
    other = state.reference
    compared = other.converged and other.design != state.solution.design and by_power(other.design)
    return (Doubted(state.solution, other if compared else None, now.analyses),)


@dataclass(frozen=True, eq=False)
class Slopes:
    """∂P/∂θ(r) of the design on the sliders."""

    solution: Solution
    analyses: Analyses
    name = "slopes"
    soon = True

    @property
    def key(self) -> tuple[Any, ...]:
        return self.name, self.solution.design

    def run(self, superseded: Callable[[], bool], tell: Tell) -> PitchGradient:
        del superseded, tell  # Some milliseconds.
        return self.analyses.of(self.solution).gradient


@dataclass(frozen=True, eq=False)
class FlightSlopes:
    """What a step of each slider of the flight changes: two trims each."""

    solution: Solution
    name = "flight-slopes"
    soon = False

    @property
    def key(self) -> tuple[Any, ...]:
        return self.name, self.solution.design

    def run(self, superseded: Callable[[], bool], tell: Tell) -> Mapping[str, SliderSensitivity] | None:
        del tell
        found = flight_sensitivities(self.solution, superseded)
        return None if superseded() else found

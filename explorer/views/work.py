"""What the panels of power want computed once the page rests."""

from explorer.model.session_state import Analyses
from explorer.views.now import Now, Work
from rotor import Design, Solution, doubt


def by_power(design: Design) -> bool:
    """Whether power belongs to a design: the shaft of a free rotor takes none, whatever the twist."""
    return design.models.trim != "free-rotor"


def doubt_work(name: str, solution: Solution, reference: Solution | None, analyses: Analyses) -> Work:
    """How sure power is, and its change from the reference: a `Doubt` about the two designs."""
    return Work(
        name,
        (solution.design, reference and reference.design),
        lambda superseded, tell: doubt(analyses.of(solution), reference and analyses.of(reference)),
        soon=True,
    )


def doubted(now: Now) -> tuple[Work, ...]:
    """The doubt of what is shown; none of a free rotor."""
    state = now.state
    if state is None or not by_power(state.solution.design):
        return ()
    other = state.reference
    compared = other.converged and other.design != state.solution.design and by_power(other.design)
    return (doubt_work("doubt", state.solution, other if compared else None, now.analyses),)

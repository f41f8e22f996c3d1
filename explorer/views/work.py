"""What the panels of power want computed once the page rests."""

from explorer.model.session_state import Analyses
from explorer.views.page_state import PageState, PanelWork, as_one_step
from rotor import Design, Solution, doubt


def has_power(design: Design) -> bool:
    """Whether power belongs to a design: the shaft of a free rotor takes none, whatever the twist."""
    return design.models.trim != "free-rotor"


def doubt_work(
    name: str, solution: Solution, reference: Solution | None, analyses: Analyses
) -> PanelWork:
    """How sure power is, and its change from the reference: a `Doubt` about the two designs."""
    run = as_one_step(lambda: doubt(analyses.of(solution), reference and analyses.of(reference)))
    return PanelWork(name, (solution.design, reference and reference.design), run, soon=True)


def shown_doubt(now: PageState) -> tuple[PanelWork, ...]:
    """The doubt of what is shown."""
    if (state := now.state) is None:
        return ()
    design, other = state.solution.design, state.reference
    compared = (
        other.converged and other.design != design and has_power(design) and has_power(other.design)
    )
    return (doubt_work("doubt", state.solution, other if compared else None, now.analyses),)

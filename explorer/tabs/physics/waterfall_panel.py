"""The tab of the physics: what each part costs, computed when the page rests."""

from collections.abc import Callable, Iterator, Mapping

import viser

from explorer.interface import SessionState
from explorer.tabs.physics.waterfall_view import alone_table, waterfall_chart
from explorer.text import readout
from explorer.text.units import SI, UNITS, Units
from rotor.aero.switches import SWITCHES, with_switches
from rotor.analysis.series import WaterfallStep, switch_off_steps, switch_on_steps
from rotor.design.design import Design
from rotor.trim.solution import Solution

_WORDS = (
    '<div class="rx rx-dim rx-small rx-found">The same condition without flapping, losses, reverse flow, '
    "compressibility and fuselage drag, then with one more at a time; every row is a trim. "
    "The cost of an effect depends on the others, so below: each effect removed on its own.</div>"
)
_CLIMB, _ALL = len(SWITCHES) + 1, 2 * len(SWITCHES) + 1
"""Steps from everything off to everything on, and with each switch off alone."""


class WaterfallPanel:
    """One session's."""

    def __init__(self, gui: viser.GuiApi, show_costs: Callable[[Mapping[str, str]], None]) -> None:
        """`show_costs`: hears what each switch costs, in words, by its name."""
        self._show_costs = show_costs
        gui.add_html(_WORDS)
        self._chart = gui.add_html(waterfall_chart(()))
        self._table = gui.add_html("")
        self._design: Design | None = None
        """With everything on: what the steps are of."""
        self._units = SI
        self._coming: Iterator[WaterfallStep] = iter(())
        self._steps: list[WaterfallStep] = []
        self._drawn = waterfall_chart(()), ""

    def show(self, state: SessionState) -> None:
        """Say that the steps on the page are no longer this design's; the new ones come when the page rests."""
        design = with_switches(state.solution.design, ())
        if design != self._design:
            self._design, self._coming, self._steps = design, _all_steps(design), []
            self._fade()
        units, self._units = self._units, UNITS[state.view.units]
        if units is not self._units and len(self._steps) == _ALL:
            self._draw()

    def climb(self, superseded: Callable[[], bool]) -> None:
        """Compute the steps that are missing, until the page has something else to do; show them once all are there."""
        while self._design is not None and len(self._steps) < _ALL and not superseded():
            self._steps.append(next(self._coming))
            if len(self._steps) == _ALL:
                self._draw()

    def show_failure(self) -> None:
        """The inputs have no answer."""
        self._design = None
        self._fade()

    def stop(self) -> None:
        """Nothing runs on."""

    def _draw(self) -> None:
        climbed, alone = self._steps[:_CLIMB], self._steps[_CLIMB:]
        self._drawn = waterfall_chart(climbed, self._units), alone_table(alone, self._units)
        self._chart.content, self._table.content = self._drawn
        self._show_costs({step.switch.name: _cost(step, self._units) for step in alone if step.switch is not None})

    def _fade(self) -> None:
        self._chart.content, self._table.content = map(readout.faded, self._drawn)


def _cost(step: WaterfallStep, units: Units) -> str:
    """What a switch adds to the power, from the trim without it."""
    if step.note:
        return step.note
    if step.added is None:
        return "does not trim without it"
    return f"{units.watts(-step.added, 1, sign=True)} here"


def _all_steps(design: Design) -> Iterator[WaterfallStep]:
    """All switches on one after another, then each switch off alone."""
    full: Solution | None = None
    for step in switch_on_steps(design):
        full = step.solution
        yield step
    assert full is not None
    yield from switch_off_steps(design, full)

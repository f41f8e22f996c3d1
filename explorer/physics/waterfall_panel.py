"""The tab of the physics: what each part costs, computed when the page rests and only while it is wanted."""

from collections.abc import Callable, Iterator

import viser

from explorer import readout
from explorer.desk import Desk, Moment
from explorer.glossary import hint
from explorer.physics.waterfall_view import alone_table, waterfall_chart
from explorer.units import SI, UNITS
from rotor.design import Design
from rotor.solution import Solution
from rotor.switches import SWITCHES, with_switches
from rotor.waterfall import Step, climb, each_alone

_WORDS = (
    '<div class="rx rx-dim rx-small rx-found">The same flight, first without flapping, losses, reverse flow, '
    "compressibility and drag, then with one more at a time: every row is a trim. "
    "What a part costs depends on what is there already, so beneath stands each left out alone.</div>"
)


class WaterfallPanel:
    """One session's."""

    def __init__(self, gui: viser.GuiApi, desk: Desk) -> None:
        gui.add_html(_WORDS)
        self._wanted = gui.add_checkbox("Show, and follow", False, hint=hint("waterfall"))
        self._wanted.on_update(lambda _: desk.wake())
        self._chart = gui.add_html("")
        self._table = gui.add_html("")
        self._design: Design | None = None
        """With everything on: what the steps are of."""
        self._units = SI
        self._coming: Iterator[Step] = iter(())
        self._steps: list[Step] = []
        self._drawn = "", ""

    def show(self, moment: Moment) -> None:
        """Say that the steps on the page are no longer this design's; the new ones come when the page rests."""
        design = with_switches(moment.solution.design, ())
        if design != self._design:
            self._design, self._coming, self._steps = design, _all_steps(design), []
            self._fade()
        units, self._units = self._units, UNITS[moment.view.units]
        if not self._wanted.value:
            self._write("", "")
        elif units is not self._units and self._steps:
            self._draw()

    def climb(self, superseded: Callable[[], bool]) -> None:
        """Compute and show the steps that are missing, one after another, until the page has something else to do."""
        if not self._wanted.value or self._design is None:
            return
        while not superseded():
            step = next(self._coming, None)
            if step is None:
                return
            self._steps.append(step)
            self._draw()

    def lose(self) -> None:
        """The inputs have no answer."""
        self._design = None
        self._fade()

    def stop(self) -> None:
        """Nothing runs on."""

    def _draw(self) -> None:
        rows = len(SWITCHES) + 1
        self._write(waterfall_chart(self._steps[:rows], self._units), alone_table(self._steps[rows:], self._units))

    def _write(self, chart: str, table: str) -> None:
        self._drawn = chart, table
        self._chart.content, self._table.content = chart, table

    def _fade(self) -> None:
        self._chart.content, self._table.content = map(readout.faded, self._drawn)


def _all_steps(design: Design) -> Iterator[Step]:
    """The climb, then each switch off alone."""
    full: Solution | None = None
    for step in climb(design):
        full = step.solution
        yield step
    assert full is not None
    yield from each_alone(design, full)

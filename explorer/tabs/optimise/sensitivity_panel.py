"""The tab that says where to twist: a chart that follows the sliders, and the same painted on the reference blade."""

import viser

from explorer.interface import SessionState, TabContext
from explorer.picture.blade_mesh import blade_shape
from explorer.scene.overlays import Strip
from explorer.tabs.chart_panel import AB_KEY, Chart, Key, line, pinned_line
from explorer.tabs.optimise import sensitivity
from explorer.text.glossary import hint
from explorer.theme.colours import BASELINE, THIS
from rotor.trim.solution import Solution

_HEIGHT = 220
_WORDS = (
    '<div class="rx rx-dim rx-small rx-found">Power sensitivity to local pitch, with the rotor retrimmed: '
    "positive where more pitch costs power, negative where it saves.</div>"
)
_INDUCED = ("induced", BASELINE, True)
_KEY: Key = (("total", THIS), _INDUCED)


class SensitivityPanel:
    """One session's."""

    def __init__(self, gui: viser.GuiApi, strip: Strip, context: TabContext) -> None:
        self._strip = strip
        self._shown: tuple[Solution, Solution | None, bool, float] | None = None
        gui.add_html(_WORDS)
        self._chart = Chart(
            gui,
            "dP/dθ [kW/° per r/R]",
            _KEY,
            "radius r/R",
            (line("zero", BASELINE, 0.7), line("induced", BASELINE, 1.5, (5, 3)), pinned_line(), line("total", THIS)),
            sensitivity.blank_sensitivity(),
            (0.1, 1.02),
            _HEIGHT,
            name="chart_sensitivity",
        )
        self._words = gui.add_html("")
        self._paint = gui.add_checkbox("Paint blade", False, hint=hint("paint"))
        self._paint.on_update(lambda _: context.wake())

    def show(self, state: SessionState) -> None:
        """Follow a converged solution."""
        solution, exaggeration, paint = state.solution, state.view.exaggeration, self._paint.value
        wanted = (solution, state.pinned, paint, exaggeration)
        if self._shown == wanted:
            return
        plot = sensitivity.sensitivity_plot(solution, self._chart.y_range, state.pinned)
        self._chart.show(plot, _KEY if state.pinned is None else (*AB_KEY, _INDUCED))
        self._words.content = sensitivity.explanation(plot)
        if paint:
            shape = blade_shape(solution.design.rotor)
            self._strip.show(*sensitivity.strip(shape, solution.design.twist, exaggeration, plot))
        else:
            self._strip.hide()
        self._shown = wanted

    def show_failure(self) -> None:
        """The answer no longer holds."""
        self._shown = None
        self._strip.hide()

    def stop(self) -> None:
        """Nothing runs on."""

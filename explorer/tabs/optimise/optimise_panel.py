"""The Optimise tab: what to search for, its buttons, its course, and what becomes of the optimum."""

import threading
from collections.abc import Callable
from dataclasses import replace

import viser

from explorer.model.inputs import baseline_of, baseline_title, with_optimum
from explorer.tabs.background import FRAME, BackgroundWork
from explorer.tabs.context import TabContext
from explorer.tabs.layout import by_hand
from explorer.tabs.optimise import search_words as text
from explorer.tabs.optimise.search_run import OBJECTIVES, TRACES, SearchRequest, SearchRun
from explorer.tabs.optimise.search_run import legs as mission_legs
from explorer.text.glossary import hint
from explorer.workers.pool import JobEvent
from explorer.workers.solver import SearchTask
from rotor import Design
from rotor.chart import Chart
from rotor.optimisation import CONCEPTS, WeightedCondition

TIME_LIMIT = 60.0
"""[s] a search may take."""


class OptimisePanel(BackgroundWork):
    """One session's search. Buttons act at once; everything that only shows happens in `refresh`."""

    def __init__(self, context: TabContext) -> None:
        super().__init__(context, TIME_LIMIT)
        gui, bridge = context.gui, context.bridge
        self.legs: Callable[[Design], tuple[WeightedCondition, ...]] = mission_legs
        """Of the mission, for a design; ValueError with one sentence for a mission that is none."""
        self.run: SearchRun | None = None
        """The last search; None before the first."""
        self._offered = False
        """Whether the run's designs are shown, to be applied or discarded."""
        self._titles = {name: concept.title for name, concept in CONCEPTS.items()}
        titles, first = tuple(self._titles.values()), self._titles["two-segment-free"]
        self._concept = gui.add_dropdown("Concept", titles, initial_value=first, hint=hint("search_concept"))
        self._picture = gui.add_html("")
        self._objective = gui.add_dropdown("Objective", tuple(OBJECTIVES.values()), hint=hint("objective"))
        defaults, where = SearchRequest(), hint("search_division")
        self._numbers: dict[str, viser.GuiSliderHandle[float]] = {
            "hover_share": gui.add_slider("Hover [%]", 0.0, 100.0, 5.0, 50.0, hint=hint("hover_share")),
            "division": gui.add_slider("Break point [r/R]", 0.25, 0.92, 0.01, defaults.division, hint=where),
            "first": gui.add_slider("Break 1 [r/R]", 0.2, 0.6, 0.01, defaults.first, hint=where),
            "second": gui.add_slider("Break 2 [r/R]", 0.65, 0.95, 0.01, defaults.second, hint=where),
            "starts": gui.add_slider("Starting points", 1, TRACES, 1, defaults.starts, hint=hint("starts")),
        }
        with gui.add_folder("Limits", expand_by_default=False):
            self._limit_stall = gui.add_checkbox("Limit stall", False, hint=hint("limit_stall"))
            self._numbers["stalled"] = gui.add_slider("Stalled [%]", 0.0, 20.0, 0.5, 5.0, hint=hint("stalled_limit"))
            self._limit_change = gui.add_checkbox("Limit change of twist", False, hint=hint("limit_change"))
            self._numbers["change"] = gui.add_slider(
                "Change at tip [°]", 0.5, 15.0, 0.5, 4.0, hint=hint("change_limit")
            )
            self._limit_index = gui.add_checkbox("Limit vibration", False, hint=hint("limit_index"))
            self._numbers["index"] = gui.add_slider("Index [%]", 0.5, 10.0, 0.1, 3.0, hint=hint("index_limit"))
        self._begin = gui.add_button("Optimise", icon=viser.Icon.PLAYER_PLAY, hint=hint("optimise"))
        self._halt = gui.add_button("Stop", icon=viser.Icon.PLAYER_STOP, color="red", visible=False, hint=hint("stop"))
        self._bar = gui.add_progress_bar(0.0)
        self._headline = gui.add_html("")
        self._standing = gui.add_html(text.standing(None))
        self._result = gui.add_html("")
        self._scrubber = gui.add_slider("Replay", 0, 1, 1, 0, visible=False, hint=hint("replay"))
        self._frame = gui.add_html("")
        self._again = gui.add_button("Replay", color="gray", visible=False, hint=hint("search_result"))
        self._details = gui.add_html("")
        self._begin.on_click(lambda _: self.begin())
        self._halt.on_click(lambda _: self.halt())
        self._again.on_click(lambda _: self._replay())
        bridge.on("apply", lambda _: self._close(True))
        bridge.on("discard", lambda _: self._close(False))
        bridge.on("halt", lambda _: self.halt())
        context.controls.optimise_button.on_click(lambda _: self._begin_from_rail())
        context.keyboard.bind("optimise", self.toggle)
        by_hand(self._scrubber, self._scrubbed)
        limits = self._limit_stall, self._limit_change, self._limit_index
        for widget in (self._concept, self._objective, *limits, *self._numbers.values()):
            by_hand(widget, lambda _: context.wake())

    def request(self) -> SearchRequest:
        number = {name: float(handle.value) for name, handle in self._numbers.items()}
        return SearchRequest(
            concept=next(name for name, title in self._titles.items() if title == self._concept.value),
            objective=next(name for name, title in OBJECTIVES.items() if title == self._objective.value),
            hover_share=number["hover_share"],
            division=number["division"],
            first=number["first"],
            second=number["second"],
            starts=round(number["starts"]),
            stalled=number["stalled"] if self._limit_stall.value else None,
            change=number["change"] if self._limit_change.value else None,
            index=number["index"] if self._limit_index.value else None,
        )

    def _begin_from_rail(self) -> None:
        self._context.layout.show_mode("optimise")
        self.begin()

    def prepare(self) -> tuple[SearchTask, Callable[[JobEvent], None], str]:
        """A search for the design on the sliders."""
        design = self._context.inputs().design()
        search = self.request().search(design, self.legs)
        self._offered = True
        self._context.tracker.reset()
        reference, title = self._reference(design)
        run = self.run = SearchRun(search, title)
        return SearchTask(search, reference), run.on_event, ""

    def _reference(self, design: Design) -> tuple[Design, str]:
        """What a saving is also measured against: A's blade in the same flight and models, else the baseline."""
        state = self._context.state()
        if state is None or state.pin is None:
            return baseline_of(design), baseline_title(design)
        a = state.pin.solution.design
        return replace(design, rotor=a.rotor, twist=a.twist, active_twist=a.active_twist), "A's blade"

    def halt(self) -> None:
        """Stop the search under way; what it found stays."""
        if self.running and self.run is not None:
            self.run.stopping()
        super().halt()

    def withdraw(self) -> None:
        """Show the sliders again: stop the search under way, and discard what was previewed."""
        self.halt()
        if self._offered:
            self._offered = False
            self._context.tracker.reset()
            self._context.wake()

    def toggle(self) -> None:
        """Start a search, or stop the one under way."""
        if self.running:
            self.halt()
        else:
            self.begin()

    def preview(self, design: Design) -> Design | None:
        """The design to show instead of the sliders': that of the frame whose turn it is."""
        run = self.run
        if run is None or not self._offered or not run.matches(design):
            return None
        frame = run.shown()
        if run.playing:
            timer = threading.Timer(FRAME, self._context.wake)
            timer.daemon = True
            timer.start()
        return None if frame is None else frame.design

    def starts_chart(self) -> Chart | None:
        """Of the search, in place of charts along the blade; None where there is none."""
        run = self.run
        return None if run is None or not any(run.traces) else text.starts_chart(run, self._context.units)

    def optimum_of(self, design: Design, concept: str) -> tuple[float, ...] | None:
        """Parameters of the optimum of a concept, if a search from this design has found it."""
        run = self.run
        if run is None or run.optimum is None or run.optimum.best is None or not run.matches(design):
            return None
        return run.optimum.best.parameters if run.concept.name == concept else None

    def refresh(self, design: Design | None) -> None:
        """Bring everything that only shows into line. `design`: on the sliders; None when they mean none."""
        run, request, units = self.run, self.request(), self._context.units
        for name, handle in self._numbers.items():
            handle.visible = request.asks_for(name)
        concept = request.known_concept()
        self._picture.content = _boxed(text.concept_picture(concept), concept.explanation)
        under_way = run is not None and run.under_way
        self._begin.visible, self._halt.visible = not under_way, under_way
        self._standing.content = text.standing(run, self.line)
        self._bar.visible = run is not None
        if run is None:
            return
        self._bar.value = round(100.0 * run.part_done, 1)
        self._bar.animated = under_way
        self._result.content = text.result(run, units)
        self._details.content = text.details(run, units)
        on_offer = self._offered and not under_way and len(run.frames) > 1
        here = design is not None and run.matches(design)
        self._again.visible, self._scrubber.visible = on_offer, on_offer and here
        self._frame.content = ""
        if on_offer and here:
            self._scrubber.max, self._scrubber.value = len(run.frames) - 1, run.cursor
            self._frame.content = text.frame_line(run, units)
        elif on_offer:
            self._frame.content = text.moved_on()
        self._headline.content = text.headline(run, units)

    def notice(self, design: Design | None) -> dict[str, object] | None:
        """The bar over the scene while it shows a search instead of the sliders."""
        run = self.run
        if run is None or not self._offered or design is None or not run.matches(design):
            return None
        best, units = run.best, self._context.units
        if run.under_way:
            words = " …" if best is None else f": {units.watts(best.power)}"
            return {"text": f"Searching{words}", "actions": [("halt", "Stop")]}
        if len(run.frames) < 2:
            return None
        return {"text": "Previewing optimum", "actions": [("apply", "Apply"), ("discard", "Discard")]}

    def _replay(self) -> None:
        if self.run is not None:
            self.run.replay()
            self._context.wake()

    def _close(self, apply: bool) -> None:
        """Take what is previewed onto the sliders, or leave them as they are."""
        run = self.run
        if run is None or run.under_way or not run.frames:
            return
        self._offered = False
        self._context.tracker.reset()
        if apply:
            here = run.matches(self._context.inputs().design())
            frame = run.chosen if here else run.frames[-1]
            self._context.set_inputs(with_optimum(self._context.inputs(), frame.design))
        self._context.wake()

    def _scrubbed(self, cursor: float) -> None:
        if self.run is not None:
            self.run.scrub(round(cursor))
            self._context.wake()


def _boxed(picture: str, words: str) -> str:
    return f'<div class="rx rx-concept">{picture}<div class="rx-dim rx-small">{words}</div></div>'

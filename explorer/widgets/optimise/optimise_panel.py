"""The Optimise tab: what to search for, its buttons, its course, and what becomes of the optimum."""

import math
from collections.abc import Callable
from dataclasses import replace

from explorer.charts.concept import concept_picture
from explorer.charts.doubt import twist_ranges
from explorer.model.inputs import baseline_of, baseline_title, with_optimum
from explorer.model.search_run import OBJECTIVES, SearchRequest, SearchRun
from explorer.parts.frame import NoticePart
from explorer.sharing.game import Game, game_of
from explorer.sharing.share import Address
from explorer.text import search_words as text
from explorer.text.glossary import hint
from explorer.text.readout import total_words
from explorer.widgets.context import TabContext
from explorer.widgets.elements import WorkButtons
from explorer.widgets.form import WidgetForm
from explorer.widgets.layout import by_hand
from explorer.widgets.optimise.hand_game import HandGame
from explorer.workers.background import PoolAnswers
from explorer.workers.call import Call
from explorer.workers.solver import SearchTask
from rotor import Design
from rotor.design import LinearTwist
from rotor.design.quantity import Slider
from rotor.optimisation import CONCEPTS, Mission, standard_mission
from rotor.optimisation.results import BestTwist, SearchStatus
from rotor.optimisation.search import best_linear_twist
from rotor.support.markup import tag

_STILL = 0.6
"""[s] without a change before the best linear twist is looked for."""
_ANY_TWIST = LinearTwist(math.radians(-12.0))
"""In place of the twist that is set, on which the best does not depend: one question for all."""
TIME_LIMIT = 60.0
"""[s] a search may take."""
_LIMITS = {"limit_stall": "stalled", "limit_change": "change", "limit_index": "index"}
"""Switch of each limit, and its number."""
_NUMBERS = ("hover_share", "division", "first", "second", *_LIMITS.values())
"""Sliders that only some searches have."""

NAME = "search"
"""Of the work."""


class OptimisePanel:
    """One session's search. Buttons act at once; everything that only shows happens in `refresh`."""

    def __init__(self, context: TabContext, address: Address) -> None:
        self._context, self._work, gui, bridge = context, context.work, context.gui, context.bridge
        self.hand = HandGame(context, address)
        self.mission: Callable[[Design], Mission] = standard_mission
        """The mission of a design, as the flight bar has it."""
        self._run: SearchRun | None = None
        self._refused = ""
        """Why what was asked for last is no search."""
        self._offered = False
        """Whether the run's designs are shown, to be applied or discarded."""
        self._made: tuple[SearchRun, Game | None] | None = None
        """The game of a run."""
        self._replay: int | None = None
        """Which of them is shown; None: the best."""
        form = self.form = WidgetForm(
            gui, lambda name, by_hand: context.wake() if by_hand else None
        )
        first, where = SearchRequest(), "search_division"
        titles = {name: concept.title for name, concept in CONCEPTS.items()}
        form.menu("concept", "Concept", titles, first.concept, entry="search_concept")
        self._picture = gui.add_html("")
        form.menu("objective", "Objective", OBJECTIVES)
        form.slider("hover_share", Slider("Hover [%]", 0.0, 100.0, 5.0), first.hover_share)
        form.slider(
            "division", Slider("Break point [r/R]", 0.25, 0.92, 0.01), first.division, entry=where
        )
        form.slider("first", Slider("Break 1 [r/R]", 0.2, 0.6, 0.01), first.first, entry=where)
        form.slider("second", Slider("Break 2 [r/R]", 0.65, 0.95, 0.01), first.second, entry=where)
        with gui.add_folder("Limits", expand_by_default=False):
            form.box("limit_stall", "Limit past static angle", False)
            form.slider(
                "stalled",
                Slider("Past the static angle [%]", 0.0, 20.0, 0.5),
                5.0,
                entry="stalled_limit",
            )
            form.box("limit_change", "Limit change of twist", False)
            form.slider(
                "change", Slider("Change at tip [°]", 0.5, 15.0, 0.5), 4.0, entry="change_limit"
            )
            form.box("limit_index", "Limit vibration", False)
            form.slider("index", Slider("Index [%]", 0.5, 10.0, 0.1), 3.0, entry="index_limit")
        self._buttons = WorkButtons(
            gui, "Optimise", "Stop", ("optimise", "stop"), self.begin, self.halt
        )
        self._headline = gui.add_html("")
        self._standing = gui.add_html(text.standing(None))
        self._result = gui.add_html("")
        self._scrubber = gui.add_slider("Replay", 0, 1, 1, 0, visible=False, hint=hint("replay"))
        self._frame = gui.add_html("")
        self._details = gui.add_html("")
        self._best = PoolAnswers(context.pool, 3, context.wake)
        context.resting.append(self._best.rest)
        context.waiting.append(self._best.is_waiting)
        context.leaving.append(self._best.stop)
        self._ranges = gui.add_html("")
        bridge.on("apply", lambda _: self._close(True))
        bridge.on("discard", lambda _: self._close(False))
        bridge.on("beat", lambda _: self._beat())
        bridge.on("halt", lambda _: self.halt())
        context.controls.optimise_button.on_click(lambda _: self._begin_from_rail())
        context.keyboard.bind("optimise", self.toggle)
        by_hand(self._scrubber, self._scrubbed)

    def request(self) -> SearchRequest:
        values = self.form.values()
        for limit, name in _LIMITS.items():
            if not values.pop(limit):
                values[name] = None
        return SearchRequest(**values)

    def _begin_from_rail(self) -> None:
        self._context.layout.show_mode("optimise")
        self.begin()

    @property
    def run(self) -> SearchRun | None:
        """The last search; None before the first."""
        record = self._work[NAME]
        if record is not None and (self._run is None or self._run.record is not record):
            self._run = SearchRun(record)
        return self._run

    def begin(self) -> None:
        """A search for the design on the sliders."""
        try:
            design = self._context.inputs().design()
            task = SearchTask(self.request().search(design, self.mission), *self._reference(design))
        except ValueError as error:
            self._refused = str(error)
            self._context.wake()
            return
        self._refused, self._offered, self._replay = "", True, None
        self._context.tracker.reset()
        self._work.begin(NAME, task, TIME_LIMIT)

    def _reference(self, design: Design) -> tuple[Design, str]:
        """What a saving is also measured against: A's blade in the same flight and models, else the baseline."""
        state = self._context.state()
        if state is None or state.pin is None:
            return baseline_of(design), baseline_title(design)
        a = state.pin.solution.design
        return replace(
            design, rotor=a.rotor, twist=a.twist, active_twist=a.active_twist
        ), "A's blade"

    def halt(self) -> None:
        """Stop the search under way, and keep what it found."""
        self._work.halt(NAME)

    def withdraw(self) -> None:
        """Show the sliders again: stop the search under way, and discard what was previewed."""
        self.halt()
        if self._offered:
            self._offered = False
            self._context.tracker.reset()
            self._context.wake()

    def toggle(self) -> None:
        """Start a search, or stop the one under way."""
        run = self.run
        if run is not None and run.under_way:
            self.halt()
        else:
            self.begin()

    def preview(self, design: Design) -> Design | None:
        """The design to show instead of the sliders': the best so far, or that of the scrubber."""
        run = self.run
        if run is None or not self._offered or not run.matches(design) or not run.frames:
            return None
        return run.frames[self._cursor(run)].design

    def _cursor(self, run: SearchRun) -> int:
        last = len(run.frames) - 1
        return last if self._replay is None else min(self._replay, last)

    def optimum_of(self, design: Design, concept: str) -> tuple[float, ...] | None:
        """Parameters of the optimum of a concept, if a search from this design has found it."""
        run = self.run
        if (
            run is None
            or run.optimum is None
            or run.optimum.best is None
            or not run.matches(design)
        ):
            return None
        return run.optimum.best.parameters if run.concept.name == concept else None

    def refresh(self, design: Design | None) -> None:
        """Bring everything that only shows into line. `design`: on the sliders; None when they mean none."""
        run, request, units = self.run, self.request(), self._context.units
        self.form.show({name: request.asks_for(name) for name in _NUMBERS})
        concept = request.known_concept()
        words = tag("div.rx-dim.rx-small", concept.explanation)
        self._picture.content = tag("div.rx.rx-concept", concept_picture(concept), words)
        under_way = run is not None and run.under_way
        self._buttons.show(None if run is None else run.part_done, under_way)
        self._standing.content = text.standing(run, self._refused)
        self._show_ranges(design)
        if run is None:
            return
        self._result.content = text.result(run)
        self._details.content = text.details(run, units)
        on_offer = self._offered and not under_way and len(run.frames) > 1
        here = design is not None and run.matches(design)
        self._scrubber.visible = on_offer and here
        self._frame.content = ""
        if on_offer and here:
            self._scrubber.max, self._scrubber.value = len(run.frames) - 1, self._cursor(run)
            self._frame.content = text.frame_line(run, self._cursor(run), units)
        elif on_offer:
            words = "The sliders have changed. Apply sets the optimum."
            self._frame.content = tag("div.rx.rx-dim.rx-small", words, data_explorer="frame")
        self._headline.content = text.headline(run, units)

    def _show_ranges(self, design: Design | None) -> None:
        """How far the best linear twist can move, once the page rests where that is what is searched for."""
        task = None
        linear = self._context.layout.mode == "optimise" and self.request().concept == "linear"
        if design is not None and linear:
            task = Call(best_linear_twist, (replace(design, twist=_ANY_TWIST),))
        self._best.ask(() if task is None else (task,), _STILL)
        answer = self._best.answer(task)
        self._ranges.content = (
            twist_ranges(answer, self._context.units) if isinstance(answer, BestTwist) else ""
        )

    def notice(self, design: Design | None) -> NoticePart | None:
        """The bar over the scene while it shows a search instead of the sliders."""
        run = self.run
        if run is None or not self._offered or design is None or not run.matches(design):
            return None
        best, units = run.best, self._context.units
        close = [("apply", "Apply"), ("discard", "Discard")]
        if run.under_way:
            words = " …" if best is None else f": {total_words(best.power, units)}"
            return NoticePart(
                f"Searching{words}", [("halt", "Stop"), *(close if best else close[1:])]
            )
        if len(run.frames) < 2:
            return None
        beat = [] if self._game_of(run) is None else [("beat", "Beat it by hand")]
        return NoticePart("Previewing optimum", [close[0], *beat, close[1]])

    def _game_of(self, run: SearchRun) -> Game | None:
        """The game that the search makes, if it has come to its end and found less power than the page had."""
        if self._made is None or self._made[0] is not run:
            over = run.optimum is not None and run.optimum.status is SearchStatus.CONVERGED
            game = None
            if over and run.frames[-1].power < (run.start_power or math.inf):
                game = game_of(run.search, run.frames[-1].design, self._context.inputs())
            self._made = run, game
        return self._made[1]

    def _beat(self) -> None:
        """A game against what was found, from where the page was."""
        run = self.run
        if (
            run is not None
            and not run.under_way
            and run.frames
            and (game := self._game_of(run)) is not None
        ):
            self._close(False)
            self._context.layout.show_mode("explore")
            self.hand.begin(game)

    def _close(self, apply: bool) -> None:
        """Take what is previewed onto the sliders, or leave them as they are; a search under way ends."""
        run = self.run
        if run is None or not run.frames:
            return
        self.halt()
        self._offered = False
        self._context.tracker.reset()
        if apply and len(run.frames) > 1:
            here = run.matches(self._context.inputs().design())
            frame = run.frames[self._cursor(run) if here else -1]
            self._context.set_inputs(with_optimum(self._context.inputs(), frame.design))
        self._context.wake()

    def _scrubbed(self, cursor: float) -> None:
        self._replay = round(cursor)
        self._context.wake()

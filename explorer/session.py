"""One browser's explorer: its widgets, scene, charts and worker, wired along the straight path."""

import logging
import math
import threading
from collections.abc import Callable
from dataclasses import replace

import viser

from explorer.charts.power_curve import PowerCurves
from explorer.hosting.viser_compat import PageFacts
from explorer.interface import SessionCallbacks, SessionState, SharedServices
from explorer.page import Page
from explorer.scene.overlays import ghost_of
from explorer.state import Inputs, ViewState, baseline_of, with_optimum
from explorer.text.status import status_panel
from explorer.text.units import UNITS
from explorer.workers import solver
from explorer.workers.newest_wins import IdleTimeout, NewestWins
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_log = logging.getLogger(__name__)


class Session:
    """Lives from connect to disconnect. After construction everything happens on the worker's thread."""

    def __init__(
        self,
        client: viser.ClientHandle,
        start: Inputs,
        facts: PageFacts,
        shared: SharedServices,
        sleep: IdleTimeout | None = None,
    ) -> None:
        """`start`: where the page's address holds no design; `sleep`: what the house does about rest."""
        self._latest: Solution | None = None
        self._good: Solution | None = None
        """The last converged answer: what the picture shows."""
        self._state: SessionState | None = None
        self._shown = threading.Event()
        """Set once the page has its first answer, or the sentence why there is none."""
        self._whole_round = True
        """Whether more may have changed since the last round than where the marked blade is."""
        self._baseline = solver.BaselineCache()
        self._curves = PowerCurves()
        self._pool = shared.pool
        self._worker = NewestWins(self._round, self._report, f"session-{client.client_id}", self._resting(sleep))
        self.page = Page(
            client, start, facts, shared, SessionCallbacks(self._wake, self._worker.wake, lambda: self._state)
        )

    def start(self) -> None:
        self.page.actuator.start()
        self._worker.start()
        self._wake()

    def stop(self) -> None:
        self._whole_round = True
        self.page.stop()
        self._pool.leave()
        self._worker.stop()

    def _wake(self) -> None:
        """Something changed."""
        self._whole_round = True
        self._worker.wake()

    def until_shown(self, patience: float) -> None:
        """Wait for the first answer to be on its way, at most so long [s]."""
        self._shown.wait(patience)

    def _round(self, superseded: Callable[[], bool]) -> None:
        """Widgets → Design → Solution → pictures; the frame first, then what it is compared with."""
        whole, self._whole_round = self._whole_round, False
        page = self.page

        def overtaken() -> bool:
            """Whether something waits that makes the rest of this round needless: not a blade that only turned."""
            return self._whole_round and self._worker.superseded

        def pause() -> bool:
            """The same between two steps of what can wait, where the frames of other pages go first."""
            return superseded() and self._whole_round

        inputs, view = page.history.read(page.controls.pauses.longest()), page.controls.display.view()
        page.controls.refresh(inputs, UNITS[view.units])
        page.set_dark(view.dark)
        try:
            plain = inputs.design()
            actuator = page.actuator.inputs()
            design = actuator.apply(plain)
        except ValueError as error:
            page.follow(None)
            self._latest = None
            if self._settle(inputs, None):
                return
            page.actuator.show_failure(str(error))
            self._show_failure(view, status_panel(None, str(error)))
            return
        # What a search shows is a blade at rest: a driven actuator goes first.
        preview = page.optimise.preview(plain) if design == plain else None
        if whole:
            page.follow(plain)
        design = preview or design
        if self._latest is None or self._latest.design != design:
            self._latest = solve(design, self._good)
        solution = self._latest
        if self._settle(inputs if preview is None else with_optimum(inputs, preview), solution):
            return
        if not solution.converged:
            page.actuator.show_failure(solution.message)
            self._show_failure(view, status_panel(solution))
            return
        self._good = solution
        page.history.solved(inputs, solution.power.total)
        top = page.top
        # A before the frame only where the frame shows it: nothing else may hold the frame up.
        on_disk = top.solve(design, overtaken()) if view.difference else None
        page.fit(solution.design.rotor.radius)
        page.scene.draw(solution, view, ghost_of(None if preview is None else plain, top.pinned), on_disk)
        page.camera.ride(math.radians(view.azimuth_deg))
        pictured = actuator.shown or actuator.driven  # Then it is part of the frame; else its tab can wait.
        if pictured and (whole or actuator.per_rev):  # Only at harmonics does its picture turn with the blade.
            page.actuator.show(actuator, plain, solution, math.radians(view.azimuth_deg))
        baseline = self._baseline.solve(baseline_of(design))
        state = SessionState(inputs, view, solution, baseline, top.solve(design, overtaken()), top.pinned)
        before, self._state = self._state, state
        if not whole and state.only_turned(before):
            page.results.turn(state)
            page.probe.show(state)
            return
        reference = state.reference.design

        def show_power() -> None:
            page.results.show_power(state, self._curves.known(design, reference))

        page.results.show(state)
        show_power()
        if not overtaken():
            if not pictured:
                page.actuator.show(actuator, plain, solution, math.radians(view.azimuth_deg))
            for tab in page.tabs:
                tab.show(state)
            page.file.follow(state)
        self._shown.set()
        if self._curves.sweep(design, reference, pause, show_power):
            page.file.follow(state)
            page.waterfall.climb(pause)
            if not pause():
                page.file.keep()

    def _settle(self, inputs: Inputs, solution: Solution | None) -> bool:
        """Do what the buttons of A/B asked; whether that moves the sliders, so that another round follows."""
        moved = self.page.top.settle(inputs, solution, self.page.context)
        self.page.controls.display.allow_difference(self.page.top.pinned is not None)
        return moved

    def _show_failure(self, view: ViewState, status: str) -> None:
        """The inputs have no answer: the last good one stays, grey, beneath the sentence."""
        self.page.results.problem(status)
        self._shown.set()
        for tab in self.page.tabs:
            tab.show_failure()
        self.page.scene.fade(self._good, view, self.page.top.answer if view.difference else None)
        if (last := self._state) is not None:
            curve = self._curves.known(last.solution.design, last.reference.design)
            self.page.results.show_power(last, curve, lost=True)

    def _resting(self, sleep: IdleTimeout | None) -> IdleTimeout | None:
        """What is only kept to be quick goes when the page falls asleep; the first touch computes it anew."""

        def on_sleep() -> None:
            self._latest, self._baseline, self._curves = None, solver.BaselineCache(), PowerCurves()
            if sleep is not None:
                sleep.on_sleep()

        return sleep and replace(sleep, on_sleep=on_sleep)

    def _report(self, error: Exception) -> None:
        self._shown.set()
        _log.error("an update failed", exc_info=error)
        sentence = f"This update failed ({error}): move any slider to go on."
        self.page.results.problem(status_panel(None, sentence))

"""One browser's session: its page, its worker thread, and the path from a slider to the picture.

`_update` is the path; docs/developers/slider.md has its steps. A widget's callback only calls `wake`, on a thread of
viser's; `NewestWins` runs `_update` on one of a few threads, and wakes in between need only one more run. Before the
frame is sent only what it shows is computed. What follows it is done in steps, which a newer update ends.
"""

import logging
import math
import threading
import time
from collections.abc import Iterator
from dataclasses import replace

import viser

from explorer.charts.measured import set_shown
from explorer.charts.plots import PowerCurve, PowerCurves
from explorer.hosting.messages import PageFacts
from explorer.hosting.viser_compat import wait_for_callbacks
from explorer.model.inputs import Inputs, baseline_of, with_optimum
from explorer.model.session_state import FailedTrim, Reading, SessionState
from explorer.page import Page
from explorer.widgets.context import SharedServices
from explorer.widgets.controls import SessionCallbacks
from explorer.workers import solver
from explorer.workers.newest_wins import UPDATES, NewestWins
from rotor import Solution
from rotor.support.blas_threads import one_blas_thread
from rotor.trim import DEFAULT_OPTIONS

_log = logging.getLogger(__name__)
_STILL = 0.25
"""[s] without a change after which nothing is dragged; less would delay the frames of keys pressed one by one."""
_DRAGGED = 0.5
"""[s] between two updates within a drag, at most."""


class Session:
    """Exists from connect to disconnect. After construction everything happens in updates, one at a time."""

    def __init__(self, client: viser.ClientHandle, start: Inputs, facts: PageFacts, shared: SharedServices) -> None:
        """`start`: used where the page's address holds no design."""
        self._latest: Solution | None = None
        self._good: Solution | None = None
        """The last converged solution: what the picture shows."""
        self._state: SessionState | None = None
        self._shown = threading.Event()
        """Set once the page has its first solution, or the sentence why there is none."""
        self._all_changed = True
        """Whether more than the azimuth of the reference blade may have changed since the last update."""
        self._curves = PowerCurves()
        self._begun = -math.inf
        """When the last update began."""
        # A link with A wakes it before the page is whole.
        self._worker = NewestWins(self._update, self._failed, held=True)
        self._client = client
        callbacks = SessionCallbacks(self._wake, self._worker.wake, lambda: self._state)
        self.page = Page(client, start, facts, shared, callbacks)
        self._baseline = solver.BaselineCache(by=self.page.context.analyses.solve)

    def start(self) -> None:
        self.page.answer_when_idle(self._until_idle)
        self.page.start()
        self._wake()
        self._worker.release()

    def stop(self) -> None:
        self._all_changed = True
        self.page.stop()
        self._worker.stop()

    def until_shown(self, patience: float) -> None:
        """Wait until the first solution is shown, at most `patience` [s]."""
        self._shown.wait(patience)

    @one_blas_thread()  # The pictures too: in a notebook's process they would take ten times as long.
    def _update(self) -> Iterator[float] | None:
        """One slider step up to its frame; returns the steps that follow, None where only the blade was turned."""
        before, self._begun = self._begun, time.monotonic()
        everything, self._all_changed = self._all_changed, False
        reading = self._read()
        solution = self._solve(reading)
        if solution is None:
            return iter(())
        self._draw(reading, solution, everything)
        if self._overtaken() and not UPDATES.waiting:  # What stands beside the frame would not be seen.
            self.page.solved(reading.inputs, solution)
            return iter(())
        as_built = baseline_of(solution.design)
        baseline = solution if as_built == solution.design else self._baseline.solve(as_built)
        pinned = self.page.solve_pinned(solution.design, self._overtaken())
        state = SessionState(reading.inputs, reading.view, solution, baseline, pinned, self.page.pin)
        last, self._state = self._state, state
        if not everything and state.only_turned(last):
            self.page.show_azimuth(state)
            return None
        self.page.take(reading, state)
        if UPDATES.busy:  # The number goes with the frame: charts wait for those of other pages, and for their sweeps.
            self.page.show_power_number()
        return self._in_turn(self._follow(reading, state, self._begun - before < _DRAGGED))

    @staticmethod
    def _in_turn(steps: Iterator[float]) -> Iterator[float]:
        """The steps of an update with one BLAS thread each."""
        while True:
            with one_blas_thread():
                pause = next(steps, None)
            if pause is None:
                return
            yield pause

    def _read(self) -> Reading:
        page = self.page
        inputs, view = page.read()
        try:
            sliders = inputs.design()
            design = page.driven(sliders)
        except ValueError as error:
            return Reading(inputs, view, problem=str(error))
        # The designs of a search are shown without actuator, so a driven actuator takes precedence.
        preview = page.optimise.preview(sliders) if design == sliders else None
        return Reading(inputs, view, sliders, preview or design, preview is not None)

    def _solve(self, reading: Reading) -> Solution | None:
        """Design → converged solution; None if there is none, or if the sliders were moved meanwhile."""
        design = reading.design
        if design is None:
            self._latest = None
        elif self._latest is None or self._latest.design != design:
            options = replace(DEFAULT_OPTIONS, stop=self._overtaken)
            answer = self.page.context.analyses.solve(design, self._good, options)
            if not answer.converged and self._overtaken():
                return None  # Perhaps stopped on its way; the next update solves what is on the sliders now.
            self._latest = answer
        solution = self._latest
        inputs = with_optimum(reading.inputs, design) if design and reading.previewed else reading.inputs
        if self.page.pin_or_swap(inputs, solution):
            return None
        if solution is None or not solution.converged:
            self._show_failure(FailedTrim(reading, solution, self._good))
            return None
        self._good = solution
        return solution

    def _draw(self, reading: Reading, solution: Solution, everything: bool) -> None:
        """Solution → the frame. A is solved before the frame only where the scene shows it."""
        wanted = reading.view.difference or reading.view.wipe
        pinned = self.page.solve_pinned(solution.design, self._overtaken()) if wanted else None
        self.page.show_frame(reading, solution, pinned, only_azimuth=not everything)

    def _follow(self, reading: Reading, state: SessionState, dragged: bool) -> Iterator[float]:
        """Everything else, in order of how soon it is needed; `dragged`: another update was just before this one."""
        page, design, reference = self.page, state.solution.design, state.reference.design

        def known() -> PowerCurve:
            return self._curves.known(design, reference)

        def show_power() -> None:
            page.show_power(known())

        def sweep() -> bool:
            # On a test stand measured points take the place of power over µ.
            tested = set_shown(state.solution) is not None
            return tested or self._curves.sweep(design, reference, self._overtaken, show_power)

        page.show_results(reading, self._turned(state), known())
        yield 0.0
        page.follow(self._turned(state))
        self._shown.set()
        yield 0.0
        if dragged and not self._curves.recent:
            sweep()  # So that the curve follows a long drag.
        yield _STILL  # The next step of a drag is on its way, or nothing moves any more.
        page.rest(self._turned(state), self._overtaken)
        yield 0.0
        page.keep(self._turned(state))
        self._worker.answer()
        yield 0.0
        if sweep() and not self._overtaken():
            yield 0.0
            page.solve_deferred(self._turned(state), self._overtaken)
            yield 0.0
            if self._curves.widen(design, self._overtaken):
                show_power()

    def _turned(self, state: SessionState) -> SessionState:
        """The state with the blade where it was turned to since."""
        now = self._state
        return now if now is not None and now.solution is state.solution else state

    def _show_failure(self, failure: FailedTrim) -> None:
        """The last converged picture stays, grey, with the sentence."""
        last = self._state
        curve = None if last is None else self._curves.known(last.solution.design, last.reference.design)
        self.page.show_failure(failure, curve)
        self._shown.set()

    def _wake(self) -> None:
        self._all_changed = True
        self._worker.wake()

    def _until_idle(self, wholly: bool) -> None:
        """Wait until all that the page sent before is answered; `wholly`: and nothing is computed for it any more."""
        wait_for_callbacks(self._client)
        self._worker.until_answered(wholly)

    def _overtaken(self) -> bool:
        """Whether a newer update waits that changes more than the azimuth of the reference blade."""
        return self._all_changed and self._worker.superseded

    def _failed(self, error: Exception) -> None:
        """Nothing that the update may have left half done is used by the next."""
        self._shown.set()
        self._latest = self._good = None
        self._all_changed = True
        self._baseline, self._curves = replace(self._baseline, design=None, solution=None), PowerCurves()
        _log.error("an update failed", exc_info=error)
        self.page.show_error(f"This update failed ({error}): move any slider to continue.")

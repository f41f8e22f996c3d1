"""One browser's session: its page, its worker thread, and the path from a slider to the picture.

A slider step takes these steps; `_update` is the path, the page implements `explorer.interface.SessionPage`:

1. A widget's callback calls `wake`, on a thread of viser's. Nothing else happens there.
2. `NewestWins` runs `_update` on the session's thread when its turn comes; wakes in between need only one more run.
3. read: `page.read` turns the widgets into `Inputs` and `ViewState`.
4. read: `Inputs.design`, the actuator and the search that is shown turn them into a `Design`.
5. solve: `rotor.trim.solve` trims the design, starting from the last converged solution.
6. solve: the A/B buttons act. If that moves the sliders, a further update follows and this one ends.
7. draw: `picture.make_picture` makes arrays of the solution: blades, disk image, outlines.
8. draw: `scene` assigns them to viser's handles and flushes. The frame is on its way.
9. follow: the baseline and A are solved and complete the `SessionState`.
10. follow: `page.show_results` updates status, numbers, charts and the panels of long work; where other pages wait for
   their frames, it does so once nothing moves, in a drag now and then, and `page.show_power_number` at each step.
11. follow: `page.follow` updates all other tabs.
12. follow: once nothing moves, `page.settle` draws finely; the power curve is swept; `page.rest` does what can wait.
"""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import viser

from explorer.charts.measured import set_shown
from explorer.charts.power_curve import PowerCurves
from explorer.hosting.browser import PageFacts
from explorer.hosting.viser_compat import until_called
from explorer.interface import Failure, Frame, Reading, SessionCallbacks, SessionPage, SessionState, SharedServices
from explorer.page import Page
from explorer.state import Inputs, baseline_of, with_optimum
from explorer.workers import solver
from explorer.workers.newest_wins import IdleTimeout, NewestWins, Superseded
from explorer.workers.scheduler import SCHEDULER
from rotor.blas_threads import one_blas_thread
from rotor.trim.newton import DEFAULT_OPTIONS
from rotor.trim.solution import Solution
from rotor.trim.solve import solve

_log = logging.getLogger(__name__)
_STILL = 0.12
"""[s] without a change after which nothing is dragged: even a slow drag changes something every 100 ms."""
_FRAMES_TO_CHARTS = 6.0
"""While other pages wait for their frames, charts follow a drag once its frames since the last charts have taken so
many times as long as these [processor time]: so frames have most of a crowd's time on a fast and on a slow machine."""


class Session:
    """Exists from connect to disconnect. After construction everything happens on the worker's thread."""

    def __init__(
        self,
        client: viser.ClientHandle,
        start: Inputs,
        facts: PageFacts,
        shared: SharedServices,
        idle: IdleTimeout | None = None,
    ) -> None:
        """`start`: used where the page's address holds no design; `idle`: what the server does when a page rests."""
        self._latest: Solution | None = None
        self._good: Solution | None = None
        """The last converged solution: what the picture shows."""
        self._state: SessionState | None = None
        self._shown = threading.Event()
        """Set once the page has its first solution, or the sentence why there is none."""
        self._all_changed = True
        """Whether more than the azimuth of the reference blade may have changed since the last update."""
        self._baseline = solver.BaselineCache()
        self._curves = PowerCurves()
        self._begun = self._frames_took = self._charts_took = 0.0
        """Processor time [s] at which this update began, of the frames since the last charts, and of these charts."""
        self._pool = shared.pool
        self._worker = NewestWins(self._update, self._failed, f"session-{client.client_id}", self._freeing(idle))
        callbacks = SessionCallbacks(self._wake, self._worker.wake, lambda: self._state)
        self.page = Page(client, start, facts, shared, callbacks)
        self._page: SessionPage = self.page
        self.page.bridge.on("idle", partial(self._tell_idle, client))

    def start(self) -> None:
        self._page.start()
        self._worker.start()
        self._wake()

    def stop(self) -> None:
        self._all_changed = True
        self._page.stop()
        self._pool.leave()
        self._worker.stop()

    def until_shown(self, patience: float) -> None:
        """Wait until the first solution is shown, at most `patience` [s]."""
        self._shown.wait(patience)

    @one_blas_thread()  # The pictures too: in a notebook's process they would take ten times as long.
    def _update(self, superseded: Callable[[], bool]) -> None:
        """One slider step; `superseded` gives way to the frames of other pages, then says whether to stop."""
        self._begun = time.thread_time()
        everything, self._all_changed = self._all_changed, False
        reading = self._read()
        solution = self._solve(reading, superseded)
        if solution is not None:
            self._draw(reading, solution, everything)
            self._follow(reading, solution, everything, superseded)

    def _read(self) -> Reading:
        """Widgets → design."""
        page = self._page
        inputs, view = page.read()
        try:
            sliders = inputs.design()
            design = page.driven(sliders)
        except ValueError as error:
            return Reading(inputs, view, problem=str(error))
        # The designs of a search are shown without actuator, so a driven actuator takes precedence.
        preview = page.preview(sliders) if design == sliders else None
        return Reading(inputs, view, sliders, preview or design, preview is not None)

    def _solve(self, reading: Reading, superseded: Callable[[], bool]) -> Solution | None:
        """Design → converged solution; None if there is none, or if the sliders were moved meanwhile."""
        design = reading.design
        if design is None:
            self._latest = None
        elif self._latest is None or self._latest.design != design:
            pause = superseded.pause if isinstance(superseded, Superseded) else None
            options = replace(DEFAULT_OPTIONS, stop=lambda: superseded() and self._all_changed, pause=pause)
            found = solve(design, self._good, options)
            if not found.converged and self._overtaken():
                return None  # Perhaps stopped on its way; the next update solves what is on the sliders now.
            self._latest = found
        solution = self._latest
        inputs = with_optimum(reading.inputs, design) if design and reading.previewed else reading.inputs
        if self._page.pin_or_swap(inputs, solution):
            return None
        if solution is None or not solution.converged:
            self._show_failure(Failure(reading, solution, self._good))
            return None
        self._good = solution
        return solution

    def _draw(self, reading: Reading, solution: Solution, everything: bool) -> None:
        """Solution → the frame. A is solved before the frame only where the scene shows it."""
        wanted = reading.view.difference or reading.view.beside
        pinned = self._page.solve_pinned(solution.design, self._overtaken()) if wanted else None
        self._page.show_frame(Frame(reading, solution, pinned, only_azimuth=not everything))

    def _follow(self, reading: Reading, solution: Solution, everything: bool, superseded: Callable[[], bool]) -> None:
        """Everything else, in order of how soon it is needed; stops early when the sliders move on."""
        page, design = self._page, solution.design
        baseline = self._baseline.solve(baseline_of(design))
        pinned = page.solve_pinned(design, self._overtaken())
        state = SessionState(reading.inputs, reading.view, solution, baseline, pinned, page.pin)
        before, self._state = self._state, state
        if not everything and state.only_turned(before):
            page.show_azimuth(state)
            return
        self._frames_took += time.thread_time() - self._begun
        if SCHEDULER.waiting and self._frames_took < _FRAMES_TO_CHARTS * self._charts_took:
            page.show_power_number(state)  # Half of a step's time are charts: in a crowd frames come first.
            if self._overtaken():
                return
            self._worker.pause(_STILL)  # The next step of a drag is on its way, or nothing moves any more.
            if self._overtaken():
                return
        begun = time.thread_time()
        page.show_results(reading, state)

        def show_power() -> None:
            page.show_power(state, self._curves.known(design, state.reference.design))

        def stop() -> bool:
            return superseded() and self._all_changed

        show_power()
        if not self._overtaken():
            page.follow(reading, state)
        self._charts_took, self._frames_took = time.thread_time() - begun, 0.0
        self._shown.set()
        self._worker.pause(_STILL)
        if not stop():
            page.settle(state)
            self._worker.answer()
        elif self._curves.recent:
            return
        # On a test stand measured points take the place of power over µ.
        swept = set_shown(solution) is not None or self._curves.sweep(design, state.reference.design, stop, show_power)
        if swept and not stop():
            page.rest(state, stop)
            if self._curves.widen(design, stop):
                show_power()

    def _show_failure(self, failure: Failure) -> None:
        """The last converged picture stays, grey, with the sentence."""
        self._page.show_failure(failure)
        self._shown.set()
        if (last := self._state) is not None:
            curve = self._curves.known(last.solution.design, last.reference.design)
            self._page.show_power(last, curve, failed=True)

    def _wake(self) -> None:
        """Something changed."""
        self._all_changed = True
        self._worker.wake()

    def _tell_idle(self, client: viser.ClientHandle, asked: tuple[int, bool]) -> None:
        """Give the page its number back once all that it sent before is answered (`RX.idle`)."""
        number, wholly = asked
        until_called(client)
        self._worker.until_answered(wholly)
        self.page.bridge.set(idle=number)

    def _overtaken(self) -> bool:
        """Whether a newer update waits that changes more than the azimuth of the reference blade."""
        return self._all_changed and self._worker.superseded

    def _freeing(self, idle: IdleTimeout | None) -> IdleTimeout | None:
        """The same with the caches freed when the page falls asleep; the next touch fills them again."""

        def on_sleep() -> None:
            self._latest, self._baseline, self._curves = None, solver.BaselineCache(), PowerCurves()
            if idle is not None:
                idle.on_sleep()

        return idle and replace(idle, on_sleep=on_sleep)

    def _failed(self, error: Exception) -> None:
        self._shown.set()
        _log.error("an update failed", exc_info=error)
        self._page.show_error(f"This update failed ({error}): move any slider to go on.")

"""One browser's session: its page, its worker thread, and the path from a slider to the picture.

`_update` is the path; docs/developers/slider.md has its steps. A widget's callback only calls `wake`, on a thread of
viser's; `NewestWins` runs `_update` on one of a few threads, and wakes in between need only one more run. Before the
frame is sent only what it shows is computed. What follows it is done in steps, which a newer update ends.
"""

import logging
import math
import threading
import time
from collections.abc import Generator, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from typing import TypeVar

import viser

from explorer.charts.measured import set_shown
from explorer.charts.plots import PowerCurves
from explorer.hosting.messages import PageFacts
from explorer.hosting.server_limits import trim_memory_soon
from explorer.hosting.viser_compat import wait_for_callbacks
from explorer.model.inputs import Inputs, baseline_of, with_optimum
from explorer.model.session_state import SessionState
from explorer.page import Page, Urgency
from explorer.parts.presses import IdlePress
from explorer.views.page_state import PageState
from explorer.widgets.controls import SessionCallbacks
from explorer.workers import solver
from explorer.workers.newest_wins import GIVE_WAY, UPDATES, NewestWins
from rotor import Design, Solution
from rotor.support.blas_threads import one_blas_thread
from rotor.support.processes import Processes
from rotor.trim.newton import FEW_DIGITS

_log = logging.getLogger(__name__)
T = TypeVar("T")
_STILL = 0.25
"""[s] without a change after which nothing is dragged; less would delay the frames of keys pressed one by one."""
_DRAGGED = 0.5
"""[s] from a frame to the next change within a drag, at most, however long the frame itself took."""


class Session:
    """Exists from connect to disconnect. After construction everything happens in updates, one at a time."""

    def __init__(
        self, client: viser.ClientHandle, start: Inputs, facts: PageFacts, pool: Processes
    ) -> None:
        """`start`: used where the page's address holds no design."""
        self._latest: Solution | None = None
        self._good: Solution | None = None
        """The last converged solution: what the picture shows."""
        self.shown = threading.Event()
        """Set once the page has its first solution, or the sentence why there is none."""
        self._all_changed = True
        """Whether more than the azimuth of the reference blade may have changed since the last update."""
        self._curves = PowerCurves()
        self._framed = -math.inf
        """When the last update ended."""
        self._waits = ThreadPoolExecutor(1, "idle")  # Presses go on meanwhile.
        self._rough = self._settling = False
        """Whether the latest solution is one of a moving slider; whether the next update solves to the end."""
        # A link with A wakes it before the page is whole.
        self._worker = NewestWins(self._update, self._failed, held=True)
        self._client = client
        callbacks = SessionCallbacks(self._wake, self._worker.wake, lambda: self.page.latest.state)
        self.page = Page(client, start, facts, pool, callbacks)
        self._baseline = solver.BaselineCache(by=self.page.context.analyses.solve)

    def start(self) -> None:
        self.page.context.bridge.on(
            "idle", lambda asked: self._waits.submit(self._answer_when_idle, asked)
        )
        self.page.context.bridge.on("seen", self._see, at_once=True)
        self.page.start()
        self._wake()
        self._worker.release()

    def stop(self) -> None:
        self._all_changed = True
        self.page.stop()
        self._worker.stop()
        self._waits.shutdown(wait=False, cancel_futures=True)

    @one_blas_thread()  # The pictures too: in a notebook's process they would take ten times as long.
    def _update(self) -> Iterator[float] | None:
        """One slider step up to its frame; returns the steps that follow, None where only the blade was turned."""
        try:
            return self._step()
        finally:
            self._framed = time.monotonic()
            trim_memory_soon()

    def _step(self) -> Iterator[float] | None:
        everything, self._all_changed = self._all_changed, False
        dragged = self._worker.woken - self._framed < _DRAGGED
        moving, self._settling = dragged and not self._settling, False
        now, design = self._read()
        solution = self._solve(now, design, moving)
        if solution is None:
            return iter(())
        page, pinboard, view = self.page, self.page.context.pinboard, now.view
        # A is solved before the frame only where the scene shows it.
        shown = view.difference or view.wipe
        pinned = pinboard.solve(solution.design, self._overtaken(), moving) if shown else None
        page.draw(now, solution, pinned, only_azimuth=not everything)
        # What stands beside the frame would not be seen.
        if self._overtaken() and not UPDATES.waiting:
            return iter(())
        as_built = page.counted_from(now) or baseline_of(solution.design)
        baseline = (
            solution if as_built == solution.design else self._baseline.solve(as_built, moving)
        )
        pinned = pinboard.solve(solution.design, self._overtaken(), moving)
        state = SessionState(now.inputs, view, solution, baseline, pinned, pinboard.pinned)
        now = replace(now, state=state)
        if not everything and state.only_turned(page.latest.state):
            page.show(now, "azimuth")
            return None
        page.show(now, "address")
        if UPDATES.busy:  # The number goes with the frame: charts wait for those of other pages, and for their sweeps.
            page.show(now, "number")
        return self._in_turn(self._follow(state, dragged, moving))

    @staticmethod
    def _in_turn(steps: Iterator[float]) -> Iterator[float]:
        """The steps of an update with one BLAS thread each."""
        while True:
            with one_blas_thread():
                pause = next(steps, None)
            if pause is None:
                return
            yield pause

    def _read(self) -> tuple[PageState, Design | None]:
        """What the page asks for at this instant, and the design to solve; None where it asks for none."""
        now = self.page.read()
        try:
            sliders = now.inputs.design()
            design = now.hand.fit(sliders)
        except ValueError as error:
            return replace(now, problem=str(error)), None
        # The designs of a search are shown without actuator, so an actuator on board takes precedence.
        preview = self.page.optimise.preview(sliders) if design == sliders else None
        return replace(now, sliders=sliders, preview=preview), preview or design

    def _solve(self, now: PageState, design: Design | None, moving: bool) -> Solution | None:
        """Design → converged solution; None if there is none, or if the sliders were moved meanwhile."""
        if design is None:
            self._latest = None
        elif self._latest is None or self._latest.design != design or (self._rough and not moving):
            for options in solver.tries(moving):
                answer = self.page.context.analyses.solve(
                    design, self._good, replace(options, stop=self._overtaken)
                )
                if not answer.converged and self._overtaken():
                    return None  # Perhaps stopped on its way; the next update solves what is on the sliders now.
                self._latest, self._rough = answer, options is FEW_DIGITS
                if answer.converged:
                    break
        solution = self._latest
        inputs = now.inputs if now.preview is None else with_optimum(now.inputs, now.preview)
        if self.page.pin_or_swap(inputs, solution):
            return None
        if solution is None or not solution.converged:
            self._show_failure(now if solution is None else replace(now, problem=solution.message))
            return None
        self._good = solution
        return solution

    def _follow(self, state: SessionState, dragged: bool, moving: bool) -> Iterator[float]:
        """Everything else, in order of how soon it is needed; `dragged`: another update was just before this one;
        `moving`: what it shows was not solved to the end.

        Each step shows the latest state: the blade may have been turned since.
        """
        page, design, reference = self.page, state.solution.design, state.reference.design

        def show(*urgencies: Urgency) -> None:
            for urgency in urgencies:
                page.show(page.latest, urgency)

        def show_with_curve(urgency: Urgency) -> None:
            page.show(replace(page.latest, curve=self._curves.known(design, reference)), urgency)

        def sweep() -> Generator[float, None, bool]:
            # On a test stand measured points take the place of power over µ.
            if set_shown(state.solution) is not None:
                return True
            known = partial(show_with_curve, "power")
            return (
                yield from _giving_way(
                    self._curves.sweep(design, reference, self._overtaken, known)
                )
            )

        show_with_curve("results")
        yield 0.0
        show("tabs")
        self.shown.set()
        yield 0.0
        if dragged and not self._curves.recent and not UPDATES.crowded:
            yield from sweep()  # So that the curve follows a long drag.
        yield _STILL  # The next step of a drag is on its way, or nothing moves any more.
        if moving:
            self._settling = True
            self._wake()
            return
        show("rest")
        yield from _giving_way(page.work())
        show("kept")  # Before the power curve, since an early reload must find it.
        self._worker.answer()
        yield 0.0
        if (yield from sweep()) and not self._overtaken():
            yield 0.0
            show("rest", "kept")
            yield from _giving_way(page.work())
            yield from _giving_way(page.work_later())

    def _show_failure(self, now: PageState) -> None:
        """The last converged picture stays, grey, with the sentence."""
        last = now.state
        curve = (
            None
            if last is None
            else self._curves.known(last.solution.design, last.reference.design)
        )
        self.page.show_failure(replace(now, curve=curve), self._good)
        self.shown.set()

    def _wake(self) -> None:
        self._all_changed = True
        self._worker.wake()

    def _answer_when_idle(self, asked: IdlePress) -> None:
        """Give the page its number back once all that it sent before is answered (`RX.idle` of frame.js)."""
        wait_for_callbacks(self._client)
        self._worker.until_answered(
            asked.wholly, lambda: any(is_waiting() for is_waiting in self.page.context.waiting)
        )
        self.page.context.bridge.set(idle=asked.serial)

    def _see(self, seen: bool) -> None:
        """The tab came to the front, or was hidden."""
        for rest in self.page.context.resting:
            rest(not seen)
        (self._worker.release if seen else self._worker.hold)()

    def _overtaken(self) -> bool:
        """Whether a newer update waits that changes more than the azimuth of the reference blade."""
        return self._all_changed and self._worker.superseded

    def _failed(self, error: Exception) -> None:
        """Nothing that the update may have left half done is used by the next."""
        self.shown.set()
        self._latest = self._good = None
        self._all_changed = True
        self._baseline, self._curves = (
            replace(self._baseline, design=None, solution=None),
            PowerCurves(),
        )
        _log.error("an update failed", exc_info=error)
        self.page.show_error(f"This update failed ({error}): move any slider to continue.")


def _giving_way(steps: Iterator[None] | Generator[None, None, T]) -> Generator[float, None, T]:
    """What these steps return, as steps of an update."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value
        yield GIVE_WAY

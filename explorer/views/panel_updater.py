"""Brings panels to the page: asks their questions, views what is seen, sends what changed, does what a press says."""

import threading
import time
from collections.abc import Callable, Generator, Hashable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from explorer.hosting.browser import Bridge
from explorer.views.page_state import (
    Effect,
    OpenPanels,
    PageState,
    Panel,
    PanelMemory,
    PanelWork,
    Press,
    Questions,
    SetGrabbed,
)
from explorer.workers.background import PoolAnswers, all_known
from rotor.support.processes import Processes

_UNSENT = object()


class PanelUpdater:
    """Updates the panels of one page; safe from any thread. Presses run on that of the bridge or of the keyboard."""

    def __init__(
        self,
        panels: Sequence[Panel],
        bridge: Bridge,
        bind: Callable[[str, Callable[[], None]], None],
        texts: Mapping[str, Callable[[Any], None]],
        pool: Processes,
        wake: Callable[[], None],
        now: Callable[[], PageState],
        pressed: Callable[[], PageState],
        perform: Callable[[Effect], None],
    ) -> None:
        """`bind`: gives a command of the keyboard its action. `wake`: called when an answer came.
        `texts`: what shows a value that is no part of the frame, by its name.

        `now`: what is known as of the last update; `pressed`: at a press. `perform`: does one effect of a press.
        """
        self._panels, self._bridge, self._texts = tuple(panels), bridge, texts
        self._pool, self._wake, self._now, self._pressed, self._perform = (
            pool,
            wake,
            now,
            pressed,
            perform,
        )
        self._queues: list[dict[int, PoolAnswers]] = [{} for _ in self._panels]
        """Of each panel, by urgency."""
        self._following = threading.RLock()
        self.memory = PanelMemory()
        self._done: dict[Hashable, Any] = {}
        self._begun: dict[Hashable, Generator[None, None, Any]] = {}
        """The page's own work by its key: done, and half done."""
        self._sent: dict[str, Any] = {}
        self._stand: list[set[str]] = [set() for _ in self._panels]
        """Of each panel, the parts of the frame that it has shown. No two panels have one in common."""
        self._place: tuple[Hashable, ...] = ()
        """What hands move, as of the last `follow`."""
        self._moved = time.monotonic()
        """When that moved last."""
        for panel in self._panels:
            for name, press in panel.presses.items():
                bridge.on(name, act := partial(self.press, press, panel.seen))
                if name in panel.keys:
                    bind(name, partial(act, None))

    def answers(self) -> dict[Hashable, Any]:
        """What worker processes have answered by now, and why not what they could not; and the page's own results."""
        queues = [queue for each in self._queues for queue in list(each.values())]
        return (
            {call: why for queue in queues for call, why in queue.failures.items()}
            | all_known()
            | self._done
        )

    def work(self, soon: bool) -> Iterator[None]:
        """Steps of the page's own work that is wanted, `soon` or later; each result is shown as it comes.

        A result is kept while it is wanted, and work that is left half done goes on the next time.
        """
        now = self._now()
        wanted: dict[Hashable, tuple[PanelWork, list[Panel]]] = {}
        for panel in self._panels:
            for work in panel.works(now) if panel.seen(now.ui) else ():
                wanted.setdefault(work.key, (work, []))[1].append(panel)
        self._begun = {key: steps for key, steps in self._begun.items() if key in wanted}
        self._done = {key: result for key, result in self._done.items() if key in wanted}
        for key, (work, panels) in wanted.items():
            if work.soon != soon or key in self._done:
                continue
            show = partial(self.follow, panels.__contains__)
            steps = self._begun.get(key) or work.run(show)
            while True:
                self._begun.pop(key, None)  # What fails begins anew.
                try:
                    next(steps)
                except StopIteration as end:
                    result = end.value
                    break
                self._begun[key] = steps
                yield
            self._done = {**self._done, key: result}
            self.memory = replace(self.memory, latest={**self.memory.latest, work.name: result})
            show()

    def follow(self, only: Callable[[Panel], bool] = lambda panel: True) -> None:
        """Ask and view what is seen, and send what is other than before; `only`: of these panels.

        The parts of a panel that is no longer seen are sent as absent. Its texts are hidden with their widgets.
        """
        with self._following:
            effects = self._send(self._now(), only)
        for effect in effects:
            self._perform(effect)

    def _send(self, now: PageState, only: Callable[[Panel], bool]) -> tuple[Effect, ...]:
        """Bring these panels to the page; returns what they move there."""
        place = now.inputs, now.hand.actuator, now.hand.place
        if place != self._place:
            self._place, self._moved = place, time.monotonic()
        changed: dict[str, Any] = {}
        effects: tuple[Effect, ...] = ()
        for panel, queues, stand in zip(self._panels, self._queues, self._stand, strict=True):
            if not only(panel):
                continue
            seen = panel.seen(now.ui)
            self._ask(queues, panel.asks(now) if seen else ())
            shown = panel.view(now) if seen else dict.fromkeys(stand)
            stand |= shown.keys() - self._texts.keys()
            effects += panel.reacts(now) if seen else ()
            self.memory = panel.remember(replace(now, memory=self.memory), shown)
            changed |= {
                name: value
                for name, value in shown.items()
                if self._sent.get(name, _UNSENT) != value
            }
        self._sent |= changed
        for name in changed.keys() & self._texts.keys():
            self._texts[name](changed.pop(name))
        if changed:
            self._bridge.set(**changed)
        return effects

    def is_waiting(self) -> bool:
        """Whether worker processes have still to answer."""
        return any(queue.is_waiting() for queues in self._queues for queue in list(queues.values()))

    def rest(self, resting: bool) -> None:
        """Whether worker processes begin nothing more for the panels."""
        with self._following:
            for queue in (queue for queues in self._queues for queue in queues.values()):
                queue.rest(resting)

    def stop(self) -> None:
        for queues in self._queues:
            for queue in queues.values():
                queue.stop()

    def _ask(self, queues: dict[int, PoolAnswers], asks: Sequence[Questions]) -> None:
        by_urgency = {one.urgency: one for one in asks}
        for urgency in by_urgency.keys() - queues.keys():
            queues[urgency] = PoolAnswers(self._pool, urgency, self._wake)
        still = time.monotonic() - self._moved
        for urgency, queue in queues.items():
            one = by_urgency.get(urgency, Questions(urgency, (), 0.0))
            queue.ask(one.calls, max(one.delay - still, 0.0))

    def press(self, press: Press, seen: Callable[[OpenPanels], bool], value: Any) -> None:
        """Do what it says, where its panel is seen; of a widget too."""
        now = self._pressed()
        is_seen = seen(now.ui)
        for effect in press(now, value):
            # What is let go meanwhile must not stay in the hand.
            if is_seen or effect == SetGrabbed(False):
                self._perform(effect)

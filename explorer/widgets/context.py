"""What the parts of one page share, and a clock for those that play."""

import logging
import threading
import time
from collections.abc import Callable

import viser

from explorer.hosting.browser import Bridge
from explorer.model.inputs import Inputs
from explorer.model.session_state import Pinboard, Pinned, SessionState
from explorer.model.undo import PowerTracker
from explorer.model.units import Units, units_of
from explorer.views.page_state import PageState
from explorer.widgets.controls import DesignControls, SessionCallbacks
from explorer.widgets.display import Display
from explorer.widgets.layout import Keyboard, Layout
from explorer.workers.background import LongWork
from rotor import Design
from rotor.support.processes import Processes
from rotor.support.user_input import brief

_log = logging.getLogger(__name__)

BEAT = 0.05
"""Time between steps of a clock [s]: a browser is asked to draw at most 20 times a second."""


class TabContext:
    """The context of one page: its frame, the sliders of Explore, and what its parts share. Safe from any thread."""

    def __init__(
        self,
        client: viser.ClientHandle,
        start: PageState,
        pool: Processes,
        callbacks: SessionCallbacks,
    ) -> None:
        self.client = client
        self.gui = client.gui
        self.bridge = Bridge(client)
        self.pool = pool
        self.wake, self.state = callbacks.wake, callbacks.state
        self.tracker, self.pinboard = PowerTracker(), Pinboard(start.analyses.solve)
        self.analyses, self.work = start.analyses, LongWork(pool, callbacks.wake)
        self.keyboard, self.layout = Keyboard(client, self.bridge), Layout(client.gui, self.bridge)
        self.layout.watchers.append(callbacks.wake)
        self.display = Display(self.bridge, start.view, callbacks.wake, callbacks.azimuth_changed)
        with self.layout.modes["explore"]:
            self.controls = DesignControls(
                client.gui, self.bridge, start.inputs, self.tracker, callbacks
            )
        self.refreshing: list[Callable[[Design | None], None]] = []
        """Called after every frame with the design on the sliders; None: they mean none."""
        self.following: list[Callable[[SessionState | None], None]] = []
        """Called once the panels have followed an update; None: the inputs have no solution."""
        self.resting: list[Callable[[bool], None]] = []
        """Called with whether the page is hidden: then only what is under way is computed for it, and searches."""
        self.waiting: list[Callable[[], bool]] = []
        """Whether workers have still to answer what parts of the page asked."""
        self.leaving: list[Callable[[], None]] = []
        """Called once the browser has left: end threads and jobs."""
        self.whole = threading.RLock()
        """Held while the page is put into another state, or read: no update sees half of one."""

    def inputs(self) -> Inputs:
        return self.controls.inputs()

    def set_inputs(self, inputs: Inputs) -> None:
        """Move the sliders, not by hand: no change of power since an earlier grab counts."""
        self.tracker.reset()
        self.controls.set_inputs(inputs)

    def drag_to(self, inputs: Inputs) -> None:
        """Move the sliders as a hand does."""
        self.tracker.touch()
        self.controls.set_inputs(inputs)

    @property
    def units(self) -> Units:
        return units_of(self.display.view.units, self.controls.aircraft)

    def pin(self, design: Pinned | Inputs | None) -> None:
        """Pin this design as A, whatever is on the sliders; None removes the pin."""
        self.pinboard.put(design)
        self.wake()

    def download(self, name: str, content: bytes) -> None:
        """Send a file to the browser, which saves it at once."""
        self.client.send_file_download(name, content, save_immediately=True)

    def notify(self, title: str, sentence: str) -> None:
        self.client.add_notification(title, brief(sentence), auto_close_seconds=6)


class Player:
    """A clock that advances something in small steps, on a thread of its own while it plays; safe from any thread."""

    def __init__(self, step: Callable[[float], None], name: str) -> None:
        """`step` is called with the time [s] since its last call, or since play was pressed."""
        self._step = step
        self._name = name
        self._lock = threading.Lock()
        self._pause: threading.Event | None = None
        """Set to pause the thread that plays now; None when none does."""
        self._resting = False

    @property
    def playing(self) -> bool:
        return self._pause is not None

    def play(self) -> None:
        """Start, unless it plays already."""
        with self._lock:
            if self._pause is None:
                pause = self._pause = threading.Event()
                threading.Thread(
                    target=self._run, args=(pause,), name=self._name, daemon=True
                ).start()

    def rest(self, resting: bool) -> None:
        """Whether it stands still, and plays on later."""
        self._resting = resting

    def pause(self) -> None:
        """No step begins after this."""
        with self._lock:
            if self._pause is not None:
                self._pause.set()
                self._pause = None

    def _run(self, pause: threading.Event) -> None:
        before = time.monotonic()
        while not pause.wait(BEAT):
            now = time.monotonic()
            try:
                if not self._resting:
                    self._step(now - before)
            except Exception:  # The browser may have gone.
                _log.exception("play ended")
                self.pause()
            before = now

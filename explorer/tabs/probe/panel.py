"""The Probe tab of one browser: a blade element at (r, ψ), set by sliders, keys or a click on the disk; and play."""

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import viser

from explorer.interface import SessionState, TabContext
from explorer.picture.moving_blades import blade_twists
from explorer.picture.pick import pick
from explorer.scene.page_scene import TURN_RATE
from explorer.tabs.keys.names import COARSE
from explorer.tabs.probe.cursor import Cursor
from explorer.tabs.probe.element import Probe, probe
from explorer.tabs.probe.readout import probe_panel
from explorer.text.glossary import hint
from explorer.text.readout import faded
from explorer.workers.player import Player
from rotor.design.blade import Rotor
from rotor.trim.solution import Solution

LONGEST = 600.0
"""Play ends after this time [s]: a page that was forgotten may fall asleep."""
_R_STEP, _PSI_STEP = 0.01, 1.0
_STEPS = {"out": (_R_STEP, 0.0), "in": (-_R_STEP, 0.0), "on": (0.0, _PSI_STEP), "back": (0.0, -_PSI_STEP)}


@dataclass(frozen=True)
class _ProbePoint:
    """What the widgets say."""

    r: float
    psi_deg: float
    shown: bool
    opened: bool


class ProbePanel:
    """Widgets, cursor and clock. Clicks and keys only move widgets; everything is drawn on the session's worker."""

    def __init__(
        self,
        client: viser.ClientHandle,
        context: TabContext,
        playing: Callable[[bool], None],
        opened: Callable[[], None],
    ) -> None:
        """`playing`: hears whether the rotor turns by itself. `opened`: a click on the disk wants the probe shown."""
        self._playing, self._open = playing, opened
        self._client, self._context = client, context
        self._seen = True
        self._drawn: tuple[Solution, _ProbePoint, float | None] | None = None
        self._html = ""
        self._cursor = Cursor(client.scene)
        self._player = Player(self._walk, f"play-{client.client_id}")
        self._hand = threading.Lock()
        """Held by whoever turns the blade: the clock or the user."""
        self._walked: float | None = None
        """Where the clock left the reference blade [deg]."""
        self._left = 0.0
        """How long it may play on [s]."""
        gui = client.gui
        self._r = gui.add_slider("Radius r/R", 0.5, 1.0, _R_STEP, 0.75, hint=hint("probe_r"))
        self._psi = gui.add_slider("Azimuth ψ [°]", 0.0, 360.0, _PSI_STEP, 60.0, hint=hint("probe_psi"))
        self._panel = gui.add_html("")
        self._follow = gui.add_checkbox("Follow the reference blade", True, hint=hint("probe_follow"))
        self._shown = gui.add_checkbox("Show on the disk", False, hint=hint("probe_shown"))
        self._opened = gui.add_checkbox("Enlarge angles", False, hint=hint("probe_opened"))
        self._psi.on_update(lambda event: self._psi_moved(event.target.value) if event.client is not None else None)
        self._r.on_update(lambda event: self._moved() if event.client is not None else None)
        for box in (self._follow, self._shown, self._opened):
            box.on_update(lambda event: context.wake() if event.client is not None else None)
        client.scene.on_click()(self._clicked)
        self._bind()

    def show(self, state: SessionState) -> None:
        """Follow a converged answer, or the reference blade."""
        if self._follow.value:
            # Where the blade is by now: an older place would pull a slider that is dragged back.
            self._psi.value = self._context.view().azimuth_deg
        solution = state.solution
        self._r.min = _innermost(solution.design.rotor)
        place = self._place()
        here = self._probe(solution, place)
        tied = (
            self._follow.value or abs(math.remainder(place.psi_deg - state.view.azimuth_deg, 360.0)) < 0.5 * _PSI_STEP
        )
        pitch = _drawn_pitch(state, here) if tied else None
        if self._drawn == (solution, place, pitch):
            return
        self._drawn = solution, place, pitch
        self._html = probe_panel(here, solution, place.opened)
        self._panel.content = self._html
        with self._client.atomic():
            if place.shown:
                self._cursor.show(solution.design.rotor, here, pitch)
            else:
                self._cursor.hide()

    def show_failure(self) -> None:
        """The inputs have no answer: what stands here is of the last one."""
        self._pause()
        self._drawn = None
        self._panel.content = faded(self._html)
        self._cursor.hide()

    def stop(self) -> None:
        """The browser has left."""
        self._player.pause()

    def set_seen(self, seen: bool) -> None:
        """Whether the disk is in the scene, to be clicked."""
        self._seen = seen

    def toggle(self) -> None:
        """Play, or pause."""
        if self._player.playing or self._context.state() is None:
            self._pause()
            return
        self._walked, self._left = None, LONGEST
        self._player.play()
        self._playing(True)

    def _pause(self) -> None:
        if self._player.playing:
            self._player.pause()
            self._context.wake()  # What does not follow every turn of the blade follows now.
        self._playing(False)

    def _walk(self, seconds: float) -> None:
        """A step of the clock."""
        with self._hand:
            if self._player.playing:
                self._walk_on(seconds)

    def _walk_on(self, seconds: float) -> None:
        now = self._context.view().azimuth_deg
        self._left -= seconds
        if (self._walked is not None and now != self._walked) or self._left <= 0.0:
            self._pause()  # The user has taken the blade, or gone.
            return
        self._walked = (now + math.degrees(TURN_RATE) * seconds) % 360.0
        self._context.set_azimuth(self._walked)

    def _place(self) -> _ProbePoint:
        return _ProbePoint(self._r.value, self._psi.value, self._shown.value and self._seen, self._opened.value)

    def _probe(self, solution: Solution, place: _ProbePoint) -> Probe:
        r = min(max(place.r, _innermost(solution.design.rotor)), 1.0)
        return probe(solution, r, math.radians(place.psi_deg))

    def _set(self, r: float, psi_deg: float | None = None) -> None:
        """Move the probe, and with it the reference blade where they are tied; without ψ only along the blade."""
        self._r.value = round(min(max(r, self._r.min), 1.0), 2)
        if psi_deg is None:
            self._moved()
        else:
            self._psi_moved(psi_deg % 360.0)

    def _psi_moved(self, psi_deg: float) -> None:
        if self._follow.value:
            with self._hand:  # No step of the clock comes between.
                self._pause()
                self._context.set_azimuth(psi_deg)
        self._psi.value = psi_deg
        self._moved()

    def _moved(self) -> None:
        self._shown.value = True
        self._context.wake()

    def _step(self, r: float, psi_deg: float) -> None:
        self._set(self._r.value + r, round(self._psi.value) + psi_deg if psi_deg else None)

    def _hide(self) -> None:
        self._shown.value = not self._shown.value
        self._context.wake()

    def _clicked(self, event: viser.SceneClickEvent) -> None:
        state = self._context.state()
        if state is None or not self._seen:
            return
        found = pick(state.solution, event.ray_origin, event.ray_direction)
        if found is not None:
            self._set(found[0], round(math.degrees(found[1])) % 360)
            self._open()

    def _bind(self) -> None:
        bind = self._context.bind_command
        bind("play", self.toggle)
        for name, (r, psi) in _STEPS.items():
            bind(f"probe_{name}", partial(self._step, r, psi))
            bind(f"probe_far_{name}", partial(self._step, COARSE * r, COARSE * psi))
        bind("probe_hide", self._hide)


def _innermost(rotor: Rotor) -> float:
    """The first step of r/R on the blade."""
    return round(_R_STEP * math.ceil(rotor.blade.root_cutout / _R_STEP - 1e-9), 2)


def _drawn_pitch(state: SessionState, here: Probe) -> float:
    """Twist of the reference blade at the probe as it is drawn [rad]: in the blade's own axes, exaggerated."""
    design = state.solution.design
    twist = (*blade_twists(design, (math.radians(state.view.azimuth_deg),)), design.twist)[0]
    return state.view.exaggeration * float(twist([here.r])[0])

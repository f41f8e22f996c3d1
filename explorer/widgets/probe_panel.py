"""The probe of one browser: a blade element at (r, ψ), and its cursor in the scene."""

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import viser

from explorer import colours
from explorer.charts.probe_drawing import outline, probe_panel
from explorer.charts.probe_measured import AirloadComparison, airload_comparison, measured_panel
from explorer.hosting.browser import Bridge
from explorer.model.session_state import SessionState
from explorer.model.units import number
from explorer.parts.presses import SectionPress
from explorer.parts.stage import SceneLabel
from explorer.picture.blade_mesh import circle_segments, drawn_pitch, swept_back
from explorer.picture.camera_views import pick, pick_blade
from explorer.picture.element import Probe, probe
from explorer.picture.picture import (
    LINE_LIFT,
    axis_rotation,
    drawn_bending,
    drawn_times,
    flown_twist,
    rotate,
)
from explorer.picture.ride import FIRST_PSI, telling_station, turn_of
from explorer.scene.controller import TURN_RATE, SceneController
from explorer.text.glossary import hint
from explorer.text.readout import answers, outdated
from explorer.widgets.context import Player, TabContext
from explorer.widgets.layout import COARSE, by_hand
from rotor import Rotor, Solution
from rotor.support.arrays import Array
from rotor.support.markup import Markup

Cased = tuple[viser.LineSegmentsHandle, viser.LineSegmentsHandle]
"""The dark line and the light one."""

_DISK, _BLADE = "/rotor/disk/probe", "/rotor/blade_0/probe"
_RING = 0.036
"""Radius of the ring [R]."""
_LABEL_ABOVE = 0.4
"""Height of the label above the probe [m]."""
_WIDER = 1.16
"""The dark ring about the light one, in its radii."""


class ProbeCursor:
    """On the reference blade, where that is at the probe, else on the disk. Handles are made once."""

    def __init__(self, api: viser.SceneApi, bridge: Bridge) -> None:
        self._bridge = bridge
        self._rotor: Rotor | None = None
        self._turned = api.add_frame(_DISK, show_axes=False, visible=False)
        self._at = api.add_frame(f"{_DISK}/at", show_axes=False)
        self._ray = _cased(api, f"{_DISK}/ray", 1.2, 2.8)
        self._ring = _cased(api, f"{_DISK}/at/ring", 2.2, 1.4)
        self._on_blade = _cased(api, _BLADE, 2.2, 1.4)
        for handle in self._on_blade:
            handle.visible = False
        self._drawn: tuple[object, ...] | None = None

    def show(
        self, rotor: Rotor, probe: Probe, pitch: float | None, bent: Array | None = None
    ) -> None:
        """At the probe; `pitch`: of the blade's own section there, as it is drawn [rad], None: no blade is there.
        `bent`: where bending moves the section to, as drawn [m], (1, 3)."""
        self._scale(rotor)
        node, at = f"{_DISK}/at", np.zeros(3)
        self._turned.visible = pitch is None
        if pitch is None:
            self._turned.wxyz = axis_rotation(2, probe.psi)
            self._at.position = np.array([probe.radius, 0.0, 0.0])
        else:
            node, at[0] = "/rotor/blade_0", probe.radius - rotor.blade.flap_hinge * rotor.radius
            at += 0.0 if bent is None else bent[0]
        words = f"α {number(math.degrees(probe.alpha), 1)}°"
        above = (at + np.array([0.0, 0.0, _LABEL_ABOVE])).round(3).tolist()
        self._bridge.set(probe_label=[SceneLabel(words, node, above)])
        wanted = None if pitch is None else (rotor, probe.r, pitch, at.tolist())
        if wanted == self._drawn:
            return
        self._drawn = wanted
        for handle in self._on_blade:
            handle.visible = pitch is not None
        if pitch is not None:
            _draw_ring(self._on_blade, rotor, at + _on_upper_side(rotor, probe, pitch), pitch)

    def hide(self) -> None:
        self._turned.visible, self._drawn = False, None
        self._bridge.set(probe_label=[])
        for handle in self._on_blade:
            handle.visible = False

    def _scale(self, rotor: Rotor) -> None:
        """Ray and ring of this rotor's size."""
        if rotor == self._rotor:
            return
        self._rotor, radius = rotor, rotor.radius
        ray = np.array(
            [[[rotor.blade.root_cutout * radius, 0.0, 0.0], [(1.0 - _RING) * radius, 0.0, 0.0]]]
        )
        for step, handle in enumerate(self._ray):
            handle.points = (ray + np.array([0.0, 0.0, (2.0 + step) * LINE_LIFT])).astype(
                np.float32
            )
        _draw_ring(self._ring, rotor, np.array([0.0, 0.0, 3.0 * LINE_LIFT]))


def _cased(api: viser.SceneApi, name: str, pixels: float, casing: float) -> Cased:
    """A light line and a dark one, that read on every colour of the disk and on the blade; no place as yet."""
    some = circle_segments(0.1, 8).astype(np.float32)
    under, over = (
        api.add_line_segments(name + end, some, colour, thickness=width, thickness_units="screen")
        for end, colour, width in (
            ("_casing", colours.CASING_DARK, casing),
            ("", colours.CASING_LIGHT, pixels),
        )
    )
    return under, over


def _draw_ring(lines: Cased, rotor: Rotor, middle: Array, pitch: float = 0.0) -> None:
    """About a point [m], tilted by a pitch [rad]; the dark ring lies beside the light one, or it would cover it."""
    for handle, wider in zip(lines, (_WIDER, 1.0), strict=True):
        ring = circle_segments(wider * _RING * rotor.radius, 28)
        handle.points = (middle + rotate(axis_rotation(0, pitch), ring)).astype(np.float32)


def _on_upper_side(rotor: Rotor, probe: Probe, pitch: float) -> Array:
    """From the pitch axis to the middle of the probed section's upper side, in the blade's own axes [m]."""
    chord, top = float(rotor.blade.chord(probe.r)), float(outline(probe.section)[:, 1].max())
    aft = 0.25 * chord + float(swept_back(rotor, probe.r))
    return rotate(axis_rotation(0, pitch), np.array([0.0, -aft, top * chord]))


class RideAlong:
    """The page moves camera, rotor and arrows by itself; a new answer during the turn changes what it reads."""

    def __init__(
        self, context: TabContext, scene: SceneController, playing: Callable[[], bool]
    ) -> None:
        """`playing`: whether the rotor turns by itself."""
        self._context, self._scene, self._playing = context, scene, playing
        self._at: tuple[float, float] | None = None
        """r/R and the azimuth where the turn began [°]."""
        self._shown: Solution | None = None
        self._drawer, self._azimuth_deg = "", 0.0
        """The drawer that was open before, and where the reference blade was."""
        self.ended: list[Callable[[], None]] = []
        """Called after a ride, whoever ended it."""

    @property
    def riding(self) -> bool:
        return self._at is not None

    def begin(self, solution: Solution, r: float, psi_deg: float) -> None:
        """Go along; the drawer that is open makes room for the turn."""
        layout = self._context.layout
        if not self.riding:
            self._drawer = layout.drawer
            self._azimuth_deg = self._context.display.view.azimuth_deg
        self._scene.camera.hold(True)
        if layout.drawer:
            layout.show_drawer("")
        self._scene.play(True)
        self._at, self._shown = (r, psi_deg), None
        self.show(solution)

    def show(self, solution: Solution) -> None:
        if self._at is not None and solution is not self._shown:
            self._shown = solution
            self._context.bridge.set(ride=turn_of(solution, *self._at))

    def pass_by(self, psi_deg: float) -> None:
        """The blade of the ride is there: charts along the reference blade follow."""
        if self.riding:
            self._context.display.turn(psi_deg)

    def end(self, *, brought_back: bool = False) -> None:
        """Leave the page as it was before. `brought_back`: the page has flown its camera back already."""
        if self._at is None:
            return
        self._at = self._shown = None
        self._context.bridge.set(ride=None)
        if not self._playing():
            self._scene.play(False)
        camera, layout = self._scene.camera, self._context.layout
        self._context.display.turn(self._azimuth_deg)
        camera.hold(False)
        if not brought_back:
            camera.come_back()
        if self._drawer and not layout.drawer:
            layout.open_drawer(self._drawer)
        for after in self.ended:
            after()


LONGEST = 600.0
"""Play ends after this time [s]: a page that was forgotten may fall asleep."""
_R_STEP, _PSI_STEP = 0.01, 1.0
_STEPS = {
    "out": (_R_STEP, 0.0),
    "in": (-_R_STEP, 0.0),
    "on": (0.0, _PSI_STEP),
    "back": (0.0, -_PSI_STEP),
}


@dataclass(frozen=True)
class _ProbePoint:
    r: float
    psi_deg: float
    marked: bool
    """Whether the disk is in the scene, to mark the place on it."""


class ProbePanel:
    """Widgets, cursor and clock. Clicks and keys only move widgets; everything is drawn on the session's worker."""

    def __init__(self, context: TabContext, scene: SceneController) -> None:
        client, self._context, self._scene = context.client, context, scene
        self.seen = True
        """Whether the disk is in the scene, to be clicked."""
        self._drawn: tuple[Solution, _ProbePoint, float | None] | None = None
        self._html = Markup()
        self._cursor = ProbeCursor(client.scene, context.bridge)
        self._player = Player(self._walk, f"play-{client.client_id}")
        context.resting.append(self._player.rest)
        context.leaving.append(self._player.pause)
        self._hand = threading.Lock()
        """Held by whoever turns the blade: the clock or the user."""
        self._walked: float | None = None
        """Where the clock left the reference blade [deg]."""
        self._left = 0.0
        """How long it may play on [s]."""
        gui = client.gui
        self._r = gui.add_slider("Radius r/R", 0.5, 1.0, _R_STEP, 0.75, hint=hint("probe_r"))
        self._psi = gui.add_slider(
            "Azimuth ψ [°]", 0.0, 360.0, _PSI_STEP, 60.0, hint=hint("probe_psi")
        )
        self._panel = gui.add_html("")
        self._comparison: tuple[Solution, float, AirloadComparison | None] | None = None
        """A solution and r/R, and what was measured there."""
        self._follow = gui.add_checkbox(
            "Follow the reference blade", True, hint=hint("probe_follow")
        )
        by_hand(self._psi, self._psi_moved)
        by_hand(self._r, lambda _: self._moved())
        by_hand(self._follow, lambda _: context.wake())
        client.scene.on_click()(self._clicked)
        self.ride = RideAlong(context, scene, lambda: self._player.playing)
        self.ride.ended.append(self._play_on)
        self._played = False
        """Whether the rotor turned by itself before a ride."""
        context.bridge.on("riding", self.ride.pass_by)
        context.bridge.on("section", self.point)
        context.bridge.on("play", lambda _: self.toggle())
        bind = context.keyboard.bind
        bind("play", self.toggle)
        for name, (r, psi) in _STEPS.items():
            bind(f"probe_{name}", partial(self._step, r, psi))
            bind(f"probe_far_{name}", partial(self._step, COARSE * r, COARSE * psi))

    @property
    def riding(self) -> bool:
        """Whether the view goes with a section."""
        return self.ride.riding

    def show(self, state: SessionState | None) -> None:
        """Follow a converged answer, or the reference blade; None: the inputs have no answer."""
        if state is None:
            self._fade()
            return
        if self._follow.value:
            # Where the blade is now: an older place would pull back a slider that is being dragged.
            self._psi.value = self._context.display.view.azimuth_deg
        solution = state.solution
        self.ride.show(solution)
        # The first step of r/R on the blade.
        self._r.min = round(
            _R_STEP * math.ceil(solution.design.rotor.blade.root_cutout / _R_STEP - 1e-9), 2
        )
        place = self._place()
        if self._context.layout.drawer != "probe":
            if self._drawn is not None:
                self._drawn = None
                self._cursor.hide()
            return
        r = min(max(place.r, self._r.min), 1.0)
        here = probe(solution, r, math.radians(place.psi_deg))
        at_blade = (
            self._follow.value
            or abs(math.remainder(place.psi_deg - state.view.azimuth_deg, 360.0)) < 0.5 * _PSI_STEP
        )
        pitch = _drawn_pitch(state, here) if at_blade else None
        if self._drawn == (solution, place, pitch):
            return
        self._drawn = solution, place, pitch
        self._html = probe_panel(here, solution, self._measured(solution, here))
        self._panel.content = answers(self._html)
        with self._context.client.atomic():
            if place.marked:
                bent = drawn_bending(solution, [here.r], math.radians(state.view.azimuth_deg))
                self._cursor.show(solution.design.rotor, here, pitch, bent)
            else:
                self._cursor.hide()

    def _measured(self, solution: Solution, here: Probe) -> Markup:
        """Airloads over the azimuth as HTML; empty where none were measured on this rotor."""
        if self._comparison is None or self._comparison[:2] != (solution, here.r):
            self._comparison = solution, here.r, airload_comparison(solution, here.r)
        beside = self._comparison[2]
        return Markup() if beside is None else measured_panel(beside, here.psi)

    def _fade(self) -> None:
        """What stands here is of the last answer."""
        self.ride.end()
        self._pause()
        self._drawn = None
        self._panel.content = outdated(self._html)
        self._cursor.hide()

    def point(self, at: SectionPress) -> None:
        """A place on the disk was clicked: the drawer shows the section there."""
        self._set(at.r, float(round(at.psi) % 360))

    def toggle(self) -> None:
        if self._player.playing or self._context.state() is None:
            self._pause()
            return
        self._walked, self._left = None, LONGEST
        self._player.play()
        self._set_playing(True)

    def take_along(self, at: SectionPress | None) -> None:
        """Begin a turn with the section there; None: with the chosen one, or else with that which shows most."""
        state = self._context.state()
        if state is None:
            return
        if not self._scene.drawn:
            self._context.notify("No ride", "This browser draws no 3D: use one with WebGL.")
            return
        at = at or self._chosen() or SectionPress(telling_station(state.solution), FIRST_PSI)
        self._played = self._player.playing
        self._pause()
        r = round(min(max(at.r, self._r.min), 1.0), 2)
        self.ride.begin(state.solution, r, at.psi)
        self._context.wake()

    def _chosen(self) -> SectionPress | None:
        """The section that the drawer shows."""
        if self._context.layout.drawer != "probe":
            return None
        return SectionPress(self._r.value, self._psi.value)

    def _play_on(self) -> None:
        """After a ride the rotor turns by itself again, if it did."""
        played, self._played = self._played, False
        if played:
            self.toggle()

    def _pause(self) -> None:
        if self._player.playing:
            self._player.pause()
            self._context.wake()  # Panels that do not follow the turning blade are brought up to date.
        self._set_playing(False)

    def _set_playing(self, playing: bool) -> None:
        """The rotor turns by itself from now on, or stands."""
        self._context.display.set_playing(playing)
        self._scene.play(playing)

    def _walk(self, seconds: float) -> None:
        with self._hand:
            if not self._player.playing:
                return
            now = self._context.display.view.azimuth_deg
            self._left -= seconds
            if (self._walked is not None and now != self._walked) or self._left <= 0.0:
                self._pause()  # The user has taken hold of the blade, or has left.
                return
            self._walked = (now + math.degrees(TURN_RATE) * seconds) % 360.0
            self._context.display.turn(self._walked)

    def _place(self) -> _ProbePoint:
        return _ProbePoint(self._r.value, self._psi.value, self.seen)

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
                self._context.display.turn(psi_deg)
        self._psi.value = psi_deg
        self._moved()

    def _moved(self) -> None:
        self._context.layout.open_drawer("probe")
        self._context.wake()

    def _step(self, r: float, psi_deg: float) -> None:
        self._set(self._r.value + r, round(self._psi.value) + psi_deg if psi_deg else None)

    def _clicked(self, event: viser.SceneClickEvent) -> None:
        state = self._context.state()
        if state is None or not self.seen:
            return
        origin = np.array(event.ray_origin) - self._scene.scene.rotor.frame.position
        on_blade = pick_blade(
            state.solution, self._context.display.view, origin, event.ray_direction
        )
        picked = on_blade or pick(state.solution, origin, event.ray_direction)
        if picked is not None:
            self._set(picked[0], picked[1] if on_blade else round(math.degrees(picked[1])) % 360)


def _drawn_pitch(state: SessionState, here: Probe) -> float:
    """Twist of the reference blade at the probe as it is drawn [rad]: in the blade's own axes, exaggerated."""
    twist = flown_twist(state.solution, math.radians(state.view.azimuth_deg))
    return float(drawn_pitch(twist, [here.r], drawn_times(state.solution.design, state.view))[0])

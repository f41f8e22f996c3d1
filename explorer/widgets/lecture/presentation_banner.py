"""One session's part in a presentation: its presenter, a follower, or neither."""

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np
import viser
from numpy.typing import NDArray

from explorer.charts.histogram import histogram
from explorer.charts.svg import chart_box
from explorer.hosting import browser
from explorer.model.session_state import SessionState
from explorer.sharing.presentation import (
    FOLLOW,
    PRESENT,
    Point,
    Presentations,
    PresentedView,
    follow_name,
    new_secret,
)
from explorer.sharing.share import Address
from explorer.text.glossary import hint
from explorer.widgets.context import TabContext
from explorer.widgets.lecture.lecture_panel import LecturePanel
from explorer.widgets.optimise.hand_game import HandGame
from explorer.widgets.views import SceneViews
from rotor.support.chart import drawn_chart
from rotor.support.markup import Content, Markup, tag

_CAMERA_EVERY = 0.1
"""[s] between two poses of the presenter's camera."""
_LONGEST = 40
"""Characters of a name in the address that are looked at."""
_WORDS = "Copies a link. Anyone with the link follows your settings live and can leave at any time."
_FOLLOWING = "Following a presentation: the presenter controls this page."
_PLAYING = "Your turn: move the sliders to the least power. The presenter sees each player's best."
_AWAY = "The presenter has left: the page is yours. It follows again if they return before you change the design."
_DUPLICATE = (
    "Another tab of this browser is presenting; this one follows it. "
    "To present here, close that tab and reload."
)


class PresentationBanner:
    """Above the tabs: a banner while it presents or follows. Publishing happens on the session's worker."""

    _lecture: LecturePanel
    _screen: SceneViews
    _hand: HandGame
    _hold: Callable[[bool], None]

    def __init__(
        self,
        context: TabContext,
        presentations: Presentations,
        address: Address,
        secret: str = "",
        page: str = "",
    ) -> None:
        """The page's address says whom it follows; `secret` is what the page kept where it presents.

        `page`: of which there is one for each time that a tab is loaded.
        """
        self._context, self._presentations, self._address, self._page = (
            context,
            presentations,
            address,
            page,
        )
        self._secret, self._duplicate = secret[:_LONGEST], False
        # Earlier versions kept the secret there, so it came with every link.
        address[PRESENT] = None
        self._name = "" if self._secret else (address[FOLLOW] or "")[:_LONGEST]
        if self._secret and not presentations.claim(self._secret, page, self):
            self._name, self._secret, self._duplicate = follow_name(self._secret), "", True
        self._lock, self._publishing = threading.Lock(), threading.Lock()
        self._unfollow: Callable[[], None] | None = None
        self._shown: PresentedView | None = None
        """What the presenter shows."""
        self._away = False
        """Whether the presenter's page is closed."""
        self._player = object()
        """Stands for this page among the results: the page itself would be kept alive by them."""
        self._looked = 0.0
        self._pending: threading.Timer | None = None
        self._camera: tuple[Point, Point] | None = None
        self._results: tuple[int, Sequence[float]] | None = None
        """What the presenter was told last."""
        context.leaving.append(self._end)
        self._banner = context.gui.add_html("", visible=False)
        self._leave = context.gui.add_button(
            "Leave and continue alone", color="gray", visible=False, hint=hint("leave")
        )
        self._leave.on_click(lambda _: self.leave())

    def begin(
        self,
        lecture: LecturePanel,
        screen: SceneViews,
        hand: HandGame,
        hold: Callable[[bool], None],
    ) -> None:
        """The page stands: follow, or present, if the address says so.

        `hold` takes the controls from the user, or gives them back.
        """
        self._lecture, self._screen, self._hand, self._hold = lecture, screen, hand, hold
        gui = self._context.gui
        with gui.add_folder("Present to others"):
            self._present = gui.add_button(
                "Present", icon=viser.Icon.PRESENTATION, color="gray", hint=hint("present")
            )
            gui.add_html(tag("div.rx.rx-dim.rx-small", _WORDS))
        self._present.on_click(lambda _: self.end() if self._secret else self.present())
        self._context.client.camera.on_update(self._looked_round)
        if self._name:
            self._stay(away=False)
            self._unfollow = self._presentations.follow(self._name, self._on_presented)
        elif self._secret:
            self._presentations.watch(self._secret, self._announce)
        self._name_present()  # A presenter who reloads the page goes on presenting.

    def _name_present(self) -> None:
        self._present.label = "Stop presenting" if self._secret else "Present"

    def present(self) -> None:
        """Begin to present; the link of followers goes into the clipboard. The page keeps the secret over a reload."""
        if self._name:
            self.leave()
        self._secret = new_secret()
        self._presentations.claim(self._secret, self._page, self)
        browser.store_text(self._context.client, PRESENT, self._secret)
        self._presentations.watch(self._secret, self._announce)
        self._publish()
        browser.copy_link(self._context.client, self._link)
        self._name_present()
        self._context.notify(
            "Presenting", "The link for followers is in the clipboard and in the line above."
        )

    def end(self) -> None:
        self._presentations.end(self._secret)
        self._presentations.release(self)
        self._secret = ""
        browser.store_text(self._context.client, PRESENT, "")
        self._say("")
        self._name_present()

    def leave(self) -> None:
        """Stop following: the page stays as it is, and is the user's."""
        unfollow, self._unfollow, self._name, self._away = self._unfollow, None, "", False
        if unfollow is not None:
            unfollow()
        if self._duplicate:
            self._duplicate = False
            browser.store_text(self._context.client, PRESENT, "")
        self._hold(False)
        self._address[FOLLOW] = None
        self._say("")

    def show(self, state: SessionState | None) -> None:
        """Publish what the page shows, if it presents; where it follows, show what is presented."""
        self._publish()
        self._hold_still()
        if self._secret and self._results:
            self._announce(*self._results)
        if (
            state is not None
            and self._name
            and self._playing
            and (standing := self._hand.standing) is not None
        ):
            self._presentations.report(self._name, self._player, standing.best.power.total)

    def _end(self) -> None:
        """The browser has left. A presenter who reloads the page goes on presenting."""
        with self._publishing:  # Nothing is shown after the notice that the presenter has left.
            self._secret = ""
        self._presentations.release(self)
        if self._unfollow is not None:
            self._unfollow()

    def _publish(self) -> None:
        self._pending = None
        # Camera and worker come on threads of their own: what was read first goes out first.
        with self._publishing:
            if not self._secret:
                return
            # A follower has no search of its own, but sees the designs of the presenter's.
            screen = replace(self._screen.on_screen(), inputs=self._context.controls.shown())
            shown = PresentedView(screen, self._lecture.place, self._hand.game, self._camera)
            self._presentations.present(self._secret, shown)

    def _announce(self, count: int, results: Sequence[float]) -> None:
        self._results = count, results
        followers = "1 follower" if count == 1 else f"{count} followers"
        link = tag(
            "a", "copy link", href=self._link, data_copy=True, target="_blank", rel="noopener"
        )
        chart, standing = Markup(), self._hand.standing
        if results and standing is not None:
            ends = standing.least.power.total, standing.start.power.total
            chart = chart_box(drawn_chart(histogram(results, ends, self._context.units)))
        self._say((f"Presenting: {followers} · ", link, chart))

    @property
    def _playing(self) -> bool:
        """Whether this follower plays the game that the presenter has begun."""
        return self._shown is not None and self._shown.game is not None and not self._away

    @property
    def _link(self) -> str:
        """What followers open, relative to the page."""
        return f"?{FOLLOW}={follow_name(self._secret)}"

    def _hold_still(self) -> None:
        """A follower's page shows the presenter's design: viser's number fields can be typed into even if disabled."""
        if self._name and self._shown is not None and not self._away and not self._playing:
            held = self._shown.screen
            self._screen.put(replace(self._screen.on_screen(), inputs=held.inputs, hand=held.hand))

    def _stay(self, away: bool) -> None:
        """Follow on; `away`: once the presenter is here again, and until then the page is the user's."""
        self._away = away
        self._hold(not away and not self._playing)
        words = _PLAYING if self._playing else _DUPLICATE if self._duplicate else _FOLLOWING
        self._say(_AWAY if away else words, leave=True)

    def _on_presented(self, shown: PresentedView | Literal["away", "over"]) -> None:
        """What the presenter shows; on the presenter's thread."""
        context, before = self._context, self._shown
        if not self._name:
            return
        if shown == "away":
            self._stay(away=True)
            if before is not None:  # On a telephone the banner is folded away.
                context.notify("The presenter has left", "The page is yours.")
            return
        now = self._screen.on_screen()
        own = (
            self._away
            and before is not None
            and before.game is None
            and (now.inputs, now.hand) != (before.screen.inputs, before.screen.hand)
        )
        if shown == "over" or own:
            self.leave()
            title = "The presentation is over" if shown == "over" else "The presenter is back"
            context.notify(title, "The page is yours.")
            return
        # A game begins, or is over.
        changes = shown.game != (before.game if before is not None else None)
        self._shown = shown
        if self._away or changes:
            self._stay(away=False)
        if changes:
            self._hand.begin(shown.game)
        if shown.game is not None:
            return
        with self._lock:
            screen = shown.screen
            stood = before is not None and (before.screen.mode, before.screen.look) == (
                screen.mode,
                screen.look,
            )
            # Until it changes, a follower may look elsewhere.
            put = self._screen.on_screen() if stood else screen
            self._screen.put(replace(screen, mode=put.mode, look=put.look))
            self._lecture.follow(shown.place)
            if shown.camera is not None and shown.camera != self._camera:
                self._camera = shown.camera
                with context.client.atomic():
                    context.client.camera.position, context.client.camera.look_at = shown.camera

    def _looked_round(self, camera: viser.CameraHandle) -> None:
        if not self._secret:
            return
        self._camera = (_point(camera.position), _point(camera.look_at))
        now = time.monotonic()
        if now - self._looked > _CAMERA_EVERY:
            self._looked = now
            self._publish()
        elif self._pending is None:  # The last pose of a movement is shown too.
            self._pending = threading.Timer(_CAMERA_EVERY, self._publish)
            self._pending.daemon = True
            self._pending.start()

    def _say(self, words: Content, leave: bool = False) -> None:
        self._banner.content = (
            tag("div.rx.rx-presentation", words, data_explorer="presentation") if words else ""
        )
        self._banner.visible, self._leave.visible = bool(words), leave


def _point(at: NDArray[np.float64]) -> Point:
    x, y, z = (round(float(value), 3) for value in at)
    return x, y, z

"""The clock: it beats while it plays, tells how long it was, and ends at once, however often it is pressed."""

import threading
import time

from explorer.widgets.context import BEAT, Player
from tests.waited import until


def playing(name: str) -> int:
    return sum(thread.name == name for thread in threading.enumerate())


def test_it_gives_the_time_that_has_gone_and_ends_with_pause():
    steps: list[float] = []
    enough = threading.Event()

    def step(seconds: float) -> None:
        steps.append(seconds)
        if len(steps) == 4:
            enough.set()

    player, begin = Player(step, "walk"), time.monotonic()
    assert not player.playing
    player.play()
    player.play()  # A second press starts no second clock.
    assert playing("walk") == 1
    assert enough.wait(60.0)
    player.pause()
    gone = time.monotonic() - begin
    assert not player.playing
    assert min(steps) >= 0.9 * BEAT
    assert sum(steps) <= gone + BEAT
    count = len(steps)
    until(lambda: not playing("walk"))
    assert len(steps) <= count + 1  # One may have been under way.
    player.pause()  # Nothing plays: nothing happens.

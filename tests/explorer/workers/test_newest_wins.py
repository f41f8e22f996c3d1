"""Updates of many pages on a few threads: newest state, frames first, what can wait in steps."""

import itertools
import threading
import time
from collections.abc import Iterator

import pytest

from explorer.workers import newest_wins
from explorer.workers.newest_wins import GIVE_WAY, NewestWins, UpdatePool
from tests.waited import until

LONG = 60.0
"""[s]; how long a step of another thread may take before a test gives up: far more than on a busy machine."""


def blocked(pool: UpdatePool) -> tuple[NewestWins, threading.Event]:
    """A page that keeps a thread of the pool until the event is set."""
    begun, go = threading.Event(), threading.Event()

    def update() -> None:
        begun.set()
        assert go.wait(LONG)

    worker = NewestWins(update, fail, pool)
    worker.wake()
    assert begun.wait(LONG)
    return worker, go


def fail(error: Exception) -> None:
    raise error


class TestNewest:
    def test_works_on_the_newest_and_never_queues(self):
        state, seen, gate, begun = [0], list[int](), threading.Event(), threading.Event()

        def update() -> None:
            seen.append(state[0])
            begun.set()
            gate.wait(LONG)

        worker = NewestWins(update, fail, UpdatePool(1))
        worker.wake()
        assert begun.wait(LONG)
        for value in range(1, 50):
            state[0] = value
            worker.wake()
        gate.set()
        until(lambda: len(seen) == 2)
        worker.stop()
        assert seen == [0, 49]

    def test_an_error_is_reported_and_survived(self):
        errors, turns = list[Exception](), itertools.count()

        def update() -> Iterator[float]:
            if next(turns) == 0:
                raise RuntimeError("broken")
            return steps()

        def steps() -> Iterator[float]:
            yield 0.0
            raise RuntimeError("broken step")

        def report(error: Exception) -> None:
            errors.append(error)
            worker.wake()

        worker = NewestWins(update, report, UpdatePool(1))
        worker.wake()
        until(lambda: len(errors) >= 3)
        worker.stop()
        assert [str(error) for error in errors][:3] == ["broken", "broken step", "broken step"]

    def test_stop_waits_for_the_update_that_runs_and_none_begins_after_it(self):
        worker, go = blocked(UpdatePool(1))
        threading.Timer(0.05, go.set).start()
        worker.wake()
        worker.stop(LONG)
        assert go.is_set()
        assert worker._state != "running"

    def test_held_nothing_begins_and_what_was_left_goes_on_after_the_release(self):
        order, go, turns = list[str](), threading.Event(), itertools.count()

        def steps(turn: int) -> Iterator[float]:
            order.append(f"step {turn}")
            assert go.wait(LONG)
            yield 0.0
            order.append(f"last {turn}")

        worker = NewestWins(lambda: steps(next(turns)), fail, pool := UpdatePool(1))
        worker.wake()
        until(lambda: order == ["step 0"])
        worker.hold()
        go.set()
        until(lambda: worker._state == "idle")  # The step that ran has ended.
        other = list[int]()
        NewestWins(lambda: other.append(1), fail, pool).wake()
        until(lambda: other == [1])
        assert order == ["step 0"]
        worker.release()
        until(lambda: order == ["step 0", "last 0"])
        worker.hold()
        worker.wake()
        time.sleep(0.05)
        assert order == ["step 0", "last 0"]
        worker.release()
        until(lambda: order[2:] == ["step 1", "last 1"])
        worker.stop()

    def test_held_in_line_it_leaves_it_and_takes_its_place_again(self):
        pool, seen = UpdatePool(1), list[int]()
        busy, go = blocked(pool)
        worker = NewestWins(lambda: seen.append(1), fail, pool)
        worker.wake()
        worker.hold()
        go.set()
        until(lambda: busy._state == worker._state == "idle")
        assert seen == []
        worker.release()
        until(lambda: seen == [1])
        worker.stop()


class TestSteps:
    def test_they_follow_the_frame_each_after_its_pause(self):
        order = list[tuple[str, float]]()

        def note(name: str) -> None:
            order.append((name, time.monotonic()))

        def steps() -> Iterator[float]:
            note("first")
            yield 0.05
            note("second")

        def update() -> Iterator[float]:
            note("frame")
            return steps()

        worker = NewestWins(update, fail, UpdatePool(1))
        worker.wake()
        until(lambda: len(order) == 3)
        worker.stop()
        assert [name for name, _ in order] == ["frame", "first", "second"]
        assert order[2][1] - order[1][1] >= 0.05

    def test_a_newer_update_takes_their_place_at_once(self):
        order, turns = list[str](), iter("ab")

        def steps(name: str) -> Iterator[float]:
            order.append(f"{name}1")
            yield 10.0 * LONG if name == "a" else 0.0
            order.append(f"{name}2")

        worker = NewestWins(lambda: steps(next(turns)), fail, UpdatePool(1))
        worker.wake()
        until(lambda: order == ["a1"])
        worker.wake()
        until(lambda: order == ["a1", "b1", "b2"])
        worker.stop()

    def test_an_update_without_any_leaves_those_that_wait(self):
        order, go = list[str](), threading.Event()

        def steps() -> Iterator[float]:
            order.append("first")
            assert go.wait(LONG)
            yield 0.0
            order.append("second")

        turns = iter((steps(), None))
        worker = NewestWins(lambda: next(turns), fail, UpdatePool(1))
        worker.wake()
        until(lambda: order == ["first"])
        worker.wake()
        go.set()
        until(lambda: order == ["first", "second"])
        worker.stop()

    def test_what_gives_way_goes_on_after_the_steps_of_others_and_what_began_first_is_first(self):
        pool, order = UpdatePool(1), list[str]()

        def steps(name: str, pause: float, count: int) -> Iterator[float]:
            for k in range(count):
                order.append(f"{name}{k}")
                yield pause

        pages = [
            NewestWins(lambda one=one: steps(*one), fail, pool)
            for one in (("long", GIVE_WAY, 3), ("longer", GIVE_WAY, 3), ("short", 0.0, 2))
        ]
        _, go = blocked(pool)
        for page in pages:
            page.wake()
        go.set()
        until(lambda: len(order) == 8)
        assert order[:4] == ["long0", "longer0", "short0", "short1"]
        assert order[4:] == ["long1", "long2", "longer1", "longer2"]


class TestCrowd:
    def test_twenty_busy_pages_get_equal_shares(self):
        """All want to work all the time: the rounds done by each differ by one or two."""
        pool, rounds = UpdatePool(1), [0] * 20
        workers: list[NewestWins] = []

        def update(k: int) -> None:
            rounds[k] += 1
            if max(rounds) < 20:
                workers[k].wake()

        workers += [NewestWins(lambda k=k: update(k), fail, pool) for k in range(20)]
        _, go = blocked(pool)
        for worker in workers:
            worker.wake()
        go.set()
        until(lambda: max(rounds) == 20)
        assert min(rounds) >= 18

    def test_frames_go_before_steps_but_do_not_starve_them(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setattr(newest_wins, "_FRAMES_IN_A_ROW", 5)
        pool, order = UpdatePool(1), list[str]()

        def steps() -> Iterator[float]:
            order.append("step")
            yield 0.0
            order.append("step")

        waiting = NewestWins(steps, fail, pool)
        pages = [NewestWins(lambda: order.append("frame"), fail, pool) for _ in range(12)]
        _, go = blocked(pool)
        waiting.wake()
        for page in pages:
            page.wake()
        assert pool.waiting == 13
        go.set()
        until(lambda: len(order) == 14)
        assert order.index("step") >= 3
        assert order.index("step") < 6
        assert order[-3:] == ["frame"] * 3

    def test_of_slow_pages_one_computes_at_a_time(self, monkeypatch: pytest.MonkeyPatch):
        """So a quick page finds the other thread free."""
        monkeypatch.setattr(newest_wins, "_SLOW_FRAME_S", 0.01)
        pool, lock, now, most, ended = UpdatePool(2), threading.Lock(), 0, 0, threading.Event()
        slow: list[NewestWins] = []
        rounds = [0, 0, 0]

        def update(k: int) -> None:
            nonlocal now, most
            with lock:
                now += rounds[k] > 1
                most = max(most, now)
            begun = time.thread_time()
            while time.thread_time() - begun < 0.02:
                pass
            with lock:
                now -= rounds[k] > 1
                rounds[k] += 1
            if not ended.is_set():
                slow[k].wake()

        slow += [NewestWins(lambda k=k: update(k), fail, pool) for k in range(3)]
        for worker in slow:
            worker.wake()
        until(lambda: min(rounds) >= 5)
        ended.set()
        assert most == 1

    def test_one_slow_frame_does_not_put_a_page_behind_the_charts_of_others(
        self, monkeypatch: pytest.MonkeyPatch
    ):
        """The first frame of each page is slow: who moves a slider then does not wait for what others still compute."""
        monkeypatch.setattr(newest_wins, "_SLOW_FRAME_S", 0.01)
        pool, go, begun, ended, frames = (
            UpdatePool(2),
            threading.Event(),
            threading.Event(),
            list[bool](),
            [0],
        )

        def opened() -> None:
            end = time.thread_time() + (0.02 if frames[0] == 0 else 0.0)
            while time.thread_time() < end:
                pass
            frames[0] += 1

        def charts() -> Iterator[float]:
            yield 0.0
            begun.set()
            ended.append(go.wait(LONG))

        page, other = NewestWins(opened, fail, pool), NewestWins(charts, fail, pool)
        page.wake()
        until(lambda: frames[0] == 1)
        other.wake()
        assert begun.wait(LONG)
        page.wake()
        until(lambda: frames[0] == 2 or bool(ended))
        assert not ended
        go.set()


class TestAnswers:
    def test_who_waits_for_an_answer_gets_it_before_the_rest_is_done(self):
        """An update that has answered goes on; one that a newer wake interrupts has answered nothing."""
        go_on, end, seen, told = threading.Event(), threading.Event(), [0], list[str]()

        def update() -> Iterator[float]:
            go_on.wait(LONG)
            seen[0] += 1

            def steps() -> Iterator[float]:
                worker.answer()
                yield 0.0
                end.wait(10.0)

            return steps()

        worker = NewestWins(update, fail, UpdatePool(1))

        def ask(wholly: bool) -> None:
            worker.until_answered(wholly)
            told.append(f"{seen[0]} {'wholly' if wholly else 'answered'}")

        worker.wake()
        for wholly in (True, False):
            threading.Thread(target=ask, args=(wholly,), daemon=True).start()
        time.sleep(0.05)
        assert told == []
        go_on.set()
        until(lambda: told == ["1 answered"])
        time.sleep(0.05)
        assert told == ["1 answered"]
        end.set()
        until(lambda: told == ["1 answered", "1 wholly"])
        go_on.clear()
        worker.wake()
        until(lambda: not worker.superseded)
        later = threading.Thread(target=ask, args=(False,), daemon=True)
        later.start()
        worker.stop(0.1)  # The page has gone: nobody waits any longer.
        later.join(10.0)
        go_on.set()
        assert not later.is_alive()

    def test_wholly_idle_waits_for_what_workers_have_still_to_answer(self):
        """Also where an answer wakes it and its update asks for more, and where the last leaves nothing to do."""
        seen, owed, told = [0], [True], list[str]()

        def update() -> None:
            seen[0] += 1

        worker = NewestWins(update, fail, UpdatePool(1))

        def ask() -> None:
            worker.until_answered(True, lambda: owed[0])
            told.append(f"after {seen[0]}")

        waiting = threading.Thread(target=ask, daemon=True)
        waiting.start()
        worker.until_answered(False, lambda: owed[0])  # All that was sent is answered.
        for answers in (1, 2):
            worker.wake()
            until(lambda answers=answers: seen[0] == answers)
            time.sleep(0.25)
            assert told == []
        owed[0] = False
        waiting.join(LONG)
        assert told == ["after 2"]

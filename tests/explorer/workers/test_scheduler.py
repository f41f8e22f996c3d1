"""Turns of many pages at one processor, and the worker that waits for its turn."""

import threading
import time
from collections.abc import Callable
from contextlib import suppress

from explorer.workers.newest_wins import IdleTimeout, NewestWins, Superseded
from explorer.workers.scheduler import SLICE, FairScheduler

LONG = 60.0
"""[s]; how long a step of another thread may take before a test gives up: far more than on a busy machine."""


def until(true: Callable[[], bool]) -> None:
    """Wait for what another thread brings about."""
    end = time.monotonic() + LONG
    while not true():
        assert time.monotonic() < end
        time.sleep(0.001)


class TestScheduler:
    def test_only_the_given_number_runs_at_once(self):
        turns, lock, now, most = FairScheduler(2), threading.Lock(), 0, 0
        pair = threading.Barrier(2, timeout=LONG)

        def work() -> None:
            nonlocal now, most
            with turns.take():
                with lock:
                    now += 1
                    most = max(most, now)
                pair.wait()  # Two do run at once, however slowly threads start.
                time.sleep(0.002)
                with lock:
                    now -= 1

        threads = [threading.Thread(target=work) for _ in range(12)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert most == 2

    def test_turns_are_given_in_order_of_arrival(self):
        turns, order = FairScheduler(1), []

        def work(k: int) -> None:
            with turns.take():
                order.append(k)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(12)]
        with turns.take():
            for k, thread in enumerate(threads):
                thread.start()
                until(lambda k=k: turns.waiting > k)
        for thread in threads:
            thread.join()
        assert order == list(range(12))

    def test_frames_go_before_work_that_can_wait(self):
        turns, order = FairScheduler(1), []
        held, go = threading.Event(), threading.Event()

        def sweep() -> None:
            with turns.take() as turn:
                held.set()
                go.wait()
                assert turn.give_way(lambda: False)
                order.append("sweep")

        def frame(k: int) -> None:
            with turns.take():
                order.append(k)

        threads = [threading.Thread(target=sweep), *(threading.Thread(target=frame, args=(k,)) for k in range(3))]
        threads[0].start()
        held.wait()
        for thread in threads[1:]:
            thread.start()
        until(lambda: turns.waiting == 3)
        go.set()
        for thread in threads:
            thread.join()
        assert order[-1] == "sweep"

    def test_frames_do_not_starve_work_that_can_wait(self):
        turns, ended, frames = FairScheduler(1), threading.Event(), 0

        def crowd() -> None:
            nonlocal frames
            while not ended.is_set():
                with turns.take():
                    frames += 1
                    time.sleep(0.0002)

        threads = [threading.Thread(target=crowd) for _ in range(4)]
        for thread in threads:
            thread.start()
        with turns.take() as turn:
            for _ in range(20):
                until(lambda: turns.waiting == 4)
                assert turn.give_way(lambda: False)
        ended.set()
        for thread in threads:
            thread.join()
        assert frames >= 20

    def test_unwanted_work_gives_up_its_place_in_the_queue(self):
        turns = FairScheduler(1)
        holding, done = threading.Event(), threading.Event()

        def hold() -> None:
            with turns.take():
                holding.set()
                turn.look()
                done.wait()

        with turns.take() as turn:
            other = threading.Thread(target=hold)
            other.start()
            until(lambda: turns.waiting == 1)
            assert not turn.give_way(holding.is_set)
            assert not turn.held
        done.set()
        other.join()
        with turns.take():
            pass  # The one place is free again, once.
        assert turns._free == 1

    def test_long_work_leaves_a_turn_to_frames(self):
        """Of three that take long only one computes at a time, so a frame begins at once on the other turn."""
        turns, lock, now, most = FairScheduler(2), threading.Lock(), 0, 0
        ended = threading.Event()

        def search() -> None:
            nonlocal now, most
            with turns.take() as turn:
                compute(1.2 * SLICE)
                while not ended.is_set() and turn.give_way(ended.is_set):
                    with lock:
                        now += 1
                        most = max(most, now)
                    compute(0.2 * SLICE)
                    with lock:
                        now -= 1

        threads = [threading.Thread(target=search) for _ in range(3)]
        for thread in threads:
            thread.start()
        while not most:
            time.sleep(0.001)
        for _ in range(20):
            with turns.take():
                time.sleep(0.002)
        ended.set()
        for thread in threads:
            thread.join()
        assert most == 1
        assert turns._free == 2

    def test_a_single_page_does_not_wait(self):
        turns, best = FairScheduler(1), 60.0
        with turns.take() as turn:
            for _ in range(10):
                begun = time.perf_counter()
                assert all(turn.give_way(lambda: False) for _ in range(1000))
                best = min(best, time.perf_counter() - begun)
        assert best < 0.1


class TestWorker:
    def test_twenty_busy_sessions_get_equal_shares(self):
        """All want to work all the time: the rounds done by each differ by one or two."""
        turns, rounds, over = FairScheduler(2), [0] * 20, threading.Event()
        pair = threading.Barrier(2, timeout=LONG)  # A job that the machine holds up must not be overtaken for it.

        def job(k: int) -> None:
            if over.is_set():
                return  # What runs until all have stopped does not count.
            rounds[k] += 1
            workers[k].wake()
            until(lambda: turns.waiting == 18 or over.is_set())  # Those that do not work ask for a turn.
            with suppress(threading.BrokenBarrierError):
                pair.wait()
            if min(rounds) >= 5 or max(rounds) >= 50:
                over.set()
                pair.abort()

        workers = [NewestWins(lambda _, k=k: job(k), print, f"w{k}", scheduler=turns) for k in range(20)]
        for worker in workers:
            worker.start()
            worker.wake()
        assert over.wait(LONG)
        done = list(rounds)
        for worker in workers:
            worker.stop(LONG)
        assert min(done) >= 5
        assert max(done) - min(done) <= 2

    def test_the_last_change_is_always_processed(self):
        turns, state, seen = FairScheduler(1), [0], [0]

        def job(_: object) -> None:
            seen[0] = state[0]

        worker = NewestWins(job, print, "w", scheduler=turns)
        worker.start()
        for k in range(200):
            state[0] = k
            worker.wake()
        until(lambda: seen[0] == 199)
        worker.stop()

    def test_idle_worker_sleeps_once_and_wakes_before_the_next_update(self):
        events: list[str] = []
        idle = IdleTimeout(0.03, lambda: events.append("sleep"), lambda: events.append("wake"))
        worker = NewestWins(lambda _: events.append("update"), print, "w", idle)
        worker.start()
        until(lambda: "sleep" in events)
        time.sleep(0.1)
        worker.wake()
        until(lambda: "update" in events)
        worker.stop()
        assert events[:3] == ["sleep", "wake", "update"]

    def test_who_waits_for_an_answer_gets_it_before_the_rest_is_done(self):
        """An update that has answered goes on; one that a newer wake interrupts has answered nothing."""
        go_on, end, seen, told = threading.Event(), threading.Event(), [0], list[str]()

        def job(_: object) -> None:
            go_on.wait(LONG)
            seen[0] += 1
            worker.answer()
            end.wait(LONG)

        worker = NewestWins(job, print, "w", scheduler=FairScheduler(1))

        def ask(wholly: bool) -> None:
            worker.until_answered(wholly)
            told.append(f"{seen[0]} {'wholly' if wholly else 'answered'}")

        worker.start()
        worker.wake()
        threads = [threading.Thread(target=ask, args=(wholly,)) for wholly in (True, False)]
        for thread in threads:
            thread.start()
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
        later = threading.Thread(target=ask, args=(False,))
        later.start()
        worker.stop()  # The page has gone: nobody waits any longer.
        later.join(LONG)
        go_on.set()
        assert not later.is_alive()

    def test_a_pause_lets_others_work_and_ends_with_a_change(self):
        turns, begun, ran = FairScheduler(1), threading.Event(), threading.Event()
        lengths: list[float] = []

        def job(_: object) -> None:
            begun.set()
            begin = time.monotonic()
            worker.pause(0.02 if lengths else 10.0 * LONG)
            lengths.append(time.monotonic() - begin)

        worker = NewestWins(job, print, "w", scheduler=turns)
        other = NewestWins(lambda _: ran.set(), print, "o", scheduler=turns)
        worker.start()
        other.start()
        worker.wake()
        assert begun.wait(LONG)
        other.wake()
        assert ran.wait(LONG)  # Though there is one turn, and the first worker is within its update.
        worker.wake()
        until(lambda: len(lengths) == 2)
        worker.stop()
        other.stop()
        assert lengths[0] < 5.0 * LONG
        assert lengths[1] >= 0.02


def test_a_pause_ends_with_a_change_though_no_turn_is_free():
    """Another page keeps the only turn: a drag must not wait for it within the update that the drag makes void."""
    scheduler, paused, ended = FairScheduler(1), threading.Event(), threading.Event()

    def update(_: object) -> None:
        paused.set()
        until(lambda: scheduler.waiting == 1)
        worker.pause(0.01)
        ended.set()

    worker = NewestWins(update, print, "w", scheduler=scheduler)
    worker.start()
    worker.wake()
    assert paused.wait(LONG)
    with scheduler.take():  # It has the turn from the moment the pause leaves it.
        time.sleep(0.05)
        assert not ended.is_set()
        worker.wake()
        assert ended.wait(LONG)
    worker.stop()


def compute(seconds: float) -> None:
    """Use that much of this thread's processor time."""
    begun = time.thread_time()
    while time.thread_time() - begun <= seconds:
        pass


def test_a_long_step_gives_way_and_comes_to_its_end():
    """With one turn, a frame that asks in the middle of a long step is served at a pause after the first slice."""
    scheduler, order = FairScheduler(1), list[str]()
    asked, ended = threading.Event(), threading.Event()

    def long(superseded: Superseded) -> None:
        order.append("begin")
        asked.set()
        while scheduler.waiting == 0:
            time.sleep(0.01)  # Which takes next to none of the slice.
        superseded.pause()
        order.append("more")
        compute(SLICE)
        superseded.pause()
        order.append("end")
        ended.set()

    def quick(_: Superseded) -> None:
        order.append("frame")

    slow = NewestWins(long, lambda error: None, "slow", scheduler=scheduler)  # pyright: ignore[reportArgumentType]
    fast = NewestWins(quick, lambda error: None, "fast", scheduler=scheduler)  # pyright: ignore[reportArgumentType]
    for worker in (slow, fast):
        worker.start()
    slow.wake()
    assert asked.wait(LONG)
    fast.wake()
    assert ended.wait(LONG)
    assert order == ["begin", "more", "frame", "end"]
    for worker in (slow, fast):
        worker.stop()

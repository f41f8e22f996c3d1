"""Who is let in: names and pages, floods, files, places, and whose turn it is. Without a server."""

import threading
import time

import pytest

from explorer.hosting import memory
from explorer.hosting.doors import AllowedHosts, host_name, is_loopback, warning
from explorer.hosting.hall import SeatQueue
from explorer.hosting.meter import RateLimit, RateLimiter
from explorer.hosting.turns import Turns
from explorer.hosting.uploads import LARGEST, refusal
from explorer.workers.newest_wins import IdleTimeout, NewestWins


class TestAllowedHosts:
    @pytest.mark.parametrize("host", ["127.0.0.1:8080", "localhost:8080", "LOCALHOST", "[::1]:8080", "localhost."])
    def test_this_machine_is_reached_by_its_own_names(self, host: str):
        assert AllowedHosts("127.0.0.1").refusal(host, None) is None

    @pytest.mark.parametrize(
        "host", ["evil.example", "evil.example:8080", "127.0.0.1.evil.example", "192.168.1.5", "", None]
    )
    def test_a_foreign_name_for_this_machine_is_refused(self, host: str | None):
        """DNS rebinding: the attacker's own name, with our address."""
        assert "does not answer" in (AllowedHosts("127.0.0.1").refusal(host, None) or "")

    @pytest.mark.parametrize("host", ["evil.example/@127.0.0.1", "a@127.0.0.1", "127.0.0.1:x", "[::1", "127.0.0.1?x"])
    def test_a_host_that_is_none_is_refused(self, host: str):
        assert AllowedHosts("127.0.0.1").refusal(host, None)

    def test_a_name_may_be_allowed(self):
        doors = AllowedHosts("127.0.0.1", ("rotor.example",))
        assert doors.refusal("rotor.example", "https://rotor.example") is None
        assert doors.refusal("rotor.example:443", "https://rotor.example") is None
        assert doors.refusal("rotor.example.evil.example", None)

    def test_a_proxy_may_put_its_own_host(self):
        doors = AllowedHosts("127.0.0.1", ("rotor.example",))
        assert doors.refusal("127.0.0.1:8080", "https://rotor.example") is None
        assert doors.refusal("127.0.0.1:8080", "https://evil.example")

    def test_other_machines_come_by_number_or_by_this_machines_name(self):
        doors = AllowedHosts("0.0.0.0")
        assert doors.refusal("192.168.1.5:8080", "http://192.168.1.5:8080") is None
        assert doors.refusal("[fe80::1]:8080", None) is None
        assert doors.refusal("evil.example:8080", None)

    @pytest.mark.parametrize("origin", ["http://127.0.0.1:8080", "HTTP://127.0.0.1:8080".lower()])
    def test_own_pages_may_talk(self, origin: str):
        assert AllowedHosts("127.0.0.1").refusal("127.0.0.1:8080", origin) is None

    @pytest.mark.parametrize(
        "origin",
        [
            "http://evil.example",
            "https://127.0.0.1.evil.example:8080",
            "http://127.0.0.1:9999",  # Another server of this machine.
            "http://localhost:8080",  # Another origin to the browser, too.
            "https://127.0.0.1",
            "null",
            "file://",
            "",
            "chrome-extension://abcdef",
        ],
    )
    def test_foreign_pages_may_not(self, origin: str):
        assert "may not use" in (AllowedHosts("127.0.0.1").refusal("127.0.0.1:8080", origin) or "")

    def test_what_is_no_browser_says_no_origin_and_may(self):
        assert AllowedHosts("127.0.0.1").refusal("127.0.0.1:8080", None) is None

    def test_a_name_to_allow_is_a_name(self):
        assert host_name("Rotor.example:8080") == "rotor.example"
        for wrong in ("https://rotor.example", "rotor.example/page", "", "a@b"):
            with pytest.raises(ValueError, match="not the name of a host"):
                host_name(wrong)

    def test_loopback(self):
        assert all(map(is_loopback, ("127.0.0.1", "127.1.2.3", "::1", "localhost")))
        assert not any(map(is_loopback, ("0.0.0.0", "::", "192.168.1.5", "rotor.example", "")))

    def test_the_warning_has_two_lines_and_the_remedy(self):
        assert warning("0.0.0.0").count("\n") == 1
        assert "--allow-host" in warning("0.0.0.0")
        assert "docs/deploy.md" in warning("0.0.0.0")


class TestMeter:
    def test_a_burst_and_then_a_rate(self):
        meter = RateLimiter(0.0, RateLimit(10.0, 20.0), RateLimit(1e6, 1e6))
        assert all(meter.take(1, 0.0) for _ in range(20))
        assert not meter.take(1, 0.0)
        meter = RateLimiter(0.0, RateLimit(10.0, 20.0), RateLimit(1e6, 1e6))
        assert all(meter.take(1, 0.1 * k) for k in range(1000))

    def test_bytes_count_too(self):
        meter = RateLimiter(0.0, RateLimit(100.0, 100.0), RateLimit(1e3, 1e4))
        assert meter.take(10_000, 0.0)
        assert not meter.take(1_000, 0.5)

    def test_a_hand_on_a_slider_and_on_the_camera_never_meets_it(self):
        meter = RateLimiter(0.0)
        assert all(meter.take(300, k / 70.0) for k in range(70 * 600))


class TestUploads:
    def test_what_is_taken(self):
        assert refusal("a.json", 1000, 1, 0, ".json") is None
        assert refusal("A.JSON", 1000, 1, 0, ".toml, .json") is None
        assert refusal("deck.c81", LARGEST, 8, 1, "*/*") is None
        assert refusal("empty.json", 0, 0, 0, ".json") is None
        assert refusal("study.parquet", 8 * LARGEST, 64, 0, ".parquet") is None

    @pytest.mark.parametrize(
        ("sent", "sentence"),
        [
            (("film.json", 2 * LARGEST, 16, 0, ".json"), "8.0 MB: 4 MB are the most"),
            (("study.parquet", 9 * LARGEST, 64, 0, ".parquet"), "36.0 MB: 32 MB are the most"),
            (("large.parquet", 8 * LARGEST, 64, 0, ".json"), "choose a .json file"),
            (("film.mp4", 1000, 1, 0, ".json,.toml"), "choose a .json or .toml file"),
            (("third.json", 1000, 1, 2, ".json"), "must wait"),
            (("crumbs.json", 1000, 1000, 0, ".json"), "1000 parts"),
            (("odd.json", -1, 1, 0, ".json"), "parts"),
        ],
    )
    def test_what_is_not(self, sent: tuple[str, int, int, int, str], sentence: str):
        assert sentence in (refusal(*sent) or "")


class TestSeatQueue:
    def test_places_then_a_line_in_order(self):
        hall: SeatQueue[str] = SeatQueue(2)
        assert [hall.arrive(name) for name in "abcd"] == [True, True, False, False]
        assert hall.line == ("c", "d")
        assert hall.leave("a") == ["c"]
        assert hall.leave("d") == []
        assert hall.leave("b") == []
        assert hall.arrive("e")

    def test_nobody_passes_those_who_wait(self):
        hall: SeatQueue[str] = SeatQueue(1)
        assert hall.arrive("a")
        assert not hall.arrive("b")
        assert hall.leave("a") == ["b"]
        assert not hall.arrive("c")

    def test_a_sleeper_holds_no_place_and_gets_one_back(self):
        hall: SeatQueue[str] = SeatQueue(1)
        hall.arrive("a")
        hall.arrive("b")
        assert hall.sleep("a") == ["b"]
        hall.wake("a")  # Above the number: it had one.
        assert not hall.arrive("c")
        assert hall.leave("a") == []
        assert hall.leave("b") == ["c"]

    def test_leaving_twice_frees_one_place(self):
        hall: SeatQueue[str] = SeatQueue(1)
        hall.arrive("a")
        hall.leave("a")
        hall.leave("a")
        assert hall.arrive("b")
        assert not hall.arrive("c")


class TestTurns:
    def test_so_many_at_once(self):
        turns, lock, now, most = Turns(2), threading.Lock(), 0, 0

        def work() -> None:
            nonlocal now, most
            with turns.take():
                with lock:
                    now += 1
                    most = max(most, now)
                time.sleep(0.002)
                with lock:
                    now -= 1

        threads = [threading.Thread(target=work) for _ in range(12)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert most == 2

    def test_first_come_first_served(self):
        turns, order = Turns(1), []

        def work(k: int) -> None:
            with turns.take():
                order.append(k)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(12)]
        with turns.take():
            for k, thread in enumerate(threads):
                thread.start()
                while turns.waiting <= k:
                    time.sleep(0.0005)
        for thread in threads:
            thread.join()
        assert order == list(range(12))

    def test_what_can_wait_lets_frames_by(self):
        turns, order = Turns(1), []
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
        while turns.waiting < 3:
            time.sleep(0.001)
        go.set()
        for thread in threads:
            thread.join()
        assert order[-1] == "sweep"

    def test_a_crowd_does_not_starve_what_can_wait(self):
        turns, ended, frames = Turns(1), threading.Event(), 0

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
                assert turn.give_way(lambda: False)
        ended.set()
        for thread in threads:
            thread.join()
        assert frames >= 20

    def test_what_became_unwanted_gives_up_and_leaves_nothing_behind(self):
        turns = Turns(1)
        holding_caveats, done = threading.Event(), threading.Event()

        def hold() -> None:
            with turns.take():
                holding_caveats.set()
                done.wait()

        with turns.take() as turn:
            other = threading.Thread(target=hold)
            other.start()
            while not turns.waiting:
                time.sleep(0.001)
            assert not turn.give_way(holding_caveats.is_set)
            assert not turn.held
        done.set()
        other.join()
        with turns.take():
            pass  # The one place is free again, once.
        assert turns._free == 1

    def test_alone_nothing_waits(self):
        turns = Turns(1)
        with turns.take() as turn:
            begun = time.perf_counter()
            assert all(turn.give_way(lambda: False) for _ in range(1000))
            assert time.perf_counter() - begun < 0.1


class TestWorker:
    def test_twenty_busy_sessions_are_served_alike(self):
        """Rounds done by each while all want to work all the time differ by a few."""
        turns, rounds, until = Turns(2), [0] * 20, time.monotonic() + 0.4

        def job(k: int) -> None:
            rounds[k] += 1
            time.sleep(0.001)

        workers = [NewestWins(lambda _, k=k: job(k), print, f"w{k}", turns=turns) for k in range(20)]
        for worker in workers:
            worker.start()
        while time.monotonic() < until:
            for worker in workers:
                worker.wake()
            time.sleep(0.001)
        for worker in workers:
            worker.stop()
        assert min(rounds) >= 3
        assert max(rounds) - min(rounds) <= 3

    def test_the_last_change_is_always_seen(self):
        turns, state, seen = Turns(1), [0], [0]

        def job(_: object) -> None:
            seen[0] = state[0]

        worker = NewestWins(job, print, "w", turns=turns)
        worker.start()
        for k in range(200):
            state[0] = k
            worker.wake()
        deadline = time.monotonic() + 2.0
        while seen[0] != 199 and time.monotonic() < deadline:
            time.sleep(0.001)
        worker.stop()
        assert seen[0] == 199

    def test_sleeps_once_and_wakes_before_the_next_round(self):
        events: list[str] = []
        sleep = IdleTimeout(0.03, lambda: events.append("falls"), lambda: events.append("wakes"))
        worker = NewestWins(lambda _: events.append("round"), print, "w", sleep)
        worker.start()
        time.sleep(0.15)
        worker.wake()
        while "round" not in events:
            time.sleep(0.002)
        worker.stop()
        assert events[:3] == ["falls", "wakes", "round"]


class TestMemory:
    def test_pages_that_go_together_are_cleared_away_once(self, monkeypatch: pytest.MonkeyPatch):
        cleared = threading.Semaphore(0)
        monkeypatch.setattr(memory.gc, "collect", lambda: cleared.release())
        for _ in range(5):
            memory.give_back_soon(0.1)
        assert cleared.acquire(timeout=2.0)
        assert not cleared.acquire(timeout=0.15)
        memory.give_back_soon(0.0)
        assert cleared.acquire(timeout=2.0)

"""Who may use a server, and how much: host names and origins, rate of messages, uploads, freed memory, its log."""

import logging
import time
from collections.abc import Iterator
from logging.handlers import BufferingHandler

import pytest

from explorer.app import App
from explorer.hosting import server_limits
from explorer.hosting.request_filter import AllowedHosts, host_name
from explorer.hosting.server_limits import (
    LARGEST_FILE,
    RateLimit,
    RateLimiter,
    RepeatFilter,
    ServerLimits,
    refuse_upload,
)
from tests.waited import until

HERE, PROXIED, OPEN = (
    AllowedHosts("127.0.0.1"),
    AllowedHosts("127.0.0.1", ("rotor.example",)),
    AllowedHosts("0.0.0.0"),
)
PORT = "127.0.0.1:8080"
FOREIGN_PAGES = (
    "http://evil.example",
    "https://127.0.0.1.evil.example:8080",
    "null",
    "",
    "http://127.0.0.1:9999",
    "http://localhost:8080",  # Other origins to the browser, too.
)


class TestAllowedHosts:
    @pytest.mark.parametrize(
        ("hosts", "host", "origin"),
        [
            *(
                (HERE, name, None)
                for name in (PORT, "localhost:8080", "LOCALHOST", "[::1]:8080", "localhost.")
            ),
            (HERE, PORT, f"http://{PORT}"),
            (PROXIED, "rotor.example", "https://rotor.example"),
            (PROXIED, "rotor.example:443", "https://rotor.example"),
            (PROXIED, PORT, "https://rotor.example"),  # A proxy may put its own host.
            (OPEN, "192.168.1.5:8080", "http://192.168.1.5:8080"),
            (OPEN, "[fe80::1]:8080", None),
        ],
    )
    def test_own_names_numbers_and_pages_are_accepted(
        self, hosts: AllowedHosts, host: str, origin: str | None
    ):
        assert hosts.refusal(host, origin) is None

    @pytest.mark.parametrize(
        ("hosts", "host", "origin", "said"),
        [
            # DNS rebinding: the attacker's own name, with our address.
            *(
                (HERE, f"{name}evil.example", None, "does not answer")
                for name in ("", "127.0.0.1.")
            ),
            *(
                (HERE, name, None, "does not answer")
                for name in ("evil.example:8080", "192.168.1.5", "", None)
            ),
            *(
                (HERE, name, None, "")
                for name in ("evil.example/@127.0.0.1", "a@127.0.0.1", "127.0.0.1:x", "[::1")
            ),
            (HERE, "127.0.0.1?x", None, ""),
            *((HERE, PORT, origin, "may not use") for origin in FOREIGN_PAGES),
            (PROXIED, "rotor.example.evil.example", None, ""),
            (PROXIED, PORT, "https://evil.example", ""),
            (OPEN, "evil.example:8080", None, ""),
        ],
    )
    def test_foreign_names_and_pages_are_refused(
        self, hosts: AllowedHosts, host: str | None, origin: str | None, said: str
    ):
        sentence = hosts.refusal(host, origin)
        assert sentence is not None
        assert said in sentence

    def test_an_invalid_name_cannot_be_allowed(self):
        assert host_name("Rotor.example:8080") == "rotor.example"
        for wrong in ("https://rotor.example", "rotor.example/page", "", "a@b"):
            with pytest.raises(ValueError, match="is not a host name"):
                host_name(wrong)


class TestRateLimiter:
    def test_a_burst_is_allowed_then_only_the_rate_of_messages_and_bytes(self):
        limiter = RateLimiter(0.0, RateLimit(10.0, 20.0), RateLimit(1e6, 1e6))
        assert all(limiter.allows(1, 0.0) for _ in range(20))
        assert not limiter.allows(1, 0.0)
        limiter = RateLimiter(0.0, RateLimit(10.0, 20.0), RateLimit(1e6, 1e6))
        assert all(limiter.allows(1, 0.1 * k) for k in range(1000))
        limiter = RateLimiter(0.0, RateLimit(100.0, 100.0), RateLimit(1e3, 1e4))
        assert limiter.allows(10_000, 0.0)
        assert not limiter.allows(1_000, 0.5)


def test_memory_is_returned_once_for_updates_that_follow_each_other(
    monkeypatch: pytest.MonkeyPatch,
):
    returned = list[float]()
    monkeypatch.setattr(server_limits, "_TRIM_AFTER_S", 0.1)
    monkeypatch.setattr(server_limits, "trim_memory", lambda: returned.append(time.monotonic()))
    for number in (1, 2):
        begun = time.monotonic()
        server_limits.trim_memory_soon()
        server_limits.trim_memory_soon()
        until(lambda number=number: len(returned) == number)
        assert returned[-1] - begun >= 0.1


class TestUploads:
    def test_files_that_are_accepted(self):
        assert refuse_upload("a.json", 1000, 1, 0, ".json") is None
        assert refuse_upload("A.JSON", 1000, 1, 0, ".toml, .json") is None
        assert refuse_upload("deck.c81", LARGEST_FILE, 8, 1, "*/*") is None
        assert refuse_upload("empty.json", 0, 0, 0, ".json") is None

    @pytest.mark.parametrize(
        ("sent", "sentence"),
        [
            (("film.json", 2 * LARGEST_FILE, 16, 0, ".json"), "8.0 MB: 4 MB are allowed"),
            (("large.parquet", 1000, 1, 0, ".json"), "choose a .json file"),
            (("film.mp4", 1000, 1, 0, ".json,.toml"), "choose a .json or .toml file"),
            (("third.json", 1000, 1, 2, ".json"), "must wait"),
            (("crumbs.json", 1000, 1000, 0, ".json"), "1000 parts"),
            (("odd.json", -1, 1, 0, ".json"), "parts"),
        ],
    )
    def test_files_that_are_refused_with_a_sentence(
        self, sent: tuple[str, int, int, int, str], sentence: str
    ):
        assert sentence in (refuse_upload(*sent) or "")


@pytest.fixture
def kept() -> Iterator[BufferingHandler]:
    """Keeps what passes its filters. Pytest's own handler may carry a filter of a server that ran before."""
    log, handler = logging.getLogger("explorer.test"), BufferingHandler(10_000)
    log.addHandler(handler)
    yield handler
    log.removeHandler(handler)


def fail(times: int) -> None:
    for number in range(times):
        try:
            raise ValueError(f"value {number}")
        except ValueError:
            logging.getLogger("explorer.test").exception("a callback failed")


def test_a_thousand_equal_failures_write_three_tracebacks(kept: BufferingHandler):
    kept.addFilter(RepeatFilter())
    fail(1000)
    assert len(kept.buffer) == 3
    logging.getLogger("explorer.test").warning("something else")
    assert len(kept.buffer) == 4


def test_later_the_number_left_out_is_told(kept: BufferingHandler, monkeypatch: pytest.MonkeyPatch):
    now = [0.0]
    monkeypatch.setattr("explorer.hosting.server_limits.time.monotonic", lambda: now[0])
    kept.addFilter(RepeatFilter(most=2, window=10.0))
    for now[0] in (0.0, 1.0, 2.0, 3.0, 20.0):
        fail(1)
    assert [record.getMessage() for record in kept.buffer] == [
        "a callback failed",
        "a callback failed",
        "a callback failed (2 more like this were not written)",
    ]


def test_a_server_with_too_little_room_for_caches_does_not_begin():
    with pytest.raises(ValueError, match="3 MB is too little for caches: give at least 64 MB"):
        App("127.0.0.1", 0, limits=ServerLimits(cache_bytes=3 * 2**20))

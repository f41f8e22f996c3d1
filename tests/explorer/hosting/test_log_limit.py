"""A flood of failures writes a few lines and a count."""

import logging
from collections.abc import Iterator

import pytest

from explorer.hosting.limits import RepeatFilter


class Kept(logging.Handler):
    """Keeps what passes its filters. Pytest's own handler may carry a filter of a server that ran before."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(record.getMessage())


@pytest.fixture
def kept() -> Iterator[Kept]:
    log, handler = logging.getLogger("explorer.test"), Kept()
    log.addHandler(handler)
    yield handler
    log.removeHandler(handler)


def fail(times: int) -> None:
    for number in range(times):
        try:
            raise ValueError(f"value {number}")
        except ValueError:
            logging.getLogger("explorer.test").exception("a callback failed")


def test_a_thousand_equal_failures_write_three_tracebacks(kept: Kept):
    kept.addFilter(RepeatFilter())
    fail(1000)
    assert len(kept.lines) == 3
    logging.getLogger("explorer.test").warning("something else")
    assert len(kept.lines) == 4


def test_later_the_number_left_out_is_told(kept: Kept, monkeypatch: pytest.MonkeyPatch):
    now = [0.0]
    monkeypatch.setattr("explorer.hosting.limits.time.monotonic", lambda: now[0])
    kept.addFilter(RepeatFilter(most=2, window=10.0))
    for now[0] in (0.0, 1.0, 2.0, 3.0, 20.0):
        fail(1)
    assert kept.lines == [
        "a callback failed",
        "a callback failed",
        "a callback failed (2 more like this were not written)",
    ]

"""How much a browser may send: so many messages and bytes a second, with room for a burst. Pure."""

from dataclasses import dataclass


@dataclass(frozen=True)
class RateLimit:
    """A bucket that holds `burst` and fills by `rate` a second."""

    rate: float
    burst: float


MESSAGES = RateLimit(rate=200.0, burst=2000.0)
"""A dragged slider sends 20 a second, a turned camera 50; a tab that slept may send more at once."""
BYTES = RateLimit(rate=2e6, burst=48e6)
"""A file too large by mistake is refused with a sentence (see `uploads`) before this cuts its sender off."""
LARGEST = 16 * 2**20
"""One message [bytes]: a picture of the scene, drawn by the browser, is the largest honest one."""


class RateLimiter:
    """What one connection has left."""

    def __init__(self, now: float, messages: RateLimit = MESSAGES, size: RateLimit = BYTES) -> None:
        self._buckets = [[messages, messages.burst], [size, size.burst]]
        self._then = now

    def take(self, size: int, now: float) -> bool:
        """Count a message of `size` bytes that came at `now` [s]; False when that is more than is allowed."""
        since, self._then = max(now - self._then, 0.0), now
        within = True
        for bucket, cost in zip(self._buckets, (1.0, float(size)), strict=True):
            allowance, left = bucket
            bucket[1] = min(left + since * allowance.rate, allowance.burst) - cost
            within = within and bucket[1] >= 0.0
        return within

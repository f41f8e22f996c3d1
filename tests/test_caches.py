"""What cached functions of the solver read: their arguments alone. How many bytes all caches keep together."""

import linecache
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from types import FrameType
from typing import Any

import numpy as np
import pytest

from rotor import make_design, solve
from rotor.support import bytes_cache
from rotor.support.arrays import Array
from rotor.support.bytes_cache import bytes_kept, limit_caches

MEGABYTE = 2**20


@pytest.fixture
def room(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[int], None]]:
    """Empties all caches, and lets them keep so many arrays of `MEGABYTE`."""
    kept = bytes_cache._kept
    limit = kept.limit
    monkeypatch.setattr(bytes_cache, "LEAST", 0)
    for one in list(kept._results):
        kept.drop(one)
    assert bytes_kept() == 0
    yield lambda count: limit_caches(int((count + 0.5) * MEGABYTE))
    limit_caches(limit)


def maker(made: list[tuple[str, int]], name: str) -> Callable[[int], Array]:
    """A function with a cache that tells what it makes: arrays of `MEGABYTE`, full of the argument."""

    @bytes_cache.bytes_cache
    def make(number: int) -> Array:
        made.append((name, number))
        return np.full(MEGABYTE // 8, float(number))

    return make


def test_caches_share_their_bytes_and_the_least_recently_used_goes_first(
    room: Callable[[int], None],
):
    made = list[tuple[str, int]]()
    a, b = maker(made, "a"), maker(made, "b")
    room(3)
    # Out go 1 of b, then 2 of a.
    for make, number in (
        (a, 1),
        (b, 1),
        (a, 2),
        (a, 1),
        (b, 2),
        (a, 1),
        (b, 1),
    ):
        assert make(number)[0] == number
        assert bytes_kept() <= 3.5 * MEGABYTE
    assert made == [("a", 1), ("b", 1), ("a", 2), ("b", 2), ("b", 1)]
    room(1)
    assert bytes_kept() <= 1.5 * MEGABYTE
    b(1)
    assert made[5:] == []
    a(1)
    assert made[5:] == [("a", 1)]


def test_a_result_larger_than_all_room_is_kept_until_the_next(room: Callable[[int], None]):
    made = list[tuple[str, int]]()
    make = maker(made, "a")
    room(0)
    assert make(7) is make(7)
    make(8)
    assert make(7)[0] == 7.0
    assert [number for _, number in made] == [7, 8, 7]


def test_an_interrupt_at_any_line_leaves_the_caches_whole(room: Callable[[int], None]):
    """In a notebook, Ctrl-C between two lines left a result that no cache could drop: each trim after it failed."""
    room(2)
    kept, lines, at = bytes_cache._kept, 0, 0

    def traced(frame: FrameType, event: str, _: object) -> Any:
        nonlocal lines
        if not frame.f_code.co_filename.endswith("bytes_cache.py"):
            return None
        # Python looks for signals after calls: none comes between a lock and the `try` behind it, or before its exit.
        text = linecache.getline(frame.f_code.co_filename, frame.f_lineno)
        if event == "line" and not text.lstrip().startswith(("with ", "try:")):
            lines += 1
            if lines == at:
                raise KeyboardInterrupt
        return traced

    before, stopped = sys.gettrace(), True
    while stopped:
        make, at, lines, stopped = maker([], "a"), at + 1, 0, False
        try:
            sys.settrace(traced)
            for number in (1, 2, 1, 3, 1, 4):
                make(number)
        except KeyboardInterrupt:
            stopped = True
        finally:
            sys.settrace(before)
        assert not kept.lock._is_owned()  # pyright: ignore[reportAttributeAccessIssue]
        assert make(5)[0] == 5.0
        vars(make)["cache_clear"]()
        assert (bytes_kept(), [*kept._results], kept._holders) == (0, [], {})
    assert at > 300


def test_arrays_of_several_results_count_once_and_arguments_count(room: Callable[[int], None]):
    whole = np.zeros(MEGABYTE // 8)

    @bytes_cache.bytes_cache
    def part(number: int, text: str = "") -> tuple[Array, Array]:
        return whole[:number], whole

    room(9)
    part(1)
    part(2)
    assert bytes_kept() == pytest.approx(MEGABYTE, abs=10_000)
    part(3, "x" * MEGABYTE)
    assert bytes_kept() == pytest.approx(2 * MEGABYTE, abs=10_000)
    part.__dict__["cache_clear"]()
    assert bytes_kept() == 0


def test_what_a_result_keeps_later_counts_too(room: Callable[[int], None]):
    class Grows:
        @cached_property
        def large(self) -> Array:
            return np.zeros(MEGABYTE // 8)

    @bytes_cache.bytes_cache
    def grows() -> Grows:
        return Grows()

    room(9)
    assert grows().large.nbytes == MEGABYTE
    assert bytes_kept() < 10_000
    grows()
    assert bytes_kept() > MEGABYTE


def test_small_results_are_bounded_too(room: Callable[[int], None]):
    @bytes_cache.bytes_cache
    def small(number: int) -> tuple[int, int]:
        return number, number

    room(0)
    for number in range(10_000):
        assert small(number) == (number, number)
    assert bytes_kept() <= 0.5 * MEGABYTE
    assert len(bytes_cache._kept._results) < 9_000


def test_threads_share_results_within_the_room(room: Callable[[int], None]):
    made = list[tuple[str, int]]()
    makers = [maker(made, name) for name in "abc"]
    room(5)

    def work(thread: int) -> float:
        random, most = np.random.default_rng(thread), 0.0
        for which, number in random.integers(0, (3, 4), (300, 2)).tolist():
            assert (makers[which](number) == number).all()
            with bytes_cache._kept.lock:
                most = max(most, bytes_kept())
            if number == 0 and which == 0:
                makers[2].__dict__["cache_clear"]()
        return most

    with ThreadPoolExecutor(4) as pool:
        assert max(pool.map(work, range(4))) <= 5.5 * MEGABYTE
    kept = sum(one.value.nbytes for one in bytes_cache._kept._results)
    assert kept <= bytes_kept() <= kept + 10_000
    assert len(made) < 1200


def test_a_trim_is_the_same_to_the_last_bit_whatever_is_kept(room: Callable[[int], None]):
    design = make_design(mu=0.2, inflow="lifting-line")
    room(400)
    before = [solve(design).power.total for _ in range(2)]
    room(0)
    after = [solve(design).power.total for _ in range(2)]
    assert len({*before, *after}) == 1

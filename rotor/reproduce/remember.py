"""Searches that several figures share: kept while the command runs, and worked off in processes before they are asked.

A remembered function computes what it is asked for, once. `work_off` has other processes compute the same calls and
puts their answers where the function will look.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import update_wrapper
from typing import Any, Generic, ParamSpec, TypeVar

from rotor.optimisation.processes import Workers

P = ParamSpec("P")
R = TypeVar("R")


class Remembered(Generic[P, R]):
    """A function of hashable arguments that keeps its answers. It pickles by its name, as a function does."""

    def __init__(self, function: Callable[P, R]) -> None:
        self.name = function.__qualname__
        self.known: dict[tuple[object, ...], R] = {}
        self._function = function
        update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> R:
        assert not kwargs, "a remembered function knows its calls by position"
        if args not in self.known:
            self.known[args] = self._function(*args, **kwargs)
        return self.known[args]

    def __reduce__(self) -> str:
        return self.name


Call = tuple[Remembered[..., Any], tuple[Any, ...]]
"""A remembered function and its arguments."""


def work_off(
    groups: Sequence[Sequence[Call]],
    processes: int,
    advance: Callable[[str], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> bool:
    """Make the calls, each group in one process, one after the other; True when stopped before the end.

    The groups with most to do come first. `advance` hears of every call as it is answered.
    """
    waiting = [tuple(call for call in group if call[1] not in call[0].known) for group in groups]
    seen: set[tuple[str, tuple[Any, ...]]] = set()

    def take(answered: tuple[Call, Any]) -> None:
        (function, args), answer = answered
        function.known[args] = answer
        if advance is not None and (function.name, args) not in seen:
            seen.add((function.name, args))
            advance(str(args[0]))

    with Workers(processes, take, stop) as workers:
        return workers.run([(_work, (group,)) for group in waiting if group])


def _work(calls: tuple[Call, ...], stop: Callable[[], bool] | None) -> Iterator[tuple[Call, Any]]:
    for function, args in calls:
        if stop is not None and stop():
            return
        yield (function, args), function(*args)

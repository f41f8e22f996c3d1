"""A question to the worker processes, as a value."""

from collections.abc import Callable, Generator, Hashable
from dataclasses import dataclass
from typing import Any, TypeVar

T = TypeVar("T")


@dataclass(frozen=True)
class Call:
    """A task of the pool: a function of a module and its arguments. It pickles; equal ones have one answer."""

    function: Callable[..., Any]
    arguments: tuple[Hashable, ...]

    def run(self, tell: object = None, stop: object = None) -> Any:
        """What the function returns; for a ValueError or RuntimeError its sentence."""
        del tell, stop  # The process ends soon.
        try:
            return self.function(*self.arguments)
        except (ValueError, RuntimeError) as error:
            return str(error)


def at_once(steps: Generator[Any, None, T]) -> T:
    """What these steps return, done one after another."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value

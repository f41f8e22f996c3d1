"""What cached functions read, changed for a while: no cache keeps what was made meanwhile."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

from rotor.validation.thesis.runs import CachedFunction

Patch = Callable[[str, object], None]
"""Sets the name in a module to a value."""


def empty_caches() -> None:
    """All of `rotor` that have been filled."""
    modules = [
        module for name, module in list(sys.modules.items()) if name.partition(".")[0] == "rotor"
    ]
    for value in [value for module in modules for value in list(vars(module).values())]:
        if isinstance(value, CachedFunction):
            value.known.clear()
        elif callable(clear := getattr(value, "cache_clear", None)):
            clear()


@contextmanager
def patching() -> Iterator[Patch]:
    """What patches; all is as before at the end."""
    with pytest.MonkeyPatch.context() as monkeypatch:

        def patch(name: str, value: object) -> None:
            monkeypatch.setattr(name, value)
            empty_caches()

        yield patch
    empty_caches()

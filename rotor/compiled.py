"""Compilation of numerical kernels by numba, kept on disk where that is possible.

numba itself ends the program where it has no folder to write to (a read-only installation without a home), where the
disk is full, and where a kept file was cut short. The kernels then compile anew, in some seconds, and nothing is kept.
"""

import logging
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numba  # pyright: ignore[reportMissingTypeStubs]
from numba.core.caching import FunctionCache  # pyright: ignore[reportMissingTypeStubs]

_log = logging.getLogger(__name__)


class _ForgivingCache(FunctionCache):
    """numba's cache, for which every failure means that there is nothing to read, or that nothing is kept."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kept code; None where there is none that can be read."""
        try:
            return super().load_overload(sig, target_context)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        except Exception as error:
            _log.debug("%r cannot be read (%s)", self, error)
            with suppress(Exception):
                self.flush()  # So that the code of this run can be kept.
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep the code where that is possible."""
        try:
            super().save_overload(sig, data)  # pyright: ignore[reportUnknownMemberType]
        except Exception as error:
            _log.debug("%r cannot be kept (%s)", self, error)


def compiled(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """A decorator: the function compiled with these options of `numba.njit`, without the interpreter lock."""

    def compile_function(function: Callable[..., Any]) -> Any:
        made: Any = numba.njit(nogil=True, **options)(function)  # pyright: ignore[reportUnknownVariableType, reportUnknownMemberType]
        try:
            made._cache = _ForgivingCache(function)  # What `cache=True` does, with numba's own class.
        except Exception as error:  # No folder to write to, or a source without a file.
            _log.debug("no place to keep %s (%s)", function.__name__, error)
        return made

    return compile_function

"""Processes that do not run the caller's script again.

A spawned process imports the main module of its parent before it starts its work: a script that opens a page, and has
no `if __name__ == "__main__"`, would open it again there. What this project runs in processes needs no main module.
"""

import sys
import threading
from collections.abc import Callable
from importlib.machinery import ModuleSpec
from multiprocessing import get_context
from multiprocessing.context import SpawnProcess
from typing import Any

_one_at_a_time = threading.Lock()


def start_process(work: Callable[..., None], arguments: tuple[Any, ...], name: str) -> SpawnProcess:
    """Start work(*arguments), a function of an importable module, in a daemonic process of that name."""
    process = get_context("spawn").Process(target=work, args=arguments, name=name, daemon=True)
    main = sys.modules["__main__"]
    with _one_at_a_time:
        spec, main.__spec__ = main.__spec__, ModuleSpec("__main__", None)  # A main module of this name is not imported.
        try:
            process.start()
        finally:
            main.__spec__ = spec
    return process

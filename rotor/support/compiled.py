"""Compilation of numerical kernels by numba, kept on disk where that is possible.

numba itself ends the program where it has no folder to write to (a read-only installation without a home), where the
disk is full, and where a kept file was cut short; LLVM ends it where a bit of one is another. The kernels then compile
anew.

The first run compiles them. On a terminal and in a notebook a line on stderr counts the kernels.
"""

import hashlib
import logging
import os
import pickle
import subprocess
import sys
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import DEVNULL
from types import ModuleType
from typing import Any

import numba  # pyright: ignore[reportMissingTypeStubs]
from numba.core import event  # pyright: ignore[reportMissingTypeStubs]
from numba.core.caching import FunctionCache, IndexDataCacheFile  # pyright: ignore[reportMissingTypeStubs]

_log = logging.getLogger(__name__)


class _CheckedFiles(IndexDataCacheFile):
    """numba's index and data files with a checksum before their content; ValueError for one that is damaged.

    Code has what it was compiled from beside it: numba writes the index first, and under the name that it gives there
    is the code of an earlier version until the new is written, for ever if writing is cut short.
    """

    def save(self, key: Any, data: Any) -> None:
        super().save(key, (self._origin(key), data))  # pyright: ignore[reportUnknownMemberType]

    def load(self, key: Any) -> Any:
        origin, data = super().load(key) or (None, None)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        return data if origin == self._origin(key) else None

    def _origin(self, key: Any) -> tuple[Any, ...]:
        return self._version, self._source_stamp, key

    def _dump(self, obj: Any) -> bytes:
        content: bytes = super()._dump(obj)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        return hashlib.sha256(content).digest() + content

    def _load_index(self) -> Any:
        version = pickle.dumps(self._version, protocol=-1)
        try:
            whole = Path(self._index_path).read_bytes()
        except FileNotFoundError:
            return {}
        if not whole.startswith(version):
            return {}
        stamp, overloads = _undamaged(whole.removeprefix(version))
        return overloads if stamp == self._source_stamp else {}

    def _load_data(self, name: str) -> Any:
        return _undamaged(Path(self._data_path(name)).read_bytes())  # pyright: ignore[reportUnknownMemberType, reportUnknownArgumentType]


def _undamaged(content: bytes) -> Any:
    if hashlib.sha256(content[32:]).digest() != content[:32]:
        raise ValueError("a kept file is damaged")
    return pickle.loads(content[32:])


class _RepairingCache(FunctionCache):
    """numba's cache, for which every failure means that there is nothing to read, or that nothing is kept.

    Kept code holds that of the functions it calls and the constants they name, so it serves as long as these and their
    files are the same as well.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        super().__init__(function)  # pyright: ignore[reportUnknownMemberType]
        cache: Any = self
        self._function = function
        place, stamp = cache._impl, cache._impl.locator.get_source_stamp()
        cache._cache_file = _CheckedFiles(cache._cache_path, place.filename_base, stamp)

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        """What numba finds kept code by, with those constants and digests of those files."""
        functions = _called(self._py_func, {self._py_func: None})
        named = [item for function in functions for item in _named(function)]
        constants = [repr(item) for item in named if issubclass(type(item), int | float | tuple)]
        files = sorted({function.__code__.co_filename for function in functions})
        key: tuple[Any, ...] = super()._index_key(sig, codegen)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        return *key, tuple(constants), tuple(_digests.get(file) or _digest(file) for file in files)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kept code, once another process that compiles it has done so; None where none can be read."""
        kept = self._read(sig, target_context)
        if kept is None and self._function in _second_process.functions and _second_process.at_work:
            with _watch.waiting(self._function):
                while kept is None and _second_process.at_work:
                    time.sleep(_POLL_S)
                    kept = self._read(sig, target_context)
        return kept

    def _read(self, sig: Any, target_context: Any) -> Any:
        try:
            return super().load_overload(sig, target_context)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
        except Exception as error:
            _log.debug("%r cannot be read (%s)", self, error)
            with suppress(Exception):
                self.flush()  # So that the code of this run can be kept.
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            super().save_overload(sig, data)  # pyright: ignore[reportUnknownMemberType]
        except Exception as error:
            _log.debug("%r cannot be kept (%s)", self, error)
            _watch.unkept = True


_digests: dict[str, bytes] = {}
"""Of each file when it was read: a program that goes on while another version takes the place of its files compiles
what it has read, and must not keep that as the code of the other version. Their times and sizes may be the same."""


def _digest(file: str) -> bytes:
    return hashlib.sha256(Path(file).read_bytes()).digest()


def _named(function: Any) -> list[Any]:
    """What the names in a function may mean: in its file, and in the modules among these."""
    names, space = function.__code__.co_names, function.__globals__
    places: list[dict[str, Any]] = [
        space,
        *(vars(space[n]) for n in names if isinstance(space.get(n), ModuleType)),
    ]
    return [place.get(name) for place in places for name in names]


def _called(function: Any, known: dict[Any, None]) -> dict[Any, None]:
    """All compiled functions that one calls, directly or through others, in the order of the names in it."""
    for item in _named(function):
        # `_defn`: of an intrinsic.
        callee = getattr(item, "py_func", None) or getattr(item, "_defn", None)
        if callee is not None and callee not in known:
            known[callee] = None
            _called(callee, known)
    return known


class _Watch(event.Listener):
    """Counts the kernels that numba compiles, and says so to whoever waits; numba calls it within its lock."""

    def __init__(self) -> None:
        self.kernels: list[Any] = []
        self.open: list[Any] = []
        """Under way: each was begun by the one before it."""
        self.told = True
        """Whether a stderr that is no terminal has its line, or is to have none."""
        self.unkept = False
        """Whether something that is compiled cannot be kept."""
        self.began = False
        """Whether this process has compiled anything."""
        self._kept: dict[int, bool] = {}
        self._width = 0

    @property
    def words(self) -> str:
        """The words on what is being compiled; empty where nothing is."""
        if not self.open:
            return ""
        ready, all_of_them = (
            sum(bool(one.overloads) or self.is_kept(one) for one in self.kernels),
            len(self.kernels),
        )
        return f"Compiling, {self._often}: {min(ready + 1, all_of_them)} of {all_of_them}"

    @property
    def _often(self) -> str:
        return "in each run" if self.unkept else "once"

    def is_kept(self, kernel: Any) -> bool:
        """Whether a run before has compiled it: the count goes on where that one ended. Looked up once."""
        if id(kernel) not in self._kept:
            self._kept[id(kernel)] = False
            with suppress(Exception):  # Without a file, or with a damaged one.
                self._kept[id(kernel)] = bool(kernel._cache._cache_file._load_index())
        return self._kept[id(kernel)]

    @contextmanager
    def waiting(self, function: Callable[..., Any]) -> Generator[None]:
        """While another process compiles it."""
        self.open += (mine := [kernel for kernel in self.kernels if kernel.py_func is function])
        self._show()
        yield
        del self.open[len(self.open) - len(mine) :]
        self._show()

    def on_start(self, event: Any) -> None:  # pyright: ignore[reportIncompatibleMethodOverride]
        kernel = event.data["dispatcher"]
        if any(kernel is known for known in self.kernels):  # Others are numba's own.
            self.began = True
            self.open.append(kernel)
            self._show()

    def on_end(self, event: Any) -> None:  # pyright: ignore[reportIncompatibleMethodOverride]
        if self.open and self.open[-1] is event.data["dispatcher"]:
            self.open.pop()
            self._show()

    def _show(self) -> None:
        stream, words = sys.stderr, self.words
        with suppress(Exception):  # The stream is closed or missing: nobody reads it.
            if stream.isatty() or "ipykernel" in sys.modules:
                print(f"\r{words:<{self._width}}\r{words}", end="", file=stream, flush=True)
                self._width = len(words)
            elif not self.told:
                self.told = True
                words = f"Compiling kernels, {self._often}"
                print(words, file=stream, flush=True)


_watch = _Watch()
event.register("numba:compile", _watch)  # pyright: ignore[reportUnknownMemberType]


def compiling() -> str:
    """What is being compiled now, as in "Compiling, once: 7 of 40"; empty where nothing is."""
    return _watch.words


def has_compiled() -> bool:
    """Whether this process has compiled anything."""
    return _watch.began


def why_not_kept() -> str:
    """One sentence on why what was compiled could not be kept on disk; empty where it was, or nothing was compiled."""
    sentence = "Compiled kernels cannot be kept, so each run compiles anew: set NUMBA_CACHE_DIR to another folder"
    return sentence if _watch.unkept and _watch.began else ""


class _SecondProcess:
    """Another process that compiles some of the kernels."""

    functions: frozenset[Callable[..., Any]] = frozenset()
    process: "subprocess.Popen[bytes] | None" = None

    @property
    def at_work(self) -> bool:
        return self.process is not None and self.process.poll() is None


_second_process = _SecondProcess()
_POLL_S = 0.05
"""[s] between two looks for a kernel that the other process compiles."""


@contextmanager
def compiled_in_parallel(compile_them: Callable[[], None], *modules: str) -> Generator[None]:
    """Within, the kernels of these modules are compiled by a second process, and waited for.

    `compile_them`: a function of a module, which the process calls. There is none where some of these are kept, none
    can be, or on one core.
    """
    kernels = [kernel for kernel in _watch.kernels if kernel.py_func.__module__ in modules]
    if (
        _watch.unkept
        or (os.cpu_count() or 1) < 2
        or any(one.overloads or _watch.is_kept(one) for one in kernels)
    ):
        yield
        return
    program = f"from {compile_them.__module__} import {compile_them.__name__} as go; go()"
    with subprocess.Popen(
        [sys.executable, "-c", program], stdin=DEVNULL, stdout=DEVNULL, stderr=DEVNULL
    ) as process:
        _second_process.functions, _second_process.process = (
            frozenset(kernel.py_func for kernel in kernels),
            process,
        )
        try:
            yield
        except BaseException:
            process.terminate()
            raise


def log_compiling() -> None:
    """Say once that kernels are compiled also where stderr is no terminal: for a server and a set-up."""
    _watch.told = False


def compiled(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """A decorator: the function compiled with these options of `numba.njit`, without the interpreter lock.

    Not with `fastmath={"contract"}`: what fuses then depends on which copy of a called function is linked first, and
    the run that compiles has other last bits than those that read kept code. It brings 0 to 7 % of a trim's time.
    """

    def compile_function(function: Callable[..., Any]) -> Any:
        with suppress(OSError):
            _digests[function.__code__.co_filename] = _digest(function.__code__.co_filename)
        compiled: Any = numba.njit(nogil=True, **options)(function)  # pyright: ignore[reportUnknownVariableType, reportUnknownMemberType]
        try:
            # What `cache=True` does, with numba's own class.
            compiled._cache = _RepairingCache(function)
        except Exception as error:  # No folder to write to, or a source without a file.
            _log.debug("no place to keep %s (%s)", function.__name__, error)
            _watch.unkept = True
        if options.get("inline") != "always":  # An inlined function is compiled into its callers.
            _watch.kernels.append(compiled)
        return compiled

    return compile_function

"""Names and files that a user gives: files read within bounds and written where possible; errors in one sentence."""

import codecs
import csv
import difflib
import errno
import importlib
import io
import logging
import math
import os
import re
import stat
import tempfile
from collections.abc import Collection, Generator, Iterable
from concurrent.futures import BrokenExecutor
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

_log = logging.getLogger(__name__)


class MissingExtra(ImportError, ValueError):
    """A package is not installed that only some uses need; one sentence with the remedy."""


def extra_module(name: str, what: str) -> Any:
    """A module that only some uses need. MissingExtra, for example `what` "a DataFrame", where it is not installed."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{name}.".startswith(f"{error.name}."):
            raise  # The module is installed; something that it imports is missing.
        package = name.partition(".")[0]  # The module has the same name on the package index.
        raise MissingExtra(f"{what} needs {package}: pip install {package}") from None


def causes(error: BaseException | None) -> list[BaseException]:
    """An exception and those that led to it."""
    return [] if error is None else [error, *causes(error.__cause__ or error.__context__)]


def raise_interrupt(error: BaseException) -> None:
    """KeyboardInterrupt where Ctrl-C led to this error: in compiled code it comes up as a SystemError."""
    if any(isinstance(one, KeyboardInterrupt) for one in causes(error)):
        raise KeyboardInterrupt from None


def lacks_means(error: BaseException) -> bool:
    """Whether memory, disk, files or processes of this machine ran out: with more of them the work may succeed."""
    return any(
        isinstance(one, (MemoryError, BrokenExecutor))
        or (isinstance(one, OSError) and one.errno in _MEANS)
        for one in causes(error)
    )


_MEANS = (errno.ENOMEM, errno.ENOSPC, errno.EAGAIN, errno.EMFILE, errno.ENFILE)
LARGEST = 4 * 2**20
"""[bytes] of a file that is read unless its reader allows another size; a deck has about 40 000."""
_SENTENCE, _WORD = 400, 60
"""Characters of a sentence, and of a long word or a value in it."""
_SKIPPED = " … "


def did_you_mean(name: object, known: Iterable[str]) -> str:
    """`; did you mean 'optimise'?`, or nothing where no known name begins so or is close. Capitals and hyphens do not
    matter."""
    plain, given = {_plain(one): one for one in known}, _plain(name)
    begin = [one for one in plain if one.startswith(given)] if len(given) > 2 else []
    close = difflib.get_close_matches(
        given, begin or list(plain), n=1, cutoff=0.0 if begin else 0.6
    )
    return f"; did you mean {plain[close[0]]!r}?" if close else ""


def check_known(what: str, name: object, known: Collection[str]) -> None:
    """ValueError for a name that is none of those known, with the nearest of them and all."""
    if name not in known:
        hint = did_you_mean(name, known) or ":"
        raise ValueError(f"{what} {name!r} is not known{hint} use one of {', '.join(known)}")


def _plain(name: object) -> str:
    return re.sub(r"[-_ ]", "", str(name)).casefold()


def shorten(text: str, most: int = _WORD) -> str:
    """The text in one line of at most `most` characters: its beginning and its end where it is longer."""
    text = " ".join(
        text[: 20 * most].split() + text[-most:].split() if len(text) > 21 * most else text.split()
    )
    if len(text) <= most:
        return text
    end = (most - len(_SKIPPED)) // 3
    return (
        f"{text[: most - len(_SKIPPED) - end].rstrip()}{_SKIPPED}{text[len(text) - end :].lstrip()}"
    )


def brief(sentence: object) -> str:
    """A message that may repeat an input at length, as one line without it: long words and the middle are left out."""
    return shorten(
        re.sub(rf"\S{{{2 * _WORD},}}", lambda word: shorten(word[0]), str(sentence)), _SENTENCE
    )


@contextmanager
def refusing(what: str, remedy: str) -> Generator[None]:
    """Turn every failure of the block into ValueError with one short sentence about `what`.

    A reader checks its input itself and raises ValueError; this is for what no reader expects: nesting that exceeds the
    recursion limit, integers of hundreds of digits, data that passes all checks and still cannot be used.
    """
    try:
        yield
    except ValueError as error:
        raise ValueError(brief(error)) from None
    except (RecursionError, MemoryError):
        raise ValueError(f"{what} is nested too deeply or too large: {remedy}") from None
    except Exception as error:
        _log.debug("%s cannot be used", what, exc_info=True)
        raise ValueError(
            brief(f"{what} cannot be used ({type(error).__name__}: {error}): {remedy}")
        ) from None


def read_bytes(path: str | Path, what: str, remedy: str, most: int = LARGEST) -> bytes:
    """The content of a file, for example `what` "design file". Never waits, and never reads more than `most` bytes.

    ValueError with one sentence for a missing file, for devices and pipes, and for a file that is too large.
    """
    name = repr(shorten(str(path)))
    if not str(path).strip():
        raise ValueError(f"{what} has an empty name: {remedy}")
    try:
        # Opening a pipe without a writer would wait for one.
        handle = os.open(
            path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
        )
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise ValueError(
                    f"{what} {name} is a device or a pipe, not a file: save it as a file first"
                )
            content = file.read(most + 1)
    except FileNotFoundError:
        raise ValueError(f"{what} {name} does not exist: {remedy}") from None
    except OSError as error:
        reason = "the name is too long" if error.errno == errno.ENAMETOOLONG else error.strerror
        raise ValueError(f"{what} {name} cannot be read ({reason}): {remedy}") from None
    except ValueError as error:
        if "null" in str(error):  # os.open raises these.
            raise ValueError(f"{what} {name} cannot be read ({error}): {remedy}") from None
        raise
    if len(content) > most:
        raise ValueError(f"{what} {name} has more than {most / 1e6:.1f} MB: {remedy}")
    return content


def read_text(path: str | Path, what: str, remedy: str, most: int = LARGEST) -> str:
    """The content of a file as text, see `text_of`; ValueError where it is not text."""
    content = read_bytes(path, what, remedy, most)
    try:
        return text_of(content)
    except UnicodeDecodeError:
        raise ValueError(
            f"{what} {shorten(str(path))!r} cannot be read (not text): {remedy}"
        ) from None


def text_of(content: bytes) -> str:
    """Text in UTF-8 or UTF-16 with a byte-order mark, as Windows writes it, in UTF-8, or else in Windows-1252.

    Raises UnicodeDecodeError for other content.
    """
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        text = content.decode("utf-16")
    else:
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("cp1252")
    if "\0" in text:
        raise UnicodeDecodeError("cp1252", content[:1], 0, 1, "holds zeros")
    return text.replace("\r\n", "\n")


def is_file(path: str | Path) -> bool:
    """Whether there is a file, also for names that no file can have."""
    return os.path.isfile(path)  # noqa: PTH113 - Path.is_file raises for names that are too long.


def make_folder(path: str | Path) -> Path:
    """A folder that can be written to, made where it is missing. Otherwise ValueError, and no folder is left behind."""
    folder = Path(path)
    missing = [parent for parent in (folder, *folder.parents) if not os.path.lexists(parent)]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except (OSError, ValueError) as error:
        for empty in missing:  # From the innermost outward.
            with suppress(OSError, ValueError):
                empty.rmdir()
        reason = error.strerror if isinstance(error, OSError) else error
        raise ValueError(
            f"cannot write to {str(path)!r} ({reason}): give a writable folder"
        ) from None


def check_writable(path: str | Path) -> None:
    """ValueError for a file that cannot be written, before the work for it begins; leaves no file behind."""
    there = os.path.lexists(path)
    try:
        with Path(path).open("a", encoding="utf-8"):
            pass
        if not there:
            Path(path).unlink()
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise ValueError(f"cannot write {str(path)!r} ({reason}): give a writable file") from None


def check_suffix(path: str | Path, suffix: str) -> None:
    """ValueError where a file's name says that it holds another format; a name without suffix says nothing."""
    if Path(path).suffix.lower() not in ("", suffix):
        raise ValueError(
            f"{str(path)!r} ends in {Path(path).suffix}, but what is written is {suffix[1:].upper()}: "
            f"write {str(Path(path).with_suffix(suffix))!r}"
        )


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write a file completely or not at all: whoever is killed meanwhile leaves the earlier file. OSError if not.

    What is not a file, as /dev/stdout, is written directly.
    """
    path = Path(os.path.realpath(path))
    data = content if isinstance(content, bytes) else content.encode()
    if path.exists() and not path.is_file():
        path.write_bytes(data)
        return
    try:
        handle, part = tempfile.mkstemp(
            dir=path.parent, prefix=f".{path.name[:40]}.", suffix=".part"
        )
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
        Path(part).chmod(mode)
        Path(part).replace(path)
    except BaseException:
        with suppress(OSError):
            Path(part).unlink()
        raise


def write_output(path: str | Path, content: str | bytes) -> None:
    """`write_whole`, for a file that the user named: ValueError with one sentence where it cannot be written."""
    try:
        write_whole(path, content)
    except OSError as error:
        raise ValueError(
            f"cannot write {str(path)!r} ({error.strerror}): give a writable file"
        ) from None


def csv_text(rows: Iterable[Iterable[object]], heading: str = "") -> str:
    """Rows as CSV, with the same line ends on every system, below a heading of comment lines."""
    text = io.StringIO(heading)
    text.seek(0, io.SEEK_END)
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def _umask() -> int:
    """Mode mask of this process; the system tells it only while it is set."""
    mask = os.umask(0o077)
    os.umask(mask)
    return mask


_MOST_VALUES = 10_000
"""Largest number of values of a range."""


def parse_range(text: str) -> list[float]:
    """`a:b:step` with both ends (falling with a negative step), numbers with commas, or one number; else ValueError."""
    try:
        if ":" in text:
            first, last, step = (float(item) for item in text.split(":"))
            steps = math.floor((last - first) / step + 1e-9)
            values = [first + k * step for k in range(min(steps, _MOST_VALUES) + 1)]
        else:
            first = last = step = 0.0
            values = [float(item) for item in text.split(",")]
    except (ValueError, OverflowError, ZeroDivisionError):
        raise ValueError(
            f"range {text!r} is not understood: write a:b:step, for example 0.05:0.40:0.05"
        ) from None
    if step * (last - first) < 0.0:
        backward, reversed_ends = f"{first:g}:{last:g}:{-step:g}", f"{last:g}:{first:g}:{step:g}"
        raise ValueError(
            f"range {text!r} never reaches its end: write {backward} or {reversed_ends}"
        )
    if len(values) > _MOST_VALUES:
        raise ValueError(
            f"range {text!r} has more than {_MOST_VALUES:,} values: take a larger step"
        )
    if not all(map(math.isfinite, values)):
        raise ValueError(
            f"range {text!r} holds a value that is not a number: write for example 0.05:0.40:0.05"
        )
    return [round(value, 12) for value in values]

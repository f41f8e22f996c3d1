"""Reading a result of a study that a visitor uploads: in a process of its own with bounded memory and time.

A Parquet file says how large its parts are, and Arrow relies on it: some kilobytes may unpack to gigabytes. One file is
read at a time, for all pages together.
"""

import importlib
import pickle
import sys
import threading
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path

from rotor.spawn import start_process
from rotor.study.results import Results, read_file
from rotor.user_input import brief, shorten

_MEMORY = 2 * 10**9
"""[bytes] beyond what the process has after its start; an accepted file unpacks to a fifth of it."""
_PATIENCE = 60.0
"""[s]"""
_one_at_a_time = threading.Lock()


def read_bounded(content: bytes, name: str, *, memory: int = _MEMORY, patience: float = _PATIENCE) -> Results:
    """As `read_file`. ValueError also for a file that needs more memory [bytes] or time [s] to read."""
    with _one_at_a_time:
        ours, theirs = Pipe(duplex=False)
        reader = start_process(_read, (theirs, content, name, memory), "parquet")
        theirs.close()
        try:
            answer = pickle.loads(ours.recv_bytes()) if ours.poll(patience) else "it takes too long to read"
        except EOFError:
            answer = "it needs too much memory to read"
        finally:
            ours.close()
            reader.kill()
            reader.join()
    if isinstance(answer, Results):
        return answer
    if answer.startswith("it "):
        raise ValueError(f"{shorten(name)!r} cannot be shown ({answer}): give a smaller file, or the study's folder")
    raise ValueError(answer)


def _read(answer: Connection, content: bytes, name: str, memory: int) -> None:
    """In the other process: send the results, or a sentence."""
    made: Results | str
    try:
        importlib.import_module("pyarrow.parquet")  # Its own code is not counted.
        limit_memory(memory)
        made = read_file(content, name)
        answer.send_bytes(pickle.dumps(made))
        return
    except MemoryError:  # Arrow's is one too.
        made = "it needs too much memory to read"
    except Exception as error:
        made = brief(error)
    answer.send_bytes(pickle.dumps(made))


def limit_memory(memory: int) -> None:
    """Bound the address space of this process (Linux; elsewhere the sizes that the file itself gives must do)."""
    if sys.platform != "linux":
        return
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    most = pages * resource.getpagesize() + memory
    resource.setrlimit(resource.RLIMIT_AS, (most, most))

"""Speed of the solver, and memory and load of the page's server, on this machine, as docs/measured.md.

`python -m tests.tools.bench --page` measures and writes docs/measured.json and from it the page; every other page links
to it. Run it on an idle machine: each time is the least of some runs.
"""

import asyncio
import json
import os
import platform
import re
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import psutil

import rotor
from tests.tools.visitor import Visitor, arrived, ran

ROOT = Path(__file__).parents[2]
PAGE, DATA = ROOT / "docs/measured.md", ROOT / "docs/measured.json"
RUNS, PAGES, SECONDS = 3, 20, 20.0
"""Runs of which the least counts; pages that drag at once, and for how long [s]."""
_PAUSE = 0.05
"""[s] between an answer and the next edit: a dragged slider sends 20 a second."""
_COLUMNS = {
    "": "elastic",
    "linear inflow, ": "rigid, linear inflow",
    "rigid blade, ": "rigid",
    "bending blade, ": "bending",
}
_ROWS = {
    "evaluation": "one evaluation of the equations",
    "cold": "a trim from a cold start",
    "warm": "a trim from a neighbour",
    "warm, new speed": "a trim from a neighbour at another speed",
    "moving": "a frame of a drag",
    "gradient": "the gradient of its power",
    "doubt": "its uncertainty",
}


def write(timed: Callable[[], dict[str, Any]]) -> None:
    """Measure, and write data and page; `timed`: figures of the solver."""
    data = {**about(), "pages": loads(), "kernels_s": round(compile_seconds(), 1), **timed()}
    DATA.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PAGE.write_text(page(data), encoding="utf-8")


def about() -> dict[str, Any]:
    """When and on what."""
    names = re.findall(
        r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE
    )
    return {
        "date": datetime.now(UTC).strftime("%Y-%m-%d"),
        "version": rotor.__version__,
        "processor": names[0] if names else platform.machine(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "numba": version("numba"),
        "runs": RUNS,
    }


def compile_seconds() -> float:
    """Processor time of compiling all kernels [s]."""
    with TemporaryDirectory(prefix="kernels-") as empty:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        asked = {**os.environ, "NUMBA_CACHE_DIR": empty}
        subprocess.run(
            [sys.executable, "-m", "rotor", "warm"],
            cwd=ROOT,
            env=asked,
            check=True,
            capture_output=True,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


@contextmanager
def served() -> Iterator[tuple[str, int]]:
    """Address and process of a server of its own."""
    call = [sys.executable, "-m", "explorer", "--port", "0", "--no-browser"]
    with subprocess.Popen(
        call, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        try:
            yield (
                next(
                    found[0]
                    for line in process.stdout
                    if (found := re.search(r"http://127[^\s/]+", line))
                ),
                process.pid,
            )
        finally:
            process.terminate()


def memory(process: int) -> float:
    """Of a process and all that it began [MB], what they share counted once."""
    family = [first := psutil.Process(process), *first.children(recursive=True)]
    return sum(one.memory_full_info().pss for one in family) / 1e6


async def drag(visitor: Visitor, k: int, seconds: float) -> list[float]:
    """How long each edit of a slider took until a picture showed it [s]."""
    took, end = list[float](), time.monotonic() + seconds
    while time.monotonic() < end:
        begun, shown = time.monotonic(), visitor.pictures
        await visitor.move("Adv. ratio µ", round(0.12 + 0.01 * ((5 * k + 3 * len(took)) % 18), 3))
        await visitor.until(lambda shown=shown: visitor.pictures > shown)
        took.append(time.monotonic() - begun)
        await asyncio.sleep(_PAUSE)
    return took


async def visit(address: str, process: int, pages: int) -> dict[str, float]:
    """So many pages of different flights that drag at once."""
    visitors = [
        await arrived(address, query=f"?d=1;linear:-{4 + 0.5 * k:g};mu=0.31;alt={100 * k}")
        for k in range(pages)
    ]
    each = await asyncio.gather(*(drag(one, k, SECONDS) for k, one in enumerate(visitors)))
    took = sorted(time for times in each for time in times)
    used = memory(process)
    for visitor in visitors:
        await visitor.close()
    half, late = (round(1e3 * took[int(part * len(took))]) for part in (0.5, 0.95))
    return {
        "p50_ms": half,
        "p95_ms": late,
        "frames": round(len(took) / pages / SECONDS, 1),
        "mb": round(used),
    }


def loads() -> dict[str, dict[str, float]]:
    """One page and many, by their number, on a server that has had a page before."""
    with served() as (address, process):

        async def first() -> None:
            visitor = await arrived(address)
            await visitor.idle()
            await visitor.close()

        ran(first)
        return {str(n): ran(lambda n=n: visit(address, process, n), 600.0) for n in (1, PAGES)}


def page(data: dict[str, Any]) -> str:
    """docs/measured.md."""
    times = data["ms"]
    alone, many = (data["pages"][key] for key in ("1", str(PAGES)))
    each = (many["mb"] - alone["mb"]) / (PAGES - 1)
    per_trim = 1e3 / data["trims_per_second_and_core"]["as a study works them off"]
    solver = [
        (words, *(f"{times[f'{column}{row}']:.2g}" for column in _COLUMNS))
        for row, words in _ROWS.items()
    ]
    other = [
        ("a trim of hover, cold", f"{times['hover, cold']:.2g} ms"),
        ("a trim of the study `hundred_thousand.toml`", f"{per_trim:.2g} ms"),
        *(
            (f"the {name}, with its band", f"{seconds:.2g} s")
            for name, seconds in data["seconds"].items()
        ),
        ("all kernels compiled, once for each version", f"{data['kernels_s']:.0f} s"),
    ]
    load = [
        ("from an edit to its frame, median", f"{alone['p50_ms']} ms", f"{many['p50_ms']} ms"),
        ("from an edit to its frame, 95 of 100", f"{alone['p95_ms']} ms", f"{many['p95_ms']} ms"),
        ("frames of each page in a second", f"{alone['frames']}", f"{many['frames']}"),
        ("memory of the server", f"{alone['mb']} MB", f"{many['mb']} MB"),
    ]
    made = (
        f"{data['date']}, version {data['version']}, {data['cores']} cores of {data['processor']}"
    )
    return f"""# Speed, memory and load, measured

`make bench ARGS=--page` writes this page. {made}, Python {data["python"]}, numba {data["numba"]}.
The yardstick of a machine is one evaluation of the equations (`make bench` prints it): other times go with it.

## The solver

Processor time of one core in ms, the least of {data["runs"]} runs, mean of six speeds, preset `flight`.

{_table(("", *_COLUMNS.values()), solver)}

{_table(("elastic blade", "time"), other)}

## A server and its pages

Each page drags a slider and draws nothing: an edit, its frame, a pause of {1e3 * _PAUSE:.0f} ms, the next edit.
Each further page at work adds {each:.0f} MB.

{_table(("", "one page", f"{PAGES} pages at once"), load)}
"""


def _table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [head, ("---", *["---:"] * (len(head) - 1)), *rows]
    return "\n".join(f"|{'|'.join(line)}|" for line in lines)

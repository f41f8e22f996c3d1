"""Runs XFOIL without a screen and reads its polar files.

Debian's binary stops with a floating-point trap when its graphics are off. With a C compiler, a one-line library that
disables the traps is preloaded (fast, more points converge); otherwise `xvfb-run` provides a screen. Both can hang or
crash at single angles, so every sweep is a process with a time limit, and sweeps with other panelings fill the gaps.
"""

import atexit
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from rotor.airfoil.contour import Contour
from rotor.airfoil.polars import Array, Polar

# gfortran's run-time calls this to switch the traps on; an empty one, loaded first, leaves them off.
_TRAP_SHIM = "void _gfortran_set_fpe(int mask) { (void)mask; }\n"
_CPU_LIMIT = 40  # s of processor time, the same on a busy machine; a sweep takes 1 to 15 s; a hung one never ends.
_TIME_LIMIT = 120.0  # s of wall-clock time, for a process that waits without using the processor.
_LIMITED = ("sh", "-c", f'ulimit -t {_CPU_LIMIT} && exec "$@"', "sh")
# (panels, iterations), in this order.
_PANELINGS = (
    (160, 100),
    (200, 200),
    (240, 300),
    (180, 300),
    (220, 300),
)

Row = tuple[float, float, float]


class XfoilError(RuntimeError):
    """XFOIL gave no usable polar; the message is one sentence with a remedy."""


@dataclass(frozen=True)
class XfoilCase:
    """Flow of one polar: `mach`, `reynolds` [-], `n_crit`, and `trip` [chord] on both sides or None for free."""

    mach: float
    reynolds: float
    n_crit: float
    trip: float | None


def require_xfoil() -> None:
    """Raise `XfoilError` with a remedy when the xfoil program, or a way to run it without a screen, is absent."""
    if shutil.which("xfoil") is None:
        raise XfoilError(
            "xfoil was not found: the bundled decks serve at run time, only rebuilding polars needs it; "
            "install it (Debian: apt install xfoil xvfb) or rebuild with --from-polars"
        )
    if _compiler() is None and shutil.which("xvfb-run") is None:
        raise XfoilError(
            "xfoil needs a C compiler or xvfb-run to run without a screen: apt install xvfb, or gcc"
        )


def _compiler() -> str | None:
    return shutil.which("gcc") or shutil.which("cc")


@lru_cache(maxsize=1)
def _shim_folder() -> tempfile.TemporaryDirectory[str] | None:
    """A temporary folder with the compiled shim, kept for the life of the process; None without a compiler."""
    compiler = _compiler()
    if compiler is None:
        return None
    folder = tempfile.TemporaryDirectory(prefix="rotor-xfoil-")
    atexit.register(folder.cleanup)
    source = Path(folder.name) / "notraps.c"
    source.write_text(_TRAP_SHIM, encoding="utf-8")
    made = subprocess.run(
        [compiler, "-shared", "-fPIC", "-nostdlib", "-O1", "-o", "notraps.so", source.name],
        cwd=folder.name,
        capture_output=True,
        timeout=60,
        check=False,
    )
    if made.returncode != 0:
        folder.cleanup()
        return None
    return folder


def _sweep(
    contour: Contour,
    case: XfoilCase,
    start: float,
    stop: float,
    step: float,
    panels: int,
    iterations: int,
) -> dict[float, Row]:
    """One XFOIL process marching from `start` to `stop` [deg]; the converged rows by angle, possibly none."""
    commands = [
        "LOAD section.dat",
        "PPAR",
        f"N {panels}",
        "",
        "",
        "OPER",
        f"VISC {case.reynolds:.0f}",
    ]
    commands += [f"MACH {case.mach:g}", "VPAR", f"N {case.n_crit:g}"]
    if case.trip is not None:
        commands += [f"XTR {case.trip:g} {case.trip:g}"]
    commands += [
        "",
        f"ITER {iterations}",
        "PACC",
        "polar.txt",
        "",
        f"ASEQ {start:g} {stop:g} {step:g}",
        "",
        "QUIT",
        "",
    ]
    environment, program = dict(os.environ), ["xvfb-run", "-a", "xfoil"]
    if (shim := _shim_folder()) is not None:
        commands = ["PLOP", "G F", "", *commands]  # Without a screen; only safe with the traps off.
        environment["LD_PRELOAD"], program = str(Path(shim.name) / "notraps.so"), ["xfoil"]
    body = "\n".join(f"{x:.7f} {y:.7f}" for x, y in contour.points)
    with tempfile.TemporaryDirectory(prefix="rotor-xfoil-") as folder:
        Path(folder, "section.dat").write_text(f"{contour.name}\n{body}\n", encoding="utf-8")
        clean = _run(program, "\n".join(commands), folder, environment)
        polar = Path(folder, "polar.txt")
        rows = _parse(polar.read_text(encoding="utf-8", errors="replace")) if polar.exists() else {}
    if not clean and rows:
        rows.popitem()  # The last row of a crashed or killed run may be truncated, or NaN.
    return rows


def _run(call: list[str], commands: str, folder: str, environment: dict[str, str]) -> bool:
    """Run one process on `commands`; False when it crashed or was killed for exceeding a limit."""
    with subprocess.Popen(
        [*_LIMITED, *call], cwd=folder, env=environment, text=True, start_new_session=True,
        stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    ) as process:  # fmt: skip
        try:
            process.communicate(commands, timeout=_TIME_LIMIT)
        except subprocess.TimeoutExpired:
            # The whole session: xvfb-run has children of its own.
            os.killpg(process.pid, signal.SIGKILL)
            return False
    return process.returncode == 0


def _parse(text: str) -> dict[float, Row]:
    """Rows below the dashed line of an XFOIL polar file: {alpha: (cl, cd, cm)}; unreadable rows are dropped."""
    _, found, body = text.partition("------ --------")
    rows: dict[float, Row] = {}
    for line in body.splitlines()[1:] if found else []:
        words = line.split()
        try:
            alpha, cl, cd, _cdp, cm = (float(word) for word in words[:5])
        except ValueError:
            continue
        if np.isfinite([cl, cd, cm]).all() and cd > 0.0 and abs(cl) < 4.0:
            rows[round(alpha, 3)] = (cl, cd, cm)
    return rows


def _gaps(missing: Sequence[float], step: float) -> list[tuple[float, float]]:
    """Runs of neighbouring missing angles as (from, to), ordered outward from zero."""
    runs: list[tuple[float, float]] = []
    for alpha in sorted(missing):
        if runs and alpha - runs[-1][1] < 1.5 * step:
            runs[-1] = (runs[-1][0], alpha)
        else:
            runs.append((alpha, alpha))
    return [(a, b) if b > 0 else (b, a) for a, b in runs]


def run_polar(
    contour: Contour,
    case: XfoilCase,
    alpha_deg: Array,
    report: Callable[[str], None] = lambda _message: None,
) -> Polar:
    """Polar of `contour` at the uniformly spaced angles `alpha_deg` [deg]; angles that never converge are left out.

    The first paneling marches outward from zero in both directions; the others only fill its gaps.
    """
    require_xfoil()
    step = float(alpha_deg[1] - alpha_deg[0])
    wanted = [round(float(a), 3) for a in alpha_deg]
    rows: dict[float, Row] = {}
    for attempt, (panels, iterations) in enumerate(_PANELINGS):
        missing = [a for a in wanted if a not in rows]
        if not missing:
            break
        sweeps = [(0.0, max(wanted)), (0.0, min(wanted))] if attempt == 0 else _gaps(missing, step)
        for inner, outer in sweeps:
            outward = np.sign(outer) if outer else 1.0
            # Starts where it converges.
            lead = 0.0 if attempt == 0 else outward * min(abs(inner), 2.0)
            found = _sweep(contour, case, inner - lead, outer, outward * step, panels, iterations)
            for alpha, row in found.items():
                rows.setdefault(alpha, row)
    kept = [a for a in wanted if a in rows]
    if len(kept) < len(wanted) // 2:
        raise XfoilError(
            f"xfoil converged at only {len(kept)} of {len(wanted)} angles at Mach {case.mach:g}: "
            "check the coordinates, or use the bundled polars with --from-polars"
        )
    report(f"{contour.name} Mach {case.mach:g}: {len(kept)} of {len(wanted)} angles")
    values = np.array([rows[a] for a in kept], dtype=np.float64)
    return Polar(case.mach, case.reynolds, np.array(kept), values[:, 0], values[:, 1], values[:, 2])

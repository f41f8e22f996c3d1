"""What another process uses: memory and processor time, from /proc where there is one, else from `ps`."""

import os
import subprocess
from pathlib import Path

_PROC = Path("/proc/self/stat").exists()


def resident_mb(pid: int) -> float:
    """Resident memory [MB] of a process; 0 once it has ended."""
    if _PROC:
        try:
            pages = int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1])
        except (OSError, IndexError):
            return 0.0
        return pages * os.sysconf("SC_PAGE_SIZE") / 1e6
    return float(_ps(pid, "rss") or 0.0) * 1024.0 / 1e6


def processor_seconds(pid: int) -> float:
    """Processor time a process has used, its children not counted [s]; to the second where there is no /proc."""
    if _PROC:
        try:
            stat = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
        except OSError:
            return 0.0
        after_name = stat.rpartition(")")[2].split()  # The name may hold anything; user and system time are 14 and 15.
        return (int(after_name[11]) + int(after_name[12])) / os.sysconf("SC_CLK_TCK")
    seconds = 0.0
    for part in _ps(pid, "time").replace("-", ":").split(":"):
        seconds = 60.0 * seconds + float(part or 0.0)
    return seconds


def _ps(pid: int, column: str) -> str:
    done = subprocess.run(["ps", "-o", f"{column}=", "-p", str(pid)], capture_output=True, text=True, check=False)
    return done.stdout.strip()

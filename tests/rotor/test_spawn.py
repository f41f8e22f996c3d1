"""Processes that the page starts, from a script as users write it."""

import subprocess
import sys
from pathlib import Path

_SCRIPT = """
from rotor.spawn import start_process
print("script", flush=True)
process = start_process(print, ("work",), "worker")
process.join()
print(process.exitcode, __spec__)
"""


def test_a_script_without_a_guard_runs_once(tmp_path: Path):
    script = tmp_path / "script.py"
    script.write_text(_SCRIPT, encoding="utf-8")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=120)
    assert done.stdout.split() == ["script", "work", "0", "None"]
    assert done.stderr == ""

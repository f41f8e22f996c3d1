"""Build sdist and wheel, install the wheel in a clean environment, and use it there: `make release`.

`tests/test_wheel.py` does the same without the network, on the packages of the environment that runs the tests.
"""

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import sysconfig
import tempfile
import urllib.request
import venv
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent
STUDY = """title = "Three speeds"
[axes]
mu = [0.1, 0.2, 0.3]
[fixed]
twist = "linear:-10"
"""
_PURELIB = "import sysconfig; print(sysconfig.get_path('purelib'))"


def build(folder: Path) -> Path:
    """Build the sdist from the checkout and the wheel from the sdist, so that neither lacks a file."""
    _do(sys.executable, "-m", "hatchling", "build", "--target", "sdist", "--directory", str(folder), cwd=ROOT)
    (sdist,) = folder.glob("*.tar.gz")
    pip = (sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check")
    _do(*pip, "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", str(folder), str(sdist), cwd=folder)
    (wheel,) = folder.glob("*.whl")
    return wheel


def install(wheel: Path, folder: Path, *, borrow: bool) -> Path:
    """The Python of a fresh environment with the wheel in it.

    Its dependencies are installed, or with `borrow` taken from the environment that runs this.
    """
    venv.create(folder, with_pip=True)
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    pip = (str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", "install")
    if not borrow:
        _do(*pip, f"{wheel}[study]", cwd=folder)
        return python
    _do(*pip, "--no-deps", "--no-index", str(wheel), cwd=folder)
    # A path file inside the borrowed folder is not read again, so an editable checkout stays out of sight.
    own = run(python, "-c", _PURELIB, cwd=folder).strip()
    Path(own, "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    return python


def run(python: Path, *arguments: str, cwd: Path) -> str:
    """What a command of the environment prints; RuntimeError when it fails or writes to stderr."""
    done = subprocess.run([python, *arguments], cwd=cwd, capture_output=True, text=True, timeout=300)
    if done.returncode or done.stderr:
        raise RuntimeError(f"{' '.join(arguments)} ended with {done.returncode}: {done.stderr}")
    return done.stdout


def solve(python: Path, cwd: Path) -> dict:
    """The record of one trim."""
    return json.loads(run(python, "-m", "rotor", "solve", "--mu", "0.2", "--json", cwd=cwd))


def fetch_page(python: Path, cwd: Path) -> str:
    """Start the page, fetch it over loopback, stop it as Ctrl-C does; its HTML."""
    flags = {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP} if os.name == "nt" else {}
    command = [python, "-m", "explorer", "--port", "0", "--no-browser"]
    with subprocess.Popen(command, cwd=cwd, stdout=subprocess.PIPE, text=True, **flags) as server:
        try:
            assert server.stdout is not None
            address = re.search(r"http://\S+", server.stdout.readline())
            if address is None:
                raise RuntimeError("the page did not print its address")
            html = urllib.request.urlopen(address[0], timeout=30).read().decode("utf-8")
            server.send_signal(signal.CTRL_BREAK_EVENT if os.name == "nt" else signal.SIGINT)
            code = server.wait(timeout=30)
        finally:
            server.kill()
    if code != 0 and os.name != "nt":
        raise RuntimeError(f"the page ended with {code}")
    return html


def study(python: Path, cwd: Path) -> str:
    """Run a small study; what `study show` says of it."""
    (cwd / "small.toml").write_text(STUDY, encoding="utf-8")
    command = [python, "-m", "rotor", "study", "small.toml", "--out", "small", "--workers", "1"]
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise RuntimeError(f"the study ended with {done.returncode}: {done.stderr}")
    return run(python, "-m", "rotor", "study", "show", "small", cwd=cwd)


def main() -> int:
    """Build into `--out`, then try the wheel."""
    parser = argparse.ArgumentParser(description="Build sdist and wheel, and use the wheel in a clean environment.")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder for sdist and wheel (default dist)")
    folder = parser.parse_args().out.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for old in (*folder.glob("*.whl"), *folder.glob("*.tar.gz")):
        old.unlink()
    wheel = build(folder)
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        python = install(wheel, place / "venv", borrow=False)
        power = solve(python, place)["power_w"]["total"]
        print(f"solve: {power / 1e3:.1f} kW")
        print(f"page: {len(fetch_page(python, place))} characters")
        print(study(python, place))
    for made in sorted((*folder.glob("*.whl"), *folder.glob("*.tar.gz"))):
        print(f"{made.stat().st_size / 1e6:8.2f} MB  {made.name}")
    return 0


def _do(*command: str, cwd: Path) -> None:
    subprocess.run(command, cwd=cwd, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    raise SystemExit(main())

"""The checklist of a release as a command: `make release`.

It builds sdist and wheel twice and compares the bytes, lets twine and check-wheel-contents look at them, installs the
wheel alone into a clean environment for every Python from 3.11 to 3.14 on this machine and uses it there (trim, page,
study, the documentation's first example), and reads version, changelog and the licences of pinned packages. Each item
is printed with what was found; the exit code is 1 if one is not met. `tests/test_wheel.py` does the same for one Python
without the network.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import urllib.request
from collections.abc import Iterable, Iterator
from importlib.metadata import metadata
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent
STUDY = """title = "Three speeds"
[axes]
mu = [0.1, 0.2, 0.3]
[fixed]
twist = "linear:-10"
"""
_PURELIB = "import sysconfig; print(sysconfig.get_path('purelib'))"


PYTHONS = ("3.11", "3.12", "3.13", "3.14")
PERMISSIVE = ("MIT", "BSD", "Apache", "MPL", "PSF", "Python Software Foundation")
"""A licence of a pinned package names one of these: the project's own is MIT."""
CHECKS = (("twine", "check", "--strict"), ("check_wheel_contents", "--toplevel", "rotor,explorer"))


def build(folder: Path) -> Path:
    """Build the sdist from the checkout and the wheel from the sdist, so that neither lacks a file.

    Times in both are those of the last commit, so that a second build gives the same bytes.
    """
    command = ("git", "log", "-1", "--format=%ct")
    found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if not found.returncode:
        os.environ["SOURCE_DATE_EPOCH"] = found.stdout.strip()
    _do(
        sys.executable,
        "-m",
        "hatchling",
        "build",
        "--target",
        "sdist",
        "--directory",
        str(folder),
        cwd=ROOT,
    )
    (sdist,) = folder.glob("*.tar.gz")
    pip = (sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check")
    _do(
        *pip,
        "wheel",
        "--no-deps",
        "--no-build-isolation",
        "--wheel-dir",
        str(folder),
        str(sdist),
        cwd=folder,
    )
    (wheel,) = folder.glob("*.whl")
    return wheel


def digests(folder: Path) -> dict[str, str]:
    """SHA-256 of the sdist and the wheel in a folder, by name."""
    made = (*folder.glob("*.whl"), *folder.glob("*.tar.gz"))
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in made}


def find_python(version: str) -> str | None:
    """An interpreter of a version, for example 3.12: this one, on the path, or one of pyenv's."""
    pyenv = Path.home().glob(f".pyenv/versions/{version}*/bin/python")
    places = [sys.executable, *pyenv, shutil.which(f"python{version}")]
    code = "import sys; print('.'.join(map(str, sys.version_info[:2])))"
    for place in filter(None, places):  # One that is on the path may be a shim that leads nowhere.
        found = subprocess.run([place, "-c", code], capture_output=True, text=True)
        if found.stdout.strip() == version:
            return str(place)
    return None


def install(wheel: Path, folder: Path, *, borrow: bool, interpreter: str = sys.executable) -> Path:
    """The Python of a fresh environment with the wheel in it.

    Its dependencies and those of studies are installed, or with `borrow` taken from the environment that runs this.
    """
    _do(interpreter, "-m", "venv", str(folder), cwd=folder.parent)
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
    done = subprocess.run(
        [python, *arguments], cwd=cwd, capture_output=True, text=True, timeout=900
    )
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
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=900)
    if done.returncode:
        raise RuntimeError(f"the study ended with {done.returncode}: {done.stderr}")
    return run(python, "-m", "rotor", "study", "show", "small", cwd=cwd)


def first_example() -> str:
    """The first Python example of the documentation's start page."""
    found = re.search(
        r"```python\n(.*?)```", (ROOT / "docs" / "index.md").read_text(encoding="utf-8"), re.DOTALL
    )
    if found is None:
        raise RuntimeError("docs/index.md has no Python example")
    return found[1]


def package_faults(folder: Path) -> str:
    """What twine says of the metadata, and check-wheel-contents of the files; empty when all is well."""
    wheels, both = [*folder.glob("*.whl")], [*folder.glob("*.whl"), *folder.glob("*.tar.gz")]
    said = ""
    for (module, *words), files in zip(CHECKS, (both, wheels), strict=True):
        done = subprocess.run(
            [sys.executable, "-m", module, *words, *files], capture_output=True, text=True
        )
        said += f"{done.stdout}{done.stderr} " if done.returncode else ""
    return " ".join(said.split())


def version_faults(
    pyproject: str, changelog: str, citation: str, others: dict[str, str]
) -> list[str]:
    """What is wrong with the version, in sentences. `others`: texts that must not repeat it."""
    version = tomllib.loads(pyproject)["project"]["version"]
    sections = re.split(r"^## \[(.*?)\].*$", changelog, flags=re.MULTILINE)
    titles, bodies = sections[1::2], sections[2::2]
    faults = [
        f"{name} repeats the version {version}" for name, text in others.items() if version in text
    ]
    if "Unreleased" in titles and bodies[titles.index("Unreleased")].strip():
        faults.append("CHANGELOG.md has entries under Unreleased: give them the version and a date")
    newest = next((title for title in titles if title != "Unreleased"), None)
    if newest != version:
        faults.append(
            f"the newest version in CHANGELOG.md is {newest}, in pyproject.toml {version}"
        )
    cited = re.findall(r"^(?:version|date-released): (\S+)$", citation, flags=re.MULTILINE)
    dated = re.findall(r"^## \[(\d.*?)\] \S (\S+)", changelog, flags=re.MULTILINE)
    if [tuple(cited)] != dated[:1]:
        faults.append(
            f"CITATION.cff has {' of '.join(cited) or 'no version'}: give it version and date of CHANGELOG.md"
        )
    return faults


def licence_faults(names: Iterable[str]) -> list[str]:
    """Packages of this environment whose metadata states no permissive licence, in sentences."""
    faults: list[str] = []
    for name in names:
        stated = metadata(name)
        entries = [
            *(stated.get_all("License-Expression") or ()),
            *(stated.get_all("License") or ()),
        ]
        entries += [
            entry for entry in stated.get_all("Classifier") or () if entry.startswith("License ::")
        ]
        licence = "; ".join(entry.splitlines()[0] for entry in entries)  # Some give the whole text.
        if "GPL" in licence or not any(word in licence for word in PERMISSIVE):
            faults.append(f"{name} is under {licence or 'no stated licence'}")
    return faults


def items(folder: Path) -> Iterator[tuple[str, str]]:
    """Each item of the checklist with what is wrong; empty when it is met."""
    texts = {
        name: (ROOT / name).read_text(encoding="utf-8")
        for name in (
            "pyproject.toml",
            "CHANGELOG.md",
            "CITATION.cff",
            "rotor/__init__.py",
            "explorer/__init__.py",
        )
    }
    project, changelog, citation = (
        texts.pop(name) for name in ("pyproject.toml", "CHANGELOG.md", "CITATION.cff")
    )
    faults = version_faults(project, changelog, citation, texts)
    yield "version in one place, changelog", "; ".join(faults)
    pins = re.findall(
        r"^([\w.-]+)==", (ROOT / "requirements.txt").read_text(encoding="utf-8"), flags=re.MULTILINE
    )
    yield f"licences of {len(pins)} pinned packages", "; ".join(licence_faults(pins))
    wheel = build(folder)
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        build(place)
        yield "metadata and contents, by twine and check-wheel-contents", package_faults(folder)
        yield (
            "two builds give the same bytes",
            "" if digests(place) == digests(folder) else "sdist or wheel differ",
        )
        for version in PYTHONS:
            interpreter = find_python(version)
            if interpreter is None:
                yield (
                    f"wheel alone on Python {version}",
                    "not tried: no such interpreter on this machine",
                )
                continue
            try:
                python = install(wheel, place / version, borrow=False, interpreter=interpreter)
                power, page = solve(python, place)["power_w"]["total"], fetch_page(python, place)
                example = run(python, "-c", first_example(), cwd=place).strip()
                found = study(python, place).splitlines()[0]
                shutil.rmtree(place / "small")
                used = f"{power / 1e3:.1f} kW; page of {len(page)} characters; {found}; first example: {example}"
                print(f"    {used}", flush=True)
                yield f"wheel alone on Python {version}: trim, page, study, first example", ""
            except (RuntimeError, subprocess.SubprocessError, OSError, ValueError) as error:
                yield f"wheel alone on Python {version}", str(error)
                continue
            shutil.rmtree(place / version)


def main() -> int:
    """Build into `--out` and go through the list; 1 if an item is not met."""
    parser = argparse.ArgumentParser(
        description="The checklist of a release: build, compare, install, use."
    )
    parser.add_argument(
        "--out", type=Path, default=ROOT / "dist", help="folder for sdist and wheel (default dist)"
    )
    folder = parser.parse_args().out.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for old in (*folder.glob("*.whl"), *folder.glob("*.tar.gz")):
        old.unlink()
    failed = 0
    for title, wrong in items(folder):
        failed += bool(wrong)
        print(f"{'OPEN' if wrong else 'met ':5}{title}{f': {wrong}' if wrong else ''}", flush=True)
    for made in sorted((*folder.glob("*.whl"), *folder.glob("*.tar.gz"))):
        print(f"{made.stat().st_size / 1e6:8.2f} MB  {made.name}")
    return int(failed > 0)


def _do(*command: str, cwd: Path) -> None:
    subprocess.run(command, cwd=cwd, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    raise SystemExit(main())

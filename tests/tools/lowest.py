"""The lowest versions that pyproject.toml states, tried: `make lowest`.

They are installed with the wheel into an environment of their own, where a trim and the page are used as `make
release` does. The trim has to agree with that of the versions here.
"""

import json
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from tests.tools.release import ROOT, build, fetch_page, solve


def lowest(pyproject: str) -> list[str]:
    """`name==version` of each direct dependency; ValueError for one without a lower bound."""
    pins: list[str] = []
    for wanted in tomllib.loads(pyproject)["project"]["dependencies"]:
        found = re.match(r"([\w-]+)[>=]=([\w.]+)", wanted)
        if found is None:
            raise ValueError(f"{wanted} states no lowest version")
        pins.append(f"{found[1]}=={found[2]}")
    return pins


def main() -> int:
    """1 if an environment of these versions cannot be installed or does not give the power of this one."""
    pins = lowest((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    print(*pins, flush=True)
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        wheel = build(place)
        subprocess.run([sys.executable, "-m", "venv", str(place / "venv")], check=True)
        python = place / "venv" / "bin" / "python"
        pip = (str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", "install")
        subprocess.run([*pip, "--only-binary", ":all:", *pins, str(wheel)], check=True, cwd=place)
        theirs, ours = (
            solve(python, place)["power_w"]["total"],
            solve(Path(sys.executable), place)["power_w"]["total"],
        )
        page = fetch_page(python, place)
    same = abs(theirs - ours) <= 1e-6 * ours
    print(json.dumps({"power_w": theirs, "here": ours, "page": len(page)}))
    return int(not same)


if __name__ == "__main__":
    raise SystemExit(main())

"""The built wheel works where there is no checkout."""

import json
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of a fresh environment that has the wheel, and of this one only the packages it depends on."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", str(folder)]
    subprocess.run([*build, "--quiet", str(ROOT)], check=True, cwd=folder)
    (wheel,) = folder.glob("*.whl")
    venv.create(folder / "venv", with_pip=True)
    python = folder / "venv" / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", wheel], check=True)
    # A path file inside the borrowed folder is not read again, so the editable checkout stays out of sight.
    own = subprocess.run([python, "-c", PURELIB], check=True, capture_output=True, text=True).stdout.strip()
    (Path(own) / "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    return python


PURELIB = "import sysconfig; print(sysconfig.get_path('purelib'))"


def run(python: Path, *arguments: str, cwd: Path) -> str:
    done = subprocess.run([python, *arguments], cwd=cwd, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def test_it_is_the_wheel_that_runs(installed: Path, tmp_path: Path):
    where = run(installed, "-c", "import rotor, explorer; print(rotor.__file__, explorer.__file__)", cwd=tmp_path)
    assert all("site-packages" in path and str(ROOT) not in path for path in where.split()), where


def test_the_data_files_are_all_there(installed: Path, tmp_path: Path):
    code = "import rotor.assets; print(rotor.assets.asset_path('uh60a.toml').parent)"
    shipped = Path(run(installed, "-c", code, cwd=tmp_path).strip())
    assert "site-packages" in shipped.parts

    def files(folder: Path) -> set[str]:
        return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}

    assert files(shipped) == files(ROOT / "assets")


def test_it_solves_from_an_empty_directory(installed: Path, tmp_path: Path):
    answer = json.loads(run(installed, "-m", "rotor", "solve", "--mu", "0.2", "--json", cwd=tmp_path))
    assert answer["status"] == "converged"
    assert answer["mu"] == pytest.approx(0.2)
    power = answer["power_w"]
    assert power["main_rotor"] == pytest.approx(power["induced"] + power["profile"] + power["parasite"])
    assert 0.4e6 < power["total"] < 2.0e6


def test_the_explorer_is_in_it(installed: Path, tmp_path: Path):
    assert "--port" in run(installed, "-m", "explorer", "--help", cwd=tmp_path)

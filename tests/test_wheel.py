"""The built wheel works where there is no checkout."""

from pathlib import Path

import pytest

from tests.tools import release

ROOT = Path(__file__).parent.parent

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of a fresh environment that has the wheel, and of this one only the packages it depends on."""
    folder = tmp_path_factory.mktemp("wheel")
    return release.install(release.build(folder), folder / "venv", borrow=True)


def test_it_is_the_wheel_that_runs(installed: Path, tmp_path: Path):
    code = "import rotor, explorer; print(rotor.__version__, rotor.__file__, explorer.__file__)"
    version, *where = release.run(installed, "-c", code, cwd=tmp_path).split()
    assert all("site-packages" in path and str(ROOT) not in path for path in where), where
    assert version in str(next(installed.parent.parent.parent.glob("*.whl")))


def test_the_data_files_are_all_there(installed: Path, tmp_path: Path):
    code = (
        "import rotor.support.assets; print(rotor.support.assets.asset_path('uh60a.toml').parent)"
    )
    shipped = Path(release.run(installed, "-c", code, cwd=tmp_path).strip())
    assert "site-packages" in shipped.parts

    def files(folder: Path) -> set[str]:
        return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}

    assert files(shipped) == files(ROOT / "assets")
    page = {
        path for path in files(ROOT / "explorer") if path.endswith((".js", ".css", ".html", ".md"))
    }
    assert len(page) > 30
    assert page <= files(shipped.parent.parent / "explorer")
    assert (shipped.parent / "py.typed").exists()


def test_it_solves_from_an_empty_directory(installed: Path, tmp_path: Path):
    answer = release.solve(installed, tmp_path)
    assert answer["status"] == "converged"
    assert answer["mu"] == pytest.approx(0.2)
    power = answer["power_w"]
    assert power["main_rotor"] == pytest.approx(
        power["induced"] + power["profile"] + power["parasite"]
    )
    assert 0.4e6 < power["total"] < 2.0e6


def test_its_two_commands_are_installed(installed: Path, tmp_path: Path):
    commands = {name: installed.parent / name for name in ("rotor", "rotor-explorer")}
    assert "UH-60A" in release.run(commands["rotor"], "solve", "--hover", cwd=tmp_path)
    assert release.run(commands["rotor-explorer"], "--version", cwd=tmp_path).startswith(
        "rotor-explorer "
    )


@pytest.mark.nightly  # The documentation runs them on each push, in the checkout.
@pytest.mark.parametrize(
    "notebook", sorted((ROOT / "docs" / "notebooks").glob("*.py")), ids=lambda path: path.stem
)
def test_it_runs_the_notebooks(notebook: Path, installed: Path, tmp_path: Path):
    """Figures included; the last cell starts the page, which ends with the script."""
    assert release.run(installed, str(notebook), cwd=tmp_path)


def test_a_second_build_gives_the_same_bytes(installed: Path, tmp_path: Path):
    first = release.digests(installed.parent.parent.parent)
    release.build(tmp_path)
    assert len(first) == 2
    assert release.digests(tmp_path) == first

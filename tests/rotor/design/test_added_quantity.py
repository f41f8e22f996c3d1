"""A quantity that does not exist yet: one row and its meaning, added to a copy of the sources, are found everywhere.

The checks are in `tests/added_quantity.py`, which runs in the copy. Whatever keeps a list of its own fails there.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
ROW = """
    Quantity(
        "warmer_k", "number", "air warmer than that of the standard atmosphere (default 0)",
        place="condition.warmer", what="warmer air", short="warmer", plain="standard air", below="colder", low=-40.0,
        high=40.0, default=0.0, examples=(10, 0, 20), unit="K", key="warmer_k", word="isa", section="fixed",
        input="warmer_k", slider=Slider("Warmer [K]", -30.0, 30.0, 0.5, 1.0, "/K"),
        aviation=Slider("Warmer [°F]", -54.0, 54.0, 1.0, 5.0 / 9.0, "/°F", "°F", 5.0 / 9.0),
        hint="Air warmer than that of the standard atmosphere. | section 2",
    ),
)  # fmt: skip

_BLADE = ("""
MEANING = {
    "rotor/design/quantities.py": {"\n)  # fmt: skip\n\n_BLADE = (": ROW},
    "rotor/design/aircraft.py": {
        "\n    rotor_speed_percent: float = 100.0\n": (
            "\n    warmer: float = 0.0\n    rotor_speed_percent: float = 100.0\n"
        ),
        "        return 1.0 - LAPSE_RATE * self.altitude / SEA_LEVEL_TEMPERATURE\n": (
            "        return 1.0 + (self.warmer - LAPSE_RATE * self.altitude) / SEA_LEVEL_TEMPERATURE\n"
        ),
    },
}
"""By file: what stands there, and what takes its place. Nothing else knows of the quantity."""


@pytest.mark.slow
def test_one_row_and_its_meaning_are_found_everywhere(tmp_path: Path):
    for name in ("explorer", "assets"):
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "rotor").mkdir()
    for path in (ROOT / "rotor").iterdir():  # Links, so that compiled kernels serve here too.
        if path.name == "design":
            shutil.copytree(path, tmp_path / "rotor" / path.name)
        else:
            (tmp_path / "rotor" / path.name).symlink_to(path)
    for name, changes in MEANING.items():
        text = (tmp_path / name).read_text(encoding="utf-8")
        for before, after in changes.items():
            assert text.count(before) == 1, f"{name} has changed: mend this test"
            text = text.replace(before, after)
        (tmp_path / name).write_text(text, encoding="utf-8")
    run = subprocess.run(
        [sys.executable, "-P", ROOT / "tests" / "added_quantity.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert run.stdout.endswith(f"found everywhere below {tmp_path}\n")

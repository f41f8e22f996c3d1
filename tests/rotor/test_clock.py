"""The wall clock may be set while the program runs: no interval is taken from it."""

import io
import re
import time
from pathlib import Path

import pytest

from rotor.support.progress import ProgressBar

ROOT = Path(__file__).parent.parent.parent
WALL = re.compile(
    r"\btime\.time(?:_ns)?\(|\bdatetime\.(?:now|utcnow|today)\(|\bDate\.now\(|new Date\("
)
STAMPS = {
    "rotor/study/chunks.py": 1,
    "explorer/export/contents.py": 1,
    "explorer/export/live.py": 1,
}
"""Files that write down a date."""


def test_no_interval_is_taken_from_the_wall_clock():
    found = dict[str, int]()
    for path in sorted([*(ROOT / "rotor").rglob("*"), *(ROOT / "explorer").rglob("*")]):
        if path.suffix in (".py", ".js", ".html") and (
            many := len(WALL.findall(path.read_text(encoding="utf-8")))
        ):
            found[path.relative_to(ROOT).as_posix()] = many
    assert found == STAMPS


@pytest.mark.parametrize("hours", [-1, 1])
def test_a_progress_bar_goes_on_when_the_clock_is_set(hours: int, monkeypatch: pytest.MonkeyPatch):
    """tqdm's own bar is drawn again only when the clock is where it was."""
    moved, real = [0.0], time.time
    monkeypatch.setattr("tqdm.std.time", lambda: real() + moved[0])
    shown = io.StringIO()
    with ProgressBar(total=4, file=shown, mininterval=0.0, miniters=1) as bar:
        bar.update()
        moved[0] = 3600.0 * hours
        bar.update(2)
    assert "3/4" in shown.getvalue()
    assert "1:00:0" not in shown.getvalue()

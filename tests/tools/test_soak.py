"""The soak: its figures and its verdict without a server; a short one with."""

import json
import subprocess
import sys

import numpy as np
import pytest

from tests.tools.soak import __main__ as command
from tests.tools.soak import wire
from tests.tools.soak.drag import Visit
from tests.tools.soak.run import grows, judge, memory, words
from tests.tools.soak.visitor import Visitor


def test_a_frame_that_is_none_is_a_sentence():
    with pytest.raises(ValueError, match="cannot be read"):
        wire.decode(b"\x01" * 40)


def test_a_visitor_reads_what_the_page_marks():
    visitor = Visitor()
    visitor.widgets = {
        "a": {"label": "Inner", "visible": False},
        "b": {"label": "Inner"},
        "c": {"content": '<div class="x" data-explorer="status" data-kind="converged">Trimmed</div>'},
        "d": {"content": '<b data-explorer="total-power">844 kW</b>'},
    }
    assert visitor.find("Inner") == "b"
    assert [visitor.text(part) for part in ("status", "total-power", "none")] == ["converged", "844 kW", ""]
    with pytest.raises(LookupError, match="No widget 'Outer'"):
        visitor.find("Outer")


def samples(slope: float, noise: float = 0.0, jump: float = 0.0) -> list[tuple[float, float]]:
    """Ten minutes of a server of 300 MB; `slope` in MB a minute."""
    times = np.arange(0.0, 600.0, 2.0)
    random = np.random.default_rng(1).standard_normal(len(times))
    values = 300.0 + slope * times / 60.0 + noise * random + jump * (times > 60.0)
    return list(zip(times.tolist(), values.tolist(), strict=True))


@pytest.mark.parametrize(
    ("slope", "noise", "jump", "leak"),
    [(0.0, 0.0, 0.0, False), (0.0, 3.0, 0.0, False), (0.2, 1.0, 0.0, False), (0.0, 1.0, 90.0, False),
     (2.0, 0.0, 0.0, True), (2.0, 5.0, 0.0, True), (1.2, 1.0, 0.0, True)],
)  # fmt: skip
def test_memory(slope: float, noise: float, jump: float, leak: bool):
    found = memory(samples(slope, noise, jump))
    assert found is not None
    assert grows(found) is leak
    assert found["slope_mb_per_minute"] == pytest.approx(slope, abs=0.3)


def test_verdict():
    visit, slow = (Visit(10, [delay] * 10, 2, [], 10, 1.0) for delay in (20.0, 40.0))
    report = judge([visit, slow], 20.0, 600.0, 60.0, samples(0.0))
    assert (report["passed"], report["memory_grows"]) == (True, False)
    assert report["cpu_percent"] == pytest.approx(10.0)
    assert report["cpu_ms_per_frame"] == pytest.approx(3000.0)
    assert (report["fastest_browser_p95"], report["slowest_browser_p95"]) == (20.0, 40.0)
    assert report["delays"] == {"count": 20, "p50": 30.0, "p95": 40.0, "worst": 40.0}
    assert words(report).endswith("passed")
    assert not judge([visit], 20.0, 600.0, 6.0, samples(3.0))["passed"]
    lost = judge([visit, Visit(lost=["browser 1: gone"])], 20.0, 60.0, 6.0, [])
    assert (lost["passed"], lost["memory"]) == (False, None)
    assert "LOST       browser 1: gone" in words(lost)


@pytest.mark.parametrize("wrong", [["--browsers", "0"], ["--browsers", "x"], ["--minutes", "-1"], ["--rate", "nan"]])
def test_bad_input_exits_2(wrong: list[str], capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit) as caught:
        command.main(wrong)
    assert caught.value.code == 2
    assert wrong[1] in capsys.readouterr().err


@pytest.mark.slow
def test_a_short_soak_loses_nothing():
    """As a user types it. Whether memory grows takes minutes to tell, so the exit code is not asked."""
    typed = [sys.executable, "-m", "tests.tools.soak", "--browsers", "4", "--minutes", "0.08", "--json"]
    ended = subprocess.run(typed, capture_output=True, text=True, timeout=400, check=False)
    assert ended.stdout, ended.stderr
    report = json.loads(ended.stdout)
    assert (report["lost"], report["complaints"]) == ([], [])
    assert report["rounds"] >= 4
    assert report["answered"] > 40

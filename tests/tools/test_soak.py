"""The soak: its wire, its figures and its verdict without a server; a short one with."""

import json
import subprocess
import sys

import msgspec.msgpack
import numpy as np
import pytest
import zstandard

from tests.tools.soak import __main__ as command
from tests.tools.soak import wire
from tests.tools.soak.figures import MemoryUse, Visit, delays, judge, memory, words
from tests.tools.soak.visitor import Visitor


def frame(messages: list[dict[str, object]], arrays: list[bytes]) -> bytes:
    """A frame as the server writes it."""
    body = msgspec.msgpack.encode({"messages": messages, "binaryBufferLengths": [len(one) for one in arrays]})
    packed = zstandard.ZstdCompressor().compress(body)
    whole = len(body).to_bytes(8, "little") + len(packed).to_bytes(8, "little") + packed
    for one in arrays:
        whole += b"\x00" * (-len(whole) % 8) + one
    return whole


class TestWire:
    def test_arrays_come_back_where_they_belong(self):
        first, second = b"abc", np.arange(5, dtype=np.float32).tobytes()
        nested = {"type": "x", "props": {"vertices": {"__binary_index": 1, "dtype": "<f4"}, "list": [1, "two"]}}
        plain = {"type": "y", "data": {"__binary_index": 0, "dtype": "|u1"}}
        found = wire.decode(frame([nested, plain], [first, second]))
        assert bytes(found[0]["props"]["vertices"]) == second
        assert found[0]["props"]["list"] == [1, "two"]
        assert bytes(found[1]["data"]) == first

    @pytest.mark.parametrize("junk", [b"", b"\x01" * 40])
    def test_a_frame_that_is_none_is_a_sentence(self, junk: bytes):
        with pytest.raises(ValueError, match="cannot be read"):
            wire.decode(junk)


class TestVisitor:
    def test_reads_what_the_page_marks(self):
        visitor = Visitor()
        visitor.widgets = {
            "a": {"label": "Inner", "visible": False},
            "b": {"label": "Inner"},
            "c": {"content": '<div class="x" data-explorer="status" data-kind="converged">Trimmed</div>'},
            "d": {"content": '<b data-explorer="total-power">844 kW</b>'},
        }
        assert visitor.find("Inner") == "b"
        assert (visitor.text("status"), visitor.text("total-power"), visitor.text("none")) == (
            "converged",
            "844 kW",
            "",
        )
        with pytest.raises(LookupError, match="No widget 'Outer'"):
            visitor.find("Outer")


class TestFigures:
    def samples(self, slope: float, noise: float = 0.0, jump: float = 0.0) -> list[tuple[float, float]]:
        """Ten minutes of a server of 300 MB; `slope` in MB a minute."""
        random = np.random.default_rng(1)
        times = np.arange(0.0, 600.0, 2.0)
        values = 300.0 + slope * times / 60.0 + noise * random.standard_normal(len(times)) + jump * (times > 60.0)
        return list(zip(times.tolist(), values.tolist(), strict=True))

    @pytest.mark.parametrize(
        ("slope", "noise", "jump"), [(0.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.2, 1.0, 0.0), (0.0, 1.0, 90.0)]
    )
    def test_flat(self, slope: float, noise: float, jump: float):
        found = memory(self.samples(slope, noise, jump))
        assert found is not None
        assert not found.grows

    @pytest.mark.parametrize(("slope", "noise"), [(2.0, 0.0), (2.0, 5.0), (1.2, 1.0)])
    def test_grows(self, slope: float, noise: float):
        found = memory(self.samples(slope, noise))
        assert found is not None
        assert found.grows
        assert found.slope_mb_per_minute == pytest.approx(slope, abs=0.3)

    def test_too_few_samples_are_no_verdict(self):
        assert memory([]) is None
        assert memory([(float(k), 300.0) for k in range(8)]) is None

    def test_percentiles(self):
        found = delays([float(k) for k in range(1, 101)])
        assert (found.count, found.p50, found.worst) == (100, 50.5, 100.0)
        assert found.p95 == pytest.approx(95.05)
        assert delays([]).count == 0

    def visit(self, **changes: object) -> Visit:
        plain = Visit(10, tuple([20.0] * 10), 2, (), 10, 1.0)
        return Visit(**{**vars(plain), **changes})

    def test_passes_and_reads_well(self):
        report = judge([self.visit(), self.visit(delays_ms=(40.0,) * 10)], 20.0, 600.0, 60.0, self.samples(0.0))
        assert report.passed
        assert report.cpu_percent == pytest.approx(10.0)
        assert report.cpu_ms_per_frame == pytest.approx(3000.0)
        assert (report.fastest_browser_p95, report.slowest_browser_p95) == (20.0, 40.0)
        assert words(report).endswith("passed")
        assert json.loads(json.dumps(report.as_json()))["memory_grows"] is False

    def test_one_lost_update_fails(self):
        report = judge([self.visit(lost=("browser 1: gone",))], 20.0, 60.0, 6.0, [])
        assert not report.passed
        assert "LOST" in words(report)

    def test_a_lost_key_of_a_real_browser_fails_too(self):
        report = judge([self.visit()], 20.0, 60.0, 6.0, [], [self.visit(lost=("page 1: no frame",))])
        assert not report.passed
        assert report.real is not None
        assert report.real.p50 == 20.0

    def test_growing_memory_fails(self):
        assert not judge([self.visit()], 20.0, 600.0, 6.0, self.samples(3.0)).passed
        assert MemoryUse(300.0, 330.0, 3.0, 2.0, 7.5).grows


class TestCommand:
    @pytest.mark.parametrize(
        "wrong", [["--browsers", "0"], ["--browsers", "x"], ["--minutes", "-1"], ["--rate", "nan"]]
    )
    def test_bad_input_exits_2(self, wrong: list[str], capsys: pytest.CaptureFixture[str]):
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

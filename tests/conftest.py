"""What every test shares: bounded, repeatable random inputs; a browser; and the rule that CI skips nothing."""

import gc
import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import hypothesis
import pytest
from chromium import LAUNCH_ARGUMENTS, find_chromium
from hypothesis.internal.conjecture import providers
from xdist.scheduler import LoadGroupScheduling

if TYPE_CHECKING:
    from playwright.sync_api import Browser

ROOT = Path(__file__).parent.parent
IN_CI = os.environ.get("CI", "").lower() in ("1", "true")

# The same examples every time and no clock: a test that fails here fails everywhere.
# CI looks at more of them (HYPOTHESIS_PROFILE=ci), each night at many; `wide` goes on, and differently every time.
hypothesis.settings.register_profile("repeatable", derandomize=True, deadline=None, max_examples=25)
hypothesis.settings.register_profile("ci", derandomize=True, deadline=None, max_examples=50)
hypothesis.settings.register_profile("thorough", derandomize=True, deadline=None, max_examples=200)
hypothesis.settings.register_profile("wide", deadline=None, max_examples=1000)
hypothesis.settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))
# It also tries the constants of our modules that happen to be loaded: others in a whole run than in one of a file.
providers._get_local_constants = providers.Constants  # pyright: ignore[reportPrivateImportUsage]


ONE_PROCESS = {
    "test_wheel": "wheel", "test_chapter_4": "searches", "test_lecture": "lecture",
    "test_chapter_3": "reports", "test_reproduce_command": "reports",
}  # fmt: skip
"""Files whose slow tests share what takes long to make, and its name: with `--dist loadgroup` one process makes it,
once."""


class _BySharing(LoadGroupScheduling):
    """Tests one by one, but those of `ONE_PROCESS` by what they share: pytest 9 ignores the groups of xdist 3.8."""

    def _split_scope(self, nodeid: str) -> str:
        return ONE_PROCESS.get(Path(nodeid.partition("::")[0]).stem, nodeid)


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadGroupScheduling | None:
    return _BySharing(config, log) if config.getvalue("dist") == "loadgroup" else None


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int | None:
    """One process for tests that are named: they are done before others would have started."""
    return 0 if config.args_source is config.ArgsSource.ARGS else None


def pytest_collection() -> None:
    """Modules and collected tests live to the end: the garbage collector need not visit them again and again."""
    gc.disable()


def pytest_collection_finish() -> None:
    gc.collect()
    gc.freeze()
    gc.enable()


@pytest.fixture(scope="session")
def artefacts() -> Path:
    """Where screenshots and other things to look at go; CI keeps the folder."""
    folder = ROOT / "artefacts"
    folder.mkdir(exist_ok=True)
    return folder


@pytest.fixture(scope="session")
def chromium_path() -> str:
    """Path of an installed Chromium; skips the test where there is none."""
    path = find_chromium()
    if path is None:
        pytest.skip("no Chromium found: `make browser` gets one, ROTOR_CHROMIUM names one")
    return path


@pytest.fixture(scope="session")
def browser(chromium_path: str) -> "Iterator[Browser]":
    """A headless Chromium driven by Playwright, with WebGL in software."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=chromium_path, args=list(LAUNCH_ARGUMENTS)
        )
        yield browser
        browser.close()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: "pytest.CallInfo[None]") -> Any:
    """In CI everything is installed, so a test that would be skipped has failed."""
    report = yield
    if IN_CI and report.skipped and not hasattr(report, "wasxfail"):
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
        report.outcome = "failed"
        report.longrepr = f"{item.nodeid} would be skipped, and CI skips nothing.\n{reason}"
    return report


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say loudly that the page was not tested."""
    skipped = [
        report for report in terminalreporter.getreports("skipped") if "browser" in report.keywords
    ]
    if skipped:
        terminalreporter.section("THE PAGE WAS NOT TESTED", sep="!", red=True, bold=True)
        terminalreporter.line(
            f"{len(skipped)} browser test(s) were skipped: {skipped[0].longrepr[2]}"
        )

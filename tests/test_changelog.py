"""The changelog: each release has a summary, what moved and what went, and is short."""

import re
from pathlib import Path

import pytest

CHANGELOG = (Path(__file__).parent.parent / "CHANGELOG.md").read_text(encoding="utf-8")
MOST_WORDS = 600


def sections() -> dict[str, str]:
    """The text of each release by its name, the newest first; `Unreleased` is the next one."""
    parts = re.split(r"^## \[(.+?)\].*$", CHANGELOG, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def words(text: str) -> int:
    """The number of words of a text; marks of tables and lists are none."""
    return len(re.findall(r"\S*\w\S*", text))


RELEASES = sections()
FIRST = [*RELEASES][-1]


def test_each_heading_is_a_release():
    assert CHANGELOG.count("\n## ") == len(RELEASES)
    assert next(iter(RELEASES)) == "Unreleased"
    assert FIRST == "0.1.0"


@pytest.mark.parametrize("release", RELEASES)
def test_a_release_is_short(release: str):
    assert words(RELEASES[release]) <= MOST_WORDS


@pytest.mark.parametrize("release", RELEASES)
def test_a_release_has_a_summary_and_says_what_moved(release: str):
    summary, *rest = re.split(r"^#+ (.+)$", RELEASES[release], flags=re.MULTILINE)
    headings = rest[::2]
    nothing_yet = release == "Unreleased" and words(RELEASES[release]) == 0
    if nothing_yet or release == FIRST:
        assert headings == []
    else:
        assert headings in (["What moved"], ["What moved", "What went"])
        assert words(summary) > 0
        for part in rest[1::2]:
            assert words(part) > 0

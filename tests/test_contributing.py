"""CONTRIBUTING: its commands, files and names exist, and the commits since it was tested keep to it."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
GUIDE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
TESTED_SINCE = "96e8c67e489ded0ee3d70ad1370a2345ce1a79af"
"""Subjects of earlier commits were not tested."""
LONGEST_SUBJECT = 72


def section(title: str) -> str:
    """The text under a heading of the second level."""
    return GUIDE.partition(f"\n## {title}\n")[2].partition("\n## ")[0]


def ways_to_add() -> dict[str, str]:
    """The paragraphs of *Adding* by what is added."""
    parts = re.split(r"^\*\*(An? .+?): (?=\d)", section("Adding"), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


WAYS = ways_to_add()


def test_each_make_target_exists():
    targets = re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
    named = re.findall(r"`make ([a-z-]+)", GUIDE)
    assert len(named) > 10
    assert set(named) <= set(targets)


def test_all_ways_to_add_are_found():
    assert len(WAYS) == 8


@pytest.mark.parametrize("way", WAYS)
def test_the_files_in_bold_are_as_many_as_stated(way: str):
    stated, _, text = WAYS[way].partition(" files.**")
    assert len(re.findall(r"\*\*\S+\*\*", text)) == int(stated)


@pytest.mark.parametrize("way", WAYS)
def test_each_name_is_in_a_file_that_the_way_links(way: str):
    links = [ROOT / link for link in re.findall(r"\]\(([^)#\s]+)\)", WAYS[way])]
    linked = "\n".join(path.read_text(encoding="utf-8") for path in links if path.is_file())
    names = re.findall(r"`([A-Za-z_]\w*)`", WAYS[way])
    assert [name for name in names if not re.search(rf"\b{name}\b", linked)] == []


def test_subjects_of_commits_are_short():
    command = ["git", "-c", "safe.directory=*", "log", "--no-merges", "--format=%s"]
    since = f"{TESTED_SINCE}..HEAD"
    try:
        found = subprocess.run(
            [*command, since], cwd=ROOT, capture_output=True, text=True, encoding="utf-8"
        )
    except OSError:
        pytest.skip("git is not installed")
    if found.returncode:
        pytest.skip("no git history back to the first commit that is tested")
    assert [line for line in found.stdout.splitlines() if len(line) > LONGEST_SUBJECT] == []

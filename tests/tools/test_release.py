"""What the release checklist says of version and changelog."""

from email.message import Message

import pytest

from tests.tools import release
from tests.tools.lowest import lowest
from tests.tools.release import licence_faults, version_faults

PROJECT = '[project]\nversion = "1.2.0"\n'
DONE, CITED = "## [1.2.0] – 2027-01-01\n", "version: 1.2.0\ndate-released: 2027-01-01\n"


def test_a_finished_changelog_has_no_faults():
    assert (
        version_faults(PROJECT, f"## [Unreleased]\n\n{DONE}- more\n", CITED, {"a": "1.1.0"}) == []
    )


def test_the_citation_has_the_version_of_the_last_release():
    files = ("pyproject.toml", "CHANGELOG.md", "CITATION.cff")
    project, changelog, citation = (
        (release.ROOT / name).read_text(encoding="utf-8") for name in files
    )
    assert not [
        fault for fault in version_faults(project, changelog, citation, {}) if "CITATION" in fault
    ]


@pytest.mark.parametrize(
    ("changelog", "cited", "others", "words"),
    [
        (f"## [Unreleased]\n- more\n\n{DONE}", CITED, {}, "under Unreleased"),
        (
            "## [1.1.0] – 2027-01-01\n",
            CITED.replace("1.2", "1.1"),
            {},
            "is 1.1.0, in pyproject.toml 1.2.0",
        ),
        ("# Changes\n", CITED, {}, "is None"),
        (DONE, CITED, {"rotor/__init__.py": "1.2.0"}, "rotor/__init__.py repeats"),
        (DONE, CITED.replace("2027", "2026"), {}, "has 1.2.0 of 2026-01-01: give"),
        (DONE, "title: a\n", {}, "has no version"),
    ],
)
def test_each_fault_is_one_sentence(changelog: str, cited: str, others: dict[str, str], words: str):
    assert any(words in fault for fault in version_faults(PROJECT, changelog, cited, others))


@pytest.mark.parametrize(
    ("entries", "faults"),
    [
        ({"License-Expression": "BSD-3-Clause AND 0BSD"}, []),
        ({"Classifier": "License :: OSI Approved :: MIT License"}, []),
        ({"License-Expression": "LGPL-3.0-only"}, ["some is under LGPL-3.0-only"]),
        ({"Classifier": "Topic :: Utilities"}, ["some is under no stated licence"]),
    ],
)
def test_a_licence_that_is_not_permissive_is_named(
    entries: dict[str, str], faults: list[str], monkeypatch: pytest.MonkeyPatch
):
    stated = Message()
    for name, value in entries.items():
        stated[name] = value
    monkeypatch.setattr(release, "metadata", lambda _: stated)
    assert licence_faults(["some"]) == faults


def test_the_lowest_versions_are_those_that_are_stated():
    project = '[project]\ndependencies = ["numpy>=2.1", "websockets>=16.1,<17", "viser==1.1.1"]\n'
    assert lowest(project) == ["numpy==2.1", "websockets==16.1", "viser==1.1.1"]
    with pytest.raises(ValueError, match="scipy states no lowest version"):
        lowest(project.replace("numpy>=2.1", "scipy"))

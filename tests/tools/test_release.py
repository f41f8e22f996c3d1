"""What the release checklist says of version, changelog and licences."""

import pytest

from tests.tools.lowest import lowest
from tests.tools.release import unfit, version_faults

PROJECT = '[project]\nversion = "1.2.0"\n'


def test_a_finished_changelog_has_no_faults():
    assert version_faults(PROJECT, "## [Unreleased]\n\n## [1.2.0] - 2027-01-01\n- more\n", {"a": "1.1.0"}) == []


@pytest.mark.parametrize(
    ("changelog", "others", "words"),
    [
        ("## [Unreleased]\n- more\n\n## [1.2.0]\n", {}, "under Unreleased"),
        ("## [1.1.0]\n", {}, "is 1.1.0, in pyproject.toml 1.2.0"),
        ("# Changes\n", {}, "is None"),
        ("## [1.2.0]\n", {"CITATION.cff": "version: 1.2.0"}, "CITATION.cff repeats"),
    ],
)
def test_each_fault_is_one_sentence(changelog: str, others: dict[str, str], words: str):
    (fault,) = version_faults(PROJECT, changelog, others)
    assert words in fault


def test_licences_that_bind_or_are_not_stated_are_found():
    rows = [
        ("a", "1", "MIT"),
        ("b", "1", ""),
        ("c", "1", "GNU General Public License v3 (GPLv3)"),
        ("d", "1", "GNU Lesser General Public License v3 (LGPLv3)"),
        ("e", "1", "GPL-3.0-only"),
        ("f", "1", "Apache-2.0 OR BSD-2-Clause"),
        ("g", "1", "AGPL-3.0-or-later"),
        ("h", "1", "BSD-3-Clause AND GPL-3.0-or-later WITH GCC-exception-3.1"),
    ]
    assert unfit(rows) == ["b", "c", "e", "g"]


def test_the_lowest_versions_are_those_that_are_stated():
    project = '[project]\ndependencies = ["numpy>=2.1", "websockets>=16.1,<17", "viser==1.1.1"]\n'
    assert lowest(project) == ["numpy==2.1", "websockets==16.1", "viser==1.1.1"]
    with pytest.raises(ValueError, match="scipy states no lowest version"):
        lowest(project.replace("numpy>=2.1", "scipy"))

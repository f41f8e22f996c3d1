"""Elastic blades in a study, each point begun from the trim of a neighbour."""

from pathlib import Path

from rotor.assets import package_version
from rotor.study.chunks import Store, StudyProvenance, evaluate_chunk
from rotor.study.results import read_results
from rotor.study.study_file import StudyFile, parse_study

STUDY = """
title = "Blades in hover and cruise"
chunk = 100
[axes]
mu = [0, 0.15, 0.3]
inboard_rate_deg = [-16, -8, 0]
outboard_rate_deg = [-16, -8]
division = [0.4, 0.6]
[fixed]
concept = "two-segment"
[models]
inflow = "pitt-peters"
elements = 16
azimuths = 48
"""


def test_every_point_trims_in_hover_too(tmp_path: Path):
    """The bracket of the collective in hover must not close while the elastic twist still moves."""
    provenance = StudyProvenance(package_version(), None, "0")
    store = Store(tmp_path / "blades", StudyFile(parse_study(STUDY), STUDY, "study.toml"), provenance)
    store.keep(0, evaluate_chunk(store.study, 0, provenance).content)
    store.close()
    results = read_results(tmp_path / "blades")
    assert len(results.columns["status"]) == 36
    assert set(map(str, results.columns["status"])) == {"converged"}

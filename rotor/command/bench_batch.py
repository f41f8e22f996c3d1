"""The studies of `bench`: trims a second and core, each by itself and as a study works them off."""

import time
from collections.abc import Callable
from typing import Any

from rotor.study.chunks import evaluate_points
from rotor.study.point import trim_of
from rotor.study.study_file import read_study
from rotor.trim.solve import solve

TARGET_PER_SECOND = 55.0
"""10⁵ trims with the dynamic wake on two cores in 15 minutes."""
_POINTS = 200


def measure_batch() -> dict[str, float]:
    """Trims a second of processor time, one core, by name; the middle of the packaged study of 10⁵ sampled trims."""
    study = read_study("hundred_thousand.toml").study
    first = study.chunks // 2 * study.chunk
    designs = [trim_of(values, study) for values in study.values(first, first + _POINTS)]
    return {
        "each by itself": _rate(lambda: [solve(design) for design in designs]),
        "as a study works them off": _rate(lambda: evaluate_points(study, first, first + _POINTS)),
    }


def _rate(call: Callable[[], Any]) -> float:
    begin = time.process_time()
    call()
    return _POINTS / (time.process_time() - begin)

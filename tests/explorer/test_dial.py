"""The dial of twist at n/rev: what the page foresees, what a drag does, and what was published."""

import json
import math
import shutil
import subprocess

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer import web
from explorer.tabs.actuator.dial import (
    DialTask,
    FrontTask,
    programme_table,
    programme_words,
    published,
    with_wave,
)
from rotor.actuator import programmes
from rotor.design.active_twist import Harmonic
from rotor.files.make_design import make_design
from rotor.optimisation.vibration import with_harmonics
from rotor.trim.adjoint import Adjoint
from rotor.trim.hub_loads import hub_index, hub_loads
from rotor.trim.solve import solve

WAVES = (Harmonic(2, math.radians(0.8), 4.0), Harmonic(3, math.radians(0.5), 0.8))


def foreseen(answer: dict[str, object], waves: tuple[Harmonic, ...]) -> tuple[float, float]:
    """Changes of power and index [%], by the formulas of `dial.js`, written again."""
    x = np.zeros(8)
    for one in waves:
        k, size = 2 * (one.per_rev - 2), math.degrees(one.amplitude)
        x[k], x[k + 1] = size * math.cos(one.phase), size * math.sin(one.phase)
    base, slopes, second, gains = (np.array(answer[name]) for name in ("base", "slopes", "second", "gains"))
    values = base + slopes @ x + 0.5 * np.einsum("kij,i,j->k", second, x, x)
    sizes = (gains * np.hypot(values[0:10:2], values[1:10:2])) ** 2
    index = math.sqrt(sizes[:3].sum()) + math.sqrt(sizes[3:].sum())
    power, at_rest = float(answer["power"]), float(answer["index"])  # pyright: ignore[reportArgumentType]
    return 100.0 * (values[10] / power - 1.0), 100.0 * (index / at_rest - 1.0)


@pytest.fixture(scope="module")
def answer() -> dict[str, object]:
    shaped = with_harmonics(make_design(twist="builtin", mu=0.3, bending=True), WAVES)
    found = DialTask(shaped).run(lambda _: None, lambda: False)
    assert isinstance(found, dict)
    return found


def test_what_is_foreseen_is_what_a_trim_gives(answer: dict[str, object]):
    design = make_design(twist="builtin", mu=0.3, bending=True)
    rest, moved = solve(design), solve(with_harmonics(design, WAVES))
    loads = [hub_loads(one, solve, band=False) for one in (rest, moved)]
    assert all(loads)
    power = 100.0 * (moved.power.total / rest.power.total - 1.0)
    indices = [one.index for one in loads if one is not None]
    index = 100.0 * (indices[1] / indices[0] - 1.0)
    seen = foreseen(answer, WAVES)
    assert_allclose(seen[0], power, atol=0.25)
    assert_allclose(seen[1], index, atol=8.0)
    assert_allclose(foreseen(answer, ()), 0.0, atol=1e-3)


def test_the_page_foresees_by_the_same_formula(answer: dict[str, object]):
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node to run the page's script")
    script = web.text("dial.js")
    begin, end = script.index("function foresee"), script.index("RX.foresee = foresee")
    x = np.zeros(8)
    for one in WAVES:
        k, size = 2 * (one.per_rev - 2), math.degrees(one.amplitude)
        x[k], x[k + 1] = size * math.cos(one.phase), size * math.sin(one.phase)
    program = f"{script[begin:end]};console.log(JSON.stringify(foresee({json.dumps(answer)},{x.tolist()})))"
    out = subprocess.run([node, "-e", program], capture_output=True, text=True, check=True).stdout
    assert_allclose(json.loads(out), foreseen(answer, WAVES), rtol=1e-9)


def test_the_front_is_that_of_its_trims():
    design = with_harmonics(make_design(twist="builtin", mu=0.3, bending=True), WAVES)
    dots = FrontTask(design).run(lambda _: None, lambda: False)
    assert isinstance(dots, tuple)
    assert [one.power for one in dots] == sorted(one.power for one in dots)
    assert [one.index for one in dots] == sorted((one.index for one in dots), reverse=True)
    rest, best = solve(with_harmonics(design, ())), solve(with_harmonics(design, dots[0].twist))
    assert_allclose(dots[0].power, 100.0 * (best.power.total / rest.power.total - 1.0), atol=0.02)
    change = 100.0 * (hub_index(Adjoint(best)) / hub_index(Adjoint(rest)) - 1.0)
    assert_allclose(dots[0].index, change, atol=0.2)


def test_blades_that_do_not_bend_have_a_sentence():
    found = DialTask(with_harmonics(make_design(mu=0.3), WAVES)).run(lambda _: None, lambda: False)
    assert isinstance(found, str)
    assert "bend" in found


def test_a_dot_moves_one_harmonic_alone():
    moved = with_wave(WAVES, 3, 1.0, 420.0)
    assert moved[0] == WAVES[0]
    assert moved[1] == Harmonic(3, math.radians(1.0), math.radians(60.0))
    assert with_wave(WAVES, 3, 0.01, 60.0) == WAVES[:1]
    assert [one.per_rev for one in with_wave(WAVES, 5, 0.4, 0.0)] == [2, 3, 5]


def test_every_published_programme_is_there_with_its_source():
    table = programme_table()
    for one in programmes():
        words = programme_words(one)
        assert one.source in words
        assert one.kind in words
        assert one.kind in table
    shown = published()
    assert len(shown) == sum(one.vibration_percent is not None for one in programmes())
    # Power and vibration are one point only where both belong to one input.
    assert sum(one["power"] is not None for one in shown) == 3
    assert {one["name"] for one in shown if one["power"] is not None} >= {"XH-59A 3/rev", "XH-59A 2+3/rev"}

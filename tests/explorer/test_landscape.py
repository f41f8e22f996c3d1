"""Power as a landscape: geometry of its surface, valley and paths, and what is said of them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from explorer.model.inputs import Inputs
from explorer.model.units import SI
from explorer.picture.landscape import HEIGHT, SIZE, Landscape, refined
from explorer.tabs.optimise.landscape_panel import design_at, half_widths, paths_on, valley_words
from explorer.tabs.optimise.map_panel import Map
from explorer.tabs.optimise.search_run import SearchRun
from explorer.workers.solver import MapTask, StartPower
from rotor.design.design import Design
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.objective import at_condition
from rotor.optimisation.results import Progress
from rotor.optimisation.search import Search
from rotor.processes import JobEnded, JobProgress
from tests.explorer.test_pictures import on_canvas

LEAST, CURVES = 1e6, (4e5, 1e5)
BAND = 0.001
PLACE = (0.4, 0.7)


def bowl(points: int = 201) -> Landscape:
    """Least power + a (x − x0)² + b (y − y0)², whose band is an ellipse with known half axes."""
    at = np.linspace(0.0, 1.0, points)
    powers = LEAST + CURVES[0] * (at[None, :] - PLACE[0]) ** 2 + CURVES[1] * (at[:, None] - PLACE[1]) ** 2
    return Landscape(powers, BAND)


def map_of(design: Design) -> Map:
    concept = find_concept("two-segment", [0.5])
    task = MapTask(design, concept, at_condition(design), (0, 1), (-0.2, -0.2))
    return Map(task, bowl(33).powers)


def test_the_surface_carries_the_powers():
    land = bowl(41)
    mesh, k = land.surface(), 41
    heights = mesh.vertices[:, 2].reshape(k, k)
    assert_allclose(heights.max(), HEIGHT)
    assert heights.min() == 0.0
    # Twice the excess is twice the height.
    half = LEAST + 0.5 * (land.powers.max() - LEAST)
    assert_allclose(land.height(half), 0.5 * HEIGHT)
    assert_allclose(mesh.vertices[:, :2].min(axis=0), -0.5 * SIZE)
    assert len(mesh.faces) == 2 * 40 * 40
    a, b, c = (mesh.vertices[mesh.faces[:, corner]] for corner in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0.0).all()  # Seen from above.


def test_designs_without_a_trim_leave_a_hole():
    powers = bowl(21).powers.copy()
    powers[3, 5] = np.nan
    land = Landscape(powers, BAND)
    mesh = land.surface()
    assert len(mesh.faces) == 2 * 20 * 20 - 6
    assert np.isfinite(mesh.vertices).all()
    assert len(land.contour(1.1 * LEAST, 0.0)) > 0
    assert np.isfinite(land.place(5 / 20, 3 / 20)).all()


def test_the_water_reaches_as_far_as_the_band():
    land = bowl()
    reach = [math.sqrt(BAND * LEAST / curve) for curve in CURVES]
    for (low, high), at, half in zip(land.valley(), PLACE, reach, strict=True):
        assert_allclose([low, high], [at - half, at + half], atol=0.006)
    shore = land.shore()[:, :, :2] / SIZE + 0.5
    ellipse = sum(((shore[..., k] - PLACE[k]) / reach[k]) ** 2 for k in range(2))
    assert_allclose(ellipse, 1.0, atol=0.02)
    assert_allclose(land.water().vertices[:, 2], land.height(LEAST * (1.0 + BAND)))


def test_the_flat_optimum_in_words():
    drawn = map_of(Inputs(advance_ratio=0.2).design())
    land = Landscape(refined(drawn.powers, 201, 201), BAND)
    spans = [p.shown(p.high) - p.shown(p.low) for p in drawn.parameters]
    halves = [math.sqrt(BAND * LEAST / curve) * span for curve, span in zip(CURVES, spans, strict=True)]
    assert_allclose([half for _, half in half_widths(drawn, land)], halves, atol=0.25)
    assert valley_words(drawn, land, SI) == f"±{max(halves):.0f}°/R for 1.0 kW: a flat optimum"
    narrow = Landscape(LEAST + 30.0 * (land.powers - LEAST), BAND)
    assert "flat" not in valley_words(drawn, narrow, SI)


def progress(start: int, x: float, y: float, power: float) -> JobProgress:
    return JobProgress(Progress("search", start, 2, 1, (x, y), "", power, True, (x, y), power, 0.1))


def test_a_place_on_the_map_is_a_design_of_the_concept():
    """Rates of the two pieces, by differences of the twist; the ends of the map are the ends of the parameters."""
    drawn = map_of(make_design(mu=0.2))
    for place in ((0.0, 1.0), (0.25, 0.5)):
        twist = design_at(drawn, place).twist
        inner, outer = (float(np.diff(twist([r, r + 0.1]))[0]) / 0.1 for r in (0.3, 0.8))
        wanted = [p.low + share * (p.high - p.low) for p, share in zip(drawn.parameters, place, strict=True)]
        assert_allclose([inner, outer], wanted, atol=1e-9)


def test_balls_roll_where_the_search_has_been():
    design = Inputs(advance_ratio=0.2).design()
    drawn = map_of(design)
    search = Search(design, drawn.task.concept, drawn.task.objective, starts=2)
    run = SearchRun(search)
    run.on_event(JobProgress(StartPower(9.6e5)))
    for news in (progress(0, -0.3, -0.1, 9e5), progress(0, -0.2, 0.0, 9.5e5), progress(0, -0.25, -0.2, 8.9e5)):
        run.on_event(news)
    assert paths_on(drawn, run) == ()  # It is under way.
    run.on_event(progress(1, 0.0, 0.0, 9.3e5))
    run.on_event(JobEnded(None, False, False))
    first, second = paths_on(drawn, run)
    assert (first.start, second.start) == (0, 1)
    assert first.powers == (9e5, 8.9e5)  # The worse design between is no step.
    p = drawn.parameters[0]
    assert_allclose(first.x, [(value - p.low) / (p.high - p.low) for value in (-0.3, -0.25)])
    other = replace(drawn, task=replace(drawn.task, design=Inputs(advance_ratio=0.25).design()))
    assert paths_on(other, run) == ()


def test_the_camera_sees_the_whole_map_and_the_blade():
    land = bowl(21)
    for aspect in (1.0, 1.6, 2.4):
        camera = land.camera(10.0, aspect)
        root, turn = land.blade_place(10.0)
        tip = root + 10.0 * np.array([math.cos(turn), math.sin(turn), 0.0])
        corners = [[x, y, 0.0] for x in (-0.5 * SIZE, 0.5 * SIZE) for y in (-0.5 * SIZE, 0.5 * SIZE)]
        across, up, _ = on_canvas(camera, aspect, np.array([*corners, root, tip]))
        assert max(np.abs(across).max(), np.abs(up).max()) < 1.0


def test_refined_maps_keep_the_powers_of_the_grid():
    coarse = bowl(9).powers
    fine = refined(coarse, 97, 97)
    assert_allclose(fine[::12, ::12], coarse)


@pytest.mark.parametrize("near", [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)])
def test_the_lowest_corner_faces_the_camera(near: tuple[float, float]):
    at = np.linspace(0.0, 1.0, 9)
    x, y = np.meshgrid(at, at)
    land = Landscape(LEAST * (1.1 - 0.02 * near[0] * x - 0.03 * near[1] * y), BAND)
    assert land.near == near
    place = land.camera(10.0, 1.6).position
    assert np.sign(place[0]) == near[0]
    assert np.sign(place[1]) == near[1]

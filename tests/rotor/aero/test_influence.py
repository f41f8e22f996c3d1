"""The downwash of lifting lines against the law of Biot and Savart written anew, closed forms, and Theodorsen."""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any, cast

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import kv

from rotor.aero import lifting_line as kernels
from rotor.aero.inflow.lifting_line import LiftingLineTerms
from rotor.aero.lifting_line import (
    LiftingLine,
    WakeCourse,
    at_points,
    build_wake,
    influence,
    lattice_lag,
    mean_influence,
    shed_correction,
    theodorsen,
)
from rotor.support.arrays import Array

sum_lines = cast(Any, vars(kernels)["_sum_lines"])
LINE = LiftingLine(blades=2, root=0.2, panels=6, azimuths=8)
COURSE = WakeCourse(0.2, 0.01, 0.02, coning=0.05, flap_1c=0.01, flap_1s=-0.02, core=(1e-4, 1e-5))
HOVER = replace(COURSE, mu_x=0.0, mu_z=0.0, flap_1c=0.0, flap_1s=0.0)
STEP = 2.0 * math.pi / LINE.azimuths
SINGLE = 4e-5
"""Of the largest: what sums in single precision lose, 1e-5 with the vectors of some processors."""
STRIPS = ((0, 3), (3, 6))
"""First panels of the strips, and the first ones beyond."""
LEAST, FAR, SHED, ROOT = 0.02, 0.03, 0.08, 0.08
"""Cores: the least, of shed lines, and of trailers inboard of 0.5 R; beyond 30°."""

Piece = tuple[Array, Array, float, float | None]
"""Begin, end, circulation and core; None for a core that depends on whose blade it is."""


def unit_line(target: Array, begin: Array, end: Array, core: float) -> Array:
    """4π v of a line with a core of Vatistas, n = 2."""
    a, b, length = target - begin, target - end, end - begin
    cross, far, near = np.cross(a, b), float(np.linalg.norm(a)), float(np.linalg.norm(b))
    size = math.sqrt(float(cross @ cross) ** 2 + core**4 * float(length @ length) ** 2)
    return cross * (far + near) * (1.0 - float(a @ b) / (far * near)) / size


def pieces(course: WakeCourse, circulation: Array, azimuth: int) -> Iterator[Piece]:
    """The bound line of the blade at an azimuth, first, and its wake, as the head of the module describes them."""
    psi, edges, panels = np.array([azimuth * STEP]), LINE.edges, range(LINE.panels)

    def node(age: float, edge: int) -> Array:
        return course.nodes(psi, np.array([age * STEP]), edges[edge : edge + 1])[0, 0, 0]

    def shed(age: float, panel: int) -> float:
        """Γ that left the panel at an age in steps, linear between steps; 0 off the blade."""
        if not 0 <= panel < LINE.panels:
            return 0.0
        young, share = math.floor(age), age - math.floor(age)
        at = [circulation[panel, (azimuth - young - k) % LINE.azimuths] for k in (0, 1)]
        return float((1.0 - share) * at[0] + share * at[1])

    def strip(age: float, k: int) -> float:
        """The mean of the panels of a strip, weighted with r Δr; 0 beyond the outermost."""
        if not 0 <= k < len(STRIPS):
            return 0.0
        inside = range(*STRIPS[k])
        weight = [LINE.r[i] * (edges[i + 1] - edges[i]) for i in inside]
        return sum(w * shed(age, i) for w, i in zip(weight, inside, strict=True)) / sum(weight)

    for i in panels:
        yield node(0, i), node(0, i + 1), shed(0, i), LEAST
    for k in range(4):  # One step of 45° is the near wake, in four pieces.
        middle = (k + 0.5) / 4.0
        for e in range(LINE.panels + 1):
            yield (
                node(k / 4.0, e),
                node((k + 1) / 4.0, e),
                shed(middle, e - 1) - shed(middle, e),
                None,
            )
        for i in panels:
            if k:
                yield (
                    node(k / 4.0, i),
                    node(k / 4.0, i + 1),
                    shed(middle, i) - shed(middle - 0.25, i),
                    LEAST,
                )
            else:
                half = [0.5 * (node(0, e) + node(0.25, e)) for e in (i, i + 1)]
                yield half[0], half[1], shed(middle, i) - shed(0, i), None
    for i in panels:
        yield node(1, i), node(1, i + 1), -shed(0.875, i), SHED

    borders, turns = (0, 3, 6), 2 * LINE.azimuths

    def core(e: int, age: float) -> float:
        return max(
            math.sqrt(course.core[0] + course.core[1] * age * STEP), ROOT if edges[e] < 0.5 else FAR
        )

    def mean(age: int, k: int) -> float:
        return 0.5 * (strip(age, k) + strip(age + 1, k))

    for age in range(1, turns):
        for s, e in enumerate(borders):
            yield (
                node(age, e),
                node(age + 1, e),
                mean(age, s - 1) - mean(age, s),
                core(e, age + 0.5),
            )
        for s, (low, high) in enumerate(STRIPS):
            yield (
                node(age, low),
                node(age, high),
                mean(age, s) - (mean(age - 1, s) if age > 1 else 0.0),
                SHED,
            )
    steady = [
        sum(strip(k, s) for k in range(LINE.azimuths)) / LINE.azimuths for s in range(len(STRIPS))
    ] + [0.0]
    begin, end = turns * STEP, 8.0 / math.hypot(course.mu_x, course.mu_z + course.lambda0)
    ages = np.append(np.arange(begin, end - 1e-9, math.pi / 6.0), end) / STEP
    for young, old in pairwise(ages.tolist()):
        for s, e in enumerate(borders):
            inner = steady[s - 1] if s else 0.0
            yield node(young, e), node(old, e), inner - steady[s], core(e, turns - 0.5)


def downwash(
    course: WakeCourse, circulation: Array, first: int, target: Array, up: Array, own: float | None
) -> float:
    """At a target on the blade at azimuth `first`, with the core `own` of its own young lines; None: off all blades."""
    total = np.zeros(3)
    for azimuth in (first, first + LINE.azimuths // 2):
        mine = own is not None and azimuth == first
        for k, (a, b, strength, core) in enumerate(pieces(course, circulation, azimuth)):
            if mine and k < LINE.panels:
                continue  # Its own bound line.
            about = core if core is not None else own if mine and own is not None else LEAST
            total += strength * unit_line(target, a, b, about)
    return -float(total @ up) / (4.0 * math.pi)


def own_core(r: float, mu: float) -> float:
    """0.05 from µ + 0.05 inward, none from µ + 0.45 outward, a cubic between."""
    y = min(max((r - mu - 0.05) / 0.40, 0.0), 1.0)
    return 0.05 * (1.0 - y * y * (3.0 - 2.0 * y))


def test_on_the_blades_as_a_plain_sum():
    circulation = np.random.default_rng(1).uniform(0.002, 0.006, (LINE.panels, LINE.azimuths))
    ours = (influence(LINE, COURSE) @ circulation.ravel()).reshape(circulation.shape)
    for azimuth in (0, 3, 6):
        psi = azimuth * STEP
        beta = COURSE.coning + COURSE.flap_1c * math.cos(psi) + COURSE.flap_1s * math.sin(psi)
        up = np.array([-beta * math.cos(psi), -beta * math.sin(psi), 1.0])
        found = [
            downwash(
                COURSE,
                circulation,
                azimuth,
                np.array([r * math.cos(psi), r * math.sin(psi), beta * r]),
                up,
                own,
            )
            for r, own in ((float(r), own_core(float(r), COURSE.mu_x)) for r in LINE.r)
        ]
        assert_allclose(ours[:, azimuth], found, rtol=0, atol=SINGLE * float(np.abs(found).max()))


def test_at_fixed_points_as_a_plain_sum():
    circulation = np.random.default_rng(2).uniform(0.002, 0.006, (LINE.panels, LINE.azimuths))
    points = np.array([[0.5, 0.3, 0.12], [-0.4, 0.7, -0.05], [1.4, -0.2, 0.0]])
    normals = np.array([[0.0, 0.0, 1.0], [0.1, 0.0, 0.9], [1.0, 0.0, 0.0]])
    ours = at_points(LINE, COURSE, points, normals) @ circulation.ravel()
    assert ours.shape == (4, 3)
    for position in (0, 3):
        found = [
            downwash(COURSE, circulation, position, at, up, None)
            for at, up in zip(points, normals, strict=True)
        ]
        assert_allclose(ours[position], found, rtol=0, atol=SINGLE * float(np.abs(found).max()))


@pytest.mark.parametrize(
    ("begin", "share"), [(-50.0, 1.0), (0.0, 0.5)], ids=["infinite", "semi-infinite"]
)
@pytest.mark.parametrize("core", [0.0, 0.1])
def test_a_straight_line_is_that_of_the_textbook(begin: float, share: float, core: float):
    """v = d/(2π √(d⁴ + c⁴)) by an infinite line of circulation 1 at a distance d, half of it by a semi-infinite."""
    distance = np.array([0.05, 0.1, 0.3])
    targets = np.zeros((6, 3), np.float32)
    targets[1], targets[5] = -distance, 1.0  # Behind a line from root to tip the air goes down.
    nodes, ends = np.array([[begin, 0.0, 0.0], [50.0, 0.0, 0.0]], np.float32), np.array([[0, 1]])
    out, none = np.zeros((1, 1, 3), np.float32), np.zeros(3, np.float32)
    places, shares = np.zeros((1, 3), np.int64), np.array([[1.0, 0.0]], np.float32)
    sum_lines(targets, nodes, ends, np.array([core**4], np.float32), none, places, shares, 0, out)
    assert_allclose(
        out[0, 0] / (4.0 * math.pi),
        share * distance / (2.0 * math.pi * np.hypot(distance**2, core**2)),
        rtol=1e-3,
    )


def test_the_lines_have_the_same_sum_in_any_order():
    """What a line takes over from the one before is the distance from where both meet."""
    wake, rng = build_wake(LINE, COURSE, np.zeros(1)), np.random.default_rng(3)
    targets, young = (
        rng.uniform(-1.0, 1.0, (6, 37)).astype(np.float32),
        np.full(37, 1e-6, np.float32),
    )
    sums = np.zeros((2, wake.rows[-1], LINE.azimuths, 37), np.float32)
    for out, order in zip(
        sums, (np.arange(len(wake.ends)), rng.permutation(len(wake.ends))), strict=True
    ):
        core, places, shares = (each[order] for each in (wake.core, wake.places, wake.shares))
        sum_lines(targets, wake.nodes[0], wake.ends[order], core, young, places, shares, 3, out)
    assert_allclose(sums[0], sums[1], rtol=0, atol=SINGLE * float(np.abs(sums).max()))


@pytest.mark.parametrize("steps", [1, 2, 3])
def test_what_ends_the_near_wake_and_begins_the_strips_cancels(steps: int):
    """A circulation that rests sheds nothing. Seen from above that line, so near that its core decides."""
    line, age = replace(LINE, near=steps * STEP), steps * STEP
    # In hover both lines are straight.
    wake = build_wake(line, replace(HOVER, coning=0.0), np.zeros(1))
    row, (panels, bound, strips, last) = wake.places[:, 0], np.take(wake.rows, [1, 2, 4, 5])
    shed = np.flatnonzero(((panels <= row) & (row < bound)) | ((strips <= row) & (row < last)))
    target = np.array([0.7 * math.cos(age), -0.7 * math.sin(age), 0.01 - HOVER.lambda0 * age])
    found = np.zeros((len(shed), 3))
    for each, k in zip(found, shed.tolist(), strict=True):
        begin, end = wake.nodes[0, wake.ends[k]].astype(np.float64)
        each[:] = wake.shares[k].sum() * unit_line(
            target, begin, end, max(float(wake.core[k]), 0.0) ** 0.25
        )
    assert np.linalg.norm(found.sum(axis=0)) < 1e-4 * np.linalg.norm(found, axis=1).max()


@pytest.mark.parametrize("mu", [1e-300, 1e-5, 1e-3])
def test_a_wake_that_nothing_carries_away_ends_all_the_same(mu: float):
    """Without thrust near hover its end was 8 R / V turns away, and took all memory."""
    course = replace(HOVER, mu_x=mu, mu_z=0.0, lambda0=0.0)
    line = LiftingLine(2, 0.2, 4, 8)
    wake = build_wake(line, course, np.zeros(1))
    assert len(wake.ends) < 20_000
    assert np.isfinite(influence(line, course)).all()


def test_many_blades_in_hover_approach_momentum_theory():
    """Uniform load of 12 blades, Γ = 2π C_T/N_b: λ = √(C_T/2) by a semi-infinite vortex cylinder, away from its edges.

    The end of the wake at 8 R takes 0.7 %, steps of 30° beyond two turns 1 %: with 10° and 30 R it is 1.000.
    """
    line, thrust = LiftingLine(blades=12, root=0.15, panels=24, azimuths=24), 0.006
    course = replace(HOVER, coning=0.0, lambda0=math.sqrt(0.5 * thrust))
    inflow = mean_influence(line, course) @ np.full(
        line.panels, 2.0 * math.pi * thrust / line.blades
    )
    middle = (line.r > 0.4) & (line.r < 0.8)
    assert_allclose(inflow[middle], course.lambda0, rtol=0.02)


@pytest.mark.parametrize("change", [0.1, -0.1])
def test_uneven_loads_in_hover_meet_the_inflow_of_their_annuli(change: float):
    """λ² = N_bΓ/4π of momentum theory where Γ changes along the blade: the change of λ to 5 %, twice that without D."""
    line, thrust = LiftingLine(blades=12, root=0.15, panels=24, azimuths=24), 0.006
    course = replace(HOVER, coning=0.0, lambda0=math.sqrt(0.5 * thrust))
    terms = LiftingLineTerms(line, course)
    nodes = terms.nodes(1e-8, thrust)
    (mean,) = terms.shapes().values()

    def inflow(uneven: Array) -> Array:
        """λ_i by N_bΓ/π = 2 C_T × a load along the blade."""
        return (
            mean
            + nodes.field(np.repeat(2.0 * thrust * uneven, line.azimuths)).reshape(24, 24)[:, 0]
        )

    middle = (line.r > 0.4) & (line.r < 0.8)
    load = 1.0 + change * np.cos(math.pi * line.r)
    annuli = course.lambda0 * (np.sqrt(load) - 1.0)
    found = inflow(load) - inflow(np.ones_like(load))
    assert_allclose(inflow(np.ones_like(load))[middle], course.lambda0, rtol=0.02)
    assert_allclose(found[middle], annuli[middle], atol=0.05 * np.abs(annuli).max())


def test_the_mirrored_wake_is_that_of_negative_thrust():
    """Above the disk as far as below it, and with the same influence, at low speed too."""
    below = replace(COURSE, mu_x=0.05, lambda0=0.03)
    above = replace(
        below, mu_z=-below.mu_z, lambda0=-0.03, coning=-below.coning, flap_1c=-0.01, flap_1s=0.02
    )
    assert 0.0 < below.skewed < 1.0
    mirrored = np.abs(influence(LINE, above) - influence(LINE, below))
    assert mirrored.max() < 1e-5 * np.abs(influence(LINE, below)).max()


def test_in_hover_every_azimuth_sees_the_same():
    matrix = influence(LINE, HOVER).reshape(6, 8, 6, 8)
    assert_allclose(
        matrix,
        np.roll(matrix, (1, 1), axis=(1, 3)),
        rtol=0,
        atol=2e-4 * float(np.abs(matrix).max()),
    )
    mean = influence(LINE, HOVER).reshape(6, 8, 6, 8)[:, 0].sum(axis=2)
    assert_allclose(
        mean_influence(LINE, HOVER), mean, rtol=0, atol=2e-4 * float(np.abs(mean).max())
    )


FINE = LiftingLine(4, 0.15, 24, 24)
FAST = WakeCourse(0.3, 0.02, 0.01, coning=0.0, flap_1c=0.0, flap_1s=0.0, core=(1e-4, 0.0))
SLOW = replace(FAST, mu_x=0.05, lambda0=0.05)
HALF_CHORD = 0.0322
"""Half chord of a UH-60A, over R."""
PANEL = 16


def deficiency(k: float) -> complex:
    """C(k) by modified Bessel functions: another way than the code's."""
    one, zero = kv([1.0, 0.0], np.full(2, 1j * k))
    return complex(one / (one + zero))


def of_downwash(downwash: complex) -> complex:
    """Lift over its quasi-steady value: L = 2πρUb (Uα − w) with w = downwash · L/ρU."""
    return 1.0 / (1.0 + 2.0 * math.pi * HALF_CHORD * downwash)


@pytest.mark.parametrize(
    ("k", "published"), [(0.05, 0.909 - 0.130j), (0.1, 0.832 - 0.172j), (0.2, 0.728 - 0.189j)]
)
def test_theodorsens_function(k: float, published: complex):
    """NACA Report 496, table 4: F and −G."""
    assert abs(theodorsen(np.array([k]))[0] - published) < 1e-3
    assert theodorsen(np.array([k]))[0] == pytest.approx(deficiency(k), abs=1e-12)


@pytest.mark.parametrize("n", [1, 2, 3, 5])
@pytest.mark.parametrize("course", [FAST, SLOW], ids=["fast", "slow"])
def test_with_what_is_added_it_has_theodorsens_within_a_hundredth(n: int, course: WakeCourse):
    """k from 0.036 to 0.18 at 0.9 R: what the issue asks for is 3 %. Also at µ 0.05, where D is 1.5."""
    g = np.exp(1j * n * FINE.psi)
    added = (shed_correction(FINE, course, np.full(24, HALF_CHORD))[PANEL] @ g / g).mean()
    own = lattice_lag(FINE, course, np.array([n]))[PANEL, 0] / course.mass_flow
    whole = deficiency(n * HALF_CHORD / FINE.r[PANEL])
    assert abs(of_downwash(own + added) / whole - 1.0) < 0.01


def test_nothing_is_added_to_a_circulation_that_rests_nor_inboard():
    added = shed_correction(FINE, FAST, np.full(24, HALF_CHORD))
    assert np.abs(added.sum(axis=2)).max() < 1e-12
    assert np.abs(added[FINE.r < FAST.mu_x + 0.05]).max(initial=0.0) == 0.0


# Where the wake of a blade lies: on the blade when young, and along the velocities of the formula


SKEWED = WakeCourse(0.25, 0.02, 0.015, coning=0.06, flap_1c=0.02, flap_1s=-0.03, core=(1e-4, 1e-5))


def track(course: WakeCourse, released: float, r: float, t: float) -> Array:
    """Where what left the blade at an azimuth and radius is at a time after."""
    return course.nodes(np.array([released + t]), np.array([t]), np.array([r]))[0, 0, 0]


def test_what_has_just_left_lies_on_the_blade():
    psi, r = np.array([0.3, 2.0, 5.0]), np.array([0.2, 0.7, 1.0])
    beta = 0.06 + 0.02 * np.cos(psi) - 0.03 * np.sin(psi)
    found = SKEWED.nodes(psi, np.zeros(1), r)[:, 0]
    expected = np.stack(
        [np.outer(np.cos(psi), r), np.outer(np.sin(psi), r), np.outer(beta, r)], axis=-1
    )
    assert_allclose(found, expected, atol=1e-15)


def test_without_flight_it_sinks_as_the_helix_of_momentum_theory():
    course = replace(SKEWED, mu_x=0.0, mu_z=0.0)
    for t in (0.1, 3.0, 20.0):
        begin, now = track(course, 1.0, 0.8, 0.0), track(course, 1.0, 0.8, t)
        assert_allclose(now - begin, [0.0, 0.0, -course.lambda0 * t], atol=1e-14)


@pytest.mark.parametrize("path", [0.0, 0.25, 1.0])
@pytest.mark.parametrize(("released", "r"), [(math.pi, 0.9), (2.5, 0.6), (4.0, 1.0)])
def test_it_follows_the_inflow_inside_the_disk_and_behind_it(
    released: float, r: float, path: float
):
    """Differences of z along the track against the inflow written out, and that of Beddoes, with tan χ by hand."""
    course, step = replace(SKEWED, beddoes=path), 1e-5
    chi = math.acos((course.mu_z + course.lambda0) / course.speed)
    ours, theirs, y = (1.0 - math.cos(chi)) / math.sin(chi), 0.5 * chi, r * math.sin(released)
    leaves = (math.sqrt(1.0 - y * y) - r * math.cos(released)) / course.mu_x
    assert course.skewed == 1.0
    for t in (0.2 * leaves, 0.7 * leaves, 1.2 * leaves, 2.0 * leaves):
        before, after = track(course, released, r, t - step), track(course, released, r, t + step)
        x, outward = r * math.cos(released) + course.mu_x * t, abs(y) ** 3
        inside = 1.0 + ours * (0.169765272631355 + 3.0 * x - outward), 1.0 + theirs * (x - outward)
        behind = 2.0 + 2.0 * ours * (0.169765272631355 - outward), 2.0 - 2.0 * theirs * outward
        new, old = inside if t < leaves else behind
        velocity = [course.mu_x, 0.0, -course.mu_z - course.lambda0 * (new + path * (old - new))]
        assert_allclose((after - before) / (2.0 * step), velocity, atol=1e-8)


@pytest.mark.parametrize(
    "course", [SKEWED, replace(SKEWED, mu_z=-0.05), replace(SKEWED, lambda0=-0.015)]
)
def test_its_mean_inflow_over_the_disk_is_that_of_momentum_theory(course: WakeCourse):
    """To rounding: the mean over the disk of what vortices sink from its front edge to its rear, y = sin φ."""
    level, (nodes, weights) = (
        replace(course, coning=0.0, flap_1c=0.0, flap_1s=0.0),
        np.polynomial.legendre.leggauss(24),
    )
    flux = 0.0
    for phi, weight in zip(0.25 * math.pi * (nodes + 1.0), 0.25 * math.pi * weights, strict=True):
        across = 2.0 * math.cos(phi) / course.mu_x
        sunk = -track(level, math.pi - phi, 1.0, across)[2] - course.mu_z * across
        flux += 2.0 * weight * math.cos(phi) * course.mu_x * sunk
    assert flux / math.pi == pytest.approx(course.lambda0, rel=1e-13)


def test_the_helix_of_hover_passes_over_to_the_skewed_wake_smoothly():
    """Nothing jumps, and nothing turns: the share of the skewed wake grows from 0 to 1 at µ_x = 2.5 √(C_T/2).

    Where a vortex lies, and how that changes with µ, is as smooth beyond.
    """
    thrust = 0.006
    mu = np.linspace(0.0, 0.3, 601)
    share: list[float] = []
    sunk: list[float] = []
    for one in mu:
        inflow = math.sqrt(0.5 * thrust)
        for _ in range(100):  # λ0 = C_T/2V
            inflow = 0.5 * (inflow + 0.5 * thrust / math.hypot(one, inflow))
        course = replace(SKEWED, mu_x=float(one), mu_z=0.0, lambda0=inflow)
        share.append(course.skewed)
        sunk.append(track(course, 2.0, 0.6, 1.5)[2] / inflow)
    slope = np.diff(share)
    assert share[0] == 0.0
    assert np.all(slope >= 0.0)
    assert slope.max() < 0.02
    assert_allclose(mu[share.index(1.0)], 2.5 * math.sqrt(0.5 * thrust), atol=1e-3)
    assert np.abs(np.diff(sunk)).max() < 0.02
    assert np.abs(np.diff(sunk, 2)).max() < 5e-4

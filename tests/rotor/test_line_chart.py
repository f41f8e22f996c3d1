"""Line charts: values stand where the axes say, over azimuth and on logarithmic axes too."""

import math
import re
from itertools import pairwise
from xml.etree import ElementTree

import pytest
from numpy.testing import assert_allclose

from rotor.line_chart import AZIMUTH, LineChart, Series, draw, draw_small, round_ticks, tick_text

SVG = "{http://www.w3.org/2000/svg}"


def parts(chart: LineChart) -> tuple[list[tuple[float, float]], dict[str, tuple[float, float]]]:
    """Places of the marks, where no series is in the key, and of the words."""
    tree = ElementTree.fromstring(draw(chart))
    dots = [(float(one.attrib["cx"]), float(one.attrib["cy"])) for one in tree.iter(f"{SVG}circle")]
    words = {
        "".join(one.itertext()): (float(one.attrib["x"]), float(one.attrib["y"])) for one in tree.iter(f"{SVG}text")
    }
    return dots, words


def test_points_over_azimuth_stand_at_the_ticks():
    measured = Series("", AZIMUTH, (0.0, 1.0, 0.0, -1.0, 0.0))
    line = Series("", AZIMUTH, (0.1, 0.9, math.nan, -0.9, 0.1), "line", 1)
    chart = LineChart("c_l", "azimuth [°]", "C_l", (measured, line), x_ticks=AZIMUTH)
    dots, words = parts(chart)
    for psi, (x, _) in list(zip(AZIMUTH, dots, strict=True))[1:]:  # The y axis has a 0 too.
        assert_allclose(x, words[f"{psi:g}"][0], atol=0.1)
    assert_allclose(dots[1][1], words["1"][1] - 4.0, atol=0.1)
    assert_allclose(dots[3][1], words["−1"][1] - 4.0, atol=0.1)
    small = ElementTree.fromstring(draw_small(chart))
    assert len(list(small.iter(f"{SVG}circle"))) == 5
    assert not list(small.iter(f"{SVG}text"))
    path = max(re.findall(r'<path d="(M[^"VH]*)"', draw(chart)), key=len)
    assert (path.count("M"), path.count("L")) == (2, 2)  # Broken where a value is missing.


def test_decades_are_as_long_as_each_other():
    x = (1e-16, 1e-12, 1e-8, 1e-4)
    series = Series("", x, (0.0, 1.0, 2.0, 3.0))
    dots, words = parts(LineChart("", "error", "", (series,), log="x", names=("a", "b", "c", "d")))
    steps = [b[0] - a[0] for a, b in pairwise(dots)]
    assert_allclose(steps, steps[0], atol=0.2)
    assert_allclose([words[name][1] - 4.0 for name in "abcd"], [y for _, y in dots], atol=0.1)
    assert_allclose(words["10⁻¹²"][0], dots[1][0], atol=0.1)


def test_an_error_bar_is_as_long_as_the_scatter():
    series = Series("", (0.0, 1.0), (0.0, 10.0), "points", 0, (2.0, 2.0))
    dots, _ = parts(LineChart("", "x", "y", (series,)))
    scale = (dots[0][1] - dots[1][1]) / 10.0
    (bars,) = re.findall(r'<path d="((?:M[\d.]+,[\d.]+V[\d.]+){2})" stroke', draw(LineChart("", "x", "y", (series,))))
    for start, end in re.findall(r",([\d.]+)V([\d.]+)", bars):
        assert_allclose(float(start) - float(end), 4.0 * scale, atol=0.2)


def test_a_line_is_cut_off_at_given_ends_of_the_axes():
    line = Series("<one>", (0.0, 0.5, 1.0), (0.0, 1e9, 1.0), "line", "#123456")
    drawn = draw(LineChart("A <title>", "x", "y", (line,), x_range=(0.0, 1.0), y_range=(0.0, 4.0)), inline=True)
    tree = ElementTree.fromstring(drawn)
    (window,) = tree.findall("svg")
    (path,) = [one for one in window.iter("path") if one.get("stroke") == "#123456"]
    assert max(abs(float(number)) for number in re.findall(r"-?\d+\.\d", path.attrib["d"])) < 1000.0
    left, top, wide, high = map(float, window.attrib["viewBox"].split())
    assert (left, wide) == (float(window.attrib["x"]), float(window.attrib["width"]))
    assert high < 320.0 < top + 2.0 * high
    assert "<style>" not in drawn  # It would reach the page's other drawings.


def test_every_shape_says_its_fill_and_stroke():
    """No style sheet is needed: a path without fill is drawn black."""
    series = [Series(mark, (0.0, 1.0), (0.0, 1.0), mark) for mark in ("points", "crosses", "line", "dashed", "both")]
    tree = ElementTree.fromstring(draw(LineChart("", "x", "y", tuple(series))))
    for path in tree.iter(f"{SVG}path"):
        assert path.get("stroke")
        assert (
            path.get("fill") == "none" or not re.search("[VLHl].*[VLHl]", path.attrib["d"]) or "M" in path.attrib["d"]
        )


def test_a_chart_of_nothing_known_is_empty_axes():
    assert "nan" not in draw(LineChart("t", "x", "y", (Series("a", (0.0, 1.0), (math.nan, math.nan), "line"),)))


def test_ticks_are_round_inside_and_have_a_true_minus():
    assert round_ticks(-0.08, 0.08, 5) == pytest.approx((-0.05, 0.0, 0.05))
    assert round_ticks(-4.0, 10.0, 5) == pytest.approx((0.0, 5.0, 10.0))
    assert [tick_text(value) for value in (-10.0, -0.0)] == ["−10", "0"]

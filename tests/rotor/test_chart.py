"""Charts: values stand where the axes say, over azimuth and on logarithmic axes too."""

import json
import math
import re
from html.parser import HTMLParser
from itertools import pairwise
from typing import get_args
from xml.etree import ElementTree

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from rotor.support.chart import (
    AZIMUTH,
    Axis,
    Band,
    Chart,
    DrawnLine,
    Line,
    Mark,
    Points,
    Rule,
    drawn_chart,
    round_ticks,
    tick_text,
)
from rotor.support.chart_svg import small_svg, svg
from rotor.support.markup import Markup, group, tag

SVG = "{http://www.w3.org/2000/svg}"


def parts(chart: Chart) -> tuple[list[tuple[float, float]], dict[str, tuple[float, float]]]:
    """Places of the marks, where no series is in the key, and of the words."""
    tree = ElementTree.fromstring(svg(chart))
    dots = [(float(one.attrib["cx"]), float(one.attrib["cy"])) for one in tree.iter(f"{SVG}circle")]
    words = {
        "".join(one.itertext()): (float(one.attrib["x"]), float(one.attrib["y"]))
        for one in tree.iter(f"{SVG}text")
    }
    return dots, words


def test_points_over_azimuth_stand_at_the_ticks():
    measured = Points("", AZIMUTH, (0.0, 1.0, 0.0, -1.0, 0.0))
    line = Line("", AZIMUTH, (0.1, 0.9, math.nan, -0.9, 0.1), 1)
    chart = Chart("c_l", Axis("azimuth [°]", ticks=AZIMUTH), Axis("C_l"), (measured, line))
    dots, words = parts(chart)
    for psi, (x, _) in list(zip(AZIMUTH, dots, strict=True))[1:]:  # The y axis has a 0 too.
        assert_allclose(x, words[f"{psi:g}"][0], atol=0.1)
    assert_allclose(dots[1][1], words["1"][1] - 4.0, atol=0.1)
    assert_allclose(dots[3][1], words["−1"][1] - 4.0, atol=0.1)
    small = ElementTree.fromstring(small_svg(chart))
    assert len(list(small.iter(f"{SVG}circle"))) == 5
    assert not list(small.iter(f"{SVG}text"))
    path = max(re.findall(r'<path d="(M[^"VH]*)"', svg(chart)), key=len)
    assert (path.count("M"), path.count("L")) == (2, 2)  # Broken where a value is missing.


def test_decades_are_as_long_as_each_other():
    x = (1e-16, 1e-12, 1e-8, 1e-4)
    series = Points("", x, (0.0, 1.0, 2.0, 3.0))
    dots, words = parts(
        Chart("", Axis("error", log=True), Axis(names=("a", "b", "c", "d")), (series,))
    )
    steps = [b[0] - a[0] for a, b in pairwise(dots)]
    assert_allclose(steps, steps[0], atol=0.2)
    assert_allclose([words[name][1] - 4.0 for name in "abcd"], [y for _, y in dots], atol=0.1)
    assert_allclose(words["10⁻¹²"][0], dots[1][0], atol=0.1)


def test_an_error_bar_is_as_long_as_the_scatter():
    series = Points("", (0.0, 1.0), (0.0, 10.0), scatter=(2.0, 2.0))
    dots, _ = parts(Chart("", Axis("x"), Axis("y"), (series,)))
    scale = (dots[0][1] - dots[1][1]) / 10.0
    (bars,) = re.findall(
        r'<path d="((?:M[\d.]+,[\d.]+V[\d.]+){2})" stroke',
        svg(Chart("", Axis("x"), Axis("y"), (series,))),
    )
    for start, end in re.findall(r",([\d.]+)V([\d.]+)", bars):
        assert_allclose(float(start) - float(end), 4.0 * scale, atol=0.2)


def test_a_line_is_cut_off_at_given_ends_of_the_axes():
    line = Line("<one>", (0.0, 0.5, 1.0), (0.0, 1e9, 1.0), "#123456")
    drawn = svg(
        Chart("A <title>", Axis("x", range=(0.0, 1.0)), Axis("y", range=(0.0, 4.0)), (line,)),
        inline=True,
    )
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
    ends = (0.0, 1.0)
    series = (
        *(Points(mark, ends, ends, mark=mark) for mark in get_args(Mark)),
        Line("line", ends, ends),
        Line("dashes and dots", ends, ends, dashes=True, dots=True),
        Band("band", ends, ends, (2.0, 3.0)),
    )
    tree = ElementTree.fromstring(svg(Chart("", Axis("x"), Axis("y"), series, (Rule(0.5),))))
    for path in tree.iter(f"{SVG}path"):
        assert path.get("fill") or all(
            len(re.findall("[VLHlvh]", piece)) < 2 for piece in path.attrib["d"].split("M")
        )
        assert path.get("stroke") or path.get("fill") != "none"


def test_a_chart_of_nothing_known_is_empty_axes():
    assert "nan" not in svg(
        Chart("t", Axis("x"), Axis("y"), (Line("a", (0.0, 1.0), (math.nan, math.nan)),))
    )


def test_ticks_are_round_inside_and_have_a_true_minus():
    assert round_ticks(-0.08, 0.08, 5) == pytest.approx((-0.05, 0.0, 0.05))
    assert round_ticks(-4.0, 10.0, 5) == pytest.approx((0.0, 5.0, 10.0))
    assert [tick_text(value) for value in (-10.0, -0.0)] == ["−10", "0"]


def test_the_page_is_told_the_same_ticks_ends_and_colours():
    """Both renderers have them from the value: a gap is None, and a number no longer than a pixel needs."""
    line = Line("one", (0.0, 1.0, 2.0), (0.0, math.nan, 1.0 / 3.0), dashes=True)
    chart = Chart(
        "title",
        Axis("x"),
        Axis("y", range=(0.0, 1.0), unit="°"),
        (line, Points("two", (1.0,), (0.5,))),
    )
    told, drawn = drawn_chart(chart), svg(chart)
    assert [one.y for one in told.series if isinstance(one, DrawnLine)] == [[0.0, None, 0.3333]]
    assert all(one.colour in drawn for one in told.series)
    assert all(f">{word}<" in drawn for _, word in told.y.ticks if word in ("0°", "1°"))
    assert told.y.range == chart.span("y")
    assert "log" not in msgspec.to_builtins(told.x)
    assert "rules" not in msgspec.to_builtins(told)


# Elements as text: what the standard parser reads back is what was put in


TEXT = st.text(st.characters(exclude_categories=("Cs", "Cc")))


class Reader(HTMLParser):
    """Attributes and text as a browser has them."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.words = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.words += data


@given(words=TEXT, title=TEXT)
def test_any_text_comes_back(words: str, title: str):
    read = Reader(tag("p.note.small", words, tag("b", words), title=title, data_do="x"))
    assert read.words == 2 * words
    assert read.found == [("p", {"class": "note small", "title": title, "data-do": "x"}), ("b", {})]


@given(words=TEXT)
def test_sums_escape_what_is_not_markup(words: str):
    assert words + tag("br") + words == group(words, tag("br"), words)
    assert isinstance(words + tag("br") + words, Markup)
    assert Reader("" + tag("i", words) + words).words == 2 * words


def test_json_stays_readable_in_an_attribute():
    data = {"title": "a < b & c", "x": [1.0, None]}
    drawn = tag("div", data_chart=json.dumps(data))
    assert json.loads(Reader(drawn).found[0][1]["data-chart"] or "") == data
    assert "&quot;" not in drawn


def test_numbers_flags_and_nothing():
    drawn = tag(
        "input", value=0.1 + 0.2, max=100.0, disabled=True, hidden=False, title=None, for_="a"
    )
    assert drawn == '<input value="0.3" max="100" disabled for="a"/>'
    assert tag("ul", [tag("li", one) for one in "ab"], None) == "<ul><li>a</li><li>b</li></ul>"
    assert tag("path", d="M0,0") == '<path d="M0,0"/>'
    assert tag("td") == "<td></td>"

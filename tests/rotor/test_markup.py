"""Elements as text: what the standard parser reads back is what was put in."""

import json
from html.parser import HTMLParser

from hypothesis import given
from hypothesis import strategies as st

from rotor.support.markup import Markup, group, tag

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
    drawn = tag("input", value=0.1 + 0.2, max=100.0, disabled=True, hidden=False, title=None, for_="a")
    assert drawn == '<input value="0.3" max="100" disabled for="a"/>'
    assert tag("ul", [tag("li", one) for one in "ab"], None) == "<ul><li>a</li><li>b</li></ul>"
    assert tag("path", d="M0,0") == '<path d="M0,0"/>'
    assert tag("td") == "<td></td>"

"""The page with any rotor: menu, weights, files brought one after another, pictures with its own blades."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from test_rotor_file import GOOD, polar_file

from explorer.model.inputs import (
    OPENING,
    OWN,
    Inputs,
    ViewState,
    baseline_of,
    inputs_of,
    mass_range,
    menu_titles,
    reference_mass_t,
    with_optimum,
    with_rotor,
)
from explorer.model.session_state import Pinboard, Pinned
from explorer.model.stand import measured_conditions
from explorer.picture.picture import turned_blades
from explorer.sharing import share
from explorer.text.design_words import title_words
from explorer.text.readout import ideal_line, power_panel
from explorer.widgets.design_files import UploadedFiles
from rotor import Solution, make_design, solve
from rotor.airfoil.polars import read_polars
from rotor.files.design_file import parse_design
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.assets import SHIPPED_ROTORS, asset_path

R22 = with_rotor(Inputs(), "r22")
DECK = asset_path("airfoils/naca0012.c81").read_bytes()
POLAR = read_polars(asset_path("airfoils/naca0012_trip5.polars.csv")).polars[2]
OUTLINE = asset_path("airfoils/naca0012.contour").read_bytes()
NAMES_DECK = (
    GOOD.replace('"naca0012"', '"mine"') + '\n[sections.mine]\ndeck = "mine.c81"\n'
).encode()


@pytest.fixture(scope="module")
def r22() -> Solution:
    return solve(R22.design()).require()


def test_the_weight_slider_is_about_the_reference_mass():
    assert mass_range(shipped_aircraft("uh60a")) == (5.0, 11.0, 0.05)
    for name in SHIPPED_ROTORS:
        craft = shipped_aircraft(name)
        low, high, step = mass_range(craft)
        assert low < reference_mass_t(craft) < high
        assert_allclose([low / step, high / step], np.round([low / step, high / step]), atol=1e-6)


@pytest.mark.parametrize("name", menu_titles(None))
def test_the_page_opens_with_the_design_of_make_design(name: str):
    """Also a mass between two steps of its slider; and so do its link and a file of it."""
    inputs = with_rotor(OPENING, name)
    design, stand = inputs.design(), inputs.stand
    test = (
        {}
        if stand is None
        else {"mu": inputs.advance_ratio, "trim": stand.trim, "stand": stand.stand()}
    )
    tests = (
        []
        if stand is None
        else [(one.advance_ratio, one.stand) for one in measured_conditions(name)]
    )
    assert ((inputs.advance_ratio, stand) in tests) == (name not in SHIPPED_ROTORS)
    assert with_rotor(inputs, "uh60a").stand is None
    assert design == make_design(rotor=name, **test)
    assert inputs_of(design) == inputs
    assert share.inputs_from(share.code_of(design)).design() == design
    assert (
        inputs_of(parse_design(json.dumps(design.to_dict()).encode(), "mine.json")).design()
        == design
    )


def test_another_rotor_comes_as_it_is_built():
    inputs = with_rotor(
        Inputs(advance_ratio=0.3, altitude_m=1000.0, law="optimised", airfoils="sc1095"), "s61"
    )
    assert (inputs.law, inputs.airfoils, inputs.advance_ratio, inputs.altitude_m) == (
        "builtin",
        "",
        0.3,
        1000.0,
    )
    design = inputs.design()
    assert design.aircraft is shipped_aircraft("s61")
    assert design.condition.mass == 8618.0
    assert baseline_of(design) == design
    assert inputs_of(design) == with_rotor(Inputs(advance_ratio=0.3, altitude_m=1000.0), "s61")
    assert title_words(design) == "Sikorsky S-61 as built"
    assert title_words(Inputs(law="three").design()) == "UH-60A · segments −16/−12/−6 at 0.4/0.75"
    assert (
        title_words(Inputs(law="linear", linear=-9.5).design()) == "UH-60A · linear −9.5\u00a0°/R"
    )


def test_ones_own_rotor_stays_in_the_menu():
    craft = UploadedFiles().add("my.toml", GOOD.encode()).aircraft
    inputs = with_rotor(Inputs(), OWN, craft)
    assert inputs.aircraft is craft
    titles = list(menu_titles(craft).values())
    assert "Castles and Gray, twist −12°" in titles
    assert titles[:4] == ["UH-60A", "Robinson R22", "Sikorsky S-61", "SA349/2 Gazelle"]
    assert titles[-1] == "Test rotor (own)"
    back = with_rotor(inputs, "uh60a")
    assert back.own_rotor is craft
    assert back.aircraft is shipped_aircraft("uh60a")
    assert with_rotor(back, OWN).design() == inputs.design()
    assert with_optimum(inputs, replace(inputs.design(), twist=inputs.design().twist)).rotor == OWN


def test_designs_of_other_rotors_in_addresses_and_files():
    code = share.code_of(R22.design())
    assert code == "1;linear:-8;rotor=r22"
    assert share.inputs_from(code) == R22
    with pytest.raises(ValueError, match=r"Mass \[t\] is 8\.32, outside this page's 0\.37"):
        share.within(replace(R22, mass_t=8.32))
    own = with_rotor(Inputs(), OWN, UploadedFiles().add("my.toml", GOOD.encode()).aircraft)
    packed = share.code_of(own.design())
    assert len(packed) < 2000
    assert share.inputs_from(packed) == own
    for damaged in (packed[:-9], packed[:60] + "~" + packed[60:], "1;file=", packed + packed[7:]):
        with pytest.raises(ValueError, match=r"The link is damaged.*: ask for"):
            share.inputs_from(damaged)
    with pytest.raises(ValueError, match="characters; at most 8000 are allowed"):
        share.inputs_from(packed + "A" * 8000)
    read = parse_design(json.dumps(own.design().to_dict()).encode(), "mine.json")
    assert inputs_of(read) == own
    assert share.inputs_from(share.KEPT, json.dumps(own.design().to_dict())) == own
    for kept in (None, "{", '{"rotor": 1}'):
        with pytest.raises(ValueError, match=r"sender's own|cannot be read|is not JSON|rotor"):
            share.inputs_from(share.KEPT, kept)


class TestShelf:
    def test_files_come_in_any_order(self):
        first = UploadedFiles()
        assert "waits for a rotor file" in first.add("mine.c81", DECK).sentence
        with pytest.raises(ValueError, match=r"cut\.json is not a rotor file"):
            first.add("cut.json", b'{"rotor": {"rad')
        craft = first.add("my.toml", NAMES_DECK).aircraft
        later = UploadedFiles()
        arrival = later.add("my.toml", NAMES_DECK)
        assert arrival.aircraft is None
        assert arrival.sentence == "my.toml is loaded and needs mine.c81: load that next."
        assert later.add("mine.c81", DECK).aircraft == craft

    def test_polars_and_windows_line_ends(self):
        toml = (
            GOOD.replace('"naca0012"', '"mine"')
            + '\n[sections.mine]\npolars = "p.txt"\noutline = "naca0012"\n'
        )
        shelf = UploadedFiles()
        shelf.add("p.txt", polar_file(POLAR).replace("\n", "\r\n").encode())
        craft = shelf.add("my.toml", toml.encode("utf-8-sig")).aircraft
        assert len(craft.remarks) == 1

    @pytest.mark.parametrize(
        ("name", "content", "says"),
        [
            ("photo.png", b"\x89PNG\r\n\x1a\n\0\0\0", "photo.png is not text: save it"),
            ("my.toml", b"\xff\xfe\x00", "my.toml is not text: save it"),
            ("my.toml", b"x" * 2_000_001, "my.toml has 2.0 MB: the limit for rotor files is 2 MB"),
            (
                "my.toml",
                GOOD.replace("radius_m = 5.0", "radius_m = -5.0").encode(),
                "my.toml, line 5: radius_m is -5",
            ),
            ("my.toml", b"name = \n", "my.toml, line 1: this is not TOML"),
        ],
    )
    def test_bad_files_leave_the_shelf_as_it_was(self, name: str, content: bytes, says: str):
        shelf = UploadedFiles({"kept.c81": "text"})
        with pytest.raises(ValueError, match=r"\.") as caught:
            shelf.add(name, content)
        assert says in str(caught.value)
        assert (shelf.texts, shelf.rotor) == ({"kept.c81": "text"}, None)

    @pytest.mark.parametrize(
        ("key", "content", "says"),
        [
            ("deck", DECK[:5000], "mine.cor, line 79"),
            ("polars", b"hello", "mine.cor has no line that names columns alpha, cl and cd"),
            ("outline", b"1 0\n0 0\n", "mine.cor has 2 points"),
        ],
    )
    @pytest.mark.parametrize("rotor_first", [True, False])
    def test_the_key_that_names_a_file_says_what_it_is(
        self, key: str, content: bytes, says: str, rotor_first: bool
    ):
        """Whatever its suffix, and by its name without folders, as a browser gives it."""
        deck = 'deck = "mine.c81"\n' if key == "outline" else ""
        toml = f'{GOOD.replace("naca0012", "mine")}\n[sections.mine]\n{deck}{key} = "data/mine.cor"\n'.encode()
        good = {"deck": DECK, "polars": polar_file(POLAR).encode(), "outline": OUTLINE}[key]
        shelf = UploadedFiles()
        shelf.add("mine.c81", DECK)
        first, then = (("my.toml", toml), ("mine.cor", content))[:: 1 if rotor_first else -1]
        shelf.add(*first)
        with pytest.raises(ValueError, match=re.escape(says)):
            shelf.add(*then)
        # In its place, without the rotor file again.
        assert shelf.add("mine.cor", good).aircraft is not None


def test_the_picture_has_the_rotors_own_blades(r22: Solution):
    blades = turned_blades(r22, ViewState(azimuth_deg=60.0))
    assert len(blades.poses) == 2
    one, other = (pose.position for pose in blades.poses)
    assert_allclose(one, -other, atol=1e-12)


def test_read_outs_name_the_rotor_and_leave_out_a_bound_that_is_anothers(r22: Solution):
    html = power_panel(r22, solve(baseline_of(r22.design)))
    assert "vs. Robinson R22 as built" in html
    assert "ideal: not computed for this rotor" in ideal_line(r22, None)
    assert f"{r22.power.total / 1e3:.1f} kW" in html  # A light one is told to a tenth.


def test_a_pinned_design_of_another_rotor_keeps_its_own_flight(r22: Solution):
    board = Pinboard()
    other = Inputs(law="builtin")
    board.pin(Pinned(other, solve(other.design()).require()))
    answer = board.solve(r22.design)
    assert answer.design.condition.mass == 8322.4
    assert board.pinned.sliders(R22, along=True) == other
